//! The tables of a script.

use std::sync::Arc;

use jostle::{Fibre, ModelFault, ProportionalDamping};

use super::materials::Materials;
use super::plan_base::DampedMass;
use super::space_frame::joints_of;
use crate::Export;

/// A script in the making: one table after the other.
pub(super) struct Script<'a> {
    pub(super) export: &'a Export<'a>,
    pub(super) materials: Materials,
    pub(super) remarks: Vec<String>,
    /// Distance of every building from the left end of the first, so that faces coincide \[m\].
    pub(super) places: Vec<f64>,
    /// Numbers from which the nodes of a building count.
    block: usize,
    pub(super) next_element: usize,
    /// Lists of fibres, in the order of their numbers.
    pub(super) fibre_lists: Vec<Arc<[Fibre]>>,
    pub(super) buildings: String,
    pub(super) nodes: String,
    pub(super) supports: String,
    pub(super) held: String,
    pub(super) ties: String,
    pub(super) members: String,
    pub(super) rigid: String,
    pub(super) springs: String,
    /// Springs of storeys and of the soil that the rotation of a foundation deforms.
    pub(super) levered: String,
    pub(super) diagonals: String,
    /// Bearings in plan that yield or slide.
    pub(super) sliders: String,
    /// Fibres, and the ends of members that are made of them.
    pub(super) fibres: String,
    pub(super) fibre_ends: String,
    pub(super) leaning: String,
    /// Masses that rise by themselves, and loads on joints.
    pub(super) carried: String,
    pub(super) contacts: String,
    pub(super) links: String,
    /// Of every building, the next node beyond those of jostle: at a point of the plan, or on a foundation.
    pub(super) next_point: Vec<usize>,
    pub(super) arms: String,
    pub(super) faces: String,
    pub(super) ends: String,
    /// Joints of space frames, and their columns and beams.
    pub(super) space_joints: String,
    pub(super) space_members: String,
    pub(super) space_hinges: String,
    /// Lengths at the ends of members of space frames that are rigid.
    pub(super) rigid_ends: String,
    /// Joints of frames at lines of a plan, and springs between them.
    pub(super) upright: String,
    pub(super) upright_springs: String,
    /// Heights of floors in plan.
    pub(super) levels: String,
    /// Panels that fall.
    pub(super) falling: String,
    /// Directions of links in plan.
    pub(super) directions: String,
    /// Bases in plan that rock, what leans with them, and points of them at a height.
    pub(super) rocking: String,
    pub(super) tilted: String,
    pub(super) riding: String,
    pub(super) raised: String,
    pub(super) tilted_storeys: String,
    /// Masses beside those of floors, of the building in the making.
    pub(super) damped: Vec<DampedMass>,
}

