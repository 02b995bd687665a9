//! Ends of columns that are made of fibres, in words.

use std::fmt::Write as _;

use jostle::FibreLimit;
use jostle::results::summary::{BuildingSummary, FibreSummary};
use jostle_io::shown::FORCE;

use crate::numbers::counted;

/// What the ends of columns that are made of fibres went through.
pub(crate) fn write_sections(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for building in buildings {
        let all = &building.sections;
        let Some(worst) = all.iter().max_by(|a, b| {
            let strain = |fibre: &FibreSummary| fibre.concrete_strain.unwrap_or(0.0);
            strain(a).total_cmp(&strain(b))
        }) else {
            continue;
        };
        let count =
            |has: fn(&FibreSummary) -> bool| all.iter().filter(|section| has(section)).count();
        if worst.concrete_strain.is_none() && worst.steel_strain.is_none() {
            write_surfaces(text, building, count(|own| own.yielded_s.is_some()))?;
            continue;
        }
        writeln!(
            text,
            "\nFibre sections of {}: bars yielded at {} of {}, concrete passed its strength at {}; {:.2} ‰ of compression in {}, under {} to {}",
            building.name,
            count(|own| own.yielded_s.is_some()),
            counted(all.len(), "end"),
            count(|own| own.crushed_s.is_some()),
            1e3 * worst.concrete_strain.unwrap_or(0.0),
            worst.name,
            FORCE.number(-worst.axial_max_n, 0),
            FORCE.text(-worst.axial_min_n, 0),
        )?;
        write_limits(text, all)?;
    }
    Ok(())
}

/// What ends that yield on a surface went through.
fn write_surfaces(
    text: &mut String,
    building: &BuildingSummary,
    yielded: usize,
) -> std::fmt::Result {
    let all = &building.sections;
    let rotation = |end: &FibreSummary| end.rotation_max_rad.max(-end.rotation_min_rad);
    let Some(worst) = all
        .iter()
        .max_by(|a, b| rotation(a).total_cmp(&rotation(b)))
    else {
        return Ok(());
    };
    let first = all.iter().filter_map(|end| end.yielded_s);
    let first = first.reduce(f64::min);
    let first = first.map_or_else(String::new, |at| format!(", first at {at:.3} s"));
    writeln!(
        text,
        "\nColumns of {}: {yielded} of {} yielded on their surface of axial force and moment{first}; {:.2} mrad in {}, under {} to {}",
        building.name,
        counted(all.len(), "end"),
        1e3 * rotation(worst),
        worst.name,
        FORCE.number(-worst.axial_max_n, 0),
        FORCE.text(-worst.axial_min_n, 0),
    )
}

/// Which strains that are judged were passed, where first, and how near the nearest of the others came.
fn write_limits(text: &mut String, all: &[FibreSummary]) -> std::fmt::Result {
    for limit in FibreLimit::ALL {
        let judged = || {
            let pairs = all
                .iter()
                .flat_map(|fibre| fibre.limits.iter().map(move |limit| (fibre, limit)));
            pairs.filter(|(_, candidate)| candidate.limit == limit)
        };
        let Some((worst, nearest)) = judged().max_by(|a, b| a.1.ratio().total_cmp(&b.1.ratio()))
        else {
            continue;
        };
        let what = in_words(limit);
        let passed = judged().filter_map(|(end, limit)| Some((limit.passed_s?, end)));
        let first = passed.clone().min_by(|a, b| a.0.total_cmp(&b.0));
        let ends = counted(judged().count(), "end");
        match first {
            Some((at, end)) => writeln!(
                text,
                "  {what} at {} of {ends}, first at {at:.3} s in {}; strain up to {:.2} times its limit of {:.2} ‰, in {}",
                passed.count(),
                end.name,
                nearest.ratio(),
                1e3 * nearest.strain_limit,
                worst.name,
            )?,
            None => writeln!(
                text,
                "  {what} at none of {ends}; strain up to {:.2} times its limit of {:.2} ‰, in {}",
                nearest.ratio(),
                1e3 * nearest.strain_limit,
                worst.name,
            )?,
        }
    }
    Ok(())
}

fn in_words(limit: FibreLimit) -> &'static str {
    match limit {
        FibreLimit::Spalling => "cover spalls",
        FibreLimit::Crushing => "core is crushed",
        FibreLimit::Buckling => "bars stretch to buckle",
        FibreLimit::Fracture => "bars break",
    }
}
