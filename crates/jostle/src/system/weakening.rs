//! Shear strength of columns that falls with the ductility of their hinges.

use super::rating::MemberHinge;
use crate::hysteresis::HysteresisMemory;
use crate::model::{Building, CapacityLine, FrameHinges, Hinges, Structure};
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
        let mut columns = Vec::new();
        let mut add = |frame: Option<usize>, hinges: &FrameHinges| {
            for (storey, row) in hinges.shear.iter().enumerate() {
                for (line, shear) in row.iter().enumerate() {
                    let (line, storey) = (line + 1, storey + 1);
                    let member = MemberPlace::Column { line, storey };
                    columns.push((frame, member, None, shear.by_ductility.clone()));
                }
            }
        };
        match (&model.hinges, &model.structure) {
            (Some(Hinges::Frame(hinges)), _) => add(None, hinges),
            (_, Structure::Tiers(tiers)) => {
                for (frame, plan_frame) in tiers.frames.iter().enumerate() {
                    add(Some(frame), &plan_frame.hinges);
                }
                let in_space = tiers.space_frame.iter().flat_map(|frame| &frame.shear);
                columns.extend(in_space.map(|((place, axis), shear)| {
                    let member = MemberPlace::InSpace(*place);
                    (None, member, Some(*axis), shear.by_ductility.clone())
                }));
            }
            _ => return Vec::new(),
        }
        let weakening = columns.into_iter();
        let weakening = weakening.filter(|(.., line)| !line.points().is_empty());
        let weakening = weakening.map(|(frame, member, axis, strength)| {
            let places = &building.discretization.spring_places;
            let shears = |place: &SpringPlace| match *place {
                SpringPlace::Shear {
                    frame: of,
                    member: on,
                    axis: along,
                    ..
                } => (of, on, along) == (frame.map(|frame| frame + 1), member, axis),
                _ => false,
            };
            let shear = places.iter().enumerate().filter(|(_, place)| shears(place));
            let mut hinges = MemberHinge::of_member(building, frame, member);
            // Of a column that bends in two planes, those that yield as it slides.
            hinges.retain(|hinge| match places[hinge.spring()] {
                SpringPlace::InSpace { axis: own, .. } => axis == Some(own),
                SpringPlace::Struck { axis: own, .. } => axis == own,
                _ => true,
            });
            Self {
                shear: shear.map(|(spring, _)| spring).collect(),
                hinges,
                strength,
            }
        });
        weakening
            .filter(|column| !column.hinges.is_empty() && !column.shear.is_empty())
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
