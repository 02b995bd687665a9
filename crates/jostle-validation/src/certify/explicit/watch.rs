//! Greatest and least values of what is promised, at five instants of every step and between them.

use std::collections::BTreeSet;

use jostle::system::{BuildingSystem, Direction};
use jostle::{GroundMotion, System};

use super::super::reference::{BuildingPeaks, Peaks};
use super::bodies::{Bodies, Row, along, closing};
use super::course::{Course, top};
use super::forces::{Forces, Motion, Phases};
use crate::certify::quantities::{FOUNDATION, MAT, More, PLAN};

/// Heights that differ by less are the same \[m\].
const LEVEL: f64 = 1e-3;

/// A number that is followed.
enum Signal {
    /// A displacement, times a factor.
    Displacement(Row),
    /// A total acceleration: displacement, and which component of the ground acts.
    Acceleration(usize, Option<usize>),
    /// Squared length of two displacements.
    Square([Row; 2]),
    /// A sum of restoring forces.
    Restoring(Row),
    /// Force of bearings: stiffness, dashpot, displacement and spring.
    Bearings {
        row: Row,
        stiffness: f64,
        damping: f64,
        spring: Option<usize>,
    },
    Link(usize),
    /// Sum of the forces of contacts.
    Contacts(Vec<usize>),
    /// Closing of a contact less how much wider it is than the narrowest of its face.
    Closing(Row, f64),
}

