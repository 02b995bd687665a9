//! `jostle schema --combinations`: which kind of building has which feature, asked of the program itself.

use std::fmt::Write;

use jostle::pushover::{LoadPattern, PushDirection};
use jostle_export::{Export, openseespy};
use jostle_io::{Format, read_model_text};
use jostle_run::{Opened, RunError, pushed_buildings};

/// A kind of building: its name, keys of one building, its tables, and what the gap beside it needs.
struct Kind {
    name: &'static str,
    keys: &'static str,
    tables: &'static str,
    in_plan: bool,
}

/// Something that a model may ask for.
struct Feature {
    name: &'static str,
    /// Keys of the motion.
    motion: &'static str,
    /// Keys of the analysis.
    analysis: &'static str,
    /// Keys of both buildings, after their own.
    keys: &'static str,
    /// Tables of both buildings.
    tables: &'static str,
    /// Keys of the gap; what it has by itself is left out where they begin with the same word.
    gap: &'static str,
    /// Further tables of the model.
    more: &'static str,
    /// Height of the lowest storey of the second building \[m\].
    first_storey: f64,
    then: Then,
}

/// What follows the reading of a model.
#[derive(Clone, Copy, PartialEq)]
enum Then {
    Plan,
    /// Some member must be compared with its capacity.
    Rate,
    Push,
    Export,
}

const USUAL: Feature = Feature {
    name: "contact of floors at equal height",
    motion: "",
    analysis: "",
    keys: "",
    tables: "",
    gap: "",
    more: "",
    first_storey: 3.0,
    then: Then::Plan,
};

const KINDS: [Kind; 7] = [
    Kind {
        name: "frame",
        keys: "kind = \"frame\"\nspans = [5, 5]\nconcrete = \"C30\"\ncolumn = { width = 0.5, depth = 0.5 }\nbeam = { width = 0.3, depth = 0.6 }\nbeam_mass = 4000\n",
        tables: "",
        in_plan: false,
    },
    Kind {
        name: "shear",
        keys: "kind = \"shear\"\nmass = \"40 t\"\nstiffness = \"60 MN/m\"\n",
        tables: "",
        in_plan: false,
    },
    Kind {
        name: "given",
        keys: "kind = \"given\"\nmatrices = { stiffness = [[120e6, -60e6], [-60e6, 60e6]], mass = [40e3, 40e3] }\nports = { \"1\" = { dof = 1, height = FIRST }, \"2\" = { dof = 2, height = SECOND } }\n",
        tables: "",
        in_plan: false,
    },
    Kind {
        name: "shear, plan",
        keys: "kind = \"shear\"\nplan = [10, 8]\nmass = \"40 t\"\nstiffness = { x = \"60 MN/m\", y = \"60 MN/m\", torsion = \"2 GN.m/rad\" }\n",
        tables: "",
        in_plan: true,
    },
    Kind {
        name: "frame, plan",
        keys: "kind = \"frame\"\nplan = [10, 8]\nmass = \"40 t\"\n",
        tables: "[[building.frame]]\nat = [[0, 0], [0, 8]]\nspans = [5, 5]\nconcrete = \"C30\"\ndensity = 2400\naxial = \"flexible\"\ncolumn = { width = 0.5, depth = 0.5 }\nbeam = { width = 0.3, depth = 0.6 }\n[[building.frame]]\nname = \"across\"\nat = [[0, 0], [10, 0]]\ndirection = \"y\"\nspans = [4, 4]\nconcrete = \"C30\"\ndensity = 2400\naxial = \"flexible\"\ncolumn = { width = 0.5, depth = 0.5 }\nbeam = { width = 0.3, depth = 0.6 }\n",
        in_plan: true,
    },
    Kind {
        name: "space-frame",
        keys: "kind = \"space-frame\"\nlines_x = [0, 5, 10]\nlines_y = [0, 4, 8]\nmass = \"40 t\"\nconcrete = \"C30\"\nbeam_x = { width = 0.3, depth = 0.6 }\nbeam_y = { width = 0.3, depth = 0.6 }\ncolumn = { size = [0.5, 0.5] }\n",
        tables: "",
        in_plan: true,
    },
    Kind {
        name: "given, plan",
        keys: "kind = \"given\"\nplan = [10, 8]\nmatrices = { stiffness = STIFFNESS, mass = MASS }\nports = { \"1\" = { dofs = [1, 2, 3], height = FIRST }, \"2\" = { dofs = [4, 5, 6], height = SECOND } }\n",
        tables: "",
        in_plan: true,
    },
];

