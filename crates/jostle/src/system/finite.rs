//! Results of assembly that are not finite, with their cause.

use crate::model::{Building, ModelFault, Structure, displacement_in_words};
use crate::structure::MemberPlace;
use crate::system::{BuildingSystem, System};

/// Impact speed at which the duration of an impact is checked \[m/s\].
const IMPACT_SPEED: f64 = 0.5;

/// The fault of a building whose mass or periods are not finite; usually due to values of very different magnitude
/// in one building.
pub(crate) fn of_building(
    index: usize,
    building: &Building,
    assembled: &BuildingSystem,
) -> Option<ModelFault> {
    let wrong = |what: String| {
        Some(ModelFault {
            path: format!("building[{index}]"),
            problem: format!("{what}; {}", cause(building)),
        })
    };
    let mass = assembled.equations.total_mass();
    if !mass.is_finite() {
        return wrong(format!("its mass is {mass} kg"));
    }
    let periods = assembled.modes.iter().map(crate::eigen::Mode::period);
    let mut numbered = periods.enumerate();
    let usable = |period: f64| period.is_finite() && period > 0.0;
    if let Some((mode, _)) = numbered.find(|(_, period)| !usable(*period)) {
        return wrong(format!(
            "the period of lateral mode {} cannot be computed",
            mode + 1
        ));
    }
    None
}

/// The faults of contacts whose impact duration is not finite or not positive.
pub(crate) fn of_contacts(system: &System) -> Vec<ModelFault> {
    let mut faults: Vec<ModelFault> = Vec::new();
    for contact in &system.contacts {
        let mass = contact.effective_mass();
        let duration = contact.law.elastic_duration(mass, IMPACT_SPEED);
        let path = format!("gap[{}].stiffness", contact.gap);
        let known = faults.last().is_some_and(|fault| fault.path == path);
        let usable = duration.is_finite() && duration > 0.0;
        if !usable && !known {
            faults.push(ModelFault {
                path,
                problem: format!(
                    "the duration of an impact cannot be computed, with a colliding mass of {mass:.2e} kg; check the units of stiffness and mass"
                ),
            });
        }
    }
    faults
}

/// The stiffest and the most flexible part of a building, and the least and the greatest mass, as text.
fn cause(building: &Building) -> String {
    let (stiffnesses, masses) = match &building.structure {
        Structure::Shear(shear) => {
            let storeys = shear.stiffness.iter().enumerate();
            let floors = shear.mass.iter().enumerate();
            (
                storeys
                    .map(|(i, k)| (format!("storey {}", i + 1), *k))
                    .collect::<Vec<_>>(),
                floors
                    .map(|(i, m)| (format!("floor {}", i + 1), *m))
                    .collect::<Vec<_>>(),
            )
        }
        Structure::Given(given) => {
            let name = |dof: usize| format!("displacement {}", dof + 1);
            let diagonal = given.stiffness.iter().filter(|entry| entry.0 == entry.1);
            let masses = given.mass.iter().enumerate();
            (
                diagonal.map(|entry| (name(entry.0), entry.2)).collect(),
                masses.map(|(dof, mass)| (name(dof), *mass)).collect(),
            )
        }
        Structure::Tiers(tiers) => {
            let floors = tiers.floors.iter().enumerate();
            let least = |k: &[f64; 3]| k[0].min(k[1]);
            let storeys = (0..tiers.floors.len()).filter_map(|i| {
                let storey = tiers.initial_storey(i)?;
                Some((format!("storey {}", i + 1), least(&storey.stiffness)))
            });
            let columns = tiers.frames.iter().flat_map(|frame| {
                let columns = frame.frame.all_columns();
                columns.map(|([i, _], section)| {
                    let height = frame.frame.storey_heights[i];
                    let name = format!("columns of frame {}, storey {}", frame.name, i + 1);
                    (name, 12.0 * section.flexural_rigidity / height.powi(3))
                })
            });
            let in_space = tiers.space_frame.iter().flat_map(|space_frame| {
                space_frame.members.iter().map(|member| {
                    let length = space_frame.length(member.place, &tiers.storey_heights);
                    let [first, second] = member.section.flexural_rigidity;
                    let least = 12.0 * first.min(second) / length.powi(3);
                    (MemberPlace::InSpace(member.place).to_string(), least)
                })
            });
            let given = tiers.matrices.iter().flat_map(|matrix| {
                // Forces per displacement, not moments per rotation.
                let rows = matrix.stiffness.iter().enumerate();
                let rows = rows.filter(|(place, _)| place % 3 < 2);
                rows.map(|(place, row)| (displacement_in_words(place), row[place]))
            });
            (
                storeys
                    .chain(columns)
                    .chain(in_space)
                    .chain(given)
                    .collect(),
                floors
                    .map(|(i, floor)| (format!("floor {}", i + 1), floor.mass))
                    .collect(),
            )
        }
        Structure::Frame(frame) => {
            let lateral = |rigidity: f64, length: f64| 12.0 * rigidity / length.powi(3);
            let columns = frame.all_columns().map(|([i, _], section)| {
                let name = format!("columns of storey {}", i + 1);
                (
                    name,
                    lateral(section.flexural_rigidity, frame.storey_heights[i]),
                )
            });
            let beams = frame.all_beams().map(|([i, bay], section)| {
                let name = format!("beam of floor {}, span {}", i + 1, bay + 1);
                (name, lateral(section.flexural_rigidity, frame.spans[bay]))
            });
            let floors = frame.beam_mass.iter().zip(&frame.floor_mass).enumerate();
            (
                columns.chain(beams).collect(),
                floors
                    .map(|(i, (line, mass))| {
                        let length = frame.beam_length(i);
                        (format!("floor {}", i + 1), line * length + mass)
                    })
                    .collect(),
            )
        }
    };
    let range = |values: &[(String, f64)], unit: &str| {
        let least = values.iter().min_by(|a, b| a.1.total_cmp(&b.1));
        let greatest = values.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        match (least, greatest) {
            (Some((low, least)), Some((high, greatest))) if low != high && greatest > least => {
                format!("from {least:.2e} {unit} ({low}) to {greatest:.2e} {unit} ({high})")
            }
            (Some((_, least)), _) => format!("of {least:.2e} {unit}"),
            _ => "unknown".to_owned(),
        }
    };
    let quantity = match &building.structure {
        Structure::Shear(_) | Structure::Tiers(_) => "stiffnesses k",
        Structure::Given(_) => "stiffnesses on the diagonal",
        Structure::Frame(_) => "stiffnesses 12 EI/L^3",
    };
    format!(
        "{quantity} {}, masses {}; check their units and lengths",
        range(&stiffnesses, "N/m"),
        range(&masses, "kg")
    )
}
