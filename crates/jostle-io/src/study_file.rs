//! Study files: a base model, the keys that vary in it, and the evaluations of the results.

mod distribution;
mod factor;
mod selection;
mod table;
mod wanted;

use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use distribution::{Distribution, Shape};
pub use factor::{Factor, FactorValues, Level};
pub use selection::{SelectionScaling, SelectionWanted};
pub use table::{InputTable, TableColumn};
pub use wanted::{FragilityWanted, IdaWanted};

use crate::builtin_model;
pub use crate::choices::{DesignKind, FragilityMethod, Sampling};
use crate::fault::InputError;
use crate::files::Files;
use crate::keys::{DESIGNS, SAMPLINGS, Section};
use crate::model_file;
use crate::model_tree::ModelTree;
use crate::nearest::nearest;
use crate::origin::Origin;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};
use crate::source::Source;
use crate::tree::{self, Format, Node, Value};

/// A study file, read and checked as far as that is possible without its models.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// Title.
    pub title: String,
    /// The model in which something varies.
    pub base: ModelTree,
    /// Varied keys, in the order of the file; at least one.
    pub factors: Vec<Factor>,
    /// How cases are made of it.
    pub design: Design,
    /// Cases whose histories are kept, from 0.
    pub histories: Vec<u64>,
    /// Whether every case is also run without contact, and compared with that run.
    pub without_contact: bool,
    /// Fragility curves to fit.
    pub fragilities: Vec<FragilityWanted>,
    /// Curves of demand over intensity.
    pub idas: Vec<IdaWanted>,
    /// Columns whose sensitivity is wanted; empty leaves the choice to the study.
    pub responses: Vec<String>,
    /// Columns drawn over the angle of the motion; empty leaves the choice to the study.
    pub roses: Vec<String>,
    /// The code check of its records, if any.
    pub selection: Option<SelectionWanted>,
    /// The folder of the file, from where records are looked for.
    pub folder: PathBuf,
    /// Files that the study itself names, apart from its model.
    pub files: Files,
    origin: Origin,
}

/// How cases are made of what varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The rule.
    pub kind: DesignKind,
    /// Sampling of distributions if `kind` does not determine it.
    pub sampling: Sampling,
    /// Number of draws, of base samples or of trajectories; `None` where nothing is drawn.
    pub samples: Option<u64>,
    /// Random seed.
    pub seed: u64,
    /// Correlations of the normal scores (Gaussian copula).
    pub correlations: Vec<Correlation>,
    /// Quantiles of one-at-a-time designs, each between 0 and 1.
    pub quantiles: [f64; 2],
}

/// A correlation of the normal scores of two factors.
#[derive(Clone, Debug, PartialEq)]
pub struct Correlation {
    /// Indices of the factors.
    pub between: [usize; 2],
    /// −1 < value < 1 \[–\].
    pub value: f64,
}

/// Most cases of a study: their numbers are 32-bit in the tables.
const MOST_SAMPLES: u64 = 1 << 31;

