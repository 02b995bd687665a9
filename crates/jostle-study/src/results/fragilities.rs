//! Fragility curves with bands.

use std::collections::BTreeMap;

use jostle::linear::sort_by;
use jostle_io::{FragilityMethod, FragilityWanted, Values};
use jostle_report::message;
use jostle_report::{Axis, Chart, Section, Series, Stroke, with_three_digits};

use super::{Results, words};
use crate::statistics::{
    Band, CloudFit, Curve, FitError, Logistic, ModifiedCloud, bootstrap_band, fit_cloud,
    fit_lognormal, fit_modified_cloud,
};
use crate::study::StudyError;

/// Points at which curves are drawn.
const POINTS: usize = 60;

/// Distinct records from which on a band says something about other records \[–\].
const ENOUGH_RECORDS: usize = 7;

/// One fitted curve.
struct Fitted {
    name: String,
    /// Distinct records among its cases.
    records: usize,
    /// Least and greatest intensity of its cases.
    reach: [f64; 2],
    curve: Result<Curve, FitError>,
    /// Method of a cloud fit.
    parts: Option<ModifiedCloud>,
    band: Option<Band>,
    cases: usize,
    events: usize,
    /// Cases whose demand is zero.
    zeros: usize,
    stripes: Vec<[f64; 2]>,
    grid: Vec<f64>,
}

impl Results<'_> {
    pub(super) fn fragilities(&mut self) -> Result<Vec<Section>, StudyError> {
        let wishes = self.study.file.fragilities.clone();
        let mut sections = Vec::new();
        for (number, wanted) in wishes.iter().enumerate() {
            let mut by = Vec::new();
            for name in &wanted.by {
                by.push(self.study.input_column(name)?);
            }
            let groups = self.grouped(&by);
            let fitted: Vec<Fitted> = groups
                .into_iter()
                .map(|(name, cases)| self.fit(wanted, name, &cases))
                .collect();
            let name = if number == 0 {
                "fragility".to_owned()
            } else {
                format!("fragility-{}", number + 1)
            };
            self.write(
                &name,
                message::fragility_parameters_file(),
                parameters(wanted, &fitted),
            )?;
            self.write(
                &format!("{name}-curves"),
                message::fragility_points_file(),
                points(wanted, &fitted),
            )?;
            let left_out = left_out(wanted, &fitted);
            self.said.extend(left_out.clone());
            self.said.push(in_words(wanted, &fitted));
            sections.push(section(wanted, &fitted, left_out.as_deref()));
        }
        Ok(sections)
    }

    fn fit(&self, wanted: &FragilityWanted, name: String, cases: &[usize]) -> Fitted {
        let intensity = self.table.column(&wanted.intensity);
        let demand = self.table.column(&wanted.demand);
        let motion = self.table.texts.get("motion");
        // Cases of one record belong together.
        let mut records: BTreeMap<&str, Vec<(f64, f64)>> = BTreeMap::new();
        let status = self.table.texts.get("status");
        for &case in cases {
            let collapsed = status.is_some_and(|status| status[case] == "collapsed");
            let (Some(x), true) = (intensity[case], self.completed(case)) else {
                continue;
            };
            // A building that collapses exceeds every demand.
            let d = if collapsed && wanted.method != FragilityMethod::Cloud {
                Some(f64::INFINITY)
            } else {
                demand[case]
            };
            if let Some(d) = d {
                let record = motion.map_or("", |motion| &motion[case][..]);
                records.entry(record).or_default().push((x, d));
            }
        }
        let all: Vec<(f64, f64)> = records.values().flatten().copied().collect();
        let threshold = wanted.threshold;
        let fit = |data: &[(f64, f64)]| -> Result<Curve, FitError> {
            match wanted.method {
                FragilityMethod::MultipleStripe => {
                    let outcomes: Vec<(f64, bool)> =
                        data.iter().map(|(x, d)| (*x, *d > threshold)).collect();
                    fit_lognormal(&outcomes).map(Curve::from)
                }
                FragilityMethod::Cloud => fit_cloud(data)?.fragility(threshold).map(Curve::from),
                FragilityMethod::ModifiedCloud => fit_modified_cloud(data)?
                    .fragility(threshold)
                    .map(Curve::from),
            }
        };
        let curve = fit(&all);
        let intensities = || all.iter().map(|(x, _)| *x);
        let most = intensities().fold(0.0, f64::max);
        let reach = [intensities().fold(f64::INFINITY, f64::min), most];
        let grid: Vec<f64> = (0..=POINTS)
            .map(|i| most * i as f64 / POINTS as f64)
            .collect();
        // With one record, or too few, single cases are drawn.
        let groups: Vec<Vec<(f64, f64)>> = if records.len() >= 5 {
            records.values().cloned().collect()
        } else {
            all.iter().map(|one| vec![*one]).collect()
        };
        let band = curve.is_ok().then(|| {
            bootstrap_band(
                &groups,
                wanted.bootstrap,
                wanted.confidence,
                self.study.file.design.seed,
                &grid,
                fit,
            )
        });
        Fitted {
            name,
            records: records.len(),
            reach,
            curve,
            band: band.flatten(),
            cases: all.len(),
            events: all.iter().filter(|(_, d)| *d > threshold).count(),
            zeros: all.iter().filter(|(_, d)| *d <= 0.0).count(),
            parts: cloud_parts(wanted.method, &all),
            stripes: stripes(&all, threshold),
            grid,
        }
    }
}

