//! What `jostle check` says of foundations and bearings.

use std::fmt::Write as _;

use jostle::{BedSpring, Foundation};
use jostle_io::shown::{FORCE, HEIGHT, LENGTH, MASS, MOMENT, PRESSURE};

use crate::numbers::prefixed;

/// Dimensions and mass of a foundation.
fn describe_plate(text: &mut String, foundation: &Foundation) -> std::fmt::Result {
    let depth = match foundation.embedment > 0.0 {
        true => format!(", {} deep", HEIGHT.text(foundation.embedment, 2)),
        false => String::new(),
    };
    writeln!(
        text,
        "  foundation {} x {}{depth}, {}",
        HEIGHT.number(foundation.length, 2),
        HEIGHT.text(foundation.width, 2),
        MASS.text(foundation.mass, 1)
    )
}

/// The foundation of a building with a plan: springs and dashpots in both directions, and what they do to the fundamental modes.
pub(super) fn describe_foundation_in_plan(
    text: &mut String,
    plan: &jostle::system::FoundationInPlan,
    mass: f64,
    bed: &[BedSpring],
) -> std::fmt::Result {
    describe_plate(text, &plan.foundation)?;
    let springs = &plan.springs;
    let directions = [("along x", &springs.along), ("across", &springs.across)];
    for (direction, springs) in directions {
        let sway = match springs.sway_stiffness {
            0.0 => "held".to_owned(),
            stiffness => format!(
                "{} and {}",
                prefixed(stiffness, "N/m", 3),
                prefixed(springs.sway_damping, "N·s/m", 3)
            ),
        };
        writeln!(
            text,
            "  soil {direction}: sway {sway}, rocking {} and {}",
            prefixed(springs.rocking_stiffness, "N·m/rad", 3),
            prefixed(springs.rocking_damping, "N·m·s/rad", 3)
        )?;
    }
    let [stiffness, damping] = springs.torsion;
    let torsion = match stiffness {
        0.0 => "held".to_owned(),
        stiffness => format!(
            "{} and {}",
            prefixed(stiffness, "N·m/rad", 3),
            prefixed(damping, "N·m·s/rad", 3)
        ),
    };
    writeln!(text, "  soil in torsion: {torsion}")?;
    for (axis, (direction, _)) in directions.into_iter().enumerate() {
        writeln!(
            text,
            "  first period {direction} {:.3} s instead of {:.3} s on rigid ground ({:.3} times), damping {:.2} % instead of {:.2} %",
            plan.periods[axis],
            plan.fixed_periods[axis],
            plan.periods[axis] / plan.fixed_periods[axis],
            100.0 * plan.damping[axis],
            100.0 * plan.fixed_damping[axis]
        )?;
    }
    let Some(last) = bed.last() else {
        return Ok(());
    };
    let weight = jostle_io::STANDARD_GRAVITY * mass;
    let moment = MOMENT.name();
    for ((direction, springs), reach) in directions.into_iter().zip([last.at, last.across]) {
        let lifting = springs.rocking_stiffness * weight / (springs.vertical_stiffness * reach);
        writeln!(
            text,
            "  lifts off {direction}: contact springs to {} from the middle; the edge lifts at an overturning moment of {} {moment}, overturning capacity W·b = {} {moment}",
            HEIGHT.text(reach, 2),
            MOMENT.number(lifting, 0),
            MOMENT.number(weight * reach, 0)
        )?;
    }
    writeln!(
        text,
        "  {} contact springs, vertical {} and {} (W {})",
        bed.len(),
        prefixed(springs.along.vertical_stiffness, "N/m", 3),
        prefixed(springs.along.vertical_damping, "N·s/m", 3),
        FORCE.text(weight, 0)
    )?;
    describe_bearing(text, &plan.foundation, weight, bed)
}

