//! `shear_failure`: columns that fail in shear.

use std::collections::BTreeMap;

use jostle::hysteresis::{FallingBranch, Hysteresis, SpringFault};
use jostle::model::CapacityLine;
use jostle::{
    ColumnLine, Frame, Hinges, Model, PlanAxis, PlanColumn, ShearEnds, ShearSpring, SpaceFrame,
    SpacePlace, Structure,
};
use jostle_section::capacity::{RatedMember, ShearRule};

use super::building::per_storey;
use super::frame_members::filled;
use super::reinforced::ReinforcedMember;
use crate::keys::{AXIAL_FIRST, SHEAR_ENDS, SHEAR_RULES, Section};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// Stiffness of a shear spring before failure, over 12 EI/L³ of its column: the column loses 10⁻⁴ of its own \[–\].
const RIGID: f64 = 1e4;

/// What a user can do about a column that loses its axial load before it fails in shear.
const AXIAL_FIRST_REMEDY: &str = "add axial_first = \"axial-limit\": such columns lose their shear from their strength to the drift at axial failure; or slope = \"8 MN/m\" for all columns";

/// A column that can fail, in one plane in which it bends.
struct FailingColumn {
    /// In words.
    words: String,
    /// Its name among reinforced members.
    name: String,
    /// Counted from 0.
    storey: usize,
    /// Of the storey \[m\].
    length: f64,
    /// E I in that plane \[N·m²\].
    rigidity: f64,
    /// GA_s there, where shear deforms it \[N\].
    shear_rigidity: Option<f64>,
    /// Whether that is the plane across, of a space frame.
    is_across: bool,
}

/// Reads the shear springs of all columns of a plane frame by storey and line; `None` after a fault. `members`: the reinforced members of
/// the building, `None` after faults elsewhere; their names begin with `prefix`.
pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    frame: &Frame,
    prefix: &str,
    members: Option<&[ReinforcedMember]>,
) -> Option<Vec<Vec<ShearSpring>>> {
    // Walls are no columns.
    let all = || {
        let columns = frame.all_columns();
        columns.filter(|(place, _)| frame.wall(*place).is_none())
    };
    let columns = all().map(|([storey, line], section)| FailingColumn {
        words: format!("column {} of storey {}", line + 1, storey + 1),
        name: format!("{prefix}column.{}.{}", line + 1, storey + 1),
        storey,
        length: frame.storey_heights[storey],
        rigidity: section.flexural_rigidity,
        shear_rigidity: section.shear_rigidity,
        is_across: false,
    });
    let columns: Vec<FailingColumn> = columns.collect();
    let storeys = frame.storey_heights.len();
    let springs = springs_of(
        reader,
        field,
        &columns,
        storeys,
        members,
        !prefix.is_empty(),
    )?;
    let mut rows = vec![vec![None; frame.lines()]; storeys];
    for (([storey, line], _), spring) in all().zip(springs) {
        rows[storey][line] = Some(spring);
    }
    Some(filled(rows))
}

/// Reads those of a space frame, in both planes of every column that is not a wall.
pub(super) fn read_in_space(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    frame: &SpaceFrame,
    storey_heights: &[f64],
    members: Option<&[ReinforcedMember]>,
) -> Option<BTreeMap<(SpacePlace, PlanAxis), ShearSpring>> {
    let is_column = |place: SpacePlace| {
        matches!(place, SpacePlace::Column { .. })
            && !frame.walls.iter().any(|wall| wall.has(place))
    };
    let standing = frame
        .members
        .iter()
        .filter(|member| is_column(member.place));
    let both = standing.flat_map(|member| PlanAxis::BOTH.map(|axis| (member, axis)));
    let both: Vec<_> = both.collect();
    let columns = both.iter().map(|(member, axis)| {
        let ([[x, y], _], storey) = (member.place.crossings(), member.place.storey());
        let section = &member.section;
        FailingColumn {
            words: format!(
                "the column at x = {}, y = {} of storey {}",
                x + 1,
                y + 1,
                storey + 1
            ),
            name: member.place.to_string(),
            storey,
            length: storey_heights[storey],
            rigidity: section.flexural_rigidity[axis.index()],
            shear_rigidity: section.shear_rigidity.map(|both| both[axis.index()]),
            is_across: *axis == PlanAxis::Y,
        }
    });
    let columns: Vec<FailingColumn> = columns.collect();
    let springs = springs_of(reader, field, &columns, storey_heights.len(), members, true)?;
    let places = both.iter().map(|(member, axis)| (member.place, *axis));
    Some(places.zip(springs).collect())
}

