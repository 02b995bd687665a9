//! Braces that buckle: a strut with a plastic hinge in the middle, the idea of physical theory models (Ikeda and Mahin, 1984).
//!
//! Once buckled, the strut of length *L* is two straight halves with a kink between them. Its hinge bears the moment
//! *M* = *Mp* (1 − *n²*), *n* = *N*/*Ny*. In units of *a* = *Mp*/*Ny*, the kink alone bows the middle by *x*, the force bends the
//! halves, and equilibrium of the hinge gives the bow under compression and under tension
//!
//! ```text
//! y = x / (1 − c n) = (1 − n²) / n   compression        y = x / (1 + c n) = (1 − n²) / n   tension
//! ```
//!
//! with *c* = π² λ² / 12, λ² = *Ny*/*NE* and Euler's force *NE*. The bow shortens the strut by e₀ y², e₀ = 2 a²/(K² L), and hinges that turn under
//! force shorten or lengthen it by e₀ ∫ 4 *n* d*x* (flow rule of the parabola): straightened braces have grown.
//!
//! While the kink stays, the strut is elastic, on two straight lines that meet at zero force. Pressed, it buckles at its buckling
//! force and the kink grows; pulled, the kink shrinks until the strut is straight and yields. Both curves are polygons through the same
//! kinks, [`PARTS`] of them, whose corners lie on the equations above.

use super::backbone::{Backbone, Corner, Corners, Quantity, Side, SpringFault};
use super::memory::{Branch, HysteresisMemory, Response};
use super::rule::{Hysteresis, HysteresisRule};

/// Chords of the curves after buckling, each ending at a lower force by the same ratio; the last at a tenth of the first.
const PARTS: usize = 12;
/// Ratio of compressions at the ends of a chord: 0.1^(1/11) \[–\].
const RATIO: f64 = 0.811_130_830_789_687_5;
/// A point before the end of a chord stays this far from it, as a share of the chord \[–\].
const BEFORE_END: f64 = 1e-12;

/// How a brace buckles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Buckling {
    /// Buckling force over yield force, 0…1 \[–\].
    share: f64,
    /// c = π² λ²/12 \[–\].
    softness: f64,
    /// e₀ \[m\].
    shortening: f64,
    /// Share of the buckling force in later cycles \[–\].
    later: f64,
    /// Compression at the end of the first chord, over yield force \[–\].
    first: f64,
}

/// Numbers of a brace that buckles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BucklingBrace {
    /// Axial force per elongation, > 0 \[N/m\].
    pub stiffness: f64,
    /// Force at yield, > 0 \[N\].
    pub yield_force: f64,
    /// Stiffness after yield in tension over the initial one, ≥ 0 and < 1 \[–\].
    pub post_yield: f64,
    /// Force at first buckling, > 0, less than yield and Euler's force \[N\].
    pub buckling_force: f64,
    /// Share of it at which a brace buckles again after it was straightened, > 0 and ≤ 1 \[–\].
    pub later: f64,
    /// λ = √(Ny/NE), > 0 \[–\].
    pub slenderness: f64,
    /// 2 (Mp/Ny)² / (K² L) with the plastic moment Mp, the factor K of the effective length and the length L, > 0 \[m\].
    pub shortening: f64,
}

