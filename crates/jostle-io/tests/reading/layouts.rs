//! Layouts of text records: what is recognised, what is asked, and that no number is lost or misread in silence.
//!
//! All files are written here from two formulas.

use std::fmt::Write;

use jostle_io::{
    Channel, Record, RecordContent, RecordFormat, RecordLayout, RecordOptions, STANDARD_GRAVITY,
    parse_info, parse_record, parse_record_and_info,
};

const G: f64 = STANDARD_GRAVITY;
const STEP: f64 = 0.01;

/// `a(t) = 0.30 sin(4πt) exp(−((t−2)/0.7)²)`, 400 values; its peak is 0.29074 at 1.88 s \[g\].
pub(crate) fn burst() -> Vec<f64> {
    let value = |i: i32| {
        let t = STEP * f64::from(i);
        0.30 * (4.0 * std::f64::consts::PI * t).sin() * (-((t - 2.0) / 0.7).powi(2)).exp()
    };
    (0..400).map(value).collect()
}

/// `p(t) = 0.35 exp(−t/0.25) cos(5πt)` with p₀ = 0 and p₁ = 0.40, its peak \[g\].
fn pulse() -> Vec<f64> {
    let value = |i: i32| {
        let t = STEP * f64::from(i);
        0.35 * (-t / 0.25).exp() * (5.0 * std::f64::consts::PI * t).cos()
    };
    let mut values: Vec<f64> = (0..400).map(value).collect();
    values[0] = 0.0;
    values[1] = 0.40;
    values
}

pub(crate) fn with(change: impl Fn(&mut RecordOptions)) -> RecordOptions {
    let mut options = RecordOptions::default();
    change(&mut options);
    options
}

fn in_unit(unit: &str) -> RecordOptions {
    with(|options| options.unit = Some(unit.into()))
}

fn read(text: &str, options: &RecordOptions) -> Record {
    parse_record(text.as_bytes(), options).unwrap_or_else(|error| panic!("{error}"))
}

fn error(text: &str, options: &RecordOptions) -> String {
    match parse_record(text.as_bytes(), options) {
        Ok(record) => panic!("read: {} values", record.acceleration.len()),
        Err(error) => error.to_string(),
    }
}

/// Compares a record with values in a unit, to half a digit.
fn assert_values(record: &Record, values: &[f64], unit: f64, digit: f64) {
    assert!((record.step - STEP).abs() < 1e-12, "step {}", record.step);
    assert_eq!(record.acceleration.len(), values.len());
    for (at, (found, wanted)) in record.acceleration.iter().zip(values).enumerate() {
        let wanted = wanted * unit;
        let allowed = 0.501 * digit * unit;
        assert!(
            (found - wanted).abs() <= allowed,
            "value {at}: {found}, not {wanted}"
        );
    }
}

fn rows(values: &[f64], row: impl Fn(usize, f64) -> String) -> String {
    let lines = values.iter().enumerate();
    lines.map(|(i, a)| row(i, *a) + "\n").collect()
}

/// Values so many on a line.
fn wrapped(values: &[f64], per_line: usize) -> String {
    let line = |line: &[f64]| {
        let cells = line.iter().map(|a| format!("{a:10.5}"));
        cells.collect::<String>() + "\n"
    };
    values.chunks(per_line).map(line).collect()
}

fn pairs(values: &[f64], per_line: usize) -> String {
    let cells: Vec<String> = values
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{:10.3}{a:10.5}", STEP * i as f64))
        .collect();
    cells
        .chunks(per_line)
        .map(|line| line.concat() + "\n")
        .collect()
}

/// Times and accelerations in blanks.
fn columns(values: &[f64]) -> String {
    rows(values, |i, a| format!("{:.3} {a:.6}", STEP * i as f64))
}

#[test]
fn names_above_units_belong_together() {
    let values = pulse();
    let tabs = rows(&values, |i, a| {
        format!(
            "{:.3}\t{a:.6}\t{:.5}\t{:.5}",
            STEP * i as f64,
            3.0 * a,
            2.0 * a
        )
    });
    let names = "Time\tAcceleration\tVelocity\tDisplacement\n[sec]\t[g]\t[cm/sec]\t[cm]\n";
    let text = format!("{names}{tabs}");
    assert_eq!(
        RecordFormat::detect(text.as_bytes()).ok(),
        Some(RecordFormat::Columns)
    );
    assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);

    let comma = |number: String| number.replace('.', ",");
    let semicolons = rows(&values, |i, a| {
        format!(
            "{};{}",
            comma(format!("{:.3}", STEP * i as f64)),
            comma(format!("{a:.6}"))
        )
    });
    let text = format!("Time;Acc\ns;g\n{semicolons}");
    assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);
    // Units without names, and a ruled line below.
    let text = format!(
        "Some Station\n(s)  (cm/s/s)\n-----------\n{}",
        columns(&values)
    );
    assert_values(&read(&text, &RecordOptions::default()), &values, 0.01, 1e-6);
    // One unit above one column.
    let text = format!(
        "# step = 0.01 s\n[g]\n{}",
        rows(&values, |_, a| format!("{a:.6}"))
    );
    assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);
    // The unit belongs to its column.
    let text = format!(
        "Time\tAcc\tDisp\ns\tm/s2\tcm\n{}",
        rows(&values, |i, a| {
            format!("{:.3}\t{a:.6}\t{:.5}", STEP * i as f64, 2.0 * a)
        })
    );
    assert_values(&read(&text, &RecordOptions::default()), &values, 1.0, 1e-6);
    let velocity = text.replace("m/s2", "cm/s");
    let message = error(&velocity, &RecordOptions::default());
    assert!(
        message.starts_with(":2: the unit \"cm/s\" is not an acceleration"),
        "{message}"
    );
}

