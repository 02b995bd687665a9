//! Model files of the references.

use std::fmt::Write;

use serde_json::Value;

use crate::data::{list, number, numbers};

/// The references take g as 9.80665 m/s², the built-in record 9.81 m/s².
pub(crate) const GRAVITY: f64 = 9.80665 / 9.81;

/// The model file of a case.
pub(super) fn file(input: &Value, tolerance: f64) -> String {
    if input.get("wall_EI").is_some() {
        coupled_walls(input, tolerance)
    } else if input.get("drop_m").is_some() {
        at_two_levels(input, tolerance)
    } else if input["column_EI"][0].is_array() {
        by_line(input, tolerance)
    } else {
        braced(input, tolerance)
    }
}

/// Motion, tolerance and gap.
fn beginning(input: &Value, tolerance: f64, between: [&str; 2]) -> String {
    format!(
        r#"motion = {{ record = "el-centro-1940-ns", scale = {scale:?}, duration = {duration:?} }}
analysis = {{ tolerance = {tolerance:?} }}
[[gap]]
between = {between:?}
width = {gap:?}
law = "linear"
stiffness = {stiffness:?}
"#,
        scale = GRAVITY * number(input, "/scale"),
        duration = number(input, "/duration_s"),
        gap = number(input, "/gap_m"),
        stiffness = number(input, "/k_contact"),
    )
}

/// The shear building beside it.
fn neighbour(input: &Value) -> String {
    let building = &input["neighbour"];
    let heights = list(input, "/storey_heights_m");
    let heights = &heights[..list(building, "/mass_kg").len()];
    format!(
        "[[building]]\nname = \"N\"\nkind = \"shear\"\nstorey_height = {}\nstiffness = {}\nmass = {}\ndamping = {{ alpha = {:?}, beta = 0 }}\n",
        Value::from(heights.to_vec()),
        building["stiffness"],
        building["mass_kg"],
        number(input, "/alpha")
    )
}

/// A frame whose columns differ by line and beams by bay; null is none.
fn by_line(input: &Value, tolerance: f64) -> String {
    let spans = match input.get("spans_m") {
        Some(_) => numbers(input, "/spans_m"),
        None => {
            let lines = numbers(input, "/lines_m");
            lines.windows(2).map(|pair| pair[1] - pair[0]).collect()
        }
    };
    let rigidity = input.get("column_EA");
    let mut text = beginning(input, tolerance, ["F", "N"]);
    let _ = write!(
        text,
        r#"[[building]]
name = "F"
kind = "frame"
storey_height = {heights}
spans = {spans:?}
density = 0
column_segments = 1
beam_segments = 1
floor_mass = {masses}
axial = "{axial}"
damping = {{ alpha = {alpha:?}, beta = 0 }}
"#,
        heights = input["storey_heights_m"],
        masses = input["floor_mass_kg"],
        axial = if rigidity.is_some() {
            "flexible"
        } else {
            "rigid"
        },
        alpha = number(input, "/alpha"),
    );
    for [table, key, across, up] in [
        ["column", "column_EI", "line", "storeys"],
        ["beam", "beam_EI", "bay", "floors"],
    ] {
        for (storey, row) in input[key].as_array().into_iter().flatten().enumerate() {
            for (place, bending) in row.as_array().into_iter().flatten().enumerate() {
                let _ = writeln!(
                    text,
                    "[[building.{table}]]\n{across} = {}\n{up} = {}",
                    place + 1,
                    storey + 1
                );
                let _ = match (bending, rigidity.filter(|_| table == "column")) {
                    (Value::Null, _) => writeln!(text, "omit = true"),
                    (_, Some(all)) => {
                        writeln!(text, "EI = {bending}\nEA = {}", all[storey][place])
                    }
                    (_, None) => writeln!(text, "EI = {bending}"),
                };
            }
        }
    }
    text + &neighbour(input)
}

/// Two walls, coupled at every floor, seen from behind: floors are reported at their first column line, and the reference has those of the
/// right wall.
fn coupled_walls(input: &Value, tolerance: f64) -> String {
    let centres = numbers(input, "/wall_centres_m");
    let of_wall = |key: &str, wall: usize| number(input, &format!("/{key}/{wall}"));
    let mut text = beginning(input, tolerance, ["N", "W"]);
    text = text.replacen("scale =", "reverse = true, scale =", 1) + &neighbour(input);
    let _ = write!(
        text,
        r#"[[building]]
name = "W"
kind = "frame"
storey_height = {heights}
spans = [{span:?}]
density = 0
column_segments = 1
beam_segments = 1
floor_mass = {masses}
axial = {{ columns = "flexible", beams = "flexible" }}
damping = {{ alpha = {alpha:?}, beta = 0 }}
[[building.coupling_beam]]
between = [1, 2]
EI = {beam_bending}
EA = {beam_axial}
GA = {beam_shear}
"#,
        heights = input["storey_heights_m"],
        span = centres[1] - centres[0],
        masses = input["floor_mass_kg"],
        alpha = number(input, "/alpha"),
        beam_bending = input["beam_EI"],
        beam_axial = input["beam_EA"],
        beam_shear = input["beam_GA"],
    );
    for (wall, centre) in centres.iter().enumerate().rev() {
        let _ = writeln!(
            text,
            "[[building.wall]]\nat = {:?}\nlength = {:?}\nEI = {:?}\nEA = {:?}\nGA = {:?}",
            centres[1] - centre,
            of_wall("wall_length_m", wall),
            of_wall("wall_EI", wall),
            of_wall("wall_EA", wall),
            of_wall("wall_GA", wall),
        );
        if input["elastic"] == Value::Bool(false) {
            let _ = writeln!(
                text,
                "hinge = {{ rule = \"bilinear\", stiffness = {:?}, yield = {:?}, post_yield = {} }}",
                of_wall("hinge_k", wall),
                of_wall("hinge_My", wall),
                input["hinge_hardening"],
            );
        }
    }
    text
}

