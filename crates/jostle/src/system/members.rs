//! Which forces of columns and beams a run follows.

use super::System;
use crate::interface::Faces;
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
                MemberForces::default()
            };
        }
        for wanted in &request.histories {
            for (index, building) in self.buildings.iter().enumerate() {
                let members = building.members.members.iter();
                let names = members.map(|member| format!("{}.{}", building.name, member.place));
                let found = names.enumerate().find(|(_, name)| name == wanted);
                let known = found.map(|(member, _)| [index, member]);
                let new = known.filter(|known| !self.members_followed.contains(known));
                self.members_followed.extend(new);
            }
        }
    }

    fn member_forces(&self, index: usize) -> MemberForces {
        let building = &self.buildings[index];
        let gravity = if building.rest.displacement.is_empty() {
            0.0
        } else {
            crate::statics::STANDARD_GRAVITY
        };
        let is_struck = |dof: usize| {
            let contacts = self.contacts.iter().map(|contact| contact.faces);
            let mut faces = contacts.flat_map(|faces| faces.0).flatten();
            faces.any(|face| face.building == index && face.dof == building.offset + dof)
        };
        let mut forces = MemberForces::new(&building.structure, gravity, is_struck);
        for form in &mut forces.forms {
            let Some(floor) = form.left_face else {
                continue;
            };
            // The building stands right of what pushes its left face.
            let pushes = |faces: &Faces| {
                let [_, right] = faces.0;
                right.is_some_and(|face| face.building == index && face.floor == Some(floor + 1))
            };
            let contacts = self.contacts.iter().map(|contact| &contact.faces);
            form.contacts = positions(contacts, pushes);
            form.links = positions(self.links.iter().map(|link| &link.faces), pushes);
        }
        forces
    }
}

fn positions<'a>(
    faces: impl Iterator<Item = &'a Faces>,
    wanted: impl Fn(&Faces) -> bool,
) -> Vec<usize> {
    let numbered = faces.enumerate();
    numbered
        .filter(|(_, faces)| wanted(faces))
        .map(|(index, _)| index)
        .collect()
}
