//! Histories and peaks in modal coordinates, also between steps that are long beside the higher modes.

use super::reduced::Reduced;
use crate::history::{Energy, Extreme, FloorPeaks, History};
use crate::lanes;
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
            let floors = own.watched.start..own.watched.start + own.floors;
            let [[u1, u0], [v1, v0], [a1, a0], [l1, l0]] =
                [u, rate, &self.acceleration, &self.loose]
                    .map(|pair| pair.each_ref().map(|list| &list[floors.clone()]));
            let driven = &self.driven[floors];
            let mut below = Ends {
                then: [0.0; 2],
                now: [0.0; 2],
            };
            let floors = self.floors[index].iter_mut().zip(&building.floors);
            for (at, (peaks, floor)) in floors.enumerate() {
                let ends = Ends {
                    then: [u0[at], v0[at]],
                    now: [u1[at], v1[at]],
                };
                ends.raise(&mut peaks.displacement_max, start, step);
                ends.lower(&mut peaks.displacement_min, start, step);
                // Per storey height, as it is kept.
                let slenderness = 1.0 / floor.storey_height;
                let drift = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (a[k] - b[k]) * slenderness);
                let drifts = Ends {
                    then: drift(ends.then, below.then),
                    now: drift(ends.now, below.now),
                };
                drifts.widen(&mut peaks.storey_drift, step);
                below = ends;
                let slope = ground_rate * (1.0 - driven[at]);
                let total = Ends {
                    then: [a0[at] + ground[0], l0[at] + slope],
                    now: [a1[at] + ground[1], l1[at] + slope],
                };
                total.widen(&mut peaks.total_acceleration, step);
            }
            let sum = |modal: &[f64]| lanes::dot(&own.shear, &modal[own.modes.clone()]);
            let shear = Ends {
                then: self.shear[index],
                now: [sum(q), sum(v)],
            };
            shear.widen(&mut self.base_shear[index], step);
            self.shear[index] = shear.now;
        }
        for (contact, closing) in self.closing.iter_mut().enumerate() {
            let pair = |time: usize| {
                [
                    reduced.closing(contact, &u[time]),
                    reduced.closing(contact, &rate[time]),
                ]
            };
            let ends = Ends {
                then: pair(1),
                now: pair(0),
            };
            ends.raise(closing, start, step);
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

/// (value, slope) at the start and at the end of a step.
#[derive(Clone, Copy)]
struct Ends {
    then: [f64; 2],
    now: [f64; 2],
}

impl Ends {
    /// By how much a cubic may leave the range of its ends: no more than 4/27 of the step times the sum of its end
    /// slopes.
    #[inline(always)]
    fn beyond(&self, step: f64) -> f64 {
        0.15 * step * (self.then[1].abs() + self.now[1].abs())
    }

    /// Keeps the greatest value so far.
    #[inline(always)]
    fn raise(self, extreme: &mut Extreme, start: f64, step: f64) {
        if self.then[0].max(self.now[0]) + self.beyond(step) > extreme.value {
            self.look_for(extreme, 1.0, start, step);
        }
    }

    /// Keeps the least value so far.
    #[inline(always)]
    fn lower(self, extreme: &mut Extreme, start: f64, step: f64) {
        if self.then[0].min(self.now[0]) - self.beyond(step) < extreme.value {
            self.look_for(extreme, -1.0, start, step);
        }
    }

    /// Keeps the greatest magnitude so far.
    #[inline(always)]
    fn widen(self, largest: &mut f64, step: f64) {
        if self.then[0].abs().max(self.now[0].abs()) + self.beyond(step) > *largest {
            *largest = self.largest(*largest, step);
        }
    }

    #[cold]
    fn look_for(self, extreme: &mut Extreme, sign: f64, start: f64, step: f64) {
        let [then, now] = [self.then, self.now].map(|[a, b]| (sign * a, sign * b));
        let greatest = greatest_in_step(then, now, start, step);
        if greatest.value > sign * extreme.value {
            *extreme = Extreme {
                value: sign * greatest.value,
                at: greatest.at,
            };
        }
    }

    #[cold]
    fn largest(self, known: f64, step: f64) -> f64 {
        let Self { then, now } = self;
        let curve = Cubic::new(then[0], then[1], now[0], now[1], step);
        let inside = curve.turning_points().map(|at| curve.value(at).abs());
        inside.fold(known.max(then[0].abs()).max(now[0].abs()), f64::max)
    }
}
