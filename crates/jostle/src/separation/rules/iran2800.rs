//! Iran's Standard 2800.

use super::{BuildingCodes, Code, OF_HEIGHTS, Place, Side, Table};
use crate::separation::codes::{IRAN2800_MOST_STOREYS, iran2800_setback};

impl Table<'_> {
    pub(super) fn iran2800(&mut self) {
        if self.is_at_mat() {
            return self.leave_out("Standard 2800", OF_HEIGHTS);
        }
        // Displacements count only where the share of the height does not.
        let by_displacement = |side: &Side, codes: &BuildingCodes| {
            side.storeys > IRAN2800_MOST_STOREYS || codes.importance.unwrap_or(1.0) > 1.0
        };
        let Some((factors, used)) = self.amplified("Standard 2800", false, by_displacement) else {
            return;
        };
        let sides = self.neighbours.sides.clone();
        let iran2800_setback = |place: &Place| {
            [0, 1].map(|index| {
                let Some(side) = &sides[index] else {
                    return 0.0;
                };
                let importance = self.codes_of(side).importance.unwrap_or(1.0);
                let displacement = factors[index] * place.peaks[index];
                iran2800_setback(place.height, side.storeys, importance > 1.0, displacement)
            })
        };
        let widest = self.widest(|place| iran2800_setback(place).iter().sum());
        let Some((width, place)) = widest else { return };
        let setbacks = iran2800_setback(place);
        self.add(
            "Standard 2800",
            Some(Code::Iran2800),
            "Iranian Standard 2800, 4th edition, §1-4-1: distances of both from the property line",
            width,
            used,
        );
        self.set_setbacks(setbacks);
    }
}
