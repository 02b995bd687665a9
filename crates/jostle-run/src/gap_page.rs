//! Gaps needed beside those of rules, and force over gap: a page, tables and numbers.

use jostle_report::{
    Axis, Chart, Level, Section, Series, Stroke, StudyPage, render_study, required_width,
    rows_of_rules,
};

use std::path::Path;

use jostle_io::{OutputError, in_shown_units, write_atomically};

use crate::critical_gap::{CriticalGap, GapSet, gap_sets};
use crate::error::RunError;
use crate::numbers::{counted, kn, mm};
use crate::replace::{FileKind, may_write};
use jostle_io::shown::{FORCE, GROUND_ACCELERATION, HEIGHT, LENGTH};
use jostle_report::message;

/// The page.
pub const PAGE: &str = "gap.html";
/// All numbers.
const NUMBERS: &str = "gap.json";
/// The rules, with the gaps needed.
const RULES: &str = "gap.csv";
/// Force over gap.
const CURVES: &str = "gap_curve.csv";

/// First line of the table of rules.
const RULES_HEAD: &str = "left,right,motion,pga_m_s2,needed_m,reversed_needed_m,rule,gap_m,ratio_of_both_signs,impact_count,peak_force_n,reversed_impact_count,reversed_peak_force_n,clause\n";

/// First line of the table of the curves.
const CURVES_HEAD: &str =
    "left,right,motion,pga_m_s2,width_m,impact_count,peak_force_n,first_impact_s,met,reversed\n";

/// The gaps needed and what rules require as a table: one row per rule and motion, cells without a value empty.
#[must_use]
pub fn gap_rules_csv(found: &[CriticalGap]) -> String {
    let mut text = RULES_HEAD.to_owned();
    for gap in found {
        let of_gap = [
            quoted(&gap.between[0]),
            quoted(&gap.between[1]),
            quoted(&gap.motion),
            gap.pga_m_s2.to_string(),
            gap.gap_m.to_string(),
            cell(gap.reversed_gap_m),
        ]
        .join(",");
        for rule in &gap.rules {
            let cells = [
                quoted(&rule.rule),
                rule.gap_m.to_string(),
                cell(rule.ratio_of_both_signs),
                cell(rule.impact_count),
                cell(rule.peak_force_n),
                cell(rule.reversed_impact_count),
                cell(rule.reversed_peak_force_n),
                quoted(&rule.source),
            ];
            text += &format!("{of_gap},{}\n", cells.join(","));
        }
        if gap.rules.is_empty() {
            text += &format!("{of_gap},,,,,,,,\n");
        }
    }
    text
}

fn cell<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// The curves of all gaps and motions as a table: one row per width, cells without a value empty.
#[must_use]
pub fn gap_curve_csv(found: &[CriticalGap]) -> String {
    let mut text = CURVES_HEAD.to_owned();
    for gap in found {
        for (point, is_reversed) in points(gap) {
            let cells = [
                quoted(&gap.between[0]),
                quoted(&gap.between[1]),
                quoted(&gap.motion),
                gap.pga_m_s2.to_string(),
                point.width_m.to_string(),
                point.impact_count.to_string(),
                point.peak_force_n.to_string(),
                cell(point.first_impact_s),
                cell(point.met),
                is_reversed.to_string(),
            ];
            text += &cells.join(",");
            text.push('\n');
        }
    }
    text
}

/// Points of the curves of both signs of the motion, and whether they are of the reverse.
fn points(gap: &CriticalGap) -> impl Iterator<Item = (&crate::GapPoint, bool)> {
    let reversed = gap.reversed_curve.iter().map(|point| (point, true));
    gap.curve.iter().map(|point| (point, false)).chain(reversed)
}