impl StudyFile {
    /// Reads the study file at a path: JSON if its name ends in `.json`, else TOML. `base` replaces the base model
    /// of the file.
    ///
    /// # Errors
    /// All faults at once.
    pub fn load(path: &Path, base: Option<ModelTree>) -> Result<Self, InputError> {
        let (name, text) = model_file::read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&name, &text, Format::of_path(path), folder, base)
    }

    /// Reads the text of a study file. `name` stands in messages; paths start from `folder`.
    ///
    /// # Errors
    /// All faults at once.
    pub fn parse(
        name: &str,
        text: &str,
        format: Format,
        folder: &Path,
        base: Option<ModelTree>,
    ) -> Result<Self, InputError> {
        let text = tree::decode(name, text.as_bytes())?;
        let source = Arc::new(Source::new(name, text));
        let root = tree::parse(&source, format)?;
        let mut reader = Reader::new(&source);
        let files = Files::beside(folder);
        let read = read_root(&mut reader, &source, &root, &files, base);
        let error = reader.into_error();
        match read {
            Some(study) if error.faults.is_empty() => study,
            _ => Err(error),
        }
    }

    /// The text of a study file, without reading it as one.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn text_of(path: &Path) -> Result<String, InputError> {
        model_file::read_text(path).map(|(_, text)| text)
    }

    /// The text that was read.
    #[must_use]
    pub fn text(&self) -> &str {
        self.origin.source.text()
    }

    /// Name of the file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.origin.source.name
    }

    /// Whether the base model is written out in the file.
    #[must_use]
    pub fn has_own_model(&self) -> bool {
        self.base.is_of(&self.origin.source)
    }

    /// A fault at a factor of the file.
    #[must_use]
    pub fn fault(&self, factor: usize, problem: impl Into<String>) -> InputError {
        let path = match self.factors.get(factor) {
            Some(factor) => format!("vary[{}]", factor.entry),
            None => "vary".to_owned(),
        };
        let mut error = self.origin.fault(&path, problem);
        // At the value that varies rather than at its table.
        if let Some(factor) = self.factors.get(factor) {
            let place = self.origin.source.place(&factor.span);
            error
                .faults
                .iter_mut()
                .for_each(|fault| fault.place = Some(place.clone()));
        }
        error
    }

    /// A fault at a key of the file, such as `fragility[0].demand`.
    #[must_use]
    pub fn fault_at(&self, path: &str, problem: impl Into<String>) -> InputError {
        self.origin.fault(path, problem)
    }

    /// Shows faults caused by a value of a factor at that factor, and the others at their own positions.
    #[must_use]
    pub fn relocate(&self, factors: &[usize], error: InputError) -> InputError {
        let mut moved = error;
        let mut all_here = true;
        for fault in &mut moved.faults {
            let factor = factors.iter().find(|&&index| {
                let factor = &self.factors[index];
                let mut paths = factor.paths.iter();
                !factor.from_model && paths.any(|path| touches(path, &fault.path))
            });
            match factor {
                Some(&index) => {
                    fault.place = Some(self.origin.source.place(&self.factors[index].span));
                    fault.path = format!("vary[{}]: {}", self.factors[index].entry, fault.path);
                }
                None => all_here = false,
            }
        }
        if all_here {
            moved.name.clone_from(&self.origin.source.name);
        }
        moved
    }
}

/// Whether a fault at a field may be caused by a value set at a path: one path equals the other or lies below it.
fn touches(path: &str, field: &str) -> bool {
    let plain = |text: &str| -> Vec<String> {
        let pieces = text
            .split(['.', '['])
            .map(|part| part.trim_end_matches(']'));
        pieces.map(str::to_owned).collect()
    };
    let (path, field) = (plain(path), plain(field));
    let same = |a: &String, b: &String| {
        let index = |text: &String| text.parse::<usize>().is_ok();
        // A list entry may be called by its name.
        a == b || a == "*" || (index(b) && !index(a))
    };
    !field.is_empty() && path.iter().zip(&field).all(|(a, b)| same(a, b))
}

