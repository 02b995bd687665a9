//! Forces of columns and beams in modal coordinates.

use std::ops::Range;

use super::basis::Basis;
use super::member_ratios::{ModalRatios, StepEnds};
use super::mode_kernels::{ROWS, Show};
use super::peaks::Ends;
use super::reduced::{Reduced, in_blocks};
use crate::history::MemberHistory;
use crate::motion::Ground;
use crate::simd;
use crate::state::ContactPhase;
use crate::stepping::member_ratios::MemberRatios;
use crate::system::{BuildingSystem, System};

/// Axial force, shear, moment.
pub(super) const KINDS: usize = 3;

/// Forces of columns and beams of one building, by its modes.
pub(super) struct MemberRows {
    /// Those that displacements determine, among those of all buildings, in whole blocks.
    range: Range<usize>,
    modes: Range<usize>,
    /// Form of every row.
    forms: Vec<usize>,
    /// Axial force, shear or moment, row by row.
    kinds: Vec<usize>,
    /// Forces of shapes, what a unit acceleration of every mode adds statically, and how far they may be off even so.
    shapes: Vec<[f64; ROWS]>,
    missed: Vec<[f64; ROWS]>,
    off: Vec<[f64; ROWS]>,
    /// Most that every row changes per change of Σ (ω q)², the square root of it.
    norms: Vec<f64>,
    /// Axial forces that pass through rigid beams: they also follow from velocities, accelerations and pushes.
    passed: Passed,
}

/// Axial forces of beams that keep their length.
#[derive(Default)]
struct Passed {
    range: Range<usize>,
    forms: Vec<usize>,
    /// Shares of modal displacements, velocities and accelerations, one after the other.
    shares: Vec<[f64; ROWS]>,
    /// The greatest of every mode, and of the ground acceleration.
    greatest: Vec<f64>,
    greatest_of_ground: f64,
    /// Force per ground acceleration, and per rate of it while modes are free \[kg\].
    ground: Vec<[f64; 2]>,
    contacts: Vec<Vec<usize>>,
}

/// What is known of the forces of a building: rows of shapes, and of what they miss and may be off, form by form.
pub(super) struct FormRows<'a> {
    pub(super) shapes: &'a [Vec<f64>],
    pub(super) missed: Option<&'a [Vec<f64>]>,
    pub(super) off: Option<&'a [Vec<f64>]>,
}

impl MemberRows {
    pub(super) fn new(
        building: &BuildingSystem,
        basis: &Basis,
        modes: Range<usize>,
        damping: &[f64],
        starts: [usize; 2],
        rows: &FormRows<'_>,
    ) -> Self {
        let forms = &building.members.forms;
        let count = modes.len();
        let (own, passed): (Vec<usize>, Vec<usize>) =
            (0..forms.len()).partition(|form| forms[*form].follows_displacements());
        let pick = |rows: Option<&[Vec<f64>]>, list: &[usize]| match rows {
            Some(rows) => {
                let rows: Vec<Vec<f64>> = list.iter().map(|form| rows[*form].clone()).collect();
                in_blocks(&rows, count)
            }
            None => Vec::new(),
        };
        let mut kind_of = vec![0; forms.len()];
        let members = building.members.members.iter();
        for section in members.flat_map(|member| &member.sections) {
            for (kind, form) in section.forms.iter().enumerate() {
                kind_of[*form] = kind;
            }
        }
        let dense = |list: &[(usize, f64)]| {
            basis.of_shapes(|vector| list.iter().map(|(dof, share)| share * vector[*dof]).sum())
        };
        let mut shares: Vec<Vec<f64>> = Vec::new();
        let mut ground = Vec::new();
        for form in &passed {
            let properties = &forms[*form];
            let mut velocity = dense(&properties.velocity);
            let inertia = dense(&properties.acceleration);
            if building.modal_damping.is_some() {
                // Damping of modes pushes every mass by its share.
                for ((share, mass), d) in velocity.iter_mut().zip(&inertia).zip(damping) {
                    *share += mass * d;
                }
            }
            let participation = basis.modes.participation.iter();
            let driven: f64 = participation.zip(&inertia).map(|(g, m)| g * m).sum();
            ground.push([properties.ground, properties.ground - driven]);
            let mut acceleration = inertia;
            if let Some(missed) = rows.missed {
                let missed = missed[*form].iter();
                acceleration
                    .iter_mut()
                    .zip(missed)
                    .for_each(|(a, m)| *a += m);
            }
            shares.push([&rows.shapes[*form][..], &velocity, &acceleration].concat());
        }
        let mut greatest = vec![0.0_f64; 3 * count];
        for row in &shares {
            for (most, share) in greatest.iter_mut().zip(row) {
                *most = most.max(share.abs());
            }
        }
        let squares = |form: &usize| {
            let row = rows.shapes[*form].iter().zip(&basis.modes.stiffness);
            row.map(|(share, k)| share * share / k).sum::<f64>()
        };
        let padded = |start: usize, count: usize| start..start + count.div_ceil(ROWS) * ROWS;
        Self {
            range: padded(starts[0], own.len()),
            norms: own.iter().map(|form| squares(form).sqrt()).collect(),
            kinds: own.iter().map(|form| kind_of[*form]).collect(),
            shapes: pick(Some(rows.shapes), &own),
            missed: pick(rows.missed, &own),
            off: pick(rows.off, &own),
            passed: Passed {
                range: padded(starts[1], passed.len()),
                shares: in_blocks(&shares, 3 * count),
                greatest,
                greatest_of_ground: ground
                    .iter()
                    .fold(0.0, |most, [g, _]: &[f64; 2]| most.max(g.abs())),
                ground,
                contacts: passed
                    .iter()
                    .map(|form| forms[*form].contacts.clone())
                    .collect(),
                forms: passed,
            },
            forms: own,
            modes,
        }
    }

