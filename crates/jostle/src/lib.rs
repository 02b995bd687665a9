//! Seismic pounding of neighbouring buildings by the transfer matrix method for multibody systems.
//!
//! A [`Model`] describes buildings in a row and the gaps between them. [`System::assemble`] turns it into equations,
//! [`Plan::choose`] picks solver and steps, [`simulate`] runs it through a [`GroundMotion`], and [`Summary::new`] gives the peaks.
//! All quantities are in SI units and radians.
//!
//! # Two buildings, one record, an impact
//!
//! ```
//! use std::ops::ControlFlow;
//!
//! use jostle::{
//!     Building, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model, Plan, RestitutionIs, RunEnd, Settings,
//!     Shear, Structure, System, simulate,
//! };
//!
//! // A shear building of equal storeys: mass [kg] and stiffness [N/m] of each, 3.2 m high.
//! fn tower(name: &str, storeys: usize, mass: f64, stiffness: f64) -> Building {
//!     Building {
//!         name: name.to_owned(),
//!         structure: Structure::Shear(Shear {
//!             mass: vec![mass; storeys],
//!             stiffness: vec![stiffness; storeys],
//!             storey_heights: vec![3.2; storeys],
//!         }),
//!         damping: Damping::ratio(0.05, []),
//!         ..Building::default()
//!     }
//! }
//!
//! let law = ContactLaw {
//!     kind: LawKind::HertzDamp,
//!     stiffness: 2e9, // N/m^1.5
//!     restitution: 0.65,
//!     restitution_is: RestitutionIs::Realised,
//! };
//! let model = Model {
//!     title: "Soft and stiff".to_owned(),
//!     buildings: vec![tower("soft", 3, 40e3, 20e6), tower("stiff", 3, 60e3, 90e6)],
//!     gaps: vec![Gap::after(0, 0.02, law)], // 20 mm, right of building 0
//!     ..Model::default()
//! };
//! // A record: ground acceleration [m/s²] at equal steps, here five seconds of a sine of 0.7 s.
//! let wave: Vec<f64> = (0..=500).map(|i| 3.0 * (0.01 * f64::from(i) * 9.0).sin()).collect();
//! let motion = GroundMotion::sampled("sine", 0.01, wave);
//!
//! let system = System::assemble(&model).map_err(|faults| faults[0].clone())?;
//! let plan = Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
//! let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
//!
//! assert_eq!(outcome.end, RunEnd::Completed);
//! let first = outcome.impacts.iter().min_by(|a, b| a.start.total_cmp(&b.start)).expect("they collide");
//! assert!(first.peak_force > 1e5 && first.impact_speed > 0.0);
//! assert!(outcome.energy.imbalance() < 1e-6);
//! # Ok::<(), jostle::ModelFault>(())
//! ```
//!
//! # A user-defined contact law
//!
//! [`contact::ForceLaw`] has the force laws with their coefficients. A contact accepts any of them, also with coefficients
//! that no published formula gives. Here the damping factor of a Hertz law is fitted to measured rebounds:
//!
//! ```
//! use jostle::contact::{ForceLaw, FreeCollision};
//!
//! // F = k δ^1.5 (1 + d δ̇/v₀) with a user-defined d.
//! let law = ForceLaw::Hertz { stiffness: 1.2e9, damping: 0.9 };
//! let collision = FreeCollision::new(&law, 40e3, 60e3, 0.4); // 40 t against 60 t at 0.4 m/s
//! assert!((0.5..0.7).contains(&collision.realised_restitution()));
//!
//! // The force of one instant: indentation 2 mm, closing at 0.1 m/s after an impact at 0.4 m/s.
//! let response = law.respond(2e-3, 0.1, 0.4);
//! let expected = 1.2e9 * 2e-3_f64.powf(1.5) * (1.0 + 0.9 * 0.1 / 0.4);
//! assert!((response.force / expected - 1.0).abs() < 1e-12);
//! ```
//!
//! In a run, set it on the contacts of a system before [`simulate`]:
//! `for contact in &mut system.contacts { contact.law = law; }`. A formula of another form is a new variant of `ForceLaw`; the Python
//! package can try one out without that (`jostle.ContactLaw`).
//!
//! # Examples
//!
//! `cargo run -p jostle --example two_towers` prints the impacts of the pair above for several gaps.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

pub mod contact;
pub mod eigen;
pub mod history;
pub mod hysteresis;
pub mod interface;
pub mod judgement;
pub mod linear;
pub mod method;
pub mod model;
pub mod motion;
pub mod pushover;
pub mod quantity;
pub mod results;
pub mod separation;
pub mod state;
pub mod statics;
pub mod stepping;
pub mod stiffness;
pub mod structure;
pub mod system;
pub mod transfer;

mod check;
mod simd;

pub use contact::{ContactLaw, LawKind, RestitutionIs};
pub use history::{Column, EnergyTerm, History, Impact};
pub use interface::{UnmatchedFloors, UnmetColumns, floor_and_height, sticking_stiffness};
pub use model::{
    AcrossBase, Analysis, Axial, Base, BearingBounds, BearingFactors, BearingStrength, BedSpring,
    Building, ColumnFibres, ColumnLine, CouplingBeam, Damping, Diagonal, DiagonalKind,
    DiagonalPlace, Fibre, FibreLimit, FibreMaterial, FloorMatrices, FloorPairs, Foundation,
    FoundationSprings, Frame, FrameHinges, FramePlace, FrameWall, Gap, Given, GivenFloor,
    GivenInPlan, Gravity, GridLine, GroundSprings, HalfSpace, Hinges, Integrator, Isolation,
    Isolator, IsolatorDamping, Joint, JointRequest, Level, Link, LinkLaw, MassDamping,
    MemberRequest, Model, ModelFault, PanelAcross, PanelDamage, PlanArea, PlanAxis, PlanColumn,
    PlanContact, PlanFoundationSprings, PlanFrame, PlanPoint, PlanSpring, ProportionalDamping,
    Reach, Rise, Section, Shear, ShearEnds, ShearSpring, SlidingSurface, Soil, SoilCoupling,
    Solver, SpaceFrame, SpaceMember, SpacePlace, SpaceSection, SpaceWall, SpeedFriction, Stop,
    Structure, StrutLine, Sway, Tier, TierStorey, Tiers, Uplift, Wall, WallHinge,
};
pub use motion::{Bearing, GroundMotion, GroundPath, GroundPoint, Grounds, OwnGround, Wave};
pub use quantity::{Quantity, Unit};
pub use results::summary::Summary;
pub use results::{Run, springs_of};
pub use state::State;
pub use stepping::{Outcome, Plan, Pounding, RunEnd, Settings, StepError, simulate};
pub use system::System;
pub use transfer::riccati::{RiccatiFactor, RiccatiScratch, RiccatiSweep};
