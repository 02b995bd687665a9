//! Checks that a model or its results did not pass.

use serde::Serialize;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Grade {
    /// An assumption worth knowing: in the report and in `summary.json`, not on the terminal.
    Remark,
    /// Look at it before the result is used.
    Note,
    /// The result does not hold as it stands.
    Warning,
}

impl Grade {
    /// As texts call it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Remark => "remark",
            Self::Note => "note",
            Self::Warning => "warning",
        }
    }
}

/// A check of [`crate::judgement`] that was not passed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Check, such as `B2`.
    pub id: &'static str,
    /// What it looks at, such as `drift`; a check may have several parts.
    pub name: &'static str,
    /// How much it matters.
    pub grade: Grade,
    /// What was found, in the unit of the check.
    pub value: f64,
    /// The limit that it crosses, in the same unit.
    pub limit: f64,
    /// Unit of both.
    pub unit: &'static str,
    /// Building, storey, gap or record.
    #[serde(rename = "where")]
    pub place: String,
    /// What was found, in one sentence.
    pub text: String,
    /// What to do about it.
    pub remedy: &'static str,
}
