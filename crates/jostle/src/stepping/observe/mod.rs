//! Peaks of direct runs, taken after every accepted step.

#[cfg(test)]
mod tests;
mod watch;
mod watches;

use std::collections::BTreeMap;

use super::acceleration_parts::AccelerationParts;
use super::floor_peaks::{columns_of_corners, floor_of};
use super::plan_drifts::PlanDrifts;
use super::sharp_peaks::SharpPeaks;
use crate::history::{Column, Kind, Owner, Peak, Peaks};
use crate::motion::Ground;
use crate::state::State;
use crate::system::{BuildingSystem, Direction, GroundsAt, RunGrounds, System};
use watch::{Watch, watches};
use watches::Watches;

/// Follows all that is reported of a direct run.
pub(crate) struct Observer {
    columns: Vec<Column>,
    /// One for every column.
    peaks: Vec<Peak>,
    /// Numbers over displacements.
    watches: Watches,
    /// What follows from accelerations and forces, building by building.
    buildings: Vec<OfBuilding>,
    /// Drifts in space, building by building.
    drifts: Vec<PlanDrifts>,
    pub(crate) parts: AccelerationParts,
    sharp: SharpPeaks,
}

/// Places of the peaks of a building that follow from accelerations and forces.
struct OfBuilding {
    /// Displacements of its floors, and that of its mat or wall along the row.
    accelerations: Vec<Accelerated>,
    /// How many of these are of floors.
    floors: usize,
    /// Drift, shear and moment of the storey below every displacement of its floors.
    storeys: Vec<[usize; 3]>,
    /// Storeys, from 0, and their drifts along x and across.
    drifts: Vec<[usize; 2]>,
    base_shear: usize,
    /// Force of bearings or of the spring of a wall.
    support: Option<usize>,
    mat: Option<OfMat>,
}

/// A displacement whose total acceleration is followed.
struct Accelerated {
    dof: usize,
    /// How much it sees of the ground acceleration along the row, across and upwards \[–\].
    ground: [f64; 3],
    place: usize,
}

impl Accelerated {
    /// What a ground acceleration adds to its total acceleration \[m/s²\].
    fn moved_by(&self, ground: Ground) -> f64 {
        let all = self.ground.into_iter().zip(ground);
        all.map(|(share, component)| share * component).sum()
    }
}

/// Places of the peaks of a mat in plan.
struct OfMat {
    across: Accelerated,
    force_across: usize,
    base_shear_across: usize,
    base_torque: usize,
    ring: usize,
}

/// What peaks follow from at the end of a step.
#[derive(Clone, Copy)]
pub(crate) struct Reached<'a> {
    pub(crate) state: &'a State,
    /// Forces of links \[N\].
    pub(crate) links: &'a [f64],
    pub(crate) grounds: &'a RunGrounds<'a>,
    /// Ground accelerations.
    pub(crate) ground: GroundsAt<'a>,
}

impl Observer {
    /// For a run that lasts `duration` \[s\]; `rises`: masses move vertically and start from this state.
    pub(crate) fn new(system: &System, duration: f64, rises: Option<&State>) -> Self {
        let mut watching = Self::watching(system, duration, watches(system, rises.is_some()));
        if let Some(state) = rises {
            watching.watches.start(state, &mut watching.peaks);
        }
        watching
    }

    /// Follows what is given, and accelerations and forces.
    fn watching(system: &System, duration: f64, watches: Vec<Watch>) -> Self {
        let mut places = Places::default();
        let watches = Watches::new(watches, &mut places);
        let buildings = system.buildings.iter().enumerate();
        let buildings =
            buildings.map(|(index, building)| OfBuilding::new(index, building, &mut places));
        let buildings = buildings.collect();
        let floors = system
            .buildings
            .iter()
            .map(|building| building.tracks.len())
            .sum();
        let Places { columns, .. } = places;
        Self {
            peaks: vec![Peak::default(); columns.len()],
            columns,
            watches,
            buildings,
            drifts: (system.buildings.iter())
                .map(|building| PlanDrifts::new(building, |dof| dof))
                .collect(),
            parts: AccelerationParts::new(floors, duration),
            sharp: SharpPeaks::new(system, floors + system.buildings.len()),
        }
    }

