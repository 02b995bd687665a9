//! A2, A3 and A6: masses of beams and floors, compression of columns, and the mass that a neighbour strikes.

use super::{Known, Tally, quoted, stated};
use crate::model::{Frame, LEVEL_TOLERANCE, PlanArea, STANDARD_GRAVITY, Structure};
use crate::statics::compressions;
use crate::structure::MemberPlace;
use crate::system::BuildingSystem;

/// Density of reinforced concrete \[kg/m³\].
const CONCRETE_DENSITY: f64 = 2500.0;

/// Mass of every floor along x, from the ground up: what moves at its height \[kg\].
#[must_use]
pub fn floor_masses(building: &BuildingSystem) -> Vec<f64> {
    let masses = building.horizontal_masses();
    let floors = building.floors.iter();
    floors
        .map(|floor| {
            let here = masses
                .iter()
                .filter(|(height, _)| (height - floor.height).abs() <= LEVEL_TOLERANCE);
            here.map(|(_, mass)| mass).sum()
        })
        .collect()
}

/// Mass on the beams of a floor per metre, whole floors included \[kg/m\].
fn carried(frame: &Frame, floor: usize) -> f64 {
    frame.beam_mass[floor] + frame.floor_mass[floor] / frame.beam_length(floor)
}

/// Mass on the beams over the mass of the beams themselves.
pub(super) fn beam_mass(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, building) in known.model.buildings.iter().enumerate() {
        let (Structure::Frame(frame), Some(modulus)) =
            (&building.structure, known.stated(index).modulus)
        else {
            continue;
        };
        for ([floor, _], beam) in frame.all_beams() {
            let Some(axial) = beam.axial_rigidity else {
                continue;
            };
            let line_mass = CONCRETE_DENSITY * axial / modulus;
            let carried = carried(frame, floor);
            tally.add(carried / line_mass, || {
                let text = format!(
                    "{}: the beams of floor {} carry {carried:.0} kg/m, of which their self weight is {line_mass:.0} kg/m: slab, walls and live load seem to be missing",
                    quoted(&building.name),
                    floor + 1
                );
                (format!("{}, floor {}", building.name, floor + 1), text)
            });
        }
    }
}

/// Compression of columns under self weight over the strength of their concrete, ν = N/(A f_ck).
pub(super) fn column_compression(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, building) in known.model.buildings.iter().enumerate() {
        let stated = known.stated(index);
        let (Structure::Frame(frame), Some(modulus), Some(strength)) =
            (&building.structure, stated.modulus, stated.strength)
        else {
            continue;
        };
        let structure = &known.system.buildings[index].structure;
        let Ok(compressions) = compressions(structure, STANDARD_GRAVITY) else {
            continue;
        };
        for member in &structure.discretization.members {
            let MemberPlace::Column { line, storey } = member.place else {
                continue;
            };
            let section = frame.column(storey - 1, line - 1);
            let Some(axial) = section.and_then(|section| section.axial_rigidity) else {
                continue;
            };
            for compression in &compressions[member.elements.clone()] {
                let ratio = compression * modulus / (axial * strength);
                tally.add(ratio, || {
                    let text = format!(
                        "{}: a column of storey {storey} carries {:.1} kN under gravity, ν = {ratio:.2}",
                        quoted(&building.name),
                        1e-3 * compression
                    );
                    (format!("{}, storey {storey}", building.name), text)
                });
            }
        }
    }
}

/// Mass of floors per area of their plan.
pub(super) fn floor_mass(known: &Known<'_>, tally: &mut Tally<'_>) {
    for building in &known.model.buildings {
        let Structure::Tiers(tiers) = &building.structure else {
            continue;
        };
        for (floor, tier) in tiers.floors.iter().enumerate() {
            let area = PlanArea::new(&tier.plan).area;
            let density = tier.mass / area;
            tally.add(density, || {
                let text = format!(
                    "{}: floor {} has {:.1} t on {} m², {density:.0} kg/m²; usual floors have 400 to 2000 kg/m²",
                    quoted(&building.name),
                    floor + 1,
                    1e-3 * tier.mass,
                    stated(area)
                );
                (format!("{}, floor {}", building.name, floor + 1), text)
            });
        }
    }
}

/// Mass of floors of plane frames per metre, whose width is not known.
pub(super) fn floor_mass_per_length(known: &Known<'_>, tally: &mut Tally<'_>) {
    for building in &known.model.buildings {
        let Structure::Frame(frame) = &building.structure else {
            continue;
        };
        for floor in 0..frame.beam_mass.len() {
            let mass = carried(frame, floor);
            tally.add(mass, || {
                let text = format!(
                    "{}: floor {} carries {mass:.0} kg/m; frames 3 to 8 m apart carry 1200 to 16000 kg/m",
                    quoted(&building.name),
                    floor + 1
                );
                (format!("{}, floor {}", building.name, floor + 1), text)
            });
        }
    }
}

/// Struck mass over the mass of the floor, of contacts between floors in one plane.
pub(super) fn struck_mass(known: &Known<'_>, tally: &mut Tally<'_>) {
    let floors: Vec<Vec<f64>> = known.system.buildings.iter().map(floor_masses).collect();
    for contact in &known.system.contacts {
        for port in contact.ports.0.iter().flatten() {
            let (Some(floor), None) = (port.floor, contact.plan) else {
                continue;
            };
            let whole = floors
                .get(port.building)
                .and_then(|masses| masses.get(floor.checked_sub(1)?));
            let Some(&whole) = whole else { continue };
            tally.add(port.mass / whole, || {
                let name = &known.system.buildings[port.building].name;
                let text = format!(
                    "{}: the impact at floor {floor} acts on a joint of {:.1} t, not on the floor of {:.1} t: its floors are not rigid",
                    quoted(name),
                    1e-3 * port.mass,
                    1e-3 * whole
                );
                (format!("{name}, floor {floor}"), text)
            });
        }
    }
}
