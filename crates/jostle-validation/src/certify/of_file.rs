//! The promised numbers of one model file.

use std::fmt::Write;
use std::path::Path;

use super::truth::share;
use super::{Certified, Family, every_run, fill, read_text};

/// The promised numbers of a model file: reference, its change under the perturbation, and both solvers.
///
/// # Errors
/// Why the file cannot be read, or has no reference.
pub fn of_file(path: &Path, tolerances: &[f64]) -> Result<String, String> {
    let tree = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    let tree = serde_json::from_str(&tree).map_err(|e| e.to_string())?;
    let (input, motion) = read_text(&tree, path.parent().unwrap_or(Path::new("")))?;
    let mut certified = Certified::new(0, "file");
    let runs = every_run(Family::named("yielding"), tolerances);
    fill(&input, &motion, &runs, &mut certified)?;
    let mut text = String::new();
    let truth = &certified.truth;
    for (k, (quantity, shift)) in truth.quantities.iter().zip(&truth.shifts).enumerate() {
        let _ = write!(
            text,
            "{:<18} {:<20} {:>14.7e} ({:+.1e})",
            quantity.kind,
            quantity.name,
            quantity.value,
            share(*shift, quantity.scale)
        );
        for run in &certified.runs {
            let _ = write!(text, "  {} {:.0e}: ", run.solver, run.tolerance);
            match (run.truth.quantities.get(k), run.got.get(k)) {
                (Some(expected), Some(got)) => {
                    let error = share(got - expected.value, expected.scale);
                    let _ = write!(text, "{error:+.1e}");
                }
                _ => text.push_str("nothing promised"),
            }
        }
        text.push('\n');
    }
    let _ = writeln!(
        text,
        "{} touches, {} lasting, {} steps, {:.2} s for two references",
        certified.touches, certified.lasting, certified.steps, certified.seconds
    );
    for run in &certified.runs {
        if let Some(cut) = run.cut {
            let _ = writeln!(
                text,
                "{} at {:.0e} is sensitive: motion and reference end at {cut:.3} s",
                run.solver, run.tolerance
            );
        }
    }
    Ok(text)
}
