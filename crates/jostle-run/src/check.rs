//! A model without a run: masses, periods, contacts, findings and the expected work, as `jostle check` prints them.

mod base;
mod frames;
mod hinges;
mod losses;
mod motion;

use std::f64::consts::PI;
use std::fmt::Write;

use jostle::eigen::Mode;
use jostle::hysteresis::{HysteresisRule, Side};
use jostle::interface::{Contact, PlanContactKind};
use jostle::judgement::{Stated, structure_yields};
use jostle::model::{Damping, Structure, Sway, Tiers};
use jostle::system::BuildingSystem;
use jostle::{Building, LinkLaw, Model, SpaceMember, SpacePlace, SpaceWall, System};

use base::{
    describe_bearing_places, describe_bearings, describe_foundation, describe_foundation_in_plan,
};
use frames::{axial_of_columns, diagonals, members, rigid_ends, space_walls, walls};
use hinges::{describe_hinges, describe_yielding_in_plan};
use jostle::results::summary::Finding;
use jostle_io::in_shown_units;
use jostle_io::shown::{
    FORCE, GROUND_ACCELERATION, HEIGHT, LENGTH, MASS, MOMENT, SPEED, by_model, power_dashpot,
};
use jostle_report::{SitePlace, site_svg};
use losses::losses;
use motion::{describe_grounds, describe_work};
use serde::Serialize;

use crate::checks_text::finding_with_remedy;
use crate::error::RunError;
use crate::numbers::{counted, grouped, prefixed};
use crate::opened::Opened;
use crate::style::{BOLD, LOUD, styled};

/// What is known of a model without running it.
#[derive(Clone, Debug, Serialize)]
pub struct Check {
    /// All of it in words, as `jostle check` prints it.
    pub text: String,
    /// Warnings about valid but unusual values.
    pub warnings: Vec<String>,
    /// What was assumed where the model does not say.
    pub notes: Vec<String>,
    /// Checks of the model that are not passed, worst first.
    pub findings: Vec<Finding>,
    /// The records that a run may choose from; empty unless there are several.
    pub records: Vec<CheckedRecord>,
    /// What a run is expected to take; `None` without a ground motion, and for several records.
    pub work: Option<ExpectedWork>,
    /// Files that the model names.
    pub files: Vec<String>,
    /// The site from above as SVG; `None` of models in one plane.
    pub site: Option<String>,
}

/// A record of a model that lists several.
#[derive(Clone, Debug, Serialize)]
pub struct CheckedRecord {
    /// Name.
    pub name: String,
    /// Length \[s\].
    pub duration_s: f64,
    /// Peak ground acceleration, scale included \[m/s²\].
    pub pga_m_s2: f64,
    /// Regular steps.
    pub steps: u64,
    /// Their length \[s\].
    pub step_s: f64,
}

/// What a run with its report is expected to take.
#[derive(Clone, Debug, Serialize)]
pub struct ExpectedWork {
    /// Equations that advance a step.
    pub solver: &'static str,
    /// Regular steps, more during contact.
    pub steps: u64,
    /// Their length \[s\].
    pub step_s: f64,
    /// Time on this machine \[s\].
    pub seconds: f64,
    /// Memory \[bytes\].
    pub memory_bytes: f64,
    /// Size of `history.parquet` \[bytes\].
    pub history_file_bytes: f64,
}

/// Checks a model without running it: masses, periods, contacts, findings, expected work.
///
/// # Errors
/// The ground motion cannot be used, or a run would lose its digits or need more memory than there is.
pub fn check(opened: &Opened) -> Result<Check, RunError> {
    by_model(opened.input.units, || checked(opened))
}

