//! Members against limits of rotation that the user states.

use serde::Serialize;

use crate::model::RotationLevel;
use crate::quantity::{Quantity, Unit};

/// Members of a building with stated limits of the rotation of their hinges.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct RotationLevelsSummary {
    /// Number of members with limits.
    pub members: usize,
    /// Those that went beyond immediate occupancy, or beyond a higher level.
    pub beyond_io: usize,
    /// Those that went beyond life safety, or beyond collapse prevention.
    pub beyond_ls: usize,
    /// Those that went beyond collapse prevention.
    pub beyond_cp: usize,
    /// Members beyond a level, the worst first; then the others.
    pub list: Vec<MemberLevel>,
}

#[rustfmt::skip]
impl RotationLevelsSummary {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::whole("members", "members that have rotation limits", |r| r.members),
        Quantity::<Self>::whole("beyond_io", "members that exceeded immediate occupancy or a higher level", |r| r.beyond_io).in_study(),
        Quantity::<Self>::whole("beyond_ls", "members that exceeded life safety or a higher level", |r| r.beyond_ls).in_study(),
        Quantity::<Self>::whole("beyond_cp", "members that exceeded collapse prevention", |r| r.beyond_cp).in_study(),
    ];
}

/// The end of a member that came furthest.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct MemberLevel {
    /// Name of the member, such as `J1.column.LINE.STOREY`.
    pub member: String,
    /// The end: `foot`, `head`, `left`, `right`, `first` or `last`.
    pub at: &'static str,
    /// `plastic`: beyond yield of the hinge; `chord`: of hinge and member together.
    pub measure: &'static str,
    /// Greatest rotation, either sign \[rad\].
    pub rotation_rad: f64,
    /// Greatest rotation over the limit of the highest stated level \[–\].
    pub ratio: f64,
    /// The highest level whose limit it exceeded; `null` if it kept all.
    pub beyond: Option<RotationLevel>,
    /// Levels in rising order.
    pub limits: Vec<ReachedLevel>,
}

#[rustfmt::skip]
impl MemberLevel {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("rotation_rad", Unit::RAD, "peak rotation of its ends", |m| m.rotation_rad),
        Quantity::<Self>::real("ratio", Unit::NONE, "ratio of peak rotation to the limit of the highest given level", |m| m.ratio),
    ];
}

/// A level of a member.
#[derive(Clone, Debug, Serialize, PartialEq)]
pub struct ReachedLevel {
    /// `IO`, `LS` or `CP`.
    pub level: RotationLevel,
    /// Its greatest rotation \[rad\].
    pub limit_rad: f64,
    /// When an end of the member first exceeded it; absent if none did \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_s: Option<f64>,
}

#[rustfmt::skip]
impl ReachedLevel {
    /// Its numbers.
    pub const QUANTITIES: &[Quantity<Self>] = &[
        Quantity::<Self>::real("limit_rad", Unit::RAD, "rotation limit of the level", |l| l.limit_rad),
        Quantity::<Self>::optional("beyond_s", Unit::S, "time at which an end of the member first exceeded it; absent if none did", |l| l.beyond_s),
    ];
}
