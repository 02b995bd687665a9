//! Demand over capacity of the columns of a portal frame whose forces at every instant follow from statics: the axial force of
//! overturning changes moment and shear capacity at the instant of the moment itself.

use std::f64::consts::PI;

use jostle::model::{CapacityLine, MemberCapacity, RuleCapacity, ShearCapacity};
use jostle::results::summary::RatioSummary;
use jostle::{
    Analysis, Building, ContactLaw, Frame, Gap, GroundMotion, LawKind, MemberRequest, Model,
    RestitutionIs, Solver, Structure,
};
use jostle_testkit::models::{self, bending};
use jostle_testkit::runs::run_and_summary;

const HEIGHT: f64 = 4.0;
const SPAN: f64 = 2.5;
const COLUMN: f64 = 1.2e8;
const BEAM: f64 = 2.0e8;
const MASS: f64 = 30e3;
/// Compression of both columns at rest \[N\].
const CARRIED: f64 = 2.5e5;
/// Greatest ground acceleration to the left and then to the right \[m/s²\], and how long each takes \[s\].
const LOBES: [f64; 2] = [4.0, -2.7];
const LASTS: f64 = 10.0;

fn portal(name: &str) -> Building {
    let frame = Frame {
        storey_heights: vec![HEIGHT],
        beam_mass: vec![0.0],
        floor_mass: vec![MASS],
        column_segments: 1,
        beam_segments: vec![1],
        ..models::frame(1, &[SPAN], bending(COLUMN), bending(BEAM))
    };
    models::building(name, Structure::Frame(frame))
}

/// Moment and shear capacity of straight lines over the compression \[N·m, N\].
fn moment_capacity(compression: f64) -> f64 {
    1.4e5 + 0.25 * compression
}

fn shear_capacity(compression: f64) -> f64 {
    8e4 + 0.1 * compression + (6e4 + 0.05 * compression)
}

fn capacity(line: usize) -> MemberCapacity {
    let straight = |start: f64, slope: f64| {
        let at = |compression: f64| [compression, start + slope * compression];
        CapacityLine::new(vec![at(-4e5), at(1e6)])
    };
    let bending = straight(1.4e5, 0.25);
    MemberCapacity {
        member: format!("A.column.{line}.1"),
        compression_at_rest: CARRIED,
        follows_axial: true,
        axial_failure_drift: CapacityLine::default(),
        rotations: Vec::new(),
        rules: vec![RuleCapacity {
            rule: "by hand",
            shear: Some(ShearCapacity {
                steady: straight(8e4, 0.1),
                degrading: straight(6e4, 0.05),
                by_ductility: CapacityLine::default(),
                limit: f64::INFINITY,
            }),
            bending: [bending.clone(), bending],
            across: None,
        }],
    }
}

/// Ratios of both columns of building A, steps being given or chosen.
fn ratios(
    solver: Solver,
    motion: &GroundMotion,
    step: Option<f64>,
    capacities: [MemberCapacity; 2],
) -> Vec<RatioSummary> {
    let law = ContactLaw {
        kind: LawKind::Hertz,
        stiffness: 1e9,
        restitution: 1.0,
        restitution_is: RestitutionIs::Realised,
    };
    let mut members = MemberRequest::all();
    members.capacities = capacities.to_vec();
    let model = Model {
        title: "Portal".to_owned(),
        buildings: vec![portal("A"), portal("B")],
        gaps: vec![Gap::after(0, 5.0, law)],
        analysis: Analysis {
            members,
            solver: Some(solver),
            step,
            ..Analysis::default()
        },
        ..Model::default()
    };
    let (_, _, summary) = run_and_summary(&model, motion);
    let members = summary.buildings[0].members.iter();
    members
        .filter(|member| member.name.contains("column"))
        .filter_map(|member| member.ratio.clone())
        .collect()
}

/// EI_b/L over EI_c/h.
const K: f64 = BEAM / SPAN / (COLUMN / HEIGHT);

