//! Buildings of walls, of columns made of fibres, of steel with panels that crack, on foundations that lift off, and on bearings of several sliding surfaces, beside a
//! neighbour.

use jostle::Solver;
use jostle_io::{Format, read_model_text};

use super::pinned::Pinned;

const WALLED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "W"
storeys = 2
storey_height = "3 m"
spans = ["5 m"]
concrete = "C30"
floor_mass = "60 t"
wall = [
  { line = 1, length = "2 m", thickness = "200 mm", hinge = { rule = "bilinear", stiffness = "20 GN.m/rad", yield = "400 kN.m", post_yield = 0.02 } },
  { line = 2, length = "2 m", thickness = "200 mm" },
]
coupling_beam = [{ between = [1, 2], width = "200 mm", depth = "600 mm" }]
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["W", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const FIBRED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "F"
storeys = 1
storey_height = "3 m"
spans = ["4 m"]
column = { width = "400 mm", depth = "400 mm", concrete = "C30", steel = "HRB400", bars = "8 d20" }
beam = { EI = "100 MN.m2" }
floor_mass = "60 t"
axial = "flexible"
elastic_modulus = "30 GPa"
gravity = true
hinges = { rule = "fibre", length = "0.3 m", fibres = 8, ends = "base" }
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["F", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const LIFTING: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "L"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
gravity = true
foundation = { length = "4 m", width = "6 m", mass = "100 t", uplift = true, springs = 5, vertical_stiffness = "800 MN/m" }
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["L", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const PANELLED: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "P"
storeys = 2
storey_height = "3 m"
spans = ["5 m"]
floor_mass = "60 t"
column = { profile = "HEB300" }
beam = { width = "300 mm", depth = "500 mm", slab = { depth = "150 mm", width = "en1992", spacing = "4 m" } }
concrete = "C30"
infill = [{ modulus = "3 GPa", thickness = "150 mm", width = "bertoldi", opening = 0.2, strength = { rule = "bertoldi", compression = "3 MPa", shear = "0.2 MPa", sliding = "0.2 MPa" } }]
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["P", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const ON_PENDULUMS: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "T"
kind = "shear"
mass = ["100 t", "100 t"]
stiffness = "200 MN/m"
storey_height = "3 m"
isolation = { kind = "triple-friction-pendulum", mat_mass = "100 t", radius = ["0.8 m", "0.2 m", "0.2 m", "0.8 m"], friction = [0.04, 0.015, 0.015, 0.08], capacity = ["30 mm", "10 mm", "10 mm", "30 mm"] }
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["T", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const FIBRED_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2 s", across = { record = "el-centro-1940-ns", pga = "0.4 g", duration = "2 s" } }
[[building]]
name = "S"
kind = "space-frame"
storeys = 1
storey_height = "3 m"
lines_x = [0, 4]
lines_y = [0]
plan = [["-0.2 m", "-0.2 m"], ["4.2 m", "-0.2 m"], ["4.2 m", "0.2 m"], ["-0.2 m", "0.2 m"]]
elastic_modulus = "30 GPa"
mass = "60 t"
column = { size = ["400 mm", "400 mm"], concrete = "C30", steel = "HRB400", bars = "8 d20" }
beam_x = { width = "250 mm", depth = "500 mm" }
beam_y = { width = "250 mm", depth = "500 mm" }
axial = "flexible"
gravity = true
hinges = { rule = "fibre", length = "0.3 m", fibres = [6, 6], ends = "base" }
"#;

const FIBRED_WALL: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "W"
storeys = 3
storey_height = "3 m"
spans = ["5 m", "4 m"]
concrete = "C30"
column = { width = "400 mm", depth = "400 mm" }
beam = { width = "300 mm", depth = "500 mm" }
floor_mass = "60 t"
gravity = true
wall = [{ line = 2, length = "2 m", thickness = "200 mm", steel = "HRB400", bars = { edges = "6 d16", edge_length = "400 mm", web = "8 d10" }, ties = "d8 @ 100 mm", hinge = { rule = "fibre", length = "0.8 m", fibres = 12 } }]
brace = [{ from = "1.1", to = "3.3", EA = "300 MN", hinge = { rule = "bilinear", yield = "150 kN", post_yield = 0.02 } }]
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["W", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const FIBRED_WALL_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2 s", across = { record = "el-centro-1940-ns", pga = "0.4 g", duration = "2 s" } }
[[building]]
name = "V"
kind = "space-frame"
storeys = 2
storey_height = "3 m"
lines_x = [0, 5]
lines_y = [0, 4]
concrete = "C30"
mass = "60 t"
column = { size = ["400 mm", "400 mm"] }
beam_x = { width = "250 mm", depth = "500 mm" }
beam_y = { width = "250 mm", depth = "500 mm" }
gravity = true
wall = [{ along = "y", x = 1, length = "2 m", thickness = "200 mm", steel = "HRB400", bars = { edges = "6 d16", edge_length = "400 mm", web = "8 d10" }, ties = "d8 @ 100 mm", hinge = { rule = "fibre", length = "0.8 m", fibres = [12, 2] } }]
"#;

const ON_SURFACES: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.5 g", duration = "2.5 s" }
[[building]]
name = "S"
storeys = 2
storey_height = "3 m"
spans = ["4 m"]
column = { width = "400 mm", depth = "400 mm", concrete = "C30", steel = "HRB400", bars = "8 d20" }
beam = { EI = "100 MN.m2" }
floor_mass = "40 t"
axial = "flexible"
elastic_modulus = "30 GPa"
gravity = true
hinges = { rule = "surface", length = "0.3 m", post_yield = 0.02 }
[[building]]
name = "N"
kind = "shear"
mass = ["50 t", "50 t"]
stiffness = "60 MN/m"
storey_height = "3 m"
[[gap]]
between = ["S", "N"]
width = "10 mm"
law = "kelvin-no-tension"
stiffness = "400 MN/m"
"#;

const ON_SURFACES_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.8 g", duration = "2.5 s", across = { record = "el-centro-1940-ns", pga = "0.6 g", duration = "2.5 s" } }
[[building]]
name = "S"
kind = "space-frame"
storeys = 2
storey_height = "3 m"
lines_x = [0, 4]
lines_y = [0, 5]
elastic_modulus = "30 GPa"
mass = "80 t"
column = { size = ["450 mm", "350 mm"], concrete = "C30", steel = "HRB400", bars = "8 d20" }
beam_x = { width = "300 mm", depth = "500 mm" }
beam_y = { width = "300 mm", depth = "500 mm" }
gravity = true
hinges = { rule = "surface", length = "0.3 m", post_yield = 0.02 }
"#;

const FAILING_IN_SPACE: &str = r#"
motion = { record = "el-centro-1940-ns", pga = "0.6 g", duration = "2.5 s", angle = "25 deg" }
[[building]]
name = "G"
kind = "space-frame"
storeys = 2
storey_height = "3 m"
lines_x = ["0 m", "5 m"]
lines_y = ["0 m", "4 m"]
mass = "40 t"
concrete = "C30"
damping = { ratio = 0.05 }
column = { size = ["400 mm", "400 mm"] }
beam_x = { width = "250 mm", depth = "500 mm" }
beam_y = { width = "250 mm", depth = "500 mm" }
axial = "flexible"
joint = { x = { rotational_stiffness = "60 MN.m/rad", hinge = { rule = "bilinear", yield = "90 kN.m", post_yield = 0.03 } }, y = { rotational_stiffness = "50 MN.m/rad", hinge = { rule = "takeda", cracking = "40 kN.m", yield = "80 kN.m", post_cracking = 0.4, post_yield = 0.03 } } }
shear_failure = { strength = "70 kN", slope = "3 MN/m", residual = 0.3 }
brace = [{ from = "0.1.1", to = "2.2.2", EA = "120 MN", hinge = { rule = "bilinear", yield = "120 kN", post_yield = 0.02 } }]
infill = [{ along = "y", x = 1, y = 1, storeys = 2, stiffness = "20 MN/m", mass = "2 t" }]
"#;

/// Every model.
pub(super) fn models() -> Vec<Pinned> {
    let all = [
        ("walls", WALLED),
        ("fibres", FIBRED),
        ("wall of fibres", FIBRED_WALL),
        ("surfaces", ON_SURFACES),
        ("lifting", LIFTING),
        ("fibres in space", FIBRED_IN_SPACE),
        ("walls of fibres in space", FIBRED_WALL_IN_SPACE),
        ("surfaces in space", ON_SURFACES_IN_SPACE),
        ("shear, connections and braces in space", FAILING_IN_SPACE),
        ("panels", PANELLED),
        ("pendulums", ON_PENDULUMS),
    ];
    let model = |(name, text): (&str, &str)| Pinned {
        name: name.to_owned(),
        input: read_model_text(name, text, Format::Toml, "".as_ref())
            .map_err(|error| error.to_string()),
        solvers: vec![Solver::Riccati, Solver::Stiffness],
    };
    all.into_iter().map(model).collect()
}
