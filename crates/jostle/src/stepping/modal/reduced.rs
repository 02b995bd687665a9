//! All buildings in modal coordinates, one after the other.

use std::ops::Range;
use std::sync::Arc;

use pulp::{Arch, Simd, WithSimd};

use super::basis::{self, Basis, Demand};
use super::defects::Defects;
use super::force_rows;
use super::links::{ModalLink, own_dashpots};
use super::members::{FormRows, MemberRows};
use super::mode_kernels::{AddUp, ROWS, Show};
use super::monitored_points::MonitoredPoints;
use super::plan_rows::PlanRows;
use super::unit_force::UnitForce;
use crate::contact::ForceLaw;
use crate::history::Work;
use crate::interface::InterfaceGraph;
use crate::linear::NotPositive;
use crate::linear::Row;
use crate::motion::Ground;
use crate::simd;
use crate::system::{BuildingSystem, Direction, GroundsAt, System};

/// A row of buildings as oscillators, with their displacements at floors and contacts.
pub(super) struct Reduced {
    /// d = 2ζω of every mode \[1/s\].
    pub(super) damping: Vec<f64>,
    /// k = ω² \[1/s²\].
    pub(super) stiffness: Vec<f64>,
    /// Γ = φᵀM r along x, and across; the latter is empty in one plane \[kg^½\].
    pub(super) participation: Vec<f64>,
    pub(super) across: Vec<f64>,
    /// Γ upwards; empty unless the ground shakes vertically \[kg^½\].
    pub(super) upwards: Vec<f64>,
    vertical: bool,
    /// Direction of every monitored displacement; points of contacts and links count as along x.
    pub(super) directions: Vec<Direction>,
    pub(super) buildings: Vec<ReducedBuilding>,
    /// The available registers.
    arch: Arch,
    /// Where the two faces of every contact show, then those of friction along them; `None` is a wall.
    pub(super) ports: Vec<[Option<Shown>; 2]>,
    /// Of every contact, the place of its friction in the list of ports and in all that follow its order.
    pub(super) friction: Vec<Option<usize>>,
    /// Where the two sides of every end of an edge show, and the ends of every contact.
    pub(super) edge_ends: Vec<[Option<Shown>; 2]>,
    pub(super) ends_of: Vec<Range<usize>>,
    /// The contact of every entry of that order.
    pub(super) contact_of: Vec<usize>,
    /// What a force at every contact makes of modal loads, then friction.
    pub(super) unit_forces: Vec<UnitForce>,
    /// Links of the system, then damping of buildings that couples their modes.
    pub(super) links: Vec<ModalLink>,
    /// Number of links between buildings or floors.
    joined: usize,
    /// The order in which forces of contacts are solved for.
    pub(super) graph: InterfaceGraph,
    /// Contacts of buildings in space; their ports are then those of walls.
    pub(super) plan: Option<PlanRows>,
}

/// A contact point: its building, and its index among all monitored displacements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    pub(super) building: usize,
    pub(super) watched: usize,
}

/// Modes and monitored displacements of one building.
pub(super) struct ReducedBuilding {
    /// Its modes among all.
    pub(super) modes: Range<usize>,
    /// Its monitored quantities among all: displacements of floors from the ground up, then of other contact
    /// points, the base shear \[m, N\], and padding to a whole block.
    pub(super) watched: Range<usize>,
    /// Shears of its storeys from the ground up, then their overturning moments, among all \[N, N·m\], and padding
    /// to a whole block.
    pub(super) forces: Range<usize>,
    /// Number of displacements of floors, the place of the foot where the base gives way sideways, and the index of the base
    /// shear.
    pub(super) floors: usize,
    /// Floors, from 0, and places of vertical displacements among all.
    pub(super) rising: Vec<[usize; 2]>,
    pub(super) foot: Option<usize>,
    pub(super) shear: usize,
    /// Shapes at a block of monitored displacements, mode by mode; padding rows are zero \[kg^−½\].
    pub(super) blocks: Vec<[f64; ROWS]>,
    /// Shapes as forces of storeys, likewise \[N·kg^−½, N·m·kg^−½\].
    pub(super) force_blocks: Vec<[f64; ROWS]>,
    /// What dashpots of links between its floors add to forces of storeys, row by row, over modal velocities; empty without any
    /// \[N·s·m⁻¹·kg^−½, N·s·kg^−½\].
    pub(super) force_dashpots: Vec<Vec<f64>>,
    /// Additional static contribution of a unit acceleration of every mode to forces of storeys, and the remaining
    /// error; empty if all natural modes are used \[N·s²·m⁻¹·kg^−½, N·s²·kg^−½\].
    pub(super) forces_missed: Vec<[f64; ROWS]>,
    pub(super) forces_off: Vec<[f64; ROWS]>,
    /// Forces of columns and beams that are followed.
    pub(super) members: MemberRows,
    /// Static error of monitored quantities per unit acceleration of every mode; empty if all natural modes are
    /// used.
    pub(super) missed: Vec<[f64; ROWS]>,
    /// Number of degrees of freedom, and the shapes over all of them.
    size: usize,
    pub(super) basis: Arc<Basis>,
}