/// A wall in the words of a space frame.
const WALL_OF_A_GRID: &str =
    "[[building.wall]]\nalong = \"x\"\nx = 1\nlength = 2\nthickness = 0.25\n";

/// Yielding of every kind in its own words.
const YIELDING: [&str; 7] = [
    "hinges = { rule = \"bilinear\", column = { yield = \"300 kN.m\", post_yield = 0.01 }, beam = { yield = \"200 kN.m\", post_yield = 0.01 } }\n",
    "hinges = { rule = \"bilinear\", yield = \"5 mm\", post_yield = 0.05 }\n",
    "hinges = { rule = \"bilinear\", yield = \"200 kN\", post_yield = 0.05 }\n",
    "hinges = { rule = \"bilinear\", x = { yield = \"5 mm\", post_yield = 0.05 }, y = { yield = \"5 mm\", post_yield = 0.05 } }\n",
    "",
    "hinges = { rule = \"bilinear\", column = { yield = \"300 kN.m\", post_yield = 0.01 }, beam = { yield = \"200 kN.m\", post_yield = 0.01 } }\n",
    "hinges = { rule = \"bilinear\", x = { yield = \"5 mm\", post_yield = 0.05 }, y = { yield = \"5 mm\", post_yield = 0.05 } }\n",
];

const OWN_WORDS: &str = "YIELDING";

/// Columns that differ by line, one of them omitted, in the words of every kind; instead of those that are alike.
const BY_LINE: [&str; 7] = [
    FRAME_BY_LINE,
    "column = { line = 2, EI = 60e6 }\n",
    "column = { line = 2, EI = 60e6 }\n",
    "column = { line = 2, EI = 60e6 }\n",
    FRAME_BY_LINE,
    "column = [{ size = [0.5, 0.5] }, { x = 2, size = [0.6, 0.6] }, { x = 3, y = 3, storeys = 2, omit = true }]\n",
    "column = { line = 2, EI = 60e6 }\n",
];

const FRAME_BY_LINE: &str = "column = [{ width = 0.5, depth = 0.5 }, { line = 2, width = 0.6, depth = 0.6 }, { line = 3, storeys = 2, omit = true }]\n";

const COLUMNS: &str = "COLUMNS";

/// Stands for columns and beams with bars and ties.
const BARS: &str = "BARS";

/// Gives columns and beams of a text bars and ties.
fn with_bars(text: &str) -> String {
    let bars = ", steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 100 mm\" }";
    let ends = ["depth = 0.5 }", "depth = 0.6 }", "size = [0.5, 0.5] }"];
    let with = |end: &str| end.replace(" }", bars);
    ends.into_iter()
        .fold(text.to_owned(), |text, end| text.replace(end, &with(end)))
}

const JOINT: &str = "joint = { rotational_stiffness = \"40 MN.m/rad\", hinge = { rule = \"bilinear\", yield = \"180 kN.m\", post_yield = 0.03 } }\n";

/// Whether keys belong to the frames of a building that has some at lines of its plan.
fn of_frames(keys: &str) -> bool {
    keys == JOINT || keys.starts_with("shear_failure")
}

/// Stands for columns whose ends are made of fibres.
const FIBRES: &str = "FIBRES";

/// Hinges of these.
const HINGES_OF_FIBRES: &str = "hinges = { rule = \"fibre\", length = \"0.4 m\" }\n";

/// All keys of these, where they are possible.
fn of_fibres(kind: &str) -> Option<&'static str> {
    match kind {
        "frame" => Some(OF_FIBRES),
        "frame, plan" => Some(OF_FIBRES_IN_PLAN),
        "space-frame" => Some(OF_FIBRES_IN_SPACE),
        _ => None,
    }
}

const OF_FIBRES_IN_SPACE: &str = "column = { size = [0.5, 0.5], steel = \"HRB400\", bars = \"12 d20\" }\ngravity = true\nhinges = { rule = \"fibre\", length = \"0.4 m\" }\n";

