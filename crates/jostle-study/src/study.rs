//! A study ready to be run: file, cases, columns.

use jostle::{Settings, Summary};
use jostle_io::{Factor, FactorValues, InputError, ModelTree, PathError, StudyFile};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::io::Read;
use std::ops::ControlFlow;
use std::path::Path;

use crate::design::{CaseDesign, Choice, DesignError, value_of};
use crate::layout::{Layout, Named};
use crate::measures::measures;
use crate::verified::Verified;
use jostle_run::{CaseCache, CaseError, Prepared};

/// A study ready to be run.
pub struct Study {
    /// Its file.
    pub file: StudyFile,
    /// Its cases.
    pub design: CaseDesign,
    /// The columns of its table.
    pub layout: Layout,
    /// Cases in one part of the table.
    pub part_cases: u64,
    /// Identity of this study: file, model, records, version.
    pub fingerprint: String,
    /// Hash of the base model.
    pub model_hash: String,
    /// Things the user should know.
    pub warnings: Vec<String>,
    /// Whether a folder is continued that another build of jostle began.
    pub any_build: bool,
    pub(crate) verified: Verified,
}

/// Why a study cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The study file or its model is wrong.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Input(Vec<InputError>),
    /// The design makes no cases.
    #[error("design: {0}")]
    Design(#[from] DesignError),
    /// A folder holds something else.
    #[error("{0}")]
    Folder(String),
    /// Results could not be written or read; what is finished stays.
    #[error("{0}; what is finished stays, and the same command goes on from there")]
    Output(String),
    /// A column that is asked for does not exist.
    #[error("{0}")]
    Column(String),
}

impl From<InputError> for StudyError {
    fn from(error: InputError) -> Self {
        Self::Input(vec![error])
    }
}

impl From<jostle_io::OutputError> for StudyError {
    fn from(error: jostle_io::OutputError) -> Self {
        Self::Output(error.to_string())
    }
}

/// Largest file of a model \[bytes\].
const LARGEST_FILE: usize = 256 << 20;
/// Entries of lists that are tried before the study begins.
const MOST_TRIED: usize = 500;
/// Rows of a column of a table that are tried.
const MOST_ROWS_TRIED: usize = 50;
/// Combinations of lists that change the columns.
const MOST_COMBINED: usize = 4000;
/// Parts of a study, if it is large enough for them.
const PARTS: u64 = 256;
/// Cases of a part.
const PART: std::ops::RangeInclusive<u64> = 16..=4096;

impl Study {
    /// Checks a study against its models: every entry of a list is tried by itself, and distributions low, in the
    /// middle and high.
    ///
    /// # Errors
    /// [`StudyError`] with all faults at once.
    pub fn new(file: StudyFile) -> Result<Self, StudyError> {
        let design = CaseDesign::new(&file)?;
        let case_cache = CaseCache::default();
        let trial = Trial::new(&file, &case_cache)?;
        let layout = Layout::new(&file, &trial.results);
        let (fingerprint, model_hash) = hashes(&file);
        let part_cases = design
            .cases
            .div_ceil(PARTS)
            .clamp(*PART.start(), *PART.end());
        let study = Self {
            design,
            layout,
            part_cases,
            fingerprint,
            model_hash,
            warnings: trial.warnings,
            any_build: false,
            verified: Verified::default(),
            file,
        };
        study.check_wishes()?;
        study.check_selection()?;
        Ok(study)
    }

    /// Number of parts of the table.
    #[must_use]
    pub fn parts(&self) -> u64 {
        self.design.cases.div_ceil(self.part_cases)
    }

    /// The cases of a part.
    #[must_use]
    pub fn part(&self, part: u64) -> std::ops::Range<u64> {
        let first = part * self.part_cases;
        first..(first + self.part_cases).min(self.design.cases)
    }

    /// The model file of a case.
    ///
    /// # Errors
    /// [`PathError`].
    pub fn tree(&self, choices: &[Choice]) -> Result<ModelTree, PathError> {
        tree(&self.file, choices)
    }

    /// The middle of every distribution and the first of every list.
    pub(crate) fn usual_choices(&self) -> Vec<Choice> {
        usual(&self.file)
    }

