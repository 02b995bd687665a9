//! Histories of runs over all displacements, row by row.

use super::Settings;
use super::energy::EnergyAudit;
use crate::history::{Column, Energy, EnergyTerm, History, SpringHistory};
use crate::interface::PlanContactKind;
use crate::state::{ContactPhase, State};
use crate::system::{Direction, GroundsAt, RunGrounds, System};

/// Recorder of histories.
pub(crate) struct Recorder {
    history: Option<History>,
    /// Loops of springs that yield, row by row with the history.
    pub(crate) springs: Option<SpringHistory>,
    interval: f64,
    due: f64,
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
    for (building, structure) in system.structures().iter().enumerate() {
        let floors = structure.floors.len();
        let tracks = structure.tracks.iter().enumerate();
        columns.extend(tracks.flat_map(|(place, track)| {
            Column::motion(building, place % floors + 1, track.direction)
        }));
    }
    let contacts = system.reported_contacts();
    columns.extend((0..contacts).map(Column::contact_force));
    columns.extend(
        (0..system.contacts.len())
            .filter_map(|contact| closing_of(system, grounds, contact))
            .map(Column::closing),
    );
    let links = system.model_links().len();
    columns.extend((0..links).map(Column::link_force));
    let followed = system.links_followed.iter();
    columns
        .extend(followed.flat_map(|&link| [Column::link_stroke(link), Column::link_speed(link)]));
    for (building, building_system) in system.buildings.iter().enumerate() {
        if building_system.support.is_some() {
            columns.extend(Column::motion(building, 0, Direction::Along));
            columns.push(Column::support_force(building));
        }
        if building_system.mat_in_plan.is_some() {
            columns.extend(Column::motion(building, 0, Direction::Across));
            columns.push(Column::support_force(building).across());
            columns.extend(Column::motion(building, 0, Direction::Turning));
        }
    }
    columns.extend(EnergyTerm::ALL.map(Column::energy));
    if system.has_friction() {
        columns.push(Column::energy(EnergyTerm::Friction));
    }
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
    /// Records histories as the settings of the run say.
    pub(crate) fn new(system: &System, grounds: &RunGrounds<'_>, settings: Settings) -> Self {
        let (interval, storage) = (settings.record_interval, settings.storage);
        let springs = system.buildings.iter();
        let springs: usize = springs.map(|spring| spring.equations.springs.len()).sum();
        Self {
            history: interval.map(|_| History::kept_in(storage, columns(system, grounds))),
            springs: interval
                .filter(|_| springs > 0)
                .map(|_| SpringHistory::new(springs, storage)),
            interval: interval.unwrap_or(0.0),
            due: 0.0,
        }
    }

    /// Expects about this many more rows.
    pub(crate) fn reserve(&mut self, rows: usize) {
        if let Some(history) = &mut self.history {
            history.reserve(rows);
        }
        if let Some(springs) = &mut self.springs {
            springs.reserve(rows);
        }
    }

    /// Why a row could not be kept.
    pub(crate) fn unstored(&self) -> Option<&str> {
        let springs = self.springs.as_ref().and_then(SpringHistory::unstored);
        self.history
            .as_ref()
            .and_then(History::unstored)
            .or(springs)
    }

    pub(crate) fn into_history(self) -> Option<History> {
        self.history
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
            .filter(|(index, _)| closing_of(system, grounds, *index).is_some())
            .for_each(|(index, contact)| {
                let [moved, ..] = grounds.closing(index, 0);
                put(contact.ports.closing(&state.displacement) + moved - contact.closing_at_rest);
            });
        let links = links.iter().take(system.model_links().len());
        links.for_each(|force| put(*force));
        for link in &system.links_followed {
            let link = &system.links[*link];
            put(link.shortening(&state.displacement));
            put(link.ports.closing(&state.velocity));
        }
        for (index, building) in system.buildings.iter().enumerate() {
            if let Some(support) = &building.support {
                put(state.displacement[support.dof]);
                put(state.velocity[support.dof]);
                let [along, across] = support.direction;
                let ground_acceleration = ground.of(index);
                let moved = along * ground_acceleration[0] + across * ground_acceleration[1];
                put(state.acceleration[support.dof] + moved);
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
        put_energies(system, &energy, grounds, &mut put);
        debug_assert!(row.next().is_none(), "every column has a value");
    }
}

/// Energies, and what grounds that move apart add, in the order of [`columns`].
pub(crate) fn put_energies(
    system: &System,
    energy: &Energy,
    grounds: &RunGrounds<'_>,
    put: &mut impl FnMut(f64),
) {
    let Energy {
        input,
        ground,
        kinetic,
        strain,
        damped,
        hysteretic,
        contact,
        friction,
        ..
    } = *energy;
    let all = [input, kinetic, strain, damped, hysteretic, contact].into_iter();
    all.for_each(&mut *put);
    if system.has_friction() {
        put(friction);
    }
    if grounds.part {
        std::iter::once(ground)
            .chain(grounds.displacements())
            .for_each(put);
    }
}

/// The reported contact whose closing histories have as that of a contact: on a column between floors, or where grounds move apart. In
/// space they have forces of faces, not what happens at points of them; a column is a face by itself.
pub(crate) fn closing_of(system: &System, grounds: &RunGrounds<'_>, index: usize) -> Option<usize> {
    let contact = &system.contacts[index];
    let Some(place) = contact.plan else {
        return (contact.is_between_floors() || grounds.part).then_some(index);
    };
    let on_column = |kind: PlanContactKind| kind == PlanContactKind::Column;
    if on_column(place.kind) {
        return Some(place.face);
    }
    let among_columns = || {
        let mut all = system.contacts.iter().filter_map(|contact| contact.plan);
        all.any(|other| on_column(other.kind))
    };
    (contact.is_between_floors() && !among_columns()).then_some(index)
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
