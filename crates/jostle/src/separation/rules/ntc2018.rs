//! NTC 2018.

use super::{Code, GRAVITY, Table};
use crate::separation::codes::ntc2018_joint;

impl Table<'_> {
    pub(super) fn ntc2018(&mut self) {
        let acceleration = match self.inputs.ground_acceleration {
            Some(given) => (given, format!("a_g S = {:.3} g", given / GRAVITY)),
            None => {
                let peak = self.neighbours.peak_ground_acceleration;
                let words = format!(
                    "a_g S = {:.3} g (default: peak of the motion)",
                    peak / GRAVITY
                );
                (peak, words)
            }
        };
        let Some(([l, r], mut used)) = self.by_behaviour_factor("NTC 2018") else {
            return;
        };
        let ratio = acceleration.0 / GRAVITY;
        let widest = self.widest(|place| {
            ntc2018_joint(
                [l * place.peaks[0], r * place.peaks[1]],
                place.height,
                ratio,
            )
        });
        let Some((width, _)) = widest else { return };
        used.push(acceleration.1);
        self.add(
            "NTC 2018",
            Some(Code::Ntc2018),
            "NTC 2018 §7.2.1, at least h/100 · 2 a_g S/g",
            width,
            used,
        );
    }
}
