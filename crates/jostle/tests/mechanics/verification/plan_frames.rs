//! Plane frames at lines of a plan: the plane as their limit, and matrices assembled by hand.

use std::f64::consts::PI;

use jostle::linear::StepMatrix;
use jostle::pushover::LoadPattern;
use jostle::structure::{MemberPlace, SectionAt, solve_once};
use jostle::{
    Analysis, Base, Building, Damping, Diagonal, DiagonalKind, DiagonalPlace, Frame, Gap,
    GroundMotion, MemberRequest, Model, Outcome, PlanFrame, PlanPoint, Reach, RiccatiSweep, Rise,
    Section, Solver, State, Structure, StrutLine, System, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{self, CONCRETE, FIVE_PERCENT, concrete, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{self, assembled};

/// Heavy columns and beams, both in four segments.
pub(super) fn frame(storeys: usize, spans: &[f64]) -> Frame {
    Frame {
        beam_mass: vec![5850.0; storeys],
        column_segments: 4,
        beam_segments: vec![4; spans.len()],
        ..models::frame(storeys, spans, concrete(0.5, 0.5), concrete(0.3, 0.6))
    }
}

/// The same without mass, so that only floors have any.
pub(super) fn massless(mut frame: Frame) -> Frame {
    frame
        .columns
        .iter_mut()
        .for_each(|column| column.line_mass = 0.0);
    frame.beam_mass.iter_mut().for_each(|mass| *mass = 0.0);
    frame.column_segments = 1;
    frame
        .beam_segments
        .iter_mut()
        .for_each(|beam_segment| *beam_segment = 1);
    frame
}

pub(super) fn standing(name: &str, at: PlanPoint, angle: f64, frame: Frame) -> PlanFrame {
    PlanFrame {
        name: name.to_owned(),
        at,
        direction: [angle.cos(), angle.sin()],
        lines: Vec::new(),
        base: Base::default(),
        hinges: Default::default(),
        frame,
    }
}

fn in_plan(slab: f64, plan: &[PlanPoint], storeys: usize, frames: Vec<PlanFrame>) -> Structure {
    let tier = Tier::uniform(slab, plan.to_vec()).expect("an area");
    Structure::Tiers(Tiers {
        floors: vec![tier; storeys],
        storey_heights: vec![3.2; storeys],
        frames,
        ..Tiers::default()
    })
}

fn building(name: &str, structure: Structure, damping: Damping) -> Building {
    Building {
        name: name.to_owned(),
        structure,
        damping,
        ..Building::default()
    }
}

const ALL_MODES: Damping = Damping::AllModes { ratio: 0.05 };

fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    Model {
        title: "frames in plan".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            solver: Some(Solver::Modal),
            tolerance: 1e-6,
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn shaking() -> GroundMotion {
    fading("along", 7.0, [1.0, 3.0], 400)
}

fn run(model: &Model, duration: f64) -> (System, Outcome) {
    let mut motion = shaking();
    motion.duration = duration;
    let (system, outcome) = runs::run(model, &motion, None);
    assert!(outcome.energy.worst_imbalance < 1e-9);
    (system, outcome)
}

/// Floors of two runs, building by building; `share`: shears of the first over those of the second. Tolerances of displacements,
/// and of forces and accelerations.
fn same_floors(outcome: &Outcome, plane: &Outcome, share: f64, [tolerance, of_forces]: [f64; 2]) {
    for (index, (own_floors, floors)) in outcome
        .peaks
        .buildings()
        .zip(plane.peaks.buildings())
        .enumerate()
    {
        let most = |of: fn(&jostle::history::PeaksOf<'_>) -> f64| {
            floors.iter().map(of).fold(0.0, f64::max)
        };
        let scale = most(|floor| floor.displacement_max().value);
        let shear = most(|floor| floor.storey_shear());
        for (a, b) in own_floors.iter().zip(&floors) {
            let [a_max, b_max] = [a, b].map(|floor| floor.displacement_max().value);
            close(a_max, b_max, scale, tolerance, "right");
            let [a_min, b_min] = [a, b].map(|floor| floor.displacement_min().value);
            close(a_min, b_min, scale, tolerance, "left");
            close(
                a.storey_shear(),
                share * b.storey_shear(),
                share * shear,
                of_forces,
                "shear",
            );
            close(
                a.total_acceleration(),
                b.total_acceleration(),
                b.total_acceleration(),
                of_forces,
                "acceleration",
            );
        }
        let [a, b] = [outcome, plane].map(|outcome| outcome.peaks.base_shear(index));
        close(a, share * b, share * b, of_forces, "base shear");
        let scale = most(|floor| floor.displacement_max().value);
        for floor in own_floors {
            for other in [floor.turning(), floor.across()] {
                assert!(other.displacement_max().value.abs() < 1e-10 * scale);
            }
        }
    }
}

/// Mass that a frame adds to a floor if its columns move with the floors: rigid ends, and half of the parts beside them, with their
/// joint; points between the parts by their height.
fn frame_mass(frame: &Frame, floor: usize) -> f64 {
    let of_columns = |storey: usize, end: usize| -> f64 {
        let columns = (0..frame.lines()).filter_map(|line| {
            let rigid = frame.rigid_ends_of_column([storey, line]);
            Some((frame.column(storey, line)?, rigid))
        });
        let masses = columns.map(|(column, rigid)| {
            let height = frame.storey_heights[storey];
            let part = (height - rigid[0] - rigid[1]) / frame.column_segments as f64;
            let points = (1..frame.column_segments).map(|cut| rigid[1 - end] + part * cut as f64);
            let shares: f64 = points.map(|point| part * point / height).sum();
            column.line_mass * (rigid[end] + 0.5 * part + shares)
        });
        masses.sum()
    };
    let width: f64 = frame.spans.iter().sum();
    let above = match floor + 1 < frame.storey_heights.len() {
        true => of_columns(floor + 1, 0),
        false => 0.0,
    };
    of_columns(floor, 1) + above + frame.beam_mass[floor] * width
}

#[test]
fn four_equal_frames_are_twice_a_plane_frame() {
    are_twice_a_plane_frame(&frame(4, &[6.0, 6.0]), &[ALL_MODES, FIVE_PERCENT]);
}

/// The middle column starts on the beams of the first floor, and none stands below the roof.
#[test]
fn frames_without_some_columns_are_twice_a_plane_frame() {
    let mut one = frame(4, &[6.0, 6.0]);
    one.own_columns = [([0, 1], None), ([3, 1], None)].into();
    // Shapes that reduce the plane frame pick up its vertical mode by rounding: 2·10⁻⁵ of the axial forces.
    are_twice_a_plane_frame(&one, &[ALL_MODES]);
}

/// Columns in parts between rigid ends: the mass of these ends moves with the joints.
#[test]
fn frames_with_rigid_ends_are_twice_a_plane_frame() {
    let mut one = frame(4, &[6.0, 6.0]);
    for floor in 0..4 {
        for line in 0..3 {
            one.rigid_zones.insert([floor, line], [0.25, 0.3]);
        }
    }
    are_twice_a_plane_frame(&one, &[ALL_MODES]);
}

/// Struts that meet columns off the joints divide them, so that masses move between the floors.
#[test]
fn frames_with_struts_off_the_joints_are_twice_a_plane_frame() {
    for segments in [1, 3] {
        let mut one = frame(4, &[6.0, 6.0]);
        one.column_segments = segments;
        one.diagonals = Rise::BOTH
            .map(|rise| Diagonal {
                place: DiagonalPlace {
                    kind: DiagonalKind::Infill,
                    line: None,
                    storey: 2,
                    bay: 1,
                    rise,
                    reach: Reach::BAY,
                    strut: StrutLine::Central,
                },
                stiffness: 8e7,
                hysteresis: None,
                offsets: [0.5, 0.7],
                across: None,
                damage: None,
            })
            .to_vec();
        are_twice_a_plane_frame(&one, &[ALL_MODES]);
    }
}

/// Feet of columns bear the weight of the building, whether or not anything can sink.
#[test]
fn columns_bear_the_weight_of_frames_that_keep_their_length() {
    for (flexible, segments) in [(false, 1), (false, 4), (true, 1), (true, 4)] {
        let mut one = frame(2, &[6.0, 6.0]);
        one.axial.columns_flexible = flexible;
        one.beam_segments = vec![segments; 2];
        let frames = vec![
            standing("1", [0.0, 0.0], 0.0, one.clone()),
            standing("2", [0.0, 12.0], 0.0, one.clone()),
            standing("A", [0.0, 0.0], 0.5 * PI, one.clone()),
            standing("B", [12.0, 0.0], 0.5 * PI, one),
        ];
        let plan = rectangle(0.0, 0.0, 12.0, 12.0);
        let damping = Damping::Rayleigh {
            alpha: 0.4,
            beta: 1e-3,
        };
        let mut own = building("A", in_plan(80e3, &plan, 2, frames), damping);
        own.gravity.preload = true;
        let mut model = model(vec![own], vec![]);
        model.analysis.solver = None;
        let system = assembled(&model);
        let building = &system.buildings[0];
        let mut forces = vec![0.0; building.members.forms.len()];
        let rest = State::at_rest(&system, 0.0);
        building.member_forces(&rest, &[], 0.0, |form, value| forces[form] = value);
        let columns = building.members.members.iter();
        let feet =
            columns.filter(|member| matches!(member.place, MemberPlace::Column { storey: 1, .. }));
        let borne: f64 = feet.map(|member| forces[member.sections[0].forms[0]]).sum();
        let weight = 9.80665 * building.equations.total_mass();
        close(
            -borne,
            weight,
            weight,
            1e-9,
            &format!("{flexible}, {segments}"),
        );
    }
}

/// Two frames along x and two across, all equal, shaken along x: half of it is a plane frame with the same mass.
fn are_twice_a_plane_frame(one: &Frame, dampings: &[Damping]) {
    let (storeys, slab) = (4, 80e3);
    let frames = vec![
        standing("1", [0.0, 0.0], 0.0, one.clone()),
        standing("2", [0.0, 12.0], 0.0, one.clone()),
        standing("A", [0.0, 0.0], 0.5 * PI, one.clone()),
        standing("B", [12.0, 0.0], 0.5 * PI, one.clone()),
    ];
    let plan = rectangle(0.0, 0.0, 12.0, 12.0);
    let space = in_plan(slab, &plan, storeys, frames);
    let mut plane = one.clone();
    for floor in 0..storeys {
        plane.floor_mass[floor] = 0.5 * slab + frame_mass(one, floor);
    }
    for damping in dampings {
        let space_model = model(vec![building("A", space.clone(), damping.clone())], vec![]);
        let flat = building("A", Structure::Frame(plane.clone()), damping.clone());
        let flat = model(vec![flat], vec![]);
        let [(system, outcome), (plane_system, plane_outcome)] =
            [run(&space_model, 8.0), run(&flat, 8.0)];
        let [a, b] = [&system, &plane_system].map(|system| &system.buildings[0]);
        // What moves along x; the lower halves of columns of frames A and B stand on the ground.
        let masses = [a, b].map(|building| building.equations.driven_mass.iter().sum::<f64>());
        close(masses[0], 2.0 * masses[1], masses[0], 1e-12, "mass");
        close(
            a.equations.alpha,
            b.equations.alpha,
            b.equations.alpha,
            1e-9,
            "alpha",
        );
        close(
            a.equations.beta,
            b.equations.beta,
            b.equations.beta,
            1e-9,
            "beta",
        );
        let along: Vec<f64> = a
            .modes
            .iter()
            .filter(|mode| mode.effective_mass_ratio_x > 0.01)
            .map(|mode| mode.circular_frequency)
            .collect();
        for (circular_frequency, plane) in along.iter().zip(&b.modes) {
            let expected = plane.circular_frequency;
            close(*circular_frequency, expected, expected, 1e-9, "frequency");
        }
        // Masses of columns between floors load a pushover at the floors beside them.
        let loads =
            [a, b].map(|building| LoadPattern::Triangular.forces(building).expect("masses"));
        for (own, other) in a.floors.iter().zip(&b.floors) {
            close(loads[0][own.dof], loads[1][other.dof], 1.0, 1e-9, "load");
        }
        // Reduced shapes of the plane keep the tolerance of 1e-6; all modes are exact.
        let tolerance = if *damping == ALL_MODES { 1e-9 } else { 2e-6 };
        same_floors(&outcome, &plane_outcome, 2.0, [tolerance; 2]);
        // Forces of the columns of frame 1 are those of the plane frame.
        let peaks = |system: &System, outcome: &Outcome, frame: Option<usize>| {
            let members = system.buildings[0].members.members.iter();
            let members = members.filter(|member| {
                member.frame == frame && matches!(member.place, MemberPlace::Column { .. })
            });
            let forms = members.flat_map(|member| member.sections[0].forms);
            let all: Vec<f64> = forms
                .map(|form| outcome.members[0][form])
                .map(|[most, least]| most.max(-least))
                .collect();
            all
        };
        let got = peaks(&system, &outcome, Some(0));
        let expected = peaks(&plane_system, &plane_outcome, None);
        assert_eq!(got.len(), expected.len());
        for (index, (a, b)) in got.iter().zip(&expected).enumerate() {
            let kind = expected.iter().skip(index % 3).step_by(3);
            let scale = kind.copied().fold(0.0, f64::max);
            close(*a, *b, scale, tolerance, "force of a column");
        }
    }
}

/// The frames of five and ten storeys of the built-in example, on lines of plans, 30 mm apart: impacts as in one plane.
#[test]
fn frames_of_the_example_pound_in_plan_as_in_one_plane() {
    let half = |rigidity: f64, line_mass: f64| Section {
        flexural_rigidity: 0.5 * rigidity,
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass,
    };
    let example = |storeys: usize, spans: &[f64], side: f64| Frame {
        columns: vec![half(30e9 * side.powi(4) / 12.0, 2500.0 * side * side); storeys],
        beams: vec![half(30e9 * 0.3 * 0.6_f64.powi(3) / 12.0, 0.0); storeys],
        beam_segments: spans.iter().map(|l| if *l < 3.0 { 4 } else { 8 }).collect(),
        ..frame(storeys, spans)
    };
    let frames = [
        example(5, &[2.4, 6.0], 0.5),
        example(10, &[6.0, 2.4, 6.0], 0.6),
    ];
    let slab = 1e3;
    let plane: Vec<Building> = ["J1", "J2"]
        .into_iter()
        .zip(&frames)
        .map(|(name, frame)| {
            let mut frame = frame.clone();
            frame.floor_mass.fill(slab);
            building(name, Structure::Frame(frame), ALL_MODES)
        })
        .collect();
    let mut start = 0.0;
    let space: Vec<Building> = ["J1", "J2"]
        .into_iter()
        .zip(&frames)
        .map(|(name, plane_frame)| {
            let (width, n): (f64, _) = (
                plane_frame.spans.iter().sum(),
                plane_frame.storey_heights.len(),
            );
            let brace = massless(frame(n, &[8.0]));
            let standing = vec![
                standing("1", [start, 4.0], 0.0, plane_frame.clone()),
                standing("A", [start, 0.0], 0.5 * PI, brace.clone()),
                standing("B", [start + width, 0.0], 0.5 * PI, brace),
            ];
            let plan = rectangle(start, 0.0, width, 8.0);
            start += width + 0.03;
            let mut structure = in_plan(slab, &plan, n, standing);
            // The bracing frames must not turn the floor about a centre off the line of the frame.
            if let Structure::Tiers(tiers) = &mut structure {
                tiers
                    .floors
                    .iter_mut()
                    .for_each(|floor| floor.centre[1] = 4.0);
            }
            building(name, structure, ALL_MODES)
        })
        .collect();
    let (_, flat) = run(&model(plane, vec![Gap::after(0, 0.03, CONCRETE)]), 4.0);
    let (_, spatial) = run(&model(space, vec![Gap::after(0, 0.03, CONCRETE)]), 4.0);
    assert!(flat.impacts.len() > 2, "{} impacts", flat.impacts.len());
    assert_eq!(spatial.face_impacts.len(), flat.impacts.len());
    // Steps while contacts are closed follow from the tolerance of 1e-6, and differ between the two models.
    same_floors(&spatial, &flat, 1.0, [1e-9, 1e-7]);
    let strongest = |peaks: &mut dyn Iterator<Item = f64>| peaks.fold(0.0, f64::max);
    let face = strongest(&mut spatial.face_impacts.iter().map(|i| i.peak_force.value));
    let contact = strongest(&mut flat.impacts.iter().map(|i| i.peak_force));
    close(face, contact, contact, 1e-7, "force");
}

/// Matrices over displacements of floors, assembled here by slope deflection: frames of columns and beams that may shorten,
/// condensed one by one, and added at their lines.
mod by_hand {
    use super::{Frame, PlanPoint};

    pub(super) type Dense = Vec<Vec<f64>>;

    fn zeros(n: usize) -> Dense {
        vec![vec![0.0; n]; n]
    }

    /// K of a frame over the sway of its floors, all other displacements condensed by elimination.
    pub(super) fn lateral(frame: &Frame, feet_turn: Option<f64>) -> Dense {
        let (n, lines) = (frame.storey_heights.len(), frame.spans.len() + 1);
        let stretches = frame.axial.columns_flexible;
        // Sway of the floors first, then rotations of feet and joints, then their vertical displacements.
        let turn = |line: usize, level: usize| n + level * lines + line;
        let rise = |line: usize, level: usize| n + (n + 1) * lines + level * lines + line;
        let order = n + 2 * (n + 1) * lines;
        let mut k = zeros(order);
        let mut add = |shares: &[(usize, f64)], value: f64| {
            for (i, a) in shares {
                for (j, b) in shares {
                    k[*i][*j] += value * a * b;
                }
            }
        };
        for storey in 0..n {
            let (ei, h) = (
                frame.columns[storey].flexural_rigidity,
                frame.storey_heights[storey],
            );
            for line in 0..lines {
                // Energy of a column: with chord rotation ψ, EI/h · (4 a² + 4 ab + 4 b²)/2, a = θ₀ − ψ, b = θ₁ − ψ.
                let chord = |sign: f64| {
                    let mut list = vec![(storey, -sign / h)];
                    if storey > 0 {
                        list.push((storey - 1, sign / h));
                    }
                    list
                };
                let [first, second] = [storey, storey + 1].map(|level| {
                    let mut list = vec![(turn(line, level), 1.0)];
                    // A column that leans to the right turns clockwise.
                    list.extend(chord(-1.0));
                    list
                });
                let sum: Vec<(usize, f64)> = first.iter().chain(&second).copied().collect();
                add(&first, 2.0 * ei / h);
                add(&second, 2.0 * ei / h);
                add(&sum, 2.0 * ei / h);
                if stretches {
                    let ea = frame.columns[storey].axial_rigidity.expect("given");
                    let ends = [(rise(line, storey + 1), 1.0), (rise(line, storey), -1.0)];
                    add(&ends, ea / h);
                }
            }
            let ei = frame.beams[storey].flexural_rigidity;
            for (bay, l) in frame.spans.iter().enumerate() {
                let level = storey + 1;
                let chord = [
                    (rise(bay + 1, level), -1.0 / l),
                    (rise(bay, level), 1.0 / l),
                ];
                let [first, second] = [bay, bay + 1].map(|line| {
                    let mut list = vec![(turn(line, level), 1.0)];
                    list.extend(chord);
                    list
                });
                let sum: Vec<(usize, f64)> = first.iter().chain(&second).copied().collect();
                add(&first, 2.0 * ei / l);
                add(&second, 2.0 * ei / l);
                add(&sum, 2.0 * ei / l);
            }
        }
        let mut held = vec![false; order];
        for line in 0..lines {
            match feet_turn {
                Some(spring) => k[turn(line, 0)][turn(line, 0)] += spring,
                None => held[turn(line, 0)] = true,
            }
            held[rise(line, 0)] = true;
            for level in 1..=n {
                held[rise(line, level)] |= !stretches;
            }
        }
        for pivot in (n..order).rev() {
            if held[pivot] {
                for row in &mut k {
                    row[pivot] = 0.0;
                }
                k[pivot].fill(0.0);
                continue;
            }
            for i in 0..pivot {
                let factor = k[i][pivot] / k[pivot][pivot];
                for j in 0..pivot {
                    k[i][j] -= factor * k[pivot][j];
                }
            }
        }
        k.truncate(n);
        for row in &mut k {
            row.truncate(n);
        }
        k
    }

    /// Adds a lateral matrix at a line through `at` with the direction `d`, over u_x, u_y, θ of every floor at `centres`.
    pub(super) fn add_at_line(
        sum: &mut Dense,
        lateral: &Dense,
        at: PlanPoint,
        d: PlanPoint,
        centres: &[PlanPoint],
    ) {
        let row = |floor: usize| {
            let [x, y] = centres[floor];
            [d[0], d[1], d[1] * (at[0] - x) - d[0] * (at[1] - y)]
        };
        for (i, values) in lateral.iter().enumerate() {
            for (j, value) in values.iter().enumerate() {
                for (a, of_a) in row(i).iter().enumerate() {
                    for (b, of_b) in row(j).iter().enumerate() {
                        sum[3 * i + a][3 * j + b] += value * of_a * of_b;
                    }
                }
            }
        }
    }
}

/// Five frames without symmetry, one of them askew and one lower than the building, beside a core of springs.
pub(super) fn without_symmetry(columns_flexible: bool) -> (Tiers, Vec<PlanFrame>) {
    let n = 3;
    let flexible = |mut frame: Frame| {
        frame.axial.columns_flexible = columns_flexible;
        massless(frame)
    };
    let mut tall = frame(n, &[5.0, 7.0]);
    tall.columns[0] = concrete(0.6, 0.7);
    let tall = flexible(tall);
    let mut low = frame(2, &[4.0]);
    low.beams[1] = concrete(0.25, 0.4);
    let low = flexible(low);
    let mut springy = standing("A", [-1.0, 0.5], 0.5 * PI, flexible(frame(n, &[6.0, 3.0])));
    springy.base.rotational_stiffness = Some(4e7);
    let frames = vec![
        standing("1", [0.0, 0.0], 0.0, tall.clone()),
        standing("2", [1.0, 8.0], 0.0, flexible(frame(n, &[3.0, 4.0, 3.0]))),
        springy,
        standing("B", [11.0, 1.0], 0.5 * PI, low),
        standing("askew", [2.0, 1.0], 0.6, tall),
    ];
    let plan = rectangle(-1.0, 0.0, 13.0, 10.0);
    let mut floors = vec![Tier::uniform(120e3, plan).expect("an area"); n];
    floors[1].centre = [4.5, 5.5];
    floors[2].mass = 70e3;
    floors[2].polar_mass *= 0.5;
    let core = TierStorey {
        stiffness: [3e7, 0.0, 2e8],
        centre: [3.0, 2.0],
    };
    let tiers = Tiers {
        floors,
        storeys: vec![core; n],
        storey_heights: vec![3.2; n],
        frames: frames.clone(),
        ..Tiers::default()
    };
    (tiers, frames)
}

/// K of the building without symmetry, by hand.
fn stiffness_by_hand(tiers: &Tiers) -> by_hand::Dense {
    let n = tiers.floors.len();
    let centres: Vec<PlanPoint> = tiers.floors.iter().map(|floor| floor.centre).collect();
    let mut sum = vec![vec![0.0; 3 * n]; 3 * n];
    for frame in &tiers.frames {
        let lateral = by_hand::lateral(&frame.frame, frame.base.rotational_stiffness);
        by_hand::add_at_line(&mut sum, &lateral, frame.at, frame.direction, &centres);
    }
    for (storey, springs) in tiers.storeys.iter().enumerate() {
        let shears: by_hand::Dense = (0..n)
            .map(|i| {
                let side = |j: usize| {
                    f64::from(i == storey && j == storey)
                        + f64::from(storey > 0 && i + 1 == storey && j + 1 == storey)
                        - f64::from(storey > 0 && i + 1 == storey && j == storey)
                        - f64::from(storey > 0 && i == storey && j + 1 == storey)
                };
                (0..n).map(side).collect()
            })
            .collect();
        for (axis, direction) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let mut shears = shears.clone();
            for value in shears.iter_mut().flatten() {
                *value *= springs.stiffness[axis];
            }
            by_hand::add_at_line(&mut sum, &shears, springs.centre, direction, &centres);
        }
        for (i, row) in shears.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                sum[3 * i + 2][3 * j + 2] += value * springs.stiffness[2];
            }
        }
    }
    sum
}

