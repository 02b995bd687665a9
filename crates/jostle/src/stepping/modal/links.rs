//! Springs and dashpots that couple modes: links between buildings, and what damps a base unlike the rest of its building
//! (theory, Eqs. Q9 and Q10).
//!
//! Over a step such a force is a parabola with the mean and the ends of the cubic through its values and slopes at both
//! ends. Values and slopes at the end follow from one linear system per step size. A dashpot on a mass is then advanced by
//! the diagonal Padé approximation of fourth order, which is stable for every step.

use std::collections::BTreeMap;
use std::ops::Range;

use super::reduced::{Reduced, Shown};
use super::step_table::StepTable;
use super::stepper::ModalStepper;
use super::unit_force::UnitForce;
use crate::history::Extreme;
use crate::interface::LinkElement;
use crate::linear::SparseSymmetric;
use crate::linear::full_matrix::PivotedLu;
use crate::simd;
use crate::stepping::extremes::greatest_in_step;
use crate::stepping::totals::LinkTotals;
use crate::system::{BuildingSystem, OverStep, RunGrounds, System};

/// A spring and dashpot between two monitored points, or a point and the ground.
pub(super) struct ModalLink {
    /// Index among the links of the system; `None` for damping of a building.
    pub(super) link: Option<usize>,
    ports: [Option<Shown>; 2],
    pub(super) push: UnitForce,
    /// Where lists of monitored values hold what the grounds add, if they do.
    grounds: Option<usize>,
    /// \[N/m\].
    stiffness: f64,
    /// \[N·s/m\].
    damping: f64,
}

impl ModalLink {
    pub(super) fn new(
        reduced: &Reduced,
        link: Option<usize>,
        ports: [Option<Shown>; 2],
        [stiffness, damping]: [f64; 2],
    ) -> Self {
        Self {
            link,
            ports,
            push: UnitForce::between(reduced, ports, 0..0),
            grounds: link.map(|link| reduced.listed() + reduced.unsplit_ports() + link),
            stiffness,
            damping,
        }
    }

    /// Buildings it joins.
    pub(super) fn buildings(&self) -> impl Iterator<Item = usize> {
        self.ports.into_iter().flatten().map(|port| port.building)
    }

    /// Left minus right of monitored values.
    pub(super) fn closing(&self, values: &[f64]) -> f64 {
        let at = |port: Option<Shown>| port.map_or(0.0, |shown| values[shown.watched]);
        let apart = at(self.ports[0]) - at(self.ports[1]);
        match self.grounds.and_then(|place| values.get(place)) {
            Some(grounds) => apart + grounds,
            None => apart,
        }
    }

    /// The same of modal values, which begin with those of the mode `first`.
    fn closing_of(&self, values: &[f64], first: usize) -> f64 {
        let modes = overlap(&self.push.modes, &(first..first + values.len()));
        -simd::dot(
            &self.push.loads[within(&modes, self.push.modes.start)],
            &values[within(&modes, first)],
        )
    }

    /// What the grounds add to its closing, the rate and the acceleration of that, as [`RunGrounds::closing`].
    fn moved_by_grounds(
        &self,
        grounds: &RunGrounds<'_>,
        reduced: &Reduced,
        time: usize,
    ) -> [f64; 3] {
        self.link.map_or([0.0; 3], |link| {
            grounds.closing(reduced.unsplit_ports() + link, time)
        })
    }

    /// Force for a shortening and its rate, or its rate for a rate and an acceleration \[N\].
    fn force(&self, shortening: f64, rate: f64) -> f64 {
        self.stiffness * shortening + self.damping * rate
    }
}

fn overlap(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let (start, end) = (a.start.max(b.start), a.end.min(b.end));
    if start < end { start..end } else { 0..0 }
}

/// A range of all modes in a list that begins with the mode `first`.
fn within(modes: &Range<usize>, first: usize) -> Range<usize> {
    modes.start.saturating_sub(first)..modes.end.saturating_sub(first)
}