/// The shear springs of these columns, in their order. `in_plan`: whether they have no mass between floors, so that their shear is the same
/// at both ends unless a neighbour hits them.
fn springs_of(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    columns: &[FailingColumn],
    storeys: usize,
    members: Option<&[ReinforcedMember]>,
    in_plan: bool,
) -> Option<Vec<ShearSpring>> {
    let view = reader.open(field, &[Section::ShearFailure])?;
    let mut list = |key, dimension| {
        let field = reader.get(&view, key)?;
        Some(positive_per_storey(reader, &field, dimension, storeys))
    };
    let strength = list("strength", Dimension::Force);
    let slope = list("slope", Dimension::Stiffness);
    let residual = match reader.get(&view, "residual") {
        Some(field) => {
            let value = reader.quantity(&field, Dimension::Dimensionless)?;
            if !(0.0..1.0).contains(&value) {
                *reader.bad(
                    &field,
                    format!(
                        "must be at least 0 and less than 1, a share of the strength; found {value}"
                    ),
                ) = Some("0 loses all of it".into());
                return None;
            }
            value
        }
        None => 0.0,
    };
    let ends = match reader.get(&view, "ends") {
        Some(field) if in_plan => {
            *reader.bad(&field, "is for frames without a plan") = Some(
                "leave it out: columns fail at their feet, and at their heads too where neighbours can hit them between floors".into(),
            );
            return None;
        }
        Some(field) => match reader.choice(&field, SHEAR_ENDS, &[])? {
            "both" => ShearEnds::Both,
            _ => ShearEnds::Foot,
        },
        None => ShearEnds::Foot,
    };
    let rule = reader.get(&view, "rule");
    let to_axial_limit = match reader.get(&view, "axial_first") {
        Some(field) => reader.choice(&field, AXIAL_FIRST, &[])? == "axial-limit",
        None => false,
    };
    if let (Some(field), None) = (reader.get(&view, "axial_first"), &rule) {
        *reader.bad(&field, "has no effect without rule") =
            Some("add rule = \"sezen-moehle\", or leave axial_first out".into());
        return None;
    }
    if let (Some(field), Some(_)) = (&rule, &strength) {
        *reader.bad(field, "cannot be combined with strength") =
            Some("keep either the rule or the strength".into());
        return None;
    }
    let losses = match (rule, strength) {
        (Some(field), _) => {
            let name = reader.choice(&field, SHEAR_RULES, &[])?;
            let slope = match slope {
                Some(read) => Some(read?),
                None => None,
            };
            by_rule(
                reader,
                &field,
                columns,
                ShearRule::from_name(name)?,
                slope.as_deref(),
                to_axial_limit,
                members?,
            )?
        }
        (None, Some(strength)) => {
            let Some(slope) = slope else {
                reader.missing(
                    &view,
                    "slope",
                    "add slope = \"5 MN/m\", the loss of shear per drift of the column after failure",
                );
                return None;
            };
            let (strength, slope) = (strength?, slope?);
            let stated = columns.iter().map(|column| Loss {
                strength: strength[column.storey],
                fall: Fall::Slope(slope[column.storey]),
                by_ductility: CapacityLine::default(),
            });
            stated.collect()
        }
        (None, None) => {
            reader.missing(
                &view,
                "rule",
                "add rule = \"sezen-moehle\", or strength = \"300 kN\" with slope = \"5 MN/m\"",
            );
            return None;
        }
    };
    springs(reader, field, columns, losses, residual, ends)
}