impl Fitted {
    /// Whether its median lies outside of the intensities that were computed.
    fn is_extrapolated(&self) -> bool {
        let median = self.curve.ok().map(|curve| curve.equivalent().median);
        median.is_some_and(|median| median < self.reach[0] || median > self.reach[1])
    }
}

/// Results of the cloud methods; the plain method has only the line.
fn cloud_parts(method: FragilityMethod, data: &[(f64, f64)]) -> Option<ModifiedCloud> {
    match method {
        FragilityMethod::MultipleStripe => None,
        FragilityMethod::Cloud => fit_cloud(data).ok().map(|cloud| ModifiedCloud {
            nonzero: None,
            collapse: None,
            cloud,
        }),
        FragilityMethod::ModifiedCloud => fit_modified_cloud(data).ok(),
    }
}

/// The event of curves in words.
fn event(wanted: &FragilityWanted) -> String {
    if wanted.demand == "impact_count" && wanted.threshold == 0.0 {
        return message::pounding_event().to_owned();
    }
    let (demand, size) = words::axis(&wanted.demand);
    let threshold = size * wanted.threshold;
    let text = format!("{} above {threshold} {}", demand.name, demand.unit);
    text.trim().to_owned()
}

/// Medians of all curves in a sentence, or why there are none.
fn in_words(wanted: &FragilityWanted, fitted: &[Fitted]) -> String {
    let (axis, size) = words::axis(&wanted.intensity);
    let each = fitted.iter().map(|one| {
        let found = match &one.curve {
            Ok(curve) => {
                let fit = curve.equivalent();
                let median = with_three_digits(size * fit.median, &axis.unit);
                format!("{median} (β {:.2})", fit.dispersion)
            }
            Err(error) => error.to_string(),
        };
        match one.name.is_empty() {
            true => found,
            false => format!("{}: {found}", one.name),
        }
    });
    let each = each.collect::<Vec<_>>().join("; ");
    let records = fitted.iter().map(|one| one.records).min().unwrap_or(0);
    let few = match records < ENOUGH_RECORDS {
        true => message::few_records_of_fragility(records),
        false => String::new(),
    };
    message::fragility_in_words(event(wanted), &axis.name, each, few)
}

/// Cases that the plain cloud omits, in a sentence; `None` if there are none.
fn left_out(wanted: &FragilityWanted, fitted: &[Fitted]) -> Option<String> {
    let zeros: usize = fitted.iter().map(|one| one.zeros).sum();
    let cases: usize = fitted.iter().map(|one| one.cases).sum();
    (wanted.method == FragilityMethod::Cloud && zeros > 0).then(|| {
        format!(
            "Fragility of {}: {zeros} of {cases} demands are zero or less and have no logarithm. The method cloud leaves them out, so that its curve holds for cases with demand only and is too high for all; method = \"modified-cloud\" keeps them.",
            wanted.demand
        )
    })
}

