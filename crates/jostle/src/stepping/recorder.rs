//! Histories and peaks, taken after every accepted step.

use super::acceleration_parts::AccelerationParts;
use super::corner_distances::CornerDistances;
use super::energy::EnergyAudit;
use super::events::Cubic;
use super::mat_peaks::MatRecorder;
use super::member_peaks::MemberPeaks;
use super::outcome::PlanPeaks;
use super::plan_drifts::PlanDrifts;
use super::sharp_peaks::SharpPeaks;
use crate::history::{
    Column, Energy, EnergyTerm, Extreme, FloorPeaks, FoundationPeaks, History, SpringHistory,
    SupportPeaks,
};
use crate::state::{ContactPhase, State};
use crate::system::{Direction, GroundsAt, RunGrounds, System};

/// Recorder of histories and peaks.
pub(crate) struct Recorder {
    history: Option<History>,
    /// Loops of springs that yield, row by row with the history.
    pub(crate) springs: Option<SpringHistory>,
    interval: f64,
    due: f64,
    /// Of every displacement of the floors, direction by direction.
    pub(crate) floors: Vec<Vec<FloorPeaks>>,
    corners: CornerDistances,
    /// Drifts in space, building by building.
    pub(crate) drifts: Vec<PlanDrifts>,
    mats: MatRecorder,
    pub(crate) closing: Vec<Extreme>,
    pub(crate) base_shear: Vec<f64>,
    pub(crate) supports: Vec<SupportPeaks>,
    pub(crate) foundations: Vec<FoundationPeaks>,
    pub(crate) parts: AccelerationParts,
    sharp: SharpPeaks,
    pub(crate) members: MemberPeaks,
    /// Building, floor and degree of freedom of masses whose vertical displacement is followed.
    vertical: Vec<[usize; 3]>,
    /// Displacement and velocity of every floor, and closing and rate of every contact, at the start of the step.
    before: Vec<(f64, f64)>,
}

/// What a row of a history is made of.
#[derive(Clone, Copy)]
pub(crate) struct Instant<'a> {
    pub(crate) state: &'a State,
    pub(crate) contacts: &'a [ContactPhase],
    /// Forces of links \[N\].
    pub(crate) links: &'a [f64],
    pub(crate) grounds: &'a RunGrounds<'a>,
    /// Ground accelerations.
    pub(crate) ground: GroundsAt<'a>,
}

/// Columns of a history, in order.
pub(crate) fn columns(system: &System, grounds: &RunGrounds<'_>) -> Vec<Column> {
    let mut columns = vec![Column::TIME, Column::GROUND_ACCELERATION];
    if system.is_in_space() {
        columns.push(Column::GROUND_ACCELERATION.across());
    }
    for (building, own) in system.structures().iter().enumerate() {
        let floors = own.floors.len();
        let tracks = own.tracks.iter().enumerate();
        columns.extend(tracks.flat_map(|(place, track)| {
            Column::motion(building, place % floors + 1, track.direction)
        }));
    }
    let contacts = system.reported_contacts();
    columns.extend((0..contacts).map(Column::contact_force));
    columns.extend(
        (0..system.contacts.len())
            .filter(|contact| has_closing(system, grounds, *contact))
            .map(Column::closing),
    );
    let links = system.model_links().len();
    columns.extend((0..links).map(Column::link_force));
    let followed = system.links_followed.iter();
    columns
        .extend(followed.flat_map(|&link| [Column::link_stroke(link), Column::link_speed(link)]));
    for (building, own) in system.buildings.iter().enumerate() {
        if own.support.is_some() {
            columns.extend(Column::motion(building, 0, Direction::Along));
            columns.push(Column::support_force(building));
        }
        if own.mat_in_plan.is_some() {
            columns.extend(Column::motion(building, 0, Direction::Across));
            columns.push(Column::support_force(building).across());
            columns.extend(Column::motion(building, 0, Direction::Turning));
        }
    }
    columns.extend(EnergyTerm::ALL.map(Column::energy));
    if grounds.part {
        columns.push(Column::energy(EnergyTerm::Ground));
        let places = 0..grounds.places();
        columns.extend(places.clone().map(Column::ground_displacement));
        if system.is_in_space() {
            columns.extend(places.map(|building| Column::ground_displacement(building).across()));
        }
    }
    columns
}

