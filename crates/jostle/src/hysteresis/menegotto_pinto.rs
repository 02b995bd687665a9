//! Steel whose loops bend smoothly: a bar of a section (Menegotto and Pinto, 1973; Filippou, Popov and Bertero, 1983).
//!
//! From every reversal a curve leads from the initial stiffness k to the line of hardening of its side. Over the deformation x from the
//! reversal to where both lines meet,
//!
//! ```text
//! y = b x + (1 − b) x / (1 + xᴿ)^(1/R),   R = R₀ (1 − cR₁ ξ / (cR₂ + ξ))
//! ```
//!
//! with ξ the distance from there to the greatest deformation of that side so far, in yield deformations. The curve is a polygon of
//! [`LINES`] of its tangents, the first with the slope k and the last on the line of hardening: all springs have straight lines with
//! exact corners. With the slope b + (1 − b) p a tangent cuts the axis at (1 − b) (1 − pᵐ)^(1/m), m = R / (R + 1).
//!
//! A reversal that is turned round on its first line goes back to where it began and continues the curve it had left; the published rule
//! begins another one there, which can lie above.

use super::backbone::{Backbone, Corner, Corners, Quantity, Side, SpringFault};
use super::memory::{Branch, HysteresisMemory, Response};
use super::rule::{Hysteresis, HysteresisRule};

/// Tangents of the polygon beside the first one. It differs from the curve by less than 4·10⁻⁴ of y for exponents from 1.5 on, so by 10⁻³ of
/// the yield force.
const LINES: usize = 48;

/// How the loops of steel bend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MenegottoPinto {
    /// Exponent R₀ of the first curve, ≥ 1; large ones are sharp \[–\].
    pub sharpness: f64,
    /// cR₁: how much of it plastic deformation takes, 0…1 \[–\].
    pub loss: f64,
    /// cR₂: plastic deformation over yield deformation at which half of that is lost, > 0 \[–\].
    pub half: f64,
}

impl MenegottoPinto {
    /// R₀ = 20, cR₁ = 18.5/20, cR₂ = 0.15 (Filippou, Popov and Bertero, 1983).
    pub const USUAL: Self = Self {
        sharpness: 20.0,
        loss: 0.925,
        half: 0.15,
    };

    /// The first number out of range.
    pub(super) fn fault(&self) -> Option<String> {
        let Self {
            sharpness,
            loss,
            half,
        } = *self;
        if !(1.0..=1000.0).contains(&sharpness) {
            return Some(format!(
                "the exponent R0 must lie between 1 and 1000, found {sharpness}"
            ));
        }
        if !(0.0..1.0).contains(&loss) || sharpness * (1.0 - loss) < 1.0 {
            return Some(format!(
                "cR1 must be at least 0 and less than 1, and leave an exponent of 1 or more, found {loss}"
            ));
        }
        (!(half > 0.0 && half.is_finite()))
            .then(|| format!("cR2 must be greater than 0, found {half}"))
    }
}

impl Hysteresis {
    /// A bar of this stiffness \[N/m\] and yield force \[N\], with its slope after yield over the stiffness, ≥ 0 and < 1 \[–\].
    ///
    /// # Errors
    /// Numbers out of range.
    pub fn menegotto_pinto(
        stiffness: f64,
        strength: f64,
        hardening: f64,
        law: MenegottoPinto,
    ) -> Result<Self, Vec<SpringFault>> {
        let corners = Corners::bilinear(strength, hardening);
        let backbone = Backbone::from_forces(stiffness, corners, corners)?;
        let problem = match hardening < 1.0 {
            true => law.fault(),
            false => Some(format!(
                "the slope after yield must be less than that before, found {hardening} times it"
            )),
        };
        match problem {
            None => Ok(Self {
                rule: HysteresisRule::MenegottoPinto(law),
                backbone,
            }),
            Some(problem) => Err(vec![SpringFault {
                quantity: Quantity::Rule,
                side: None,
                problem,
            }]),
        }
    }
}

/// Slope of a tangent between those of the first, 1, and the last, 0: more of them where the curve is nearly straight.
fn slope_of(line: usize) -> f64 {
    let share = line as f64 / LINES as f64;
    let left = 1.0 - share * share.sqrt();
    left * left * left * left
}

/// A curve from a reversal.
#[derive(Clone, Copy)]
struct Curve {
    start: Corner,
    side: Side,
    /// From the reversal to where the elastic line meets that of hardening, with the sign of the side.
    span: f64,
    /// R.
    sharpness: f64,
    stiffness: f64,
    hardening: f64,
}