/// Every number as JSON. `notes`: warnings.
#[must_use]
pub fn gap_json(title: &str, found: &[CriticalGap], notes: &[String]) -> String {
    let sets: Vec<_> = gap_sets(found)
        .into_iter()
        .map(|set| {
            serde_json::json!({
                "between": set.governing.between,
                "records": set.gaps.len(),
                "gap_max_m": set.governing.needed_m(),
                "gap_mean_m": set.mean_m,
                "gap_deviation_m": set.deviation_m,
            })
        })
        .collect();
    let value = serde_json::json!({
        "title": title,
        "jostle": env!("CARGO_PKG_VERSION"),
        "gaps": found,
        "sets": sets,
        "notes": notes,
    });
    serde_json::to_string_pretty(&value).unwrap_or_default()
}

/// Files of an earlier search in a folder, which new ones replace.
///
/// # Errors
/// [`RunError`] if a file that jostle did not write is in the way and `force` is not set.
pub fn earlier_gap_files(folder: &Path, force: bool) -> Result<Vec<&'static str>, RunError> {
    let files = [
        (PAGE, FileKind::GAP_PAGE),
        (NUMBERS, FileKind::GAP_NUMBERS),
        (RULES, FileKind::GAP_RULES),
        (CURVES, FileKind::GAP_CURVES),
    ];
    let mut earlier = Vec::new();
    for (name, kind) in files {
        if may_write(&folder.join(name), Some(kind), force)? {
            earlier.push(name);
        }
    }
    Ok(earlier)
}

/// Writes the page, all numbers and the tables of a search into a folder that exists; each is whole or not there. Curves of an earlier
/// search that this one has not are removed. `notes`: warnings.
///
/// # Errors
/// [`RunError::Output`] with path and reason.
pub fn write_gap_files(
    folder: &Path,
    title: &str,
    found: &[CriticalGap],
    notes: &[String],
) -> Result<(), RunError> {
    let numbers = gap_json(title, found, notes);
    write_atomically(&folder.join(NUMBERS), format!("{numbers}\n").as_bytes())?;
    write_atomically(&folder.join(RULES), gap_rules_csv(found).as_bytes())?;
    let curves = folder.join(CURVES);
    if has_curves(found) {
        write_atomically(&curves, gap_curve_csv(found).as_bytes())?;
    } else if curves.exists() {
        std::fs::remove_file(&curves).map_err(|error| OutputError::Io {
            path: curves,
            error,
        })?;
    }
    write_atomically(&folder.join(PAGE), gap_page(title, found).as_bytes())?;
    Ok(())
}

fn has_curves(found: &[CriticalGap]) -> bool {
    found.iter().any(|gap| points(gap).next().is_some())
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        return format!("\"{}\"", text.replace('"', "\"\""));
    }
    text.to_owned()
}

/// The page; it loads nothing from outside.
#[must_use]
pub fn gap_page(title: &str, found: &[CriticalGap]) -> String {
    let mut files = vec![
        (RULES.into(), message::one_row_per_rule().into()),
        (NUMBERS.into(), message::all_numbers().into()),
    ];
    if has_curves(found) {
        files.push((CURVES.into(), message::one_row_per_width().into()));
    }
    let sets = gap_sets(found);
    let answers = sets.iter().map(|set| answer(set, sets.len()));
    let sections = sets.iter().flat_map(sections_of);
    render_study(&StudyPage {
        kind: message::gap_needed(""),
        title: title.into(),
        subject: subject(&sets),
        headline: headlines(&sets),
        answers: answers.collect(),
        sections: sections.collect(),
        files,
        ..StudyPage::default()
    })
}

/// Motion that needs most of a set, with the sign that does.
fn governing(set: &GapSet<'_>) -> String {
    let gap = set.governing;
    match gap.reversed_gap_m.is_some_and(|other| other > gap.gap_m) {
        true => message::motion_reversed(&gap.motion),
        false => gap.motion.clone(),
    }
}

