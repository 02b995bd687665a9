//! Ground motions as values in a script.

use std::fmt::Write;

use jostle::statics::STANDARD_GRAVITY;
use jostle::{GroundMotion, Wave};

use super::script::{Script, comment};

/// Free-vibration step that is tried first \[s\]; the record may require a shorter one.
const FREE_STEP: f64 = 2e-3;
/// Parts of it while contacts are closed \[–\].
const PARTS_IN_CONTACT: usize = 10;

impl Script<'_> {
    pub(super) fn remark_on_motion(&mut self) {
        if matches!(self.export.motion.wave, Wave::Ricker { .. }) {
            self.remark("The Ricker pulse is sampled every 0.1 ms, with straight lines between.");
        }
    }

    pub(super) fn write_motion(&self, out: &mut String) -> std::fmt::Result {
        let motion = self.export.motion;
        let step = match motion.has_own_grounds() {
            true => motion.corner_step(),
            false => motion.step(),
        };
        let free = step.map_or(FREE_STEP, |step| {
            step / (step / FREE_STEP - 1e-9).ceil().max(1.0)
        });
        writeln!(out, "GRAVITY = {STANDARD_GRAVITY:?}  # m/s2")?;
        writeln!(out, "\n# Ground motion: {}", comment(&motion.name))?;
        writeln!(out, "DURATION = {:?}  # s", motion.duration)?;
        write_wave(out, motion)?;
        if let Some(bearing) = &motion.bearing {
            writeln!(
                out,
                "ANGLE = {:?}  # rad, from x to the motion, counter-clockwise",
                bearing.angle
            )?;
            if let Some(across) = &bearing.across {
                writeln!(
                    out,
                    "\n\nclass ACROSS:  # the motion a right angle further: {}",
                    comment(&across.name)
                )?;
                let mut wave = format!("DURATION = {:?}  # s\n", across.duration);
                write_wave(&mut wave, across)?;
                for line in wave.lines() {
                    writeln!(out, "    {line}")?;
                }
                writeln!(out)?;
            }
        }
        self.write_grounds(out)?;
        writeln!(
            out,
            "\n# Efficient steps, in free vibration and around contact [s]."
        )?;
        writeln!(out, "FREE_STEP = {free:?}")?;
        writeln!(out, "PARTS_IN_CONTACT = {PARTS_IN_CONTACT}")
    }
}

/// The shape of a ground motion, and its factor.
pub(super) fn write_wave(out: &mut String, motion: &GroundMotion) -> std::fmt::Result {
    writeln!(
        out,
        "MOTION_FACTOR = {:?}  # on the values, sign included",
        motion.scale
    )?;
    match &motion.wave {
        Wave::Sampled { step, acceleration } => {
            writeln!(out, "RECORD_STEP = {step:?}  # s")?;
            writeln!(out, "RECORD = [  # m/s2")?;
            for row in acceleration.chunks(8) {
                let values: Vec<String> = row.iter().map(|a| format!("{a:?}")).collect();
                writeln!(out, "    {},", values.join(", "))?;
            }
            writeln!(out, "]")
        }
        Wave::Sine { amplitude, period } => {
            writeln!(out, "SINE = ({amplitude:?}, {period:?})  # m/s2, s")
        }
        Wave::Ricker {
            amplitude,
            period,
            centre,
        } => writeln!(
            out,
            "RICKER = ({amplitude:?}, {period:?}, {centre:?})  # m/s2, s, s"
        ),
    }
}
