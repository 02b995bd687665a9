//! What a run does to buildings and floors, with contact and without: fields, how they follow from the outcome of a run, and the lists
//! of quantities.

use serde::{Serialize, Serializer};

use super::summary::HingeSummary;
use crate::history::PeaksOf;
use crate::quantity::{Quantity, Unit};
use crate::stepping::Outcome;
use crate::system::BuildingSystem;

/// Peaks of one building, and what is left at the end.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct BuildingResponse {
    /// Greatest drift ratio of any storey, either sign \[–\].
    pub drift_peak: f64,
    /// Greatest total acceleration of any floor, either sign \[m/s²\].
    pub total_acceleration_peak_m_s2: f64,
    /// The same after the low-pass filter of floor spectra; `None` without histories \[m/s²\].
    pub filtered_acceleration_peak_m_s2: Option<f64>,
    /// Greatest drift ratio of any storey at the end, either sign \[–\].
    pub residual_drift_peak: f64,
    /// Greatest elastic base shear, either sign \[N\].
    pub base_shear_peak_n: f64,
    /// Roof displacement at the end \[m\].
    pub residual_roof_displacement_m: f64,
    /// Hinges, or storeys of a shear building, that cracked.
    pub hinges_cracked: usize,
    /// Those that yielded.
    pub hinges_yielded: usize,
    /// Greatest ductility of any hinge, or storey of a shear building; `None` if none can yield, as where only braces do \[–\].
    pub ductility: Option<f64>,
}

#[rustfmt::skip]
impl BuildingResponse {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("drift_peak", Unit::NONE, "peak drift ratio of any storey", |b| b.drift_peak).in_study().compared(),
        Quantity::<Self>::real("total_acceleration_peak_m_s2", Unit::M_S2, "peak total acceleration of any floor", |b| b.total_acceleration_peak_m_s2).in_study().compared(),
        Quantity::<Self>::optional("filtered_acceleration_peak_m_s2", Unit::M_S2, "peak total acceleration after a low-pass filter, 25 Hz or the corner of floor spectra; null without histories", |b| b.filtered_acceleration_peak_m_s2),
        Quantity::<Self>::real("residual_drift_peak", Unit::NONE, "greatest drift ratio of any storey at the end, including remaining vibration", |b| b.residual_drift_peak).in_study().compared(),
        Quantity::<Self>::real("base_shear_peak_n", Unit::N, "peak base shear: sum of the horizontal restoring forces at the base (on soil, between building and foundation), including bearings, stops and links to the ground, excluding contact forces and dashpots of the building, its bearings and its base", |b| b.base_shear_peak_n).in_study().compared(),
        Quantity::<Self>::real("residual_roof_displacement_m", Unit::M, "roof displacement at the end, including remaining vibration", |b| b.residual_roof_displacement_m).in_study().compared(),
        Quantity::<Self>::whole("hinges_cracked", "hinges that cracked", |b| b.hinges_cracked).in_study().compared().if_yielding(),
        Quantity::<Self>::whole("hinges_yielded", "hinges that yielded", |b| b.hinges_yielded).in_study().compared().if_yielding(),
        Quantity::<Self>::optional("ductility", Unit::NONE, "greatest ductility of any hinge, or storey of a shear building; absent if none can yield, as where only braces do", |b| b.ductility).in_study().compared().if_yielding(),
    ];
}

