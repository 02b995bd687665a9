//! Shear in the cores of beam–column joints, against closed forms and against the forces of beams and columns of the same
//! run, by two ways of stepping.

use jostle::linear::StepMatrix;
use jostle::model::{CapacityLine, MemberCapacity, RuleCapacity, ShearCapacity};
use jostle::stiffness::DirectStiffness;
use jostle::structure::{MemberPlace, SectionAt, solve_once};
use jostle::{
    Analysis, Building, Frame, Gap, JointRequest, MemberRequest, Model, Outcome, Section, Solver,
    State, Structure, Summary, System,
};
use jostle_testkit::models::{self, CONCRETE_REALISED};
use jostle_testkit::motions::two_waves;
use jostle_testkit::runs::run_and_summary;

fn section(rigidity: f64) -> Section {
    Section {
        flexural_rigidity: rigidity,
        axial_rigidity: None,
        line_mass: 0.0,
        shear_rigidity: None,
    }
}

fn building(
    name: &str,
    storeys: usize,
    height: f64,
    spans: &[f64],
    rigidity: [f64; 2],
) -> Building {
    let [columns, beams] = rigidity;
    let frame = Frame {
        storey_heights: vec![height; storeys],
        floor_mass: vec![9000.0; storeys],
        beam_segments: vec![2; spans.len()],
        ..models::frame(storeys, spans, section(columns), section(beams))
    };
    models::building(name, Structure::Frame(frame))
}

/// Half the depth of the columns, and the lever arms of beams on the left and on the right \[m\].
const HALF: f64 = 0.25;
const LEVERS: [f64; 2] = [0.5, 0.6];

/// All joints of a building, with a capacity that depends on the compression above them.
fn joints(model: &Model, index: usize) -> Vec<JointRequest> {
    let Structure::Frame(frame) = &model.buildings[index].structure else {
        panic!("a frame")
    };
    let lines = frame.spans.len() + 1;
    let name = &model.buildings[index].name;
    let mut joints = Vec::new();
    for floor in 1..=frame.storey_heights.len() {
        for line in 1..=lines {
            let [left, right] = LEVERS;
            joints.push(JointRequest {
                building: index,
                line,
                floor,
                half_depth: HALF,
                levers: [(line > 1).then_some(left), (line < lines).then_some(right)],
                capacity: MemberCapacity {
                    member: format!("{name}.joint.{line}.{floor}"),
                    compression_at_rest: 1e5,
                    follows_axial: true,
                    axial_failure_drift: CapacityLine::default(),
                    rotations: Vec::new(),
                    rules: vec![rule("first", 1.0), rule("second", 1.5)],
                },
            });
        }
    }
    joints
}

fn rule(rule: &'static str, factor: f64) -> RuleCapacity {
    let none = || CapacityLine::new(vec![[0.0, f64::INFINITY]]);
    RuleCapacity {
        rule,
        shear: Some(ShearCapacity {
            steady: CapacityLine::new(vec![[-2e5, 2e5 * factor], [4e5, 5e5 * factor]]),
            degrading: CapacityLine::default(),
            by_ductility: CapacityLine::default(),
            limit: 6e5 * factor,
        }),
        bending: [none(), none()],
        across: None,
    }
}

fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    let mut model = Model {
        title: "Joints".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            members: MemberRequest::all(),
            ..Analysis::default()
        },
        ..Model::default()
    };
    let all = 0..model.buildings.len();
    model.analysis.members.joints = all.flat_map(|index| joints(&model, index)).collect();
    model
}

