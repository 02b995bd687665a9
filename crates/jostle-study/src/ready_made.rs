//! Ready-made studies: each is written for the model that it varies, around the values of the model.

mod angles;
mod brackets;
mod factors;

use std::path::Path;

use jostle::System;
use jostle_io::{Format, Input, InputError, ModelTree, StudyFile};

use crate::study::Study;
pub use angles::{Incidence, incidence};
use factors::{Block, Spread};

/// Names of the ready-made studies, and what their files begin with.
const STUDIES: [(&str, &str); 7] = [
    ("table2", TABLE2),
    ("gap-sweep", GAP_SWEEP),
    ("ida", IDA),
    ("fragility", FRAGILITY),
    ("sensitivity", SENSITIVITY),
    ("tornado", TORNADO),
    (ANGLES, ""),
];

/// Name of [`incidence`] among them.
const ANGLES: &str = "angles";

const TABLE2: &str = r#"# The grid of Zhang et al. (2019), Table 2: four peaks, and a range of gaps.
#
# The peaks are those of frequent and rare shaking at intensities 7 and 8 of GB 50011.
title = "Gap and shaking after Zhang et al. (2019)"
histories = [31]                # 220 cm/s2, 30 mm; under El Centro, if no record is given
"#;
const GAP_SWEEP: &str = r#"# How force and number of impacts fall with the gap.
title = "Gap sweep"
"#;
const IDA: &str = r#"# Incremental dynamic analysis: the same motions, stronger and stronger.
title = "Incremental dynamic analysis"

[[ida]]
intensity = "pga_m_s2"
demand = "closing_peak_m"

[[ida]]
intensity = "pga_m_s2"
demand = "peak_force_n"
"#;
const FRAGILITY: &str = r#"# Probability of pounding against peak acceleration, with uncertain stiffness and damping.
title = "Fragility of pounding"

[design]
kind = "factorial"
samples = 10
sampling = "latin-hypercube"
seed = 1940
"#;
const SENSITIVITY: &str = r#"# Which inputs matter for the force and the closing: Sobol indices. kind = "morris" asks the same at less cost.
title = "Sensitivity of pounding"

[design]
kind = "saltelli"
samples = 64
seed = 7
"#;
const TORNADO: &str = r#"# Every input by itself, low and high, the others as in the model.
title = "Tornado"

[design]
kind = "one-at-a-time"
"#;

/// Records of the built-in example.
const RECORDS: &str = "values = [\"el-centro-1940-ns\", \"nanjing-artificial\"]";

/// Peaks and gaps of Zhang et al. (2019).
const PUBLISHED_PEAKS: &str = r#"values = ["35 cm/s2", "70 cm/s2", "220 cm/s2", "400 cm/s2"]"#;
const PUBLISHED_GAPS: &str = r#"values = ["2 mm", "5 mm", "10 mm", "15 mm", "20 mm", "30 mm", "40 mm", "60 mm", "80 mm", "100 mm", "150 mm", "220 mm", "300 mm"]"#;

/// Multiples of the gaps of the model in the study of fragility.
const HALF_TO_TWICE: [f64; 3] = [0.5, 1.0, 2.0];

/// Names of the ready-made studies.
#[must_use]
pub fn ready_made_names() -> Vec<&'static str> {
    STUDIES.iter().map(|(name, _)| *name).collect()
}

/// A ready-made study of a model, and what it leaves out and why, in sentences.
///
/// Every factor multiplies what the model has, or is a list around it; the records of the model stay. Without a model
/// the study is one of the built-in example under two records.
///
/// # Errors
/// If the study name is unknown, or the model is wrong or has no gap.
pub fn ready_made(
    name: &str,
    base: Option<ModelTree>,
) -> Result<(StudyFile, Vec<String>), InputError> {
    let given = base.is_some();
    let tree = match base {
        Some(tree) => tree,
        None => ModelTree::builtin("paper")?,
    };
    if name == ANGLES {
        return incidence(tree, &Incidence::default());
    }
    let input = tree.input()?;
    System::assemble(&input.model).map_err(|faults| input.faults(faults))?;
    let known = STUDIES.iter().find(|(known, _)| *known == name);
    let Some((_, head)) = known else {
        let problem = format!(
            "there is no ready-made study {name}; there are {}",
            ready_made_names().join(", ")
        );
        return Err(input.fault("", problem));
    };
    if input.model.gaps.is_empty() {
        let problem = format!("the study {name} is about pounding, and the model has no gap");
        return Err(input.fault("gap", problem));
    }
    let mut notes = Vec::new();
    let mut blocks: Vec<Block> = Vec::new();
    if !given && matches!(name, "table2" | "ida" | "fragility") {
        blocks.push(Block::plain("record", "motion.record", RECORDS));
    }
    if given && name == "table2" {
        let problem = "motion.pga and gap[*].width take the values of the published grid, in place of those of the model";
        notes.push(problem.to_owned());
    }
    blocks.extend(wanted(name, &tree, &input, &mut notes));
    let mut kept = Vec::new();
    for block in blocks {
        match refusal(&block, &tree) {
            None => kept.push(block),
            Some(reason) => notes.push(format!("{} is not varied: {reason}", block.name)),
        }
    }
    if name == "gap-sweep" && !kept.iter().any(|block| block.name == "gap") {
        let reason = notes.iter().find(|note| note.starts_with("gap"));
        let reason = reason.map_or_else(String::new, |note| format!(": {note}"));
        let problem = format!(
            "the study gap-sweep varies the gap, and cannot here{reason}; jostle gap computes the force over the gap, and a study file can vary at, such as path = \"building[1].at[0]\""
        );
        return Err(input.fault("gap", problem));
    }
    let mut text = (*head).to_owned();
    for note in &notes {
        text += &format!("# {}\n", note.replace('\n', " "));
    }
    if name == "fragility" {
        text += &fragilities(kept.iter().any(|block| block.name == "gap"));
    }
    for block in &kept {
        text += &block.text();
    }
    let file = StudyFile::parse(name, &text, Format::Toml, Path::new(""), Some(tree))?;
    Ok((file, notes))
}

