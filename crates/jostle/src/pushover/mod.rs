//! Pushover of a building to a target drift or loss of strength.

mod bilinear;
mod equivalent;
mod pattern;

pub use bilinear::Bilinear;
pub use equivalent::EquivalentOscillator;
pub use pattern::LoadPattern;

use std::collections::BTreeSet;

use crate::hysteresis::{Hysteresis, HysteresisMemory, HysteresisRule, Side, Stage};
use crate::statics::{EquilibriumPath, PathError, STANDARD_GRAVITY};
use crate::structure::{InnerLink, StepEquations, YieldingSpring};
use crate::system::BuildingSystem;

/// Direction of the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum PushDirection {
    /// In positive direction.
    #[default]
    Right,
    /// In negative direction.
    Left,
}

impl PushDirection {
    /// Name on the command line and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }

    /// +1 or −1 \[–\].
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Right => 1.0,
            Self::Left => -1.0,
        }
    }
}

/// Settings of a pushover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PushSettings {
    /// Shape of the load.
    pub pattern: LoadPattern,
    /// Direction.
    pub direction: PushDirection,
    /// Roof displacement over the height of the roof at which to stop, > 0 \[–\].
    pub drift: f64,
}

impl Default for PushSettings {
    fn default() -> Self {
        Self {
            pattern: LoadPattern::default(),
            direction: PushDirection::default(),
            drift: 0.02,
        }
    }
}

/// Event of a spring at a point of the curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PushEvent {
    /// Index in [`crate::structure::Equations::springs`]; beyond these, links between floors that have a spring.
    pub spring: usize,
    /// What.
    pub kind: PushEventKind,
}

/// A corner of a spring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PushEventKind {
    /// It cracks for the first time.
    Cracks,
    /// It yields for the first time.
    Yields,
    /// A brace buckles before it has yielded.
    Buckles,
    /// A column fails in shear.
    Fails,
    /// The clearance of a stop, a stopper or a cable is used up.
    Closes,
    /// Another corner, passed when reloading.
    Turns,
}

impl PushEventKind {
    /// Whether a spring leaves its elastic range for good: it yields, or buckles.
    #[must_use]
    pub fn is_yield(self) -> bool {
        matches!(self, Self::Yields | Self::Buckles)
    }

    /// Name in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cracks => "cracks",
            Self::Yields => "yields",
            Self::Buckles => "buckles",
            Self::Fails => "fails",
            Self::Closes => "closes",
            Self::Turns => "corner",
        }
    }
}

/// A corner of the capacity curve; between corners it is linear.
///
/// Displacements are relative to the state under gravity. They and the base shear are positive in the direction of
/// the load.
#[derive(Clone, Debug, PartialEq)]
pub struct PushPoint {
    /// Roof displacement \[m\].
    pub roof: f64,
    /// Base shear: the sum of the load \[N\].
    pub base_shear: f64,
    /// Displacement of every floor from the ground up \[m\].
    pub floors: Vec<f64>,
    /// Drift of every storey from the ground up \[–\].
    pub storey_drifts: Vec<f64>,
    /// Events here; at the first point, those due to gravity.
    pub events: Vec<PushEvent>,
    /// Displacement of every degree of freedom, gravity included, positive to the right and upwards \[m, rad\].
    pub displacement: Vec<f64>,
}

/// Why a pushover ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PushEnd {
    /// The target drift was reached.
    Target,
    /// P-Delta exceeds the resistance: the building is unstable without lateral load.
    NoResistance,
    /// The stiffness ahead is not positive even with the roof restrained: a mechanism that the roof does not
    /// control. The storey with the largest drift.
    Mechanism {
        /// Storey from 1.
        storey: usize,
    },
    /// Another reason.
    Failed(PathError),
}

impl std::fmt::Display for PushEnd {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Target => formatter.write_str("the wanted drift was reached"),
            Self::NoResistance => formatter.write_str(
                "P-Delta equals the remaining resistance: beyond this point the building collapses under its own weight",
            ),
            Self::Mechanism { storey } => write!(
                formatter,
                "a mechanism formed that gives way even with the roof held; storey {storey} drifts most"
            ),
            Self::Failed(problem) => write!(formatter, "{problem}"),
        }
    }
}

