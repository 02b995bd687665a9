//! Statics, free vibration and single steps of Newmark's method against formulae.

use std::f64::consts::PI;

use jostle::structure::{Discretization, Member, Node, Spring, StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{Damping, GroundMotion, Plan, State, System, Wave};
use serde_json::Value;

use crate::data::{document, entries, number, numbers};
use crate::frames;
use crate::row::Row;
use crate::structures::{oscillator, run, static_answer, still, uniform};

const SOURCE: &str = "theory/oracle_basic";

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let basic = document(include_str!("../data/theory/oracle_basic.json"));
    let mut rows = cantilever(&basic);
    rows.extend(portal(&basic));
    for (key, beta) in [("sdof_newmark_avg", 0.25), ("sdof_newmark_lin", 1.0 / 6.0)] {
        rows.extend(newmark(&basic, key, beta));
    }
    rows.push(free_decay(&basic));
    rows.extend(rayleigh(&basic));
    rows.extend(equal_storeys(7));
    rows
}

fn node(x: f64, y: f64, support: Support) -> Node {
    let mass = if support == Support::Fixed { 0.0 } else { 1.0 };
    Node::at(x, y).with_mass(mass).held(support)
}

fn member(from: usize, to: usize, flexural_rigidity: f64) -> Member {
    Member {
        ends: [from, to],
        flexural_rigidity,
        axial_rigidity: None,
        shear_rigidity: None,
        compression: 0.0,
    }
}

fn building(
    name: &str,
    nodes: Vec<Node>,
    members: Vec<Member>,
    springs: Vec<Spring>,
    floors: Vec<usize>,
) -> BuildingSystem {
    let stick_model = StickModel {
        nodes,
        members,
        springs,
        hinges: Vec::new(),
        ..StickModel::default()
    };
    let discretization = Discretization {
        stick_model,
        left_face: floors.clone(),
        right_face: floors.clone(),
        floors,
        ..Discretization::default()
    };
    BuildingSystem::new(name, discretization)
}

fn cantilever(basic: &Value) -> Vec<Row> {
    let value = |key: &str| number(basic, &format!("/cantilever/{key}"));
    let nodes = vec![
        node(0.0, 0.0, Support::Fixed),
        node(0.0, value("L"), Support::Free),
    ];
    let mast = building(
        "mast",
        nodes,
        vec![member(0, 1, value("EI"))],
        Vec::new(),
        vec![1],
    );
    let (x, theta) = (
        mast.equations.horizontal(1).expect("the tip moves"),
        mast.equations.rotation(1).expect("the tip turns"),
    );
    let mut load = vec![0.0; mast.equations.len()];
    load[x] = value("F");
    let answer = static_answer(&mast, load);
    vec![
        Row::relative(
            SOURCE,
            "cantilever, x of the tip [m]",
            value("tip_x"),
            answer[x],
            1e-12,
        ),
        Row::relative(
            SOURCE,
            "cantilever, θ of the tip [rad]",
            value("tip_theta"),
            answer[theta],
            1e-12,
        ),
        Row::relative(
            SOURCE,
            "cantilever, base shear [N]",
            -number(basic, "/cantilever/state_at_base/qx"),
            mast.equations.base_shear(&answer),
            1e-12,
        ),
    ]
}

fn portal(basic: &Value) -> Vec<Row> {
    let value = |key: &str| number(basic, &format!("/portal_fixed_base_axially_rigid/{key}"));
    let (h, l) = (value("h"), value("L"));
    let half = 0.5 * value("mass");
    let nodes = vec![
        node(0.0, 0.0, Support::Fixed),
        node(l, 0.0, Support::Fixed),
        Node::at(0.0, h).with_mass(half),
        Node::at(l, h).with_mass(half),
    ];
    let members = vec![
        member(0, 2, value("EIc")),
        member(1, 3, value("EIc")),
        member(2, 3, value("EIb")),
    ];
    let portal = building("portal", nodes, members, Vec::new(), vec![2]);
    let x = portal.equations.horizontal(2).expect("the beam moves");
    let mut load = vec![0.0; portal.equations.len()];
    load[x] = 1.0;
    let stiffness = 1.0 / static_answer(&portal, load)[x];
    let frequency = portal.modes[0].circular_frequency;
    vec![
        Row::relative(
            SOURCE,
            "portal, lateral stiffness [N/m]",
            value("lateral_stiffness"),
            stiffness,
            1e-12,
        ),
        Row::relative(
            SOURCE,
            "portal, ω₁ [rad/s]",
            value("omega"),
            frequency,
            1e-12,
        ),
    ]
}

