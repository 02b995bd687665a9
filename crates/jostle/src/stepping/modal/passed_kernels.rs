//! The loops over axial forces that pass through rigid beams, in several steps.

use pulp::{Simd, WithSimd};

use super::member_kernels::{
    AT_REST, Limits, Near, Rows, add_sums, add_sums_at, beyond, covers, range_of, uses,
};
use super::member_reach::{BatchReach, low_modes};
use super::member_steps::{INSTANTS, Steps};
use super::members::{Passed, PassedBounds, tests_look_always};
use super::mode_kernels::ROWS;
use super::peaks::BEYOND;

/// The most that drives a building within some steps beside its modal displacements.
pub(super) struct Drive {
    /// Greatest size of the ground acceleration \[m/s²\].
    pub(super) ground: f64,
    /// Most that the ground acceleration changes within a step \[m/s²\].
    pub(super) ground_change: f64,
    /// Greatest size of every contact force \[N\].
    pub(super) contacts: Vec<f64>,
    /// Whether there is any.
    pub(super) is_pushed: bool,
}

impl Drive {
    pub(super) fn new(contacts: usize) -> Self {
        Self {
            ground: 0.0,
            ground_change: 0.0,
            contacts: vec![0.0; contacts],
            is_pushed: false,
        }
    }

    /// That of these steps.
    pub(super) fn set(&mut self, steps: &Steps<'_>) {
        self.ground = steps.ground(0).abs();
        (self.ground_change, self.is_pushed) = (0.0, false);
        self.contacts.fill(0.0);
        for end in 1..=steps.count() {
            let (before, now) = (steps.ground(end - 1), steps.ground(end));
            self.ground = self.ground.max(now.abs());
            self.ground_change = self.ground_change.max((now - before).abs());
            for (most, force) in self.contacts.iter_mut().zip(steps.pushes(end)) {
                *most = most.max(force.abs());
                self.is_pushed |= *force != 0.0;
            }
        }
    }
}

impl PassedBounds {
    /// Adds what drives rows beside modal displacements.
    #[inline(always)]
    fn add_drive(&self, reach: &BatchReach, drive: &Drive, used: &mut Rows) {
        let by_rates = uses(&self.norms_of_rates, &reach.rates);
        for (row, used) in used.iter_mut().enumerate() {
            *used += by_rates[row] + self.ground[row] * drive.ground;
        }
        if !drive.is_pushed {
            return;
        }
        for (pushed, force) in self.pushed.iter().zip(&drive.contacts) {
            for (used, pushed) in used.iter_mut().zip(pushed) {
                *used += pushed * force;
            }
        }
    }

    /// Most that rows go beyond the ends of a step while modes are free: their rates follow from q̇, q̈ and the rate of the
    /// ground acceleration, by the equations of modes.
    #[inline(always)]
    fn beyond(&self, reach: &BatchReach, by_ground: &Rows, drive: &Drive) -> Rows {
        let mut most = uses(&self.norms, &reach.beyond);
        let by_rates = uses(&self.norms_of_rates, &reach.beyond_rates);
        for (row, most) in most.iter_mut().enumerate() {
            let by_ground = 2.0 * BEYOND * by_ground[row].abs() * drive.ground_change;
            *most += by_rates[row] + by_ground;
        }
        most
    }
}

/// Adds rows.
#[inline(always)]
fn add(to: &mut Rows, more: &Rows) {
    for (to, more) in to.iter_mut().zip(more) {
        *to += more;
    }
}

/// Sums of one list in three parts, which do not wait for each other.
#[inline(always)]
fn sums_by_thirds<S: Simd>(simd: S, block: &[Rows], modal: &[f64]) -> Rows {
    let third = block.len() / 3;
    let [mut a, mut b, mut c] = [[0.0; ROWS]; 3];
    for (part, to) in [&mut a, &mut b, &mut c].into_iter().enumerate() {
        let range = part * third..(part + 1) * third;
        add_sums(simd, &block[range.clone()], &modal[range], to);
    }
    let mut all = [0.0; ROWS];
    for (row, all) in all.iter_mut().enumerate() {
        *all = (a[row] + b[row]) + c[row];
    }
    all
}

/// A batch of steps of axial forces that pass through rigid beams of one building.
pub(super) struct FollowPassed<'a> {
    pub(super) passed: &'a Passed,
    pub(super) reach: &'a BatchReach,
    pub(super) drive: &'a Drive,
    pub(super) greatest: &'a mut [Rows],
    pub(super) least: &'a mut [Rows],
    pub(super) steps: Steps<'a>,
    /// Whether nothing drives modes but the ground and contacts.
    pub(super) is_bounded: bool,
}

impl WithSimd for FollowPassed<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            passed,
            reach,
            drive,
            steps,
            ..
        } = self;
        let (low, last) = (low_modes(steps.modes), steps.count());
        let every = [true; INSTANTS];
        let bounded = self.is_bounded && !tests_look_always();
        for (block, bounds) in passed.bounds.iter().enumerate() {
            let limits = Limits {
                greatest: &mut self.greatest[block],
                least: &mut self.least[block],
                loose: [0.0; ROWS],
            };
            let mut near = Near::all(last);
            if bounded {
                let mut driven = AT_REST;
                bounds.add_drive(reach, drive, &mut driven);
                let mut used = uses(&bounds.norms, &reach.size);
                add(&mut used, &driven);
                if covers(&limits.slack([&AT_REST; 2]), &used) {
                    continue;
                }
                let mut values = [[0.0; ROWS]; INSTANTS];
                let values = &mut values[..=last];
                let list = |instant| &steps.list(instant, 0)[..low];
                add_sums_at(simd, &bounds.low, list, &every[..=last], values);
                let mut used = uses(&bounds.norms, &reach.of_low());
                add(&mut used, &driven);
                let [high, least] = range_of(values);
                if covers(&limits.slack([&high, &least]), &used) {
                    continue;
                }
                near = Near::find(&limits, values, &used);
            }
            let mut exact = ExactPassed {
                passed,
                block,
                steps: &steps,
                limits,
            };
            if steps.smooth {
                exact.take_cubics(simd, &near, bounded.then_some((reach, drive)));
            } else {
                exact.take_ends(simd, &near);
            }
        }
    }
}

