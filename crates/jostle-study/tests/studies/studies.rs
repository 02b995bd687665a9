//! A study gives the same table however it is run, and the numbers of single runs.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use jostle::{Plan, Run, Settings, Summary, System, simulate};
use jostle_io::{Format, Overrides, StudyFile, builtin_model, read_model_text};
use jostle_study::dataset::read_columns;
use jostle_study::{CaseCache, Done, RunSettings, Study, StudyError, run};
use jostle_testkit::two_towers;

/// Two small towers that are hit within a few seconds.
const TOWERS: &str = concat!(
    r#"
[motion]
record = "el-centro-1940-ns"
duration = "6 s"
"#,
    two_towers!(2, 2),
    "[analysis]\ntolerance = 0.01\n",
);

fn file(study: &str) -> Result<StudyFile, jostle_io::InputError> {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.path().join("towers.toml"), TOWERS)
        .unwrap_or_else(|error| panic!("{error}"));
    StudyFile::parse("study.toml", study, Format::Toml, folder.path(), None)
}

fn study(text: &str) -> Study {
    let file = file(text).unwrap_or_else(|error| panic!("{error}"));
    Study::new(file).unwrap_or_else(|error| panic!("{error}"))
}

const GRID: &str = r#"
base = "towers.toml"
[[vary]]
name = "gap"
path = "gap[0].width"
range = { from = "2 mm", to = "40 mm", count = 10 }
[[vary]]
path = "motion.pga"
values = ["100 cm/s2", "0.2 g", 3.0, "400 gal", 4.5]
"#;

fn go(study: &Study, folder: &Path, settings: &RunSettings) -> Done {
    run(study, folder, settings, &|| false, &|_| {}, &|_| {})
        .unwrap_or_else(|error| panic!("{error}"))
}

fn jobs(jobs: usize) -> RunSettings {
    RunSettings {
        jobs: Some(jobs),
        ..RunSettings::default()
    }
}

/// Every file of the table, byte for byte.
fn parts(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder.join("cases")).unwrap_or_else(|error| panic!("{error}"));
    entries
        .map(|entry| {
            let path = entry.unwrap_or_else(|error| panic!("{error}")).path();
            let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{error}"));
            let name = path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            (name, bytes)
        })
        .collect()
}

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn threads_shards_and_interruptions_leave_no_trace() {
    let study = study(GRID);
    assert_eq!((study.design.cases, study.parts()), (50, 4));
    let whole = temporary();
    let done = go(&study, whole.path(), &jobs(1));
    assert!(done.complete && done.failed == 0);
    let expected = parts(whole.path());
    assert_eq!(expected.len(), 4);

    for threads in [2, 7] {
        let folder = temporary();
        go(&study, folder.path(), &jobs(threads));
        assert!(parts(folder.path()) == expected, "{threads} threads");
    }

    let folder = temporary();
    for shard in [2, 0, 1] {
        let settings = RunSettings {
            jobs: Some(2),
            shard,
            shards: 3,
            only: None,
        };
        let done = go(&study, folder.path(), &settings);
        assert_eq!(done.complete, shard == 1, "shard {shard} of 3");
    }
    assert!(parts(folder.path()) == expected, "three shards");

    let folder = temporary();
    let mut computed = 0;
    for limit in [3, 9, 1, 20, u64::MAX] {
        let begun = AtomicU64::new(0);
        let stop = || begun.load(Ordering::Relaxed) >= limit;
        let count = |progress: jostle_study::Progress| {
            begun.store(progress.computed, Ordering::Relaxed);
        };
        let done = run(&study, folder.path(), &jobs(3), &stop, &count, &|_| {});
        let done = done.unwrap_or_else(|error| panic!("{error}"));
        computed += done.progress.computed;
        assert_eq!(done.complete, limit == u64::MAX);
    }
    assert_eq!(computed, 50, "no case was lost, none computed twice");
    assert!(parts(folder.path()) == expected, "five interruptions");
    assert!(
        !folder.path().join("under-way").exists(),
        "journals are cleared away"
    );
}