/// A. Kleinlogel, Rahmenformeln: a portal with fixed feet pushed at its left joint has moments ±Ph/2 3k/(6k + 1) at the
/// joints, k = (I_beam/I_column)(h/l). Nothing stands above: the core carries the force in the upper bars of the beam alone.
#[test]
fn joints_of_a_portal_follow_its_closed_form() {
    let (h, l, i_column, i_beam, p) = (4.0, 6.0, 1.5e8, 2.4e8, 100e3);
    let model = model(
        vec![building("P", 1, h, &[l], [i_column, i_beam])],
        Vec::new(),
    );
    let system = System::assemble(&model).expect("sound");
    let building = &system.buildings[0];
    let nodes = &building.discretization.stick_model.nodes;
    let found = nodes.iter().position(|node| node.x == 0.0 && node.y == h);
    let node = found.expect("a node there");
    let mut load = vec![0.0; building.equations.len()];
    load[building.equations.horizontal(node).expect("free")] += p;
    let displacement = solve_once::<DirectStiffness>(building, &StepMatrix::STATIC, &load);
    let mut state = State::at_rest(&system, 0.0);
    state.displacement = displacement.expect("it stands");
    state.acceleration.fill(0.0);
    let mut values = vec![0.0; building.members.forms.len()];
    building.member_forces(&state, &[], 0.0, |form, value| values[form] = value);
    let k = i_beam / i_column * h / l;
    let moment = p * h / 2.0 * 3.0 * k / (6.0 * k + 1.0);
    // It falls linearly from +M to −M over the span.
    let face = moment * (1.0 - 2.0 * HALF / l);
    for (joint, due) in building
        .members
        .joints
        .iter()
        .zip([-face / LEVERS[1], -face / LEVERS[0]])
    {
        let found = values[joint.section.forms[1]];
        assert!(
            (found - due).abs() < 1e-9 * face,
            "{joint}: {found} instead of {due}"
        );
        assert_eq!(values[joint.section.forms[0]], 0.0, "nothing stands above");
    }
}

fn pair() -> Model {
    let buildings = vec![
        building("A", 4, 3.2, &[6.0, 5.0], [1.5e8, 2e8]),
        building("B", 3, 3.2, &[5.0, 6.0], [4e8, 3e8]),
    ];
    let mut model = model(buildings, vec![Gap::after(0, 0.01, CONCRETE_REALISED)]);
    let columns = [(0, 4), (1, 3)].into_iter().flat_map(|(index, storeys)| {
        let name = ["A", "B"][index];
        (1..=storeys).flat_map(move |storey| {
            let columns = (1..=3).map(move |line| format!("{name}.column.{line}.{storey}"));
            columns.chain((1..=2).map(move |span| format!("{name}.beam.{storey}.{span}")))
        })
    });
    model.analysis.members.histories = columns.collect();
    model
}

fn run(model: &Model, solver: Solver) -> (System, Outcome, Summary) {
    let mut model = model.clone();
    model.analysis.solver = Some(solver);
    run_and_summary(&model, &two_waves(200))
}

/// Greatest shear of every joint, and its greatest ratios by both rules, from the recorded forces of beams and columns.
fn from_histories(model: &Model, system: &System, outcome: &Outcome) -> Vec<[f64; 3]> {
    let history = outcome.member_history.as_ref().expect("asked for");
    let mut all = vec![[0.0_f64; 3]; model.analysis.members.joints.len()];
    for row in history.rows() {
        let mut values = Vec::new();
        let mut sections = row.iter();
        for [building, member] in history.members() {
            let member = &system.buildings[*building].members.members[*member];
            for section in &member.sections {
                values.push((
                    *building,
                    member.place,
                    section.at,
                    *sections.next().expect("full"),
                ));
            }
        }
        let at = |building: usize, place: MemberPlace, end: SectionAt| {
            let found = values.iter().find(|(candidate, known, at, _)| {
                (*candidate, *known, *at) == (building, place, end)
            });
            found.map_or([0.0; 3], |(.., [axial, shear, moment, ..])| {
                [*axial, *shear, *moment]
            })
        };
        for (joint, found) in model.analysis.members.joints.iter().zip(&mut all) {
            let (floor, line, index) = (joint.floor, joint.line, joint.building);
            let above = MemberPlace::Column {
                line,
                storey: floor + 1,
            };
            let [axial, mut shear, _] = at(index, above, SectionAt::First);
            if let Some(lever) = joint.levers[0] {
                let beam = MemberPlace::Beam {
                    floor,
                    span: line - 1,
                };
                let [_, v, m] = at(index, beam, SectionAt::Last);
                shear += (m - v * HALF) / lever;
            }
            if let Some(lever) = joint.levers[1] {
                let beam = MemberPlace::Beam { floor, span: line };
                let [_, v, m] = at(index, beam, SectionAt::First);
                shear -= (m + v * HALF) / lever;
            }
            found[0] = found[0].max(shear.abs());
            let compression = joint.capacity.compression_at_rest - axial;
            for (factor, most) in [1.0, 1.5].into_iter().zip(&mut found[1..]) {
                let line = 2e5 + 0.5 * (compression + 2e5);
                let capacity = factor * line.clamp(2e5, 5e5).min(6e5);
                *most = most.max(shear.abs() / capacity);
            }
        }
    }
    all
}

