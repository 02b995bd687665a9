//! Scripts of buildings in space, read back as tables. That OpenSees gives the same answers is shown in docs/validation.md.

use crate::script::{export, model, number, quadratic, table};
use jostle::System;

const ELEMENTS: &str = include_str!("../../../jostle-validation/data/opensees/plan_elements.toml");
const CORNERS: &str = include_str!("../../../jostle-validation/data/opensees/plan_corners.toml");

/// Where a node moves when its floor, or itself, moves: the floor's node and the arm from it; `None` is fixed.
fn carrier(text: &str, tag: &str) -> Option<(String, [f64; 2])> {
    let place = |tag: &str| {
        let nodes = table(text, "NODES");
        let row = nodes.iter().find(|row| row[0] == tag).expect("a node");
        [number(&row[1]), number(&row[2])]
    };
    if table(text, "SUPPORTS").iter().any(|row| row[0] == tag) {
        return None;
    }
    let arms = table(text, "ARMS");
    let floor = arms.iter().find(|row| row[1] == tag).expect("tied");
    let (position, centre) = (place(tag), place(&floor[0]));
    Some((
        floor[0].clone(),
        [position[0] - centre[0], position[1] - centre[1]],
    ))
}

/// Energy of the springs of one building when floors move, twice.
fn energy(text: &str, block: &str, damped: &str, floors: &[String], motion: &[[f64; 3]]) -> f64 {
    let materials = table(text, "MATERIALS");
    let moved = |tag: &str| {
        carrier(text, tag).map_or([0.0; 3], |(floor, arm)| {
            let index = floors
                .iter()
                .position(|candidate| *candidate == floor)
                .expect("own");
            let [x, y, turn] = motion[index];
            [x - turn * arm[1], y + turn * arm[0], turn]
        })
    };
    let mut sum = 0.0;
    for row in table(text, "SPRINGS") {
        if !row[1].starts_with(block) || row.last().map(String::as_str) != Some(damped) {
            continue;
        }
        let (a, b) = (moved(&row[1]), moved(&row[2]));
        let pairs: Vec<&String> = row[3..row.len() - 1]
            .iter()
            .filter(|w| !w.is_empty())
            .collect();
        for pair in pairs.chunks(2) {
            let component = match &pair[0][..] {
                "1" => 0,
                "2" => 1,
                _ => 2,
            };
            let material = materials.iter().find(|row| row[1] == *pair[1]);
            let stiffness = number(&material.expect("a material")[2]);
            sum += stiffness * (b[component] - a[component]).powi(2);
        }
    }
    sum
}

/// Elements at points, other centres of mass at every floor and P-Delta: springs and arms have the energy of the core's matrix.
#[test]
fn springs_of_storeys_have_the_energy_of_the_matrix() {
    let input = model(ELEMENTS);
    let text = export(&input).expect("it can be exported").text;
    let system = System::assemble(&input.model).expect("sound");
    for (number, building) in system.buildings.iter().enumerate() {
        let floors: Vec<String> = building
            .discretization
            .floors
            .iter()
            .map(|node| ((number + 1) * 1000 + node + 1).to_string())
            .collect();
        for seed in 0..4 {
            let motion: Vec<[f64; 3]> = (0..floors.len())
                .map(|floor| {
                    std::array::from_fn(|c| (1.7 * (seed * 9 + floor * 3 + c) as f64).sin())
                })
                .collect();
            let mut values = vec![0.0; building.equations.len()];
            for (floor, moved) in motion.iter().enumerate() {
                let centre = building.discretization.centres[floor];
                // Along x, across, and rotation, in this order.
                let row = building.row_at(floor, centre, [1.0, 0.0]);
                for (&(dof, _), value) in row.entries().iter().zip(moved) {
                    values[dof - building.offset] = *value;
                }
            }
            let block = (number + 1).to_string();
            for (damped, matrix) in [
                ("\"initial\"", &building.equations.stiffness),
                ("None", &building.equations.undamped),
            ] {
                let expected = quadratic(matrix, &values);
                let got = energy(&text, &block, damped, &floors, &motion);
                assert!(
                    (got - expected).abs() <= 1e-8 * expected.abs(),
                    "{}, {damped}: {got} against {expected}",
                    building.name
                );
            }
        }
    }
}