/// Where the signals of a building stand, floor by floor.
struct Place {
    displacement: Vec<usize>,
    drift: Vec<usize>,
    acceleration: Vec<usize>,
    shear: Vec<usize>,
    moment: Vec<usize>,
    base: usize,
    /// Kind, floor, signals of which the greatest counts, and how their values count.
    more: Vec<(&'static str, usize, Vec<usize>, Count)>,
}

#[derive(Clone, Copy)]
enum Count {
    Most,
    Least,
    Either,
    Root,
}

/// A step that was taken.
pub(super) struct Taken<'a> {
    /// Instant of its start \[s\].
    pub(super) time: f64,
    pub(super) step: f64,
    pub(super) phases: &'a Phases,
    /// Motion and forces at both ends.
    pub(super) states: [&'a Motion; 2],
    pub(super) forces: [&'a Forces; 2],
}

pub(super) struct Watch {
    signals: Vec<Signal>,
    most: Vec<f64>,
    least: Vec<f64>,
    places: Vec<Place>,
    links: Vec<usize>,
    forces: Vec<usize>,
    closings: Vec<Vec<usize>>,
    impulses: Vec<f64>,
    buffer: [Vec<f64>; 5],
    middle: Motion,
    middle_forces: Forces,
}

impl Watch {
    pub(super) fn new(system: &System) -> Self {
        let mut signals = Vec::new();
        let places = system
            .buildings
            .iter()
            .map(|building| place(building, &mut signals))
            .collect();
        let mut add = |signal: Signal| {
            signals.push(signal);
            signals.len() - 1
        };
        let links = (0..system.links.len())
            .map(|link| add(Signal::Link(link)))
            .collect();
        let (mut forces, mut closings) = (Vec::new(), Vec::new());
        for points in faces(system) {
            forces.push(add(Signal::Contacts(points.clone())));
            let widths = points.iter().map(|point| system.contacts[*point].width);
            let narrowest = widths.fold(f64::INFINITY, f64::min);
            let adds = points.iter().map(|point| {
                let contact = &system.contacts[*point];
                let further = contact.width - narrowest;
                add(Signal::Closing(closing(&contact.ports), further))
            });
            closings.push(adds.collect());
        }
        let count = signals.len();
        // Closings may stay negative.
        let most = signals.iter().map(|signal| match signal {
            Signal::Closing(_, further) => -further,
            _ => 0.0,
        });
        Self {
            most: most.collect(),
            least: vec![0.0; count],
            signals,
            places,
            links,
            impulses: vec![0.0; forces.len()],
            forces,
            closings,
            buffer: Default::default(),
            middle: Motion::default(),
            middle_forces: Forces::default(),
        }
    }

    fn read(signals: &[Signal], state: &Motion, forces: &Forces, out: &mut Vec<f64>) {
        out.clear();
        out.extend(signals.iter().map(|signal| match signal {
            Signal::Displacement(row) => along(row, &state.u),
            Signal::Acceleration(dof, ground) => {
                forces.acceleration[*dof] + ground.map_or(0.0, |which| forces.ground[which])
            }
            Signal::Square(rows) => rows.iter().map(|row| along(row, &state.u).powi(2)).sum(),
            Signal::Restoring(row) => along(row, &forces.restoring),
            Signal::Bearings {
                row,
                stiffness,
                damping,
                spring,
            } => {
                stiffness * along(row, &state.u)
                    + damping * along(row, &state.v)
                    + spring.map_or(0.0, |spring| forces.springs[spring])
            }
            Signal::Link(link) => forces.links[*link],
            Signal::Contacts(points) => points.iter().map(|point| forces.contacts[*point]).sum(),
            Signal::Closing(row, further) => along(row, &state.u) - further,
        }));
    }

    /// Takes a step in.
    pub(super) fn take_step(&mut self, bodies: &Bodies, motion: &GroundMotion, taken: &Taken<'_>) {
        let Taken {
            time,
            step: h,
            phases,
            states,
            forces,
        } = *taken;
        let n = bodies.len();
        Self::read(&self.signals, states[0], forces[0], &mut self.buffer[0]);
        Self::read(&self.signals, states[1], forces[1], &mut self.buffer[4]);
        self.middle.u.resize(n, 0.0);
        self.middle.v.resize(n, 0.0);
        self.middle.z.resize(bodies.unknowns, 0.0);
        for part in 1..4 {
            let s = 0.25 * part as f64;
            for k in 0..n {
                let ends = [0, 1].map(|end| {
                    let (state, force) = (states[end], forces[end]);
                    [state.u[k], state.v[k], force.acceleration[k]]
                });
                let course = Course::new(ends[0], ends[1], h);
                self.middle.u[k] = course.value(s);
                self.middle.v[k] = course.rate(s);
            }
            for k in 0..bodies.unknowns {
                let ends = [0, 1].map(|end| [states[end].z[k], forces[end].rates[k]]);
                // A cubic.
                let ([x0, v0], [x1, v1]) = (ends[0], ends[1]);
                let (p, q, d) = (h * v0, h * v1, x1 - x0);
                self.middle.z[k] =
                    x0 + s * (p + s * ((3.0 * d - 2.0 * p - q) + s * (p + q - 2.0 * d)));
            }
            bodies.forces(
                motion,
                time + s * h,
                &mut self.middle,
                phases,
                &mut self.middle_forces,
            );
            let out = &mut self.buffer[part];
            Self::read(&self.signals, &self.middle, &self.middle_forces, out);
        }
        for k in 0..self.signals.len() {
            let y: [f64; 5] = std::array::from_fn(|part| self.buffer[part][k]);
            let high = y.iter().fold(f64::NEG_INFINITY, |m, v| m.max(*v));
            let low = y.iter().fold(f64::INFINITY, |m, v| m.min(*v));
            let reach = 0.5 * (high - low);
            if high + reach > self.most[k] {
                self.most[k] = self.most[k].max(top(&y));
            }
            if low - reach < self.least[k] {
                self.least[k] = self.least[k].min(-top(&y.map(|v| -v)));
            }
        }
        for (impulse, place) in self.impulses.iter_mut().zip(&self.forces) {
            let y = self.buffer.each_ref().map(|buffer| buffer[*place]);
            *impulse += h * (7.0 * (y[0] + y[4]) + 32.0 * (y[1] + y[3]) + 12.0 * y[2]) / 90.0;
        }
    }

    pub(super) fn finish(&self, system: &System, steps: u64, touches: u64) -> Peaks {
        let either = |k: usize| self.most[k].max(-self.least[k]);
        let all = |list: &[usize]| -> Vec<f64> { list.iter().map(|k| either(*k)).collect() };
        let buildings = system.buildings.iter().zip(&self.places);
        let buildings = buildings.map(|(building, place)| {
            let floors = building.floors.iter();
            let heights: Vec<f64> = floors.map(|floor| floor.storey_height).collect();
            let drift = all(&place.drift).into_iter().zip(&heights);
            BuildingPeaks {
                most: place.displacement.iter().map(|k| self.most[*k]).collect(),
                least: place.displacement.iter().map(|k| self.least[*k]).collect(),
                drift: drift.map(|(way, height)| way / height).collect(),
                acceleration: all(&place.acceleration),
                shear: either(place.base),
                storey_shear: all(&place.shear),
                moment: all(&place.moment),
                more: place
                    .more
                    .iter()
                    .map(|(kind, floor, signals, count)| {
                        let most = signals.iter().map(|k| match count {
                            Count::Most => self.most[*k],
                            Count::Least => self.least[*k],
                            Count::Either => either(*k),
                            Count::Root => self.most[*k].max(0.0).sqrt(),
                        });
                        let value = match count {
                            Count::Least => most.fold(0.0, f64::min),
                            _ => most.fold(0.0, f64::max),
                        };
                        More {
                            kind,
                            floor: *floor,
                            value: match *kind {
                                "drift across" | "drift at corners" => value / heights[*floor - 1],
                                _ => value,
                            },
                        }
                    })
                    .collect(),
            }
        });
        let closing = self.closings.iter().map(|closing| {
            let most = closing.iter().map(|k| self.most[*k]);
            most.fold(f64::NEG_INFINITY, f64::max)
        });
        Peaks {
            buildings: buildings.collect(),
            force: self.forces.iter().map(|k| self.most[*k]).collect(),
            impulse: self.impulses.clone(),
            closing: closing.collect(),
            link: all(&self.links),
            touches,
            lasting: 0,
            steps,
        }
    }
}

/// Contacts as results list them: points of a face together.
pub(super) fn faces(system: &System) -> Vec<Vec<usize>> {
    let mut faces: Vec<(usize, Vec<usize>)> = Vec::new();
    for (index, contact) in system.contacts.iter().enumerate() {
        let key = contact.plan.map_or(index, |place| place.face);
        match faces.last_mut() {
            Some((last, points)) if *last == key => points.push(index),
            _ => faces.push((key, vec![index])),
        }
    }
    faces.into_iter().map(|(_, points)| points).collect()
}

fn place(building: &BuildingSystem, signals: &mut Vec<Signal>) -> Place {
    let mut add = |signal: Signal| {
        signals.push(signal);
        signals.len() - 1
    };
    if building.is_in_space() {
        return place_in_plan(building, &mut add);
    }
    let offset = building.offset;
    // Displacements above the base that carry horizontal restoring forces, with their heights.
    let nodes = building.discretization.stick_model.nodes.iter().enumerate();
    let mut forces: Vec<(usize, f64)> = nodes
        .filter_map(|(node, at)| Some((building.equations.horizontal(node)? + offset, at.y)))
        .collect();
    // Joints of a floor that move together are one.
    let mut seen = BTreeSet::new();
    forces.retain(|(dof, _)| seen.insert(*dof));
    let sway = building
        .foundation
        .and_then(|foundation| Some([foundation.sway?, foundation.turning]));
    let mut below: Row = building.foot.map(|dof| (dof, -1.0)).into_iter().collect();
    if let Some([dof, _]) = sway {
        below = vec![(dof, -1.0)];
    }
    let mut base = 0.0;
    let mut place = Place {
        displacement: Vec::new(),
        drift: Vec::new(),
        acceleration: Vec::new(),
        shear: Vec::new(),
        moment: Vec::new(),
        base: 0,
        more: Vec::new(),
    };
    for floor in &building.floors {
        place
            .displacement
            .push(add(Signal::Displacement(vec![(floor.dof, 1.0)])));
        let mut drift = std::mem::replace(&mut below, vec![(floor.dof, -1.0)]);
        drift.push((floor.dof, 1.0));
        if let Some([_, turned]) = sway {
            drift.push((turned, floor.storey_height));
        }
        place.drift.push(add(Signal::Displacement(drift)));
        place
            .acceleration
            .push(add(Signal::Acceleration(floor.dof, Some(0))));
        let above = || {
            let above = forces.iter().filter(|(_, y)| *y > base + LEVEL);
            above.copied()
        };
        place.shear.push(add(Signal::Restoring(
            above().map(|(dof, _)| (dof, 1.0)).collect(),
        )));
        place.moment.push(add(Signal::Restoring(
            above().map(|(dof, y)| (dof, y - base)).collect(),
        )));
        base = floor.height;
    }
    let not_soil = forces
        .iter()
        .filter(|(dof, _)| sway.is_none_or(|sway| sway[0] != *dof));
    place.base = add(Signal::Restoring(
        not_soil.map(|(dof, _)| (*dof, 1.0)).collect(),
    ));
    if let (Some(support), Some(_)) = (building.support, building.discretization.mat) {
        let row = vec![(support.dof, 1.0)];
        let moved = add(Signal::Displacement(row.clone()));
        let acceleration = add(Signal::Acceleration(support.dof, Some(0)));
        let force = add(Signal::Bearings {
            row,
            stiffness: support.stiffness,
            damping: support.damping,
            spring: support.spring.map(|spring| spring + building.spring_offset),
        });
        let signals = [
            (moved, Count::Most),
            (moved, Count::Least),
            (acceleration, Count::Either),
            (force, Count::Either),
        ];
        for (kind, (signal, count)) in MAT.iter().zip(signals) {
            place.more.push((kind, 0, vec![signal], count));
        }
    }
    if let Some(dofs) = sway {
        for (kind, dof) in FOUNDATION.iter().zip(dofs) {
            let signal = add(Signal::Displacement(vec![(dof, 1.0)]));
            place.more.push((kind, 0, vec![signal], Count::Either));
        }
    }
    place
}

fn place_in_plan(building: &BuildingSystem, add: &mut impl FnMut(Signal) -> usize) -> Place {
    let (n, offset) = (building.floors.len(), building.offset);
    let dof = |direction: Direction, floor: usize| {
        let mut tracks = building.tracks.iter();
        let tracks = tracks.by_ref().filter(|track| track.direction == direction);
        tracks.map(|track| track.dof).nth(floor).unwrap_or(0)
    };
    let centres = &building.discretization.centres;
    let axis = centres[0];
    let moved = |row: &jostle::linear::Row| -> Row {
        let entries = row.entries().iter();
        entries.map(|(dof, share)| (dof + offset, *share)).collect()
    };
    // Motion of a vertical line of a storey, at a place from the centre of mass above.
    let line = |storey: usize, at: [f64; 2]| -> [Row; 2] {
        let plan_storey = &building.plan_storeys[storey];
        // What a footing keeps from moving has no displacement.
        let place = |dofs: [Option<usize>; 3], arm: [f64; 2], sign: f64| {
            let [x, y, turned] = dofs.map(|dof| dof.map(|dof| dof + offset));
            let both = [
                [(x, sign), (turned, -sign * arm[1])],
                [(y, sign), (turned, sign * arm[0])],
            ];
            both.map(|row| {
                let shares = row.into_iter();
                shares.filter_map(|(dof, share)| Some((dof?, share)))
            })
        };
        let above = place(plan_storey.above.map(Some), at, 1.0);
        let below = plan_storey.below.map(|dofs| {
            let arm = [plan_storey.offset[0] + at[0], plan_storey.offset[1] + at[1]];
            place(dofs, arm, -1.0)
        });
        [0, 1].map(|axis| {
            let below = below.iter().flat_map(|below| below[axis].clone());
            above[axis].clone().chain(below).collect()
        })
    };
    let sum = |which: Direction, base: usize, arm: &dyn Fn(usize) -> f64| -> Row {
        (base..n)
            .map(|floor| (dof(which, floor), arm(floor)))
            .collect()
    };
    let mut place = Place {
        displacement: Vec::new(),
        drift: Vec::new(),
        acceleration: Vec::new(),
        shear: Vec::new(),
        moment: Vec::new(),
        base: 0,
        more: Vec::new(),
    };
    let mut base = 0.0;
    // By kind, in the order of the list of kinds.
    let mut more: Vec<Vec<(Vec<usize>, Count)>> = PLAN.iter().map(|_| Vec::new()).collect();
    for floor in 0..n {
        let [x, y, turned] = [Direction::Along, Direction::Across, Direction::Turning]
            .map(|direction| dof(direction, floor));
        let one = |dof: usize| Signal::Displacement(vec![(dof, 1.0)]);
        place.displacement.push(add(one(x)));
        let [drift, across] = line(floor, [0.0; 2]);
        place.drift.push(add(Signal::Displacement(drift)));
        place
            .acceleration
            .push(add(Signal::Acceleration(x, Some(0))));
        let height = |floor: usize| building.floors[floor].height - base;
        let shear = sum(Direction::Along, floor, &|_| 1.0);
        place.shear.push(add(Signal::Restoring(shear)));
        let moment = sum(Direction::Along, floor, &height);
        place.moment.push(add(Signal::Restoring(moment)));
        let moved_across = add(one(y));
        let rotation = add(one(turned));
        let corners = building
            .corners
            .iter()
            .filter(|corner| corner.floor == floor);
        let corners: Vec<usize> = corners
            .map(|corner| add(Signal::Square(corner.rows.each_ref().map(moved))))
            .collect();
        let acceleration = add(Signal::Acceleration(y, Some(1)));
        let drift_across = add(Signal::Displacement(across));
        let drifts: Vec<usize> = building.plan_storeys[floor]
            .corners
            .iter()
            .map(|at| add(Signal::Square(line(floor, *at))))
            .collect();
        let shear = add(Signal::Restoring(sum(Direction::Across, floor, &|_| 1.0)));
        let mut torque = sum(Direction::Turning, floor, &|_| 1.0);
        torque.extend(sum(Direction::Across, floor, &|level| {
            centres[level][0] - axis[0]
        }));
        torque.extend(sum(Direction::Along, floor, &|level| {
            axis[1] - centres[level][1]
        }));
        let torque = add(Signal::Restoring(torque));
        let entries = [
            (vec![moved_across], Count::Most),
            (vec![moved_across], Count::Least),
            (vec![rotation], Count::Most),
            (vec![rotation], Count::Least),
            (corners, Count::Root),
            (vec![acceleration], Count::Either),
            (vec![drift_across], Count::Either),
            (drifts, Count::Root),
            (vec![shear], Count::Either),
            (vec![torque], Count::Either),
        ];
        for (list, entry) in more.iter_mut().zip(entries) {
            list.push(entry);
        }
        base = building.floors[floor].height;
    }
    place.base = place.shear[0];
    for ((kind, _), list) in PLAN.iter().zip(more) {
        for (floor, (signals, count)) in list.into_iter().enumerate() {
            place.more.push((kind, floor + 1, signals, count));
        }
    }
    place
}
