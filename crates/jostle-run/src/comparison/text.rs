//! A comparison on one screen.

use std::fmt::Write;
use std::path::Path;

use jostle_io::shown::ACCELERATION;

use super::Comparison;
use crate::numbers::counted;
use crate::style::{BOLD, styled};

/// A column of a history in words: `A.floor1.displacement_m` is "A, floor 1, displacement".
pub(super) fn in_words(column: &str) -> String {
    const UNITS: [&str; 8] = ["_n_m", "_m_s2", "_m_s", "_n_s", "_n", "_m", "_j", "_rad"];
    let plain = UNITS
        .iter()
        .find_map(|unit| column.strip_suffix(unit))
        .unwrap_or(column);
    let parts = plain.split('.').map(|part| {
        let numbered = ["floor", "contact", "link"].iter().find_map(|kind| {
            let number = part.strip_prefix(kind)?.parse::<usize>().ok()?;
            Some(format!("{kind} {number}"))
        });
        numbered.unwrap_or_else(|| part.replace('_', " "))
    });
    parts.collect::<Vec<_>>().join(", ")
}

impl Comparison {
    /// What agrees, in sentences.
    #[must_use]
    pub fn headline(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let worst = self
            .columns
            .iter()
            .filter_map(|column| Some((column.score.correlation?, &column.computed_name)));
        if let Some((least, name)) = worst.min_by(|a, b| a.0.total_cmp(&b.0)) {
            sentences.push(format!(
                "Correlation with the measurements is {least:.3} or better in {}; worst: {}.",
                counted(self.columns.len(), "history").replace("historys", "histories"),
                in_words(name)
            ));
        }
        for impacts in &self.impacts {
            let score = &impacts.score;
            sentences.push(format!(
                "{} of {} and {} computed ones are matched within {:.0} ms.",
                score.matched_count,
                counted(score.measured_count, "measured impact"),
                score.computed_count,
                1e3 * impacts.window
            ));
        }
        sentences
    }

    /// Scores as a table for a terminal. `page` is named at the end.
    #[must_use]
    pub fn describe(&self, page: Option<&Path>) -> String {
        let mut text = format!("{}\n\n", styled(BOLD, &self.title));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{}, table motion {}, {:.2} s from {:.2} s on, peak {}\n",
            self.files[0],
            self.table_column,
            self.step * (self.time.len() - 1) as f64,
            self.start,
            ACCELERATION.text(self.summary.motion.pga_m_s2, 3)
        );
        if !self.columns.is_empty() {
            let names = self
                .columns
                .iter()
                .map(|column| column.computed_name.chars().count());
            let width = names.max().unwrap_or(0).max(8);
            let measured = self
                .columns
                .iter()
                .map(|column| column.measured_name.chars().count());
            let counts = measured.max().unwrap_or(0).max(8);
            let _ = writeln!(
                text,
                "  {:<counts$}  {:<width$}  {:>11}  {:>11}  {:>6}  {:>11}  {:>10}",
                "measured", "computed", "peak", "peak", "ratio", "correlation", "difference"
            );
            for column in &self.columns {
                let score = &column.score;
                let number = |value: Option<f64>, decimals: usize| {
                    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
                };
                let difference = score.rms_difference.map(|value| 100.0 * value);
                let _ = writeln!(
                    text,
                    "  {:<counts$}  {:<width$}  {:>11}  {:>11}  {:>6}  {:>11}  {:>10}",
                    column.measured_name,
                    column.computed_name,
                    format!("{} {}", four(score.peak_measured), column.unit),
                    format!("{} {}", four(score.peak_computed), column.unit),
                    number(score.peak_ratio, 3),
                    number(score.correlation, 4),
                    format!("{} %", number(difference, 2)),
                );
            }
        }
        for impacts in &self.impacts {
            let score = &impacts.score;
            let _ = write!(
                text,
                "\n  impacts: {} measured ({}), {} computed at {}; {} matched within {:.1} ms",
                score.measured_count,
                impacts.sign,
                score.computed_count,
                match &impacts.contacts[..] {
                    [one] => one.clone(),
                    several => counted(several.len(), "contact"),
                },
                score.matched_count,
                1e3 * impacts.window
            );
            if let (Some(mean), Some(most)) =
                (score.time_difference_mean_s, score.time_difference_peak_s)
            {
                let _ = write!(
                    text,
                    ", computed {:+.2} ms later on average, {:.2} ms apart at most",
                    1e3 * mean,
                    1e3 * most
                );
            }
            text.push('\n');
        }
        for note in &self.notes {
            let _ = write!(text, "\n  note: {note}");
        }
        if let Some(page) = page {
            let _ = write!(text, "\n\n  {}", page.display());
        }
        text
    }
}

/// A number with four digits.
pub(super) fn four(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let magnitude = libm::log10(value.abs()).floor() as i32;
    if !(-4..6).contains(&magnitude) {
        return format!("{value:.3e}");
    }
    let decimals = usize::try_from(3 - magnitude).unwrap_or(0);
    format!("{value:.decimals$}")
}
