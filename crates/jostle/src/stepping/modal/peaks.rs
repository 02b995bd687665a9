//! Histories and peaks in modal coordinates, also between steps that are long compared with the periods of higher
//! modes.

use pulp::Arch;

use super::corners::CornerPeaks;
use super::members::{Instant, MemberPeaks};
use super::mode_kernels::{Exceeds, Limits, ROWS};
use super::plan_near::PlanNear;
use super::reduced::Reduced;
use super::turning::{NEAR_GREATEST, StepMotion};
use crate::history::{self, Column, Energy, Extreme, History, Kind, Owner, Peak};
use crate::motion::Ground;
use crate::stepping::Settings;
use crate::stepping::events::Cubic;
pub(super) use crate::stepping::extremes::BEYOND;
use crate::stepping::extremes::greatest_in_step;
use crate::stepping::floor_peaks::{FloorPeaks, columns_of, columns_of_corners};
use crate::stepping::plan_drifts::PlanDrifts;
use crate::stepping::recorder::{closing_of, columns, forces_of_faces, put_energies};
use crate::system::{Direction, GroundsAt, RunGrounds, System};

/// Recorder of histories and peaks.
pub(super) struct Peaks {
    history: Option<History>,
    interval: f64,
    due: f64,
    /// Of every displacement of the floors, direction by direction.
    pub(super) floors: Vec<Vec<FloorPeaks>>,
    pub(super) corners: Vec<CornerPeaks>,
    drifts: Vec<PlanDrifts>,
    pub(super) closing: Vec<Extreme>,
    /// Bounds of the closings of buildings in space.
    pub(super) near: Option<PlanNear>,
    pub(super) base_shear: Vec<f64>,
    /// Contribution of a unit ground acceleration along x to the accelerations of monitored quantities, and of its rate to
    /// their rates; then the same across, and upwards; empty where nothing moves that way.
    driven: [Vec<f64>; 3],
    /// Share of both components of the ground acceleration in total accelerations of monitored quantities; empty unless
    /// buildings are in space.
    moved: [Vec<f64>; 2],
    limits: Limits,
    /// Forces of storeys at the last two evaluations, and their rates at both ends if evaluated \[N, N·m; N/s,
    /// N·m/s\].
    forces: [Vec<f64>; 2],
    force_rates: [Vec<f64>; 2],
    /// Contribution of modal accelerations to them at both ends.
    forces_missed: [Vec<f64>; 2],
    before: Before,
    /// Forces of columns and beams, where they are asked for.
    pub(super) members: Option<MemberPeaks>,
    /// Blocks of monitored quantities that may exceed a limit in the step.
    seen: Vec<bool>,
}

/// Instant of the last evaluation of storey forces, with modal velocities and accelerations then.
struct Before {
    time: f64,
    velocities: Vec<f64>,
    accelerations: Vec<f64>,
}

/// Monitored quantities at an instant.
#[derive(Clone, Copy)]
pub(super) struct Watched<'a> {
    pub(super) u: &'a [f64],
    pub(super) rate: &'a [f64],
    /// Acceleration relative to the ground, and jerk without load.
    pub(super) acceleration: &'a [f64],
    pub(super) unloaded_jerk: &'a [f64],
}

impl<'a> Watched<'a> {
    fn lists(self) -> [&'a [f64]; 4] {
        [self.u, self.rate, self.acceleration, self.unloaded_jerk]
    }
}

/// An accepted step.
pub(super) struct Taken<'a> {
    /// Its start and its end.
    pub(super) then: Watched<'a>,
    pub(super) now: Watched<'a>,
    /// Ground acceleration at both.
    pub(super) ground: [GroundsAt<'a>; 2],
    pub(super) start: f64,
    pub(super) step: f64,
    pub(super) motion: StepMotion<'a>,
}