#[test]
fn shear_of_joints_follows_from_their_beams_and_columns() {
    let model = pair();
    for (solver, above) in [(Solver::Riccati, 1e-9), (Solver::Modal, 0.02)] {
        let (system, outcome, summary) = run(&model, solver);
        assert!(outcome.impacts.len() > 2);
        let due = from_histories(&model, &system, &outcome);
        let found: Vec<_> = summary.buildings.iter().flat_map(|b| &b.joints).collect();
        assert_eq!(found.len(), due.len());
        let mut exceeded = 0;
        for (joint, due) in found.iter().zip(&due) {
            // No member is rated, so no rule governs.
            let ratios = &joint.other_ratios;
            let values = [joint.shear_peak_n, ratios[0].shear, ratios[1].shear];
            for (found, due) in values.iter().zip(due) {
                assert!(
                    *found >= due * (1.0 - 1e-9),
                    "{}: {found} below {due}",
                    joint.name
                );
                assert!(
                    *found <= due * (1.0 + above),
                    "{}: {found} above {due}",
                    joint.name
                );
            }
            let at = &ratios[0].shear_at;
            assert!((at.demand.abs() / at.capacity / ratios[0].shear - 1.0).abs() < 1e-9);
            assert_eq!(at.exceeded_s.is_some(), ratios[0].shear > 1.0);
            exceeded += usize::from(ratios[0].shear > 1.0);
        }
        assert!(exceeded > 2, "only {exceeded}: the test is too weak");
    }
}

/// Members and joints rated together: the worst instant of a building is that of its members alone, however weak its joints are.
#[test]
fn joints_do_not_choose_the_worst_instant() {
    for solver in [Solver::Riccati, Solver::Modal] {
        let mut model = pair();
        let members = model.analysis.members.histories.iter();
        let even = |value: f64| CapacityLine::new(vec![[0.0, value]]);
        model.analysis.members.capacities = members
            .map(|member| MemberCapacity {
                member: member.clone(),
                compression_at_rest: 0.0,
                follows_axial: false,
                axial_failure_drift: CapacityLine::default(),
                rotations: Vec::new(),
                rules: vec![RuleCapacity {
                    rule: "first",
                    shear: None,
                    bending: [even(5e6), even(5e6)],
                    across: None,
                }],
            })
            .collect();
        let (_, outcome, summary) = run(&model, solver);
        for (building, worst) in summary.buildings.iter().zip(&outcome.worst_instants) {
            let of_joints = building
                .joints
                .iter()
                .filter_map(|joint| joint.ratio.as_ref());
            let of_members = building
                .members
                .iter()
                .filter_map(|member| member.ratio.as_ref());
            let joint = of_joints.map(|joint| joint.shear).fold(0.0, f64::max);
            let member = of_members.map(|member| member.bending).fold(0.0, f64::max);
            assert!(joint > 2.0 * member && member > 0.0, "{joint} and {member}");
            assert_eq!(worst.ratio, member, "{solver:?}");
            let at = building.capacity.as_ref().expect("rated").worst.at_s;
            assert!(worst.time >= at && worst.time - at < 0.02, "{solver:?}");
        }
    }
}
