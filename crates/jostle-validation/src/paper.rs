//! The built-in example after Zhang et al. (2019): published results, and the error of automatic steps.

use std::ops::ControlFlow;

use jostle::{Outcome, Plan, Pounding, Settings, Solver, System, simulate};
use jostle_io::{Overrides, builtin_model};
use serde::{Deserialize, Serialize};

use crate::row::Row;

/// Cases whose peak forces are compared with a run at very small uniform steps: peak ground acceleration
/// \[m/s²\] and gap \[m\].
const CASES: [(f64, f64); 3] = [(2.2, 0.1), (0.7, 0.01), (0.35, 0.01)];

/// Step of the reference runs, in free vibration and in contact \[s\].
const REFERENCE_STEP: f64 = 1e-5;

/// The reference runs, as stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Description of the numbers and the command that computes them.
    pub how: String,
    /// Uniform step \[s\].
    pub step_s: f64,
    /// One entry for every case.
    pub cases: Vec<ReferenceCase>,
}

/// Answer of one reference run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceCase {
    /// Peak ground acceleration \[m/s²\].
    pub pga_m_s2: f64,
    /// Gap \[m\].
    pub gap_m: f64,
    /// Contacts from the lowest floor up.
    pub floors: Vec<ReferenceFloor>,
    /// Greatest displacement to the right of every floor of both buildings \[m\].
    pub displacement_max_m: Vec<f64>,
    /// Greatest displacement to the left of every floor of both buildings \[m\].
    pub displacement_min_m: Vec<f64>,
    /// Energy taken by the contacts \[J\].
    pub contact_j: f64,
    /// Greatest imbalance of energy, relative \[–\].
    pub imbalance: f64,
}

/// One contact in a reference run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceFloor {
    /// Greatest force of every impact, in their order \[N\].
    pub forces_n: Vec<f64>,
    /// Greatest of these \[N\].
    pub peak_force_n: f64,
    /// Impulse of all impacts \[N·s\].
    pub impulse_n_s: f64,
    /// Greatest closing \[m\].
    pub closing_m: f64,
    /// First contact \[s\].
    pub first_start_s: Option<f64>,
}

/// How the steps of a run are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Steps {
    /// Automatic, by a solver.
    Tolerance(f64, Option<Solver>),
    /// In free vibration and in contact \[s\].
    Fixed(f64, f64),
}

fn run(pga: f64, gap: f64, steps: Steps, pounding: Pounding) -> (System, Outcome) {
    let mut input = builtin_model("paper").expect("the example is built in");
    let overrides = Overrides {
        pga: Some(pga),
        gap: Some(gap),
        record: None,
        angle: None,
    };
    input
        .apply(&overrides)
        .expect("peak and gap can be changed");
    match steps {
        Steps::Tolerance(tolerance, solver) => {
            input.model.analysis.tolerance = tolerance;
            input.model.analysis.solver = solver;
        }
        Steps::Fixed(step, contact_step) => {
            input.model.analysis.step = Some(step);
            input.model.analysis.contact_step = Some(contact_step);
        }
    }
    let motion = input.ground_motion().expect("the record is built in");
    let system = System::assemble(&input.model).expect("the example is valid");
    let plan = Plan::choose(&system, &motion, &input.model.analysis).expect("the steps are usable");
    let settings = Settings {
        pounding,
        record_interval: None,
        ..Settings::default()
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    (system, outcome)
}

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = buildings();
    rows.extend(observations());
    rows.extend(opensees());
    rows
}

/// Automatic steps of both solvers against the reference runs, for three tolerances.
#[must_use]
pub fn step_rows() -> Vec<Row> {
    let reference = stored_reference();
    let mut rows = Vec::new();
    for tolerance in [1e-2, 1e-3, 1e-4] {
        for case in &reference.cases {
            for solver in [Solver::Riccati, Solver::Modal] {
                rows.extend(against_reference(case, tolerance, solver));
            }
        }
    }
    rows
}

