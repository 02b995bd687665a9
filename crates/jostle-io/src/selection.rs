//! The check of a set of motions by a code, as JSON.

use jostle_motion::{Candidate, MainPeriod, Origin, RuleKind, SelectionCheck};
use serde_json::{Value, json};

/// The JSON of `jostle motion select`: periods, the spectra at them, every motion, the rules of the code and which of
/// them are met.
#[must_use]
pub fn selection_json(set: &[Candidate], check: &SelectionCheck, periods: &[MainPeriod]) -> Value {
    let motions: Vec<Value> = set
        .iter()
        .enumerate()
        .map(|(i, candidate)| {
            json!({
                "name": candidate.name,
                "artificial": candidate.origin == Origin::Artificial,
                "pga_m_s2": candidate.motion.peak(),
                "ratios": check.ratios[i],
                "base_shear_ratio": check.base_shear[i],
                "effective_duration_s": check.effective_duration[i],
            })
        })
        .collect();
    let of_mean = |k: usize| check.mean.iter().map(|mean| mean[k]).collect::<Vec<_>>();
    let rules: Vec<Value> = check
        .rules
        .iter()
        .map(|rule| {
            json!({
                "clause": rule.clause,
                "found": rule.found,
                "asked": rule.asked,
                "met": rule.met,
            })
        })
        .collect();
    let mut value = json!({
        "code": check.code.clause(),
        "periods_s": periods.iter().map(|main| main.period).collect::<Vec<_>>(),
        "code_m_s2": of_mean(0),
        "mean_m_s2": of_mean(1),
        "mean_difference": of_mean(2),
        "motions": motions,
        "rules": rules,
        "notes": check.notes,
        "passes": check.passes(),
    });
    for (key, kind) in [
        ("enough", RuleKind::Count),
        ("mean_agrees", RuleKind::MeanAtPeriods),
        ("base_shear_agrees", RuleKind::BaseShear),
        ("long_enough", RuleKind::Duration),
        ("zero_period_suffices", RuleKind::ZeroPeriod),
        ("mean_suffices", RuleKind::MeanOverRange),
    ] {
        if let Some(met) = check.met(kind) {
            value[key] = met.into();
        }
    }
    value
}
