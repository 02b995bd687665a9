//! Infill panels that fall out of their plane and leave the model.

use jostle::hysteresis::{
    Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Pinching,
};
use jostle::linear::StepMatrix;
use jostle::structure::solve_once;
use jostle::{
    Damping, Diagonal, DiagonalKind, DiagonalPlace, Frame, GroundMotion, MemberRequest, Model,
    PanelAcross, Reach, RiccatiSweep, Rise, Section, Solver, StrutLine,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::concrete;
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

use crate::verification::support::{assembled, frame, framed};

const STIFFNESS: f64 = 3e7;

/// Struts that stay elastic, or that crack, crush and pinch.
fn laws() -> [Hysteresis; 2] {
    let corners = Corners {
        cracking: 60e3,
        yielding: 110e3,
        post_cracking: 0.2,
        post_yield: 0.05,
    };
    let backbone = Backbone::from_forces(STIFFNESS, corners, corners).expect("sound");
    let both = Hysteresis::new(HysteresisRule::Pinched(Pinching::USUAL), backbone).expect("sound");
    [
        Hysteresis::without_tension(STIFFNESS).expect("sound"),
        both.in_compression().expect("pinched"),
    ]
}

fn panel(law: Hysteresis, storey: usize, limit: f64, offset: f64) -> [Diagonal; 2] {
    Rise::BOTH.map(|rise| Diagonal {
        place: DiagonalPlace {
            kind: DiagonalKind::Infill,
            line: None,
            storey,
            bay: 1,
            rise,
            reach: Reach::BAY,
            strut: StrutLine::Central,
        },
        stiffness: STIFFNESS,
        hysteresis: Some(law),
        offsets: [offset; 2],
        across: Some(PanelAcross {
            strength: 280.0 * limit,
            surface_mass: 280.0,
            falls: true,
        }),
        damage: None,
    })
}

fn undamped(frame: Frame) -> Model {
    let mut building = framed("A", frame);
    building.damping = Damping::Rayleigh {
        alpha: 0.0,
        beta: 0.0,
    };
    let mut model = Model {
        title: "falling panels".to_owned(),
        buildings: vec![building],
        ..Model::default()
    };
    model.analysis.members = MemberRequest::all();
    model
}

/// One floor, all mass in it.
fn one_floor() -> Frame {
    Frame {
        column_segments: 1,
        beam_segments: vec![1],
        beam_mass: vec![0.0],
        floor_mass: vec![60e3],
        columns: vec![Section {
            line_mass: 0.0,
            ..concrete(0.4, 0.4)
        }],
        ..frame(1, &[6.0])
    }
}

/// Lateral stiffness of its only floor, and its mass.
fn storey(bare: Frame) -> [f64; 2] {
    let system = assembled(&undamped(bare));
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    load[building.floors[0].dof] = 1.0;
    let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load);
    let stiffness = 1.0 / moved.expect("it stands")[building.floors[0].dof];
    [stiffness, building.equations.total_mass()]
}

/// What central differences give in steps of 5 µs.
struct Due {
    peaks: [f64; 2],
    fallen: f64,
    dissipated: f64,
    last: f64,
}

fn due(law: Hysteresis, limit: f64, motion: &GroundMotion, cosine: f64) -> Due {
    let [stiffness, mass] = storey(one_floor());
    let step = 5e-6;
    let mut memories = [HysteresisMemory::default(); 2];
    let (mut before, mut now) = (0.0, 0.0);
    let mut due = Due {
        peaks: [0.0; 2],
        fallen: f64::INFINITY,
        dissipated: 0.0,
        last: 0.0,
    };
    let mut work = 0.0;
    for index in 0..2_000_000_u32 {
        let time = step * f64::from(index);
        let mut pushes = stiffness * now;
        if due.fallen.is_infinite() {
            let mut struts = 0.0;
            for (memory, sense) in memories.iter_mut().zip([1.0, -1.0]) {
                let response = law.respond(memory, sense * cosine * now);
                *memory = response.memory;
                work += response.work;
                struts += sense * cosine * response.force;
            }
            let ground = motion.acceleration(time);
            let total = -(pushes + struts) / mass;
            if total.abs().max(ground.abs()) >= limit {
                (due.fallen, due.dissipated) = (time, work);
            } else {
                pushes += struts;
            }
        }
        due.peaks = [due.peaks[0].max(now), due.peaks[1].min(now)];
        let next = 2.0 * now - before - step * step * (pushes / mass + motion.acceleration(time));
        (before, now) = (now, next);
    }
    due.last = now;
    due
}

