//! Frames on isolated mats in plan: the plane as their limit, and full matrices assembled here, with the motions of the mat among the
//! unknowns.

use std::f64::consts::PI;

use jostle::history::Owner;
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::linear::StepMatrix;
use jostle::structure::{MemberPlace, SectionAt, solve_once};
use jostle::system::BuildingSystem;
use jostle::{
    Analysis, Base, Bearing, Building, Column, Damping, Frame, FrameHinges, GroundMotion, Hinges,
    Isolation, Isolator, IsolatorDamping, MemberRequest, Model, Outcome, PlanFrame, PlanPoint,
    RiccatiSweep, Section, Solver, SpaceFrame, SpaceMember, SpacePlace, SpaceSection,
    SpeedFriction, Structure, System, Tier, Tiers,
};

use jostle::pushover::{CannotPush, PushSettings, pushover};
use jostle_testkit::models::rectangle;
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{self, assembled};

use super::plan_frames::{frame, massless, standing};
use crate::verification::support::{column, difference, largest, spring_forces};

fn shaking(name: &str, rate: f64, scale: f64) -> GroundMotion {
    fading(name, rate, [scale, 2.5], 200)
}

fn in_two_directions() -> GroundMotion {
    let mut motion = shaking("first", 4.0, 1.0);
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.4,
        across: Some(shaking("across", 5.3, 0.8)),
    }));
    motion
}

fn held_by(floors: Vec<Tier>, heights: Vec<f64>, frames: Vec<PlanFrame>) -> Tiers {
    Tiers {
        floors,
        storey_heights: heights,
        frames,
        ..Tiers::default()
    }
}

