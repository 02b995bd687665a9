//! Buildings in one plane: nodes, members, hinges and storeys.

use std::collections::BTreeMap;
use std::fmt::Write;

use jostle::ProportionalDamping;
use jostle::hysteresis::{Hysteresis, HysteresisRule, SlidingStage};
use jostle::structure::{
    Discretization, Element, FrameDiagonal, Node, Part, Spring, StickModel, Support,
};
use jostle::system::BuildingSystem;

use super::arms::{self, Stiffness};
use super::foundation::{GROUND, Turning};
use super::panels::Panels;
use super::script::{Script, comment, python_bool, python_damping, rounded, text};
use super::ties::{COMPONENTS, ROTATION, Ties, is_held, is_vertical, stiffnesses};

/// Elastic stiffness of the stages of a bearing together, in units of that of the bearing \[–\].
const RIGID: f64 = 1e4;

impl Script<'_> {
    pub(super) fn add_building(
        &mut self,
        index: usize,
        building: &BuildingSystem,
    ) -> Result<(), &'static str> {
        let stick_model = &building.discretization.stick_model;
        let ties = Ties::new(stick_model);
        self.add_heading(building);
        self.add_nodes(index, building, &ties);
        self.add_members(index, stick_model);
        self.add_hinges(index, stick_model, &ties)?;
        self.add_fibres(index, building)?;
        self.add_arms(index, stick_model);
        self.add_sliding(index, building)?;
        self.add_storeys(index, building)?;
        self.add_diagonals(index, building)?;
        self.add_foundation(index, building, &ties);
        Ok(())
    }

    fn add_heading(&mut self, building: &BuildingSystem) {
        let title = format!("    # {}\n", comment(&building.name));
        for table in [
            &mut self.nodes,
            &mut self.supports,
            &mut self.held,
            &mut self.ties,
            &mut self.members,
            &mut self.rigid,
            &mut self.springs,
            &mut self.levered,
            &mut self.diagonals,
            &mut self.fibre_ends,
            &mut self.leaning,
            &mut self.carried,
        ] {
            table.push_str(&title);
        }
    }

    /// The row of a building, when all of its nodes are there.
    pub(super) fn add_row(&mut self, index: usize, building: &BuildingSystem) {
        let floors: Vec<String> = building
            .discretization
            .floors
            .iter()
            .map(|node| self.tag(index, *node).to_string())
            .collect();
        // Walls follow the buildings of the model, and have no weight.
        let of_model = self.export.model.buildings.get(index);
        let gravity = of_model.map_or_else(Default::default, |building| building.gravity);
        let equations = &building.equations;
        let foundation = building.discretization.stick_model.foundation.as_ref();
        // Dashpots do it where it acts on motion relative to something that moves.
        let alpha = match self.damps_by_dashpots(index, building) {
            true => 0.0,
            false => equations.alpha,
        };
        let _ = writeln!(
            self.buildings,
            "    {{\"name\": {}, \"nodes\": ({}, {}), \"floors\": [{}],\n     \"alpha\": {alpha:?}, \"beta\": {:?}, \"weight\": {}{}}},",
            text(&building.name),
            self.tag(index, 0),
            self.tag(index, self.next_point[index] - 1),
            floors.join(", "),
            equations.beta,
            python_bool(gravity.preload),
            foundation.map_or_else(String::new, |own| format!(
                ", \"foundation\": {}",
                self.tag(index, own.node)
            )) + &self.footings(index, building),
        );
    }

    /// Of every part that can lift off, the node and the distances of its outermost contact springs to the right of it.
    fn footings(&self, index: usize, building: &BuildingSystem) -> String {
        let sticks = &building.discretization.stick_model;
        let ground = sticks.yielding.iter();
        let ground = ground.filter(|element| element.hysteresis.rule() == HysteresisRule::Ground);
        let mut arms: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        for element in ground {
            let entries = element.row.entries();
            let Some(node) = entries.first().map(|(place, _)| place / COMPONENTS) else {
                continue;
            };
            let mut turned = entries
                .iter()
                .filter(|(place, _)| place % COMPONENTS == ROTATION);
            let arm = turned.next().map_or(0.0, |(_, arm)| *arm);
            let [least, most] = arms.entry(node).or_insert([arm; 2]);
            (*least, *most) = (least.min(arm), most.max(arm));
        }
        if arms.is_empty() {
            return String::new();
        }
        let rows = arms.into_iter().map(|(node, [least, most])| {
            format!("({}, {least:?}, {most:?})", self.tag(index, node))
        });
        format!(", \"footings\": [{}]", rows.collect::<Vec<_>>().join(", "))
    }

    fn add_nodes(&mut self, index: usize, building: &BuildingSystem, ties: &Ties) {
        let stick_model = &building.discretization.stick_model;
        for (number, node) in stick_model.nodes.iter().enumerate() {
            let tag = self.tag(index, number);
            // Fixed nodes need no mass.
            let mass = if node.support == Support::Fixed {
                0.0
            } else {
                node.inertia[0]
            };
            let _ = writeln!(
                self.nodes,
                "    ({tag}, {:?}, {:?}, {mass:?}, {:?}),",
                rounded(node.x + self.places[index]),
                rounded(node.y + building.discretization.elevation),
                node.inertia[2],
            );
            let fixed: Vec<&str> = (0..COMPONENTS)
                .map(|component| {
                    if is_held(stick_model, number, component) {
                        "1"
                    } else {
                        "0"
                    }
                })
                .collect();
            if node.load != 0.0 {
                let _ = writeln!(self.carried, "    ({tag}, 0.0, {:?}),", node.load);
            }
            if fixed.contains(&"1") {
                let _ = writeln!(self.supports, "    ({tag}, {}),", fixed.join(", "));
            }
        }
        for (node, component) in &ties.held {
            let _ = writeln!(
                self.held,
                "    ({}, {}),",
                self.tag(index, *node),
                component + 1
            );
        }
        for (first, other, components) in &ties.followed {
            let components: Vec<String> = components.iter().map(|c| (c + 1).to_string()).collect();
            let _ = writeln!(
                self.ties,
                "    ({}, {}, {}),",
                self.tag(index, *first),
                self.tag(index, *other),
                components.join(", ")
            );
        }
    }

    fn add_members(&mut self, index: usize, stick_model: &StickModel) {
        for member in &stick_model.members {
            let tag = self.element();
            let [mut a, mut b] = member.ends;
            let vertical = is_vertical(stick_model, member.ends);
            let along = |node: usize| {
                if vertical {
                    stick_model.nodes[node].y
                } else {
                    stick_model.nodes[node].x
                }
            };
            if along(a) > along(b) {
                (a, b) = (b, a);
            }
            let optional = |value: Option<f64>| {
                value.map_or_else(|| "None".to_owned(), |value| format!("{value:?}"))
            };
            let (first, last) = (self.tag(index, a), self.tag(index, b));
            let _ = writeln!(
                self.members,
                "    ({tag}, {first}, {last}, {:?}, {}, {}),",
                member.flexural_rigidity,
                optional(member.axial_rigidity),
                optional(member.shear_rigidity),
            );
            if member.compression != 0.0 {
                let stiffness = -member.compression / (along(b) - along(a));
                self.lean(first, last, stiffness);
            }
        }
    }

    /// A spring of negative stiffness between the horizontal displacements of two nodes.
    fn lean(&mut self, first: usize, last: usize, stiffness: f64) {
        let tag = self.element();
        let material = self.materials.elastic(stiffness, 0.0);
        let _ = writeln!(self.leaning, "    ({tag}, {first}, {last}, {material}),");
    }

    fn add_hinges(
        &mut self,
        index: usize,
        stick_model: &StickModel,
        ties: &Ties,
    ) -> Result<(), &'static str> {
        for hinge in &stick_model.hinges {
            let ends = hinge.ends;
            // Strain is that of the second node against the first; the rotation of a hinge counts the other way.
            let (first, last) = (self.tag(index, ends[1]), self.tag(index, ends[0]));
            let mut directions = Vec::new();
            for (component, stiffness) in stiffnesses(hinge).into_iter().enumerate() {
                let direction = [1, 2, 6][component];
                let Some(stiffness) = stiffness else {
                    let tag = self.element();
                    let tied = python_bool(ties.are_tied(ends, component));
                    let _ = writeln!(
                        self.rigid,
                        "    ({tag}, {first}, {last}, {direction}, {tied}),"
                    );
                    continue;
                };
                let hysteresis = hinge.hysteresis.as_ref().filter(|_| component == 2);
                for material in
                    self.spring_materials(stiffness, hysteresis, hinge.dashpots[component])?
                {
                    directions.push((direction, material));
                }
            }
            self.spring(first, last, &directions, hinge.proportional_damping);
        }
        Ok(())
    }

    /// What stands at the end of a rigid arm of a joint: faces of walls, and ends of columns that are rigid inside their joints.
    fn add_arms(&mut self, index: usize, stick_model: &StickModel) {
        for hinge in &stick_model.hinges {
            let [joint, end] = hinge.ends;
            let turns_with = hinge.rotational_stiffness.is_none();
            let tied = [0, 1].map(|component| {
                let free = hinge.translational_stiffness[component] == Some(0.0);
                free && stick_model
                    .ties
                    .contains_key(&(COMPONENTS * end + component))
            });
            if turns_with && tied.contains(&true) {
                let ends = [joint, end].map(|node| self.tag(index, node));
                let stiff = Stiffness::of_arm(stick_model, hinge).bending;
                let material = self.materials.elastic(stiff, 0.0);
                self.lever(ends, material, Turning::First, ProportionalDamping::None);
                self.remark(arms::REMARK);
            }
        }
    }

    /// Walls that slide at their feet, and coupling beams that yield in shear.
    fn add_sliding(&mut self, index: usize, building: &BuildingSystem) -> Result<(), &'static str> {
        let Discretization {
            stick_model,
            sections,
            ..
        } = &building.discretization;
        for (number, element) in stick_model.yielding.iter().enumerate() {
            let of_fibres = sections.iter();
            let mut of_fibres = of_fibres.filter(|section| !section.is_surface());
            if of_fibres.any(|section| section.elements.contains(&number)) {
                continue;
            }
            // Under a foundation it comes with this.
            if element.hysteresis.rule() == HysteresisRule::Ground {
                let ([(foot, _)], None) = (element.row.entries(), &stick_model.foundation) else {
                    continue;
                };
                let Node { x, y, .. } = stick_model.nodes[foot / COMPONENTS];
                let ground = self.ground_point(index, [x, y]);
                let material = self.materials.ground(&element.hysteresis, false);
                let last = self.tag(index, foot / COMPONENTS);
                let damped = ProportionalDamping::None;
                self.spring(ground, last, &[(2, material)], damped);
                self.remark(GROUND);
                continue;
            }
            let [(a, share), (b, _)] = *element.row.entries() else {
                continue;
            };
            let [first, last] = if share < 0.0 { [a, b] } else { [b, a] };
            let nodes = [first, last].map(|place| self.tag(index, place / COMPONENTS));
            let material = self.materials.yielding(&element.hysteresis)?;
            let direction = first % COMPONENTS + 1;
            let damped = element.proportional_damping;
            self.spring(nodes[0], nodes[1], &[(direction, material)], damped);
        }
        Ok(())
    }

    fn add_storeys(&mut self, index: usize, building: &BuildingSystem) -> Result<(), &'static str> {
        let Discretization {
            stick_model,
            diagonals,
            ..
        } = &building.discretization;
        for spring in &stick_model.springs {
            let [first, last] = spring.ends.map(|node| self.tag(index, node));
            if stick_model.foundation.is_some() && spring.lever.is_some_and(|lever| lever != 0.0) {
                self.add_storey_on_foundation([first, last], spring)?;
            } else {
                self.add_storey(index, [first, last], spring)?;
            }
            if spring.softening != 0.0 {
                self.lean(first, last, -spring.softening);
            }
        }
        // On a foundation they are damping relative to it.
        let on_foundation = stick_model.foundation.is_some();
        let is_diagonal = |element: &&Element| match element {
            Element::Spring { row, .. } => {
                diagonals.iter().any(|diagonal| diagonal.elongation == *row)
            }
            Element::Matrix { .. } => false,
        };
        let elements = stick_model.elements.iter();
        let elements = elements.filter(|element| !on_foundation && !is_diagonal(element));
        for element in elements {
            let between = match element {
                Element::Spring {
                    part,
                    stiffness,
                    row,
                } => match *row.entries() {
                    [(first, 1.0), (last, -1.0)] if first % 3 == 0 && last % 3 == 0 => {
                        Some((*part, *stiffness, [first / 3, last / 3]))
                    }
                    // A rigid end of a column leans as a whole by the rotation of its joint.
                    [(turned, 1.0)] if turned % 3 == 2 => {
                        let joint = turned / 3;
                        let Node { x, y, .. } = stick_model.nodes[joint];
                        let ground = self.ground_point(index, [x, y]);
                        let material = self.materials.elastic(*stiffness, 0.0);
                        let last = self.tag(index, joint);
                        self.spring(ground, last, &[(6, material)], ProportionalDamping::None);
                        continue;
                    }
                    _ => None,
                },
                Element::Matrix { .. } => None,
            };
            let Some((part, value, ends)) = between else {
                return Err(
                    "has matrices with rotations or vertical displacements, between which OpenSees has no springs; export the model they came from",
                );
            };
            let [first, last] = ends.map(|node| self.tag(index, node));
            let ([stiffness, dashpot], damped) = match part {
                Part::Elastic => ([value, 0.0], ProportionalDamping::Initial),
                Part::Undamped => ([value, 0.0], ProportionalDamping::None),
                Part::Dashpot => ([0.0, value], ProportionalDamping::None),
            };
            let materials = self.spring_materials(stiffness, None, dashpot)?;
            let directions: Vec<(usize, usize)> = materials
                .into_iter()
                .map(|material| (1, material))
                .collect();
            self.spring(first, last, &directions, damped);
        }
        Ok(())
    }

    /// Braces and struts, along the lines between their joints.
    fn add_diagonals(
        &mut self,
        index: usize,
        building: &BuildingSystem,
    ) -> Result<(), &'static str> {
        let mut panels = Panels::default();
        let stick_model = &building.discretization.stick_model;
        for diagonal in &building.discretization.diagonals {
            let ends = diagonal.ends.map(|node| self.tag(index, node));
            let first = self.next_element;
            self.add_diagonal(stick_model, diagonal, ends)?;
            panels.add(diagonal, first..self.next_element);
        }
        self.add_panels(index, building, panels);
        Ok(())
    }

    /// A brace or a strut between two joints.
    pub(super) fn add_diagonal(
        &mut self,
        stick_model: &StickModel,
        diagonal: &FrameDiagonal,
        [first, last]: [usize; 2],
    ) -> Result<(), &'static str> {
        let hysteresis = diagonal.spring.as_ref();
        let mut yielding = stick_model.yielding.iter();
        let damped = match hysteresis {
            None => ProportionalDamping::Initial,
            Some(own) => {
                yielding
                    .find(|one| one.row == diagonal.elongation && one.hysteresis == *own)
                    .ok_or("has a brace or strut without a spring")?
                    .proportional_damping
            }
        };
        let damped = python_damping(damped);
        for material in self.spring_materials(diagonal.stiffness, hysteresis, 0.0)? {
            let tag = self.element();
            let _ = writeln!(
                self.diagonals,
                "    ({tag}, {first}, {last}, {material}, {damped}),"
            );
        }
        Ok(())
    }

    /// A bearing with several sliding surfaces: its stages one above the other, between nodes of their own. Of a stage with friction f, a
    /// bowl k and an elastic spring R, parallel springs of R − k′ that yield at f/R and of k′ = kR/(k + R) have the force F = R (u − s)
    /// with |F − ks| ≤ f; the elastic springs of all stages and one beside them make up that of the bearing.
    fn add_pendulums(
        &mut self,
        index: usize,
        [first, last]: [usize; 2],
        elastic: f64,
        stages: &[SlidingStage],
    ) {
        let stages = stages.iter().filter(|stage| **stage != SlidingStage::STILL);
        let stages: Vec<&SlidingStage> = stages.collect();
        let own = RIGID * stages.len() as f64 * elastic;
        let mut below = first;
        for SlidingStage {
            friction,
            stiffness,
            travel,
        } in stages
        {
            let above = self.plane_point(index, [0.0; 2]);
            let _ = writeln!(self.supports, "    ({above}, 0, 1, 1),");
            let bowl = stiffness * own / (stiffness + own);
            let (slips, rigid) = (friction / own, own - bowl);
            let mut parts = vec![
                self.materials.slider(rigid, slips),
                self.materials.elastic(bowl, 0.0),
            ];
            if travel.is_finite() {
                let rim = travel + (friction + stiffness * travel) / own;
                parts.extend([1.0, -1.0].map(|sign| self.materials.gap(rigid, rim, sign)));
                self.remark("At the rims of sliding surfaces the springs of a bearing unload by up to 1/20000 of its elastic deformation less than in jostle.");
            }
            let parts: Vec<(usize, usize)> = parts.into_iter().map(|part| (1, part)).collect();
            self.spring(below, above, &parts, ProportionalDamping::None);
            below = above;
        }
        let rest = self.materials.elastic(elastic * RIGID / (RIGID - 1.0), 0.0);
        self.spring(below, last, &[(1, rest)], ProportionalDamping::None);
    }

    fn add_storey(
        &mut self,
        index: usize,
        [first, last]: [usize; 2],
        spring: &Spring,
    ) -> Result<(), &'static str> {
        if let Some(hysteresis) = &spring.hysteresis
            && let HysteresisRule::Pendulums(stages) = hysteresis.rule()
        {
            let elastic = hysteresis.backbone().initial();
            self.add_pendulums(index, [first, last], elastic, &stages);
            if spring.dashpot != 0.0 {
                let material = self.materials.elastic(0.0, spring.dashpot);
                self.spring(first, last, &[(1, material)], ProportionalDamping::None);
            }
            return Ok(());
        }
        let materials =
            self.spring_materials(spring.stiffness, spring.hysteresis.as_ref(), spring.dashpot)?;
        let directions: Vec<(usize, usize)> = materials
            .into_iter()
            .map(|material| (1, material))
            .collect();
        self.spring(first, last, &directions, spring.proportional_damping);
        Ok(())
    }

    /// Parallel elements: a spring, elastic or not, and a dashpot.
    pub(super) fn spring_materials(
        &mut self,
        stiffness: f64,
        hysteresis: Option<&Hysteresis>,
        dashpot: f64,
    ) -> Result<Vec<usize>, &'static str> {
        let mut materials = Vec::new();
        match hysteresis {
            Some(hysteresis) => {
                materials.push(self.materials.yielding(hysteresis)?);
                if dashpot != 0.0 {
                    materials.push(self.materials.elastic(0.0, dashpot));
                }
            }
            None if stiffness != 0.0 || dashpot != 0.0 => {
                materials.push(self.materials.elastic(stiffness, dashpot));
            }
            None => {}
        }
        Ok(materials)
    }

    /// A spring between two points, by its directions and their materials: nothing without any.
    pub(super) fn spring(
        &mut self,
        first: usize,
        last: usize,
        directions: &[(usize, usize)],
        damped: ProportionalDamping,
    ) {
        if directions.is_empty() {
            return;
        }
        let tag = self.element();
        let pairs: Vec<String> = directions
            .iter()
            .map(|(direction, material)| format!("({direction}, {material}),"))
            .collect();
        let _ = writeln!(
            self.springs,
            "    ({tag}, {first}, {last}, ({}), {}),",
            pairs.join(" "),
            python_damping(damped)
        );
    }
}
