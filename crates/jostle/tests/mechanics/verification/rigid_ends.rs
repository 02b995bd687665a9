//! Members that are rigid inside their joints: closed forms, and the same frame with short stiff members.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::linear::StepMatrix;
use jostle::statics::STANDARD_GRAVITY;
use jostle::stiffness::DirectStiffness;
use jostle::structure::{MemberPlace, solve_once};
use jostle::{
    Axial, Damping, FloorPairs, Frame, FrameHinges, Gap, Gravity, Hinges, Level, MemberRequest,
    Model, RiccatiSweep, Section, State, Structure, System,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{CONCRETE_REALISED, bending, building};
use jostle_testkit::motions::fading;

use crate::verification::support::{assembled, moving, run, steps};

fn alone(frame: Frame) -> Model {
    let mut model = Model {
        title: "rigid ends".to_owned(),
        buildings: vec![building("A", Structure::Frame(frame))],
        ..Model::default()
    };
    model.buildings[0].damping = Damping::Rayleigh {
        alpha: 0.3,
        beta: 1e-4,
    };
    model.analysis.members = MemberRequest::all();
    model
}

/// Height, span, EI of columns and beam, and the rigid ends a of the beam and b of the columns.
const PORTAL: [f64; 6] = [3.6, 6.4, 6e7, 9e7, 0.3, 0.35];

fn portal() -> Frame {
    let [height, span, column, beam, a, b] = PORTAL;
    let mut frame = Frame {
        storey_heights: vec![height],
        spans: vec![span],
        columns: vec![bending(column)],
        beams: vec![bending(beam)],
        beam_mass: vec![0.0],
        floor_mass: vec![8e4],
        column_segments: 1,
        beam_segments: vec![1],
        ..Frame::default()
    };
    for line in 0..2 {
        frame.rigid_zones.insert([0, line], [a, b]);
    }
    frame
}

/// Stiffness of that portal against sway, if its columns have no weight, by virtual displacements u of the floor and θ of both joints.
/// Twice its energy is 2 (EI/h³) (12 v² + 12 h v θ + 4 h² θ²) of columns whose clear height h has the head v = u + b θ; 12 (EI/l) (θ L/l)² of the
/// beam of clear span l; and, as each weight P sinks by v²/2h + b θ²/2, −2 P (v²/h + b θ²).
fn stiffness_of_portal(weight: f64, hinge: Option<f64>) -> f64 {
    let [height, span, column, beam, a, b] = PORTAL;
    let (h, l) = (height - b, span - 2.0 * a);
    let c = column / (h * h * h);
    let uu = 24.0 * c - 2.0 * weight / h;
    let ut = 2.0 * (12.0 * c * b + 6.0 * c * h) - 2.0 * weight * b / h;
    // A hinge at either end of the beam is in series with 6 EI/l.
    let end = 6.0 * beam / l;
    let end = hinge.map_or(end, |hinge| hinge * end / (hinge + end));
    let tt = 2.0 * c * (12.0 * b * b + 12.0 * h * b + 4.0 * h * h)
        + 2.0 * end * (span / l) * (span / l)
        - 2.0 * weight * (b * b / h + b);
    uu - ut * ut / tt
}

/// How far the floor sways under a unit force there.
fn sway(model: &Model) -> f64 {
    let system = assembled(model);
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    load[building.floors[0].dof] = 1.0;
    let solved = [
        solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load),
        solve_once::<DirectStiffness>(&building.structure, &StepMatrix::STATIC, &load),
    ];
    let [one, other] = solved.map(|moved| moved.expect("it stands")[building.floors[0].dof]);
    close(one, other, one, 1e-11, "two solvers");
    one
}

#[test]
fn a_portal_sways_as_by_slope_deflection() {
    let mut model = alone(portal());
    close(
        sway(&model) * stiffness_of_portal(0.0, None),
        1.0,
        1.0,
        1e-12,
        "sway",
    );
    // Half of the floor on either column.
    model.buildings[0].gravity = Gravity {
        preload: false,
        p_delta: true,
    };
    let weight = 4e4 * STANDARD_GRAVITY;
    let leaning = stiffness_of_portal(weight, None);
    assert!(leaning < 0.995 * stiffness_of_portal(0.0, None));
    close(sway(&model) * leaning, 1.0, 1.0, 1e-12, "sway with P-Delta");
}

