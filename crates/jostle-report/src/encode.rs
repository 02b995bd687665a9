//! Thinning of histories: instants to keep, and numbers as base64 text.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use jostle::linear::sort_by;
use serde::Serialize;

/// Numbers of a list, ready for the scripts of a page.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(crate) enum Packed {
    /// Little-endian integers in base64; a value is `offset + scale · integer`.
    Text {
        /// `u32` or `i16`.
        kind: &'static str,
        offset: f64,
        scale: f64,
        data: String,
    },
    /// A part of an array of `f32` that travels beside the text.
    Floats {
        /// Index of the first value.
        at: usize,
        count: usize,
    },
}

/// Where the numbers of a page go.
#[derive(Debug)]
pub(crate) enum Packer {
    /// Into the text, for a page in one file.
    Text,
    /// Into an array beside it.
    Floats(Vec<f32>),
}

impl Packer {
    /// Instants \[s\].
    pub(crate) fn instants(&mut self, values: &[f64]) -> Packed {
        match self {
            Self::Text => Packed::instants(values),
            Self::Floats(floats) => append(floats, values.iter().copied()),
        }
    }

    /// Values; NaN becomes zero.
    pub(crate) fn values(&mut self, values: impl Iterator<Item = f64> + Clone) -> Packed {
        match self {
            Self::Text => Packed::values(values),
            Self::Floats(floats) => append(floats, values),
        }
    }
}

fn append(floats: &mut Vec<f32>, values: impl Iterator<Item = f64>) -> Packed {
    let at = floats.len();
    floats.extend(values.map(|value| if value.is_finite() { value as f32 } else { 0.0 }));
    Packed::Floats {
        at,
        count: floats.len() - at,
    }
}

impl Packed {
    /// Instants, to a part in four billion of their range.
    pub(crate) fn instants(values: &[f64]) -> Self {
        let (low, high) = range(values);
        let scale = step(high - low, f64::from(u32::MAX));
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| (((value - low) / scale).round() as u32).to_le_bytes())
            .collect();
        Self::Text {
            kind: "u32",
            offset: low,
            scale,
            data: STANDARD.encode(bytes),
        }
    }

    /// Values, to a part in 32 767 of the greatest one; zero stays zero, NaN becomes zero.
    pub(crate) fn values(values: impl Iterator<Item = f64> + Clone) -> Self {
        let peak = values
            .clone()
            .filter(|value| value.is_finite())
            .fold(0.0, |peak: f64, value| peak.max(value.abs()));
        let scale = step(peak, f64::from(i16::MAX));
        let bytes: Vec<u8> = values
            .flat_map(|value| ((value / scale).round() as i16).to_le_bytes())
            .collect();
        Self::Text {
            kind: "i16",
            offset: 0.0,
            scale,
            data: STANDARD.encode(bytes),
        }
    }
}

fn range(values: &[f64]) -> (f64, f64) {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    if low <= high { (low, high) } else { (0.0, 0.0) }
}

fn step(size: f64, levels: f64) -> f64 {
    if size > 0.0 { size / levels } else { 1.0 }
}

/// Rows of a history worth keeping, in order, at most about `budget` besides `always`.
///
/// Rows are kept at an even spacing, eight times closer while a contact is closed, together with the rows
/// where a contact closes or opens. The spacing grows until the rows fit.
pub(crate) fn thin_rows(
    time: &[f64],
    closed: &[bool],
    always: &[usize],
    budget: usize,
) -> Vec<usize> {
    let count = time.len();
    let (Some(first), Some(last)) = (time.first(), time.last()) else {
        return Vec::new();
    };
    if count <= budget {
        return (0..count).collect();
    }
    let mut must = vec![false; count];
    for row in always.iter().copied().chain([0, count - 1]) {
        if let Some(flag) = must.get_mut(row) {
            *flag = true;
        }
    }
    let mut spacing = (last - first) / budget as f64;
    loop {
        let mut kept = Vec::with_capacity(budget);
        let mut previous = f64::NEG_INFINITY;
        for row in 0..count {
            let turns = closed.get(row) != closed.get(row.saturating_sub(1))
                || (row + 1 < count && closed.get(row) != closed.get(row + 1));
            let near = if closed.get(row) == Some(&true) {
                0.125
            } else {
                1.0
            };
            // A little less than the spacing: evenly recorded rows must not beat against it.
            let due = time[row] - previous >= 0.999 * near * spacing;
            let turn = turns && time[row] - previous >= 0.02 * near * spacing;
            if must[row] || due || turn {
                kept.push(row);
                previous = time[row];
            }
        }
        if kept.len() <= budget + always.len() + 2 {
            return kept;
        }
        spacing *= 1.15;
    }
}

