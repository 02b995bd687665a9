//! Gaps, contacts and impacts.

use serde::Serialize;

use crate::quantity::{Quantity, Unit};
use crate::results::in_plan::{ImpactSliding, PlanContactSummary};

/// One gap and its contacts.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct GapSummary {
    /// Names of the left and the right building; `wall` is a rigid wall.
    pub between: [String; 2],
    /// Width at rest, the least of its contacts \[m\].
    pub width_m: f64,
    /// Smallest distance, negative if there was indentation \[m\].
    pub clearance_m: f64,
    /// Contact law.
    pub law: String,
    /// Restitution of free masses under this law, the least of its contacts; `null` where it depends on the impact
    /// speed \[–\].
    pub free_restitution: Option<f64>,
    /// Contacts from the lowest up.
    pub contacts: Vec<ContactSummary>,
    /// Impacts of all contacts.
    pub impact_count: usize,
    /// Impacts of one contact that follow each other sooner count as one \[s\].
    pub minimum_separation_s: f64,
    /// Intervals in which at least one contact is in impact.
    pub pounding_count: usize,
    /// Those of them in which two or more contacts were in impact at the same instant.
    pub multiple_pounding_count: usize,
    /// Most contacts in impact at one instant.
    pub most_at_once: usize,
    /// Greatest force of any contact \[N\].
    pub peak_force_n: f64,
    /// Greatest sum of the forces of all contacts at one instant \[N\].
    pub total_force_peak_n: f64,
    /// Its instant; `null` without an impact \[s\].
    pub total_force_peak_at_s: Option<f64>,
    /// Instant of the first impact \[s\].
    pub first_impact_s: Option<f64>,
    /// Greatest closing of any contact when the buildings pass through each other, less what it is wider than the
    /// others: the gap needed; `null` when that run was not made \[m\].
    pub closing_without_contact_m: Option<f64>,
}

#[rustfmt::skip]
impl GapSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("width_m", Unit::M, "width at rest, the smallest of its contacts", |g| g.width_m).in_study(),
        Quantity::<Self>::real("clearance_m", Unit::M, "smallest distance during the run; negative values are indentation", |g| g.clearance_m),
        Quantity::<Self>::optional("free_restitution", Unit::NONE, "restitution of free masses under the contact law; null if it depends on the impact speed", |g| g.free_restitution),
        Quantity::<Self>::whole("impact_count", "impacts of all its contacts", |g| g.impact_count).in_study(),
        Quantity::<Self>::real("minimum_separation_s", Unit::S, "impacts of one contact with less time between them count as one", |g| g.minimum_separation_s),
        Quantity::<Self>::whole("pounding_count", "intervals in which at least one contact is in impact", |g| g.pounding_count).in_study(),
        Quantity::<Self>::whole("multiple_pounding_count", "intervals with impacts at two or more contacts at once", |g| g.multiple_pounding_count),
        Quantity::<Self>::whole("most_at_once", "greatest number of contacts in impact at the same time", |g| g.most_at_once).in_study(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force of any of its contacts", |g| g.peak_force_n).in_study(),
        Quantity::<Self>::real("total_force_peak_n", Unit::N, "greatest sum of the forces of all its contacts at the same time", |g| g.total_force_peak_n).in_study(),
        Quantity::<Self>::optional("total_force_peak_at_s", Unit::S, "time of this peak; absent without an impact", |g| g.total_force_peak_at_s),
        Quantity::<Self>::optional("first_impact_s", Unit::S, "time of the first impact", |g| g.first_impact_s).in_study(),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of the forces of all its contacts", Self::impulse_n_s).not_in_summary().in_study(),
        Quantity::<Self>::real("closing_peak_m", Unit::M, "greatest closing of any of its contacts", Self::closing_peak_m).not_in_summary().in_study(),
    ];

    /// Numbers of the run without contact; in studies if they ask for it.
    pub const WITHOUT_CONTACT: &[Quantity<Self>] = &[
        Quantity::<Self>::optional("closing_without_contact_m", Unit::M, "greatest closing without contact: the gap needed. In studies only with `without_contact = true`", |g| g.closing_without_contact_m).in_study(),
    ];
}

impl GapSummary {
    /// Time integral of the forces of all contacts \[N·s\].
    #[must_use]
    pub fn impulse_n_s(&self) -> f64 {
        // An empty sum would be −0.
        let contacts = self.contacts.iter();
        contacts.fold(0.0, |sum, contact| sum + contact.impulse_n_s)
    }

    /// Greatest closing of any contact, at least zero \[m\].
    #[must_use]
    pub fn closing_peak_m(&self) -> f64 {
        let contacts = self.contacts.iter();
        contacts
            .map(|contact| contact.closing_peak_m)
            .fold(0.0, f64::max)
    }
}

/// One contact.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ContactSummary {
    /// Left and right floor, from 1; `null` for a point between floors.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height_m: f64,
    /// Where it is in plan; absent in one plane.
    #[serde(flatten)]
    pub in_plan: Option<PlanContactSummary>,
    /// Line of the column of a building with a plan that is struck between its floors, as [`crate::model::ColumnLine::name`] has it; `None`
    /// elsewhere.
    #[serde(skip)]
    pub struck_column: Option<String>,
    /// Width at rest, the least of its points \[m\].
    pub width_m: f64,
    /// Depth to which the face is crushed at the end of the run, by which its gap is wider, the greatest of its points; absent
    /// if the law does not crush \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crushed_depth_m: Option<f64>,
    /// Coefficient of restitution whose published formula gives the dashpot that the gap states; absent otherwise \[–\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub equivalent_restitution: Option<f64>,
    /// Greatest closing u_left − u_right, that of grounds that differ included; of faces that are not parallel by how much less than
    /// `width_m` their nearest points are apart \[m\].
    pub closing_peak_m: f64,
    /// Its instant \[s\].
    pub closing_peak_at_s: f64,
    /// The part of it that the grounds contribute; absent where one ground is under all \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closing_peak_ground_m: Option<f64>,
    /// Number of impacts.
    pub impact_count: usize,
    /// Greatest force \[N\].
    pub peak_force_n: f64,
    /// Its instant; `null` without an impact \[s\].
    pub peak_force_at_s: Option<f64>,
    /// Time integral of the force \[N·s\].
    pub impulse_n_s: f64,
    /// Impacts in order of time.
    pub impacts: Vec<ImpactSummary>,
}

