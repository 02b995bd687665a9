//! A contact law with its coefficients, and the memory of an impact.

use std::f64::consts::PI;

use super::hertz::{HERTZ_DURATION, hertz_indentation};
use super::{Bilinear, Crushing, FormulaLaw, Rubber, approach, hertz, kelvin};

/// A contact law with its coefficients; pure functions of indentation, rate and memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForceLaw {
    /// F = k δ + c δ̇.
    Kelvin {
        /// k \[N/m\].
        stiffness: f64,
        /// c \[N·s/m\].
        damping: f64,
        /// Keep the tensile force before release.
        tension: bool,
    },
    /// F = k δ + c δ̇ in approach, k δ in restitution.
    ApproachKelvin {
        /// k \[N/m\].
        stiffness: f64,
        /// c \[N·s/m\].
        damping: f64,
    },
    /// F = k δ (1 + d δ̇/v₀).
    DampedLinear {
        /// k \[N/m\].
        stiffness: f64,
        /// d \[–\].
        damping: f64,
    },
    /// F = k δ^1.5 (1 + d δ̇/v₀).
    Hertz {
        /// k \[N/m^1.5\].
        stiffness: f64,
        /// d \[–\].
        damping: f64,
    },
    /// F = k δ^1.5 + c δ^¼ δ̇ in approach, k δ^1.5 in restitution.
    Jankowski {
        /// k \[N/m^1.5\].
        stiffness: f64,
        /// c \[N·s/m^1.25\].
        damping: f64,
    },
    /// Two stiffnesses and a yield indentation.
    Bilinear(Bilinear),
    /// Velocities change instantly; lasting contact uses F = k δ + c δ̇, cut at zero.
    Restitution {
        /// e \[–\].
        restitution: f64,
        /// k of lasting contact \[N/m\].
        stiffness: f64,
        /// c of lasting contact \[N·s/m\].
        damping: f64,
    },
    /// Rubber bumper.
    Rubber(Rubber),
    /// A face that crushes and stays crushed.
    Crushing(Crushing),
    /// A formula of the user.
    Formula(FormulaLaw),
}

/// Contact force and its partial derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactResponse {
    /// Force, positive in compression \[N\].
    pub force: f64,
    /// ∂F/∂δ \[N/m\].
    pub by_indentation: f64,
    /// ∂F/∂δ̇ \[N·s/m\].
    pub by_rate: f64,
}

/// Memory of one impact between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory {
    /// Speed by which laws divide: the impact speed, or, if it is below 1 mm/s, the greatest closing rate since
    /// first contact, > 0 \[m/s\].
    pub speed: f64,
    /// Whether the impact speed is below 1 mm/s.
    pub from_rest: bool,
    /// (v/v_ref)^0.4 of the bilinear law, 1 for others \[–\].
    pub scale: f64,
    /// Indentation at the end of the last step \[m\].
    pub indentation: f64,
    /// Force of the elasto-plastic part of the bilinear law at that instant \[N\].
    pub slip: f64,
    /// Depth to which the face was crushed before this impact, which indentation does not include; zero for laws that do
    /// not crush \[m\].
    pub crushed_before: f64,
    /// Depth that this impact has crushed since: without force until it is pressed deeper \[m\].
    pub crushed: f64,
}

/// Impact speed below which contact starts from rest, without an impact speed by which a law can divide \[m/s\].
const REST: f64 = 1e-3;
/// Lower bound of the speed by which laws divide \[m/s\].
pub(super) const SLOWEST: f64 = 1e-9;

/// A force that grows with this power of the indentation, or a higher one, ends without a noticeable corner.
const SMOOTH_ONSET: f64 = 1.5;
/// Exponent of a bumper above which its force stiffens steeply.
const STEEP_EXPONENT: f64 = 2.0;

