//! The page of a search: the best trial, what it costs to keep more or less, how the search went.

use jostle::linear::sort_by;
use jostle_report::{Axis, Chart, Level, Section, Series, Stroke, StudyPage, render_study};
use jostle_report::{message, typeset};

use super::text::{in_words, number, power_suffix, rounded, rounded_up, shown};
use super::{SizeResults, Trial};
use crate::row::Status;

/// Trials in the table of the best.
const BEST: usize = 20;

fn axis(name: &str, suffix: &str) -> Axis {
    Axis {
        name: in_words(name),
        unit: shown(suffix).0,
    }
}

fn series(name: &str, points: Vec<[f64; 2]>, stroke: Stroke, colour: usize) -> Series {
    Series {
        name: name.into(),
        points,
        band: Vec::new(),
        stroke,
        colour,
    }
}

/// Greatest over least value above zero beyond which an axis is logarithmic \[–\].
const WIDE: f64 = 100.0;

/// Whether points spread over so many decades upwards that a straight axis hides the small ones.
fn is_wide(series: &[Series]) -> bool {
    let values = series.iter().flat_map(|series| &series.points);
    let values = values.map(|point| point[1]).filter(|value| *value > 0.0);
    let most = values.clone().fold(0.0, f64::max);
    most > WIDE * values.fold(f64::INFINITY, f64::min)
}

impl SizeResults {
    /// The page; it loads nothing from outside.
    #[must_use]
    pub fn page(&self) -> String {
        let mut facts = vec![
            (
                message::minimised().to_owned(),
                in_words(&self.objective.text),
            ),
            (
                message::trials_word().into(),
                message::trials_and_seed(self.trials.len(), self.seed),
            ),
        ];
        for condition in &self.conditions {
            let words = typeset(&in_words(&condition.text));
            facts.insert(1, (message::kept_word().into(), words));
        }
        for ((name, _), [low, high]) in self.inputs.iter().zip(&self.bounds) {
            let range = message::low_to_high(typeset(low), typeset(high));
            facts.push((message::bounds_of(in_words(name)), range));
        }
        let [records, peak] = &self.shaken;
        let records = match self.motions.len() {
            1 => records.clone(),
            several => message::records_and_rule(several, self.over, records),
        };
        facts.push((message::records_fact().into(), records));
        if !peak.is_empty() {
            let peak = typeset(peak);
            facts.push((message::peak_ground_acceleration_axis().into(), peak));
        }
        let mut sections = Vec::new();
        for index in 0..self.conditions.len() {
            sections.push(self.trade_off_section(index));
        }
        sections.push(self.course());
        sections.push(self.over_inputs());
        sections.push(self.table());
        render_study(&StudyPage {
            kind: message::kind_of_sizing().into(),
            title: self.title.clone(),
            headline: self.headline(),
            answers: self.answers(),
            facts,
            sections: sections
                .into_iter()
                .filter(|s| !s.charts.is_empty() || s.table.is_some())
                .collect(),
            files: vec![
                (
                    "size.json".into(),
                    message::best_trial_and_trade_offs().into(),
                ),
                ("trials.parquet".into(), message::one_row_per_trial().into()),
                (
                    "trials.journal".into(),
                    message::finished_trials_to_go_on_from().into(),
                ),
            ],
            ..StudyPage::default()
        })
    }

    /// The tile of the best trial.
    fn answers(&self) -> Vec<[String; 3]> {
        let best = self.best().or_else(|| self.nearest());
        let best = best.and_then(|best| Some((best, best.objective?)));
        let tile = best.map(|(best, objective)| {
            let inputs = self.other_inputs();
            let mut note: Vec<String> = inputs
                .map(|(index, (name, _))| {
                    let value = typeset(&rounded(&best.inputs[index].1));
                    format!("{} {value}", in_words(name))
                })
                .collect();
            let lefts = self.conditions.iter().zip(&best.kept);
            note.extend(lefts.filter_map(|(condition, left)| {
                let left = number((*left)?, &condition.left.suffix);
                Some(format!("{} {left}", in_words(&condition.left.text)))
            }));
            let objective_name = in_words(&self.objective.text);
            [
                match (self.best(), self.converged) {
                    (None, _) => message::nearest_trial(objective_name),
                    (_, true) => message::smallest_of(objective_name),
                    (_, false) => message::smallest_so_far(objective_name),
                },
                rounded_up(objective, &self.objective.suffix),
                note.join("; "),
            ]
        });
        tile.into_iter().collect()
    }

    /// Objective of completed trials over something, those that keep all conditions apart.
    fn dots(&self, x: impl Fn(&Trial) -> Option<f64>, colour: [usize; 2]) -> Vec<Series> {
        let size = shown(&self.objective.suffix).1;
        let points = |keeps: bool| -> Vec<[f64; 2]> {
            let trials = self.trials.iter();
            let fitting = trials.filter(|t| t.status == Status::Completed && t.keeps() == keeps);
            fitting
                .filter_map(|t| Some([x(t)?, size * t.objective?]))
                .collect()
        };
        let both = [
            (message::misses_a_condition(), false, colour[1]),
            (message::keeps_all(), true, colour[0]),
        ];
        both.into_iter()
            .map(|(name, keeps, colour)| series(name, points(keeps), Stroke::Dots, colour))
            .filter(|series| !series.points.is_empty())
            .collect()
    }