    /// Names in the evaluations of the file that are not columns.
    fn check_wishes(&self) -> Result<(), StudyError> {
        let names = self.layout.names();
        let missing = |path: &str, wanted: &str| -> Result<(), StudyError> {
            if names.contains(&wanted) {
                return Ok(());
            }
            let near: Vec<&str> = names
                .iter()
                .copied()
                .filter(|name| name.contains(wanted) || wanted.contains(name))
                .take(8)
                .collect();
            let hint = if near.is_empty() {
                String::new()
            } else {
                format!("; similar: {}", near.join(", "))
            };
            let problem = format!(
                "there is no column \"{wanted}\"{hint}; all columns: {}",
                names.join(", ")
            );
            Err(self.file.fault_at(path, problem).into())
        };
        for (index, wanted) in self.file.fragilities.iter().enumerate() {
            let path = format!("fragility[{index}]");
            missing(&format!("{path}.intensity"), &wanted.intensity)?;
            missing(&format!("{path}.demand"), &wanted.demand)?;
            for name in &wanted.by {
                self.input_column(name)?;
            }
        }
        for (index, wanted) in self.file.idas.iter().enumerate() {
            let path = format!("ida[{index}]");
            missing(&format!("{path}.intensity"), &wanted.intensity)?;
            missing(&format!("{path}.demand"), &wanted.demand)?;
        }
        for name in &self.file.responses {
            missing("sensitivity.responses", name)?;
        }
        for name in &self.file.roses {
            missing("rose", name)?;
        }
        if let Some(case) = self
            .file
            .histories
            .iter()
            .find(|case| **case >= self.design.cases)
        {
            let problem = format!(
                "there is no case {case}; there are {}, counted from 0",
                self.design.cases
            );
            return Err(self.file.fault_at("histories", problem).into());
        }
        Ok(())
    }

    /// The column of a factor, by the name of the factor or of the column.
    ///
    /// # Errors
    /// [`StudyError::Column`].
    pub fn input_column(&self, name: &str) -> Result<usize, StudyError> {
        let factors = self.file.factors.iter().zip(&self.layout.inputs);
        let found = factors
            .enumerate()
            .find(|(_, (factor, column))| factor.name == name || column.name == name);
        found.map(|(index, _)| index).ok_or_else(|| {
            let names: Vec<&str> = self.file.factors.iter().map(|f| &f.name[..]).collect();
            StudyError::Column(format!(
                "{}: there is no factor \"{name}\"; there are {}",
                self.file.name(),
                names.join(", ")
            ))
        })
    }
}

/// The model file with the values of a case.
fn tree(file: &StudyFile, choices: &[Choice]) -> Result<ModelTree, PathError> {
    let mut tree = file.base.clone();
    for (factor, choice) in file.factors.iter().zip(choices) {
        put(&mut tree, factor, choice)?;
    }
    Ok(tree)
}

/// Puts the value of a factor into a model file.
fn put(tree: &mut ModelTree, factor: &Factor, choice: &Choice) -> Result<(), PathError> {
    if let (true, Choice::Listed(index)) = (factor.from_model, choice) {
        tree.keep_record(*index);
        return Ok(());
    }
    if let (FactorValues::Table(column), Choice::Listed(row)) = (&factor.values, choice) {
        let cell = column.level(*row);
        return match cell.map_err(|problem| PathError::new(&factor.paths[0], problem))? {
            // An empty cell keeps the value of the model.
            None => Ok(()),
            Some(level) => factor
                .paths
                .iter()
                .try_for_each(|path| tree.set(path, &level.value)),
        };
    }
    let (value, number, _) = value_of(factor, choice);
    for path in &factor.paths {
        if factor.multiplies {
            tree.multiply(path, number.unwrap_or(1.0))?;
        } else {
            tree.set(path, &value)?;
        }
    }
    Ok(())
}

/// Result of checking the entries of the lists.
struct Trial {
    results: Vec<Vec<Named>>,
    warnings: Vec<String>,
}

