//! Columns that fail in shear: pushed as by hand, shaken as one mass on a curve, and with everything else in one system.

use jostle::history::Owner;
use jostle::hysteresis::{Backbone, Corners, FallingBranch, Hysteresis, HysteresisRule};
use jostle::model::CapacityLine;
use jostle::pushover::{PushEnd, PushEventKind, PushPoint, PushSettings, Pushover, pushover};
use jostle::statics::STANDARD_GRAVITY;
use jostle::{
    Building, Column, Damping, Frame, FrameHinges, Gravity, GroundMotion, Hinges, Joint, LawKind,
    Model, Plan, ShearEnds, ShearSpring, Solver, System,
};

use crate::verification::monolith::monolith;
use crate::verification::support::{
    assembled, column, difference, frame, framed, largest, law, row, run, section, shaking, steps,
    tower,
};

/// Stiffness of a spring before failure, over that of its column.
const STIFF: f64 = 50.0;
const HEIGHT: f64 = 3.2;

/// A curve of one column that stands on a fixed foot and is free to turn at its head, with its spring: stiffness of the
/// column, of the spring, strength, loss of shear per displacement of both together, residual.
#[derive(Clone, Copy)]
struct Cantilever {
    column: f64,
    spring: f64,
    strength: f64,
    slope: f64,
    residual: f64,
}

impl Cantilever {
    fn new(strength: f64, slope: f64, residual: f64) -> Self {
        let column = 3.0 * section(0.5, 0.5).flexural_rigidity / HEIGHT.powi(3);
        Self {
            column,
            spring: STIFF * column,
            strength,
            slope,
            residual,
        }
    }

    fn shear_spring(&self) -> ShearSpring {
        let falling = FallingBranch {
            slope: 1.0 / (1.0 / self.slope + 1.0 / self.column),
            residual: self.residual,
        };
        ShearSpring {
            spring: Hysteresis::failing(self.spring, self.strength, falling).expect("sound"),
            ends: ShearEnds::Foot,
            by_ductility: CapacityLine::default(),
        }
    }

    fn stiffness(&self) -> f64 {
        1.0 / (1.0 / self.column + 1.0 / self.spring)
    }

    /// Force on first loading to a displacement of the head.
    fn force(&self, displacement: f64) -> f64 {
        let failure = self.strength / self.stiffness();
        if displacement <= failure {
            self.stiffness() * displacement
        } else {
            (self.strength - self.slope * (displacement - failure)).max(self.residual)
        }
    }
}

/// One storey of two cantilevers, whose beam does not bend them and keeps its length.
fn two_cantilevers(columns: [Cantilever; 2], mass: f64) -> Building {
    let mut building = framed(
        "portal",
        Frame {
            floor_mass: vec![mass],
            beam_mass: vec![0.0],
            column_segments: 1,
            beam_segments: vec![1],
            joint: Joint {
                rotational_stiffness: Some(1e-4),
                ..Joint::default()
            },
            columns: vec![jostle::Section {
                line_mass: 0.0,
                ..section(0.5, 0.5)
            }],
            ..frame(1, &[6.0])
        },
    );
    building.damping = Damping::Rayleigh {
        alpha: 0.4,
        beta: 0.0,
    };
    building.hinges = Some(Hinges::Frame(FrameHinges {
        shear: vec![columns.iter().map(Cantilever::shear_spring).collect()],
        ..FrameHinges::default()
    }));
    building
}

fn alone(building: Building) -> Model {
    let other = tower("far away", 1, 4e4, 0.5);
    row(vec![building, other], 5.0, law(LawKind::Hertz, 1.0))
}

fn pushed(system: &System, drift: f64) -> Pushover {
    let settings = PushSettings {
        drift,
        ..PushSettings::default()
    };
    pushover(&system.buildings[0], settings).expect("it can be pushed")
}

