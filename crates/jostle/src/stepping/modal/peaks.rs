//! Histories and peaks in modal coordinates, also between steps that are long beside the higher modes.

use super::reduced::Reduced;
use crate::history::{Energy, Extreme, FloorPeaks, History};
use crate::state::ContactPhase;
use crate::stepping::events::Cubic;
use crate::stepping::recorder::{columns, greatest_in_step};
use crate::system::System;

/// Takes histories and peaks.
pub(super) struct Peaks {
    history: Option<History>,
    interval: f64,
    due: f64,
    pub(super) floors: Vec<Vec<FloorPeaks>>,
    pub(super) closing: Vec<Extreme>,
    pub(super) base_shear: Vec<f64>,
    /// Base shear and its rate a step ago, of every building.
    shear: Vec<[f64; 2]>,
    /// Accelerations of floors now and a step ago, and what their rates are but for the load's.
    acceleration: [Vec<f64>; 2],
    loose: [Vec<f64>; 2],
    jerk: Vec<f64>,
    /// What a unit rate of the ground acceleration adds to the rates of accelerations.
    driven: Vec<f64>,
}

/// A step that was taken.
pub(super) struct Moment<'a> {
    /// Watched displacements and velocities at its end and at its start.
    pub(super) u: &'a [Vec<f64>; 2],
    pub(super) rate: &'a [Vec<f64>; 2],
    /// Modal displacements, velocities and accelerations at its end.
    pub(super) q: &'a [f64],
    pub(super) v: &'a [f64],
    pub(super) a: &'a [f64],
    /// Ground acceleration at its start and at its end.
    pub(super) ground: [f64; 2],
    pub(super) start: f64,
    pub(super) step: f64,
}

impl Peaks {
    pub(super) fn new(
        system: &System,
        reduced: &Reduced,
        interval: Option<f64>,
        ground: f64,
    ) -> Self {
        let watched = reduced.watched();
        let (mut driven, mut spare) = (vec![0.0; watched], vec![0.0; watched]);
        let participation = &reduced.participation[..];
        reduced.show([participation, participation], [&mut driven, &mut spare]);
        Self {
            history: interval.map(|_| History::new(columns(system))),
            interval: interval.unwrap_or(0.0),
            due: 0.0,
            floors: system
                .buildings
                .iter()
                .map(|b| vec![FloorPeaks::default(); b.floors.len()])
                .collect(),
            closing: vec![Extreme::default(); system.contacts.len()],
            base_shear: vec![0.0; system.buildings.len()],
            shear: vec![[0.0; 2]; system.buildings.len()],
            // At rest on moving ground buildings stay behind.
            acceleration: [
                driven.iter().map(|share| -share * ground).collect(),
                vec![0.0; watched],
            ],
            loose: [vec![0.0; watched], vec![0.0; watched]],
            jerk: vec![0.0; reduced.modes()],
            driven,
        }
    }

    pub(super) fn reserve(&mut self, rows: usize) {
        if let Some(history) = &mut self.history {
            history.reserve(rows);
        }
    }

    pub(super) fn into_history(self) -> Option<History> {
        self.history
    }

