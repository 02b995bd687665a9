//! Which forces of columns and beams a run follows.

use super::{MemberRating, System};
use crate::interface::PortPair;
use crate::model::MemberRequest;
use crate::structure::MemberForces;

impl System {
    /// Lets runs follow the forces of columns and beams that are asked for, and no others. Names of members that do not
    /// exist are passed over; [`Model::check`](crate::Model::check) finds them.
    pub fn follow_members(&mut self, request: &MemberRequest) {
        self.members_followed.clear();
        for index in 0..self.buildings.len() {
            self.buildings[index].members = if request.envelopes {
                self.member_forces(index)
            } else {
                let building = &self.buildings[index];
                MemberForces::followed_always(&building.structure, building.at_rest())
            };
        }
        for wanted in &request.histories {
            let known = self.member_named(wanted);
            let new = known.filter(|known| !self.members_followed.contains(known));
            self.members_followed.extend(new);
        }
        self.ratings = request
            .capacities
            .iter()
            .filter_map(|capacity| {
                let [building, member] = self.member_named(&capacity.member)?;
                Some(MemberRating::new(
                    &self.buildings[building],
                    building,
                    member,
                    capacity,
                ))
            })
            .collect();
        for joint in &request.joints {
            let Some(building) = self.buildings.get_mut(joint.building) else {
                continue;
            };
            let place = [joint.line, joint.floor];
            let added = building
                .members
                .add_joint(place, joint.half_depth, joint.levers);
            self.ratings.extend(added.map(|added| {
                MemberRating::of_joint(building, joint.building, added, &joint.capacity)
            }));
        }
    }

    /// Lets histories hold strokes and speeds of all links, or of those only that are not linear and whose strokes do not
    /// follow from displacements of floors.
    pub fn follow_links(&mut self, all: bool) {
        let links = self.links.iter().enumerate();
        let followed =
            links.filter(|(_, link)| all || !link.is_linear() && link.ports.are_between_floors());
        self.links_followed = followed.map(|(index, _)| index).collect();
    }

    /// Building and member of this name, among those whose forces are followed.
    fn member_named(&self, wanted: &str) -> Option<[usize; 2]> {
        self.buildings
            .iter()
            .enumerate()
            .find_map(|(index, building)| {
                let place = wanted.strip_prefix(&building.name[..])?.strip_prefix('.')?;
                let mut members = building.members.members.iter();
                let frames = &building.discretization.frames;
                let member = members.position(|member| member.local_name(frames) == place)?;
                Some([index, member])
            })
    }

    fn member_forces(&self, index: usize) -> MemberForces {
        let building = &self.buildings[index];
        let is_struck = |dof: usize| {
            let mut ports = self
                .contacts
                .iter()
                .flat_map(|contact| contact.ports.sides());
            ports.any(|(port, _)| port.building == index && port.is_at(building.offset + dof))
        };
        let mut forces = MemberForces::new(&building.structure, building.at_rest(), is_struck);
        for form in &mut forces.forms {
            let Some(floor) = form.left_face else {
                continue;
            };
            // The building stands right of what pushes its left face.
            let pushes = |ports: &PortPair| {
                let [_, right] = &ports.0;
                right
                    .as_ref()
                    .is_some_and(|port| port.building == index && port.floor == Some(floor + 1))
            };
            let contacts = self.contacts.iter().map(|contact| &contact.ports);
            form.contacts = positions(contacts, pushes);
            // Links inside a building end on its right face.
            let links = self.links.iter().enumerate();
            form.links = links
                .filter(|(_, link)| !link.inside && pushes(&link.ports))
                .map(|(link, _)| link)
                .collect();
        }
        forces
    }
}

fn positions<'a>(
    ports: impl Iterator<Item = &'a PortPair>,
    wanted: impl Fn(&PortPair) -> bool,
) -> Vec<usize> {
    let numbered = ports.enumerate();
    numbered
        .filter(|(_, ports)| wanted(ports))
        .map(|(index, _)| index)
        .collect()
}
