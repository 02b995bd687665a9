//! State of a run.

use crate::contact::Memory;
use crate::history::Extreme;
use crate::hysteresis::HysteresisMemory;
use crate::interface::{LinkElement, LinkMemory};
use crate::model::PlanPoint;
use crate::motion::{Ground, GroundMotion};
use crate::structure::{Motion, StoreyForce};
use crate::system::{BuildingSystem, MatInPlan, RunGrounds, System};

/// The state of a row of buildings at one instant; a clone is a checkpoint.
///
/// Vectors hold the degrees of freedom of all buildings, from left to right.
///
/// ```
/// use jostle::State;
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
///
/// let rest = State::at_rest(&system, motion.acceleration(0.0));
/// let checkpoint = rest.clone();
/// assert_eq!(checkpoint, rest);
/// assert_eq!(rest.displacement.len(), 6); // two towers of three floors
/// # Ok::<(), jostle::ModelFault>(())
/// ```
///
/// The default is that of no buildings at time zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// Time \[s\].
    pub time: f64,
    /// Displacement relative to the ground \[m, rad\].
    pub displacement: Vec<f64>,
    /// Velocity relative to the ground \[m/s, rad/s\].
    pub velocity: Vec<f64>,
    /// Acceleration relative to the ground \[m/s², rad/s²\].
    pub acceleration: Vec<f64>,
    /// Springs that yield, of all buildings from left to right.
    pub springs: Vec<HysteresisMemory>,
    /// Links, in the order of the system; empty if all of them are linear.
    pub links: Vec<LinkMemory>,
    /// Contacts, in the order of the system.
    pub contacts: Vec<ContactPhase>,
    /// Depth to which they are crushed by impacts that have ended, in the order of the system: their gaps are wider by it
    /// \[m\].
    pub crushed: Vec<f64>,
}

/// Whether a contact is open or closed.
#[allow(
    clippy::large_enum_variant,
    reason = "a box would allocate at every impact"
)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactPhase {
    /// The gap is open.
    Open,
    /// The contact is closed.
    Closed(Episode),
}

/// Friction of an episode of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionMemory {
    /// Slip of the face without force \[m\].
    pub origin: f64,
    /// Slip of the face when it touched \[m\].
    pub touched_at: f64,
    /// Slip speed then, along t \[m/s\].
    pub slip_speed: f64,
    /// Force now \[N\].
    pub force: f64,
    /// Greatest force so far, either sign, and its instant \[N, s\].
    pub peak: Extreme,
    /// Greatest slip since the touch, either sign \[m\].
    pub slip_peak: f64,
    /// Time integral of the force so far \[N·s\].
    pub impulse: f64,
    /// Work done so far \[J\].
    pub work: f64,
}

/// Record since a contact closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Episode {
    /// Instant of first contact \[s\].
    pub since: f64,
    /// Closing rate at first contact, > 0 \[m/s\].
    pub impact_speed: f64,
    /// Memory of the law.
    pub memory: Memory,
    /// Force now \[N\].
    pub force: f64,
    /// Last instant of force and the opening rate then; meaningful once the force has vanished \[s, m/s\].
    pub end: f64,
    /// Opening rate at `end` \[m/s\].
    pub separation_speed: f64,
    /// Greatest force so far \[N\].
    pub peak_force: f64,
    /// Its instant \[s\].
    pub peak_force_at: f64,
    /// Greatest indentation so far \[m\].
    pub peak_indentation: f64,
    /// Time integral of the force so far \[N·s\].
    pub impulse: f64,
    /// Work done so far \[J\].
    pub work: f64,
    /// Friction along the face.
    pub friction: FrictionMemory,
    /// Whether it ended because a corner slid off the edge that it pressed.
    pub slid_off: bool,
}

impl Episode {
    /// The contact closes now.
    #[must_use]
    pub(crate) fn new(since: f64, impact_speed: f64, memory: Memory) -> Self {
        Self {
            since,
            impact_speed,
            memory,
            force: 0.0,
            end: since,
            separation_speed: 0.0,
            peak_force: 0.0,
            peak_force_at: since,
            peak_indentation: 0.0,
            impulse: 0.0,
            work: 0.0,
            friction: FrictionMemory::default(),
            slid_off: false,
        }
    }
}

