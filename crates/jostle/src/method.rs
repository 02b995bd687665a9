//! Survey of one building: its elements, its unknowns, and the accuracy of each solver formulation as the step
//! decreases.

use crate::linear::NotPositive;
use crate::model::Integrator;
use crate::stiffness::DirectStiffness;
use crate::structure::StickModel;
use crate::structure::{StepEquations, solve_once};
use crate::system::BuildingSystem;
use crate::transfer::riccati::RiccatiSweep;
use crate::transfer::{ElementwiseRiccati, ProductEquations, digits_left};

/// Elements, orders and accuracy for one building.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodSurvey {
    /// Name of the building.
    pub name: String,
    /// Nodes with mass.
    pub lumped_masses: usize,
    /// Massless beams.
    pub members: usize,
    /// Planar hinges.
    pub hinges: usize,
    /// Storey springs.
    pub springs: usize,
    /// Displacements left after rigid ties: the order of the stiffness form.
    pub degrees_of_freedom: usize,
    /// Entries of the stiffness matrix on and below the diagonal.
    pub stiffness_entries: usize,
    /// Entries of L of the Riccati recursion; a solution takes two multiply-adds for each.
    pub couplings: usize,
    /// Order of the total transfer equation; zero for a building without a transfer path.
    pub product_unknowns: usize,
    /// Whether the building may yield. The Riccati recursion then uses the initial stiffness; the other two forms
    /// do not support yielding and give no result.
    pub yields: bool,
    /// Accuracy of one step, by step size from long to short.
    pub accuracy: Vec<StepAccuracy>,
}

/// Relative errors of one step, against direct stiffness, largest displacement over largest displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepAccuracy {
    /// Step \[s\].
    pub step: f64,
    /// The product of transfer matrices; infinite where it overflows.
    pub product: f64,
    /// Digits that the product was expected to keep.
    pub product_digits_expected: f64,
    /// The Riccati recursion element by element, in flexibility form.
    pub elementwise: f64,
    /// The Riccati recursion as used in runs.
    pub riccati: f64,
}

/// Step sizes surveyed \[s\].
pub const SURVEYED_STEPS: [f64; 8] = [2e-2, 1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 1e-4, 1e-5];

impl MethodSurvey {
    /// Surveys a building with its damping.
    ///
    /// # Errors
    /// [`NotPositive`] if the building is a mechanism.
    pub fn new(building: &BuildingSystem) -> Result<Self, NotPositive> {
        let equations = &building.equations;
        let stick_model: &StickModel = &building.discretization.stick_model;
        Ok(Self {
            name: building.name.clone(),
            lumped_masses: stick_model
                .nodes
                .iter()
                .filter(|node| node.mass > 0.0)
                .count(),
            members: stick_model.members.len(),
            hinges: stick_model.hinges.len(),
            springs: stick_model.springs.len(),
            degrees_of_freedom: equations.len(),
            stiffness_entries: equations.len() + equations.stiffness.values.len(),
            couplings: RiccatiSweep::new(building).entries_of_l(),
            product_unknowns: ProductEquations::new(building).unknowns(),
            yields: !equations.springs.is_empty(),
            accuracy: SURVEYED_STEPS
                .iter()
                .map(|step| accuracy(building, *step))
                .collect::<Result<_, _>>()?,
        })
    }
}

fn accuracy(building: &BuildingSystem, step: f64) -> Result<StepAccuracy, NotPositive> {
    let coefficients = Integrator::default()
        .coefficients(step)
        .of_building(&building.equations);
    let matrix = coefficients.matrix();
    let load = uneven_load(building);
    let reference = solve_once::<DirectStiffness>(building, &matrix, &load)?;
    let error = |answer: Result<Vec<f64>, NotPositive>| {
        answer.map_or(f64::INFINITY, |y| relative_error(&y, &reference))
    };
    Ok(StepAccuracy {
        step,
        product: error(solve_once::<ProductEquations>(building, &matrix, &load)),
        product_digits_expected: digits_left(building, &matrix),
        elementwise: error(solve_once::<ElementwiseRiccati>(building, &matrix, &load)),
        riccati: error(solve_once::<RiccatiSweep>(building, &matrix, &load)),
    })
}

/// Forces on all masses, of equal magnitude and irregular sign, the same for every survey.
fn uneven_load(building: &BuildingSystem) -> Vec<f64> {
    let masses = building.equations.mass.iter().enumerate();
    masses
        .map(|(dof, mass)| {
            if *mass > 0.0 {
                1e4 * libm::sin(12.9898 * dof as f64 + 0.5)
            } else {
                0.0
            }
        })
        .collect()
}

fn relative_error(answer: &[f64], reference: &[f64]) -> f64 {
    let largest = reference
        .iter()
        .fold(0.0_f64, |largest, y| largest.max(y.abs()));
    let errors = answer
        .iter()
        .zip(reference)
        .map(|(y, exact)| (y - exact).abs());
    errors.fold(0.0, |worst: f64, error| {
        if error.is_nan() {
            f64::INFINITY
        } else {
            worst.max(error / largest)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Building, Damping, Shear, Structure};
    use crate::structure::Discretization;

    #[test]
    fn a_not_a_number_is_no_agreement() {
        assert_eq!(relative_error(&[1.0, f64::NAN], &[1.0, 2.0]), f64::INFINITY);
        assert_eq!(relative_error(&[1.0, 3.0], &[1.0, 2.0]), 0.5);
    }

    #[test]
    fn all_ways_agree_on_a_short_shear_building() {
        let building = Building {
            name: "three".into(),
            structure: Structure::Shear(Shear {
                mass: vec![4e4; 3],
                stiffness: vec![6e7; 3],
                storey_heights: vec![3.0; 3],
            }),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: 0.0,
            },
            ..Building::default()
        };
        let survey = MethodSurvey::new(&BuildingSystem::new(
            "three",
            Discretization::new(&building),
        ))
        .expect("it stands");
        assert_eq!(
            (survey.degrees_of_freedom, survey.springs, survey.couplings),
            (3, 3, 2)
        );
        let first = survey.accuracy[0];
        assert!(
            first.product < 1e-13 && first.elementwise < 1e-13 && first.riccati < 1e-14,
            "{first:?}"
        );
    }
}
