//! Seismic isolation: a mat on bearings under a building.

use super::STANDARD_GRAVITY;
use crate::hysteresis::{
    Backbone, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Side, SlidingStage,
};

/// Bearings under a building, and the mat between them and the building. The mat moves sideways only; it is floor 0 of the
/// building for gaps and links.
///
/// Rayleigh damping of an isolated building acts on motion relative to the mat, so it does not damp the bearings
/// (J. F. Hall, 2006, Earthquake Eng. Struct. Dyn. 35, 525–545; K. L. Ryan and J. Polanco, 2008, J. Struct. Eng. 134, 1780–1784).
///
/// ```
/// use jostle::{Base, Isolation, Isolator};
///
/// let isolator = Isolator::LeadRubber { stiffness: 42e6, yield_force: 400e3, post_yield: 0.1 };
/// let base = Base { isolation: Some(Isolation::new(isolator, 150e3)), ..Base::default() };
/// assert!(!base.is_fixed());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isolation {
    /// All bearings together.
    pub isolator: Isolator,
    /// Mass of the mat, > 0 \[kg\].
    pub mat_mass: f64,
    /// Dashpot beside the bearings.
    pub damping: IsolatorDamping,
    /// Elastic stops on the left and on the right.
    pub stops: [Option<Stop>; 2],
    /// Displacement that the bearings allow, > 0; a run that exceeds it warns \[m\].
    pub limit: Option<f64>,
    /// Weight on the bearings, > 0; `None` is the mass of building and mat times g = 9.80665 m/s² \[N\].
    pub weight: Option<f64>,
    /// Range of their properties; `None` if it is not stated.
    pub bounds: Option<BearingBounds>,
}

/// Factors on the properties of bearings, for ageing, temperature, first cycles and manufacture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingFactors {
    /// On the stiffness of rubber, > 0; 1 for pendulums, whose stiffness N/R is that of their surface \[–\].
    pub stiffness: f64,
    /// On the yield force of the lead, or on friction, > 0; 1 for linear bearings \[–\].
    pub strength: f64,
}

/// Lower and upper bound of the properties of bearings, as ASCE/SEI 7-16, 17.2.8, and EN 15129 ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingBounds {
    /// Lower bound, ≤ 1.
    pub lower: BearingFactors,
    /// Upper bound, ≥ 1.
    pub upper: BearingFactors,
}

impl Isolation {
    /// Bearings without dashpot, stops and limit.
    #[must_use]
    pub fn new(isolator: Isolator, mat_mass: f64) -> Self {
        Self {
            isolator,
            mat_mass,
            damping: IsolatorDamping::Coefficient(0.0),
            stops: [None; 2],
            limit: None,
            weight: None,
            bounds: None,
        }
    }

    /// Whether its forces follow from displacements alone: linear bearings without stops.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        matches!(self.isolator, Isolator::Linear { .. }) && self.stops == [None; 2]
    }

    /// Displacement that the bearings allow: as stated, or where all sliding surfaces stand at their rims; `None` if neither is known
    /// \[m\].
    #[must_use]
    pub fn reach(&self) -> Option<f64> {
        let rims = match &self.isolator {
            Isolator::DoublePendulum { surfaces, .. } => Some(&surfaces[..]),
            Isolator::TriplePendulum { surfaces, .. } => Some(&surfaces[..]),
            Isolator::Linear { .. }
            | Isolator::LeadRubber { .. }
            | Isolator::HighDampingRubber { .. }
            | Isolator::Pendulum { .. } => None,
        };
        let whole = rims.map(|all| all.iter().map(|surface| surface.capacity).sum());
        self.limit.or(whole)
    }

    /// Weight on the bearings, for the mass of building and mat \[kg\], in N.
    #[must_use]
    pub fn weight_of(&self, mass: f64) -> f64 {
        self.weight.unwrap_or(STANDARD_GRAVITY * mass)
    }

    /// Coefficient of the dashpot beside the bearings, c or 2ζ√(kM), for the mass of building and mat \[kg\], in N·s/m.
    #[must_use]
    pub fn dashpot(&self, mass: f64) -> f64 {
        match self.damping {
            IsolatorDamping::Coefficient(damping) => damping,
            IsolatorDamping::Ratio(ratio) => {
                2.0 * ratio * (self.isolator.stiffness(self.weight_of(mass)) * mass).sqrt()
            }
        }
    }
}

