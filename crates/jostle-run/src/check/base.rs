//! What `jostle check` says of foundations and bearings.

use std::fmt::Write as _;

use jostle::BedSpring;

use super::short;

/// Foundation, springs and dashpots of the soil, and what they do to the first mode.
pub(super) fn describe_foundation(
    text: &mut String,
    own: &jostle::system::FoundationPlace,
    mass: f64,
    bed: &[BedSpring],
) -> std::fmt::Result {
    let (foundation, springs) = (&own.foundation, &own.springs);
    let depth = match foundation.embedment > 0.0 {
        true => format!(", {:.2} m deep", foundation.embedment),
        false => String::new(),
    };
    writeln!(
        text,
        "  foundation {:.2} x {:.2} m{depth}, {:.1} t",
        foundation.length,
        foundation.width,
        foundation.mass * 1e-3
    )?;
    let sway = match own.sway {
        Some(_) => format!(
            "sway {} N/m and {} N.s/m",
            short(springs.sway_stiffness),
            short(springs.sway_damping)
        ),
        None => "sway held".to_owned(),
    };
    writeln!(
        text,
        "  soil: {sway}, rocking {} N.m/rad and {} N.m.s/rad",
        short(springs.rocking_stiffness),
        short(springs.rocking_damping)
    )?;
    writeln!(
        text,
        "  first period {:.3} s instead of {:.3} s on rigid ground ({:.3} times), damping {:.2} % instead of {:.2} %",
        own.period,
        own.fixed_period,
        own.period / own.fixed_period,
        100.0 * own.damping,
        100.0 * own.fixed_damping
    )?;
    let Some(reach) = bed.last().map(|own| own.at) else {
        return Ok(());
    };
    // The outermost spring lifts off where its shortening under the weight is used up, θ = W/(K_z b).
    let weight = jostle_io::STANDARD_GRAVITY * mass;
    let lifting = springs.rocking_stiffness * weight / (springs.vertical_stiffness * reach);
    writeln!(
        text,
        "  lifts off: {} contact springs to {:.2} m from the middle, vertical {} N/m and {} N.s/m; the edge lifts at an overturning moment of {:.0} kN.m, and {:.0} kN.m = W b is the most it can bear (W {:.0} kN)",
        bed.len(),
        reach,
        short(springs.vertical_stiffness),
        short(springs.vertical_damping),
        lifting * 1e-3,
        weight * reach * 1e-3,
        weight * 1e-3
    )
}

/// Amplitude at which the equivalent linear bearings are given, where there is no limit \[m\].
const AMPLITUDE: f64 = 0.1;

/// Where bearings stand in plan.
pub(super) fn describe_bearing_places(
    text: &mut String,
    places: &[[f64; 2]],
    weight: f64,
    given: bool,
) -> std::fmt::Result {
    let listed: Vec<String> = places
        .iter()
        .take(MOST_PLACES)
        .map(|[x, y]| format!("({x:.2}, {y:.2})"))
        .collect();
    let more = if places.len() > MOST_PLACES {
        ", …"
    } else {
        ""
    };
    let each = weight * 1e-3 / places.len() as f64;
    let what = if given {
        format!("{} bearings with {each:.0} kN each", places.len())
    } else {
        "four bearings stand for an even spread".to_owned()
    };
    writeln!(text, "  {what}, at {}{more} m", listed.join(", "))
}

/// Bearings whose places are listed.
const MOST_PLACES: usize = 8;

/// Bearings, and the linear ones that take their place at an amplitude (theory, Eq. B7).
pub(super) fn describe_bearings(
    text: &mut String,
    mat: &jostle::structure::Mat,
) -> std::fmt::Result {
    let isolation = &mat.isolation;
    let amplitude = isolation.limit.unwrap_or(AMPLITUDE);
    writeln!(
        text,
        "  {} bearings under a mat of {:.1} t, with a weight of {:.0} kN",
        isolation.isolator.name(),
        isolation.mat_mass * 1e-3,
        mat.weight * 1e-3
    )?;
    if let Some([stiffness, ratio]) = isolation.isolator.equivalent(mat.weight, amplitude) {
        let mass = mat.weight / jostle_io::STANDARD_GRAVITY;
        let omega = (stiffness / mass).sqrt();
        writeln!(
            text,
            "  at {:.0} mm as linear bearings of {} N/m with {:.1} % damping: a period of {:.2} s",
            amplitude * 1e3,
            short(stiffness),
            100.0 * (ratio + mat.dashpot / (2.0 * mass * omega)),
            std::f64::consts::TAU / omega
        )?;
    }
    Ok(())
}
