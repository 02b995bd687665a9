//! `[building.isolation]`: bearings under a building, and the mat on them.

use jostle::{
    BearingBounds, BearingFactors, Isolation, Isolator, IsolatorDamping, PlanPoint, SlidingSurface,
    SpeedFriction, Stop,
};

use super::plan::pair;
use crate::keys::{ISOLATORS, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::tree::Value;

/// Bearings that slide up a bowl.
const PENDULUMS: &[&str] = &[
    "friction-pendulum",
    "double-friction-pendulum",
    "triple-friction-pendulum",
];

/// Displacement at which sliding bearings slip, where none is given \[m\].
const SLIP: f64 = 1e-3;

/// Reads the isolation of a building; `None` after a fault, or if it has none. Places of its bearings in a plan go into `places`, which
/// is `None` for a building in one plane.
pub(super) fn read(
    reader: &mut Reader<'_>,
    building: &View<'_>,
    places: Option<&mut Vec<PlanPoint>>,
) -> Option<Isolation> {
    let field = reader.get(building, "isolation")?;
    // Not a key of every building.
    if building.has("base")
        && let Some(base) = reader.get(building, "base")
    {
        *reader.bad(&base, "cannot be combined with isolation") =
            Some("the bearings are the base; leave out base".into());
    }
    let view = reader.open(&field, &[Section::Isolation])?;
    let kind = match reader.get(&view, "kind") {
        Some(field) => reader.choice(&field, ISOLATORS, &[]),
        None => {
            reader.missing(
                &view,
                "kind",
                "add kind = \"lead-rubber\", \"friction-pendulum\" or another kind of bearings",
            );
            None
        }
    };
    let mat_mass = reader.needed_quantity(&view, "mat_mass", Dimension::Mass, "\"150 t\"");
    let isolator = kind.and_then(|kind| {
        refuse_keys_of_others(reader, &view, kind);
        match kind {
            "linear" => Some(Isolator::Linear {
                stiffness: reader.needed_quantity(
                    &view,
                    "stiffness",
                    Dimension::Stiffness,
                    "\"8 MN/m\"",
                )?,
            }),
            "lead-rubber" => lead_rubber(reader, &view),
            "high-damping-rubber" => high_damping_rubber(reader, &view),
            "double-friction-pendulum" => {
                let (surfaces, slip_displacement) = surfaces(reader, &view, kind)?;
                Some(Isolator::DoublePendulum {
                    surfaces,
                    slip_displacement,
                })
            }
            "triple-friction-pendulum" => {
                let (surfaces, slip_displacement) = surfaces(reader, &view, kind)?;
                Some(Isolator::TriplePendulum {
                    surfaces,
                    slip_displacement,
                })
            }
            _ => pendulum(reader, &view),
        }
    });
    let damping = reader.quantity_at(&view, "damping", Dimension::Damping);
    // Of rubber of high damping it is a property of the rubber.
    let of_dashpot = kind != Some("high-damping-rubber");
    let ratio = match of_dashpot {
        true => reader.quantity_at(&view, "damping_ratio", Dimension::Dimensionless),
        false => None,
    };
    if of_dashpot
        && let (Some(_), Some(ratio)) = (
            reader.get(&view, "damping"),
            reader.get(&view, "damping_ratio"),
        )
    {
        *reader.bad(&ratio, "cannot be combined with damping") =
            Some("keep either damping or damping_ratio".into());
    }
    let damping = match ratio {
        Some(ratio) => IsolatorDamping::Ratio(ratio),
        None => IsolatorDamping::Coefficient(damping.unwrap_or(0.0)),
    };
    let stops = stops(reader, &view);
    let limit = reader.quantity_at(&view, "limit", Dimension::Length);
    read_places(reader, &view, places);
    let weight = reader.quantity_at(&view, "weight", Dimension::Force);
    let bounds = kind.and_then(|kind| bounds(reader, &view, kind));
    Some(Isolation {
        isolator: isolator?,
        mat_mass: mat_mass?,
        damping,
        stops,
        limit,
        weight,
        bounds,
    })
}

/// Lower and upper bound of the properties of bearings of a kind.
fn bounds(reader: &mut Reader<'_>, view: &View<'_>, kind: &'static str) -> Option<BearingBounds> {
    let field = reader.get(view, "bounds")?;
    let view = reader.open(&field, &[Section::IsolationBounds])?;
    let [lower, upper] = [("lower", "0.85"), ("upper", "1.3")].map(|(key, example)| {
        let Some(field) = reader.get(&view, key) else {
            reader.missing(
                &view,
                key,
                format!("add {key} = {example}, or the factor of your supplier or code"),
            );
            return None;
        };
        factors(reader, &field, kind)
    });
    Some(BearingBounds {
        lower: lower?,
        upper: upper?,
    })
}

/// Factors on what bearings of a kind have: one for all of it, or one each.
fn factors(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    kind: &'static str,
) -> Option<BearingFactors> {
    let has = |key| match key {
        "stiffness" => !PENDULUMS.contains(&kind),
        _ => kind != "linear",
    };
    let keys = ["stiffness", "strength"];
    if !matches!(field.node.value, Value::Table(_)) {
        let factor = reader.positive(field, Dimension::Dimensionless)?;
        let [stiffness, strength] = keys.map(|key| if has(key) { factor } else { 1.0 });
        return Some(BearingFactors {
            stiffness,
            strength,
        });
    }
    let view = reader.open(field, &[Section::BearingFactors])?;
    let [stiffness, strength] = keys.map(|key| {
        let Some(field) = reader.get(&view, key) else {
            return Some(1.0);
        };
        if !has(key) {
            *reader.bad(&field, format!("is not a property of kind = \"{kind}\"")) = Some(
                match key {
                    "stiffness" => {
                        "the stiffness of a pendulum is its weight over its radius; leave it out"
                    }
                    _ => "linear bearings have no yield force; leave it out",
                }
                .into(),
            );
        }
        reader.positive(&field, Dimension::Dimensionless)
    });
    Some(BearingFactors {
        stiffness: stiffness?,
        strength: strength?,
    })
}

/// Where bearings stand in the plan, from its origin.
fn read_places(reader: &mut Reader<'_>, view: &View<'_>, places: Option<&mut Vec<PlanPoint>>) {
    let Some(field) = reader.get(view, "bearings") else {
        return;
    };
    let Some(places) = places else {
        *reader.bad(&field, "is for a building with a plan") = Some(
            "leave it out: bearings of a building in one plane act as one, or add plan".into(),
        );
        return;
    };
    let entries = field.entries().unwrap_or_default();
    if entries.is_empty() {
        let found = field.node.describe();
        reader.bad(
            &field,
            format!("expected a list of places, such as [[\"1 m\", \"1 m\"], [\"19 m\", \"1 m\"]]; found {found}"),
        );
        return;
    }
    places.extend(entries.iter().filter_map(|entry| pair(reader, entry)));
}

/// Keys of one kind of bearings, which mean nothing under another.
fn refuse_keys_of_others(reader: &mut Reader<'_>, view: &View<'_>, kind: &'static str) {
    for (key, kinds) in [
        (
            "stiffness",
            &["linear", "lead-rubber", "high-damping-rubber"][..],
        ),
        ("yield", &["lead-rubber"]),
        ("post_yield", &["lead-rubber"]),
        ("displacement", &["high-damping-rubber"]),
        ("yield_displacement", &["high-damping-rubber"]),
        ("radius", PENDULUMS),
        ("friction", PENDULUMS),
        ("capacity", &PENDULUMS[1..]),
        ("slip_displacement", PENDULUMS),
        ("damping_ratio", &["linear", "high-damping-rubber"]),
    ] {
        if kinds.contains(&kind) {
            continue;
        }
        if let Some(field) = reader.get(view, key) {
            *reader.bad(&field, format!("is not a key of kind = \"{kind}\"")) = Some(format!(
                "it belongs to {}; leave it out",
                kinds.join(" and ")
            ));
        }
    }
}

fn lead_rubber(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Isolator> {
    let stiffness = reader.needed_quantity(view, "stiffness", Dimension::Stiffness, "\"42 MN/m\"");
    let yield_force = reader.needed_quantity(view, "yield", Dimension::Force, "\"400 kN\"");
    let post_yield = reader.needed_quantity(view, "post_yield", Dimension::Dimensionless, "0.1");
    Some(Isolator::LeadRubber {
        stiffness: stiffness?,
        yield_force: yield_force?,
        post_yield: post_yield?,
    })
}

fn high_damping_rubber(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Isolator> {
    let mut number =
        |key, dimension, example| reader.needed_quantity(view, key, dimension, example);
    let stiffness = number("stiffness", Dimension::Stiffness, "\"6 MN/m\"");
    let ratio = number("damping_ratio", Dimension::Dimensionless, "0.15");
    let displacement = number("displacement", Dimension::Length, "\"200 mm\"");
    let yielding = number(
        "yield_displacement",
        Dimension::Length,
        "\"15 mm\", about 0.05 to 0.1 of the height of the rubber",
    );
    Some(Isolator::HighDampingRubber {
        stiffness: stiffness?,
        damping_ratio: ratio?,
        displacement: displacement?,
        yield_displacement: yielding?,
    })
}

/// The surfaces of a pendulum of several and its slip displacement.
fn surfaces<const N: usize>(
    reader: &mut Reader<'_>,
    view: &View<'_>,
    kind: &str,
) -> Option<([SlidingSurface; N], f64)> {
    let mut list = |key, dimension, [two, four]: [&str; 2]| {
        let example = if N == 2 { two } else { four };
        let Some(field) = reader.get(view, key) else {
            reader.missing(view, key, format!("add {key} = {example}"));
            return None;
        };
        let entries = field.entries().unwrap_or_default();
        if entries.len() != N {
            let found = field.node.describe();
            *reader.bad(
                &field,
                format!("must be a list of {N} for a {kind}, one of each surface from one bowl to the other; found {found}"),
            ) = Some(format!("write {key} = {example}"));
            return None;
        }
        let values = entries
            .iter()
            .map(|entry| reader.quantity(entry, dimension));
        // Every fault is told, not the first alone.
        let values: Vec<Option<f64>> = values.collect();
        values.into_iter().collect::<Option<Vec<f64>>>()
    };
    let radii = list(
        "radius",
        Dimension::Length,
        [
            "[\"2.2 m\", \"2.2 m\"]",
            "[\"2.1 m\", \"0.3 m\", \"0.3 m\", \"2.1 m\"]",
        ],
    );
    let frictions = list(
        "friction",
        Dimension::Dimensionless,
        ["[0.03, 0.06]", "[0.04, 0.015, 0.015, 0.08]"],
    );
    let capacities = list(
        "capacity",
        Dimension::Length,
        [
            "[\"300 mm\", \"300 mm\"]",
            "[\"300 mm\", \"50 mm\", \"50 mm\", \"300 mm\"]",
        ],
    );
    let slip = reader.quantity_at(view, "slip_displacement", Dimension::Length);
    let (radii, frictions, capacities) = (radii?, frictions?, capacities?);
    let surfaces = std::array::from_fn(|index| SlidingSurface {
        radius: radii[index],
        friction: frictions[index],
        capacity: capacities[index],
    });
    Some((surfaces, slip.unwrap_or(SLIP)))
}

fn pendulum(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Isolator> {
    let radius = reader.needed_quantity(view, "radius", Dimension::Length, "\"1.5 m\"");
    let friction = match reader.get(view, "friction") {
        Some(field) => friction(reader, &field),
        None => {
            reader.missing(view, "friction", "add friction = 0.05");
            None
        }
    };
    let slip = reader.quantity_at(view, "slip_displacement", Dimension::Length);
    Some(Isolator::Pendulum {
        radius: radius?,
        friction: friction?,
        slip_displacement: slip.unwrap_or(SLIP),
    })
}

/// One coefficient, or its change with speed.
fn friction(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<SpeedFriction> {
    if !matches!(field.node.value, Value::Table(_)) {
        let coefficient = reader.quantity(field, Dimension::Dimensionless)?;
        return Some(SpeedFriction::constant(coefficient));
    }
    let view = reader.open(field, &[Section::IsolationFriction])?;
    let slow = reader.needed_quantity(&view, "slow", Dimension::Dimensionless, "0.03");
    let fast = reader.needed_quantity(&view, "fast", Dimension::Dimensionless, "0.06");
    let rate = reader.needed_quantity(&view, "rate", Dimension::Slowness, "\"50 s/m\"");
    Some(SpeedFriction {
        slow: slow?,
        fast: fast?,
        rate: rate?,
    })
}

/// Stops on the left and on the right: one table for both, or one each.
fn stops(reader: &mut Reader<'_>, view: &View<'_>) -> [Option<Stop>; 2] {
    let none = [None; 2];
    let Some(field) = reader.get(view, "stop") else {
        return none;
    };
    let Some(view) = reader.open(&field, &[Section::IsolationStop]) else {
        return none;
    };
    if view.has("left") || view.has("right") {
        if view.has("at") || view.has("stiffness") {
            *reader.bad(&field, "mixes one stop for both sides with left and right") =
                Some("keep either at and stiffness, or left and right".into());
        }
        return ["left", "right"].map(|side| {
            let field = reader.get(&view, side)?;
            let view = reader.open(&field, &[Section::StopSide])?;
            stop(reader, &view)
        });
    }
    [stop(reader, &view); 2]
}

fn stop(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Stop> {
    let at = reader.needed_quantity(view, "at", Dimension::Length, "\"90 mm\"");
    let stiffness = reader.needed_quantity(view, "stiffness", Dimension::Stiffness, "\"60 MN/m\"");
    Some(Stop {
        at: at?,
        stiffness: stiffness?,
    })
}