/// Two frames, the right one standing lower: every slab meets a column.
fn at_two_levels(input: &Value, tolerance: f64) -> String {
    let mut text = beginning(input, tolerance, ["A", "B"]);
    text += "floors = \"all\"\n";
    for (name, elevation) in [("A", 0.0), ("B", -number(input, "/drop_m"))] {
        let building = &input[name];
        let _ = writeln!(
            text,
            r#"[[building]]
name = "{name}"
kind = "frame"
elevation = {elevation:?}
storey_height = {heights}
spans = [{span}]
column = {{ EI = {column}, mass = {mass} }}
beam = {{ EI = {beam} }}
column_segments = 1
beam_segments = 1
floor_mass = {masses}
axial = "rigid"
damping = {{ alpha = {alpha:?}, beta = 0 }}"#,
            heights = building["storey_heights_m"],
            span = building["span_m"],
            column = building["column_EI"],
            mass = building["column_mass_kg_per_m"],
            beam = building["beam_EI"],
            masses = building["floor_mass_kg"],
            alpha = number(input, "/alpha"),
        );
    }
    text
}

/// A frame of one bay with braces or struts, one section per storey.
fn braced(input: &Value, tolerance: f64) -> String {
    let list_of = |key: &str, table: &dyn Fn(usize, f64) -> String| {
        let numbers = numbers(input, key).into_iter().enumerate();
        numbers
            .map(|(index, value)| table(index, value))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let rigidity = input["column_EA"].as_array().map(|input| input.to_vec());
    let column = list_of("/column_EI", &|index, value| match &rigidity {
        Some(rigidity) => format!("{{ EI = {value:?}, EA = {} }}", rigidity[index]),
        None => format!("{{ EI = {value:?} }}"),
    });
    let beam = list_of("/beam_EI", &|_, value| format!("{{ EI = {value:?} }}"));
    let axial = if rigidity.is_some() {
        "flexible"
    } else {
        "rigid"
    };
    let (heights, alpha) = (&input["storey_heights_m"], number(input, "/alpha"));
    let mut text = beginning(input, tolerance, ["F", "N"]);
    let _ = write!(
        text,
        r#"[[building]]
name = "F"
kind = "frame"
storey_height = {heights}
spans = [{span:?}]
column = [{column}]
beam = [{beam}]
density = 0
column_segments = 1
beam_segments = 1
floor_mass = {masses}
axial = "{axial}"
damping = {{ alpha = {alpha:?}, beta = 0 }}
"#,
        span = number(input, "/span_m"),
        masses = input["floor_mass_kg"],
    );
    for (storey, brace) in input["brace"].as_array().into_iter().flatten().enumerate() {
        let direction = match brace["from"].as_str() {
            Some("left") => "up",
            _ => "down",
        };
        let _ = writeln!(
            text,
            "[[building.brace]]\nstoreys = {}\ndirection = \"{direction}\"\nstiffness = {}",
            storey + 1,
            brace["k"]
        );
        if input["elastic"] == Value::Bool(false) {
            let _ = writeln!(
                text,
                "hinge = {{ rule = \"bilinear\", yield = {}, post_yield = {} }}",
                brace["Fy"], brace["hardening"]
            );
        }
    }
    let panels = input["panel"].as_array().into_iter().flatten();
    for (storey, panel) in panels.enumerate().filter(|(_, index)| !index.is_null()) {
        text += &one_strut(storey, panel);
    }
    let struts = input["strut_k"].as_array().into_iter().flatten();
    for (storey, stiffness) in struts.enumerate().filter(|(_, index)| index.is_number()) {
        let _ = writeln!(
            text,
            "[[building.infill]]\nstoreys = {}\nstiffness = {stiffness}",
            storey + 1
        );
    }
    text + &neighbour(input)
}

/// A panel as one strut from the lower left, with an envelope of three points whose last line falls.
fn one_strut(storey: usize, panel: &Value) -> String {
    let [d, f] = ["/d_m", "/F_n"].map(|key| numbers(panel, key));
    let stiffness = f[0] / d[0];
    let slope = |from: usize| (f[from + 1] - f[from]) / (d[from + 1] - d[from]) / stiffness;
    format!(
        r#"[[building.brace]]
storeys = {storey}
direction = "up"
stiffness = {stiffness:?}
[building.brace.hinge]
rule = "pinched"
cracking = {cracking:?}
yield = {yielding:?}
post_cracking = {second:?}
post_yield = {third:?}
residual = {residual:?}
pinching = {{ deformation = {deformation}, force = {force} }}
"#,
        storey = storey + 1,
        cracking = f[0],
        yielding = f[1],
        second = slope(0),
        third = slope(1),
        residual = f[2] / f[1],
        deformation = panel["pinch_deformation"],
        force = panel["pinch_force"],
    )
}
