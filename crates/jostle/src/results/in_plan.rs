//! Numbers that only buildings in space have.

use serde::Serialize;

use crate::history::{FaceImpact, Impact, Kind, Owner, Sliding};
use crate::interface::{Contact, MOST_POINTS, PlanContactKind, PlanPart};
use crate::linear::sort_by;
use crate::quantity::{Quantity, Unit};
use crate::stepping::Outcome;
use crate::system::System;

/// Peaks of a floor across the row and in rotation.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct FloorInPlan {
    /// Greatest displacement across, counter-clockwise from x \[m\].
    pub displacement_across_max_m: f64,
    /// Its instant \[s\].
    pub displacement_across_max_at_s: f64,
    /// Least displacement across, ≤ 0 \[m\].
    pub displacement_across_min_m: f64,
    /// Its instant \[s\].
    pub displacement_across_min_at_s: f64,
    /// Greatest rotation, counter-clockwise seen from above \[rad\].
    pub rotation_max_rad: f64,
    /// Its instant \[s\].
    pub rotation_max_at_s: f64,
    /// Least rotation, ≤ 0 \[rad\].
    pub rotation_min_rad: f64,
    /// Its instant \[s\].
    pub rotation_min_at_s: f64,
    /// Greatest horizontal displacement of a corner \[m\].
    pub corner_displacement_peak_m: f64,
    /// Greatest total acceleration across, either sign \[m/s²\].
    pub total_acceleration_across_peak_m_s2: f64,
    /// Greatest drift ratio across of the storey below, either sign \[–\].
    pub storey_drift_across_peak: f64,
    /// Greatest drift ratio of the storey below at a corner of the smaller plan, along x and across together \[–\].
    pub storey_drift_corner_peak: f64,
    /// Greatest shear across of the storey below, either sign \[N\].
    pub storey_shear_across_peak_n: f64,
    /// Greatest torque of the storey below about the centre of mass of the lowest floor, either sign \[N·m\].
    pub storey_torque_peak_n_m: f64,
}

#[rustfmt::skip]
impl FloorInPlan {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("displacement_across_max_m", Unit::M, "greatest displacement across the row", |f| f.displacement_across_max_m).in_study(),
        Quantity::<Self>::real("displacement_across_max_at_s", Unit::S, "time of this peak", |f| f.displacement_across_max_at_s),
        Quantity::<Self>::real("displacement_across_min_m", Unit::M, "largest displacement towards −y, ≤ 0", |f| f.displacement_across_min_m).in_study(),
        Quantity::<Self>::real("displacement_across_min_at_s", Unit::S, "time of this peak", |f| f.displacement_across_min_at_s),
        Quantity::<Self>::real("rotation_max_rad", Unit::RAD, "greatest rotation, counter-clockwise seen from above", |f| f.rotation_max_rad).in_study(),
        Quantity::<Self>::real("rotation_max_at_s", Unit::S, "time of this peak", |f| f.rotation_max_at_s),
        Quantity::<Self>::real("rotation_min_rad", Unit::RAD, "most negative rotation, ≤ 0", |f| f.rotation_min_rad).in_study(),
        Quantity::<Self>::real("rotation_min_at_s", Unit::S, "time of this peak", |f| f.rotation_min_at_s),
        Quantity::<Self>::real("corner_displacement_peak_m", Unit::M, "greatest horizontal displacement of a corner", |f| f.corner_displacement_peak_m).in_study(),
        Quantity::<Self>::real("total_acceleration_across_peak_m_s2", Unit::M_S2, "peak total acceleration across", |f| f.total_acceleration_across_peak_m_s2).in_study(),
        Quantity::<Self>::real("storey_drift_across_peak", Unit::NONE, "peak drift ratio of the storey across, at the centre of mass of its upper floor", |f| f.storey_drift_across_peak).in_study(),
        Quantity::<Self>::real("storey_drift_corner_peak", Unit::NONE, "peak resultant drift ratio of the storey at a corner of the smaller plan", |f| f.storey_drift_corner_peak).in_study(),
        Quantity::<Self>::real("storey_shear_across_peak_n", Unit::N, "peak storey shear across", |f| f.storey_shear_across_peak_n).in_study(),
        Quantity::<Self>::real("storey_torque_peak_n_m", Unit::NM, "peak storey torque about the centre of mass of the lowest floor", |f| f.storey_torque_peak_n_m).in_study(),
    ];
}

