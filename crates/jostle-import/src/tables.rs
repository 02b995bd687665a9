//! Tables of ETABS results, by title or by columns.

use jostle_io::InputError;

use crate::facts::{
    Displacement, Facts, FloorMass, ModePeriod, Story, StoryStiffness, UnitLoad, fault, key,
};
use crate::text::{number, plain};
use crate::units::{
    self, FORCE, INERTIA, LENGTH, MASS, MOMENT, NUMBER, STIFFNESS, Size, TIME, Units,
};
use crate::workbook::Table;

/// A table with its file, and units where it has no row of them.
struct Reading<'a> {
    file: &'a str,
    table: &'a Table,
    units: Option<Units>,
}

impl Reading<'_> {
    /// The column with one of these names.
    fn needed(&self, names: &[&str]) -> Result<usize, InputError> {
        self.table.column(names).ok_or_else(|| {
            let found: Vec<&str> = self
                .table
                .columns
                .iter()
                .map(|column| column.0.as_str())
                .collect();
            fault(
                self.file,
                format!("table {}", self.table.name),
                format!("has no column \"{}\", only {}", names[0], found.join(", ")),
                "export the table with all of its columns",
            )
        })
    }

    /// Factor to SI of a column.
    fn factor(&self, column: usize, size: Size) -> Result<f64, InputError> {
        let (name, unit) = &self.table.columns[column];
        let object = || format!("table {}, column \"{name}\"", self.table.name);
        let Some(unit) = unit else {
            // Times and angles have no other unit.
            if size == TIME || size == NUMBER {
                return Ok(1.0);
            }
            let units = self.units.ok_or_else(|| {
                fault(
                    self.file,
                    object(),
                    "has no unit",
                    "add --units \"kN, m\", the units in which the tables were exported",
                )
            })?;
            return Ok(units.factor(size));
        };
        match units::parse(unit) {
            Some((factor, found)) if found == size => Ok(factor),
            // Of a mass alone, lb is a mass.
            Some((_, FORCE)) if size == MASS && unit.eq_ignore_ascii_case("lb") => Ok(0.453_592_37),
            Some(_) => Err(fault(
                self.file,
                object(),
                format!("has the unit {unit}, which is of another kind"),
                "check the row of units below the names of columns",
            )),
            None => Err(fault(
                self.file,
                object(),
                format!("has the unit {unit}, which is not known"),
                "export the tables in N, kN, kgf, tonf, lb or kip with m, cm, mm, ft or in",
            )),
        }
    }

    /// A number of a row, in the unit of the file.
    fn number(&self, at: u32, row: &[String], column: usize) -> Result<f64, InputError> {
        let text = Table::text(row, Some(column));
        number(text).ok_or_else(|| {
            fault(
                self.file,
                format!(
                    "table {}, row {at}, column \"{}\"",
                    self.table.name, self.table.columns[column].0
                ),
                format!(
                    "expected a number, found \"{}\"",
                    text.chars().take(40).collect::<String>()
                ),
                "export the table again",
            )
        })
    }

    /// Numbers of several columns of every row, in SI, with the texts of others.
    fn each(
        &self,
        texts: &[Option<usize>],
        numbers: &[(usize, Size)],
        mut take: impl FnMut(Vec<&str>, Vec<f64>),
    ) -> Result<(), InputError> {
        let mut factors = Vec::with_capacity(numbers.len());
        for (column, size) in numbers {
            factors.push(self.factor(*column, *size)?);
        }
        for (at, row) in &self.table.rows {
            let texts = texts
                .iter()
                .map(|column| Table::text(row, *column))
                .collect();
            let mut values = Vec::with_capacity(numbers.len());
            for ((column, _), factor) in numbers.iter().zip(&factors) {
                values.push(self.number(*at, row, *column)? * factor);
            }
            take(texts, values);
        }
        Ok(())
    }
}

const STORY: &[&str] = &["story", "name", "storyname"];
const CASE: &[&str] = &[
    "outputcase",
    "loadcasecombo",
    "loadcase",
    "case",
    "loadpattern",
];
const STEP: &[&str] = &["stepnumber", "stepnum", "mode"];
const UX: &[&str] = &["ux", "u1"];
const UY: &[&str] = &["uy", "u2"];
const RZ: &[&str] = &["rz", "r3"];

