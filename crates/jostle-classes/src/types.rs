//! Tables of structural types: capacity, storeys, damage drifts and hysteresis, ours or a user's.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use jostle_io::{TypesTables, nearest_name, read_text_file};

use crate::class::Class;
use crate::gem::gem_family;
use crate::level::Level;
use crate::mdof_lu::Capacity;

/// 36 types of HAZUS at 4 levels, with their sources.
const HAZUS: &str = include_str!("../data/hazus.csv");
/// Most bytes of a table.
const MOST_BYTES: usize = 1 << 24;
/// Most storeys of a building.
const MOST_STOREYS: usize = 16;

/// Units of lengths in names of columns, such as `dy_in`, and their metres.
const LENGTHS: [(&str, f64); 5] = [
    ("m", 1.0),
    ("cm", 0.01),
    ("mm", 0.001),
    ("in", 0.0254),
    ("ft", 0.3048),
];
/// Columns of a table of types that need no unit; those after the first seven may be left out.
const TYPE_COLUMNS: [&str; 16] = [
    "type",
    "ay_g",
    "au_g",
    "storeys_typical",
    "slight",
    "moderate",
    "extensive",
    "complete",
    "level",
    "storeys_least",
    "storeys_most",
    "pinching",
    "unloading_exponent",
    "damping",
    "mass_kg_m2",
    "remark",
];
/// Columns of a table of damage drifts; those after the first five may be left out.
const DAMAGE_COLUMNS: [&str; 9] = [
    "type",
    "slight",
    "moderate",
    "extensive",
    "complete",
    "level",
    "storeys_least",
    "storeys_most",
    "remark",
];
/// Lengths of a table of types, whose columns end in a unit.
const TYPE_LENGTHS: [&str; 3] = ["dy", "du", "storey_height"];
/// Damage states, from the least.
const STATES: [&str; 4] = ["slight", "moderate", "extensive", "complete"];

/// Structural types that buildings may have.
#[derive(Clone, Debug, PartialEq)]
pub struct Types {
    classes: Vec<Class>,
    damage: Vec<Damage>,
    /// Name of the table; `None` for that of HAZUS.
    name: Option<String>,
    damage_name: Option<String>,
}

/// Drifts at which damage begins, of a type in a table of its own.
#[derive(Clone, Debug, PartialEq)]
struct Damage {
    kind: String,
    level: Level,
    storeys: RangeInclusive<usize>,
    drifts: [f64; 4],
}

impl Default for Types {
    fn default() -> Self {
        Self::hazus()
    }
}

impl Types {
    /// The 36 types of HAZUS at 4 levels.
    #[must_use]
    pub fn hazus() -> Self {
        Self::of_hazus(TypesTables::default().area_mass)
    }

    fn of_hazus(mass: f64) -> Self {
        let read = Self::of_text("the table of HAZUS", HAZUS, mass);
        debug_assert!(read.is_ok(), "{:?}", read.err());
        Self {
            classes: read.unwrap_or_default(),
            damage: Vec::new(),
            name: None,
            damage_name: None,
        }
    }

