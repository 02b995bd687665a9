//! Ground that differs under the buildings (theory, Eqs. B13 to B17), and vertical shaking.

use jostle::history::Column;
use jostle::model::LinkLaw;
use jostle::{
    Analysis, Building, ContactLaw, Damping, FloorPairs, Gap, GroundMotion, Grounds, LawKind,
    Level, Link, Model, Outcome, OwnGround, Plan, Settings, Solver, Structure, Summary, System,
    Wall, Wave,
};
use jostle_testkit::models::{CONCRETE, equal_storeys};
use jostle_testkit::runs::{completed, planned};

use crate::verification::support::{assembled, frame, framed};

const BOTH: [Solver; 2] = [Solver::Modal, Solver::Riccati];

/// Accelerations with a jump at the start, at equal steps.
fn record(step: f64, points: u32, seed: f64) -> GroundMotion {
    let value = |i: u32| {
        let t = f64::from(i) * step;
        3.0 * ((9.0 * t + seed).cos() + 0.6 * (23.0 * t).sin()) * (-0.25 * t).exp()
    };
    GroundMotion::sampled("record", step, (0..points).map(value).collect())
}

fn tower(name: &str, storeys: usize, stiffness: f64) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(equal_storeys(storeys, [4e4, stiffness])),
        damping: Damping::Rayleigh {
            alpha: 0.4,
            beta: 1e-3,
        },
        ..Building::default()
    }
}

fn law(kind: LawKind) -> ContactLaw {
    ContactLaw { kind, ..CONCRETE }
}

fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    Model {
        title: "grounds".to_owned(),
        buildings,
        gaps,
        ..Model::default()
    }
}

pub(crate) fn arriving(mut motion: GroundMotion, arrivals: &[f64]) -> GroundMotion {
    let grounds = arrivals.iter().map(|arrival| OwnGround {
        arrival: *arrival,
        ..OwnGround::default()
    });
    motion.grounds = Some(Box::new(Grounds {
        own: grounds.collect(),
    }));
    motion
}

fn run(system: &System, motion: &GroundMotion, solver: Solver) -> Outcome {
    run_within(1e-4, system, motion, solver)
}

/// Where balances are looked at: rounding of direct steps grows as they get shorter, with grounds that differ as without.
/// With the steps of the plan: finer ones see the balance at smaller energies of the first instants, and more of its rounding.
fn run_for_balance(system: &System, motion: &GroundMotion, solver: Solver) -> Outcome {
    let analysis = Analysis {
        solver: Some(solver),
        ..Analysis::default()
    };
    let plan = Plan {
        is_given: true,
        collapse_drift: jostle::model::COLLAPSE_DRIFT,
        ..planned(system, motion, &analysis)
    };
    completed(system, motion, &plan, Settings::default().record_interval)
}

fn run_within(tolerance: f64, system: &System, motion: &GroundMotion, solver: Solver) -> Outcome {
    let analysis = Analysis {
        solver: Some(solver),
        tolerance,
        ..Analysis::default()
    };
    let plan = planned(system, motion, &analysis);
    completed(system, motion, &plan, Settings::default().record_interval)
}

fn close(a: f64, b: f64, scale: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * scale, "{a} instead of {b}");
}

/// Two identical towers on one ground move alike; a delay alone makes them pound.
#[test]
fn identical_towers_pound_because_of_the_delay_alone() {
    let gap = Gap::between([Some(0), Some(1)], 0.012, law(LawKind::HertzDamp));
    let system = assembled(&model(
        vec![tower("A", 4, 3e7), tower("B", 4, 3e7)],
        vec![gap],
    ));
    for solver in BOTH {
        let alike = run_for_balance(&system, &record(0.02, 301, 0.4), solver);
        assert!(alike.impacts.is_empty());
        let delayed = arriving(record(0.02, 301, 0.4), &[0.0, 0.05]);
        let outcome = run_for_balance(&system, &delayed, solver);
        assert!(outcome.impacts.len() > 3, "{}", outcome.impacts.len());
        assert!(outcome.energy.ground.abs() > 1e-4 * outcome.energy.input);
        assert!(outcome.energy.worst_imbalance < 1e-9);
    }
}

