//! Contacts as ports against steps that end at every touch and release.

use std::ops::ControlFlow;

use super::{PortOutcome, follow};
use crate::contact::{ContactLaw, LawKind, ModifiedKelvin, RestitutionIs};
use crate::model::{Analysis, Building, Damping, Gap, Model, Shear, Structure};
use crate::motion::GroundMotion;
use crate::stepping::{Outcome, Plan, Settings, simulate};
use crate::system::System;

/// A shear tower with masses \[kg\] and stiffnesses \[N/m\].
fn tower(name: &str, storeys: usize, mass: f64, stiffness: f64) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![mass; storeys],
            stiffness: vec![stiffness; storeys],
            storey_heights: vec![3.2; storeys],
        }),
        damping: Damping::Ratio {
            ratio: 0.05,
            modes: Vec::new(),
        },
        ..Building::default()
    }
}

fn law(kind: LawKind) -> ContactLaw {
    let power = matches!(
        kind,
        LawKind::Hertz | LawKind::HertzDamp | LawKind::Ye | LawKind::Jankowski
    );
    ContactLaw {
        kind,
        stiffness: if power { 2e9 } else { 2e8 },
        restitution: 0.65,
        restitution_is: RestitutionIs::Realised,
    }
}

/// Two sines that beat, linear between points 20 ms apart.
fn shaking(scale: f64) -> GroundMotion {
    let wave = |i: i32| {
        let t = 0.02 * f64::from(i);
        scale * (libm::sin(7.1 * t) + 0.8 * libm::sin(11.3 * t + 0.4)) * libm::sin(0.5 * t)
    };
    GroundMotion::sampled("beats", 0.02, (0..=300).map(wave).collect())
}

fn both(model: &Model, motion: &GroundMotion) -> (Outcome, PortOutcome) {
    let system = System::assemble(model).expect("the model is sound");
    let analysis = Analysis {
        tolerance: 1e-6,
        ..Analysis::default()
    };
    let plan = Plan::choose(&system, motion, &analysis).expect("modes suit");
    let known = simulate(&system, motion, &plan, Settings::default(), |_| {
        ControlFlow::Continue(())
    });
    let found = follow(&system, motion, &plan, 1e-6).expect("steps converge");
    (known, found)
}

/// Worst differences of impacts in peak force and impulse relative to the greatest of all, and of sways of floors; the number
/// of impacts, which has to be equal.
fn compare(known: &Outcome, found: &PortOutcome) -> ([f64; 3], usize) {
    let mut ordered: Vec<_> = known.impacts.iter().collect();
    ordered.sort_by(|a, b| (a.contact, a.start).partial_cmp(&(b.contact, b.start)).expect("finite"));
    let mut ours: Vec<_> = found.impacts.iter().collect();
    ours.sort_by(|a, b| (a.contact, a.start).partial_cmp(&(b.contact, b.start)).expect("finite"));
    assert_eq!(ordered.len(), ours.len(), "equal numbers of impacts");
    let strongest = ordered.iter().map(|i| i.peak_force).fold(0.0, f64::max);
    let largest = ordered.iter().map(|i| i.impulse).fold(0.0, f64::max);
    let mut worst = [0.0_f64; 3];
    for (known, found) in ordered.iter().zip(&ours) {
        assert_eq!(known.contact, found.contact);
        worst[0] = worst[0].max((known.peak_force - found.peak_force).abs() / strongest);
        worst[1] = worst[1].max((known.impulse - found.impulse).abs() / largest);
    }
    for (building, sways) in found.sways.iter().enumerate() {
        let greatest = sways.iter().copied().fold(0.0, f64::max);
        for (floor, sway) in sways.iter().enumerate() {
            let known = known.peaks.floor(building, floor).displacement().size();
            worst[2] = worst[2].max((known - sway).abs() / greatest);
        }
    }
    (worst, ordered.len())
}

fn pair(kind: LawKind, gap: f64) -> Model {
    Model {
        title: "Pair".to_owned(),
        buildings: vec![tower("soft", 3, 40e3, 20e6), tower("stiff", 5, 60e3, 90e6)],
        gaps: vec![Gap::after(0, gap, law(kind))],
        ..Model::default()
    }
}

#[test]
fn every_law_of_a_pair_agrees_with_steps_that_end_at_touches() {
    for kind in [
        LawKind::Linear,
        LawKind::Hertz,
        LawKind::HertzDamp,
        LawKind::Ye,
        LawKind::Kelvin,
        LawKind::KelvinNoTension,
        LawKind::ModifiedKelvin(ModifiedKelvin::Ye),
        LawKind::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski),
        LawKind::Jankowski,
    ] {
        let (known, found) = both(&pair(kind.clone(), 0.02), &shaking(2.5));
        let (worst, count) = compare(&known, &found);
        println!(
            "{kind:?}: {count} impacts, {worst:?}, {} steps, {} iterations, {} halved; {} steps",
            found.steps, found.iterations, found.halved, known.work.steps
        );
    }
}
