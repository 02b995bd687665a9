//! Parts of frames in the text of a summary.

use std::fmt::Write;

use jostle::results::summary::{BuildingSummary, PartSummary};
use jostle_io::shown::{ENERGY, FORCE, MOMENT};

use crate::numbers::counted;

/// The greatest forces of braces, struts, walls and coupling beams of every building.
pub(crate) fn write_parts(text: &mut String, buildings: &[BuildingSummary]) -> std::fmt::Result {
    for (kind, noun) in [("brace", "Braces"), ("infill", "Infill struts")] {
        for building in buildings {
            let parts = || building.parts.iter().filter(|part| part.kind == kind);
            let pulled = parts().max_by(|a, b| a.force_max_n.total_cmp(&b.force_max_n));
            let pressed = parts().min_by(|a, b| a.force_min_n.total_cmp(&b.force_min_n));
            let (Some(pulled), Some(pressed)) = (pulled, pressed) else {
                continue;
            };
            let dissipated: f64 = parts().map(|part| part.dissipated_j).sum();
            let spent = match dissipated > 0.0 {
                true => format!("; {} dissipated in total", ENERGY.text(dissipated, 1)),
                false => String::new(),
            };
            // Struts have no tension.
            let tension = match kind {
                "infill" => String::new(),
                _ => {
                    let tension = FORCE.text(pulled.force_max_n, 0);
                    match pulled.name == pressed.name {
                        true => format!("{tension} of tension and "),
                        false => format!("{tension} of tension in {}, ", pulled.name),
                    }
                }
            };
            writeln!(
                text,
                "\n{noun} of {}: up to {tension}{} of compression in {}{spent}{}",
                building.name,
                FORCE.text(-pressed.force_min_n, 0),
                pressed.name,
                buckled(&parts().collect::<Vec<_>>())
            )?;
            if kind == "infill" {
                write_damage(text, building)?;
            }
            let across = parts().filter_map(|part| Some((part.out_of_plane_ratio?, &part.name)));
            if let Some((ratio, name)) = across.max_by(|a, b| a.0.total_cmp(&b.0)) {
                writeln!(
                    text,
                    "Out-of-plane demand of panels of {}: up to {ratio:.2} times their strength, in {name}{}",
                    building.name,
                    fallen(building)
                )?;
            }
        }
    }
    buildings
        .iter()
        .try_for_each(|building| write_walls(text, building))?;
    crate::footing_text::write(text, buildings)
}

/// How many infill panels reach which damage state, and where the drift is greatest.
fn write_damage(text: &mut String, building: &BuildingSummary) -> std::fmt::Result {
    let panels = building.damaged_panels();
    let Some(worst) = panels.iter().max_by(|a, b| a.drift.total_cmp(&b.drift)) else {
        return Ok(());
    };
    let counts = (1..=4).rev().filter_map(|state| {
        let count = panels.iter().filter(|panel| panel.state == state).count();
        (count > 0).then_some((state, count))
    });
    // The first one says of how many panels.
    let all = counted(panels.len(), "panel");
    let counts = counts
        .enumerate()
        .map(|(index, (state, count))| match index {
            0 => format!("{count} of {all} in state {state}"),
            _ => format!("{count} in state {state}"),
        });
    let counts: Vec<String> = counts.collect();
    let counts = match counts.is_empty() {
        true => format!("none of {all} damaged"),
        false => counts.join(", "),
    };
    writeln!(
        text,
        "Infill damage by drift, {}: {counts}; up to {:.2} % in {}",
        building.name,
        100.0 * worst.drift,
        worst.name
    )
}

/// Which panels fall out, if any does.
fn fallen(building: &BuildingSummary) -> String {
    let panels = building.fallen_panels();
    let first = panels.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    first.map_or_else(String::new, |(name, at)| {
        let verb = if panels.len() == 1 { "falls" } else { "fall" };
        format!(
            "; {} {verb} out, {name} first at {at:.3} s",
            counted(panels.len(), "panel")
        )
    })
}

/// Which braces buckle, if any does.
fn buckled(braces: &[&PartSummary]) -> String {
    let when = |part: &&PartSummary| Some((part.buckled_s?, part.name.clone()));
    let mut times: Vec<(f64, String)> = braces.iter().filter_map(when).collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    match times.first() {
        Some((time, name)) => format!(
            "; {} of {} buckle, {name} first at {time:.3} s",
            times.len(),
            braces.len()
        ),
        None => String::new(),
    }
}

/// Moments at the feet of walls, and what couples them.
fn write_walls(text: &mut String, building: &BuildingSummary) -> std::fmt::Result {
    let moment = |part: &PartSummary| {
        let both = [part.moment_max_n_m, part.moment_min_n_m].map(Option::unwrap_or_default);
        both[0].max(-both[1])
    };
    let walls = building.parts.iter().filter(|part| part.kind == "wall");
    if let Some(worst) = walls.max_by(|a, b| moment(a).total_cmp(&moment(b))) {
        let turned =
            [worst.rotation_max_rad, worst.rotation_min_rad].map(Option::unwrap_or_default);
        let turned = turned[0].max(turned[1]);
        let hinge = match turned > 0.0 {
            true => format!(", hinge rotation {:.2} mrad", turned * 1e3),
            false => String::new(),
        };
        let coupled = building
            .degree_of_coupling
            .map_or_else(String::new, |degree| {
                format!(
                    "; axial couple carries {:.0} % of the moment at the base",
                    100.0 * degree
                )
            });
        writeln!(
            text,
            "\nWalls of {}: up to {} at the foot of {}{hinge}{coupled}",
            building.name,
            MOMENT.text(moment(worst), 0),
            worst.name
        )?;
    }
    let force = |part: &PartSummary| part.force_max_n.max(-part.force_min_n);
    let beams = building
        .parts
        .iter()
        .filter(|part| part.kind == "coupling-beam");
    if let Some(worst) = beams.max_by(|a, b| force(a).total_cmp(&force(b))) {
        let turned =
            [worst.rotation_max_rad, worst.rotation_min_rad].map(Option::unwrap_or_default);
        writeln!(
            text,
            "Coupling beams of {}: up to {} of shear in {}, chord rotation {:.2} mrad",
            building.name,
            FORCE.text(force(worst), 0),
            worst.name,
            turned[0].max(turned[1]) * 1e3
        )?;
    }
    Ok(())
}