/// Degrees of freedom of a building between which damping acts that is not that of its modes: C′ − β K′, as dashpots between
/// two of them, or one and the ground. Some are negative.
pub(super) fn own_dashpots(building: &BuildingSystem) -> Vec<([Option<usize>; 2], f64)> {
    let equations = &building.equations;
    if equations.plain {
        return Vec::new();
    }
    let mut entries: BTreeMap<[usize; 2], f64> = BTreeMap::new();
    let mut add = |matrix: &SparseSymmetric, factor: f64| {
        for (row, value) in matrix.diagonal.iter().enumerate() {
            *entries.entry([row, row]).or_default() += factor * value;
        }
        for (column, bounds) in matrix.starts.windows(2).enumerate() {
            for place in bounds[0]..bounds[1] {
                let row = matrix.rows[place] as usize;
                *entries.entry([column, row]).or_default() += factor * matrix.values[place];
            }
        }
    };
    add(&equations.dashpots, 1.0);
    add(&equations.undamped, -equations.beta);
    let greatest = entries.values().fold(0.0_f64, |most, c| most.max(c.abs()));
    let mut to_ground: BTreeMap<usize, f64> = BTreeMap::new();
    let mut dashpots = Vec::new();
    for (&[one, other], &value) in &entries {
        *to_ground.entry(one).or_default() += value;
        if one != other {
            *to_ground.entry(other).or_default() += value;
            dashpots.push(([Some(one), Some(other)], -value));
        }
    }
    dashpots.extend(to_ground.into_iter().map(|(dof, c)| ([Some(dof), None], c)));
    dashpots.retain(|(_, c)| c.abs() > NEGLIGIBLE * greatest);
    dashpots
}

/// Dashpots that are rounding errors of others.
const NEGLIGIBLE: f64 = 1e-12;
/// Most dashpots of a building that couple its modes: all modes are then as good as coupled.
const MOST_DASHPOTS: usize = 24;

/// Why a building with base springs or P-Delta cannot be stepped by modes.
pub(super) fn refusal(building: &BuildingSystem) -> Option<String> {
    let dashpots = own_dashpots(building);
    let name = &building.name;
    let mass = &building.equations.mass;
    let massless = |dof: &Option<usize>| dof.is_some_and(|dof| mass[dof] <= 0.0);
    if dashpots.len() > MOST_DASHPOTS {
        return Some(format!(
            "stiffness-proportional damping does not act on P-Delta and on the springs under \"{name}\", which couples its modes by more than {MOST_DASHPOTS} dashpots: use damping proportional to the masses, as modes = [1]"
        ));
    }
    dashpots.iter().any(|(dofs, _)| dofs.iter().any(massless)).then(|| {
        format!("\"{name}\" has damping at points without mass, such as a base without mass, which modes do not include: give the base a mass")
    })
}

/// Longest steps that resolve the links of a system, at a tolerance of 1e-3 \[s\].
pub(in crate::stepping) fn longest_step(system: &System) -> f64 {
    let of_link = |link: &LinkElement| {
        let mass = link.ports.effective_mass();
        let turning = (link.stiffness / mass).sqrt();
        (RADIANS_PER_STEP / turning).min(DECAYS_PER_STEP * mass / link.damping)
    };
    let dashpot_steps = system.buildings.iter().flat_map(|building| {
        let mass = &building.equations.mass;
        own_dashpots(building).into_iter().map(move |(dofs, c)| {
            let masses = dofs.map(|dof| dof.map_or(f64::INFINITY, |dof| mass[dof]));
            DECAYS_PER_STEP * masses[0].min(masses[1]) / c.abs()
        })
    });
    let links = system.links.iter().map(of_link);
    let coupled = links.chain(dashpot_steps);
    coupled.fold(f64::INFINITY, |least, step| least.min(step).min(LONGEST))
}

/// Longest step with a link \[s\]; in radians of the motion of its own masses on its spring, and in decays of their motion
/// in its dashpot.
const LONGEST: f64 = 1e-2;
const RADIANS_PER_STEP: f64 = 2.0;
const DECAYS_PER_STEP: f64 = 8.0;

/// What the unknown end forces and bends of all links do over a step of one size.
#[derive(Clone, Debug, Default)]
pub(super) struct LinkTable {
    step: f64,
    /// Of every link: modal displacement and velocity at the end per unit end force, then per unit bend.
    answers: Vec<[[Vec<f64>; 2]; 2]>,
    equations: PivotedLu,
}