fn model(
    structure: Structure,
    hinges: Option<Hinges>,
    damping: Damping,
    isolation: Isolation,
    solver: Solver,
    step: f64,
) -> Model {
    Model {
        title: "frames on a mat".to_owned(),
        buildings: vec![Building {
            name: "block".to_owned(),
            structure,
            damping,
            base: Base {
                isolation: Some(isolation),
                ..Base::default()
            },
            hinges,
            ..Building::default()
        }],
        analysis: Analysis {
            step: Some(step),
            solver: Some(solver),
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn run(model: &Model, motion: &GroundMotion) -> (System, Outcome) {
    let (system, outcome) = runs::run(model, motion, Some(0.0));
    let worst = outcome.energy.worst_imbalance;
    assert!(worst < 1e-8, "{worst:e}");
    (system, outcome)
}

fn along(outcome: &Outcome, floors: usize) -> Vec<f64> {
    let of = |floor| column(outcome, Column::displacement(0, floor));
    (0..=floors).flat_map(of).collect()
}

/// Peaks of all forces at the ends of columns and beams of a frame; axial forces of columns follow from shears of beams.
fn member_peaks(system: &System, outcome: &Outcome, frame: Option<usize>) -> Vec<f64> {
    let members = system.buildings[0].members.members.iter();
    let members = members.filter(|member| member.frame == frame);
    let forms = members.flat_map(|member| {
        let skip = usize::from(matches!(member.place, MemberPlace::Beam { .. }));
        let ends = member.sections.iter();
        let ends = ends.filter(|section| matches!(section.at, SectionAt::First | SectionAt::Last));
        ends.flat_map(move |section| section.forms[skip..].to_vec())
    });
    let peaks = forms.map(|form| outcome.members[0][form]);
    peaks.map(|[most, least]| most.max(-least)).collect()
}

/// Linear, lead-rubber and pendulum; strength and stiffness in units of `share`.
fn bearings(mat_mass: f64, share: f64) -> [Isolation; 3] {
    let mut linear = Isolation::new(
        Isolator::Linear {
            stiffness: share * 8e6,
        },
        mat_mass,
    );
    linear.damping = IsolatorDamping::Ratio(0.12);
    let lead = Isolator::LeadRubber {
        stiffness: share * 6e7,
        yield_force: share * 2.4e5,
        post_yield: 0.1,
    };
    let pendulum = Isolator::Pendulum {
        radius: 1.5,
        friction: SpeedFriction::constant(0.05),
        slip_displacement: 1e-3,
    };
    [
        linear,
        Isolation::new(lead, mat_mass),
        Isolation::new(pendulum, mat_mass),
    ]
}

fn yielding(stiffness: f64, moment: f64) -> Hysteresis {
    let corners = Corners {
        cracking: 0.3 * moment,
        yielding: moment,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    let backbone = Backbone::from_forces(stiffness, corners, corners).expect("sound");
    Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("sound")
}

fn frame_hinges(frame: &Frame) -> FrameHinges {
    let (storeys, bays) = (frame.storey_heights.len(), frame.spans.len());
    let column = 100.0 * frame.columns[0].flexural_rigidity / 3.2;
    let beam = 100.0 * frame.beams[0].flexural_rigidity / 6.0;
    FrameHinges {
        columns: vec![vec![yielding(column, 120e3); bays + 1]; storeys],
        beams: vec![vec![yielding(beam, 100e3); bays]; storeys],
        ..FrameHinges::default()
    }
}

/// Two frames along x and two across, all equal, shaken along x: half of it is a plane isolated frame. Masses between floors, damping of
/// both kinds, elastic and with hinges.
#[test]
fn four_equal_frames_on_a_mat_are_twice_an_isolated_plane_frame() {
    let (storeys, spans, slab, mat) = (3, [6.0, 6.0], 80e3, 120e3);
    let one = frame(storeys, &spans);
    let lines = spans.len() as f64 + 1.0;
    let column_mass = |storey: usize| {
        let column = one.columns.get(storey);
        column.map_or(0.0, |column| lines * 0.5 * column.line_mass * 3.2)
    };
    let mut plane = one.clone();
    for floor in 0..storeys {
        // Half of the slab, and one frame across, whose columns move with the floors.
        let across = column_mass(floor) + column_mass(floor + 1) + 12.0 * one.beam_mass[floor];
        plane.floor_mass[floor] = 0.5 * slab + across;
    }
    let plane_mat = 0.5 * mat + column_mass(0);
    let damping = Damping::ratio(0.05, [1, 2]);
    let motion = shaking("line", 4.0, 1.0);
    for yields in [false, true] {
        let hinges = if yields {
            frame_hinges(&one)
        } else {
            FrameHinges::default()
        };
        let frames = [
            ("1", [0.0, 0.0], 0.0),
            ("2", [0.0, 12.0], 0.0),
            ("A", [0.0, 0.0], 0.5 * PI),
            ("B", [12.0, 0.0], 0.5 * PI),
        ];
        let frames = frames.map(|(name, at, angle)| PlanFrame {
            hinges: hinges.clone(),
            ..standing(name, at, angle, one.clone())
        });
        let tier = Tier::uniform(slab, rectangle(0.0, 0.0, 12.0, 12.0)).expect("an area");
        let tiers = held_by(vec![tier; storeys], vec![3.2; storeys], frames.to_vec());
        let plane_hinges = yields.then_some(Hinges::Frame(hinges));
        let pairs = bearings(mat, 2.0).into_iter().zip(bearings(plane_mat, 1.0));
        for (isolation, of_plane) in pairs {
            let kind = isolation.isolator.name();
            let step = 4e-3;
            let flat = model(
                Structure::Frame(plane.clone()),
                plane_hinges.clone(),
                damping.clone(),
                of_plane,
                Solver::Riccati,
                step,
            );
            let (plane_system, flat) = run(&flat, &motion);
            for solver in [Solver::Riccati, Solver::Stiffness] {
                let model = model(
                    Structure::Tiers(tiers.clone()),
                    None,
                    damping.clone(),
                    isolation,
                    solver,
                    step,
                );
                let (system, deep) = run(&model, &motion);
                let [a, b] = [&system, &plane_system].map(|system| &system.buildings[0]);
                let mass = a.equations.total_mass() / b.equations.total_mass();
                assert!((mass - 2.0).abs() < 1e-12, "{mass}");
                for (a, b) in [
                    (a.equations.alpha, b.equations.alpha),
                    (a.equations.beta, b.equations.beta),
                ] {
                    assert!((a / b - 1.0).abs() < 1e-9, "{a} and {b}");
                }
                let expected = along(&flat, storeys);
                let apart = difference(&along(&deep, storeys), &expected);
                println!("{kind} {yields} {solver:?}: {apart:e}");
                assert!(apart < 1e-9, "{kind} {yields} {solver:?}: {apart:e}");
                let shear = deep.peaks.base_shear(0) / flat.peaks.base_shear(0);
                assert!((shear - 2.0).abs() < 1e-8, "{kind}: {shear}");
                let damped = deep.peaks.work(Owner::Support(0))
                    / flat.peaks.work(Owner::Support(0)).max(1e-300);
                let has_dashpot = flat.peaks.work(Owner::Support(0)) > 0.0;
                assert!(!has_dashpot || (damped - 2.0).abs() < 1e-8, "{damped}");
                for (a, b) in [
                    (deep.energy.damped, flat.energy.damped),
                    (deep.energy.input, flat.energy.input),
                ] {
                    assert!((a / b - 2.0).abs() < 1e-8, "{kind}: {a} and {b}");
                }
                for frame in [0, 1] {
                    let found = member_peaks(&system, &deep, Some(frame));
                    let expected = member_peaks(&plane_system, &flat, None);
                    assert_eq!(found.len(), expected.len());
                    let apart = difference(&found, &expected);
                    assert!(apart < 1e-8, "{kind} {yields}: members {apart:e}");
                }
                if yields {
                    let most = largest(&spring_forces(&flat));
                    assert!(most > 120e3, "{most}");
                }
            }
        }
    }
}

/// A matrix over all unknowns, every one with a place of its own.
struct Full {
    matrix: Vec<Vec<f64>>,
}

type Row = Vec<f64>;

impl Full {
    fn new(count: usize) -> Self {
        Self {
            matrix: vec![vec![0.0; count]; count],
        }
    }

    fn zero(&self) -> Row {
        vec![0.0; self.matrix.len()]
    }

    fn unit(&self, at: usize) -> Row {
        let mut row = self.zero();
        row[at] = 1.0;
        row
    }

    fn add(&mut self, value: f64, a: &Row, b: &Row) {
        for (i, of_a) in a.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            for (j, of_b) in b.iter().enumerate() {
                self.matrix[i][j] += value * of_a * of_b;
            }
        }
    }

    fn spring(&mut self, value: f64, row: &Row) {
        self.add(value, row, row);
    }

    /// A beam of length l between deflections and slopes at both ends, Timoshenko's if it has a GA_s.
    fn beam(&mut self, rigidity: f64, shear: Option<f64>, l: f64, rows: [&Row; 4]) {
        let phi = shear.map_or(0.0, |shear| 12.0 * rigidity / (shear * l * l));
        let unit = rigidity / ((1.0 + phi) * l * l * l);
        let matrix = [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, (4.0 + phi) * l * l, -6.0 * l, (2.0 - phi) * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, (2.0 - phi) * l * l, -6.0 * l, (4.0 + phi) * l * l],
        ];
        for (row, a) in matrix.iter().zip(rows) {
            for (value, b) in row.iter().zip(rows) {
                self.add(unit * value, a, b);
            }
        }
    }

    /// The inverse of its first rows and columns, all others free, by elimination of Gauss and Jordan.
    fn flexibility(&self, first: usize) -> Vec<Row> {
        let n = self.matrix.len();
        let mut rows: Vec<Row> = self.matrix.clone();
        let mut sides: Vec<Row> = (0..n)
            .map(|row| (0..first).map(|c| f64::from(u8::from(row == c))).collect())
            .collect();
        for pivot in 0..n {
            let best = (pivot..n)
                .max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()))
                .expect("rows");
            rows.swap(pivot, best);
            sides.swap(pivot, best);
            let scale = 1.0 / rows[pivot][pivot];
            for row in 0..n {
                if row == pivot {
                    continue;
                }
                let factor = rows[row][pivot] * scale;
                if factor == 0.0 {
                    continue;
                }
                for column in pivot..n {
                    rows[row][column] -= factor * rows[pivot][column];
                }
                for side in 0..first {
                    sides[row][side] -= factor * sides[pivot][side];
                }
            }
        }
        (0..first)
            .map(|row| sides[row].iter().map(|v| v / rows[row][row]).collect())
            .collect()
    }
}

