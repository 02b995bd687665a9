//! Floor spectra in a few lines of the summary.

use std::fmt::Write;

use jostle::results::floor_spectra::{FloorSpectra, FloorSpectrum};
use jostle_io::shown::ACCELERATION;

/// For every building the floor with the greatest spectrum, and for the first damping ratio.
pub(crate) fn write_floor_spectra(text: &mut String, found: &FloorSpectra) -> std::fmt::Result {
    let strength = |floor: &&FloorSpectrum| {
        let curve = floor.response.spectra.first();
        let at = curve.and_then(|curve| Some((curve, curve.strongest()?)));
        at.map_or(0.0, |(curve, index)| curve.pseudo_acceleration_m_s2[index])
    };
    let mut names: Vec<&str> = found.floors.iter().map(|f| &f.building[..]).collect();
    names.dedup();
    let filtered = format!("below {} Hz", found.filter.corner_hz);
    if !text.ends_with("\n\n") {
        writeln!(text)?;
    }
    writeln!(
        text,
        "{:20}  {:>19}  {filtered:>19}  {:>28}  {:>15}",
        "floor spectra", "peak acceleration", "greatest pseudo-acceleration", "ratio at most"
    )?;
    let pair = |with: f64, before: Option<f64>| match before {
        Some(before) => format!(
            "{} ({}) {}",
            ACCELERATION.number(with, 2),
            ACCELERATION.number(before, 2),
            ACCELERATION.name()
        ),
        None => ACCELERATION.text(with, 2),
    };
    for name in names {
        let floors = found.floors.iter().filter(|floor| floor.building == name);
        let Some(floor) = floors.max_by(|a, b| strength(a).total_cmp(&strength(b))) else {
            continue;
        };
        let (with, before) = (&floor.response, floor.without_contact.as_ref());
        let Some((curve, index)) = with.spectra.first().and_then(|c| Some((c, c.strongest()?)))
        else {
            continue;
        };
        let ratio = floor
            .greatest_ratio(0)
            .map_or_else(String::new, |(at, ratio)| {
                format!("{ratio:.2} at {:.2} s", found.periods_s[at])
            });
        writeln!(
            text,
            "{:20}  {:>19}  {:>19}  {:>28}  {ratio:>15}",
            format!("{name}, floor {}", floor.floor),
            pair(
                with.peak_acceleration_m_s2,
                before.map(|b| b.peak_acceleration_m_s2)
            ),
            pair(
                with.filtered_peak_acceleration_m_s2,
                before.map(|b| b.filtered_peak_acceleration_m_s2)
            ),
            format!(
                "{} at {:.2} s, {:.0} %",
                pair(
                    curve.pseudo_acceleration_m_s2[index],
                    before
                        .and_then(|b| b.spectra.first())
                        .map(|b| b.pseudo_acceleration_m_s2[index])
                )
                .replace(&format!(" {}", ACCELERATION.name()), ""),
                found.periods_s[index],
                100.0 * curve.damping
            ),
        )?;
    }
    Ok(())
}
