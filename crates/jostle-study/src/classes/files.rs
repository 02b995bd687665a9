//! Files of classes: cases, curves as tables, as NRML, for Pelicun, and the page.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use jostle_io::{
    ClassesFile, ClassesMeasure, OutputError, Values, csv_field, encode_values_parquet,
    write_atomically,
};
use jostle_motion::STANDARD_GRAVITY;
use jostle_report::render_classes;
use jostle_run::FileKind;
use serde_json::{Value, json};

use super::curves::{Fragility, STATES};
use super::run::ClassesResults;
use crate::results::csv;
use crate::statistics::Lognormal;

const CASES: &str = "cases.parquet";
const CURVES: &str = "fragility.parquet";
const CURVES_CSV: &str = "fragility.csv";
const NRML: &str = "fragility.xml";
const PELICUN: &str = "pelicun.csv";
const CHECKED: &str = "checked.csv";
const PAGE: &str = "index.html";

/// Files that are written, and what an earlier one must look like to be replaced.
pub const FILES: [(&str, FileKind); 7] = [
    (CASES, FileKind::TABLE),
    (CURVES, FileKind::TABLE),
    (
        CURVES_CSV,
        FileKind {
            name: "fragility table of jostle",
            marks: &["pair,class,level,storeys,"],
        },
    ),
    (
        NRML,
        FileKind {
            name: "NRML file of jostle",
            marks: &["<nrml", "jostle"],
        },
    ),
    (
        PELICUN,
        FileKind {
            name: "Pelicun table of jostle",
            marks: &["ID,Incomplete,Demand-Type"],
        },
    ),
    (
        CHECKED,
        FileKind {
            name: "table of checked cases of jostle",
            marks: &["case,drift_batch,drift_full"],
        },
    ),
    (PAGE, FileKind::REPORT),
];

/// Writes all files into a folder that exists. All are made before the first is written. Returns curves that NRML and
/// Pelicun leave out, with the reason.
///
/// # Errors
/// [`OutputError`] with path and reason.
pub fn write_classes(
    folder: &Path,
    file: &ClassesFile,
    results: &ClassesResults,
) -> Result<Vec<String>, OutputError> {
    let parquet = |name: &str, columns| {
        let facts = [("unit_of_intensity", "m/s2".to_owned())];
        encode_values_parquet(&file.title, &facts, columns).map_err(|reason| {
            OutputError::Encoding {
                path: folder.join(name),
                reason,
            }
        })
    };
    let table = curve_columns(results);
    let (groups, left_out) = whole_groups(file, results);
    let made = [
        (CASES, parquet(CASES, case_columns(results))?),
        (CURVES_CSV, csv(&table).into_bytes()),
        (CURVES, parquet(CURVES, table)?),
        (NRML, nrml(file, results, &groups).into_bytes()),
        (PELICUN, pelicun(file, results, &groups).into_bytes()),
        (CHECKED, checked(results).into_bytes()),
        (
            PAGE,
            render_classes(&file.title, &page(file, results)).into_bytes(),
        ),
    ];
    for (name, bytes) in made {
        write_atomically(&folder.join(name), &bytes)?;
    }
    Ok(left_out)
}

/// Columns that name a pair, for a list of pairs.
fn pair_columns(results: &ClassesResults, pairs: &[usize]) -> Vec<(String, Values)> {
    let pair = |at: &usize| &results.pairs[*at];
    let text = |name: &str, of: &dyn Fn(&usize) -> String| {
        (
            name.to_owned(),
            Values::Text(pairs.iter().map(of).collect()),
        )
    };
    let whole = |name: &str, of: &dyn Fn(&usize) -> usize| {
        let all = pairs.iter().map(|at| Some(of(at) as i32));
        (name.to_owned(), Values::Whole(all.collect()))
    };
    vec![
        text("pair", &|at| pair(at).name()),
        text("class", &|at| pair(at).own.class.name.to_string()),
        text("level", &|at| pair(at).own.class.level.name().to_owned()),
        whole("storeys", &|at| pair(at).own.storeys),
        text("neighbour", &|at| pair(at).neighbour.class.name.to_string()),
        text("neighbour_level", &|at| {
            pair(at).neighbour.class.level.name().to_owned()
        }),
        whole("neighbour_storeys", &|at| pair(at).neighbour.storeys),
        text("alignment", &|at| alignment(pair(at).half_up).to_owned()),
        text("position", &|at| position(pair(at).middle).to_owned()),
    ]
}

const fn alignment(half_up: bool) -> &'static str {
    if half_up { "half-storey" } else { "floors" }
}

