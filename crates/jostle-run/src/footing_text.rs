//! What a run says of foundations that lift off.

use std::fmt::Write as _;

use jostle::results::summary::BuildingSummary;

/// Foundations and feet of columns that can lift off, one line each.
pub(crate) fn write(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for own in buildings.iter().flat_map(|building| &building.parts) {
        let Some(share) = own.lifted_share else {
            continue;
        };
        let pressure = own.pressure_max_pa.map_or_else(String::new, |pressure| {
            format!(", {:.0} kPa", pressure / 1e3)
        });
        let settled = own.settlement_m.filter(|settled| *settled > 0.0);
        let settled = settled.map_or_else(String::new, |settled| {
            format!(
                "; the ground settles by {:.2} mm and dissipates {:.1} kJ",
                settled * 1e3,
                own.dissipated_j / 1e3
            )
        });
        writeln!(
            text,
            "\n{}: rises by up to {:.2} mm, off the ground {:.1} % of the time; a spring bears up to {:.0} kN{pressure}{settled}",
            own.name,
            own.deformation_max * 1e3,
            100.0 * share,
            -own.force_min_n / 1e3
        )?;
    }
    Ok(())
}
