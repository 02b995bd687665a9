//! Springs and dashpots between buildings, and rigid walls, against closed forms.

use std::f64::consts::PI;

use jostle::contact::ForceLaw;
use jostle::interface::PortPair;
use jostle::interface::{Contact, LinkElement};
use jostle::{
    Column, ContactLaw, FloorPairs, Gap, LawKind, Link, LinkLaw, Model, Outcome, Plan,
    RestitutionIs, Solver, State, Structure, System,
};

use crate::verification::support::{
    assembled, column, difference, largest, law, moving, row, run, run_from, shaking, slider,
    sliders, steps, still, tower,
};

/// One mass before a wall on its right.
fn before_a_wall(mass: f64, width: f64, law: ForceLaw) -> System {
    let mut system = System::of_buildings(vec![slider("mass", mass, None)]);
    let ports = PortPair([Some(system.port(0, 1).expect("it has mass")), None]);
    system.contacts.push(Contact {
        width,
        law,
        ..Contact::without_law(ports)
    });
    system
}

fn linked(mut system: System, between: [Option<usize>; 2], stiffness: f64, damping: f64) -> System {
    let ports = PortPair(between.map(|side| side.map(|b| system.port(b, 1).expect("it has mass"))));
    system.links.push(LinkElement {
        link: 0,
        inside: false,
        height: ports.height(),
        ports,
        stiffness,
        damping,
        closing_at_rest: 0.0,
        law: LinkLaw::Linear,
    });
    system
}

fn link(between: [Option<usize>; 2], stiffness: f64, damping: f64) -> Link {
    Link {
        between,
        floors: FloorPairs::Common,
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law: LinkLaw::Linear,
        ..Link::default()
    }
}

#[test]
fn a_mass_rebounds_from_a_wall_as_it_should() {
    let (mass, speed, e) = (3e4, 0.4, 0.6);
    for kind in [LawKind::Kelvin, LawKind::HertzDamp, LawKind::Restitution] {
        let asked = ContactLaw {
            restitution_is: RestitutionIs::Realised,
            ..law(kind, e)
        };
        let system = before_a_wall(mass, 0.004, asked.between(mass, f64::INFINITY));
        assert_eq!(system.contacts[0].effective_mass(), mass);
        let start = moving(&system, &[0.0], &[speed]);
        let outcome = run_from(&system, &still(0.2), &steps(1e-3, 50), start);
        assert_eq!(outcome.impacts.len(), 1, "{kind:?}");
        let realised = -outcome.state.velocity[0] / speed;
        assert!((realised - e).abs() < 1e-4, "{kind:?}: {realised}");
        assert!(
            outcome.energy.worst_imbalance < 1e-9,
            "{kind:?}: {:e}",
            outcome.energy.worst_imbalance
        );
    }
    // Linear: half a period of mass and stiffness, and v √(k m).
    let k = 1e8;
    let system = before_a_wall(
        mass,
        0.004,
        law(LawKind::Linear, 1.0).between(mass, f64::INFINITY),
    );
    let start = moving(&system, &[0.0], &[speed]);
    let outcome = run_from(&system, &still(0.2), &steps(1e-3, 100), start);
    let impact = outcome.impacts[0];
    let (force, lasts) = (speed * (k * mass).sqrt(), PI * (mass / k).sqrt());
    assert!((impact.peak_force / force - 1.0).abs() < 1e-5);
    assert!(((impact.end - impact.start) / lasts - 1.0).abs() < 1e-5);
    assert!((impact.start - 0.01).abs() < 1e-12);
}