/// Columns of a frame at lines of a plan whose ends are made of fibres.
const OF_FIBRES_IN_PLAN: &str = "column = { width = 0.5, depth = 0.5, steel = \"HRB400\", bars = \"12 d20\" }\nhinges = { rule = \"fibre\", length = \"0.4 m\" }\n";

/// Stands for columns that yield on a surface: those of fibres with another rule.
const SURFACES: &str = "SURFACES";

const OF_FIBRES: &str = "column = { width = 0.5, depth = 0.5, concrete = \"C30\", steel = \"HRB400\", bars = \"12 d20\" }\naxial = \"flexible\"\ngravity = true\nhinges = { rule = \"fibre\", length = \"0.4 m\" }\n";

#[rustfmt::skip]
fn features() -> Vec<Feature> {
    let link = |name, law| Feature { name, more: law, ..USUAL };
    vec![
        USUAL,
        Feature { name: "contact of slabs with columns between floors", gap: "floors = \"all\"\n", first_storey: 4.5, ..USUAL },
        Feature { name: "friction along faces", gap: "friction = 0.4\n", ..USUAL },
        Feature { name: "contact law `restitution`", gap: "law = \"restitution\"\nrestitution = 0.65\n", ..USUAL },
        Feature { name: "contact law `rubber`", gap: "law = \"rubber\"\nstiffness = \"80 MN/m\"\nthickness = \"40 mm\"\n", ..USUAL },
        Feature { name: "contact dashpot", gap: "law = \"kelvin-no-tension\"\nstiffness = \"400 MN/m\"\ndamping = \"1.1 MN.s/m\"\n", ..USUAL },
        Feature { name: "crushing gap", gap: "law = \"linear\"\nstiffness = \"200 MN/m\"\ncrush = { force = \"600 kN\", hardening = 0.05 }\n", ..USUAL },
        Feature { name: "rigid wall", more: "[[gap]]\nbetween = [\"wall\", \"A\"]\nwidth = 0.02\nlaw = \"hertz\"\nstiffness = 2e9\n", ..USUAL },
        Feature { name: "flexible wall", more: "[[wall]]\nname = \"moat\"\nstiffness = \"120 MN/m\"\nmass = \"25 t\"\n[[gap]]\nbetween = [\"moat\", \"A\"]\nwidth = 0.02\nlaw = \"hertz\"\nstiffness = 2e9\n", ..USUAL },
        link("linear link between neighbours", "[[link]]\nbetween = [\"A\", \"B\"]\nfloors = [[1, 1]]\nstiffness = \"20 MN/m\"\n"),
        link("viscous link between neighbours", "[[link]]\nbetween = [\"A\", \"B\"]\nfloors = [[1, 1]]\nlaw = \"viscous\"\ndamping = \"200 kN.s/m\"\n"),
        link("yielding link between neighbours", "[[link]]\nbetween = [\"A\", \"B\"]\nfloors = [[1, 1]]\nlaw = \"yielding\"\nstiffness = \"20 MN/m\"\nhinge = { rule = \"bilinear\", yield = \"100 kN\", post_yield = 0.05 }\n"),
        Feature { name: "soil beside a basement", tables: "[[building.soil_spring]]\nfloors = 1\nstiffness = \"200 MN/m\"\nstrength = \"1 MN\"\ngapping = true\n", ..USUAL },
        Feature { name: "dampers inside a building", tables: "[[building.damper]]\nfloors = [0, 1]\ndamping = \"200 kN.s/m\"\n", ..USUAL },
        Feature { name: "columns by line", keys: COLUMNS, ..USUAL },
        Feature { name: "elevation of the base", keys: "elevation = \"-1.4 m\"\n", ..USUAL },
        Feature { name: "braces", tables: "[[building.brace]]\nEA = \"300 MN\"\n", ..USUAL },
        Feature { name: "braces over several storeys", tables: "[[building.brace]]\nfrom = \"0.1\"\nto = \"2.2\"\nEA = \"300 MN\"\n", ..USUAL },
        Feature { name: "infill panels", tables: "[[building.infill]]\nstiffness = \"80 MN/m\"\n", ..USUAL },
        Feature { name: "infill panels that fall out", tables: "[[building.infill]]\nmodulus = \"4 GPa\"\nthickness = 0.2\nwidth = \"mainstone\"\nout_of_plane = { strength = \"4 kPa\", density = 1400, remove = true }\n", ..USUAL },
        Feature { name: "struts between joints", tables: "[[building.infill]]\nstiffness = \"80 MN/m\"\noffset = \"300 mm\"\n", ..USUAL },
        Feature { name: "walls", tables: "[[building.wall]]\nline = 1\nlength = 2\nEI = \"2 GN.m2\"\nEA = \"5 GN\"\nGA = \"2 GN\"\nmass = 0\n", ..USUAL },
        Feature { name: "walls that yield at the ends of every storey", tables: "[[building.wall]]\nline = 1\nlength = 2\nEI = \"2 GN.m2\"\nEA = \"5 GN\"\nGA = \"2 GN\"\nmass = 0\nhinge = { rule = \"bilinear\", ends = \"all\", initial = 100, yield = \"2 MN.m\", post_yield = 0.02 }\n", keys: OWN_WORDS, ..USUAL },
        Feature { name: "fibre sections at the feet of walls", tables: "[[building.wall]]\nline = 1\nlength = 2\nthickness = 0.25\nconcrete = \"C30\"\nsteel = \"HRB400\"\nbars = { edges = \"6 d16\", edge_length = 0.4, web = \"8 d10\" }\nhinge = { rule = \"fibre\", length = 0.5 }\n", keys: "gravity = true\n", ..USUAL },
        Feature { name: "cracking and yielding", keys: OWN_WORDS, ..USUAL },
        Feature { name: "fibre columns", keys: FIBRES, ..USUAL },
        Feature { name: "columns that yield on a surface of axial force and moment", keys: SURFACES, ..USUAL },
        Feature { name: "connections of beams that yield", keys: JOINT, ..USUAL },
        Feature { name: "columns that fail in shear", keys: "shear_failure = { strength = \"300 kN\", slope = \"5 MN/m\" }\n", ..USUAL },
        Feature { name: "rotation limits", keys: OWN_WORDS, tables: "[[building.rotation_limit]]\nof = \"columns\"\nlimits = { io = 0.005 }\n", ..USUAL },
        Feature { name: "springs under the base", keys: "base = { horizontal_stiffness = \"400 MN/m\" }\n", ..USUAL },
        Feature { name: "base that sways, rocks and twists", keys: "base = { horizontal_stiffness = \"400 MN/m\", rotational_stiffness = \"9 GN.m/rad\", torsional_stiffness = \"9 GN.m/rad\" }\n", ..USUAL },
        Feature { name: "bearings", tables: "[building.isolation]\nkind = \"lead-rubber\"\nmat_mass = \"50 t\"\nstiffness = \"20 MN/m\"\nyield = \"60 kN\"\npost_yield = 0.1\n", ..USUAL },
        Feature { name: "triple friction pendulums", tables: "[building.isolation]\nkind = \"triple-friction-pendulum\"\nmat_mass = \"50 t\"\nradius = [2.1, 0.3, 0.3, 2.1]\nfriction = [0.04, 0.015, 0.015, 0.08]\ncapacity = [0.3, 0.05, 0.05, 0.3]\n", ..USUAL },
        Feature { name: "foundation on soil", tables: "[building.foundation]\nlength = \"9 m\"\nwidth = \"12 m\"\nmass = \"120 t\"\n", more: "[soil]\nshear_wave_velocity = \"200 m/s\"\ndensity = 1900\npoisson_ratio = 0.33\n", ..USUAL },
        Feature { name: "foundation with uplift", keys: "gravity = true\n", tables: "[building.foundation]\nlength = \"9 m\"\nwidth = \"12 m\"\nmass = \"120 t\"\nuplift = true\nsprings = 5\nvertical_stiffness = \"900 MN/m\"\n", ..USUAL },
        Feature { name: "column uplift", keys: "gravity = true\nbase = { vertical_stiffness = \"400 MN/m\", uplift = true }\n", ..USUAL },
        Feature { name: "P-Delta", keys: "p_delta = true\n", ..USUAL },
        Feature { name: "run that starts under self weight", keys: "gravity = true\n", ..USUAL },
        Feature { name: "one damping ratio for all modes", keys: "damping = { ratio = 0.05, modes = \"all\" }\n", ..USUAL },
        Feature { name: "two horizontal components", motion: "angle = \"30 deg\"\n", ..USUAL },
        Feature { name: "vertical shaking", motion: "vertical = { kind = \"sine\", amplitude = 1, period = 0.1 }\n", ..USUAL },
        Feature { name: "vertical shaking of a building under self weight", keys: "gravity = true\n", motion: "vertical = { kind = \"sine\", amplitude = 1, period = 0.1 }\n", ..USUAL },
        Feature { name: "different motion under each building", keys: "motion = { arrival = \"40 ms\" }\n", ..USUAL },
        Feature { name: "forces of columns and beams", more: "[output]\nmembers = true\n", ..USUAL },
        Feature { name: "demand over capacity of columns and beams", keys: BARS, more: "[output]\ncapacity = true\n", then: Then::Rate, ..USUAL },
        Feature { name: "solver `modal`", analysis: "solver = \"modal\"\n", ..USUAL },
        Feature { name: "solver `riccati`", analysis: "solver = \"riccati\"\n", ..USUAL },
        Feature { name: "solver `series`", analysis: "solver = \"series\"\n", ..USUAL },
        Feature { name: "solver `product`", analysis: "solver = \"product\"\n", ..USUAL },
        Feature { name: "pushover", then: Then::Push, ..USUAL },
        Feature { name: "export to OpenSees", then: Then::Export, ..USUAL },
    ]
}