const fn position(middle: bool) -> &'static str {
    if middle { "middle" } else { "end" }
}

fn case_columns(results: &ClassesResults) -> Vec<(String, Values)> {
    let cases = &results.cases;
    let pairs: Vec<usize> = cases.iter().map(|case| case.pair).collect();
    let mut columns = pair_columns(results, &pairs);
    let motions = cases
        .iter()
        .map(|case| results.motions[case.motion].clone());
    columns.push(("motion".into(), Values::Text(motions.collect())));
    let mut real = |name: &str, of: &dyn Fn(&super::Case) -> f64| {
        columns.push((name.into(), Values::Real(cases.iter().map(of).collect())));
    };
    real("intensity_m_s2", &|case| case.intensity);
    real("scale", &|case| case.scale);
    real("gap_m", &|case| case.gap);
    real("closing_without_contact_m", &|case| case.closing);
    real("drift_without_contact", &|case| case.alone.drift);
    real("drift", &|case| case.with.drift);
    real("acceleration_without_contact_m_s2", &|case| {
        case.alone.acceleration
    });
    real("acceleration_m_s2", &|case| case.with.acceleration);
    real("peak_force_n", &|case| case.force);
    let mut whole = |name: &str, of: &dyn Fn(&super::Case) -> usize| {
        let all = cases.iter().map(|case| Some(of(case) as i32));
        columns.push((name.into(), Values::Whole(all.collect())));
    };
    whole("draw", &|case| case.draw);
    whole("impact_count", &|case| case.impacts as usize);
    whole("strikes_column", &|case| usize::from(case.column));
    columns
}

fn curve_columns(results: &ClassesResults) -> Vec<(String, Values)> {
    let curves = &results.curves;
    let pairs: Vec<usize> = curves.iter().map(|curve| curve.pair).collect();
    let mut columns = pair_columns(results, &pairs);
    let mut optional = |name: &str, of: &dyn Fn(&Fragility) -> Option<f64>| {
        columns.push((
            name.into(),
            Values::Instant(curves.iter().map(of).collect()),
        ));
    };
    optional("gap_m", &|curve| curve.gap);
    optional("drift_threshold", &|curve| Some(curve.threshold));
    let fit = |fragility: &Fragility| fragility.fit.as_ref().ok().copied();
    optional("median_m_s2", &|curve| Some(fit(curve)?.median));
    optional("median_g", &|curve| {
        Some(fit(curve)?.median / STANDARD_GRAVITY)
    });
    optional("dispersion", &|curve| Some(fit(curve)?.dispersion));
    for (at, end) in ["low", "high"].into_iter().enumerate() {
        optional(&format!("median_{end}_m_s2"), &|curve| {
            Some(curve.band.as_ref()?.median[at])
        });
        optional(&format!("dispersion_{end}"), &|curve| {
            Some(curve.band.as_ref()?.dispersion[at])
        });
    }
    let of_group = |fragility: &Fragility| {
        let group = results
            .curves
            .chunks(STATES.len())
            .position(|curves| (curves[0].pair, curves[0].gap) == (fragility.pair, fragility.gap));
        results.shared.get(group?)?.as_ref().ok()
    };
    optional("shared_median_m_s2", &|curve| {
        Some(of_group(curve)?.medians[curve.state])
    });
    optional("shared_dispersion", &|curve| {
        Some(of_group(curve)?.dispersion)
    });
    optional("greatest_misfit", &|curve| curve.misfit);
    let factors = (0..curves.len()).map(|at| results.pounding_factor(at));
    columns.push(("pounding_factor".into(), Values::Instant(factors.collect())));
    let mut whole = |name: &str, of: &dyn Fn(&Fragility) -> usize| {
        let all = curves.iter().map(|curve| Some(of(curve) as i32));
        columns.push((name.into(), Values::Whole(all.collect())));
    };
    whole("cases", &|curve| curve.cases);
    whole("cases_in_state", &|curve| curve.reached);
    let text = |of: &dyn Fn(&Fragility) -> String| Values::Text(curves.iter().map(of).collect());
    columns.push((
        "state".into(),
        text(&|curve| STATES[curve.state].to_owned()),
    ));
    columns.push((
        "contact".into(),
        text(&|curve| {
            if curve.gap.is_some() {
                "with"
            } else {
                "without"
            }
            .to_owned()
        }),
    ));
    columns.push((
        "note".into(),
        text(&|curve| {
            curve
                .fit
                .as_ref()
                .err()
                .map_or_else(String::new, ToString::to_string)
        }),
    ));
    columns
}

