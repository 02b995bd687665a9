//! The formulas by name.

use super::{BilinearShape, RubberBumper};

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
    /// Every law, those with parameters at their defaults, in the order of the documentation.
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
            Self::Linear => "linear",
            Self::Kelvin => "kelvin",
            Self::KelvinNoTension => "kelvin-no-tension",
            Self::ModifiedKelvin(_) => "modified-kelvin",
            Self::Hertz => "hertz",
            Self::HertzDamp => "hertz-damp",
            Self::Ye => "ye",
            Self::Jankowski => "jankowski",
            Self::Bilinear(_) => "bilinear",
            Self::Restitution => "restitution",
            Self::Rubber(_) => "rubber",
        }
    }

    /// The name, with the variant where there are several.
    #[must_use]
    pub fn full_name(self) -> String {
        match self {
            Self::ModifiedKelvin(variant) => format!("{} ({})", self.name(), variant.name()),
            _ => self.name().to_owned(),
        }
    }

    /// Whether the stiffness is in N/m^1.5 rather than N/m.
    #[must_use]
    pub fn is_hertzian(self) -> bool {
        matches!(
            self,
            Self::Hertz | Self::HertzDamp | Self::Ye | Self::Jankowski | Self::Bilinear(_)
        )
    }

    /// Whether the law loses energy, so that the coefficient of restitution matters.
    #[must_use]
    pub fn is_dissipative(self) -> bool {
        !matches!(self, Self::Linear | Self::Hertz)
    }

    /// Whether a published formula relates the coefficient to the damping, so that the rebound of free masses may
    /// differ from the coefficient.
    #[must_use]
    pub fn has_published_damping(self) -> bool {
        self.is_dissipative() && !matches!(self, Self::Kelvin | Self::Restitution | Self::Rubber(_))
    }

    /// Which modified Kelvin law it is, of these.
    #[must_use]
    pub fn variant(self) -> Option<ModifiedKelvin> {
        if let Self::ModifiedKelvin(variant) = self {
            Some(variant)
        } else {
            None
        }
    }
}
