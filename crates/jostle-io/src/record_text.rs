//! Ground motions as text files.

use std::fmt::Write;

use crate::csv::csv_remark;
use jostle::statics::STANDARD_GRAVITY;

/// A PEER AT2 file in g, eight digits, five values a line.
#[must_use]
pub fn at2_text(name: &str, step: f64, acceleration: &[f64]) -> String {
    let name = one_line(name);
    let mut text = format!(
        "ACCELEROGRAM WRITTEN BY JOSTLE\n{name}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {:6}, DT= {step} SEC\n",
        acceleration.len()
    );
    for line in acceleration.chunks(5) {
        for value in line {
            // Writing to a string cannot fail.
            let _ = write!(text, " {:15.7E}", value / STANDARD_GRAVITY);
        }
        text.push('\n');
    }
    text
}

/// Columns of time and acceleration in m/s², with all digits, under a header with unit and step.
#[must_use]
pub fn csv_text(name: &str, step: f64, acceleration: &[f64]) -> String {
    let name = csv_remark(&one_line(name));
    let mut text =
        format!("# {name}\n# unit = m/s2\n# step = {step} s\ntime_s,acceleration_m_s2\n");
    for (i, value) in acceleration.iter().enumerate() {
        // Products such as 3 · 0.01 have rounding errors that should not be printed.
        let time = (step * i as f64 * 1e9).round() / 1e9;
        let _ = writeln!(text, "{time},{value}");
    }
    text
}

fn one_line(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{RecordOptions, parse_record};

    #[test]
    fn what_is_written_is_read_again() {
        let values: Vec<f64> = (0..37).map(|i| (0.7 * f64::from(i)).sin() * 3.3).collect();
        for step in [0.01, 0.005, 0.0123] {
            let csv = csv_text("a\nname", step, &values);
            let record = parse_record(csv.as_bytes(), &RecordOptions::default()).unwrap();
            assert_eq!((record.step, &record.acceleration), (step, &values));
            let at2 = at2_text("a name", step, &values);
            let record = parse_record(at2.as_bytes(), &RecordOptions::default()).unwrap();
            assert_eq!(record.step, step);
            for (a, b) in record.acceleration.iter().zip(&values) {
                assert!((a - b).abs() < 1e-7 * b.abs().max(1e-3), "{a} for {b}");
            }
        }
    }
}
