//! The summary of a run on one screen.

use std::fmt::Write;
use std::path::Path;

use jostle::Building;
use jostle::linear::sort_by;
use jostle::model::RotationLevel;
use jostle::results::contact_sensitivity::ContactSensitivity;
use jostle::results::gradient::Gradient;
use jostle::results::isolation_bounds::{Bounded, IsolationBounds};
use jostle::results::summary::{
    BuildingSummary, ContactSummary, ExceededSummary, GapSummary, ImpactPlace, LinkSummary,
    ShearFailure, Summary,
};
use jostle::separation::Requirements;
use jostle_io::shown::{
    ACCELERATION, ENERGY, FORCE, GROUND_ACCELERATION, HEIGHT, IMPULSE, LENGTH, MASS, MOMENT, Shown,
    by_model,
};
use jostle_io::{Input, in_shown_units};
use jostle_report::{Extremes, changes, damage};

use crate::checks_text::write_findings;
use crate::codes_text::{is_moat, write_codes};
use crate::floor_spectra::low_pass;
use crate::floor_spectra_text::write_floor_spectra;
use crate::numbers::{counted, counted_grouped, grouped, kn, mm};
use crate::parts_text::write_parts;
use crate::sections_text::write_sections;
use crate::style::{BOLD, DIM, LOUD, styled};

/// Contacts listed at most.
const LISTED: usize = 10;
/// The name of a wall beside a gap.
const WALL: &str = "wall";

/// The summary of a run on one screen, as `jostle run` prints it, without colours.
#[must_use]
pub fn summary_text(summary: &Summary, input: &Input) -> String {
    anstream::adapter::strip_str(&describe_summary(summary, input, None)).to_string()
}

/// The summary of a run on one screen, with styles; `result` is the file to open next.
#[must_use]
pub fn describe_summary(summary: &Summary, input: &Input, result: Option<&Path>) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = by_model(input.units, || write_all(&mut text, summary, input, result));
    text
}

fn write_all(
    text: &mut String,
    summary: &Summary,
    input: &Input,
    result: Option<&Path>,
) -> std::fmt::Result {
    let motion = &summary.motion;
    writeln!(text, "{}", styled(BOLD, &summary.title))?;
    let reversed = if motion.scale < 0.0 { ", reversed" } else { "" };
    let in_g = match GROUND_ACCELERATION.name() {
        "g" => String::new(),
        _ => format!(" ({:.3} g)", motion.pga_m_s2 / jostle_io::STANDARD_GRAVITY),
    };
    writeln!(
        text,
        "{}{reversed}, peak {}{in_g}, {:.2} s",
        motion.name,
        GROUND_ACCELERATION.text(motion.pga_m_s2, 1),
        motion.duration_s
    )?;
    if let (Some(across), Some(peak)) = (&motion.across, motion.pga_across_m_s2) {
        let peak = GROUND_ACCELERATION.text(peak, 1);
        writeln!(text, "{across} at a right angle, peak {peak}")?;
    }
    if let Some(reason) = &summary.ended_early {
        writeln!(
            text,
            "\n{}",
            styled(LOUD, &format!("ended early: {reason}"))
        )?;
    }
    let corner = low_pass(input.floor_spectra.as_ref());
    write_buildings(text, &summary.buildings, corner)?;
    write_in_plan(text, &summary.buildings)?;
    write_isolation(text, summary)?;
    write_storey_shears(text, &summary.buildings)?;
    write_foundations(text, summary)?;
    write_damage(text, &input.model.buildings, &summary.buildings)?;
    write_shear_failures(text, &summary.buildings)?;
    write_rotation_levels(text, &summary.buildings)?;
    write_parts(text, &summary.buildings)?;
    write_sections(text, &summary.buildings)?;
    write_capacity(text, &summary.buildings)?;
    let are_named = !input.codes.shown.is_empty();
    let mut asks_for_codes = false;
    for (index, gap) in summary.gaps.iter().enumerate() {
        let required = summary.required_gaps(&input.model, index, &input.codes);
        let has_rules = required.rules.iter().any(|rule| rule.code.is_some());
        asks_for_codes |= !are_named && has_rules && !is_moat(&input.model, index);
        write_gap(text, gap, summary, are_named.then_some(&required))?;
    }
    if let Some(spread) = &summary.contact_sensitivity {
        write_spread(text, spread)?;
    }
    write_gradients(text, &summary.gradients)?;
    if let Some(bounds) = &summary.isolation_bounds {
        write_bounds(text, bounds)?;
    }
    for link in &summary.links {
        write_link(text, link)?;
    }
    if summary.gaps.iter().any(|gap| gap.impact_count > 0) {
        write_changes(text, &summary.buildings)?;
    }
    if let Some(found) = &summary.floor_spectra {
        write_floor_spectra(text, found)?;
    }
    // A blank line before what follows.
    if !text.ends_with("\n\n") {
        writeln!(text)?;
    }
    let before = text.len();
    for warning in &summary.warnings {
        let warning = in_shown_units(warning);
        writeln!(text, "{} {warning}", styled(LOUD, "warning:"))?;
    }
    let rest = match result {
        Some(path)
            if path
                .extension()
                .is_some_and(|extension| extension == "html") =>
        {
            "the report"
        }
        _ => "summary.json",
    };
    write_findings(text, &summary.checks, rest)?;
    for note in &summary.notes {
        let note = in_shown_units(note);
        writeln!(text, "{} {note}", styled(DIM, "note:"))?;
    }
    if asks_for_codes {
        writeln!(
            text,
            "No code selected: list codes in show under [codes], or run jostle gap."
        )?;
    }
    if text.len() > before {
        writeln!(text)?;
    }
    let (energy, work) = (&summary.energy, &summary.work);
    let accounting = format!(
        "energy balance {:.0e} · {} · {} steps of {:.3} ms ({} in contact{}) · {} · {} · {:.3} s",
        energy.worst_imbalance,
        work.solver,
        grouped(work.steps),
        work.step_s * 1e3,
        grouped(work.contact_steps),
        match work.halved_steps {
            0 => String::new(),
            halved => format!(", {} halved", grouped(halved)),
        },
        counted_grouped(work.factorizations, "factorisation"),
        counted_grouped(work.solves, "solution"),
        work.wall_s
    );
    writeln!(text, "{}", summary.promise.in_words())?;
    writeln!(text, "{}", styled(DIM, &accounting))?;
    if let Some(result) = result {
        writeln!(text, "→ {}", styled(BOLD, &result.display().to_string()))?;
    }
    Ok(())
}

