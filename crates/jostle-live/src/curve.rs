//! Results over the range of one key, on all cores, coarse to fine.

use std::ops::ControlFlow;
use std::sync::mpsc::Sender;
use std::sync::{Mutex, PoisonError};

use jostle::{Settings, Summary};
use jostle_io::{ModelTree, TreeValue};
use jostle_study::{GapSettings, critical_gaps};
use rayon::prelude::*;
use serde::Serialize;

use crate::engine::{Engine, Trouble};
use crate::message::Curve;

/// Most points of a curve, all records together.
const MOST_POINTS: usize = 2000;

/// Results at one value.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Point {
    /// Index of the record.
    pub(crate) record: usize,
    /// Value, in the unit of the curve.
    pub(crate) x: f64,
    /// Peak force \[kN\], impacts, storey drift \[%\], floor acceleration \[m/s²\]; `None` where the run failed.
    pub(crate) y: Option<[f64; 4]>,
}

/// A width on the axis of gaps.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Mark {
    name: String,
    source: String,
    /// Width \[m\].
    width: f64,
    /// Whether it is the smallest gap without pounding, and no rule.
    needed: bool,
}

/// Computes a curve and sends its points as they come.
pub(crate) fn points(
    engine: &Engine,
    tree: &ModelTree,
    curve: &Curve,
    send: &Sender<Point>,
    stop: &(dyn Fn() -> bool + Sync),
) {
    let records = curve.records.len().max(1);
    let count = curve.points.clamp(2, MOST_POINTS / records);
    let cases: Vec<(usize, usize)> = coarse_to_fine(count)
        .into_iter()
        .flat_map(|index| (0..records).map(move |record| (record, index)))
        .collect();
    let widens = curve.path.starts_with("gap") && curve.path.ends_with(".width");
    let apart: Vec<Apart> = (0..records).map(|_| Mutex::new(None)).collect();
    cases
        .into_par_iter()
        .for_each_with(send.clone(), |send, (record, index)| {
            if stop() {
                return;
            }
            let x = value(curve, index, count);
            let known = widens.then(|| beyond(&apart[record], x)).flatten();
            let y = known.or_else(|| one(engine, tree, curve, record, x, stop));
            if let Some(y) = y.filter(|y| widens && y[1] == 0.0) {
                keep_apart(&apart[record], x, y);
            }
            // A page that is gone wants no points.
            let _ = send.send(Point { record, x, y });
        });
}

/// Smallest width known to leave no impact, and the results there. Wider gaps give the same run.
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

/// Number of points that [`points`] computes.
pub(crate) fn count(curve: &Curve) -> usize {
    let records = curve.records.len().max(1);
    curve.points.clamp(2, MOST_POINTS / records) * records
}

/// The value of a point, without digits that come from arithmetic.
fn value(curve: &Curve, index: usize, count: usize) -> f64 {
    let share = index as f64 / (count - 1) as f64;
    let x = curve.from + share * (curve.to - curve.from);
    let x = format!("{x:.9e}").parse().unwrap_or(x);
    if curve.whole { x.round() } else { x }
}

fn one(
    engine: &Engine,
    tree: &ModelTree,
    curve: &Curve,
    record: usize,
    x: f64,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<[f64; 4]> {
    let mut tree = tree.clone();
    tree.set(&curve.path, &put(curve, x)).ok()?;
    if let Some(record) = curve.records.get(record) {
        tree.set("motion.record", &TreeValue::Text(record.clone()))
            .ok()?;
    }
    let prepared = engine.prepare(&tree, curve.run.record).ok()?;
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
    (outcome.end == jostle::RunEnd::Completed)
        .then(|| measures(&prepared.summary(&outcome, None, 0.0)))
}

/// A value as the model file takes it.
pub(crate) fn put(curve: &Curve, x: f64) -> TreeValue {
    if curve.whole {
        TreeValue::Integer(x as i64)
    } else if curve.unit.is_empty() {
        TreeValue::Number(x)
    } else {
        TreeValue::Text(format!("{x} {}", curve.unit))
    }
}

fn measures(summary: &Summary) -> [f64; 4] {
    let force = summary
        .gaps
        .iter()
        .map(|gap| gap.peak_force_n)
        .fold(0.0, f64::max);
    let impacts: usize = summary.gaps.iter().map(|gap| gap.impact_count).sum();
    let floors = || {
        summary
            .buildings
            .iter()
            .flat_map(|building| &building.floors)
    };
    let drift = floors()
        .map(|floor| floor.storey_drift_peak)
        .fold(0.0, f64::max);
    let acceleration = floors().map(|floor| floor.total_acceleration_peak_m_s2);
    [
        1e-3 * force,
        impacts as f64,
        100.0 * drift,
        acceleration.fold(0.0, f64::max),
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

/// The smallest gap without pounding, and those of rules, for the only gap of a model.
pub(crate) fn marks(
    engine: &Engine,
    tree: &ModelTree,
    curve: &Curve,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<Mark>, String> {
    let prepared = match engine.prepare(tree, curve.run.record) {
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
        ..GapSettings::default()
    };
    let found = critical_gaps(
        &prepared.input.model,
        &prepared.motion,
        &settings,
        stop,
        &|_| {},
    )
    .map_err(|error| error.to_string())?;
    let mut marks = Vec::new();
    for gap in &found {
        let pair = if found.len() > 1 {
            format!(", {}–{}", gap.between[0], gap.between[1])
        } else {
            String::new()
        };
        marks.push(Mark {
            name: format!("no pounding{pair}"),
            source: "smallest gap without pounding under this motion".into(),
            width: gap.gap_m,
            needed: true,
        });
        if found.len() == 1 {
            marks.extend(gap.rules.iter().map(|rule| Mark {
                name: rule.rule.clone(),
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
    fn every_point_comes_once_and_the_ends_first() {
        for count in [2, 3, 17, 200] {
            let mut order = coarse_to_fine(count);
            assert_eq!(order[..2], [0, count - 1]);
            order.sort_unstable();
            assert_eq!(order, (0..count).collect::<Vec<_>>());
        }
    }
}