#[test]
fn semi_rigid_connections_are_at_the_faces() {
    let mut model = alone(portal());
    let stiffness = 3e7;
    if let Structure::Frame(frame) = &mut model.buildings[0].structure {
        frame.joint.rotational_stiffness = Some(stiffness);
    }
    let expected = stiffness_of_portal(0.0, Some(stiffness));
    close(sway(&model) * expected, 1.0, 1.0, 1e-12, "sway");
    // A connection that can yield is the same until it does.
    let corners = Corners::bilinear(1e5, 0.02);
    let backbone = Backbone::from_forces(stiffness, corners, corners).expect("sound");
    let hinge = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
    let mut yields = alone(portal());
    yields.buildings[0].hinges = Some(Hinges::Frame(FrameHinges {
        beams: vec![vec![hinge]],
        ..FrameHinges::default()
    }));
    let initial = assembled(&yields);
    let period = |system: &System| {
        let mut modes = system.buildings[0].lateral_modes();
        modes.next().expect("a mode").period()
    };
    let expected = 2.0 * std::f64::consts::PI * libm::sqrt(8e4 / expected);
    close(period(&initial), expected, expected, 1e-9, "period");
    close(
        period(&assembled(&model)),
        expected,
        expected,
        1e-9,
        "period",
    );
}

/// A frame of members between nodes with three displacements each, solved by elimination: an own way to the same answer.
#[derive(Default)]
struct Plane {
    nodes: Vec<[f64; 2]>,
}

/// A member: nodes, EI, EA.
type Beam = ([usize; 2], f64, f64);

impl Plane {
    fn node(&mut self, at: [f64; 2]) -> usize {
        self.nodes.push(at);
        self.nodes.len() - 1
    }

    /// Stiffness over (u, v, θ) of both ends, by six unit displacements: bending k (4θ₁ + 2θ₂ − 6ψ), ψ the turn of the chord.
    fn forces(&self, ([a, b], ei, ea): Beam, moved: &[f64; 6]) -> [f64; 6] {
        let [dx, dy] = [0, 1].map(|axis| self.nodes[b][axis] - self.nodes[a][axis]);
        let length = libm::hypot(dx, dy);
        let (c, s) = (dx / length, dy / length);
        let along = |u: f64, v: f64| c * u + s * v;
        let across = |u: f64, v: f64| c * v - s * u;
        let stretched = along(moved[3], moved[4]) - along(moved[0], moved[1]);
        let chord = (across(moved[3], moved[4]) - across(moved[0], moved[1])) / length;
        let end = |value: f64, other: f64| ei / length * (4.0 * value + 2.0 * other - 6.0 * chord);
        let [first, last] = [end(moved[2], moved[5]), end(moved[5], moved[2])];
        let (axial, shear) = (ea / length * stretched, (first + last) / length);
        [
            -c * axial - s * shear,
            -s * axial + c * shear,
            first,
            c * axial + s * shear,
            s * axial - c * shear,
            last,
        ]
    }

    fn solve(&self, beams: &[Beam], held: usize, loads: &[(usize, f64)]) -> Vec<f64> {
        let n = 3 * self.nodes.len();
        let mut rows = vec![vec![0.0; n + 1]; n];
        for beam in beams {
            let dofs: Vec<usize> = beam
                .0
                .iter()
                .flat_map(|node| 3 * node..3 * node + 3)
                .collect();
            for (column, dof) in dofs.iter().enumerate() {
                let mut unit = [0.0; 6];
                unit[column] = 1.0;
                for (row, force) in dofs.iter().zip(self.forces(*beam, &unit)) {
                    rows[*row][*dof] += force;
                }
            }
        }
        for (dof, load) in loads {
            rows[*dof][n] += load;
        }
        // The first nodes stand on the ground.
        for dof in 0..3 * held {
            rows[dof].fill(0.0);
            rows[dof][dof] = 1.0;
        }
        for pivot in 0..n {
            let best =
                (pivot..n).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()));
            rows.swap(pivot, best.expect("a row"));
            let pivot_row = rows[pivot].clone();
            for row in rows.iter_mut().skip(pivot + 1) {
                let factor = row[pivot] / pivot_row[pivot];
                row.iter_mut()
                    .zip(&pivot_row)
                    .for_each(|(to, of)| *to -= factor * of);
            }
        }
        let mut moved = vec![0.0; n];
        for row in (0..n).rev() {
            let known: f64 = (row + 1..n).map(|at| rows[row][at] * moved[at]).sum();
            moved[row] = (rows[row][n] - known) / rows[row][row];
        }
        moved
    }
}

