//! Infill panels of a building: their damage by drift, and those that fell out.

use std::collections::BTreeSet;

use serde::Serialize;

use super::building::BuildingSummary;
use super::parts::PartSummary;
use crate::quantity::{Quantity, Unit};

/// Infill panels of a building, the worst of each number.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct PanelsSummary {
    /// Number of panels.
    pub total: usize,
    /// Greatest drift of a bay that is judged; `null` if none is \[–\].
    pub drift_peak: Option<f64>,
    /// Greatest damage state by drift, 0 to 4; `null` if none is judged.
    pub damage_state: Option<usize>,
    /// Greatest inertia force across a plane over what the panel bears; `null` where no panel is compared \[–\].
    pub out_of_plane_ratio: Option<f64>,
    /// Panels that fell out and left the model.
    pub fallen: usize,
    /// When the first one fell; `null` if none did \[s\].
    pub first_fall_s: Option<f64>,
}

#[rustfmt::skip]
impl PanelsSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("total", "infill panels", |p| p.total),
        Quantity::<Self>::optional("drift_peak", Unit::NONE, "greatest drift of a bay with damage states", |p| p.drift_peak).in_study(),
        Quantity::<Self>::optional("damage_state", Unit::NONE, "greatest damage state from drift, 0 to 4", |p| p.damage_state.map(|state| state as f64)).in_study(),
        Quantity::<Self>::optional("out_of_plane_ratio", Unit::NONE, "greatest ratio of out-of-plane inertia force to capacity of a panel", |p| p.out_of_plane_ratio).in_study(),
        Quantity::<Self>::whole("fallen", "panels that fell out and were removed from the model", |p| p.fallen).in_study(),
        Quantity::<Self>::optional("first_fall_s", Unit::S, "time at which the first panel fell out; absent if none did", |p| p.first_fall_s).in_study(),
    ];
}

/// Damage of an infill panel: the worst of its struts.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelDamageSummary {
    /// Name without the way in which struts rise, such as `Old.infill.2.1`.
    pub name: String,
    /// Greatest drift of its bay, either way \[–\].
    pub drift: f64,
    /// Damage state, 0 to 4.
    pub state: usize,
}

impl PanelsSummary {
    /// Of struts and other parts of a building; `None` without panels.
    pub(crate) fn of(parts: &[PartSummary]) -> Option<Self> {
        let struts = || parts.iter().filter(|part| part.kind == "infill");
        let names: BTreeSet<&str> = struts().map(PartSummary::panel).collect();
        let fallen = fallen(parts);
        (!names.is_empty()).then(|| Self {
            total: names.len(),
            drift_peak: struts().filter_map(|part| part.drift).reduce(f64::max),
            damage_state: struts().filter_map(|part| part.damage_state).max(),
            out_of_plane_ratio: struts()
                .filter_map(|part| part.out_of_plane_ratio)
                .reduce(f64::max),
            fallen: fallen.len(),
            first_fall_s: fallen.iter().map(|(_, at)| *at).reduce(f64::min),
        })
    }
}

/// Panels that fell out, with the times \[s\], in the order of their struts.
fn fallen(parts: &[PartSummary]) -> Vec<(&str, f64)> {
    let mut panels: Vec<(&str, f64)> = Vec::new();
    for part in parts {
        let Some(at) = part.fallen_s else { continue };
        if panels.iter().all(|(known, _)| *known != part.panel()) {
            panels.push((part.panel(), at));
        }
    }
    panels
}

impl BuildingSummary {
    /// Infill panels that have fallen out and left the model, with the times \[s\], in the order of their struts.
    #[must_use]
    pub fn fallen_panels(&self) -> Vec<(&str, f64)> {
        fallen(&self.parts)
    }

    /// Infill panels whose damage is judged, in the order of their struts.
    #[must_use]
    pub fn damaged_panels(&self) -> Vec<PanelDamageSummary> {
        let mut panels: Vec<PanelDamageSummary> = Vec::new();
        for part in &self.parts {
            let Some((drift, state)) = part.drift.zip(part.damage_state) else {
                continue;
            };
            let name = part.panel();
            match panels.last_mut().filter(|known| known.name == name) {
                Some(known) => {
                    known.drift = known.drift.max(drift);
                    known.state = known.state.max(state);
                }
                None => panels.push(PanelDamageSummary {
                    name: name.to_owned(),
                    drift,
                    state,
                }),
            }
        }
        panels
    }
}
