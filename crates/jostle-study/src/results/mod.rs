//! Output of a finished study: a page, and the tables of its figures.

mod curves;
mod fragilities;
mod groups;
mod head;
mod maps;
mod needed;
mod rankings;
mod roses;
mod sample;
mod sampled;
mod selection;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::Path;

use jostle_io::shown::{FORCE, by_model};
use jostle_io::{
    Factor, FactorValues, STANDARD_GRAVITY, Values, csv_field, write_atomically,
    write_values_parquet,
};
use jostle_report::message;
use jostle_report::{Axis, Section, StudyPage, render_study};

use crate::dataset::{Table, visit_parts};
use crate::key_words::key_in_words;
use crate::layout::Kind;
use crate::runner::run_folder;
use crate::study::{Study, StudyError};
use crate::varied::varied;
use sample::{MOST_DRAWN, Sample};

/// Columns that every page uses.
const ALWAYS: [&str; 7] = [
    "status",
    "reason",
    "motion",
    "impact_count",
    "peak_force_n",
    "first_impact_s",
    "pga_m_s2",
];
/// Cases beyond which no CSV of all cases is written.
const MOST_IN_CSV: u64 = 200_000;
/// Failed cases named on the page.
const NAMED_FAILURES: usize = 20;

/// A finished study with the columns that its figures need, of the cases that are drawn.
struct Results<'a> {
    study: &'a Study,
    folder: &'a Path,
    table: Table,
    sample: Sample,
    counts: Counts,
    /// Cases whose histories are kept.
    kept: BTreeSet<u64>,
    /// Tables written so far: name and what it holds.
    files: Vec<(String, String)>,
    /// Further sentences for the head of the page.
    said: Vec<String>,
    /// The gap needed at the strongest intensity, and its note, where widths were varied.
    needed: Option<[String; 2]>,
}

/// What the head of the page says of all cases.
#[derive(Default)]
struct Counts {
    /// Cases with results, and those of them with an impact.
    known: usize,
    touched: usize,
    /// Greatest force \[N\].
    most: f64,
    failed: usize,
    failures: Vec<(u64, String)>,
    greatest: head::Greatest,
}

impl Counts {
    /// Adds the rows of a part that begins with a case.
    fn add(&mut self, first: u64, rows: &Table) {
        let impacts = rows.column("impact_count").iter().flatten();
        self.known += impacts.clone().count();
        self.touched += impacts.filter(|count| **count > 0.0).count();
        let forces = rows.column("peak_force_n").iter().flatten();
        self.most = forces.copied().fold(self.most, f64::max);
        self.greatest.add(first, rows);
        let text = |name: &str, row: usize| {
            let texts = rows.texts.get(name).and_then(|texts| texts.get(row));
            texts.map_or("", |text| &text[..])
        };
        for row in 0..rows.rows {
            if text("status", row) == "completed" {
                continue;
            }
            self.failed += 1;
            if self.failures.len() < NAMED_FAILURES {
                let reason = text("reason", row).to_owned();
                self.failures.push((first + row as u64, reason));
            }
        }
    }
}

/// Writes `report.html`, the tables of its figures and, unless there are more than 200 000 cases, `cases.csv`; with `csv` in any
/// case. Returns what was written, in words. Figures of more cases than that are drawn from a part of them, so that memory does not
/// grow with the number of cases.
///
/// # Errors
/// [`StudyError`] when a part is absent or a file cannot be written.
pub fn finish(study: &Study, folder: &Path, csv: bool) -> Result<String, StudyError> {
    by_model(study.file.base.units(), || written(study, folder, csv))
}