fn read_root(
    reader: &mut Reader<'_>,
    source: &Arc<Source>,
    root: &Node,
    files: &Files,
    base: Option<ModelTree>,
) -> Option<Result<StudyFile, InputError>> {
    let field = Field::root(root);
    let view = reader.open(&field, &[Section::Study])?;
    let title = match reader.get(&view, "title") {
        Some(field) => reader.text(&field),
        None => Some("Untitled study".to_owned()),
    };
    let folder = files.folder();
    let tree = base_model(reader, source, &view, files, base);
    let implied = tree.as_ref().and_then(|tree| tree.as_ref().ok());
    let implied = implied.and_then(factor::of_records);
    let factors = match (reader.get(&view, "vary"), &implied) {
        (Some(field), _) => factor::read_all(reader, &field, folder),
        (None, Some(_)) => Some(Vec::new()),
        // A base model that cannot be read may list records; its own error is reported.
        (None, None) if matches!(tree, Some(Err(_))) => Some(Vec::new()),
        (None, None) => {
            reader.missing(
                &view,
                "vary",
                "add a [[vary]] with path = \"gap[0].width\" and values = [\"20 mm\", \"40 mm\"]",
            );
            None
        }
    };
    let factors = factors.map(|mut factors: Vec<Factor>| {
        let chosen = factors.iter().any(Factor::chooses_motion);
        factors.extend(implied.filter(|_| !chosen));
        factors
    });
    let names: Vec<String> = factors
        .iter()
        .flatten()
        .map(|factor| factor.name.clone())
        .collect();
    let design = reader.get(&view, "design");
    let design = design_of(reader, design.as_ref(), factors.as_deref(), &names);
    let histories = reader.get(&view, "histories");
    let histories = histories.map_or(Some(Vec::new()), |field| case_numbers(reader, &field));
    let without_contact = reader.get(&view, "without_contact");
    let without_contact = without_contact.is_some_and(|field| reader.flag(&field) == Some(true));
    let fragilities = wanted::fragilities(reader, &view);
    let idas = wanted::idas(reader, &view);
    let responses = reader.get(&view, "sensitivity");
    let responses = responses.map_or(Some(Vec::new()), |field| {
        let view = reader.open(&field, &[Section::Sensitivity])?;
        let field = reader.get(&view, "responses")?;
        wanted::texts(reader, &field)
    });
    let roses = reader.get(&view, "rose");
    let roses = roses.and_then(|field| {
        let texts = wanted::texts(reader, &field)?;
        if !factors.iter().flatten().any(Factor::is_angle) {
            *reader.bad(&field, "needs an angle that varies") = Some(
                "add a [[vary]] with path = \"motion.angle\" and values = [\"0 deg\", \"30 deg\"]"
                    .into(),
            );
        }
        Some(texts)
    });
    let selection = reader.get(&view, "selection");
    let selection = selection.and_then(|field| selection::read(reader, &field, files));
    Some(tree?.map(|tree| StudyFile {
        title: title.unwrap_or_default(),
        base: tree,
        factors: factors.unwrap_or_default(),
        design: design.unwrap_or(Design {
            kind: DesignKind::Factorial,
            sampling: Sampling::LatinHypercube,
            samples: None,
            seed: 0,
            correlations: Vec::new(),
            quantiles: [0.1, 0.9],
        }),
        histories: histories.unwrap_or_default(),
        without_contact,
        fragilities,
        idas,
        responses: responses.unwrap_or_default(),
        roses: roses.unwrap_or_default(),
        selection,
        folder: folder.to_owned(),
        files: files.clone(),
        origin: Origin {
            source: Arc::clone(source),
            root: root.clone(),
        },
    }))
}

/// The model in which something varies: a path, a built-in name, or written out in the study.
fn base_model(
    reader: &mut Reader<'_>,
    source: &Arc<Source>,
    view: &View<'_>,
    files: &Files,
    other: Option<ModelTree>,
) -> Option<Result<ModelTree, InputError>> {
    let (base, model) = (reader.get(view, "base"), reader.get(view, "model"));
    if let (Some(base), Some(_)) = (&base, &model) {
        *reader.bad(base, "cannot be combined with model") =
            Some("keep either base or model".into());
        return None;
    }
    if let Some(tree) = other {
        return Some(Ok(tree));
    }
    if let Some(model) = model {
        if !matches!(model.node.value, Value::Table(_)) {
            let found = model.node.describe();
            reader.bad(
                &model,
                format!("expected a model written out, found {found}"),
            );
            return None;
        }
        return Some(Ok(ModelTree::new(
            Arc::clone(source),
            model.node.clone(),
            files.clone(),
        )));
    }
    let Some(base) = base else {
        reader.missing(
            view,
            "base",
            "add base = \"model.toml\", a path from this file, or the name of a built-in model",
        );
        return None;
    };
    let name = reader.text(&base)?;
    let path = files.folder().join(&name);
    if !path.exists() && !builtin_model::model_names().contains(&name.as_str()) {
        let remedy = nearest(&name, builtin_model::model_names().into_iter())
            .map(|name| format!("did you mean the built-in \"{name}\"?"));
        let problem = format!(
            "there is no file {}, and no built-in model of this name; built in: {}",
            path.display(),
            builtin_model::model_names().join(", ")
        );
        *reader.bad(&base, problem) = remedy;
        return None;
    }
    Some(if path.exists() {
        ModelTree::load(&path)
    } else {
        ModelTree::builtin(&name)
    })
}