fn checked(opened: &Opened) -> Result<Check, RunError> {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = describe(
        &mut text,
        &opened.input.model,
        &opened.system,
        &opened.input.stated,
    );
    let mut warnings = opened.input.warnings.clone();
    warnings.extend(jostle::results::foundation_warnings(&opened.system));
    warnings.extend(jostle::results::wall_warnings(&opened.input.model));
    warnings.extend(jostle::results::friction_warnings(
        &opened.input.model,
        &opened.system,
    ));
    for warning in &warnings {
        let warning = opened.input.with_line(warning);
        let warning = in_shown_units(&warning);
        let _ = writeln!(text, "{} {warning}", styled(LOUD, "warning:"));
    }
    let notes = opened.input.assumptions();
    for assumption in &notes {
        let assumption = in_shown_units(assumption);
        let _ = writeln!(text, "{} {assumption}", styled(LOUD, "note:"));
    }
    if !(warnings.is_empty() && notes.is_empty()) {
        text.push('\n');
    }
    let motion = match opened.input.records().is_empty() && opened.input.motion.is_some() {
        true => Some(opened.plan()?),
        false => None,
    };
    let findings = opened.findings(motion.as_ref().map(|(motion, _)| motion));
    for finding in &findings {
        let _ = writeln!(text, "{}", finding_with_remedy(finding));
    }
    if !findings.is_empty() {
        text.push('\n');
    }
    let (mut listed, mut work, mut site) = (Vec::new(), None, None);
    if opened.system.is_in_space() {
        site = site_svg(
            &opened.input.model,
            &opened.system,
            motion.as_ref().map(|(motion, _)| motion),
            opened.input.north,
        );
    }
    if !opened.input.records().is_empty() {
        listed = records(opened, &mut text, &mut warnings)?;
    } else if let Some((motion, plan)) = motion {
        if let Err(refusal) = plan.check_digits(&opened.system) {
            let problem = format!("{refusal}; jostle run --force runs it anyway");
            return Err(opened.input.fault("analysis.solver", problem).into());
        }
        if let Some(warning) = opened.input.unusual_motion(&motion) {
            let shown = opened.input.with_line(&warning);
            let shown = in_shown_units(&shown);
            let _ = writeln!(text, "{} {shown}", styled(LOUD, "warning:"));
            warnings.push(warning);
        }
        if let Some(note) = opened.input.scaled_across(&motion) {
            let _ = writeln!(text, "{} {note}", styled(LOUD, "note:"));
        }
        let _ = describe_grounds(&mut text, &opened.system, &motion);
        let _ = writeln!(text, "{}", styled(BOLD, "Expected work"));
        let _ = describe_work(&mut text, &opened.system, &plan, motion.duration);
        let prepared = opened.prepare()?;
        let settings = prepared.settings(true);
        prepared.check_histories(settings, true, Some("jostle run --force runs it anyway"))?;
        let expected = prepared.expect(settings, true);
        let seconds = prepared.expected_seconds(settings, true);
        let _ = writeln!(text, "  {}\n", expected.text(seconds));
        work = Some(ExpectedWork {
            solver: plan.solver.name(),
            steps: steps_of(motion.duration, plan.step),
            step_s: plan.step,
            seconds,
            memory_bytes: expected.memory,
            history_file_bytes: expected.history_file,
        });
    } else {
        let _ = writeln!(
            text,
            "{} the model has no ground motion; a run needs one: add [motion], or --record",
            styled(LOUD, "note:")
        );
    }
    let files = opened.input.files();
    if !files.is_empty() {
        let _ = writeln!(text, "Files read: {}", files.join(", "));
    }
    text.push_str(match opened.input.motion {
        Some(_) => "The model is valid.",
        None => "The model is valid, without a ground motion.",
    });
    Ok(Check {
        text,
        warnings,
        notes,
        findings,
        records: listed,
        work,
        files,
        site,
    })
}

/// Regular steps through a motion.
fn steps_of(duration: f64, step: f64) -> u64 {
    (duration / step).ceil() as u64
}

/// The records that a run may choose from; each of them is read.
fn records(
    opened: &Opened,
    text: &mut String,
    warnings: &mut Vec<String>,
) -> Result<Vec<CheckedRecord>, RunError> {
    let inputs = opened.input.each_record();
    let mut listed = Vec::new();
    let _ = writeln!(text, "{}", styled(BOLD, "Records"));
    for input in &inputs {
        let (motion, plan) = opened.plan_of(input)?;
        let steps = steps_of(motion.duration, plan.step);
        let _ = writeln!(
            text,
            "  {:30} {:>7.2} s {:>8} {} {:>8} steps of {:.4} ms",
            motion.name,
            motion.duration,
            GROUND_ACCELERATION.number(motion.peak(), 1),
            GROUND_ACCELERATION.name(),
            grouped(steps),
            plan.step * 1e3
        );
        if let Some(warning) = input.unusual_motion(&motion) {
            let warning = format!("{}: {warning}", motion.name);
            let shown = in_shown_units(&warning);
            let _ = writeln!(text, "{} {shown}", styled(LOUD, "warning:"));
            warnings.push(warning);
        }
        listed.push(CheckedRecord {
            pga_m_s2: motion.peak(),
            duration_s: motion.duration,
            name: motion.name,
            steps,
            step_s: plan.step,
        });
    }
    let _ = writeln!(
        text,
        "{} a run, a study and \"jostle gap\" use all {}; --record chooses one",
        styled(LOUD, "note:"),
        inputs.len()
    );
    Ok(listed)
}

