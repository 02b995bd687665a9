//! The answers above a study: the gap needed, the hardest impact, the worst drift and member, where they are, and how many cases are
//! accurate.

use std::collections::{BTreeMap, BTreeSet};

use jostle_io::Input;
use jostle_io::shown::{FORCE, HEIGHT, LENGTH};
use jostle_report::{message, typeset, with_unit};

use super::{Results, capital};
use crate::dataset::{Table, read_part};
use crate::key_words::{key_in_words, label_in_words};
use crate::study::{Study, StudyError};

/// Whether the errors of a case stay within the tolerance.
const ACCURATE: &str = "accuracy_met";
/// Peaks of buildings that have a tile: drifts, each of them the greatest of its storeys; demand over capacity; hinges that yielded.
const DRIFTS: [&str; 3] = ["drift_peak", "drift_across_peak", "drift_corner_peak"];
const RATIO: &str = "capacity_ratio";
const YIELDED: &str = "hinges_yielded";
/// Keys beyond which a case is named by its number alone.
const MOST_KEYS: usize = 3;

/// Names of both sides of every gap.
pub(super) fn pairs(input: &Input) -> impl Iterator<Item = [&str; 2]> {
    input.model.gaps.iter().map(|gap| {
        gap.between.map(|side| {
            side.and_then(|index| input.model.buildings.get(index))
                .map_or("wall", |building| &building.name[..])
        })
    })
}

/// The columns of the answers.
pub(super) fn columns(study: &Study) -> Vec<String> {
    let Ok(input) = study.file.base.input() else {
        return Vec::new();
    };
    let buildings = input.model.buildings.iter();
    let buildings = buildings.flat_map(|building| {
        let ends = DRIFTS.into_iter().chain([RATIO, YIELDED]);
        ends.map(move |end| format!("{}.{end}", building.name))
    });
    let ends = [
        "width_m",
        "impact_count",
        "closing_peak_m",
        "closing_without_contact_m",
    ];
    let gaps = pairs(&input).flat_map(|pair| ends.map(|end| format!("{}.{end}", pair.join("-"))));
    let mut all: Vec<String> = buildings.chain(gaps).collect();
    all.push(ACCURATE.to_owned());
    all.retain(|name| study.layout.place(name).is_some());
    all
}

/// The greatest values over all cases.
#[derive(Default)]
pub(super) struct Greatest {
    /// Of every column, with its case.
    of: BTreeMap<String, (f64, u64)>,
    /// Gap needed of the pair that needs most, and its case \[m\].
    needed: Option<(f64, u64)>,
    /// Whether some pair touches at its gap, so that it needs more, and no run without contact says how much.
    is_open: bool,
    /// Cases whose accuracy is known, and those within the tolerance.
    judged: usize,
    accurate: usize,
    motions: BTreeSet<String>,
}

impl Greatest {
    /// Adds the rows of a part that begins with a case.
    pub(super) fn add(&mut self, first: u64, rows: &Table) {
        for (name, values) in &rows.numbers {
            for (row, value) in values.iter().enumerate() {
                let Some(value) = value else { continue };
                let greatest = self.of.entry(name.clone());
                let greatest = greatest.or_insert((f64::NEG_INFINITY, first));
                if *value > greatest.0 {
                    *greatest = (*value, first + row as u64);
                }
            }
        }
        let accurate = rows.column(ACCURATE).iter().flatten();
        self.judged += accurate.clone().count();
        self.accurate += accurate.filter(|met| **met > 0.0).count();
        let pairs = rows
            .numbers
            .keys()
            .filter_map(|name| name.strip_suffix(".width_m"));
        for pair in pairs {
            let column = |end: &str| rows.column(&format!("{pair}.{end}"));
            let (widths, impacts) = (column("width_m"), column("impact_count"));
            let (closings, free) = (
                column("closing_peak_m"),
                column("closing_without_contact_m"),
            );
            let at = |values: &[Option<f64>], row: usize| values.get(row).copied().flatten();
            for row in 0..rows.rows {
                let found = match (at(free, row), at(impacts, row)) {
                    (Some(free), _) => Some(free),
                    (None, Some(0.0)) => at(closings, row),
                    (None, Some(_)) => {
                        self.is_open = true;
                        at(widths, row)
                    }
                    (None, None) => None,
                };
                if let Some(found) =
                    found.filter(|found| self.needed.is_none_or(|own| *found > own.0))
                {
                    self.needed = Some((found, first + row as u64));
                }
            }
        }
        self.motions
            .extend(rows.texts.get("motion").into_iter().flatten().cloned());
        self.motions.remove("");
    }

    /// The greatest of columns with one of some ends: owner, end, value, case.
    fn of_ends<'a>(&'a self, ends: &[&'a str]) -> Option<(&'a str, &'a str, f64, u64)> {
        let found = self.of.iter().filter_map(|(name, (value, case))| {
            let (owner, end) = name.rsplit_once('.')?;
            ends.contains(&end).then_some((owner, end, *value, *case))
        });
        found.max_by(|a, b| a.2.total_cmp(&b.2))
    }
}

