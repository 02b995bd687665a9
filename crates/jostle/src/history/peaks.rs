//! Peaks of a run: one list, by owner, kind and direction.

use super::{Column, Extreme, Kind, Owner};
use crate::system::Direction;

/// Greatest and least value of a quantity over a run, with their instants. Of what is known by its magnitude, the greatest is that; of
/// energies, it is what has added up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// Greatest value, ≥ 0.
    pub greatest: Extreme,
    /// Least value, ≤ 0.
    pub least: Extreme,
}

impl Peak {
    /// Of a magnitude or an energy.
    #[must_use]
    pub fn of_size(size: f64) -> Self {
        Self {
            greatest: Extreme {
                value: size,
                at: 0.0,
            },
            ..Self::default()
        }
    }

    /// Greatest magnitude, either sign.
    #[must_use]
    pub fn size(&self) -> f64 {
        self.greatest.value.max(self.least.value.abs())
    }

    /// The value of greatest magnitude, with its sign and instant.
    #[must_use]
    pub fn furthest(&self) -> Extreme {
        if -self.least.value > self.greatest.value {
            self.least
        } else {
            self.greatest
        }
    }

    /// Takes in a value by its magnitude.
    #[inline]
    pub(crate) fn widen(&mut self, value: f64) {
        self.greatest.value = self.greatest.value.max(value.abs());
    }
}

impl From<Extreme> for Peak {
    /// The value is the greatest or the least, by its sign.
    fn from(extreme: Extreme) -> Self {
        let none = Extreme::default();
        match extreme.value < 0.0 {
            true => Self {
                greatest: none,
                least: extreme,
            },
            false => Self {
                greatest: extreme,
                least: none,
            },
        }
    }
}

/// All peaks of a run, in the order of their columns.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{Column, Settings, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
/// let roof = outcome.peaks.floor(0, 3);
/// assert!(roof.storey_drift() > 0.0);
/// assert_eq!(roof.displacement(), outcome.peaks.of(Column::displacement(0, 3)));
/// assert_eq!(outcome.peaks.get(Column::displacement(0, 4)), None); // three floors
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Peaks(Vec<(Column, Peak)>);

impl Peaks {
    /// The peak of a quantity; `None` if no run of this kind follows it.
    #[must_use]
    pub fn get(&self, column: Column) -> Option<Peak> {
        Some(self.0[self.place(column)?].1)
    }

    /// The peak of a quantity; zero where it is not followed.
    #[must_use]
    pub fn of(&self, column: Column) -> Peak {
        self.get(column).unwrap_or_default()
    }

    /// All quantities with their peaks.
    pub fn iter(&self) -> impl Iterator<Item = (Column, Peak)> + '_ {
        self.0.iter().copied()
    }

    /// Sizes of the peaks of all quantities that are wanted, in the order of the list.
    #[must_use]
    pub fn sizes(&self, wanted: impl Fn(Column) -> bool) -> Vec<f64> {
        let peaks = self.iter().filter(|(column, _)| wanted(*column));
        peaks.map(|(_, peak)| peak.size()).collect()
    }

    /// Peaks of a floor, from 1, along the row; 0 is a mat or a wall.
    #[must_use]
    pub fn floor(&self, building: usize, floor: usize) -> PeaksOf<'_> {
        self.owned_by(Owner::Floor { building, floor })
    }

    /// Peaks of an owner along the row.
    #[must_use]
    pub fn owned_by(&self, owner: Owner) -> PeaksOf<'_> {
        PeaksOf {
            peaks: self,
            owner,
            direction: Direction::Along,
        }
    }

    /// Peaks of the floors of a building along the row, from the ground up, without the mat.
    #[must_use]
    pub fn floors(&self, building: usize) -> Vec<PeaksOf<'_>> {
        let floors = (1..).map(|floor| self.floor(building, floor));
        let known = |peaks: &PeaksOf<'_>| self.place(peaks.column(Kind::Displacement)).is_some();
        floors.take_while(known).collect()
    }

    /// The same of every building with floors.
    pub fn buildings(&self) -> impl Iterator<Item = Vec<PeaksOf<'_>>> {
        let floors = (0..).map(|building| self.floors(building));
        floors.take_while(|floors| !floors.is_empty())
    }

    /// Greatest elastic base shear of a building \[N\].
    #[must_use]
    pub fn base_shear(&self, building: usize) -> f64 {
        let building = Owner::Building(building);
        self.of(Column::along(building, Kind::Shear)).size()
    }

    /// Greatest closing of a contact of the system, u_left − u_right \[m\].
    #[must_use]
    pub fn closing(&self, contact: usize) -> Extreme {
        self.of(Column::closing(contact)).greatest
    }

    /// Greatest sum of the contact forces of a gap at one instant \[N\].
    #[must_use]
    pub fn gap_force(&self, gap: usize) -> Extreme {
        self.of(Column::along(Owner::Gap(gap), Kind::Force))
            .greatest
    }

    /// Energy that the dashpots of an owner have taken, or work done on it \[J\].
    #[must_use]
    pub fn work(&self, owner: Owner) -> f64 {
        self.of(Column::along(owner, Kind::Work)).greatest.value
    }

    /// Greatest displacement along the row of a floor of a building, or of all above the ground \[m\].
    #[must_use]
    pub fn sway(&self, building: usize, floor: Option<usize>) -> f64 {
        match floor {
            Some(floor) => self.floor(building, floor).displacement().size(),
            None => {
                let floors = self.floors(building).into_iter();
                floors
                    .map(|floor| floor.displacement().size())
                    .fold(0.0, f64::max)
            }
        }
    }

    /// Where the peak of a quantity stands.
    fn place(&self, column: Column) -> Option<usize> {
        self.0
            .binary_search_by_key(&column, |(candidate, _)| *candidate)
            .ok()
    }
}

