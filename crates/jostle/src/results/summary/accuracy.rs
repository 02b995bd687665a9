//! Accuracy and work.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Whether the errors of all reported peaks, relative to the greatest of their kind in the building or gap, stay within the
/// tolerance.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct PromiseSummary {
    /// Estimated error of peaks \[–\].
    pub tolerance: f64,
    /// Whether the estimate stays within the tolerance; `null` for a run that did not begin or end.
    pub met: Option<bool>,
    /// Where it does, but not for all of the run: the instant until which it holds, that of `sensitive_from_s`; otherwise `null`
    /// \[s\].
    pub met_until_s: Option<f64>,
    /// Estimated error of the least accurate peak of a building, contact forces and impulses not included: from
    /// omitted shapes and values between steps in modal stepping, or from frequency errors of the steps otherwise;
    /// `null` where it is not estimated \[–\].
    pub residual: Option<f64>,
    /// Instant from which results depend on contacts made or missed within the tolerance; `null` if none do \[s\].
    pub sensitive_from_s: Option<f64>,
}

#[rustfmt::skip]
impl PromiseSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("tolerance", Unit::NONE, "tolerance for peaks", |p| p.tolerance),
        Quantity::<Self>::optional("met", Unit::NONE, "whether the estimated errors are within the tolerance", |p| p.met.map(|met| f64::from(u8::from(met)))),
        Quantity::<Self>::optional("met_until_s", Unit::S, "time until which they are, if not until the end", |p| p.met_until_s),
        Quantity::<Self>::optional("residual", Unit::NONE, "estimated error of the least accurate peak of any building", |p| p.residual),
        Quantity::<Self>::optional("sensitive_from_s", Unit::S, "time from which results depend on contacts that errors within the tolerance can make or miss", |p| p.sensitive_from_s),
    ];
}

impl PromiseSummary {
    /// The promise and its estimate in one line. Contact forces and impulses have no estimate of their own.
    #[must_use]
    pub fn in_words(&self) -> String {
        let tolerance = self.tolerance;
        let estimate = match (self.residual, self.met) {
            (Some(residual), Some(true)) => format!(
                "estimated numerical error of floor peaks and shears {} of the largest value (limit {})",
                percent(residual),
                percent(tolerance)
            ),
            (Some(residual), _) => format!(
                "estimated numerical error of floor peaks and shears {} of the largest value, above the limit of {}",
                percent(residual),
                percent(tolerance)
            ),
            (None, _) => "not estimated: the run did not end".to_owned(),
        };
        match (self.met_until_s, self.sensitive_from_s) {
            (Some(until), _) => format!(
                "accuracy: {estimate} until t = {until:.3} s; sensitive from there: an error below the tolerance decides whether contacts occur"
            ),
            (None, Some(from)) => {
                let earlier = match self.met {
                    Some(true) => "earlier peaks are reliable",
                    _ => "earlier impacts agree between two step sizes",
                };
                format!("accuracy: {estimate}; sensitive from t = {from:.3} s; {earlier}")
            }
            (None, None) => format!("accuracy: {estimate}"),
        }
    }
}

/// A fraction in per cent with two digits, such as `0.013 %`.
fn percent(fraction: f64) -> String {
    let value = 100.0 * fraction;
    if value < 1e-4 {
        return "below 0.0001 %".to_owned();
    }
    let decimals = (1.0 - libm::floor(libm::log10(value))).max(0.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if decimals > 0 {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    format!("{text} %")
}

/// Work done, and the time it took.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct WorkSummary {
    /// Solver, as spelt in model files.
    pub solver: &'static str,
    /// Accepted steps.
    pub steps: u64,
    /// Accepted steps with a closed contact.
    pub contact_steps: u64,
    /// Steps repeated at an event.
    pub repeated_steps: u64,
    /// Factorisations.
    pub factorizations: u64,
    /// Solutions.
    pub solves: u64,
    /// Newton iterations.
    pub iterations: u64,
    /// Iterations on springs that yield, one per trial step.
    pub outer_iterations: u64,
    /// Steps halved because those did not converge.
    pub halved_steps: u64,
    /// Multiply-adds spent on the forces of contacts and links.
    pub coupling_operations: u64,
    /// Shapes used by modal stepping; 0 for other solvers.
    pub shapes: u64,
    /// Runs repeated by modal stepping with more shapes or finer steps, to meet the tolerance.
    pub repeated_runs: u64,
    /// Regular free-vibration step \[s\].
    pub step_s: f64,
    /// Smallest regular step in contact; `null` without contact \[s\].
    pub contact_step_s: Option<f64>,
    /// Wall time of the stepping \[s\].
    pub wall_s: f64,
}

#[rustfmt::skip]
impl WorkSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("steps", "accepted steps", |w| w.steps as usize).in_study(),
        Quantity::<Self>::whole("contact_steps", "steps with a closed contact", |w| w.contact_steps as usize).in_study(),
        Quantity::<Self>::whole("repeated_steps", "steps repeated at an event", |w| w.repeated_steps as usize),
        Quantity::<Self>::whole("factorizations", "factorisations", |w| w.factorizations as usize).in_study(),
        Quantity::<Self>::whole("solves", "linear solutions", |w| w.solves as usize).in_study(),
        Quantity::<Self>::whole("iterations", "Newton iterations on contact forces", |w| w.iterations as usize).in_study(),
        Quantity::<Self>::whole("outer_iterations", "iterations for yielding springs, one per trial step", |w| w.outer_iterations as usize),
        Quantity::<Self>::whole("halved_steps", "steps halved because these iterations did not converge", |w| w.halved_steps as usize),
        Quantity::<Self>::whole("coupling_operations", "multiply-add operations for the forces of contacts and links", |w| w.coupling_operations as usize),
        Quantity::<Self>::whole("shapes", "mode shapes used by modal stepping; 0 for other solvers", |w| w.shapes as usize),
        Quantity::<Self>::whole("repeated_runs", "runs repeated with more shapes or finer steps", |w| w.repeated_runs as usize),
        Quantity::<Self>::real("step_s", Unit::S, "regular free-vibration step", |w| w.step_s),
        Quantity::<Self>::optional("contact_step_s", Unit::S, "smallest regular step in contact", |w| w.contact_step_s),
        Quantity::<Self>::real("wall_s", Unit::S, "wall time of the stepping", |w| w.wall_s),
    ];
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn errors_are_told_in_per_cent_with_two_digits() {
        for (fraction, text) in [
            (1.3e-4, "0.013 %"),
            (1e-3, "0.1 %"),
            (1e-2, "1 %"),
            (4.96e-4, "0.05 %"),
            (0.123, "12 %"),
            (1.0, "100 %"),
            (1.86e-6, "0.00019 %"),
            (1e-7, "below 0.0001 %"),
            (0.0, "below 0.0001 %"),
        ] {
            assert_eq!(percent(fraction), text);
        }
    }
}
