//! Shapes and states of hinges, packed for the page.

use std::collections::BTreeMap;

use jostle::hysteresis::Stage;
use jostle::model::{Building, Structure};
use jostle::pushover::{PushEventKind, PushedBuilding, Pushover};
use jostle::structure::{MemberEnd, SpringPlace, StickModel};
use serde_json::{Value, json};

use super::chart::Chart;
use super::space_shapes::SpaceShape;
use crate::encode::Packed;

/// Numbers of a curve spent on shapes at most.
const BUDGET: usize = 60_000;

/// Everything the script needs, as JSON that may stand in a page.
pub(super) fn payload(pushed: &[PushedBuilding], charts: &[Chart], models: &[Building]) -> String {
    let buildings = pushed.iter().zip(charts);
    let model = |one: &PushedBuilding| {
        let mut models = models.iter();
        models.find(|model| model.name == one.building.name)
    };
    let all = buildings.map(|(one, chart)| building(one, chart, model(one)));
    let all: Vec<Value> = all.collect();
    // "</script>" in a name must not end the script.
    Value::from(all).to_string().replace('<', "\\u003c")
}

fn building(one: &PushedBuilding, chart: &Chart, model: Option<&Building>) -> Value {
    let system = one.building;
    let stick_model = &system.discretization.stick_model;
    let in_space = model.and_then(|model| match &model.structure {
        Structure::Tiers(tiers) => SpaceShape::new(tiers, system),
        _ => None,
    });
    let [x_of_nodes, y_of_nodes] = match &in_space {
        Some(shape) => shape.nodes(),
        None => [
            side_by_side(stick_model),
            stick_model.nodes.iter().map(|node| node.y).collect(),
        ],
    };
    let width = x_of_nodes.iter().copied().fold(0.0, f64::max);
    let height = system.floors.last().map_or(1.0, |floor| floor.height);
    let members = stick_model.members.iter().map(|member| member.ends);
    let springs = stick_model.springs.iter().map(|spring| spring.ends);
    let lines = match &in_space {
        Some(shape) => shape.lines(),
        None => members.chain(springs).collect(),
    };
    let [roof, shear] = chart.scales();
    json!({
        "name": system.name,
        "nodes": { "x": x_of_nodes, "y": y_of_nodes },
        "lines": lines,
        "slab": if in_space.is_none() && stick_model.members.is_empty() { 0.12 * height } else { 0.0 },
        "floors": match in_space {
            Some(_) => (0..system.floors.len()).collect(),
            None => system.discretization.floors.clone(),
        },
        "hinges": in_space.as_ref().map_or_else(|| hinges(one), SpaceShape::hinges),
        "width": width,
        "height": height,
        "drift": one.curves.iter().map(|curve| curve.settings.drift).fold(1e-4, f64::max),
        "chart": { "left": roof.at(0.0), "bottom": shear.at(0.0), "x": roof.per_unit(), "y": -shear.per_unit() },
        "curves": one.curves.iter().map(|curve| self::curve(one, curve, in_space.as_ref())).collect::<Vec<_>>(),
    })
}

/// Distance between frames of a plan in the elevation that shows them side by side \[m\].
const APART: f64 = 1.0;

/// Where nodes are drawn: frames of a plan one beside the other, and the floors behind them.
fn side_by_side(stick_model: &StickModel) -> Vec<f64> {
    let mut widths: BTreeMap<usize, f64> = BTreeMap::new();
    let nodes = || stick_model.nodes.iter().enumerate();
    for (index, node) in nodes() {
        let width = widths.entry(stick_model.turn(index).elevation).or_default();
        *width = width.max(node.x);
    }
    let mut offset = 0.0;
    for width in widths.values_mut() {
        let replace = std::mem::replace(width, offset);
        offset += if replace > 0.0 { replace + APART } else { 0.0 };
    }
    nodes()
        .map(|(index, node)| widths[&stick_model.turn(index).elevation] + node.x)
        .collect()
}

