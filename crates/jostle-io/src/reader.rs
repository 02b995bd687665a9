//! Typed access to the value tree. A fault is noted and reading goes on, so that all faults are found at once.

use std::path::Path;

use crate::fault::{Fault, InputError};
use crate::grade::{ConcreteGrade, cylinder_strength};
use crate::json_remedies::in_json;
use crate::keys::{Section, keys_of, range_of};
use crate::nearest::nearest;
use crate::quantity::{Dimension, check_magnitude, parse_quantity, shorten, show_number};
use crate::source::{Source, Span};
use crate::tree::{Format, Node, Table, Value};
use crate::unusual::{Accepted, Range, Verdict, Written};
use jostle::linear::sort_by_key;

/// Faults of a file that are kept; beyond that, they are counted.
const MOST_FAULTS: usize = 500;
/// No concrete and no steel is weaker \[Pa\].
const LEAST_STRENGTH: f64 = 1e5;

/// Collects the faults of one file.
pub(crate) struct Reader<'s> {
    source: &'s Source,
    faults: Vec<(usize, Fault)>,
    /// Faults beyond [`MOST_FAULTS`].
    more: usize,
    /// Takes the remedies of those.
    dropped: Option<String>,
    /// Warnings about valid but unusual values, with their positions.
    warnings: Vec<(usize, String)>,
    /// Unusual values that are accepted.
    pub(crate) accepted: Accepted,
    /// Keys that were read, to compare the reader with the table of keys.
    #[cfg(test)]
    pub(crate) asked: std::collections::BTreeSet<(Section, &'static str)>,
}

/// A table of the file whose keys have been checked.
#[derive(Clone)]
pub(crate) struct View<'n> {
    table: &'n Table,
    sections: &'static [Section],
    pub(crate) span: Span,
    pub(crate) path: String,
}

/// A value of the file.
#[derive(Clone)]
pub(crate) struct Field<'n> {
    pub(crate) node: &'n Node,
    pub(crate) path: String,
    /// Usual range of this field.
    range: Option<&'static Range>,
}

/// Strength of a material, by name or in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Grade {
    Named(&'static str),
    /// \[Pa\]
    Strength(f64),
}

impl<'n> Field<'n> {
    /// The whole file.
    pub(crate) fn root(node: &'n Node) -> Self {
        Self {
            node,
            path: String::new(),
            range: None,
        }
    }

    /// An entry of the list that this field is.
    pub(crate) fn entry(&self, index: usize, node: &'n Node) -> Field<'n> {
        Field {
            node,
            path: format!("{}[{index}]", self.path),
            range: self.range,
        }
    }

    /// The same place of the file with another value.
    pub(crate) fn holding<'m>(&self, node: &'m Node) -> Field<'m> {
        Field {
            node,
            path: self.path.clone(),
            range: self.range,
        }
    }

    /// The entries of a list; `None` for any other value.
    pub(crate) fn entries(&self) -> Option<Vec<Field<'n>>> {
        match &self.node.value {
            Value::List(list) => Some(
                list.iter()
                    .enumerate()
                    .map(|(i, node)| self.entry(i, node))
                    .collect(),
            ),
            _ => None,
        }
    }

    /// The entries of a table whose keys are names; `None` for any other value.
    pub(crate) fn named_entries(&self) -> Option<Vec<(&'n str, Field<'n>)>> {
        let Value::Table(table) = &self.node.value else {
            return None;
        };
        let entries = table.entries.iter().map(|entry| {
            let field = Field {
                node: &entry.node,
                path: join(&self.path, &shorten(&entry.key)),
                range: None,
            };
            (&*entry.key, field)
        });
        Some(entries.collect())
    }

    pub(crate) fn as_text(&self) -> Option<&'n str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }
}

impl View<'_> {
    /// The sections whose keys it may have.
    pub(crate) fn sections(&self) -> &'static [Section] {
        self.sections
    }

    /// Whether the table has this key.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.get(key).is_some()
    }
}