/// One floor whose panel falls when the floor reaches an acceleration: the same instant, the same motion after it, and all energy of its
/// struts is lost, by central differences with the same law of a strut and nothing else in common.
#[test]
fn a_storey_goes_on_without_its_panel() {
    let motion = fading("along", 9.0, [1.3, 2.6], 500);
    let bare = one_floor();
    let cosine = 6.0 / f64::hypot(bare.storey_heights[0], 6.0);
    for law in laws() {
        for limit in [7.5, 9.0] {
            let due = due(law, limit, &motion, cosine);
            assert!(due.fallen > 0.1 && due.fallen < 8.0, "{}", due.fallen);
            let mut infilled = bare.clone();
            infilled.diagonals = panel(law, 1, limit, 0.0).into();
            let mut model = undamped(infilled);
            model.analysis.step = Some(5e-5);
            let (system, outcome, summary) = runs::run_and_summary(&model, &motion);
            assert!(outcome.energy.worst_imbalance < 1e-6);
            let building = &summary.buildings[0];
            let floor = &building.floors[0].response;
            for (found, due) in [floor.displacement_max_m, floor.displacement_min_m]
                .into_iter()
                .zip(due.peaks)
            {
                // The instant of central differences is that of the next step.
                close(found, due, 0.02, 2e-5, "displacement");
            }
            let last = outcome.state.displacement[system.buildings[0].floors[0].dof];
            close(last, due.last, 0.02, 1e-3, "at the end");
            for part in &building.parts {
                let fallen = part.fallen_s.expect("it falls");
                assert!(
                    (fallen - due.fallen).abs() < 2e-5,
                    "{fallen} {}",
                    due.fallen
                );
            }
            let dissipated = building.parts.iter().map(|part| part.dissipated_j).sum();
            close(dissipated, due.dissipated, due.dissipated, 1e-3, "energy");
            assert!(
                summary
                    .warnings
                    .iter()
                    .any(|warning| warning.contains("fall out"))
            );
        }
    }
}

/// With steps that follow from the tolerance, by both solvers, whether struts end at joints or at points of columns without mass; and
/// a panel that never falls is one that cannot.
#[test]
fn panels_fall_at_the_same_instant_with_any_steps() {
    let motion = fading("along", 9.0, [2.5, 3.0], 500);
    let model = |limit: f64, falls: bool, offset: f64| {
        let mut frame = frame(3, &[6.0, 4.5]);
        for storey in 1..=3 {
            frame
                .diagonals
                .extend(panel(laws()[1], storey, limit, offset));
        }
        for diagonal in &mut frame.diagonals {
            let across = diagonal.across.as_mut().expect("it has one");
            across.falls = falls;
        }
        let mut model = undamped(frame);
        model.buildings[0].damping = Damping::Rayleigh {
            alpha: 0.4,
            beta: 5e-4,
        };
        model
    };
    for offset in [0.0, 0.3] {
        let mut fine = model(14.0, true, offset);
        fine.analysis.step = Some(5e-5);
        let mut coarse = model(14.0, true, offset);
        coarse.analysis.tolerance = 1e-3;
        let mut by_matrix = coarse.clone();
        by_matrix.analysis.solver = Some(Solver::Stiffness);
        let answers = [fine, coarse, by_matrix].map(|model| {
            let (_, outcome, summary) = runs::run_and_summary(&model, &motion);
            let imbalance = outcome.energy.worst_imbalance;
            assert!(imbalance < 1e-5, "{imbalance:e}");
            let building = &summary.buildings[0];
            let tops = building.floors.iter().flat_map(|floor| {
                [
                    floor.response.displacement_max_m,
                    floor.response.displacement_min_m,
                ]
            });
            let fallen: Vec<f64> = building
                .parts
                .iter()
                .filter_map(|part| part.fallen_s)
                .collect();
            (tops.collect::<Vec<f64>>(), fallen)
        });
        let [fine, others @ ..] = &answers;
        assert!(fine.1.len() >= 2, "{} struts fell", fine.1.len());
        for other in others {
            assert_eq!(fine.1.len(), other.1.len());
            for (a, b) in fine.1.iter().zip(&other.1) {
                assert!((a - b).abs() < 1e-3, "{a} {b}");
            }
            for (a, b) in fine.0.iter().zip(&other.0) {
                close(*b, *a, fine.0[4], 2e-3, "displacement");
            }
        }
    }
    let runs = [true, false].map(|falls| runs::run_and_summary(&model(1e3, falls, 0.0), &motion));
    assert_eq!(runs[0].1.state, runs[1].1.state);
    assert_eq!(runs[0].2.buildings, runs[1].2.buildings);
}
