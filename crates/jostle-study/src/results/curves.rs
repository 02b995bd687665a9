//! Curves over the gap for every intensity, and demand over intensity (IDA).

use jostle::linear::{quantile, sort_by};
use jostle_io::Values;
use jostle_report::message;
use jostle_report::{Chart, Section, Series, Stroke};

use super::{Results, words};
use crate::study::StudyError;

/// Groups of curves at most.
const MOST_GROUPS: usize = 8;
/// Largest number of distinguishable lines in one chart.
const MOST_LINES: usize = 14;
/// Largest number of levels of one quantity that a sequence of colours tells apart.
const MOST_LEVELS: usize = 8;
/// Largest number of curves in one chart.
const MOST_CURVES: usize = 200;
/// Curves from which on fractiles are drawn.
const ENOUGH: usize = 5;

impl Results<'_> {
    /// Force and impacts over the gap, a line for every intensity.
    pub(super) fn curves(&self) -> Option<Section> {
        let (right, up) = self.plane()?;
        let (xs, ys) = (self.input(right), self.input(up));
        let (x_axis, x_size) = self.input_axis(right);
        let (y_axis, y_size) = self.input_axis(up);
        let mut charts = Vec::new();
        let groups = self.grouped(&self.others(&[right, up]));
        let levels = self.numbers(up);
        for (name, cases) in groups.into_iter().take(MOST_GROUPS) {
            for shown in ["peak_force_n", "impact_count"] {
                let values = self.table.column(shown);
                if values.is_empty() {
                    continue;
                }
                let (axis, size) = words::axis(shown);
                let lines: Vec<Vec<[f64; 2]>> = levels
                    .iter()
                    .map(|level| {
                        let of_level = cases.iter().filter(|case| ys[**case] == Some(*level));
                        let mut points: Vec<[f64; 2]> = of_level
                            .filter_map(|case| Some([x_size * xs[*case]?, size * values[*case]?]))
                            .collect();
                        sort_by(&mut points, |a, b| a[0].total_cmp(&b[0]));
                        means(&points)
                    })
                    .collect();
                let drawn = with_highest(spread(levels.len(), MOST_LEVELS), &lines);
                let series = drawn.into_iter().map(|level| Series {
                    name: jostle_report::with_unit(y_size * levels[level], &y_axis.unit),
                    points: lines[level].clone(),
                    band: Vec::new(),
                    stroke: Stroke::Dotted,
                    colour: level,
                });
                charts.push(Chart {
                    title: if name.is_empty() {
                        axis.name.clone()
                    } else {
                        format!("{}, {name}", axis.name)
                    },
                    x: x_axis.clone(),
                    y: axis,
                    series: series.collect(),
                    ordered: true,
                    ..Chart::default()
                });
            }
        }
        let most = charts.iter().map(|chart| chart.series.len()).max()?;
        Some(Section {
            title: message::over_factor(&x_axis.name),
            remark: if most < levels.len() {
                message::lines_shown(&y_axis.name, most, levels.len())
            } else {
                message::one_line_for_each(&y_axis.name)
            },
            charts,
            ..Section::default()
        })
    }

    /// Force, impacts and closing over the only number that varies, a line for every combination of the rest.
    pub(super) fn sweep_curves(&self) -> Option<Section> {
        let factor = self.sweep()?;
        let xs = self.input(factor);
        let (x_axis, x_size) = self.input_axis(factor);
        let groups = self.grouped(&self.others(&[factor]));
        let all = groups.len();
        let drawn = spread(all, MOST_LINES);
        let lines: Vec<_> = drawn.into_iter().map(|group| &groups[group]).collect();
        let mut charts = Vec::new();
        for shown in ["peak_force_n", "impact_count", "closing_peak_m"] {
            let values = self.table.column(shown);
            if values.is_empty() {
                continue;
            }
            let (axis, size) = words::axis(shown);
            let series = lines.iter().enumerate().map(|(colour, (name, cases))| {
                let mut points: Vec<[f64; 2]> = cases
                    .iter()
                    .filter_map(|case| Some([x_size * xs[*case]?, size * values[*case]?]))
                    .collect();
                sort_by(&mut points, |a, b| a[0].total_cmp(&b[0]));
                Series {
                    name: name.clone(),
                    points: means(&points),
                    band: Vec::new(),
                    stroke: Stroke::Dotted,
                    colour,
                }
            });
            charts.push(Chart {
                title: axis.name.clone(),
                x: x_axis.clone(),
                series: series.collect(),
                y: axis,
                ..Chart::default()
            });
        }
        (!charts.is_empty()).then(|| Section {
            title: message::over_factor(&x_axis.name),
            remark: if lines.len() < all {
                message::combinations_shown(lines.len(), all)
            } else {
                String::new()
            },
            charts,
            ..Section::default()
        })
    }

    /// The axis of an intensity: that of the factor that sets it, in its unit.
    fn intensity_axis(&self, intensity: &str) -> (jostle_report::Axis, f64) {
        let mut factors = self.study.file.factors.iter();
        let sets = |path: &String| path == "motion.pga" && intensity == "pga_m_s2";
        let factor = factors.position(|factor| !factor.multiplies && factor.paths.iter().any(sets));
        factor.map_or_else(|| words::axis(intensity), |factor| self.input_axis(factor))
    }

    /// Says between which intensities impacts begin.
    fn say_first_impact(&mut self, intensity: &str) {
        let impacts = self.table.column("impact_count");
        let cases = self.table.column(intensity).iter().zip(impacts);
        let known = cases.filter_map(|(value, count)| Some(((*value)?, (*count)?)));
        let touching = known.clone().filter(|(_, count)| *count > 0.0);
        let least = touching.map(|(value, _)| value).min_by(f64::total_cmp);
        let (axis, size) = self.intensity_axis(intensity);
        let shown = |value: f64| jostle_report::with_unit(size * value, &axis.unit);
        let Some(from) = least else { return };
        let below = known
            .filter(|(value, _)| *value < from)
            .map(|(value, _)| value);
        let said = match below.max_by(f64::total_cmp) {
            None => message::impacts_at_every_intensity(&axis.name, shown(from)),
            Some(below) => message::impacts_from_intensity(&axis.name, shown(below), shown(from)),
        };
        self.said.push(said);
    }

    /// Demand over intensity, one curve for every combination of the other factors, with fractiles.
    pub(super) fn idas(&mut self) -> Result<Vec<Section>, StudyError> {
        let mut sections = Vec::new();
        for (number, wanted) in self.study.file.idas.clone().iter().enumerate() {
            let intensity = self.table.column(&wanted.intensity).to_vec();
            let demand = self.table.column(&wanted.demand).to_vec();
            let along: Vec<usize> = (0..self.study.file.factors.len())
                .filter(|factor| {
                    let paths = &self.study.file.factors[*factor].paths;
                    let name = &self.study.layout.inputs[*factor].name;
                    *name == wanted.intensity
                        || paths.iter().any(|path| {
                            ["motion.pga", "motion.scale", "motion.match.value"]
                                .iter()
                                .any(|end| path.ends_with(end))
                        })
                })
                .collect();
            if number == 0 {
                self.say_first_impact(&wanted.intensity);
            }
            let groups = self.grouped(&self.others(&along));
            let (x, x_size) = words::axis(&wanted.demand);
            let (y, y_size) = self.intensity_axis(&wanted.intensity);
            let mut curves: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
            for (name, cases) in groups.iter().take(MOST_CURVES) {
                let mut points: Vec<[f64; 2]> = cases
                    .iter()
                    .filter(|case| self.completed(**case))
                    .filter_map(|case| Some([intensity[*case]?, demand[*case]?]))
                    .collect();
                sort_by(&mut points, |a, b| a[0].total_cmp(&b[0]));
                curves.push((name.clone(), means(&points)));
            }
            let fractiles = fractiles(&curves);
            let enough = !fractiles.is_empty();
            let draw = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
                points
                    .iter()
                    .map(|[i, d]| [x_size * d, y_size * i])
                    .collect()
            };
            let mut series: Vec<Series> = curves
                .iter()
                .enumerate()
                .map(|(index, (name, points))| Series {
                    name: if enough && index > 0 {
                        String::new()
                    } else if enough {
                        message::each_curve().into()
                    } else {
                        name.clone()
                    },
                    points: draw(points),
                    band: Vec::new(),
                    stroke: if enough { Stroke::Thin } else { Stroke::Dotted },
                    colour: if enough { 6 } else { index },
                })
                .collect();
            for (share, points) in &fractiles {
                series.push(Series {
                    name: format!("{:.0} %", 100.0 * share),
                    points: draw(points),
                    band: Vec::new(),
                    stroke: if *share == 0.5 {
                        Stroke::Heavy
                    } else {
                        Stroke::Dashed
                    },
                    colour: 1,
                });
            }
            let columns = ida_table(&wanted.intensity, &wanted.demand, &curves, &fractiles);
            let name = if number == 0 {
                "ida".to_owned()
            } else {
                format!("ida-{}", number + 1)
            };
            self.write(&name, message::demand_over_intensity_file(), columns)?;
            sections.push(Section {
                title: message::incremental_dynamic_analysis().into(),
                remark: if enough {
                    message::thin_curves_heavy_median().into()
                } else {
                    String::new()
                },
                charts: vec![Chart {
                    title: message::demand_up_to_intensity(&y.name, &x.name),
                    x,
                    y,
                    series,
                    ..Chart::default()
                }],
                ..Section::default()
            });
        }
        Ok(sections)
    }
}

