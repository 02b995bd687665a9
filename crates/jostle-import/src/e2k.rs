//! Text models of ETABS: `.e2k` and `.$et`.

use std::collections::{BTreeMap, BTreeSet};

use jostle_io::InputError;

use crate::e2k_keys::KINDS;
use crate::facts::{Facts, Story, fault, key};
use crate::known::Tally;
use crate::member::{Member, ONE_HEIGHT, Support, TextModel, Wall};
use crate::text::number;
use crate::units::{LENGTH, PRESSURE, Units};
use crate::wall_panel::edges;

/// Sections of a file that are read.
const READ: &[&str] = &[
    "CONTROLS",
    "STORIES",
    "DIAPHRAGM NAMES",
    "MATERIAL PROPERTIES",
    "FRAME SECTIONS",
    "POINT COORDINATES",
    "LINE CONNECTIVITIES",
    "AREA CONNECTIVITIES",
    "POINT ASSIGNS",
    "LINE ASSIGNS",
    "AREA ASSIGNS",
    "SLAB PROPERTIES",
    "DECK PROPERTIES",
    "WALL PROPERTIES",
];
/// Sections without effect on stiffness and geometry.
const HARMLESS: &[&str] = &[
    "PROGRAM INFORMATION",
    "GRIDS",
    "GROUPS",
    "LOG",
    "END OF MODEL FILE",
    "PROJECT INFORMATION",
    "TABLE SETS",
    "DEVELOPED ELEVATIONS",
    "PIER/SPANDREL NAMES",
];

/// Keys of the six numbers of a section, and of the factors on them.
const NUMBERS: [&str; 6] = ["AREA", "AS2", "AS3", "TORSION", "I22", "I33"];
const FACTORS: [&str; 6] = ["AMOD", "A2MOD", "A3MOD", "JMOD", "I2MOD", "I3MOD"];
const MEMBER_FACTORS: [&str; 6] = [
    "PROPMODA",
    "PROPMODA2",
    "PROPMODA3",
    "PROPMODT",
    "PROPMODI22",
    "PROPMODI33",
];
/// Keys of the factors on the stiffness of a wall, of its property and of its own.
const WALL_FACTORS: [&str; 4] = ["F22MOD", "F12MOD", "M22MOD", "M12MOD"];
const OWN_WALL_FACTORS: [&str; 4] = ["PROPMODF22", "PROPMODF12", "PROPMODM22", "PROPMODM12"];
/// Releases of a member that is pinned: moments at both ends, torsion at one.
const PINNED: &str = "TI M2I M3I M2J M3J";
/// What a support may hold.
const HELD: [&str; 6] = ["UX", "UY", "UZ", "RX", "RY", "RZ"];

/// A word of a line, and whether it stood in quotes.
struct Word<'a> {
    text: &'a str,
    quoted: bool,
}

/// Words of a line; a quote ends a word even without a blank.
fn words(line: &str) -> Vec<Word<'_>> {
    let mut found = Vec::new();
    let mut rest = line.trim_start();
    while !rest.is_empty() {
        let (text, quoted, end) = match rest.strip_prefix('"') {
            Some(inner) => match inner.find('"') {
                Some(end) => (&inner[..end], true, end + 2),
                None => (inner, true, rest.len()),
            },
            None => {
                let end = rest
                    .find(|c: char| c.is_whitespace() || c == '"')
                    .unwrap_or(rest.len());
                (&rest[..end], false, end)
            }
        };
        found.push(Word { text, quoted });
        rest = rest[end..].trim_start();
    }
    found
}

/// A line: its section, its number, its words.
struct Record<'a> {
    line: usize,
    words: Vec<Word<'a>>,
}

