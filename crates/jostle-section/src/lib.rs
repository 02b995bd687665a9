//! From a reinforced-concrete section to the backbone of a plastic hinge.
//!
//! A [`Section`] is a rectangle of [`Concrete`] with [`Reinforcement`]. Two methods give the moment–rotation curve
//! of a member end ([`EndCurve`]): published formulas ([`formula`]), and an analysis of the section fibre by fibre
//! ([`MomentCurvature`]) with a trilinear curve fitted to it. [`EndCurve::hinge`] takes away what the member itself
//! bends and leaves the [`jostle::hysteresis::Backbone`] of the hinge.
//!
//! Everything is in SI. Compression is positive for concrete strains and axial loads; positive moments stretch
//! the bottom.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))] // bits of results depend on no processor

pub mod capacity;
pub mod formula;
pub mod masonry;

mod bars;
mod buckling;
mod column_fibres;
mod concrete;
mod curve;
mod fibre;
mod fit;
mod law;
mod member;
mod profile;
mod section;
mod steel;
mod survey;
mod tee;
mod wall;

pub use bars::{Bar, BarsError, Reinforcement, Ties, bar_size};
pub use buckling::BucklingCurve;
pub use column_fibres::FibreOptions;
pub use concrete::{CONCRETE_GRADES, Concrete, EN_CONCRETE_GRADES, StrengthLevel};
pub use curve::{AnalysisError, Event, EventKind, MomentCurvature, Options};
pub use fibre::{Fibres, Resultants};
pub use fit::Trilinear;
pub use law::{ConcreteLaw, SteelLaw, confined};
pub use member::{EndCurve, EndSide, FORMULA_POST_YIELD};
pub use profile::{
    AISC_STEEL_MODULUS, Axis, ISection, Pipe, Profile, STEEL_DENSITY, STEEL_MODULUS, Tube,
};
pub use section::{Section, SectionFault, Transformed};
pub use steel::{ASTM_STEEL_GRADES, EN_STEEL_GRADES, STEEL_GRADES, Steel};
pub use survey::{Analysis, SectionSurvey};
pub use tee::{FlangeWidth, Slab, Span, Tee};
pub use wall::{WallReinforcement, WallSection, WebBars};
