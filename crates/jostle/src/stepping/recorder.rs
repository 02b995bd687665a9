//! Histories and peaks, taken after every accepted step.

use super::energy::EnergyAudit;
use super::events::Cubic;
use crate::history::{Column, Energy, EnergyTerm, Extreme, FloorPeaks, History, SpringHistory};
use crate::state::State;
use crate::system::System;

/// Takes histories and peaks.
pub(crate) struct Recorder {
    history: Option<History>,
    /// Loops of springs that yield, row by row with the history.
    pub(crate) springs: Option<SpringHistory>,
    interval: f64,
    due: f64,
    pub(crate) floors: Vec<Vec<FloorPeaks>>,
    pub(crate) closing: Vec<Extreme>,
    pub(crate) base_shear: Vec<f64>,
    /// Displacement and velocity of every floor, and closing and rate of every contact, a step ago.
    before: Vec<(f64, f64)>,
    /// Total acceleration of every floor two steps and a step ago; none after a jump or a step of another length.
    bends: Vec<[f64; 2]>,
    last_step: f64,
    /// How sharply that of every floor turned near its peaks \[m/s²\].
    sharpest: Vec<f64>,
}

/// Share of the greatest acceleration so far from which its turns count.
const NEAR_PEAK: f64 = 0.7;
/// What peaks may be off, in second differences of the values at the ends of steps. Set on the built-in example, where ten
/// times as much overstates the error tenfold; runs of lightly damped frames may miss more than it says.
const MISSED_OF_BEND: f64 = 0.04;

/// Columns of a history, in order.
pub(crate) fn columns(system: &System) -> Vec<Column> {
    let mut columns = vec![Column::Time, Column::GroundAcceleration];
    for (building, properties) in system.buildings.iter().enumerate() {
        for floor in 1..=properties.floors.len() {
            columns.extend([
                Column::Displacement { building, floor },
                Column::Velocity { building, floor },
                Column::TotalAcceleration { building, floor },
            ]);
        }
    }
    columns.extend((0..system.contacts.len()).map(|contact| Column::ContactForce { contact }));
    columns.extend((0..system.links.len()).map(|link| Column::LinkForce { link }));
    columns.extend(EnergyTerm::ALL.map(Column::Energy));
    columns
}

