//! Links that are not linear: independent integrations in high accuracy.

use std::ops::ControlFlow;

use jostle::history::{Kind, Owner};
use jostle::{
    Analysis, Building, Column, ContactLaw, Damping, FloorPairs, Gap, GroundMotion, LawKind, Link,
    LinkLaw, Model, Outcome, Plan, RestitutionIs, Settings, Shear, Structure, System, simulate,
};
use jostle_io::builtin_record;
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::row::Row;

/// Tolerances of the program, which are those of the comparison too.
const TOLERANCES: [f64; 2] = [1e-3, 1e-4];

/// Cases and the least tolerance at which they are compared: without a spring in series, the reference itself is good to
/// 1.6e-4.
const CASES: [(&str, &str, f64); 7] = [
    (
        "ground/G4a_viscous_linear",
        include_str!("../data/ground/G4a_viscous_linear.json"),
        0.0,
    ),
    (
        "ground/G4b_viscous_035",
        include_str!("../data/ground/G4b_viscous_035.json"),
        0.0,
    ),
    (
        "ground/G4c_maxwell",
        include_str!("../data/ground/G4c_maxwell.json"),
        0.0,
    ),
    (
        "ground/G4d_friction",
        include_str!("../data/ground/G4d_friction.json"),
        0.0,
    ),
    (
        "ground/G4e_viscous_035_contact",
        include_str!("../data/ground/G4e_viscous_035_contact.json"),
        0.0,
    ),
    (
        "ground/G4f_maxwell_contact",
        include_str!("../data/ground/G4f_maxwell_contact.json"),
        0.0,
    ),
    (
        "ground/G4g_viscous_035_pure",
        include_str!("../data/ground/G4g_viscous_035_pure.json"),
        1e-3,
    ),
];

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, text, least) in CASES {
        let case = document(text);
        for tolerance in TOLERANCES {
            if tolerance >= least {
                rows.extend(compare(name, &case, tolerance));
            }
        }
    }
    rows
}

fn building(stored: &Value) -> Building {
    let mass = numbers(stored, "/floor_mass_kg");
    Building {
        name: at(stored, "/name").as_str().expect("a name").to_owned(),
        structure: Structure::Shear(Shear {
            storey_heights: vec![3.0; mass.len()],
            mass,
            stiffness: numbers(stored, "/storey_stiffness_n_m"),
        }),
        damping: Damping::Rayleigh {
            alpha: number(stored, "/alpha_1_s"),
            beta: number(stored, "/beta_s"),
        },
        ..Building::default()
    }
}

fn floors(stored: &Value) -> FloorPairs {
    let pairs = list(stored, "/floors").iter().map(|pair| {
        let floor = |side: usize| pair[side].as_u64().expect("a floor") as usize;
        (floor(0), floor(1))
    });
    FloorPairs::listed(&pairs.collect::<Vec<_>>())
}

fn link(stored: &Value) -> Link {
    let optional = |key: &str| stored[key].as_f64().unwrap_or(0.0);
    let law = match at(stored, "/law").as_str().expect("a law") {
        "viscous" => LinkLaw::Viscous {
            exponent: number(stored, "/exponent"),
        },
        "maxwell" => LinkLaw::Maxwell,
        "friction" => LinkLaw::Friction {
            slip_force: number(stored, "/slip_force"),
            stick_stiffness: number(stored, "/stick_stiffness"),
        },
        other => panic!("no reference has the law {other}"),
    };
    Link {
        between: [Some(0), Some(1)],
        floors: floors(stored),
        level_tolerance: 1e-3,
        stiffness: optional("stiffness"),
        damping: optional("damping"),
        law,
        ..Link::default()
    }
}