    /// Where the rows of the next building begin.
    pub(super) fn ends(&self) -> [usize; 2] {
        [self.range.end, self.passed.range.end]
    }

    fn value(&self, blocks: &[[f64; ROWS]], row: usize, mode: usize) -> f64 {
        blocks[row / ROWS * self.modes.len() + mode][row % ROWS]
    }

    /// Modes of the building among all.
    pub(super) fn modes(&self) -> Range<usize> {
        self.modes.clone()
    }

    /// Shares of modal displacements in a force that displacements determine, and those of accelerations that shapes
    /// miss, if any; `None` for other forces.
    pub(super) fn own_row(&self, form: usize) -> Option<[Vec<f64>; 2]> {
        let row = self.forms.iter().position(|own| *own == form)?;
        let list = |blocks: &[[f64; ROWS]]| -> Vec<f64> {
            let modes = 0..if blocks.is_empty() {
                0
            } else {
                self.modes.len()
            };
            modes.map(|mode| self.value(blocks, row, mode)).collect()
        };
        Some([list(&self.shapes), list(&self.missed)])
    }

    /// Shares of modal displacements, velocities and accelerations in another force, its forces per ground acceleration and
    /// per rate of it, and the contacts that push there.
    pub(super) fn passed_row(&self, form: usize) -> ([Vec<f64>; 3], [f64; 2], Vec<usize>) {
        let passed = &self.passed;
        let Some(row) = passed.forms.iter().position(|own| *own == form) else {
            return Default::default();
        };
        let count = self.modes.len();
        let part = |part: usize| -> Vec<f64> {
            let block = row / ROWS * 3 * count + part * count;
            let modes = 0..count;
            modes
                .map(|mode| passed.shares[block + mode][row % ROWS])
                .collect()
        };
        (
            [part(0), part(1), part(2)],
            passed.ground[row],
            passed.contacts[row].clone(),
        )
    }
}

/// A modal state.
#[derive(Clone, Copy)]
pub(super) struct Instant<'a> {
    pub(super) q: &'a [f64],
    pub(super) v: &'a [f64],
    pub(super) a: &'a [f64],
    /// Rates of accelerations without those of the loads.
    pub(super) jerk: &'a [f64],
    pub(super) time: f64,
    pub(super) ground: Ground,
    pub(super) phases: &'a [ContactPhase],
    /// Whether accelerations followed a cubic since the last instant.
    pub(super) smooth: bool,
}