/// Columns, beams and grid lines of a space frame.
fn space_frame(tiers: &Tiers) -> String {
    let Some(frame) = &tiers.space_frame else {
        return String::new();
    };
    let is_column = |member: &&SpaceMember| matches!(member.place, SpacePlace::Column { .. });
    let columns = frame.members.iter().filter(is_column).count();
    let beams = frame.members.len() - columns;
    let unit = HEIGHT.name();
    let lines = |lines: &[f64]| {
        let all = lines.iter().map(|line| HEIGHT.stated(*line));
        all.collect::<Vec<_>>().join(", ")
    };
    // Beams begin at the faces of walls.
    let zones = frame.rigid_zones.iter().map(|(&[floor, x, y], &zone)| {
        let mut ends = zone;
        let at_joint = |wall: &&SpaceWall| {
            let [first, last] = wall.storeys;
            wall.line == [x, y] && (first..=last + 1).contains(&(floor + 1))
        };
        for wall in frame.walls.iter().filter(at_joint) {
            ends[wall.along.index()] = 0.0;
        }
        [ends[0].max(ends[1]), ends[2]]
    });
    let parts = frame
        .walls
        .iter()
        .map(|wall| wall.storeys[1] - wall.storeys[0] + 1);
    let columns = columns - parts.sum::<usize>();
    format!(
        "space frame, {}, {} and {}{}{}\n  grid lines at x = {} {unit}, at y = {} {unit}{}",
        counted(tiers.floors.len(), "storey"),
        counted(columns, "column"),
        counted(beams, "beam"),
        diagonals(&frame.diagonals),
        rigid_ends(zones),
        lines(&frame.lines_x),
        lines(&frame.lines_y),
        space_walls(frame)
    )
}