/// What a table is, by its title or else by its columns.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Stories,
    Base,
    MassByDiaphragm,
    MassByStory,
    Periods,
    Displacements,
    Stiffness,
    UserLoads,
    Joints,
}

fn kind(table: &Table) -> Option<Kind> {
    let has = |names: &[&str]| names.iter().all(|name| table.column(&[name]).is_some());
    let title = plain(&table.name);
    let found = if has(&["bsname", "bselev"]) {
        Kind::Base
    } else if has(&["height"])
        && (title.contains("storydefinitions")
            || title.contains("storydata")
            || has(&["similarto"]))
    {
        Kind::Stories
    } else if has(&["xcr"]) || has(&["cummassx"]) {
        // Centers Of Mass And Rigidity repeats masses without inertia.
        return None;
    } else if has(&["story", "massx", "massy"]) {
        Kind::MassByDiaphragm
    } else if title == "masssummarybystory"
        || (has(&["story", "ux", "uy", "uz"])
            && table.column(CASE).is_none()
            && table.column(&["rx"]).is_none())
    {
        Kind::MassByStory
    } else if has(&["mode", "period"]) {
        Kind::Periods
    } else if has(&["story", "diaphragm"])
        && table.column(UX).is_some()
        && table.column(RZ).is_some()
        && table.column(CASE).is_some()
    {
        Kind::Displacements
    } else if has(&["story", "stiffx", "stiffy"]) {
        Kind::Stiffness
    } else if has(&["story", "fx", "fy", "mz"])
        && table.column(&["loadpattern", "name"]).is_some()
        && table.column(&["outputcase"]).is_none()
    {
        Kind::UserLoads
    } else if has(&["story"])
        && table.column(&["globalx", "x"]).is_some()
        && table.column(&["globaly", "y"]).is_some()
        && table.column(&["globalz", "z"]).is_some()
    {
        Kind::Joints
    } else {
        return None;
    };
    Some(found)
}

