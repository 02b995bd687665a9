//! Ends of columns that are made of fibres, in words.

use std::fmt::Write as _;

use jostle::results::summary::{BuildingSummary, FibreSummary};
use jostle_io::shown::FORCE;

use crate::numbers::counted;

/// What the ends of columns that are made of fibres went through.
pub(crate) fn write_sections(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for building in buildings {
        let all = &building.sections;
        let Some(worst) = all.iter().max_by(|a, b| {
            let strain = |own: &FibreSummary| own.concrete_strain.unwrap_or(0.0);
            strain(a).total_cmp(&strain(b))
        }) else {
            continue;
        };
        let count = |has: fn(&FibreSummary) -> bool| all.iter().filter(|own| has(own)).count();
        writeln!(
            text,
            "\nColumns of {}: bars yielded at {} of {}, concrete passed its strength at {}; {:.2} ‰ of compression in {}, under {} to {}",
            building.name,
            count(|own| own.yielded_s.is_some()),
            counted(all.len(), "end"),
            count(|own| own.crushed_s.is_some()),
            1e3 * worst.concrete_strain.unwrap_or(0.0),
            worst.name,
            FORCE.number(-worst.axial_max_n, 0),
            FORCE.text(-worst.axial_min_n, 0),
        )?;
    }
    Ok(())
}
