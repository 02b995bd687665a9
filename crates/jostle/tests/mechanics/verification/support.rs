//! Buildings, motions and runs that the claims are tried on.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use jostle::history::{Kind, Owner, Storage};
use jostle::interface::Contact;
use jostle::stepping::{ContactSteps, simulate_from};
use jostle::structure::{Discretization, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{
    Axial, Building, Column, ContactLaw, Damping, Frame, Gap, GroundMotion, Joint, LawKind, Model,
    Outcome, Plan, Pounding, RestitutionIs, RunEnd, Section, Settings, Shear, Solver, State,
    Structure, System,
};
pub(crate) use jostle_testkit::compare::{difference, largest};
use jostle_testkit::models;
pub(crate) use jostle_testkit::models::concrete as section;
use jostle_testkit::runs;
pub(crate) use jostle_testkit::runs::assembled;

/// All contact laws.
pub(crate) const LAWS: [LawKind; LawKind::ALL.len()] = LawKind::ALL;

/// Random numbers that are the same everywhere (splitmix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number from `low` to `high`, both included.
    pub(crate) fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.bits() % (high - low + 1) as u64) as usize
    }

    pub(crate) fn coin(&mut self) -> bool {
        self.bits() & 1 == 1
    }
}

/// A regular frame.
pub(crate) fn frame(storeys: usize, spans: &[f64]) -> Frame {
    models::frame(storeys, spans, section(0.5, 0.5), section(0.3, 0.6))
}

/// A frame of random size and properties.
pub(crate) fn random_frame(random: &mut Random) -> Frame {
    let (storeys, bays) = (random.whole(1, 12), random.whole(1, 5));
    let sections = |random: &mut Random, low: f64, high: f64| -> Vec<Section> {
        (0..storeys)
            .map(|_| section(random.between(low, high), random.between(low, high)))
            .collect()
    };
    Frame {
        storey_heights: (0..storeys).map(|_| random.between(2.5, 5.0)).collect(),
        spans: (0..bays).map(|_| random.between(2.0, 9.0)).collect(),
        columns: sections(random, 0.3, 0.9),
        beams: sections(random, 0.25, 0.8),
        beam_mass: (0..storeys)
            .map(|_| random.between(500.0, 9000.0))
            .collect(),
        floor_mass: (0..storeys).map(|_| random.between(0.0, 2e4)).collect(),
        column_segments: random.whole(1, 5),
        beam_segments: (0..bays).map(|_| random.whole(1, 8)).collect(),
        axial: Axial {
            columns_flexible: random.coin(),
            beams_flexible: random.coin(),
        },
        joint: Joint {
            rotational_stiffness: random
                .coin()
                .then(|| 10_f64.powf(random.between(6.0, 11.0))),
            ..Joint::default()
        },
        ..Frame::default()
    }
}

/// Random Rayleigh damping, in half of all cases none.
pub(crate) fn random_damping(random: &mut Random) -> Damping {
    let damped = random.coin();
    let part = |value: f64| if damped { value } else { 0.0 };
    Damping::Rayleigh {
        alpha: part(random.between(0.0, 1.5)),
        beta: part(random.between(0.0, 4e-3)),
    }
}

pub(crate) fn framed(name: &str, frame: Frame) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Frame(frame),
        damping: Damping::ratio(0.05, [1, 2]),
        ..Building::default()
    }
}

/// A shear building of equal floors \[kg\] and storeys \[N/m\] with its first period \[s\].
pub(crate) fn tower(name: &str, storeys: usize, mass: f64, period: f64) -> Building {
    let slowest = 2.0 * (PI / (4 * storeys + 2) as f64).sin();
    let stiffness = mass * (2.0 * PI / period / slowest).powi(2);
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![mass; storeys],
            stiffness: vec![stiffness; storeys],
            storey_heights: vec![3.2; storeys],
        }),
        damping: Damping::ratio(0.05, if storeys > 1 { vec![1, 2] } else { vec![1] }),
        ..Building::default()
    }
}

/// A law with the usual stiffness of concrete floors.
pub(crate) fn law(kind: LawKind, restitution: f64) -> ContactLaw {
    ContactLaw {
        kind,
        stiffness: if kind.is_hertzian() { 2e9 } else { 1e8 },
        restitution,
        restitution_is: RestitutionIs::Input,
    }
}

/// Buildings in a row with equal gaps \[m\].
pub(crate) fn row(buildings: Vec<Building>, width: f64, law: ContactLaw) -> Model {
    Model {
        title: "row".to_owned(),
        gaps: (0..buildings.len() - 1)
            .map(|left| Gap::after(left, width, law))
            .collect(),
        buildings,
        ..Model::default()
    }
}

/// A tall frame beside a lower one, which they hit often.
pub(crate) fn two_frames(width: f64, law: ContactLaw) -> Model {
    let slender = Frame {
        columns: vec![section(0.35, 0.35); 6],
        ..frame(6, &[6.0, 3.0])
    };
    let mut stiff = frame(3, &[4.0, 5.0]);
    stiff.joint.rotational_stiffness = Some(2e8);
    row(
        vec![framed("low", stiff), framed("high", slender)],
        width,
        law,
    )
}

