//! Position of a run on its grid of regular steps.

/// Time as whole free-vibration steps plus an offset: regular instants do not drift, and steps after an event
/// return to the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    step: f64,
    /// The shortest remainder at the end of a free-vibration step that is not joined to the next step, as a fraction.
    shortest: f64,
    index: u64,
    offset: f64,
}

/// The next step to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NextStep {
    /// Its length \[s\].
    pub(crate) length: f64,
    /// Whether it is exactly one regular step of the requested division.
    pub(crate) regular: bool,
    /// Its end.
    pub(crate) end: Clock,
}

/// A remainder shorter than this fraction of a step is joined to the next step.
const SHORTEST: f64 = 0.25;
/// The same where steps are exact between the points of a record, at such a point: the slope of the ground acceleration
/// jumps there, and a step across it would miss that at any tolerance.
const SHORTEST_AT_RECORD_POINT: f64 = 1e-4;

impl Clock {
    pub(crate) fn new(step: f64) -> Self {
        Self {
            step,
            shortest: SHORTEST,
            index: 0,
            offset: 0.0,
        }
    }

    /// The same for steps that end at the points of a record, which are ends of free-vibration steps.
    pub(crate) fn ending_at_record_points(step: f64) -> Self {
        Self {
            shortest: SHORTEST_AT_RECORD_POINT,
            ..Self::new(step)
        }
    }

    pub(crate) fn time(&self) -> f64 {
        self.index as f64 * self.step + self.offset
    }

    /// The step to the next instant of the grid that divides every free-vibration step into `division` parts.
    pub(crate) fn next_step(&self, division: u32) -> NextStep {
        let part = self.step / f64::from(division);
        let passed = (self.offset / part + 1e-9).floor() as u32;
        let on_grid = self.offset == f64::from(passed) * part;
        let mut next = passed + 1;
        let shortest = if next.is_multiple_of(division) {
            self.shortest
        } else {
            SHORTEST
        };
        if !on_grid && f64::from(next) * part - self.offset < shortest * part {
            next += 1;
        }
        let end = Self {
            index: self.index + u64::from(next / division),
            offset: f64::from(next % division) * part,
            ..*self
        };
        if on_grid {
            return NextStep {
                length: part,
                regular: true,
                end,
            };
        }
        NextStep {
            length: f64::from(next) * part - self.offset,
            regular: false,
            end,
        }
    }

    /// Whether this is an instant of the grid that divides every free-vibration step into `division` parts.
    pub(crate) fn is_on_grid(&self, division: u32) -> bool {
        let part = self.step / f64::from(division);
        self.offset == (self.offset / part + 1e-9).floor() * part
    }

    /// The instant `length` later, off the grid.
    pub(crate) fn after(&self, length: f64) -> Self {
        let offset = self.offset + length;
        let whole = (offset / self.step).floor();
        Self {
            index: self.index + whole as u64,
            offset: offset - whole * self.step,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_strides_stay_on_the_grid() {
        let mut clock = Clock::new(0.002);
        for _ in 0..8 {
            let next = clock.next_step(8);
            assert!(next.regular, "{clock:?}");
            clock = next.end;
        }
        assert_eq!((clock.index, clock.offset), (1, 0.0));
        assert!(clock.next_step(1).regular);
    }

    #[test]
    fn an_event_is_followed_by_one_odd_stride_back_to_the_grid() {
        let clock = Clock::new(0.01).after(0.0061);
        let odd = clock.next_step(4);
        assert!(!odd.regular);
        assert!((odd.length - 0.0014).abs() < 1e-15, "{odd:?}");
        assert!(odd.end.next_step(4).regular);
        // Too little is left of this part: the step includes the next one, past the free-vibration grid.
        let late = Clock::new(0.01).after(0.0099).next_step(4);
        assert!((late.length - 0.0026).abs() < 1e-15, "{late:?}");
        assert_eq!((late.end.index, late.end.offset), (1, 0.0025));
    }

    #[test]
    fn no_step_leads_across_a_point_of_the_record() {
        let start = Clock::ending_at_record_points(0.01);
        for (offset, division) in [(0.0099, 4), (0.0085, 1), (0.009_999, 2)] {
            let next = start.after(offset).next_step(division);
            assert!((next.length - (0.01 - offset)).abs() < 1e-15, "{next:?}");
            assert_eq!((next.end.index, next.end.offset), (1, 0.0));
        }
        // Elsewhere, or where next to nothing is left, steps are joined.
        let joined = start.after(0.0024).next_step(4);
        assert!((joined.length - 0.0026).abs() < 1e-15, "{joined:?}");
        let joined = start.after(0.01 - 1e-7).next_step(4);
        assert!((joined.length - 0.002_500_1).abs() < 1e-15, "{joined:?}");
    }
}
