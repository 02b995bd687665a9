//! Contacts as ports: modes are moved exactly over steps of the record and binary parts of them, and a contact force enters by its
//! first three moments over a step, with touch and release found on the path within it.
//!
//! A second algorithm beside the steps that end at every touch and release, with its own equations, against which those are
//! tested. Elastic buildings in one plane, one ground, laws of contact without memory of their path.

mod influence;
mod path;
mod port;
mod tests;

use super::Reduction;
use super::reduced::Reduced;
use crate::contact::ForceLaw;
use crate::motion::GroundMotion;
use crate::stepping::plan::Plan;
use crate::system::System;
use influence::{Influence, Moments, Rows};
use path::{Path, bisect};
use port::{Piece, Port};

/// Finest part of a step of the record: its 2^10th.
const FINEST: usize = 10;
/// Iterations after which a step is halved.
const MOST_ITERATIONS: u32 = 40;
/// Iterations from which changes are halved, and quartered.
const HALVED_FROM: u32 = 8;
const QUARTERED_FROM: u32 = 30;
/// Change of moments and end forces at which an iteration has converged, relative to the greatest of the gap \[–\].
const CONVERGED: f64 = 1e-11;
/// Steps over the elastic collision of the bodies that meet, at least \[–\].
const STEPS_PER_COLLISION: f64 = 3.0;
/// Speed at which its duration is estimated \[m/s\].
const TYPICAL_SPEED: f64 = 0.3;
/// Share of the greatest force of its gap below which a contact is judged by that \[–\].
const FAINT: f64 = 0.1;

/// One impact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct PortImpact {
    contact: usize,
    start: f64,
    impact_speed: f64,
    peak_force: f64,
    impulse: f64,
    finished: bool,
}

/// Results of a run.
#[derive(Debug, Default, PartialEq)]
struct PortOutcome {
    /// In the order in which they began.
    impacts: Vec<PortImpact>,
    /// Greatest displacement of every floor, building by building \[m\].
    sways: Vec<Vec<f64>>,
    steps: u64,
    halved: u64,
    iterations: u64,
}

/// Modal coordinates and velocities, and contacts.
struct PortRun<'a> {
    motion: &'a GroundMotion,
    reduced: &'a Reduced,
    system: &'a System,
    rows: Rows,
    /// Steps of the record, its halves, and so on; and what moments do at the middle of each.
    levels: Vec<Influence>,
    middles: Vec<Vec<Moments>>,
    interval: f64,
    /// Level of steps in contact.
    fine: usize,
    /// Greatest estimated error of a force \[–\].
    tolerance: f64,
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    end_displacement: Vec<f64>,
    end_velocity: Vec<f64>,
    ports: Vec<Port>,
    /// Ends without forces over the step, and with them.
    free: Vec<[f64; 3]>,
    ends: Vec<[f64; 3]>,
    /// Impact in progress and greatest force of every contact.
    current: Vec<Option<usize>>,
    greatest: Vec<f64>,
    /// Displacements of floors as rows over modes; their values, rates and accelerations.
    floors: Vec<(usize, Vec<f64>)>,
    floor_ends: Vec<[f64; 3]>,
    outcome: PortOutcome,
}

/// Runs a system from rest with all natural modes; `None` if it is not of the kind that this module describes.
fn follow(
    system: &System,
    motion: &GroundMotion,
    plan: &Plan,
    tolerance: f64,
) -> Option<PortOutcome> {
    let suited = |law: &ForceLaw| {
        !matches!(
            law,
            ForceLaw::Restitution { .. } | ForceLaw::Bilinear(_) | ForceLaw::Crushing(_)
        )
    };
    let alone = motion.grounds.is_none() && system.links.is_empty();
    if !alone || !system.contacts.iter().all(|contact| suited(&contact.law)) {
        return None;
    }
    let interval = motion.step()?;
    let reduction = Reduction::complete(system, plan).ok()?;
    let reduced = &*reduction.reduced;
    if !reduced.links.is_empty() {
        return None;
    }
    let mut run = PortRun::new(system, motion, reduced, interval, tolerance);
    let count = (motion.duration / interval).round() as u64;
    for index in 0..count {
        let start = index as f64 * interval;
        run.pass_interval(start).then_some(())?;
    }
    Some(run.outcome)
}

