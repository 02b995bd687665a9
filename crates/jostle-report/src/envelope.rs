//! Envelopes of the buildings, as small plots without scripts.

use jostle::history::{Column, History};
use jostle::model::Model;
use maud::{Markup, html};

use crate::message;
use crate::scale::{Scale, place};
use crate::{Page, format};

/// Peaks of one building: values from the lowest floor up.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Envelope {
    /// Greatest displacement to the right \[m\].
    pub(crate) greatest: Vec<f64>,
    /// Greatest displacement to the left \[m\].
    pub(crate) least: Vec<f64>,
    /// Greatest storey drift ratio, either sign \[–\].
    pub(crate) drift: Vec<f64>,
    /// Greatest total acceleration, either sign \[m/s²\]; empty if it was not recorded.
    pub(crate) acceleration: Vec<f64>,
    /// Greatest storey shear and overturning moment about the base of the storey, either sign; empty if unknown
    /// \[N, N·m\].
    pub(crate) shear: Vec<f64>,
    pub(crate) moment: Vec<f64>,
    /// Storey drift ratio at the end, positive to the right \[–\].
    pub(crate) residual: Vec<f64>,
    /// Greatest displacements to the right and to the left and total acceleration of the mat of an isolated building.
    pub(crate) mat: Option<[f64; 3]>,
}

/// Envelopes of every building of the run, from its summary.
pub(crate) fn of_run(page: &Page) -> Vec<Envelope> {
    page.summary
        .buildings
        .iter()
        .map(|building| {
            let floors = &building.floors;
            Envelope {
                greatest: floors
                    .iter()
                    .map(|f| f.response.displacement_max_m)
                    .collect(),
                least: floors
                    .iter()
                    .map(|f| f.response.displacement_min_m)
                    .collect(),
                drift: floors
                    .iter()
                    .map(|f| f.response.storey_drift_peak)
                    .collect(),
                acceleration: floors
                    .iter()
                    .map(|f| f.response.total_acceleration_peak_m_s2)
                    .collect(),
                shear: floors
                    .iter()
                    .map(|f| f.response.storey_shear_peak_n)
                    .collect(),
                moment: floors
                    .iter()
                    .map(|f| f.response.overturning_moment_peak_n_m)
                    .collect(),
                residual: floors.iter().map(|f| f.response.residual_drift).collect(),
                mat: floors.mat.as_ref().map(|mat| {
                    [
                        mat.response.displacement_max_m,
                        mat.response.displacement_min_m,
                        mat.response.total_acceleration_peak_m_s2,
                    ]
                }),
            }
        })
        .collect()
}

/// Envelopes of every building of a history, from its recorded instants.
pub(crate) fn of_history(model: &Model, history: &History) -> Vec<Envelope> {
    model
        .buildings
        .iter()
        .enumerate()
        .map(|(building, shape)| {
            let mut envelope = Envelope::default();
            // The mat, if there is one; floors of other buildings count from 1.
            let mut below = history.column(Column::displacement(building, 0));
            envelope.mat = below.as_ref().map(|u| {
                let a = history.column(Column::total_acceleration(building, 0));
                let a = a.unwrap_or_default();
                [
                    u.iter().copied().fold(0.0, f64::max),
                    u.iter().copied().fold(0.0, f64::min),
                    a.iter().fold(0.0, |peak, a| a.abs().max(peak)),
                ]
            });
            for (storey, height) in shape.storey_heights().iter().enumerate() {
                let floor = storey + 1;
                let Some(u) = history.column(Column::displacement(building, floor)) else {
                    break;
                };
                envelope
                    .greatest
                    .push(u.iter().copied().fold(0.0, f64::max));
                envelope.least.push(u.iter().copied().fold(0.0, f64::min));
                let drift = u.iter().enumerate().fold(0.0, |peak: f64, (row, u)| {
                    let lower = below.as_ref().map_or(0.0, |below| below[row]);
                    peak.max((u - lower).abs())
                });
                envelope.drift.push(drift / height);
                let end = |u: &[f64]| u.last().copied().unwrap_or(0.0);
                let left = end(&u) - below.as_deref().map_or(0.0, end);
                envelope.residual.push(left / height);
                below = Some(u);
                if let Some(a) = history.column(Column::total_acceleration(building, floor)) {
                    envelope
                        .acceleration
                        .push(a.iter().fold(0.0, |peak: f64, a| peak.max(a.abs())));
                }
            }
            envelope
        })
        .collect()
}

