//! Model files: from text to a checked [`jostle::Model`] and its ground motion.
//!
//! Reading never stops at the first fault. A value that cannot be used is noted and replaced by a harmless one,
//! so that the rest is still read and checked; the result is thrown away if anything was noted.

mod analysis;
mod assumptions;
mod between;
mod brace;
mod buckling;
mod building;
mod capacity;
mod codes;
mod contact_law;
mod damper;
mod fibre_hinges;
mod floor_spectra;
mod frame;
mod frame_members;
mod frame_walls;
mod gap;
mod given;
mod given_in_plan;
mod given_modes;
mod grounds;
mod hinge_stiffness;
mod hinges;
mod infill;
mod isolation;
mod joint;
mod joint_capacity;
mod link;
mod matching;
pub(crate) mod motion;
mod out_of_plane;
mod output;
mod panel_struts;
mod partial;
mod places;
mod plan;
mod plan_frames;
mod reinforced;
mod report;
mod rigid_ends;
mod rotation_limits;
mod section;
mod section_hinges;
mod shear;
mod shear_failure;
mod site;
mod slab;
mod soil;
mod soil_spring;
mod space_frame;
mod space_hinges;
mod space_walls;
mod stated;
mod steel_profile;
mod surface_hinges;
#[cfg(test)]
mod tests;
mod unusual_results;
mod wall;
mod wall_fibres;

pub use capacity::CapacityRequest;
pub use floor_spectra::FloorSpectraRequest;
pub(crate) use matching::read_spectrum;
pub use reinforced::{KnownMembers, ProfiledMember, ReinforcedMember};
pub use report::TitleBlock;

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use jostle::judgement::Stated;
use jostle::separation::CodeInputs;
use jostle::{GroundMotion, LinkLaw, Model, ModelFault};
use jostle_motion::{GoverningRule, TargetSpectrum};
use jostle_section::capacity::CapacityRule;

use self::building::Buildings;
use self::damper::DamperPaths;
use crate::fault::InputError;
use crate::files::{FileError, Files, read_file};
use crate::keys::Section;
use crate::motion_spec::{BearingSpec, MatchTo, MotionError, MotionSource, MotionSpec, Scaling};
use crate::origin::{Origin, locate};
use crate::quantity::Dimension;
use crate::reader::{Field, Reader};
use crate::record::RecordOptions;
use crate::record_list;
use crate::shown::Units;
use crate::source::Source;
use crate::tree::{self, Format, Node, Value};
use crate::unusual::{Accepted, GAP, PEAK_ACCELERATION, Range, Verdict, Written, is_within};

/// A model file, read and checked.
#[derive(Clone, Debug)]
pub struct Input {
    /// The model.
    pub model: Model,
    /// The ground motion; `None` if the file has none.
    pub motion: Option<MotionSpec>,
    /// Members of frames whose strength the file states, building by building, columns first.
    pub members: KnownMembers,
    /// Spectra of floors that the file asks for; `None` if it asks for none.
    pub floor_spectra: Option<FloorSpectraRequest>,
    /// Rule for the governing value of several records, if the file names one.
    pub governing: Option<GoverningRule>,
    /// Inputs of the separation rules of codes.
    pub codes: CodeInputs,
    /// Angle from x to north, counter-clockwise; `None` if the file does not say \[rad\].
    pub north: Option<f64>,
    /// Rules for the capacity of these members.
    pub capacity: CapacityRequest,
    /// Units of texts and pages, if the file asks for some.
    pub units: Option<Units>,
    /// What stands in the title block of its report.
    pub title_block: TitleBlock,
    /// What checks need of the file beyond the model.
    pub stated: Stated,
    /// Warnings of a valid file.
    pub warnings: Vec<String>,
    /// Unusual values that are accepted.
    accepted: Accepted,
    files: Files,
    origin: Origin,
}

/// Changes of a model from the command line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Scale the motion to this peak, > 0 \[m/s²\].
    pub pga: Option<f64>,
    /// Width of every gap, ≥ 0; if contacts have separate widths, the smallest one; all others shift by the same
    /// amount \[m\].
    pub gap: Option<f64>,
    /// Another record: a built-in name, or a path from the current folder.
    pub record: Option<String>,
    /// Angle in plan from x to the motion, for buildings with plans \[rad\].
    pub angle: Option<f64>,
}

