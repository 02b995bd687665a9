//! Accepted steps of a modal run that wait until the forces of columns and beams are looked at, several steps together.

use super::reduced::Reduced;
use crate::state::ContactPhase;
use crate::system::GroundsAt;

/// Most steps that are looked at together.
pub(super) const STEPS: usize = 8;
/// Their ends.
pub(super) const INSTANTS: usize = STEPS + 1;
/// Lists of modal values that are kept: q, its rate, the rate of that and the jerk.
pub(super) const LISTS: usize = 4;

/// Steps that wait, and the instants at which they begin and end.
pub(super) struct WaitingSteps {
    /// Modal displacements, velocities, accelerations and jerks, building by building; instant after instant.
    modal: Vec<f64>,
    /// Ground acceleration of every building, and forces of all contacts; instant after instant.
    ground: Vec<f64>,
    pushes: Vec<f64>,
    lengths: [f64; STEPS],
    count: usize,
    /// Whether accelerations follow a cubic in these steps.
    pub(super) smooth: bool,
    modes: usize,
    buildings: usize,
    contacts: usize,
}

/// Waiting steps of one building.
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
}

impl WaitingSteps {
    /// At rest.
    pub(super) fn new(reduced: &Reduced, contacts: usize) -> Self {
        let (modes, buildings) = (reduced.modes(), reduced.buildings.len());
        Self {
            modal: vec![0.0; INSTANTS * LISTS * modes],
            ground: vec![0.0; INSTANTS * buildings],
            pushes: vec![0.0; INSTANTS * contacts],
            lengths: [0.0; STEPS],
            count: 0,
            smooth: false,
            modes,
            buildings,
            contacts,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub(super) fn is_full(&self) -> bool {
        self.count == STEPS
    }

    /// Adds a step that ends with these modal displacements, velocities, accelerations and jerks.
    pub(super) fn push(
        &mut self,
        reduced: &Reduced,
        lists: [&[f64]; LISTS],
        ground: GroundsAt<'_>,
        phases: &[ContactPhase],
        length: f64,
    ) {
        self.lengths[self.count] = length;
        self.count += 1;
        self.set_from(reduced, 0, &lists);
        let first = self.count * self.buildings;
        for (index, to) in self.ground[first..][..self.buildings]
            .iter_mut()
            .enumerate()
        {
            *to = ground.of(index)[0];
        }
        let first = self.count * self.contacts;
        for (to, phase) in self.pushes[first..][..self.contacts].iter_mut().zip(phases) {
            *to = phase.force();
        }
    }

    /// Replaces the lists from `part` on at the end of the last step.
    pub(super) fn set_from(&mut self, reduced: &Reduced, part: usize, lists: &[&[f64]]) {
        let instant = &mut self.modal[self.count * LISTS * self.modes..][..LISTS * self.modes];
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
        let last = |size: usize| self.count * size..(self.count + 1) * size;
        self.modal.copy_within(last(LISTS * self.modes), 0);
        self.ground.copy_within(last(self.buildings), 0);
        self.pushes.copy_within(last(self.contacts), 0);
        self.count = 0;
    }

    /// Those of a building; `modes`: its modes among all.
    pub(super) fn of(&self, building: usize, modes: &std::ops::Range<usize>) -> Steps<'_> {
        Steps {
            modal: &self.modal[LISTS * modes.start..],
            ground: &self.ground[building..],
            pushes: &self.pushes,
            stride: LISTS * self.modes,
            buildings: self.buildings,
            contacts: self.contacts,
            modes: modes.len(),
            lengths: &self.lengths[..self.count],
        }
    }

    /// Number of steps.
    pub(super) fn len(&self) -> usize {
        self.count
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