/// Envelopes of the run without contact, if there was one: from its history, and what the summary has of its forces.
pub(crate) fn without_contact(page: &Page) -> Option<Vec<Envelope>> {
    let mut envelopes = of_history(page.model, page.without_contact?);
    for (envelope, building) in envelopes.iter_mut().zip(&page.summary.buildings) {
        let floors = building.floors.iter().filter_map(|f| f.without_contact);
        envelope.shear = floors.clone().map(|f| f.storey_shear_peak_n).collect();
        envelope.moment = floors.map(|f| f.overturning_moment_peak_n_m).collect();
    }
    Some(envelopes)
}

/// One line of a small picture: (value, height above the datum of elevations) from the base up.
struct Line {
    building: usize,
    dashed: bool,
    points: Vec<(f64, f64)>,
    /// What the pointer reads at a point.
    meaning: &'static str,
}

/// Section with the pictures; drift that is left only where something yielded.
pub(crate) fn envelopes(page: &Page, run: &[Envelope], without: Option<&[Envelope]>) -> Markup {
    let levels: Vec<Levels> = page.model.buildings.iter().map(Levels::new).collect();
    let mut displacement = Vec::new();
    let mut drift = Vec::new();
    let mut acceleration = Vec::new();
    let (mut shear, mut moment) = (Vec::new(), Vec::new());
    let mut residual = Vec::new();
    let yields = page.summary.buildings.iter().any(|b| b.hinges.yielded > 0);
    let sets = without.map(|w| (w, true)).into_iter().chain([(run, false)]);
    for (set, dashed) in sets {
        for (building, (envelope, levels)) in set.iter().zip(&levels).enumerate() {
            let line = |points, meaning| Line {
                building,
                dashed,
                points,
                meaning,
            };
            let both = [
                (&envelope.greatest, 0, message::to_the_right()),
                (&envelope.least, 1, message::to_the_left()),
            ];
            for (values, side, meaning) in both {
                let base = envelope.mat.map_or(0.0, |mat| mat[side]);
                displacement.push(line(
                    from_base(base, values, levels, format::LENGTH.of(1.0)),
                    meaning,
                ));
            }
            drift.push(line(
                steps(&envelope.drift, levels, 100.0),
                message::drift_of_the_storey(),
            ));
            shear.push(line(
                steps(&envelope.shear, levels, format::FORCE.of(1.0)),
                message::storey_shear(),
            ));
            moment.push(line(
                at_bases(&envelope.moment, levels, format::LARGE_MOMENT.of(1.0)),
                message::overturning_moment(),
            ));
            residual.push(line(
                steps(&envelope.residual, levels, 100.0),
                message::drift_at_the_end(),
            ));
            let floors = envelope
                .acceleration
                .iter()
                .copied()
                .zip(levels.floors.iter().copied());
            let mut points: Vec<(f64, f64)> = floors.collect();
            if !points.is_empty() {
                let base = envelope.mat.map_or(page.motion.peak(), |mat| mat[2]);
                points.insert(0, (base, levels.base));
            }
            for point in &mut points {
                point.0 = format::ACCELERATION.of(point.0);
            }
            acceleration.push(line(points, message::either_sign()));
        }
    }
    let all = levels.iter().flat_map(|level| &level.floors).copied();
    let low = levels.iter().map(|level| level.base).fold(0.0, f64::min);
    let ends = [low, all.fold(0.0, f64::max).max(low + 1e-3)];
    html! {
        div.multiples {
            (picture(message::displacement_title(), format::LENGTH.name(), ends, &displacement, page))
            (picture(message::storey_drift_title(), "%", ends, &drift, page))
            (picture(message::total_acceleration_title(), format::ACCELERATION.name(), ends, &acceleration, page))
            (picture(message::storey_shear_title(), format::FORCE.name(), ends, &shear, page))
            (picture(message::overturning_moment_title(), format::LARGE_MOMENT.name(), ends, &moment, page))
            @if yields { (picture(message::residual_drift(), "%", ends, &residual, page)) }
        }
    }
}

/// Heights above the datum of elevations \[m\].
struct Levels {
    base: f64,
    floors: Vec<f64>,
}