fn describe(
    text: &mut String,
    model: &Model,
    system: &System,
    stated: &Stated,
) -> std::fmt::Result {
    writeln!(text, "{}\n", styled(BOLD, &model.title))?;
    for (index, building) in system.structures().iter().enumerate() {
        let kind = match &model.buildings[index].structure {
            Structure::Frame(frame) => format!(
                "frame, {}, {}{}",
                counted(frame.storey_heights.len(), "storey"),
                counted(frame.spans.len(), "span"),
                members(frame)
                    + &diagonals(&frame.diagonals)
                    + &rigid_ends(frame.rigid_zones.values().copied())
            ),
            Structure::Shear(shear) => {
                format!("shear building, {}", counted(shear.mass.len(), "storey"))
            }
            Structure::Tiers(tiers) if !tiers.frames.is_empty() => format!(
                "{} at lines of a plan, {}",
                counted(tiers.frames.len(), "frame"),
                counted(tiers.floors.len(), "storey")
            ),
            Structure::Tiers(tiers) if tiers.space_frame.is_some() => space_frame(tiers),
            Structure::Tiers(tiers) if tiers.matrices.is_some() => format!(
                "given by matrices, {} in plan",
                counted(tiers.floors.len(), "floor")
            ),
            Structure::Tiers(tiers) => format!(
                "shear building with a plan, {}",
                counted(tiers.floors.len(), "storey")
            ),
            Structure::Given(given) => {
                format!(
                    "given by matrices of {}, {}",
                    counted(given.len(), "displacement"),
                    counted(given.floors.len(), "floor")
                )
            }
        };
        describe_building(text, building, &model.buildings[index], &kind)?;
        match &model.buildings[index].structure {
            Structure::Frame(frame) => {
                let building = stated.buildings.get(index);
                let is_stated = building.is_some_and(|building| building.axial);
                let on_soil = model.buildings[index].base.foundation.is_some();
                let why = axial_of_columns(frame, Some([is_stated, on_soil]));
                writeln!(text, "  {why}")?;
                text.push_str(&walls(frame));
            }
            Structure::Tiers(tiers) => {
                // Frames that are alike share a line.
                let mut lines: Vec<(String, Vec<&str>)> = Vec::new();
                for frame in &tiers.frames {
                    let line = axial_of_columns(&frame.frame, None) + &members(&frame.frame);
                    match lines.iter_mut().find(|(known, _)| *known == line) {
                        Some((_, names)) => names.push(&frame.name),
                        None => lines.push((line, vec![&frame.name])),
                    }
                }
                for (line, names) in lines {
                    writeln!(text, "  {}: {line}", names.join(", "))?;
                }
                for frame in tiers
                    .frames
                    .iter()
                    .filter(|frame| !frame.frame.walls.is_empty())
                {
                    let walls = walls(&frame.frame);
                    for line in walls.lines() {
                        writeln!(text, "  {}: {}", frame.name, line.trim_start())?;
                    }
                }
            }
            Structure::Shear(_) | Structure::Given(_) => {}
        }
        for line in special(&model.buildings[index]) {
            writeln!(text, "  {line}")?;
        }
        if let Some(mat) = building.discretization.mat {
            describe_bearings(text, &mat)?;
            if let Some(plan_mat) = &building.mat_in_plan {
                let given = matches!(
                    &model.buildings[index].structure,
                    Structure::Tiers(tiers) if !tiers.bearings.is_empty()
                );
                describe_bearing_places(text, &plan_mat.bearings, mat.weight, given)?;
            }
        }
        if let Some(foundation) = building.foundation {
            let mass = building.equations.total_mass();
            let sticks = &building.discretization.stick_model;
            describe_foundation(text, &foundation, mass, &sticks.bed)?;
        }
        if let Some(foundation) = &building.foundation_in_plan {
            let mass = building.equations.total_mass();
            let bed = &building.discretization.stick_model.bed;
            describe_foundation_in_plan(text, foundation, mass, bed)?;
        }
        if let Some(hinges) = &model.buildings[index].hinges {
            describe_hinges(text, hinges)?;
        }
        if let Structure::Tiers(tiers) = &model.buildings[index].structure {
            describe_yielding_in_plan(text, tiers)?;
        }
        for (name, hinge, unit) in [
            (
                "rocks",
                model.buildings[index].base.rotational_hinge,
                MOMENT,
            ),
            (
                "slides",
                model.buildings[index].base.horizontal_hinge,
                FORCE,
            ),
        ] {
            if let Some(hinge) = hinge {
                let yielding = hinge.backbone().side(Side::Positive).yielding.force;
                writeln!(
                    text,
                    "  base {name} by {}: yields at {} {}",
                    hinge.rule().name(),
                    unit.number(yielding, 0),
                    unit.name()
                )?;
            }
        }
        writeln!(text)?;
    }
    let places = SitePlace::of_system(model, system);
    for (index, gap) in model.gaps.iter().enumerate() {
        let contacts: Vec<_> = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index)
            .collect();
        let heights: Vec<String> = contacts
            .iter()
            .map(|contact| {
                height(
                    contact.height,
                    system.floors_of(&contact.ports),
                    beside(model, gap.between),
                )
            })
            .collect();
        let [left, right] = names(system, gap.between);
        writeln!(text, "{}", styled(BOLD, &format!("{left} ↔ {right}")))?;
        // A tenth of a millimetre means nothing in a gap of metres.
        let mm = |width: f64| LENGTH.number(width, usize::from(width < 1.0));
        let widths: Vec<String> = contacts.iter().map(|contact| mm(contact.width)).collect();
        if system.is_in_space() {
            let on_columns = |contact: &&&Contact| {
                let plan = contact.plan;
                plan.is_some_and(|plan| plan.kind == PlanContactKind::Column)
            };
            let columns = contacts.iter().filter(on_columns).count();
            let faces = faces_among(&contacts) - columns;
            let mut parts = vec![format!("{} {}", mm(gap.width()), LENGTH.name())];
            if faces > 0 || columns == 0 {
                let points = gap.in_plan.points;
                parts.push(format!(
                    "{} of {points} points each",
                    counted(faces, "face")
                ));
            }
            if columns > 0 {
                parts.push(format!("{} between floors", counted(columns, "column")));
            }
            writeln!(text, "  gap {}", parts.join(", "))?;
        } else {
            writeln!(
                text,
                "  gap {} {}, {} at {} {}",
                if gap.widths.len() > 1 {
                    widths.join(", ")
                } else {
                    mm(gap.width())
                },
                LENGTH.name(),
                counted(contacts.len(), "contact"),
                heights.join(", "),
                HEIGHT.name()
            )?;
            for (contact, height) in contacts.iter().zip(&heights) {
                let farther = contact.width - gap.width();
                if gap.widths.len() == 1 && farther > 0.0 {
                    writeln!(
                        text,
                        "  the faces at {height} {} stand back: {} more",
                        HEIGHT.name(),
                        HEIGHT.text(farther, 2)
                    )?;
                }
            }
        }
        let unit = if gap.law.kind.is_hertzian() {
            "N/m^1.5"
        } else {
            "N/m"
        };
        writeln!(
            text,
            "  {} with {}; {}",
            gap.law.kind.name(),
            prefixed(gap.law.stiffness, unit, 4),
            losses(gap, &contacts)
        )?;
        if system.is_in_space() {
            describe_places(text, model, index, &places)?;
            continue;
        }
        // Faces that stand back may never touch.
        let narrowest = contacts.iter().map(|contact| contact.width);
        let narrowest = narrowest.fold(f64::INFINITY, f64::min);
        let nearest = |contact: &&&Contact| contact.width <= narrowest;
        if let Some(contact) = contacts.iter().rev().find(nearest) {
            let place = match contacts
                .last()
                .is_some_and(|top| top.height > contact.height)
            {
                true => format!("at {}", HEIGHT.text(contact.height, 2)),
                false => "at the highest contact".to_owned(),
            };
            let [left, right] = contact.ports.masses().map(|mass| {
                if mass.is_finite() {
                    MASS.text(mass, 1)
                } else {
                    "a rigid wall".to_owned()
                }
            });
            writeln!(
                text,
                "  colliding masses {place}: {left} and {right}; an elastic impact at {} lasts {:.1} ms\n",
                SPEED.text(0.5, 1),
                contact.law.elastic_duration(contact.effective_mass(), 0.5) * 1e3
            )?;
        }
    }
    for (index, link) in model.links.iter().enumerate() {
        let links = system.links.iter().filter(|element| element.link == index);
        // Inside a building the base is no column.
        let sides = match link.is_inside() {
            true => [None; 2],
            false => beside(model, link.between),
        };
        let heights: Vec<String> = links
            .map(|element| {
                let floors = system.floors_of(&element.ports);
                height(element.height, floors, sides)
            })
            .collect();
        let [left, right] = names(system, link.between);
        let pair = if link.is_inside() {
            left.to_owned()
        } else {
            format!("{left} ↔ {right}")
        };
        let law = match link.law {
            LinkLaw::Linear => String::new(),
            law => format!("{} ", law.name()),
        };
        writeln!(text, "{}", styled(BOLD, &pair))?;
        writeln!(
            text,
            "  {} at {} {}{} with {}\n",
            counted(heights.len(), &format!("{law}link")),
            heights.join(", "),
            HEIGHT.name(),
            if heights.len() == 1 { "" } else { ", each" },
            parameters(link)
        )?;
    }
    Ok(())
}