    /// The table of HAZUS as text, with its sources: a start for a table of one's own.
    #[must_use]
    pub const fn text() -> &'static str {
        HAZUS
    }

    /// The types of a table, or those of HAZUS without one; their damage drifts from a second table, where there is
    /// one.
    ///
    /// A table of types is a CSV with the columns of [`Self::text`]; lines that begin with `#` are remarks. Lengths name
    /// their unit: `dy_mm`, `du_in`, `storey_height_ft`. A table of damage has `type`, the four states and, if need be,
    /// `level`, `storeys_least` and `storeys_most`. A row without a level holds for every level.
    ///
    /// # Errors
    ///
    /// All faults of both tables, one a line, with file, line and column.
    pub fn read(tables: &TypesTables) -> Result<Self, String> {
        let mut faults = Vec::new();
        let mut hazus = Self::of_hazus(tables.area_mass);
        if let Some(path) = &tables.types {
            match text_of(path)
                .and_then(|text| Self::of_text(&name_of(path), &text, tables.area_mass))
            {
                Ok(classes) => hazus.classes = classes,
                Err(problem) => faults.push(problem),
            }
            hazus.name = Some(name_of(path));
        }
        if let Some(path) = &tables.damage {
            match text_of(path).and_then(|text| damage_of(&name_of(path), &text)) {
                Ok(damage) => hazus.damage = damage,
                Err(problem) => faults.push(problem),
            }
            hazus.damage_name = Some(name_of(path));
        }
        if faults.is_empty() {
            Ok(hazus)
        } else {
            Err(faults.join("\n"))
        }
    }

    /// Every class of the table, in its order; a row without a level is there once for each.
    pub fn classes(&self) -> impl Iterator<Item = &Class> {
        self.classes.iter()
    }

    /// Everything in it that decides a number, whatever the names of its files.
    #[must_use]
    pub fn content(&self) -> String {
        format!("{:?}{:?}", self.classes, self.damage)
    }

    /// Where capacities come from, and where damage drifts come from, in words.
    #[must_use]
    pub fn sources(&self) -> [&str; 2] {
        let types = self.name.as_deref().unwrap_or("HAZUS");
        [types, self.damage_name.as_deref().unwrap_or(types)]
    }

    /// A class by what an inventory says: a type of the table with its height or without (`C1M`, `C1`), or a taxonomy
    /// string of GEM (`CR/LFINF+CDN/HEX:3`) that leads to one, and the storeys.
    ///
    /// Of several rows that fit, it is the one whose storeys fit or are nearest.
    ///
    /// # Errors
    ///
    /// When there is no such type, or none at the level; the text says what there is.
    pub fn of(&self, kind: &str, storeys: usize, level: Level) -> Result<Class, String> {
        let kind = kind.trim();
        let mut found = self.rows_named(kind);
        if found.is_empty() {
            found = match gem_family(kind) {
                Ok(family) => self.rows_named(family),
                // A string of GEM says itself what is wrong with it.
                Err(problem) if kind.contains(['/', '+']) && self.name.is_none() => {
                    return Err(problem);
                }
                Err(_) => Vec::new(),
            };
        }
        if found.is_empty() {
            return Err(self.unknown(kind));
        }
        let away = |class: &&&Class| {
            let (least, most) = (*class.storeys.start(), *class.storeys.end());
            least.saturating_sub(storeys) + storeys.saturating_sub(most)
        };
        let at_level = found.iter().filter(|named| named.level == level);
        let Some(class) = at_level.min_by_key(away) else {
            let levels: BTreeSet<Level> = found.iter().map(|named| named.level).collect();
            let levels: Vec<&str> = levels.into_iter().map(Level::name).collect();
            return Err(format!(
                "\"{kind}\" has no row for the design level {} in {}, only for {}",
                level.name(),
                self.sources()[0],
                levels.join(", ")
            ));
        };
        let mut class = Class::clone(class);
        if let Some(name) = &self.damage_name {
            class.drifts = self.damage_drifts(&class, storeys).ok_or_else(|| {
                format!(
                    "{name} has no row for the type {} at the design level {}",
                    class.name,
                    level.name()
                )
            })?;
        }
        Ok(class)
    }

    /// Rows of a type by its name, or by its name without the L, M or H of its height.
    fn rows_named(&self, kind: &str) -> Vec<&Class> {
        let named = |class: &&Class| class.name.eq_ignore_ascii_case(kind);
        let found: Vec<&Class> = self.classes.iter().filter(named).collect();
        if !found.is_empty() {
            return found;
        }
        let of_family = |class: &&Class| family(&class.name).eq_ignore_ascii_case(kind);
        self.classes.iter().filter(of_family).collect()
    }

    fn damage_drifts(&self, class: &Class, storeys: usize) -> Option<[f64; 4]> {
        let of = |kind: &str| {
            let rows = self.damage.iter().filter(|damage| {
                damage.level == class.level
                    && damage.kind.eq_ignore_ascii_case(kind)
                    && damage.storeys.contains(&storeys.min(MOST_STOREYS))
            });
            rows.map(|row| row.drifts).next()
        };
        of(&class.name).or_else(|| of(family(&class.name)))
    }

    fn unknown(&self, kind: &str) -> String {
        let Some(table) = &self.name else {
            return format!(
                "\"{kind}\" is neither a type of HAZUS (W1, W2, S1–S5, C1–C3, PC1, PC2, RM1, RM2, URM, MH, with \
                 L, M or H or without) nor a taxonomy string of GEM such as CR/LFM"
            );
        };
        let names: BTreeSet<&str> = self.classes.iter().map(|class| &*class.name).collect();
        let names: Vec<&str> = names.into_iter().collect();
        format!(
            "\"{kind}\" is no type of {table}, which has {}",
            names.join(", ")
        )
    }

    fn of_text(name: &str, text: &str, mass: f64) -> Result<Vec<Class>, String> {
        let mut table = Table::read(name, text, &TYPE_COLUMNS, 8, &TYPE_LENGTHS)?;
        let mut classes: Vec<Class> = Vec::new();
        for row in std::mem::take(&mut table.rows) {
            let class = class_of(&mut table, &row, mass);
            for (class, level) in class.into_iter().flat_map(|(class, levels)| {
                levels.into_iter().map(move |level| (class.clone(), level))
            }) {
                if !table.is_first(&row, &class.name, level, &class.storeys) {
                    break;
                }
                classes.push(Class { level, ..class });
            }
        }
        table.end(classes)
    }
}

