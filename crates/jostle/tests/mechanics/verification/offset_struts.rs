//! Struts that meet columns off the joints: a frame with nodes there, assembled by other code.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::linear::StepMatrix;
use jostle::structure::solve_once;
use jostle::{
    Building, Column, Damping, Diagonal, DiagonalKind, DiagonalPlace, Frame, MemberRequest, Model,
    PanelDamage, Reach, RiccatiSweep, Rise, Section, StrutLine, Summary,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;

use crate::verification::support::{assembled, column, framed, largest, run, steps};

const HEIGHT: f64 = 3.0;
const SPAN: f64 = 5.0;
const OFFSET: f64 = 0.45;
/// E I of columns and of the beam \[N·m²\].
const COLUMN: f64 = 40e6;
const BEAM: f64 = 60e6;
const STIFFNESS: f64 = 9e7;
const YIELD: f64 = 90e3;
const HARDENING: f64 = 0.05;
const MASS: f64 = 60e3;

fn strut(rise: Rise, offsets: [f64; 2], strut: StrutLine) -> Diagonal {
    Diagonal {
        place: DiagonalPlace {
            kind: DiagonalKind::Infill,
            line: None,
            storey: 1,
            bay: 1,
            rise,
            reach: Reach::BAY,
            strut,
        },
        stiffness: STIFFNESS,
        hysteresis: None,
        offsets,
        across: None,
        damage: None,
    }
}

/// One bay whose members keep their length and have no mass.
fn portal(diagonals: Vec<Diagonal>) -> Frame {
    let section = |rigidity: f64| Section {
        flexural_rigidity: rigidity,
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass: 0.0,
    };
    Frame {
        storey_heights: vec![HEIGHT],
        spans: vec![SPAN],
        columns: vec![section(COLUMN)],
        beams: vec![section(BEAM)],
        beam_mass: vec![0.0],
        floor_mass: vec![MASS],
        column_segments: 1,
        beam_segments: vec![1],
        diagonals,
        ..Frame::default()
    }
}

fn model(frame: Frame) -> Model {
    let mut model = Model {
        title: "offset".to_owned(),
        buildings: vec![Building {
            damping: Damping::Rayleigh {
                alpha: 0.3,
                beta: 0.0,
            },
            ..framed("A", frame)
        }],
        ..Model::default()
    };
    model.analysis.members = MemberRequest::all();
    model
}

/// The portal with a node on each column, by slope and deflection: displacements are u of the floor, θ of both joints, then u and θ of the
/// node on the left and on the right column, which stand `at` above the ground.
struct Portal {
    at: [f64; 2],
}

/// Displacements of the portal.
const DOFS: usize = 7;

impl Portal {
    /// Stiffness without struts.
    fn stiffness(&self) -> Vec<Vec<f64>> {
        let mut all = vec![vec![0.0; DOFS]; DOFS];
        for side in 0..2 {
            let (joint, node) = (1 + side, [3 + 2 * side, 4 + 2 * side]);
            let below = [None, None, Some(node[0]), Some(node[1])];
            let above = [Some(node[0]), Some(node[1]), Some(0), Some(joint)];
            for (length, dofs) in [(self.at[side], below), (HEIGHT - self.at[side], above)] {
                let part = bending(COLUMN, length);
                for (i, row) in dofs.iter().enumerate() {
                    for (j, across) in dofs.iter().enumerate() {
                        if let (Some(i_of), Some(j_of)) = (row, across) {
                            all[*i_of][*j_of] += part[i][j];
                        }
                    }
                }
            }
        }
        for i in 0..2 {
            for j in 0..2 {
                all[1 + i][1 + j] += BEAM / SPAN * if i == j { 4.0 } else { 2.0 };
            }
        }
        all
    }

    /// Elongation of the strut that rises to the right from the left node to the right one; columns keep their length.
    fn elongation(&self) -> Vec<f64> {
        let length = SPAN.hypot(self.at[1] - self.at[0]);
        let mut row = vec![0.0; DOFS];
        (row[3], row[5]) = (-SPAN / length, SPAN / length);
        row
    }
}

/// Upright beam over u and θ (counter-clockwise) of its lower and its upper end: u grows to the right, so that θ = −du/dy.
fn bending(rigidity: f64, length: f64) -> [[f64; 4]; 4] {
    let (k, l) = (rigidity / length.powi(3), length);
    [
        [12.0 * k, -6.0 * k * l, -12.0 * k, -6.0 * k * l],
        [-6.0 * k * l, 4.0 * k * l * l, 6.0 * k * l, 2.0 * k * l * l],
        [-12.0 * k, 6.0 * k * l, 12.0 * k, 6.0 * k * l],
        [-6.0 * k * l, 2.0 * k * l * l, 6.0 * k * l, 4.0 * k * l * l],
    ]
}

/// Gauss elimination with row exchange.
fn solve(matrix: &[Vec<f64>], load: &[f64]) -> Vec<f64> {
    let n = load.len();
    let mut rows: Vec<Vec<f64>> = matrix.to_vec();
    for (row, value) in rows.iter_mut().zip(load) {
        row.push(*value);
    }
    for pivot in 0..n {
        let best =
            (pivot..n).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()));
        rows.swap(pivot, best.unwrap_or(pivot));
        let pivot_row = rows[pivot].clone();
        for row in rows.iter_mut().skip(pivot + 1) {
            let share = row[pivot] / pivot_row[pivot];
            for (value, above) in row.iter_mut().zip(&pivot_row) {
                *value -= share * above;
            }
        }
    }
    let mut found = vec![0.0; n];
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|j| rows[row][j] * found[j]).sum();
        found[row] = (rows[row][n] - known) / rows[row][row];
    }
    found
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

