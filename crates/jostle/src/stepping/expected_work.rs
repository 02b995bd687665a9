//! Expected work of a run, and its bound.

use super::Plan;
use crate::model::{Analysis, ModelFault};
use crate::motion::GroundMotion;
use crate::structure::StickModel;
use crate::system::{BuildingSystem, System};

/// Work of a step that does not depend on the displacements of a building, in displacements.
const OF_A_STEP: f64 = 20.0;

/// Computing time of one displacement in one step, for a rough estimate \[s\].
const TIME_OF_ONE: f64 = 2e-8;

impl Plan {
    /// Expected work of a run: regular steps times displacements, plus a constant per step and building. Steps in
    /// contact are not counted \[–\].
    #[must_use]
    pub fn expected_work(&self, system: &System, duration: f64) -> f64 {
        let of_a_step = system.len() as f64 + OF_A_STEP * system.buildings.len() as f64;
        (duration / self.step).ceil() * of_a_step
    }
}

/// The fault of a run with too much work: more work than [`Analysis::most_work`].
pub(super) fn too_long(
    plan: &Plan,
    system: &System,
    motion: &GroundMotion,
    analysis: &Analysis,
) -> Option<ModelFault> {
    let work = plan.expected_work(system, motion.duration);
    if work <= analysis.most_work {
        return None;
    }
    let shortest = system
        .buildings
        .iter()
        .enumerate()
        .filter_map(|(index, building)| Some((index, building, relevant_period(building)?)))
        .min_by(|a, b| a.2.total_cmp(&b.2));
    let (path, cause) = match (analysis.step, shortest, motion.period()) {
        (Some(_), ..) => (
            "analysis.step".to_owned(),
            "the step is fixed; use a longer one, or \"auto\"".to_owned(),
        ),
        (None, Some((index, building, period)), wave) if wave.is_none_or(|wave| period < wave) => (
            format!("building[{index}]"),
            format!(
                "a lateral period of \"{}\" is {period:.2e} s, with a mass of {:.3e} kg and {}; check the units of its stiffness and mass",
                building.name,
                building.equations.total_mass(),
                stiffest(&building.discretization.stick_model)
            ),
        ),
        _ => (
            "motion".to_owned(),
            "the step follows from the motion; shorten it".to_owned(),
        ),
    };
    Some(ModelFault {
        path,
        problem: format!(
            "the run would take {:.2e} steps of {:.2e} s for {} displacements, about {:.1e} hours of computing: {cause}; accept_unusual = true under [analysis] runs it anyway",
            (motion.duration / plan.step).ceil(),
            plan.step,
            system.len(),
            work * TIME_OF_ONE / 3600.0
        ),
    })
}

/// The shortest of the periods that determine automatic steps: the third lateral one, or the last of fewer \[s\].
fn relevant_period(building: &BuildingSystem) -> Option<f64> {
    let periods = building.lateral_modes().map(crate::eigen::Mode::period);
    periods.take(3).min_by(f64::total_cmp)
}

/// The greatest stiffness of a building in words.
fn stiffest(stick_model: &StickModel) -> String {
    let springs = stick_model.springs.iter().map(|spring| spring.stiffness);
    let springs = springs.chain(stick_model.couplings.iter().map(|c| c.stiffness));
    let members = stick_model
        .members
        .iter()
        .map(|member| member.flexural_rigidity);
    match members.max_by(f64::total_cmp) {
        Some(rigidity) => format!("EI up to {rigidity:.2e} N.m2"),
        None => format!(
            "storey stiffnesses up to {:.2e} N/m",
            springs.fold(0.0, f64::max)
        ),
    }
}
