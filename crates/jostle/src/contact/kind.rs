//! The formulas by name.

use super::{BilinearConstants, BilinearShape, Crush, Dashpot, DashpotLaw, Formula, RubberBumper};

/// The formula of a contact law.
///
/// ```
/// use jostle::LawKind;
///
/// let law = LawKind::HertzDamp;
/// assert_eq!(law.name(), "hertz-damp");
/// assert!(law.is_hertzian()); // its stiffness is in N/m^1.5
/// assert_eq!(LawKind::ALL.len(), 12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LawKind {
    /// F = k δ.
    Linear,
    /// F = k δ + c δ̇ until δ = 0, so it is in tension just before release (Anagnostopoulos 1988).
    Kelvin,
    /// The same, cut at F = 0.
    KelvinNoTension,
    /// Linear spring with a damper, without tension.
    ModifiedKelvin(ModifiedKelvin),
    /// F = k δ^1.5.
    Hertz,
    /// F = k δ^1.5 (1 + ¾(1 − e²) δ̇/v₀) (Muthukumar & DesRoches 2006).
    HertzDamp,
    /// F = k δ^1.5 (1 + 8/5 (1 − e)/e δ̇/v₀) (Ye, Li & Zhu 2009).
    Ye,
    /// F = k δ^1.5 + c δ^¼ δ̇ in approach, k δ^1.5 in restitution (Jankowski 2005).
    Jankowski,
    /// Two stiffnesses with a yield indentation (Muthukumar & DesRoches).
    Bilinear(BilinearShape),
    /// Momentum law: velocities change instantly, v⁺ = −e v⁻ (Newton; stereomechanical approach).
    Restitution,
    /// Rubber bumper that stiffens and dissipates energy in restitution (after Polycarpou, Komodromos & Polycarpou
    /// 2013).
    Rubber(RubberBumper),
    /// A Kelvin law whose dashpot is given instead of a coefficient of restitution.
    Dashpot(Dashpot),
    /// The bilinear law with given stiffnesses and yield indentation.
    BilinearGiven(BilinearConstants),
    /// F = k δ, or k δ^1.5, up to a force at which the face crushes; it stays crushed.
    Crushing(Crush),
    /// A formula of the user in indentation, rate and impact speed.
    Formula(Formula),
}

/// Damper of the modified Kelvin law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ModifiedKelvin {
    /// F = k δ (1 + 3/2 (1 − e)/e δ̇/v₀) (Ye, Li & Zhu 2009).
    #[default]
    Ye,
    /// F = k δ + c δ̇ in approach, k δ in restitution (Mahmoud & Jankowski 2011).
    MahmoudJankowski,
}

impl ModifiedKelvin {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Ye, Self::MahmoudJankowski];

    /// The variant of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|variant| variant.name() == name)
    }

    /// Spelling in model files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ye => "ye",
            Self::MahmoudJankowski => "mahmoud-jankowski",
        }
    }
}

