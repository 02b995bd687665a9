//! Inputs from a table: a column for each key, a row for each case, read a few thousand rows at a time.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufRead, BufReader, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::factor::{Level, number_of_text};
use crate::files::open_file;
use crate::model_tree::TreeValue;
use crate::quantity::Dimension;
use crate::undamaged::undamaged;

/// Rows of a block.
const BLOCK: u64 = 4096;
/// Blocks that are kept: threads work on neighbouring cases.
const KEPT: usize = 4;
/// Longest line of a CSV file \[bytes\].
const LONGEST_LINE: u64 = 1 << 20;
/// Most columns.
const MOST_COLUMNS: usize = 10_000;

/// A table of inputs.
#[derive(Debug)]
pub struct InputTable {
    path: PathBuf,
    names: Vec<String>,
    rows: u64,
    /// Where blocks begin.
    blocks: Blocks,
    kept: Mutex<VecDeque<(u64, Arc<Block>)>>,
}

#[derive(Debug)]
enum Blocks {
    /// Rows of every row group.
    Parquet(Vec<u64>),
    /// Bytes before every block, and the mark between fields.
    Csv(Vec<u64>, u8),
}

/// Cells of some rows, column by column; `None` where a cell is empty.
type Block = Vec<Vec<Option<TreeValue>>>;

/// A column of a table of inputs.
#[derive(Clone, Debug)]
pub struct TableColumn {
    /// The table.
    pub table: Arc<InputTable>,
    /// The place of the column in it.
    pub column: usize,
    /// Whether all its cells are numbers, with units or without.
    pub is_numeric: bool,
    pub(super) dimension: Option<Dimension>,
}

impl PartialEq for TableColumn {
    fn eq(&self, other: &Self) -> bool {
        self.column == other.column && self.table.path == other.table.path
    }
}

impl TableColumn {
    /// The cell of a row; `None` if it is empty, and the model keeps its own value.
    ///
    /// # Errors
    /// Why the table can no longer be read.
    pub fn level(&self, row: usize) -> Result<Option<Level>, String> {
        let value = self.table.cell(row as u64, self.column)?;
        Ok(value.map(|value| Level {
            label: value.to_string(),
            number: match &value {
                TreeValue::Text(text) => number_of_text(text, self.dimension),
                TreeValue::Number(number) => Some(*number),
                TreeValue::Integer(number) => Some(*number as f64),
                _ => None,
            },
            value,
        }))
    }
}

impl InputTable {
    /// Opens a Parquet file, or a CSV file whose first line has the names of the columns.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn open(path: &Path) -> Result<Self, String> {
        let is_parquet = path
            .extension()
            .is_some_and(|end| end.eq_ignore_ascii_case("parquet"));
        let table = if is_parquet {
            undamaged(|| Self::parquet(path))?
        } else {
            Self::csv(path)?
        };
        if table.names.is_empty() || table.names.len() > MOST_COLUMNS {
            return Err(format!(
                "has {} columns; 1 to {MOST_COLUMNS} are possible",
                table.names.len()
            ));
        }
        if table.rows == 0 {
            return Err("has no rows".into());
        }
        if let Some(name) = table
            .names
            .iter()
            .enumerate()
            .find_map(|(at, name)| table.names[..at].contains(name).then_some(name))
        {
            return Err(format!("has two columns named \"{name}\""));
        }
        Ok(table)
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of its columns.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of its rows.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Whether all cells of a column that are not empty are numbers.
    pub(super) fn is_numeric(
        &self,
        column: usize,
        dimension: Option<Dimension>,
    ) -> Result<bool, String> {
        for first in (0..self.rows).step_by(BLOCK as usize) {
            let block = self.block(first / BLOCK)?;
            let number = |cell: &TreeValue| match cell {
                TreeValue::Text(text) => number_of_text(text, dimension).is_some(),
                TreeValue::Number(_) | TreeValue::Integer(_) => true,
                _ => false,
            };
            if !block[column].iter().flatten().all(number) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn cell(&self, row: u64, column: usize) -> Result<Option<TreeValue>, String> {
        let block = self.block(row / BLOCK)?;
        let cell = block
            .get(column)
            .and_then(|cells| cells.get((row % BLOCK) as usize));
        cell.cloned()
            .ok_or_else(|| format!("{} has changed: there is no row {row}", self.path.display()))
    }

    fn block(&self, number: u64) -> Result<Arc<Block>, String> {
        // Threads that need the same block wait for the first of them.
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, block)) = kept.iter().find(|(known, _)| *known == number) {
            return Ok(Arc::clone(block));
        }
        let block = match &self.blocks {
            Blocks::Parquet(groups) => undamaged(|| self.parquet_block(groups, number)),
            Blocks::Csv(starts, mark) => self.csv_block(starts, *mark, number),
        };
        let block = Arc::new(block.map_err(|error| format!("{}: {error}", self.path.display()))?);
        kept.push_front((number, Arc::clone(&block)));
        kept.truncate(KEPT);
        Ok(block)
    }