/// Strength of a column and how it is lost.
#[derive(Clone, Debug)]
struct Loss {
    /// \[N\]
    strength: f64,
    fall: Fall,
    by_ductility: CapacityLine,
}

/// How a column as a whole loses its shear after failure.
#[derive(Clone, Copy, Debug)]
enum Fall {
    /// Loss per displacement \[N/m\].
    Slope(f64),
    /// From the displacement at which the elastic column has its strength to this one, at which it has none \[m\].
    To(f64),
}

fn positive_per_storey(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    dimension: Dimension,
    storeys: usize,
) -> Option<Vec<f64>> {
    let values = per_storey(reader, field, dimension, Some(storeys))?;
    if values.iter().any(|value| *value <= 0.0) {
        reader.bad(field, "must be greater than zero");
        return None;
    }
    Some(values)
}

/// Strengths and slopes from the reinforcement.
fn by_rule(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    columns: &[FailingColumn],
    rule: ShearRule,
    slope: Option<&[f64]>,
    to_axial_limit: bool,
    members: &[ReinforcedMember],
) -> Option<Vec<Loss>> {
    let mut losses = Vec::with_capacity(columns.len());
    for own in columns {
        let mut members = members.iter();
        let column = members.find(|member| member.name == own.name);
        let Some(column) = column.filter(|column| column.section.ties.is_some()) else {
            *reader.bad(field, format!("needs bars and ties of every column, and {} has none", own.words)) = Some(
                "add steel = \"HRB400\", bars = \"12 d20\", ties = \"d10 @ 150 mm\" to column, or give strength and slope instead of rule"
                    .into(),
            );
            return None;
        };
        let turned = own.is_across.then(|| column.section.turned());
        let clear_length = match own.is_across {
            true => column.clear_length_across.unwrap_or(column.clear_length),
            false => column.clear_length,
        };
        let rated = RatedMember {
            section: turned.as_ref().unwrap_or(&column.section),
            member: column.member,
            clear_length,
            level: column.level,
        };
        let mut refused = |problem: String, remedy: &str| {
            *reader.bad(field, format!("{}: {problem}", own.words)) = Some(remedy.into());
        };
        let loss = match rated.shear_loss(rule, column.compression) {
            Ok(loss) => loss,
            Err(problem) => {
                refused(
                    problem.to_string(),
                    "give strength and slope instead of rule",
                );
                return None;
            }
        };
        let fall = match (
            slope.map(|slope| slope[own.storey]).or(loss.slope),
            to_axial_limit,
        ) {
            (Some(slope), _) => Fall::Slope(slope),
            (None, true) => Fall::To(loss.axial_failure_drift * clear_length),
            (None, false) => {
                let problem = format!(
                    "under {} kN it loses its axial load at a drift of {:.2} %, before shear failure at {:.2} %, so that Elwood and Moehle give no slope",
                    (column.compression / 1e3).round(),
                    100.0 * loss.axial_failure_drift,
                    100.0 * loss.failure_drift,
                );
                refused(problem, AXIAL_FIRST_REMEDY);
                return None;
            }
        };
        losses.push(Loss {
            strength: loss.strength,
            fall,
            by_ductility: loss.by_ductility,
        });
    }
    Some(losses)
}