/// Greatest acceleration of any floor, and the same after the filter where there are histories.
fn accelerations(building: &BuildingSummary) -> String {
    let response = &building.response;
    let filtered = response
        .filtered_acceleration_peak_m_s2
        .map_or_else(String::new, |value| {
            format!(" ({})", ACCELERATION.number(value, 1))
        });
    format!(
        "{}{filtered} {}",
        ACCELERATION.number(response.total_acceleration_peak_m_s2, 1),
        ACCELERATION.name()
    )
}

/// What buildings with plans do across the row and in torsion.
fn write_in_plan(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    if buildings.iter().all(|building| building.in_plan.is_none()) {
        return Ok(());
    }
    let width = buildings
        .iter()
        .map(|b| b.name.chars().count())
        .fold(8, usize::max);
    writeln!(
        text,
        "\n{:width$}  {:>18}  {:>18}  {:>9}  {:>12}  {:>12}  {:>13}",
        "", "roof across", "rotation", "corner", "corner drift", "shear across", "base torque"
    )?;
    let [length, force, moment] = [LENGTH, FORCE, MOMENT].map(Shown::name);
    for building in buildings {
        let roof = building.floors.last().and_then(|floor| floor.in_plan);
        let (Some(plan), Some(roof)) = (building.in_plan, roof) else {
            continue;
        };
        writeln!(
            text,
            "{:width$}  {:>6} / {:>6} {length}  {:>+5.2} / {:>+5.2} mrad  {:>6} {length}  {:>10.2} %  {:>9} {force}  {:>8} {moment}",
            building.name,
            LENGTH.signed(roof.displacement_across_max_m, 1),
            LENGTH.signed(roof.displacement_across_min_m, 1),
            roof.rotation_max_rad * 1e3,
            roof.rotation_min_rad * 1e3,
            mm(roof.corner_displacement_peak_m),
            plan.drift_corner_peak * 100.0,
            kn(plan.base_shear_across_peak_n),
            MOMENT.number(plan.base_torque_peak_n_m, 1)
        )?;
    }
    Ok(())
}

