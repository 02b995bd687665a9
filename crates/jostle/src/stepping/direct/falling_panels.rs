//! Infill panels that fall out: steps end where the acceleration across their plane reaches what they bear, and their struts lose
//! their force there.

use super::tangent_damping::is_held_by_masses;
use super::{AFTER_JUMP, Direct};
use crate::history::SpringEvent;
use crate::hysteresis::Stage;
use crate::stepping::runner::RunState;

impl Direct {
    /// Share of the tried step at which a panel first falls; accelerations are straight lines over a step.
    pub(super) fn first_fall(&self, run: &RunState<'_>) -> Option<f64> {
        let mut first: Option<f64> = None;
        for (index, building) in run.system.buildings.iter().enumerate() {
            if building.falling_panels.is_empty() {
                continue;
            }
            let memories = &self.state.springs[building.spring_range()];
            let factors = &self.factors[self.tried];
            let (k, shift) = (factors.coefficients, factors.buildings[index].shift);
            let now = |dof: usize| self.state.acceleration[building.offset + dof];
            let end = |dof: usize| {
                let dof = building.offset + dof;
                let (v, a) = (self.state.velocity[dof], self.state.acceleration[dof]);
                let change = self.increment[dof] - shift * (k.d_v * v + k.d_a * a);
                a + k.a * change + (k.b_v * v + k.b_a * a)
            };
            let grounds = [0, 1].map(|time| run.grounds_at(time).of(index));
            let panels = building.falling_panels.iter();
            for panel in panels.filter(|panel| panel.stands(memories)) {
                let before = panel.accelerations(grounds[0], now);
                let after = panel.accelerations(grounds[1], end);
                for (before, after) in before.into_iter().zip(after) {
                    let at = match (before.abs() >= panel.limit, after.abs() >= panel.limit) {
                        (true, _) => 0.0,
                        (false, true) => {
                            let reached = after.signum() * panel.limit;
                            (reached - before) / (after - before)
                        }
                        (false, false) => continue,
                    };
                    first = Some(first.map_or(at, |first| first.min(at)));
                }
            }
        }
        first
    }

    /// Takes out panels whose acceleration is what they bear now, at the end of an accepted step: M Δa = gᵀF, and the energy of their
    /// struts is lost. Where a part without mass feels a strut, its force falls over the next step, which is short.
    pub(super) fn drop_panels(&mut self, run: &RunState<'_>) {
        let mut jumped = false;
        for (index, building) in run.system.buildings.iter().enumerate() {
            let ground = run.grounds_at(0).of(index);
            let (range, first) = (building.range(), building.spring_offset);
            for panel in &building.falling_panels {
                let memories = &self.state.springs[building.spring_range()];
                let now = |dof: usize| self.state.acceleration[range.start + dof];
                let [below, above] = panel.accelerations(ground, now);
                if !panel.stands(memories) || below.abs().max(above.abs()) < panel.limit {
                    continue;
                }
                for strut in &panel.struts {
                    let (spring, global) = (&building.equations.springs[*strut], first + strut);
                    spring.hysteresis.remove(&mut self.state.springs[global]);
                    self.yielding.tangents[global] = 0.0;
                    self.yielding.events.push(SpringEvent {
                        spring: global,
                        stage: Stage::Gone,
                        time: run.time,
                    });
                    if !is_held_by_masses(spring, &building.equations.mass) {
                        self.struck_steps = AFTER_JUMP;
                        continue;
                    }
                    let lost = std::mem::take(&mut self.yielding.balanced[global]);
                    for &(dof, share) in spring.row.entries() {
                        let mass = building.equations.mass[dof];
                        self.state.acceleration[range.start + dof] += share * lost / mass;
                    }
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