/// Two storeys and two bays of which the second has one floor, with joints of several sizes.
fn uneven() -> Frame {
    let section = |flexural_rigidity: f64| Section {
        axial_rigidity: Some(3e9),
        ..bending(flexural_rigidity)
    };
    let mut frame = Frame {
        storey_heights: vec![4.0, 3.2],
        spans: vec![5.0, 6.5],
        columns: vec![section(9e7), section(6e7)],
        beams: vec![section(1.2e8), section(8e7)],
        beam_mass: vec![3000.0; 2],
        floor_mass: vec![2e4; 2],
        column_segments: 1,
        beam_segments: vec![1; 2],
        axial: Axial {
            columns_flexible: true,
            beams_flexible: true,
        },
        ..Frame::default()
    };
    frame.own_columns.insert([1, 2], None);
    frame.own_beams.insert([1, 1], None);
    for (place, zone) in [
        ([0, 0], [0.25, 0.3]),
        ([0, 1], [0.35, 0.4]),
        ([0, 2], [0.2, 0.0]),
        ([1, 0], [0.0, 0.3]),
        ([1, 1], [0.25, 0.3]),
    ] {
        frame.rigid_zones.insert(place, zone);
    }
    frame
}

/// Three storeys and three bays: a column that starts on a beam of the first floor, and beams at the roof that meet without a column.
fn over_beams() -> Frame {
    let mut frame = uneven();
    frame.storey_heights.push(3.0);
    frame.spans = vec![5.0, 4.0, 6.5];
    for rows in [&mut frame.columns, &mut frame.beams] {
        rows.push(rows[1]);
    }
    frame.beam_mass.push(3000.0);
    frame.floor_mass.push(2e4);
    frame.beam_segments.push(1);
    frame.own_columns = [([0, 1], None), ([2, 2], None)].into();
    frame.own_beams.clear();
    frame.rigid_zones.clear();
    frame
}

/// A frame, all its members, those with names, and joints as floor, line and node.
type Explicit = (Plane, Vec<Beam>, Vec<(MemberPlace, Beam)>, Vec<[usize; 3]>);

