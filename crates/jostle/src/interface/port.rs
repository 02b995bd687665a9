//! The two points of a contact or a link: one on either side, on a building or on a rigid wall.

use super::DofRow;
use crate::contact::effective_mass;

/// A point of a building that can be pushed in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Port {
    /// Index of the building.
    pub building: usize,
    /// Its displacement along the direction, over the vectors of a [`crate::State`].
    pub row: DofRow,
    /// Mass that moves with it, > 0 \[kg\].
    pub mass: f64,
    /// Floor, from 1; `None` for a point between floors.
    pub floor: Option<usize>,
    /// Height above the base \[m\].
    pub height: f64,
}

/// The left and the right point; `None` is a rigid wall, which moves with the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PortPair(pub [Option<Port>; 2]);

impl PortPair {
    /// Left minus right of a displacement, velocity or acceleration of all degrees of freedom: positive when the
    /// points approach.
    #[must_use]
    #[inline]
    pub fn closing(&self, values: &[f64]) -> f64 {
        let [left, right] = self.0;
        left.map_or(0.0, |port| port.row.value(values))
            - right.map_or(0.0, |port| port.row.value(values))
    }

    /// Adds a force that separates the two sides to a load on all degrees of freedom \[N\].
    #[inline]
    pub fn push_apart(&self, force: f64, load: &mut [f64]) {
        for (port, sign) in self.sides() {
            port.row.push(sign * force, load);
        }
    }

    /// The points on buildings, with the direction of the contact force on them: −1 left, 1 right.
    #[inline]
    pub fn sides(&self) -> impl Iterator<Item = (Port, f64)> + use<> {
        let [left, right] = self.0;
        [left.map(|port| (port, -1.0)), right.map(|port| (port, 1.0))]
            .into_iter()
            .flatten()
    }

    /// Left and right mass; that of a wall is infinite \[kg\].
    #[must_use]
    pub fn masses(&self) -> [f64; 2] {
        self.0.map(|port| port.map_or(f64::INFINITY, |f| f.mass))
    }

    /// m₁m₂/(m₁ + m₂); beside a wall that of the building \[kg\].
    #[must_use]
    pub fn effective_mass(&self) -> f64 {
        let [left, right] = self.masses();
        effective_mass(left, right)
    }

    /// Left and right building.
    #[must_use]
    pub fn buildings(&self) -> [Option<usize>; 2] {
        self.0.map(|port| port.map(|f| f.building))
    }

    /// Left and right floor, from 1; `None` between floors and at a wall.
    #[must_use]
    pub fn floors(&self) -> [Option<usize>; 2] {
        self.0.map(|port| port.and_then(|f| f.floor))
    }

    /// Whether a side is a point of a building between its floors.
    #[must_use]
    pub fn are_between_floors(&self) -> bool {
        let sides = self.buildings().into_iter().zip(self.floors());
        sides
            .into_iter()
            .any(|(building, floor)| building.is_some() && floor.is_none())
    }

    /// Height above the base, midway where both sides differ \[m\].
    #[must_use]
    pub fn height(&self) -> f64 {
        match self.0.map(|port| port.map(|f| f.height)) {
            [Some(left), Some(right)] => 0.5 * (left + right),
            [one, other] => one.or(other).unwrap_or(0.0),
        }
    }
}
