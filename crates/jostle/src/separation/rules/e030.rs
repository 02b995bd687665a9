//! E.030.

use super::{Code, MotionLevel, Place, Table};
use crate::separation::codes::{e030_2018_joint, e030_2026_joint, e030_share};

impl Table<'_> {
    pub(super) fn e030(&mut self) {
        let motion = self.inputs.motion;
        let factors = self.factors("E.030", |side, codes| {
            let (share, words) = match codes.is_regular {
                Some(true) => (e030_share(true), "regular"),
                Some(false) => (e030_share(false), "irregular"),
                None => (e030_share(true), "regular (default)"),
            };
            match motion {
                MotionLevel::Full if side.yields => {
                    Ok((1.0, Some("inelastic displacements as computed".into())))
                }
                MotionLevel::Full => Ok((share, Some(words.into()))),
                MotionLevel::Reduced => {
                    let r = codes.response_modification.ok_or("response_modification")?;
                    Ok((share * r, Some(format!("{words}, R = {r}"))))
                }
            }
        });
        let Some(([l, r], used)) = factors else {
            return;
        };
        let moved = |place: &Place| [l * place.peaks[0], r * place.peaks[1]];
        let widest = self.widest(|place| e030_2018_joint(moved(place), place.height));
        let Some((width, _)) = widest else { return };
        self.add(
            "E.030-2018",
            Some(Code::E030),
            "E.030-2018 Art. 33, at least 0.006 h and 30 mm",
            width,
            used.clone(),
        );
        let (Some(zone), Some(soil)) = (self.inputs.zone_factor, self.inputs.soil_factor) else {
            return self.leave_out("E.030-2026", "zone_factor and soil_factor");
        };
        let widest = self.widest(|place| e030_2026_joint(moved(place), place.height, zone, soil));
        let width = widest.map_or(0.0, |(width, _)| width);
        let mut used = used;
        used.push(format!("Z = {zone}, S = {soil}"));
        self.add(
            "E.030-2026",
            Some(Code::E030),
            "E.030-2026 Art. 52, at least 0.02 Z S h and 30 mm",
            width,
            used,
        );
    }
}