fn newmark(basic: &Value, key: &str, beta: f64) -> Vec<Row> {
    let value = |name: &str| number(basic, &format!("/{key}/{name}"));
    let (mass, omega, step) = (value("m"), value("omega"), value("dt"));
    let system = System::of_buildings(vec![oscillator(
        "oscillator",
        mass,
        mass * omega * omega,
        value("zeta"),
    )]);
    let plan = Plan {
        integrator: jostle::Integrator::newmark(beta, 0.5),
        ..uniform(step)
    };
    let rows = entries(basic, &format!("/{key}/after")).map(|(steps, expected)| {
        let count: f64 = steps.parse().expect("a number of steps");
        // a_g = 2 sin 5t
        let motion = GroundMotion {
            name: "sine".to_owned(),
            scale: 1.0,
            duration: count * step,
            wave: Wave::Sine {
                amplitude: 2.0,
                period: 2.0 * PI / 5.0,
            },
            bearing: None,
            grounds: None,
        };
        let state = run(&system, &motion, &plan, None).state;
        let got = [
            state.displacement[0],
            state.velocity[0],
            state.acceleration[0],
        ];
        let names = ["u [m]", "v [m/s]", "a [m/s²]"];
        let expected = numbers(expected, "");
        let method = if beta == 0.25 {
            "(¼, ½)"
        } else {
            "(⅙, ½)"
        };
        (0..3)
            .map(|k| {
                let quantity = format!("oscillator, Newmark {method}, {steps} steps, {}", names[k]);
                Row::relative(SOURCE, quantity, expected[k], got[k], 1e-11)
            })
            .collect::<Vec<_>>()
    });
    rows.flatten().collect()
}

fn free_decay(basic: &Value) -> Row {
    let value = |name: &str| number(basic, &format!("/sdof_free/{name}"));
    let (omega, x0) = (value("omega"), value("x0"));
    let system = System::of_buildings(vec![oscillator(
        "oscillator",
        1.0,
        omega * omega,
        value("zeta"),
    )]);
    let state = State {
        displacement: vec![x0],
        acceleration: vec![-omega * omega * x0],
        ..State::at_rest(&system, 0.0)
    };
    let got = run(&system, &still(1.0), &uniform(1e-4), Some(state))
        .state
        .displacement[0];
    // The method's period is long by (ωh)²/12, here 3·10⁻⁸.
    Row::relative(
        SOURCE,
        "free decay, u(1 s) at h = 0.1 ms [m]",
        value("x_at_1s"),
        got,
        1e-7,
    )
}

fn rayleigh(basic: &Value) -> Vec<Row> {
    let value = |name: &str| number(basic, &format!("/rayleigh/{name}"));
    let mut frame = frames::stored("B_2bay5");
    let damping = Damping::ratio(value("z1"), [1, 2]);
    frame
        .damp(&damping)
        .expect("the frame has two lateral modes");
    vec![
        Row::relative(
            SOURCE,
            "frame B, 5 % in lateral modes 1 and 2, α [1/s]",
            value("alphaM"),
            frame.equations.alpha,
            1e-10,
        ),
        Row::relative(
            SOURCE,
            "frame B, 5 % in lateral modes 1 and 2, β [s]",
            value("betaK"),
            frame.equations.beta,
            1e-10,
        ),
    ]
}

/// ω_j = 2 √(k/m) sin[(2j − 1)π/(4n + 2)].
fn equal_storeys(storeys: usize) -> Vec<Row> {
    let (mass, stiffness): (f64, f64) = (4e4, 6e7);
    let mut nodes = vec![node(0.0, 0.0, Support::Fixed)];
    let mut springs = Vec::new();
    for floor in 1..=storeys {
        let at = Node::at(0.0, 3.0 * floor as f64);
        nodes.push(at.with_mass(mass).held(Support::Guided));
        springs.push(Spring::elastic([floor - 1, floor], stiffness));
    }
    let tower = building("tower", nodes, Vec::new(), springs, (1..=storeys).collect());
    let formula = |j: usize| {
        2.0 * (stiffness / mass).sqrt() * ((2 * j - 1) as f64 * PI / (4 * storeys + 2) as f64).sin()
    };
    let modes = jostle::eigen::modes(&tower, storeys).expect("the tower stands");
    (1..=storeys)
        .map(|j| {
            let quantity = format!("{storeys} equal storeys, ω of mode {j} [rad/s]");
            Row::relative(
                "2√(k/m) sin[(2j−1)π/(4n+2)]",
                quantity,
                formula(j),
                modes[j - 1].circular_frequency,
                1e-12,
            )
        })
        .collect()
}