/// Two mirrored towers approach each other across a double gap: the plane between them is a wall.
#[test]
fn a_wall_is_the_mirror_of_a_building() {
    let stiffness = 1e8;
    let contact = |stiffness: f64| ContactLaw {
        stiffness,
        ..law(LawKind::Linear, 1.0)
    };
    let building = |name: &str| tower(name, 3, 3e4, 0.5);
    let mut walled = row(vec![building("a")], 0.0, contact(1.0));
    walled.gaps = vec![Gap::between(
        [Some(0), None],
        0.005,
        contact(2.0 * stiffness),
    )];
    let mirrored = row(vec![building("a"), building("b")], 0.01, contact(stiffness));
    let plan = steps(1e-3, 4);
    let speeds = [0.2, 0.5, 0.9];
    let wall = assembled(&walled);
    let alone = run_from(&wall, &still(1.0), &plan, moving(&wall, &[0.0; 3], &speeds));
    let pair = assembled(&mirrored);
    let speeds: Vec<f64> = speeds.iter().copied().chain(speeds.map(|v| -v)).collect();
    let both = run_from(&pair, &still(1.0), &plan, moving(&pair, &[0.0; 6], &speeds));
    assert!(alone.impacts.len() > 5);
    assert_eq!(alone.impacts.len(), both.impacts.len());
    let apart = difference(&alone.state.displacement, &both.state.displacement[..3]);
    assert!(apart < 1e-10, "{apart:e}");
    // A wall on the left is the same, turned round.
    walled.gaps[0].between = [None, Some(0)];
    let turned = assembled(&walled);
    let speeds: Vec<f64> = speeds[3..].to_vec();
    let there = run_from(
        &turned,
        &still(1.0),
        &plan,
        moving(&turned, &[0.0; 3], &speeds),
    );
    let back: Vec<f64> = there.state.displacement.iter().map(|u| -u).collect();
    assert_eq!(back, alone.state.displacement);
}

/// u = e^{−ζωt}(…) of an oscillator with initial displacement and velocity.
fn damped(ratio: f64, omega: f64, start: [f64; 2], t: f64) -> f64 {
    let [u, v] = start;
    let rate = omega * (1.0 - ratio * ratio).sqrt();
    let swing = u * (rate * t).cos() + (v + ratio * omega * u) / rate * (rate * t).sin();
    (-ratio * omega * t).exp() * swing
}

#[test]
fn two_linked_masses_vibrate_in_their_two_modes_and_steps_are_of_second_order() {
    let (mass, spring, stiffness, damping) = (2e4_f64, 1.5e6_f64, 2.2e6, 6e4);
    // Together the link does not act; against each other it acts twice.
    let (together, against) = (
        (spring / mass).sqrt(),
        ((spring + 2.0 * stiffness) / mass).sqrt(),
    );
    let ratio = 2.0 * damping / (2.0 * mass * against);
    let (start, speed) = ([0.02, -0.01], [0.3, 0.1]);
    let half = |a: [f64; 2], sign: f64| 0.5 * (a[0] + sign * a[1]);
    let end = 1.0;
    let sum = damped(0.0, together, [half(start, 1.0), half(speed, 1.0)], end);
    let rest = damped(ratio, against, [half(start, -1.0), half(speed, -1.0)], end);
    let exact = [sum + rest, sum - rest];
    let error = |step: f64, solver: Solver| {
        let masses = ["a", "b"].map(|name| slider(name, mass, Some(spring)));
        let system = linked(
            System::of_buildings(masses.into()),
            [Some(0), Some(1)],
            stiffness,
            damping,
        );
        let mut state = moving(&system, &start, &speed);
        let force = stiffness * (start[0] - start[1]) + damping * (speed[0] - speed[1]);
        state.acceleration = vec![
            (-spring * start[0] - force) / mass,
            (-spring * start[1] + force) / mass,
        ];
        let plan = Plan {
            solver,
            ..steps(step, 1)
        };
        let outcome = run_from(&system, &still(end), &plan, state);
        assert!(
            outcome.energy.worst_imbalance < 1e-9,
            "{:e}",
            outcome.energy.worst_imbalance
        );
        difference(&outcome.state.displacement, &exact)
    };
    let errors = [4e-3, 2e-3, 1e-3, 5e-4].map(|step| error(step, Solver::Riccati));
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!((order - 2.0).abs() < 0.05, "order {order}: {errors:?}");
    assert!(errors[3] < 1e-4, "{errors:?}");
    // Rounding of the accelerations, 4 v/h times the last digit, adds up over a thousand undamped steps.
    let direct = error(1e-3, Solver::Stiffness);
    assert!(
        (direct - errors[2]).abs() < 1e-9,
        "{direct:e} and {errors:?}"
    );
}