impl<'a> Script<'a> {
    pub(super) fn new(export: &'a Export<'a>) -> Result<Self, Vec<ModelFault>> {
        let in_plan = export.system.is_in_space();
        let joints: Vec<usize> = export.model.buildings.iter().map(joints_of).collect();
        let largest = export
            .system
            .buildings
            .iter()
            .enumerate()
            .map(|(index, building)| {
                let joints = joints.get(index).unwrap_or(&0);
                let nodes = building.discretization.stick_model.nodes.len() + joints;
                // Two points of every storey, twice with P-Delta, both of every contact and bearing, and one of the mat below every floor.
                let mat = building.mat_in_plan.as_ref();
                let bearings = mat.map_or(0, |mat| mat.bearings.len());
                let sticks = &building.discretization.stick_model;
                // A base that moves has points below masses, and twelve at most of its own.
                let moves = mat.is_some() || sticks.plan_base.is_some();
                let of_base = if moves { nodes + 12 } else { 0 };
                let supports = bearings + sticks.bed.len();
                let points = match &sticks.foundation {
                    _ if in_plan => {
                        5 * building.floors.len()
                            + 2 * (export.system.contacts.len()
                                + export.system.links.len()
                                + supports)
                            + 1
                            + of_base
                    }
                    // Two beside every mass and of every link, and those of the soil.
                    Some(_) => {
                        2 * (nodes + export.system.links.len() + 2 * export.system.buildings.len())
                            + 2
                    }
                    // The ground, and stages of a bearing.
                    None => 4,
                };
                nodes + points
            });
        let mut block = 1000;
        while block <= largest.clone().max().unwrap_or(0) {
            block *= 10;
        }
        let mut script = Self {
            export,
            materials: Materials::default(),
            remarks: Vec::new(),
            places: Vec::new(),
            block,
            next_element: 1,
            fibre_lists: Vec::new(),
            buildings: String::new(),
            nodes: String::new(),
            supports: String::new(),
            held: String::new(),
            ties: String::new(),
            members: String::new(),
            rigid: String::new(),
            springs: String::new(),
            levered: String::new(),
            diagonals: String::new(),
            sliders: String::new(),
            fibres: String::new(),
            fibre_ends: String::new(),
            leaning: String::new(),
            carried: String::new(),
            contacts: String::new(),
            links: String::new(),
            next_point: Vec::new(),
            arms: String::new(),
            faces: String::new(),
            ends: String::new(),
            space_joints: String::new(),
            space_members: String::new(),
            space_hinges: String::new(),
            rigid_ends: String::new(),
            upright: String::new(),
            upright_springs: String::new(),
            levels: String::new(),
            falling: String::new(),
            directions: String::new(),
            rocking: String::new(),
            tilted: String::new(),
            riding: String::new(),
            raised: String::new(),
            tilted_storeys: String::new(),
            damped: Vec::new(),
        };
        let mut faults = Vec::new();
        let mut place = 0.0;
        for (index, building) in export.system.buildings.iter().enumerate() {
            script.places.push(place);
            let nodes = &building.discretization.stick_model.nodes;
            place += nodes
                .iter()
                .fold(0.0, |widest: f64, node| widest.max(node.x));
            script.next_point.push(nodes.len());
            if in_plan && index >= export.model.buildings.len() {
                script.add_wall_in_plan(index, building);
                continue;
            }
            if building.is_in_space() {
                if let Err(fault) = script.add_plan_building(index, building) {
                    faults.push(fault);
                }
                continue;
            }
            if let Err(rule) = script.add_building(index, building) {
                faults.push(ModelFault {
                    path: format!("building[{index}]"),
                    problem: format!(
                        "OpenSees has no rule \"{rule}\"; normal, bilinear, peak-oriented and pinched can be exported"
                    ),
                });
            }
        }
        if in_plan {
            script.add_plan_contacts(&mut faults);
            script.add_plan_links(&mut faults);
        } else {
            script.add_contacts(&mut faults);
            script.add_links(&mut faults);
            script.add_soil();
            script.add_ground_dashpots();
            for (index, building) in export.system.buildings.iter().enumerate() {
                script.add_row(index, building);
            }
        }
        script.remark_on_springs();
        script.remark_on_motion();
        if faults.is_empty() {
            Ok(script)
        } else {
            Err(faults)
        }
    }

    pub(super) fn remarks(&self) -> &[String] {
        &self.remarks
    }

    pub(super) fn remark(&mut self, text: impl Into<String>) {
        let text = text.into();
        if !self.remarks.contains(&text) {
            self.remarks.push(text);
        }
    }

    /// Tag of a node.
    pub(super) fn tag(&self, building: usize, node: usize) -> usize {
        (building + 1) * self.block + node + 1
    }

    pub(super) fn element(&mut self) -> usize {
        self.next_element += 1;
        self.next_element - 1
    }
}

/// Coordinates without the rounding of sums.
pub(super) fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// A Python text.
pub(super) fn text(value: &str) -> String {
    let mut out = String::from("\"");
    for character in value.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            other if other.is_control() => out.push(' '),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

/// A text on one line.
pub(super) fn comment(value: &str) -> String {
    value
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

/// How Rayleigh damping acts on a spring, in Python.
pub(super) fn python_damping(damping: ProportionalDamping) -> &'static str {
    match damping {
        ProportionalDamping::Initial => "\"initial\"",
        ProportionalDamping::Tangent => "\"tangent\"",
        ProportionalDamping::None => "None",
    }
}

pub(super) fn python_bool(value: bool) -> &'static str {
    if value { "True" } else { "False" }
}