#[rustfmt::skip]
impl ContactSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("height_m", Unit::M, "height above the base, or above the datum of elevations", |c| c.height_m),
        Quantity::<Self>::real("width_m", Unit::M, "width at rest", |c| c.width_m),
        Quantity::<Self>::optional("crushed_depth_m", Unit::M, "crushed depth of the face at the end, by which the gap is wider; only with crush", |c| c.crushed_depth_m),
        Quantity::<Self>::optional("equivalent_restitution", Unit::NONE, "coefficient of restitution for which the published formula gives the dashpot; only with damping", |c| c.equivalent_restitution),
        Quantity::<Self>::whole("impact_count", "impacts", |c| c.impact_count).in_study(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force", |c| c.peak_force_n).in_study(),
        Quantity::<Self>::optional("peak_force_at_s", Unit::S, "time of this peak; absent without an impact", |c| c.peak_force_at_s),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of the force", |c| c.impulse_n_s).in_study(),
        Quantity::<Self>::real("closing_peak_m", Unit::M, "greatest closing; the excess over width_m is indentation", |c| c.closing_peak_m).in_study(),
        Quantity::<Self>::real("closing_peak_at_s", Unit::S, "time of this peak", |c| c.closing_peak_at_s),
        Quantity::<Self>::optional("closing_peak_ground_m", Unit::M, "part of this closing due to the ground displacements; only with different motion under each building", |c| c.closing_peak_ground_m),
    ];
}

/// One impact.
#[derive(Clone, Copy, Debug, Serialize, PartialEq)]
pub struct ImpactSummary {
    /// Instant of first contact \[s\].
    pub start_s: f64,
    /// Last instant of force \[s\].
    pub end_s: f64,
    /// Greatest force \[N\].
    pub peak_force_n: f64,
    /// Its instant \[s\].
    pub peak_force_at_s: f64,
    /// Greatest indentation \[m\].
    pub peak_indentation_m: f64,
    /// Closing rate at first contact \[m/s\].
    pub impact_speed_m_s: f64,
    /// Opening rate at the end, zero when the run ended first \[m/s\].
    pub separation_speed_m_s: f64,
    /// Separation ÷ impact speed \[–\].
    pub realised_restitution: f64,
    /// Time integral of the force \[N·s\].
    pub impulse_n_s: f64,
    /// Energy dissipated by the contact \[J\].
    pub dissipated_j: f64,
    /// Whether it ended before the end of the run.
    pub finished: bool,
    /// Closed episodes counted as this one impact.
    pub touches: usize,
    /// Greatest number of contacts of the gap in impact at one instant of it, itself included.
    pub simultaneous: usize,
    /// Centre of pressure at the greatest force, on the site; absent in one plane \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 2]>,
    /// How it ended: `"open"`, or `"off"` where a corner slid off the edge that it pressed; absent in one plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ended: Option<&'static str>,
    /// Friction along the face; absent without.
    #[serde(flatten)]
    pub sliding: Option<ImpactSliding>,
}

#[rustfmt::skip]
impl ImpactSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("start_s", Unit::S, "time of first contact", |i| i.start_s),
        Quantity::<Self>::real("end_s", Unit::S, "time of the last contact force", |i| i.end_s),
        Quantity::<Self>::real("duration_s", Unit::S, "time from first contact to the last contact force", |i| i.end_s - i.start_s).not_in_summary(),
        Quantity::<Self>::real("peak_force_n", Unit::N, "greatest force", |i| i.peak_force_n),
        Quantity::<Self>::real("peak_force_at_s", Unit::S, "time of this peak", |i| i.peak_force_at_s),
        Quantity::<Self>::real("peak_indentation_m", Unit::M, "greatest indentation", |i| i.peak_indentation_m),
        Quantity::<Self>::real("impact_speed_m_s", Unit::M_S, "closing rate at first contact", |i| i.impact_speed_m_s),
        Quantity::<Self>::real("separation_speed_m_s", Unit::M_S, "opening rate at the end of the impact; 0 if the run ended first", |i| i.separation_speed_m_s),
        Quantity::<Self>::real("realised_restitution", Unit::NONE, "separation speed ÷ impact speed", |i| i.realised_restitution),
        Quantity::<Self>::real("impulse_n_s", Unit::NS, "time integral of the force", |i| i.impulse_n_s),
        Quantity::<Self>::real("dissipated_j", Unit::J, "energy dissipated by the contact", |i| i.dissipated_j),
        Quantity::<Self>::whole("finished", "whether the impact ended within the run", |i| usize::from(i.finished)),
        Quantity::<Self>::whole("touches", "contact episodes counted as this impact", |i| i.touches),
        Quantity::<Self>::whole("simultaneous", "greatest number of contacts of the gap in impact at the same time during this impact", |i| i.simultaneous),
    ];
}