/// Points of both sides coincide, so that contacts have no length, and stiffnesses of a face add up to that of the gap.
#[test]
fn points_of_a_face_coincide_and_share_the_stiffness() {
    let text = export(&model(ELEMENTS)).expect("it can be exported").text;
    let contacts = table(&text, "CONTACTS");
    assert_eq!(contacts.len(), 10, "two faces of five points");
    let nodes = table(&text, "NODES");
    let place = |tag: &str| {
        let row = nodes.iter().find(|row| row[0] == tag).expect("a node");
        (row[1].clone(), row[2].clone())
    };
    let materials = table(&text, "MATERIALS");
    let mut sum = 0.0;
    for row in &contacts {
        assert_eq!(place(&row[1]), place(&row[2]));
        let material = materials.iter().find(|material| material[1] == row[3]);
        sum += number(&material.expect("a material")[2]);
    }
    assert!((sum / 500e6 - 1.0).abs() < 1e-9, "{sum}");
    let faces = table(&text, "FACES");
    assert_eq!(faces.len(), 10);
    assert!(
        faces
            .iter()
            .all(|row| row[3..5] == ["1.0", "0.0"] || row[3..5] == ["1.0", "-0.0"])
    );
    assert!(table(&text, "ENDS").is_empty());
}

#[test]
fn corners_have_the_ends_of_their_edges() {
    let text = export(&model(CORNERS)).expect("it can be exported").text;
    let contacts = table(&text, "CONTACTS");
    let ends = table(&text, "ENDS");
    assert_eq!(contacts.len(), 2);
    assert_eq!(ends.len(), 2);
    // Of corners that pass each other, the end is the indentation of the other.
    let gap = |row: &Vec<String>| number(&row[4]);
    for (one, other) in [(0, 1), (1, 0)] {
        let inside = number(ends[one].last().expect("a distance"));
        assert!(
            (inside + gap(&contacts[other])).abs() < 1e-12,
            "{ends:?} {contacts:?}"
        );
    }
}

#[test]
fn both_components_and_their_angle_are_written() {
    let text = export(&model(ELEMENTS)).expect("it can be exported").text;
    assert!(text.contains("\nANGLE = 0.4363323129985824  # rad"));
    assert!(text.contains("\nclass ACROSS:"));
    assert!(text.contains("\n    RICKER = (2.0, 0.6, 2.5)"));
    // A building without a plan has neither.
    let plane = model(
        "motion = { record = \"el-centro-1940-ns\" }\n[[building]]\nkind = \"shear\"\nmass = [\"40 t\"]\nstiffness = [\"60 MN/m\"]\n",
    );
    let text = export(&plane).expect("it can be exported").text;
    assert!(!text.contains("\nANGLE") && !text.contains("\nclass ACROSS"));
    assert!(text.contains("\nARMS = []"));
}

/// Joints of a space frame move with the node of their floor; every column and beam joins two of them.
#[test]
fn space_frames_are_written_member_by_member() {
    const FRAME: &str = include_str!("../../../jostle-validation/data/space/S8_space_frame.toml");
    let text = export(&model(FRAME)).expect("it can be exported").text;
    let joints = table(&text, "JOINTS");
    assert_eq!(joints.len(), 4 * 9);
    assert_eq!(joints.iter().filter(|row| row[4] == "None").count(), 9);
    let members = table(&text, "COLUMNS_AND_BEAMS");
    assert_eq!(members.len(), 3 * (9 + 6 + 6));
    let place = |tag: &str| {
        let joint = joints.iter().find(|row| row[0] == tag).expect("a joint");
        [1, 2, 3].map(|axis| number(&joint[axis]))
    };
    for row in &members {
        let (a, b) = (place(&row[1]), place(&row[2]));
        let way: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
        // Columns bend along x in their first plane, beams upwards.
        let towards: Vec<f64> = row[8..11].iter().map(|value| number(value)).collect();
        let is_column = way[2] > 0.0;
        assert_eq!(
            towards,
            if is_column {
                [1.0, 0.0, 0.0]
            } else {
                [0.0, 0.0, 1.0]
            }
        );
        assert_eq!(way.iter().filter(|part| **part > 0.0).count(), 1);
    }
    let rigid = FRAME.replace("\nshear =", "\naxial = \"rigid\"\nshear =");
    let exported = export(&model(&rigid)).expect("it can be exported");
    assert!(exported.text.contains("EA = 1e4 * 12 EI / l^2"));
}

