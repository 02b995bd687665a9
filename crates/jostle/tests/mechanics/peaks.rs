//! Peaks are found once and stand in one list.

use std::collections::BTreeSet;
use std::path::Path;

use jostle::history::{Kind, Owner};
use jostle::{
    Building, Damping, FloorPairs, Gap, GroundMotion, Link, LinkLaw, Model, Settings, Solver,
    Structure, simulate,
};
use jostle_testkit::imports::collect;
use jostle_testkit::models::{CONCRETE, equal_storeys};
use jostle_testkit::runs::{assembled, planned};
use std::ops::ControlFlow;

/// Files that look for extremes within steps, and why.
const ALLOWED: [(&str, &str); 8] = [
    ("stepping/extremes.rs", "the cubic itself"),
    ("stepping/observe/watches.rs", "direct steps"),
    (
        "stepping/plan_drifts.rs",
        "drifts in plan, with a bound that spares most corners; direct and by modes",
    ),
    ("stepping/modal/corners.rs", "motions by modes"),
    ("stepping/modal/links.rs", "motions by modes"),
    ("stepping/modal/peaks.rs", "motions by modes"),
    ("stepping/series/peaks.rs", "motions by power series"),
    ("stepping/series/stepper.rs", "motions by power series"),
];

/// Types that hold peaks of quantities, and why there is more than the list.
const TYPES: [(&str, &str); 12] = [
    ("history/peaks.rs: Peaks", "the list"),
    (
        "history/peaks.rs: PeaksOf",
        "what of it belongs to one owner",
    ),
    (
        "stepping/floor_peaks.rs: FloorPeaks",
        "by modes and by power series",
    ),
    (
        "stepping/member_peaks.rs: MemberPeaks",
        "thousands of forces, two numbers each",
    ),
    ("stepping/modal/corners.rs: CornerPeaks", "by modes"),
    ("stepping/modal/members.rs: MemberPeaks", "by modes"),
    ("stepping/modal/peaks.rs: Peaks", "by modes"),
    ("stepping/series/peaks.rs: SeriesPeaks", "by power series"),
    ("stepping/series/peaks.rs: SupportPeaks", "by power series"),
    (
        "stepping/sharp_peaks.rs: SharpPeaks",
        "corners of accelerations",
    ),
    (
        "stepping/totals.rs: LinkTotals",
        "where forces of links are found",
    ),
    (
        "stepping/totals.rs: SpringTotals",
        "where forces of springs are found",
    ),
];

/// All source files of the mechanics, with their texts.
fn sources() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let read = |file: std::path::PathBuf| {
        let inside = file.strip_prefix(&root).expect("it was found there");
        let text = std::fs::read_to_string(&file).expect("a source file can be read");
        (inside.display().to_string(), text)
    };
    files.into_iter().map(read).collect()
}

fn compare(found: &BTreeSet<String>, allowed: &[(&str, &str)]) {
    let allowed: BTreeSet<String> = allowed.iter().map(|(name, _)| (*name).to_owned()).collect();
    let more: Vec<_> = found.difference(&allowed).collect();
    assert!(
        more.is_empty(),
        "watch it instead, or say why not: {more:?}"
    );
    let gone: Vec<_> = allowed.difference(found).collect();
    assert!(gone.is_empty(), "these are no longer there: {gone:?}");
}

#[test]
fn few_files_look_for_extremes_within_steps() {
    let looks = |text: &str| {
        let names = ["greatest_in_step(", "take_extremes(", "greatest_turn("];
        let code = text.split("#[cfg(test)]").next().unwrap_or("");
        names.iter().any(|name| code.contains(name))
    };
    let found = sources().into_iter();
    let found = found.filter(|(_, text)| looks(text)).map(|(file, _)| file);
    compare(&found.collect(), &ALLOWED);
}

#[test]
fn peaks_stand_in_one_list() {
    let named = |line: &str| -> Option<String> {
        let after = line.split("struct ").nth(1)?;
        let name: String = after.chars().take_while(|c| c.is_alphanumeric()).collect();
        let holds = ["Peaks", "PeaksOf", "Totals"];
        holds.iter().any(|end| name.ends_with(end)).then_some(name)
    };
    let found = sources().into_iter().flat_map(|(file, text)| {
        let lines: Vec<String> = text.lines().filter_map(named).collect();
        lines.into_iter().map(move |name| format!("{file}: {name}"))
    });
    compare(&found.collect(), &TYPES);
}

/// Every recorded quantity that has a peak reaches it in the history, up to what lies between rows.
#[test]
fn peaks_are_those_of_histories() {
    let tower = |name: &str, mass: f64, stiffness: f64| Building {
        name: name.into(),
        structure: Structure::Shear(equal_storeys(4, [mass, stiffness])),
        damping: Damping::ratio(0.05, [1, 2]),
        ..Building::default()
    };
    let mut model = Model {
        title: "towers".into(),
        buildings: vec![tower("soft", 4e4, 2e7), tower("stiff", 6e4, 9e7)],
        gaps: vec![Gap::after(0, 0.03, CONCRETE)],
        links: vec![Link {
            between: [Some(0), Some(1)],
            floors: FloorPairs::listed(&[(2, 2)]),
            level_tolerance: 1e-3,
            stiffness: 1e6,
            damping: 5e4,
            law: LinkLaw::Linear,
            ..Link::default()
        }],
        ..Model::default()
    };
    let wave = |i: u32| 3.0 * (0.02 * f64::from(i) * 7.0).sin();
    let motion = GroundMotion::sampled("shaking", 0.02, (0..=300).map(wave).collect());
    let settings = Settings {
        record_interval: Some(0.0),
        ..Settings::default()
    };
    for solver in [Solver::Riccati, Solver::Modal] {
        model.analysis.solver = Some(solver);
        let system = assembled(&model);
        let plan = planned(&system, &motion, &model.analysis);
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        assert!(!outcome.impacts.is_empty());
        let history = outcome.history.as_ref().expect("recorded");
        let mut kinds = BTreeSet::new();
        for column in history.columns() {
            let Some(peak) = outcome.peaks.get(*column) else {
                continue;
            };
            let values = history.column(*column).expect("a column");
            let greatest = values
                .iter()
                .fold(0.0_f64, |most, column| most.max(column.abs()));
            let off = peak.size() / greatest - 1.0;
            assert!((-1e-9..2e-2).contains(&off), "{solver:?} {column:?}: {off}");
            kinds.insert((column.owner.name(), column.kind));
        }
        let expected = [
            ("floor", Kind::Acceleration),
            ("floor", Kind::Displacement),
            ("link", Kind::Force),
        ];
        assert_eq!(kinds, BTreeSet::from(expected), "{solver:?}");
        // What histories do not have follows from the same list.
        let closing = outcome.peaks.closing(3).value;
        assert!(closing > 0.03 && closing < 0.05, "{closing}");
        let force = outcome.peaks.gap_force(0).value;
        let strongest = outcome.impacts.iter().map(|impact| impact.peak_force);
        assert!(force >= strongest.fold(0.0, f64::max));
        assert!(outcome.peaks.work(Owner::Link(0)) > 0.0);
    }
}
