//! Buildings whose modes are known or compared.

use jostle::eigen::{Mode, modes_dense};
use jostle::linear::NotPositive;
use jostle::structure::{Discretization, Hinge, Member, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{Building, Frame, Joint, ProportionalDamping, Structure};
use jostle_testkit::models;
use jostle_testkit::models::UNDAMPED;
pub(crate) use jostle_testkit::models::concrete as section;
use nalgebra::DMatrix;
use serde_json::Value;

/// All modes from the eigenvalue solver of a library.
pub(crate) fn library_modes(building: &BuildingSystem) -> Result<Vec<Mode>, NotPositive> {
    modes_dense(building, |lower| {
        let n = lower.len();
        let matrix = DMatrix::from_fn(n, n, |i, j| lower[i.max(j)][i.min(j)]);
        let eigen = matrix.symmetric_eigen();
        let vectors = eigen.eigenvectors.column_iter();
        let vectors = vectors.map(|vector| vector.iter().copied().collect());
        Some(eigen.eigenvalues.iter().copied().zip(vectors).collect())
    })
}

/// Frames given node by node with frequencies from two independent eigenvalue programs.
pub(crate) fn stored_frames() -> Value {
    let text = include_str!("../../../../jostle-validation/data/theory/oracle_frames.json");
    serde_json::from_str(text).expect("the file is JSON")
}

pub(crate) fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} is a number"))
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter()
        .map(|entry| entry.as_f64().expect("a number"))
        .collect()
}

/// A stored frame; `compressed` scales the gravity that it carries.
pub(crate) fn stored_frame(frame: &Value, compressed: f64) -> BuildingSystem {
    let entries = |key: &str| frame[key].as_array().expect("a list").iter();
    let index = |value: &Value| value.as_u64().expect("a node") as usize;
    let mut stick_model = StickModel::default();
    stick_model.nodes.extend(entries("nodes").map(|node| {
        Node::at(number(node, "x"), number(node, "y"))
            .with_mass(number(node, "m"))
            .with_rotary_inertia(number(node, "J"))
    }));
    for node in entries("fixed_nodes") {
        stick_model.nodes[index(node)].support = Support::Fixed;
    }
    for element in entries("elements") {
        let ends = [index(&element["i"]), index(&element["j"])];
        if element["type"] == "beam" {
            stick_model.members.push(Member {
                ends,
                flexural_rigidity: number(element, "EI"),
                axial_rigidity: element["EA"].as_f64(),
                shear_rigidity: element["GAs"].as_f64(),
                compression: compressed * number(element, "P"),
            });
        } else {
            stick_model.hinges.push(Hinge {
                ends,
                rotational_stiffness: Some(number(element, "Ktheta")),
                hysteresis: None,
                dashpots: [0.0; 3],
                proportional_damping: ProportionalDamping::Initial,
                translational_stiffness: [element["Kx"].as_f64(), element["Ky"].as_f64()],
            });
        }
    }
    let floors = entries("floor_joint_nodes")
        .map(|joints| index(&joints[0]))
        .collect();
    assembled(stick_model, floors)
}

pub(crate) fn assembled(stick_model: StickModel, floors: Vec<usize>) -> BuildingSystem {
    let discretization = Discretization {
        stick_model,
        left_face: floors.clone(),
        right_face: floors.clone(),
        floors,
        ..Discretization::default()
    };
    BuildingSystem::new("building", discretization)
}

/// Stacks of floors (mass \[kg\], storey spring \[N/m\]) beside each other on one ground, without connection.
pub(crate) fn stacks(stacks: &[&[(f64, f64)]]) -> BuildingSystem {
    let mut stick_model = StickModel::default();
    let mut floors = Vec::new();
    for (line, floors_of_one) in stacks.iter().enumerate() {
        let mut node = |height: usize, mass, support| {
            let at = Node::at(10.0 * line as f64, 3.0 * height as f64);
            stick_model.nodes.push(at.with_mass(mass).held(support));
            stick_model.nodes.len() - 1
        };
        let mut below = node(0, 0.0, Support::Fixed);
        for (storey, &(mass, stiffness)) in floors_of_one.iter().enumerate() {
            let floor = node(storey + 1, mass, Support::Guided);
            if stiffness > 0.0 {
                stick_model
                    .springs
                    .push(Spring::elastic([below, floor], stiffness));
            }
            if line == 0 {
                floors.push(floor);
            }
            below = floor;
        }
    }
    assembled(stick_model, floors)
}