#[test]
fn nees_needs_its_whole_header() {
    let values = pulse();
    let table = columns(&values).replace(' ', "\t");
    let nees = with(|options| options.format = Some(RecordFormat::Nees));
    // Two header rows: nothing of the data may pass for header, also where the format is forced.
    let message = error(&format!("Time\tA0\nsec\tg\n{table}"), &nees);
    assert!(
        message.contains("line 3 holds numbers already"),
        "{message}"
    );
    let six =
        format!("Test\tof today\nSerial\t7\nPlace\tbase\nDate\ttoday\nTime\tA0\nsec\tg\n{table}");
    assert_eq!(
        RecordFormat::detect(six.as_bytes()).ok(),
        Some(RecordFormat::Nees)
    );
    assert_values(&read(&six, &RecordOptions::default()), &values, G, 1e-6);
    // Numbers do not begin in line 7.
    let seven = format!("One more\n{six}");
    assert_eq!(
        RecordFormat::detect(seven.as_bytes()).ok(),
        Some(RecordFormat::Columns)
    );
    assert_values(&read(&seven, &RecordOptions::default()), &values, G, 1e-6);
}

#[test]
fn values_that_continue_are_never_read_as_a_column() {
    let values = burst();
    for per_line in [2, 3, 5, 7, 8, 10] {
        let text = wrapped(&values, per_line);
        let hint = format!("read = {{ per_line = {per_line} }} beside record");
        for column in [None, Some(1), Some(2)] {
            for title in [
                "",
                "Acceleration in g of a burst\n",
                "one two three\n",
                "a b c d e f g h\n",
            ] {
                let options = with(|options| {
                    options.column = column;
                    options.unit = Some("g".into());
                    options.step = Some(STEP);
                });
                let message = error(&format!("{title}{text}"), &options);
                assert!(
                    message.contains(&hint),
                    "{per_line}, {column:?}, {title:?}: {message}"
                );
            }
        }
        let all = with(|options| {
            options.unit = Some("g".into());
            options.step = Some(STEP);
            options.layout.per_line = Some(per_line);
        });
        assert_values(&read(&text, &all), &values, G, 1e-5);
        let content = with(|options| {
            options.unit = Some("g".into());
            options.step = Some(STEP);
            options.layout.content = Some(RecordContent::Values);
        });
        assert_eq!(read(&text, &content), read(&text, &all));
    }
    // A shorter last line alone is enough.
    let short = "0.1 -0.7 0.3\n0.5 -0.2 0.9\n-0.4 0.8\n";
    let options = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(STEP);
        options.column = Some(2);
    });
    let message = error(short, &options);
    assert!(
        message.starts_with(":3: the lines have 3 numbers each and the last one 2")
            && message.contains("read = { per_line = 3 }"),
        "{message}"
    );
}

#[test]
fn a_statement_about_columns_overrules_the_evidence() {
    let values = burst();
    let text = wrapped(&values, 8);
    let options = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(STEP);
        options.column = Some(2);
        options.layout.content = Some(RecordContent::Columns);
    });
    let second: Vec<f64> = values.iter().skip(1).step_by(8).copied().collect();
    assert_values(&read(&text, &options), &second, G, 1e-5);
}

#[test]
fn components_beside_each_other_are_columns() {
    let values = burst();
    let three = rows(&values, |i, a| {
        format!(
            "{a:.6} {:.6} {:.6}",
            0.5 * a + 0.01 * (0.3 * i as f64).sin(),
            0.1 * (0.9 * i as f64).cos()
        )
    });
    let options = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(STEP);
        options.column = Some(1);
    });
    assert_values(&read(&three, &options), &values, G, 1e-6);
    let message = error(&three, &in_unit("g"));
    assert!(
        message.contains("read = { per_line = 3 }") && message.contains("column = 2"),
        "{message}"
    );
}

#[test]
fn pairs_on_a_line_are_read_one_after_the_other() {
    let values = burst();
    for per_line in [2, 4, 5] {
        let text = pairs(&values, per_line);
        let found = read(&text, &in_unit("g"));
        assert_values(&found, &values, G, 1e-5);
        let second = with(|options| {
            options.unit = Some("g".into());
            options.column = Some(2);
        });
        assert_eq!(read(&text, &second), found, "{per_line} pairs on a line");
        let stated = with(|options| {
            options.unit = Some("g".into());
            options.layout.content = Some(RecordContent::Pairs);
        });
        assert_eq!(read(&text, &stated), found);
    }
    // A last line with fewer pairs.
    let text = pairs(&values[..398], 4);
    assert_values(&read(&text, &in_unit("g")), &values[..398], G, 1e-5);
    // A lost pair shows.
    let lost = pairs(&values, 4).replacen("     0.040   0.00006", "", 1);
    assert!(error(&lost, &in_unit("g")).starts_with(':'));
}