/// Shares of events at intensities that at least five cases have in common.
fn stripes(all: &[(f64, f64)], threshold: f64) -> Vec<[f64; 2]> {
    let mut sorted = all.to_vec();
    sort_by(&mut sorted, |a, b| a.0.total_cmp(&b.0));
    let mut shares = Vec::new();
    let mut rest = &sorted[..];
    while let Some((x, _)) = rest.first() {
        let count = rest
            .iter()
            .take_while(|(other, _)| (other - x).abs() <= 1e-9 * x.abs())
            .count();
        let events = rest[..count].iter().filter(|(_, d)| *d > threshold).count();
        if count >= 5 {
            shares.push([*x, events as f64 / count as f64]);
        }
        rest = &rest[count..];
    }
    shares
}

fn parameters(wanted: &FragilityWanted, fitted: &[Fitted]) -> Vec<(String, Values)> {
    let real =
        |of: &dyn Fn(&Fitted) -> Option<f64>| Values::Instant(fitted.iter().map(of).collect());
    let whole = |of: &dyn Fn(&Fitted) -> usize| {
        Values::Whole(
            fitted
                .iter()
                .map(|one| i32::try_from(of(one)).ok())
                .collect(),
        )
    };
    let limit = |which: usize, end: usize| {
        move |one: &Fitted| {
            let band = one.band.as_ref()?;
            Some([band.median, band.dispersion][which][end])
        }
    };
    let unit = &wanted.intensity;
    vec![
        (
            "curve".into(),
            Values::Text(fitted.iter().map(|one| one.name.clone()).collect()),
        ),
        (
            "demand".into(),
            Values::Text(fitted.iter().map(|_| wanted.demand.clone()).collect()),
        ),
        (
            "threshold".into(),
            Values::Real(fitted.iter().map(|_| wanted.threshold).collect()),
        ),
        ("cases".into(), whole(&|one| one.cases)),
        ("events".into(), whole(&|one| one.events)),
        (
            format!("median_{unit}"),
            real(&|one| one.curve.ok().map(|c| c.equivalent().median)),
        ),
        (format!("median_low_{unit}"), real(&limit(0, 0))),
        (format!("median_high_{unit}"), real(&limit(0, 1))),
        (
            "dispersion".into(),
            real(&|one| one.curve.ok().map(|c| c.equivalent().dispersion)),
        ),
        ("dispersion_low".into(), real(&limit(1, 0))),
        ("dispersion_high".into(), real(&limit(1, 1))),
        (
            "remark".into(),
            Values::Text(
                fitted
                    .iter()
                    .map(|one| match one.curve {
                        Err(error) => error.to_string(),
                        Ok(_) if wanted.method == FragilityMethod::Cloud && one.zeros > 0 => {
                            format!("{} demands of zero or less are left out", one.zeros)
                        }
                        Ok(_) if one.is_extrapolated() => {
                            message::median_outside_of_intensities().to_owned()
                        }
                        Ok(_) => String::new(),
                    })
                    .collect(),
            ),
        ),
        ("zero_demands".into(), whole(&|one| one.zeros)),
        (
            "cloud_ln_a".into(),
            real(&|one| Some(cloud(one)?.intercept)),
        ),
        ("cloud_b".into(), real(&|one| Some(cloud(one)?.slope))),
        ("cloud_beta".into(), real(&|one| Some(cloud(one)?.scatter))),
        (
            "nonzero_alpha0".into(),
            real(&|one| Some(nonzero(one)?.intercept)),
        ),
        (
            "nonzero_alpha1".into(),
            real(&|one| Some(nonzero(one)?.slope)),
        ),
        (
            "collapse_alpha0".into(),
            real(&|one| Some(collapse(one)?.intercept)),
        ),
        (
            "collapse_alpha1".into(),
            real(&|one| Some(collapse(one)?.slope)),
        ),
        ("records".into(), whole(&|one| one.records)),
    ]
}

fn cloud(one: &Fitted) -> Option<CloudFit> {
    one.parts.map(|parts| parts.cloud)
}

fn nonzero(one: &Fitted) -> Option<Logistic> {
    one.parts.and_then(|parts| parts.nonzero)
}

fn collapse(one: &Fitted) -> Option<Logistic> {
    one.parts.and_then(|parts| parts.collapse)
}

