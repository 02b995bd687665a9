//! A suite on one screen.

use std::fmt::Write;
use std::path::Path;

use jostle_io::shown::{self, ACCELERATION, FORCE, LENGTH, MOMENT};
use jostle_run::{BOLD, DIM, LOUD, plain, styled, write_findings};

use super::quantities::list;
use super::results::{RecordResult, SuiteResults};
use super::statistics::QuantityStatistics;

/// Records listed at most.
const LISTED: usize = 40;
/// Buildings with a column of drifts.
const DRIFTS: usize = 4;

/// How a quantity is shown: factor on the SI value, unit, decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shown {
    pub(super) factor: f64,
    pub(super) unit: &'static str,
    pub(super) decimals: usize,
}

/// The form of a quantity by the unit at the end of its name.
pub(super) fn shown(name: &str) -> Shown {
    let form = |end, unit: shown::Shown, decimals| {
        (end, unit.of(1.0), unit.name(), unit.decimals(decimals))
    };
    let forms: [(&str, f64, &str, usize); 14] = [
        ("drift_peak", 100.0, "%", 3),
        ("drift_across_peak", 100.0, "%", 3),
        ("drift_corner_peak", 100.0, "%", 3),
        ("_rad", 1e3, "mrad", 2),
        form("_m_s2", ACCELERATION, 2),
        form("moment_peak_n_m", MOMENT, 0),
        form("torque_peak_n_m", MOMENT, 0),
        form("_n", FORCE, 1),
        form("_m", LENGTH, 1),
        ("impact_count", 1.0, "", 1),
        ("hinges_yielded", 1.0, "", 1),
        ("ductility", 1.0, "", 2),
        ("capacity_ratio", 1.0, "", 2),
        ("capacity_exceeded", 1.0, "", 1),
    ];
    let found = forms.into_iter().find(|(end, ..)| name.ends_with(end));
    let (_, factor, unit, decimals) = found.unwrap_or(("", 1.0, "", 3));
    Shown {
        factor,
        unit,
        decimals,
    }
}

impl Shown {
    pub(super) fn number(self, value: f64) -> String {
        let shown = self.factor * value;
        // Counts are whole unless they are means.
        let decimals = match self.unit.is_empty() && self.decimals == 1 && shown.fract() == 0.0 {
            true => 0,
            false => self.decimals,
        };
        format!("{shown:.decimals$}")
    }
}