#[test]
fn count_and_step_in_first_lines_are_read() {
    let values = burst();
    let one = rows(&values, |_, a| format!("{a:.6}"));
    let eight = wrapped(&values, 8);
    let both = columns(&values);
    for head in [
        "400 0.0100\n",
        "400\n0.01\n",
        "  400,  0.01\n",
        "test motion\n400 0.0100\n",
        "0.01 400\n",
    ] {
        for (body, digit) in [(&one, 1e-6), (&eight, 1e-5), (&both, 1e-6)] {
            let text = format!("{head}{body}");
            assert_values(&read(&text, &in_unit("g")), &values, G, digit);
        }
    }
    // The count alone leaves the step open.
    let text = format!("400\n{one}");
    let message = error(&text, &in_unit("g"));
    assert!(message.contains("which time step"), "{message}");
    let options = with(|options| {
        options.unit = Some("cm/s2".into());
        options.step = Some(STEP);
    });
    assert_values(&read(&text, &options), &values, 0.01, 1e-6);
    // The step of the file holds against another one.
    let message = error(
        &format!("400 0.02\n{one}"),
        &with(|options| {
            options.unit = Some("g".into());
            options.step = Some(STEP);
        }),
    );
    assert!(message.contains("0.02 s"), "{message}");
}

#[test]
fn a_first_number_of_another_kind_is_asked_about() {
    let values = burst();
    let one = rows(&values, |_, a| format!("{a:.4}"));
    let options = |skip: Option<usize>| {
        with(|options| {
            options.unit = Some("cm/s2".into());
            options.step = Some(STEP);
            options.layout.skip = skip;
        })
    };
    for (head, skip, found) in [
        ("0.01\n", 1, "0.01"),
        ("399\n", 1, "399"),
        ("398\n0.01\n", 2, "398"),
    ] {
        let text = format!("{head}{one}");
        let message = error(&text, &options(None));
        let wanted = format!(":1: \"{found}\"");
        assert!(
            message.starts_with(&wanted)
                && message.contains(&format!("read = {{ skip = {skip} }}"))
                && message.contains("read = { skip = 0 }"),
            "{message}"
        );
        assert_values(&read(&text, &options(Some(skip))), &values, 0.01, 1e-4);
        let kept = read(&text, &options(Some(0)));
        assert_eq!(kept.acceleration.len(), 400 + skip);
    }
    // A first number like the others is one of them, and zero may be printed short.
    for first in ["0.0100", "0", "-0.0114"] {
        let text = format!("{first}\n{one}");
        assert_eq!(
            read(&text, &options(None)).acceleration.len(),
            401,
            "{first}"
        );
    }
    // A first line with another number of cells.
    let text = format!("400 0.01 7\n{one}");
    let message = error(&text, &options(None));
    assert!(
        message.starts_with(":1: 3 numbers, and 1 on the lines below"),
        "{message}"
    );
    assert_values(&read(&text, &options(Some(1))), &values, 0.01, 1e-4);
}

#[test]
fn unreadable_lines_are_no_header() {
    let values = burst();
    let head = "# unit = g\n# step = 0.01 s\n";
    let one = |bad: &str| {
        let text = rows(&values, |i, a| {
            if i < 40 {
                bad.to_owned()
            } else {
                format!("{a:.6}")
            }
        });
        error(&format!("{head}{text}"), &RecordOptions::default())
    };
    for bad in [
        "NaN", "nan", "-inf", "****", "********", "N/A", "null", "1.#QNAN", "-1.#IND", "0.12.3",
        "0x10", "1e", "--", "-", "1.2.3e4", "?", "12.5abc", "NA", "...",
    ] {
        let message = one(bad);
        let plain = bad.split(',').next().unwrap_or(bad);
        assert!(message.starts_with(":3: \""), "{bad}: {message}");
        assert!(
            message.contains("is not a number") || message.contains(plain),
            "{bad}: {message}"
        );
    }
    // Errors of spreadsheets are no comments.
    for bad in ["#N/A", "#NUM!", "#VALUE!"] {
        assert!(one(bad).starts_with(":3: \"#"), "{bad}");
    }
    // With times: what stands in place of a value.
    for bad in ["NaN", "****", "x", "N/A", "gap", "missing", ""] {
        let text = rows(&values, |i, a| {
            let t = STEP * i as f64;
            if i < 30 {
                format!("{t:.3};{bad}")
            } else {
                format!("{t:.3};{a:.6}")
            }
        });
        let text = format!("# unit = g\n{text}").replace(";\n", ";;\n");
        let message = error(&text, &RecordOptions::default());
        assert!(
            message.starts_with(":2: \"") && message.ends_with("is not a number"),
            "{bad}: {message}"
        );
    }
}

