//! Forces of columns and beams in modal coordinates.

use std::ops::Range;

use super::basis::Basis;
use super::member_kernels::{self, FollowOwn};
use super::member_ratios::{ModalRatios, StepEnds};
use super::member_reach::{PARTS, PartRows, Reach, low_modes, norms_in_blocks};
use super::member_steps::KeptSteps;
use super::mode_kernels::ROWS;
use super::passed_kernels::{Drive, FollowPassed};
use super::reduced::{Reduced, in_blocks};
use super::unit_force::UnitForce;
use crate::history::MemberHistory;
use crate::linear::{Row, sort_by_key};
use crate::simd;
use crate::state::ContactPhase;
use crate::stepping::Settings;
use crate::stepping::member_ratios::MemberRatios;
use crate::structure::MemberSection;
use crate::system::{BuildingSystem, GroundsAt, System};

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
    pub(super) shapes: Vec<[f64; ROWS]>,
    pub(super) missed: Vec<[f64; ROWS]>,
    pub(super) off: Vec<[f64; ROWS]>,
    /// Most that every row changes per ‖ω Δq‖, block by block.
    pub(super) norms: Vec<PartRows>,
    /// Axial forces that pass through rigid beams: they also follow from velocities, accelerations and pushes.
    passed: Passed,
}

/// Axial forces of beams that keep their length.
#[derive(Default)]
pub(super) struct Passed {
    pub(super) range: Range<usize>,
    pub(super) forms: Vec<usize>,
    /// Shares of modal displacements, velocities and accelerations, one after the other.
    pub(super) shares: Vec<[f64; ROWS]>,
    /// Its bounds, block by block.
    pub(super) bounds: Vec<PassedBounds>,
    /// Force per ground acceleration, and per rate of it while modes are free \[kg\].
    pub(super) ground: Vec<[f64; 2]>,
    pub(super) contacts: Vec<Vec<usize>>,
}

/// What bounds eight axial forces that pass through rigid beams. Accelerations follow from the equations of modes,
/// q̈ = −Γ a_g − D q̇ − K q + Σ φ f of contact forces f, so that displacements, velocities, the ground and contacts remain.
pub(super) struct PassedBounds {
    /// Shares of the displacements of low modes, mode by mode.
    pub(super) low: Vec<[f64; ROWS]>,
    /// Most that a row changes per ‖ω Δq‖ and per ‖ω q̇‖.
    pub(super) norms: PartRows,
    pub(super) norms_of_rates: PartRows,
    /// Per ground acceleration \[kg\], and per contact force, contact by contact.
    pub(super) ground: [f64; ROWS],
    pub(super) pushed: Vec<[f64; ROWS]>,
}

