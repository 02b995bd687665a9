//! Soil on both sides of a floor that leaves gaps: springs of one side against linear ones and against an integration of their own.

use jostle::history::{Kind, Owner};
use jostle::hysteresis::{
    Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Pinching,
};
use jostle::{
    Building, Column, Damping, FloorPairs, FrameHinges, Hinges, Link, LinkLaw, Model, Outcome,
    Shear, Structure,
};
use jostle_testkit::motions::fading;

use crate::verification::support::{assembled, column, frame, framed, largest, run, steps};

const MASS: f64 = 200e3;
const OWN: f64 = 4e6;
const SOIL: f64 = 60e6;
const STRENGTH: f64 = 300e3;

fn link(law: LinkLaw, stiffness: f64, damping: f64) -> Link {
    Link {
        between: [Some(0); 2],
        floors: FloorPairs::listed(&[(0, 1)]),
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law,
        ..Link::default()
    }
}

fn gapping(strength: f64) -> [Hysteresis; 2] {
    let corners = Corners::bilinear(strength, 0.0);
    let backbone = Backbone::from_forces(SOIL, corners, corners).expect("sound");
    let pinching = Pinching {
        deformation: 1.0,
        force: 1.0,
        unloading_exponent: 0.0,
        ductility_damage: 0.0,
        energy_damage: 0.0,
    };
    let hysteresis = Hysteresis::new(HysteresisRule::Pinched(pinching), backbone).expect("it fits");
    let compression = hysteresis.in_compression().expect("pinched");
    [compression, compression.mirrored()]
}

fn shaken(links: Vec<Link>) -> Outcome {
    let model = Model {
        buildings: vec![Building {
            name: "Cellar".to_owned(),
            structure: Structure::Shear(Shear {
                mass: vec![MASS],
                stiffness: vec![OWN],
                storey_heights: vec![3.0],
            }),
            damping: Damping::Rayleigh {
                alpha: 0.2,
                beta: 0.0,
            },
            ..Building::default()
        }],
        links,
        ..Model::default()
    };
    let motion = fading("along", 9.0, [1.5, 3.0], 300);
    run(&assembled(&model), &motion, &steps(5e-4, 1))
}

/// Elastic soil that cannot pull, on both sides, is one linear spring.
#[test]
fn both_sides_together_are_a_linear_spring() {
    let without_tension = Hysteresis::without_tension(SOIL).expect("sound");
    let sides = [without_tension, without_tension.mirrored()]
        .map(|hysteresis| link(LinkLaw::Yielding(hysteresis), 0.0, 0.0));
    let [two, one] = [sides.to_vec(), vec![link(LinkLaw::Linear, SOIL, 0.0)]]
        .map(|links| column(&shaken(links), Column::displacement(0, 1)));
    let scale = largest(&one);
    for (two, one) in two.iter().zip(&one) {
        assert!((two - one).abs() < 1e-4 * scale, "{two:e} {one:e}");
    }
}

/// The other side of a one-sided law has its forces with the other sign, along any path, and what it dissipates.
#[test]
fn sides_are_mirror_images() {
    let [one, other] = gapping(STRENGTH);
    let (mut a, mut b) = (HysteresisMemory::default(), HysteresisMemory::default());
    let mut pressed = 0;
    for i in 0..3000 {
        let x = 1e-5 * f64::from(i) * (0.05 * f64::from(i)).sin();
        let (left, right) = (one.respond(&a, x), other.respond(&b, -x));
        assert_eq!(left.force, -right.force, "{i}");
        assert_eq!(
            (left.tangent, left.work),
            (right.tangent, right.work),
            "{i}"
        );
        assert!(left.force <= 0.0);
        pressed += usize::from(left.force < 0.0);
        (a, b) = (left.memory, right.memory);
    }
    assert!(pressed > 300, "{pressed}");
}

