//! Ground that differs under the buildings, and vertical shaking: independent integrations in high accuracy.

use std::ops::ControlFlow;

use jostle::{
    Analysis, Building, ContactLaw, Damping, Gap, GroundMotion, Grounds, LawKind, Model, Outcome,
    OwnGround, Plan, RestitutionIs, RunEnd, Settings, Shear, Solver, Structure, System, simulate,
};
use jostle_io::{Format, builtin_record, read_model_text};
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::row::Row;

/// Fixed steps in free vibration and in contact \[s\], for a method of second order, and the tolerance of the comparison.
const FINE: ([f64; 2], f64) = ([2.5e-4, 1e-4], 1e-4);
/// Automatic steps at this tolerance.
const AUTOMATIC: f64 = 1e-3;
/// Closure of the energy balance \[–\].
const CLOSURE: f64 = 1e-9;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text) in [
        (
            "ground/G5a_identical_towers_delay",
            include_str!("../data/ground/G5a_identical_towers_delay.json"),
        ),
        (
            "ground/G5b_three_towers_delays",
            include_str!("../data/ground/G5b_three_towers_delays.json"),
        ),
        (
            "ground/G5c_three_towers_delays_no_contact",
            include_str!("../data/ground/G5c_three_towers_delays_no_contact.json"),
        ),
    ] {
        rows.extend(delayed(name, &document(text)));
    }
    let portal = include_str!("../data/ground/G7a_portal_horizontal_and_vertical.json");
    rows.extend(shaken_vertically(
        "ground/G7a_portal_horizontal_and_vertical",
        &document(portal),
    ));
    rows
}

fn motion(inputs: &Value) -> GroundMotion {
    let mut record = builtin_record("el-centro-1940-ns").expect("it is built in");
    record.duration = number(inputs, "/duration_s");
    record.scale *= number(inputs, "/motion/factor");
    record
}

fn row_of_towers(inputs: &Value) -> Model {
    let buildings = list(inputs, "/buildings").iter().map(|stored| {
        let mass = numbers(stored, "/floor_mass_kg");
        Building {
            name: at(stored, "/name").as_str().expect("a name").to_owned(),
            structure: Structure::Shear(Shear {
                stiffness: numbers(stored, "/storey_stiffness_n_m"),
                storey_heights: vec![3.0; mass.len()],
                mass,
            }),
            damping: Damping::Rayleigh {
                alpha: number(stored, "/alpha_1_s"),
                beta: number(stored, "/beta_s"),
            },
            ..Building::default()
        }
    });
    let contact = at(inputs, "/contact");
    let law = ContactLaw {
        kind: LawKind::HertzDamp,
        stiffness: number(contact, "/stiffness"),
        restitution: number(contact, "/restitution_input"),
        restitution_is: RestitutionIs::Input,
    };
    let gaps = numbers(inputs, "/gaps_m").into_iter().enumerate();
    let gaps = gaps.map(|(left, width)| Gap::between([Some(left), Some(left + 1)], width, law));
    Model {
        title: "ground".to_owned(),
        buildings: buildings.collect(),
        gaps: gaps.collect(),
        ..Model::default()
    }
}

fn run(system: &System, motion: &GroundMotion, analysis: &Analysis) -> Outcome {
    let plan = Plan::choose(system, motion, analysis).expect("steps");
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    let outcome = simulate(system, motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed);
    outcome
}

