//! The reader and the table of keys agree.

use std::cell::LazyCell;
use std::collections::BTreeSet;
use std::path::Path;

use jostle_section::{Reinforcement, Ties};

use super::read_root;
use crate::files::Files;
use crate::keys::{KEYS, Kind, Section};
use crate::quantity::{Dimension, parse_quantity, split_number};
use crate::reader::Reader;
use crate::record::acceleration_unit;
use crate::source::Source;
use crate::tree::{Format, Node, Value, parse};
use crate::unusual::Usual;
use crate::{KnobKind, ModelTree, TreeValue};

/// Models that together have every table of a file.
const ALL_TABLES: [&str; 7] = [
    r#"
[site]
north = 1
[[building]]
kind = "shear"
plan = [{ size = [1, 1] }, { corners = [[0, 0], [1, 0], [1, 1]] }]
mass = [1, 1]
stiffness = [{ x = 1, y = 1, torsion = 1 }, 1]
[[building]]
kind = "shear"
plan = [1, 1]
mass = 1
element = [{ at = [0, 0], stiffness = 1, storeys = [1, 1] }]
[[building]]
kind = "frame"
plan = [1, 1]
mass = 1
frame = [{ at = [0, 0], lines = ["A"], stiffness_factor = { column = 1 }, axial = { columns = "rigid" }, shear = { columns = "flexible" }, joint = {}, rigid_ends = { beams = 1 }, base = { mass = 1 }, column = { EI = 1 }, beam = { EI = 1 } }]
"#,
    r#"
[motion]
record = "el-centro"
read = { skip = 0 }
match = { spectrum = { code = "gb50011" } }
[[building]]
column = { EI = 1, mass = 1 }
beam = { width = 1, depth = 1, profile = "IPE300", axis = "weak", yield_strength = 1, slab = { depth = 0.1, width = 1, spacing = 1, sides = 1 } }
stiffness_factor = { column = 1 }
axial = { columns = "rigid" }
shear = { columns = "flexible" }
base = { horizontal_stiffness = 1, horizontal_hinge = { rule = "normal" }, rotational_stiffness = 1, rotational_hinge = { rule = "normal" } }
joint = { rotational_stiffness = 1, hinge = { rule = "bilinear" } }
rigid_ends = { beams = 1 }
damping = { ratio = 0.1 }
foundation = { length = 1 }
isolation = { kind = "friction-pendulum", friction = { slow = 0.03 }, bounds = { upper = { strength = 2 } }, stop = { left = { at = 1 } } }
hinges = { rule = "pinched", pinching = {}, damage = {}, column = { positive = {}, negative = {} } }
rotation_limit = [{ of = "columns", limits = {} }]
[[building]]
kind = "shear"
codes = { importance = 1 }
damper = [{ floors = [0, 1], law = "friction" }]
soil_spring = [{ floors = 1, hinge = { rule = "pinched" } }]
base = { mass = 1, across = { horizontal_stiffness = 1 } }
isolation = { kind = "triple-friction-pendulum", stop = {} }
hinges = { rule = "normal" }
[soil]
coupling = { stiffness = [[1]] }
[[gap]]
[[gap]]
law = "linear"
crush = { force = 1 }
[[gap]]
law = "formula"
formula = "k * d"
[[link]]
stiffness = 1
[[wall]]
name = "moat"
[[link]]
law = "viscous"
damping = 1
exponent = 1
[[link]]
law = "friction"
[[link]]
law = "yielding"
hinge = { rule = "normal" }
[[link]]
law = "cable"
[[link]]
law = "stopper"
[analysis]
integrator = { method = "hht" }
[output]
members = true
units = "us"
floor_spectra = { floors = ["A.1"], damping = 0.05, periods = 1, low_pass = 25, order = 4 }
[report]
project = "Old town"
client = "City"
author = "Office"
date = "1 May"
silence = ["A12"]
[codes]
show = "asce7"
"#,
    r#"
[motion]
record = "el-centro"
apparent_velocity = 600
coherency = { alpha = 0.1, shear_wave_velocity = 300, seed = 1 }
vertical = { scale = 0.67 }
[[building]]
kind = "shear"
position = 1
motion = { record = "el-centro", arrival = 0, vertical = "el-centro" }
[[wall]]
name = "moat"
position = 2
"#,
    r#"
building = []
motion = { kind = "ricker" }
"#,
    r#"
[[building]]
column = { width = 1, depth = 1, bars = { top = "4 d20" } }
beam = { EI = 1 }
hinges = { rule = "normal", from = "section" }
[[building]]
column = { width = 1, depth = 1, bars = { top = "4 d20" } }
beam = { EI = 1 }
axial = "flexible"
floor_load = 1
hinges = { rule = "fibre", length = 1, steel = { rule = "bilinear" }, limits = { spalling = 0.004 }, beam_rule = "takeda", beam = { yield = 1 } }
[[building]]
column = { EI = 1 }
beam = { EI = 1 }
axial = "flexible"
hinges = { rule = "surface", length = 1, post_yield = 0.1, surface = { axial = [-1, 1], moment = [0, 1] } }
"#,
    r#"
[[building]]
kind = "given"
matrices = { stiffness = [[2.0]], mass = [1.0] }
ports = { "1" = { dof = 1, height = 3 } }
[[building]]
kind = "given"
plan = [1, 1]
at = [0, 0]
angle = 1
isolation = { kind = "linear", stiffness = 1, mat_mass = 1 }
matrices = { stiffness = [[2.0]], mass = [1.0] }
ports = { "1" = { dofs = [1, 2, 3], at = [0, 0], height = 3 } }
[[building]]
kind = "given"
mass = [1.0]
periods = [1.0]
shapes = [[1.0]]
"#,
    r#"
[[building]]
kind = "space-frame"
storeys = 1
mass = 1
elastic_modulus = 3e10
lines_x = [0, 6]
lines_y = [0, 5]
beam_x = { width = 1, depth = 1 }
wall = [{ along = "x", x = 1, length = 1, thickness = 0.2, hinge = { yield = 1 } }]
hinges = { rule = "pinched", column = { x = { yield = 1 } }, beam = { yield = 1 } }
[[building.column]]
size = [1, 1]
hinge = { yield = 1, positive = { yield = 1 } }
[[building.beam_y]]
width = 1
depth = 1
concrete = "C30"
steel = "HRB400"
bars = { top = "4 d20", bottom = "4 d20" }
[[building]]
kind = "space-frame"
storeys = 1
mass = 1
floor_load = 1
elastic_modulus = 3e10
lines_x = [0, 6]
lines_y = [0]
plan = [6, 5]
column = { size = [1, 1], concrete = "C30", steel = "HRB400", bars = "4 d20" }
beam_x = { width = 1, depth = 1, slab = { depth = 0.1, width = 1 } }
brace = [{ along = "x", EA = 1 }]
infill = [{ along = "x", stiffness = 1 }]
joint = { x = { rotational_stiffness = 1, hinge = { rule = "bilinear", yield = 1 } } }
wall = [{ along = "x", x = 1, length = 1, thickness = 0.2, steel = "HRB400", bars = "4 d20", hinge = { rule = "fibre", length = 1 } }]
rigid_ends = { beams = 1 }
hinges = { rule = "fibre", length = 1, beam_rule = "takeda", beam = { yield = 1 } }
[[building]]
kind = "space-frame"
storeys = 1
mass = 1
elastic_modulus = 3e10
lines_x = [0, 6]
lines_y = [0, 5]
column = [{ size = [1, 1] }, { profile = "HEB300", axis = "weak", yield_strength = 1 }]
beam_x = [{ width = 1, depth = 1 }, { profile = "IPE400", axis = "weak", yield_strength = 1 }]
beam_y = { width = 1, depth = 1 }
hinges = { rule = "surface", length = 1, surface = { axial = [-1, 0, 1], moment = [0, 1, 0], across = [0, 1, 0] } }
[[building]]
kind = "frame"
shear_failure = { strength = 1 }
column = { profile = { depth = 1 }, axis = "weak", yield_strength = 1 }
brace = [{ EA = 1 }, { from = "0.1", to = "1.2", EA = 1 }, { stiffness = 1, hinge = { rule = "bilinear", yield = 1 } }, { profile = "HEB160", hinge = { rule = "buckling", curve = "c", yield_strength = 1 } }]
infill = [{ modulus = 1, thickness = 1, width = "mainstone", opening = { length = 0.1 }, strength = { rule = "bertoldi" }, out_of_plane = { density = 1 }, backbone = { rule = "panagiotakos-fardis" } }, { force = 1 }, { stiffness = 1, hinge = { rule = "pinched", residual = 1 } }]
wall = [{ at = 1, length = 1, thickness = 1, hinge = { rule = "takeda", length = 1 } }, { line = 1, length = 1, EI = 1, shear_hinge = { rule = "bilinear", yield = 1, stiffness = 1 } }, { line = 1, length = 1, thickness = 1, bars = { edges = "8 d20", edge_length = 1, web = "16 d10" }, hinge = { rule = "fibre" } }]
coupling_beam = [{ between = [1, 2], width = 1, depth = 1, hinge = { rule = "pinched" } }, { bay = 1, EI = 1 }]
[[building]]
kind = "shear"
plan = [20, 12]
stiffness = { x = 1, y = 1, torsion = 1 }
hinges = { rule = "bilinear", x = { yield = 1 }, y = { yield = 1 } }
"#,
];

