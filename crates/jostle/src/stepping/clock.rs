//! Position of a run on its grid of regular steps.

/// Time as whole free-vibration steps plus an offset: regular instants do not drift, and steps after an event
/// return to the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    step: f64,
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

impl Clock {
    pub(crate) fn new(step: f64) -> Self {
        Self {
            step,
            index: 0,
            offset: 0.0,
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
        if !on_grid && f64::from(next) * part - self.offset < SHORTEST * part {
            next += 1;
        }
        let end = Self {
            step: self.step,
            index: self.index + u64::from(next / division),
            offset: f64::from(next % division) * part,
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
            step: self.step,
            index: self.index + whole as u64,
            offset: offset - whole * self.step,
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
        assert_eq!(
            clock,
            Clock {
                step: 0.002,
                index: 1,
                offset: 0.0
            }
        );
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
        assert_eq!(
            late.end,
            Clock {
                step: 0.01,
                index: 1,
                offset: 0.0025
            }
        );
    }
}
