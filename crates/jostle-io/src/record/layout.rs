//! What the user says about the lines of a text record, as other programs ask it: lines to skip, values on a line.

use super::error::RecordError;

/// How the numbers of a line follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordContent {
    /// Accelerations that continue from line to line.
    Values,
    /// Times and accelerations in turn, which continue from line to line.
    Pairs,
    /// One instant on a line.
    Columns,
}

impl RecordContent {
    /// Every kind of content.
    pub const ALL: [Self; 3] = [Self::Values, Self::Pairs, Self::Columns];

    /// The word for it in model files and on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Values => "values",
            Self::Pairs => "pairs",
            Self::Columns => "columns",
        }
    }

    /// The content of this word.
    #[must_use]
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|content| content.key() == key)
    }
}

/// Layout of the lines of a text record, as far as the user states it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RecordLayout {
    /// Lines at the top that are not read. The next line is then data or names of columns, never a count or a step.
    pub skip: Option<usize>,
    /// Last line that is read, counted from 1.
    pub last: Option<usize>,
    /// Numbers on every line but the last; they continue from line to line unless `content` says otherwise.
    pub per_line: Option<usize>,
    /// How the numbers of a line follow each other.
    pub content: Option<RecordContent>,
    /// Widths of the numbers on a line, without separators; a single width repeats, none reads separated numbers.
    pub widths: Vec<usize>,
}

/// Greatest width of a number \[characters\].
const WIDEST: usize = 40;

impl RecordLayout {
    /// Whether nothing is stated.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Whether only widths are stated.
    pub(crate) fn is_widths_only(&self) -> bool {
        let without = Self {
            widths: Vec::new(),
            ..self.clone()
        };
        without.is_empty() && !self.widths.is_empty()
    }

    /// Content stated in words or by a number of values on a line.
    pub(crate) fn content(&self) -> Option<RecordContent> {
        let wrapped = self.per_line.map(|_| RecordContent::Values);
        self.content.or(wrapped)
    }

    /// Refuses numbers that no file can have, and statements that contradict each other.
    ///
    /// # Errors
    /// [`RecordError::Layout`] with the key and the remedy.
    pub fn check(&self) -> Result<(), RecordError> {
        let wrong = |problem: String| Err(RecordError::Layout { problem });
        if self.last == Some(0) {
            return wrong("last = 0: lines count from 1".into());
        }
        if let (Some(skip), Some(last)) = (self.skip, self.last)
            && skip >= last
        {
            return wrong(format!("skip = {skip} leaves no line up to last = {last}"));
        }
        if self.per_line == Some(0) {
            return wrong("per_line = 0: a line has one number at least".into());
        }
        if let Some(width) = self.widths.iter().find(|w| !(1..=WIDEST).contains(*w)) {
            return wrong(format!(
                "widths = [{width}]: a number has 1 to {WIDEST} characters"
            ));
        }
        if let (Some(RecordContent::Pairs), Some(per_line)) = (self.content, self.per_line)
            && per_line % 2 == 1
        {
            return wrong(format!(
                "per_line = {per_line} is odd, and pairs have two numbers each"
            ));
        }
        Ok(())
    }
}
