//! Peaks of floors, storeys, supports and springs over the segments of a step.

use super::building_motion::Segment;
use super::power_series::Powers;
use crate::history::{Column, Extreme, Kind, Owner, Peak, Peaks};
use crate::linear::Row;
use crate::stepping::acceleration_parts::AccelerationParts;
use crate::stepping::events::Cubic;
use crate::stepping::floor_peaks::{FloorPeaks, columns_of};
use crate::stepping::totals::{SpringTotals, columns_of_springs};
use crate::structure::StoreyForce;
use crate::system::{BuildingSystem, System};

/// Power series are for buildings without links.
const NO_LINK: fn(usize) -> f64 = |_| 0.0;

/// Peaks of a run so far.
#[derive(Clone, Debug)]
pub(super) struct SeriesPeaks {
    pub(super) floors: Vec<Vec<FloorPeaks>>,
    pub(super) base_shear: Vec<f64>,
    pub(super) supports: Vec<SupportPeaks>,
    pub(super) closing: Vec<Extreme>,
    pub(super) springs: Vec<SpringTotals>,
    pub(super) parts: AccelerationParts,
    /// Of every building, where its floors begin among those of all.
    first_floor: Vec<usize>,
    /// Of every building, whether a storey force was near its peak at the end of the last segment.
    near: Vec<bool>,
    /// Storey forces at the start and at the end of a segment, and their rates there.
    storeys: [Vec<StoreyForce>; 2],
    storey_rates: [Vec<StoreyForce>; 2],
}

/// Peak response of a mat on bearings, or of a wall on its spring and dashpot.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SupportPeaks {
    displacement: Peak,
    total_acceleration: f64,
    /// Greatest force of springs, friction and dashpot together, without stops, either sign \[N\].
    force: f64,
    /// Energy dissipated in the dashpot \[J\].
    pub(super) damped: f64,
}

impl SupportPeaks {
    fn columns(&self, building: usize) -> [(Column, Peak); 4] {
        let (mat, support) = (
            Owner::Floor { building, floor: 0 },
            Owner::Support(building),
        );
        let total = Peak::of_size(self.total_acceleration);
        [
            (Column::along(mat, Kind::Displacement), self.displacement),
            (Column::along(mat, Kind::Acceleration), total),
            (
                Column::along(support, Kind::Force),
                Peak::of_size(self.force),
            ),
            (
                Column::along(support, Kind::Work),
                Peak::of_size(self.damped),
            ),
        ]
    }
}

/// A quantity and its rate at the start and at the end of a segment.
type Ends = [(f64, f64); 2];

/// A quantity whose magnitude at the ends of a segment is below this share of its peak has none within: nothing moves faster
/// than a step of free vibration resolves.
const NEAR: f64 = 0.5;
/// Margin of cubics that tell where a peak must be looked for.
const MARGIN: f64 = 1.1;

/// Whether a quantity may exceed its peak so far within a segment.
#[inline]
fn may_exceed(peak: f64, ends: Ends, step: f64) -> bool {
    let [then, now] = ends;
    let most = then.0.abs().max(now.0.abs());
    if most < NEAR * peak || (then.1 > 0.0) == (now.1 > 0.0) {
        return false;
    }
    let sign = if then.1 > 0.0 { 1.0 } else { -1.0 };
    let [then, now] = [then, now].map(|(value, rate)| (sign * value, sign * rate));
    let turned = Cubic::new(then.0, then.1, now.0, now.1, step).peak(0.0, step);
    turned.is_some_and(|turn| MARGIN * turn.value > peak)
}

/// Updates the peak of a quantity with its magnitude over a segment.
#[inline]
fn follow(peak: &mut f64, ends: Ends, step: f64, motion: impl FnOnce() -> Powers) {
    let [then, now] = ends;
    *peak = peak.max(then.0.abs()).max(now.0.abs());
    if may_exceed(*peak, ends, step) {
        *peak = peak.max(motion().greatest_turn());
    }
}

