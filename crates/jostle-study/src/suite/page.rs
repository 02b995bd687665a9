//! The page of a suite: records, governing values, envelopes over the height, spectra.

use jostle::{GroundMotion, Wave};
use jostle_io::shown::{ACCELERATION, FORCE, HEIGHT, LENGTH, Shown};
use jostle_motion::{Accelerogram, Reading, response_spectrum, spaced_periods};
use jostle_report::message;
use jostle_report::{Axis, Chart, Section, Series, Stroke, SuitePage, SuiteRow, render_suite};
use serde_json::Value;

use super::Suite;
use super::quantities::{displacement, list};
use super::results::{RecordStatus, SuiteResults};
use super::text::{headlines, shown};

/// Damping ratio of the spectra unless a target has its own \[–\].
const DAMPING: f64 = 0.05;
/// Periods of the spectra \[s\].
const PERIODS: (f64, f64, usize) = (0.05, 3.0, 120);
/// Colour of lines that belong to no building.
const NEUTRAL: usize = 6;

/// A peak of floors over the height.
struct Peak {
    title: fn() -> &'static str,
    /// Its unit; percent if it has none.
    unit: Option<Shown>,
    /// Whether it belongs to the storey below the floor.
    of_storey: bool,
    of: fn(&Value) -> Option<f64>,
}

const PEAKS: [Peak; 6] = [
    Peak {
        title: message::peak_displacement_over_height,
        unit: Some(LENGTH),
        of_storey: false,
        of: displacement,
    },
    Peak {
        title: message::peak_storey_drift_over_height,
        unit: None,
        of_storey: true,
        of: |floor| floor["storey_drift_peak"].as_f64(),
    },
    Peak {
        title: message::peak_drift_of_corners_over_height,
        unit: None,
        of_storey: true,
        of: |floor| floor["storey_drift_corner_peak"].as_f64(),
    },
    Peak {
        title: message::peak_acceleration_across_over_height,
        unit: Some(ACCELERATION),
        of_storey: false,
        of: |floor| floor["total_acceleration_across_peak_m_s2"].as_f64(),
    },
    Peak {
        title: message::peak_total_acceleration_over_height,
        unit: Some(ACCELERATION),
        of_storey: false,
        of: |floor| floor["total_acceleration_peak_m_s2"].as_f64(),
    },
    Peak {
        title: message::peak_storey_shear_over_height,
        unit: Some(FORCE),
        of_storey: true,
        of: |floor| floor["storey_shear_peak_n"].as_f64(),
    },
];

impl SuiteResults {
    /// The page; `links` to the reports of the records.
    pub(super) fn page(&self, suite: &Suite, links: bool) -> String {
        let mut sections = Vec::new();
        let done: Vec<&Value> = self
            .records
            .iter()
            .filter(|record| record.status == RecordStatus::Completed)
            .map(|record| &record.summary)
            .collect();
        if let Some(first) = done.first() {
            for (index, building) in list(first, "buildings").enumerate() {
                let name = building["name"].as_str().unwrap_or_default();
                let charts = PEAKS.iter().map(|peak| over_height(&done, index, peak));
                sections.push(Section {
                    title: message::peaks_over_height(name),
                    remark: message::thin_records_heavy_mean().into(),
                    charts: charts.flatten().collect(),
                    ..Section::default()
                });
            }
        }
        sections.extend(self.spectra(suite));
        render_suite(&SuitePage {
            title: self.title.clone(),
            headline: self.result_in_words(),
            rule: self.governing.in_words(self.records.len()),
            tiles: self.tiles(),
            warnings: self.warnings.clone(),
            accuracy: self.accuracy_in_words().map_or_else(String::new, |words| {
                words.trim_start_matches("accuracy: ").to_owned()
            }),
            checks: self.checks.clone(),
            records: self.rows(links),
            quantities: self.quantity_rows(),
            statistic: self.governing.statistic.name(),
            sections,
            files: vec![
                (
                    "suite.json".into(),
                    message::all_quantities_of_all_records().into(),
                ),
                ("suite.parquet".into(), message::one_row_per_record().into()),
            ],
        })
    }

    fn rows(&self, links: bool) -> Vec<SuiteRow> {
        let records = self.records.iter();
        records
            .map(|record| {
                let motion = &record.summary["motion"];
                let gaps = || list(&record.summary, "gaps");
                let impacts: u64 = gaps().filter_map(|gap| gap["impact_count"].as_u64()).sum();
                let force = gaps().filter_map(|gap| gap["peak_force_n"].as_f64());
                let force = force.fold(0.0, f64::max);
                let number = |key: &str, decimals: usize| {
                    format!("{:.decimals$}", motion[key].as_f64().unwrap_or(f64::NAN))
                };
                SuiteRow {
                    name: record.motion().to_owned(),
                    link: links.then(|| format!("{}/report.html", record.folder)),
                    cells: vec![
                        ACCELERATION.number(motion["pga_m_s2"].as_f64().unwrap_or(f64::NAN), 3),
                        number("scale", 4),
                        number("duration_s", 2),
                        impacts.to_string(),
                        FORCE.number(force, 1),
                        match gaps()
                            .filter_map(|gap| gap["closing_without_contact_m"].as_f64())
                            .max_by(f64::total_cmp)
                        {
                            Some(needed) => LENGTH.number(needed, 1),
                            None => "–".to_owned(),
                        },
                    ],
                    remark: record.reason.clone().unwrap_or_default(),
                }
            })
            .collect()
    }