impl Trial {
    fn new(file: &StudyFile, case_cache: &CaseCache) -> Result<Self, StudyError> {
        let usual = usual(file);
        // A path that leads nowhere is the fault of its factor alone, although no case can be read with it.
        let astray = file.factors.iter().zip(&usual).enumerate();
        let astray = astray.filter_map(|(index, (factor, choice))| {
            let mut tree = file.base.clone();
            let error = put(&mut tree, factor, choice).err()?;
            Some(file.fault(index, error.to_string()))
        });
        let mut errors: Vec<InputError> = astray.collect();
        if !errors.is_empty() {
            return Err(StudyError::Input(errors));
        }
        let mut first: Option<(Vec<Named>, Vec<String>)> = None;
        let mut results: Vec<Vec<Named>> = Vec::new();
        // Factors whose values change the columns, and the values that do.
        let mut shaping: Vec<(usize, Vec<Choice>)> = Vec::new();
        for (index, factor) in file.factors.iter().enumerate() {
            let mut shaping_choices: Vec<Choice> = Vec::new();
            for choice in tried(factor) {
                let mut choices = usual.clone();
                choices[index] = choice.clone();
                match columns(file, case_cache, &choices) {
                    Ok((list, warnings)) => {
                        let names = |list: &[Named]| -> Vec<String> {
                            list.iter().map(|named| named.name.clone()).collect()
                        };
                        let differs = first
                            .as_ref()
                            .is_some_and(|(known, _)| names(known) != names(&list));
                        if differs && !results.iter().any(|known| names(known) == names(&list)) {
                            results.push(list.clone());
                        }
                        if differs {
                            shaping_choices.push(choice);
                        }
                        first.get_or_insert((list, warnings));
                    }
                    Err(CaseError::Path(error)) => {
                        errors.push(file.fault(index, error.to_string()));
                        break;
                    }
                    Err(CaseError::Input(error)) => {
                        // Another factor may be at fault with its usual value.
                        let others = (0..file.factors.len()).filter(|other| *other != index);
                        let all: Vec<usize> = std::iter::once(index).chain(others).collect();
                        let mut error = file.relocate(&all, error);
                        if matches!(factor.values, FactorValues::Drawn(_)) {
                            let text = format!("vary[{}]:", factor.entry);
                            let faults = error.faults.iter_mut();
                            for fault in faults.filter(|fault| fault.path.starts_with(&text)) {
                                fault.remedy.get_or_insert_with(|| {
                                    "set low or high, so that nothing impossible is drawn".into()
                                });
                            }
                        }
                        if !errors.contains(&error) {
                            errors.push(error);
                        }
                    }
                }
            }
            if !shaping_choices.is_empty() {
                shaping_choices.push(usual[index].clone());
                shaping.push((index, shaping_choices));
            }
        }
        if !errors.is_empty() {
            // The same fault of the model comes with every entry.
            let mut seen: Vec<String> = Vec::new();
            errors.retain(|error| {
                let text = error.to_string();
                let new = !seen.contains(&text);
                seen.push(text);
                new
            });
            errors.truncate(20);
            return Err(StudyError::Input(errors));
        }
        let (list, warnings) = first.unwrap_or_default();
        results.insert(0, list);
        if shaping.len() > 1 {
            combine(file, case_cache, &usual, &shaping, &mut results);
        }
        Ok(Self { results, warnings })
    }
}

/// Columns that only show when several factors change together.
fn combine(
    file: &StudyFile,
    case_cache: &CaseCache,
    usual: &[Choice],
    shaping: &[(usize, Vec<Choice>)],
    results: &mut Vec<Vec<Named>>,
) {
    let total: usize = shaping.iter().map(|(_, values)| values.len()).product();
    for number in 0..total.min(MOST_COMBINED) {
        let (mut choices, mut rest) = (usual.to_vec(), number);
        for (index, values) in shaping {
            choices[*index] = values[rest % values.len()].clone();
            rest /= values.len();
        }
        // A case that cannot be assembled becomes a row with its reason.
        if let Ok((list, _)) = columns(file, case_cache, &choices) {
            let same = |known: &Vec<Named>| {
                known.len() == list.len() && known.iter().zip(&list).all(|(a, b)| a.name == b.name)
            };
            if !results.iter().any(same) {
                results.push(list);
            }
        }
    }
}

/// The middle of every distribution and the first of every list.
fn usual(file: &StudyFile) -> Vec<Choice> {
    let factors = file.factors.iter();
    factors.map(|factor| at(factor, 0.5, 0)).collect()
}

/// A value of a factor: a quantile, or an entry of its list.
fn at(factor: &Factor, p: f64, entry: usize) -> Choice {
    match &factor.values {
        FactorValues::Listed(_) | FactorValues::Table(_) => Choice::Listed(entry),
        FactorValues::Drawn(distribution) => {
            Choice::Drawn(crate::sampling::quantile(distribution, p))
        }
    }
}

