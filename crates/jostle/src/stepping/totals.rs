//! Peaks and work of links and of springs that yield, where forces are found.

use crate::history::{Column, Extreme, Kind, Owner, Peak};

/// Peaks of a link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LinkTotals {
    /// Force of greatest magnitude, positive in compression, and its instant \[N\].
    pub(super) peak_force: Extreme,
    /// Greatest change of length, either sign \[m\].
    pub(super) peak_shortening: f64,
    /// Greatest rate of change of length, either sign \[m/s\].
    pub(super) peak_rate: f64,
    /// Work done on it, recoverable energy of its spring included \[J\].
    pub(super) work: f64,
}

/// Peaks of a spring that yields.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SpringTotals {
    /// Greatest force, either sign \[N·m or N\].
    pub(super) peak_force: f64,
    /// Work done on it, recoverable energy included \[J\].
    pub(super) work: f64,
}

/// Links, for the list of peaks of their run.
pub(super) fn columns_of_links(links: &[LinkTotals]) -> impl Iterator<Item = (Column, Peak)> {
    links.iter().enumerate().flat_map(|(link, totals)| {
        let peaks = [
            (Kind::Force, totals.peak_force.into()),
            (Kind::Stroke, Peak::of_size(totals.peak_shortening)),
            (Kind::Speed, Peak::of_size(totals.peak_rate)),
            (Kind::Work, Peak::of_size(totals.work)),
        ];
        peaks.map(|(kind, peak)| (Column::along(Owner::Link(link), kind), peak))
    })
}

/// Springs, for the list of peaks of their run.
pub(super) fn columns_of_springs(springs: &[SpringTotals]) -> impl Iterator<Item = (Column, Peak)> {
    springs.iter().enumerate().flat_map(|(spring, totals)| {
        let peaks = [(Kind::Force, totals.peak_force), (Kind::Work, totals.work)];
        peaks.map(|(kind, value)| {
            let column = Column::along(Owner::Spring(spring), kind);
            (column, Peak::of_size(value))
        })
    })
}