impl LawKind {
    /// Every law by a coefficient of restitution or without one, those with parameters at their defaults, in the order of
    /// the documentation. Forms of a law with constants that have no default are not among them.
    pub const ALL: [Self; 12] = [
        Self::Linear,
        Self::Kelvin,
        Self::KelvinNoTension,
        Self::ModifiedKelvin(ModifiedKelvin::Ye),
        Self::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski),
        Self::Hertz,
        Self::HertzDamp,
        Self::Ye,
        Self::Jankowski,
        Self::Bilinear(BilinearShape::USUAL),
        Self::Restitution,
        Self::Rubber(RubberBumper::USUAL),
    ];

    /// Spellings in model files, in the same order; variants of a law share one.
    pub const NAMES: [&'static str; 11] = Self::names();

    const fn names() -> [&'static str; 11] {
        let mut names = [""; 11];
        let (mut kind, mut count) = (0, 0);
        while kind < Self::ALL.len() {
            let variant = matches!(
                Self::ALL[kind],
                Self::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski)
            );
            if !variant {
                names[count] = Self::ALL[kind].name();
                count += 1;
            }
            kind += 1;
        }
        names
    }

    /// The law of a name, with parameters at their defaults.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Spelling in model files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Crushing(crush) if crush.hertzian => "hertz",
            Self::Linear | Self::Crushing(_) => "linear",
            Self::Kelvin => "kelvin",
            Self::KelvinNoTension => "kelvin-no-tension",
            Self::ModifiedKelvin(_) => "modified-kelvin",
            Self::Dashpot(dashpot) => match dashpot.law {
                DashpotLaw::Kelvin => "kelvin",
                DashpotLaw::KelvinNoTension => "kelvin-no-tension",
                DashpotLaw::Approach => "modified-kelvin",
            },
            Self::Hertz => "hertz",
            Self::HertzDamp => "hertz-damp",
            Self::Ye => "ye",
            Self::Jankowski => "jankowski",
            Self::Bilinear(_) | Self::BilinearGiven(_) => "bilinear",
            Self::Restitution => "restitution",
            Self::Rubber(_) => "rubber",
            Self::Formula(_) => "formula",
        }
    }

    /// The name, with the variant where there are several.
    #[must_use]
    pub fn full_name(self) -> String {
        match self {
            Self::ModifiedKelvin(variant) => format!("{} ({})", self.name(), variant.name()),
            Self::Dashpot(_) => match self.variant() {
                Some(variant) => format!("{} ({}, dashpot given)", self.name(), variant.name()),
                None => format!("{} (dashpot given)", self.name()),
            },
            Self::BilinearGiven(_) => format!("{} (constants given)", self.name()),
            Self::Crushing(_) => format!("{} (crushes)", self.name()),
            _ => self.name().to_owned(),
        }
    }

    /// Whether the stiffness is in N/m^1.5 rather than N/m.
    #[must_use]
    pub fn is_hertzian(self) -> bool {
        match self {
            Self::Hertz | Self::HertzDamp | Self::Ye | Self::Jankowski | Self::Bilinear(_) => true,
            Self::Formula(formula) => formula.is_hertzian(),
            Self::Crushing(crush) => crush.hertzian,
            _ => false,
        }
    }

    /// Whether the law loses energy.
    #[must_use]
    pub fn is_dissipative(self) -> bool {
        !matches!(self, Self::Linear | Self::Hertz)
    }

    /// Whether the coefficient of restitution matters: the law loses energy, and no constant says how much.
    #[must_use]
    pub fn uses_restitution(self) -> bool {
        match self {
            Self::Formula(formula) => formula.uses_restitution(),
            _ => self.is_dissipative() && !self.has_given_constants(),
        }
    }

    /// Whether constants state what the law dissipates, instead of a coefficient of restitution.
    #[must_use]
    pub fn has_given_constants(self) -> bool {
        matches!(
            self,
            Self::Dashpot(_) | Self::BilinearGiven(_) | Self::Crushing(_)
        ) || matches!(self, Self::Formula(formula) if !formula.uses_restitution())
    }

    /// The law of a point that bears a share of the contact: constants that act side by side are shared.
    #[must_use]
    pub(crate) fn shared(self, share: f64) -> Self {
        match self {
            Self::Dashpot(dashpot) => Self::Dashpot(Dashpot {
                damping: share * dashpot.damping,
                ..dashpot
            }),
            Self::BilinearGiven(constants) => Self::BilinearGiven(BilinearConstants {
                second_stiffness: share * constants.second_stiffness,
                ..constants
            }),
            Self::Crushing(crush) => Self::Crushing(Crush {
                force: share * crush.force,
                ..crush
            }),
            Self::Formula(formula) => Self::Formula(formula.shared(share)),
            Self::Linear
            | Self::Kelvin
            | Self::KelvinNoTension
            | Self::ModifiedKelvin(_)
            | Self::Hertz
            | Self::HertzDamp
            | Self::Ye
            | Self::Jankowski
            | Self::Bilinear(_)
            | Self::Restitution
            | Self::Rubber(_) => self,
        }
    }

    /// Whether a published formula relates the coefficient to the damping, so that the rebound of free masses may
    /// differ from the coefficient.
    #[must_use]
    pub fn has_published_damping(self) -> bool {
        self.uses_restitution()
            && !matches!(
                self,
                Self::Kelvin | Self::Restitution | Self::Rubber(_) | Self::Formula(_)
            )
    }

    /// Which modified Kelvin law it is, of these.
    #[must_use]
    pub fn variant(self) -> Option<ModifiedKelvin> {
        match self {
            Self::ModifiedKelvin(variant) => Some(variant),
            Self::Dashpot(dashpot) if dashpot.law == DashpotLaw::Approach => {
                Some(ModifiedKelvin::MahmoudJankowski)
            }
            _ => None,
        }
    }
}
