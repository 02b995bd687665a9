//! Text models of SAP2000: `.s2k` and `.$2k`.

use std::collections::{BTreeMap, BTreeSet};

use jostle_io::InputError;

use crate::e2k::one_thickness;
use crate::facts::{Facts, FloorMass, Story, fault, key};
use crate::known::Tally;
use crate::member::{
    Member, ONE_HEIGHT as ONE_LEVEL, SectionFacts, Support, TextModel, Wall, WallFacts,
};
use crate::s2k_keys::{HARMLESS, KINDS, READ};
use crate::text::number;
use crate::units::{INERTIA, LENGTH, MASS, PRESSURE, Units};

/// Columns of the six numbers of a section, and of the factors on them.
const NUMBERS: [&str; 6] = ["Area", "AS2", "AS3", "TorsConst", "I22", "I33"];
const FACTORS: [&str; 6] = ["AMod", "A2Mod", "A3Mod", "JMod", "I2Mod", "I3Mod"];

const MEMBER_FACTORS: [&str; 6] = ["AMod", "AS2Mod", "AS3Mod", "JMod", "I22Mod", "I33Mod"];

type Row<'a> = BTreeMap<&'a str, &'a str>;

/// `Key=Value` pairs of a row.
fn pairs(mut rest: &str) -> Row<'_> {
    let mut found = Row::new();
    while let Some((name, after)) = rest.split_once('=') {
        let (value, next) = match after.strip_prefix('"') {
            Some(inner) => inner.split_once('"').unwrap_or((inner, "")),
            None => after.split_once(char::is_whitespace).unwrap_or((after, "")),
        };
        found.insert(name.trim(), value.trim());
        rest = next;
    }
    found
}

/// The text with each row on one line: a blank and an underscore at the end continue a row.
fn joined(text: &str) -> String {
    let mut found = String::with_capacity(text.len());
    for line in text.lines().map(str::trim_end) {
        match line
            .strip_suffix('_')
            .filter(|row| row.is_empty() || row.ends_with(' '))
        {
            Some(row) => found.push_str(row),
            None => {
                found.push_str(line);
                found.push('\n');
            }
        }
    }
    found
}

