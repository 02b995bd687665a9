//! What a run by modes needed beyond its plan.

/// How a run by modes was refined until it met its tolerance, so that another one may begin there.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Refined {
    /// Further shapes, in the order in which they were added.
    pub(crate) shapes: Vec<MoreShapes>,
    /// Division of free steps beyond that of the plan; 0 means that of the plan.
    pub(crate) division: u32,
}

/// Shapes added to those of a run.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MoreShapes {
    /// Modes of every building whose defects contributed to the error.
    pub(crate) lacking: Vec<Vec<usize>>,
    /// Whether all natural modes replace the shapes of these buildings.
    pub(crate) all: bool,
}