/// Kleinlogel's frame under a force *P* to the right at its beam: moment *P h*/2 · (3k + 1)/(6k + 1) at the feet, shear *P*/2,
/// axial forces ± 3 *P h k*/(*L* (6k + 1)), which press the right column (`side` 1).
fn under_force(force: f64, side: f64) -> [f64; 3] {
    let moment = (0.5 * force * HEIGHT * (3.0 * K + 1.0) / (6.0 * K + 1.0)).abs();
    let pressed = side * 3.0 * force * HEIGHT * K / (SPAN * (6.0 * K + 1.0));
    [moment, (0.5 * force).abs(), CARRIED + pressed]
}

fn slow() -> GroundMotion {
    let wave = (0..=200).map(|i| {
        let t = 0.1 * f64::from(i);
        let greatest = LOBES[usize::from(t > LASTS)];
        0.5 * greatest * (1.0 - (2.0 * PI * t / LASTS).cos())
    });
    GroundMotion::sampled("slow", 0.1, wave.collect())
}

/// The motion is a hundred times slower than the frame.
fn compare(solver: Solver) {
    let at = |acceleration: f64, side: f64| {
        let [moment, shear, compression] = under_force(-MASS * acceleration, side);
        [
            moment / moment_capacity(compression),
            shear / shear_capacity(compression),
        ]
    };
    let found = ratios(solver, &slow(), None, [1, 2].map(capacity));
    assert_eq!(found.len(), 2);
    for (ratio, side) in found.iter().zip([-1.0, 1.0]) {
        let greatest = |kind: usize| {
            // The ratio grows with the acceleration of a lobe: its peak counts.
            let peaks = LOBES.map(|acceleration| at(acceleration, side)[kind]);
            peaks[0].max(peaks[1])
        };
        let shear = ratio.shear.expect("given");
        for (found, due) in [(ratio.bending, greatest(0)), (shear, greatest(1))] {
            assert!((found / due - 1.0).abs() < 2e-3, "{found} instead of {due}");
        }
    }
    // The column in tension is weaker at the same moment: with the axial force at rest both would be equal.
    let [left, right] = [&found[0], &found[1]].map(|ratio| ratio.bending);
    assert!((left / right - 1.0).abs() > 0.2, "{left} and {right}");
}

#[test]
fn direct_runs_take_the_axial_force_of_the_instant() {
    compare(Solver::Riccati);
}

#[test]
fn modal_runs_take_the_axial_force_of_the_instant() {
    compare(Solver::Modal);
}

/// A column may lose its strength as its compression grows, while shear and moment stay far below their greatest values so far:
/// the second lobe is weaker than the first one, but presses the other column over the edge.
#[test]
fn modal_runs_follow_the_compression_alone() {
    const EDGE: f64 = 3e5;
    let strength = |compression: f64| if compression < EDGE { 3e5 } else { 1e4 };
    let found = ratios(
        Solver::Modal,
        &slow(),
        None,
        [1, 2].map(|line| {
            let mut capacity = capacity(line);
            let points = [-4e5, EDGE - 1.0, EDGE + 1.0, 1e6];
            let points = points.map(|compression| [compression, strength(compression)]);
            capacity.rules[0].shear = Some(ShearCapacity {
                steady: CapacityLine::new(points.to_vec()),
                degrading: CapacityLine::default(),
                by_ductility: CapacityLine::default(),
                limit: f64::INFINITY,
            });
            let even = CapacityLine::new(vec![[-4e5, 3e5], [1e6, 3e5]]);
            capacity.rules[0].bending = [even.clone(), even];
            capacity
        }),
    );
    // The strong lobe lifts the left column and presses the right one, or the other way round; the weak one the other.
    for (ratio, side) in found.iter().zip([-1.0, 1.0]) {
        let by_lobe = LOBES.map(|acceleration| {
            let [_, shear, compression] = under_force(-MASS * acceleration, side);
            assert!((compression - EDGE).abs() > 5e3);
            (compression > EDGE, shear)
        });
        let (_, due) = *by_lobe.iter().find(|(over, _)| *over).expect("one of them");
        let found = ratio.shear.expect("given");
        let off = (found / (due / 1e4) - 1.0).abs();
        assert!(off < 2e-3, "{found} instead of {}", due / 1e4);
    }
}