/// Strong shaking without end, straight within 10 ms \[s\].
pub(crate) fn shaking(duration: f64) -> GroundMotion {
    let step = 0.01;
    let wave = |t: f64, frequency: f64, phase: f64| (2.0 * PI * frequency * t + phase).sin();
    let values = (0..=(duration / step).round() as usize).map(|k| {
        let t = k as f64 * step;
        5.0 * t.min(1.0) * (wave(t, 1.1, 0.0) + 0.7 * wave(t, 2.3, 0.5) + 0.5 * wave(t, 4.7, 1.0))
    });
    GroundMotion::sampled("shaking", step, values.collect())
}

/// Two towers that meet when [`shaking`], under every law whose force has no corner.
pub(crate) fn colliding_towers() -> impl Iterator<Item = (LawKind, System)> {
    let laws = [
        LawKind::Linear,
        LawKind::Kelvin,
        LawKind::Hertz,
        LawKind::HertzDamp,
    ];
    laws.into_iter().map(|kind| {
        let towers = vec![tower("left", 1, 4e4, 0.5), tower("right", 1, 6e4, 0.9)];
        (kind, assembled(&row(towers, 0.02, law(kind, 0.65))))
    })
}

/// No ground acceleration \[s\].
pub(crate) fn still(duration: f64) -> GroundMotion {
    GroundMotion::sampled("still", duration, vec![0.0, 0.0])
}

/// Fixed steps \[s\], divided while a contact is closed.
pub(crate) fn steps(step: f64, division: u32) -> Plan {
    Plan {
        step,
        contact_steps: ContactSteps::Fixed(division),
        integrator: jostle::Integrator::default(),
        solver: Solver::Riccati,
        vertical: false,
        is_given: true,
        collapse_drift: jostle::model::COLLAPSE_DRIFT,
    }
}

/// Records every step.
pub(crate) const EVERYTHING: Settings = Settings {
    pounding: Pounding::Included,
    record_interval: Some(0.0),
    storage: Storage::MEMORY,
};

/// Runs from rest to the end.
pub(crate) fn run(system: &System, motion: &GroundMotion, plan: &Plan) -> Outcome {
    runs::completed(system, motion, plan, EVERYTHING.record_interval)
}

/// Runs from a given state to the end.
pub(crate) fn run_from(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    state: State,
) -> Outcome {
    let outcome = simulate_from(system, motion, plan, EVERYTHING, state, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed, "the run must reach its end");
    outcome
}

/// One column of the history.
pub(crate) fn column(outcome: &Outcome, column: Column) -> Vec<f64> {
    let history = outcome.history.as_ref().expect("histories are recorded");
    history.column(column).expect("the column is recorded")
}

/// A mass \[kg\] that only slides, on a spring \[N/m\] unless it is free.
pub(crate) fn slider(name: &str, mass: f64, stiffness: Option<f64>) -> BuildingSystem {
    let node = |y, mass, support| Node::at(0.0, y).with_mass(mass).held(support);
    let stick_model = StickModel {
        nodes: vec![
            node(0.0, 0.0, Support::Fixed),
            node(3.0, mass, Support::Guided),
        ],
        springs: stiffness
            .map(|stiffness| Spring::elastic([0, 1], stiffness))
            .into_iter()
            .collect(),
        ..StickModel::default()
    };
    let discretization = Discretization {
        stick_model,
        floors: vec![1],
        left_face: vec![1],
        right_face: vec![1],
        ..Discretization::default()
    };
    BuildingSystem::new(name, discretization)
}

/// Sliders side by side, each neighbouring pair with a contact.
pub(crate) fn sliders(buildings: Vec<BuildingSystem>, width: f64, law: &ContactLaw) -> System {
    let pairs = buildings.len() - 1;
    let mut system = System::of_buildings(buildings);
    for left in 0..pairs {
        let contact = system
            .contact_between((left, 1), (left + 1, 1))
            .expect("both have mass");
        system.contacts.push(Contact {
            gap: left,
            width,
            law: law.between(contact.ports.masses()[0], contact.ports.masses()[1]),
            ..contact
        });
    }
    system
}

/// A state of given displacements and velocities, without acceleration.
pub(crate) fn moving(system: &System, displacement: &[f64], velocity: &[f64]) -> State {
    State {
        displacement: displacement.to_vec(),
        velocity: velocity.to_vec(),
        ..State::at_rest(system, 0.0)
    }
}

/// Base shears of all buildings \[N\].
pub(crate) fn base_shears(outcome: &Outcome) -> Vec<f64> {
    let is_base = |column: Column| matches!(column.owner, Owner::Building(_));
    outcome
        .peaks
        .sizes(|column| is_base(column) && column == Column::along(column.owner, Kind::Shear))
}

/// Greatest forces of all springs that yield \[N, N·m\].
pub(crate) fn spring_forces(outcome: &Outcome) -> Vec<f64> {
    let is_spring = |column: Column| matches!(column.owner, Owner::Spring(_));
    outcome
        .peaks
        .sizes(|column| is_spring(column) && column.kind == Kind::Force)
}
