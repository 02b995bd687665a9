//! Classes of buildings: HAZUS types at design levels, and the names that lead to them.

use std::ops::RangeInclusive;
use std::str::FromStr;

use jostle_batch::Building;

use crate::mdof_lu::Capacity;

/// Capacity, storeys, damage drifts and hysteresis of 36 types at 4 levels, with their sources.
const TABLE: &str = include_str!("../data/hazus.csv");
/// Metres of an inch.
const INCH: f64 = 0.0254;

/// How well a building was designed for earthquakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Before any code.
    Pre,
    /// Low code.
    Low,
    /// Moderate code.
    Moderate,
    /// High code.
    High,
}

impl Level {
    /// All, from the worst to the best.
    pub const ALL: [Self; 4] = [Self::Pre, Self::Low, Self::Moderate, Self::High];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pre => "pre",
            Self::Low => "low",
            Self::Moderate => "moderate",
            Self::High => "high",
        }
    }

    /// The level of a year of construction in California: no code before 1941, a moderate one to 1975, a high one from
    /// 1976 on, as the regional workflow of SimCenter takes it.
    #[must_use]
    pub const fn in_year(year: i32) -> Self {
        match year {
            ..1941 => Self::Pre,
            1941..1976 => Self::Moderate,
            _ => Self::High,
        }
    }
}

impl FromStr for Level {
    type Err = String;

    /// `high`, `HC`, `High-Code`, `high_code`, …
    fn from_str(text: &str) -> Result<Self, String> {
        let plain: String = text
            .to_lowercase()
            .chars()
            .filter(char::is_ascii_alphabetic)
            .collect();
        let short = plain.strip_suffix("code").unwrap_or(&plain);
        match short {
            "pre" | "pc" => Ok(Self::Pre),
            "low" | "lc" => Ok(Self::Low),
            "moderate" | "mc" => Ok(Self::Moderate),
            "high" | "hc" => Ok(Self::High),
            _ => Err(format!(
                "\"{text}\" is no design level: high, moderate, low or pre"
            )),
        }
    }
}

/// A HAZUS type at a design level.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Name of the type, such as `C1M`.
    pub name: &'static str,
    /// Design level.
    pub level: Level,
    /// Capacity curve.
    pub capacity: Capacity,
    /// Storeys that the type is meant for; 16 as the most means no limit.
    pub storeys: RangeInclusive<usize>,
    /// Storeys of its typical building.
    pub typical_storeys: f64,
    /// Height of a storey \[m\].
    pub storey_height: f64,
    /// Drift ratios at which slight, moderate, extensive and complete damage begin \[–\].
    pub drifts: [f64; 4],
    /// Pinching, 1 for none \[–\].
    pub pinching: f64,
    /// Exponent of the unloading stiffness \[–\].
    pub unloading_exponent: f64,
    /// Damping ratio \[–\].
    pub damping: f64,
}

