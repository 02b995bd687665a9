//! Contacts between buildings.

use crate::certify::C64;
use jostle::System;

use super::super::laws::Law;
use super::super::linear::Component;
use super::polynomial::ZERO;
use super::watch::Watch;

pub(super) struct Side {
    pub(super) component: usize,
    pub(super) row: Vec<C64>,
    pub(super) rate: Vec<C64>,
    pub(super) push: Vec<C64>,
    /// Jump of the accelerations of floors per force, and of their slopes.
    pub(super) accelerates: Vec<f64>,
    pub(super) jerks: Vec<f64>,
    /// Slopes of the forces of links per force.
    pub(super) pulls: Vec<f64>,
}

pub(super) struct ContactState {
    pub(super) sides: Vec<Side>,
    pub(super) width: f64,
    pub(super) rest: f64,
    pub(super) law: Law,
    pub(super) restitution: Option<f64>,
    pub(super) mass: f64,
    pub(super) gap: usize,
    pub(super) floor_force: f64,
    pub(super) duration: f64,
}

impl ContactState {
    /// Every contact of a system, its width changed by a share `widen`.
    pub(super) fn all(
        system: &System,
        components: &[Component],
        watch: &[Watch],
        widen: f64,
    ) -> Result<Vec<Self>, String> {
        let of_building = |building: usize| {
            components
                .iter()
                .position(|c| c.buildings.contains(&building))
                .unwrap_or(0)
        };
        let rest_of = |dof: usize| {
            let building = system.buildings.iter().find(|b| b.range().contains(&dof));
            building.map_or(0.0, |b| {
                b.rest
                    .displacement
                    .get(dof - b.offset)
                    .copied()
                    .unwrap_or(0.0)
            })
        };
        let mut contact_states = Vec::new();
        for contact in &system.contacts {
            let mut by_component: Vec<(usize, Vec<(usize, f64)>)> = Vec::new();
            for (face, sign) in contact.ports.sides() {
                let component = of_building(face.building);
                let weights = face.row.entries().iter().map(|&(dof, c)| (dof, sign * c));
                match by_component.iter_mut().find(|(c, _)| *c == component) {
                    Some((_, list)) => list.extend(weights),
                    None => by_component.push((component, weights.collect())),
                }
            }
            let mut rest = 0.0;
            let sides = by_component
                .into_iter()
                .map(|(index, list)| {
                    let component = &components[index];
                    // A force pushes with `sign`; the closing falls by as much.
                    let weights: Vec<(usize, f64)> =
                        list.iter().map(|(dof, s)| (*dof, -s)).collect();
                    rest += weights
                        .iter()
                        .map(|(dof, w)| w * rest_of(*dof))
                        .sum::<f64>();
                    let row = component.output(&weights);
                    let rate = row
                        .iter()
                        .zip(&component.lambda)
                        .map(|(c, l)| c * l)
                        .collect();
                    let mut push = vec![ZERO; component.lambda.len()];
                    for (dof, sign) in &list {
                        for (sum, push) in push.iter_mut().zip(component.push(*dof)) {
                            *sum += push * *sign;
                        }
                    }
                    let [accelerates, jerks, pulls] = watch[index].struck(&push);
                    Side {
                        component: index,
                        row,
                        rate,
                        accelerates,
                        jerks,
                        pulls,
                        push,
                    }
                })
                .collect();
            let (law, restitution) = Law::new(&contact.law)?;
            let mass = contact.effective_mass();
            contact_states.push(Self {
                sides,
                width: contact.width * (1.0 + widen) + 1e-4 * widen,
                rest,
                law,
                restitution,
                mass,
                gap: contact.gap,
                floor_force: contact.law.elastic_force(mass, 0.03),
                duration: contact.law.elastic_duration(mass, 0.3),
            });
        }
        Ok(contact_states)
    }
}
