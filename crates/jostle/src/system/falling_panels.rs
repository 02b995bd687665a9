//! Infill panels that leave the model when their inertia force across their plane exceeds what they bear.

use super::building::Track;
use crate::hysteresis::HysteresisMemory;
use crate::linear::Row;
use crate::motion::Ground;
use crate::structure::AssembledBuilding;

/// A panel of a building, with all its struts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FallingPanel {
    /// Its struts, among the springs of the building.
    pub(crate) struts: Vec<usize>,
    /// Acceleration at which it falls, of either sign \[m/s²\].
    pub(crate) limit: f64,
    /// What is below and above it.
    sides: [Held; 2],
}

/// What holds a panel along an edge.
#[derive(Clone, Debug, PartialEq)]
struct Held {
    /// Its motion against the ground across the plane of the panel, over displacements of the building.
    across: Row,
    /// Part of the ground acceleration along x and across in that of the plane.
    ground: [f64; 2],
}

impl FallingPanel {
    /// Every such panel of a building. `tracks`: displacements of its floors, from the ground up, along x and then across; `mat`: that of
    /// its mat.
    pub(super) fn all(
        building: &AssembledBuilding,
        tracks: &[Track],
        mat: Option<usize>,
    ) -> Vec<Self> {
        let discretization = &building.discretization;
        let (floors, in_plan) = (
            discretization.floors.len(),
            !discretization.centres.is_empty(),
        );
        let mut panels: Vec<(_, Self)> = Vec::new();
        for diagonal in &discretization.diagonals {
            let strut = discretization.spring_of_diagonal(diagonal);
            let (Some(panel), Some(strut)) = (diagonal.across.filter(|panel| panel.falls), strut)
            else {
                continue;
            };
            let place = diagonal.place;
            let bay = (diagonal.frame, place.line, place.storey, place.bay);
            if let Some((_, known)) = panels.iter_mut().find(|(known, _)| *known == bay) {
                known.struts.push(strut);
                known.limit = known.limit.min(panel.limit());
                continue;
            }
            // In one plane the motion along the row is taken for that across it.
            let [along, across] = diagonal.direction;
            let normal = match in_plan {
                true => [-across, along],
                false => [1.0, 0.0],
            };
            let floor = |floor: usize| {
                let directions = normal.iter().enumerate();
                let moving = directions.filter(|(_, part)| **part != 0.0);
                let across = moving.map(|(direction, part)| {
                    let track = &tracks[direction * floors + floor];
                    (track.dof, *part)
                });
                Held {
                    across: across.collect(),
                    ground: normal,
                }
            };
            let below = match place.storey - 1 {
                // Panels of the lowest storey are compared with their floor alone.
                0 if in_plan => Held {
                    across: Row::default(),
                    ground: [0.0; 2],
                },
                0 => Held {
                    across: mat.map(Row::single).unwrap_or_default(),
                    ground: normal,
                },
                storey => floor(storey - 1),
            };
            let panel = Self {
                struts: vec![strut],
                limit: panel.limit(),
                sides: [below, floor(place.storey - 1)],
            };
            panels.push((bay, panel));
        }
        panels.into_iter().map(|(_, panel)| panel).collect()
    }

    /// Whether it still stands. `memories`: those of the springs of its building.
    pub(crate) fn stands(&self, memories: &[HysteresisMemory]) -> bool {
        self.struts.iter().any(|strut| !memories[*strut].is_gone())
    }

    /// Total accelerations across its plane of what is below and above it \[m/s²\]. `relative`: that of a displacement of its building
    /// against the ground.
    pub(crate) fn accelerations(
        &self,
        ground: Ground,
        relative: impl Fn(usize) -> f64,
    ) -> [f64; 2] {
        self.sides.each_ref().map(
            |Held {
                 across,
                 ground: [along, aside],
             }| { across.value_of(&relative) + along * ground[0] + aside * ground[1] },
        )
    }
}