fn model(inputs: &Value, tolerance: f64) -> Model {
    let gap = inputs.get("contact").map(|contact| {
        let law = ContactLaw {
            kind: LawKind::HertzDamp,
            stiffness: number(contact, "/stiffness"),
            restitution: number(contact, "/restitution_input"),
            restitution_is: RestitutionIs::Input,
        };
        Gap {
            floors: floors(contact),
            ..Gap::after(0, number(inputs, "/gap_m"), law)
        }
    });
    Model {
        title: "two towers, linked".to_owned(),
        buildings: list(inputs, "/buildings").iter().map(building).collect(),
        gaps: gap.into_iter().collect(),
        links: vec![link(at(inputs, "/links"))],
        analysis: Analysis {
            tolerance,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn motion(inputs: &Value) -> GroundMotion {
    let mut record = builtin_record("el-centro-1940-ns").expect("it is built in");
    record.scale *= number(inputs, "/motion/factor");
    record.duration = number(inputs, "/duration_s");
    record
}

/// Greatest magnitude of a stored peak, which is a number or one with its instant.
fn magnitude(stored: &Value) -> f64 {
    ["max", "min"]
        .iter()
        .filter_map(|side| {
            let extreme = stored.get(side)?;
            extreme.as_f64().or_else(|| extreme["value"].as_f64())
        })
        .fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// One side of a stored peak.
fn side(stored: &Value, side: &str) -> f64 {
    let extreme = at(stored, &format!("/{side}"));
    extreme
        .as_f64()
        .unwrap_or_else(|| number(extreme, "/value"))
}

/// Everything stored of a case; numbers relative to the greatest of their kind.
fn compare(source: &str, case: &Value, tolerance: f64) -> Vec<Row> {
    let inputs = at(case, "/inputs");
    let model = model(inputs, tolerance);
    let system = System::assemble(&model).expect("a sound model");
    let motion = motion(inputs);
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("a plan");
    let settings = Settings {
        record_interval: Some(0.0),
        ..Settings::default()
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    let mut rows = Vec::new();
    let mut kind = |what: &str, pairs: Vec<(f64, f64)>| {
        let (expected, got): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
        let what = format!(
            "tolerance {tolerance:.0e}, {what}, worst of {}",
            expected.len()
        );
        rows.push(Row::worst_of(source, what, &expected, &got, tolerance));
    };
    let mut displacements = Vec::new();
    let mut accelerations = Vec::new();
    let mut unknown = 0;
    for (index, building) in system.buildings.iter().enumerate() {
        for (floor, peaks) in outcome.peaks.floors(index).iter().enumerate() {
            let stored = at(case, &format!("/peaks/{}{}", building.name, floor + 1));
            displacements.push((side(stored, "max"), peaks.displacement_max().value));
            displacements.push((side(stored, "min"), peaks.displacement_min().value));
            unknown += 1;
            let stored = case["peaks"].get(format!("total_acceleration_{unknown}"));
            accelerations
                .extend(stored.map(|stored| (magnitude(stored), peaks.total_acceleration())));
        }
    }
    kind("displacements of floors [m]", displacements);
    if !accelerations.is_empty() {
        kind("total accelerations [m/s²]", accelerations);
    }
    let of_links = |what: &str, got: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        let one = |(index, link): (usize, &jostle::interface::LinkElement)| {
            let floor = link.ports.floors()[0].expect("a floor");
            let name = format!("link{floor}-{floor}");
            let stored = case["peaks"]
                .get(format!("{what}:{name}"))
                .or_else(|| case["link_force_n"].get(&name))?;
            Some((magnitude(stored), got(index)))
        };
        let links = system.links.iter().enumerate();
        links.filter_map(one).collect()
    };
    let of_link = |kind, link| {
        outcome
            .peaks
            .of(Column::along(Owner::Link(link), kind))
            .size()
    };
    kind(
        "forces of links [N]",
        of_links("force", &|link| of_link(Kind::Force, link)),
    );
    if case["peaks"].get("deformation:link3-3").is_some() {
        kind(
            "strokes of links [m]",
            of_links("deformation", &|link| of_link(Kind::Stroke, link)),
        );
    }
    if let Some(energy) = case.get("energy_at_end") {
        let elements = |prefix: &str| -> f64 {
            let all = at(energy, "/elements_j").as_object().expect("a table");
            let object = all.iter().filter(|(name, _)| name.starts_with(prefix));
            object.filter_map(|(_, work)| work.as_f64()).sum()
        };
        let links = (0..system.links.len()).map(|link| outcome.peaks.work(Owner::Link(link)));
        let links: f64 = links.sum();
        let outcome_energy = outcome.energy;
        let dashpots = outcome_energy.damped - outcome_energy.links;
        kind(
            "energies [J]",
            vec![
                (number(energy, "/input_j"), outcome_energy.input),
                (number(energy, "/damped_j"), dashpots),
                (elements("link"), links),
                (elements("contact"), outcome_energy.contact),
            ],
        );
    }
    kind("states [m]", states(case, &system, &outcome));
    if let Some(contacts) = case["contacts"].as_object().filter(|all| !all.is_empty()) {
        let impacts = |index: usize| outcome.impacts.iter().filter(move |i| i.contact == index);
        let each = |key: &str, got: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
            let one = |(index, contact): (usize, &jostle::interface::Contact)| {
                let floor = contact.ports.floors()[0].expect("a floor");
                let stored = &contacts[&format!("contact{floor}-{floor}")];
                (number(stored, key), got(index))
            };
            system.contacts.iter().enumerate().map(one).collect()
        };
        kind(
            "peak forces of contacts [N]",
            each("/peak_force_n", &|index| {
                impacts(index).map(|i| i.peak_force).fold(0.0, f64::max)
            }),
        );
        kind(
            "impulses of contacts [N·s]",
            each("/impulse_n_s", &|index| {
                impacts(index).map(|i| i.impulse).sum()
            }),
        );
        kind(
            "first impacts [s]",
            each("/first_impact_s", &|index| {
                impacts(index)
                    .map(|i| i.start)
                    .fold(f64::INFINITY, f64::min)
            }),
        );
        kind(
            "numbers of impacts",
            each("/impact_count", &|index| impacts(index).count() as f64),
        );
    }
    // Refined steps see smaller energies at first, of which rounding is a greater share.
    let energy = &outcome.energy;
    for (when, imbalance, allowed) in [
        ("at the end", energy.imbalance(), 1e-10),
        ("at any instant", energy.worst_imbalance, 1e-8),
    ] {
        let what = format!("tolerance {tolerance:.0e}, energy imbalance {when} [–]");
        rows.push(Row::absolute(source, what, 0.0, imbalance, allowed));
    }
    rows
}

/// Displacements at the instants stored.
fn states(case: &Value, system: &System, outcome: &Outcome) -> Vec<(f64, f64)> {
    let history = outcome.history.as_ref().expect("it is recorded");
    let times = history.column(Column::TIME).expect("it has times");
    let mut columns = Vec::new();
    for (index, building) in system.buildings.iter().enumerate() {
        for floor in 1..=building.floors.len() {
            let column = Column::displacement(index, floor);
            columns.push(history.column(column).expect("it is recorded"));
        }
    }
    let mut pairs = Vec::new();
    for stored in list(case, "/states") {
        let time = number(stored, "/t_s");
        let row = times.iter().position(|t| (t - time).abs() < 1e-9);
        let row = row.expect("steps end on points of the record");
        let expected = numbers(stored, "/u_m");
        pairs.extend(expected.iter().zip(&columns).map(|(e, got)| (*e, got[row])));
    }
    pairs
}
