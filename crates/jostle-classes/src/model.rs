//! A row as an ordinary model file.

use std::fmt::Write as _;

use jostle_batch::{Building, Face, Gap, Law, Row, Rule, Storey};

/// The row as the text of a model file; `motion` is the table `[motion]` without its heading, such as
/// `record = "el-centro-1940-ns"`.
#[must_use]
pub fn model(row: &Row, motion: &str, tolerance: f64) -> String {
    let mut text = format!("[motion]\n{motion}\n\n[analysis]\ntolerance = {tolerance:e}\n");
    for (at, own) in row.buildings.iter().enumerate() {
        let list = |value: fn(&Storey) -> f64, unit: &str| {
            let all = own
                .storeys
                .iter()
                .map(|own| format!("\"{} {unit}\"", value(own)));
            format!("[{}]", all.collect::<Vec<_>>().join(", "))
        };
        let _ = write!(
            text,
            "\n[[building]]\nname = \"B{}\"\nkind = \"shear\"\np_delta = false\nstoreys = {}\nmass = {}\nstiffness = {}\n\
             storey_height = {}\ndamping = {{ alpha = \"{} 1/s\", beta = \"{} s\" }}\n",
            at + 1,
            own.storeys.len(),
            list(|own| own.mass, "kg"),
            list(|own| own.stiffness, "N/m"),
            list(|own| own.height, "m"),
            own.alpha,
            own.beta
        );
        if let Some(hinges) = hinges(
            own,
            &list(|own| own.first_corner, "m"),
            &list(|own| own.second_corner, "m"),
        ) {
            let _ = writeln!(text, "hinges = {{ {hinges} }}");
        }
    }
    for (at, gap) in row.gaps.iter().enumerate() {
        let Some(law) = gap.law else { continue };
        let law = match law {
            Law::HertzDamp {
                stiffness,
                restitution,
            } => format!(
                "law = \"hertz-damp\"\nstiffness = \"{stiffness} N/m^1.5\"\nrestitution = {restitution}"
            ),
            Law::Kelvin {
                stiffness,
                restitution,
            } => {
                format!(
                    "law = \"kelvin\"\nstiffness = \"{stiffness} N/m\"\nrestitution = {restitution}"
                )
            }
            Law::Linear { stiffness } => {
                format!("law = \"linear\"\nstiffness = \"{stiffness} N/m\"")
            }
        };
        let (left, right) = (at + 1, at + 2);
        let _ = write!(
            text,
            "\n[[gap]]\nbetween = [\"B{left}\", \"B{right}\"]\nwidth = \"{} m\"\nfloors = [{}]\n{law}\n",
            gap.width,
            points(gap, &row.buildings[at], &row.buildings[at + 1])
        );
    }
    text
}

/// Where neighbours touch: floors from 1, or levels of columns.
fn points(gap: &Gap, left: &Building, right: &Building) -> String {
    let place = |own: &Face, building: &Building| {
        let below: f64 = building.storeys[..own.floor]
            .iter()
            .map(|own| own.height)
            .sum();
        if own.share >= 1.0 {
            (own.floor + 1).to_string()
        } else {
            format!(
                "\"{} m\"",
                below + own.share * building.storeys[own.floor].height
            )
        }
    };
    let pairs = gap
        .contacts
        .iter()
        .map(|own| format!("[{}, {}]", place(&own.left, left), place(&own.right, right)));
    pairs.collect::<Vec<_>>().join(", ")
}

/// The table of the storeys' yielding, if they yield. Ratios are those of the first storey.
fn hinges(own: &Building, first: &str, second: &str) -> Option<String> {
    let storey = own.storeys.first()?;
    let [two, three] = [storey.second_ratio, storey.third_ratio];
    let corners = format!(
        "cracking = {first}, yield = {second}, post_cracking = {two}, post_yield = {three}"
    );
    match own.rule {
        Rule::Elastic => None,
        Rule::Bilinear => Some(format!(
            "rule = \"bilinear\", yield = {first}, post_yield = {two}"
        )),
        Rule::PeakOriented => Some(format!("rule = \"peak-oriented\", {corners}")),
        Rule::Pinched {
            deformation,
            force,
            unloading_exponent,
        } => Some(format!(
            "rule = \"pinched\", {corners}, pinching = {{ deformation = {deformation}, force = {force} }}, \
             unloading_exponent = {unloading_exponent}"
        )),
    }
}
