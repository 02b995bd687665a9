//! How stiff a building is where it is pushed.

use crate::linear::{Row, StepMatrix};
use crate::structure::{AssembledBuilding, StepEquations};
use crate::transfer::riccati::{RiccatiFactor, RiccatiSweep};

/// Force on a point of a building ÷ its displacement along that force, the rest of the building free to follow, as long as
/// nothing yields \[N/m\]. `at`: displacement of the point over the degrees of freedom of the building; `None` if the
/// building can move without deforming.
#[must_use]
pub fn stiffness_at(building: &AssembledBuilding, at: &Row) -> Option<f64> {
    let sweep = RiccatiSweep::new(building);
    let mut factor = RiccatiFactor::default();
    let tangents = building.equations.initial_tangents();
    sweep
        .factorize(&StepMatrix::STATIC, &tangents, &mut factor)
        .ok()?;
    let mut displacement = vec![0.0; building.equations.len()];
    for &(dof, share) in at.entries() {
        displacement[dof] = share;
    }
    sweep.solve(&factor, &mut displacement, &mut Default::default());
    let moved = at.value(&displacement);
    (moved > 0.0).then(|| 1.0 / moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Building, Shear, Structure};
    use crate::system::System;

    /// Springs in series up to the floor; what is above follows without force.
    #[test]
    fn a_shear_building_is_as_stiff_as_its_storeys_in_series() {
        let building = Building {
            name: "A".into(),
            structure: Structure::Shear(Shear {
                mass: vec![4e4; 3],
                stiffness: vec![3e7, 2e7, 1e7],
                storey_heights: vec![3.0; 3],
            }),
            ..Building::default()
        };
        let model = crate::Model {
            buildings: vec![building],
            ..crate::Model::default()
        };
        let system = System::assemble(&model).expect("a sound model");
        let building = &system.buildings[0];
        for (floor, due) in [3e7, 1.2e7, 1.0 / (1.0 / 1.2e7 + 1e-7)].iter().enumerate() {
            let dof = building.alone().floor_dofs[floor];
            let found = stiffness_at(building.alone(), &Row::single(dof)).expect("it stands");
            assert!((found / due - 1.0).abs() < 1e-12, "{floor}: {found}, {due}");
        }
    }
}
