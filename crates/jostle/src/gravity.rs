//! Gravity: static displacements under self weight, and the axial compression of columns.

use crate::element::{self, Y};
use crate::model::Gravity;
use crate::skeleton::Skeleton;
use crate::statics::{self, WalkError};
use crate::stepping::{NotPositive, StepEquations, StepMatrix};
use crate::system::BuildingSystem;
use crate::transfer::riccati::{RiccatiFactor, RiccatiSweep};

/// Standard gravity \[m/s²\].
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Static displacement of every degree of freedom of a building under self weight \[m, rad\] without cracking;
/// [`statics::settle`] includes cracking.
///
/// `gravity` ≥ 0 \[m/s²\]. Nodes on axially rigid columns do not move vertically.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub fn static_displacement(
    building: &BuildingSystem,
    gravity: f64,
) -> Result<Vec<f64>, NotPositive> {
    let sweep = RiccatiSweep::of(building);
    let mut factor = RiccatiFactor::default();
    sweep.factorize(
        &StepMatrix::STATIC,
        &building.equations.initial_tangents(),
        &mut factor,
    )?;
    let mut displacement: Vec<f64> = building
        .equations
        .vertical_mass
        .iter()
        .map(|mass| -mass * gravity)
        .collect();
    sweep.solve(&factor, &mut displacement);
    Ok(displacement)
}

/// Axial compression of every member under gravity, zero in horizontal ones \[N\].
///
/// From equilibrium of the column lines: a column carries the masses above on its line and the end forces of beams,
/// with hinges cracked under the weight. So the result does not depend on axial flexibility of columns.
///
/// # Errors
/// [`WalkError`] when the building cannot carry its weight.
pub fn compressions(building: &BuildingSystem, gravity: f64) -> Result<Vec<f64>, WalkError> {
    let displacement = statics::settle(building, gravity)?.displacement;
    let skeleton = &building.idealisation.skeleton;
    let hung = hung_on_nodes(skeleton, building, &displacement, gravity);
    Ok(skeleton
        .members
        .iter()
        .map(|member| {
            let nodes = &skeleton.nodes;
            if !member.is_vertical(nodes) {
                return 0.0;
            }
            let [a, b] = member.ends.map(|end| nodes[end]);
            let top = a.y.max(b.y);
            let on_line = nodes
                .iter()
                .zip(&hung)
                .filter(|(node, _)| (node.x - a.x).abs() < SAME_LINE);
            on_line
                .filter(|(node, _)| node.y > top - SAME_LINE)
                .map(|(_, weight)| weight)
                .sum()
        })
        .collect())
}

/// A building that is unstable under self weight.
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
    /// P-Delta exceeds its stiffness.
    #[error(
        "the building buckles under its own weight: P-Delta exceeds its lateral stiffness; are its masses and sections right?"
    )]
    Buckles,
}

impl Collapse {
    /// The field of a building that caused it.
    #[must_use]
    pub fn field(&self) -> &'static str {
        match self {
            Self::Movable | Self::Overloaded => "gravity",
            Self::Buckles => "p_delta",
        }
    }
}

impl BuildingSystem {
    /// Applies P-Delta and sets the displacements at rest, as requested.
    ///
    /// The compression of every member is that of the undeformed building (theory, Eq. K1); axial forces due to the
    /// earthquake are not included.
    ///
    /// # Errors
    /// [`Collapse`]; the building is then as it was.
    pub fn put_under_gravity(&mut self, gravity: Gravity) -> Result<(), Collapse> {
        if !gravity.p_delta && !gravity.preload {
            return Ok(());
        }
        static_displacement(self, STANDARD_GRAVITY).map_err(|_| Collapse::Movable)?;
        let mut settled = self.clone();
        if gravity.p_delta {
            let carried =
                compressions(&settled, STANDARD_GRAVITY).map_err(|_| Collapse::Overloaded)?;
            let mut idealisation = settled.idealisation.clone();
            let skeleton = &mut idealisation.skeleton;
            for (member, compression) in skeleton.members.iter_mut().zip(carried) {
                member.compression = compression;
            }
            let nodes = &skeleton.nodes;
            for spring in &mut skeleton.springs {
                let [a, b] = spring.ends.map(|end| nodes[end].y);
                // A base spring has no height for P-Delta.
                if (a - b).abs() > SAME_LINE {
                    let above = nodes.iter().filter(|node| node.y > a.max(b) - SAME_LINE);
                    let weight = STANDARD_GRAVITY * above.map(|node| node.mass).sum::<f64>();
                    spring.softening = weight / (a - b).abs();
                }
            }
            let leaning = Self::new(&self.name, idealisation);
            let mut factor = RiccatiFactor::default();
            RiccatiSweep::of(&leaning)
                .factorize(
                    &StepMatrix::STATIC,
                    &leaning.equations.initial_tangents(),
                    &mut factor,
                )
                .map_err(|_| Collapse::Buckles)?;
            settled = leaning;
        }
        if gravity.preload {
            let at_rest =
                statics::settle(&settled, STANDARD_GRAVITY).map_err(|_| Collapse::Overloaded)?;
            (settled.rest, settled.rest_springs) = (at_rest.displacement, at_rest.springs);
        }
        *self = settled;
        Ok(())
    }
}

