//! Checks of sets of ground motions by a code: a separate page, and sections for the page of a study.

use jostle_io::in_shown_units;
use jostle_motion::{
    Candidate, MainPeriod, MotionFault, Origin, Reading, RuleKind, SelectionCheck, SelectionRule,
    TargetSpectrum, response_spectrum, spaced_periods,
};
use maud::{Markup, html};
use serde_json::json;

use crate::encode::Packed;
use crate::format;
use crate::message;
use crate::motion_page::{digits, frame, spectrum_controls};
use crate::study_page::{Axis, Chart, Section, Series, Stroke};

/// What the page of a set of motions shows.
#[derive(Clone, Copy, Debug)]
pub struct SelectionPage<'a> {
    /// Spectrum of the code.
    pub target: &'a TargetSpectrum,
    /// Damping ratio \[–\].
    pub damping: f64,
    /// Main periods of the structure.
    pub periods: &'a [MainPeriod],
    /// The motions.
    pub set: &'a [Candidate],
    /// Result.
    pub check: &'a SelectionCheck,
}

/// A structure for which a set of motions was checked.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedStructure {
    /// Name of the building; empty where periods were given without one.
    pub name: String,
    /// Its main periods.
    pub periods: Vec<MainPeriod>,
    /// Result.
    pub check: SelectionCheck,
}

/// Points of the spectra.
const POINTS: usize = 200;
/// Longest period of the spectra of a page \[s\].
const LONGEST: f64 = 6.0;
/// Least span of the spectra in a study \[s\].
const SHORTEST_SPAN: f64 = 2.0;

/// Pseudo-accelerations of a set, their mean and the code.
struct Spectra {
    periods: Vec<f64>,
    each: Vec<Vec<f64>>,
    mean: Vec<f64>,
    code: Vec<f64>,
}

impl Spectra {
    fn new(
        target: &TargetSpectrum,
        damping: f64,
        set: &[Candidate],
        longest: f64,
    ) -> Result<Self, MotionFault> {
        let [first, last] = target.range();
        let periods = spaced_periods(first.max(0.02), last.min(longest), POINTS);
        let mut each = Vec::new();
        let mut mean = vec![0.0; periods.len()];
        for candidate in set {
            let motion = &candidate.motion;
            let spectrum = response_spectrum(motion, &periods, &[damping], Reading::Between)?;
            let values = spectrum.curves[0].pseudo_acceleration.clone();
            for (sum, value) in mean.iter_mut().zip(&values) {
                *sum += value / set.len() as f64;
            }
            each.push(values);
        }
        let code = periods
            .iter()
            .map(|&t| target.acceleration(t, damping))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            periods,
            each,
            mean,
            code,
        })
    }
}

/// The page of a set of motions: one HTML file that opens offline.
///
/// # Errors
/// If the code does not define the damping.
pub fn render_selection(page: &SelectionPage) -> Result<String, MotionFault> {
    let found = Spectra::new(page.target, page.damping, page.set, LONGEST)?;
    let periods = digits(&found.periods);
    let mut spectra = Vec::new();
    for (candidate, values) in page.set.iter().zip(&found.each) {
        let (label, y) = (&candidate.name, digits(values));
        spectra.push(json!({ "label": label, "periods": periods, "psa": y, "thin": true }));
    }
    spectra.push(
        json!({ "label": "mean", "periods": periods, "psa": digits(&found.mean), "bold": true }),
    );
    for (label, factor) in std::iter::once(&(message::code(), 1.0)).chain(page.check.code.bounds())
    {
        let values: Vec<f64> = found.code.iter().map(|a| factor * a).collect();
        let dashed = *factor != 1.0;
        spectra.push(json!({ "label": label, "periods": periods, "psa": digits(&values), "dashed": dashed, "code": true }));
    }
    let marks: Vec<f64> = page.periods.iter().map(|main| main.period).collect();
    let empty = || Packed::instants(&[]);
    let data = json!({
        "duration": 1.0, "run": null, "without": null, "forces": [], "gaps": [], "buildings": [],
        "ground": { "time": empty(), "values": empty() },
        "spectra": spectra, "marks": marks,
    });
    let clause = page.check.code.clause();
    let verdict = if page.check.passes() {
        message::the_set_meets_the_checked(clause)
    } else {
        message::the_set_does_not_meet(clause)
    };
    let body = html! {
        p.verdict { (verdict) }
        section #rules { h2 { (message::what_the_clause_asks()) } (rules_table(page.check)) }
        section #response {
            h2 { (message::response_spectra_with_damping(format::plain(100.0 * page.damping, 3))) }
            (spectrum_controls(false))
            div #spectra {}
        }
        section #numbers { h2 { (message::at_the_main_periods()) } (selection_table(page)) }
    };
    Ok(frame(
        &page.target.name(),
        message::selection_of_ground_motions(),
        &body,
        &data,
    ))
}