/// Motion of a place of a floor whose three motions begin at `first`, along x and across.
fn at_place(full: &Full, first: usize, centre: PlanPoint, at: PlanPoint) -> [Row; 2] {
    let mut rows = [full.unit(first), full.unit(first + 1)];
    rows[0][first + 2] = -(at[1] - centre[1]);
    rows[1][first + 2] = at[0] - centre[0];
    rows
}

fn summed(terms: &[(f64, &Row)]) -> Row {
    let mut sum = vec![0.0; terms[0].1.len()];
    for (share, row) in terms {
        for (to, value) in sum.iter_mut().zip(*row) {
            *to += share * value;
        }
    }
    sum
}

const PLACES: [PlanPoint; 3] = [[0.5, 1.0], [10.0, 0.5], [4.0, 7.5]];

const STIFFNESS: f64 = 9e6;

/// Of stiffness-proportional damping \[s\].
const BETA: f64 = 2e-3;

/// On linear bearings at three places.
fn on_bearings(mut tiers: Tiers, beta: f64, solver: Solver, step: f64) -> Model {
    tiers.bearings = PLACES.to_vec();
    let mut isolation = Isolation::new(
        Isolator::Linear {
            stiffness: STIFFNESS,
        },
        1.1e5,
    );
    isolation.damping = IsolatorDamping::Coefficient(2.4e5);
    let damping = Damping::Rayleigh { alpha: 0.4, beta };
    model(
        Structure::Tiers(tiers),
        None,
        damping,
        isolation,
        solver,
        step,
    )
}

/// The centre of the mat and its polar mass, of the lowest floor by hand: all are rectangles.
fn rectangular_mat(a: f64, b: f64) -> (PlanPoint, [f64; 3]) {
    let mass = 1.1e5;
    (
        [0.5 * a, 0.5 * b],
        [mass, mass, mass * (a * a + b * b) / 12.0],
    )
}

fn add_bearings(full: &mut Full, centre: PlanPoint, value: f64) {
    for at in PLACES {
        for row in at_place(full, 0, centre, at) {
            full.spring(value / PLACES.len() as f64, &row);
        }
    }
}

/// Degrees of freedom of the mat, then of the floors.
fn moving(system: &BuildingSystem) -> Vec<usize> {
    let n = system.floors.len();
    let mat = system.mat_in_plan.as_ref().expect("isolated").dofs;
    let floors = (0..n).flat_map(|floor| [0, 1, 2].map(|c| system.tracks[c * n + floor].dof));
    mat.into_iter().chain(floors).collect()
}

