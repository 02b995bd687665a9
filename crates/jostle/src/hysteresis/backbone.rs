//! The curve that a spring follows when it is first loaded: piecewise linear to cracking, to yield, and beyond.

use std::fmt;

/// Direction of deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Side {
    /// Deformation and force greater than zero.
    #[default]
    Positive,
    /// Deformation and force less than zero.
    Negative,
}

impl Side {
    /// Both sides, the positive first.
    pub const BOTH: [Self; 2] = [Self::Positive, Self::Negative];

    /// The side of a change; positive for zero.
    #[must_use]
    pub fn from_change(change: f64) -> Self {
        if change < 0.0 {
            Self::Negative
        } else {
            Self::Positive
        }
    }

    /// +1 or −1 \[–\].
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }

    /// The other side.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }

    /// 0 for the positive side, 1 for the negative.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A point of the force–deformation plane.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Corner {
    /// Deformation \[rad or m\].
    pub deformation: f64,
    /// Force \[N·m or N\].
    pub force: f64,
}

/// One side of a backbone as given by the user; forces for [`Backbone::from_forces`], deformations for
/// [`Backbone::from_deformations`], always as magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corners {
    /// End of the first straight line, > 0; equal to `yielding` for a bilinear curve.
    pub cracking: f64,
    /// End of the second line, ≥ `cracking`.
    pub yielding: f64,
    /// Stiffness between cracking and yield, as a ratio to the initial one, > 0 and ≤ 1 \[–\].
    pub post_cracking: f64,
    /// Stiffness after yield, as a ratio to the initial one, ≥ 0 and ≤ `post_cracking` \[–\].
    pub post_yield: f64,
}

impl Corners {
    /// A curve with one corner only.
    #[must_use]
    pub fn bilinear(yielding: f64, post_yield: f64) -> Self {
        Self {
            cracking: yielding,
            yielding,
            post_cracking: 1.0,
            post_yield,
        }
    }
}

/// One side of a backbone: corners as magnitudes, slopes as stiffnesses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BackboneSide {
    /// End of the first straight line.
    pub cracking: Corner,
    /// End of the second one.
    pub yielding: Corner,
    /// Slope between them, > 0 \[N·m/rad or N/m\].
    pub post_cracking: f64,
    /// Slope after yield; below zero, the force falls to `residual` \[N·m/rad or N/m\].
    pub post_yield: f64,
    /// Force that stays after a fall, > 0; not used where the slope after yield is at least zero \[N·m or N\].
    pub residual: f64,
}

impl BackboneSide {
    /// Where a falling line ends; `None` where it does not fall.
    #[must_use]
    pub fn end_of_fall(&self) -> Option<Corner> {
        let lost = self.residual - self.yielding.force;
        (self.post_yield < 0.0).then(|| Corner {
            deformation: self.yielding.deformation + lost / self.post_yield,
            force: self.residual,
        })
    }

    /// Force at a deformation, both as magnitudes.
    #[must_use]
    pub fn force_at(&self, deformation: f64) -> f64 {
        let Self {
            cracking, yielding, ..
        } = self;
        if deformation <= cracking.deformation {
            cracking.force * (deformation / cracking.deformation)
        } else if deformation <= yielding.deformation {
            cracking.force + self.post_cracking * (deformation - cracking.deformation)
        } else {
            let force = yielding.force + self.post_yield * (deformation - yielding.deformation);
            match self.post_yield < 0.0 {
                true => force.max(self.residual),
                false => force,
            }
        }
    }
}

/// Trilinear or bilinear curve of first loading; the sides may differ, the initial stiffness is common.
///
/// Valid by construction: every number is finite; stiffnesses decrease from corner to corner, and are negative after yield only for
/// [`Backbone::falling`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backbone {
    initial: f64,
    sides: [BackboneSide; 2],
}

/// The invalid number of a spring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Initial stiffness.
    Initial,
    /// Cracking force or deformation.
    Cracking,
    /// Yield force or deformation.
    Yielding,
    /// Stiffness ratio after cracking.
    PostCracking,
    /// Stiffness ratio after yield.
    PostYield,
    /// Share of the yield force that a falling line leaves.
    Residual,
    /// The rule itself, or its exponent.
    Rule,
}