#[test]
fn two_cantilevers_are_pushed_as_by_hand() {
    let columns = [
        Cantilever::new(3e5, 8e6, 6e4),
        Cantilever::new(4.5e5, 2e7, 0.0),
    ];
    let system = assembled(&alone(two_cantilevers(columns, 4e4)));
    let curve = pushed(&system, 0.03);
    let mut failures = Vec::new();
    for point in &curve.points {
        let due: f64 = columns.iter().map(|column| column.force(point.roof)).sum();
        assert!(
            (point.base_shear - due).abs() < 1e-8 * 7e5,
            "{} N instead of {due} N at {} m",
            point.base_shear,
            point.roof
        );
        failures.extend(point.events.iter().filter_map(|event| {
            (event.kind == PushEventKind::Fails).then_some((event.spring, point.roof))
        }));
    }
    // Origin, two failures, two ends of falling branches, the target.
    assert_eq!(curve.points.len(), 6, "{:?}", curve.points);
    assert_eq!(curve.failures(), 2);
    for ((spring, roof), (index, column)) in failures.iter().zip(columns.iter().enumerate()) {
        assert_eq!(*spring, index);
        let due = column.strength / column.stiffness();
        assert!(
            (roof / due - 1.0).abs() < 1e-9,
            "{roof} m instead of {due} m"
        );
    }
    // The first column takes its load off only where the second has grown stronger than it lost.
    let peak = curve.peak();
    assert!(peak.roof > columns[0].strength / columns[0].stiffness());
    let last = curve.points.last().expect("points");
    assert!((last.base_shear - 6e4).abs() < 1e-3, "{}", last.base_shear);
}

/// A column under its load P: bent by F = (3 EI/L³ − P/L) u_c with one element for the column, and slid by δ with
/// F = V(δ) − P δ/L.
#[test]
fn what_a_column_slides_leans_as_the_drift_of_its_storey_does() {
    let cantilever = Cantilever::new(3e5, 8e6, 1e5);
    let mut building = two_cantilevers([cantilever; 2], 1e5);
    building.gravity = Gravity {
        preload: false,
        p_delta: true,
    };
    let system = assembled(&alone(building));
    let curve = pushed(&system, 0.05);
    let load = 0.5 * 1e5 * STANDARD_GRAVITY / HEIGHT;
    // Rotations of the head condensed out of [12, 6; 6, 4] EI with −P/L on the displacements.
    let bending = cantilever.column - load;
    let falling = 1.0 / (1.0 / cantilever.slope + 1.0 / cantilever.column);
    for point in &curve.points[1..] {
        let each = 0.5 * point.base_shear;
        let slid = point.roof - each / bending;
        let failure = cantilever.strength / cantilever.spring;
        let shear = if slid <= failure * (1.0 + 1e-9) {
            cantilever.spring * slid
        } else {
            (cantilever.strength - falling * (slid - failure)).max(cantilever.residual)
        };
        let due = shear - load * slid;
        assert!(
            (each - due).abs() < 1e-7 * cantilever.strength,
            "{each} N instead of {due} N at {} m",
            point.roof
        );
    }
    assert!(curve.points.len() >= 4, "{:?}", curve.points.len());
}