impl Levels {
    fn new(building: &jostle::Building) -> Self {
        Self {
            base: building.base.elevation,
            floors: building.floor_levels(),
        }
    }
}

fn from_base(base: f64, values: &[f64], levels: &Levels, factor: f64) -> Vec<(f64, f64)> {
    let floors = values.iter().map(|value| value * factor);
    std::iter::once((base * factor, levels.base))
        .chain(floors.zip(levels.floors.iter().copied()))
        .collect()
}

/// A value at the base of each storey, none at the top.
fn at_bases(values: &[f64], levels: &Levels, factor: f64) -> Vec<(f64, f64)> {
    let bases = std::iter::once(levels.base).chain(levels.floors.iter().copied());
    let points = values.iter().map(|value| value * factor).zip(bases);
    let top = levels.floors.last().filter(|_| !values.is_empty());
    points.chain(top.map(|top| (0.0, *top))).collect()
}

/// A value constant over each storey.
fn steps(values: &[f64], levels: &Levels, factor: f64) -> Vec<(f64, f64)> {
    let mut base = levels.base;
    let mut points = Vec::new();
    for (value, height) in values.iter().zip(&levels.floors) {
        points.push((value * factor, base));
        points.push((value * factor, *height));
        base = *height;
    }
    points
}

const WIDTH: f64 = 320.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 38.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 30.0;

fn picture(title: &str, unit: &str, [low, top]: [f64; 2], lines: &[Line], page: &Page) -> Markup {
    let (foot, head) = (low, low + 1.03 * (top - low));
    let values = || {
        lines
            .iter()
            .flat_map(|line| line.points.iter().map(|p| p.0))
            .filter(|v| v.is_finite())
    };
    let low = values().fold(0.0, f64::min);
    let high = values().fold(0.0, f64::max);
    let span = if high > low { high - low } else { 1.0 };
    let (low, high) = (
        if low < 0.0 { low - 0.05 * span } else { 0.0 },
        high + 0.05 * span,
    );
    let x = Scale::new([low, high], [LEFT, WIDTH - RIGHT], 1.0, 5.0);
    let y = Scale::new(
        [foot, head],
        [HEIGHT - BOTTOM, TOP],
        format::HEIGHT.size(),
        6.0,
    );
    html! {
        figure.multiple {
            figcaption { (title) " " span.unit { "[" (unit) "]" } }
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(message::over_the_height(title)) {
                g.grid {
                    (x.across([TOP, HEIGHT - BOTTOM]))
                    (y.up([LEFT, WIDTH - RIGHT]))
                    text x=(LEFT - 6.0) y="10" text-anchor="end" { (format::HEIGHT.name()) }
                }
                @for line in lines {
                    polyline.line.dashed[line.dashed] style=(crate::document::colour(line.building)) points=(path(line, &x, &y)) {}
                }
                @for line in lines.iter().filter(|line| !line.dashed) {
                    @for (value, height) in &line.points {
                        @if *height > line.points[0].1 && value.is_finite() {
                            circle.dot style=(crate::document::colour(line.building)) cx=(place(x.at(*value))) cy=(place(y.at(*height))) r="5" {
                                title {
                                    (page.model.buildings.get(line.building).map_or("", |b| b.name.as_str())) ", "
                                    (format::in_unit(format::HEIGHT, *height, 2)) " " (format::HEIGHT.name()) ": " (format::significant(*value, 4)) " " (unit) ", " (line.meaning)
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn path(line: &Line, x: &Scale, y: &Scale) -> String {
    let points = line.points.iter().filter(|(value, _)| value.is_finite());
    let texts: Vec<String> = points
        .map(|(value, height)| format!("{:.1},{:.1}", x.at(*value), y.at(*height)))
        .collect();
    texts.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drift_is_constant_within_a_storey() {
        let levels = Levels {
            base: -1.5,
            floors: vec![1.5, 4.5],
        };
        assert_eq!(
            steps(&[0.01, 0.02], &levels, 100.0),
            vec![(1.0, -1.5), (1.0, 1.5), (2.0, 1.5), (2.0, 4.5)]
        );
        assert_eq!(
            at_bases(&[7.0, 3.0], &levels, 1.0),
            vec![(7.0, -1.5), (3.0, 1.5), (0.0, 4.5)]
        );
    }
}
