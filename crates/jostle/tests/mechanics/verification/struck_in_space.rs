//! Slabs that strike columns of space frames between floors: plane frames as their limit, a frame of beam elements with twelve
//! displacements each that other code assembles and integrates, modes against direct steps, mirrored sites, energies.

use jostle::hysteresis::{Backbone, Corners, FallingBranch, Hysteresis, HysteresisRule};
use jostle::model::CapacityLine;
use jostle::{
    Analysis, Axial, Base, Building, ColumnFibres, ContactLaw, Damping, Diagonal, DiagonalKind,
    DiagonalPlace, FloorPairs, Frame, FrameHinges, Gap, Gravity, GridLine, GroundMotion, Hinges,
    Isolation, Isolator, IsolatorDamping, LawKind, Level, MemberRequest, Model, Outcome, PlanAxis,
    PlanPoint, Reach, RestitutionIs, Rise, Section, Shear, ShearEnds, ShearSpring, Solver,
    SpaceFrame, SpaceMember, SpacePlace, SpaceSection, Structure, StrutLine, Summary, System, Tier,
    TierStorey, Tiers,
};
use jostle_testkit::compare::{close, near};
use jostle_testkit::models::rectangle;
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

pub(super) const E: f64 = 30e9;
pub(super) const NU: f64 = 0.2;
const DENSITY: f64 = 2500.0;
pub(super) const GAP: f64 = 0.01;
const DAMPING: Damping = Damping::Rayleigh {
    alpha: 0.4,
    beta: 4e-4,
};
/// Storeys of the struck frame, and its bay along and across \[m\].
pub(super) const STOREYS: [f64; 2] = [4.0, 3.6];
pub(super) const BAY: [f64; 2] = [6.0, 5.0];
/// Mass of its floors \[kg\].
pub(super) const MASS: f64 = 60e3;

pub(super) fn law(kind: LawKind, stiffness: f64) -> ContactLaw {
    ContactLaw {
        kind,
        stiffness,
        restitution: 1.0,
        restitution_is: RestitutionIs::Input,
    }
}

pub(super) fn column_section([a, b]: [f64; 2], stretches: bool) -> SpaceSection {
    let section = SpaceSection::rectangle([a, b], E, NU, false).expect("a section");
    SpaceSection {
        line_mass: DENSITY * a * b,
        axial_rigidity: section.axial_rigidity.filter(|_| stretches),
        ..section
    }
}

pub(super) fn beam_section(size: [f64; 2]) -> SpaceSection {
    SpaceSection::beam(size, E, NU, false).expect("a section")
}

/// One bay by one bay.
pub(super) fn bay_by_bay(stretches: bool) -> SpaceFrame {
    let mut members = Vec::new();
    let mut add = |place: SpacePlace, section: SpaceSection| {
        members.push(SpaceMember::elastic(place, section));
    };
    for storey in 0..STOREYS.len() {
        for line in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            add(
                SpacePlace::Column { line, storey },
                column_section([0.5, 0.4], stretches),
            );
        }
        for line in [0, 1] {
            let (span, floor) = (0, storey);
            add(
                SpacePlace::BeamX { span, line, floor },
                beam_section([0.3, 0.6]),
            );
            add(
                SpacePlace::BeamY { line, span, floor },
                beam_section([0.25, 0.5]),
            );
        }
    }
    SpaceFrame {
        lines_x: vec![0.0, BAY[0]],
        lines_y: vec![0.0, BAY[1]],
        members,
        ..SpaceFrame::default()
    }
}

pub(super) fn building(name: &str, structure: Structure) -> Building {
    Building {
        name: name.to_owned(),
        structure,
        damping: DAMPING,
        ..Building::default()
    }
}

pub(super) fn framed(frame: SpaceFrame) -> Building {
    let plan = rectangle(0.0, 0.0, BAY[0], BAY[1]);
    let floor = Tier::uniform(MASS, plan).expect("an area");
    building(
        "A",
        Structure::Tiers(Tiers {
            floors: vec![floor; STOREYS.len()],
            storey_heights: STOREYS.to_vec(),
            space_frame: Some(frame),
            ..Tiers::default()
        }),
    )
}

/// Floors of a neighbour: masses, storey heights and stiffness.
const OTHER_MASS: f64 = 40e3;
const OTHER_STIFFNESS: f64 = 25e6;

/// A building of rigid floors beside the frame.
pub(super) fn beside(heights: &[f64], plan: Vec<PlanPoint>, centre: PlanPoint) -> Building {
    let floor = Tier::uniform(OTHER_MASS, plan).expect("an area");
    building(
        "B",
        Structure::Tiers(Tiers {
            floors: vec![floor; heights.len()],
            storeys: vec![
                TierStorey {
                    stiffness: [OTHER_STIFFNESS, OTHER_STIFFNESS, 8e8],
                    centre,
                };
                heights.len()
            ],
            storey_heights: heights.to_vec(),
            ..Tiers::default()
        }),
    )
}

