//! Where members are divided between their lumped masses.

use super::{Frame, FramePlace};

impl Frame {
    /// Where a height above the joint at the foot of a column lies between its rigid ends, as a fraction of the length between them.
    pub(crate) fn share_of_column(&self, place: FramePlace, above: f64) -> f64 {
        let [foot, _] = self.rigid_ends_of_column(place);
        (above - foot) / self.clear_height(place)
    }

    /// Division points of a column between its rigid ends, as fractions of the length between them: equal segments, points at these
    /// heights above the joint at its foot, and where struts meet it.
    pub(crate) fn column_cuts(
        &self,
        place: FramePlace,
        points: impl Iterator<Item = f64>,
    ) -> Vec<f64> {
        let mut cuts = equal_cuts(self.column_segments);
        let reach = 0.25 / self.column_segments as f64;
        for above in points {
            cut_at(&mut cuts, self.share_of_column(place, above), reach);
        }
        // Struts end exactly where they are said to.
        for above in self.ends_of_struts(place) {
            cut_exactly(&mut cuts, self.share_of_column(place, above));
        }
        cuts
    }
}

/// Mass of half of every segment of a line, from that of half of the line \[kg\].
pub(crate) fn halves_of_segments(half_mass: f64, cuts: &[f64]) -> Vec<f64> {
    let segments = cuts.len() + 1;
    if *cuts == equal_cuts(segments) {
        // All equal to the last bit.
        return vec![half_mass / segments as f64; segments];
    }
    let starts = std::iter::once(0.0).chain(cuts.iter().copied());
    let ends = cuts.iter().copied().chain([1.0]);
    let lengths = starts.zip(ends);
    lengths.map(|(a, b)| half_mass * (b - a)).collect()
}

/// Division points of a line into equal segments, as fractions of its length.
pub(crate) fn equal_cuts(segments: usize) -> Vec<f64> {
    (1..segments).map(|k| k as f64 / segments as f64).collect()
}

/// Adds a division point at a fraction of the length, if it lies inside the line; the others stay.
fn cut_exactly(cuts: &mut Vec<f64>, share: f64) {
    cut_at(cuts, share, 1e-9);
}

/// Fractions closer than this coincide.
const SAME: f64 = 1e-6;

/// Indices of the division points at these fractions of the length, from the first.
pub(crate) fn cuts_at(cuts: &[f64], shares: &[f64]) -> impl Iterator<Item = usize> {
    let is_one = |cut: &f64| shares.iter().any(|share| (cut - share).abs() <= SAME);
    let at = cuts.iter().map(is_one).collect::<Vec<bool>>();
    at.into_iter()
        .enumerate()
        .filter(|(_, is_one)| *is_one)
        .map(|(index, _)| index)
}

/// Adds a division point at a fraction of the length, by moving a point that is near enough, if the fraction lies
/// inside the line.
fn cut_at(cuts: &mut Vec<f64>, share: f64, reach: f64) {
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
