//! The text of a script: its head, its tables, its motion and the driver.

use std::fmt::Write;

use super::script::{Script, comment, text};

impl Script<'_> {
    pub(super) fn text(&self, driver: &[&str]) -> String {
        let mut text = String::new();
        let _ = self.write(&mut text, driver);
        text
    }

    fn write(&self, out: &mut String, driver: &[&str]) -> std::fmt::Result {
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
            "#   python FILE                     efficient: long linear steps in free vibration, short ones near contact"
        )?;
        writeln!(
            out,
            "#   python FILE --uniform 1e-4      one step size throughout"
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
        for (tag, whole, arguments) in self.materials.iter() {
            let (name, word) = whole.split_once(' ').unzip();
            let name = name.unwrap_or(whole);
            let mut arguments: Vec<String> = arguments
                .iter()
                .map(|value| {
                    if name == "Parallel" {
                        format!("{value:.0}")
                    } else {
                        format!("{value:?}")
                    }
                })
                .collect();
            arguments.extend(word.map(|word| format!("\"{word}\"")));
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
            "element, first node, last node, (direction, material), the stiffness on which Rayleigh damping acts",
            &self.springs,
        )?;
        table(
            out,
            "LEVERED",
            "element, first node, last node, material of the shear between them, share of the rotation of the first node, the stiffness on which Rayleigh damping acts",
            &self.levered,
        )?;
        table(
            out,
            "DIAGONALS",
            "element, lower node, upper node, material of the axial force, the stiffness on which Rayleigh damping acts",
            &self.diagonals,
        )?;
        table(
            out,
            "SLIDERS",
            "element, point of the ground, point of the mat, stiffness [N/m] and strength [N] of a bearing that yields or slides",
            &self.sliders,
        )?;
        table(
            out,
            "FIBRES",
            "number of a section, distances of a fibre from its axis [m], material of its force [N] over its elongation [m]",
            &self.fibres,
        )?;
        table(
            out,
            "FIBRE_ENDS",
            "element, node below, node above, number of the section, unit vector of its first axis, name",
            &self.fibre_ends,
        )?;
        table(
            out,
            "CARRIED",
            "node, mass that rises with it beside that of the floor [kg], load that stands on it [N]",
            &self.carried,
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
            "element, left node, right node, material, number of the link, floors, height [m], whether it stands on a foundation that turns",
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
            "FALLING",
            "panel that falls: acceleration at which it does [m/s2], number of its building, floors below and above it (None is the ground), unit normal, elements of its struts",
            &self.falling,
        )?;
        table(
            out,
            "DIRECTIONS",
            "element of a link in plan, unit vector from its first end to its second",
            &self.directions,
        )?;
        table(
            out,
            "ROCKING",
            "base in plan that rocks, rotary inertia about x and about y [kg m2]",
            &self.rocking,
        )?;
        table(
            out,
            "TILTED",
            "element, base that rocks, floor that leans with it, material of what joins their rotations",
            &self.tilted,
        )?;
        table(
            out,
            "TILTED_STOREYS",
            "the same as SPRINGS, of storeys between floors that lean",
            &self.tilted_storeys,
        )?;
        table(
            out,
            "RIDING",
            "base that rocks, foot that moves with it in all directions",
            &self.riding,
        )?;
        table(
            out,
            "RAISED",
            "point that moves with a base in plan, its height [m]",
            &self.raised,
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
            "end of a member, its joint, unit vector of the lines along x, springs: element, nodes, direction, material, the stiffness on which Rayleigh damping acts",
            &self.space_hinges,
        )?;
        table(
            out,
            "RIGID_ENDS",
            "column or beam, lengths at its first and last end that turn with the joint as rigid bodies [m]",
            &self.rigid_ends,
        )?;
        table(
            out,
            "UPRIGHT",
            "joint of a frame at a line of a plan, x, y, z [m], node of the floor with which it moves, unit vector of the line, whether it is held along it, upwards and in rotation, mass along the line [kg] and rotary inertia [kg m2] of its own",
            &self.upright,
        )?;
        table(
            out,
            "UPRIGHT_SPRINGS",
            "element, first and last joint of a frame at a line, direction, material, the stiffness on which Rayleigh damping acts, unit vector of the line",
            &self.upright_springs,
        )?;
        self.write_motion(out)?;
        for part in driver {
            writeln!(out, "\n\n{}", part.trim_end())?;
        }
        Ok(())
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
