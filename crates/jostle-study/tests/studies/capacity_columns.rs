//! Columns of studies for members beyond their capacity.

use std::ops::ControlFlow;
use std::path::Path;

use jostle_io::{Format, ModelTree, StudyFile};
use jostle_study::dataset::read_columns;
use jostle_study::{CaseCache, RunSettings, Study, run};

const MODEL: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "PGA"
duration = "4 s"
[[building]]
name = "J1"
storeys = 2
storey_height = "3.2 m"
spans = ["6 m"]
concrete = "C30"
column = { width = "500 mm", depth = "500 mm", steel = "HRB400", bars = "12 d20", ties = "d10 @ 150 mm" }
beam = { width = "300 mm", depth = "600 mm", steel = "HRB400", bars = "4 d25 top, 3 d25 bottom", ties = "d8 @ 150 mm" }
beam_mass = "6000 kg/m"
[output]
members = true
"#;

/// Greatest ratio, members beyond their capacity, and the first instant, from a single run.
fn single(pga: &str) -> [Option<f64>; 3] {
    let text = MODEL.replace("PGA", pga);
    let tree = ModelTree::parse("m", &text, Format::Toml, Path::new(""))
        .unwrap_or_else(|error| panic!("{error}"));
    let input = tree.input().unwrap_or_else(|error| panic!("{error}"));
    let prepared = CaseCache::default()
        .assemble(input)
        .unwrap_or_else(|error| panic!("{error}"));
    let settings = prepared.settings(false);
    let ran = prepared.run(settings, &mut |_, _| ControlFlow::Continue(()));
    let summary = ran.summary();
    let capacity = summary.buildings[0].capacity.as_ref().expect("rated");
    let first = capacity.first.as_ref().map(|first| first.at_s);
    [
        Some(capacity.worst.ratio),
        Some(capacity.exceeded as f64),
        first,
    ]
}

#[test]
fn a_study_has_the_capacities_of_single_runs() {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let model = MODEL.replace("PGA", "0.1 g");
    std::fs::write(folder.path().join("frame.toml"), model)
        .unwrap_or_else(|error| panic!("{error}"));
    let text = "base = \"frame.toml\"\n[[vary]]\npath = \"motion.pga\"\nvalues = [\"0.01 g\", \"0.8 g\"]\n";
    let file = StudyFile::parse("study.toml", text, Format::Toml, folder.path(), None);
    let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")))
        .unwrap_or_else(|error| panic!("{error}"));
    let out = folder.path().join("out");
    let settings = RunSettings::default();
    run(&study, &out, &settings, &|| false, &|_| {}, &|_| {})
        .unwrap_or_else(|error| panic!("{error}"));
    let names = [
        "J1.capacity_ratio",
        "J1.capacity_exceeded",
        "J1.capacity_first_s",
    ];
    let table = read_columns(&study, &out, &names).unwrap_or_else(|error| panic!("{error}"));
    for (case, pga) in ["0.01 g", "0.8 g"].into_iter().enumerate() {
        let found = names.map(|name| table.numbers[name][case]);
        assert_eq!(found, single(pga), "{pga}");
    }
    let exceeded = &table.numbers[names[1]];
    assert!(exceeded[0] == Some(0.0) && exceeded[1] > Some(0.0));
}
