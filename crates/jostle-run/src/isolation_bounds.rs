//! The same run at the lower and at the upper bound of the properties of bearings.

use jostle::results::isolation_bounds::{Bounded, BoundedBuilding, BoundedGap, IsolationBounds};
use jostle::results::summary::{BuildingSummary, GapSummary};
use jostle::{Model, Summary, System};

use crate::observer::{Observer, Stage};
use crate::prepared::Prepared;

/// The bounds, as messages call them.
const BOUNDS: [&str; 2] = ["at the lower bounds", "at the upper bounds"];

/// Runs at the lower and at the upper bound; `None` where the bearings are then as they were.
pub type RunsAtBounds = [Option<Summary>; 2];

impl Prepared {
    /// Runs the model at both bounds of its bearings, or says why that failed; `None` if it states none. `apart`: without contact as well.
    pub fn run_at_bounds(
        &self,
        apart: bool,
        observer: &mut Observer<'_>,
    ) -> Option<Result<RunsAtBounds, String>> {
        has_bounds(&self.input.model).then(|| at_bounds(self, apart, observer))
    }
}

/// Whether a model states bounds of bearings.
pub(crate) fn has_bounds(model: &Model) -> bool {
    let mut isolated = model
        .buildings
        .iter()
        .filter_map(|building| building.base.isolation.as_ref());
    isolated.any(|isolation| isolation.bounds.is_some())
}

fn at_bounds(
    prepared: &Prepared,
    apart: bool,
    observer: &mut Observer<'_>,
) -> Result<RunsAtBounds, String> {
    let mut one = |upper: bool| {
        let words = BOUNDS[usize::from(upper)];
        let model = at_bound(&prepared.input.model, upper);
        let other = prepared.with_model(model, words, System::assemble)?;
        let run =
            |other: Prepared| other.run_variant(words, apart, Stage::IsolationBounds, observer);
        other.map(run).transpose()
    };
    Ok([one(false)?, one(true)?])
}

/// The model with all bearings at one bound.
pub(crate) fn at_bound(model: &Model, upper: bool) -> Model {
    let mut model = model.clone();
    let bases = model
        .buildings
        .iter_mut()
        .map(|building| &mut building.base);
    for isolation in bases.filter_map(|base| base.isolation.as_mut()) {
        if let Some(bounds) = isolation.bounds {
            let factors = if upper { bounds.upper } else { bounds.lower };
            isolation.isolator = isolation.isolator.scaled(factors);
        }
    }
    model
}

/// Adds the runs at the bounds to the numbers of the run, or why they are missing.
pub fn add_bounds(summary: &mut Summary, found: &Result<RunsAtBounds, String>) {
    match found {
        Ok(runs) => summary.isolation_bounds = Some(compare(summary, runs)),
        Err(problem) => summary.warnings.push(format!(
            "there is no envelope over the bounds of bearings: {problem}"
        )),
    }
}

/// Puts the run beside those at the bounds.
fn compare(nominal: &Summary, bounds: &RunsAtBounds) -> IsolationBounds {
    let [lower, upper] = bounds.each_ref().map(|run| run.as_ref().unwrap_or(nominal));
    let runs = [nominal, lower, upper];
    let building = |index: usize| {
        let buildings = runs.map(|run| &run.buildings[index]);
        let isolated = |of: fn(&BuildingSummary) -> f64| {
            let has = buildings[0].isolation.is_some();
            has.then(|| Bounded::new(buildings.map(of)))
        };
        BoundedBuilding {
            name: buildings[0].name.clone(),
            stroke_m: isolated(stroke),
            force_n: isolated(force),
            drift: Bounded::new(buildings.map(BuildingSummary::greatest_drift)),
            storey_shear_n: Bounded::new(buildings.map(storey_shear)),
        }
    };
    let gap = |index: usize| {
        let gaps = runs.map(|run| &run.gaps[index]);
        let of = |value: fn(&GapSummary) -> f64| Bounded::new(gaps.map(value));
        BoundedGap {
            between: gaps[0].between.clone(),
            peak_force_n: of(|gap| gap.peak_force_n),
            impact_count: of(|gap| gap.impact_count as f64),
            closing_without_contact_m: needed(gaps),
        }
    };
    IsolationBounds {
        buildings: (0..runs[0].buildings.len()).map(building).collect(),
        gaps: (0..runs[0].gaps.len()).map(gap).collect(),
    }
}

/// Gap needed, where all three runs know it.
fn needed(gaps: [&GapSummary; 3]) -> Option<Bounded> {
    let [nominal, lower, upper] = gaps.map(|gap| gap.closing_without_contact_m);
    Some(Bounded::new([nominal?, lower?, upper?]))
}

/// Greatest shear of a storey, along x or across.
fn storey_shear(building: &BuildingSummary) -> f64 {
    let shears = building.floors.iter().map(|floor| {
        let across = floor
            .in_plan
            .map_or(0.0, |plan| plan.storey_shear_across_peak_n);
        floor.response.storey_shear_peak_n.max(across)
    });
    shears.fold(0.0, f64::max)
}

fn stroke(building: &BuildingSummary) -> f64 {
    let isolation = building.isolation.as_ref();
    isolation.map_or(0.0, |isolation| isolation.displacement_peak_m())
}

fn force(building: &BuildingSummary) -> f64 {
    let isolation = building.isolation.as_ref();
    isolation.map_or(0.0, |isolation| {
        let across = isolation
            .in_plan
            .map_or(0.0, |plan| plan.force_across_peak_n);
        isolation.force_peak_n.max(across)
    })
}
