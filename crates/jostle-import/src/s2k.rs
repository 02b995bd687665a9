//! Text models of SAP2000: `.s2k` and `.$2k`.

use std::collections::{BTreeMap, BTreeSet};

use jostle_io::InputError;

use crate::facts::{Facts, FloorMass, Story, fault, key};
use crate::member::{Member, SectionFacts, Support, TextModel, Wall, WallFacts};
use crate::text::number;
use crate::units::{INERTIA, LENGTH, MASS, PRESSURE, Units};

/// Heights of joints that belong to one storey \[m\].
const ONE_LEVEL: f64 = 0.01;

/// Tables that are read.
const READ: &[&str] = &[
    "PROGRAM CONTROL",
    "JOINT COORDINATES",
    "JOINT RESTRAINT ASSIGNMENTS",
    "CONNECTIVITY - FRAME",
    "CONNECTIVITY - AREA",
    "AREA SECTION ASSIGNMENTS",
    "AREA SECTION PROPERTIES",
    "FRAME SECTION ASSIGNMENTS",
    "FRAME SECTION PROPERTIES 01 - GENERAL",
    "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL",
    "FRAME RELEASE ASSIGNMENTS 1 - GENERAL",
    "FRAME OFFSET ALONG LENGTH ASSIGNMENTS",
    "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES",
    "CONSTRAINT DEFINITIONS - DIAPHRAGM",
    "JOINT CONSTRAINT ASSIGNMENTS",
    "JOINT ADDED MASS ASSIGNMENTS",
    "MASS SOURCE",
    "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED",
];
/// Beginnings of names of tables without effect on stiffness and geometry.
const HARMLESS: &[&str] = &[
    "OPTIONS",
    "PREFERENCES",
    "PROJECT INFORMATION",
    "DATABASE",
    "GRID LINES",
    "GROUPS",
    "COORDINATE SYSTEMS",
    "REBAR SIZES",
    "FUNCTION",
    "ACTIVE DEGREES",
    "OVERWRITES",
];

/// Columns of the six numbers of a section, and of the factors on them.
const NUMBERS: [&str; 6] = ["Area", "AS2", "AS3", "TorsConst", "I22", "I33"];
const FACTORS: [&str; 6] = ["AMod", "A2Mod", "A3Mod", "JMod", "I2Mod", "I3Mod"];

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

