//! Thinning of a loop: few rows, every corner kept.

/// Rows of a history of (deformation, force) worth keeping, in order.
///
/// Between kept rows straight lines over time miss no dropped point by more than a small share of the range, in
/// deformation and in force (Douglas and Peucker 1973, with time as the common axis), so that the shape of the loop
/// and its instants both stay right. Least and greatest values are always kept. The share begins at 0.2 % and grows
/// until no more than about `most` rows are left.
pub(crate) fn thin_loop(time: &[f64], points: &[[f32; 2]], most: usize) -> Vec<usize> {
    let count = time.len().min(points.len());
    if count < 3 {
        return (0..count).collect();
    }
    let mut must = vec![0, count - 1];
    let mut ranges = [0.0_f64; 2];
    for (part, range) in ranges.iter_mut().enumerate() {
        let by = |a: &usize, b: &usize| points[*a][part].total_cmp(&points[*b][part]);
        let low = (0..count).min_by(by).unwrap_or(0);
        let high = (0..count).max_by(by).unwrap_or(0);
        *range = f64::from(points[high][part] - points[low][part]);
        must.extend([low, high]);
    }
    must.sort_unstable();
    must.dedup();
    let mut share = FINEST;
    loop {
        let kept = keep(time, points, &must, ranges.map(|range| share * range));
        if kept.len() <= most.max(must.len()) || share > 0.5 {
            return kept;
        }
        share *= 1.4;
    }
}

/// Share of the range that is not seen.
const FINEST: f64 = 0.002;

fn keep(time: &[f64], points: &[[f32; 2]], must: &[usize], tolerance: [f64; 2]) -> Vec<usize> {
    let mut kept = vec![must[0]];
    for ends in must.windows(2) {
        // What is still to be looked at, the earliest on top.
        let mut open = vec![(ends[0], ends[1])];
        while let Some((first, last)) = open.pop() {
            match farthest(time, points, first, last, tolerance) {
                Some(row) => open.extend([(row, last), (first, row)]),
                None => kept.push(last),
            }
        }
    }
    kept
}

/// The row farthest from the straight line between two others, if any is out of tolerance.
fn farthest(
    time: &[f64],
    points: &[[f32; 2]],
    first: usize,
    last: usize,
    tolerance: [f64; 2],
) -> Option<usize> {
    let span = time[last] - time[first];
    let (mut worst, mut found) = (1.0, None);
    for row in first + 1..last {
        let share = if span > 0.0 {
            (time[row] - time[first]) / span
        } else {
            0.0
        };
        for part in 0..2 {
            let [a, b, here] = [first, last, row].map(|row| f64::from(points[row][part]));
            let miss = (here - a - share * (b - a)).abs() / tolerance[part].max(f64::MIN_POSITIVE);
            if miss > worst {
                (worst, found) = (miss, Some(row));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An elastic–plastic spring pushed to and fro; corners lie between the rows.
    fn plastic(rows: usize) -> (Vec<f64>, Vec<[f32; 2]>) {
        let (mut force, mut before) = (0.0_f64, 0.0);
        let time: Vec<f64> = (0..rows).map(|i| i as f64 * 1e-3).collect();
        let points = time.iter().map(|t| {
            let x = 4.0 * (0.2 * t).min(1.0) * (5.0 * t).sin();
            force = (force + x - before).clamp(-1.0, 1.0);
            before = x;
            [x as f32, force as f32]
        });
        let points = points.collect();
        (time, points)
    }

    #[test]
    fn what_is_dropped_lies_on_the_lines_between() {
        let (time, points) = plastic(20_000);
        let kept = thin_loop(&time, &points, 4000);
        assert!(kept.is_sorted() && kept.len() < 2000, "{} rows", kept.len());
        assert_eq!((kept[0], kept[kept.len() - 1]), (0, 19_999));
        for pair in kept.windows(2) {
            for row in pair[0]..pair[1] {
                let share = (time[row] - time[pair[0]]) / (time[pair[1]] - time[pair[0]]);
                for (part, range) in [8.0_f64, 2.0].into_iter().enumerate() {
                    let [a, b, here] =
                        [pair[0], pair[1], row].map(|row| f64::from(points[row][part]));
                    let miss = (here - a - share * (b - a)).abs();
                    assert!(miss <= 0.002_001 * range, "row {row} misses by {miss}");
                }
            }
        }
    }

    #[test]
    fn a_tight_budget_keeps_the_peaks() {
        let (time, points) = plastic(20_000);
        let kept = thin_loop(&time, &points, 100);
        assert!(kept.len() <= 100, "{} rows", kept.len());
        let greatest = |rows: &mut dyn Iterator<Item = usize>| {
            rows.map(|row| points[row][0]).fold(f32::MIN, f32::max)
        };
        assert_eq!(
            greatest(&mut kept.iter().copied()),
            greatest(&mut (0..20_000))
        );
    }

    #[test]
    fn nothing_moves_and_short_histories_are_no_trouble() {
        assert_eq!(thin_loop(&[], &[], 10), Vec::<usize>::new());
        assert_eq!(thin_loop(&[0.0], &[[1.0, 1.0]], 10), [0]);
        let still: Vec<[f32; 2]> = vec![[0.0; 2]; 50];
        let time: Vec<f64> = (0..50).map(f64::from).collect();
        assert_eq!(thin_loop(&time, &still, 10), [0, 49]);
    }
}