/// Capacity curve of one building.
#[derive(Clone, Debug, PartialEq)]
pub struct Pushover {
    /// Settings of the pushover.
    pub settings: PushSettings,
    /// Height of the roof above the base \[m\].
    pub height: f64,
    /// Weight above the base \[N\].
    pub weight: f64,
    /// Horizontal forces of sum one at the floors, from the ground up \[–\].
    pub floor_loads: Vec<f64>,
    /// Corners of the curve, from rest on.
    pub points: Vec<PushPoint>,
    /// Why it ended.
    pub end: PushEnd,
}

impl Pushover {
    /// First point at which a spring cracks or yields; a spring without cracking point cracks when it yields, and a brace
    /// that buckles yields. The
    /// initial point if gravity alone causes it.
    #[must_use]
    pub fn first(&self, stage: Stage) -> Option<&PushPoint> {
        self.points.iter().find(|point| {
            point.events.iter().any(|event| match stage {
                Stage::Uncracked => false,
                Stage::Cracked => event.kind == PushEventKind::Cracks || event.kind.is_yield(),
                Stage::Yielded | Stage::Buckled => event.kind.is_yield(),
                Stage::Gone => false,
            })
        })
    }

    /// Base shear over weight \[–\].
    #[must_use]
    pub fn coefficient(&self, point: &PushPoint) -> f64 {
        point.base_shear / self.weight
    }

    /// Roof displacement over height \[–\].
    #[must_use]
    pub fn drift(&self, point: &PushPoint) -> f64 {
        point.roof / self.height
    }

    /// Number of springs that have cracked, yielded ones included, and of those that have yielded, at the end.
    #[must_use]
    pub fn counts(&self, springs: usize) -> [usize; 2] {
        let stages = self.stages(springs, self.points.len());
        [Stage::Cracked, Stage::Yielded]
            .map(|least| stages.iter().filter(|stage| **stage >= least).count())
    }

    /// Number of links between floors that have yielded at the end; `springs` of the building
    /// stand before them.
    #[must_use]
    pub fn links_yielded(&self, springs: usize) -> usize {
        let events = self.points.iter().flat_map(|point| &point.events);
        let yielded = events.filter(|event| event.kind == PushEventKind::Yields);
        let links = yielded.filter_map(|event| event.spring.checked_sub(springs));
        links.collect::<BTreeSet<usize>>().len()
    }

    /// Number of shear springs of columns that fail, up to the end.
    #[must_use]
    pub fn failures(&self) -> usize {
        let events = self.points.iter().flat_map(|point| &point.events);
        events
            .filter(|event| event.kind == PushEventKind::Fails)
            .count()
    }

    /// Point of the greatest base shear.
    #[must_use]
    pub fn peak(&self) -> &PushPoint {
        let mut peak = &self.points[0];
        for point in &self.points {
            if point.base_shear > peak.base_shear * (1.0 + 1e-12) {
                peak = point;
            }
        }
        peak
    }

    /// Stage of every spring at a point.
    #[must_use]
    pub fn stages(&self, springs: usize, point: usize) -> Vec<Stage> {
        let mut stages = vec![Stage::Uncracked; springs];
        for event in self
            .points
            .iter()
            .take(point + 1)
            .flat_map(|point| &point.events)
        {
            let stage = match event.kind {
                PushEventKind::Cracks => Stage::Cracked,
                PushEventKind::Yields => Stage::Yielded,
                PushEventKind::Buckles => Stage::Buckled,
                PushEventKind::Turns | PushEventKind::Fails | PushEventKind::Closes => continue,
            };
            // Links beyond the springs of the building.
            if let Some(highest) = stages.get_mut(event.spring) {
                *highest = stage.max(*highest);
            }
        }
        stages
    }
}

/// A building with its capacity curves, as results and reports need them.
#[derive(Clone, Debug)]
pub struct PushedBuilding<'a> {
    /// The building.
    pub building: &'a BuildingSystem,
    /// One curve per direction.
    pub curves: Vec<Pushover>,
}