impl Hysteresis {
    /// A brace that buckles in compression, straightens and yields in tension. The theory stands at [`Buckling`].
    ///
    /// # Errors
    /// Numbers out of range.
    pub fn buckling(brace: BucklingBrace) -> Result<Self, Vec<SpringFault>> {
        let BucklingBrace {
            stiffness,
            yield_force,
            post_yield,
            buckling_force,
            later,
            slenderness,
            shortening,
        } = brace;
        let tension = Corners::bilinear(yield_force, post_yield);
        let compression = Corners::bilinear(buckling_force, 0.0);
        let backbone = Backbone::from_forces(stiffness, tension, compression)?;
        let share = buckling_force / yield_force;
        let euler = 1.0 / (slenderness * slenderness);
        let problem = if !(slenderness.is_finite() && slenderness > 0.0) {
            Some(format!(
                "needs a slenderness greater than zero, found {slenderness}"
            ))
        } else if !(shortening.is_finite() && shortening > 0.0) {
            Some(format!(
                "needs a plastic moment greater than zero, found 2 (Mp/Ny)²/(K² L) = {shortening} m"
            ))
        } else if !(later > 0.0 && later <= 1.0) {
            Some(format!("needs 0 < later <= 1, found {later}"))
        } else if post_yield >= 1.0 {
            Some(format!("needs post_yield below 1, found {post_yield}"))
        } else if share > 1.0 {
            Some(format!(
                "needs a buckling force of at most the yield force, found {buckling_force} N and {yield_force} N"
            ))
        } else if share > euler {
            Some(format!(
                "needs a buckling force of at most Euler's force, {} N with this slenderness, found {buckling_force} N",
                euler * yield_force
            ))
        } else {
            None
        };
        if let Some(problem) = problem {
            return Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem,
            }]);
        }
        let mut law = Buckling {
            share,
            softness: std::f64::consts::PI * std::f64::consts::PI / (12.0 * euler),
            shortening,
            later,
            first: share,
        };
        // No chord falls more steeply than the brace is stiff: by the equations alone a stocky brace would snap back.
        let snaps = |law: &Buckling| {
            let strut = Strut::new(&backbone, law, &HysteresisMemory::default());
            (0..PARTS).any(|number| {
                let [from, to] = [number, number + 1].map(|number| strut.node(number));
                let shortened = to.pressed.deformation - from.pressed.deformation
                    + strut.grows(Side::Negative, number, [&from, &to]);
                stiffness * shortened < from.pressed.force - to.pressed.force
            })
        };
        loop {
            law.first *= 0.9;
            if !snaps(&law) {
                break;
            }
        }
        Ok(Self {
            rule: HysteresisRule::Buckling(law),
            backbone,
        })
    }

    /// Whether a brace has ever buckled; `false` for other springs.
    #[must_use]
    pub fn has_buckled(&self, memory: &HysteresisMemory) -> bool {
        matches!(self.rule, HysteresisRule::Buckling(_)) && memory.peaks[1] > 0.0
    }
}

/// A kink, and where the strut stands with it if it has no other plastic deformation.
struct Node {
    /// x \[–\].
    kink: f64,
    /// Where the kink grows, as magnitudes.
    pressed: Corner,
    /// Shortening without force.
    slack: f64,
    /// Where the kink shrinks.
    pulled: Corner,
}

/// A brace in its present state.
struct Strut<'a> {
    law: &'a Buckling,
    stiffness: f64,
    yield_force: f64,
    hardening: f64,
    /// Yield force in tension, as far as it has hardened.
    tension: f64,
    /// Greatest compression over yield force.
    limit: f64,
}

impl<'a> Strut<'a> {
    #[inline]
    fn new(backbone: &Backbone, law: &'a Buckling, memory: &HysteresisMemory) -> Self {
        let tension = backbone.side(Side::Positive);
        let straightened = memory.peaks[0] > 0.0;
        Self {
            law,
            stiffness: backbone.initial(),
            yield_force: tension.yielding.force,
            hardening: tension.post_yield,
            tension: match memory.strength > 0.0 {
                true => memory.strength,
                false => tension.yielding.force,
            },
            limit: match straightened {
                true => law.later * law.share,
                false => law.share,
            },
        }
    }

    /// The corners of both curves with a number: 0 is straight.
    fn node(&self, number: usize) -> Node {
        let stretch = |force: f64| force / self.stiffness;
        if number == 0 {
            let force = self.limit * self.yield_force;
            return Node {
                kink: 0.0,
                pressed: Corner {
                    deformation: stretch(force),
                    force,
                },
                slack: 0.0,
                pulled: Corner {
                    deformation: stretch(self.tension),
                    force: self.tension,
                },
            };
        }
        let (soft, scale) = (self.law.softness, self.law.shortening);
        let on_curve = (1..number).fold(self.law.first, |n, _| n * RATIO);
        let kink = (1.0 - on_curve * on_curve) * (1.0 - soft * on_curve) / on_curve;
        let shortened = |bow: f64| scale * bow * bow;
        let pressed = on_curve.min(self.limit);
        let force = pressed * self.yield_force;
        let pulled = tension_with(kink, soft);
        let pull = pulled * self.yield_force;
        Node {
            kink,
            pressed: Corner {
                deformation: shortened(kink / (1.0 - soft * pressed)) + stretch(force),
                force,
            },
            slack: shortened(kink),
            pulled: Corner {
                deformation: stretch(pull) - shortened(kink / (1.0 + soft * pulled)),
                force: pull,
            },
        }
    }