/// The table in Markdown: every kind of building with every feature, and what the program says of those that are not possible.
pub(crate) fn table() -> String {
    let mut text = String::from(
        "# What can be combined\n\nEach cell states whether a model of two buildings of the same kind accepts the feature: `yes`, or `no` with the number of the\nerror message below the table. Written by `jostle schema --combinations`.\n\n|",
    );
    let mut refusals: Vec<String> = Vec::new();
    for kind in [""].into_iter().chain(KINDS.iter().map(|kind| kind.name)) {
        let _ = write!(text, " {kind} |");
    }
    text.push_str("\n|");
    text.push_str(&"---|".repeat(KINDS.len() + 1));
    for feature in features() {
        let _ = write!(text, "\n| {} |", feature.name);
        for index in 0..KINDS.len() {
            let Err(refusal) = try_out(index, &feature) else {
                text.push_str(" yes |");
                continue;
            };
            let known = refusals.iter().position(|candidate| *candidate == refusal);
            let number = known.unwrap_or_else(|| {
                refusals.push(refusal);
                refusals.len() - 1
            });
            let _ = write!(text, " no ({}) |", number + 1);
        }
    }
    text.push_str("\n\n");
    for (index, refusal) in refusals.iter().enumerate() {
        let _ = writeln!(text, "{}. {refusal}", index + 1);
    }
    text
}