/// The equation of one mass by central differences over the curve of both columns, written once more: damage of one
/// direction counts in the other.
fn by_central_differences(
    columns: [Cantilever; 2],
    mass: f64,
    alpha: f64,
    ground: impl Fn(f64) -> f64,
    duration: f64,
) -> [f64; 4] {
    struct Path {
        curve: Cantilever,
        at: f64,
        force: f64,
        /// Greatest displacement on the curve, and displacement without force on the way to either side.
        peak: f64,
        zero: [f64; 2],
        failed: bool,
        work: f64,
    }
    impl Path {
        fn go(&mut self, to: f64) {
            let k = self.curve.stiffness();
            let side = usize::from(to < self.at);
            let sign = [1.0, -1.0][side];
            let elastic = self.force + k * (to - self.at);
            let failure = self.curve.strength / k;
            let force = if !self.failed && to.abs() <= failure {
                elastic
            } else {
                if !self.failed {
                    (self.failed, self.peak) = (true, failure);
                }
                if sign * self.force <= 0.0 {
                    self.zero[side] = self.at - self.force / k;
                }
                if sign * to >= self.peak {
                    self.peak = sign * to;
                    sign * self.curve.force(self.peak)
                } else if sign * elastic <= 0.0 {
                    elastic
                } else {
                    let start = sign * self.zero[side];
                    let line =
                        self.curve.force(self.peak) * (sign * to - start) / (self.peak - start);
                    sign * line.min(sign * elastic)
                }
            };
            self.work += 0.5 * (force + self.force) * (to - self.at);
            (self.at, self.force) = (to, force);
        }
    }
    let mut paths = columns.map(|curve| Path {
        curve,
        at: 0.0,
        force: 0.0,
        peak: 0.0,
        zero: [0.0; 2],
        failed: false,
        work: 0.0,
    });
    let h = 1e-5;
    let count = (duration / h).round() as usize;
    let (mut before, mut now, mut highest, mut lowest) = (0.0, 0.0, 0.0_f64, 0.0_f64);
    for step in 0..count {
        paths.iter_mut().for_each(|path| path.go(now));
        let force: f64 = paths.iter().map(|path| path.force).sum();
        let load = -mass * ground(step as f64 * h) - force;
        let after =
            (load + mass / (h * h) * (2.0 * now - before) + alpha * mass / (2.0 * h) * before)
                / (mass / (h * h) + alpha * mass / (2.0 * h));
        (before, now) = (now, after);
        highest = highest.max(now);
        lowest = lowest.min(now);
    }
    let work = paths
        .iter()
        .map(|path| path.work - 0.5 * path.force * path.force / path.curve.stiffness());
    [highest, lowest, now, work.sum()]
}

#[test]
fn failing_columns_move_as_one_mass_by_central_differences() {
    let columns = [
        Cantilever::new(1.6e5, 6e6, 4e4),
        Cantilever::new(2.2e5, 9e6, 5e4),
    ];
    let mass = 4e4;
    let wave = |t: f64| {
        let sin = |frequency: f64| (std::f64::consts::TAU * frequency * t).sin();
        4.5 * t.min(1.0) * (sin(1.7) + 0.6 * sin(3.1))
    };
    let interval = 0.002;
    let values: Vec<f64> = (0..=2500).map(|k| wave(f64::from(k) * interval)).collect();
    // Straight between the points, as the run has it.
    let ground = |t: f64| {
        let at = (t / interval).min(2_499.999_999);
        let (k, share) = (at.floor() as usize, at.fract());
        values[k] + share * (values[k + 1] - values[k])
    };
    let duration = 5.0;
    let due = by_central_differences(columns, mass, 0.4, ground, duration);
    let motion = GroundMotion::sampled("sines", interval, values.clone());
    let system = assembled(&alone(two_cantilevers(columns, mass)));
    let mut worst = Vec::new();
    for step in [1e-3, 5e-4] {
        let outcome = run(&system, &motion, &steps(step, 1));
        let roof = column(&outcome, Column::displacement(0, 1));
        let most = roof.iter().fold([0.0_f64; 2], |[high, low], value| {
            [high.max(*value), low.min(*value)]
        });
        let dissipated: f64 = system.buildings[0]
            .equations
            .springs
            .iter()
            .zip(&outcome.state.springs)
            .enumerate()
            .map(|(index, (spring, memory))| {
                let work = outcome.peaks.work(Owner::Spring(index));
                work - spring.hysteresis.recoverable_energy(memory)
            })
            .sum();
        // Energy in the tests's own springs is that of column and spring together.
        let got = [most[0], most[1], roof[roof.len() - 1], dissipated];
        let scale = [due[0], due[0], due[0], due[3]];
        let apart = (0..4).map(|k| ((got[k] - due[k]) / scale[k]).abs());
        worst.push(apart.fold(0.0, f64::max));
        assert_eq!(outcome.spring_events.len(), 2, "both columns fail");
        assert!(
            outcome.energy.worst_imbalance < 1e-9,
            "{:e}",
            outcome.energy.worst_imbalance
        );
    }
    println!("{worst:?}, due {due:?}");
    assert!(worst[1] < 2e-3 && worst[1] < 0.5 * worst[0], "{worst:?}");
}

