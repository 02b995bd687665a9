//! Examples of a textbook: A. K. Chopra, Dynamics of Structures.

use jostle::eigen::modes;
use jostle::structure::Discretization;
use jostle::system::BuildingSystem;
use jostle::{Analysis, Building, Damping, GroundMotion, Plan, Shear, Solver, Structure, System};
use jostle_io::builtin_record;
use serde_json::Value;

use crate::data::{document, number, numbers};
use crate::row::Row;
use crate::structures::{oscillator, run, uniform};

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = newmark_tables();
    rows.extend(five_storeys());
    rows
}

/// Examples 5.3 and 5.4, in kip, inches and seconds.
fn newmark_tables() -> Vec<Row> {
    const SOURCE: &str = "literature/C01_chopra_newmark_sdof";
    let case = document(include_str!(
        "../data/literature/C01_chopra_newmark_sdof.json"
    ));
    let input = |key: &str| number(&case, &format!("/inputs/{key}"));
    let (m, k, step) = (input("m"), input("k"), input("dt"));
    let mut building = oscillator("oscillator", m, k, 0.0);
    building.structure.equations.alpha = input("c") / m;
    let system = System::of_buildings(vec![building]);
    // The load p = 10 sin(πt/0.6) until 0.6 s enters as −m a_g.
    let load = |t: f64| {
        if t < 0.6 + 1e-9 {
            10.0 * (std::f64::consts::PI * t / 0.6).sin()
        } else {
            0.0
        }
    };
    let mut rows = Vec::new();
    for (name, beta) in [("average", 0.25), ("linear", 1.0 / 6.0)] {
        let plan = Plan {
            integrator: jostle::Integrator::newmark(beta, 0.5),
            ..uniform(step)
        };
        let published = numbers(&case, &format!("/published/{name}"));
        let recomputed = numbers(&case, &format!("/expected/{name}"));
        let got: Vec<f64> = (1..=published.len())
            .map(|steps| {
                let values = (0..=steps).map(|n| -load(n as f64 * step) / m).collect();
                let motion = GroundMotion::sampled("load", step, values);
                run(&system, &motion, &plan, None).state.displacement[0]
            })
            .collect();
        for (k, published) in published.iter().enumerate() {
            let quantity = format!(
                "{name} acceleration, u at {:.1} s, as printed [in]",
                (k + 1) as f64 * step
            );
            rows.push(Row::absolute(SOURCE, quantity, *published, got[k], 2e-4));
        }
        rows.push(Row::worst_of(
            SOURCE,
            format!("{name} acceleration, u, recomputed [in]"),
            &recomputed,
            &got,
            1e-12,
        ));
    }
    rows
}

/// Section 12.8: uniform five-storey shear frame, in kip, inches and seconds.
fn five_storeys() -> Vec<Row> {
    const SOURCE: &str = "literature/C02_chopra_5storey_elcentro";
    let case = document(include_str!(
        "../data/literature/C02_chopra_5storey_elcentro.json"
    ));
    let building = shear_frame(&case);
    let expected = |key: &str| numbers(&case, &format!("/expected/{key}"));
    let modes = modes(&building, 5).expect("the building stands");
    let mut rows = Vec::new();
    for (k, mode) in modes.iter().enumerate() {
        let number = k + 1;
        let published = numbers(&case, "/published/periods")[k];
        rows.push(Row::relative(
            SOURCE,
            format!("T{number}, as printed [s]"),
            published,
            mode.period(),
            3e-3,
        ));
        rows.push(Row::relative(
            SOURCE,
            format!("T{number} [s]"),
            expected("periods")[k],
            mode.period(),
            1e-4,
        ));
        let ratio = mode.effective_mass_ratio_x;
        rows.push(Row::relative(
            SOURCE,
            format!("effective mass of mode {number} [–]"),
            expected("eff_mass_ratio")[k],
            ratio,
            1e-4,
        ));
    }
    let roof = modes[0].floors[4];
    let shape: Vec<f64> = modes[0].floors.iter().map(|floor| floor / roof).collect();
    rows.push(Row::worst_of(
        SOURCE,
        "shape of mode 1, roof = 1 [–]",
        &expected("phi1"),
        &shape,
        1e-4,
    ));
    rows.extend(el_centro(&case));
    rows
}

/// Its response to El Centro with 5 % damping in all modes, the record scaled with the g of the example.
fn el_centro(case: &Value) -> Vec<Row> {
    const SOURCE: &str = "literature/C02_chopra_5storey_elcentro";
    /// The g of the built-in record \[m/s²\].
    const RECORDED: f64 = 9.81;
    let mut building = shear_frame(case);
    let ratio = number(case, "/inputs/zeta_all_modes");
    building
        .damp(&Damping::AllModes { ratio })
        .expect("every building has modes");
    let system = System::of_buildings(vec![building]);
    let mut motion = builtin_record("el-centro-1940-ns").expect("it is built in");
    motion.scale = number(case, "/inputs/g_in_s2") / RECORDED;
    let analysis = Analysis {
        solver: Some(Solver::Modal),
        ..Analysis::default()
    };
    let plan = Plan::choose(&system, &motion, &analysis).expect("elastic buildings have modes");
    let outcome = run(&system, &motion, &plan, None);
    let roof = &outcome.peaks.floor(0, 5);
    let got = [
        (
            "u5",
            "peak roof displacement [in]",
            roof.displacement_max()
                .value
                .max(-roof.displacement_min().value),
        ),
        ("Vb", "peak base shear [kip]", outcome.peaks.base_shear(0)),
    ];
    let mut rows = Vec::new();
    for (key, what, got) in got {
        let published = match key {
            "u5" => "/published/u5_in",
            _ => "/published/Vb_kip",
        };
        let quantity = |how: &str| format!("El Centro, 5 % in all modes, {what}{how}");
        rows.push(Row::relative(
            SOURCE,
            quantity(", as printed"),
            number(case, published),
            got,
            3e-3,
        ));
        rows.push(Row::relative(
            SOURCE,
            quantity(""),
            number(case, &format!("/expected/{key}")),
            got,
            1e-4,
        ));
    }
    rows
}

fn shear_frame(case: &Value) -> BuildingSystem {
    let input = |key: &str| number(case, &format!("/inputs/{key}"));
    let storeys = input("storeys") as usize;
    let building = Building {
        name: "frame".to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![input("weight_per_floor_kip") / input("g_in_s2"); storeys],
            stiffness: vec![input("k_kip_in"); storeys],
            storey_heights: vec![12.0 * input("h_ft"); storeys],
        }),
        damping: Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.0,
        },
        ..Building::default()
    };
    BuildingSystem::new(&building.name, Discretization::new(&building))
}
