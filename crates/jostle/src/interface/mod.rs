//! Contacts and links between buildings, and the points they act on.

mod contact;
pub(crate) mod contact_points;
mod dof_row;
mod graph;
mod link;
mod port;
mod row;

pub use contact::Contact;
pub use contact_points::{UnmatchedFloors, floor_and_height};
pub use dof_row::DofRow;
pub(crate) use graph::InterfaceGraph;
pub use link::LinkElement;
pub use port::{Port, PortPair};
pub(crate) use row::Row;