const BRACED: &str = r#"
[[building.brace]]
along = "x"
x = 2
y = 1
direction = "both"
EA = "300 MN"

[[building.brace]]
along = "y"
x = 3
y = 2
storeys = [1, 2]
EA = "200 MN"
hinge = { rule = "bilinear", yield = "60 kN", post_yield = 0.02 }
"#;

/// Braces of a space frame join the joints of its members, along the lines between them; those that yield are not damped unless the
/// model says so.
#[test]
fn braces_of_space_frames_join_their_joints() {
    const FRAME: &str = include_str!("../../../jostle-validation/data/space/S8_space_frame.toml");
    let text = format!("{FRAME}{BRACED}");
    let text = export(&model(&text)).expect("it can be exported").text;
    let joints = table(&text, "JOINTS");
    let place = |tag: &str| {
        let joint = joints.iter().find(|row| row[0] == tag).expect("a joint");
        [1, 2, 3].map(|axis| number(&joint[axis]))
    };
    let rows = table(&text, "DIAGONALS");
    let found = rows
        .iter()
        .map(|row| (place(&row[1]), place(&row[2]), &row[4][..]));
    let found: Vec<_> = found.collect();
    assert_eq!(found.len(), 3 * 2 + 2);
    assert_eq!(found[0], ([6.0, 0.0, 0.0], [11.0, 0.0, 4.0], "\"initial\""));
    assert_eq!(found[1], ([11.0, 0.0, 0.0], [6.0, 0.0, 4.0], "\"initial\""));
    assert_eq!(found[7], ([11.0, 5.0, 4.0], [11.0, 9.0, 7.2], "None"));
}

const YIELDING_BRACE: &str =
    "\nhinge = { rule = \"bilinear\", yield = \"60 kN\", post_yield = 0.02 }\n";

/// Braces that yield are damped as the model says, in plane frames, in frames at lines and in space frames; struts of panels never are.
#[test]
fn braces_that_yield_are_damped_as_asked() {
    const SPACE: &str = include_str!("../../../jostle-validation/data/space/S8_space_frame.toml");
    const LINES: &str = include_str!("../../../jostle-validation/data/opensees/plan_falling.toml");
    const PLANE: &str = r#"
[motion]
record = "el-centro-1940-ns"
[[building]]
name = "frame"
kind = "frame"
storeys = 1
storey_height = 3.0
spans = [4.0]
column = { width = 0.4, depth = 0.4 }
beam = { width = 0.3, depth = 0.5 }
elastic_modulus = 3e10
floor_mass = 30000
[[building.brace]]
EA = "200 MN"
"#;
    let lines = LINES.split("[[building]]").collect::<Vec<_>>();
    let lines = format!("{}[[building]]{}", lines[0], lines[1]).replacen(
        "[[building.frame.infill]]",
        &format!("[[building.frame.brace]]\nbay = 1\nEA = \"200 MN\"{YIELDING_BRACE}[[building.frame.infill]]"),
        1,
    );
    for (model_text, kind, braces, struts) in [
        (format!("{SPACE}{BRACED}"), "space-frame", 2, 0),
        (lines, "lines", 4, 8),
        (format!("{PLANE}{YIELDING_BRACE}"), "plane", 1, 0),
    ] {
        for (asked, due) in [
            ("none", "None"),
            ("initial", "\"initial\""),
            ("tangent", "\"tangent\""),
        ] {
            let mut input = model(&model_text);
            input.model.buildings[0].yielding_damping = Some(match asked {
                "none" => jostle::ProportionalDamping::None,
                "initial" => jostle::ProportionalDamping::Initial,
                _ => jostle::ProportionalDamping::Tangent,
            });
            let text = export(&input).expect("it can be exported").text;
            let materials = table(&text, "MATERIALS");
            let yields = |row: &&Vec<String>| {
                let material = materials.iter().find(|material| material[1] == row[3]);
                material.expect("a material")[0] != "\"Elastic\""
            };
            let rows = table(&text, "DIAGONALS");
            let yielding: Vec<_> = rows.iter().filter(yields).collect();
            assert_eq!(yielding.len(), braces + struts, "{kind}");
            let damped = yielding.iter().filter(|row| row[4] == due).count();
            let all = if asked == "none" {
                braces + struts
            } else {
                braces
            };
            assert_eq!(damped, all, "{kind}, {asked}: {yielding:?}");
        }
    }
}

