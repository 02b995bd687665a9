//! Contacts and links of a system, counted together, and the points on which they act.

use crate::interface::{InterfaceGraph, Port, PortPair};
use crate::system::System;

/// Contacts and links of a system, counted together: contacts first, then links.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    pub(super) contacts: usize,
    /// Every point once; neighbouring gaps share those of a floor that moves as one body.
    pub(super) points: Vec<Port>,
    /// Left and right point; `None` is a wall.
    pub(super) sides: Vec<[Option<usize>; 2]>,
    /// The order in which their forces are solved for.
    pub(super) graph: InterfaceGraph,
}

impl Joints {
    pub(super) fn new(system: &System) -> Self {
        let mut joints = Self {
            contacts: system.contacts.len(),
            ..Self::default()
        };
        for index in 0..system.contacts.len() + system.links.len() {
            let ports = *joints.ports(system, index);
            let sides = ports.0.map(|port| Some(joints.point(port?)));
            joints.sides.push(sides);
        }
        let contacts = system.contacts.iter().map(|contact| &contact.ports);
        let links = system.links.iter().map(|link| &link.ports);
        let buildings = system.buildings.len();
        joints.graph = InterfaceGraph::new(contacts.chain(links), buildings, |own| own);
        joints
    }

    /// Index of the point that moves as a port does.
    fn point(&mut self, port: Port) -> usize {
        let alike = |known: &Port| known.building == port.building && known.row == port.row;
        self.points.iter().position(alike).unwrap_or_else(|| {
            self.points.push(port);
            self.points.len() - 1
        })
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
}
