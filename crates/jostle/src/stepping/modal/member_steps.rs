//! Accepted steps of a modal run that are kept until the forces of columns and beams are looked at.

use super::member_reach::{BatchReach, PARTS, Reach};
use super::reduced::Reduced;
use crate::state::ContactPhase;
use crate::system::GroundsAt;

/// Most steps of a batch, which are looked at together.
pub(super) const STEPS: usize = 8;
/// Their ends.
pub(super) const INSTANTS: usize = STEPS + 1;
/// Lists of modal values that are kept: q, its rate, the rate of that and the jerk.
pub(super) const LISTS: usize = 4;

/// Batches of every part of modes that are looked at first.
const FARTHEST: usize = 3;
/// Memory for the modal values of kept steps \[B\].
const MEMORY: usize = 16 << 20;
/// Least and greatest number of kept instants.
const FEWEST: usize = 8 * INSTANTS;
const MOST: usize = 1 << 14;

/// Steps in batches. The instant at which a batch begins is kept apart from the end of the batch before it, because velocities may
/// jump between them.
pub(super) struct KeptSteps {
    /// Modal displacements, velocities, accelerations and jerks, building by building; instant after instant.
    modal: Vec<f64>,
    /// Ground acceleration of every building, and forces of all contacts; instant after instant.
    ground: Vec<f64>,
    pushes: Vec<f64>,
    /// Length of the step that ends at every instant \[s\].
    lengths: Vec<f64>,
    batches: Vec<Batch>,
    /// What modes do in every batch, building by building.
    reach: Vec<BatchReach>,
    /// Number of instants, and most of them.
    count: usize,
    room: usize,
    modes: usize,
    buildings: usize,
    contacts: usize,
}

/// Steps one after the other.
#[derive(Clone, Copy)]
struct Batch {
    /// Instant at which it begins.
    first: usize,
    steps: usize,
    /// Whether accelerations follow a cubic in its steps.
    smooth: bool,
}

/// Steps of one batch and one building.
#[derive(Clone, Copy)]
pub(super) struct Steps<'a> {
    modal: &'a [f64],
    ground: &'a [f64],
    pushes: &'a [f64],
    stride: usize,
    buildings: usize,
    contacts: usize,
    /// Number of modes of the building.
    pub(super) modes: usize,
    /// Length of every step \[s\].
    pub(super) lengths: &'a [f64],
    /// Whether accelerations follow a cubic.
    pub(super) smooth: bool,
}

impl KeptSteps {
    /// At rest.
    pub(super) fn new(reduced: &Reduced, contacts: usize) -> Self {
        let (modes, buildings) = (reduced.modes(), reduced.buildings.len());
        let of_instant = size_of::<f64>() * LISTS * modes.max(1);
        let room = (MEMORY / of_instant).clamp(FEWEST, MOST);
        // A batch has two instants or more.
        let batches = room / 2 + 1;
        let mut kept = Self {
            modal: vec![0.0; room * LISTS * modes],
            ground: vec![0.0; room * buildings],
            pushes: vec![0.0; room * contacts],
            lengths: vec![0.0; room],
            batches: Vec::with_capacity(batches),
            reach: vec![BatchReach::default(); batches * buildings],
            count: 0,
            room,
            modes,
            buildings,
            contacts,
        };
        kept.begin_batch(true);
        kept
    }

    /// Whether there is no room for another step.
    pub(super) fn is_full(&self) -> bool {
        self.count + 2 > self.room
    }

    /// Number of batches.
    pub(super) fn batches(&self) -> usize {
        self.batches.len()
    }

    /// Whether no step is kept.
    pub(super) fn is_empty(&self) -> bool {
        self.batches.iter().all(|batch| batch.steps == 0)
    }

    /// Begins a batch at the end of the last step.
    fn begin_batch(&mut self, smooth: bool) {
        let first = self.count;
        if let Some(last) = first.checked_sub(1) {
            let own = |size: usize| last * size..first * size;
            let of_modes = LISTS * self.modes;
            self.modal.copy_within(own(of_modes), first * of_modes);
            self.ground
                .copy_within(own(self.buildings), first * self.buildings);
            self.pushes
                .copy_within(own(self.contacts), first * self.contacts);
        }
        self.count += 1;
        let batch = self.batches.len() * self.buildings;
        self.reach[batch..][..self.buildings].fill(BatchReach::default());
        self.batches.push(Batch {
            first,
            steps: 0,
            smooth,
        });
    }

    /// The last batch, with room for a step in which accelerations follow a cubic or not.
    fn open_batch(&mut self, smooth: bool) -> &mut Batch {
        let fits =
            |batch: &Batch| batch.steps == 0 || batch.steps < STEPS && batch.smooth == smooth;
        if !self.batches.last().is_some_and(fits) {
            self.begin_batch(smooth);
        }
        let last = self.batches.len() - 1;
        let batch = &mut self.batches[last];
        batch.smooth = smooth;
        batch
    }

    /// Adds a step that ends with these modal displacements, velocities, accelerations and jerks.
    pub(super) fn push(
        &mut self,
        reduced: &Reduced,
        lists: [&[f64]; LISTS],
        ground: GroundsAt<'_>,
        phases: &[ContactPhase],
        (length, smooth): (f64, bool),
    ) {
        self.open_batch(smooth).steps += 1;
        let instant = self.count;
        self.count += 1;
        self.lengths[instant] = length;
        self.set_last(reduced, 0, &lists);
        let of_grounds = &mut self.ground[instant * self.buildings..][..self.buildings];
        for (index, to) in of_grounds.iter_mut().enumerate() {
            *to = ground.of(index)[0];
        }
        let of_contacts = &mut self.pushes[instant * self.contacts..][..self.contacts];
        for (to, phase) in of_contacts.iter_mut().zip(phases) {
            *to = phase.force();
        }
    }