/// At most `most` of the numbers below `count`, as evenly as they go, the first and the last among them.
pub(super) fn spread(count: usize, most: usize) -> Vec<usize> {
    let shown = count.min(most);
    let gaps = shown.saturating_sub(1).max(1);
    (0..shown)
        .map(|index| (index * (count - 1) + gaps / 2) / gaps)
        .collect()
}

/// Adds the line that reaches highest, if it is not among those drawn.
fn with_highest(mut drawn: Vec<usize>, lines: &[Vec<[f64; 2]>]) -> Vec<usize> {
    let height = |line: &Vec<[f64; 2]>| line.iter().map(|point| point[1]).fold(0.0, f64::max);
    let heights = lines.iter().map(height).enumerate();
    let highest = heights.max_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((highest, _)) = highest
        && !drawn.contains(&highest)
    {
        drawn.push(highest);
        drawn.sort_unstable();
    }
    drawn
}

/// Means of points at equal places, which follow each other.
fn means(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut means: Vec<[f64; 2]> = Vec::new();
    let mut rest = points;
    while let Some([x, _]) = rest.first() {
        let count = rest.iter().take_while(|p| p[0] == *x).count();
        let sum: f64 = rest[..count].iter().map(|p| p[1]).sum();
        means.push([*x, sum / count as f64]);
        rest = &rest[count..];
    }
    means
}