/// Members of a space frame have rigid ends, unless hinges stand there.
#[test]
fn rigid_ends_of_space_frames_are_offsets_of_joints() {
    const FRAME: &str = include_str!("../../../jostle-validation/data/space/S8_space_frame.toml");
    let input = model(&FRAME.replace("\nshear =", "\nrigid_ends = 1\nshear ="));
    let text = export(&input).expect("it can be exported").text;
    let members = table(&text, "COLUMNS_AND_BEAMS");
    let rigid = table(&text, "RIGID_ENDS");
    let jostle::Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("a plan");
    };
    let frame = tiers.space_frame.as_ref().expect("a space frame");
    let due = frame
        .members
        .iter()
        .map(|member| frame.rigid_ends(member.place));
    let due: Vec<[f64; 2]> = due.filter(|ends| *ends != [0.0; 2]).collect();
    assert!(due.len() > 40 && due.len() == rigid.len());
    for (row, due) in rigid.iter().zip(due) {
        assert_eq!([number(&row[1]), number(&row[2])], due);
        assert!(members.iter().any(|member| member[0] == row[0]));
    }
    let hinged = include_str!("../../../jostle-validation/data/opensees/yielding_space_frame.toml");
    let hinged = hinged.replace("\nbeam_x =", "\nrigid_ends = 1\nbeam_x =");
    let faults = export(&model(&hinged)).expect_err("hinges on arms");
    assert_eq!(faults[0].path, "building[0].hinges");
}

/// Joints of frames at lines move with their floors along their line; members stand between them in the plane of their frame.
#[test]
fn frames_at_lines_are_written_member_by_member() {
    const FRAMES: &str = include_str!("../../../jostle-validation/data/opensees/plan_frames.toml");
    let text = export(&model(FRAMES)).expect("it can be exported").text;
    let joints = table(&text, "UPRIGHT");
    let joint = |tag: &str| joints.iter().find(|row| row[0] == tag).expect("a joint");
    let place = |tag: &str| [1, 2, 3].map(|axis| number(&joint(tag)[axis]));
    let members = table(&text, "COLUMNS_AND_BEAMS");
    // Of the office four, four, three and three columns and as many bays less one; of the annexe five times three columns.
    assert_eq!(members.len(), 3 * (14 + 10) + 2 * (15 + 10));
    for row in &members {
        let (a, b) = (place(&row[1]), place(&row[2]));
        let line = [5, 6].map(|axis| number(&joint(&row[1])[axis]));
        // Nothing leaves the plane of the frame.
        let across = (b[0] - a[0]) * line[1] - (b[1] - a[1]) * line[0];
        assert!(across.abs() < 1e-9, "{row:?}");
        let [sideways, torsion] = [&row[4], &row[5]].map(|value| number(value));
        assert_eq!([sideways, torsion], [0.0; 2]);
    }
    // What no floor carries stands on the ground: feet, and ends that hinges let turn above those of the office.
    let held = joints.iter().filter(|row| row[4] == "None");
    let feet: Vec<(f64, &str)> = held.map(|row| (number(&row[3]), &row[9][..])).collect();
    assert!(feet.iter().all(|(height, _)| *height == 0.0));
    let turning = feet.iter().filter(|(_, held)| *held == "0").count();
    assert_eq!([feet.len() - turning, turning], [14 + 15, 14]);
    let failing = FRAMES.replacen(
        "direction = \"y\"",
        "shear_failure = { strength = \"400 kN\", slope = \"5 MN/m\" }\ndirection = \"y\"",
        1,
    );
    let text = export(&model(&failing)).expect("it can be exported").text;
    // At the foot of every column of one frame, along y: the end of the column slides, and no floor moves it.
    let materials = table(&text, "MATERIALS");
    let fails = |tag: &str| {
        materials
            .iter()
            .any(|row| row[0] == "\"LimitState\"" && row[1] == tag)
    };
    let springs = table(&text, "UPRIGHT_SPRINGS");
    let failing: Vec<&Vec<String>> = springs.iter().filter(|row| fails(&row[4])).collect();
    assert_eq!(failing.len(), 3 * 3);
    let joints = table(&text, "UPRIGHT");
    for row in failing {
        assert_eq!([&row[3], &row[6], &row[7]], ["1", "0.0", "1.0"]);
        let end = joints.iter().find(|joint| joint[0] == row[2]);
        assert_eq!(end.expect("a joint")[4], "None");
    }
}

