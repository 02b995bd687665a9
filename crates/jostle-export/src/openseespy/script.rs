//! The tables of a script.

use std::fmt::Write;

use jostle::hysteresis::Hysteresis;
use jostle::interface::Port;
use jostle::statics::STANDARD_GRAVITY;
use jostle::structure::{StickModel, Support};
use jostle::system::BuildingSystem;
use jostle::{GroundMotion, ModelFault, Wave};

use super::materials::Materials;
use super::space_frame::joints_of;
use super::ties::{COMPONENTS, Ties, is_held_by, is_vertical, stiffnesses};
use crate::Export;

/// Free-vibration step that is tried first \[s\]; the record may require a shorter one.
const FREE_STEP: f64 = 2e-3;
/// Parts of it while contacts are closed \[–\].
const PARTS_IN_CONTACT: usize = 10;
/// Heights closer than this are the same \[m\].
const SAME_LEVEL: f64 = 1e-3;

/// A script in the making: one table after the other.
pub(super) struct Script<'a> {
    pub(super) export: &'a Export<'a>,
    pub(super) materials: Materials,
    remarks: Vec<String>,
    /// Distance of every building from the left end of the first, so that faces coincide \[m\].
    places: Vec<f64>,
    /// Numbers from which the nodes of a building count.
    block: usize,
    next_element: usize,
    pub(super) buildings: String,
    pub(super) nodes: String,
    pub(super) supports: String,
    held: String,
    ties: String,
    members: String,
    rigid: String,
    pub(super) springs: String,
    /// Bearings in plan that yield or slide.
    pub(super) sliders: String,
    leaning: String,
    pub(super) contacts: String,
    links: String,
    /// Of every building, the next node at a point of the plan.
    pub(super) next_point: Vec<usize>,
    pub(super) arms: String,
    pub(super) faces: String,
    pub(super) ends: String,
    /// Joints of space frames, and their columns and beams.
    pub(super) space_joints: String,
    pub(super) space_members: String,
    pub(super) space_hinges: String,
    /// Heights of floors in plan.
    pub(super) levels: String,
}

impl<'a> Script<'a> {
    pub(super) fn new(export: &'a Export<'a>) -> Result<Self, Vec<ModelFault>> {
        let in_plan = export.system.is_in_space();
        let joints: Vec<usize> = export.model.buildings.iter().map(joints_of).collect();
        let largest = export
            .system
            .buildings
            .iter()
            .enumerate()
            .map(|(index, building)| {
                let joints = joints.get(index).unwrap_or(&0);
                let nodes = building.discretization.stick_model.nodes.len() + joints;
                // Two points of every storey, twice with P-Delta, both of every contact and bearing, and one of the mat below every floor.
                let mat = building.mat_in_plan.as_ref();
                let bearings = mat.map_or(0, |mat| mat.bearings.len());
                let points =
                    5 * building.floors.len() + 2 * (export.system.contacts.len() + bearings);
                nodes + if in_plan { points } else { 0 }
            });
        let mut block = 1000;
        while block <= largest.clone().max().unwrap_or(0) {
            block *= 10;
        }
        let mut script = Self {
            export,
            materials: Materials::default(),
            remarks: Vec::new(),
            places: Vec::new(),
            block,
            next_element: 1,
            buildings: String::new(),
            nodes: String::new(),
            supports: String::new(),
            held: String::new(),
            ties: String::new(),
            members: String::new(),
            rigid: String::new(),
            springs: String::new(),
            sliders: String::new(),
            leaning: String::new(),
            contacts: String::new(),
            links: String::new(),
            next_point: Vec::new(),
            arms: String::new(),
            faces: String::new(),
            ends: String::new(),
            space_joints: String::new(),
            space_members: String::new(),
            space_hinges: String::new(),
            levels: String::new(),
        };
        let mut faults = Vec::new();
        let mut place = 0.0;
        for (index, building) in export.system.buildings.iter().enumerate() {
            script.places.push(place);
            let nodes = &building.discretization.stick_model.nodes;
            place += nodes
                .iter()
                .fold(0.0, |widest: f64, node| widest.max(node.x));
            script.next_point.push(nodes.len());
            if building.is_in_space() {
                if let Err(fault) = script.add_plan_building(index, building) {
                    faults.push(fault);
                }
                continue;
            }
            if let Err(rule) = script.add_building(index, building) {
                faults.push(ModelFault {
                    path: format!("building[{index}]"),
                    problem: format!("OpenSees has no rule \"{rule}\""),
                });
            }
        }
        if in_plan {
            script.add_plan_contacts(&mut faults);
        } else {
            script.add_contacts(&mut faults);
            script.add_links(&mut faults);
        }
        script.remark_on_motion();
        if faults.is_empty() {
            Ok(script)
        } else {
            Err(faults)
        }
    }

