//! Pages have no text outside the table of messages, and every message is used.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use jostle_report::message::{self, ENGLISH, Messages};
use jostle_report::render;

use crate::fixture;
use crate::sources::{self, Literal, pages, rust_literals, script_literals, scripts};

/// Literals that look like texts and are none: classes, anchors, styles, commands, names of columns.
const NO_TEXT: &[&str] = &[
    "mrad",
    "Enter",
    "translate({:.1} {:.1}) rotate(-90)",
    "system-ui, sans-serif",
    "jostle contact-advice",
    "number ratio-beyond",
    "number ratio-near",
    "event yielded",
    "event cracked",
    "line dashed",
    "vertical-align: top",
    "white-space: normal",
    "start",
    "middle",
    "end",
    "status",
    "reason",
    "line thin",
    "line mean",
    "line curve-line",
    "grid colour-bar",
    "multiples impact-pictures",
    "multiple loop",
    "multiple orbit",
    "line whole",
    "line area",
    "tbody tr",
    r"{}\u{a0}m/s² ({}\u{a0}%\u{a0}g)",
    "jostle",
    "Content-Security-Policy",
    "(prefers-color-scheme: dark)",
    "(max-width: 860px)",
    "hinge-2 grade-",
    "14px system-ui, sans-serif",
    "12px system-ui, sans-serif",
    "650 14px system-ui, sans-serif",
    "650 12px system-ui, sans-serif",
    // Studies: names of files, a command, the end of a name of a column, a column of a file, an error of the command.
    "{name}.csv, {name}.parquet",
    "jostle study {}",
    "without contact",
    "{} demands of zero or less are left out",
    "{}: selection: the cases take no records that could be checked",
];

#[test]
fn no_page_has_a_text_of_its_own() {
    let mut found = Vec::new();
    for (file, source) in pages() {
        let literals = rust_literals(&source);
        assert!(!source.contains("html!") || !literals.is_empty(), "{file}");
        let literals = literals.into_iter().filter(Literal::is_text);
        found.extend(literals.map(|literal| (file.clone(), literal)));
    }
    for (file, source) in scripts() {
        let script_literals = script_literals(&source)
            .into_iter()
            .filter(Literal::is_text);
        found.extend(script_literals.map(|literal| (file.clone(), literal)));
    }
    found.retain(|(_, literal)| !NO_TEXT.contains(&literal.text.trim()));
    let lines: Vec<String> = found
        .iter()
        .map(|(file, literal)| format!("{file}, line {}: {}", literal.line, literal.text))
        .collect();
    assert!(
        lines.is_empty(),
        "texts outside crates/jostle-report/src/message/english.rs:\n{}",
        lines.join("\n")
    );
}

#[test]
fn a_text_outside_the_table_is_found() {
    let page = r#"html! { p.quiet { "Peak force of all" } th { "floor" } td title="Roof" class="number left" {} }"#;
    let texts: Vec<String> = rust_literals(page)
        .into_iter()
        .filter(Literal::is_text)
        .map(|literal| literal.text)
        .collect();
    assert_eq!(
        texts,
        ["Peak force of all", "floor", "Roof", "number left"],
        "attributes are told apart by the list of exceptions"
    );
    let script = "label.textContent = `the ${count} hardest of them`; // not \"this remark\"";
    let texts = script_literals(script);
    assert_eq!(texts.len(), 1);
    assert!(texts[0].is_text());
}

/// The values that scripts hand over are those of the message.
#[test]
fn scripts_ask_for_messages_that_exist_with_their_values() {
    let known: BTreeMap<&str, &str> = ENGLISH.all().into_iter().collect();
    let mut asked = 0;
    for (file, source) in scripts() {
        for (key, values) in sources::asked(&source) {
            asked += 1;
            let text = known
                .get(&key[..])
                .unwrap_or_else(|| panic!("{file}: no message {key}"));
            let names: BTreeSet<&str> = sources::names(text).into_iter().collect();
            let given: BTreeSet<&str> = values.iter().map(String::as_str).collect();
            assert_eq!(names, given, "{file}: {key}: {text}");
        }
    }
    assert!(asked > 100, "{asked} messages");
}

#[test]
fn every_message_is_used() {
    let mut used = BTreeSet::new();
    for (_, source) in scripts() {
        used.extend(sources::asked(&source).into_iter().map(|(key, _)| key));
    }
    for source in sources::all_sources() {
        used.extend(sources::called(&source));
    }
    let unused: Vec<&str> = ENGLISH
        .all()
        .into_iter()
        .map(|(key, _)| key)
        .filter(|key| !used.contains(*key))
        .collect();
    assert!(unused.is_empty(), "unused messages: {unused:?}");
}

/// A language in which every text stands in brackets.
static BRACKETED: LazyLock<Messages> = LazyLock::new(|| {
    Messages::from_english(|key, english| match key {
        "language_code" => "en-x-brackets",
        _ => Box::leak(format!("⟦{english}⟧").into_boxed_str()),
    })
});

/// Texts that no message contains come from elsewhere: names, numbers with their units, and what the mechanics reports.
#[test]
fn another_language_reaches_every_text_of_a_report() {
    let runs = [
        fixture::two_frames(0.1),
        fixture::alone(),
        fixture::walled(),
        fixture::in_space(),
    ];
    // Short ones are also parts of names.
    let texts: BTreeSet<&str> = ENGLISH
        .all()
        .into_iter()
        .map(|(_, text)| text.trim())
        .filter(|text| text.chars().count() > 3 && !text.contains('{'))
        .collect();
    let mut seen = BTreeSet::new();
    for run in &runs {
        let english = render(&run.page());
        let page = message::in_language(&BRACKETED, || render(&run.page()));
        assert!(page.contains("<html lang=\"en-x-brackets\">"));
        assert_eq!(
            english,
            render(&run.page()),
            "the language ends with its page"
        );
        let left: Vec<String> = sources::shown(&page)
            .into_iter()
            .filter(|node| texts.contains(&node[..]))
            .collect();
        assert!(left.is_empty(), "texts in English: {left:?}");
        let named = sources::shown(&english).into_iter();
        seen.extend(named.filter(|node| texts.contains(&node[..])));
    }
    assert!(seen.len() > 100, "{} texts of pages", seen.len());
}