/// Columns of a space frame that fail in shear slide along both lines at their feet, and turn about the vertical axis with their joints.
#[test]
fn columns_of_space_frames_slide_at_their_feet() {
    const MODEL: &str = include_str!("../../../jostle-validation/data/opensees/plan_failing.toml");
    let text = export(&model(MODEL)).expect("it can be exported").text;
    let ends = table(&text, "HINGED_ENDS");
    assert_eq!(ends.len(), 2 * 8);
    let sliding = ends.iter().filter(|row| row.len() > 4 && row[7] == "1");
    let directions = sliding.map(|row| [7, 13, 19].map(|at| row[at].clone()));
    assert_eq!(directions.collect::<Vec<_>>(), vec![["1", "2", "6"]; 8]);
}

/// Contact springs under a base in plan: their sums are those of the ground, and the weight of the floors stands on points of the base.
#[test]
fn bases_in_plan_that_lift_off_rest_on_a_grid() {
    const MODEL: &str = include_str!("../../../jostle-validation/data/opensees/plan_uplift.toml");
    let text = export(&model(MODEL)).expect("it can be exported").text;
    let materials = table(&text, "MATERIALS");
    let nodes = table(&text, "NODES");
    let place = |tag: &str| {
        let node = nodes.iter().find(|row| row[0] == tag).expect("a node");
        [1, 2].map(|axis| number(&node[axis]))
    };
    let mut sums = [[0.0; 3]; 2];
    for row in table(&text, "SPRINGS") {
        let material = materials
            .iter()
            .find(|other| other[1] == row[4])
            .expect("a material");
        if row[3] != "3" || material[0] != "\"ElasticPPGap\"" {
            continue;
        }
        // Upwards it has no force.
        assert!(number(&material[3]) < 0.0 && number(&material[4]) == 0.0);
        let [at, below] = [place(&row[2]), place(&row[1])];
        assert_eq!(at, below);
        let building = usize::from(at[0] > 7.01);
        let middle = [[3.5, 3.0], [10.02, 3.0]][building];
        let stiffness = number(&material[2]);
        let [x, y] = [0, 1].map(|axis| at[axis] - middle[axis]);
        for (sum, factor) in sums[building].iter_mut().zip([1.0, x, y]) {
            *sum += stiffness * factor;
        }
    }
    for (sum, stiffness) in sums.into_iter().zip([900e6, 700e6]) {
        assert!((sum[0] / stiffness - 1.0).abs() < 1e-12, "{sum:?}");
        assert!(sum[1].abs() + sum[2].abs() < 1e-6 * stiffness, "{sum:?}");
    }
    let carried = table(&text, "CARRIED");
    let mass: f64 = carried.iter().map(|row| number(&row[1])).sum();
    assert!(
        (mass - (80e3 + 240e3 + 80e3 + 177e3)).abs() < 1e-6,
        "{mass}"
    );
    assert_eq!(table(&text, "RIDING").len(), 4);
    assert_eq!(table(&text, "TILTED").len(), 3);
}

/// An end of a member with hinges is a node of its own, which a spring joins to its joint upwards and about both axes.
#[test]
fn hinges_of_space_frames_stand_between_joints_and_ends() {
    const FRAME: &str =
        include_str!("../../../jostle-validation/data/opensees/yielding_space_frame.toml");
    let text = export(&model(FRAME)).expect("it can be exported").text;
    let joints = table(&text, "JOINTS");
    let members = table(&text, "COLUMNS_AND_BEAMS");
    assert_eq!([joints.len(), members.len()], [12, 16]);
    let ends = table(&text, "HINGED_ENDS");
    assert_eq!(ends.len(), 2 * 16);
    let is_joint = |tag: &String| joints.iter().any(|row| row[0] == *tag);
    for row in &ends {
        assert!(is_joint(&row[1]) && !is_joint(&row[0]));
        let is_end = |member: &Vec<String>| member[1] == row[0] || member[2] == row[0];
        assert_eq!(members.iter().filter(|member| is_end(member)).count(), 1);
        let directions: Vec<&str> = [7, 13, 19].map(|at| row[at].as_str()).into();
        assert_eq!(directions, ["3", "5", "4"]);
    }
    let takeda = FRAME.replace("\"bilinear\"", "\"takeda\"").replace(
        "post_yield",
        "cracking = \"30 kN.m\", post_cracking = 0.3, post_yield",
    );
    let faults = export(&model(&takeda)).expect_err("OpenSees has no such rule");
    assert_eq!(faults[0].path, "building[0].hinges.rule");
}