impl Peaks {
    pub(super) fn new(
        system: &System,
        grounds: &RunGrounds<'_>,
        reduced: &Reduced,
        settings: Settings,
        tolerance: f64,
    ) -> Self {
        let interval = settings.record_interval;
        let (watched, listed) = (reduced.watched(), reduced.listed());
        let mut spare = vec![0.0; listed];
        let driven = reduced.participations().map(|participations| {
            let mut shown = Vec::new();
            if !participations.is_empty() {
                shown.resize(listed, 0.0);
                reduced.show_all([participations; 2], [&mut shown, &mut spare]);
            }
            shown
        });
        Self {
            history: interval.map(|_| History::kept_in(settings.storage, columns(system, grounds))),
            interval: interval.unwrap_or(0.0),
            due: 0.0,
            floors: system
                .buildings
                .iter()
                .map(|b| vec![FloorPeaks::default(); b.tracks.len()])
                .collect(),
            corners: {
                let all = system.buildings.iter().zip(&reduced.buildings);
                all.map(|(building, reduced_building)| CornerPeaks::new(building, reduced_building))
                    .collect()
            },
            drifts: {
                let all = system.buildings.iter().zip(&reduced.buildings);
                let drifts = all.map(|(building, reduced_building)| {
                    PlanDrifts::new(building, |dof| {
                        let mut tracks = building.tracks.iter();
                        let track = tracks.position(|track| track.dof == building.offset + dof);
                        // Every floor has its tracks; the foot and a base that moves follow.
                        let base =
                            || reduced_building.place_of_base(building, building.offset + dof);
                        let track = track.map(|at| reduced_building.watched.start + at);
                        track
                            .or_else(base)
                            .unwrap_or(reduced_building.watched.start)
                    })
                });
                drifts.collect()
            },
            closing: vec![Extreme::default(); system.contacts.len()],
            near: reduced
                .plan
                .as_ref()
                .map(|plan| PlanNear::new(plan, &system.contacts, tolerance)),
            base_shear: vec![0.0; system.buildings.len()],
            driven,
            moved: match reduced.across.is_empty() {
                true => Default::default(),
                false => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|ground| {
                    let directions = reduced.directions.iter();
                    directions
                        .map(|direction| direction.of_ground(ground))
                        .collect()
                }),
            },
            limits: Limits::none(system, reduced),
            forces: [(); 2].map(|()| vec![0.0; reduced.forces()]),
            force_rates: [(); 2].map(|()| vec![0.0; reduced.forces()]),
            forces_missed: [(); 2].map(|()| vec![0.0; reduced.forces()]),
            before: Before {
                time: 0.0,
                velocities: vec![0.0; reduced.modes()],
                accelerations: vec![0.0; reduced.modes()],
            },
            members: MemberPeaks::new(system, reduced, settings),
            seen: vec![false; watched / ROWS],
        }
    }

    pub(super) fn reserve(&mut self, rows: usize) {
        if let Some(history) = &mut self.history {
            history.reserve(rows);
        }
        if let Some(members) = &mut self.members {
            members.reserve(rows);
        }
    }

    /// The list of peaks of the run, without links.
    pub(super) fn take(&mut self, system: &System) -> history::Peaks {
        let mut all: Vec<(Column, Peak)> = Vec::new();
        let corners = std::mem::take(&mut self.corners).into_iter();
        for (index, (building, corners)) in system.buildings.iter().zip(corners).enumerate() {
            all.extend(columns_of(index, building, &self.floors[index]));
            let base = Column::along(Owner::Building(index), Kind::Shear);
            all.push((base, Peak::of_size(self.base_shear[index])));
            if building.is_in_space() {
                let drifts = self.drifts[index].corners();
                all.extend(columns_of_corners(index, Kind::CornerDrift, drifts));
                let moved = corners.finish().into_iter();
                all.extend(columns_of_corners(index, Kind::CornerDisplacement, moved));
            }
        }
        let closings = self.closing.iter().enumerate();
        all.extend(
            closings.map(|(contact, closing)| (Column::closing(contact), (*closing).into())),
        );
        all.into_iter().collect()
    }

    /// Why a row of the histories could not be kept.
    pub(super) fn history_fault(&self) -> Option<&str> {
        let members = self.members.as_ref();
        let members = members.and_then(|member| member.history.as_ref()?.unstored());
        self.history
            .as_ref()
            .and_then(History::unstored)
            .or(members)
    }

    pub(super) fn into_history(self) -> Option<History> {
        self.history
    }

    /// See the field.
    pub(super) fn driven(&self) -> &[Vec<f64>; 3] {
        &self.driven
    }

    /// What the rate of the ground acceleration adds to the jerk without load: with it, the rate of the total acceleration
    /// of a monitored place.
    fn slope(&self, place: usize, direction: Direction, rate: Ground) -> f64 {
        if self.driven[1..].iter().all(Vec::is_empty) {
            return rate[0] * (1.0 - self.driven[0][place]);
        }
        direction.of_ground(rate) - self.driven_by(place, rate)
    }

    /// What a ground acceleration contributes to the acceleration of a monitored quantity, with the opposite sign.
    pub(super) fn driven_by(&self, place: usize, ground: Ground) -> f64 {
        let all = self.driven.iter().zip(ground);
        let shares = all.filter_map(|(shares, component)| Some(shares.get(place)? * component));
        shares.sum()
    }

    /// Updates peaks with a step.
    pub(super) fn after_step(&mut self, system: &System, reduced: &Reduced, taken: &Taken<'_>) {
        if self.may_exceed(taken) {
            self.look_at_buildings(system, reduced, taken, None);
        }
        self.follow_corners(reduced, taken);
        self.follow_closings(reduced, taken);
    }

    /// The same where velocities have jumped at the start or shortly before; `within` gives the greatest total acceleration of
    /// every monitored point.
    pub(super) fn after_struck_step<'w>(
        &mut self,
        system: &System,
        reduced: &Reduced,
        taken: &Taken<'_>,
        within: impl FnOnce() -> &'w [f64],
    ) {
        if self.may_exceed(taken) {
            self.look_at_buildings(system, reduced, taken, Some(within()));
        }
        self.follow_corners(reduced, taken);
        self.follow_closings(reduced, taken);
    }

    /// The distance that a corner has moved may be a peak where none of its two displacements is.
    fn follow_corners(&mut self, reduced: &Reduced, taken: &Taken<'_>) {
        for corners in &mut self.corners {
            let ends = [taken.then, taken.now];
            corners.follow(reduced.arch(), ends, taken.start, taken.step);
        }
        for (drifts, floors) in self.drifts.iter_mut().zip(&mut self.floors) {
            drifts.before_step(taken.then.u, taken.then.rate);
            drifts.after_step(taken.now.u, taken.now.rate, taken.step);
            drifts.give_to(|place, drift| floors[place].storey_drift = drift);
        }
    }

    fn follow_closings(&mut self, reduced: &Reduced, taken: &Taken<'_>) {
        let raise = |contact: usize, closing: &mut Extreme| {
            let pair = |at: Watched<'_>| {
                [
                    reduced.closing(contact, at.u),
                    reduced.closing(contact, at.rate),
                ]
            };
            let ends = Ends {
                then: pair(taken.then),
                now: pair(taken.now),
            };
            ends.raise(closing, taken.start, taken.step);
        };
        if let Some(near) = &mut self.near {
            let ends = [taken.then, taken.now];
            near.raise(reduced.arch(), ends, raise, taken.step, &mut self.closing);
            return;
        }
        for (contact, closing) in self.closing.iter_mut().enumerate() {
            raise(contact, closing);
        }
    }

    /// Updates forces of storeys, columns and beams since the last evaluation.
    pub(super) fn follow_forces(&mut self, system: &System, reduced: &Reduced, now: Instant<'_>) {
        if let Some(members) = &mut self.members {
            members.follow(system, reduced, now);
        }
        let Instant {
            q,
            v: velocities,
            a: accelerations,
            time,
            ..
        } = now;
        self.forces.swap(0, 1);
        reduced.show_forces(q, &mut self.forces[0]);
        reduced.add_force_dashpots(velocities, &mut self.forces[0]);
        if self.are_forces_near_peaks(reduced) {
            self.look_at_forces(system, reduced, [velocities, accelerations], time);
        }
        let Before {
            time: then,
            velocities: before,
            accelerations: quickened,
        } = &mut self.before;
        *then = time;
        before.copy_from_slice(velocities);
        quickened.copy_from_slice(accelerations);
    }

    /// Replaces modal velocities, accelerations and jerks of the last evaluation of forces, after they have jumped: the next
    /// step starts with the new ones.
    pub(super) fn restart(&mut self, reduced: &Reduced, jumped: [&[f64]; 3]) {
        let [velocities, accelerations, _] = jumped;
        // So do forces of dashpots.
        let before = self.before.velocities.iter_mut().zip(velocities);
        before.for_each(|(before, now)| *before = now - *before);
        reduced.add_force_dashpots(&self.before.velocities, &mut self.forces[0]);
        self.before.velocities.copy_from_slice(velocities);
        self.before.accelerations.copy_from_slice(accelerations);
        if let Some(members) = &mut self.members {
            members.restart(reduced, jumped);
        }
    }

    /// Begins with displacements `u` of what is monitored and modal displacements `q`; `moving`: modal velocities, accelerations and
    /// jerks.
    pub(super) fn begin(
        &mut self,
        system: &System,
        reduced: &Reduced,
        u: &[f64],
        q: &[f64],
        moving: [&[f64]; 3],
    ) {
        self.restart(reduced, moving);
        reduced.show_forces(q, &mut self.forces[0]);
        reduced.add_force_dashpots(moving[0], &mut self.forces[0]);
        for (floors, (building, reduced_building)) in self
            .floors
            .iter_mut()
            .zip(system.buildings.iter().zip(&reduced.buildings))
        {
            let tracks = building.tracks.iter().zip(reduced_building.watched.clone());
            for (peaks, (_, at)) in floors.iter_mut().zip(tracks) {
                peaks.displacement_max.value = u[at].max(0.0);
                peaks.displacement_min.value = u[at].min(0.0);
            }
        }
    }

    /// Looks at the steps that were kept: after this, peaks are those of all steps so far.
    pub(super) fn complete(&mut self, reduced: &Reduced) {
        if let Some(members) = &mut self.members {
            members.look_at_kept(reduced);
        }
    }

    fn are_forces_near_peaks(&self, reduced: &Reduced) -> bool {
        let mut buildings = self.floors.iter().zip(&reduced.buildings);
        buildings.any(|(floors, reduced_building)| {
            let shears = floors.iter().map(|floor| floor.storey_shear);
            let moments = floors.iter().map(|floor| floor.overturning_moment);
            let mut all = (reduced_building.forces.start..).zip(shears.chain(moments));
            all.any(|(at, peak)| self.is_near(at, peak))
        })
    }

    fn is_near(&self, at: usize, peak: f64) -> bool {
        let [now, then] = &self.forces;
        now[at].abs().max(then[at].abs()) > NEAR * peak
    }

    fn look_at_forces(
        &mut self,
        system: &System,
        reduced: &Reduced,
        [velocities, accelerations]: [&[f64]; 2],
        time: f64,
    ) {
        let [missed_then, missed_now] = &mut self.forces_missed;
        reduced.show_forces_missed(&self.before.accelerations, missed_then);
        reduced.show_forces_missed(accelerations, missed_now);
        let [rate_then, rate_now] = &mut self.force_rates;
        reduced.show_forces(&self.before.velocities, rate_then);
        reduced.add_force_dashpots(&self.before.accelerations, rate_then);
        reduced.show_forces(velocities, rate_now);
        reduced.add_force_dashpots(accelerations, rate_now);
        let step = time - self.before.time;
        for (index, building) in reduced.buildings.iter().enumerate() {
            let storeys = system.buildings[index].storeys.len();
            for storey in 0..storeys.min(self.floors[index].len()) {
                let peaks = self.floors[index][storey];
                let raised = [
                    (building.forces.start + storey, peaks.storey_shear),
                    (
                        building.forces.start + storeys + storey,
                        peaks.overturning_moment,
                    ),
                ]
                .map(|(at, mut peak)| {
                    if self.is_near(at, peak) {
                        self.ends_of_force(at).widen(&mut peak, step);
                    }
                    peak
                });
                let peaks = &mut self.floors[index][storey];
                [peaks.storey_shear, peaks.overturning_moment] = raised;
            }
            if building.is_damped_at_base(&system.buildings[index]) {
                self.base_shear[index] = self.floors[index][0].storey_shear;
            }
        }
    }

    fn ends_of_force(&self, at: usize) -> Ends {
        let [now, then] = &self.forces;
        let [missed_then, missed_now] = &self.forces_missed;
        Ends {
            then: [then[at] + missed_then[at], self.force_rates[0][at]],
            now: [now[at] + missed_now[at], self.force_rates[1][at]],
        }
    }

    /// Forces of storeys at the end of the last step \[N, N·m\].
    pub(super) fn forces(&self) -> &[f64] {
        &self.forces[0]
    }

    /// Whether a floor, a storey or a base shear may exceed its peak so far.
    fn may_exceed(&mut self, taken: &Taken<'_>) -> bool {
        let Taken {
            then,
            now,
            ground,
            step,
            ..
        } = *taken;
        if ground[0].is_split() || (!self.driven[1].is_empty() && self.moved[1].is_empty()) {
            // Places see different components of the ground motion.
            self.seen.fill(true);
            return true;
        }
        // Alike grounds do not rise.
        let [g0, g1] = ground.map(|ground| [ground.common[0], ground.common[1]]);
        let rate = [0, 1].map(|axis| (g1[axis] - g0[axis]) / step);
        let [along, across, _] = &self.driven;
        let (limits, ends) = (&self.limits, [then.lists(), now.lists()]);
        let (beyond, seen) = (BEYOND * step, &mut self.seen);
        if across.is_empty() {
            return Arch::new().dispatch(Exceeds {
                limits,
                ends,
                driven: [along],
                moved: [along],
                ground: [[g0[0]], [g1[0]]],
                ground_rate: [rate[0]],
                beyond,
                seen,
            });
        }
        Arch::new().dispatch(Exceeds {
            limits,
            ends,
            driven: [along, across],
            moved: self.moved.each_ref().map(|list| &list[..]),
            ground: [g0, g1],
            ground_rate: rate,
            beyond,
            seen,
        })
    }

    fn look_at_buildings(
        &mut self,
        system: &System,
        reduced: &Reduced,
        taken: &Taken<'_>,
        within: Option<&[f64]>,
    ) {
        let Taken {
            then,
            now,
            ground,
            start,
            step,
            ..
        } = *taken;
        for (index, building) in system.buildings.iter().enumerate() {
            let reduced_building = &reduced.buildings[index];
            let blocks = reduced_building.watched.start / ROWS..reduced_building.watched.end / ROWS;
            if !self.seen[blocks].contains(&true) {
                continue;
            }
            let ground = ground.map(|all| all.of(index));
            let ground_rate = [0, 1, 2].map(|axis| (ground[1][axis] - ground[0][axis]) / step);
            let foot = |of: Watched<'_>| {
                reduced_building.foot.map_or([0.0; 2], |foot| {
                    let at = reduced_building.watched.start + foot;
                    [of.u[at], of.rate[at]]
                })
            };
            let mut below = Ends {
                then: foot(then),
                now: foot(now),
            };
            for (at, floor) in (reduced_building.watched.start..).zip(&building.tracks) {
                let place = at - reduced_building.watched.start;
                let slope = self.slope(at, floor.direction, ground_rate);
                let peaks = &mut self.floors[index][place];
                if floor.is_lowest && floor.direction != Direction::Along {
                    let base = building.dof_below_lowest(floor.direction);
                    let base = base.and_then(|dof| reduced_building.place_of_base(building, dof));
                    let of =
                        |list: Watched<'_>| base.map_or([0.0; 2], |at| [list.u[at], list.rate[at]]);
                    below = Ends {
                        then: of(then),
                        now: of(now),
                    };
                }
                let ends = Ends {
                    then: [then.u[at], then.rate[at]],
                    now: [now.u[at], now.rate[at]],
                };
                ends.raise(&mut peaks.displacement_max, start, step);
                ends.lower(&mut peaks.displacement_min, start, step);
                // Per storey height, as stored.
                let slenderness = 1.0 / floor.storey_height;
                let drift = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| (a[k] - b[k]) * slenderness);
                let drifts = Ends {
                    then: drift(ends.then, below.then),
                    now: drift(ends.now, below.now),
                };
                if floor.is_in_line {
                    drifts.widen(&mut peaks.storey_drift, step);
                }
                below = ends;
                let moved = ground.map(|ground| floor.direction.of_ground(ground));
                let total = Ends {
                    then: [
                        then.acceleration[at] + moved[0],
                        then.unloaded_jerk[at] + slope,
                    ],
                    now: [
                        now.acceleration[at] + moved[1],
                        now.unloaded_jerk[at] + slope,
                    ],
                };
                if let Some(within) = within {
                    peaks.total_acceleration = peaks.total_acceleration.max(within[at]);
                } else {
                    peaks.total_acceleration = taken.motion.greatest_acceleration(
                        reduced,
                        index,
                        (place, floor.direction),
                        total,
                        peaks.total_acceleration,
                    );
                }
                if at > reduced_building.watched.start || reduced_building.foot.is_none() {
                    self.limits.high[at] = peaks.displacement_max.value;
                    self.limits.low[at] = peaks.displacement_min.value;
                }
                self.limits.acceleration[at] = NEAR_GREATEST * peaks.total_acceleration;
                if !floor.is_lowest && floor.is_in_line {
                    // Slightly less, because the product is rounded.
                    let widest = peaks.storey_drift * floor.storey_height;
                    self.limits.drift[at] = (1.0 - 1e-12) * widest;
                }
            }
            for &[floor, at] in &reduced_building.rising {
                let ends = Ends {
                    then: [then.u[at], then.rate[at]],
                    now: [now.u[at], now.rate[at]],
                };
                let greatest = &mut self.floors[index][floor].vertical_displacement;
                ends.widen(greatest, step);
            }
            let shear = reduced_building.shear;
            let shears = Ends {
                then: [then.u[shear], then.rate[shear]],
                now: [now.u[shear], now.rate[shear]],
            };
            if !reduced_building.is_damped_at_base(building) {
                shears.widen(&mut self.base_shear[index], step);
            }
            self.limits.high[shear] = self.base_shear[index];
            self.limits.low[shear] = -self.base_shear[index];
        }
    }

    /// Whether a row of the history is due, or requested now.
    pub(super) fn is_due(&self, time: f64, wanted: bool) -> bool {
        self.history.is_some() && (wanted || time >= self.due)
    }

    /// Adds a row: the instant, monitored quantities, and forces of links with the grounds under them.
    pub(super) fn record(
        &mut self,
        system: &System,
        reduced: &Reduced,
        now: Instant<'_>,
        watched: Watched<'_>,
        (links, grounds): (&[f64], &RunGrounds<'_>),
        energy: &Energy,
    ) {
        let Some(history) = &mut self.history else {
            return;
        };
        let Instant {
            time,
            ground,
            phases,
            ..
        } = now;
        if let Some(members) = &mut self.members {
            members.record(system, reduced, now);
        }
        self.due = time + self.interval * (1.0 - 1e-9);
        let mut row = history.push_row().iter_mut();
        let mut put = |value: f64| {
            if let Some(place) = row.next() {
                *place = value;
            }
        };
        put(time);
        put(ground.common[0]);
        if !reduced.across.is_empty() {
            put(ground.common[1]);
        }
        for (index, (building, reduced_building)) in
            system.buildings.iter().zip(&reduced.buildings).enumerate()
        {
            let ground = ground.of(index);
            for (floor, track) in building
                .tracks
                .iter()
                .enumerate()
                .take(reduced_building.floors)
            {
                let at = reduced_building.watched.start + floor;
                put(watched.u[at]);
                put(watched.rate[at]);
                put(watched.acceleration[at] + track.direction.of_ground(ground));
            }
        }
        if reduced.across.is_empty() {
            phases.iter().for_each(|phase| put(phase.force()));
        } else {
            forces_of_faces(system, phases, &mut put);
        }
        let contacts = system.contacts.iter().enumerate();
        contacts
            .filter(|(contact, _)| closing_of(system, grounds, *contact).is_some())
            .for_each(|(contact, _)| put(reduced.closing(contact, watched.u)));
        links.iter().for_each(|force| put(*force));
        for followed in &system.links_followed {
            let mut links = reduced.links.iter();
            let link = links.find(|link| link.link == Some(*followed));
            let [stroke, speed] = link.map_or([0.0; 2], |link| {
                [link.closing(watched.u), link.closing(watched.rate)]
            });
            put(stroke);
            put(speed);
        }
        put_energies(system, energy, grounds, &mut put);
        debug_assert!(row.next().is_none(), "every column has a value");
    }
}

