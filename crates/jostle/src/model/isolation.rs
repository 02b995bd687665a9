//! Seismic isolation: a mat on bearings under a building.

use super::STANDARD_GRAVITY;
use crate::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Side};

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
    /// Friction pendulum: F = N u/R and friction of at most μN.
    Pendulum {
        /// Radius R of the sliding surface, > 0 \[m\].
        radius: f64,
        /// Coefficient of friction.
        friction: SpeedFriction,
        /// Displacement at which friction is fully mobilised, > 0 \[m\].
        slip_displacement: f64,
    },
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
    /// The same bearings with their properties multiplied.
    #[must_use]
    pub fn scaled(self, factors: BearingFactors) -> Self {
        match self {
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
        }
    }

    /// Name in model files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Linear { .. } => "linear",
            Self::LeadRubber { .. } => "lead-rubber",
            Self::Pendulum { .. } => "friction-pendulum",
        }
    }

    /// Slope of the force at the origin, for a weight \[N\], in N/m.
    #[must_use]
    pub fn stiffness(&self, weight: f64) -> f64 {
        match *self {
            Self::Linear { stiffness } | Self::LeadRubber { stiffness, .. } => stiffness,
            Self::Pendulum {
                radius,
                friction,
                slip_displacement,
            } => friction.fast * weight / slip_displacement + weight / radius,
        }
    }

    /// Strength Q of the yielding part, K₂ beyond yield and the yield displacement u_y, for a weight \[N\]:
    /// \[N, N/m, m\]. `None` for linear bearings.
    ///
    /// Lead-rubber: Q = F_y (1 − K₂/K₁). Pendulum: Q = μN at high speed and K₂ = N/R.
    #[must_use]
    pub fn yielding(&self, weight: f64) -> Option<[f64; 3]> {
        match *self {
            Self::Linear { .. } => None,
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

    /// Elastic stiffness beside the yielding spring, and that spring, for a weight \[N\].
    ///
    /// Constant friction is one bilinear spring, with the pendulum in it. Friction that changes with speed is a spring of its own.
    pub(crate) fn springs(&self, weight: f64) -> (f64, Option<Hysteresis>) {
        let bilinear = |initial: f64, yield_force: f64, post_yield: f64| {
            let corners = Corners::bilinear(yield_force, post_yield);
            let backbone = Backbone::from_forces(initial, corners, corners).ok()?;
            Hysteresis::new(HysteresisRule::Bilinear, backbone).ok()
        };
        match *self {
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
        for bearing in [pendulum, lead] {
            let (_, spring) = bearing.springs(weight);
            let spring = spring.expect("sound");
            let mut memory = crate::hysteresis::HysteresisMemory::default();
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
    }
}
