//! Outputs of the buildings of a component that are followed.

use crate::certify::C64;
use jostle::System;

use super::super::linear::Component;
use super::polynomial::real_dot;
use super::storeys::storeys;

/// A linear form of the modes with its slope.
struct Form {
    value: Vec<C64>,
    slope: Vec<C64>,
    constant: f64,
}

impl Form {
    fn new(value: Vec<C64>, component: &Component, constant: f64) -> Self {
        let slope = times(&value, component, 1);
        Self {
            value,
            slope,
            constant,
        }
    }

    fn value(&self, q: &[C64]) -> (f64, f64) {
        (
            real_dot(&self.value, q) + self.constant,
            real_dot(&self.slope, q),
        )
    }
}

/// Values and slopes of what is watched in a component.
pub(super) struct Watch {
    displacements: Vec<Form>,
    accelerations: Vec<Form>,
    jerk_by_ground: Vec<f64>,
    /// Base shear of every building.
    shears: Vec<Form>,
    /// Shear of every storey.
    storey_shears: Vec<Form>,
    /// Part of the moment of every storey that forces between its floors have, if there are any.
    between: Vec<Option<Form>>,
    pub(super) buildings: Vec<Watched>,
    pub(super) floors: usize,
    pub(super) links: Vec<WatchedLink>,
}

/// A building and its storeys.
pub(super) struct Watched {
    pub(super) building: usize,
    pub(super) first_floor: usize,
    pub(super) heights: Vec<f64>,
    foot: Option<Form>,
}

/// The force of a link.
pub(super) struct WatchedLink {
    /// Which of the system.
    pub(super) link: usize,
    force: Form,
    slope_by_ground: f64,
}

/// A row after differentiating `power` times.
fn times(row: &[C64], component: &Component, power: i32) -> Vec<C64> {
    let terms = row.iter().zip(&component.lambda);
    terms.map(|(c, l)| c * l.powi(power)).collect()
}

/// What an input does to an output at once.
fn at_once(row: &[C64], input: &[C64]) -> f64 {
    row.iter().zip(input).map(|(c, b)| (c * b).re).sum()
}

impl Watch {
    pub(super) fn new(system: &System, component: &Component) -> Self {
        let mut watch = Self {
            displacements: Vec::new(),
            accelerations: Vec::new(),
            jerk_by_ground: Vec::new(),
            shears: Vec::new(),
            storey_shears: Vec::new(),
            between: Vec::new(),
            buildings: Vec::new(),
            floors: 0,
            links: Vec::new(),
        };
        for &index in &component.buildings {
            watch.add_building(system, component, index);
        }
        for (link, element) in system.links.iter().enumerate() {
            let in_component = |building: &Option<usize>| {
                building.is_some_and(|building| component.buildings.contains(&building))
            };
            if !element.ports.buildings().iter().any(in_component) {
                continue;
            }
            // A face pushed right by a compressed link shortens it by moving left.
            let sides = element.ports.sides();
            let weights: Vec<(usize, f64)> = sides
                .flat_map(|(face, sign)| {
                    face.row
                        .entries()
                        .to_vec()
                        .into_iter()
                        .map(move |(dof, c)| (dof, -sign * c))
                })
                .collect();
            let row = component.output(&weights);
            let rate = times(&row, component, 1);
            let both = row.iter().zip(&rate);
            let both = both.map(|(x, v)| x * element.stiffness + v * element.damping);
            let force = Form::new(both.collect(), component, 0.0);
            watch.links.push(WatchedLink {
                link,
                slope_by_ground: at_once(&force.value, &component.ground),
                force,
            });
        }
        watch
    }

    fn add_building(&mut self, system: &System, component: &Component, index: usize) {
        let building = &system.buildings[index];
        let rest = |dof: usize| building.rest.displacement.get(dof).copied().unwrap_or(0.0);
        let one = |dof: usize| {
            let row = component.output(&[(dof, 1.0)]);
            Form::new(row, component, rest(dof - building.offset))
        };
        self.buildings.push(Watched {
            building: index,
            first_floor: self.floors,
            heights: building.floors.iter().map(|f| f.storey_height).collect(),
            foot: building.foot.map(one),
        });
        self.floors += building.floors.len();
        for floor in &building.floors {
            let displacement = one(floor.dof);
            let acceleration = Form::new(times(&displacement.value, component, 2), component, 0.0);
            let jerk = at_once(&acceleration.value, &component.ground);
            self.jerk_by_ground.push(jerk);
            self.displacements.push(displacement);
            self.accelerations.push(acceleration);
        }
        let form = |weights: &[f64]| {
            let list = weights.iter().enumerate().filter(|(_, w)| **w != 0.0);
            let list: Vec<(usize, f64)> =
                list.map(|(dof, w)| (building.offset + dof, *w)).collect();
            let at_rest = weights.iter().enumerate().map(|(dof, w)| w * rest(dof));
            Form::new(component.output(&list), component, at_rest.sum())
        };
        let n = building.equations.len();
        let mut unit = vec![0.0; n];
        let shear: Vec<f64> = (0..n)
            .map(|dof| {
                unit[dof] = 1.0;
                let weight = building.equations.base_shear(&unit);
                unit[dof] = 0.0;
                weight
            })
            .collect();
        self.shears.push(form(&shear));
        for storey in storeys(building) {
            self.storey_shears.push(form(&storey.shear));
            self.between.push(storey.between.as_deref().map(form));
        }
    }