/// A building answers to a delayed motion as to the motion itself, later: jumps where the record begins, corners off the
/// grid of steps, and no common divisor of them all.
#[test]
fn a_delay_shifts_the_response() {
    let system = assembled(&model(
        vec![tower("A", 3, 3e7), tower("B", 3, 2e7)],
        Vec::new(),
    ));
    let (whole, step) = (401, 0.02);
    let prompt = record(step, whole, 0.4);
    for delay in [0.06, 0.013_7, 0.000_9] {
        for solver in BOTH {
            let mut undelayed = prompt.clone();
            undelayed.duration -= delay;
            let early = run(&system, &undelayed, solver);
            let late = run(&system, &arriving(prompt.clone(), &[delay, 0.0]), solver);
            let tolerance = if solver == Solver::Modal { 1e-6 } else { 1e-4 };
            let scale = |of: fn(&jostle::history::PeaksOf<'_>) -> f64| {
                early.peaks.floors(0).iter().map(of).fold(0.0, f64::max)
            };
            for (a, b) in early.peaks.floors(0).iter().zip(&late.peaks.floors(0)) {
                let most = scale(|floor| floor.displacement_max().value);
                close(
                    b.displacement_max().value,
                    a.displacement_max().value,
                    most,
                    tolerance,
                );
                close(
                    b.displacement_max().at - delay,
                    a.displacement_max().at,
                    1.0,
                    20.0 * tolerance,
                );
                let most = scale(|floor| floor.total_acceleration());
                close(
                    b.total_acceleration(),
                    a.total_acceleration(),
                    most,
                    10.0 * tolerance,
                );
            }
            let ends = [&early, &late].map(|run| run.state.displacement[2]);
            close(
                ends[1],
                ends[0],
                scale(|floor| floor.displacement_max().value),
                tolerance,
            );
        }
    }
}

/// Buildings that start at once while the ground of the others still rests have not moved.
#[test]
fn nothing_moves_before_the_motion_arrives() {
    let system = assembled(&model(
        vec![tower("A", 2, 3e7), tower("B", 2, 3e7)],
        Vec::new(),
    ));
    let mut motion = record(0.02, 301, 0.4);
    motion.duration = 1.0;
    for solver in BOTH {
        let outcome = run(&system, &arriving(motion.clone(), &[0.0, 1.0]), solver);
        assert!(outcome.peaks.floor(0, 2).displacement_max().value > 1e-3);
        assert_eq!(outcome.peaks.floor(1, 2).displacement_max().value, 0.0);
        assert_eq!(outcome.peaks.floor(1, 2).total_acceleration(), 0.0);
    }
}

/// Whatever joins the buildings, modes and Riccati's recursion agree and the work of the grounds closes the balance.
#[test]
fn energy_closes_with_contacts_links_and_momentum_laws() {
    let link = |law: LinkLaw, stiffness: f64, damping: f64| Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::Listed(vec![[Level::Floor(2), Level::Floor(2)]]),
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law,
        ..Link::default()
    };
    let cases = [
        (LawKind::Linear, Some(link(LinkLaw::Linear, 4e6, 2e5)), true),
        (LawKind::Restitution, None, true),
        (
            LawKind::Restitution,
            Some(link(LinkLaw::Linear, 0.0, 3e5)),
            true,
        ),
        (
            LawKind::HertzDamp,
            Some(link(LinkLaw::Viscous { exponent: 0.5 }, 5e7, 1e5)),
            false,
        ),
        (
            LawKind::HertzDamp,
            Some(link(LinkLaw::Viscous { exponent: 0.35 }, 0.0, 1e5)),
            false,
        ),
        (
            LawKind::HertzDamp,
            Some(link(LinkLaw::Maxwell, 2e7, 5e5)),
            false,
        ),
        (
            LawKind::HertzDamp,
            Some(link(
                LinkLaw::Friction {
                    slip_force: 3e4,
                    stick_stiffness: 3e7,
                },
                0.0,
                0.0,
            )),
            false,
        ),
        (
            LawKind::HertzDamp,
            Some(link(LinkLaw::Cable { slack: 5e-3 }, 2e7, 0.0)),
            false,
        ),
    ];
    let motion = arriving(record(0.02, 251, 0.4), &[0.0, 0.037]);
    for (kind, link, is_linear) in cases {
        let gap = Gap::between([Some(0), Some(1)], 0.01, law(kind));
        let mut pair = model(vec![tower("A", 4, 3e7), tower("B", 3, 4e7)], vec![gap]);
        pair.links.extend(link);
        let system = assembled(&pair);
        let outcomes: Vec<Outcome> = BOTH
            .into_iter()
            .filter(|solver| is_linear || *solver != Solver::Modal)
            .map(|solver| run_for_balance(&system, &motion, solver))
            .collect();
        for outcome in &outcomes {
            assert!(!outcome.impacts.is_empty());
            assert!(outcome.energy.ground != 0.0);
            let worst = outcome.energy.worst_imbalance;
            assert!(worst < 1e-9, "{kind:?}: {worst}");
            // What the balance says of links, each link says of itself.
            let plan = planned(&system, &motion, &pair.analysis);
            let summary = Summary::new(&jostle::Run {
                model: &pair,
                system: &system,
                motion: &motion,
                plan: &plan,
                outcome,
                without_contact: None,
                wall: 0.0,
            });
            let taken: f64 = summary.links.iter().map(|link| link.dissipated_j).sum();
            let balance = outcome.energy.links + outcome.energy.hysteretic;
            close(taken, balance, outcome.energy.input, 1e-9);
        }
        if let [modal, direct] = &outcomes[..] {
            assert_eq!(modal.impacts.len(), direct.impacts.len(), "{kind:?}");
            for link in 0..system.links.len() {
                let of = |run: &Outcome| {
                    let force = run.peaks.of(Column::link_force(link)).furthest().value;
                    [force, run.peaks.of(Column::link_stroke(link)).size()]
                };
                let ([force, stroke], [other_force, other_stroke]) = (of(modal), of(direct));
                close(other_force, force, force.abs(), 2e-3);
                close(other_stroke, stroke, stroke, 1e-3);
            }
            close(
                direct.energy.ground,
                modal.energy.ground,
                modal.energy.input,
                1e-3,
            );
            let first = [modal, direct].map(|run| run.impacts[0].impact_speed);
            close(first[1], first[0], first[0], 2e-3);
        }
    }
}

