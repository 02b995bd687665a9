//! Frames in words.

use std::fmt::Write;

use crate::numbers::counted;
use jostle::hysteresis::{Hysteresis, HysteresisRule, Side};
use jostle::statics::STANDARD_GRAVITY;
use jostle::{ColumnFibres, Diagonal, DiagonalKind, Frame, Section, SpaceFrame, StrutLine};
use jostle_io::shown::{
    FORCE, HEIGHT, LARGE_FORCE, LARGE_RIGIDITY, LARGE_STIFFNESS, LENGTH, Shown,
};

/// Whether the columns of a frame shorten, and why: whether the file says so, and whether the frame stands on soil; `None` if that is not
/// known.
pub(super) fn axial_of_columns(frame: &Frame, known: Option<[bool; 2]>) -> String {
    let (height, width): (f64, f64) = (frame.storey_heights.iter().sum(), frame.spans.iter().sum());
    let what = match frame.axial.columns_flexible {
        true => "columns axially flexible",
        false => "columns axially rigid",
    };
    let limit = |word: &str| {
        let (slender, tall) = (Frame::SLENDER, Frame::TALL);
        format!("{slender} times as high as wide {word} {tall} storeys")
    };
    let why = match (known, frame.axial.columns_flexible, frame.tallness() > 1.0) {
        (Some([true, _]), ..) => ", as given".to_owned(),
        (Some([false, _]), true, _) if !frame.walls.is_empty() => {
            ", the default of frames with walls".to_owned()
        }
        (Some([false, _]), true, _) => format!(" (default above {})", limit("or")),
        (Some([false, true]), false, _) => " (default on a foundation on soil)".to_owned(),
        (Some([false, false]), false, true) => ": no EA".to_owned(),
        (Some([false, false]), false, false) => format!(" (default up to {})", limit("and")),
        (None, ..) => String::new(),
    };
    if width > 0.0 {
        format!("{what}{why}; {:.1} times as high as wide", height / width)
    } else {
        format!("{what}{why}")
    }
}

/// Whether the members of a frame differ within a storey, and how many it lacks.
pub(super) fn members(frame: &Frame) -> String {
    if frame.is_regular() {
        return String::new();
    }
    let storeys = frame.storey_heights.len();
    let columns = storeys * frame.lines() - frame.all_columns().count();
    let beams = storeys * frame.spans.len() - frame.all_beams().count();
    let mut text = String::new();
    for (count, noun) in [(columns, "column"), (beams, "beam")] {
        if count > 0 {
            text += &format!(", {} omitted", counted(count, noun));
        }
    }
    let joints = (1..=storeys).flat_map(|floor| (0..frame.lines()).map(move |line| [floor, line]));
    let on_beams = joints.filter(|&[floor, line]| {
        frame.column(floor - 1, line).is_none() && frame.beams_cross(floor, line)
    });
    match on_beams.count() {
        0 => {}
        count => {
            let joints = counted(count, "joint");
            text += &format!(", beams continuous over {joints} without a column below");
        }
    }
    let mut sections = (frame.own_columns.values()).chain(frame.own_beams.values());
    if sections.any(Option::is_some) {
        text += ", sections that differ by line or bay";
    }
    text
}

/// Factors that EI and GA contain, if there are any.
fn factors([bending, shear]: [f64; 2]) -> String {
    match (bending, shear) {
        (1.0, 1.0) => String::new(),
        _ => format!(" (factors {bending:.3} on EI, {shear:.3} on GA)"),
    }
}