/// The sections of a study about its motions: the verdict with the spectra, and the numbers for every structure.
/// `scaling` says how the motions were scaled.
///
/// # Errors
/// If the code does not define the damping.
pub fn selection_sections(
    target: &TargetSpectrum,
    damping: f64,
    set: &[Candidate],
    structures: &[CheckedStructure],
    scaling: &str,
) -> Result<Vec<Section>, MotionFault> {
    let periods = structures.iter().flat_map(|structure| &structure.periods);
    let longest = periods.fold(0.0, |most: f64, main| most.max(main.period));
    let reach = (1.6 * longest).clamp(SHORTEST_SPAN, LONGEST);
    let spectra = Spectra::new(target, damping, set, reach)?;
    let mut sections = vec![Section {
        title: message::selection_of_ground_motions().into(),
        remark: message::name_damping_damping_scaling_structures(
            target.name(),
            format::plain(100.0 * damping, 3),
            scaling,
            remarks(structures),
        ),
        charts: vec![chart(&spectra, set, structures)],
        table: Some(verdicts(structures)),
        ..Section::default()
    }];
    sections.extend(structures.iter().map(|structure| Section {
        title: match &structure.name[..] {
            "" => message::main_periods().to_owned(),
            name => message::main_periods_title(name),
        },
        remark: message::response_over().into(),
        table: Some(numbers(set, structure)),
        ..Section::default()
    }));
    Ok(sections)
}

/// Notes on the verdicts.
fn remarks(structures: &[CheckedStructure]) -> String {
    let checks = structures.iter().map(|structure| &structure.check);
    let estimated = checks.clone().any(|c| c.met(RuleKind::BaseShear).is_some());
    let mut all: Vec<&str> = Vec::new();
    if estimated {
        all.push(message::base_shears_are_estimated());
    }
    for note in checks.flat_map(|check| &check.notes) {
        if !all.contains(note) {
            all.push(note);
        }
    }
    all.join(" ")
}

fn chart(spectra: &Spectra, set: &[Candidate], structures: &[CheckedStructure]) -> Chart {
    let series = |name: &str, values: &[f64], factor: f64, stroke: Stroke, colour: usize| {
        let points = spectra.periods.iter().zip(values);
        Series {
            name: name.to_owned(),
            points: points.map(|(t, a)| [*t, factor * a]).collect(),
            band: Vec::new(),
            stroke,
            colour,
        }
    };
    let colour = set.len();
    let (mean, code) = (&spectra.mean, &spectra.code);
    let mut all: Vec<Series> = set
        .iter()
        .zip(&spectra.each)
        .enumerate()
        .map(|(i, (candidate, values))| series(&candidate.name, values, 1.0, Stroke::Thin, i))
        .collect();
    all.push(series(message::mean(), mean, 1.0, Stroke::Heavy, colour));
    all.push(series(message::code(), code, 1.0, Stroke::Line, colour + 1));
    let bounds = structures
        .first()
        .map(|structure| structure.check.code.bounds());
    for (name, factor) in bounds.unwrap_or_default() {
        all.push(series(name, code, *factor, Stroke::Dashed, colour + 1));
    }
    all.extend(structures.iter().enumerate().map(|(i, structure)| {
        let means = structure.periods.iter().zip(&structure.check.mean);
        Series {
            name: match &structure.name[..] {
                "" => message::at_main_periods().to_owned(),
                name => message::at_periods(name),
            },
            points: means.map(|(main, mean)| [main.period, mean[1]]).collect(),
            band: Vec::new(),
            stroke: Stroke::Dots,
            colour: colour + 2 + i,
        }
    }));
    let axis = |name: &str, unit: &str| Axis {
        name: name.to_owned(),
        unit: unit.to_owned(),
    };
    Chart {
        title: message::response_spectra().into(),
        x: axis(message::period(), "s"),
        y: axis("pseudo-acceleration", format::ACCELERATION.name()),
        series: all,
        ..Chart::default()
    }
}