impl Recorder {
    /// Records histories at least `interval` apart, every step for zero; `None` records only peaks. The run lasts
    /// `duration`.
    pub(crate) fn new(
        system: &System,
        grounds: &RunGrounds<'_>,
        duration: f64,
        interval: Option<f64>,
    ) -> Self {
        let buildings = system.buildings.iter();
        let floors: usize = buildings.map(|building| building.tracks.len()).sum();
        let supports = system.buildings.iter().filter(|own| own.support.is_some());
        let foundations = system.buildings.iter().filter_map(|own| own.foundation);
        let tracked = floors + system.contacts.len() + supports.count() + 2 * foundations.count();
        Self {
            history: interval.map(|_| History::new(columns(system, grounds))),
            springs: interval
                .map(|_| {
                    let buildings = system.buildings.iter();
                    buildings.map(|b| b.equations.springs.len()).sum()
                })
                .filter(|count| *count > 0)
                .map(SpringHistory::new),
            interval: interval.unwrap_or(0.0),
            due: 0.0,
            floors: system
                .buildings
                .iter()
                .map(|b| vec![FloorPeaks::default(); b.tracks.len()])
                .collect(),
            corners: CornerDistances::new(system),
            drifts: (system.buildings.iter())
                .map(|building| PlanDrifts::new(building, |dof| dof))
                .collect(),
            mats: MatRecorder::new(system),
            closing: vec![Extreme::default(); system.contacts.len()],
            base_shear: vec![0.0; system.buildings.len()],
            supports: vec![SupportPeaks::default(); system.buildings.len()],
            foundations: vec![FoundationPeaks::default(); system.buildings.len()],
            parts: AccelerationParts::new(floors, duration),
            sharp: SharpPeaks::new(system, floors + system.buildings.len()),
            members: MemberPeaks::new(system, interval.is_some()),
            vertical: Vec::new(),
            before: Vec::with_capacity(tracked),
        }
    }

    /// Follows vertical displacements as well.
    pub(crate) fn follow_vertical(&mut self, system: &System, state: &State) {
        for (index, building) in system.buildings.iter().enumerate() {
            for (floor, dof) in building.vertical_points() {
                self.vertical.push([index, floor, dof]);
                let greatest = &mut self.floors[index][floor].vertical_displacement;
                *greatest = greatest.max(state.displacement[dof].abs());
            }
        }
        self.before.reserve(self.vertical.len());
    }

    /// Expects about this many more rows.
    pub(crate) fn reserve(&mut self, rows: usize) {
        if let Some(history) = &mut self.history {
            history.reserve(rows);
        }
        if let Some(springs) = &mut self.springs {
            springs.reserve(rows);
        }
        self.members.reserve(rows);
    }

    /// Peaks of the floors along x, and further ones of buildings in space.
    pub(crate) fn take_floors(
        &mut self,
        system: &System,
    ) -> (Vec<Vec<FloorPeaks>>, Vec<PlanPeaks>) {
        let mut floors = std::mem::take(&mut self.floors);
        let buildings = floors.iter_mut().zip(&system.buildings).enumerate();
        let in_plan = buildings.map(|(index, (own, building))| {
            let corners = self.corners.finish(index);
            PlanPeaks::split_off(own, building.floors.len(), corners, &self.drifts[index])
        });
        let in_plan = in_plan.collect();
        (floors, in_plan)
    }

    /// Peaks of bearings and walls.
    pub(crate) fn take_supports(&mut self) -> Vec<SupportPeaks> {
        let mut supports = std::mem::take(&mut self.supports);
        for (building, peaks) in self.mats.finish() {
            let own = &mut supports[building];
            own.damped = peaks.damped;
            own.in_plan = Some(peaks);
        }
        supports
    }

    pub(crate) fn into_history(self) -> Option<History> {
        self.history
    }

