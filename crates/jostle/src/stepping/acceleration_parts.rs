//! Peak accelerations of floors in equal parts of a run.

/// Number of parts of a run.
const PARTS: usize = 32;
/// A part counts if its peak is at least this fraction of the floor's peak.
const NEAR: f64 = 0.5;

/// Peak total acceleration of every floor in every part of a run \[m/s²\].
///
/// Two runs with a phase difference in free vibration may have the same peak acceleration by chance. They seldom
/// have the same peak in every part.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AccelerationParts {
    /// Length of a part \[s\].
    length: f64,
    part: usize,
    floors: Vec<[f64; PARTS]>,
}

impl AccelerationParts {
    /// For a number of floors of all buildings and a run of `duration` \[s\].
    pub(crate) fn new(floors: usize, duration: f64) -> Self {
        Self {
            length: duration / PARTS as f64,
            part: 0,
            floors: vec![[0.0; PARTS]; floors],
        }
    }

    /// Selects the part of an instant.
    pub(crate) fn set_time(&mut self, time: f64) {
        self.part = ((time / self.length) as usize).min(PARTS - 1);
    }

    /// Adds a value of a floor, counted through all buildings.
    #[inline]
    pub(crate) fn take(&mut self, floor: usize, magnitude: f64) {
        let peak = &mut self.floors[floor][self.part];
        *peak = peak.max(magnitude);
    }

    /// Greatest difference from another run in any part that counts, over floors `first` to `first + count` \[m/s²\].
    pub(crate) fn change(&self, other: &Self, first: usize, count: usize) -> f64 {
        let own = self.floors.iter().zip(&other.floors);
        let mut worst = 0.0_f64;
        for (a, b) in own.skip(first).take(count) {
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

    fn of(values: &[(f64, f64)]) -> AccelerationParts {
        let mut parts = AccelerationParts::new(1, 32.0);
        for (time, value) in values {
            parts.set_time(*time);
            parts.take(0, *value);
        }
        parts
    }

    #[test]
    fn equal_peaks_at_other_instants_differ() {
        let (a, b) = (of(&[(3.2, 9.0), (7.5, 6.0)]), of(&[(3.2, 6.0), (7.5, 9.0)]));
        assert_eq!(a.change(&b, 0, 1), 3.0);
        assert_eq!(a.change(&a, 0, 1), 0.0);
    }

    #[test]
    fn parts_far_below_the_peak_do_not_count() {
        let (a, b) = (of(&[(3.2, 9.0), (7.5, 4.0)]), of(&[(3.2, 9.0), (7.5, 2.0)]));
        assert_eq!(a.change(&b, 0, 1), 0.0);
    }

    #[test]
    fn the_last_part_takes_the_end_of_the_run() {
        let (a, b) = (of(&[(31.9, 9.0)]), of(&[(32.0, 9.0)]));
        assert_eq!(a.change(&b, 0, 1), 0.0);
    }
}