/// Pushed to and fro by the same amount, soil yields once on each side: 2 F_y (d − d_y) in all, and nothing afterwards.
#[test]
fn a_gap_is_crossed_without_force() {
    let (reach, first) = (0.02, STRENGTH / SOIL);
    let mut memories = [HysteresisMemory::default(); 2];
    let mut spent = [0.0_f64; 2];
    for cycle in 0..2 {
        for to in [reach, -reach, 0.0] {
            for (law, memory) in gapping(STRENGTH).iter().zip(&mut memories) {
                let reached = law.respond(memory, to);
                *memory = reached.memory;
                spent[cycle] += reached.work;
            }
        }
    }
    let due = 2.0 * STRENGTH * (reach - first);
    assert!((spent[0] / due - 1.0).abs() < 1e-12, "{} {due}", spent[0]);
    assert!(spent[1].abs() < 1e-9 * due, "{}", spent[1]);
}

/// A mass between soils that yield, against a hundred small steps for each of the run: indentations crushed so far, no more.
#[test]
fn gaps_follow_an_integration_of_their_own() {
    let dashpot = 0.4e6;
    let mut links: Vec<Link> = gapping(STRENGTH)
        .map(|gapping| link(LinkLaw::Yielding(gapping), 0.0, 0.0))
        .to_vec();
    links.push(link(LinkLaw::Linear, 0.0, dashpot));
    let outcome = shaken(links);
    let moved = column(&outcome, Column::displacement(0, 1));
    let times = column(&outcome, Column::TIME);
    let motion = fading("along", 9.0, [1.5, 3.0], 300);
    let (mut u, mut v, mut crushed) = (0.0_f64, 0.0_f64, [0.0_f64; 2]);
    let mut worst = 0.0_f64;
    let fine = 100;
    for (row, end) in times.iter().enumerate().skip(1) {
        let step = (end - times[row - 1]) / f64::from(fine);
        for part in 0..fine {
            let half = u + 0.5 * step * v;
            let mut soil = 0.0;
            for (sign, crushed) in [1.0, -1.0].into_iter().zip(&mut crushed) {
                let into = sign * half;
                *crushed = crushed.max(into - STRENGTH / SOIL);
                soil += sign * SOIL * (into - *crushed).max(0.0);
            }
            let at = times[row - 1] + (f64::from(part) + 0.5) * step;
            let damping = (0.2 * MASS + dashpot) * v;
            v -= step * (motion.acceleration(at) + (damping + OWN * half + soil) / MASS);
            u = half + 0.5 * step * v;
        }
        worst = worst.max((u - moved[row]).abs());
    }
    let scale = largest(&moved);
    assert!(crushed[0] > 1e-3 && crushed[1] > 1e-3, "{crushed:?}");
    assert!(worst < 2e-3 * scale, "{worst:e} of {scale:e}");
}

/// Columns yield at their feet beyond hinges, which are not the base: the link changes its length as the floor moves.
#[test]
fn hinges_at_feet_are_not_the_base() {
    let corners = Corners::bilinear(150e3, 0.02);
    let hinge = Backbone::from_forces(4e9, corners, corners)
        .and_then(|backbone| Hysteresis::new(HysteresisRule::Bilinear, backbone));
    let frame = frame(1, &[5.0]);
    let hinges = FrameHinges {
        columns: vec![vec![hinge.expect("sound"); 2]],
        ..FrameHinges::default()
    };
    let model = Model {
        buildings: vec![Building {
            hinges: Some(Hinges::Frame(hinges)),
            damping: Damping::Rayleigh {
                alpha: 0.2,
                beta: 0.0,
            },
            ..framed("A", frame)
        }],
        links: vec![link(LinkLaw::Linear, 2e6, 0.0)],
        ..Model::default()
    };
    let motion = fading("along", 9.0, [2.5, 3.0], 150);
    let outcome = run(&assembled(&model), &motion, &steps(5e-4, 1));
    let roof = outcome.peaks.floor(0, 1).displacement().size();
    let stroke = outcome
        .peaks
        .owned_by(Owner::Link(0))
        .of(Kind::Stroke)
        .size();
    assert!(
        roof > 0.0 && (stroke / roof - 1.0).abs() < 1e-3,
        "{stroke} {roof}"
    );
    assert!(!outcome.spring_events.is_empty());
}