impl LinkTable {
    /// `ends`: responses of modal displacement and velocity at the end to the end value of a load and to its bend.
    pub(super) fn set(&mut self, reduced: &Reduced, step: f64, ends: [[&[f64]; 2]; 2]) {
        let links = &reduced.links;
        self.step = step;
        self.answers.resize_with(links.len(), Default::default);
        for (link, answers) in links.iter().zip(&mut self.answers) {
            for (input, answer) in answers.iter_mut().enumerate() {
                for (list, of) in answer.iter_mut().zip(&ends) {
                    let factors = &of[input][link.push.modes.clone()];
                    list.clear();
                    list.extend(factors.iter().zip(&link.push.loads).map(|(f, p)| f * p));
                }
            }
        }
        let answers = &self.answers;
        self.equations.refactor(2 * links.len(), |matrix| {
            for (column, (source, answers)) in links.iter().zip(answers).enumerate() {
                for (input, [q, v]) in answers.iter().enumerate() {
                    let load = (input == 0).then_some(&source.push.loads[..]);
                    for (row, link) in links.iter().enumerate() {
                        let closing = closings(reduced, link, [q, v], load, &source.push.modes);
                        let [force, bend] = link.unknowns(closing, step);
                        matrix[(2 * row, 2 * column + input)] = -force;
                        matrix[(2 * row + 1, 2 * column + input)] = -bend;
                    }
                }
            }
            for row in 0..2 * links.len() {
                matrix[(row, row)] += 1.0;
            }
        });
    }

    /// End forces and bends, two for every link, from what they would be if no link pushed at the end.
    pub(super) fn solve(&self, right: &[f64], unknowns: &mut Vec<f64>) {
        self.equations.solve_into(right, unknowns);
    }

    pub(super) fn step(&self) -> f64 {
        self.step
    }

    /// Adds what a link does over the step to modal displacements and velocities, and to end values and bends of modal loads;
    /// the lists begin with the mode `first`.
    pub(super) fn add(
        &self,
        reduced: &Reduced,
        index: usize,
        [force, bend]: [f64; 2],
        first: usize,
        [q, v, p1, bends]: [&mut [f64]; 4],
    ) {
        let push = &reduced.links[index].push;
        let [by_force, by_bend] = &self.answers[index];
        let within = within(&push.modes, first);
        for (list, (line, bent)) in [
            (q, (&by_force[0], &by_bend[0])),
            (v, (&by_force[1], &by_bend[1])),
        ] {
            let terms = line.iter().zip(bent);
            for (value, (line, bent)) in list[within.clone()].iter_mut().zip(terms) {
                *value += force * line + bend * bent;
            }
        }
        let loads = p1[within.clone()].iter_mut().zip(&mut bends[within]);
        for ((p1, bends), load) in loads.zip(&push.loads) {
            *p1 += force * load;
            *bends += bend * load;
        }
    }
}

impl ModalLink {
    /// Force at the end of a step, and half the step times its slope there, for shortening, rate and acceleration.
    pub(super) fn unknowns(
        &self,
        [shortening, rate, acceleration]: [f64; 3],
        step: f64,
    ) -> [f64; 2] {
        [
            self.force(shortening, rate),
            0.5 * step * self.force(rate, acceleration),
        ]
    }
}

/// Closing of a link, its rate and its acceleration for modal displacements, velocities and loads at some modes.
pub(super) fn closings(
    reduced: &Reduced,
    link: &ModalLink,
    [q, v]: [&[f64]; 2],
    load: Option<&[f64]>,
    modes: &Range<usize>,
) -> [f64; 3] {
    let shared = overlap(&link.push.modes, modes);
    let push_load = &link.push.loads[within(&shared, link.push.modes.start)];
    let at = within(&shared, modes.start);
    let mut sums = [0.0; 3];
    let factors = reduced.damping[shared.clone()]
        .iter()
        .zip(&reduced.stiffness[shared.clone()]);
    let motion = q[at.clone()].iter().zip(&v[at.clone()]);
    for (i, ((shape, (d, k)), (q, v))) in push_load.iter().zip(factors).zip(motion).enumerate() {
        let p = load.map_or(0.0, |load| load[at.start + i]);
        sums[0] -= shape * q;
        sums[1] -= shape * v;
        sums[2] -= shape * (p - d * v - k * q);
    }
    sums
}