/// Where joints rise, so does the mass that they carry: K alone is compared, by what forces on the floors move.
fn flexibility_is_that_by_hand(tiers: Tiers, k: &by_hand::Dense) {
    let n = tiers.floors.len();
    let building = building("A", Structure::Tiers(tiers), FIVE_PERCENT);
    let system = assembled(&model(vec![building], vec![]));
    let building = &system.buildings[0];
    let dof = |at: usize| building.tracks[(at % 3) * n + at / 3].dof;
    for pushed in 0..3 * n {
        let mut load = vec![0.0; building.equations.len()];
        load[dof(pushed)] = 1e6;
        let moved =
            solve_once::<RiccatiSweep>(building, &StepMatrix::STATIC, &load).expect("it stands");
        for (at, row) in k.iter().enumerate() {
            let all = row.iter().enumerate();
            let resisted: f64 = all.map(|(other, k)| k * moved[dof(other)]).sum();
            let expected = if at == pushed { 1e6 } else { 0.0 };
            close(resisted, expected, 1e6, 1e-7, "K u = p");
        }
    }
}

/// All modes satisfy K φ = ω² M φ with matrices that the test assembles itself, and there are as many as displacements.
#[test]
fn modes_are_those_of_matrices_assembled_by_hand() {
    for columns_flexible in [false, true] {
        let (tiers, _) = without_symmetry(columns_flexible);
        let k = stiffness_by_hand(&tiers);
        let n = tiers.floors.len();
        if columns_flexible {
            flexibility_is_that_by_hand(tiers, &k);
            continue;
        }
        let mass: Vec<f64> = tiers
            .floors
            .iter()
            .flat_map(|floor| [floor.mass, floor.mass, floor.polar_mass])
            .collect();
        let building = building("A", Structure::Tiers(tiers), FIVE_PERCENT);
        let system = assembled(&model(vec![building], vec![]));
        let building = &system.buildings[0];
        assert_eq!(building.modes.len(), 3 * n);
        for mode in &building.modes {
            // Along, across and rotation of every floor.
            let shape: Vec<f64> = (0..3 * n)
                .map(|at| mode.shape[building.tracks[(at % 3) * n + at / 3].dof])
                .collect();
            let squared = mode.circular_frequency.powi(2);
            let inertia: Vec<f64> = mass
                .iter()
                .zip(&shape)
                .map(|(m, s)| squared * m * s)
                .collect();
            let norm: f64 = inertia.iter().zip(&shape).map(|(a, b)| a * b).sum();
            close(norm, squared, squared, 1e-10, "norm of a shape");
            let scale = inertia
                .iter()
                .zip(&mass)
                .fold(0.0, |most: f64, (f, m)| most.max((f / m.sqrt()).abs()));
            for (row, force) in k
                .iter()
                .zip(&inertia)
                .zip(&mass)
                .map(|((r, f), m)| ((r, m), f))
            {
                let (row, m) = row;
                let pushed: f64 = row.iter().zip(&shape).map(|(k, s)| k * s).sum();
                close(
                    pushed / m.sqrt(),
                    force / m.sqrt(),
                    scale,
                    1e-8,
                    "K φ = ω² M φ",
                );
            }
        }
    }
}