impl PassedBounds {
    /// `rows`: shares of displacements, velocities and accelerations of up to eight rows; `ground`: their forces per ground
    /// acceleration.
    fn new(rows: &[Vec<f64>], ground: &[[f64; 2]], basis: &Basis, damping: &[f64]) -> Self {
        let (stiffness, count) = (&basis.modes.stiffness, basis.len());
        let (mut by_q, mut by_v, mut of_ground) = (Vec::new(), Vec::new(), [0.0; ROWS]);
        for (row, (shares, [fixed, _])) in rows.iter().zip(ground).enumerate() {
            let [q, v, a] = [0, 1, 2].map(|part| &shares[part * count..(part + 1) * count]);
            let less = |values: &[f64], factors: &[f64]| -> Vec<f64> {
                let lists = values.iter().zip(a).zip(factors);
                lists
                    .map(|((value, a), factor)| value - a * factor)
                    .collect()
            };
            by_q.push(less(q, stiffness));
            by_v.push(less(v, damping));
            of_ground[row] = (fixed - simd::dot(a, &basis.modes.participation)).abs();
        }
        let low: Vec<Vec<f64>> = by_q
            .iter()
            .map(|row| row[..low_modes(count)].to_vec())
            .collect();
        let one = |rows: &[Vec<f64>]| {
            let blocks = norms_in_blocks(rows.iter(), stiffness);
            blocks.first().copied().unwrap_or([[0.0; ROWS]; PARTS])
        };
        Self {
            low: in_blocks(&low, low_modes(count)),
            norms: one(&by_q),
            norms_of_rates: one(&by_v),
            ground: of_ground,
            pushed: Vec::new(),
        }
    }
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
        let (mut followed, passed): (Vec<usize>, Vec<usize>) =
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
            for (kind, form) in section.by_kind() {
                kind_of[form] = kind;
            }
        }
        for joint in &building.members.joints {
            kind_of[joint.section.forms[1]] = 1;
        }
        // Blocks of one kind, storey by storey: their rows come near their peaks together.
        sort_by_key(&mut followed, |form| kind_of[*form]);
        let dense = |row: &Row| basis.of_shapes(|shape| row.value(shape));
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
        let bounds = shares.chunks(ROWS).zip(ground.chunks(ROWS));
        let bounds = bounds.map(|(rows, ground)| PassedBounds::new(rows, ground, basis, damping));
        let padded = |start: usize, count: usize| start..start + count.div_ceil(ROWS) * ROWS;
        Self {
            range: padded(starts[0], followed.len()),
            norms: norms_in_blocks(
                followed.iter().map(|form| &rows.shapes[*form]),
                &basis.modes.stiffness,
            ),
            kinds: followed.iter().map(|form| kind_of[*form]).collect(),
            shapes: pick(Some(rows.shapes), &followed),
            missed: pick(rows.missed, &followed),
            off: pick(rows.off, &followed),
            passed: Passed {
                range: padded(starts[1], passed.len()),
                bounds: bounds.collect(),
                shares: in_blocks(&shares, 3 * count),
                ground,
                contacts: passed
                    .iter()
                    .map(|form| forms[*form].contacts.clone())
                    .collect(),
                forms: passed,
            },
            forms: followed,
            modes,
        }
    }

    /// Completes the bounds of forces that pass through rigid beams with what contacts do to them.
    pub(super) fn set_pushes(&mut self, unit_forces: &[UnitForce]) {
        let (count, passed) = (self.modes.len(), &mut self.passed);
        for (block, bounds) in passed.bounds.iter_mut().enumerate() {
            let inertia = &passed.shares[(3 * block + 2) * count..3 * (block + 1) * count];
            bounds.pushed = vec![[0.0; ROWS]; unit_forces.len()];
            for (contact, (push, to)) in unit_forces.iter().zip(&mut bounds.pushed).enumerate() {
                for (row, to) in to.iter_mut().enumerate() {
                    let mut sum = 0.0;
                    for (mode, inertia) in self.modes.clone().zip(inertia) {
                        let place = mode.checked_sub(push.modes.start);
                        let load = place.and_then(|place| push.loads.get(place));
                        sum += inertia[row] * load.unwrap_or(&0.0);
                    }
                    let contacts = passed.contacts.get(block * ROWS + row);
                    if contacts.is_some_and(|contacts| contacts.contains(&contact)) {
                        sum -= 1.0;
                    }
                    *to = sum.abs();
                }
            }
        }
    }

    /// Where the rows of the next building begin.
    pub(super) fn ends(&self) -> [usize; 2] {
        [self.range.end, self.passed.range.end]
    }

    fn value(&self, blocks: &[[f64; ROWS]], row: usize, mode: usize) -> f64 {
        blocks[row / ROWS * self.modes.len() + mode][row % ROWS]
    }

    /// Blocks of rows that displacements determine, among those of all buildings.
    fn blocks(&self) -> Range<usize> {
        self.range.start / ROWS..self.range.end / ROWS
    }

    /// Modes of the building among all.
    pub(super) fn modes(&self) -> Range<usize> {
        self.modes.clone()
    }

    /// Shares of modal displacements in a force that displacements determine, and those of accelerations that shapes
    /// miss, if any; `None` for other forces.
    pub(super) fn own_row(&self, form: usize) -> Option<[Vec<f64>; 2]> {
        let row = self.forms.iter().position(|candidate| *candidate == form)?;
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
        let Some(row) = passed.forms.iter().position(|candidate| *candidate == form) else {
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
    pub(super) ground: GroundsAt<'a>,
    pub(super) phases: &'a [ContactPhase],
    /// Whether accelerations followed a cubic since the last instant.
    pub(super) smooth: bool,
}

/// Follows the forces of columns and beams. Steps are kept and looked at in batches: first those in which modes come farthest from rest.
/// A block of forces is computed in a batch only if one of them can exceed its greatest or least value. The bits of these are the same as
/// if all forces were computed in every step.
pub(super) struct MemberPeaks {
    /// Greatest and least value, and greatest size with what may be missed.
    greatest: Vec<[f64; ROWS]>,
    least: Vec<[f64; ROWS]>,
    with_off: Vec<[f64; ROWS]>,
    /// Of every row, most that accelerations add to what displacements say, with what may be off.
    loose: Vec<[f64; ROWS]>,
    /// The greatest acceleration of every mode, building by building.
    accelerations: Vec<f64>,
    /// What the modes of every building have done.
    reach: Vec<Reach>,
    /// The same of axial forces that pass through beams.
    passed_greatest: Vec<[f64; ROWS]>,
    passed_least: Vec<[f64; ROWS]>,
    drive: Drive,
    /// Whether modes are driven by other forces than the ground's and those of contacts.
    is_linked: bool,
    kept: KeptSteps,
    time: f64,
    pub(super) history: Option<MemberHistory>,
    /// Demand over capacity of those that are rated.
    ratios: Option<ModalRatios>,
    /// Values of all forms at a row of the history, and whether it is wanted.
    row: Vec<Vec<f64>>,
    wanted: Vec<Vec<bool>>,
}

#[cfg(test)]
thread_local! {
    /// Whether all forces are computed in every step.
    pub(super) static LOOK_ALWAYS: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

#[cfg(test)]
pub(super) fn tests_look_always() -> bool {
    LOOK_ALWAYS.get()
}

#[cfg(not(test))]
pub(super) const fn tests_look_always() -> bool {
    false
}

impl MemberPeaks {
    /// `None` where no forces are asked for.
    pub(super) fn new(system: &System, reduced: &Reduced, settings: Settings) -> Option<Self> {
        let [end, passed] = reduced.buildings.last()?.members.ends();
        if end + passed == 0 {
            return None;
        }
        let sizes = || system.buildings.iter().map(|b| b.members.forms.len());
        let mut wanted: Vec<Vec<bool>> = sizes().map(|n| vec![false; n]).collect();
        for [building, member] in &system.members_followed {
            let member = &system.buildings[*building].members.members[*member];
            for (_, form) in member.sections.iter().flat_map(MemberSection::by_kind) {
                wanted[*building][form] = true;
            }
        }
        let buildings = || reduced.buildings.iter().map(|building| &building.members);
        Some(Self {
            greatest: vec![[0.0; ROWS]; end / ROWS],
            least: vec![[0.0; ROWS]; end / ROWS],
            with_off: vec![[0.0; ROWS]; end / ROWS],
            loose: vec![[0.0; ROWS]; end / ROWS],
            accelerations: vec![0.0; reduced.modes()],
            reach: buildings()
                .map(|building| Reach::new(building.modes.len()))
                .collect(),
            passed_greatest: vec![[0.0; ROWS]; passed / ROWS],
            passed_least: vec![[0.0; ROWS]; passed / ROWS],
            drive: Drive::new(system.contacts.len()),
            is_linked: !reduced.links.is_empty(),
            kept: KeptSteps::new(reduced, system.contacts.len()),
            time: 0.0,
            history: settings
                .record_interval
                .and_then(|_| MemberHistory::new(system, settings.storage)),
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
        self.time = now.time;
        if self.kept.is_full() {
            self.look_at_kept(reduced);
        }
        let lists = [now.q, now.v, now.a, now.jerk];
        let length = (step, now.smooth && step > 0.0);
        self.kept
            .push(reduced, lists, now.ground, now.phases, length);
        for (index, building) in reduced.buildings.iter().enumerate() {
            let members = &building.members;
            let stiffness = &reduced.stiffness[members.modes.clone()];
            let steps = self.kept.last_step(index, &members.modes);
            let [then, now_of_building] =
                [0, 1].map(|end| [0, 1, 2].map(|part| steps.list(end, part)));
            let reach = &mut self.reach[index];
            reach.add(reduced.arch(), stiffness, now_of_building, then[0], step);
            if let Some(ratios) = &mut self.ratios {
                let ends = StepEnds {
                    then,
                    now: now_of_building,
                    ground: [0, 1].map(|end| steps.ground(end)),
                    step,
                };
                let of = (system, index, &self.reach[index]);
                ratios.follow(reduced.arch(), of, &ends, now);
            }
            self.kept.add_reach(index, &self.reach[index]);
        }
    }

    /// Replaces velocities, accelerations and jerks of the last instant, after they have jumped.
    pub(super) fn restart(&mut self, reduced: &Reduced, jumped: [&[f64]; 3]) {
        if self.kept.is_full() {
            self.look_at_kept(reduced);
        }
        self.kept.restart(reduced, jumped);
        for (index, building) in reduced.buildings.iter().enumerate() {
            let members = &building.members;
            let [velocities, accelerations, _] = jumped.map(|list| &list[members.modes.clone()]);
            let stiffness = &reduced.stiffness[members.modes.clone()];
            let jumped = [velocities, accelerations];
            self.reach[index].restart(reduced.arch(), stiffness, jumped);
        }
    }

    /// Looks at the steps that are kept.
    pub(super) fn look_at_kept(&mut self, reduced: &Reduced) {
        if self.kept.is_empty() {
            return;
        }
        for (index, building) in reduced.buildings.iter().enumerate() {
            let members = &building.members;
            if !members.missed.is_empty() {
                let known = &mut self.accelerations[members.modes.clone()];
                self.kept.raise_accelerations(&members.modes, known);
                member_kernels::set_loose(members, known, &mut self.loose[members.blocks()]);
            }
            // Next to great values others seldom count.
            let first = self.kept.farthest(index);
            let first = first.as_flattened();
            for (at, batch) in first.iter().enumerate() {
                if !first[..at].contains(batch) {
                    self.look_at_batch(reduced, index, *batch);
                }
            }
            for batch in 0..self.kept.batches() {
                if !first.contains(&batch) {
                    self.look_at_batch(reduced, index, batch);
                }
            }
        }
        self.kept.clear();
    }

    fn look_at_batch(&mut self, reduced: &Reduced, index: usize, batch: usize) {
        let members = &reduced.buildings[index].members;
        let steps = self.kept.batch(batch, index, &members.modes);
        let reach = self.kept.reach(batch, index);
        let blocks = members.blocks();
        reduced.arch().dispatch(FollowOwn {
            rows: members,
            reach,
            greatest: &mut self.greatest[blocks.clone()],
            least: &mut self.least[blocks.clone()],
            with_off: &mut self.with_off[blocks.clone()],
            loose: &self.loose[blocks],
            steps,
        });
        let passed = &members.passed;
        if passed.range.is_empty() {
            return;
        }
        self.drive.set(&steps);
        let blocks = passed.range.start / ROWS..passed.range.end / ROWS;
        reduced.arch().dispatch(FollowPassed {
            passed,
            reach,
            drive: &self.drive,
            greatest: &mut self.passed_greatest[blocks.clone()],
            least: &mut self.passed_least[blocks],
            steps,
            is_bounded: !self.is_linked,
        });
    }

    /// Adds a row to the histories.
    pub(super) fn record(&mut self, system: &System, reduced: &Reduced, now: Instant<'_>) {
        let Some(history) = &mut self.history else {
            return;
        };
        for (index, building) in reduced.buildings.iter().enumerate() {
            let members = &building.members;
            let list = |list: &[f64], mode: usize| list[members.modes.start + mode];
            let forms = &system.buildings[index].members.forms;
            for (row, form) in members.forms.iter().enumerate() {
                if !self.wanted[index][*form] {
                    continue;
                }
                let mut sum = forms[*form].constant;
                for mode in 0..members.modes.len() {
                    sum += members.value(&members.shapes, row, mode) * list(now.q, mode);
                    if !members.missed.is_empty() {
                        sum += members.value(&members.missed, row, mode) * list(now.a, mode);
                    }
                }
                self.row[index][*form] = sum;
            }
            let passed = &members.passed;
            for (row, form) in passed.forms.iter().enumerate() {
                if !self.wanted[index][*form] {
                    continue;
                }
                let mut sum = passed.ground[row][0] * now.ground.of(index)[0];
                let count = members.modes.len();
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
        for (building, reduced_building) in system.buildings.iter().zip(&reduced.buildings) {
            let members = &reduced_building.members;
            let constants = building.members.forms.iter().map(|form| form.constant);
            let mut extremes: Vec<[f64; 2]> = constants.map(|constant| [constant; 2]).collect();
            for (place, form) in members.range.clone().zip(&members.forms) {
                extremes[*form][0] += self.greatest.as_flattened()[place];
                extremes[*form][1] += self.least.as_flattened()[place];
            }
            for (place, form) in members.passed.range.clone().zip(&members.passed.forms) {
                extremes[*form][0] += self.passed_greatest.as_flattened()[place];
                extremes[*form][1] += self.passed_least.as_flattened()[place];
            }
            all.push(extremes);
        }
        let ratios = self.ratios.map(ModalRatios::finish);
        (all, self.history, ratios.unwrap_or_default())
    }

    /// Greatest size of every kind of force in a building.
    fn scales(&self, rows: &MemberRows) -> [f64; KINDS] {
        let mut scales = [f64::MIN_POSITIVE; KINDS];
        for (place, kind) in rows.range.clone().zip(&rows.kinds) {
            let size = self.greatest.as_flattened()[place].max(-self.least.as_flattened()[place]);
            scales[*kind] = scales[*kind].max(size);
        }
        for place in rows.passed.range.clone() {
            let (greatest, least) = (
                self.passed_greatest.as_flattened()[place],
                self.passed_least.as_flattened()[place],
            );
            scales[0] = scales[0].max(greatest).max(-least);
        }
        scales
    }

    /// Estimated errors of the forces of a building relative to the greatest of their kind: by shapes that are left out,
    /// and, with the greatest errors of modes between the ends of free steps, by cubics there \[–\].
    pub(super) fn errors(&self, rows: &MemberRows, free: impl Fn(usize) -> f64) -> [f64; 2] {
        let scales = self.scales(rows);
        let free: Vec<f64> = (0..rows.modes.len()).map(free).collect();
        let (mut shapes, mut between) = (0.0_f64, 0.0_f64);
        for (row, kind) in rows.kinds.iter().enumerate() {
            let place = rows.range.start + row;
            let known = self.greatest.as_flattened()[place].max(-self.least.as_flattened()[place]);
            let off = (self.with_off.as_flattened()[place] - known).max(0.0);
            shapes = shapes.max(off / scales[*kind]);
            let squares = free.iter().enumerate();
            let squares =
                squares.map(|(mode, q)| (rows.value(&rows.shapes, row, mode) * q).powi(2));
            between = between.max(squares.sum::<f64>().sqrt() / scales[*kind]);
        }
        [shapes, between]
    }

    /// The greatest share of a mode, per acceleration, in what the forces of a building may be off \[s²·m⁻¹·kg^−½\].
    pub(super) fn off_by_mode(&self, member_rows: &MemberRows, mode: usize) -> f64 {
        if member_rows.off.is_empty() {
            return 0.0;
        }
        let scales = self.scales(member_rows);
        let rows = member_rows.kinds.iter().enumerate();
        rows.map(|(row, kind)| {
            (member_rows.value(&member_rows.off, row, mode) / scales[*kind]).abs()
        })
        .fold(0.0, f64::max)
    }
}