#[test]
fn a_link_to_the_wall_is_a_spring_and_a_dashpot_to_the_ground() {
    let (mass, spring, stiffness, damping) = (2e4_f64, 1e6_f64, 8e5, 4e4);
    for side in 0..2 {
        let alone = System::of_buildings(vec![slider("a", mass, Some(spring))]);
        let mut between = [None; 2];
        between[side] = Some(0);
        let system = linked(alone, between, stiffness, damping);
        let omega = ((spring + stiffness) / mass).sqrt();
        let mut state = moving(&system, &[0.03], &[0.0]);
        state.acceleration = vec![-omega * omega * 0.03];
        let outcome = run_from(&system, &still(0.5), &steps(1e-4, 1), state);
        let exact = damped(damping / (2.0 * mass * omega), omega, [0.03, 0.0], 0.5);
        assert!((outcome.state.displacement[0] - exact).abs() < 1e-6 * 0.03);
        // What the dashpot took is what the mass lost.
        let [u, v] = [outcome.state.displacement[0], outcome.state.velocity[0]];
        let left = 0.5 * (mass * v * v + (spring + stiffness) * u * u);
        let lost = 0.5 * (spring + stiffness) * 0.03_f64.powi(2) - left;
        assert!((outcome.energy.links / lost - 1.0).abs() < 1e-9);
        let force = column(&outcome, Column::link_force(0));
        let sign = if side == 0 { 1.0 } else { -1.0 };
        assert!((force[0] - sign * stiffness * 0.03).abs() < 1e-6);
        assert!(
            (outcome
                .peaks
                .of(Column::link_force(0))
                .furthest()
                .value
                .abs()
                - largest(&force))
            .abs()
                < 1e-6
        );
    }
}

fn two_towers(name: [&str; 2]) -> Model {
    let mut model = row(
        vec![tower(name[0], 3, 3e4, 0.5), tower(name[1], 3, 5e4, 0.8)],
        10.0,
        law(LawKind::HertzDamp, 0.65),
    );
    for building in &mut model.buildings {
        building.damping = jostle::Damping::Rayleigh {
            alpha: 0.4,
            beta: 1e-3,
        };
    }
    model
}

#[test]
fn very_stiff_links_make_two_buildings_one() {
    let mut model = two_towers(["a", "b"]);
    let mut one = row(
        vec![model.buildings[0].clone()],
        0.0,
        law(LawKind::Linear, 1.0),
    );
    if let (Structure::Shear(one), Structure::Shear(other)) = (
        &mut one.buildings[0].structure,
        &model.buildings[1].structure,
    ) {
        for (a, b) in one.mass.iter_mut().zip(&other.mass) {
            *a += b;
        }
        for (a, b) in one.stiffness.iter_mut().zip(&other.stiffness) {
            *a += b;
        }
    }
    let motion = shaking(3.0);
    let plan = steps(2e-3, 1);
    let single = run(&assembled(&one), &motion, &plan);
    let mut errors = Vec::new();
    for stiffness in [1e11, 1e13, 1e15] {
        model.links = vec![link([Some(0), Some(1)], stiffness, 0.0)];
        let system = assembled(&model);
        let pair = run(&system, &motion, &plan);
        errors.push(difference(
            &pair.state.displacement[..3],
            &single.state.displacement,
        ));
        assert!(
            pair.energy.worst_imbalance < 1e-9,
            "{:e}",
            pair.energy.worst_imbalance
        );
    }
    // The stiffer the nearer, down to what a force of 1e15 N/m times the last digit leaves.
    assert!(
        errors[0] < 1e-2 && errors[1] < 1e-4 && errors[2] < 1e-6,
        "{errors:?}"
    );
}

/// Links, contacts and walls of all laws at once: energy must balance, and both solvers agree.
#[test]
fn links_and_impacts_together_balance() {
    for kind in [
        LawKind::HertzDamp,
        LawKind::KelvinNoTension,
        LawKind::Restitution,
    ] {
        let mut model = two_towers(["a", "b"]);
        model.gaps[0] = Gap::after(0, 0.02, law(kind, 0.6));
        model
            .gaps
            .push(Gap::between([None, Some(0)], 0.03, law(kind, 0.6)));
        model
            .gaps
            .push(Gap::between([Some(1), None], 0.04, law(kind, 0.6)));
        model.links = vec![
            Link {
                floors: FloorPairs::listed(&[(3, 3), (2, 2)]),
                ..link([Some(0), Some(1)], 1e6, 2e5)
            },
            link([Some(1), None], 0.0, 1e5),
        ];
        let system = assembled(&model);
        assert_eq!((system.contacts.len(), system.links.len()), (9, 5));
        let mut motion = shaking(4.0);
        motion.scale = 1.5;
        let plan = steps(2e-3, 8);
        let outcome = run(&system, &motion, &plan);
        assert!(
            outcome.impacts.len() > 10,
            "{kind:?}: {}",
            outcome.impacts.len()
        );
        let met = |gap: usize| {
            let mut impacts = outcome.impacts.iter();
            impacts.any(|impact| system.contacts[impact.contact].gap == gap)
        };
        assert!((0..3).all(met), "{kind:?}: impacts in every gap");
        assert!(
            outcome.energy.worst_imbalance < 1e-9,
            "{kind:?}: {:e}",
            outcome.energy.worst_imbalance
        );
        assert!(outcome.energy.links > 0.0 && outcome.energy.links < outcome.energy.damped);
        let direct = run(
            &system,
            &motion,
            &Plan {
                solver: Solver::Stiffness,
                ..plan
            },
        );
        assert_eq!(outcome.impacts.len(), direct.impacts.len());
        let apart = difference(&outcome.state.displacement, &direct.state.displacement);
        assert!(apart < 1e-7, "{kind:?}: {apart:e}");
    }
}