/// Peaks of a building across the row and in torsion.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct BuildingInPlan {
    /// Greatest base shear across, either sign \[N\].
    pub base_shear_across_peak_n: f64,
    /// Greatest base torque about the centre of mass of the lowest floor, either sign \[N·m\].
    pub base_torque_peak_n_m: f64,
    /// Greatest horizontal displacement of a corner of any floor \[m\].
    pub corner_displacement_peak_m: f64,
    /// Greatest rotation of any floor, either sign \[rad\].
    pub rotation_peak_rad: f64,
    /// Greatest drift ratio across of any storey, either sign \[–\].
    pub drift_across_peak: f64,
    /// Greatest drift ratio of any storey at a corner of the smaller plan, along x and across together \[–\].
    pub drift_corner_peak: f64,
}

#[rustfmt::skip]
impl BuildingInPlan {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("base_shear_across_peak_n", Unit::N, "peak base shear across: without a mat that of the lowest storey, also on springs under the base", |b| b.base_shear_across_peak_n).in_study().compared(),
        Quantity::<Self>::real("base_torque_peak_n_m", Unit::NM, "peak base torque about the centre of mass of the lowest floor", |b| b.base_torque_peak_n_m).in_study().compared(),
        Quantity::<Self>::real("corner_displacement_peak_m", Unit::M, "greatest horizontal displacement of a corner of any floor", |b| b.corner_displacement_peak_m).in_study().compared(),
        Quantity::<Self>::real("rotation_peak_rad", Unit::RAD, "peak rotation of any floor", |b| b.rotation_peak_rad).in_study().compared(),
        Quantity::<Self>::real("drift_across_peak", Unit::NONE, "peak drift ratio of any storey across", |b| b.drift_across_peak).in_study().compared(),
        Quantity::<Self>::real("drift_corner_peak", Unit::NONE, "peak resultant drift ratio of any storey at a corner of the smaller plan, as limited by codes", |b| b.drift_corner_peak).in_study().compared(),
    ];
}

/// Where a contact of two plans is.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct PlanContactSummary {
    /// `face`, `corner` or `column`.
    pub kind: PlanContactKind,
    /// Middle of the face, or the corner, on the site \[m\].
    pub plan_m: [f64; 2],
    /// Unit normal from the first building to the second.
    pub normal: [f64; 2],
    /// Length of the face, width of a column; zero for a corner \[m\].
    pub overlap_m: f64,
    /// What touches, of the first building and of the second.
    #[serde(skip)]
    pub parts: [PlanPart; 2],
    /// Its points and their forces at the greatest force of the face.
    #[serde(skip)]
    pub points: FacePoints,
    /// What slides along it; absent without friction.
    #[serde(flatten)]
    pub sliding: Option<SlidingSummary>,
}

/// The points of a face along it, and their forces at the greatest force of the face.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FacePoints {
    count: usize,
    places: [[f64; 2]; MOST_POINTS],
    gaps: [f64; MOST_POINTS],
    shares: [f64; MOST_POINTS],
    forces: [f64; MOST_POINTS],
    /// Instant of that force; `None` without an impact \[s\].
    pub at: Option<f64>,
    /// Centre of pressure then, on the site; `None` without an impact \[m\].
    pub centre: Option<[f64; 2]>,
}

/// A point of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressedPoint {
    /// Place on the site \[m\].
    pub place: [f64; 2],
    /// Distance of the edges there at rest \[m\].
    pub gap: f64,
    /// Share of the stiffness of the face \[–\].
    pub share: f64,
    /// Force \[N\].
    pub force: f64,
}

impl FacePoints {
    /// Points along the face; those beyond the most that a face can have are dropped.
    #[must_use]
    pub fn new(points: &[PressedPoint]) -> Self {
        let mut all = Self::default();
        for point in points.iter().take(MOST_POINTS) {
            all.places[all.count] = point.place;
            all.gaps[all.count] = point.gap;
            all.shares[all.count] = point.share;
            all.forces[all.count] = point.force;
            all.count += 1;
        }
        all
    }

    /// Every point, along the face.
    pub fn iter(&self) -> impl Iterator<Item = PressedPoint> + '_ {
        (0..self.count).map(|index| PressedPoint {
            place: self.places[index],
            gap: self.gaps[index],
            share: self.shares[index],
            force: self.forces[index],
        })
    }
}

/// Friction along a face over all its impacts.
#[derive(Clone, Copy, Debug, Default, Serialize, PartialEq)]
pub struct SlidingSummary {
    /// Greatest friction force, either sign \[N\].
    pub tangential_peak_n: f64,
    /// Time integral of the friction force, with its sign \[N·s\].
    pub tangential_impulse_n_s: f64,
    /// Greatest slip since the first contact of an impact, either sign \[m\].
    pub slip_peak_m: f64,
    /// Energy dissipated by friction \[J\].
    pub friction_j: f64,
}

