//! Power series give the motion of buildings that yield as closed forms do, and as direct steps do when they are very short;
//! what a tolerance promises holds; energy balances.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use jostle::history::{Column, Kind, Storage};
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Pinching};
use jostle::stepping::simulate_from;
use jostle::{
    Analysis, Building, GroundMotion, Hinges, LawKind, Outcome, Plan, Settings, Solver, State,
    Structure, System, simulate,
};

use jostle::{RunEnd, StepError};
use jostle_testkit::models::UNDAMPED;

use crate::verification::support::{Random, assembled, law, row, shaking, still, tower};

const RULES: [HysteresisRule; 7] = [
    HysteresisRule::Bilinear,
    HysteresisRule::Normal,
    HysteresisRule::PeakOriented,
    HysteresisRule::Takeda { exponent: 0.4 },
    HysteresisRule::DegradingTrilinear,
    HysteresisRule::Elastic,
    HysteresisRule::Pinched(Pinching {
        unloading_exponent: 0.3,
        ductility_damage: 0.01,
        energy_damage: 0.01,
        ..Pinching::USUAL
    }),
];

/// A storey of initial stiffness \[N/m\] that yields at a deformation \[m\].
fn storey(rule: HysteresisRule, stiffness: f64, deformation: f64, post_yield: f64) -> Hysteresis {
    let force = stiffness * deformation;
    let corners = if rule == HysteresisRule::Bilinear {
        Corners::bilinear(force, post_yield)
    } else {
        Corners {
            cracking: 0.4 * force,
            yielding: force,
            post_cracking: 0.4,
            post_yield,
        }
    };
    let backbone = Backbone::from_forces(stiffness, corners, corners).expect("sound");
    Hysteresis::new(rule, backbone).expect("the rule fits")
}

/// The tower with storeys that yield at a drift \[m\].
fn yielding(mut building: Building, rule: HysteresisRule, deformation: f64) -> Building {
    let Structure::Shear(shear) = &building.structure else {
        panic!("towers are shear buildings");
    };
    let stiffness = shear.stiffness.iter();
    let storeys = stiffness.map(|stiffness| storey(rule, *stiffness, deformation, 0.03));
    building.hinges = Some(Hinges::Storeys(storeys.collect()));
    building
}

fn plan(system: &System, motion: &GroundMotion, analysis: &Analysis) -> Plan {
    Plan::choose(system, motion, analysis).expect("steps are found")
}

fn at_tolerance(tolerance: f64) -> Analysis {
    Analysis {
        tolerance,
        ..Analysis::default()
    }
}

/// Peaks without histories, whose rows would cost steps.
const PEAKS: Settings = Settings {
    pounding: jostle::Pounding::Included,
    record_interval: None,
    storage: Storage::MEMORY,
};

fn go(system: &System, motion: &GroundMotion, plan: &Plan) -> Outcome {
    simulate(system, motion, plan, PEAKS, |_| ControlFlow::Continue(()))
}

/// Greatest difference of the peaks of two runs, each relative to the greatest of its kind in the building or of all gaps.
fn apart(first: &Outcome, second: &Outcome) -> (f64, String) {
    let mut worst = (0.0, String::new());
    let mut take = |name: String, pairs: Vec<[f64; 2]>| {
        let greatest = pairs.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
        for [a, b] in pairs {
            let off = (a - b).abs() / greatest.max(f64::MIN_POSITIVE);
            if off > worst.0 {
                worst = (off, name.clone());
            }
        }
    };
    for (index, (a, b)) in first
        .peaks
        .buildings()
        .zip(second.peaks.buildings())
        .enumerate()
    {
        let pairs = |of: fn(&jostle::history::PeaksOf<'_>) -> f64| -> Vec<[f64; 2]> {
            a.iter().zip(&b).map(|(a, b)| [of(a), of(b)]).collect()
        };
        take(
            format!("displacement {index}"),
            [
                pairs(|f| f.displacement_max().value),
                pairs(|f| f.displacement_min().value),
            ]
            .concat(),
        );
        take(format!("drift {index}"), pairs(|f| f.storey_drift()));
        take(
            format!("acceleration {index}"),
            pairs(|f| f.total_acceleration()),
        );
        take(format!("shear {index}"), pairs(|f| f.storey_shear()));
        take(format!("moment {index}"), pairs(|f| f.overturning_moment()));
    }
    for kind in [Kind::Shear, Kind::Closing, Kind::Force, Kind::Work] {
        for owner in ["building", "contact", "gap", "spring"] {
            let sizes = |run: &Outcome| {
                let is_own = |column: Column| column.owner.name() == owner && column.kind == kind;
                run.peaks.sizes(is_own)
            };
            let pairs = sizes(first).into_iter().zip(sizes(second));
            take(
                format!("{kind:?} of {owner}"),
                pairs.map(|(a, b)| [a, b]).collect(),
            );
        }
    }
    worst
}