/// Force of bearings over the displacement of the mat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Isolator {
    /// Rubber: F = k u.
    Linear {
        /// k, > 0 \[N/m\].
        stiffness: f64,
    },
    /// Rubber with a lead core: bilinear with kinematic hardening.
    LeadRubber {
        /// Initial stiffness K₁, > 0 \[N/m\].
        stiffness: f64,
        /// Force at which the lead yields, > 0 \[N\].
        yield_force: f64,
        /// K₂/K₁, 0 ≤ K₂/K₁ < 1 \[–\].
        post_yield: f64,
    },
    /// Rubber of high damping, as a test to an amplitude finds it: bilinear, with the same secant and the same energy of a cycle
    /// (F. Naeim and J. M. Kelly, 1999, Design of Seismic Isolated Structures, Wiley; AASHTO, Guide Specifications for Seismic
    /// Isolation Design).
    HighDampingRubber {
        /// Effective stiffness K, force over displacement at the amplitude, > 0 \[N/m\].
        stiffness: f64,
        /// ζ of a cycle, its energy over 2πKD², > 0 \[–\].
        damping_ratio: f64,
        /// Amplitude D of the test, > 0 \[m\].
        displacement: f64,
        /// Displacement at which it yields, > 0 and < D; about 0.05 to 0.1 of the height of the rubber \[m\].
        yield_displacement: f64,
    },
    /// Friction pendulum: F = N u/R and friction of at most μN.
    Pendulum {
        /// Radius R of the sliding surface, > 0 \[m\].
        radius: f64,
        /// Coefficient of friction.
        friction: SpeedFriction,
        /// Displacement at which friction is fully mobilised, > 0 \[m\].
        slip_displacement: f64,
    },
    /// A slider between two bowls: two pendulums in series.
    DoublePendulum {
        /// Lower and upper bowl.
        surfaces: [SlidingSurface; 2],
        /// Displacement at which the least friction is fully mobilised, > 0 \[m\].
        slip_displacement: f64,
    },
    /// A slider in a cup between two bowls: three stages in series.
    TriplePendulum {
        /// Lower bowl, both inner surfaces, upper bowl.
        surfaces: [SlidingSurface; 4],
        /// Displacement at which the least friction is fully mobilised, > 0 \[m\].
        slip_displacement: f64,
    },
}

/// A sliding surface of a pendulum of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingSurface {
    /// Effective radius, radius of the bowl less the height of what slides on it, > 0 \[m\].
    pub radius: f64,
    /// Coefficient of friction, > 0; the same at every speed \[–\].
    pub friction: f64,
    /// How far the slider moves on it to either side, > 0 \[m\].
    pub capacity: f64,
}

impl SlidingSurface {
    /// With its friction multiplied.
    fn rubbing(self, factor: f64) -> Self {
        Self {
            friction: factor * self.friction,
            ..self
        }
    }

    /// As a stage that carries a weight \[N\].
    fn stage(&self, weight: f64) -> SlidingStage {
        SlidingStage {
            friction: self.friction * weight,
            stiffness: weight / self.radius,
            travel: self.capacity,
        }
    }
}

/// The stages of a triple pendulum under a weight \[N\] (D. M. Fenz and M. C. Constantinou, 2008, Earthquake Eng. Struct. Dyn. 37,
/// 163–183, series model): both inner surfaces together, then each bowl, whose slider turns as it goes, by its radius less that of
/// the inner surface beside it. What the bowls do not take of the whole travel is that of the inner surfaces.
fn triple_stages(surfaces: &[SlidingSurface; 4], weight: f64) -> [SlidingStage; 3] {
    let [lower, below, above, upper] = surfaces;
    let bowl = |bowl: &SlidingSurface, inner: &SlidingSurface| {
        let radius = bowl.radius - inner.radius;
        let capacity = bowl.capacity * radius / bowl.radius;
        SlidingSurface {
            radius,
            capacity,
            ..*bowl
        }
    };
    let bowls = [bowl(lower, below), bowl(upper, above)];
    let radius = below.radius + above.radius;
    let whole: f64 = surfaces.iter().map(|surface| surface.capacity).sum();
    let inner = SlidingSurface {
        radius,
        friction: (below.friction * below.radius + above.friction * above.radius) / radius,
        capacity: whole - bowls[0].capacity - bowls[1].capacity,
    };
    [inner, bowls[0], bowls[1]].map(|surface| surface.stage(weight))
}

/// Friction that rises with the speed of sliding, μ = fast − (fast − slow) e^(−rate·|v|) (M. C. Constantinou, A. Mokha and
/// A. Reinhorn, 1990, J. Struct. Eng. 116, 455–474).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedFriction {
    /// At rest, > 0 and ≤ `fast` \[–\].
    pub slow: f64,
    /// At high speed \[–\].
    pub fast: f64,
    /// How fast friction rises with speed, ≥ 0; not used if `slow` = `fast` \[s/m\].
    pub rate: f64,
}

