//! NSR-10.

use super::{Code, HazardZone, OF_HEIGHTS, Table};
use crate::separation::codes::{Nsr10Neighbour, nsr10_setback};

impl Table<'_> {
    /// Either building may be the new one, beside a neighbour that stands on the line.
    pub(super) fn nsr10(&mut self) {
        if self.is_at_mat() {
            return self.leave_out("NSR-10", OF_HEIGHTS);
        }
        let (level, words) = self.level();
        let neighbour = if level {
            Nsr10Neighbour::LevelSlabs
        } else {
            Nsr10Neighbour::OtherSlabs
        };
        let hazard = self.inputs.hazard;
        let setbacks = self.neighbours.sides.each_ref().map(|side| match side {
            Some(side) if hazard != HazardZone::Low => {
                nsr10_setback(side.height, side.storeys, neighbour)
            }
            _ => 0.0,
        });
        let hazard_words = HazardZone::NAMES[hazard as usize];
        let mut used = vec![format!("hazard = {hazard_words}"), words];
        used.extend(self.neighbours.sides.iter().flatten().map(|side| {
            let storeys = match side.storeys {
                1 => "1 storey".to_owned(),
                count => format!("{count} storeys"),
            };
            format!("{}: {storeys} above ground", side.name)
        }));
        self.add(
            "NSR-10",
            Some(Code::Nsr10),
            "NSR-10 §A.6.5.2.3, table A.6.5-1: the new building beside a neighbour on the line; the greater of both as the new one",
            setbacks[0].max(setbacks[1]),
            used,
        );
        self.set_setbacks(setbacks);
    }
}