impl Results<'_> {
    /// Model and records, where the title does not name them.
    pub(super) fn subject(&self) -> String {
        let input = self.study.file.base.input().ok();
        let model = input.map_or_else(String::new, |input| input.model.title.clone());
        let motions = &self.counts.greatest.motions;
        let records = match (motions.first(), motions.len()) {
            (Some(only), 1) => message::one_record_of(only),
            (_, count) => message::several_records(count),
        };
        match model.is_empty() || self.study.file.title.contains(&model) {
            true => records,
            false => format!("{model}; {records}"),
        }
    }

    /// A case by its values, or by its number if they are many.
    pub(super) fn case_in_words(&self, case: u64, most: usize) -> String {
        let factors = &self.study.file.factors;
        if factors.len() > most {
            return message::case_of_number(case);
        }
        let choices = self.study.design.choices(case, factors);
        let values = factors.iter().zip(&choices).map(|(factor, choice)| {
            let value = crate::design::value_of(factor, choice).2;
            format!(
                "{} {}",
                key_in_words(&factor.name),
                typeset(label_in_words(&value))
            )
        });
        values.collect::<Vec<_>>().join(", ")
    }

    /// Tiles of the answers: name, value and note.
    pub(super) fn answers(&self) -> Result<Vec<[String; 3]>, StudyError> {
        let greatest = &self.counts.greatest;
        let case = |case: u64| self.case_in_words(case, MOST_KEYS);
        let at = |place: String, own: u64| match place.is_empty() {
            true => case(own),
            false => format!("{place}; {}", case(own)),
        };
        let mut tiles = Vec::new();
        match (&self.needed, greatest.needed) {
            (Some([value, note]), _) => {
                tiles.push([message::gap_needed(""), value.clone(), note.clone()]);
            }
            (None, Some((value, own))) => {
                let text = with_unit(LENGTH.of(value), LENGTH.name());
                let (text, note) = match greatest.is_open {
                    true => (
                        message::more_than(text),
                        message::touch_at_this_gap(case(own)),
                    ),
                    false => (text, case(own)),
                };
                tiles.push([message::gap_needed(""), text, note]);
            }
            (None, None) => {}
        }
        if let Some((force, own)) = greatest
            .of
            .get("peak_force_n")
            .filter(|(force, _)| *force > 0.0)
        {
            let place = self.floor_of(*own, &|column| {
                let (place, end) = column.rsplit_once('.')?;
                (end == "peak_force_n").then(|| contact_in_words(place))?
            })?;
            let force = with_unit(FORCE.of(*force), FORCE.name());
            tiles.push([
                message::peak_force_title().to_owned(),
                force,
                at(place, *own),
            ]);
        }
        if let Some((building, end, drift, own)) = greatest.of_ends(&DRIFTS) {
            let storey = self.floor_of(own, &|column| {
                let place = column.strip_prefix(&format!("{building}.floor"))?;
                let storey = place.strip_suffix(&format!(".storey_{end}"))?;
                Some(message::storey_of(building, storey))
            })?;
            let place = if storey.is_empty() {
                building.to_owned()
            } else {
                storey
            };
            let drift = format!("{:.2}\u{a0}%", 100.0 * drift);
            tiles.push([message::greatest_drift().to_owned(), drift, at(place, own)]);
        }
        if let Some((building, _, ratio, own)) = greatest.of_ends(&[RATIO]) {
            let ratio = message::times_its_capacity(format_args!("{ratio:.2}"));
            tiles.push([
                message::worst_member_title().to_owned(),
                ratio,
                at(building.to_owned(), own),
            ]);
        } else if let Some((building, _, count, own)) = greatest.of_ends(&[YIELDED]) {
            let name = capital(message::hinges_yielded_word());
            tiles.push([name, count.to_string(), at(building.to_owned(), own)]);
        }
        if greatest.judged > 0 {
            tiles.push([
                message::accuracy().trim_end_matches(':').to_owned(),
                message::one_of_all(greatest.accurate, self.counts.known.max(greatest.judged)),
                message::error_within_tolerance().to_owned(),
            ]);
        }
        Ok(tiles)
    }

    /// Where a case has the greatest of the columns that `place` names; empty if it names none.
    fn floor_of(
        &self,
        case: u64,
        place: &dyn Fn(&str) -> Option<String>,
    ) -> Result<String, StudyError> {
        let study = self.study;
        let columns = study.layout.results.iter().map(|column| &column.name[..]);
        let columns: Vec<&str> = columns.filter(|name| place(name).is_some()).collect();
        let part = (0..study.parts()).find(|part| study.part(*part).contains(&case));
        let (Some(part), false) = (part, columns.is_empty()) else {
            return Ok(String::new());
        };
        let mut rows = Table::default();
        read_part(study, self.folder, part, &columns, &mut rows)?;
        let row = (case - study.part(part).start) as usize;
        let values = columns.into_iter().filter_map(|name| {
            let value = rows.column(name).get(row).copied().flatten()?;
            Some((name, value))
        });
        // The first of equal ones.
        let worst = values.reduce(|a, b| if b.1 > a.1 { b } else { a });
        Ok(worst.and_then(|(name, _)| place(name)).unwrap_or_default())
    }
}

/// A contact by the beginning of its columns: `A-B.floor2-3` is floors 2 and 3, `A-B.at8400mm` a height.
fn contact_in_words(place: &str) -> Option<String> {
    let (_, place) = place
        .split_once(".floor")
        .or_else(|| place.split_once(".at"))?;
    if let Some(height) = place.strip_suffix("mm") {
        let height: f64 = height.parse().ok()?;
        return Some(message::height_m(HEIGHT.number(1e-3 * height, 2)));
    }
    let floors = place
        .split_once(".face")
        .map_or(place, |(floors, _)| floors);
    let (left, right) = floors.split_once('-')?;
    let [left, right] = [left, right].map(|floor| floor.parse::<usize>().ok());
    Some(match (left?, right?) {
        (left, right) if left == right => message::floor_one(left),
        (left, right) => message::floors_and(left, right),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contacts_read_as_words() {
        for (place, words) in [
            ("A-B.floor5-5", Some("floor 5")),
            ("A-B.floor2-3.face1", Some("floors 2 and 3")),
            ("A-B.at8400mm", Some("height 8.40\u{a0}m")),
            ("A-B", None),
        ] {
            assert_eq!(contact_in_words(place).as_deref(), words, "{place}");
        }
    }
}
