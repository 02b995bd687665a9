//! Pages of studies are in the language in which they are written: no text of the table stays in English.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use jostle_io::{Format, StudyFile};
use jostle_report::message::{self, ENGLISH, Messages};
use jostle_study::{RunSettings, Study, finish, run};
use jostle_testkit::two_towers;

const TOWERS: &str = concat!(
    r#"
[motion]
record = "el-centro-1940-ns"
duration = "4 s"
"#,
    two_towers!(2, 2),
    "[analysis]\ntolerance = 0.01\n",
);

const GRID: &str = r#"
base = "towers.toml"
without_contact = true
[[vary]]
name = "gap"
path = "gap[0].width"
range = { from = "5 mm", to = "45 mm", count = 3 }
[[vary]]
path = "motion.pga"
values = ["100 cm/s2", "300 cm/s2", "500 cm/s2"]
"#;

const ONE_AT_A_TIME: &str = r#"
base = "towers.toml"
[design]
kind = "one-at-a-time"
[[vary]]
name = "gap"
path = "gap[0].width"
distribution = { kind = "uniform", from = "5 mm", to = "45 mm" }
[[vary]]
path = "motion.pga"
distribution = { kind = "uniform", from = "100 cm/s2", to = "500 cm/s2" }
"#;

const SAMPLED: &str = r#"
base = "towers.toml"
[design]
kind = "latin-hypercube"
samples = 24
seed = 1
[[vary]]
name = "gap"
path = "gap[0].width"
distribution = { kind = "uniform", from = "5 mm", to = "45 mm" }
"#;

/// Every text between brackets.
static BRACKETED: LazyLock<Messages> = LazyLock::new(|| {
    Messages::from_english(|key, english| match key {
        "language_code" => "en-x-brackets",
        _ => Box::leak(format!("⟦{english}⟧").into_boxed_str()),
    })
});

/// Texts of the elements of a page, without its scripts and styles.
fn shown(page: &str) -> BTreeSet<String> {
    let mut texts = BTreeSet::new();
    let mut rest = page;
    while let Some((_, after)) = rest.split_once('<') {
        let (tag, after) = after.split_once('>').unwrap_or((after, ""));
        rest = after;
        let skipped = ["script", "style"]
            .into_iter()
            .find(|name| tag.starts_with(name));
        if let Some((_, after)) = skipped.and_then(|name| rest.split_once(&format!("</{name}"))) {
            rest = after;
            continue;
        }
        texts.insert(rest.split('<').next().unwrap_or("").trim().to_owned());
    }
    texts
}

fn pages(text: &str) -> [BTreeSet<String>; 2] {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.path().join("towers.toml"), TOWERS)
        .unwrap_or_else(|error| panic!("{error}"));
    let file = StudyFile::parse("study.toml", text, Format::Toml, folder.path(), None)
        .unwrap_or_else(|error| panic!("{error}"));
    let study = Study::new(file).unwrap_or_else(|error| panic!("{error}"));
    let out = folder.path().join("out");
    run(
        &study,
        &out,
        &RunSettings::default(),
        &|| false,
        &|_| {},
        &|_| {},
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let page = || {
        finish(&study, &out, false).unwrap_or_else(|error| panic!("{error}"));
        let page = std::fs::read_to_string(out.join("report.html"));
        shown(&page.unwrap_or_else(|error| panic!("{error}")))
    };
    [page(), message::in_language(&BRACKETED, page)]
}

#[test]
fn no_text_of_a_study_stays_in_english() {
    // Short ones are also parts of names.
    let texts: BTreeSet<String> = ENGLISH
        .all()
        .into_iter()
        .map(|(_, text)| text.trim().to_owned())
        .filter(|text| text.chars().count() > 5 && !text.contains('{'))
        .collect();
    let mut seen = 0;
    for study in [GRID, ONE_AT_A_TIME, SAMPLED] {
        let [english, bracketed] = pages(study);
        let left: Vec<&String> = bracketed.intersection(&texts).collect();
        assert!(left.is_empty(), "texts in English: {left:?}");
        seen += english.intersection(&texts).count();
    }
    assert!(seen > 20, "{seen} texts of pages");
}
