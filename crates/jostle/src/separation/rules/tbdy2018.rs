//! TBDY 2018.

use super::{Code, MotionLevel, Table, stated};
use crate::separation::codes::tbdy2018_joint;

impl Table<'_> {
    pub(super) fn tbdy2018(&mut self) {
        let (level, words) = self.level();
        let motion = self.inputs.motion;
        // Under the full motion, u R/I is the elastic displacement.
        let factors = self.factors("TBDY 2018", |_, codes| match motion {
            MotionLevel::Full => Ok((1.0, None)),
            MotionLevel::Reduced => {
                let r = codes.response_modification.ok_or("response_modification")?;
                let (importance, words) = stated("I", codes.importance, 1.0);
                Ok((r / importance, Some(format!("R = {r}, {words}"))))
            }
        });
        let Some(([l, r], mut used)) = factors else {
            return;
        };
        let widest = self.widest(|place| {
            tbdy2018_joint(
                [l * place.peaks[0], r * place.peaks[1]],
                level,
                place.height,
            )
        });
        let Some((width, _)) = widest else { return };
        used.push(words);
        self.add(
            "TBDY 2018",
            Some(Code::Tbdy2018),
            if level {
                "TBDY 2018 §4.9.3, α = 0.25 R/I"
            } else {
                "TBDY 2018 §4.9.3, α = 0.5 R/I"
            },
            width,
            used,
        );
    }
}
