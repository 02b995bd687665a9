//! A link that is not linear, over one step (theory, Eqs. B9 to B12).

use crate::contact::ContactResponse;
use crate::hysteresis::Rates;
use crate::interface::{LinkElement, LinkMemory};
use crate::model::LinkLaw;

/// A link that is not linear, in the step to be solved.
#[derive(Clone, Debug)]
pub(crate) struct StepLink {
    element: LinkElement,
    memory: LinkMemory,
    /// Shortening at the start of the step \[m\].
    start: f64,
    /// Length of the step \[s\].
    step: f64,
}

/// Iterations on the force of one dashpot in series with a spring; each gains digits, so few are needed.
const ITERATIONS: usize = 200;

impl StepLink {
    pub(super) fn new(element: &LinkElement, memory: &LinkMemory, start: f64, step: f64) -> Self {
        Self {
            element: element.clone(),
            memory: *memory,
            start,
            step,
        }
    }

    /// Whether the force is the unknown, not the shortening: the slope of F = c |v|^α is infinite at rest for α < 1.
    pub(super) fn force_is_unknown(&self) -> bool {
        match self.element.law {
            LinkLaw::Viscous { exponent } => exponent < 1.0 && self.element.stiffness == 0.0,
            LinkLaw::Linear
            | LinkLaw::Maxwell
            | LinkLaw::Friction { .. }
            | LinkLaw::Yielding(_)
            | LinkLaw::Cable { .. }
            | LinkLaw::Stopper { .. } => false,
        }
    }

    /// Force at the start of the step \[N\].
    pub(super) fn start_force(&self) -> f64 {
        self.memory.force
    }

    /// Rate at which a dashpot has this force, v = sgn F |F/c|^(1/α), and dv/dF \[m/s, m/(N·s)\].
    pub(super) fn rate_of(&self, force: f64) -> [f64; 2] {
        let exponent = match self.element.law {
            LinkLaw::Viscous { exponent } => exponent,
            LinkLaw::Linear
            | LinkLaw::Maxwell
            | LinkLaw::Friction { .. }
            | LinkLaw::Yielding(_)
            | LinkLaw::Cable { .. }
            | LinkLaw::Stopper { .. } => 1.0,
        };
        power(
            force / self.element.damping,
            exponent.recip(),
            self.element.damping,
        )
    }

    /// Force at the end of the step, where shortening and rate are these.
    pub(super) fn respond(&self, shortening: f64, rate: f64) -> ContactResponse {
        let (link, before) = (&self.element, self.memory.force);
        let change = shortening - self.start;
        let by_indentation = |force: f64, slope: f64| ContactResponse {
            force,
            by_indentation: slope,
            by_rate: 0.0,
        };
        match &link.law {
            LinkLaw::Linear => ContactResponse {
                force: link.force(shortening, rate),
                by_indentation: link.stiffness,
                by_rate: link.damping,
            },
            LinkLaw::Viscous { exponent } if link.stiffness == 0.0 => {
                let [force, slope] = power(rate, *exponent, 1.0);
                ContactResponse {
                    force: link.damping * force,
                    by_indentation: 0.0,
                    by_rate: link.damping * slope,
                }
            }
            LinkLaw::Viscous { exponent } => {
                let [force, slope] = self.in_series(change, *exponent);
                by_indentation(force, slope)
            }
            LinkLaw::Maxwell => {
                let ratio = 0.5 * self.step * link.stiffness / link.damping;
                by_indentation(
                    ((1.0 - ratio) * before + link.stiffness * change) / (1.0 + ratio),
                    link.stiffness / (1.0 + ratio),
                )
            }
            LinkLaw::Friction {
                slip_force,
                stick_stiffness,
            } => {
                let tried = before + stick_stiffness * change;
                let force = tried.clamp(-slip_force, *slip_force);
                by_indentation(
                    force,
                    if force == tried {
                        *stick_stiffness
                    } else {
                        0.0
                    },
                )
            }
            LinkLaw::Yielding(hysteresis) => {
                let [force, slope] =
                    // No rule of a link depends on rates.
                    hysteresis.answer(&self.memory.hysteresis, shortening, &Rates::default());
                by_indentation(force, slope)
            }
            LinkLaw::Cable { slack } => {
                let stretch = -shortening - slack;
                let slope = if stretch > 0.0 { link.stiffness } else { 0.0 };
                by_indentation(-slope * stretch, slope)
            }
            LinkLaw::Stopper { gap } => {
                let force = link.force(shortening - gap, rate);
                let pushes = shortening > *gap && force > 0.0;
                let part = |value: f64| if pushes { value } else { 0.0 };
                ContactResponse {
                    force: part(force),
                    by_indentation: part(link.stiffness),
                    by_rate: part(link.damping),
                }
            }
        }
    }

    /// Force of a dashpot in series with a spring at the end of the step, and its slope, from the mean force F̄ of
    /// the step: ΔΔ = 2 (F̄ − Fₙ)/k + h φ(F̄) (theory, Eq. B10).
    ///
    /// For α < 1 the mean force is iterated on, otherwise the rate w of the dashpot, F̄ = c w^α, so that the function is
    /// convex without a vertical tangent; Newton's method from above then approaches its zero from above.
    fn in_series(&self, change: f64, exponent: f64) -> [f64; 2] {
        let (k, c, h) = (self.element.stiffness, self.element.damping, self.step);
        let before = self.memory.force;
        let wanted = change + 2.0 * before / k;
        let size = wanted.abs();
        if size == 0.0 {
            let slope = if exponent < 1.0 {
                k
            } else if exponent > 1.0 {
                0.0
            } else {
                2.0 / (2.0 / k + h / c)
            };
            return [-before, slope];
        }
        // Parts of the deformation as powers of the unknown: `one` x + `other` x^power.
        let (one, other, power) = if exponent < 1.0 {
            (
                2.0 / k,
                h * libm::pow(c, -exponent.recip()),
                exponent.recip(),
            )
        } else {
            (h, 2.0 * c / k, exponent)
        };
        let mut x = (size / one).min(libm::pow(size / other, power.recip()));
        for _ in 0..ITERATIONS {
            let bent = other * libm::pow(x, power);
            let excess = one * x + bent - size;
            let next = x - excess / (one + power * bent / x);
            // From above, as far as rounding allows.
            if next.is_nan() || next >= x || next <= 0.0 {
                break;
            }
            x = next;
        }
        let bent = other * power * libm::pow(x, power - 1.0);
        let (mean, slope) = if exponent < 1.0 {
            (x, 1.0 / (one + bent))
        } else {
            (c * libm::pow(x, exponent), 0.5 * k * bent / (one + bent))
        };
        [2.0 * mean.copysign(wanted) - before, 2.0 * slope]
    }

    /// State at the end of the accepted step.
    pub(super) fn committed(&self, shortening: f64, force: f64) -> LinkMemory {
        let mut memory = LinkMemory {
            force,
            ..self.memory
        };
        if let LinkLaw::Yielding(hysteresis) = &self.element.law {
            hysteresis.commit(&mut memory.hysteresis, shortening, force);
        }
        memory
    }
}

/// sgn x |x|^power, and its slope divided by `unit`.
fn power(x: f64, power: f64, unit: f64) -> [f64; 2] {
    let size = x.abs();
    if size == 0.0 {
        let slope = if power == 1.0 { 1.0 } else { 0.0 };
        return [0.0, slope / unit];
    }
    let value = libm::pow(size, power);
    [value.copysign(x), power * value / size / unit]
}
