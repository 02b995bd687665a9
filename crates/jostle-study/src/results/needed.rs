//! The required gap at every intensity, compared with the rules.

use jostle::Structure;
use jostle::separation::{ddc_coefficient, double_difference, gb50011_frame_joint, srss};
use jostle_io::shown::LENGTH;
use jostle_report::message;
use jostle_report::{Chart, Level, Section, Series, Stroke};

use super::{Results, words};
use crate::study::Study;

/// Columns that [`Results::needed_gap`] reads: peaks of the highest common floors of the first gap.
pub(super) fn columns(study: &Study) -> Vec<String> {
    places(study).map_or(Vec::new(), |places| {
        let mut names: Vec<String> = places
            .roofs
            .iter()
            .flat_map(|roof| {
                [
                    format!("{roof}.displacement_max_m"),
                    format!("{roof}.displacement_min_m"),
                ]
            })
            .collect();
        names.extend(places.names.iter().map(|name| format!("{name}.period_s")));
        names
    })
}

struct Places {
    names: [String; 2],
    /// The highest common floor of either neighbour, as its columns begin.
    roofs: [String; 2],
    height: f64,
    damping: f64,
}

/// The highest floors that face each other in the base model.
fn places(study: &Study) -> Option<Places> {
    let model = study.file.base.input().ok()?.model;
    let gap = model.gaps.first().filter(|_| model.gaps.len() == 1)?;
    let [Some(left), Some(right)] = gap.between else {
        return None;
    };
    let pair = [&model.buildings[left], &model.buildings[right]];
    let levels = pair.map(|building| building.floor_levels());
    let top = levels[0]
        .iter()
        .enumerate()
        .rev()
        .find_map(|(left, height)| {
            let right = levels[1].iter().position(|h| (h - height).abs() < 1e-3)?;
            Some([left, right])
        })?;
    let height = pair.iter().filter_map(|own| own.floor_heights().pop());
    let ratio = |building: &jostle::Building| match building.damping {
        jostle::Damping::Ratio { ratio, .. } | jostle::Damping::AllModes { ratio } => ratio,
        jostle::Damping::Rayleigh { .. } => 0.05,
    };
    let frames = pair
        .iter()
        .all(|building| matches!(building.structure, Structure::Frame(_)));
    Some(Places {
        names: pair.map(|building| building.name.clone()),
        roofs: [0, 1].map(|side| format!("{}.floor{}", pair[side].name, top[side] + 1)),
        height: if frames {
            height.fold(f64::INFINITY, f64::min)
        } else {
            f64::NAN
        },
        damping: (ratio(pair[0]) * ratio(pair[1])).sqrt(),
    })
}