/// Asks for a feature of a kind; the refusal in one line.
fn try_out(kind: usize, feature: &Feature) -> Result<(), String> {
    let model = model(kind, feature);
    let input = read_model_text("model", &model, Format::Toml, "".as_ref());
    let input = input.map_err(|error| line_of(&error))?;
    let opened = Opened::new(input, "model").map_err(|error| line_of(&error))?;
    let motion = opened.plan().map_err(|error| match error {
        RunError::Input(error) => line_of(&error),
        other => cell(&other.to_string()),
    })?;
    match feature.then {
        Then::Plan => Ok(()),
        Then::Rate if opened.system.ratings.is_empty() => Err("no member is rated".to_owned()),
        Then::Rate => Ok(()),
        Then::Push => {
            let buildings = [&opened.system.buildings[0]];
            let (direction, pattern) = ([PushDirection::Right], LoadPattern::FirstMode);
            let pushed = pushed_buildings(&buildings, &direction, pattern, 0.01);
            pushed.map(|_| ()).map_err(|error| cell(&error.to_string()))
        }
        Then::Export => {
            let exported = openseespy::export(&Export {
                model: &opened.input.model,
                system: &opened.system,
                motion: &motion.0,
            });
            let line = |faults: Vec<jostle::ModelFault>| {
                cell(
                    &faults
                        .first()
                        .map_or_else(String::new, |fault| fault.problem.clone()),
                )
            };
            exported.map(|_| ()).map_err(line)
        }
    }
}

