//! `jostle modes`: natural periods, participation and shapes.

use std::fmt::Write;

use jostle::eigen::{self, Mode};
use jostle::system::BuildingSystem;
use jostle_io::Overrides;
use jostle_run::{floor_shape, list_modes, modes_json, open};

use crate::args::ModesArgs;
use crate::failure::Failure;
use crate::terminal;
use jostle_run::{BOLD, DIM, styled};

pub(crate) fn modes(args: &ModesArgs) -> Result<(), Failure> {
    let opened = open(args.model.as_deref(), &Overrides::default(), false)?;
    let count = args.count as usize;
    let listed = list_modes(&opened.system, count)?;
    if args.json {
        return terminal::print(&format!("{:#}", modes_json(&listed, count)));
    }
    let mut text = String::new();
    for (building, modes) in &listed {
        // Writing to a string cannot fail.
        let _ = describe(&mut text, building, modes);
    }
    if listed.iter().any(|mode| !mode.0.is_in_space()) {
        text.push_str("T marks lateral modes (≥ 1 % of the mass). ");
    }
    let _ = writeln!(
        text,
        "No mode is missing: frequencies by counting negative pivots of the\n\
         Riccati recursion (Wittrick and Williams), shapes by inverse iteration."
    );
    terminal::print(&text)
}

/// Modes of a building with a plan: what sways along x, across, and turns.
fn describe_in_space(
    text: &mut String,
    building: &BuildingSystem,
    modes: &[Mode],
) -> std::fmt::Result {
    writeln!(text, "{}", styled(BOLD, &building.name))?;
    writeln!(
        text,
        "  mode   period        ω     mass x   across   torsion"
    )?;
    for (index, mode) in modes.iter().enumerate() {
        writeln!(
            text,
            "  {:>4}  {:7.4} s {:8.3}  {:6.2} % {:6.2} %  {:6.2} %",
            index + 1,
            mode.period(),
            mode.circular_frequency,
            mode.effective_mass_ratio_x * 100.0,
            mode.effective_mass_ratio_across * 100.0,
            mode.effective_mass_ratio_torsion * 100.0
        )?;
    }
    writeln!(
        text,
        "  {} of {} modes listed\n",
        modes.len(),
        eigen::number_of_modes(building)
    )
}

fn describe(text: &mut String, building: &BuildingSystem, modes: &[Mode]) -> std::fmt::Result {
    if building.is_in_space() {
        return describe_in_space(text, building, modes);
    }
    writeln!(text, "{}", styled(BOLD, &building.name))?;
    writeln!(
        text,
        "  mode   period        ω     mass x   mass y   floors 1 … {}",
        building.floors.len()
    )?;
    let (mut lateral, mut carried) = (0, 0.0);
    for (index, mode) in modes.iter().enumerate() {
        let shape: Vec<String> = floor_shape(mode)
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
            let has_beams = !building.discretization.members.is_empty();
            let what = match has_beams && building.foundation.is_none() {
                true => "beams",
                false => "less than 1 % of the mass",
            };
            styled(DIM, what)
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