    fn new(path: &Path, names: Vec<String>, rows: u64, blocks: Blocks) -> Self {
        Self {
            path: path.to_owned(),
            names,
            rows,
            blocks,
            kept: Mutex::default(),
        }
    }

    fn parquet(path: &Path) -> Result<Self, ParquetError> {
        let file = open_file(path).map_err(|error| ParquetError::General(error.to_string()))?;
        let reader = SerializedFileReader::new(file)?;
        let metadata = reader.metadata();
        let schema = metadata.file_metadata().schema_descr();
        let mut names = Vec::new();
        for column in schema.columns() {
            if column.path().parts().len() > 1 || column.max_rep_level() > 0 {
                let problem = format!(
                    "the column {} is nested; only plain columns can be inputs",
                    column.path()
                );
                return Err(ParquetError::General(problem));
            }
            names.push(column.name().to_owned());
        }
        let groups: Vec<u64> = metadata
            .row_groups()
            .iter()
            .map(|group| u64::try_from(group.num_rows()).unwrap_or(0))
            .collect();
        let rows = groups.iter().sum();
        Ok(Self::new(path, names, rows, Blocks::Parquet(groups)))
    }

    fn parquet_block(&self, groups: &[u64], number: u64) -> Result<Block, ParquetError> {
        let file =
            open_file(&self.path).map_err(|error| ParquetError::General(error.to_string()))?;
        let reader = SerializedFileReader::new(file)?;
        let wanted = number * BLOCK..((number + 1) * BLOCK).min(self.rows);
        let mut block: Block = vec![Vec::new(); self.names.len()];
        let mut start = 0;
        for (index, &rows) in groups.iter().enumerate() {
            let range = wanted.start.max(start)..wanted.end.min(start + rows);
            if range.start < range.end {
                let group = reader.get_row_group(index)?;
                let [skip, count] =
                    [range.start - start, range.end - range.start].map(|n| n as usize);
                for (column, cells) in block.iter_mut().enumerate() {
                    let most = group
                        .metadata()
                        .column(column)
                        .column_descr()
                        .max_def_level();
                    add_cells(group.get_column_reader(column)?, [skip, count], most, cells)?;
                }
            }
            start += rows;
        }
        if block
            .iter()
            .any(|cells| cells.len() as u64 != wanted.end - wanted.start)
        {
            return Err(ParquetError::General("has changed, or is damaged".into()));
        }
        Ok(block)
    }

    fn csv(path: &Path) -> Result<Self, String> {
        let file = open_file(path).map_err(|error| error.to_string())?;
        let mut lines = Lines::new(file);
        let head = lines.next_line()?.ok_or("is empty")?;
        let head = head.strip_prefix('\u{feff}').unwrap_or(&head).to_owned();
        let mark = if head.contains(';') && !head.contains(',') {
            b';'
        } else {
            b','
        };
        let names = fields(&head, mark).map_err(|problem| format!("line 1: {problem}"))?;
        let (mut rows, mut starts) = (0, Vec::new());
        loop {
            let before = lines.read;
            let Some(line) = lines.next_line()? else {
                break;
            };
            if line.trim().is_empty() {
                continue;
            }
            if rows % BLOCK == 0 {
                starts.push(before);
            }
            let found = fields(&line, mark)
                .map_err(|problem| format!("line {}: {problem}", lines.number))?
                .len();
            if found != names.len() {
                return Err(format!(
                    "line {}: has {found} fields, the first line {}",
                    lines.number,
                    names.len()
                ));
            }
            rows += 1;
        }
        Ok(Self::new(path, names, rows, Blocks::Csv(starts, mark)))
    }

