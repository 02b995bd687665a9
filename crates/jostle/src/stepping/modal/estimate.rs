//! Estimated errors of reported peaks: from missing shapes, and from cubics between steps.

use super::mode_kernels::{ROWS, Show};
use super::peaks::{Peaks, Watched};
use super::reduced::{Reduced, ReducedBuilding};
use super::turning::NEAR_GREATEST;
use crate::stepping::floor_peaks::FloorPeaks;
use crate::stepping::peak_change::LEAST_ROTATION;
use crate::system::{BuildingSystem, Direction, GroundsAt, System};

/// Kinds of peaks of a building: displacements, drifts, total accelerations, base shear, storey shears, overturning moments.
const KINDS: usize = 6;

/// Error estimates of a run so far.
#[derive(Clone, Debug)]
pub(super) struct Reached {
    /// Greatest acceleration of every mode in free steps, times the fourth power of their length \[m·s²·kg^½\].
    free: Vec<f64>,
    /// The same in all steps, without the step length \[m/s²·kg^½\].
    all: Vec<f64>,
    /// Of every floor: displacement, drift, acceleration, of the lowest the base shear, then shear and overturning moment of
    /// the storey below.
    floors: Vec<Vec<[Widened; KINDS]>>,
    /// Accelerations times ω², and the errors of both.
    quickened: Vec<f64>,
    missed: [Vec<f64>; 2],
    forces_missed: Vec<f64>,
    until_look: u32,
}

/// Greatest magnitude of a quantity, and of the same plus its error.
#[derive(Clone, Copy, Debug, Default)]
struct Widened {
    known: f64,
    with_missed: f64,
}

impl Widened {
    fn widen(&mut self, value: f64, missed: f64) {
        self.known = self.known.max(value.abs());
        self.with_missed = self.with_missed.max(value.abs() + missed.abs());
    }

    /// Estimated error of the peak.
    fn off(&self) -> f64 {
        self.with_missed - self.known
    }
}

/// Errors of modes between steps may add up if no impact, with its short steps, determines the peaks.
const TOGETHER: f64 = 2.0;

/// Number of steps between evaluations of the error.
const LOOK_EVERY: u32 = 4;

impl Reached {
    pub(super) fn new(reduced: &Reduced) -> Self {
        let modes = reduced.modes();
        let floors =
            |building: &ReducedBuilding| vec![[Widened::default(); KINDS]; building.floors];
        Self {
            free: vec![0.0; modes],
            all: vec![0.0; modes],
            floors: reduced.buildings.iter().map(floors).collect(),
            quickened: vec![0.0; modes],
            missed: [(); 2].map(|()| vec![0.0; reduced.watched()]),
            forces_missed: vec![0.0; reduced.forces()],
            until_look: 1,
        }
    }

    /// Adds the modal accelerations at the end of a step; `free`: its length, if it was a free-vibration step.
    /// Returns whether the error should be evaluated.
    pub(super) fn widen(&mut self, accelerations: &[f64], free: Option<f64>) -> bool {
        if let Some(step) = free {
            let power = (step * step) * (step * step);
            for (free, a) in self.free.iter_mut().zip(accelerations) {
                *free = free.max(a.abs() * power);
            }
        }
        for (all, a) in self.all.iter_mut().zip(accelerations) {
            *all = all.max(a.abs());
        }
        self.until_look -= 1;
        if self.until_look == 0 {
            self.until_look = LOOK_EVERY;
            return true;
        }
        false
    }