/// Pressure of self weight on springs that can yield, and how many do so under it.
fn describe_bearing(
    text: &mut String,
    foundation: &Foundation,
    weight: f64,
    bed: &[BedSpring],
) -> std::fmt::Result {
    let bearing = foundation.uplift.as_ref().and_then(|uplift| uplift.bearing);
    let Some(bearing) = bearing else {
        return Ok(());
    };
    let stiffness: f64 = bed.iter().map(|spring| spring.stiffness).sum();
    let area: f64 = bed.iter().map(|spring| spring.area).sum();
    let pressure = |spring: &BedSpring| weight * spring.stiffness / (stiffness * spring.area);
    let over = bed
        .iter()
        .filter(|spring| pressure(spring) > bearing.strength);
    let mean = PRESSURE.text(weight / area, 0);
    let strength = PRESSURE.text(bearing.strength, 0);
    match over.count() {
        0 => writeln!(
            text,
            "  self weight presses with {mean} on average, bearing strength {strength}"
        ),
        over => writeln!(
            text,
            "  self weight presses with {mean} on average, but on {over} of {} contact springs with more than the bearing strength of {strength}: they yield before shaking begins. The outermost springs attract weight to match the rocking stiffness of the soil; ends = 1 spreads it evenly",
            bed.len()
        ),
    }
}

/// Foundation, springs and dashpots of the soil, and what they do to the first mode.
pub(super) fn describe_foundation(
    text: &mut String,
    place: &jostle::system::FoundationPlace,
    mass: f64,
    bed: &[BedSpring],
) -> std::fmt::Result {
    let (foundation, springs) = (&place.foundation, &place.springs);
    describe_plate(text, foundation)?;
    let sway = match place.sway {
        Some(_) => format!(
            "sway {} and {}",
            prefixed(springs.sway_stiffness, "N/m", 3),
            prefixed(springs.sway_damping, "N·s/m", 3)
        ),
        None => "sway held".to_owned(),
    };
    writeln!(
        text,
        "  soil: {sway}, rocking {} and {}",
        prefixed(springs.rocking_stiffness, "N·m/rad", 3),
        prefixed(springs.rocking_damping, "N·m·s/rad", 3)
    )?;
    writeln!(
        text,
        "  first period {:.3} s instead of {:.3} s on rigid ground ({:.3} times), damping {:.2} % instead of {:.2} %",
        place.period,
        place.fixed_period,
        place.period / place.fixed_period,
        100.0 * place.damping,
        100.0 * place.fixed_damping
    )?;
    let Some(reach) = bed.last().map(|bed| bed.at) else {
        return Ok(());
    };
    // The outermost spring lifts off where its shortening under the weight is used up, θ = W/(K_z b).
    let weight = jostle_io::STANDARD_GRAVITY * mass;
    let moment = MOMENT.name();
    let lifting = springs.rocking_stiffness * weight / (springs.vertical_stiffness * reach);
    writeln!(
        text,
        "  lifts off: {} contact springs to {} from the middle, vertical {} and {}; the edge lifts at an overturning moment of {} {moment}; overturning capacity W·b = {} {moment} (W {})",
        bed.len(),
        HEIGHT.text(reach, 2),
        prefixed(springs.vertical_stiffness, "N/m", 3),
        prefixed(springs.vertical_damping, "N·s/m", 3),
        MOMENT.number(lifting, 0),
        MOMENT.number(weight * reach, 0),
        FORCE.text(weight, 0)
    )?;
    describe_bearing(text, foundation, weight, bed)
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
        .map(|at| format!("({})", at.map(|own| HEIGHT.number(own, 2)).join(", ")))
        .collect();
    let more = if places.len() > MOST_PLACES {
        ", …"
    } else {
        ""
    };
    let each = FORCE.text(weight / places.len() as f64, 0);
    let what = if given {
        format!("{} bearings with {each} each", places.len())
    } else {
        "four bearings stand for an even spread".to_owned()
    };
    writeln!(
        text,
        "  {what}, at {}{more} {}",
        listed.join(", "),
        HEIGHT.name()
    )
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
        "  {} bearings under a mat of {}, with a weight of {}",
        isolation.isolator.name(),
        MASS.text(isolation.mat_mass, 1),
        FORCE.text(mat.weight, 0)
    )?;
    if let Some([stiffness, ratio]) = isolation.isolator.equivalent(mat.weight, amplitude) {
        let mass = mat.weight / jostle_io::STANDARD_GRAVITY;
        let omega = (stiffness / mass).sqrt();
        writeln!(
            text,
            "  at {} as linear bearings of {} with {:.1} % damping: a period of {:.2} s",
            LENGTH.text(amplitude, 0),
            prefixed(stiffness, "N/m", 3),
            100.0 * (ratio + mat.dashpot / (2.0 * mass * omega)),
            std::f64::consts::TAU / omega
        )?;
    }
    Ok(())
}
