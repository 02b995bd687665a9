//! The reader and the table of keys agree.

use std::collections::BTreeSet;
use std::path::Path;

use super::read_root;
use crate::keys::KEYS;
use crate::reader::Reader;
use crate::source::Source;
use crate::tree::{Format, parse};

/// Models that together have every table of a file.
const ALL_TABLES: [&str; 6] = [
    r#"
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
"#,
    r#"
[motion]
record = "el-centro"
match = { spectrum = { code = "gb50011" } }
[[building]]
column = { EI = 1, mass = 1 }
beam = { width = 1, depth = 1 }
stiffness_factor = { column = 1 }
axial = { columns = "rigid" }
shear = { columns = "flexible" }
base = { horizontal_stiffness = 1, horizontal_hinge = { rule = "normal" }, rotational_stiffness = 1, rotational_hinge = { rule = "normal" } }
joint = { rotational_stiffness = 1 }
damping = { ratio = 0.1 }
foundation = { length = 1 }
isolation = { kind = "friction-pendulum", friction = { slow = 0.03 }, stop = { left = { at = 1 } } }
hinges = { rule = "pinched", pinching = {}, damage = {}, column = { positive = {}, negative = {} } }
[[building]]
kind = "shear"
codes = { importance = 1 }
damper = [{ floors = [0, 1], law = "friction" }]
base = { mass = 1 }
isolation = { kind = "linear", stop = {} }
hinges = { rule = "normal" }
[soil]
coupling = { stiffness = [[1]] }
[[gap]]
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
floor_spectra = { floors = ["A.1"], damping = 0.05, periods = 1, low_pass = 25, order = 4 }
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
"#,
    r#"
[[building]]
kind = "given"
matrices = { stiffness = [[2.0]], mass = [1.0] }
ports = { "1" = { dof = 1, height = 3 } }
[[building]]
kind = "given"
mass = [1.0]
periods = [1.0]
shapes = [[1.0]]
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

#[test]
fn every_key_of_the_table_is_read() {
    let mut asked = BTreeSet::new();
    for text in ALL_TABLES {
        let source = Source::new("model.toml", text);
        let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
        let mut reader = Reader::new(&source);
        // Keys that are not in the table make the reader panic here.
        read_root(&mut reader, &root, Path::new(""));
        asked.extend(reader.asked);
    }
    let source = Source::new("study.toml", STUDY);
    let root = parse(&source, Format::Toml).unwrap_or_else(|error| panic!("{error}"));
    asked.extend(crate::study_file::keys_asked(&source, &root));
    let known: BTreeSet<_> = KEYS.iter().map(|key| (key.section, key.name)).collect();
    let unread: Vec<_> = known.difference(&asked).collect();
    assert!(
        unread.is_empty(),
        "keys in the table that nobody reads: {unread:?}"
    );
}
