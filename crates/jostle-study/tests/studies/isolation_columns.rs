//! Columns of studies for bearings, and the least of them that `jostle size` finds.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use jostle::results::summary::IsolationSummary;
use jostle_io::{Format, ModelTree, StudyFile};
use jostle_study::dataset::read_columns;
use jostle_study::size::{SizeProblem, SizeRequest};
use jostle_study::{CaseCache, RunSettings, Study, run};

/// One building in one plane on bearings, or with a plan; with a limit or a stop.
fn model(plan: &str, more: &str) -> String {
    format!(
        r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.3 g"
duration = "6 s"
[[building]]
name = "A"
kind = "shear"
{plan}
mass = ["180 t", "160 t"]
stiffness = "150 MN/m"
storey_height = "3.3 m"
damping = {{ ratio = 0.03 }}
[building.isolation]
kind = "lead-rubber"
mat_mass = "150 t"
stiffness = "30 MN/m"
yield = "200 kN"
post_yield = 0.1
{more}
"#
    )
}

const PLAN: &str = "plan = [\"14 m\", \"9 m\"]";

fn tree(text: &str) -> ModelTree {
    ModelTree::parse("m", text, Format::Toml, Path::new(""))
        .unwrap_or_else(|error| panic!("{error}"))
}

/// The bearings of a single run.
fn single(text: &str) -> IsolationSummary {
    let input = tree(text).input().unwrap_or_else(|error| panic!("{error}"));
    let prepared = CaseCache::default()
        .assemble(input)
        .unwrap_or_else(|error| panic!("{error}"));
    let settings = prepared.settings(false);
    let ran = prepared.run(settings, &mut |_, _| ControlFlow::Continue(()));
    let summary = ran.summary();
    summary.buildings[0].isolation.clone().expect("isolated")
}

/// A study of two strengths of the lead.
fn study(folder: &Path, text: &str) -> Study {
    std::fs::write(folder.join("m.toml"), text).unwrap_or_else(|error| panic!("{error}"));
    let text = "base = \"m.toml\"\n[[vary]]\npath = \"building[0].isolation.yield\"\nvalues = [\"120 kN\", \"200 kN\"]\n";
    let file = StudyFile::parse("study.toml", text, Format::Toml, folder, None);
    Study::new(file.unwrap_or_else(|error| panic!("{error}")))
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_study_has_the_bearings_of_single_runs() {
    for (plan, more) in [
        ("", "limit = \"250 mm\""),
        (PLAN, "limit = \"250 mm\""),
        (PLAN, "stop = { at = \"30 mm\", stiffness = \"40 MN/m\" }"),
        ("", ""),
    ] {
        let text = model(plan, more);
        let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
        let study = study(folder.path(), &text);
        let out = folder.path().join("out");
        let settings = RunSettings::default();
        run(&study, &out, &settings, &|| false, &|_| {}, &|_| {})
            .unwrap_or_else(|error| panic!("{error}"));
        let all = study.layout.names();
        let names: Vec<&str> = all
            .iter()
            .copied()
            .filter(|name| name.starts_with("A.isolation_"))
            .collect();
        let has = |name: &str| names.contains(&&*format!("A.isolation_{name}"));
        assert_eq!(has("stroke_ratio"), more.contains("limit"), "{names:?}");
        assert_eq!(has("stop_force_peak_n"), more.contains("stop"), "{names:?}");
        assert_eq!(has("force_across_peak_n"), plan == PLAN, "{names:?}");
        let table = read_columns(&study, &out, &names).unwrap_or_else(|error| panic!("{error}"));
        for (case, strength) in ["120 kN", "200 kN"].into_iter().enumerate() {
            let single =
                single(&text.replace("yield = \"200 kN\"", &format!("yield = \"{strength}\"")));
            let peak = single.displacement_max_m.max(-single.displacement_min_m);
            let stroke = single.in_plan.map_or(peak, |plan| plan.stroke_peak_m);
            let left = single
                .in_plan
                .map_or(single.residual_m.abs(), |plan| plan.residual_stroke_m);
            let expected = [
                ("stroke_peak_m", Some(stroke)),
                ("residual_stroke_m", Some(left)),
                ("force_peak_n", Some(single.force_peak_n)),
                ("hysteretic_j", Some(single.hysteretic_j)),
                ("damped_j", Some(single.damped_j)),
                ("stop_force_peak_n", single.stop_force_peak_n),
                (
                    "stroke_ratio",
                    more.contains("limit").then_some(stroke / 0.25),
                ),
                (
                    "force_across_peak_n",
                    single.in_plan.map(|plan| plan.force_across_peak_n),
                ),
            ];
            for (name, value) in expected.into_iter().filter(|(name, _)| has(name)) {
                let found = table.numbers[&*format!("A.isolation_{name}")][case];
                assert_eq!(found, value, "{name} {strength} {more}");
            }
            for name in &names {
                assert!(table.numbers[*name][case].is_some(), "{name} is empty");
            }
        }
    }
}

#[test]
fn a_study_without_bearings_has_no_columns_of_them() {
    let text = model("", "");
    let fixed = text.split("[building.isolation]").next().expect("a part");
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.path().join("m.toml"), fixed).unwrap_or_else(|error| panic!("{error}"));
    let text =
        "base = \"m.toml\"\n[[vary]]\npath = \"motion.pga\"\nvalues = [\"0.1 g\", \"0.2 g\"]\n";
    let file = StudyFile::parse("study.toml", text, Format::Toml, folder.path(), None);
    let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")))
        .unwrap_or_else(|error| panic!("{error}"));
    let names = study.layout.names();
    assert!(
        !names.iter().any(|name| name.contains("isolation")),
        "{names:?}"
    );
}

/// The least strength of the lead that keeps the bearings within their limit: at it, the limit is used up.
#[test]
fn size_keeps_bearings_within_their_limit() {
    let text = model(PLAN, "limit = \"91 mm\"");
    let request = SizeRequest {
        vary: vec!["building[0].isolation.yield=60 kN..600 kN".to_owned()],
        keep: vec!["A.isolation_stroke_ratio <= 1".to_owned()],
        minimise: "building[0].isolation.yield".to_owned(),
        ..SizeRequest::default()
    };
    let problem = SizeProblem::new(tree(&text), &request).unwrap_or_else(|error| panic!("{error}"));
    let stop = Arc::new(AtomicBool::new(false));
    let found = problem.run(None, Some(1), &stop, Box::new(|_| {}));
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    let best = found.best().expect("one that keeps it");
    let strength = best.inputs[0].0.expect("a number");
    let isolation = single(&text.replace("yield = \"200 kN\"", &format!("yield = {strength}")));
    let ratio = isolation.stroke_ratio().expect("a limit");
    assert!(ratio <= 1.0 && ratio > 0.97, "{strength}: {ratio}");
    let less = single(&text.replace("yield = \"200 kN\"", &format!("yield = {}", 0.9 * strength)));
    assert!(less.stroke_ratio() > Some(1.0));
}
