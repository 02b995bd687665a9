//! Contact laws: the force between two colliding floors as a function of indentation and its rate.
//!
//! A law receives numbers only. [`ContactLaw`] is the user's input; [`ContactLaw::between`] converts it to a
//! [`ForceLaw`] for given colliding masses. The history of an impact is a [`Memory`] in the state of a run.
//! Indentation δ = u_left − u_right − gap is positive in contact; the force is positive in compression and pushes
//! the left building left. `docs/contact.md` lists every law with its source.
//!
//! [`FreeCollision`] integrates the collision of two free masses precisely, independent of any time step.

mod advice;
mod approach;
mod bilinear;
mod collision;
mod crushing;
mod dashpot;
mod force_law;
mod formula;
mod hertz;
mod kelvin;
mod kind;
pub(crate) mod momentum;
mod root;
mod rubber;
mod runge_kutta;

pub use advice::{
    JANKOWSKI_HERTZ, LATERAL_FACTORS, Rod, RodCollision, Slab, SlabMaterial, StiffnessRange,
    USUAL_HERTZ, advised_range, effective_radius, hertz_of_force, hertz_peak_force,
    hertz_stiffness, rod_collision, spring_of_duration, spring_of_force,
};
pub use bilinear::{Bilinear, BilinearConstants, BilinearShape};
pub use collision::{CollisionPoint, FreeCollision};
pub use crushing::{Crush, Crushing};
pub use dashpot::{Dashpot, DashpotLaw};
pub use force_law::{ContactResponse, ForceLaw, Memory};
pub use formula::{Formula, FormulaError, FormulaLaw};
pub use hertz::{HERTZ_DURATION, hertz_damping, hertz_indentation, hertz_restitution};
pub use kelvin::CLIPPED_KELVIN_LEAST_RESTITUTION;
pub use kind::{LawKind, ModifiedKelvin};
pub use rubber::{Rubber, RubberBumper};

use approach::{approach_damping_ratio, approach_restitution};
use hertz::{published_muthukumar, published_ye, published_ye_linear};
use kelvin::{
    clipped_kelvin_damping_ratio, clipped_kelvin_restitution, kelvin_damping_ratio,
    kelvin_restitution,
};

/// A contact law as described in a model.
///
/// ```
/// use jostle::{ContactLaw, LawKind, RestitutionIs};
///
/// let mut law = ContactLaw {
///     kind: LawKind::HertzDamp,
///     stiffness: 2e9, // N/m^1.5
///     restitution: 0.65,
///     restitution_is: RestitutionIs::Input,
/// };
/// let free = |law: &ContactLaw| law.free_restitution().expect("it does not depend on masses or speed");
/// assert!((free(&law) - 0.775).abs() < 1e-3); // the published formula rebounds more
/// law.restitution_is = RestitutionIs::Realised;
/// assert!((free(&law) - 0.65).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLaw {
    /// The formula.
    pub kind: LawKind,
    /// Contact stiffness, > 0 \[N/m for the linear family, N/m^1.5 for the Hertz family\].
    pub stiffness: f64,
    /// Coefficient of restitution, 0 < e ≤ 1; elastic laws and laws with given constants do not use it \[–\].
    pub restitution: f64,
    /// Meaning of the coefficient.
    pub restitution_is: RestitutionIs,
}

/// Meaning of a coefficient of restitution.
///
/// ```
/// use jostle::{ContactLaw, LawKind, RestitutionIs};
///
/// let law = |restitution_is| ContactLaw { kind: LawKind::HertzDamp, stiffness: 2e9, restitution: 0.65, restitution_is };
/// let free = |meaning| law(meaning).free_restitution().expect("it does not depend on the speed");
/// assert!((free(RestitutionIs::Input) - 0.775).abs() < 1e-3);
/// assert!((free(RestitutionIs::Realised) - 0.65).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RestitutionIs {
    /// It goes into the published formula; the rebound of free masses may differ.
    #[default]
    Input,
    /// The damping is calibrated so that two free masses rebound with exactly this ratio.
    Realised,
}

impl RestitutionIs {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Input, Self::Realised];

    /// The meaning of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|one| one.name() == name)
    }

    /// Spelling in model files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Realised => "realised",
        }
    }
}