/// The same with members that are a million times as stiff inside joints; also joints by floor and line, and the members by name.
fn explicit(frame: &Frame) -> Explicit {
    const STIFF: f64 = 1e6;
    let mut plane = Plane::default();
    let lines = frame.line_positions();
    let feet = lines.iter().map(|x| Some(plane.node([*x, 0.0])));
    let mut joints: Vec<Vec<Option<usize>>> = vec![feet.collect()];
    let mut height = 0.0;
    for (floor, storey) in frame.storey_heights.iter().enumerate() {
        height += storey;
        let joint = |line: usize| {
            let exists = frame.has_joint(floor + 1, line);
            exists.then(|| plane.node([lines[line], height]))
        };
        joints.push((0..lines.len()).map(joint).collect());
    }
    let node = |floor: usize, line: usize| joints[floor][line].expect("a joint");
    let zone = |place| frame.rigid_zones.get(&place).copied().unwrap_or_default();
    let (mut all, mut named) = (Vec::new(), Vec::new());
    let mut add =
        |plane: &mut Plane, place, ends: [usize; 2], arms: [[f64; 2]; 2], section: &Section| {
            let ea = section.axial_rigidity.expect("EA");
            let faces = [0, 1].map(|side| {
                let ([dx, dy], [x, y]) = (arms[side], plane.nodes[ends[side]]);
                if dx == 0.0 && dy == 0.0 {
                    return ends[side];
                }
                let face = plane.node([x + dx, y + dy]);
                all.push((
                    [ends[side], face],
                    STIFF * section.flexural_rigidity,
                    STIFF * ea,
                ));
                face
            });
            all.push((faces, section.flexural_rigidity, ea));
            named.push((place, (faces, section.flexural_rigidity, ea)));
        };
    for ([storey, line], section) in frame.all_columns() {
        let foot = match storey {
            0 => 0.0,
            _ => zone([storey - 1, line])[1],
        };
        let head = zone([storey, line])[1];
        let ends = [node(storey, line), node(storey + 1, line)];
        let place = MemberPlace::Column {
            line: line + 1,
            storey: storey + 1,
        };
        add(
            &mut plane,
            place,
            ends,
            [[0.0, foot], [0.0, -head]],
            section,
        );
    }
    for ([floor, bay], section) in frame.all_beams() {
        let arms = [bay, bay + 1].map(|line| zone([floor, line])[0]);
        let ends = [node(floor + 1, bay), node(floor + 1, bay + 1)];
        let place = MemberPlace::Beam {
            floor: floor + 1,
            span: bay + 1,
        };
        add(
            &mut plane,
            place,
            ends,
            [[arms[0], 0.0], [-arms[1], 0.0]],
            section,
        );
    }
    let places = joints.iter().enumerate().skip(1);
    let places = places.flat_map(|(floor, row)| {
        let joints = row.iter().enumerate();
        joints.filter_map(move |(line, node)| Some([floor, line, (*node)?]))
    });
    let places = places.collect();
    (plane, all, named, places)
}

#[test]
fn a_frame_moves_and_bears_as_with_short_stiff_members() {
    moves_and_bears(uneven());
}

#[test]
fn beams_bear_columns_that_start_on_them_and_meet_without_a_column() {
    moves_and_bears(over_beams());
}

fn moves_and_bears(frame: Frame) {
    let (plane, beams, named, joints) = explicit(&frame);
    let feet = frame.lines();
    let system = assembled(&alone(frame));
    let building = &system.buildings[0];
    let sticks = &building.structure.discretization.stick_model;
    // Pushed sideways, down and round at every joint.
    let (mut load, mut loads) = (vec![0.0; building.equations.len()], Vec::new());
    let mut found = Vec::new();
    for [floor, line, node] in joints {
        let at = plane.nodes[node];
        let mut nodes = sticks.nodes.iter();
        let joint = nodes.position(|node| node.x == at[0] && (node.y - at[1]).abs() < 1e-9);
        let joint = joint.expect("a joint");
        let equations = &building.equations;
        let dofs = [
            equations.horizontal(joint),
            equations.vertical(joint),
            equations.rotation(joint),
        ];
        let forces = [
            1e4 * floor as f64,
            -2e4 - 7e3 * line as f64,
            5e3 * (line as f64 - 0.6),
        ];
        for (component, (dof, force)) in dofs.into_iter().zip(forces).enumerate() {
            let dof = dof.expect("it moves");
            load[dof] += force;
            loads.push((3 * node + component, force));
            found.push((dof, 3 * node + component));
        }
    }
    let expected = plane.solve(&beams, feet, &loads);
    let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load);
    let moved = moved.expect("it stands");
    let most = found
        .iter()
        .fold(0.0_f64, |most, (dof, _)| most.max(moved[*dof].abs()));
    for (dof, at) in found {
        close(moved[dof], expected[at], most, 2e-6, "displacement");
    }
    let state = moving(&system, &moved, &vec![0.0; moved.len()]);
    let mut values = vec![0.0; building.members.forms.len()];
    building.member_forces(&state, &[], 0.0, |form, value| values[form] = value);
    assert_eq!(building.members.members.len(), named.len());
    for (place, beam) in named {
        let ends = beam.0;
        let displaced: Vec<f64> = ends
            .iter()
            .flat_map(|node| expected[3 * node..3 * node + 3].to_vec())
            .collect();
        let forces = plane.forces(beam, displaced.as_slice().try_into().expect("six"));
        let mut members = building.members.members.iter();
        let member = members
            .find(|member| member.place == place)
            .expect("a member");
        for (side, section) in member.sections.iter().take(2).enumerate() {
            let at = &forces[3 * side..];
            let outwards = [-1.0, 1.0][side];
            // Positive: tension, the lower part pushes right or the left part up, tension on the right or at the bottom.
            let wanted = match place.is_column() {
                true => [outwards * at[1], outwards * at[0], outwards * at[2]],
                false => [outwards * at[0], -outwards * at[1], outwards * at[2]],
            };
            for (form, wanted) in section.forms.iter().zip(wanted) {
                close(values[*form], wanted, 4e4, 1e-5, &format!("{place} {side}"));
            }
            let y = plane.nodes[ends[side]][1];
            close(section.height, y, 1.0, 1e-12, "height");
        }
    }
}

