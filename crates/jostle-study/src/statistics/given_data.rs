//! Sensitivity from any sample: how much of the variance the means over classes of one input explain.

/// Cases per class at least, and classes at most.
const FEWEST: usize = 10;
const MOST_CLASSES: usize = 20;

/// Influence of one input on one result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GivenData {
    /// First-order index: variance of the means over classes of the input with equally many cases, over the whole variance, without
    /// its bias (correlation ratio; E. Plischke, E. Borgonovo, C. L. Smith, 2013, Eur. J. Oper. Res. 226, 536–550), 0 to 1 \[–\].
    pub first_order: f64,
    /// Rank correlation of Spearman, −1 to 1; 0 if the input has no order \[–\].
    pub rank_correlation: f64,
}

/// Influence of an input on a result. `ordered`: whether the input is a number; otherwise its values are names of classes. `None` if
/// fewer than 20 cases have both, or if one of them does not vary.
#[must_use]
pub fn given_data(
    inputs: &[Option<f64>],
    results: &[Option<f64>],
    ordered: bool,
) -> Option<GivenData> {
    let both = inputs.iter().zip(results);
    let mut pairs: Vec<[f64; 2]> = both.filter_map(|(x, y)| Some([(*x)?, (*y)?])).collect();
    if pairs.len() < 2 * FEWEST {
        return None;
    }
    jostle::linear::sort_by(&mut pairs, |a, b| a[0].total_cmp(&b[0]));
    let n = pairs.len() as f64;
    let mean = pairs.iter().map(|pair| pair[1]).sum::<f64>() / n;
    let total: f64 = pairs.iter().map(|pair| (pair[1] - mean).powi(2)).sum();
    if total <= 0.0 || pairs.first()?[0] == pairs.last()?[0] {
        return None;
    }
    let classes = classes(&pairs, ordered);
    let between: f64 = classes
        .iter()
        .map(|class| {
            let class_mean = class.iter().map(|pair| pair[1]).sum::<f64>() / class.len() as f64;
            class.len() as f64 * (class_mean - mean).powi(2)
        })
        .sum();
    // What classes without any influence explain by chance.
    let chance = (classes.len() - 1) as f64 / (n - 1.0);
    let first_order = ((between / total - chance) / (1.0 - chance)).clamp(0.0, 1.0);
    let rank_correlation = if ordered {
        let [x, y] = [0, 1].map(|which| ranks(pairs.iter().map(|pair| pair[which]).collect()));
        correlation(&x, &y)
    } else {
        0.0
    };
    Some(GivenData {
        first_order,
        rank_correlation,
    })
}

/// Sorted pairs in classes: of equal inputs, or of about equally many where the inputs have an order.
pub(crate) fn classes(pairs: &[[f64; 2]], ordered: bool) -> Vec<&[[f64; 2]]> {
    let count = (pairs.len() / FEWEST).clamp(1, MOST_CLASSES);
    let mut classes = Vec::new();
    let mut start = 0;
    while start < pairs.len() {
        let least = if ordered {
            (classes.len() + 1) * pairs.len() / count
        } else {
            start + 1
        };
        let mut end = least.clamp(start + 1, pairs.len());
        // Equal inputs stay together.
        while end < pairs.len() && pairs[end][0] == pairs[end - 1][0] {
            end += 1;
        }
        classes.push(&pairs[start..end]);
        start = end;
    }
    classes
}

/// Ranks from 1, means of them for equal values.
fn ranks(values: Vec<f64>) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    jostle::linear::sort_by(&mut order, |a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut rest = &order[..];
    let mut before = 0;
    while let Some(&first) = rest.first() {
        let same = rest
            .iter()
            .take_while(|&&at| values[at] == values[first])
            .count();
        for &at in &rest[..same] {
            ranks[at] = before as f64 + 0.5 * (same + 1) as f64;
        }
        before += same;
        rest = &rest[same..];
    }
    ranks
}

fn correlation(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let [mean_x, mean_y] = [x, y].map(|values| values.iter().sum::<f64>() / n);
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        let (x, y) = (x - mean_x, y - mean_y);
        xx += x * x;
        yy += y * y;
        xy += x * y;
    }
    let both = (xx * yy).sqrt();
    if both > 0.0 { xy / both } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::LatinHypercube;

    /// y = x₁ + 2 x₂ + 0 x₃ of uniform inputs: first-order indices 0.2, 0.8 and 0, ranks in the same order.
    #[test]
    fn indices_of_a_sum_are_known() {
        let cube = LatinHypercube::new(4000, 3, 7);
        let points: Vec<Vec<f64>> = (0..4000).map(|case| cube.point(case)).collect();
        let results: Vec<Option<f64>> = points.iter().map(|p| Some(p[0] + 2.0 * p[1])).collect();
        let of = |factor: usize| {
            let inputs: Vec<Option<f64>> = points.iter().map(|p| Some(p[factor])).collect();
            given_data(&inputs, &results, true).expect("it varies")
        };
        for (factor, index) in [(0, 0.2), (1, 0.8), (2, 0.0)] {
            let found = of(factor);
            assert!(
                (found.first_order - index).abs() < 0.02,
                "{factor}: {found:?}"
            );
            let rank = [0.43, 0.89, 0.0][factor];
            assert!(
                (found.rank_correlation - rank).abs() < 0.04,
                "{factor}: {found:?}"
            );
        }
    }

    #[test]
    fn names_are_classes_and_few_cases_say_nothing() {
        let inputs: Vec<Option<f64>> = (0..60).map(|case| Some(f64::from(case % 3))).collect();
        let results: Vec<Option<f64>> = (0..60)
            .map(|case| Some(f64::from((case % 3) * (2 - case % 3))))
            .collect();
        let found = given_data(&inputs, &results, false).expect("it varies");
        assert!(
            found.first_order > 0.999 && found.rank_correlation == 0.0,
            "{found:?}"
        );
        assert_eq!(given_data(&inputs[..19], &results[..19], true), None);
        assert_eq!(given_data(&inputs, &[Some(1.0); 60], true), None);
        assert_eq!(given_data(&[Some(1.0); 60], &results, true), None);
    }

    #[test]
    fn equal_values_have_the_mean_of_their_ranks() {
        assert_eq!(ranks(vec![2.0, 1.0, 2.0, 3.0]), [2.5, 1.0, 2.5, 4.0]);
    }
}