impl PushedBuilding<'_> {
    /// Number of links between floors that resist.
    #[must_use]
    pub fn links(&self) -> usize {
        links(self.building).count()
    }

    /// Number of springs and sections that can crack or yield: all but struts without a strength.
    #[must_use]
    pub fn yielding_places(&self) -> usize {
        let equations = &self.building.equations;
        let elastic = equations.springs.iter().filter(|spring| {
            let rule = spring.hysteresis.rule();
            matches!(rule, HysteresisRule::Stop { clearance, .. } if clearance == 0.0)
        });
        equations.yielding_places() - elastic.count()
    }

    /// Whether nothing in it has a corner, so that its curve is a straight line.
    #[must_use]
    pub fn is_elastic(&self) -> bool {
        let bends = |spring: Hysteresis| {
            let reach = |side| spring.next_corner(&HysteresisMemory::default(), side);
            Side::BOTH.into_iter().any(|side| reach(side).is_finite())
        };
        let links = links(self.building).any(|(_, spring)| bends(spring));
        self.building.equations.springs.is_empty() && !links
    }

    /// Position of a spring as text.
    #[must_use]
    pub fn place(&self, spring: usize) -> String {
        let places = &self.building.discretization.spring_places;
        let named = places.get(spring).map(ToString::to_string);
        let link = || {
            let link = spring - self.building.equations.springs.len();
            links(self.building).nth(link).map(|(link, _)| link.place())
        };
        let named = named.or_else(link);
        named.unwrap_or_else(|| format!("spring {}", spring + 1))
    }
}

/// Reason why a pushover is not possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CannotPush {
    /// No load, or no resistance.
    #[error("the building has no floor with mass to push, or moves without resistance")]
    Nothing,
    /// The path of equilibrium goes from corner to corner of the springs; forces that follow the direction of sliding have none.
    #[error(
        "bearings under a building with a plan that yield or slide in every direction, and their ring stop, have no pushover; remove isolation to push the building fixed on its mat, or take kind = \"linear\" without stop"
    )]
    BearingsInPlan,
}

/// Runs a pushover of a building from rest, under self weight if included, with prescribed roof displacement
/// (theory, Eqs. X1 to X4).
///
/// # Errors
/// [`CannotPush`].
pub fn pushover(building: &BuildingSystem, settings: PushSettings) -> Result<Pushover, CannotPush> {
    let equations = &building.equations;
    let circular = |spring: &YieldingSpring| spring.hysteresis.circular().is_some();
    if equations.springs.iter().any(circular) {
        return Err(CannotPush::BearingsInPlan);
    }
    if let Some(alone) = building.without_neighbours() {
        return pushover(&alone, settings);
    }
    let forces = settings
        .pattern
        .forces(building)
        .ok_or(CannotPush::Nothing)?;
    let sign = settings.direction.sign();
    let roof = building.floors.last().ok_or(CannotPush::Nothing)?;
    let driven = roof.dof - building.offset;
    let pattern: Vec<f64> = forces.iter().map(|force| sign * force).collect();
    let target = settings.drift * roof.height;
    let rest = &building.rest;
    let (points, end) = if links(building).next().is_some() {
        let path = EquilibriumPath::driven_with_links(building, rest, pattern, driven);
        Push::along(building, sign, path, target)
    } else {
        let path = EquilibriumPath::driven(building, rest, pattern, driven);
        Push::along(building, sign, path, target)
    };
    Ok(Pushover {
        settings,
        height: roof.height,
        weight: STANDARD_GRAVITY * mass_above_base(building),
        floor_loads: floor_loads(building, &forces),
        points,
        end,
    })
}

/// Links between floors that resist a pushover, with their springs.
fn links(building: &BuildingSystem) -> impl Iterator<Item = (&InnerLink, Hysteresis)> {
    let links = building.inner_links.iter();
    links.filter_map(|link| Some((link, link.spring?)))
}

/// Part of the target in which strengths that fall with ductility follow it \[–\].
const WEAKENING_PART: f64 = 1.0 / 400.0;

/// State of a pushover.
struct Push<'a, E: StepEquations> {
    building: &'a BuildingSystem,
    sign: f64,
    walk: EquilibriumPath<E>,
    /// Of the springs of the building, then of links.
    springs: Vec<Hysteresis>,
    stages: Vec<Stage>,
    points: Vec<PushPoint>,
}