/// Updates the greatest and the least value of a displacement over a segment.
#[inline]
fn follow_extremes(
    [max, min]: [&mut Extreme; 2],
    ends: Ends,
    [start, step]: [f64; 2],
    motion: impl FnOnce() -> Powers,
) {
    let mut take = |value: f64, at: f64| {
        if value > max.value {
            *max = Extreme { value, at };
        }
        if value < min.value {
            *min = Extreme { value, at };
        }
    };
    take(ends[1].0, start + step);
    let peak = if ends[0].1 > 0.0 {
        max.value
    } else {
        -min.value
    };
    if may_exceed(peak, ends, step) {
        let motion = motion();
        for share in motion.turns() {
            let value = motion.value(share);
            if value > max.value {
                *max = Extreme {
                    value,
                    at: start + share * step,
                };
            }
            if value < min.value {
                *min = Extreme {
                    value,
                    at: start + share * step,
                };
            }
        }
    }
}

impl SeriesPeaks {
    pub(super) fn new(system: &System, duration: f64, springs: Vec<SpringTotals>) -> Self {
        let buildings = || system.buildings.iter();
        let floors: usize = buildings().map(|building| building.floors.len()).sum();
        let storeys = buildings().map(|building| building.storeys.len());
        let storeys = vec![StoreyForce::default(); storeys.max().unwrap_or(0)];
        let first_floor = buildings().scan(0, |next, building| {
            let first = *next;
            *next += building.floors.len();
            Some(first)
        });
        Self {
            floors: buildings()
                .map(|b| vec![FloorPeaks::default(); b.floors.len()])
                .collect(),
            base_shear: vec![0.0; system.buildings.len()],
            supports: vec![SupportPeaks::default(); system.buildings.len()],
            closing: vec![Extreme::default(); system.contacts.len()],
            springs,
            parts: AccelerationParts::new(floors, duration),
            first_floor: first_floor.collect(),
            near: vec![true; system.buildings.len()],
            storeys: [storeys.clone(), storeys.clone()],
            storey_rates: [storeys.clone(), storeys],
        }
    }

    /// The list of peaks of the run.
    pub(super) fn finish(&self, system: &System) -> Peaks {
        let buildings = system.buildings.iter().enumerate();
        let mut all: Vec<(Column, Peak)> = Vec::new();
        for (index, building) in buildings {
            all.extend(columns_of(index, building, &self.floors[index]));
            let base = Column::along(Owner::Building(index), Kind::Shear);
            all.push((base, Peak::of_size(self.base_shear[index])));
            if building.support.is_some() {
                all.extend(self.supports[index].columns(index));
            }
        }
        let closings = self.closing.iter().enumerate();
        all.extend(
            closings.map(|(contact, closing)| (Column::closing(contact), (*closing).into())),
        );
        all.extend(columns_of_springs(&self.springs));
        all.into_iter().collect()
    }

    /// Greatest displacement of a floor of a building, of its mat as floor 0, or of all its floors \[m\].
    pub(super) fn sway(&self, building: usize, floor: Option<usize>) -> f64 {
        let floors = &self.floors[building];
        match floor {
            Some(0) => self.supports[building].displacement.size(),
            Some(floor) => floors[floor - 1].sway(),
            None => floors.iter().map(FloorPeaks::sway).fold(0.0, f64::max),
        }
    }