impl<'a> Record<'a> {
    /// The text at a place; empty behind the last.
    fn at(&self, place: usize) -> &'a str {
        self.words.get(place).map_or("", |word| word.text)
    }

    /// The value behind a bare key. A key without value, such as a flag, is skipped.
    fn value(&self, name: &str) -> Option<&'a str> {
        let place = self
            .words
            .iter()
            .position(|word| !word.quoted && word.text == name)?;
        self.words.get(place + 1).map(|word| word.text)
    }

    fn number(&self, name: &str) -> Option<f64> {
        number(self.value(name)?)
    }

    /// Notes all keys: bare words behind the names of the record.
    fn note(&self, tally: &mut Tally) {
        let kind = self.at(0);
        // Connectivities name the kind of the object as well.
        let names = 2 + usize::from(["LINE", "AREA"].contains(&kind) || kind.ends_with("ASSIGN"));
        for (place, word) in self.words.iter().enumerate().skip(names) {
            if !word.quoted && word.text.starts_with(char::is_alphabetic) {
                tally.note(KINDS, kind, word.text, self.at(place + 1));
            }
        }
    }
}

/// Adds what a text model of ETABS says.
///
/// # Errors
/// A file without units or storeys, and names that lead nowhere.
pub(crate) fn read(file: &str, text: &str, facts: &mut Facts) -> Result<Units, InputError> {
    let mut sections: BTreeMap<&str, Vec<Record<'_>>> = BTreeMap::new();
    let mut ignored: BTreeSet<&str> = BTreeSet::new();
    let (mut section, mut comment) = ("", false);
    for (index, line) in text.lines().enumerate() {
        let trimmed = line.trim();
        if comment || trimmed.is_empty() {
            comment &= trimmed != "ENDCOMMENTS";
            continue;
        }
        if let Some(name) = trimmed.strip_prefix('$') {
            section = name.trim();
            // "STORIES - IN SEQUENCE FROM TOP"
            section = section.split(" - ").next().unwrap_or(section).trim();
            let known = READ.contains(&section)
                || HARMLESS.contains(&section)
                || section.starts_with("File ");
            if !known && !section.is_empty() {
                ignored.insert(section);
            }
            continue;
        }
        if trimmed.starts_with("STARTCOMMENTS") {
            comment = true;
            continue;
        }
        if READ.contains(&section) {
            sections.entry(section).or_default().push(Record {
                line: index + 1,
                words: words(trimmed),
            });
        }
    }
    let none = Vec::new();
    let of = |name: &str| sections.get(name).unwrap_or(&none).iter();
    let mut tally = Tally::default();
    // Slabs and decks do not bend, whatever their properties.
    let unchecked = ["CONTROLS", "SLAB PROPERTIES", "DECK PROPERTIES"];
    for name in READ.iter().filter(|name| !unchecked.contains(name)) {
        of(name).for_each(|record| record.note(&mut tally));
    }
    let units = units(file, of("CONTROLS"))?;
    let (length, pressure) = (units.factor(LENGTH), units.factor(PRESSURE));
    let levels = stories(file, of("STORIES"), length, facts)?;
    let mut model = TextModel {
        file: file.to_owned(),
        ..TextModel::default()
    };
    let used: BTreeSet<&str> = of("AREA ASSIGNS")
        .chain(of("POINT ASSIGNS"))
        .filter_map(|record| record.value("DIAPH"))
        .collect();
    for record in of("DIAPHRAGM NAMES") {
        let kind = record.value("TYPE").unwrap_or("");
        if !["RIGID", "SEMIRIGID"].contains(&kind) {
            return Err(fault(
                file,
                format!("line {}, diaphragm \"{}\"", record.line, record.at(1)),
                format!("has the type \"{kind}\", which is neither RIGID nor SEMIRIGID"),
                "export the model again",
            ));
        }
    }
    for record in of("DIAPHRAGM NAMES").filter(|record| record.value("TYPE") == Some("SEMIRIGID")) {
        if used.contains(record.at(1)) {
            model.semirigid.push(record.at(1).to_owned());
        }
    }
    let rigid: BTreeSet<&str> = of("DIAPHRAGM NAMES")
        .filter(|record| record.value("TYPE") == Some("RIGID"))
        .map(|record| record.at(1))
        .collect();
    for record in of("MATERIAL PROPERTIES") {
        let materials = model
            .materials
            .entry(record.at(1).to_owned())
            .or_insert([f64::NAN, 0.2]);
        if let Some(modulus) = record.number("E") {
            *materials = [modulus * pressure, record.number("U").unwrap_or(0.2)];
        }
    }
    for record in of("FRAME SECTIONS") {
        let sections = model.sections.entry(record.at(1).to_owned()).or_default();
        if let Some(shape) = record.value("SHAPE") {
            sections.shape = shape.to_owned();
            sections.material = record.value("MATERIAL").unwrap_or("").to_owned();
            let size = |name: &str| record.number(name).map(|size| size * length);
            sections.size = ["D", "B"].map(size);
            // The wall of a pipe is T.
            sections.plates = [size("TF"), size("TW").or(size("T"))];
            sections.bottom = ["BB", "TFB"].map(size);
            sections.fill = record.value("FILLMATERIAL").map(str::to_owned);
        }
        if let Some(product) = record.number("I23") {
            sections.product = product * length.powi(4);
        }
        for (index, (stated, name)) in sections.stated.iter_mut().zip(NUMBERS).enumerate() {
            let power = if index < 3 { 2 } else { 4 };
            *stated = record
                .number(name)
                .map(|number| number * length.powi(power))
                .or(*stated);
        }
        for (factor, name) in sections.factors.iter_mut().zip(FACTORS) {
            *factor = record.number(name).unwrap_or(*factor);
        }
    }
    let mut points: BTreeMap<&str, [f64; 3]> = BTreeMap::new();
    for record in of("POINT COORDINATES") {
        let mut place = [0.0; 3];
        for (axis, value) in place.iter_mut().enumerate() {
            match number(record.at(2 + axis)) {
                Some(number) => *value = number * length,
                None if axis == 2 => {}
                None => {
                    return Err(fault(
                        file,
                        format!("line {}, point \"{}\"", record.line, record.at(1)),
                        "has no two coordinates",
                        "export the model again",
                    ));
                }
            }
        }
        points.insert(record.at(1), place);
    }
    let place = |point: &str, level: usize| {
        let [x, y, below] = *points.get(point)?;
        // The third number is the depth below the storey.
        Some([x, y, levels.get(level)?.1 - below])
    };
    let level_of = |name: &str| levels.iter().position(|level| key(&level.0) == key(name));
    let lost = |record: &Record<'_>, what: &str| {
        fault(
            file,
            format!(
                "line {}, {} \"{}\"",
                record.line,
                record.at(0),
                record.at(1)
            ),
            format!("names {what}, which the file does not have"),
            "export the whole model again",
        )
    };
    let lines: BTreeMap<&str, &Record<'_>> = of("LINE CONNECTIVITIES")
        .map(|record| (record.at(1), record))
        .collect();
    let mut members: BTreeMap<(String, usize), Member> = BTreeMap::new();
    for record in of("LINE ASSIGNS") {
        let line = lines
            .get(record.at(1))
            .ok_or_else(|| lost(record, "a line"))?;
        let level = level_of(record.at(2))
            .ok_or_else(|| lost(record, &format!("the storey \"{}\"", record.at(2))))?;
        let below: usize = line.at(5).parse().unwrap_or(0);
        let ends = level
            .checked_sub(below)
            .and_then(|lower| Some([place(line.at(3), lower)?, place(line.at(4), level)?]));
        let ends = ends.ok_or_else(|| lost(line, "points or storeys"))?;
        let kind = line.at(2).to_lowercase();
        let members = members
            .entry((record.at(1).to_owned(), level))
            .or_insert_with(|| {
                let shown = format!("{kind} \"{}\" of storey \"{}\"", record.at(1), record.at(2));
                Member::new(shown, ends)
            });
        // Further lines of one member add keys.
        if let Some(section) = record.value("SECTION") {
            section.clone_into(&mut members.section);
        }
        members.angle = record.number("ANG").unwrap_or(members.angle);
        for (factor, name) in members.factors.iter_mut().zip(MEMBER_FACTORS) {
            *factor = record.number(name).unwrap_or(*factor);
        }
        if let Some(material) = record.value("MATERIALOVERWRITE") {
            members.material = Some(material.to_owned());
        }
        if record.value("SPRINGPROP").is_some() {
            model.on_springs.push(members.shown.clone());
        }
        let releases = match record.value("RELEASE").unwrap_or("") {
            "PINNED" => PINNED,
            stated => stated,
        };
        for word in releases.split_whitespace() {
            let (what, end) = word.split_at(word.len() - 1);
            let place = Member::RELEASES
                .iter()
                .position(|candidate| *candidate == what);
            let (Some(place), Some(end)) = (
                place,
                ["I", "J"].iter().position(|candidate| *candidate == end),
            ) else {
                return Err(fault(
                    file,
                    members.shown.clone(),
                    format!("has the release \"{word}\", which is not known"),
                    "releases are PI, V2I, V3I, TI, M2I, M3I, and the same with J",
                ));
            };
            members.releases[end][place] = true;
        }
        // The part of the end lengths that does not bend; none unless it is stated.
        let rigid = record.number("RIGIDZONE").unwrap_or(0.0);
        for (end, name) in members
            .stiff_ends
            .iter_mut()
            .zip(["LENGTHOFFI", "LENGTHOFFJ"])
        {
            *end = record
                .number(name)
                .map_or(*end, |offset| offset * length * rigid);
        }
        let by_source = ["LENGTHOFFI", "LENGTHOFFJ"]
            .iter()
            .all(|name| record.number(name).is_none());
        members.moved |= rigid != 0.0 && by_source;
        members.moved |= ["OFFSETXI", "OFFSETYI", "OFFSETXJ", "OFFSETYJ"]
            .iter()
            .any(|name| record.number(name).is_some_and(|number| number != 0.0));
    }
    for record in of("WALL PROPERTIES") {
        let wall_properties = model
            .wall_properties
            .entry(record.at(1).to_owned())
            .or_default();
        if let Some(material) = record.value("MATERIAL") {
            material.clone_into(&mut wall_properties.material);
        }
        let thickness = record.number("WALLTHICKNESS").map(|number| number * length);
        wall_properties.thickness = thickness.or(wall_properties.thickness);
        for (factor, name) in wall_properties.factors.iter_mut().zip(WALL_FACTORS) {
            *factor = record.number(name).unwrap_or(*factor);
        }
    }
    let areas: BTreeMap<&str, &Record<'_>> = of("AREA CONNECTIVITIES")
        .map(|record| (record.at(1), record))
        .collect();
    let shells = of("SLAB PROPERTIES").chain(of("DECK PROPERTIES"));
    let bends = |record: &&Record<'_>| {
        record
            .value("MODELINGTYPE")
            .is_some_and(|kind| kind.starts_with("Shell"))
    };
    let bending: BTreeSet<&str> = shells.filter(bends).map(|record| record.at(1)).collect();
    let mut floors = 0;
    let mut ramps: Vec<String> = Vec::new();
    for record in of("AREA ASSIGNS") {
        let area = areas
            .get(record.at(1))
            .ok_or_else(|| lost(record, "an area"))?;
        let level = level_of(record.at(2))
            .ok_or_else(|| lost(record, &format!("the storey \"{}\"", record.at(2))))?;
        let what = match area.at(2) {
            "PANEL" => "wall",
            _ => "area",
        };
        let shown = format!("{what} \"{}\" of storey \"{}\"", record.at(1), record.at(2));
        let count: usize = area.at(3).parse().unwrap_or(0);
        // Points, and how many storeys below this one each of them lies.
        let corner = |index: usize| {
            let below: usize = area.at(4 + count + index).parse().unwrap_or(0);
            place(area.at(4 + index), level.checked_sub(below)?)
        };
        let corners: Option<Vec<[f64; 3]>> = (0..count.min(area.words.len())).map(corner).collect();
        let corners = corners.ok_or_else(|| lost(area, "points or storeys"))?;
        if record.value("SPRINGPROP").is_some() {
            model.on_springs.push(shown.clone());
        }
        let points = facts.points.entry(key(record.at(2))).or_default();
        points.extend(corners.iter().map(|[x, y, _]| [*x, *y]));
        let opening = record
            .value("OPENING")
            .is_some_and(|value| value.eq_ignore_ascii_case("yes"));
        let mut wall = Wall {
            shown,
            corners,
            property: record.value("SECTION").unwrap_or("").to_owned(),
            factors: OWN_WALL_FACTORS.map(|name| record.number(name).unwrap_or(1.0)),
            thickness: None,
            material: record.value("MATERIALOVERWRITE").map(str::to_owned),
        };
        let z = wall.corners.first().map_or(0.0, |corner| corner[2]);
        let level = |corner: &[f64; 3]| (corner[2] - z).abs() < ONE_HEIGHT;
        let inclined = !wall.corners.iter().all(level);
        // Walls may be drawn as areas.
        if what == "wall" || (inclined && edges(&wall).is_some()) {
            if opening {
                return Err(fault(
                    file,
                    wall.shown,
                    "is an opening in a wall, which jostle cannot cut",
                    "divide the wall at the opening into panels beside, above and below it, or take the stiffness from results: unit loads on every diaphragm",
                ));
            }
            wall.thickness = thickness(file, record, &wall.shown)?.map(|own| own * length);
            model.walls.push(wall);
            continue;
        }
        if inclined {
            ramps.push(wall.shown.clone());
        }
        if let Some(name) = record
            .value("SECTION")
            .filter(|name| bending.contains(name))
        {
            model.bending_slabs.push(name.to_owned());
        }
        floors += 1;
        if let Some(name) = record.value("DIAPH").filter(|name| rigid.contains(name)) {
            wall.corners.iter().for_each(|at| model.hold(name, *at));
        }
        model.floor_areas.push(wall.corners);
    }
    if let Some(ramp) = ramps.first() {
        facts.left_out.push(format!("{file}: {} inclined areas, such as {ramp}: ramps and stairs stiffen the frame, and periods are longer without them", ramps.len()));
    }
    for ((_, level), member) in &members {
        for [x, y, _] in member.ends {
            facts
                .points
                .entry(key(&levels[*level].0))
                .or_default()
                .push([x, y]);
        }
    }
    for record in of("POINT ASSIGNS") {
        let shown = format!("point \"{}\" of storey \"{}\"", record.at(1), record.at(2));
        let at = level_of(record.at(2)).and_then(|level| place(record.at(1), level));
        if record.value("SPRINGPROP").is_some() {
            model.on_springs.push(shown.clone());
        }
        match record.value("DIAPH") {
            Some("DISCONNECTED") => model.disconnected.extend(at),
            Some(name) if rigid.contains(name) => {
                at.into_iter().for_each(|at| model.hold(name, at));
            }
            _ => {}
        }
        if let (Some(held), Some(at)) = (record.value("RESTRAINT"), at) {
            let held = HELD.map(|direction| held.split_whitespace().any(|word| word == direction));
            model.supports.push(Support { shown, at, held });
        }
    }
    facts.left_out.extend(tally.lines(file));
    facts.read.push(format!(
        "{file}: {} storeys, {} columns and beams, {floors} floor areas, {} walls",
        facts.stories.len(),
        members.len(),
        model.walls.len()
    ));
    model.members = members.into_values().collect();
    facts.text = Some(model);
    facts
        .left_out
        .extend(crate::left_out::lines(file, "sections", &ignored));
    Ok(units)
}

