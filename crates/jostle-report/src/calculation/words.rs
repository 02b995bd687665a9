//! The words of the calculation sections in one table, so that another language can follow.

/// Words in one language.
pub(super) struct Words {
    pub(super) ground_motion: &'static str,
    pub(super) acceleration: &'static str,
    pub(super) response_spectrum: &'static str,
    pub(super) pseudo_acceleration: &'static str,
    pub(super) code_spectrum: &'static str,
    pub(super) time: &'static str,
    pub(super) period: &'static str,
    pub(super) mode_shapes: &'static str,
    pub(super) shape: &'static str,
    pub(super) height: &'static str,
    pub(super) elevation: &'static str,
    pub(super) source: &'static str,
    pub(super) program: &'static str,
    pub(super) model_hash: &'static str,
    pub(super) run_hash: &'static str,
    pub(super) input: &'static str,
    pub(super) input_left_out: &'static str,
}

/// English.
pub(super) const WORDS: Words = Words {
    ground_motion: "Ground motion",
    acceleration: "ground acceleration",
    response_spectrum: "Response spectrum, damping",
    pseudo_acceleration: "pseudo-acceleration",
    code_spectrum: "code",
    time: "time",
    period: "period",
    mode_shapes: "Lateral mode shapes",
    shape: "horizontal displacement, greatest 1 [–]",
    height: "height",
    elevation: "Elevation to scale, dimensions in metres",
    source: "What it was computed from",
    program: "program",
    model_hash: "model file, SHA-256",
    run_hash: "model and motion as run, SHA-256",
    input: "The model file",
    input_left_out: "The model file is too long to be printed here.",
};
