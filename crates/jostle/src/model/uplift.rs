//! Contact springs of a foundation that lifts off the ground.

use super::Foundation;

/// Contact of a rigid foundation with the ground in compression alone, by springs along its length. Dashpots act at all times.
///
/// ```
/// use jostle::{Foundation, GroundSprings, Uplift};
///
/// let ground = GroundSprings { vertical_stiffness: 300e6, vertical_damping: 2e6, sway: None };
/// let uplift = Uplift { ground: Some(ground), ..Uplift::with_springs(2) };
/// let footing = Foundation { uplift: Some(uplift), ..Foundation::rectangle(3.6, 2.0, 40e3) };
/// let bed = footing.bed(300e6, None)?;
/// assert_eq!(bed[0].at, -1.8); // m
/// assert_eq!(bed[0].stiffness, 150e6); // N/m
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uplift {
    /// Number of springs, ≥ 2, at equal distances from one end of the foundation to the other.
    pub springs: usize,
    /// The same across, under a building with a plan; `None`: as many.
    pub springs_across: Option<usize>,
    /// Stiffness of the outermost springs over that of the strip of ground that each stands for, > 0. `None`: on a half-space what
    /// gives its rocking stiffness, otherwise 1 \[–\].
    pub ends: Option<f64>,
    /// Springs and dashpots of the ground, instead of those of the soil of the model.
    pub ground: Option<GroundSprings>,
    /// Strength of the ground; `None` is elastic.
    pub bearing: Option<BearingStrength>,
}

/// Springs and dashpots under a foundation that lifts off, as sums over its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundSprings {
    /// Force per vertical displacement while all of it is in contact, > 0 \[N/m\].
    pub vertical_stiffness: f64,
    /// Force per vertical velocity, ≥ 0; dashpots are shared like stiffness \[N·s/m\].
    pub vertical_damping: f64,
    /// Force per horizontal displacement and velocity, > 0 and ≥ 0; `None` holds it \[N/m, N·s/m\].
    pub sway: Option<[f64; 2]>,
}

/// Ground that yields under pressure and does not spring back: the gap that it leaves is its settlement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingStrength {
    /// Pressure at which it yields, > 0 \[Pa\].
    pub strength: f64,
    /// Stiffness after yield over the initial one, 0 ≤ hardening < 1 \[–\].
    pub hardening: f64,
}

/// A contact spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedSpring {
    /// Distance to the right of the middle of the foundation \[m\].
    pub at: f64,
    /// Distance across from the middle; zero in one plane \[m\].
    pub across: f64,
    /// Force per shortening \[N/m\].
    pub stiffness: f64,
    /// Area of its strip \[m²\].
    pub area: f64,
}

impl Uplift {
    /// Elastic contact on the soil of the model.
    #[must_use]
    pub fn with_springs(springs: usize) -> Self {
        Self {
            springs,
            springs_across: None,
            ends: None,
            ground: None,
            bearing: None,
        }
    }
}

impl Foundation {
    /// Contact springs with this sum of stiffness \[N/m\] and, where no stiffness of the ends is stated, this rocking stiffness
    /// \[N·m/rad\]; empty for a foundation that does not lift off.
    ///
    /// Every spring stands for a strip that reaches half way to its neighbours. The outermost are `ends` times as stiff as their
    /// strips. Two springs alone stand at ±√(K_θ/K_z) instead, so that they have both sums.
    ///
    /// # Errors
    /// A rocking stiffness that springs along the length cannot have.
    pub fn bed(&self, vertical: f64, rocking: Option<f64>) -> Result<Vec<BedSpring>, String> {
        let Some(uplift) = self.uplift else {
            return Ok(Vec::new());
        };
        let (count, half) = (uplift.springs, 0.5 * self.length);
        let spaces = (count - 1) as f64;
        let (mut ends, mut reach) = (uplift.ends.unwrap_or(1.0), half);
        if let (None, Some(rocking)) = (uplift.ends, rocking) {
            let squared = rocking / vertical;
            // Strips of the inner springs, Σ s and Σ s x², and of both outermost.
            let inner = (1..count - 1).map(|k| half * (2.0 * k as f64 / spaces - 1.0));
            let inner = [inner.clone().count() as f64, inner.map(|x| x * x).sum()];
            ends = (squared * inner[0] - inner[1]) / (half * half - squared);
            if count == 2 {
                (ends, reach) = (1.0, squared.sqrt());
            }
            let reached = reach <= half && ends > 0.0 && ends.is_finite();
            if !reached {
                return Err(format!(
                    "contact springs along {} m cannot have both the vertical and the rocking stiffness of the soil ({vertical:.3e} N/m, {rocking:.3e} N.m/rad): state the stiffness of the outermost ones, such as ends = 2.0; the vertical stiffness then holds",
                    self.length
                ));
            }
        }
        let is_end = |k: usize| k == 0 || k + 1 == count;
        let strip = |k: usize| if is_end(k) { 0.5 } else { 1.0 };
        let share = |k: usize| if is_end(k) { 0.5 * ends } else { 1.0 };
        let shares: f64 = (0..count).map(share).sum();
        let spring = |k: usize| BedSpring {
            at: reach * (2.0 * k as f64 / spaces - 1.0),
            across: 0.0,
            stiffness: vertical * share(k) / shares,
            area: self.length * self.width * strip(k) / spaces,
        };
        Ok((0..count).map(spring).collect())
    }