#[test]
fn text_above_numbers_is_header() {
    let values = burst();
    for head in [
        "Chi-Chi 1999\n",
        "Station 12 of 300\n0.29 g at 1.88 s\n",
        "1999-09-21\n",
        "21 September 1999, 01:47\n\n",
        "=====\nBurst\n-----\n",
        "time acc\n",
        "RSN 6, 40 m\nunits: none\n",
    ] {
        let text = format!("{head}{}", columns(&values));
        assert_values(&read(&text, &in_unit("g")), &values, G, 1e-6);
    }
    let long = "a line of text\n".repeat(50);
    assert_values(
        &read(&format!("{long}{}", columns(&values)), &in_unit("g")),
        &values,
        G,
        1e-6,
    );
    let message = error(&format!("one\n{long}{}", columns(&values)), &in_unit("g"));
    assert!(message.starts_with(":51:"), "{message}");
    // Numbers above text: the line and the remedy.
    let text = format!("400 0.01 2\nTime and acceleration\n{}", columns(&values));
    let message = error(&text, &in_unit("g"));
    assert!(
        message.starts_with(":2: ") && message.contains("read = { skip = 2 }"),
        "{message}"
    );
    let options = with(|options| {
        options.unit = Some("g".into());
        options.layout.skip = Some(2);
    });
    assert_values(&read(&text, &options), &values, G, 1e-6);
}

#[test]
fn other_columns_may_hold_text() {
    let values = burst();
    let table = rows(&values, |i, a| {
        format!(
            "{:.3},{a:.6},{},{}",
            STEP * i as f64,
            if i < 3 { "NaN" } else { "1.5" },
            ["ok", "no"][i % 2]
        )
    });
    let text = format!("time (s),acc (g),other,remark\n{table}");
    assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);
    let second = text.replace("acc (g)", "first (g)");
    let options = with(|options| options.column = Some(2));
    assert_values(&read(&second, &options), &values, G, 1e-6);
    let third = with(|options| options.column = Some(3));
    let message = error(&second, &third);
    assert!(
        message.starts_with(":2: \"NaN\" is not a number"),
        "{message}"
    );
}

#[test]
fn glued_numbers_are_read_by_their_widths() {
    let values: Vec<f64> = burst().iter().map(|a| -a).collect();
    let cells: Vec<String> = values.iter().map(|a| format!("{a:8.5}")).collect();
    let body: String = cells.chunks(8).map(|line| line.concat() + "\n").collect();
    assert!(body.contains("-0.00"));
    let head = "PEER STRONG MOTION\nTEST\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS=  400, DT= .01000 SEC\n";
    let at2 = format!("{head}{body}");
    assert_values(&read(&at2, &RecordOptions::default()), &values, G, 1e-5);
    let widths = |widths: &[usize]| with(|options| options.layout.widths = widths.to_vec());
    assert_values(&read(&at2, &widths(&[8])), &values, G, 1e-5);
    assert!(error(&at2, &widths(&[7])).starts_with(":5:"));

    // Positive numbers of full width have no sign between them.
    let wide: Vec<f64> = (0..400)
        .map(|i| if i < 20 { 123.456 } else { -0.5 - f64::from(i) })
        .collect();
    let cells: Vec<String> = wide.iter().map(|a| format!("{a:8.3}")).collect();
    let body: String = cells.chunks(8).map(|line| line.concat() + "\n").collect();
    let text = format!("{}{body}", head.replace("OF G", "OF CM/SEC/SEC"));
    assert_values(&read(&text, &RecordOptions::default()), &wide, 0.01, 1e-3);

    // Two columns, from the first line on.
    let table = rows(&values, |i, a| format!("{:8.3}{a:9.6}", STEP * i as f64));
    let text = format!("# unit = g\n{table}");
    assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);
    let stated = read(&text, &widths(&[8, 9]));
    assert_values(&stated, &values, G, 1e-6);

    // Lines that do not agree: the widths are asked for.
    let odd = text
        .replacen("   0.050", "  0.0500", 1)
        .replacen("   0.060", "    0.06", 1);
    let odd = odd.replacen("\n   0.070", "\n  0.070", 1);
    let message = error(&odd, &RecordOptions::default());
    assert!(
        message.contains("read = { widths = [8, 9] } beside record"),
        "{message}"
    );
    // An exponent without its letter is no second number.
    let message = error(
        "# unit = g\n# step = 0.01 s\n 1.25-101\n 1.25E-02\n 1.35E-02\n",
        &RecordOptions::default(),
    );
    assert!(
        message.starts_with(":3: \"1.25-101\" is not a number"),
        "{message}"
    );
}