/// Numbers of a link, with units.
fn parameters(link: &jostle::Link) -> String {
    let exponent = match link.law {
        LinkLaw::Viscous { exponent } => exponent,
        LinkLaw::Linear
        | LinkLaw::Maxwell
        | LinkLaw::Friction { .. }
        | LinkLaw::Yielding(_)
        | LinkLaw::Cable { .. }
        | LinkLaw::Stopper { .. } => 1.0,
    };
    let (mut stiffness, mut limits) = (link.stiffness, Vec::new());
    match link.law {
        LinkLaw::Linear | LinkLaw::Viscous { .. } | LinkLaw::Maxwell => {}
        LinkLaw::Friction {
            slip_force,
            stick_stiffness,
        } => {
            stiffness = stick_stiffness;
            limits.push(format!("slip at {}", FORCE.text(slip_force, 1)));
        }
        LinkLaw::Yielding(hysteresis) => {
            let backbone = hysteresis.backbone();
            stiffness = backbone.initial();
            limits.push(match hysteresis.rule() {
                HysteresisRule::Stop { .. } => "compression only".to_owned(),
                rule => {
                    let one_sided = match backbone.open_side() {
                        Some(_) => ", compression only",
                        None => "",
                    };
                    let yielding = FORCE.text(backbone.yield_force(), 1);
                    format!("yield at {yielding}, {}{one_sided}", rule.name())
                }
            });
        }
        LinkLaw::Cable { slack } => limits.push(format!("a slack of {}", LENGTH.text(slack, 1))),
        LinkLaw::Stopper { gap } => limits.push(format!("a gap of {}", LENGTH.text(gap, 1))),
    }
    let dashpot = match exponent == 1.0 {
        true => prefixed(link.damping, "N·s/m", 4),
        false => {
            let (value, unit) = power_dashpot(link.damping, exponent);
            match value < 1e5 {
                true => format!("{value:.4} {unit}"),
                false => format!("{value:.3e} {unit}"),
            }
        }
    };
    let springs = [
        (stiffness, prefixed(stiffness, "N/m", 4)),
        (link.damping, dashpot),
    ];
    let springs = springs.into_iter().filter(|(value, _)| *value > 0.0);
    let springs = springs.map(|(_, text)| text);
    springs.chain(limits).collect::<Vec<_>>().join(" and ")
}

