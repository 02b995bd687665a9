//! Seismic pounding of neighbouring buildings by the transfer matrix method for multibody systems.

pub mod contact;
pub mod history;
pub mod model;
pub mod motion;
pub mod separation;
pub mod summary;

mod check;

pub use contact::{ContactLaw, LawKind, RestitutionIs};
pub use history::{Column, EnergyTerm, History, Impact};
pub use model::{
    Analysis, Axial, Building, Damping, FloorPairs, Frame, Gap, Joint, Model, ModelFault, Section,
    Shear, Solver, Structure,
};
pub use motion::{GroundMotion, Wave};
pub use summary::Summary;