    fn csv_block(&self, starts: &[u64], mark: u8, number: u64) -> Result<Block, String> {
        let mut file = open_file(&self.path).map_err(|error| error.to_string())?;
        let start = starts.get(number as usize).ok_or("has changed")?;
        file.seek(SeekFrom::Start(*start))
            .map_err(|error| error.to_string())?;
        let mut lines = Lines::new(file);
        let wanted = BLOCK.min(self.rows - number * BLOCK) as usize;
        let mut block: Block = vec![Vec::with_capacity(wanted); self.names.len()];
        while block[0].len() < wanted {
            let line = lines.next_line()?.ok_or("has changed: lines are missing")?;
            if line.trim().is_empty() {
                continue;
            }
            let fields = fields(&line, mark)?;
            if fields.len() != block.len() {
                return Err("has changed".into());
            }
            for (cells, field) in block.iter_mut().zip(fields) {
                cells.push(value_of_field(&field));
            }
        }
        Ok(block)
    }
}

/// Lines of a file, none of which may be too long.
struct Lines {
    file: BufReader<File>,
    number: usize,
    /// Bytes of the lines so far.
    read: u64,
}

impl Lines {
    fn new(file: File) -> Self {
        Self {
            file: BufReader::new(file),
            number: 0,
            read: 0,
        }
    }

    fn next_line(&mut self) -> Result<Option<String>, String> {
        let mut bytes = Vec::new();
        let mut limited = std::io::Read::take(&mut self.file, LONGEST_LINE);
        let count = limited
            .read_until(b'\n', &mut bytes)
            .map_err(|error| error.to_string())?;
        if count == 0 {
            return Ok(None);
        }
        self.number += 1;
        self.read += count as u64;
        if count as u64 == LONGEST_LINE && bytes.last() != Some(&b'\n') {
            return Err(format!(
                "line {} is longer than {} MiB",
                self.number,
                LONGEST_LINE >> 20
            ));
        }
        let text =
            String::from_utf8(bytes).map_err(|_| format!("line {} is not UTF-8", self.number))?;
        Ok(Some(text.trim_end_matches(['\n', '\r']).to_owned()))
    }
}

/// Fields of a line of CSV (RFC 4180), on one line each.
fn fields(line: &str, mark: u8) -> Result<Vec<String>, String> {
    let mark = char::from(mark);
    let mut fields = Vec::new();
    let mut rest = line;
    loop {
        let trimmed = rest.trim_start_matches(' ');
        if let Some(mut inside) = trimmed.strip_prefix('"') {
            let mut field = String::new();
            loop {
                let end = inside
                    .find('"')
                    .ok_or("a quote is not closed on its line")?;
                field.push_str(&inside[..end]);
                inside = &inside[end + 1..];
                match inside.strip_prefix('"') {
                    Some(more) => {
                        field.push('"');
                        inside = more;
                    }
                    None => break,
                }
            }
            fields.push(field);
            let after = inside.trim_start_matches(' ');
            match after.strip_prefix(mark) {
                Some(next) => rest = next,
                None if after.is_empty() => return Ok(fields),
                None => return Err("text follows a closing quote".into()),
            }
        } else {
            match rest.split_once(mark) {
                Some((field, next)) => {
                    fields.push(field.trim().to_owned());
                    rest = next;
                }
                None => {
                    fields.push(rest.trim().to_owned());
                    return Ok(fields);
                }
            }
        }
    }
}

fn value_of_field(field: &str) -> Option<TreeValue> {
    if field.is_empty() {
        return None;
    }
    Some(match field {
        "true" => TreeValue::Flag(true),
        "false" => TreeValue::Flag(false),
        _ => match (field.parse::<i64>(), field.parse::<f64>()) {
            (Ok(whole), _) => TreeValue::Integer(whole),
            (_, Ok(number)) if number.is_finite() => TreeValue::Number(number),
            _ => TreeValue::Text(field.to_owned()),
        },
    })
}

