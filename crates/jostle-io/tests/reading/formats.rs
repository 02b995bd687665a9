//! Every format is told by its content and read to the digits it has, with its channels and its header.

use crate::fixture::{self, Fixture};
use jostle_io::{
    Direction, Format, MotionSource, RecordFormat, RecordOptions, parse_info, parse_record,
    parse_record_and_info, read_model_text,
};

fn by_name(name: &str) -> Fixture {
    let all = fixture::all(100);
    let found = all.into_iter().find(|fixture| fixture.name == name);
    found.unwrap_or_else(|| panic!("no fixture {name}"))
}

fn error(bytes: &[u8], options: &RecordOptions) -> String {
    let read = parse_record(bytes, options);
    read.expect_err("this record should be refused").to_string()
}

#[test]
fn every_format_is_told_and_read() {
    for points in [100, 1_200] {
        for fixture in fixture::all(points) {
            let Fixture { name, .. } = fixture;
            let read = parse_record_and_info(&fixture.bytes, &fixture.options);
            let (record, info) = read.unwrap_or_else(|error| panic!("{name}{error}"));
            let key = name.split([' ', ',']).next().unwrap_or("");
            let key = match key {
                "kiknet" => "knet",
                "csv" | "one" => "columns",
                key => key,
            };
            assert_eq!(info.format.key(), key, "format of {name}");
            assert!(
                (record.step / fixture.step - 1.0).abs() < 1e-12,
                "step of {name}: {}",
                record.step
            );
            assert_eq!(
                record.acceleration.len(),
                fixture.acceleration.len(),
                "values of {name}"
            );
            for (found, wanted) in record.acceleration.iter().zip(&fixture.acceleration) {
                assert!(
                    (found - wanted).abs() <= fixture.tolerance,
                    "{name}: {found}, not {wanted} within {}",
                    fixture.tolerance
                );
            }
            let forced = RecordOptions {
                format: Some(info.format),
                ..fixture.options.clone()
            };
            assert_eq!(
                parse_record(&fixture.bytes, &forced).ok(),
                Some(record),
                "{name}, format named"
            );
        }
    }
}

#[test]
fn every_other_format_is_refused_when_it_is_forced() {
    for fixture in fixture::all(100) {
        let right =
            RecordFormat::detect(&fixture.bytes).unwrap_or_else(|e| panic!("{}{e}", fixture.name));
        for format in RecordFormat::ALL
            .into_iter()
            .filter(|format| *format != right)
        {
            let options = RecordOptions {
                format: Some(format),
                ..fixture.options.clone()
            };
            assert!(
                parse_record(&fixture.bytes, &options).is_err(),
                "{} read as {format}",
                fixture.name
            );
        }
    }
}

#[test]
fn formats_have_words() {
    for format in RecordFormat::ALL {
        assert_eq!(RecordFormat::from_key(format.key()).ok(), Some(format));
    }
    assert_eq!(
        RecordFormat::from_key("K-NET").ok(),
        Some(RecordFormat::Knet)
    );
    let error = RecordFormat::from_key("xyz")
        .expect_err("no format")
        .to_string();
    let words = RecordFormat::ALL.map(RecordFormat::key).join(", ");
    assert_eq!(
        error,
        format!(": there is no record format \"xyz\"; formats: {words}")
    );
}

#[test]
fn components_are_chosen_by_number_name_direction_or_order() {
    let fixture = by_name("csmip v2");
    let channel = |component: &str| {
        let options = RecordOptions {
            component: Some(component.into()),
            ..RecordOptions::default()
        };
        let (_, info) =
            parse_record_and_info(&fixture.bytes, &options).map_err(|e| e.to_string())?;
        Ok::<_, String>(info.channel().map_or(0, |channel| channel.number))
    };
    for (component, wanted) in [
        ("1", 1),
        ("H1", 1),
        ("360 Deg", 1),
        ("360", 1),
        ("000", 1),
        ("N-S", 1),
        ("north", 1),
        ("2", 2),
        ("up", 2),
        ("UD", 2),
        ("vertical", 2),
        ("3", 3),
        ("h2", 3),
        ("90 deg", 3),
        ("090", 3),
        ("E-W", 3),
        ("ew", 3),
    ] {
        assert_eq!(channel(component), Ok(wanted), "component {component}");
    }
    for component in ["4", "45", "H3", "270", "W", "", "x"] {
        assert_eq!(
            channel(component),
            Err(format!(
                ": there is no component \"{component}\" in this CSMIP file. There are: 1: 360 Deg (0°), 2: Up (vertical), 3: 90 Deg (90°)"
            ))
        );
    }
    assert_eq!(
        error(&fixture.bytes, &RecordOptions::default()),
        ": this CSMIP file has several components; choose one with component = \"H1\" beside record. There are: 1: 360 Deg (0°), 2: Up (vertical), 3: 90 Deg (90°)"
    );
}

