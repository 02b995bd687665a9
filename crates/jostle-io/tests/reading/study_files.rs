//! Study files: damaged ones are refused without a panic, good ones keep their values to the last bit.

use std::path::Path;

use jostle_io::{FactorValues, Format, Shape, StudyFile, TreeValue};

const STUDY: &str = r#"title = "All of it"
base = "paper"
histories = [0, 3]
[design]
kind = "latin-hypercube"
samples = 20
seed = 7
sampling = "sobol"
quantiles = [0.2, 0.8]
correlation = [{ between = ["k", "m"], value = 0.5 }]
[[vary]]
name = "gap"
path = "gap[*].width"
range = { from = "5 mm", to = "80 mm", count = 5, spacing = "log" }
[[vary]]
path = ["motion.pga", "motion.pga"]
values = ["0.2 g", 3, "100 gal"]
[[vary]]
name = "k"
path = "building.J1.stiffness_factor"
distribution = { kind = "lognormal", mean = 0.5, cov = 0.2, low = 0.1 }
[[vary]]
name = "m"
path = "building[1].beam_mass"
multiply = true
distribution = { kind = "normal", mean = 1, deviation = 0.1, low = 0.5, high = 1.5 }
[[fragility]]
intensity = "pga_m_s2"
demand = "peak_force_n"
threshold = "1 MN"
by = "gap"
method = "stripes"
bootstrap = 10
confidence = 0.8
[[ida]]
intensity = "pga_m_s2"
demand = "closing_peak_m"
[sensitivity]
responses = ["peak_force_n"]
"#;

fn read(text: &str) -> Result<StudyFile, jostle_io::InputError> {
    StudyFile::parse("s.toml", text, Format::Toml, Path::new(""), None)
}

#[test]
fn values_are_kept_in_si_and_as_written() {
    let study = read(STUDY).unwrap_or_else(|error| panic!("{error}"));
    let listed = |factor: usize| match &study.factors[factor].values {
        FactorValues::Listed(levels) => levels.clone(),
        other => panic!("{other:?}"),
    };
    let gaps = listed(0);
    assert_eq!(gaps[0].value, TreeValue::Text("5.0 mm".into()));
    assert_eq!(gaps[4].number, Some(0.08));
    for pair in gaps.windows(2) {
        let ratio = pair[1].number.unwrap_or(0.0) / pair[0].number.unwrap_or(1.0);
        assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
    }
    let numbers: Vec<Option<f64>> = listed(1).iter().map(|level| level.number).collect();
    assert_eq!(numbers, [Some(0.2 * 9.80665), Some(3.0), Some(1.0)]);
    assert_eq!(study.factors[1].unit, "m_s2");
    let FactorValues::Drawn(k) = &study.factors[2].values else {
        panic!("a distribution");
    };
    let dispersion = (1.0_f64 + 0.04).ln().sqrt();
    match k.shape {
        Shape::LogNormal {
            median,
            dispersion: d,
        } => {
            assert!((d - dispersion).abs() < 1e-15);
            assert!((median - 0.5 / 1.04_f64.sqrt()).abs() < 1e-15);
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(study.fragilities[0].threshold, 1e6);
    assert_eq!((study.design.samples, study.design.seed), (Some(20), 7));
}

#[test]
fn damaged_studies_are_refused_without_a_panic() {
    let boundaries = (0..STUDY.len()).filter(|at| STUDY.is_char_boundary(*at));
    for at in boundaries {
        let _ = read(&STUDY[..at]);
        let _ = read(&STUDY[at..]);
    }
    let lines: Vec<&str> = STUDY.lines().collect();
    let odd = [
        "-1",
        "1e400",
        "\"\"",
        "[]",
        "{}",
        "true",
        "\"x\"",
        "nan",
        "[[1]]",
        "\"5 qq\"",
        "99999999999999999999",
    ];
    for (number, line) in lines.iter().enumerate() {
        let mut without = lines.clone();
        without.remove(number);
        let _ = read(&without.join("\n"));
        let Some((key, _)) = line.split_once(" = ") else {
            continue;
        };
        for value in odd {
            let mut other: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
            other[number] = format!("{key} = {value}");
            // Whatever is said, it ends with a count of faults or is accepted.
            if let Err(error) = read(&other.join("\n")) {
                assert!(!error.faults.is_empty(), "{key} = {value}");
            }
        }
    }
}