impl Curve {
    /// Where a tangent cuts the axis, over 1 − b.
    fn intercept(&self, line: usize) -> f64 {
        let m = self.sharpness / (self.sharpness + 1.0);
        let left = 1.0 - libm::pow(slope_of(line), m);
        libm::pow(left.max(0.0), 1.0 / m)
    }

    /// Deformation at the end of a line; infinite for the last.
    fn end(&self, line: usize) -> f64 {
        if line >= LINES {
            return self.side.sign() * f64::INFINITY;
        }
        let risen = self.intercept(line + 1) - self.intercept(line);
        self.start.deformation + self.span * risen / (slope_of(line) - slope_of(line + 1))
    }

    /// Number of the line that goes on from a deformation.
    fn line(&self, deformation: f64) -> usize {
        let x = (deformation - self.start.deformation) / self.span;
        let power = libm::pow(x.max(0.0), self.sharpness);
        let slope = libm::pow(1.0 + power, -(self.sharpness + 1.0) / self.sharpness);
        let left = 1.0 - slope.sqrt().sqrt();
        let guess = libm::cbrt(left * left) * LINES as f64;
        let mut line = (guess as usize).min(LINES);
        let sign = self.side.sign();
        let ends_before = |line: usize| sign * (self.end(line) - deformation) <= 0.0;
        while line > 0 && !ends_before(line - 1) {
            line -= 1;
        }
        while line < LINES && ends_before(line) {
            line += 1;
        }
        line
    }

    fn slope(&self, line: usize) -> f64 {
        let b = self.hardening;
        self.stiffness * (b + (1.0 - b) * slope_of(line))
    }

    fn force(&self, deformation: f64, line: usize) -> f64 {
        let b = self.hardening;
        let x = (deformation - self.start.deformation) / self.span;
        let y = b * x + (1.0 - b) * (slope_of(line) * x + self.intercept(line));
        self.start.force + self.stiffness * self.span * y
    }

    /// Work from one deformation of the curve to a later one.
    fn work(&self, from: f64, to: f64) -> f64 {
        let (mut line, last) = (self.line(from), self.line(to));
        let (mut at, mut sum) = (from, 0.0);
        loop {
            let end = if line < last { self.end(line) } else { to };
            sum += 0.5 * (self.force(at, line) + self.force(end, line)) * (end - at);
            if line >= last {
                return sum;
            }
            at = end;
            line += 1;
        }
    }
}

/// A bar.
struct Bar<'a> {
    law: &'a MenegottoPinto,
    yielding: Corner,
    stiffness: f64,
    hardening: f64,
}

impl<'a> Bar<'a> {
    fn new(backbone: &Backbone, law: &'a MenegottoPinto) -> Self {
        let curve = backbone.side(Side::Positive);
        Self {
            law,
            yielding: curve.yielding,
            stiffness: backbone.initial(),
            hardening: curve.post_yield / backbone.initial(),
        }
    }

    /// The curve from a point to a side whose greatest deformation so far is known.
    fn curve(&self, start: Corner, side: Side, known: f64) -> Curve {
        let (k, b, sign) = (self.stiffness, self.hardening, side.sign());
        let Corner { deformation, force } = self.yielding;
        // The line of hardening at the reversal, and how fast the elastic one reaches it.
        let ahead = sign * force + b * k * (start.deformation - sign * deformation) - start.force;
        let span = ahead / (k * (1.0 - b));
        let apart = sign * known.max(deformation) - (start.deformation + span);
        let apart = apart.abs() / deformation;
        Curve {
            start,
            side,
            span,
            sharpness: self.law.sharpness * (1.0 - self.law.loss * apart / (self.law.half + apart)),
            stiffness: k,
            hardening: b,
        }
    }

    /// The first curve to a side.
    fn first(&self, side: Side) -> Curve {
        self.curve(Corner::default(), side, 0.0)
    }

    /// The curve on which a spring is that has left its first line.
    fn present(&self, memory: &HysteresisMemory) -> Curve {
        Curve {
            sharpness: memory.unloading,
            ..self.curve(memory.start, memory.side, 0.0)
        }
    }

    /// The curve back from the furthest point of that.
    fn back(&self, memory: &HysteresisMemory) -> Curve {
        let side = memory.side.opposite();
        self.curve(memory.turn, side, memory.peaks[side.index()])
    }
}

