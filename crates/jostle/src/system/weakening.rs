//! Shear strength of columns that falls with the ductility of their hinges.

use super::rating::MemberHinge;
use crate::hysteresis::HysteresisMemory;
use crate::model::{Building, CapacityLine, Hinges};
use crate::structure::{AssembledBuilding, MemberPlace, SpringPlace};

/// A column whose shear strength falls with the ductility of its hinges.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Weakening {
    /// Its shear springs, among those of the building.
    shear: Vec<usize>,
    hinges: Vec<MemberHinge>,
    /// Strength against ductility \[N, –\].
    strength: CapacityLine,
}

impl Weakening {
    /// Every such column of a building.
    pub(super) fn all(model: &Building, building: &AssembledBuilding) -> Vec<Self> {
        let Some(Hinges::Frame(hinges)) = &model.hinges else {
            return Vec::new();
        };
        let rows = hinges.shear.iter().enumerate();
        let columns = rows.flat_map(|(storey, row)| {
            let lines = row.iter().enumerate();
            lines.map(move |(line, column)| (storey + 1, line + 1, column))
        });
        let weakening = columns.filter(|(.., column)| !column.by_ductility.points().is_empty());
        weakening
            .map(|(storey, line, column)| {
                let places = building.discretization.spring_places.iter().enumerate();
                let places = places.filter(|(_, place)| match place {
                    SpringPlace::Shear {
                        storey: at,
                        line: on,
                        ..
                    } => (storey, line) == (*at, *on),
                    _ => false,
                });
                Self {
                    shear: places.map(|(spring, _)| spring).collect(),
                    hinges: MemberHinge::of_member(
                        building,
                        None,
                        MemberPlace::Column { line, storey },
                    ),
                    strength: column.by_ductility.clone(),
                }
            })
            .filter(|column| !column.hinges.is_empty())
            .collect()
    }

    /// Lowers the strength of the shear springs to that at the ductility so far. `memories`: those of the springs of the
    /// building.
    pub(crate) fn apply(&self, building: &AssembledBuilding, memories: &mut [HysteresisMemory]) {
        let hinges = self.hinges.iter();
        let ductility = hinges
            .map(|hinge| hinge.ductility(building, memories))
            .fold(1.0, f64::max);
        let strength = self.strength.at(ductility);
        for &spring in &self.shear {
            building.equations.springs[spring]
                .hysteresis
                .weaken(&mut memories[spring], strength);
        }
    }
}
