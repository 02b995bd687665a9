//! Differential evolution (Storn and Price 1997), current-to-best with binomial crossing: the search over several varied keys.

use rayon::prelude::*;

use super::evaluate::{Merit, WORST};
use crate::sampling::Stream;

/// Weight of differences and probability of a crossed coordinate \[–\].
const WEIGHT: f64 = 0.6;
const CROSSED: f64 = 0.9;
/// Members of a generation: a number, and what every varied key adds.
const MEMBERS: [usize; 2] = [6, 6];
/// Purpose of its random streams.
const SEARCH: u64 = 8;

/// A member of a generation: its point between the bounds, each from 0 to 1, and its merit.
pub(super) type Member = (Vec<f64>, Merit);

/// Members of a generation that varies this number of keys.
pub(super) fn members(keys: usize) -> usize {
    MEMBERS[0] + MEMBERS[1] * keys
}

/// Generations until `go_on`, asked after each, says no. Every member draws from a stream that its generation and place name, so that
/// points do not depend on the number of threads.
pub(super) fn search(
    keys: usize,
    seed: u64,
    trial: impl Fn(&[f64]) -> Merit + Sync,
    mut go_on: impl FnMut(&[Member]) -> bool,
) {
    let count = members(keys);
    let stream = |generation: u64, place: usize| {
        Stream::new(seed, SEARCH, (generation << 32) | place as u64)
    };
    let draw = |place: usize| -> Member {
        let mut random = stream(0, place);
        let point: Vec<f64> = (0..keys).map(|_| random.open_uniform()).collect();
        let merit = trial(&point);
        (point, merit)
    };
    let mut all: Vec<Member> = (0..count).into_par_iter().map(draw).collect();
    let mut generation = 0;
    while go_on(&all) {
        generation += 1;
        let best = &all[best(&all)].0;
        let next = all.par_iter().enumerate().map(|(place, (point, merit))| {
            let mut random = stream(generation, place);
            let [first, second] = two_others(&mut random, place, count);
            let towards =
                |key: usize| best[key] - point[key] + all[first].0[key] - all[second].0[key];
            // One coordinate is always crossed.
            let crossed = random.below(keys as u64) as usize;
            let mut other = point.clone();
            for (key, at) in other.iter_mut().enumerate() {
                if key == crossed || random.open_uniform() < CROSSED {
                    *at = (*at + WEIGHT * towards(key)).clamp(0.0, 1.0);
                }
            }
            let found = trial(&other);
            // An equal one moves on: it may leave a plateau.
            match found <= *merit && found != WORST {
                true => (other, found),
                false => (point.clone(), *merit),
            }
        });
        all = next.collect();
    }
}

/// The first of the best members.
fn best(all: &[Member]) -> usize {
    (1..all.len()).fold(0, |best, place| match all[place].1 < all[best].1 {
        true => place,
        false => best,
    })
}

/// Two members that differ from each other and from one.
fn two_others(random: &mut Stream, place: usize, count: usize) -> [usize; 2] {
    let mut another = |taken: &[usize]| loop {
        let drawn = random.below(count as u64) as usize;
        if !taken.contains(&drawn) {
            return drawn;
        }
    };
    let first = another(&[place]);
    [first, another(&[place, first])]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The valley of Rosenbrock, whose least value 0 lies at 1, 1, between −2 and 2; the left half breaks a condition.
    fn valley(point: &[f64]) -> Merit {
        let [x, y] = [4.0 * point[0] - 2.0, 4.0 * point[1] - 2.0];
        let value = 100.0 * (y - x * x).powi(2) + (1.0 - x).powi(2);
        ((0.5 - x).max(0.0), value)
    }

    fn after(generations: usize, seed: u64) -> Member {
        let (mut left, mut found) = (generations, None);
        search(2, seed, valley, |all| {
            found = Some(all[best(all)].clone());
            left -= 1;
            left > 0
        });
        found.expect("a generation")
    }

    #[test]
    fn the_bottom_of_a_bent_valley_is_found() {
        for seed in 0..5 {
            let (point, (missed, value)) = after(150, seed);
            assert!(missed == 0.0 && value < 1e-8, "{value}");
            assert!(point.iter().all(|at| (at - 0.75).abs() < 1e-4), "{point:?}");
        }
    }

    #[test]
    fn points_depend_on_the_seed_and_not_on_threads() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let alone = pool.expect("a pool").install(|| after(20, 7));
        assert_eq!(alone, after(20, 7));
        assert_ne!(alone.0, after(20, 8).0);
    }
}
