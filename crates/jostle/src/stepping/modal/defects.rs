//! Defects of the shapes of a building: the residual of every Ritz mode, as the displacement it causes.
//!
//! Let θ = ω² and φ be a Ritz pair, r = Kφ − θMφ its residual. Since the shapes contain the static response to all
//! loads, the residual of a motion Σ φ q in the equations of the full building is −Σ (r/θ)(q̈ + α q̇): it is driven
//! by modal accelerations, and vanishes for natural modes (theory, Eq. Q7).

use super::force_rows;
use super::span::RitzModes;
use crate::linear::NotPositive;
use crate::linear::Row;
use crate::system::BuildingSystem;
use crate::transfer::riccati::rates::RATES;

/// Defects of every Ritz mode of a building at some points, for a unit modal acceleration.
pub(super) struct Defects {
    /// d = (K + s²M)⁻¹ r/θ at a rate s near ω, at every place mode by mode, then its base shear, the shears of storeys and
    /// their overturning moments, and forces of columns and beams that are followed \[s²·kg^−½, N·s²·m⁻¹·kg^−½\].
    pub(super) rows: Vec<Vec<f64>>,
    /// Relative error of θ \[–\].
    detuning: Vec<f64>,
}

/// Weight of the error due to a frequency error: a motion seldom has a full resonance.
const DETUNED: f64 = 0.25;

impl Defects {
    /// # Errors
    /// [`NotPositive`] when the building can move without deforming.
    pub(super) fn new(
        building: &BuildingSystem,
        modes: &RitzModes,
        places: &[Row],
    ) -> Result<Self, NotPositive> {
        let count = modes.stiffness.len();
        let mut found = Self {
            rows: vec![vec![0.0; count]; places.len() + 1 + force_rows::count(building)],
            detuning: vec![0.0; count],
        };
        let all: Vec<usize> = (0..count).collect();
        let mass = &building.equations.mass;
        let mut wholes = vec![0.0; count];
        let mut vectors = [(); 2].map(|()| vec![Vec::new(); count]);
        for_each_defect(building, modes, &all, |mode, whole, shape, answer| {
            let theta = modes.stiffness[mode];
            for (row, place) in found.rows.iter_mut().zip(places) {
                row[mode] = (place.value(shape) - whole * place.value(answer)) / theta;
            }
            let shear = |vector: &[f64]| building.elastic_base_shear(vector);
            found.rows[places.len()][mode] = (shear(shape) - whole * shear(answer)) / theta;
            wholes[mode] = whole;
            for (vectors, vector) in vectors.iter_mut().zip([shape, answer]) {
                vectors[mode] = vector.to_vec();
            }
            let shape = shape.iter().zip(mass).zip(answer);
            let product: f64 = shape.map(|((v, m), y)| v * m * y).sum();
            found.detuning[mode] = (whole * (whole * product - 1.0) / theta).max(0.0);
        })?;
        let [of_shapes, of_answers] =
            vectors.map(|vectors| force_rows::of_vectors(building, &vectors));
        let rows = found.rows[places.len() + 1..].iter_mut();
        for (row, (of_shape, of_answer)) in rows.zip(of_shapes.iter().zip(&of_answers)) {
            let modes = wholes.iter().zip(&modes.stiffness);
            let values = of_shape.iter().zip(of_answer).zip(modes);
            for (to, ((of_shape, of_answer), (whole, theta))) in row.iter_mut().zip(values) {
                *to = (of_shape - whole * of_answer) / theta;
            }
        }
        Ok(found)
    }

    /// Error of a shape due to the frequency error, as a displacement for a unit modal acceleration: at resonance
    /// |Δω|/(ω ζ) of it, with d = 2ζω \[s²\].
    pub(super) fn detuned(&self, modes: &RitzModes, damping: &[f64]) -> Vec<f64> {
        let modes = self.detuning.iter().zip(damping).zip(&modes.stiffness);
        modes
            .map(|((shift, d), k)| DETUNED * (shift * k.sqrt() / d).min(1.0) / k)
            .collect()
    }
}

/// The defects of some modes over all degrees of freedom, of any scale.
///
/// # Errors
/// [`NotPositive`] when the building can move without deforming.
pub(super) fn vectors(
    building: &BuildingSystem,
    modes: &RitzModes,
    wanted: &[usize],
) -> Result<Vec<Vec<f64>>, NotPositive> {
    let mut found = Vec::with_capacity(wanted.len());
    for_each_defect(building, modes, wanted, |_, whole, shape, answer| {
        let defect = shape.iter().zip(answer).map(|(v, y)| v - whole * y);
        found.push(defect.collect());
    })?;
    Ok(found)
}

/// Calls `take` with every wanted mode, θ + s², its shape and (K + s²M)⁻¹Mφ. Modes come in the order of their
/// frequencies, so that neighbours share a rate s.
fn for_each_defect(
    building: &BuildingSystem,
    modes: &RitzModes,
    wanted: &[usize],
    mut take: impl FnMut(usize, f64, &[f64], &[f64]),
) -> Result<(), NotPositive> {
    if wanted.is_empty() {
        return Ok(());
    }
    let mass = &building.equations.mass;
    let share = wanted.len().div_ceil(RATES);
    let groups: Vec<&[usize]> = wanted.chunks(share).collect();
    let rates: [f64; RATES] = std::array::from_fn(|lane| {
        let group = groups[lane.min(groups.len() - 1)];
        let middle = group[group.len() / 2];
        modes.stiffness[middle].sqrt()
    });
    let factors = building.sweep.factorize_at(&rates)?;
    let mut answers = vec![[0.0; RATES]; mass.len()];
    let mut answer = vec![0.0; mass.len()];
    for walk in 0..share {
        // A mode for every rate.
        let lanes = groups.iter().enumerate();
        let taken = lanes.filter_map(|(lane, group)| group.get(walk).map(|mode| (lane, *mode)));
        let taken: Vec<(usize, usize, Vec<f64>)> = taken
            .map(|(lane, mode)| (lane, mode, modes.shape(mode)))
            .collect();
        for (lane, _, shape) in &taken {
            for ((answer, v), m) in answers.iter_mut().zip(shape).zip(mass) {
                answer[*lane] = v * m;
            }
        }
        building.sweep.solve_at(&factors, &mut answers);
        for (lane, mode, shape) in &taken {
            for (value, values) in answer.iter_mut().zip(&answers) {
                *value = values[*lane];
            }
            let whole = modes.stiffness[*mode] + rates[*lane] * rates[*lane];
            take(*mode, whole, shape, &answer);
        }
    }
    Ok(())
}
