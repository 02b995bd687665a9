//! The motion of one building over a tried step: a power series from one change of a spring to the next.

use super::operators::Operators;
use super::push::Push;
use pulp::{Arch, NullaryFnOnce};

use super::power_series::{Evaluation, Expansion, LANES, PowerSeries, Rates, padded};
use super::spring_line::{Leaving, SpringLine};
use crate::hysteresis::{HysteresisMemory, Side, Stage};
use crate::structure::Equations;

/// A part of a step over which every spring stays on its line.
#[derive(Clone, Debug)]
pub(super) struct Segment {
    /// Start, from that of the step \[s\].
    pub(super) at: f64,
    pub(super) series: PowerSeries,
    /// Displacement, velocity, acceleration and its rate at the start and at the end, filled up with zeros.
    pub(super) start: [Vec<f64>; 4],
    pub(super) end: [Vec<f64>; 4],
    /// Of every spring, its force at the start and at the end \[N\].
    pub(super) forces: [Vec<f64>; 2],
    pub(super) tangents: Vec<f64>,
}

/// Ground acceleration over a step: at its start \[m/s²\], and its slope \[m/s³\].
#[derive(Clone, Copy, Debug)]
pub(super) struct GroundLine {
    pub(super) start: f64,
    pub(super) slope: f64,
}

/// A spring has left its line.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpringChange {
    pub(super) spring: usize,
    /// Since the start of the step \[s\].
    pub(super) at: f64,
    pub(super) stage: Stage,
    /// Whether the line ended there, rather than that the spring turned.
    pub(super) at_end: bool,
}

/// Lines and memories of the springs of a building.
#[derive(Clone, Debug)]
struct Springs {
    lines: Vec<SpringLine>,
    memories: Vec<HysteresisMemory>,
}

/// One building, and its motion over the tried step.
#[derive(Clone, Debug)]
pub(super) struct BuildingMotion {
    operators: Operators,
    /// Stiffness of the springs that the operators have.
    tangents: Vec<f64>,
    /// Greatest stiffness of a spring over its initial one \[–\].
    steepest: f64,
    /// Now, and at the end of the tried step.
    springs: [Springs; 2],
    /// Springs in which the two may differ.
    touched: Vec<usize>,
    segments: Vec<Segment>,
    used: usize,
    pub(super) changes: Vec<SpringChange>,
    records: Vec<(usize, f64, f64)>,
    /// Loads per mass that grow with time \[m/s³\] and with its square \[m/s⁴\].
    loads: [Vec<f64>; 2],
    arch: Arch,
    rates: Vec<f64>,
    resisted: Vec<f64>,
}

/// Springs now, and at the end of the tried step.
const NOW: usize = 0;
const TRIED: usize = 1;
/// Changes of springs within one step before it is given up.
const MOST_CHANGES: usize = 2000;
/// Segments of a step for which there is space from the start.
const FIRST_SEGMENTS: usize = 8;
/// A segment shorter than this share of the step is left out.
const SHORTEST: f64 = 1e-13;

/// Abscissas and weights of Gauss's quadrature with four and with six points on 0…1.
pub(super) const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];
const FINER_GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_6, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_5, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_2, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];
/// Highest power for which four points are enough.
const FOUR_POINTS_UP_TO: usize = 11;

/// Work over a step \[J\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StepWork {
    /// Of the ground acceleration.
    pub(super) input: f64,
    /// Against dashpots.
    pub(super) damped: f64,
    /// Of the contact forces on the building.
    pub(super) pushed: f64,
    /// Time integral of the squared velocity of one degree of freedom, where asked for \[m²/s\].
    pub(super) followed: f64,
}

impl BuildingMotion {
    pub(super) fn new(equations: &Equations, memories: &[HysteresisMemory]) -> Self {
        let mut memories = memories.to_vec();
        let springs = equations.springs.iter().zip(&mut memories);
        let lines: Vec<SpringLine> = springs
            .map(|(spring, memory)| {
                SpringLine::from_here(&spring.hysteresis, memory, Side::Positive)
            })
            .collect();
        let now = Springs { lines, memories };
        let list = || vec![0.0; padded(equations.len())];
        let mut built = Self {
            operators: Operators::new(equations),
            tangents: vec![f64::NAN; equations.springs.len()],
            steepest: 1.0,
            springs: [now.clone(), now],
            touched: Vec::with_capacity(2 * equations.springs.len()),
            segments: Vec::new(),
            used: 0,
            changes: Vec::with_capacity(64),
            records: Vec::with_capacity(64),
            loads: [list(), list()],
            arch: Arch::new(),
            rates: list(),
            resisted: list(),
        };
        built.segments = vec![built.blank_segment(); FIRST_SEGMENTS];
        built
    }

