//! `jostle modes`: natural periods, participation and shapes.

use std::fmt::Write;

use jostle::System;
use jostle::eigen::{self, Mode};
use jostle::system::BuildingSystem;
use jostle_io::Overrides;
use serde_json::{Value, json};

use crate::args::ModesArgs;
use crate::failure::Failure;
use crate::open::open;
use crate::terminal::{self, BOLD, DIM, styled};

pub(crate) fn modes(args: &ModesArgs) -> Result<(), Failure> {
    let opened = open(args.model.as_deref(), &Overrides::default())?;
    let count = args.count as usize;
    let listed = list(&opened.system, count).map_err(Failure::Analysis)?;
    if args.json {
        return terminal::print(&format!("{:#}", listed_as_json(&listed, count)));
    }
    let mut text = String::new();
    for (building, modes) in &listed {
        // Writing to a string cannot fail.
        let _ = describe(&mut text, building, modes);
    }
    let _ = writeln!(
        text,
        "T marks lateral modes (≥ 1 % of the mass). None is missing: frequencies by counting negative pivots of the\n\
         Riccati recursion (Wittrick and Williams), shapes by inverse iteration."
    );
    terminal::print(&text)
}

/// The JSON of `jostle modes`: up to `count` modes of every building, from the longest period down.
///
/// # Errors
/// Names the building whose modes were not found, and why.
pub fn modes_json(system: &System, count: usize) -> Result<Value, String> {
    Ok(listed_as_json(&list(system, count)?, count))
}

type Listed<'a> = Vec<(&'a BuildingSystem, Vec<Mode>)>;

fn list(system: &System, count: usize) -> Result<Listed<'_>, String> {
    let modes = system.buildings.iter().map(|building| {
        let modes = eigen::modes(building, count)
            .map_err(|problem| format!("no modes of \"{}\": {problem}", building.name))?;
        Ok((building, modes))
    });
    modes.collect()
}

fn listed_as_json(listed: &Listed<'_>, count: usize) -> Value {
    let buildings: Vec<Value> = listed
        .iter()
        .map(|(building, modes)| as_json(building, modes, count))
        .collect();
    json!({ "buildings": buildings })
}

fn as_json(building: &BuildingSystem, modes: &[Mode], count: usize) -> Value {
    let mode = |mode: &Mode| {
        json!({
            "period_s": mode.period(),
            "circular_frequency_rad_s": mode.circular_frequency,
            "effective_mass_ratio_x": mode.effective_mass_ratio_x,
            "effective_mass_ratio_y": mode.effective_mass_ratio_y,
            "lateral": mode.is_lateral(),
            "floor_shape": shape(mode),
        })
    };
    json!({
        "name": building.name,
        "periods_s": building.lateral_modes().take(count).map(Mode::period).collect::<Vec<_>>(),
        "modes": modes.iter().map(mode).collect::<Vec<_>>(),
    })
}

/// Horizontal shape at the floors from the ground up, scaled so that the floor that moves most moves by ±1.
fn shape(mode: &Mode) -> Vec<f64> {
    let largest = mode.floors.iter().fold(0.0_f64, |largest, value| {
        if value.abs() > largest.abs() {
            *value
        } else {
            largest
        }
    });
    let scale = if largest == 0.0 {
        0.0
    } else {
        1.0 / largest.abs()
    };
    mode.floors.iter().map(|value| value * scale).collect()
}

fn describe(text: &mut String, building: &BuildingSystem, modes: &[Mode]) -> std::fmt::Result {
    writeln!(text, "{}", styled(BOLD, &building.name))?;
    writeln!(
        text,
        "  mode   period        ω     mass x   mass y   floors 1 … {}",
        building.floors.len()
    )?;
    let (mut lateral, mut carried) = (0, 0.0);
    for (index, mode) in modes.iter().enumerate() {
        let shape: Vec<String> = shape(mode)
            .iter()
            .map(|value| format!("{value:+.2}"))
            .collect();
        lateral += usize::from(mode.is_lateral());
        carried += mode.effective_mass_ratio_x;
        let mark = if mode.is_lateral() {
            format!("T{lateral}")
        } else {
            String::new()
        };
        let sway = if mode.is_lateral() {
            shape.join(" ")
        } else {
            styled(DIM, "beams")
        };
        writeln!(
            text,
            "  {:>4}  {:7.4} s {:8.3}  {:6.2} %  {:5.2} %   {mark:3} {sway}",
            index + 1,
            mode.period(),
            mode.circular_frequency,
            mode.effective_mass_ratio_x * 100.0,
            mode.effective_mass_ratio_y * 100.0
        )?;
    }
    writeln!(
        text,
        "  {} of {} modes listed, with {:.1} % of the mass horizontally\n",
        modes.len(),
        eigen::number_of_modes(building),
        carried * 100.0
    )
}