impl Results<'_> {
    /// The smallest gap of the study without an impact at every intensity, and what rules make of the peaks of
    /// buildings that did not touch.
    pub(super) fn needed_gap(&mut self) -> Option<Section> {
        let (right, up) = self.plane()?;
        let is_width = |path: &String| path.ends_with(".width");
        let factor = &self.study.file.factors[right];
        // Multiples of widths are not widths.
        if factor.multiplies || !factor.paths.iter().any(is_width) {
            return None;
        }
        let (gaps, intensities) = (self.input(right), self.input(up));
        let (gap_axis, gap_size) = words::axis(&self.study.layout.inputs[right].name);
        let (axis, size) = words::axis(&self.study.layout.inputs[up].name);
        let impacts = self.table.column("impact_count").to_vec();
        let groups = self.grouped(&self.others(&[right, up]));
        let places = places(self.study);
        let levels = self.numbers(up);
        let widest = self.numbers(right).last().copied().unwrap_or(0.0);
        let mut series = Vec::new();
        for (colour, (name, cases)) in groups.iter().enumerate().take(7) {
            let (mut needed, mut between) = (Vec::new(), Vec::new());
            let mut rules: [Vec<[f64; 2]>; 3] = Default::default();
            for level in &levels {
                let own = || {
                    cases
                        .iter()
                        .filter(|case| intensities[**case] == Some(*level))
                };
                let hit = own().filter(|case| impacts[**case].is_some_and(|count| count > 0.0));
                let hit = hit.filter_map(|case| gaps[*case]).fold(-1.0, f64::max);
                let free = own()
                    .filter(|case| impacts[**case] == Some(0.0))
                    .filter_map(|case| gaps[*case])
                    .filter(|gap| *gap > hit)
                    .fold(f64::INFINITY, f64::min);
                if free.is_finite() {
                    needed.push([size * level, gap_size * free]);
                    between.push([gap_size * hit.max(0.0), gap_size * free]);
                }
                // All records and draws alike: the same cases at every intensity.
                let apart: Vec<usize> = own()
                    .filter(|case| gaps[**case] == Some(widest))
                    .copied()
                    .collect();
                let free = apart.iter().all(|case| impacts[*case] == Some(0.0));
                if let (true, Some(places)) = (free, &places) {
                    self.rules(&apart, places, [size * level, gap_size], &mut rules);
                }
            }
            let label = |what: &str| {
                if name.is_empty() {
                    what.to_owned()
                } else {
                    format!("{what}, {name}")
                }
            };
            series.push(Series {
                name: label(message::needed_gap()),
                points: needed,
                band: between,
                stroke: Stroke::Dotted,
                colour,
            });
            for (rule, points) in ["ABS", "SRSS", "DDC"].into_iter().zip(rules) {
                if groups.len() == 1 && !points.is_empty() {
                    series.push(Series {
                        name: rule.to_owned(),
                        points,
                        band: Vec::new(),
                        stroke: Stroke::Dashed,
                        colour: series.len(),
                    });
                }
            }
        }
        let height = places.map_or(f64::NAN, |places| places.height);
        let codes = [7, 8, 9].into_iter().filter_map(|intensity| {
            Some(Level {
                name: message::gb50011_of_intensity(intensity),
                value: gap_size
                    * gb50011_frame_joint(height, intensity).filter(|_| height.is_finite())?,
            })
        });
        let mut codes: Vec<Level> = codes.collect();
        // Lines that nearly coincide would write over each other.
        if let [first, .., last] = &codes[..]
            && last.value - first.value < 0.08 * gap_size * widest
        {
            let joined = Level {
                name: message::gb50011_of_intensities(
                    format_args!("{:.*}", LENGTH.decimals(0), first.value),
                    format_args!("{:.*}", LENGTH.decimals(0), last.value),
                ),
                value: first.value,
            };
            codes = vec![joined];
        }
        Some(Section {
            title: message::required_gap().into(),
            remark: message::needed_gap_and_rules().into(),
            charts: vec![Chart {
                title: message::smallest_gap_and_rules().into(),
                x: axis,
                y: gap_axis,
                series,
                levels: codes,
                reach: gap_size * widest,
                ordered: false,
            }],
            ..Section::default()
        })
    }

    /// Adds the greatest gap of each rule over cases without contact.
    fn rules(
        &self,
        cases: &[usize],
        places: &Places,
        [x, size]: [f64; 2],
        into: &mut [Vec<[f64; 2]>; 3],
    ) {
        let of_cases = cases.iter().filter_map(|case| self.rules_of(*case, places));
        let greatest = of_cases.reduce(|a, b| [0, 1, 2].map(|rule| a[rule].max(b[rule])));
        for (points, gap) in into.iter_mut().zip(greatest.into_iter().flatten()) {
            if gap.is_finite() {
                points.push([x, size * gap]);
            }
        }
    }

    /// Gaps by ABS, SRSS and DDC, the last not a number without periods and damping \[m\].
    fn rules_of(&self, case: usize, places: &Places) -> Option<[f64; 3]> {
        let value = |name: String| self.table.column(&name).get(case).copied().flatten();
        let peak = |roof: &String| {
            let high = value(format!("{roof}.displacement_max_m"))?;
            let low = value(format!("{roof}.displacement_min_m"))?;
            Some(high.max(-low))
        };
        let [left, right] = [peak(&places.roofs[0])?, peak(&places.roofs[1])?];
        let periods = places
            .names
            .each_ref()
            .map(|name| value(format!("{name}.period_s")));
        let difference = match periods {
            [Some(a), Some(b)] if places.damping > 0.0 => {
                let rho = ddc_coefficient([a, b], [places.damping; 2]);
                double_difference(left, right, rho)
            }
            _ => f64::NAN,
        };
        Some([left + right, srss(left, right), difference])
    }
}
