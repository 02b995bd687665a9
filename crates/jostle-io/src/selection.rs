//! A set of motions held against a code, as JSON.

use jostle_motion::{Candidate, MainPeriod, Origin, SelectionCheck};
use serde_json::{Value, json};

/// The JSON of `jostle motion select`: periods, the spectra at them, every motion, and what is met.
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
    json!({
        "periods_s": periods.iter().map(|main| main.period).collect::<Vec<_>>(),
        "code_m_s2": of_mean(0),
        "mean_m_s2": of_mean(1),
        "mean_difference": of_mean(2),
        "motions": motions,
        "enough": check.enough,
        "mean_agrees": check.mean_agrees,
        "base_shear_agrees": check.base_shear_agrees,
        "long_enough": check.long_enough,
        "passes": check.passes(),
    })
}
