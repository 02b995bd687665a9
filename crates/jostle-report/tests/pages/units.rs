//! Pages in US units: no SI unit is left, numbers are right, and SI pages stay as they were.

use jostle_io::shown::in_units;
use jostle_io::{Units, shown};
use jostle_report::render;

use crate::{fixture, sources};

/// Names of SI units that pages show.
const SI: &[&str] = &[
    "kN",
    "mm",
    "cm",
    "kN·m",
    "kN·s",
    "kJ",
    "MJ",
    "J",
    "MPa",
    "GPa",
    "kPa",
    "m/s",
    "m/s²",
    "cm/s²",
    "m",
    "t",
    "MN·m",
    "N",
    "N/m",
    "N·s/m",
    "kN/m",
    "MN/m",
    "kg/m",
    "N·m²",
    "MN·m²",
    "GN·m²",
    "N/m^1.5",
    "MN·m/rad",
    "N·m/rad",
];

/// What may stay in SI: the titles of the fixtures.
const TYPED: &[&str] = &["100 mm apart"];

fn may_stay(text: &str) -> bool {
    TYPED.iter().any(|phrase| text.contains(phrase))
}

/// Words of a page that are SI units.
fn si_units(page: &str) -> Vec<String> {
    let mut found = Vec::new();
    for text in sources::shown(page)
        .into_iter()
        .filter(|text| !may_stay(text))
    {
        let words = text.split([' ', '\u{a0}', '\u{202f}', '[', ']', '(', ')', ',', ';', ':']);
        let units = words.filter(|word| SI.contains(&word.trim_end_matches('.')));
        found.extend(units.map(|unit| format!("{unit} in \"{text}\"")));
    }
    found
}

#[test]
fn no_si_unit_is_left_in_us_pages() {
    let runs = [
        fixture::two_frames(0.1),
        fixture::alone(),
        fixture::walled(),
        fixture::in_space(),
    ];
    for run in &runs {
        let before = render(&run.page());
        assert!(!si_units(&before).is_empty(), "SI pages show SI units");
        let page = in_units(Some(Units::Us), || render(&run.page()));
        let left = si_units(&page);
        assert!(left.is_empty(), "{left:#?}");
        assert_eq!(before, render(&run.page()), "units end with their page");
    }
}

/// Messages that scripts ask for, and the units beside them, are those of the page.
#[test]
fn scripts_have_the_units_of_their_page() {
    let run = fixture::two_frames(0.1);
    let part = |page: &str, id: &str| -> serde_json::Value {
        let start = format!("id=\"{id}\" type=\"application/json\">");
        let text = page.split(&start[..]).nth(1).unwrap();
        serde_json::from_str(text.split("</script>").next().unwrap()).unwrap()
    };
    let us = in_units(Some(Units::Us), || render(&run.page()));
    let units = part(&us, "page-units");
    assert_eq!(units["kN"]["name"], "kip");
    assert!((units["kN"]["factor"].as_f64().unwrap() * 4_448.221_615_260_5 - 1.0).abs() < 1e-12);
    assert_eq!(
        part(&us, "page-messages")["impact_in_words"],
        "{instant} s, {contact}: {force} kip"
    );
    let si = part(&render(&run.page()), "page-units");
    assert_eq!(
        (&si["mm"]["name"], &si["mm"]["factor"]),
        (&"mm".into(), &1e3.into())
    );
    for unit in shown::ALL_SHOWN {
        assert!(!unit.name().contains("kip") && unit.name() == unit.si_name());
    }
}