    /// Stores the tracked motions at the start of a step.
    pub(crate) fn before_step(&mut self, system: &System, state: &State, grounds: &RunGrounds<'_>) {
        self.before.clear();
        let (u, v) = (&state.displacement, &state.velocity);
        let buildings = system.buildings.iter();
        for track in buildings.flat_map(|building| &building.tracks) {
            self.before.push((u[track.dof], v[track.dof]));
        }
        self.corners.before_step(system, state);
        for (drifts, building) in self.drifts.iter_mut().zip(&system.buildings) {
            drifts.before_step(&u[building.range()], &v[building.range()]);
        }
        self.mats.before_step(system, state);
        for (index, contact) in system.contacts.iter().enumerate() {
            let ports = &contact.ports;
            let [moved, rate, _] = grounds.closing(index, 0);
            self.before
                .push((ports.closing(u) + moved, ports.closing(v) + rate));
        }
        for support in system.buildings.iter().filter_map(|own| own.support) {
            self.before.push((u[support.dof], v[support.dof]));
        }
        for foundation in system.buildings.iter().filter_map(|own| own.foundation) {
            let motions = foundation.dofs.map(|dof| (u[dof], v[dof]));
            self.before.extend(motions);
        }
        for [.., dof] in &self.vertical {
            self.before.push((u[*dof], v[*dof]));
        }
    }

    /// Updates peaks with the step that ended in `state`.
    pub(crate) fn after_step(&mut self, system: &System, instant: &Instant<'_>, step: f64) {
        let Instant {
            state,
            grounds,
            ground: all,
            links,
            ..
        } = *instant;
        let (u, v) = (&state.displacement, &state.velocity);
        let start = state.time - step;
        self.parts.begin(start, state.time);
        self.sharp.begin(state.time);
        let mut floor_of_all = 0;
        let mut before = self.before.iter();
        for (index, building) in system.buildings.iter().enumerate() {
            let ground = all.of(index);
            let mut below = building.foot.map_or(0.0, |dof| u[dof]);
            let turned = building.rocking(u);
            for (peaks, track) in self.floors[index].iter_mut().zip(&building.tracks) {
                let now = (u[track.dof], v[track.dof]);
                if track.is_lowest && track.direction != Direction::Along {
                    below = building.below_lowest(track.direction, u);
                }
                if let Some(&then) = before.next() {
                    take_extremes(
                        [&mut peaks.displacement_max, &mut peaks.displacement_min],
                        [then, now],
                        start,
                        step,
                    );
                }
                let ground = track.direction.of_ground(ground);
                let signed = state.acceleration[track.dof] + ground;
                let total = signed.abs();
                peaks.total_acceleration = peaks.total_acceleration.max(total);
                peaks.total_acceleration = self.sharp.take(signed, peaks.total_acceleration);
                self.parts.take(floor_of_all, total);
                floor_of_all += 1;
                if track.is_in_line {
                    peaks.storey_drift = peaks
                        .storey_drift
                        .max(((now.0 - below) / track.storey_height + turned).abs());
                }
                below = now.0;
            }
            let floors = &mut self.floors[index];
            building.storey_forces(state, links, |storey, force| {
                let peaks = &mut floors[storey];
                peaks.storey_shear = peaks.storey_shear.max(force.shear.abs());
                peaks.overturning_moment = peaks.overturning_moment.max(force.moment.abs());
            });
            let shear = building.base_shear(state, links);
            self.base_shear[index] = self.base_shear[index].max(shear.abs());
        }
        self.corners.after_step(system, state, start, step);
        let drifts = self.drifts.iter_mut().zip(&mut self.floors);
        for ((drifts, floors), building) in drifts.zip(&system.buildings) {
            drifts.after_step(&u[building.range()], &v[building.range()], step);
            drifts.give_to(floors);
        }
        self.mats.after_step(system, state, all, start, step);
        let contacts = system.contacts.iter().zip(&mut self.closing);
        for (index, (contact, closing)) in contacts.enumerate() {
            if let Some(&then) = before.next() {
                let ports = &contact.ports;
                let [moved, rate, _] = grounds.closing(index, 0);
                let now = (ports.closing(u) + moved, ports.closing(v) + rate);
                let greatest = greatest_in_step(then, now, start, step);
                if greatest.value > closing.value {
                    *closing = greatest;
                }
            }
        }
        let supports = self.supports.iter_mut().zip(&system.buildings);
        for (index, (peaks, building)) in supports.enumerate() {
            let Some(support) = building.support else {
                continue;
            };
            let ground = all.of(index)[0];
            if let Some(&then) = before.next() {
                let now = (u[support.dof], v[support.dof]);
                let moved = now.0 - then.0;
                if building.mat_in_plan.is_none() {
                    peaks.damped += support.damping * moved * moved / step;
                }
                take_extremes(
                    [&mut peaks.displacement_max, &mut peaks.displacement_min],
                    [then, now],
                    start,
                    step,
                );
            }
            let total = state.acceleration[support.dof] + ground;
            peaks.total_acceleration = peaks.total_acceleration.max(total.abs());
            peaks.total_acceleration = self.sharp.take(total, peaks.total_acceleration);
            let force = building.support_force(state);
            peaks.force = peaks.force.max(force.abs());
        }
        for (peaks, building) in self.foundations.iter_mut().zip(&system.buildings) {
            let Some(foundation) = &building.foundation else {
                continue;
            };
            let mut moved = [0.0; 2];
            let [sway, rocking] = [&mut peaks.sway, &mut peaks.rocking];
            for ((extremes, dof), moved) in [sway, rocking]
                .into_iter()
                .zip(foundation.dofs)
                .zip(&mut moved)
            {
                if let Some(&then) = before.next() {
                    let now = (u[dof], v[dof]);
                    *moved = now.0 - then.0;
                    take_extremes(extremes.each_mut(), [then, now], start, step);
                }
            }
            let [uu, ut, tt] = foundation.own_damping;
            let [x, turn] = moved;
            peaks.damped += (uu * x * x + 2.0 * ut * x * turn + tt * turn * turn) / step;
        }
        for &[building, floor, dof] in &self.vertical {
            let Some(&then) = before.next() else { continue };
            let now = (u[dof], v[dof]);
            let greatest = &mut self.floors[building][floor].vertical_displacement;
            for sign in [1.0, -1.0] {
                let [then, now] = [then, now].map(|(u, v)| (sign * u, sign * v));
                *greatest = greatest.max(greatest_in_step(then, now, start, step).value);
            }
        }
    }

