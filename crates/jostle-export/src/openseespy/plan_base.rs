//! Bases of buildings with a plan on springs and dashpots: sway, rotation, rocking, and contact with the ground in compression alone.
//!
//! A base that rocks makes it a model in space. Its feet follow it as a rigid body. Floors of storeys lean with it, and storeys between
//! them are `twoNodeLink`s in shear, whose deformation is u_i − u_(i−1) − hφ.

use std::fmt::Write;

use jostle::hysteresis::HysteresisRule;
use jostle::structure::{Influence, Node, PlanBase, Support};
use jostle::system::BuildingSystem;
use jostle::{AcrossBase, PlanPoint, ProportionalDamping, Structure};

use super::foundation::GROUND;
use super::plan::{DIRECTIONS, masses};
use super::script::{Script, rounded};
use super::ties::COMPONENTS;

/// Stiffness of what holds a base or a wall, in units of the mass that it carries \[1/s²\].
pub(super) const HELD: f64 = 1e9;
/// Stiffness of what leans floors with a base, in units of that of its rocking \[–\].
const STIFF: f64 = 1e6;
/// Directions of OpenSees: upwards, and rotations in which floors lean along x and across.
const UP: usize = 3;
const LEANING: [usize; 2] = [5, 4];

/// A mass that is not that of a floor.
pub(super) struct DampedMass {
    /// Its node.
    pub(super) tag: usize,
    /// Its place \[m\].
    pub(super) at: [f64; 3],
    /// Unit vector of the line along which the first of its inertias acts.
    pub(super) direction: [f64; 2],
    /// Along its line and upwards \[kg\], and in rotation in this plane \[kg·m²\].
    pub(super) inertia: [f64; 3],
}