    /// Adds what the modes of a building did in the last step.
    pub(super) fn add_reach(&mut self, building: usize, step: &Reach) {
        let last = self.batches.len() - 1;
        self.reach[last * self.buildings + building].add(step);
    }

    /// Replaces velocities, accelerations and jerks at the end of the last step: the next one begins with the new ones.
    pub(super) fn restart(&mut self, reduced: &Reduced, jumped: [&[f64]; LISTS - 1]) {
        if self.batches.last().is_some_and(|batch| batch.steps > 0) {
            self.begin_batch(true);
        }
        self.set_last(reduced, 1, &jumped);
    }

    /// Replaces the lists from `part` on at the last instant.
    fn set_last(&mut self, reduced: &Reduced, part: usize, lists: &[&[f64]]) {
        let instant =
            &mut self.modal[(self.count - 1) * LISTS * self.modes..][..LISTS * self.modes];
        for own in &reduced.buildings {
            let modes = own.members.modes();
            let count = modes.len();
            let to = &mut instant[LISTS * modes.start + part * count..LISTS * modes.end];
            for (to, list) in to.chunks_mut(count.max(1)).zip(lists) {
                to.copy_from_slice(&list[modes.clone()]);
            }
        }
    }

    /// Starts anew at the end of the last step.
    pub(super) fn clear(&mut self) {
        let last = |size: usize| (self.count - 1) * size..self.count * size;
        self.modal.copy_within(last(LISTS * self.modes), 0);
        self.ground.copy_within(last(self.buildings), 0);
        self.pushes.copy_within(last(self.contacts), 0);
        self.batches.clear();
        self.count = 0;
        self.begin_batch(true);
    }

    /// A batch; `modes`: those of the building among all.
    pub(super) fn batch(
        &self,
        batch: usize,
        building: usize,
        modes: &std::ops::Range<usize>,
    ) -> Steps<'_> {
        let Batch {
            first,
            steps,
            smooth,
        } = self.batches[batch];
        self.from(first, steps, smooth, building, modes)
    }

    /// The last step.
    pub(super) fn last_step(&self, building: usize, modes: &std::ops::Range<usize>) -> Steps<'_> {
        self.from(self.count - 2, 1, true, building, modes)
    }

    fn from(
        &self,
        first: usize,
        steps: usize,
        smooth: bool,
        building: usize,
        modes: &std::ops::Range<usize>,
    ) -> Steps<'_> {
        Steps {
            modal: &self.modal[first * LISTS * self.modes + LISTS * modes.start..],
            ground: &self.ground[first * self.buildings + building..],
            pushes: &self.pushes[first * self.contacts..],
            stride: LISTS * self.modes,
            buildings: self.buildings,
            contacts: self.contacts,
            modes: modes.len(),
            lengths: &self.lengths[first + 1..=first + steps],
            smooth,
        }
    }

    /// What the modes of a building do in a batch.
    pub(super) fn reach(&self, batch: usize, building: usize) -> &BatchReach {
        &self.reach[batch * self.buildings + building]
    }

    /// Batches in which some modes of a building come farthest from rest, a few for every part.
    pub(super) fn farthest(&self, building: usize) -> [[usize; FARTHEST]; PARTS] {
        std::array::from_fn(|part| {
            let mut found = [(-1.0, 0); FARTHEST];
            for batch in 0..self.batches() {
                let mut next = (self.reach(batch, building).size[part], batch);
                for known in &mut found {
                    if next.0 > known.0 {
                        std::mem::swap(known, &mut next);
                    }
                }
            }
            found.map(|(_, batch)| batch)
        })
    }

    /// Raises the greatest accelerations of the modes of a building so far.
    pub(super) fn raise_accelerations(&self, modes: &std::ops::Range<usize>, known: &mut [f64]) {
        let at = LISTS * modes.start + 2 * modes.len();
        for instant in self.modal.chunks(LISTS * self.modes).take(self.count) {
            for (known, a) in known.iter_mut().zip(&instant[at..]) {
                let size = a.abs();
                *known = if size > *known { size } else { *known };
            }
        }
    }
}

impl<'a> Steps<'a> {
    /// Number of steps.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.lengths.len()
    }

    /// The lists from `part` on at an instant, one after the other.
    #[inline(always)]
    pub(super) fn from(&self, instant: usize, part: usize) -> &'a [f64] {
        let first = instant * self.stride;
        &self.modal[first + part * self.modes..first + LISTS * self.modes]
    }

    /// One list at an instant.
    #[inline(always)]
    pub(super) fn list(&self, instant: usize, part: usize) -> &'a [f64] {
        &self.from(instant, part)[..self.modes]
    }

    /// Ground acceleration at an instant \[m/s²\].
    #[inline(always)]
    pub(super) fn ground(&self, instant: usize) -> f64 {
        self.ground[instant * self.buildings]
    }

    /// Forces of all contacts at an instant \[N\].
    #[inline(always)]
    pub(super) fn pushes(&self, instant: usize) -> &'a [f64] {
        &self.pushes[instant * self.contacts..][..self.contacts]
    }
}
