//! The required gap at every intensity, compared with the rules.

use std::sync::Arc;

use jostle::Summary;
use jostle::results::summary::FloorSummary;
use jostle::separation::{Code, Requirement};
use jostle_io::Input;
use jostle_io::shown::LENGTH;
use jostle_report::message;
use jostle_report::{Chart, Level, Section, Series, Stroke, rows_of_rules};
use jostle_run::CaseCache;

use super::Results;
use super::curves::spread;
use crate::study::{Study, at_rest};

/// Rules drawn over the intensity, by their names.
const DRAWN: [&str; 3] = ["ABS", "SRSS", "DDC"];
/// Greatest closing: that of a case without an impact is the gap needed under its motion.
const CLOSING: &str = "closing_peak_m";
/// Greatest closing of a gap in the run without contact: the gap needed, if the study has it.
const WITHOUT_CONTACT: &str = ".closing_without_contact_m";
/// Groups of cases that are drawn at most, one for each colour.
const MOST_GROUPS: usize = 7;
/// Intensities whose gap the head of the page names at most.
const SAID_LEVELS: usize = 2;
/// Least distance of horizontal lines with names of their own, as a share of the axis.
const LEAST_APART: f64 = 0.06;

/// Columns that [`Results::needed_gap`] reads: peaks of the floors beside the only gap.
pub(super) fn columns(study: &Study) -> Vec<String> {
    let Ok(input) = study.file.base.input() else {
        return Vec::new();
    };
    let [gap] = &input.model.gaps[..] else {
        return Vec::new();
    };
    let beside = input.model.buildings_beside(gap.between);
    let beside = beside.into_iter().flatten();
    let beside = beside.map(|building| &input.model.buildings[building].name);
    let all = beside.flat_map(|name| {
        let text = format!("{name}.");
        let names = study.layout.results.iter().map(|column| &column.name);
        names.filter(move |column| {
            column.strip_prefix(&text).is_some_and(|rest| {
                let place = rest.starts_with("floor") || rest.starts_with("isolation_");
                let ends = ["max_m", "min_m"].iter().any(|end| rest.ends_with(end));
                place && ends && rest.contains("displacement_")
            })
        })
    });
    all.cloned()
        .chain([CLOSING.to_owned()])
        .chain(without_contact(study))
        .collect()
}

/// The gap needed as a column of a study of one gap.
fn without_contact(study: &Study) -> Option<String> {
    let names = study.layout.results.iter().map(|column| &column.name);
    let mut found = names.filter(|name| name.ends_with(WITHOUT_CONTACT));
    found.next().filter(|_| found.next().is_none()).cloned()
}

