//! ASCE 7.

use super::{Code, Table};
use crate::separation::srss;

impl Table<'_> {
    pub(super) fn asce7(&mut self) {
        let Some(([l, r], used)) = self.amplified("ASCE 7-16", true, |_, _| true) else {
            return;
        };
        let widest = self.widest(|place| srss(l * place.peaks[0], r * place.peaks[1]));
        let Some((width, _)) = widest else { return };
        if !self.is_at_wall() {
            self.add(
                "ASCE 7-16",
                Some(Code::Asce7),
                "ASCE 7-16 §12.12.3, Eq. (12.12-1) and (12.12-2)",
                width,
                used.clone(),
            );
        }
        let setbacks = [0, 1].map(|side| {
            let places = self.neighbours.places.iter();
            places
                .map(|place| [l, r][side] * place.peaks[side].abs())
                .fold(0.0, f64::max)
        });
        self.add(
            "ASCE 7-16, line",
            Some(Code::Asce7),
            "ASCE 7-16 §12.12.3, at a property line: each building keeps its own δ_M",
            setbacks[0] + setbacks[1],
            used,
        );
        self.set_setbacks(setbacks);
    }
}
