//! Equilibrium path of a building from corner to corner, under a growing load or a prescribed displacement.

use std::sync::Arc;

use super::Settled;
use crate::hysteresis::{
    Flow, Hysteresis, HysteresisMemory, Side, SpaceFlow, SpaceSurface, Surface,
};
use crate::linear::{NotPositive, Row, StepMatrix};
use crate::stiffness::DirectStiffness;
use crate::structure::{AssembledBuilding, StepEquations, YieldingSpring};
use crate::transfer::riccati::RiccatiSweep;

/// Why a path ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PathError {
    /// The stiffness ahead is not positive: the building moves on without more load, or falls.
    #[error("the building gives way: {0}")]
    GivesWay(#[from] NotPositive),
    /// No consistent choice of loading and unloading springs was found.
    #[error("which hinges load and which unload could not be decided")]
    Undecided,
    /// There are more corners than a plausible model has.
    #[error("the path has more than {0} corners")]
    TooManyCorners(usize),
}

/// The end of a linear segment of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// Length of the segment, in units of the control variable.
    pub length: f64,
    /// Springs that reached a corner, in ascending order; empty if the segment had its full length.
    pub corners: Vec<usize>,
}

/// Equilibrium path of one building under p = p₀ + λ p₁ (theory, Eq. X1).
///
/// Either λ grows at rate one, or the displacement of one degree of freedom does, with any λ. So the path continues
/// beyond its peak, as long as the building is stable with that displacement restrained.
///
/// `E` solves the equations: the Riccati recursion, or direct stiffness where links join floors that are not neighbours.
#[derive(Debug)]
pub struct EquilibriumPath<E: StepEquations = RiccatiSweep> {
    /// Those of the building, then those of links between its floors.
    springs: Vec<PathSpring>,
    equations: E,
    factor: E::Factor,
    scratch: E::Scratch,
    /// Slopes in `factor`; empty before the first factorisation.
    tangents: Vec<f64>,
    /// Prescribed displacement, with the spring that restrains it while the equations are solved.
    driven: Option<(usize, f64)>,
    pattern: Vec<f64>,
    displacement: Vec<f64>,
    memories: Vec<HysteresisMemory>,
    load: f64,
    /// Slope of every spring for either direction.
    ahead: Vec<[f64; 2]>,
    sides: Vec<Side>,
    rates: Vec<f64>,
    load_rate: f64,
    spring_rates: Vec<f64>,
    /// Sections that yield on a surface.
    surfaces: Vec<PathSurface>,
    corners: usize,
}

/// A section that yields on a surface.
#[derive(Clone, Debug)]
struct PathSurface {
    /// The first of its rows among the springs.
    first: usize,
    law: PathLaw,
}

/// Its law, and how it gives.
#[derive(Clone, Debug)]
enum PathLaw {
    Plane(Surface, Flow),
    Space(Arc<SpaceSurface>, SpaceFlow),
}

impl PathSurface {
    /// All of a list of springs.
    fn all(springs: &[PathSpring]) -> Vec<Self> {
        let law = |first: usize| {
            if let Some(law) = &springs[first].surface {
                return Some(PathLaw::Space(law.clone(), SpaceFlow::ELASTIC));
            }
            let [x, y, between] = springs.get(first..first + 3)? else {
                return None;
            };
            let rows = [x, y, between].map(|row| &row.hysteresis);
            let law = Surface::of(rows).filter(|_| rows[0].starts_surface())?;
            Some(PathLaw::Plane(law, Flow::Elastic))
        };
        let surface = |first| {
            Some(Self {
                first,
                law: law(first)?,
            })
        };
        (0..springs.len()).filter_map(surface).collect()
    }

