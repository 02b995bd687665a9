//! A contact law written as a formula in indentation, rate and impact speed: `formula`.

mod parse;
mod step;

use std::fmt;

use super::force_law::ContactResponse;
pub use parse::FormulaError;
use step::{Depths, Dual, Step};

/// Greatest number of values and operations of a formula.
const MOST_STEPS: usize = 48;
/// Greatest number of values that wait for their operation at a time.
const MOST_WAITING: usize = 12;
/// Greatest number of constants of a formula.
const MOST_CONSTANTS: usize = 12;

/// Force of a contact as a formula in SI, such as `k * d^1.5 * (1 + 0.6 * v / v0)`.
///
/// Names: `d` indentation > 0 \[m\], `v` its rate \[m/s\], `v0` impact speed > 0 \[m/s\], `k` contact stiffness of the gap, `e` its
/// coefficient of restitution \[–\], `m` effective mass m₁m₂/(m₁ + m₂) \[kg\]. Operations: `+ - * / ^ < >`; functions: `sqrt`,
/// `abs`, `exp`, `ln`, `tanh`, `min`, `max`, and `if(condition, force, other force)`. A negative force is cut at zero.
///
/// ```
/// use jostle::contact::Formula;
///
/// let formula = Formula::parse("k * d^1.5 * (1 + 0.6 * v / v0)").unwrap();
/// assert!(formula.is_hertzian()); // k is in N/m^1.5
/// assert_eq!(formula.to_string(), "k*d^1.5*(1 + 0.6*v/v0)");
/// assert_eq!(Formula::parse("k * dd").unwrap_err().to_string(), "\"dd\" is no name of a formula; use d, v, v0, k, e or m");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formula {
    /// Values and operations, each operation after what it acts on.
    steps: [Step; MOST_STEPS],
    length: u8,
    constants: [f64; MOST_CONSTANTS],
    /// Part of the contact that a point of it bears \[–\].
    share: f64,
}

/// A formula between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FormulaLaw {
    formula: Formula,
    /// Contact stiffness of the whole contact \[N/m, N/m^1.5\].
    pub stiffness: f64,
    /// Coefficient of restitution \[–\].
    restitution: f64,
    /// m₁m₂/(m₁ + m₂) of the whole contact \[kg\].
    effective_mass: f64,
}

/// What a formula's names stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Name {
    Indentation,
    Rate,
    ImpactSpeed,
    Stiffness,
    Restitution,
    EffectiveMass,
}

impl Name {
    const ALL: [(Self, &'static str); 6] = [
        (Self::Indentation, "d"),
        (Self::Rate, "v"),
        (Self::ImpactSpeed, "v0"),
        (Self::Stiffness, "k"),
        (Self::Restitution, "e"),
        (Self::EffectiveMass, "m"),
    ];
}

impl Formula {
    /// Reads a formula.
    ///
    /// # Errors
    /// What is wrong with the text, or that the formula does not use `d` and `k`.
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        parse::parse(text)
    }

    fn steps(&self) -> &[Step] {
        &self.steps[..usize::from(self.length)]
    }

    fn uses(&self, name: Name) -> bool {
        self.steps().contains(&Step::Name(name))
    }

    /// Whether it contains the coefficient of restitution.
    #[must_use]
    pub fn uses_restitution(&self) -> bool {
        self.uses(Name::Restitution)
    }

    /// Whether it contains the masses of the two bodies.
    #[must_use]
    pub fn uses_masses(&self) -> bool {
        self.uses(Name::EffectiveMass)
    }

    /// Whether the force grows with δ^1.5 when both bodies rest, so that `k` is in N/m^1.5 rather than in N/m.
    #[must_use]
    pub fn is_hertzian(&self) -> bool {
        let law = self.between(1.0, 1.0, 1.0);
        let force = |indentation| law.value(indentation, 0.0, 1.0).value;
        (libm::log2(force(2e-3) / force(1e-3)) - 1.5).abs() < 0.01
    }

    /// The formula of a point that bears a share of the contact.
    pub(super) fn shared(self, share: f64) -> Self {
        Self {
            share: self.share * share,
            ..self
        }
    }

    /// The law between two bodies; stiffness and mass are those of this point's share.
    pub(super) fn between(self, stiffness: f64, restitution: f64, mass: f64) -> FormulaLaw {
        FormulaLaw {
            formula: self,
            stiffness: stiffness / self.share,
            restitution,
            effective_mass: mass / self.share,
        }
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&step::written(self))
    }
}

/// Indentations at which a formula is tried \[m\].
const TRIED_DEPTHS: [f64; 2] = [1e-6, 0.1];
/// Number of them, evenly on a scale of logarithms.
const TRIED: u32 = 60;
/// Impact speeds at which it is tried \[m/s\].
const TRIED_SPEEDS: [f64; 5] = [0.01, 0.1, 0.5, 1.0, 3.0];
/// Rates over the impact speed at which it is tried \[–\].
const TRIED_RATES: [f64; 9] = [-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0];
/// A force may fall by this part of itself over an indentation, or rate, that doubles: rounding \[–\].
const FLAT: f64 = 1e-9;