impl SlidingSummary {
    /// Of all impacts of a contact.
    pub(super) fn new<'a>(impacts: impl Iterator<Item = &'a Impact>) -> Self {
        let none = Sliding::default();
        let all = impacts.fold(none, |all, impact| all.and(&impact.sliding));
        Self {
            tangential_peak_n: all.peak_force,
            tangential_impulse_n_s: all.impulse,
            slip_peak_m: all.slip_peak,
            friction_j: all.friction,
        }
    }
}

/// Friction along the face of one impact.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct ImpactSliding {
    /// Speed along the face at first contact, the first building against the second, along the normal turned by +90°
    /// \[m/s\].
    pub slip_speed_m_s: f64,
    /// Time integral of the friction force, with its sign \[N·s\].
    pub tangential_impulse_n_s: f64,
}

/// Of a floor of a building in a run, from 1, or of its mat as floor 0; `None` in one plane.
pub(super) fn floor_in_plan(index: usize, floor: usize, outcome: &Outcome) -> Option<FloorInPlan> {
    let peaks = outcome.peaks.floor(index, floor);
    let (across, turning) = (peaks.across(), peaks.turning());
    if !across.moves() {
        return None;
    }
    let (moved, turned) = (across.displacement(), turning.displacement());
    Some(FloorInPlan {
        displacement_across_max_m: moved.greatest.value,
        displacement_across_max_at_s: moved.greatest.at,
        displacement_across_min_m: moved.least.value,
        displacement_across_min_at_s: moved.least.at,
        rotation_max_rad: turned.greatest.value,
        rotation_max_at_s: turned.greatest.at,
        rotation_min_rad: turned.least.value,
        rotation_min_at_s: turned.least.at,
        corner_displacement_peak_m: peaks.corner_displacement(),
        total_acceleration_across_peak_m_s2: across.total_acceleration(),
        storey_drift_across_peak: across.storey_drift(),
        storey_drift_corner_peak: peaks.corner_drift(),
        storey_shear_across_peak_n: across.storey_shear(),
        storey_torque_peak_n_m: turning.storey_shear(),
    })
}

/// Of a building in a run; `None` in one plane.
pub(super) fn building_in_plan(index: usize, outcome: &Outcome) -> Option<BuildingInPlan> {
    let lowest = floor_in_plan(index, 1, outcome)?;
    let floors = (1..).map_while(|floor| floor_in_plan(index, floor, outcome));
    let floors: Vec<FloorInPlan> = floors.collect();
    let base = outcome.peaks.owned_by(Owner::Building(index));
    let of_base = |column| outcome.peaks.get(column).map(|peak| peak.size());
    let [shear, torque] =
        [base.across(), base.turning()].map(|peaks| of_base(peaks.column(Kind::Shear)));
    let greatest = |of: &dyn Fn(&FloorInPlan) -> f64| floors.iter().map(of).fold(0.0, f64::max);
    Some(BuildingInPlan {
        corner_displacement_peak_m: greatest(&|floor| floor.corner_displacement_peak_m),
        rotation_peak_rad: greatest(&|floor| floor.rotation_max_rad.max(-floor.rotation_min_rad)),
        drift_across_peak: greatest(&|floor| floor.storey_drift_across_peak),
        drift_corner_peak: greatest(&|floor| floor.storey_drift_corner_peak),
        // Where there is no mat, those of the lowest storey.
        base_shear_across_peak_n: shear.unwrap_or(lowest.storey_shear_across_peak_n),
        base_torque_peak_n_m: torque.unwrap_or(lowest.storey_torque_peak_n_m),
    })
}

