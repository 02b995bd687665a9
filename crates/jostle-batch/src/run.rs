//! Rows in, peaks out, in order.

use std::ops::ControlFlow;

use rayon::prelude::*;

use crate::lanes::Real;
use crate::pack::{Shape, simulate};
use crate::peaks::Peaks;
use crate::row::{Building, Law, MOST_BUILDINGS, MOST_STOREYS, Motion, Row, Rule};

/// Rows taken at once: many enough to fill lanes with alike rows, few enough for constant memory.
const TAKEN: usize = 16384;

/// Numbers of a lane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `f32`, 8 lanes.
    #[default]
    Single,
    /// `f64`, 4 lanes.
    Double,
}

/// How rows are stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Step times the highest circular frequency of the row \[–\], above 0 to 0.5.
    pub phase: f64,
    /// Numbers of a lane.
    pub precision: Precision,
}

impl Options {
    /// For 99.5 % of peaks within a relative tolerance, 1e-3 or looser \[–\].
    #[must_use]
    pub fn for_tolerance(tolerance: f64) -> Self {
        let phase = if tolerance >= 1e-2 { 0.1 } else { 0.025 };
        Self {
            phase,
            precision: Precision::Single,
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self::for_tolerance(1e-3)
    }
}

/// What cannot be stepped.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("row {row}: {fault}")]
pub struct Error {
    /// Row from 0.
    pub row: usize,
    /// What is wrong, and where.
    pub fault: String,
}

/// Steps rows through their motions and hands the peaks of each to `sink` with its number, in order; memory stays
/// constant. Threads are those of the current rayon pool; neither they nor the order of rows change any bit. Stops
/// early when the sink breaks.
///
/// # Errors
///
/// When a row has a number out of range; rows before it in earlier portions of 16,384 were handed on.
pub fn run(
    motions: &[Motion],
    rows: impl IntoIterator<Item = Row>,
    options: &Options,
    mut sink: impl FnMut(usize, Peaks) -> ControlFlow<()>,
) -> Result<(), Error> {
    run_boxed(motions, &mut rows.into_iter(), options, &mut sink)
}

/// What takes the peaks of a row.
type Sink<'a> = &'a mut dyn FnMut(usize, Peaks) -> ControlFlow<()>;

/// [`run`] without type parameters, so that stepping is compiled in this crate, as this crate is.
fn run_boxed(
    motions: &[Motion],
    rows: &mut dyn Iterator<Item = Row>,
    options: &Options,
    sink: Sink<'_>,
) -> Result<(), Error> {
    match options.precision {
        Precision::Single => run_in::<f32, 8>(motions, rows, options.phase, sink),
        Precision::Double => run_in::<f64, 4>(motions, rows, options.phase, sink),
    }
}

/// [`run`] with a width.
pub(crate) fn run_in<T: Real, const W: usize>(
    motions: &[Motion],
    rows: &mut dyn Iterator<Item = Row>,
    phase: f64,
    sink: Sink<'_>,
) -> Result<(), Error> {
    let mut first = 0;
    loop {
        let taken: Vec<Row> = (&mut *rows).take(TAKEN).collect();
        if taken.is_empty() {
            return Ok(());
        }
        let mut shapes = Vec::with_capacity(taken.len());
        for (at, row) in taken.iter().enumerate() {
            check(row, motions, phase).map_err(|fault| Error {
                row: first + at,
                fault,
            })?;
            shapes.push((Shape::of(row, motions, phase), at));
        }
        // Rows of one shape side by side, those of like size next to each other.
        shapes.sort();
        let packs: Vec<&[(Shape, usize)]> = shapes
            .chunk_by(|a, b| a.0.shares_lanes_with(&b.0))
            .flat_map(|alike| alike.chunks(W))
            .collect();
        let results: Vec<Vec<(usize, Peaks)>> = packs
            .par_iter()
            .map(|pack| {
                let taken: Vec<&Row> = pack.iter().map(|(_, at)| &taken[*at]).collect();
                let peaks = simulate::<T, W>(&pack[0].0, &taken, motions);
                pack.iter().map(|(_, at)| *at).zip(peaks).collect()
            })
            .collect();
        let mut results: Vec<(usize, Peaks)> = results.into_iter().flatten().collect();
        results.sort_by_key(|(at, _)| *at);
        for (at, peaks) in results {
            if sink(first + at, peaks).is_break() {
                return Ok(());
            }
        }
        first += taken.len();
    }
}

/// The first number out of range.
fn check(row: &Row, motions: &[Motion], phase: f64) -> Result<(), String> {
    let (count, gaps) = (row.buildings.len(), row.gaps.len());
    let within = |name: &str, value: f64, least: f64, most: f64| {
        if (least..=most).contains(&value) {
            Ok(())
        } else {
            Err(format!(
                "{name} must lie between {least:e} and {most:e}, found {value:e}"
            ))
        }
    };
    const LEAST: f64 = 1e-12;
    const MOST: f64 = 1e15;
    within("phase", phase, 1e-6, 0.5)?;
    if !(1..=MOST_BUILDINGS).contains(&count) || gaps + 1 != count {
        return Err(format!(
            "1 to {MOST_BUILDINGS} buildings and one gap fewer are needed, found {count} and {gaps}"
        ));
    }
    let Some(motion) = motions.get(row.motion) else {
        return Err(format!(
            "motion {} of {} does not exist",
            row.motion,
            motions.len()
        ));
    };
    within("motion.step", motion.step, 1e-6, 10.0)?;
    if motion.acceleration.len() < 2 || !motion.acceleration.iter().all(|a| a.abs() < MOST) {
        return Err("a motion needs two or more finite accelerations".into());
    }
    within("scale", row.scale, -1e6, 1e6)?;
    for (at, building) in row.buildings.iter().enumerate() {
        let named = |fault: String| format!("building {at}: {fault}");
        check_building(building, within).map_err(named)?;
    }
    for (at, gap) in row.gaps.iter().enumerate() {
        let named = |fault: String| format!("gap {at}: {fault}");
        within("width", gap.width, 0.0, 1e6).map_err(named)?;
        let numbers = match gap.law {
            Some(Law::HertzDamp {
                stiffness,
                restitution,
            }) => Some((stiffness, restitution, 0.0)),
            Some(Law::Kelvin {
                stiffness,
                restitution,
            }) => Some((stiffness, restitution, LEAST)),
            Some(Law::Linear { stiffness }) => Some((stiffness, 1.0, 0.0)),
            None => None,
        };
        if let Some((stiffness, restitution, least)) = numbers {
            within("stiffness", stiffness, LEAST, MOST).map_err(named)?;
            within("restitution", restitution, least, 1.0).map_err(named)?;
        }
        for contact in &gap.contacts {
            for (face, building) in [(contact.left, at), (contact.right, at + 1)] {
                let storeys = row.buildings[building].storeys.len();
                if face.floor >= storeys || !(face.share > 0.0 && face.share <= 1.0) {
                    return Err(named(format!(
                        "a contact is at floor {} with share {}; building {building} has {storeys} floors from 0 \
                         and shares lie above 0 up to 1",
                        face.floor, face.share
                    )));
                }
            }
        }
    }
    Ok(())
}

fn check_building(
    building: &Building,
    within: impl Fn(&str, f64, f64, f64) -> Result<(), String>,
) -> Result<(), String> {
    const LEAST: f64 = 1e-12;
    const MOST: f64 = 1e15;
    if !(1..=MOST_STOREYS).contains(&building.storeys.len()) {
        let found = building.storeys.len();
        return Err(format!(
            "1 to {MOST_STOREYS} storeys are needed, found {found}"
        ));
    }
    within("alpha", building.alpha, 0.0, 1e6)?;
    within("beta", building.beta, 0.0, 1e3)?;
    if let Rule::Pinched {
        deformation,
        force,
        unloading_exponent,
    } = building.rule
    {
        within("deformation", deformation, 0.0, 1.0)?;
        within("force", force, 0.0, 1.0)?;
        within("unloading_exponent", unloading_exponent, 0.0, 1.0)?;
    }
    for storey in &building.storeys {
        within("mass", storey.mass, LEAST, MOST)?;
        within("stiffness", storey.stiffness, LEAST, MOST)?;
        within("height", storey.height, 1e-3, 1e3)?;
        if building.rule != Rule::Elastic {
            within("first_corner", storey.first_corner, LEAST, 1e6)?;
            within("second_ratio", storey.second_ratio, 0.0, 1.0)?;
        }
        if !matches!(building.rule, Rule::Elastic | Rule::Bilinear) {
            within(
                "second_corner",
                storey.second_corner,
                storey.first_corner,
                1e6,
            )?;
            within("third_ratio", storey.third_ratio, 0.0, storey.second_ratio)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row::{Gap, Storey};

    #[test]
    fn the_width_of_registers_changes_no_bit() {
        let building = |n: usize, exponent: f64| Building {
            storeys: vec![
                Storey {
                    mass: 1e5,
                    stiffness: 4e7 * (1.0 + n as f64),
                    height: 3.0,
                    first_corner: 0.003,
                    second_corner: 0.02,
                    second_ratio: 0.15,
                    third_ratio: 0.001,
                };
                1 + n % 4
            ],
            rule: Rule::Pinched {
                deformation: 0.8,
                force: 0.6,
                unloading_exponent: exponent,
            },
            alpha: 0.4,
            beta: 0.001,
        };
        let law = Some(Law::HertzDamp {
            stiffness: 2e9,
            restitution: 0.65,
        });
        let row = |n: usize| {
            let buildings = vec![building(n, 0.3), building(2 * n + 1, 0.1)];
            let gap = Gap::between(&buildings[0], &buildings[1], 0.004, law, 0.0);
            Row {
                buildings,
                gaps: vec![gap],
                motion: 0,
                scale: 1.0,
            }
        };
        let wave = |i: usize| 4.0 * libm::sin(0.3 * i as f64 + 2e-4 * (i * i) as f64);
        let motion = Motion {
            step: 0.02,
            acceleration: (0..300).map(wave).collect(),
        };
        let all = |width: usize| {
            let rows = &mut (0..40).map(row);
            let mut all = Vec::new();
            let sink = &mut |_, peaks: Peaks| {
                all.push(peaks);
                ControlFlow::Continue(())
            };
            let motions = std::slice::from_ref(&motion);
            let done = match width {
                1 => run_in::<f32, 1>(motions, rows, 0.1, sink),
                4 => run_in::<f32, 4>(motions, rows, 0.1, sink),
                8 => run_in::<f32, 8>(motions, rows, 0.1, sink),
                _ => run_in::<f32, 16>(motions, rows, 0.1, sink),
            };
            done.expect("rows in range");
            all
        };
        let narrow = all(1);
        assert!(
            narrow
                .iter()
                .any(|own| own.gaps[0].iter().any(|own| own.impacts > 2))
        );
        for width in [4, 8, 16] {
            assert_eq!(all(width), narrow, "{width} lanes");
        }
    }
}
