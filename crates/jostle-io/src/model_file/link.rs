//! `[[link]]`: springs, dampers and sliders that join neighbours, or floors of one building.

use jostle::{Building, FloorPairs, Link, LinkLaw, PlanPoint, Wall};

use super::between::{floors, neighbours, tolerance};
use super::hinges::read_spring;
use super::plan::pair;
use crate::keys::{LINK_LAWS, Section};
use crate::quantity::{Dimension, check_magnitude, split_number};
use crate::reader::{Field, Reader, View};
use crate::unit::Unit;

/// Most links.
pub(super) const MOST_LINKS: usize = 10_000;

/// Reads all links. Without buildings, names are unknown, and only the rest is checked.
pub(super) fn read_all(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
    walls: &[Wall],
) -> Vec<Link> {
    let Some(entries) = field.entries() else {
        let found = field.node.describe();
        *reader.bad(field, format!("expected a list of links, found {found}")) =
            Some("write [[link]] with double brackets; in JSON \"link\": [{ … }]".into());
        return Vec::new();
    };
    if entries.len() > MOST_LINKS {
        let count = entries.len();
        reader.bad(
            field,
            format!("at most {MOST_LINKS} links are possible, found {count}"),
        );
        return Vec::new();
    }
    entries
        .iter()
        .filter_map(|entry| read(reader, entry, buildings, walls))
        .collect()
}

fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    buildings: Option<&[Building]>,
    walls: &[Wall],
) -> Option<Link> {
    let view = reader.open(field, &[Section::Link, Section::LinkLaw])?;
    let between = neighbours(reader, &view, buildings, walls, true);
    let floors = floors(reader, &view);
    let level_tolerance = tolerance(reader, &view);
    let at = ends(reader, &view);
    let Parameters {
        law,
        stiffness,
        damping,
    } = read_law(reader, &view)?;
    Some(Link {
        between: between?,
        floors: floors.unwrap_or(FloorPairs::Common),
        level_tolerance,
        stiffness,
        damping,
        law,
        at,
    })
}

/// Where its ends stand in plan: two points.
pub(super) fn ends(reader: &mut Reader<'_>, view: &View<'_>) -> Option<[PlanPoint; 2]> {
    let field = reader.get(view, "at")?;
    let entries = field.entries().unwrap_or_default();
    let [from, to] = &entries[..] else {
        let found = field.node.describe();
        *reader.bad(&field, format!("expected both ends, found {found}")) =
            Some("write at = [[\"10 m\", \"4 m\"], [\"10.1 m\", \"4 m\"]]".into());
        return None;
    };
    let (from, to) = (pair(reader, from), pair(reader, to));
    Some([from?, to?])
}

/// A law with its numbers.
pub(super) struct Parameters {
    pub(super) law: LinkLaw,
    pub(super) stiffness: f64,
    pub(super) damping: f64,
}

