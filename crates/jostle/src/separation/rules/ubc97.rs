//! UBC-97.

use super::{Code, MotionLevel, Table};
use crate::separation::UBC97_OF_ELASTIC;

impl Table<'_> {
    /// 0.7 R times the displacement under forces divided by R: 0.7 of the elastic one.
    pub(super) fn ubc97(&mut self) {
        let mut sides = self.neighbours.sides.iter().flatten();
        let is_elastic = sides.all(|side| !side.yields);
        if !is_elastic || self.inputs.motion == MotionLevel::Reduced {
            return self.leave_out("UBC-97", "elastic buildings under the full motion");
        }
        if self.neighbours.places.is_empty() {
            return;
        }
        let width = UBC97_OF_ELASTIC * self.root();
        self.add(
            "UBC-97",
            Some(Code::Ubc97),
            "UBC-97 §1630.9.2 and §1633.2.11, with the computed displacements as the elastic ones",
            width,
            Vec::new(),
        );
    }
}