/// The name of a type without the L, M or H of its height.
fn family(name: &str) -> &str {
    name.strip_suffix(['L', 'M', 'H'])
        .filter(|strip_suffix| !strip_suffix.is_empty())
        .unwrap_or(name)
}

fn name_of(path: &Path) -> String {
    path.display().to_string()
}

fn text_of(path: &Path) -> Result<String, String> {
    read_text_file(path, MOST_BYTES).map_err(|error| format!("{}: {error}", path.display()))
}

/// A class and the levels that its row holds for.
fn class_of(table: &mut Table, row: &StringRecord, mass: f64) -> Option<(Class, Vec<Level>)> {
    let kind = table.kind(row);
    let levels = table.levels(row);
    let storeys = table.storeys(row);
    let dy = table.length(row, "dy", 1e-5..=2.0);
    let du = table.length(row, "du", 1e-5..=20.0);
    let ay = table.number(row, "ay_g", None, 1e-3..=10.0);
    let au = table.number(row, "au_g", None, 1e-3..=10.0);
    let typical_storeys = table.number(row, "storeys_typical", None, 1.0..=200.0);
    let storey_height = table.length(row, "storey_height", 1.5..=20.0);
    let drifts = table.drifts(row);
    let pinching = table.number(row, "pinching", Some(1.0), 0.05..=1.0);
    let unloading_exponent = table.number(row, "unloading_exponent", Some(0.0), 0.0..=1.0);
    let damping = table.number(row, "damping", Some(0.05), 0.0..=0.5);
    let area_mass = table.number(row, "mass_kg_m2", Some(mass), 10.0..=1e5);
    let (dy, du, ay, au) = (dy?, du?, ay?, au?);
    if du <= dy {
        table.fault(
            row,
            "du",
            "must be greater than dy: the curve ends after its yield",
        );
        return None;
    }
    if au < ay || (au - ay) * dy > (du - dy) * ay {
        table.fault(
            row,
            "au_g",
            "must lie between ay and ay·du/dy: the curve rises after its yield, and less steeply than before",
        );
        return None;
    }
    let class = Class {
        name: kind?.into(),
        // Filled in by the levels.
        level: Level::Pre,
        capacity: Capacity {
            yield_displacement: dy,
            yield_acceleration: ay,
            ultimate_displacement: du,
            ultimate_acceleration: au,
        },
        storeys: storeys?,
        typical_storeys: typical_storeys?,
        storey_height: storey_height?,
        area_mass: area_mass?,
        drifts: drifts?,
        pinching: pinching?,
        unloading_exponent: unloading_exponent?,
        damping: damping?,
    };
    Some((class, levels?))
}

fn damage_of(name: &str, text: &str) -> Result<Vec<Damage>, String> {
    let mut table = Table::read(name, text, &DAMAGE_COLUMNS, 5, &[])?;
    let mut all: Vec<Damage> = Vec::new();
    for row in std::mem::take(&mut table.rows) {
        let (kind, levels) = (table.kind(&row), table.levels(&row));
        let (storeys, drifts) = (table.storeys(&row), table.drifts(&row));
        let (Some(kind), Some(levels), Some(storeys), Some(drifts)) =
            (kind, levels, storeys, drifts)
        else {
            continue;
        };
        for level in levels {
            if !table.is_first(&row, &kind, level, &storeys) {
                break;
            }
            all.push(Damage {
                kind: kind.clone(),
                level,
                storeys: storeys.clone(),
                drifts,
            });
        }
    }
    table.end(all)
}