impl ReducedBuilding {
    /// Place among all that is watched of a displacement of the base of a building in plan, which follow its floors and its foot.
    pub(super) fn place_of_base(&self, building: &BuildingSystem, dof: usize) -> Option<usize> {
        let mut base = building.plan_base.iter();
        let at = base.position(|base| *base == dof)?;
        Some(self.watched.start + self.floors + usize::from(self.foot.is_some()) + at)
    }

    /// Whether dashpots of links between its floors take part in its base shear, which is then the shear of its lowest storey. An
    /// isolated building has that of its bearings.
    pub(super) fn is_damped_at_base(&self, building: &BuildingSystem) -> bool {
        !self.force_dashpots.is_empty() && building.support.is_none()
    }
}

/// Damping ratio above which missing shapes respond statically to the residuals, from random models \[–\].
const WELL_DAMPED: f64 = 0.035;
/// Remaining fraction of the error of forces after the correction, from random models \[–\].
const SECOND_ORDER: f64 = 0.5;
/// Largest amplification at low damping \[–\].
const MOST_RESONANCE: f64 = 20.0;

/// Dynamic amplification of natural modes outside the shapes, which grows with 1/(2ζ); with d = 2ζω \[–\].
fn resonance(damping: &[f64], stiffness: &[f64]) -> f64 {
    let ratios = damping.iter().zip(stiffness);
    let least = ratios
        .map(|(d, k)| 0.5 * d / k.sqrt())
        .fold(WELL_DAMPED, f64::min);
    if least < WELL_DAMPED {
        (2.0 * WELL_DAMPED / least).min(MOST_RESONANCE)
    } else {
        1.0
    }
}

impl Reduced {
    /// `rates`: characteristic rates of every building; `closeness`: tolerance of its responses.
    pub(super) fn new(
        system: &System,
        rates: &[Rates],
        closeness: f64,
        vertical: bool,
        work: &mut Work,
    ) -> Result<Self, (usize, NotPositive)> {
        let mut bases = Vec::with_capacity(system.buildings.len());
        for (index, building) in system.buildings.iter().enumerate() {
            let MonitoredPoints { places, ports, .. } =
                MonitoredPoints::new(system, index, vertical);
            let Rates { pushed, swaying } = rates[index];
            let [low, high] = COMPARED.map(|factor| factor * pushed);
            let mut struck = system.contacts.iter().filter(|contact| {
                let law = matches!(contact.law, ForceLaw::Restitution { .. });
                law && contact.ports.buildings().contains(&Some(index))
            });
            let jumps = system.contacts.iter().any(|contact| {
                contact.law.onset(1.0) > 0.0 && contact.ports.buildings().contains(&Some(index))
            });
            // A force that starts with a jump first moves only the mass at the contact, then the adjacent ones.
            let at_once = jumps.then(|| basis::at_once(&building.equations));
            let met: Vec<f64> = [0.0]
                .into_iter()
                .chain(at_once)
                .chain(jumps.then_some(SOON * pushed))
                .chain([pushed])
                .collect();
            let demand = Demand {
                ports: &ports,
                floors: &places[..building.tracks.len()],
                met: &met,
                compared: &[high, low, 3.0 * swaying, swaying],
                tolerance: closeness,
            };
            // Instantly only the mass at the contact moves, which a few modes cannot represent; and damping of all
            // modes requires all natural modes.
            let basis = if struck.next().is_some()
                || building.modal_damping.is_some()
                || building.is_in_space()
                || vertical
            {
                Basis::complete(building)
            } else {
                Basis::new(building, &demand)
            };
            let basis = basis.map_err(|failure| (index, failure))?;
            work.factorizations += basis.factorizations;
            work.solves += basis.solves;
            bases.push(Arc::new(basis));
        }
        Self::with_bases(system, bases, vertical, work)
    }

