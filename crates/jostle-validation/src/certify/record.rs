//! Certified runs as a file, and the page and the figure made from such files.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::{Deserialize, Serialize};

use super::Certified;

/// One call of `--certify`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Record {
    /// Seed of the models.
    pub seed: u64,
    /// Number of models drawn.
    pub models: usize,
    /// Runs with a reference.
    pub runs: Vec<RunRecord>,
    /// Models without a reference and runs that failed, with reasons.
    pub failures: Vec<String>,
}

/// One run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RunRecord {
    /// Number of the model.
    pub model: u64,
    /// Kind of the model.
    pub kind: String,
    /// Contact laws of the model.
    pub laws: String,
    /// Solver.
    pub solver: String,
    /// Tolerance.
    pub tolerance: f64,
    /// Whether the run warned that its peaks may be off.
    pub warned: bool,
    /// Whether it warned, or called itself sensitive, although all its numbers are within the tolerance.
    #[serde(default)]
    pub false_alarm: bool,
    /// Where the motion was cut, as the run was sensitive from there \[s\].
    pub cut_s: Option<f64>,
    /// Promised numbers.
    pub numbers: Vec<NumberRecord>,
}

/// One promised number.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct NumberRecord {
    /// Its kind.
    pub kind: String,
    /// Which one.
    pub name: String,
    /// Error over the tolerance; `None` where the reference is uncertain.
    pub ratio: Option<f64>,
}

impl Record {
    /// Collects the runs of a study.
    #[must_use]
    pub fn new(seed: u64, all: &[Certified]) -> Self {
        let mut record = Self {
            seed,
            models: all.len(),
            runs: Vec::new(),
            failures: Vec::new(),
        };
        for model in all {
            if let Some(why) = &model.failed {
                let why = why.lines().next().unwrap_or_default();
                let failure = format!("{} {}: no reference: {why}", model.kind, model.number);
                record.failures.push(failure);
            }
            for run in &model.runs {
                if let Some(why) = &run.failed {
                    record.failures.push(format!(
                        "model {} {} at {:.0e}: {why}",
                        model.number, run.solver, run.tolerance
                    ));
                    continue;
                }
                let numbers = run.truth.quantities.iter().zip(&run.errors);
                let numbers = numbers.map(|(quantity, error)| NumberRecord {
                    kind: quantity.kind.to_owned(),
                    name: quantity.name.clone(),
                    // JSON has no infinity.
                    ratio: error.map(|error| (error / run.tolerance).min(f64::MAX)),
                });
                record.runs.push(RunRecord {
                    model: model.number,
                    kind: model.kind.to_owned(),
                    laws: model.laws.clone(),
                    solver: run.solver.to_owned(),
                    tolerance: run.tolerance,
                    warned: run.warned,
                    false_alarm: run.false_alarm.is_some(),
                    cut_s: run.cut,
                    numbers: numbers.collect(),
                });
            }
        }
        record
    }
}

/// Numbers beyond three tolerances in runs that did not warn, the worst first.
fn silent_misses(records: &[Record]) -> Vec<(&Record, &RunRecord, &NumberRecord, f64)> {
    let mut misses = Vec::new();
    for record in records {
        for run in record.runs.iter().filter(|run| !run.warned) {
            let far = run.numbers.iter().filter_map(|number| {
                let ratio = number.ratio.filter(|ratio| *ratio > 3.0)?;
                Some((record, run, number, ratio))
            });
            misses.extend(far);
        }
    }
    misses.sort_by(|a, b| b.3.total_cmp(&a.3));
    misses
}