impl ContactPhase {
    /// Where its face begins to push: how far this impact has crushed it \[m\].
    #[inline]
    pub(crate) fn face(&self) -> f64 {
        match self {
            Self::Open => 0.0,
            Self::Closed(episode) => episode.memory.crushed,
        }
    }

    /// Contact force now \[N\].
    #[must_use]
    pub fn force(&self) -> f64 {
        match self {
            Self::Open => 0.0,
            Self::Closed(episode) => episode.force,
        }
    }
}

impl State {
    /// All buildings at rest, under self weight if included, and all contacts open, with the ground acceleration at
    /// that instant.
    #[must_use]
    pub fn at_rest(system: &System, ground_acceleration: f64) -> Self {
        Self::resting(system, |_| [ground_acceleration, 0.0, 0.0])
    }

    /// The same on the grounds of a motion, which may differ.
    #[must_use]
    pub fn at_rest_on(system: &System, motion: &GroundMotion) -> Self {
        let grounds = RunGrounds::new(system, motion);
        let common = motion.components(0.0);
        Self::resting(system, |building| grounds.at(0, common).of(building))
    }

    fn resting(system: &System, ground_acceleration: impl Fn(usize) -> Ground) -> Self {
        let n = system.len();
        let (mut displacement, mut acceleration) = (vec![0.0; n], vec![0.0; n]);
        let mut springs = Vec::new();
        for (index, building) in system.buildings.iter().enumerate() {
            let equations = &building.equations;
            for (value, rest) in displacement[building.range()]
                .iter_mut()
                .zip(&building.rest.displacement)
            {
                *value = *rest;
            }
            springs.extend(&building.rest.springs);
            springs.resize(building.spring_range().end, HysteresisMemory::default());
            equations.stay_behind(
                ground_acceleration(index),
                &mut acceleration[building.range()],
            );
        }
        Self {
            time: 0.0,
            displacement,
            velocity: vec![0.0; n],
            acceleration,
            springs,
            links: if system.links.iter().all(LinkElement::is_linear) {
                Vec::new()
            } else {
                vec![LinkMemory::default(); system.links.len()]
            },
            contacts: vec![ContactPhase::Open; system.contacts.len()],
            crushed: vec![0.0; system.contacts.len()],
        }
    }

    /// Depth to which a contact is crushed now \[m\].
    #[must_use]
    pub fn crushed_depth(&self, contact: usize) -> f64 {
        let now = match self.contacts.get(contact) {
            Some(ContactPhase::Closed(episode)) => episode.memory.crushed,
            Some(ContactPhase::Open) | None => 0.0,
        };
        now + self.crushed.get(contact).copied().unwrap_or(0.0)
    }

    /// Memories of all links; those of linear ones are empty.
    pub(crate) fn link_memories(&self) -> impl Iterator<Item = LinkMemory> {
        let linear = std::iter::repeat(LinkMemory::default());
        self.links.iter().copied().chain(linear)
    }
}

/// Forces of all bearings on the ground, along x, across, and the torque about a point, counter-clockwise \[N, N, N·m\].
pub(crate) type BearingForces = [f64; 3];

impl BuildingSystem {
    /// Base shear of springs and of links to the base, positive when the building leans to the right; `links`: forces of the
    /// links of the system \[N\].
    #[must_use]
    pub fn base_shear(&self, state: &State, links: &[f64]) -> f64 {
        let elastic = self.equations.base_shear(&state.displacement[self.range()]);
        let springs = self.equations.springs.iter();
        let yielding = springs
            .zip(&state.springs[self.spring_range()])
            .filter(|(spring, _)| spring.in_base_shear != 0.0)
            .map(|(spring, memory)| spring.in_base_shear * memory.force());
        // What a link between two floors presses on one it presses on the other.
        let inner = self.inner_links.iter();
        let inner = inner.map(|inner_link| inner_link.of_base() * links[inner_link.link]);
        elastic + yielding.sum::<f64>() + inner.sum::<f64>()
    }

    /// Force of bearings, or of the spring and dashpot of a wall, on the ground, positive when the mat or the wall is to the
    /// right; stops are not included, and zero where there is no support of that kind \[N\].
    #[must_use]
    pub fn support_force(&self, state: &State) -> f64 {
        let Some(support) = &self.support else {
            return 0.0;
        };
        if let Some([along, ..]) = self.bearing_forces(state) {
            return along;
        }
        let yielding = support.spring.map_or(0.0, |spring| {
            state.springs[self.spring_offset + spring].force()
        });
        support.stiffness * state.displacement[support.dof]
            + support.damping * state.velocity[support.dof]
            + yielding
    }

