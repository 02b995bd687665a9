//! Contacts and links of buildings in one plane.

use std::fmt::Write;

use jostle::interface::{LinkElement, Port};
use jostle::structure::Support;
use jostle::{LinkLaw, ModelFault};

use super::script::{Script, python_bool, rounded};

/// Heights closer than this are the same \[m\].
const SAME_LEVEL: f64 = 1e-3;

impl Script<'_> {
    pub(super) fn add_contacts(&mut self, faults: &mut Vec<ModelFault>) {
        let system = self.export.system;
        for contact in &system.contacts {
            let path = format!("gap[{}]", contact.gap);
            if contact.ports.0.contains(&None) {
                let told = faults
                    .iter()
                    .any(|fault| fault.path == format!("{path}.between"));
                if !told {
                    faults.push(ModelFault {
                        path: format!("{path}.between"),
                        problem: "rigid walls are not exported; leave the gap out".to_owned(),
                    });
                }
                continue;
            }
            let face = |side: usize| self.face(contact.ports.0[side].as_ref()?, side == 0);
            let (Some(a), Some(b)) = (face(0), face(1)) else {
                faults.push(ModelFault {
                    path: format!("{path}.floors"),
                    problem: format!("no nodes face each other at {:.3} m", contact.height),
                });
                continue;
            };
            let (material, remark) = match self.materials.contact(contact) {
                Ok(found) => found,
                Err(problem) => {
                    if !faults
                        .iter()
                        .any(|fault| fault.path == format!("{path}.law"))
                    {
                        faults.push(ModelFault {
                            path: format!("{path}.law"),
                            problem: problem.to_owned(),
                        });
                    }
                    continue;
                }
            };
            if let Some(remark) = remark {
                self.remark(remark);
            }
            if contact.width == 0.0 {
                self.remark("OpenSees needs a gap: sides that touch at rest are 1e-12 m apart.");
            }
            let tag = self.element();
            let floors = contact.ports.floors();
            let floor = |floor: Option<usize>| {
                floor.map_or_else(|| "None".to_owned(), |floor| floor.to_string())
            };
            let _ = writeln!(
                self.contacts,
                "    ({tag}, {a}, {b}, {material}, {:?}, {}, ({}, {}), {:?}),",
                contact.width,
                contact.gap,
                floor(floors[0]),
                floor(floors[1]),
                rounded(contact.height),
            );
        }
    }

    /// Tag of the node at a point of the right or the left face of a building.
    fn face(&self, port: &Port, right: bool) -> Option<usize> {
        let discretization = &self.export.system.buildings[port.building].discretization;
        let nodes = if right {
            &discretization.right_face
        } else {
            &discretization.left_face
        };
        let level = |node: &&usize| {
            (discretization.stick_model.nodes[**node].y - port.height).abs() <= SAME_LEVEL
        };
        let node = match nodes.iter().find(level) {
            Some(node) => *node,
            // A wall has one node, whatever the height of its contacts.
            None if port.building >= self.export.model.buildings.len() => *nodes.first()?,
            None => return None,
        };
        Some(self.tag(port.building, node))
    }

    /// Tag of a node of a building that stands still.
    fn ground(&self, building: usize) -> Option<usize> {
        let sticks = &self.export.system.buildings[building]
            .discretization
            .stick_model;
        let mut nodes = sticks.nodes.iter();
        let node = nodes.position(|node| node.support == Support::Fixed)?;
        Some(self.tag(building, node))
    }

    /// Tag of the material of a link, with its remark; a fault where OpenSees has none.
    pub(super) fn link_material(
        &mut self,
        link: &LinkElement,
        turned: bool,
        path: &str,
        faults: &mut Vec<ModelFault>,
    ) -> Option<usize> {
        match self.materials.link(link, turned) {
            Ok((material, remark)) => {
                if let Some(remark) = remark {
                    self.remark(remark);
                }
                Some(material)
            }
            Err(rule) => {
                faults.push(ModelFault {
                    path: format!("{path}.hinge.rule"),
                    problem: format!(
                        "OpenSees has no rule \"{rule}\"; normal, bilinear, peak-oriented and pinched can be exported"
                    ),
                });
                None
            }
        }
    }

    pub(super) fn add_links(&mut self, faults: &mut Vec<ModelFault>) {
        let system = self.export.system;
        for link in system.model_links() {
            let path = format!("link[{}]", link.link);
            let ports = &link.ports.0;
            let building_index = ports.iter().flatten().map(|port| port.building).next();
            let on_soil =
                match building_index.map(|building| (building, &system.buildings[building])) {
                    Some((index, building)) if link.inside => {
                        self.ends_on_foundation(index, building, link)
                    }
                    _ => None,
                };
            // Both ends of a link inside a building stand on the same face.
            let end = |side: usize| match &ports[side] {
                _ if on_soil.is_some() => on_soil.map(|soil| soil.ends[side]),
                Some(port) => self.face(port, side == 0 || link.inside),
                None => self.ground(building_index?),
            };
            let (Some(a), Some(b)) = (end(0), end(1)) else {
                faults.push(ModelFault {
                    path: format!("{path}.floors"),
                    problem: format!("there is no node at {:.3} m", link.height),
                });
                continue;
            };
            let turned = on_soil.is_some_and(|soil| soil.turned);
            if turned && matches!(link.law, LinkLaw::Stopper { .. }) && link.damping != 0.0 {
                faults.push(ModelFault {
                    path: format!("{path}.damping"),
                    problem: "of a stopper inside a building on soil is not exported: ViscoelasticGap acts in one direction only; leave it out to compare".to_owned(),
                });
                continue;
            }
            let Some(material) = self.link_material(link, turned, &path, faults) else {
                continue;
            };
            let tag = self.element();
            let floor = |floor: Option<usize>| {
                floor.map_or_else(|| "None".to_owned(), |floor| floor.to_string())
            };
            let [low, high] = link.ports.floors();
            let _ = writeln!(
                self.links,
                "    ({tag}, {a}, {b}, {material}, {}, ({}, {}), {:?}, {}),",
                link.link,
                floor(low),
                floor(high),
                rounded(link.height),
                python_bool(on_soil.is_some()),
            );
        }
    }
}
