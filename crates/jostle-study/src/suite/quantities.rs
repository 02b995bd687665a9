//! The numbers of a run that a suite compares, by name, from `summary.json`.

use serde_json::Value;

/// One number of a run; greater is worse.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Name, with its unit at the end.
    pub name: String,
    /// The number, ≥ 0.
    pub value: f64,
}

/// Peaks of a floor: key of the summary, and name here.
const FLOOR: [(&str, &str); 4] = [
    ("storey_drift_peak", "storey_drift_peak"),
    (
        "total_acceleration_peak_m_s2",
        "total_acceleration_peak_m_s2",
    ),
    ("storey_shear_peak_n", "storey_shear_peak_n"),
    ("overturning_moment_peak_n_m", "overturning_moment_peak_n_m"),
];

/// Peaks of a building with a plan beside those along x.
const PLAN: [&str; 6] = [
    "drift_across_peak",
    "drift_corner_peak",
    "corner_displacement_peak_m",
    "rotation_peak_rad",
    "base_shear_across_peak_n",
    "base_torque_peak_n_m",
];

/// The same of a floor.
const FLOOR_IN_PLAN: [&str; 6] = [
    "storey_drift_across_peak",
    "storey_drift_corner_peak",
    "corner_displacement_peak_m",
    "total_acceleration_across_peak_m_s2",
    "storey_shear_across_peak_n",
    "storey_torque_peak_n_m",
];

/// All numbers of a summary, in a fixed order.
pub(super) fn quantities(summary: &Value) -> Vec<Quantity> {
    let mut all = Vec::new();
    let mut add = |name: String, value: Option<f64>| {
        all.extend(value.map(|value| Quantity {
            name,
            value: value.abs(),
        }));
    };
    for gap in list(summary, "gaps") {
        let between = list(gap, "between").filter_map(Value::as_str);
        let pair = between.collect::<Vec<_>>().join("-");
        let closing =
            list(gap, "contacts").filter_map(|contact| contact["closing_peak_m"].as_f64());
        add(format!("{pair}.impact_count"), gap["impact_count"].as_f64());
        add(format!("{pair}.peak_force_n"), gap["peak_force_n"].as_f64());
        add(
            format!("{pair}.closing_peak_m"),
            closing.max_by(f64::total_cmp),
        );
        add(
            format!("{pair}.closing_without_contact_m"),
            gap["closing_without_contact_m"].as_f64(),
        );
    }
    for building in list(summary, "buildings") {
        let name = building["name"].as_str().unwrap_or_default();
        let floors: Vec<&Value> = list(building, "floors").collect();
        let greatest = |of: &dyn Fn(&Value) -> Option<f64>| {
            floors
                .iter()
                .filter_map(|floor| of(floor))
                .max_by(f64::total_cmp)
        };
        let roof = floors.last().copied();
        add(
            format!("{name}.base_shear_peak_n"),
            building["base_shear_peak_n"].as_f64(),
        );
        add(
            format!("{name}.roof_displacement_peak_m"),
            roof.and_then(displacement),
        );
        add(
            format!("{name}.drift_peak"),
            greatest(&|floor| floor["storey_drift_peak"].as_f64()),
        );
        add(
            format!("{name}.total_acceleration_peak_m_s2"),
            greatest(&|floor| floor["total_acceleration_peak_m_s2"].as_f64()),
        );
        add(
            format!("{name}.residual_drift_peak"),
            greatest(&|floor| floor["residual_drift"].as_f64().map(f64::abs)),
        );
        add(
            format!("{name}.total_acceleration_across_peak_m_s2"),
            greatest(&|floor| floor["total_acceleration_across_peak_m_s2"].as_f64()),
        );
        let apart_in_plan = &building["without_contact_in_plan"];
        for key in PLAN {
            add(format!("{name}.{key}"), building[key].as_f64());
            add(
                format!("{name}.without_contact.{key}"),
                apart_in_plan[key].as_f64(),
            );
        }
        let isolation = &building["isolation"];
        let in_plan = &isolation["in_plan"];
        let mat = ["displacement_max_m", "displacement_min_m"]
            .into_iter()
            .filter_map(|key| isolation[key].as_f64().map(f64::abs));
        let stroke = in_plan["stroke_peak_m"].as_f64();
        add(
            format!("{name}.stroke_peak_m"),
            stroke.or_else(|| mat.max_by(f64::total_cmp)),
        );
        let bearings = ["force_peak_n", "force_across_peak_n"];
        let bearings = [isolation, in_plan]
            .into_iter()
            .flat_map(|owner| bearings.map(|key| owner[key].as_f64()));
        add(
            format!("{name}.bearing_force_peak_n"),
            bearings.flatten().max_by(f64::total_cmp),
        );
        let capacity = &building["capacity"];
        add(
            format!("{name}.capacity_ratio"),
            capacity["worst"]["ratio"].as_f64(),
        );
        add(
            format!("{name}.capacity_exceeded"),
            capacity["exceeded"].as_f64(),
        );
        if building["hinges"]["total"].as_u64().unwrap_or(0) > 0 {
            add(
                format!("{name}.ductility"),
                building["hinges"]["ductility"].as_f64(),
            );
            add(
                format!("{name}.hinges_yielded"),
                building["hinges"]["yielded"].as_f64(),
            );
        }
        add(
            format!("{name}.without_contact.base_shear_peak_n"),
            building["without_contact"]["base_shear_peak_n"].as_f64(),
        );
        let apart = |floor: &Value, key: &str| floor["without_contact"][key].as_f64();
        add(
            format!("{name}.without_contact.roof_displacement_peak_m"),
            roof.and_then(|roof| displacement(&roof["without_contact"])),
        );
        add(
            format!("{name}.without_contact.drift_peak"),
            greatest(&|floor| apart(floor, "storey_drift_peak")),
        );
        add(
            format!("{name}.without_contact.total_acceleration_peak_m_s2"),
            greatest(&|floor| apart(floor, "total_acceleration_peak_m_s2")),
        );
        for floor in &floors {
            let place = format!("{name}.floor{}", floor["floor"].as_u64().unwrap_or(0));
            for key in FLOOR_IN_PLAN {
                add(format!("{place}.{key}"), floor[key].as_f64());
            }
            for (owner, middle) in [
                (*floor, ""),
                (&floor["without_contact"], ".without_contact"),
            ] {
                add(
                    format!("{place}{middle}.displacement_peak_m"),
                    displacement(owner),
                );
                for (key, name) in FLOOR {
                    add(format!("{place}{middle}.{name}"), owner[key].as_f64());
                }
            }
        }
    }
    // Over the range of the properties of bearings: the greatest of nominal, lower and upper.
    let bounds = &summary["isolation_bounds"];
    let isolated = || list(bounds, "buildings").filter(|building| !building["stroke_m"].is_null());
    for building in isolated() {
        let name = building["name"].as_str().unwrap_or_default();
        for (key, of_range) in [
            ("stroke_m", "stroke_peak_m"),
            ("force_n", "bearing_force_peak_n"),
            ("drift", "drift_peak"),
            ("storey_shear_n", "storey_shear_peak_n"),
        ] {
            let envelope = building[key]["envelope"].as_f64();
            add(format!("{name}.range.{of_range}"), envelope);
        }
    }
    for gap in list(bounds, "gaps") {
        let between: Vec<&str> = list(gap, "between").filter_map(Value::as_str).collect();
        let is_beside = |building: &Value| {
            let name = building["name"].as_str().unwrap_or_default();
            between.contains(&name)
        };
        if !isolated().any(is_beside) {
            continue;
        }
        let pair = between.join("-");
        for key in ["peak_force_n", "closing_without_contact_m"] {
            let envelope = gap[key]["envelope"].as_f64();
            add(format!("{pair}.range.{key}"), envelope);
        }
    }
    all
}