/// Every wall and the coupling beams of a frame, with the rigidities in use.
pub(super) fn walls(frame: &Frame) -> String {
    let rigidities = |section: Option<&Section>, [bending, shear]: [f64; 2]| {
        let Some(section) = section else {
            return String::new();
        };
        let number = |name: &str, value: Option<f64>, unit: Shown| {
            value.map_or_else(String::new, |value| {
                format!(", {name} {}", unit.text(value, 3))
            })
        };
        let bent = number("EI", Some(section.flexural_rigidity), LARGE_RIGIDITY);
        let stretched = number("EA", section.axial_rigidity, LARGE_FORCE);
        let sheared = match section.shear_rigidity {
            Some(rigidity) => number("GA", Some(rigidity), LARGE_FORCE),
            None => ", rigid in shear".to_owned(),
        };
        format!("{bent}{stretched}{sheared}{}", factors([bending, shear]))
    };
    let storeys = |[first, last]: [usize; 2], noun: &str| match first == last {
        true => format!("{noun} {first}"),
        false => format!("{noun}s {first}–{last}"),
    };
    let mut text = String::new();
    let unit = HEIGHT.name();
    let lines = frame.line_positions();
    for (index, wall) in frame.walls.iter().enumerate() {
        let section = frame.column(wall.storeys[0] - 1, wall.line - 1);
        let at_foot = |hinge: &jostle::WallHinge| hinge.storey == wall.storeys[0] && !hinge.at_head;
        let bends = match &wall.hinges[..] {
            [] => String::new(),
            [hinge] if at_foot(hinge) => "at its foot".to_owned(),
            all => format!("at {} storey ends", all.len()),
        };
        let yields = match (bends.as_str(), wall.shear) {
            ("", None) => String::new(),
            (bends, None) => format!(", yields {bends}"),
            ("", Some(_)) => ", yields in shear".to_owned(),
            (bends, Some(_)) => format!(", yields {bends} and in shear"),
        };
        let yields = match by_fibres(wall.fibres.values()) {
            fibres if !fibres.is_empty() => format!(", {fibres}{yields}"),
            _ => yields,
        };
        text += &format!(
            "  wall {} at {} {unit}, {}, {} {unit} long{}{yields}\n",
            index + 1,
            HEIGHT.stated(lines[wall.line - 1]),
            storeys(wall.storeys, "storey"),
            HEIGHT.stated(wall.length),
            rigidities(section, wall.stiffness_factors)
        );
    }
    // Floors one above the other with equal beams are one line.
    let mut said: Vec<(usize, [usize; 2], String)> = Vec::new();
    for beam in &frame.coupling_beams {
        let place = [beam.floor - 1, beam.bay - 1];
        let yields = if beam.shear.is_some() {
            ", yield in shear"
        } else {
            ""
        };
        let text = format!(
            "{} long{}{yields}",
            HEIGHT.text(frame.clear_span(place), 3),
            rigidities(frame.beam(place[0], place[1]), beam.stiffness_factors)
        );
        match said.last_mut() {
            Some((bay, floors, known))
                if *bay == beam.bay && *known == text && floors[1] + 1 == beam.floor =>
            {
                floors[1] = beam.floor;
            }
            _ => said.push((beam.bay, [beam.floor; 2], text)),
        }
    }
    for (bay, floors, words) in said {
        text += &format!(
            "  coupling beams of bay {bay}, {}, {words}\n",
            storeys(floors, "floor")
        );
    }
    text
}

/// Fibres at ends of storeys of a wall; empty without any.
fn by_fibres<'a>(all: impl Iterator<Item = &'a ColumnFibres>) -> String {
    let mut ends = 0;
    let mut first: Option<&ColumnFibres> = None;
    for own in all {
        ends += own.at_ends.iter().filter(|stands| **stands).count();
        first = first.or(Some(own));
    }
    first.map_or_else(String::new, |own| {
        let place = match (ends, own.at_ends) {
            (1, [true, _]) => "the foot".to_owned(),
            _ => counted(ends, "storey end"),
        };
        format!(
            "fibre section ({} fibres) at {place}, hinge length {}",
            own.fibres.len(),
            HEIGHT.text(own.length, 3)
        )
    })
}

/// Every wall of a space frame.
pub(super) fn space_walls(frame: &SpaceFrame) -> String {
    let mut text = String::new();
    let unit = HEIGHT.name();
    for (index, wall) in frame.walls.iter().enumerate() {
        let [x, y] = wall.line;
        let storeys = match wall.storeys {
            [first, last] if first == last => format!("storey {}", first + 1),
            [first, last] => format!("storeys {}–{}", first + 1, last + 1),
        };
        let foot = wall.column(wall.storeys[0]);
        let mut members = frame.members.iter();
        let Some(member) = members.find(|member| member.place == foot) else {
            continue;
        };
        let (section, plane) = (&member.section, wall.along.index());
        let number = |name: &str, value: Option<f64>, unit: Shown| {
            value.map_or_else(String::new, |value| {
                format!(", {name} {}", unit.text(value, 3))
            })
        };
        let rigidities = number("EI", Some(section.flexural_rigidity[plane]), LARGE_RIGIDITY)
            + &number("EA", section.axial_rigidity, LARGE_FORCE)
            + &number(
                "GA",
                section
                    .shear_rigidity
                    .map(|shear_rigidity| shear_rigidity[plane]),
                LARGE_FORCE,
            )
            + &factors(wall.stiffness_factors);
        let own = frame.fibres.iter().filter(|(place, _)| wall.has(**place));
        let yields = match by_fibres(own.map(|(_, own)| own)) {
            fibres if !fibres.is_empty() => format!(", {fibres}"),
            _ if member.may_yield() => ", yields".to_owned(),
            _ => String::new(),
        };
        let _ = write!(
            text,
            "\n  wall {} along {} at x = {} {unit}, y = {} {unit}, {storeys}, {} {unit} long{rigidities}{yields}",
            index + 1,
            wall.along.name(),
            HEIGHT.stated(frame.lines_x[x]),
            HEIGHT.stated(frame.lines_y[y]),
            HEIGHT.stated(wall.length),
        );
    }
    text
}

