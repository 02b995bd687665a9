//! The page of a study names the gaps that `jostle gap` finds by rules.

use std::path::Path;

use jostle_io::shown::LENGTH;
use jostle_io::{Format, StudyFile};
use jostle_run::{GapSettings, critical_gaps};
use jostle_study::{RunSettings, Study, finish, run};
use jostle_testkit::files::sound;

/// A frame whose upper storeys stand 4 m behind its podium: its roof is the highest floor, but cannot touch.
const SET_BACK: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "5 s"
[[building]]
name = "Tower"
storeys = 3
storey_height = "3 m"
spans = ["4 m", "4 m"]
concrete = "C30"
beam_mass = "6 t/m"
beam = { width = "300 mm", depth = "500 mm" }
[[building.column]]
width = "400 mm"
depth = "400 mm"
[[building.column]]
line = 3
storeys = [2, 3]
omit = true
[[building]]
name = "Beside"
kind = "shear"
mass = ["60 t", "60 t", "50 t"]
stiffness = ["60 MN/m", "60 MN/m", "50 MN/m"]
storey_height = "3 m"
[[gap]]
between = ["Tower", "Beside"]
width = "200 mm"
"#;

const STUDY: &str = r#"
base = "pair.toml"
[[vary]]
name = "gap"
path = "gap[0].width"
values = ["150 mm", "200 mm"]
[[vary]]
name = "pga"
path = "motion.pga"
values = ["0.2 g", "0.3 g"]
"#;

#[test]
fn rules_of_a_study_are_those_of_the_gap() {
    let folder = tempfile::tempdir().expect("a folder");
    let path: &Path = folder.path();
    std::fs::write(path.join("pair.toml"), SET_BACK).expect("the model");
    let file = StudyFile::parse("study.toml", STUDY, Format::Toml, path, None);
    let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")));
    let study = study.unwrap_or_else(|error| panic!("{error}"));
    let out = path.join("out");
    let done = run(
        &study,
        &out,
        &RunSettings::default(),
        &|| false,
        &|_| {},
        &|_| {},
    );
    assert!(done.unwrap_or_else(|error| panic!("{error}")).complete);
    finish(&study, &out, false).unwrap_or_else(|error| panic!("{error}"));
    let page = std::fs::read_to_string(out.join("report.html")).expect("the page");
    let page = page.replace(" class=\"\"", "");

    let input = sound(SET_BACK);
    let opened = jostle_run::Opened::new(input, "pair".to_owned());
    let opened = opened.unwrap_or_else(|error| panic!("{error}"));
    let (motion, _) = opened.plan_of(&opened.input).expect("a plan");
    let settings = GapSettings {
        outcomes: false,
        reversed: false,
        codes: opened.input.codes.clone(),
        ..GapSettings::default()
    };
    let found = critical_gaps(&opened.input.model, &motion, &settings, &|| false);
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    // What touches is the podium, whose floor lies at 3 m.
    assert_eq!(found[0].height_m, 3.0);
    let width = |name: &str| {
        let rule = found[0].rules.iter().find(|rule| rule.rule == name);
        LENGTH.rounded_up(rule.unwrap_or_else(|| panic!("{name}")).gap_m)
    };
    let cells = ["ABS", "SRSS", "DDC"].map(|name| format!("<td>{}</td>", width(name)));
    assert!(page.contains(&cells.concat()), "{cells:?}");
    // No gap of the study is hit, so that the narrowest is all that is known.
    for head in [
        "<td>≤ 150</td>",
        "ABS [mm]",
        "Gap needed over peak ground acceleration",
    ] {
        assert!(page.contains(head), "{head}");
    }
}
