//! Motions, spectra and quantities from arguments; files to write.

use std::path::Path;

use jostle_io::{
    Dimension, MotionSource, MotionSpec, RecordContent, RecordFormat, RecordLayout, TargetWords,
    parse_quantity, read_target_file,
};
use jostle_motion::{Accelerogram, MotionFault, TargetSpectrum};

use super::args::{RecordArgs, TargetArgs};
use crate::failure::Failure;
use crate::terminal;
use jostle_run::NamedMotion;

impl RecordArgs {
    pub(super) fn open(&self) -> Result<NamedMotion, Failure> {
        let mut spec = MotionSpec::record(&self.record);
        let step = self
            .step
            .as_deref()
            .map(|text| quantity("--step", text, Dimension::Time));
        let format = self.format.as_deref().map(|key| {
            RecordFormat::from_key(key).map_err(|error| Failure::Input(format!("--format{error}")))
        });
        if let MotionSource::Record { options, .. } = &mut spec.source {
            options.unit.clone_from(&self.unit);
            options.step = step.transpose()?;
            options.column = self.column;
            options.component.clone_from(&self.component);
            options.format = format.transpose()?;
            options.scale = self.record_scale;
            options.remove_mean = self.remove_mean.then_some(true);
            options.layout = self.layout();
        }
        NamedMotion::resolve(&spec).map_err(|problem| Failure::Input(as_options(&problem)))
    }
}

impl RecordArgs {
    fn layout(&self) -> RecordLayout {
        let content = match self.pairs {
            true => Some(RecordContent::Pairs),
            false => self.content.as_deref().and_then(RecordContent::from_key),
        };
        RecordLayout {
            skip: self.skip,
            last: self.last,
            per_line: self.per_line,
            content,
            widths: self.widths.clone(),
        }
    }
}

/// A motion by built-in name or path.
pub(super) fn open(name: &str) -> Result<NamedMotion, Failure> {
    NamedMotion::resolve(&MotionSpec::record(name)).map_err(|problem| {
        let asks = problem.contains(BESIDE);
        let problem = as_options(&problem);
        Failure::Input(if asks {
            format!("{problem}; give it to \"jostle motion convert {name} new.at2\" and use the new file")
        } else {
            problem
        })
    })
}

/// Keys of model files that complete a record.
const BESIDE: &str = " beside record";

/// A question about a record, with the keys of model files as the options of commands.
fn as_options(problem: &str) -> String {
    if !problem.contains(BESIDE) {
        return problem.to_owned();
    }
    let problem = tables_as_options(problem);
    let keys = [
        ("unit = \"", "--unit \""),
        ("step = \"", "--step \""),
        ("component = \"", "--component \""),
        ("column = ", "--column "),
        ("record_scale = ", "--record-scale "),
        ("remove_mean = true", "--remove-mean"),
        (BESIDE, ""),
    ];
    keys.iter()
        .fold(problem, |text, (key, option)| text.replace(key, option))
}

/// `read = { skip = 1, widths = [8, 9] }` as `--skip 1 --widths 8,9`.
fn tables_as_options(problem: &str) -> String {
    const TABLE: &str = "read = {";
    let mut text = String::new();
    let mut rest = problem;
    while let Some((before, table)) = rest.split_once(TABLE) {
        let Some((keys, after)) = table.split_once('}') else {
            break;
        };
        text.push_str(before);
        let keys = keys.replace(", ", ",").replace(['"', '[', ']'], "");
        let option = |key: &str| {
            let (key, value) = key.split_once('=').unwrap_or((key, ""));
            format!("--{} {}", key.trim().replace('_', "-"), value.trim())
        };
        // Commas between keys are followed by a name, those of widths by a number.
        let mut options: Vec<String> = Vec::new();
        for part in keys.split(',') {
            match (part.contains('='), options.last_mut()) {
                (false, Some(last)) => {
                    last.push(',');
                    last.push_str(part.trim());
                }
                _ => options.push(option(part)),
            }
        }
        text.push_str(&options.join(" "));
        rest = after;
    }
    text + rest
}

impl TargetArgs {
    pub(super) fn open(&self) -> Result<TargetSpectrum, Failure> {
        if let Some(path) = &self.target {
            let mut target = read_target_file(path).map_err(|e| Failure::Input(e.to_string()))?;
            if let Some(factor) = &self.factor {
                target.factor = quantity("--factor", factor, Dimension::Dimensionless)?;
            }
            return Ok(target);
        }
        let words = TargetWords {
            code: self.code.clone(),
            intensity: self.intensity.clone(),
            site: self.site.clone(),
            group: self.group.clone(),
            level: self.level.clone(),
            kind: self.kind.clone(),
            ground: self.ground.clone(),
            ag: self.ag.clone(),
            sds: self.sds.clone(),
            sd1: self.sd1.clone(),
            tl: self.tl.clone(),
            factor: self.factor.clone(),
        };
        words
            .target()
            .map_err(|error| Failure::Input(format!("--{error}")))
    }
}

/// A quantity of an option.
pub(super) fn quantity(option: &str, text: &str, dimension: Dimension) -> Result<f64, Failure> {
    parse_quantity(text, dimension).map_err(|error| Failure::Input(format!("{option}: {error}")))
}

/// Several of them.
pub(super) fn quantities(
    option: &str,
    texts: &[String],
    dimension: Dimension,
) -> Result<Vec<f64>, Failure> {
    texts
        .iter()
        .map(|text| quantity(option, text, dimension))
        .collect()
}

/// An error in the request.
pub(super) fn wrong(fault: MotionFault) -> Failure {
    Failure::Input(fault.to_string())
}

/// Writes a motion in the format of the file's extension.
pub(super) fn write(
    path: &Path,
    force: bool,
    name: &str,
    motion: &Accelerogram,
) -> Result<(), Failure> {
    if jostle_run::write_motion(path, force, name, motion)? {
        terminal::remark(&format!("replaced: {}", path.display()));
    }
    Ok(())
}