/// Silent misses, and the share of numbers that are within the tolerance or warned of.
#[must_use]
pub fn closing_text(records: &[Record]) -> String {
    let mut text = String::new();
    let misses = silent_misses(records);
    let _ = writeln!(
        text,
        "{} numbers beyond 3 tolerances in runs that did not warn:",
        misses.len()
    );
    for (record, run, number, ratio) in &misses {
        let _ = writeln!(
            text,
            "{}, seed {} model {} {} at {:.0e}: {} {}, {ratio:.2} times",
            run.kind, record.seed, run.model, run.solver, run.tolerance, number.kind, number.name
        );
    }
    let (mut all, mut held, mut cut) = (0_usize, 0_usize, 0_usize);
    for run in records.iter().flat_map(|record| &record.runs) {
        cut += usize::from(run.cut_s.is_some());
        for ratio in run.numbers.iter().filter_map(|number| number.ratio) {
            all += 1;
            held += usize::from(run.warned || ratio <= 1.0);
        }
    }
    let _ = writeln!(
        text,
        "{:.3} % of {all} numbers are within 1 tolerance, or their run warned; {cut} runs were cut before a sensitive instant.",
        100.0 * held as f64 / all.max(1) as f64
    );
    text
}

/// Shares of one row of a table.
#[derive(Default)]
pub(super) struct Shares {
    pub(super) all: usize,
    pub(super) within: usize,
    pub(super) within_thrice: usize,
    pub(super) warned: usize,
    pub(super) silent: usize,
    pub(super) uncertain: usize,
    pub(super) worst: f64,
}

impl Shares {
    pub(super) fn add(&mut self, run: &RunRecord, ratio: Option<f64>) {
        let Some(ratio) = ratio else {
            self.uncertain += 1;
            return;
        };
        self.all += 1;
        self.within += usize::from(ratio <= 1.0);
        self.within_thrice += usize::from(ratio <= 3.0);
        self.warned += usize::from(ratio > 1.0 && run.warned);
        self.silent += usize::from(ratio > 3.0 && !run.warned);
        self.worst = self.worst.max(ratio);
    }
}

pub(super) fn table(
    text: &mut String,
    heading: &str,
    records: &[Record],
    key: fn(&RunRecord, &str) -> String,
) {
    let mut rows: BTreeMap<String, Shares> = BTreeMap::new();
    for run in records.iter().flat_map(|record| &record.runs) {
        for number in &run.numbers {
            let row = rows.entry(key(run, &number.kind)).or_default();
            row.add(run, number.ratio);
        }
    }
    let _ = writeln!(
        text,
        "| {heading} | numbers | within 1× | within 3× | beyond 1×, warned | beyond 3×, not warned | reference uncertain | worst |\n\
         |---|---|---|---|---|---|---|---|"
    );
    for (name, shares) in &rows {
        let share = |part: usize| 100.0 * part as f64 / shares.all.max(1) as f64;
        let _ = writeln!(
            text,
            "| {name} | {} | {:.2} % | {:.2} % | {} | {} | {} | {:.3}× |",
            shares.all,
            share(shares.within),
            share(shares.within_thrice),
            shares.warned,
            shares.silent,
            shares.uncertain,
            shares.worst
        );
    }
    text.push('\n');
}

/// Marks between which a page holds what is written here.
const MARKS: Marks = [
    "<!-- Written by `jostle-validation --certify-report`; do not edit up to the end mark. -->\n",
    "<!-- End of what `jostle-validation --certify-report` writes. -->\n",
];

/// The first and the last line of a part of a page.
pub(super) type Marks = [&'static str; 2];

/// A page up to the first mark, and from the last mark on.
pub(super) fn around<'a>(old: &'a str, marks: &Marks) -> Result<[&'a str; 2], String> {
    let places = marks.map(|mark| old.find(mark));
    let [Some(begin), Some(end)] = places else {
        return Err(format!("the page lacks the marks {marks:?}"));
    };
    let from = begin + marks[0].len();
    if end < from {
        return Err("the end mark of the page comes before its beginning".to_owned());
    }
    Ok([&old[..from], &old[end..]])
}

/// A page with the tables and the figure of records between its marks.
///
/// # Errors
/// The page lacks the marks.
pub fn page(old: &str, records: &[Record]) -> Result<String, String> {
    let [before, after] = around(old, &MARKS)?;
    let mut text = before.to_owned();
    let _ = writeln!(
        text,
        "\n{}. Errors are given as multiples of the tolerance.\n\n\
         ![Share of peaks whose error exceeds a multiple of the tolerance](figures/certify.svg)\n",
        drawn(records)
    );
    table(&mut text, "solver and tolerance", records, |run, _| {
        format!("{} at {:.0e}", run.solver, run.tolerance)
    });
    table(&mut text, "quantity", records, |run, kind| {
        format!("{kind}, {}", run.solver)
    });
    table(&mut text, "kind of model", records, |run, _| {
        format!("{}, {}", run.kind, run.solver)
    });
    table(&mut text, "law", records, |run, _| run.laws.clone());
    close(&mut text, records);
    text.push_str(after);
    Ok(text)
}

