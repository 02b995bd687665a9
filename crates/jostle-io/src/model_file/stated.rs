//! What checks need of a file beyond the model: concrete and stiffness factors.

use jostle::Model;
use jostle::judgement::StatedBuilding;
use jostle_section::StrengthLevel;
use jostle_section::formula::Member;

use super::assumptions::{STIFFEST_CONCRETE, as_table, factor, number};
use super::reinforced::ReinforcedMember;
use crate::grade::parse_concrete;
use crate::quantity::Dimension;
use crate::tree::{Node, Table, Value};

/// What a file says of every building.
pub(super) fn of_buildings(
    model: &Model,
    root: &Node,
    reinforced: &[ReinforcedMember],
) -> Vec<StatedBuilding> {
    let tables = match as_table(root).and_then(|root| root.get("building")) {
        Some(Node {
            value: Value::List(list),
            ..
        }) => list.iter().map(as_table).collect(),
        _ => Vec::new(),
    };
    let known = tables
        .into_iter()
        .map(|table| table.map_or_else(Default::default, of_building));
    let mut stated: Vec<StatedBuilding> = known.collect();
    stated.resize(model.buildings.len(), StatedBuilding::default());
    for (index, building) in stated.iter_mut().enumerate() {
        if building.hinges_from_sections {
            building.hinge_compression = hinge_compression(index, reinforced);
        }
    }
    stated
}

/// Compression for which the hinges of columns of a building are made, by storey and column line \[N\].
fn hinge_compression(building: usize, reinforced: &[ReinforcedMember]) -> Vec<Vec<f64>> {
    let mut storeys: Vec<Vec<f64>> = Vec::new();
    let columns = reinforced
        .iter()
        .filter(|member| member.building == building && member.member == Member::Column);
    for column in columns {
        storeys.resize(storeys.len().max(column.floor), Vec::new());
        let row = &mut storeys[column.floor - 1];
        // A storey without bars has no hinges of sections.
        row.resize(row.len().max(column.place), f64::NAN);
        row[column.place - 1] = column.compression;
    }
    storeys
}

fn of_building(table: &Table) -> StatedBuilding {
    let concrete = table.get("concrete").and_then(|node| match &node.value {
        Value::Text(text) => parse_concrete(text, StrengthLevel::Characteristic).ok(),
        _ => None,
    });
    let modulus = table
        .get("elastic_modulus")
        .and_then(|node| number(node, Dimension::Modulus));
    let modulus = modulus.or(concrete.map(|concrete| concrete.modulus));
    let factors = table.get("stiffness_factor");
    let hinges = table.get("hinges").and_then(as_table);
    StatedBuilding {
        strength: concrete.map(|concrete| concrete.strength),
        modulus: modulus.filter(|modulus| *modulus <= STIFFEST_CONCRETE),
        stiffness_factor: ["column", "beam"].map(|key| factor(factors, key)),
        hinges_from_sections: hinges.is_some_and(|hinges| hinges.get("from").is_some()),
        hinge_compression: Vec::new(),
        axial: table.get("axial").is_some(),
    }
}
