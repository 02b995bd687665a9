//! Contacts and links between buildings, and the points they act on.

mod contact;
pub(crate) mod contact_points;

mod edge_end;
mod friction;
mod graph;
mod joined_points;
mod link;
pub(crate) mod plan_contacts;
mod plan_gap;
mod port;

pub use contact::{Contact, PlanPlace};
pub use contact_points::{UnmatchedFloors, floor_and_height};

pub use edge_end::EdgeEnd;
pub use friction::{Coulomb, Friction, sticking_stiffness};
pub(crate) use friction::{PushedFloor, unique_below};
pub(crate) use graph::InterfaceGraph;
pub(crate) use joined_points::JoinedPoints;
pub use link::{LinkElement, LinkMemory};
pub(crate) use plan_contacts::MOST_POINTS;
pub use plan_contacts::{PlanContactKind, PlanPart};
pub use plan_gap::UnmetColumns;
pub use plan_gap::narrowest_gap;
pub(crate) use plan_gap::{Touched, columns_not_met, faces_of_gap, narrowest};
pub use port::{Port, PortPair};