/// Automatic steps of modes and of all degrees of freedom, and small fixed ones.
fn settings() -> [(&'static str, Analysis, f64); 3] {
    let ([step, contact_step], limit) = FINE;
    let automatic = |solver| Analysis {
        tolerance: AUTOMATIC,
        solver: Some(solver),
        ..Analysis::default()
    };
    let fine = Analysis {
        step: Some(step),
        contact_step: Some(contact_step),
        ..automatic(Solver::Riccati)
    };
    [
        ("modes", automatic(Solver::Modal), AUTOMATIC),
        ("Riccati", automatic(Solver::Riccati), AUTOMATIC),
        ("Riccati, small steps", fine, limit),
    ]
}

/// Expected and computed numbers.
#[derive(Default)]
struct Pairs([Vec<f64>; 2]);

impl Pairs {
    fn add(&mut self, expected: f64, got: f64) {
        self.0[0].push(expected);
        self.0[1].push(got);
    }

    fn row(&self, source: &str, what: String, limit: f64) -> Row {
        let what = format!("{what}, worst of {}", self.0[0].len());
        Row::worst_of(source, what, &self.0[0], &self.0[1], limit)
    }
}

fn delayed(source: &str, case: &Value) -> Vec<Row> {
    let inputs = at(case, "/inputs");
    let model = row_of_towers(inputs);
    let system = System::assemble(&model).expect("a sound model");
    let mut motion = motion(inputs);
    let arrivals = numbers(inputs, "/motion/arrival_s").into_iter();
    let grounds = arrivals.map(|arrival| OwnGround {
        arrival,
        ..OwnGround::default()
    });
    motion.grounds = Some(Box::new(Grounds {
        own: grounds.collect(),
    }));
    let peak = |name: &str, which: &str| number(case, &format!("/peaks/{name}/{which}/value"));
    let mut rows = Vec::new();
    for (steps, analysis, limit) in settings() {
        let outcome = run(&system, &motion, &analysis);
        let [mut moved, mut shaken, mut closed] = [(); 3].map(|()| Pairs::default());
        let mut number_of_floor = 0;
        for (building, floors) in model.buildings.iter().zip(outcome.peaks.buildings()) {
            for (index, floor) in floors.iter().enumerate() {
                let name = format!("{}{}", building.name, index + 1);
                moved.add(peak(&name, "max"), floor.displacement_max().value);
                moved.add(peak(&name, "min"), floor.displacement_min().value);
                number_of_floor += 1;
                let name = format!("total_acceleration_{number_of_floor}");
                let greatest = peak(&name, "max").max(-peak(&name, "min"));
                shaken.add(greatest, floor.total_acceleration());
            }
        }
        let [mut counts, mut touches, mut forces, mut impulses] =
            [(); 4].map(|()| Pairs::default());
        for (index, contact) in system.contacts.iter().enumerate() {
            let [left, right] = [contact.gap, contact.gap + 1].map(|b| &model.buildings[b].name);
            let floor = contact.ports.floors()[0].expect("a floor");
            let name = format!("{left}-{right} floor{floor}");
            closed.add(
                peak(&format!("deformation:{name}"), "max"),
                outcome.peaks.closing(index).value,
            );
            let stored = list(at(case, &format!("/contacts/{name}")), "/impacts");
            let impacts = outcome
                .impacts
                .iter()
                .filter(|impact| impact.contact == index);
            let impacts: Vec<_> = impacts.collect();
            counts.add(stored.len() as f64, impacts.len() as f64);
            for (stored, got) in stored.iter().zip(impacts) {
                touches.add(number(stored, "/start_s"), got.start);
                forces.add(number(stored, "/peak_force_n"), got.peak_force);
                impulses.add(number(stored, "/impulse_n_s"), got.impulse);
            }
        }
        let mut row = |what: &str, pairs: &Pairs, limit: f64| {
            rows.push(pairs.row(source, format!("{steps}, {what}"), limit));
        };
        row("displacements [m]", &moved, limit);
        row("total accelerations [m/s2]", &shaken, limit);
        row("closings [m]", &closed, limit);
        let mut energies = Pairs::default();
        let energy = |key: &str| number(case, &format!("/energy_at_end/{key}"));
        energies.add(energy("input_j"), outcome.energy.input);
        energies.add(energy("ground_at_elements_j"), outcome.energy.ground);
        energies.add(energy("damped_j"), outcome.energy.damped);
        row("energies [J]", &energies, limit);
        if !touches.0[0].is_empty() {
            row("numbers of impacts [-]", &counts, 0.0);
            row("instants of touch [s]", &touches, limit);
            row("peak forces of impacts [N]", &forces, limit);
            row("impulses [N.s]", &impulses, limit);
        }
        rows.push(Row::absolute(
            source,
            format!("{steps}, worst energy imbalance [-]"),
            0.0,
            outcome.energy.worst_imbalance,
            CLOSURE,
        ));
    }
    rows
}

/// The frame of the stored case, as a model file.
fn portal(inputs: &Value) -> String {
    let n = |path: &str| number(inputs, path);
    format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\nduration = {}\nvertical = {{ scale = {} }}\n\
         [[building]]\nstoreys = 1\nstorey_height = {}\nspans = [{}]\n\
         column = {{ EI = {:?}, EA = {:?}, mass = {} }}\nbeam = {{ EI = {:?} }}\nbeam_mass = {}\n\
         column_segments = {}\nbeam_segments = {}\naxial = {{ columns = \"flexible\", beams = \"rigid\" }}\n\
         damping = {{ alpha = {}, beta = {} }}\n",
        n("/duration_s"),
        n("/motion/vertical/factor"),
        n("/frame/storey_height_m"),
        n("/frame/spans_m/0"),
        n("/frame/column/EI_n_m2"),
        n("/frame/column/EA_n"),
        n("/frame/column/mass_kg_m"),
        n("/frame/beam/EI_n_m2"),
        n("/frame/beam_mass_kg_m"),
        n("/frame/column_segments"),
        n("/frame/beam_segments"),
        n("/frame/damping/alpha_1_s"),
        n("/frame/damping/beta_s"),
    )
}

fn shaken_vertically(source: &str, case: &Value) -> Vec<Row> {
    let text = portal(at(case, "/inputs"));
    let input = read_model_text("portal.toml", &text, Format::Toml, std::path::Path::new(""));
    let input = input.expect("a sound model");
    let system = System::assemble(&input.model).expect("a sound model");
    let motion = input.ground_motion().expect("a record");
    let peak = |name: &str, which: &str| number(case, &format!("/peaks/{name}/{which}/value"));
    let mut periods = Pairs::default();
    let stored = numbers(case, "/modes/periods_s");
    let [first, second] = [stored[1], stored[3]];
    let modes = system.buildings[0].vertical_modes();
    for (expected, mode) in [first, second].into_iter().zip(&modes) {
        periods.add(expected, mode.period());
    }
    let mut rows = vec![
        Row::absolute(source, "vertical modes [-]", 2.0, modes.len() as f64, 0.0),
        periods.row(source, "periods of vertical modes [s]".into(), 1e-11),
    ];
    for (steps, analysis, limit) in settings() {
        let outcome = run(&system, &motion, &analysis);
        let floor = outcome.peaks.floor(0, 1);
        let [mut moved, mut energies, mut shaken] = [(); 3].map(|()| Pairs::default());
        moved.add(peak("x", "max"), floor.displacement_max().value);
        moved.add(peak("x", "min"), floor.displacement_min().value);
        let points = ["y_left", "y_right", "y_mid"].into_iter();
        let risen = points.flat_map(|name| [peak(name, "max"), -peak(name, "min")]);
        moved.add(risen.fold(0.0, f64::max), floor.vertical_displacement());
        let name = "total_acceleration_1";
        let greatest = peak(name, "max").max(-peak(name, "min"));
        shaken.add(greatest, floor.total_acceleration());
        let energy = |key: &str| number(case, &format!("/energy_at_end/{key}"));
        energies.add(energy("input_j"), outcome.energy.input);
        energies.add(energy("damped_j"), outcome.energy.damped);
        // Modes are exact at record points.
        let exact = if analysis.solver == Some(Solver::Modal) {
            CLOSURE
        } else {
            limit
        };
        rows.push(moved.row(source, format!("{steps}, displacements [m]"), limit));
        rows.push(shaken.row(source, format!("{steps}, total acceleration [m/s2]"), exact));
        rows.push(energies.row(source, format!("{steps}, energies [J]"), exact));
        rows.push(Row::absolute(
            source,
            format!("{steps}, worst energy imbalance [-]"),
            0.0,
            outcome.energy.worst_imbalance,
            CLOSURE,
        ));
    }
    rows
}
