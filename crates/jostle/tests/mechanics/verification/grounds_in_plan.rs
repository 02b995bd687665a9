//! Ground that differs under buildings with a plan: the plane's answer where it applies, turned sites, two steppers, friction.

use std::f64::consts::PI;

use jostle::{
    Analysis, Bearing, Building, ContactLaw, Damping, Gap, GroundMotion, Grounds, LawKind,
    OwnGround, PlanPoint, Solver, Structure, Wave,
};
use jostle_testkit::models::CONCRETE;

use crate::verification::direct_in_space;
use crate::verification::grounds::arriving;
use crate::verification::space::{
    around_a_corner, changed, compare_with_the_plane, model, run, same, shaking, tower,
};

/// The second and third building of the corner are reached later, or shaken by another record.
fn differing(mut motion: GroundMotion) -> GroundMotion {
    let other = GroundMotion {
        duration: motion.duration,
        ..shaking("other", 6.1)
    };
    let grounds = vec![
        OwnGround::default(),
        OwnGround {
            arrival: 0.05,
            ..OwnGround::default()
        },
        OwnGround {
            motion: Some(other),
            ..OwnGround::default()
        },
    ];
    motion.grounds = Some(Box::new(Grounds { own: grounds }));
    motion
}

#[test]
fn delays_without_eccentricity_are_those_of_the_plane() {
    let law = |kind| ContactLaw { kind, ..CONCRETE };
    for kind in [LawKind::HertzDamp, LawKind::Restitution] {
        let motion = arriving(shaking("along", 7.0), &[0.0, 0.06]);
        compare_with_the_plane(law(kind), &motion);
    }
}

/// Along becomes across: both components of every ground, contacts, friction and ends of edges.
#[test]
fn a_site_turned_by_a_right_angle_has_the_same_impacts() {
    let (mut buildings, gaps, motion) = around_a_corner();
    for building in &mut buildings {
        building.damping = Damping::Rayleigh {
            alpha: 0.5,
            beta: 2e-3,
        };
    }
    let motion = differing(motion);
    let mut turned_motion = motion.clone();
    turned_motion.bearing.as_mut().expect("a bearing").angle += 0.5 * PI;
    let turned = changed(&buildings, |[x, y]| [-y, x], false, |[x, y, t]| [y, x, t]);
    for friction in [0.0, 0.3] {
        let mut gaps = gaps.clone();
        gaps.iter_mut()
            .for_each(|gap| gap.in_plan.friction = friction);
        let (_, one) = run(&model(buildings.clone(), gaps.clone()), &motion);
        let (_, other) = run(&model(turned.clone(), gaps), &turned_motion);
        assert!(one.energy.ground.abs() > 100.0, "{}", one.energy.ground);
        same(&one, &other, [0, 1, 2], "turned");
    }
}

/// Normals with both components: storeys as stiff both ways may stand at any angle.
#[test]
fn a_site_turned_by_any_angle_has_the_same_impacts() {
    let (mut buildings, gaps, motion) = around_a_corner();
    for building in &mut buildings {
        building.damping = Damping::Rayleigh {
            alpha: 0.5,
            beta: 2e-3,
        };
        make_isotropic(building);
    }
    let motion = differing(motion);
    let angle = 0.55_f64;
    let (sin, cos) = angle.sin_cos();
    let turn = |[x, y]: PlanPoint| [x * cos - y * sin, x * sin + y * cos];
    let turned = changed(&buildings, turn, false, |k| k);
    let mut turned_motion = motion.clone();
    turned_motion.bearing.as_mut().expect("a bearing").angle += angle;
    let (_, one) = run(&model(buildings, gaps.clone()), &motion);
    let (_, other) = run(&model(turned, gaps), &turned_motion);
    same(&one, &other, [0, 1, 2], "turned by 0.55 rad");
}

fn make_isotropic(building: &mut Building) {
    if let Structure::Tiers(tiers) = &mut building.structure {
        for storey in &mut tiers.storeys {
            storey.stiffness[1] = storey.stiffness[0];
        }
    }
}