fn written(study: &Study, folder: &Path, csv: bool) -> Result<String, StudyError> {
    let mut wanted: Vec<&str> = ALWAYS.to_vec();
    wanted.extend(study.layout.inputs.iter().map(|column| &column.name[..]));
    let columns = needed::columns(study);
    wanted.extend(columns.iter().map(|name| &name[..]));
    for fragility in &study.file.fragilities {
        wanted.extend([&fragility.intensity[..], &fragility.demand]);
    }
    for ida in &study.file.idas {
        wanted.extend([&ida.intensity[..], &ida.demand]);
    }
    let answers = head::columns(study);
    wanted.extend(answers.iter().map(|name| &name[..]));
    let over_angle = roses::columns(study);
    wanted.extend(over_angle.iter().map(|name| &name[..]));
    let responses = rankings::responses(study);
    wanted.extend(responses.iter().map(|name| &name[..]));
    let sample = Sample::new(study, MOST_DRAWN);
    let (mut table, mut counts) = (Table::default(), Counts::default());
    visit_parts(study, folder, &wanted, &mut |first, rows| {
        counts.add(first, &rows);
        let held = (0..rows.rows).filter(|row| sample.holds(first + *row as u64));
        table.take_rows(&rows, &held.collect::<Vec<_>>());
    })?;
    let mut results = Results {
        study,
        folder,
        table,
        sample,
        counts,
        kept: kept(folder),
        files: vec![("cases/*.parquet".into(), message::one_row_a_case().into())],
        said: Vec::new(),
        needed: None,
    };
    if csv || study.design.cases <= MOST_IN_CSV {
        write_csv(study, folder)?;
        results
            .files
            .push(("cases.csv".into(), message::same_as_text().into()));
    }
    let mut sections: Vec<Section> = Vec::new();
    let maps = results.maps();
    sections.extend(results.roses(&over_angle)?);
    sections.extend(results.curves());
    sections.extend(results.sweep_curves());
    sections.extend(results.needed_gap());
    sections.extend(results.idas()?);
    sections.extend(results.fragilities()?);
    sections.extend(results.scatter(&responses));
    sections.extend(results.rankings(&responses)?);
    sections.extend(results.selection()?);
    let page = results.page(maps, sections)?;
    write_atomically(&folder.join("report.html"), render_study(&page).as_bytes())?;
    let mut said = page.headline.join("\n");
    said += &format!("\nreport: {}", folder.join("report.html").display());
    Ok(said)
}

impl Results<'_> {
    /// The axis of a factor, in the unit that the study file gives accelerations in, and by what its numbers are multiplied there.
    fn input_axis(&self, factor: usize) -> (Axis, f64) {
        let (axis, size) = words::axis(&self.study.layout.inputs[factor].name);
        let is_in_g = match &self.study.file.factors[factor] {
            Factor {
                unit,
                values: FactorValues::Listed(levels),
                ..
            } => unit == "m_s2" && levels.iter().all(|level| level.label.ends_with(" g")),
            _ => false,
        };
        match is_in_g {
            true => (
                Axis {
                    unit: "g".into(),
                    ..axis
                },
                1.0 / STANDARD_GRAVITY,
            ),
            false => (axis, size),
        }
    }

    /// Numbers of a factor case by case; positions in its list where it has no numbers.
    fn input(&self, factor: usize) -> Vec<Option<f64>> {
        let column = &self.study.layout.inputs[factor];
        if column.kind != Kind::Text {
            return self.table.column(&column.name).to_vec();
        }
        let Some(texts) = self.table.texts.get(&column.name) else {
            return Vec::new();
        };
        if let FactorValues::Listed(levels) = &self.study.file.factors[factor].values {
            let place = |text: &String| levels.iter().position(|level| level.label == *text);
            return texts.iter().map(|text| Some(place(text)? as f64)).collect();
        }
        // Numbers of different texts in the order in which they occur.
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        texts
            .iter()
            .map(|text| {
                let next = known.len();
                Some(*known.entry(text).or_insert(next) as f64)
            })
            .collect()
    }

    fn completed(&self, case: usize) -> bool {
        let status = self.table.texts.get("status");
        status
            .and_then(|status| status.get(case))
            .is_some_and(|status| status != "failed")
    }

    /// The link to the report of a case whose histories are kept.
    fn link(&self, case: u64) -> Option<String> {
        let kept = self.kept.contains(&case);
        kept.then(|| format!("runs/case-{case:010}/report.html"))
    }

    /// Writes a table as Parquet and as CSV.
    fn write(
        &mut self,
        name: &str,
        what: &str,
        columns: Vec<(String, Values)>,
    ) -> Result<(), StudyError> {
        let text = csv(&columns);
        let path = self.folder.join(format!("{name}.csv"));
        write_atomically(&path, text.as_bytes())?;
        let path = self.folder.join(format!("{name}.parquet"));
        write_values_parquet(&path, &self.study.file.title, &[], columns)?;
        self.files
            .push((format!("{name}.csv, {name}.parquet"), what.to_owned()));
        Ok(())
    }

    fn page(
        mut self,
        maps: Vec<(String, Vec<jostle_report::HeatMap>)>,
        sections: Vec<Section>,
    ) -> Result<StudyPage, StudyError> {
        let study = self.study;
        let (subject, answers) = (self.subject(), self.answers()?);
        let failures = std::mem::take(&mut self.counts.failures);
        let Counts {
            known,
            touched,
            most,
            failed,
            ..
        } = self.counts;
        let mut headline = Vec::new();
        if known > 0 {
            let forces = if touched == 0 {
                String::new()
            } else {
                message::greatest_force_of_cases(jostle_report::with_unit(FORCE.of(most), ""))
            };
            headline.push(message::buildings_pound_in_cases(touched, known, forces));
        }
        if self.sample.rows < study.design.cases {
            headline.push(message::figures_show_some_cases(
                self.sample.rows,
                study.design.cases,
            ));
        }
        headline.extend(self.said.iter().cloned());
        let mut facts = vec![
            (
                message::cases_head().to_owned(),
                study.design.cases.to_string(),
            ),
            (
                message::design_word().into(),
                words::design(study.file.design.kind).into(),
            ),
        ];
        if study.file.design.samples.is_some() {
            facts.push((
                message::seed_word().into(),
                study.file.design.seed.to_string(),
            ));
        }
        facts.extend(
            varied(study)
                .into_iter()
                .map(|one| (capital(&key_in_words(&one.name)), one.values_in_words())),
        );
        let runs = study.file.histories.iter();
        let runs = runs.filter_map(|case| {
            let link = self.link(*case)?;
            Some((*case, self.case_in_words(*case, usize::MAX), link))
        });
        Ok(StudyPage {
            kind: String::new(),
            title: study.file.title.clone(),
            subject,
            headline,
            answers,
            facts,
            maps,
            sections,
            failures,
            failed,
            runs: runs.collect(),
            // The folder knows its study and its model, wherever these came from.
            command: format!("jostle study {}", words::argument(self.folder)),
            files: self.files,
        })
    }
}

