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
pub(super) const MEMORY: usize = 16 << 20;
/// Least and greatest number of kept instants.
const FEWEST: usize = 8 * INSTANTS;
const MOST: usize = 1 << 14;

#[cfg(test)]
thread_local! {
    /// Memory for kept steps in tests \[B\].
    pub(super) static MEMORY_IN_TESTS: std::cell::Cell<usize> = const { std::cell::Cell::new(MEMORY) };
}

#[cfg(test)]
fn memory() -> usize {
    MEMORY_IN_TESTS.get()
}

#[cfg(not(test))]
const fn memory() -> usize {
    MEMORY
}

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
    /// Most instants.
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
        let room = (memory() / of_instant).clamp(FEWEST, MOST);
        // A batch has two instants or more.
        let batches = room / 2 + 1;
        // Memory is set aside but not touched before it is used: to fill it would take longer than the steps.
        let mut kept = Self {
            modal: Vec::with_capacity(room * LISTS * modes),
            ground: Vec::with_capacity(room * buildings),
            pushes: Vec::with_capacity(room * contacts),
            lengths: Vec::with_capacity(room),
            batches: Vec::with_capacity(batches),
            reach: Vec::with_capacity(batches * buildings),
            room,
            modes,
            buildings,
            contacts,
        };
        kept.modal.resize(LISTS * modes, 0.0);
        kept.ground.resize(buildings, 0.0);
        kept.pushes.resize(contacts, 0.0);
        kept.lengths.push(0.0);
        kept.open(true);
        kept
    }

    /// Number of instants.
    fn count(&self) -> usize {
        self.lengths.len()
    }

    /// Whether there is no room for another step.
    pub(super) fn is_full(&self) -> bool {
        self.count() + 2 > self.room
    }

    /// Number of batches.
    pub(super) fn batches(&self) -> usize {
        self.batches.len()
    }

    /// Whether no step is kept.
    pub(super) fn is_empty(&self) -> bool {
        self.batches.iter().all(|batch| batch.steps == 0)
    }

    /// Begins a batch at the end of the last step, as an instant of its own.
    fn begin_batch(&mut self, smooth: bool) {
        let last = self.count() - 1;
        let last_range = |size: usize| last * size..(last + 1) * size;
        self.modal
            .extend_from_within(last_range(LISTS * self.modes));
        self.ground.extend_from_within(last_range(self.buildings));
        self.pushes.extend_from_within(last_range(self.contacts));
        self.lengths.push(0.0);
        self.open(smooth);
    }

    /// Opens a batch at the last instant.
    fn open(&mut self, smooth: bool) {
        let reach = self.reach.len() + self.buildings;
        self.reach.resize(reach, BatchReach::default());
        self.batches.push(Batch {
            first: self.count() - 1,
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
        self.lengths.push(length);
        for building in &reduced.buildings {
            for list in lists {
                self.modal
                    .extend_from_slice(&list[building.members.modes()]);
            }
        }
        let buildings = 0..self.buildings;
        self.ground
            .extend(buildings.map(|index| ground.of(index)[0]));
        self.pushes.extend(phases.iter().map(ContactPhase::force));
        debug_assert_eq!(self.pushes.len(), self.count() * self.contacts);
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
        let last = (self.count() - 1) * LISTS * self.modes;
        let instant = &mut self.modal[last..];
        for building in &reduced.buildings {
            let modes = building.members.modes();
            let count = modes.len();
            let to = &mut instant[LISTS * modes.start + count..LISTS * modes.end];
            for (to, list) in to.chunks_mut(count.max(1)).zip(jumped) {
                to.copy_from_slice(&list[modes.clone()]);
            }
        }
    }

    /// Starts anew at the end of the last step.
    pub(super) fn clear(&mut self) {
        let before = self.count() - 1;
        self.modal.drain(..before * LISTS * self.modes);
        self.ground.drain(..before * self.buildings);
        self.pushes.drain(..before * self.contacts);
        self.lengths.drain(..before);
        self.batches.clear();
        self.reach.clear();
        self.open(true);
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
        self.from(self.count() - 2, 1, true, building, modes)
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
        for instant in self.modal.chunks(LISTS * self.modes) {
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