impl Script<'_> {
    /// A base on springs and dashpots, and what leans with it.
    pub(super) fn add_base_in_plan(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        plan_base: PlanBase,
    ) {
        let stick_model = &building.discretization.stick_model;
        let model_building = &self.export.model.buildings[index];
        let base = match &building.foundation_in_plan {
            Some(found) => found.springs.base(&found.foundation),
            None => model_building.base,
        };
        let footing = stick_model.nodes[plan_base.footing];
        let tag = self.tag(index, plan_base.footing);
        let [x, y] = plan_base.centre.map(rounded);
        let (mass, polar) = (masses(&footing), footing.inertia[2]);
        let _ = writeln!(self.nodes, "    ({tag}, {x:?}, {y:?}, {mass}, {polar:?}),");
        let middle = self.point(index, Some(plan_base.footing), plan_base.middle);
        let ground = self.point(index, None, plan_base.middle);
        let carried: f64 = stick_model.nodes.iter().map(|node| node.mass()).sum();
        let held = HELD * carried;
        let directions = base.in_plan();
        let moves = |component: usize| match footing.support {
            Support::Free => true,
            Support::Swaying => component != 2,
            Support::Turning => component == 2,
            Support::Fixed | Support::Guided => false,
        };
        let sway = |part: &AcrossBase| {
            [
                part.horizontal_stiffness.unwrap_or(0.0),
                part.horizontal_damping,
            ]
        };
        let springs = [
            sway(&directions[0]),
            sway(&directions[1]),
            [
                base.torsional_stiffness.unwrap_or(0.0),
                base.torsional_damping,
            ],
        ];
        let mut all = Vec::new();
        let mut holds = false;
        for (component, [stiffness, dashpot]) in springs.into_iter().enumerate() {
            let material = match moves(component) {
                true => self.materials.elastic(stiffness, dashpot),
                false => self.materials.elastic(held, 0.0),
            };
            holds |= !moves(component);
            all.push((DIRECTIONS[component], material));
        }
        match plan_base.rocking {
            None => {
                let _ = writeln!(self.levels, "    ({tag}, 0.0),");
            }
            Some(rocking) => {
                let [along, across, raised] = stick_model.nodes[rocking].inertia;
                let _ = writeln!(self.rocking, "    ({tag}, {across:?}, {along:?}),");
                for (direction, part) in LEANING.into_iter().zip(&directions) {
                    let stiffness = part.rotational_stiffness.filter(|_| !plan_base.rises);
                    let dashpot = part.rotational_damping;
                    let material = self.materials.elastic(stiffness.unwrap_or(0.0), dashpot);
                    all.push((direction, material));
                }
                match plan_base.rises {
                    true => {
                        let _ = writeln!(self.carried, "    ({middle}, {raised:?}, 0.0),");
                        if base.vertical_damping > 0.0 {
                            all.push((UP, self.materials.elastic(0.0, base.vertical_damping)));
                        }
                    }
                    false => {
                        holds = true;
                        all.push((UP, self.materials.elastic(held, 0.0)));
                    }
                }
                self.lean_floors(index, building, plan_base, &directions);
            }
        }
        if holds {
            self.remark("What a base in plan cannot do is held by springs of 1e9 1/s2 times the mass of the building.");
        }
        self.spring(ground, middle, &all, ProportionalDamping::None);
    }

    /// Lets floors of storeys lean with a base that rocks, and rise with it if it can lift off.
    fn lean_floors(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        plan_base: PlanBase,
        directions: &[AcrossBase; 2],
    ) {
        let Structure::Tiers(tiers) = &self.export.model.buildings[index].structure else {
            return;
        };
        if tiers.storeys.is_empty() && tiers.yielding.is_empty() {
            return;
        }
        let rocking = directions
            .iter()
            .filter_map(|part| part.rotational_stiffness);
        let stiffness = STIFF * rocking.fold(0.0, f64::max);
        let base = self.tag(index, plan_base.footing);
        let lumped = tiers.lumped_floors();
        let stick_model = &building.discretization.stick_model;
        for (number, node) in building.discretization.floors.iter().enumerate() {
            let material = self.materials.elastic(stiffness, 0.0);
            let element = self.element();
            let floor = self.tag(index, *node);
            let _ = writeln!(self.tilted, "    ({element}, {base}, {floor}, {material}),");
            // What rises with it where neither columns nor walls carry the floor.
            let height = stick_model.nodes[*node].y;
            let mut rising = stick_model.nodes.iter();
            let rising = rising.find(|rising| {
                rising.y == height
                    && rising.influence == [Influence::NONE, Influence::NONE, Influence::UP]
            });
            if let Some(Node { inertia, load, .. }) = rising.filter(|_| plan_base.rises) {
                let centre = lumped[number].tier.centre;
                let below = self.point(index, Some(plan_base.footing), centre);
                let _ = writeln!(self.carried, "    ({below}, {:?}, {load:?}),", inertia[2]);
            }
        }
        self.remark("Floors of storeys lean with a base that rocks by springs 1e6 times as stiff as its rocking.");
    }

    /// A spring between points of two floors, which lean if they stand on a base that rocks.
    pub(super) fn storey_spring(
        &mut self,
        building: &BuildingSystem,
        [first, last]: [usize; 2],
        directions: &[(usize, usize)],
        damped: ProportionalDamping,
    ) {
        let leans = building.discretization.stick_model.plan_base;
        if leans.is_none_or(|base| base.rocking.is_none()) {
            self.spring(first, last, directions, damped);
            return;
        }
        let usual = std::mem::take(&mut self.springs);
        self.spring(first, last, directions, damped);
        let row = std::mem::replace(&mut self.springs, usual);
        self.tilted_storeys.push_str(&row);
    }

    /// Contact springs under a base that can lift off; returns what its building says of them.
    pub(super) fn bed_in_plan(&mut self, index: usize, building: &BuildingSystem) -> String {
        let stick_model = &building.discretization.stick_model;
        let Some((plan_base, rocking)) = stick_model
            .plan_base
            .filter(|base| base.rises)
            .and_then(|base| Some((base, base.rocking?)))
        else {
            return String::new();
        };
        let mut points = Vec::new();
        for element in &stick_model.yielding {
            if element.hysteresis.rule() != HysteresisRule::Ground {
                continue;
            }
            let arm = |axis: usize| {
                let mut entries = element.row.entries().iter();
                let share = entries.find(|(place, _)| *place == COMPONENTS * rocking + axis);
                share.map_or(0.0, |(_, share)| -share)
            };
            let at: PlanPoint = [0, 1].map(|axis| plan_base.middle[axis] + arm(axis));
            let ground = self.point(index, None, at);
            let point = self.point(index, Some(plan_base.footing), at);
            let material = self.materials.ground(&element.hysteresis, false);
            self.spring(ground, point, &[(UP, material)], ProportionalDamping::None);
            points.push(point.to_string());
        }
        self.remark(GROUND);
        format!(", \"bed\": [{}]", points.join(", "))
    }

    /// Dashpots α m between every mass and the point of a mat or a base there, as it moves as a rigid body. What rises on bearings is
    /// damped relative to the ground.
    pub(super) fn damp_relative_to(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        base: usize,
        alpha: f64,
    ) {
        if alpha == 0.0 {
            return;
        }
        let discretization = &building.discretization;
        let stick_model = &discretization.stick_model;
        let isolated = discretization.mat.is_some();
        for (node, centre) in discretization.floors.iter().zip(&discretization.centres) {
            let floor = &stick_model.nodes[*node];
            let below = self.point_at(index, base, [centre[0], centre[1], floor.y], isolated);
            let last = self.tag(index, *node);
            let dashpots = DIRECTIONS.into_iter().zip(floor.inertia);
            let dashpots: Vec<(usize, usize)> = dashpots
                .map(|(direction, mass)| (direction, self.materials.elastic(0.0, alpha * mass)))
                .collect();
            self.spring(below, last, &dashpots, ProportionalDamping::None);
        }
        for mass in std::mem::take(&mut self.damped) {
            let [x, y, _] = mass.at;
            // Along the line of a frame, upwards, and in rotation about the axis across it.
            for (component, direction) in [1, UP, 5].into_iter().enumerate() {
                let inertia = mass.inertia[component];
                if inertia == 0.0 {
                    continue;
                }
                let below = match isolated && component != 0 {
                    true => self.point(index, None, [x, y]),
                    false => self.point_at(index, base, mass.at, isolated),
                };
                let material = self.materials.elastic(0.0, alpha * inertia);
                self.add_upright_spring(
                    [below, mass.tag],
                    mass.direction,
                    (direction, material),
                    ProportionalDamping::None,
                );
            }
        }
    }

    /// A point of a base at a height; on bearings the height does not matter.
    fn point_at(&mut self, index: usize, base: usize, at: [f64; 3], isolated: bool) -> usize {
        let [x, y, height] = at;
        let tag = self.point(index, Some(base), [x, y]);
        if !isolated {
            let _ = writeln!(self.raised, "    ({tag}, {:?}),", rounded(height));
        }
        tag
    }
}