impl<'a, E: StepEquations> Push<'a, E> {
    /// The points of the curve up to a target of the roof \[m\], and why it ended.
    fn along(
        building: &'a BuildingSystem,
        sign: f64,
        walk: EquilibriumPath<E>,
        target: f64,
    ) -> (Vec<PushPoint>, PushEnd) {
        let yielding = building.equations.springs.iter();
        let hysteresis = yielding.map(|spring| spring.hysteresis);
        let springs: Vec<Hysteresis> = hysteresis
            .chain(links(building).map(|(_, spring)| spring))
            .collect();
        let all: Vec<usize> = (0..springs.len()).collect();
        let mut push = Self {
            building,
            sign,
            walk,
            stages: vec![Stage::Uncracked; springs.len()],
            springs,
            points: Vec::new(),
        };
        let events = push.events_of(&all, false);
        push.note(0.0, events);
        let end = push.go(target);
        (push.points, end)
    }

    fn go(&mut self, target: f64) -> PushEnd {
        let mut roof = 0.0;
        loop {
            match self.walk.find_rates() {
                Ok(()) => {}
                Err(PathError::GivesWay(_)) => {
                    return PushEnd::Mechanism {
                        storey: self.softest_storey(),
                    };
                }
                Err(problem) => return PushEnd::Failed(problem),
            }
            let left = target - roof;
            let falling = self.walk.load_rate() < 0.0;
            let to_zero = if falling && self.walk.load() > 0.0 {
                -self.walk.load() / self.walk.load_rate()
            } else {
                f64::INFINITY
            };
            let mut most = left.min(to_zero);
            // Strengths that fall with ductility follow it in small parts.
            let whole = most;
            if !self.building.weakening.is_empty() {
                most = most.min(target * WEAKENING_PART);
            }
            let reached = match self.walk.advance(most) {
                Ok(reached) => reached,
                Err(problem) => return PushEnd::Failed(problem),
            };
            self.building.weaken(self.walk.memories_mut());
            roof += reached.length;
            let ends = reached.length >= most && most == whole;
            if ends && most == left {
                roof = target;
            }
            let mut events = self.events_of(&reached.corners, true);
            events.extend(self.overtaken());
            // Events within rounding count as simultaneous.
            match self.points.last_mut() {
                Some(last) if !ends && reached.length <= 1e-12 * target => {
                    last.events.extend(events);
                }
                _ => self.note(roof, events),
            }
            if ends {
                return if most == left {
                    PushEnd::Target
                } else {
                    PushEnd::NoResistance
                };
            }
        }
    }

    /// Meaning of the corners of springs.
    fn events_of(&mut self, corners: &[usize], turns: bool) -> Vec<PushEvent> {
        let mut events = Vec::new();
        for &spring in corners {
            let stage = self.stage_reached(spring, &self.walk.memories()[spring]);
            let kind = match stage {
                Stage::Yielded if self.stages[spring] < stage => match self.falls(spring) {
                    true => PushEventKind::Fails,
                    false if self.stops(spring) => PushEventKind::Closes,
                    false if self.buckles(spring) => PushEventKind::Buckles,
                    false => PushEventKind::Yields,
                },
                Stage::Cracked if self.stages[spring] < stage => PushEventKind::Cracks,
                _ if turns => PushEventKind::Turns,
                _ => continue,
            };
            self.stages[spring] = self.stages[spring].max(stage);
            events.push(PushEvent { spring, kind });
        }
        events
    }

    /// Whether a spring is a brace that has reached its buckling force.
    fn buckles(&self, spring: usize) -> bool {
        let (law, memory) = (&self.springs[spring], &self.walk.memories()[spring]);
        let buckling = law.backbone().side(Side::Negative).yielding.deformation;
        matches!(law.rule(), HysteresisRule::Buckling(_))
            && memory.greatest(Side::Negative) >= buckling
    }

    /// Whether a spring loses its strength.
    fn falls(&self, spring: usize) -> bool {
        self.springs[spring].falling_branch().is_some()
    }

    /// Whether a spring is elastic behind a clearance.
    fn stops(&self, spring: usize) -> bool {
        matches!(self.springs[spring].rule(), HysteresisRule::Stop { .. })
    }