impl fmt::Display for Quantity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Initial => "initial",
            Self::Cracking => "cracking",
            Self::Yielding => "yield",
            Self::PostCracking => "post_cracking",
            Self::PostYield => "post_yield",
            Self::Residual => "residual",
            Self::Rule => "rule",
        })
    }
}

/// An error in a backbone, or in a rule on it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{quantity}: {problem}")]
pub struct SpringFault {
    /// The number concerned.
    pub quantity: Quantity,
    /// The side concerned; `None` when it is not of one side.
    pub side: Option<Side>,
    /// The problem and a valid alternative.
    pub problem: String,
}

/// Further than any spring goes \[m\].
const NEVER: f64 = 1e3;

impl Backbone {
    /// From an initial stiffness > 0 \[N·m/rad or N/m\] and the forces at the corners \[N·m or N\].
    ///
    /// # Errors
    /// All errors, never empty.
    pub fn from_forces(
        initial: f64,
        positive: Corners,
        negative: Corners,
    ) -> Result<Self, Vec<SpringFault>> {
        validate(initial, [&positive, &negative])?;
        let side = |given: Corners| {
            let (cracking, gained) = (given.cracking / initial, given.yielding - given.cracking);
            let post_cracking = given.post_cracking * initial;
            BackboneSide {
                cracking: Corner {
                    deformation: cracking,
                    force: given.cracking,
                },
                yielding: Corner {
                    deformation: cracking + gained / post_cracking,
                    force: given.yielding,
                },
                post_cracking,
                post_yield: given.post_yield * initial,
                residual: 0.0,
            }
        };
        Self::finite(initial, [side(positive), side(negative)])
    }

    /// As [`Backbone::from_forces`] with a line that falls after yield, on both sides: `slope` < 0 and > −1 is its slope as a ratio to the initial
    /// stiffness, and `residual` the share of the yield force at which it ends, greater than 0 and less than 1 \[–\]. The force stays there. The slopes after yield that
    /// the corners state are not used.
    ///
    /// # Errors
    /// All errors, never empty.
    pub fn falling(
        initial: f64,
        positive: Corners,
        negative: Corners,
        slope: f64,
        residual: f64,
    ) -> Result<Self, Vec<SpringFault>> {
        let [positive, negative] = [positive, negative].map(|corners| Corners {
            post_yield: 0.0,
            ..corners
        });
        let mut faults = Vec::new();
        let mut require = |good: bool, quantity, problem: String| {
            if !good {
                faults.push(SpringFault {
                    quantity,
                    side: None,
                    problem,
                });
            }
        };
        require(
            slope > -1.0 && slope < 0.0,
            Quantity::PostYield,
            format!(
                "of a line that falls to a residual force must lie between -1 and 0, found {slope}; leave residual out for a line that rises"
            ),
        );
        require(
            residual > 0.0 && residual < 1.0,
            Quantity::Residual,
            format!(
                "must be greater than 0 and less than 1, a share of the yield force; found {residual}"
            ),
        );
        match Self::from_forces(initial, positive, negative) {
            Err(mut others) => {
                others.append(&mut faults);
                Err(others)
            }
            Ok(_) if !faults.is_empty() => Err(faults),
            Ok(mut backbone) => {
                for side in &mut backbone.sides {
                    side.post_yield = slope * initial;
                    side.residual = residual * side.yielding.force;
                }
                Ok(backbone)
            }
        }
    }

    /// The same curve on the negative side, and no force on the positive one: in tension, where deformations are elongations.
    #[must_use]
    pub fn without_tension(mut self) -> Self {
        let side = &mut self.sides[Side::Positive.index()];
        let never = Corner {
            deformation: NEVER,
            force: 0.0,
        };
        (side.cracking, side.yielding) = (never, never);
        (side.post_cracking, side.post_yield, side.residual) = (0.0, 0.0, 0.0);
        self
    }