impl<'s> Reader<'s> {
    pub(crate) fn new(source: &'s Source) -> Self {
        Self {
            source,
            faults: Vec::new(),
            more: 0,
            dropped: None,
            warnings: Vec::new(),
            accepted: Accepted::default(),
            #[cfg(test)]
            asked: std::collections::BTreeSet::new(),
        }
    }

    /// Notes a fault; a remedy can be added to what is returned.
    pub(crate) fn fault(
        &mut self,
        span: &Span,
        path: impl Into<String>,
        problem: impl Into<String>,
    ) -> &mut Option<String> {
        if self.faults.len() == MOST_FAULTS {
            self.more += 1;
            return &mut self.dropped;
        }
        let fault = Fault {
            path: path.into(),
            place: Some(self.source.place(span)),
            problem: problem.into(),
            remedy: None,
        };
        self.faults.push((span.start, fault));
        let last = self.faults.len() - 1;
        &mut self.faults[last].1.remedy
    }

    /// Notes a fault of a value.
    pub(crate) fn bad(
        &mut self,
        field: &Field<'_>,
        problem: impl Into<String>,
    ) -> &mut Option<String> {
        self.fault(&field.node.span.clone(), field.path.clone(), problem)
    }

    /// Notes a key that is absent; shown at the table that lacks it.
    pub(crate) fn missing(&mut self, view: &View<'_>, key: &str, remedy: impl Into<String>) {
        let path = join(&view.path, key);
        *self.fault(&view.span.clone(), path, "is missing") = Some(remedy.into());
    }

    /// The line on which a span begins, from 1.
    pub(crate) fn line(&self, span: &Span) -> usize {
        self.source.place(span).line
    }

    /// All that was noted, in the order of the file.
    pub(crate) fn into_error(mut self) -> InputError {
        sort_by_key(&mut self.faults, |(start, _)| *start);
        let mut faults: Vec<Fault> = self.faults.into_iter().map(|(_, fault)| fault).collect();
        if Format::of_path(Path::new(&self.source.name)) == Format::Json {
            for remedy in faults.iter_mut().filter_map(|fault| fault.remedy.as_mut()) {
                *remedy = in_json(remedy);
            }
        }
        InputError {
            name: self.source.name.clone(),
            faults,
            more: self.more,
        }
    }

    /// How many faults were noted.
    pub(crate) fn count_faults(&self) -> usize {
        self.faults.len() + self.more
    }

    pub(crate) fn faults(&self) -> impl Iterator<Item = &Fault> {
        self.faults.iter().map(|(_, fault)| fault)
    }

