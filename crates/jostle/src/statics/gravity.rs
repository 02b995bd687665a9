//! Gravity: static displacements under self weight, and the axial compression it leaves in columns.

use super::{PathError, Settled, settle};
use crate::hysteresis::Hysteresis;
use crate::linear::{NotPositive, StepMatrix};
use crate::model::{Gravity, STANDARD_GRAVITY};
use crate::structure::element::{self, Element, ElementStiffness, Part, THETA, Y, over_nodes};
use crate::structure::stick_elements;
use crate::structure::{
    AssembledBuilding, Discretization, MemberEnd, MemberPlace, SpringPlace, StepEquations,
    StickModel,
};
use crate::transfer::riccati::{RiccatiFactor, RiccatiSweep};

/// Static displacement of every degree of freedom of a building under its own weight \[m, rad\], as long as nothing
/// cracks; [`settle`] goes further.
///
/// `gravity` ≥ 0 \[m/s²\]. Where members keep their length, what rests on them does not sink.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn static_displacement(
    building: &AssembledBuilding,
    gravity: f64,
) -> Result<Vec<f64>, NotPositive> {
    let sweep = RiccatiSweep::new(building);
    let mut factor = RiccatiFactor::default();
    sweep.factorize(
        &StepMatrix::STATIC,
        &building.equations.initial_tangents(),
        &mut factor,
    )?;
    let mut displacement: Vec<f64> = building
        .equations
        .weighing_mass
        .iter()
        .map(|mass| -mass * gravity)
        .collect();
    sweep.solve(&factor, &mut displacement, &mut Default::default());
    Ok(displacement)
}

/// Axial compression of every member under gravity, zero in horizontal ones \[N\].
///
/// By equilibrium of the column lines: a column carries the masses above on its line, and the loads of
/// the beams that end there, with hinges cracked by the weight. It does not depend on whether columns keep their
/// length.
///
/// # Errors
/// [`PathError`] when the building cannot carry its weight.
pub fn compressions(building: &AssembledBuilding, gravity: f64) -> Result<Vec<f64>, PathError> {
    let settled = settle(building, gravity)?;
    let stick_model = &building.discretization.stick_model;
    let hung = hung_on_nodes(stick_model, building, &settled, gravity);
    Ok(stick_model
        .members
        .iter()
        .map(|member| {
            let nodes = &stick_model.nodes;
            if !member.is_vertical(nodes) {
                return 0.0;
            }
            let [a, b] = member.ends.map(|end| nodes[end]);
            let top = a.y.max(b.y);
            let turn = stick_model.turn(member.ends[0]);
            let on_line = nodes.iter().zip(&hung).enumerate().filter(|(index, _)| {
                // Faces of a wall are on the line of its axis.
                let other = stick_model.turn(*index);
                let apart = (other.position - turn.position).abs();
                apart < SAME_LINE && other.elevation == turn.elevation
            });
            on_line
                .filter(|(_, (node, _))| node.y > top - SAME_LINE)
                .map(|(_, (_, weight))| weight)
                .sum()
        })
        .collect())
}

/// A building that cannot stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Collapse {
    /// It can move without deforming.
    #[error("the building can move without resistance")]
    Movable,
    /// Its hinges cannot carry its weight.
    #[error(
        "the hinges cannot carry the weight of the building: a mechanism forms before all of it is on; are yield moments and masses right?"
    )]
    Overloaded,
    /// P-Delta has used up its stiffness.
    #[error(
        "the building buckles under its own weight: P-Delta exceeds its stiffness, lateral or in torsion; are its masses and sections right?"
    )]
    Buckles,
}

impl Collapse {
    /// The field of a building that brought it about.
    #[must_use]
    pub fn field(&self) -> &'static str {
        match self {
            Self::Movable | Self::Overloaded => "gravity",
            Self::Buckles => "p_delta",
        }
    }
}

