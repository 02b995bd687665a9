//! What the user states beside the files.

/// In which direction a building is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// In one plane, along X of the source.
    X,
    /// In one plane, along Y of the source.
    Y,
    /// In space.
    Both,
}

/// Where the stiffness comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Displacements under unit loads.
    Flexibility,
    /// Periods and shapes.
    Modes,
    /// Storey stiffnesses.
    Stiffness,
    /// Columns and beams of a text model, as a space frame.
    Frame,
    /// All members of a text model, as the stiffness of its floors.
    Members,
}

/// What the user states beside the files.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// Direction; `None` for a model in space where the files suffice.
    pub direction: Option<Direction>,
    /// Way; `None` for the best that the files allow.
    pub way: Option<Way>,
    /// Load case of storey stiffnesses, or modal case of modes.
    pub case: Option<String>,
    /// Diaphragm that is the building, where storeys have several.
    pub diaphragm: Option<String>,
    /// Force of cases whose name says where it acts, positive \[N\].
    pub unit_force: Option<f64>,
    /// Moment of such cases, positive \[N·m\].
    pub unit_moment: Option<f64>,
    /// Units of files that state none, such as `kN, m`.
    pub units: Option<String>,
    /// Width of the gaps between neighbours, positive \[m\].
    pub gap: Option<f64>,
    /// Name of the model file without extension; archives beside it begin with it.
    pub stem: String,
}
