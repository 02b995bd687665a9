//! Peaks of accelerations at corners between the ends of steps.

use crate::interface::LinkElement;
use crate::system::{BuildingSystem, System};

/// Values of which a corner between the third and the fourth is known.
const WINDOW: usize = 6;
/// A corner changes the slope by this many times what the slope changes beside it.
const SHARP: f64 = 4.0;
/// Share of the peak so far from which a corner is looked at.
const NEAR: f64 = 0.8;

/// Finds peaks at corners. Where a spring or a link comes to another line, forces have a corner and accelerations with them; ends of
/// steps miss its tip by a first-order error, which runs at two step lengths may have in common. Two lines through the values before and
/// after meet at it.
#[derive(Clone, Debug, Default)]
pub(super) struct SharpPeaks {
    /// The last instants \[s\], and the last values, place by place; the oldest come first.
    times: [f64; WINDOW],
    values: Vec<[f64; WINDOW]>,
    known: usize,
    next: usize,
}

impl SharpPeaks {
    /// For so many places, if forces of the system have corners; otherwise for none.
    pub(super) fn new(system: &System, places: usize) -> Self {
        let yields = |building: &BuildingSystem| !building.equations.springs.is_empty();
        let corners =
            system.buildings.iter().any(yields) || !system.links.iter().all(LinkElement::is_linear);
        Self {
            values: vec![[0.0; WINDOW]; if corners { places } else { 0 }],
            ..Self::default()
        }
    }

    /// Forgets what was before a jump.
    pub(super) fn forget(&mut self) {
        self.known = 0;
    }

    /// Begins the values of an instant \[s\].
    pub(super) fn begin(&mut self, time: f64) {
        self.times.rotate_left(1);
        self.times[WINDOW - 1] = time;
        self.known = (self.known + 1).min(WINDOW);
        self.next = 0;
    }

    /// Takes the value of the next place, whose magnitude had this peak; returns the peak with a corner before it.
    #[inline]
    pub(super) fn take(&mut self, value: f64, peak: f64) -> f64 {
        let Some(values) = self.values.get_mut(self.next) else {
            return peak;
        };
        self.next += 1;
        values.rotate_left(1);
        values[WINDOW - 1] = value;
        if self.known < WINDOW || values[2].abs().max(values[3].abs()) < NEAR * peak {
            return peak;
        }
        tip(&self.times, values).map_or(peak, |tip| peak.max(tip.abs()))
    }
}

/// The value where the lines before and after the middle interval meet, if there is a corner in it.
fn tip(times: &[f64; WINDOW], values: &[f64; WINDOW]) -> Option<f64> {
    let slope = |k: usize| (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
    let [far_before, before, after, far_after] = [0, 1, 3, 4].map(slope);
    let turn = after - before;
    let beside = (before - far_before).abs().max((far_after - after).abs());
    if before * after >= 0.0 || turn.abs() <= SHARP * beside {
        return None;
    }
    let length = times[3] - times[2];
    let at = (after * length - (values[3] - values[2])) / turn;
    let value = values[2] + before * at;
    (0.0..=length)
        .contains(&at)
        .then_some(value)
        .filter(|_| value * before > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tip between the ends of steps is found; the top of a wave is none, nor is what swings from step to step.
    #[test]
    fn tips_are_found_and_rounded_tops_are_not() {
        let times = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let of = |at: fn(f64) -> f64| tip(&times, &times.map(at));
        let found = of(|t: f64| 5.0 - (t - 2.3).abs()).expect("a tip");
        assert!((found - 5.0).abs() < 1e-12);
        let down = of(|t: f64| (t - 2.6).abs() - 5.0).expect("a tip below");
        assert!((down + 5.0).abs() < 1e-12);
        assert!(of(|t| (0.1 * (t - 2.4)).cos()).is_none());
        assert!(
            of(|t| if (t as usize).is_multiple_of(2) {
                1.0
            } else {
                -1.0
            })
            .is_none()
        );
    }
}