/// An impact changes velocities at once, and with them the force of a dashpot: the motion after it is that of a step
/// that begins in equilibrium, so that steps stay of second order.
#[test]
fn a_blow_jerks_the_dashpots_beside_it() {
    let (masses, spring) = ([2e4, 3e4], 1e6);
    let run_with = |step: f64| -> Outcome {
        let bodies = masses.map(|mass| slider("m", mass, Some(spring)));
        let mut momentum = law(LawKind::Restitution, 0.5);
        momentum.stiffness = 1e9;
        let system = sliders(bodies.into(), 0.004, &momentum);
        let system = linked(system, [Some(0), Some(1)], 2e5, 8e4);
        let mut state: State = moving(&system, &[0.0; 2], &[0.5, -0.3]);
        let force = 8e4 * 0.8;
        state.acceleration = vec![-force / masses[0], force / masses[1]];
        run_from(&system, &still(0.06), &steps(step, 1), state)
    };
    let exact = run_with(1e-5);
    assert_eq!(exact.impacts.len(), 1);
    let error = |step: f64| difference(&run_with(step).state.velocity, &exact.state.velocity);
    let errors = [4e-3, 2e-3, 1e-3].map(error);
    let order = (errors[0] / errors[2]).log2() / 2.0;
    assert!(order > 1.6, "order {order}: {errors:?}");
    assert!(exact.energy.worst_imbalance < 1e-9);
}

/// A mass before a wall, with a link of a law.
fn with_law(mass: f64, stiffness: f64, damping: f64, law: LinkLaw) -> System {
    let system = System::of_buildings(vec![slider("mass", mass, None)]);
    let mut system = linked(system, [Some(0), None], stiffness, damping);
    system.links[0].law = law;
    system
}

/// A free mass with a pure dashpot of exponent α slows down as v^(1−α) = v₀^(1−α) − (1 − α) c t/m.
#[test]
fn a_viscous_link_slows_a_mass_as_its_closed_form() {
    let (mass, damping, speed): (f64, f64, f64) = (3e4, 6e4, 0.4);
    for (exponent, limit) in [(0.35, 2e-5), (0.7, 2e-5), (1.6, 2e-5), (2.0, 2e-5)] {
        let system = with_law(mass, 0.0, damping, LinkLaw::Viscous { exponent });
        let mut start = moving(&system, &[0.0], &[speed]);
        start.acceleration[0] = -damping * speed.powf(exponent) / mass;
        let time = 0.1;
        let outcome = run_from(&system, &still(time), &steps(2e-4, 1), start);
        let power = 1.0 - exponent;
        let expected = speed.powf(power) - power * damping * time / mass;
        let expected = expected.max(0.0).powf(power.recip());
        let got = outcome.state.velocity[0];
        assert!(
            (got - expected).abs() < limit * speed,
            "{exponent}: {got} against {expected}"
        );
        let lost = 0.5 * mass * (speed * speed - got * got);
        assert!(
            (outcome.energy.links / lost - 1.0).abs() < 1e-9,
            "{exponent}"
        );
        assert!(outcome.energy.worst_imbalance < 1e-9);
    }
}