/// Displacements under a unit force at every motion of the mat and of the floors, by both solvers.
#[track_caller]
fn same_flexibility(model: &Model, full: &Full) {
    let building = &assembled(model).buildings[0];
    let dofs = moving(building);
    let expected = full.flexibility(dofs.len());
    let scale = |i: usize, j: usize| (expected[i][i] * expected[j][j]).sqrt();
    for (j, dof) in dofs.iter().enumerate() {
        let mut load = vec![0.0; building.equations.len()];
        load[*dof] = 1.0;
        let found =
            solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("it stands");
        for (i, dof) in dofs.iter().enumerate() {
            let apart = (found[*dof] - expected[i][j]).abs() / scale(i, j);
            assert!(apart < 1e-9, "{i} by {j}: {apart:e}");
        }
    }
    // Periods: every shape fits, and Σ 1/ω² is the trace of the flexibility times the masses.
    let mass: Vec<f64> = dofs
        .iter()
        .map(|dof| building.equations.mass[*dof])
        .collect();
    for mode in &building.modes {
        let square = mode.circular_frequency.powi(2);
        let shape: Vec<f64> = dofs.iter().map(|dof| mode.shape[*dof]).collect();
        for (i, row) in expected.iter().enumerate() {
            let moved: f64 = (0..dofs.len()).map(|j| row[j] * mass[j] * shape[j]).sum();
            let scale = largest(&shape) / (mass[i] / mass[0]).sqrt().min(1.0);
            assert!((square * moved - shape[i]).abs() < 1e-8 * scale, "{square}");
        }
    }
    let trace: f64 = (0..dofs.len()).map(|i| expected[i][i] * mass[i]).sum();
    let squares = building
        .modes
        .iter()
        .map(|mode| mode.circular_frequency.powi(-2));
    let sum: f64 = squares.sum();
    assert!((sum / trace - 1.0).abs() < 1e-9, "{sum} and {trace}");
}

/// Two storeys held by three plane frames, one of them askew, and one of a single storey.
fn three_frames() -> Tiers {
    let floor = |mass: f64, centre: PlanPoint| Tier {
        centre,
        ..Tier::uniform(mass, rectangle(0.0, 0.0, 12.0, 8.0)).expect("an area")
    };
    let mut lower = frame(1, &[8.0]);
    lower.storey_heights = vec![4.0];
    let two = |spans: &[f64]| {
        let mut frame = frame(2, spans);
        frame.storey_heights = vec![4.0, 3.2];
        frame
    };
    let frames = vec![
        standing("1", [0.0, 0.5], 0.0, massless(two(&[6.0, 5.0]))),
        standing("A", [1.0, 0.0], 0.5 * PI, massless(two(&[7.0]))),
        standing("S", [3.0, 1.0], 0.6, massless(two(&[5.0, 4.0]))),
        standing("B", [11.0, 0.0], 0.5 * PI, massless(lower)),
    ];
    let floors = vec![floor(1.4e5, [6.4, 3.7]), floor(1.1e5, [5.5, 4.4])];
    held_by(floors, vec![4.0, 3.2], frames)
}

/// The stiffness of the three frames over the motions of the mat, of two floors, and rotations of all joints; columns and beams keep
/// their length.
fn matrix_of_three_frames(tiers: &Tiers, mat: PlanPoint) -> Full {
    let centres = [mat, tiers.floors[0].centre, tiers.floors[1].centre];
    let joints =
        |frame: &PlanFrame| (frame.frame.spans.len() + 1) * frame.frame.storey_heights.len();
    let count = 9 + tiers.frames.iter().map(joints).sum::<usize>();
    let mut full = Full::new(count);
    let mut next = 9;
    for frame in &tiers.frames {
        let lines = frame.frame.spans.len() + 1;
        let sway = |full: &Full, level: usize| {
            let [x, y] = at_place(full, 3 * level, centres[level], frame.at);
            summed(&[(frame.direction[0], &x), (frame.direction[1], &y)])
        };
        let mut below: Vec<Row> = vec![full.zero(); lines];
        for (storey, height) in frame.frame.storey_heights.iter().enumerate() {
            let turns: Vec<Row> = (0..lines).map(|line| full.unit(next + line)).collect();
            next += lines;
            let [low, high] = [storey, storey + 1].map(|level| sway(&full, level));
            for line in 0..lines {
                // Slopes over the height are rotations turned clockwise.
                let rigidity = frame.frame.columns[storey].flexural_rigidity;
                let [a, b] = [&below[line], &turns[line]].map(|turn| summed(&[(-1.0, turn)]));
                full.beam(rigidity, None, *height, [&low, &a, &high, &b]);
            }
            let still = full.zero();
            for (bay, span) in frame.frame.spans.iter().enumerate() {
                let rigidity = frame.frame.beams[storey].flexural_rigidity;
                let rows = [&still, &turns[bay], &still, &turns[bay + 1]];
                full.beam(rigidity, None, *span, rows);
            }
            below = turns;
        }
    }
    full
}

