//! Exact factors of a step of all modes.

use pulp::Arch;

use super::damped::{Damped, Rules};
use super::links::LinkTable;
use super::mode_kernels::{Combine, LANES, Quadratic, Unkept};
use super::reduced::Reduced;
use super::response::{INPUTS, PRODUCTS, Responses};
use super::unit_force::UnitResponse;

/// Exact factors of all modes for one step size, quantity by quantity.
#[derive(Clone, Debug, Default)]
pub(super) struct StepTable {
    pub(super) step: f64,
    /// Of (q₀, q̇₀, p₀, p₁, b) in q₁, q̇₁, ∫q and ∫τq.
    pub(super) displacement: [Vec<f64>; INPUTS],
    pub(super) velocity: [Vec<f64>; INPUTS],
    pub(super) area: [Vec<f64>; INPUTS],
    moment: [Vec<f64>; INPUTS],
    /// Of the products of these in the energy lost by damping: upper triangle row by row; empty without rules.
    pub(super) damped: [Vec<f64>; PRODUCTS],
    /// What unit end forces at the contacts do, and those of links.
    answers: Vec<UnitResponse>,
    pub(super) links: LinkTable,
}

impl StepTable {
    pub(super) fn set(&mut self, reduced: &Reduced, step: f64, rules: Option<&Rules>) {
        self.step = step;
        self.answers
            .resize_with(reduced.unit_forces.len(), UnitResponse::default);
        self.answers.iter_mut().for_each(UnitResponse::forget);
        let lists = self.displacement.iter_mut().chain(&mut self.velocity);
        let lists = lists.chain(&mut self.area).chain(&mut self.moment);
        lists.for_each(|list| list.resize(reduced.modes(), 0.0));
        let asked = rules.map_or(0, |_| reduced.modes());
        self.damped
            .iter_mut()
            .for_each(|list| list.resize(asked, 0.0));
        let modes = reduced
            .damping
            .chunks(LANES)
            .zip(reduced.stiffness.chunks(LANES));
        for (group, (damping, stiffness)) in modes.enumerate() {
            let (first, count) = (group * LANES, damping.len());
            let (damping, stiffness) = (filled(damping), filled(stiffness));
            let responses = Responses::of_several(reduced.arch(), damping, stiffness, step);
            for (lists, rows) in [
                (&mut self.displacement, &responses.displacement),
                (&mut self.velocity, &responses.velocity),
                (&mut self.area, &responses.area),
                (&mut self.moment, &responses.moment),
            ] {
                for (list, row) in lists.iter_mut().zip(rows) {
                    list[first..first + count].copy_from_slice(&row[..count]);
                }
            }
            if let Some(rules) = rules {
                let form = reduced.arch().dispatch(Damped {
                    damping,
                    stiffness,
                    step,
                    responses: &responses,
                    rules,
                });
                for (list, row) in self.damped.iter_mut().zip(&form) {
                    list[first..first + count].copy_from_slice(&row[..count]);
                }
            }
        }
        self.set_links(reduced);
    }

    /// q₁ and q̇₁ of all modes.
    pub(super) fn advance(&self, arch: Arch, of: [&[f64]; INPUTS], end: [&mut [f64]; 2]) {
        let [q1, v1] = end;
        for (factors, out) in [(&self.displacement, q1), (&self.velocity, v1)] {
            arch.dispatch(Combine { factors, of, out });
        }
    }

    /// ∫q dt of all modes.
    pub(super) fn area(&self, arch: Arch, of: [&[f64]; INPUTS], out: &mut [f64]) {
        let factors = &self.area;
        arch.dispatch(Combine { factors, of, out });
    }

    /// ∫τq dt of all modes.
    pub(super) fn moment(&self, arch: Arch, of: [&[f64]; INPUTS], out: &mut [f64]) {
        let factors = &self.moment;
        arch.dispatch(Combine { factors, of, out });
    }

    /// Energy dissipated by damping over the step to `end`, with ∫q and, for loads with curvature, ∫τq over it
    /// \[J\]. With rules it is computed from the motion, so the balance is a check; without, as work of the loads
    /// minus change of energy.
    pub(super) fn damped(
        &self,
        reduced: &Reduced,
        of: [&[f64]; INPUTS],
        end: [&[f64]; 2],
        [area, moment]: [&[f64]; 2],
    ) -> f64 {
        let form = &self.damped;
        if !form[0].is_empty() {
            return reduced.arch().dispatch(Quadratic { form, of });
        }
        reduced.arch().dispatch(Unkept {
            damping: &reduced.damping,
            stiffness: &reduced.stiffness,
            step: self.step,
            of,
            end,
            area,
            moment,
        })
    }

    /// Finds what a unit end force of a contact does, where it is not known yet.
    pub(super) fn find_unit_response(&mut self, contact: usize, reduced: &Reduced) {
        let ends = [&self.displacement, &self.velocity].map(|factors| {
            let [.., line, bend] = factors;
            [&line[..], bend]
        });
        self.answers[contact].find(contact, ends, &self.links, reduced);
    }

    /// What a unit end force of a contact does, once found.
    pub(super) fn answer(&self, contact: usize) -> &UnitResponse {
        &self.answers[contact]
    }
}

/// Values of up to [`LANES`] modes, the last one repeated.
pub(super) fn filled(values: &[f64]) -> [f64; LANES] {
    let mut lanes = [values[values.len() - 1]; LANES];
    lanes[..values.len()].copy_from_slice(values);
    lanes
}
