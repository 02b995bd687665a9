//! Taxonomy strings of GEM.

use crate::level::Level;

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
pub(crate) fn gem_family(text: &str) -> Result<&'static str, String> {
    let upper = text.to_uppercase();
    let mut attributes = upper.split('/');
    // A direction may stand first.
    let first = attributes
        .find(|attribute| !attribute.starts_with('D'))
        .unwrap_or_default();
    let mut parts = first.split('+');
    let material = parts.next().unwrap_or_default();
    let precast = parts.any(|part| part == "PC" || part == "PCPS");
    let systems: Vec<&str> = attributes
        .filter(|attribute| attribute.starts_with('L'))
        .filter_map(|attribute| attribute.split('+').next())
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

/// What a taxonomy string of GEM says besides the family.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GemFacts {
    /// Level of the code by which it is designed: `CDN` none, `CDL`, `CDM`, `CDH`.
    pub level: Option<Level>,
    /// Storeys above the ground: `HEX:3`, `H:3`, about `HAPP:3`, the middle of `HBET:2-4`.
    pub storeys: Option<usize>,
    /// Year of construction: `YEX:1975`, `Y:1975`, about `YAPP:1975`.
    pub year: Option<i32>,
}

impl GemFacts {
    /// Reads them; text without a slash is no taxonomy string.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let mut facts = Self::default();
        if !text.contains('/') {
            return facts;
        }
        for part in text.to_uppercase().split(['/', '+']) {
            match part.trim().split_once(':') {
                None => match part.trim() {
                    "CDN" => facts.level = Some(Level::Pre),
                    "CDL" => facts.level = Some(Level::Low),
                    "CDM" => facts.level = Some(Level::Moderate),
                    "CDH" => facts.level = Some(Level::High),
                    _ => {}
                },
                Some(("H" | "HEX" | "HAPP" | "HBET", value)) => {
                    let between: Option<Vec<usize>> = value
                        .split([',', '-'])
                        .map(|number| number.trim().parse().ok())
                        .collect();
                    facts.storeys = match between.as_deref() {
                        Some([storeys]) => Some(*storeys),
                        Some([least, most]) => Some(usize::midpoint(*least, *most)),
                        _ => None,
                    };
                    facts.storeys = facts.storeys.filter(|storeys| (1..=200).contains(storeys));
                }
                Some(("Y" | "YEX" | "YAPP", value)) => {
                    let year = value.trim().parse().ok();
                    facts.year = year.filter(|year| (1000..2200).contains(year));
                }
                Some(_) => {}
            }
        }
        facts
    }
}
