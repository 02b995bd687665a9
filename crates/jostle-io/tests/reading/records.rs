//! Ground-motion records: what is understood, and what is asked when something is missing.

use jostle_io::{Record, RecordOptions, STANDARD_GRAVITY, parse_record};

fn parse(text: &str) -> Result<Record, String> {
    parse_with(text, &RecordOptions::default())
}

fn parse_with(text: &str, options: &RecordOptions) -> Result<Record, String> {
    parse_record(text.as_bytes(), options).map_err(|error| error.to_string())
}

fn assert_record(text: &str, step: f64, acceleration: &[f64]) {
    let record = parse(text).unwrap_or_else(|error| panic!("{error} in\n{text}"));
    assert_eq!(record.step, step, "step of\n{text}");
    assert_eq!(
        record.acceleration.len(),
        acceleration.len(),
        "values of\n{text}"
    );
    for (found, wanted) in record.acceleration.iter().zip(acceleration) {
        assert!(
            (found - wanted).abs() < 1e-12,
            "{found}, not {wanted}, in\n{text}"
        );
    }
}

fn assert_refused(text: &str, wanted: &str) {
    let error = parse(text).expect_err("this record should be refused");
    assert_eq!(error, wanted, "for\n{text}");
}

const G: f64 = STANDARD_GRAVITY;
const HEADER: &str = "PEER STRONG MOTION DATABASE RECORD\nNOWHERE 01/01/00, UNITED STATION, NS\nACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz\n";

#[test]
fn every_form_of_the_at2_header_is_read() {
    for line in [
        "NPTS=   3, DT=   .0200 SEC",
        "NPTS=   3, DT=   .0200 SEC,        ",
        "NPTS=  3, dt=  .0200",
        "3    0.0200    NPTS, DT",
        "NPTS = 3 , DT = 0.02 sec",
    ] {
        assert_record(
            &format!("{HEADER}{line}\n  .1000000E-01  -.2000000E+00\n  .3E+0\n"),
            0.02,
            &[0.01 * G, -0.2 * G, 0.3 * G],
        );
    }
}

#[test]
fn strange_line_ends_and_long_headers_are_read() {
    let text = format!("{HEADER}one more\nand another\nNPTS= 2, DT= .01\n 0.5\n-0.5\n");
    assert_record(&text.replace('\n', "\r\r\n"), 0.01, &[0.5 * G, -0.5 * G]);
    assert_record(&text.replace('\n', "\r"), 0.01, &[0.5 * G, -0.5 * G]);
    let centimetres = text.replace("UNITS OF G.", "UNITS OF CM/SEC/SEC");
    assert_record(&centimetres, 0.01, &[0.005, -0.005]);
    let named = "title\ndetails\nThe units are (g)\nNPTS= 2, DT= .01 SEC\n1 0.5\n";
    assert_record(named, 0.01, &[G, 0.5 * G]);
}

#[test]
fn wrong_at2_files_name_the_line() {
    assert_refused(
        &format!("{HEADER}NPTS= 4, DT= .01 SEC\n1 2\n3\n"),
        ":4: the header announces 4 values, the file has 3; is it complete?",
    );
    assert_refused(
        &format!("{HEADER}NPTS= many, DT= .01 SEC\n1 2\n3\n"),
        ":4: cannot read the number of values and the time step from \"NPTS= many, DT= .01 SEC\"; expected a line such as \"NPTS= 4000, DT= .0100 SEC\"",
    );
    assert_refused(
        &format!("{HEADER}NPTS= 3, DT= .01 SEC\n1 2\n****\n"),
        ":6: \"****\" is not a number",
    );
    assert_refused(
        &HEADER
            .replace(
                "ACCELERATION TIME HISTORY IN UNITS OF G",
                "VELOCITY TIME HISTORY IN UNITS OF CM/S",
            )
            .replace(". FILTER", " FILTER")
            .chars()
            .chain("NPTS= 2, DT= .01 SEC\n1 2\n".chars())
            .collect::<String>(),
        ":3: the unit \"CM/S\" is not an acceleration; records of velocity or displacement cannot be used",
    );
    assert_refused(
        "a\nb\nc\nNPTS= 2, DT= .01 SEC\n1 2\n",
        ": which unit do the accelerations have (largest number: 2)? Say it with unit = \"g\" or unit = \"cm/s2\" beside record, or in the file's first line as # unit = g",
    );
}