/// Adds what a text model of SAP2000 says.
///
/// # Errors
/// A file without units or joints, and names that lead nowhere.
pub(crate) fn read(file: &str, text: &str, facts: &mut Facts) -> Result<Units, InputError> {
    let joined = joined(text);
    let is_read =
        |table: &str| READ.contains(&table) || KINDS.iter().any(|kind| kind.name == table);
    let mut tables: BTreeMap<&str, Vec<Row<'_>>> = BTreeMap::new();
    let mut ignored: BTreeSet<&str> = BTreeSet::new();
    let mut table = "";
    for line in joined.lines() {
        let trimmed = line.trim();
        if let Some(name) = trimmed.strip_prefix("TABLE:") {
            table = name.trim().trim_matches('"');
            if !is_read(table) && !HARMLESS.iter().any(|start| table.starts_with(start)) {
                ignored.insert(table);
            }
        } else if is_read(table) && trimmed.contains('=') {
            tables.entry(table).or_default().push(pairs(trimmed));
        }
    }
    let mut tally = Tally::default();
    for (table, rows) in tables.iter().filter(|table| !READ.contains(table.0)) {
        for (key, value) in rows.iter().flatten() {
            tally.note(KINDS, table, key, value);
        }
    }
    let none = Vec::new();
    let of = |name: &str| tables.get(name).unwrap_or(&none).iter();
    let get = |row: &Row<'_>, name: &str| row.get(name).copied().unwrap_or("").to_owned();
    let value = |row: &Row<'_>, name: &str| row.get(name).and_then(|text| number(text));
    let stated = of("PROGRAM CONTROL").find_map(|row| row.get("CurrUnits").copied());
    let units = stated.and_then(Units::parse).ok_or_else(|| {
        fault(
            file,
            "table PROGRAM CONTROL",
            match stated {
                Some(units) => format!("CurrUnits \"{units}\" are not known"),
                None => "has no CurrUnits".into(),
            },
            "export the whole model from SAP2000 as .s2k, with the table Program Control",
        )
    })?;
    let (length, pressure) = (units.factor(LENGTH), units.factor(PRESSURE));
    let mut joints: BTreeMap<String, [f64; 3]> = BTreeMap::new();
    let systems: BTreeMap<&str, &Row<'_>> = of("COORDINATE SYSTEMS")
        .filter_map(|row| Some((*row.get("Name")?, row)))
        .collect();
    for row in of("JOINT COORDINATES") {
        let joint = get(row, "Joint");
        if row
            .get("CoordType")
            .is_some_and(|kind| *kind != "Cartesian")
        {
            return Err(fault(
                file,
                format!("table JOINT COORDINATES, joint {joint}"),
                "is not in Cartesian coordinates",
                "export joints in the Cartesian system GLOBAL",
            ));
        }
        let place = ["XorR", "Y", "Z"].map(|name| value(row, name));
        let [Some(x), Some(y), Some(z)] = place else {
            return Err(fault(
                file,
                format!("table JOINT COORDINATES, joint {joint}"),
                "has no three coordinates",
                "export the table again",
            ));
        };
        let system = row.get("CoordSys").copied().unwrap_or("GLOBAL");
        let at = match system.eq_ignore_ascii_case("GLOBAL") {
            true => Some([x, y, z]),
            false => systems
                .get(system)
                .and_then(|system| in_global(system, [x, y, z])),
        };
        let Some(at) = at else {
            return Err(fault(
                file,
                format!("table JOINT COORDINATES, joint {joint}"),
                format!(
                    "is in the coordinate system \"{system}\", of which the table COORDINATE SYSTEMS does not have an origin and a turn about Z alone"
                ),
                "export the table Coordinate Systems as well, or place joints in the system GLOBAL",
            ));
        };
        joints.insert(joint, at.map(|axis| axis * length));
    }
    if joints.is_empty() {
        return Err(fault(
            file,
            "table JOINT COORDINATES",
            "is missing or empty",
            "export the whole model from SAP2000 as .s2k",
        ));
    }
    let mut model = TextModel {
        file: file.to_owned(),
        ..TextModel::default()
    };
    let held = levels(
        of("CONSTRAINT DEFINITIONS - DIAPHRAGM"),
        of("JOINT CONSTRAINT ASSIGNMENTS"),
        &joints,
        &mut model,
        facts,
    )?;
    for row in of("JOINT RESTRAINT ASSIGNMENTS") {
        if let Some(at) = joints.get(&get(row, "Joint")) {
            model.supports.push(Support {
                shown: format!("joint {}", get(row, "Joint")),
                at: *at,
                held: ["U1", "U2", "U3", "R1", "R2", "R3"]
                    .map(|name| row.get(name) == Some(&"Yes")),
            });
        }
    }
    for (table, object) in [
        ("JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED", "Joint"),
        ("JOINT SPRING ASSIGNMENTS 2 - COUPLED", "Joint"),
        ("FRAME SPRING ASSIGNMENTS", "Frame"),
        ("AREA SPRING ASSIGNMENTS", "Area"),
    ] {
        let shown = |row| format!("{} {}", object.to_lowercase(), get(row, object));
        model.on_springs.extend(of(table).map(shown));
    }
    let supported: Vec<f64> = model.supports.iter().map(|support| support.at[2]).collect();
    let lowest = |heights: &mut dyn Iterator<Item = f64>| heights.fold(f64::INFINITY, f64::min);
    let base = match supported.is_empty() {
        true => lowest(&mut joints.values().map(|at| at[2])),
        false => lowest(&mut supported.iter().copied()),
    };
    facts.base = Some(("Base".into(), base));
    for row in of("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES") {
        if let Some(modulus) = value(row, "E1") {
            // E = 2 G (1 + ν).
            let by_shear =
                || Some(0.5 * modulus / value(row, "G12").filter(|shear| *shear > 0.0)? - 1.0);
            let poisson = value(row, "U12").or_else(by_shear).unwrap_or(0.2);
            model
                .materials
                .insert(get(row, "Material"), [modulus * pressure, poisson]);
        }
    }
    for row in of("FRAME SECTION PROPERTIES 01 - GENERAL") {
        let size = |name: &str| value(row, name).map(|size| size * length);
        model.sections.insert(
            get(row, "SectionName"),
            SectionFacts {
                shape: get(row, "Shape"),
                material: get(row, "Material"),
                size: ["t3", "t2"].map(size),
                plates: ["tf", "tw"].map(size),
                bottom: ["t2b", "tfb"].map(size),
                fill: None,
                product: value(row, "I23").unwrap_or(0.0) * length.powi(4),
                stated: std::array::from_fn(|index| {
                    let power = if index < 3 { 2 } else { 4 };
                    value(row, NUMBERS[index]).map(|number| number * length.powi(power))
                }),
                factors: FACTORS.map(|name| value(row, name).unwrap_or(1.0)),
            },
        );
    }
    let by_frame = |table: &str| -> BTreeMap<String, &Row<'_>> {
        of(table).map(|row| (get(row, "Frame"), row)).collect()
    };
    let assigned = by_frame("FRAME SECTION ASSIGNMENTS");
    let turned = by_frame("FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL");
    let released = by_frame("FRAME RELEASE ASSIGNMENTS 1 - GENERAL");
    let offset = by_frame("FRAME OFFSET ALONG LENGTH ASSIGNMENTS");
    let modified = by_frame("FRAME PROPERTY MODIFIERS");
    let partly = by_frame("FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY");
    for row in of("CONNECTIVITY - FRAME") {
        let frame = get(row, "Frame");
        let ends = ["JointI", "JointJ"].map(|name| joints.get(&get(row, name)).copied());
        let [Some(a), Some(b)] = ends else {
            return Err(fault(
                file,
                format!("table CONNECTIVITY - FRAME, frame {frame}"),
                "names a joint that JOINT COORDINATES does not have",
                "export the whole model",
            ));
        };
        let assignment = assigned.get(&frame);
        let mut member = Member::new(format!("frame {frame}"), [a, b]);
        member.section = assignment
            .map(|row| get(row, "AnalSect"))
            .unwrap_or_default();
        member.material = assignment.and_then(|row| overwrite(row));
        if let Some(row) = modified.get(&frame) {
            member.factors = MEMBER_FACTORS.map(|name| value(row, name).unwrap_or(1.0));
        }
        member.angle = turned
            .get(&frame)
            .and_then(|row| value(row, "Angle"))
            .unwrap_or(0.0);
        if let Some(row) = released.get(&frame) {
            member.releases = ["I", "J"].map(|end| {
                Member::RELEASES
                    .map(|what| row.get(format!("{what}{end}").as_str()) == Some(&"Yes"))
            });
        }
        let partly_fixed = released
            .get(&frame)
            .is_some_and(|row| row.get("PartialFix") == Some(&"Yes"));
        if partly_fixed || partly.contains_key(&frame) {
            return Err(fault(
                file,
                member.shown,
                "has partly fixed ends, whose stiffness is not read",
                "release or fix its ends in the source and export again",
            ));
        }
        if let Some(row) = offset.get(&frame) {
            let rigid = value(row, "RigidFactor").unwrap_or(0.0);
            let lengths = ["LengthI", "LengthJ"].map(|name| value(row, name));
            match lengths {
                // Found from the sizes of members that meet: not in the file.
                _ if row.get("Type") == Some(&"Automatic") => member.moved = rigid != 0.0,
                _ => {
                    member.stiff_ends =
                        lengths.map(|offset| offset.unwrap_or(0.0) * length * rigid);
                }
            }
        }
        model.members.push(member);
    }
    for row in of("AREA SECTION PROPERTIES") {
        let facts = WallFacts {
            material: get(row, "Material"),
            thickness: value(row, "Thickness").map(|thickness| thickness * length),
            factors: ["F22Mod", "F12Mod", "M22Mod", "M12Mod"]
                .map(|name| value(row, name).unwrap_or(1.0)),
        };
        model.wall_properties.insert(get(row, "Section"), facts);
    }
    let by_area = |table: &str| -> BTreeMap<String, &Row<'_>> {
        of(table).map(|row| (get(row, "Area"), row)).collect()
    };
    let of_area = by_area("AREA SECTION ASSIGNMENTS");
    let softened = by_area("AREA STIFFNESS MODIFIERS");
    let thicknesses = by_area("AREA THICKNESS OVERWRITES");
    let mut floors = 0;
    for row in of("CONNECTIVITY - AREA") {
        let corners: Vec<[f64; 3]> = ["Joint1", "Joint2", "Joint3", "Joint4"]
            .iter()
            .filter_map(|name| joints.get(*row.get(name)?).copied())
            .collect();
        let z = corners.first().map_or(0.0, |corner| corner[2]);
        if corners
            .iter()
            .any(|corner| (corner[2] - z).abs() > ONE_LEVEL)
        {
            let area = get(row, "Area");
            let shown = format!("area {area}");
            let section = of_area.get(&area);
            let stated = thicknesses.get(&area).into_iter().flat_map(|row| {
                ["Thickness1", "Thickness2", "Thickness3", "Thickness4"]
                    .map(|name| value(row, name))
            });
            let thickness = one_thickness(file, &shown, stated.flatten())?;
            model.walls.push(Wall {
                property: section.map(|row| get(row, "Section")).unwrap_or_default(),
                shown,
                corners,
                factors: ["f22", "f12", "m22", "m12"].map(|name| {
                    let row = softened.get(&area);
                    row.and_then(|row| value(row, name)).unwrap_or(1.0)
                }),
                thickness: thickness.map(|thickness| thickness * length),
                material: section.and_then(|row| overwrite(row)),
            });
        } else {
            floors += 1;
            model.floor_areas.push(corners);
        }
    }
    for at in joints.values() {
        if let Some(story) = facts
            .stories
            .iter()
            .find(|story| (story.top - at[2]).abs() < ONE_LEVEL)
        {
            facts
                .points
                .entry(key(&story.name))
                .or_default()
                .push([at[0], at[1]]);
        }
    }
    let elsewhere = [
        "FRAME ADDED MASS ASSIGNMENTS",
        "AREA ADDED MASS ASSIGNMENTS",
        "JOINT ADDED MASS BY WEIGHT ASSIGNMENTS",
        "JOINT ADDED MASS BY VOLUME ASSIGNMENTS",
    ];
    let lack = match elsewhere.iter().any(|table| of(table).next().is_some()) {
        true => Some("masses are on frames or areas, or by weight or volume, as well as on joints"),
        false => not_on_joints_alone(of("MASS SOURCE"), of("MASSES 1 - MASS SOURCE")),
    };
    match lack {
        Some(lack) => {
            facts.left_out.push(format!(
                "{file}: {lack}: masses come from the .OUT file of the analysis instead"
            ));
            facts.without_masses = Some(lack);
        }
        None => added_masses(
            file,
            of("JOINT ADDED MASS ASSIGNMENTS"),
            &joints,
            &held,
            &model,
            units,
            facts,
        )?,
    }
    facts.read.push(format!("{file}: {} joints, {} columns and beams, {floors} floor areas, {} walls, {} levels with a diaphragm", joints.len(), model.members.len(), model.walls.len(), facts.stories.len()));
    facts.text = Some(model);
    facts.left_out.extend(tally.lines(file));
    facts
        .left_out
        .extend(crate::left_out::lines(file, "tables", &ignored));
    Ok(units)
}