/// Fraction of the peak so far below which no storey force can exceed it within a step that resolves the third
/// mode.
const NEAR: f64 = 0.8;

impl Limits {
    /// No peaks so far; other contact points have no peaks, and the drift of the lowest storey is the displacement
    /// of its floor. Where the base gives way as well, that floor is always looked at.
    fn none(system: &System, reduced: &Reduced) -> Self {
        let watched = reduced.watched();
        let mut limits = Self {
            high: vec![f64::INFINITY; watched],
            low: vec![f64::NEG_INFINITY; watched],
            drift: vec![f64::INFINITY; watched],
            acceleration: vec![f64::INFINITY; watched],
        };
        for (building, building_system) in reduced.buildings.iter().zip(&system.buildings) {
            let first = building.watched.start;
            for at in first..first + building.floors {
                (limits.high[at], limits.low[at]) = (0.0, 0.0);
                (limits.drift[at], limits.acceleration[at]) = (0.0, 0.0);
            }
            // In every direction.
            for (at, _) in (first..)
                .zip(&building_system.tracks)
                .filter(|(_, track)| track.is_lowest || !track.is_in_line)
            {
                limits.drift[at] = f64::INFINITY;
            }
            let shear = building.shear;
            (limits.high[shear], limits.low[shear]) = (0.0, 0.0);
        }
        limits
    }
}

