//! Expected work of a run, its bound, and the size of its histories.

use super::recorder::columns;
use super::{Plan, Settings};
use crate::history::MemberHistory;
use crate::interface::{InterfaceGraph, LinkElement};
use crate::model::{Analysis, ModelFault, Solver};
use crate::motion::GroundMotion;
use crate::structure::{Element, Part, StickModel};
use crate::system::{BuildingSystem, RunGrounds, System};

/// Work of a step that does not depend on the displacements of a building, in displacements.
const OF_A_STEP: f64 = 20.0;

/// Work of a link in a step beside the equations that couple it, in displacements; more if it is not linear.
const OF_A_LINK: f64 = 5.0;
const OF_A_NONLINEAR_LINK: f64 = 300.0;

/// Work of a spring that yields in a step, in displacements.
const OF_A_SPRING: f64 = 5.0;

/// Iterations of Newton's method on links that are not linear.
const ITERATIONS: f64 = 3.0;

/// Multiply-adds of coupled links that take as long as a displacement.
const OPERATIONS: f64 = 13.0;

/// Computing time of one displacement in one step, for a rough estimate \[s\].
const TIME_OF_ONE: f64 = 2e-8;

/// Size of the histories of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistorySize {
    /// Expected rows, without those of closed contacts.
    pub rows: f64,
    /// Size of a row of all histories \[bytes\].
    pub row_bytes: f64,
    /// The part of [`History`](crate::History), without loops of springs and forces of members \[bytes\].
    pub table_bytes: f64,
}

impl HistorySize {
    /// Expected size \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> f64 {
        self.rows * self.row_bytes
    }
}

impl Plan {
    /// Expected work of a run: regular steps times displacements, plus a constant per step and building, springs that yield, and the
    /// equations of links and dampers. Steps in contact are not counted \[–\].
    #[must_use]
    pub fn expected_work(&self, system: &System, duration: f64) -> f64 {
        let springs = system.buildings.iter();
        let springs: usize = springs.map(|building| building.spring_range().len()).sum();
        let of_a_step = system.len() as f64
            + OF_A_STEP * system.buildings.len() as f64
            + OF_A_SPRING * springs as f64
            + work_of_links(system);
        (duration / self.step).ceil() * of_a_step
    }

    /// Greatest duration of a run whose tolerance asks for finer steps, relative to that of one pass with the steps of this plan; 1
    /// where steps are given, or exact between the points of a record \[–\].
    #[must_use]
    pub fn longest_refined(&self, system: &System, motion: &GroundMotion) -> f64 {
        let is_exact = matches!(self.solver, Solver::Modal | Solver::Series);
        if is_exact || !self.is_automatic(system, motion) {
            1.0
        } else {
            super::direct::longest()
        }
    }

    /// Expected size of the histories of a run with these settings; `None` if it records none.
    #[must_use]
    pub fn history_size(
        &self,
        system: &System,
        motion: &GroundMotion,
        settings: &Settings,
    ) -> Option<HistorySize> {
        let interval = settings.record_interval?;
        let steps = (motion.duration / self.step).ceil() * f64::from(settings.rows_per_step(self));
        let rows = steps.min(motion.duration / interval) + 1.0;
        let grounds = RunGrounds::new(system, motion);
        let springs = system.buildings.iter().map(|b| b.equations.springs.len());
        let columns = columns(system, &grounds).len();
        // Of springs deformation and force.
        let others = 2 * springs.sum::<usize>() + MemberHistory::width(system);
        Some(HistorySize {
            rows,
            row_bytes: (8 * (columns + others)) as f64,
            table_bytes: (8 * columns) as f64,
        })
    }
}

/// Work of all links in a step, in displacements: they are coupled where they act on the same building.
fn work_of_links(system: &System) -> f64 {
    if system.links.is_empty() {
        return 0.0;
    }
    let ports = system.links.iter().map(|link| &link.ports);
    let graph = InterfaceGraph::new(ports, system.buildings.len(), |building| building);
    let places: Vec<usize> = (0..system.links.len()).collect();
    let (mut stored, mut factor) = (0.0, 0.0);
    for (row, first) in graph.first_coupled(&places).enumerate() {
        let width = (row + 1 - first) as f64;
        stored += width;
        factor += 0.5 * width * width;
    }
    let nonlinear = system.links.iter().filter(|link| !link.is_linear()).count();
    let linear = (system.links.len() - nonlinear) as f64;
    let operations = match nonlinear {
        0 => 2.0 * stored,
        _ => ITERATIONS * (factor + 4.0 * stored),
    };
    operations / OPERATIONS + OF_A_LINK * linear + OF_A_NONLINEAR_LINK * nonlinear as f64
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
    let of_links = work_of_links(system);
    let displacements = system.len() as f64 + OF_A_STEP * system.buildings.len() as f64;
    let (path, cause) = match (analysis.step, shortest, motion.period()) {
        _ if of_links > displacements => (
            coupled_at(system),
            format!(
                "{} links and dampers take {:.0} % of it; dampers side by side on the same floors act as one of their sum",
                system.links.len(),
                100.0 * of_links / (of_links + displacements)
            ),
        ),
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

/// Where most links of a system are described: in the model, or as dampers of a building.
fn coupled_at(system: &System) -> String {
    let inside = |link: &&LinkElement| link.inside;
    let dampers = system.links.iter().filter(inside).count();
    let first = system.links.iter().find(inside);
    let first = first.and_then(|link| link.ports.buildings().into_iter().flatten().next());
    match first {
        Some(building) if 2 * dampers > system.links.len() => {
            format!("building[{building}].damper")
        }
        _ => "link".to_owned(),
    }
}

/// The shortest of the periods that determine automatic steps: the third lateral one, or the last of fewer \[s\].
fn relevant_period(building: &BuildingSystem) -> Option<f64> {
    let periods = building.lateral_modes().map(crate::eigen::Mode::period);
    periods.take(3).min_by(f64::total_cmp)
}

/// The greatest stiffness of a building in words.
fn stiffest(stick_model: &StickModel) -> String {
    let springs = stick_model.springs.iter().map(|spring| spring.stiffness);
    let elements = stick_model.elements.iter();
    let elements = elements.filter_map(|element| match element {
        Element::Spring {
            part: Part::Elastic,
            stiffness,
            ..
        } => Some(*stiffness),
        Element::Spring { .. } | Element::Matrix { .. } => None,
    });
    let springs = springs.chain(elements);
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
