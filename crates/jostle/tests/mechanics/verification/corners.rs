//! Corners that pass each other, and corners that slide off edges.

use std::f64::consts::PI;

use jostle::{
    Analysis, Bearing, Building, ContactLaw, Damping, Gap, GroundMotion, Impact, Model, Outcome,
    PlanPoint, Solver, Structure, System, Tier, TierStorey, Tiers, Wave,
};
use jostle_testkit::models::{CONCRETE, rectangle};
use jostle_testkit::runs;

const LAW: ContactLaw = ContactLaw {
    stiffness: 1.5e9,
    ..CONCRETE
};

/// A site turned by an angle about the origin.
#[derive(Clone, Copy)]
struct Site {
    angle: f64,
    mirrored: bool,
}

impl Site {
    fn point(self, [x, y]: PlanPoint) -> PlanPoint {
        let y = if self.mirrored { -y } else { y };
        let (sine, cosine) = self.angle.sin_cos();
        [x * cosine - y * sine, x * sine + y * cosine]
    }

    /// One storey, as stiff across as along.
    fn building(
        self,
        name: &str,
        [mass, stiffness]: [f64; 2],
        plan: &[PlanPoint],
        eccentricity: PlanPoint,
    ) -> Building {
        let mut plan: Vec<PlanPoint> = plan.iter().map(|p| self.point(*p)).collect();
        if self.mirrored {
            plan.reverse();
        }
        let tier = Tier::uniform(mass, plan).expect("an area");
        let aside = self.point(eccentricity);
        let storey = TierStorey {
            stiffness: [stiffness, stiffness, 14.0 * stiffness],
            centre: [tier.centre[0] + aside[0], tier.centre[1] + aside[1]],
        };
        Building {
            name: name.to_owned(),
            structure: Structure::Tiers(Tiers {
                floors: vec![tier],
                storeys: vec![storey],
                storey_heights: vec![3.0],
                ..Tiers::default()
            }),
            damping: Damping::Rayleigh {
                alpha: 0.5,
                beta: 3e-3,
            },
            ..Building::default()
        }
    }

    fn motion(self) -> GroundMotion {
        let wave = |name: &str, amplitude: f64, period: f64| GroundMotion {
            name: name.to_owned(),
            scale: 1.0,
            duration: 8.0,
            wave: Wave::Sine { amplitude, period },
            bearing: None,
            grounds: None,
        };
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        let mut across = wave("across", 1.5, 0.53);
        across.scale = sign;
        GroundMotion {
            bearing: Some(Box::new(Bearing {
                angle: sign * 0.3 + self.angle,
                across: Some(across),
            })),
            ..wave("along", 1.2, 0.68)
        }
    }
}

fn run(buildings: Vec<Building>, gaps: Vec<Gap>, site: Site, tolerance: f64) -> (System, Outcome) {
    let model = Model {
        title: "corners".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            solver: Some(Solver::Modal),
            tolerance,
            ..Analysis::default()
        },
        ..Model::default()
    };
    let (system, outcome) = runs::run(&model, &site.motion(), None);
    assert!(outcome.energy.worst_imbalance < 1e-10);
    (system, outcome)
}

/// A corner diagonally before the corner of another building, and a turned square with a corner before an edge, 15 mm from its
/// end.
fn corners(site: Site, friction: f64, swapped: bool) -> (System, Outcome) {
    let square = |x: f64, y: f64, r: f64| vec![[x, y - r], [x + r, y], [x, y + r], [x - r, y]];
    let buildings = vec![
        site.building(
            "middle",
            [150e3, 16.4e6],
            &rectangle(0.0, 0.0, 10.0, 8.0),
            [0.8, -0.5],
        ),
        site.building(
            "diagonal",
            [170e3, 41.9e6],
            &rectangle(10.015, 8.006, 9.0, 9.0),
            [-0.5, -0.6],
        ),
        site.building(
            "turned",
            [80e3, 30e6],
            &square(14.012, 0.015, 4.0),
            [0.2, 0.1],
        ),
    ];
    let gap = |a: usize, b: usize, width: f64| {
        let between = if swapped { [b, a] } else { [a, b] };
        let mut gap = Gap::between(between.map(Some), width, LAW);
        gap.in_plan.friction = friction;
        gap
    };
    let gaps = vec![gap(0, 1, 0.006), gap(0, 2, 0.012)];
    run(buildings, gaps, site, 1e-3)
}

const STRAIGHT: Site = Site {
    angle: 0.0,
    mirrored: false,
};