/// Direct steps share neither equations nor steps with modes; with friction, whose slip the grounds take part in.
#[test]
fn direct_steps_on_differing_grounds_have_the_peaks_of_modes() {
    let (mut model, motion) = direct_in_space::around_a_corner(CONCRETE);
    let motion = differing(motion);
    for friction in [0.0, 0.4] {
        for gap in &mut model.gaps {
            gap.in_plan.friction = friction;
        }
        let steps = Analysis {
            tolerance: 1e-4,
            solver: Some(Solver::Riccati),
            ..Analysis::default()
        };
        let modes = Analysis {
            tolerance: 1e-5,
            ..Analysis::default()
        };
        let [direct, modal] =
            [steps, modes].map(|analysis| direct_in_space::run(&model, &motion, analysis).1);
        let error = direct_in_space::apart(&modal, &direct);
        assert!(error < 1e-4, "friction {friction}: {error}");
        let [a, b] = [&direct, &modal].map(|run| run.energy.ground);
        assert!(b.abs() > 100.0 && (a / b - 1.0).abs() < 1e-3, "{a}, {b} J");
        assert!(modal.energy.worst_imbalance < 1e-9);
        assert!(direct.energy.worst_imbalance < 1e-6);
    }
}

/// Delays change everything beyond the tolerance: none of these tests passes by leaving the grounds out.
#[test]
fn grounds_that_differ_matter() {
    let (buildings, gaps, motion) = around_a_corner();
    let (_, alike) = run(&model(buildings.clone(), gaps.clone()), &motion);
    let (_, apart) = run(&model(buildings, gaps), &differing(motion));
    assert_eq!(alike.energy.ground, 0.0);
    assert!(alike.face_impacts.len() != apart.face_impacts.len());
}

/// Two buildings that hardly move on grounds that do: the corner of one touches the edge of the other and slides off it when the
/// grounds have moved that far, a closed form of the double integral of the sine.
#[test]
fn grounds_carry_a_corner_off_its_edge() {
    let (gap, inside, rigid) = (2e-3, 0.02, [100e3, 1e12]);
    let law = ContactLaw {
        kind: LawKind::Linear,
        stiffness: 1e6,
        ..CONCRETE
    };
    let plan = [[0.0, 0.0], [10.0, 0.0], [10.0, 8.0], [0.0, 8.0]];
    let (x, y) = (10.0 + gap, 8.0 - inside);
    let wedge = [[x, y], [x + 10.0, y - 4.0], [x + 10.0, y]];
    let buildings = vec![
        tower("edge", 1, rigid, &plan, [0.0; 2]),
        tower("corner", 1, rigid, &wedge, [0.0; 2]),
    ];
    let sine = |amplitude: f64, bearing: Option<f64>| GroundMotion {
        name: "sine".to_owned(),
        scale: 1.0,
        duration: 0.5,
        wave: Wave::Sine {
            amplitude,
            period: 2.0,
        },
        bearing: bearing.map(|angle| {
            Box::new(Bearing {
                angle,
                across: None,
            })
        }),
        grounds: None,
    };
    // To the left and upwards alike.
    let ground = OwnGround {
        motion: Some(sine(1.0, Some(0.75 * PI))),
        ..OwnGround::default()
    };
    let mut motion = sine(1e-9, None);
    motion.grounds = Some(Box::new(Grounds {
        own: vec![OwnGround::default(), ground],
    }));
    let instant = |distance: f64| {
        let moved = |t: f64| (t - (PI * t).sin() / PI) / PI * 0.5_f64.sqrt();
        let (mut low, mut high) = (0.0, 0.5);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if moved(middle) < distance {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    let gaps = vec![Gap::between([Some(0), Some(1)], gap, law)];
    let model = model(buildings, gaps);
    for solver in [Solver::Modal, Solver::Riccati] {
        let analysis = Analysis {
            solver: Some(solver),
            tolerance: 1e-5,
            ..Analysis::default()
        };
        let (_, outcome) = direct_in_space::run(&model, &motion, analysis);
        let impact = outcome.impacts.first().expect("the corner touches");
        assert!(impact.sliding.slid_off, "{solver:?}: {impact:?}");
        for (got, expected) in [(impact.start, instant(gap)), (impact.end, instant(inside))] {
            assert!(
                (got - expected).abs() < 2e-5,
                "{solver:?}: {got}, {expected}"
            );
        }
    }
}