const STRUT: [f64; 2] = [OFFSET, HEIGHT - OFFSET];

/// Displacement of the floor under a unit force there.
#[test]
fn flexibility_is_that_of_a_frame_with_nodes_on_the_columns() {
    let flexibility = |diagonals: Vec<Diagonal>| {
        let system = assembled(&model(portal(diagonals)));
        let building = &system.buildings[0];
        let mut load = vec![0.0; building.equations.len()];
        load[building.floors[0].dof] = 1.0;
        let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load);
        moved.expect("it stands")[building.floors[0].dof]
    };
    let by_hand = |struts: &[[f64; 2]]| {
        // Nodes at the offset on both columns; those of other struts have no part.
        let frame = Portal { at: STRUT };
        let mut matrix = frame.stiffness();
        for at in struts {
            let portal = Portal { at: *at };
            let mut row = portal.elongation();
            let length = SPAN.hypot(at[1] - at[0]);
            // At a joint it pulls the floor, and at a foot nothing.
            if at[0] == 0.0 {
                row[3] = 0.0;
            }
            if at[1] == HEIGHT {
                (row[0], row[5]) = (SPAN / length, 0.0);
            }
            for i in 0..DOFS {
                for j in 0..DOFS {
                    matrix[i][j] += STIFFNESS * row[i] * row[j];
                }
            }
        }
        let mut load = vec![0.0; DOFS];
        load[0] = 1.0;
        solve(&matrix, &load)[0]
    };
    let off = [OFFSET; 2];
    let one = |rise| vec![strut(rise, off, StrutLine::Central)];
    let due = by_hand(&[STRUT]);
    for rise in Rise::BOTH {
        let found = flexibility(one(rise));
        assert!((found / due - 1.0).abs() < 1e-9, "{found:e} {due:e}");
    }
    let three = vec![
        strut(Rise::Right, [0.0; 2], StrutLine::Central),
        strut(Rise::Right, [OFFSET, 0.0], StrutLine::Foot),
        strut(Rise::Right, [0.0, OFFSET], StrutLine::Head),
    ];
    let due_of_three = by_hand(&[[0.0, HEIGHT], [OFFSET, HEIGHT], [0.0, HEIGHT - OFFSET]]);
    let found = flexibility(three);
    assert!(
        (found / due_of_three - 1.0).abs() < 1e-9,
        "{found:e} {due_of_three:e}"
    );
    // Columns bend between the strut and the joints: it is softer than from joint to joint.
    let between_joints = flexibility(vec![strut(Rise::Right, [0.0; 2], StrutLine::Central)]);
    assert!(due > 1.2 * between_joints, "{due:e} {between_joints:e}");
}

