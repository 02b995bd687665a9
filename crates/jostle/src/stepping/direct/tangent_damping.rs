//! Damping in proportion to the tangents of springs that yield: at the ends of their lines its force jumps, and accelerations with
//! it. Steps end there.

use super::Direct;
use crate::hysteresis::Rates;
use crate::stepping::events::{Cubic, bisect};
use crate::stepping::runner::RunState;
use crate::structure::YieldingSpring;

impl Direct {
    /// Share of the tried step at which the dashpot beside a spring first changes on the way, if one does: not where a spring turns
    /// back, since its rate is zero there.
    pub(super) fn first_damping_jump(&self, run: &RunState<'_>, step: f64) -> Option<f64> {
        if !self.yielding.damped_by_tangents {
            return None;
        }
        let mut first: Option<f64> = None;
        for building in &run.system.buildings {
            let (equations, range) = (&building.equations, building.spring_range());
            let memories = &self.state.springs[range.clone()];
            let springs = equations.springs.iter().zip(memories);
            for ((spring, memory), trial) in springs.zip(&self.yielding.trials[range]) {
                if !spring.damped_by_tangent
                    || equations.tangent_dashpot(spring, trial.next_tangent) == trial.dashpot
                {
                    continue;
                }
                let start = memory.deformation();
                let before = trial.rates.before;
                let after = trial.rates_to(memory, trial.reached).after;
                if before * (trial.reached - start) <= 0.0 {
                    continue;
                }
                let curve = Cubic::new(start, before, trial.reached, after, step);
                let jumped = |share: f64| {
                    let [_, tangent] =
                        spring
                            .hysteresis
                            .answer(memory, curve.value(share), &Rates::default());
                    equations.tangent_dashpot(spring, tangent) != trial.dashpot
                };
                if !jumped(1.0) {
                    continue;
                }
                let at = bisect(0.0, 1.0, jumped);
                first = Some(first.map_or(at, |first| first.min(at)));
            }
        }
        first
    }

    /// Gives dashpots beside springs their coefficients of now, at the end of an accepted step: M Δa = −g Δc ġ. Where a part without
    /// mass feels it, its rate would jump too; there the new coefficient acts from the next step on.
    pub(super) fn jump_dashpots(&mut self, run: &RunState<'_>) {
        let mut jumped = false;
        for building in &run.system.buildings {
            let (range, equations) = (building.range(), &building.equations);
            let springs = building.spring_range();
            let velocity = &self.state.velocity[range.clone()];
            let tangents = &self.yielding.tangents[springs.clone()];
            let trials = self.yielding.trials[springs.clone()].iter().zip(tangents);
            let known = trials.zip(&mut self.yielding.damped[springs]);
            for (spring, ((trial, tangent), damped)) in equations.springs.iter().zip(known) {
                let change = equations.tangent_dashpot(spring, *tangent) - trial.dashpot;
                if change == 0.0 || !is_held_by_masses(spring, &equations.mass) {
                    continue;
                }
                let change = change * spring.deformation(velocity);
                *damped += change;
                for &(dof, share) in spring.row.entries() {
                    self.state.acceleration[range.start + dof] -=
                        share * change / equations.mass[dof];
                }
                jumped = true;
            }
        }
        if jumped {
            let ground = run.grounds_at(0);
            self.observer.after_jump(&self.state, ground);
        }
    }
}

/// Whether all that a spring holds has mass, so that a jump of its force is one of accelerations alone.
pub(super) fn is_held_by_masses(spring: &YieldingSpring, mass: &[f64]) -> bool {
    spring.row.dofs().all(|dof| mass[dof] > 0.0)
}