#[test]
fn plane_frames_on_a_mat_have_the_flexibility_and_periods_of_the_full_matrix() {
    let tiers = three_frames();
    let (mat, _) = rectangular_mat(12.0, 8.0);
    let mut full = matrix_of_three_frames(&tiers, mat);
    add_bearings(&mut full, mat, STIFFNESS);
    same_flexibility(&on_bearings(tiers, BETA, Solver::Riccati, 1e-3), &full);
}

/// Motion from matrices of its own, by the classical method of Runge and Kutta.
fn moved_by_rates(
    mass: &[f64],
    stiffness: &[Row],
    damping: &[Row],
    motion: &GroundMotion,
    step: f64,
) -> Row {
    let n = mass.len();
    let rates = |state: &Row, ground: [f64; 3]| -> Row {
        let (u, v) = state.split_at(n);
        let accelerations = (0..n).map(|i| {
            let force: f64 = (0..n)
                .map(|j| stiffness[i][j] * u[j] + damping[i][j] * v[j])
                .sum();
            let driven = ground.get(i % 3).copied().unwrap_or(0.0);
            -force / mass[i] - driven
        });
        v.iter().copied().chain(accelerations).collect()
    };
    let shifted = |state: &Row, rates: &Row, by: f64| summed(&[(1.0, state), (by, rates)]);
    let mut state = vec![0.0; 2 * n];
    let steps = (motion.duration / step).round() as usize;
    for count in 0..steps {
        let t = step * count as f64;
        let [before, middle, after] = [t, t + 0.5 * step, t + step].map(|t| motion.components(t));
        let a = rates(&state, before);
        let b = rates(&shifted(&state, &a, 0.5 * step), middle);
        let c = rates(&shifted(&state, &b, 0.5 * step), middle);
        let d = rates(&shifted(&state, &c, step), after);
        let (third, sixth) = (step / 3.0, step / 6.0);
        state = summed(&[
            (1.0, &state),
            (sixth, &a),
            (third, &b),
            (third, &c),
            (sixth, &d),
        ]);
    }
    state.truncate(n);
    state
}

fn inverse(matrix: &[Row]) -> Vec<Row> {
    let full = Full {
        matrix: matrix.to_vec(),
    };
    full.flexibility(matrix.len())
}

/// Tᵀ m T of a floor that moves relative to the mat, added to a matrix.
fn add_relative(to: &mut Full, floor: usize, masses: [f64; 3], centre: PlanPoint, mat: PlanPoint) {
    let place = at_place(to, 3 * floor, centre, centre);
    let below = at_place(to, 0, mat, centre);
    for axis in 0..2 {
        let row = summed(&[(1.0, &place[axis]), (-1.0, &below[axis])]);
        to.spring(masses[axis], &row);
    }
    let (above, below) = (to.unit(3 * floor + 2), to.unit(2));
    let row = summed(&[(1.0, &above), (-1.0, &below)]);
    to.spring(masses[2], &row);
}

/// `frames`: the stiffness of frames alone. The error of the steps is of second order.
#[track_caller]
fn same_motion(tiers: &Tiers, frames: &Full, beta: f64) {
    let (mat, mat_masses) = rectangular_mat(12.0, 8.0);
    let first = 3 * (tiers.floors.len() + 1);
    // Frames alone are held by bearings so weak that they add nothing: the condensed stiffness needs an inverse.
    let weak = 1.0;
    let mut held = Full {
        matrix: frames.matrix.clone(),
    };
    add_bearings(&mut held, mat, weak);
    let of_frames = inverse(&held.flexibility(first));
    let mut bearings = Full::new(first);
    add_bearings(&mut bearings, mat, STIFFNESS - weak);
    let mut dashpots = Full::new(first);
    add_bearings(&mut dashpots, mat, 2.4e5);
    let mut mass = mat_masses.to_vec();
    for (floor, tier) in tiers.floors.iter().enumerate() {
        let masses = [tier.mass, tier.mass, tier.polar_mass];
        mass.extend(masses);
        add_relative(
            &mut dashpots,
            floor + 1,
            masses.map(|mass| 0.4 * mass),
            tier.centre,
            mat,
        );
    }
    let plus = |a: &[Row], share: f64, b: &[Row]| -> Vec<Row> {
        let rows = a.iter().zip(b);
        rows.map(|(a, b)| summed(&[(1.0, a), (share, b)])).collect()
    };
    let stiffness = plus(&of_frames, 1.0, &bearings.matrix);
    let damping = plus(&dashpots.matrix, beta, &of_frames);
    let motion = in_two_directions();
    let exact = moved_by_rates(&mass, &stiffness, &damping, &motion, 2e-4);
    let error = |step: f64, solver: Solver| {
        let (system, outcome) = run(&on_bearings(tiers.clone(), beta, solver, step), &motion);
        let dofs = moving(&system.buildings[0]);
        let found: Row = dofs
            .iter()
            .map(|dof| outcome.state.displacement[*dof])
            .collect();
        difference(&found, &exact)
    };
    let errors = [4e-3, 2e-3, 1e-3].map(|step| error(step, Solver::Riccati));
    let by_stiffness = error(1e-3, Solver::Stiffness);
    assert!(errors[2] < 2e-5, "{errors:?}");
    assert!((by_stiffness / errors[2] - 1.0).abs() < 1e-3);
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.3, "{errors:?}");
    }
}

