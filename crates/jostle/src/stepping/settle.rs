//! Contact forces if Newton's method fails: one contact after the other, each by bisection.

use super::coupling::{Closed, ContactEquations};
use super::step_link::StepLink;

/// Rounds over all contacts.
const ROUNDS: u64 = 4000;
/// Change of the forces, relative to the greatest, at convergence.
const SETTLED: f64 = 1e-13;

impl ContactEquations {
    /// Solves δ + W f(δ, δ̇) = δ_free contact by contact, round after round. This is coordinate descent on a
    /// strictly convex function, so it converges, though slowly. If a force jumps, as that of a dashpot at δ = 0,
    /// the solution may lie on the jump: equilibrium then determines the force, between both ends. Returns the
    /// rounds.
    pub(super) fn settle(&mut self) -> Option<u64> {
        let n = self.closed.len();
        for closed in &mut self.closed {
            (closed.indentation, closed.force) = (closed.free, 0.0);
        }
        for round in 1..=ROUNDS {
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for i in 0..n {
                let compliance = self.compliance.get(i, i);
                let others = self
                    .compliance
                    .times(i, |j| if j == i { 0.0 } else { self.closed[j].force });
                let before = self.closed[i].force;
                settle_one(&mut self.closed[i], &self.links, compliance, others);
                let force = self.closed[i].force;
                change = change.max((force - before).abs());
                greatest = greatest.max(force.abs());
            }
            if !greatest.is_finite() {
                return None;
            }
            if change <= SETTLED * greatest {
                return Some(round);
            }
        }
        None
    }
}

/// The zero of δ + w F(δ) − (δ_free − others), which increases with δ.
fn settle_one(closed: &mut Closed, links: &[StepLink], own_compliance: f64, opened_by_others: f64) {
    if let Some(link) = closed.forced(links) {
        closed.force = force_of(closed, link, own_compliance, opened_by_others);
        closed.indentation = closed.free + closed.change_for(link, closed.force)[0];
        return;
    }
    let free = closed.free - opened_by_others;
    let start = *closed;
    let force = |indentation: f64| {
        let rate = start.free_rate + start.rate_gain * (indentation - start.free);
        start.respond(links, indentation, rate).force
    };
    // The force cannot be greater than at `free`, so the indentation cannot be less than this.
    let other = free - own_compliance * force(free);
    let (mut low, mut high) = (free.min(other), free.max(other));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if middle + own_compliance * force(middle) > free {
            high = middle;
        } else {
            low = middle;
        }
    }
    closed.indentation = high;
    closed.force = if own_compliance > 0.0 {
        (free - high) / own_compliance
    } else {
        force(high)
    };
}

/// The zero of δ(F) − δ_free + others + w F, which increases with F.
fn force_of(closed: &Closed, link: &StepLink, own_compliance: f64, opened_by_others: f64) -> f64 {
    let missing =
        |force: f64| closed.change_for(link, force)[0] + opened_by_others + own_compliance * force;
    let other = -missing(0.0) / own_compliance;
    let (mut low, mut high) = (other.min(0.0), other.max(0.0));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if missing(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ForceLaw;

    fn closed(law: ForceLaw, contact: usize, free: f64, free_rate: f64) -> Closed {
        Closed {
            contact,
            law,
            memory: law.touch(0.5),
            free,
            free_rate,
            rate_gain: 2e4,
            indentation: free,
            force: 0.0,
            start_slope: 0.0,
            turn: None,
            start_acceleration: 0.0,
            friction: None,
            link: None,
        }
    }

    #[test]
    fn settling_and_newton_agree() {
        let law = ForceLaw::Hertz {
            stiffness: 2e9,
            damping: 0.4,
        };
        let mut equations = ContactEquations::default();
        equations.closed = vec![closed(law, 0, 4e-3, 0.3), closed(law, 1, 6e-3, -0.1)];
        equations.compliance.reset([0, 0].into_iter());
        for (i, j, value) in [(0, 0, 2e-9), (0, 1, -8e-10), (1, 0, -8e-10), (1, 1, 3e-9)] {
            equations.compliance.set(i, j, value);
        }
        equations.solve().expect("Newton converges");
        let newton: Vec<f64> = equations.closed.iter().map(|c| c.force).collect();
        equations.settle().expect("it settles");
        for (closed, expected) in equations.closed.iter().zip(newton) {
            assert!(
                (closed.force / expected - 1.0).abs() < 1e-9,
                "{} against {expected}",
                closed.force
            );
        }
    }

    /// A dashpot without tension may have any force up to c δ̇ at δ = 0; neither end is a solution.
    #[test]
    fn a_solution_on_a_jump_is_found() {
        let law = ForceLaw::Kelvin {
            stiffness: 1e8,
            damping: 4e6,
            tension: false,
        };
        // Without force the indentation would be 1 µm and closing; the full dashpot force would open the contact.
        let mut equations = ContactEquations::default();
        equations.closed = vec![closed(law, 0, 1e-6, 0.4)];
        equations.compliance.reset([0].into_iter());
        equations.compliance.set(0, 0, 1e-11);
        equations.closed[0].rate_gain = 100.0;
        equations.solve().expect("the forces are found");
        let found = equations.closed[0];
        assert!((found.force / 1e5 - 1.0).abs() < 1e-9, "{found:?}");
        assert!(found.indentation.abs() < 1e-15, "{found:?}");
    }
}