    /// What its points have of a list of all springs; two of three in a plane.
    fn points<'a, T>(&self, all: &'a [T]) -> [&'a T; 3] {
        [0, 1, 2].map(|point| &all[self.first + point])
    }

    /// Number of its points.
    fn count(&self) -> usize {
        match self.law {
            PathLaw::Plane(..) => 2,
            PathLaw::Space(..) => 3,
        }
    }

    /// Lets it be elastic.
    fn stiffen(&mut self) {
        match &mut self.law {
            PathLaw::Plane(_, flow) => *flow = Flow::Elastic,
            PathLaw::Space(_, flow) => *flow = SpaceFlow::ELASTIC,
        }
    }

    /// Lets it give as it does at these rates; whether that is another way.
    fn turn(&mut self, memories: &[HysteresisMemory], rates: &[f64]) -> bool {
        let (points, rates) = (self.points(memories), self.points(rates).map(|rate| *rate));
        match &mut self.law {
            PathLaw::Plane(law, flow) => {
                let [x, y, _] = points;
                let next = law.flow([x, y], [rates[0], rates[1]]);
                let turns = next != *flow;
                *flow = next;
                turns
            }
            PathLaw::Space(law, flow) => {
                let next = law.flow(points, rates);
                let turns = !next.is_as(flow);
                if turns {
                    *flow = next;
                }
                turns
            }
        }
    }

    /// Whether it stands on its surface.
    fn is_reached(&self, memories: &[HysteresisMemory]) -> bool {
        let points = self.points(memories);
        match &self.law {
            PathLaw::Plane(law, _) => law.is_reached([points[0], points[1]]),
            PathLaw::Space(law, _) => law.is_reached(points),
        }
    }

    /// Time until the next edge or plane.
    fn time(&self, memories: &[HysteresisMemory], rates: &[f64]) -> f64 {
        let (points, rates) = (self.points(memories), self.points(rates).map(|rate| *rate));
        match &self.law {
            PathLaw::Plane(law, flow) => {
                law.time_to_edge([points[0], points[1]], [rates[0], rates[1]], *flow)
            }
            PathLaw::Space(law, flow) => law.time_to_plane(points, rates, flow),
        }
    }

    /// Forces of its points at displacements.
    fn answer(&self, memories: &[HysteresisMemory], to: [f64; 3]) -> [f64; 3] {
        let points = self.points(memories);
        match &self.law {
            PathLaw::Plane(law, _) => {
                let [x, y] = law.answer([points[0], points[1]], [to[0], to[1]]).force;
                [x, y, 0.0]
            }
            PathLaw::Space(law, _) => law.answer(points, to).force,
        }
    }

    /// Writes its slopes into a list of all springs.
    fn lay_slopes(&self, ahead: &mut [[f64; 2]]) {
        let rows = ahead[self.first..].iter_mut();
        let lay = |(ahead, tangent): (&mut [f64; 2], f64)| *ahead = [tangent; 2];
        match &self.law {
            PathLaw::Plane(law, flow) => rows.zip(law.tangents(*flow)).for_each(lay),
            PathLaw::Space(law, flow) => rows.zip(law.tangents(flow)).for_each(lay),
        }
    }
}

/// A spring that yields.
#[derive(Clone, Debug)]
struct PathSpring {
    /// Its deformation.
    row: Row,
    hysteresis: Hysteresis,
    /// That of a section in space of which it is the first row.
    surface: Option<Arc<SpaceSurface>>,
}

impl From<&YieldingSpring> for PathSpring {
    fn from(spring: &YieldingSpring) -> Self {
        Self {
            row: spring.row.clone(),
            hysteresis: spring.hysteresis,
            surface: spring.surface.clone(),
        }
    }
}

/// Rates below this fraction of the greatest one count as zero.
const STILL: f64 = 1e-11;
/// Corners closer than this fraction of the yield deformation are reached together.
const TOGETHER: f64 = 1e-12;
/// Iterations in which all wrong directions are reversed at once.
const QUICK_CHOICES: usize = 12;

impl EquilibriumPath {
    /// From rest, λ growing from zero; `pattern` is p₁ \[N, N·m\].
    #[must_use]
    pub fn loaded(building: &AssembledBuilding, pattern: Vec<f64>) -> Self {
        let springs: Vec<PathSpring> = own_springs(building);
        let n = building.equations.len();
        let memories = vec![HysteresisMemory::default(); springs.len()];
        let rest = Settled {
            displacement: vec![0.0; n],
            springs: memories,
        };
        Self::new(RiccatiSweep::new(building), springs, pattern, rest, None)
    }

    /// From the building at rest, with one prescribed displacement; `pattern` is p₁ \[N, N·m\]. The prescribed
    /// displacement changes at rate one in the direction of p₁.
    #[must_use]
    pub fn driven(
        building: &AssembledBuilding,
        rest: &Settled,
        pattern: Vec<f64>,
        dof: usize,
    ) -> Self {
        let hold = holding(building, dof);
        // The restraining spring is the last of the list.
        let mut held = building.clone();
        held.equations.springs.extend(holding_spring(dof, hold));
        let sweep = RiccatiSweep::new(&held);
        let springs = own_springs(building);
        Self::new(sweep, springs, pattern, rest.clone(), Some((dof, hold)))
    }
}

