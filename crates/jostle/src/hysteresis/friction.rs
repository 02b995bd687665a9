//! Friction whose strength depends on the speed of sliding, behind an elastic spring.
//!
//! The strength is F_fast − (F_fast − F_slow) e^(−a|v|). Within a step the force is the elastic trial, cut at the strength for
//! the velocity at the end of the step. A step that turns sticks from the turn on, with the strength at rest there if the spring
//! would have more: otherwise it would keep the strength of its start, an error of first order, and a force between both strengths
//! would never slip (theory, Eq. B3).

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
        let elastic = memory.force + stiffness * change;
        let turns = side * rates.before > 0.0 && side * rates.after < 0.0;
        let (trial, slope) = if turns {
            // Share of the step up to the turn, where the force is that of the spring or the strength at rest, whichever is less.
            let share = rates.before / (rates.before - rates.after);
            let until = 0.5 * rates.before * share * rates.step;
            if side * (memory.force + stiffness * until) > self.slow {
                (
                    side * self.slow + stiffness * (change - until),
                    stiffness * (1.0 - 0.5 * rates.step * rates.per_deformation * share * share),
                )
            } else {
                (elastic, stiffness)
            }
        } else {
            (elastic, stiffness)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Force at the end of a sway u = a sin ωt of the deformation over one and a half periods, in steps of equal length.
    fn after(strength: Strength, stiffness: f64, amplitude: f64, steps: u32) -> f64 {
        let omega = 2.0;
        let step = 1.5 * std::f64::consts::TAU / omega / f64::from(steps);
        let at = |k: u32| (omega * step * f64::from(k)).sin_cos();
        let mut memory = HysteresisMemory::default();
        for k in 1..=steps {
            let rates = Rates {
                before: omega * amplitude * at(k - 1).1,
                after: omega * amplitude * at(k).1,
                per_deformation: 2.0 / step,
                step,
            };
            let deformation = amplitude * at(k).0;
            memory.force = strength.answer(stiffness, &memory, deformation, &rates)[0];
            memory.deformation = deformation;
        }
        memory.force
    }

    /// Sways that reach a force between the strengths at rest and at speed hold until they are slow, and slip before they turn.
    #[test]
    fn a_force_between_both_strengths_slips_at_a_turn() {
        let strength = Strength {
            slow: 1.0,
            fast: 1.5,
            rate: 5.0,
        };
        for reached in [0.9, 1.001, 1.002, 1.004, 1.1, 1.3, 2.0] {
            let of = |steps| after(strength, 10.0, 0.1 * reached, steps);
            let exact = of(1_000_000);
            let error = [200, 400, 800].map(|steps| (of(steps) - exact).abs());
            assert!(error[2] < 2e-4, "{reached}: {error:?}");
            assert!(
                error[2] < 1e-9 || error[2] < 0.35 * error[1] && error[1] < 0.35 * error[0],
                "{reached}: {error:?}"
            );
        }
    }
}
