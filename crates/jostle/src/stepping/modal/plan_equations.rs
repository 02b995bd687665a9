//! Forces of closed contacts of buildings in space at the end of a step. All points of a face open by sums of what the
//! ends of the face open, so Newton's method has the sums of forces at these ends for unknowns, however many points are closed.

use pulp::NullaryFnOnce;

use super::plan_rows::{PlanRows, SideLoads};
use super::reduced::Reduced;
use super::step_table::StepTable;
use crate::contact::ContactResponse;
use crate::linear::Row;
use crate::linear::envelope::{Envelope, PivotedEnvelope};
use crate::simd;
use crate::stepping::coupling::Closed;
use crate::stepping::force_equations::{QUICK_ROUNDS, ROUNDING, SETTLED};

/// Unknowns on which that of an end of a face may depend: both ends, pressed and rubbed.
const PARTNERS: usize = 4;
/// No row.
const NONE: usize = usize::MAX;

/// Influence of unknowns of one face on each other: slopes of sums of forces by closings and by their rates.
#[derive(Clone, Copy, Debug)]
struct FaceSlopes {
    rows: [usize; PARTNERS],
    slopes: [[f64; 2]; PARTNERS],
}

/// Newton's method on sums of forces at ends of faces.
#[derive(Debug, Default)]
pub(super) struct PlanEquations {
    /// Ends of faces with closed points, by their ports, in the order of the graph.
    ends: Vec<usize>,
    /// Row of every port among them.
    row_of: Vec<usize>,
    /// Places of all ports in the order of the graph, and of the ends.
    place_of: Vec<usize>,
    places: Vec<usize>,
    /// Of every closed contact, then friction, in the order in which they are listed: its closing over those of the ends of its face.
    pub(super) points: Vec<Row>,
    /// Closings and their rates at the ends without forces, and with them \[m, m/s\].
    free: [Vec<f64>; 2],
    pressed: [Vec<f64>; 2],
    before: [Vec<f64>; 2],
    /// Sums of forces \[N\].
    forces: Vec<f64>,
    /// Openings and their rates at the ends due to unit forces there; of which step and of which ends.
    openings: [Envelope; 2],
    known_for: (f64, Vec<usize>),
    /// Displacements and velocities of modes due to a unit force at every end, side by side.
    answers: [Vec<f64>; 2],
    responses: Vec<ContactResponse>,
    slopes: Vec<FaceSlopes>,
    matrix: PivotedEnvelope,
    change: Vec<f64>,
    /// Modal loads.
    loads: Vec<f64>,
    /// Sums of anything at the ends: bends, areas, moments.
    pub(super) sums: [Vec<f64>; 2],
    /// Accelerations at ends of faces with closed points now, and rates of forces there that have not been applied yet; port by
    /// port, with the ports to which they apply \[m/s², N/s\].
    accelerations: Vec<f64>,
    rates: Vec<f64>,
    pushed: Vec<usize>,
    /// Multiply-adds spent so far.
    pub(super) operations: u64,
}

impl PlanEquations {
    pub(super) fn new(reduced: &Reduced) -> Self {
        let ports = reduced.plan.as_ref().map_or(0, |plan| plan.shares.len());
        let mut place_of = vec![0; ports];
        if ports > 0 {
            for (place, &port) in reduced.graph.order.iter().enumerate() {
                place_of[port] = place;
            }
        }
        Self {
            row_of: vec![NONE; ports],
            place_of,
            accelerations: vec![0.0; ports],
            rates: vec![0.0; ports],
            known_for: (0.0, Vec::new()),
            ..Self::default()
        }
    }

