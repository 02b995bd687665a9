//! Which factors matter: Sobol indices, elementary effects, tornado.

use jostle::linear::sort_by;
use jostle_io::{DesignKind, FactorValues, Values};
use jostle_report::message;
use jostle_report::{Axis, Bar, Bars, Section};

use super::{Results, words};
use crate::key_words::key_in_words;
use crate::layout::Kind;
use crate::statistics::{elementary_effects, given_data, sobol_indices};
use crate::study::{Study, StudyError};

/// Whether cases are drawn, all factors together, or are rows of a table.
pub(super) fn is_sampled(study: &Study) -> bool {
    let rows = |factor: &jostle_io::Factor| matches!(factor.values, FactorValues::Table(_));
    study.file.factors.iter().any(rows)
        || matches!(
            study.file.design.kind,
            DesignKind::LatinHypercube | DesignKind::Sobol | DesignKind::Random
        )
}

/// Columns whose sensitivity is shown, where the design shows any.
pub(super) fn responses(study: &Study) -> Vec<String> {
    let sensitive = matches!(
        study.file.design.kind,
        DesignKind::Saltelli | DesignKind::Morris | DesignKind::OneAtATime
    );
    if !sensitive && !is_sampled(study) {
        return Vec::new();
    }
    if !study.file.responses.is_empty() {
        return study.file.responses.clone();
    }
    let names = study.layout.names();
    // The gap needed, not the closing: with contact that is the gap plus the indentation.
    let needed = names
        .iter()
        .filter(|name| name.ends_with(".closing_without_contact_m"));
    ["peak_force_n", "impact_count"]
        .into_iter()
        .filter(|name| names.contains(name))
        .chain(needed.map(|name| &name[..]))
        .map(str::to_owned)
        .collect()
}

/// One row of the table of sensitivities.
struct Line {
    response: String,
    factor: String,
    numbers: [f64; 2],
    limits: Option<[[f64; 2]; 2]>,
}