/// A rigid wall on the ground of its neighbour moves with it; on a ground of its own it comes closer.
#[test]
fn walls_stand_on_their_own_ground() {
    let mut beside = model(vec![tower("A", 2, 3e7)], Vec::new());
    beside.walls.push(Wall {
        name: "moat".to_owned(),
        stiffness: None,
        damping: 0.0,
        mass: 0.0,
        line: None,
    });
    let mut gap = Gap::between([Some(0), Some(1)], 1.0, law(LawKind::Linear));
    gap.floors = FloorPairs::Listed(vec![[Level::Floor(2), Level::Wall]]);
    beside.gaps.push(gap);
    let system = assembled(&beside);
    let motion = record(0.02, 251, 0.4);
    for solver in BOTH {
        let together = run(&system, &arriving(motion.clone(), &[0.02, 0.02]), solver);
        let apart = arriving(motion.clone(), &[0.02, 0.08]);
        let grounds = [0, 1].map(|index| apart.under(index));
        let apart = run(&system, &apart, solver);
        let roof = &together.peaks.floor(0, 2);
        close(
            together.peaks.closing(0).value,
            roof.displacement_max().value,
            0.1,
            1e-12,
        );
        assert!((apart.peaks.closing(0).value - roof.displacement_max().value).abs() > 1e-3);
        // The greatest of u + d_l − d_r over the recorded instants.
        let history = apart.history.as_ref().expect("a history");
        let time = history.column(Column::TIME).expect("times");
        let floor = Column::displacement(0, 2);
        let u = history.column(floor).expect("displacements");
        let closings = time.iter().zip(&u).map(|(t, u)| {
            let [left, right] = grounds.each_ref().map(|path| path.at(*t).displacement[0]);
            u + left - right
        });
        let greatest = closings.fold(0.0, f64::max);
        close(apart.peaks.closing(0).value, greatest, greatest, 2e-3);
        assert!(apart.peaks.closing(0).value >= greatest * (1.0 - 1e-9));
    }
}

/// A yielding building on a ground of its own.
#[test]
fn yielding_buildings_stand_on_their_own_ground() {
    let mut soft = tower("B", 3, 4e7);
    let corners = jostle::hysteresis::Corners::bilinear(3e5, 0.05);
    let hinge = jostle::hysteresis::Hysteresis::new(
        jostle::hysteresis::HysteresisRule::Bilinear,
        jostle::hysteresis::Backbone::from_forces(4e7, corners, corners).expect("a curve"),
    );
    soft.hinges = Some(jostle::model::Hinges::Storeys(vec![
        hinge.expect("a rule");
        3
    ]));
    let gap = Gap::between([Some(0), Some(1)], 0.01, law(LawKind::HertzDamp));
    let system = assembled(&model(vec![tower("A", 3, 3e7), soft], vec![gap]));
    let motion = arriving(record(0.02, 251, 0.4), &[0.0, 0.05]);
    let plan = Plan::choose(&system, &motion, &Analysis::default()).expect("steps");
    assert_eq!(plan.solver, Solver::Riccati);
    let outcome = run(&system, &motion, plan.solver);
    assert!(!outcome.impacts.is_empty() && !outcome.spring_events.is_empty());
    assert!(outcome.energy.worst_imbalance < 1e-9);
}

fn portal(gravity: bool) -> Model {
    let mut frame = frame(2, &[6.0]);
    frame.axial.columns_flexible = true;
    let mut building = framed("P", frame);
    building.gravity.preload = gravity;
    model(vec![building], Vec::new())
}