/// Number of faces, corners and columns.
fn faces_among(contacts: &[&Contact]) -> usize {
    let mut faces: Vec<usize> = contacts
        .iter()
        .filter_map(|contact| Some(contact.plan?.face))
        .collect();
    faces.dedup();
    faces.len()
}

/// Faces and corners between the plans of a gap, numbered as in the drawing of the site.
fn describe_places(
    text: &mut String,
    model: &Model,
    gap: usize,
    places: &[SitePlace],
) -> std::fmt::Result {
    let numbered = places.iter().enumerate();
    let numbered = numbered.filter(|(_, place)| place.gap_index == gap);
    let rows: Vec<[String; 8]> = numbered
        .map(|(number, place)| {
            let [first, second] = place.parts_in_words(model);
            [
                (number + 1).to_string(),
                place.kind.name().to_owned(),
                first,
                second,
                place.floors_in_words(),
                match place.overlap > 0.0 {
                    true => HEIGHT.text(place.overlap, 3),
                    false => "–".to_owned(),
                },
                place.gap_in_words(),
                format!("{:+.3}, {:+.3}", place.normal[0], place.normal[1]),
            ]
        })
        .collect();
    let between = model.gaps[gap].between;
    let [left, right] = between.map(|side| match (side, model.wall(side)) {
        (_, Some(wall)) => &wall.name[..],
        (Some(index), None) => model
            .buildings
            .get(index)
            .map_or("", |building| &building.name),
        (None, None) => "wall",
    });
    let heads = [
        "no.", "kind", left, right, "floors", "length", "gap", "normal",
    ];
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells
            .chain([heads[column].chars().count()])
            .max()
            .unwrap_or(0)
    };
    let line = |text: &mut String, cells: [&str; 8], last: &str| {
        let mut line = String::from(" ");
        for (column, cell) in cells.into_iter().enumerate() {
            let blanks = " ".repeat(width(column) - cell.chars().count());
            // Numbers to the right, words to the left.
            line += &match column {
                0 | 5 | 6 => format!(" {blanks}{cell} "),
                _ => format!(" {cell}{blanks} "),
            };
        }
        writeln!(text, "{}", format!("{line} {last}").trim_end())
    };
    line(text, heads, "middle")?;
    for (row, (_, place)) in rows.iter().zip(
        places
            .iter()
            .enumerate()
            .filter(|(_, place)| place.gap_index == gap),
    ) {
        let middle = place.middle.map(|at| HEIGHT.text(at, 3)).join(", ");
        line(text, row.each_ref().map(|cell| &cell[..]), &middle)?;
    }
    writeln!(text)
}

/// Names of both sides.
fn names(system: &System, between: [Option<usize>; 2]) -> [&str; 2] {
    between.map(|side| system.side_name(side))
}

/// Both sides of a gap or a link, as far as they are buildings.
fn beside(model: &Model, between: [Option<usize>; 2]) -> [Option<&Building>; 2] {
    let sides = model.buildings_beside(between);
    sides.map(|side| model.buildings.get(side?))
}

/// The height of a point, and what is hit where that is not a floor.
fn height(height: f64, floors: [Option<usize>; 2], sides: [Option<&Building>; 2]) -> String {
    let struck = [0, 1].map(|side| {
        let building = sides[side].filter(|_| floors[side].is_none())?;
        Some(match face_is_wall(building, side, height) {
            true => "wall",
            false => "column",
        })
    });
    let what = match struck {
        [None, None] => String::new(),
        [Some(left), None] => format!(" (left {left})"),
        [None, Some(right)] => format!(" (right {right})"),
        [Some(left), Some(right)] if left == right => format!(" ({left}s)"),
        [Some(left), Some(right)] => format!(" (left {left}, right {right})"),
    };
    format!("{}{what}", HEIGHT.number(height, 2))
}