    /// Stores what is followed at the start of a step.
    pub(crate) fn before_step(&mut self, system: &System, state: &State, grounds: &RunGrounds<'_>) {
        self.watches.before_step(system, state, grounds);
        let (u, v) = (&state.displacement, &state.velocity);
        for (drifts, building) in self.drifts.iter_mut().zip(&system.buildings) {
            drifts.before_step(&u[building.range()], &v[building.range()]);
        }
    }

    /// Updates peaks with the step that ended in `reached`.
    pub(crate) fn after_step(&mut self, system: &System, reached: &Reached<'_>, step: f64) {
        let state = reached.state;
        let start = state.time - step;
        let (u, v) = (&state.displacement, &state.velocity);
        let peaks = &mut self.peaks;
        self.watches
            .after_step(system, state, reached.grounds, peaks, step);
        self.follow_accelerations(reached, start);
        for (index, building) in system.buildings.iter().enumerate() {
            let (observed, peaks) = (&self.buildings[index], &mut self.peaks);
            observed.take_forces(building, reached, index, peaks);
            let drifts = &mut self.drifts[index];
            drifts.after_step(&u[building.range()], &v[building.range()], step);
            drifts.give_to(|track, drift| peaks[observed.storeys[track][0]].widen(drift));
        }
    }

    /// Total accelerations, also where they have a corner within the step.
    fn follow_accelerations(&mut self, reached: &Reached<'_>, start: f64) {
        let state = reached.state;
        self.parts.begin(start, state.time);
        self.sharp.begin(state.time);
        let mut floor_of_all = 0;
        for (index, building) in self.buildings.iter().enumerate() {
            let ground = reached.ground.of(index);
            for (track, accelerated) in building.accelerations.iter().enumerate() {
                let moved = accelerated.moved_by(ground);
                let total = state.acceleration[accelerated.dof] + moved;
                let greatest = &mut self.peaks[accelerated.place].greatest.value;
                *greatest = self.sharp.take(total, greatest.max(total.abs()));
                if track < building.floors {
                    self.parts.take(floor_of_all, total.abs());
                    floor_of_all += 1;
                }
            }
        }
    }

    /// Updates peaks with accelerations that have jumped.
    pub(crate) fn after_jump(&mut self, state: &State, grounds: GroundsAt<'_>) {
        self.sharp.forget();
        self.parts.begin_jump();
        let mut floor_of_all = 0;
        for (index, building) in self.buildings.iter().enumerate() {
            let ground = grounds.of(index);
            for accelerated in &building.accelerations[..building.floors] {
                let moved = accelerated.moved_by(ground);
                let total = state.acceleration[accelerated.dof] + moved;
                self.peaks[accelerated.place].widen(total);
                self.parts.take(floor_of_all, total.abs());
                floor_of_all += 1;
            }
        }
    }

    /// Drift ratios so far of the storeys of a building, from 0: along x and across, and in space at corners.
    pub(crate) fn drifts(&self, building: usize) -> impl Iterator<Item = (usize, f64)> {
        let lateral = self.buildings[building].drifts.iter();
        let lateral = lateral.map(|[storey, place]| (*storey, self.peaks[*place].greatest.value));
        lateral.chain(self.drifts[building].corners().enumerate())
    }

    /// All peaks of the run.
    pub(crate) fn finish(mut self) -> Peaks {
        self.watches.finish(&mut self.peaks);
        let corners = self.drifts.iter().enumerate();
        let corners = corners.flat_map(|(building, drifts)| {
            columns_of_corners(building, Kind::CornerDrift, drifts.corners())
        });
        let others = self.columns.into_iter().zip(self.peaks);
        others.chain(corners).collect()
    }
}