    /// The same with defects of some modes of every building added, or with all natural modes of these buildings.
    pub(super) fn enriched(
        &self,
        system: &System,
        lacking: &[Vec<usize>],
        all: bool,
        work: &mut Work,
    ) -> Result<Self, (usize, NotPositive)> {
        let mut bases = Vec::with_capacity(lacking.len());
        for (index, (reduced_building, modes)) in self.buildings.iter().zip(lacking).enumerate() {
            if modes.is_empty() {
                bases.push(Arc::clone(&reduced_building.basis));
                continue;
            }
            let building = &system.buildings[index];
            let basis = if all {
                Basis::complete(building)
            } else {
                reduced_building.basis.enriched(building, modes)
            };
            let basis = basis.map_err(|failure| (index, failure))?;
            work.factorizations += basis.factorizations;
            work.solves += basis.solves;
            bases.push(Arc::new(basis));
        }
        Self::with_bases(system, bases, self.vertical, work)
    }

    fn with_bases(
        system: &System,
        bases: Vec<Arc<Basis>>,
        vertical: bool,
        work: &mut Work,
    ) -> Result<Self, (usize, NotPositive)> {
        let mut contact_of: Vec<usize> = (0..system.contacts.len()).collect();
        let mut friction = vec![None; system.contacts.len()];
        for (index, contact) in system.contacts.iter().enumerate() {
            if contact.friction.is_some() {
                friction[index] = Some(contact_of.len());
                contact_of.push(index);
            }
        }
        let mut reduced = Self {
            damping: Vec::new(),
            stiffness: Vec::new(),
            participation: Vec::new(),
            across: Vec::new(),
            upwards: Vec::new(),
            vertical,
            directions: Vec::new(),
            buildings: Vec::new(),
            arch: Arch::new(),
            ports: vec![[None; 2]; contact_of.len()],
            friction,
            edge_ends: vec![[None; 2]; system.edge_ends.len()],
            ends_of: system.edge_ends_of_contacts(),
            contact_of,
            unit_forces: Vec::new(),
            links: Vec::new(),
            joined: system.links.len(),
            graph: InterfaceGraph::default(),
            plan: None,
        };
        for (index, basis) in bases.into_iter().enumerate() {
            let added = reduced.add_building(system, index, basis, work);
            added.map_err(|failure| (index, failure))?;
        }
        if reduced.modes() < FEW_MODES {
            reduced.arch = Arch::Scalar;
        }
        reduced.plan = PlanRows::new(system, &reduced);
        reduced.add_links(system);
        reduced.unit_forces = (0..reduced.ports.len())
            .map(|contact| UnitForce::new(&reduced, contact))
            .collect();
        for building in &mut reduced.buildings {
            building.members.set_pushes(&reduced.unit_forces);
        }
        let ports = system.contact_ports();
        let groups =
            (0..reduced.buildings.len()).map(|building| reduced.linked_with(building).start);
        let groups: Vec<usize> = groups.collect();
        reduced.graph = InterfaceGraph::new(ports, groups.len(), |building| groups[building]);
        Ok(reduced)
    }

    fn add_links(&mut self, system: &System) {
        let shown = |building: usize, row: Row| {
            let MonitoredPoints { places, .. } =
                MonitoredPoints::new(system, building, self.vertical);
            let place = places.iter().position(|place| *place == row)?;
            Some(Shown {
                building,
                watched: self.buildings[building].watched.start + place,
            })
        };
        let mut links = Vec::new();
        for (index, link) in system.links.iter().enumerate() {
            let ports = link.ports.0.each_ref().map(|port| {
                let port = port.as_ref()?;
                let offset = system.buildings[port.building].offset;
                shown(port.building, port.row.moved_down(offset))
            });
            let factors = [link.stiffness, link.damping];
            links.push(ModalLink::new(self, Some(index), ports, factors));
        }
        for (index, building) in system.buildings.iter().enumerate() {
            for (dofs, damping) in own_dashpots(building) {
                let ports = dofs.map(|dof| shown(index, Row::single(dof?)));
                links.push(ModalLink::new(self, None, ports, [0.0, damping]));
            }
        }
        self.links = links;
    }

