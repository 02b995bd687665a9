//! A row as an ordinary model file.

use std::fmt::Write as _;

use jostle_batch::{Building, Contact, Face, Gap, Law, Row, Rule, Storey};

/// The row as the text of a model file; `motion` is the table `[motion]` without its heading, such as
/// `record = "el-centro-1940-ns"`.
///
/// Slabs that strike columns strike the nearest floor there, as [`at_floors`] moves them; a remark in the text says so.
#[must_use]
pub fn model(row: &Row, motion: &str, tolerance: f64) -> String {
    let columns = row
        .gaps
        .iter()
        .flat_map(|gap| &gap.contacts)
        .any(Contact::strikes_column);
    let remark = if columns {
        "# Slabs strike columns between floors here. A shear building has none: they strike the nearest floor instead.\n"
    } else {
        ""
    };
    let row = &at_floors(row);
    let mut text = format!("{remark}[motion]\n{motion}\n\n[analysis]\ntolerance = {tolerance:e}\n");
    for (at, building) in row.buildings.iter().enumerate() {
        let list = |value: fn(&Storey) -> f64, unit: &str| {
            let all = building
                .storeys
                .iter()
                .map(|storey| format!("\"{} {unit}\"", short(value(storey))));
            format!("[{}]", all.collect::<Vec<_>>().join(", "))
        };
        let _ = write!(
            text,
            "\n[[building]]\nname = \"B{}\"\nkind = \"shear\"\np_delta = false\nstoreys = {}\nmass = {}\nstiffness = {}\n\
             storey_height = {}\ndamping = {{ alpha = \"{} 1/s\", beta = \"{} s\" }}\n",
            at + 1,
            building.storeys.len(),
            list(|building| building.mass, "kg"),
            list(|building| building.stiffness, "N/m"),
            list(|building| building.height, "m"),
            short(building.alpha),
            short(building.beta)
        );
        if let Some(hinges) = hinges(
            building,
            &list(|storey| storey.first_corner, "m"),
            &list(|storey| storey.second_corner, "m"),
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
            "\n[[gap]]\nbetween = [\"B{left}\", \"B{right}\"]\nwidth = \"{} m\"\n{}\n{law}\n",
            short(gap.width),
            points(gap, &row.buildings[at], &row.buildings[at + 1])
        );
    }
    text += SILENCE;
    text
}

/// A number with ten digits, without those that rounding made.
fn short(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

/// Checks that would question the types themselves.
const SILENCE: &str = "
[report]
# Capacity curves of building types include P-Delta, and their damping is that of the type, at any ratio.
silence = [\"modal-damping\", \"damping-with-hinges\", \"yielding-without-p-delta\"]
";

/// The row with slabs that strike columns moved to the nearest floors there: the program's shear buildings have no
/// columns between floors.
#[must_use]
pub fn at_floors(row: &Row) -> Row {
    let mut row_at_floors = row.clone();
    for (at, gap) in row_at_floors.gaps.iter_mut().enumerate() {
        let nearest = |face: Face, building: usize| {
            // Half a storey up and more is nearer to the floor above; below the first floor there is only the ground.
            let floor = if face.share >= 0.5 || face.floor == 0 {
                face.floor
            } else {
                face.floor - 1
            };
            debug_assert!(floor < row.buildings[building].storeys.len());
            Face { floor, share: 1.0 }
        };
        let mut contacts: Vec<Contact> = Vec::new();
        for contact in &gap.contacts {
            let moved = Contact {
                left: nearest(contact.left, at),
                right: nearest(contact.right, at + 1),
            };
            if !contacts.contains(&moved) {
                contacts.push(moved);
            }
        }
        // From the ground up, as a model has its contacts.
        contacts.sort_by_key(|contact| (contact.left.floor, contact.right.floor));
        gap.contacts = contacts;
    }
    row_at_floors
}

/// Where neighbours touch: floors from 1, and the tolerance of their levels where they differ.
fn points(gap: &Gap, left: &Building, right: &Building) -> String {
    let level = |building: &Building, floor: usize| {
        building.storeys[..=floor]
            .iter()
            .map(|storey| storey.height)
            .sum::<f64>()
    };
    let contacts = gap.contacts.iter();
    let pairs = contacts
        .map(|contact| format!("[{}, {}]", contact.left.floor + 1, contact.right.floor + 1));
    let pairs = pairs.collect::<Vec<_>>().join(", ");
    let apart = |contact: &Contact| {
        (level(left, contact.left.floor) - level(right, contact.right.floor)).abs()
    };
    let most = gap.contacts.iter().map(apart).fold(0.0, f64::max);
    if most > 1e-3 {
        format!(
            "floors = [{pairs}]\nlevel_tolerance = \"{:.3} m\"",
            most + 1e-3
        )
    } else {
        format!("floors = [{pairs}]")
    }
}

/// The table of the storeys' yielding, if they yield. Ratios are those of the first storey.
fn hinges(building: &Building, first: &str, second: &str) -> Option<String> {
    let storey = building.storeys.first()?;
    let [two, three] = [storey.second_ratio, storey.third_ratio];
    let corners = format!(
        "cracking = {first}, yield = {second}, post_cracking = {two}, post_yield = {three}"
    );
    match building.rule {
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