pub(super) fn model(
    buildings: Vec<Building>,
    floors: FloorPairs,
    law: ContactLaw,
    solver: Solver,
) -> Model {
    Model {
        title: "struck".to_owned(),
        buildings,
        gaps: vec![Gap {
            floors,
            ..Gap::between([Some(0), Some(1)], GAP, law)
        }],
        analysis: Analysis {
            solver: Some(solver),
            tolerance: 1e-5,
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    }
}

pub(super) fn shaken(model: &Model, motion: &GroundMotion) -> (System, Outcome, Summary) {
    runs::run_and_summary(model, motion)
}

pub(super) fn shaking() -> GroundMotion {
    fading("two", 8.0, [4.0, 1.6], 250)
}

/// Heights of the floors of the neighbour, both between those of the frame.
pub(super) const SLABS: [f64; 2] = [2.7, 3.4];

pub(super) fn on_columns() -> FloorPairs {
    FloorPairs::Listed(vec![
        [Level::Height(SLABS[0]), Level::Floor(1)],
        [Level::Height(SLABS[0] + SLABS[1]), Level::Floor(2)],
    ])
}

/// The frame with all its members beside each other in one plane.
fn plane_limit() -> Frame {
    let doubled = |section: SpaceSection| Section {
        flexural_rigidity: 2.0 * section.flexural_rigidity[0],
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass: 2.0 * section.line_mass,
    };
    let column = doubled(column_section([0.5, 0.4], false));
    let halves = [STOREYS[0] + STOREYS[1], STOREYS[1]];
    Frame {
        storey_heights: STOREYS.to_vec(),
        spans: vec![BAY[0]],
        columns: vec![column; 2],
        beams: vec![doubled(beam_section([0.3, 0.6])); 2],
        beam_mass: vec![0.0; 2],
        // Columns come on top.
        floor_mass: halves.map(|half| MASS - column.line_mass * half).to_vec(),
        column_segments: 1,
        beam_segments: vec![1],
        axial: Axial {
            columns_flexible: false,
            beams_flexible: false,
        },
        ..Frame::default()
    }
}

/// Compares a frame that is struck on both columns of its face at once with a plane one of all its members beside each other.
fn compare_with_plane(space: Building, plane: Building, solver: Solver, tolerance: f64) {
    let motion = &shaking();
    let plan = rectangle(BAY[0] + GAP, 0.0, 8.0, BAY[1]);
    let centre = [BAY[0] + GAP + 4.0, 0.5 * BAY[1]];
    let other = Shear {
        mass: vec![OTHER_MASS; 2],
        stiffness: vec![OTHER_STIFFNESS; 2],
        storey_heights: SLABS.to_vec(),
    };
    let space = model(
        vec![space, beside(&SLABS, plan, centre)],
        on_columns(),
        law(LawKind::Hertz, 1e9),
        solver,
    );
    let plane = model(
        vec![plane, building("B", Structure::Shear(other))],
        on_columns(),
        law(LawKind::Hertz, 2e9),
        solver,
    );
    let (_, outcome, a) = shaken(&space, motion);
    let (_, _, b) = shaken(&plane, motion);
    assert!(
        b.gaps[0]
            .contacts
            .iter()
            .all(|contact| contact.impact_count > 0)
    );
    assert_eq!(a.gaps[0].contacts.len(), 4);
    for (index, contact) in a.gaps[0].contacts.iter().enumerate() {
        let what = format!("contact {index}, {solver:?}");
        let whole = &b.gaps[0].contacts[index / 2];
        assert_eq!(contact.floors, whole.floors, "{what}");
        near(
            2.0 * contact.peak_force_n,
            whole.peak_force_n,
            tolerance,
            &what,
        );
        near(
            contact.impulse_n_s * 2.0,
            whole.impulse_n_s,
            tolerance,
            &what,
        );
    }
    for (one, other) in a.buildings[0].floors.iter().zip(&b.buildings[0].floors) {
        near(
            one.response.displacement_max_m,
            other.response.displacement_max_m,
            tolerance,
            "floors",
        );
        near(
            one.response.displacement_min_m,
            other.response.displacement_min_m,
            tolerance,
            "floors",
        );
    }
    // Both storeys of the struck line; forces of each column are half of those of both.
    let mut compared = 0;
    for storey in 1..=2 {
        for y in 1..=2 {
            let find = |summary: &Summary, name: String| {
                let mut members = summary.buildings[0].members.clone().into_iter();
                members
                    .find(|member| member.name == name)
                    .expect("a column")
            };
            let own = find(&a, format!("A.column.2.{y}.{storey}"));
            let both = find(&b, format!("A.column.2.{storey}"));
            let (own, both) = (&own.struck[0], &both.struck[0]);
            assert_eq!(own.impact_count, both.impact_count);
            near(
                2.0 * own.peak_force_n,
                both.peak_force_n,
                tolerance,
                "force",
            );
            for (own, both) in [(&own.below, &both.below), (&own.above, &both.above)] {
                near(
                    2.0 * own.shear_peak_n,
                    both.shear_peak_n,
                    tolerance,
                    "shear",
                );
                near(
                    2.0 * own.moment_peak_n_m,
                    both.moment_peak_n_m,
                    tolerance,
                    "moment",
                );
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 8);
    let worst = outcome.energy.worst_imbalance;
    assert!(worst < 1e-6, "{worst:e} of the energy is missing");
}

#[test]
fn a_pair_of_columns_is_its_plane_limit() {
    for (solver, tolerance) in [(Solver::Riccati, 1e-7), (Solver::Modal, 1e-4)] {
        let plane = building("A", Structure::Frame(plane_limit()));
        compare_with_plane(framed(bay_by_bay(false)), plane, solver, tolerance);
    }
}

/// Hinges at the ends of struck columns, and where they are struck, yield as in one plane.
#[test]
fn struck_columns_yield_as_in_one_plane() {
    let hinge = |factor: f64| {
        let corners = Corners::bilinear(factor * 90e3, 0.05);
        let backbone = Backbone::from_forces(factor * 4e8, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
    };
    let mut frame = bay_by_bay(false);
    for member in &mut frame.members {
        if matches!(member.place, SpacePlace::Column { .. }) {
            member.hinges[0] = Some(hinge(1.0));
        }
    }
    let plane = Building {
        hinges: Some(Hinges::Frame(FrameHinges {
            columns: vec![vec![hinge(2.0); 2]; 2],
            ..FrameHinges::default()
        })),
        ..building("A", Structure::Frame(plane_limit()))
    };
    compare_with_plane(framed(frame), plane, Solver::Riccati, 1e-5);
}

const UNDER_WEIGHT: Gravity = Gravity {
    preload: true,
    p_delta: false,
};

/// The plane limit with columns that change their length, under its weight.
fn plane_under_weight() -> Frame {
    let axial = 2.0 * column_section([0.5, 0.4], true).axial_rigidity.expect("EA");
    let mut frame = plane_limit();
    for column in &mut frame.columns {
        column.axial_rigidity = Some(axial);
    }
    frame.axial.columns_flexible = true;
    frame
}

/// A frame whose columns are struck by slabs of a shear building.
fn struck_alone(own: Building) -> Model {
    let other = Shear {
        mass: vec![OTHER_MASS; 2],
        stiffness: vec![OTHER_STIFFNESS; 2],
        storey_heights: SLABS.to_vec(),
    };
    let other = building("B", Structure::Shear(other));
    let law = law(LawKind::Hertz, 2e9);
    model(vec![own, other], on_columns(), law, Solver::Riccati)
}

/// A surface whose moment does not depend on the axial force is a bilinear hinge, at the ends of struck columns and where they are struck.
#[test]
fn flat_surfaces_are_bilinear_hinges() {
    let (stiffness, strength, post_yield) = (8e8, 180e3, 0.05);
    let corners = Corners::bilinear(strength, post_yield);
    let backbone = Backbone::from_forces(stiffness, corners, corners).expect("sound");
    let hinge = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
    let flat = (1.0 - post_yield) * strength;
    let corners = [[-1e9, 0.0], [-5e8, flat], [5e8, flat], [1e9, 0.0]];
    let surface =
        ColumnFibres::on_surface(0.4, [true, true], [1e14, stiffness], &corners, post_yield)
            .expect("sound");
    let own = plane_under_weight();
    let places = own.all_columns().map(|(place, _)| place);
    let on_surface = FrameHinges {
        fibres: places.map(|place| (place, surface.clone())).collect(),
        ..FrameHinges::default()
    };
    let bilinear = FrameHinges {
        columns: vec![vec![hinge; 2]; 2],
        ..FrameHinges::default()
    };
    let [a, b] = [on_surface, bilinear].map(|hinges| {
        let model = struck_alone(Building {
            hinges: Some(Hinges::Frame(hinges)),
            gravity: UNDER_WEIGHT,
            ..building("A", Structure::Frame(own.clone()))
        });
        let (system, outcome, summary) = shaken(&model, &shaking());
        assert!(outcome.energy.worst_imbalance < 1e-6);
        let sections = &system.buildings[0].discretization.sections;
        let struck = sections.iter().filter(|section| section.point.is_some());
        assert!(
            struck
                .clone()
                .all(|own| own.to_string().ends_with(".struck1"))
        );
        assert!(sections.is_empty() || struck.count() > 0);
        summary
    });
    for (one, other) in a.gaps[0].contacts.iter().zip(&b.gaps[0].contacts) {
        near(one.peak_force_n, other.peak_force_n, 1e-3, "force");
        near(one.impulse_n_s, other.impulse_n_s, 1e-3, "impulse");
    }
    let dissipated = |summary: &Summary| summary.energy.hysteretic_j;
    near(dissipated(&a), dissipated(&b), 1e-3, "dissipated");
    assert!(dissipated(&b) > 1e3);
}

/// On bearings, mass-proportional damping acts on the motion of the points relative to the mat.
#[test]
fn struck_columns_on_a_mat_move_as_in_one_plane() {
    let isolated = |own: Building, mat_mass: f64| Building {
        base: Base {
            isolation: Some(Isolation {
                isolator: Isolator::Linear { stiffness: 12e6 },
                mat_mass,
                damping: IsolatorDamping::Coefficient(2e5),
                stops: [None; 2],
                limit: None,
                weight: Some(1.8e6),
                bounds: None,
            }),
            ..Base::default()
        },
        ..own
    };
    // In one plane the mat has the lower halves of the columns, or of their segments, on top.
    let halves = DENSITY * 0.5 * 0.4 * (STOREYS[0] + SLABS[0]);
    let space = isolated(framed(bay_by_bay(false)), 50e3);
    let plane = building("A", Structure::Frame(plane_limit()));
    compare_with_plane(space, isolated(plane, 50e3 - halves), Solver::Riccati, 1e-5);
}

/// Total mass is that of the floors, plus the lower half of what the ground carries of a struck column.
#[test]
fn points_take_their_mass_from_the_floors() {
    let plan = rectangle(BAY[0] + GAP, 0.0, 8.0, BAY[1]);
    let other = beside(&SLABS, plan, [BAY[0] + GAP + 4.0, 0.5 * BAY[1]]);
    let model = model(
        vec![framed(bay_by_bay(true)), other],
        on_columns(),
        law(LawKind::Hertz, 1e9),
        Solver::Riccati,
    );
    let system = runs::assembled(&model);
    let line_mass = DENSITY * 0.5 * 0.4;
    let from_ground = 2.0 * 0.5 * line_mass * (STOREYS[0] - SLABS[0]);
    let total = system.buildings[0].equations.total_mass();
    close(total, 2.0 * MASS + from_ground, MASS, 1e-14, "total mass");
}

pub(super) type Dense = Vec<Vec<f64>>;

/// A frame of beam elements with six displacements at each end: u along x, across and up, then rotations about the same axes.
pub(super) struct Beams {
    pub(super) stiffness: Dense,
}

impl Beams {
    pub(super) fn new(nodes: usize) -> Self {
        Self {
            stiffness: vec![vec![0.0; 6 * nodes]; 6 * nodes],
        }
    }

    pub(super) fn add(&mut self, dofs: &[usize], matrix: &[&[f64]]) {
        for (row, i) in matrix.iter().zip(dofs) {
            for (value, j) in row.iter().zip(dofs) {
                self.stiffness[*i][*j] += value;
            }
        }
    }

    /// A member along an axis: EA, GJ, and EI of the deflection towards each of the other axes.
    pub(super) fn member(
        &mut self,
        ends: [usize; 2],
        axis: usize,
        length: f64,
        rigidities: [f64; 4],
    ) {
        let [axial, torsion, first, second] = rigidities;
        let [a, b] = ends.map(|end| 6 * end);
        for (offset, rigidity) in [(0, axial), (3, torsion)] {
            let k = rigidity / length;
            let dofs = [a + offset + axis, b + offset + axis];
            self.add(&dofs, &[&[k, -k], &[-k, k]]);
        }
        let others = [(axis + 1) % 3, (axis + 2) % 3];
        // A turn about the last axis lifts what lies further along this one towards the next; about the next, it lowers it towards the last.
        for (towards, about, sign, rigidity) in [
            (others[0], others[1], 1.0, first),
            (others[1], others[0], -1.0, second),
        ] {
            let (k, l) = (rigidity / length.powi(3), length);
            let (c, s) = (6.0 * l * sign * k, 12.0 * k);
            let (near, far) = (4.0 * l * l * k, 2.0 * l * l * k);
            let dofs = [a + towards, a + 3 + about, b + towards, b + 3 + about];
            self.add(
                &dofs,
                &[
                    &[s, c, -s, c],
                    &[c, near, -c, far],
                    &[-s, -c, s, -c],
                    &[c, far, -c, near],
                ],
            );
        }
    }
}

/// Tᵀ K T.
pub(super) fn transformed(matrix: &Dense, by: &Dense) -> Dense {
    let n = by[0].len();
    let product: Dense = matrix
        .iter()
        .map(|row| {
            let mut sums = vec![0.0; n];
            for (value, shares) in row.iter().zip(by).filter(|(value, _)| **value != 0.0) {
                for (sum, share) in sums.iter_mut().zip(shares) {
                    *sum += value * share;
                }
            }
            sums
        })
        .collect();
    let mut result = vec![vec![0.0; n]; n];
    for (shares, row) in by.iter().zip(&product) {
        for (i, share) in shares
            .iter()
            .enumerate()
            .filter(|(_, share)| **share != 0.0)
        {
            for (to, value) in result[i].iter_mut().zip(row) {
                *to += share * value;
            }
        }
    }
    result
}

/// Displacements of a frame over those that have mass, with everything else following: K of these, and how all follow.
pub(super) fn condensed(matrix: &Dense, kept: usize) -> (Dense, Dense) {
    // Gauss–Jordan on what follows, with the sides of what is kept.
    let n = matrix.len();
    let mut rows: Dense = matrix[kept..]
        .iter()
        .map(|row| row[kept..].iter().chain(&row[..kept]).copied().collect())
        .collect();
    for pivot in 0..n - kept {
        let inverse = 1.0 / rows[pivot][pivot];
        rows[pivot].iter_mut().for_each(|value| *value *= inverse);
        let by = rows[pivot].clone();
        for (index, row) in rows.iter_mut().enumerate() {
            let factor = row[pivot];
            if index != pivot && factor != 0.0 {
                for (value, other) in row.iter_mut().zip(&by) {
                    *value -= factor * other;
                }
            }
        }
    }
    let follow: Dense = rows
        .iter()
        .map(|row| row[n - kept..].iter().map(|value| -value).collect())
        .collect();
    let mut all: Dense = (0..kept)
        .map(|i| (0..kept).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    all.extend(follow);
    let stiffness = transformed(matrix, &all);
    (stiffness, all)
}

/// The frame of one bay by one bay with a node on one column of its second line, so far above the ground in the first storey.
struct Struck {
    /// K over u_x, u_y, θ of both floors and u_x, u_y of the point.
    stiffness: Dense,
    mass: Vec<f64>,
    /// All displacements of all nodes over these.
    all: Dense,
}

/// Displacements with mass: three of each floor and two of the point.
const KEPT: usize = 8;

impl Struck {
    /// Node of a level from the ground up, at a crossing.
    fn node(level: usize, [x, y]: [usize; 2]) -> usize {
        4 * level + 2 * y + x
    }

    fn new(line: [usize; 2], above: f64) -> Self {
        let levels = STOREYS.len() + 1;
        let point = 4 * levels;
        let mut beams = Beams::new(point + 1);
        let column = column_section([0.5, 0.4], true);
        let axial = column.axial_rigidity.expect("it stretches");
        let [along, across] = column.flexural_rigidity;
        let of_column = [axial, column.torsional_rigidity, along, across];
        let corners = [[0, 0], [1, 0], [0, 1], [1, 1]];
        for (storey, height) in STOREYS.into_iter().enumerate() {
            for corner in corners {
                let ends = [Self::node(storey, corner), Self::node(storey + 1, corner)];
                if storey == 0 && corner == line {
                    beams.member([ends[0], point], 2, above, of_column);
                    beams.member([point, ends[1]], 2, height - above, of_column);
                } else {
                    beams.member(ends, 2, height, of_column);
                }
            }
            for side in [0, 1] {
                let floor = storey + 1;
                let of = |section: SpaceSection, order: [usize; 2]| {
                    let [vertical, sideways] = section.flexural_rigidity;
                    let bent = [vertical, sideways];
                    // Floors hold its length and its bending sideways.
                    [
                        1e9,
                        section.torsional_rigidity,
                        bent[order[0]],
                        bent[order[1]],
                    ]
                };
                let along = [[0, side], [1, side]].map(|at| Self::node(floor, at));
                beams.member(along, 0, BAY[0], of(beam_section([0.3, 0.6]), [1, 0]));
                let across = [[side, 0], [side, 1]].map(|at| Self::node(floor, at));
                beams.member(across, 1, BAY[1], of(beam_section([0.25, 0.5]), [0, 1]));
            }
        }
        // Floors, the point, then what follows: three of every joint, four of the point.
        let follows = 3 * 4 * STOREYS.len() + 4;
        let mut by = vec![vec![0.0; KEPT + follows]; 6 * (point + 1)];
        let mut next = KEPT;
        for floor in 0..STOREYS.len() {
            for [x, y] in corners {
                let node = 6 * Self::node(floor + 1, [x, y]);
                let arm = [(x as f64 - 0.5) * BAY[0], (y as f64 - 0.5) * BAY[1]];
                let turn = 3 * floor + 2;
                by[node][3 * floor] = 1.0;
                by[node][turn] = -arm[1];
                by[node + 1][3 * floor + 1] = 1.0;
                by[node + 1][turn] = arm[0];
                by[node + 5][turn] = 1.0;
                for component in [2, 3, 4] {
                    by[node + component][next] = 1.0;
                    next += 1;
                }
            }
        }
        for component in 0..6 {
            let place = if component < 2 {
                6 + component
            } else {
                next + component - 2
            };
            by[6 * point + component][place] = 1.0;
        }
        let (stiffness, follow) = condensed(&transformed(&beams.stiffness, &by), KEPT);
        let all = by
            .iter()
            .map(|row| {
                let sum = |k: usize| row.iter().zip(&follow).map(|(a, b)| a * b[k]).sum();
                (0..KEPT).map(sum).collect()
            })
            .collect();
        let line_mass = DENSITY * 0.5 * 0.4;
        let lower = MASS - 0.5 * line_mass * above;
        let gyration = (BAY[0] * BAY[0] + BAY[1] * BAY[1]) / 12.0;
        let own = 0.5 * line_mass * STOREYS[0];
        Self {
            stiffness,
            mass: vec![
                lower,
                lower,
                lower * gyration,
                MASS,
                MASS,
                MASS * gyration,
                own,
                own,
            ],
            all,
        }
    }
}

/// Greatest values of a run.
#[derive(Default)]
struct Greatest {
    force: f64,
    displacement: [f64; 2],
    rotation: f64,
    /// Shears of the column below and above the point, and its moment there.
    member: [f64; 3],
}

/// The frame against one floor on springs that strikes it at a point of the site, by the classical Runge–Kutta method.
fn integrated(
    frame: &Struck,
    above: f64,
    [lever, polar]: [f64; 2],
    motion: &GroundMotion,
    stiffness: f64,
) -> Greatest {
    let Damping::Rayleigh { alpha, beta } = DAMPING else {
        panic!("given coefficients")
    };
    let n = KEPT + 3;
    let mut k = vec![vec![0.0; n]; n];
    for (to, row) in k.iter_mut().zip(&frame.stiffness) {
        to[..KEPT].copy_from_slice(row);
    }
    for (index, value) in [OTHER_STIFFNESS, OTHER_STIFFNESS, 8e8]
        .into_iter()
        .enumerate()
    {
        k[KEPT + index][KEPT + index] = value;
    }
    let mut mass = frame.mass.clone();
    mass.extend([OTHER_MASS, OTHER_MASS, polar]);
    let driven = [0, 3, 6, KEPT];
    // What is struck less what strikes.
    let closing = |u: &[f64]| u[6] - (u[KEPT] - lever * u[KEPT + 2]) - GAP;
    let force_at = |u: &[f64]| stiffness * closing(u).max(0.0).powf(1.5);
    let rate = |t: f64, state: &[f64]| -> Vec<f64> {
        let (u, v) = state.split_at(n);
        let force = force_at(u);
        let ground = motion.acceleration(t);
        let mut rates = v.to_vec();
        for i in 0..n {
            let pull: f64 = (0..n).map(|j| k[i][j] * (u[j] + beta * v[j])).sum();
            let push = match i {
                6 => -force,
                KEPT => force,
                index if index == KEPT + 2 => -lever * force,
                _ => 0.0,
            };
            let shaken = if driven.contains(&i) { ground } else { 0.0 };
            rates.push((push - pull) / mass[i] - alpha * v[i] - shaken);
        }
        rates
    };
    let step = 4e-5;
    let steps = (motion.duration / step).round() as usize;
    let mut state = vec![0.0; 2 * n];
    let mut most = Greatest::default();
    let column = column_section([0.5, 0.4], true).flexural_rigidity[0];
    let nodes = [
        None,
        Some(4 * (STOREYS.len() + 1)),
        Some(Struck::node(1, [1, 1])),
    ];
    for index in 0..steps {
        let t = index as f64 * step;
        let moved = |by: f64, rates: &[f64]| -> Vec<f64> {
            state.iter().zip(rates).map(|(x, r)| x + by * r).collect()
        };
        let one = rate(t, &state);
        let two = rate(t + 0.5 * step, &moved(0.5 * step, &one));
        let three = rate(t + 0.5 * step, &moved(0.5 * step, &two));
        let four = rate(t + step, &moved(step, &three));
        for (i, x) in state.iter_mut().enumerate() {
            *x += step / 6.0 * (one[i] + 2.0 * two[i] + 2.0 * three[i] + four[i]);
        }
        let u = &state[..n];
        most.force = most.force.max(force_at(u));
        for floor in [0, 1] {
            most.displacement[floor] = most.displacement[floor].max(u[3 * floor].abs());
        }
        most.rotation = most.rotation.max(u[5].abs());
        // u along x and rotation about y of the ends of both parts.
        let ends = nodes.map(|node: Option<usize>| {
            let of = |component: usize| {
                node.map_or(0.0, |node| {
                    let row = &frame.all[6 * node + component];
                    row.iter().zip(u).map(|(share, value)| share * value).sum()
                })
            };
            [of(0), of(4)]
        });
        for (part, length) in [(0, above), (1, STOREYS[0] - above)] {
            let [[u0, r0], [u1, r1]] = [ends[part], ends[part + 1]];
            let chord = (u1 - u0) / length;
            let shear = 6.0 * column / length.powi(2) * (r0 + r1 - 2.0 * chord);
            most.member[part] = most.member[part].max(shear.abs());
            if part == 0 {
                let moment = column / length * (2.0 * r0 + 4.0 * r1 - 6.0 * chord);
                most.member[2] = most.member[2].max(moment.abs());
            }
        }
    }
    most
}

/// The common width holds one column of the face: floors turn, and the column bends by itself.
#[test]
fn one_struck_column_follows_its_beam_elements() {
    let above = 2.6;
    let motion = shaking();
    let stiffness = 5e8;
    // From 2 m to 9 m across.
    let plan = rectangle(BAY[0] + GAP, 2.0, 8.0, 7.0);
    let centre = [BAY[0] + GAP + 4.0, 5.5];
    let polar = OTHER_MASS * (8.0 * 8.0 + 7.0 * 7.0) / 12.0;
    let frame = Struck::new([1, 1], above);
    let wanted = integrated(&frame, above, [BAY[1] - 5.5, polar], &motion, stiffness);
    for solver in [Solver::Modal, Solver::Riccati] {
        let model = model(
            vec![
                framed(bay_by_bay(true)),
                beside(&[above], plan.clone(), centre),
            ],
            FloorPairs::Listed(vec![[Level::Height(above), Level::Floor(1)]]),
            law(LawKind::Hertz, stiffness),
            solver,
        );
        let (system, outcome, summary) = shaken(&model, &motion);
        assert_eq!(system.contacts.len(), 1);
        assert_eq!(summary.gaps[0].contacts[0].floors, [None, Some(1)]);
        assert!(summary.gaps[0].contacts[0].impact_count > 3);
        let worst = outcome.energy.worst_imbalance;
        assert!(
            worst < 1e-6,
            "{worst:e} of the energy is missing, {solver:?}"
        );
        let building = &summary.buildings[0];
        near(
            summary.gaps[0].contacts[0].peak_force_n,
            wanted.force,
            1e-4,
            "force",
        );
        for (floor, displacement) in building.floors.iter().zip(wanted.displacement) {
            let response = &floor.response;
            let peak = response
                .displacement_max_m
                .max(-response.displacement_min_m);
            near(peak, displacement, 1e-4, "displacement");
        }
        let roof = building.floors[1].in_plan.expect("in space");
        let turned = roof.rotation_max_rad.max(-roof.rotation_min_rad);
        near(turned, wanted.rotation, 1e-4, "rotation");
        let mut members = building.members.iter();
        let column = members.find(|member| member.name == "A.column.2.2.1");
        let struck = &column.expect("the struck column").struck;
        assert_eq!(struck.len(), 1);
        let point = &struck[0];
        close(point.height_m, above, 1.0, 1e-12, "height");
        let found = [
            point.below.shear_peak_n,
            point.above.shear_peak_n,
            point.below.moment_peak_n_m,
        ];
        for (kind, (found, wanted)) in found.into_iter().zip(wanted.member).enumerate() {
            near(
                found,
                wanted,
                2e-4,
                &format!("kind {kind} of the column, {solver:?}"),
            );
        }
        near(
            point.above.moment_peak_n_m,
            point.below.moment_peak_n_m,
            1e-9,
            "moments on both sides of the point",
        );
        // No other column is struck.
        let others = building
            .members
            .iter()
            .filter(|member| !member.struck.is_empty());
        assert_eq!(others.count(), 1);
    }
}

/// Seen from the other side of the row, or from across, the same happens.
#[test]
fn mirrored_sites_are_struck_alike() {
    let above = 2.6;
    let motion = shaking();
    let turned_round = fading("two", 8.0, [-4.0, 1.6], 250);
    let run = |mirrored: [bool; 2], motion: &GroundMotion| {
        let place = |[x, y]: PlanPoint, [a, b]: PlanPoint| {
            let x = if mirrored[0] { -x - a } else { x };
            let y = if mirrored[1] { -y - b } else { y };
            rectangle(x, y, a, b)
        };
        let mut frame = bay_by_bay(true);
        // An unsymmetric frame: one beam is missing.
        frame.members.retain(|member| {
            let [x, y] = mirrored.map(usize::from);
            member.place
                != SpacePlace::BeamX {
                    span: 0,
                    line: y,
                    floor: 1,
                }
                && member.place
                    != SpacePlace::BeamY {
                        line: x,
                        span: 0,
                        floor: 0,
                    }
        });
        frame.at = [
            if mirrored[0] { -BAY[0] } else { 0.0 },
            if mirrored[1] { -BAY[1] } else { 0.0 },
        ];
        let mut struck = framed(frame);
        if let Structure::Tiers(tiers) = &mut struck.structure {
            let plan = place([0.0, 0.0], BAY);
            let floor = Tier::uniform(MASS, plan).expect("an area");
            tiers.floors = vec![floor; STOREYS.len()];
        }
        let plan = place([BAY[0] + GAP, 2.0], [8.0, 7.0]);
        let [x, y] = [0, 1].map(|axis| 0.5 * (plan[0][axis] + plan[2][axis]));
        let model = model(
            vec![struck, beside(&[above], plan, [x, y])],
            FloorPairs::Listed(vec![[Level::Height(above), Level::Floor(1)]]),
            law(LawKind::HertzDamp, 5e8),
            Solver::Riccati,
        );
        let (system, outcome, summary) = shaken(&model, motion);
        let normal = if mirrored[0] { -1.0 } else { 1.0 };
        let place = system.contacts[0].plan.expect("in plan");
        assert_eq!(place.normal, [normal, 0.0]);
        assert!(outcome.energy.worst_imbalance < 1e-6);
        let contact = &summary.gaps[0].contacts[0];
        let mut members = summary.buildings[0].members.iter();
        let member = members.find(|member| !member.struck.is_empty());
        let point = &member.expect("a struck column").struck[0];
        assert!(contact.impact_count > 2);
        [
            contact.peak_force_n,
            contact.impulse_n_s,
            point.below.shear_peak_n,
            point.above.moment_peak_n_m,
            point.below.axial_max_n,
        ]
    };
    let seen = run([false, false], &motion);
    for (mirrored, motion) in [
        ([true, false], &turned_round),
        ([false, true], &motion),
        ([true, true], &turned_round),
    ] {
        for (one, other) in seen.iter().zip(run(mirrored, motion)) {
            near(other, *one, 1e-7, &format!("mirrored {mirrored:?}"));
        }
    }
}

/// Two space frames with floors at other heights strike each other's columns, whatever solver moves them.
#[test]
fn frames_strike_the_columns_of_each_other() {
    let motion = shaking();
    let run = |solver| {
        let mut other = framed(bay_by_bay(true));
        other.name = "B".to_owned();
        if let Structure::Tiers(tiers) = &mut other.structure {
            tiers.move_by([BAY[0] + GAP, 1.0]);
            tiers.storey_heights = vec![3.1, 3.2];
            for floor in &mut tiers.floors {
                floor.mass *= 0.7;
                floor.polar_mass *= 0.7;
            }
        }
        let buildings = vec![framed(bay_by_bay(true)), other];
        let both = model(
            buildings,
            FloorPairs::All,
            law(LawKind::HertzDamp, 5e8),
            solver,
        );
        shaken(&both, &motion)
    };
    let (system, _, by_modes) = run(Solver::Modal);
    let (_, outcome, direct) = run(Solver::Riccati);
    assert!(outcome.energy.worst_imbalance < 1e-6);
    // The common width holds one line of columns of each; the roof of the first stands above the second.
    let floors: Vec<_> = by_modes.gaps[0].contacts.iter().map(|c| c.floors).collect();
    assert_eq!(floors, [[None, Some(1)], [Some(1), None], [None, Some(2)]]);
    assert_eq!(system.buildings[1].name, "B");
    for (one, other) in by_modes.gaps[0]
        .contacts
        .iter()
        .zip(&direct.gaps[0].contacts)
    {
        assert_eq!(one.impact_count, other.impact_count);
        near(one.peak_force_n, other.peak_force_n, 1e-3, "force");
    }
    assert!(
        by_modes.gaps[0]
            .contacts
            .iter()
            .filter(|c| c.impact_count > 0)
            .count()
            > 1
    );
    for (one, other) in by_modes.buildings.iter().zip(&direct.buildings) {
        for (one, other) in one.members.iter().zip(&other.members) {
            for (one, other) in one.struck.iter().zip(&other.struck) {
                near(
                    one.below.shear_peak_n,
                    other.below.shear_peak_n,
                    1e-3,
                    "shear",
                );
                near(
                    one.above.moment_peak_n_m,
                    other.above.moment_peak_n_m,
                    1e-3,
                    "moment",
                );
            }
        }
    }
}

/// Floors at equal height touch along faces of several points; the columns that are struck besides have their own impacts.
#[test]
fn impacts_on_columns_beside_faces_are_their_own() {
    let mut other = framed(bay_by_bay(true));
    other.name = "B".to_owned();
    if let Structure::Tiers(tiers) = &mut other.structure {
        tiers.move_by([BAY[0] + GAP, 1.0]);
        tiers.storey_heights = vec![STOREYS[0], 2.4];
    }
    let law = law(LawKind::HertzDamp, 5e8);
    let buildings = vec![framed(bay_by_bay(true)), other];
    let model = model(buildings, FloorPairs::All, law, Solver::Riccati);
    let (_, _, summary) = shaken(&model, &shaking());
    let contacts = &summary.gaps[0].contacts;
    assert_eq!(contacts[0].floors, [Some(1), Some(1)]);
    let struck = contacts
        .iter()
        .filter(|contact| contact.struck_column.is_some());
    let mut compared = 0;
    for contact in struck {
        let side = contact
            .floors
            .iter()
            .position(Option::is_none)
            .expect("a column");
        let building = &summary.buildings[side];
        let line = contact.struck_column.as_deref().expect("a line");
        let column = format!("{}.column.{line}.", building.name);
        let own = building
            .members
            .iter()
            .filter(|member| member.name.starts_with(&column));
        let mut points = own.flat_map(|member| &member.struck);
        let point = points.find(|point| (point.height_m - contact.height_m).abs() < 1e-9);
        let point = point.expect("a struck point");
        assert_eq!(point.impact_count, contact.impact_count);
        assert_eq!(point.peak_force_n, contact.peak_force_n);
        compared += contact.impact_count;
    }
    assert!(compared > 0);
}

/// Faults of the gaps of a model.
pub(super) fn faults(buildings: Vec<Building>, floors: FloorPairs) -> String {
    let model = model(buildings, floors, law(LawKind::Hertz, 5e8), Solver::Modal);
    let faults = System::assemble(&model).expect_err("a fault");
    let all = faults
        .iter()
        .map(|fault| format!("{}: {}", fault.path, fault.problem));
    all.collect::<Vec<_>>().join("\n")
}

/// Columns that fail in shear below and above the point where they are struck bear no more there than their strength.
#[test]
fn struck_columns_fail_on_either_side() {
    let mut frame = bay_by_bay(false);
    let strength = 1.2e5;
    let columns = frame
        .members
        .iter()
        .filter_map(|member| match member.place {
            SpacePlace::Column { storey, .. } => {
                let height: f64 = STOREYS[storey];
                let stiffness = 12.0 * member.section.flexural_rigidity[0] / height.powi(3);
                let falling = FallingBranch {
                    slope: 0.05 * stiffness,
                    residual: 0.5 * strength,
                };
                let spring = ShearSpring {
                    spring: Hysteresis::failing(1e4 * stiffness, strength, falling).expect("sound"),
                    ends: ShearEnds::Both,
                    by_ductility: CapacityLine::default(),
                };
                // Only the second line is struck.
                let is_struck = member.place.crossings()[0][0] == 1;
                is_struck.then_some(((member.place, PlanAxis::X), spring))
            }
            _ => None,
        });
    frame.shear = columns.collect();
    let plan = rectangle(BAY[0] + GAP, 0.0, 8.0, BAY[1]);
    let centre = [BAY[0] + GAP + 4.0, 0.5 * BAY[1]];
    let other = beside(&SLABS, plan, centre);
    let model = model(
        vec![framed(frame), other],
        on_columns(),
        law(LawKind::Hertz, 1e9),
        Solver::Riccati,
    );
    let (_, outcome, summary) = shaken(&model, &shaking());
    let worst = outcome.energy.worst_imbalance;
    assert!(worst < 1e-6, "{worst:e} of the energy is missing");
    let own = &summary.buildings[0];
    let failures = own.shear_failures.as_ref().expect("they can fail");
    let at = |end: &str| failures.list.iter().any(|failure| failure.at == end);
    assert!(
        failures.total == 4 && at("foot") && at("head"),
        "{failures:?}"
    );
    let mut compared = 0;
    for member in own
        .members
        .iter()
        .filter(|member| !member.struck.is_empty())
    {
        for end in &member.ends {
            assert!(
                end.shear_peak_n < 1.000_1 * strength,
                "{}: {}",
                member.name,
                end.shear_peak_n
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 8);
}

/// Slabs of a narrower frame lie before the bay of a wider one: they meet no column of it, while its own slabs strike theirs. Where the
/// plan reaches beyond the columns by more than the reach, these stand too far behind.
#[test]
fn slabs_that_meet_no_column_are_listed() {
    let narrow = |y: f64| {
        let mut frame = bay_by_bay(true);
        frame.lines_y = vec![0.0, 3.0];
        frame.at = [BAY[0] + GAP, y];
        let mut narrow = framed(frame);
        narrow.name = "B".to_owned();
        let Structure::Tiers(tiers) = &mut narrow.structure else {
            panic!("in plan");
        };
        tiers.storey_heights = vec![2.7, 3.4];
        for floor in &mut tiers.floors {
            let plan = rectangle(BAY[0] + GAP, y, BAY[0], 3.0);
            *floor = Tier::uniform(MASS, plan).expect("an area");
        }
        narrow
    };
    let unmet = |wide: Building, y: f64| {
        let buildings = vec![wide, narrow(y)];
        let model = model(
            buildings,
            FloorPairs::All,
            law(LawKind::Hertz, 5e8),
            Solver::Modal,
        );
        assert_eq!(System::assemble(&model).err(), None);
        model.unmet_columns()
    };
    let found = unmet(framed(bay_by_bay(true)), 1.0);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(
        (found[0].gap, found[0].between, found[0].behind),
        (0, [1, 0], false)
    );
    assert_eq!(found[0].floors, [1, 2]);
    close(found[0].heights[1], 6.1, 1.0, 1e-12, "height");
    assert_eq!(unmet(framed(bay_by_bay(true)), 3.0), []);
    let mut deep = bay_by_bay(true);
    deep.lines_x = vec![0.0, BAY[0] - 0.8];
    let found = unmet(framed(deep), 3.0);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].behind && found[0].between == [1, 0]);
}

#[test]
fn what_cannot_be_struck_is_told() {
    let beside_frame = |y: f64| {
        let plan = rectangle(BAY[0] + GAP, y, 8.0, 3.0);
        beside(&[2.6], plan, [BAY[0] + 4.0, y + 1.5])
    };
    let at = |height: f64| FloorPairs::Listed(vec![[Level::Height(height), Level::Floor(1)]]);
    let none = faults(vec![framed(bay_by_bay(true)), beside_frame(1.0)], at(2.6));
    assert!(
        none.contains(
            "gap[0].floors[0]: lies between floors, where no column stands within reach = 0.5 m and the common width"
        ),
        "{none}"
    );
    let rigid = |building: &mut Building| {
        if let Structure::Tiers(tiers) = &mut building.structure
            && let Some(frame) = &mut tiers.space_frame
        {
            frame.rigid_zones.insert([0, 1, 1], [0.0, 0.0, 1.5]);
        }
    };
    let mut stiff = framed(bay_by_bay(true));
    rigid(&mut stiff);
    let told = faults(vec![stiff, beside_frame(3.0)], at(2.6));
    assert!(
        told.contains("the end of the column is rigid there"),
        "{told}"
    );
    let mut light = framed(bay_by_bay(true));
    if let Structure::Tiers(tiers) = &mut light.structure {
        tiers.floors[0].mass = 3e3;
        tiers.floors[0].polar_mass = 1e4;
    }
    let told = faults(vec![light, beside_frame(3.0)], at(2.6));
    assert!(told.contains("give mass with all columns"), "{told}");
    let mut weightless = bay_by_bay(true);
    for member in &mut weightless.members {
        member.section.line_mass = 0.0;
    }
    let told = faults(vec![framed(weightless), beside_frame(3.0)], at(2.6));
    assert!(told.contains("has no mass where it would be hit"), "{told}");
    // Buildings of storeys have no columns.
    let storeys = beside(&[4.0], rectangle(0.0, 0.0, 6.0, 5.0), [3.0, 2.5]);
    let told = faults(vec![storeys, beside_frame(3.0)], FloorPairs::All);
    assert!(
        told.contains("only frames have columns that can be hit"),
        "{told}"
    );
}

/// Struts off the joints of both frames of one bay are those of a plane frame with all its members beside each other.
#[test]
fn struts_off_the_joints_are_those_of_the_plane_limit() {
    let motion = shaking();
    let strut = |line: Option<usize>, rise: Rise, offsets: [f64; 2]| Diagonal {
        place: DiagonalPlace {
            kind: DiagonalKind::Infill,
            line: line.map(|number| GridLine {
                along: PlanAxis::X,
                number,
            }),
            storey: 2,
            bay: 1,
            rise,
            reach: Reach::BAY,
            strut: StrutLine::Central,
        },
        stiffness: if line.is_some() { 4e7 } else { 8e7 },
        hysteresis: None,
        offsets,
        across: None,
        damage: None,
    };
    let offsets = [(Rise::Right, [0.5, 0.7]), (Rise::Left, [0.0, 0.4])];
    let mut space = bay_by_bay(false);
    for line in [1, 2] {
        let all = offsets.map(|(rise, offsets)| strut(Some(line), rise, offsets));
        space.diagonals.extend(all);
    }
    let all = offsets.map(|(rise, offsets)| strut(None, rise, offsets));
    let plane = Frame {
        diagonals: all.to_vec(),
        ..plane_limit()
    };
    let alone = |building: Building| {
        let model = Model {
            title: "struts".to_owned(),
            buildings: vec![building],
            analysis: Analysis {
                solver: Some(Solver::Riccati),
                tolerance: 1e-5,
                members: MemberRequest::all(),
                ..Analysis::default()
            },
            ..Model::default()
        };
        shaken(&model, &motion).2
    };
    let a = alone(framed(space));
    let b = alone(building("A", Structure::Frame(plane)));
    let mut compared = 0;
    for storey in 1..=2 {
        for line in 1..=2 {
            let find = |summary: &Summary, name: String| {
                let mut members = summary.buildings[0].members.clone().into_iter();
                members
                    .find(|member| member.name == name)
                    .expect("a column")
            };
            let own = find(&a, format!("A.column.{line}.1.{storey}"));
            let both = find(&b, format!("A.column.{line}.{storey}"));
            for (own, both) in own.ends.iter().zip(&both.ends) {
                let what = format!("column {line} of storey {storey}");
                near(2.0 * own.shear_peak_n, both.shear_peak_n, 1e-9, &what);
                near(2.0 * own.moment_peak_n_m, both.moment_peak_n_m, 1e-9, &what);
                near(2.0 * own.axial_max_n, both.axial_max_n, 1e-9, &what);
                near(2.0 * own.axial_min_n, both.axial_min_n, 1e-9, &what);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 8);
    for (index, part) in a.buildings[0].parts.iter().enumerate() {
        let both = &b.buildings[0].parts[index % 2];
        near(2.0 * part.force_max_n, both.force_max_n, 1e-9, "tension");
        near(
            2.0 * part.force_min_n,
            both.force_min_n,
            1e-9,
            "compression",
        );
    }
    assert_eq!(a.buildings[0].parts.len(), 4);
}
