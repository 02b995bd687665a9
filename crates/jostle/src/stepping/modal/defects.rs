//! What the shapes of a building miss: the residual of every Ritz mode, as the displacement it causes.
//!
//! Let θ = ω² and φ be a Ritz pair, r = Kφ − θMφ its residual. As the shapes contain the static answers to all loads, the
//! residual of a motion Σ φ q in the equations of the whole building is −Σ (r/θ)(q̈ + α q̇): it is driven by modal
//! accelerations, and vanishes for natural modes (theory, Eq. Q7).

use crate::stepping::NotPositive;
use crate::system::BuildingSystem;
use crate::transfer::riccati::RiccatiSweep;
use crate::transfer::riccati::rates::{RATES, RateFactors};

use super::span::RitzModes;

/// Factors of K + s²M at several rates s.
#[derive(Clone)]
pub(super) struct SeveralRates {
    /// s \[1/s\].
    pub(super) rates: [f64; RATES],
    pub(super) factors: RateFactors,
}

impl SeveralRates {
    pub(super) fn of(sweep: &RiccatiSweep, rates: [f64; RATES]) -> Result<Self, NotPositive> {
        let factors = sweep.factorize_at(&rates)?;
        Ok(Self { rates, factors })
    }

    /// Which of the rates is nearest to a circular frequency, on a scale of ratios.
    fn nearest(&self, frequency: f64) -> usize {
        // The slowest stands for all that is slower: modes below it have next to no defects.
        let far = |lane: usize| {
            let rate = self.rates[lane];
            if rate > 0.0 {
                (rate / frequency).ln().abs()
            } else {
                f64::INFINITY
            }
        };
        let lanes = 0..RATES;
        lanes
            .min_by(|a, b| far(*a).total_cmp(&far(*b)))
            .unwrap_or(0)
    }
}

/// What every Ritz mode of a building misses.
pub(super) struct Defects {
    /// d = (K + s²M)⁻¹ r/θ at a rate s near ω, over all degrees of freedom \[s²·kg^−½\].
    pub(super) shapes: Vec<Vec<f64>>,
    /// How much too high θ is, relative \[–\].
    pub(super) detuning: Vec<f64>,
    /// To find more with.
    pub(super) factors: SeveralRates,
}

/// How much of what a mode off its frequency may be off by counts: seldom do all cycles of a motion count as at resonance.
const DETUNED: f64 = 0.25;

impl Defects {
    /// What share of a shape, as a displacement for a unit modal acceleration, is off because the frequency is: at
    /// resonance |Δω|/ω over ζ of it, with d = 2ζω \[s²\].
    pub(super) fn detuned(&self, modes: &RitzModes, damping: &[f64]) -> Vec<f64> {
        let modes = self.detuning.iter().zip(damping).zip(&modes.stiffness);
        modes
            .map(|((shift, d), k)| DETUNED * (shift * k.sqrt() / d).min(1.0) / k)
            .collect()
    }

    pub(super) fn of(building: &BuildingSystem, factors: SeveralRates, modes: &RitzModes) -> Self {
        let mass = &building.equations.mass;
        let shapes: Vec<Vec<f64>> = modes.shapes().collect();
        let count = shapes.len();
        let mut waiting: [Vec<usize>; RATES] = Default::default();
        for (mode, theta) in modes.stiffness.iter().enumerate() {
            waiting[factors.nearest(theta.sqrt())].push(mode);
        }
        let mut found = Self {
            shapes: vec![Vec::new(); count],
            detuning: vec![0.0; count],
            factors,
        };
        let mut answers = vec![[0.0; RATES]; mass.len()];
        let walks = waiting.iter().map(Vec::len).max().unwrap_or(0);
        for walk in 0..walks {
            // A mode for every rate.
            for (lane, waiting) in waiting.iter().enumerate() {
                let mode = waiting.get(walk);
                for (dof, answer) in answers.iter_mut().enumerate() {
                    answer[lane] = mode.map_or(0.0, |mode| mass[dof] * shapes[*mode][dof]);
                }
            }
            let factors = &found.factors;
            building.sweep.solve_at(&factors.factors, &mut answers);
            for (lane, waiting) in waiting.iter().enumerate() {
                let Some(&mode) = waiting.get(walk) else {
                    continue;
                };
                let (shape, theta) = (&shapes[mode], modes.stiffness[mode]);
                let whole = theta + factors.rates[lane].powi(2);
                let answer = || answers.iter().map(|values| values[lane]);
                let defect = shape.iter().zip(answer());
                found.shapes[mode] = defect.map(|(v, y)| (v - whole * y) / theta).collect();
                let own: f64 = shape
                    .iter()
                    .zip(mass)
                    .zip(answer())
                    .map(|((v, m), y)| v * m * y)
                    .sum();
                found.detuning[mode] = (whole * (whole * own - 1.0) / theta).max(0.0);
            }
        }
        found
    }
}