    /// The side on which it has no force, if there is one.
    #[must_use]
    #[inline]
    pub fn open_side(&self) -> Option<Side> {
        let mut sides = Side::BOTH.into_iter();
        sides.find(|side| self.side(*side).yielding.force == 0.0)
    }

    /// Whether the force falls after yield.
    #[must_use]
    pub fn falls(&self) -> bool {
        self.sides.iter().any(|side| side.post_yield < 0.0)
    }

    /// From an initial stiffness > 0 \[N·m/rad or N/m\] and the deformations at the corners \[rad or m\].
    ///
    /// # Errors
    /// All errors, never empty.
    pub fn from_deformations(
        initial: f64,
        positive: Corners,
        negative: Corners,
    ) -> Result<Self, Vec<SpringFault>> {
        validate(initial, [&positive, &negative])?;
        let side = |given: Corners| {
            let force = initial * given.cracking;
            let post_cracking = given.post_cracking * initial;
            BackboneSide {
                cracking: Corner {
                    deformation: given.cracking,
                    force,
                },
                yielding: Corner {
                    deformation: given.yielding,
                    force: force + post_cracking * (given.yielding - given.cracking),
                },
                post_cracking,
                post_yield: given.post_yield * initial,
                residual: 0.0,
            }
        };
        Self::finite(initial, [side(positive), side(negative)])
    }

    /// Rejects numbers whose magnitudes are too far apart for the curve.
    fn finite(initial: f64, sides: [BackboneSide; 2]) -> Result<Self, Vec<SpringFault>> {
        let faults: Vec<_> = Side::BOTH
            .into_iter()
            .zip(&sides)
            .filter(|(_, side)| {
                let [c, y] = [side.cracking, side.yielding];
                let usable = |value: f64| value.is_normal() && value < 1e150;
                let all = [c.deformation, c.force, y.deformation, y.force];
                !(all.into_iter().all(usable) && usable(side.post_cracking))
            })
            .map(|(side, _)| SpringFault {
                quantity: Quantity::Initial,
                side: Some(side),
                problem: format!("does not go together with the other values: a stiffness of {initial:e} with these corners is out of range"),
            })
            .collect();
        if faults.is_empty() {
            Ok(Self { initial, sides })
        } else {
            Err(faults)
        }
    }

    /// Initial stiffness \[N·m/rad or N/m\].
    #[must_use]
    pub fn initial(&self) -> f64 {
        self.initial
    }

    /// Yield force, that of the stronger side \[N·m or N\].
    #[must_use]
    pub fn yield_force(&self) -> f64 {
        self.sides[0]
            .yielding
            .force
            .max(self.sides[1].yielding.force)
    }

    /// One side, in magnitudes.
    #[must_use]
    pub fn side(&self, side: Side) -> &BackboneSide {
        &self.sides[side.index()]
    }

    /// Force on first loading to a deformation, with their signs.
    #[must_use]
    pub fn force_at(&self, deformation: f64) -> f64 {
        let side = Side::from_change(deformation);
        side.sign() * self.side(side).force_at(deformation.abs())
    }

    /// The same deformations under forces times a factor > 0 \[–\].
    #[must_use]
    pub(super) fn times(&self, factor: f64) -> Self {
        let corner = |corner: Corner| Corner {
            force: factor * corner.force,
            ..corner
        };
        Self {
            initial: factor * self.initial,
            sides: self.sides.map(|side| BackboneSide {
                cracking: corner(side.cracking),
                yielding: corner(side.yielding),
                post_cracking: factor * side.post_cracking,
                post_yield: factor * side.post_yield,
                residual: factor * side.residual,
            }),
        }
    }

    /// The curve with exchanged sides: the same spring seen from its other end.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            initial: self.initial,
            sides: [self.sides[1], self.sides[0]],
        }
    }

    /// Whether both sides have one corner only.
    #[must_use]
    pub fn is_bilinear(&self) -> bool {
        self.sides
            .iter()
            .all(|side| side.cracking.deformation == side.yielding.deformation)
    }
}