/// The springs: the column and its spring together lose shear with the given slope while the column unloads,
/// 1/k = 1/k_column + 1/k_spring with 12 EI/L³ of a column whose ends do not turn.
fn springs(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    columns: &[FailingColumn],
    losses: Vec<Loss>,
    residual: f64,
    ends: ShearEnds,
) -> Option<Vec<ShearSpring>> {
    let mut springs = Vec::with_capacity(losses.len());
    for (column, loss) in columns.iter().zip(losses) {
        let (length, rigidity) = (column.length, column.rigidity);
        let shear = column
            .shear_rigidity
            .map_or(0.0, |shear| 12.0 * rigidity / (shear * length * length));
        let stiffness = 12.0 * rigidity / (length * length * length * (1.0 + shear));
        let reached = loss.strength / stiffness;
        let lost = match loss.fall {
            Fall::Slope(slope) => 1.0 / slope,
            Fall::To(end) => (end - reached) / loss.strength,
        };
        if lost <= 0.0 {
            let problem = format!(
                "{} reaches its shear strength at a drift of {:.2} %, beyond its axial limit",
                column.words,
                100.0 * reached / length
            );
            *reader.bad(field, problem) =
                Some("it loses its axial load before it can fail in shear: reduce its axial_load, or give slope".into());
            return None;
        }
        let falling = FallingBranch {
            slope: 1.0 / (lost + 1.0 / stiffness),
            residual: residual * loss.strength,
        };
        match Hysteresis::failing(RIGID * stiffness, loss.strength, falling) {
            Ok(spring) => springs.push(ShearSpring {
                spring,
                ends,
                by_ductility: loss.by_ductility,
            }),
            Err(faults) => {
                let problem = faults
                    .first()
                    .map_or("", |fault: &SpringFault| fault.problem.as_str());
                reader.bad(field, problem.to_owned());
                return None;
            }
        }
    }
    Some(springs)
}

/// Gives columns that neighbours can strike between floors a second spring, unless the file says where springs stand.
pub(super) fn add_heads(model: &mut Model, reader: &mut Reader<'_>, view: &View<'_>) {
    let stated = |reader: &mut Reader<'_>, index: usize| {
        let buildings = reader.get(view, "building")?;
        let entry = buildings.entries()?.into_iter().nth(index)?;
        let sections = &[Section::Building, Section::Frame];
        let building_view = reader.reopen(&entry, sections)?;
        let failure = reader.get(&building_view, "shear_failure")?;
        let failure_view = reader.reopen(&failure, &[Section::ShearFailure])?;
        reader.get(&failure_view, "ends")
    };
    for index in 0..model.buildings.len() {
        if let Structure::Tiers(_) = &model.buildings[index].structure {
            let struck = model.columns_struck_between_floors(index);
            let Structure::Tiers(tiers) = &mut model.buildings[index].structure else {
                continue;
            };
            for PlanColumn { line, storey } in struck {
                match line {
                    ColumnLine::Crossing(line) => {
                        let column = SpacePlace::Column { line, storey };
                        let frames = tiers.space_frame.iter_mut();
                        let shear = frames.flat_map(|frame| &mut frame.shear);
                        for (_, spring) in shear.filter(|((of, _), _)| *of == column) {
                            spring.ends = ShearEnds::Both;
                        }
                    }
                    ColumnLine::OfFrame([frame, line]) => {
                        let shear = &mut tiers.frames[frame].hinges.shear;
                        let spring = shear.get_mut(storey).and_then(|row| row.get_mut(line));
                        if let Some(spring) = spring {
                            spring.ends = ShearEnds::Both;
                        }
                    }
                }
            }
            continue;
        }
        let fails = |hinges: &Hinges| matches!(hinges, Hinges::Frame(own) if !own.shear.is_empty());
        if !model.buildings[index].hinges.as_ref().is_some_and(fails)
            || stated(reader, index).is_some()
        {
            continue;
        }
        let points = model.points_between_floors(index);
        let heights = model.buildings[index].storey_heights().to_vec();
        let Structure::Frame(frame) = &model.buildings[index].structure else {
            continue;
        };
        let outer: Vec<_> = (1..=heights.len())
            .map(|floor| frame.outer_lines(floor))
            .collect();
        let Some(Hinges::Frame(hinges)) = &mut model.buildings[index].hinges else {
            continue;
        };
        for (storey, row) in hinges.shear.iter_mut().enumerate() {
            let foot: f64 = heights[..storey].iter().sum();
            let inside = |height: &&f64| **height > foot && **height < foot + heights[storey];
            let struck = points
                .each_ref()
                .map(|side| side.iter().any(|h| inside(&h)));
            let Some([first, last]) = outer[storey] else {
                continue;
            };
            for (line, is_struck) in [(first, struck[0]), (last, struck[1])] {
                if is_struck {
                    row[line].ends = ShearEnds::Both;
                }
            }
        }
    }
}
