//! Buildings given by matrices with a plan: the same buildings by their members, and what is refused.

use std::f64::consts::TAU;

use jostle::system::BuildingSystem;
use jostle::{Structure, System, Tiers};
use jostle_testkit::compare::{close, largest, near};
use jostle_testkit::files::{refusal, sound};
use jostle_testkit::runs::run_and_summary;

/// Three storeys without symmetry; the middle floor has its centre of mass elsewhere.
const FRAME: &str = r#"
[[building]]
name = "A"
kind = "space-frame"
lines_x = ["0 m", "6 m", "11 m"]
lines_y = ["0 m", "5 m", "9 m"]
storey_height = ["4 m", "3.2 m", "3.2 m"]
mass = ["95 t", "92 t", "80 t"]
mass_centre = [["5.5 m", "4.5 m"], ["5.4 m", "4.6 m"], ["5.5 m", "4.5 m"]]
elastic_modulus = "30 GPa"
beam_x = { width = "0.3 m", depth = "0.6 m" }
beam_y = { width = "0.3 m", depth = "0.5 m" }
damping = { ratio = 0.05 }

[[building.column]]
size = ["0.5 m", "0.5 m"]

[[building.column]]
x = 1
y = 2
size = ["0.5 m", "0.8 m"]
"#;

const NEIGHBOUR: &str = r#"
[[building]]
name = "B"
kind = "shear"
plan = ["8 m", "9 m"]
mass = ["70 t", "70 t", "60 t"]
storey_height = ["4 m", "3.2 m", "3.2 m"]
stiffness = { x = "150 MN/m", y = "120 MN/m" }
eccentricity = ["1 m", "0.5 m"]

[[gap]]
between = ["A", "B"]
width = "15 mm"
law = "kelvin"
stiffness = "300 MN/m"
restitution = 0.65

[analysis]
solver = "modal"
step = "2 ms"
contact_step = "0.2 ms"

[motion]
record = "el-centro-1940-ns"
pga = "0.4 g"
angle = "25 deg"
duration = "6 s"
"#;

/// Displacement of a floor in the equations: along x and across and rotation of the floors, from the ground up.
fn dof(system: &BuildingSystem, place: usize) -> usize {
    system.tracks[(place % 3) * system.floors.len() + place / 3].dof
}

/// Stiffness over the motions of the floors, row by row, and their masses.
fn matrices(system: &BuildingSystem) -> (Vec<Vec<f64>>, Vec<f64>) {
    let n = 3 * system.floors.len();
    assert_eq!(system.equations.len(), n);
    let column = |place: usize| {
        let mut unit = vec![0.0; n];
        unit[dof(system, place)] = 1.0;
        let mut force = vec![0.0; n];
        system.equations.stiffness.multiply_add(&unit, &mut force);
        (0..n).map(|row| force[dof(system, row)]).collect()
    };
    let mass = (0..n).map(|place| system.equations.mass[dof(system, place)]);
    ((0..n).map(column).collect(), mass.collect())
}

/// A building given by matrices whose floors have these reference points \[m\].
fn given(stiffness: &[Vec<f64>], mass: &str, at: &[[f64; 2]], more: &str) -> String {
    let mut text = format!(
        "[[building]]\nname = \"A\"\nkind = \"given\"\nplan = [\"11 m\", \"9 m\"]\n{more}matrices = {{ stiffness = {stiffness:?}, mass = {mass} }}\n[building.ports]\n"
    );
    let heights = ["4 m", "7.2 m", "10.4 m"];
    for (floor, ([x, y], height)) in at.iter().zip(heights).enumerate() {
        let first = 3 * floor + 1;
        text += &format!(
            "\"{}\" = {{ dofs = [{first}, {}, {}], at = [{x:?}, {y:?}], height = \"{height}\" }}\n",
            floor + 1,
            first + 1,
            first + 2
        );
    }
    text
}

const CENTRES: [[f64; 2]; 3] = [[5.5, 4.5], [5.4, 4.6], [5.5, 4.5]];

/// The same building as the frame, by the matrices of its floors.
fn frame_as_matrices(more: &str) -> String {
    let input = sound(&format!("{FRAME}[motion]\nrecord = \"el-centro\"\n"));
    let system = System::assemble(&input.model).expect("sound");
    let (stiffness, mass) = matrices(&system.buildings[0]);
    given(&stiffness, &format!("{mass:?}"), &CENTRES, more)
}

