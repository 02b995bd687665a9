//! Rules of no code: sums, roots and the double difference of peak displacements.

use super::Table;
use crate::separation::{EN1998_ALIGNED_FLOORS, absolute_sum, double_difference};

impl Table<'_> {
    pub(super) fn general(&mut self) {
        let Some((sum, _)) = self.widest(|place| absolute_sum(place.peaks[0], place.peaks[1]))
        else {
            return;
        };
        self.add("ABS", None, "sum of peak displacements", sum, Vec::new());
        let root = self.root();
        self.add(
            "SRSS",
            None,
            "square root of the sum of squares of peak displacements",
            root,
            Vec::new(),
        );
        if self.level().0 {
            self.add(
                "0.7 SRSS",
                None,
                "0.7 of SRSS, floors at equal height",
                EN1998_ALIGNED_FLOORS * root,
                Vec::new(),
            );
        }
        if let Some(rho) = self.neighbours.correlation {
            let widest =
                self.widest(|place| double_difference(place.peaks[0], place.peaks[1], rho));
            let width = widest.map_or(0.0, |(width, _)| width);
            let sides = self.neighbours.sides.iter().flatten();
            let yielding = sides.filter(|side| side.yields);
            let yielding: Vec<&str> = yielding.map(|side| &*side.name).collect();
            let inputs = match yielding.is_empty() {
                true => Vec::new(),
                false => vec![format!(
                    "uses the periods before yielding, also of {}; with equal periods it becomes small",
                    yielding.join(" and ")
                )],
            };
            self.add(
                "DDC",
                None,
                "double difference, Jeng, Kasai and Maison (1992)",
                width,
                inputs,
            );
        }
    }
}