#[test]
fn plane_frames_on_a_mat_move_as_the_full_matrix() {
    let tiers = three_frames();
    let (mat, _) = rectangular_mat(12.0, 8.0);
    same_motion(&tiers, &matrix_of_three_frames(&tiers, mat), BETA);
}

const LINES: [&[f64]; 2] = [&[0.5, 6.0, 11.5], &[0.5, 7.0]];

const HEIGHTS: [f64; 2] = [4.0, 3.2];

/// A space frame of two storeys, turned on the site, with a beam missing and a column of its own size. Its columns keep their length or do
/// not; `hinge`: stiffness of hinges in units of EI/l.
fn in_space(axial: bool, hinge: Option<f64>) -> Tiers {
    let places = {
        let mut all = Vec::new();
        for storey in 0..2 {
            for x in 0..3 {
                for y in 0..2 {
                    let line = [x, y];
                    all.push(SpacePlace::Column { line, storey });
                    if x < 2 {
                        all.push(SpacePlace::BeamX {
                            span: x,
                            line: y,
                            floor: storey,
                        });
                    }
                    if y < 1 && !(x == 1 && storey == 0) {
                        all.push(SpacePlace::BeamY {
                            line: x,
                            span: y,
                            floor: storey,
                        });
                    }
                }
            }
        }
        all
    };
    let mut frame = SpaceFrame {
        at: [0.0, 0.0],
        direction: [1.0, 0.0],
        lines_x: LINES[0].to_vec(),
        lines_y: LINES[1].to_vec(),
        members: Vec::new(),
        ..SpaceFrame::default()
    };
    let members = places.into_iter().map(|place| {
        let mut section = match place {
            SpacePlace::Column { line: [2, 0], .. } => {
                SpaceSection::rectangle([0.35, 0.7], 30e9, 0.2, true)
            }
            SpacePlace::Column { .. } => SpaceSection::rectangle([0.5, 0.4], 30e9, 0.2, true),
            _ => SpaceSection::beam([0.3, 0.6], 30e9, 0.2, true),
        }
        .expect("a section");
        if !axial {
            section.axial_rigidity = None;
        }
        let length = frame.length(place, &HEIGHTS);
        let planes: &[usize] = match place {
            SpacePlace::Column { .. } => &[0, 1],
            _ => &[0],
        };
        let mut hinges = [None; 2];
        for &plane in planes {
            let stiffness = hinge.map(|hinge| hinge * section.flexural_rigidity[plane] / length);
            // It stays elastic.
            hinges[plane] = stiffness.map(|stiffness| yielding(stiffness, 1e9));
        }
        SpaceMember {
            place,
            section,
            hinges,
        }
    });
    frame.members = members.collect();
    let floor = |mass: f64, centre: PlanPoint| Tier {
        centre,
        ..Tier::uniform(mass, rectangle(0.0, 0.0, 12.0, 8.0)).expect("an area")
    };
    let floors = vec![floor(1.4e5, [6.4, 3.7]), floor(1.1e5, [5.5, 4.4])];
    let mut tiers = held_by(floors, HEIGHTS.to_vec(), Vec::new());
    tiers.space_frame = Some(frame);
    tiers
}