impl<'a> PortRun<'a> {
    fn new(
        system: &'a System,
        motion: &'a GroundMotion,
        reduced: &'a Reduced,
        interval: f64,
        tolerance: f64,
    ) -> Self {
        let modes = reduced.stiffness.len();
        let mut shapes = Vec::new();
        for contact in &system.contacts {
            let mut row = vec![0.0; modes];
            for (port, sign) in contact.ports.sides() {
                let building = &reduced.buildings[port.building];
                let local = port.row.moved_down(system.buildings[port.building].offset);
                let shown = building.basis.of_shapes(|vector| local.value(vector));
                for (value, shown) in row[building.modes.clone()].iter_mut().zip(shown) {
                    *value = -sign * shown;
                }
            }
            shapes.push(row);
        }
        let rows = Rows::new(shapes);
        let levels: Vec<Influence> = (0..=FINEST + 1)
            .map(|level| Influence::new(reduced, &rows, interval / (1_u64 << level) as f64))
            .collect();
        let middles = levels[1..].iter().map(|half| half.middles(&rows)).collect();
        let durations = system.contacts.iter().map(|contact| {
            contact
                .law
                .elastic_duration(contact.effective_mass(), TYPICAL_SPEED)
        });
        let shortest = durations.fold(f64::INFINITY, f64::min);
        let fine = (0..FINEST)
            .find(|level| interval / (1_u64 << level) as f64 <= shortest / STEPS_PER_COLLISION);
        let mut floors = Vec::new();
        for (index, reduced_building) in reduced.buildings.iter().enumerate() {
            let building = &system.buildings[index];
            for floor in &building.floors {
                let dof = floor.dof - building.offset;
                let mut row = vec![0.0; modes];
                row[reduced_building.modes.clone()]
                    .copy_from_slice(&reduced_building.basis.of_shapes(|v| v[dof]));
                floors.push((index, row));
            }
        }
        let mut run = Self {
            motion,
            reduced,
            system,
            levels,
            middles,
            interval,
            fine: fine.unwrap_or(FINEST),
            tolerance,
            displacement: vec![0.0; modes],
            velocity: vec![0.0; modes],
            end_displacement: vec![0.0; modes],
            end_velocity: vec![0.0; modes],
            ports: system
                .contacts
                .iter()
                .map(|contact| Port::new(contact.law))
                .collect(),
            free: vec![[0.0; 3]; rows.len()],
            ends: vec![[0.0; 3]; rows.len()],
            current: vec![None; rows.len()],
            greatest: vec![0.0; rows.len()],
            floor_ends: vec![[0.0; 3]; floors.len()],
            outcome: PortOutcome {
                sways: system
                    .buildings
                    .iter()
                    .map(|b| vec![0.0; b.floors.len()])
                    .collect(),
                ..PortOutcome::default()
            },
            floors,
            rows,
        };
        let ground = motion.acceleration(0.0);
        for contact in 0..run.rows.len() {
            run.ports[contact].start =
                run.shown(&run.rows.shapes[contact], false, ground, Some(contact));
        }
        for floor in 0..run.floors.len() {
            run.floor_ends[floor] = run.shown(&run.floors[floor].1, false, ground, None);
        }
        run
    }