/// Forces of columns balance forces on the floors: shears in both directions and torque at every storey, and overturning moments
/// about the base by axial forces and moments of feet; columns that two frames share carry the sum of both.
#[test]
fn columns_carry_what_pushes_the_floors() {
    for columns_flexible in [false, true] {
        let (mut tiers, _) = without_symmetry(columns_flexible);
        tiers.storeys.clear();
        // Frame A crosses frame 1 at its first column line.
        tiers.frames[2].at = [0.0, 0.0];
        tiers.frames[0].lines = vec![Some("A1".to_owned()), None, None];
        tiers.frames[2].lines = vec![Some("A1".to_owned()), None, None];
        let n = tiers.floors.len();
        let building = building("A", Structure::Tiers(tiers.clone()), FIVE_PERCENT);
        let system = assembled(&model(vec![building], vec![]));
        let building = &system.buildings[0];
        let pushes = [[1e5, -4e4, 3e5], [-2e4, 7e4, -1e5], [5e4, 6e4, 2e5]];
        let mut load = vec![0.0; building.equations.len()];
        for (floor, push) in pushes.iter().enumerate() {
            for (direction, force) in push.iter().enumerate() {
                load[building.tracks[direction * n + floor].dof] = *force;
            }
        }
        let statics = StepMatrix::STATIC;
        let answer = solve_once::<RiccatiSweep>(building, &statics, &load).expect("it stands");
        let mut state = State::at_rest(&system, 0.0);
        state.displacement.copy_from_slice(&answer);
        let mut forces = vec![0.0; building.members.forms.len()];
        building.member_forces(&state, &[], 0.0, |form, value| forces[form] = value);
        let of = |member: &jostle::structure::MemberSections, section: usize, kind: usize| {
            forces[member.sections[section].forms[kind]]
        };
        for storey in 0..n {
            // Along x, across, and about the origin of the site.
            let mut sum = [0.0; 3];
            for member in &building.members.members {
                let MemberPlace::Column { storey: at, .. } = member.place else {
                    continue;
                };
                if at != storey + 1 {
                    continue;
                }
                let frame = &tiers.frames[member.frame.expect("in a plan")];
                let shear = of(member, 0, 1);
                let [dx, dy] = frame.direction;
                sum[0] += dx * shear;
                sum[1] += dy * shear;
                sum[2] += (frame.at[0] * dy - frame.at[1] * dx) * shear;
            }
            let mut expected = [0.0; 3];
            for (floor, push) in pushes.iter().enumerate().skip(storey) {
                let [x, y] = tiers.floors[floor].centre;
                expected[0] += push[0];
                expected[1] += push[1];
                expected[2] += push[2] + x * push[1] - y * push[0];
            }
            for (sum, expected) in sum.iter().zip(expected) {
                close(*sum, expected, 1e6, 1e-9, "storey");
            }
        }
        let mut moments = [0.0; 2];
        let mut shared = 0;
        for member in &building.members.members {
            let MemberPlace::Column { line, storey: 1 } = member.place else {
                continue;
            };
            assert_eq!(member.sections[0].at, SectionAt::First);
            let index = member.frame.expect("in a plan");
            let frame = &tiers.frames[index];
            let at = frame.line_at(line - 1);
            let (axial, moment) = (of(member, 0, 0), of(member, 0, 2));
            // The axial force of a shared column is that of both frames: it counts once.
            let counts = member.shared.is_none() || index == 0;
            shared += usize::from(member.shared.is_some());
            for axis in 0..2 {
                // Tension on the side from which the floors are pushed resists.
                moments[axis] -= moment * frame.direction[axis];
                if counts {
                    moments[axis] -= axial * at[axis];
                }
            }
        }
        assert_eq!(shared, 2);
        for axis in 0..2 {
            let pushed: f64 = pushes
                .iter()
                .enumerate()
                .map(|(floor, push)| 3.2 * (floor + 1) as f64 * push[axis])
                .sum();
            close(moments[axis], pushed, 1e6, 1e-9, "overturning moment");
        }
    }
}