/// A material in place of that of the section.
fn overwrite(row: &Row<'_>) -> Option<String> {
    let name = row.get("MatProp").filter(|name| **name != "Default");
    name.map(|name| (*name).to_owned())
}

/// A point of a coordinate system in the global one; `None` for systems that are not upright.
fn in_global(system: &Row<'_>, [x, y, z]: [f64; 3]) -> Option<[f64; 3]> {
    let value = |name: &str| match system.get(name) {
        Some(text) => number(text),
        None => Some(0.0),
    };
    let is_cartesian = system.get("Type").is_none_or(|kind| *kind == "Cartesian");
    if !is_cartesian || value("AboutX")? != 0.0 || value("AboutY")? != 0.0 {
        return None;
    }
    let (sin, cos) = value("AboutZ")?.to_radians().sin_cos();
    Some([
        value("X")? + cos * x - sin * y,
        value("Y")? + sin * x + cos * y,
        value("Z")? + z,
    ])
}

/// Storeys: the heights of joints under rigid floors, as SAP2000 has no storeys. Returns the floor that holds each joint; others at
/// these heights are free.
fn levels<'a>(
    definitions: impl Iterator<Item = &'a Row<'a>>,
    assigned: impl Iterator<Item = &'a Row<'a>>,
    joints: &BTreeMap<String, [f64; 3]>,
    model: &mut TextModel,
    facts: &mut Facts,
) -> Result<BTreeMap<&'a str, &'a str>, InputError> {
    let floors: BTreeMap<&str, &Row<'_>> = definitions
        .filter_map(|row| Some((*row.get("Name")?, row)))
        .collect();
    let mut held = BTreeMap::new();
    let mut others: BTreeSet<&str> = BTreeSet::new();
    for row in assigned {
        let (Some(joint), Some(name)) = (row.get("Joint"), row.get("Constraint")) else {
            continue;
        };
        let Some(at) = joints.get(*joint) else {
            continue;
        };
        let Some(floor) = floors.get(name) else {
            others.insert(name);
            continue;
        };
        let refuse = |problem: &str, remedy: &str| {
            Err(fault(
                &model.file,
                format!("diaphragm \"{name}\""),
                problem,
                remedy,
            ))
        };
        if floor
            .get("Axis")
            .is_some_and(|axis| ["X", "Y"].contains(axis))
        {
            return refuse(
                "is upright (Axis), but floors of jostle are level",
                "give floors diaphragms whose axis is Z",
            );
        }
        let elsewhere = |other: &&crate::member::Diaphragm| {
            other.name == *name && (other.joints[0][2] - at[2]).abs() > ONE_LEVEL
        };
        if floor.get("MultiLevel") == Some(&"No")
            && model.diaphragms.iter().any(|other| elsewhere(&other))
        {
            return refuse(
                "holds joints at several heights together, but a floor of jostle has one",
                "give every floor a diaphragm of its own",
            );
        }
        model.hold(name, *at);
        held.insert(*joint, *name);
    }
    if !others.is_empty() {
        let names: Vec<&str> = others.into_iter().collect();
        facts.left_out.push(format!("{}: constraints that are no diaphragms are not applied: joints that they tie move apart, so that periods are longer ({})", model.file, names.join(", ")));
    }
    let mut heights: Vec<f64> = model
        .diaphragms
        .iter()
        .map(|floor| floor.joints[0][2])
        .collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| (*a - *b).abs() < ONE_LEVEL);
    let free = joints
        .iter()
        .filter(|(name, at)| {
            !held.contains_key(name.as_str())
                && heights.iter().any(|top| (top - at[2]).abs() < ONE_LEVEL)
        })
        .map(|joint| *joint.1);
    model.disconnected.extend(free);
    facts.stories = heights
        .into_iter()
        .map(|top| Story {
            name: format!("level {top:.3} m"),
            top,
        })
        .collect();
    Ok(held)
}

