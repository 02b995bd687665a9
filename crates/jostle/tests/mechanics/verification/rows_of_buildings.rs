//! Rows of many buildings, of unequal heights, with walls at their ends and links between them: against one system of
//! full matrices, and at a cost that grows with the number of buildings only once.

use jostle::{
    Building, Column, ContactLaw, FloorPairs, Gap, GroundMotion, LawKind, Link, Model, Outcome,
    Plan, Solver, Structure, System,
};

use crate::verification::monolith::monolith;
use crate::verification::support::{
    Random, assembled, column, difference, frame, framed, largest, law, row, run, shaking, steps,
    tower,
};

fn in_numbers(mut building: Building) -> Building {
    building.damping = jostle::Damping::Rayleigh {
        alpha: 0.3,
        beta: 1e-3,
    };
    building
}

/// Towers of two to four storeys with narrow gaps of all widths, walls at both ends, dampers in every third gap.
fn towers(count: usize) -> Model {
    let mut random = Random(count as u64);
    let buildings: Vec<Building> = (0..count)
        .map(|index| {
            let storeys = random.whole(2, 4);
            let (mass, period) = (random.between(2e4, 6e4), random.between(0.25, 0.7));
            in_numbers(tower(&format!("B{index}"), storeys, mass, period))
        })
        .collect();
    let contact = law(LawKind::HertzDamp, 0.65);
    let mut model = row(buildings, 0.0, contact);
    for gap in &mut model.gaps {
        gap.set_width(random.between(0.0005, 0.004));
    }
    model
        .gaps
        .push(Gap::between([Some(count - 1), None], 0.002, contact));
    // The order of the gaps in a file is free.
    model
        .gaps
        .insert(0, Gap::between([None, Some(0)], 0.003, contact));
    model.gaps.rotate_left(1 + count / 2);
    model.links = (0..count - 1)
        .filter(|left| left % 3 == 1)
        .map(|left| Link {
            between: [Some(left), Some(left + 1)],
            floors: FloorPairs::listed(&[(2, 2)]),
            level_tolerance: 1e-3,
            stiffness: 2e6,
            damping: 1e5,
            law: jostle::LinkLaw::Linear,
            ..Link::default()
        })
        .collect();
    model
}

/// Peak force of every contact and link.
fn peaks(outcome: &Outcome, system: &System) -> Vec<f64> {
    let contacts = (0..system.contacts.len()).map(Column::contact_force);
    let links = (0..system.links.len()).map(Column::link_force);
    contacts
        .chain(links)
        .map(|force| largest(&column(outcome, force)))
        .collect()
}

#[allow(
    clippy::print_stdout,
    reason = "how closely they agree is worth seeing"
)]
fn compare(model: &Model, motion: &GroundMotion, plan: &Plan, at_once: usize) {
    let system = assembled(model);
    let outcome = run(&system, motion, plan);
    let times = column(&outcome, Column::TIME);
    let (expected, displacement) = monolith(&system, motion, &times);
    let forces = difference(&peaks(&outcome, &system), &expected);
    let displacements = difference(&outcome.state.displacement, &displacement);
    let closed: Vec<Vec<f64>> = (0..system.contacts.len())
        .map(|contact| column(&outcome, Column::contact_force(contact)))
        .collect();
    let most = (0..times.len())
        .map(|i| closed.iter().filter(|force| force[i] > 0.0).count())
        .max();
    println!(
        "{} buildings, {} impacts, {most:?} contacts at once: forces {forces:e}, displacements {displacements:e}, {:e} out of balance",
        system.buildings.len(),
        outcome.impacts.len(),
        outcome.energy.worst_imbalance
    );
    assert!(most >= Some(at_once), "{most:?} contacts at once");
    assert!(
        forces <= 1e-8 && displacements <= 1e-8,
        "{forces:e}, {displacements:e}"
    );
    assert!(outcome.energy.worst_imbalance < 1e-9);
    let direct = Plan {
        solver: Solver::Stiffness,
        ..*plan
    };
    let direct = run(&system, motion, &direct);
    assert_eq!(outcome.impacts.len(), direct.impacts.len());
    let apart = difference(&peaks(&outcome, &system), &peaks(&direct, &system));
    assert!(apart <= 1e-7, "the solvers are {apart:e} apart");
}

#[test]
fn rows_of_3_and_10_equal_one_system_of_full_matrices() {
    compare(&towers(3), &shaking(1.2), &steps(1e-3, 4), 3);
    compare(&towers(10), &shaking(0.8), &steps(1e-3, 4), 6);
}