fn points(wanted: &FragilityWanted, fitted: &[Fitted]) -> Vec<(String, Values)> {
    let (mut names, mut xs, mut ps) = (Vec::new(), Vec::new(), Vec::new());
    let (mut lows, mut highs) = (Vec::new(), Vec::new());
    for one in fitted {
        let Ok(curve) = one.curve else { continue };
        for (index, x) in one.grid.iter().enumerate() {
            names.push(one.name.clone());
            xs.push(*x);
            ps.push(curve.probability(*x));
            lows.push(one.band.as_ref().map(|band| band.low[index]));
            highs.push(one.band.as_ref().map(|band| band.high[index]));
        }
    }
    vec![
        ("curve".into(), Values::Text(names)),
        (wanted.intensity.clone(), Values::Real(xs)),
        ("probability".into(), Values::Real(ps)),
        ("probability_low".into(), Values::Instant(lows)),
        ("probability_high".into(), Values::Instant(highs)),
    ]
}

fn section(wanted: &FragilityWanted, fitted: &[Fitted], left_out: Option<&str>) -> Section {
    let (x, size) = words::axis(&wanted.intensity);
    let event = event(wanted);
    let mut series = Vec::new();
    for (colour, one) in fitted.iter().enumerate() {
        let name = if one.name.is_empty() {
            event.clone()
        } else {
            one.name.clone()
        };
        let shares = one.stripes.iter();
        let mut dots = Series {
            name: String::new(),
            points: shares.map(|[at, share]| [size * at, *share]).collect(),
            band: Vec::new(),
            stroke: Stroke::Dots,
            colour,
        };
        let Ok(curve) = one.curve else {
            // What was observed is shown without a curve too.
            dots.name = format!("{name} (no curve)");
            series.push(dots);
            continue;
        };
        let points = one
            .grid
            .iter()
            .map(|at| [size * at, curve.probability(*at)]);
        let band = one.band.as_ref().map_or(Vec::new(), |band| {
            band.low
                .iter()
                .zip(&band.high)
                .map(|(low, high)| [*low, *high])
                .collect()
        });
        series.push(Series {
            name,
            points: points.collect(),
            band,
            stroke: Stroke::Line,
            colour,
        });
        series.push(dots);
    }
    let method = match wanted.method {
        FragilityMethod::MultipleStripe => message::curves_by_multiple_stripes(),
        FragilityMethod::Cloud => message::curves_by_cloud(),
        FragilityMethod::ModifiedCloud => message::curves_by_modified_cloud(),
    };
    let heads = [
        "",
        message::cases_head(),
        message::zero_demand_head(),
        message::events_head(),
        message::median_head(),
        message::limits_of_median_head(),
        "β",
        message::limits_of_beta_head(),
    ];
    let heads = heads.map(str::to_owned);
    let rows = fitted.iter().map(|one| {
        let mut row = vec![
            if one.name.is_empty() {
                event.clone()
            } else {
                one.name.clone()
            },
            one.cases.to_string(),
            one.zeros.to_string(),
            one.events.to_string(),
        ];
        match (&one.curve, &one.band) {
            (Ok(curve), band) => {
                let curve = curve.equivalent();
                let mark = match one.is_extrapolated() {
                    true => message::extrapolated(),
                    false => "",
                };
                let median = with_three_digits(size * curve.median, &x.unit);
                row.push(format!("{median}{mark}"));
                row.push(band.as_ref().map_or("–".into(), |band| {
                    let [low, high] = band.median.map(|end| with_three_digits(size * end, ""));
                    message::low_to_high(low, high)
                }));
                row.push(format!("{:.3}", curve.dispersion));
                row.push(band.as_ref().map_or("–".into(), |band| {
                    let [low, high] = band.dispersion.map(|end| format!("{end:.3}"));
                    message::low_to_high(low, high)
                }));
            }
            (Err(error), _) => row.push(error.to_string()),
        }
        row
    });
    let records = fitted.iter().map(|one| one.records).min().unwrap_or(0);
    let left_out = left_out.map_or(String::new(), |text| format!(" {text}"));
    let percent = format!("{:.0}", 100.0 * wanted.confidence);
    Section {
        title: message::fragility_of(&event),
        remark: if records < ENOUGH_RECORDS {
            message::bands_of_few_records(method, percent, wanted.bootstrap, records, left_out)
        } else {
            message::bands_hold(method, percent, wanted.bootstrap, left_out)
        },
        table: Some((heads.to_vec(), rows.collect())),
        charts: vec![Chart {
            title: message::probability_of(&event),
            x,
            y: Axis {
                name: message::probability_axis().into(),
                unit: String::new(),
            },
            series,
            reach: 1.0,
            ..Chart::default()
        }],
        ..Section::default()
    }
}
