//! What a contact will do over a step, as far as its start tells.

use crate::interface::Contact;
use crate::state::Episode;

/// How far ahead the slope of a force is taken, as a share of a step: past any corner at which the last step has ended.
pub(super) const AHEAD: f64 = 1e-3;
/// Parts of a step in which a force sets in or ends.
const CORNER_PARTS: u32 = 16;

/// A contact force as it can be predicted at the start of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PredictedForce {
    /// At the end of the step \[N\].
    pub(super) end: f64,
    /// Its slope at the start \[N/s\].
    pub(super) slope: f64,
    /// What the parabola of the same mean and end would rise over the step if it went on as it starts \[N\].
    pub(super) rise: f64,
}

/// Relative motion of two faces whose jerk is constant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drift {
    pub(super) start: f64,
    pub(super) rate: f64,
    pub(super) acceleration: f64,
    pub(super) jerk: f64,
}

impl Drift {
    /// Displacement and rate after a time \[s\].
    pub(super) fn after(&self, t: f64) -> [f64; 2] {
        let Self {
            start,
            rate,
            acceleration,
            jerk,
        } = self;
        [
            start + t * (rate + t / 2.0 * (acceleration + t / 3.0 * jerk)),
            rate + t * (acceleration + t / 2.0 * jerk),
        ]
    }
}

impl PredictedForce {
    /// The force of a closed contact over a step, whose start and length are `span` \[s\], if its faces go on as they
    /// accelerate at the start; `drift` is that of the indentation.
    pub(super) fn of_contact(
        contact: &Contact,
        episode: &Episode,
        drift: Drift,
        span: [f64; 2],
    ) -> Self {
        let [now, step] = span;
        let (start, rate, acceleration) = (drift.start, drift.rate, drift.acceleration);
        let respond =
            |indentation: f64, rate: f64| contact.law.follow(indentation, rate, &episode.memory);
        let force = |share: f64| {
            let t = share * step;
            let indentation = start + t * (rate + t / 2.0 * (acceleration + t / 3.0 * drift.jerk));
            let rate = rate + t * (acceleration + t / 2.0 * drift.jerk);
            respond(indentation, rate).force
        };
        let (before, half, end) = (episode.force, force(0.5), force(1.0));
        let smooth = before != 0.0 && end != 0.0;
        let mean = if smooth {
            (before + 4.0 * half + end) / 6.0
        } else {
            // Forces set in with all kinds of powers of time, and end within a step.
            let parts = f64::from(CORNER_PARTS);
            let at = |part: u32| force(f64::from(part) / parts);
            let inside = |first: u32| (first..CORNER_PARTS).step_by(2).map(at).sum::<f64>();
            (before + 4.0 * inside(1) + 2.0 * inside(2) + end) / (3.0 * parts)
        };
        let rise = 6.0 * mean - 4.0 * before - 2.0 * end;
        let slope = if episode.since == now {
            // Laws do not know it yet.
            rise / step
        } else {
            let response = respond(start, rate);
            response.by_indentation * rate + response.by_rate * acceleration
        };
        Self { end, slope, rise }
    }

    /// b in F₀ + (F₁ − F₀)τ + b(τ² − τ), a parabola that starts as predicted \[N\].
    pub(super) fn bend(&self, start: f64, end: f64) -> f64 {
        end - start - self.rise
    }
}