/// Adds what a table says. Returns whether it is of use.
pub(crate) fn gather(
    file: &str,
    table: &Table,
    units: Option<Units>,
    diaphragm: Option<&str>,
    facts: &mut Facts,
) -> Result<bool, InputError> {
    facts.tables.push(table.name.clone());
    let Some(kind) = kind(table) else {
        return Ok(false);
    };
    let reading = Reading { file, table, units };
    let wanted = |found: &str| diaphragm.is_none_or(|diaphragm| key(diaphragm) == key(found));
    let story = table.column(STORY);
    match kind {
        Kind::Stories => stories(&reading, facts)?,
        Kind::Base => {
            let texts = [table.column(&["bsname"])];
            let numbers = [(reading.needed(&["bselev"])?, LENGTH)];
            let mut shift = None;
            reading.each(&texts, &numbers, |texts, values| {
                shift = Some((texts[0].to_owned(), values[0]));
            })?;
            if let Some((name, height)) = shift {
                // Storeys were summed from the base known so far.
                let old = facts.base_height();
                facts
                    .stories
                    .iter_mut()
                    .for_each(|story| story.top += height - old);
                facts.base = Some((name, height));
            }
        }
        Kind::MassByDiaphragm => {
            let of = table.column(&["diaphragm"]);
            let inertia = table.column(&["massmomentofinertia", "massmi", "mmi", "inertia"]);
            let centre =
                [["xmasscenter", "xcm"], ["ymasscenter", "ycm"]].map(|names| table.column(&names));
            let mut numbers = vec![
                (reading.needed(&["massx"])?, MASS),
                (reading.needed(&["massy"])?, MASS),
            ];
            if let Some(column) = inertia {
                numbers.push((column, INERTIA));
            }
            if let [Some(x), Some(y)] = centre {
                numbers.extend([(x, LENGTH), (y, LENGTH)]);
            }
            facts.masses.retain(|mass| !mass.diaphragm.is_empty());
            reading.each(&[story, of], &numbers, |texts, values| {
                if wanted(texts[1]) {
                    let last = values.len();
                    facts.masses.push(FloorMass {
                        story: Ok(texts[0].to_owned()),
                        diaphragm: texts[1].to_owned(),
                        mass: [values[0], values[1]],
                        inertia: inertia.map(|_| values[2]),
                        centre: centre[0]
                            .and(centre[1])
                            .map(|_| [values[last - 2], values[last - 1]]),
                    });
                }
            })?;
        }
        Kind::MassByStory => {
            // By diaphragm is better: it has inertia and centres.
            let numbers = [(reading.needed(UX)?, MASS), (reading.needed(UY)?, MASS)];
            let mut found = Vec::new();
            reading.each(&[story], &numbers, |texts, values| {
                found.push(FloorMass {
                    story: Ok(texts[0].to_owned()),
                    diaphragm: String::new(),
                    mass: [values[0], values[1]],
                    inertia: None,
                    centre: None,
                });
            })?;
            if facts.masses.is_empty() {
                facts.masses = found;
            }
        }
        Kind::Periods => {
            let shares = [UX, UY].map(|names| table.column(names));
            let mut numbers = vec![
                (reading.needed(&["mode"])?, NUMBER),
                (reading.needed(&["period"])?, TIME),
            ];
            numbers.extend(shares.iter().flatten().map(|column| (*column, NUMBER)));
            let mut found = Vec::new();
            reading.each(&[table.column(CASE)], &numbers, |texts, values| {
                found.push(ModePeriod {
                    case: texts[0].to_owned(),
                    mode: values[0] as usize,
                    period: values[1],
                    shares: (values.len() == 4).then(|| [values[2], values[3]]),
                });
            })?;
            // Those with mass ratios say more.
            if facts.periods.is_empty()
                || facts.periods.iter().all(|period| period.shares.is_none())
            {
                let shares = found.iter().any(|period| period.shares.is_some());
                if facts.periods.is_empty() || shares {
                    facts.periods = found;
                    facts.periods_from = format!("{file}, {}", table.name);
                }
            }
        }
        Kind::Displacements => displacements(&reading, facts, wanted)?,
        Kind::Stiffness => {
            let numbers = [
                (reading.needed(&["stiffx"])?, STIFFNESS),
                (reading.needed(&["stiffy"])?, STIFFNESS),
            ];
            reading.each(&[story, table.column(CASE)], &numbers, |texts, values| {
                facts.stiffness.push(StoryStiffness {
                    story: texts[0].to_owned(),
                    case: texts[1].to_owned(),
                    stiffness: [values[0], values[1]],
                });
            })?;
        }
        Kind::UserLoads => {
            let numbers = [("fx", FORCE), ("fy", FORCE), ("mz", MOMENT)];
            let columns = [
                reading.needed(&["fx"])?,
                reading.needed(&["fy"])?,
                reading.needed(&["mz"])?,
            ];
            let numbers: Vec<_> = columns
                .into_iter()
                .zip(numbers.map(|number| number.1))
                .collect();
            reading.each(
                &[table.column(&["loadpattern", "name"]), story],
                &numbers,
                |texts, values| {
                    for (component, size) in
                        values.iter().enumerate().filter(|(_, size)| **size != 0.0)
                    {
                        facts.unit_loads.push(UnitLoad {
                            case: texts[0].to_owned(),
                            story: texts[1].to_owned(),
                            component,
                            size: *size,
                        });
                    }
                },
            )?;
        }
        Kind::Joints => {
            let columns = [["globalx", "x"], ["globaly", "y"], ["globalz", "z"]];
            let mut numbers = Vec::new();
            for names in columns {
                numbers.push((reading.needed(&names)?, LENGTH));
            }
            reading.each(&[story], &numbers, |texts, values| {
                let [x, y, z] = values[..] else { return };
                facts.points.entry(key(texts[0])).or_default().push([x, y]);
                let name = || (texts[0].to_owned(), z);
                let joint_heights = facts
                    .joint_heights
                    .entry(key(texts[0]))
                    .or_insert_with(name);
                joint_heights.1 = joint_heights.1.max(z);
            })?;
        }
    }
    let rows = table.rows.len();
    facts
        .read
        .push(format!("{file}: {}, {rows} rows", table.name));
    Ok(true)
}

