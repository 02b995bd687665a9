//! Force over gap as a page and a table.

use jostle_report::{Axis, Chart, Section, Series, Stroke, StudyPage, render_study, rows_of_rules};

use std::path::Path;

use jostle_io::write_atomically;

use crate::critical_gap::CriticalGap;
use crate::error::RunError;
use crate::numbers::{counted, kn, mm};
use crate::replace::{FileKind, may_write};
use jostle_io::shown::{FORCE, GROUND_ACCELERATION, LENGTH};
use jostle_report::message;

/// Page of the curves.
const PAGE: &str = "gap_curve.html";
/// Their table.
const TABLE: &str = "gap_curve.csv";

/// First line of the table.
const HEAD: &str =
    "left,right,motion,pga_m_s2,width_m,impact_count,peak_force_n,first_impact_s,met,reversed\n";

/// The curves of all gaps and motions as a table: one row per width, cells without a value empty.
#[must_use]
pub fn gap_curve_csv(found: &[CriticalGap]) -> String {
    let mut text = HEAD.to_owned();
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
                point
                    .first_impact_s
                    .map_or(String::new(), |t| t.to_string()),
                point.met.map_or(String::new(), |met| met.to_string()),
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

/// Files of earlier curves in a folder, which new ones replace.
///
/// # Errors
/// [`RunError`] if a file that jostle did not write is in the way and `force` is not set.
pub fn earlier_gap_curves(folder: &Path, force: bool) -> Result<Vec<&'static str>, RunError> {
    let files = [
        (PAGE, FileKind::GAP_CURVE_PAGE),
        (TABLE, FileKind::GAP_CURVE),
    ];
    let mut earlier = Vec::new();
    for (name, kind) in files {
        if may_write(&folder.join(name), Some(kind), force)? {
            earlier.push(name);
        }
    }
    Ok(earlier)
}

/// Writes page and table of the curves into a folder that exists; each is whole or not there.
///
/// # Errors
/// [`RunError::Output`] with path and reason.
pub fn write_gap_curves(folder: &Path, title: &str, found: &[CriticalGap]) -> Result<(), RunError> {
    write_atomically(&folder.join(TABLE), gap_curve_csv(found).as_bytes())?;
    write_atomically(&folder.join(PAGE), gap_curve_page(title, found).as_bytes())?;
    Ok(())
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        return format!("\"{}\"", text.replace('"', "\"\""));
    }
    text.to_owned()
}

/// The page of the curves; it loads nothing from outside.
#[must_use]
pub fn gap_curve_page(title: &str, found: &[CriticalGap]) -> String {
    let mut pairs: Vec<&[String; 2]> = Vec::new();
    for gap in found {
        if !pairs.contains(&&gap.between) {
            pairs.push(&gap.between);
        }
    }
    let sections = pairs.into_iter().flat_map(|pair| {
        let of_pair: Vec<&CriticalGap> = found.iter().filter(|gap| gap.between == *pair).collect();
        sections_of(pair, &of_pair)
    });
    render_study(&StudyPage {
        kind: message::force_over_gap().into(),
        title: title.into(),
        headline: headlines(found),
        sections: sections.collect(),
        files: vec![(TABLE.into(), message::one_row_per_width().into())],
        ..StudyPage::default()
    })
}

fn headlines(found: &[CriticalGap]) -> Vec<String> {
    let mut all: Vec<String> = found.iter().map(headline).collect();
    let several = found.iter().any(|gap| gap.motion != found[0].motion);
    if !several && !found.is_empty() {
        all.push(message::one_record_is_no_design_value().into());
    }
    all
}

fn headline(gap: &CriticalGap) -> String {
    let pair = gap.between.join(message::and());
    let most = points(gap).max_by(|a, b| a.0.peak_force_n.total_cmp(&b.0.peak_force_n));
    let strongest = most.filter(|(point, _)| point.impact_count > 0);
    let strongest = strongest.map(|(point, is_reversed)| {
        message::the_greatest_force_kn_comes(
            kn(point.peak_force_n),
            mm(point.width_m),
            with_sign(is_reversed),
        )
    });
    let signs = gap.reversed_gap_m;
    let signs = signs.map_or("", |_| message::either_sign_of_the_motion());
    message::under_with_cm_s_do(
        &gap.motion,
        GROUND_ACCELERATION.number(gap.pga_m_s2, 1),
        &pair,
        LENGTH.rounded_up(gap.of_both_signs_m()),
        signs,
        strongest.unwrap_or_default(),
    )
}