    /// Segments of the tried step.
    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments[..self.used]
    }

    fn blank_segment(&self) -> Segment {
        let size = self.operators.size;
        let list = || vec![0.0; padded(size)];
        let springs = vec![0.0; self.tangents.len()];
        Segment {
            at: 0.0,
            series: PowerSeries::blank(size),
            start: [list(), list(), list(), list()],
            end: [list(), list(), list(), list()],
            forces: [springs.clone(), springs.clone()],
            tangents: springs,
        }
    }

    /// Memories of the springs, brought to the present displacements.
    pub(super) fn memories_at<'a>(
        &'a self,
        equations: &'a Equations,
        u: &'a [f64],
    ) -> impl Iterator<Item = HysteresisMemory> + 'a {
        let Springs { lines, memories } = &self.springs[0];
        let springs = equations.springs.iter().zip(lines).zip(memories);
        springs.map(move |((spring, line), memory)| {
            let mut memory = *memory;
            let deformation = spring.deformation(u);
            if deformation != memory.deformation() {
                let force = line.force_at(deformation);
                spring.hysteresis.commit(&mut memory, deformation, force);
            }
            memory
        })
    }

    /// Accelerations for displacements and velocities now, with the forces of the springs and the pushes now.
    pub(super) fn accelerations_now(
        &mut self,
        equations: &Equations,
        [u, v]: [&[f64]; 2],
        ground: f64,
        pushes: &[Push],
        accelerations: &mut [f64],
    ) {
        if self.operators.damping_changes() {
            self.tune(NOW);
        }
        let lines = self.springs[NOW].lines.iter().zip(&equations.springs);
        let forces = lines.map(|(line, spring)| line.force_at(spring.deformation(u)));
        self.operators
            .accelerations([u, v], ground, forces, pushes, 0.0, accelerations);
    }

    /// Rates of the accelerations for velocities and accelerations, under ground acceleration of a slope.
    pub(super) fn jerks(&mut self, [v, a]: [&[f64]; 2], slope: f64, jerks: &mut [f64]) {
        self.tune(NOW);
        for (jerk, driven) in jerks.iter_mut().zip(&self.operators.driven) {
            *jerk = -driven * slope;
        }
        self.operators.damp(a, jerks);
        self.operators.resist(v, jerks);
    }

    /// Steps from displacements, velocities and accelerations; the end stands in the last segment. `None` if springs
    /// change without end.
    pub(super) fn advance(
        &mut self,
        equations: &Equations,
        from: [&[f64]; 3],
        ground: GroundLine,
        step: f64,
        pushes: &[Push],
    ) -> Option<()> {
        self.forget_tried();
        let mut at = 0.0;
        for _ in 0..MOST_CHANGES {
            if self.used == self.segments.len() {
                let blank = self.blank_segment();
                self.segments.push(blank);
            }
            self.tune(TRIED);
            self.begin_segment(equations, from, ground, pushes, at, step - at);
            let left = self.first_change(equations);
            let share = left.map_or(1.0, |(share, _, _)| share);
            let length = share * (step - at);
            if length > SHORTEST * step || left.is_none() {
                self.end_segment(equations, share);
                at += length;
                self.used += 1;
            }
            let Some((_, spring, leaving)) = left else {
                return Some(());
            };
            self.leave(equations, spring, leaving, at);
        }
        None
    }

    fn forget_tried(&mut self) {
        let [now, tried] = &mut self.springs;
        for &spring in &self.touched {
            tried.lines[spring] = now.lines[spring];
            tried.memories[spring] = now.memories[spring];
        }
        self.touched.clear();
        self.changes.clear();
        self.used = 0;
    }

    /// Takes over the end of the tried step.
    pub(super) fn accept(&mut self) {
        let [now, tried] = &mut self.springs;
        for &spring in &self.touched {
            now.lines[spring] = tried.lines[spring];
            now.memories[spring] = tried.memories[spring];
        }
        self.touched.clear();
    }

    /// Turns springs whose rate has changed its sign all at once.
    pub(super) fn turn_springs(&mut self, equations: &Equations, [u, v]: [&[f64]; 2]) {
        let now = &mut self.springs[NOW];
        let springs = equations.springs.iter().zip(&mut now.lines);
        for ((spring, line), memory) in springs.zip(&mut now.memories) {
            if !line.goes_against(spring.deformation(v)) {
                continue;
            }
            let deformation = spring.deformation(u);
            if deformation != memory.deformation() {
                let force = line.force_at(deformation);
                spring.hysteresis.commit(memory, deformation, force);
            }
            let side = line.next_side(Leaving::Turn);
            *line = SpringLine::from_here(&spring.hysteresis, memory, side);
        }
        let [now, tried] = &mut self.springs;
        tried.clone_from(now);
    }

    /// Gives the operators the stiffness of the present lines.
    fn tune(&mut self, when: usize) {
        let lines = &self.springs[when].lines;
        let mut same = true;
        for (tangent, line) in self.tangents.iter_mut().zip(lines) {
            same &= *tangent == line.tangent;
            *tangent = line.tangent;
        }
        if !same {
            self.operators.set_tangents(self.tangents.iter().copied());
        }
    }

    fn begin_segment(
        &mut self,
        equations: &Equations,
        from: [&[f64]; 3],
        ground: GroundLine,
        pushes: &[Push],
        at: f64,
        length: f64,
    ) {
        let (before, rest) = self.segments.split_at_mut(self.used);
        let segment = &mut rest[0];
        segment.at = at;
        match before.last() {
            Some(last) => {
                for (to, from) in segment.start.iter_mut().zip(&last.end) {
                    to.copy_from_slice(from);
                }
            }
            None => {
                for (to, from) in segment.start.iter_mut().zip(from) {
                    to[..from.len()].copy_from_slice(from);
                }
            }
        }
        let lines = &self.springs[1].lines;
        for ((force, line), spring) in segment.forces[0]
            .iter_mut()
            .zip(lines)
            .zip(&equations.springs)
        {
            *force = line.force_at(spring.deformation(&segment.start[0]));
        }
        segment.tangents.copy_from_slice(&self.tangents);
        let operators = &self.operators;
        // Where dashpots change with the stiffness of springs, accelerations change with the lines.
        if operators.damping_changes() {
            let [u, v, a, _] = &mut segment.start;
            let n = operators.size;
            let forces = segment.forces[0].iter().copied();
            let shaken = ground.start + ground.slope * at;
            operators.accelerations([&u[..n], &v[..n]], shaken, forces, pushes, at, &mut a[..n]);
        }
        let [by_time, by_square] = &mut self.loads;
        for (load, driven) in by_time.iter_mut().zip(&operators.driven) {
            *load = -driven * ground.slope;
        }
        by_square.fill(0.0);
        for push in pushes {
            let [_, slope] = push.at(at);
            for &(dof, share) in push.row.entries() {
                let by = share * operators.inverse_mass[dof];
                by_time[dof] += by * slope;
                by_square[dof] += by * push.force[2];
            }
        }
        let order = PowerSeries::order_for(self.steepest.sqrt() * operators.rate, length);
        let [u, v, a, jerk] = &mut segment.start;
        self.arch.dispatch(Expansion {
            step: length,
            order,
            start: [u, v, a],
            reach: operators.reach,
            stiffness: &operators.stiffness,
            damping: &operators.damping,
            uniform_damping: operators.uniform_damping,
            loads: [&self.loads[0], &self.loads[1]],
            series: &mut segment.series,
        });
        let per_cube = 6.0 / (length * length * length);
        for (jerk, w) in jerk.iter_mut().zip(segment.series.row(3)) {
            *jerk = per_cube * w;
        }
    }

    /// The first spring that leaves its line within the segment begun: the share of the segment, the spring, and why.
    fn first_change(&mut self, equations: &Equations) -> Option<(f64, usize, Leaving)> {
        let series = &self.segments[self.used].series;
        let mut first: Option<(f64, usize, Leaving)> = None;
        self.records.clear();
        let [tail, quick_tail] = &series.tail;
        for (index, deformation) in self.operators.springs.iter().enumerate() {
            let [start, rate, second, third] =
                [0, 1, 2, 3].map(|power| deformation.value(series.row(power)));
            let swing = rate.abs() + second.abs() + third.abs() + deformation.bound(tail);
            let turning = 2.0 * second.abs() + 3.0 * third.abs() + deformation.bound(quick_tail);
            let line = &self.springs[TRIED].lines[index];
            if line.certainly_stays(start, swing, rate.abs() > turning) {
                continue;
            }
            let motion = series.of(deformation);
            let records = &mut self.records;
            let left = line.leaves(&motion, |share, deformation| {
                records.push((index, share, deformation));
            });
            if let Some((share, leaving)) = left
                && first.is_none_or(|(earliest, _, _)| share < earliest)
            {
                first = Some((share, index, leaving));
            }
        }
        let until = first.map_or(1.0, |(share, _, _)| share);
        for place in 0..self.records.len() {
            let (spring, share, deformation) = self.records[place];
            if share < until {
                let tried = &mut self.springs[1];
                let line = &mut tried.lines[spring];
                line.keep_record(deformation);
                let force = line.force_at(deformation);
                let memory = &mut tried.memories[spring];
                equations.springs[spring]
                    .hysteresis
                    .commit(memory, deformation, force);
                self.touched.push(spring);
            }
        }
        first
    }

    /// Cuts the segment begun to a share of its length, and finds its end.
    fn end_segment(&mut self, equations: &Equations, share: f64) {
        let segment = &mut self.segments[self.used];
        if share < 1.0 {
            segment.series.cut(share);
        }
        self.arch.dispatch(Evaluation {
            series: &segment.series,
            share: 1.0,
            to: &mut segment.end,
        });
        let lines = &self.springs[TRIED].lines;
        let forces = segment.forces[1].iter_mut().zip(lines);
        for ((force, line), spring) in forces.zip(&equations.springs) {
            *force = line.force_at(spring.deformation(&segment.end[0]));
        }
    }

    /// A spring leaves its line at a time since the start of the step.
    fn leave(&mut self, equations: &Equations, spring: usize, leaving: Leaving, at: f64) {
        let tried = &mut self.springs[1];
        let hysteresis = &equations.springs[spring].hysteresis;
        let (line, memory) = (&mut tried.lines[spring], &mut tried.memories[spring]);
        let deformation = match leaving {
            Leaving::End(side) => line.end(side),
            Leaving::Turn => {
                let now = match self.used.checked_sub(1) {
                    Some(last) => &self.segments[last].end[0],
                    None => &self.segments[0].start[0],
                };
                equations.springs[spring].deformation(now)
            }
        };
        let force = line.force_at(deformation);
        if deformation != memory.deformation() {
            hysteresis.commit(memory, deformation, force);
        }
        *line = SpringLine::from_here(hysteresis, memory, line.next_side(leaving));
        self.steepest = self
            .steepest
            .max(line.tangent / hysteresis.backbone().initial());
        self.touched.push(spring);
        self.changes.push(SpringChange {
            spring,
            at,
            stage: hysteresis.stage(memory),
            at_end: matches!(leaving, Leaving::End(_)),
        });
    }

    /// Work over the tried step; `followed`: a degree of freedom whose squared velocity is summed up.
    pub(super) fn work(
        &mut self,
        ground: GroundLine,
        pushes: &[Push],
        followed: Option<usize>,
    ) -> StepWork {
        let mut work = StepWork::default();
        for segment in &self.segments[..self.used] {
            if self.operators.damping_changes() {
                self.tangents.copy_from_slice(&segment.tangents);
                self.operators
                    .set_tangents(segment.tangents.iter().copied());
            }
            let quadrature = Quadrature {
                operators: &self.operators,
                segment,
                ground,
                pushes,
                followed,
                rates: &mut self.rates,
                resisted: &mut self.resisted,
                work: &mut work,
            };
            self.arch.dispatch(quadrature);
        }
        work
    }
}

