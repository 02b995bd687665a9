//! The two points of a contact or a link: one on either side, on a building or on a rigid wall.

use crate::contact::effective_mass;
use crate::linear::Row;

/// A point of a building that can be pushed in one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    /// Index of the building.
    pub building: usize,
    /// Its displacement along the direction, over the vectors of a [`crate::State`].
    pub row: Row,
    /// Mass that moves with it, > 0 \[kg\].
    pub mass: f64,
    /// Floor, from 1; `None` for a point between floors.
    pub floor: Option<usize>,
    /// Height above the base of the building \[m\].
    pub height: f64,
    /// Height above the common datum \[m\].
    pub level: f64,
}

impl Port {
    /// Whether it is the node that alone has this displacement, over the vectors of a [`crate::State`]; floors in plan move with
    /// several.
    #[must_use]
    pub fn is_at(&self, dof: usize) -> bool {
        let entries = self.row.entries();
        match self.floor {
            Some(_) => *entries == [(dof, 1.0)],
            None => entries
                .iter()
                .any(|(place, share)| *place == dof && *share != 0.0),
        }
    }
}

/// The left and the right point; `None` is a rigid wall, which moves with the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct PortPair(pub [Option<Port>; 2]);

impl PortPair {
    /// Left minus right of a displacement, velocity or acceleration of all degrees of freedom: positive when the
    /// points approach.
    #[must_use]
    #[inline]
    pub fn closing(&self, values: &[f64]) -> f64 {
        let [left, right] = &self.0;
        let moved = |port: &Option<Port>| port.as_ref().map_or(0.0, |port| port.row.value(values));
        moved(left) - moved(right)
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
    pub fn sides(&self) -> impl Iterator<Item = (&Port, f64)> {
        let sides = self.0.iter().zip([-1.0, 1.0]);
        sides.filter_map(|(port, sign)| Some((port.as_ref()?, sign)))
    }

    fn of_both<T>(&self, number: impl Fn(&Port) -> T) -> [Option<T>; 2] {
        self.0.each_ref().map(|port| port.as_ref().map(&number))
    }

    /// Left and right mass; that of a wall is infinite \[kg\].
    #[must_use]
    pub fn masses(&self) -> [f64; 2] {
        let masses = self.of_both(|port| port.mass);
        masses.map(|mass| mass.unwrap_or(f64::INFINITY))
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
        self.of_both(|port| port.building)
    }

    /// Left and right floor, from 1; `None` between floors and at a wall.
    #[must_use]
    pub fn floors(&self) -> [Option<usize>; 2] {
        self.of_both(|port| port.floor).map(Option::flatten)
    }

    /// Whether a side is a point of a building between its floors.
    #[must_use]
    pub fn are_between_floors(&self) -> bool {
        let sides = self.buildings().into_iter().zip(self.floors());
        sides
            .into_iter()
            .any(|(building, floor)| building.is_some() && floor.is_none())
    }

    /// Height above the common datum, midway where both sides differ \[m\].
    #[must_use]
    pub fn height(&self) -> f64 {
        match self.of_both(|port| port.level) {
            [Some(left), Some(right)] => 0.5 * (left + right),
            [one, other] => one.or(other).unwrap_or(0.0),
        }
    }
}
