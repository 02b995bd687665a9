//! Buildings on soil: formulas, complex roots, and independent integrations in high accuracy.

use std::ops::ControlFlow;

use jostle::history::{Owner, Peak, PeaksOf};
use jostle::{
    Analysis, Base, Building, ContactLaw, Damping, Foundation, Gap, GroundMotion, HalfSpace,
    LawKind, Model, Outcome, Plan, RestitutionIs, RunEnd, Settings, Shear, Soil, SoilCoupling,
    Solver, Structure, System, simulate,
};
use jostle_io::builtin_record;
use serde_json::Value;

use crate::data::{at, document, list, number, numbers};
use crate::row::Row;

/// Tolerances of automatic runs, which are those of the comparison too.
const TOLERANCES: [f64; 2] = [1e-3, 1e-4];
/// Free-vibration and contact step \[s\], and the tolerance of the comparison: the method is of second order.
const FINE: ([f64; 2], f64) = ([2e-4, 2e-5], 2e-5);

/// Steps from which on the energy balance is held to 10⁻⁹ \[s\].
const SHORTEST: f64 = 2e-5;

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = constants(&document(include_str!(
        "../data/ground/G6c_foundation_constants.json"
    )));
    let one = document(include_str!("../data/ground/G6a_sway_rocking_sdof.json"));
    rows.extend(roots("ground/G6a_sway_rocking_sdof", &one));
    rows.extend(compare(
        "ground/G6a_sway_rocking_sdof",
        &one,
        one_mass(&one),
    ));
    for (name, text) in [
        (
            "ground/G6b_two_foundations_coupled",
            include_str!("../data/ground/G6b_two_foundations_coupled.json"),
        ),
        (
            "ground/G6d_two_foundations_coupled_contact",
            include_str!("../data/ground/G6d_two_foundations_coupled_contact.json"),
        ),
    ] {
        let case = document(text);
        rows.extend(compare(name, &case, two_towers(&case)));
    }
    rows
}

/// Springs and dashpots of the plane.
fn constants(case: &Value) -> Vec<Row> {
    let mut rows = Vec::new();
    for stored in list(case, "/cases") {
        let foundation = Foundation {
            embedment: number(stored, "/embedment_m"),
            ..Foundation::rectangle(
                number(stored, "/length_m"),
                number(stored, "/width_m"),
                100e3,
            )
        };
        let soil = HalfSpace {
            shear_wave_velocity: number(stored, "/shear_wave_velocity_m_s"),
            density: number(stored, "/density_kg_m3"),
            poisson_ratio: number(stored, "/poisson_ratio"),
            damping: 0.0,
        };
        let found = soil.springs(&foundation, number(stored, "/period_s"));
        let of = |key: &str| number(stored, &format!("/of_the_plane/{key}"));
        let pairs = [
            (of("horizontal_stiffness_n_m"), found.sway_stiffness),
            (of("horizontal_damping_n_s_m"), found.sway_damping),
            (of("rotational_stiffness_n_m_rad"), found.rocking_stiffness),
            (of("rotational_damping_n_m_s_rad"), found.rocking_damping),
            (number(stored, "/a0"), found.frequency),
        ];
        let worst = pairs
            .iter()
            .map(|(expected, found)| (found / expected - 1.0).abs())
            .fold(0.0, f64::max);
        rows.push(Row::relative(
            "ground/G6c_foundation_constants",
            format!(
                "{} × {} m, {} m deep: springs, dashpots and a0, worst of 5",
                foundation.length, foundation.width, foundation.embedment
            ),
            1.0,
            1.0 + worst,
            1e-12,
        ));
    }
    rows
}

/// A foundation of the stored mass and rotary inertia. Its sides do not matter where matrices are given.
fn foundation(mass: f64, rotary_inertia: f64) -> Base {
    Base {
        foundation: Some(Foundation {
            rotary_inertia,
            ..Foundation::rectangle(12.0, 12.0, mass)
        }),
        ..Base::default()
    }
}

fn given(stiffness: Vec<Vec<f64>>, damping: Vec<Vec<f64>>) -> Option<Soil> {
    Some(Soil {
        half_space: None,
        coupling: SoilCoupling::Given { stiffness, damping },
    })
}