    /// Adds a segment of a building that begins at `start` \[s\]; `ground`: acceleration there and its slope.
    pub(super) fn after_segment(
        &mut self,
        index: usize,
        building: &BuildingSystem,
        segment: &Segment,
        start: f64,
        ground: [f64; 2],
    ) {
        let series = &segment.series;
        let step = series.step;
        let offset = building.offset;
        self.parts.begin(start, start + step);
        let [u, v, a, jerk] =
            [0, 1, 2, 3].map(|kind| [&segment.start[kind][..], &segment.end[kind][..]]);
        let shaken = [ground[0], ground[0] + ground[1] * step];
        let moves = |dof: usize| [0, 1].map(|side| (u[side][dof], v[side][dof]));
        let accelerates = |dof: usize| -> Ends {
            [0, 1].map(|side| (a[side][dof] + shaken[side], jerk[side][dof] + ground[1]))
        };
        let motion = |dof: usize| series.of(&Row::single(dof));
        let acceleration = |dof: usize| motion(dof).second_derivative(step, ground);
        let mut below = building.foot.map(|dof| dof - offset);
        let first_floor = self.first_floor[index];
        let floors = self.floors[index].iter_mut().zip(&building.floors);
        for (number, (peaks, floor)) in floors.enumerate() {
            let dof = floor.dof - offset;
            let ends = moves(dof);
            follow_extremes(
                [&mut peaks.displacement_max, &mut peaks.displacement_min],
                ends,
                [start, step],
                || motion(dof),
            );
            let total = accelerates(dof);
            let exact = || acceleration(dof);
            follow(&mut peaks.total_acceleration, total, step, exact);
            self.parts.take(first_floor + number, total[1].0.abs());
            let lower = below.map_or([(0.0, 0.0); 2], moves);
            let drift = [0, 1].map(|side| {
                let (upper, lower): ((f64, f64), (f64, f64)) = (ends[side], lower[side]);
                (upper.0 - lower.0, upper.1 - lower.1)
            });
            let mut greatest = peaks.storey_drift * floor.storey_height;
            follow(&mut greatest, drift, step, || {
                let below = below.map(|below| (below, -1.0));
                series.of(&[(dof, 1.0)].into_iter().chain(below).collect())
            });
            peaks.storey_drift = peaks.storey_drift.max(greatest / floor.storey_height);
            below = Some(dof);
        }
        self.follow_storeys(index, building, segment);
        let springs = &building.equations.springs;
        for (number, spring) in springs.iter().enumerate() {
            let totals = &mut self.springs[building.spring_offset + number];
            let tangent = segment.tangents[number];
            let force = [0, 1].map(|side| {
                let rate = tangent * spring.deformation(v[side]);
                (segment.forces[side][number], rate)
            });
            follow(&mut totals.peak_force, force, step, || {
                let deformation = series.of(&spring.row);
                deformation.scaled(tangent).starting_at(force[0].0)
            });
            let moved = spring.deformation(u[1]) - spring.deformation(u[0]);
            totals.work += 0.5 * (force[0].0 + force[1].0) * moved;
        }
        if let Some(support) = &building.support {
            let (dof, peaks) = (support.dof - offset, &mut self.supports[index]);
            follow_extremes(
                [
                    &mut peaks.displacement.greatest,
                    &mut peaks.displacement.least,
                ],
                moves(dof),
                [start, step],
                || motion(dof),
            );
            let exact = || acceleration(dof);
            follow(&mut peaks.total_acceleration, accelerates(dof), step, exact);
            let tangent = support
                .spring
                .map_or(0.0, |spring| segment.tangents[spring]);
            let force = [0, 1].map(|side| {
                let spring = support
                    .spring
                    .map_or(0.0, |spring| segment.forces[side][spring]);
                let elastic = support.stiffness * u[side][dof] + support.damping * v[side][dof];
                let rate = (support.stiffness + tangent) * v[side][dof];
                (elastic + spring, rate + support.damping * a[side][dof])
            });
            follow(&mut peaks.force, force, step, || {
                let moved = motion(dof);
                let damped = moved.derivative(step).scaled(support.damping);
                let held = moved.scaled(support.stiffness + tangent);
                held.plus(&damped).starting_at(force[0].0)
            });
        }
    }