/// Follows the forces of columns and beams. A block of them is looked at only once the building has moved so far that one
/// could come near its greatest or least value.
pub(super) struct MemberPeaks {
    /// Greatest and least value, and greatest size with what may be missed.
    greatest: Vec<f64>,
    least: Vec<f64>,
    with_off: Vec<f64>,
    watch: Vec<Watch>,
    /// The same of axial forces that pass through beams.
    passed: Vec<[f64; 2]>,
    watch_passed: Vec<Watch>,
    /// Modal displacements, velocities, accelerations and jerks now and before, building by building.
    modal: [Vec<f64>; 2],
    time: f64,
    ground: f64,
    history: Option<MemberHistory>,
    /// Demand over capacity of those that are rated.
    ratios: Option<ModalRatios>,
    /// Values of all forms at a row of the history, and whether it is wanted.
    row: Vec<Vec<f64>>,
    wanted: Vec<Vec<bool>>,
}

/// How far a building has moved, and how far it may before a block of forces is looked at.
#[derive(Clone, Default)]
struct Watch {
    moved: f64,
    rate: f64,
    /// Block by block.
    until: Vec<f64>,
}

impl Watch {
    fn new(range: &Range<usize>) -> Self {
        Self {
            until: vec![0.0; range.len() / ROWS],
            ..Self::default()
        }
    }
}

/// Share of the extreme so far from which a step is looked at more closely.
const NEAR: f64 = 0.8;
/// What the path between instants may be longer than their velocities say.
const LONGER: f64 = 1.2;
/// Lists of modal values that are kept: q, its rate, the rate of that and the jerk.
const LISTS: usize = 4;

impl MemberPeaks {
    /// `None` where no forces are asked for.
    pub(super) fn new(system: &System, reduced: &Reduced, records: bool) -> Option<Self> {
        let [own, passed] = reduced.buildings.last()?.members.ends();
        if own + passed == 0 {
            return None;
        }
        let sizes = || system.buildings.iter().map(|b| b.members.forms.len());
        let mut wanted: Vec<Vec<bool>> = sizes().map(|n| vec![false; n]).collect();
        for [building, member] in &system.members_followed {
            let member = &system.buildings[*building].members.members[*member];
            for form in member.sections.iter().flat_map(|section| section.forms) {
                wanted[*building][form] = true;
            }
        }
        let buildings = || reduced.buildings.iter().map(|own| &own.members);
        Some(Self {
            greatest: vec![0.0; own],
            least: vec![0.0; own],
            with_off: vec![0.0; own],
            watch: buildings().map(|own| Watch::new(&own.range)).collect(),
            passed: vec![[0.0; 2]; passed],
            watch_passed: buildings()
                .map(|own| Watch::new(&own.passed.range))
                .collect(),
            modal: [(); 2].map(|()| vec![0.0; LISTS * reduced.modes()]),
            time: 0.0,
            ground: 0.0,
            history: MemberHistory::new(system).filter(|_| records),
            ratios: ModalRatios::new(system, reduced),
            row: sizes().map(|n| vec![0.0; n]).collect(),
            wanted,
        })
    }

    pub(super) fn reserve(&mut self, rows: usize) {
        if let Some(history) = &mut self.history {
            history.reserve(rows);
        }
    }

    /// Takes in what happened since the last instant.
    pub(super) fn follow(&mut self, system: &System, reduced: &Reduced, now: Instant<'_>) {
        let step = now.time - self.time;
        self.modal.swap(0, 1);
        for (index, own) in reduced.buildings.iter().enumerate() {
            let own = &own.members;
            let count = own.modes.len();
            let all = LISTS * own.modes.start..LISTS * own.modes.end;
            let lists = [now.q, now.v, now.a, now.jerk];
            for (to, list) in self.modal[0][all.clone()]
                .chunks_mut(count.max(1))
                .zip(lists)
            {
                to.copy_from_slice(&list[own.modes.clone()]);
            }
            let stiffness = &reduced.stiffness[own.modes.clone()];
            self.follow_own(reduced, index, own, stiffness, step);
            self.follow_passed(reduced, index, own, now, step);
            if let Some(ratios) = &mut self.ratios {
                let [to, from] = self.modal.each_ref().map(|list| {
                    let list = |part: usize| {
                        &list[all.start + part * count..all.start + (part + 1) * count]
                    };
                    [list(0), list(1), list(2)]
                });
                let ends = StepEnds {
                    then: from,
                    now: to,
                    ground: [self.ground, now.ground[0]],
                    moved: self.watch[index].moved,
                    step,
                };
                ratios.follow(system, index, &ends, now);
            }
        }
        self.time = now.time;
        self.ground = now.ground[0];
    }