#[test]
fn rounded_times_show_a_simple_step_or_frequency() {
    let times = |step: f64, decimals: usize, points: usize, keep: &dyn Fn(usize) -> bool| {
        let rows = (0..points).filter(|i| keep(*i));
        let rows = rows.map(|i| {
            format!(
                "{:.decimals$} {:.6}\n",
                step * i as f64,
                1e-3 * (0.1 * i as f64).sin()
            )
        });
        format!("# unit = g\n{}", rows.collect::<String>())
    };
    let all = |_: usize| true;
    for (step, decimals) in [
        (1.0 / 256.0, 3),
        (1.0 / 256.0, 4),
        (1.0 / 128.0, 3),
        (1.0 / 60.0, 3),
        (1.0 / 30.0, 2),
        (0.0125, 4),
        (0.005, 3),
        (1.0 / 150.0, 6),
    ] {
        let record = read(
            &times(step, decimals, 1200, &all),
            &RecordOptions::default(),
        );
        assert_eq!(record.acceleration.len(), 1200);
        assert!(
            (record.step / step - 1.0).abs() < 1e-15,
            "{step} to {decimals} digits: {}",
            record.step
        );
        // A lost line shows, and resampling is no remedy for rounding.
        for lost in [1, 5, 600, 1190] {
            let text = times(step, decimals, 1200, &|i| i != lost);
            let message = error(&text, &RecordOptions::default());
            assert!(message.starts_with(':'), "{message}");
        }
    }
    // Two digits for 80 values a second: the step is asked for.
    let coarse = times(0.0125, 2, 800, &all);
    let message = error(&coarse, &RecordOptions::default());
    assert!(
        message.contains("rounded to 0.01 s")
            && message.contains("step = \"0.0125 s\"")
            && !message.contains("resample"),
        "{message}"
    );
    let stated = with(|options| options.step = Some(0.0125));
    let record = read(&coarse, &stated);
    assert_eq!((record.step, record.acceleration.len()), (0.0125, 800));
    let named = coarse.replacen('\n', "\ntime acc\n", 1);
    assert_eq!(read(&named, &stated).step, 0.0125);
    // Equal times, where the digits are coarser than the step.
    let equal = times(0.004, 2, 500, &all);
    let fine = with(|options| options.step = Some(0.004));
    assert_eq!(read(&equal, &fine).acceleration.len(), 500);
    // Another step does not fit.
    let wrong = with(|options| options.step = Some(0.005));
    assert!(error(&equal, &wrong).starts_with(':'));
}

#[test]
fn unequal_times_are_not_ignored_for_a_stated_step() {
    let values = burst();
    let text = columns(&values).replacen("0.500 ", "0.504 ", 1);
    let options = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(STEP);
    });
    let message = error(&text, &options);
    assert!(
        message.starts_with(":51: time 0.504 s where 0.5 s was expected"),
        "{message}"
    );
}

#[test]
fn units_are_read_in_their_spellings() {
    let values = burst();
    for (unit, size) in [
        ("mg", 1e-3 * G),
        ("milli-g", 1e-3 * G),
        ("gals", 0.01),
        ("g's", G),
        ("cm/s^2", 0.01),
        ("m/s/s", 1.0),
        ("cm/sec/sec", 0.01),
        ("µg", 1e-6 * G),
        ("mm/s²", 1e-3),
        ("%g", 1e-2 * G),
    ] {
        let table = rows(&values, |i, a| {
            format!("{:.3},{:.4}", STEP * i as f64, 1e3 * a)
        });
        for text in [
            format!("Time (s),Acceleration ({unit})\n{table}"),
            format!("Time,Acceleration\ns,\"{unit}\"\n{table}"),
            format!("# unit = {unit}\n{table}"),
        ] {
            let thousand: Vec<f64> = values.iter().map(|a| 1e3 * a).collect();
            let limited = size * 300.0 <= 100.0 && (size / G - 1.0).abs() > 0.01;
            match parse_record(text.as_bytes(), &RecordOptions::default()) {
                Ok(record) => assert_values(&record, &thousand, size, 1e-4),
                Err(error) => assert!(!limited, "{unit}: {error}"),
            }
        }
    }
    let table = columns(&values);
    let message = error(
        &format!("time (s) acceleration (furlong)\n{table}"),
        &RecordOptions::default(),
    );
    assert_eq!(
        message,
        ":1: the unit \"furlong\" is not known; say the right one with unit = \"g\" or unit = \"cm/s2\" beside record"
    );
    let stated = read(
        &format!("time (s) acceleration (furlong)\n{table}"),
        &in_unit("g"),
    );
    assert_values(&stated, &values, G, 1e-6);
    let message = error(
        &format!("time (s) acceleration (cm/s)\n{table}"),
        &in_unit("g"),
    );
    assert!(message.contains("velocity or displacement"), "{message}");
}

#[test]
fn quoted_cells_and_decimal_commas_are_read() {
    let values = burst();
    let quoted = rows(&values, |i, a| {
        format!("\"{:.3}\",\"{a:.6}\"", STEP * i as f64)
    });
    let text = format!("\"Time (s)\",\"Acc (g)\"\n{quoted}");
    assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);
    let commas = text.replace("\",\"", "\";\"").replace('.', ",");
    assert_values(&read(&commas, &RecordOptions::default()), &values, G, 1e-6);
    let inside = text.replace('.', ",");
    assert_values(&read(&inside, &RecordOptions::default()), &values, G, 1e-6);
    // Between tabs, and alone on their lines.
    let tabs = format!(
        "Time (s)\tAcc (g)\n{}",
        columns(&values).replace(' ', "\t").replace('.', ",")
    );
    assert_values(&read(&tabs, &RecordOptions::default()), &values, G, 1e-6);
    for digits in [6, 2] {
        let one = rows(&values, |_, a| format!("{:.digits$}", 100.0 * a)).replace('.', ",");
        let options = with(|options| {
            options.unit = Some("gal".into());
            options.step = Some(STEP);
        });
        let hundred: Vec<f64> = values.iter().map(|a| 100.0 * a).collect();
        let digit = 10f64.powi(-i32::try_from(digits).unwrap_or(0));
        assert_values(&read(&one, &options), &hundred, 0.01, digit);
    }
}