    /// Value, rate and acceleration of a row without contact forces, at the start or at the end of the step; a contact is open by
    /// its gap.
    fn shown(&self, row: &[f64], at_end: bool, ground: f64, contact: Option<usize>) -> [f64; 3] {
        let (q, v) = if at_end {
            (&self.end_displacement, &self.end_velocity)
        } else {
            (&self.displacement, &self.velocity)
        };
        let reduced = self.reduced;
        let mut sums = [0.0; 3];
        for mode in 0..row.len() {
            let (share, q, v) = (row[mode], q[mode], v[mode]);
            let pulled = reduced.stiffness[mode] * q + reduced.damping[mode] * v;
            sums[0] += share * q;
            sums[1] += share * v;
            sums[2] -= share * (pulled + reduced.participation[mode] * ground);
        }
        if let Some(contact) = contact {
            sums[0] -= self.system.contacts[contact].width;
        }
        sums
    }

    /// Passes one interval of the record; false where a step does not converge.
    fn pass_interval(&mut self, start: f64) -> bool {
        let grounds = [start, start + self.interval].map(|t| self.motion.acceleration(t));
        self.move_freely(0, grounds);
        if !self.may_touch() {
            self.ports.iter_mut().for_each(|port| port.follow_nothing());
            self.accept(0, start, grounds[1]);
            return true;
        }
        let parts = 1_u64 << self.fine;
        (0..parts).all(|part| self.pass(self.fine, start, part, grounds))
    }

    /// Passes a part of an interval, in halves where needed.
    fn pass(&mut self, level: usize, start: f64, part: u64, grounds: [f64; 2]) -> bool {
        let parts = (1_u64 << level) as f64;
        let ground = |at: f64| grounds[0] + (grounds[1] - grounds[0]) * at / parts;
        let part_grounds = [ground(part as f64), ground(part as f64 + 1.0)];
        self.move_freely(level, part_grounds);
        let settled = self.iterate(level);
        // Where forces jump, the finest steps may miss the estimate; what has not settled is never accepted.
        if settled && (level == FINEST || self.is_accurate(level, part_grounds)) {
            let at = start + self.interval * part as f64 / parts;
            self.accept(level, at, part_grounds[1]);
            return true;
        }
        self.outcome.halved += 1;
        level < FINEST
            && (2 * part..2 * part + 2).all(|half| self.pass(level + 1, start, half, grounds))
    }

    /// The end of a step without contact forces.
    fn move_freely(&mut self, level: usize, grounds: [f64; 2]) {
        let table = &self.levels[level].table;
        for mode in 0..self.displacement.len() {
            let (q, v) = (self.displacement[mode], self.velocity[mode]);
            let driven = self.reduced.participation[mode];
            let loads = grounds.map(|ground| -driven * ground);
            let end = |factors: &[Vec<f64>; 5]| {
                factors[0][mode] * q
                    + factors[1][mode] * v
                    + factors[2][mode] * loads[0]
                    + factors[3][mode] * loads[1]
            };
            (self.end_displacement[mode], self.end_velocity[mode]) =
                (end(&table.displacement), end(&table.velocity));
        }
        for contact in 0..self.rows.len() {
            self.free[contact] =
                self.shown(&self.rows.shapes[contact], true, grounds[1], Some(contact));
        }
    }

    /// Whether something is closed or may close over a step of the record: by the quintic, and by what modes too fast for it can
    /// move.
    fn may_touch(&self) -> bool {
        (0..self.rows.len()).any(|contact| {
            let port = &self.ports[contact];
            if port.closed.is_some() {
                return true;
            }
            let mut margin = 0.0;
            for (mode, share) in self.rows.shapes[contact].iter().enumerate() {
                let k = self.reduced.stiffness[mode];
                if k * self.interval * self.interval > 1.0 {
                    let size = |q: f64, v: f64| q * q + v * v / k;
                    let before = size(self.displacement[mode], self.velocity[mode]);
                    let after = size(self.end_displacement[mode], self.end_velocity[mode]);
                    margin += share.abs() * before.max(after).sqrt();
                }
            }
            let (mut start, mut end) = (port.start, self.free[contact]);
            start[0] += margin;
            end[0] += margin;
            start[0] >= 0.0
                || end[0] >= 0.0
                || Path::between(0.0, self.interval, start, end)
                    .crossing(0.0, 1.0)
                    .is_some()
        })
    }