impl Results<'_> {
    /// The smallest gap of the study without an impact at every intensity, and what rules make of the peaks of
    /// buildings that did not touch.
    pub(super) fn needed_gap(&mut self) -> Option<Section> {
        let (right, up) = self.plane()?;
        let is_width = |path: &String| path.ends_with(".width");
        let factor = &self.study.file.factors[right];
        // Multiples of widths are not widths.
        if factor.multiplies || !factor.paths.iter().any(is_width) {
            return None;
        }
        let (gaps, intensities) = (self.input(right), self.input(up));
        let (gap_axis, gap_size) = self.input_axis(right);
        let (axis, size) = self.input_axis(up);
        let impacts = self.table.column("impact_count").to_vec();
        let closings = self.table.column(CLOSING).to_vec();
        let free_closings = without_contact(self.study)
            .map(|name| self.table.column(&name).to_vec())
            .unwrap_or_default();
        let groups = self.grouped(&self.others(&[right, up]));
        let levels = self.numbers(up);
        let widest = self.numbers(right).last().copied().unwrap_or(0.0);
        let rules = Rules::new(self.study);
        // Contacts that are set back close further than the gap.
        let is_one_width = rules.as_ref().is_some_and(|rules| {
            let gaps = rules.at_rest.gaps.iter();
            let mut widths = gaps.flat_map(|gap| gap.contacts.iter().map(|own| own.width_m));
            let first = widths.next();
            widths.all(|width| first.is_some_and(|first| (width - first).abs() < 1e-9))
        });
        // Whether some widths are known between two of the study only.
        let mut bracketed = false;
        // Greatest gap needed at every intensity, infinite where the widest of the study is hit.
        let mut most = vec![0.0_f64; levels.len()];
        let mut series = Vec::new();
        for (colour, (name, cases)) in groups.iter().enumerate() {
            let (mut needed, mut between) = (Vec::new(), Vec::new());
            let mut of_rules: [Vec<[f64; 2]>; DRAWN.len()] = Default::default();
            for (level, most) in levels.iter().zip(&mut most) {
                let cases = || {
                    cases
                        .iter()
                        .filter(|case| intensities[**case] == Some(*level))
                };
                let hit = cases().filter(|case| impacts[**case].is_some_and(|count| count > 0.0));
                let hit = hit.filter_map(|case| gaps[*case]).fold(-1.0, f64::max);
                let free = cases()
                    .filter(|case| impacts[**case] == Some(0.0))
                    .filter_map(|case| gaps[*case])
                    .filter(|gap| *gap > hit)
                    .fold(f64::INFINITY, f64::min);
                // All records and draws alike: the same cases at every intensity.
                let apart = cases().filter(|case| gaps[**case] == Some(widest));
                let no_impact = apart.clone().all(|case| impacts[*case] == Some(0.0));
                // Without an impact the closing is that of free buildings, and so the gap itself. Several widths close differently.
                let closing = apart.clone().map(|case| closings.get(*case).copied()?);
                let closing = closing.collect::<Option<Vec<f64>>>();
                let closing = closing.filter(|all| no_impact && is_one_width && !all.is_empty());
                let without = cases().map(|case| free_closings.get(*case).copied()?);
                let without = without.collect::<Option<Vec<f64>>>();
                let closing = without.filter(|all| !all.is_empty()).or(closing);
                let exact = closing.map(|all| all.into_iter().fold(0.0, f64::max));
                let free = exact.unwrap_or(free);
                bracketed |= exact.is_none();
                *most = most.max(free);
                if free.is_finite() {
                    needed.push([size * level, gap_size * free]);
                    let below = exact.unwrap_or(hit.max(0.0));
                    between.push([gap_size * below, gap_size * free]);
                }
                if groups.len() > 1 {
                    continue;
                }
                if let Some(rules) = &rules
                    && no_impact
                {
                    let found = apart.filter_map(|case| self.required(*case, rules));
                    let greatest = found.reduce(|a, b| std::array::from_fn(|i| a[i].max(b[i])));
                    for (points, gap) in of_rules.iter_mut().zip(greatest.into_iter().flatten()) {
                        if gap.is_finite() {
                            points.push([size * level, gap_size * gap]);
                        }
                    }
                }
            }
            if colour >= MOST_GROUPS {
                continue;
            }
            series.push(Series {
                name: if name.is_empty() {
                    message::needed_gap().to_owned()
                } else {
                    format!("{}, {name}", message::needed_gap())
                },
                points: needed,
                band: between,
                stroke: Stroke::Dotted,
                colour,
            });
            for (rule, points) in DRAWN.into_iter().zip(of_rules) {
                if !points.is_empty() {
                    series.push(Series {
                        name: rule.to_owned(),
                        points,
                        band: Vec::new(),
                        stroke: Stroke::Dashed,
                        colour: series.len(),
                    });
                }
            }
        }
        let narrowest = self.numbers(right).first().copied().unwrap_or(0.0);
        let width = |gap: f64| {
            if gap <= narrowest && bracketed {
                message::at_most_width(LENGTH.rounded_up(gap))
            } else if gap.is_finite() {
                LENGTH.rounded_up(gap)
            } else {
                message::more_than(LENGTH.rounded_up(widest))
            }
        };
        let intensity = |level: f64| jostle_report::with_unit(size * level, &axis.unit);
        let strongest = levels.iter().zip(&most).next_back();
        self.needed = strongest.map(|(level, gap)| {
            let value = format!("{} {}", width(*gap), LENGTH.name());
            [value, message::at_at(intensity(*level))]
        });
        let named = spread(levels.len(), SAID_LEVELS);
        let join = |text: &dyn Fn(usize) -> String| {
            let all: Vec<String> = named.iter().map(|at| text(*at)).collect();
            all.join(message::to_a_range())
        };
        self.said.push(message::gap_needed_at(
            &axis.name,
            join(&|at| message::width_at_level(width(most[at]), intensity(levels[at]))),
            match groups.len() {
                1 => String::new(),
                count => message::the_greatest_of_combinations(count),
            },
        ));
        let of_rules = series
            .iter()
            .filter(|series| series.stroke == Stroke::Dashed);
        let in_unit = |name: &str| format!("{name} [{}]", LENGTH.name());
        let mut heads = vec![axis.name.clone(), in_unit(message::needed_gap())];
        heads.extend(of_rules.clone().map(|rule| in_unit(&rule.name)));
        let rows = levels.iter().zip(&most).map(|(level, gap)| {
            let x = size * level;
            let mut row = vec![intensity(*level), width(*gap)];
            row.extend(of_rules.clone().map(|rule| {
                let point = rule.points.iter().find(|point| point[0] == x);
                point.map_or("–".into(), |point| LENGTH.rounded_up(point[1] / gap_size))
            }));
            row
        });
        let rows = rows.collect();
        let codes = rules.map_or(Vec::new(), |rules| rules.of_gb50011());
        Some(Section {
            title: message::required_gap().into(),
            remark: message::needed_gap_and_rules().into(),
            table: Some((heads, rows)),
            charts: vec![Chart {
                title: message::smallest_gap_and_rules().into(),
                x: axis,
                y: gap_axis,
                series,
                levels: levels_of(&codes, gap_size, gap_size * widest),
                reach: gap_size * widest,
                ..Chart::default()
            }],
            ..Section::default()
        })
    }

    /// Gaps of the drawn rules for the peaks of a case; not a number where a rule does not apply \[m\].
    fn required(&self, case: usize, rules: &Rules) -> Option<[f64; DRAWN.len()]> {
        let mut summary = rules.at_rest.clone();
        for building in &mut summary.buildings {
            let value = |name: &str| {
                let name = format!("{}.{name}", building.name);
                self.table.column(&name).get(case).copied().flatten()
            };
            if let Some(mat) = &mut building.floors.mat {
                set_peaks(mat, "isolation_", &value)?;
            }
            for floor in &mut building.floors.above {
                let place = format!("floor{}.", floor.floor);
                set_peaks(floor, &place, &value)?;
            }
        }
        let required = rules.required(&summary);
        Some(DRAWN.map(|name| {
            let found = required.iter().find(|rule| rule.name == name);
            found.map_or(f64::NAN, |rule| rule.width)
        }))
    }
}