fn design_of(
    reader: &mut Reader<'_>,
    field: Option<&Field<'_>>,
    factors: Option<&[Factor]>,
    names: &[String],
) -> Option<Design> {
    let drawn = factors.map(|factors| {
        factors
            .iter()
            .any(|factor| matches!(factor.values, FactorValues::Drawn(_)))
    });
    let mut design = Design {
        kind: DesignKind::Factorial,
        sampling: Sampling::LatinHypercube,
        samples: None,
        seed: 0,
        correlations: Vec::new(),
        quantiles: [0.1, 0.9],
    };
    let Some(field) = field else {
        if drawn == Some(true)
            && let Some(first) = factors.and_then(|factors| {
                factors
                    .iter()
                    .find(|factor| matches!(factor.values, FactorValues::Drawn(_)))
            })
        {
            *reader.fault(&first.span, "design", "is missing") = Some(
                "a distribution needs a [design] such as kind = \"latin-hypercube\", samples = 200, seed = 1".into(),
            );
            return None;
        }
        return Some(design);
    };
    let view = reader.open(field, &[Section::Design])?;
    if let Some(field) = reader.get(&view, "kind") {
        design.kind = DesignKind::from_name(reader.choice(&field, DESIGNS, &[])?)?;
    }
    if let Some(field) = reader.get(&view, "sampling") {
        design.sampling = Sampling::from_name(reader.choice(&field, SAMPLINGS, &[])?)?;
    }
    if let Some(field) = reader.get(&view, "samples") {
        let samples = reader.count(&field)? as u64;
        if !(1..=MOST_SAMPLES).contains(&samples) {
            reader.bad(&field, "must lie between 1 and 2^31");
            return None;
        }
        design.samples = Some(samples);
    }
    if let Some(field) = reader.get(&view, "seed") {
        design.seed = reader.count(&field)? as u64;
    }
    if let Some(field) = reader.get(&view, "quantiles") {
        design.quantiles = quantiles(reader, &field)?;
    }
    if let Some(field) = reader.get(&view, "correlation") {
        design.correlations = correlations(reader, &field, factors, names)?;
        if matches!(
            design.kind,
            DesignKind::Saltelli | DesignKind::Morris | DesignKind::OneAtATime
        ) {
            *reader.bad(&field, "does not go with this kind of design") = Some(
                "sensitivities are defined for independent factors; remove correlation".into(),
            );
        }
    }
    let needs_samples = match design.kind {
        DesignKind::Factorial | DesignKind::Zipped => drawn == Some(true),
        DesignKind::OneAtATime => false,
        _ => true,
    };
    if needs_samples && design.samples.is_none() {
        reader.missing(
            &view,
            "samples",
            "say how many are drawn: samples = 200 (base samples of saltelli, trajectories of morris)",
        );
    }
    if !needs_samples && let (Some(_), Some(field)) = (design.samples, reader.get(&view, "samples"))
    {
        *reader.bad(&field, "has no effect: nothing is drawn") = Some("remove it".into());
    }
    let of_table = |factor: &&Factor| matches!(factor.values, FactorValues::Table(_));
    if matches!(
        design.kind,
        DesignKind::Saltelli | DesignKind::Morris | DesignKind::OneAtATime
    ) && let Some(factor) = factors.and_then(|factors| factors.iter().find(of_table))
    {
        *reader.fault(
            &factor.span.clone(),
            "vary",
            "the rows of a table cannot be moved one by one",
        ) = Some("use the design factorial, zipped, random, latin-hypercube or sobol".into());
    }
    if design.kind == DesignKind::Zipped {
        zipped_lists_are_equal(reader, factors?);
    }
    Some(design)
}