impl Class {
    /// All classes of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        let rows = TABLE.lines().filter(|own| !own.starts_with('#')).skip(1);
        rows.filter_map(|row| {
            let cells: Vec<&'static str> = row.split(',').collect();
            let number = |at: usize| cells.get(at).and_then(|own| own.parse::<f64>().ok());
            Some(Self {
                name: cells.first()?,
                level: cells.get(1)?.parse().ok()?,
                capacity: Capacity {
                    yield_displacement: number(2)? * INCH,
                    yield_acceleration: number(3)?,
                    ultimate_displacement: number(4)? * INCH,
                    ultimate_acceleration: number(5)?,
                },
                storeys: number(6)? as usize..=number(7)? as usize,
                typical_storeys: number(8)?,
                storey_height: number(10)?,
                drifts: [number(11)?, number(12)?, number(13)?, number(14)?],
                pinching: number(15)?,
                unloading_exponent: number(16)?,
                damping: number(17)?,
            })
        })
    }

    /// A class by the full name of its type, such as `C1M`.
    ///
    /// # Errors
    ///
    /// When there is no such type; the text names those that there are.
    pub fn named(name: &str, level: Level) -> Result<Self, String> {
        let wanted = name.trim().to_uppercase();
        Self::all()
            .find(|own| own.level == level && own.name == wanted)
            .ok_or_else(|| {
                let names: Vec<&str> = Self::all()
                    .filter(|own| own.level == level)
                    .map(|own| own.name)
                    .collect();
                format!("\"{name}\" is no type of HAZUS: {}", names.join(", "))
            })
    }

    /// A class by what an inventory says: a type of HAZUS with its height or without (`C1M`, `C1`), or a taxonomy string
    /// of GEM (`CR/LFINF+CDN/HEX:3`), and the storeys.
    ///
    /// # Errors
    ///
    /// When neither is understood; the text says what is missing.
    pub fn of(kind: &str, storeys: usize, level: Level) -> Result<Self, String> {
        let kind = kind.trim();
        if let Ok(own) = Self::named(kind, level) {
            return Ok(own);
        }
        let family = if kind.contains('/') || kind.contains('+') {
            gem_family(kind)?
        } else {
            let upper = kind.to_uppercase();
            let known =
                |own: &str| own == upper || own.strip_suffix(['L', 'M', 'H']) == Some(&upper);
            if !Self::all().any(|own| known(own.name)) {
                return gem_family(kind)
                    .and_then(|family| Self::of_family(family, storeys, level))
                    .map_err(|_| {
                        format!(
                            "\"{kind}\" is neither a type of HAZUS (W1, W2, S1–S5, C1–C3, PC1, PC2, RM1, RM2, URM, MH, with \
                             L, M or H or without) nor a taxonomy string of GEM such as CR/LFM"
                        )
                    });
            }
            return Self::of_family(&upper, storeys, level);
        };
        Self::of_family(family, storeys, level)
    }

    /// The class of a family whose storeys fit, or are nearest.
    fn of_family(family: &str, storeys: usize, level: Level) -> Result<Self, String> {
        let member = |own: &Self| {
            let rest = own.name.strip_prefix(family);
            own.level == level && matches!(rest, Some("" | "L" | "M" | "H"))
        };
        let away = |own: &Self| {
            let (least, most) = (*own.storeys.start(), *own.storeys.end());
            least.saturating_sub(storeys) + storeys.saturating_sub(most)
        };
        Self::all()
            .filter(member)
            .min_by_key(away)
            .ok_or_else(|| format!("no type begins with {family}"))
    }

    /// A building of the class: storeys 1…16, area of a floor \[m²\].
    #[must_use]
    pub fn building(&self, storeys: usize, area: f64) -> Building {
        self.capacity
            .coefficients(
                self.typical_storeys,
                self.pinching,
                self.unloading_exponent,
                self.damping,
            )
            .building(storeys, area, self.storey_height)
    }
}

/// The HAZUS family nearest to a taxonomy string of GEM (Brzev et al. 2013): its material, then its lateral system.
///
/// | material | wall `LWAL` | frame `LFM` | infilled `LFINF` | braced `LFBR` | dual `LDUAL` |
/// |---|---|---|---|---|---|
/// | `CR` | C2 | C1 | C3 | – | C2 |
/// | `PC` in `CR+PC` | PC1 | PC2 | PC2 | – | PC2 |
/// | `S` | S4 | S1 | S5 | S2 | S4 |
/// | `W` | W1 | W2 | W2 | W2 | W2 |
/// | `MR` | RM1 | RM1 | RM1 | – | RM1 |
/// | `MUR`, `MCF`, `E`, `ER`, `EU` | URM | | | | |
fn gem_family(text: &str) -> Result<&'static str, String> {
    let upper = text.to_uppercase();
    let mut attributes = upper.split('/');
    // A direction may stand first.
    let first = attributes
        .find(|own| !own.starts_with('D'))
        .unwrap_or_default();
    let mut parts = first.split('+');
    let material = parts.next().unwrap_or_default();
    let precast = parts.any(|own| own == "PC" || own == "PCPS");
    let systems: Vec<&str> = attributes
        .filter(|own| own.starts_with('L'))
        .filter_map(|own| own.split('+').next())
        .collect();
    let system = systems.first().copied().unwrap_or("");
    let of = |wall, frame, infilled, braced, dual| match system {
        "LWAL" | "LPB" => wall,
        "LFM" | "LFLS" | "LFLSINF" | "" => frame,
        "LFINF" => infilled,
        "LFBR" => braced,
        _ => dual,
    };
    match material {
        "CR" | "C99" | "CU" | "SRC" if precast => Ok(of("PC1", "PC2", "PC2", "PC2", "PC2")),
        "CR" | "C99" | "CU" | "SRC" => Ok(of("C2", "C1", "C3", "C2", "C2")),
        "S" | "S99" | "SL" | "SR" | "SO" => Ok(of("S4", "S1", "S5", "S2", "S4")),
        "W" | "W99" | "WLI" => Ok(if matches!(system, "LWAL" | "") {
            "W1"
        } else {
            "W2"
        }),
        "WHE" | "WO" | "WS" | "WWD" => Ok("W2"),
        "MR" => Ok("RM1"),
        "MUR" | "M99" | "MCF" | "E" | "E99" | "EU" | "ER" => Ok("URM"),
        _ => Err(format!(
            "material \"{material}\" of \"{text}\" is not understood: CR, S, W, MR, MUR, MCF or E"
        )),
    }
}
