//! Exported scripts: read back as tables, and compared with runs of OpenSees.

mod bearings;
mod driver;
mod fibres;
mod grounds;
mod member_forces;
mod openseespy;
mod plan;
mod script;
mod soil;