    pub(super) fn remarks(&self) -> &[String] {
        &self.remarks
    }

    pub(super) fn remark(&mut self, text: impl Into<String>) {
        let text = text.into();
        if !self.remarks.contains(&text) {
            self.remarks.push(text);
        }
    }

    /// Tag of a node.
    pub(super) fn tag(&self, building: usize, node: usize) -> usize {
        (building + 1) * self.block + node + 1
    }

    pub(super) fn element(&mut self) -> usize {
        self.next_element += 1;
        self.next_element - 1
    }

    fn add_building(
        &mut self,
        index: usize,
        building: &BuildingSystem,
    ) -> Result<(), &'static str> {
        let stick_model = &building.discretization.stick_model;
        let ties = Ties::new(stick_model);
        self.add_heading(index, building);
        self.add_nodes(index, building, &ties);
        self.add_members(index, stick_model);
        self.add_hinges(index, stick_model, &ties)?;
        self.add_storeys(index, stick_model)
    }

    fn add_heading(&mut self, index: usize, building: &BuildingSystem) {
        let title = format!("    # {}\n", comment(&building.name));
        for table in [
            &mut self.nodes,
            &mut self.supports,
            &mut self.held,
            &mut self.ties,
            &mut self.members,
            &mut self.rigid,
            &mut self.springs,
            &mut self.leaning,
        ] {
            table.push_str(&title);
        }
        let floors: Vec<String> = building
            .discretization
            .floors
            .iter()
            .map(|node| self.tag(index, *node).to_string())
            .collect();
        // Walls follow the buildings of the model, and have no weight.
        let of_model = self.export.model.buildings.get(index);
        let gravity = of_model.map_or_else(Default::default, |building| building.gravity);
        let (equations, nodes) = (
            &building.equations,
            building.discretization.stick_model.nodes.len(),
        );
        let _ = writeln!(
            self.buildings,
            "    {{\"name\": {}, \"nodes\": ({}, {}), \"floors\": [{}],\n     \"alpha\": {:?}, \"beta\": {:?}, \"weight\": {}}},",
            text(&building.name),
            self.tag(index, 0),
            self.tag(index, nodes - 1),
            floors.join(", "),
            equations.alpha,
            equations.beta,
            python_bool(gravity.preload),
        );
    }

    fn add_nodes(&mut self, index: usize, building: &BuildingSystem, ties: &Ties) {
        for (number, node) in building.discretization.stick_model.nodes.iter().enumerate() {
            let tag = self.tag(index, number);
            // Fixed nodes need no mass.
            let mass = if node.support == Support::Fixed {
                0.0
            } else {
                node.mass
            };
            let _ = writeln!(
                self.nodes,
                "    ({tag}, {:?}, {:?}, {mass:?}, {:?}),",
                rounded(node.x + self.places[index]),
                rounded(node.y),
                node.rotary_inertia,
            );
            let fixed: Vec<&str> = (0..COMPONENTS)
                .map(|component| {
                    if is_held_by(node.support, component) {
                        "1"
                    } else {
                        "0"
                    }
                })
                .collect();
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
            if !directions.is_empty() {
                self.spring(first, last, &directions, hinge.proportional_damping);
            }
        }
        Ok(())
    }

    fn add_storeys(&mut self, index: usize, stick_model: &StickModel) -> Result<(), &'static str> {
        for spring in &stick_model.springs {
            let [first, last] = spring.ends.map(|node| self.tag(index, node));
            let materials = self.spring_materials(
                spring.stiffness,
                spring.hysteresis.as_ref(),
                spring.dashpot,
            )?;
            let directions: Vec<(usize, usize)> = materials
                .into_iter()
                .map(|material| (1, material))
                .collect();
            if !directions.is_empty() {
                self.spring(first, last, &directions, spring.proportional_damping);
            }
            if spring.softening != 0.0 {
                self.lean(first, last, -spring.softening);
            }
        }
        for coupling in &stick_model.couplings {
            let [(first, a), (last, b)] = coupling.ends;
            if a != 0 || b != 0 {
                return Err(
                    "has matrices with rotations or vertical displacements, between which OpenSees has no springs; export the model they came from",
                );
            }
            let [first, last] = [first, last].map(|node| self.tag(index, node));
            let materials = self.spring_materials(coupling.stiffness, None, coupling.dashpot)?;
            let directions: Vec<(usize, usize)> = materials
                .into_iter()
                .map(|material| (1, material))
                .collect();
            self.spring(first, last, &directions, true);
        }
        Ok(())
    }

    /// Parallel elements: a spring, elastic or not, and a dashpot.
    fn spring_materials(
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

    pub(super) fn spring(
        &mut self,
        first: usize,
        last: usize,
        directions: &[(usize, usize)],
        damped: bool,
    ) {
        let tag = self.element();
        let pairs: Vec<String> = directions
            .iter()
            .map(|(direction, material)| format!("({direction}, {material}),"))
            .collect();
        let _ = writeln!(
            self.springs,
            "    ({tag}, {first}, {last}, ({}), {}),",
            pairs.join(" "),
            python_bool(damped)
        );
    }

    fn add_contacts(&mut self, faults: &mut Vec<ModelFault>) {
        let system = self.export.system;
        for contact in &system.contacts {
            let path = format!("gap[{}]", contact.gap);
            if contact.ports.0.contains(&None) {
                let told = faults
                    .iter()
                    .any(|fault| fault.path == format!("{path}.between"));
                if !told {
                    faults.push(ModelFault {
                        path: format!("{path}.between"),
                        problem: "rigid walls are not exported; leave the gap out".to_owned(),
                    });
                }
                continue;
            }
            let face = |side: usize| self.face(contact.ports.0[side]?, side == 0);
            let (Some(a), Some(b)) = (face(0), face(1)) else {
                faults.push(ModelFault {
                    path: format!("{path}.floors"),
                    problem: format!("no nodes face each other at {:.3} m", contact.height),
                });
                continue;
            };
            let (material, remark) = match self.materials.contact(contact) {
                Ok(found) => found,
                Err(problem) => {
                    if !faults
                        .iter()
                        .any(|fault| fault.path == format!("{path}.law"))
                    {
                        faults.push(ModelFault {
                            path: format!("{path}.law"),
                            problem: problem.to_owned(),
                        });
                    }
                    continue;
                }
            };
            if let Some(remark) = remark {
                self.remark(remark);
            }
            if contact.width == 0.0 {
                self.remark("OpenSees needs a gap: sides that touch at rest are 1e-12 m apart.");
            }
            let tag = self.element();
            let floors = contact.ports.floors();
            let floor = |floor: Option<usize>| {
                floor.map_or_else(|| "None".to_owned(), |floor| floor.to_string())
            };
            let _ = writeln!(
                self.contacts,
                "    ({tag}, {a}, {b}, {material}, {:?}, {}, ({}, {}), {:?}),",
                contact.width,
                contact.gap,
                floor(floors[0]),
                floor(floors[1]),
                rounded(contact.height),
            );
        }
    }

    /// Tag of the node at a point of the right or the left face of a building.
    fn face(&self, port: Port, right: bool) -> Option<usize> {
        let discretization = &self.export.system.buildings[port.building].discretization;
        let nodes = if right {
            &discretization.right_face
        } else {
            &discretization.left_face
        };
        let level = |node: &&usize| {
            (discretization.stick_model.nodes[**node].y - port.height).abs() <= SAME_LEVEL
        };
        let node = match nodes.iter().find(level) {
            Some(node) => *node,
            // A wall has one node, whatever the height of its contacts.
            None if port.building >= self.export.model.buildings.len() => *nodes.first()?,
            None => return None,
        };
        Some(self.tag(port.building, node))
    }

    /// Tag of a node of a building that stands still.
    fn ground(&self, building: usize) -> Option<usize> {
        let sticks = &self.export.system.buildings[building]
            .discretization
            .stick_model;
        let mut nodes = sticks.nodes.iter();
        let node = nodes.position(|node| node.support == Support::Fixed)?;
        Some(self.tag(building, node))
    }

    fn add_links(&mut self, faults: &mut Vec<ModelFault>) {
        let system = self.export.system;
        for link in &system.links {
            let path = format!("link[{}]", link.link);
            let ports = link.ports.0;
            let own = ports.iter().flatten().map(|port| port.building).next();
            // Both ends of a link inside a building stand on the same face.
            let end = |side: usize| match ports[side] {
                Some(port) => self.face(port, side == 0 || link.inside),
                None => self.ground(own?),
            };
            let (Some(a), Some(b)) = (end(0), end(1)) else {
                faults.push(ModelFault {
                    path: format!("{path}.floors"),
                    problem: format!("there is no node at {:.3} m", link.height),
                });
                continue;
            };
            let (material, remark) = match self.materials.link(link) {
                Ok(found) => found,
                Err(rule) => {
                    faults.push(ModelFault {
                        path: format!("{path}.hinge.rule"),
                        problem: format!(
                            "OpenSees has no rule \"{rule}\"; normal, bilinear, peak-oriented and pinched can be exported"
                        ),
                    });
                    continue;
                }
            };
            if let Some(remark) = remark {
                self.remark(remark);
            }
            let tag = self.element();
            let floor = |floor: Option<usize>| {
                floor.map_or_else(|| "None".to_owned(), |floor| floor.to_string())
            };
            let [low, high] = link.ports.floors();
            let _ = writeln!(
                self.links,
                "    ({tag}, {a}, {b}, {material}, {}, ({}, {}), {:?}),",
                link.link,
                floor(low),
                floor(high),
                rounded(link.height),
            );
        }
    }

    fn remark_on_motion(&mut self) {
        if matches!(self.export.motion.wave, Wave::Ricker { .. }) {
            self.remark("The Ricker pulse is sampled every 0.1 ms, with straight lines between.");
        }
        let yields = self.export.system.buildings.iter();
        let mut springs = yields.flat_map(|building| &building.equations.springs);
        if (springs.clone()).any(|spring| spring.hysteresis.falling_branch().is_some()) {
            self.remark(
                "Columns that fail in shear are OpenSees' LimitState with the falling branch in its backbone; it does not \
                 look for corners inside a step.",
            );
        }
        if springs.any(|spring| spring.hysteresis.falling_branch().is_none()) {
            self.remark(
                "Hinges of the rule peak-oriented are OpenSees' Hysteretic with pinching 1, 1; it does not look for \
                 corners inside a step. Those of normal and bilinear are elastic-plastic springs in parallel, exactly \
                 jostle's. Stiffness-proportional damping acts on neither.",
            );
        }
    }

    pub(super) fn text(&self, driver: &str) -> String {
        let mut text = String::new();
        let _ = self.write(&mut text, driver);
        text
    }

    fn write(&self, out: &mut String, driver: &str) -> std::fmt::Result {
        let title = comment(&self.export.model.title);
        writeln!(out, "#!/usr/bin/env python3")?;
        writeln!(out, "# {title}")?;
        writeln!(
            out,
            "#\n# The same model for OpenSeesPy, written by jostle {}; SI units, relative to the ground.\n#",
            env!("CARGO_PKG_VERSION")
        )?;
        writeln!(
            out,
            "#   python FILE                     at its best: long linear steps in free vibration, short ones near contact"
        )?;
        writeln!(
            out,
            "#   python FILE --uniform 1e-4      the usual way: one step size throughout"
        )?;
        writeln!(
            out,
            "#   python FILE --modes 5           natural periods, to compare with jostle modes"
        )?;
        writeln!(out, "#   python FILE --help\n#")?;
        if !self.remarks.is_empty() {
            writeln!(out, "# Differences from jostle:")?;
            for remark in &self.remarks {
                for (index, line) in wrapped(remark, 110).iter().enumerate() {
                    let bullet = if index == 0 { "-" } else { " " };
                    writeln!(out, "# {bullet} {line}")?;
                }
            }
            writeln!(out, "#")?;
        }
        writeln!(out, "# ruff: noqa\n")?;
        writeln!(out, "TITLE = {}", text(&self.export.model.title))?;
        writeln!(
            out,
            "EXPORTED_BY = \"jostle {}\"",
            env!("CARGO_PKG_VERSION")
        )?;
        table(
            out,
            "BUILDINGS",
            "from left to right; first and last node; Rayleigh damping alpha [1/s], beta [s]; whether it starts under its weight",
            &self.buildings,
        )?;
        table(
            out,
            "NODES",
            "node, x [m], y [m], mass [kg], rotary inertia [kg m2]; neighbours stand face to face, the gap is left out",
            &self.nodes,
        )?;
        table(
            out,
            "SUPPORTS",
            "node, and whether x, y, rotation are fixed",
            &self.supports,
        )?;
        table(
            out,
            "HELD",
            "node, direction: stands still because members keep their length",
            &self.held,
        )?;
        table(
            out,
            "TIES",
            "node, node that moves with it, directions: members that keep their length, hinges that only turn",
            &self.ties,
        )?;
        table(
            out,
            "MEMBERS",
            "element, first node, last node, EI [N m2], EA [N], G As [N]; None is rigid",
            &self.members,
        )?;
        let mut materials = String::new();
        for (tag, name, arguments) in self.materials.iter() {
            let arguments: Vec<String> = arguments
                .iter()
                .map(|value| {
                    if name == "Parallel" {
                        format!("{value:.0}")
                    } else {
                        format!("{value:?}")
                    }
                })
                .collect();
            writeln!(
                materials,
                "    (\"{name}\", {tag}, {}),",
                arguments.join(", ")
            )?;
        }
        table(out, "MATERIALS", "as OpenSees wants them", &materials)?;
        table(
            out,
            "SPRINGS",
            "element, first node, last node, (direction, material), whether Rayleigh damping acts",
            &self.springs,
        )?;
        table(
            out,
            "SLIDERS",
            "element, point of the ground, point of the mat, stiffness [N/m] and strength [N] of a bearing that yields or slides",
            &self.sliders,
        )?;
        table(
            out,
            "RIGID",
            "element, first node, last node, direction that does not give way, whether ties see to it",
            &self.rigid,
        )?;
        table(
            out,
            "LEANING",
            "element, first node, last node, material: P-Delta as springs of stiffness -P/h",
            &self.leaning,
        )?;
        table(
            out,
            "CONTACTS",
            "element, left node, right node, material, gap [m], number of the gap, floors, height [m]",
            &self.contacts,
        )?;
        table(
            out,
            "LINKS",
            "element, left node, right node, material, number of the link, floors, height [m]",
            &self.links,
        )?;
        table(
            out,
            "ARMS",
            "node of a floor in plan, node at one of its points",
            &self.arms,
        )?;
        table(
            out,
            "FACES",
            "element of a contact in plan, number of the face, its kind, unit normal, place [m]",
            &self.faces,
        )?;
        table(
            out,
            "ENDS",
            "element at a corner; node and shares of its motions along the edge, on either side; distance from the end of the edge [m]",
            &self.ends,
        )?;
        table(
            out,
            "LEVELS",
            "node of a floor in plan, height [m]",
            &self.levels,
        )?;
        table(
            out,
            "JOINTS",
            "joint of a space frame, x, y, z [m], node of the floor with which it moves; None is the ground",
            &self.space_joints,
        )?;
        table(
            out,
            "COLUMNS_AND_BEAMS",
            "element, first and last joint, EI in the plane of bending and sideways [N m2], GJ [N m2], EA [N], G As in both planes [N], direction in the plane of bending; None is rigid",
            &self.space_members,
        )?;
        table(
            out,
            "HINGED_ENDS",
            "end of a member, its joint, unit vector of the lines along x, (first element, directions, materials) of springs",
            &self.space_hinges,
        )?;
        self.write_motion(out)?;
        writeln!(out, "\n{}", driver.trim_end())
    }

    fn write_motion(&self, out: &mut String) -> std::fmt::Result {
        let motion = self.export.motion;
        let free = motion.step().map_or(FREE_STEP, |step| {
            step / (step / FREE_STEP - 1e-9).ceil().max(1.0)
        });
        writeln!(out, "GRAVITY = {STANDARD_GRAVITY:?}  # m/s2")?;
        writeln!(out, "\n# Ground motion: {}", comment(&motion.name))?;
        writeln!(out, "DURATION = {:?}  # s", motion.duration)?;
        write_wave(out, motion)?;
        if let Some(bearing) = &motion.bearing {
            writeln!(
                out,
                "ANGLE = {:?}  # rad, from x to the motion, counter-clockwise",
                bearing.angle
            )?;
            if let Some(across) = &bearing.across {
                writeln!(
                    out,
                    "\n\nclass ACROSS:  # the motion a right angle further: {}",
                    comment(&across.name)
                )?;
                let mut wave = format!("DURATION = {:?}  # s\n", across.duration);
                write_wave(&mut wave, across)?;
                for line in wave.lines() {
                    writeln!(out, "    {line}")?;
                }
                writeln!(out)?;
            }
        }
        writeln!(
            out,
            "\n# Steps at its best, in free vibration and around contact [s]."
        )?;
        writeln!(out, "FREE_STEP = {free:?}")?;
        writeln!(out, "PARTS_IN_CONTACT = {PARTS_IN_CONTACT}")
    }
}

