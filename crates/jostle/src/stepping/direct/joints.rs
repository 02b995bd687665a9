//! Points of contacts and links, each once, and their order along the row.

use std::collections::BTreeMap;

use crate::interface::PortPair;
use crate::system::System;

/// Contacts and links of a system, counted together: contacts first, then links.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    pub(super) contacts: usize,
    /// Building and degree of freedom of every point; neighbouring gaps share those of a floor that moves as one
    /// body.
    pub(super) points: Vec<(usize, usize)>,
    /// Left and right point; `None` is a wall.
    pub(super) sides: Vec<[Option<usize>; 2]>,
    /// All of them from left to right.
    pub(super) order: Vec<usize>,
    /// For each index in that order the last index whose contact or link shares a building.
    last_partner: Vec<usize>,
}

impl Joints {
    pub(super) fn of(system: &System) -> Self {
        let mut joints = Self {
            contacts: system.contacts.len(),
            ..Self::default()
        };
        let mut met = BTreeMap::new();
        let mut buildings: Vec<[usize; 2]> = Vec::new();
        for index in 0..system.contacts.len() + system.links.len() {
            let ports = joints.ports(system, index);
            joints.sides.push(ports.0.map(|port| {
                let port = port?;
                let point = (port.building, port.dof);
                let next = joints.points.len();
                let known = *met.entry(point).or_insert(next);
                if known == next {
                    joints.points.push(point);
                }
                Some(known)
            }));
            let [left, right] = ports.buildings();
            let only = left.or(right).unwrap_or(0);
            let (left, right) = (left.unwrap_or(only), right.unwrap_or(only));
            buildings.push([left.min(right), left.max(right)]);
        }
        joints.order = (0..buildings.len()).collect();
        joints
            .order
            .sort_by_key(|&index| (buildings[index][0] + buildings[index][1], index));
        let mut last_at = vec![0; system.buildings.len()];
        for (place, &index) in joints.order.iter().enumerate() {
            for building in buildings[index] {
                last_at[building] = place;
            }
        }
        let order = joints.order.iter();
        joints.last_partner = order
            .map(|&index| {
                let [left, right] = buildings[index];
                last_at[left].max(last_at[right])
            })
            .collect();
        joints
    }

    /// The two sides of a contact or a link.
    #[inline]
    pub(super) fn ports<'a>(&self, system: &'a System, index: usize) -> &'a PortPair {
        match index.checked_sub(self.contacts) {
            None => &system.contacts[index].ports,
            Some(link) => &system.links[link].ports,
        }
    }

    pub(super) fn is_link(&self, index: usize) -> bool {
        index >= self.contacts
    }

    /// Largest distance of two coupled ones within a selection, given by their indices in the order from left to
    /// right.
    pub(super) fn reach(&self, places: &[usize]) -> usize {
        let mut reach = 0;
        for (i, &place) in places.iter().enumerate() {
            let last = self.last_partner[place];
            let until = places[i..].partition_point(|&other| other <= last);
            reach = reach.max(until.saturating_sub(1));
        }
        reach
    }
}
