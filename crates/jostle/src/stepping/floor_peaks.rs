//! Peaks of floors, as steppers that know the motion between the ends of steps follow them.

use crate::history::{Column, Extreme, Kind, Owner, Peak};
use crate::system::{BuildingSystem, Direction};

/// Peak response of one floor in one direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FloorPeaks {
    /// Greatest displacement to the right \[m\].
    pub(super) displacement_max: Extreme,
    /// Greatest displacement to the left, ≤ 0 \[m\].
    pub(super) displacement_min: Extreme,
    /// Greatest total acceleration, either sign \[m/s²\].
    pub(super) total_acceleration: f64,
    /// Greatest drift ratio of the storey below, either sign \[–\].
    pub(super) storey_drift: f64,
    /// Greatest shear of the storey below, either sign \[N\].
    pub(super) storey_shear: f64,
    /// Greatest overturning moment about the base of the storey below, either sign \[N·m\].
    pub(super) overturning_moment: f64,
    /// Greatest vertical displacement of any mass of the floor, either sign \[m\].
    pub(super) vertical_displacement: f64,
}

impl FloorPeaks {
    /// Greatest displacement, either sign \[m\].
    pub(super) fn sway(&self) -> f64 {
        let least = self.displacement_min.value;
        self.displacement_max.value.max(-least)
    }
}

/// Peaks of a building for the list of its run, from those of its [`tracks`](BuildingSystem::tracks).
pub(super) fn columns_of(
    index: usize,
    building: &BuildingSystem,
    floors: &[FloorPeaks],
) -> Vec<(Column, Peak)> {
    let tracks = building.tracks.iter().zip(floors).enumerate();
    let of_track = tracks.map(|(place, (track, peaks))| {
        let (owner, direction) = (floor_of(index, building, place), track.direction);
        let displacement = Peak {
            greatest: peaks.displacement_max,
            least: peaks.displacement_min,
        };
        [
            (Kind::Displacement, direction, displacement),
            (
                Kind::Displacement,
                Direction::Up,
                Peak::of_size(peaks.vertical_displacement),
            ),
            (
                Kind::Acceleration,
                direction,
                Peak::of_size(peaks.total_acceleration),
            ),
            (Kind::Drift, direction, Peak::of_size(peaks.storey_drift)),
            (Kind::Shear, direction, Peak::of_size(peaks.storey_shear)),
            (
                Kind::Moment,
                direction,
                Peak::of_size(peaks.overturning_moment),
            ),
        ]
        .map(|(kind, direction, peak)| (Column::new(owner, kind, direction), peak))
    });
    of_track.flatten().collect()
}

/// Peaks of the corners of a building in space, from the ground up, for the list of its run.
pub(super) fn columns_of_corners(
    building: usize,
    kind: Kind,
    sizes: impl Iterator<Item = f64>,
) -> impl Iterator<Item = (Column, Peak)> {
    sizes.zip(1..).map(move |(size, floor)| {
        let column = Column::along(Owner::Floor { building, floor }, kind);
        (column, Peak::of_size(size))
    })
}

/// The floor of a building whose displacement stands at a place of its tracks.
pub(super) fn floor_of(building: usize, system: &BuildingSystem, place: usize) -> Owner {
    let floor = place % system.floors.len() + 1;
    Owner::Floor { building, floor }
}