/// Braces and infill panels, as far as there are any.
pub(super) fn diagonals(diagonals: &[Diagonal]) -> String {
    let is_side = |diagonal: &Diagonal| diagonal.place.strut != StrutLine::Central;
    let count = |kind| {
        let all = diagonals.iter().filter(|diagonal| !is_side(diagonal));
        all.filter(|diagonal| diagonal.place.kind == kind).count()
    };
    let mut text = String::new();
    // A panel is two struts, or three times two.
    let [braces, panels] = [count(DiagonalKind::Brace), count(DiagonalKind::Infill) / 2];
    for (count, noun) in [(braces, "brace"), (panels, "infill panel")] {
        if count > 0 {
            text += &format!(", {}", counted(count, noun));
        }
    }
    let laws = |kind| {
        let all = diagonals.iter();
        let laws = all.filter(move |diagonal| diagonal.place.kind == kind);
        laws.filter_map(|law| law.hysteresis)
    };
    let between = |laws: &[Hysteresis], value: &dyn Fn(&Hysteresis) -> f64| {
        let values = laws.iter().map(value);
        let [least, most] = values.fold([f64::INFINITY, 0.0], |[least, most], value| {
            [f64::min(least, value), f64::max(most, value)]
        });
        if most - least < 5e-3 * most {
            format!("{most:.0}")
        } else {
            format!("{least:.0} to {most:.0}")
        }
    };
    let pressed = |hysteresis: &Hysteresis| *hysteresis.backbone().side(Side::Negative);
    let (force, stiffness) = (FORCE.name(), LARGE_STIFFNESS.name());
    let buckling: Vec<_> = laws(DiagonalKind::Brace)
        .filter(|law| matches!(law.rule(), HysteresisRule::Buckling(_)))
        .collect();
    if !buckling.is_empty() {
        text += &format!(
            " ({} that buckle at {} {force} and yield at {} {force})",
            counted(buckling.len(), "brace"),
            between(&buckling, &|own| FORCE.of(pressed(own).yielding.force)),
            between(&buckling, &|own| FORCE.of(own.backbone().yield_force())),
        );
    }
    let cracking: Vec<_> = laws(DiagonalKind::Infill)
        .filter(|law| matches!(law.rule(), HysteresisRule::Pinched(_)))
        .collect();
    if !cracking.is_empty() {
        text += &format!(
            " (struts of {} {stiffness}, cracking {} {force}, strength {} {force})",
            between(&cracking, &|own| LARGE_STIFFNESS
                .of(own.backbone().initial())),
            between(&cracking, &|own| FORCE.of(pressed(own).cracking.force)),
            between(&cracking, &|own| FORCE.of(pressed(own).yielding.force)),
        );
    }
    let mut panels = diagonals
        .iter()
        .filter(|diagonal| diagonal.place.kind == DiagonalKind::Infill);
    if panels.clone().any(is_side) {
        text += ", three struts each way";
    }
    let offsets = panels
        .clone()
        .map(|panel| panel.offsets[0].max(panel.offsets[1]));
    let offset = offsets.fold(0.0, f64::max);
    if offset > 0.0 {
        text += &format!(
            ", struts connected up to {} from the joints",
            HEIGHT.text(offset, 2)
        );
    }
    if let Some(damage) = panels.find_map(|panel| panel.damage) {
        let drifts = damage.drifts.map(|drift| format!("{:.2}", 100.0 * drift));
        text += &format!(
            ", damage states 1–4 begin at drifts of {} %",
            drifts.join(" / ")
        );
    }
    let panels = diagonals.iter().filter_map(|diagonal| diagonal.across);
    let fall = match panels.clone().any(|panel| panel.falls) {
        true => " (falls out beyond it)",
        false => "",
    };
    let accelerations = panels.map(|panel| panel.limit() / STANDARD_GRAVITY);
    let [least, most] = accelerations.fold([f64::INFINITY, 0.0], |[least, most], acceleration| {
        [f64::min(least, acceleration), f64::max(most, acceleration)]
    });
    if most > 0.0 {
        let range = match most - least < 5e-3 * most {
            true => format!("{most:.2}"),
            false => format!("{least:.2} to {most:.2}"),
        };
        text += &format!(", out-of-plane strength {range} g{fall}");
    }
    text
}

/// Rigid ends by joint, as far as there are any: of beams, and of columns \[m\].
pub(super) fn rigid_ends(zones: impl Iterator<Item = [f64; 2]> + Clone) -> String {
    let [beams, columns] =
        [0, 1].map(|side| zones.clone().map(|zone| zone[side]).fold(0.0, f64::max));
    match beams + columns > 0.0 {
        true => format!(
            ", rigid ends up to {} of beams and {} of columns",
            LENGTH.text(beams, 0),
            LENGTH.text(columns, 0)
        ),
        false => String::new(),
    }
}