    /// Adds the error at an instant.
    pub(super) fn look(
        &mut self,
        system: &System,
        reduced: &Reduced,
        accelerations: &[f64],
        watched: Watched<'_>,
        grounds: GroundsAt<'_>,
        forces: &[f64],
    ) {
        let quickened = self.quickened.iter_mut().zip(accelerations);
        for ((quick, a), k) in quickened.zip(&reduced.stiffness) {
            *quick = a * k;
        }
        for (index, building) in reduced.buildings.iter().enumerate() {
            if building.missed.is_empty() {
                continue;
            }
            let (modes, places) = (building.modes.clone(), building.watched.clone());
            let [slow, quick] = &mut self.missed;
            let (slow, quick) = (&mut slow[places.clone()], &mut quick[places.clone()]);
            reduced.arch().dispatch(Show {
                blocks: &building.missed,
                modal: [&accelerations[modes.clone()], &self.quickened[modes]],
                watched: [&mut *slow, &mut *quick],
            });
            let own_forces = building.forces.clone();
            reduced.arch().dispatch(Show {
                blocks: &building.forces_off,
                modal: [&accelerations[building.modes.clone()]],
                watched: [&mut self.forces_missed[own_forces.clone()]],
            });
            let (known, missed) = (&forces[own_forces.clone()], &self.forces_missed[own_forces]);
            let storeys = system.buildings[index].storeys.len();
            let (u, a) = (&watched.u[places.clone()], &watched.acceleration[places]);
            let ground = grounds.of(index);
            let mut below = building
                .foot
                .map_or((0.0, 0.0), |foot| (u[foot], slow[foot]));
            let shear = building.shear - building.watched.start;
            for (at, widened) in self.floors[index].iter_mut().enumerate() {
                let track = &system.buildings[index].tracks[at];
                if track.is_lowest && track.direction != Direction::Along {
                    below = (0.0, 0.0);
                }
                let height = track.storey_height;
                widened[0].widen(u[at], slow[at]);
                widened[1].widen((u[at] - below.0) / height, (slow[at] - below.1) / height);
                widened[2].widen(a[at] + track.direction.of_ground(ground), quick[at]);
                widened[4].widen(known[at], missed[at]);
                widened[5].widen(known[storeys + at], missed[storeys + at]);
                below = (u[at], slow[at]);
            }
            if let Some(first) = self.floors[index].first_mut() {
                first[3].widen(u[shear], slow[shear]);
            }
        }
    }
}

impl Reached {
    /// Modes of every building whose defects contribute significantly to errors beyond a tolerance.
    pub(super) fn lacking(
        &self,
        reduced: &Reduced,
        system: &System,
        peaks: &Peaks,
        tolerance: f64,
    ) -> Vec<Vec<usize>> {
        let of_building = |index: usize| {
            let building = &reduced.buildings[index];
            let floors = &system.buildings[index].floors;
            let scales = scales(
                &peaks.floors[index][..floors.len()],
                peaks.base_shear[index],
            );
            let share = |mode: usize| {
                let missed = |place: usize| building.of_blocks(&building.missed, place, mode);
                let (mut most, mut below) = (0.0_f64, building.foot.map_or(0.0, missed));
                for (place, floor) in floors.iter().enumerate() {
                    let missed = missed(place);
                    let drift = (missed - below) / floor.storey_height;
                    let quick = missed * reduced.stiffness[building.modes.start + mode];
                    let kinds = [missed / scales[0], drift / scales[1], quick / scales[2]];
                    most = kinds
                        .into_iter()
                        .fold(most, |most, kind| most.max(kind.abs()));
                    below = missed;
                }
                let shear = missed(building.shear - building.watched.start) / scales[3];
                for storey in 0..floors.len() {
                    let force =
                        |place: usize| building.of_blocks(&building.forces_off, place, mode);
                    let moment = force(floors.len() + storey) / scales[5];
                    most = most
                        .max((force(storey) / scales[4]).abs())
                        .max(moment.abs());
                }
                let members = peaks.members.as_ref();
                most = most.max(members.map_or(0.0, |m| m.off_by_mode(&building.members, mode)));
                most.max(shear.abs()) * self.all[building.modes.start + mode]
            };
            if building.missed.is_empty() {
                return Vec::new();
            }
            let modes = 0..building.modes.len();
            modes
                .filter(|mode| share(*mode) > WORTH_ADDING * tolerance)
                .collect()
        };
        (0..reduced.buildings.len()).map(of_building).collect()
    }
}

/// Fraction of the tolerance above which the defect of a mode is added to the shapes.
const WORTH_ADDING: f64 = 0.1;

/// Margin of the estimate for omitted shapes, which takes them to follow without delay.
const SHAPES_MARGIN: f64 = 1.5;
/// Total accelerations among the kinds.
const ACCELERATION: usize = 2;

/// Estimated errors of peaks, each relative to the greatest of its kind in the building; the greatest of all \[–\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Estimate {
    /// By omitted shapes.
    pub(super) shapes: f64,
    /// By cubics between the ends of steps.
    pub(super) between: f64,
}

impl Estimate {
    /// Both together; they are independent.
    pub(super) fn both(&self) -> f64 {
        libm::hypot(self.shapes, self.between)
    }