/// The motions, with that across them.
fn subject(sets: &[GapSet<'_>]) -> String {
    let motions = sets.first().map_or(&[][..], |set| &set.gaps[..]);
    let [first] = motions else {
        return message::several_records(motions.len());
    };
    let motion = message::one_record_of(&first.motion);
    match &first.across {
        Some(across) => message::motion_and_across(motion, across),
        None => motion,
    }
}

/// The tile of a pair: the gap needed, under which motion, and what the model has.
fn answer(set: &GapSet<'_>, pairs: usize) -> [String; 3] {
    let needed = set.governing.needed_m();
    let pair = match pairs {
        1 => String::new(),
        _ => format!(", {}", set.governing.between.join(" ↔ ")),
    };
    let there = LENGTH.text(set.governing.model_gap_m, 0);
    let there = match lacks(set) > 0.0 {
        true => message::lacks_width(there, required_width(lacks(set))),
        false => there,
    };
    let height = match set.governing.height_m > 0.0 {
        true => message::height_m(HEIGHT.number(set.governing.height_m, 2)),
        false => message::ground_level().to_owned(),
    };
    let mut note = message::governing_and_model(governing(set), there, height);
    if let Some(bounds) = set.governing.gap_at_bounds_m {
        let [lower, upper] = bounds.map(required_width);
        note = format!("{note}; {}", message::gap_needed_at_bounds(lower, upper));
    }
    if set.gaps.len() > 1 {
        let scatter = message::mean_and_deviation(
            LENGTH.text(set.mean_m, 1),
            LENGTH.text(set.deviation_m, 1),
        );
        note = format!("{note}; {scatter}");
    }
    [message::gap_needed(pair), required_width(needed), note]
}

fn headlines(sets: &[GapSet<'_>]) -> Vec<String> {
    // First the gap of the model that lacks most.
    let mut sets: Vec<&GapSet<'_>> = sets.iter().collect();
    sets.sort_by(|a, b| lacks(b).total_cmp(&lacks(a)));
    let mut all: Vec<String> = sets.iter().map(|set| headline(set)).collect();
    match sets.iter().map(|set| set.gaps.len()).min() {
        Some(1) => all.push(message::one_record_is_no_design_value().into()),
        Some(2) => all.push(message::two_records_are_no_design_value().into()),
        _ => {}
    }
    all
}

/// How much wider the gap of the model should be; 0 if it is wide enough \[m\].
fn lacks(set: &GapSet<'_>) -> f64 {
    (set.governing.needed_m() - set.governing.model_gap_m).max(0.0)
}

fn headline(set: &GapSet<'_>) -> String {
    let pair = set.governing.between.join(message::and());
    let points = set.gaps.iter().flat_map(|gap| {
        let points = points(gap);
        points.map(move |(point, is_reversed)| (gap, point, is_reversed))
    });
    let most = points.max_by(|a, b| a.1.peak_force_n.total_cmp(&b.1.peak_force_n));
    let strongest = most.filter(|(_, point, _)| point.impact_count > 0);
    let strongest = strongest.map(|(gap, point, is_reversed)| {
        let sign = match (set.gaps.len(), is_reversed) {
            (1, true) => message::the_motion_reversed().to_owned(),
            (1, false) => String::new(),
            (_, true) => message::under_motion(message::motion_reversed(&gap.motion)),
            (_, false) => message::under_motion(&gap.motion),
        };
        message::the_greatest_force_kn_comes(kn(point.peak_force_n), mm(point.width_m), sign)
    });
    let strongest = strongest.unwrap_or_default();
    let gap = set.governing;
    let signs = gap.reversed_gap_m;
    let signs = signs.map_or("", |_| message::either_sign_of_the_motion());
    let signs = match gap.gap_at_bounds_m {
        Some(_) => format!("{signs}{}", message::over_bounds_of_bearings()),
        None => signs.to_owned(),
    };
    let needed = LENGTH.rounded_up(gap.needed_m());
    let narrow = match lacks(set) > 0.0 {
        true => message::gap_is_too_narrow(&pair, required_width(lacks(set))),
        false => String::new(),
    };
    let found = match set.gaps.len() {
        1 => message::under_with_cm_s_do(
            &gap.motion,
            GROUND_ACCELERATION.number(gap.pga_m_s2, 1),
            pair,
            needed,
            signs,
            strongest,
        ),
        records => {
            let motion = governing(set);
            message::under_any_record(records, pair, needed, signs, motion, strongest)
        }
    };
    narrow + &found
}

fn axis(name: &str, unit: &str) -> Axis {
    Axis {
        name: name.into(),
        unit: unit.into(),
    }
}

/// Lines of the curves of a set: one colour for each motion, dashed with the motion reversed.
fn lines(set: &GapSet<'_>, of: &dyn Fn(&crate::GapPoint) -> f64) -> Vec<Series> {
    let lines = set.gaps.iter().enumerate().flat_map(|(colour, gap)| {
        [(&gap.curve, false), (&gap.reversed_curve, true)].map(|(curve, is_reversed)| Series {
            name: match is_reversed {
                false => gap.motion.clone(),
                // Of several motions the remark says what dashes are.
                true if set.gaps.len() > 1 => String::new(),
                true => message::motion_reversed(&gap.motion),
            },
            points: curve
                .iter()
                .map(|p| [LENGTH.of(p.width_m), of(p)])
                .collect(),
            band: Vec::new(),
            stroke: match is_reversed {
                true => Stroke::Dashed,
                false => Stroke::Line,
            },
            colour,
        })
    });
    lines.filter(|line| !line.points.is_empty()).collect()
}

/// Dots of the rules that require less than the gap needed; those that require the same share one.
fn dots_of_rules(gap: &CriticalGap) -> Vec<Series> {
    let rules = rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m)).into_iter();
    let narrow = rules.filter(|(_, rule)| rule.gap_m <= gap.needed_m());
    let mut dots: Vec<(String, [f64; 2])> = Vec::new();
    for (name, rule) in narrow {
        let Some(worse) = rule.worse_outcome() else {
            continue;
        };
        let point = [LENGTH.of(rule.gap_m), FORCE.of(worse.peak_force_n)];
        match dots.iter_mut().find(|(_, known)| *known == point) {
            Some((names, _)) => *names = format!("{names}, {name}"),
            None => dots.push((name, point)),
        }
    }
    let dots = dots.into_iter().map(|(name, point)| Series {
        name,
        points: vec![point],
        band: Vec::new(),
        stroke: Stroke::Dots,
        colour: 1,
    });
    dots.collect()
}