/// Adds the work over a segment.
struct Quadrature<'a> {
    operators: &'a Operators,
    segment: &'a Segment,
    ground: GroundLine,
    pushes: &'a [Push],
    followed: Option<usize>,
    rates: &'a mut [f64],
    resisted: &'a mut [f64],
    work: &'a mut StepWork,
}

impl NullaryFnOnce for Quadrature<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            operators,
            segment,
            ground,
            pushes,
            followed,
            rates,
            resisted,
            work,
        } = self;
        let length = segment.series.step;
        let points: &[(f64, f64)] = if segment.series.order <= FOUR_POINTS_UP_TO {
            &GAUSS
        } else {
            &FINER_GAUSS
        };
        for &(share, weight) in points {
            let (series, to) = (&segment.series, &mut *rates);
            Rates { series, share, to }.find();
            let time = segment.at + share * length;
            let acceleration = ground.start + ground.slope * time;
            resisted.fill(0.0);
            operators.damp(rates, resisted);
            let [driven, damped] = driven_and_damped(operators, rates, resisted);
            work.input -= weight * acceleration * driven;
            work.damped -= weight * damped / length;
            for push in pushes {
                work.pushed += weight * push.at(time)[0] * push.row.value(rates);
            }
            if let Some(dof) = followed {
                work.followed += weight * rates[dof] * rates[dof] / length;
            }
        }
    }
}

/// Σ m r v and Σ m v (M⁻¹C v), lane by lane.
#[inline(always)]
fn driven_and_damped(operators: &Operators, rates: &[f64], resisted: &[f64]) -> [f64; 2] {
    let mut sums = [[0.0; LANES]; 2];
    let (rates, _) = rates.as_chunks::<LANES>();
    let (resisted, _) = resisted.as_chunks::<LANES>();
    let (masses, _) = operators.mass.as_chunks::<LANES>();
    let (driven, _) = operators.driven.as_chunks::<LANES>();
    for (((rate, resisted), mass), driven) in rates.iter().zip(resisted).zip(masses).zip(driven) {
        for l in 0..LANES {
            let momentum = mass[l] * rate[l];
            sums[0][l] += momentum * driven[l];
            sums[1][l] += momentum * resisted[l];
        }
    }
    sums.map(|lanes| lanes.iter().sum())
}
