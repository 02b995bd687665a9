//! Errors of records.

use super::formats::RecordFormat;
use crate::files::FileError;

/// An error of a record. Displays as `:line: problem`, to follow the name of the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The file cannot be read.
    #[error(": {0}")]
    File(FileError),
    /// More bytes than any record needs.
    #[error(
        ": has more than 64 MiB, the most that a record may have; cut the record, or export one component as columns of text"
    )]
    TooLarge,
    /// A folder where a record was expected.
    #[error(": is a folder, not a record; {}", inside(.records))]
    Folder {
        /// Names of records in it, as far as they are named, and one more if there are more.
        records: Vec<String>,
    },
    /// Neither text nor a binary format that is read.
    #[error(
        ": this is no plain text file, and neither miniSEED nor SAC; export the record as AT2, CSV or columns of text in UTF-8"
    )]
    Binary,
    /// An archive, or an encoding that is not read.
    #[error(": this is {what}; {remedy}")]
    Wrapped {
        /// Type of the file.
        what: &'static str,
        /// Remedy.
        remedy: &'static str,
    },
    /// An unknown format was requested.
    #[error(
        ": there is no record format \"{found}\"; formats: {}",
        RecordFormat::keys()
    )]
    UnknownFormat {
        /// The text.
        found: String,
    },
    /// A header or block that breaks the rules of its format.
    #[error("{}: {problem} (read as {format})", place(*.line))]
    Malformed {
        /// Format in which the file was read.
        format: RecordFormat,
        /// Line, from 1; 0 for binary formats.
        line: usize,
        /// The problem, and what was expected.
        problem: String,
    },
    /// The file ends inside a number.
    #[error(
        ":{line}: the file ends in the middle of a number; is it complete? (If it is, end the last line.)"
    )]
    CutShort {
        /// Line, from 1.
        line: usize,
    },
    /// Too few values.
    #[error(": a record needs at least two values, found {found}")]
    TooFew {
        /// Values found.
        found: usize,
    },
    /// A value that is not a number.
    #[error(":{line}: \"{found}\" is not a number")]
    NotANumber {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// A value too large for an earthquake.
    #[error(
        "{}: an acceleration of {value} {unit} is beyond any earthquake; is the unit right?",
        place(*.line)
    )]
    TooStrong {
        /// Line, from 1; 0 for binary formats.
        line: usize,
        /// Value as in the file.
        value: f64,
        /// Unit in use.
        unit: String,
    },
    /// The count of the header differs from the number of values.
    #[error(
        "{}: the header announces {stated} values, the file has {found}; is it complete?",
        place(*.line)
    )]
    Count {
        /// Line of the header, from 1; 0 for binary formats.
        line: usize,
        /// Announced.
        stated: usize,
        /// Found.
        found: usize,
    },
    /// The peak of the values is not the one that the header states.
    #[error(
        "{}: the header states a peak of {stated}, the values have {found}; the file is damaged or was edited (read as {format}). Values that are right all the same can be given as columns of text",
        place(*.line)
    )]
    Peak {
        /// Format in which the file was read.
        format: RecordFormat,
        /// Line of the header, from 1; 0 for binary formats.
        line: usize,
        /// Stated, as in the file.
        stated: f64,
        /// Of the values, as in the file.
        found: f64,
    },
    /// Header without count and step.
    #[error(
        ": no header line with NPTS and DT in the first {lines} lines, as in \"NPTS= 4000, DT= .0100 SEC\""
    )]
    NoHeader {
        /// Lines looked at.
        lines: usize,
    },
    /// Header line that cannot be understood.
    #[error(
        ":{line}: cannot read the number of values and the time step from \"{found}\"; expected a line such as \"NPTS= 4000, DT= .0100 SEC\""
    )]
    Header {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// A header with more than one time step.
    #[error(
        ":{line}: the header gives {} as the time step; correct the line, or say the right one with step = \"{} s\" beside record",
        steps.iter().map(|step| format!("{step}")).collect::<Vec<_>>().join(" and "),
        steps.last().copied().unwrap_or_default()
    )]
    SeveralSteps {
        /// Line, from 1.
        line: usize,
        /// Steps, at least two \[s\].
        steps: Vec<f64>,
    },
    /// A unit in the file that is not known.
    #[error(
        ":{line}: the unit \"{found}\" is not known; say the right one with unit = \"g\" or unit = \"cm/s2\" beside record"
    )]
    UnknownUnit {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// The requested unit is not a unit of acceleration.
    #[error(": unit = \"{found}\" is not an acceleration; say \"g\" or \"cm/s2\", for example")]
    OptionUnit {
        /// The text.
        found: String,
    },
    /// The unit in the file is not a unit of acceleration.
    #[error(
        ":{line}: the unit \"{found}\" is not an acceleration; records of velocity or displacement cannot be used"
    )]
    Unit {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// The file contains other quantities than accelerations.
    #[error(": this {format} file holds {found}, and accelerations are needed{remedy}")]
    NotAcceleration {
        /// Format in which the file was read.
        format: RecordFormat,
        /// Its quantity.
        found: String,
        /// Where to find accelerations, or empty.
        remedy: &'static str,
    },
    /// The unit is stated nowhere.
    #[error(
        ": which unit do the accelerations have (largest number: {largest})? Say it with unit = \"g\" or unit = \"cm/s2\" beside record, or in the file's first line as # unit = g"
    )]
    UnitUnknown {
        /// Largest number of the file, for the message.
        largest: f64,
    },
    /// A format without units.
    #[error(
        ": {format} states no unit (largest number: {largest}). Say the unit with unit = \"m/s2\" beside record, and for counts of a digitiser also the size of one count in this unit, record_scale = 1/sensitivity"
    )]
    CountsUnknown {
        /// Format in which the file was read.
        format: RecordFormat,
        /// Largest number of the file, for the message.
        largest: f64,
    },
    /// The instrument's zero is not the ground at rest.
    #[error(
        ": the values have a mean of {mean}, and swing around it by {swing}: the zero of the digitiser. Say remove_mean = true beside record to take it off, or remove_mean = false to keep it"
    )]
    Offset {
        /// Mean of the values, as in the file.
        mean: f64,
        /// Largest distance from the mean, as in the file.
        swing: f64,
    },
    /// A factor in the header that programs treat differently.
    #[error(
        ": the header has SCALE = {stated}, which some programs apply and others do not; say record_scale = {stated} beside record to multiply by it, or record_scale = 1"
    )]
    HeaderScale {
        /// The factor.
        stated: f64,
    },
    /// An option for what the file states itself.
    #[error(
        ": the file states {what} itself ({stated}), and {key} contradicts it (read as {format}); omit {key}"
    )]
    Stated {
        /// Format in which the file was read.
        format: RecordFormat,
        /// The option.
        key: &'static str,
        /// Quantity of the option.
        what: &'static str,
        /// As the file states it.
        stated: String,
    },
    /// A factor that is not a usable number.
    #[error(": record_scale = {found} is not usable; it must be a number other than zero")]
    OptionScale {
        /// The factor.
        found: f64,
    },
    /// The time step is stated nowhere.
    #[error(
        ": which time step do the values have? Say it with step = \"0.01 s\" beside record, or in the file's first line as # step = 0.01 s"
    )]
    StepUnknown,
    /// A time step that cannot be used.
    #[error(": the time step of {step} s is not usable; it must lie between 1e-6 s and 10 s")]
    Step {
        /// The step.
        step: f64,
    },
    /// Times that are not equally spaced.
    #[error(
        ":{line}: time {found} s where {expected} s was expected; time steps must be equal, resample the record"
    )]
    UnequalStep {
        /// Line, from 1.
        line: usize,
        /// Time found \[s\].
        found: f64,
        /// Time expected \[s\].
        expected: f64,
    },
    /// Times whose rounding hides their step.
    #[error(
        ": the times are rounded to {digit} s, too coarsely to show their step; say it with step = \"{suggested} s\" beside record, if that is right"
    )]
    RoundedTimes {
        /// Unit of the last digit \[s\].
        digit: f64,
        /// A simple step that fits \[s\].
        suggested: f64,
    },
    /// A time that is not later than the one before.
    #[error(":{line}: time {found} s does not come after the time before it")]
    TimeNotRising {
        /// Line, from 1.
        line: usize,
        /// Time found \[s\].
        found: f64,
    },
    /// Digitised film: times are not equally spaced.
    #[error(
        ":{line}: the times of this uncorrected record are not equally spaced (steps between {least} s and {greatest} s); use the corrected record (volume 2), or say step = \"{suggested} s\" beside record to have it interpolated linearly"
    )]
    FilmTimes {
        /// Line of the data, from 1.
        line: usize,
        /// Least step \[s\].
        least: f64,
        /// Greatest step \[s\].
        greatest: f64,
        /// A common step near the mean \[s\].
        suggested: f64,
    },
    /// The file's times contradict the stated step.
    #[error(
        ": the times of the file have a step of {found} s, but step = {stated} s is stated; omit step"
    )]
    StepConflict {
        /// Step of the file.
        found: f64,
        /// Step of the option.
        stated: f64,
    },
    /// Which of several columns?
    #[error(
        ":{line}: {columns} columns; which one holds the acceleration? Say it with column = 2 beside record"
    )]
    WhichColumn {
        /// Line, from 1.
        line: usize,
        /// Columns found.
        columns: usize,
    },
    /// Several numbers on a line: instants, or columns?
    #[error(
        ":{line}: {count} numbers on a line, and no names: say read = {{ per_line = {count} }} beside record if they are accelerations that continue from line to line, or column = 2 if one column holds them"
    )]
    ColumnsOrValues {
        /// Line, from 1.
        line: usize,
        /// Numbers on it.
        count: usize,
    },
    /// Several values on a line that continue from line to line.
    #[error(
        ":{line}: {}; say read = {{ per_line = {count} }} beside record to read all of them, or read = {{ content = \"columns\" }} with column if they are columns all the same",
        match .last {
            Some(last) => format!("the lines have {count} numbers each and the last one {last}, as values that continue from line to line"),
            None => format!("the {count} numbers of a line continue from line to line: they are {count} accelerations, not columns"),
        }
    )]
    Continued {
        /// Line, from 1.
        line: usize,
        /// Numbers on a line.
        count: usize,
        /// Numbers on the last line, if it has fewer.
        last: Option<usize>,
    },
    /// A first number that differs in kind from those below.
    #[error(
        ":{line}: \"{found}\" {difference}. If it is a count or a time step, say read = {{ skip = {skip} }} beside record; if it is the first acceleration, read = {{ skip = 0 }}"
    )]
    FirstNumber {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
        /// Comparison with the numbers below.
        difference: String,
        /// Line of the last such number.
        skip: usize,
    },
    /// A first line that has another number of cells than all lines below it.
    #[error(
        ":{line}: {found} numbers, and {below} on the lines below. Say read = {{ skip = {line} }} beside record to leave the lines up to this one out"
    )]
    FirstLine {
        /// Line, from 1.
        line: usize,
        /// Numbers on it.
        found: usize,
        /// Numbers on the lines below.
        below: usize,
    },
    /// Text below numbers.
    #[error(
        ":{line}: \"{found}\" is not a number, and the line above has numbers. If both are header, say read = {{ skip = {line} }} beside record"
    )]
    TextBelowNumbers {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
    },
    /// Numbers without separators whose widths differ from line to line.
    #[error(
        ":{line}: \"{found}\" is not a number; if numbers stand without blanks between them, say their widths, such as read = {{ widths = [{}] }} beside record",
        widths.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
    )]
    Glued {
        /// Line, from 1.
        line: usize,
        /// The text.
        found: String,
        /// Widths that most lines show.
        widths: Vec<usize>,
    },
    /// A line that does not fit the stated widths.
    #[error(
        ":{line}: the line does not fit widths = [{}]: every width must hold one number, and nothing may follow",
        widths.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
    )]
    Widths {
        /// Line, from 1.
        line: usize,
        /// Widths.
        widths: Vec<usize>,
    },
    /// A line with another number of values than stated.
    #[error(":{line}: {found} numbers, but per_line = {stated}; only the last line may have fewer")]
    PerLine {
        /// Line, from 1.
        line: usize,
        /// Numbers found.
        found: usize,
        /// Numbers stated.
        stated: usize,
    },
    /// Statements about the lines that do not fit the file, or each other.
    #[error(": read: {problem}")]
    Layout {
        /// The problem.
        problem: String,
    },
    /// Statements about the lines of a format that states its own layout.
    #[error(
        ": read goes with columns of text, and widths with AT2 as well (read as {format}); omit read, or say format = \"columns\""
    )]
    LayoutOfFormat {
        /// Format in which the file was read.
        format: RecordFormat,
    },
    /// The column asked for does not exist.
    #[error(":{line}: there is no column {wanted}; the line has {columns}")]
    NoColumn {
        /// Line, from 1.
        line: usize,
        /// Column asked for.
        wanted: usize,
        /// Columns found.
        columns: usize,
    },
    /// Which of several components?
    #[error(
        ": this {format} file has several components; choose one with component = \"{example}\" beside record. There are: {channels}"
    )]
    WhichComponent {
        /// Format in which the file was read.
        format: RecordFormat,
        /// A possible choice.
        example: String,
        /// Available channels.
        channels: String,
    },
    /// The component asked for does not exist.
    #[error(": there is no component \"{wanted}\" in this {format} file. There are: {channels}")]
    NoComponent {
        /// Format in which the file was read.
        format: RecordFormat,
        /// Component asked for.
        wanted: String,
        /// Available channels.
        channels: String,
    },
    /// Several channels fit the component asked for.
    #[error(
        ": component \"{wanted}\" fits several channels of this {format} file; choose by number, component = \"1\". There are: {channels}"
    )]
    AmbiguousComponent {
        /// Format in which the file was read.
        format: RecordFormat,
        /// Component asked for.
        wanted: String,
        /// Available channels.
        channels: String,
    },
    /// Lines of different length.
    #[error(":{line}: expected {expected} columns as on the lines before, found {found}")]
    Ragged {
        /// Line, from 1.
        line: usize,
        /// Columns found.
        found: usize,
        /// Columns of the first line.
        expected: usize,
    },
    /// A table of measurements without names or units of its columns.
    #[error(
        ": {problem}; a NEES .asc file has six header rows, among them the names of the columns (Time, …) and their units (sec, …), and numbers from line 7 on"
    )]
    MeasuredHeader {
        /// What is missing.
        problem: String,
    },
    /// A cell of such a table that is not a number.
    #[error(
        ":{line}: column {column} ({name}): \"{found}\" is not a number; correct the value, or remove the row and those after it"
    )]
    MeasuredCell {
        /// Line, from 1.
        line: usize,
        /// Column, from 1, that of the times included.
        column: usize,
        /// Name of the column.
        name: String,
        /// The text.
        found: String,
    },
    /// Numbers far too large for g.
    #[error(
        ": the largest number is {largest}, surely not g; say the right unit, for example unit = \"cm/s2\""
    )]
    SurelyNotG {
        /// Largest number of the file.
        largest: f64,
    },
}

/// Contents of a folder as text.
fn inside(records: &[String]) -> String {
    match records {
        [] => "there is no record in it".to_owned(),
        [one] => format!("give the record in it: {one}"),
        several => {
            let named = several.iter().take(super::NAMED_RECORDS);
            let more = if several.len() > super::NAMED_RECORDS {
                ", …"
            } else {
                ""
            };
            let named: Vec<_> = named.map(String::as_str).collect();
            format!("give one of the records in it: {}{more}", named.join(", "))
        }
    }
}

/// `:12`, or empty for binary formats.
fn place(line: usize) -> String {
    if line == 0 {
        String::new()
    } else {
        format!(":{line}")
    }
}