/// Shaken until the strut yields: one mass on a spring and a bilinear strut behind the flexibility of the columns, in steps of a thousandth
/// of those of the run. The foot of the left column bears the shear of its short end.
#[test]
fn yielding_struts_follow_an_integration_of_their_own() {
    let corners = Corners::bilinear(YIELD, HARDENING);
    let backbone = Backbone::from_forces(STIFFNESS, corners, corners).expect("sound");
    let law = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("it fits");
    let diagonal = Diagonal {
        hysteresis: Some(law),
        damage: Some(PanelDamage {
            drifts: PanelDamage::SASSUN,
            drift_per_shortening: SPAN.hypot(HEIGHT) / (SPAN * HEIGHT),
        }),
        ..strut(Rise::Right, [OFFSET; 2], StrutLine::Central)
    };
    let model = model(portal(vec![diagonal]));
    let motion = fading("along", 11.0, [1.6, 3.0], 300);
    let system = assembled(&model);
    let plan = steps(5e-4, 1);
    let outcome = run(&system, &motion, &plan);
    let moved = column(&outcome, Column::displacement(0, 1));
    let times = column(&outcome, Column::TIME);

    // By the portal: floor held at u = 1, and a unit tension of the strut with the floor held.
    let frame = Portal { at: STRUT };
    let (matrix, row) = (frame.stiffness(), frame.elongation());
    let inner: Vec<Vec<f64>> = matrix[1..].iter().map(|row| row[1..].to_vec()).collect();
    let pull: Vec<f64> = matrix[1..].iter().map(|row| -row[0]).collect();
    let of_floor = solve(&inner, &pull);
    let tension: Vec<f64> = row[1..].iter().map(|share| -share).collect();
    let of_tension = solve(&inner, &tension);
    let stiffness = matrix[0][0] + dot(&matrix[0][1..], &of_floor);
    let lever = dot(&row[1..], &of_floor);
    let softness = -dot(&row[1..], &of_tension);
    // Bilinear behind an elastic part is bilinear again.
    let first = STIFFNESS / (1.0 + STIFFNESS * softness);
    let second = HARDENING * STIFFNESS / (1.0 + HARDENING * STIFFNESS * softness);
    let (mut u, mut v, mut plastic) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut worst, mut yielded, mut foot) = (0.0_f64, false, [0.0_f64; 2]);
    // Force of the bilinear law from its plastic part, with kinematic hardening.
    let hard = first * second / (first - second);
    let scale = largest(&moved);
    let fine = 200;
    for (row, end) in times.iter().enumerate().skip(1) {
        let step = (end - times[row - 1]) / f64::from(fine);
        for part in 0..fine {
            let at = times[row - 1] + (f64::from(part) + 0.5) * step;
            let mut force_of = |u: f64, plastic: &mut f64| {
                let e = lever * u;
                let trial = first * (e - *plastic) - hard * *plastic;
                if trial.abs() > YIELD {
                    yielded = true;
                    *plastic += (trial.abs() - YIELD) / (first + hard) * trial.signum();
                }
                first * (e - *plastic)
            };
            // Velocity Verlet, which is exact to the second order.
            let ground = motion.acceleration(at);
            let half = u + 0.5 * step * v;
            let force = force_of(half, &mut plastic);
            let a = -ground - 0.3 * v - (stiffness * half + lever * force) / MASS;
            v += step * a;
            u = half + 0.5 * step * v;
        }
        worst = worst.max((u - moved[row]).abs());
        let mut kept = plastic;
        let e = lever * u;
        let trial = first * (e - kept) - hard * kept;
        if trial.abs() > YIELD {
            kept += (trial.abs() - YIELD) / (first + hard) * trial.signum();
        }
        let force = first * (e - kept);
        let node = [2, 3].map(|dof| of_floor[dof] * u + of_tension[dof] * force);
        let part = bending(COLUMN, OFFSET);
        // What the foot bears: the horizontal force of the lower end of the column.
        let shear = -(part[0][2] * node[0] + part[0][3] * node[1]);
        foot = [foot[0].max(shear), foot[1].min(shear)];
    }
    assert!(yielded && worst < 2e-3 * scale, "{worst:e} of {scale:e}");
    let members = &system.buildings[0].members;
    let left = &members.members[0].sections[0];
    let [most, least] = outcome.members[0][left.forms[1]];
    let greatest = foot[0].max(-foot[1]);
    close(most, foot[0], greatest, 4e-3, "shear at the foot");
    close(least, foot[1], greatest, 4e-3, "shear at the foot");
    // The drift of the bay is that of the storey, whatever the strut does.
    let summary = Summary::new(&jostle::Run {
        model: &model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: 0.0,
    });
    let part = &summary.buildings[0].parts[0];
    let left = moved
        .iter()
        .fold(0.0, |most, column| f64::max(most, -column))
        / HEIGHT;
    let drift = part.drift.expect("judged");
    close(drift, left, left, 1e-4, "drift");
    let state = PanelDamage::SASSUN
        .iter()
        .filter(|candidate| drift >= **candidate);
    assert_eq!(part.damage_state, Some(state.count()));
    assert!(part.damage_state > Some(0), "{drift}");
}