/// Weight that a frame bears at rest is neither work of the ground nor strain energy of its motion.
#[test]
fn energies_of_motion_are_those_without_weight() {
    let motion = record(0.02, 151, 0.2);
    let [borne, weightless] = [true, false].map(|gravity| {
        let system = assembled(&portal(gravity));
        run_for_balance(&system, &motion, Solver::Riccati).energy
    });
    close(borne.input, weightless.input, weightless.input, 1e-6);
    close(borne.strain, weightless.strain, weightless.input, 1e-6);
    assert!(borne.worst_imbalance < 1e-9, "{borne:?}");
}

fn upwards(share: f64) -> GroundMotion {
    let mut motion = record(0.02, 251, 0.4);
    let vertical = GroundMotion {
        scale: share,
        ..record(0.01, 501, 1.3)
    };
    motion.grounds = Some(Box::new(Grounds {
        own: vec![OwnGround {
            vertical: Some(vertical),
            ..OwnGround::default()
        }],
    }));
    motion
}

/// Modes and all degrees of freedom agree; twice the shaking gives twice the displacement; self weight adds its sag, since the
/// frame is linear.
#[test]
fn vertical_shaking_moves_masses_up_and_down() {
    let system = assembled(&portal(false));
    let [modal, direct] = BOTH.map(|solver| run(&system, &upwards(0.7), solver));
    for (a, b) in modal.peaks.floors(0).iter().zip(&direct.peaks.floors(0)) {
        assert!(a.vertical_displacement() > 1e-5);
        close(
            b.vertical_displacement(),
            a.vertical_displacement(),
            a.vertical_displacement(),
            1e-3,
        );
        close(
            b.displacement_max().value,
            a.displacement_max().value,
            a.displacement_max().value,
            1e-3,
        );
    }
    for outcome in [&modal, &direct] {
        assert!(outcome.energy.worst_imbalance < 1e-9);
    }
    let still = GroundMotion {
        scale: 0.0,
        ..record(0.02, 251, 0.4)
    };
    let scaled = |share: f64| GroundMotion {
        grounds: upwards(share).grounds,
        ..still.clone()
    };
    let one = run(&system, &scaled(0.5), Solver::Riccati);
    let two = run(&system, &scaled(1.0), Solver::Riccati);
    for (a, b) in one.peaks.floors(0).iter().zip(&two.peaks.floors(0)) {
        let most = b.vertical_displacement();
        close(
            b.vertical_displacement(),
            2.0 * a.vertical_displacement(),
            most,
            1e-6,
        );
    }
    let heavy = assembled(&portal(true));
    let rest = run(&heavy, &scaled(1e-9), Solver::Riccati);
    let shaken = run(&heavy, &scaled(1.0), Solver::Riccati);
    for ((sag, with), without) in rest
        .peaks
        .floors(0)
        .iter()
        .zip(&shaken.peaks.floors(0))
        .zip(&two.peaks.floors(0))
    {
        let (sag, with) = (sag.vertical_displacement(), with.vertical_displacement());
        assert!(with > sag && with <= sag + without.vertical_displacement() * (1.0 + 1e-6));
    }
    assert!(shaken.energy.worst_imbalance < 1e-9);
}

#[test]
fn shear_buildings_have_nothing_that_moves_vertically() {
    let system = assembled(&model(vec![tower("A", 2, 3e7)], Vec::new()));
    let refused = Plan::choose(&system, &upwards(0.7), &Analysis::default());
    let faults = refused.expect_err("it is refused");
    assert_eq!(faults[0].path, "motion.vertical");
}

/// A sine is exact as well: its grounds are closed forms.
#[test]
fn waves_given_by_a_formula_arrive_late() {
    let sine = |grounds| GroundMotion {
        name: "sine".to_owned(),
        scale: 1.0,
        duration: 4.0,
        wave: Wave::Sine {
            amplitude: 2.0,
            period: 0.6,
        },
        bearing: None,
        grounds,
    };
    let gap = Gap::between([Some(0), Some(1)], 1.0, law(LawKind::Linear));
    let system = assembled(&model(
        vec![tower("A", 2, 3e7), tower("B", 2, 3e7)],
        vec![gap],
    ));
    let motion = arriving(sine(None), &[0.0, 0.1]);
    let path = motion.under(1);
    let (omega, t) = (std::f64::consts::TAU / 0.6, 1.3_f64);
    let expected = 2.0 / omega * (t - (omega * t).sin() / omega);
    close(path.at(0.1 + t).displacement[0], expected, 1.0, 1e-14);
    let [modal, direct] = BOTH.map(|solver| run(&system, &motion, solver));
    close(
        direct.peaks.closing(0).value,
        modal.peaks.closing(0).value,
        modal.peaks.closing(0).value,
        1e-3,
    );
}
