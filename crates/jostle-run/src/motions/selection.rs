//! Whether a set of motions is suitable for time-history analysis.

use std::fmt::Write;

use jostle_io::selection_json;
use jostle_motion::{
    Candidate, MainPeriod, Origin, SelectionCheck, TargetSpectrum, check_selection,
};
use jostle_report::{SelectionPage, render_selection};
use serde_json::Value;

use super::{NamedMotion, wrong};
use crate::error::RunError;
use crate::style::{BOLD, LOUD, styled};

/// A set of motions, and what it is for.
#[derive(Clone, Debug)]
pub struct SelectionRequest {
    /// Recorded motions.
    pub natural: Vec<NamedMotion>,
    /// Artificial motions.
    pub artificial: Vec<NamedMotion>,
    /// Main periods of the structure, > 0; the longest is T1 \[s\].
    pub periods: Vec<f64>,
    /// Effective mass ratio of each period; empty for equal ones \[–\].
    pub mass_ratios: Vec<f64>,
    /// Damping ratio \[–\].
    pub damping: f64,
    /// Peak of every motion; by default that of the code for time histories \[m/s²\].
    pub pga: Option<f64>,
    /// Leave the motions as they are.
    pub unscaled: bool,
}

/// A set of motions, checked by the rules of a code.
#[derive(Clone, Debug)]
pub struct Selection {
    target: TargetSpectrum,
    damping: f64,
    periods: Vec<MainPeriod>,
    set: Vec<Candidate>,
    /// Every rule of the code and whether it is met.
    pub check: SelectionCheck,
}

impl Selection {
    /// Scales the motions and checks them.
    ///
    /// # Errors
    /// [`RunError::Argument`] without motions, or for a number outside its range.
    pub fn new(target: TargetSpectrum, request: SelectionRequest) -> Result<Self, RunError> {
        let peak = match request.pga {
            _ if request.unscaled => None,
            Some(peak) => Some(peak),
            None => target.peak_ground_acceleration(),
        };
        let ratios = &request.mass_ratios;
        if !ratios.is_empty() && ratios.len() != request.periods.len() {
            return Err(RunError::Argument(format!(
                "--mass-ratios: {} values for {} periods",
                ratios.len(),
                request.periods.len()
            )));
        }
        let pairs = request.periods.iter().enumerate();
        let periods: Vec<MainPeriod> = pairs
            .map(|(i, &period)| MainPeriod {
                period,
                mass_ratio: ratios.get(i).copied().unwrap_or(1.0),
            })
            .collect();
        let mut set = Vec::new();
        for (motions, origin) in [
            (request.natural, Origin::Natural),
            (request.artificial, Origin::Artificial),
        ] {
            for NamedMotion { name, motion } in motions {
                let motion = match peak {
                    Some(peak) => motion.scaled_to_peak(peak).map_err(wrong)?,
                    None => motion,
                };
                set.push(Candidate {
                    name,
                    motion,
                    origin,
                });
            }
        }
        if set.is_empty() {
            return Err(RunError::Argument(
                "no motions; name some with --natural and --artificial".into(),
            ));
        }
        let check = check_selection(&set, &target, &periods, request.damping).map_err(wrong)?;
        Ok(Self {
            target,
            damping: request.damping,
            periods,
            set,
            check,
        })
    }

    /// The JSON of `jostle motion select`.
    #[must_use]
    pub fn json(&self) -> Value {
        selection_json(&self.set, &self.check, &self.periods)
    }

    /// The page with charts.
    ///
    /// # Errors
    /// [`RunError::Argument`] if a spectrum cannot be computed.
    pub fn page(&self) -> Result<String, RunError> {
        render_selection(&SelectionPage {
            target: &self.target,
            damping: self.damping,
            periods: &self.periods,
            set: &self.set,
            check: &self.check,
        })
        .map_err(wrong)
    }

    /// The set in words.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!("{}\n", styled(BOLD, &self.target.name()));
        describe(&mut text, &self.set, &self.check, &self.periods);
        text
    }
}

fn describe(text: &mut String, set: &[Candidate], check: &SelectionCheck, periods: &[MainPeriod]) {
    // Writing to a string cannot fail.
    let _ = write!(text, "  {:32}", "response over code at T =");
    for main in periods {
        let _ = write!(text, "{:>9}", format!("{} s", main.period));
    }
    let _ = writeln!(text, "{:>12}{:>12}", "base shear", "duration");
    for (i, candidate) in set.iter().enumerate() {
        let name: String = candidate.name.chars().take(30).collect();
        let _ = write!(text, "  {name:32}");
        for ratio in &check.ratios[i] {
            let _ = write!(text, "{ratio:9.3}");
        }
        let duration = format!("{:.1} s", check.effective_duration[i]);
        let _ = writeln!(text, "{:12.3}{duration:>12}", check.base_shear[i]);
    }
    let _ = write!(text, "  {:32}", "mean");
    for [_, _, difference] in &check.mean {
        let _ = write!(text, "{:9.3}", 1.0 + difference);
    }
    let mean = check.base_shear.iter().sum::<f64>() / set.len() as f64;
    let _ = writeln!(text, "{mean:12.3}\n");
    let _ = writeln!(text, "  {}", check.code.clause());
    for rule in &check.rules {
        let verdict = if rule.met {
            "yes".to_owned()
        } else {
            styled(LOUD, "no ")
        };
        let _ = writeln!(
            text,
            "  {verdict}  {}: {} ({})",
            rule.found, rule.asked, rule.clause
        );
    }
    for note in &check.notes {
        let _ = writeln!(text, "       {note}");
    }
}
