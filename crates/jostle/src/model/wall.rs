//! Walls in front of floors.

use super::PlanPoint;

/// A wall in front of floors: a mass on a spring and a dashpot on the ground, such as a retaining wall with the soil behind it,
/// or rigid.
///
/// ```
/// use jostle::Wall;
///
/// // A cantilever of height h struck at its top: k = 3EI/h³ and 33/140 of its mass.
/// let wall = Wall {
///     name: "moat".to_owned(),
///     stiffness: Some(120e6),
///     damping: 1.2e6,
///     mass: 25e3,
///     line: None,
/// };
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
    /// Both ends of its face among buildings with plans, on the site; it is solid on the right of the way from the first to the
    /// second \[m\].
    pub line: Option<[PlanPoint; 2]>,
}

/// How far a wall on the site reaches behind its face \[m\].
const DEPTH: f64 = 1e3;

impl Wall {
    /// Corners of what is solid, counter-clockwise; `None` without a face of some length.
    #[must_use]
    pub fn plan(&self) -> Option<Vec<PlanPoint>> {
        let [from, to] = self.line?;
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(along[0], along[1]);
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let behind = |point: PlanPoint| {
            [
                point[0] + DEPTH * along[1] / length,
                point[1] - DEPTH * along[0] / length,
            ]
        };
        Some(vec![behind(from), behind(to), to, from])
    }

    /// Direction in which it moves: its normal out of what is solid, or along the row without a face \[–\].
    #[must_use]
    pub fn direction(&self) -> [f64; 2] {
        let Some([from, to]) = self.line else {
            return [1.0, 0.0];
        };
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(along[0], along[1]);
        [-along[1] / length, along[0] / length]
    }

    /// Whether it moves with the ground.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.stiffness.is_none()
    }
}
