//! What classes say on a terminal.

use std::fmt::Write;

use jostle_run::counted;

use super::curves::STATES;
use super::run::ClassesResults;

impl ClassesResults {
    /// What was run, how good the batches are, and how much pounding moves medians.
    #[must_use]
    pub fn text(&self) -> String {
        let touching = self.cases.iter().filter(|case| case.impacts > 0).count();
        let mut text = format!(
            "{}, {}, {}, {} stepped; impacts in {}\n",
            counted(self.pairs.len(), "pair"),
            counted(self.motions.len(), "motion"),
            counted(self.cases.len(), "case"),
            counted(self.rows, "row"),
            counted(touching, "case")
        );
        if !self.checked.is_empty() {
            let [drift, force] = self.worst_deviations();
            let _ = writeln!(
                text,
                "{} cases repeated with the standard solvers: drift within {drift:.2e}, force within {force:.2e}",
                self.checked.len(),
            );
        }
        let fitted = self.curves.iter().filter(|curve| curve.fit.is_ok()).count();
        let _ = writeln!(text, "{fitted} of {} curves fitted", self.curves.len());
        for (state, name) in STATES.iter().enumerate() {
            let factors: Vec<f64> = (0..self.curves.len())
                .filter(|at| self.curves[*at].state == state)
                .filter_map(|at| self.pounding_factor(at))
                .collect();
            let least = factors.iter().copied().fold(f64::INFINITY, f64::min);
            let most = factors.iter().copied().fold(0.0, f64::max);
            if !factors.is_empty() {
                let _ = writeln!(
                    text,
                    "median intensity of {name} damage with pounding over that without: {least:.3} to {most:.3}"
                );
            }
        }
        text
    }

    /// Greatest relative differences of drift and force between batches and runs in full \[–\].
    #[must_use]
    pub fn worst_deviations(&self) -> [f64; 2] {
        let all = self.checked.iter().map(super::Checked::deviations);
        all.fold([0.0, 0.0], |[a, b], [c, d]| [a.max(c), b.max(d)])
    }

    /// Median intensity of a curve with pounding over that of the same state without \[–\]: below 1, pounding brings the
    /// state about sooner. `None` if either has no curve.
    #[must_use]
    pub fn pounding_factor(&self, curve: usize) -> Option<f64> {
        let curve = self.curves.get(curve)?;
        curve.gap?;
        let alone = self.curves.iter().find(|other| {
            (other.pair, other.gap, other.state) == (curve.pair, None, curve.state)
        })?;
        Some(curve.fit.as_ref().ok()?.median / alone.fit.as_ref().ok()?.median)
    }
}