    /// Updates peaks with accelerations that have jumped.
    pub(crate) fn after_jump(&mut self, system: &System, state: &State, grounds: GroundsAt<'_>) {
        self.sharp.forget();
        self.parts.begin_jump();
        let mut floor_of_all = 0;
        let buildings = system.buildings.iter().zip(&mut self.floors);
        for (index, (building, floors)) in buildings.enumerate() {
            let ground = grounds.of(index);
            for (peaks, track) in floors.iter_mut().zip(&building.tracks) {
                let ground = track.direction.of_ground(ground);
                let total = (state.acceleration[track.dof] + ground).abs();
                peaks.total_acceleration = peaks.total_acceleration.max(total);
                self.parts.take(floor_of_all, total);
                floor_of_all += 1;
            }
        }
    }

    /// Whether a row of the history is due at a time, or `wanted` and there is a history.
    pub(crate) fn is_due(&self, time: f64, wanted: bool) -> bool {
        self.history.is_some() && (wanted || time >= self.due)
    }

    /// Adds a row to the history when one is due, or at once when it is `wanted`.
    pub(crate) fn record(
        &mut self,
        system: &System,
        instant: &Instant<'_>,
        wanted: bool,
        audit: &mut EnergyAudit,
    ) {
        let Instant {
            state,
            contacts,
            links,
            grounds,
            ground,
        } = *instant;
        if !self.is_due(state.time, wanted) {
            return;
        }
        let Some(history) = &mut self.history else {
            return;
        };
        self.due = state.time + self.interval * (1.0 - 1e-9);
        let energy = audit.balance(system, state, grounds);
        if let Some(springs) = &mut self.springs {
            springs.push(&state.springs);
        }
        self.members.record(system, state.time);
        let mut row = history.push_row().iter_mut();
        let mut put = |value: f64| {
            if let Some(place) = row.next() {
                *place = value;
            }
        };
        put(state.time);
        put(ground.common[0]);
        let in_space = system.is_in_space();
        if in_space {
            put(ground.common[1]);
        }
        for (index, building) in system.structures().iter().enumerate() {
            let ground = ground.of(index);
            for track in &building.tracks {
                put(state.displacement[track.dof]);
                put(state.velocity[track.dof]);
                put(state.acceleration[track.dof] + track.direction.of_ground(ground));
            }
        }
        if in_space {
            forces_of_faces(system, contacts, &mut put);
        } else {
            contacts.iter().for_each(|phase| put(phase.force()));
        }
        let contacts = system.contacts.iter().enumerate();
        contacts
            .filter(|(index, _)| has_closing(system, grounds, *index))
            .for_each(|(index, contact)| {
                let [moved, ..] = grounds.closing(index, 0);
                put(contact.ports.closing(&state.displacement) + moved);
            });
        let own = links.iter().take(system.model_links().len());
        own.for_each(|force| put(*force));
        for link in &system.links_followed {
            let link = &system.links[*link];
            put(link.shortening(&state.displacement));
            put(link.ports.closing(&state.velocity));
        }
        for (index, building) in system.buildings.iter().enumerate() {
            if let Some(support) = &building.support {
                put(state.displacement[support.dof]);
                put(state.velocity[support.dof]);
                put(state.acceleration[support.dof] + ground.of(index)[0]);
                put(building.support_force(state));
            }
            let Some((mat, forces)) =
                (building.mat_in_plan.as_ref()).zip(building.bearing_forces(state))
            else {
                continue;
            };
            let [_, across, turn] = mat.dofs;
            put(state.displacement[across]);
            put(state.velocity[across]);
            put(state.acceleration[across] + ground.of(index)[1]);
            put(forces[1]);
            put(state.displacement[turn]);
            put(state.velocity[turn]);
            put(state.acceleration[turn]);
        }
        let Energy {
            input,
            ground: energy_of_grounds,
            kinetic,
            strain,
            damped,
            hysteretic,
            contact,
            ..
        } = energy;
        [input, kinetic, strain, damped, hysteretic, contact]
            .into_iter()
            .for_each(&mut put);
        if grounds.part {
            std::iter::once(energy_of_grounds)
                .chain(grounds.displacements())
                .for_each(put);
        }
        debug_assert!(row.next().is_none(), "every column has a value");
    }
}