    /// Motion at the contacts at the end of the step with their moments.
    fn find_ends(&mut self, level: usize) {
        let count = self.rows.len();
        for one in 0..count {
            let mut end = self.free[one];
            for (other, port) in self.ports.iter().enumerate() {
                let influence = &self.levels[level].ends[one * count + other];
                for (end, factors) in end.iter_mut().zip(influence) {
                    for (factor, moment) in factors.iter().zip(port.moments) {
                        *end += factor * moment;
                    }
                }
                end[2] -= self.rows.at_once[one * count + other] * port.end_force;
            }
            self.ends[one] = end;
        }
    }

    /// Finds moments that agree with the motion they cause; false if they do not settle.
    fn iterate(&mut self, level: usize) -> bool {
        let count = self.rows.len();
        let step = self.levels[level].table.step;
        self.ports.iter_mut().for_each(Port::begin);
        for iteration in 0..MOST_ITERATIONS {
            self.outcome.iterations += 1;
            self.find_ends(level);
            let mut settled = true;
            for one in 0..count {
                let influence = self.levels[level].ends[one * count + one];
                let lightness = self.rows.at_once[one * count + one];
                let port = &mut self.ports[one];
                let (moments, force) = (port.moments, port.end_force);
                let mut products = influence.map(|factors| {
                    let products = factors.iter().zip(moments).map(|(a, b)| a * b);
                    products.sum::<f64>()
                });
                products[2] -= lightness * force;
                port.follow(step, self.ends[one], products, lightness);
                let share = match iteration {
                    QUARTERED_FROM.. => 0.25,
                    HALVED_FROM.. => 0.5,
                    _ => 1.0,
                };
                let scale = self.greatest[one]
                    .max(port.end_force)
                    .max(moments[0].abs())
                    .max(1.0);
                let news = port.moments;
                for (k, before) in moments.iter().enumerate() {
                    settled &= (news[k] - before).abs() <= CONVERGED * scale;
                    port.moments[k] = before + share * (news[k] - before);
                }
                settled &= (port.end_force - force).abs() <= CONVERGED * scale;
                port.end_force = force + share * (port.end_force - force);
            }
            if settled {
                return !self.ports.iter().any(|port| port.overflows);
            }
        }
        false
    }

    /// Whether paths agree with the exact motion at the middle of the step, in twice their forces.
    fn is_accurate(&self, level: usize, grounds: [f64; 2]) -> bool {
        if self.ports.iter().all(|port| port.pieces[0].is_none()) {
            return true;
        }
        let count = self.rows.len();
        let table = &self.levels[level + 1].table;
        let middle = [grounds[0], 0.5 * (grounds[0] + grounds[1])];
        (0..count).all(|one| {
            let port = &self.ports[one];
            if port.pieces[0].is_none() {
                return true;
            }
            let mut exact = -self.system.contacts[one].width;
            for (mode, share) in self.rows.shapes[one].iter().enumerate() {
                let driven = self.reduced.participation[mode];
                let factors = &table.displacement;
                exact += share
                    * (factors[0][mode] * self.displacement[mode]
                        + factors[1][mode] * self.velocity[mode]
                        - driven * (factors[2][mode] * middle[0] + factors[3][mode] * middle[1]));
            }
            let mut self_motion = 0.0;
            for (other, port) in self.ports.iter().enumerate() {
                let factors = &self.middles[level][one * count + other];
                let products = factors.iter().zip(port.moments).map(|(a, b)| a * b);
                let moved: f64 = products.sum();
                exact += moved;
                if other == one {
                    self_motion = moved;
                }
            }
            let gap = self.system.contacts[one].gap;
            let alike = (0..count).filter(|other| self.system.contacts[*other].gap == gap);
            let of_gap = alike.map(|other| self.greatest[other]).fold(0.0, f64::max);
            // A path that leads to a touch is compared without the force of the contact; one that ends with a release, over all of
            // the step, because the change of slope there is what it misses.
            port.pieces.iter().flatten().all(|piece| {
                let at = 0.5 * (piece.from + piece.to);
                let [value, rate] = [piece.path.value(at), piece.path.rate(at)];
                let answer = port.law.follow(value, rate, &piece.after);
                let scale = self.greatest[one].max(answer.force).max(FAINT * of_gap);
                let closed = piece.from <= 0.5;
                let within = if closed {
                    (exact - piece.path.value(0.5)).abs()
                } else {
                    0.0
                };
                let before = if piece.touches {
                    (exact - self_motion - port.open.value(0.5)).abs()
                } else {
                    0.0
                };
                2.0 * answer.by_indentation * within.max(before) <= self.tolerance * scale
            })
        })
    }

