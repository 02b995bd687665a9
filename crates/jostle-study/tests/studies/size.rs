//! `jostle size`: a known answer, the same for every number of threads, resumed after an interruption, and clear errors.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use jostle_io::{Format, ModelTree};
use jostle_study::size::{Over, SizeProblem, SizeProgress, SizeRequest, SizeResults};
use jostle_study::{GapSettings, critical_gaps};
use jostle_testkit::two_towers;

const TOWERS: &str = concat!(
    r#"
title = "Two towers"
[motion]
record = "el-centro-1940-ns"
pga = "2 m/s2"
duration = "8 s"
"#,
    two_towers!(2, 2),
);

const DAMPED: &str = r#"
[[link]]
between = ["A", "B"]
floors = [[2, 2]]
law = "viscous"
damping = "100 kN.s/m"
exponent = 1.0
"#;

fn tree(text: &str) -> ModelTree {
    ModelTree::parse("towers.toml", text, Format::Toml, Path::new(""))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn request(vary: &[&str], keep: &[&str], minimise: &str) -> SizeRequest {
    let owned = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect();
    SizeRequest {
        vary: owned(vary),
        keep: owned(keep),
        minimise: minimise.into(),
        ..SizeRequest::default()
    }
}

fn quiet() -> Box<dyn Fn(SizeProgress) + Send + Sync> {
    Box::new(|_| {})
}

fn problem(text: &str, request: &SizeRequest) -> SizeProblem {
    SizeProblem::new(tree(text), request).unwrap_or_else(|error| panic!("{error}"))
}

fn searched(text: &str, request: &SizeRequest, folder: Option<&Path>, jobs: usize) -> SizeResults {
    let stop = Arc::new(AtomicBool::new(false));
    let found = problem(text, request).run(folder, Some(jobs), &stop, quiet());
    found.unwrap_or_else(|error| panic!("{error}"))
}

/// The greatest gap known to have an impact and the least known to have none, a micrometre apart \[m\].
fn critical(text: &str) -> [f64; 2] {
    let input = tree(text).input().unwrap_or_else(|error| panic!("{error}"));
    let motion = input
        .ground_motion()
        .unwrap_or_else(|error| panic!("{error}"));
    let settings = GapSettings {
        tolerance: 1e-6,
        codes: input.codes.clone(),
        outcomes: false,
        reversed: false,
        curve: 0,
    };
    let gaps = critical_gaps(&input.model, &motion, &settings, &|| false);
    let gap = &gaps.unwrap_or_else(|error| panic!("{error}"))[0];
    [gap.pounding_at_m.unwrap_or(0.0), gap.gap_m]
}

#[test]
fn the_least_gap_without_impact_is_the_critical_gap() {
    let wanted = critical(TOWERS);
    let request = request(
        &["gap.width=1 mm..100 mm"],
        &["impact_count == 0"],
        "gap.width",
    );
    let found = searched(TOWERS, &request, None, 2);
    let best = found.best().unwrap_or_else(|| panic!("nothing found"));
    let gap = best.objective.unwrap_or(0.0);
    // Found from above; the search ends within 10⁻⁴ of the least of its last generation.
    assert!(found.converged, "{} trials", found.trials.len());
    let bracketed = wanted[0] < gap && gap < (1.0 + 5e-4) * wanted[1];
    assert!(bracketed, "{gap} {wanted:?}");
    assert_eq!(best.inputs[0].0, Some(gap));
    assert!(best.inputs[0].1.ends_with("mm"), "{:?}", best.inputs);
    assert_eq!(best.kept, [Some(0.0)]);
}

/// Both signs of a motion need the wider of both gaps; with one sign, the other is judged at the end.
#[test]
fn the_other_sign_is_judged_or_searched_too() {
    let with_sign =
        |reverse: bool| TOWERS.replace("duration", &format!("reverse = {reverse}\nduration"));
    let [plain, reversed] = [false, true].map(|reverse| critical(&with_sign(reverse))[1]);
    assert!((plain / reversed - 1.0).abs() > 0.01, "{plain} {reversed}");
    // The sign that needs less is searched, so that the other one violates what is found.
    let lesser = with_sign(plain > reversed);
    let wanted = plain.max(reversed);
    let mut request = request(
        &["gap.width=1 mm..100 mm"],
        &["impact_count == 0"],
        "gap.width",
    );
    let found = searched(&lesser, &request, None, 2);
    let other = found.reversed.as_ref().expect("the other sign was run");
    assert!(
        !other.keeps() && other.kept[0] >= Some(1.0),
        "{:?}",
        other.kept
    );
    let said = found.headline().join(" ");
    assert!(
        said.contains("Violated with the motion reversed: number of impacts"),
        "{said}"
    );

    request.both_signs = true;
    let found = searched(&lesser, &request, None, 2);
    let gap = found.best().and_then(|best| best.objective).unwrap_or(0.0);
    assert!(
        wanted <= gap && gap < (1.0 + 5e-4) * wanted,
        "{gap} {wanted}"
    );
    assert!(found.reversed.is_none());
}

#[test]
fn several_records_count_by_the_worst_or_by_their_mean() {
    let suite = TOWERS.replace(
        "\"el-centro-1940-ns\"",
        "[\"el-centro-1940-ns\", \"nanjing-artificial\"]",
    );
    let single = |name: &str| critical(&TOWERS.replace("el-centro-1940-ns", name));
    let both = [single("el-centro-1940-ns"), single("nanjing-artificial")];
    let [wanted, least] = if both[0][1] > both[1][1] {
        [both[0], both[1]]
    } else {
        [both[1], both[0]]
    };
    let worst = request(
        &["gap[0].width=1 mm..100 mm"],
        &["impact_count == 0"],
        "gap[0].width",
    );
    let found = searched(&suite, &worst, None, 2);
    let gap = found.best().and_then(|best| best.objective).unwrap_or(0.0);
    let bracketed = wanted[0] < gap && gap < (1.0 + 5e-4) * wanted[1];
    assert!(bracketed, "{gap} {both:?}");
    // The mean of the impacts may be one half: then one of the records may have one.
    let mean = SizeRequest {
        over: Over::Mean,
        keep: vec!["impact_count <= 0.5".into()],
        ..worst
    };
    let found = searched(&suite, &mean, None, 2);
    let less = found.best().and_then(|best| best.objective).unwrap_or(1.0);
    assert!(less < gap && less > least[0], "{less} {gap}");
}

#[test]
fn every_number_of_threads_finds_the_same_bits() {
    let request = SizeRequest {
        trials: 80,
        ..request(
            &["link.damping=10 kN.s/m..2 MN.s/m", "gap.width=2 mm..60 mm"],
            &["impact_count == 0"],
            "20 * gap.width + 1e-6 * link.force_peak_n",
        )
    };
    let text = format!("{TOWERS}{DAMPED}");
    let one = searched(&text, &request, None, 1);
    let three = searched(&text, &request, None, 3);
    assert_eq!(one, three);
    assert!(one.best.is_some() && one.trials.len() > 60);
    let other = SizeRequest { seed: 1, ..request };
    assert_ne!(searched(&text, &other, None, 2).trials, one.trials);
}

#[test]
fn an_interrupted_search_goes_on_and_ends_with_the_same_files() {
    let request = SizeRequest {
        trials: 36,
        ..request(
            &["gap.width=1 mm..100 mm"],
            &["impact_count == 0"],
            "gap.width",
        )
    };
    let whole = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let parts = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    searched(TOWERS, &request, Some(whole.path()), 2);
    // Stopped after some trials, twice, the second time with half a record at the end of the journal.
    for most in [9, 25] {
        let stop = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&stop);
        let watch = Box::new(move |progress: SizeProgress| {
            if progress.trials >= most {
                flag.store(true, Ordering::Relaxed);
            }
        });
        let found = problem(TOWERS, &request).run(Some(parts.path()), Some(2), &stop, watch);
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        assert!(found.stopped && !found.converged);
        assert!(found.trials.len() >= most, "{}", found.trials.len());
        let journal = parts.path().join("trials.journal");
        let mut bytes = std::fs::read(&journal).unwrap_or_else(|error| panic!("{error}"));
        bytes.extend([40, 0, 0, 0, 1, 2, 3]);
        std::fs::write(&journal, bytes).unwrap_or_else(|error| panic!("{error}"));
    }
    let found = searched(TOWERS, &request, Some(parts.path()), 2);
    assert!(found.earlier >= 25, "{}", found.earlier);
    for name in ["size.json", "trials.parquet", "size.html"] {
        let read = |folder: &Path| {
            std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
        };
        assert!(read(whole.path()) == read(parts.path()), "{name} differs");
    }
    // More trials go on from here, too; another search does not.
    let more = SizeRequest {
        trials: 90,
        ..request.clone()
    };
    let found = searched(TOWERS, &more, Some(parts.path()), 2);
    assert!(found.earlier > 25 && found.trials.len() > found.earlier);
    assert!(found.converged, "{} trials", found.trials.len());
    let other = SizeRequest { seed: 5, ..request };
    let stop = Arc::new(AtomicBool::new(false));
    let refused = problem(TOWERS, &other).run(Some(parts.path()), None, &stop, quiet());
    let error = refused
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(error.contains("belongs to another search"), "{error}");
}