#[test]
fn friction_in_plan_is_refused_by_field() {
    let text = CORNERS.replace("law = \"linear\"", "law = \"linear\"\nfriction = 0.3");
    let faults = export(&model(&text)).expect_err("refused");
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].path, "gap[0].friction");
}

const ISOLATED: &str = include_str!("../../../jostle-validation/data/opensees/plan_isolated.toml");

/// Every bearing joins a point of the ground to a point of the mat by springs and dashpots, and by what yields; damping of the building is
/// between its floors and the mat.
#[test]
fn bearings_in_plan_join_the_ground_and_the_mat() {
    let text = export(&model(ISOLATED)).expect("it can be exported").text;
    let (nodes, arms) = (table(&text, "NODES"), table(&text, "ARMS"));
    let supports = table(&text, "SUPPORTS");
    let mat = &table(&text, "LEVELS")[0];
    assert_eq!(number(&mat[1]), 0.0);
    let node = |tag: &str| nodes.iter().find(|row| row[0] == tag).expect("a node");
    let heavy = node(&mat[0]);
    assert_eq!([1, 2, 3].map(|at| number(&heavy[at])), [7.0, 5.0, 190e3]);
    let sliders = table(&text, "SLIDERS");
    assert_eq!(sliders.len(), 6);
    let springs = table(&text, "SPRINGS");
    let materials = table(&text, "MATERIALS");
    for row in &sliders {
        let [ground, above] = [&row[1], &row[2]];
        assert!(supports.iter().any(|node| node[0] == **ground));
        assert!(arms.iter().any(|arm| arm[0] == mat[0] && arm[1] == **above));
        for axis in [1, 2] {
            assert_eq!(node(ground)[axis], node(above)[axis]);
        }
        // (K1 - K2) and Q = F_y (1 - K2/K1) of one of six.
        assert!((number(&row[3]) / (36e6 * 0.88 / 6.0) - 1.0).abs() < 1e-12);
        assert!((number(&row[4]) / (220e3 * 0.88 / 6.0) - 1.0).abs() < 1e-12);
        let beside = springs
            .iter()
            .find(|spring| spring[1] == **ground && spring[2] == **above);
        let material = beside.expect("a spring")[4].trim_matches([')', ',']);
        let material = materials.iter().find(|candidate| candidate[1] == material);
        let material = material.expect("a material");
        assert!((number(&material[2]) / (36e6 * 0.12 / 6.0) - 1.0).abs() < 1e-12);
        assert!((number(&material[3]) / (300e3 / 6.0) - 1.0).abs() < 1e-12);
    }
    assert!(text.contains("\"alpha\": 0.0, \"beta\": 0.0015"));
    // 0.35 of the masses of both floors.
    for mass in [210e3, 180e3] {
        let dashpot = |row: &Vec<String>| row[0] == "\"Elastic\"" && row.len() > 3;
        let same = |row: &Vec<String>| (number(&row[3]) / (0.35 * mass) - 1.0).abs() < 1e-12;
        assert!(
            materials.iter().any(|row| dashpot(row) && same(row)),
            "{mass}"
        );
    }
}

#[test]
fn a_ring_stop_and_friction_that_rises_are_refused_by_field() {
    let text = ISOLATED.replace(
        "damping = \"300 kN.s/m\"",
        "stop = { at = \"80 mm\", stiffness = \"60 MN/m\" }",
    );
    let faults = export(&model(&text)).expect_err("OpenSees has no ring");
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].path, "building[0].isolation.stop");
    const FRAME: &str =
        include_str!("../../../jostle-validation/data/opensees/plan_isolated_frame.toml");
    let text = FRAME.replace(
        "friction = 0.06",
        "friction = { slow = 0.03, fast = 0.06, rate = \"40 s/m\" }",
    );
    let faults = export(&model(&text)).expect_err("not by these springs");
    assert_eq!(faults[0].path, "building[0].isolation.friction");
    // Feet of columns stand on the mat.
    let text = export(&model(FRAME)).expect("it can be exported").text;
    let mat = table(&text, "LEVELS")[0][0].clone();
    let joints = table(&text, "JOINTS");
    let feet = joints.iter().filter(|row| row[4] == mat);
    assert_eq!(feet.count(), 6);
    assert!(joints.iter().all(|row| row[4] != "None"));
}