/// Curves of one pair and gap, state by state.
type Group<'a> = Vec<(&'a Fragility, Lognormal)>;

/// Groups that have curves of one dispersion, and why others have none.
fn whole_groups<'a>(
    file: &ClassesFile,
    results: &'a ClassesResults,
) -> (Vec<Group<'a>>, Vec<String>) {
    let (mut groups, mut left_out) = (Vec::new(), Vec::new());
    if file.measure == ClassesMeasure::AvgSa {
        left_out.push(format!(
            "{PELICUN} has no rows: Pelicun has no name for AvgSA"
        ));
    }
    let all = results.curves.chunks(STATES.len());
    for (curves, shared) in all.zip(&results.shared) {
        match shared {
            Err(reason) => left_out.push(format!("{}: {reason}", group_name(results, &curves[0]))),
            Ok(common_fit) => {
                let fit = |median| Lognormal {
                    median,
                    dispersion: common_fit.dispersion,
                };
                groups.push(curves.iter().zip(common_fit.medians.map(fit)).collect());
            }
        }
    }
    (groups, left_out)
}

/// Least and greatest intensity of all cases \[m/s²\].
fn range(file: &ClassesFile, results: &ClassesResults) -> [f64; 2] {
    if let [first, .., last] = file.levels[..] {
        return [first, last];
    }
    let all = results.cases.iter().map(|case| case.intensity);
    all.fold([f64::INFINITY, 0.0], |[low, high], intensity| {
        [low.min(intensity), high.max(intensity)]
    })
}

/// Name of a pair and gap, such as `C1L_low_2_URML_pre_2_end_floors_10mm`: OpenQuake takes letters, digits, `_`, `-` and
/// `:`, at most 75 of them, and Pelicun takes names apart at `-`.
fn group_name(results: &ClassesResults, fragility: &Fragility) -> String {
    let pair = &results.pairs[fragility.pair];
    let gap = fragility.gap.map_or_else(
        || "alone".to_owned(),
        |gap| format!("{}mm", shown(1e3 * gap).replace('.', "_")),
    );
    let name = format!(
        "{}_{}_{}_{}_{gap}",
        pair.own.name(),
        pair.neighbour.name(),
        position(pair.middle),
        alignment(pair.half_up)
    );
    name.replace('-', "_")
}