/// All numbers of a serialised value.
fn numbers(value: &serde_json::Value, found: &mut Vec<f64>) {
    match value {
        serde_json::Value::Number(number) => found.extend(number.as_f64()),
        serde_json::Value::Array(list) => list.iter().for_each(|element| numbers(element, found)),
        serde_json::Value::Object(table) => table.values().for_each(|table| numbers(table, found)),
        _ => {}
    }
}

/// Runs both and compares peaks of floors and forces of impacts.
fn same_run(expected: &str, found: &str, least_impacts: usize) {
    let run = |text: &str| {
        let input = sound(text);
        let motion = input.ground_motion().expect("built in");
        run_and_summary(&input.model, &motion)
    };
    let (one, other) = (run(expected), run(found));
    assert!(
        one.1.impacts.len() >= least_impacts,
        "{}",
        one.1.impacts.len()
    );
    assert_eq!(one.1.impacts.len(), other.1.impacts.len());
    let greatest = one.1.impacts.iter().map(|impact| impact.peak_force);
    let greatest = greatest.fold(0.0, f64::max);
    for (one, other) in one.1.impacts.iter().zip(&other.1.impacts) {
        assert_eq!(one.contact, other.contact);
        close(other.peak_force, one.peak_force, greatest, 1e-9, "force");
        close(other.peak_force_at, one.peak_force_at, 1.0, 1e-9, "instant");
    }
    let faces = one.1.face_impacts.iter().zip(&other.1.face_impacts);
    assert_eq!(one.1.face_impacts.len(), other.1.face_impacts.len());
    for (one, other) in faces {
        close(
            other.peak_force.value,
            one.peak_force.value,
            greatest,
            1e-9,
            "face force",
        );
    }
    for (one, other) in one.2.buildings.iter().zip(&other.2.buildings) {
        for (one, other) in one.floors.iter().zip(&other.floors) {
            let lists = [one, other].map(|floor| {
                let mut list = Vec::new();
                numbers(&serde_json::to_value(floor).expect("serialises"), &mut list);
                list
            });
            assert_eq!(lists[0].len(), lists[1].len());
            assert!(lists[0].len() > 12, "rotations and both directions");
            for (one, other) in lists[0].iter().zip(&lists[1]) {
                close(*other, *one, one.abs().max(1e-6), 1e-9, "peak of a floor");
            }
        }
    }
}

#[test]
fn a_space_frame_given_by_the_matrices_of_its_floors_gives_the_same_run() {
    let damping = "damping = { ratio = 0.05 }\n";
    let other = frame_as_matrices(damping);
    same_run(
        &format!("{FRAME}{NEIGHBOUR}"),
        &format!("{other}{NEIGHBOUR}"),
        10,
    );
}

/// Friction along faces, steps of the direct solver, and a building that stands turned on the site.
#[test]
fn friction_and_another_solver_and_a_turned_building_give_the_same_run() {
    let riccati = NEIGHBOUR
        .replace("\"modal\"", "\"riccati\"")
        .replace("width = \"15 mm\"", "friction = 0.3\nreach = \"8 m\"")
        .replace(
            "name = \"B\"",
            "name = \"B\"\nat = [\"10.905 m\", \"-1 m\"]",
        );
    let turned = "at = [\"0 m\", \"0 m\"]\nangle = \"8 deg\"\n";
    let damping = "damping = { ratio = 0.05 }\n";
    let frame = FRAME.replace("kind", &format!("{turned}kind"));
    let other = frame_as_matrices(&format!("{turned}{damping}"));
    same_run(
        &format!("{frame}{riccati}"),
        &format!("{other}{riccati}"),
        1,
    );
}

#[test]
fn bearings_carry_a_given_building_as_they_carry_its_frame() {
    let isolation = "\n[building.isolation]\nkind = \"lead-rubber\"\nstiffness = \"60 MN/m\"\nyield = \"150 kN\"\npost_yield = 0.1\nmat_mass = \"100 t\"\n";
    let other = frame_as_matrices("damping = { ratio = 0.05 }\n");
    let apart = NEIGHBOUR
        .replace("15 mm", "40 mm")
        .replace("solver = \"modal\"\n", "");
    same_run(
        &format!("{FRAME}{isolation}{apart}"),
        &format!("{other}{isolation}{apart}"),
        1,
    );
}