/// The 16th, 50th and 84th percentile of the demand at every intensity that enough curves have.
fn fractiles(curves: &[(String, Vec<[f64; 2]>)]) -> Vec<(f64, Vec<[f64; 2]>)> {
    let mut places: Vec<f64> = curves
        .iter()
        .flat_map(|(_, c)| c.iter().map(|p| p[0]))
        .collect();
    places.sort_by(f64::total_cmp);
    // Scaled peaks agree except for rounding.
    places.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * b.abs());
    let mut at_places: Vec<(f64, Vec<f64>)> = Vec::new();
    for place in places {
        let near = |p: &&[f64; 2]| (p[0] - place).abs() <= 1e-9 * place.abs();
        let mut demands: Vec<f64> = curves
            .iter()
            .filter_map(|(_, curve)| curve.iter().find(near).map(|p| p[1]))
            .collect();
        if demands.len() >= ENOUGH && 2 * demands.len() >= curves.len() {
            demands.sort_by(f64::total_cmp);
            at_places.push((place, demands));
        }
    }
    if at_places.len() < 2 {
        return Vec::new();
    }
    [0.16, 0.5, 0.84]
        .map(|share| {
            let points = at_places
                .iter()
                .map(|(place, d)| [*place, quantile(d, share)]);
            (share, points.collect())
        })
        .to_vec()
}

fn ida_table(
    intensity: &str,
    demand: &str,
    curves: &[(String, Vec<[f64; 2]>)],
    fractiles: &[(f64, Vec<[f64; 2]>)],
) -> Vec<(String, Values)> {
    let (mut names, mut xs, mut ds) = (Vec::new(), Vec::new(), Vec::new());
    let shares = fractiles
        .iter()
        .map(|(share, points)| (format!("fractile {share}"), points.clone()));
    for (name, points) in curves.iter().cloned().chain(shares) {
        for [x, d] in points {
            names.push(name.clone());
            xs.push(x);
            ds.push(d);
        }
    }
    vec![
        ("curve".into(), Values::Text(names)),
        (intensity.to_owned(), Values::Real(xs)),
        (demand.to_owned(), Values::Real(ds)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_chosen_evenly_and_the_strongest_is_among_them() {
        assert_eq!(spread(0, 8), [0; 0]);
        assert_eq!(spread(3, 8), [0, 1, 2]);
        assert_eq!(spread(24, 8), [0, 3, 7, 10, 13, 16, 20, 23]);
        let lines: Vec<Vec<[f64; 2]>> = (0..24)
            .map(|level| vec![[0.0, if level == 22 { 9.0 } else { 1.0 }]])
            .collect();
        let drawn = with_highest(spread(24, 8), &lines);
        assert_eq!(drawn, [0, 3, 7, 10, 13, 16, 20, 22, 23]);
    }
}