impl SpeedFriction {
    /// The same friction at every speed.
    #[must_use]
    pub fn constant(coefficient: f64) -> Self {
        Self {
            slow: coefficient,
            fast: coefficient,
            rate: 0.0,
        }
    }

    /// Whether it is the same at every speed.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.slow == self.fast
    }
}

/// Dashpot beside bearings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IsolatorDamping {
    /// Force per velocity, ≥ 0 \[N·s/m\].
    Coefficient(f64),
    /// ζ of the whole mass on linear bearings, 0 ≤ ζ < 1; c = 2ζ√(kM) \[–\].
    Ratio(f64),
}

/// An elastic stop: F = k (|u| − at) beyond `at`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Displacement of the mat at which it is reached, > 0 \[m\].
    pub at: f64,
    /// Stiffness, > 0 \[N/m\].
    pub stiffness: f64,
}

impl Isolator {
    /// Rubber of high damping as rubber with a lead core that has the same loops: Q = πζKD²/(2(D − u_y)), K₂ = K − Q/D, K₁ = K₂ +
    /// Q/u_y. Others as they are.
    fn as_bilinear(self) -> Self {
        let Self::HighDampingRubber {
            stiffness,
            damping_ratio,
            displacement,
            yield_displacement,
        } = self
        else {
            return self;
        };
        let cycle = std::f64::consts::PI * damping_ratio * stiffness * displacement * displacement;
        let strength = 0.5 * cycle / (displacement - yield_displacement);
        let second = stiffness - strength / displacement;
        let first = second + strength / yield_displacement;
        Self::LeadRubber {
            stiffness: first,
            yield_force: first * yield_displacement,
            post_yield: second / first,
        }
    }

    /// The same bearings with their properties multiplied.
    #[must_use]
    pub fn scaled(self, factors: BearingFactors) -> Self {
        match self.as_bilinear() {
            other @ Self::HighDampingRubber { .. } => other,
            Self::Linear { stiffness } => Self::Linear {
                stiffness: factors.stiffness * stiffness,
            },
            Self::LeadRubber {
                stiffness,
                yield_force,
                post_yield,
            } => Self::LeadRubber {
                stiffness: factors.stiffness * stiffness,
                yield_force: factors.strength * yield_force,
                post_yield,
            },
            Self::Pendulum {
                radius,
                friction,
                slip_displacement,
            } => Self::Pendulum {
                radius,
                friction: SpeedFriction {
                    slow: factors.strength * friction.slow,
                    fast: factors.strength * friction.fast,
                    ..friction
                },
                slip_displacement,
            },
            Self::DoublePendulum {
                surfaces,
                slip_displacement,
            } => Self::DoublePendulum {
                surfaces: surfaces.map(|surface| surface.rubbing(factors.strength)),
                slip_displacement,
            },
            Self::TriplePendulum {
                surfaces,
                slip_displacement,
            } => Self::TriplePendulum {
                surfaces: surfaces.map(|surface| surface.rubbing(factors.strength)),
                slip_displacement,
            },
        }
    }

