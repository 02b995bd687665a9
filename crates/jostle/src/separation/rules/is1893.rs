//! IS 1893.

use super::{Code, MotionLevel, Table, stated};
use crate::separation::codes::is1893_joint;

impl Table<'_> {
    pub(super) fn is1893(&mut self) {
        let motion = self.inputs.motion;
        let factors = self.factors("IS 1893", |_, codes| match motion {
            // Design forces are those of the full motion times I/R, and R Δ is I times its displacement.
            MotionLevel::Full => {
                let (importance, words) = stated("I", codes.importance, 1.0);
                Ok((importance, Some(words)))
            }
            MotionLevel::Reduced => {
                let r = codes.response_modification.ok_or("response_modification")?;
                Ok((r, Some(format!("R = {r}"))))
            }
        });
        let Some(([l, r], used)) = factors else {
            return;
        };
        let widest = self.widest(|place| is1893_joint([l * place.peaks[0], r * place.peaks[1]]));
        let Some((width, _)) = widest else { return };
        self.add(
            "IS 1893",
            Some(Code::Is1893),
            "IS 1893 (Part 1): 2016 §7.11.3, R₁Δ₁ + R₂Δ₂",
            width,
            used,
        );
    }
}
