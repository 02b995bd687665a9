//! Watches over a step: one loop for each statistic.

use super::Places;
use super::watch::{DeformationLimit, Drift, Statistic, Watch};
use crate::history::{Extreme, Peak};
use crate::interface::Contact;
use crate::linear::Row;
use crate::state::State;
use crate::stepping::extremes::{greatest_in_step, take_extremes};
use crate::system::{PlasticRotation, RunGrounds, System};

/// Value and rate.
type Motion = (f64, f64);

/// What is followed, statistic by statistic.
#[derive(Default)]
pub(super) struct Watches {
    /// Displacements by their degree of freedom: most of what is followed.
    displacements: Vec<Followed<usize>>,
    /// Other extremes.
    extremes: Vec<Followed<Row>>,
    sizes: Vec<Followed<Row>>,
    drifts: Vec<Followed<Drift>>,
    /// Contacts.
    closings: Vec<Followed<usize>>,
    lengths: Vec<Followed<[Row; 2]>>,
    dashpots: Vec<Followed<([f64; 3], [Row; 2])>>,
    /// Springs.
    lifted: Vec<Followed<usize>>,
    passed: Vec<Followed<DeformationLimit>>,
    /// Ends on surfaces, with a limit or without.
    turned: Vec<Followed<(PlasticRotation, Option<f64>)>>,
}

/// A number with the place of its peak.
struct Followed<T> {
    number: T,
    place: usize,
    /// What it was at the start of the step.
    then: Motion,
}

impl Watches {
    pub(super) fn new(watches: Vec<Watch>, places: &mut Places) -> Self {
        let mut all = Self::default();
        for watch in watches {
            let place = places.of(watch.column);
            match watch.statistic {
                Statistic::Extremes(row) => match row.only() {
                    Some(dof) => follow(&mut all.displacements, dof, place),
                    None => follow(&mut all.extremes, row, place),
                },
                Statistic::Size(row) => follow(&mut all.sizes, row, place),
                Statistic::Length(rows) => follow(&mut all.lengths, rows, place),
                Statistic::Drift(drift) => follow(&mut all.drifts, drift, place),
                Statistic::Closing(contact) => follow(&mut all.closings, contact, place),
                Statistic::Dashpots(matrix, rows) => {
                    follow(&mut all.dashpots, (matrix, rows), place);
                }
                Statistic::Lifted(spring) => follow(&mut all.lifted, spring, place),
                Statistic::Passed(limit) => follow(&mut all.passed, limit, place),
                Statistic::Turned(rotation, limit) => {
                    follow(&mut all.turned, (rotation, limit), place);
                }
            }
        }
        all
    }

    /// Begins a run whose masses do not stand at their heights.
    pub(super) fn start(&self, state: &State, peaks: &mut [Peak]) {
        for size in &self.sizes {
            peaks[size.place].widen(size.number.value(&state.displacement));
        }
    }

    /// Stores what numbers are at the start of a step.
    pub(super) fn before_step(&mut self, system: &System, state: &State, grounds: &RunGrounds<'_>) {
        let (u, v) = (&state.displacement[..], &state.velocity[..]);
        for displacement in &mut self.displacements {
            displacement.then = (u[displacement.number], v[displacement.number]);
        }
        for extreme in self.extremes.iter_mut().chain(&mut self.sizes) {
            extreme.then = (extreme.number.value(u), extreme.number.value(v));
        }
        for followed in &mut self.closings {
            followed.then = closing(system, followed.number, state, grounds);
        }
        for length in &mut self.lengths {
            length.then = square(&length.number, u, v);
        }
        for dashpot in &mut self.dashpots {
            let [x, turn] = &dashpot.number.1;
            dashpot.then = (x.value(u), turn.value(u));
        }
    }