    /// Contact springs of a foundation under a building with a plan: a grid whose stiffnesses and areas are products of those of both
    /// directions, by rows along x. Moved along one axis, it is the bed of one plane. `rocking`: along x and across \[N·m/rad\].
    ///
    /// # Errors
    /// A rocking stiffness that springs along one of the sides cannot have.
    pub fn bed_in_plan(
        &self,
        vertical: f64,
        rocking: Option<[f64; 2]>,
    ) -> Result<Vec<BedSpring>, String> {
        let along = self.bed(vertical, rocking.map(|rocking| rocking[0]))?;
        let across = self
            .turned()
            .bed(vertical, rocking.map(|rocking| rocking[1]))?;
        let rows = across.iter().flat_map(|row| {
            along.iter().map(|bed| BedSpring {
                at: bed.at,
                across: row.at,
                stiffness: bed.stiffness * (row.stiffness / vertical),
                area: bed.area * row.area / (self.length * self.width),
            })
        });
        Ok(rows.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn footing(uplift: Uplift) -> Foundation {
        Foundation {
            uplift: Some(uplift),
            ..Foundation::rectangle(6.0, 2.0, 1e4)
        }
    }

    fn sums(bed: &[BedSpring]) -> [f64; 3] {
        let of = |power: i32| {
            bed.iter()
                .map(|bed| bed.stiffness * bed.at.powi(power))
                .sum()
        };
        [of(0), of(1), of(2)]
    }

    /// Strips alone tend to a continuous bed, K_θ = K_z L²/12; stiff ends to two springs, K_z L²/4.
    #[test]
    fn springs_stand_for_a_continuous_bed() {
        let bed = footing(Uplift::with_springs(401))
            .bed(2e8, None)
            .expect("sound");
        let [vertical, skew, rocking] = sums(&bed);
        assert!((vertical / 2e8 - 1.0).abs() < 1e-12);
        assert!(skew.abs() < 1.0);
        assert!((rocking / (2e8 * 3.0) - 1.0).abs() < 1e-4, "{rocking}");
        let area: f64 = bed.iter().map(|bed| bed.area).sum();
        assert!((area / 12.0 - 1.0).abs() < 1e-12);
        let ends = Some(1e9);
        let stiff = Uplift {
            ends,
            ..Uplift::with_springs(5)
        };
        let [.., rocking] = sums(&footing(stiff).bed(2e8, None).expect("sound"));
        assert!((rocking / (2e8 * 9.0) - 1.0).abs() < 1e-6, "{rocking}");
    }

    /// In plan the grid has the sums of both directions.
    #[test]
    fn a_grid_has_the_sums_of_both_directions() {
        let footing = footing(Uplift {
            springs_across: Some(3),
            ..Uplift::with_springs(4)
        });
        let bed = footing
            .bed_in_plan(2e8, Some([1.5e9, 1.2e8]))
            .expect("sound");
        assert_eq!(bed.len(), 12);
        let of = |value: &dyn Fn(&BedSpring) -> f64| bed.iter().map(value).sum::<f64>();
        for (found, due) in [
            (of(&|spring| spring.stiffness), 2e8),
            (
                of(&|spring| spring.stiffness * spring.at * spring.at),
                1.5e9,
            ),
            (
                of(&|spring| spring.stiffness * spring.across * spring.across),
                1.2e8,
            ),
            (of(&|spring| spring.area), 12.0),
        ] {
            assert!((found / due - 1.0).abs() < 1e-12, "{found} {due}");
        }
        let turned = footing.turned().bed_in_plan(2e8, Some([1.2e8, 1.5e9]));
        let turned = turned.expect("sound");
        assert!(turned.iter().all(|footing| bed.iter().any(|other| {
            (footing.at - other.across).abs() + (footing.across - other.at).abs() < 1e-12
                && (footing.stiffness / other.stiffness - 1.0).abs() < 1e-12
        })));
    }

    /// Without a stiffness of the ends, both sums are those asked for.
    #[test]
    fn both_sums_are_those_of_the_soil() {
        for count in [2, 3, 4, 11] {
            let footing = footing(Uplift::with_springs(count));
            let bed = footing.bed(2e8, Some(1.5e9)).expect("within reach");
            let [vertical, skew, rocking] = sums(&bed);
            assert!((vertical / 2e8 - 1.0).abs() < 1e-12);
            assert!(skew.abs() < 1.0, "{skew}");
            assert!((rocking / 1.5e9 - 1.0).abs() < 1e-12, "{count}: {rocking}");
            assert!(footing.bed(2e8, Some(1.9e9)).is_err(), "more than K_z L²/4");
        }
        let uneven = footing(Uplift::with_springs(5));
        assert!(
            uneven.bed(2e8, Some(1e8)).is_err(),
            "less than the inner springs have"
        );
    }
}