/// The ground starts with a constant acceleration: the force in the frame rises to nearly twice *m a*, with the damped period of
/// its stiffness 12 EI_c (6k + 1)/(h³ (3k + 2)), and swings about *m a*. The peak lies in the middle of a step: what counts
/// are four instants in each.
#[test]
fn modal_runs_look_within_their_steps() {
    const RATIO: f64 = 0.05;
    let stiffness = 12.0 * COLUMN * (6.0 * K + 1.0) / (HEIGHT.powi(3) * (3.0 * K + 2.0));
    let natural = (stiffness / MASS).sqrt();
    let damped = natural * (1.0 - RATIO * RATIO).sqrt();
    // The peak after half a period is in the middle of the eleventh step.
    let step = PI / damped / 10.5;
    let force = |acceleration: f64, t: f64| {
        let sine = RATIO / (1.0 - RATIO * RATIO).sqrt() * (damped * t).sin();
        let swing = (-RATIO * natural * t).exp() * ((damped * t).cos() + sine);
        -MASS * acceleration * (1.0 - swing)
    };
    let motion = |acceleration: f64| GroundMotion::sampled("sudden", step, vec![acceleration; 41]);
    let quarters = || (1..=160_u32).map(|quarter| (quarter, 0.25 * step * f64::from(quarter)));
    // Below the capacity: the greatest ratio in bending, and its instant.
    let acceleration = 2.4;
    let found = ratios(
        Solver::Modal,
        &motion(acceleration),
        Some(step),
        [1, 2].map(capacity),
    );
    for (ratio, side) in found.iter().zip([-1.0, 1.0]) {
        let at = |t: f64| {
            let [moment, _, compression] = under_force(force(acceleration, t), side);
            moment / moment_capacity(compression)
        };
        let greatest = |every: u32| {
            let instants = quarters().filter(|(quarter, _)| quarter % every == 0);
            let all = instants.map(|(_, t)| (t, at(t)));
            all.fold((0.0, 0.0), |best, candidate| {
                if candidate.1 > best.1 {
                    candidate
                } else {
                    best
                }
            })
        };
        let ((time, due), (_, at_ends)) = (greatest(1), greatest(4));
        assert!(
            at_ends < 0.996 * due && due < 1.0,
            "{at_ends} and {due} prove nothing"
        );
        let off = (ratio.bending / due - 1.0).abs();
        assert!(off < 1e-4, "{} instead of {due}", ratio.bending);
        let found = ratio.bending_at.at_s;
        assert!((found - time).abs() < 1e-9, "{found} instead of {time}");
        let due = under_force(force(acceleration, time), side)[2];
        let found = ratio.bending_at.compression_n;
        assert!((found / due - 1.0).abs() < 1e-3, "{found} instead of {due}");
    }
    // Beyond it: the first instant in shear.
    let acceleration = 10.0;
    let found = ratios(
        Solver::Modal,
        &motion(acceleration),
        Some(step),
        [1, 2].map(capacity),
    );
    for (ratio, side) in found.iter().zip([-1.0, 1.0]) {
        let exceeds = |(_, t): &(u32, f64)| {
            let [_, shear, compression] = under_force(force(acceleration, *t), side);
            shear > shear_capacity(compression)
        };
        let (quarter, due) = quarters().find(exceeds).expect("it does");
        assert!(quarter % 4 != 0, "the end of a step would prove nothing");
        let shear_at = ratio.shear_at.as_ref().expect("given");
        let found = shear_at.exceeded_s.expect("it does");
        assert!((found - due).abs() < 1e-9, "{found} instead of {due}");
    }
}