fn one_mass(case: &Value) -> Model {
    let inputs = at(case, "/inputs");
    let on = at(inputs, "/foundation");
    let diagonal = |a: &str, b: &str| {
        let (a, b) = (number(on, a), number(on, b));
        vec![vec![a, 0.0], vec![0.0, b]]
    };
    Model {
        title: "one mass on soil".to_owned(),
        buildings: vec![Building {
            name: "A".to_owned(),
            structure: Structure::Shear(Shear {
                mass: vec![number(inputs, "/mass_kg")],
                stiffness: vec![number(inputs, "/stiffness_n_m")],
                storey_heights: vec![number(inputs, "/height_m")],
            }),
            damping: Damping::ratio(number(inputs, "/damping_ratio"), [1]),
            base: foundation(number(on, "/mass_kg"), number(on, "/rotary_inertia_kg_m2")),
            ..Building::default()
        }],
        soil: given(
            diagonal("/horizontal_stiffness_n_m", "/rotational_stiffness_n_m_rad"),
            diagonal("/horizontal_damping_n_s_m", "/rotational_damping_n_m_s_rad"),
        ),
        ..Model::default()
    }
}

/// Period and damping of the first mode against the complex roots: the latter is of first order in the damping.
fn roots(source: &str, case: &Value) -> Vec<Row> {
    let system = System::assemble(&one_mass(case)).expect("a sound model");
    let place = system.buildings[0].foundation.expect("it has one");
    let root = |key: &str| number(case, &format!("/closed_form/with_masses/0/{key}"));
    vec![
        Row::relative(
            source,
            "first circular frequency [rad/s]".to_owned(),
            root("omega_rad_s"),
            2.0 * std::f64::consts::PI / place.period,
            2e-3,
        ),
        Row::relative(
            source,
            "damping ratio of the first mode [-]".to_owned(),
            root("damping_ratio"),
            place.damping,
            2e-3,
        ),
    ]
}

fn tower(stored: &Value) -> Building {
    let mass = numbers(stored, "/floor_mass_kg");
    Building {
        name: at(stored, "/name").as_str().expect("a name").to_owned(),
        structure: Structure::Shear(Shear {
            storey_heights: vec![number(stored, "/storey_height_m"); mass.len()],
            mass,
            stiffness: numbers(stored, "/storey_stiffness_n_m"),
        }),
        damping: Damping::Rayleigh {
            alpha: number(stored, "/alpha_1_s"),
            beta: number(stored, "/beta_s"),
        },
        base: foundation(
            number(stored, "/foundation_mass_kg"),
            number(stored, "/foundation_rotary_inertia_kg_m2"),
        ),
        ..Building::default()
    }
}