fn stored_reference() -> Reference {
    serde_json::from_str(include_str!("../data/paper/reference.json"))
        .expect("stored data are valid")
}

/// Ground motion and gap as text.
fn case_name(pga: f64, gap: f64) -> String {
    format!("{:.0} cm/s², gap {:.0} mm", pga * 100.0, gap * 1000.0)
}

/// Masses and periods of the two frames.
fn buildings() -> Vec<Row> {
    const SOURCE: &str = "independent frame program";
    let (system, outcome) = run(2.2, 0.1, Steps::Tolerance(1e-4, None), Pounding::Excluded);
    let masses = [274_950.0, 956_160.0];
    let periods = [[0.84054, 0.27110, 0.15542], [1.69638, 0.55151, 0.31629]];
    let mut rows = Vec::new();
    for ((building, mass), periods) in system.buildings.iter().zip(masses).zip(periods) {
        let name = &building.name;
        rows.push(Row::relative(
            SOURCE,
            format!("{name}, mass [kg]"),
            mass,
            building.equations.total_mass(),
            1e-9,
        ));
        for (k, (expected, mode)) in periods.iter().zip(building.lateral_modes()).enumerate() {
            rows.push(Row::relative(
                SOURCE,
                format!("{name}, lateral T{} [s]", k + 1),
                *expected,
                mode.period(),
                1e-4,
            ));
        }
    }
    for (floor, expected) in [0.0219, 0.0547, 0.0867, 0.1145, 0.1365]
        .into_iter()
        .enumerate()
    {
        let quantity = format!(
            "220 cm/s², without contact, peak closing at floor {} [m]",
            floor + 1
        );
        // Printed to a tenth of a millimetre.
        rows.push(Row::absolute(
            SOURCE,
            quantity,
            expected,
            outcome.peaks.closing(floor).value,
            5e-5,
        ));
    }
    rows
}

/// Which gaps were reported to close.
fn observations() -> Vec<Row> {
    let seen = [
        (0.35, [(0.01, true), (0.02, true), (0.03, false)]),
        (0.7, [(0.01, true), (0.04, true), (0.06, false)]),
        (2.2, [(0.1, true), (0.13, true), (0.15, false)]),
    ];
    let cases = seen
        .iter()
        .flat_map(|(pga, gaps)| gaps.iter().map(move |(gap, hit)| (*pga, *gap, *hit)));
    cases
        .map(|(pga, gap, hit)| {
            let (_, outcome) = run(pga, gap, Steps::Tolerance(1e-3, None), Pounding::Included);
            let quantity = format!("{}: contact (1 yes, 0 no)", case_name(pga, gap));
            let got = f64::from(u8::from(!outcome.impacts.is_empty()));
            Row::absolute(
                "Zhang et al. 2019",
                quantity,
                f64::from(u8::from(hit)),
                got,
                0.0,
            )
        })
        .collect()
}