/// A number without noise of the last digits.
fn shown(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// What OpenQuake calls the measure.
fn openquake_measure(file: &ClassesFile, period: f64) -> String {
    match file.measure {
        ClassesMeasure::Pga => "PGA".to_owned(),
        ClassesMeasure::SaT1 => format!("SA({})", shown(period)),
        ClassesMeasure::AvgSa => "AvgSA".to_owned(),
    }
}

/// A fragility model of NRML 0.5. Its mean and standard deviation are those of the intensity, in g, not of its logarithm.
fn nrml(file: &ClassesFile, results: &ClassesResults, groups: &[Group<'_>]) -> String {
    let [low, high] = range(file, results).map(|intensity| intensity / STANDARD_GRAVITY);
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n\
         <fragilityModel id=\"jostle\" assetCategory=\"buildings\" lossCategory=\"structural\">\n\
         <description>{} (jostle {})</description>\n<limitStates>{}</limitStates>\n",
        escaped(&file.title),
        env!("CARGO_PKG_VERSION"),
        STATES.join(" ")
    );
    for group in groups {
        let first = group[0].0;
        let imt = openquake_measure(file, results.pairs[first.pair].own.period());
        let _ = writeln!(
            text,
            "<fragilityFunction id=\"{}\" format=\"continuous\" shape=\"logncdf\">\n\
             <imls imt=\"{imt}\" noDamageLimit=\"0\" minIML=\"{low}\" maxIML=\"{high}\"/>",
            group_name(results, first)
        );
        for (curve, fit) in group {
            let [mean, deviation] = moments(*fit);
            let _ = writeln!(
                text,
                "<params ls=\"{}\" mean=\"{mean}\" stddev=\"{deviation}\"/>",
                STATES[curve.state]
            );
        }
        text.push_str("</fragilityFunction>\n");
    }
    text.push_str("</fragilityModel>\n</nrml>\n");
    text
}

/// Mean θ exp(β²/2) and standard deviation mean √(exp β² − 1) of a lognormal variable in g.
fn moments(fit: Lognormal) -> [f64; 2] {
    let squared = fit.dispersion * fit.dispersion;
    let mean = fit.median / STANDARD_GRAVITY * libm::exp(0.5 * squared);
    [mean, mean * libm::expm1(squared).sqrt()]
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Fragilities in the columns of Pelicun 3, in g. They are directional: without a direction Pelicun takes 1.2 times the demand.
fn pelicun(file: &ClassesFile, results: &ClassesResults, groups: &[Group<'_>]) -> String {
    let mut text =
        "ID,Incomplete,Demand-Type,Demand-Unit,Demand-Offset,Demand-Directional".to_owned();
    for state in 1..=STATES.len() {
        let _ = write!(
            text,
            ",LS{state}-Family,LS{state}-Theta_0,LS{state}-Theta_1,LS{state}-DamageStateWeights"
        );
    }
    text.push('\n');
    if file.measure == ClassesMeasure::AvgSa {
        return text;
    }
    for group in groups {
        let first = group[0].0;
        let demand = match file.measure {
            ClassesMeasure::Pga => "Peak Ground Acceleration".to_owned(),
            ClassesMeasure::SaT1 | ClassesMeasure::AvgSa => format!(
                "Spectral Acceleration|{}",
                shown(results.pairs[first.pair].own.period())
            ),
        };
        let _ = write!(
            text,
            "{},0,{demand},g,0,1",
            csv_field(&group_name(results, first))
        );
        for (_, fit) in group {
            let _ = write!(
                text,
                ",lognormal,{},{},",
                fit.median / STANDARD_GRAVITY,
                fit.dispersion
            );
        }
        text.push('\n');
    }
    text
}

fn checked(results: &ClassesResults) -> String {
    let mut text =
        "case,drift_batch,drift_full,drift_deviation,force_batch_n,force_full_n,force_deviation\n"
            .to_owned();
    for check in &results.checked {
        let ([drift, force], [a, b], [c, d]) = (check.deviations(), check.drift, check.force);
        let _ = writeln!(text, "{},{a},{b},{drift},{c},{d},{force}", check.case);
    }
    text
}

/// What the page shows.
fn page(file: &ClassesFile, results: &ClassesResults) -> Value {
    let pairs: Vec<Value> = results
        .pairs
        .iter()
        .map(|pair| {
            let class = |of: &super::pair::Member| format!("{} {}", of.kind, of.class.level.name());
            json!({
                "class": class(&pair.own), "storeys": pair.own.storeys,
                "neighbour": class(&pair.neighbour), "beside": pair.neighbour.storeys,
                "alignment": alignment(pair.half_up), "position": position(pair.middle),
            })
        })
        .collect();
    let mut touching: BTreeMap<(usize, u64), [usize; 3]> = BTreeMap::new();
    for case in &results.cases {
        let touching = touching.entry((case.pair, case.gap.to_bits())).or_default();
        touching[0] += 1;
        touching[1] += usize::from(case.impacts > 0);
        touching[2] += usize::from(case.column);
    }
    let curves: Vec<Value> = results
        .curves
        .iter()
        .enumerate()
        .map(|(at, curve)| {
            let fit = curve.fit.as_ref().ok();
            let touched = curve.gap.and_then(|gap| touching.get(&(curve.pair, gap.to_bits())));
            json!({
                "pair": curve.pair, "gap": curve.gap, "state": curve.state,
                "median": fit.map(|fit| fit.median / STANDARD_GRAVITY),
                "dispersion": fit.map(|fit| fit.dispersion),
                "interval": curve.band.as_ref().map(|band| band.median.map(|curve| curve / STANDARD_GRAVITY)),
                "factor": results.pounding_factor(at),
                "counts": curve.counts.iter().map(|(level, cases, reached)| json!([level / STANDARD_GRAVITY, cases, reached])).collect::<Vec<_>>(),
                "cases": curve.cases, "reached": curve.reached,
                "touching": touched.map(|curve| curve[1] as f64 / curve[0] as f64),
                "columns": touched.map(|curve| curve[2] as f64 / curve[0] as f64),
                "note": curve.fit.as_ref().err().map(ToString::to_string),
            })
        })
        .collect();
    let [low, high] = range(file, results).map(|intensity| intensity / STANDARD_GRAVITY);
    let [drift, force] = results.worst_deviations();
    json!({
        "pairs": pairs, "curves": curves, "gaps": file.gaps, "states": STATES,
        "measure": file.measure.name(), "range": [low, high],
        "cases": results.cases.len(), "motions": results.motions.len(), "draws": file.draws,
        "checked": results.checked.len(), "drift_deviation": drift, "force_deviation": force,
        "capacities": results.sources[0], "damage": results.sources[1],
        "warnings": results.warnings,
    })
}
