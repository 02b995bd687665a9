//! Which factors matter: variance shares and elementary effects.

use jostle::linear::quantile;

use crate::sampling::Stream;

/// Shares of the variance that one factor accounts for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SobolIndex {
    /// By itself \[–\].
    pub first: f64,
    /// Together with all others \[–\].
    pub total: f64,
    /// Bootstrap limits (90 %) of `first`.
    pub first_limits: [f64; 2],
    /// Bootstrap limits (90 %) of `total`.
    pub total_limits: [f64; 2],
}

const RESAMPLES: usize = 200;
const BOOTSTRAP: u64 = 7;

/// Sobol indices from responses in the order of a Saltelli design: for every base sample f(A), f(B), then f(A with
/// the coordinate i of B) for every factor.
///
/// ```text
/// Sᵢ  = mean(f_B (f_ABᵢ − f_A)) / V                                                          (ST5)
/// STᵢ = mean((f_A − f_ABᵢ)²) / 2V                                                            (ST6)
/// ```
/// with V the variance of all f_A and f_B (Saltelli et al. 2010, table 2, estimators b and f; the latter is Jansen
/// 1999). The mean of all f_A and f_B is subtracted first, which only reduces the scatter. Base samples with an
/// absent response are left out. `None` when fewer than two are complete or nothing varies.
#[must_use]
pub fn sobol_indices(
    responses: &[Option<f64>],
    factors: usize,
    seed: u64,
) -> Option<Vec<SobolIndex>> {
    let blocks: Vec<Vec<f64>> = responses
        .chunks_exact(factors + 2)
        .filter_map(|block| block.iter().copied().collect::<Option<Vec<f64>>>())
        .collect();
    let all: Vec<usize> = (0..blocks.len()).collect();
    let best = estimate(&blocks, &all, factors)?;
    let mut resampled: Vec<Vec<[f64; 2]>> = Vec::new();
    for number in 0..RESAMPLES {
        let mut stream = Stream::new(seed, BOOTSTRAP, number as u64);
        let drawn: Vec<usize> = all
            .iter()
            .map(|_| stream.below(blocks.len() as u64) as usize)
            .collect();
        resampled.extend(estimate(&blocks, &drawn, factors));
    }
    let limits = |factor: usize, which: usize| {
        let mut values: Vec<f64> = resampled.iter().map(|one| one[factor][which]).collect();
        values.sort_by(f64::total_cmp);
        [quantile(&values, 0.05), quantile(&values, 0.95)]
    };
    let index = |(factor, [first, total]): (usize, &[f64; 2])| SobolIndex {
        first: *first,
        total: *total,
        first_limits: limits(factor, 0),
        total_limits: limits(factor, 1),
    };
    Some(best.iter().enumerate().map(index).collect())
}

fn estimate(blocks: &[Vec<f64>], used: &[usize], factors: usize) -> Option<Vec<[f64; 2]>> {
    if used.len() < 2 {
        return None;
    }
    let n = used.len() as f64;
    let both = || used.iter().flat_map(|&i| [blocks[i][0], blocks[i][1]]);
    let mean = both().sum::<f64>() / (2.0 * n);
    let variance = both().map(|f| (f - mean).powi(2)).sum::<f64>() / (2.0 * n);
    if variance <= 0.0 {
        return None;
    }
    let of = |factor: usize| {
        let (mut first, mut total) = (0.0, 0.0);
        for &i in used {
            let (a, b, mixed) = (blocks[i][0], blocks[i][1], blocks[i][2 + factor]);
            first += (b - mean) * (mixed - a);
            total += 0.5 * (a - mixed).powi(2);
        }
        [first / (n * variance), total / (n * variance)]
    };
    Some((0..factors).map(of).collect())
}

/// Elementary effects of one factor (Morris 1991; Campolongo et al. 2007).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementaryEffects {
    /// Mean effect of moving the factor over its whole range.
    pub mean: f64,
    /// Mean of its absolute values, μ*.
    pub mean_absolute: f64,
    /// Standard deviation: interactions and curvature.
    pub deviation: f64,
    /// Trajectories with information about it.
    pub count: usize,
}