/// Whether a wall of a frame stands at the face of a building, on the left (0) or right of a gap, at a height above the datum.
fn face_is_wall(building: &Building, side: usize, height: f64) -> bool {
    let Structure::Frame(frame) = &building.structure else {
        return false;
    };
    let above = height - building.base.elevation;
    let floors = building.floor_heights();
    let storey = floors.iter().take_while(|floor| **floor < above).count();
    let line = match side {
        0 => frame.spans.len(),
        _ => 0,
    };
    frame.wall([storey, line]).is_some()
}

fn describe_building(
    text: &mut String,
    building: &BuildingSystem,
    model: &Building,
    kind: &str,
) -> std::fmt::Result {
    let equations = &building.equations;
    let stick_model = &building.discretization.stick_model;
    let lumps = stick_model
        .nodes
        .iter()
        .filter(|node| node.mass() > 0.0)
        .count();
    writeln!(text, "{}  {kind}", styled(BOLD, &building.name))?;
    writeln!(
        text,
        "  mass {} in {}, {} of freedom",
        MASS.text(equations.total_mass(), 3),
        counted(lumps, "lumped mass").replace("masss", "masses"),
        counted(equations.len(), "degree")
    )?;
    let periods: Vec<String> = building
        .lateral_modes()
        .take(5)
        .map(|mode: &Mode| decimals(mode.period(), 4))
        .collect();
    let torsion = building
        .first_torsional_mode()
        .map_or_else(String::new, |mode| {
            format!("; first in torsion {} s", decimals(mode.period(), 4))
        });
    writeln!(text, "  lateral periods {} s{torsion}", periods.join(", "))?;
    let lateral = building.lateral_modes().count();
    let damping = &model.damping;
    let damped = match damping {
        Damping::AllModes { ratio } => format!("damping {} % in every mode", percent(*ratio)),
        Damping::Rayleigh { .. } => "Rayleigh damping".to_owned(),
        Damping::Ratio { ratio, modes, sway } => {
            let damped = building.damped_at.iter();
            let numbers: Vec<usize> = match &modes[..] {
                [] => damped.clone().map(|mode| mode.number).collect(),
                modes => modes.to_vec(),
            };
            let in_plane = !building.is_in_space();
            // Modes with less than 1 % of the mass have no period among those above.
            let kind = match in_plane && numbers.iter().any(|number| *number > lateral) {
                true => "sway",
                false => "lateral",
            };
            let periods = damped.map(|mode| decimals(2.0 * PI / mode.frequency, 4));
            let periods: Vec<String> = periods.filter(|_| kind == "sway").collect();
            let modes: Vec<String> = numbers.iter().map(usize::to_string).collect();
            let plural = if modes.len() == 1 { "" } else { "s" };
            format!(
                "Rayleigh damping {} % in {kind} mode{plural} {}{}{}{}:",
                percent(*ratio),
                modes.join(" and "),
                match periods.is_empty() {
                    true => String::new(),
                    false => format!(" ({} s)", periods.join(" and ")),
                },
                match sway {
                    _ if in_plane => "",
                    Sway::Along => " of those along x",
                    Sway::Across => " of those along y",
                    Sway::Both => " of those along x and y",
                },
                if building.discretization.mat.is_some() {
                    " of the building fixed on its mat"
                } else if model.base.foundation.is_some() {
                    " of the building on rigid ground"
                } else {
                    ""
                }
            )
        }
    };
    if let Damping::AllModes { .. } = damping {
        return writeln!(text, "  {damped}");
    }
    writeln!(
        text,
        "  {damped} α = {} 1/s, β = {} s",
        decimals(equations.alpha, 5),
        decimals(equations.beta, 6)
    )?;
    let modes = building.lateral_modes().take(5);
    let acting: Vec<String> = modes
        .map(|mode| format!("{:.2}", 100.0 * building.damping_ratio(mode)))
        .collect();
    let lifts = model.base.uplift
        || model
            .base
            .foundation
            .is_some_and(|foundation| foundation.uplift.is_some());
    let before = match (building.equations.springs.is_empty(), lifts) {
        (true, _) => "",
        (false, true) if structure_yields(model) => " before it yields or lifts off",
        (false, true) => " before it lifts off",
        (false, false) => " before it yields",
    };
    writeln!(
        text,
        "  damping ratios of the lateral modes{before} {} %",
        acting.join(", ")
    )
}

/// A ratio in per cent, rounded to two decimals.
fn percent(ratio: f64) -> f64 {
    (1e4 * ratio).round() / 1e2
}