    /// How many records pound, and the hardest.
    fn result_in_words(&self) -> String {
        let done = self.records.iter();
        let done = done.filter(|record| record.status == RecordStatus::Completed);
        let done: Vec<&Value> = done.map(|record| &record.summary).collect();
        let gaps = |record: &&&Value| {
            list(record, "gaps").any(|gap| gap["impact_count"].as_u64() > Some(0))
        };
        let pounding = done.iter().filter(gaps).count();
        if !done
            .iter()
            .any(|record| list(record, "gaps").next().is_some())
        {
            return message::suite_of_no_gap(done.len());
        }
        let pounds = match pounding {
            0 => message::suite_without_contact(done.len()),
            some => message::suite_pounds(some, done.len()),
        };
        pounds + &self.gap_needed_in_words(&done)
    }

    /// The greatest gap that a record needs beside the gap there is, of models with one gap.
    fn gap_needed_in_words(&self, done: &[&Value]) -> String {
        let Some([gap]) = done
            .first()
            .and_then(|record| record["gaps"].as_array())
            .map(Vec::as_slice)
        else {
            return String::new();
        };
        let all = headlines(self);
        let needed = all
            .iter()
            .find(|(_, quantity)| quantity.name.ends_with(".closing_without_contact_m"));
        match (needed, gap["width_m"].as_f64()) {
            (Some((_, needed)), Some(there)) if needed.maximum > 0.0 => {
                let record = self.records[needed.maximum_record].motion();
                let there = jostle_report::with_unit(LENGTH.of(there), LENGTH.name());
                let needed = jostle_report::with_unit(LENGTH.of(needed.maximum), LENGTH.name());
                message::gap_needed_of_suite(needed, record, there)
            }
            _ => String::new(),
        }
    }

    /// Governing values of what decides, each the greatest of all gaps or buildings: force, gap, drift, damage.
    fn tiles(&self) -> Vec<[String; 3]> {
        // Ends of names of one kind: the greatest of them has the tile.
        const KINDS: [&[&str]; 10] = [
            &[".closing_without_contact_m"],
            &[".peak_force_n"],
            &[".capacity_ratio"],
            &[".drift_peak", ".drift_across_peak", ".drift_corner_peak"],
            &[
                ".total_acceleration_peak_m_s2",
                ".total_acceleration_across_peak_m_s2",
            ],
            &[".stroke_peak_m"],
            &[".storey_shear_peak_n"],
            &[".hinges_yielded"],
            &[".ductility"],
            &[".residual_drift_peak"],
        ];
        let statistic = self.governing.statistic.name();
        let all = headlines(self);
        let greatest = KINDS.iter().filter_map(|ends| {
            let of_kind = all.iter().filter(|(_, quantity)| {
                ends.iter().any(|end| quantity.name.ends_with(end)) && quantity.maximum > 0.0
            });
            of_kind.max_by(|a, b| a.1.governing.total_cmp(&b.1.governing))
        });
        let tiles = greatest.map(|(name, quantity)| {
            let form = shown(&quantity.name);
            let with_unit = |value: f64| {
                let text = format!("{} {}", form.number(value), form.unit);
                text.trim_end().to_owned()
            };
            let worst = &self.records[quantity.maximum_record];
            let record = match place(&worst.summary, &quantity.name) {
                Some(place) => format!("{place}; {}", worst.motion()),
                None => worst.motion().to_owned(),
            };
            [
                name.clone(),
                with_unit(quantity.governing),
                match quantity.governing == quantity.maximum {
                    true => record,
                    false => message::greatest_value_of_record(
                        statistic,
                        with_unit(quantity.maximum),
                        record,
                    ),
                },
            ]
        });
        tiles.collect()
    }