/// Quantities of the tables on screen and page, with their names in words: of every gap, then of every building.
pub(super) fn headlines(results: &SuiteResults) -> Vec<(String, &QuantityStatistics)> {
    const ENDS: [(&str, &str); 20] = [
        (".peak_force_n", "peak force"),
        (".impact_count", "impacts"),
        (".closing_peak_m", "peak closing"),
        (".closing_without_contact_m", "gap needed"),
        (".stroke_peak_m", "stroke of bearings"),
        (".bearing_force_peak_n", "force of bearings"),
        (".roof_displacement_peak_m", "roof displacement"),
        (".corner_displacement_peak_m", "displacement of corners"),
        (".drift_peak", "storey drift"),
        (".drift_across_peak", "storey drift across"),
        (".drift_corner_peak", "storey drift of corners"),
        (".total_acceleration_peak_m_s2", "floor acceleration"),
        (
            ".total_acceleration_across_peak_m_s2",
            "floor acceleration across",
        ),
        (".base_shear_peak_n", "base shear"),
        (".base_shear_across_peak_n", "base shear across"),
        (".base_torque_peak_n_m", "base torque"),
        (".ductility", "ductility"),
        (".capacity_ratio", "demand over capacity of members"),
        (".residual_drift_peak", "drift at the end"),
        (".storey_shear_peak_n", "storey shear"),
    ];
    // Peaks that are those along x, where a building has others.
    const ALONG: [&str; 4] = [
        ".roof_displacement_peak_m",
        ".drift_peak",
        ".total_acceleration_peak_m_s2",
        ".base_shear_peak_n",
    ];
    // Names of quantities join those of a pair by a hyphen.
    let gaps = results.records.first().into_iter();
    let gaps = gaps.flat_map(|record| list(&record.summary, "gaps"));
    let pairs: Vec<(String, String)> = gaps
        .map(|gap| {
            let names: Vec<&str> = list(gap, "between")
                .filter_map(|name| name.as_str())
                .collect();
            (names.join("-"), names.join(" ↔ "))
        })
        .collect();
    let all = results.quantities.iter().filter_map(|quantity| {
        let owned = ENDS.iter().find_map(|(end, words)| {
            let owner = quantity.name.strip_suffix(end)?;
            // Floors and the run without contact have names of more parts.
            let plain = !owner.ends_with(".without_contact") && !is_floor(owner);
            let is_in_plan = results.quantity(&format!("{owner}.drift_across_peak"));
            let along = match is_in_plan.is_some() && ALONG.contains(end) {
                true => " along x",
                false => "",
            };
            let (owner, range) = match owner.strip_suffix(".range") {
                Some(owner) => (owner, ", range of bearings"),
                None => (owner, ""),
            };
            let pair = pairs.iter().find(|(joined, _)| joined == owner);
            let owner = pair.map_or(owner, |(_, pair)| pair);
            plain.then(|| format!("{owner}, {words}{along}{range}"))
        })?;
        Some((owned, quantity))
    });
    // Elastic buildings keep no drift: what is left at the end of a motion is free vibration.
    let elastic = |owner: &str| results.quantity(&format!("{owner}.ductility")).is_none();
    let kept = |name: &str| {
        let owner = name.strip_suffix(".residual_drift_peak");
        !owner.is_some_and(elastic)
    };
    all.filter(|(_, quantity)| kept(&quantity.name)).collect()
}

fn is_floor(owner: &str) -> bool {
    owner
        .rsplit_once(".floor")
        .is_some_and(|(_, number)| number.chars().all(|c| c.is_ascii_digit()))
}