    /// How much the strut loses or gains in length between two kinks, as its hinge turns under compression or tension.
    fn grows(&self, side: Side, chord: usize, [from, to]: [&Node; 2]) -> f64 {
        let of = |node: &Node, number: usize| match side {
            Side::Negative => node.pressed.force / self.yield_force,
            Side::Positive if number == 0 => 1.0,
            Side::Positive => node.pulled.force / self.yield_force,
        };
        let mean = 0.5 * (of(from, chord) + of(to, chord + 1));
        4.0 * self.law.shortening * mean * (to.kink - from.kink)
    }

    /// Where the strut stands with its present kink: pressed, without force and pulled.
    #[inline]
    fn elastic(&self, memory: &HysteresisMemory) -> [Corner; 3] {
        let [grown, place, _] = memory.offsets;
        let corner = |deformation: f64, force: f64| Corner {
            deformation: grown + deformation,
            force,
        };
        let at = |node: &Node| {
            [
                corner(-node.pressed.deformation, -node.pressed.force),
                corner(-node.slack, 0.0),
                corner(node.pulled.deformation, node.pulled.force),
            ]
        };
        let chord = chord_below(place);
        let from = at(&self.node(chord));
        if place == chord as f64 {
            return from;
        }
        if chord == PARTS {
            let further = self.law.shortening * (place - PARTS as f64);
            return from.map(|corner| Corner {
                deformation: corner.deformation - further,
                ..corner
            });
        }
        let (to, share) = (at(&self.node(chord + 1)), place - chord as f64);
        let between = |a: f64, b: f64| a + share * (b - a);
        [0, 1, 2].map(|i| Corner {
            deformation: between(from[i].deformation, to[i].deformation),
            force: between(from[i].force, to[i].force),
        })
    }

    /// Slope of a straight line from the point without force.
    fn slope(&self, memory: &HysteresisMemory, [zero, end]: [Corner; 2]) -> f64 {
        match memory.offsets[1] > 0.0 {
            true => end.force / (end.deformation - zero.deformation),
            false => self.stiffness,
        }
    }
}

/// Force over yield force at which a kink shrinks: the root of (1 − n²)(1 + c n) = n x between 0 and 1. Newton's method comes from above, where the
/// difference is concave.
fn tension_with(kink: f64, soft: f64) -> f64 {
    let mut n = 1.0;
    for _ in 0..60 {
        let bent = (1.0 - n * n) * (1.0 + soft * n) - n * kink;
        let slope = soft * (1.0 - n * n) - 2.0 * n * (1.0 + soft * n) - kink;
        let next = n - bent / slope;
        if next.partial_cmp(&n) != Some(std::cmp::Ordering::Less) {
            break;
        }
        n = next;
    }
    n
}

/// Number of the corner at or before a place on the curves.
fn chord_below(place: f64) -> usize {
    // Places are at least zero, and far beyond the last corner all are alike.
    (place as usize).min(PARTS)
}

/// Straight line on which the spring moves in one direction, with its end.
struct Line {
    through: Corner,
    slope: f64,
    /// `None` never ends.
    end: Option<(Corner, Next)>,
    /// The way along a chord, if the kink changes on it.
    chord: Option<Chord>,
}

/// Part of a curve on which the kink changes.
#[derive(Clone, Copy)]
struct Chord {
    /// Number of its corner with the smaller kink.
    number: usize,
    /// Deformation from there to the other corner.
    length: f64,
    /// Plastic elongation at its start, and by how much it changes until its end.
    grown: [f64; 2],
}