    /// Buildings that links join with one, itself included; neighbours in the row.
    pub(super) fn linked_with(&self, building: usize) -> Range<usize> {
        let mut group = building..building + 1;
        loop {
            let before = group.clone();
            for link in &self.links {
                if link.buildings().any(|building| group.contains(&building)) {
                    for building in link.buildings() {
                        group = group.start.min(building)..group.end.max(building + 1);
                    }
                }
            }
            if group == before {
                return group;
            }
        }
    }

    fn add_building(
        &mut self,
        system: &System,
        index: usize,
        basis: Arc<Basis>,
        work: &mut Work,
    ) -> Result<(), NotPositive> {
        let building = &system.buildings[index];
        let equations = &building.equations;
        let MonitoredPoints { places, rising, .. } =
            MonitoredPoints::new(system, index, self.vertical);
        let watching = self.watched();
        let rising = rising
            .into_iter()
            .map(|[floor, place]| [floor, watching + place]);
        let ends = system.edge_ends.iter().map(|end| &end.ports);
        let all = self.ports.iter_mut().zip(system.contact_ports());
        for (ports, pair) in all.chain(self.edge_ends.iter_mut().zip(ends)) {
            for (shown, port) in ports.iter_mut().zip(&pair.0) {
                let Some(port) = port.as_ref().filter(|port| port.building == index) else {
                    continue;
                };
                let row = port.row.moved_down(building.offset);
                let place = places.iter().position(|place| *place == row);
                *shown = place.map(|place| Shown {
                    building: index,
                    watched: watching + place,
                });
            }
        }
        let start = self.stiffness.len();
        for stiffness in &basis.modes.stiffness {
            self.damping.push(match building.modal_damping {
                Some(ratio) => 2.0 * ratio * stiffness.sqrt(),
                None => equations.alpha + equations.beta * stiffness,
            });
        }
        self.stiffness.extend(&basis.modes.stiffness);
        self.participation.extend(&basis.modes.participation);
        if building.is_in_space() {
            let driven = &equations.driven_across;
            self.across
                .extend(basis.of_shapes(|vector| simd::dot(driven, vector)));
        }
        if self.vertical {
            let driven = &equations.vertical_mass;
            self.upwards
                .extend(basis.of_shapes(|vector| simd::dot(driven, vector)));
        }
        let shear = basis.of_shapes(|vector| building.elastic_base_shear(vector));
        let shown: Vec<Vec<f64>> = places
            .iter()
            .map(|place| basis.of_shapes(|vector| place.value(vector)))
            .chain([shear])
            .collect();
        let mut storeys = force_rows::of_shapes(building, &basis.modes);
        let members = storeys.split_off(2 * building.storeys.len());
        let force_dashpots = force_rows::of_dashpots(building, &basis.modes);
        let mut defects_of_members = [const { Vec::new() }; 2];
        let forcing = self.forces();
        let (mut missed, mut forces_missed, mut forces_off) = (Vec::new(), Vec::new(), Vec::new());
        if !basis.is_complete {
            let mut defects = Defects::new(building, &basis.modes, &places)?;
            work.factorizations += 1;
            work.solves += basis.len() as u64;
            let detuned = defects.detuned(&basis.modes, &self.damping[start..]);
            let resonance = resonance(&self.damping[start..], &basis.modes.stiffness);
            let first_of_members = shown.len() + storeys.len();
            forces_missed = in_blocks(&defects.rows[shown.len()..first_of_members], basis.len());
            defects_of_members[0] = defects.rows[first_of_members..].to_vec();
            for row in &mut defects.rows[shown.len()..] {
                // The static error is added to forces; the remaining error is of second order.
                row.iter_mut().for_each(|value| *value *= SECOND_ORDER);
            }
            let lists = shown.iter().chain(&storeys).chain(&members);
            for (row, shape) in defects.rows.iter_mut().zip(lists) {
                for ((value, shape), detuned) in row.iter_mut().zip(shape).zip(&detuned) {
                    *value = resonance * (*value + shape * detuned);
                }
            }
            missed = in_blocks(&defects.rows[..shown.len()], basis.len());
            forces_off = in_blocks(&defects.rows[shown.len()..first_of_members], basis.len());
            defects_of_members[1] = defects.rows.split_off(first_of_members);
        }
        self.directions
            .extend(building.tracks.iter().map(|track| track.direction));
        let blocks = in_blocks(&shown, basis.len());
        let rows = shown.len().div_ceil(ROWS) * ROWS;
        let [missed_of_members, off_of_members] = defects_of_members
            .each_ref()
            .map(|rows| (!basis.is_complete).then_some(&rows[..]));
        let member_rows = MemberRows::new(
            building,
            &basis,
            start..self.stiffness.len(),
            &self.damping[start..],
            self.buildings
                .last()
                .map_or([0; 2], |last| last.members.ends()),
            &FormRows {
                shapes: &members,
                missed: missed_of_members,
                off: off_of_members,
            },
        );
        self.directions.resize(watching + rows, Direction::Along);
        self.buildings.push(ReducedBuilding {
            modes: start..self.stiffness.len(),
            watched: watching..watching + rows,
            forces: forcing..forcing + storeys.len().div_ceil(ROWS) * ROWS,
            force_blocks: in_blocks(&storeys, basis.len()),
            force_dashpots,
            forces_missed,
            forces_off,
            members: member_rows,
            floors: building.tracks.len(),
            foot: building.foot.map(|_| building.tracks.len()),
            rising: rising.collect(),
            shear: watching + shown.len() - 1,
            blocks,
            missed,
            size: equations.len(),
            basis,
        });
        Ok(())
    }