#[test]
fn the_only_horizontal_channel_needs_no_choice() {
    // One horizontal channel and a vertical one.
    let fixture = by_name("miniseed int32");
    let (_, info) =
        parse_record_and_info(&fixture.bytes, &fixture.options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        info.channel().map(|channel| channel.name.as_str()),
        Some("HNE")
    );
    assert_eq!(info.channels.len(), 2);
}

#[test]
fn files_describe_themselves() {
    let fixture = by_name("csmip v2");
    let info =
        parse_info(&fixture.bytes, &RecordOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(info.format, RecordFormat::Csmip);
    assert_eq!(info.station, "Some Creek");
    assert_eq!(info.event, "Record of Mon Feb 13, 2012");
    assert_eq!(info.date, "2/13/12, 21:06:45.0 UTC (GPS)");
    assert_eq!(info.chosen, None);
    let channel = &info.channels[1];
    assert_eq!((channel.number, channel.name.as_str()), (2, "Up"));
    assert_eq!(channel.direction, Direction::Vertical);
    assert_eq!(channel.unit.as_deref(), Some("cm/sec2"));
    assert_eq!((channel.step, channel.points), (Some(0.005), 100));
    let stated = channel.stated_peak.map_or(0.0, f64::abs);
    assert!(
        (stated - channel.largest).abs() < 1e-3,
        "{stated} and {}",
        channel.largest
    );

    let fixture = by_name("knet");
    let info =
        parse_info(&fixture.bytes, &RecordOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        (info.station.as_str(), info.date.as_str()),
        ("XXX001", "2011/01/02 03:04:43")
    );
    assert_eq!(info.event, "M 6.2 of 2011/01/02 03:04:00");
    assert_eq!(
        info.channel().map(|c| c.direction),
        Some(Direction::Azimuth(0.0))
    );
}

#[test]
fn counts_ask_for_unit_size_and_zero() {
    let fixture = by_name("miniseed int32");
    let bare = RecordOptions::default();
    let message = error(&fixture.bytes, &bare);
    assert!(
        message.starts_with(": miniSEED states no unit (largest number: "),
        "{message}"
    );
    assert!(
        message.ends_with("record_scale = 1/sensitivity"),
        "{message}"
    );

    // The same file with a zero of 20000 counts.
    let lifted = {
        let samples = miniseed_rs::Samples::Int((0..49).map(|i| 20_000 + (i % 7) * 10).collect());
        let record = miniseed_rs::MseedRecord::new()
            .with_nslc("XX", "ABC", "", "HN1")
            .with_sample_rate(50.0)
            .with_samples(samples);
        miniseed_rs::encode(&record).expect("a record")
    };
    let mut options = RecordOptions {
        unit: Some("cm/s2".into()),
        scale: Some(1e-3),
        ..bare
    };
    assert_eq!(
        error(&lifted, &options),
        ": the values have a mean of 20030, and swing around it by 30: the zero of the digitiser. Say remove_mean = true beside record to take it off, or remove_mean = false to keep it"
    );
    options.remove_mean = Some(true);
    let record = parse_record(&lifted, &options).unwrap_or_else(|e| panic!("{e}"));
    assert!(
        record.acceleration.iter().sum::<f64>().abs() < 1e-12,
        "no mean left"
    );
    options.remove_mean = Some(false);
    let record = parse_record(&lifted, &options).unwrap_or_else(|e| panic!("{e}"));
    assert!(
        (record.acceleration[1] - 0.2001).abs() < 1e-12,
        "{}",
        record.acceleration[1]
    );
}

#[test]
fn a_scale_in_a_sac_header_is_asked_about() {
    let mut fixture = by_name("sac big-endian");
    fixture.bytes[12..16].copy_from_slice(&2.5_f32.to_be_bytes());
    fixture.options.scale = None;
    assert_eq!(
        error(&fixture.bytes, &fixture.options),
        ": the header has SCALE = 2.5, which some programs apply and others do not; say record_scale = 2.5 beside record to multiply by it, or record_scale = 1"
    );
}

#[test]
fn options_may_not_contradict_a_header() {
    let fixture = by_name("knet");
    let with = |change: fn(&mut RecordOptions)| {
        let mut options = RecordOptions::default();
        change(&mut options);
        parse_record(&fixture.bytes, &options)
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    assert_eq!(
        with(|o| o.unit = Some("cm/s2".into())),
        Ok(()),
        "gal is cm/s2"
    );
    assert_eq!(with(|o| o.step = Some(0.01)), Ok(()));
    assert_eq!(
        with(|o| o.unit = Some("g".into())),
        Err(": the file states its unit itself (gal), and unit contradicts it (read as K-NET); omit unit".into())
    );
    assert_eq!(
        with(|o| o.step = Some(0.02)),
        Err(": the file states its time step itself (0.01 s), and step contradicts it (read as K-NET); omit step".into())
    );
    assert!(
        with(|o| o.scale = Some(2.0)).is_err(),
        "a scale beside a stated one"
    );
}

#[test]
fn velocities_displacements_and_spectra_are_refused() {
    let text = |name: &str| String::from_utf8(by_name(name).bytes).unwrap_or_default();
    let refused = |text: &str| error(text.as_bytes(), &RecordOptions::default());
    assert_eq!(
        refused(&text("smc").replace("2 CORRECTED ACCELEROGRAM", "3 VELOCITY")),
        ": this USGS SMC file holds velocities, and accelerations are needed; take the file of the corrected accelerogram"
    );
    assert_eq!(
        refused(&text("esm").replace("DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY")),
        ": this ESM file holds velocity, and accelerations are needed; take the file whose name ends in ACC.ASC"
    );
    assert_eq!(
        refused(
            &text("cosmos v2c")
                .replace("100 acceleration pts", "100 velocity     pts")
                .replace("cm/sec2(04)", "cm/sec(05)")
        ),
        ": this COSMOS file holds velocity in cm/sec, and accelerations are needed; take the file whose name has .acc."
    );
    assert_eq!(
        refused(
            "Response and Fourier amplitude spectra (86 periods,  .04 - 10.0 sec)   for\nCorrected accelerogram\n"
        ),
        ": this CSMIP file holds spectra (volume 3), and accelerations are needed; take the corrected record (volume 2)"
    );
    let mut sac = by_name("sac little-endian");
    sac.bytes[4 * 86..4 * 87].copy_from_slice(&7_i32.to_le_bytes());
    assert_eq!(
        error(&sac.bytes, &sac.options),
        ": this SAC file holds velocities (IDEP is IVEL), and accelerations are needed"
    );
}

#[test]
fn malformed_headers_name_line_and_reason() {
    let text = |name: &str| String::from_utf8(by_name(name).bytes).unwrap_or_default();
    let refused = |text: &str| error(text.as_bytes(), &RecordOptions::default());
    assert_eq!(
        refused(&text("csmip v2").replacen(" (8f10.6)", "", 1)),
        ":46: the line states no format of the values, such as (8f10.6) (read as CSMIP)"
    );
    assert_eq!(
        refused(&text("knet").replace("Scale Factor ", "Skale Factor ")),
        ":14: expected the header line \"Scale Factor\" (read as K-NET)"
    );
    assert_eq!(
        refused(&text("knet").replace("3920(gal)/6182761", "3920(gal)/0")),
        ":14: expected a factor such as 3920(gal)/6182761 for \"Scale Factor\", found \"3920(gal)/0\" (read as K-NET)"
    );
    assert_eq!(
        refused(&text("esm").replace("NDATA: 100", "NDATA: ")),
        ":18: the header has no value for \"NDATA\" (read as ESM)"
    );
    assert_eq!(
        refused(&text("esm").replace("TIME_PGA_S: 0.300000", "TIME_PGA_S: 0.100000")),
        ":13: the peak of the values does not stand at 0.1 s, where the header has it; one of them is damaged (read as ESM)"
    );
    assert_eq!(
        refused(&text("geonet v1a").replacen("intervals of 0.005 s", "intervals of 0.010 s", 1)),
        ":11: the header contradicts itself about the time step: 0.01 and 0.005 (read as GeoNet)"
    );
    assert_eq!(
        refused(&text("cosmos v2c").replace("End-of-data", "Data end")),
        ":150: expected \"End-of-data\" behind the values, found \"Data end for ChanHNE acceleration\" (read as COSMOS)"
    );
    assert_eq!(
        refused(&text("smc").replacen("-3.2768E+4", "x", 1).replacen(
            "|some comment",
            "some comment",
            1
        )),
        ":29: expected a comment beginning with |, as integer 16 announces (read as USGS SMC)"
    );
    let peak = refused(&text("knet").replace("Max. Acc. (gal)   ", "Max. Acc. (gal)   1"));
    assert!(
        peak.starts_with(":15: the header states a peak of 1"),
        "{peak}"
    );
}

#[test]
fn wrapped_files_say_what_they_are() {
    let refused = |bytes: &[u8]| error(bytes, &RecordOptions::default());
    assert_eq!(
        refused(b"PK\x03\x04..."),
        ": this is a ZIP archive; unpack it and give one of the records in it"
    );
    assert_eq!(
        refused(b"\x1f\x8b\x08..."),
        ": this is compressed with gzip; unpack it first"
    );
    assert_eq!(
        refused(b"\xff\xfe1\x00\n\x00"),
        ": this is text in UTF-16; save it as UTF-8 or plain ASCII"
    );
}

#[test]
fn families_that_are_not_read_are_named() {
    let refused = |text: &str| error(text.as_bytes(), &RecordOptions::default());
    let bhrc = format!(
        "* VOL1DS  RECORD NO:1234-01/1\nINSTRUMENT = SSA-2\n\n\nL\n\nCOMP L\nSOMEWHERE Station 30.1 50.2\n{}",
        "1 2\n".repeat(9)
    );
    assert_eq!(
        refused(&bhrc),
        ": this is a BHRC file (Iran Strong Motion Network); copy the values of one component, one on a line, into a file of their own and say its unit and step beside record (volume 1: unit = \"g/10\", and the duration over the number of points less one)"
    );
    let unam = "\n\n\n\n\n\n     ARCHIVO ESTANDAR DE ACELERACION\n\nNOMBRE DE LA ESTACION : X\n";
    assert_eq!(
        refused(unam),
        ": this is an accelerogram in the standard format of UNAM (Mexico); copy the three columns below the header into a file of their own and say unit = \"gal\", column = 1 (to 3) and step (INTERVALO DE MUESTREO) beside record"
    );
    let numbered = |first: &str| {
        let rest: String = (2..=14)
            .map(|line| format!("{:<72}{line:>2}\n", "TEXT"))
            .collect();
        format!("{first}\n{rest}")
    };
    for first in [
        "PAGE 1 OF UNCORRECTED ACCELEROGRAM DATA OF SOMEWHERE",
        "CORRECTED ACCELEROGRAM",
    ] {
        assert_eq!(
            refused(&numbered(first)),
            ": this is a file of the University of Southern California (USC); take the same record as AT2 from PEER, or copy the accelerations of one component, one on a line, into a file of their own and say its unit and step beside record"
        );
    }
}

#[test]
fn fill_bytes_behind_a_text_are_left_out() {
    for fixture in fixture::all(100).into_iter().filter(|f| f.text) {
        let right = parse_record(&fixture.bytes, &fixture.options).ok();
        assert!(right.is_some(), "{}", fixture.name);
        for fill in [&b"\x1a\x1a\x1a"[..], b"\r\n\x1a", b"\0\0\0\0\r\n\0"] {
            let filled = [&fixture.bytes[..], fill].concat();
            let read = parse_record(&filled, &fixture.options);
            assert_eq!(read.ok(), right, "{} with {fill:?}", fixture.name);
        }
        // In the midst of the text such a byte is damage.
        let mut broken = fixture.bytes.clone();
        let middle = broken.len() / 2;
        broken.insert(middle, 0);
        assert!(
            parse_record(&broken, &fixture.options).is_err(),
            "{}",
            fixture.name
        );
    }
}

#[test]
fn a_corrected_volume_must_have_its_peak_where_the_header_says() {
    let text = String::from_utf8(by_name("csmip v2").bytes).unwrap_or_default();
    let moved = text.replace("at   0.300   sec", "at   0.200   sec");
    assert_ne!(moved, text);
    assert_eq!(
        error(moved.as_bytes(), &by_name("csmip v2").options),
        ":18: the peak of the values does not stand at 0.2 s, where the header has it; one of them is damaged (read as CSMIP)"
    );
}

#[test]
fn a_sac_step_is_freed_from_the_rounding_of_one_time() {
    for name in ["sac little-endian", "sac big-endian"] {
        let fixture = by_name(name);
        let with_step = |step: f32| {
            let mut bytes = fixture.bytes.clone();
            let word = if name.ends_with("big-endian") {
                step.to_be_bytes()
            } else {
                step.to_le_bytes()
            };
            bytes[..4].copy_from_slice(&word);
            parse_record(&bytes, &fixture.options).map(|record| record.step)
        };
        // The difference of the last two times in 32 bits, 0.99 s and 0.98 s.
        let rounded = 0.99_f32 - 0.98_f32;
        assert_ne!(rounded, 0.01);
        assert_eq!(with_step(rounded).ok(), Some(0.01), "{name}");
        // A clock that runs differently is no rounding.
        assert_eq!(with_step(0.010_000_5).ok(), Some(0.010_000_5), "{name}");
        assert!(with_step(0.0101).is_err(), "{name}");
    }
}

#[test]
fn smc_pairs_are_interpolated_only_when_asked() {
    let fixture = by_name("smc, film");
    let text = String::from_utf8(fixture.bytes).unwrap_or_default();
    let moved = text.replacen(" 2.0500E-1", " 2.0900E-1", 1);
    assert_ne!(moved, text);
    assert_eq!(
        error(moved.as_bytes(), &RecordOptions::default()),
        ":30: the times of this uncorrected record are not equally spaced (steps between 0.001 s and 0.009 s); use the corrected record (volume 2), or say step = \"0.005 s\" beside record to have it interpolated linearly"
    );
    let options = RecordOptions {
        step: Some(0.01),
        ..RecordOptions::default()
    };
    let record = parse_record(moved.as_bytes(), &options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((record.step, record.acceleration.len()), (0.01, 50));
}

#[test]
fn film_times_are_interpolated_only_when_asked() {
    let fixture = by_name("csmip v1, film");
    let text = String::from_utf8(fixture.bytes).unwrap_or_default();
    // The pair at 0.205 s, moved by four milliseconds.
    let moved = text.replacen("   .205", "   .209", 1);
    let message = error(moved.as_bytes(), &RecordOptions::default());
    assert_eq!(
        message,
        ":28: the times of this uncorrected record are not equally spaced (steps between 0.001 s and 0.009 s); use the corrected record (volume 2), or say step = \"0.005 s\" beside record to have it interpolated linearly"
    );
    let options = RecordOptions {
        step: Some(0.01),
        ..RecordOptions::default()
    };
    let record = parse_record(moved.as_bytes(), &options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(record.step, 0.01);
    assert_eq!(
        record.acceleration.len(),
        50,
        "0 to 0.495 s in steps of 0.01 s"
    );
    for (at, found) in record.acceleration.iter().enumerate() {
        // Every other value stands as it was printed; only the pair at 0.21 s has a moved neighbour.
        let wanted = fixture.acceleration[2 * at];
        assert!(
            (found - wanted).abs() <= fixture.tolerance,
            "value {at}: {found}, not {wanted}"
        );
    }
}

#[test]
fn model_files_choose_component_scale_and_format() {
    let model = |keys: &str| {
        let text = format!(
            "[motion]\nrecord = \"a.mseed\"\n{keys}\n[[building]]\nkind = \"shear\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\nstorey_height = 3\n"
        );
        let read = read_model_text("m", &text, Format::Toml, std::path::Path::new("."));
        read.map_err(|error| error.to_string())
    };
    let input = model(
        "component = \"HNE\"\nunit = \"m/s2\"\nrecord_scale = 2.5e-6\nremove_mean = true\nformat = \"miniseed\"",
    );
    let motion = input.unwrap_or_else(|error| panic!("{error}")).motion;
    let Some(MotionSource::Record { options, .. }) = motion.map(|motion| motion.source) else {
        panic!("a record was asked for");
    };
    let wanted = RecordOptions {
        unit: Some("m/s2".into()),
        component: Some("HNE".into()),
        scale: Some(2.5e-6),
        remove_mean: Some(true),
        format: Some(RecordFormat::MiniSeed),
        ..RecordOptions::default()
    };
    assert_eq!(options, wanted);
    let number = model("component = 2").unwrap_or_else(|error| panic!("{error}"));
    let source = number.motion.map(|motion| motion.source);
    assert!(
        matches!(&source, Some(MotionSource::Record { options, .. }) if options.component.as_deref() == Some("2")),
        "{source:?}"
    );
    for (keys, wanted) in [
        ("component = \"\"", "motion.component: must not be empty"),
        (
            "component = true",
            "motion.component: expected a text in quotes, found true",
        ),
        ("record_scale = 0", "motion.record_scale: must not be zero"),
        ("format = \"knett\"", "did you mean \"knet\"?"),
    ] {
        let error = model(keys).expect_err("a wrong key");
        assert!(error.contains(wanted), "{keys}: {error}");
    }
}