    /// Takes a value as a table and checks the names of its keys.
    pub(crate) fn open<'n>(
        &mut self,
        field: &Field<'n>,
        sections: &'static [Section],
    ) -> Option<View<'n>> {
        let Value::Table(table) = &field.node.value else {
            let example = keys_of(sections).next().map_or("", |key| key.name);
            let found = field.node.describe();
            self.bad(
                field,
                format!("expected a table such as {{ {example} = … }}, found {found}"),
            );
            return None;
        };
        for entry in &table.entries {
            if keys_of(sections).all(|key| key.name != entry.key) {
                let shown = shorten(&entry.key);
                let other = counted_otherwise(&entry.key, sections);
                let remedy = match other.or_else(|| of_building(&entry.key, sections, &field.path))
                {
                    Some(remedy) => remedy,
                    None => suggest(&entry.key, sections),
                };
                let path = join(&field.path, &shown);
                *self.fault(&entry.key_span, path, format!("unknown key \"{shown}\"")) =
                    Some(remedy);
            }
        }
        Some(View {
            table,
            sections,
            span: field.node.span.clone(),
            path: field.path.clone(),
        })
    }

    /// Takes a value as a table whose keys were checked before.
    pub(crate) fn reopen<'n>(
        &mut self,
        field: &Field<'n>,
        sections: &'static [Section],
    ) -> Option<View<'n>> {
        match &field.node.value {
            Value::Table(table) => Some(View {
                table,
                sections,
                span: field.node.span.clone(),
                path: field.path.clone(),
            }),
            _ => None,
        }
    }

    /// The value of a key, if present.
    pub(crate) fn get<'n>(&mut self, view: &View<'n>, key: &'static str) -> Option<Field<'n>> {
        #[cfg(test)]
        {
            let section = view
                .sections
                .iter()
                .find(|section| keys_of(&[**section]).any(|known| known.name == key));
            let section = section.unwrap_or_else(|| panic!("{key} is not in the table of keys"));
            self.asked.insert((*section, key));
        }
        view.table.get(key).map(|node| Field {
            node,
            path: join(&view.path, key),
            range: range_of(view.sections, key),
        })
    }

    /// Opens the table of a key, where it is present.
    pub(crate) fn table<'n>(
        &mut self,
        view: &View<'n>,
        key: &'static str,
        sections: &'static [Section],
    ) -> Option<View<'n>> {
        let field = self.get(view, key)?;
        self.open(&field, sections)
    }

    /// The quantity of a key, if it is given.
    pub(crate) fn quantity_at(
        &mut self,
        view: &View<'_>,
        key: &'static str,
        dimension: Dimension,
    ) -> Option<f64> {
        let field = self.get(view, key)?;
        self.quantity(&field, dimension)
    }

    /// The quantity of a key that is needed; without it the fault shows an example.
    pub(crate) fn needed_quantity(
        &mut self,
        view: &View<'_>,
        key: &'static str,
        dimension: Dimension,
        example: &str,
    ) -> Option<f64> {
        if !view.has(key) {
            self.missing(view, key, format!("add {key} = {example}"));
        }
        self.quantity_at(view, key, dimension)
    }

    /// A quantity: text with a unit, or a bare number in SI.
    pub(crate) fn quantity(&mut self, field: &Field<'_>, dimension: Dimension) -> Option<f64> {
        let parsed = match &field.node.value {
            Value::Text(text) => parse_quantity(text, dimension).map_err(|e| e.to_string()),
            Value::Integer(value) => {
                check_magnitude(*value as f64, dimension).map_err(|e| e.to_string())
            }
            Value::Number(value) => check_magnitude(*value, dimension).map_err(|e| e.to_string()),
            _ => Err(format!(
                "expected {dimension} (such as {}), found {}",
                example(dimension),
                field.node.describe()
            )),
        };
        let value = parsed
            .map_err(|problem| {
                self.bad(field, problem);
            })
            .ok()?;
        self.judge(field, value, dimension).then_some(value)
    }

    /// Whether a value is possible; warns if it is unusual.
    pub(crate) fn judge(&mut self, field: &Field<'_>, value: f64, dimension: Dimension) -> bool {
        let Some(range) = field.range.filter(|_| !self.accepted.covers(&field.path)) else {
            return true;
        };
        match range.judge(value, dimension, Written::from_node(field.node, value)) {
            Verdict::Usual => true,
            Verdict::Unusual(text) => {
                self.warn(field, &text);
                true
            }
            Verdict::Refused(problem, remedy) => {
                *self.bad(field, problem) = Some(remedy);
                false
            }
        }
    }

    /// Adds a warning about a valid but unusual value.
    pub(crate) fn warn(&mut self, field: &Field<'_>, text: &str) {
        let warning = (field.node.span.start, format!("{}: {text}", field.path));
        let is_meant = self.accepted.covers(&field.path);
        if !is_meant && !self.warnings.contains(&warning) && self.warnings.len() < MOST_FAULTS {
            self.warnings.push(warning);
        }
    }

    /// All warnings, in the order of the file.
    pub(crate) fn take_warnings(&mut self) -> Vec<String> {
        let mut warnings = std::mem::take(&mut self.warnings);
        sort_by_key(&mut warnings, |(start, _)| *start);
        // One warning covers all entries of a list.
        let stem = |text: &str| {
            let field = text.split_once(": ").map_or("", |(field, _)| field);
            let list = field.strip_suffix(']').and_then(|f| f.rsplit_once('['));
            list.map(|(list, _)| list.to_owned())
        };
        let mut kept: Vec<(String, usize)> = Vec::new();
        for (_, text) in warnings {
            match kept.last_mut() {
                Some((last, more)) if stem(last).is_some() && stem(last) == stem(&text) => {
                    *more += 1;
                }
                _ => kept.push((text, 0)),
            }
        }
        kept.into_iter()
            .map(|(text, more)| match more {
                0 => text,
                1 => format!("{text} (and one more entry)"),
                _ => format!("{text} (and {more} more entries)"),
            })
            .collect()
    }

    /// A quantity greater than zero.
    pub(crate) fn positive(&mut self, field: &Field<'_>, dimension: Dimension) -> Option<f64> {
        let value = self.quantity(field, dimension)?;
        if value > 0.0 {
            return Some(value);
        }
        let found = field.node.describe();
        self.bad(field, format!("must be greater than zero, found {found}"));
        None
    }

    /// Reads without reporting faults, because they are reported elsewhere.
    pub(crate) fn quietly<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        let noted = (self.faults.len(), self.more);
        let value = read(self);
        self.faults.truncate(noted.0);
        self.more = noted.1;
        value
    }

    /// A whole number that is not negative.
    pub(crate) fn count(&mut self, field: &Field<'_>) -> Option<usize> {
        let whole = match field.node.value {
            Value::Integer(value) => usize::try_from(value).ok(),
            Value::Number(value) if value.fract() == 0.0 && (0.0..=1e9).contains(&value) => {
                Some(value as usize)
            }
            _ => None,
        };
        if whole.is_none() {
            let found = field.node.describe();
            self.bad(field, format!("expected a whole number, found {found}"));
        }
        whole
    }

    pub(crate) fn flag(&mut self, field: &Field<'_>) -> Option<bool> {
        if let Value::Flag(flag) = field.node.value {
            return Some(flag);
        }
        let found = field.node.describe();
        self.bad(field, format!("expected true or false, found {found}"));
        None
    }

    pub(crate) fn text(&mut self, field: &Field<'_>) -> Option<String> {
        if let Some(text) = field.as_text() {
            return Some(text.to_owned());
        }
        let found = field.node.describe();
        self.bad(field, format!("expected a text in quotes, found {found}"));
        None
    }

    /// A grade, or a strength greater than zero \[Pa\].
    pub(crate) fn grade(
        &mut self,
        field: &Field<'_>,
        grades: &[&'static str],
        example: &str,
    ) -> Option<Grade> {
        let looks_like_a_grade = field
            .as_text()
            .is_some_and(|text| text.starts_with(|first: char| first.is_ascii_alphabetic()));
        if !looks_like_a_grade {
            let strength = self.positive(field, Dimension::Stress)?;
            let bare = Written::from_node(field.node, strength).without_unit();
            if let Some(number) = bare.filter(|_| strength < LEAST_STRENGTH) {
                let number = show_number(number);
                *self.bad(field, format!("{number} has no unit")) =
                    Some(format!("write \"{number} MPa\""));
                return None;
            }
            return Some(Grade::Strength(strength));
        }
        let before = self.faults.len();
        let named = self.choice(field, grades, &[]).map(Grade::Named);
        if let Some((_, fault)) = self.faults.get_mut(before) {
            fault
                .remedy
                .get_or_insert_with(|| format!("a strength is possible too: {example}"));
        }
        named
    }

    /// Concrete: one of the grades, or the text f'c with a cylinder strength.
    pub(crate) fn concrete_name(
        &mut self,
        field: &Field<'_>,
        grades: &[&'static str],
    ) -> Option<ConcreteGrade> {
        match field.as_text().and_then(cylinder_strength) {
            Some(Ok(strength)) => Some(ConcreteGrade::Cylinder(strength)),
            Some(Err((problem, remedy))) => {
                *self.bad(field, problem) = Some(remedy);
                None
            }
            None => {
                let before = self.faults.len();
                let named = self.choice(field, grades, &[]);
                self.mention_cylinders(before, field);
                named.map(ConcreteGrade::Named)
            }
        }
    }

    /// Whether what stands at a path has a fault.
    pub(crate) fn is_faulty(&self, path: &str) -> bool {
        self.faults.iter().any(|(_, fault)| fault.path == path)
    }

    /// Says how a cylinder strength is written, at a fault that was noted since `before`.
    fn mention_cylinders(&mut self, before: usize, field: &Field<'_>) {
        let Some((_, fault)) = self.faults.get_mut(before) else {
            return;
        };
        let text = field.as_text().unwrap_or_default();
        let is_strength = parse_quantity(text, Dimension::Stress).is_ok();
        let example = match is_strength && text.ends_with(|end: char| end.is_alphabetic()) {
            true => format!("f'c = {}", text.trim()),
            false => "f'c = 4 ksi".to_owned(),
        };
        let cylinder = format!("a cylinder strength is written \"{example}\"");
        // Only names that begin like a grade are slips of one.
        let meant = fault.remedy.take().filter(|_| text.starts_with(['C', 'c']));
        fault.remedy = Some(match meant {
            Some(meant) => format!("{meant} Or {cylinder}"),
            None => cylinder,
        });
    }

    /// Concrete: as [`Self::concrete_name`], or a prismatic strength.
    pub(crate) fn concrete(
        &mut self,
        field: &Field<'_>,
        grades: &[&'static str],
    ) -> Option<ConcreteGrade> {
        if field.as_text().and_then(cylinder_strength).is_some() {
            return self.concrete_name(field, grades);
        }
        let before = self.faults.len();
        let read = self.grade(field, grades, "\"30 MPa\"");
        self.mention_cylinders(before, field);
        Some(match read? {
            Grade::Named(name) => ConcreteGrade::Named(name),
            Grade::Strength(strength) => ConcreteGrade::Prismatic(strength),
        })
    }

    /// One of several words; `later` are those of other versions of the format.
    pub(crate) fn choice(
        &mut self,
        field: &Field<'_>,
        known: &[&'static str],
        later: &[&'static str],
    ) -> Option<&'static str> {
        let available = known.join(", ");
        let Some(text) = field.as_text() else {
            let found = field.node.describe();
            self.bad(field, format!("expected one of {available}; found {found}"));
            return None;
        };
        if let Some(word) = known.iter().find(|word| **word == text) {
            return Some(word);
        }
        let shown = shorten(text);
        if later.contains(&text) {
            self.bad(
                field,
                format!("\"{shown}\" is not available in this version; available: {available}"),
            );
        } else {
            let remedy = nearest(text, known.iter().copied())
                .map(|word| format!("did you mean \"{word}\"?"));
            *self.bad(
                field,
                format!("\"{shown}\" is not known; available: {available}"),
            ) = remedy;
        }
        None
    }
}

/// Columns stand at lines and in storeys, beams in bays and on floors: the key of the other, where a table has it.
fn counted_otherwise(key: &str, sections: &'static [Section]) -> Option<String> {
    const PAIRS: [[&str; 2]; 4] = [
        ["storeys", "floors"],
        ["floors", "storeys"],
        ["line", "bay"],
        ["bay", "line"],
    ];
    let [_, other] = PAIRS.iter().find(|[name, _]| *name == key)?;
    let has_other = keys_of(sections).any(|known| known.name == *other);
    has_other.then(|| format!("write {other} instead of {key}"))
}

/// What to do with a key of a building in one of its tables, such as `[[building.infill]]`: below such a header, keys are those of the
/// table.
fn of_building(key: &str, sections: &'static [Section], path: &str) -> Option<String> {
    const KINDS: [Section; 5] = [
        Section::Building,
        Section::Frame,
        Section::Shear,
        Section::Given,
        Section::SpaceFrame,
    ];
    if sections.iter().any(|section| KINDS.contains(section)) {
        return None;
    }
    // The table itself, and no value within it.
    let (building, table) = path.split_once("].")?;
    let is_table = building.starts_with("building[") && !table.contains('.');
    let is_known = keys_of(&KINDS).any(|known| known.name == key);
    let name = table.split('[').next().unwrap_or(table);
    let header = match table.contains('[') {
        true => format!("[[building.{name}]]"),
        false => format!("[building.{name}]"),
    };
    (is_table && is_known).then(|| {
        format!("{key} belongs to the building: write it above the first {header}, or as [building.{key}] if it is a table")
    })
}

/// Suggestion for an unknown key.
fn suggest(key: &str, sections: &'static [Section]) -> String {
    let other_kinds = [
        (Section::Frame, "frame"),
        (Section::Shear, "shear"),
        (Section::Given, "given"),
        (Section::SpaceFrame, "space-frame"),
    ];
    // Frames have braces, infills and walls of their own.
    let frames = [Section::Frame, Section::SpaceFrame];
    let of_frames = frames.iter().any(|frame| sections.contains(frame)) && key != "strut";
    if sections.contains(&Section::Building) && NOT_MEMBERS.contains(&key) && !of_frames {
        return "what stands between two floors beside columns is a [[building.damper]], without dashpot too: floors = [1, 2] with the horizontal stiffness, and law = \"yielding\" with its strength".into();
    }
    if sections.contains(&Section::SpaceFrame) && key == "coupling_beam" {
        return "beams between the walls of a space frame are those of beam_x and beam_y: they span between faces, and can have a hinge".into();
    }
    let having = other_kinds
        .iter()
        .filter(|(section, _)| keys_of(&[*section]).any(|known| known.name == key));
    let having: Vec<String> = having.map(|(_, kind)| format!("\"{kind}\"")).collect();
    if sections.contains(&Section::Building) && !having.is_empty() {
        return format!(
            "this key belongs to buildings of kind = {}",
            having.join(" or ")
        );
    }
    if sections == [Section::Root] {
        let mut tables = TABLES_OF_ROOT.iter();
        if let Some((_, table)) =
            tables.find(|(section, _)| keys_of(&[*section]).any(|known| known.name == key))
        {
            return format!("{key} belongs under [{table}]");
        }
    }
    if sections == [Section::Beam] && key == "mass" {
        return "the mass on the beams is beam_mass of the building".into();
    }
    match nearest(key, keys_of(sections).map(|key| key.name)) {
        Some(name) => format!("did you mean \"{name}\"?"),
        None => {
            // Sections may share a key.
            let mut names: Vec<&str> = Vec::new();
            for key in keys_of(sections) {
                if !names.contains(&key.name) {
                    names.push(key.name);
                }
            }
            format!("known here: {}", names.join(", "))
        }
    }
}

/// Tables of which a file has one, the likeliest first.
const TABLES_OF_ROOT: [(Section, &str); 5] = [
    (Section::Output, "output"),
    (Section::Motion, "motion"),
    (Section::Analysis, "analysis"),
    (Section::Codes, "codes"),
    (Section::Report, "report"),
];

/// Words for what other programs join floors with.
const NOT_MEMBERS: [&str; 6] = ["brace", "braces", "infill", "infills", "wall", "strut"];

/// An example in the syntax of the file.
fn example(dimension: Dimension) -> String {
    if dimension == Dimension::Dimensionless {
        dimension.example().to_owned()
    } else {
        format!("\"{}\"", dimension.example())
    }
}

/// Path of a key below a table.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}