/// Charts of one pair of neighbours, and the rules.
fn sections_of(set: &GapSet<'_>) -> Vec<Section> {
    let mark = |name: &str, metres: f64| Level {
        name: name.to_owned(),
        value: LENGTH.of(metres),
    };
    let marks = vec![
        mark(message::gap_of_the_model(), set.governing.model_gap_m),
        mark(message::gap_needed("").as_str(), set.governing.needed_m()),
    ];
    let chart = |y: Axis, series: Vec<Series>| Chart {
        title: y.name.clone(),
        x: axis(message::gap(), LENGTH.name()),
        y,
        series,
        marks: marks.clone(),
        ..Chart::default()
    };
    let unmet = set.gaps.iter().flat_map(|gap| points(gap));
    let unmet = unmet.filter(|(point, _)| point.met == Some(false)).count();
    let warning = match unmet {
        0 => String::new(),
        _ => message::did_not_meet_the_tolerance(counted(unmet, message::point())),
    };
    let mut forces = lines(set, &|p| FORCE.of(p.peak_force_n));
    let only = match set.gaps[..] {
        [gap] => Some(gap),
        _ => None,
    };
    forces.extend(only.into_iter().flat_map(dots_of_rules));
    let dots = only.map_or("", |_| message::dots_are_rules());
    let impacts = lines(set, &|p| p.impact_count as f64);
    let remark = match impacts.is_empty() {
        true => message::forces_with_gaps_of_rules().to_owned(),
        false => message::greatest_contact_force_and_number(dots, &warning),
    };
    let charts = [
        (message::greatest_contact_force(), FORCE.name(), forces),
        (message::impacts(), "", impacts),
    ];
    let charts = charts.into_iter().filter(|(.., series)| !series.is_empty());
    let charts: Vec<Chart> = charts
        .map(|(name, unit, series)| chart(axis(name, unit), series))
        .collect();
    let curves = (!charts.is_empty()).then(|| Section {
        title: set.governing.between.join(" ↔ "),
        remark,
        charts,
        ..Section::default()
    });
    let rules = match only {
        Some(gap) => rules_of(gap),
        None => rules_of_records(set),
    };
    curves.into_iter().chain(rules).collect()
}