/// Nodes closer than this lie on one column line \[m\].
const SAME_LINE: f64 = 1e-6;

/// Downward force on every node from its own mass and from the beams that end there, columns excluded \[N\].
fn hung_on_nodes(
    skeleton: &Skeleton,
    building: &BuildingSystem,
    displacement: &[f64],
    gravity: f64,
) -> Vec<f64> {
    let mut hung: Vec<f64> = skeleton
        .nodes
        .iter()
        .map(|node| node.mass * gravity)
        .collect();
    for member in skeleton
        .members
        .iter()
        .filter(|member| !member.is_vertical(&skeleton.nodes))
    {
        for (_, a, b, value) in element::of_member(member, &skeleton.nodes).entries {
            if a.1 == Y {
                // The member supports the node with −K u.
                hung[a.0] += building
                    .equations
                    .dof(b)
                    .map_or(0.0, |dof| value * displacement[dof]);
            }
        }
    }
    hung
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::model::{Axial, Building, Damping, Frame, Hinges, Joint, Section, Structure};
    use crate::skeleton::Idealisation;

    /// Three storeys over two spans.
    pub(crate) fn frame(columns_flexible: bool) -> BuildingSystem {
        frame_with(|frame| {
            frame.axial.columns_flexible = columns_flexible;
            None
        })
    }

    /// Three storeys, two bays, members of several masses, modified by `change`, with the hinges that it returns.
    pub(crate) fn frame_with(change: impl FnOnce(&mut Frame) -> Option<Hinges>) -> BuildingSystem {
        let section = |line_mass| Section {
            flexural_rigidity: 1e8,
            axial_rigidity: Some(8e9),
            line_mass,
            shear_rigidity: None,
        };
        let mut frame = Frame {
            storey_heights: vec![3.0; 3],
            spans: vec![4.0, 6.0],
            columns: vec![section(600.0); 3],
            beams: vec![section(0.0); 3],
            beam_mass: vec![4000.0; 3],
            floor_mass: vec![0.0; 3],
            column_segments: 3,
            beam_segments: vec![4, 5],
            axial: Axial {
                columns_flexible: false,
                beams_flexible: false,
            },
            joint: Joint {
                rotational_stiffness: Some(5e8),
                ..Joint::default()
            },
        };
        let hinges = change(&mut frame);
        let building = Building {
            name: "frame".into(),
            structure: Structure::Frame(frame),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: 0.0,
            },
            base: Default::default(),
            gravity: Default::default(),
            hinges,
        };
        BuildingSystem::new("frame", Idealisation::of(&building))
    }

    #[test]
    fn columns_carry_all_that_lies_above_them() {
        for flexible in [false, true] {
            let building = frame(flexible);
            let skeleton = &building.idealisation.skeleton;
            let carried = compressions(&building, 10.0).expect("it stands");
            for cut in [0.1, 1.5, 3.1, 7.4] {
                let through = skeleton.members.iter().zip(&carried).filter(|(member, _)| {
                    let [a, b] = member.ends.map(|end| skeleton.nodes[end].y);
                    a.min(b) < cut && a.max(b) > cut
                });
                let above: f64 = skeleton
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
        let skeleton = &building.idealisation.skeleton;
        let sunk = static_displacement(&building, 10.0).expect("it stands");
        let carried = compressions(&building, 10.0).expect("it stands");
        for (member, force) in skeleton
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
            let [a, b] = member.ends.map(|end| skeleton.nodes[end].y);
            let shortened = (at(0) - at(1)) * (b - a).signum() / (b - a).abs() * 8e9;
            assert!(
                (shortened / force - 1.0).abs() < 1e-9,
                "{shortened} N and {force} N"
            );
        }
    }
}