/// Places of columns in the lists of an observer, in the order in which they are asked for.
#[derive(Default)]
struct Places {
    columns: Vec<Column>,
    known: BTreeMap<Column, usize>,
}

impl Places {
    /// Where the peak of a column stands.
    fn of(&mut self, column: Column) -> usize {
        *self.known.entry(column).or_insert_with(|| {
            self.columns.push(column);
            self.columns.len() - 1
        })
    }
}

impl OfBuilding {
    fn new(index: usize, building: &BuildingSystem, places: &mut Places) -> Self {
        let mut at = |owner, kind, direction| places.of(Column::new(owner, kind, direction));
        let (mut accelerations, mut storeys, mut drifts) = (Vec::new(), Vec::new(), Vec::new());
        for (place, track) in building.tracks.iter().enumerate() {
            let owner = floor_of(index, building, place);
            let (dof, direction) = (track.dof, track.direction);
            accelerations.push(Accelerated {
                dof,
                ground: building.ground_shares(direction),
                place: at(owner, Kind::Acceleration, direction),
            });
            let kinds = [Kind::Drift, Kind::Shear, Kind::Moment];
            let storey = kinds.map(|kind| at(owner, kind, direction));
            if direction != Direction::Turning {
                drifts.push([place % building.floors.len(), storey[0]]);
            }
            storeys.push(storey);
        }
        let mat = Owner::Floor {
            building: index,
            floor: 0,
        };
        let (support, base) = (Owner::Support(index), Owner::Building(index));
        let mut accelerated = |dof, direction| Accelerated {
            dof,
            ground: building.ground_shares(direction),
            place: at(mat, Kind::Acceleration, direction),
        };
        let floors = accelerations.len();
        if let Some(support) = building.support {
            accelerations.push(accelerated(support.dof, Direction::Along));
        }
        let across = building.mat_in_plan.as_ref();
        let across = across.map(|mat| accelerated(mat.dofs[1], Direction::Across));
        Self {
            accelerations,
            floors,
            storeys,
            drifts,
            base_shear: at(base, Kind::Shear, Direction::Along),
            support: (building.support.is_some())
                .then(|| at(support, Kind::Force, Direction::Along)),
            mat: across.map(|across| OfMat {
                across,
                force_across: at(support, Kind::Force, Direction::Across),
                base_shear_across: at(base, Kind::Shear, Direction::Across),
                base_torque: at(base, Kind::Shear, Direction::Turning),
                ring: at(support, Kind::RingForce, Direction::Along),
            }),
        }
    }

    /// Updates peaks of shears, moments and forces of bearings.
    fn take_forces(
        &self,
        building: &BuildingSystem,
        reached: &Reached<'_>,
        index: usize,
        peaks: &mut [Peak],
    ) {
        let Reached { state, links, .. } = *reached;
        building.storey_forces(state, links, |storey, force| {
            let [_, shear, moment] = self.storeys[storey];
            peaks[shear].widen(force.shear);
            peaks[moment].widen(force.moment);
        });
        peaks[self.base_shear].widen(building.base_shear(state, links));
        if let Some(place) = self.support {
            peaks[place].widen(building.support_force(state));
        }
        let Some(mat) = &self.mat else { return };
        let ground = mat.across.moved_by(reached.ground.of(index));
        peaks[mat.across.place].widen(state.acceleration[mat.across.dof] + ground);
        if let Some([_, across, _]) = building.bearing_forces(state) {
            peaks[mat.force_across].widen(across);
        }
        if let Some([_, shear, torque]) = building.base_forces_in_plan(state) {
            peaks[mat.base_shear_across].widen(shear);
            peaks[mat.base_torque].widen(torque);
        }
        if let Some([x, y]) = building.ring_force(state) {
            peaks[mat.ring].widen(libm::hypot(x, y));
        }
    }
}