    /// Γ of the ground motion along the row, across, and upwards; empty where nothing moves that way.
    pub(super) fn participations(&self) -> [&[f64]; 3] {
        [&self.participation, &self.across, &self.upwards]
    }

    /// Number of contacts, without friction along their faces.
    pub(super) fn unsplit_ports(&self) -> usize {
        self.friction.len()
    }

    /// Modal loads of grounds.
    pub(super) fn set_loads_of(&self, grounds: GroundsAt<'_>, loads: &mut [f64]) {
        if !grounds.is_split() {
            return self.set_ground_loads(grounds.common, loads);
        }
        for (index, building) in self.buildings.iter().enumerate() {
            let ground = grounds.of(index);
            let loads = &mut loads[building.modes.clone()];
            loads.fill(0.0);
            self.add_ground_loads(index, ground, loads);
        }
    }

    /// Adds the loads of a ground acceleration to those of the modes of one building.
    pub(super) fn add_ground_loads(&self, building: usize, ground: Ground, loads: &mut [f64]) {
        let modes = self.buildings[building].modes.clone();
        for (participations, component) in self.participations().into_iter().zip(ground) {
            let factors = participations.get(modes.clone()).unwrap_or_default();
            for (load, participation) in loads.iter_mut().zip(factors) {
                *load -= participation * component;
            }
        }
    }

    /// Modal loads of the ground motion.
    pub(super) fn set_ground_loads(&self, ground: Ground, loads: &mut [f64]) {
        for (load, participation) in loads.iter_mut().zip(&self.participation) {
            *load = -participation * ground[0];
        }
        for (load, participation) in loads.iter_mut().zip(&self.across) {
            *load -= participation * ground[1];
        }
    }

    /// Σ Γ x of a list of modes, along x, across, and upwards.
    pub(super) fn driven(&self, list: &[f64]) -> Ground {
        self.driven_by(0..self.modes(), list)
    }

    /// The same of one building.
    pub(super) fn driven_of(&self, building: usize, list: &[f64]) -> Ground {
        self.driven_by(self.buildings[building].modes.clone(), list)
    }

    fn driven_by(&self, modes: Range<usize>, list: &[f64]) -> Ground {
        self.participations()
            .map(|participations| match participations.get(modes.clone()) {
                Some(participation) => simd::dot(participation, &list[modes.clone()]),
                None => 0.0,
            })
    }

    /// The available registers.
    pub(super) fn arch(&self) -> Arch {
        self.arch
    }

    /// Number of modes of all buildings.
    pub(super) fn modes(&self) -> usize {
        self.stiffness.len()
    }

