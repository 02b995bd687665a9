//! Buildings with a plan on the soil: springs of their base at the periods that these springs give.

use super::BuildingSystem;
use super::soil::{Ground, MOST_STEPS, SAME_PERIOD, damping_ratio};
use crate::model::{Base, BedSpring, Building, Foundation, Gravity, PlanFoundationSprings};
use crate::structure::Discretization;

/// The foundation of a building with a plan, and the soil under it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundationInPlan {
    /// Its dimensions; its length is along x.
    pub foundation: Foundation,
    /// Springs and dashpots under it.
    pub springs: PlanFoundationSprings,
    /// Periods of the fundamental modes along x and across on rigid ground \[s\].
    pub fixed_periods: [f64; 2],
    /// The same on its springs \[s\].
    pub periods: [f64; 2],
    /// Damping ratios of these modes on rigid ground \[–\].
    pub fixed_damping: [f64; 2],
    /// The same on springs and dashpots, φᵀCφ/(2ω φᵀMφ) \[–\].
    pub damping: [f64; 2],
}

impl FoundationInPlan {
    /// Springs of a building at its fundamental periods along x and across on these springs. `fixed`: on rigid ground.
    ///
    /// # Errors
    /// The field of the building, and what is wrong with it.
    pub(super) fn new(
        building: &Building,
        fixed: &BuildingSystem,
        foundation: &Foundation,
        ground: &Ground<'_>,
    ) -> Result<Self, (&'static str, String)> {
        let [fixed_periods, fixed_damping] = of_modes(fixed)?;
        let mut found = Self {
            foundation: *foundation,
            springs: PlanFoundationSprings::default(),
            fixed_periods,
            periods: fixed_periods,
            fixed_damping,
            damping: fixed_damping,
        };
        for _ in 0..MOST_STEPS {
            found.springs = springs_in_plan(ground, foundation, found.periods)
                .map_err(|problem| ("foundation", problem))?;
            let standing = Building {
                base: found.base(&building.base),
                ..building.clone()
            };
            let discretization = Discretization::new(&standing);
            let mut standing = BuildingSystem::new(&building.name, discretization);
            let leaning = Gravity {
                preload: false,
                ..building.gravity
            };
            standing
                .put_under_gravity(leaning)
                .map_err(|problem| (problem.field(), problem.to_string()))?;
            let [periods, _] = of_modes(&standing)?;
            let changes = periods
                .iter()
                .zip(found.periods)
                .map(|(new, old)| new / old);
            let changed = changes.map(|ratio| (ratio - 1.0).abs()).fold(0.0, f64::max);
            found.periods = periods;
            if changed <= SAME_PERIOD {
                break;
            }
        }
        Ok(found)
    }

    /// The base of a building, with the springs and dashpots of the soil.
    pub(super) fn base(&self, stated: &Base) -> Base {
        Base {
            elevation: stated.elevation,
            ..self.springs.base(&self.foundation)
        }
    }

    /// The same with the modes of the building that stands on it.
    pub(super) fn under(self, building: &BuildingSystem) -> Option<Self> {
        let [periods, damping] = of_modes(building).ok()?;
        Some(Self {
            periods,
            damping,
            ..self
        })
    }
}

/// Springs and dashpots of the ground under a foundation, at periods along x and across \[s\]. Rocking of one that can lift off is that
/// of its contact springs, and its vertical spring that at the longer period.
///
/// # Errors
/// Contact springs that the soil does not allow.
fn springs_in_plan(
    ground: &Ground<'_>,
    foundation: &Foundation,
    periods: [f64; 2],
) -> Result<PlanFoundationSprings, String> {
    let mut found = match ground {
        Ground::HalfSpace(soil) => soil.springs_in_plan(foundation, periods),
        Ground::Springs(_) | Ground::Given(_) => PlanFoundationSprings {
            along: ground.springs(foundation, periods[0]),
            across: ground.springs(&foundation.turned(), periods[1]),
            torsion: [
                foundation.torsional_stiffness.unwrap_or(0.0),
                foundation.torsional_damping.unwrap_or(0.0),
            ],
        },
    };
    if foundation.uplift.is_none() {
        return Ok(found);
    }
    let PlanFoundationSprings { along, across, .. } = &mut found;
    let slower = if periods[0] >= periods[1] {
        *along
    } else {
        *across
    };
    let rocking = [along.rocking_stiffness, across.rocking_stiffness];
    let rocking = matches!(ground, Ground::HalfSpace(_)).then_some(rocking);
    let bed = foundation.bed_in_plan(slower.vertical_stiffness, rocking)?;
    let arms: [fn(&BedSpring) -> f64; 2] = [|spring| spring.at, |spring| spring.across];
    for (springs, arm) in [along, across].into_iter().zip(arms) {
        springs.vertical_stiffness = slower.vertical_stiffness;
        springs.vertical_damping = slower.vertical_damping;
        let turned = bed.iter().map(|bed| bed.stiffness * arm(bed) * arm(bed));
        springs.rocking_stiffness = turned.sum();
        if rocking.is_none() {
            // Dashpots stand beside the springs, and share their sum as they do.
            let ratio = slower.vertical_damping / slower.vertical_stiffness;
            springs.rocking_damping = ratio * springs.rocking_stiffness;
        }
    }
    Ok(found)
}

/// Periods \[s\] and damping ratios \[–\] of the fundamental modes along x and across.
///
/// # Errors
/// A building without such modes.
fn of_modes(building: &BuildingSystem) -> Result<[[f64; 2]; 2], (&'static str, String)> {
    let mut found = [[0.0; 2]; 2];
    for (axis, mode) in building.fundamental_modes().into_iter().enumerate() {
        let mode = mode.ok_or_else(|| {
            let problem = "the building has no lateral mode in both directions on its foundation; are masses and springs right?";
            ("foundation", problem.to_owned())
        })?;
        found[0][axis] = mode.period();
        found[1][axis] = damping_ratio(&building.equations, mode);
    }
    Ok(found)
}