    /// Name in model files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Linear { .. } => "linear",
            Self::LeadRubber { .. } => "lead-rubber",
            Self::HighDampingRubber { .. } => "high-damping-rubber",
            Self::Pendulum { .. } => "friction-pendulum",
            Self::DoublePendulum { .. } => "double-friction-pendulum",
            Self::TriplePendulum { .. } => "triple-friction-pendulum",
        }
    }

    /// Whether it slides on surfaces whose friction grows with the weight on them.
    #[must_use]
    pub const fn slides(&self) -> bool {
        match self {
            Self::Pendulum { .. } | Self::DoublePendulum { .. } | Self::TriplePendulum { .. } => {
                true
            }
            Self::Linear { .. } | Self::LeadRubber { .. } | Self::HighDampingRubber { .. } => false,
        }
    }

    /// Force over displacement when first loaded to a reach \[m\], from rest through every corner, for a weight \[N\], as points \[m, N\];
    /// friction at high speed. Empty for linear bearings.
    #[must_use]
    pub fn first_loading(&self, weight: f64, reach: f64) -> Vec<[f64; 2]> {
        let spring = match (self.yielding(weight), self.stages(weight)) {
            (Some([strength, second, yielding]), _) => {
                let [to, end] = [yielding, reach.max(yielding)].map(|u| [u, strength + second * u]);
                return vec![[0.0; 2], to, end];
            }
            (None, Some(_)) => self.springs(weight).1,
            (None, None) => None,
        };
        let Some(spring) = spring else {
            return Vec::new();
        };
        let (mut memory, mut points) = (HysteresisMemory::default(), vec![[0.0; 2]]);
        while memory.deformation() < reach {
            let corner = spring.next_corner(&memory, Side::Positive);
            memory = spring.respond(&memory, corner.min(reach)).memory;
            points.push([memory.deformation(), memory.force()]);
        }
        points
    }

    /// Stages of a pendulum of several surfaces and the elastic stiffness before they slide \[N/m\], for a weight \[N\]; `None` for
    /// others.
    pub(crate) fn stages(&self, weight: f64) -> Option<([SlidingStage; 3], f64)> {
        let (stages, slip) = match self {
            Self::DoublePendulum {
                surfaces: [lower, upper],
                slip_displacement,
            } => {
                let [lower, upper] = [lower, upper].map(|surface| surface.stage(weight));
                ([lower, upper, SlidingStage::STILL], slip_displacement)
            }
            Self::TriplePendulum {
                surfaces,
                slip_displacement,
            } => (triple_stages(surfaces, weight), slip_displacement),
            Self::Linear { .. }
            | Self::LeadRubber { .. }
            | Self::HighDampingRubber { .. }
            | Self::Pendulum { .. } => return None,
        };
        let least = stages
            .iter()
            .map(|stage| stage.friction)
            .fold(f64::INFINITY, f64::min);
        Some((stages, least / slip))
    }

    /// Slope of the force at the origin, for a weight \[N\], in N/m.
    #[must_use]
    pub fn stiffness(&self, weight: f64) -> f64 {
        match self.as_bilinear() {
            Self::Linear { stiffness } | Self::LeadRubber { stiffness, .. } => stiffness,
            Self::Pendulum {
                radius,
                friction,
                slip_displacement,
            } => friction.fast * weight / slip_displacement + weight / radius,
            Self::HighDampingRubber { .. }
            | Self::DoublePendulum { .. }
            | Self::TriplePendulum { .. } => {
                self.stages(weight).map_or(f64::NAN, |(_, elastic)| elastic)
            }
        }
    }

    /// Strength Q of the yielding part, K₂ beyond yield and the yield displacement u_y, for a weight \[N\]:
    /// \[N, N/m, m\]. `None` for linear bearings and for pendulums of several surfaces, whose slope changes more than once.
    ///
    /// Lead-rubber: Q = F_y (1 − K₂/K₁). Pendulum: Q = μN at high speed and K₂ = N/R.
    #[must_use]
    pub fn yielding(&self, weight: f64) -> Option<[f64; 3]> {
        match self.as_bilinear() {
            Self::Linear { .. }
            | Self::HighDampingRubber { .. }
            | Self::DoublePendulum { .. }
            | Self::TriplePendulum { .. } => None,
            Self::LeadRubber {
                stiffness,
                yield_force,
                post_yield,
            } => Some([
                yield_force * (1.0 - post_yield),
                post_yield * stiffness,
                yield_force / stiffness,
            ]),
            Self::Pendulum {
                radius,
                friction,
                slip_displacement,
            } => Some([friction.fast * weight, weight / radius, slip_displacement]),
        }
    }

    /// Stiffness \[N/m\] and damping ratio \[–\] of the linear bearings that take their place in motions of amplitude D \[m\]:
    /// K = K₂ + Q/D, ζ = 2Q(D − u_y)/(πKD²) (AASHTO, Guide Specifications for Seismic Isolation Design). `None` within the
    /// yield displacement.
    #[must_use]
    pub fn equivalent(&self, weight: f64, amplitude: f64) -> Option<[f64; 2]> {
        if self.stages(weight).is_some() {
            return self.equivalent_of_a_cycle(weight, amplitude);
        }
        let Some([strength, second, yielding]) = self.yielding(weight) else {
            return Some([self.stiffness(weight), 0.0]);
        };
        if amplitude <= yielding {
            return None;
        }
        let stiffness = second + strength / amplitude;
        let ratio = 2.0 * strength * (amplitude - yielding)
            / (std::f64::consts::PI * stiffness * amplitude * amplitude);
        Some([stiffness, ratio])
    }

    /// The same from a cycle of the spring: its secant, and the work W of a cycle by ζ = W/(2πKD²).
    fn equivalent_of_a_cycle(&self, weight: f64, amplitude: f64) -> Option<[f64; 2]> {
        let (_, spring) = self.springs(weight);
        let spring = spring.filter(|spring| {
            amplitude > spring.backbone().side(Side::Positive).yielding.deformation
        })?;
        let (mut memory, mut work) = (HysteresisMemory::default(), 0.0);
        for to in [amplitude, -amplitude, amplitude, -amplitude, amplitude] {
            let response = spring.respond(&memory, to);
            // That of the last two legs.
            work = if to > 0.0 {
                work + response.work
            } else {
                response.work
            };
            memory = response.memory;
        }
        let stiffness = memory.force() / amplitude;
        let ratio = work / (2.0 * std::f64::consts::PI * stiffness * amplitude * amplitude);
        Some([stiffness, ratio])
    }

    /// Elastic stiffness beside the yielding spring, and that spring, for a weight \[N\].
    ///
    /// Constant friction is one bilinear spring, with the pendulum in it. Friction that changes with speed is a spring of its own.
    pub(crate) fn springs(&self, weight: f64) -> (f64, Option<Hysteresis>) {
        let bilinear = |initial: f64, yield_force: f64, post_yield: f64| {
            let corners = Corners::bilinear(yield_force, post_yield);
            let backbone = Backbone::from_forces(initial, corners, corners).ok()?;
            Hysteresis::new(HysteresisRule::Bilinear, backbone).ok()
        };
        match self.as_bilinear() {
            Self::Linear { stiffness } => (stiffness, None),
            Self::LeadRubber {
                stiffness,
                yield_force,
                post_yield,
            } => (0.0, bilinear(stiffness, yield_force, post_yield)),
            Self::Pendulum {
                radius,
                friction,
                slip_displacement,
            } if friction.is_constant() => {
                let (first, second) = (self.stiffness(weight), weight / radius);
                (
                    0.0,
                    bilinear(first, first * slip_displacement, second / first),
                )
            }
            Self::Pendulum {
                radius,
                friction,
                slip_displacement,
            } => {
                let [slow, fast] = [friction.slow, friction.fast].map(|mu| mu * weight);
                let sliding =
                    Hysteresis::sliding(fast / slip_displacement, [slow, fast], friction.rate);
                (weight / radius, sliding.ok())
            }
            Self::HighDampingRubber { .. }
            | Self::DoublePendulum { .. }
            | Self::TriplePendulum { .. } => {
                let stages = self.stages(weight);
                let spring = stages
                    .and_then(|(stages, elastic)| Hysteresis::pendulums(elastic, stages).ok());
                (0.0, spring)
            }
        }
    }
}