/// Greatest displacement of a floor, either sign \[m\].
pub(super) fn displacement(floor: &Value) -> Option<f64> {
    let greatest = floor["displacement_max_m"].as_f64()?;
    Some(greatest.max(-floor["displacement_min_m"].as_f64()?))
}

/// The entries of a list of a summary.
pub(super) fn list<'v>(value: &'v Value, key: &str) -> impl Iterator<Item = &'v Value> {
    value[key].as_array().into_iter().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strokes and gaps of isolated buildings, at the worst of their bounds.
    #[test]
    fn ranges_of_bearings_are_compared_by_their_envelopes() {
        let range = |envelope: f64| serde_json::json!({ "nominal": 1.0, "envelope": envelope });
        let summary = serde_json::json!({
            "buildings": [{ "name": "A", "isolation": {
                "displacement_max_m": 0.1, "displacement_min_m": -0.2, "force_peak_n": 7.0 } }],
            "isolation_bounds": {
                "buildings": [
                    { "name": "A", "stroke_m": range(3.0), "force_n": range(4.0), "drift": range(5.0) },
                    { "name": "B", "stroke_m": null, "drift": range(6.0) } ],
                "gaps": [
                    { "between": ["A", "B"], "peak_force_n": range(8.0), "closing_without_contact_m": range(9.0) },
                    { "between": ["B", "C"], "peak_force_n": range(1.0) } ],
            },
        });
        let all = quantities(&summary);
        let found: Vec<(&str, f64)> = all.iter().map(|q| (&q.name[..], q.value)).collect();
        assert_eq!(
            found,
            [
                ("A.stroke_peak_m", 0.2),
                ("A.bearing_force_peak_n", 7.0),
                ("A.range.stroke_peak_m", 3.0),
                ("A.range.bearing_force_peak_n", 4.0),
                ("A.range.drift_peak", 5.0),
                ("A-B.range.peak_force_n", 8.0),
                ("A-B.range.closing_without_contact_m", 9.0),
            ]
        );
    }

    #[test]
    fn capacities_are_compared_where_they_are_known() {
        let summary = serde_json::json!({ "buildings": [
            { "name": "A", "capacity": { "exceeded": 3, "worst": { "ratio": 1.25 } } },
            { "name": "B" },
        ] });
        let all = quantities(&summary);
        let found = all
            .iter()
            .filter(|quantity| quantity.name.contains("capacity"));
        let found: Vec<(&str, f64)> = found
            .map(|quantity| (&quantity.name[..], quantity.value))
            .collect();
        assert_eq!(
            found,
            [("A.capacity_ratio", 1.25), ("A.capacity_exceeded", 3.0)]
        );
    }
}
