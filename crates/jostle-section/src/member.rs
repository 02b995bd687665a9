//! From a section to the end of a member, and from there to a hinge.

use jostle::hysteresis::{Backbone, Corner, Corners, Quantity, Side, SpringFault};

use crate::curve::{AnalysisError, MomentCurvature, Options};
use crate::fit::Trilinear;
use crate::formula::{self, Member};
use crate::section::Section;

/// Moment at a member end against its rotation from the chord, for bending in double curvature (both ends equal,
/// the moment vanishing at midspan).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndCurve {
    /// Under positive and under negative moment.
    pub sides: [EndSide; 2],
}

/// One side of it, in magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndSide {
    /// Rotation \[rad\] and moment \[N·m\] at cracking.
    pub cracking: Corner,
    /// At yield.
    pub yielding: Corner,
    /// Slope after yield, ≥ 0 \[N·m/rad\].
    pub post_yield: f64,
}

/// Slope after yield over the initial one in the formulas \[–\].
pub const FORMULA_POST_YIELD: f64 = 0.01;

impl EndCurve {
    /// By formulas of AIJ and Sugano: cracking and yield moments of AIJ, initial stiffness 6 E I / L of the gross
    /// section, secant at yield after Sugano with the shear span L/2, and 1 % after yield.
    ///
    /// `compression` \[N\]; `length` > 0 \[m\].
    #[must_use]
    pub fn by_formula(section: &Section, compression: f64, length: f64, member: Member) -> Self {
        let side = |section: &Section| {
            let initial = 6.0 * section.gross_rigidity() / length;
            let cracking = formula::cracking_aij(section, compression);
            let yielding = formula::yield_aij(section, compression, member);
            let ratio = formula::sugano(section, compression, 0.5 * length);
            EndSide {
                cracking: Corner {
                    deformation: cracking / initial,
                    force: cracking,
                },
                yielding: Corner {
                    deformation: yielding / (ratio * initial),
                    force: yielding,
                },
                post_yield: FORMULA_POST_YIELD * initial,
            }
        };
        let positive = side(section);
        // Equal to the last bit: some rules require it.
        let negative = if section.is_symmetric() {
            positive
        } else {
            side(&section.flipped())
        };
        Self {
            sides: [positive, negative],
        }
    }

    /// By moment–curvature analysis of both sides.
    ///
    /// # Errors
    /// [`AnalysisError`] of the first side that has no usable curve.
    pub fn by_analysis(
        section: &Section,
        compression: f64,
        length: f64,
        options: Options,
    ) -> Result<Self, AnalysisError> {
        let side = |section: &Section| {
            let curve = MomentCurvature::new(section, compression, options)?;
            Ok(Self::side_of(section, &curve.trilinear()?, length))
        };
        let positive = side(section)?;
        let negative = if section.is_symmetric() {
            positive
        } else {
            side(&section.flipped())?
        };
        Ok(Self {
            sides: [positive, negative],
        })
    }

    /// Rotations of a member end from a trilinear curve of moment and curvature.
    ///
    /// Until yield the curvature is integrated along the shear span Ls = L/2, the moment growing in proportion to
    /// the distance from midspan; at yield the bars have also slipped by a strain penetration of
    /// Lsp = 0.022 fy db (MPa, m). After yield the rest of the curvature acts over a plastic hinge of
    /// Lp = 0.08 Ls + Lsp (Paulay and Priestley, 1992) in its middle.
    #[must_use]
    pub fn side_of(section: &Section, curve: &Trilinear, length: f64) -> EndSide {
        let span = 0.5 * length;
        let diameter = section
            .bars
            .iter()
            .fold(0.0_f64, |d, bar| d.max(bar.diameter));
        let slip = 0.022 * 1e-6 * section.steel.yield_strength * diameter;
        let (c, y) = (curve.cracking, curve.yielding);
        // (Ls / M²) ∫ φ m dm, from zero to yield.
        let squares = y.force * y.force - c.force * c.force;
        let cubes = y.force.powi(3) - c.force.powi(3);
        let until_cracking = c.deformation * c.force * c.force / 3.0;
        let until_yield = 0.5 * c.deformation * squares
            + (cubes / 3.0 - 0.5 * c.force * squares) / curve.post_cracking();
        let bent = span * (until_cracking + until_yield) / (y.force * y.force);
        let plastic = 0.08 * span + slip;
        let lever = plastic * (1.0 - 0.5 * plastic / span).max(0.5);
        EndSide {
            cracking: Corner {
                deformation: c.deformation * span / 3.0,
                force: c.force,
            },
            yielding: Corner {
                deformation: bent + y.deformation * slip,
                force: y.force,
            },
            post_yield: curve.post_yield() / lever,
        }
    }

    /// Backbone of the hinge in series with the elastic member that bends by itself.
    ///
    /// `member` is the stiffness 6 E I / L of the member as the frame has it, `initial` that of the hinge before
    /// cracking \[N·m/rad\]. The hinge turns by what the curve turns more than the member: at yield by
    /// θy − My / member; after it hinge and member in series have the slope of the curve.
    ///
    /// # Errors
    /// [`SpringFault`]s when the member alone bends more than the curve allows.
    pub fn hinge(&self, member: f64, initial: f64) -> Result<Backbone, Vec<SpringFault>> {
        let mut faults = Vec::new();
        let sides = Side::BOTH.map(|side| {
            let given = self.sides[side.index()];
            let (c, y) = (given.cracking, given.yielding);
            let opening = c.force / initial;
            let turned = y.deformation - y.force / member;
            if !(turned > opening && y.force > c.force) {
                let problem = if y.force <= c.force {
                    format!(
                        "the section yields at {:.1} kN.m and cracks at {:.1} kN.m: too little reinforcement",
                        1e-3 * y.force, 1e-3 * c.force
                    )
                } else {
                    // The stiffness of the hinge is a multiple of that of the member. Two parts in a hundred more, because
                    // stiffer columns also carry another weight.
                    let wanted = (y.force + c.force * member / initial) / (member * y.deformation);
                    format!(
                        "the elastic member alone turns further than its section does at yield: its stiffness is already that of a cracked section; raise stiffness_factor to {:.2} times its value for this member, or more",
                        0.05 * (20.0 * 1.02 * wanted).ceil()
                    )
                };
                faults.push(SpringFault { quantity: Quantity::Yielding, side: Some(side), problem });
            }
            let after = given.post_yield * member / (member - given.post_yield).max(1e-3 * member);
            let post_cracking = (y.force - c.force) / (turned - opening) / initial;
            Corners {
                cracking: c.force,
                yielding: y.force,
                post_cracking: post_cracking.min(1.0),
                post_yield: (after / initial).min(post_cracking.min(1.0)),
            }
        });
        if !faults.is_empty() {
            return Err(faults);
        }
        Backbone::from_forces(initial, sides[0], sides[1])
    }
}