/// Words for the sign of a motion.
fn with_sign(is_reversed: bool) -> &'static str {
    match is_reversed {
        true => message::the_motion_reversed(),
        false => "",
    }
}

fn axis(name: &str, unit: &str) -> Axis {
    Axis {
        name: name.into(),
        unit: unit.into(),
    }
}

/// Charts of one pair of neighbours, one line for each motion, and its rules.
fn sections_of(pair: &[String; 2], gaps: &[&CriticalGap]) -> Vec<Section> {
    let chart = |y: Axis, of: &dyn Fn(&crate::GapPoint) -> f64, dots: bool| {
        let lines = gaps.iter().enumerate().flat_map(|(colour, gap)| {
            [(&gap.curve, false), (&gap.reversed_curve, true)].map(|(curve, is_reversed)| Series {
                name: match is_reversed {
                    true => message::motion_reversed(&gap.motion),
                    false => gap.motion.clone(),
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
        let mut series: Vec<Series> = lines.filter(|line| !line.points.is_empty()).collect();
        if dots {
            for (index, gap) in gaps.iter().enumerate() {
                let rules = rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m));
                let narrow = rules.into_iter();
                let narrow = narrow.filter(|(_, rule)| rule.gap_m <= gap.of_both_signs_m());
                // Rules that require the same share a dot.
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
                series.extend(dots.into_iter().map(|(name, point)| Series {
                    name,
                    points: vec![point],
                    band: Vec::new(),
                    stroke: Stroke::Dots,
                    colour: gaps.len() + index,
                }));
            }
        }
        Chart {
            title: y.name.clone(),
            x: axis(message::gap(), LENGTH.name()),
            y,
            series,
            levels: Vec::new(),
            reach: 0.0,
            ordered: false,
        }
    };
    let unmet: usize = gaps
        .iter()
        .flat_map(|gap| points(gap))
        .filter(|(point, _)| point.met == Some(false))
        .count();
    let warning = if unmet > 0 {
        message::did_not_meet_the_tolerance(counted(unmet, message::point()))
    } else {
        String::new()
    };
    let mut sections = vec![Section {
        title: pair.join(" ↔ "),
        remark: message::greatest_contact_force_and_number(&warning),
        charts: vec![
            chart(
                axis(message::greatest_contact_force(), FORCE.name()),
                &|p| FORCE.of(p.peak_force_n),
                true,
            ),
            chart(
                axis(message::impacts(), ""),
                &|p| p.impact_count as f64,
                false,
            ),
        ],
        ..Section::default()
    }];
    for gap in gaps.iter().filter(|gap| !gap.rules.is_empty()) {
        let heads = [
            message::rule(),
            message::gap_mm(),
            message::smallest(),
            message::impacts(),
            message::greatest_force_kn(),
        ];
        let rows = rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m));
        let rows = rows.into_iter().map(|(name, rule)| {
            let worse = rule.worse_outcome();
            let ratio = rule.ratio_of_both_signs.or(rule.ratio);
            vec![
                name,
                LENGTH.rounded_up(rule.gap_m),
                ratio.map_or("–".into(), |ratio| format!("{ratio:.2}")),
                worse.map_or("–".into(), |own| own.impact_count.to_string()),
                worse.map_or("–".into(), |own| kn(own.peak_force_n)),
            ]
        });
        sections.push(Section {
            title: message::rules_under(&gap.motion),
            remark: message::smallest_gap_without_pounding_mm(
                LENGTH.rounded_up(gap.of_both_signs_m()),
            ),
            table: Some((heads.map(Into::into).to_vec(), rows.collect())),
            ..Section::default()
        });
    }
    sections
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
