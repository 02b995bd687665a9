//! The cases whose figures are drawn: all, or in large studies a part of them, so that memory does not grow.

use jostle_io::DesignKind;

use crate::study::Study;

/// Cases drawn at most.
pub(super) const MOST_DRAWN: u64 = 200_000;

/// A part of the cases of a study, in order. Rows of its tables are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sample {
    pub(super) rows: u64,
    rule: Rule,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    /// The first ones: draws are independent of each other, and trajectories and base samples are whole.
    First,
    /// Of the draws for every combination of the lists, the first `taken`.
    Draws { of: u64, taken: u64 },
    /// Every so many. The step is a prime that divides the length of no list, so that all values of all lists occur.
    Every(u64),
}

impl Sample {
    /// At most about `most` cases of a study.
    pub(super) fn new(study: &Study, most: u64) -> Self {
        let design = &study.design;
        let cases = design.cases;
        let first = |block: u64| Self {
            rows: (most / block).max(1) * block,
            rule: Rule::First,
        };
        if cases <= most {
            return first(1).of_at_most(cases);
        }
        let factors = study.file.factors.len() as u64;
        match study.file.design.kind {
            DesignKind::LatinHypercube | DesignKind::Sobol | DesignKind::Random => first(1),
            DesignKind::Saltelli => first(factors + 2).of_at_most(cases),
            DesignKind::Morris => first(factors + 1).of_at_most(cases),
            DesignKind::OneAtATime => first(1).of_at_most(cases),
            DesignKind::Factorial | DesignKind::Zipped => {
                let (lists, draws) = design.lists_and_draws();
                let combinations = cases / draws;
                if combinations <= most {
                    let taken = most / combinations;
                    return Self {
                        rows: combinations * taken,
                        rule: Rule::Draws { of: draws, taken },
                    };
                }
                let mut step = cases.div_ceil(most);
                while !is_prime(step) || lists.iter().any(|length| length % step == 0) {
                    step += 1;
                }
                Self {
                    rows: cases.div_ceil(step),
                    rule: Rule::Every(step),
                }
            }
        }
    }

    fn of_at_most(self, cases: u64) -> Self {
        Self {
            rows: self.rows.min(cases),
            ..self
        }
    }

    /// The case of a row.
    pub(super) fn case(&self, row: usize) -> u64 {
        let row = row as u64;
        match self.rule {
            Rule::First => row,
            Rule::Draws { of, taken } => row / taken * of + row % taken,
            Rule::Every(step) => row * step,
        }
    }

    /// Whether a case is one of them.
    pub(super) fn holds(&self, case: u64) -> bool {
        match self.rule {
            Rule::First => case < self.rows,
            Rule::Draws { of, taken } => case % of < taken,
            Rule::Every(step) => case.is_multiple_of(step),
        }
    }
}

fn is_prime(number: u64) -> bool {
    number > 1
        && (2..)
            .take_while(|divisor| divisor * divisor <= number)
            .all(|divisor| !number.is_multiple_of(divisor))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use jostle_io::{Format, StudyFile};

    use super::*;

    fn study(text: &str) -> Study {
        let text = format!("base = \"paper\"\n{text}");
        let file = StudyFile::parse("s.toml", &text, Format::Toml, Path::new(""), None);
        Study::new(file.unwrap_or_else(|error| panic!("{error}")))
            .unwrap_or_else(|error| panic!("{error}"))
    }

    const GAP: &str =
        "[[vary]]\npath = \"gap[0].width\"\nrange = { from = 0.01, to = 0.1, count = 6 }\n";
    const PGA: &str =
        "[[vary]]\npath = \"motion.pga\"\nrange = { from = 1.0, to = 2.0, count = 10 }\n";
    const DRAWN: &str = "[[vary]]\npath = \"building.J1.damping.ratio\"\ndistribution = { kind = \"uniform\", from = 0.02, to = 0.05 }\n";

    /// Rows and cases agree, and every value of every list occurs.
    #[test]
    fn a_sample_of_a_large_study_has_all_values() {
        let whole = study(&format!("{GAP}{PGA}"));
        assert_eq!(Sample::new(&whole, 60).rows, 60);
        let drawn = format!("{GAP}{PGA}{DRAWN}[design]\nsamples = 8\n");
        let sobol = format!("{DRAWN}[design]\nkind = \"sobol\"\nsamples = 90\n");
        let saltelli = format!("{DRAWN}[design]\nkind = \"saltelli\"\nsamples = 90\n");
        for (text, most, rows) in [
            (format!("{GAP}{PGA}"), 20, 9),
            (drawn, 130, 120),
            (sobol, 20, 20),
            (saltelli, 20, 18),
        ] {
            let study = study(&text);
            let sample = Sample::new(&study, most);
            assert_eq!(sample.rows, rows, "{text}");
            let held: Vec<u64> = (0..study.design.cases)
                .filter(|case| sample.holds(*case))
                .collect();
            let named: Vec<u64> = (0..rows as usize).map(|row| sample.case(row)).collect();
            assert_eq!(held, named, "{text}");
        }
        let long = format!("{GAP}{PGA}")
            .replace("count = 6", "count = 50")
            .replace("count = 10", "count = 70");
        let drawn = study(&long);
        let sample = Sample::new(&drawn, 500);
        assert!(sample.rows > 70 && sample.rows <= 500);
        let mut seen = std::collections::BTreeSet::new();
        for row in 0..sample.rows as usize {
            for (factor, choice) in drawn
                .design
                .choices(sample.case(row), &drawn.file.factors)
                .iter()
                .enumerate()
            {
                seen.insert((factor, format!("{choice:?}")));
            }
        }
        assert_eq!(seen.len(), 50 + 70);
    }
}