/// Rules and whether they are met, a column for each structure.
fn verdicts(structures: &[CheckedStructure]) -> (Vec<String>, Vec<Vec<String>>) {
    let clause = structures
        .first()
        .map(|structure| structure.check.code.clause());
    let mut heads = vec![clause.unwrap_or_default().to_owned()];
    heads.extend(
        structures
            .iter()
            .map(|structure| match &structure.name[..] {
                "" => message::verdict().to_owned(),
                name => name.to_owned(),
            }),
    );
    heads.push(message::asks_for().into());
    let each: Vec<&[SelectionRule]> = structures
        .iter()
        .map(|structure| &structure.check.rules[..])
        .collect();
    let rows = each.first().map_or(Vec::new(), |first| {
        let row = |(i, rule): (usize, &SelectionRule)| {
            // What is found may differ between structures.
            let mut found: Vec<&str> = each.iter().map(|rules| &rules[i].found[..]).collect();
            found.dedup();
            let mut row = vec![found.join("; ")];
            row.extend(each.iter().map(|rules| verdict(rules[i].met).to_owned()));
            row.push(asked(rule));
            row
        };
        first.iter().enumerate().map(row).collect()
    });
    (heads, rows)
}

fn numbers(set: &[Candidate], structure: &CheckedStructure) -> (Vec<String>, Vec<Vec<String>>) {
    let (periods, check) = (&structure.periods, &structure.check);
    let mut heads = vec![
        message::motion().to_owned(),
        message::origin().into(),
        "PGA".into(),
    ];
    heads.extend(
        periods
            .iter()
            .map(|main| format!("T = {} s", format::plain(main.period, 4))),
    );
    heads.extend([
        message::base_shear().into(),
        message::effective_duration().into(),
    ]);
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (i, candidate) in set.iter().enumerate() {
        let mut row = vec![
            candidate.name.clone(),
            origin(candidate).into(),
            peak(candidate),
        ];
        row.extend(check.ratios[i].iter().map(|value| ratio(*value)));
        row.extend([
            ratio(check.base_shear[i]),
            duration(check.effective_duration[i]),
        ]);
        rows.push(row);
    }
    let mut mean = vec![message::mean().to_owned(), String::new(), String::new()];
    mean.extend(check.mean.iter().map(|mean| ratio(1.0 + mean[2])));
    mean.extend([ratio(mean_shear(check)), String::new()]);
    rows.push(mean);
    (heads, rows)
}

fn asked(rule: &SelectionRule) -> String {
    format!("{} ({})", rule.asked, rule.clause)
}

fn verdict(met: bool) -> &'static str {
    if met {
        message::met()
    } else {
        message::not_met()
    }
}

fn origin(candidate: &Candidate) -> &'static str {
    match candidate.origin {
        Origin::Natural => message::recorded(),
        Origin::Artificial => message::artificial(),
    }
}

fn peak(candidate: &Candidate) -> String {
    format::short(format::ACCELERATION, candidate.motion.peak(), 4)
}

fn duration(seconds: f64) -> String {
    format::unit(format::fixed(seconds, 1), "s")
}

fn ratio(value: f64) -> String {
    format::fixed(value, 3)
}

fn mean_shear(check: &SelectionCheck) -> f64 {
    check.base_shear.iter().sum::<f64>() / check.base_shear.len() as f64
}

fn rules_table(check: &SelectionCheck) -> Markup {
    html! {
        div.scroll { table { tbody {
            @for rule in &check.rules {
                tr {
                    td style="vertical-align: top" { b { (verdict(rule.met)) } }
                    td style="white-space: normal" { (rule.found) ": " (asked(rule)) }
                }
            }
        } } }
        @for note in &check.notes { p.quiet { (in_shown_units(note)) } }
    }
}

fn selection_table(page: &SelectionPage) -> Markup {
    let (set, check) = (page.set, page.check);
    html! {
        div.scroll { table {
            thead { tr {
                th { (message::motion()) } th { (message::origin()) } th.number { "PGA" }
                @for main in page.periods { th.number { "T = " (format::plain(main.period, 4)) " s" } }
                th.number { (message::base_shear()) } th.number { (message::effective_duration()) }
            } }
            tbody {
                @for (i, candidate) in set.iter().enumerate() {
                    tr {
                        td { (candidate.name) }
                        td { (origin(candidate)) }
                        td.number { (peak(candidate)) }
                        @for value in &check.ratios[i] { td.number { (ratio(*value)) } }
                        td.number { (ratio(check.base_shear[i])) }
                        td.number { (duration(check.effective_duration[i])) }
                    }
                }
                tr {
                    td { b { (message::mean()) } } td {} td {}
                    @for [_, _, difference] in &check.mean { td.number { b { (ratio(1.0 + difference)) } } }
                    td.number { b { (ratio(mean_shear(check))) } }
                    td {}
                }
            }
        } }
        p.quiet { (message::response_over()) }
    }
}
