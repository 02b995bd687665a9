//! The promised numbers of a run, and where they are in a summary.

use jostle::results::in_plan::FloorInPlan;
use jostle::{Summary, System};

use super::reference::Peaks;

/// Share of the greatest displacement of the neighbours that counts as closing at least.
const SWAY: f64 = 0.1;

/// One promised number.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Its kind.
    pub kind: &'static str,
    /// Which one.
    pub name: String,
    /// The value.
    pub value: f64,
    /// The greatest of its kind in that building or gap.
    pub scale: f64,
}

/// A number that only buildings in plan, on bearings or on soil have.
#[derive(Clone, Copy, Debug)]
pub struct More {
    /// Its kind.
    pub kind: &'static str,
    /// Floor; 0 is the mat or the foundation.
    pub floor: usize,
    /// The value.
    pub value: f64,
}

/// A kind of number of floors in plan, and where a summary has it.
type OfFloor = (&'static str, fn(&FloorInPlan) -> f64);

/// What floors in plan have beside what all floors have.
pub(super) const PLAN: [OfFloor; 10] = [
    ("displacement across max", |f| f.displacement_across_max_m),
    ("displacement across min", |f| f.displacement_across_min_m),
    ("rotation max", |f| f.rotation_max_rad),
    ("rotation min", |f| f.rotation_min_rad),
    ("displacement of corners", |f| f.corner_displacement_peak_m),
    ("acceleration across", |f| {
        f.total_acceleration_across_peak_m_s2
    }),
    ("drift across", |f| f.storey_drift_across_peak),
    ("drift at corners", |f| f.storey_drift_corner_peak),
    ("storey shear across", |f| f.storey_shear_across_peak_n),
    ("torque", |f| f.storey_torque_peak_n_m),
];
/// What mats on bearings have.
pub(super) const MAT: [&str; 4] = [
    "displacement of the mat max",
    "displacement of the mat min",
    "acceleration of the mat",
    "force of bearings",
];
/// What foundations on soil have.
pub(super) const FOUNDATION: [&str; 2] = ["sway of the foundation", "rocking"];

/// The kind by whose greatest value a kind is measured.
fn measured_by(kind: &str) -> &str {
    kind.strip_suffix(" max")
        .or(kind.strip_suffix(" min"))
        .unwrap_or(kind)
}

/// First contact of every contact as results list them: points of a face together.
fn listed(system: &System) -> Vec<usize> {
    let mut faces = Vec::new();
    let all = (0..system.contacts.len()).filter(|index| {
        let face = system.contacts[*index].plan.map(|place| place.face);
        if face.is_some() && faces.last() == Some(&face) {
            return false;
        }
        faces.push(face);
        true
    });
    all.collect()
}

pub(super) fn quantities_of(system: &System, peaks: &Peaks) -> Vec<Quantity> {
    let mut list = Vec::new();
    let most = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    for (building, building_peaks) in system.buildings.iter().zip(&peaks.buildings) {
        let name = &building.name;
        let reach = most(&building_peaks.most).max(most(&building_peaks.least));
        for (kind, values, scale) in [
            ("displacement max", &building_peaks.most, reach),
            ("displacement min", &building_peaks.least, reach),
            ("drift", &building_peaks.drift, most(&building_peaks.drift)),
            (
                "acceleration",
                &building_peaks.acceleration,
                most(&building_peaks.acceleration),
            ),
            (
                "storey shear",
                &building_peaks.storey_shear,
                most(&building_peaks.storey_shear),
            ),
            (
                "overturning moment",
                &building_peaks.moment,
                most(&building_peaks.moment),
            ),
        ] {
            for (floor, value) in values.iter().enumerate() {
                list.push(Quantity {
                    kind,
                    name: format!("{name} floor {}", floor + 1),
                    value: *value,
                    scale,
                });
            }
        }
        list.push(Quantity {
            kind: "base shear",
            name: name.clone(),
            value: building_peaks.shear,
            scale: building_peaks.shear,
        });
        for more in &building_peaks.more {
            let alike = building_peaks.more.iter();
            let alike = alike.filter(|other| measured_by(other.kind) == measured_by(more.kind));
            list.push(Quantity {
                kind: more.kind,
                name: format!("{name} floor {}", more.floor),
                value: more.value,
                scale: alike.fold(0.0, |m: f64, other| m.max(other.value.abs())),
            });
        }
    }
    let contacts: Vec<_> = listed(system)
        .iter()
        .map(|c| &system.contacts[*c])
        .collect();
    for (kind, values) in [
        ("contact force", &peaks.force),
        ("impulse", &peaks.impulse),
        ("closing", &peaks.closing),
    ] {
        for (index, contact) in contacts.iter().enumerate() {
            let of_gap = contacts
                .iter()
                .zip(values)
                .filter(|(c, _)| c.gap == contact.gap);
            let mut scale = of_gap.fold(0.0, |m: f64, (_, v)| m.max(v.abs()));
            if kind == "closing" {
                // A difference of displacements, which vanishes where neighbours move together.
                let neighbours = contact.ports.buildings().into_iter().flatten();
                let sways = neighbours.map(|building| {
                    let building = &peaks.buildings[building];
                    most(&building.most).max(most(&building.least))
                });
                scale = sways.fold(scale, |m, sway| m.max(SWAY * sway));
            }
            list.push(Quantity {
                kind,
                name: format!("gap {} at {:.2} m", contact.gap + 1, contact.height),
                value: values[index],
                scale,
            });
        }
    }
    for (element, value) in system.model_links().iter().zip(&peaks.link) {
        let of_link = system.model_links().iter().zip(&peaks.link);
        let of_link = of_link.filter(|(other, _)| other.link == element.link);
        list.push(Quantity {
            kind: "link force",
            name: format!("link {} at {:.2} m", element.link + 1, element.height),
            value: *value,
            scale: of_link.fold(0.0, |m: f64, (_, v)| m.max(*v)),
        });
    }
    list
}

/// The same list from a summary.
pub(super) fn values_of(summary: &Summary, system: &System) -> Vec<f64> {
    let mut list = Vec::new();
    for building in &summary.buildings {
        let floors = || building.floors.iter();
        list.extend(floors().map(|f| f.response.displacement_max_m));
        list.extend(floors().map(|f| f.response.displacement_min_m));
        list.extend(floors().map(|f| f.response.storey_drift_peak));
        list.extend(floors().map(|f| f.response.total_acceleration_peak_m_s2));
        list.extend(floors().map(|f| f.response.storey_shear_peak_n));
        list.extend(floors().map(|f| f.response.overturning_moment_peak_n_m));
        list.push(building.response.base_shear_peak_n);
        for (_, of) in PLAN {
            list.extend(floors().filter_map(|f| f.in_plan.as_ref().map(of)));
        }
        if let (Some(isolation), Some(mat)) = (&building.isolation, &building.floors.mat) {
            list.extend([
                isolation.displacement_max_m,
                isolation.displacement_min_m,
                mat.response.total_acceleration_peak_m_s2,
                isolation.force_peak_n,
            ]);
        }
        if let Some(foundation) = &building.foundation {
            list.extend([foundation.sway_peak_m, foundation.rocking_peak_rad]);
        }
    }
    // Contacts of a summary stand gap by gap, in the order of the system.
    let mut places = vec![0; summary.gaps.len()];
    let mut positions = Vec::new();
    for contact in listed(system).into_iter().map(|c| &system.contacts[c]) {
        positions.push((contact.gap, places[contact.gap]));
        places[contact.gap] += 1;
    }
    let contacts = || {
        positions
            .iter()
            .map(|(gap, place)| &summary.gaps[*gap].contacts[*place])
    };
    list.extend(contacts().map(|contact| contact.peak_force_n));
    list.extend(contacts().map(|contact| contact.impulse_n_s));
    list.extend(contacts().map(|contact| contact.closing_peak_m));
    // Links of a summary stand link by link, in the order of the system.
    let floors = summary.links.iter().flat_map(|link| &link.floors);
    list.extend(floors.map(|floor| floor.peak_force_n.abs()));
    list
}