    pub(super) fn new(
        reduced: &Reduced,
        system: &System,
        reached: &Reached,
        peaks: &Peaks,
        struck: bool,
    ) -> Self {
        let together = if struck { 1.0 } else { TOGETHER };
        let mut worst = Self::default();
        for (index, building) in system.buildings.iter().enumerate() {
            let reduced_building = &reduced.buildings[index];
            let modes = reduced_building.modes.clone();
            let shape = |place: usize, mode: usize| {
                reduced_building.of_blocks(&reduced_building.blocks, place, mode)
            };
            let k = |mode: usize| reduced.stiffness[modes.start + mode];
            let free = |mode: usize| reached.free[modes.start + mode] * k(mode) / 384.0;
            let sum = |term: &dyn Fn(usize) -> f64| {
                let squares = (0..modes.len()).map(|mode| (term(mode) * free(mode)).powi(2));
                squares.sum::<f64>().sqrt()
            };
            let storeys = building.storeys.len();
            let per_direction = building.floors.len().max(1);
            for first in (0..building.tracks.len()).step_by(per_direction) {
                let places = first..first + per_direction;
                let scales = scales_in_space(building, peaks, index, first);
                let mut between = [0.0_f64; KINDS];
                for place in places.clone() {
                    let floor = &building.tracks[place];
                    let below = match place.checked_sub(1).filter(|_| !floor.is_lowest) {
                        Some(below) => Some(below),
                        None => reduced_building.foot,
                    };
                    let drift = |mode: usize| {
                        let below = below.map_or(0.0, |below| shape(below, mode));
                        (shape(place, mode) - below) / floor.storey_height
                    };
                    between[0] = between[0].max(sum(&|mode| shape(place, mode)));
                    between[1] = between[1].max(sum(&drift));
                    between[2] = between[2].max(sum(&|mode| k(mode) * shape(place, mode)));
                }
                for storey in places.clone().filter(|storey| *storey < storeys) {
                    let force = |place: usize, mode: usize| {
                        reduced_building.of_blocks(&reduced_building.force_blocks, place, mode)
                    };
                    between[4] = between[4].max(sum(&|mode| force(storey, mode)));
                    between[5] = between[5].max(sum(&|mode| force(storeys + storey, mode)));
                }
                if first == 0 {
                    between[3] = sum(&|mode| {
                        shape(
                            reduced_building.shear - reduced_building.watched.start,
                            mode,
                        )
                    });
                }
                for kind in 0..KINDS {
                    let floors = reached.floors[index][places.clone()].iter();
                    let off = floors.map(|floor| floor[kind].off()).fold(0.0, f64::max);
                    worst.shapes = worst.shapes.max(SHAPES_MARGIN * off / scales[kind]);
                    let mut between = together * between[kind] / scales[kind];
                    if kind == ACCELERATION {
                        // Turning points that a cubic does not miss by more than this are looked at exactly.
                        between *= (between / (1.0 - NEAR_GREATEST)).min(1.0);
                    }
                    worst.between = worst.between.max(between);
                }
            }
            if let Some(members) = &peaks.members {
                let [shapes, between] = members.errors(&reduced_building.members, free);
                worst.shapes = worst.shapes.max(shapes);
                worst.between = worst.between.max(together * between);
            }
        }
        worst
    }
}

/// The greatest of every kind, of the direction whose floors begin at `first`: along x and across together, and rotations,
/// which count as at least [`LEAST_ROTATION`].
fn scales_in_space(
    building: &BuildingSystem,
    peaks: &Peaks,
    index: usize,
    first: usize,
) -> [f64; KINDS] {
    let (floors, n) = (&peaks.floors[index], building.floors.len());
    let lateral = scales(&floors[..floors.len().min(2 * n)], peaks.base_shear[index]);
    if first < 2 * n {
        return lateral;
    }
    let radius = building.radius_of_gyration();
    let scales = scales(&floors[first..], 0.0);
    let units = [
        1.0 / radius,
        1.0 / radius,
        1.0 / radius,
        radius,
        radius,
        radius,
    ];
    std::array::from_fn(|kind| scales[kind].max(LEAST_ROTATION * lateral[kind] * units[kind]))
}

/// The greatest of every kind in a building.
fn scales(floors: &[FloorPeaks], shear: f64) -> [f64; KINDS] {
    let most = |of: fn(&FloorPeaks) -> f64| floors.iter().map(of).fold(f64::MIN_POSITIVE, f64::max);
    [
        most(FloorPeaks::sway),
        most(|f| f.storey_drift),
        most(|f| f.total_acceleration),
        shear.max(f64::MIN_POSITIVE),
        most(|f| f.storey_shear),
        most(|f| f.overturning_moment),
    ]
}

impl ReducedBuilding {
    /// Value of one of its modes at a monitored point.
    pub(super) fn of_blocks(&self, blocks: &[[f64; ROWS]], place: usize, mode: usize) -> f64 {
        blocks[place / ROWS * self.modes.len() + mode][place % ROWS]
    }
}
