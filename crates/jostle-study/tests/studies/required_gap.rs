//! The page of a study names the gaps that `jostle gap` finds by rules.

use std::path::Path;

use jostle_io::shown::LENGTH;
use jostle_io::{Format, StudyFile};
use jostle_run::{CriticalGap, GapSettings, critical_gaps};
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

/// The page of the study of a model, and what a search of its gap finds.
fn page_and_search(model: &str) -> (String, CriticalGap) {
    of_study(model, STUDY)
}

/// The same of another study.
fn of_study(model: &str, study: &str) -> (String, CriticalGap) {
    let folder = tempfile::tempdir().expect("a folder");
    let path: &Path = folder.path();
    std::fs::write(path.join("pair.toml"), model).expect("the model");
    let file = StudyFile::parse("study.toml", study, Format::Toml, path, None);
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

    let input = sound(model);
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
    (page, found.into_iter().next().expect("a gap"))
}

/// Cells of a table: the widths of some rules.
fn cells(found: &CriticalGap, rules: &[&str]) -> String {
    let cell = |name: &&str| {
        let rule = found.rules.iter().find(|rule| rule.rule == **name);
        number(&LENGTH.rounded_up(rule.unwrap_or_else(|| panic!("{name}")).gap_m))
    };
    rules.iter().map(cell).collect()
}

fn number(text: &str) -> String {
    format!("<td class=\"number\">{text}</td>")
}

#[test]
fn rules_of_a_study_are_those_of_the_gap() {
    let (page, found) = page_and_search(SET_BACK);
    // What touches is the podium, whose floor lies at 3 m.
    assert_eq!(found.height_m, 3.0);
    let cells = cells(&found, &["ABS", "SRSS", "DDC"]);
    // No gap of the study is hit, and floors above the podium close further than it: the narrowest is all that is known.
    for text in [
        &cells[..],
        &number("≤ 150"),
        "ABS [mm]",
        "Gap needed over peak ground acceleration",
    ] {
        assert!(page.contains(text), "{text}");
    }
}

/// Where no gap of the study is hit and all contacts are equally far apart, the closing is the gap needed itself.
#[test]
fn the_gap_needed_of_a_study_is_that_of_a_search() {
    let set_back = "[[building.column]]\nline = 3\nstoreys = [2, 3]\nomit = true\n";
    let straight = SET_BACK.replace(set_back, "");
    assert_ne!(straight, SET_BACK);
    let (page, found) = page_and_search(&straight);
    let needed = number(&LENGTH.rounded_up(found.gap_m));
    let row = needed + &cells(&found, &["ABS", "SRSS"]);
    assert!(page.contains(&row), "{row}");
}

/// Runs without contact know the gap needed, also where every gap of the study is hit.
#[test]
fn the_gap_needed_beyond_all_gaps_is_that_of_runs_without_contact() {
    let set_back = "[[building.column]]\nline = 3\nstoreys = [2, 3]\nomit = true\n";
    let straight = SET_BACK.replace(set_back, "");
    let narrow = STUDY.replace("\"150 mm\", \"200 mm\"", "\"5 mm\", \"10 mm\"");
    let (page, found) = of_study(&straight, &narrow);
    assert!(found.gap_m > 0.02, "{}", found.gap_m);
    let needed = number(&LENGTH.rounded_up(found.gap_m));
    assert!(!page.contains(&needed), "known without such runs");
    let (page, _) = of_study(&straight, &format!("without_contact = true\n{narrow}"));
    assert!(page.contains(&needed), "{needed}");
}