/// Rows and columns of a CSV, and the faults found in them.
struct Table {
    name: String,
    /// Names of the columns, lengths without their unit.
    columns: Vec<String>,
    /// Names as they stand in the file.
    stated: Vec<String>,
    /// Metres of the unit of each column.
    units: Vec<f64>,
    rows: Vec<StringRecord>,
    /// Types, levels and storeys of the rows so far.
    known: Vec<(String, Level, RangeInclusive<usize>)>,
    faults: Vec<String>,
}

impl Table {
    /// Reads a table whose columns are `known`, the first `needed` of them needed, and `lengths` with their units.
    fn read(
        name: &str,
        text: &str,
        known: &[&str],
        needed: usize,
        lengths: &[&str],
    ) -> Result<Self, String> {
        let mut reader = ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(Trim::All)
            .flexible(true)
            .from_reader(text.as_bytes());
        let fault = |error: csv::Error| format!("{name}: {error}");
        let header = reader.headers().map_err(fault)?.clone();
        let mut faults = Vec::new();
        let (mut columns, mut units) = (Vec::<String>::new(), Vec::new());
        for stated in &header {
            let (column, unit) = column_of(stated, lengths);
            if !known.contains(&column.as_str()) && !lengths.contains(&column.as_str()) {
                let all = known.iter().chain(lengths).copied();
                let near = nearest_name(&column, all)
                    .map(|nearest_name| format!("; did you mean {nearest_name}?"));
                faults.push(format!(
                    "{name}: no column \"{stated}\" is known{}",
                    near.unwrap_or_default()
                ));
            } else if lengths.contains(&column.as_str()) && unit.is_none() {
                faults.push(format!(
                    "{name}: column \"{stated}\" is a length and names no unit: {column}_mm, {column}_cm, {column}_m, \
                     {column}_in or {column}_ft"
                ));
            } else if columns.contains(&column) {
                faults.push(format!("{name}: column \"{stated}\" is there twice"));
            }
            columns.push(column);
            units.push(unit.unwrap_or(1.0));
        }
        for column in known.iter().take(needed).chain(lengths) {
            if !columns.iter().any(|known| known == column) {
                let unit = if lengths.contains(column) { "_m" } else { "" };
                faults.push(format!("{name}: the column {column}{unit} is missing"));
            }
        }
        if !faults.is_empty() {
            return Err(faults.join("\n"));
        }
        let rows: Vec<StringRecord> = reader.records().collect::<Result<_, _>>().map_err(fault)?;
        for row in rows.iter().filter(|row| row.len() != columns.len()) {
            let line = row.position().map_or(0, csv::Position::line);
            faults.push(format!(
                "{name}, line {line}: {} cells below {} columns",
                row.len(),
                columns.len()
            ));
        }
        if !faults.is_empty() {
            return Err(faults.join("\n"));
        }
        if rows.is_empty() {
            return Err(format!(
                "{name}: there is no row below the names of the columns"
            ));
        }
        Ok(Self {
            name: name.to_owned(),
            columns,
            stated: header.iter().map(str::to_owned).collect(),
            units,
            rows,
            known: Vec::new(),
            faults: Vec::new(),
        })
    }

    fn end<T>(self, read: T) -> Result<T, String> {
        if self.faults.is_empty() {
            Ok(read)
        } else {
            Err(self.faults.join("\n"))
        }
    }

    fn fault(&mut self, row: &StringRecord, column: &str, problem: &str) {
        let line = row.position().map_or(0, csv::Position::line);
        let stated = self.at(column).map_or(column, |at| &self.stated[at]);
        self.faults
            .push(format!("{}, line {line}, {stated}: {problem}", self.name));
    }

    fn at(&self, column: &str) -> Option<usize> {
        self.columns
            .iter()
            .position(|candidate| candidate == column)
    }

