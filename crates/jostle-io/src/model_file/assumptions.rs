//! What a valid model assumes that few drawings say: gross sections, beams without mass between their ends, bars that nothing is
//! compared with.

use jostle::hysteresis::Hysteresis;
use jostle::{Frame, Hinges, Model, Structure};

use super::{CapacityRequest, Input, KnownMembers};
use crate::quantity::{Dimension, parse_quantity};
use crate::tree::{Node, Table, Value};

/// Sections of a stiffer material do not crack \[Pa\].
pub(super) const STIFFEST_CONCRETE: f64 = 60e9;

impl Input {
    /// Assumptions of the model that make results differ from those of real buildings, each with a remedy: concrete
    /// sections that are not cracked, and beams without mass between their ends.
    #[must_use]
    pub fn assumptions(&self) -> Vec<String> {
        let mut found = of_model(&self.model, &self.origin.root);
        found.extend(self.unrated());
        found
    }

    /// That bars and ties are known, and nobody asked for the forces that are compared with what they bear. `capacity = false` says
    /// that this is meant.
    #[must_use]
    pub fn unrated(&self) -> Option<String> {
        let KnownMembers {
            reinforced,
            profiled,
        } = &self.members;
        let is_tied = reinforced
            .iter()
            .any(|member| member.section.ties.is_some());
        let is_known = is_tied || !profiled.is_empty();
        let is_asked = self.model.analysis.members.envelopes;
        let is_left = is_known && !is_asked && self.capacity == CapacityRequest::WhereKnown;
        is_left.then(|| {
            let known = match is_tied {
                true => "bars and ties",
                false => "profiles with a yield strength",
            };
            format!("columns and beams have {known}, but are not compared with their capacity: add members = true under [output]")
        })
    }
}

fn of_model(model: &Model, root: &Node) -> Vec<String> {
    let Value::Table(root) = &root.value else {
        return Vec::new();
    };
    let tables: Vec<&Table> = match root.get("building").map(|node| &node.value) {
        Some(Value::List(list)) => list.iter().filter_map(as_table).collect(),
        _ => Vec::new(),
    };
    let mut found: Vec<(String, Vec<&str>)> = Vec::new();
    for (building, table) in model.buildings.iter().zip(tables) {
        let Structure::Frame(frame) = &building.structure else {
            continue;
        };
        let assumptions = [
            gross_sections(table, building.hinges.as_ref()),
            massless_beams(frame),
        ];
        for text in assumptions.into_iter().flatten() {
            match found.iter_mut().find(|(known, _)| *known == text) {
                Some((_, names)) => names.push(&building.name),
                None => found.push((text, vec![&building.name])),
            }
        }
    }
    found
        .into_iter()
        .map(|(text, names)| format!("\"{}\": {text}", names.join("\", \"")))
        .collect()
}

fn gross_sections(building: &Table, hinges: Option<&Hinges>) -> Option<String> {
    let modulus = building.get("elastic_modulus");
    if modulus.is_some_and(|node| number(node, Dimension::Modulus) > Some(STIFFEST_CONCRETE)) {
        return None;
    }
    let (columns, beams, fibres) = match hinges {
        Some(Hinges::Frame(hinges)) => (
            &hinges.columns[..],
            &hinges.beams[..],
            hinges.fibres.values().any(|column| !column.is_surface()),
        ),
        Some(Hinges::Storeys(_)) | None => (&[][..], &[][..], false),
    };
    let gross = |key: &str, hinges: &[Vec<Hysteresis>]| {
        building.get(key).is_some_and(has_size)
            && factor(building.get("stiffness_factor"), key) >= 1.0
            && !hinges.iter().flatten().any(Hysteresis::cracks)
    };
    // Fibres of concrete crack.
    let columns_are_gross = !fibres && gross("column", columns);
    let (members, remedy) = match [columns_are_gross, gross("beam", beams)] {
        [true, true] => ("columns and beams", "{ column = 0.7, beam = 0.35 }"),
        [true, false] => ("columns", "{ column = 0.7 }"),
        [false, true] => ("beams", "{ beam = 0.35 }"),
        [false, false] => return None,
    };
    Some(format!(
        "{members} have the stiffness of the gross section, without cracks. Cracked concrete gives longer periods and needs wider gaps. Remedy: stiffness_factor = {remedy} as in ACI 318, or 0.5 as in EN 1998-1, or hinges that crack"
    ))
}

fn massless_beams(frame: &Frame) -> Option<String> {
    let none_is_given = frame.beam_mass.iter().all(|mass| *mass == 0.0);
    let (reason, remedy) = if none_is_given {
        (
            "floor_mass acts at the joints only",
            "give the load of the beams as beam_mass, and only the rest as floor_mass",
        )
    } else if frame.beam_segments.iter().all(|segments| *segments == 1) {
        (
            "with beam_segments = 1 their mass acts at the joints only",
            "leave beam_segments out; the default is 4",
        )
    } else {
        return None;
    };
    Some(format!(
        "beams have no mass between their ends: {reason}. Self weight then does not bend them, and they do not vibrate. Remedy: {remedy}"
    ))
}

pub(super) fn as_table(node: &Node) -> Option<&Table> {
    match &node.value {
        Value::Table(table) => Some(table),
        _ => None,
    }
}

/// Whether a section, or one of a list, is given by its size.
fn has_size(node: &Node) -> bool {
    match &node.value {
        Value::List(list) => list.iter().any(has_size),
        _ => as_table(node).is_some_and(|section| section.get("width").is_some()),
    }
}

/// Factor on EI of columns or beams \[–\].
pub(super) fn factor(node: Option<&Node>, key: &str) -> f64 {
    let stated = match node {
        Some(node) => as_table(node).map_or(Some(node), |table| table.get(key)),
        None => None,
    };
    stated
        .and_then(|node| number(node, Dimension::Dimensionless))
        .unwrap_or(1.0)
}

pub(super) fn number(node: &Node, dimension: Dimension) -> Option<f64> {
    match &node.value {
        Value::Text(text) => parse_quantity(text, dimension).ok(),
        Value::Integer(value) => Some(*value as f64),
        Value::Number(value) => Some(*value),
        _ => None,
    }
}