#[test]
fn trade_offs_are_not_beaten() {
    let request = SizeRequest {
        trials: 100,
        ..request(
            &["link.damping=10 kN.s/m..2 MN.s/m"],
            &["floor.displacement_max_m <= 100 mm"],
            "link.force_n",
        )
    };
    let found = searched(&format!("{TOWERS}{DAMPED}"), &request, None, 2);
    let front = found.trade_off(0);
    assert!(front.len() > 3, "{front:?}");
    for pair in front.windows(2) {
        assert!(
            pair[0][0] < pair[1][0] && pair[0][1] > pair[1][1],
            "{pair:?}"
        );
    }
    for trial in &found.trials {
        let (Some(left), Some(objective)) = (trial.kept[0], trial.objective) else {
            continue;
        };
        let beaten = front.iter().any(|[x, y]| left < *x && objective < *y);
        assert!(!beaten, "{left} {objective}");
    }
}

#[test]
fn errors_name_the_option_and_the_remedy() {
    let text = format!("{TOWERS}{DAMPED}");
    let fault = |vary: &[&str], keep: &[&str], minimise: &str| {
        let found = SizeProblem::new(tree(&text), &request(vary, keep, minimise));
        match found {
            Ok(_) => panic!("accepted: {vary:?} {keep:?} {minimise}"),
            Err(error) => error.to_string(),
        }
    };
    let good = "gap.width=5 mm..50 mm";
    for (vary, keep, minimise, parts) in [
        (
            "gap.width=5 mm",
            "impact_count == 0",
            "gap.width",
            &["--vary", "bounds are missing", "10 mm..200 mm"][..],
        ),
        (
            "gap.width=5 mm..",
            "impact_count == 0",
            "gap.width",
            &["a bound is missing"],
        ),
        (
            "gap.width=5 kg..50 kg",
            "impact_count == 0",
            "gap.width",
            &["--vary gap.width", "expected a length"],
        ),
        (
            "gap.width=50 mm..5 mm",
            "impact_count == 0",
            "gap.width",
            &["--vary gap.width"],
        ),
        (
            "gap.widht=5 mm..50 mm",
            "impact_count == 0",
            "impact_count",
            &["widht", "did you mean \"width\"?"],
        ),
        (
            "gap[3].width=5 mm..50 mm",
            "impact_count == 0",
            "impact_count",
            &["--vary", "there is no [3]"],
        ),
        (
            "gap.width=-5 mm..50 mm",
            "impact_count == 0",
            "gap.width",
            &["--vary gap.width"],
        ),
        (
            good,
            "impact_cuont == 0",
            "gap.width",
            &["--keep", "did you mean \"impact_count\"?"],
        ),
        (
            good,
            "impact_count",
            "gap.width",
            &["--keep", "a comparison is missing"],
        ),
        (
            good,
            "impact_count == none",
            "gap.width",
            &["--keep", "expected a number"],
        ),
        (
            good,
            "floor.displacement_max_m <= 5 kg",
            "gap.width",
            &["--keep", "expected a length"],
        ),
        (
            good,
            "impact_count == 0",
            "gap.width +",
            &["--minimise", "a name is missing"],
        ),
        (
            good,
            "impact_count == 0",
            "gap.width peak_force_n",
            &["--minimise", "was not expected"],
        ),
        (
            good,
            "impact_count == 0",
            "link.force_peak",
            &["--minimise", "link.force_peak_n"],
        ),
    ] {
        let error = fault(&[vary], &[keep], minimise);
        for part in parts {
            assert!(
                error.contains(part),
                "{vary} {keep} {minimise}: expected {part:?} in\n{error}"
            );
        }
    }
    let twice = fault(&[good, good], &[], "gap.width");
    assert!(twice.contains("gap.width is named twice"), "{twice}");
    let none = fault(&[], &[], "gap.width");
    assert!(none.contains("--vary"), "{none}");
    // Without bounds they come from the model: 100 kN·s/m.
    let request = request(&["link.damping"], &["impact_count == 0"], "link.damping");
    assert!(SizeProblem::new(tree(&text), &request).is_ok());
}

/// The least coefficient of a power law is told in its own unit, on the terminal and on the axes of the page.
#[test]
fn a_power_law_is_sized_in_its_unit() {
    let damped = DAMPED
        .replace("100 kN.s/m", "100 kN.(s/m)^0.5")
        .replace("exponent = 1.0", "exponent = 0.5");
    let request = SizeRequest {
        trials: 12,
        ..request(
            &[
                "link.damping=50 kN.(s/m)^0.5..900 kN.(s/m)^0.5",
                "gap.width=1 mm..100 mm",
            ],
            &[],
            "link.damping",
        )
    };
    let found = searched(&format!("{TOWERS}{damped}"), &request, None, 2);
    let text = found.headline().join(" ");
    assert!(text.contains(" kN·(s/m)^0.5, at "), "{text}");
    assert!(
        found.page().contains("[kN·(s/m)^0.5]"),
        "no unit on an axis"
    );
}
