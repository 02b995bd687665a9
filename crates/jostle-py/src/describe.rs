//! What a model amounts to, as a tree of numbers.

use jostle::model::Structure;
use jostle::{Model, System};
use serde_json::{Value, json};

/// Buildings and gaps with geometry, masses, periods and contacts; names carry units as in `summary.json`.
pub(crate) fn describe(model: &Model, system: &System) -> Value {
    let buildings = model.buildings.iter().zip(&system.buildings);
    let buildings = buildings.map(|(building, assembled)| {
        let (kind, spans) = match &building.structure {
            Structure::Frame(frame) => ("frame", frame.spans.clone()),
            Structure::Shear(_) => ("shear", Vec::new()),
        };
        let periods: Vec<f64> = assembled
            .lateral_modes()
            .map(jostle::modal::Mode::period)
            .collect();
        json!({
            "name": building.name,
            "kind": kind,
            "floor_heights_m": building.floor_heights(),
            "spans_m": spans,
            "mass_kg": assembled.equations.total_mass(),
            "degrees_of_freedom": assembled.equations.len(),
            "periods_s": periods,
            "rayleigh_alpha_per_s": assembled.equations.alpha,
            "rayleigh_beta_s": assembled.equations.beta,
        })
    });
    let gaps = model.gaps.iter().enumerate().map(|(index, gap)| {
        let contacts = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index);
        let contacts =
            contacts.map(|contact| json!({ "floors": contact.floors, "height_m": contact.height }));
        let names = [gap.left, gap.left + 1].map(|side| &model.buildings[side].name);
        json!({
            "between": names,
            "width_m": gap.width,
            "law": gap.law.kind.name(),
            "stiffness": gap.law.stiffness,
            "restitution": gap.law.restitution,
            "free_restitution": gap.law.free_restitution(),
            "contacts": contacts.collect::<Vec<_>>(),
        })
    });
    json!({
        "title": model.title,
        "buildings": buildings.collect::<Vec<_>>(),
        "gaps": gaps.collect::<Vec<_>>(),
    })
}