/// Links between points of floors act along the line between them, and a wall that gives way moves along its normal.
#[test]
fn links_and_walls_of_a_site_have_directions() {
    const MODEL: &str = include_str!("../../../jostle-validation/data/opensees/plan_links.toml");
    let text = export(&model(MODEL)).expect("it can be exported").text;
    let nodes = table(&text, "NODES");
    let place = |tag: &str| {
        let node = nodes.iter().find(|row| row[0] == tag).expect("a node");
        [1, 2].map(|axis| number(&node[axis]))
    };
    let links = table(&text, "LINKS");
    let directions = table(&text, "DIRECTIONS");
    // The one within a building joins two pairs of floors.
    assert_eq!([links.len(), directions.len()], [7, 7]);
    for (link, direction) in links.iter().zip(&directions) {
        assert_eq!(link[0], direction[0]);
        let [a, b] = [place(&link[1]), place(&link[2])];
        let [x, y] = [1, 2].map(|at| number(&direction[at]));
        let length = (b[0] - a[0]) * x + (b[1] - a[1]) * y;
        assert!((b[0] - a[0] - length * x).abs() + (b[1] - a[1] - length * y).abs() < 1e-9);
        assert!(length > 1.0, "{link:?}");
    }
    let springs = table(&text, "UPRIGHT_SPRINGS");
    let of_wall: Vec<[&str; 3]> = springs
        .iter()
        .map(|row| [3, 6, 7].map(|at| &row[at][..]))
        .collect();
    assert_eq!(
        of_wall,
        [
            ["1", "-1.0", "0.0"],
            ["2", "-1.0", "0.0"],
            ["6", "-1.0", "0.0"]
        ]
    );
    let materials = table(&text, "MATERIALS");
    let along = materials
        .iter()
        .find(|row| row[1] == springs[0][4])
        .expect("a material");
    assert_eq!([number(&along[2]), number(&along[3])], [300e6, 900e3]);
}

/// Panels that fall: those of the lowest storey in plan look at the floor above alone.
#[test]
fn panels_fall_by_the_accelerations_of_their_floors() {
    const MODEL: &str = include_str!("../../../jostle-validation/data/opensees/plan_falling.toml");
    let text = export(&model(MODEL)).expect("it can be exported").text;
    let panels = table(&text, "FALLING");
    assert_eq!(panels.len(), 2 * 2 + 2 * 2);
    for row in &panels {
        // 1.2 kPa over 1400 kg/m3 times 0.2 m.
        assert!((number(&row[0]) - 1200.0 / 280.0).abs() < 1e-12, "{row:?}");
    }
    let struts = table(&text, "DIAGONALS");
    assert_eq!(struts.len(), 2 * panels.len());
    let lowest = &text[text.find("\nFALLING = [").expect("the table")..];
    let lowest = lowest.lines().nth(2).expect("a row");
    let part = lowest.split("), (").collect::<Vec<_>>();
    assert_eq!(part[1], "-0.0, 1.0", "{lowest}");
    assert!(part[0].ends_with("0, (1002,"), "{lowest}");
}

/// Columns with a point between floors move there along their frame only: across, the footing has the lower half of them, along a quarter.
#[test]
fn footings_have_the_mass_of_columns_of_each_direction() {
    let text = r#"
[motion]
record = "el-centro-1940-ns"
[[building]]
name = "A"
kind = "frame"
storeys = 1
storey_height = "3.5 m"
plan = ["6 m", "6 m"]
mass = "50 t"
stiffness = { x = "0 N/m", y = "80 MN/m", torsion = "3 GN.m/rad" }
base = { horizontal_stiffness = "300 MN/m", mass = "30 t" }
frame = [{ at = [["0 m", "0 m"], ["0 m", "6 m"]], spans = ["6 m"], column = { width = "0.5 m", depth = "0.5 m" }, beam = { width = "0.3 m", depth = "0.5 m" }, elastic_modulus = "30 GPa", density = "2500 kg/m3", column_segments = 2 }]
"#;
    let exported = export(&model(text)).expect("it can be exported");
    let columns = 4.0 * 0.25 * 2500.0 * 3.5;
    let [along, across] = [0.25, 0.5].map(|share| 30e3 + share * columns);
    let nodes = table(&exported.text, "NODES");
    let masses = [format!("{along:?}"), format!("{across:?}")];
    let found = nodes.iter().any(|row| row[3..].starts_with(&masses));
    assert!(found, "{nodes:?}");
}