fn zipped_lists_are_equal(reader: &mut Reader<'_>, factors: &[Factor]) {
    // Records of the model are crossed with what is zipped.
    let factors = factors.iter().filter(|factor| !factor.from_model);
    let lists = factors.filter_map(|factor| Some((factor, factor.values.count()?)));
    let mut first = None;
    for (factor, count) in lists {
        let expected = *first.get_or_insert(count);
        if count != expected {
            reader.fault(
                &factor.span.clone(),
                "vary",
                format!(
                    "\"{}\" has {count} values, the first list {expected}; zipped lists must be equally long",
                    factor.name
                ),
            );
        }
    }
}

fn quantiles(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<[f64; 2]> {
    let entries = field.entries().unwrap_or_default();
    let [low, high] = &entries[..] else {
        reader.bad(field, "expected two numbers such as [0.1, 0.9]");
        return None;
    };
    let low = reader.quantity(low, Dimension::Dimensionless)?;
    let high = reader.quantity(high, Dimension::Dimensionless)?;
    if !(0.0 < low && low < high && high < 1.0) {
        reader.bad(field, "expected two growing numbers between 0 and 1");
        return None;
    }
    Some([low, high])
}

fn correlations(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    factors: Option<&[Factor]>,
    names: &[String],
) -> Option<Vec<Correlation>> {
    let Some(entries) = field.entries() else {
        *reader.bad(field, "expected a list") =
            Some("write correlation = [{ between = [\"a\", \"b\"], value = 0.5 }]".into());
        return None;
    };
    let mut all = Vec::new();
    for entry in entries {
        let view = reader.open(&entry, &[Section::Correlation])?;
        let Some(between) = reader.get(&view, "between") else {
            reader.missing(
                &view,
                "between",
                "name two factors: between = [\"a\", \"b\"]",
            );
            continue;
        };
        let pair = wanted::texts(reader, &between)?;
        let found: Vec<Option<usize>> = pair
            .iter()
            .map(|name| names.iter().position(|known| known == name))
            .collect();
        let [Some(a), Some(b)] = found[..] else {
            reader.bad(
                &between,
                format!(
                    "expected the names of two factors; there are {}",
                    names.join(", ")
                ),
            );
            continue;
        };
        let drawn = |index: usize| {
            factors.is_some_and(|factors| matches!(factors[index].values, FactorValues::Drawn(_)))
        };
        if a == b || !drawn(a) || !drawn(b) {
            reader.bad(
                &between,
                "expected two different factors that have distributions",
            );
            continue;
        }
        let Some(value) = reader.get(&view, "value") else {
            reader.missing(&view, "value", "add value = 0.5");
            continue;
        };
        let number = reader.quantity(&value, Dimension::Dimensionless)?;
        if number.abs() >= 1.0 {
            reader.bad(&value, format!("must lie between −1 and 1, found {number}"));
            continue;
        }
        all.push(Correlation {
            between: [a, b],
            value: number,
        });
    }
    Some(all)
}

fn case_numbers(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<Vec<u64>> {
    let Some(entries) = field.entries() else {
        reader.bad(field, "expected a list of case numbers such as [0, 12]");
        return None;
    };
    entries
        .iter()
        .map(|entry| reader.count(entry).map(|number| number as u64))
        .collect()
}

/// The keys read from a study file.
#[cfg(test)]
pub(crate) fn keys_asked(
    source: &Source,
    root: &Node,
) -> std::collections::BTreeSet<(Section, &'static str)> {
    let mut reader = Reader::new(source);
    let source = Arc::new(source.clone());
    let _ = read_root(
        &mut reader,
        &source,
        root,
        &Files::beside(Path::new("")),
        None,
    );
    reader.asked
}