/// Where a face is, from its points.
pub(super) fn place_of_face(
    system: &System,
    outcome: &Outcome,
    face: usize,
) -> Option<PlanContactSummary> {
    let points = || system.contacts.iter().filter_map(|contact| contact.plan);
    let mut points = points().filter(|place| place.face == face);
    let first = points.next()?;
    let last = points.next_back().unwrap_or(first);
    let impacts = outcome
        .face_impacts
        .iter()
        .filter(|face_impact| face_impact.face == face);
    let hardest = impacts.max_by(|a, b| a.peak_force.value.total_cmp(&b.peak_force.value));
    let forces = hardest.map_or([0.0; MOST_POINTS], |impact| impact.point_forces);
    let contacts = system.contacts.iter();
    let all = contacts.filter_map(|contact| Some((contact.plan?, contact.width)));
    let pressed: Vec<PressedPoint> = all
        .filter(|(place, _)| place.face == face)
        .zip(forces)
        .map(|((place, gap), force)| PressedPoint {
            place: place.at,
            gap,
            share: place.share,
            force,
        })
        .collect();
    Some(PlanContactSummary {
        kind: first.kind,
        plan_m: [0, 1].map(|axis| 0.5 * (first.at[axis] + last.at[axis])),
        normal: first.normal,
        overlap_m: first.overlap,
        parts: first.parts,
        points: FacePoints {
            at: hardest.map(|impact| impact.peak_force.at),
            centre: hardest.map(|impact| impact.centre),
            ..FacePoints::new(&pressed)
        },
        sliding: None,
    })
}

/// Contacts of the system that belong to a reported contact: the points of a face, or itself.
pub(super) fn points_of(system: &System, reported: usize) -> Vec<usize> {
    let is_own = |contact: &Contact, index: usize| match contact.plan {
        Some(place) => place.face == reported,
        None => index == reported,
    };
    let contacts = system.contacts.iter().enumerate();
    contacts
        .filter(|(index, contact)| is_own(contact, *index))
        .map(|(index, _)| index)
        .collect()
}

/// Impacts of a reported contact: those of a face from the first point that touches to the last
/// that parts, with the greatest total force, the sum of impulses and dissipated energies, the greatest indentation of a
/// point, the impact speed of the first and the separation speed of the last.
pub(super) fn impacts_of(system: &System, outcome: &Outcome, reported: usize) -> Vec<Impact> {
    if !system.is_in_space() {
        let impacts = outcome.impacts.iter();
        let impacts = impacts.filter(|impact| impact.contact == reported);
        return impacts.copied().collect();
    }
    let of_face = |impact: &&Impact| {
        let place = system.contacts[impact.contact].plan;
        place.is_some_and(|place| place.face == reported)
    };
    let points: Vec<&Impact> = outcome.impacts.iter().filter(of_face).collect();
    let faces = outcome.face_impacts.iter();
    faces
        .filter(|face| face.face == reported)
        .filter_map(|face| whole_impact(face, &points))
        .collect()
}

/// An impact of a face, from those of its points.
fn whole_impact(face: &FaceImpact, impacts: &[&Impact]) -> Option<Impact> {
    let impacts = impacts.iter().copied();
    let mut points: Vec<&Impact> = impacts
        .filter(|impact| {
            if face.start == face.end {
                // By the momentum law.
                impact.start == face.start && impact.end == face.end
            } else {
                impact.start < face.end && impact.end > face.start
            }
        })
        .collect();
    sort_by(&mut points, |a, b| a.start.total_cmp(&b.start));
    let (first, last) = (
        points.first()?,
        points.iter().max_by(|a, b| a.end.total_cmp(&b.end))?,
    );
    Some(Impact {
        contact: face.face,
        start: first.start,
        end: last.end,
        peak_force: face.peak_force.value,
        peak_force_at: face.peak_force.at,
        peak_indentation: points
            .iter()
            .map(|p| p.peak_indentation)
            .fold(0.0, f64::max),
        impact_speed: first.impact_speed,
        separation_speed: last.separation_speed,
        finished: points.iter().all(|point| point.finished),
        impulse: points.iter().fold(0.0, |sum, point| sum + point.impulse),
        dissipated: points.iter().fold(0.0, |sum, point| sum + point.dissipated),
        sliding: Sliding {
            slid_off: last.sliding.slid_off,
            ..sliding_of(face, &points)
        },
    })
}

/// Of a face: the greatest total friction, and the points together, from the first that touched.
fn sliding_of(face: &FaceImpact, points: &[&Impact]) -> Sliding {
    let all = points.iter().map(|point| point.sliding);
    Sliding {
        peak_force: face.peak_friction.value,
        peak_force_at: face.peak_friction.at,
        ..all
            .reduce(|first, next| first.and(&next))
            .unwrap_or_default()
    }
}

/// Centre of pressure at the greatest force of an impact \[m\]; `None` in one plane.
pub(super) fn centre_of(impact: &Impact, outcome: &Outcome) -> Option<[f64; 2]> {
    let mut faces = outcome.face_impacts.iter();
    let impact_face = faces
        .find(|face| face.face == impact.contact && face.peak_force.at == impact.peak_force_at);
    impact_face.map(|face| face.centre)
}