/// Rows of force histories worth keeping, with their forces: every row of every impact with the zeros around it, as long as
/// all fit into `budget`; otherwise the shape of each by its extremes, and only the strongest impacts. `force` gives the history
/// of a contact, which is in memory only while it is looked at.
pub(crate) fn thin_impacts(
    contacts: usize,
    force: impl Fn(usize) -> Vec<f64>,
    budget: usize,
) -> Vec<Vec<(usize, f64)>> {
    let episodes = (0..contacts).map(|contact| episodes_of(&force(contact)));
    let episodes: Vec<Vec<Episode>> = episodes.collect();
    let rows: usize = episodes.iter().flatten().map(Episode::rows).sum();
    let count = episodes.iter().flatten().count();
    let per_episode = if rows <= budget {
        usize::MAX
    } else {
        (budget / count.max(1)).max(LEAST_ROWS)
    };
    // Force below which impacts are left out.
    let weakest = if rows > budget && count * LEAST_ROWS > budget {
        let mut peaks: Vec<f64> = episodes.iter().flatten().map(|e| e.peak).collect();
        sort_by(&mut peaks, |a, b| b.total_cmp(a));
        peaks.get(budget / LEAST_ROWS).copied().unwrap_or(0.0)
    } else {
        0.0
    };
    let kept = episodes.iter().enumerate().map(|(contact, episodes)| {
        if episodes.is_empty() {
            return Vec::new();
        }
        let mut kept = Vec::new();
        let force = force(contact);
        for episode in episodes.iter().filter(|e| e.peak >= weakest) {
            episode.keep(&force, per_episode, &mut kept);
        }
        kept.dedup();
        kept.into_iter().map(|row| (row, force[row])).collect()
    });
    kept.collect()
}

/// Rows that still show the shape of an impact.
const LEAST_ROWS: usize = 6;

/// One run of rows with a force, with the zero before and after it.
struct Episode {
    start: usize,
    end: usize,
    peak: f64,
}

impl Episode {
    fn rows(&self) -> usize {
        self.end - self.start + 1
    }

    fn keep(&self, force: &[f64], most: usize, kept: &mut Vec<usize>) {
        if self.rows() <= most {
            kept.extend(self.start..=self.end);
            return;
        }
        kept.push(self.start);
        let inner: Vec<usize> = (self.start + 1..self.end).collect();
        let buckets = ((most - 2) / 2).max(1);
        for bucket in inner.chunks(inner.len().div_ceil(buckets)) {
            let least = bucket
                .iter()
                .min_by(|a, b| force[**a].total_cmp(&force[**b]));
            let greatest = bucket
                .iter()
                .max_by(|a, b| force[**a].total_cmp(&force[**b]));
            if let (Some(least), Some(greatest)) = (least, greatest) {
                kept.push(*least.min(greatest));
                if least != greatest {
                    kept.push(*least.max(greatest));
                }
            }
        }
        kept.push(self.end);
    }
}

fn episodes_of(force: &[f64]) -> Vec<Episode> {
    let mut episodes = Vec::new();
    let mut row = 0;
    while row < force.len() {
        if force[row] == 0.0 {
            row += 1;
            continue;
        }
        let start = row;
        while row < force.len() && force[row] != 0.0 {
            row += 1;
        }
        episodes.push(Episode {
            start: start.saturating_sub(1),
            end: row.min(force.len() - 1),
            peak: force[start..row]
                .iter()
                .fold(0.0, |peak: f64, f| peak.max(f.abs())),
        });
    }
    episodes
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn hump(before: usize, rows: usize, peak: f64) -> Vec<f64> {
        let mut force = vec![0.0; before];
        force.extend((1..=rows).map(|i| peak * (i as f64 / (rows + 1) as f64 * PI).sin()));
        force.push(0.0);
        force
    }

    #[test]
    fn every_row_of_an_impact_is_kept_while_there_is_room() {
        let force = hump(50, 30, 1e5);
        let kept = thin_impacts(1, |_| force.clone(), 1000);
        let expected: Vec<_> = (49..=80).map(|row| (row, force[row])).collect();
        assert_eq!(kept, vec![expected]);
    }

    #[test]
    fn crowded_impacts_keep_their_peaks() {
        let force: Vec<f64> = (1..=100).flat_map(|i| hump(3, 80, f64::from(i))).collect();
        let kept = thin_impacts(1, |_| force.clone(), 2000);
        let peak = kept[0].iter().map(|(_, force)| *force).fold(0.0, f64::max);
        assert!(kept[0].len() <= 2100, "{} rows", kept[0].len());
        assert_eq!(peak, force.iter().copied().fold(0.0, f64::max));
    }

    #[test]
    fn thinned_rows_stay_dense_in_contact() {
        let time: Vec<f64> = (0..20_000).map(|i| f64::from(i) * 1e-3).collect();
        let closed: Vec<bool> = (0..20_000).map(|i| (5000..5200).contains(&i)).collect();
        let kept = thin_rows(&time, &closed, &[12_345], 2000);
        let inside = kept.iter().filter(|row| closed[**row]).count();
        assert!(kept.len() <= 2003 && kept.is_sorted());
        assert!(inside > 100, "only {inside} rows of 200 in contact");
        assert!(kept.contains(&12_345) && kept.contains(&4999) && kept.contains(&5200));
    }
}