/// Where a deformation leads: force, slope ahead, work from the present one, and the memory there.
fn go(bar: &Bar<'_>, memory: &HysteresisMemory, deformation: f64) -> Response {
    let k = bar.stiffness;
    let from = memory.deformation;
    let towards = Side::from_change(deformation - from);
    // Lines from the furthest point have the initial slope.
    let Corner {
        deformation: origin,
        force: at_origin,
    } = memory.turn;
    let elastic = |to: f64| {
        let force = at_origin + k * (to - origin);
        (force, 0.5 * (memory.force + force) * (to - from))
    };
    let straight = || {
        let (force, work) = elastic(deformation);
        Response {
            force,
            tangent: k,
            work,
            memory: *memory,
        }
    };
    let ahead = |end: f64| towards.sign() * (end - deformation) > 0.0;
    let (curve, joined) = if memory.branch == Branch::Virgin {
        let first = bar.first(towards);
        if ahead(first.end(0)) {
            return straight();
        }
        (first, from)
    } else if towards == memory.side {
        if ahead(origin) {
            return straight();
        }
        (bar.present(memory), origin)
    } else {
        let back = bar.back(memory);
        if ahead(back.end(0)) {
            return straight();
        }
        (back, from)
    };
    // Straight to the curve, then along it.
    let before = if joined == from {
        0.0
    } else {
        elastic(joined).1
    };
    let line = curve.line(deformation);
    let force = curve.force(deformation, line);
    let work = before + curve.work(joined, deformation);
    let mut next = *memory;
    next.branch = Branch::Backbone;
    next.start = curve.start;
    next.side = towards;
    next.unloading = curve.sharpness;
    next.stand_at(deformation, force, towards);
    next.turn = next.point();
    next.peaks = next.extremes;
    Response {
        force,
        tangent: curve.slope(line),
        work,
        memory: next,
    }
}

pub(super) fn respond(
    backbone: &Backbone,
    law: &MenegottoPinto,
    memory: &HysteresisMemory,
    deformation: f64,
) -> Response {
    if deformation == memory.deformation {
        return Response {
            force: memory.force,
            tangent: backbone.initial(),
            work: 0.0,
            memory: *memory,
        };
    }
    go(&Bar::new(backbone, law), memory, deformation)
}

