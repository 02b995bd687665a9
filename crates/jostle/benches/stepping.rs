//! Time of the stepping kernels on frames as tall as they come; work counts are printed beside.
//!
//! `cargo bench -p jostle`
#![allow(clippy::print_stdout, reason = "a benchmark prints its work counts")]

use std::ops::ControlFlow;

use divan::Bencher;
use divan::counter::ItemsCount;
use jostle::structure::StepEquations;
use jostle::system::BuildingSystem;
use jostle::{
    Analysis, Building, ContactLaw, Damping, Frame, Gap, GroundMotion, LawKind, Model, Plan,
    Pounding, RestitutionIs, RiccatiFactor, RiccatiScratch, RiccatiSweep, Section, Settings,
    Structure, System, simulate,
};

fn main() {
    for storeys in STOREYS {
        let building = &System::assemble(&row(1, storeys))
            .expect("a valid model")
            .buildings[0];
        let couplings = RiccatiSweep::new(building).entries_of_l();
        println!(
            "{storeys} storeys: {} degrees of freedom, {couplings} couplings",
            building.equations.len()
        );
    }
    divan::main();
}

const STOREYS: [usize; 5] = [5, 10, 20, 40, 80];
const BUILDINGS: [usize; 4] = [2, 5, 10, 50];

/// A row of frames of 6.0 + 2.4 + 6.0 m, 20 mm apart.
fn row(buildings: usize, storeys: usize) -> Model {
    let section = |width: f64, depth: f64, line_mass| Section {
        flexural_rigidity: 15e9 * width * depth.powi(3) / 12.0,
        axial_rigidity: None,
        line_mass,
        shear_rigidity: None,
    };
    let building = |index: usize| Building {
        name: format!("B{index}"),
        structure: Structure::Frame(Frame {
            storey_heights: vec![3.2; storeys],
            spans: vec![6.0, 2.4, 6.0],
            columns: vec![section(0.6, 0.6 + 0.02 * (index % 5) as f64, 900.0); storeys],
            beams: vec![section(0.3, 0.6, 0.0); storeys],
            beam_mass: vec![5850.0; storeys],
            floor_mass: vec![0.0; storeys],
            column_segments: 4,
            beam_segments: vec![8, 4, 8],
            ..Frame::default()
        }),
        damping: Damping::Rayleigh {
            alpha: 0.3,
            beta: 0.004,
        },
        ..Building::default()
    };
    let law = ContactLaw {
        kind: LawKind::HertzDamp,
        stiffness: 2e9,
        restitution: 0.65,
        restitution_is: RestitutionIs::Input,
    };
    Model {
        title: "row".into(),
        buildings: (0..buildings).map(building).collect(),
        gaps: (1..buildings)
            .map(|right| Gap::after(right - 1, 0.02, law))
            .collect(),
        analysis: Analysis {
            step: Some(2e-3),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn shaking() -> GroundMotion {
    let acceleration = (0..=500)
        .map(|i| 2.0 * (0.02 * f64::from(i) * 6.0).sin() * (0.02 * f64::from(i) * 1.7).cos());
    GroundMotion::sampled("shaking", 0.02, acceleration.collect())
}

fn frame(storeys: usize) -> BuildingSystem {
    System::assemble(&row(1, storeys))
        .expect("a valid model")
        .buildings
        .remove(0)
}

/// From a model to its system, modes and pattern of the recursion included.
#[divan::bench(args = STOREYS)]
fn assemble(bencher: Bencher, storeys: usize) {
    let model = row(1, storeys);
    bencher.bench_local(|| System::assemble(&model).map(|system| system.buildings.len()));
}

#[divan::bench(args = STOREYS)]
fn solve(bencher: Bencher, storeys: usize) {
    let building = frame(storeys);
    let sweep = RiccatiSweep::new(&building);
    let mut factor = RiccatiFactor::default();
    sweep
        .factorize(&jostle::linear::StepMatrix::new(1.0, 1e6), &[], &mut factor)
        .expect("positive definite");
    let load: Vec<f64> = (0..building.equations.len())
        .map(|i| (i as f64).sin())
        .collect();
    let mut x = load.clone();
    let mut scratch = RiccatiScratch::default();
    bencher
        .counter(ItemsCount::new(2 * sweep.entries_of_l()))
        .bench_local(|| {
            x.copy_from_slice(&load);
            sweep.solve(&factor, &mut x, &mut scratch);
            x[0]
        });
}

#[divan::bench(args = STOREYS)]
fn factorize(bencher: Bencher, storeys: usize) {
    let building = frame(storeys);
    let sweep = RiccatiSweep::new(&building);
    let mut factor = RiccatiFactor::default();
    bencher.bench_local(|| {
        sweep.factorize(&jostle::linear::StepMatrix::new(1.0, 1e6), &[], &mut factor)
    });
}

#[divan::bench(args = STOREYS)]
fn strain_energy(bencher: Bencher, storeys: usize) {
    let building = frame(storeys);
    let u: Vec<f64> = (0..building.equations.len())
        .map(|i| (i as f64).sin())
        .collect();
    bencher.bench_local(|| {
        building
            .equations
            .stiffness
            .quadratic_form(divan::black_box(&u))
    });
}

/// Ten seconds in steps of 2 ms; divide by 5000 for a step.
#[divan::bench(args = STOREYS, sample_count = 5)]
fn ten_seconds_of_one_frame(bencher: Bencher, storeys: usize) {
    ten_seconds(bencher, &row(1, storeys), Pounding::Excluded);
}

#[divan::bench(args = BUILDINGS, sample_count = 3)]
fn ten_seconds_of_a_row(bencher: Bencher, buildings: usize) {
    ten_seconds(bencher, &row(buildings, 5), Pounding::Included);
}

fn ten_seconds(bencher: Bencher, model: &Model, pounding: Pounding) {
    let system = System::assemble(model).expect("a valid model");
    let motion = shaking();
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("sensible steps");
    let settings = Settings {
        pounding,
        record_interval: None,
        ..Settings::default()
    };
    bencher.bench_local(|| {
        simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        })
        .work
    });
}
