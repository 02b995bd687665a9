//! The assembled buildings, contacts and links: immutable, shared by every run of the same model.

mod assemble;
mod building;
mod damping;
mod falling_panels;
mod finite;
mod grounds;
mod half_space;
mod limited_ends;
mod members;
mod plan_mat;
mod plan_soil;
mod plan_storey;
mod rating;
mod soil;
mod weakening;

use std::ops::Range;

use crate::interface::{Contact, EdgeEnd, Friction, LinkElement, Port, PortPair};
use crate::linear::Row;
use crate::model::{LEVEL_TOLERANCE, WALL};

pub use building::{BuildingSystem, Corner, Direction, Floor, SpringSupport, Track};
pub use damping::DampedMode;
pub(crate) use grounds::{GroundsAt, OverStep, RunGrounds};
pub use limited_ends::LimitedEnd;
pub(crate) use limited_ends::PlasticRotation;
pub use plan_mat::MatInPlan;
pub use plan_soil::FoundationInPlan;
pub use plan_storey::PlanStorey;
pub use rating::{MemberRating, RatedPart};
pub use soil::FoundationPlace;

/// Buildings in a row and what stands between them, ready to be stepped.
///
/// ```
/// use jostle::{State, System};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # use towers::pair;
///
/// let model = pair(0.02); // two towers of three storeys, 20 mm apart
/// let system = System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// assert_eq!(system.contacts.len(), 3); // floors at equal height
/// let state = State::at_rest(&system, 0.0);
/// assert!(state.displacement.iter().all(|&u| u == 0.0));
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Debug)]
pub struct System {
    /// Buildings from left to right, then walls that are not rigid, as buildings of one floor.
    pub buildings: Vec<BuildingSystem>,
    /// Contacts, gap by gap, from the lowest up.
    pub contacts: Vec<Contact>,
    /// Ends of the edges that corners of buildings in space touch, contact by contact.
    pub edge_ends: Vec<EdgeEnd>,
    /// Springs and dashpots between buildings, link by link, from the lowest up; behind those of the model, those of the soil
    /// between foundations.
    pub links: Vec<LinkElement>,
    /// How many of the links are soil between foundations.
    pub soil_links: usize,
    /// Members whose forces are recorded over time: building, and member of its
    /// [`MemberForces`](crate::structure::MemberForces).
    pub members_followed: Vec<[usize; 2]>,
    /// Links whose strokes and speeds are recorded over time.
    pub links_followed: Vec<usize>,
    /// Members whose demand is compared with their capacity.
    pub ratings: Vec<MemberRating>,
    /// Walls of the model, in its order.
    pub walls: Vec<WallPlace>,
    /// Indices in [`System::walls`] of rigid walls on the two sides of every contact, then of every link; what is not listed
    /// has none.
    pub rigid_walls: Vec<[Option<usize>; 2]>,
}

/// A wall of a system.
#[derive(Clone, Debug, PartialEq)]
pub struct WallPlace {
    /// Its name.
    pub name: String,
    /// Its index in [`System::buildings`], behind those of the model; `None` is rigid.
    pub building: Option<usize>,
}

impl System {
    /// A row of assembled buildings that do not touch; contacts may be added to the list.
    #[must_use]
    pub fn of_buildings(mut buildings: Vec<BuildingSystem>) -> Self {
        let (mut offset, mut spring_offset) = (0, 0);
        for building in &mut buildings {
            building.spring_offset = spring_offset;
            spring_offset += building.equations.springs.len();
            for floor in &mut building.floors {
                floor.dof = floor.dof - building.offset + offset;
            }
            for track in &mut building.tracks {
                track.dof = track.dof - building.offset + offset;
            }
            building.foot = building.foot.map(|dof| dof - building.offset + offset);
            for dof in &mut building.plan_base {
                *dof = *dof - building.offset + offset;
            }
            if let Some(mat) = &mut building.mat_in_plan {
                mat.move_to(building.offset, offset);
            }
            if let Some(support) = &mut building.support {
                support.dof = support.dof - building.offset + offset;
            }
            if let Some(foundation) = &mut building.foundation {
                let dofs = [&mut foundation.sway, &mut foundation.rise];
                let dofs = dofs.into_iter().flatten();
                for dof in dofs.chain([&mut foundation.turning]) {
                    *dof = *dof - building.offset + offset;
                }
            }
            building.offset = offset;
            offset += building.equations.len();
        }
        Self {
            buildings,
            contacts: Vec::new(),
            edge_ends: Vec::new(),
            links: Vec::new(),
            soil_links: 0,
            members_followed: Vec::new(),
            links_followed: Vec::new(),
            ratings: Vec::new(),
            walls: Vec::new(),
            rigid_walls: Vec::new(),
        }
    }

    /// The links of the model, without the soil between foundations.
    #[must_use]
    pub fn model_links(&self) -> &[LinkElement] {
        &self.links[..self.links.len() - self.soil_links]
    }