    /// Forces of its bearings on the ground along x and across \[N\], and their torque about the centre of the mat \[N·m\].
    /// Dashpots are included, the ring is not. They are positive when the mat is to the right and to the back. `None` without
    /// isolation in plan.
    pub(crate) fn bearing_forces(&self, state: &State) -> Option<BearingForces> {
        let mat = self.mat_in_plan.as_ref()?;
        Some(self.forces_on_ground(state, mat, mat.damping, mat.centre))
    }

    /// Forces on the ground of bearings without dashpots and of the ring, and their torque about the centre of mass of the lowest
    /// floor: the base shears and the base torque.
    pub(crate) fn base_forces_in_plan(&self, state: &State) -> Option<BearingForces> {
        let mat = self.mat_in_plan.as_ref()?;
        let about = self.discretization.centres.first()?;
        let mut sum = self.forces_on_ground(state, mat, 0.0, *about);
        if let Some([x, y]) = self.ring_force(state) {
            let arm = [mat.centre[0] - about[0], mat.centre[1] - about[1]];
            sum = [sum[0] + x, sum[1] + y, sum[2] + arm[0] * y - arm[1] * x];
        }
        Some(sum)
    }

    /// Force of the ring that stops its mat, along x and across; `None` without a ring \[N\].
    pub(crate) fn ring_force(&self, state: &State) -> Option<[f64; 2]> {
        let first = self.spring_offset + self.mat_in_plan.as_ref()?.ring?;
        Some([0, 1].map(|row| state.springs[first + row].force()))
    }

    fn forces_on_ground(
        &self,
        state: &State,
        mat: &MatInPlan,
        damping: f64,
        about: PlanPoint,
    ) -> BearingForces {
        let range = self.range();
        let (u, v) = (&state.displacement[range.clone()], &state.velocity[range]);
        let mut sum = [0.0; 3];
        for (index, (rows, at)) in mat.rows.iter().zip(&mat.bearings).enumerate() {
            let [x, y] = [0, 1].map(|axis| {
                let row = &rows[axis];
                let linear = mat.stiffness * row.value(u) + damping * row.value(v);
                let first = mat
                    .sliders
                    .map(|first| self.spring_offset + first + 3 * index);
                linear + first.map_or(0.0, |first| state.springs[first + axis].force())
            });
            sum[0] += x;
            sum[1] += y;
            sum[2] += (at[0] - about[0]) * y - (at[1] - about[1]) * x;
        }
        sum
    }

    /// Calls `take` with every force of columns and beams that is followed, in the order of
    /// [`MemberForces::forms`](crate::structure::MemberForces::forms) \[N, N·m\]. `links`: forces of the links of the
    /// system \[N\]; `ground`: ground acceleration \[m/s²\].
    pub fn member_forces(
        &self,
        state: &State,
        links: &[f64],
        ground: f64,
        mut take: impl FnMut(usize, f64),
    ) {
        let range = self.range();
        let motion = Motion {
            displacement: &state.displacement[range.clone()],
            velocity: &state.velocity[range.clone()],
            acceleration: &state.acceleration[range],
            ground,
        };
        let springs = &state.springs[self.spring_range()];
        for (index, form) in self.members.forms.iter().enumerate() {
            let value = form.value(
                motion,
                |spring| springs[spring].force(),
                |contact| state.contacts[contact].force(),
                |link| links[link],
            );
            take(index, value);
        }
    }

    /// Calls `take` with every storey, from the top down, its shear \[N\] and overturning moment \[N·m\]; `links`: forces of
    /// the links of the system \[N\].
    pub fn storey_forces(
        &self,
        state: &State,
        links: &[f64],
        take: impl FnMut(usize, StoreyForce),
    ) {
        let springs = &state.springs[self.spring_range()];
        let force = |spring: usize| springs[spring].force();
        let link = |index: usize| links[self.inner_links[index].link];
        self.storeys
            .for_each(&state.displacement[self.range()], force, link, take);
    }
}
