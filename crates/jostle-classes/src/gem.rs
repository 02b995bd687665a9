//! Taxonomy strings of GEM.

use crate::level::Level;

/// What a taxonomy string says beside the material and the lateral system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GemFacts {
    /// `CDN`, `CDL`, `CDM`, `CDH`: no code, low, moderate, high.
    pub level: Option<Level>,
    /// Storeys above the ground: `HEX:3`, `HAPP:3`, or the middle of `HBET:3,5`.
    pub storeys: Option<usize>,
    /// Year of construction: `YEX:1990`, `YAPP:1990`, or the middle of `YBET:1980,1990`.
    pub year: Option<i32>,
}

impl GemFacts {
    /// Of a text with slashes or plus signs; other texts say nothing.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let mut found = Self::default();
        if !text.contains(['/', '+']) {
            return found;
        }
        let upper = text.to_uppercase();
        for part in upper.split(['/', '+']).map(str::trim) {
            let (key, value) = part.split_once(':').unwrap_or((part, ""));
            let middle = || {
                let numbers = value
                    .split([',', '-'])
                    .map(|word| word.trim().parse::<u16>());
                let numbers: Option<Vec<u16>> = numbers.map(Result::ok).collect();
                let numbers = numbers.filter(|numbers| numbers.len() <= 2)?;
                let sum: u32 = numbers.iter().map(|number| u32::from(*number)).sum();
                // Of two neighbours, the greater one.
                let count = numbers.len() as u32;
                u16::try_from(sum.div_ceil(count))
                    .ok()
                    .filter(|middle| *middle > 0)
            };
            match key {
                "CDN" => found.level = Some(Level::Pre),
                "CDL" => found.level = Some(Level::Low),
                "CDM" => found.level = Some(Level::Moderate),
                "CDH" => found.level = Some(Level::High),
                "HEX" | "HAPP" | "HBET" => found.storeys = middle().map(usize::from),
                "YEX" | "YAPP" | "YBET" => found.year = middle().map(i32::from),
                _ => {}
            }
        }
        found
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facts_of_strings() {
        let of = |text: &str| {
            let found = GemFacts::of(text);
            (found.level, found.storeys, found.year)
        };
        assert_eq!(of("CR/LFINF+CDN/HEX:3"), (Some(Level::Pre), Some(3), None));
        assert_eq!(
            of("DX/CR+PC/LFM+CDH+DUC/YEX:1990/HBET:4,6+HBEX:1"),
            (Some(Level::High), Some(5), Some(1990))
        );
        assert_eq!(
            of("MUR/LWAL+CDM/HBET:2-1"),
            (Some(Level::Moderate), Some(2), None)
        );
        assert_eq!(
            of("S/LFBR+CDL/HEX:many/YPRE:1960"),
            (Some(Level::Low), None, None)
        );
        assert_eq!(of("C1M"), (None, None, None));
        assert_eq!(of("HEX:3"), (None, None, None));
    }
}