#[test]
fn a_row_of_50_equals_one_system_of_full_matrices() {
    compare(&towers(50), &shaking(0.3), &steps(1e-3, 2), 12);
}

/// Floors against columns, other numbers of storeys, a set-back at the top, and a link between floors of unlike height.
#[test]
fn frames_of_unequal_storeys_equal_one_system_of_full_matrices() {
    let mut low = frame(2, &[4.0]);
    low.storey_heights = vec![4.1, 3.3];
    let mut middle = frame(3, &[5.0]);
    middle.storey_heights = vec![3.2, 3.2, 3.0];
    let high = frame(4, &[3.0, 4.0]);
    let contact = law(LawKind::HertzDamp, 0.65);
    let mut model = row(
        [("low", low), ("middle", middle), ("high", high)]
            .map(|(name, frame)| in_numbers(framed(name, frame)))
            .into(),
        0.001,
        contact,
    );
    model.gaps[0].floors = FloorPairs::All;
    model.gaps[1].floors = FloorPairs::All;
    model.gaps[1].level_tolerance = 0.05;
    model.gaps[1].widths = vec![0.001, 0.001, 0.3];
    model.links.push(Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::listed(&[(1, 1)]),
        level_tolerance: 1.0,
        stiffness: 1e6,
        damping: 2e5,
        law: jostle::LinkLaw::Linear,
        ..Link::default()
    });
    let system = assembled(&model);
    let heights: Vec<(usize, [Option<usize>; 2], f64)> = system
        .contacts
        .iter()
        .map(|c| (c.gap, c.ports.floors(), (1e3 * c.height).round() / 1e3))
        .collect();
    assert_eq!(
        heights,
        [
            (0, [None, Some(1)], 3.2),
            (0, [Some(1), None], 4.1),
            (0, [None, Some(2)], 6.4),
            (0, [Some(2), None], 7.4),
            (1, [Some(1), Some(1)], 3.2),
            (1, [Some(2), Some(2)], 6.4),
            (1, [Some(3), None], 9.4)
        ]
    );
    compare(&model, &shaking(0.8), &steps(1e-3, 4), 3);
}

/// Pressed against the wall on the right by a lasting push, all buildings touch at once.
fn pile(count: usize) -> Outcome {
    let buildings = (0..count).map(|i| in_numbers(tower(&format!("B{i}"), 3, 3e4, 1.5)));
    let contact = ContactLaw {
        ..law(LawKind::KelvinNoTension, 0.3)
    };
    let mut model = row(buildings.collect(), 0.0, contact);
    model
        .gaps
        .push(Gap::between([Some(count - 1), None], 0.0, contact));
    let system = assembled(&model);
    let push = GroundMotion::sampled("push", 0.01, vec![-1.0; 41]);
    run(&system, &push, &steps(1e-3, 1))
}

#[test]
fn the_cost_of_a_step_grows_with_the_number_of_buildings_only_once() {
    // Contacts: per Newton iteration on all of them.
    let per_iteration = [4, 8, 16, 32].map(|count| {
        let outcome = pile(count);
        let resting = outcome.state.contacts.iter();
        let resting = resting.filter(|phase| phase.force() > 0.0).count();
        assert!(
            resting > 2 * count,
            "{resting} of {} contacts pushed",
            3 * count
        );
        let work = outcome.work;
        work.coupling_operations as f64 / work.iterations as f64 / count as f64
    });
    println!("multiply-adds per iteration and building {per_iteration:?}");
    // With full matrices it would double twice and twice again each time.
    let [first, .., last] = per_iteration;
    assert!(last < 1.5 * first, "{per_iteration:?}");
    // Links alone: exactly.
    let of_links = |count: usize| {
        let mut model = towers(count);
        model.gaps.clear();
        model.links = (0..count - 1)
            .map(|left| Link {
                between: [Some(left), Some(left + 1)],
                floors: FloorPairs::listed(&[(1, 1), (2, 2)]),
                level_tolerance: 1e-3,
                stiffness: 1e6,
                damping: 1e5,
                law: jostle::LinkLaw::Linear,
                ..Link::default()
            })
            .collect();
        let work = run(&assembled(&model), &shaking(0.5), &steps(1e-3, 1)).work;
        (work.steps, work.solves, work.coupling_operations)
    };
    let [a, b, c] = [10, 20, 30].map(of_links);
    assert_eq!((a.0, b.0), (b.0, c.0), "as many steps");
    assert_eq!(b.1 - a.1, c.1 - b.1, "solutions");
    assert_eq!(b.2 - a.2, c.2 - b.2, "multiply-adds");
}