fn add_cells(
    reader: ColumnReader,
    rows: [usize; 2],
    most: i16,
    into: &mut Vec<Option<TreeValue>>,
) -> Result<(), ParquetError> {
    let text = |bytes: &[u8]| match std::str::from_utf8(bytes) {
        Ok(text) if !text.is_empty() => Ok(Some(TreeValue::Text(text.to_owned()))),
        Ok(_) => Ok(None),
        Err(_) => Err(ParquetError::General("has a text that is not UTF-8".into())),
    };
    let number = |number: f64| {
        if number.is_finite() {
            Ok(Some(TreeValue::Number(number)))
        } else {
            Ok(None)
        }
    };
    match reader {
        ColumnReader::DoubleColumnReader(reader) => add(reader, rows, most, into, |v| number(*v)),
        // The shortest text of a number in single precision is that of the decimal number that was meant.
        ColumnReader::FloatColumnReader(reader) => add(reader, rows, most, into, |v| {
            number(v.to_string().parse().unwrap_or(f64::NAN))
        }),
        ColumnReader::Int32ColumnReader(reader) => add(reader, rows, most, into, |v| {
            Ok(Some(TreeValue::Integer((*v).into())))
        }),
        ColumnReader::Int64ColumnReader(reader) => add(reader, rows, most, into, |v| {
            Ok(Some(TreeValue::Integer(*v)))
        }),
        ColumnReader::BoolColumnReader(reader) => {
            add(reader, rows, most, into, |v| Ok(Some(TreeValue::Flag(*v))))
        }
        ColumnReader::ByteArrayColumnReader(reader) => {
            add(reader, rows, most, into, |v| text(v.data()))
        }
        ColumnReader::Int96ColumnReader(_) | ColumnReader::FixedLenByteArrayColumnReader(_) => {
            Err(ParquetError::General(
                "has a column of times or of bytes; inputs are numbers, texts or flags".into(),
            ))
        }
    }
}

/// Adds the cells of some rows, after so many that are passed over.
fn add<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    [skip, count]: [usize; 2],
    most: i16,
    into: &mut Vec<Option<TreeValue>>,
    value: impl Fn(&T::T) -> Result<Option<TreeValue>, ParquetError>,
) -> Result<(), ParquetError> {
    reader.skip_records(skip)?;
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    let mut left = count;
    while left > 0 {
        let (read, ..) = reader.read_records(left, Some(&mut levels), None, &mut values)?;
        if read == 0 {
            break;
        }
        left -= read;
    }
    let mut values = values.iter();
    for row in 0..count - left {
        let present = most == 0 || levels.get(row).copied().unwrap_or(0) == most;
        let cell = present.then(|| values.next()).flatten();
        into.push(cell.map(&value).transpose()?.flatten());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_csv_have_fields() {
        let list = |line: &str| fields(line, b',').expect("fields");
        assert_eq!(list("a, b ,\"c, \"\"d\"\"\","), ["a", "b", "c, \"d\"", ""]);
        assert_eq!(list("\"\""), [""]);
        assert!(fields("\"a", b',').is_err() && fields("\"a\" b", b',').is_err());
    }

    /// More rows than a block, in several row groups, texts with units, numbers and empty cells.
    #[test]
    fn cells_are_those_of_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("inventory.csv");
        let mut text = String::from("gap[0].width,motion.pga,note\n");
        for row in 0..10_000 {
            text += &format!("{row} mm,{},\n", 0.5 + f64::from(row));
        }
        std::fs::write(&path, &text).expect("a file");
        let table = Arc::new(InputTable::open(&path).expect("a table"));
        assert_eq!((table.rows(), table.names().len()), (10_000, 3));
        for row in [9_999, 0, 4_095, 4_096, 8_192] {
            let width = table.cell(row, 0).expect("a cell");
            assert_eq!(width, Some(TreeValue::Text(format!("{row} mm"))));
            let pga = table.cell(row, 1).expect("a cell");
            assert_eq!(pga, Some(TreeValue::Number(0.5 + row as f64)));
            assert_eq!(table.cell(row, 2).expect("a cell"), None);
        }
        assert!(table.is_numeric(0, Some(Dimension::Length)).expect("cells"));
        std::fs::write(&path, "gap[0].width\n1 mm\n").expect("a file");
        let changed = InputTable::open(&path).expect("a table");
        std::fs::write(&path, "gap[0].width\n").expect("a file");
        assert!(changed.cell(0, 0).is_err());
        for (text, problem) in [
            ("", "is empty"),
            ("a\n", "has no rows"),
            ("a,b\n1\n", "line 2: has 1 fields"),
            ("a,a\n1,2\n", "two columns"),
            ("a\n\"b\n", "line 2: a quote"),
        ] {
            std::fs::write(&path, text).expect("a file");
            let found = InputTable::open(&path).expect_err("a fault");
            assert!(found.contains(problem), "{found}");
        }
    }
}