/// A study that has every table.
const STUDY: &str = r#"
base = "paper"
[[vary]]
path = "building[0].beam_mass"
distribution = { kind = "lognormal", median = 1, dispersion = 0.1 }
[[vary]]
path = "building[1].beam_mass"
distribution = { kind = "normal", mean = 1, deviation = 0.1 }
[[vary]]
path = "gap[0].width"
range = { from = 1, to = 2, count = 2 }
[design]
samples = 2
[[design.correlation]]
between = ["building[0].beam_mass", "building[1].beam_mass"]
value = 0.5
[[fragility]]
intensity = "x"
[[ida]]
intensity = "x"
demand = "y"
[sensitivity]
responses = ["x"]
[selection]
spectrum = { code = "gb50011", intensity = 7, site = "II", group = 1 }
"#;

/// A map of a comparison that has every table.
const MAP: &str = r#"
table_acceleration = "A0"
[[column]]
measured = "D1"
computed = "J1.floor1.displacement_m"
[[impacts]]
acceleration = "A1"
above = "2 g"
"#;

/// A city file that has every table.
const CITY: &str = r#"
[inventory]
file = "city.geojson"
columns = { storeys = "levels" }
[buildings]
level = { low = 1950 }
[damage]
[gap]
[contact]
[motion]
record = "el-centro-1940-ns"
[run]
"#;