/// A model of two buildings of a kind with a feature.
fn model(kind: usize, feature: &Feature) -> String {
    let building_kind = &KINDS[kind];
    let mut text = format!(
        "[motion]\nkind = \"sine\"\namplitude = 2\nperiod = 0.6\nduration = 1\n{}\n[analysis]\n{}",
        feature.motion, feature.analysis
    );
    for (index, name) in ["A", "B"].into_iter().enumerate() {
        let first = if index == 0 {
            3.0
        } else {
            feature.first_storey
        };
        let heights = match building_kind.name {
            // Its ports say how high its floors are.
            "given" | "given, plan" => String::new(),
            _ => format!("storey_height = [{first:?}, 3.0]\n"),
        };
        let keys = building_kind
            .keys
            .replace("FIRST", &format!("{first:?}"))
            .replace("SECOND", &format!("{:?}", first + 3.0))
            .replace("STIFFNESS", &in_plan_matrix([120e6, 60e6]))
            .replace("MASS", &in_plan_matrix([40e3, 0.0]));
        let place = match building_kind.in_plan && index == 1 {
            true => "at = [10.02, 0]\n",
            false => "",
        };
        let is_column = |line: &&str| line.starts_with("column =");
        let without = |text: &str| {
            let lines = text.lines().filter(|line| !is_column(line));
            lines.map(|line| format!("{line}\n")).collect::<String>()
        };
        let columns = match feature.keys {
            COLUMNS => Some(BY_LINE[kind]),
            FIBRES | SURFACES => of_fibres(building_kind.name),
            _ => None,
        };
        let (keys, own_tables) = match columns {
            Some(columns) => (
                without(&keys),
                building_kind
                    .tables
                    .replace("column = { width = 0.5, depth = 0.5 }\n", columns),
            ),
            None => (keys, building_kind.tables.to_owned()),
        };
        let (more, tables) = match feature.keys {
            // Frames at lines of a plan say it frame by frame.
            OWN_WORDS if YIELDING[kind].is_empty() => (
                "",
                building_kind
                    .tables
                    .replace("spans", &format!("{}spans", YIELDING[0])),
            ),
            OWN_WORDS => (YIELDING[kind], building_kind.tables.to_owned()),
            FIBRES | SURFACES if columns.is_some() && !own_tables.is_empty() => {
                ("gravity = true\n", own_tables)
            }
            FIBRES | SURFACES if columns.is_none() => {
                (HINGES_OF_FIBRES, building_kind.tables.to_owned())
            }
            BARS => ("", building_kind.tables.to_owned()),
            keys if of_frames(keys) && building_kind.tables.contains("spans") => (
                "",
                building_kind
                    .tables
                    .replace("spans", &format!("{keys}spans")),
            ),
            // Frames at lines of a plan have theirs in their tables.
            _ if columns.is_some() && building_kind.tables.contains("column =") => ("", own_tables),
            _ if columns.is_some() => (columns.unwrap_or_default(), own_tables),
            keys => (keys, building_kind.tables.to_owned()),
        };
        // What stands in frames of a plan belongs to them.
        let parts = ["building.brace", "building.infill", "building.wall"];
        let inside = parts.iter().any(|part| feature.tables.contains(part));
        let added = match inside && !building_kind.tables.is_empty() {
            true => feature.tables.replace("building.", "building.frame."),
            false => feature.tables.to_owned(),
        };
        // What stands in bays of a grid says along which lines.
        let added = match (inside, building_kind.name) {
            (true, "space-frame") if feature.name == "walls" => WALL_OF_A_GRID.to_owned(),
            (true, "space-frame") if feature.name.starts_with("walls that yield") => {
                format!("{WALL_OF_A_GRID}hinge = {{ yield = \"2 MN.m\", post_yield = 0.02 }}\n")
            }
            (true, "space-frame") if feature.name.starts_with("fibre sections") => {
                let own = feature
                    .tables
                    .split_once("concrete")
                    .map_or("", |parts| parts.1);
                format!("{WALL_OF_A_GRID}concrete{own}")
            }
            (true, "space-frame") if added.contains("from = ") => {
                added.replace("0.1", "0.1.1").replace("2.2", "2.2.2")
            }
            (true, "space-frame") => added.replace("]]\n", "]]\nalong = \"x\"\n"),
            _ => added,
        };
        let added = match building_kind.in_plan {
            true => added.replace(
                "floors = [0, 1]\n",
                "floors = [0, 1]\nat = [[2, 4], [8, 4]]\n",
            ),
            false => added,
        };
        let block = format!("{heights}{keys}{place}{more}{tables}{added}");
        let block = match feature.keys {
            BARS => with_bars(&block),
            SURFACES => block.replace("\"fibre\"", "\"surface\""),
            _ => block,
        };
        let _ = write!(text, "[[building]]\nname = \"{name}\"\n{block}");
    }
    let usual = [
        ("law", "law = \"hertz\"\n"),
        ("stiffness", "stiffness = 2e9\n"),
    ];
    let usual = usual.into_iter().filter(|(key, _)| {
        let stated = |line: &str| line.starts_with(key);
        !feature.gap.lines().any(stated) && !feature.gap.starts_with("law = \"restitution\"")
    });
    let usual: String = usual.map(|(_, line)| line).collect();
    let width = match building_kind.in_plan {
        // Plans say how far apart they stand.
        true => "",
        false => "width = 0.02\n",
    };
    let _ = write!(
        text,
        "[[gap]]\nbetween = [\"A\", \"B\"]\n{width}{usual}{}{}",
        feature.gap,
        match building_kind.in_plan {
            // The face of a wall is solid on the right of the way.
            true => {
                let named = feature.more.replace(
                    "[[gap]]\nbetween = [\"wall\",",
                    "[[wall]]\nname = \"moat\"\n[[gap]]\nbetween = [\"moat\",",
                );
                let named = named.replace("[[link]]\n", "[[link]]\nat = [[10, 4], [10.02, 4]]\n");
                let placed = "[[wall]]\nfrom = [-0.02, 8]\nto = [-0.02, 0]\n";
                named
                    .replace("[[wall]]\n", placed)
                    .replace("width = 0.02\n", "")
            }
            false => feature.more.to_owned(),
        }
    );
    text
}