/// Without damping and ground motion, a mass on an elastic, perfectly plastic spring that starts with a velocity slides
/// until its energy is spent: v₀²/2 = ω²u_y²/2 + ω²u_y (u − u_y). It comes back by twice u_y and then swings about
/// u − u_y for ever.
#[test]
fn a_sliding_mass_goes_as_far_as_its_energy_takes_it() {
    let (mass, omega, yields) = (2e4, 9.0, 0.01);
    let mut building = tower("mass", 1, mass, 2.0 * PI / omega);
    building.damping = UNDAMPED;
    let stiffness = mass * omega * omega;
    let spring = storey(HysteresisRule::Bilinear, stiffness, yields, 0.0);
    building.hinges = Some(Hinges::Storeys(vec![spring]));
    let system = assembled(&row(vec![building], 1.0, law(LawKind::Linear, 1.0)));
    let motion = still(3.0);
    let analysis = Analysis {
        solver: Some(Solver::Series),
        ..Analysis::default()
    };
    let plan = plan(&system, &motion, &analysis);
    for velocity in [0.2, 0.7] {
        let mut state = State::at_rest(&system, 0.0);
        state.velocity[0] = velocity;
        let outcome = simulate_from(&system, &motion, &plan, Settings::default(), state, |_| {
            ControlFlow::Continue(())
        });
        let elastic = (omega * yields).powi(2);
        let farthest = yields + (velocity * velocity - elastic) / (2.0 * omega * omega * yields);
        let peaks = outcome.peaks.floor(0, 1);
        println!(
            "{:?} {:?} {}",
            outcome.spring_events,
            peaks.displacement(),
            plan.step
        );
        assert!(
            (peaks.displacement_max().value / farthest - 1.0).abs() < 1e-12,
            "{peaks:?}"
        );
        // The time: a part of a sine until yield, then constant deceleration.
        let at_yield = (velocity * velocity - elastic).sqrt();
        let time = (yields * omega / velocity).asin() / omega + at_yield / (omega * omega * yields);
        assert!((peaks.displacement_max().at - time).abs() < 1e-11, "{time}");
        let found = outcome.spring_events[0].time;
        assert!((found - (yields * omega / velocity).asin() / omega).abs() < 1e-12);
        assert!((peaks.total_acceleration() / (omega * omega * yields) - 1.0).abs() < 1e-12);
        // It swings between the farthest point and 2 u_y less.
        let now = outcome.state.displacement[0] - (farthest - yields);
        let energy = now.powi(2) + (outcome.state.velocity[0] / omega).powi(2);
        assert!((energy.sqrt() / yields - 1.0).abs() < 1e-10, "{energy}");
        assert!(outcome.energy.worst_imbalance < 1e-12);
    }
}