/// A text as it begins a line.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters.clone()).collect()
}

/// The cases with their own report.
fn kept(folder: &Path) -> BTreeSet<u64> {
    let entries = std::fs::read_dir(folder.join("runs"));
    let number = |entry: std::fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        let number: u64 = name.strip_prefix("case-")?.parse().ok()?;
        let report = run_folder(folder, number).join("report.html");
        report.is_file().then_some(number)
    };
    entries
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(number)
        .collect()
}

/// All cases as text, part by part.
fn write_csv(study: &Study, folder: &Path) -> Result<(), StudyError> {
    let path = folder.join("cases.csv");
    let unwritable =
        |error: &dyn std::fmt::Display| StudyError::Output(format!("{}: {error}", path.display()));
    let names = study.layout.names();
    // Several processes that finish a study at the same time write the same table.
    let part = format!(
        "{}cases{}",
        jostle_io::part_prefix(),
        jostle_io::PART_SUFFIX
    );
    let part = folder.join(part);
    let file = std::fs::File::create(&part).map_err(|error| unwritable(&error))?;
    let mut writer = std::io::BufWriter::new(file);
    let quoted: Vec<String> = names.iter().map(|name| csv_field(name)).collect();
    writeln!(writer, "{}", quoted.join(",")).map_err(|error| unwritable(&error))?;
    for number in 0..study.parts() {
        let mut table = Table::default();
        crate::dataset::read_part(study, folder, number, &names, &mut table)?;
        for row in 0..table.rows {
            let cells = names.iter().map(|name| match table.numbers.get(*name) {
                Some(values) => values
                    .get(row)
                    .copied()
                    .flatten()
                    .map_or(String::new(), |value| value.to_string()),
                None => {
                    let texts = table.texts.get(*name);
                    csv_field(
                        texts
                            .and_then(|texts| texts.get(row))
                            .map_or("", |text| text),
                    )
                }
            });
            let line: Vec<String> = cells.collect();
            writeln!(writer, "{}", line.join(",")).map_err(|error| unwritable(&error))?;
        }
    }
    let file = writer.into_inner().map_err(|error| unwritable(&error))?;
    file.sync_all().map_err(|error| unwritable(&error))?;
    drop(file);
    Ok(jostle_io::put_in_place(&part, &path)?)
}

pub(crate) fn csv(columns: &[(String, Values)]) -> String {
    let cell = |values: &Values, row: usize| match values {
        Values::Real(values) => values[row].to_string(),
        Values::Instant(values) => values[row].map_or(String::new(), |value| value.to_string()),
        Values::Whole(values) => values[row].map_or(String::new(), |value| value.to_string()),
        Values::Text(values) => csv_field(&values[row]),
        // No table of a study has bytes.
        Values::Bytes(_) => String::new(),
    };
    let heads: Vec<String> = columns.iter().map(|(name, _)| csv_field(name)).collect();
    let mut text = heads.join(",") + "\n";
    for row in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        let cells: Vec<String> = columns
            .iter()
            .map(|(_, values)| cell(values, row))
            .collect();
        text += &(cells.join(",") + "\n");
    }
    text
}