/// Strength falls along a line over the ductility of a hinge at the foot: the column fails where both lines meet.
#[test]
fn strength_falls_with_the_ductility_of_the_hinge() {
    let cantilever = Cantilever::new(3e5, 8e6, 0.0);
    let mut building = two_cantilevers([cantilever; 2], 4e4);
    // Yields at 240 kN · 3.2 m; the strength falls from 300 kN at ductility 2 to 210 kN at 6.
    let moment = 2.4e5 * HEIGHT;
    let initial = 5e9;
    let corners = Corners::bilinear(moment, 1e-3);
    let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
    let hinge = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
    let line = CapacityLine::new(vec![[2.0, 3e5], [6.0, 2.1e5]]);
    let Some(Hinges::Frame(hinges)) = &mut building.hinges else {
        panic!("it has shear springs");
    };
    hinges.columns = vec![vec![hinge; 2]];
    for column in &mut hinges.shear[0] {
        column.by_ductility = line.clone();
    }
    let system = assembled(&alone(building));
    let curve = pushed(&system, 0.08);
    let failed = curve
        .points
        .iter()
        .find(|point| point.events.iter().any(|e| e.kind == PushEventKind::Fails))
        .expect("it fails");
    // M = My + r k (θ − θy), V = M/L; μ = (θ + M/K)/(θy + My/K), K = 6 EI/L.
    let behind = 6.0 * section(0.5, 0.5).flexural_rigidity / HEIGHT;
    let yields = moment / initial;
    let moment_at = |turn: f64| moment + 1e-3 * initial * (turn - yields);
    let excess = |turn: f64| {
        let bent = moment_at(turn);
        let ductility = (turn + bent / behind) / (yields + moment / behind);
        bent / HEIGHT - line.at(ductility)
    };
    let (mut low, mut high) = (yields, 0.1);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    let force = moment_at(low) / HEIGHT;
    let roof = HEIGHT * low + force / cantilever.column + force / cantilever.spring;
    // Within a part of the target, in which ductility is followed.
    assert!(
        (failed.roof - roof).abs() < 1.1 * 0.08 * HEIGHT / 400.0 && failed.roof >= roof - 1e-9,
        "{} m instead of {roof} m",
        failed.roof
    );
    assert!(
        (0.5 * failed.base_shear / force - 1.0).abs() < 5e-3,
        "{} N instead of {force} N",
        0.5 * failed.base_shear
    );
}

/// Tangents of one column: of its hinges, and of its shear spring.
struct Tangents {
    hinges: f64,
    shear: f64,
}

