//! Effect of a change of the gaps much smaller than the tolerance: whether results depend on a contact just made or
//! just missed.

use std::ops::ControlFlow;

use super::modal::Reduction;
use super::outcome::{OnProgress, Outcome, Progress, RunEnd};
use super::peak_change::{change_of_peaks, impacts};
use super::plan::Plan;
use super::simulate::simulate_like;
use crate::interface::Contact;
use crate::model::Solver;
use crate::motion::GroundMotion;
use crate::system::{BuildingSystem, System};

/// Greatest change of gaps, in tolerances of their greatest closing. The estimated error of a run is usually that of accelerations,
/// closings being known better.
const CHANGE: f64 = 0.1;

/// Change of the gap of a contact just missed or just made, in estimated errors of its greatest closing, but at most a tolerance.
const NARROWER: f64 = 2.0;

/// Its least value, in tolerances: touches are found by curves through both ends of a step, closings more accurately.
const LEAST_NARROWER: f64 = 0.02;

/// Fraction of the displacements of contact floors that counts as closing, since the closing of a gap of zero width
/// stays small.
const SWAY: f64 = 0.1;

/// Number of impacts above which small errors may multiply.
const FEW_IMPACTS: usize = 12;

/// Finds the instant from which results of a run depend on contacts made or missed within the tolerance, and stores
/// it in the outcome.
///
/// Each gap is made wider by the estimated error of the run, or by a tenth of the tolerance if that is less. Both count
/// relative to its greatest closing, or to a tenth of the displacement of the contact floors if that is more. The run
/// is repeated with the same steps. If reported peaks change by more than the tolerance, relative to the greatest of
/// their kind in the building or gap, the first impact that differs by as much gives the instant. How results hang on
/// the gap itself is another question. If the greatest closing of a contact is within twice the estimated error of the gap, the gap is
/// changed by as much, so that a contact just missed is made, and one just made is missed. Where the tolerance is not met and impacts
/// differ between two step sizes, the instant is not later than the first of these. Other runs with at most twelve
/// impacts, none of them doubtful or just made, are not repeated; nor are those of buildings that yield, unless they are stepped by
/// power series.
///
/// `shapes`: those that the run by modes began with, if they are at hand; they are found again without.
pub fn find_sensitivity(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    shapes: Option<&Reduction>,
    outcome: &mut Outcome,
    mut observer: impl FnMut(Progress) -> ControlFlow<()>,
) {
    let found = sensitive_from(system, motion, plan, shapes, outcome, &mut observer);
    if let Some(accuracy) = &mut outcome.accuracy {
        accuracy.sensitive_from = found;
    }
}

fn sensitive_from(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    shapes: Option<&Reduction>,
    outcome: &Outcome,
    observer: &mut OnProgress<'_>,
) -> Option<f64> {
    let tolerance = plan.tolerance();
    let doubtful = outcome.accuracy.and_then(|accuracy| accuracy.doubtful_from);
    let unmet = outcome
        .accuracy
        .is_some_and(|accuracy| accuracy.residual > tolerance);
    let unresolved = doubtful.filter(|_| unmet);
    let yields = |building: &BuildingSystem| {
        !building.equations.springs.is_empty() && plan.solver != Solver::Series
    };
    let error = outcome
        .accuracy
        .map_or(tolerance, |accuracy| accuracy.residual);
    let (wider, narrower) = (
        error.min(CHANGE * tolerance),
        (NARROWER * error).clamp(LEAST_NARROWER * tolerance, tolerance),
    );
    let decided: Vec<Option<f64>> = (0..system.contacts.len())
        .map(|contact| decided_otherwise(system, outcome, contact, narrower))
        .collect();
    let few = doubtful.is_none() && outcome.impacts.len() <= FEW_IMPACTS;
    if outcome.end != RunEnd::Completed
        || system.buildings.iter().any(yields)
        || (decided.iter().all(Option::is_none) && (outcome.impacts.is_empty() || few))
    {
        return unresolved;
    }
    let mut changed = system.clone();
    let contacts = changed.contacts.iter_mut().zip(&decided).enumerate();
    for (index, (contact, decided)) in contacts {
        let change = decided.unwrap_or(wider);
        let closing = outcome.peaks.closing(index).value;
        let scale = closing_scale(contact, closing, |building, floor| {
            outcome.peaks.sway(building, floor)
        });
        contact.width += change * contact.width.max(scale);
    }
    let other = simulate_like(outcome, &changed, motion, plan, shapes, observer);
    if other.end != RunEnd::Completed {
        return unresolved;
    }
    let runs = [outcome, &other];
    if change_of_peaks(system, runs) <= tolerance {
        return unresolved;
    }
    let parted = first_parted(system, runs, tolerance);
    let first = outcome.impacts.iter().map(|impact| impact.start);
    let earliest = parted.into_iter().chain(unresolved).min_by(f64::total_cmp);
    earliest.or(doubtful).or(first.min_by(f64::total_cmp))
}

