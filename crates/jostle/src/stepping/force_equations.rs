//! Forces of closed contacts at the end of a step that their motion follows linearly: Newton's method on the forces.

use crate::linear::envelope::{Envelope, PivotedEnvelope};
use crate::stepping::coupling::Closed;

/// Iterations of Newton's method before it is given up.
pub(super) const QUICK_ROUNDS: u64 = 12;
/// Change of the forces, relative to the greatest, at convergence.
pub(super) const SETTLED: f64 = 1e-13;
/// Change that counts as rounding if it no longer decreases.
pub(super) const ROUNDING: f64 = 1e-11;

/// F = f(δ⁰ − W F, δ̇⁰ − V F) of the laws f of all closed contacts.
#[derive(Debug, Default)]
pub(super) struct ForceEquations {
    /// W and V: opening and opening rate of a contact due to a unit force of another \[m/N, m/(N s)\].
    pub(super) openings: [Envelope; 2],
    /// F of every closed contact \[N\].
    pub(super) forces: Vec<f64>,
    /// I + diag(∂f/∂δ) W + diag(∂f/∂δ̇) V.
    matrix: PivotedEnvelope,
    change: Vec<f64>,
    /// Multiply-adds spent so far.
    pub(super) operations: u64,
}

impl ForceEquations {
    /// Solves for the forces, starting from `forces`, and stores them and their indentations; returns the number of
    /// iterations, or `None` without convergence, as at corners of a law.
    pub(super) fn solve(&mut self, closed: &mut [Closed]) -> Option<u64> {
        let mut last = f64::INFINITY;
        for round in 1..=QUICK_ROUNDS {
            self.linearise(closed);
            self.operations += self.matrix.eliminate(&mut self.change)?;
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for (force, step) in self.forces.iter_mut().zip(&self.change) {
                *force += step;
                change = change.max(step.abs());
                greatest = greatest.max(force.abs());
            }
            if !self.forces.iter().all(|force| force.is_finite()) {
                return None;
            }
            let rounding = change <= ROUNDING * greatest && change >= last;
            if change <= SETTLED * greatest || rounding {
                for (row, closed) in closed.iter_mut().enumerate() {
                    (closed.indentation, _) = self.pressed(row, closed);
                    closed.force = self.forces[row];
                }
                return Some(round);
            }
            last = change;
        }
        None
    }

    /// Indentation and its rate of one contact under the forces.
    fn pressed(&self, row: usize, closed: &Closed) -> (f64, f64) {
        let [openings, rates] = &self.openings;
        let (mut indentation, mut rate) = (closed.free, closed.free_rate);
        for column in openings.columns(row) {
            indentation -= openings.get(row, column) * self.forces[column];
            rate -= rates.get(row, column) * self.forces[column];
        }
        (indentation, rate)
    }

