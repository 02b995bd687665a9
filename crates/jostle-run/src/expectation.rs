//! What a run is expected to take: steps, time on this machine, memory and files.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use jostle::stepping::Progress;
use jostle::{RunEnd, Settings, Solver};
use jostle_io::InputError;

use crate::history_file::{IN_MEMORY, room_for_histories};
use crate::numbers::counted_grouped;
use crate::prepared::Prepared;

/// Largest table of histories without being asked for: beyond it, an interval is more likely a slip \[bytes\].
const MOST_TABLE: f64 = 8e9;
/// Memory of a run beside its histories \[bytes\].
const BESIDE: f64 = 40e6;
/// Memory that a table and a page need for their columns, per byte of a row.
const OF_COLUMNS: f64 = 700.0;
/// Histories that are kept at a time: steps that are chosen by comparison keep those of two runs, and the run without contact comes
/// beside that with contact.
const KEPT: [[f64; 2]; 2] = [[1.0, 2.0], [2.0, 3.0]];
/// Bytes of `history.parquet` per byte of histories.
const IN_FILE: f64 = 0.9;
/// Computing time of one displacement in one step on a usual machine \[s\].
const TIME_OF_ONE: f64 = 2e-8;
/// Time that a run may use to find out how fast this machine is.
const TRIED: Duration = Duration::from_millis(200);
/// What users wait for without a word: longer runs are announced \[s\].
const PATIENCE: f64 = 10.0;
/// Duration of a run relative to that of its first pass through the motion: with automatic steps direct runs take a pass with
/// steps about twice as long first, with given steps afterwards.
const PASSES: [f64; 2] = [3.0, 1.6];

/// Expected size of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Regular steps, without those of closed contacts.
    pub steps: u64,
    /// Rows of the histories, without those of closed contacts.
    pub rows: u64,
    /// Memory of the whole run \[bytes\].
    pub memory: f64,
    /// Greatest size of its temporary files, which hold the histories beyond what stays in memory \[bytes\].
    pub temporary: f64,
    /// Size of `history.parquet` \[bytes\].
    pub history_file: f64,
    /// Greatest duration relative to the expected one, if the tolerance asks for finer steps.
    pub longest: f64,
}

impl Prepared {
    /// Expected size of a run with these settings. `both`: the run without contact follows, and its histories are kept beside
    /// those of the run with contact.
    #[must_use]
    pub fn expect(&self, settings: Settings, both: bool) -> Expectation {
        let settings = self.with_rows_for_spectra(settings);
        let size = self
            .plan
            .history_size(&self.system, &self.motion, &settings);
        let both = both && !self.system.contacts.is_empty();
        let repeats = !matches!(self.plan.solver, Solver::Modal | Solver::Series);
        let kept = KEPT[usize::from(repeats)][usize::from(both)];
        let rows = size.map_or(0.0, |size| size.rows);
        let row = size.map_or([0.0; 2], |size| {
            [size.table_bytes, size.row_bytes - size.table_bytes]
        });
        // The table, and loops of springs with forces of members.
        let parts = row.map(|bytes| rows * bytes);
        let in_memory: f64 = parts.map(|bytes| bytes.min(IN_MEMORY)).iter().sum();
        Expectation {
            steps: (self.motion.duration / self.plan.step).ceil() as u64,
            rows: rows as u64,
            memory: BESIDE + OF_COLUMNS * row[0] + kept * in_memory,
            temporary: kept * (parts.iter().sum::<f64>() - in_memory),
            history_file: IN_FILE * parts[0],
            longest: (self.plan.longest_refined(&self.system, &self.motion) / PASSES[0]).max(1.0),
        }
    }