/// Why a change cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OverrideError {
    /// The peak is not positive.
    #[error("the peak ground acceleration must be greater than zero, found {0} m/s2")]
    Pga(f64),
    /// The width is negative.
    #[error("the gap must not be negative, found {0} m")]
    Gap(f64),
    /// A wrong unit.
    #[error("{problem}\n  help: {remedy}")]
    Unusual {
        /// The impossible value.
        problem: String,
        /// Remedy.
        remedy: String,
    },
    /// Nothing to widen or narrow.
    #[error("the model has no gap whose width could be changed")]
    NoGap,
    /// Nothing to scale.
    #[error("the model has no ground motion to scale; choose a record as well")]
    NoMotion,
}

/// Reads and checks the model file at a path. A name ending in `.json` is read as JSON, any other as TOML.
///
/// # Errors
/// All faults of the file at once.
pub fn read_model_file(path: &Path) -> Result<Input, InputError> {
    let (name, text) = read_text(path)?;
    let base = path.parent().unwrap_or(Path::new(""));
    read_model_text(&name, &text, Format::of_path(path), base)
}

/// The name and the text of a file, without a byte-order mark.
pub(crate) fn read_text(path: &Path) -> Result<(String, String), InputError> {
    let name = path.display().to_string();
    let bytes = read_file(path, tree::LARGEST_FILE).map_err(|error| match error {
        FileError::TooLarge { .. } => tree::too_large(&name),
        error => InputError::whole(&name, error.to_string(), None),
    })?;
    let text = tree::decode(&name, &bytes)?.to_owned();
    Ok((name, text))
}

/// Reads and checks the text of a model file. `name` is used in messages; `base` is the folder of records.
///
/// # Errors
/// All faults of the text at once.
pub fn read_model_text(
    name: &str,
    text: &str,
    format: Format,
    base: &Path,
) -> Result<Input, InputError> {
    let text = tree::decode(name, text.as_bytes())?;
    let source = Source::new(name, text);
    let root = tree::parse(&source, format)?;
    read_tree(Arc::new(source), root, &Files::beside(base))
}

/// Reads and checks a parsed model file.
pub(crate) fn read_tree(
    source: Arc<Source>,
    root: Node,
    files: &Files,
) -> Result<Input, InputError> {
    let mut reader = Reader::new(&source);
    let read = read_root(&mut reader, &root, files);
    if let Some(Parts { model, dampers, .. }) = &read {
        let mut checked = model.check().err().unwrap_or_default();
        for fault in &mut checked {
            dampers.rename(&mut fault.path);
            places::rename(&mut reader, &root, model, &mut fault.path);
        }
        add_model_faults(&mut reader, &root, checked);
    }
    let (mut noted, accepted) = (reader.take_warnings(), reader.accepted.clone());
    let error = reader.into_error();
    match read {
        Some(Parts {
            model,
            motion,
            members,
            capacity,
            codes,
            north,
            floor_spectra,
            governing,
            silenced,
            title_block,
            units,
            dampers: _,
        }) if error.faults.is_empty() => Ok(Input {
            capacity,
            codes,
            north,
            floor_spectra,
            governing,
            title_block,
            units,
            warnings: {
                noted.extend(warnings(&model, &root));
                noted
            },
            stated: Stated {
                records: motion
                    .as_ref()
                    .map_or(0, |motion| motion.records().len().max(1)),
                buildings: stated::of_buildings(&model, &root, &members.reinforced),
                silenced,
            },
            members,
            accepted,
            files: files.clone(),
            model,
            motion,
            origin: Origin { source, root },
        }),
        _ => Err(error),
    }
}