/// The values of a factor to try.
fn tried(factor: &Factor) -> Vec<Choice> {
    match &factor.values {
        FactorValues::Listed(levels) => some_of(levels.len(), MOST_TRIED),
        // Columns of one table are many, and each row needs a model.
        FactorValues::Table(column) => some_of(column.table.rows() as usize, MOST_ROWS_TRIED),
        FactorValues::Drawn(_) => [0.5, 0.02, 0.98].map(|p| at(factor, p, 0)).to_vec(),
    }
}

/// At most about so many entries of a list, the first and the last among them.
fn some_of(count: usize, most: usize) -> Vec<Choice> {
    let step = count.div_ceil(most).max(1);
    let last = count - 1;
    let mut entries: Vec<usize> = (0..count).step_by(step).collect();
    if entries.last() != Some(&last) {
        entries.push(last);
    }
    entries.into_iter().map(Choice::Listed).collect()
}

/// The results that a case would have, without running it: a run of no length has them all.
fn columns(
    file: &StudyFile,
    case_cache: &CaseCache,
    choices: &[Choice],
) -> Result<(Vec<Named>, Vec<String>), CaseError> {
    let input = tree(file, choices)?.input()?;
    let mut prepared = case_cache.assemble(input)?;
    let summary = at_rest(&mut prepared);
    let list = measures(&summary, &prepared.motion, file.without_contact);
    Ok((list, prepared.input.warnings.clone()))
}

/// The summary of a case before its motion begins.
pub(crate) fn at_rest(prepared: &mut Prepared) -> Summary {
    prepared.motion.duration = 0.0;
    let settings = Settings {
        record_interval: None,
        ..Settings::default()
    };
    let outcome = prepared.step(settings, |_| ControlFlow::Continue(()));
    prepared.summary(&outcome, None, 0.0)
}

/// Identity of studies, and the hash of the base model. Files belong to it by their contents: those that the reader of
/// the study and of its model was asked for when every value was tried.
fn hashes(file: &StudyFile) -> (String, String) {
    let model = hex(&Sha256::digest(file.base.text().as_bytes()));
    let mut all = Sha256::new();
    for text in [env!("CARGO_PKG_VERSION"), file.text(), &model] {
        all.update((text.len() as u64).to_le_bytes());
        all.update(text.as_bytes());
    }
    ask_for_the_rest(file);
    for files in [&file.files, file.base.files()] {
        for name in files.asked() {
            // A file that is not there is a fault elsewhere.
            if let Ok(bytes) = files.read(&name, LARGEST_FILE) {
                all.update(Sha256::digest(&bytes));
            }
        }
    }
    let mut tables: Vec<&Path> = Vec::new();
    for factor in &file.factors {
        if let FactorValues::Table(column) = &factor.values
            && !tables.contains(&column.table.path())
        {
            tables.push(column.table.path());
            all.update(digest_of(column.table.path()));
        }
    }
    (hex(&all.finalize()), model)
}

/// Digest of a file of any size; that of nothing if it is gone, which is a fault elsewhere.
fn digest_of(path: &Path) -> [u8; 32] {
    let mut digest = Sha256::new();
    if let Ok(mut file) = jostle_io::open_file(path) {
        let mut piece = vec![0; 1 << 16];
        while let Ok(count @ 1..) = file.read(&mut piece) {
            digest.update(&piece[..count]);
        }
    }
    digest.finalize().into()
}

/// Reads the model with every text of a list that was too long for a trial of all its entries: such a text may name a
/// file.
fn ask_for_the_rest(file: &StudyFile) {
    let usual = usual(file);
    for (index, factor) in file.factors.iter().enumerate() {
        let FactorValues::Listed(levels) = &factor.values else {
            continue;
        };
        if levels.len() <= MOST_TRIED {
            continue;
        }
        let named = levels.iter().enumerate();
        let named = named.filter(|(_, level)| level.number.is_none());
        for (entry, _) in named {
            let mut choices = usual.clone();
            choices[index] = Choice::Listed(entry);
            // Its faults become rows of the table.
            let read = tree(file, &choices).ok().and_then(|tree| tree.input().ok());
            let _ = read.map(|input| input.ground_motion());
        }
    }
}

/// Bytes as lower-case digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}