/// One line for every building; `corner` is that of the filter of accelerations \[Hz\].
fn write_buildings(
    text: &mut String,
    buildings: &[BuildingSummary],
    corner: f64,
) -> std::fmt::Result {
    let width = buildings
        .iter()
        .map(|building| building.name.chars().count())
        .fold(8, usize::max);
    writeln!(
        text,
        "\n{:width$}  floors     mass  {:17}  {:>17}  {:>6}  {:>10}  {:>24}",
        "building",
        "periods",
        "roof",
        "drift",
        "base shear",
        format!("acceleration (< {corner} Hz)")
    )?;
    let [mass, length, force] = [MASS, LENGTH, FORCE].map(Shown::name);
    for building in buildings {
        let periods: Vec<String> = building
            .periods_s
            .iter()
            .take(3)
            .map(|period| format!("{period:.3}"))
            .collect();
        let Some(roof) = building.floors.last() else {
            continue;
        };
        writeln!(
            text,
            "{:width$}  {:6}  {:>5} {mass}  {:17}  {:>6} / {:>5} {length}  {:4.2} %  {:>7} {force}  {:>24}",
            building.name,
            building.floors.len(),
            MASS.number(building.mass_kg, 0),
            format!("{} s", periods.join(" ")),
            LENGTH.signed(roof.response.displacement_max_m, 1),
            LENGTH.signed(roof.response.displacement_min_m, 1),
            building.response.drift_peak * 100.0,
            kn(building.response.base_shear_peak_n),
            accelerations(building)
        )?;
    }
    let raised = |building: &BuildingSummary| {
        let response = &building.response;
        let filtered = response.filtered_acceleration_peak_m_s2;
        filtered.is_some_and(|filtered| filtered > response.total_acceleration_peak_m_s2)
    };
    if buildings.iter().any(raised) {
        writeln!(
            text,
            "The low-pass filtered peak (in brackets) can exceed the unfiltered one."
        )?;
    }
    Ok(())
}

/// Effect of contact on every building: peaks with contact divided by peaks without, the largest and the smallest over the height; one
/// line where there is one storey.
fn write_changes(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    const HEADING: &str = "effect of pounding (with ÷ without)";
    const LABEL: usize = "  smallest ratio".len();
    let width = buildings
        .iter()
        .map(|building| building.name.chars().count() + LABEL)
        .fold(HEADING.chars().count(), usize::max);
    let mut rows = String::new();
    for building in buildings {
        let [Some(drift), Some(shear), Some(acceleration)] = changes(building) else {
            continue;
        };
        let name = width - LABEL;
        let labels: &[&str] = match building.floors.len() {
            1 => &["ratio"],
            _ => &["largest ratio", "smallest ratio"],
        };
        for (side, label) in labels.iter().enumerate() {
            let cell = |extremes: &Extremes, place: &str| {
                let (ratio, at) = extremes[side];
                format!("{ratio:.2} ({place} {at})")
            };
            writeln!(
                rows,
                "{:name$}  {label:14}  {:>17}  {:>17}  {:>17}",
                if side == 0 { &*building.name } else { "" },
                cell(&drift, "storey"),
                cell(&shear, "storey"),
                cell(&acceleration, "floor")
            )?;
        }
    }
    if !rows.is_empty() {
        writeln!(
            text,
            "\n{HEADING:width$}  {:>17}  {:>17}  {:>17}\n{rows}",
            "storey drift", "storey shear", "acceleration"
        )?;
    }
    Ok(())
}

/// What soil does to the first mode: its period there \[s\], over that on rigid ground, and the damping on rigid ground and there.
fn on_soil([period, ratio]: [f64; 2], [fixed, damping]: [f64; 2]) -> String {
    let change = if damping < fixed { "falls" } else { "rises" };
    format!(
        "the first period lengthens from {:.3} to {period:.3} s and damping {change} from {:.2} to {:.2} %",
        period / ratio,
        100.0 * fixed,
        100.0 * damping
    )
}

/// Foundations on soil, one line each.
fn write_foundations(text: &mut String, summary: &Summary) -> std::fmt::Result {
    let mut between = "\n";
    for building in &summary.buildings {
        let Some(foundation) = &building.foundation else {
            continue;
        };
        writeln!(
            text,
            "{between}foundation of {}: {} sway, {:.3} mrad rocking; on soil, {}",
            building.name,
            LENGTH.text(foundation.sway_peak_m, 2),
            foundation.rocking_peak_rad * 1e3,
            on_soil(
                [foundation.period_s, foundation.period_ratio],
                [foundation.damping_ratio_fixed, foundation.damping_ratio],
            )
        )?;
        if let Some(plan) = &foundation.in_plan {
            writeln!(
                text,
                "  across: {} sway, {:.3} mrad rocking, {:.3} mrad torsion; on soil, {}",
                LENGTH.text(plan.sway_across_peak_m, 2),
                plan.rocking_across_peak_rad * 1e3,
                plan.torsion_peak_rad * 1e3,
                on_soil(
                    [plan.period_across_s, plan.period_ratio_across],
                    [plan.damping_ratio_across_fixed, plan.damping_ratio_across],
                )
            )?;
        }
        between = "";
    }
    Ok(())
}

/// A storey shear is named if it exceeds this multiple of the base shear \[–\].
const BEYOND_BASE_SHEAR: f64 = 1.2;