/// Links of a run.
#[derive(Debug, Default)]
pub(super) struct LinkMotion {
    /// Bend of every force over the tried step \[N\].
    pub(super) bends: Vec<f64>,
    right: Vec<f64>,
    unknowns: Vec<f64>,
    /// Peaks and work of the links of the system, and their forces now.
    pub(super) totals: Vec<LinkTotals>,
    pub(super) forces: Vec<f64>,
    /// Work done on links of the system, and on what damps buildings \[J\].
    pub(super) work: f64,
    pub(super) damped: f64,
    /// Of every link: what the cubic over the last step adds to a parabola, the greatest change of that from step to step,
    /// and the greatest force \[N\].
    cubic: Vec<[f64; 3]>,
    /// Length of the last step \[s\].
    last: f64,
}

impl LinkMotion {
    pub(super) fn new(system: &System, reduced: &Reduced) -> Self {
        let (all, count) = (reduced.links.len(), system.links.len());
        Self {
            bends: vec![0.0; all],
            right: Vec::with_capacity(2 * all),
            unknowns: Vec::with_capacity(2 * all),
            totals: vec![LinkTotals::default(); count],
            forces: vec![0.0; count],
            cubic: vec![[0.0; 3]; all],
            ..Self::default()
        }
    }

    /// Estimated error of forces of links, relative to the greatest of all \[–\].
    pub(super) fn error(&self) -> f64 {
        let most = |of: usize| {
            self.cubic
                .iter()
                .fold(0.0_f64, |most, cubic| most.max(cubic[of]))
        };
        let greatest = most(2);
        if greatest > 0.0 {
            MARGIN * most(1) / (MEAN * greatest)
        } else {
            0.0
        }
    }
}

/// The mean of a cubic with values and slopes is off by this part of the change of its cubic term from one step to the next:
/// F⁗h⁴/720 of F⁗h⁴/6.
const MEAN: f64 = 120.0;
/// Errors of many steps add up.
const MARGIN: f64 = 8.0;
/// Shortest step before another, in parts of it, whose third derivative is more than rounding.
const SHORTEST_BEFORE: f64 = 0.05;