impl ContactLaw {
    /// The law between two bodies of the given masses \[kg\].
    ///
    /// The damping of the Kelvin family and of Jankowski's law depends on the masses through m_e = m₁m₂/(m₁ + m₂):
    /// c = 2ζ √(k m_e). Other laws use them only for a time scale.
    #[must_use]
    pub fn between(&self, left_mass: f64, right_mass: f64) -> ForceLaw {
        let (k, e) = (self.stiffness, self.restitution);
        let mass = effective_mass(left_mass, right_mass);
        let realised = self.restitution_is == RestitutionIs::Realised;
        let critical = 2.0 * (k * mass).sqrt();
        let kelvin = |ratio: f64, tension| ForceLaw::Kelvin {
            stiffness: k,
            damping: ratio * critical,
            // Without damping there is no tension.
            tension: tension && ratio > 0.0,
        };
        let hertz = |damping| ForceLaw::Hertz {
            stiffness: k,
            damping,
        };
        match self.kind {
            LawKind::Linear => kelvin(0.0, false),
            LawKind::Kelvin => kelvin(kelvin_damping_ratio(e), true),
            LawKind::KelvinNoTension if realised => kelvin(clipped_kelvin_damping_ratio(e), false),
            LawKind::KelvinNoTension => kelvin(kelvin_damping_ratio(e), false),
            LawKind::ModifiedKelvin(ModifiedKelvin::Ye) => ForceLaw::DampedLinear {
                stiffness: k,
                damping: if realised {
                    hertz_damping(e)
                } else {
                    published_ye_linear(e)
                },
            },
            LawKind::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski) => ForceLaw::ApproachKelvin {
                stiffness: k,
                damping: critical
                    * if realised {
                        approach_damping_ratio(e)
                    } else {
                        approach::published_mahmoud_jankowski(e)
                    },
            },
            LawKind::Hertz => hertz(0.0),
            LawKind::HertzDamp | LawKind::Ye if realised => hertz(hertz_damping(e)),
            LawKind::HertzDamp => hertz(published_muthukumar(e)),
            LawKind::Ye => hertz(published_ye(e)),
            LawKind::Jankowski => ForceLaw::Jankowski {
                stiffness: k,
                damping: critical
                    * if realised {
                        approach::jankowski_ratio(approach_damping_ratio(e))
                    } else {
                        approach::published_jankowski(e)
                    },
            },
            LawKind::Bilinear(shape) => {
                ForceLaw::Bilinear(Bilinear::new(shape, k, mass, e, realised))
            }
            LawKind::Restitution => ForceLaw::Restitution {
                restitution: e,
                stiffness: k,
                damping: critical,
            },
            LawKind::Rubber(bumper) => ForceLaw::Rubber(Rubber::new(bumper, k, e)),
            LawKind::Dashpot(Dashpot { law, damping }) => match law {
                DashpotLaw::Kelvin => ForceLaw::Kelvin {
                    stiffness: k,
                    damping,
                    tension: damping > 0.0,
                },
                DashpotLaw::KelvinNoTension => ForceLaw::Kelvin {
                    stiffness: k,
                    damping,
                    tension: false,
                },
                DashpotLaw::Approach => ForceLaw::ApproachKelvin {
                    stiffness: k,
                    damping,
                },
            },
            LawKind::BilinearGiven(constants) => {
                ForceLaw::Bilinear(Bilinear::of_constants(constants, k, mass))
            }
            LawKind::Crushing(crush) => ForceLaw::Crushing(Crushing::new(crush, k)),
            LawKind::Formula(formula) => ForceLaw::Formula(formula.between(k, e, mass)),
        }
    }

    /// The law of a point that bears a share of a contact of this stiffness \[N/m, N/m^1.5\].
    #[must_use]
    pub(crate) fn shared(&self, stiffness: f64, share: f64) -> Self {
        Self {
            stiffness: share * stiffness,
            kind: self.kind.shared(share),
            ..*self
        }
    }

    /// The same law with another stiffness; the second of two stays the same fraction of it \[N/m, N/m^1.5\].
    #[must_use]
    pub fn with_stiffness(&self, stiffness: f64) -> Self {
        let kind = match self.kind {
            LawKind::BilinearGiven(constants) => LawKind::BilinearGiven(BilinearConstants {
                second_stiffness: constants.second_stiffness * (stiffness / self.stiffness),
                ..constants
            }),
            kind => kind,
        };
        Self {
            kind,
            stiffness,
            ..*self
        }
    }

    /// Lower limit of the restitution that calibration can realise; zero for published damping \[–\].
    #[must_use]
    pub fn least_restitution(&self) -> f64 {
        if self.restitution_is == RestitutionIs::Input {
            return 0.0;
        }
        match self.kind {
            LawKind::KelvinNoTension => CLIPPED_KELVIN_LEAST_RESTITUTION + 1e-6,
            LawKind::Bilinear(shape) => shape.least_restitution() + 1e-6,
            LawKind::Linear
            | LawKind::Kelvin
            | LawKind::ModifiedKelvin(_)
            | LawKind::Hertz
            | LawKind::HertzDamp
            | LawKind::Ye
            | LawKind::Jankowski
            | LawKind::Restitution
            | LawKind::Rubber(_)
            | LawKind::Dashpot(_)
            | LawKind::BilinearGiven(_)
            | LawKind::Crushing(_)
            | LawKind::Formula(_) => 0.0,
        }
    }

    /// Separation speed ÷ impact speed of two free masses under this law \[–\] (docs/contact.md); `None` where it depends
    /// on the masses or on the impact speed. For the bilinear law with a design speed the result holds at that speed.
    #[must_use]
    pub fn free_restitution(&self) -> Option<f64> {
        if self.kind.has_given_constants() {
            return None;
        }
        Some(match self.between(1.0, 1.0) {
            ForceLaw::Kelvin {
                stiffness,
                damping,
                tension,
            } => {
                let ratio = damping / (2.0 * (0.5 * stiffness).sqrt());
                if tension {
                    kelvin_restitution(ratio)
                } else {
                    clipped_kelvin_restitution(ratio)
                }
            }
            ForceLaw::ApproachKelvin { stiffness, damping } => {
                approach_restitution(damping / (2.0 * (0.5 * stiffness).sqrt()))
            }
            ForceLaw::Jankowski { stiffness, damping } => {
                let ratio = damping / (2.0 * (0.5 * stiffness).sqrt());
                approach_restitution(approach::linear_ratio(ratio))
            }
            ForceLaw::Hertz { damping, .. } | ForceLaw::DampedLinear { damping, .. } => {
                hertz_restitution(damping)
            }
            ForceLaw::Bilinear(bilinear) => bilinear.free_restitution(),
            ForceLaw::Restitution { restitution, .. } => restitution,
            ForceLaw::Rubber(rubber) => rubber.free_restitution(),
            ForceLaw::Crushing(_) | ForceLaw::Formula(_) => return None,
        })
    }
}

/// m₁m₂/(m₁ + m₂) \[kg\].
#[must_use]
pub fn effective_mass(left_mass: f64, right_mass: f64) -> f64 {
    1.0 / (1.0 / left_mass + 1.0 / right_mass)
}

#[cfg(test)]
mod tests;