#[test]
fn times_of_day_are_times() {
    let values = burst();
    let clock = |start: f64, i: usize| {
        let time = start + STEP * i as f64;
        let of_day = time.rem_euclid(86_400.0);
        let hundredths = (100.0 * of_day).round() as u64;
        let (h, m, s) = (
            hundredths / 360_000,
            hundredths / 6000 % 60,
            hundredths % 6000,
        );
        (
            format!("{h:02}:{m:02}:{:02}.{:02}", s / 100, s % 100),
            time >= 86_400.0,
        )
    };
    for start in [0.0, 45_296.5, 86_398.5] {
        let table = rows(&values, |i, a| format!("{},{a:.6}", clock(start, i).0));
        let text = format!("Time,Acc (g)\n{table}");
        assert_values(&read(&text, &RecordOptions::default()), &values, G, 1e-6);
        // With dates, in one cell or two.
        for mark in ["T", " "] {
            for separator in [",", " "] {
                let table = rows(&values, |i, a| {
                    let (time, next) = clock(start, i);
                    let day = if next { "2024-03-01" } else { "2024-02-29" };
                    format!("{day}{mark}{time}{separator}{a:.6}")
                });
                assert_values(
                    &read(&format!("# unit = g\n{table}"), &RecordOptions::default()),
                    &values,
                    G,
                    1e-6,
                );
            }
        }
        let lost = text.lines().enumerate().filter(|(i, _)| *i != 200);
        let lost: String = lost.map(|(_, line)| format!("{line}\n")).collect();
        assert!(error(&lost, &RecordOptions::default()).starts_with(':'));
    }
}

#[test]
fn a_column_by_number_has_the_unit_of_its_header() {
    let values = burst();
    let table = rows(&values, |i, a| {
        format!(
            "{:.3},{a:.6},{:.6},{:.6}",
            STEP * i as f64,
            0.5 * a,
            0.2 * a
        )
    });
    let half: Vec<f64> = values.iter().map(|a| 0.5 * a).collect();
    let column = |column: usize| with(|options| options.column = Some(column));
    let component = |name: &str| with(|options| options.component = Some(name.into()));
    let text = format!("time(s),NS(g),EW(g),UD(g)\n{table}");
    assert_values(&read(&text, &column(2)), &values, G, 1e-6);
    assert_eq!(read(&text, &column(3)), read(&text, &component("EW")));
    let mixed = format!("Time [s],N-S [g],E-W [gal],U-D\n{table}");
    assert_values(&read(&mixed, &column(3)), &half, 0.01, 1e-6);
    let message = error(&mixed, &column(4));
    assert!(message.contains("which unit"), "{message}");
    let rows_of_units = format!("Time,N-S,E-W,U-D\ns,g,gal,mm\n{table}");
    assert_values(&read(&rows_of_units, &column(3)), &half, 0.01, 1e-6);
    assert!(error(&rows_of_units, &column(4)).contains("\"mm\" is not an acceleration"));
    // A statement of the unit holds.
    let stated = with(|options| {
        options.column = Some(3);
        options.unit = Some("m/s2".into());
    });
    assert_values(&read(&mixed, &stated), &half, 1.0, 1e-6);
}

/// A file of the CWA as its header says.
pub(crate) fn cwa(points: usize) -> String {
    let n: Vec<f64> = burst().iter().take(points).map(|a| 400.0 * a).collect();
    let peak = |factor: f64| {
        n.iter()
            .fold(0.0, |m: f64, a| m.max((factor * a * 1e3).round() / 1e3))
    };
    let least = |factor: f64| {
        n.iter()
            .fold(0.0, |m: f64, a| m.min((factor * a * 1e3).round() / 1e3))
    };
    let mut text = format!(
        "#StationCode: XYZ001\n#InstrumentKind: CV574(00000000.CVA)\n#StartTime: 2017/01/01-00:00:00.000\n#RecordLength(sec): {:8.3}\n#SampleRate(Hz): 100\n#AmplitudeUnit:  gal. DCoffset(corr)\n",
        STEP * points as f64
    );
    for (name, factor) in [("U", 0.25), ("N", 1.0), ("E", 0.75)] {
        let _ = writeln!(
            text,
            "#AmplitudeMAX. {name}: {:9.3}~ {:9.3}",
            peak(factor),
            least(factor)
        );
    }
    text.push_str("#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n");
    for (i, a) in n.iter().enumerate() {
        let t = STEP * i as f64;
        let _ = writeln!(text, "{t:10.3}{:10.3}{a:10.3}{:10.3}", 0.25 * a, 0.75 * a);
    }
    text
}