    /// Name, governing, mean, deviation, 16 and 84 %, greatest with its record.
    fn quantity_rows(&self) -> Vec<Vec<String>> {
        let lines = headlines(self).into_iter().map(|(name, quantity)| {
            let form = shown(&quantity.name);
            let unit = match form.unit {
                "" => name,
                unit => format!("{name} [{unit}]"),
            };
            let deviation = quantity.standard_deviation;
            vec![
                unit,
                form.number(quantity.governing),
                form.number(quantity.mean),
                deviation.map_or("–".into(), |value| form.number(value)),
                format!(
                    "{} to {}",
                    form.number(quantity.p16),
                    form.number(quantity.p84)
                ),
                form.number(quantity.maximum),
                match quantity.maximum > 0.0 {
                    true => self.records[quantity.maximum_record].motion().to_owned(),
                    false => "–".to_owned(),
                },
                self.without_contact(&quantity.name)
                    .map_or("–".into(), |free| form.number(free)),
            ]
        });
        lines.collect()
    }

    /// The governing value of the runs without contact, if they have the quantity.
    fn without_contact(&self, name: &str) -> Option<f64> {
        let (owner, end) = name.rsplit_once('.')?;
        let free = self.quantity(&format!("{owner}.without_contact.{end}"))?;
        Some(free.governing)
    }

    /// Spectra of the motions as used, their mean, and the target.
    fn spectra(&self, suite: &Suite) -> Option<Section> {
        let target = suite.records.first()?.input().target();
        let damping = target.map_or(DAMPING, |(_, damping)| damping);
        let periods = spaced_periods(PERIODS.0, PERIODS.1, PERIODS.2);
        let mut series = Vec::new();
        let mut mean = vec![0.0; periods.len()];
        let mut count = 0.0;
        for record in &suite.records {
            let motion = record.prepare().ok()?.motion;
            let motion = accelerogram(&motion)?;
            let found = response_spectrum(&motion, &periods, &[damping], Reading::Steps).ok()?;
            let values = found.curves[0].pseudo_acceleration.iter();
            let values: Vec<f64> = values.map(|value| ACCELERATION.of(*value)).collect();
            mean.iter_mut()
                .zip(&values)
                .for_each(|(sum, value)| *sum += value);
            count += 1.0;
            series.push(line(&periods, &values, Stroke::Thin, 0, ""));
        }
        mean.iter_mut().for_each(|sum| *sum /= count);
        series.push(line(
            &periods,
            &mean,
            Stroke::Heavy,
            0,
            message::mean_of_records(),
        ));
        if let Some((target, _)) = target {
            let [first, last] = target.range();
            let points = periods
                .iter()
                .filter(|period| (first..=last).contains(*period));
            let points = points.filter_map(|period| {
                Some([
                    *period,
                    ACCELERATION.of(target.acceleration(*period, damping).ok()?),
                ])
            });
            series.push(Series {
                points: points.collect(),
                ..line(&[], &[], Stroke::Dashed, 1, message::spectrum_of_code())
            });
        }
        Some(Section {
            title: message::spectra_of_motions().into(),
            remark: message::spectra_as_used().into(),
            charts: vec![Chart {
                title: message::pseudo_acceleration_damped(format_args!("{:.0}", 100.0 * damping)),
                x: axis(message::period_axis(), "s"),
                y: axis(message::pseudo_acceleration_axis(), ACCELERATION.name()),
                series,
                ..Chart::default()
            }],
            ..Section::default()
        })
    }
}

/// Where a record has a quantity of a gap or a building: the contact, the member, the storey or the floor.
fn place(summary: &Value, name: &str) -> Option<String> {
    let (owner, key) = name.rsplit_once('.')?;
    let greatest = |owners: &mut dyn Iterator<Item = &Value>, key: &str| {
        let known = owners.filter_map(|owner| Some((owner.clone(), owner[key].as_f64()?)));
        known
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(owner, _)| owner)
    };
    if key == "peak_force_n" {
        let gap = list(summary, "gaps").find(|gap| {
            let names: Vec<&str> = list(gap, "between").filter_map(Value::as_str).collect();
            names.join("-") == owner
        })?;
        let contact = greatest(&mut list(gap, "contacts"), key)?;
        let floor = |side: usize| contact["floors"][side].as_u64();
        return Some(match (floor(0), floor(1)) {
            (Some(left), Some(right)) if left == right => message::floor_one(left),
            (Some(left), Some(right)) => message::floors_and(left, right),
            _ => message::height_m(HEIGHT.number(contact["height_m"].as_f64()?, 2)),
        });
    }
    let building = list(summary, "buildings").find(|building| building["name"] == owner)?;
    if key == "capacity_ratio" {
        let worst = &building["capacity"]["worst"];
        let [member, kind] = ["member", "kind"].map(|key| worst[key].as_str().unwrap_or_default());
        return Some(message::member_in(member, kind));
    }
    let (of_storey, key) = match key.contains("drift") {
        true => (true, format!("storey_{key}")),
        false => (false, key.to_owned()),
    };
    let floor = greatest(&mut list(building, "floors"), &key)?["floor"].as_u64()?;
    Some(match of_storey {
        true => message::storey_one(floor),
        false => message::floor_one(floor),
    })
}