/// The shape of a ground motion, and its factor.
fn write_wave(out: &mut String, motion: &GroundMotion) -> std::fmt::Result {
    writeln!(
        out,
        "MOTION_FACTOR = {:?}  # on the values, sign included",
        motion.scale
    )?;
    match &motion.wave {
        Wave::Sampled { step, acceleration } => {
            writeln!(out, "RECORD_STEP = {step:?}  # s")?;
            writeln!(out, "RECORD = [  # m/s2")?;
            for row in acceleration.chunks(8) {
                let values: Vec<String> = row.iter().map(|a| format!("{a:?}")).collect();
                writeln!(out, "    {},", values.join(", "))?;
            }
            writeln!(out, "]")
        }
        Wave::Sine { amplitude, period } => {
            writeln!(out, "SINE = ({amplitude:?}, {period:?})  # m/s2, s")
        }
        Wave::Ricker {
            amplitude,
            period,
            centre,
        } => writeln!(
            out,
            "RICKER = ({amplitude:?}, {period:?}, {centre:?})  # m/s2, s, s"
        ),
    }
}

/// A list of rows, said to be empty where it has none.
fn table(out: &mut String, name: &str, about: &str, rows: &str) -> std::fmt::Result {
    writeln!(out, "\n# {about}")?;
    if rows.lines().all(|row| row.trim_start().starts_with('#')) {
        writeln!(out, "{name} = []")
    } else {
        writeln!(out, "{name} = [\n{rows}]")
    }
}

/// Coordinates without the rounding of sums.
pub(super) fn rounded(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// A Python text.
pub(super) fn text(value: &str) -> String {
    let mut out = String::from("\"");
    for character in value.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            other if other.is_control() => out.push(' '),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

/// A text on one line.
pub(super) fn comment(value: &str) -> String {
    value
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

pub(super) fn python_bool(value: bool) -> &'static str {
    if value { "True" } else { "False" }
}

/// Lines with a maximum length.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].len() + word.len() >= width {
            lines.push(word.to_owned());
        } else {
            if !lines[last].is_empty() {
                lines[last].push(' ');
            }
            lines[last].push_str(word);
        }
    }
    lines
}