    /// Updates peaks with a step.
    pub(super) fn after_step(&mut self, system: &System, reduced: &Reduced, moment: Moment<'_>) {
        let Moment {
            u,
            rate,
            q,
            v,
            a,
            ground,
            start,
            step,
        } = moment;
        self.acceleration.swap(0, 1);
        self.loose.swap(0, 1);
        let modes = a
            .iter()
            .zip(v)
            .zip(&reduced.damping)
            .zip(&reduced.stiffness);
        for (jerk, (((a, v), d), k)) in self.jerk.iter_mut().zip(modes) {
            *jerk = -d * a - k * v;
        }
        reduced.show(
            [a, &self.jerk],
            [&mut self.acceleration[0], &mut self.loose[0]],
        );
        let ground_rate = (ground[1] - ground[0]) / step;
        for (index, building) in system.buildings.iter().enumerate() {
            let own = &reduced.buildings[index];
            let watched = own.watched.start;
            let mut below = [[0.0; 2]; 2];
            for (number, (peaks, floor)) in self.floors[index]
                .iter_mut()
                .zip(&building.floors)
                .enumerate()
            {
                let at = watched + number;
                let pair = |time: usize| [u[time][at], rate[time][at]];
                let (now, then) = (pair(0), pair(1));
                take(&mut peaks.displacement_max, 1.0, then, now, start, step);
                take(&mut peaks.displacement_min, -1.0, then, now, start, step);
                let drift = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
                let drifts = (drift(then, below[1]), drift(now, below[0]));
                let known = peaks.storey_drift * floor.storey_height;
                peaks.storey_drift = largest(drifts.0, drifts.1, step, known) / floor.storey_height;
                below = [now, then];
                let total = |time: usize| {
                    let slope = self.loose[time][at] + ground_rate * (1.0 - self.driven[at]);
                    [self.acceleration[time][at] + ground[1 - time], slope]
                };
                peaks.total_acceleration =
                    largest(total(1), total(0), step, peaks.total_acceleration);
            }
            let sum = |modal: &[f64]| -> f64 {
                let own_modes = &modal[own.modes.clone()];
                own.shear.iter().zip(own_modes).map(|(s, q)| s * q).sum()
            };
            let now = [sum(q), sum(v)];
            self.base_shear[index] = largest(self.shear[index], now, step, self.base_shear[index]);
            self.shear[index] = now;
        }
        for (contact, closing) in self.closing.iter_mut().enumerate() {
            let pair = |time: usize| {
                [
                    reduced.closing(contact, &u[time]),
                    reduced.closing(contact, &rate[time]),
                ]
            };
            take(closing, 1.0, pair(1), pair(0), start, step);
        }
    }

    /// Whether a row of the history is due, or wanted at once.
    pub(super) fn is_due(&self, time: f64, wanted: bool) -> bool {
        self.history.is_some() && (wanted || time >= self.due)
    }

    /// Adds a row: time and ground, displacements and velocities of watched places; accelerations are known.
    pub(super) fn record(
        &mut self,
        system: &System,
        reduced: &Reduced,
        (time, ground): (f64, f64),
        [u, rate]: [&[f64]; 2],
        phases: &[ContactPhase],
        energy: &Energy,
    ) {
        let Some(history) = &mut self.history else {
            return;
        };
        self.due = time + self.interval * (1.0 - 1e-9);
        let mut row = history.push_row().iter_mut();
        let mut put = |value: f64| {
            if let Some(place) = row.next() {
                *place = value;
            }
        };
        put(time);
        put(ground);
        for (building, own) in system.buildings.iter().zip(&reduced.buildings) {
            for floor in 0..building.floors.len().min(own.floors) {
                let at = own.watched.start + floor;
                put(u[at]);
                put(rate[at]);
                put(self.acceleration[0][at] + ground);
            }
        }
        phases.iter().for_each(|phase| put(phase.force()));
        [
            energy.input,
            energy.kinetic,
            energy.strain,
            energy.damped,
            energy.hysteretic,
            energy.contact,
        ]
        .into_iter()
        .for_each(put);
    }
}

/// Keeps the greatest value, or with a sign of −1 the least one, of a step between (value, slope) at its ends.
fn take(extreme: &mut Extreme, sign: f64, then: [f64; 2], now: [f64; 2], start: f64, step: f64) {
    if !may_exceed(
        [sign * then[0], then[1]],
        [sign * now[0], now[1]],
        step,
        sign * extreme.value,
    ) {
        return;
    }
    let greatest = greatest_in_step(
        (sign * then[0], sign * then[1]),
        (sign * now[0], sign * now[1]),
        start,
        step,
    );
    if greatest.value > sign * extreme.value {
        *extreme = Extreme {
            value: sign * greatest.value,
            at: greatest.at,
        };
    }
}

/// Greatest magnitude in a step between (value, slope) at its ends, or that known so far.
fn largest(then: [f64; 2], now: [f64; 2], step: f64, known: f64) -> f64 {
    if !may_exceed(
        [then[0].abs(), then[1]],
        [now[0].abs(), now[1]],
        step,
        known,
    ) {
        return known;
    }
    let curve = Cubic::new(then[0], then[1], now[0], now[1], step);
    let inside = curve.turning_points().map(|at| curve.value(at).abs());
    inside.fold(known.max(then[0].abs()).max(now[0].abs()), f64::max)
}

/// Whether a cubic may rise above a limit: it lies above its ends by no more than 4/27 of the step times the sum of its
/// end slopes.
#[inline]
fn may_exceed(then: [f64; 2], now: [f64; 2], step: f64, limit: f64) -> bool {
    then[0].max(now[0]) + 0.15 * step * (then[1].abs() + now[1].abs()) > limit
}