/// Silent misses and failures.
pub(super) fn close(text: &mut String, records: &[Record]) {
    let _ = writeln!(text, "```text\n{}", closing_text(records));
    for failure in records.iter().flat_map(|record| &record.failures) {
        let _ = writeln!(text, "{failure}");
    }
    text.push_str("```\n\n");
}

/// Decades of error over tolerance, and of the share beyond, that the figure shows.
const RATIOS: [i32; 2] = [-4, 3];
const SHARES: [i32; 2] = [-4, 0];
/// Left, top, width and height of the plot.
const AREA: [f64; 4] = [70.0, 30.0, 600.0, 320.0];
/// Dashes of the lines, from the coarsest tolerance to the finest.
const DASHES: [&str; 3] = ["2 3", "", "8 3"];

/// Share of numbers beyond a multiple of the tolerance [–] against that multiple [–], for every solver and tolerance.
#[must_use]
pub fn figure(records: &[Record]) -> String {
    let mut ways: BTreeMap<(String, i64), Vec<f64>> = BTreeMap::new();
    for run in records.iter().flat_map(|record| &record.runs) {
        let decade = -run.tolerance.log10().round() as i64;
        let ways = ways.entry((run.solver.clone(), decade)).or_default();
        ways.extend(run.numbers.iter().filter_map(|number| number.ratio));
    }
    let [left, top, width, height] = AREA;
    let across = |decades: f64| {
        left + (decades - f64::from(RATIOS[0])) / f64::from(RATIOS[1] - RATIOS[0]) * width
    };
    let down = |decades: f64| {
        top + (f64::from(SHARES[1]) - decades) / f64::from(SHARES[1] - SHARES[0]) * height
    };
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 700 410\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n\
         <title>Share of peaks beyond a multiple of the tolerance</title>\n\
         <style>svg{--paper:#fff;--rule:#d9dde3;--ink:#1a1d21;--ink-2:#59616b;--c0:#0072b2;--c1:#d55e00}\n\
         @media(prefers-color-scheme:dark){svg{--paper:#15181c;--rule:#343a43;--ink:#e9ebee;--ink-2:#a3abb6;--c0:#56b4e9;--c1:#ff8c42}}\n\
         .paper{fill:var(--paper)}text{fill:var(--ink-2)}.key{fill:var(--ink)}.grid{stroke:var(--rule)}.one{stroke:var(--ink)}path{fill:none;stroke-width:1.8}</style>\n\
         <rect class=\"paper\" width=\"700\" height=\"410\"/>\n",
    );
    for exponent in RATIOS[0]..=RATIOS[1] {
        let x = across(f64::from(exponent));
        let class = if exponent == 0 { "one" } else { "grid" };
        let _ = writeln!(
            svg,
            "<path class=\"{class}\" d=\"M{x:.1} {top}v{height}\" style=\"stroke-width:1\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">10<tspan dy=\"-5\" font-size=\"9\">{exponent}</tspan></text>",
            top + height + 20.0
        );
    }
    for exponent in SHARES[0]..=SHARES[1] {
        let y = down(f64::from(exponent));
        let percent = 10f64.powi(exponent + 2);
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M{left} {y:.1}h{width}\" style=\"stroke-width:1\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{percent} %</text>",
            left - 8.0,
            y + 4.0
        );
    }
    for (index, ((solver, decade), ratios)) in ways.iter_mut().enumerate() {
        ratios.sort_by(f64::total_cmp);
        let colour = usize::from(solver != "modal");
        let dash = DASHES[(*decade - 2).clamp(0, 2) as usize];
        let style = format!("style=\"stroke:var(--c{colour});stroke-dasharray:{dash}\"");
        let mut line = String::new();
        for k in 0..=140 {
            let decades =
                f64::from(RATIOS[0]) + f64::from(RATIOS[1] - RATIOS[0]) * f64::from(k) / 140.0;
            let beyond =
                ratios.len() - ratios.partition_point(|ratio| *ratio <= 10f64.powf(decades));
            if beyond == 0 {
                break;
            }
            let share = (beyond as f64 / ratios.len() as f64).log10();
            let y = down(share.max(f64::from(SHARES[0])));
            let _ = write!(
                line,
                "{}{:.1} {y:.1}",
                if line.is_empty() { 'M' } else { 'L' },
                across(decades)
            );
        }
        let y = top + 200.0 + 17.0 * index as f64;
        let _ = writeln!(
            svg,
            "<path {style} d=\"{line}\"/><path {style} d=\"M{} {y}h30\"/><text class=\"key\" x=\"{}\" y=\"{}\">{solver}, tolerance 1e-{decade}</text>",
            left + 14.0,
            left + 52.0,
            y + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">error / tolerance [–]</text><text x=\"{left}\" y=\"16\">share of peaks with a greater error [%]</text>\n</svg>",
        left + width,
        top + height + 42.0
    );
    svg
}

/// How many models of which seeds.
fn drawn(records: &[Record]) -> String {
    let all: usize = records.iter().map(|record| record.models).sum();
    let seeds: Vec<String> = records
        .iter()
        .map(|record| record.seed.to_string())
        .collect();
    match seeds.as_slice() {
        [only] => format!("{all} models with seed {only}"),
        several => format!("{all} models with the seeds {}", several.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(ratios: &[Option<f64>], warned: bool) -> Record {
        let numbers = ratios.iter().enumerate().map(|(k, ratio)| NumberRecord {
            kind: "drift".to_owned(),
            name: format!("A floor {}", k + 1),
            ratio: *ratio,
        });
        Record {
            seed: 7,
            models: 1,
            runs: vec![RunRecord {
                model: 3,
                kind: "alone".to_owned(),
                laws: "none".to_owned(),
                solver: "modal".to_owned(),
                tolerance: 1e-3,
                warned,
                false_alarm: false,
                cut_s: None,
                numbers: numbers.collect(),
            }],
            failures: Vec::new(),
        }
    }

    #[test]
    fn misses_are_silent_only_if_the_run_did_not_warn() {
        let ratios = [Some(0.5), Some(2.0), Some(4.0), None];
        let silent = closing_text(&[record(&ratios, false)]);
        assert!(silent.starts_with("1 numbers beyond 3"), "{silent}");
        assert!(silent.contains("drift A floor 3, 4.00 times"), "{silent}");
        assert!(silent.contains("33.333 % of 3 numbers"), "{silent}");
        let warned = closing_text(&[record(&ratios, true)]);
        assert!(warned.starts_with("0 numbers beyond 3"), "{warned}");
        assert!(warned.contains("100.000 % of 3 numbers"), "{warned}");
    }

    #[test]
    fn a_page_changes_between_its_marks_only() {
        let old = format!("before\n{}old\n{}after\n", MARKS[0], MARKS[1]);
        let new = page(&old, &[record(&[Some(0.5)], false)]).expect("a page");
        assert!(new.starts_with(&format!("before\n{}", MARKS[0])));
        assert!(new.ends_with(&format!("{}after\n", MARKS[1])));
        assert!(!new.contains("old\n"));
        assert!(new.contains("| modal at 1e-3 | 1 | 100.00 % |"), "{new}");
        assert!(page("no marks", &[]).is_err());
    }

    #[test]
    fn records_survive_their_file() {
        let all = record(&[Some(0.5), None, Some(f64::MAX)], true);
        let text = serde_json::to_string(&all).expect("JSON");
        let back: Record = serde_json::from_str(&text).expect("a record");
        let ratios = |r: &Record| -> Vec<Option<f64>> {
            r.runs[0].numbers.iter().map(|n| n.ratio).collect()
        };
        assert_eq!(ratios(&back), ratios(&all));
    }
}
