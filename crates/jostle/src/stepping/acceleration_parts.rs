//! Peak accelerations of floors in equal parts of a run.

/// Number of parts of a run.
const PARTS: usize = 32;
/// A part counts if its peak is at least this fraction of the floor's peak.
const NEAR: f64 = 0.5;

/// Peak total acceleration of every floor in every part of a run \[m/s²\].
///
/// Two runs with a phase difference in free vibration may have the same peak acceleration by chance. They seldom
/// have the same peak in every part. Where a part begins within a step, values lie on a line between the ends of the step:
/// the last end before it would miss the value there by an error of first order, which no shorter steps of a run of second order explain.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AccelerationParts {
    /// Length of a part \[s\].
    length: f64,
    /// Start and end of the step \[s\], and the parts in which they lie.
    step: [f64; 2],
    parts: [usize; 2],
    /// Magnitude of every floor at the end of the last step \[m/s²\].
    last: Vec<f64>,
    floors: Vec<[f64; PARTS]>,
}

impl AccelerationParts {
    /// For a number of floors of all buildings and a run of `duration` \[s\].
    pub(crate) fn new(floors: usize, duration: f64) -> Self {
        Self {
            length: duration / PARTS as f64,
            step: [0.0; 2],
            parts: [0; 2],
            last: vec![0.0; floors],
            floors: vec![[0.0; PARTS]; floors],
        }
    }

    /// Begins the values at the end of a step from `start` to `end` \[s\].
    pub(crate) fn begin(&mut self, start: f64, end: f64) {
        self.step = [start, end];
        self.parts = self
            .step
            .map(|time| ((time / self.length) as usize).min(PARTS - 1));
    }

    /// Begins the values after a jump at the end of the step.
    pub(crate) fn begin_jump(&mut self) {
        self.begin(self.step[1], self.step[1]);
    }

    /// Adds the magnitude of a floor at the end of the step; floors are counted through all buildings.
    #[inline]
    pub(crate) fn take(&mut self, floor: usize, magnitude: f64) {
        let before = std::mem::replace(&mut self.last[floor], magnitude);
        let peaks = &mut self.floors[floor];
        let [first, last] = self.parts;
        for part in first..last {
            let [start, end] = self.step;
            let share = ((part + 1) as f64 * self.length - start) / (end - start);
            let between = before + share * (magnitude - before);
            peaks[part] = peaks[part].max(between);
            peaks[part + 1] = peaks[part + 1].max(between);
        }
        peaks[last] = peaks[last].max(magnitude);
    }

    /// Greatest difference from another run in any part that counts, over floors `first` to `first + count` \[m/s²\].
    pub(crate) fn change(&self, other: &Self, first: usize, count: usize) -> f64 {
        let floors = self.floors.iter().zip(&other.floors);
        let mut worst = 0.0_f64;
        for (a, b) in floors.skip(first).take(count) {
            let greatest = a.iter().chain(b).fold(0.0, |most: f64, x| most.max(*x));
            for (a, b) in a.iter().zip(b) {
                if a.max(*b) >= NEAR * greatest {
                    worst = worst.max((a - b).abs());
                }
            }
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::AccelerationParts;

    /// The parts of a run over 32 s with these instants \[s\] and magnitudes.
    fn of(values: impl IntoIterator<Item = (f64, f64)>) -> AccelerationParts {
        let mut parts = AccelerationParts::new(1, 32.0);
        let mut start = 0.0;
        for (time, value) in values {
            parts.begin(start, time);
            parts.take(0, value);
            start = time;
        }
        parts
    }

    /// Pulses of 2 s at these instants \[s\] with these peaks.
    fn pulses(peaks: [(f64, f64); 2]) -> AccelerationParts {
        of(peaks
            .map(|(at, peak)| [(at - 1.0, 0.0), (at, peak), (at + 1.0, 0.0)])
            .concat())
    }

    #[test]
    fn equal_peaks_at_other_instants_differ() {
        let [a, b] = [[(3.2, 9.0), (7.5, 6.0)], [(3.2, 6.0), (7.5, 9.0)]].map(pulses);
        assert_eq!(a.change(&b, 0, 1), 3.0);
        assert_eq!(a.change(&a, 0, 1), 0.0);
    }

    #[test]
    fn parts_far_below_the_peak_do_not_count() {
        let (a, b) = ([(3.2, 9.0), (7.5, 4.0)], [(3.2, 9.0), (7.5, 2.0)]);
        let [a, b] = [a, b].map(pulses);
        assert_eq!(a.change(&b, 0, 1), 0.0);
    }

    #[test]
    fn the_last_part_takes_the_end_of_the_run() {
        let (a, b) = (of([(31.9, 9.0)]), of([(31.0, 9.0), (32.0, 9.0)]));
        assert_eq!(a.floors[0][31], b.floors[0][31]);
    }

    /// Of a wave that rises through the start of a part, the part before has its peak there, whatever the step.
    #[test]
    fn parts_that_begin_within_a_step_differ_in_second_order() {
        let sampled = |step: f64| {
            let count = (32.0 / step) as usize;
            of((1..=count)
                .map(|k| k as f64 * step)
                .map(|t| (t, (1.9 * t).sin().abs())))
        };
        let change = [0.032, 0.016, 0.008].map(|step| sampled(step).change(&sampled(1e-4), 0, 1));
        assert!(change[0] < 2e-3, "{change:?}");
        assert!(
            change[1] < 0.4 * change[0] && change[2] < 0.4 * change[1],
            "{change:?}"
        );
    }
}
