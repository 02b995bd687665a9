//! The search over one varied key: points between the bounds, then between the neighbours of the best, again and again.

use rayon::prelude::*;

use super::evaluate::Merit;

/// Points at first, bounds included, so that a second minimum is not missed easily.
const FIRST: usize = 17;
/// Points between the best and each of its neighbours in a later round.
const BETWEEN: usize = 3;
/// Neighbours nearer than this part of the bounds are one point \[–\].
const SAME_POINT: f64 = 1e-9;

/// Looks for the point of the least merit in 0…1 with at most so many trials; whether it was found to the tolerance: the objective
/// changes by less than this part of itself from the best point to both its neighbours. Conditions usually end on one side of the best
/// point; then this tells how near their end is known.
pub(super) fn search(
    trials: usize,
    tolerance: f64,
    trial: impl Fn(f64) -> Merit + Sync,
    mut go_on: impl FnMut() -> bool,
) -> bool {
    let all = |points: &[f64]| -> Vec<(f64, Merit)> {
        let merits = points.par_iter().map(|point| (*point, trial(*point)));
        merits.collect()
    };
    let first = FIRST.min((trials / 2).max(3));
    let points: Vec<f64> = (0..first).map(|k| k as f64 / (first - 1) as f64).collect();
    let mut known = all(&points);
    loop {
        // The first of equal ones, so that the order of threads does not matter.
        let mut best = 0;
        for (index, (_, merit)) in known.iter().enumerate() {
            if merit < &known[best].1 {
                best = index;
            }
        }
        let neighbours = [
            best.checked_sub(1),
            Some(best + 1).filter(|at| *at < known.len()),
        ];
        let (at, (missed, objective)) = known[best];
        let near = |neighbour: &usize| {
            let (other, (_, value)) = known[*neighbour];
            (other - at).abs() < SAME_POINT
                || (value - objective).abs() <= tolerance * objective.abs()
        };
        if missed == 0.0 && neighbours.iter().flatten().all(near) {
            return true;
        }
        let between: Vec<f64> = (neighbours.iter().flatten())
            .flat_map(|neighbour| {
                let (other, _) = known[*neighbour];
                let step = (other - at) / (BETWEEN + 1) as f64;
                (1..=BETWEEN).map(move |k| at + k as f64 * step)
            })
            .filter(|point| {
                known
                    .iter()
                    .all(|(candidate, _)| (candidate - point).abs() > 0.1 * SAME_POINT)
            })
            .collect();
        if between.is_empty() || known.len() + between.len() > trials || !go_on() {
            return false;
        }
        known.extend(all(&between));
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least width that keeps a condition, the bottom of a valley, and the lower bound.
    #[test]
    fn ends_of_conditions_valleys_and_bounds_are_found() {
        let least = |of: fn(f64) -> Merit| {
            let found = std::sync::Mutex::new((f64::NAN, (f64::MAX, f64::MAX)));
            let converged = search(
                200,
                1e-6,
                |x| {
                    let merit = of(x);
                    let mut found = found.lock().expect("no panic");
                    if merit < found.1 {
                        *found = (x, merit);
                    }
                    merit
                },
                || true,
            );
            let (at, _) = *found.lock().expect("no panic");
            (converged, at)
        };
        let (converged, at) = least(|x| ((0.337 - x).max(0.0), 1.0 + x));
        assert!(converged && (at - 0.337).abs() < 1e-5, "{at}");
        let (converged, at) = least(|x| (0.0, 1.0 + (x - 0.6123).powi(2)));
        assert!(converged && (at - 0.6123).abs() < 2e-3, "{at}");
        let (converged, at) = least(|x| (0.0, 2.0 + x));
        assert!(converged && at < 1e-5, "{at}");
        let (converged, _) = least(|x| (1.0, x));
        assert!(!converged, "nothing keeps the condition");
    }
}