/// A width over the gap needed: never 1.00 below 1, where the buildings touch.
fn ratio_in_words(ratio: f64) -> String {
    match ratio < 1.0 && ratio > 0.995 {
        true => format!("{:.4}", ratio.min(0.9999)),
        false => format!("{ratio:.2}"),
    }
}

/// Rules under one motion.
fn rules_of(gap: &CriticalGap) -> Option<Section> {
    let has_outcomes = gap.rules.iter().any(|rule| rule.worse_outcome().is_some());
    let mut heads: Vec<String> = [message::rule(), message::gap_mm(), message::smallest()]
        .map(str::to_owned)
        .to_vec();
    if has_outcomes {
        heads.extend([message::impacts(), message::greatest_force_kn()].map(str::to_owned));
    }
    heads.push(message::clause().to_owned());
    let rows = rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m));
    let rows = rows.into_iter().map(|(name, rule)| {
        let worse = rule.worse_outcome();
        let ratio = rule.ratio_of_both_signs.or(rule.ratio);
        let mut row = vec![
            name,
            LENGTH.rounded_up(rule.gap_m),
            ratio.map_or("–".into(), ratio_in_words),
        ];
        if has_outcomes {
            row.push(worse.map_or("–".into(), |own| own.impact_count.to_string()));
            row.push(worse.map_or("–".into(), |own| kn(own.peak_force_n)));
        }
        row.push(in_shown_units(&rule.source).into_owned());
        row
    });
    let needed = message::gap_needed_mm(LENGTH.rounded_up(gap.needed_m()));
    (!gap.rules.is_empty()).then(|| Section {
        title: message::rules_under(gap.between.join(" ↔ "), &gap.motion),
        remark: match has_outcomes {
            true if gap.gap_at_bounds_m.is_some() => {
                needed + message::outcomes_of_rules() + message::outcomes_of_nominal_bearings()
            }
            true => needed + message::outcomes_of_rules(),
            false => needed,
        },
        table: Some((heads, rows.collect())),
        ..Section::default()
    })
}

/// Rules under every motion of a set: one row each, with the width and its ratio to the gap needed.
fn rules_of_records(set: &GapSet<'_>) -> Option<Section> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (column, gap) in set.gaps.iter().enumerate() {
        for (name, rule) in rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m)) {
            let ratio = rule.ratio_of_both_signs.or(rule.ratio);
            let width = LENGTH.rounded_up(rule.gap_m);
            let cell = match ratio {
                Some(ratio) => format!("{width} ({})", ratio_in_words(ratio)),
                None => width,
            };
            let row = match rows.iter().position(|row| row[0] == name) {
                Some(row) => row,
                None => {
                    let mut row = vec!["–".to_owned(); set.gaps.len() + 1];
                    row[0] = name;
                    rows.push(row);
                    rows.len() - 1
                }
            };
            rows[row][column + 1] = cell;
        }
    }
    if rows.is_empty() {
        return None;
    }
    let motions = set.gaps.iter().map(|gap| gap.motion.clone());
    let needed = set.gaps.iter();
    let needed = needed.map(|gap| LENGTH.rounded_up(gap.needed_m()));
    let head = std::iter::once(message::rule().to_owned()).chain(motions);
    let first = std::iter::once(message::smallest_gap_without_pounding().to_owned()).chain(needed);
    rows.insert(0, first.collect());
    Some(Section {
        title: message::rules_and_records(set.governing.between.join(" ↔ ")),
        remark: message::rules_and_records_remark().into(),
        table: Some((head.collect(), rows)),
        ..Section::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_commas_are_quoted() {
        assert_eq!(quoted("J1"), "J1");
        assert_eq!(quoted("east, \"new\""), "\"east, \"\"new\"\"\"");
    }
}
