//! The reference run: modes advanced exactly, contact forces as polynomials over adaptive steps, every touch, release and
//! corner of a force an event.

use std::rc::Rc;

use faer::c64;
use jostle::motion::Wave;
use jostle::{GroundMotion, System};

use super::laws::{Closed, Law, Next};
use super::linear::{Component, components};
use super::phi::{DEGREE, FACTORIAL, Phi, moments, phi};

const NODES: usize = DEGREE + 1;
const ZERO: c64 = c64::new(0.0, 0.0);
type Poly = [f64; NODES];
/// By mode and node.
type Exponentials = Vec<[c64; NODES]>;
/// By mode, node and power.
type Moments = Vec<[[c64; NODES]; NODES]>;
/// Of closing and rate, by node and by power or node of what pushes.
type Response = [[[f64; NODES]; NODES]; 2];

/// How fine.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Error of a force polynomial over the greatest force of its gap.
    pub force: f64,
    /// Relative change of every gap.
    pub widen: f64,
    /// Most steps.
    pub steps: u64,
}

impl Accuracy {
    /// That of the reference.
    pub const FINE: Self = Self {
        force: 1e-10,
        widen: 0.0,
        steps: 6_000_000,
    };
    /// For its conditioning.
    pub const OTHER: Self = Self {
        force: 1e-9,
        widen: 1e-6,
        steps: 6_000_000,
    };
}

/// Peaks of a building.
#[derive(Clone, Debug, Default)]
pub struct BuildingPeaks {
    /// Greatest displacement of every floor, ≥ 0 \[m\].
    pub most: Vec<f64>,
    /// Least, ≤ 0 \[m\].
    pub least: Vec<f64>,
    /// Greatest drift ratio of every storey \[–\].
    pub drift: Vec<f64>,
    /// Greatest total acceleration of every floor \[m/s²\].
    pub acceleration: Vec<f64>,
    /// Greatest base shear \[N\].
    pub shear: f64,
}

/// What a reference run finds.
#[derive(Clone, Debug, Default)]
pub struct Peaks {
    /// By building.
    pub buildings: Vec<BuildingPeaks>,
    /// Greatest force of every contact \[N\].
    pub force: Vec<f64>,
    /// Impulse of every contact \[N·s\].
    pub impulse: Vec<f64>,
    /// Touches.
    pub touches: u64,
    /// Lasting contacts of the momentum law.
    pub lasting: u64,
    /// Steps.
    pub steps: u64,
}

/// Values and slopes of what is watched in a component.
struct Watch {
    /// Rows of coefficients: displacement and velocity of foot and floors, acceleration and jerk of floors, shear and its
    /// slope.
    rows: Vec<Vec<c64>>,
    jerk_by_ground: Vec<f64>,
    constant: Vec<f64>,
    /// (building, index of its foot row among displacements, floors, storey heights, offset of rest).
    buildings: Vec<Watched>,
    floors: usize,
}

struct Watched {
    building: usize,
    first_floor: usize,
    heights: Vec<f64>,
    has_foot: bool,
}

struct Side {
    component: usize,
    row: Vec<c64>,
    rate: Vec<c64>,
    push: Vec<c64>,
    /// Jump of the accelerations of floors per force, and of their slopes.
    accelerates: Vec<f64>,
    jerks: Vec<f64>,
}

struct Meeting {
    sides: Vec<Side>,
    width: f64,
    rest: f64,
    law: Law,
    blow: Option<f64>,
    mass: f64,
    gap: usize,
    floor_force: f64,
    duration: f64,
}

/// What a step of some length does.
struct Level {
    step: f64,
    /// By component: [mode][node] e^{λτ}.
    exp: Vec<Option<Rc<Exponentials>>>,
    /// By component: [mode][node][k] moments.
    moment: Vec<Option<Rc<Moments>>>,
    /// By contact: response of closing and rate to monomials of the ground.
    ground: Vec<Option<Rc<Response>>>,
    pairs: std::collections::HashMap<(usize, usize), Rc<Response>>,
}

struct Run<'a> {
    motion: &'a GroundMotion,
    components: Vec<Component>,
    watch: Vec<Watch>,
    meetings: Vec<Meeting>,
    nodes: Poly,
    to_monomials: [[f64; NODES]; NODES],
    to_chebyshev: [[f64; NODES]; NODES],
    levels: Vec<Level>,
    ground_degree: usize,
    /// Length of the pieces of the ground motion.
    piece: f64,
    q: Vec<Vec<c64>>,
    signals: Vec<Vec<(f64, f64)>>,
    closed: Vec<Option<Closed>>,
    peaks: Peaks,
    gap_force: Vec<f64>,
    accuracy: Accuracy,
}

fn horner(poly: &Poly, s: f64) -> f64 {
    poly.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

fn slope(poly: &Poly, s: f64) -> f64 {
    (1..NODES)
        .rev()
        .fold(0.0, |sum, k| sum * s + k as f64 * poly[k])
}

fn real_dot(row: &[c64], q: &[c64]) -> f64 {
    row.iter()
        .zip(q)
        .map(|(c, q)| c.re * q.re - c.im * q.im)
        .sum()
}

fn inverse(matrix: &[[f64; NODES]; NODES]) -> [[f64; NODES]; NODES] {
    use faer::Mat;
    use faer::linalg::solvers::DenseSolveCore;
    let inverse = Mat::from_fn(NODES, NODES, |i, j| matrix[i][j])
        .full_piv_lu()
        .inverse();
    std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)]))
}

fn apply(matrix: &[[f64; NODES]; NODES], values: &Poly) -> Poly {
    std::array::from_fn(|i| (0..NODES).map(|j| matrix[i][j] * values[j]).sum())
}

/// Runs a system.
///
/// # Errors
/// Why there is no reference.
pub fn run(system: &System, motion: &GroundMotion, accuracy: Accuracy) -> Result<Peaks, String> {
    let mut run = Run::new(system, motion, accuracy)?;
    run.go()?;
    Ok(run.peaks)
}

/// A step in contact under way: forces as polynomials of the share of the step.
struct Pushes {
    step: f64,
    ground: Poly,
    forces: Vec<(usize, Poly)>,
}