#[test]
fn cwa_files_state_all_that_is_needed() {
    let text = cwa(400);
    let component = |name: &str| with(|options| options.component = Some(name.into()));
    let message = error(&text, &RecordOptions::default());
    assert!(
        message.contains("1: U (vertical), 2: N (0°), 3: E (90°)"),
        "{message}"
    );
    let north: Vec<f64> = burst().iter().map(|a| 400.0 * a).collect();
    let (record, info) = parse_record_and_info(text.as_bytes(), &component("N"))
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(info.format, RecordFormat::Cwa);
    assert_eq!(
        (&info.station[..], &info.date[..]),
        ("XYZ001", "2017/01/01-00:00:00.000")
    );
    assert_values(&record, &north, 0.01, 1e-3);
    assert_eq!(
        info.channel()
            .and_then(|channel: &Channel| channel.unit.clone())
            .as_deref(),
        Some("gal")
    );
    for (name, factor) in [("up", 0.25), ("E-W", 0.75), ("H1", 1.0), ("H2", 0.75)] {
        let scaled: Vec<f64> = north.iter().map(|a| factor * a).collect();
        assert_values(&read(&text, &component(name)), &scaled, 0.01, 1e-3);
    }
    // A peak, the rate and the number of rows are checked.
    for (from, to) in [
        ("#SampleRate(Hz): 100", "#SampleRate(Hz): 200"),
        ("   4.000\n", "   5.000\n"),
        ("#Data: 4F10.3", "#Data: 4F9.3"),
        ("gal. DC", "cm. DC"),
        ("U(+); N(+)", "N(+)"),
        ("     1.880", "     1.890"),
    ] {
        assert!(text.contains(from), "{from}");
        assert!(
            parse_info(
                text.replacen(from, to, 1).as_bytes(),
                &RecordOptions::default()
            )
            .is_err(),
            "{to}"
        );
    }
    let peak = format!("{:9.3}", north.iter().fold(0.0, |m: f64, a| m.max(*a)));
    let wrong = text.replacen(&format!("N: {peak}"), "N:    99.999", 1);
    assert!(error(&wrong, &component("N")).contains("states a peak of 99.999"));
    for lost in [12, 200, 411] {
        let lines = text.lines().enumerate().filter(|(i, _)| *i != lost - 1);
        let lines: String = lines.map(|(_, line)| format!("{line}\n")).collect();
        assert!(
            parse_info(lines.as_bytes(), &RecordOptions::default()).is_err(),
            "without line {lost}"
        );
    }
}

#[test]
fn lines_are_left_out_as_stated() {
    let values = burst();
    let body = rows(&values, |_, a| format!("{a:.6}"));
    let text = format!("7 numbers 8\n1 2 3\n{body}end of the record\n99\n");
    let options = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(STEP);
        options.layout.skip = Some(2);
        options.layout.last = Some(402);
    });
    assert_values(&read(&text, &options), &values, G, 1e-6);
    let shorter = RecordOptions {
        layout: RecordLayout {
            last: Some(302),
            ..options.layout.clone()
        },
        ..options.clone()
    };
    assert_values(&read(&text, &shorter), &values[..300], G, 1e-6);
    // A file of another format may be read so.
    let at2 = format!("PEER\nx\nUNITS OF G\nNPTS= 400, DT= .01 SEC\n{body}");
    let four = with(|options| {
        options.unit = Some("g".into());
        options.step = Some(STEP);
        options.layout.skip = Some(4);
    });
    assert_values(&read(&at2, &four), &values, G, 1e-6);
}

#[test]
fn statements_about_lines_are_checked() {
    let values = burst();
    let text = wrapped(&values, 8);
    let layout = |change: fn(&mut RecordLayout)| {
        with(|options| {
            options.unit = Some("g".into());
            options.step = Some(STEP);
            change(&mut options.layout);
        })
    };
    for (options, wanted) in [
        (
            layout(|l| l.per_line = Some(7)),
            ":1: 8 numbers, but per_line = 7; only the last line may have fewer",
        ),
        (
            layout(|l| l.per_line = Some(0)),
            ": read: per_line = 0: a line has one number at least",
        ),
        (
            layout(|l| l.last = Some(0)),
            ": read: last = 0: lines count from 1",
        ),
        (
            layout(|l| {
                l.skip = Some(9);
                l.last = Some(9);
            }),
            ": read: skip = 9 leaves no line up to last = 9",
        ),
        (
            layout(|l| l.skip = Some(900)),
            ": read: skip = 900, but the file has 51 lines",
        ),
        (
            layout(|l| l.widths = vec![0]),
            ": read: widths = [0]: a number has 1 to 40 characters",
        ),
        (
            layout(|l| l.widths = vec![9]),
            ":1: the line does not fit widths = [9]: every width must hold one number, and nothing may follow",
        ),
        (
            layout(|l| {
                l.content = Some(RecordContent::Pairs);
                l.per_line = Some(7);
            }),
            ": read: per_line = 7 is odd, and pairs have two numbers each",
        ),
    ] {
        assert_eq!(error(&text, &options), wanted);
    }
    // Other formats state their layout themselves.
    let mut options = layout(|l| l.skip = Some(1));
    options.format = Some(RecordFormat::Cwa);
    let message = error(&cwa(400), &options);
    assert!(
        message.starts_with(": read goes with columns of text"),
        "{message}"
    );
    let fixed = layout(|l| l.widths = vec![10]);
    assert!(error(&cwa(400), &fixed).starts_with(": read goes with columns of text"));
    // A column does not go with values that continue.
    let mut options = layout(|l| l.per_line = Some(8));
    options.column = Some(2);
    assert!(error(&text, &options).contains("column = 2 does not go with"));
}

