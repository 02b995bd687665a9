//! What a path must not depend on.

use jostle::hysteresis::HysteresisRule;
use jostle::pushover::{LoadPattern, PushDirection};
use jostle::statics::EquilibriumPath;
use jostle::{Structure, model::Hinges};

use crate::statics::support::{assembled, close, frame, hinged, pushed, trilinear, under};

const RULES: [HysteresisRule; 4] = [
    HysteresisRule::PeakOriented,
    HysteresisRule::Takeda { exponent: 0.4 },
    HysteresisRule::Normal,
    HysteresisRule::DegradingTrilinear,
];

fn office(rule: HysteresisRule) -> jostle::Building {
    under(
        hinged(
            frame(5, &[2.4, 6.0], 5850.0),
            Some(trilinear(rule, 4e8, 350e3)),
            Some(trilinear(rule, 3e8, 220e3)),
        ),
        true,
        true,
    )
}

#[test]
fn pieces_of_any_length_make_the_same_path() {
    for rule in RULES {
        let building = assembled(&office(rule));
        let forces = LoadPattern::FirstMode.forces(&building).expect("a mode");
        let roof = building.floors[4].dof;
        let mut ends = Vec::new();
        for piece in [1.0_f64, 1e-3, 0.37e-3] {
            let mut walk = EquilibriumPath::driven(&building, &building.rest, forces.clone(), roof);
            let mut gone = 0.0;
            while 0.3 - gone > 1e-12 {
                walk.find_rates().expect("it stands");
                gone += walk
                    .advance(piece.min(0.3 - gone))
                    .expect("few corners")
                    .length;
            }
            ends.push((walk.load(), walk.displacement().to_vec()));
        }
        for (load, displacement) in &ends[1..] {
            close(*load, ends[0].0, 1e-9);
            let largest = displacement
                .iter()
                .fold(0.0_f64, |most, u| most.max(u.abs()));
            for (a, b) in displacement.iter().zip(&ends[0].1) {
                assert!((a - b).abs() <= 1e-9 * largest, "{a} {b}");
            }
        }
    }
}

#[test]
fn a_symmetric_frame_pushes_equally_both_ways() {
    let symmetric = under(
        hinged(
            frame(4, &[6.0, 2.4, 6.0], 5850.0),
            Some(trilinear(RULES[0], 4e8, 350e3)),
            Some(trilinear(RULES[0], 3e8, 220e3)),
        ),
        true,
        true,
    );
    let building = assembled(&symmetric);
    let [right, left] = [PushDirection::Right, PushDirection::Left]
        .map(|direction| pushed(&building, LoadPattern::FirstMode, direction, 0.03));
    assert_eq!(right.end, left.end);
    close(right.peak().base_shear, left.peak().base_shear, 1e-10);
    for roof in [0.01, 0.05, 0.1, 0.2, 0.35] {
        close(
            crate::statics::support::shear_at(&right, roof),
            crate::statics::support::shear_at(&left, roof),
            1e-9,
        );
    }
}

#[test]
fn a_mirrored_frame_pushed_left_is_the_frame_pushed_right() {
    let frame = office(RULES[1]);
    let mut mirrored = frame.clone();
    if let Structure::Frame(frame) = &mut mirrored.structure {
        frame.spans.reverse();
    }
    if let Some(Hinges::Frame(hinges)) = &mut mirrored.hinges {
        for row in hinges.columns.iter_mut().chain(&mut hinges.beams) {
            row.reverse();
        }
    }
    let right = pushed(
        &assembled(&frame),
        LoadPattern::Triangular,
        PushDirection::Right,
        0.03,
    );
    let left = pushed(
        &assembled(&mirrored),
        LoadPattern::Triangular,
        PushDirection::Left,
        0.03,
    );
    for roof in [0.01, 0.05, 0.1, 0.2, 0.35] {
        close(
            crate::statics::support::shear_at(&right, roof),
            crate::statics::support::shear_at(&left, roof),
            1e-9,
        );
    }
}

#[test]
fn the_load_is_what_the_base_feels() {
    // Base shear twice: as the sum of the load, and from the members that end at the ground.
    let building = assembled(&office(RULES[0]));
    let curve = pushed(&building, LoadPattern::Uniform, PushDirection::Right, 0.02);
    assert!(curve.points.len() > 20, "{} points", curve.points.len());
    for point in &curve.points[1..] {
        close(
            building.equations.base_shear(&point.displacement),
            point.base_shear,
            1e-8,
        );
    }
}

#[test]
fn random_frames_are_pushed_to_the_end_in_equilibrium() {
    let mut state = 7_u64;
    let mut random = |low: f64, high: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut ends = std::collections::BTreeMap::new();
    for case in 0..60 {
        let rule = RULES[case % 4];
        let storeys = random(1.0, 9.0) as usize;
        let spans: Vec<f64> = (0..random(1.0, 4.99) as usize)
            .map(|_| random(3.0, 8.0))
            .collect();
        let mut plain = frame(storeys, &spans, random(2e3, 9e3));
        plain.axial.columns_flexible = case % 3 == 0;
        plain.axial.beams_flexible = case % 5 == 0;
        let spring = |strength: f64, post_yield: f64| {
            let corners = jostle::hysteresis::Corners {
                cracking: 0.4 * strength,
                yielding: strength,
                post_cracking: 0.25,
                post_yield,
            };
            crate::statics::support::hinge(rule, 3e8, corners)
        };
        let post_yield = if case % 2 == 0 { 0.0 } else { 0.02 };
        let (column, beam) = (random(150e3, 700e3), random(250e3, 500e3));
        let framed = hinged(
            plain,
            Some(spring(column, post_yield)),
            Some(spring(beam, post_yield)),
        );
        let building = under(framed, true, case % 7 != 0);
        let mut system = jostle::system::BuildingSystem::new(
            "random",
            jostle::structure::Discretization::new(&building),
        );
        if system.put_under_gravity(building.gravity).is_err() {
            *ends
                .entry("too weak for its weight".to_owned())
                .or_insert(0) += 1;
            continue;
        }
        for pattern in LoadPattern::ALL {
            let curve = pushed(&system, pattern, PushDirection::Left, 0.04);
            *ends.entry(curve.end.to_string()).or_insert(0) += 1;
            assert!(
                !matches!(curve.end, jostle::pushover::PushEnd::Failed(_)),
                "case {case}: {}",
                curve.end
            );
            for point in &curve.points[1..] {
                let felt = -system.equations.base_shear(&point.displacement);
                let off = (felt - point.base_shear).abs() / curve.peak().base_shear;
                assert!(off < 1e-7, "case {case}: {off:e}");
            }
        }
    }
    println!("{ends:#?}");
}