impl EquilibriumPath<DirectStiffness> {
    /// The same for a building with links between its floors, which are free of force at rest.
    #[must_use]
    pub fn driven_with_links(
        building: &AssembledBuilding,
        rest: &Settled,
        pattern: Vec<f64>,
        dof: usize,
    ) -> Self {
        let hold = holding(building, dof);
        let links = building.inner_links.iter().filter_map(|link| {
            Some(PathSpring {
                row: link.shortening.clone(),
                hysteresis: link.spring?,
                surface: None,
            })
        });
        let links: Vec<PathSpring> = links.collect();
        let rows = links.iter().map(|link| link.row.clone());
        let rows: Vec<_> = rows.chain([Row::single(dof)]).collect();
        let equations = DirectStiffness::with_rows(building, &rows);
        let springs = own_springs(building).into_iter().chain(links).collect();
        Self::new(equations, springs, pattern, rest.clone(), Some((dof, hold)))
    }
}

impl<E: StepEquations> EquilibriumPath<E> {
    fn new(
        equations: E,
        springs: Vec<PathSpring>,
        pattern: Vec<f64>,
        rest: Settled,
        driven: Option<(usize, f64)>,
    ) -> Self {
        let (mut displacement, mut memories) = (rest.displacement, rest.springs);
        displacement.resize(pattern.len(), 0.0);
        memories.resize(springs.len(), HysteresisMemory::default());
        let count = springs.len();
        Self {
            equations,
            factor: E::Factor::default(),
            scratch: E::Scratch::default(),
            tangents: Vec::new(),
            driven,
            rates: vec![0.0; displacement.len()],
            pattern,
            displacement,
            memories,
            load: 0.0,
            ahead: vec![[0.0; 2]; count],
            sides: vec![Side::Positive; count],
            load_rate: 0.0,
            spring_rates: vec![0.0; count],
            surfaces: PathSurface::all(&springs),
            springs,
            corners: 0,
        }
    }

    /// Whether a spring is a row of a section that stands on its surface.
    #[must_use]
    pub fn is_on_surface(&self, spring: usize) -> bool {
        let mut surfaces = self.surfaces.iter();
        let surface = surfaces.find(|surface| surface.first == spring);
        surface.is_some_and(|surface| surface.is_reached(&self.memories))
    }

    /// λ now.
    #[must_use]
    pub fn load(&self) -> f64 {
        self.load
    }

    /// dλ along the segment ahead.
    #[must_use]
    pub fn load_rate(&self) -> f64 {
        self.load_rate
    }

    /// Displacement of every degree of freedom \[m, rad\].
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// State of every spring.
    #[must_use]
    pub fn memories(&self) -> &[HysteresisMemory] {
        &self.memories
    }

    /// The same, for strengths that change between segments.
    pub(crate) fn memories_mut(&mut self) -> &mut [HysteresisMemory] {
        &mut self.memories
    }