    /// Refuses a run whose histories are a table of more than 8 GB, or need more room for temporary files than there is;
    /// `remedy` says how to run it all the same.
    ///
    /// # Errors
    /// The refusal, with the interval of rows that fits.
    pub fn check_histories(
        &self,
        settings: Settings,
        both: bool,
        remedy: Option<&str>,
    ) -> Result<(), InputError> {
        let expected = self.expect(settings, both);
        let room = room_for_histories();
        let (needed, most, problem) = match room {
            _ if expected.history_file > MOST_TABLE => (
                expected.history_file,
                MOST_TABLE,
                format!(
                    "make a history.parquet of {}, more than {};",
                    in_bytes(expected.history_file),
                    in_bytes(MOST_TABLE)
                ),
            ),
            Some((folder, free)) if expected.temporary > free => (
                expected.temporary,
                free,
                format!(
                    "need temporary files of {} in {}, where {} are free; set TMPDIR to a folder with more, or",
                    in_bytes(expected.temporary),
                    folder.display(),
                    in_bytes(free)
                ),
            ),
            _ => return Ok(()),
        };
        let interval = settings.record_interval.unwrap_or_default();
        let least = self.motion.duration / expected.rows as f64;
        let longer = 1e3 * interval.max(least) * needed / most.max(1e6);
        let anyway = remedy.map_or_else(String::new, |remedy| format!("; {remedy}"));
        Err(self.input.fault(
            "output.interval",
            format!(
                "{} of histories {problem} write interval = \"{:.0} ms\" under [output] for fewer rows{anyway}",
                counted_grouped(expected.rows, "row"),
                longer.ceil()
            ),
        ))
    }

