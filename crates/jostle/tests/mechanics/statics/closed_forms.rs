//! Plastic collapse loads, springs in series and P-Delta, as textbooks have them.

use jostle::hysteresis::{HysteresisRule, Stage};
use jostle::linear::StepMatrix;
use jostle::pushover::{LoadPattern, PushDirection, PushEnd};
use jostle::statics::STANDARD_GRAVITY;
use jostle::statics::{PathError, settle};
use jostle::stiffness::DirectStiffness;
use jostle::structure::solve_once;
use jostle::structure::{Discretization, Hinge, Member, Node, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{Base, Shear};

use crate::statics::support::{
    assembled, close, frame, hinged, plastic, pushed, shear_at, storeys, trilinear, under,
};

const STIFF: f64 = 1e10;
const RIGHT: PushDirection = PushDirection::Right;

#[test]
fn a_portal_with_weak_columns_collapses_at_four_plastic_moments() {
    let building = hinged(frame(1, &[6.0], 4000.0), Some(plastic(STIFF, 200e3)), None);
    for pattern in LoadPattern::ALL {
        let curve = pushed(&assembled(&building), pattern, RIGHT, 0.05);
        assert_eq!(curve.end, PushEnd::Target);
        close(curve.peak().base_shear, 4.0 * 200e3 / 3.2, 1e-12);
        // Four hinges, and a level plateau.
        close(
            curve.points.last().expect("points").base_shear,
            4.0 * 200e3 / 3.2,
            1e-12,
        );
    }
}

#[test]
fn a_portal_with_weak_beams_collapses_by_beam_and_foot_hinges() {
    let building = hinged(
        frame(1, &[6.0], 4000.0),
        Some(plastic(STIFF, 300e3)),
        Some(plastic(STIFF, 120e3)),
    );
    let curve = pushed(&assembled(&building), LoadPattern::Uniform, RIGHT, 0.05);
    close(
        curve.peak().base_shear,
        (2.0 * 300e3 + 2.0 * 120e3) / 3.2,
        1e-12,
    );
}

#[test]
fn a_frame_sways_by_beam_hinges_on_every_floor() {
    // Virtual work of the sway mechanism: Σ λ s_i h_i φ = φ (Σ feet + 2 Σ beams).
    let (storeys, bays) = (4, 2);
    let building = hinged(
        frame(storeys, &[5.0, 5.0], 4000.0),
        Some(plastic(STIFF, 900e3)),
        Some(plastic(STIFF, 100e3)),
    );
    let curve = pushed(&assembled(&building), LoadPattern::Triangular, RIGHT, 0.1);
    let work: f64 = curve
        .floor_loads
        .iter()
        .enumerate()
        .map(|(floor, share)| share * 3.2 * (floor + 1) as f64)
        .sum();
    let expected = ((bays + 1) as f64 * 900e3 + (2 * bays * storeys) as f64 * 100e3) / work;
    close(curve.peak().base_shear, expected, 1e-11);
}

#[test]
fn a_portal_on_yielding_footings_collapses_by_them_and_its_beam() {
    let mut building = hinged(frame(1, &[6.0], 4000.0), None, Some(plastic(STIFF, 120e3)));
    building.base = Base {
        rotational_stiffness: Some(4e8),
        rotational_hinge: Some(plastic(4e8, 150e3)),
        ..Base::default()
    };
    let curve = pushed(&assembled(&building), LoadPattern::Uniform, RIGHT, 0.05);
    close(
        curve.peak().base_shear,
        (2.0 * 150e3 + 2.0 * 120e3) / 3.2,
        1e-12,
    );
    // Footings that slide first: as many forces as columns, whatever stands on them.
    building.base.horizontal_stiffness = Some(2e8);
    building.base.horizontal_hinge = Some(plastic(2e8, 60e3));
    let curve = pushed(&assembled(&building), LoadPattern::Uniform, RIGHT, 0.05);
    close(curve.peak().base_shear, 2.0 * 60e3, 1e-12);
}

#[test]
fn first_yield_is_elastic_analysis_scaled() {
    let strength = 200e3;
    let building = assembled(&hinged(
        frame(3, &[4.0, 7.0], 4000.0),
        Some(plastic(5e7, strength)),
        Some(plastic(5e7, strength)),
    ));
    let forces = LoadPattern::Uniform.forces(&building).expect("mass");
    let elastic =
        solve_once::<DirectStiffness>(&building, &StepMatrix::STATIC, &forces).expect("it stands");
    let springs = building.equations.springs.iter();
    let greatest = springs
        .map(|spring| 5e7 * spring.deformation(&elastic).abs())
        .fold(0.0, f64::max);
    let curve = pushed(&building, LoadPattern::Uniform, RIGHT, 0.02);
    let first = curve.first(Stage::Yielded).expect("it yields");
    close(first.base_shear, strength / greatest, 1e-11);
    let roof = elastic[building.floors[2].dof];
    close(first.roof, roof * strength / greatest, 1e-11);
}

#[test]
fn storeys_are_springs_in_series() {
    let strengths = [900e3, 700e3, 380e3];
    let springs: Vec<_> = strengths
        .iter()
        .map(|strength| trilinear(HysteresisRule::PeakOriented, 150.0 * strength, *strength))
        .collect();
    let shear = Shear {
        mass: vec![50e3, 40e3, 30e3],
        stiffness: strengths.iter().map(|strength| 150.0 * strength).collect(),
        storey_heights: vec![4.0, 3.0, 3.0],
    };
    let building = assembled(&storeys(shear, springs.clone()));
    for (pattern, shares) in [
        (LoadPattern::Uniform, [50.0, 40.0, 30.0]),
        (
            LoadPattern::Triangular,
            [50.0 * 4.0, 40.0 * 7.0, 30.0 * 10.0],
        ),
    ] {
        let curve = pushed(&building, pattern, RIGHT, 0.03);
        let sum: f64 = shares.iter().sum();
        for point in &curve.points {
            let mut roof = 0.0;
            for (storey, spring) in springs.iter().enumerate() {
                let force = point.base_shear * shares[storey..].iter().sum::<f64>() / sum;
                let side = spring.backbone().side(jostle::hysteresis::Side::Positive);
                let (c, y) = (side.cracking, side.yielding);
                roof += if force <= c.force {
                    force / spring.backbone().initial()
                } else if force <= y.force {
                    c.deformation + (force - c.force) / side.post_cracking
                } else {
                    y.deformation + (force - y.force) / side.post_yield
                };
            }
            assert!(
                (roof - point.roof).abs() <= 1e-12 * curve.height,
                "{roof} {}",
                point.roof
            );
        }
    }
}

#[test]
fn weight_takes_its_share_of_a_storey() {
    // V h = F h − P Δ, until nothing is left.
    let (strength, mass, height) = (60e3, 80e3, 4.0);
    let stiffness = 5e6;
    let shear = Shear {
        mass: vec![mass],
        stiffness: vec![stiffness],
        storey_heights: vec![height],
    };
    let building = under(
        storeys(shear, vec![plastic(stiffness, strength)]),
        false,
        true,
    );
    let curve = pushed(&assembled(&building), LoadPattern::Uniform, RIGHT, 0.2);
    let weight = mass * STANDARD_GRAVITY;
    let at_yield = strength / stiffness;
    close(
        curve.peak().base_shear,
        strength - weight * at_yield / height,
        1e-12,
    );
    close(curve.peak().roof, at_yield, 1e-12);
    assert_eq!(curve.end, PushEnd::NoResistance);
    let last = curve.points.last().expect("points");
    close(last.roof, strength * height / weight, 1e-12);
    assert!(last.base_shear.abs() <= 1e-9 * strength);
}

#[test]
fn weight_takes_its_share_of_a_portal() {
    // The sway mechanism leans as a rigid body: V h = 4 Mp − P Δ.
    let moment = 200e3;
    let plain = hinged(frame(1, &[6.0], 20e3), Some(plastic(STIFF, moment)), None);
    let curve = pushed(
        &assembled(&under(plain, false, true)),
        LoadPattern::Uniform,
        RIGHT,
        0.05,
    );
    let weight = 20e3 * 6.0 * STANDARD_GRAVITY;
    let expected = |roof: f64| (4.0 * moment - weight * roof) / 3.2;
    for roof in [0.05, 0.1, 0.16] {
        close(shear_at(&curve, roof), expected(roof), 1e-9);
    }
}

/// A beam with hinges at both ends and in the middle, where it carries a mass.
fn clamped_beam(length: f64, mass: f64, moment: f64) -> BuildingSystem {
    let node = |x: f64, mass: f64, support| Node::at(x, 0.0).with_mass(mass).held(support);
    let half = 0.5 * length;
    let stick_model = StickModel {
        nodes: vec![
            node(0.0, 0.0, Support::Fixed),
            node(0.0, 0.0, Support::Free),
            node(half, mass, Support::Free),
            node(half, 0.0, Support::Free),
            node(length, 0.0, Support::Free),
            node(length, 0.0, Support::Fixed),
        ],
        members: [[1, 2], [3, 4]]
            .into_iter()
            .map(|ends| Member {
                ends,
                flexural_rigidity: 5e7,
                axial_rigidity: Some(1e9),
                shear_rigidity: None,
                compression: 0.0,
            })
            .collect(),
        hinges: [[1, 0], [3, 2], [5, 4]]
            .into_iter()
            .map(|ends| Hinge::yielding(ends, plastic(1e9, moment)))
            .collect(),
        springs: Vec::new(),
        ..StickModel::default()
    };
    let discretization = Discretization {
        stick_model,
        ..Discretization::default()
    };
    BuildingSystem::new("beam", discretization)
}

#[test]
fn a_clamped_beam_carries_eight_plastic_moments_over_its_length() {
    let (length, mass, moment) = (6.0, 1000.0, 100e3);
    let beam = clamped_beam(length, mass, moment);
    let collapse = 8.0 * moment / length / mass;
    let settled = settle(&beam, collapse * (1.0 - 1e-9)).expect("it carries");
    assert_eq!(settled.springs.len(), 3);
    let falls = settle(&beam, collapse * (1.0 + 1e-9)).expect_err("too much");
    assert!(matches!(falls, PathError::GivesWay(_)), "{falls}");
}

#[test]
fn a_storey_that_falls_while_the_roof_is_held_ends_the_push() {
    // Once the lower storey has yielded it loses m g per metre; the upper one, held at the roof, gives back half.
    let mass = 50e3;
    let push = mass * STANDARD_GRAVITY;
    let shear = Shear {
        mass: vec![mass; 2],
        stiffness: vec![10.0 * push, 0.625 * push],
        storey_heights: vec![2.0, 8.0],
    };
    let springs = vec![
        plastic(10.0 * push, 0.1 * push),
        plastic(0.625 * push, push),
    ];
    let building = assembled(&under(storeys(shear, springs), false, true));
    let curve = pushed(&building, LoadPattern::Uniform, RIGHT, 0.1);
    assert_eq!(curve.end, PushEnd::Mechanism { storey: 2 });
    // F₁ = V + P₁ Δ₁ / h₁ at yield, with Δ₁ = F₁ / k₁.
    close(curve.peak().base_shear, 0.1 * push - push * 0.01, 1e-12);
}