#[test]
fn an_at2_header_with_two_steps_is_asked_about() {
    let text = format!("{HEADER}NPTS=   2, DT= 4 .0050 SEC,\n1 0.5\n");
    assert_refused(
        &text,
        ":4: the header gives 4 and 0.005 as the time step; correct the line, or say the right one with step = \"0.005 s\" beside record",
    );
    let options = RecordOptions {
        step: Some(0.005),
        ..RecordOptions::default()
    };
    let record = parse_with(&text, &options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((record.step, record.acceleration.len()), (0.005, 2));
}

#[test]
fn columns_of_text_are_read() {
    let wanted = [0.0, 0.5 * G, -0.25 * G];
    for text in [
        "time_s,acceleration_g\n0.00,0\n0.01,0.5\n0.02,-0.25\n",
        "time,acc (g)\n0.00,0\n0.01,0.5\n0.02,-0.25\n",
        "Time (s)\tAcc [g]\n0.00\t0\n0.01\t0.5\n0.02\t-0.25\n",
        "# unit = g\n0.00 0\n0.01 0.5\n0.02 -0.25\n",
        "# unit: g\n# dt = 0.01 s\n\n0\n0.5\n-0.25",
        "% any comment\nt;a_g\n0,00;0\n0,01;0,5\n0,02;-0,25;\n"
            .replace("a_g", "a (g)")
            .as_str(),
        "time_ms,acc_g\n0,0\n10,0.5\n20,-2.5e-1\n",
        "acceleration_g\n# step = 10 ms\n0\n0.5\n-0.25\n",
    ] {
        assert_record(text, 0.01, &wanted);
    }
    assert_record("t_s,acc_m_s2\n0,1\n0.5,2\n", 0.5, &[1.0, 2.0]);
    assert_record("t_s,acc_cm_s2\n0,100\n0.5,200\n", 0.5, &[1.0, 2.0]);
    assert_record(
        "# gravity = 9.81 m/s2\nt_s,acc_g\n0,0.1\n0.5,0.2\n",
        0.5,
        &[0.981, 1.962],
    );
}

#[test]
fn first_value_after_one_step_starts_from_rest() {
    assert_record("t_s,acc_m_s2\n0.5,1\n1.0,2\n", 0.5, &[0.0, 1.0, 2.0]);
    assert_record("t_s,acc_m_s2\n7.5,1\n8.0,2\n", 0.5, &[1.0, 2.0]);
}

#[test]
fn options_complete_what_the_file_leaves_open() {
    let options = RecordOptions {
        unit: Some("gal".into()),
        step: Some(0.02),
        column: Some(2),
        ..RecordOptions::default()
    };
    let record = parse_with("1 100 5\n1 -200 6\n", &options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(record.acceleration, [1.0, -2.0]);
    assert_eq!(record.step, 0.02);
}

#[test]
fn what_is_missing_is_asked_for() {
    assert_refused(
        "0 1\n0.01 2\n",
        ": which unit do the accelerations have (largest number: 2)? Say it with unit = \"g\" or unit = \"cm/s2\" beside record, or in the file's first line as # unit = g",
    );
    assert_refused(
        "# unit = g\n1\n2\n",
        ": which time step do the values have? Say it with step = \"0.01 s\" beside record, or in the file's first line as # step = 0.01 s",
    );
    assert_refused(
        "# unit = g\n0 1 2\n1 2 3\n",
        ":2: 3 columns; which one holds the acceleration? Say it with column = 2 beside record",
    );
}

#[test]
fn unequal_steps_name_the_line_but_rounding_is_forgiven() {
    assert_refused(
        "t_s,acc_g\n0.00,0\n0.01,1\n0.02,2\n0.04,1\n0.05,0\n",
        ":5: time 0.04 s where 0.03 s was expected; time steps must be equal, resample the record",
    );
    assert_refused(
        "t_s,acc_g\n0.00,0\n0.01,1\n0.01,2\n",
        ":4: time 0.01 s does not come after the time before it",
    );
    let rounded: String = (0..400)
        .map(|i| format!("{:.3},{}\n", f64::from(i) * 0.0125, i % 2))
        .collect();
    let record = parse(&format!("t_s,acc_g\n{rounded}")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        record.step, 0.0125,
        "0.013, 0.025, 0.038, … are rounded times"
    );
}

#[test]
fn times_rounded_to_32_bits_are_equal_steps() {
    let rows = |step: f32, keep: &dyn Fn(u16) -> bool| -> String {
        let rows = (0..9600).filter(|i| keep(*i));
        rows.map(|i| format!("{:.6} {}\n", 0.375 + f32::from(i) * step, i % 2))
            .collect()
    };
    for step in [0.025_f32, 0.005, 0.01, 0.0125] {
        let text = format!("# unit = gal\n{}", rows(step, &|_| true));
        let record = parse(&text).unwrap_or_else(|e| panic!("{step}: {e}"));
        let wanted: f64 = step.to_string().parse().unwrap_or_default();
        assert_eq!(record.step, wanted);
        assert_eq!(record.acceleration.len(), 9600);
    }
    // A lost line shows all the same.
    let lost = format!("# unit = gal\n{}", rows(0.025, &|i| i != 7000));
    let error = parse(&lost).expect_err("a line is missing");
    assert!(error.starts_with(":7002: time 175.4"), "{error}");
}

#[test]
fn impossible_values_are_refused() {
    assert_refused(
        "# step = 0.01\n# unit = g\n1\n25\n",
        ": the largest number is 25, surely not g; say the right unit, for example unit = \"cm/s2\"",
    );
    assert_refused(
        "# step = 0.01\n# unit = m/s2\n1\n250\n",
        ":4: an acceleration of 250 m/s2 is beyond any earthquake; is the unit right?",
    );
    assert_refused(
        "# step = 0.01\n# unit = g\n1\nnan\n",
        ":4: \"nan\" is not a number",
    );
    assert_refused(
        "# step = 0.01\n# unit = g\n1\n",
        ": a record needs at least two values, found 1",
    );
    assert_refused("", ": a record needs at least two values, found 0");
    assert_refused(
        "# step = 0\n# unit = g\n1\n1\n",
        ": the time step of 0 s is not usable; it must lie between 1e-6 s and 10 s",
    );
    assert_refused(
        "t_s,acc_g\n0,1\n0.01,2\n0.02\n",
        ":4: expected 2 columns as on the lines before, found 1",
    );
    assert_refused("t_s,acc_g\n0,1\n0.01,x\n", ":3: \"x\" is not a number");
    assert_refused(
        "a\0b",
        ": this is no plain text file, and neither miniSEED nor SAC; export the record as AT2, CSV or columns of text in UTF-8",
    );
}