/// Peaks of one floor and of the storey below it, and what is left at the end.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct FloorResponse {
    /// Greatest displacement to the right \[m\].
    pub displacement_max_m: f64,
    /// Its instant \[s\].
    pub displacement_max_at_s: f64,
    /// Greatest displacement to the left \[m\].
    pub displacement_min_m: f64,
    /// Its instant \[s\].
    pub displacement_min_at_s: f64,
    /// Greatest total acceleration, either sign \[m/s²\].
    pub total_acceleration_peak_m_s2: f64,
    /// The same after the low-pass filter of floor spectra; `None` without histories \[m/s²\].
    pub filtered_acceleration_peak_m_s2: Option<f64>,
    /// Greatest drift ratio of the storey below, either sign \[–\].
    pub storey_drift_peak: f64,
    /// Greatest shear of the storey below, either sign: the horizontal forces above its base \[N\].
    pub storey_shear_peak_n: f64,
    /// Greatest moment of these forces about the base of the storey below, either sign \[N·m\].
    pub overturning_moment_peak_n_m: f64,
    /// Drift ratio of the storey below at the end, positive to the right \[–\].
    pub residual_drift: f64,
    /// Stability coefficient of the storey below, θ = P d_r/(V h): the weight above it times its greatest drift ratio, over its
    /// greatest shear (EN 1998-1, 4.4.2.2); `None` without shear \[–\].
    pub stability_coefficient: Option<f64>,
    /// Greatest vertical displacement of any mass of the floor relative to the ground, either sign; absent without vertical
    /// shaking \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vertical_displacement_peak_m: Option<f64>,
}

impl FloorResponse {
    /// Greatest displacement, either sign \[m\].
    #[must_use]
    pub fn displacement_peak_m(&self) -> f64 {
        self.displacement_max_m.max(-self.displacement_min_m)
    }
}

#[rustfmt::skip]
impl FloorResponse {
    /// Its numbers; drift, shear and moment are those of the storey below the floor.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("displacement_max_m", Unit::M, "greatest displacement to the right, relative to the ground", |f| f.displacement_max_m).in_study().compared(),
        Quantity::<Self>::real("displacement_max_at_s", Unit::S, "time of this peak", |f| f.displacement_max_at_s),
        Quantity::<Self>::real("displacement_min_m", Unit::M, "greatest displacement to the left, relative to the ground, ≤ 0", |f| f.displacement_min_m).in_study().compared(),
        Quantity::<Self>::real("displacement_min_at_s", Unit::S, "time of this peak", |f| f.displacement_min_at_s),
        Quantity::<Self>::real("displacement_peak_m", Unit::M, "peak displacement", Self::displacement_peak_m).not_in_summary().compared().shown("displacement", "mm", 1e3, 1),
        Quantity::<Self>::real("total_acceleration_peak_m_s2", Unit::M_S2, "peak total acceleration", |f| f.total_acceleration_peak_m_s2).in_study().compared().shown("total acceleration", "m/s²", 1.0, 2),
        Quantity::<Self>::optional("filtered_acceleration_peak_m_s2", Unit::M_S2, "peak total acceleration after a low-pass filter, 25 Hz or the corner of floor spectra; null without histories", |f| f.filtered_acceleration_peak_m_s2).shown("total acceleration, filtered", "m/s²", 1.0, 2),
        Quantity::<Self>::real("storey_drift_peak", Unit::NONE, "peak drift ratio of the storey", |f| f.storey_drift_peak).in_study().compared().shown("storey drift", "%", 100.0, 2),
        Quantity::<Self>::real("storey_shear_peak_n", Unit::N, "peak storey shear: the sum of the horizontal restoring forces above its base", |f| f.storey_shear_peak_n).in_study().compared().shown("storey shear", "kN", 1e-3, 1),
        Quantity::<Self>::real("overturning_moment_peak_n_m", Unit::NM, "peak moment of these forces about the base of the storey", |f| f.overturning_moment_peak_n_m).in_study().compared().shown("overturning moment", "kN·m", 1e-3, 0),
        Quantity::<Self>::real("residual_drift", Unit::NONE, "drift ratio of the storey at the end, including remaining vibration; positive to the right", |f| f.residual_drift).in_study().compared(),
        Quantity::<Self>::optional("stability_coefficient", Unit::NONE, "stability coefficient θ = P d_r/(V h) of the storey: weight above × peak drift ratio ÷ peak shear (EN 1998-1, 4.4.2.2); absent without shear", |f| f.stability_coefficient),
        Quantity::<Self>::optional("vertical_displacement_peak_m", Unit::M, "peak vertical displacement of any mass of the floor relative to the ground; only under vertical shaking", |f| f.vertical_displacement_peak_m).in_study(),
    ];
}