/// A stopper is a contact without tension, a cable one of the other sign.
#[test]
fn a_stopper_and_a_cable_are_contacts_without_tension() {
    let (mass, gap, k, c, speed) = (3e4, 0.004, 1e8, 4e5, 0.4);
    let law = ForceLaw::Kelvin {
        stiffness: k,
        damping: c,
        tension: false,
    };
    let contact = before_a_wall(mass, gap, law);
    let start = moving(&contact, &[0.0], &[speed]);
    let fine = run_from(&contact, &still(0.1), &steps(1e-3, 1000), start);
    let mut errors = Vec::new();
    for step in [2e-4, 1e-4] {
        let system = with_law(mass, k, c, LinkLaw::Stopper { gap });
        let start = moving(&system, &[0.0], &[speed]);
        let run = run_from(&system, &still(0.1), &steps(step, 1), start);
        let apart = (run.state.velocity[0] / fine.state.velocity[0] - 1.0).abs();
        let force = (run.peaks.of(Column::link_force(0)).furthest().value
            / fine.impacts[0].peak_force
            - 1.0)
            .abs();
        assert!(run.energy.worst_imbalance < 1e-9);
        assert!(force < 1e-3, "{force:e}");
        errors.push(apart);
    }
    assert!(
        errors[1] < 1e-4 && errors[1] < 0.5 * errors[0],
        "{errors:?}"
    );
    // Half a period of mass and spring, after which it flies back as fast.
    let system = with_law(mass, k, 0.0, LinkLaw::Cable { slack: gap });
    let start = moving(&system, &[0.0], &[-speed]);
    let run = run_from(&system, &still(0.1), &steps(1e-4, 1), start);
    assert!((run.state.velocity[0] / speed - 1.0).abs() < 1e-5);
    let greatest = -speed * (k * mass).sqrt();
    assert!((run.peaks.of(Column::link_force(0)).furthest().value / greatest - 1.0).abs() < 1e-4);
}

/// Friction takes the work F_s times the way that is slipped.
#[test]
fn a_friction_link_stops_a_mass_over_its_way() {
    // Steps must resolve the 5 ms until it slips.
    let (mass, slip, stick, speed) = (3e4, 2e4, 1e7, 0.4);
    let law = LinkLaw::Friction {
        slip_force: slip,
        stick_stiffness: stick,
    };
    let system = with_law(mass, 0.0, 0.0, law);
    let start = moving(&system, &[0.0], &[speed]);
    let outcome = run_from(&system, &still(1.0), &steps(2e-4, 1), start);
    let way = 0.5 * mass * speed * speed / slip + 0.5 * slip / stick;
    let stroke = outcome.peaks.of(Column::link_stroke(0)).size();
    assert!((stroke / way - 1.0).abs() < 1e-5, "{stroke} against {way}");
    assert!(outcome.energy.hysteretic > 0.0 && outcome.energy.links == 0.0);
    // Rounding of a mass that nothing else holds: 16 times as much with every halving of the step.
    assert!(outcome.energy.worst_imbalance < 1e-9);
}

/// A spring inside a shear building adds to the stiffness of its storey.
#[test]
fn a_link_inside_a_building_stiffens_its_storeys() {
    let spring = 2e7;
    let braced = |floors: &[(usize, usize)]| {
        let mut model = row(
            vec![tower("a", 3, 3e4, 0.5)],
            0.0,
            law(LawKind::Linear, 1.0),
        );
        model.gaps.clear();
        model.links = vec![Link {
            floors: FloorPairs::listed(floors),
            ..link([Some(0), Some(0)], spring, 0.0)
        }];
        model
    };
    let mut model = braced(&[(0, 1), (1, 2)]);
    let linked = assembled(&model);
    model.links.clear();
    if let Structure::Shear(shear) = &mut model.buildings[0].structure {
        for storey in 0..2 {
            shear.stiffness[storey] += spring;
        }
    }
    let alpha_only = jostle::Damping::Rayleigh {
        alpha: 0.3,
        beta: 0.0,
    };
    let mut with = braced(&[(0, 1), (1, 2)]);
    (model.buildings[0].damping, with.buildings[0].damping) = (alpha_only.clone(), alpha_only);
    assert_eq!(linked.links.len(), 2);
    let [stiff, linked] = [assembled(&model), assembled(&with)].map(|system| {
        let start = moving(&system, &[0.01, -0.02, 0.03], &[0.1, 0.2, -0.1]);
        run_from(&system, &still(2.0), &steps(1e-3, 1), start)
    });
    let apart = difference(&linked.state.displacement, &stiff.state.displacement);
    assert!(apart < 1e-9, "{apart:e}");
}