/// Whether histories have the closing of a contact: on a column between floors, or where grounds move apart. In space they have
/// forces of faces, not what happens at points of them.
pub(crate) fn has_closing(system: &System, grounds: &RunGrounds<'_>, contact: usize) -> bool {
    let contact = &system.contacts[contact];
    contact.is_between_floors() || (grounds.part && contact.plan.is_none())
}

/// Calls `put` with the force of every face of buildings in space, the sum of those of its points \[N\].
pub(crate) fn forces_of_faces(system: &System, phases: &[ContactPhase], mut put: impl FnMut(f64)) {
    // The points of a face follow each other.
    let mut points = system.contacts.iter().zip(phases).peekable();
    while let Some((contact, phase)) = points.next() {
        let face = contact.plan.map(|place| place.face);
        let mut force = phase.force();
        while let Some((_, phase)) =
            points.next_if(|(next, _)| next.plan.map(|place| place.face) == face)
        {
            force += phase.force();
        }
        put(force);
    }
}

/// Updates the extremes of a displacement with a step between (value, slope) at its ends.
pub(super) fn take_extremes(
    [max, min]: [&mut Extreme; 2],
    [then, now]: [(f64, f64); 2],
    start: f64,
    step: f64,
) {
    let greatest = greatest_in_step(then, now, start, step);
    if greatest.value > max.value {
        *max = greatest;
    }
    let least = greatest_in_step((-then.0, -then.1), (-now.0, -now.1), start, step);
    if -least.value < min.value {
        *min = Extreme {
            value: -least.value,
            at: least.at,
        };
    }
}

/// The largest excess of a cubic over the range of its ends, in steps times the sum of its end slopes: 4/27.
pub(crate) const BEYOND: f64 = 0.15;

/// Greatest value in a step between (value, slope) at its ends.
pub(crate) fn greatest_in_step(
    then: (f64, f64),
    now: (f64, f64),
    start: f64,
    step: f64,
) -> Extreme {
    let end = Extreme {
        value: now.0,
        at: start + step,
    };
    if then.1 <= 0.0 || now.1 >= 0.0 {
        return end;
    }
    Cubic::new(then.0, then.1, now.0, now.1, step)
        .peak(start, step)
        .unwrap_or(end)
}