/// Elementary effects from responses in the order of a Morris design; a step with an absent response at either end
/// is left out.
#[must_use]
pub fn elementary_effects(
    responses: &[Option<f64>],
    factors: usize,
    seed: u64,
) -> Vec<ElementaryEffects> {
    let mut effects: Vec<Vec<f64>> = vec![Vec::new(); factors];
    for (number, trajectory) in responses.chunks_exact(factors + 1).enumerate() {
        let steps = crate::design::morris_steps(seed, number as u64, factors);
        for ((factor, end), pair) in steps.moves.iter().zip(trajectory.windows(2)) {
            if let [Some(before), Some(after)] = pair {
                effects[*factor].push((after - before) / (end - steps.start[*factor]));
            }
        }
    }
    let summed = |list: &Vec<f64>| {
        let n = list.len() as f64;
        let mean = list.iter().sum::<f64>() / n;
        let square = list.iter().map(|e| (e - mean).powi(2)).sum::<f64>();
        ElementaryEffects {
            mean,
            mean_absolute: list.iter().map(|e| e.abs()).sum::<f64>() / n,
            deviation: (square / (n - 1.0).max(1.0)).sqrt(),
            count: list.len(),
        }
    };
    effects.iter().map(summed).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::sampling::SobolSequence;

    fn ishigami(x: &[f64]) -> f64 {
        let x: Vec<f64> = x.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
        x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()
    }

    /// The function of Ishigami and Homma (1990) with a = 7, b = 0.1; its indices in closed form.
    #[test]
    fn ishigami_has_its_indices() {
        let (a, b) = (7.0_f64, 0.1_f64);
        let variance = a * a / 8.0 + b * PI.powi(4) / 5.0 + b * b * PI.powi(8) / 18.0 + 0.5;
        let v1 = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
        let v2 = a * a / 8.0;
        let v13 = b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
        let first = [v1 / variance, v2 / variance, 0.0];
        let total = [(v1 + v13) / variance, v2 / variance, v13 / variance];

        let sequence = SobolSequence::new(6, 2024);
        let mut responses = Vec::new();
        for i in 0..1 << 14 {
            let both = sequence.point(i);
            let (x, y) = both.split_at(3);
            responses.push(Some(ishigami(x)));
            responses.push(Some(ishigami(y)));
            for factor in 0..3 {
                let mut mixed = x.to_vec();
                mixed[factor] = y[factor];
                responses.push(Some(ishigami(&mixed)));
            }
        }
        let found = sobol_indices(&responses, 3, 1).unwrap_or_else(|| panic!("no indices"));
        for factor in 0..3 {
            let index = found[factor];
            assert!(
                (index.first - first[factor]).abs() < 0.005,
                "S{factor}: {index:?}"
            );
            assert!(
                (index.total - total[factor]).abs() < 0.005,
                "ST{factor}: {index:?}"
            );
            assert!(
                index.total_limits[0] <= total[factor] && total[factor] <= index.total_limits[1],
                "{index:?} does not hold {}",
                total[factor]
            );
        }
    }

    /// y = 3 x₀ − 2 x₁ + 5 x₂ x₃: effects of the linear factors are their slopes without scatter, those of the
    /// product have the mean 5 times the mean of the other one.
    #[test]
    fn elementary_effects_of_a_plane_are_its_slopes() {
        let (k, seed) = (4, 8);
        let mut responses = Vec::new();
        for trajectory in 0..400 {
            let steps = crate::design::morris_steps(seed, trajectory, k);
            let f = |x: &[f64]| 3.0 * x[0] - 2.0 * x[1] + 5.0 * x[2] * x[3];
            let mut x = steps.start.clone();
            responses.push(Some(f(&x)));
            for (factor, end) in &steps.moves {
                x[*factor] = *end;
                responses.push(Some(f(&x)));
            }
        }
        let effects = elementary_effects(&responses, k, seed);
        for (factor, slope) in [(0, 3.0), (1, -2.0)] {
            assert!((effects[factor].mean - slope).abs() < 1e-12, "{effects:?}");
            assert!(effects[factor].deviation < 1e-12, "{effects:?}");
            assert_eq!(effects[factor].count, 400);
        }
        // The other coordinate lies on 0, 1/3, 2/3, 1 with equal weight: mean 2.5, standard deviation 5·√(5/36).
        let scatter = 5.0 * (5.0_f64 / 36.0).sqrt();
        for factor in [2, 3] {
            assert!(
                (effects[factor].mean - 2.5).abs() < 4.0 * scatter / 20.0,
                "{effects:?}"
            );
            assert!(
                (effects[factor].deviation - scatter).abs() < 0.2,
                "{effects:?}"
            );
        }
    }
}
