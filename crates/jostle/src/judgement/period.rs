//! A1: the first period against formulas of codes.

use super::{Known, Tally, quoted, stated};

/// Coefficient and exponent of T = C H^x of moment frames and of other structures, H in m: EN 1998-1:2004, 4.3.3.2.2(3) and
/// ASCE/SEI 7-16, table 12.8-2.
const FORMULAS: [(f64, f64); 6] = [
    (0.085, 0.75),
    (0.075, 0.75),
    (0.050, 0.75),
    (0.0724, 0.8),
    (0.0466, 0.9),
    (0.0488, 0.75),
];

/// First period over the nearest of the periods by the formulas; 1 between them. The formulas are those of buildings that have not
/// cracked: the period is multiplied by the root of the factor on EI, where the file states one, but not with infill
/// panels. One storey often stands for a whole building, whose height it does not have.
pub(super) fn first_period(known: &Known<'_>, tally: &mut Tally<'_>) {
    let buildings = known.model.buildings.iter().zip(&known.system.buildings);
    for (index, (building, building_system)) in buildings.enumerate() {
        let heights = building_system
            .floors
            .last()
            .map_or(0.0, |roof| roof.height);
        let Some(mode) = building_system.lateral_modes().next() else {
            continue;
        };
        if building.floors() < 2 || heights <= 0.0 || building.base.isolation.is_some() {
            continue;
        }
        let (least, most) = range(heights);
        let [columns, beams] = known.stated(index).stiffness_factor;
        // Panels, not the members of the frame, make its stiffness.
        let cracked = match building.has_panels() {
            true => 1.0,
            false => (0.5 * (columns + beams)).min(1.0),
        };
        let period = mode.period() * cracked.sqrt();
        let ratio = if period < least {
            period / least
        } else {
            (period / most).max(1.0)
        };
        tally.add(ratio, || {
            let text = format!(
                "{}: the uncracked first period is {period:.2} s; code formulas give {least:.2} to {most:.2} s for {} m",
                quoted(&building.name),
                stated(heights)
            );
            (building.name.clone(), text)
        });
    }
}

/// Shortest and longest period by the formulas for a height \[s\].
fn range(height: f64) -> (f64, f64) {
    let periods = FORMULAS.map(|(coefficient, exponent)| coefficient * libm::pow(height, exponent));
    let least = periods.into_iter().fold(f64::INFINITY, f64::min);
    (least, periods.into_iter().fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    /// 16 m: EN 1998-1 gives 0.050·16^¾ = 0.4 s to 0.085·8 = 0.68 s, ASCE 7 from 0.0488·8 = 0.3904 s.
    #[test]
    fn formulas_of_codes() {
        let (least, most) = super::range(16.0);
        assert!((least - 0.3904).abs() < 1e-12, "{least}");
        assert!((most - 0.68).abs() < 1e-12, "{most}");
    }
}