impl FormulaLaw {
    /// Value and derivatives of the formula, neither cut nor shared.
    #[inline]
    fn value(&self, indentation: f64, rate: f64, speed: f64) -> Dual {
        let mut waiting = [Dual::default(); MOST_WAITING];
        let mut count = 0;
        for &step in self.formula.steps() {
            match step {
                Step::Constant(index) => {
                    waiting[count] = Dual::constant(self.formula.constants[usize::from(index)]);
                    count += 1;
                }
                Step::Name(name) => {
                    waiting[count] = match name {
                        Name::Indentation => Dual::new(indentation, 1.0, 0.0),
                        Name::Rate => Dual::new(rate, 0.0, 1.0),
                        Name::ImpactSpeed => Dual::constant(speed),
                        Name::Stiffness => Dual::constant(self.stiffness),
                        Name::Restitution => Dual::constant(self.restitution),
                        Name::EffectiveMass => Dual::constant(self.effective_mass),
                    };
                    count += 1;
                }
                Step::Apply(operation) => {
                    count -= operation.takes();
                    let result = operation.apply(&waiting[count..count + operation.takes()]);
                    waiting[count] = result;
                    count += 1;
                }
            }
        }
        waiting[0]
    }

    #[inline]
    pub(super) fn respond(&self, indentation: f64, rate: f64, speed: f64) -> ContactResponse {
        if indentation <= 0.0 {
            return ContactResponse::default();
        }
        let found = self.value(indentation, rate, speed);
        if found.value <= 0.0 {
            return ContactResponse::default();
        }
        let share = self.formula.share;
        ContactResponse {
            force: share * found.value,
            by_indentation: share * found.by_indentation,
            by_rate: share * found.by_rate,
        }
    }

    /// Force at first contact \[N\].
    pub(super) fn onset(&self, rate: f64) -> f64 {
        let force = self.formula.share
            * self
                .value(0.0, rate, rate.max(super::force_law::SLOWEST))
                .value;
        if force > 0.0 { force } else { 0.0 }
    }

    /// Whether a part of it sets in or ends where the motion reverses.
    pub(super) fn has_corner_at_turn(&self) -> bool {
        let mut steps = self.formula.steps().iter();
        steps.any(|step| matches!(step, Step::Apply(operation) if operation.has_corner()))
    }

    /// Whether the force starts as a root of the indentation, or steeper.
    pub(super) fn starts_steeply(&self) -> bool {
        const SPEED: f64 = 0.3;
        let onset = self.value(0.0, SPEED, SPEED).value;
        let force = |indentation| self.value(indentation, SPEED, SPEED).value - onset;
        libm::log2(force(2e-9) / force(1e-9)) < 0.6
    }

    /// Depth, duration and greatest force of the elastic collision of free bodies, to about one percent: scales.
    fn elastic(&self, effective_mass: f64, impact_speed: f64) -> (f64, f64) {
        let force = |indentation| self.respond(indentation, 0.0, impact_speed).force;
        let mut depths = Depths::new();
        let mut energy = 0.5 * effective_mass * impact_speed * impact_speed;
        let (mut time, mut last) = (0.0, 0.0);
        for [from, to] in &mut depths {
            let middle = force(0.5 * (from + to));
            let end = force(to);
            let taken = (to - from) * (last + 4.0 * middle + end) / 6.0;
            let speed = (2.0 * energy / effective_mass).sqrt();
            if taken >= energy {
                // Stopped here by what is a constant force to this accuracy.
                let mean = taken / (to - from);
                return (2.0 * (time + effective_mass * speed / mean), end);
            }
            energy -= taken;
            let after = (2.0 * energy / effective_mass).sqrt();
            time += 2.0 * (to - from) / (speed + after);
            last = end;
        }
        (2.0 * time, last)
    }

    pub(super) fn elastic_duration(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        self.elastic(effective_mass, impact_speed).0
    }

    pub(super) fn elastic_force(&self, effective_mass: f64, impact_speed: f64) -> f64 {
        self.elastic(effective_mass, impact_speed).1
    }

    /// What makes it unfit for a contact, tried over indentations of 1 µm to 100 mm and impact speeds of 0.01 to 3 m/s: a force
    /// that is no number, that does not push a body at rest back, or that falls as indentation or rate grow, so that
    /// a step has several solutions.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let [least, most] = TRIED_DEPTHS;
        for number in 0..TRIED {
            let part = f64::from(number) / f64::from(TRIED - 1);
            let d = least * libm::pow(most / least, part);
            for v0 in TRIED_SPEEDS {
                for v in TRIED_RATES.map(|share| share * v0) {
                    let found = self.value(d, v, v0);
                    let place = || format!("at d = {d:.1e} m, v = {v} m/s, v0 = {v0} m/s");
                    let Dual {
                        value: force,
                        by_indentation,
                        by_rate,
                    } = found;
                    if ![force, by_indentation, by_rate]
                        .iter()
                        .all(|x| x.is_finite())
                    {
                        return Some(format!("is no number {}", place()));
                    }
                    if v == 0.0 && force <= 0.0 {
                        return Some(format!(
                            "must push where d > 0, also while v = 0; it is {force:.2e} N {}",
                            place()
                        ));
                    }
                    let falls = |slope: f64, over: f64| force > 0.0 && slope * over < -FLAT * force;
                    if falls(by_indentation, d) {
                        return Some(format!(
                            "must not fall as d grows, or a step has several solutions; its slope is {by_indentation:.2e} N/m {}",
                            place()
                        ));
                    }
                    if falls(by_rate, v0) {
                        return Some(format!(
                            "must not fall as v grows, or contacts would gain energy; its slope is {by_rate:.2e} N.s/m {}",
                            place()
                        ));
                    }
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests;
