//! What columns and beams bear under the weight of their building.

use super::{Collapse, under_gravity};
use crate::model::{Building, Gravity, STANDARD_GRAVITY};
use crate::structure::{AssembledBuilding, AtRest, Discretization, MemberForces, Motion};

/// Axial compression of every column and beam of a building that stands still under its weight, each with its name within the
/// building, such as `column.1.2.3`; at the lower or left end \[N\].
///
/// It is the same whether its runs start under that weight or not.
///
/// # Errors
/// [`Collapse`] when the building cannot carry its weight.
pub fn compressions_of_members(building: &Building) -> Result<Vec<(String, f64)>, Collapse> {
    let gravity = Gravity {
        preload: true,
        p_delta: false,
    };
    let standing = Building {
        gravity,
        ..building.clone()
    };
    let discretization = Discretization::new(&standing);
    let assembled = AssembledBuilding::new(&building.name, discretization);
    let (_, settled) = under_gravity(&assembled, gravity)?;
    let rest = AtRest {
        gravity: STANDARD_GRAVITY,
        displacement: &settled.displacement,
        springs: &settled.springs,
    };
    let forces = MemberForces::new(&assembled, rest, |_| false);
    let still = vec![0.0; settled.displacement.len()];
    let motion = Motion {
        displacement: &settled.displacement,
        velocity: &still,
        acceleration: &still,
        ground: 0.0,
    };
    let spring = |index: usize| settled.springs[index].force();
    let frames = &assembled.discretization.frames;
    let members = forces.members.iter().map(|member| {
        let axial = &forces.forms[member.sections[0].forms[0]];
        let axial = axial.value(motion, spring, |_| 0.0, |_| 0.0);
        (member.local_name(frames), -axial)
    });
    Ok(members.collect())
}
