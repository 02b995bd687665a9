//! GB 50011.

use super::{Code, Table};
use crate::separation::{JointSystem, gb50011_joint};

impl Table<'_> {
    pub(super) fn gb50011(&mut self) {
        if self.is_at_wall() {
            return self.leave_out(
                "GB 50011",
                "a neighbouring building (it has no clause for property lines)",
            );
        }
        let height = self.lower_height();
        let (system, said) = match self.inputs.system {
            Some(system) => (system, format!("system = {}", system.name())),
            None => (
                JointSystem::Frame,
                "system = frame (default: concrete frame)".to_owned(),
            ),
        };
        let wanted = |intensity: &u32| self.inputs.intensity.is_none_or(|only| only == *intensity);
        let intensities: Vec<u32> = (6..=9).filter(wanted).collect();
        for intensity in intensities {
            let width = gb50011_joint(height, intensity, system).filter(|width| width.is_finite());
            if let Some(width) = width {
                self.add(
                    &format!("GB 50011, intensity {intensity}"),
                    Some(Code::Gb50011),
                    &format!("GB 50011-2010 (2016) §6.1.4, intensity {intensity}, {height:.2} m"),
                    width,
                    vec![said.clone()],
                );
            }
        }
    }
}