fn two_towers(case: &Value) -> Model {
    let inputs = at(case, "/inputs");
    let matrix = |key: &str| {
        let rows = list(inputs, key).iter();
        rows.map(|row| numbers(row, "")).collect()
    };
    let gaps = at(inputs, "/contact").as_object().map(|_| {
        let contact = at(inputs, "/contact");
        let law = ContactLaw {
            kind: LawKind::HertzDamp,
            stiffness: number(contact, "/stiffness"),
            restitution: number(contact, "/restitution_input"),
            restitution_is: RestitutionIs::Input,
        };
        Gap::after(0, number(inputs, "/gap_m"), law)
    });
    Model {
        title: "two towers on soil".to_owned(),
        buildings: list(inputs, "/buildings").iter().map(tower).collect(),
        gaps: gaps.into_iter().collect(),
        soil: given(matrix("/soil_stiffness"), matrix("/soil_damping")),
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

/// Runs a model at several steps and compares it with an integration.
fn compare(source: &str, case: &Value, model: Model) -> Vec<Row> {
    let system = System::assemble(&model).expect("a sound model");
    let inputs = at(case, "/inputs");
    let mut motion = builtin_record("el-centro-1940-ns").expect("it is built in");
    motion.duration = number(inputs, "/duration_s");
    let automatic = TOLERANCES.map(|tolerance| {
        let analysis = Analysis {
            tolerance,
            ..Analysis::default()
        };
        (format!("tolerance {tolerance:e}"), analysis, tolerance)
    });
    let ([step, contact_step], limit) = FINE;
    let fine = Analysis {
        step: Some(step),
        contact_step: Some(contact_step),
        solver: Some(Solver::Riccati),
        ..Analysis::default()
    };
    let independent = Analysis {
        solver: Some(Solver::Stiffness),
        ..fine.clone()
    };
    let fixed = [
        ("small steps".to_owned(), fine, limit),
        (
            "small steps, direct stiffness".to_owned(),
            independent,
            limit,
        ),
    ];
    let mut rows = Vec::new();
    for (steps, analysis, limit) in automatic.into_iter().chain(fixed) {
        let outcome = run(&system, &motion, &analysis);
        let mut row = |what: &str, pairs: &[(f64, f64)], limit: f64| {
            rows.push(worst(source, format!("{steps}, {what}"), pairs, limit));
        };
        for (index, building) in model.buildings.iter().enumerate() {
            peaks(case, &model, &outcome, index, |what, pairs| {
                row(&format!("{}: {what}", building.name), pairs, limit);
            });
        }
        let energy = |key: &str| number(case, &format!("/energy_at_end/{key}"));
        row(
            "energies [J]",
            &[
                (energy("input_j"), outcome.energy.input),
                (energy("damped_j"), outcome.energy.damped),
            ],
            limit,
        );
        // A million steps of some microseconds leave more rounding behind, on rigid ground as well.
        if outcome.free_step.is_some_and(|step| step > SHORTEST) {
            row(
                "error of the energy balance [-]",
                &[(1.0, 1.0 + outcome.energy.imbalance())],
                1e-9,
            );
        }
        if model.gaps.is_empty() {
            continue;
        }
        for floor in 1..=3 {
            let contact = at(case, &format!("/contacts/contact{floor}-{floor}"));
            let impacts: Vec<_> = outcome
                .impacts
                .iter()
                .filter(|impact| impact.contact == floor - 1)
                .collect();
            let greatest = |of: fn(&jostle::Impact) -> f64| {
                impacts.iter().map(|impact| of(impact)).fold(0.0, f64::max)
            };
            // Contacts are judged against the strongest of the gap.
            let scale = number(case, "/contacts/contact3-3/peak_force_n");
            row(
                &format!("peak force at floor {floor} [N]"),
                &[
                    (scale, scale),
                    (
                        number(contact, "/peak_force_n"),
                        greatest(|impact| impact.peak_force),
                    ),
                ],
                limit.max(1e-4),
            );
        }
    }
    rows
}

/// Peaks of one building: sway, rocking, floors and accelerations.
fn peaks(
    case: &Value,
    model: &Model,
    outcome: &Outcome,
    index: usize,
    mut take: impl FnMut(&str, &[(f64, f64)]),
) {
    let prefix = |name: &str| match model.buildings.len() {
        1 => name.to_owned(),
        _ => format!("{}.{name}", model.buildings[index].name),
    };
    let floors = &outcome.peaks.floors(index);
    let floor = |number: usize| match model.buildings.len() {
        1 => "u".to_owned(),
        _ => format!("{}{number}", model.buildings[index].name),
    };
    let peak = |name: &str, which: &str| number(case, &format!("/peaks/{name}/{which}/value"));
    let both = |name: &str, of: PeaksOf<'_>| {
        let Peak { greatest, least } = of.displacement();
        [
            (peak(name, "max"), greatest.value),
            (peak(name, "min"), least.value),
        ]
    };
    let foundation = outcome.peaks.owned_by(Owner::Foundation(index));
    take("sway [m]", &both(&prefix("u_f"), foundation));
    take(
        "rocking [rad]",
        &both(&prefix("theta"), foundation.turning()),
    );
    let displacements: Vec<(f64, f64)> = floors
        .iter()
        .enumerate()
        .flat_map(|(k, peaks)| both(&floor(k + 1), *peaks))
        .collect();
    take("displacements of floors [m]", &displacements);
    // Unknowns are u_f, θ and the floors of every building.
    let before: usize = model.buildings[..index]
        .iter()
        .map(|building| building.floors() + 2)
        .sum();
    let accelerations: Vec<(f64, f64)> = floors
        .iter()
        .enumerate()
        .map(|(k, peaks)| {
            let name = format!("total_acceleration_{}", before + 3 + k);
            let expected = peak(&name, "max").abs().max(peak(&name, "min").abs());
            (expected, peaks.total_acceleration())
        })
        .collect();
    take("total accelerations of floors [m/s2]", &accelerations);
    if model.buildings.len() == 1 {
        let storey = peak("storey", "max").abs().max(peak("storey", "min").abs());
        let height = model.buildings[0].storey_heights()[0];
        take(
            "deformation of the storey [m]",
            &[(storey, floors[0].storey_drift() * height)],
        );
    }
}

/// The worst of pairs of expected and computed numbers, relative to the greatest expected one.
fn worst(source: &str, what: String, pairs: &[(f64, f64)], limit: f64) -> Row {
    let greatest = pairs
        .iter()
        .fold(0.0, |most: f64, pair| most.max(pair.0.abs()));
    let apart = |pair: &(f64, f64)| (pair.1 - pair.0).abs();
    let worst = pairs.iter().max_by(|a, b| apart(a).total_cmp(&apart(b)));
    let worst = worst.copied().unwrap_or_default();
    Row::relative(
        source,
        format!("{what}, worst of {}", pairs.len()),
        greatest,
        greatest + (worst.1 - worst.0),
        limit,
    )
}

#[cfg(test)]
mod tests {
    /// Prints every comparison of this family.
    #[test]
    fn soil_is_as_computed_elsewhere() {
        let rows = super::rows();
        let misses: Vec<String> = rows
            .iter()
            .filter(|row| row.misses())
            .map(|row| format!("{row:?}"))
            .collect();
        for row in &rows {
            println!("{row:?}");
        }
        assert!(misses.is_empty(), "{}", misses.join("\n"));
    }
}
