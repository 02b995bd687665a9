//! Seismic pounding of neighbouring buildings by the transfer matrix method for multibody systems.

pub mod contact;
pub mod equations;
pub mod gravity;
pub mod history;
pub mod method;
pub mod modal;
pub mod model;
pub mod motion;
pub mod separation;
pub mod skeleton;
pub mod state;
pub mod stepping;
pub mod stiffness;
pub mod summary;
pub mod system;
pub mod transfer;

mod check;
mod element;
mod summarise;

pub use contact::{ContactLaw, LawKind, RestitutionIs};
pub use history::{Column, EnergyTerm, History, Impact};
pub use model::{
    Analysis, Axial, Building, Damping, FloorPairs, Frame, Gap, Joint, Model, ModelFault, Section,
    Shear, Solver, Structure,
};
pub use motion::{GroundMotion, Wave};
pub use state::State;
pub use stepping::{Outcome, Plan, Pounding, RunEnd, Settings, StepError, simulate};
pub use summarise::Run;
pub use summary::Summary;
pub use system::System;
pub use transfer::riccati::{RiccatiFactor, RiccatiSweep};
