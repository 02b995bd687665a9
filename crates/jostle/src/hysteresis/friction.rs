//! Friction whose strength depends on the speed of sliding, behind an elastic spring.
//!
//! The strength is F_fast − (F_fast − F_slow) e^(−a|v|). Within a step the force is the elastic trial, cut at the strength for
//! the velocity at the end of the step. A step that slips at its start and turns sticks from the turn on, with the strength at
//! rest: otherwise it would stick with the strength of its start, an error of first order (theory, Eq. B3).

use super::memory::HysteresisMemory;

/// Motion of a spring over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rates {
    /// Rate of the deformation at the start \[m/s\].
    pub before: f64,
    /// The same at the end \[m/s\].
    pub after: f64,
    /// Change of the rate at the end per deformation at the end, > 0 \[1/s\].
    pub per_deformation: f64,
    /// Length of the step \[s\].
    pub step: f64,
}

/// Strengths \[N\] at rest and at high speed, and the rate between them \[s/m\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Strength {
    pub(super) slow: f64,
    pub(super) fast: f64,
    pub(super) rate: f64,
}

/// Forces within this of the strength slip \[–\].
pub(super) const SLIPS: f64 = 1e-9;

impl Strength {
    /// At a speed, and its derivative by the speed \[N, N·s/m\].
    #[inline]
    pub(super) fn at(&self, speed: f64) -> [f64; 2] {
        let missing = (self.fast - self.slow) * libm::exp(-self.rate * speed);
        [self.fast - missing, self.rate * missing]
    }

    /// Force and tangent by the deformation at its end, of a step from the committed deformation.
    #[inline]
    pub(super) fn answer(
        &self,
        stiffness: f64,
        memory: &HysteresisMemory,
        deformation: f64,
        rates: &Rates,
    ) -> [f64; 2] {
        let change = deformation - memory.deformation;
        let side = 1.0_f64.copysign(memory.force);
        let slipped = side * rates.before > 0.0
            && memory.force.abs() >= (1.0 - SLIPS) * self.at(rates.before.abs())[0];
        let turned = slipped && side * rates.after < 0.0;
        let (trial, slope) = if turned {
            // Share of the step up to the turn.
            let share = rates.before / (rates.before - rates.after);
            let until = 0.5 * rates.before * share * rates.step;
            (
                side * self.slow + stiffness * (change - until),
                stiffness * (1.0 - 0.5 * rates.step * rates.per_deformation * share * share),
            )
        } else {
            (memory.force + stiffness * change, stiffness)
        };
        let [strength, by_speed] = self.at(rates.after.abs());
        if trial.abs() <= strength {
            return [trial, slope.max(0.0)];
        }
        let slides = trial * rates.after > 0.0;
        let tangent = if slides {
            rates.per_deformation * by_speed
        } else {
            0.0
        };
        [strength.copysign(trial), tangent]
    }
}
