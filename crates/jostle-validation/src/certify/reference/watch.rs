//! What is watched of the buildings of a component.

use faer::c64;
use jostle::System;

use super::super::linear::Component;
use super::polynomial::real_dot;

/// Values and slopes of what is watched in a component.
pub(super) struct Watch {
    /// Rows of coefficients: displacement and velocity of foot and floors, acceleration and jerk of floors, shear and its
    /// slope.
    pub(super) rows: Vec<Vec<c64>>,
    pub(super) jerk_by_ground: Vec<f64>,
    pub(super) constant: Vec<f64>,
    /// (building, index of its foot row among displacements, floors, storey heights, offset of rest).
    pub(super) buildings: Vec<Watched>,
    pub(super) floors: usize,
}

pub(super) struct Watched {
    pub(super) building: usize,
    pub(super) first_floor: usize,
    pub(super) heights: Vec<f64>,
    pub(super) has_foot: bool,
}

impl Watch {
    pub(super) fn of(system: &System, component: &Component) -> Self {
        let mut displacements = Vec::new();
        let mut constant = Vec::new();
        let mut buildings = Vec::new();
        let mut feet = Vec::new();
        let mut shears = Vec::new();
        for &index in &component.buildings {
            let building = &system.buildings[index];
            let rest = |dof: usize| {
                building
                    .rest
                    .get(dof - building.offset)
                    .copied()
                    .unwrap_or(0.0)
            };
            buildings.push(Watched {
                building: index,
                first_floor: displacements.len(),
                heights: building.floors.iter().map(|f| f.storey_height).collect(),
                has_foot: building.foot.is_some(),
            });
            for floor in &building.floors {
                displacements.push(component.output(&[(floor.dof, 1.0)]));
                constant.push(rest(floor.dof));
            }
            if let Some(foot) = building.foot {
                feet.push((component.output(&[(foot, 1.0)]), rest(foot)));
            }
            let n = building.equations.len();
            let mut unit = vec![0.0; n];
            let mut weights = Vec::new();
            for dof in 0..n {
                unit[dof] = 1.0;
                let weight = building.equations.base_shear(&unit);
                unit[dof] = 0.0;
                if weight != 0.0 {
                    weights.push((building.offset + dof, weight));
                }
            }
            let sinks = if building.rest.is_empty() {
                0.0
            } else {
                building.equations.base_shear(&building.rest)
            };
            shears.push((component.output(&weights), sinks));
        }
        let floors = displacements.len();
        let times = |row: &[c64], power: i32| -> Vec<c64> {
            row.iter()
                .zip(&component.lambda)
                .map(|(c, l)| c * l.powi(power))
                .collect()
        };
        let mut rows = Vec::new();
        for row in &displacements {
            rows.push(row.clone());
            rows.push(times(row, 1));
        }
        for row in &displacements {
            rows.push(times(row, 2));
            rows.push(times(row, 3));
        }
        for (row, sinks) in &shears {
            rows.push(row.clone());
            rows.push(times(row, 1));
            constant.push(*sinks);
        }
        for (row, rest) in &feet {
            rows.push(row.clone());
            rows.push(times(row, 1));
            constant.push(*rest);
        }
        let jerk_by_ground = displacements
            .iter()
            .map(|row| {
                let terms = times(row, 2);
                terms
                    .iter()
                    .zip(&component.ground)
                    .map(|(c, b)| (c * b).re)
                    .sum()
            })
            .collect();
        Self {
            rows,
            jerk_by_ground,
            constant,
            buildings,
            floors,
        }
    }

    pub(super) fn displacement(&self, floor: usize) -> &[c64] {
        &self.rows[2 * floor]
    }

    pub(super) fn acceleration(&self, floor: usize) -> usize {
        self.floors + floor
    }

    pub(super) fn drift(&self, floor: usize) -> usize {
        2 * self.floors + self.buildings.len() + floor
    }

    pub(super) fn shear(&self, building: usize) -> usize {
        let own = self.buildings.iter().position(|b| b.building == building);
        2 * self.floors + own.unwrap_or(0)
    }

    pub(super) fn len(&self) -> usize {
        3 * self.floors + self.buildings.len()
    }

    /// Displacements, total accelerations, base shears and drifts with their slopes, without forces of contacts.
    pub(super) fn values(&self, q: &[c64], ground: f64) -> Vec<(f64, f64)> {
        let value = |row: usize| real_dot(&self.rows[row], q);
        let count = self.buildings.len();
        let mut all = Vec::with_capacity(self.len());
        for floor in 0..self.floors {
            all.push((
                value(2 * floor) + self.constant[floor],
                value(2 * floor + 1),
            ));
        }
        for floor in 0..self.floors {
            let place = 2 * (self.floors + floor);
            all.push((
                value(place),
                value(place + 1) + self.jerk_by_ground[floor] * ground,
            ));
        }
        for k in 0..count {
            let place = 2 * (2 * self.floors + k);
            all.push((
                value(place) + self.constant[self.floors + k],
                value(place + 1),
            ));
        }
        let mut foot = 0;
        for watched in &self.buildings {
            let mut below = (0.0, 0.0);
            if watched.has_foot {
                let place = 2 * (2 * self.floors + count + foot);
                below = (
                    value(place) + self.constant[self.floors + count + foot],
                    value(place + 1),
                );
                foot += 1;
            }
            for (floor, height) in watched.heights.iter().enumerate() {
                let now = all[watched.first_floor + floor];
                all.push(((now.0 - below.0) / height, (now.1 - below.1) / height));
                below = now;
            }
        }
        all
    }
}
