//! Contacts and links between buildings, and the points they act on.

mod contact;
pub(crate) mod contact_points;
mod dof_row;
mod edge_end;
mod friction;
mod graph;
mod link;
pub(crate) mod plan_contacts;
mod plan_gap;
mod port;
mod row;

pub use contact::{Contact, PlanPlace};
pub use contact_points::{UnmatchedFloors, floor_and_height};
pub use dof_row::DofRow;
pub use edge_end::EdgeEnd;
pub use friction::{Coulomb, Friction, sticking_stiffness};
pub(crate) use friction::{PushedFloor, unique_below};
pub(crate) use graph::InterfaceGraph;
pub use link::{LinkElement, LinkMemory};
pub(crate) use plan_contacts::MOST_POINTS;
pub use plan_contacts::{PlanContactKind, PlanPart};
pub use plan_gap::narrowest_gap;
pub(crate) use plan_gap::{faces_of_gap, narrowest};
pub use port::{Port, PortPair};
pub(crate) use row::Row;