/// Adds what a text model of SAP2000 says.
///
/// # Errors
/// A file without units or joints, and names that lead nowhere.
pub(crate) fn read(file: &str, text: &str, facts: &mut Facts) -> Result<Units, InputError> {
    // A blank and an underscore at the end continue a row.
    let joined = text.replace("\r\n", "\n").replace(" _\n", " ");
    let mut tables: BTreeMap<&str, Vec<Row<'_>>> = BTreeMap::new();
    let mut ignored: BTreeSet<&str> = BTreeSet::new();
    let mut table = "";
    for line in joined.lines() {
        let trimmed = line.trim();
        if let Some(name) = trimmed.strip_prefix("TABLE:") {
            table = name.trim().trim_matches('"');
            if !READ.contains(&table) && !HARMLESS.iter().any(|start| table.starts_with(start)) {
                ignored.insert(table);
            }
        } else if READ.contains(&table) && trimmed.contains('=') {
            tables.entry(table).or_default().push(pairs(trimmed));
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
        joints.insert(joint, [x, y, z].map(|axis| axis * length));
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
    levels(
        &mut of("CONSTRAINT DEFINITIONS - DIAPHRAGM"),
        &mut of("JOINT CONSTRAINT ASSIGNMENTS"),
        &joints,
        facts,
    );
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
    model.on_springs.extend(
        of("JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED")
            .map(|row| format!("joint {}", get(row, "Joint"))),
    );
    let supported: Vec<f64> = model.supports.iter().map(|support| support.at[2]).collect();
    let lowest = |heights: &mut dyn Iterator<Item = f64>| heights.fold(f64::INFINITY, f64::min);
    let base = match supported.is_empty() {
        true => lowest(&mut joints.values().map(|at| at[2])),
        false => lowest(&mut supported.iter().copied()),
    };
    facts.base = Some(("Base".into(), base));
    for row in of("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES") {
        if let Some(modulus) = value(row, "E1") {
            model.materials.insert(
                get(row, "Material"),
                [modulus * pressure, value(row, "U12").unwrap_or(0.2)],
            );
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
        member.angle = turned
            .get(&frame)
            .and_then(|row| value(row, "Angle"))
            .unwrap_or(0.0);
        if let Some(row) = released.get(&frame) {
            member.releases = ["I", "J"].map(|end| {
                Member::RELEASES
                    .map(|what| row.get(format!("{what}{end}").as_str()) == Some(&"Yes"))
            });
            if row.get("PartialFix") == Some(&"Yes") {
                return Err(fault(
                    file,
                    member.shown,
                    "has partly fixed ends, whose stiffness is not read",
                    "release or fix its ends in the source and export again",
                ));
            }
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
    let of_area: BTreeMap<String, String> = of("AREA SECTION ASSIGNMENTS")
        .map(|row| (get(row, "Area"), get(row, "Section")))
        .collect();
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
            model.walls.push(Wall {
                property: of_area.get(&area).cloned().unwrap_or_default(),
                shown: format!("area {area}"),
                corners,
            });
        } else {
            floors += 1;
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
    added_masses(
        file,
        of("MASS SOURCE"),
        &mut of("JOINT ADDED MASS ASSIGNMENTS"),
        &joints,
        units,
        facts,
    );
    facts.read.push(format!("{file}: {} joints, {} columns and beams, {floors} floor areas, {} walls, {} levels with a diaphragm", joints.len(), model.members.len(), model.walls.len(), facts.stories.len()));
    facts.text = Some(model);
    facts
        .left_out
        .extend(crate::left_out::lines(file, "tables", &ignored));
    Ok(units)
}

/// Storeys: the heights of joints under diaphragms. SAP2000 has no storeys.
fn levels<'a>(
    diaphragms: &mut dyn Iterator<Item = &'a Row<'a>>,
    assigned: &mut dyn Iterator<Item = &'a Row<'a>>,
    joints: &BTreeMap<String, [f64; 3]>,
    facts: &mut Facts,
) {
    let names: BTreeSet<&str> = diaphragms
        .filter_map(|row| row.get("Name").copied())
        .collect();
    let mut heights: Vec<f64> = assigned
        .filter(|row| {
            row.get("Constraint")
                .is_some_and(|name| names.contains(name))
        })
        .filter_map(|row| joints.get(*row.get("Joint")?))
        .map(|at| at[2])
        .collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| (*a - *b).abs() < ONE_LEVEL);
    facts.stories = heights
        .into_iter()
        .map(|top| Story {
            name: format!("level {top:.3} m"),
            top,
        })
        .collect();
}

/// Masses that were put on joints, where the mass source has no others.
fn added_masses<'a>(
    file: &str,
    mut sources: impl Iterator<Item = &'a Row<'a>>,
    added: &mut dyn Iterator<Item = &'a Row<'a>>,
    joints: &BTreeMap<String, [f64; 3]>,
    units: Units,
    facts: &mut Facts,
) {
    // Follow-up rows of a source have no Elements.
    let source =
        sources.find(|row| row.get("Elements").is_some() && row.get("IsDefault") != Some(&"No"));
    let only_masses = source.is_some_and(|row| {
        row.get("Elements") == Some(&"No")
            && row.get("Loads") == Some(&"No")
            && row.get("Masses") == Some(&"Yes")
    });
    if !only_masses {
        facts.left_out.push(format!("{file}: table MASS SOURCE: masses from elements or loads; masses come from the .OUT file of the analysis instead"));
        return;
    }
    let mut of_level: Vec<Vec<([f64; 2], f64, f64)>> = vec![Vec::new(); facts.stories.len()];
    for row in added {
        let value = |name: &str| row.get(name).and_then(|text| number(text));
        let at = row.get("Joint").and_then(|joint| joints.get(*joint));
        let (Some(at), Some(mass)) = (at, value("Mass1")) else {
            continue;
        };
        let level = facts
            .stories
            .iter()
            .position(|story| (story.top - at[2]).abs() < ONE_LEVEL);
        if let Some(level) = level {
            let mass_and_inertia = (
                mass * units.factor(MASS),
                value("MMI3").unwrap_or(0.0) * units.factor(INERTIA),
            );
            of_level[level].push(([at[0], at[1]], mass_and_inertia.0, mass_and_inertia.1));
        }
    }
    for (story, masses) in facts.stories.iter().zip(of_level) {
        let mass: f64 = masses.iter().map(|mass| mass.1).sum();
        if mass <= 0.0 {
            continue;
        }
        let centre =
            [0, 1].map(|axis| masses.iter().map(|mass| mass.0[axis] * mass.1).sum::<f64>() / mass);
        let inertia = masses.iter().map(|(at, mass, polar)| {
            polar + mass * ((at[0] - centre[0]).powi(2) + (at[1] - centre[1]).powi(2))
        });
        facts.masses.push(FloorMass {
            story: Ok(story.name.clone()),
            diaphragm: story.name.clone(),
            mass: [mass; 2],
            inertia: Some(inertia.sum()),
            centre: Some(centre),
        });
    }
}