/// Force per displacement at the beam of a portal frame, from nine equations: displacement of the beam, rotations of both
/// joints, and of each column its rotations beyond the hinges and its slip at the foot.
fn slope_of_portal(
    height: f64,
    column: f64,
    [span, beam]: [f64; 2],
    column_tangents: [Tangents; 2],
) -> f64 {
    const SIZE: usize = 9;
    let mut matrix = [[0.0; SIZE]; SIZE];
    // Adds k (Σ aᵢ xᵢ)²/2.
    let mut spring = |stiffness: f64, terms: &[(usize, f64)]| {
        for (i, a) in terms {
            for (j, b) in terms {
                matrix[*i][*j] += stiffness * a * b;
            }
        }
    };
    // Of a beam: 12 EI/L³ (w₂ − w₁ − L (θ₁ + θ₂)/2)² and EI/L (θ₂ − θ₁)².
    spring(beam / span, &[(1, 1.0), (2, -1.0)]);
    spring(3.0 * beam / span, &[(1, 1.0), (2, 1.0)]);
    for (index, tangents) in column_tangents.iter().enumerate() {
        let (joint, foot, head, slip) = (1 + index, 3 + index, 5 + index, 7 + index);
        // A displacement to the right turns the axis clockwise.
        let half = 0.5 * height;
        let terms = [(0, -1.0), (slip, 1.0), (foot, -half), (head, -half)];
        spring(12.0 * column / height.powi(3), &terms);
        spring(column / height, &[(foot, 1.0), (head, -1.0)]);
        spring(tangents.hinges, &[(foot, 1.0)]);
        spring(tangents.hinges, &[(head, 1.0), (joint, -1.0)]);
        spring(tangents.shear, &[(slip, 1.0)]);
    }
    // Everything but the displacement of the beam is eliminated, the largest pivot first.
    let mut left: Vec<usize> = (1..SIZE).collect();
    while let Some(at) = (0..left.len()).max_by(|a, b| {
        (matrix[left[*a]][left[*a]].abs()).total_cmp(&matrix[left[*b]][left[*b]].abs())
    }) {
        let pivot = left.swap_remove(at);
        let row = matrix[pivot];
        for other in left.iter().copied().chain([0]) {
            let factor = matrix[other][pivot] / row[pivot];
            for (to, from) in matrix[other].iter_mut().zip(row) {
                *to -= factor * from;
            }
        }
    }
    matrix[0][0]
}

/// A column whose hinges are cracked unloads when it fails, while the others load on. The slopes of the push before and after
/// are those of a portal frame with these tangents.
#[test]
fn a_column_that_fails_unloads_its_hinges() {
    let weightless = |section: jostle::Section| jostle::Section {
        axial_rigidity: None,
        line_mass: 0.0,
        ..section
    };
    let span = 6.0;
    let frame = Frame {
        columns: vec![weightless(section(0.5, 0.5))],
        beams: vec![weightless(section(0.3, 0.6))],
        beam_mass: vec![0.0],
        floor_mass: vec![4e4],
        column_segments: 1,
        beam_segments: vec![1],
        ..frame(1, &[span])
    };
    let (rigidity, beam) = (
        frame.columns[0].flexural_rigidity,
        frame.beams[0].flexural_rigidity,
    );
    let column = 12.0 * rigidity / HEIGHT.powi(3);
    let cantilever = |strength: f64| Cantilever {
        column,
        spring: 1e4 * column,
        strength,
        slope: 5e6,
        residual: 3e4,
    };
    let corners = Corners {
        cracking: 5e4,
        yielding: 1e6,
        post_cracking: 1e-4,
        post_yield: 1e-6,
    };
    let initial = 1e5 * rigidity / HEIGHT;
    let backbone = Backbone::from_forces(initial, corners, corners);
    let hinge = Hysteresis::new(HysteresisRule::PeakOriented, backbone.expect("sound"));
    let mut building = framed("portal", frame);
    building.damping = Damping::Rayleigh {
        alpha: 0.4,
        beta: 0.0,
    };
    building.hinges = Some(Hinges::Frame(FrameHinges {
        columns: vec![vec![hinge.expect("sound"); 2]],
        shear: vec![vec![
            cantilever(1.5e5).shear_spring(),
            cantilever(9e5).shear_spring(),
        ]],
        ..FrameHinges::default()
    }));
    let curve = pushed(&assembled(&alone(building)), 0.04);
    assert_eq!(curve.end, PushEnd::Target);
    assert_eq!(curve.failures(), 1);
    let fails = |point: &&PushPoint| point.events.iter().any(|e| e.kind == PushEventKind::Fails);
    let failed = curve.points.iter().position(|point| fails(&point));
    let failed = failed.expect("it fails");
    let slope = |first: usize| {
        let [a, b] = [&curve.points[first], &curve.points[first + 1]];
        (b.base_shear - a.base_shear) / (b.roof - a.roof)
    };
    let cracked = || Tangents {
        hinges: 1e-4 * initial,
        shear: 1e4 * column,
    };
    let unloading = Tangents {
        hinges: initial,
        shear: -1.0 / (1.0 / 5e6 + 1.0 / column),
    };
    let before = slope_of_portal(HEIGHT, rigidity, [span, beam], [cracked(), cracked()]);
    let after = slope_of_portal(HEIGHT, rigidity, [span, beam], [unloading, cracked()]);
    assert!(after < 0.5 * before, "{after} after {before}");
    for (found, due) in [(slope(failed - 1), before), (slope(failed), after)] {
        assert!(
            (found - due).abs() < 1e-6 * before,
            "{found} instead of {due}"
        );
    }
}