    /// Takes in a step \[s\] that ended in a state.
    pub(super) fn after_step(
        &self,
        system: &System,
        state: &State,
        grounds: &RunGrounds<'_>,
        peaks: &mut [Peak],
        step: f64,
    ) {
        let start = state.time - step;
        let (u, v) = (&state.displacement[..], &state.velocity[..]);
        for displacement in &self.displacements {
            let now = (u[displacement.number], v[displacement.number]);
            take_extremes(
                &mut peaks[displacement.place],
                [displacement.then, now],
                start,
                step,
            );
        }
        for extreme in &self.extremes {
            let now = (extreme.number.value(u), extreme.number.value(v));
            take_extremes(&mut peaks[extreme.place], [extreme.then, now], start, step);
        }
        for size in &self.sizes {
            let now = (size.number.value(u), size.number.value(v));
            for sign in [1.0, -1.0] {
                let [then, now] = [size.then, now].map(|(u, v)| (sign * u, sign * v));
                let greatest = greatest_in_step(then, now, start, step);
                let peak = &mut peaks[size.place].greatest.value;
                *peak = peak.max(greatest.value);
            }
        }
        for drift in &self.drifts {
            let Drift {
                above,
                below,
                turned,
                height,
            } = drift.number;
            let below = below.map_or(0.0, |dof| u[dof]);
            let turned = turned.map_or(0.0, |dof| u[dof]);
            peaks[drift.place].widen((u[above] - below) / height + turned);
        }
        for followed in &self.closings {
            let now = closing(system, followed.number, state, grounds);
            raise(peaks, followed, now, start, step);
        }
        for length in &self.lengths {
            raise(peaks, length, square(&length.number, u, v), start, step);
        }
        for dashpot in &self.dashpots {
            let ([uu, ut, tt], rows) = &dashpot.number;
            let [x, turn] = rows.each_ref().map(|row| row.value(u));
            let (x, turn) = (x - dashpot.then.0, turn - dashpot.then.1);
            let taken = uu * x * x + 2.0 * ut * x * turn + tt * turn * turn;
            peaks[dashpot.place].greatest.value += taken / step;
        }
        for followed in &self.lifted {
            if state.springs[followed.number].force() == 0.0 {
                peaks[followed.place].greatest.value += step;
            }
        }
        for followed in &self.turned {
            let (rotation, limit) = &followed.number;
            let (value, peak) = (rotation.value(&state.springs), &mut peaks[followed.place]);
            match limit {
                None => peak.widen(value),
                Some(limit) if peak.greatest.value == 0.0 && value.abs() >= *limit => {
                    peak.greatest = Extreme {
                        value: 1.0,
                        at: state.time,
                    };
                }
                Some(_) => {}
            }
        }
        for followed in &self.passed {
            let peak = &mut peaks[followed.place].greatest;
            if peak.value == 0.0 && followed.number.is_passed(state) {
                *peak = Extreme {
                    value: 1.0,
                    at: state.time,
                };
            }
        }
    }

    /// Ends a run: lengths were followed as squares.
    pub(super) fn finish(&self, peaks: &mut [Peak]) {
        let mut places: Vec<usize> = self.lengths.iter().map(|length| length.place).collect();
        places.dedup();
        for place in places {
            let greatest = &mut peaks[place].greatest.value;
            *greatest = greatest.max(0.0).sqrt();
        }
    }
}

impl DeformationLimit {
    #[inline]
    fn is_passed(&self, state: &State) -> bool {
        let mut springs = self.springs.iter();
        springs.any(|spring| state.springs[*spring].greatest(self.side) >= self.deformation)
    }
}

fn follow<T>(list: &mut Vec<Followed<T>>, number: T, place: usize) {
    list.push(Followed {
        number,
        place,
        then: (0.0, 0.0),
    });
}

#[inline]
fn raise<T>(peaks: &mut [Peak], followed: &Followed<T>, now: Motion, start: f64, step: f64) {
    let greatest = greatest_in_step(followed.then, now, start, step);
    let peak = &mut peaks[followed.place].greatest;
    if greatest.value > peak.value {
        *peak = greatest;
    }
}

/// Closing of a contact from rest, under which grounds may move apart.
#[inline]
fn closing(system: &System, contact: usize, state: &State, grounds: &RunGrounds<'_>) -> Motion {
    let Contact {
        ports,
        closing_at_rest,
        ..
    } = &system.contacts[contact];
    let [moved, rate, _] = grounds.closing(contact, 0);
    (
        ports.closing(&state.displacement) + moved - closing_at_rest,
        ports.closing(&state.velocity) + rate,
    )
}

/// |u|² of a point and its rate.
#[inline]
fn square(rows: &[Row; 2], u: &[f64], v: &[f64]) -> Motion {
    let [x, y] = rows.each_ref().map(|row| row.value(u));
    let [x_rate, y_rate] = rows.each_ref().map(|row| row.value(v));
    (x * x + y * y, 2.0 * (x * x_rate + y * y_rate))
}
