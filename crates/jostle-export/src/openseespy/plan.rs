//! Buildings in space: floors as nodes of a model in the plan of the site.
//!
//! OpenSees' plane model with three displacements a node is that of rigid floors seen from above: x and y are the site, the
//! rotation is about the vertical axis. A plane model needs no diaphragms and none of the three idle displacements of a
//! node in space. A node stands at the centre of mass of every floor. Points of a floor are nodes that `rigidLink` ties to it;
//! springs of storeys join two of them at the centre of stiffness, contacts two of them at the contact point.
//!
//! A mat on bearings is another such floor. Bearings join points of it to points that stand still; their friction and lead is a
//! `zeroLengthSection` with the section `Bidirectional`, whose force is bounded in every direction together.
//!
//! Space frames make it a model in space: their joints are tied to the nodes of floors by `rigidDiaphragm`; see `space_frame`.

use std::fmt::Write;

use jostle::interface::Port;
use jostle::structure::{Influence, Mat, Node};
use jostle::system::BuildingSystem;
use jostle::{MassDamping, ModelFault, PlanPoint, ProportionalDamping, Structure, TierStorey};

use super::plan_base::HELD;
use super::plan_frames::slides_on_rocking_base;
use super::script::{Script, comment, python_bool, rounded, text};

/// Directions of OpenSees: along x, across, rotation.
pub(super) const DIRECTIONS: [usize; 3] = [1, 2, 6];

/// Mass of a floor, or those along x and across where they differ: columns between floors of a plane frame move by themselves along it.
pub(super) fn masses(floor: &Node) -> String {
    let [x, y, _] = floor.inertia;
    if x == y {
        format!("{x:?}")
    } else {
        format!("({x:?}, {y:?})")
    }
}