/// Storeys whose shear exceeds that of the base, one line for each building: an impact, the soil beside a basement or bearings are
/// between them.
fn write_storey_shears(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for building in buildings {
        let storeys = building.floors.iter().filter(|floor| floor.floor > 0);
        let shears = storeys.map(|floor| (floor.response.storey_shear_peak_n, floor.floor));
        let worst = shears.max_by(|a, b| a.0.total_cmp(&b.0));
        let base = building.response.base_shear_peak_n;
        if let Some((shear, storey)) = worst.filter(|(shear, _)| *shear > BEYOND_BASE_SHEAR * base)
        {
            writeln!(
                text,
                "\nstorey shear of {}: up to {} in storey {storey}, more than at the base",
                building.name,
                FORCE.text(shear, 0),
            )?;
        }
    }
    Ok(())
}

/// Bearings and walls, one line each.
fn write_isolation(text: &mut String, summary: &Summary) -> std::fmt::Result {
    for building in &summary.buildings {
        let Some(isolation) = &building.isolation else {
            continue;
        };
        let stop = isolation
            .stop_force_peak_n
            .map_or_else(String::new, |force| {
                format!(", {} on a stop", FORCE.text(force, 0))
            });
        if let Some(plan) = &isolation.in_plan {
            writeln!(
                text,
                "\nmat of {}: bearing {} of {} moves by up to {}, {} in the bearings along x and {} across{stop}, {} at the end",
                building.name,
                plan.stroke_bearing,
                plan.bearings,
                LENGTH.text(plan.stroke_peak_m, 1),
                FORCE.text(isolation.force_peak_n, 0),
                FORCE.text(plan.force_across_peak_n, 0),
                LENGTH.text(plan.residual_stroke_m, 1)
            )?;
            continue;
        }
        writeln!(
            text,
            "\nmat of {}: moves by up to {}, {} in the bearings{stop}, {} at the end",
            building.name,
            LENGTH.text(isolation.displacement_peak_m(), 1),
            FORCE.text(isolation.force_peak_n, 0),
            LENGTH.text(isolation.residual_m, 1)
        )?;
        if !isolation.stages.is_empty() {
            let travels = isolation.stages.iter();
            let travels = travels.map(|stage| {
                let travel = LENGTH.text(stage.travel_m, 0);
                format!("{} {} of {travel}", stage.name, mm(stage.travel_peak_m))
            });
            let travels = travels.collect::<Vec<_>>().join(", ");
            let rims = match isolation.reached_rims() {
                true => "; all reached their rims",
                false => "",
            };
            writeln!(text, "  stages, displacement of capacity: {travels}{rims}")?;
        }
    }
    for wall in &summary.walls {
        let (name, force) = (&wall.name, FORCE.text(wall.force_peak_n, 0));
        let moved = LENGTH.text(wall.displacement_peak_m, 1);
        match (wall.displacement_peak_m > 0.0, wall.force_peak_n > 0.0) {
            (true, true) => writeln!(
                text,
                "\"{name}\" moves by up to {moved}; contact force up to {force}"
            )?,
            // It shakes with the ground.
            (true, false) => writeln!(text, "\"{name}\" moves by up to {moved}, without contact")?,
            (false, _) => writeln!(text, "\"{name}\": contact force up to {force}")?,
        }
    }
    Ok(())
}

fn write_damage(
    text: &mut String,
    models: &[Building],
    buildings: &[BuildingSummary],
) -> std::fmt::Result {
    let mut between = "\n";
    for (index, building) in buildings.iter().enumerate() {
        for one in damage(models.get(index), building) {
            writeln!(text, "{between}{}: {}", building.name, one.sentence())?;
            between = "";
        }
    }
    Ok(())
}

/// Members against stated limits of rotation, one line for every building with limits.
fn write_rotation_levels(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for building in buildings {
        let Some(levels) = &building.rotation_levels else {
            continue;
        };
        let beyond = [levels.beyond_io, levels.beyond_ls, levels.beyond_cp];
        let given = |level: &RotationLevel| {
            let mut limits = levels.list.iter().flat_map(|member| &member.limits);
            limits.any(|limit| limit.level == *level)
        };
        let counts: Vec<String> = RotationLevel::ALL
            .into_iter()
            .zip(beyond)
            .filter(|(level, _)| given(level))
            .map(|(level, count)| {
                let verb = if count == 1 { "exceeds" } else { "exceed" };
                format!("{count} {verb} {}", level.name())
            })
            .collect();
        let worst = levels.list.first().and_then(|worst_member| {
            let level = worst_member.beyond?;
            let mut limits = worst_member.limits.iter();
            let at = limits.find(|limit| limit.level == level)?.beyond_s?;
            Some(format!(
                "; worst {}, {}: {:.2} mrad, beyond {} from {at:.3} s",
                worst_member.member,
                worst_member.at,
                1e3 * worst_member.rotation_rad,
                level.name()
            ))
        });
        writeln!(
            text,
            "\n{}: rotation limits: of {}, {}{}",
            building.name,
            counted(levels.members, "member"),
            counts.join(", "),
            worst.unwrap_or_default()
        )?;
    }
    Ok(())
}

