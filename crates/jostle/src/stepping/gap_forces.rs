//! Total force of all contacts of a gap at one instant, and its peak.

use super::events::Cubic;
use crate::history::Extreme;
use crate::system::System;

/// Force of a closed contact over an accepted step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StepForce {
    /// Force at both ends of the step \[N\].
    pub(super) ends: [f64; 2],
    /// Force over the step, if it is smooth there.
    pub(super) curve: Option<Cubic>,
    /// Greatest force in the step.
    pub(super) peak: Extreme,
}

impl StepForce {
    /// Force at a fraction of the step \[N\].
    pub(super) fn at(&self, fraction: f64) -> f64 {
        match &self.curve {
            Some(curve) => curve.value(fraction),
            None => self.ends[0] + fraction * (self.ends[1] - self.ends[0]),
        }
    }
}

/// Greatest sum of forces over a step \[s\] that began at `start` \[s\]. The sum is read at both ends, where one of the forces
/// peaks, and where the sum of smooth forces does.
pub(super) fn peak_of_sum(forces: &[StepForce], start: f64, step: f64) -> Extreme {
    let mut peak = Extreme::default();
    let mut consider = |value: f64, at: f64| {
        if value > peak.value {
            peak = Extreme { value, at };
        }
    };
    let others = |index: usize| {
        let others = forces.iter().enumerate();
        others.filter(move |(other, _)| *other != index)
    };
    for (index, step_force) in forces.iter().enumerate() {
        let fraction = (step_force.peak.at - start) / step;
        let beside: f64 = others(index).map(|(_, force)| force.at(fraction)).sum();
        consider(step_force.peak.value + beside, step_force.peak.at);
    }
    let Some(first) = forces.first() else {
        return peak;
    };
    for (end, at) in [(0, start), (1, start + step)] {
        let beside: f64 = others(0).map(|(_, force)| force.ends[end]).sum();
        consider(first.ends[end] + beside, at);
    }
    let mut sum = first.curve;
    for (_, force) in others(0) {
        sum = sum.zip(force.curve).map(|(a, b)| a.plus(&b));
    }
    if let Some(most) = sum.and_then(|sum| sum.peak(start, step)) {
        consider(most.value, most.at);
    }
    peak
}

/// The same for many forces, whose number only enters once.
pub(super) fn peak_of_many(forces: &[StepForce], start: f64, step: f64) -> Extreme {
    let mut peak = Extreme::default();
    let mut consider = |value: f64, at: f64| {
        if value > peak.value {
            peak = Extreme { value, at };
        }
    };
    let (mut ends, mut straight) = ([0.0; 2], [0.0; 2]);
    let mut smooth: Option<Cubic> = None;
    for force in forces {
        let curve = force.curve;
        for (end, value) in force.ends.into_iter().enumerate() {
            ends[end] += value;
            if curve.is_none() {
                straight[end] += value;
            }
        }
        if let Some(curve) = curve {
            smooth = Some(smooth.map_or(curve, |sum| sum.plus(&curve)));
        }
    }
    let sum_at = |fraction: f64| {
        let line = straight[0] + fraction * (straight[1] - straight[0]);
        line + smooth.map_or(0.0, |sum| sum.value(fraction))
    };
    for force in forces {
        let fraction = (force.peak.at - start) / step;
        let beside = sum_at(fraction) - force.at(fraction);
        consider(force.peak.value + beside, force.peak.at);
    }
    for (sum, at) in ends.into_iter().zip([start, start + step]) {
        consider(sum, at);
    }
    let all_smooth = forces.iter().all(|force| force.curve.is_some());
    let sum = smooth.filter(|_| all_smooth);
    if let Some(most) = sum.and_then(|sum| sum.peak(start, step)) {
        consider(most.value, most.at);
    }
    peak
}

/// Peak total force of every gap.
pub(super) struct GapForces {
    /// Gap by gap.
    pub(super) peaks: Vec<Extreme>,
    /// Closed contacts of the step just accepted, with their gaps.
    step: Vec<(usize, StepForce)>,
    /// Those of one gap.
    together: Vec<StepForce>,
    /// Whether buildings are in space: many points of a gap close together.
    in_space: bool,
}

impl GapForces {
    pub(super) fn new(system: &System) -> Self {
        let gaps = system.contacts.iter().map(|contact| contact.gap + 1);
        Self {
            peaks: vec![Extreme::default(); gaps.max().unwrap_or(0)],
            step: Vec::with_capacity(system.contacts.len()),
            together: Vec::with_capacity(system.contacts.len()),
            in_space: system.is_in_space(),
        }
    }

    /// Adds a closed contact of the step just accepted.
    pub(super) fn add(&mut self, gap: usize, force: StepForce) {
        self.step.push((gap, force));
    }