/// The full matrix of a space frame: three motions of the mat and of every floor, rise and two rotations of every joint, and rotations of
/// member ends beyond hinges.
fn matrix_in_space(tiers: &Tiers, mat: PlanPoint, hinge: Option<f64>) -> Full {
    let frame = tiers.space_frame.as_ref().expect("a space frame");
    let centres = [mat, tiers.floors[0].centre, tiers.floors[1].centre];
    let ends = frame.members.len() * 4;
    let mut full = Full::new(9 + 3 * 12 + ends);
    let mut next = 9 + 3 * 12;
    // Displacements and rotations about x, y, z at a joint; level 0 is the mat.
    let joint = |full: &Full, level: usize, [x, y]: [usize; 2]| -> [Row; 6] {
        let at = [LINES[0][x], LINES[1][y]];
        let [ux, uy] = at_place(full, 3 * level, centres[level], at);
        let turn = full.unit(3 * level + 2);
        let joint = |part: usize| match level.checked_sub(1) {
            Some(floor) => full.unit(9 + 3 * (6 * floor + 2 * x + y) + part),
            None => full.zero(),
        };
        [ux, uy, joint(0), joint(1), joint(2), turn]
    };
    for member in &frame.members {
        let storey = member.place.storey();
        let [first, last] = member.place.crossings();
        let length = frame.length(member.place, &HEIGHTS);
        // Axis of the member; planes of bending: direction of deflection, axis of rotation, sign of the slope by it.
        let (axis, below, planes): (usize, usize, &[(usize, usize, f64)]) = match member.place {
            SpacePlace::Column { .. } => (2, storey, &[(0, 1, 1.0), (1, 0, -1.0)]),
            SpacePlace::BeamX { .. } => (0, storey + 1, &[(2, 1, -1.0)]),
            SpacePlace::BeamY { .. } => (1, storey + 1, &[(2, 0, 1.0)]),
        };
        let [a, b] = [(below, first), (storey + 1, last)].map(|(l, at)| joint(&full, l, at));
        let section = &member.section;
        if let Some(rigidity) = section.axial_rigidity.filter(|_| axis == 2) {
            let stretch = summed(&[(1.0, &b[2]), (-1.0, &a[2])]);
            full.spring(rigidity / length, &stretch);
        }
        let twist = summed(&[(1.0, &b[3 + axis]), (-1.0, &a[3 + axis])]);
        full.spring(section.torsional_rigidity / length, &twist);
        for (plane, &(towards, about, sign)) in planes.iter().enumerate() {
            let rigidity = section.flexural_rigidity[plane];
            let shear = section
                .shear_rigidity
                .map(|shear_rigidity| shear_rigidity[plane]);
            let mut slopes = [&a, &b].map(|end| summed(&[(sign, &end[3 + about])]));
            if let Some(hinge) = hinge {
                for slope in &mut slopes {
                    let beyond = full.unit(next);
                    next += 1;
                    let turn = summed(&[(1.0, &beyond), (-1.0, slope)]);
                    full.spring(hinge * rigidity / length, &turn);
                    *slope = beyond;
                }
            }
            let [from, to] = &slopes;
            full.beam(
                rigidity,
                shear,
                length,
                [&a[towards], from, &b[towards], to],
            );
        }
    }
    // Unknowns that no member uses, and rises of columns that keep their length, are held.
    for at in 9..full.matrix.len() {
        let is_rise = at < 9 + 36 && (at - 9).is_multiple_of(3);
        let rigid = is_rise && frame.members[0].section.axial_rigidity.is_none();
        if rigid || full.matrix[at][at] == 0.0 {
            full.matrix[at][at] += 1e22;
        }
    }
    full
}

#[test]
fn a_space_frame_on_a_mat_has_the_flexibility_and_periods_of_the_full_matrix() {
    let (mat, _) = rectangular_mat(12.0, 8.0);
    for axial in [true, false] {
        let tiers = in_space(axial, None);
        let mut full = matrix_in_space(&tiers, mat, None);
        add_bearings(&mut full, mat, STIFFNESS);
        same_flexibility(&on_bearings(tiers, BETA, Solver::Riccati, 1e-3), &full);
    }
}

