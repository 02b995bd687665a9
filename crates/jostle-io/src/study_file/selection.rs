//! `[selection]` of a study: the code and the structure for which its records are checked.

use jostle_motion::{MainPeriod, TargetSpectrum};

use crate::files::Files;
use crate::keys::Section;
use crate::model_file::read_spectrum;
use crate::quantity::Dimension;
use crate::reader::{Field, Reader, View};

/// The code check of the records of a study; the rules are those of the code of the spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct SelectionWanted {
    /// Spectrum of the code.
    pub target: TargetSpectrum,
    /// Damping ratio of all spectra \[–\].
    pub damping: f64,
    /// Artificial records, by their names in the study or its model; built-in ones are known.
    pub artificial: Vec<String>,
    /// Main periods of the structure; empty takes those of every building.
    pub periods: Vec<MainPeriod>,
    /// Scaling before the check.
    pub scaling: SelectionScaling,
}

/// Scaling of motions before a code check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SelectionScaling {
    /// To the peak of the code for time histories; or as in the model if it matches a spectrum.
    Code,
    /// To this peak \[m/s²\].
    Peak(f64),
    /// Not at all.
    AsRecorded,
}

pub(super) fn read(
    reader: &mut Reader<'_>,
    field: &Field<'_>,
    files: &Files,
) -> Option<SelectionWanted> {
    let view = reader.open(field, &[Section::Selection])?;
    let target = match reader.get(&view, "spectrum") {
        Some(field) => read_spectrum(reader, &field, files),
        None => {
            let remedy = "add spectrum = { code = \"gb50011\", intensity = 7, site = \"II\", group = 1 }, or a file";
            reader.missing(&view, "spectrum", remedy);
            None
        }
    };
    let artificial = match reader.get(&view, "artificial") {
        Some(field) => super::wanted::texts(reader, &field),
        None => Some(Vec::new()),
    };
    let damping = match reader.get(&view, "damping") {
        Some(field) => damping(reader, &field),
        None => Some(0.05),
    };
    let periods = periods(reader, &view);
    let scaling = scaling(reader, &view);
    Some(SelectionWanted {
        target: target?,
        damping: damping?,
        artificial: artificial?,
        periods: periods?,
        scaling: scaling?,
    })
}

fn damping(reader: &mut Reader<'_>, field: &Field<'_>) -> Option<f64> {
    let damping = reader.quantity(field, Dimension::Dimensionless)?;
    let good = (0.0..1.0).contains(&damping);
    if !good {
        let problem = format!("must lie from 0 to below 1, found {damping}");
        reader.bad(field, problem);
    }
    good.then_some(damping)
}

fn periods(reader: &mut Reader<'_>, view: &View<'_>) -> Option<Vec<MainPeriod>> {
    let mut list = |key, dimension| match reader.get(view, key) {
        Some(field) => {
            let Some(entries) = field.entries().filter(|entries| !entries.is_empty()) else {
                let found = field.node.describe();
                reader.bad(&field, format!("expected a list of values, found {found}"));
                return None;
            };
            let values = entries
                .iter()
                .map(|entry| reader.positive(entry, dimension));
            values.collect::<Option<Vec<f64>>>().map(Some)
        }
        None => Some(None),
    };
    let periods = list("periods", Dimension::Time);
    let ratios = list("mass_ratios", Dimension::Dimensionless);
    let (periods, ratios) = (periods?, ratios?);
    if let (Some(ratios), Some(field)) = (&ratios, reader.get(view, "mass_ratios")) {
        let count = periods.as_ref().map_or(0, Vec::len);
        if ratios.len() != count {
            *reader.bad(
                &field,
                format!("{} values for {count} periods", ratios.len()),
            ) = Some("give one share of the mass for each of periods".into());
            return None;
        }
    }
    let ratio = |index: usize| ratios.as_ref().map_or(1.0, |ratios| ratios[index]);
    let pairs = periods.unwrap_or_default().into_iter().enumerate();
    Some(
        pairs
            .map(|(index, period)| MainPeriod {
                period,
                mass_ratio: ratio(index),
            })
            .collect(),
    )
}

fn scaling(reader: &mut Reader<'_>, view: &View<'_>) -> Option<SelectionScaling> {
    let unscaled = match reader.get(view, "unscaled") {
        Some(field) => reader.flag(&field)?,
        None => false,
    };
    let Some(peak) = reader.get(view, "pga") else {
        return Some(if unscaled {
            SelectionScaling::AsRecorded
        } else {
            SelectionScaling::Code
        });
    };
    if unscaled {
        *reader.bad(&peak, "cannot be combined with unscaled") = Some("keep one of both".into());
        return None;
    }
    let peak = reader.positive(&peak, Dimension::Acceleration)?;
    Some(SelectionScaling::Peak(peak))
}
