//! Sentences that say what is, and nothing that is not.

use jostle_run::{Opened, check, summary_text};
use jostle_testkit::files::sound;

use crate::support::ran;

const MOTION: &str =
    "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"3 s\"\n";

/// A space frame of one bay each way.
const FRAME: &str = r#"
[[building]]
name = "F"
kind = "space-frame"
storeys = 2
storey_height = "3.3 m"
lines_x = ["0 m", "6 m"]
lines_y = ["0 m", "5 m"]
mass = "60 t"
"#;

/// The same of concrete.
fn concrete(more: &str) -> String {
    format!(
        "{MOTION}{FRAME}concrete = \"C30\"\ncolumn = {{ size = [\"400 mm\", \"400 mm\"] }}\nbeam_x = {{ width = \"300 mm\", depth = \"500 mm\" }}\nbeam_y = {{ width = \"300 mm\", depth = \"500 mm\" }}\n{more}"
    )
}

fn checked(text: &str) -> String {
    let opened = Opened::new(sound(text), "model").unwrap_or_else(|error| panic!("{error}"));
    let checked = check(&opened).unwrap_or_else(|error| panic!("{error}"));
    checked.text
}

#[test]
fn capacities_of_steel_are_judged_in_the_report() {
    let members = r#"
column = { profile = "HEB300", yield_strength = "355 MPa" }
beam_x = { profile = "HEA320", yield_strength = "355 MPa" }
beam_y = { profile = "HEA320", yield_strength = "355 MPa" }
[output]
members = true
"#;
    let ran = ran(&format!("{MOTION}{FRAME}{members}"));
    let summary = ran.summary();
    let capacity = summary.buildings[0].capacity.as_ref().expect("rated");
    assert_eq!(capacity.rule, "aisc360");
    let report = ran.results(&summary).report().expect("histories");
    let section = report.split("id=\"members\"").nth(1).expect("a section");
    for said in [
        "Capacity by AISC 360-16, chapters E to H".to_owned(),
        format!("Greatest ratio {:.2}: ", capacity.worst.ratio),
    ] {
        assert!(section.contains(&said), "{said}");
    }
}

#[test]
fn struts_without_a_strength_have_no_stages() {
    let infill = "[[building.infill]]\nalong = \"x\"\nmodulus = \"4 GPa\"\nthickness = \"200 mm\"\nwidth = \"mainstone\"\n";
    let strength = "strength = { rule = \"bertoldi\", compression = \"4 MPa\", shear = \"0.3 MPa\", sliding = \"0.2 MPa\" }\n";
    for (more, is_said) in [("", false), (strength, true)] {
        let ran = ran(&concrete(&format!("{infill}{more}")));
        let summary = ran.summary();
        let text = summary_text(&summary, &ran.prepared.input);
        assert_eq!(text.contains("infill struts cracked"), is_said, "{text}");
        // No friction and no impact: nothing to say of light impacts.
        assert!(!text.contains("light impacts"), "{text}");
    }
}

#[test]
fn soil_and_its_lifting_foundation_are_told_as_they_act() {
    let frame = r#"
[soil]
shear_wave_velocity = "140 m/s"
density = "1800 kg/m3"
poisson_ratio = 0.4
damping = 0.05
[[building]]
name = "A"
storeys = 3
storey_height = "3 m"
spans = ["4.5 m", "4.5 m"]
column = { width = "600 mm", depth = "400 mm" }
beam = { width = "300 mm", depth = "500 mm" }
concrete = "C25"
beam_mass = "35 kN/m"
damping = { ratio = 0.03 }
gravity = true
[building.foundation]
length = "9 m"
width = "6 m"
mass = "60 t"
uplift = true
springs = 11
"#;
    let text = checked(&format!("{MOTION}{frame}"));
    assert!(
        text.contains("columns axially rigid (default on a foundation on soil)"),
        "{text}"
    );
    assert!(
        !text.contains("multiply-adds") && !text.contains("entries of L"),
        "{text}"
    );
    let ran = ran(&format!("{MOTION}{frame}"));
    let summary = ran.summary();
    let soil = summary.buildings[0].foundation.as_ref().expect("on soil");
    let said = format!(
        "on soil, the first period lengthens from {:.3} to {:.3} s and damping rises from {:.2} to {:.2} %",
        soil.period_s / soil.period_ratio,
        soil.period_s,
        100.0 * soil.damping_ratio_fixed,
        100.0 * soil.damping_ratio
    );
    let text = summary_text(&summary, &ran.prepared.input);
    assert!(text.contains(&said), "{said} in {text}");
}

/// Factors on the rigidities of a wall are named in space as in a plane; GA of other members is not that of the wall.
#[test]
fn walls_say_their_factors_and_members_their_own_shear() {
    let wall = "[[building.wall]]\nalong = \"x\"\nx = 1\ny = 1\nlength = \"2 m\"\nthickness = \"250 mm\"\nstiffness_factor = \"en1998\"\n";
    let text = checked(&concrete(wall));
    assert!(
        text.contains("(factors 0.500 on EI, 0.500 on GA)"),
        "{text}"
    );
    let plane = r#"
[[building]]
name = "W"
storeys = 3
storey_height = "3 m"
spans = ["6 m"]
concrete = "C30"
beam_mass = "30 kN/m"
column = { width = "500 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "500 mm" }
[[building.wall]]
line = 1
length = "2 m"
thickness = "250 mm"
"#;
    let text = checked(&format!("{MOTION}{plane}"));
    assert!(
        text.contains("  wall 1 at 0 m") && !text.contains("members deform in shear"),
        "{text}"
    );
}

#[test]
fn a_weak_motion_across_is_noted() {
    let across = |across: &str| {
        let motion = MOTION.replace("pga", &format!("across = {across}\npga"));
        checked(&concrete("").replace(MOTION, &motion))
    };
    let taken = across("\"nanjing-artificial\"");
    assert!(
        taken.contains("nanjing-artificial across takes the factor of el-centro-1940-ns"),
        "{taken}"
    );
    let own = across("{ record = \"nanjing-artificial\", pga = \"0.25 g\" }");
    assert!(!own.contains("takes the factor"), "{own}");
    let same = across("\"el-centro-1940-ns\"");
    assert!(!same.contains("takes the factor"), "{same}");
}

/// Braces buckle or yield, and do not crack.
#[test]
fn braces_that_buckle_are_not_said_to_crack() {
    let frame = r#"
[[building]]
name = "S"
storeys = 2
storey_height = "3.5 m"
spans = ["6 m"]
column = { profile = "HEB300" }
beam = { profile = "IPE400" }
beam_mass = "90 kN/m"
damping = { ratio = 0.02 }
[[building.brace]]
direction = "both"
profile = "HEA120"
hinge = { rule = "buckling", curve = "c", yield_strength = "355 MPa", effective_length = 0.5 }
"#;
    let ran = ran(&format!("{MOTION}{frame}").replace("0.3 g", "0.6 g"));
    let summary = ran.summary();
    assert!(summary.buildings[0].hinges.yielded > 0, "no brace buckles");
    let report = ran.results(&summary).report().expect("histories");
    let table = report.split("id=\"hinge-table\"").nth(1).expect("a table");
    let table = table.split("</table>").next().expect("its end");
    assert!(table.contains("yielded or buckled"), "{table}");
    // Of every row: number, place, when it cracked.
    let rows = table.split("<tr").skip(2);
    for row in rows {
        let cracked = row.split("<td").nth(3).expect("a cell");
        assert!(cracked.contains(">–<"), "{row}");
    }
}
