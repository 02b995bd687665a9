//! Columns that fail in shear while their neighbour strikes them: text, JSON, tables and report.

use std::path::Path;

use jostle::Hinges;
use jostle_io::summary_json;
use jostle_run::{Content, summary_text};

use crate::support::ran;

const MODEL: &str = include_str!("../../../../examples/columns_that_fail_in_shear.toml");

#[test]
fn failures_are_reported_with_their_impacts() {
    let ran = ran(&MODEL.replace("[motion]\n", "[motion]\nduration = \"8 s\"\n"));
    let summary = ran.summary();
    assert_eq!(summary.ended_early, None);
    assert!(
        summary.energy.imbalance < 1e-9,
        "{}",
        summary.energy.imbalance
    );
    let failures = summary.buildings[0].shear_failures.as_ref();
    let failures = failures.expect("its columns can fail");
    assert!(failures.total == 9 && failures.failed >= 1, "{failures:?}");
    assert!(summary.buildings[1].shear_failures.is_none());
    for pair in failures.list.windows(2) {
        assert!(pair[0].failed_s <= pair[1].failed_s);
    }
    let Some(Hinges::Frame(hinges)) = &ran.prepared.input.model.buildings[0].hinges else {
        panic!("a frame with hinges")
    };
    for failure in &failures.list {
        let place = failure
            .column
            .strip_prefix("old.column.")
            .expect("its name");
        let (line, storey) = place.split_once('.').expect("line and storey");
        let [line, storey] = [line, storey].map(|text| text.parse::<usize>().expect("a number"));
        // k of Sezen and Moehle, 0.7 to 1.
        let column = &hinges.shear[storey - 1][line - 1];
        let share = failure.strength_n / column.spring.backbone().yield_force();
        assert!(
            (0.7 - 1e-9..=1.0 + 1e-9).contains(&share),
            "{share}: {failure:?}"
        );
        assert!(
            (0.1 - 1e-9..=1.0).contains(&failure.strength_left),
            "{failure:?}"
        );
        assert!(failure.slip_peak_m > 0.0, "{failure:?}");
    }
    // An impact that is named was in progress.
    let impacts = failures
        .list
        .iter()
        .filter_map(|failure| Some((failure, failure.impact.as_ref()?)));
    for (failure, impact) in impacts {
        let gap = &summary.gaps[0];
        let known = gap.contacts.iter().flat_map(|contact| &contact.impacts);
        let mut known = known.filter(|known| known.start_s == impact.start_s);
        assert!(known.any(|known| (known.start_s..=known.end_s).contains(&failure.failed_s)));
    }
    let text = summary_text(&summary, &ran.prepared.input);
    assert!(text.contains("fails in shear in "), "{text}");
    if let Some(impact) = failures.list[0].impact.as_ref() {
        let place = match impact.on_member {
            Some(true) => "on it, ",
            Some(false) => "elsewhere, ",
            None => "",
        };
        let said = format!(
            "{} and {} {place}at {} m, from {:.3} s",
            impact.between[0], impact.between[1], impact.height_m, impact.start_s
        );
        assert!(text.contains(&said), "{said} in {text}");
    }
    let json: serde_json::Value = serde_json::from_str(&summary_json(&summary)).expect("JSON");
    let json_failures = &json["buildings"][0]["shear_failures"];
    assert_eq!(json_failures["failed"], failures.failed);
    assert!(json["buildings"][1].get("shear_failures").is_none());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("columns that fail");
    std::fs::create_dir_all(&folder).expect("a folder");
    ran.results(&summary)
        .write(&folder, Content::ALL)
        .expect("written");
    let report = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    for word in [
        "Columns that fail in shear",
        "strength left",
        &failures.list[0].column,
    ] {
        assert!(report.contains(word), "the report lacks {word}");
    }
}