/// A classes file that has every table.
const CLASSES: &str = r#"
[buildings]
[damage]
[class]
types = ["C1"]
storeys = [3]
[neighbour]
types = ["C1"]
storeys = [3]
[pair]
[contact]
[motion]
record = "el-centro-1940-ns"
[intensity]
[run]
"#;

/// Keys that the reader of models asks for.
fn asked_of_models() -> BTreeSet<(Section, &'static str)> {
    let mut asked = BTreeSet::new();
    for text in ALL_TABLES {
        let source = Source::new("model.toml", text);
        let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
        let mut reader = Reader::new(&source);
        // Keys that are not in the table make the reader panic here.
        read_root(&mut reader, &root, &Files::beside(Path::new("")));
        asked.extend(reader.asked);
    }
    asked
}

/// Adds the names of all keys of a tree.
fn add_names(node: &Node, names: &mut BTreeSet<String>) {
    match &node.value {
        Value::Table(table) => {
            for entry in &table.entries {
                names.insert(entry.key.clone());
                add_names(&entry.node, names);
            }
        }
        Value::List(list) => list.iter().for_each(|node| add_names(node, names)),
        _ => {}
    }
}

/// Scans of damaged models reach every key by its name.
#[test]
fn models_of_scans_have_every_key() {
    let mut names = BTreeSet::new();
    for (name, tree) in models_in(&[EXAMPLES, MODELS]) {
        let source = Source::new(&name, tree.text());
        let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
        add_names(&root, &mut names);
    }
    let asked = asked_of_models();
    let missing: Vec<_> = asked
        .iter()
        .filter(|(_, name)| !names.contains(*name))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn every_key_of_the_table_is_read() {
    let mut asked = asked_of_models();
    let source = Source::new("study.toml", STUDY);
    let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    asked.extend(crate::study_file::keys_asked(&source, &root));
    let source = Source::new("map.toml", MAP);
    let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    asked.extend(crate::comparison_map::keys_asked(&source, &root));
    let source = Source::new("city.toml", CITY);
    let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    asked.extend(crate::city_file::keys_asked(&source, &root));
    let source = std::sync::Arc::new(Source::new("classes.toml", CLASSES));
    let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    asked.extend(crate::classes_file::keys_asked(&source, &root));
    let known: BTreeSet<_> = KEYS.iter().map(|key| (key.section, key.name)).collect();
    let unread: Vec<_> = known.difference(&asked).collect();
    assert!(
        unread.is_empty(),
        "keys in the table that nobody reads: {unread:?}"
    );
}

/// Texts between two marks.
fn between(text: &str, mark: char) -> Vec<&str> {
    text.split(mark).skip(1).step_by(2).collect()
}

/// Reads a table of a fragment such as `{ skip = 2 }` with the keys of sections.
fn open_fragment(fragment: &str, sections: &[Section]) -> Result<(), String> {
    let text = format!("x = {fragment}\n");
    let source = Source::new("fragment", &text);
    let root = parse(&source, Format::Toml).map_err(|error| error.to_string())?;
    let Value::Table(table) = &root.value else {
        return Err("no table".into());
    };
    let node = table.get("x").ok_or("no key")?;
    let Value::Table(inside) = &node.value else {
        return Err("no table inside".into());
    };
    let known = |name: &str| {
        KEYS.iter()
            .any(|key| sections.contains(&key.section) && key.name == name)
    };
    match inside
        .entries
        .iter()
        .map(|entry| &entry.key)
        .find(|name| !known(name))
    {
        Some(name) => Err(format!("{name} is no key of {sections:?}")),
        None => Ok(()),
    }
}

#[test]
fn examples_in_the_reference_are_accepted_by_their_readers() {
    for dimension in Dimension::ALL {
        assert!(
            parse_quantity(dimension.example(), dimension).is_ok(),
            "{dimension}"
        );
    }
    let mut tried = 0;
    for key in KEYS {
        let place = format!("{:?}.{}: {}", key.section, key.name, key.doc);
        let plain: Vec<&str> = key.doc.split('`').step_by(2).collect();
        let mut quoted: Vec<&str> = plain.iter().flat_map(|text| between(text, '"')).collect();
        quoted.extend(key.default.iter().flat_map(|text| between(text, '"')));
        for text in &quoted {
            let read = match (key.kind, key.name) {
                // A word in quotes stands for itself.
                (
                    Kind::Quantity(dimension)
                    | Kind::PerStorey(dimension)
                    | Kind::PerContact(dimension)
                    | Kind::OneOrMore(dimension)
                    | Kind::Quantities(dimension)
                    | Kind::WordOr(_, dimension)
                    | Kind::ChoiceOr(_, dimension),
                    _,
                ) if text.starts_with(|c: char| c.is_ascii_digit()) => {
                    parse_quantity(text, dimension)
                        .map(drop)
                        .map_err(|error| error.to_string())
                }
                (_, "bars") => Reinforcement::parse(text)
                    .map(drop)
                    .map_err(|error| error.to_string()),
                (Kind::Text, "top" | "bottom" | "sides") => Reinforcement::rows(text, text, None)
                    .map(drop)
                    .map_err(|error| error.to_string()),
                (Kind::Text, "ties") => Ties::parse(text)
                    .map(drop)
                    .map_err(|error| error.to_string()),
                (_, "unit") if matches!(key.section, Section::Motion) => {
                    acceleration_unit(text).map(drop).ok_or("no unit".into())
                }
                _ => continue,
            };
            tried += 1;
            assert!(read.is_ok(), "{place}: {text}: {read:?}");
        }
        for fragment in between(key.doc, '`')
            .into_iter()
            .filter(|text| text.starts_with('{'))
        {
            let read = match key.kind {
                Kind::Table(section)
                | Kind::TextOrTable(section)
                | Kind::NumberOrTable(section)
                | Kind::NumbersOrTable(section) => open_fragment(fragment, &[section]),
                Kind::TableOf(sections) => open_fragment(fragment, sections),
                Kind::TextOrMotion => open_fragment(fragment, &[Section::Motion]),
                _ => continue,
            };
            tried += 1;
            assert!(read.is_ok(), "{place}: {fragment}: {read:?}");
        }
    }
    assert!(tried >= 25, "{tried} examples");
}

#[test]
fn grades_in_the_reference_are_accepted() {
    let frame = |column: &str| {
        let text = format!(
            r#"
[[building]]
storeys = 1
storey_height = 3
spans = [6]
column = {{ width = 0.5, depth = 0.5, bars = "12 d20 (around)", {column} }}
beam = {{ width = 0.3, depth = 0.6, steel = "HRB400", bars = "4 d25 top, 4 d25 bottom" }}
concrete = "C30"
beam_mass = 3600
hinges = {{ rule = "peak-oriented", from = "section", method = "formula" }}
"#
        );
        super::read_model_text("model.toml", &text, Format::Toml, Path::new(""))
            .map(drop)
            .map_err(|error| error.to_string())
    };
    let doc = |name: &str| {
        let key = KEYS
            .iter()
            .find(|key| key.section == Section::Column && key.name == name);
        key.map_or("", |key| key.doc)
    };
    for (name, grades) in [
        ("concrete", ["C30", "C30/37", "f'c = 4 ksi"].as_slice()),
        (
            "steel",
            ["HRB400", "B500", "Grade 60", "Grade 420"].as_slice(),
        ),
        ("ties", ["d10 @ 100 mm", "4 d10 @ 100 mm"].as_slice()),
    ] {
        for grade in grades {
            assert!(doc(name).contains(grade), "{name} names {grade}");
            let steel = if name == "steel" {
                ""
            } else {
                "steel = \"HRB400\","
            };
            let read = frame(&format!("{steel} {name} = \"{grade}\""));
            assert!(read.is_ok(), "{name} = {grade}: {read:?}");
        }
    }
}

/// A tower with dampers, and one link that is not.
fn damped(dampers: &str) -> String {
    format!(
        r#"
[[building]]
name = "A"
kind = "shear"
storey_height = 3
mass = [4e4, 4e4, 4e4]
stiffness = [3e7, 3e7, 3e7]
{dampers}
[[link]]
between = ["A", "wall"]
floors = [[3, "wall"]]
stiffness = 1e6
"#
    )
}

#[test]
fn dampers_are_links_inside_their_building() {
    let text = damped(
        r#"
[[building.damper]]
floors = [0, 1]
law = "viscous"
damping = "200 kN.(s/m)^0.5"
exponent = 0.5
[[building.damper]]
floors = [[1, 2], [2, 3]]
law = "friction"
slip_force = "60 kN"
stick_stiffness = "100 MN/m"
"#,
    );
    let read = |text: &str| {
        let input = super::read_model_text("model.toml", text, Format::Toml, Path::new(""));
        input.unwrap_or_else(|error| panic!("{error}")).model
    };
    let links = read(&text).links;
    let spelt = damped("")
        + r#"
[[link]]
between = ["A", "A"]
floors = [[0, 1]]
law = "viscous"
damping = "200 kN.(s/m)^0.5"
exponent = 0.5
[[link]]
between = ["A", "A"]
floors = [[1, 2], [2, 3]]
law = "friction"
slip_force = "60 kN"
stick_stiffness = "100 MN/m"
"#;
    assert_eq!(links, read(&spelt).links);
    assert_eq!(links.len(), 3);
}

#[test]
fn faults_of_dampers_point_to_them() {
    let text = damped(
        r#"
[[building.damper]]
floors = [0, 7]
damping = 1e5
[[building.damper]]
floors = [[1, 2], [2, 2]]
law = "friction"
slip_force = 0
stick_stiffness = 1e8
[[building.damper]]
floors = [1]
damping = 1e5
[[building.damper]]
law = "cable"
slip_force = 1
"#,
    );
    let error = super::read_model_text("model.toml", &text, Format::Toml, Path::new(""))
        .expect_err("it has faults")
        .to_string();
    let first = error.clone();
    // Faults of the reader hide those of the model.
    for wanted in [
        "building[0].damper[2].floors: expected two floors, such as [0, 1]",
        "building[0].damper[3].floors: is missing",
        "building[0].damper[3].slip_force: has no meaning for law = \"cable\"",
    ] {
        assert!(first.contains(wanted), "{wanted} in {first}");
    }
    let text = text.replace("floors = [1]\n", "floors = [1, 2]\n");
    let text = text
        .split("[[building.damper]]\nlaw")
        .next()
        .unwrap_or("")
        .to_owned();
    let error = super::read_model_text("model.toml", &text, Format::Toml, Path::new(""))
        .expect_err("it has faults")
        .to_string();
    for wanted in [
        "building[0].damper[0].floors: floor 7 does not exist",
        "building[0].damper[1].floors[1]: names the same floor twice",
        "building[0].damper[1].slip_force: must be greater than 0",
    ] {
        assert!(error.contains(wanted), "{wanted} in {error}");
    }
}

#[test]
fn bearings_stand_at_places_of_a_plan() {
    let text = |keys: &str| {
        format!(
            r#"
[[building]]
kind = "shear"
{keys}
mass = [4e5]
storey_height = ["3 m"]
damping = {{ ratio = 0.02 }}
"#
        )
    };
    let read = |keys: &str| {
        super::read_model_text("model.toml", &text(keys), Format::Toml, Path::new(""))
            .map_err(|error| error.to_string())
    };
    let model = read(
        r#"plan = ["20 m", "12 m"]
at = ["100 m", "-3 m"]
stiffness = [{ x = 1e8, y = 1e8, torsion = 1e10 }]
isolation = { kind = "linear", stiffness = 1e7, mat_mass = 1e5, bearings = [["1 m", "1 m"], ["19 m", "11 m"]] }"#,
    );
    let model = model.unwrap_or_else(|error| panic!("{error}"));
    let jostle::Structure::Tiers(tiers) = &model.model.buildings[0].structure else {
        panic!("it has a plan");
    };
    assert_eq!(tiers.bearings, [[101.0, -2.0], [119.0, 8.0]]);
    let plane = read(
        r#"stiffness = [1e8]
isolation = { kind = "linear", stiffness = 1e7, mat_mass = 1e5, bearings = [["1 m", "1 m"]] }"#,
    );
    let error = plane.expect_err("it has no plan");
    assert!(
        error.contains("building[0].isolation.bearings: is for a building with a plan"),
        "{error}"
    );
    let number = read(
        r#"plan = ["20 m", "12 m"]
stiffness = [1e8]
isolation = { kind = "linear", stiffness = 1e7, mat_mass = 1e5, bearings = 4 }"#,
    );
    let error = number.expect_err("it is no list");
    assert!(error.contains("expected a list of places"), "{error}");
}

#[test]
fn every_quantity_says_which_values_are_usual() {
    for key in KEYS {
        let place = format!("{:?}.{}", key.section, key.name);
        assert_eq!(
            key.usual != Usual::NoQuantity,
            key.kind.is_quantity(),
            "{place}: a quantity says what is usual, or why nothing is; other keys say nothing"
        );
        if let Usual::Within(range) = key.usual {
            let [[low, high], [least, most]] = [range.usual, range.possible];
            assert!(least <= low && low < high && high <= most, "{place}");
            assert!(high / low < 1e12, "{place}: a slip of 10^6 can stay inside");
        }
    }
}

/// Models that are shipped as files: they have nearly every key.
const EXAMPLES: &str = "../../examples";
/// Models with the keys that no shipped model has.
const MODELS: &str = "tests/reading/models";

/// Models of folders, and of all templates, with values of real buildings.
fn models_in(folders: &[&str]) -> Vec<(String, ModelTree)> {
    let entries = folders.iter().flat_map(|folder| {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        std::fs::read_dir(folder).expect("models").flatten()
    });
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    paths.sort();
    let named = paths.iter().filter_map(|path| {
        let tree = ModelTree::load(path).ok()?;
        tree.input().ok()?;
        Some((path.file_stem()?.to_string_lossy().into_owned(), tree))
    });
    let mut found: Vec<_> = named.collect();
    let templates = crate::TEMPLATE_NAMES.iter();
    found.extend(templates.filter_map(|name| {
        let text = crate::template(name, "m")?;
        let tree = ModelTree::parse(name, &text, Format::Toml, Path::new("")).ok()?;
        tree.input().ok()?;
        Some(((*name).to_owned(), tree))
    }));
    // Every key is varied in the first model that has it: those whose sections take long to bend come last.
    found.sort_by_key(|(_, tree)| tree.text().matches("bars = ").count());
    found
}

/// What reading a model says: its faults, or its warnings with those of its motion and of what is assembled.
fn said(tree: &ModelTree, all: bool) -> Result<Vec<String>, ()> {
    let mut input = tree.input().map_err(|_| ())?;
    if !all {
        return Ok(input.warnings);
    }
    if input.motion.is_some() {
        let motion = input.ground_motion().map_err(|_| ())?;
        let unusual = input.unusual_motion(&motion);
        input.warnings.extend(unusual);
    }
    let system = jostle::System::assemble(&input.model).map_err(|_| ())?;
    input.note_system(&system);
    Ok(input.warnings)
}

/// A value of any key that is a million times too large or too small, or has the wrong sign, is warned of or refused.
#[test]
fn no_slip_of_a_unit_is_taken_in_silence() {
    let (mut silent, mut tried) = (Vec::new(), BTreeSet::new());
    for (name, tree) in models_in(&[EXAMPLES, MODELS]) {
        let before = said(&tree, false);
        let assembled = LazyCell::new(|| said(&tree, true));
        let mut knobs = tree.knobs();
        knobs.retain(|knob| {
            knob.value.is_some() && !matches!(knob.kind, KnobKind::Count | KnobKind::Flag)
        });
        for knob in knobs {
            let plain: String = strip_indices(&knob.path);
            let last = plain.rsplit('.').next().unwrap_or_default();
            let keys = || KEYS.iter().filter(|key| key.name == last);
            let ranges: Vec<_> = keys()
                .filter_map(|key| match key.usual {
                    Usual::Within(range) => Some(range),
                    _ => None,
                })
                .collect();
            if ranges.is_empty() || !tried.insert((plain.clone(), knob.unit.clone())) {
                continue;
            }
            for factor in [1e-9, 1e-6, 1e6, 1e9, -1.0] {
                if factor < 0.0 && ranges.iter().any(|range| range.signed) {
                    continue;
                }
                let mut changed = tree.clone();
                if changed.multiply(&knob.path, factor).is_err()
                    || all_zero(&tree.values(&knob.path))
                {
                    continue;
                }
                let quick = said(&changed, false);
                if quick.is_err() || quick != before {
                    continue;
                }
                let changed = said(&changed, true);
                if changed.is_ok() && changed == *assembled {
                    let value = knob.value.clone().unwrap_or_default();
                    silent.push(format!("{name}: {} = {value} times {factor}", knob.path));
                }
            }
        }
    }
    assert!(tried.len() > 100, "only {} keys were tried", tried.len());
    assert!(silent.is_empty(), "{}", silent.join("\n"));
}

/// A path without what stands in brackets.
fn strip_indices(path: &str) -> String {
    let pieces = path.split('[');
    pieces
        .map(|piece| piece.split_once(']').map_or(piece, |(_, rest)| rest))
        .collect()
}

/// Whether all numbers are zero.
fn all_zero(values: &[TreeValue]) -> bool {
    values.iter().all(|value| match value {
        TreeValue::Integer(value) => *value == 0,
        TreeValue::Number(value) => *value == 0.0,
        TreeValue::Text(text) => split_number(text).is_some_and(|(number, _)| number == 0.0),
        TreeValue::List(list) => all_zero(list),
        _ => false,
    })
}
