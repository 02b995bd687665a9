//! Contacts, links and friction along contacts of a system, counted together, and the points on which they act.

use crate::interface::{InterfaceGraph, Port, PortPair};
use crate::system::System;

/// Contacts, links and friction of a system, counted together: contacts first, then links, then friction along contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Joints {
    pub(super) contacts: usize,
    links: usize,
    /// Contacts with friction along them.
    rubbing: Vec<usize>,
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
            links: system.links.len(),
            rubbing: (0..system.contacts.len())
                .filter(|contact| system.contacts[*contact].friction.is_some())
                .collect(),
            ..Self::default()
        };
        for index in 0..joints.contacts + joints.links + joints.rubbing.len() {
            let ports = joints.ports(system, index).0.each_ref();
            let sides = ports.map(|port| Some(joints.point(port.as_ref()?)));
            joints.sides.push(sides);
        }
        let contacts = system.contacts.iter().map(|contact| &contact.ports);
        let links = system.links.iter().map(|link| &link.ports);
        let friction = system.frictions().map(|friction| &friction.ports);
        let all = contacts.chain(links).chain(friction);
        joints.graph = InterfaceGraph::new(all, system.buildings.len(), |building| building);
        joints
    }

    /// Index of an end of an edge behind all contacts, links and friction.
    pub(super) fn of_end(&self, end: usize) -> usize {
        self.contacts + self.links + self.rubbing.len() + end
    }

    /// Index of the point that moves as a port does.
    fn point(&mut self, port: &Port) -> usize {
        let alike = |known: &Port| known.building == port.building && known.row == port.row;
        self.points.iter().position(alike).unwrap_or_else(|| {
            self.points.push(port.clone());
            self.points.len() - 1
        })
    }

    /// The two sides of a contact, a link, or friction along a contact.
    #[inline]
    pub(super) fn ports<'a>(&self, system: &'a System, index: usize) -> &'a PortPair {
        if let Some(contact) = self.rubbed(index) {
            let contact = &system.contacts[contact];
            let along = contact.friction.as_ref();
            return along.map_or(&contact.ports, |friction| &friction.ports);
        }
        match index.checked_sub(self.contacts) {
            None => &system.contacts[index].ports,
            Some(link) => &system.links[link].ports,
        }
    }

    pub(super) fn is_link(&self, index: usize) -> bool {
        (self.contacts..self.contacts + self.links).contains(&index)
    }

    /// The contact along which it is friction; `None` for contacts and links.
    pub(super) fn rubbed(&self, index: usize) -> Option<usize> {
        let place = index.checked_sub(self.contacts + self.links)?;
        self.rubbing.get(place).copied()
    }

    /// The friction along a contact, if there is any.
    pub(super) fn friction_of(&self, contact: usize) -> Option<usize> {
        let place = self.rubbing.binary_search(&contact).ok()?;
        Some(self.contacts + self.links + place)
    }
}