    /// Lists the ends of all faces with closed points.
    pub(super) fn list_points(&mut self, plan: &PlanRows, closed: &[Closed]) {
        for end in self.ends.drain(..) {
            self.row_of[end] = NONE;
        }
        for closed_contact in closed {
            for end in plan.shares[closed_contact.contact].dofs() {
                if self.row_of[end] == NONE {
                    self.row_of[end] = 0;
                    self.ends.push(end);
                }
            }
        }
        let place_of = &self.place_of;
        self.ends.sort_unstable_by_key(|end| place_of[*end]);
        for (row, &end) in self.ends.iter().enumerate() {
            self.row_of[end] = row;
        }
        self.points.clear();
        self.points.extend(closed.iter().map(|closed_contact| {
            let ends = plan.shares[closed_contact.contact].entries().iter();
            ends.map(|(end, share)| (self.row_of[*end], *share))
                .collect()
        }));
        for list in &mut self.sums {
            list.clear();
            list.resize(self.ends.len(), 0.0);
        }
    }

    /// Adds a bend of the force of a closed contact to those of the ends.
    pub(super) fn add_bend(&mut self, point: usize, bend: f64) {
        self.points[point].push(bend, &mut self.sums[0]);
    }

    /// Adds the bends to modal loads.
    pub(super) fn push_bends(&self, reduced: &Reduced, plan: &PlanRows, to: &mut [f64]) {
        reduced.arch().dispatch(PushEnds {
            sides: &plan.sides,
            ends: &self.ends,
            forces: &self.sums[0],
            to,
        });
    }

    /// Values at the ends from two lists of modal values, into `sums`.
    pub(super) fn show_ends(&mut self, reduced: &Reduced, plan: &PlanRows, modal: [&[f64]; 2]) {
        reduced.arch().dispatch(ShowEnds {
            sides: &plan.sides,
            ends: &self.ends,
            modal,
            values: self.sums.each_mut(),
        });
    }

    /// Closings and their rates at the ends without forces, from modal displacements and velocities; `moved` adds what the
    /// grounds do at a port.
    pub(super) fn set_free(
        &mut self,
        reduced: &Reduced,
        plan: &PlanRows,
        modal: [&[f64]; 2],
        moved: impl Fn(usize) -> [f64; 2],
    ) {
        for list in &mut self.free {
            list.clear();
            list.resize(self.ends.len(), 0.0);
        }
        reduced.arch().dispatch(ShowEnds {
            sides: &plan.sides,
            ends: &self.ends,
            modal,
            values: self.free.each_mut(),
        });
        for (row, &end) in self.ends.iter().enumerate() {
            let moved = moved(end);
            for (list, moved) in self.free.iter_mut().zip(moved) {
                list[row] += moved;
            }
        }
    }

    /// Closing of a closed point without forces, and its rate.
    pub(super) fn free_of(&self, point: usize) -> [f64; 2] {
        self.free
            .each_ref()
            .map(|list| self.points[point].value(list))
    }

    /// Finds how far and how fast forces at the ends open them at the end of a step of a table.
    pub(super) fn couple(&mut self, reduced: &Reduced, plan: &PlanRows, table: &StepTable) {
        if self.known_for.0 == table.step && self.known_for.1 == self.ends {
            return;
        }
        self.known_for.0 = table.step;
        self.known_for.1.clone_from(&self.ends);
        self.places.clear();
        self.places
            .extend(self.ends.iter().map(|end| self.place_of[*end]));
        let [openings, rates] = &mut self.openings;
        openings.reset(reduced.graph.first_coupled(&self.places));
        rates.reset_like(openings);
        let ends = self.ends.iter();
        let length: usize = ends
            .flat_map(|end| &plan.sides[*end])
            .map(|side| side.loads.len())
            .sum();
        for list in &mut self.answers {
            list.resize(length, 0.0);
        }
        reduced.arch().dispatch(CoupleEnds {
            sides: &plan.sides,
            joined: &plan.joined,
            ends: &self.ends,
            factors: [&table.displacement, &table.velocity].map(|factors| {
                let [.., line, bend] = factors;
                [&line[..], bend]
            }),
            answers: self.answers.each_mut().map(|list| &mut list[..]),
            openings: self.openings.each_mut(),
        });
    }