    /// Updates the peaks after a step \[s\] that began at `start` \[s\].
    pub(super) fn finish_step(&mut self, start: f64, step: f64) {
        if self.in_space {
            return self.finish_in_space(start, step);
        }
        for (index, (gap, _)) in self.step.iter().enumerate() {
            // Every gap once.
            if self.step[..index].iter().any(|(place, _)| place == gap) {
                continue;
            }
            let gap_forces = self.step.iter().filter(|(place, _)| place == gap);
            self.together.clear();
            self.together.extend(gap_forces.map(|(_, force)| *force));
            let most = peak_of_sum(&self.together, start, step);
            if most.value > self.peaks[*gap].value {
                self.peaks[*gap] = most;
            }
        }
        self.step.clear();
    }

    /// The same, gap after gap.
    fn finish_in_space(&mut self, start: f64, step: f64) {
        if !self.step.is_sorted_by_key(|(gap, _)| *gap) {
            self.step.sort_unstable_by_key(|(gap, _)| *gap);
        }
        let mut left = &self.step[..];
        while let Some((gap, _)) = left.first() {
            let count = left.iter().take_while(|(place, _)| place == gap).count();
            let (gap_forces, others) = left.split_at(count);
            left = others;
            self.together.clear();
            self.together
                .extend(gap_forces.iter().map(|(_, force)| *force));
            let most = peak_of_many(&self.together, start, step);
            if most.value > self.peaks[*gap].value {
                self.peaks[*gap] = most;
            }
        }
        self.step.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forces(gaps: usize) -> GapForces {
        GapForces {
            peaks: vec![Extreme::default(); gaps],
            step: Vec::new(),
            together: Vec::new(),
            in_space: false,
        }
    }

    /// A force F(t) = a + b t + c t² over one step of 2 s that begins at 10 s.
    fn parabola(a: f64, b: f64, c: f64) -> StepForce {
        let (start, end) = (a, a + 2.0 * b + 4.0 * c);
        let curve = Cubic::new(start, b, end, b + 4.0 * c, 2.0);
        let last = Extreme {
            value: end,
            at: 12.0,
        };
        StepForce {
            ends: [start, end],
            curve: Some(curve),
            peak: curve.peak(10.0, 2.0).unwrap_or(last),
        }
    }

    /// 1 + 4t − t² rises all the way; 5 − 2t falls; their sum 6 + 2t − t² peaks at t = 1 with 7.
    #[test]
    fn the_sum_peaks_between_the_peaks_of_its_parts() {
        let mut gaps = forces(2);
        gaps.add(1, parabola(1.0, 4.0, -1.0));
        gaps.add(1, parabola(5.0, -2.0, 0.0));
        gaps.finish_step(10.0, 2.0);
        assert_eq!(gaps.peaks[0], Extreme::default());
        assert!(
            (gaps.peaks[1].value - 7.0).abs() < 1e-12,
            "{:?}",
            gaps.peaks
        );
        assert!((gaps.peaks[1].at - 11.0).abs() < 1e-12, "{:?}", gaps.peaks);
    }

    /// Many forces at once give what one after the other gives.
    #[test]
    fn many_forces_sum_as_few_do() {
        let corner = StepForce {
            ends: [2.0, 6.0],
            curve: None,
            peak: Extreme {
                value: 9.0,
                at: 11.5,
            },
        };
        let waves = [
            parabola(1.0, 4.0, -1.0),
            parabola(5.0, -2.0, 0.0),
            parabola(0.5, 3.0, -1.5),
        ];
        let [a, b, c] = waves;
        for forces in [&[a, b, c][..], &[a, corner, b], &[corner], &[]] {
            let (few, many) = (
                peak_of_sum(forces, 10.0, 2.0),
                peak_of_many(forces, 10.0, 2.0),
            );
            assert!((few.value - many.value).abs() < 1e-12, "{few:?}, {many:?}");
            assert!((few.at - many.at).abs() < 1e-12, "{few:?}, {many:?}");
        }
    }

    /// A force that sets in with a jump at the start of a step counts there.
    #[test]
    fn a_jump_at_the_start_counts() {
        let mut gaps = forces(1);
        gaps.add(0, parabola(9.0, -3.0, 0.0));
        gaps.add(0, parabola(4.0, 0.0, 0.0));
        gaps.finish_step(10.0, 2.0);
        assert_eq!(
            gaps.peaks[0],
            Extreme {
                value: 13.0,
                at: 10.0
            }
        );
    }

    /// Alone, a contact has its own peak, also where its force has a corner.
    #[test]
    fn one_contact_alone_has_its_own_peak() {
        let peak = Extreme {
            value: 8.0,
            at: 10.5,
        };
        let mut gaps = forces(1);
        gaps.add(
            0,
            StepForce {
                ends: [6.0, 3.0],
                curve: None,
                peak,
            },
        );
        gaps.finish_step(10.0, 2.0);
        assert_eq!(gaps.peaks[0], peak);
    }
}
