//! From reinforced frames to the first member beyond its capacity: text, JSON, tables and report.

use std::path::Path;

use jostle::{Column, EnergyTerm};
use jostle_io::{Values, summary_json};
use jostle_run::{Content, Ran, summary_text};

use crate::support::ran;

const MODEL: &str = r#"
title = "Two reinforced frames, 10 mm apart"
[motion]
record = "el-centro-1940-ns"
pga = "0.4 g"
duration = "8 s"

[[building]]
name = "J1"
kind = "frame"
storeys = 5
storey_height = "3.2 m"
spans = ["2.4 m", "6.0 m"]
column = { width = "500 mm", depth = "500 mm", concrete = "C30", steel = "HRB400", bars = "12 d20", ties = "d10 @ 150 mm" }
beam = { width = "300 mm", depth = "600 mm", concrete = "C30", steel = "HRB400", bars = "4 d25 top, 3 d25 bottom", ties = "d8 @ 150 mm" }
beam_mass = "3600 kg/m"
MORE

[[building]]
name = "J2"
kind = "frame"
storeys = 4
storey_height = ["4.8 m", "3.2 m", "3.2 m", "3.2 m"]
spans = ["6.0 m", "6.0 m"]
column = { width = "600 mm", depth = "600 mm", concrete = "C30", steel = "HRB400", bars = "16 d22", ties = "d10 @ 150 mm" }
beam = { width = "300 mm", depth = "600 mm", concrete = "C30", steel = "HRB400", bars = "4 d25 top, 3 d25 bottom", ties = "d8 @ 150 mm" }
beam_mass = "3600 kg/m"
MORE

[[gap]]
between = ["J1", "J2"]
width = "10 mm"
floors = "all"
law = "hertz-damp"
stiffness = "2e9 N/m^1.5"
restitution = 0.65

[output]
"#;

fn run(more: &str, output: &str) -> Ran {
    let text = format!("{}{output}\n", MODEL.replace("MORE", more));
    ran(&text)
}

/// Contacts on columns between floors: the recorded force is Hertz's law of the recorded closing, and columns keep their
/// places.
#[test]
fn histories_hold_the_closing_of_struck_columns() {
    for solver in ["modal", "riccati"] {
        let output = format!("[analysis]\nsolver = \"{solver}\"");
        let text = MODEL
            .replace("MORE", "")
            .replace("restitution = 0.65", "")
            .replace("hertz-damp", "hertz")
            .replace("[output]", "");
        let ran = ran(&(text + &output));
        let history = ran.outcome.history.as_ref().expect("recorded");
        let mut struck = 0;
        for (contact, one) in ran.prepared.system.contacts.iter().enumerate() {
            let closing = history.column(Column::closing(contact));
            assert_eq!(closing.is_some(), one.is_between_floors());
            let Some(closing) = closing else { continue };
            let force = history
                .column(Column::contact_force(contact))
                .expect("recorded");
            let most = force.iter().copied().fold(0.0, f64::max);
            struck += usize::from(most > 0.0);
            for (u, force) in closing.iter().zip(&force) {
                let law = 2e9 * (u - one.width).max(0.0).powf(1.5);
                assert!(
                    (force - law).abs() <= 1e-6 * most,
                    "{solver}: {force} N recorded, {law} N by the law"
                );
            }
        }
        assert!(struck > 1, "{solver}: {struck} contacts were struck");
        // What comes behind is still the energies, and they balance.
        let of = |term| history.column(Column::energy(term)).expect("recorded");
        let [input, parts @ ..] = EnergyTerm::ALL.map(of);
        let last = history.len() - 1;
        let sum: f64 = parts.iter().map(|part| part[last]).sum();
        assert!(
            (input[last] - sum).abs() < 1e-6 * input[last],
            "{solver}: {} and {sum}",
            input[last]
        );
    }
}

/// Writes the files of a run; returns the report and the names.
fn written(ran: &Ran, name: &str) -> (String, Vec<String>) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    let summary = ran.summary();
    ran.results(&summary)
        .write(&folder, Content::ALL)
        .expect("written");
    let names = std::fs::read_dir(&folder).expect("listed");
    let names =
        names.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()));
    let report = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    (report, names.collect())
}