impl FromIterator<(Column, Peak)> for Peaks {
    /// Of columns that are given several times, the first counts.
    fn from_iter<I: IntoIterator<Item = (Column, Peak)>>(peaks: I) -> Self {
        let mut list = Self::default();
        list.extend(peaks);
        list
    }
}

impl Extend<(Column, Peak)> for Peaks {
    fn extend<I: IntoIterator<Item = (Column, Peak)>>(&mut self, peaks: I) {
        self.0.extend(peaks);
        crate::linear::sort_by_key(&mut self.0, |(column, _)| *column);
        self.0.dedup_by_key(|(column, _)| *column);
    }
}

/// Peaks of one owner in one direction, by name.
#[derive(Clone, Copy, Debug)]
pub struct PeaksOf<'a> {
    peaks: &'a Peaks,
    owner: Owner,
    direction: Direction,
}

impl PeaksOf<'_> {
    /// The same owner in another direction.
    #[must_use]
    pub fn to(self, direction: Direction) -> Self {
        Self { direction, ..self }
    }

    /// The same owner across the row.
    #[must_use]
    pub fn across(self) -> Self {
        self.to(Direction::Across)
    }

    /// The same owner in rotation.
    #[must_use]
    pub fn turning(self) -> Self {
        self.to(Direction::Turning)
    }

    /// The key of a quantity.
    #[must_use]
    pub fn column(&self, kind: Kind) -> Column {
        Column::new(self.owner, kind, self.direction)
    }

    /// Whether runs follow the owner in this direction.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.peaks.place(self.column(Kind::Displacement)).is_some()
    }

    /// The peak of a kind; zero where it is not followed.
    #[must_use]
    pub fn of(&self, kind: Kind) -> Peak {
        self.peaks.of(self.column(kind))
    }

    /// Greatest and least displacement \[m, rad\].
    #[must_use]
    pub fn displacement(&self) -> Peak {
        self.of(Kind::Displacement)
    }

    /// Greatest displacement to the right \[m, rad\].
    #[must_use]
    pub fn displacement_max(&self) -> Extreme {
        self.displacement().greatest
    }

    /// Greatest displacement to the left, ≤ 0 \[m, rad\].
    #[must_use]
    pub fn displacement_min(&self) -> Extreme {
        self.displacement().least
    }

    /// Greatest total acceleration, either sign \[m/s², rad/s²\].
    #[must_use]
    pub fn total_acceleration(&self) -> f64 {
        self.of(Kind::Acceleration).size()
    }

    /// The same after a low-pass filter; `None` if it was not computed \[m/s²\].
    #[must_use]
    pub fn filtered_acceleration(&self) -> Option<f64> {
        let peak = self.peaks.get(self.column(Kind::FilteredAcceleration))?;
        Some(peak.size())
    }

    /// Greatest drift ratio of the storey below, either sign \[–, rad/m\].
    #[must_use]
    pub fn storey_drift(&self) -> f64 {
        self.of(Kind::Drift).size()
    }

    /// Greatest shear of the storey below, either sign; of rotations, torque \[N, N·m\].
    #[must_use]
    pub fn storey_shear(&self) -> f64 {
        self.of(Kind::Shear).size()
    }

    /// Greatest overturning moment about the base of the storey below, either sign \[N·m\].
    #[must_use]
    pub fn overturning_moment(&self) -> f64 {
        self.of(Kind::Moment).size()
    }

    /// Greatest vertical displacement of any mass of the floor, either sign; followed under vertical shaking only \[m\].
    #[must_use]
    pub fn vertical_displacement(&self) -> f64 {
        self.to(Direction::Up).displacement().size()
    }

    /// Greatest horizontal displacement of a corner, of buildings in space \[m\].
    #[must_use]
    pub fn corner_displacement(&self) -> f64 {
        let along = self.to(Direction::Along);
        along.of(Kind::CornerDisplacement).size()
    }

    /// Greatest drift ratio of the storey below at a corner of the smaller of both plans, along x and across together, of buildings in
    /// space \[–\].
    #[must_use]
    pub fn corner_drift(&self) -> f64 {
        self.to(Direction::Along).of(Kind::CornerDrift).size()
    }
}