    fn cell<'r>(&self, row: &'r StringRecord, column: &str) -> Option<&'r str> {
        let cell = row.get(self.at(column)?)?;
        Some(cell).filter(|cell| !cell.is_empty())
    }

    /// A number of a row within its range, or the usual one where the cell is empty.
    fn number(
        &mut self,
        row: &StringRecord,
        column: &str,
        usual: Option<f64>,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        let Some(cell) = self.cell(row, column) else {
            if usual.is_none() {
                self.fault(row, column, "the cell is empty");
            }
            return usual;
        };
        let Ok(value) = cell.parse::<f64>() else {
            self.fault(row, column, &format!("expected a number, found \"{cell}\""));
            return None;
        };
        if range.contains(&value) {
            return Some(value);
        }
        let problem = format!(
            "must lie between {} and {}, found {value}",
            range.start(),
            range.end()
        );
        self.fault(row, column, &problem);
        None
    }

    /// A length in metres; its range is in metres too.
    fn length(
        &mut self,
        row: &StringRecord,
        column: &str,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        let unit = self.at(column).map_or(1.0, |at| self.units[at]);
        let stated = range.start() / unit..=range.end() / unit;
        Some(self.number(row, column, None, stated)? * unit)
    }

    /// Whether no row above is for the same type, level and storeys; a fault otherwise.
    fn is_first(
        &mut self,
        row: &StringRecord,
        kind: &str,
        level: Level,
        storeys: &RangeInclusive<usize>,
    ) -> bool {
        let same = |(other, at, range): &(String, Level, RangeInclusive<usize>)| {
            other.eq_ignore_ascii_case(kind)
                && *at == level
                && range.start() <= storeys.end()
                && storeys.start() <= range.end()
        };
        if self.known.iter().any(same) {
            let problem = format!(
                "a row above is for the same type, design level ({}) and storeys",
                level.name()
            );
            self.fault(row, "type", &problem);
            return false;
        }
        self.known.push((kind.to_owned(), level, storeys.clone()));
        true
    }

    fn kind(&mut self, row: &StringRecord) -> Option<String> {
        let kind = self.cell(row, "type").map(str::to_owned);
        if kind.is_none() {
            self.fault(row, "type", "the cell is empty");
        }
        kind
    }

    /// The level of a row, or all of them.
    fn levels(&mut self, row: &StringRecord) -> Option<Vec<Level>> {
        let Some(cell) = self.cell(row, "level") else {
            return Some(Level::ALL.to_vec());
        };
        match cell.parse() {
            Ok(level) => Some(vec![level]),
            Err(problem) => {
                self.fault(row, "level", &problem);
                None
            }
        }
    }

    fn storeys(&mut self, row: &StringRecord) -> Option<RangeInclusive<usize>> {
        let [least, most] = [("storeys_least", 1), ("storeys_most", MOST_STOREYS)];
        let [least, most] = [least, most].map(|(column, usual)| {
            let value = self.number(row, column, Some(usual as f64), 1.0..=200.0)?;
            if value.fract() == 0.0 {
                return Some(value as usize);
            }
            self.fault(row, column, "must be a whole number");
            None
        });
        let (least, most) = (least?, most?);
        if least <= most {
            return Some(least..=most);
        }
        self.fault(row, "storeys_most", "must not be less than storeys_least");
        None
    }

    fn drifts(&mut self, row: &StringRecord) -> Option<[f64; 4]> {
        let found = STATES.map(|state| self.number(row, state, None, 1e-5..=1.0));
        let [Some(a), Some(b), Some(c), Some(d)] = found else {
            return None;
        };
        let drifts = [a, b, c, d];
        for (at, pair) in drifts.windows(2).enumerate() {
            if pair[0] >= pair[1] {
                let problem = format!(
                    "must be greater than that of {}: drift ratios rise with damage",
                    STATES[at]
                );
                self.fault(row, STATES[at + 1], &problem);
                return None;
            }
        }
        Some(drifts)
    }
}

/// A column by its name, and the metres of its unit if it is a length.
fn column_of(stated: &str, lengths: &[&str]) -> (String, Option<f64>) {
    let plain = stated.trim_start_matches('\u{feff}').to_lowercase();
    for length in lengths {
        let unit = plain
            .strip_prefix(length)
            .and_then(|rest| rest.strip_prefix('_'));
        let metres = LENGTHS.iter().find(|(name, _)| Some(*name) == unit);
        if let Some((_, metres)) = metres {
            return ((*length).to_owned(), Some(*metres));
        }
    }
    (plain, None)
}