fn tiers(text: &str) -> Tiers {
    match &sound(text).model.buildings[0].structure {
        Structure::Tiers(tiers) => tiers.clone(),
        other => panic!("no plan: {other:?}"),
    }
}

const MOTION: &str = "\n[motion]\nrecord = \"el-centro\"\nduration = \"4 s\"\n";

/// One floor of 40 t, 8 m × 6 m; springs are those of closed forms.
fn one_floor(matrices: &str, port: &str, more: &str) -> String {
    format!(
        "[[building]]\nname = \"A\"\nkind = \"given\"\nplan = [\"8 m\", \"6 m\"]\n{more}matrices = {{ {matrices} }}\nports = {{ \"1\" = {{ {port} }} }}\n"
    )
}

/// Rows of rotations are moments per radian: a spring of 40 kip/in, 100 in from the middle, has 40 · 100 kip and 40 · 100² kip·in.
#[test]
fn units_act_on_rotations_as_on_moments() {
    let (inch, kip) = (0.0254, 4448.2216152605);
    let port = "dofs = [2, 3, 1], height = \"3 m\"";
    let (m, j) = (0.2, 3000.0);
    let matrices = format!(
        "stiffness = [[900000.0, -4000, 0], [-4000, 40, 0], [0, 0, 50]], mass = [{j}, {m}, {m}]"
    );
    let tiers = tiers(&(one_floor(&matrices, port, "units = \"kip, in\"\n") + MOTION));
    near(tiers.floors[0].mass, m * kip / inch, 1e-12, "mass");
    near(
        tiers.floors[0].polar_mass,
        j * kip * inch,
        1e-12,
        "polar mass",
    );
    assert_eq!(tiers.floors[0].centre, [4.0, 3.0]);
    let rows = tiers.matrices.expect("given").stiffness;
    near(rows[0][0], 40.0 * kip / inch, 1e-12, "along x");
    near(rows[1][1], 50.0 * kip / inch, 1e-12, "across");
    near(rows[2][0], -4000.0 * kip, 1e-12, "coupling");
    near(rows[2][2], 900000.0 * kip * inch, 1e-12, "torsion");
}

/// A post without mass between two springs of 2k is one of k; its rotation hangs on it.
#[test]
fn displacements_without_mass_are_condensed() {
    let k = 30e6;
    let stiffness = vec![
        vec![2.0 * k, 0.0, 0.0, -2.0 * k],
        vec![0.0, k, 0.0, 0.0],
        vec![0.0, 0.0, 9.0 * k, 0.0],
        vec![-2.0 * k, 0.0, 0.0, 4.0 * k],
    ];
    let port = "dofs = [1, 2, 3], height = \"3 m\"";
    let text = one_floor(
        &format!("stiffness = {stiffness:?}, mass = [40e3, 40e3, 4e5, 0.0]"),
        port,
        "",
    );
    let rows = tiers(&(text + MOTION)).matrices.expect("given").stiffness;
    assert_eq!(rows, [vec![k], vec![0.0, k], vec![0.0, 0.0, 9.0 * k]]);
}