/// Storeys of a table from the top down, or in the order of its elevations.
fn stories(reading: &Reading<'_>, facts: &mut Facts) -> Result<(), InputError> {
    let table = reading.table;
    let tower = table.column(&["tower"]);
    let mut numbers = vec![(reading.needed(&["height"])?, LENGTH)];
    let elevation = table.column(&["elevation", "elev"]);
    numbers.extend(elevation.map(|column| (column, LENGTH)));
    let mut rows: Vec<(String, f64, Option<f64>)> = Vec::new();
    let mut towers: Vec<String> = Vec::new();
    let name = table.column(&["name", "story", "storyname"]);
    reading.each(&[name, tower], &numbers, |texts, values| {
        rows.push((texts[0].to_owned(), values[0], values.get(1).copied()));
        if !towers.iter().any(|tower| tower == texts[1]) {
            towers.push(texts[1].to_owned());
        }
    })?;
    rows.sort_by(|a, b| match (a.2, b.2) {
        (Some(a), Some(b)) => b.total_cmp(&a),
        _ => std::cmp::Ordering::Equal,
    });
    for pair in rows.windows(2) {
        if let (Some(upper), Some(lower)) = (pair[0].2, pair[1].2)
            && (upper - lower - pair[0].1).abs() > 0.01
        {
            return Err(fault(
                reading.file,
                format!("table {}, storey \"{}\"", table.name, pair[0].0),
                format!(
                    "has a height of {:.3} m, but stands {:.3} m above the storey below by its elevation",
                    pair[0].1,
                    upper - lower
                ),
                "export the table again",
            ));
        }
    }
    let mut found: Vec<(String, f64)> = rows.into_iter().map(|row| (row.0, row.1)).collect();
    if towers.len() > 1 {
        return Err(fault(
            reading.file,
            format!("table {}", table.name),
            format!("has several towers: {}", towers.join(", ")),
            "export each tower as a workbook of its own and give them to jostle import one beside the other, with --gap",
        ));
    }
    if let Some((name, _)) = found.iter().find(|(_, height)| *height < 0.0) {
        return Err(fault(
            reading.file,
            format!("table {}, storey \"{name}\"", table.name),
            "has a negative height",
            "check the storeys in ETABS",
        ));
    }
    let mut z = facts.base_height();
    // Older versions list the base with height zero.
    if found.last().is_some_and(|last| last.1 == 0.0)
        && let Some((name, _)) = found.pop()
    {
        facts.base = Some((name, z));
    }
    facts.stories = found
        .into_iter()
        .rev()
        .map(|(name, height)| {
            z += height;
            Story { name, top: z }
        })
        .collect();
    Ok(())
}

fn displacements(
    reading: &Reading<'_>,
    facts: &mut Facts,
    wanted: impl Fn(&str) -> bool,
) -> Result<(), InputError> {
    let table = reading.table;
    let columns = [
        table.column(&["story"]),
        table.column(&["diaphragm"]),
        table.column(CASE),
        table.column(&["steptype"]),
        table.column(STEP),
    ];
    let mut numbers = Vec::new();
    for (names, size) in [(UX, LENGTH), (UY, LENGTH), (RZ, NUMBER)] {
        numbers.push((reading.needed(names)?, size));
    }
    let mut factors = Vec::new();
    for (column, size) in &numbers {
        factors.push(reading.factor(*column, *size)?);
    }
    for (at, row) in &table.rows {
        let [story, diaphragm, case, step_type, step] =
            columns.map(|column| Table::text(row, column));
        // Envelopes are no displacements of one moment.
        if !wanted(diaphragm) || ["max", "min"].contains(&key(step_type).as_str()) {
            continue;
        }
        let mut by = [0.0; 3];
        for ((value, (column, _)), factor) in by.iter_mut().zip(&numbers).zip(&factors) {
            *value = reading.number(*at, row, *column)? * factor;
        }
        let step = number(step)
            .filter(|step| *step >= 1.0)
            .map(|step| step as usize);
        facts.displacements.push(Displacement {
            story: story.to_owned(),
            diaphragm: diaphragm.to_owned(),
            case: case.to_owned(),
            step,
            by,
        });
    }
    Ok(())
}
