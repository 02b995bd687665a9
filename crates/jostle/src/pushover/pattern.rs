//! Distribution of a horizontal load over the height.

use crate::linear::Row;
use crate::model::LEVEL_TOLERANCE;
use crate::structure::Node;
use crate::structure::element::X;
use crate::system::BuildingSystem;

/// Shape of the horizontal load of a pushover.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum LoadPattern {
    /// Mass times the shape of the first mode along the row, uncracked.
    #[default]
    FirstMode,
    /// Mass.
    Uniform,
    /// Mass times height above the base.
    Triangular,
}

impl LoadPattern {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::FirstMode, Self::Uniform, Self::Triangular];

    /// Name on the command line and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FirstMode => "first-mode",
            Self::Uniform => "uniform",
            Self::Triangular => "triangular",
        }
    }

    /// Horizontal force at every degree of freedom of a building, of sum one \[–\]. It acts at the floors; masses
    /// of columns between floors are divided between the floors above and below by the lever rule.
    ///
    /// `None` when there is no such mode or no mass.
    #[must_use]
    pub fn forces(self, building: &BuildingSystem) -> Option<Vec<f64>> {
        let equations = &building.equations;
        // Of a building in plan, the first mode may move across.
        let mode = building.lateral_modes().find(|mode| mode.is_along());
        let shape = match self {
            Self::FirstMode => Some(mode?),
            _ => None,
        };
        let mut forces = vec![0.0; equations.len()];
        for (node, mass) in floor_masses(building).into_iter().enumerate() {
            let moved = moved_along(building, node);
            let factor = match (self, shape) {
                (Self::FirstMode, Some(mode)) => moved.value(&mode.shape),
                (Self::Triangular, _) => building.discretization.stick_model.nodes[node].y,
                _ => 1.0,
            };
            moved.push(mass * factor, &mut forces);
        }
        let sum: f64 = forces.iter().sum();
        if !(sum.is_finite() && sum != 0.0) {
            return None;
        }
        for force in &mut forces {
            *force /= sum;
        }
        Some(forces)
    }
}

/// Mass that a uniform load acts on: all above the base \[kg\].
pub(super) fn loaded_mass(building: &BuildingSystem) -> f64 {
    let masses = floor_masses(building).into_iter().enumerate();
    let loaded = masses.filter(|(node, _)| !moved_along(building, *node).is_empty());
    loaded.map(|(_, mass)| mass).sum()
}

/// How a node above the base moves along the row, or along its frame, over the displacements of the building: joints of frames at lines
/// with their floor. Empty below.
fn moved_along(building: &BuildingSystem, node: usize) -> Row {
    let stick_model = &building.discretization.stick_model;
    match stick_model.nodes[node].y > LEVEL_TOLERANCE {
        true => {
            let carried = stick_model.carried((node, X));
            building.equations.row(&carried)
        }
        false => Row::default(),
    }
}

/// Mass of every node that is driven along its direction, those between floors moved to the nodes above and below on the same line \[kg\].
fn floor_masses(building: &BuildingSystem) -> Vec<f64> {
    let stick_model = &building.discretization.stick_model;
    let nodes = &stick_model.nodes;
    let elevation = |node: usize| stick_model.turn(node).elevation;
    let levels: Vec<f64> = std::iter::once(0.0)
        .chain(building.floors.iter().map(|floor| floor.height))
        .collect();
    let close = |a: f64, b: f64| (a - b).abs() <= LEVEL_TOLERANCE;
    let along = |node: &Node| node.inertia[X] * node.influence[X].along;
    let mut masses: Vec<f64> = nodes.iter().map(along).collect();
    for (index, node) in nodes.iter().enumerate() {
        if levels.iter().any(|level| close(*level, node.y)) {
            continue;
        }
        let above = levels.iter().position(|level| *level > node.y);
        let Some(above) = above.filter(|above| *above > 0) else {
            continue;
        };
        let (low, high) = (levels[above - 1], levels[above]);
        let at = |height: f64| {
            let above =
                |other: &usize| close(nodes[*other].y, height) && close(nodes[*other].x, node.x);
            (0..nodes.len()).find(|other| above(other) && elevation(*other) == elevation(index))
        };
        let mass = std::mem::take(&mut masses[index]);
        let share = (node.y - low) / (high - low);
        for (height, part) in [(low, 1.0 - share), (high, share)] {
            if let Some(place) = at(height) {
                masses[place] += part * mass;
            }
        }
    }
    masses
}