/// Along x, y and in rotation a floor at the middle of its plan is three oscillators, whose dashpots need not be of Rayleigh's form.
#[test]
fn a_damping_matrix_damps_every_motion_by_itself() {
    let (m, j, k) = (40e3_f64, 4e5, [30e6, 20e6, 5e8]);
    let c = [0.02, 0.07, 0.03];
    let omega = [0, 1, 2].map(|i| (k[i] / [m, m, j][i]).sqrt());
    let values = [0, 1, 2].map(|i| 2.0 * c[i] * omega[i] * [m, m, j][i]);
    let diagonal = |v: [f64; 3]| {
        format!(
            "[[{:?}, 0, 0], [0, {:?}, 0], [0, 0, {:?}]]",
            v[0], v[1], v[2]
        )
    };
    let port = "dofs = [1, 2, 3], height = \"3 m\"";
    let matrices = |damping: &str| {
        format!(
            "stiffness = {}, mass = [{m:?}, {m:?}, {j:?}]{damping}",
            diagonal(k)
        )
    };
    let peak = |text: &str| {
        let input = sound(text);
        let motion = input.ground_motion().expect("built in");
        let (system, outcome, _) = run_and_summary(&input.model, &motion);
        (system, outcome.peaks.floor(0, 1).displacement_max().value)
    };
    let analysis = "[analysis]\nsolver = \"stiffness\"\nstep = \"1 ms\"\n";
    let damping = format!(", damping = {}", diagonal(values));
    let (system, found) = peak(&format!(
        "{}{analysis}{MOTION}",
        one_floor(&matrices(&damping), port, "")
    ));
    let periods: Vec<f64> = system.buildings[0]
        .modes
        .iter()
        .map(|m| m.period())
        .collect();
    let mut expected = omega.map(|omega| TAU / omega);
    expected.sort_by(|a, b| b.total_cmp(a));
    for (found, expected) in periods.iter().zip(expected) {
        near(*found, expected, 1e-12, "period");
    }
    let plane = format!(
        "[[building]]\nkind = \"shear\"\nmass = [40e3]\nstiffness = [30e6]\nstorey_height = 3\ndamping = {{ alpha = {:?} }}\n{analysis}{MOTION}",
        2.0 * c[0] * omega[0]
    );
    near(found, peak(&plane).1, 1e-9, "peak displacement");
    // What is α M + β K is found as such.
    let proportional = [0, 1, 2].map(|i| 0.3 * [m, m, j][i] + 2e-3 * k[i]);
    let damping = format!(", damping = {}", diagonal(proportional));
    let input = sound(&(one_floor(&matrices(&damping), port, "") + MOTION));
    let jostle::Damping::Rayleigh { alpha, beta } = input.model.buildings[0].damping else {
        panic!("{:?}", input.model.buildings[0].damping);
    };
    near(alpha, 0.3, 1e-9, "α");
    near(beta, 2e-3, 1e-9, "β");
}

/// Mass at one side of a floor, by its matrix about the middle: M_yθ = m (c_x − a_x), M_xθ = −m (c_y − a_y).
#[test]
fn the_centre_of_mass_follows_from_the_mass_matrix() {
    let (m, j, x, y) = (40e3, 3e5, 1.2, -0.7);
    let turning = j + m * (x * x + y * y);
    let mass = [[m, 0.0, -m * y], [0.0, m, m * x], [-m * y, m * x, turning]];
    let matrices = format!("stiffness = [[3e7, 0, 0], [0, 3e7, 0], [0, 0, 5e8]], mass = {mass:?}");
    let tiers = tiers(&(one_floor(&matrices, "dofs = [1, 2, 3], height = 3", "") + MOTION));
    let floor = &tiers.floors[0];
    near(floor.centre[0], 4.0 + x, 1e-14, "x");
    near(floor.centre[1], 3.0 + y, 1e-14, "y");
    near(floor.polar_mass, j, 1e-12, "polar mass");
    // The spring at the middle pulls at an arm.
    let rows = tiers.matrices.expect("given").stiffness;
    let expected = [3e7 * y, -3e7 * x, 5e8 + 3e7 * (x * x + y * y)];
    for (found, expected) in rows[2].iter().zip(expected) {
        close(*found, expected, largest(&rows[2]), 1e-14, "torsion");
    }
}

