//! Exported scripts, read back as tables.

use jostle::linear::SparseSymmetric;
use jostle::{ModelFault, System};
use jostle_export::{Export, Exported, openseespy};
use jostle_io::Input;
pub(crate) use jostle_testkit::files::sound as model;

pub(crate) fn export(input: &Input) -> Result<Exported, Vec<ModelFault>> {
    let system = System::assemble(&input.model).expect("a sound model");
    openseespy::export(&Export {
        model: &input.model,
        system: &system,
        motion: &input.ground_motion().expect("a motion"),
    })
}

/// Rows of a table, cut at commas, without brackets.
#[allow(dead_code, reason = "not every test needs cells without brackets")]
pub(crate) fn table(text: &str, name: &str) -> Vec<Vec<String>> {
    let start = text
        .find(&format!("\n{name} = ["))
        .expect("the table is there");
    text[start + 1..]
        .lines()
        .skip(1)
        .take_while(|line| line.starts_with("    "))
        .filter(|line| !line.trim_start().starts_with('#'))
        .map(|line| {
            let plain = line.replace(['(', ')'], "");
            let row = plain.trim().trim_end_matches(',');
            row.split(',').map(|word| word.trim().to_owned()).collect()
        })
        .collect()
}

pub(crate) fn number(text: &str) -> f64 {
    text.parse().expect("a number")
}

/// xᵀ A x.
#[allow(dead_code, reason = "not every test looks at matrices")]
pub(crate) fn quadratic(matrix: &SparseSymmetric, values: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (dof, value) in matrix.diagonal.iter().enumerate() {
        sum += value * values[dof] * values[dof];
    }
    for (column, bounds) in matrix.starts.windows(2).enumerate() {
        for place in bounds[0]..bounds[1] {
            let row = matrix.rows[place] as usize;
            sum += 2.0 * matrix.values[place] * values[row] * values[column];
        }
    }
    sum
}