impl<'a> Run<'a> {
    fn new(system: &System, motion: &'a GroundMotion, accuracy: Accuracy) -> Result<Self, String> {
        let components = components(system)?;
        let of_building = |building: usize| {
            components
                .iter()
                .position(|c| c.buildings.contains(&building))
                .unwrap_or(0)
        };
        let watch: Vec<Watch> = components
            .iter()
            .map(|component| Watch::of(system, component))
            .collect();
        let rest_of = |dof: usize| {
            let building = system.buildings.iter().find(|b| b.range().contains(&dof));
            building.map_or(0.0, |b| {
                b.rest
                    .displacement
                    .get(dof - b.offset)
                    .copied()
                    .unwrap_or(0.0)
            })
        };
        let mut meetings = Vec::new();
        for contact in &system.contacts {
            let mut by_component: Vec<(usize, Vec<(usize, f64)>)> = Vec::new();
            for (face, sign) in contact.ports.sides() {
                let component = of_building(face.building);
                match by_component.iter_mut().find(|(c, _)| *c == component) {
                    Some((_, list)) => list.push((face.dof, sign)),
                    None => by_component.push((component, vec![(face.dof, sign)])),
                }
            }
            let mut rest = 0.0;
            let sides = by_component
                .into_iter()
                .map(|(index, list)| {
                    let component = &components[index];
                    // A force pushes with `sign`; the closing falls by as much.
                    let weights: Vec<(usize, f64)> =
                        list.iter().map(|(dof, s)| (*dof, -s)).collect();
                    rest += weights
                        .iter()
                        .map(|(dof, w)| w * rest_of(*dof))
                        .sum::<f64>();
                    let row = component.output(&weights);
                    let rate = row
                        .iter()
                        .zip(&component.lambda)
                        .map(|(c, l)| c * l)
                        .collect();
                    let mut push = vec![ZERO; component.lambda.len()];
                    for (dof, sign) in &list {
                        for (sum, own) in push.iter_mut().zip(component.push(*dof)) {
                            *sum += own * *sign;
                        }
                    }
                    let watch = &watch[index];
                    let by = |power: i32| -> Vec<f64> {
                        (0..watch.floors)
                            .map(|floor| {
                                let row = watch.displacement(floor);
                                let terms = row.iter().zip(&component.lambda).zip(&push);
                                terms.map(|((c, l), b)| (c * l.powi(power) * b).re).sum()
                            })
                            .collect()
                    };
                    Side {
                        component: index,
                        row,
                        rate,
                        accelerates: by(1),
                        jerks: by(2),
                        push,
                    }
                })
                .collect();
            let (law, blow) = Law::of(&contact.law)?;
            let mass = contact.effective_mass();
            meetings.push(Meeting {
                sides,
                width: contact.width * (1.0 + accuracy.widen) + 1e-4 * accuracy.widen,
                rest,
                law,
                blow,
                mass,
                gap: contact.gap,
                floor_force: contact.law.elastic_force(mass, 0.03),
                duration: contact.law.elastic_duration(mass, 0.3),
            });
        }
        let nodes: Poly = std::array::from_fn(|i| {
            0.5 * (1.0 - (std::f64::consts::PI * i as f64 / DEGREE as f64).cos())
        });
        let powers = std::array::from_fn(|i| std::array::from_fn(|k| nodes[i].powi(k as i32)));
        let cosines = std::array::from_fn(|i| {
            std::array::from_fn(|k| (std::f64::consts::PI * (i * k) as f64 / DEGREE as f64).cos())
        });
        // Fine enough to see the motions that matter between samples.
        let mut fastest: f64 = 2.0;
        for (component, watch) in components.iter().zip(&watch) {
            for floor in 0..watch.floors {
                let row = watch.displacement(floor);
                let mut parts: Vec<(f64, f64)> = (0..row.len())
                    .map(|j| {
                        let l = component.lambda[j];
                        (l.norm(), (row[j] * l * component.ground[j]).norm())
                    })
                    .collect();
                parts.sort_by(|a, b| b.0.total_cmp(&a.0));
                let mut beyond = 0.0;
                for (omega, share) in parts {
                    beyond += share;
                    if beyond > 0.03 {
                        fastest = fastest.max(omega);
                        break;
                    }
                }
            }
        }
        let wanted = (0.5 / fastest).clamp(5e-5, 6e-4);
        let (piece, ground_degree) = match motion.wave {
            Wave::Sampled { step, .. } => (step, 1),
            Wave::Sine { period, .. } => (period / 24.0, DEGREE),
            Wave::Ricker { period, .. } => (period / 40.0, DEGREE),
        };
        let flight = piece / (piece / wanted).ceil();
        let gaps = system.contacts.iter().map(|c| c.gap + 1).max().unwrap_or(0);
        let q = components
            .iter()
            .map(|c| vec![ZERO; c.lambda.len()])
            .collect();
        let mut run = Self {
            motion,
            signals: watch.iter().map(|w| vec![(0.0, 0.0); w.len()]).collect(),
            watch,
            nodes,
            to_monomials: inverse(&powers),
            to_chebyshev: inverse(&cosines),
            levels: Vec::new(),
            ground_degree,
            piece,
            q,
            closed: vec![None; meetings.len()],
            peaks: Peaks {
                buildings: system
                    .buildings
                    .iter()
                    .map(|b| BuildingPeaks {
                        most: vec![0.0; b.floors.len()],
                        least: vec![0.0; b.floors.len()],
                        drift: vec![0.0; b.floors.len()],
                        acceleration: vec![0.0; b.floors.len()],
                        shear: 0.0,
                    })
                    .collect(),
                force: vec![0.0; meetings.len()],
                impulse: vec![0.0; meetings.len()],
                ..Peaks::default()
            },
            gap_force: vec![0.0; gaps],
            meetings,
            components,
            accuracy,
        };
        run.level_of(0, flight);
        for index in 0..run.components.len() {
            run.read_signals(index);
        }
        Ok(run)
    }