    /// Number of monitored displacements, in whole blocks.
    pub(super) fn watched(&self) -> usize {
        self.buildings
            .last()
            .map_or(0, |building| building.watched.end)
    }

    /// Number of entries of lists of monitored quantities: displacements in whole blocks, then closings of contacts in space.
    pub(super) fn listed(&self) -> usize {
        match &self.plan {
            Some(plan) => plan.end,
            None => self.watched(),
        }
    }

    /// Number of forces of storeys, in whole blocks.
    pub(super) fn forces(&self) -> usize {
        self.buildings
            .last()
            .map_or(0, |building| building.forces.end)
    }

    /// Forces of all storeys from modal displacements or velocities.
    pub(super) fn show_forces(&self, modal: &[f64], forces: &mut [f64]) {
        self.arch.dispatch(ShowForces {
            buildings: &self.buildings,
            blocks: |building| &building.force_blocks,
            modal,
            forces,
        });
    }

    /// Adds what dashpots of links between floors contribute to forces of storeys, from modal velocities, or to their rates, from
    /// modal accelerations.
    pub(super) fn add_force_dashpots(&self, modal: &[f64], forces: &mut [f64]) {
        for building in &self.buildings {
            let building_forces = &mut forces[building.forces.clone()];
            for (force, row) in building_forces.iter_mut().zip(&building.force_dashpots) {
                *force += simd::dot(row, &modal[building.modes.clone()]);
            }
        }
    }

    /// Contribution of modal accelerations, since shapes do not follow the members between masses exactly: the
    /// mode-acceleration correction (R. R. Craig, A. J. Kurdila, 2006, Fundamentals of Structural Dynamics, section
    /// 11.4).
    pub(super) fn show_forces_missed(&self, accelerations: &[f64], forces: &mut [f64]) {
        self.arch.dispatch(ShowForces {
            buildings: &self.buildings,
            blocks: |building| &building.forces_missed,
            modal: accelerations,
            forces,
        });
    }

    /// Monitored quantities from two lists of modal values.
    pub(super) fn show(&self, modal: [&[f64]; 2], watched: [&mut [f64]; 2]) {
        self.show_of(0..self.buildings.len(), modal, watched);
    }

    /// The same with the closings of contacts in space, in lists of [`Reduced::listed`] entries and more.
    pub(super) fn show_all(&self, modal: [&[f64]; 2], watched: [&mut [f64]; 2]) {
        let [first, second] = watched;
        self.show(modal, [&mut *first, &mut *second]);
        if let Some(plan) = &self.plan {
            plan.fill(self.arch, first);
            plan.fill(self.arch, second);
        }
    }

    /// The same as [`Reduced::show`] for some buildings; the lists begin with the first of them.
    pub(super) fn show_of(
        &self,
        buildings: Range<usize>,
        modal: [&[f64]; 2],
        watched: [&mut [f64]; 2],
    ) {
        let buildings = &self.buildings[buildings];
        let Some(start) = buildings.first() else {
            return;
        };
        let [first, second] = watched;
        let relative = |range: &Range<usize>, start: usize| range.start - start..range.end - start;
        for building in buildings {
            let modes = relative(&building.modes, start.modes.start);
            let places = relative(&building.watched, start.watched.start);
            self.arch.dispatch(Show {
                blocks: &building.blocks,
                modal: modal.map(|list| &list[modes.clone()]),
                watched: [&mut first[places.clone()], &mut second[places]],
            });
        }
    }

    /// Left minus right of monitored values of a contact; a wall has zero. Lists that go on beyond the monitored values
    /// hold what the grounds add, contact by contact and link by link.
    #[inline]
    pub(super) fn closing(&self, contact: usize, values: &[f64]) -> f64 {
        if let Some(plan) = &self.plan {
            return plan.closing(contact, values);
        }
        let apart = Self::apart(self.ports[contact], values);
        self.with_grounds(self.joint_of_port(contact), apart, values)
    }

    /// A contact or friction along it among the joints of [`RunGrounds`](crate::system::RunGrounds).
    #[inline]
    pub(super) fn joint_of_port(&self, port: usize) -> usize {
        if port < self.friction.len() {
            port
        } else {
            port + self.joined
        }
    }

