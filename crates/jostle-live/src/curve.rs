//! Results over the range of one key, or of two, coarse to fine.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
#[cfg(not(target_family = "wasm"))]
use std::sync::mpsc::Sender;
use std::sync::{Mutex, PoisonError};

use jostle::linear::sort_by_key;
use jostle::results::response::BuildingResponse;
use jostle::{Settings, Summary};
use jostle_io::{ModelTree, TreeValue};
use jostle_run::{GapSettings, critical_gaps};
#[cfg(not(target_family = "wasm"))]
use rayon::prelude::*;

use crate::engine::{Engine, Trouble};
use crate::message::{Axis, Curve, Mark, Point};

/// Most points of a curve, all records together.
const MOST_POINTS: usize = 2000;
/// Most records, each of which has two points at least.
const MOST_RECORDS: usize = MOST_POINTS / 2;
/// Most values of each key of a map.
const MOST_SIDE: usize = 48;

/// The cases of a curve or a map, coarse to fine, and what they share.
pub(crate) struct Cases {
    tree: ModelTree,
    curve: Curve,
    /// Record, index along the curve, and index of the second key.
    list: Vec<(usize, usize, usize)>,
    /// Points along the curve and values of the second key.
    counts: [usize; 2],
    /// By record and value of the second key.
    apart: Vec<Apart>,
}

impl Cases {
    /// The cases of a curve over a model.
    ///
    /// # Errors
    /// In words, if there are too many records for two points of each.
    pub(crate) fn new(tree: ModelTree, curve: Curve) -> Result<Self, String> {
        let records = curve.records.len().max(1);
        if records > MOST_RECORDS {
            return Err(format!(
                "a curve takes at most {MOST_RECORDS} records, found {records}; a study takes all"
            ));
        }
        let (counts, order) = match &curve.across {
            None => {
                let count = curve.axis.points.clamp(2, MOST_POINTS / records);
                let along = coarse_to_fine(count).into_iter();
                ([count, 1], along.map(|index| (index, 0)).collect())
            }
            Some(across) => {
                let side = |axis: &Axis| axis.points.clamp(2, MOST_SIDE);
                let counts = [side(&curve.axis), side(across)];
                (counts, cells(counts))
            }
        };
        let list = order
            .into_iter()
            .flat_map(|(x, z)| (0..records).map(move |record| (record, x, z)));
        Ok(Self {
            list: list.collect(),
            apart: (0..records * counts[1]).map(|_| Mutex::new(None)).collect(),
            tree,
            curve,
            counts,
        })
    }

    /// Number of points, all records together.
    pub(crate) fn count(&self) -> usize {
        self.list.len()
    }