/// OpenSees on the same model, Newmark (¼, ½), with the same steps: 2 ms free and 0.2 ms near contact.
fn opensees() -> Vec<Row> {
    const SOURCE: &str = "OpenSees";
    /// Forces of the lively cases are printed to a tenth of a kilonewton \[N\].
    const HALF_THE_LAST_DIGIT: f64 = 50.0;
    let answer = |pga, gap| {
        let (system, outcome) = run(pga, gap, Steps::Fixed(2e-3, 2e-4), Pounding::Included);
        summed_up(pga, gap, &system, &outcome)
    };
    // Floor, impacts, peak force [N], first contact [s].
    type Floors<'a> = &'a [(usize, usize, f64, Option<f64>)];
    let cases: [(f64, f64, Floors); 3] = [
        (2.2, 0.1, &[(5, 1, 1_282_850.0, Some(6.148))]),
        (
            0.7,
            0.01,
            &[
                (3, 2, 156_700.0, None),
                (4, 8, 287_800.0, None),
                (5, 11, 409_200.0, None),
            ],
        ),
        (
            0.35,
            0.01,
            &[
                (3, 1, 10_200.0, Some(6.137)),
                (4, 2, 109_500.0, Some(3.625)),
                (5, 4, 188_800.0, Some(3.581)),
            ],
        ),
    ];
    let mut rows = Vec::new();
    for (pga, gap, floors) in cases {
        let got = answer(pga, gap);
        let name = |what: String| format!("{}: {what}", case_name(pga, gap));
        let total: usize = floors.iter().map(|floor| floor.1).sum();
        let found: usize = got.floors.iter().map(|floor| floor.forces_n.len()).sum();
        rows.push(Row::absolute(
            SOURCE,
            name("impacts at all floors".into()),
            total as f64,
            found as f64,
            0.0,
        ));
        for &(floor, impacts, force, touch) in floors {
            let here = &got.floors[floor - 1];
            rows.push(Row::absolute(
                SOURCE,
                name(format!("floor {floor}, impacts")),
                impacts as f64,
                here.forces_n.len() as f64,
                0.0,
            ));
            rows.push(Row::absolute(
                SOURCE,
                name(format!("floor {floor}, peak force [N]")),
                force,
                here.peak_force_n,
                (1e-3 * force).max(HALF_THE_LAST_DIGIT),
            ));
            if let (Some(expected), Some(start)) = (touch, here.first_start_s) {
                rows.push(Row::absolute(
                    SOURCE,
                    name(format!("floor {floor}, first contact [s]")),
                    expected,
                    start,
                    1e-3,
                ));
            }
        }
        if pga > 2.0 {
            let roofs = [(4, 0.080_675, -0.091_521), (14, 0.099_20, -0.113_88)];
            for (index, max, min) in roofs {
                let roof = if index == 4 { "J1" } else { "J2" };
                let (right, left) = (got.displacement_max_m[index], got.displacement_min_m[index]);
                rows.push(Row::relative(
                    SOURCE,
                    name(format!("{roof} roof, peak to the right [m]")),
                    max,
                    right,
                    1e-3,
                ));
                rows.push(Row::relative(
                    SOURCE,
                    name(format!("{roof} roof, peak to the left [m]")),
                    min,
                    left,
                    1e-3,
                ));
            }
        }
    }
    rows
}

const ILL_CONDITIONED: &str = "a grazing impact: the indentation is 0.3 mm and the closing 10.3 mm. A relative error of the closing is \
    therefore 1.5 × 10.3/0.3 ≈ 50 times larger in this force. Relative to the peak force of the gap the error is \
    below the tolerance";

/// Why a coarse run may miss an impact.
const TOUCHES: &str = "the force of some of these impacts is below the tolerance times the peak force: the indentation is a few \
    micrometres, less than the error bound of displacements";