/// Columns that keep their length carry what rests on them; storey shears are those of their columns; energies balance, also with hinges,
/// P-Delta and self weight.
#[test]
fn forces_and_energies_balance_while_it_yields() {
    let mut frame = uneven();
    frame.axial = Axial::default();
    frame.column_segments = 3;
    frame.beam_segments = vec![2; 2];
    frame
        .columns
        .iter_mut()
        .for_each(|column| column.line_mass = 500.0);
    let mass = 2.0 * 2e4 + 3000.0 * (2.0 * 5.0 + 6.5) + 500.0 * (3.0 * 4.0 + 2.0 * 3.2);
    let corners = Corners::bilinear(9e4, 0.03);
    let hinge = |initial: f64| {
        let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
    };
    let mut model = alone(frame);
    model.buildings[0].gravity = Gravity {
        preload: true,
        p_delta: true,
    };
    model.buildings[0].hinges = Some(Hinges::Frame(FrameHinges {
        columns: vec![vec![hinge(2e9); 3]; 2],
        beams: vec![vec![hinge(3e9); 2]; 2],
        ..FrameHinges::default()
    }));
    let system = assembled(&model);
    let building = &system.buildings[0];
    // Half of the lowest segments rests on the feet, which stand still.
    let mass = mass - 500.0 * (3.7 + 3.6 + 4.0) / 6.0;
    close(building.equations.total_mass(), mass, mass, 1e-12, "mass");
    let forces = |state: &State, form: usize| {
        let mut values = vec![0.0; building.members.forms.len()];
        building.member_forces(state, &[], 0.0, |form, value| values[form] = value);
        let mut sums = [0.0; 2];
        for member in &building.members.members {
            if let MemberPlace::Column { storey, .. } = member.place {
                sums[storey - 1] += values[member.sections[0].forms[form]];
            }
        }
        sums
    };
    let [carried, _] = forces(&State::at_rest(&system, 0.0), 0);
    let weight = STANDARD_GRAVITY * mass;
    close(carried, -weight, weight, 1e-9, "weight on the columns");
    let motion = fading("along", 9.0, [2.5, 3.0], 500);
    let outcome = run(&system, &motion, &steps(1e-3, 1));
    assert!(
        outcome.energy.worst_imbalance < 1e-6,
        "{:e}",
        outcome.energy.worst_imbalance
    );
    assert!(
        outcome.energy.hysteretic > 1e3,
        "{} J",
        outcome.energy.hysteretic
    );
    let sheared = forces(&outcome.state, 1);
    let mut storeys = [0.0; 2];
    let spring = |index: usize| outcome.state.springs[index].force();
    let moved = &outcome.state.displacement;
    building.structure.storeys.for_each(
        moved,
        spring,
        |_| 0.0,
        |storey, force| storeys[storey] = force.shear,
    );
    for (force, storey) in sheared.into_iter().zip(storeys) {
        close(force, storey, 1e5, 1e-9, "shear of a storey");
    }
}