/// Columns that failed in shear, one line for every building where they can.
fn write_shear_failures(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    let mut between = "\n";
    for building in buildings {
        let Some(failures) = &building.shear_failures else {
            continue;
        };
        let count = format!("{} of {}", failures.failed, failures.total);
        match failures.list.first() {
            Some(first) => {
                let during = first.impact.as_ref().map_or_else(String::new, during);
                let along = first
                    .along
                    .map_or_else(String::new, |axis| format!(" along {axis}"));
                writeln!(
                    text,
                    "{between}{} {}, first {} at its {}{along}, t = {:.3} s{during}",
                    building.name,
                    styled(LOUD, &format!("fails in shear in {count} columns")),
                    first.column,
                    first.at,
                    first.failed_s
                )?;
                write_later_failures(text, &failures.list)?;
            }
            None => writeln!(
                text,
                "{between}{}: none of {} columns fails in shear",
                building.name, failures.total
            )?,
        }
        between = "";
    }
    Ok(())
}

/// The impact at an instant in words: whether it strikes the member that is named before, or where else it is.
fn during(impact: &ImpactPlace) -> String {
    let [left, right] = &impact.between;
    let where_it_is = match impact.on_member {
        Some(true) => "on it, ",
        Some(false) => "elsewhere, ",
        None => "",
    };
    format!(
        ", during the impact of {left} and {right} {where_it_is}at {} {}, from {:.3} s",
        HEIGHT.stated(impact.height_m),
        HEIGHT.name(),
        impact.start_s
    )
}

/// The columns that fail after the first, each once, with the instant.
fn write_later_failures(text: &mut String, list: &[ShearFailure]) -> std::fmt::Result {
    let mut later: Vec<&ShearFailure> = Vec::new();
    for failure in list {
        if later.iter().all(|known| known.column != failure.column) {
            later.push(failure);
        }
    }
    let Some(later) = later.get(1..).filter(|later| !later.is_empty()) else {
        return Ok(());
    };
    let shown = later.iter().take(LISTED);
    let shown: Vec<String> = shown
        .map(|failure| format!("{} at {:.3} s", failure.column, failure.failed_s))
        .collect();
    let more = match later.len() > LISTED {
        true => format!(", and {} more", later.len() - LISTED),
        false => String::new(),
    };
    writeln!(text, "  then {}{more}", shown.join(", "))
}

/// The column that is nearest to its capacity among those that a neighbour strikes between floors.
fn write_struck_column(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    let members = buildings.iter().flat_map(|building| &building.members);
    let struck = members.filter_map(|member| {
        let hardest = member.struck_force_n();
        let ratio = member.greatest_ratio().filter(|_| hardest > 0.0)?;
        Some((member, ratio, hardest))
    });
    let Some((member, ratio, hardest)) = struck.max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Ok(());
    };
    writeln!(
        text,
        "  worst struck column: {} at {ratio:.2} × its capacity, struck with up to {}",
        member.name,
        FORCE.text(hardest, 0)
    )
}

fn write_capacity(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    let rated = || {
        buildings
            .iter()
            .filter_map(|building| building.capacity.as_ref())
    };
    let Some(rule) = rated().next().map(|capacity| capacity.rule) else {
        return Ok(());
    };
    let place = |exceedance: &ExceededSummary| {
        let during = exceedance.impact.as_ref().map_or_else(String::new, during);
        format!(
            "{} in {} at its {}, t = {:.3} s{during}",
            exceedance.member, exceedance.kind, exceedance.at, exceedance.at_s
        )
    };
    let worst = rated().map(|capacity| &capacity.worst);
    let worst = worst.max_by(|a, b| a.ratio.total_cmp(&b.ratio));
    let firsts = rated().filter_map(|capacity| capacity.first.as_ref());
    let first = firsts.min_by(|a, b| a.at_s.total_cmp(&b.at_s));
    let (all, exceeded, in_shear) = rated().fold((0, 0, 0), |(all, exceeded, shear), capacity| {
        let shear = shear + capacity.exceeded_in_shear;
        (all + capacity.rated, exceeded + capacity.exceeded, shear)
    });
    let label = format!("capacity ({rule}):");
    match first {
        Some(first) => {
            let beyond = format!("{exceeded} of {all} members exceed it");
            writeln!(
                text,
                "\n{label} {}, {in_shear} in shear; first {}",
                styled(LOUD, &beyond),
                place(first)
            )?;
            if let Some(worst) = worst {
                writeln!(
                    text,
                    "  worst {:.2} × capacity: {}",
                    worst.ratio,
                    place(worst)
                )?;
            }
        }
        None => {
            if let Some(worst) = worst {
                writeln!(
                    text,
                    "\n{label} none of {all} members exceeds it; greatest {:.2} × capacity: {}",
                    worst.ratio,
                    place(worst)
                )?;
            }
        }
    }
    write_struck_column(text, buildings)?;
    let (all, exceeded) = rated().fold((0, 0), |(all, exceeded), capacity| {
        (
            all + capacity.joints_rated,
            exceeded + capacity.joints_exceeded,
        )
    });
    let firsts = rated().filter_map(|capacity| capacity.first_joint.as_ref());
    if let Some(first) = firsts.min_by(|a, b| a.at_s.total_cmp(&b.at_s)) {
        writeln!(
            text,
            "  joints: {exceeded} of {all} exceed it, first {}",
            place(first)
        )?;
    }
    Ok(())
}