    /// Computes the rates from here (theory, Eqs. X2 and X3), with every spring on the line of its direction.
    ///
    /// # Errors
    /// [`PathError::GivesWay`] or [`PathError::Undecided`].
    pub fn find_rates(&mut self) -> Result<(), PathError> {
        let springs = self.springs.iter().zip(&self.memories);
        for ((spring, memory), ahead) in springs.zip(&mut self.ahead) {
            *ahead = Side::BOTH.map(|side| slope_ahead(&spring.hysteresis, memory, side));
        }
        for surface in &self.surfaces {
            surface.lay_slopes(&mut self.ahead);
        }
        let most = QUICK_CHOICES + 4 * self.sides.len() + 16 * (1 + self.surfaces.len());
        let mut stiffened = false;
        for choice in 0..most {
            if let Err(problem) = self.factorize() {
                if stiffened {
                    return Err(problem.into());
                }
                // Possibly only this choice is unstable: restart with the stiffest.
                stiffened = true;
                for (side, ahead) in self.sides.iter_mut().zip(&self.ahead) {
                    *side = if ahead[0] >= ahead[1] {
                        Side::Positive
                    } else {
                        Side::Negative
                    };
                }
                for surface in &mut self.surfaces {
                    surface.stiffen();
                    surface.lay_slopes(&mut self.ahead);
                }
                self.factorize()?;
            }
            self.solve();
            let fastest = self
                .spring_rates
                .iter()
                .fold(0.0_f64, |most, rate| most.max(rate.abs()));
            let mut settled = true;
            // What falls is reversed before what it lets unload.
            if stiffened && self.let_one_fall(fastest) {
                continue;
            }
            for ((side, ahead), rate) in self
                .sides
                .iter_mut()
                .zip(&self.ahead)
                .zip(&self.spring_rates)
            {
                let moves = rate.abs() > STILL * fastest;
                if moves && Side::from_change(*rate) != *side {
                    *side = side.opposite();
                    if ahead[0] != ahead[1] {
                        settled = false;
                        // Reversing one at a time, the one with the lowest index first, cannot cycle (Murty, 1974).
                        if stiffened || choice > QUICK_CHOICES {
                            break;
                        }
                    }
                }
            }
            for surface in &mut self.surfaces {
                let one_by_one = stiffened || choice > QUICK_CHOICES;
                if one_by_one && !settled {
                    break;
                }
                let rates = surface.points(&self.spring_rates);
                let mut rates = rates.into_iter().take(surface.count());
                let moves = rates.any(|rate| rate.abs() > STILL * fastest);
                if moves && surface.turn(&self.memories, &self.spring_rates) {
                    surface.lay_slopes(&mut self.ahead);
                    settled = false;
                }
            }
            if settled {
                return Ok(());
            }
        }
        Err(PathError::Undecided)
    }

    /// Reverses the first spring that moves towards a falling line and stands on the other side; false if there is none.
    fn let_one_fall(&mut self, fastest: f64) -> bool {
        let springs = self.sides.iter_mut().zip(&self.ahead);
        for ((side, ahead), rate) in springs.zip(&self.spring_rates) {
            let towards = Side::from_change(*rate);
            let moves = rate.abs() > STILL * fastest;
            if moves && towards != *side && ahead[towards.index()] < 0.0 {
                *side = towards;
                return true;
            }
        }
        false
    }

    /// Continues to the next corner, at most by `most` in units of the control variable. Call [`EquilibriumPath::find_rates`]
    /// first.
    ///
    /// # Errors
    /// [`PathError::TooManyCorners`].
    pub fn advance(&mut self, most: f64) -> Result<Reached, PathError> {
        let mut length = most;
        for ((spring, memory), rate) in self
            .springs
            .iter()
            .zip(&self.memories)
            .zip(&self.spring_rates)
        {
            if *rate != 0.0 {
                let corner = spring
                    .hysteresis
                    .next_corner(memory, Side::from_change(*rate));
                length = length.min(((corner - memory.deformation()) / rate).max(0.0));
            }
        }
        for surface in &self.surfaces {
            length = length.min(surface.time(&self.memories, &self.spring_rates));
        }
        let mut corners = Vec::new();
        for surface in &self.surfaces {
            let hits = length >= surface.time(&self.memories, &self.spring_rates);
            let stood = surface.is_reached(&self.memories);
            let points = surface.points(&self.memories);
            let rates = surface.points(&self.spring_rates);
            let to = [0, 1, 2].map(|point| points[point].deformation() + length * rates[point]);
            let force = surface.answer(&self.memories, to);
            for (point, row) in (surface.first..).take(surface.count()).enumerate() {
                let law = &self.springs[row].hysteresis;
                law.commit(&mut self.memories[row], to[point], force[point]);
            }
            // Those that come as near as none at all with another are on theirs as well.
            if hits || (!stood && surface.is_reached(&self.memories)) {
                corners.push(surface.first);
            }
        }
        let springs = self.springs.iter().zip(&mut self.memories);
        for (index, ((spring, memory), rate)) in springs.zip(&self.spring_rates).enumerate() {
            if *rate == 0.0 || spring.hysteresis.is_on_surface() {
                continue;
            }
            let side = Side::from_change(*rate);
            let corner = spring.hysteresis.next_corner(memory, side);
            let mut reached = memory.deformation() + length * rate;
            let window = TOGETHER * spring.hysteresis.backbone().side(side).yielding.deformation;
            if side.sign() * (reached - corner) >= -window {
                reached = corner;
                corners.push(index);
            }
            *memory = spring.hysteresis.respond(memory, reached).memory;
        }
        for (value, rate) in self.displacement.iter_mut().zip(&self.rates) {
            *value += length * rate;
        }
        self.load += length * self.load_rate;
        corners.sort_unstable();
        self.corners += corners.len();
        let bound = 1000 + 100 * self.memories.len();
        if self.corners > bound {
            return Err(PathError::TooManyCorners(bound));
        }
        Ok(Reached { length, corners })
    }

