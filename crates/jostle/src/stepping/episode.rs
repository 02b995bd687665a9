//! A closed contact in one step, for every solver.

use super::events::{Cubic, bisect};
use super::gap_forces::StepForce;
use super::runner::{ContactTrial, TOGETHER};
use crate::contact::ForceLaw;
use crate::history::Extreme;
use crate::state::Episode;

impl Episode {
    /// Adds the indentation over a step \[s\] that begins at `start` \[s\]: its peak, and instant and rate of
    /// separation if the force ends. Returns the reversal of the indentation \[m\], if there is one.
    pub(super) fn follow_indentation(
        &mut self,
        law: &ForceLaw,
        curve: &Cubic,
        trial: &ContactTrial,
        start: f64,
        step: f64,
    ) -> Option<Extreme> {
        let turn = curve.peak(start, step);
        let deepest = turn.map_or(curve.end, |peak| peak.value);
        self.peak_indentation = self.peak_indentation.max(deepest);
        if self.force > 0.0 && trial.force <= 0.0 {
            let at = self.force_ends(law, curve, step);
            (self.end, self.separation_speed) = (start + at * step, -curve.rise(at) / step);
        } else if trial.force > 0.0 {
            (self.end, self.separation_speed) = (start + step, -trial.rate);
        }
        turn
    }

    /// Fraction of a step at which the force ends, for a given curve of the indentation.
    pub(super) fn force_ends(&self, law: &ForceLaw, curve: &Cubic, step: f64) -> f64 {
        bisect(0.0, 1.0, |at| {
            let rate = curve.rise(at) / step;
            law.follow(curve.value(at), rate, &self.memory).force <= 0.0
        })
    }

    /// Adds the force over the same step, with its `slopes` at the ends \[N/s\]: the peak may lie within the step.
    /// Returns the force over the step.
    pub(super) fn follow_force(
        &mut self,
        law: &ForceLaw,
        trial: &ContactTrial,
        slopes: [f64; 2],
        turn: Option<Extreme>,
        start: f64,
        step: f64,
    ) -> StepForce {
        let mut peak = Extreme {
            value: trial.force,
            at: start + step,
        };
        let mut smooth = None;
        if self.force > 0.0 && trial.force > 0.0 {
            if let Some(turn) = turn.filter(|_| law.has_corner_at_turn()) {
                // A cubic would miss or overshoot the corner.
                peak = Extreme {
                    value: law.follow(turn.value, 0.0, &self.memory).force,
                    at: turn.at,
                };
            } else if !law.stays_between_ends() {
                let curve = Cubic::new(self.force, slopes[0], trial.force, slopes[1], step);
                peak = curve.peak(start, step).unwrap_or(peak);
                smooth = Some(curve);
            }
        }
        if peak.value > self.peak_force {
            (self.peak_force, self.peak_force_at) = (peak.value, peak.at);
        }
        StepForce {
            ends: [self.force, trial.force],
            curve: smooth,
            peak,
        }
    }

    /// Applies a sudden change of velocities: the new force of the law, and its change \[N\].
    pub(super) fn jump(&mut self, law: &ForceLaw, trial: &ContactTrial, time: f64) -> f64 {
        let force = law
            .follow(trial.indentation, trial.rate, &self.memory)
            .force;
        let change = force - self.force;
        self.force = force;
        if force > self.peak_force {
            (self.peak_force, self.peak_force_at) = (force, time);
        }
        change
    }

    /// Moves to the end of the step; returns whether the contact has opened.
    pub(super) fn advance(
        &mut self,
        law: &ForceLaw,
        trial: &ContactTrial,
        turn: Option<Extreme>,
    ) -> bool {
        self.force = trial.force;
        if let Some(turn) = turn {
            law.remember(turn.value, 0.0, &mut self.memory);
        }
        law.remember(trial.indentation, trial.rate, &mut self.memory);
        // If the two sides separate and return within the step, the contact has opened: another impact follows.
        let face = self.memory.crushed;
        let apart = trial.rate <= 0.0 || trial.indentation - face < -TOGETHER;
        trial.indentation <= face && apart && !law.jumps_at_release()
    }
}
