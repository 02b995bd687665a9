//! A12 to A14: number, length and scale of records.

use super::{Known, Tally};
use crate::motion::{GroundMotion, Wave};

/// A record, not an analytic wave.
fn record<'a>(known: &Known<'a>) -> Option<(&'a GroundMotion, f64, &'a [f64])> {
    let motion = known.motion?;
    match &motion.wave {
        Wave::Sampled { step, acceleration } => Some((motion, *step, acceleration)),
        Wave::Sine { .. } | Wave::Ricker { .. } => None,
    }
}

/// Records that results are compared over.
pub(super) fn records(known: &Known<'_>, tally: &mut Tally<'_>) {
    let count = known.stated.records;
    let Some((motion, ..)) = record(known).filter(|_| count > 0) else {
        return;
    };
    tally.add(count as f64, || {
        let what = match count {
            1 => "one record with one sign".to_owned(),
            _ => format!("{count} records with one sign"),
        };
        let text =
            format!("{what}: not enough for a design value; codes require 3, 7 or 11 records");
        (motion.name.clone(), text)
    });
}

/// Share of the Arias intensity ∫a² dt of the record after the end of the analysis.
pub(super) fn cut(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((motion, step, acceleration)) = record(known) else {
        return;
    };
    let lost = lost(known);
    if lost == 0.0 {
        return;
    }
    tally.add(lost, || {
        let text = format!(
            "{}: ending at {:.1} s omits {:.0} % of the Arias intensity of a record of {:.1} s",
            motion.name,
            motion.duration,
            100.0 * lost,
            step * (acceleration.len() - 1) as f64
        );
        (motion.name.clone(), text)
    });
}

/// Share of the Arias intensity of the record after the end of the analysis \[–\].
pub(super) fn lost(known: &Known<'_>) -> f64 {
    let Some((motion, step, acceleration)) = record(known) else {
        return 0.0;
    };
    let kept = (motion.duration / step * (1.0 + 1e-12)).floor() as usize;
    let squares = |values: &[f64]| values.iter().map(|a| a * a).sum::<f64>();
    let after = acceleration.get(kept + 1..).unwrap_or_default();
    let all = squares(acceleration);
    if all > 0.0 { squares(after) / all } else { 0.0 }
}

/// Factor on the record, either sign.
pub(super) fn scale(known: &Known<'_>, tally: &mut Tally<'_>) {
    let Some((motion, ..)) = record(known) else {
        return;
    };
    let factor = motion.scale.abs();
    tally.add(factor, || {
        let text = format!("{}: the record is scaled by {factor:.2}", motion.name);
        (motion.name.clone(), text)
    });
}
