use jostle::contact::Crush;
use jostle::{Damping, FloorPairs, GroundMotion, LawKind, Model, Structure};

use crate::verification::support::{
    assembled, difference, frame, framed, law, row, run, shaking, steps, tower, two_frames,
};

/// Left and right exchanged.
fn mirrored(model: &Model) -> Model {
    let mut mirrored = model.clone();
    mirrored.buildings.reverse();
    for building in &mut mirrored.buildings {
        if let Structure::Frame(frame) = &mut building.structure {
            frame.spans.reverse();
            frame.beam_segments.reverse();
        }
    }
    mirrored.gaps.reverse();
    mirrored.links.reverse();
    let last = model.buildings.len() - 1;
    let exchange = |between: &mut [Option<usize>; 2], floors: &mut FloorPairs| {
        *between = between.map(|side| side.map(|building| last - building));
        between.reverse();
        if let FloorPairs::Listed(pairs) = floors {
            pairs.iter_mut().for_each(|pair| pair.reverse());
        }
    };
    for gap in &mut mirrored.gaps {
        exchange(&mut gap.between, &mut gap.floors);
    }
    for link in &mut mirrored.links {
        exchange(&mut link.between, &mut link.floors);
    }
    mirrored
}

/// The same model with its damping in numbers. Modes are found by iteration, whose rounding differs in the mirror:
/// damping at modes would not be mirrored exactly, and grazes enlarge the difference.
fn with_damping_in_numbers(model: &Model) -> Model {
    let mut model = model.clone();
    let system = assembled(&model);
    for (building, assembled) in model.buildings.iter_mut().zip(&system.buildings) {
        building.damping = Damping::Rayleigh {
            alpha: assembled.equations.alpha,
            beta: assembled.equations.beta,
        };
    }
    model
}

/// The degrees of freedom come in another order, so that rounding differs; impacts enlarge that a little.
fn compare(model: &Model, duration: f64) {
    let model = &with_damping_in_numbers(model);
    let other = mirrored(model);
    let (system, mirror) = (assembled(model), assembled(&other));
    let motion = shaking(duration);
    let reversed = GroundMotion {
        scale: -motion.scale,
        ..motion.clone()
    };
    let plan = steps(1e-3, 4);
    let (there, here) = (run(&system, &motion, &plan), run(&mirror, &reversed, &plan));
    assert!(there.impacts.len() > 5, "{} impacts", there.impacts.len());
    assert_eq!(
        there.impacts.len(),
        here.impacts.len(),
        "as many impacts in the mirror"
    );
    // The same contact stands elsewhere in the list.
    let gaps = model.gaps.len();
    let twin = |contact: usize| {
        let contact = &system.contacts[contact];
        let same = |c: &jostle::interface::Contact| {
            c.gap == gaps - 1 - contact.gap && (c.height - contact.height).abs() < 1e-9
        };
        mirror
            .contacts
            .iter()
            .position(same)
            .expect("the mirror has the contact")
    };
    for contact in 0..system.contacts.len() {
        let of = |outcome: &jostle::Outcome, contact: usize| -> Vec<jostle::Impact> {
            outcome
                .impacts
                .iter()
                .filter(|impact| impact.contact == contact)
                .copied()
                .collect()
        };
        let (a, b) = (of(&there, contact), of(&here, twin(contact)));
        assert_eq!(a.len(), b.len(), "impacts of contact {contact}");
        for (a, b) in a.iter().zip(&b) {
            let apart = (a.peak_force / b.peak_force - 1.0).abs();
            assert!(apart <= 1e-9, "force {apart:e} apart: {a:?} against {b:?}");
            assert!((a.start - b.start).abs() <= 1e-10, "{a:?} against {b:?}");
            assert!(
                (a.impulse / b.impulse - 1.0).abs() <= 1e-8,
                "{a:?} against {b:?}"
            );
        }
    }
    for (index, building) in system.buildings.iter().enumerate() {
        let image = &mirror.buildings[system.buildings.len() - 1 - index];
        let roof = |b: &jostle::system::BuildingSystem, o: &jostle::Outcome| -> Vec<f64> {
            b.floors
                .iter()
                .map(|floor| o.state.displacement[floor.dof])
                .collect()
        };
        let reflected: Vec<f64> = roof(image, &here).iter().map(|u| -u).collect();
        let apart = difference(&roof(building, &there), &reflected);
        assert!(
            apart <= 1e-9,
            "floors of building {index} are {apart:e} apart"
        );
    }
}

#[test]
fn mirrored_frames_mirror_the_answer() {
    for kind in [LawKind::HertzDamp, LawKind::Kelvin] {
        compare(&two_frames(0.01, law(kind, 0.65)), 2.0);
    }
}

#[test]
fn mirrored_faces_crush_mirrored() {
    let crush = Crush {
        force: 1e5,
        hardening: 0.3,
        hertzian: false,
    };
    let buildings = vec![tower("left", 2, 4e4, 0.4), tower("right", 2, 6e4, 0.9)];
    compare(
        &row(buildings, 0.005, law(LawKind::Crushing(crush), 1.0)),
        2.0,
    );
}

#[test]
fn a_mirrored_row_mirrors_the_answer() {
    let buildings = vec![
        tower("left", 4, 3e4, 0.5),
        framed("middle", frame(3, &[4.0, 6.0])),
        tower("right", 3, 4e4, 0.7),
    ];
    let mut model = row(buildings, 0.006, law(LawKind::HertzDamp, 0.65));
    model.gaps[1].set_width(0.004);
    model.gaps[0].floors = FloorPairs::listed(&[(3, 3), (2, 2)]);
    compare(&model, 1.6);
}
