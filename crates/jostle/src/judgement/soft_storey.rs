//! A17: storeys much softer than those above.

use super::{Known, Tally, quoted};
use crate::eigen::Mode;
use crate::system::BuildingSystem;

/// Share of the stiffness of the storey above below which a storey is soft \[–\].
const OF_NEXT: f64 = 0.7;
/// Share of the mean of the three storeys above \[–\].
const OF_THREE: f64 = 0.8;

/// Stiffness of storeys over the least that is not soft, along x and across.
pub(super) fn soft_storey(known: &Known<'_>, tally: &mut Tally<'_>) {
    for building in &known.system.buildings {
        let modes = building.fundamental_modes();
        let names = match modes {
            [_, Some(_)] => [" along x", " along y"],
            [_, None] => [""; 2],
        };
        for (direction, mode) in modes.into_iter().enumerate() {
            let Some(mode) = mode else { continue };
            let stiffnesses = stiffnesses(building, direction, mode);
            compare(&building.name, &stiffnesses, names[direction], tally);
        }
    }
}

fn compare(name: &str, stiffnesses: &[f64], along: &str, tally: &mut Tally<'_>) {
    for (storey, here) in stiffnesses.iter().enumerate() {
        let above = &stiffnesses[storey + 1..];
        let next = above.first().copied();
        let three = above.get(..3).map(|three| three.iter().sum::<f64>() / 3.0);
        let references = [
            (
                next,
                OF_NEXT,
                format!("the stiffness of storey {}", storey + 2),
            ),
            (
                three,
                OF_THREE,
                "the mean stiffness of the three storeys above".to_owned(),
            ),
        ];
        for (reference, share, of) in references {
            let Some(reference) = reference else { continue };
            tally.add(here / (share * reference), || {
                let text = format!(
                    "{}: storey {} is soft{along}, with {:.0} % of {of}",
                    quoted(name),
                    storey + 1,
                    100.0 * here / reference,
                );
                (format!("{name}, storey {}", storey + 1), text)
            });
        }
    }
}

/// Storey shear over storey drift in a mode, from the ground up \[N/m\]; not a number where they are opposed.
fn stiffnesses(building: &BuildingSystem, direction: usize, mode: &Mode) -> Vec<f64> {
    let shears = building.structure.initial_storey_shears(&mode.shape);
    let drifts = building.storey_drifts(&mode.shape);
    let shears = shears.into_iter().skip(direction * drifts.len());
    let storeys = building.floors.iter().zip(drifts).zip(shears);
    storeys
        .map(|((floor, drift), shear)| {
            let stiffness = shear / (drift[direction] * floor.storey_height);
            if stiffness > 0.0 { stiffness } else { f64::NAN }
        })
        .collect()
}