    /// Expected time of a run on this machine, from its first 0.2 s \[s\]. `both`: the run without contact follows, which a run by modes
    /// or power series makes in little time.
    #[must_use]
    pub fn expected_seconds(&self, settings: Settings, both: bool) -> f64 {
        let settings = self.with_rows_for_spectra(settings);
        let mut pace = Pace::new(self);
        let outcome = self.step(settings, |progress| {
            pace.look(progress);
            if pace.has_settled() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        // The beginning of a motion is quiet.
        let work = self.plan.expected_work(&self.system, self.motion.duration);
        let least = pace.passes * work * TIME_OF_ONE;
        let of_one = match outcome.end {
            RunEnd::Stopped if pace.expected.is_finite() => pace.expected.max(least),
            RunEnd::Stopped => least,
            RunEnd::Completed | RunEnd::Failed(_) => pace.started.elapsed().as_secs_f64(),
        };
        let again = both
            && !self.system.contacts.is_empty()
            && !matches!(self.plan.solver, Solver::Modal | Solver::Series);
        if again { 2.0 * of_one } else { of_one }
    }
}

/// Estimates the time of a run from how far it is.
#[derive(Clone, Debug)]
pub struct Pace {
    started: Instant,
    /// Time of the run relative to that of its first pass.
    passes: f64,
    /// Step of the plan: contacts at rest may divide the first ones into much shorter ones \[s\].
    step: f64,
    /// Computing time and time reached after the first steps, which factorise the equations \[s\].
    first: Option<[f64; 2]>,
    /// Computing time since then \[s\].
    since: f64,
    /// Time reached in the first pass, infinite afterwards \[s\].
    reached: f64,
    expected: f64,
}

impl Pace {
    /// Of a run that begins now.
    #[must_use]
    pub fn new(prepared: &Prepared) -> Self {
        let passes = match prepared.plan.solver {
            Solver::Modal | Solver::Series => 1.0,
            Solver::Riccati | Solver::Stiffness | Solver::Product => {
                PASSES[usize::from(prepared.plan.is_given)]
            }
        };
        Self {
            started: Instant::now(),
            passes,
            step: prepared.plan.step,
            first: None,
            since: 0.0,
            reached: 0.0,
            expected: f64::INFINITY,
        }
    }

    /// Notes how far the run is; returns the time since it began and the expected time of the whole run \[s\].
    pub fn look(&mut self, progress: Progress) -> [f64; 2] {
        let elapsed = self.started.elapsed().as_secs_f64();
        let expected = self.note(elapsed, progress);
        [elapsed, expected]
    }

    /// Expected time of the whole run \[s\], infinite before its second steps.
    fn note(&mut self, elapsed: f64, progress: Progress) -> f64 {
        let Progress { time, duration } = progress;
        if time < self.reached {
            self.reached = f64::INFINITY;
            return self.expected;
        }
        self.reached = time;
        match self.first {
            None if time > 0.0 => self.first = Some([elapsed, time]),
            None => {}
            Some([beginning, from]) => {
                self.since = elapsed - beginning;
                if time - from >= self.step {
                    let rest = self.since * (duration - from) / (time - from);
                    self.expected = self.passes * (beginning + rest);
                }
            }
        }
        self.expected
    }

    /// Whether the time after the first steps is long enough to be extrapolated.
    fn has_settled(&self) -> bool {
        self.since > TRIED.as_secs_f64() || self.reached == f64::INFINITY
    }
}

impl Expectation {
    /// Time, memory and files in one line. `seconds`: expected time of computing.
    #[must_use]
    pub fn text(&self, seconds: f64) -> String {
        let rows = match self.rows {
            0 => "no histories".to_owned(),
            rows => {
                let beyond = match self.temporary {
                    0.0 => String::new(),
                    size => format!(", temporary files up to {}", in_bytes(size)),
                };
                format!(
                    "{} of histories (history.parquet about {}{beyond})",
                    counted_grouped(rows, "row"),
                    in_bytes(self.history_file)
                )
            }
        };
        // Said where it matters: few runs need more than one refinement.
        let longest = self.longest * seconds;
        let finer = match self.longest > 1.0 && longest > PATIENCE {
            true => format!(
                ", up to {} if the tolerance requires finer steps",
                in_time(longest).trim_start_matches("about ")
            ),
            false => String::new(),
        };
        format!(
            "{} of computing on this machine{finer}, about {} of memory, {rows}",
            in_time(seconds),
            in_bytes(self.memory)
        )
    }
}

/// A size with its unit, to one digit.
fn in_bytes(bytes: f64) -> String {
    let [number, unit] = match bytes {
        b if b >= 1e9 => [format!("{:.1}", b / 1e9), "GB".to_owned()],
        b if b >= 1e6 => [format!("{:.0}", b / 1e6), "MB".to_owned()],
        b => [format!("{:.0}", b / 1e3), "kB".to_owned()],
    };
    format!("{number} {unit}")
}

/// A time of computing, to one digit.
fn in_time(seconds: f64) -> String {
    let rounded = |value: f64| {
        let digit = libm::pow(10_f64, libm::log10(value).floor());
        ((value / digit).round() * digit) as u64
    };
    match seconds {
        s if s < 1.0 => "less than 1 s".to_owned(),
        s if s < 100.0 => format!("about {} s", rounded(s)),
        s if s < 6000.0 => format!("about {} min", rounded(s / 60.0)),
        s => format!("about {} h", rounded(s / 3600.0).max(1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Time for factors of the first steps is counted once per pass, not in every step.
    #[test]
    fn the_first_steps_are_not_extrapolated() {
        let mut pace = Pace {
            started: Instant::now(),
            passes: 3.0,
            step: 0.01,
            first: None,
            since: 0.0,
            reached: 0.0,
            expected: f64::INFINITY,
        };
        let mut at = |elapsed: f64, time: f64| {
            let duration = 20.0;
            pace.note(elapsed, Progress { time, duration })
        };
        assert_eq!(at(0.5, 0.0), f64::INFINITY);
        // The first step takes 6 s, the others 10 ms.
        assert_eq!(at(6.5, 0.01), f64::INFINITY);
        // Nor is a small part of a step, as where buildings stand in contact.
        assert_eq!(at(6.5, 0.01 + 1e-15), f64::INFINITY);
        let due = 3.0 * (6.5 + 0.01 * 1999.0);
        for steps in [2.0, 30.0] {
            let expected = at(6.5 + 0.01 * (steps - 1.0), 0.01 * steps);
            assert!((expected / due - 1.0).abs() < 1e-9, "{steps}: {expected}");
        }
        // The second pass begins.
        assert!((at(9.0, 0.005) / due - 1.0).abs() < 1e-9);
    }

    #[test]
    fn sizes_and_times_have_one_digit() {
        assert_eq!(in_bytes(41e6), "41 MB");
        assert_eq!(in_bytes(8e9), "8.0 GB");
        let times = [0.3, 4.4, 23.0, 400.0, 7000.0].map(in_time);
        assert_eq!(
            times,
            [
                "less than 1 s",
                "about 4 s",
                "about 20 s",
                "about 7 min",
                "about 2 h"
            ]
        );
    }
}