impl Results<'_> {
    pub(super) fn rankings(&mut self, responses: &[String]) -> Result<Option<Section>, StudyError> {
        if responses.is_empty() {
            return Ok(None);
        }
        let file = &self.study.file;
        let (k, seed) = (file.factors.len(), file.design.seed);
        let kind = file.design.kind;
        let sampled = is_sampled(self.study);
        let legend = match kind {
            DesignKind::Saltelli => ["first_order", "total"],
            DesignKind::Morris => ["mean_absolute_effect", "deviation"],
            _ if sampled => ["first_order", "rank_correlation"],
            _ => ["low", "high"],
        };
        let mut lines: Vec<Line> = Vec::new();
        let mut bars: Vec<Bars> = Vec::new();
        let mut silent: Vec<String> = Vec::new();
        let mut most: Vec<String> = Vec::new();
        for response in responses {
            let values = self.table.column(response).to_vec();
            let (axis, size) = words::axis(response);
            let mut centre = 0.0;
            let mut response_lines: Vec<Line> = Vec::new();
            let mut push = |factor: usize, numbers: [f64; 2], limits: Option<[[f64; 2]; 2]>| {
                response_lines.push(Line {
                    response: response.clone(),
                    factor: file.factors[factor].name.clone(),
                    numbers,
                    limits,
                });
            };
            match kind {
                DesignKind::Saltelli => {
                    for (factor, index) in sobol_indices(&values, k, seed)
                        .unwrap_or_default()
                        .iter()
                        .enumerate()
                    {
                        push(
                            factor,
                            [index.first, index.total],
                            Some([index.first_limits, index.total_limits]),
                        );
                    }
                }
                DesignKind::Morris => {
                    let effects = elementary_effects(&values, k, seed);
                    for (factor, effect) in effects.iter().enumerate() {
                        if effect.count > 0 {
                            push(factor, [effect.mean_absolute, effect.deviation], None);
                        }
                    }
                }
                _ if sampled => {
                    for factor in 0..k {
                        let ordered = self.study.layout.inputs[factor].kind != Kind::Text;
                        let found = given_data(&self.input(factor), &values, ordered);
                        if let Some(found) = found {
                            push(factor, [found.first_order, found.rank_correlation], None);
                        }
                    }
                }
                _ => {
                    centre = values.first().copied().flatten().unwrap_or(0.0);
                    for factor in 0..k {
                        let at = |side: usize| values.get(1 + 2 * factor + side).copied().flatten();
                        if let (Some(low), Some(high)) = (at(0), at(1)) {
                            push(factor, [low, high], None);
                        }
                    }
                }
            }
            if response_lines.is_empty() {
                silent.push(response.clone());
                continue;
            }
            let weight = |line: &Line| match kind {
                // What both bars cover: they may be on one side.
                DesignKind::OneAtATime => {
                    let ends = line.numbers.map(|end| end - centre);
                    ends[0].max(ends[1]).max(0.0) - ends[0].min(ends[1]).min(0.0)
                }
                DesignKind::Saltelli => line.numbers[1],
                _ if sampled => line.numbers[0],
                _ => line.numbers[0],
            };
            sort_by(&mut response_lines, |a, b| weight(b).total_cmp(&weight(a)));
            let name = |line: &Line| key_in_words(&line.factor);
            // Total shares whose limits overlap have no order.
            let told_apart = |a: &Line, b: &Line| match (a.limits, b.limits) {
                (Some([_, a]), Some([_, b])) => a[0] > b[1],
                _ => true,
            };
            let first = match &response_lines[..] {
                [first, second, ..] if told_apart(first, second) => {
                    [name(first), name(second)].join(message::then_of())
                }
                [first, second, ..] => {
                    message::not_told_apart(name(first), name(second), self.study.design.cases)
                }
                all => all.iter().map(name).collect(),
            };
            most.push(message::matters_for(&axis.name, first));
            let shares = sampled || kind == DesignKind::Saltelli;
            let size = if shares { 1.0 } else { size };
            bars.push(Bars {
                title: axis.name.clone(),
                value: if shares {
                    Axis {
                        name: message::share_of_the_variance().into(),
                        unit: String::new(),
                    }
                } else {
                    axis
                },
                centre: size * centre,
                bars: response_lines
                    .iter()
                    .map(|line| Bar {
                        name: key_in_words(&line.factor),
                        ends: line.numbers.map(|value| size * value),
                        limits: line.limits,
                    })
                    .collect(),
                legend: legend.map(|name| name.replace('_', " ")),
            });
            lines.extend(response_lines);
        }
        if !most.is_empty() {
            self.said.push(message::matters_most(most.join("; ")));
        }
        let limit = |which: usize, end: usize| {
            let all = lines.iter().map(|line| Some(line.limits?[which][end]));
            Values::Instant(all.collect())
        };
        let columns = vec![
            (
                "response".into(),
                Values::Text(lines.iter().map(|line| line.response.clone()).collect()),
            ),
            (
                "factor".into(),
                Values::Text(lines.iter().map(|line| line.factor.clone()).collect()),
            ),
            (
                legend[0].to_owned(),
                Values::Real(lines.iter().map(|line| line.numbers[0]).collect()),
            ),
            (format!("{}_lower", legend[0]), limit(0, 0)),
            (format!("{}_upper", legend[0]), limit(0, 1)),
            (
                legend[1].to_owned(),
                Values::Real(lines.iter().map(|line| line.numbers[1]).collect()),
            ),
            (format!("{}_lower", legend[1]), limit(1, 0)),
            (format!("{}_upper", legend[1]), limit(1, 1)),
        ];
        self.write("sensitivity", message::how_much_factors_matter(), columns)?;
        let mut remark = match kind {
            DesignKind::Saltelli => message::sobol_indices_remark().to_owned(),
            DesignKind::Morris => message::morris_remark().to_owned(),
            _ if sampled => message::given_data_remark().to_owned(),
            _ => {
                let [low, high] = file
                    .design
                    .quantiles
                    .map(|share| format!("{:.0}", 100.0 * share));
                message::tornado_remark(low, high)
            }
        };
        if !silent.is_empty() {
            remark += &message::nothing_to_rank_in(silent.join(", "));
        }
        Ok(Some(Section {
            title: message::sensitivity_of_results().into(),
            remark,
            bars,
            ..Section::default()
        }))
    }
}