    /// What was asked for.
    pub(crate) fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Runs one case.
    pub(crate) fn point(
        &self,
        engine: &Engine,
        case: usize,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Point {
        let (record, index, row) = self.list[case];
        let axis = &self.curve.axis;
        let x = axis.value(index, self.counts[0]);
        let across = self.curve.across.as_ref();
        let z = across.map(|across| across.value(row, self.counts[1]));
        let apart = &self.apart[record * self.counts[1] + row];
        // A case on which the program fails is a hole in the curve.
        let one = || self.one(engine, record, (x, z), apart, stop);
        let y = catch_unwind(AssertUnwindSafe(one)).ok().flatten();
        Point { record, x, z, y }
    }

    fn one(
        &self,
        engine: &Engine,
        record: usize,
        (x, z): (f64, Option<f64>),
        apart: &Apart,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<[f64; 4]> {
        let curve = &self.curve;
        let mut tree = self.tree.clone();
        tree.set(&curve.axis.path, &curve.axis.put(x)).ok()?;
        if let Some((across, z)) = curve.across.as_ref().zip(z) {
            tree.set(&across.path, &across.put(z)).ok()?;
        }
        if let Some(record) = curve.records.get(record) {
            tree.set("motion.record", &TreeValue::Text(record.clone()))
                .ok()?;
        }
        let prepared = engine.prepare(&tree, curve.run.record).ok()?;
        let widens = curve.axis.is_width() && !prepared.input.model.moves_by_gaps();
        if let Some(y) = widens.then(|| beyond(apart, x)).flatten() {
            return Some(y);
        }
        let settings = Settings {
            record_interval: None,
            ..Settings::default()
        };
        let outcome = prepared.step(settings, |_| {
            if stop() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        if *outcome.end_of_all() != jostle::RunEnd::Completed {
            return None;
        }
        let y = measures(&prepared.summary(&outcome, None, 0.0));
        if widens && y[1] == 0.0 {
            keep_apart(apart, x, y);
        }
        Some(y)
    }
}

/// Computes all cases on all cores and sends each as it comes.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn points(
    engine: &Engine,
    cases: &Cases,
    send: &Sender<Point>,
    stop: &(dyn Fn() -> bool + Sync),
) {
    (0..cases.count())
        .into_par_iter()
        .for_each_with(send.clone(), |send, case| {
            if !stop() {
                // A page that is gone wants no points.
                let _ = send.send(cases.point(engine, case, stop));
            }
        });
}

/// Smallest width known to leave no impact, and the results there. Wider gaps give the same run, if gaps do nothing but keep apart.
type Apart = Mutex<Option<(f64, [f64; 4])>>;

fn beyond(apart: &Apart, x: f64) -> Option<[f64; 4]> {
    let known = apart.lock().unwrap_or_else(PoisonError::into_inner);
    known.filter(|(width, _)| *width <= x).map(|(_, y)| y)
}

fn keep_apart(apart: &Apart, x: f64, y: [f64; 4]) {
    let mut known = apart.lock().unwrap_or_else(PoisonError::into_inner);
    if known.is_none_or(|(width, _)| x < width) {
        *known = Some((x, y));
    }
}

fn measures(summary: &Summary) -> [f64; 4] {
    let force = summary
        .gaps
        .iter()
        .map(|gap| gap.peak_force_n)
        .fold(0.0, f64::max);
    let impacts: usize = summary.gaps.iter().map(|gap| gap.impact_count).sum();
    let most = |of: fn(&BuildingResponse) -> f64| {
        let buildings = summary.buildings.iter();
        buildings.map(|b| of(&b.response)).fold(0.0, f64::max)
    };
    [
        1e-3 * force,
        impacts as f64,
        100.0 * most(|b| b.drift_peak),
        most(|b| b.total_acceleration_peak_m_s2),
    ]
}

/// The ends first, then halves, quarters and so on.
fn coarse_to_fine(count: usize) -> Vec<usize> {
    let last = count - 1;
    let mut seen = vec![false; count];
    let mut order = Vec::with_capacity(count);
    let mut parts = 1;
    while order.len() < count {
        for part in 0..=parts {
            let index = (part * last) / parts;
            if !std::mem::replace(&mut seen[index], true) {
                order.push(index);
            }
        }
        parts *= 2;
    }
    order
}

/// The cells of a map, coarse to fine in both directions.
fn cells(counts: [usize; 2]) -> Vec<(usize, usize)> {
    let ranks = counts.map(|count| {
        let mut ranks = vec![0; count];
        for (rank, index) in coarse_to_fine(count).into_iter().enumerate() {
            ranks[index] = rank;
        }
        ranks
    });
    let mut all: Vec<(usize, usize)> = (0..counts[0])
        .flat_map(|x| (0..counts[1]).map(move |z| (x, z)))
        .collect();
    sort_by_key(&mut all, |&(x, z)| ranks[0][x].max(ranks[1][z]));
    all
}

/// The smallest gap without pounding, and those of rules, for the only gap of a model.
pub(crate) fn marks(
    engine: &Engine,
    cases: &Cases,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<Mark>, String> {
    let prepared = match engine.prepare(&cases.tree, cases.curve.run.record) {
        Ok(prepared) => prepared,
        Err(Trouble::Faults(faults)) => {
            return Err(faults
                .first()
                .map_or_else(String::new, |fault| fault.problem.clone()));
        }
        Err(Trouble::Stopped) => return Err("stopped".into()),
    };
    // As closely as the page shows it.
    let settings = GapSettings {
        tolerance: 1e-5,
        outcomes: false,
        reversed: false,
        curve: 0,
        codes: prepared.input.codes.clone(),
    };
    let (model, motion) = (&prepared.input.model, &prepared.motion);
    let found = critical_gaps(model, motion, &settings, stop).map_err(|error| error.to_string())?;
    let mut marks = Vec::new();
    for gap in &found {
        let pair = if found.len() > 1 {
            format!(", {} ↔ {}", gap.between[0], gap.between[1])
        } else {
            String::new()
        };
        marks.push(Mark {
            name: format!("no pounding{pair}"),
            source: "gap needed under this motion".into(),
            width: gap.gap_m,
            needed: true,
        });
        if found.len() == 1 {
            let rules = jostle_report::rows_of_rules(&gap.rules, |rule| (&rule.rule, rule.gap_m));
            marks.extend(rules.into_iter().map(|(name, rule)| Mark {
                name,
                source: rule.source.clone(),
                width: rule.gap_m,
                needed: false,
            }));
        }
    }
    Ok(marks)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_wider_gaps_share_a_run_without_impact() {
        let apart = Apart::default();
        assert_eq!(beyond(&apart, 1.0), None);
        keep_apart(&apart, 5.0, [0.0, 0.0, 1.0, 2.0]);
        keep_apart(&apart, 7.0, [0.0, 0.0, 9.0, 9.0]);
        assert_eq!(beyond(&apart, 4.9), None);
        assert_eq!(beyond(&apart, 5.0), Some([0.0, 0.0, 1.0, 2.0]));
    }

    #[test]
    fn every_cell_comes_once_and_the_corners_first() {
        let mut order = cells([24, 16]);
        let mut corners = order[..4].to_vec();
        corners.sort_unstable();
        assert_eq!(corners, [(0, 0), (0, 15), (23, 0), (23, 15)]);
        order.sort_unstable();
        order.dedup();
        assert_eq!(order.len(), 24 * 16);
    }

    #[test]
    fn every_point_comes_once_and_the_ends_first() {
        for count in [2, 3, 17, 200] {
            let mut order = coarse_to_fine(count);
            assert_eq!(order[..2], [0, count - 1]);
            order.sort_unstable();
            assert_eq!(order, (0..count).collect::<Vec<_>>());
        }
    }
}
