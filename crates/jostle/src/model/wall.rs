//! Walls in front of floors.

/// A wall in front of floors: a mass on a spring and a dashpot on the ground, such as a retaining wall with the soil behind it,
/// or rigid.
///
/// ```
/// use jostle::Wall;
///
/// // A cantilever of height h struck at its top: k = 3EI/h³ and 33/140 of its mass.
/// let wall = Wall { name: "moat".to_owned(), stiffness: Some(120e6), damping: 1.2e6, mass: 25e3 };
/// assert!(!wall.is_rigid());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Name, unique among buildings and walls.
    pub name: String,
    /// Force per displacement, > 0; `None` is rigid \[N/m\].
    pub stiffness: Option<f64>,
    /// Force per velocity, ≥ 0; needs a stiffness \[N·s/m\].
    pub damping: f64,
    /// Mass, ≥ 0; needs a stiffness \[kg\].
    pub mass: f64,
}

impl Wall {
    /// Whether it moves with the ground.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.stiffness.is_none()
    }
}