/// Adds P-Delta and finds the displacements under self weight, as far as each is asked for: the building
/// with P-Delta in its equations, where it is, and what it is at rest, empty where weight is left out.
///
/// The compression of every member is that of the building standing straight (theory, Eq. K1): axial forces
/// that shaking adds are not followed.
///
/// # Errors
/// [`Collapse`].
pub fn under_gravity(
    building: &AssembledBuilding,
    gravity: Gravity,
) -> Result<(Option<AssembledBuilding>, Settled), Collapse> {
    static_displacement(building, STANDARD_GRAVITY).map_err(|_| Collapse::Movable)?;
    let leaning = if gravity.p_delta {
        Some(with_p_delta(building)?)
    } else {
        None
    };
    let rest = if gravity.preload {
        let standing = leaning.as_ref().unwrap_or(building);
        settle(standing, STANDARD_GRAVITY).map_err(|_| Collapse::Overloaded)?
    } else {
        Settled::default()
    };
    Ok((leaning, rest))
}

/// The building with P-Delta in its equations.
fn with_p_delta(building: &AssembledBuilding) -> Result<AssembledBuilding, Collapse> {
    let carried = compressions(building, STANDARD_GRAVITY).map_err(|_| Collapse::Overloaded)?;
    let mut discretization = building.discretization.clone();
    let stick_model = &mut discretization.stick_model;
    for (member, compression) in stick_model.members.iter_mut().zip(carried) {
        member.compression = compression;
    }
    // The rigid end of a column leans as a whole by the rotation of its joint.
    let leaning = stick_model.rigid_ends.iter().map(|end| Element::Spring {
        part: Part::Undamped,
        stiffness: -stick_model.members[end.member].compression * end.length,
        row: over_nodes([((end.joint, THETA), 1.0)]),
    });
    stick_model.elements.extend(leaning.collect::<Vec<_>>());
    let nodes = &stick_model.nodes;
    for spring in &mut stick_model.springs {
        let [a, b] = spring.ends.map(|end| nodes[end].y);
        // The spring of a base has no height, so no P-Delta.
        let carries = spring.hysteresis.is_some() || spring.stiffness > 0.0;
        if carries && (a - b).abs() > SAME_LINE {
            let above = nodes.iter().filter(|node| node.y > a.max(b) - SAME_LINE);
            let weight = STANDARD_GRAVITY * above.map(|node| node.mass).sum::<f64>();
            spring.softening = weight / (a - b).abs();
        }
    }
    lean_on_shear_springs(&mut discretization);
    let leaning = AssembledBuilding::new(&building.name, discretization);
    RiccatiSweep::new(&leaning)
        .factorize(
            &StepMatrix::STATIC,
            &leaning.equations.initial_tangents(),
            &mut RiccatiFactor::default(),
        )
        .map_err(|_| Collapse::Buckles)?;
    Ok(leaning)
}

/// P-Delta of what a column slides in its shear spring, as part of the drift of its storey.
fn lean_on_shear_springs(discretization: &mut Discretization) {
    let sticks = &mut discretization.stick_model;
    let nodes = &sticks.nodes;
    let tops: Vec<f64> = discretization.floors.iter().map(|&n| nodes[n].y).collect();
    let places = discretization.spring_places.iter();
    let mut places = places.filter(|place| place.is_shear());
    for spring in &mut sticks.springs {
        let falls = |hysteresis: Hysteresis| hysteresis.falling_branch().is_some();
        if !spring.hysteresis.is_some_and(falls) {
            continue;
        }
        let Some(&SpringPlace::Shear {
            member: MemberPlace::Column { storey, .. },
            end,
            ..
        }) = places.next()
        else {
            return;
        };
        let below = storey.checked_sub(2).map_or(0.0, |floor| tops[floor]);
        let at_column = match end {
            MemberEnd::First => spring.ends[1],
            MemberEnd::Last => spring.ends[0],
        };
        let column = sticks
            .members
            .iter()
            .find(|member| member.ends.contains(&at_column) && member.is_vertical(nodes));
        let carried = column.map_or(0.0, |column| column.compression);
        spring.softening = carried / (tops[storey - 1] - below);
    }
}