fn axis(name: &str, unit: &str) -> Axis {
    Axis {
        name: name.into(),
        unit: unit.into(),
    }
}

fn line(xs: &[f64], ys: &[f64], stroke: Stroke, colour: usize, name: &str) -> Series {
    Series {
        name: name.into(),
        points: xs.iter().zip(ys).map(|(x, y)| [*x, *y]).collect(),
        band: Vec::new(),
        stroke,
        colour,
    }
}

/// Peaks of one building over its height; `None` if no record has them.
fn over_height(runs: &[&Value], building: usize, peak: &Peak) -> Option<Chart> {
    // A mat has no storey below it.
    let has_it = |floor: &&Value| !peak.of_storey || floor["floor"].as_u64() != Some(0);
    let floors: Vec<Vec<&Value>> = runs
        .iter()
        .map(|run| {
            let floors = list(&run["buildings"][building], "floors");
            floors.filter(has_it).collect()
        })
        .collect();
    let heights: Vec<f64> = floors
        .first()?
        .iter()
        .filter_map(|f| f["height_m"].as_f64())
        .collect();
    let values = |apart: bool| -> Vec<Vec<f64>> {
        let of = |floor: &&Value| {
            let owner = if apart {
                &floor["without_contact"]
            } else {
                *floor
            };
            let value = (peak.of)(owner)?;
            Some(peak.unit.map_or(100.0 * value, |unit| unit.of(value)))
        };
        let all = floors
            .iter()
            .map(|floors| floors.iter().filter_map(of).collect());
        all.filter(|list: &Vec<f64>| list.len() == heights.len())
            .collect()
    };
    let with = values(false);
    if with.is_empty() || heights.is_empty() {
        return None;
    }
    // Displacements are relative to the ground.
    let is_of_ground = peak
        .unit
        .is_some_and(|unit| unit.si_name() == LENGTH.si_name());
    let drawn = |values: &[f64], stroke, colour, name: &str| {
        let mut series = line(&[], &[], stroke, colour, name);
        let mut below = 0.0;
        if is_of_ground && heights[0] > 0.0 {
            series.points.push([0.0, 0.0]);
        }
        for (value, height) in values.iter().zip(&heights) {
            if peak.of_storey {
                series.points.push([*value, HEIGHT.of(below)]);
            }
            series.points.push([*value, HEIGHT.of(*height)]);
            below = *height;
        }
        series
    };
    let mut series: Vec<Series> = with
        .iter()
        .map(|values| drawn(values, Stroke::Thin, building, ""))
        .collect();
    let (mean, deviation) = mean_and_deviation(&with);
    if with.len() > 1 {
        let edge = |sign: f64| -> Vec<f64> {
            let pairs = mean.iter().zip(&deviation);
            pairs.map(|(m, d)| (m + sign * d).max(0.0)).collect()
        };
        series.push(drawn(&edge(1.0), Stroke::Dashed, NEUTRAL, ""));
        series.push(drawn(&edge(-1.0), Stroke::Dashed, NEUTRAL, ""));
    }
    series.push(drawn(
        &mean,
        Stroke::Heavy,
        building,
        message::mean_of_records(),
    ));
    let apart = values(true);
    if !apart.is_empty() {
        let (mean, _) = mean_and_deviation(&apart);
        series.push(drawn(
            &mean,
            Stroke::Dotted,
            NEUTRAL,
            message::mean_without_contact(),
        ));
    }
    Some(Chart {
        title: (peak.title)().into(),
        x: axis(
            &(peak.title)().to_lowercase(),
            peak.unit.map_or("%", Shown::name),
        ),
        y: axis(message::height_axis(), HEIGHT.name()),
        series,
        ..Chart::default()
    })
}

/// Mean and sample standard deviation at every place.
fn mean_and_deviation(lists: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
    let count = lists.len() as f64;
    let places = 0..lists.first().map_or(0, Vec::len);
    let mean: Vec<f64> = places
        .clone()
        .map(|i| lists.iter().map(|list| list[i]).sum::<f64>() / count)
        .collect();
    let deviation = places.map(|i| {
        let squares = lists.iter().map(|list| (list[i] - mean[i]).powi(2));
        (squares.sum::<f64>() / (count - 1.0).max(1.0)).sqrt()
    });
    let deviation = deviation.collect();
    (mean, deviation)
}

/// The motion as used, cut or continued to its duration.
fn accelerogram(motion: &GroundMotion) -> Option<Accelerogram> {
    let Wave::Sampled { step, .. } = &motion.wave else {
        return None;
    };
    let points = (motion.duration / step * (1.0 + 1e-12)).floor() as usize + 1;
    let values = (0..points).map(|i| motion.acceleration(step * i as f64));
    Accelerogram::new(*step, values.collect()).ok()
}