    fn level_of(&mut self, level: usize, flight: f64) {
        while self.levels.len() <= level {
            let n = self.levels.len();
            self.levels.push(Level {
                step: flight * 0.5_f64.powi(n as i32),
                exp: vec![None; self.components.len()],
                moment: vec![None; self.components.len()],
                ground: vec![None; self.meetings.len()],
                pairs: std::collections::HashMap::new(),
            });
        }
    }

    /// e^{λτ} and moments at the nodes of a step for a component.
    fn tables(&mut self, level: usize, component: usize) -> (Rc<Exponentials>, Rc<Moments>) {
        if let (Some(exp), Some(moment)) = (
            &self.levels[level].exp[component],
            &self.levels[level].moment[component],
        ) {
            return (exp.clone(), moment.clone());
        }
        let step = self.levels[level].step;
        let mut exps = Vec::new();
        let mut all = Vec::new();
        let mut work: Phi = [ZERO; DEGREE + 2];
        for l in &self.components[component].lambda {
            let mut exp = [c64::new(1.0, 0.0); NODES];
            let mut moment = [[ZERO; NODES]; NODES];
            for i in 1..NODES {
                phi(*l * (self.nodes[i] * step), DEGREE + 1, &mut work);
                exp[i] = work[0];
                moments(&work, self.nodes[i], step, DEGREE, &mut moment[i]);
            }
            exps.push(exp);
            all.push(moment);
        }
        let (exps, all) = (Rc::new(exps), Rc::new(all));
        self.levels[level].exp[component] = Some(exps.clone());
        self.levels[level].moment[component] = Some(all.clone());
        (exps, all)
    }

    /// Responses of the closing of a contact and of its rate to monomials of the ground.
    fn by_ground(&mut self, level: usize, contact: usize) -> Rc<Response> {
        if let Some(known) = &self.levels[level].ground[contact] {
            return known.clone();
        }
        let mut response = [[[0.0; NODES]; NODES]; 2];
        for side in 0..self.meetings[contact].sides.len() {
            let component = self.meetings[contact].sides[side].component;
            let (_, moment) = self.tables(level, component);
            let own = &self.meetings[contact].sides[side];
            let input = &self.components[component].ground;
            add_response(&mut response, own, input, &moment);
        }
        let response = Rc::new(response);
        self.levels[level].ground[contact] = Some(response.clone());
        response
    }

    /// Responses of the closing of a contact to the nodal values of the force of another; `None` where nothing joins them.
    fn by_force(&mut self, level: usize, contact: usize, other: usize) -> Option<Rc<Response>> {
        if let Some(known) = self.levels[level].pairs.get(&(contact, other)) {
            return Some(known.clone());
        }
        let mut response = [[[0.0; NODES]; NODES]; 2];
        let mut any = false;
        for side in 0..self.meetings[contact].sides.len() {
            for with in 0..self.meetings[other].sides.len() {
                let component = self.meetings[contact].sides[side].component;
                if self.meetings[other].sides[with].component != component {
                    continue;
                }
                any = true;
                let (_, moment) = self.tables(level, component);
                let (own, push) = (
                    &self.meetings[contact].sides[side],
                    &self.meetings[other].sides[with].push,
                );
                add_response(&mut response, own, push, &moment);
            }
        }
        if !any {
            return None;
        }
        // From monomials to nodal values.
        for part in &mut response {
            for row in part.iter_mut() {
                let by: Poly = std::array::from_fn(|k| {
                    (0..NODES).map(|m| row[m] * self.to_monomials[m][k]).sum()
                });
                *row = by;
            }
        }
        let response = Rc::new(response);
        self.levels[level]
            .pairs
            .insert((contact, other), response.clone());
        Some(response)
    }

    /// The ground over a step as a polynomial of the share of it.
    fn ground(&self, index: u64, inside: f64, step: f64) -> Poly {
        let mut poly = [0.0; NODES];
        match &self.motion.wave {
            Wave::Sampled {
                acceleration,
                step: record,
            } => {
                let at = |k: u64| acceleration.get(k as usize).copied();
                if let (Some(a), Some(b)) = (at(index), at(index + 1)) {
                    let rise = (b - a) / record;
                    poly[0] = self.motion.scale * (a + rise * inside);
                    poly[1] = self.motion.scale * rise * step;
                }
                poly
            }
            _ => {
                let start = index as f64 * self.piece + inside;
                for i in 0..NODES {
                    poly[i] = self.wave(start + self.nodes[i] * step);
                }
                apply(&self.to_monomials, &poly)
            }
        }
    }

    /// The analytic wave, going on beyond the end.
    fn wave(&self, t: f64) -> f64 {
        let mut longer = self.motion.clone();
        longer.duration = f64::INFINITY;
        longer.acceleration(t)
    }

    /// Closing less width, and its rate, of a contact.
    fn closing(&self, contact: usize, q: &[Vec<c64>]) -> (f64, f64) {
        let meeting = &self.meetings[contact];
        let mut sum = (meeting.rest - meeting.width, 0.0);
        for side in &meeting.sides {
            sum.0 += real_dot(&side.row, &q[side.component]);
            sum.1 += real_dot(&side.rate, &q[side.component]);
        }
        sum
    }

    /// The modes of a component at a share of the step.
    fn at(&self, component: usize, s: f64, pushes: &Pushes, out: &mut Vec<c64>) {
        let inputs = self.inputs(component, pushes);
        let own = &self.components[component];
        let last = if inputs.is_empty() {
            self.ground_degree
        } else {
            DEGREE
        };
        let (mut work, mut moment) = ([ZERO; DEGREE + 2], [ZERO; NODES]);
        out.clear();
        for j in 0..own.lambda.len() {
            phi(own.lambda[j] * (s * pushes.step), last + 1, &mut work);
            moments(&work, s, pushes.step, last, &mut moment);
            out.push(advance(
                self.q[component][j],
                work[0],
                &moment,
                j,
                own,
                &inputs,
                pushes,
                last,
            ));
        }
    }

