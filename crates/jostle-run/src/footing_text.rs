//! What a run says of foundations that lift off.

use std::fmt::Write as _;

use jostle::results::summary::BuildingSummary;
use jostle_io::shown::{ENERGY, FORCE, LENGTH, PRESSURE};
use jostle_report::footing_name;

/// Foundations and feet of columns that can lift off, one line each.
pub(crate) fn write(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for part in buildings.iter().flat_map(|building| &building.parts) {
        let Some(share) = part.lifted_share else {
            continue;
        };
        let pressure = part.pressure_max_pa.map_or_else(String::new, |pressure| {
            format!(", {} over its strip", PRESSURE.text(pressure, 0))
        });
        let settled = part.settlement_m.filter(|settled| *settled > 0.0);
        let settled = settled.map_or_else(String::new, |settled| {
            format!(
                "; the ground settles by {} and dissipates {}",
                LENGTH.text(settled, 2),
                ENERGY.text(part.dissipated_j, 1)
            )
        });
        writeln!(
            text,
            "\n{}: uplift up to {}, off the ground {:.1} % of the time; up to {} per spring{pressure}{settled}",
            footing_name(&part.name),
            LENGTH.text(part.deformation_max, 2),
            100.0 * share,
            FORCE.text(-part.force_min_n, 0)
        )?;
    }
    Ok(())
}
