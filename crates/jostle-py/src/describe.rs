//! Description of a model as a tree of numbers.

use jostle::model::Structure;
use jostle::{Model, System};
use serde_json::{Value, json};

/// Buildings, gaps and links with geometry, masses, periods and contacts; names carry units as in `summary.json`.
pub(crate) fn describe(model: &Model, system: &System) -> Value {
    let buildings = model.buildings.iter().zip(&system.buildings);
    let buildings = buildings.map(|(building, assembled)| {
        let (kind, spans) = match &building.structure {
            Structure::Frame(frame) => ("frame", frame.spans.clone()),
            Structure::Shear(_) => ("shear", Vec::new()),
            Structure::Given(_) => ("given", Vec::new()),
            Structure::Tiers(tiers) if !tiers.frames.is_empty() => ("frame", Vec::new()),
            Structure::Tiers(tiers) if tiers.space_frame.is_some() => ("space-frame", Vec::new()),
            Structure::Tiers(tiers) if tiers.matrices.is_some() => ("given", Vec::new()),
            Structure::Tiers(_) => ("shear", Vec::new()),
        };
        let periods: Vec<f64> = assembled
            .lateral_modes()
            .map(jostle::eigen::Mode::period)
            .collect();
        let mut described = json!({
            "name": building.name,
            "kind": kind,
            "floor_heights_m": building.floor_heights(),
            "spans_m": spans,
            "mass_kg": assembled.equations.total_mass(),
            "degrees_of_freedom": assembled.equations.len(),
            "periods_s": periods,
            "rayleigh_alpha_per_s": assembled.equations.alpha,
            "rayleigh_beta_s": assembled.equations.beta,
        });
        if let Structure::Tiers(tiers) = &building.structure {
            let plan =
                |floor: &jostle::Tier| json!({ "corners_m": floor.plan, "centre_m": floor.centre });
            described["plans"] = tiers.floors.iter().map(plan).collect();
        }
        described
    });
    let gaps = model.gaps.iter().enumerate().map(|(index, gap)| {
        let contacts = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index);
        let free = contacts.clone();
        let free = free.filter_map(|contact| contact.free_restitution(&gap.law));
        let contacts = contacts.map(|contact| {
            json!({
                "floors": system.floors_of(&contact.ports),
                "height_m": contact.height,
                "width_m": contact.width,
            })
        });
        json!({
            "between": names(system, gap.between),
            "width_m": gap.width(),
            "law": gap.law.kind.name(),
            "stiffness": gap.law.stiffness,
            "restitution": (!gap.law.kind.has_given_constants()).then_some(gap.law.restitution),
            "free_restitution": free.reduce(f64::min),
            "contacts": contacts.collect::<Vec<_>>(),
        })
    });
    let links = model.links.iter().enumerate().map(|(index, link)| {
        let links = system.links.iter().filter(|element| element.link == index);
        let floors = links
            .map(|element| json!({ "floors": system.floors_of(&element.ports), "height_m": element.height }));
        json!({
            "between": names(system, link.between),
            "law": link.law.name(),
            "stiffness_n_m": link.stiffness,
            "damping_n_s_m": link.damping,
            "floors": floors.collect::<Vec<_>>(),
        })
    });
    json!({
        "title": model.title,
        "buildings": buildings.collect::<Vec<_>>(),
        "gaps": gaps.collect::<Vec<_>>(),
        "links": links.collect::<Vec<_>>(),
    })
}

/// Names of both sides.
fn names(system: &System, between: [Option<usize>; 2]) -> [&str; 2] {
    between.map(|side| system.side_name(side))
}