/// Nodes that a hinge lies between, and to which side of them it is drawn.
fn hinges(one: &PushedBuilding) -> Vec<Value> {
    let discretization = &one.building.discretization;
    let stick_model = &discretization.stick_model;
    let hinges = stick_model
        .hinges
        .iter()
        .filter(|hinge| hinge.hysteresis.is_some());
    let springs = stick_model
        .springs
        .iter()
        .filter(|spring| spring.hysteresis.is_some());
    let ends = hinges
        .map(|hinge| hinge.ends)
        .chain(springs.map(|spring| spring.ends));
    let places = discretization
        .spring_places
        .iter()
        .map(Some)
        .chain(std::iter::repeat(None));
    let mut shown: Vec<Value> = ends
        .zip(places)
        .map(|([a, b], place)| {
            let [dx, dy] = match place {
                Some(
                    SpringPlace::Column {
                        end: MemberEnd::First,
                        ..
                    }
                    | SpringPlace::Shear {
                        end: MemberEnd::First,
                        ..
                    },
                ) => [0, 1],
                Some(
                    SpringPlace::Column {
                        end: MemberEnd::Last,
                        ..
                    }
                    | SpringPlace::Shear {
                        end: MemberEnd::Last,
                        ..
                    },
                ) => [0, -1],
                Some(SpringPlace::Beam {
                    end: MemberEnd::First,
                    ..
                }) => [1, 0],
                Some(SpringPlace::Beam {
                    end: MemberEnd::Last,
                    ..
                }) => [-1, 0],
                _ => [0, 0],
            };
            json!([a, b, dx, dy])
        })
        .collect();
    // Struts and other springs without a mark count as well.
    shown.resize(
        one.building.equations.springs.len().max(shown.len()),
        Value::Null,
    );
    shown
}

fn curve(one: &PushedBuilding, curve: &Pushover, in_space: Option<&SpaceShape>) -> Value {
    let system = one.building;
    let nodes = system.discretization.stick_model.nodes.len();
    let drawn = in_space.map_or(nodes, SpaceShape::count);
    let kept = kept(curve, (BUDGET / (2 * drawn).max(1)).max(12));
    let places = (0..nodes).flat_map(|node| {
        [
            system.equations.horizontal(node),
            system.equations.vertical(node),
        ]
    });
    let places: Vec<Option<usize>> = places.collect();
    let shapes = kept.iter().flat_map(|&point| {
        let point = &curve.points[point];
        let of_node = |dof: &Option<usize>| dof.map_or(0.0, |dof| point.displacement[dof]);
        match in_space {
            Some(shape) => shape.displacements(point),
            None => places.iter().map(of_node).collect::<Vec<f64>>(),
        }
    });
    let mut stages = vec![[None::<f64>; 2]; system.equations.springs.len()];
    for point in &curve.points {
        for event in &point.events {
            // Links between floors are not drawn.
            let Some(stage) = stages.get_mut(event.spring) else {
                continue;
            };
            match event.kind {
                PushEventKind::Cracks => stage[0] = Some(point.roof),
                PushEventKind::Yields | PushEventKind::Buckles | PushEventKind::Fails => {
                    stage[1] = Some(point.roof);
                }
                PushEventKind::Closes | PushEventKind::Turns => {}
            }
        }
    }
    let all = |value: fn(&jostle::pushover::PushPoint) -> f64| -> Vec<f64> {
        curve.points.iter().map(value).collect()
    };
    let drifts = curve
        .points
        .iter()
        .flat_map(|point| point.storey_drifts.iter().copied());
    let events = curve.points.iter().filter(|point| !point.events.is_empty());
    json!({
        "sign": curve.settings.direction.sign(),
        "end": curve.points.last().map_or(1.0, |point| point.roof.max(1e-12)),
        "roof": all(|point| point.roof),
        "shear": all(|point| point.base_shear),
        "loads": curve.floor_loads,
        "events": events.map(|point| point.roof).collect::<Vec<_>>(),
        "drifts": Packed::values(drifts),
        "kept": kept.iter().map(|&point| curve.points[point].roof).collect::<Vec<_>>(),
        "shapes": Packed::values(shapes),
        "hinges": stages,
    })
}

/// Points whose shapes are kept: those that matter, and as many others as there is room for.
fn kept(curve: &Pushover, most: usize) -> Vec<usize> {
    let count = curve.points.len();
    if count <= most {
        return (0..count).collect();
    }
    let matters = [
        curve.first(Stage::Cracked),
        curve.first(Stage::Yielded),
        Some(curve.peak()),
    ];
    let of = |wanted: &jostle::pushover::PushPoint| {
        curve
            .points
            .iter()
            .position(|point| std::ptr::eq(point, wanted))
    };
    let mut kept: Vec<usize> = matters.into_iter().flatten().filter_map(of).collect();
    kept.extend((0..most).map(|k| k * (count - 1) / (most - 1)));
    kept.sort_unstable();
    kept.dedup();
    kept
}
