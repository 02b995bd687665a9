//! Taxonomy strings of GEM.

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
