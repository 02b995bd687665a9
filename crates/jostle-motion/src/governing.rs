//! Which value of several time histories governs a design: the rules of codes for suites of motions.

/// The rule by which the governing value is taken from the results of several motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoverningRule {
    /// GB 50011-2010 (2016), clause 5.1.2, item 3: with three motions the envelope, with seven or more the mean. Four to six
    /// motions are treated as three.
    Gb50011,
    /// EN 1998-1:2004, clause 4.3.3.4.3(3): the mean of at least seven analyses, otherwise the most unfavourable value.
    En1998,
    /// ASCE 7-16 and 7-22, sections 16.2.2 and 16.4: the mean of at least eleven motions. With fewer the section is not met,
    /// and the greatest value is taken.
    Asce7,
    /// The mean, whatever the number.
    Mean,
    /// The greatest value, whatever the number.
    Maximum,
}

/// Which number of a set of results counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoverningStatistic {
    /// Their mean.
    Mean,
    /// The greatest of them.
    Maximum,
}

/// What a rule says about a suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Governing {
    /// The rule.
    pub rule: GoverningRule,
    /// The number that counts.
    pub statistic: GoverningStatistic,
    /// Whether there are as many motions as the code asks for; true for rules that are not of a code.
    pub met: bool,
}

impl GoverningRule {
    /// All rules.
    pub const ALL: [Self; 5] = [
        Self::Gb50011,
        Self::En1998,
        Self::Asce7,
        Self::Mean,
        Self::Maximum,
    ];
    /// Their names, in the same order.
    pub const NAMES: [&str; 5] = ["gb50011", "en1998", "asce7", "mean", "maximum"];

    /// Name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Gb50011 => "gb50011",
            Self::En1998 => "en1998",
            Self::Asce7 => "asce7",
            Self::Mean => "mean",
            Self::Maximum => "maximum",
        }
    }

    /// The rule of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// The clause; empty for rules that are not of a code.
    #[must_use]
    pub fn clause(self) -> &'static str {
        match self {
            Self::Gb50011 => "GB 50011-2010 (2016), clause 5.1.2",
            Self::En1998 => "EN 1998-1:2004, clause 4.3.3.4.3(3)",
            Self::Asce7 => "ASCE 7-16 and 7-22, sections 16.2.2 and 16.4",
            Self::Mean | Self::Maximum => "",
        }
    }

    /// What the rule says about a number of motions.
    #[must_use]
    pub fn for_motions(self, motions: usize) -> Governing {
        let (mean_from, least) = match self {
            Self::Gb50011 | Self::En1998 => (7, 3),
            Self::Asce7 => (11, 11),
            Self::Mean => (0, 0),
            Self::Maximum => (usize::MAX, 0),
        };
        Governing {
            rule: self,
            statistic: if motions >= mean_from {
                GoverningStatistic::Mean
            } else {
                GoverningStatistic::Maximum
            },
            met: motions >= least,
        }
    }
}

impl GoverningStatistic {
    /// In files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Maximum => "maximum",
        }
    }

    /// The governing one of some values; `None` if there are none.
    #[must_use]
    pub fn value(self, values: &[f64]) -> Option<f64> {
        match self {
            Self::Mean if !values.is_empty() => {
                Some(values.iter().sum::<f64>() / values.len() as f64)
            }
            Self::Mean => None,
            Self::Maximum => values.iter().copied().max_by(f64::total_cmp),
        }
    }
}

impl Governing {
    /// The rule in a sentence, for `motions` motions.
    #[must_use]
    pub fn in_words(&self, motions: usize) -> String {
        let taken = match self.statistic {
            GoverningStatistic::Mean => "the mean",
            GoverningStatistic::Maximum => "the greatest value",
        };
        let asked = match self.rule {
            GoverningRule::Gb50011 => "three motions, or seven for the mean",
            GoverningRule::En1998 => "three accelerograms, or seven for the mean",
            GoverningRule::Asce7 => "eleven motions",
            GoverningRule::Mean | GoverningRule::Maximum => "",
        };
        let clause = self.rule.clause();
        match (clause.is_empty(), self.met) {
            (true, _) => format!("Governing value: {taken} of {motions} motions."),
            (false, true) => {
                format!("Governing value: {taken} of {motions} motions ({clause}).")
            }
            (false, false) => format!(
                "{clause}: at least {asked} are required, and there are {motions}. Governing value: {taken}."
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of the clauses: three and seven, three and seven, eleven.
    #[test]
    fn every_code_has_its_own_number_of_motions_for_the_mean() {
        use GoverningRule::{Asce7, En1998, Gb50011};
        use GoverningStatistic::{Maximum as Max, Mean};
        for (rule, motions, statistic, met) in [
            (Gb50011, 1, Max, false),
            (Gb50011, 2, Max, false),
            (Gb50011, 3, Max, true),
            (Gb50011, 6, Max, true),
            (Gb50011, 7, Mean, true),
            (En1998, 2, Max, false),
            (En1998, 3, Max, true),
            (En1998, 6, Max, true),
            (En1998, 7, Mean, true),
            (Asce7, 7, Max, false),
            (Asce7, 10, Max, false),
            (Asce7, 11, Mean, true),
            (GoverningRule::Mean, 2, Mean, true),
            (GoverningRule::Maximum, 20, Max, true),
        ] {
            let said = rule.for_motions(motions);
            assert_eq!(
                (said.statistic, said.met),
                (statistic, met),
                "{rule:?} {motions}"
            );
        }
    }

    #[test]
    fn names_lead_back_to_their_rules() {
        for (rule, name) in GoverningRule::ALL.into_iter().zip(GoverningRule::NAMES) {
            assert_eq!(rule.name(), name);
            assert_eq!(GoverningRule::from_name(name), Some(rule));
        }
        assert_eq!(GoverningStatistic::Mean.value(&[1.0, 2.0, 6.0]), Some(3.0));
        assert_eq!(
            GoverningStatistic::Maximum.value(&[1.0, 6.0, 2.0]),
            Some(6.0)
        );
        assert_eq!(GoverningStatistic::Mean.value(&[]), None);
    }
}