    /// Solves for the forces, starting from `predicted` ones, and stores them in the list of closed contacts; returns the number
    /// of iterations, or `None` without convergence.
    pub(super) fn solve(
        &mut self,
        closed: &mut [Closed],
        widths: &[f64],
        predicted: impl Fn(usize) -> f64,
    ) -> Option<u64> {
        let n = self.ends.len();
        self.forces.clear();
        self.forces.resize(n, 0.0);
        for (point, closed_contact) in self.points.iter().zip(&*closed) {
            point.push(predicted(closed_contact.contact), &mut self.forces);
        }
        self.list_partners(closed);
        let mut last = f64::INFINITY;
        for round in 1..=QUICK_ROUNDS {
            self.press_ends();
            self.evaluate(closed, widths);
            self.assemble();
            self.operations += self.matrix.eliminate(&mut self.change)?;
            let (mut change, mut greatest) = (0.0_f64, 0.0_f64);
            for (force, step) in self.forces.iter_mut().zip(&self.change) {
                *force += step;
                change = change.max(step.abs());
                greatest = greatest.max(force.abs());
            }
            if !self.forces.iter().all(|force| force.is_finite()) {
                return None;
            }
            let rounding = change <= ROUNDING * greatest && change >= last;
            if change <= SETTLED * greatest || rounding {
                self.finish(closed);
                return Some(round);
            }
            last = change;
        }
        None
    }

    /// Closings and rates at the ends under the forces.
    fn press_ends(&mut self) {
        for ((pressed, free), openings) in
            self.pressed.iter_mut().zip(&self.free).zip(&self.openings)
        {
            pressed.clear();
            pressed.extend(free.iter().enumerate().map(|(row, free)| {
                let columns = openings.columns(row);
                free - plain_dot(openings.row(row), &self.forces[columns])
            }));
        }
    }

    /// Rows that depend on each other within a face: the row itself, the other end, and for friction both ends that are
    /// pressed.
    fn list_partners(&mut self, closed: &[Closed]) {
        self.slopes.clear();
        self.slopes
            .extend((0..self.ends.len()).map(|row| FaceSlopes {
                rows: [row, NONE, NONE, NONE],
                slopes: [[0.0; 2]; PARTNERS],
            }));
        for (point, closed_contact) in self.points.iter().zip(closed) {
            if let [(first, _), (last, _)] = *point.entries() {
                self.slopes[first].rows[1] = last;
                self.slopes[last].rows[1] = first;
            }
            if let Some(friction) = closed_contact.friction {
                for end in self.points[friction.normal].dofs() {
                    for row in point.dofs() {
                        let pressing = &mut self.slopes[row].rows[2..];
                        if !pressing.contains(&end)
                            && let Some(free) =
                                pressing.iter_mut().find(|pressing| **pressing == NONE)
                        {
                            *free = end;
                        }
                    }
                }
            }
        }
    }

    /// Forces of all points for the motion of the ends; sums of them minus the unknowns, and the slopes of these sums.
    fn evaluate(&mut self, closed: &[Closed], widths: &[f64]) {
        self.change.clear();
        self.change.extend(self.forces.iter().map(|force| -force));
        for slope in &mut self.slopes {
            slope.slopes = [[0.0; 2]; PARTNERS];
        }
        self.responses.clear();
        let [closings, rates] = &self.pressed;
        for (point, closed_contact) in self.points.iter().zip(closed) {
            let (closing, rate) = (point.value(closings), point.value(rates));
            let response = match &closed_contact.friction {
                Some(friction) => friction.respond(closing, self.responses[friction.normal].force),
                None => {
                    let width = widths[closed_contact.contact];
                    closed_contact
                        .law
                        .follow(closing - width, rate, &closed_contact.memory)
                }
            };
            self.responses.push(response);
            point.push(response.force, &mut self.change);
            let slopes = [response.by_indentation, response.by_rate];
            add_own_slopes(&mut self.slopes, point, slopes);
            if let Some(friction) = &closed_contact.friction
                && response.by_indentation == 0.0
                && self.responses[friction.normal].force > 0.0
            {
                // Friction that slips follows the contact force.
                let share = friction.law.coefficient.copysign(response.force);
                let pressing = &self.responses[friction.normal];
                let slopes = [pressing.by_indentation, pressing.by_rate];
                let normal = &self.points[friction.normal];
                add_slopes_by_pressing(
                    &mut self.slopes,
                    point,
                    normal,
                    slopes.map(|slope| share * slope),
                );
            }
        }
    }

