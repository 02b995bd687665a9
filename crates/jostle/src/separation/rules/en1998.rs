//! EN 1998-1.

use super::{Code, Table};
use crate::separation::codes::en1998_joint;

impl Table<'_> {
    pub(super) fn en1998(&mut self) {
        let (level, words) = self.level();
        let at_wall = self.is_at_wall();
        let Some(([l, r], mut used)) = self.by_behaviour_factor("EN 1998-1") else {
            return;
        };
        let widest =
            self.widest(|place| en1998_joint([l * place.peaks[0], r * place.peaks[1]], level));
        let Some((width, _)) = widest else { return };
        used.push(words);
        self.add(
            "EN 1998-1",
            Some(Code::En1998),
            match (at_wall, level) {
                (false, true) => {
                    "EN 1998-1:2004 §4.4.2.7(2)b and (3): 0.7 of the square root of the sum of squares"
                }
                (false, false) => {
                    "EN 1998-1:2004 §4.4.2.7(2)b: square root of the sum of squares"
                }
                (true, true) => {
                    "EN 1998-1:2004 §4.4.2.7(2)a and (3): 0.7 of the greatest displacement"
                }
                (true, false) => {
                    "EN 1998-1:2004 §4.4.2.7(2)a: greatest displacement at the property line"
                }
            },
            width,
            used,
        );
    }
}
