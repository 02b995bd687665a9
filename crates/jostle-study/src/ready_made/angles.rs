//! The ready-made study of the direction that the motion comes from.

use std::fmt::Write as _;
use std::path::Path;

use jostle::System;
use jostle_io::{Format, InputError, ModelTree, StudyFile};

use super::factors::quoted;

/// Angles of incidence: from one to another in equal steps \[°\].
///
/// ```
/// use jostle_study::Incidence;
///
/// assert_eq!(Incidence::default().angles().expect("valid").len(), 72);
/// let quarter = Incidence { to: 90.0, step: 30.0, ..Incidence::default() };
/// assert_eq!(quarter.angles().expect("valid"), [0.0, 30.0, 60.0, 90.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Incidence {
    /// The first, from x counter-clockwise \[°\].
    pub from: f64,
    /// The last; a full circle ends one step before its beginning \[°\].
    pub to: f64,
    /// Between neighbours, > 0 \[°\].
    pub step: f64,
    /// Columns to draw over the angle; empty leaves the choice to the study.
    pub quantities: Vec<String>,
}

/// Most angles of a study.
const MOST_ANGLES: f64 = 3600.0;
/// Parts of a step that rounding may leave \[–\].
const ROUNDING: f64 = 1e-9;

impl Default for Incidence {
    fn default() -> Self {
        Self {
            from: 0.0,
            to: 360.0,
            step: 5.0,
            quantities: Vec::new(),
        }
    }
}

impl Incidence {
    /// The angles, growing \[°\].
    ///
    /// # Errors
    /// What is wrong with the range or the step, in words that follow "angles: ".
    pub fn angles(&self) -> Result<Vec<f64>, String> {
        let Self { from, to, step, .. } = self;
        let span = to - from;
        if ![from, to, step].iter().all(|value| value.is_finite()) {
            return Err("from, to and step must be numbers".into());
        }
        if *step <= 0.0 {
            return Err(format!("the step must be above 0, found {step}°"));
        }
        if span <= 0.0 || span > 360.0 + ROUNDING {
            return Err(format!(
                "from {from}° to {to}° is no range; the second must be above the first, by 360° at most"
            ));
        }
        if span / step > MOST_ANGLES {
            return Err(format!(
                "a step of {step}° makes more than {MOST_ANGLES} angles; take a larger one"
            ));
        }
        let last = (span / step + ROUNDING).floor();
        let is_circle = (span - 360.0).abs() <= ROUNDING && (last * step - span).abs() <= ROUNDING;
        let count = last as usize + usize::from(!is_circle);
        // 0.3°, not 0.30000000000000004°.
        let rounded = |angle: f64| (angle * 1e9).round() / 1e9;
        Ok((0..count)
            .map(|k| rounded(from + step * k as f64))
            .collect())
    }
}

/// The study of the angle of incidence of a model with plans, and what should be known about it, in sentences. Every angle
/// also runs without contact.
///
/// # Errors
/// If the model is wrong or in one plane, or the range is none.
pub fn incidence(
    tree: ModelTree,
    wanted: &Incidence,
) -> Result<(StudyFile, Vec<String>), InputError> {
    let input = tree.input()?;
    let system = System::assemble(&input.model).map_err(|faults| input.faults(faults))?;
    if !system.is_in_space() {
        return Err(input.fault(
            "building",
            "the study angles turns the motion in plan, and the buildings have no plan; give each a plan, such as plan = [\"20 m\", \"12 m\"]",
        ));
    }
    let angles = wanted
        .angles()
        .map_err(|problem| input.fault("", format!("angles: {problem}")))?;
    let mut notes = Vec::new();
    let across = input.motion.as_ref().and_then(|motion| {
        let bearing = motion.bearing.as_ref()?;
        bearing.across.as_ref()
    });
    if across.is_none() {
        notes.push(
            "the motion has one component; give motion.across for the one at a right angle to it"
                .to_owned(),
        );
    }
    let mut text = format!(
        "# How the response depends on the direction that the motion comes from.\ntitle = {}\n",
        quoted(&format!("Angle of incidence: {}", input.model.title))
    );
    if !input.model.gaps.is_empty() {
        text += "without_contact = true\n";
    }
    if !wanted.quantities.is_empty() {
        let names: Vec<String> = wanted.quantities.iter().map(|name| quoted(name)).collect();
        let _ = writeln!(text, "rose = [{}]", names.join(", "));
    }
    let values = angles.iter().map(|angle| quoted(&format!("{angle} deg")));
    let values: Vec<String> = values.collect();
    let _ = writeln!(
        text,
        "\n[[vary]]\nname = \"angle_rad\"\npath = \"motion.angle\"\nvalues = [{}]",
        values.join(", ")
    );
    let file = StudyFile::parse("angles", &text, Format::Toml, Path::new(""), Some(tree))?;
    Ok((file, notes))
}