    /// The matrix of Newton's method: I + slopes by closings W + slopes by rates V.
    fn assemble(&mut self) {
        let [openings, rates] = &self.openings;
        self.matrix.reset_like(openings);
        for (row, slope) in self.slopes.iter().enumerate() {
            let columns = openings.columns(row);
            let entries = self.matrix.row_mut(row, columns.clone());
            entries[row - columns.start] = 1.0;
            for (partner, [by_closing, by_rate]) in slope.rows.into_iter().zip(slope.slopes) {
                if partner == NONE || (by_closing == 0.0 && by_rate == 0.0) {
                    continue;
                }
                let theirs = openings.columns(partner);
                let (from, to) = (theirs.start.max(columns.start), theirs.end.min(columns.end));
                let cut = from - theirs.start..to - theirs.start;
                let [w, v] = [openings, rates].map(|matrix| &matrix.row(partner)[cut.clone()]);
                let entries = &mut entries[from - columns.start..to - columns.start];
                for (entry, (w, v)) in entries.iter_mut().zip(w.iter().zip(v)) {
                    *entry += by_closing * w + by_rate * v;
                }
            }
        }
    }

    /// Forces of all points after the last change of the unknowns, which is small.
    fn finish(&mut self, closed: &mut [Closed]) {
        std::mem::swap(&mut self.pressed, &mut self.before);
        self.press_ends();
        for (place, closed_contact) in closed.iter_mut().enumerate() {
            let point = &self.points[place];
            let [moved, rate] = [0, 1].map(|list: usize| {
                point.value(&self.pressed[list]) - point.value(&self.before[list])
            });
            let response = &self.responses[place];
            closed_contact.force =
                response.force + response.by_indentation * moved + response.by_rate * rate;
            closed_contact.indentation = point.value(&self.pressed[0]);
        }
        for place in 0..closed.len() {
            let Some(friction) = closed[place].friction else {
                continue;
            };
            // At the limit it follows the contact force.
            let (response, pressing) = (&self.responses[place], closed[friction.normal].force);
            if response.by_indentation == 0.0 && pressing > 0.0 {
                closed[place].force =
                    (friction.law.coefficient * pressing).copysign(response.force);
            }
        }
    }

    /// Openings of all closed points due to forces at others, for other ways to solve.
    pub(super) fn spread(&self, reduced: &Reduced, places: &[usize], openings: &mut [Envelope; 2]) {
        let [first, second] = openings;
        first.reset(reduced.graph.first_coupled(places));
        second.reset_like(first);
        for (opening, list) in self.openings.iter().zip([first, second]) {
            for row in 0..self.points.len() {
                for column in list.columns(row) {
                    let (to, from) = (&self.points[row], &self.points[column]);
                    let mut sum = 0.0;
                    for &(end, share) in to.entries() {
                        for &(start, part) in from.entries() {
                            if opening.columns(end).contains(&start) {
                                sum += share * part * opening.get(end, start);
                            }
                        }
                    }
                    list.set(row, column, sum);
                }
            }
        }
    }