impl SuiteResults {
    /// The suite on one screen, with styles; `page` is the file to open next.
    #[must_use]
    pub fn describe(&self, page: Option<&Path>) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write_text(&mut text, page);
        text
    }

    /// The same without styles.
    #[must_use]
    pub fn plain_text(&self) -> String {
        plain(&self.describe(None))
    }

    fn write_text(&self, text: &mut String, page: Option<&Path>) -> std::fmt::Result {
        writeln!(text, "{}", styled(BOLD, &self.title))?;
        writeln!(text, "{}", self.governing.in_words(self.records.len()))?;
        self.write_records(text)?;
        self.write_quantities(text)?;
        for warning in &self.warnings {
            writeln!(text, "{} {warning}", styled(LOUD, "warning:"))?;
        }
        for record in &self.records {
            for warning in list(&record.summary, "warnings") {
                let warning = warning.as_str().unwrap_or_default();
                writeln!(
                    text,
                    "{} {}: {warning}",
                    styled(DIM, "note:"),
                    record.motion()
                )?;
            }
        }
        let rest = page.map_or("suite.json", |_| "suite.html");
        write_findings(text, &self.checks, rest)?;
        if let Some(accuracy) = self.accuracy_in_words() {
            writeln!(text, "\n{accuracy}")?;
        }
        if let Some(page) = page {
            writeln!(text, "→ {}", styled(BOLD, &page.display().to_string()))?;
        }
        Ok(())
    }

    fn write_records(&self, text: &mut String) -> std::fmt::Result {
        let names = self
            .records
            .iter()
            .map(|record| record.motion().chars().count());
        let width = names.fold(6, usize::max).min(32);
        let buildings: Vec<&str> = self.records.first().map_or_else(Vec::new, |record| {
            let all = list(&record.summary, "buildings");
            all.filter_map(|b| b["name"].as_str())
                .take(DRIFTS)
                .collect()
        });
        write!(
            text,
            "\n{:width$}  {:>7}  {:>7}  {:>10}",
            "record", "peak", "impacts", "force"
        )?;
        // Of a building with a plan, the drift of its corners.
        let of_corners = |name: &str| self.quantity(&format!("{name}.drift_corner_peak"));
        let heads: Vec<String> = buildings
            .iter()
            .map(|name| match of_corners(name) {
                Some(_) => format!("corner drift {name}"),
                None => format!("drift {name}"),
            })
            .collect();
        for head in &heads {
            write!(text, "  {head:>12}")?;
        }
        writeln!(text)?;
        for record in self.records.iter().take(LISTED) {
            let motion: String = record.motion().chars().take(width).collect();
            write!(
                text,
                "{motion:width$}  {:>5.3} g",
                peak(record) / jostle_io::STANDARD_GRAVITY
            )?;
            if let Some(reason) = &record.reason {
                writeln!(text, "  {}", styled(LOUD, reason))?;
                continue;
            }
            let gaps = || list(&record.summary, "gaps");
            let impacts: u64 = gaps().filter_map(|gap| gap["impact_count"].as_u64()).sum();
            let force = gaps().filter_map(|gap| gap["peak_force_n"].as_f64());
            let force = force.fold(0.0, f64::max);
            write!(
                text,
                "  {impacts:>7}  {:>7} {}",
                FORCE.number(force, 1),
                FORCE.name()
            )?;
            for (name, head) in buildings.iter().zip(&heads) {
                let index = self.records.iter().position(|r| std::ptr::eq(r, record));
                let of_axes = || self.quantity(&format!("{name}.drift_peak"));
                let drift = of_corners(name).or_else(of_axes);
                let drift = drift.zip(index).and_then(|(q, index)| q.values[index]);
                let width = head.chars().count().max(12) - 2;
                write!(text, "  {:>width$.3} %", 100.0 * drift.unwrap_or(f64::NAN))?;
            }
            writeln!(text)?;
        }
        if self.records.len() > LISTED {
            writeln!(text, "… and {} more", self.records.len() - LISTED)?;
        }
        Ok(())
    }

    fn write_quantities(&self, text: &mut String) -> std::fmt::Result {
        let lines = headlines(self);
        let width = lines.iter().map(|(name, _)| name.chars().count());
        let width = width.fold(20, usize::max).min(60);
        writeln!(
            text,
            "\n{:width$}  {:>20}  {:>34}  {:>15}",
            "", "mean ± deviation", "greatest", "governing"
        )?;
        for (name, quantity) in &lines {
            let form = shown(&quantity.name);
            let spread = quantity
                .standard_deviation
                .map_or_else(String::new, |deviation| {
                    format!(" ± {}", form.number(deviation))
                });
            let worst: String = self.records[quantity.maximum_record]
                .motion()
                .chars()
                .take(22)
                .collect();
            let greatest = form.number(quantity.maximum);
            writeln!(
                text,
                "{name:width$}  {:>20}  {:>34}  {:>15}",
                format!("{}{spread}", form.number(quantity.mean)),
                format!("{greatest} ({worst})"),
                format!("{} {:4}", form.number(quantity.governing), form.unit),
            )?;
        }
        Ok(())
    }
}

fn peak(record: &RecordResult) -> f64 {
    record.summary["motion"]["pga_m_s2"].as_f64().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_follow_from_the_ends_of_names() {
        for (name, value, text) in [
            ("A.drift_peak", 0.0123, "1.230 %"),
            ("A-B.peak_force_n", 1.2345e6, "1234.5 kN"),
            ("A.floor3.total_acceleration_peak_m_s2", 3.456, "3.46 m/s²"),
            ("A.floor3.overturning_moment_peak_n_m", 4.2e6, "4200 kN·m"),
            ("A-B.closing_peak_m", 0.1, "100.0 mm"),
            ("A-B.impact_count", 12.0, "12 "),
        ] {
            let form = shown(name);
            assert_eq!(format!("{} {}", form.number(value), form.unit), text);
        }
        assert!(is_floor("A.floor12") && !is_floor("A.floors"));
    }
}