    /// A wall that gives way, as a building of the system; `None` if it is rigid.
    pub(crate) fn moving_wall(&self, wall: usize) -> Option<(usize, &BuildingSystem)> {
        let building = self.walls.get(wall)?.building?;
        Some((building, self.buildings.get(building)?))
    }

    /// The buildings of the model, without walls.
    #[must_use]
    pub fn structures(&self) -> &[BuildingSystem] {
        let walls = self.walls.iter().filter(|wall| wall.building.is_some());
        &self.buildings[..self.buildings.len() - walls.count()]
    }

    /// Name of a side of a gap or a link of the model, `buildings` being the number of those: that of a building or a wall.
    #[must_use]
    pub fn side_name(&self, side: Option<usize>) -> &str {
        let Some(index) = side else { return WALL };
        let structures = self.structures();
        match structures.get(index) {
            Some(building) => &building.name,
            None => {
                let wall = self.walls.get(index - structures.len());
                wall.map_or(WALL, |wall| &wall.name)
            }
        }
    }

    /// Floors of a pair of points as results number them: 0 is a mat; `None` is between floors or a wall.
    #[must_use]
    pub fn floors_of(&self, ports: &PortPair) -> [Option<usize>; 2] {
        ports.0.each_ref().map(|port| {
            let port = port.as_ref()?;
            let structure = self.structures().get(port.building)?;
            let on_mat = structure.discretization.mat.is_some() && port.height == 0.0;
            if on_mat { Some(0) } else { port.floor }
        })
    }

    /// Of every contact, the ends of the edge that its corner touches, among [`System::edge_ends`].
    pub(crate) fn edge_ends_of_contacts(&self) -> Vec<Range<usize>> {
        let ends = &self.edge_ends;
        let first = |contact: usize| ends.partition_point(|end| end.contact < contact);
        (0..self.contacts.len())
            .map(|contact| first(contact)..first(contact + 1))
            .collect()
    }

    /// Contacts with friction along their faces.
    pub(crate) fn frictions(&self) -> impl Iterator<Item = &Friction> {
        let contacts = self.contacts.iter();
        contacts.filter_map(|contact| contact.friction.as_ref())
    }

    /// Points of all contacts, then those along the faces of contacts with friction.
    pub(crate) fn contact_ports(&self) -> impl Iterator<Item = &PortPair> {
        let normal = self.contacts.iter().map(|contact| &contact.ports);
        normal.chain(self.frictions().map(|friction| &friction.ports))
    }

    /// Whether faces have friction.
    pub(crate) fn has_friction(&self) -> bool {
        self.frictions().next().is_some()
    }

    /// Whether its buildings move in both horizontal directions and turn.
    #[must_use]
    pub fn is_in_space(&self) -> bool {
        self.buildings.iter().any(BuildingSystem::is_in_space)
    }

    /// Number of contacts as results list them: faces where buildings are in space, otherwise all.
    #[must_use]
    pub fn reported_contacts(&self) -> usize {
        let faces = self.contacts.iter().filter_map(|contact| contact.plan);
        let faces = faces.map(|place| place.face + 1).max();
        faces.unwrap_or(self.contacts.len())
    }

    /// Number of degrees of freedom of all buildings.
    #[must_use]
    pub fn len(&self) -> usize {
        self.buildings
            .last()
            .map_or(0, |building| building.offset + building.equations.len())
    }

    /// Whether there is nothing to move.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A contact without width between nodes of two buildings, `left` and `right` being (building, node). Its law is
    /// to be given.
    ///
    /// # Errors
    /// A message when a node cannot be pushed or carries no mass.
    pub fn contact_between(
        &self,
        left: (usize, usize),
        right: (usize, usize),
    ) -> Result<Contact, String> {
        let ports = PortPair([
            Some(self.port(left.0, left.1)?),
            Some(self.port(right.0, right.1)?),
        ]);
        Ok(Contact::without_law(ports))
    }

    /// The point of a building at a node.
    ///
    /// # Errors
    /// A message when the node cannot be pushed or carries no mass.
    pub fn port(&self, building: usize, node: usize) -> Result<Port, String> {
        let system_building = &self.buildings[building];
        let dof = system_building
            .equations
            .horizontal(node)
            .ok_or_else(|| "a contact cannot push the ground".to_owned())?;
        let mass = system_building.equations.mass[dof];
        if mass <= 0.0 {
            return Err(format!(
                "\"{}\" has no mass where it would be hit",
                system_building.name
            ));
        }
        let height = system_building.discretization.stick_model.nodes[node].y;
        let floor = system_building
            .floors
            .iter()
            .position(|floor| (floor.height - height).abs() <= LEVEL_TOLERANCE);
        Ok(Port {
            building,
            row: Row::single(system_building.offset + dof),
            mass,
            floor: floor.map(|index| index + 1),
            height,
            level: height + system_building.discretization.elevation,
        })
    }
}