    /// Adds the forces of all closed contacts to what modes do over the step of a table: displacements, velocities, end
    /// values and bends of loads.
    pub(super) fn push(
        &mut self,
        reduced: &Reduced,
        plan: &PlanRows,
        closed: &[Closed],
        table: &StepTable,
        to: [&mut [f64]; 4],
    ) {
        self.forces.fill(0.0);
        self.forces.resize(self.ends.len(), 0.0);
        for (point, closed_contact) in self.points.iter().zip(closed) {
            point.push(closed_contact.force, &mut self.forces);
        }
        self.loads.clear();
        self.loads.resize(reduced.modes(), 0.0);
        reduced.arch().dispatch(PushEnds {
            sides: &plan.sides,
            ends: &self.ends,
            forces: &self.forces,
            to: &mut self.loads,
        });
        reduced.arch().dispatch(Answer {
            loads: &self.loads,
            factors: [&table.displacement, &table.velocity].map(|factors| {
                let [.., line, bend] = factors;
                [&line[..], bend]
            }),
            to,
        });
    }

    /// Finds accelerations at ends of faces of these contacts from modal ones.
    pub(super) fn accelerate(
        &mut self,
        plan: &PlanRows,
        contacts: impl Iterator<Item = usize>,
        modal: &[f64],
    ) {
        let mut done = None;
        for contact in contacts {
            let ends = || plan.shares[contact].dofs();
            if done.is_some_and(|done: usize| plan.shares[done].dofs().eq(ends())) {
                continue;
            }
            done = Some(contact);
            for end in ends() {
                let sides = plan.sides[end].iter();
                let sum: f64 = sides
                    .map(|side| {
                        let modal = &modal[side.modes.clone()];
                        simd::dot(&side.loads[..modal.len()], modal)
                    })
                    .sum();
                self.accelerations[end] = -sum;
            }
        }
    }

    /// Relative acceleration at a contact, once found at the ends of its face.
    pub(super) fn acceleration(&self, plan: &PlanRows, contact: usize) -> f64 {
        plan.shares[contact].value(&self.accelerations)
    }

    /// Adds the rate of a force at a port to those that are to be applied.
    pub(super) fn add_rate(&mut self, plan: &PlanRows, port: usize, rate: f64) {
        for &(end, share) in plan.shares[port].entries() {
            if self.rates[end] == 0.0 {
                self.pushed.push(end);
            }
            self.rates[end] += share * rate;
        }
    }

    /// Applies them to modal loads.
    pub(super) fn push_rates(&mut self, plan: &PlanRows, to: &mut [f64]) {
        for end in self.pushed.drain(..) {
            let rate = std::mem::take(&mut self.rates[end]);
            for side in &plan.sides[end] {
                simd::add(&mut to[side.modes.clone()], rate, &side.loads);
            }
        }
    }
}

/// What motion at the ends of a point adds to sums of forces there.
#[inline]
fn add_own_slopes(all: &mut [FaceSlopes], point: &Row, slopes: [f64; 2]) {
    let mut add = |row: usize, place: usize, share: f64| {
        let sums = &mut all[row].slopes[place];
        sums[0] += share * slopes[0];
        sums[1] += share * slopes[1];
    };
    for (index, &(row, share)) in point.entries().iter().enumerate() {
        for (other, (_, part)) in point.entries().iter().enumerate() {
            add(row, usize::from(index != other), share * part);
        }
    }
}

/// What motion at the ends of a contact adds to sums of friction at those of the same point.
fn add_slopes_by_pressing(all: &mut [FaceSlopes], point: &Row, by: &Row, slopes: [f64; 2]) {
    for &(row, share) in point.entries() {
        for &(other, part) in by.entries() {
            let place = if all[row].rows[2] == other { 2 } else { 3 };
            let sums = &mut all[row].slopes[place];
            sums[0] += share * part * slopes[0];
            sums[1] += share * part * slopes[1];
        }
    }
}

fn plain_dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Adds forces at ends of faces to modal loads.
struct PushEnds<'a> {
    sides: &'a [Vec<SideLoads>],
    ends: &'a [usize],
    forces: &'a [f64],
    to: &'a mut [f64],
}