impl Input {
    /// Applies the changes of the command line.
    ///
    /// # Errors
    /// [`OverrideError`] if a value is out of range or there is nothing to change; then nothing is changed.
    pub fn apply(&mut self, overrides: &Overrides) -> Result<(), OverrideError> {
        let unusable = |value: f64| !value.is_finite() || value < 0.0;
        if let Some(pga) = overrides.pga.filter(|pga| unusable(*pga) || *pga == 0.0) {
            return Err(OverrideError::Pga(pga));
        }
        if let Some(gap) = overrides.gap.filter(|gap| unusable(*gap)) {
            return Err(OverrideError::Gap(gap));
        }
        if overrides.gap.is_some() && self.model.gaps.is_empty() {
            return Err(OverrideError::NoGap);
        }
        if overrides.pga.is_some() && overrides.record.is_none() && self.motion.is_none() {
            return Err(OverrideError::NoMotion);
        }
        let unusual = [
            self.judge("gap", &GAP, Dimension::Length, overrides.gap)?,
            self.judge(
                "motion.pga",
                &PEAK_ACCELERATION,
                Dimension::Acceleration,
                overrides.pga,
            )?,
        ];
        // Warnings about the replaced values.
        let other_motion = overrides.pga.is_some() || overrides.record.is_some();
        self.warnings.retain(|known| {
            let field = known.split_once(": ").map_or("", |(field, _)| field);
            let width = is_within(field, "gap") && field.contains(".width");
            !(overrides.gap.is_some() && width || other_motion && is_within(field, "motion"))
        });
        self.warnings.extend(unusual.into_iter().flatten());
        for gap in &mut self.model.gaps {
            if let Some(width) = overrides.gap {
                gap.set_width(width);
            }
        }
        if let Some(record) = &overrides.record {
            self.stated.records = 1;
            self.motion = Some(with_record(self.motion.as_ref(), record));
        }
        if let (Some(motion), Some(angle)) = (&mut self.motion, overrides.angle) {
            let across = motion.bearing.take().and_then(|bearing| bearing.across);
            motion.bearing = Some(Box::new(BearingSpec { angle, across }));
        }
        if let (Some(motion), Some(pga)) = (&mut self.motion, overrides.pga) {
            motion.scaling = Scaling::Pga(pga);
        }
        Ok(())
    }

    /// The warning about a value that is not from the file.
    fn judge(
        &self,
        path: &str,
        range: &Range,
        dimension: Dimension,
        value: Option<f64>,
    ) -> Result<Option<String>, OverrideError> {
        let Some(value) = value.filter(|_| !self.accepts(path)) else {
            return Ok(None);
        };
        match range.judge(value, dimension, Written::bare(value)) {
            Verdict::Usual => Ok(None),
            Verdict::Unusual(text) => Ok(Some(format!("{path}: {text}"))),
            Verdict::Refused(problem, remedy) => Err(OverrideError::Unusual { problem, remedy }),
        }
    }

    /// Whether unusual values of a field are accepted.
    pub(crate) fn accepts(&self, path: &str) -> bool {
        self.accepted.covers(path)
    }

    /// A warning about a field of the file, with the name of the file and the line before it; another text as it is.
    #[must_use]
    pub fn with_line(&self, warning: &str) -> String {
        let path = warning.split_once(": ").map_or("", |(path, _)| path);
        let is_path = !path.is_empty() && !path.contains(|c: char| c.is_whitespace() || c == '"');
        let (span, _) = locate(&self.origin.root, path);
        if !is_path || span == (0..0) {
            return warning.to_owned();
        }
        let source = &self.origin.source;
        format!("{}:{}: {warning}", source.name, source.place(&span).line)
    }

    /// Adds a warning about a field once, unless its unusual values are accepted.
    pub(crate) fn warn(&mut self, path: &str, text: &str) {
        let warning = format!("{path}: {text}");
        if !self.accepts(path) && !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }

    /// Asks for the greatest forces of all columns and beams, and for demands over capacities where these are known.
    pub fn ask_for_members(&mut self) {
        self.model.analysis.members.envelopes = true;
        capacity::fill(&mut self.model, &self.capacity, &self.members);
    }

    /// Sets the rules for capacities, the first of which governs, and asks for forces of members.
    pub fn ask_for_capacity(&mut self, rules: &[CapacityRule]) {
        self.capacity = CapacityRequest::Rules(rules.to_vec());
        self.ask_for_members();
    }

    /// The records that the file lists for a run to choose from; empty unless there are several.
    #[must_use]
    pub fn records(&self) -> &[String] {
        self.motion.as_ref().map_or(&[], MotionSpec::records)
    }

    /// The design spectrum that the motion is scaled to, and its damping ratio, if it is.
    #[must_use]
    pub fn target(&self) -> Option<(&TargetSpectrum, f64)> {
        let Scaling::Match(wanted) = &self.motion.as_ref()?.scaling else {
            return None;
        };
        match &wanted.to {
            MatchTo::Spectrum(target) => Some((target, wanted.damping)),
            MatchTo::Value(_) => None,
        }
    }

    /// One model for each of several records; the model itself if there are not several.
    #[must_use]
    pub fn each_record(&self) -> Vec<Self> {
        let one = |(index, name): (usize, &String)| {
            let mut one = self.clone();
            record_list::keep(&mut one.origin.root, index);
            one.motion = one
                .motion
                .and_then(|motion| motion.with_one_of_several(name));
            one
        };
        match self.records() {
            [] => vec![self.clone()],
            records => records.iter().enumerate().map(one).collect(),
        }
    }