/// Keys that a study would vary in a model.
fn wanted(name: &str, tree: &ModelTree, input: &Input, notes: &mut Vec<String>) -> Vec<Block> {
    let multiples = |from: f64, step: f64, count: u32| -> Vec<f64> {
        (0..count).map(|k| from + step * f64::from(k)).collect()
    };
    match name {
        "table2" => vec![
            Block::plain("pga", "motion.pga", PUBLISHED_PEAKS),
            Block::plain("gap", "gap[*].width", PUBLISHED_GAPS),
        ],
        "gap-sweep" => {
            // Four values for every doubling, from an eighth of the gap to four times the gap.
            let widths: Vec<f64> = (-12..=8)
                .map(|k| libm::pow(2_f64, 0.25 * f64::from(k)))
                .collect();
            [
                factors::shaking(tree, input, &[0.5, 1.0, 2.0], notes),
                factors::widths(input, &widths, notes),
            ]
            .into_iter()
            .flatten()
            .collect()
        }
        "ida" => {
            let reverse = Block::plain("reverse", "motion.reverse", "values = [false, true]");
            let shaking = factors::shaking(tree, input, &multiples(0.1, 0.1, 20), notes);
            std::iter::once(reverse).chain(shaking).collect()
        }
        "fragility" => {
            let mut blocks: Vec<Block> = [
                factors::widths(input, &HALF_TO_TWICE, notes),
                factors::shaking(
                    tree,
                    input,
                    &brackets::shaking(input, &HALF_TO_TWICE),
                    notes,
                ),
            ]
            .into_iter()
            .flatten()
            .collect();
            blocks.extend(factors::stiffness(tree, input, notes));
            blocks.extend(factors::damping(tree, input));
            blocks
        }
        "sensitivity" | "tornado" => {
            let mut blocks = factors::gap_widths(input, Spread::Uniform(0.5), notes);
            blocks.extend(factors::contacts(tree, input, notes));
            blocks.extend(factors::stiffness(tree, input, notes));
            blocks.extend(factors::masses(tree, input));
            blocks.extend(factors::damping(tree, input));
            blocks
        }
        _ => Vec::new(),
    }
}

fn fragilities(by_gap: bool) -> String {
    let by = if by_gap { "by = [\"gap\"]\n" } else { "" };
    format!(
        "\n[[fragility]]\nintensity = \"pga_m_s2\"\n{by}\n[[fragility]]\nintensity = \"pga_m_s2\"\ndemand = \"peak_force_n\"\nthreshold = \"1 MN\"\n{by}"
    )
}

/// Why a model does not take the values of a block; `None` if it takes them.
fn refusal(block: &Block, tree: &ModelTree) -> Option<String> {
    let text = format!("[design]\nkind = \"random\"\nsamples = 1\n{}", block.text());
    let file = StudyFile::parse(
        "study",
        &text,
        Format::Toml,
        Path::new(""),
        Some(tree.clone()),
    );
    let problems = |error: &InputError| {
        let faults = error.faults.iter().map(|fault| fault.problem.clone());
        faults.collect::<Vec<_>>().join("; ")
    };
    match file.map(Study::new) {
        Ok(Ok(_)) => None,
        Ok(Err(crate::StudyError::Input(errors))) => errors.first().map(problems),
        Ok(Err(error)) => Some(error.to_string()),
        Err(error) => Some(problems(&error)),
    }
}