/// Contacts: two normals of the passing corners, one of the corner before the edge.
#[test]
fn passing_corners_have_two_normals_and_edges_have_ends() {
    let (system, outcome) = corners(STRAIGHT, 0.0, false);
    let normals: Vec<PlanPoint> = system
        .contacts
        .iter()
        .map(|contact| contact.plan.unwrap().normal)
        .collect();
    assert_eq!(normals, [[1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]);
    let ends: Vec<(usize, f64)> = system
        .edge_ends
        .iter()
        .map(|end| (end.contact, end.inside))
        .collect();
    // The other end of the edge is 8 m away.
    assert_eq!(ends.len(), 3);
    for ((contact, inside), expected) in ends.iter().zip([(0, -0.006), (1, -0.015), (2, 0.015)]) {
        assert_eq!(*contact, expected.0);
        assert!((inside - expected.1).abs() < 1e-12, "{inside}");
    }
    let of = |contact: usize| {
        outcome
            .impacts
            .iter()
            .filter(move |impact| impact.contact == contact)
    };
    let off = |contact: usize| of(contact).filter(|impact| impact.sliding.slid_off).count();
    assert!(of(0).count() + of(1).count() > 3 && off(0) + off(1) > 0);
    assert!(of(2).count() > 5, "{}", of(2).count());
    // One contact with two normals never presses along both.
    for a in of(0) {
        assert!(of(1).all(|b| b.end <= a.start || a.end <= b.start));
    }
}

fn listed(outcome: &Outcome, system: &System) -> Vec<Impact> {
    let mut impacts = outcome.impacts.clone();
    // Faces are numbered in the order of gaps and normals; their places are what two sites have in common.
    impacts.retain(|impact| system.contacts[impact.contact].plan.is_some());
    impacts.sort_by(|a, b| a.start.total_cmp(&b.start));
    impacts
}

#[test]
fn turned_and_mirrored_sites_have_the_same_corners() {
    for friction in [0.0, 0.3] {
        let (system, outcome) = corners(STRAIGHT, friction, false);
        let impacts = listed(&outcome, &system);
        let most = impacts
            .iter()
            .map(|impact| impact.peak_force)
            .fold(0.0, f64::max);
        for (what, site, swapped) in [
            (
                "turned by 30°",
                Site {
                    angle: PI / 6.0,
                    ..STRAIGHT
                },
                false,
            ),
            (
                "turned by 2 rad",
                Site {
                    angle: 2.0,
                    ..STRAIGHT
                },
                false,
            ),
            (
                "mirrored",
                Site {
                    mirrored: true,
                    ..STRAIGHT
                },
                false,
            ),
            ("named the other way", STRAIGHT, true),
        ] {
            let (system, other) = corners(site, friction, swapped);
            let other = listed(&other, &system);
            assert_eq!(impacts.len(), other.len(), "{what}, friction {friction}");
            for (a, b) in impacts.iter().zip(&other) {
                assert!((a.start - b.start).abs() < 1e-8, "{what}: {a:?} {b:?}");
                assert!(
                    (a.peak_force - b.peak_force).abs() < 1e-7 * most,
                    "{what}: {a:?} {b:?}"
                );
                assert_eq!(a.sliding.slid_off, b.sliding.slid_off, "{what}");
            }
        }
    }
}

/// The edge that ends against one that does not: nothing differs until the corner first slides off, which it does with its
/// force up, at the instant at which it is 40 mm from where it was.
#[test]
fn an_edge_is_felt_as_far_as_it_reaches() {
    let site = STRAIGHT;
    let square = vec![
        [14.012, -3.96],
        [18.012, 0.04],
        [14.012, 4.04],
        [10.012, 0.04],
    ];
    let both = |reach: f64| {
        // A longer edge, of the same mass, polar mass and centre.
        let mut first = site.building(
            "edge",
            [150e3, 16.4e6],
            &rectangle(0.0, 0.0, 10.0, 8.0),
            [0.8, -0.5],
        );
        if let Structure::Tiers(tiers) = &mut first.structure {
            tiers.floors[0].plan = rectangle(0.0, -reach, 10.0, 8.0 + reach);
        }
        let second = site.building("corner", [80e3, 30e6], &square, [0.2, 0.1]);
        run(
            vec![first, second],
            vec![Gap::between([Some(0), Some(1)], 0.012, LAW)],
            site,
            1e-6,
        )
    };
    let ((_, short), (_, long)) = (both(0.0), both(2.0));
    assert!(long.impacts.iter().all(|own| !own.sliding.slid_off));
    let first = short
        .impacts
        .iter()
        .position(|impact| impact.sliding.slid_off)
        .expect("it slides off");
    for (a, b) in short.impacts[..first].iter().zip(&long.impacts) {
        assert!(
            (a.peak_force - b.peak_force).abs() < 1e-6 * b.peak_force,
            "{a:?} {b:?}"
        );
    }
    let (off, on) = (&short.impacts[first], &long.impacts[first]);
    assert!(
        (off.start - on.start).abs() < 1e-8 && off.end < on.end,
        "{off:?} {on:?}"
    );
}