/// Turned by a right angle with everything on it, a building has the same frequencies; along becomes across.
#[test]
fn a_turned_building_has_the_same_modes() {
    let (mut tiers, _) = without_symmetry(true);
    tiers.storeys.clear();
    // Masses between floors in all frames along the axes.
    for frame in &mut tiers.frames[..4] {
        frame
            .frame
            .columns
            .iter_mut()
            .for_each(|column| column.line_mass = 500.0);
        frame.frame.beam_mass.fill(2000.0);
        frame.frame.column_segments = 3;
    }
    let mut turned = tiers.clone();
    let turn = |[x, y]: PlanPoint| [-y, x];
    for floor in &mut turned.floors {
        floor.centre = turn(floor.centre);
        floor
            .plan
            .iter_mut()
            .for_each(|corner| *corner = turn(*corner));
    }
    for frame in &mut turned.frames {
        (frame.at, frame.direction) = (turn(frame.at), turn(frame.direction));
    }
    let modes = |tiers: Tiers| {
        let building = building("A", Structure::Tiers(tiers), ALL_MODES);
        let mut system = assembled(&model(vec![building], vec![]));
        system.buildings.remove(0)
    };
    let [one, other] = [modes(tiers), modes(turned)];
    let total = one.equations.total_mass();
    close(total, other.equations.total_mass(), total, 1e-12, "mass");
    for (a, b) in one.modes.iter().zip(&other.modes) {
        close(
            a.circular_frequency,
            b.circular_frequency,
            a.circular_frequency,
            1e-9,
            "ω",
        );
        close(
            a.effective_mass_ratio_x,
            b.effective_mass_ratio_across,
            1.0,
            1e-7,
            "along",
        );
        close(
            a.effective_mass_ratio_across,
            b.effective_mass_ratio_x,
            1.0,
            1e-7,
            "across",
        );
        close(
            a.effective_mass_ratio_torsion,
            b.effective_mass_ratio_torsion,
            1.0,
            1e-7,
            "torsion",
        );
    }
    let sums = one.modes.iter().fold([0.0; 3], |[x, y, t], mode| {
        [
            x + mode.effective_mass_ratio_x,
            y + mode.effective_mass_ratio_across,
            t + mode.effective_mass_ratio_torsion,
        ]
    });
    for sum in sums {
        close(sum, 1.0, 1.0, 1e-9, "effective masses of all modes");
    }
}