/// Why masses are not those of joints alone.
fn not_on_joints_alone<'a>(
    mut sources: impl Iterator<Item = &'a Row<'a>>,
    mut older: impl Iterator<Item = &'a Row<'a>>,
) -> Option<&'static str> {
    if let Some(row) = older.next() {
        let alone = row.get("MassFrom") == Some(&"Masses");
        return (!alone).then_some("its mass source has masses from elements or loads");
    }
    // Follow-up rows of a source have no Elements.
    let Some(row) =
        sources.find(|row| row.get("Elements").is_some() && row.get("IsDefault") != Some(&"No"))
    else {
        return Some("has no table MASS SOURCE that says that masses are on joints alone");
    };
    let alone = row.get("Elements") == Some(&"No")
        && row.get("Loads") == Some(&"No")
        && row.get("Masses") == Some(&"Yes");
    (!alone).then_some("its mass source has masses from elements or loads")
}

/// Masses that were put on joints.
///
/// # Errors
/// Masses that no floor holds.
fn added_masses<'a>(
    file: &str,
    added: impl Iterator<Item = &'a Row<'a>>,
    joints: &BTreeMap<String, [f64; 3]>,
    held: &BTreeMap<&str, &str>,
    model: &TextModel,
    units: Units,
    facts: &mut Facts,
) -> Result<(), InputError> {
    /// Place in plan, masses along X and Y, moment of inertia.
    type Mass = ([f64; 2], [f64; 2], f64);
    let mut of_floor: BTreeMap<(usize, &str), Vec<Mass>> = BTreeMap::new();
    let mut loose: Vec<(&str, f64)> = Vec::new();
    let mut all = 0.0;
    for row in added {
        let value = |name: &str| row.get(name).and_then(|text| number(text)).unwrap_or(0.0);
        let Some((joint, at)) = row
            .get("Joint")
            .and_then(|joint| Some((*joint, joints.get(*joint)?)))
        else {
            continue;
        };
        let mass = ["Mass1", "Mass2"].map(|name| value(name) * units.factor(MASS));
        let story = |story: &Story| (story.top - at[2]).abs() < ONE_LEVEL;
        let level = facts.stories.iter().position(story);
        match (level, held.get(joint)) {
            (Some(level), Some(floor)) => {
                let polar = value("MMI3") * units.factor(INERTIA);
                let masses = of_floor.entry((level, floor)).or_default();
                masses.push(([at[0], at[1]], mass, polar));
                all += mass[0].max(mass[1]);
            }
            _ => {
                let supported = model
                    .supports
                    .iter()
                    .any(|support| support.at == *at && support.held[0] && support.held[1]);
                if !supported && mass != [0.0; 2] {
                    loose.push((joint, mass[0].max(mass[1])));
                }
            }
        }
    }
    let missing: f64 = loose.iter().map(|loose| loose.1).sum();
    if let Some((joint, _)) = loose.first().filter(|_| missing > 1e-3 * all) {
        return Err(fault(
            file,
            format!("joint {joint}"),
            format!(
                "is one of {} with mass that no diaphragm holds, {:.3} t beside {:.3} t of floors; jostle has masses on floors alone",
                loose.len(),
                1e-3 * missing,
                1e-3 * all
            ),
            "give these joints the diaphragm of their floor, or put their masses on floors",
        ));
    }
    for ((level, floor), masses) in of_floor {
        let mass = [0, 1].map(|axis| masses.iter().map(|mass| mass.1[axis]).sum::<f64>());
        if mass.iter().any(|mass| *mass < 0.0) || mass == [0.0; 2] {
            continue;
        }
        // Mean of both, as floors with different ones are refused in space.
        let weight = |mass: &Mass| 0.5 * (mass.1[0] + mass.1[1]);
        let total = 0.5 * (mass[0] + mass[1]);
        let centre = [0, 1].map(|axis| {
            masses
                .iter()
                .map(|mass| mass.0[axis] * weight(mass))
                .sum::<f64>()
                / total
        });
        let inertia = masses.iter().map(|mass| {
            let [x, y] = [mass.0[0] - centre[0], mass.0[1] - centre[1]];
            mass.2 + mass.1[1] * x * x + mass.1[0] * y * y
        });
        facts.masses.push(FloorMass {
            story: Ok(facts.stories[level].name.clone()),
            diaphragm: floor.to_owned(),
            mass,
            inertia: Some(inertia.sum()),
            centre: Some(centre),
        });
    }
    Ok(())
}