    /// Replaces the ground motion. How grounds differ stays as the model says, unless the new motion says it.
    pub fn replace_motion(&mut self, motion: MotionSpec) {
        self.stated.records = 1;
        let old = self.motion.take().and_then(|old| old.grounds);
        self.motion = Some(MotionSpec {
            grounds: motion.grounds.clone().or(old),
            ..motion
        });
    }

    /// The ground motion in numbers.
    ///
    /// # Errors
    /// [`InputError`] at the line of the record when there is none, or it cannot be read or scaled.
    pub fn ground_motion(&self) -> Result<GroundMotion, InputError> {
        let resolved = match &self.motion {
            Some(motion) => motion.resolve(),
            None => Err(MotionError::None),
        };
        resolved.map_err(|error| {
            let (mut place, mut cause) = ("motion".to_owned(), &error);
            while let MotionError::Own { path, error } = cause {
                (place, cause) = (path.clone(), error);
            }
            let path = match cause {
                MotionError::None | MotionError::Own { .. } => "",
                MotionError::TooStrong { .. } | MotionError::Zero { .. } => ".pga",
                MotionError::Match { .. } => ".match",
                MotionError::NotFound { .. }
                | MotionError::Record { .. }
                | MotionError::NoRecord
                | MotionError::Several { .. } => ".record",
                MotionError::Drift { .. } | MotionError::Baseline { .. } => ".baseline",
                MotionError::Coherency { .. } => ".coherency",
            };
            let mut fault = self.fault(&format!("{place}{path}"), error.to_string());
            if let (MotionError::Drift { .. }, [fault]) = (&error, &mut fault.faults[..]) {
                fault.remedy = Some(
                    "add baseline = \"linear\" or \"quadratic\" under [motion] to correct them, or \"as-recorded\" to accept it".into(),
                );
            }
            if let (MotionError::Several { names }, [fault]) = (&error, &mut fault.faults[..]) {
                fault.remedy = Some(format!(
                    "choose one with --record {} (in Python motion={:?}); jostle run, jostle gap, a study and run_suite of Python take all of them",
                    names[0], names[0]
                ));
            }
            fault
        })
    }

    /// The text that was read.
    #[must_use]
    pub fn text(&self) -> &str {
        self.origin.source.text()
    }

    /// Files that the model turned out to name so far: those of its buildings once it is read, those of its ground motion
    /// once that is asked for.
    #[must_use]
    pub fn files(&self) -> Vec<String> {
        self.files.asked()
    }

    /// Faults that only assembly or planning shows, at their lines of the file.
    #[must_use]
    pub fn faults(&self, found: Vec<ModelFault>) -> InputError {
        let mut error = self.fault("", "the model is wrong");
        if !found.is_empty() {
            let placed = found.into_iter();
            error.faults = placed
                .flat_map(|fault| self.fault(&fault.path, fault.problem).faults)
                .collect();
        }
        error
    }

    /// Whether a table of the list at a path of the file has a key.
    #[must_use]
    pub fn states_in_list(&self, list: &str, key: &str) -> bool {
        let tables = match self.origin.at(list) {
            Some(Value::List(tables)) => &tables[..],
            _ => &[],
        };
        let mut tables = tables.iter();
        tables.any(|table| matches!(&table.value, Value::Table(table) if table.get(key).is_some()))
    }

    /// An error about a field that only came to light after reading: it shows the line of the file.
    #[must_use]
    pub fn fault(&self, path: &str, problem: impl Into<String>) -> InputError {
        self.origin.fault(path, problem)
    }
}

/// The motion of a model with its record replaced: the scaling stays, what described the old source goes. A record out
/// of a list of the model stays what it is there.
fn with_record(old: Option<&MotionSpec>, record: &str) -> MotionSpec {
    if let Some(chosen) = old.and_then(|old| old.with_one_of_several(record)) {
        return chosen;
    }
    let new = MotionSpec::record(record);
    match old {
        None => new,
        Some(old) => {
            let was_record = matches!(
                old.source,
                MotionSource::Record { .. } | MotionSource::Records { .. }
            );
            let MotionSource::Record { name, files, .. } = new.source else {
                return new;
            };
            MotionSpec {
                source: MotionSource::Record {
                    name,
                    files,
                    options: RecordOptions::default(),
                },
                duration: old.duration.filter(|_| was_record),
                // Factors belong to the records of the list.
                scaling: match &old.scaling {
                    Scaling::FactorOfEach(_) => Scaling::AsRecorded,
                    other => other.clone(),
                },
                ..old.clone()
            }
        }
    }
}