/// Units of the controls, which some versions write twice.
fn units<'a>(
    file: &str,
    controls: impl Iterator<Item = &'a Record<'a>>,
) -> Result<Units, InputError> {
    let mut found: Option<Units> = None;
    for record in controls.filter(|record| record.at(0) == "UNITS") {
        let [force, length] = [record.at(1), record.at(2)];
        let units = Units::new(force, length).ok_or_else(|| {
            fault(
                file,
                format!("line {}, UNITS", record.line),
                format!("\"{force}\" and \"{length}\" are not known"),
                "export the model in N, kN, kgf, tonf, lb or kip with m, cm, mm, ft or in",
            )
        })?;
        if found.is_some_and(|other| other != units) {
            return Err(fault(
                file,
                format!("line {}, UNITS", record.line),
                "differ from those above",
                "export the model again: it is not clear which units hold",
            ));
        }
        found = Some(units);
    }
    found.ok_or_else(|| {
        fault(
            file,
            "$ CONTROLS",
            "has no line UNITS",
            "export the model as .e2k from ETABS (File, Export, ETABS .e2k Text File)",
        )
    })
}

/// Storeys from the ground up with the base as the first.
fn stories<'a>(
    file: &str,
    records: impl Iterator<Item = &'a Record<'a>>,
    length: f64,
    facts: &mut Facts,
) -> Result<Vec<(String, f64)>, InputError> {
    let mut down: Vec<(String, f64)> = Vec::new();
    let mut base = None;
    for record in records.filter(|record| record.at(0) == "STORY") {
        let name = record.at(1).to_owned();
        if let Some(height) = record.number("HEIGHT") {
            down.push((name, height * length));
        } else if let Some(z) = record.number("ELEV")
            && base.replace((name, z * length)).is_some()
        {
            return Err(fault(
                file,
                format!("line {}, STORY", record.line),
                "is a second base: several towers",
                "export each tower as a model of its own",
            ));
        }
    }
    let (Some(base), false) = (base, down.is_empty()) else {
        return Err(fault(
            file,
            "$ STORIES",
            "has no storeys above a base",
            "export the whole model again",
        ));
    };
    let mut z = base.1;
    let mut levels = vec![base.clone()];
    levels.extend(down.into_iter().rev().map(|(name, height)| {
        z += height;
        (name, z)
    }));
    facts.stories = levels[1..]
        .iter()
        .map(|(name, top)| Story {
            name: name.clone(),
            top: *top,
        })
        .collect();
    facts.base = Some(base);
    Ok(levels)
}

/// Thickness that an area has in place of its property's, in the unit of the file.
fn thickness(file: &str, record: &Record<'_>, shown: &str) -> Result<Option<f64>, InputError> {
    let is = |word: &Word<'_>| !word.quoted && word.text == "AREATHICKNESSOVERWRITE";
    let Some(place) = record.words.iter().position(is) else {
        return Ok(None);
    };
    let values = record.words[place + 1..]
        .iter()
        .map_while(|word| number(word.text));
    one_thickness(file, shown, values)
}

/// The one thickness of all corners of an area.
///
/// # Errors
/// Corners of different thicknesses.
pub(crate) fn one_thickness(
    file: &str,
    shown: &str,
    mut values: impl Iterator<Item = f64>,
) -> Result<Option<f64>, InputError> {
    let first = values.next();
    match values.all(|value| Some(value) == first) {
        true => Ok(first),
        false => Err(fault(
            file,
            shown,
            "has a thickness that changes over its area",
            "give it one thickness in the source, or take the stiffness from results: unit loads on every diaphragm",
        )),
    }
}