    /// Pushes on a component and their polynomials.
    fn inputs<'b>(&'b self, component: usize, pushes: &'b Pushes) -> Vec<(&'b [c64], &'b Poly)> {
        let forces = pushes.forces.iter();
        forces
            .flat_map(|(contact, poly)| {
                let sides = self.meetings[*contact].sides.iter();
                sides
                    .filter(move |side| side.component == component)
                    .map(move |side| (&side.push[..], poly))
            })
            .collect()
    }

    /// All modes at the end of a whole step of a level, or at a share of it.
    fn advanced(&mut self, level: usize, s: f64, pushes: &Pushes) -> Vec<Vec<c64>> {
        let mut all = Vec::with_capacity(self.components.len());
        for component in 0..self.components.len() {
            let mut out = Vec::with_capacity(self.q[component].len());
            if s == 1.0 {
                let (exp, moment) = self.tables(level, component);
                let inputs = self.inputs(component, pushes);
                let own = &self.components[component];
                let last = if inputs.is_empty() {
                    self.ground_degree
                } else {
                    DEGREE
                };
                for j in 0..own.lambda.len() {
                    out.push(advance(
                        self.q[component][j],
                        exp[j][DEGREE],
                        &moment[j][DEGREE],
                        j,
                        own,
                        &inputs,
                        pushes,
                        last,
                    ));
                }
            } else {
                self.at(component, s, pushes, &mut out);
            }
            all.push(out);
        }
        all
    }

    /// Closing and rate of a contact at a share of the step, exactly.
    fn closing_at(&self, contact: usize, s: f64, pushes: &Pushes) -> (f64, f64) {
        let meeting = &self.meetings[contact];
        let mut sum = (meeting.rest - meeting.width, 0.0);
        let mut q = Vec::new();
        for side in &meeting.sides {
            self.at(side.component, s, pushes, &mut q);
            sum.0 += real_dot(&side.row, &q);
            sum.1 += real_dot(&side.rate, &q);
        }
        sum
    }

    fn go(&mut self) -> Result<(), String> {
        let duration = self.motion.duration;
        let (mut index, mut inside) = (0_u64, 0.0_f64);
        let mut level = 0_usize;
        let mut still = 0;
        let flight = self.levels[0].step;
        let finest = (flight / 2e-11).log2().ceil() as usize;
        loop {
            let start = index as f64 * self.piece;
            let whole = self.piece.min(duration - start);
            if whole <= 1e-12 {
                break;
            }
            let left = whole - inside;
            if left <= 1e-14 {
                index += 1;
                inside = 0.0;
                continue;
            }
            self.peaks.steps += 1;
            if self.peaks.steps > self.accuracy.steps {
                return Err(format!(
                    "more than {} steps by {:.3} s",
                    self.accuracy.steps,
                    start + inside
                ));
            }
            let in_contact = self.closed.iter().any(Option::is_some);
            if !in_contact {
                level = 0;
            }
            self.level_of(level, flight);
            let step = self.levels[level].step;
            let ground = self.ground(index, inside, step);
            let most = if left < step * (1.0 - 1e-9) {
                left / step
            } else {
                1.0
            };
            let mut pushes = Pushes {
                step,
                ground,
                forces: Vec::new(),
            };
            let mut easy = false;
            let mut courses = Vec::new();
            if in_contact {
                match self.forces(level, &mut pushes, &mut courses) {
                    Some(error) if error <= 1.0 => easy = error < 2e-3,
                    _ if level < finest => {
                        level += 1;
                        continue;
                    }
                    Some(_) => {}
                    None => return Err(format!("forces not found at {:.6} s", start + inside)),
                }
            }
            let (mut reach, events) = self.corners(&courses, most);
            let mut after = self.advanced(level, reach, &pushes);
            if let Some((s, contact)) = self.touch_within(reach, &after, &pushes) {
                if s < reach {
                    after = self.advanced(level, s, &pushes);
                    reach = s;
                }
                self.accept(reach, after, &pushes);
                self.closings_happen(contact, &mut level);
                inside += reach * step;
                still = if reach * step < 1e-13 { still + 1 } else { 0 };
            } else {
                self.accept(reach, after, &pushes);
                inside += reach * step;
                still = if reach * step < 1e-13 { still + 1 } else { 0 };
                for (contact, next) in events {
                    self.happen(contact, next);
                }
            }
            if reach >= most && most < 1.0 || (whole - inside).abs() < 1e-14 {
                index += 1;
                inside = 0.0;
            }
            if still > 400 {
                return Err(format!("endless events at {:.6} s", start + inside));
            }
            if easy && reach >= most && level > 0 {
                level -= 1;
            }
        }
        for contact in 0..self.closed.len() {
            if let Some(closed) = self.closed[contact].take() {
                self.peaks.impulse[contact] += closed.impulse;
            }
        }
        Ok(())
    }

    /// Finds the forces of the closed contacts over a step; the courses of closing and rate come along as polynomials. The
    /// error is relative to what is allowed.
    fn forces(
        &mut self,
        level: usize,
        pushes: &mut Pushes,
        courses: &mut Vec<(usize, Poly, Poly)>,
    ) -> Option<f64> {
        let list: Vec<usize> = (0..self.closed.len())
            .filter(|contact| self.closed[*contact].is_some())
            .collect();
        let mut free: Vec<[Poly; 2]> = Vec::new();
        for &contact in &list {
            let by = self.by_ground(level, contact);
            let mut courses = [[0.0; NODES]; 2];
            let now = self.closing(contact, &self.q);
            (courses[0][0], courses[1][0]) = now;
            for side in 0..self.meetings[contact].sides.len() {
                let component = self.meetings[contact].sides[side].component;
                let (exp, _) = self.tables(level, component);
                let own = &self.meetings[contact].sides[side];
                for (j, q) in self.q[component].iter().enumerate() {
                    let (u, v) = (own.row[j] * q, own.rate[j] * q);
                    for i in 1..NODES {
                        let e = exp[j][i];
                        courses[0][i] += u.re * e.re - u.im * e.im;
                        courses[1][i] += v.re * e.re - v.im * e.im;
                    }
                }
            }
            for i in 1..NODES {
                courses[0][i] += self.meetings[contact].rest - self.meetings[contact].width;
                for part in 0..2 {
                    for k in 0..=self.ground_degree {
                        courses[part][i] += by[part][i][k] * pushes.ground[k];
                    }
                }
            }
            free.push(courses);
        }
        let mut pairs = Vec::new();
        for (a, &contact) in list.iter().enumerate() {
            for (b, &other) in list.iter().enumerate() {
                if let Some(by) = self.by_force(level, contact, other) {
                    pairs.push((a, b, by));
                }
            }
        }
        let law = |a: usize, x: f64, v: f64| {
            self.closed[list[a]]
                .as_ref()
                .map_or(0.0, |closed| closed.force(x, v))
        };
        let mut forces: Vec<Poly> = (0..list.len())
            .map(|a| std::array::from_fn(|i| law(a, free[a][0][i], free[a][1][i])))
            .collect();
        let mut moved = free.clone();
        let allowed: Vec<f64> = list
            .iter()
            .map(|contact| {
                let meeting = &self.meetings[*contact];
                self.accuracy.force * self.gap_force[meeting.gap].max(meeting.floor_force)
            })
            .collect();
        let mut settled = false;
        let mut before = f64::INFINITY;
        for round in 0..40 {
            moved.clone_from(&free);
            for (a, b, by) in &pairs {
                for part in 0..2 {
                    for i in 1..NODES {
                        let row = &by[part][i];
                        let sum: f64 = row.iter().zip(&forces[*b]).map(|(r, f)| r * f).sum();
                        moved[*a][part][i] += sum;
                    }
                }
            }
            let mut change: f64 = 0.0;
            for a in 0..list.len() {
                for i in 0..NODES {
                    let force = law(a, moved[a][0][i], moved[a][1][i]);
                    change = change.max((force - forces[a][i]).abs() / allowed[a]);
                    forces[a][i] = force;
                }
            }
            if !change.is_finite() {
                return None;
            }
            if change < 1e-2 || (change < 0.5 && change >= before) {
                settled = true;
                break;
            }
            if round > 12 && change > 0.7 * before && change > 1e3 {
                return None;
            }
            before = change;
        }
        if !settled {
            return None;
        }
        let mut error: f64 = 0.0;
        for (a, &contact) in list.iter().enumerate() {
            let terms = apply(&self.to_chebyshev, &forces[a]);
            let tail = terms[DEGREE].abs().max(0.3 * terms[DEGREE - 1].abs());
            error = error.max(tail / allowed[a]);
            pushes
                .forces
                .push((contact, apply(&self.to_monomials, &forces[a])));
            let [x, v] = &moved[a];
            courses.push((
                contact,
                apply(&self.to_monomials, x),
                apply(&self.to_monomials, v),
            ));
        }
        Some(error)
    }

    /// The first corner or release of a closed contact in a step, and what happens there.
    fn corners(&self, courses: &[(usize, Poly, Poly)], most: f64) -> (f64, Vec<(usize, Next)>) {
        const PARTS: usize = 16;
        let mut first = most;
        let mut events = Vec::new();
        for (contact, x, v) in courses {
            let Some(closed) = &self.closed[*contact] else {
                continue;
            };
            let conditions = |s: f64| closed.conditions(horner(x, s), horner(v, s), slope(v, s));
            let mut before = conditions(0.0);
            'parts: for part in 1..=PARTS {
                let s = most * part as f64 / PARTS as f64;
                let now = conditions(s);
                let mut found: Option<(f64, Next)> = None;
                for k in 0..3 {
                    if now[k].0 >= 0.0 {
                        continue;
                    }
                    let (mut low, mut high) = (most * (part - 1) as f64 / PARTS as f64, s);
                    if before[k].0 < 0.0 {
                        // It failed from the start: at once.
                        high = low;
                    } else {
                        for _ in 0..70 {
                            let middle = 0.5 * (low + high);
                            if conditions(middle)[k].0 < 0.0 {
                                high = middle;
                            } else {
                                low = middle;
                            }
                        }
                    }
                    if found.is_none_or(|(at, _)| high < at) {
                        found = Some((high, now[k].1));
                    }
                }
                if let Some((at, next)) = found {
                    if at < first {
                        first = at;
                        events.clear();
                    }
                    if at <= first {
                        events.push((*contact, next));
                    }
                    break 'parts;
                }
                before = now;
            }
        }
        (first, events)
    }

    /// The first touch of an open contact within a share of the step.
    fn touch_within(
        &self,
        reach: f64,
        after: &[Vec<c64>],
        pushes: &Pushes,
    ) -> Option<(f64, usize)> {
        let h = reach * pushes.step;
        let mut first: Option<(f64, usize)> = None;
        for contact in 0..self.meetings.len() {
            if self.closed[contact].is_some() {
                continue;
            }
            let (x0, v0) = self.closing(contact, &self.q);
            let (x1, v1) = self.closing(contact, after);
            let Some(s) = self.touch_of(contact, (x0, v0), (x1, v1), h, reach, pushes) else {
                continue;
            };
            if first.is_none_or(|(at, _)| s < at) {
                first = Some((s, contact));
            }
        }
        first
    }

    fn touch_of(
        &self,
        contact: usize,
        (x0, v0): (f64, f64),
        (x1, v1): (f64, f64),
        h: f64,
        reach: f64,
        pushes: &Pushes,
    ) -> Option<f64> {
        const NEAR: f64 = 1e-13;
        let touching = x0 > -NEAR;
        if touching && v0 > 1e-13 {
            return Some(0.0);
        }
        if h <= 0.0 {
            return None;
        }
        let top = hermite_top(x0, v0, x1, v1, h);
        if !touching
            && x1 <= 0.0
            && top.is_none_or(|(_, value)| value < -1e-8 - 1e-3 * (x1 - x0).abs())
        {
            return None;
        }
        let at = |share: f64| self.closing_at(contact, share * reach, pushes);
        let (mut low, mut high);
        if touching {
            if x1 <= 0.0 {
                return None;
            }
            if v0 > -1e-13 {
                return Some(0.0);
            }
            // It parts, and comes back: find where it is apart.
            (low, high) = (0.5, 1.0);
            let mut found = false;
            for _ in 0..40 {
                if at(low).0 < 0.0 {
                    found = true;
                    break;
                }
                high = low;
                low *= 0.5;
            }
            if !found {
                return Some(0.0);
            }
        } else {
            (low, high) = (0.0, 1.0);
            if x1 <= 0.0 {
                let (place, _) = top?;
                // The top of the exact course.
                let (mut a, mut b) = (0.0_f64.max(place - 0.3), 1.0_f64.min(place + 0.3));
                let mut place = place;
                let mut deepest = f64::NEG_INFINITY;
                for _ in 0..12 {
                    let (x, v) = at(place);
                    deepest = deepest.max(x);
                    if x > 0.0 {
                        break;
                    }
                    if v > 0.0 {
                        a = place;
                    } else {
                        b = place;
                    }
                    place = 0.5 * (a + b);
                    if deepest < -1e-7 && b - a < 0.1 {
                        break;
                    }
                }
                if at(place).0 <= 0.0 {
                    return None;
                }
                high = place;
            }
        }
        let mut s = 0.5 * (low + high);
        for _ in 0..80 {
            let (x, v) = at(s);
            if x > 0.0 {
                high = s;
            } else {
                low = s;
            }
            if x.abs() < 1e-15 || high - low < 1e-16 {
                break;
            }
            let newton = s - x / (v * h);
            s = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
        }
        Some(s * reach)
    }

    /// Closes the contact that touches, and all that touch with it.
    fn closings_happen(&mut self, first: usize, level: &mut usize) {
        let mut blows = 0;
        loop {
            let touching: Vec<usize> = (0..self.meetings.len())
                .filter(|&contact| {
                    let (x, v) = self.closing(contact, &self.q);
                    self.closed[contact].is_none()
                        && (contact == first && blows == 0 || x >= -1e-12 && v > 0.0)
                })
                .collect();
            let struck = touching.iter().find_map(|&contact| {
                let rate = self.closing(contact, &self.q).1;
                let blow = self.meetings[contact].blow.filter(|_| rate > 1e-3)?;
                Some((contact, blow, rate))
            });
            if let Some((contact, restitution, rate)) = struck {
                blows += 1;
                let impulse = (1.0 + restitution) * self.meetings[contact].mass * rate;
                for side in &self.meetings[contact].sides {
                    for (q, b) in self.q[side.component].iter_mut().zip(&side.push) {
                        *q += b * impulse;
                    }
                }
                self.peaks.impulse[contact] += impulse;
                self.peaks.touches += 1;
                let sides: Vec<usize> = self.meetings[contact]
                    .sides
                    .iter()
                    .map(|side| side.component)
                    .collect();
                for component in sides {
                    self.read_signals(component);
                }
                if blows < 10_000 {
                    continue;
                }
            }
            for contact in touching {
                let rate = self.closing(contact, &self.q).1.max(0.0);
                if self.meetings[contact].blow.is_some() && rate > 1e-3 {
                    continue;
                }
                if self.meetings[contact].blow.is_some() {
                    self.peaks.lasting += 1;
                }
                let law = self.meetings[contact].law;
                self.closed[contact] = Some(Closed::touch(law, rate));
                self.peaks.touches += 1;
                let begin = if law.is_steep() {
                    2e-10
                } else {
                    self.meetings[contact].duration / 20.0
                };
                let wanted = (self.levels[0].step / begin).log2().ceil().max(0.0) as usize;
                *level = (*level).max(wanted);
            }
            break;
        }
    }

    /// A corner or the release of a contact.
    fn happen(&mut self, contact: usize, next: Next) {
        let (x, v) = self.closing(contact, &self.q);
        let Some(closed) = &mut self.closed[contact] else {
            return;
        };
        match next {
            Next::Piece(piece) => closed.become_piece(piece, x, v),
            Next::Release => {
                self.peaks.impulse[contact] += closed.impulse;
                self.closed[contact] = None;
            }
        }
    }

    /// Goes on to a share of the step, and takes the peaks on the way.
    fn accept(&mut self, reach: f64, after: Vec<Vec<c64>>, pushes: &Pushes) {
        let h = reach * pushes.step;
        if h > 0.0 {
            for (contact, poly) in &pushes.forces {
                let mut impulse = 0.0;
                let mut power = reach;
                for (k, c) in poly.iter().enumerate() {
                    impulse += c * power / (k + 1) as f64;
                    power *= reach;
                }
                if let Some(closed) = &mut self.closed[*contact] {
                    closed.impulse += impulse * pushes.step;
                }
                let greatest = (0..=32)
                    .map(|k| k as f64 / 32.0 * reach)
                    .map(|s| (s, horner(poly, s)))
                    .max_by(|a, b| a.1.total_cmp(&b.1))
                    .map_or(0.0, |(s, value)| {
                        // A parabola through three points.
                        let d = reach / 32.0;
                        if s <= 0.0 || s >= reach {
                            return value;
                        }
                        let (a, b) = (horner(poly, s - d), horner(poly, s + d));
                        let curve = a - 2.0 * value + b;
                        if curve < 0.0 {
                            value - (b - a) * (b - a) / (8.0 * curve)
                        } else {
                            value
                        }
                    });
                let peak = &mut self.peaks.force[*contact];
                *peak = peak.max(greatest);
                let gap = self.meetings[*contact].gap;
                self.gap_force[gap] = self.gap_force[gap].max(greatest);
            }
        }
        let before_signals: Vec<Vec<(f64, f64)>> = (0..self.components.len())
            .map(|component| self.with_forces(component, 0.0, pushes))
            .collect();
        let old = std::mem::replace(&mut self.q, after);
        let mut after_signals = Vec::with_capacity(before_signals.len());
        for (component, before) in before_signals.iter().enumerate() {
            self.read_signals(component);
            let signals = self.with_forces(component, reach, pushes);
            self.take(component, before);
            self.take(component, &signals);
            after_signals.push(signals);
        }
        if h > 0.0 {
            let now = std::mem::replace(&mut self.q, old);
            for (component, ends) in before_signals.iter().zip(&after_signals).enumerate() {
                self.explore(component, [0.0, reach], [ends.0, ends.1], pushes, 0);
            }
            self.q = now;
        }
    }

    /// Takes peaks inside a part of a step: parts are halved until a cubic meets the exact motion in the middle.
    fn explore(
        &mut self,
        component: usize,
        [from, to]: [f64; 2],
        ends: [&[(f64, f64)]; 2],
        pushes: &Pushes,
        depth: u32,
    ) {
        const DEEPEST: u32 = 10;
        let h = (to - from) * pushes.step;
        let near = self.near(component, ends, h);
        if near.is_empty() {
            return;
        }
        let share = 0.5 * (from + to);
        let middle = self.exact(component, share, pushes);
        self.take(component, &middle);
        let rough = near.iter().any(|&(place, peak)| {
            let ((x0, v0), (x1, v1)) = (ends[0][place], ends[1][place]);
            let cubic = 0.5 * (x0 + x1) + 0.125 * h * (v0 - v1);
            (cubic - middle[place].0).abs() > ROUGH * peak
        });
        let halves = [
            ([from, share], [ends[0], &middle]),
            ([share, to], [&middle, ends[1]]),
        ];
        for (span, ends) in halves {
            if rough && depth < DEEPEST {
                self.explore(component, span, ends, pushes, depth + 1);
                continue;
            }
            for (place, peak) in self.near(component, ends, 0.5 * h) {
                let ((x0, v0), (x1, v1)) = (ends[0][place], ends[1][place]);
                let tops = [
                    hermite_top(x0, v0, x1, v1, 0.5 * h),
                    hermite_top(-x0, -v0, -x1, -v1, 0.5 * h),
                ];
                for (part, value) in tops.into_iter().flatten() {
                    if value > (1.0 - 1e-3) * peak {
                        let share = span[0] + part * (span[1] - span[0]);
                        let own = self.exact(component, share, pushes);
                        self.take(component, &own);
                    }
                }
            }
        }
    }

    /// Signals at a share of the step.
    fn exact(&self, component: usize, share: f64, pushes: &Pushes) -> Vec<(f64, f64)> {
        let mut q = Vec::new();
        self.at(component, share, pushes, &mut q);
        let bare = self.watch[component].values(&q, horner(&pushes.ground, share));
        self.add_forces(component, bare, share, pushes)
    }

    fn read_signals(&mut self, component: usize) {
        self.signals[component] = self.watch[component].values(&self.q[component], 0.0);
    }

    fn with_forces(&self, component: usize, s: f64, pushes: &Pushes) -> Vec<(f64, f64)> {
        let mut own = self.signals[component].clone();
        let watch = &self.watch[component];
        let ground = horner(&pushes.ground, s);
        for floor in 0..watch.floors {
            own[watch.acceleration(floor)].1 += watch.jerk_by_ground[floor] * ground;
        }
        self.add_forces(component, own, s, pushes)
    }

    fn add_forces(
        &self,
        component: usize,
        mut own: Vec<(f64, f64)>,
        s: f64,
        pushes: &Pushes,
    ) -> Vec<(f64, f64)> {
        let watch = &self.watch[component];
        for (contact, poly) in &pushes.forces {
            let (force, rise) = (horner(poly, s), slope(poly, s) / pushes.step);
            for side in self.meetings[*contact]
                .sides
                .iter()
                .filter(|side| side.component == component)
            {
                for floor in 0..watch.floors {
                    let signal = &mut own[watch.acceleration(floor)];
                    signal.0 += side.accelerates[floor] * force;
                    signal.1 += side.jerks[floor] * force + side.accelerates[floor] * rise;
                }
            }
        }
        own
    }

    /// Takes values into the peaks.
    fn take(&mut self, component: usize, signals: &[(f64, f64)]) {
        let watch = &self.watch[component];
        for watched in &watch.buildings {
            let peaks = &mut self.peaks.buildings[watched.building];
            for floor in 0..watched.heights.len() {
                let global = watched.first_floor + floor;
                let u = signals[global].0;
                peaks.most[floor] = peaks.most[floor].max(u);
                peaks.least[floor] = peaks.least[floor].min(u);
                let drift = signals[watch.drift(global)].0.abs();
                peaks.drift[floor] = peaks.drift[floor].max(drift);
                let acceleration = signals[watch.acceleration(global)].0.abs();
                peaks.acceleration[floor] = peaks.acceleration[floor].max(acceleration);
            }
            let place = watch.shear(watched.building);
            peaks.shear = peaks.shear.max(signals[place].0.abs());
        }
    }

    /// Signals that may be greater between two instants than ever before, each with the lesser of its own peaks up and
    /// down.
    fn near(&self, component: usize, ends: [&[(f64, f64)]; 2], h: f64) -> Vec<(usize, f64)> {
        let watch = &self.watch[component];
        let mut near = Vec::new();
        let mut look = |place: usize, most: f64, least: f64| {
            let ((x0, v0), (x1, v1)) = (ends[0][place], ends[1][place]);
            let reach = 0.3 * h * (v0.abs() + v1.abs());
            if x0.max(x1) + reach > most {
                near.push((place, most));
            } else if x0.min(x1) - reach < least {
                near.push((place, -least));
            }
        };
        for watched in &watch.buildings {
            let peaks = &self.peaks.buildings[watched.building];
            for floor in 0..watched.heights.len() {
                let global = watched.first_floor + floor;
                look(global, peaks.most[floor], peaks.least[floor]);
                look(watch.drift(global), peaks.drift[floor], -peaks.drift[floor]);
                let a = peaks.acceleration[floor];
                look(watch.acceleration(global), a, -a);
            }
            look(watch.shear(watched.building), peaks.shear, -peaks.shear);
        }
        near
    }
}

