//! Many rows of yielding shear buildings that pound, a case per lane of the processor's registers.
//!
//! A [`Row`] is two or more [`Building`]s in a line with a [`Gap`] between neighbours; [`run`] steps rows through
//! their ground motions and hands their [`Peaks`] to a sink, in order. Steps are fixed: every row is stepped by its
//! own highest frequency, so its numbers do not depend on the rows beside it, on threads or on the width of
//! registers. All quantities are SI. Weights have no second-order
//! effect (P-Delta): the same model file says `p_delta = false`.
//!
//! ```
//! use jostle_batch::{Building, Contact, Gap, Law, Motion, Options, Row, Rule, Storey, run};
//! use std::ops::ControlFlow;
//!
//! let storey = Storey { mass: 1e5, stiffness: 1e8, height: 3.0, first_corner: 0.005, second_corner: 0.03,
//!     second_ratio: 0.1, third_ratio: 0.001 };
//! let rule = Rule::Pinched { deformation: 0.8, force: 0.8, unloading_exponent: 0.1 };
//! let stiff = Building { storeys: vec![storey; 2], rule, alpha: 0.5, beta: 0.0 };
//! let soft = Building { storeys: vec![Storey { stiffness: 3e7, ..storey }; 3], ..stiff.clone() };
//! let law = Law::HertzDamp { stiffness: 2e9, restitution: 0.65 };
//! let gap = Gap::between(&stiff, &soft, 0.01, Some(law), 0.0);
//! let motions = [Motion { step: 0.02, acceleration: vec![0.0, 3.0, -3.0, 1.0, 0.0, 0.0, 0.0] }];
//! let row = Row { buildings: vec![stiff, soft], gaps: vec![gap], motion: 0, scale: 1.0 };
//! run(&motions, [row], &Options::default(), |_, peaks| {
//!     assert!(peaks.buildings[0].drift[0] > 0.0);
//!     ControlFlow::Continue(())
//! })?;
//! # Ok::<(), jostle_batch::Error>(())
//! ```

mod lanes;
mod pack;
mod peaks;
mod row;
mod run;

pub use peaks::{BuildingPeaks, ContactPeaks, Peaks};
pub use row::{Building, Contact, Face, Gap, Law, Motion, Row, Rule, Storey};
pub use run::{Error, Options, Precision, run};