    /// What a force does at once to the accelerations of floors, to their slopes, and to the slopes of the forces of
    /// links.
    pub(super) fn struck(&self, push: &[C64]) -> [Vec<f64>; 3] {
        let by = |rows: &mut dyn Iterator<Item = &Vec<C64>>| -> Vec<f64> {
            rows.map(|row| at_once(row, push)).collect()
        };
        [
            by(&mut self.displacements.iter().map(|form| &form.slope)),
            by(&mut self.accelerations.iter().map(|form| &form.value)),
            by(&mut self.links.iter().map(|link| &link.force.value)),
        ]
    }

    pub(super) fn displacement(&self, floor: usize) -> &[C64] {
        &self.displacements[floor].value
    }

    pub(super) fn acceleration(&self, floor: usize) -> usize {
        self.floors + floor
    }

    pub(super) fn shear(&self, building: usize) -> usize {
        let position = self.buildings.iter().position(|b| b.building == building);
        2 * self.floors + position.unwrap_or(0)
    }

    pub(super) fn drift(&self, floor: usize) -> usize {
        2 * self.floors + self.buildings.len() + floor
    }

    pub(super) fn storey_shear(&self, floor: usize) -> usize {
        self.drift(self.floors + floor)
    }

    pub(super) fn moment(&self, floor: usize) -> usize {
        self.storey_shear(self.floors + floor)
    }

    pub(super) fn link(&self, index: usize) -> usize {
        self.moment(self.floors + index)
    }

    pub(super) fn len(&self) -> usize {
        self.link(self.links.len())
    }

    /// Adds what the ground does at once to signals without it.
    pub(super) fn add_ground(&self, signals: &mut [(f64, f64)], ground: f64) {
        for (floor, jerk) in self.jerk_by_ground.iter().enumerate() {
            signals[self.acceleration(floor)].1 += jerk * ground;
        }
        for (index, link) in self.links.iter().enumerate() {
            signals[self.link(index)].1 += link.slope_by_ground * ground;
        }
    }

    /// Displacements, total accelerations, base shears, drifts, storey shears, overturning moments and forces of links
    /// with their slopes, without what the ground and contacts do at once.
    pub(super) fn values(&self, q: &[C64]) -> Vec<(f64, f64)> {
        let mut all = Vec::with_capacity(self.len());
        all.extend(self.displacements.iter().map(|form| form.value(q)));
        all.extend(self.accelerations.iter().map(|form| form.value(q)));
        all.extend(self.shears.iter().map(|form| form.value(q)));
        for watched in &self.buildings {
            let mut below = watched
                .foot
                .as_ref()
                .map_or((0.0, 0.0), |foot| foot.value(q));
            for (floor, height) in watched.heights.iter().enumerate() {
                let now = all[watched.first_floor + floor];
                all.push(((now.0 - below.0) / height, (now.1 - below.1) / height));
                below = now;
            }
        }
        all.extend(self.storey_shears.iter().map(|form| form.value(q)));
        all.resize(self.moment(self.floors), (0.0, 0.0));
        for watched in &self.buildings {
            let mut above = (0.0, 0.0);
            for (floor, height) in watched.heights.iter().enumerate().rev() {
                let floor = watched.first_floor + floor;
                let shear = all[self.storey_shear(floor)];
                let inner = self.between[floor].as_ref();
                let inner = inner.map_or((0.0, 0.0), |form| form.value(q));
                above.0 += height * shear.0 + inner.0;
                above.1 += height * shear.1 + inner.1;
                all[self.moment(floor)] = above;
            }
        }
        all.extend(self.links.iter().map(|link| link.force.value(q)));
        all
    }
}