/// A block of such forces in some steps.
struct ExactPassed<'a> {
    passed: &'a Passed,
    block: usize,
    steps: &'a Steps<'a>,
    limits: Limits<'a>,
}

impl ExactPassed<'_> {
    /// Shares of modal displacements, velocities and accelerations.
    #[inline(always)]
    fn shares(&self) -> &[Rows] {
        let values = 3 * self.steps.modes;
        &self.passed.shares[self.block * values..(self.block + 1) * values]
    }

    /// Forces per ground acceleration, or per rate of it.
    #[inline(always)]
    fn by_ground(&self, part: usize) -> Rows {
        let mut by_ground = [0.0; ROWS];
        let rows = self.passed.ground.iter().skip(self.block * ROWS);
        for (to, ground) in by_ground.iter_mut().zip(rows) {
            *to = ground[part];
        }
        by_ground
    }

    /// Subtracts the forces of contacts at an instant.
    #[inline(always)]
    fn push(&self, instant: usize, value: &mut Rows) {
        let pushes = self.steps.pushes(instant);
        if pushes.iter().all(|force| *force == 0.0) {
            return;
        }
        let rows = self.passed.contacts.iter().skip(self.block * ROWS);
        for (value, contacts) in value.iter_mut().zip(rows) {
            *value -= contacts.iter().map(|c| pushes[*c]).sum::<f64>();
        }
    }

    /// Takes in the ends of steps alone.
    #[inline(always)]
    fn take_ends<S: Simd>(&mut self, simd: S, near: &Near) {
        let by_ground = self.by_ground(0);
        for step in 0..self.steps.count() {
            if !near.steps[step] {
                continue;
            }
            let end = step + 1;
            let mut value = sums_by_thirds(simd, self.shares(), self.steps.from(end, 0));
            for row in 0..ROWS {
                value[row] += by_ground[row] * self.steps.ground(end);
            }
            self.push(end, &mut value);
            self.limits.take(&value);
        }
    }

    /// Takes in steps in which accelerations follow a cubic; `bounds`: what drives them, where it is known.
    #[inline(always)]
    fn take_cubics<S: Simd>(
        &mut self,
        simd: S,
        near: &Near,
        bounds: Option<(&BatchReach, &Drive)>,
    ) {
        let (steps, last) = (self.steps, self.steps.count());
        let by_ground = [0, 1].map(|part| self.by_ground(part));
        let mut free = [[0.0; ROWS]; INSTANTS];
        let free = &mut free[..=last];
        let list = |instant| steps.from(instant, 0);
        add_sums_at(simd, self.shares(), list, &near.ends[..=last], free);
        // Forces of contacts belong to the step that ends with them.
        let mut pushed = [[0.0; ROWS]; INSTANTS];
        for (instant, value) in free.iter_mut().enumerate() {
            for row in 0..ROWS {
                value[row] += by_ground[0][row] * steps.ground(instant);
            }
            pushed[instant] = *value;
            self.push(instant, &mut pushed[instant]);
        }
        for step in 0..last {
            if near.steps[step] {
                self.limits.take(&free[step]);
                self.limits.take(&pushed[step + 1]);
            }
        }
        let most = bounds.map(|(reach, drive)| {
            self.passed.bounds[self.block].beyond(reach, &by_ground[1], drive)
        });
        let slack = |limits: &Limits<'_>, step: usize| {
            let [high, least] = range_of(&[free[step], pushed[step + 1]]);
            limits.slack([&high, &least])
        };
        let (mut wanted, mut within) = ([false; INSTANTS], [false; INSTANTS]);
        for step in 0..last {
            let far = most.is_some_and(|most| covers(&slack(&self.limits, step), &most));
            if near.steps[step] && !far {
                within[step] = true;
                wanted[step] = true;
                wanted[step + 1] = true;
            }
        }
        let mut rates = [[0.0; ROWS]; INSTANTS];
        let list = |instant| &steps.from(instant, 1)[..3 * steps.modes];
        add_sums_at(
            simd,
            self.shares(),
            list,
            &wanted[..=last],
            &mut rates[..=last],
        );
        for (step, length) in steps.lengths.iter().enumerate() {
            if !within[step] {
                continue;
            }
            let slope = (steps.ground(step + 1) - steps.ground(step)) / length;
            let slopes = [step, step + 1].map(|end| {
                let mut rate = rates[end];
                for row in 0..ROWS {
                    rate[row] += by_ground[1][row] * slope;
                }
                rate
            });
            let slopes = slopes.each_ref();
            let far = covers(&slack(&self.limits, step), &beyond(slopes, *length));
            if bounds.is_none() || !far {
                let values = [&free[step], &pushed[step + 1]];
                self.limits.widen(values, slopes, *length);
            }
        }
    }
}
