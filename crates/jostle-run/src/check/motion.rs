//! What `jostle check` says of the ground motion: grounds that differ, and expected work.

use std::fmt::Write as _;

use crate::numbers::grouped;
use crate::style::{BOLD, styled};
use jostle::{GroundMotion, Plan, Solver, System};
use jostle_io::shown::ACCELERATION;

use super::decimals;

/// One line for the ground under every building and wall, where they differ.
pub(super) fn describe_grounds(
    text: &mut String,
    system: &System,
    motion: &GroundMotion,
) -> std::fmt::Result {
    let Some(grounds) = &motion.grounds else {
        return Ok(());
    };
    writeln!(text, "{}", styled(BOLD, "Grounds"))?;
    for (index, ground) in grounds.own.iter().enumerate() {
        let record = ground.motion.as_ref().map_or(String::new(), |motion| {
            format!(
                ", own motion with a peak of {}",
                ACCELERATION.text(motion.peak(), 3)
            )
        });
        let vertical = ground.vertical.as_ref().map_or(String::new(), |vertical| {
            format!(
                ", vertical with a peak of {}",
                ACCELERATION.text(vertical.peak(), 3)
            )
        });
        writeln!(
            text,
            "  {}: the motion arrives after {} ms{record}{vertical}",
            system.side_name(Some(index)),
            decimals(1e3 * ground.arrival, 1)
        )?;
    }
    writeln!(text)
}

pub(super) fn describe_work(
    text: &mut String,
    system: &System,
    plan: &Plan,
    duration: f64,
) -> std::fmt::Result {
    let exact = match plan.solver {
        Solver::Modal => Some("modal stepping, exact between the points of the record"),
        Solver::Series => Some("power series in time, exact between changes of stiffness"),
        Solver::Riccati | Solver::Stiffness | Solver::Product => None,
    };
    match exact {
        Some(words) => writeln!(text, "  {words}")?,
        None => writeln!(text, "  {}, {}", plan.solver.name(), plan.integrator)?,
    }
    let steps = (duration / plan.step).ceil() as u64;
    writeln!(
        text,
        "  {} steps of {} ms through {duration:.2} s, more during contact{}",
        grouped(steps),
        decimals(plan.step * 1e3, 4),
        if exact.is_some() {
            " and for history output"
        } else {
            ""
        }
    )?;
    let links = system.links.len();
    if links > 0 {
        let those = if links == 1 {
            "link or damper"
        } else {
            "links and dampers"
        };
        writeln!(text, "  {links} {those} solved together in every step")?;
    }
    Ok(())
}