/// What a file describes.
struct Parts {
    model: Model,
    dampers: DamperPaths,
    motion: Option<MotionSpec>,
    members: KnownMembers,
    capacity: CapacityRequest,
    codes: CodeInputs,
    north: Option<f64>,
    floor_spectra: Option<FloorSpectraRequest>,
    governing: Option<GoverningRule>,
    silenced: Vec<&'static str>,
    title_block: TitleBlock,
    units: Option<Units>,
}

/// Reads the whole tree; `None` if there is nothing to build a model from.
fn read_root(reader: &mut Reader<'_>, root: &Node, files: &Files) -> Option<Parts> {
    let field = Field::root(root);
    let view = reader.open(&field, &[Section::Root])?;
    let analysis = reader.get(&view, "analysis");
    if let Some(field) = &analysis {
        reader.accepted = analysis::accepted(reader, field);
    }
    let title = match reader.get(&view, "title") {
        Some(field) => reader.text(&field),
        None => Some("Untitled".to_owned()),
    };
    let (mut motion, governing) = match reader.get(&view, "motion") {
        Some(field) => (
            motion::read(reader, &field, files),
            motion::governing(reader, &field),
        ),
        None => (None, None),
    };
    let buildings = match reader.get(&view, "building") {
        Some(field) => building::read_all(reader, &field, files),
        None => {
            reader.missing(
                &view,
                "building",
                "add a [[building]]; \"jostle new\" writes a commented example",
            );
            None
        }
    };
    let walls = match reader.get(&view, "wall") {
        Some(field) => wall::read_all(reader, &field).unwrap_or_default(),
        None => Vec::new(),
    };
    let gaps = match reader.get(&view, "gap") {
        Some(field) => {
            let buildings = buildings.as_ref().map(|read| &read.buildings[..]);
            gap::read_all(reader, &field, buildings, &walls)
        }
        None => Vec::new(),
    };
    let mut links = match reader.get(&view, "link") {
        Some(field) => {
            let buildings = buildings.as_ref().map(|read| &read.buildings[..]);
            link::read_all(reader, &field, buildings, &walls)
        }
        None => Vec::new(),
    };
    let soil = match reader.get(&view, "soil") {
        Some(field) => soil::read(reader, &field),
        None => None,
    };
    let mut analysis =
        analysis.map_or_else(Default::default, |field| analysis::read(reader, &field));
    let (mut capacity, mut floor_spectra) = (CapacityRequest::default(), None);
    let mut units = None;
    if let Some(field) = reader.get(&view, "output") {
        let read = buildings.as_ref();
        let read = read.map(|read| (&read.buildings[..], &read.members));
        (analysis.members, floor_spectra, capacity) = output::read(reader, &field, read);
        analysis.link_motion = output::link_motion(reader, &field);
        units = output::units(reader, &field);
        if let Some(interval) = output::interval(reader, &field) {
            analysis.row_interval = interval;
        }
    }
    let codes = reader.get(&view, "codes");
    let of_buildings = buildings.as_ref().map(|read| read.codes.clone());
    let codes = codes::read(reader, codes.as_ref(), of_buildings.unwrap_or_default());
    let report = reader.get(&view, "report");
    let (title_block, silenced) = report
        .map(|field| report::read(reader, &field))
        .unwrap_or_default();
    let north = reader.get(&view, "site").and_then(|field| {
        let in_plan =
            |building: &jostle::Building| matches!(building.structure, jostle::Structure::Tiers(_));
        let read = buildings.as_ref();
        let in_space = read.is_none_or(|read| read.buildings.iter().any(in_plan));
        site::read(reader, &field, in_space)
    });
    let Buildings {
        mut buildings,
        members,
        at,
        dampers,
        ..
    } = buildings?;
    let paths = DamperPaths::new(links.len(), &dampers);
    links.extend(dampers.into_iter().map(|damper| damper.link));
    let origins = plan::place(&mut buildings, &at, &gaps);
    for link in links.iter_mut().skip(paths.first()) {
        // Dampers stand in the plan of their building.
        if let ([Some(building), _], Some(ends)) = (link.between, &mut link.at) {
            let [x, y] = origins[building];
            *ends = ends.map(|at| [at[0] + x, at[1] + y]);
        }
    }
    let mut model = Model {
        title: title.unwrap_or_default(),
        buildings,
        gaps,
        links,
        walls,
        soil,
        analysis,
    };
    let fields = reader.get(&view, "gap").and_then(|field| field.entries());
    let fields = fields.unwrap_or_default();
    gap::check_doubles(reader, &fields, &model);
    if model.is_in_space() {
        gap::for_all_neighbours(reader, &fields, &at, &mut model);
        plan::check_widths(reader, &mut model, &fields);
    }
    grounds::read_own(reader, &view, &mut motion, &model, files);
    shear_failure::add_heads(&mut model, reader, &view);
    given_modes::soften_contacts(&mut model, reader, &view);
    capacity::fill(&mut model, &capacity, &members);
    Some(Parts {
        model,
        motion,
        members,
        capacity,
        codes,
        north,
        floor_spectra,
        governing,
        silenced,
        title_block,
        units,
        dampers: paths,
    })
}