#[test]
fn two_runs_on_one_folder_share_the_work() {
    let study = study(GRID);
    let alone = temporary();
    go(&study, alone.path(), &jobs(1));
    let folder = temporary();
    let (first, second) = std::thread::scope(|scope| {
        let other = scope.spawn(|| go(&study, folder.path(), &jobs(1)));
        let go = go(&study, folder.path(), &jobs(1));
        (
            go,
            other
                .join()
                .unwrap_or_else(|_| panic!("the other run failed")),
        )
    });
    assert!(first.complete && second.complete);
    assert_eq!(
        first.progress.computed + second.progress.computed,
        50,
        "every case once: {first:?} {second:?}"
    );
    assert!(parts(folder.path()) == parts(alone.path()));
}

/// The numbers of a row are those of a run that was asked for by hand.
#[test]
fn rows_hold_the_numbers_of_single_runs() {
    let study = study(GRID);
    let folder = temporary();
    go(&study, folder.path(), &jobs(2));
    let wanted = [
        "gap_m",
        "motion.pga_m_s2",
        "peak_force_n",
        "impact_count",
        "first_impact_s",
        "A.floor2.displacement_max_m",
        "energy_input_j",
        "steps",
    ];
    let table = read_columns(&study, folder.path(), &wanted).unwrap_or_else(|e| panic!("{e}"));
    for (case, gap, pga) in [
        (0, 0.002, 1.0),
        (6, 0.002 + 0.038 / 9.0, 0.2 * 9.80665),
        (24, 0.002 + 0.038 * 4.0 / 9.0, 4.5),
    ] {
        let input = read_model_text("towers", TOWERS, Format::Toml, Path::new(""));
        let mut input = input.unwrap_or_else(|error| panic!("{error}"));
        let overrides = Overrides {
            pga: Some(pga),
            gap: Some(gap),
            record: None,
            angle: None,
        };
        input
            .apply(&overrides)
            .unwrap_or_else(|error| panic!("{error}"));
        let system = System::assemble(&input.model).unwrap_or_else(|faults| panic!("{faults:?}"));
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::choose(&system, &motion, &input.model.analysis);
        let plan = plan.unwrap_or_else(|faults| panic!("{faults:?}"));
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        let summary = Summary::new(&Run {
            model: &input.model,
            system: &system,
            motion: &motion,
            plan: &plan,
            outcome: &outcome,
            without_contact: None,
            wall: 0.0,
        });
        let number = |name: &str| table.numbers[name][case];
        let near = |name: &str, expected: f64| {
            let found = number(name).unwrap_or(f64::NAN);
            assert!(
                (found - expected).abs() <= 1e-12 * expected.abs().max(1e-9),
                "case {case}: {name} {found} instead of {expected}"
            );
        };
        near("gap_m", gap);
        near("motion.pga_m_s2", pga);
        // The gap of the file is a decimal text, that of the option a product: the last digit may differ.
        let close = |name: &str, expected: f64| {
            let found = number(name).unwrap_or(f64::NAN);
            assert!(
                (found - expected).abs() <= 1e-6 * expected.abs(),
                "case {case}: {name} {found} instead of {expected}"
            );
        };
        assert!(summary.gaps[0].impact_count > 0, "case {case} has impacts");
        close("peak_force_n", summary.gaps[0].peak_force_n);
        close(
            "first_impact_s",
            summary.gaps[0].first_impact_s.unwrap_or(f64::NAN),
        );
        close(
            "A.floor2.displacement_max_m",
            summary.buildings[0].floors[1].response.displacement_max_m,
        );
        close("energy_input_j", summary.energy.input_j);
        assert_eq!(
            number("impact_count"),
            Some(summary.gaps[0].impact_count as f64)
        );
        assert_eq!(number("steps"), Some(summary.work.steps as f64));
    }
}

#[test]
fn a_case_that_cannot_be_computed_is_a_row_with_its_reason() {
    let text = r#"
base = "towers.toml"
[design]
kind = "random"
samples = 40
seed = 3
[[vary]]
name = "gap"
path = "gap[0].width"
distribution = { kind = "normal", mean = "20 mm", deviation = "9 mm" }
"#;
    let study = study(text);
    let folder = temporary();
    let done = go(&study, folder.path(), &jobs(2));
    let table = read_columns(
        &study,
        folder.path(),
        &["status", "reason", "gap_m", "impact_count"],
    );
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    let mut failed = 0;
    for case in 0..40 {
        let gap = table.numbers["gap_m"][case].unwrap_or(f64::NAN);
        let (status, reason) = (&table.texts["status"][case], &table.texts["reason"][case]);
        if gap < 0.0 {
            failed += 1;
            assert_eq!(status, "failed", "gap {gap}");
            assert!(reason.contains("gap[0].width"), "{reason}");
            assert_eq!(table.numbers["impact_count"][case], None);
        } else {
            assert_eq!((&status[..], &reason[..]), ("completed", ""), "gap {gap}");
        }
    }
    assert!(failed > 0, "this seed draws a negative gap");
    assert_eq!(done.failed, failed);
}

