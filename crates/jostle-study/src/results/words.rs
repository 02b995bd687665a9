//! Columns as text and in display units.

use std::path::Path;

use jostle_io::DesignKind;
use jostle_io::shown::{ENERGY, FORCE, GROUND_ACCELERATION, IMPULSE, LENGTH, MASS, MOMENT, Shown};
use jostle_report::Axis;
use jostle_report::message;

use crate::key_words::key_in_words;

/// Endings of column names: the size of the display unit, and its name.
fn units() -> [(&'static str, f64, &'static str); 10] {
    let form = |ending, shown: Shown| (ending, shown.of(1.0), shown.name());
    [
        form("_m_s2", GROUND_ACCELERATION),
        form("_n_m", MOMENT),
        ("_rad", 1e3, "mrad"),
        form("_n_s", IMPULSE),
        ("_per_s", 1.0, "1/s"),
        form("_kg", MASS),
        form("_n", FORCE),
        form("_j", ENERGY),
        form("_m", LENGTH),
        ("_s", 1.0, "s"),
    ]
}

/// The axis of a column, and by what its numbers are multiplied there.
pub(super) fn axis(column: &str) -> (Axis, f64) {
    let column = column.trim_start_matches("input.");
    if matches!(column, "angle_rad" | "motion.angle" | "motion.angle_rad") {
        let axis = Axis {
            name: message::angle_of_incidence_axis().into(),
            unit: "°".into(),
        };
        return (axis, 1.0_f64.to_degrees());
    }
    let unit = units()
        .into_iter()
        .find(|(ending, ..)| column.ends_with(ending));
    let (plain, size, unit) = match unit {
        Some((ending, size, unit)) => (column.trim_end_matches(ending), size, unit),
        None if column.ends_with("drift_peak")
            || column.ends_with("drift_across_peak")
            || column.ends_with("drift_peak_without_contact")
            || column.ends_with("drift_across_peak_without_contact")
            || column.ends_with("drift") =>
        {
            (column, 100.0, "%")
        }
        None => (column, 1.0, ""),
    };
    let name = match plain {
        "peak_force" => message::greatest_force_axis().into(),
        "impact_count" => message::impacts_axis().into(),
        "first_impact" => message::first_impact_axis().into(),
        "closing_peak" => message::greatest_closing_axis().into(),
        "pga" | "motion.pga" => message::peak_ground_acceleration_axis().into(),
        "gap.width" => message::gap().into(),
        other if other.ends_with(".closing_without_contact") => {
            let pair = other.trim_end_matches(".closing_without_contact");
            message::gap_needed_of(pair.replacen('-', " ↔ ", 1))
        }
        other => result_in_words(other).unwrap_or_else(|| key_in_words(other)),
    };
    let axis = Axis {
        name,
        unit: unit.to_owned(),
    };
    (axis, size)
}

/// End of a column, and what it says.
type Words = (&'static str, fn() -> &'static str);

/// Results of buildings and floors, without their units.
const RESULTS: [Words; 10] = [
    ("drift_peak", message::result_storey_drift),
    ("storey_drift_peak", message::result_storey_drift),
    ("drift_across_peak", message::result_storey_drift_across),
    (
        "storey_drift_across_peak",
        message::result_storey_drift_across,
    ),
    ("drift_corner_peak", message::result_corner_drift),
    ("residual_drift_peak", message::result_end_drift),
    ("base_shear_peak", message::result_base_shear),
    ("total_acceleration_peak", message::result_acceleration),
    ("displacement_peak", message::result_displacement),
    ("sa_t1", message::result_sa_t1),
];

/// `MRF.floor3.storey_drift_peak` is "storey drift of MRF, floor 3"; `None` for other columns.
fn result_in_words(column: &str) -> Option<String> {
    let (owner, key) = column.rsplit_once('.')?;
    let apart = key.strip_suffix("_without_contact");
    let wanted = apart.unwrap_or(key);
    let (_, words) = RESULTS.iter().find(|(known, _)| *known == wanted)?;
    let of_owner = message::key_of_owner(words(), owner.replacen(".floor", ", floor ", 1));
    Some(match apart {
        Some(_) => message::result_without_contact(of_owner),
        None => of_owner,
    })
}

/// A design in words.
pub(super) fn design(kind: DesignKind) -> &'static str {
    match kind {
        DesignKind::Factorial => message::every_combination(),
        DesignKind::Zipped => message::side_by_side(),
        DesignKind::LatinHypercube => message::latin_hypercube(),
        DesignKind::Sobol => message::sobol_sequence(),
        DesignKind::Random => message::random_draws(),
        DesignKind::Saltelli => message::saltelli_for_sobol(),
        DesignKind::Morris => message::morris_trajectories(),
        DesignKind::OneAtATime => message::one_at_a_time(),
    }
}

/// A path as an argument that the shells of this system take for one.
pub(super) fn argument(path: &Path) -> String {
    quoted(path.display().to_string(), cfg!(windows))
}

fn quoted(text: String, for_windows: bool) -> String {
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '/' | '\\' | '.' | '_' | '-' | ':');
    if text.chars().all(plain) && !text.starts_with('-') {
        text
    } else if for_windows {
        // No path of Windows contains quotation marks.
        format!("\"{text}\"")
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_read_as_words() {
        for (column, words, unit) in [
            ("MRF.drift_peak", "storey drift of MRF", "%"),
            ("MRF.sa_t1_m_s2", "Sa(T1) of MRF", "cm/s²"),
            (
                "A.floor3.storey_drift_peak_without_contact",
                "storey drift of A, floor 3 without contact",
                "%",
            ),
            ("A.base_shear_peak_n", "base shear of A", "kN"),
            ("A.rotation_peak_rad", "A rotation peak", "mrad"),
        ] {
            let (axis, _) = axis(column);
            assert_eq!((&axis.name[..], &axis.unit[..]), (words, unit), "{column}");
        }
    }

    #[test]
    fn paths_are_quoted_as_the_shell_expects() {
        let both = |text: &str| [false, true].map(|windows| quoted(text.into(), windows));
        assert_eq!(both("a/b-1.toml"), ["a/b-1.toml", "a/b-1.toml"]);
        assert_eq!(both("C:\\a\\b"), ["C:\\a\\b", "C:\\a\\b"]);
        assert_eq!(both("my study"), ["'my study'", "\"my study\""]);
        assert_eq!(both("it's"), ["'it'\\''s'", "\"it's\""]);
    }
}