/// Nodes closer than this lie on one column line \[m\].
const SAME_LINE: f64 = 1e-6;

/// Downward force on every node from its own mass and from the beams, braces and struts that end there, columns excluded \[N\].
fn hung_on_nodes(
    stick_model: &StickModel,
    building: &AssembledBuilding,
    settled: &Settled,
    gravity: f64,
) -> Vec<f64> {
    let mut hung: Vec<f64> = stick_model
        .nodes
        .iter()
        .map(|node| (node.inertia[Y] + node.load / STANDARD_GRAVITY) * gravity)
        .collect();
    let nodes = &stick_model.nodes;
    let beams = stick_model.members.iter();
    let beams = beams.filter(|member| !member.is_vertical(nodes));
    let beams = beams.map(|member| stick_elements::of_member(member, nodes));
    let others = stick_model.elements.iter().map(ElementStiffness::from);
    for (part, a, b, value) in beams.chain(others).flat_map(|beam| beam.entries) {
        if a.1 == Y && part != Part::Dashpot {
            // The member holds the node up with −K u.
            for (b, share) in element::places(&stick_model.carried(b)) {
                hung[a.0] += building
                    .equations
                    .dof(b)
                    .map_or(0.0, |dof| value * share * settled.displacement[dof]);
            }
        }
    }
    let single = stick_model.single_springs().zip(&settled.springs);
    let single = single.map(|(spring, memory)| (spring.row, memory));
    let surfaces = stick_model.surface_rows().rev();
    let surfaces = surfaces.zip(settled.springs.iter().rev());
    let surfaces = surfaces.map(|(element, memory)| (element.row.clone(), memory));
    for (row, memory) in single.chain(surfaces) {
        for ((node, component), share) in element::places(&row) {
            if component == Y {
                hung[node] += share * memory.force();
            }
        }
    }
    hung
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::testkit::frame;

    #[test]
    fn columns_carry_all_that_lies_above_them() {
        for flexible in [false, true] {
            let building = frame(flexible);
            let stick_model = &building.discretization.stick_model;
            let carried = compressions(&building, 10.0).expect("it stands");
            for cut in [0.1, 1.5, 3.1, 7.4] {
                let through = stick_model
                    .members
                    .iter()
                    .zip(&carried)
                    .filter(|(member, _)| {
                        let [a, b] = member.ends.map(|end| stick_model.nodes[end].y);
                        a.min(b) < cut && a.max(b) > cut
                    });
                let above: f64 = stick_model
                    .nodes
                    .iter()
                    .filter(|node| node.y > cut)
                    .map(|node| 10.0 * node.mass)
                    .sum();
                let sum: f64 = through.map(|(_, force)| force).sum();
                assert!(
                    (sum / above - 1.0).abs() < 1e-9,
                    "at {cut} m: {sum} N instead of {above} N"
                );
            }
        }
    }

    #[test]
    fn a_column_shortens_under_what_it_carries() {
        // With flexible columns the compression is also EA times the shortening.
        let building = frame(true);
        let stick_model = &building.discretization.stick_model;
        let sunk = static_displacement(&building, 10.0).expect("it stands");
        let carried = compressions(&building, 10.0).expect("it stands");
        for (member, force) in stick_model
            .members
            .iter()
            .zip(&carried)
            .filter(|(_, force)| **force != 0.0)
        {
            let at = |end: usize| {
                building
                    .equations
                    .vertical(member.ends[end])
                    .map_or(0.0, |dof| sunk[dof])
            };
            let [a, b] = member.ends.map(|end| stick_model.nodes[end].y);
            let shortened = (at(0) - at(1)) * (b - a).signum() / (b - a).abs() * 8e9;
            assert!(
                (shortened / force - 1.0).abs() < 1e-9,
                "{shortened} N and {force} N"
            );
        }
    }
}