impl ModalStepper<'_> {
    /// Finds the forces of all links over the tried step, as if no contact pushed at its end, and lets them push.
    pub(super) fn press_links(&mut self, grounds: &RunGrounds<'_>, slot: usize) {
        let reduced = self.reduced;
        let table = &self.tables[slot].links;
        let step = table.step();
        let motion = &mut self.links;
        motion.right.clear();
        for link in &reduced.links {
            let modes = &link.push.modes;
            let [q, v] = [&self.q[1][modes.clone()], &self.v[1][modes.clone()]];
            let mut end = closings(
                reduced,
                link,
                [q, v],
                Some(&self.p[1][modes.clone()]),
                modes,
            );
            let moved = link.moved_by_grounds(grounds, reduced, 1);
            for (value, moved) in end.iter_mut().zip(moved) {
                *value += moved;
            }
            let [force, bend] = link.unknowns(end, step);
            let slope = link.force(
                link.closing(&self.rate[0]),
                link.closing(&self.acceleration[0]),
            );
            motion.right.extend([force, bend - 0.5 * step * slope]);
        }
        table.solve(&motion.right, &mut motion.unknowns);
        for index in 0..reduced.links.len() {
            let found = [motion.unknowns[2 * index], motion.unknowns[2 * index + 1]];
            motion.bends[index] = found[1];
            let lists = [
                &mut self.q[1][..],
                &mut self.v[1],
                &mut self.p[1],
                &mut self.bend,
            ];
            table.add(reduced, index, found, 0, lists);
        }
    }

    /// Work of links over the tried step; ∫q stands in `scratch` and ∫τq in `moment`.
    pub(super) fn work_of_links(&mut self, grounds: &RunGrounds<'_>, step: f64) {
        let motion = &mut self.links;
        for (index, link) in self.reduced.links.iter().enumerate() {
            let ends = [0, 1].map(|time| link.closing(&self.u[time]));
            let forces = [0, 1].map(|time| link.force(ends[time], link.closing(&self.rate[time])));
            let moved = link.link.map_or_else(OverStep::default, |link| {
                grounds.over_step(self.reduced.unsplit_ports() + link, step)
            });
            let closing = link.closing_of(&self.scratch, 0) + moved.area;
            let leaning = 2.0 * (link.closing_of(&self.moment, 0) + moved.moment) - closing;
            self.energy.ground += moved.work(forces, motion.bends[index], step);
            let work = forces[1] * ends[1]
                - forces[0] * ends[0]
                - (forces[1] - forces[0]) * closing / step
                - motion.bends[index] * leaning / step;
            match link.link {
                Some(link) => {
                    motion.work += work;
                    motion.totals[link].work += work;
                }
                None => motion.damped += work,
            }
        }
    }

    /// Energy of the springs of links \[J\].
    pub(super) fn strain_of_links(&self) -> f64 {
        let links = self.reduced.links.iter();
        let strain = |link: &ModalLink| 0.5 * link.stiffness * link.closing(&self.u[0]).powi(2);
        links.map(strain).sum()
    }

    /// Adds the slopes of all link forces to modal jerks; modal accelerations stand in `scratch`.
    pub(super) fn add_link_slopes(&mut self, grounds: &RunGrounds<'_>) {
        for link in &self.reduced.links {
            let [.., moved] = link.moved_by_grounds(grounds, self.reduced, 0);
            let acceleration = link.closing_of(&self.scratch, 0) + moved;
            let slope = link.force(link.closing(&self.rate[0]), acceleration);
            link.push.add(slope, &mut self.jerk);
        }
    }

    /// Forces of dashpots after monitored velocities have jumped from the second list to the first.
    pub(super) fn jump_links(&mut self) {
        let [now, before] = &self.rate;
        for link in &self.reduced.links {
            let change = link.damping * (link.closing(now) - link.closing(before));
            link.push.add(change, &mut self.p[0]);
        }
        self.read_link_forces();
    }

    fn read_link_forces(&mut self) {
        for link in &self.reduced.links {
            if let Some(index) = link.link {
                let force = link.force(link.closing(&self.u[0]), link.closing(&self.rate[0]));
                self.links.forces[index] = force;
            }
        }
    }

    /// Peaks of the links over the accepted step that began at `start`, and how well cubics follow them.
    pub(super) fn follow_links(&mut self, start: f64, step: f64) {
        let motion = &mut self.links;
        // The fourth derivative times the fourth power of the step, from third ones in the middle of both steps.
        let before = std::mem::replace(&mut motion.last, step);
        let known = before > SHORTEST_BEFORE * step;
        let (by_step, by_time) = ((step / before).powi(3), 2.0 * step / (step + before));
        for (index, link) in self.reduced.links.iter().enumerate() {
            // The first of both lists is now.
            let [now, then] = [0, 1].map(|time| {
                [&self.u, &self.rate, &self.acceleration].map(|lists| link.closing(&lists[time]))
            });
            let [end, begin] = [now, then].map(|[x, rate, acceleration]| {
                (link.force(x, rate), link.force(rate, acceleration))
            });
            let cubic = step * (begin.1 + end.1) - 2.0 * (end.0 - begin.0);
            let [last, change, greatest] = &mut motion.cubic[index];
            if known {
                *change = change.max(by_time * (cubic - by_step * *last).abs());
            }
            *last = cubic;
            *greatest = greatest.max(end.0.abs());
            let Some(of_system) = link.link else {
                continue;
            };
            let totals = &mut motion.totals[of_system];
            for sign in [1.0, -1.0] {
                let [begin, end] = [begin, end].map(|(force, slope)| (sign * force, sign * slope));
                let most = greatest_in_step(begin, end, start, step);
                if most.value > totals.peak_force.value.abs() {
                    totals.peak_force = Extreme {
                        value: sign * most.value,
                        at: most.at,
                    };
                }
                let [begin, end] = [then, now].map(|[x, rate, _]| (sign * x, sign * rate));
                let most = greatest_in_step(begin, end, start, step).value;
                totals.peak_shortening = totals.peak_shortening.max(most);
                let [begin, end] =
                    [then, now].map(|[_, rate, change]| (sign * rate, sign * change));
                let most = greatest_in_step(begin, end, start, step).value;
                totals.peak_rate = totals.peak_rate.max(most);
            }
        }
        self.read_link_forces();
    }
}

impl StepTable {
    /// What unit end forces and bends of links do.
    pub(super) fn set_links(&mut self, reduced: &Reduced) {
        if !reduced.links.is_empty() {
            let [.., line, bend] = &self.displacement;
            let [.., line_rate, bend_rate] = &self.velocity;
            let ends = [[&line[..], bend], [&line_rate[..], bend_rate]];
            self.links.set(reduced, self.step, ends);
        }
    }
}