    /// Replaces velocities, accelerations and jerks of the last instant, after they have jumped.
    pub(super) fn restart(&mut self, reduced: &Reduced, jumped: [&[f64]; 3]) {
        for (index, own) in reduced.buildings.iter().enumerate() {
            let own = &own.members;
            let count = own.modes.len();
            let kept = LISTS * own.modes.start + count..LISTS * own.modes.end;
            let shares = own.passed.greatest.get(count..).unwrap_or_default();
            let mut moved = 0.0;
            let lists = self.modal[0][kept].chunks_mut(count.max(1));
            for (list, (to, new)) in lists.zip(jumped).enumerate() {
                let new = &new[own.modes.clone()];
                if let Some(shares) = shares.get(list * count..) {
                    let jumps = shares.iter().zip(&*to).zip(new);
                    moved += jumps.map(|((s, a), b)| s * (b - a).abs()).sum::<f64>();
                }
                to.copy_from_slice(new);
            }
            self.watch_passed[index].moved += moved;
            let stiffness = &reduced.stiffness[own.modes.clone()];
            self.watch[index].rate =
                simd::weighted_square(stiffness, &jumped[0][own.modes.clone()]).sqrt();
        }
    }

    fn follow_own(
        &mut self,
        reduced: &Reduced,
        index: usize,
        own: &MemberRows,
        stiffness: &[f64],
        step: f64,
    ) {
        let count = own.modes.len();
        let first = LISTS * own.modes.start;
        let [now, then] = self
            .modal
            .each_ref()
            .map(|list| &list[first..first + LISTS * count]);
        let of = |list: usize| list * count..(list + 1) * count;
        let watch = &mut self.watch[index];
        let rate = simd::weighted_square(stiffness, &now[of(1)]).sqrt();
        watch.moved += LONGER * step * watch.rate.max(rate);
        watch.rate = rate;
        let arch = reduced.arch();
        for (block, until) in watch.until.iter_mut().enumerate() {
            if watch.moved < *until {
                continue;
            }
            let blocks =
                |blocks: &'_ [[f64; ROWS]]| block * count..((block + 1) * count).min(blocks.len());
            let mut value = [0.0; ROWS];
            arch.dispatch(Show {
                blocks: &own.shapes[blocks(&own.shapes)],
                modal: [&now[of(0)]],
                watched: [&mut value],
            });
            let places = own.range.start + block * ROWS..own.range.start + (block + 1) * ROWS;
            let (greatest, least) = (
                &mut self.greatest[places.clone()],
                &mut self.least[places.clone()],
            );
            let mut slack = f64::INFINITY;
            for (row, norm) in own.norms[block * ROWS..].iter().take(ROWS).enumerate() {
                let above = NEAR * greatest[row] - value[row];
                let below = value[row] - NEAR * least[row];
                slack = slack.min(above.min(below) / norm.max(f64::MIN_POSITIVE));
            }
            *until = watch.moved + slack.max(0.0);
            if slack > 0.0 {
                continue;
            }
            let (mut before, mut missed, mut off) =
                ([[0.0; ROWS]; 3], [[0.0; ROWS]; 2], [0.0; ROWS]);
            let [value_then, rate_then, rate_now] = &mut before;
            arch.dispatch(Show {
                blocks: &own.shapes[blocks(&own.shapes)],
                modal: [&then[of(0)], &then[of(1)], &now[of(1)]],
                watched: [value_then, rate_then, rate_now],
            });
            if !own.missed.is_empty() {
                let [missed_then, missed_now] = &mut missed;
                arch.dispatch(Show {
                    blocks: &own.missed[blocks(&own.missed)],
                    modal: [&then[of(2)], &now[of(2)]],
                    watched: [missed_then, missed_now],
                });
                arch.dispatch(Show {
                    blocks: &own.off[blocks(&own.off)],
                    modal: [&now[of(2)]],
                    watched: [&mut off],
                });
            }
            let with_off = &mut self.with_off[places];
            for row in 0..ROWS {
                let ends = Ends {
                    then: [before[0][row] + missed[0][row], before[1][row]],
                    now: [value[row] + missed[1][row], before[2][row]],
                };
                [greatest[row], least[row]] = ends.extremes([greatest[row], least[row]], step);
                with_off[row] = with_off[row].max(ends.now[0].abs() + off[row].abs());
            }
        }
    }