/// Every rule beside another one, every kind of contact law: against direct steps of a fiftieth of a millisecond, which have
/// nothing in common with power series but the rules and the laws.
#[test]
fn towers_of_every_rule_pound_as_with_very_short_direct_steps() {
    let motion = shaking(3.0);
    let laws = [
        LawKind::HertzDamp,
        LawKind::Linear,
        LawKind::KelvinNoTension,
        LawKind::Restitution,
        LawKind::Jankowski,
    ];
    for (number, rule) in RULES.into_iter().enumerate() {
        let other = RULES[(number + 2) % RULES.len()];
        let law = law(laws[number % laws.len()], 0.65);
        let low = yielding(tower("low", 2, 5e4, 0.3), rule, 0.004);
        let high = yielding(tower("high", 4, 7e4, 0.8), other, 0.006);
        let system = assembled(&row(vec![low, high], 0.012, law));
        let series = plan(&system, &motion, &at_tolerance(1e-3));
        assert_eq!(series.solver, Solver::Series);
        let found = go(&system, &motion, &series);
        let direct = Analysis {
            step: Some(2e-5),
            contact_step: Some(2e-5),
            solver: Some(Solver::Riccati),
            ..Analysis::default()
        };
        let expected = go(&system, &motion, &plan(&system, &motion, &direct));
        assert!(!found.impacts.is_empty(), "{rule:?}");
        assert_eq!(found.impacts.len(), expected.impacts.len(), "{rule:?}");
        let stages = |outcome: &Outcome| -> Vec<_> {
            let events = outcome.spring_events.iter();
            let mut stages: Vec<_> = events.map(|event| (event.spring, event.stage)).collect();
            stages.sort();
            stages
        };
        assert_eq!(stages(&found), stages(&expected), "{rule:?}");
        let (worst, name) = apart(&found, &expected);
        println!(
            "{rule:?}: {worst:.1e} of {name}, {} steps",
            found.work.steps
        );
        assert!(worst < 1e-4, "{rule:?}: {worst:e} of {name}");
        assert!(
            found.energy.worst_imbalance < 1e-9,
            "{rule:?}: {:?}",
            found.energy
        );
        assert!(
            found
                .accuracy
                .is_some_and(|own| own.residual <= own.tolerance)
        );
    }
}

/// Random towers, rules and laws: peaks at every tolerance against those at a much smaller one.
#[test]
fn the_tolerance_is_kept() {
    let mut random = Random(1940);
    let motion = shaking(6.0);
    let (mut steps, mut collapsed) = ([0; 2], 0);
    for number in 0..40 {
        let mut building = |name: &str| {
            let storeys = random.whole(1, 8);
            let period = 0.1 * storeys as f64 * random.between(0.6, 2.0);
            let rule = RULES[random.whole(0, RULES.len() - 1)];
            let mass = random.between(2e4, 2e5);
            let mut yielding = yielding(
                tower(name, storeys, mass, period),
                rule,
                random.between(0.002, 0.02),
            );
            if random.coin() {
                yielding.gravity.p_delta = true;
            }
            yielding
        };
        let pair = vec![building("left"), building("right")];
        let kind = LawKind::ALL[random.whole(0, LawKind::ALL.len() - 1)];
        let law = law(kind, random.between(0.4, 0.9));
        let system = assembled(&row(pair, random.between(0.002, 0.03), law));
        let run = |tolerance: f64| {
            let plan = plan(&system, &motion, &at_tolerance(tolerance));
            assert_eq!(plan.solver, Solver::Series);
            go(&system, &motion, &plan)
        };
        let exact = run(1e-7);
        if matches!(exact.end, RunEnd::Failed(StepError::Collapse { .. })) {
            let found = run(1e-3);
            assert!(matches!(
                found.end,
                RunEnd::Failed(StepError::Collapse { .. })
            ));
            collapsed += 1;
            continue;
        }
        assert_eq!(exact.end, RunEnd::Completed);
        for (place, tolerance) in [1e-2, 1e-3].into_iter().enumerate() {
            let found = run(tolerance);
            steps[place] += found.work.steps;
            let accuracy = found.accuracy.expect("an estimate");
            let (worst, name) = apart(&found, &exact);
            println!(
                "{number} {kind:?} {tolerance:e}: {worst:.1e} of {name}, {} impacts, doubtful {:?}",
                found.impacts.len(),
                accuracy.doubtful_from
            );
            assert!(
                found.energy.worst_imbalance < 1e-9,
                "{number}: {:?}",
                found.energy
            );
            assert!(accuracy.residual <= tolerance, "{number}: {accuracy:?}");
            assert!(
                worst <= tolerance || accuracy.doubtful_from.is_some(),
                "{number}, {kind:?}, {tolerance:e}: {worst:e} of {name}"
            );
        }
    }
    println!("{steps:?} steps, {collapsed} collapsed");
    assert!(collapsed < 10, "{collapsed}");
}