/// What errors of the closing of a contact are relative to: its greatest closing, or a tenth of the displacement of its
/// floors if that is more \[m\]. `sway`: greatest displacement of a floor of a building, of its mat as floor 0, or of all its floors, for
/// a contact between them \[m\].
pub(super) fn closing_scale(
    contact: &Contact,
    closing: f64,
    sway: impl Fn(usize, Option<usize>) -> f64,
) -> f64 {
    let sides = contact.ports.buildings().into_iter();
    let sides = sides.zip(contact.ports.floors());
    let sways = sides.filter_map(|(building, floor)| Some(sway(building?, floor)));
    closing.max(SWAY * sways.fold(0.0, f64::max))
}

/// Change of the gap of a contact that makes it if it was just missed, and misses it if it was just made, relative to its greatest
/// closing; `None` where the change would have to exceed `most`.
fn decided_otherwise(system: &System, outcome: &Outcome, contact: usize, most: f64) -> Option<f64> {
    let (width, closing) = (
        system.contacts[contact].width,
        outcome.peaks.closing(contact).value,
    );
    let missed = impacts(outcome, contact).next().is_none();
    ((width - closing).abs() < most * width.max(closing)).then_some(if missed {
        -most
    } else {
        most
    })
}

/// Instant at which impacts of two runs first differ in force or impulse by more than the tolerance of the greatest of
/// their gap.
pub(super) fn first_parted(system: &System, runs: [&Outcome; 2], tolerance: f64) -> Option<f64> {
    (0..system.contacts.len())
        .filter_map(|contact| parted_at(system, runs, contact, tolerance))
        .min_by(f64::total_cmp)
}

/// Instant at which impacts of a contact first differ in force or impulse by more than the tolerance of the
/// greatest of its gap.
fn parted_at(
    system: &System,
    [a, b]: [&Outcome; 2],
    contact: usize,
    tolerance: f64,
) -> Option<f64> {
    let gap = system.contacts[contact].gap;
    let all = a
        .impacts
        .iter()
        .filter(|impact| system.contacts[impact.contact].gap == gap);
    let greatest = all.fold([0.0_f64; 2], |[force, impulse], impact| {
        [force.max(impact.peak_force), impulse.max(impact.impulse)]
    });
    let (mut first, mut second) = (impacts(a, contact), impacts(b, contact));
    loop {
        let (one, other) = match (first.next(), second.next()) {
            (Some(one), Some(other)) => (one, other),
            (one, other) => return one.or(other).map(|impact| impact.start),
        };
        let force = (one.peak_force - other.peak_force).abs() > tolerance * greatest[0];
        let impulse = (one.impulse - other.impulse).abs() > tolerance * greatest[1];
        if force || impulse {
            return Some(one.start.min(other.start));
        }
    }
}
