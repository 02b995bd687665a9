//! Tables of shake-table measurements in the NEES `.asc` layout, and records taken from them.

use jostle_io::{
    Dimension, MeasuredTable, RecordFormat, RecordOptions, parse_record, parse_record_and_info,
};

/// Tabs, rows of names and units in the second and fifth place, an unknown unit, times that begin late.
const TABS: &str = "Two towers, test 7\n\
Time\tA0\tD1\tCell\n\
Serial\t1023\t77\t5\n\
2026-03-01\tbay 2\t\t\n\
sec\tg\tin\tcounts\n\
Place\ttable\tfloor 1\tgap\n\
2.000\t0.0\t0.5\t1\n\
2.005\t0.1\t-0.25\t2\n\
2.010\t-0.2\t1e-1\t3\n";

fn table(text: &str) -> MeasuredTable {
    MeasuredTable::parse(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn error(text: &str) -> String {
    match MeasuredTable::parse(text.as_bytes()) {
        Ok(found) => panic!("accepted: {found:?}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn names_units_and_values_are_read() {
    let found = table(TABS);
    assert_eq!((found.start, found.step, found.points()), (2.0, 0.005, 3));
    assert_eq!(found.title, "Two towers, test 7");
    assert_eq!(found.list(), "A0 [g], D1 [in], Cell [counts]");
    assert_eq!(
        found.columns[0].size,
        Some((Dimension::Acceleration, 9.80665))
    );
    assert_eq!(found.columns[1].size, Some((Dimension::Length, 0.0254)));
    assert_eq!(found.columns[2].size, None);
    assert_eq!(found.columns[1].values, [0.5, -0.25, 0.1]);
    assert_eq!(found.column("2").map(|column| &column.name[..]), Ok("D1"));
}

#[test]
fn commas_blanks_and_spelled_out_units_are_understood() {
    for (mark, end) in [(",", ""), ("  ", ""), (";", ""), ("\t", "\t")] {
        let text = TABS
            .lines()
            .map(|line| {
                let line = line
                    .replace("bay 2\t\t", "bay\tx\ty")
                    .replace("floor 1", "floor1");
                line.replace('\t', mark) + end + "\r\n"
            })
            .collect::<String>()
            .replace("in", "inches");
        assert_eq!(
            table(&text).columns[1].size,
            Some((Dimension::Length, 0.0254)),
            "{mark:?}"
        );
        assert_eq!(table(&text).columns[0].values, [0.0, 0.1, -0.2], "{mark:?}");
    }
    // Times in milliseconds.
    let text = TABS.replace("sec\t", "msec\t");
    assert!((table(&text).step - 5e-6).abs() < 1e-15);
}

#[test]
fn a_record_is_one_acceleration_of_the_table() {
    assert_eq!(
        RecordFormat::detect(TABS.as_bytes()).ok(),
        Some(RecordFormat::Nees)
    );
    let (record, info) = parse_record_and_info(TABS.as_bytes(), &RecordOptions::default())
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(info.channels.len(), 1);
    assert_eq!(record.step, 0.005);
    assert_eq!(record.acceleration, [0.0, 0.1 * 9.80665, -0.2 * 9.80665]);
    // Two accelerations ask which one is meant.
    let two = TABS.replace("in\tcounts", "m/s2\tcounts");
    let error = parse_record(two.as_bytes(), &RecordOptions::default());
    let error = error
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(
        error.contains("1: A0") && error.contains("2: D1"),
        "{error}"
    );
    let options = RecordOptions {
        component: Some("D1".into()),
        ..RecordOptions::default()
    };
    let record = parse_record(two.as_bytes(), &options).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(record.acceleration, [0.5, -0.25, 0.1]);
    // None at all.
    let none = TABS.replace("\tg\t", "\tmm\t");
    let error = parse_record(none.as_bytes(), &RecordOptions::default());
    let error = error
        .err()
        .map(|error| error.to_string())
        .unwrap_or_default();
    assert!(
        error.starts_with(":5:") && error.contains("no column has a unit of acceleration"),
        "{error}"
    );
}

#[test]
fn faults_name_line_column_and_remedy() {
    let damaged = error(&TABS.replace("-0.25", "-0.2.5"));
    assert!(
        damaged.starts_with(":8: column 3 (D1): \"-0.2.5\" is not a number;"),
        "{damaged}"
    );
    let infinite = error(&TABS.replace("-0.25", "inf"));
    assert!(infinite.contains(":8: column 3"), "{infinite}");
    let ragged = error(&TABS.replace("2.005\t0.1\t", "2.005\t"));
    assert_eq!(
        ragged,
        ":8: expected 4 columns as on the lines before, found 3"
    );
    let units = error(&TABS.replace("sec\tg\tin\tcounts", "sec\tg\tin"));
    assert!(units.starts_with(":5: expected 4 columns"), "{units}");
    let nameless = error(&TABS.replace("Time\t", "Chan\t"));
    assert!(
        nameless.contains("names the columns, beginning with Time")
            && nameless.contains("six header rows"),
        "{nameless}"
    );
    let unitless = error(&TABS.replace("sec\tg", "x\tg"));
    assert!(unitless.contains("states the units"), "{unitless}");
    let jump = error(&TABS.replace("2.010", "2.020"));
    assert!(
        jump.starts_with(":9: time 2.02 s where 2.01 s was expected"),
        "{jump}"
    );
    let back = error(&TABS.replace("2.010", "2.001"));
    assert!(back.starts_with(":9:"), "{back}");
    let short = error("Time\tA\nsec\tg\n");
    assert!(short.contains("fewer than six rows"), "{short}");
    let one = error(
        TABS.split_inclusive('\n')
            .take(7)
            .collect::<String>()
            .as_str(),
    );
    assert!(one.contains("at least two values"), "{one}");
    let blank = error(&TABS.replace("2.005\t0.1", "\n2.005\t0.1"));
    assert!(blank.starts_with(":8:"), "{blank}");
}

#[test]
fn an_unknown_column_lists_the_columns() {
    let found = table(TABS);
    let error = found.column("D2").err().unwrap_or_default();
    assert!(
        error.contains("did you mean \"D1\"?") && error.contains("A0 [g], D1 [in]"),
        "{error}"
    );
    let error = found.column("4").err().unwrap_or_default();
    assert!(error.contains("there is no column \"4\""), "{error}");
    let twice = table(&TABS.replace("Cell", "D1"));
    let error = twice.column("D1").err().unwrap_or_default();
    assert!(error.contains("2 columns are named"), "{error}");
}

#[test]
fn garbage_is_refused_without_panic() {
    // Every prefix and every changed byte of a small file.
    let bytes = TABS.as_bytes();
    for length in 0..bytes.len() {
        let _ = MeasuredTable::parse(&bytes[..length]);
    }
    for at in 0..bytes.len() {
        for other in [0u8, b'\t', b'\n', b'x', b'9', 0xff] {
            let mut changed = bytes.to_vec();
            changed[at] = other;
            if let Ok(found) = MeasuredTable::parse(&changed) {
                assert!(found.step > 0.0 && found.points() >= 2);
                let values = found.columns.iter().flat_map(|column| &column.values);
                assert!(values.into_iter().all(|value| value.is_finite()));
            }
        }
    }
}
