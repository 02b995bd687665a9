//! Frames in words.

use jostle::{DiagonalKind, Frame};
use jostle_run::counted;

/// Whether the columns of a frame shorten, and why; `None` if it is not known whether the file says so.
pub(super) fn axial_of_columns(frame: &Frame, is_stated: Option<bool>) -> String {
    let (height, width): (f64, f64) = (frame.storey_heights.iter().sum(), frame.spans.iter().sum());
    let what = match frame.axial.columns_flexible {
        true => "columns shorten under axial force",
        false => "columns keep their length",
    };
    let limit = format!(
        "{} times as high as wide or {} storeys",
        Frame::SLENDER,
        Frame::TALL
    );
    let why = match (
        is_stated,
        frame.axial.columns_flexible,
        frame.tallness() > 1.0,
    ) {
        (Some(true), ..) => ", as stated".to_owned(),
        (Some(false), true, _) => format!(", the default above {limit}"),
        (Some(false), false, true) => ": no EA, or a foundation on soil".to_owned(),
        (Some(false), false, false) => format!(", the default up to {limit}"),
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
    let mut sections = (frame.own_columns.values()).chain(frame.own_beams.values());
    if sections.any(Option::is_some) {
        text += ", sections that differ by line or bay";
    }
    text
}

/// Braces and infill panels, as far as there are any.
pub(super) fn diagonals(frame: &Frame) -> String {
    let count = |kind| {
        let all = frame.diagonals.iter();
        all.filter(|own| own.place.kind == kind).count()
    };
    let mut text = String::new();
    // A panel is two struts.
    let [braces, panels] = [count(DiagonalKind::Brace), count(DiagonalKind::Infill) / 2];
    for (count, noun) in [(braces, "brace"), (panels, "infill panel")] {
        if count > 0 {
            text += &format!(", {}", counted(count, noun));
        }
    }
    text
}