impl Stop {
    /// Its spring on a side.
    pub(crate) fn spring(&self, side: Side) -> Option<Hysteresis> {
        Hysteresis::stop(self.stiffness, self.at, side).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cycle of amplitude D dissipates 4Q(D − u_y) = 2πζKD², and its secant is K.
    #[test]
    fn the_equivalent_stiffness_and_damping_are_those_of_a_cycle() {
        let pendulum = Isolator::Pendulum {
            radius: 1.5,
            friction: SpeedFriction::constant(0.05),
            slip_displacement: 1e-3,
        };
        let lead = Isolator::LeadRubber {
            stiffness: 42e6,
            yield_force: 400e3,
            post_yield: 0.1,
        };
        let (weight, amplitude) = (6.4e6, 0.1);
        let rubber = Isolator::HighDampingRubber {
            stiffness: 8e6,
            damping_ratio: 0.16,
            displacement: 0.1,
            yield_displacement: 8e-3,
        };
        for bearing in [pendulum, lead, rubber] {
            let (_, spring) = bearing.springs(weight);
            let spring = spring.expect("sound");
            let mut memory = HysteresisMemory::default();
            let mut work = 0.0;
            for (leg, to) in [amplitude, -amplitude, amplitude].into_iter().enumerate() {
                let response = spring.respond(&memory, to);
                memory = response.memory;
                if leg > 0 {
                    work += response.work;
                }
            }
            let [stiffness, ratio] = bearing.equivalent(weight, amplitude).expect("it yields");
            let secant = memory.force() / amplitude;
            assert!((stiffness / secant - 1.0).abs() < 1e-12);
            let by_ratio = 2.0 * std::f64::consts::PI * ratio * stiffness * amplitude * amplitude;
            assert!(
                (by_ratio / work - 1.0).abs() < 1e-12,
                "{by_ratio} and {work}"
            );
        }
        let [stiffness, ratio] = rubber.equivalent(weight, amplitude).expect("it yields");
        assert!((stiffness / 8e6 - 1.0).abs() < 1e-12 && (ratio / 0.16 - 1.0).abs() < 1e-12);
    }
}