impl ForceLaw {
    /// The memory of an impact that begins at a closing rate ≥ 0 \[m/s\], on a virgin face.
    #[must_use]
    pub fn touch(&self, rate: f64) -> Memory {
        Memory {
            speed: rate.max(SLOWEST),
            from_rest: rate < REST,
            scale: if let Self::Bilinear(bilinear) = self {
                bilinear.scale(rate)
            } else {
                1.0
            },
            indentation: 0.0,
            slip: 0.0,
            crushed_before: 0.0,
            crushed: 0.0,
        }
    }

    /// Force and derivatives at indentation δ \[m\] and rate δ̇ \[m/s\] on first loading at `impact_speed` v₀ > 0
    /// \[m/s\].
    #[must_use]
    pub fn respond(&self, indentation: f64, rate: f64, impact_speed: f64) -> ContactResponse {
        self.follow(indentation, rate, &self.touch(impact_speed))
    }

    /// Force and derivatives at indentation δ \[m\] and rate δ̇ \[m/s\], reached in one step from `memory`. Zero
    /// for δ ≤ 0, except for the Kelvin law with tension, which acts until its contact is released. The force never
    /// decreases with indentation or rate.
    #[must_use]
    #[inline]
    pub fn follow(&self, indentation: f64, rate: f64, memory: &Memory) -> ContactResponse {
        match *self {
            Self::Kelvin {
                stiffness,
                damping,
                tension,
            } => kelvin::respond(stiffness, damping, tension, indentation, rate),
            Self::Restitution {
                stiffness, damping, ..
            } => kelvin::respond(stiffness, damping, false, indentation, rate),
            Self::ApproachKelvin { stiffness, damping } => {
                approach::respond_linear(stiffness, damping, indentation, rate)
            }
            Self::DampedLinear { stiffness, damping } => {
                let speed = memory.speed_at(rate);
                hertz::respond_linear(stiffness, damping, indentation, rate, speed)
            }
            Self::Hertz { stiffness, damping } => {
                let speed = memory.speed_at(rate);
                hertz::respond_hertz(stiffness, damping, indentation, rate, speed)
            }
            Self::Jankowski { stiffness, damping } => {
                approach::respond_jankowski(stiffness, damping, indentation, rate)
            }
            Self::Bilinear(ref bilinear) => bilinear.respond(indentation, memory),
            Self::Rubber(ref rubber) => rubber.respond(indentation, rate, memory.speed_at(rate)),
            Self::Crushing(ref crushing) => crushing.respond(indentation, memory),
            Self::Formula(ref formula) => formula.respond(indentation, rate, memory.speed_at(rate)),
        }
    }

    /// Memory after a step to indentation δ at rate δ̇.
    #[inline]
    pub fn remember(&self, indentation: f64, rate: f64, memory: &mut Memory) {
        memory.speed = memory.speed_at(rate);
        match self {
            Self::Bilinear(bilinear) => bilinear.remember(indentation, memory),
            Self::Crushing(crushing) => crushing.remember(indentation, memory),
            Self::Kelvin { .. }
            | Self::ApproachKelvin { .. }
            | Self::DampedLinear { .. }
            | Self::Hertz { .. }
            | Self::Jankowski { .. }
            | Self::Restitution { .. }
            | Self::Rubber(_)
            | Self::Formula(_) => {}
        }
    }

    /// ζ = c/(2√(k m)) of a law with a dashpot of its own, with m = m₁m₂/(m₁ + m₂) \[kg\]; `None` for others \[–\].
    #[must_use]
    pub fn damping_ratio(&self, effective_mass: f64) -> Option<f64> {
        match *self {
            Self::Kelvin {
                stiffness, damping, ..
            }
            | Self::ApproachKelvin { stiffness, damping } => {
                Some(damping / (2.0 * (stiffness * effective_mass).sqrt()))
            }
            Self::DampedLinear { .. }
            | Self::Hertz { .. }
            | Self::Jankowski { .. }
            | Self::Bilinear(_)
            | Self::Restitution { .. }
            | Self::Rubber(_)
            | Self::Crushing(_)
            | Self::Formula(_) => None,
        }
    }