impl NullaryFnOnce for PushEnds<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (end, force) in self.ends.iter().zip(self.forces) {
            for side in &self.sides[*end] {
                simd::add(&mut self.to[side.modes.clone()], *force, &side.loads);
            }
        }
    }
}

/// Closings at ends of faces from two lists of modal values.
struct ShowEnds<'a> {
    sides: &'a [Vec<SideLoads>],
    ends: &'a [usize],
    modal: [&'a [f64]; 2],
    values: [&'a mut Vec<f64>; 2],
}

impl NullaryFnOnce for ShowEnds<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (modal, values) in self.modal.into_iter().zip(self.values) {
            for (end, value) in self.ends.iter().zip(values) {
                let mut sum = 0.0;
                for side in &self.sides[*end] {
                    let modal = &modal[side.modes.clone()];
                    sum += simd::dot(&side.loads[..modal.len()], modal);
                }
                *value = -sum;
            }
        }
    }
}

/// What unit forces at ends of faces do there.
struct CoupleEnds<'a> {
    sides: &'a [Vec<SideLoads>],
    joined: &'a [Vec<f64>],
    ends: &'a [usize],
    /// Of linear loads and of bends, in displacements and in velocities.
    factors: [[&'a [f64]; 2]; 2],
    answers: [&'a mut [f64]; 2],
    openings: [&'a mut Envelope; 2],
}

impl NullaryFnOnce for CoupleEnds<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            sides,
            joined,
            ends,
            factors,
            answers,
            openings,
        } = self;
        for (([line, bend], answers), openings) in factors.into_iter().zip(answers).zip(openings) {
            let mut from = 0;
            for (row, end) in ends.iter().enumerate() {
                let first = from;
                for side in &sides[*end] {
                    let n = side.modes.len();
                    let (entries, padding) = answers[from..from + side.loads.len()].split_at_mut(n);
                    let (line, bend) = (&line[side.modes.clone()], &bend[side.modes.clone()]);
                    let (line, bend, loads) = (&line[..n], &bend[..n], &side.loads[..n]);
                    for mode in 0..n {
                        entries[mode] = (line[mode] + bend[mode]) * loads[mode];
                    }
                    padding.fill(0.0);
                    from += side.loads.len();
                }
                for column in openings.columns(row).start..=row {
                    let (one, other) = (&sides[*end], &sides[ends[column]]);
                    let mut buildings = one.iter().zip(other);
                    let alike = one.len() == other.len()
                        && buildings.all(|(candidate, other)| candidate.building == other.building);
                    let sum = if alike {
                        simd::dot(&answers[first..from], &joined[ends[column]])
                    } else {
                        let (mut sum, mut at) = (0.0, first);
                        for side_loads in one {
                            let answer = &answers[at..at + side_loads.loads.len()];
                            at += side_loads.loads.len();
                            for other in other
                                .iter()
                                .filter(|side| side.building == side_loads.building)
                            {
                                sum += simd::dot(answer, &other.loads);
                            }
                        }
                        sum
                    };
                    openings.set(row, column, sum);
                    openings.set(column, row, sum);
                }
            }
        }
    }
}

/// What loads that grow with the square of time to given end values do to modes.
struct Answer<'a> {
    loads: &'a [f64],
    factors: [[&'a [f64]; 2]; 2],
    to: [&'a mut [f64]; 4],
}

impl NullaryFnOnce for Answer<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let n = self.loads.len();
        let loads = &self.loads[..n];
        let [q, v, p, bends] = self.to.map(|list| &mut list[..n]);
        let [[line, bend], [line_rate, bend_rate]] =
            self.factors.map(|pair| pair.map(|list| &list[..n]));
        for mode in 0..n {
            let load = loads[mode];
            q[mode] += (line[mode] + bend[mode]) * load;
            v[mode] += (line_rate[mode] + bend_rate[mode]) * load;
            p[mode] += load;
            bends[mode] += load;
        }
    }
}