/// A foot that slides cannot follow a base that rocks in the other directions alone.
#[test]
fn feet_that_slide_on_a_base_that_rocks_are_refused() {
    let text = |base: &str| {
        format!(
            "[motion]\nrecord = \"el-centro-1940-ns\"\n[[building]]\nname = \"A\"\nkind = \"frame\"\nstoreys = 1\nstorey_height = \"3.5 m\"\nplan = [\"6 m\", \"6 m\"]\nmass = \"50 t\"\nstiffness = {{ x = \"0 N/m\", y = \"80 MN/m\", torsion = \"3 GN.m/rad\" }}\nbase = {{ {base} }}\nframe = [{{ at = [[\"0 m\", \"0 m\"], [\"0 m\", \"6 m\"]], spans = [\"6 m\"], column = {{ width = \"0.5 m\", depth = \"0.5 m\" }}, beam = {{ width = \"0.3 m\", depth = \"0.5 m\" }}, elastic_modulus = \"30 GPa\", wall = [{{ line = 1, length = \"1.5 m\", thickness = \"0.25 m\", shear_hinge = {{ rule = \"bilinear\", yield = \"900 kN\", post_yield = 0.02 }} }}] }}]\n"
        )
    };
    assert!(
        export(&model(&text(
            "horizontal_stiffness = \"300 MN/m\", mass = \"30 t\""
        )))
        .is_ok()
    );
    let faults = export(&model(&text("rotational_stiffness = \"30 GN.m/rad\"")));
    let faults = faults.expect_err("its feet slide");
    assert!(faults[0].problem.contains("feet that slide"), "{faults:?}");
}

/// Rigid arms are 1e5 times as stiff as the beams that they hold, however stiff the walls are that they belong to: with arms 1e6 times as
/// stiff as the walls, rounding gave OpenSees a second period 9 % too short where bearings stand below.
#[test]
fn rigid_arms_follow_the_members_that_they_hold() {
    let walls = |thickness: f64| {
        let text = format!(
            r#"
[motion]
record = "el-centro-1940-ns"
[[building]]
name = "lines"
kind = "frame"
storeys = 1
storey_height = 3.0
plan = [8.0, 6.0]
mass = 60e3
[[building.frame]]
at = [[0.0, 0.0], [0.0, 6.0]]
spans = [4.0, 4.0]
column = {{ width = 0.4, depth = 0.4 }}
beam = {{ width = 0.3, depth = 0.5 }}
beam_segments = 1
elastic_modulus = 3e10
[[building.frame.wall]]
line = 2
length = 1.0
thickness = {thickness}
[[building.frame]]
at = [[0.0, 0.0], [8.0, 0.0]]
direction = "y"
spans = [6.0]
column = {{ width = 0.4, depth = 0.4 }}
beam = {{ width = 0.3, depth = 0.5 }}
elastic_modulus = 3e10
"#
        );
        let text = export(&model(&text)).expect("it can be exported").text;
        let rows = table(&text, "COLUMNS_AND_BEAMS");
        rows.iter().map(|row| number(&row[3])).collect::<Vec<_>>()
    };
    let [thin, thick] = [0.1, 0.9].map(walls);
    // E b h^3 / 12 over 4 m less half of the wall, and an arm of that half.
    let beam = 3e10 * 0.3 * 0.125 / 12.0;
    let due = 1e5 * 4.0 * beam / 3.5 * 0.5;
    for rows in [thin, thick] {
        let arms = rows
            .iter()
            .filter(|value| **value > 1e11 && (*value / due - 1.0).abs() < 1e-12);
        assert_eq!(arms.count(), 4, "{rows:?}, {due}");
        assert!(rows.iter().all(|value| *value < 1.001 * due), "{rows:?}");
    }
}