#[test]
fn a_last_line_without_its_end_is_read_or_refused() {
    let values = burst();
    let some = &values[..60];
    let files = [
        (
            "fixed decimals",
            format!(
                "# unit = g\n# step = 0.01 s\n{}",
                rows(some, |_, a| format!("{a:.6}"))
            ),
        ),
        (
            "right-justified integers",
            format!(
                "# unit = gal\n# step = 0.01 s\n{}",
                rows(some, |_, a| format!("{:8}", (1e4 * a).round()))
            ),
        ),
        (
            "exponents",
            format!(
                "# unit = g\n# step = 0.01 s\n{}",
                rows(some, |i, a| format!("{:e}", a + 1e-9 * (i + 1) as f64))
            ),
        ),
        ("times", format!("# unit = g\n{}", columns(some))),
        (
            "three columns",
            format!(
                "time (s),acc (g),disp (mm)\n{}",
                rows(some, |i, a| format!(
                    "{:.2},{a:.5},{:.3}",
                    STEP * i as f64,
                    2.0 * a
                ))
            ),
        ),
        ("wrapped", format!("60 0.01\n{}", wrapped(some, 8))),
    ];
    for (what, text) in files {
        let options = in_unit(if text.contains("gal") { "gal" } else { "g" });
        let whole = read(&text, &options);
        assert_eq!(whole.acceleration.len(), 60, "{what}");
        assert_eq!(
            read(text.trim_end(), &options),
            whole,
            "{what} without its last line end"
        );
        // From the middle of the file on.
        for length in text.len() / 2..text.len() {
            let Ok(found) = parse_record(&text.as_bytes()[..length], &options) else {
                continue;
            };
            let count = found.acceleration.len();
            assert!(
                found.acceleration[..] == whole.acceleration[..count],
                "{what} cut to {length} bytes ends in {:?}",
                found.acceleration.last()
            );
        }
    }
}

#[test]
fn model_files_say_how_lines_are_read() {
    use std::path::Path;

    use jostle_io::{Format, MotionSource, MotionSpec, read_model_text};

    let building = "[[building]]\nkind = \"shear\"\nmass = [4e5]\nstiffness = [1e8]\n";
    let model = |motion: &str| {
        read_model_text(
            "model.toml",
            &format!("{motion}\n{building}"),
            Format::Toml,
            Path::new(""),
        )
        .map_err(|error| error.to_string())
    };
    let layout = |spec: &MotionSpec| match &spec.source {
        MotionSource::Record { options, .. } => options.layout.clone(),
        other => panic!("{other:?}"),
    };
    let input = model(
        "[motion]\nrecord = \"a.txt\"\nread = { skip = 2, last = 4002, per_line = 8, content = \"values\", widths = [10] }\nacross = { record = \"b.txt\", read = { content = \"pairs\" } }",
    );
    let input = input.unwrap_or_else(|error| panic!("{error}"));
    let motion = input.motion.expect("it has a motion");
    assert_eq!(
        layout(&motion),
        RecordLayout {
            skip: Some(2),
            last: Some(4002),
            per_line: Some(8),
            content: Some(RecordContent::Values),
            widths: vec![10],
        }
    );
    let across = motion
        .bearing
        .and_then(|bearing| bearing.across)
        .expect("a motion across");
    assert_eq!(layout(&across).content, Some(RecordContent::Pairs));
    for (read, wanted) in [
        ("{ skip = -1 }", "motion.read.skip: expected a whole number"),
        (
            "{ per_line = 0 }",
            "motion.read: per_line = 0: a line has one number at least",
        ),
        ("{ content = \"pair\" }", "motion.read.content"),
        (
            "{ widths = [8, \"9\"] }",
            "motion.read.widths[1]: expected a whole number",
        ),
        (
            "{ widths = [80] }",
            "motion.read: widths = [80]: a number has 1 to 40 characters",
        ),
        (
            "{ skip = 9, last = 4 }",
            "motion.read: skip = 9 leaves no line up to last = 4",
        ),
        ("{ skipped = 2 }", "skipped"),
        ("2", "motion.read: expected a table such as { skip = … }"),
    ] {
        let error = model(&format!("[motion]\nrecord = \"a.txt\"\nread = {read}")).expect_err(read);
        assert!(
            error.contains(wanted) && error.contains("model.toml:3"),
            "{read}: {error}"
        );
    }
    let error = model(
        "[motion]\nkind = \"sine\"\namplitude = 1\nperiod = 1\nduration = 1\nread = { skip = 1 }",
    );
    assert!(
        error
            .expect_err("a sine")
            .contains("motion.read: does not go with an analytic wave")
    );
}