#[test]
fn a_run_says_which_member_goes_first() {
    let ran = run("", "members = true");
    let summary = ran.summary();
    let text = summary_text(&summary, &ran.prepared.input);
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| line.starts_with("capacity") || line.contains("× capacity"))
        .collect();
    assert!((1..=2).contains(&lines.len()), "{text}");
    assert!(
        lines[0].contains("gb50010") && lines[0].contains("first"),
        "{text}"
    );
    // Every joint of both frames is rated; by the statics of a joint, its shear exceeds that of its columns.
    let joints = summary.buildings.iter().map(|b| b.joints.len());
    assert_eq!(joints.collect::<Vec<_>>(), [15, 12]);
    for building in &summary.buildings {
        let capacity = building.capacity.as_ref().expect("known");
        let rated = building
            .joints
            .iter()
            .filter_map(|joint| joint.ratio.as_ref());
        let exceeded = rated.clone().filter(|ratio| ratio.shear > 1.0).count();
        assert_eq!(capacity.joints_rated, building.joints.len());
        assert_eq!(capacity.joints_exceeded, exceeded);
        let first = rated.filter_map(|ratio| ratio.shear_at.exceeded_s);
        let first = first.min_by(f64::total_cmp);
        assert_eq!(capacity.first_joint.as_ref().map(|own| own.at_s), first);
        for joint in &building.joints {
            let ratio = joint.ratio.as_ref().expect("by the governing rule");
            assert_eq!(ratio.rule, "gb50010");
            let others: Vec<_> = joint
                .other_ratios
                .iter()
                .map(|other_ratios| other_ratios.rule)
                .collect();
            assert_eq!(others, ["en1998-3", "aci318"]);
            assert!(
                ratio.shear > 0.0 && joint.shear_peak_n > 1e4,
                "{}",
                joint.name
            );
        }
    }
    let json: serde_json::Value = serde_json::from_str(&summary_json(&summary)).expect("JSON");
    let building = &json["buildings"][0];
    let first = &building["capacity"]["first"];
    assert!(
        first["member"]
            .as_str()
            .is_some_and(|name| name.starts_with("J1.")),
        "{first}"
    );
    let column = &building["members"][0]["ratio"];
    assert_eq!(column["rule"], "gb50010");
    for kind in ["shear", "bending"] {
        assert!(
            column[kind].as_f64().is_some_and(|ratio| ratio > 0.0),
            "{column}"
        );
    }
    assert_eq!(
        building["members"][0]["other_ratios"]
            .as_array()
            .map(Vec::len),
        Some(4)
    );
    assert!(
        building["members"][0]["axial_failure"]["drift"]
            .as_f64()
            .is_some_and(|d| (0.005..0.1).contains(&d))
    );
    // The table has the joints below the members of their building, in shear only.
    let columns = jostle_io::capacity_columns(&summary, Some(0));
    let of = |name: &str| {
        let mut all = columns.iter();
        let found = all.find(|(candidate, _)| *candidate == name);
        &found.unwrap_or_else(|| panic!("no column {name}")).1
    };
    let (Values::Text(names), Values::Instant(shear), Values::Instant(bending)) =
        (of("member"), of("shear_ratio"), of("bending_ratio"))
    else {
        panic!("other types")
    };
    let joints: Vec<usize> = (0..names.len())
        .filter(|row| names[*row].starts_with("J1.joint."))
        .collect();
    // Three rules have a clause for joints.
    assert_eq!(joints.len(), 3 * summary.buildings[0].joints.len());
    assert_eq!(joints.first(), Some(&(names.len() - joints.len())));
    let first = &summary.buildings[0].joints[0];
    assert_eq!(names[joints[0]], first.name);
    assert_eq!(shear[joints[0]], first.ratio.as_ref().map(|own| own.shear));
    assert!(
        joints
            .iter()
            .all(|row| bending[*row].is_none() && shear[*row].is_some())
    );
    let (report, names) = written(&ran, "elastic");
    assert!(
        names.iter().any(|name| name == "capacity.parquet"),
        "{names:?}"
    );
    for word in [
        "ratio-beyond",
        "Force diagrams of J1",
        "11.4.6",
        "Moment, envelope",
        "exceed their capacity",
    ] {
        assert!(report.contains(word), "the report lacks {word}");
    }
}

#[test]
fn nothing_is_said_unless_asked_for() {
    let ran = run("", "members = false");
    let summary = ran.summary();
    // But that nobody asked.
    let said = summary_text(&summary, &ran.prepared.input);
    let lines: Vec<&str> = said
        .lines()
        .filter(|line| line.contains("capacity"))
        .collect();
    assert!(
        matches!(lines[..], [line] if line.contains("add members = true")),
        "{lines:?}"
    );
    let json = summary_json(&summary);
    assert!(!json.contains("\"ratio\"") && !json.contains("\"capacity\""));
}

#[test]
fn yielding_members_are_held_against_accepted_rotations() {
    let ran = run(
        "hinges = { rule = \"peak-oriented\", from = \"section\" }\ngravity = true",
        "capacity = [\"asce41\", \"en1998-3\"]",
    );
    let summary = ran.summary();
    let members = summary
        .buildings
        .iter()
        .flat_map(|building| &building.members);
    let accepted: Vec<_> = members.flat_map(|member| &member.acceptance).collect();
    for rule in ["en1998-3", "asce41", "section"] {
        let acceptance = accepted.iter().filter(|acceptance| acceptance.rule == rule);
        assert!(acceptance.clone().count() > 0, "{rule}");
        assert!(
            acceptance
                .clone()
                .any(|acceptance| acceptance.rotation_rad > 0.0),
            "{rule}"
        );
        for acceptance in acceptance {
            let kept = acceptance
                .limits
                .iter()
                .find(|limit| acceptance.rotation_rad <= limit.rotation_rad);
            assert_eq!(acceptance.level, kept.map(|limit| limit.level));
            assert!(
                acceptance
                    .limits
                    .windows(2)
                    .all(|pair| pair[0].rotation_rad <= pair[1].rotation_rad)
            );
        }
    }
    // Hinges hold moments near the capacity of their sections: yield moments by formula, capacity by fibres.
    let worst = summary
        .buildings
        .iter()
        .flat_map(|building| &building.members);
    let bending = worst.filter_map(|member| Some(member.ratio.as_ref()?.bending));
    let greatest = bending.fold(0.0, f64::max);
    assert!((0.8..1.6).contains(&greatest), "{greatest}");
    let (report, _) = written(&ran, "yielding");
    assert!(report.contains("rotation within"));
}