    /// The matrix of Newton's method, and the residual of the laws.
    fn linearise(&mut self, closed: &[Closed]) {
        let [openings, rates] = &self.openings;
        self.matrix.reset_like(openings);
        self.change.clear();
        for (row, closed) in closed.iter().enumerate() {
            let (indentation, rate) = self.pressed(row, closed);
            let pressed = closed.friction.map(|friction| self.forces[friction.normal]);
            let response = match (&closed.friction, pressed) {
                (Some(friction), Some(pressed)) => friction.respond(indentation, pressed),
                _ => closed.law.follow(indentation, rate, &closed.memory),
            };
            self.change.push(response.force - self.forces[row]);
            for column in openings.columns(row) {
                let slope = response.by_indentation * openings.get(row, column)
                    + response.by_rate * rates.get(row, column);
                let unit = if column == row { 1.0 } else { 0.0 };
                self.matrix.set(row, column, slope + unit);
            }
            // Friction that slips follows the contact force.
            if let (Some(friction), Some(pressed)) = (&closed.friction, pressed)
                && response.by_indentation == 0.0
                && pressed > 0.0
            {
                let share = friction.law.coefficient.copysign(response.force);
                self.matrix.set(row, friction.normal, -share);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ForceLaw;
    use crate::interface::Coulomb;
    use crate::stepping::step_friction::StepFriction;

    /// A full matrix, row by row.
    fn filled(n: usize, entries: &[f64]) -> Envelope {
        let mut matrix = Envelope::default();
        matrix.reset(std::iter::repeat_n(0, n));
        for (place, entry) in entries.iter().enumerate() {
            matrix.set(place / n, place % n, *entry);
        }
        matrix
    }

    fn closed(law: ForceLaw, free: f64, free_rate: f64) -> Closed {
        Closed {
            contact: 0,
            law,
            memory: law.touch(0.5),
            free,
            free_rate,
            rate_gain: 0.0,
            indentation: 0.0,
            force: 0.0,
            start_slope: 0.0,
            turn: None,
            start_acceleration: 0.0,
            friction: None,
            link: None,
        }
    }

    /// A dashpot without tension separates the two sides, and no force keeps contact: the slower method handles
    /// this.
    #[test]
    fn a_force_that_jumps_does_not_settle() {
        let law = ForceLaw::Kelvin {
            stiffness: 1e8,
            damping: 4e6,
            tension: false,
        };
        let mut equations = ForceEquations {
            openings: [filled(1, &[1e-11]), filled(1, &[1e-9])],
            forces: vec![0.0],
            ..ForceEquations::default()
        };
        assert!(equations.solve(&mut [closed(law, 1e-6, 0.4)]).is_none());
    }

    /// A contact and the friction along it, each of which moves the other: slipping has T = μF, and Newton's method knows that
    /// both grow together.
    #[test]
    fn friction_slips_with_the_contact_force() {
        let law = ForceLaw::Hertz {
            stiffness: 2e9,
            damping: 0.4,
        };
        let friction = StepFriction {
            contact: 0,
            normal: 0,
            law: Coulomb {
                coefficient: 0.4,
                stiffness: 5e7,
            },
            origin: 0.0,
            pressed: 0.0,
            start: None,
        };
        let solve = |slip: f64| {
            let mut contacts = [closed(law, 5e-3, 0.3), closed(law, slip, 0.2)];
            contacts[1].friction = Some(friction);
            let mut equations = ForceEquations {
                openings: [
                    filled(2, &[2e-9, 1.5e-9, 1.5e-9, 3e-9]),
                    filled(2, &[3e-6, 2e-6, 2e-6, 4e-6]),
                ],
                forces: vec![1e5, 0.0],
                ..ForceEquations::default()
            };
            let rounds = equations.solve(&mut contacts).expect("it settles");
            let [pressed, rubbed] = [0, 1].map(|row| equations.forces[row]);
            let indentation = 5e-3 - 2e-9 * pressed - 1.5e-9 * rubbed;
            let rate = 0.3 - 3e-6 * pressed - 2e-6 * rubbed;
            let expected = law.follow(indentation, rate, &contacts[0].memory).force;
            assert!((pressed / expected - 1.0).abs() < 1e-12, "{pressed}");
            (rounds, pressed, rubbed)
        };
        for slip in [2e-2, -2e-2] {
            let (rounds, pressed, rubbed) = solve(slip);
            assert!((rubbed - 0.4_f64.copysign(slip) * pressed).abs() < 1e-9 * pressed);
            assert!(rounds <= 7, "{rounds}");
        }
        let (_, pressed, stuck) = solve(1e-3);
        let slip = 1e-3 - 1.5e-9 * pressed - 3e-9 * stuck;
        assert!((stuck - 5e7 * slip).abs() < 1e-6 && stuck.abs() < 0.4 * pressed);
    }

    /// Three coupled contacts, one of which is open at the end: every force equals that of its law for the motion
    /// under all of them.
    #[test]
    fn forces_are_those_of_their_laws() {
        let law = ForceLaw::Hertz {
            stiffness: 2e9,
            damping: 0.4,
        };
        let mut contacts =
            [(4e-3, 0.3), (6e-3, -0.1), (-1e-3, -0.4)].map(|(free, rate)| closed(law, free, rate));
        let mut equations = ForceEquations {
            openings: [
                filled(
                    3,
                    &[
                        2e-9, -8e-10, 1e-10, -7e-10, 3e-9, -5e-10, 2e-10, -6e-10, 2e-9,
                    ],
                ),
                filled(
                    3,
                    &[3e-6, -2e-6, 2e-7, -1e-6, 5e-6, -1e-6, 3e-7, -2e-6, 4e-6],
                ),
            ],
            forces: vec![2e5, 2e5, 1e4],
            ..ForceEquations::default()
        };
        equations.solve(&mut contacts).expect("it settles");
        let forces = equations.forces.clone();
        for (row, contact) in contacts.iter().enumerate() {
            let (mut indentation, mut rate) = (contact.free, contact.free_rate);
            for (column, force) in forces.iter().enumerate() {
                indentation -= equations.openings[0].get(row, column) * force;
                rate -= equations.openings[1].get(row, column) * force;
            }
            let expected = law.follow(indentation, rate, &contact.memory).force;
            assert!(
                (contact.force - expected).abs() <= 1e-12 * 1e6,
                "{row}: {} against {expected}",
                contact.force
            );
            assert!((contact.indentation - indentation).abs() <= 1e-17);
        }
        assert!(contacts[0].force > 1e4 && contacts[2].force == 0.0);
        contacts[1].free = f64::NAN;
        assert!(equations.solve(&mut contacts).is_none());
    }
}