/// Deformation at the end of the line on which it moves to a side.
pub(super) fn next_corner(
    backbone: &Backbone,
    law: &MenegottoPinto,
    memory: &HysteresisMemory,
    towards: Side,
) -> f64 {
    let bar = Bar::new(backbone, law);
    let here = memory.deformation;
    if memory.branch == Branch::Virgin {
        return bar.first(towards).end(0);
    }
    if towards != memory.side {
        return bar.back(memory).end(0);
    }
    let reached = memory.turn.deformation;
    if towards.sign() * (reached - here) > 0.0 {
        return reached;
    }
    let curve = bar.present(memory);
    curve.end(curve.line(here))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 400 MPa, 200 GPa, over an area and a length of one.
    const STRENGTH: f64 = 400e6;
    const YIELD: f64 = 0.002;
    const HARDENING: f64 = 0.015;

    fn bar(law: MenegottoPinto) -> Hysteresis {
        Hysteresis::menegotto_pinto(STRENGTH / YIELD, STRENGTH, HARDENING, law).expect("sound")
    }

    /// The published rule, written anew: it begins a curve at every reversal.
    struct Published {
        law: MenegottoPinto,
        /// Greatest and least strain at reversals.
        most: f64,
        least: f64,
        reversal: [f64; 2],
        meeting: [f64; 2],
        exponent: f64,
        last: [f64; 2],
        up: bool,
    }

    impl Published {
        fn new(law: MenegottoPinto, up: bool) -> Self {
            let sign = if up { 1.0 } else { -1.0 };
            Self {
                law,
                most: YIELD,
                least: -YIELD,
                reversal: [0.0; 2],
                meeting: [sign * YIELD, sign * STRENGTH],
                exponent: law.sharpness,
                last: [0.0; 2],
                up,
            }
        }

        fn stress(&mut self, strain: f64) -> f64 {
            let (modulus, hardened) = (STRENGTH / YIELD, HARDENING * STRENGTH / YIELD);
            if strain != self.last[0] && (strain > self.last[0]) != self.up {
                self.up = !self.up;
                self.reversal = self.last;
                self.most = self.most.max(self.last[0]);
                self.least = self.least.min(self.last[0]);
                let [from, stress] = self.reversal;
                let (sign, target) = if self.up {
                    (1.0, self.most)
                } else {
                    (-1.0, self.least)
                };
                let offset = sign * (STRENGTH - hardened * YIELD);
                let at = (offset - stress + modulus * from) / (modulus - hardened);
                self.meeting = [at, offset + hardened * at];
                let xi = ((target - at) / YIELD).abs();
                self.exponent =
                    self.law.sharpness * (1.0 - self.law.loss * xi / (self.law.half + xi));
            }
            let x = (strain - self.reversal[0]) / (self.meeting[0] - self.reversal[0]);
            let bent = x / (1.0 + x.powf(self.exponent)).powf(1.0 / self.exponent);
            let share = HARDENING * x + (1.0 - HARDENING) * bent;
            let stress = self.reversal[1] + share * (self.meeting[1] - self.reversal[1]);
            self.last = [strain, stress];
            stress
        }
    }

    const TURNS: [f64; 12] = [
        0.004, -0.001, 0.009, -0.012, 0.003, -0.006, 0.02, -0.02, 0.001, -0.015, 0.03, 0.0,
    ];

    fn paths() -> impl Iterator<Item = f64> {
        let starts = [0.0].into_iter().chain(TURNS);
        starts.zip(TURNS).flat_map(|(from, to)| {
            (1..=900).map(move |part| from + (to - from) * f64::from(part) / 900.0)
        })
    }

    /// The polygon keeps within 10⁻³ of the yield force of the published curve over loops of any width.
    #[test]
    fn follows_the_published_rule() {
        let blunt = MenegottoPinto {
            sharpness: 10.0,
            loss: 0.8,
            half: 0.3,
        };
        for law in [MenegottoPinto::USUAL, blunt] {
            let (spring, mut published) = (bar(law), Published::new(law, true));
            let (mut memory, mut worst) = (HysteresisMemory::default(), 0.0_f64);
            for strain in paths() {
                memory = spring.respond(&memory, strain).memory;
                worst = worst.max((memory.force() - published.stress(strain)).abs());
            }
            assert!(
                worst < 1e-3 * STRENGTH,
                "{law:?}: {:e} of the strength apart",
                worst / STRENGTH
            );
        }
    }

    /// A small reversal leaves no trace.
    #[test]
    fn small_reversals_are_forgotten() {
        let bar = bar(MenegottoPinto::USUAL);
        let mut with = bar.respond(&HysteresisMemory::default(), 0.008).memory;
        let without = bar.respond(&with, 0.012).memory;
        for strain in [0.0078, 0.0079, 0.00775] {
            with = bar.respond(&with, strain).memory;
        }
        assert_eq!(bar.respond(&with, 0.012).memory, without);
    }

    /// Work is the integral of the force, whether the way is taken at once or in small parts, and loops dissipate.
    #[test]
    fn work_is_the_area_under_the_force() {
        let bar = bar(MenegottoPinto::USUAL);
        let (mut once, mut sum_once) = (HysteresisMemory::default(), 0.0);
        let (mut parts, mut sum_parts) = (HysteresisMemory::default(), 0.0);
        let mut from = 0.0;
        for to in TURNS {
            let whole = bar.respond(&once, to);
            sum_once += whole.work;
            once = whole.memory;
            for part in 1..=20_000 {
                let share = f64::from(part) / 20_000.0;
                let before = parts.force();
                let at = if part == 20_000 {
                    to
                } else {
                    (1.0 - share) * from + share * to
                };
                let change = at - parts.deformation();
                parts = bar.respond(&parts, at).memory;
                sum_parts += 0.5 * (before + parts.force()) * change;
            }
            assert_eq!(once, parts, "to {to}");
            let close = 1e-6 * STRENGTH * YIELD;
            assert!(
                (sum_once - sum_parts).abs() < close,
                "{sum_once} {sum_parts}"
            );
            from = to;
        }
        assert!(sum_once - bar.recoverable_energy(&once) > 0.1 * STRENGTH * 0.1);
    }

    /// Between two corners the force is a straight line whose slope is the tangent at its start.
    #[test]
    fn corners_bound_straight_lines() {
        let bar = bar(MenegottoPinto::USUAL);
        let mut memory = HysteresisMemory::default();
        let mut corners = 0;
        for turn in TURNS {
            let towards = Side::from_change(turn - memory.deformation());
            loop {
                let corner = bar.next_corner(&memory, towards);
                let end = match towards {
                    Side::Positive => corner.min(turn),
                    Side::Negative => corner.max(turn),
                };
                let here = memory;
                let middle = bar.respond(&here, 0.5 * (here.deformation() + end));
                memory = bar.respond(&here, end).memory;
                let expected = 0.5 * (here.force() + memory.force());
                assert!(
                    (middle.force - expected).abs() < 1e-9 * STRENGTH,
                    "towards {end}"
                );
                let rise = middle.tangent * (end - here.deformation());
                assert!(
                    (memory.force() - here.force() - rise).abs() < 1e-8 * STRENGTH,
                    "towards {end}"
                );
                if end == turn {
                    break;
                }
                corners += 1;
            }
        }
        assert!(corners > 5 * LINES, "{corners}");
    }
}