/// Friction along the faces of a gap between buildings in space.
fn write_friction(text: &mut String, gap: &GapSummary) -> std::fmt::Result {
    let sliding = gap
        .contacts
        .iter()
        .filter_map(|contact| contact.in_plan?.sliding);
    let (mut peak, mut slip, mut energy) = (0.0_f64, 0.0_f64, 0.0);
    for sliding in sliding {
        peak = peak.max(sliding.tangential_peak_n);
        slip = slip.max(sliding.slip_peak_m);
        energy += sliding.friction_j;
    }
    if peak > 0.0 {
        writeln!(
            text,
            "  Friction: peak {} along a face, slip up to {}, {} dissipated.",
            FORCE.text(peak, 1),
            LENGTH.text(slip, 1),
            ENERGY.text(energy, 1)
        )?;
    }
    Ok(())
}

fn write_gap(
    text: &mut String,
    gap: &GapSummary,
    summary: &Summary,
    required: Option<&Requirements>,
) -> std::fmt::Result {
    let [left, right] = &gap.between;
    let verdict = match gap.first_impact_s {
        Some(first) => format!(
            "{}, peak {}{}, first at {first:.3} s",
            counted(gap.impact_count, "impact"),
            FORCE.text(gap.peak_force_n, 1),
            range_beside(gap, summary)
        ),
        None => {
            format!(
                "no contact; smallest clearance {}",
                LENGTH.text(gap.clearance_m, 1)
            )
        }
    };
    writeln!(
        text,
        "\n{left} ↔ {right}, {} apart: {}",
        LENGTH.text(gap.width_m, 1),
        styled(BOLD, &verdict)
    )?;
    let mut hit: Vec<&ContactSummary> = gap
        .contacts
        .iter()
        .filter(|contact| contact.impact_count > 0)
        .collect();
    sort_by(&mut hit, |a, b| b.height_m.total_cmp(&a.height_m));
    let [force, impulse, length] = [FORCE, IMPULSE, LENGTH].map(Shown::name);
    let is_wall = |name: &str| name == WALL || summary.walls.iter().any(|wall| wall.name == name);
    // Neither a floor nor a wall: a column between its floors.
    let point = |contact: &ContactSummary, side: usize| match contact.floors[side] {
        Some(floor) => floor.to_string(),
        None if is_wall(&gap.between[side]) => WALL.to_owned(),
        None => contact
            .struck_column
            .as_ref()
            .map_or_else(|| "–".to_owned(), |line| format!("column {line}")),
    };
    let listed = hit.iter().take(LISTED);
    let places = listed.map(|contact| format!("{} | {}", point(contact, 0), point(contact, 1)));
    let places: Vec<String> = places.collect();
    let lengths = places.iter().map(|place| place.chars().count());
    let wide = lengths.fold(9, usize::max);
    if !hit.is_empty() {
        writeln!(
            text,
            "{:>wide$}  impacts   peak force    impulse   closing    first",
            "floors "
        )?;
    }
    for (contact, place) in hit.iter().zip(&places) {
        writeln!(
            text,
            "{place:>wide$}  {:7}  {:>8} {force}  {:>5} {impulse}  {:>5} {length}  {:>7.3} s",
            contact.impact_count,
            kn(contact.peak_force_n),
            IMPULSE.number(contact.impulse_n_s, 1),
            mm(contact.closing_peak_m),
            contact.impacts.first().map_or(0.0, |impact| impact.start_s)
        )?;
    }
    if hit.len() > LISTED {
        writeln!(
            text,
            "  … and {} more",
            counted(hit.len() - LISTED, "contact")
        )?;
    }
    if gap.multiple_pounding_count > 0 {
        let most = gap.most_at_once;
        match [gap.multiple_pounding_count, gap.pounding_count] {
            [_, 1] => writeln!(text, "  The only pounding involves {most} floors.")?,
            [some, all] => {
                let verb = if some == 1 { "involves" } else { "involve" };
                writeln!(
                    text,
                    "  {some} of {all} poundings {verb} several floors (up to {most})."
                )?;
            }
        }
        if let Some(at) = gap.total_force_peak_at_s {
            writeln!(
                text,
                "  All contacts together: peak {} at {at:.3} s.",
                FORCE.text(gap.total_force_peak_n, 1)
            )?;
        }
    }
    write_friction(text, gap)?;
    if let Some(closing) = gap.closing_without_contact_m {
        // Narrower gaps elsewhere can throw a building against this one.
        let thrown = match gap.impact_count > 0 && closing < gap.width_m {
            true => "; impacts at other gaps make it close by more",
            false => "",
        };
        writeln!(
            text,
            "  Gap needed under this motion: {} (from a run without contact{thrown}).",
            LENGTH.text(closing, 1)
        )?;
    }
    let floors = summary
        .buildings
        .iter()
        .flat_map(|building| building.floors.iter());
    let mut floors = floors.map(|floor| floor.without_contact.is_some());
    let has_impacts = gap.impact_count > 0 && !floors.all(|is_known| is_known);
    let computed = gap.closing_without_contact_m;
    match required {
        Some(required) => write_codes(text, required, computed, has_impacts),
        None => Ok(()),
    }
}