    /// Shears and overturning moments of the storeys of a building over a segment.
    fn follow_storeys(&mut self, index: usize, building: &BuildingSystem, segment: &Segment) {
        let step = segment.series.step;
        let (ends, storeys) = ([&segment.start, &segment.end], &building.storeys);
        let springs = &building.equations.springs;
        let carried = |form: &dyn Fn(usize) -> f64| -> f64 {
            let base_springs =
                (0..springs.len()).filter(|spring| springs[*spring].in_base_shear != 0.0);
            base_springs
                .map(|spring| springs[spring].in_base_shear * form(spring))
                .sum()
        };
        let base = |values: &[f64], form: &dyn Fn(usize) -> f64| {
            building.equations.base_shear(values) + carried(form)
        };
        let rate_of = |values: &[f64], spring: usize| {
            segment.tangents[spring] * springs[spring].deformation(values)
        };
        let was_near = std::mem::take(&mut self.near[index]);
        let mut near = false;
        let floors = &mut self.floors[index];
        let mut base_ends: Ends = [(0.0, 0.0); 2];
        // The start is the end of the segment before, and matters only if there may be more after it.
        for (side, forces) in self.storeys.iter_mut().enumerate().rev() {
            if side == 0 && !near && !was_near {
                return;
            }
            if side == 0 {
                self.near[index] = near;
            }
            let u = &ends[side][0];
            let force = |spring: usize| segment.forces[side][spring];
            storeys.for_each(u, force, NO_LINK, |storey, value| {
                forces[storey] = value;
                let peaks = &mut floors[storey];
                near |= value.shear.abs() > NEAR * peaks.storey_shear
                    || value.moment.abs() > NEAR * peaks.overturning_moment;
                peaks.storey_shear = peaks.storey_shear.max(value.shear.abs());
                peaks.overturning_moment = peaks.overturning_moment.max(value.moment.abs());
            });
            base_ends[side].0 = base(u, &force);
            near |= base_ends[side].0.abs() > NEAR * self.base_shear[index];
        }
        for (side, rates) in self.storey_rates.iter_mut().enumerate() {
            let v = &ends[side][1];
            storeys.for_each(
                v,
                |spring| rate_of(v, spring),
                NO_LINK,
                |storey, rate| rates[storey] = rate,
            );
            base_ends[side].1 = base(v, &|spring| rate_of(v, spring));
        }
        let ([then, now], [leaves, comes]) = (&self.storeys, &self.storey_rates);
        let storey_motion = |storey: usize, of: fn(StoreyForce) -> f64| {
            let form = |row: &[f64]| {
                let mut force = 0.0;
                storeys.for_each(
                    row,
                    |spring| rate_of(row, spring),
                    NO_LINK,
                    |at, value| {
                        if at == storey {
                            force = of(value);
                        }
                    },
                );
                force
            };
            segment.series.form(form).starting_at(of(then[storey]))
        };
        for (storey, peaks) in floors.iter_mut().enumerate().take(storeys.len()) {
            for (peak, of) in [
                (
                    &mut peaks.storey_shear,
                    (|force| force.shear) as fn(StoreyForce) -> f64,
                ),
                (&mut peaks.overturning_moment, |force| force.moment),
            ] {
                let ends = [
                    (of(then[storey]), of(leaves[storey])),
                    (of(now[storey]), of(comes[storey])),
                ];
                follow(peak, ends, step, || storey_motion(storey, of));
            }
        }
        let motion = || {
            let form = |row: &[f64]| base(row, &|spring| rate_of(row, spring));
            segment.series.form(form).starting_at(base_ends[0].0)
        };
        follow(&mut self.base_shear[index], base_ends, step, motion);
    }

    /// Adds accelerations that have jumped.
    pub(super) fn after_jump(&mut self, system: &System, acceleration: &[f64], ground: f64) {
        self.parts.begin_jump();
        let floors = self.floors.iter_mut();
        for ((building, floors), first) in
            system.buildings.iter().zip(floors).zip(&self.first_floor)
        {
            for (number, (peaks, floor)) in floors.iter_mut().zip(&building.floors).enumerate() {
                let total = (acceleration[floor.dof] + ground).abs();
                peaks.total_acceleration = peaks.total_acceleration.max(total);
                self.parts.take(first + number, total);
            }
        }
    }
}