/// A number with a given number of decimals, or with three digits if the decimals are too few or too many.
fn decimals(value: f64, count: usize) -> String {
    let least = 10f64.powi(2 - count as i32);
    if value == 0.0 || (least..1e6).contains(&value) {
        format!("{value:.count$}")
    } else {
        format!("{value:.2e}")
    }
}

/// Special features of a building, one line each.
fn special(building: &Building) -> Vec<String> {
    let mut lines = Vec::new();
    let list = |parts: &[(&str, Option<f64>, &str)]| {
        let known = parts.iter().filter_map(|(name, value, unit)| {
            let value = value.filter(|value| *value > 0.0)?;
            Some(format!("{name} {}", prefixed(value, unit, 3)))
        });
        known.collect::<Vec<_>>().join(", ")
    };
    let base = &building.base;
    if !base.is_fixed() && base.isolation.is_none() && base.foundation.is_none() {
        let springs = list(&[
            ("rotation", base.rotational_stiffness, "N·m/rad"),
            ("sideways", base.horizontal_stiffness, "N/m"),
            ("torsion", base.torsional_stiffness, "N·m/rad"),
            ("vertical", base.vertical_stiffness, "N/m"),
        ]);
        let lifts = if base.uplift { "; feet lift off" } else { "" };
        lines.push(format!("base on springs: {springs}{lifts}"));
        let dashpots = list(&[
            ("rotation", Some(base.rotational_damping), "N·m·s/rad"),
            ("sideways", Some(base.horizontal_damping), "N·s/m"),
            ("torsion", Some(base.torsional_damping), "N·m·s/rad"),
            ("vertical", Some(base.vertical_damping), "N·s/m"),
        ]);
        if !dashpots.is_empty() {
            lines.push(format!("base with dashpots: {dashpots}"));
        }
        if let Some(base_across) = &base.across {
            let across = list(&[
                ("rotation", base_across.rotational_stiffness, "N·m/rad"),
                ("sideways", base_across.horizontal_stiffness, "N/m"),
                (
                    "dashpot of rotation",
                    Some(base_across.rotational_damping),
                    "N·m·s/rad",
                ),
                (
                    "dashpot sideways",
                    Some(base_across.horizontal_damping),
                    "N·s/m",
                ),
            ]);
            lines.push(format!("base across: {across}"));
        }
        if base.mass > 0.0 {
            lines.push(format!("footings of {}", MASS.text(base.mass, 2)));
        }
    }
    if building.gravity.preload {
        lines.push("gravity: starts from the displacements under self weight".into());
    }
    if building.gravity.p_delta {
        lines.push("P-Delta included, from the weight above".into());
    }
    if let Structure::Frame(frame) = &building.structure {
        // Walls and coupling beams say theirs in their own lines.
        let columns = frame
            .all_columns()
            .filter(|(place, _)| frame.wall(*place).is_none())
            .filter_map(|column| column.1.shear_rigidity);
        let beams = frame
            .all_beams()
            .filter(|(place, _)| frame.coupling_beam(*place).is_none())
            .filter_map(|beam| beam.1.shear_rigidity);
        let shear = list(&[
            ("columns", columns.min_by(f64::total_cmp), "N"),
            ("beams", beams.min_by(f64::total_cmp), "N"),
        ]);
        if !shear.is_empty() {
            lines.push(format!("members deform in shear, least GA: {shear}"));
        }
        let joint = list(&[
            ("rotation", frame.joint.rotational_stiffness, "N·m/rad"),
            ("sideways", frame.joint.horizontal_stiffness, "N/m"),
            ("vertical", frame.joint.vertical_stiffness, "N/m"),
        ]);
        if !joint.is_empty() {
            lines.push(format!("beam ends on springs: {joint}"));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use jostle::{Base, Damping, Shear};

    use super::*;

    #[test]
    fn what_is_special_gets_one_line_each() {
        let mut building = Building {
            name: "A".into(),
            structure: Structure::Shear(Shear {
                mass: vec![1e4],
                stiffness: vec![1e7],
                storey_heights: vec![3.0],
            }),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: 0.0,
            },
            ..Building::default()
        };
        assert_eq!(special(&building), Vec::<String>::new());
        building.gravity.p_delta = true;
        building.base = Base {
            horizontal_stiffness: Some(5e8),
            horizontal_damping: 2e6,
            mass: 3e3,
            ..Base::default()
        };
        assert_eq!(
            special(&building),
            [
                "base on springs: sideways 500 MN/m",
                "base with dashpots: sideways 2 MN·s/m",
                "footings of 3.00 t",
                "P-Delta included, from the weight above",
            ]
        );
    }
}