    fn trade_off_section(&self, index: usize) -> Section {
        let condition = &self.conditions[index];
        let (size, left_size) = (
            shown(&self.objective.suffix).1,
            shown(&condition.left.suffix).1,
        );
        let front = self.trade_off(index);
        let front = front
            .iter()
            .map(|[left, objective]| [left_size * left, size * objective]);
        let mut all = self.dots(|trial| Some(left_size * trial.kept[index]?), [0, 6]);
        all.push(series(
            message::least_of_front(),
            front.collect(),
            Stroke::Dotted,
            1,
        ));
        Section {
            title: message::trade_off_against(
                in_words(&self.objective.text),
                in_words(&condition.left.text),
            ),
            remark: message::line_joins_unbeaten_trials(in_words(&condition.text)),
            charts: vec![Chart {
                title: String::new(),
                x: axis(&condition.left.text, &condition.left.suffix),
                y: axis(&self.objective.text, &self.objective.suffix),
                logarithmic: is_wide(&all),
                series: all,
                ..Chart::default()
            }],
            ..Section::default()
        }
    }

    /// The least objective after every trial.
    fn course(&self) -> Section {
        let size = shown(&self.objective.suffix).1;
        let mut best: Option<f64> = None;
        let mut points = Vec::new();
        for (index, trial) in self.trials.iter().enumerate() {
            if let (true, Some(objective)) = (trial.keeps(), trial.objective)
                && best.is_none_or(|best| objective < best)
            {
                best = Some(objective);
            }
            if let Some(best) = best {
                points.push([index as f64, size * best]);
            }
        }
        let levels = best.map(|best| Level {
            name: rounded_up(best, &self.objective.suffix),
            value: size * best,
        });
        Section {
            title: message::course_of_the_search().into(),
            remark: message::least_objective_so_far().into(),
            charts: if points.len() < 2 {
                Vec::new()
            } else {
                vec![Chart {
                    title: String::new(),
                    x: axis(message::trial_axis(), ""),
                    y: axis(&self.objective.text, &self.objective.suffix),
                    series: vec![series("", points, Stroke::Line, 0)],
                    levels: levels.into_iter().collect(),
                    ..Chart::default()
                }]
            },
            ..Section::default()
        }
    }

    /// Numbers and names of varied keys, with their columns, without that which is the objective itself.
    fn other_inputs(&self) -> impl Iterator<Item = (usize, &(String, String))> {
        let all = self.inputs.iter().enumerate();
        all.filter(|(_, (name, _))| *name != self.objective.text)
    }

    /// The objective over every other varied key.
    fn over_inputs(&self) -> Section {
        let charts = self.other_inputs().map(|(index, (name, column))| {
            let suffix = ["_n_s_m", "_m_s2", "_n_m", "_m_s", "_m", "_n", "_s", "_kg"];
            let suffix = suffix.into_iter().find(|suffix| column.ends_with(suffix));
            let power = power_suffix(&self.bounds[index][0]);
            let suffix = power.as_deref().or(suffix).unwrap_or_default();
            let size = shown(suffix).1;
            let dots = self.dots(|trial| Some(size * trial.inputs[index].0?), [0, 6]);
            Chart {
                title: String::new(),
                x: axis(name, suffix),
                y: axis(&self.objective.text, &self.objective.suffix),
                logarithmic: is_wide(&dots),
                series: dots,
                ..Chart::default()
            }
        });
        Section {
            title: message::objective_over_varied_keys().into(),
            remark: String::new(),
            charts: charts.collect(),
            ..Section::default()
        }
    }

    fn table(&self) -> Section {
        let mut best: Vec<&Trial> = self.trials.iter().filter(|trial| trial.keeps()).collect();
        let none_keeps = best.is_empty();
        if none_keeps {
            best = self
                .trials
                .iter()
                .filter(|trial| trial.objective.is_some())
                .collect();
        }
        // What is missed is zero of those that keep all.
        sort_by(&mut best, |a, b| {
            let value = |trial: &Trial| trial.objective.unwrap_or(f64::INFINITY);
            let missed = a.missed.total_cmp(&b.missed);
            missed.then(value(a).total_cmp(&value(b)))
        });
        let names = self.other_inputs().map(|(_, (name, _))| in_words(name));
        let mut heads: Vec<String> = names.collect();
        heads.push(in_words(&self.objective.text));
        heads.extend(self.conditions.iter().map(|c| in_words(&c.left.text)));
        let rows = best.into_iter().take(BEST).map(|trial| {
            let inputs = self.other_inputs();
            let mut row: Vec<String> = inputs
                .map(|(index, _)| rounded(&trial.inputs[index].1))
                .collect();
            row.push(rounded_up(
                trial.objective.unwrap_or(f64::NAN),
                &self.objective.suffix,
            ));
            let lefts = self.conditions.iter().zip(&trial.kept);
            row.extend(lefts.map(|(condition, left)| {
                left.map_or_else(|| "–".into(), |left| number(left, &condition.left.suffix))
            }));
            row
        });
        let rows: Vec<Vec<String>> = rows.collect();
        Section {
            title: match none_keeps {
                true => message::nearest_trials().into(),
                false => message::best_trials().into(),
            },
            table: (!rows.is_empty()).then_some((heads, rows)),
            ..Section::default()
        }
    }
}