    /// Force at first contact, before any indentation, at the closing rate `rate` ≥ 0 \[N\].
    #[must_use]
    pub fn onset(&self, rate: f64) -> f64 {
        match *self {
            Self::Kelvin { damping, .. }
            | Self::ApproachKelvin { damping, .. }
            | Self::Restitution { damping, .. } => damping * rate,
            Self::Formula(ref formula) => formula.onset(rate),
            _ => 0.0,
        }
    }

    /// Whether the force jumps when the contact opens, so that a step must end there.
    #[must_use]
    pub fn jumps_at_release(&self) -> bool {
        matches!(self, Self::Kelvin { damping, tension: true, .. } if *damping > 0.0)
    }

    /// Whether the slope of the force over time jumps where the force ends, because it falls to zero along a straight
    /// line or is cut there.
    #[must_use]
    pub(crate) fn has_corner_at_release(&self) -> bool {
        match self {
            Self::Kelvin { .. } => !self.jumps_at_release(),
            Self::ApproachKelvin { .. }
            | Self::DampedLinear { .. }
            | Self::Bilinear(_)
            | Self::Crushing(_)
            | Self::Formula(_)
            | Self::Restitution { .. } => true,
            Self::Rubber(rubber) => rubber.exponent < SMOOTH_ONSET,
            Self::Hertz { .. } | Self::Jankowski { .. } => false,
        }
    }

    /// Whether the slope of the force over time jumps where the motion reverses, because a dashpot or a slider
    /// starts or stops acting there.
    #[must_use]
    pub(crate) fn has_corner_at_turn(&self) -> bool {
        match self {
            Self::ApproachKelvin { .. }
            | Self::Jankowski { .. }
            | Self::Rubber(_)
            | Self::Bilinear(_)
            | Self::Crushing(_) => true,
            Self::Formula(formula) => formula.has_corner_at_turn(),
            Self::Kelvin { .. }
            | Self::DampedLinear { .. }
            | Self::Hertz { .. }
            | Self::Restitution { .. } => false,
        }
    }

    /// Whether the force, while the motion does not reverse, lies between those at both ends of a step: it follows the
    /// indentation along lines that meet at corners, which a cubic through the slopes at the ends would overshoot.
    #[must_use]
    pub(crate) fn stays_between_ends(&self) -> bool {
        matches!(self, Self::Crushing(own) if !own.hertzian)
    }

    /// Whether the stiffness grows so steeply that most of an impact happens in a small part of it.
    #[must_use]
    pub(crate) fn stiffens_steeply(&self) -> bool {
        matches!(self, Self::Rubber(rubber) if rubber.exponent > STEEP_EXPONENT)
    }

    /// Whether the force starts as a root of time, which no step can resolve.
    #[must_use]
    pub(crate) fn starts_steeply(&self) -> bool {
        match self {
            Self::Formula(formula) => formula.starts_steeply(),
            _ => matches!(self, Self::Jankowski { .. }),
        }
    }

    /// The coefficient with which an impact at this closing rate \[m/s\] changes velocities instantly; `None` if a
    /// force acts over time.
    #[must_use]
    pub fn rebound(&self, rate: f64) -> Option<f64> {
        match *self {
            Self::Restitution { restitution, .. } => {
                (rate > super::momentum::REST_SPEED).then_some(restitution)
            }
            Self::Kelvin { .. }
            | Self::ApproachKelvin { .. }
            | Self::DampedLinear { .. }
            | Self::Hertz { .. }
            | Self::Jankowski { .. }
            | Self::Bilinear(_)
            | Self::Rubber(_)
            | Self::Crushing(_)
            | Self::Formula(_) => None,
        }
    }

    /// Indentations where the slope of the force jumps, in approach and in restitution \[m\].
    pub(crate) fn kink(&self, inwards: bool, memory: &Memory) -> f64 {
        match self {
            Self::Bilinear(bilinear) => bilinear.kink(inwards, memory),
            Self::Rubber(rubber) => rubber.limit,
            Self::Crushing(crushing) => crushing.kink(inwards, memory),
            Self::Kelvin { .. }
            | Self::ApproachKelvin { .. }
            | Self::DampedLinear { .. }
            | Self::Hertz { .. }
            | Self::Jankowski { .. }
            | Self::Restitution { .. }
            | Self::Formula(_) => f64::INFINITY,
        }
    }