/// Error of a cubic in the middle of a step from which on the step is halved, relative to the peak.
const ROUGH: f64 = 1e-6;

/// Top of the cubic between two values with slopes, as a share of the way and a value.
fn hermite_top(x0: f64, v0: f64, x1: f64, v1: f64, h: f64) -> Option<(f64, f64)> {
    if !(v0 > 0.0 && v1 < 0.0) {
        return None;
    }
    let (a, b) = (v0 * h, v1 * h);
    let d = x1 - x0;
    // x = x0 + a s + c s² + e s³.
    let (c, e) = (3.0 * d - 2.0 * a - b, a + b - 2.0 * d);
    let rate = |s: f64| a + s * (2.0 * c + s * 3.0 * e);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if rate(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some((low, x0 + low * (a + low * (c + low * e))))
}

/// q at the end of a step.
#[allow(clippy::too_many_arguments, reason = "the innermost loop")]
fn advance(
    q: c64,
    exp: c64,
    moment: &[c64; NODES],
    mode: usize,
    component: &Component,
    inputs: &[(&[c64], &Poly)],
    pushes: &Pushes,
    last: usize,
) -> c64 {
    let mut sum = exp * q;
    let ground = component.ground[mode];
    if inputs.is_empty() {
        let mut load = ZERO;
        for k in 0..=last {
            load += moment[k] * pushes.ground[k];
        }
        return sum + ground * load;
    }
    for k in 0..NODES {
        let mut load = ground * pushes.ground[k];
        for (push, poly) in inputs {
            load += push[mode] * poly[k];
        }
        sum += moment[k] * load;
    }
    sum
}

fn add_response(
    response: &mut Response,
    side: &Side,
    input: &[c64],
    moment: &[[[c64; NODES]; NODES]],
) {
    for j in 0..input.len() {
        let (x, v) = (side.row[j] * input[j], side.rate[j] * input[j]);
        for i in 1..NODES {
            for k in 0..NODES {
                let m = moment[j][i][k];
                response[0][i][k] += x.re * m.re - x.im * m.im;
                response[1][i][k] += v.re * m.re - v.im * m.im;
            }
        }
    }
}

impl Watch {
    fn of(system: &System, component: &Component) -> Self {
        let mut displacements = Vec::new();
        let mut constant = Vec::new();
        let mut buildings = Vec::new();
        let mut feet = Vec::new();
        let mut shears = Vec::new();
        for &index in &component.buildings {
            let building = &system.buildings[index];
            let rest = |dof: usize| {
                building
                    .rest
                    .displacement
                    .get(dof - building.offset)
                    .copied()
                    .unwrap_or(0.0)
            };
            buildings.push(Watched {
                building: index,
                first_floor: displacements.len(),
                heights: building.floors.iter().map(|f| f.storey_height).collect(),
                has_foot: building.foot.is_some(),
            });
            for floor in &building.floors {
                displacements.push(component.output(&[(floor.dof, 1.0)]));
                constant.push(rest(floor.dof));
            }
            if let Some(foot) = building.foot {
                feet.push((component.output(&[(foot, 1.0)]), rest(foot)));
            }
            let n = building.equations.len();
            let mut unit = vec![0.0; n];
            let mut weights = Vec::new();
            for dof in 0..n {
                unit[dof] = 1.0;
                let weight = building.equations.base_shear(&unit);
                unit[dof] = 0.0;
                if weight != 0.0 {
                    weights.push((building.offset + dof, weight));
                }
            }
            let sinks = if building.rest.displacement.is_empty() {
                0.0
            } else {
                building.equations.base_shear(&building.rest.displacement)
            };
            shears.push((component.output(&weights), sinks));
        }
        let floors = displacements.len();
        let times = |row: &[c64], power: i32| -> Vec<c64> {
            row.iter()
                .zip(&component.lambda)
                .map(|(c, l)| c * l.powi(power))
                .collect()
        };
        let mut rows = Vec::new();
        for row in &displacements {
            rows.push(row.clone());
            rows.push(times(row, 1));
        }
        for row in &displacements {
            rows.push(times(row, 2));
            rows.push(times(row, 3));
        }
        for (row, sinks) in &shears {
            rows.push(row.clone());
            rows.push(times(row, 1));
            constant.push(*sinks);
        }
        for (row, rest) in &feet {
            rows.push(row.clone());
            rows.push(times(row, 1));
            constant.push(*rest);
        }
        let jerk_by_ground = displacements
            .iter()
            .map(|row| {
                let terms = times(row, 2);
                terms
                    .iter()
                    .zip(&component.ground)
                    .map(|(c, b)| (c * b).re)
                    .sum()
            })
            .collect();
        Self {
            rows,
            jerk_by_ground,
            constant,
            buildings,
            floors,
        }
    }

    fn displacement(&self, floor: usize) -> &[c64] {
        &self.rows[2 * floor]
    }

    fn acceleration(&self, floor: usize) -> usize {
        self.floors + floor
    }

    fn drift(&self, floor: usize) -> usize {
        2 * self.floors + self.buildings.len() + floor
    }

    fn shear(&self, building: usize) -> usize {
        let own = self.buildings.iter().position(|b| b.building == building);
        2 * self.floors + own.unwrap_or(0)
    }

    fn len(&self) -> usize {
        3 * self.floors + self.buildings.len()
    }

    /// Displacements, total accelerations, base shears and drifts with their slopes, without forces of contacts.
    fn values(&self, q: &[c64], ground: f64) -> Vec<(f64, f64)> {
        let value = |row: usize| real_dot(&self.rows[row], q);
        let count = self.buildings.len();
        let mut all = Vec::with_capacity(self.len());
        for floor in 0..self.floors {
            all.push((
                value(2 * floor) + self.constant[floor],
                value(2 * floor + 1),
            ));
        }
        for floor in 0..self.floors {
            let place = 2 * (self.floors + floor);
            all.push((
                value(place),
                value(place + 1) + self.jerk_by_ground[floor] * ground,
            ));
        }
        for k in 0..count {
            let place = 2 * (2 * self.floors + k);
            all.push((
                value(place) + self.constant[self.floors + k],
                value(place + 1),
            ));
        }
        let mut foot = 0;
        for watched in &self.buildings {
            let mut below = (0.0, 0.0);
            if watched.has_foot {
                let place = 2 * (2 * self.floors + count + foot);
                below = (
                    value(place) + self.constant[self.floors + count + foot],
                    value(place + 1),
                );
                foot += 1;
            }
            for (floor, height) in watched.heights.iter().enumerate() {
                let now = all[watched.first_floor + floor];
                all.push(((now.0 - below.0) / height, (now.1 - below.1) / height));
                below = now;
            }
        }
        all
    }
}

const _: () = assert!(FACTORIAL.len() == NODES);