    fn follow_passed(
        &mut self,
        reduced: &Reduced,
        index: usize,
        own: &MemberRows,
        instant: Instant<'_>,
        step: f64,
    ) {
        let passed = &own.passed;
        if passed.range.is_empty() {
            return;
        }
        let count = own.modes.len();
        let first = LISTS * own.modes.start;
        let [now, then] = self
            .modal
            .each_ref()
            .map(|list| &list[first..first + LISTS * count]);
        let (values, rates) = (0..3 * count, count..4 * count);
        let watch = &mut self.watch_passed[index];
        let moved = passed.greatest.iter().zip(now).zip(then);
        let moved = moved.map(|((share, now), then)| share * (now - then).abs());
        let rise = instant.ground[0] - self.ground;
        watch.moved += moved.sum::<f64>() + passed.greatest_of_ground * rise.abs();
        let pushed = passed.contacts.iter().flatten();
        let pushed = pushed
            .into_iter()
            .any(|contact| instant.phases[*contact].force() != 0.0);
        let cubic = instant.smooth && step > 0.0;
        for (block, until) in watch.until.iter_mut().enumerate() {
            if watch.moved < *until && !pushed {
                continue;
            }
            let blocks = &passed.shares[block * 3 * count..(block + 1) * 3 * count];
            let (mut value, mut before) = ([0.0; ROWS], [[0.0; ROWS]; 3]);
            let arch = reduced.arch();
            arch.dispatch(Show {
                blocks,
                modal: [&now[values.clone()]],
                watched: [&mut value],
            });
            let rows = block * ROWS..((block + 1) * ROWS).min(passed.forms.len());
            let mut slack = f64::INFINITY;
            for (row, at) in rows.clone().enumerate() {
                value[row] += passed.ground[at][0] * instant.ground[0];
                let contacts = passed.contacts[at].iter();
                value[row] -= contacts.map(|c| instant.phases[*c].force()).sum::<f64>();
                let [greatest, least] = self.passed[passed.range.start + at];
                let above = NEAR * greatest - value[row];
                slack = slack.min(above).min(value[row] - NEAR * least);
            }
            *until = watch.moved + slack.max(0.0);
            if slack > 0.0 {
                continue;
            }
            if cubic {
                let [value_then, rate_then, rate_now] = &mut before;
                arch.dispatch(Show {
                    blocks,
                    modal: [
                        &then[values.clone()],
                        &then[rates.clone()],
                        &now[rates.clone()],
                    ],
                    watched: [value_then, rate_then, rate_now],
                });
            }
            for (row, at) in rows.enumerate() {
                let [fixed, free] = passed.ground[at];
                let extremes = &mut self.passed[passed.range.start + at];
                if cubic {
                    let slope = free * rise / step;
                    let ends = Ends {
                        then: [before[0][row] + fixed * self.ground, before[1][row] + slope],
                        now: [value[row], before[2][row] + slope],
                    };
                    *extremes = ends.extremes(*extremes, step);
                } else {
                    let [greatest, least] = *extremes;
                    *extremes = [greatest.max(value[row]), least.min(value[row])];
                }
            }
        }
    }