    /// Springs whose strength has fallen to the force that they bear.
    fn overtaken(&mut self) -> Vec<PushEvent> {
        if self.building.weakening.is_empty() {
            return Vec::new();
        }
        let known = self.springs.iter().zip(self.walk.memories()).enumerate();
        let weaker = known.filter_map(|(index, (spring, memory))| {
            let [failure, _] = spring.failure_corners(memory)?;
            let bears = memory.force().abs() * (1.0 + 1e-12) >= failure.force;
            (bears && self.stages[index] < Stage::Yielded).then_some(index)
        });
        let weaker: Vec<usize> = weaker.collect();
        let fails = |spring: usize| {
            self.stages[spring] = Stage::Yielded;
            PushEvent {
                spring,
                kind: PushEventKind::Fails,
            }
        };
        weaker.into_iter().map(fails).collect()
    }

    /// A spring on its corner counts as beyond it.
    fn stage_reached(&self, spring: usize, memory: &HysteresisMemory) -> Stage {
        let hysteresis = &self.springs[spring];
        if self.walk.is_on_surface(spring) {
            return Stage::Yielded;
        }
        if self.falls(spring) {
            return hysteresis.stage(memory);
        }
        if let HysteresisRule::Stop { side, clearance } = hysteresis.rule() {
            // A strut without tension stands at its stop from the start.
            let is_closed = clearance > 0.0 && side.sign() * memory.deformation() >= clearance;
            return if is_closed {
                Stage::Yielded
            } else {
                Stage::Uncracked
            };
        }
        let stages = Side::BOTH.map(|side| {
            let (curve, greatest) = (hysteresis.backbone().side(side), memory.greatest(side));
            if greatest >= curve.yielding.deformation {
                Stage::Yielded
            } else if greatest >= curve.cracking.deformation {
                Stage::Cracked
            } else {
                Stage::Uncracked
            }
        });
        // Struts have a corner in compression alone, as have concrete and ground, where it is neither a crack nor yield of a member.
        let is_strut = !matches!(
            hysteresis.rule(),
            HysteresisRule::Concrete(_) | HysteresisRule::Ground
        );
        let has_corner = |side: &Side| {
            let corner = hysteresis.next_corner(&HysteresisMemory::default(), *side);
            corner.is_finite()
        };
        if !(has_corner(&Side::Positive) || is_strut && has_corner(&Side::Negative)) {
            return Stage::Uncracked;
        }
        stages[0].max(stages[1])
    }

    fn note(&mut self, roof: f64, events: Vec<PushEvent>) {
        let building = self.building;
        let displacement = self.walk.displacement().to_vec();
        let from_rest = |dof: usize| {
            let rest = building.rest.displacement.get(dof).copied().unwrap_or(0.0);
            self.sign * (displacement[dof] - rest)
        };
        let floors: Vec<f64> = building
            .floors
            .iter()
            .map(|floor| from_rest(floor.dof - building.offset))
            .collect();
        let moved: Vec<f64> = (0..displacement.len()).map(from_rest).collect();
        let storeys = building.storey_drifts(&moved).into_iter();
        let storey_drifts = storeys.map(|[along, _]| along).collect();
        self.points.push(PushPoint {
            roof,
            base_shear: self.walk.load(),
            floors,
            storey_drifts,
            events,
            displacement,
        });
    }

    fn softest_storey(&self) -> usize {
        let drifts = self
            .points
            .last()
            .map_or(&[][..], |point| &point.storey_drifts);
        let worst = drifts.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        worst.map_or(1, |(storey, _)| storey + 1)
    }
}

/// Mass of the nodes above the base \[kg\].
fn mass_above_base(building: &BuildingSystem) -> f64 {
    let nodes = building.discretization.stick_model.nodes.iter();
    nodes
        .filter(|node| node.y > 0.0)
        .map(|node| node.mass)
        .sum()
}

/// Load shares of the floors, from the ground up.
fn floor_loads(building: &BuildingSystem, forces: &[f64]) -> Vec<f64> {
    let nodes = &building.discretization.stick_model.nodes;
    let mut loads = vec![0.0; building.floors.len()];
    let mut counted = vec![false; forces.len()];
    for (index, node) in nodes.iter().enumerate() {
        let Some(dof) = building.equations.horizontal(index) else {
            continue;
        };
        if std::mem::replace(&mut counted[dof], true) {
            continue;
        }
        let nearest = building.floors.iter().enumerate().min_by(|a, b| {
            let away = |floor: &crate::system::Floor| (floor.height - node.y).abs();
            away(a.1).total_cmp(&away(b.1))
        });
        if let Some((floor, _)) = nearest {
            loads[floor] += forces[dof];
        }
    }
    loads
}