/// A shear building of equal storeys.
pub(crate) fn tower(storeys: usize, mass: f64, stiffness: f64) -> BuildingSystem {
    stacks(&[&vec![(mass, stiffness); storeys]])
}

/// A regular frame with elastic joints.
pub(crate) fn frame(storeys: usize, spans: &[f64]) -> Frame {
    Frame {
        column_segments: 3,
        beam_segments: vec![4; spans.len()],
        joint: Joint {
            rotational_stiffness: Some(2e9),
            ..Joint::default()
        },
        ..models::frame(storeys, spans, section(0.6, 0.6), section(0.3, 0.6))
    }
}

pub(crate) fn framed(frame: Frame) -> BuildingSystem {
    let building = Building {
        name: "frame".to_owned(),
        structure: Structure::Frame(frame),
        damping: UNDAMPED,
        ..Building::default()
    };
    BuildingSystem::new("frame", Discretization::new(&building))
}

/// Equal masses \[kg\] beside each other, each on a spring to the ground and joined to all others by springs \[N/m\].
pub(crate) fn joined(masses: usize, mass: f64, grounded: f64, joining: f64) -> BuildingSystem {
    let node = |x: usize, height: f64, mass, support| {
        let at = Node::at(2.0 * x as f64, height);
        at.with_mass(mass).held(support)
    };
    let mut stick_model = StickModel::default();
    stick_model.nodes.push(node(0, 0.0, 0.0, Support::Fixed));
    for index in 1..=masses {
        stick_model
            .nodes
            .push(node(index, 3.0, mass, Support::Guided));
        let spring = |from, stiffness| Spring::elastic([from, index], stiffness);
        stick_model.springs.push(spring(0, grounded));
        stick_model
            .springs
            .extend((1..index).map(|from| spring(from, joining)));
    }
    assembled(stick_model, vec![1])
}

/// Greatest relative error of the frequencies, over as many as are given in both.
pub(crate) fn deviation(modes: &[Mode], expected: &[f64]) -> f64 {
    let pairs = modes.iter().zip(expected);
    pairs
        .map(|(mode, expected)| (mode.circular_frequency / expected - 1.0).abs())
        .fold(0.0, f64::max)
}

/// Greatest entry of ΦᵀMΦ − 1 and of Λ^−½ ΦᵀKΦ Λ^−½ − 1.
pub(crate) fn disorder(building: &BuildingSystem, modes: &[Mode]) -> f64 {
    let equations = &building.equations;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut worst = 0.0_f64;
    for (j, a) in modes.iter().enumerate() {
        let pull = elastic_force(building, &a.shape);
        let inertia: Vec<f64> = a
            .shape
            .iter()
            .zip(&equations.mass)
            .map(|(s, m)| s * m)
            .collect();
        for (i, b) in modes.iter().enumerate() {
            let unit = f64::from(u8::from(i == j));
            let scale = a.circular_frequency * b.circular_frequency;
            worst = worst
                .max((dot(&inertia, &b.shape) - unit).abs())
                .max((dot(&pull, &b.shape) / scale - unit).abs());
        }
    }
    worst
}

/// Greatest entry of K φ − ω² M φ, relative to the elastic forces that balance in it.
pub(crate) fn imbalance(building: &BuildingSystem, mode: &Mode) -> f64 {
    let equations = &building.equations;
    let pull = elastic_force(building, &mode.shape);
    let (mut worst, mut most) = (0.0_f64, 0.0_f64);
    for (dof, shape) in mode.shape.iter().enumerate() {
        let inertia = mode.circular_frequency.powi(2) * equations.mass[dof] * shape;
        worst = worst.max((pull[dof] - inertia).abs());
        most = most.max(inertia.abs()).max(pull[dof].abs());
    }
    worst / most
}

fn elastic_force(building: &BuildingSystem, shape: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; shape.len()];
    building.equations.stiffness.multiply_add(shape, &mut force);
    building.equations.undamped.multiply_add(shape, &mut force);
    force
}
