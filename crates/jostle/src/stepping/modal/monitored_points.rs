//! Points of a building whose motion is monitored.

use super::links::own_dashpots;
use super::plan_rows;
use crate::linear::Row;
use crate::system::System;

/// Monitored displacements of a building: its floors from the ground up, then other points of contacts, links and
/// dashpots; and those of contacts, links and dashpots.
pub(super) struct MonitoredPoints {
    pub(super) places: Vec<Row>,
    pub(super) ports: Vec<Row>,
    /// Floors, from 0, and their vertical displacements among the places.
    pub(super) rising: Vec<[usize; 2]>,
}

impl MonitoredPoints {
    pub(super) fn new(system: &System, index: usize, vertical: bool) -> Self {
        let building = &system.buildings[index];
        let floors = building.tracks.iter().map(|track| track.dof);
        let mut places: Vec<Row> = floors
            .chain(building.foot)
            .chain(building.plan_base.iter().copied())
            .map(|dof| Row::single(dof - building.offset))
            .collect();
        let mut rising = Vec::new();
        if vertical {
            for (floor, dof) in building.vertical_points() {
                rising.push([floor, places.len()]);
                places.push(Row::single(dof - building.offset));
            }
        }
        let mut ports = Vec::new();
        if plan_rows::are_rows_of_floors(system) {
            return Self {
                places,
                ports,
                rising,
            };
        }
        let contacts = system.contact_ports().map(|ports| &ports.0);
        let links = system.links.iter().map(|link| &link.ports.0);
        let ends = system.edge_ends.iter().map(|end| &end.ports.0);
        let all = contacts.chain(links).chain(ends).flatten().flatten();
        let joined = all.filter(|port| port.building == index);
        let damped = own_dashpots(building).into_iter();
        let damped = damped.flat_map(|(dofs, _)| dofs).flatten();
        let joined = joined.map(|port| port.row.moved_down(building.offset));
        for row in joined.chain(damped.map(Row::single)) {
            for list in [&mut places, &mut ports] {
                if !list.contains(&row) {
                    list.push(row.clone());
                }
            }
        }
        Self {
            places,
            ports,
            rising,
        }
    }
}