/// (value, slope) at the start and at the end of a step.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    pub(super) then: [f64; 2],
    pub(super) now: [f64; 2],
}

impl Ends {
    /// Largest excess of a cubic over the range of its ends.
    #[inline(always)]
    fn beyond(&self, step: f64) -> f64 {
        BEYOND * step * (self.then[1].abs() + self.now[1].abs())
    }

    /// Whether a cubic may exceed a magnitude.
    #[inline(always)]
    pub(super) fn may_exceed(&self, magnitude: f64, step: f64) -> bool {
        self.then[0].abs().max(self.now[0].abs()) + self.beyond(step) > magnitude
    }

    /// Keeps the greatest value so far.
    #[inline(always)]
    fn raise(self, extreme: &mut Extreme, start: f64, step: f64) {
        if self.then[0].max(self.now[0]) + self.beyond(step) > extreme.value {
            self.look_for(extreme, 1.0, start, step);
        }
    }

    /// Keeps the least value so far.
    #[inline(always)]
    fn lower(self, extreme: &mut Extreme, start: f64, step: f64) {
        if self.then[0].min(self.now[0]) - self.beyond(step) < extreme.value {
            self.look_for(extreme, -1.0, start, step);
        }
    }

    /// Keeps the greatest magnitude so far.
    #[inline(always)]
    fn widen(self, largest: &mut f64, step: f64) {
        if self.may_exceed(*largest, step) {
            *largest = self.largest(*largest, step);
        }
    }

