//! Seismic pounding of neighbouring buildings by the transfer matrix method for multibody systems.

pub mod contact;
pub mod counting;
pub mod equations;
pub mod faces;
pub mod gravity;
pub mod history;
pub mod hysteresis;
pub mod method;
pub mod modal;
pub mod model;
pub mod motion;
pub mod separation;
pub mod skeleton;
pub mod state;
pub mod statics;
pub mod stepping;
pub mod stiffness;
pub mod summary;
pub mod system;
pub mod transfer;

mod check;
mod check_row;
mod cholesky;
mod contact_points;
mod element;
mod finite;
mod full_matrix;
mod lanes;
mod member_end;
mod row;
mod small_keys;
mod sparse_cholesky;
mod stretches;
mod summarise;

pub use contact::{ContactLaw, LawKind, RestitutionIs};
pub use contact_points::UnmatchedFloors;
pub use history::{Column, EnergyTerm, History, Impact};
pub use model::{
    Analysis, Axial, Base, Building, Damping, FloorPairs, Frame, FrameHinges, Gap, Gravity, Hinges,
    Joint, Level, Link, Model, ModelFault, Section, Shear, Solver, Structure,
};
pub use motion::{GroundMotion, Wave};
pub use state::State;
pub use stepping::{Integrator, Outcome, Plan, Pounding, RunEnd, Settings, StepError, simulate};
pub use summarise::{Run, springs_of};
pub use summary::Summary;
pub use system::System;
pub use transfer::riccati::{RiccatiFactor, RiccatiSweep};