fn validate(initial: f64, sides: [&Corners; 2]) -> Result<(), Vec<SpringFault>> {
    let mut faults = Vec::new();
    if !(initial.is_finite() && initial > 0.0) {
        faults.push(SpringFault {
            quantity: Quantity::Initial,
            side: None,
            problem: format!("must be a finite stiffness greater than zero, found {initial}"),
        });
    }
    for (side, given) in Side::BOTH.into_iter().zip(sides) {
        let mut require = |good: bool, quantity, problem: String| {
            if !good {
                faults.push(SpringFault {
                    quantity,
                    side: Some(side),
                    problem,
                });
            }
        };
        let Corners {
            cracking,
            yielding,
            post_cracking,
            post_yield,
        } = *given;
        let cracks = cracking.is_finite() && cracking > 0.0;
        require(
            cracks,
            Quantity::Cracking,
            "must be greater than zero".to_owned(),
        );
        let yields = yielding.is_finite() && yielding > 0.0;
        require(
            yields,
            Quantity::Yielding,
            "must be greater than zero".to_owned(),
        );
        if cracks && yields {
            require(
                yielding >= cracking,
                Quantity::Yielding,
                format!(
                    "must not be less than cracking, found {:.4} times it",
                    yielding / cracking
                ),
            );
        }
        let softens = post_cracking > 0.0 && post_cracking <= 1.0;
        require(
            softens,
            Quantity::PostCracking,
            format!(
                "must be greater than 0 and at most 1, a ratio to the initial stiffness; found {post_cracking}"
            ),
        );
        require(
            (0.0..=1.0).contains(&post_yield),
            Quantity::PostYield,
            format!(
                "must lie between 0 and 1, a ratio to the initial stiffness; found {post_yield}"
            ),
        );
        if softens && post_yield <= 1.0 {
            require(
                post_yield <= post_cracking,
                Quantity::PostYield,
                format!(
                    "must not exceed post_cracking ({post_cracking}), found {post_yield}: stiffness falls from corner to corner"
                ),
            );
        }
    }
    if faults.is_empty() {
        Ok(())
    } else {
        Err(faults)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: Corners = Corners {
        cracking: 100.0,
        yielding: 250.0,
        post_cracking: 0.3,
        post_yield: 0.02,
    };

    #[test]
    fn forces_and_deformations_give_the_same_curve() {
        let by_force = Backbone::from_forces(1e5, SOUND, SOUND).expect("sound");
        let corners = Corners {
            cracking: 0.001,
            yielding: 0.006,
            ..SOUND
        };
        let by_deformation = Backbone::from_deformations(1e5, corners, corners).expect("sound");
        for deformation in [-0.02, -0.006, -0.002, 0.0, 0.0005, 0.001, 0.003, 0.01] {
            let (a, b) = (
                by_force.force_at(deformation),
                by_deformation.force_at(deformation),
            );
            assert!((a - b).abs() < 1e-10, "{a} and {b} at {deformation}");
        }
        assert!((by_force.force_at(0.003) - 160.0).abs() < 1e-10);
        assert!((by_force.force_at(-0.012) + 262.0).abs() < 1e-10);
    }

    #[test]
    fn every_fault_is_named_at_once() {
        let bad = Corners {
            cracking: -1.0,
            yielding: f64::NAN,
            post_cracking: 1.5,
            post_yield: -0.1,
        };
        let faults = Backbone::from_forces(0.0, bad, SOUND).expect_err("unsound");
        let found: Vec<_> = faults.iter().map(|fault| fault.quantity).collect();
        assert_eq!(
            found,
            [
                Quantity::Initial,
                Quantity::Cracking,
                Quantity::Yielding,
                Quantity::PostCracking,
                Quantity::PostYield
            ]
        );
        let reversed = Corners {
            cracking: 300.0,
            post_yield: 0.4,
            ..SOUND
        };
        let faults = Backbone::from_forces(1e5, SOUND, reversed).expect_err("unsound");
        assert!(
            faults
                .iter()
                .all(|fault| fault.side == Some(Side::Negative))
        );
        assert_eq!(faults.len(), 2, "{faults:?}");
    }
}