    /// Duration of the elastic collision of free bodies: the time scale of an impact \[s\].
    ///
    /// `effective_mass` m₁m₂/(m₁ + m₂) \[kg\], `impact_speed` > 0 \[m/s\]. Linear: π√(m/k). Hertz:
    /// 2.9432751843 δ_max/v₀ with δ_max = (5 m v₀²/(4k))^(2/5) (theory, Eq. C6). Bilinear: that of the first stiffness.
    /// A face that crushes: as if it did not.
    #[must_use]
    pub fn elastic_duration(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        let linear = |stiffness: f64| PI * (effective_mass / stiffness).sqrt();
        match self {
            Self::Kelvin { stiffness, .. }
            | Self::ApproachKelvin { stiffness, .. }
            | Self::DampedLinear { stiffness, .. }
            | Self::Restitution { stiffness, .. } => linear(*stiffness),
            Self::Hertz { stiffness, .. } | Self::Jankowski { stiffness, .. } => {
                HERTZ_DURATION * hertz_indentation(*stiffness, effective_mass, impact_speed)
                    / impact_speed
            }
            Self::Bilinear(bilinear) => {
                linear(bilinear.first_stiffness * bilinear.scale(impact_speed))
            }
            Self::Rubber(rubber) => rubber.elastic_duration(effective_mass, impact_speed),
            Self::Crushing(crushing) if crushing.hertzian => {
                HERTZ_DURATION * hertz_indentation(crushing.stiffness, effective_mass, impact_speed)
                    / impact_speed
            }
            Self::Crushing(crushing) => linear(crushing.stiffness),
            Self::Formula(formula) => formula.elastic_duration(effective_mass, impact_speed),
        }
    }

    /// Greatest force of the elastic collision of free bodies: the scale of an impact \[N\]. For the bilinear law,
    /// that of its second stiffness; of a face that crushes, the greatest force with which it does.
    #[must_use]
    pub fn elastic_force(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        let linear = |stiffness: f64| impact_speed * (effective_mass * stiffness).sqrt();
        match self {
            Self::Kelvin { stiffness, .. }
            | Self::ApproachKelvin { stiffness, .. }
            | Self::DampedLinear { stiffness, .. }
            | Self::Restitution { stiffness, .. } => linear(*stiffness),
            Self::Hertz { stiffness, .. } | Self::Jankowski { stiffness, .. } => {
                stiffness
                    * libm::pow(
                        hertz_indentation(*stiffness, effective_mass, impact_speed),
                        1.5,
                    )
            }
            Self::Bilinear(bilinear) => {
                linear(bilinear.second_stiffness * bilinear.scale(impact_speed))
            }
            Self::Rubber(rubber) => rubber.elastic_force(effective_mass, impact_speed),
            Self::Crushing(crushing) => crushing.greatest_force(effective_mass, impact_speed),
            Self::Formula(formula) => formula.elastic_force(effective_mass, impact_speed),
        }
    }

    /// The contact stiffness, in the unit of the law \[N/m, N/m^1.5\].
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        match self {
            Self::Kelvin { stiffness, .. }
            | Self::ApproachKelvin { stiffness, .. }
            | Self::DampedLinear { stiffness, .. }
            | Self::Hertz { stiffness, .. }
            | Self::Jankowski { stiffness, .. }
            | Self::Restitution { stiffness, .. } => *stiffness,
            Self::Bilinear(bilinear) => bilinear.first_stiffness,
            Self::Rubber(rubber) => rubber.stiffness,
            Self::Crushing(crushing) => crushing.stiffness,
            Self::Formula(formula) => formula.stiffness,
        }
    }
}

impl Memory {
    /// The speed by which a law divides at this rate.
    #[inline]
    fn speed_at(&self, rate: f64) -> f64 {
        if self.from_rest {
            self.speed.max(rate)
        } else {
            self.speed
        }
    }
}