#[test]
fn what_is_wrong_names_the_key_and_the_remedy() {
    let stiffness = "stiffness = [[3e7, 0, 0], [0, 3e7, 0], [0, 0, 5e8]]";
    let port = "dofs = [1, 2, 3], height = \"3 m\"";
    let mass = "mass = [4e4, 4e4, 4e5]";
    let of_port = |port: &str, more: &str| one_floor(&format!("{stiffness}, {mass}"), port, more);
    let of_mass = |mass: &str| one_floor(&format!("{stiffness}, mass = {mass}"), port, "");
    let four = "stiffness = [[3e7, 0, 0, -1e7], [0, 3e7, 0, 0], [0, 0, 5e8, 0], [-1e7, 0, 0, 2e7]]";
    let two = "[[building]]\nkind = \"given\"\nplan = [\"8 m\", \"6 m\"]\nports = { \"1\" = { dofs = [1, 2, 3], height = 3 }, \"2\" = { dofs = [4, 5, 6], height = 6 } }\n";
    let identity = |off: &str| {
        let rows: Vec<String> = (0..6)
            .map(|i| {
                let row = (0..6).map(|j| match (i, j) {
                    (0, 3) | (3, 0) => off.to_owned(),
                    _ if i == j => "4e5".to_owned(),
                    _ => "0".to_owned(),
                });
                format!("[{}]", row.collect::<Vec<_>>().join(", "))
            })
            .collect();
        format!("[{}]", rows.join(", "))
    };
    let coupled = format!(
        "{two}matrices = {{ stiffness = {}, mass = {} }}\n",
        identity("0"),
        identity("10.0")
    );
    let overlapping = two.replace("[4, 5, 6]", "[3, 4, 5]")
        + &format!(
            "matrices = {{ stiffness = {}, mass = {} }}\n",
            identity("0"),
            identity("0")
        );
    let plane = of_port(port, "").replace("plan = [\"8 m\", \"6 m\"]\n", "");
    let cases: [(String, &[&str]); 21] = [
        (
            of_port("dofs = [1, 2], height = 3", ""),
            &[
                "ports.1.dofs",
                "three numbers, found 2 numbers",
                "add dofs = [1, 2, 3]",
            ],
        ),
        (
            of_port("dofs = [1, 2, 2], height = 3", ""),
            &[
                "ports.1.dofs",
                "names a displacement twice",
                "three different rows",
            ],
        ),
        (
            of_port("dofs = [0, 1, 2], height = 3", ""),
            &["displacements count from 1"],
        ),
        (
            of_port("dofs = [1, 2, 7], height = 3", ""),
            &["matrices", "have 3 rows, and floor 1 has displacement 7"],
        ),
        (
            of_port("dof = 1, height = 3", ""),
            &["ports.1.dof", "without a plan", "add dofs"],
        ),
        (of_port("height = 3", ""), &["ports.1.dofs", "add dofs"]),
        (plane, &["ports.1.dofs", "needs a plan", "add plan"]),
        (
            overlapping,
            &[
                "displacement 3 both as rotation of floor 1 and as x of floor 2",
                "every displacement once",
            ],
        ),
        (
            coupled,
            &[
                "matrices",
                "row 4, column 1 of M",
                "x of floor 2 and x of floor 1",
                "lump masses",
            ],
        ),
        (
            of_mass("[4e4, 4e4, 0]"),
            &["matrices", "no mass at displacement 3, rotation of floor 1"],
        ),
        (
            of_mass("[4e4, 3e4, 4e5]"),
            &[
                "4e4 in row 1, column 1",
                "3e4 in row 2, column 2",
                "floor 1 along x and across",
            ],
        ),
        (
            of_mass("[[4e4, 100, 0], [100, 4e4, 0], [0, 0, 4e5]]"),
            &["row 2, column 1 of M", "couples x and y of floor 1"],
        ),
        (
            of_mass("[[4e4, 0, 0], [0, 4e4, 2e5], [0, 2e5, 4e5]]"),
            &["polar mass of floor 1", "at 5.000 m", "units of rotations"],
        ),
        (
            one_floor(&format!("{four}, mass = [4e4, 4e4, 4e5, 100]"), port, ""),
            &["mass in row 4, column 4", "none of a floor", "condense"],
        ),
        (
            one_floor(
                &format!(
                    "{four}, mass = [4e4, 4e4, 4e5, 0], damping = [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 5.0]]"
                ),
                port,
                "",
            ),
            &["row 4, column 4 of C", "no port names"],
        ),
        (
            one_floor(
                "stiffness = [[3e7, 0, 0, 0], [0, 3e7, 0, 0], [0, 0, 5e8, 0], [0, 0, 0, 0]], mass = [4e4, 4e4, 4e5, 0]",
                port,
                "",
            ),
            &["displacement 4", "no port names", "without resistance"],
        ),
        (
            one_floor(
                &format!("stiffness = [[3e7, 0, 0], [0, 0, 0], [0, 0, 5e8]], {mass}"),
                port,
                "",
            ),
            &["positive definite", "y of floor 1"],
        ),
        (
            one_floor(
                &format!("{stiffness}, {mass}, influence = [1, 0, 0]"),
                port,
                "",
            ),
            &["have r", "leave it out"],
        ),
        (
            of_port(port, "p_delta = true\n"),
            &["p_delta", "P-Delta part of its stiffness matrix"],
        ),
        (
            of_port(port, "periods = [1.0]\n"),
            &["periods", "cannot be combined with plan"],
        ),
        (of_port(port, "base = \"fixed\"\n"), &["base"]),
    ];
    for (text, parts) in cases {
        let error = refusal(&(text + MOTION));
        for part in parts {
            assert!(error.contains(part), "{part} is not in\n{error}");
        }
    }
}