/// Rows of a matrix over x, y and rotation of two floors: one value on the diagonal, and less the other between the floors; those of
/// rotations are 14 m² times as great.
fn in_plan_matrix([diagonal, between]: [f64; 2]) -> String {
    let entry = |row: usize, column: usize| {
        let unit = if row % 3 == 2 { 14.0 } else { 1.0 };
        match row.abs_diff(column) {
            // The upper floor stands on one storey.
            0 if row > 2 => unit * (diagonal - between),
            0 => unit * diagonal,
            3 => -unit * between,
            _ => 0.0,
        }
    };
    let row = |row: usize| {
        let entries = (0..6).map(|column| format!("{:?}", entry(row, column)));
        format!("[{}]", entries.collect::<Vec<_>>().join(", "))
    };
    format!("[{}]", (0..6).map(row).collect::<Vec<_>>().join(", "))
}

/// How a problem begins that goes on with the name of its key.
const GOES_ON: [&str; 5] = ["is ", "and ", "needs ", "limits ", "of "];

/// The first problem of a model in one line.
fn line_of(error: &jostle_io::InputError) -> String {
    let first = error.faults.first();
    cell(&first.map_or_else(String::new, |fault| {
        let key = fault.path.rsplit(['.', ']']).next().unwrap_or_default();
        let problem = &fault.problem;
        let goes_on = GOES_ON.iter().any(|words| problem.starts_with(words));
        match key.is_empty() || problem.starts_with("unknown") || problem.starts_with(key) {
            true => problem.clone(),
            false if goes_on => format!("{key} {problem}"),
            false => format!("{key}: {problem}"),
        }
    }))
}

/// As a cell of a table.
fn cell(text: &str) -> String {
    text.lines().next().unwrap_or_default().replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page of the documentation is what the program says; `jostle schema --combinations > docs/combinations.md` writes it.
    #[test]
    fn the_page_in_the_documentation_is_this_one() {
        let page = include_str!("../../../docs/combinations.md");
        assert!(
            table() == page,
            "write docs/combinations.md anew: jostle schema --combinations > docs/combinations.md"
        );
    }

    /// Every kind can at least touch its neighbour.
    #[test]
    fn every_kind_has_contact() {
        for kind in 0..KINDS.len() {
            assert_eq!(try_out(kind, &USUAL), Ok(()), "{}", KINDS[kind].name);
        }
    }
}