    /// A closing with what the grounds of its joint add to it, in a list of monitored quantities.
    #[inline]
    fn with_grounds(&self, joint: usize, apart: f64, values: &[f64]) -> f64 {
        match values.get(self.listed() + joint) {
            Some(grounds) => apart + grounds,
            None => apart,
        }
    }

    /// Adds what the grounds of a joint do to a list of monitored quantities that has just been filled.
    pub(super) fn add_grounds(&self, joint: usize, value: f64, values: &mut [f64]) {
        match &self.plan {
            Some(plan) => plan.add(joint, value, values),
            None => values[self.listed() + joint] = value,
        }
    }

    /// By how much a corner has moved along an edge from its end.
    #[inline]
    pub(super) fn moved_from_end(&self, end: usize, values: &[f64]) -> f64 {
        match &self.plan {
            Some(plan) => plan.end_of_edge(end, values),
            None => {
                let grounds = self.ports.len() + self.joined + end;
                self.with_grounds(grounds, Self::apart(self.edge_ends[end], values), values)
            }
        }
    }

    /// Left minus right of monitored values; a wall has zero.
    #[inline]
    fn apart([left, right]: [Option<Shown>; 2], values: &[f64]) -> f64 {
        let at = |port: Option<Shown>| port.map_or(0.0, |shown| values[shown.watched]);
        at(left) - at(right)
    }

    /// The same of modal values.
    pub(super) fn closing_of_modes(&self, contact: usize, modal: &[f64]) -> f64 {
        let push = &self.unit_forces[contact];
        -simd::dot(&push.loads, &modal[push.modes.clone()])
    }

    /// Shape of one of its building's modes at a face \[kg^−½\].
    pub(super) fn shape(&self, port: Shown, mode: usize) -> f64 {
        let building = &self.buildings[port.building];
        let place = port.watched - building.watched.start;
        building.blocks[place / ROWS * building.modes.len() + mode][place % ROWS]
    }

    /// Adds the modal loads of a contact force.
    pub(super) fn push_apart(&self, contact: usize, force: f64, loads: &mut [f64]) {
        let push = &self.unit_forces[contact];
        self.arch.dispatch(AddUp {
            factor: force,
            of: [&push.loads],
            to: [&mut loads[push.modes.clone()]],
        });
    }

    /// Full displacements of all buildings.
    pub(super) fn expand(&self, modal: &[f64], full: &mut [f64]) {
        full.fill(0.0);
        let mut offset = 0;
        for building in &self.buildings {
            let full = &mut full[offset..offset + building.size];
            building.basis.expand(&modal[building.modes.clone()], full);
            offset += building.size;
        }
    }
}

/// Forces of the storeys of all buildings.
struct ShowForces<'a> {
    buildings: &'a [ReducedBuilding],
    blocks: fn(&ReducedBuilding) -> &[[f64; ROWS]],
    modal: &'a [f64],
    forces: &'a mut [f64],
}

impl WithSimd for ShowForces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for building in self.buildings {
            let show = Show {
                blocks: (self.blocks)(building),
                modal: [&self.modal[building.modes.clone()]],
                watched: [&mut self.forces[building.forces.clone()]],
            };
            show.with_simd(simd);
        }
    }
}

/// Rows of values of all modes, in blocks; padding rows are zero.
pub(super) fn in_blocks(rows: &[Vec<f64>], modes: usize) -> Vec<[f64; ROWS]> {
    let mut blocks = Vec::with_capacity(modes * rows.len().div_ceil(ROWS));
    for block in rows.chunks(ROWS) {
        blocks.extend((0..modes).map(|mode| {
            std::array::from_fn(|row| block.get(row).map_or(0.0, |values| values[mode]))
        }));
    }
    blocks
}

/// Characteristic rates of a building \[1/s\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Rates {
    /// π over its shortest impact.
    pub(super) pushed: f64,
    /// Frequency of its third lateral mode.
    pub(super) swaying: f64,
}

/// Rates at which responses are compared, in units of that of the shortest impact \[–\].
const COMPARED: [f64; 2] = [0.5, 2.0];
/// Rate at which the response to a force that starts with a jump is matched, in rates of an impact.
const SOON: f64 = 5.0;
/// Number of modes below which wide registers do not pay.
const FEW_MODES: usize = 8;