/// The branch after a line.
#[derive(Clone, Copy)]
enum Next {
    /// The other straight line of the same kink.
    Cross,
    /// The kink starts to change.
    Flow,
    /// The next chord: the place where it starts, and the plastic elongation there.
    Chord(f64, f64),
}

#[inline]
pub(super) fn respond(
    backbone: &Backbone,
    law: &Buckling,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    let towards = Side::from_change(deformation - memory.deformation);
    let sign = towards.sign();
    let mut next = *memory;
    turn_back(&mut next, towards);
    let (mut here, mut work) = (memory.point(), 0.0);
    // Every corner leads to another line, finally tension yield or the last line of compression.
    loop {
        let line = ahead(&Strut::new(backbone, law, &next), &next, here, towards);
        let reached = line
            .end
            .filter(|(end, _)| sign * (deformation - end.deformation) >= 0.0);
        let Some((end, follows)) = reached else {
            let force = line.through.force + line.slope * (deformation - line.through.deformation);
            stand(
                &Strut::new(backbone, law, &next),
                &mut next,
                &line,
                Corner { deformation, force },
            );
            return Response {
                force,
                tangent: line.slope,
                work: work + 0.5 * (force + here.force) * (deformation - here.deformation),
                memory: next,
            };
        };
        work += 0.5 * (end.force + here.force) * (end.deformation - here.deformation);
        here = end;
        enter(backbone, law, &mut next, follows, here, towards);
    }
}

/// Leaves a curve in the opposite direction.
fn turn_back(memory: &mut HysteresisMemory, towards: Side) {
    if memory.branch == Branch::Backbone && memory.side != towards {
        memory.branch = Branch::Unloading;
    }
}

/// The line on which the spring moves towards a side; it is on no curve of the opposite direction.
fn ahead(strut: &Strut<'_>, memory: &HysteresisMemory, here: Corner, towards: Side) -> Line {
    let straight = |through, slope, end| Line {
        through,
        slope,
        end,
        chord: None,
    };
    if memory.branch != Branch::Backbone {
        let [pressed, zero, pulled] = strut.elastic(memory);
        let ahead = towards.sign() * (zero.deformation - here.deformation) > 0.0;
        // The line on this side of zero force, and where it ends.
        let (side, end) = match (towards, ahead) {
            (Side::Negative, false) => (pressed, (pressed, Next::Flow)),
            (Side::Positive, false) => (pulled, (pulled, Next::Flow)),
            (Side::Negative, true) => (pulled, (zero, Next::Cross)),
            (Side::Positive, true) => (pressed, (zero, Next::Cross)),
        };
        return straight(zero, strut.slope(memory, [zero, side]), Some(end));
    }
    let [_, place, anchor] = memory.offsets;
    let at = |corner: Corner, grown: f64| Corner {
        deformation: grown + towards.sign() * corner.deformation,
        force: towards.sign() * corner.force,
    };
    match towards {
        Side::Negative => {
            let number = chord_below(place);
            let from = strut.node(number);
            let start = at(from.pressed, anchor);
            if number == PARTS {
                let chord = Chord {
                    number,
                    length: -strut.law.shortening,
                    grown: [anchor, 0.0],
                };
                return Line {
                    chord: Some(chord),
                    ..straight(start, 0.0, None)
                };
            }
            let to = strut.node(number + 1);
            let lost = -strut.grows(towards, number, [&from, &to]);
            let end = at(to.pressed, anchor + lost);
            let length = end.deformation - start.deformation;
            Line {
                chord: Some(Chord {
                    number,
                    length,
                    grown: [anchor, lost],
                }),
                ..straight(
                    start,
                    (end.force - start.force) / length,
                    Some((end, Next::Chord((number + 1) as f64, anchor + lost))),
                )
            }
        }
        Side::Positive if place == 0.0 => straight(memory.start, strut.hardening, None),
        Side::Positive => {
            let above = chord_below(place);
            if place > PARTS as f64 {
                let end = at(strut.node(PARTS).pulled, anchor);
                let chord = Chord {
                    number: PARTS,
                    length: -strut.law.shortening,
                    grown: [anchor, 0.0],
                };
                return Line {
                    chord: Some(chord),
                    ..straight(end, 0.0, Some((end, Next::Chord(PARTS as f64, anchor))))
                };
            }
            let number = match place == above as f64 {
                true => above - 1,
                false => above,
            };
            let [from, to] = [number, number + 1].map(|number| strut.node(number));
            let gained = strut.grows(towards, number, [&from, &to]);
            let start = at(to.pulled, anchor);
            let end = at(from.pulled, anchor + gained);
            let length = start.deformation - end.deformation;
            Line {
                chord: Some(Chord {
                    number,
                    length,
                    grown: [anchor, gained],
                }),
                ..straight(
                    start,
                    (end.force - start.force) / -length,
                    Some((end, Next::Chord(number as f64, anchor + gained))),
                )
            }
        }
    }
}