impl Recorder {
    /// Records histories at least `interval` apart, every step for zero; `None` only takes peaks.
    pub(crate) fn new(system: &System, interval: Option<f64>) -> Self {
        let tracked = system
            .buildings
            .iter()
            .map(|building| building.floors.len())
            .sum::<usize>()
            + system.contacts.len();
        Self {
            history: interval.map(|_| History::new(columns(system))),
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
                .map(|b| vec![FloorPeaks::default(); b.floors.len()])
                .collect(),
            closing: vec![Extreme::default(); system.contacts.len()],
            base_shear: vec![0.0; system.buildings.len()],
            before: Vec::with_capacity(tracked),
            bends: Vec::with_capacity(tracked),
            last_step: 0.0,
            sharpest: vec![0.0; system.buildings.iter().map(|b| b.floors.len()).sum()],
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

    pub(crate) fn into_history(self) -> Option<History> {
        self.history
    }

    /// Remembers the tracked motions at the start of a step.
    pub(crate) fn before_step(&mut self, system: &System, state: &State) {
        self.before.clear();
        let (u, v) = (&state.displacement, &state.velocity);
        for floor in system
            .buildings
            .iter()
            .flat_map(|building| &building.floors)
        {
            self.before.push((u[floor.dof], v[floor.dof]));
        }
        for contact in &system.contacts {
            let faces = &contact.faces;
            self.before.push((faces.closing(u), faces.closing(v)));
        }
    }

    /// Updates peaks with the step that ended in `state`.
    pub(crate) fn after_step(&mut self, system: &System, state: &State, step: f64, ground: f64) {
        self.follow_bends(system, state, step, ground);
        let (u, v) = (&state.displacement, &state.velocity);
        let start = state.time - step;
        let mut before = self.before.iter();
        for (index, building) in system.buildings.iter().enumerate() {
            let mut below = building.foot.map_or(0.0, |dof| u[dof]);
            for (peaks, floor) in self.floors[index].iter_mut().zip(&building.floors) {
                let now = (u[floor.dof], v[floor.dof]);
                if let Some(&then) = before.next() {
                    let greatest = greatest_in_step(then, now, start, step);
                    if greatest.value > peaks.displacement_max.value {
                        peaks.displacement_max = greatest;
                    }
                    let least = greatest_in_step((-then.0, -then.1), (-now.0, -now.1), start, step);
                    if -least.value < peaks.displacement_min.value {
                        peaks.displacement_min = Extreme {
                            value: -least.value,
                            at: least.at,
                        };
                    }
                }
                let total = (state.acceleration[floor.dof] + ground).abs();
                peaks.total_acceleration = peaks.total_acceleration.max(total);
                peaks.storey_drift = peaks
                    .storey_drift
                    .max(((now.0 - below) / floor.storey_height).abs());
                below = now.0;
            }
            let shear = building.base_shear(state);
            self.base_shear[index] = self.base_shear[index].max(shear.abs());
        }
        for (contact, closing) in system.contacts.iter().zip(&mut self.closing) {
            if let Some(&then) = before.next() {
                let now = (contact.faces.closing(u), contact.faces.closing(v));
                let greatest = greatest_in_step(then, now, start, step);
                if greatest.value > closing.value {
                    *closing = greatest;
                }
            }
        }
    }

    /// Updates peaks with accelerations that have jumped.
    pub(crate) fn after_jump(&mut self, system: &System, state: &State, ground: f64) {
        for (building, floors) in system.buildings.iter().zip(&mut self.floors) {
            for (peaks, floor) in floors.iter_mut().zip(&building.floors) {
                let total = (state.acceleration[floor.dof] + ground).abs();
                peaks.total_acceleration = peaks.total_acceleration.max(total);
            }
        }
        self.bends.clear();
    }

    /// How far acceleration peaks may be off, relative to the greatest of their building: steps that see a quantity turn
    /// by d from one to the next miss some part of d, and slow it down \[–\].
    pub(crate) fn bent(&self) -> f64 {
        let mut sharpest = self.sharpest.iter();
        let buildings = self.floors.iter().map(|floors| {
            let greatest = floors.iter().map(|floor| floor.total_acceleration);
            let greatest = greatest.fold(f64::MIN_POSITIVE, f64::max);
            let own = sharpest.by_ref().take(floors.len());
            own.fold(0.0, |most: f64, bend| most.max(*bend)) / greatest
        });
        MISSED_OF_BEND * buildings.fold(0.0, f64::max)
    }

    /// Follows how sharply accelerations turn where they are greatest.
    fn follow_bends(&mut self, system: &System, state: &State, step: f64, ground: f64) {
        let floors = system
            .buildings
            .iter()
            .flat_map(|building| &building.floors);
        let totals = floors.map(|floor| state.acceleration[floor.dof] + ground);
        if self.bends.is_empty() || (step - self.last_step).abs() > 1e-9 * step {
            self.last_step = step;
            self.bends.clear();
            self.bends.extend(totals.map(|total| [f64::NAN, total]));
            return;
        }
        let peaks = self.floors.iter().flatten();
        let own = self.bends.iter_mut().zip(&mut self.sharpest).zip(peaks);
        for (((known, sharpest), peaks), total) in own.zip(totals) {
            let [then, before] = *known;
            let bend = (total - 2.0 * before + then).abs();
            if before.abs() >= NEAR_PEAK * peaks.total_acceleration && bend.is_finite() {
                *sharpest = sharpest.max(bend);
            }
            *known = [before, total];
        }
    }

    /// Adds a row to the history when one is due, or at once when it is `wanted`.
    pub(crate) fn record(
        &mut self,
        system: &System,
        state: &State,
        links: &[f64],
        ground: f64,
        wanted: bool,
        audit: &mut EnergyAudit,
    ) {
        let Some(history) = &mut self.history else {
            return;
        };
        if !wanted && state.time < self.due {
            return;
        }
        self.due = state.time + self.interval * (1.0 - 1e-9);
        let energy = audit.balance(system, state);
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
        put(ground);
        for floor in system
            .buildings
            .iter()
            .flat_map(|building| &building.floors)
        {
            put(state.displacement[floor.dof]);
            put(state.velocity[floor.dof]);
            put(state.acceleration[floor.dof] + ground);
        }
        state.contacts.iter().for_each(|phase| put(phase.force()));
        links.iter().for_each(|force| put(*force));
        let Energy {
            input,
            kinetic,
            strain,
            damped,
            hysteretic,
            contact,
            ..
        } = energy;
        [input, kinetic, strain, damped, hysteretic, contact]
            .into_iter()
            .for_each(put);
    }
}

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
