//! `pushover.csv` and `pushover.json`: capacity curves with units in the names of columns and fields.

use std::fmt::Write;

use jostle::hysteresis::Stage;
use jostle::pushover::{Bilinear, PushEnd, PushPoint, PushedBuilding, Pushover};
use serde_json::{Value, json};

use crate::csv::csv_field;

/// Every corner of every curve as a row. A building of fewer storeys leaves the columns of the others empty.
#[must_use]
pub fn pushover_csv(pushed: &[PushedBuilding]) -> String {
    let storeys = pushed.iter().map(|one| one.building.floors.len()).max();
    let storeys = storeys.unwrap_or(0);
    let mut text = String::from(
        "building,direction,point,roof_displacement_m,roof_drift,base_shear_n,base_shear_coefficient",
    );
    for storey in 1..=storeys {
        // Writing to a string cannot fail.
        let _ = write!(text, ",storey{storey}_drift");
    }
    text.push_str(",events\n");
    for one in pushed {
        for curve in &one.curves {
            for (index, point) in curve.points.iter().enumerate() {
                let _ = write!(
                    text,
                    "{},{},{index},{},{},{},{}",
                    csv_field(&one.building.name),
                    curve.settings.direction.name(),
                    point.roof,
                    curve.drift(point),
                    point.base_shear,
                    curve.coefficient(point)
                );
                for storey in 0..storeys {
                    let drift = point.storey_drifts.get(storey);
                    let _ = write!(text, ",{}", drift.map_or(String::new(), f64::to_string));
                }
                let events = point.events.iter();
                let events: Vec<String> = events
                    .map(|event| format!("{} {}", one.place(event.spring), event.kind.name()))
                    .collect();
                let _ = writeln!(text, ",{}", csv_field(&events.join("; ")));
            }
        }
    }
    text
}

/// Everything about the curves, as JSON with a final line break.
#[must_use]
pub fn pushover_json(title: &str, pushed: &[PushedBuilding]) -> String {
    format!("{:#}\n", pushover_tree(title, pushed))
}

/// The same as a tree.
#[must_use]
pub fn pushover_tree(title: &str, pushed: &[PushedBuilding]) -> Value {
    let curves: Vec<Value> = pushed
        .iter()
        .flat_map(|one| one.curves.iter().map(move |curve| curve_json(one, curve)))
        .collect();
    json!({
        "jostle": env!("CARGO_PKG_VERSION"),
        "title": title,
        "curves": curves,
    })
}

fn curve_json(one: &PushedBuilding, curve: &Pushover) -> Value {
    let place = |point: &PushPoint| {
        json!({
            "roof_displacement_m": point.roof,
            "roof_drift": curve.drift(point),
            "base_shear_n": point.base_shear,
            "base_shear_coefficient": curve.coefficient(point),
        })
    };
    let point = |point: &PushPoint| {
        let mut value = place(point);
        value["storey_drifts"] = json!(point.storey_drifts);
        let events = point.events.iter();
        let events: Vec<Value> = events
            .map(|event| json!({ "hinge": one.place(event.spring), "what": event.kind.name() }))
            .collect();
        value["events"] = json!(events);
        value
    };
    let springs = one.building.equations.springs.len();
    let [cracked, yielded] = curve.counts(springs);
    let places = one.building.discretization.spring_places.iter();
    let shear = places.filter(|place| place.is_shear()).count();
    json!({
        "building": one.building.name,
        "direction": curve.settings.direction.name(),
        "pattern": curve.settings.pattern.name(),
        "target_drift": curve.settings.drift,
        "height_m": curve.height,
        "weight_n": curve.weight,
        "floor_loads": curve.floor_loads,
        "hinges": springs - shear,
        "hinges_cracked": cracked,
        "hinges_yielded": yielded,
        "shear_failures": curve.failures(),
        "links": one.links(),
        "links_yielded": curve.links_yielded(springs),
        "end": { "target_reached": curve.end == PushEnd::Target, "reason": curve.end.to_string() },
        "first_crack": curve.first(Stage::Cracked).map(place),
        "first_yield": curve.first(Stage::Yielded).map(place),
        "peak": place(curve.peak()),
        "bilinear": Bilinear::fit(&curve.points).map(|two| json!({
            "yield_displacement_m": two.yield_displacement,
            "yield_base_shear_n": two.yield_force,
            "ultimate_displacement_m": two.ultimate_displacement,
            "ultimate_base_shear_n": two.ultimate_force,
            "stiffness_n_m": two.stiffness(),
            "hardening": two.hardening(),
            "ductility": two.ductility(),
        })),
        "points": curve.points.iter().map(point).collect::<Vec<_>>(),
    })
}