    #[cold]
    fn look_for(self, extreme: &mut Extreme, sign: f64, start: f64, step: f64) {
        let [then, now] = [self.then, self.now].map(|[a, b]| (sign * a, sign * b));
        let greatest = greatest_in_step(then, now, start, step);
        if greatest.value > sign * extreme.value {
            *extreme = Extreme {
                value: sign * greatest.value,
                at: greatest.at,
            };
        }
    }

    /// Greatest and least value so far, widened by the step.
    #[inline(always)]
    pub(super) fn extremes(self, [greatest, least]: [f64; 2], step: f64) -> [f64; 2] {
        let Self { then, now } = self;
        let beyond = self.beyond(step);
        let [high, low] = [then[0].max(now[0]), then[0].min(now[0])];
        if high + beyond <= greatest && low - beyond >= least {
            return [greatest, least];
        }
        let curve = Cubic::new(then[0], then[1], now[0], now[1], step);
        let mut extremes = [greatest.max(high), least.min(low)];
        for value in curve.turning_points().map(|at| curve.value(at)) {
            extremes = [extremes[0].max(value), extremes[1].min(value)];
        }
        extremes
    }

    #[cold]
    fn largest(self, known: f64, step: f64) -> f64 {
        let Self { then, now } = self;
        let ends = known.max(then[0].abs()).max(now[0].abs());
        let curve = Cubic::new(then[0], then[1], now[0], now[1], step);
        let inside = curve.turning_points().map(|at| curve.value(at).abs());
        inside.fold(ends, f64::max)
    }
}