/// The range of the peak force over other contacts, where they were run.
fn range_beside(gap: &GapSummary, summary: &Summary) -> String {
    let spread = summary.contact_sensitivity.as_ref();
    let gap = spread.and_then(|all| {
        all.gaps
            .iter()
            .find(|candidate| candidate.between == gap.between)
    });
    gap.map_or_else(String::new, |gap| {
        let [least, most] = [gap.peak_force_min_n, gap.peak_force_max_n].map(kn);
        format!(" ({least} to {most} {})", FORCE.name())
    })
}

/// Results over the range of the properties of bearings.
fn write_bounds(text: &mut String, bounds: &IsolationBounds) -> std::fmt::Result {
    let heading = "Bearings at nominal, lower and upper properties";
    writeln!(text, "\n{}", styled(BOLD, heading))?;
    let mut line = |name: &str, what: &str, range: &Bounded, show: &dyn Fn(f64) -> String| {
        let [nominal, lower, upper, envelope] =
            [range.nominal, range.lower, range.upper, range.envelope].map(show);
        writeln!(
            text,
            "{name}: {what} {nominal}, {lower}, {upper}; envelope {}",
            styled(BOLD, &envelope)
        )
    };
    for building in &bounds.buildings {
        let (name, drift) = (&building.name, |x: f64| format!("{:.2} %", 100.0 * x));
        if let Some(stroke) = &building.stroke_m {
            line(name, "stroke", stroke, &|x| LENGTH.text(x, 1))?;
        }
        if let Some(force) = &building.force_n {
            line(name, "force", force, &|x| FORCE.text(x, 1))?;
        }
        line(name, "drift", &building.drift, &drift)?;
        line(name, "storey shear", &building.storey_shear_n, &|x| {
            FORCE.text(x, 1)
        })?;
    }
    for gap in &bounds.gaps {
        let [left, right] = &gap.between;
        line(
            &format!("{left} ↔ {right}"),
            "contact force",
            &gap.peak_force_n,
            &|x| FORCE.text(x, 1),
        )?;
        if let Some(needed) = &gap.closing_without_contact_m {
            let name = format!("{left} ↔ {right}");
            line(&name, "gap needed", needed, &|x| LENGTH.text(x, 1))?;
        }
    }
    Ok(())
}

/// Derivatives of the peaks of gaps and whole buildings; those of floors stand in `summary.json`.
fn write_gradients(text: &mut String, gradients: &[Gradient]) -> std::fmt::Result {
    if gradients.is_empty() {
        return Ok(());
    }
    writeln!(
        text,
        "\n{}; those of floors are in summary.json",
        styled(BOLD, "Change of a peak for 1 % more of a number")
    )?;
    let shown = gradients.iter().filter(|gradient| {
        gradient.peak != 0.0
            && !gradient.of.contains("floors[")
            && !gradient.of.contains("contacts[")
    });
    for gradient in shown {
        writeln!(
            text,
            "  {:<44} {:<26} {:>+8.3} %   linear within ±{:.1} %",
            gradient.of,
            gradient.by,
            gradient.elasticity(),
            100.0 * gradient.valid_within / gradient.at.abs()
        )?;
    }
    Ok(())
}