/// The law of a link or damper; `None` after faults.
pub(super) fn read_law(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Parameters> {
    let name = match reader.get(view, "law") {
        Some(field) => reader.choice(&field, LINK_LAWS, &[])?,
        None => LinkLaw::Linear.name(),
    };
    parameters(reader, view, name)
}

/// Keys of the parameters, with the laws that know them.
const KEYS: [(&str, &[&str]); 8] = [
    (
        "stiffness",
        &[
            "linear", "viscous", "maxwell", "yielding", "cable", "stopper",
        ],
    ),
    ("damping", &["linear", "viscous", "maxwell", "stopper"]),
    ("exponent", &["viscous"]),
    ("slip_force", &["friction"]),
    ("stick_stiffness", &["friction"]),
    ("hinge", &["yielding"]),
    ("slack", &["cable"]),
    ("gap", &["stopper"]),
];

/// The law of a name; `None` after faults.
fn parameters(reader: &mut Reader<'_>, view: &View<'_>, name: &str) -> Option<Parameters> {
    for (key, laws) in KEYS {
        if laws.contains(&name) {
            continue;
        }
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, format!("has no meaning for law = \"{name}\"")) = Some(format!(
                "remove {key}, or set law = \"{}\"",
                laws.join("\" or \"")
            ));
        }
    }
    let with = |law, stiffness, damping| Parameters {
        law,
        stiffness,
        damping,
    };
    let stiff = Dimension::Stiffness;
    match name {
        "viscous" => {
            let exponent = value(reader, view, "exponent", Dimension::Dimensionless, None);
            let exponent = exponent.unwrap_or(Some(1.0));
            let damping = viscous_damping(reader, view, exponent);
            let stiffness = value(reader, view, "stiffness", stiff, None).unwrap_or(Some(0.0));
            let law = LinkLaw::Viscous {
                exponent: exponent?,
            };
            Some(with(law, stiffness?, damping?))
        }
        "maxwell" => {
            let stiffness = value(reader, view, "stiffness", stiff, Some("\"20 MN/m\"")).flatten();
            let damping = Dimension::Damping;
            let damping = value(reader, view, "damping", damping, Some("\"800 kN.s/m\"")).flatten();
            Some(with(LinkLaw::Maxwell, stiffness?, damping?))
        }
        "friction" => {
            let force = Dimension::Force;
            let slip = value(reader, view, "slip_force", force, Some("\"120 kN\"")).flatten();
            let stick = Some("\"120 MN/m\"");
            let stick = value(reader, view, "stick_stiffness", stiff, stick).flatten();
            let law = LinkLaw::Friction {
                slip_force: slip?,
                stick_stiffness: stick?,
            };
            Some(with(law, 0.0, 0.0))
        }
        "yielding" => {
            let stiffness = value(reader, view, "stiffness", stiff, Some("\"80 MN/m\"")).flatten();
            if let Some(field) = reader.get(view, "stiffness")
                && stiffness.is_some_and(|stiffness| stiffness <= 0.0)
            {
                reader.bad(&field, "must be greater than 0 for law = \"yielding\"");
            }
            let Some(field) = reader.get(view, "hinge") else {
                reader.missing(
                    view,
                    "hinge",
                    "add hinge = { rule = \"bilinear\", yield = \"120 kN\", post_yield = 0.05 }",
                );
                return None;
            };
            let sections = &[Section::LinkHinge];
            let spring = read_spring(reader, &field, sections, stiffness, Dimension::Force)?;
            Some(with(LinkLaw::Yielding(spring), 0.0, 0.0))
        }
        "cable" => {
            let stiffness = value(reader, view, "stiffness", stiff, Some("\"50 MN/m\"")).flatten();
            let slack = value(reader, view, "slack", Dimension::Length, None).unwrap_or(Some(0.0));
            Some(with(LinkLaw::Cable { slack: slack? }, stiffness?, 0.0))
        }
        "stopper" => {
            let stiffness = value(reader, view, "stiffness", stiff, Some("\"200 MN/m\"")).flatten();
            let damping = value(reader, view, "damping", Dimension::Damping, None);
            let gap = value(reader, view, "gap", Dimension::Length, None).unwrap_or(Some(0.0));
            let law = LinkLaw::Stopper { gap: gap? };
            Some(with(law, stiffness?, damping.unwrap_or(Some(0.0))?))
        }
        _ => {
            if !view.has("stiffness") && !view.has("damping") {
                reader.missing(
                    view,
                    "damping",
                    "add damping = \"500 kN.s/m\" for a damper, stiffness = \"20 MN/m\" for a spring, or both",
                );
                return None;
            }
            let stiffness = value(reader, view, "stiffness", stiff, None);
            let damping = value(reader, view, "damping", Dimension::Damping, None);
            let law = LinkLaw::Linear;
            Some(with(
                law,
                stiffness.unwrap_or(Some(0.0))?,
                damping.unwrap_or(Some(0.0))?,
            ))
        }
    }
}

/// `None` for a key that is absent, which is a fault if there is an example; `Some(None)` for one that cannot be read.
fn value(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    key: &'static str,
    dimension: Dimension,
    example: Option<&str>,
) -> Option<Option<f64>> {
    match (reader.get(view, key), example) {
        (Some(field), _) => Some(reader.quantity(&field, dimension)),
        (None, Some(example)) => {
            reader.missing(view, key, format!("add {key} = {example}"));
            None
        }
        (None, None) => None,
    }
}

/// `damping` in N·(s/m)^α, whose unit must have the exponent of the law.
fn viscous_damping(reader: &mut Reader<'_>, view: &View<'_>, exponent: Option<f64>) -> Option<f64> {
    let shown = exponent.unwrap_or(1.0);
    let Some(field) = reader.get(view, "damping") else {
        let unit = if shown == 1.0 {
            "kN.s/m".to_owned()
        } else {
            format!("kN.(s/m)^{shown}")
        };
        reader.missing(view, "damping", format!("add damping = \"150 {unit}\""));
        return None;
    };
    let exponent = exponent?;
    let text = match field.as_text().and_then(split_number) {
        Some((number, unit)) if !unit.trim().is_empty() => Some((number, unit)),
        // Bare numbers, and texts whose fault the usual reader describes.
        _ => None,
    };
    let parsed = text.and_then(|(number, unit)| Some((number, Unit::parse(unit).ok()?)));
    let Some((number, unit)) = parsed else {
        return reader.quantity(&field, Dimension::Damping);
    };
    let dimension = |exponent: f64| [1.0 - exponent, 1.0, exponent - 2.0];
    if unit.has_dimension(dimension(exponent)) {
        let value = check_magnitude(number * unit.factor, Dimension::Damping)
            .map_err(|error| reader.bad(&field, error.to_string()))
            .ok()?;
        return reader
            .judge(&field, value, Dimension::Damping)
            .then_some(value);
    }
    // The exponent that the unit would have.
    let other = unit.exponents[2] + 2.0;
    if unit.has_dimension(dimension(other)) && other != 0.0 {
        let other = (other * 1e9).round() / 1e9;
        *reader.bad(
            &field,
            format!("has a unit of exponent {other}, but the exponent of the link is {exponent}"),
        ) = Some(format!(
            "write N.(s/m)^{exponent}, or set exponent = {other}"
        ));
    } else {
        *reader.bad(
            &field,
            format!("expected a dashpot coefficient in N.(s/m)^{exponent} (such as \"150 kN.(s/m)^{exponent}\")"),
        ) = Some("the unit of c in F = c |v|^exponent is N.(s/m)^exponent".into());
    }
    None
}