    /// Factorises for the slopes of the present directions, updating only changed parts.
    fn factorize(&mut self) -> Result<(), NotPositive> {
        let slopes = self.ahead.iter().zip(&self.sides);
        let hold = self.driven.map(|(_, hold)| hold);
        let wanted: Vec<f64> = slopes
            .map(|(ahead, side)| ahead[side.index()])
            .chain(hold)
            .collect();
        let changed: Vec<usize> = (0..wanted.len())
            .filter(|&spring| self.tangents.get(spring) != Some(&wanted[spring]))
            .collect();
        let done = if self.tangents.is_empty() {
            self.equations
                .factorize(&StepMatrix::STATIC, &wanted, &mut self.factor)
        } else if changed.is_empty() {
            Ok(())
        } else {
            self.equations
                .update(&StepMatrix::STATIC, &wanted, &changed, &mut self.factor)
        };
        self.tangents = if done.is_ok() { wanted } else { Vec::new() };
        done
    }

    /// Rates for the factorised slopes.
    fn solve(&mut self) {
        self.rates.copy_from_slice(&self.pattern);
        self.equations
            .solve(&self.factor, &mut self.rates, &mut self.scratch);
        self.load_rate = 1.0;
        if let Some((dof, hold)) = self.driven {
            // K + k e eᵀ is regular where K is not; k e is the load of the spring with the prescribed end.
            let sign = self.pattern_sign();
            let mut held = vec![0.0; self.rates.len()];
            held[dof] = sign * hold;
            self.equations
                .solve(&self.factor, &mut held, &mut self.scratch);
            self.load_rate = (sign - held[dof]) / self.rates[dof];
            for (rate, held) in self.rates.iter_mut().zip(&held) {
                *rate = self.load_rate * *rate + held;
            }
        }
        let springs = self.springs.iter();
        for (rate, spring) in self.spring_rates.iter_mut().zip(springs) {
            *rate = spring.row.value(&self.rates);
        }
    }

    /// Direction of the prescribed displacement.
    fn pattern_sign(&self) -> f64 {
        let sum: f64 = self.pattern.iter().sum();
        if sum < 0.0 { -1.0 } else { 1.0 }
    }
}

fn own_springs(building: &AssembledBuilding) -> Vec<PathSpring> {
    building
        .equations
        .springs
        .iter()
        .map(PathSpring::from)
        .collect()
}

/// Stiffness of a spring that restrains a displacement while the equations are solved: that of what is joined there.
fn holding(building: &AssembledBuilding, dof: usize) -> f64 {
    let equations = &building.equations;
    let hold = equations.stiffness.diagonal[dof] + equations.undamped.diagonal[dof].abs();
    let springs = equations.springs.iter();
    let yielding: f64 = springs
        .filter(|spring| spring.row.dofs().any(|candidate| candidate == dof))
        .map(|spring| spring.hysteresis.initial_tangent())
        .sum();
    hold + yielding
}

/// An elastic spring to the ground.
fn holding_spring(dof: usize, stiffness: f64) -> Option<YieldingSpring> {
    Some(YieldingSpring {
        row: Row::single(dof),
        hysteresis: Hysteresis::elastic(stiffness).ok()?,
        damped_by_tangent: false,
        in_base_shear: 0.0,
        surface: None,
    })
}

/// Slope of the line of a spring in a direction.
fn slope_ahead(hysteresis: &Hysteresis, memory: &HysteresisMemory, side: Side) -> f64 {
    let here = memory.deformation();
    let corner = hysteresis.next_corner(memory, side);
    let on_line = if corner.is_finite() {
        0.5 * (here + corner)
    } else {
        here + side.sign() * hysteresis.backbone().side(side).yielding.deformation
    };
    let on_line = if on_line == here { corner } else { on_line };
    hysteresis.respond(memory, on_line).tangent
}
