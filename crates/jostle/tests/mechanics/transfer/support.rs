//! Frames, loads and steps that the claims are tried on.

use jostle::structure::Discretization;
use jostle::structure::StepEquations;
use jostle::system::BuildingSystem;
use jostle::{Axial, Building, Frame, Joint, Shear, Structure};
use jostle_testkit::models::{self, UNDAMPED, concrete};

/// Depth of the square columns unless said otherwise \[m\].
pub(crate) const COLUMN: f64 = 0.5;

/// How a frame departs from the plain one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variant {
    AxiallyRigid,
    FlexibleColumns,
    FlexibleBeams,
    FlexibleMembers,
    Timoshenko,
    NoHinges,
    PDelta,
}

pub(crate) const VARIANTS: [Variant; 7] = [
    Variant::AxiallyRigid,
    Variant::FlexibleColumns,
    Variant::FlexibleBeams,
    Variant::FlexibleMembers,
    Variant::Timoshenko,
    Variant::NoHinges,
    Variant::PDelta,
];

/// Storeys of 3.2 m, four segments per storey and per beam, floors that carry 6 kPa over 3 m, hinges at the beam
/// ends.
pub(crate) fn frame(variant: Variant, spans: &[f64], storeys: usize, depth: f64) -> BuildingSystem {
    let beam = concrete(0.3, 0.6);
    let flexible = [Variant::FlexibleMembers, Variant::Timoshenko].contains(&variant);
    let building = Building {
        name: format!("{variant:?}"),
        structure: Structure::Frame(Frame {
            beam_mass: vec![beam.line_mass + 6000.0 * 3.0 / 9.81; storeys],
            column_segments: 4,
            beam_segments: vec![4; spans.len()],
            axial: Axial {
                columns_flexible: flexible || variant == Variant::FlexibleColumns,
                beams_flexible: flexible || variant == Variant::FlexibleBeams,
            },
            joint: Joint {
                rotational_stiffness: (variant != Variant::NoHinges).then_some(1.0),
                ..Joint::default()
            },
            ..models::frame(storeys, spans, concrete(depth, depth), beam)
        }),
        damping: UNDAMPED,
        ..Building::default()
    };
    let mut discretization = Discretization::new(&building);
    let stick_model = &mut discretization.stick_model;
    // Hinges of 50 times 6 EI/L of their bay.
    let lines: Vec<f64> = std::iter::once(0.0)
        .chain(spans.iter().scan(0.0, |x, span| {
            *x += span;
            Some(*x)
        }))
        .collect();
    for (index, hinge) in stick_model.hinges.iter_mut().enumerate() {
        // Two per beam, bay by bay.
        let span = spans[index / 2 % spans.len()];
        assert!(
            lines.contains(&stick_model.nodes[hinge.ends[0]].x),
            "hinges are at joints"
        );
        hinge.rotational_stiffness = Some(50.0 * 6.0 * beam.flexural_rigidity / span);
    }
    for member in &mut stick_model.members {
        let [a, b] = member.ends.map(|end| stick_model.nodes[end]);
        let vertical = a.x == b.x;
        match variant {
            Variant::Timoshenko => {
                // G = E/2.4, A_s = 5/6 A.
                member.shear_rigidity = member.axial_rigidity.map(|ea| ea / 2.4 * 5.0 / 6.0);
            }
            Variant::PDelta if vertical => {
                let storeys_above = storeys - (a.y.min(b.y) / 3.2 + 1e-9).floor() as usize;
                member.compression = 3e5 * storeys_above as f64;
            }
            _ => {}
        }
    }
    BuildingSystem::new(&building.name, discretization)
}

/// A shear building of unequal floors and storeys.
pub(crate) fn tower(storeys: usize) -> BuildingSystem {
    let building = Building {
        name: "tower".to_owned(),
        structure: Structure::Shear(Shear {
            mass: (0..storeys).map(|k| 2e5 + 1e4 * k as f64).collect(),
            stiffness: (0..storeys).map(|k| 3e8 - 1e7 * k as f64).collect(),
            storey_heights: vec![3.0; storeys],
        }),
        damping: UNDAMPED,
        ..Building::default()
    };
    BuildingSystem::new(&building.name, Discretization::new(&building))
}

/// κ and g of a Newmark step \[s\] with Rayleigh damping.
pub(crate) fn step_factors(
    [beta, gamma]: [f64; 2],
    step: f64,
    [mass, stiffness]: [f64; 2],
) -> (f64, f64) {
    let (a, c) = (1.0 / (beta * step * step), gamma / (beta * step));
    (1.0 + stiffness * c, a + mass * c)
}

/// Forces as they occur in a step: ground acceleration, unequal inertia, a few nodal loads.
pub(crate) fn step_load(building: &BuildingSystem, mass_factor: f64) -> Vec<f64> {
    scattered_load(building, mass_factor, 0.0)
}

/// One of many such loads.
pub(crate) fn scattered_load(building: &BuildingSystem, mass_factor: f64, phase: f64) -> Vec<f64> {
    let equations = &building.equations;
    let scatter = |k: usize, s: f64| (s * (k as f64 + 1.0) + phase).sin();
    (0..equations.len())
        .map(|k| {
            let inertia = 1e-3 * mass_factor * equations.mass[k] * scatter(k, 1.37);
            -2.0 * equations.driven_mass[k] + inertia + 1e4 * scatter(k, 0.71)
        })
        .collect()
}

/// Displacements by one of the solvers.
pub(crate) fn solution<E: StepEquations>(
    building: &BuildingSystem,
    (kappa, g): (f64, f64),
    load: &[f64],
) -> Vec<f64> {
    let solver = E::new(building);
    let mut factor = E::Factor::default();
    solver
        .factorize(&jostle::linear::StepMatrix::new(kappa, g), &[], &mut factor)
        .expect("the frame stands");
    let mut answer = load.to_vec();
    solver.solve(&factor, &mut answer, &mut E::Scratch::default());
    answer
}

/// Greatest difference, relative to the greatest expected magnitude; infinite where there is no number.
pub(crate) fn difference(got: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(got.len(), expected.len(), "as many values as expected");
    let largest = expected
        .iter()
        .fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let apart = got.iter().zip(expected).map(|(g, e)| (g - e).abs());
    apart.fold(0.0_f64, |most, apart| {
        if apart.is_nan() {
            f64::INFINITY
        } else {
            most.max(apart)
        }
    }) / largest
}