fn write_spread(text: &mut String, spread: &ContactSensitivity) -> std::fmt::Result {
    let heading = "Over the advised range of contact stiffness, and restitution ± 0.15";
    writeln!(text, "\n{}", styled(BOLD, heading))?;
    for gap in &spread.gaps {
        let [left, right] = &gap.between;
        let (fewest, most) = (gap.impact_count_min, gap.impact_count_max);
        let impacts = if fewest == most {
            counted(most, "impact")
        } else {
            format!("{fewest} to {most} impacts")
        };
        writeln!(
            text,
            "{left} ↔ {right}: peak {} to {}, {impacts}",
            kn(gap.peak_force_min_n),
            FORCE.text(gap.peak_force_max_n, 1)
        )?;
    }
    for building in &spread.buildings {
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        writeln!(
            text,
            "{}: floor accelerations {} to {}; displacements change by up to {}, drifts {}, storey shears {}",
            building.name,
            ACCELERATION.number(building.total_acceleration_min_m_s2, 1),
            ACCELERATION.text(building.total_acceleration_max_m_s2, 1),
            percent(building.displacement),
            percent(building.storey_drift),
            percent(building.storey_shear)
        )?;
    }
    Ok(())
}

fn write_link(text: &mut String, link: &LinkSummary) -> std::fmt::Result {
    let [left, right] = &link.between;
    let pair = if left == right {
        left.clone()
    } else {
        format!("{left} ↔ {right}")
    };
    let law = match link.law.as_str() {
        "linear" => String::new(),
        law => format!("{law} "),
    };
    // Springs without dashpot dissipate rounding, of either sign.
    let dissipated = if link.dissipated_j.abs() < 1e-6 {
        0.0
    } else {
        link.dissipated_j
    };
    let stroke = link.floors.iter().map(|floor| floor.peak_stroke_m);
    writeln!(
        text,
        "\n{pair}, {}: {}, stroke {}, {} dissipated",
        counted(link.floors.len(), &format!("{law}link")),
        styled(BOLD, &format!("peak {}", FORCE.text(link.peak_force_n, 1))),
        LENGTH.text(stroke.fold(0.0, f64::max), 1),
        ENERGY.text(dissipated, 1)
    )
}

#[cfg(test)]
mod tests {
    use jostle::results::response::FloorResponse;
    use jostle::results::summary::{FloorSummary, HingeSummary};

    use super::*;

    /// A floor with peaks `with` contact and one without: drift, shear, acceleration.
    fn floor(number: usize, with: [f64; 3], without: [f64; 3]) -> FloorSummary {
        let response = |peaks: [f64; 3]| FloorResponse {
            storey_drift_peak: peaks[0],
            storey_shear_peak_n: peaks[1],
            total_acceleration_peak_m_s2: peaks[2],
            ..FloorResponse::default()
        };
        FloorSummary {
            in_plan: None,
            floor: number,
            height_m: 3.0 * number as f64,
            response: response(with),
            without_contact: Some(response(without)),
            without_contact_in_plan: None,
            amplification: None,
        }
    }

    #[test]
    fn what_contact_changes_names_where_it_hurts_and_where_it_helps() {
        let mut one = building("A", HingeSummary::default());
        one.floors = vec![
            floor(1, [0.01, 8e5, 2.0], [0.02, 1e6, 4.0]),
            floor(2, [0.03, 6e5, 9.0], [0.02, 5e5, 2.0]),
            floor(3, [0.01, 3e5, 3.0], [0.01, 3e5, 0.0]),
        ]
        .into();
        // Without a run without contact there is nothing to compare.
        let mut two = building("B", HingeSummary::default());
        two.floors = one.floors.clone();
        for floor in &mut two.floors {
            floor.without_contact = None;
        }
        let mut text = String::new();
        let _ = write_changes(&mut text, &[one, two]);
        assert_eq!(
            text,
            "\n\
             effect of pounding (with ÷ without)       storey drift       storey shear       acceleration\n\
             A                    largest ratio     1.50 (storey 2)    1.20 (storey 2)     4.50 (floor 2)\n\
             \x20                    smallest ratio    0.50 (storey 1)    0.80 (storey 1)     0.50 (floor 1)\n\n"
        );
        let mut text = String::new();
        let _ = write_changes(&mut text, &[]);
        assert_eq!(text, "");
    }

    fn building(name: &str, hinges: HingeSummary) -> BuildingSummary {
        BuildingSummary {
            name: name.to_owned(),
            hinges,
            ..BuildingSummary::default()
        }
    }

    #[test]
    fn only_buildings_with_hinges_speak_of_them() {
        let some = HingeSummary {
            total: 50,
            cracked: 40,
            yielded: 7,
            first_yield_s: Some(2.134_4),
            ductility: 2.44,
            ..HingeSummary::default()
        };
        let uncracked = HingeSummary {
            total: 4,
            ..HingeSummary::default()
        };
        let buildings = [
            building("A", some),
            building("B", HingeSummary::default()),
            building("C", uncracked),
        ];
        let mut text = String::new();
        let _ = write_damage(&mut text, &[], &buildings);
        assert_eq!(
            text,
            "\nA: 7 of 50 hinges yielded, first at 2.134 s; 40 cracked; ductility 2.4\n\
             C: 0 of 4 hinges yielded; 0 cracked\n"
        );
    }
}