/// Beams that bear a column make it sink and rise with them, whether columns keep their length or hardly shorten.
#[test]
fn a_column_on_a_beam_bears_as_one_that_hardly_shortens() {
    let motion = fading("along", 9.0, [2.5, 3.0], 300);
    let shaken = |flexible: bool| {
        let mut frame = over_beams();
        frame.axial = Axial {
            columns_flexible: flexible,
            beams_flexible: false,
        };
        frame.floor_load = vec![1.5e5; 3];
        for column in &mut frame.columns {
            column.axial_rigidity = Some(1e15);
            column.line_mass = 500.0;
        }
        let mut model = alone(frame);
        let building = &mut model.buildings[0];
        // With β, forces of columns that shorten are without their own damping.
        building.damping = Damping::Rayleigh {
            alpha: 0.3,
            beta: 0.0,
        };
        building.gravity = Gravity {
            preload: true,
            p_delta: true,
        };
        let system = assembled(&model);
        let outcome = run(&system, &motion, &steps(1e-3, 1));
        let building = &system.buildings[0];
        let states = [State::at_rest(&system, 0.0), outcome.state];
        states.map(|state| {
            let mut values = vec![0.0; building.members.forms.len()];
            building.member_forces(&state, &[], 0.0, |form, value| values[form] = value);
            let members = building.members.members.iter();
            let forces = members.map(|member| member.sections[0].forms.map(|form| values[form]));
            let places = building.members.members.iter().map(|member| member.place);
            places.zip(forces).collect::<Vec<_>>()
        })
    };
    let (rigid, flexible) = (shaken(false), shaken(true));
    for (rigid, flexible) in rigid.iter().zip(&flexible) {
        for ((place, rigid), (_, flexible)) in rigid.iter().zip(flexible) {
            for (rigid, flexible) in rigid.iter().zip(flexible) {
                close(*rigid, *flexible, 1e6, 1e-6, &format!("{place}"));
            }
        }
    }
    // At rest: all weight, but that of the lower halves of the lowest columns, is in the columns of the ground storey.
    let on_beam =
        |(place, _): &&(MemberPlace, _)| *place == MemberPlace::Column { line: 2, storey: 2 };
    let [at_rest, _] = &rigid;
    let [carried, ..] = at_rest.iter().find(on_beam).expect("it stands on a beam").1;
    assert!(carried < -1e5, "{carried} N");
    let lowest = at_rest
        .iter()
        .filter(|(place, _)| matches!(place, MemberPlace::Column { storey: 1, .. }));
    let carried: f64 = lowest.map(|(_, [axial, ..])| axial).sum();
    let columns = 500.0 * (3.0 * 0.5 * 4.0 + 4.0 * 3.2 + 3.0 * 3.0);
    let mass = 3.0 * 2e4 + 3.0 * 3000.0 * (5.0 + 4.0 + 6.5) + columns;
    let weight = STANDARD_GRAVITY * mass + 3.0 * 1.5e5;
    close(carried, -weight, weight, 1e-9, "weight on the columns");
}

/// What would strike the rigid end of a column is refused; above it, the column is struck.
#[test]
fn rigid_ends_are_not_struck() {
    let struck_at = |height: f64| {
        let mut model = alone(portal());
        model
            .buildings
            .push(building("B", Structure::Frame(portal())));
        model.gaps.push(Gap {
            floors: FloorPairs::Listed(vec![[Level::Height(height), Level::Floor(1)]]),
            ..Gap::after(0, 0.02, CONCRETE_REALISED)
        });
        if let Structure::Frame(frame) = &mut model.buildings[1].structure {
            frame.storey_heights = vec![height];
        }
        for building in &mut model.buildings {
            if let Structure::Frame(frame) = &mut building.structure {
                frame.columns[0].line_mass = 600.0;
            }
        }
        System::assemble(&model)
    };
    // The column bends up to 3.25 m.
    let system = struck_at(3.2).expect("it can be struck");
    close(system.contacts[0].height, 3.2, 1.0, 1e-9, "height");
    let faults = struck_at(3.4).expect_err("it is rigid there");
    assert!(
        faults
            .iter()
            .any(|own| own.problem.contains("is rigid there")),
        "{faults:?}"
    );
}
