//! Forces of columns and beams in modal coordinates.

use std::ops::Range;

use super::basis::Basis;
use super::kernels::{ROWS, Show};
use super::peaks::Ends;
use super::reduced::{Reduced, in_blocks};
use crate::history::MemberHistory;
use crate::state::ContactPhase;
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
    /// Axial forces that pass through rigid beams: they also follow from velocities, accelerations and pushes.
    passed: Passed,
}

/// Axial forces of beams that keep their length.
#[derive(Default)]
struct Passed {
    range: Range<usize>,
    forms: Vec<usize>,
    /// Shares of modal displacements, velocities and accelerations.
    shares: [Vec<[f64; ROWS]>; 3],
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
        let mut shares = [const { Vec::new() }; 3];
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
            shares[0].push(rows.shapes[*form].clone());
            shares[1].push(velocity);
            shares[2].push(acceleration);
        }
        let padded = |start: usize, count: usize| start..start + count.div_ceil(ROWS) * ROWS;
        Self {
            range: padded(starts[0], own.len()),
            kinds: own.iter().map(|form| kind_of[*form]).collect(),
            shapes: pick(Some(rows.shapes), &own),
            missed: pick(rows.missed, &own),
            off: pick(rows.off, &own),
            passed: Passed {
                range: padded(starts[1], passed.len()),
                shares: shares.map(|rows| in_blocks(&rows, count)),
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
    pub(super) ground: f64,
    pub(super) phases: &'a [ContactPhase],
    /// Whether accelerations followed a cubic since the last instant.
    pub(super) smooth: bool,
}

/// Follows the forces of columns and beams.
pub(super) struct MemberPeaks {
    /// Values now and before.
    values: [Vec<f64>; 2],
    /// Greatest and least value, and greatest size with what may be missed.
    greatest: Vec<f64>,
    least: Vec<f64>,
    with_off: Vec<f64>,
    /// Of axial forces that pass through beams: value and rate now and before.
    passed: [[Vec<f64>; 2]; 2],
    passed_extremes: Vec<[f64; 2]>,
    spare: [Vec<f64>; 2],
    time: f64,
    ground: f64,
    v: Vec<f64>,
    a: Vec<f64>,
    history: Option<MemberHistory>,
    /// Values of all forms at a row of the history, and whether it is wanted.
    row: Vec<Vec<f64>>,
    wanted: Vec<Vec<bool>>,
}

/// Share of the extreme so far from which a step is looked at more closely.
const NEAR: f64 = 0.8;

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
        let pair = |n: usize| [vec![0.0; n], vec![0.0; n]];
        Some(Self {
            values: pair(own),
            greatest: vec![0.0; own],
            least: vec![0.0; own],
            with_off: vec![0.0; own],
            passed: [pair(passed), pair(passed)],
            passed_extremes: vec![[0.0; 2]; passed],
            spare: pair(passed),
            time: 0.0,
            ground: 0.0,
            v: vec![0.0; reduced.modes()],
            a: vec![0.0; reduced.modes()],
            history: MemberHistory::new(system).filter(|_| records),
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
    pub(super) fn follow(&mut self, reduced: &Reduced, now: Instant<'_>) {
        let step = now.time - self.time;
        self.values.swap(0, 1);
        self.passed.swap(0, 1);
        for own in &reduced.buildings {
            self.follow_building(reduced, &own.members, now, step);
        }
        self.time = now.time;
        self.ground = now.ground;
        self.v.copy_from_slice(now.v);
        self.a.copy_from_slice(now.a);
    }

    fn follow_building(
        &mut self,
        reduced: &Reduced,
        own: &MemberRows,
        now: Instant<'_>,
        step: f64,
    ) {
        let (arch, modes) = (reduced.arch(), own.modes.clone());
        arch.dispatch(Show {
            blocks: &own.shapes,
            modal: [&now.q[modes.clone()]],
            watched: [&mut self.values[0][own.range.clone()]],
        });
        for block in own.range.clone().step_by(ROWS) {
            if self.is_near(block) {
                self.look_at_block(reduced, own, block, now, step);
            }
        }
        if own.passed.range.is_empty() {
            return;
        }
        let range = own.passed.range.clone();
        let [present, past] = &mut self.passed;
        let [value, rate] = present;
        let (value, rate) = (&mut value[range.clone()], &mut rate[range.clone()]);
        let [more, more_rate] = &mut self.spare;
        let (more, more_rate) = (&mut more[range.clone()], &mut more_rate[range.clone()]);
        let lists = [[now.q, now.v], [now.v, now.a], [now.a, now.jerk]];
        for (index, (blocks, lists)) in own.passed.shares.iter().zip(lists).enumerate() {
            let modal = lists.map(|list| &list[modes.clone()]);
            let watched = if index == 0 {
                [&mut *value, &mut *rate]
            } else {
                [&mut *more, &mut *more_rate]
            };
            arch.dispatch(Show {
                blocks,
                modal,
                watched,
            });
            if index > 0 {
                value
                    .iter_mut()
                    .zip(&*more)
                    .for_each(|(sum, part)| *sum += part);
                rate.iter_mut()
                    .zip(&*more_rate)
                    .for_each(|(sum, part)| *sum += part);
            }
        }
        let slope = if step > 0.0 {
            (now.ground - self.ground) / step
        } else {
            0.0
        };
        for (row, ([fixed, free], contacts)) in own
            .passed
            .ground
            .iter()
            .zip(&own.passed.contacts)
            .enumerate()
        {
            value[row] += fixed * now.ground;
            value[row] -= contacts.iter().map(|c| now.phases[*c].force()).sum::<f64>();
            rate[row] += free * slope;
            let at = range.start + row;
            let [greatest, least] = &mut self.passed_extremes[at];
            let [before, before_rate] = &*past;
            let (then, then_rate) = (before[at], before_rate[at]);
            if now.smooth && step > 0.0 {
                let ends = Ends {
                    then: [then, then_rate],
                    now: [value[row], rate[row]],
                };
                [*greatest, *least] = ends.extremes([*greatest, *least], step);
            } else {
                *greatest = greatest.max(value[row]);
                *least = least.min(value[row]);
            }
        }
    }

    fn is_near(&self, block: usize) -> bool {
        let rows = block..block + ROWS;
        let [now, then] = self.values.each_ref().map(|list| &list[rows.clone()]);
        let (greatest, least) = (&self.greatest[rows.clone()], &self.least[rows]);
        let mut near = false;
        for row in 0..ROWS {
            near |= now[row].max(then[row]) > NEAR * greatest[row];
            near |= now[row].min(then[row]) < NEAR * least[row];
        }
        near
    }

    fn look_at_block(
        &mut self,
        reduced: &Reduced,
        own: &MemberRows,
        block: usize,
        now: Instant<'_>,
        step: f64,
    ) {
        let (count, modes) = (own.modes.len(), own.modes.clone());
        let at = (block - own.range.start) / ROWS * count;
        let show = |blocks: &[[f64; ROWS]], lists: [&[f64]; 2]| {
            let mut shown = [[0.0; ROWS]; 2];
            if !blocks.is_empty() {
                let [first, second] = &mut shown;
                reduced.arch().dispatch(Show {
                    blocks: &blocks[at..at + count],
                    modal: lists.map(|list| &list[modes.clone()]),
                    watched: [first, second],
                });
            }
            shown
        };
        let missed = show(&own.missed, [&self.a, now.a]);
        let rates = show(&own.shapes, [&self.v, now.v]);
        let [_, off] = show(&own.off, [now.a, now.a]);
        for row in 0..ROWS {
            let place = block + row;
            let ends = Ends {
                then: [self.values[1][place] + missed[0][row], rates[0][row]],
                now: [self.values[0][place] + missed[1][row], rates[1][row]],
            };
            let so_far = [self.greatest[place], self.least[place]];
            [self.greatest[place], self.least[place]] = ends.extremes(so_far, step);
            let with_off = ends.now[0].abs() + off[row].abs();
            self.with_off[place] = self.with_off[place].max(with_off);
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
                let mut sum = passed.ground[row][0] * now.ground;
                for (blocks, modal) in passed.shares.iter().zip([now.q, now.v, now.a]) {
                    for mode in 0..own.modes.len() {
                        sum += own.value(blocks, row, mode) * list(modal, mode);
                    }
                }
                let contacts = passed.contacts[row].iter();
                sum -= contacts.map(|c| now.phases[*c].force()).sum::<f64>();
                self.row[index][*form] = sum;
            }
        }
        history.push(system, now.time, &self.row);
    }

    /// Greatest and least value of every form of every building, and the histories.
    pub(super) fn finish(
        self,
        system: &System,
        reduced: &Reduced,
    ) -> (Vec<Vec<[f64; 2]>>, Option<MemberHistory>) {
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
                let [greatest, least] = self.passed_extremes[place];
                extremes[*form][0] += greatest;
                extremes[*form][1] += least;
            }
            all.push(extremes);
        }
        (all, self.history)
    }

    /// Greatest size of every kind of force in a building.
    fn scales(&self, own: &MemberRows) -> [f64; KINDS] {
        let mut scales = [f64::MIN_POSITIVE; KINDS];
        for (place, kind) in own.range.clone().zip(&own.kinds) {
            let size = self.greatest[place].max(-self.least[place]);
            scales[*kind] = scales[*kind].max(size);
        }
        for place in own.passed.range.clone() {
            let [greatest, least] = self.passed_extremes[place];
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