/// Two equal plane frames and beams between them, shaken along them: each is a plane isolated frame, its members included.
#[test]
fn a_space_frame_on_a_mat_is_two_isolated_plane_frames() {
    let lines = [vec![0.0, 6.0, 11.0], vec![0.0, 7.0]];
    let (storeys, height, mass, mat) = (2, 3.2, 1.2e5, 9e4);
    let column = SpaceSection::rectangle([0.5, 0.4], 30e9, 0.2, false).expect("a section");
    let beam = SpaceSection::beam([0.3, 0.6], 30e9, 0.2, false).expect("a section");
    let of_plane = |section: &SpaceSection| Section {
        flexural_rigidity: section.flexural_rigidity[0],
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass: 0.0,
    };
    let stiff = |section: &SpaceSection| 50.0 * section.flexural_rigidity[0] / 3.2;
    for yields in [false, true] {
        let hinge = |section: &SpaceSection| yields.then(|| yielding(stiff(section), 60e3));
        let mut members = Vec::new();
        let mut add = |place: SpacePlace, section: SpaceSection| {
            let section = SpaceSection {
                axial_rigidity: None,
                ..section
            };
            let second = matches!(place, SpacePlace::Column { .. });
            let hinges = [hinge(&section), hinge(&section).filter(|_| second)];
            members.push(SpaceMember {
                place,
                section,
                hinges,
            });
        };
        for storey in 0..storeys {
            for x in 0..3 {
                for y in 0..2 {
                    let line = [x, y];
                    add(SpacePlace::Column { line, storey }, column);
                    if x < 2 {
                        let (span, line, floor) = (x, y, storey);
                        add(SpacePlace::BeamX { span, line, floor }, beam);
                    }
                }
                let (line, span, floor) = (x, 0, storey);
                add(SpacePlace::BeamY { line, span, floor }, beam);
            }
        }
        let tier = Tier::uniform(mass, rectangle(0.0, 0.0, 11.0, 7.0)).expect("an area");
        let mut tiers = held_by(vec![tier; storeys], vec![height; storeys], Vec::new());
        tiers.space_frame = Some(SpaceFrame {
            at: [0.0, 0.0],
            direction: [1.0, 0.0],
            lines_x: lines[0].clone(),
            lines_y: lines[1].clone(),
            members,
            ..SpaceFrame::default()
        });
        let plane = Frame {
            columns: vec![of_plane(&column); storeys],
            beams: vec![of_plane(&beam); storeys],
            floor_mass: vec![0.5 * mass; storeys],
            beam_mass: vec![0.0; storeys],
            ..massless(frame(storeys, &[6.0, 5.0]))
        };
        let rows = |count: usize, section: &SpaceSection| match hinge(section) {
            Some(hinge) => vec![vec![hinge; count]; storeys],
            None => Vec::new(),
        };
        let plane_hinges = yields.then(|| {
            Hinges::Frame(FrameHinges {
                columns: rows(3, &column),
                beams: rows(2, &beam),
                ..FrameHinges::default()
            })
        });
        let damping = Damping::ratio(0.04, [1, 2]);
        let motion = shaking("line", 4.0, 1.0);
        let pairs = bearings(mat, 2.0).into_iter().zip(bearings(0.5 * mat, 1.0));
        for (isolation, half) in pairs {
            let kind = isolation.isolator.name();
            let modelled = |structure, hinges, isolation| {
                let damping = damping.clone();
                model(structure, hinges, damping, isolation, Solver::Riccati, 4e-3)
            };
            let flat = modelled(Structure::Frame(plane.clone()), plane_hinges.clone(), half);
            let (plane_system, flat) = run(&flat, &motion);
            let deep = modelled(Structure::Tiers(tiers.clone()), None, isolation);
            let (system, deep) = run(&deep, &motion);
            let apart = difference(&along(&deep, storeys), &along(&flat, storeys));
            println!("{kind} {yields}: {apart:e}");
            assert!(apart < 1e-8, "{kind} {yields}: {apart:e}");
            let [members, of_plane] =
                [&system, &plane_system].map(|system| &system.buildings[0].members.members);
            let mut compared = 0;
            for member in members {
                let MemberPlace::InSpace(place) = member.place else {
                    panic!("in space");
                };
                let wanted = match place {
                    SpacePlace::Column { line, storey } => MemberPlace::Column {
                        line: line[0] + 1,
                        storey: storey + 1,
                    },
                    SpacePlace::BeamX { span, floor, .. } => MemberPlace::Beam {
                        floor: floor + 1,
                        span: span + 1,
                    },
                    SpacePlace::BeamY { .. } => continue,
                };
                let other = of_plane.iter().find(|plane| plane.place == wanted);
                let other = other.expect("the same member");
                for end in 0..2 {
                    for kind in 0..3 {
                        // Floors hold beams.
                        if kind == 0 && !member.place.is_column() {
                            continue;
                        }
                        let a = deep.members[0][member.sections[end].forms[kind]];
                        let b = flat.members[0][other.sections[end].forms[kind]];
                        let scale = b[0].max(-b[1]).max(1e3);
                        for (a, b) in a.into_iter().zip(b) {
                            let apart = (a - b).abs() / scale;
                            assert!(apart < 1e-7, "{place} {end} {kind}: {a} and {b}");
                            compared += 1;
                        }
                    }
                }
            }
            assert_eq!(compared, 2 * (12 * 6 + 8 * 4));
        }
    }
}

/// Hinges that have not cracked are springs between joints and members.
#[test]
fn a_space_frame_with_hinges_on_a_mat_moves_as_the_full_matrix() {
    let (mat, _) = rectangular_mat(12.0, 8.0);
    // Damping does not act on hinges.
    for (hinge, beta) in [(None, BETA), (Some(6.0), 0.0)] {
        let tiers = in_space(true, hinge);
        let full = matrix_in_space(&tiers, mat, hinge);
        same_motion(&tiers, &full, beta);
    }
}

fn faults(model: &Model) -> String {
    let faults = System::assemble(model).expect_err("it is refused");
    let lines = faults
        .iter()
        .map(|fault| format!("{}: {}\n", fault.path, fault.problem));
    lines.collect()
}

#[test]
fn columns_on_a_mat_have_no_base_of_their_own() {
    let mut tiers = three_frames();
    tiers.frames[1].base.rotational_stiffness = Some(1e8);
    let found = faults(&on_bearings(tiers, BETA, Solver::Riccati, 1e-3));
    assert!(
        found.contains("building[0].frame[1].base: cannot be combined with isolation: columns are fixed to the mat; leave out base"),
        "{found}"
    );
}

/// Linear bearings are springs like others; those that slide have no path from corner to corner.
#[test]
fn bearings_that_slide_in_plan_have_no_pushover() {
    let mut model = on_bearings(three_frames(), BETA, Solver::Riccati, 1e-3);
    let system = assembled(&model);
    let building = &system.buildings[0];
    let pushed = pushover(building, PushSettings::default()).expect("it is elastic");
    let last = pushed.points.last().expect("points");
    let mut load = vec![0.0; building.equations.len()];
    for (floor, share) in building.floors.iter().zip(&pushed.floor_loads) {
        load[floor.dof] = share * last.base_shear;
    }
    let u = solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("it stands");
    assert!((u[building.floors[1].dof] / last.roof - 1.0).abs() < 1e-9);
    let [_, lead, _] = bearings(1.1e5, 1.0);
    model.buildings[0].base.isolation = Some(lead);
    let refused = pushover(&assembled(&model).buildings[0], PushSettings::default());
    assert_eq!(refused.err(), Some(CannotPush::BearingsInPlan));
}