/// Frames with hinges and columns that fail.
fn two_failing_frames() -> Model {
    let fails = |strength: f64| {
        let stiffness = 12.0 * section(0.5, 0.5).flexural_rigidity / HEIGHT.powi(3);
        let falling = FallingBranch {
            slope: 0.1 * stiffness,
            residual: 0.2 * strength,
        };
        ShearSpring {
            spring: Hysteresis::failing(1e4 * stiffness, strength, falling).expect("sound"),
            ends: ShearEnds::Foot,
            by_ductility: CapacityLine::default(),
        }
    };
    let hinge = |moment: f64| {
        let corners = Corners {
            cracking: 0.35 * moment,
            yielding: moment,
            post_cracking: 0.3,
            post_yield: 0.02,
        };
        let backbone = Backbone::from_forces(1e10, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("sound")
    };
    let mut left = framed("left", frame(3, &[4.0, 6.0]));
    left.hinges = Some(Hinges::Frame(FrameHinges {
        columns: vec![vec![hinge(2.5e5); 3]; 3],
        shear: vec![vec![fails(1.2e5); 3]; 3],
        ..FrameHinges::default()
    }));
    let mut right = framed("right", frame(4, &[5.0]));
    right.hinges = Some(Hinges::Frame(FrameHinges {
        shear: vec![vec![fails(1.6e5); 2]; 4],
        ..FrameHinges::default()
    }));
    for building in [&mut left, &mut right] {
        building.damping = Damping::Rayleigh {
            alpha: 0.3,
            beta: 2e-3,
        };
        building.gravity = Gravity {
            // The monolith starts from springs at rest.
            preload: false,
            p_delta: true,
        };
    }
    row(vec![left, right], 0.01, law(LawKind::HertzDamp, 0.65))
}

#[test]
fn condensed_equals_monolithic_while_columns_fail() {
    let system = assembled(&two_failing_frames());
    let motion = shaking(1.6);
    let outcome = run(&system, &motion, &steps(1e-3, 2));
    let failed = system
        .buildings
        .iter()
        .flat_map(|building| &building.discretization.spring_places)
        .enumerate()
        .filter(|(index, place)| {
            let mut events = outcome.spring_events.iter();
            place.is_shear() && events.any(|event| event.spring == *index)
        });
    assert!(failed.count() > 3 && outcome.impacts.len() > 2);
    let times = column(&outcome, Column::TIME);
    let (peaks, displacement) = monolith(&system, &motion, &times);
    let got: Vec<f64> = (0..system.contacts.len())
        .map(|contact| largest(&column(&outcome, Column::contact_force(contact))))
        .collect();
    let (forces, displacements) = (
        difference(&got, &peaks),
        difference(&outcome.state.displacement, &displacement),
    );
    println!(
        "{forces:e} {displacements:e} {:e}",
        outcome.energy.worst_imbalance
    );
    assert!(
        forces < 1e-8 && displacements < 1e-8,
        "{forces:e} {displacements:e}"
    );
    assert!(
        outcome.energy.worst_imbalance < 1e-9,
        "{:e}",
        outcome.energy.worst_imbalance
    );
    let direct = Plan {
        solver: Solver::Stiffness,
        ..steps(1e-3, 2)
    };
    let other = run(&system, &motion, &direct);
    assert_eq!(outcome.spring_events, other.spring_events);
    let apart = difference(&outcome.state.displacement, &other.state.displacement);
    assert!(apart < 1e-7, "{apart:e}");
}
