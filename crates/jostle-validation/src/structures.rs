//! Buildings made without a model file: frames given node by node, oscillators, free bodies.

use std::ops::ControlFlow;

use jostle::contact::ForceLaw;
use jostle::interface::Contact;
use jostle::stepping::{ContactSteps, simulate_from};
use jostle::structure::StepEquations;
use jostle::structure::{Discretization, Hinge, Member, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{
    GroundMotion, Outcome, Plan, Pounding, ProportionalDamping, RunEnd, Settings, Solver, State,
    System,
};
use jostle::{RiccatiFactor, RiccatiSweep};
use serde_json::Value;

use crate::data::{at, list, number};

/// Height of the one mass of oscillators and bodies \[m\].
const HEIGHT: f64 = 3.0;

/// A frame given by nodes and elements.
pub(crate) fn explicit_frame(name: &str, frame: &Value) -> BuildingSystem {
    let mut stick_model = StickModel::default();
    for node in list(frame, "/nodes") {
        let at = Node::at(number(node, "/x"), number(node, "/y"));
        let heavy = at.with_mass(number(node, "/m"));
        stick_model
            .nodes
            .push(heavy.with_rotary_inertia(number(node, "/J")));
    }
    for node in list(frame, "/fixed_nodes") {
        stick_model.nodes[index(node)].support = Support::Fixed;
    }
    for element in list(frame, "/elements") {
        let ends = [index(at(element, "/i")), index(at(element, "/j"))];
        let or_rigid = |path| at(element, path).as_f64();
        if at(element, "/type") == "beam" {
            stick_model.members.push(Member {
                ends,
                flexural_rigidity: number(element, "/EI"),
                axial_rigidity: or_rigid("/EA"),
                shear_rigidity: or_rigid("/GAs"),
                compression: number(element, "/P"),
            });
        } else {
            stick_model.hinges.push(Hinge {
                ends,
                rotational_stiffness: Some(number(element, "/Ktheta")),
                hysteresis: None,
                translational_stiffness: [or_rigid("/Kx"), or_rigid("/Ky")],
                dashpots: [0.0; 3],
                proportional_damping: ProportionalDamping::Initial,
            });
        }
    }
    let joints: Vec<Vec<usize>> = list(frame, "/floor_joint_nodes")
        .iter()
        .map(|floor| list(floor, "").iter().map(index).collect())
        .collect();
    let left_face: Vec<usize> = joints.iter().map(|floor| floor[0]).collect();
    let right_face = joints.iter().map(|floor| floor[floor.len() - 1]).collect();
    let discretization = Discretization {
        stick_model,
        floors: left_face.clone(),
        left_face,
        right_face,
        ..Discretization::default()
    };
    BuildingSystem::new(name, discretization)
}

fn index(value: &Value) -> usize {
    value.as_u64().expect("a node number") as usize
}

/// One mass \[kg\], on a spring \[N/m\] unless it is free.
fn single_mass(name: &str, mass: f64, stiffness: Option<f64>) -> BuildingSystem {
    let node = |y, mass, support| Node::at(0.0, y).with_mass(mass).held(support);
    let stick_model = StickModel {
        nodes: vec![
            node(0.0, 0.0, Support::Fixed),
            node(HEIGHT, mass, Support::Guided),
        ],
        springs: stiffness
            .map(|stiffness| Spring::elastic([0, 1], stiffness))
            .into_iter()
            .collect(),
        ..StickModel::default()
    };
    let discretization = Discretization {
        stick_model,
        floors: vec![1],
        left_face: vec![1],
        right_face: vec![1],
        ..Discretization::default()
    };
    BuildingSystem::new(name, discretization)
}

/// A body \[kg\] that nothing holds.
pub(crate) fn free_body(name: &str, mass: f64) -> BuildingSystem {
    single_mass(name, mass, None)
}

/// A mass \[kg\] on a spring \[N/m\] with a damping ratio \[–\].
pub(crate) fn oscillator(name: &str, mass: f64, stiffness: f64, ratio: f64) -> BuildingSystem {
    let mut building = single_mass(name, mass, Some(stiffness));
    building.structure.equations.alpha = 2.0 * ratio * (stiffness / mass).sqrt();
    building
}

/// Two buildings of one mass each and the contact between them.
pub(crate) fn pair(
    left: BuildingSystem,
    right: BuildingSystem,
    gap: f64,
    law: impl Fn(f64, f64) -> ForceLaw,
) -> System {
    let mut system = System::of_buildings(vec![left, right]);
    let contact = system
        .contact_between((0, 1), (1, 1))
        .expect("both have mass");
    system.contacts.push(Contact {
        width: gap,
        law: law(contact.ports.masses()[0], contact.ports.masses()[1]),
        ..contact
    });
    system
}

/// A motion without acceleration \[s\].
pub(crate) fn still(duration: f64) -> GroundMotion {
    GroundMotion {
        duration,
        ..GroundMotion::sampled("still", duration, vec![0.0, 0.0])
    }
}

/// A motion sampled from a formula.
pub(crate) fn sampled(step: f64, steps: usize, acceleration: impl Fn(f64) -> f64) -> GroundMotion {
    let values = (0..=steps).map(|k| acceleration(k as f64 * step)).collect();
    GroundMotion::sampled("formula", step, values)
}

/// Steps that are the same in free vibration and in contact.
pub(crate) fn uniform(step: f64) -> Plan {
    Plan {
        step,
        contact_steps: ContactSteps::Fixed(1),
        integrator: jostle::Integrator::default(),
        solver: Solver::Riccati,
        vertical: false,
        is_given: true,
        collapse_drift: jostle::model::COLLAPSE_DRIFT,
    }
}

/// Runs to the end of the motion, from rest with a = 0 unless another state is given.
pub(crate) fn run(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    state: Option<State>,
) -> Outcome {
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    let state = state.unwrap_or_else(|| State::at_rest(system, 0.0));
    let outcome = simulate_from(system, motion, plan, settings, state, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed, "a validation run ends");
    outcome
}

/// Displacements of a building under a static load.
pub(crate) fn static_answer(building: &BuildingSystem, mut load: Vec<f64>) -> Vec<f64> {
    let sweep = RiccatiSweep::new(building);
    let mut factor = RiccatiFactor::default();
    sweep
        .factorize(&jostle::linear::StepMatrix::STATIC, &[], &mut factor)
        .expect("the structure is supported");
    sweep.solve(&factor, &mut load, &mut Default::default());
    load
}