/// Sets the peaks of a floor that rules read, from the columns of a case that begin with `place`.
fn set_peaks(
    floor: &mut FloorSummary,
    place: &str,
    value: &dyn Fn(&str) -> Option<f64>,
) -> Option<()> {
    let peak = |name: &str| value(&format!("{place}{name}"));
    floor.without_contact = None;
    floor.without_contact_in_plan = None;
    floor.response.displacement_max_m = peak("displacement_max_m")?;
    floor.response.displacement_min_m = peak("displacement_min_m")?;
    if let Some(plan) = &mut floor.in_plan {
        plan.displacement_across_max_m = peak("displacement_across_max_m")?;
        plan.displacement_across_min_m = peak("displacement_across_min_m")?;
    }
    Some(())
}

/// What the rules of the only gap of the base model need beside the peaks of a case.
struct Rules {
    input: Arc<Input>,
    at_rest: Summary,
}

impl Rules {
    fn new(study: &Study) -> Option<Self> {
        let input = study.file.base.input().ok()?;
        if input.model.gaps.len() != 1 {
            return None;
        }
        let mut prepared = CaseCache::default().assemble(input).ok()?;
        let at_rest = at_rest(&mut prepared);
        Some(Self {
            input: prepared.input,
            at_rest,
        })
    }

    /// The same as `jostle gap` finds from a run.
    fn required(&self, summary: &Summary) -> Vec<Requirement> {
        let Input { model, codes, .. } = &*self.input;
        summary.required_gaps(model, 0, codes).rules
    }

    /// The widths of GB 50011, which follow from heights alone.
    fn of_gb50011(&self) -> Vec<Requirement> {
        let mut rules = self.required(&self.at_rest);
        rules.retain(|rule| rule.code == Some(Code::Gb50011));
        rules
    }
}

/// Horizontal lines of rules; those that nearly coincide are one, so that their names do not write over each other.
fn levels_of(rules: &[Requirement], size: f64, reach: f64) -> Vec<Level> {
    if let [first, .., last] = rules
        && last.width > first.width
        && rules.windows(2).any(|pair| {
            size * (pair[1].width - pair[0].width) < LEAST_APART * reach.max(size * last.width)
        })
    {
        return vec![Level {
            name: message::gb50011_of_intensities(
                LENGTH.rounded_up(first.width),
                LENGTH.rounded_up(last.width),
            ),
            value: size * first.width,
        }];
    }
    let rows = rows_of_rules(rules, |rule| (&rule.name, rule.width));
    let level = |(name, rule): (String, &Requirement)| Level {
        name,
        value: size * rule.width,
    };
    rows.into_iter().map(level).collect()
}