    /// Adds a row to the histories.
    pub(super) fn record(&mut self, system: &System, reduced: &Reduced, now: Instant<'_>) {
        let Some(history) = &mut self.history else {
            return;
        };
        for (index, building) in reduced.buildings.iter().enumerate() {
            let own = &building.members;
            let list = |list: &[f64], mode: usize| list[own.modes.start + mode];
            let forms = &system.buildings[index].members.forms;
            for (row, form) in own.forms.iter().enumerate() {
                if !self.wanted[index][*form] {
                    continue;
                }
                let mut sum = forms[*form].constant;
                for mode in 0..own.modes.len() {
                    sum += own.value(&own.shapes, row, mode) * list(now.q, mode);
                    if !own.missed.is_empty() {
                        sum += own.value(&own.missed, row, mode) * list(now.a, mode);
                    }
                }
                self.row[index][*form] = sum;
            }
            let passed = &own.passed;
            for (row, form) in passed.forms.iter().enumerate() {
                if !self.wanted[index][*form] {
                    continue;
                }
                let mut sum = passed.ground[row][0] * now.ground[0];
                let count = own.modes.len();
                for (part, modal) in [now.q, now.v, now.a].into_iter().enumerate() {
                    for mode in 0..count {
                        let block = row / ROWS * 3 * count + part * count + mode;
                        sum += passed.shares[block][row % ROWS] * list(modal, mode);
                    }
                }
                let contacts = passed.contacts[row].iter();
                sum -= contacts.map(|c| now.phases[*c].force()).sum::<f64>();
                self.row[index][*form] = sum;
            }
        }
        history.push(system, now.time, &self.row);
    }

    /// Greatest and least value of every form of every building, the histories, and demands over capacities.
    pub(super) fn finish(
        self,
        system: &System,
        reduced: &Reduced,
    ) -> (Vec<Vec<[f64; 2]>>, Option<MemberHistory>, MemberRatios) {
        let mut all = Vec::with_capacity(system.buildings.len());
        for (building, own) in system.buildings.iter().zip(&reduced.buildings) {
            let own = &own.members;
            let constants = building.members.forms.iter().map(|form| form.constant);
            let mut extremes: Vec<[f64; 2]> = constants.map(|constant| [constant; 2]).collect();
            for (place, form) in own.range.clone().zip(&own.forms) {
                extremes[*form][0] += self.greatest[place];
                extremes[*form][1] += self.least[place];
            }
            for (place, form) in own.passed.range.clone().zip(&own.passed.forms) {
                let [greatest, least] = self.passed[place];
                extremes[*form][0] += greatest;
                extremes[*form][1] += least;
            }
            all.push(extremes);
        }
        let ratios = self.ratios.map(|ratios| ratios.ratios);
        (all, self.history, ratios.unwrap_or_default())
    }

    /// Greatest size of every kind of force in a building.
    fn scales(&self, own: &MemberRows) -> [f64; KINDS] {
        let mut scales = [f64::MIN_POSITIVE; KINDS];
        for (place, kind) in own.range.clone().zip(&own.kinds) {
            let size = self.greatest[place].max(-self.least[place]);
            scales[*kind] = scales[*kind].max(size);
        }
        for place in own.passed.range.clone() {
            let [greatest, least] = self.passed[place];
            scales[0] = scales[0].max(greatest).max(-least);
        }
        scales
    }

    /// Estimated errors of the forces of a building relative to the greatest of their kind: by shapes that are left out,
    /// and, with the greatest errors of modes between the ends of free steps, by cubics there \[–\].
    pub(super) fn errors(&self, own: &MemberRows, free: impl Fn(usize) -> f64) -> [f64; 2] {
        let scales = self.scales(own);
        let free: Vec<f64> = (0..own.modes.len()).map(free).collect();
        let (mut shapes, mut between) = (0.0_f64, 0.0_f64);
        for (row, kind) in own.kinds.iter().enumerate() {
            let place = own.range.start + row;
            let known = self.greatest[place].max(-self.least[place]);
            let off = (self.with_off[place] - known).max(0.0);
            shapes = shapes.max(off / scales[*kind]);
            let squares = free.iter().enumerate();
            let squares = squares.map(|(mode, q)| (own.value(&own.shapes, row, mode) * q).powi(2));
            between = between.max(squares.sum::<f64>().sqrt() / scales[*kind]);
        }
        [shapes, between]
    }

    /// The greatest share of a mode, per acceleration, in what the forces of a building may be off \[s²·m⁻¹·kg^−½\].
    pub(super) fn off_by_mode(&self, own: &MemberRows, mode: usize) -> f64 {
        if own.off.is_empty() {
            return 0.0;
        }
        let scales = self.scales(own);
        let rows = own.kinds.iter().enumerate();
        rows.map(|(row, kind)| (own.value(&own.off, row, mode) / scales[*kind]).abs())
            .fold(0.0, f64::max)
    }
}