/// What is struck between floors must not depend on how the column is cut elsewhere: statics of a massless beam are
/// exact, and so is the mass.
#[test]
fn a_point_put_into_a_column_changes_neither_statics_nor_mass() {
    let mut with = frame(2, &[5.0]);
    with.column_segments = 1;
    let mut rigid = with.clone();
    for beam in &mut rigid.beams {
        beam.flexural_rigidity *= 1e7;
    }
    let (length, a) = (3.2, 1.1);
    let column_rigidity = with.columns[0].flexural_rigidity;
    let struck = |frame: jostle::Frame| {
        let buildings = ["a", "b"].map(|name| in_numbers(framed(name, frame.clone())));
        let mut model = row(buildings.into(), 0.01, law(LawKind::Hertz, 1.0));
        model.gaps[0].floors = FloorPairs::Heights(vec![a, 3.2]);
        assembled(&model)
    };
    let plain = assembled(&row(
        vec![in_numbers(framed("a", with.clone()))],
        0.0,
        law(LawKind::Hertz, 1.0),
    ));
    let system = struck(with);
    assert_eq!(system.contacts[0].ports.floors(), [None, None]);
    let mass = |system: &System| system.buildings[0].equations.total_mass();
    // The base takes half of the lowest segment's mass, which has become shorter on one face.
    let line_mass = 2500.0 * 0.25;
    let gained = mass(&system) - mass(&plain);
    assert!(
        (gained - 0.5 * line_mass * (length - a)).abs() < 1e-6,
        "{gained}"
    );
    let flexibility = |system: &System, dof: usize, load: usize| {
        let building = &system.buildings[0];
        let mut unit = vec![0.0; building.equations.len()];
        unit[load] = 1.0;
        let statics = jostle::linear::StepMatrix::STATIC;
        let solved =
            jostle::structure::solve_once::<jostle::RiccatiSweep>(building, &statics, &unit);
        solved.expect("it stands")[dof]
    };
    let [point, floor] = [0, 1].map(|c| {
        system.contacts[c].ports.0[0]
            .as_ref()
            .expect("a building")
            .row
            .only()
            .expect("one alone")
    });
    let known = plain.buildings[0].floors[0].dof;
    let (got, expected) = (
        flexibility(&system, floor, floor),
        flexibility(&plain, known, known),
    );
    assert!(
        (got / expected - 1.0).abs() < 1e-11,
        "{got} against {expected}"
    );
    assert!(flexibility(&system, point, point) > 0.0);
    // Between rigid floors: a beam with fixed ends, and the storey that sways under what arrives at its top.
    let system = struck(rigid);
    let point = system.contacts[0].ports.0[0]
        .as_ref()
        .expect("a building")
        .row
        .only()
        .expect("one alone");
    let b = length - a;
    let share = a / length;
    let arrives = 3.0 * share * share - 2.0 * share.powi(3);
    let expected = (a * b).powi(3) / (3.0 * column_rigidity * length.powi(3))
        + arrives * arrives / (2.0 * 12.0 * column_rigidity / length.powi(3));
    let got = flexibility(&system, point, point);
    assert!(
        (got / expected - 1.0).abs() < 1e-6,
        "{got} against {expected}"
    );
    assert!(matches!(system.buildings[0].discretization.floors.len(), 2));
}

#[test]
fn several_gaps_of_one_pair_work_side_by_side() {
    // A soft bumper that stands out, and the bare floors behind it.
    let [a, b] = [("a", 3e4, 0.5), ("b", 5e4, 0.8)]
        .map(|(name, mass, period)| in_numbers(tower(name, 2, mass, period)));
    let stiff = law(LawKind::Linear, 1.0);
    let soft = ContactLaw {
        stiffness: 1e7,
        ..stiff
    };
    let mut model = row(vec![a, b], 0.02, stiff);
    model.gaps.push(Gap {
        floors: FloorPairs::listed(&[(2, 2)]),
        ..Gap::after(0, 0.01, soft)
    });
    let system = assembled(&model);
    assert_eq!(system.contacts.len(), 3);
    compare(&model, &shaking(3.0), &steps(1e-3, 4), 2);
    assert!(matches!(model.buildings[0].structure, Structure::Shear(_)));
}
