//! Results over inputs of sampled studies: every case as a dot, the mean and the middle two thirds over classes of an input.

use jostle::linear::{quantile, sort_by};
use jostle_report::message;
use jostle_report::{Chart, Section, Series, Stroke};

use super::{Results, rankings, words};
use crate::layout::Kind;
use crate::statistics::{classes, given_data};

/// Inputs of a result that are drawn, those of greatest influence.
const MOST_INPUTS: usize = 6;
/// Dots of a chart at most.
const MOST_DOTS: usize = 1000;

impl Results<'_> {
    /// Every result that is ranked, over the inputs that matter most.
    pub(super) fn scatter(&self, responses: &[String]) -> Option<Section> {
        if !rankings::is_sampled(self.study) {
            return None;
        }
        let mut charts = Vec::new();
        for response in responses {
            let values = self.table.column(response);
            let (y_axis, y_size) = words::axis(response);
            let mut inputs: Vec<(f64, usize)> = (0..self.study.file.factors.len())
                .filter(|factor| self.study.layout.inputs[*factor].kind != Kind::Text)
                .filter_map(|factor| {
                    let found = given_data(&self.input(factor), values, true)?;
                    Some((found.first_order, factor))
                })
                .collect();
            sort_by(&mut inputs, |a, b| b.0.total_cmp(&a.0));
            for (_, factor) in inputs.into_iter().take(MOST_INPUTS) {
                let (x_axis, x_size) = self.input_axis(factor);
                let xs = self.input(factor);
                let mut points: Vec<[f64; 2]> = xs
                    .iter()
                    .zip(values)
                    .filter_map(|(x, y)| Some([x_size * (*x)?, y_size * (*y)?]))
                    .collect();
                let every = points.len().div_ceil(MOST_DOTS).max(1);
                let dots = points.iter().step_by(every).copied().collect();
                sort_by(&mut points, |a, b| a[0].total_cmp(&b[0]));
                charts.push(Chart {
                    title: message::result_over_input(&y_axis.name, &x_axis.name),
                    x: x_axis,
                    y: y_axis.clone(),
                    series: vec![
                        Series {
                            name: message::cases_head().into(),
                            points: dots,
                            band: Vec::new(),
                            stroke: Stroke::Dots,
                            colour: 6,
                        },
                        marginal(&points),
                    ],
                    ..Chart::default()
                });
            }
        }
        (!charts.is_empty()).then(|| Section {
            title: message::results_over_inputs().into(),
            remark: message::dots_mean_and_band().into(),
            charts,
            ..Section::default()
        })
    }
}

/// Mean, and 16th to 84th percentile, of classes of sorted points.
fn marginal(points: &[[f64; 2]]) -> Series {
    let (mut means, mut band) = (Vec::new(), Vec::new());
    for class in classes(points, true) {
        let mean =
            |which: usize| class.iter().map(|point| point[which]).sum::<f64>() / class.len() as f64;
        means.push([mean(0), mean(1)]);
        let mut values: Vec<f64> = class.iter().map(|point| point[1]).collect();
        values.sort_by(f64::total_cmp);
        band.push([quantile(&values, 0.16), quantile(&values, 0.84)]);
    }
    Series {
        name: message::mean_of_records().into(),
        points: means,
        band,
        stroke: Stroke::Heavy,
        colour: 1,
    }
}