impl Script<'_> {
    /// Floors, storeys and P-Delta of a building in space.
    pub(super) fn add_plan_building(
        &mut self,
        index: usize,
        building: &BuildingSystem,
    ) -> Result<(), ModelFault> {
        let refuse = |key: &str, problem: &str| {
            Err(ModelFault {
                path: format!("building[{index}]{key}"),
                problem: problem.to_owned(),
            })
        };
        let model_building = &self.export.model.buildings[index];
        let Structure::Tiers(tiers) = &model_building.structure else {
            return refuse("", "has no floors in plan that can be exported");
        };
        if tiers.matrices.is_some() {
            return refuse(
                ".matrices",
                "of floors in plan couple displacements and rotations of any two floors, between which OpenSees has no springs; write --to matrices, or export the model from which they come",
            );
        }
        if !building.discretization.points.is_empty() {
            return refuse(
                "",
                "has columns that a neighbour can hit between floors, or that struts meet there; the script writes every column of a building with a plan as one element between two joints: list pairs of floors at equal height, and leave offset and struts out",
            );
        }
        if slides_on_rocking_base(&building.discretization.stick_model) {
            return refuse(
                ".frame",
                "has feet that slide (shear_hinge of walls, shear_failure of columns) on a base that rocks: the constraints of the script let a foot follow such a base in all directions or in none; leave them out, or let the base only sway",
            );
        }
        let title = format!("    # {}\n", comment(&building.name));
        for table in [
            &mut self.nodes,
            &mut self.supports,
            &mut self.arms,
            &mut self.springs,
            &mut self.sliders,
            &mut self.levels,
            &mut self.fibre_ends,
            &mut self.carried,
            &mut self.space_joints,
            &mut self.space_members,
            &mut self.rigid_ends,
            &mut self.upright,
            &mut self.upright_springs,
            &mut self.rocking,
            &mut self.tilted,
            &mut self.tilted_storeys,
            &mut self.riding,
            &mut self.raised,
        ] {
            table.push_str(&title);
        }
        let lumped = tiers.lumped_floors();
        let floors = &building.discretization.floors;
        let isolated = model_building
            .base
            .isolation
            .zip(building.discretization.mat);
        let mat = isolated.map(|(isolation, _)| tiers.mat(isolation.mat_mass));
        let plan_base = building.discretization.stick_model.plan_base;
        let foot = isolated.map(|(_, mat)| mat.node);
        let foot = foot.or(plan_base.map(|base| base.footing));
        self.damped.clear();
        if let Some(base) = plan_base {
            self.add_base_in_plan(index, building, base);
        }
        let foot_of_mat = mat.as_ref().and(foot);
        let moving = mat
            .iter()
            .zip(&foot_of_mat)
            .chain(lumped.iter().zip(floors));
        for (floor, node) in moving {
            let tag = self.tag(index, *node);
            let [x, y] = floor.tier.centre.map(rounded);
            let _ = writeln!(
                self.nodes,
                "    ({tag}, {x:?}, {y:?}, {}, {:?}),",
                masses(&building.discretization.stick_model.nodes[*node]),
                floor.tier.polar_mass
            );
            let height = rounded(building.discretization.stick_model.nodes[*node].y);
            let _ = writeln!(self.levels, "    ({tag}, {height:?}),");
        }
        for storey in 0..lumped.len() {
            if let Some(springs) = tiers.storeys.get(storey) {
                self.add_storey_in_plan(
                    index,
                    building,
                    storey,
                    springs,
                    ProportionalDamping::Initial,
                );
            }
            let yielding = tiers.yielding.iter();
            for spring in yielding.filter(|spring| spring.storey == storey) {
                let Ok(material) = self.materials.yielding(&spring.hysteresis) else {
                    let (key, rule) = match spring.element {
                        Some(element) => (format!(".element[{element}]"), spring.hysteresis.rule()),
                        None => (String::new(), spring.hysteresis.rule()),
                    };
                    return refuse(
                        &format!("{key}.hinges.rule"),
                        &format!(
                            "OpenSees has no rule \"{}\"; normal, bilinear, peak-oriented and pinched can be exported",
                            rule.name()
                        ),
                    );
                };
                let lower = storey
                    .checked_sub(1)
                    .map_or(foot, |below| Some(floors[below]));
                let first = self.point(index, lower, spring.at);
                let last = self.point(index, Some(floors[storey]), spring.at);
                let directions = [(DIRECTIONS[spring.axis.index()], material)];
                let damped = model_building.yielding_damping.unwrap_or_default();
                self.storey_spring(building, [first, last], &directions, damped);
            }
            if model_building.gravity.p_delta {
                let mut springs = tiers.softening(&lumped, storey);
                springs.stiffness = springs.stiffness.map(|stiffness| -stiffness);
                self.add_storey_in_plan(
                    index,
                    building,
                    storey,
                    &springs,
                    ProportionalDamping::None,
                );
            }
        }
        if let Some(frame) = &tiers.space_frame {
            let added = self.add_space_frame(index, building, frame, &tiers.storey_heights);
            if let Err(rule) = added {
                return refuse(
                    ".hinges.rule",
                    &format!(
                        "OpenSees has no rule \"{rule}\"; normal, bilinear, peak-oriented and pinched can be exported"
                    ),
                );
            }
        }
        if !tiers.frames.is_empty()
            && let Err(problem) = self.add_plan_frames(index, building, tiers)
        {
            return refuse(
                ".frame.hinges.rule",
                &format!(
                    "OpenSees has no rule \"{problem}\"; normal, bilinear, peak-oriented and pinched can be exported"
                ),
            );
        }
        let mut alpha = building.equations.alpha;
        if let Some((_, on_mat)) = isolated {
            self.add_bearings(index, building, on_mat);
            let alpha = std::mem::take(&mut alpha);
            self.damp_relative_to(index, building, on_mat.node, alpha);
        } else if let Some(base) = plan_base
            && building.foundation_in_plan.is_some()
            && model_building.mass_damping == MassDamping::Support
        {
            let alpha = std::mem::take(&mut alpha);
            self.damp_relative_to(index, building, base.footing, alpha);
        }
        let bed = self.bed_in_plan(index, building);
        let tags: Vec<String> = foot_of_mat
            .iter()
            .chain(floors)
            .map(|node| self.tag(index, *node).to_string())
            .collect();
        let _ = writeln!(
            self.buildings,
            "    {{\"name\": {}, \"nodes\": ({}, {}), \"floors\": [{}], \"has_mat\": {},\n     \"alpha\": {:?}, \"beta\": {:?}, \"weight\": {}{}}},",
            text(&building.name),
            self.tag(index, foot.unwrap_or(floors[0])),
            self.tag(index, self.next_point[index] - 1),
            tags.join(", "),
            python_bool(foot_of_mat.is_some()),
            alpha,
            building.equations.beta,
            python_bool(model_building.gravity.preload),
            bed,
        );
        Ok(())
    }

    /// Three springs between two floors, at one point.
    fn add_storey_in_plan(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        storey: usize,
        springs: &TierStorey,
        damped: ProportionalDamping,
    ) {
        let floors = &building.discretization.floors;
        let foot = building.discretization.mat.map(|mat| mat.node);
        let plan_base = building.discretization.stick_model.plan_base;
        let foot = foot.or(plan_base.map(|base| base.footing));
        let lower = storey
            .checked_sub(1)
            .map_or(foot, |below| Some(floors[below]));
        let first = self.point(index, lower, springs.centre);
        let last = self.point(index, Some(floors[storey]), springs.centre);
        let directions: Vec<(usize, usize)> = DIRECTIONS
            .into_iter()
            .zip(springs.stiffness)
            .filter(|(_, stiffness)| *stiffness != 0.0)
            .map(|(direction, stiffness)| (direction, self.materials.elastic(stiffness, 0.0)))
            .collect();
        // P-Delta acts on displacements alone.
        match damped {
            _ if directions.is_empty() => {}
            ProportionalDamping::None => self.spring(first, last, &directions, damped),
            _ => self.storey_spring(building, [first, last], &directions, damped),
        }
    }

    /// Bearings between points of the mat and of the ground: springs and dashpots, and what yields or slides.
    fn add_bearings(&mut self, index: usize, building: &BuildingSystem, mat: Mat) {
        let Some(plan_mat) = &building.discretization.stick_model.plan_mat else {
            return;
        };
        let share = 1.0 / plan_mat.bearings.len() as f64;
        for at in &plan_mat.bearings {
            let ground = self.point(index, None, *at);
            let above = self.point(index, Some(mat.node), *at);
            let (stiffness, dashpot) = (share * mat.stiffness, share * mat.dashpot);
            if stiffness != 0.0 || dashpot != 0.0 {
                let material = self.materials.elastic(stiffness, dashpot);
                let both = [DIRECTIONS[0], DIRECTIONS[1]].map(|direction| (direction, material));
                self.spring(ground, above, &both, ProportionalDamping::None);
            }
            if let Some([along_x, ..]) = plan_mat.slider {
                let curve = along_x.backbone();
                let element = self.element();
                let _ = writeln!(
                    self.sliders,
                    "    ({element}, {ground}, {above}, {:?}, {:?}),",
                    curve.initial(),
                    curve.yield_force(),
                );
                self.remark("Bearings that yield or slide are OpenSees' section Bidirectional, which returns to its circle along the radius: its force turns with an error of the first order in the step.");
            }
        }
    }

    /// A node at a point of the plan that moves with a floor, or stands still.
    pub(super) fn point(&mut self, index: usize, floor: Option<usize>, at: PlanPoint) -> usize {
        let tag = self.tag(index, self.next_point[index]);
        self.next_point[index] += 1;
        let [x, y] = at.map(rounded);
        let _ = writeln!(self.nodes, "    ({tag}, {x:?}, {y:?}, 0.0, 0.0),");
        match floor {
            Some(node) => {
                let kept = self.tag(index, node);
                let _ = writeln!(self.arms, "    ({kept}, {tag}),");
            }
            None => {
                let _ = writeln!(self.supports, "    ({tag}, 1, 1, 1),");
            }
        }
        tag
    }

    /// Contacts at points of faces and at corners.
    pub(super) fn add_plan_contacts(&mut self, faults: &mut Vec<ModelFault>) {
        let system = self.export.system;
        for table in [&mut self.nodes, &mut self.supports, &mut self.arms] {
            table.push_str("    # contact points\n");
        }
        for (index, contact) in system.contacts.iter().enumerate() {
            let path = format!("gap[{}]", contact.gap);
            let mut refuse = |key: &str, problem: &str| {
                let path = format!("{path}.{key}");
                if !faults.iter().any(|fault| fault.path == path) {
                    faults.push(ModelFault {
                        path,
                        problem: problem.to_owned(),
                    });
                }
            };
            let Some(plan) = contact.plan else { continue };
            if contact.friction.is_some() {
                refuse(
                    "friction",
                    "is not exported: the contact materials of OpenSees act along the normal alone; leave it out to compare contacts without friction",
                );
            }
            let (material, remark) = match self.materials.contact(contact) {
                Ok(found) => found,
                Err(problem) => {
                    refuse("law", problem);
                    continue;
                }
            };
            if let Some(remark) = remark {
                self.remark(remark);
            }
            if contact.width == 0.0 {
                self.remark("OpenSees needs a gap: sides that touch at rest are 1e-12 m apart.");
            }
            let [a, b] = contact
                .ports
                .0
                .each_ref()
                .map(|port| self.contact_point(port.as_ref(), plan.at));
            let tag = self.element();
            let floors = contact
                .ports
                .floors()
                .map(|floor| floor.map_or_else(|| "None".to_owned(), |floor| floor.to_string()));
            let _ = writeln!(
                self.contacts,
                "    ({tag}, {a}, {b}, {material}, {:?}, {}, ({}, {}), {:?}),",
                contact.width,
                contact.gap,
                floors[0],
                floors[1],
                rounded(contact.height),
            );
            let _ = writeln!(
                self.faces,
                "    ({tag}, {}, \"{}\", {:?}, {:?}, {:?}, {:?}),",
                plan.face,
                plan.kind.name(),
                plan.normal[0],
                plan.normal[1],
                rounded(plan.at[0]),
                rounded(plan.at[1]),
            );
            self.add_ends(index, tag);
        }
    }

    /// Links and dampers between points of floors.
    pub(super) fn add_plan_links(&mut self, faults: &mut Vec<ModelFault>) {
        let system = self.export.system;
        for link in system.model_links() {
            let path = format!("link[{}]", link.link);
            let Some(at) = self.export.model.links[link.link].at else {
                continue;
            };
            let ports = link.ports.0.each_ref();
            let base = link
                .ports
                .0
                .iter()
                .flatten()
                .next()
                .map(|port| port.building);
            let base = base.and_then(|building| {
                let discretization = &system.buildings[building].discretization;
                discretization.stick_model.plan_base
            });
            if link.inside && base.is_some_and(|base| base.rocking.is_some()) {
                faults.push(ModelFault {
                    path: format!("{path}.between"),
                    problem: "joins floors of a building whose base rocks; the rocking does not deform it, but a spring of OpenSees between two points has all of their motion: leave it out, or take a base that does not rock, to compare".to_owned(),
                });
                continue;
            }
            let Some(material) = self.link_material(link, false, &path, faults) else {
                continue;
            };
            let ends = [0, 1].map(|side| self.contact_point(ports[side].as_ref(), at[side]));
            let tag = self.element();
            let floors = link
                .ports
                .floors()
                .map(|floor| floor.map_or_else(|| "None".to_owned(), |floor| floor.to_string()));
            let _ = writeln!(
                self.links,
                "    ({tag}, {}, {}, {material}, {}, ({}, {}), {:?}, False),",
                ends[0],
                ends[1],
                link.link,
                floors[0],
                floors[1],
                rounded(link.height),
            );
            let [x, y] = [0, 1].map(|axis| at[1][axis] - at[0][axis]);
            let length = (x * x + y * y).sqrt();
            let _ = writeln!(
                self.directions,
                "    ({tag}, {:?}, {:?}),",
                x / length,
                y / length
            );
        }
    }

    /// A wall on the site that gives way along its normal: a mass on a spring and a dashpot.
    pub(super) fn add_wall_in_plan(&mut self, index: usize, building: &BuildingSystem) {
        let sticks = &building.discretization.stick_model;
        let (Some(node), Some(spring)) = (
            building.discretization.floors.first(),
            sticks.springs.first(),
        ) else {
            return;
        };
        let Influence { along, across, .. } = sticks.nodes[*node].influence[0];
        let mass = sticks.nodes[*node].inertia[0];
        let tag = self.tag(index, *node);
        let _ = writeln!(
            self.nodes,
            "    # {}\n    ({tag}, 0.0, 0.0, {mass:?}, 0.0),",
            comment(&building.name)
        );
        let _ = writeln!(self.levels, "    ({tag}, 0.0),");
        let ground = self.point(index, None, [0.0; 2]);
        let held = self.materials.elastic(HELD * mass + spring.stiffness, 0.0);
        let material = self.materials.elastic(spring.stiffness, spring.dashpot);
        for (direction, material) in [(1, material), (2, held), (6, held)] {
            let none = ProportionalDamping::None;
            self.add_upright_spring([ground, tag], [along, across], (direction, material), none);
        }
        self.remark("A wall that gives way is held along its face and in rotation by springs of 1e9 1/s2 times its mass.");
        let _ = writeln!(
            self.buildings,
            "    {{\"name\": {}, \"nodes\": ({tag}, {}), \"floors\": [{tag}], \"alpha\": 0.0, \"beta\": 0.0, \"weight\": False}},",
            text(&building.name),
            self.tag(index, self.next_point[index] - 1),
        );
    }

    fn contact_point(&mut self, port: Option<&Port>, at: PlanPoint) -> usize {
        let walls = self.export.model.buildings.len();
        let (building, floor) = match port {
            // Points of walls stand still; any building numbers them.
            None => (0, None),
            Some(port) if port.building >= walls => {
                let wall = &self.export.system.buildings[port.building].discretization;
                (port.building, wall.floors.first().copied())
            }
            Some(port) => {
                let floor = port.floor.map(|floor| self.level(port.building, floor));
                (port.building, floor)
            }
        };
        self.point(building, floor, at)
    }

    /// Node of a floor; 0 is the mat.
    fn level(&self, building: usize, floor: usize) -> usize {
        let discretization = &self.export.system.buildings[building].discretization;
        let base = discretization.stick_model.plan_base;
        let mat = discretization.mat.map(|mat| mat.node);
        let mat = mat.or(base.map(|base| base.footing)).unwrap_or(0);
        floor
            .checked_sub(1)
            .map_or(mat, |index| discretization.floors[index])
    }

    /// Ends of the edge beyond which a corner touches nothing.
    fn add_ends(&mut self, index: usize, tag: usize) {
        let system = self.export.system;
        for end in system.edge_ends.iter().filter(|end| end.contact == index) {
            let sides = end.ports.0.each_ref().map(|port| {
                let Some(port) = port else {
                    return "None".to_owned();
                };
                let node = self.level(port.building, port.floor.unwrap_or(1));
                let shares: Vec<String> = port
                    .row
                    .entries()
                    .iter()
                    .map(|(_, share)| format!("{share:?}"))
                    .collect();
                format!("({}, {})", self.tag(port.building, node), shares.join(", "))
            });
            let _ = writeln!(
                self.ends,
                "    ({tag}, {}, {}, {:?}),",
                sides[0], sides[1], end.inside
            );
        }
    }
}