fn against_reference(case: &ReferenceCase, tolerance: f64, solver: Solver) -> Vec<Row> {
    const SOURCE: &str = "paper/reference";
    let (system, outcome) = run(
        case.pga_m_s2,
        case.gap_m,
        Steps::Tolerance(tolerance, Some(solver)),
        Pounding::Included,
    );
    let got = summed_up(case.pga_m_s2, case.gap_m, &system, &outcome);
    let name = |what: String| {
        format!(
            "{}, tolerance {tolerance:e}: {}: {what}",
            solver.name(),
            case_name(case.pga_m_s2, case.gap_m)
        )
    };
    let mut rows = Vec::new();
    let forces = case.floors.iter().flat_map(|floor| &floor.forces_n);
    let felt = tolerance * forces.copied().fold(0.0, f64::max);
    for (floor, (expected, got)) in case.floors.iter().zip(&got.floors).enumerate() {
        if expected.forces_n.is_empty() && got.forces_n.is_empty() {
            continue;
        }
        let [all, all_found] = [expected, got].map(|floor| floor.forces_n.len() as f64);
        let counted = name(format!("floor {}, impacts", floor + 1));
        let row = Row::absolute(SOURCE, counted, all, all_found, 0.0);
        let has_touches = expected.forces_n.iter().any(|force| *force < felt);
        rows.push(if has_touches && tolerance > 1e-3 {
            row.known_gap(TOUCHES)
        } else {
            row
        });
        let count = |floor: &ReferenceFloor| {
            let impacts = floor.forces_n.iter().filter(|force| **force >= felt);
            impacts.count() as f64
        };
        let counted = name(format!("floor {}, impacts above {felt:.0} N", floor + 1));
        rows.push(Row::absolute(
            SOURCE,
            counted,
            count(expected),
            count(got),
            0.0,
        ));
        let force = name(format!("floor {}, peak force [N]", floor + 1));
        let row = Row::relative(
            SOURCE,
            force,
            expected.peak_force_n,
            got.peak_force_n,
            tolerance,
        );
        let is_graze = tolerance * expected.peak_force_n < 0.1 * felt;
        rows.push(if is_graze {
            row.known_gap(ILL_CONDITIONED)
        } else {
            row
        });
    }
    for (what, expected, got) in [
        ("right", &case.displacement_max_m, &got.displacement_max_m),
        ("left", &case.displacement_min_m, &got.displacement_min_m),
    ] {
        let relative = expected.iter().zip(got).map(|(e, g)| (g / e - 1.0).abs());
        let worst = relative
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0, |(floor, _)| floor);
        let quantity = name(format!("peak displacements to the {what}, worst floor [m]"));
        rows.push(Row::relative(
            SOURCE,
            quantity,
            expected[worst],
            got[worst],
            tolerance,
        ));
    }
    rows
}

fn summed_up(pga: f64, gap: f64, system: &System, outcome: &Outcome) -> ReferenceCase {
    let floors = (0..system.contacts.len()).map(|contact| {
        let impacts = || {
            outcome
                .impacts
                .iter()
                .filter(move |impact| impact.contact == contact)
        };
        ReferenceFloor {
            forces_n: impacts().map(|impact| impact.peak_force).collect(),
            peak_force_n: impacts().fold(0.0, |peak, impact| peak.max(impact.peak_force)),
            impulse_n_s: impacts().fold(0.0, |sum, impact| sum + impact.impulse),
            closing_m: outcome.peaks.closing(contact).value,
            first_start_s: impacts().map(|impact| impact.start).min_by(f64::total_cmp),
        }
    });
    let peaks = || outcome.peaks.buildings().flatten();
    ReferenceCase {
        pga_m_s2: pga,
        gap_m: gap,
        floors: floors.collect(),
        displacement_max_m: peaks()
            .map(|floor| floor.displacement_max().value)
            .collect(),
        displacement_min_m: peaks()
            .map(|floor| floor.displacement_min().value)
            .collect(),
        contact_j: outcome.energy.contact,
        imbalance: outcome.energy.worst_imbalance,
    }
}

/// Repeats the reference runs; takes minutes.
#[must_use]
pub fn reference() -> Reference {
    let cases = std::thread::scope(|scope| {
        let runs = CASES.map(|(pga, gap)| {
            scope.spawn(move || {
                let (system, outcome) = run(
                    pga,
                    gap,
                    Steps::Fixed(REFERENCE_STEP, REFERENCE_STEP),
                    Pounding::Included,
                );
                summed_up(pga, gap, &system, &outcome)
            })
        });
        runs.into_iter()
            .map(|run| run.join().expect("a reference run ends"))
            .collect()
    });
    Reference {
        how: "the built-in example \"paper\" of jostle itself at a uniform step; made by: \
              cargo run --release -p jostle-validation -- --reference"
            .to_owned(),
        step_s: REFERENCE_STEP,
        cases,
    }
}