impl FloorResponse {
    /// Its peaks alone.
    pub(super) fn of_peaks(peaks: PeaksOf<'_>) -> Self {
        let displacement = peaks.displacement();
        Self {
            displacement_max_m: displacement.greatest.value,
            displacement_max_at_s: displacement.greatest.at,
            displacement_min_m: displacement.least.value,
            displacement_min_at_s: displacement.least.at,
            total_acceleration_peak_m_s2: peaks.total_acceleration(),
            filtered_acceleration_peak_m_s2: peaks.filtered_acceleration(),
            storey_drift_peak: peaks.storey_drift(),
            storey_shear_peak_n: peaks.storey_shear(),
            overturning_moment_peak_n_m: peaks.overturning_moment(),
            ..Self::default()
        }
    }
}

/// Of the floors of a building in a run.
pub(super) fn floor_responses(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
) -> Vec<FloorResponse> {
    let floors = (1..=building.floors.len()).map(|floor| outcome.peaks.floor(index, floor));
    let response = |((peaks, [residual_drift, _]), weight): ((PeaksOf<'_>, [f64; 2]), f64)| {
        let (drift, shear) = (peaks.storey_drift(), peaks.storey_shear());
        let vertical = peaks.vertical_displacement();
        FloorResponse {
            residual_drift,
            stability_coefficient: (shear > 0.0).then(|| weight * drift / shear),
            vertical_displacement_peak_m: (vertical > 0.0).then_some(vertical),
            ..FloorResponse::of_peaks(peaks)
        }
    };
    let residual = building.storey_drifts(&outcome.state.displacement[building.range()]);
    let weights = building.weights_above();
    floors.zip(residual).zip(weights).map(response).collect()
}

/// Of a building in a run, from those of its floors.
pub(super) fn building_response(
    index: usize,
    building: &BuildingSystem,
    outcome: &Outcome,
    floors: &[FloorResponse],
    hinges: &HingeSummary,
) -> BuildingResponse {
    let greatest = |of: fn(&FloorResponse) -> f64| floors.iter().map(of).fold(0.0, f64::max);
    let mut places = building.discretization.spring_places.iter();
    BuildingResponse {
        drift_peak: greatest(|floor| floor.storey_drift_peak),
        total_acceleration_peak_m_s2: greatest(|floor| floor.total_acceleration_peak_m_s2),
        filtered_acceleration_peak_m_s2: floors
            .iter()
            .filter_map(|floor| floor.filtered_acceleration_peak_m_s2)
            .max_by(f64::total_cmp),
        residual_drift_peak: greatest(|floor| floor.residual_drift.abs()),
        base_shear_peak_n: outcome.peaks.base_shear(index),
        residual_roof_displacement_m: roof_displacement(building, outcome),
        hinges_cracked: hinges.cracked,
        hinges_yielded: hinges.yielded,
        ductility: places
            .any(|place| place.is_hinge() && !place.is_brace())
            .then_some(hinges.ductility),
    }
}

fn roof_displacement(building: &BuildingSystem, outcome: &Outcome) -> f64 {
    building
        .floors
        .last()
        .map_or(0.0, |roof| outcome.state.displacement[roof.dof])
}

/// Ratios of a run to the run without contact, by the names of the quantities without their units; `None` where the
/// latter is zero \[–\].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Amplification(pub Vec<(&'static str, Option<f64>)>);

impl Amplification {
    /// Of all quantities of a list that are compared.
    pub(super) fn new<T>(quantities: &[Quantity<T>], with: &T, without: &T) -> Self {
        let compared = quantities
            .iter()
            .filter(|quantity| quantity.places.compared);
        let kept = compared.filter(|quantity| quantity.places.summary);
        let ratio =
            |quantity: &Quantity<T>| (quantity.stem(), quantity.amplification(with, without));
        Self(kept.map(ratio).collect())
    }
}

impl Serialize for Amplification {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}
