//! Response spectra of floors: what equipment on them has to bear, with and without contact.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};

/// Response spectra of floors.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorSpectra {
    /// Periods of the oscillators; 0 is the rigid one \[s\].
    pub periods_s: Vec<f64>,
    /// The filter of filtered peaks.
    pub filter: FilterSummary,
    /// Least time between instants of the floor motion in free vibration; in contact every step is an instant \[s\].
    pub row_interval_s: f64,
    /// Estimated greatest error of the spectra from the distance of these instants, relative to each value \[–\].
    pub resolution: f64,
    /// Floors, building by building, from the ground up.
    pub floors: Vec<FloorSpectrum>,
}

#[rustfmt::skip]
impl FloorSpectra {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("row_interval_s", Unit::S, "time between points of the floor motion in free vibration", |f| f.row_interval_s),
        Quantity::<Self>::real("resolution", Unit::NONE, "estimated maximum relative error of the spectra due to the spacing of these points", |f| f.resolution),
    ];
}

/// A filter that peak accelerations went through.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FilterSummary {
    /// Name.
    pub name: &'static str,
    /// Order of one pass.
    pub order: usize,
    /// Corner frequency, where both passes together have a gain of one half \[Hz\].
    pub corner_hz: f64,
}

#[rustfmt::skip]
impl FilterSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("order", "order of the filter, in one pass", |f| f.order),
        Quantity::<Self>::real("corner_hz", Unit::HZ, "corner frequency, at which the gain of both passes together is one half", |f| f.corner_hz),
    ];
}

/// One floor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorSpectrum {
    /// Name of the building.
    pub building: String,
    /// Floor, from 1.
    pub floor: usize,
    /// Height above the base \[m\].
    pub height_m: f64,
    /// In the run itself.
    #[serde(flatten)]
    pub response: FloorResponse,
    /// In the run without contact, if it exists.
    pub without_contact: Option<FloorResponse>,
}

#[rustfmt::skip]
impl FloorSpectrum {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("floor", "floor number, from 1", |f| f.floor),
        Quantity::<Self>::real("height_m", Unit::M, "height above the base", |f| f.height_m),
    ];
}

/// What a floor does in one run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FloorResponse {
    /// Peak total acceleration, as computed: it depends on the contact stiffness \[m/s²\].
    pub peak_acceleration_m_s2: f64,
    /// The same after the filter \[m/s²\].
    pub filtered_peak_acceleration_m_s2: f64,
    /// One entry for each damping ratio.
    pub spectra: Vec<FloorCurve>,
}

#[rustfmt::skip]
impl FloorResponse {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("peak_acceleration_m_s2", Unit::M_S2, "unfiltered peak total acceleration, which depends on the contact stiffness", |f| f.peak_acceleration_m_s2),
        Quantity::<Self>::real("filtered_peak_acceleration_m_s2", Unit::M_S2, "peak total acceleration after the filter", |f| f.filtered_peak_acceleration_m_s2),
    ];
}

/// Peaks of oscillators with one damping ratio that stand on a floor, by period.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FloorCurve {
    /// Damping ratio \[–\].
    pub damping: f64,
    /// Displacement relative to the floor \[m\].
    pub displacement_m: Vec<f64>,
    /// Pseudo-acceleration ω² times this displacement \[m/s²\].
    pub pseudo_acceleration_m_s2: Vec<f64>,
    /// Total acceleration of the oscillator \[m/s²\].
    pub total_acceleration_m_s2: Vec<f64>,
}

impl FloorCurve {
    /// Index of the period with the greatest pseudo-acceleration.
    #[must_use]
    pub fn strongest(&self) -> Option<usize> {
        let values = self.pseudo_acceleration_m_s2.iter().enumerate();
        let greatest = values.max_by(|a, b| a.1.total_cmp(b.1));
        greatest.map(|(index, _)| index)
    }
}

impl FloorSpectrum {
    /// Greatest ratio of the pseudo-accelerations with and without contact for one of the damping ratios, and the index of
    /// its period; `None` without the run without contact.
    #[must_use]
    pub fn greatest_ratio(&self, damping: usize) -> Option<(usize, f64)> {
        let without = self.without_contact.as_ref()?.spectra.get(damping)?;
        let with = self.response.spectra.get(damping)?;
        let pairs = with
            .pseudo_acceleration_m_s2
            .iter()
            .zip(&without.pseudo_acceleration_m_s2);
        let ratios = pairs.enumerate().filter(|(_, (_, before))| **before > 0.0);
        ratios
            .map(|(index, (with, before))| (index, with / before))
            .max_by(|a, b| a.1.total_cmp(&b.1))
    }
}