    /// Takes over the end of a step that began at `start`.
    fn accept(&mut self, level: usize, start: f64, ground: f64) {
        self.outcome.steps += 1;
        let step = self.levels[level].table.step;
        self.find_ends(level);
        for one in 0..self.rows.len() {
            let moments = self.ports[one].moments;
            if moments != [0.0; 3] {
                let Influence {
                    displacement,
                    velocity,
                    ..
                } = &self.levels[level];
                for (mode, share) in self.rows.shapes[one].iter().enumerate() {
                    for (k, moment) in moments.iter().enumerate() {
                        self.end_displacement[mode] -= share * displacement[k][mode] * moment;
                        self.end_velocity[mode] -= share * velocity[k][mode] * moment;
                    }
                }
            }
            for index in 0..port::MOST_PIECES {
                if let Some(piece) = self.ports[one].pieces[index] {
                    self.count(one, &piece, start, step);
                }
            }
            let port = &mut self.ports[one];
            port.start = self.ends[one];
            port.closed = port.end_closed;
            port.force = port.end_force;
        }
        for floor in 0..self.floors.len() {
            let (building, row) = &self.floors[floor];
            let mut end = self.shown(row, true, ground, None);
            for (one, port) in self
                .ports
                .iter()
                .enumerate()
                .filter(|(_, port)| port.force != 0.0)
            {
                let products = row.iter().zip(&self.rows.shapes[one]).map(|(a, b)| a * b);
                end[2] -= products.sum::<f64>() * port.force;
            }
            let begin = self.floor_ends[floor];
            let first = self.floors.partition_point(|(other, _)| other < building);
            let peak = &mut self.outcome.sways[*building][floor - first];
            *peak = peak.max(begin[0].abs()).max(end[0].abs());
            if begin[1] * end[1] < 0.0 {
                let path = Path::between(0.0, step, begin, end);
                let at = bisect(0.0, 1.0, |x| path.rate(x) * begin[1] <= 0.0);
                *peak = peak.max(path.value(at).abs());
            }
            self.floor_ends[floor] = end;
        }
        std::mem::swap(&mut self.displacement, &mut self.end_displacement);
        std::mem::swap(&mut self.velocity, &mut self.end_velocity);
    }

    /// Adds a piece to the impact to which it belongs.
    fn count(&mut self, contact: usize, piece: &Piece, start: f64, step: f64) {
        let current = if piece.touches {
            None
        } else {
            self.current[contact]
        };
        let index = current.unwrap_or_else(|| {
            self.outcome.impacts.push(PortImpact {
                contact,
                start: start + step * piece.from,
                impact_speed: piece.path.rate(piece.from),
                ..PortImpact::default()
            });
            self.outcome.impacts.len() - 1
        });
        let greatest = self.ports[contact].greatest(piece);
        let impact = &mut self.outcome.impacts[index];
        impact.peak_force = impact.peak_force.max(greatest);
        impact.impulse += step * piece.mean;
        impact.finished = piece.releases;
        self.greatest[contact] = self.greatest[contact].max(greatest);
        self.current[contact] = (!piece.releases).then_some(index);
    }
}