/// Adds what the model's own check found, unless reading has found a fault there already.
fn add_model_faults(reader: &mut Reader<'_>, root: &Node, faults: Vec<ModelFault>) {
    let mut seen: BTreeSet<String> = reader.faults().map(|fault| fault.path.clone()).collect();
    let building_is_bad = seen.iter().any(|path| path.starts_with("building"));
    let foundation_is_bad = seen.iter().any(|path| path.contains("].foundation"));
    for fault in faults {
        let (span, path) = locate(root, &fault.path);
        // One value for all storeys gives one fault per storey.
        if seen.contains(&path) {
            continue;
        }
        // With a replaced value in a building, floor heights mean nothing.
        let follows = building_is_bad && path.contains(".floors")
            // A foundation with a fault is missing from the model.
            || foundation_is_bad && path == "soil";
        let known = seen
            .iter()
            .any(|other| is_within(&path, other) || is_within(other, &path));
        if !follows && !known {
            seen.insert(path.clone());
            reader.fault(&span, path, fault.problem);
        }
    }
}

/// Warnings about valid but unusual values.
fn warnings(model: &Model, root: &Node) -> Vec<String> {
    let mut warnings = Vec::new();
    let row = (1..model.buildings.len()).map(|right| [right - 1, right]);
    let apart: Vec<[usize; 2]> = if model.is_in_space() {
        gap::neighbours_without(model)
    } else {
        let has_gap = |left| model.gaps.iter().any(|gap| gap.between[0] == Some(left));
        row.filter(|[left, _]| !has_gap(*left)).collect()
    };
    // A spring between them keeps them apart.
    let is_kept = |pair: &[usize; 2]| {
        model.links.iter().any(|link| {
            let between = link.between.map(|side| side.unwrap_or(usize::MAX));
            let joins = between == *pair || between == [pair[1], pair[0]];
            joins && link.stiffness > 0.0 && matches!(link.law, LinkLaw::Linear)
        })
    };
    for [a, b] in apart.into_iter().filter(|pair| !is_kept(pair)) {
        warnings.push(format!(
            "there is no gap between \"{}\" and \"{}\": they pass through each other; add a [[gap]]",
            model.buildings[a].name, model.buildings[b].name
        ));
    }
    warnings.extend(partial::warnings(model));
    let listed = match &root.value {
        Value::Table(table) => table.get("building"),
        _ => None,
    };
    if let Some(Value::List(list)) = listed.map(|node| &node.value) {
        for (node, building) in list.iter().zip(&model.buildings) {
            let Value::Table(table) = &node.value else {
                continue;
            };
            let one_value = table
                .get("mass")
                .is_some_and(|mass| !matches!(mass.value, Value::List(_)));
            if one_value
                && building.floors() == 1
                && table.get("storeys").is_none()
                && table.get("floors").is_none()
            {
                warnings.push(format!(
                    "\"{}\" has one floor, because its mass is a single value; for more, add storeys or list the masses",
                    building.name
                ));
            }
            if table.get("storey_height").is_none() && table.get("ports").is_none() {
                warnings.push(format!(
                    "\"{}\" has no storey_height: storeys of {} m are assumed, for drifts and for floors at equal height",
                    building.name,
                    shear::DEFAULT_STOREY_HEIGHT
                ));
            }
        }
    }
    warnings
}