#[test]
fn a_folder_belongs_to_one_study() {
    let folder = temporary();
    go(&study(GRID), folder.path(), &jobs(1));
    let other = study(&GRID.replace("count = 10", "count = 9"));
    match run(&other, folder.path(), &jobs(1), &|| false, &|_| {}, &|_| {}) {
        Err(StudyError::Folder(text)) => {
            assert!(text.contains("the study file has changed"), "{text}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn parts_without_a_manifest_are_not_taken_for_ours() {
    let folder = temporary();
    go(&study(GRID), folder.path(), &jobs(1));
    std::fs::remove_file(folder.path().join("manifest.json"))
        .unwrap_or_else(|error| panic!("{error}"));
    match run(
        &study(GRID),
        folder.path(),
        &jobs(1),
        &|| false,
        &|_| {},
        &|_| {},
    ) {
        Err(StudyError::Folder(text)) => assert!(text.contains("no manifest.json"), "{text}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn mistakes_point_at_the_line_of_the_study() {
    let refused = |text: &str| match file(text).map(Study::new) {
        Err(error) => error.to_string(),
        Ok(Err(error)) => error.to_string(),
        Ok(Ok(_)) => panic!("accepted: {text}"),
    };
    let vary = |rest: &str| format!("base = \"towers.toml\"\n[[vary]]\n{rest}\n");
    for (text, expected) in [
        (
            vary("path = \"gap[0].widht\"\nvalues = [0.01]"),
            &["study.toml:4:", "did you mean \"width\""][..],
        ),
        (
            vary("path = \"gap[1].width\"\nvalues = [0.01]"),
            &["study.toml:4:", "there is no [1]"],
        ),
        (
            vary("path = \"gap[0].width\"\nvalues = [\"20 kg\"]"),
            &["study.toml:4:", "expected a length"],
        ),
        (
            vary("path = \"gap[0].width\"\nvalues = [\"-20 mm\"]"),
            &["study.toml:4:", "gap[0].width"],
        ),
        (
            vary("path = \"motion.record\"\nvalues = [\"el-centra\"]"),
            &["study.toml:4:", "did you mean \"el-centro\""],
        ),
        (
            vary("path = \"gap[0].width\""),
            &["study.toml:2:", "is missing", "values"],
        ),
        (
            vary("path = \"gap[0].width\"\nvalue = [1]"),
            &["unknown key \"value\"", "did you mean \"values\""],
        ),
        (
            vary(
                "path = \"gap[0].width\"\ndistribution = { kind = \"normal\", mean = \"1 mm\", deviation = 1 }",
            ),
            &["one unit"],
        ),
        (
            vary(
                "path = \"gap[0].width\"\ndistribution = { kind = \"uniform\", from = \"1 mm\", to = \"2 mm\" }",
            ),
            &["design", "samples = "],
        ),
        (
            "base = \"papr\"\n[[vary]]\npath = \"title\"\nvalues = [\"x\"]".to_owned(),
            &["did you mean the built-in \"paper\""],
        ),
        (
            format!("{GRID}[[fragility]]\nintensity = \"pga\"\n"),
            &["there is no column \"pga\"", "pga_m_s2"],
        ),
        (
            format!("histories = [50]\n{GRID}"),
            &["there is no case 50"],
        ),
        (
            format!("{GRID}[design]\nkind = \"zipped\"\n"),
            &["5 values", "10"],
        ),
    ] {
        let said = refused(&text);
        for part in expected {
            assert!(
                said.contains(part),
                "{part:?} is missing in:\n{said}\nof\n{text}"
            );
        }
    }
}

/// A factor that changes the number of floors gives the columns of the tallest building.
#[test]
fn storeys_may_vary() {
    let text = r#"
base = "towers.toml"
[[vary]]
name = "A"
path = ["building.A.mass", "building.A.stiffness"]
values = [[2e7], [2e7, 2e7, 2e7]]
[[vary]]
name = "B"
path = ["building.B.mass", "building.B.stiffness"]
values = [[9e7], [9e7, 9e7, 9e7]]
"#;
    let study = study(text);
    let names = study.layout.names();
    // Three floors face each other only when both are tall.
    for wanted in [
        "A.floor3.storey_drift_peak",
        "A-B.floor3-3.peak_force_n",
        "A-B.floor1-1.peak_force_n",
    ] {
        assert!(names.contains(&wanted), "{wanted} is missing in {names:?}");
    }
    let folder = temporary();
    assert_eq!(go(&study, folder.path(), &jobs(2)).failed, 0);
    let table = read_columns(
        &study,
        folder.path(),
        &["A.floor3.storey_drift_peak", "reason"],
    );
    let table = table.unwrap_or_else(|error| panic!("{error}"));
    let present: Vec<bool> = table
        .column("A.floor3.storey_drift_peak")
        .iter()
        .map(Option::is_some)
        .collect();
    assert_eq!(present, [false, false, true, true]);
    assert_eq!(table.texts["reason"], [""; 4]);
}

#[test]
fn ready_made_studies_are_valid() {
    // The built-in example has no plan to turn.
    let names = jostle_study::ready_made_names().into_iter();
    for name in names.filter(|name| *name != "angles") {
        let (file, notes) =
            jostle_study::ready_made(name, None).unwrap_or_else(|error| panic!("{error}"));
        assert!(notes.is_empty(), "{name}: {notes:?}");
        let study = Study::new(file);
        let study = study.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(study.design.cases > 1, "{name}");
    }
    assert!(builtin_model("paper").is_ok());
}

/// Designs: every combination once; samples reproduce their distributions.
#[test]
fn designs_make_the_cases_they_should() {
    let grid = study(GRID);
    let mut seen = BTreeMap::new();
    for case in 0..50 {
        let key = format!("{:?}", grid.design.choices(case, &grid.file.factors));
        *seen.entry(key).or_insert(0) += 1;
    }
    assert_eq!(seen.len(), 50);

    for kind in ["latin-hypercube", "sobol", "random"] {
        let text = format!(
            r#"
base = "towers.toml"
[design]
kind = "{kind}"
samples = 4096
seed = 12
correlation = [{{ between = ["k", "m"], value = -0.6 }}]
[[vary]]
name = "k"
path = "building.A.stiffness"
multiply = true
distribution = {{ kind = "lognormal", median = 1, dispersion = 0.25 }}
[[vary]]
name = "m"
path = "building.A.mass"
multiply = true
distribution = {{ kind = "normal", mean = 1, deviation = 0.1 }}
[[vary]]
name = "gap"
path = "gap[0].width"
values = ["5 mm", "10 mm", "20 mm", "40 mm"]
"#
        );
        let study = study(&text);
        let (mut logs, mut masses, mut levels) = (Vec::new(), Vec::new(), [0; 4]);
        for case in 0..4096 {
            match &study.design.choices(case, &study.file.factors)[..] {
                [
                    jostle_study::Choice::Drawn(k),
                    jostle_study::Choice::Drawn(m),
                    jostle_study::Choice::Listed(level),
                ] => {
                    logs.push(k.ln() / 0.25);
                    masses.push((m - 1.0) / 0.1);
                    levels[*level] += 1;
                }
                other => panic!("{other:?}"),
            }
        }
        let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
        let product: Vec<f64> = logs.iter().zip(&masses).map(|(a, b)| a * b).collect();
        // Four standard errors of 4096 independent draws: √((1 + ρ²)/n) for the correlation, √(2/n) for the variance.
        let n = 4096f64;
        assert!(mean(&logs).abs() < 4.0 / n.sqrt(), "{kind}");
        assert!(
            (mean(&product) + 0.6).abs() < 4.0 * (1.36 / n).sqrt(),
            "{kind}: {}",
            mean(&product)
        );
        let square: Vec<f64> = masses.iter().map(|x| x * x).collect();
        assert!(
            (mean(&square) - 1.0).abs() < 4.0 * (2.0 / n).sqrt(),
            "{kind}"
        );
        for count in levels {
            assert!(
                (f64::from(count) - 1024.0).abs() < 4.0 * 768f64.sqrt(),
                "{kind}: {levels:?}"
            );
        }
    }
}

/// Forces and work of some cases, each from a cache that has seen all cases before it, and from one of its own.
fn shared_and_alone(study: &Study, cases: u64) -> [Vec<(u64, u64, u64)>; 2] {
    let shared = CaseCache::default();
    let numbers = |case_cache: &CaseCache, case: u64| {
        let prepared = study.prepare(case_cache, case);
        let prepared = prepared.unwrap_or_else(|error| panic!("{error}"));
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let outcome = prepared.step(settings, |_| ControlFlow::Continue(()));
        let summary = prepared.summary(&outcome, None, 0.0);
        let (gap, work) = (&summary.gaps[0], &summary.work);
        (
            gap.peak_force_n.to_bits(),
            summary.energy.damped_j.to_bits(),
            work.factorizations,
        )
    };
    [
        (0..cases).map(|case| numbers(&shared, case)).collect(),
        (0..cases)
            .map(|case| numbers(&CaseCache::default(), case))
            .collect(),
    ]
}

#[test]
fn what_cases_share_does_not_show() {
    let modal = TOWERS.to_owned() + "solver = \"modal\"\n";
    let folder = temporary();
    std::fs::write(folder.path().join("towers.toml"), modal).unwrap_or_else(|e| panic!("{e}"));
    let parse = |text: &str| {
        let file = StudyFile::parse("study.toml", text, Format::Toml, folder.path(), None);
        Study::new(file.unwrap_or_else(|error| panic!("{error}")))
            .unwrap_or_else(|error| panic!("{error}"))
    };
    let [shared, alone] = shared_and_alone(&parse(GRID), 50);
    assert_eq!(shared, alone);
    let forces: std::collections::BTreeSet<u64> = alone.iter().map(|row| row.0).collect();
    assert!(forces.len() > 40, "{} forces in 50 cases", forces.len());
    // Shapes hold for one tolerance only.
    let tolerances = parse(
        "base = \"towers.toml\"\n[[vary]]\npath = \"analysis.tolerance\"\nvalues = [1e-2, 1e-4]\n",
    );
    let [shared, alone] = shared_and_alone(&tolerances, 2);
    assert_eq!(shared, alone);
}

#[test]
fn links_may_vary() {
    let linked = TOWERS.to_owned()
        + "[[link]]\nbetween = [\"A\", \"B\"]\nfloors = [[2, 2]]\ndamping = \"1 kN.s/m\"\n";
    let folder = temporary();
    std::fs::write(folder.path().join("towers.toml"), linked).unwrap_or_else(|e| panic!("{e}"));
    let text = "base = \"towers.toml\"\n[[vary]]\npath = \"link[0].damping\"\nvalues = [\"1 kN.s/m\", \"2 MN.s/m\"]\n";
    let file = StudyFile::parse("study.toml", text, Format::Toml, folder.path(), None);
    let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")))
        .unwrap_or_else(|error| panic!("{error}"));
    let [shared, alone] = shared_and_alone(&study, 2);
    assert_eq!(shared, alone);
    assert_ne!(alone[0].0, alone[1].0);
}

/// A study of the towers under several records.
fn under_records(records: &str, rest: &str) -> Result<Study, StudyError> {
    let folder = temporary();
    let model = TOWERS.replace("\"el-centro-1940-ns\"", records);
    std::fs::write(folder.path().join("towers.toml"), model)
        .unwrap_or_else(|error| panic!("{error}"));
    let text = format!("base = \"towers.toml\"\n{rest}");
    let file = StudyFile::parse("study.toml", &text, Format::Toml, folder.path(), None)?;
    Study::new(file)
}

#[test]
fn records_that_the_model_lists_vary_by_themselves() {
    const LIST: &str = "[\"el-centro-1940-ns\", \"nanjing-artificial\"]";
    const GAPS: &str = "[[vary]]\npath = \"gap[0].width\"\nvalues = [\"5 mm\", \"10 mm\", 0.02]\n";
    const PEAKS: &str = "[[vary]]\npath = \"motion.pga\"\nvalues = [1, 2, 3]\n";
    let made =
        |rest: &str| under_records(LIST, rest).unwrap_or_else(|error| panic!("{rest}: {error}"));
    // By themselves, crossed with the rest, and crossed with what is zipped.
    assert_eq!(made("").design.cases, 2);
    assert_eq!(made(GAPS).design.cases, 6);
    let zipped = format!("{GAPS}{PEAKS}[design]\nkind = \"zipped\"\n");
    let study = made(&zipped);
    assert_eq!(study.design.cases, 6);
    let inputs: Vec<&str> = study.layout.inputs.iter().map(|c| &c.name[..]).collect();
    assert_eq!(inputs, ["gap0.width_m", "motion.pga_m_s2", "motion.record"]);

    let folder = temporary();
    go(&study, folder.path(), &jobs(2));
    let names = ["gap0.width_m", "motion.pga_m_s2", "pga_m_s2"];
    let mut wanted = vec!["motion", "motion.record"];
    wanted.extend(names);
    let table = read_columns(&study, folder.path(), &wanted).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(table.texts["motion"], table.texts["motion.record"]);
    assert_eq!(
        table.texts["motion"],
        ["el-centro-1940-ns", "nanjing-artificial"].repeat(3)
    );
    let gaps: Vec<f64> = table.column(names[0]).iter().copied().flatten().collect();
    assert_eq!(gaps, [0.005, 0.005, 0.01, 0.01, 0.02, 0.02]);
    let peaks: Vec<f64> = table.column(names[2]).iter().copied().flatten().collect();
    // El Centro peaks within the six seconds, the other one later.
    for (peak, wanted) in peaks.iter().step_by(2).zip([1.0, 2.0, 3.0]) {
        assert!((peak / wanted - 1.0).abs() < 1e-12, "{peak} for {wanted}");
    }

    // What the study says about records holds; so does an analytic wave in their place.
    for other in [
        "[[vary]]\npath = \"motion.record\"\nvalues = [\"el-centro-1940-ns\"]\n",
        "[[vary]]\npath = \"motion\"\nvalues = [{ kind = \"sine\", amplitude = 1, period = 1, duration = 2 }]\n",
    ] {
        assert_eq!(made(other).design.cases, 1, "{other}");
    }
}

#[test]
fn a_listed_record_that_is_not_there_is_shown_in_the_model() {
    let records = "[\"el-centro-1940-ns\",\n\"lost.at2\"]";
    let error = match under_records(records, "[[vary]]\npath = \"gap[0].width\"\nvalues = [1]\n") {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    };
    assert!(
        error.contains("towers.toml:4") && error.contains("lost.at2"),
        "{error}"
    );
    // A model without a list still needs something that varies.
    let error = under_records("\"el-centro-1940-ns\"", "").err();
    let error = error.map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("vary: is missing"), "{error}");
}

/// A single case leaves what a run of the same model leaves, its comparison with the run without contact included.
#[test]
fn a_case_leaves_the_files_of_a_run() {
    let text =
        "base = \"paper-inelastic\"\n[[vary]]\npath = \"motion.duration\"\nvalues = [\"5 s\"]\n";
    let folder = temporary();
    let written = jostle_study::run_case(&study(text), 0, folder.path(), &|| false);
    assert!(written.unwrap_or_else(|error| panic!("{error}")));
    let names: std::collections::BTreeSet<String> = std::fs::read_dir(folder.path())
        .unwrap_or_else(|error| panic!("{error}"))
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    let expected = [
        "buildings.parquet",
        "floors.parquet",
        "hinges.parquet",
        "history.parquet",
        "impacts.parquet",
        "report.html",
        "summary.json",
    ];
    assert!(names.iter().eq(expected), "{names:?}");
    let read = |name: &str| {
        std::fs::read_to_string(folder.path().join(name)).unwrap_or_else(|error| panic!("{error}"))
    };
    assert!(read("summary.json").contains("\"closing_without_contact_m\": 0."));
    assert!(read("report.html").contains("column section"));
}

/// Rows of a study that asks for it have the run without contact, and ratios to it; other columns stay as they are.
#[test]
fn a_study_compares_with_runs_without_contact() {
    let grid = "base = \"towers.toml\"\n[[vary]]\npath = \"gap[0].width\"\nvalues = [\"5 mm\", \"500 mm\"]\n";
    let compared = study(&format!("without_contact = true\n{grid}"));
    let plain = study(grid);
    let names = |study: &Study| -> Vec<String> {
        study
            .layout
            .names()
            .iter()
            .map(|name| (*name).to_owned())
            .collect()
    };
    let added: Vec<String> = names(&compared)
        .into_iter()
        .filter(|name| !names(&plain).contains(name))
        .collect();
    assert!(
        added
            .iter()
            .all(|name| { name.contains("_without_contact") || name.ends_with("_amplification") })
    );
    assert_eq!(names(&compared).len(), names(&plain).len() + added.len());
    for name in [
        "A-B.closing_without_contact_m",
        "A.base_shear_peak_without_contact_n",
        "A.floor2.displacement_max_without_contact_m",
        "A.floor2.storey_shear_peak_amplification",
        "A.floor2.overturning_moment_peak_amplification",
        "A.floor2.total_acceleration_peak_without_contact_m_s2",
        "B.residual_roof_displacement_amplification",
    ] {
        assert!(
            added.iter().any(|added| added == name),
            "{name} in {added:?}"
        );
    }
    assert!(
        !added.iter().any(|name| name.contains("ductility")),
        "nothing can yield"
    );

    let folder = temporary();
    go(&compared, folder.path(), &RunSettings::default());
    let wanted = [
        "A.floor2.storey_drift_peak",
        "A.floor2.storey_drift_peak_without_contact",
        "A.floor2.storey_drift_peak_amplification",
        "A-B.closing_without_contact_m",
        "A-B.closing_peak_m",
        "impact_count",
    ];
    let table =
        read_columns(&compared, folder.path(), &wanted).unwrap_or_else(|error| panic!("{error}"));
    let number = |name: &str, case: usize| table.numbers[name][case].unwrap_or(f64::NAN);
    // The second gap is never closed: the run without contact is the run, and that of the first case too.
    assert_eq!(number("impact_count", 1), 0.0);
    assert!(number("impact_count", 0) > 0.0);
    let apart = number(wanted[0], 1);
    for case in [0, 1] {
        let without = number(wanted[1], case);
        assert!(
            (without / apart - 1.0).abs() < 1e-3,
            "{without} and {apart}"
        );
        let ratio = number(wanted[0], case) / without;
        assert!((number(wanted[2], case) / ratio - 1.0).abs() < 1e-12);
        let closing = number("A-B.closing_without_contact_m", case);
        assert!((closing / number("A-B.closing_peak_m", 1) - 1.0).abs() < 1e-3);
    }
    assert!((number(wanted[2], 1) - 1.0).abs() < 1e-3);
    assert!(
        (number(wanted[2], 0) - 1.0).abs() > 1e-2,
        "contact changes drifts"
    );
}

/// A study is another one when any file changes that its model names, by whatever key.
#[test]
fn every_file_of_the_model_is_part_of_the_study() {
    let study = |folder: &Path, model: &str| {
        let text = format!(
            "[[vary]]\npath = \"motion.scale\"\nvalues = [1.0, 1.5]\n[selection]\nspectrum = \"code.csv\"\nperiods = [\"0.5 s\"]\n\n{model}"
        );
        let file = StudyFile::parse("s.toml", &text, Format::Toml, folder, None);
        let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")));
        study.unwrap_or_else(|error| panic!("{error}")).fingerprint
    };
    let model = r#"
[model.motion]
record = "main.csv"
unit = "m/s2"
across = { record = "across.csv", unit = "m/s2" }
baseline = "as-recorded"
duration = "0.4 s"
[[model.building]]
name = "A"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
plan = ["8 m", "6 m"]
motion = { record = "own.csv", unit = "m/s2", scale = 1.0 }
[[model.building]]
name = "B"
kind = "shear"
mass = ["40 t"]
stiffness = ["20 MN/m"]
plan = ["8 m", "6 m"]
at = ["9 m", "0 m"]
motion = { record = "matched.csv", unit = "m/s2", match = { spectrum = "target.csv", at = "0.5 s" } }
"#;
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).unwrap_or_else(|error| panic!("{error}"));
    };
    let record = "0.0 0.0\n0.1 1.0\n0.2 -1.0\n0.3 0.0\n0.4 0.0\n";
    let spectrum = "# unit = m/s2\n0.1 1.0\n1.0 0.5\n3.0 0.1\n";
    let records = ["main.csv", "across.csv", "own.csv", "matched.csv"];
    let spectra = ["target.csv", "code.csv"];
    for name in records {
        write(name, record);
    }
    for name in spectra {
        write(name, spectrum);
    }
    let first = study(folder.path(), model);
    assert_eq!(study(folder.path(), model), first);
    for name in records.into_iter().chain(spectra) {
        let text = std::fs::read_to_string(folder.path().join(name));
        let text = text.unwrap_or_else(|error| panic!("{error}"));
        write(name, &text.replace("1.0", "1.25"));
        assert_ne!(study(folder.path(), model), first, "{name}");
        write(name, &text);
    }
    assert_eq!(study(folder.path(), model), first);
}
