//! Where members are divided between their lumped masses.

/// Division points of a line into equal segments, as fractions of its length.
pub(super) fn equal_cuts(segments: usize) -> Vec<f64> {
    (1..segments).map(|k| k as f64 / segments as f64).collect()
}

/// Adds a division point at a fraction of the length, if it lies inside the line; the others stay.
pub(super) fn cut_exactly(cuts: &mut Vec<f64>, share: f64) {
    cut_at(cuts, share, 1e-9);
}

/// Fractions closer than this coincide.
const SAME: f64 = 1e-6;

/// Indices of the division points at these fractions of the length, from the first.
pub(super) fn cuts_at(cuts: &[f64], shares: &[f64]) -> impl Iterator<Item = usize> {
    let is_one = |cut: &f64| shares.iter().any(|share| (cut - share).abs() <= SAME);
    let at = cuts.iter().map(is_one).collect::<Vec<bool>>();
    at.into_iter()
        .enumerate()
        .filter(|(_, is_one)| *is_one)
        .map(|(index, _)| index)
}

/// Adds a division point at a fraction of the length, by moving a point that is near enough, if the fraction lies
/// inside the line.
pub(super) fn cut_at(cuts: &mut Vec<f64>, share: f64, reach: f64) {
    if !(share > SAME && share < 1.0 - SAME) || cuts.iter().any(|c| (c - share).abs() <= SAME) {
        return;
    }
    let segments = (0.25 / reach).round();
    let is_equal = |cut: f64| (cut * segments - (cut * segments).round()).abs() < SAME;
    match cuts
        .iter_mut()
        .find(|cut| is_equal(**cut) && (**cut - share).abs() <= reach)
    {
        Some(near) => *near = share,
        None => cuts.push(share),
    }
    cuts.sort_by(f64::total_cmp);
}