/// Notes the kink and the plastic elongation at a point of a line.
fn stand(strut: &Strut<'_>, memory: &mut HysteresisMemory, line: &Line, here: Corner) {
    if memory.branch != Branch::Backbone {
        return;
    }
    let Some(chord) = line.chord else {
        // Tension yield.
        memory.strength = here.force;
        memory.offsets[0] = here.deformation - here.force / strut.stiffness;
        return;
    };
    let along = (here.deformation - line.through.deformation) / chord.length;
    let [grown, change] = chord.grown;
    let number = chord.number as f64;
    if chord.number == PARTS {
        memory.offsets[0] = grown;
        memory.offsets[1] = number + along.max(0.0);
    } else {
        // Along compression from the smaller kink, along tension from the greater one, where it is negative.
        let share = along.abs().min(1.0 - BEFORE_END);
        memory.offsets[0] = grown + share * change;
        memory.offsets[1] = number
            + match memory.side {
                Side::Negative => share,
                Side::Positive => 1.0 - share,
            };
    }
    memory.peaks[1] = memory.peaks[1].max(memory.offsets[1]);
}

/// Changes branch at the end of a line.
fn enter(
    backbone: &Backbone,
    law: &Buckling,
    memory: &mut HysteresisMemory,
    next: Next,
    here: Corner,
    towards: Side,
) {
    match next {
        Next::Cross => {}
        Next::Flow => {
            memory.branch = Branch::Backbone;
            memory.side = towards;
            memory.start = here;
            let strut = Strut::new(backbone, law, memory);
            let [grown, place, _] = memory.offsets;
            let below = chord_below(place);
            let share = place - below as f64;
            // Plastic elongation at the corner where the present chord starts.
            memory.offsets[2] = if below == PARTS || share == 0.0 {
                grown
            } else {
                let [from, to] = [below, below + 1].map(|number| strut.node(number));
                let change = strut.grows(towards, below, [&from, &to]);
                match towards {
                    Side::Negative => grown + share * change,
                    Side::Positive => grown - (1.0 - share) * change,
                }
            };
            if towards == Side::Positive && place > 0.0 {
                memory.peaks[0] = 1.0;
            }
        }
        Next::Chord(place, grown) => {
            memory.offsets = [grown, place, grown];
            memory.peaks[1] = memory.peaks[1].max(place);
            memory.start = here;
        }
    }
}

/// Slope after a reversal at the present point.
pub(super) fn unloading_stiffness(
    backbone: &Backbone,
    law: &Buckling,
    memory: &HysteresisMemory,
) -> f64 {
    let strut = Strut::new(backbone, law, memory);
    let [pressed, zero, pulled] = strut.elastic(memory);
    let end = match memory.force > 0.0 {
        true => pulled,
        false => pressed,
    };
    strut.slope(memory, [zero, end])
}

pub(super) fn next_corner(
    backbone: &Backbone,
    law: &Buckling,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let mut memory = *memory;
    let sign = towards.sign();
    let (start, mut here) = (memory.deformation, memory.point());
    turn_back(&mut memory, towards);
    loop {
        let strut = Strut::new(backbone, law, &memory);
        match ahead(&strut, &memory, here, towards).end {
            None => return sign * f64::INFINITY,
            Some((end, _)) if sign * (end.deformation - start) > 0.0 => return end.deformation,
            // The corner is here.
            Some((end, next)) => {
                enter(backbone, law, &mut memory, next, end, towards);
                here = end;
            }
        }
    }
}
