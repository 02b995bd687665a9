//! Intensities that bracket the first impact under every record, so that curves of fragility have both outcomes.

use jostle::{Pounding, RunEnd, Settings};
use jostle_io::Input;
use jostle_run::CaseCache;

/// Intensities of a study.
const COUNT: i32 = 20;
/// From this part of the intensity at which the narrowest gap closes to that multiple of it at which the widest does.
const BEYOND: [f64; 2] = [0.5, 2.0];
/// Where nothing is known: a fifth of the shaking of the model to twice that.
const USUAL: [f64; 2] = [0.2, 2.0];

/// Multiples of the shaking of a model, evenly spaced by ratio, around those at which its gaps, as wide as these multiples of them,
/// would close if the buildings stayed as stiff as in a run without contact.
pub(super) fn shaking(input: &Input, widths: &[f64]) -> Vec<f64> {
    let records = input.each_record().into_iter();
    let closing = records
        .filter_map(closing_shakings)
        .filter(|[least, most]| *least > 0.0 && most.is_finite())
        .reduce(|[least, most], [other, farther]| [least.min(other), most.max(farther)]);
    let [from, to] = closing.map_or(USUAL, |[least, most]| {
        let narrowest = widths.iter().copied().fold(f64::INFINITY, f64::min);
        let widest = widths.iter().copied().fold(0.0, f64::max);
        [BEYOND[0] * narrowest * least, BEYOND[1] * widest * most]
    });
    let ratio = libm::log(to / from) / f64::from(COUNT - 1);
    let all = (0..COUNT).map(|k| from * libm::exp(ratio * f64::from(k)));
    all.map(two_digits).collect()
}

/// Shares of its shaking at which the first and the last gap of a model with one record close; `None` if a run without contact does
/// not end.
fn closing_shakings(input: Input) -> Option<[f64; 2]> {
    let gaps = input.model.gaps.len();
    let prepared = CaseCache::default().assemble(input).ok()?;
    let settings = Settings {
        pounding: Pounding::Excluded,
        ..prepared.settings(false)
    };
    let outcome = prepared.step(settings, |_| std::ops::ControlFlow::Continue(()));
    if outcome.end != RunEnd::Completed {
        return None;
    }
    let contacts = &prepared.system.contacts;
    let share_of = |gap: usize| {
        let of_gap = contacts.iter().enumerate();
        let of_gap = of_gap.filter(|(_, contact)| contact.gap == gap);
        let shares = of_gap.map(|(index, contact)| {
            contact.width / outcome.peaks.closing(index).value.max(f64::MIN_POSITIVE)
        });
        shares.fold(f64::INFINITY, f64::min)
    };
    let shares = (0..gaps).map(share_of);
    // Gaps that hardly close say nothing.
    let shares: Vec<f64> = shares.filter(|share| *share < 100.0).collect();
    let least = shares.iter().copied().fold(f64::INFINITY, f64::min);
    Some([least, shares.into_iter().fold(0.0, f64::max)])
}

/// Rounded to two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
