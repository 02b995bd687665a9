//! The smallest gap without pounding, by bracketing on the response, compared with rules and codes.

use jostle::separation::{Code, CodeInputs, Requirement};
use jostle::{GroundMotion, Model, Pounding};
use rayon::prelude::*;
use serde::Serialize;

use crate::gap_runs::{GapError, GapPoint, GapRuns, Tried};

/// Settings of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct GapSettings {
    /// Width of the last bracket, > 0 \[m\].
    pub tolerance: f64,
    /// Inputs of codes.
    pub codes: CodeInputs,
    /// Whether every rule's gap is run too, to see what it would have led to.
    pub outcomes: bool,
    /// Whether the motion is taken with its other sign too.
    pub reversed: bool,
    /// Points of the curve of force over gap, from zero to the smallest gap without pounding; 0 for none, else at least 2.
    pub curve: usize,
}

impl Default for GapSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-4,
            codes: CodeInputs::default(),
            outcomes: true,
            reversed: true,
            curve: 0,
        }
    }
}

/// The smallest gap without pounding under one motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CriticalGap {
    /// Neighbours.
    pub between: [String; 2],
    /// Name of the motion.
    pub motion: String,
    /// Its peak \[m/s²\].
    pub pga_m_s2: f64,
    /// Smallest gap found without an impact \[m\].
    pub gap_m: f64,
    /// Smallest gap without an impact under the motion with the other sign; `null` if not asked for \[m\].
    pub reversed_gap_m: Option<f64>,
    /// Widest gap tried with an impact; `null` when not even a gap of zero is hit \[m\].
    pub pounding_at_m: Option<f64>,
    /// Greatest closing of the buildings passing through each other \[m\].
    pub closing_without_contact_m: f64,
    /// Height of the contact that closes most \[m\].
    pub height_m: f64,
    /// Runs made: the one without contact, and those with gaps whose outcome does not follow from it.
    pub runs: usize,
    /// First lateral periods of the neighbours \[s\].
    pub periods_s: [f64; 2],
    /// Damping ratios at these \[–\].
    pub damping: [f64; 2],
    /// Correlation of the double difference combination; `null` without damping \[–\].
    pub ddc_correlation: Option<f64>,
    /// Gaps required by rules, and the outcomes with them.
    pub rules: Vec<RuleGap>,
    /// Rules that cannot be applied, and what they need.
    pub left_out: Vec<LeftOutRule>,
    /// Force and impacts over the gap, from zero to `gap_m`; only if asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<GapPoint>,
}

/// A rule that cannot be applied.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOutRule {
    /// Short name.
    pub rule: String,
    /// Keys of the model file that it needs.
    pub needs: String,
}

/// The gap of a rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleGap {
    /// Short name.
    pub rule: String,
    /// Its source.
    pub source: String,
    /// Gap \[m\].
    pub gap_m: f64,
    /// Over the smallest gap without pounding; `null` when that is zero \[–\].
    pub ratio: Option<f64>,
    /// Impacts at this gap; `null` when outcomes were not asked for.
    pub impact_count: Option<usize>,
    /// Greatest force at this gap \[N\].
    pub peak_force_n: Option<f64>,
    /// First impact at this gap \[s\].
    pub first_impact_s: Option<f64>,
    /// Over the smallest gap without pounding of both signs of the motion; `null` when that is zero \[–\].
    pub ratio_of_both_signs: Option<f64>,
    /// Impacts at this gap with the motion reversed; `null` when that was not asked for.
    pub reversed_impact_count: Option<usize>,
    /// Greatest force at this gap with the motion reversed \[N\].
    pub reversed_peak_force_n: Option<f64>,
    /// Name of the code in the model file; `null` for general rules.
    pub code: Option<&'static str>,
    /// Inputs that the rule used, with defaults marked.
    pub inputs: Vec<String>,
    /// Distances of the left and the right building from the property line between them, of rules for such lines \[m\].
    pub setbacks_m: Option<[f64; 2]>,
}

/// What a gap leads to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GapOutcome {
    /// Impacts.
    pub impact_count: usize,
    /// Greatest force \[N\].
    pub peak_force_n: f64,
    /// Whether it is that of the motion reversed.
    pub is_reversed: bool,
}

impl RuleGap {
    /// The outcome with the greater force of both signs of the motion; `None` where outcomes were not asked for.
    #[must_use]
    pub fn worse_outcome(&self) -> Option<GapOutcome> {
        let own = GapOutcome {
            impact_count: self.impact_count?,
            peak_force_n: self.peak_force_n?,
            is_reversed: false,
        };
        let other = self.reversed_impact_count.zip(self.reversed_peak_force_n);
        let worse = other.filter(|(_, force)| *force > own.peak_force_n);
        Some(
            worse.map_or(own, |(impact_count, peak_force_n)| GapOutcome {
                impact_count,
                peak_force_n,
                is_reversed: true,
            }),
        )
    }
}

/// How far a search has come.
#[derive(Clone, Debug, PartialEq)]
pub struct GapProgress {
    /// Names of the neighbours whose gap is searched; `None` in the run without contact, which serves all gaps.
    pub between: Option<[String; 2]>,
    /// Number of the run, from 1.
    pub run: usize,
    /// Its gap \[m\]; `None` without contact.
    pub width: Option<f64>,
    /// Time reached in the run \[s\].
    pub time: f64,
    /// Time to reach \[s\].
    pub duration: f64,
}

/// A gap wider than the greatest closing without contact by this share of it is not hit: all that differs is rounding.
const BEYOND: f64 = 1e-6;
/// The same for small closings \[m\].
const LEAST_BEYOND: f64 = 1e-9;

/// A gap that no displacement closes \[m\].
const NEVER: f64 = 1e6;
/// Runs before a search gives up.
const MOST_RUNS: usize = 200;

/// Searches every gap of a model under one motion, each by itself while the others are out of reach.
///
/// Buildings that do not touch do not feel the gap, so the greatest closing of a run without contact is the answer
/// except for rounding: no wider gap is run, because there is no contact. A run with contact at a narrower one
/// makes sure that there is an impact, and bisection narrows the bracket to `settings.tolerance`. No width is run
/// twice. `report` is called often while a run is under way.
///
/// # Errors
/// [`GapError`].
pub fn critical_gaps(
    model: &Model,
    motion: &GroundMotion,
    settings: &GapSettings,
    stop: &(dyn Fn() -> bool + Sync),
    report: &dyn Fn(&GapProgress),
) -> Result<Vec<CriticalGap>, GapError> {
    if model.gaps.is_empty() {
        return Err(GapError::NoGap);
    }
    let runs = GapRuns::new(model, motion, stop)?;
    let search = Search {
        model,
        motion,
        runs,
        report,
    };
    let widths = vec![NEVER; model.gaps.len()];
    let first = GapProgress {
        between: None,
        run: 1,
        width: None,
        time: 0.0,
        duration: 0.0,
    };
    let apart = search.run(&widths, Pounding::Excluded, first.clone())?;
    let other = motion.reversed();
    let reversed = match settings.reversed {
        true => {
            let search = Search {
                motion: &other,
                runs: GapRuns::new(model, &other, stop)?,
                ..search
            };
            let apart = search.run(&widths, Pounding::Excluded, first)?;
            Some((search, apart))
        }
        false => None,
    };
    (0..model.gaps.len())
        .map(|gap| search.gap(gap, &apart, reversed.as_ref(), settings))
        .collect()
}

/// Closing of a contact of a gap that the nearest of its contacts would have, as far as it is set back from that by some part of the
/// gap: it needs that much less \[m\].
fn needed(tried: &Tried, contact: usize) -> f64 {
    let contacts = &tried.system.contacts;
    let own = contacts
        .iter()
        .filter(|own| own.gap == contacts[contact].gap);
    let least = own.map(|own| own.width).fold(f64::INFINITY, f64::min);
    tried.outcome.peaks.closing(contact).value - (contacts[contact].width - least)
}

/// The contact of a gap that comes nearest, and its closing, at least zero \[m\].
fn nearest_of(tried: &Tried, gap: usize) -> Option<(usize, f64)> {
    let contacts = 0..tried.system.contacts.len();
    let own = contacts.filter(|contact| tried.system.contacts[*contact].gap == gap);
    let closings = own.map(|contact| (contact, needed(tried, contact)));
    let nearest = closings.max_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map(|(contact, closing)| (contact, closing.max(0.0)))
}

struct Search<'a> {
    model: &'a Model,
    motion: &'a GroundMotion,
    runs: GapRuns<'a>,
    report: &'a dyn Fn(&GapProgress),
}

/// One gap, while all others are out of reach.
struct OneGap<'a> {
    search: &'a Search<'a>,
    gap: usize,
    between: [String; 2],
    /// Greatest closing without contact \[m\].
    closing: f64,
    /// Widths that were run, and what they led to.
    known: Vec<GapPoint>,
    /// Runs made with the other sign of the motion, for the numbers of runs.
    others: usize,
}

impl<'a> OneGap<'a> {
    fn new(search: &'a Search<'a>, gap: usize, between: &[String; 2], closing: f64) -> Self {
        Self {
            search,
            gap,
            between: between.clone(),
            closing,
            known: Vec::new(),
            others: 0,
        }
    }

    /// Runs made, the one without contact and those with the other sign included.
    fn runs(&self) -> usize {
        self.known.len() + 1 + self.others
    }

    /// Widths that are not hit, since the buildings never come so close.
    fn is_out_of_reach(&self, width: f64) -> bool {
        width >= self.closing * (1.0 + BEYOND) + LEAST_BEYOND
    }

    /// The widths of all gaps, all others out of reach.
    fn widths(&self, width: f64) -> Vec<f64> {
        let mut widths = vec![NEVER; self.search.model.gaps.len()];
        widths[self.gap] = width;
        widths
    }

    /// Outcome with a width, if no run is needed to know it.
    fn known_at(&self, width: f64) -> Option<GapPoint> {
        if self.is_out_of_reach(width) {
            return Some(GapPoint::without_impact(width));
        }
        let mut known = self.known.iter();
        known.find(|known| known.width_m == width).copied()
    }

    /// Outcome with a width; runs the model only if it is not known yet.
    fn at(&mut self, width: f64) -> Result<GapPoint, GapError> {
        if let Some(point) = self.known_at(width) {
            return Ok(point);
        }
        let progress = GapProgress {
            between: Some(self.between.clone()),
            run: self.runs() + 1,
            width: Some(width),
            time: 0.0,
            duration: 0.0,
        };
        let widths = self.widths(width);
        let tried = self.search.run(&widths, Pounding::Included, progress)?;
        let point = GapPoint::new(width, self.gap, &tried);
        self.known.push(point);
        Ok(point)
    }

    /// Force and impacts at equally spaced widths from zero to the smallest without an impact, on all cores.
    fn curve(&mut self, count: usize, free: f64) -> Result<Vec<GapPoint>, GapError> {
        let share = 1.0 / (count.max(2) - 1) as f64;
        let widths: Vec<f64> = (0..count).map(|i| share * i as f64 * free).collect();
        // Progress is told from here, so a few at a time.
        let at_once = 4 * rayon::current_num_threads();
        for (index, several) in widths.chunks(at_once).enumerate() {
            (self.search.report)(&GapProgress {
                between: Some(self.between.clone()),
                run: self.runs() + 1,
                width: several.first().copied(),
                time: (index * at_once) as f64,
                duration: count as f64,
            });
            let unknown = several
                .iter()
                .filter(|width| self.known_at(**width).is_none());
            let unknown: Vec<_> = unknown.map(|width| (*width, self.widths(*width))).collect();
            let (gap, runs) = (self.gap, &self.search.runs);
            let found: Vec<Result<GapPoint, GapError>> = unknown
                .into_par_iter()
                .map(|(width, widths)| {
                    let tried = runs.run(&widths, Pounding::Included, &mut |_| {})?;
                    Ok(GapPoint::new(width, gap, &tried))
                })
                .collect();
            for point in found {
                self.known.push(point?);
            }
        }
        let points = widths.iter().filter_map(|width| self.known_at(*width));
        Ok(points.collect())
    }

    /// Narrows down the smallest gap without an impact, beginning with the closing of a run without contact.
    fn bracket(&mut self, tolerance: f64) -> Result<Bracket, GapError> {
        let closing = self.closing;
        let mut is_hit = |width: f64| {
            if self.runs() > MOST_RUNS {
                return Err(GapError::Run("the search did not come to an end".into()));
            }
            Ok(self.at(width)?.impact_count > 0)
        };
        let mut reach = 0.5 * tolerance;
        let mut free = closing + reach;
        while is_hit(free)? {
            reach *= 2.0;
            free = closing + reach;
        }
        let mut reach = 0.5 * tolerance;
        let mut hit = closing - reach;
        loop {
            if hit <= 0.0 {
                // The last try: touching at rest.
                if is_hit(0.0)? {
                    hit = 0.0;
                    break;
                }
                return Ok(Bracket {
                    free: 0.0,
                    pounding: None,
                });
            }
            if is_hit(hit)? {
                break;
            }
            free = hit;
            reach *= 2.0;
            hit = closing - reach;
        }
        while free - hit > tolerance * (1.0 + 1e-9) {
            let middle = 0.5 * (free + hit);
            if is_hit(middle)? {
                hit = middle;
            } else {
                free = middle;
            }
        }
        Ok(Bracket {
            free,
            pounding: Some(hit),
        })
    }
}

impl Search<'_> {
    fn run(
        &self,
        widths: &[f64],
        pounding: Pounding,
        mut progress: GapProgress,
    ) -> Result<Tried, GapError> {
        self.runs.run(widths, pounding, &mut |reached| {
            (progress.time, progress.duration) = (reached.time, reached.duration);
            (self.report)(&progress);
        })
    }

    fn gap(
        &self,
        gap: usize,
        apart: &Tried,
        reversed: Option<&(Search<'_>, Tried)>,
        settings: &GapSettings,
    ) -> Result<CriticalGap, GapError> {
        let between = apart.summary.gaps[gap].between.clone();
        let Some((nearest, closing)) = nearest_of(apart, gap) else {
            return Err(GapError::NoContact(between.join(" and ")));
        };
        let mut one = OneGap::new(self, gap, &between, closing);
        let mut other = reversed.and_then(|(search, apart)| {
            let closing = nearest_of(apart, gap)?.1;
            Some(OneGap::new(search, gap, &between, closing))
        });
        let bracket = one.bracket(settings.tolerance)?;
        // A wall has no period, and so no double difference.
        let modes = apart.summary.first_modes(self.model, gap);
        let required = apart
            .summary
            .required_gaps(self.model, gap, &settings.codes);
        let mut rules: Vec<RuleGap> = required.rules.into_iter().map(rule_gap).collect();
        let free_of_both = other
            .as_ref()
            .map_or(0.0, |other| other.closing)
            .max(bracket.free);
        for rule in &mut rules {
            rule.ratio = (bracket.free > 0.0).then(|| rule.gap_m / bracket.free);
            rule.ratio_of_both_signs = (free_of_both > 0.0).then(|| rule.gap_m / free_of_both);
            if let Some(other) = other.as_mut().filter(|_| settings.outcomes) {
                other.others = one.known.len();
                let led = other.at(rule.gap_m)?;
                one.others = other.known.len();
                rule.reversed_impact_count = Some(led.impact_count);
                rule.reversed_peak_force_n = Some(led.peak_force_n);
            }
            if settings.outcomes {
                let led = one.at(rule.gap_m)?;
                rule.impact_count = Some(led.impact_count);
                rule.peak_force_n = Some(led.peak_force_n);
                rule.first_impact_s = led.first_impact_s;
            }
        }
        let curve = match settings.curve {
            0 => Vec::new(),
            count => one.curve(count, bracket.free)?,
        };
        Ok(CriticalGap {
            between,
            motion: self.motion.name.clone(),
            pga_m_s2: self.motion.peak(),
            gap_m: bracket.free,
            reversed_gap_m: other.as_ref().map(|other| other.closing),
            pounding_at_m: bracket.pounding,
            closing_without_contact_m: closing,
            height_m: apart.system.contacts[nearest].height,
            runs: one.runs(),
            periods_s: modes.map(|mode| mode.map_or(0.0, |(period, _)| period)),
            damping: modes.map(|mode| mode.map_or(0.0, |(_, damping)| damping)),
            ddc_correlation: apart.summary.correlation(self.model, gap),
            rules,
            left_out: required
                .left_out
                .into_iter()
                .map(|rule| LeftOutRule {
                    rule: rule.name,
                    needs: rule.needs,
                })
                .collect(),
            curve,
        })
    }
}

/// A requirement whose outcome is not known yet.
fn rule_gap(required: Requirement) -> RuleGap {
    RuleGap {
        rule: required.name,
        source: required.source,
        gap_m: required.width,
        ratio: None,
        impact_count: None,
        peak_force_n: None,
        first_impact_s: None,
        ratio_of_both_signs: None,
        reversed_impact_count: None,
        reversed_peak_force_n: None,
        code: required.code.map(Code::name),
        inputs: required.inputs,
        setbacks_m: required.setbacks,
    }
}

struct Bracket {
    free: f64,
    pounding: Option<f64>,
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use jostle::Structure;
    use jostle_io::builtin_model;

    use super::*;

    /// EN 1998-1 reduces the SRSS only where floors lie at equal height.
    #[test]
    fn unequal_floors_get_no_reduced_rule() {
        let mut input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
        if let Some(motion) = &mut input.motion {
            motion.duration = Some(1.0);
        }
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let settings = GapSettings {
            outcomes: false,
            ..GapSettings::default()
        };
        let rules = |model: &Model| -> Vec<String> {
            let found = critical_gaps(model, &motion, &settings, &|| false, &|_| {});
            let found = found.unwrap_or_else(|error| panic!("{error}"));
            found[0].rules.iter().map(|r| r.rule.clone()).collect()
        };
        let has = |rules: &[String], name: &str| rules.iter().any(|rule| rule == name);
        let aligned = rules(&input.model);
        assert!(
            has(&aligned, "SRSS") && has(&aligned, "0.7 SRSS"),
            "{aligned:?}"
        );
        let Structure::Frame(frame) = &mut input.model.buildings[1].structure else {
            panic!("the example has frames");
        };
        frame.storey_heights[1] += 0.4;
        let shifted = rules(&input.model);
        assert!(
            has(&shifted, "SRSS") && !has(&shifted, "0.7 SRSS"),
            "{shifted:?}"
        );
    }

    /// A mat and a wall that give way both move: the gap is found at height 0.
    #[test]
    fn a_moat_has_a_smallest_gap() {
        let text = include_str!("../../../examples/isolated_hospital.toml");
        let input = jostle_io::read_model_text(
            "hospital",
            text,
            jostle_io::Format::Toml,
            std::path::Path::new(""),
        );
        let input = input.unwrap_or_else(|error| panic!("{error}"));
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let settings = GapSettings {
            outcomes: false,
            ..GapSettings::default()
        };
        let run = |model: &Model| {
            let found = critical_gaps(model, &motion, &settings, &|| false, &|_| {});
            found.unwrap_or_else(|error| panic!("{error}")).remove(0)
        };
        let found = run(&input.model);
        assert_eq!(found.height_m, 0.0);
        assert!(found.rules.iter().all(|rule| rule.gap_m.is_finite()));
        // Less than both peaks together, and what the run without contact closes.
        let sum = found.rules.iter().find(|rule| rule.rule == "ABS");
        assert!(
            sum.is_some_and(|sum| sum.gap_m > found.gap_m),
            "{:?}",
            found.gap_m
        );
        assert!((found.gap_m / found.closing_without_contact_m - 1.0).abs() < 2e-3);
    }

    /// Gaps that cannot close are not run, none is run twice, and every run is reported.
    #[test]
    fn what_is_known_is_not_run() {
        let mut input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
        if let Some(motion) = &mut input.motion {
            motion.duration = Some(6.0);
        }
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let runs: RefCell<Vec<(usize, Option<f64>)>> = RefCell::default();
        let report = |progress: &GapProgress| {
            let mut runs = runs.borrow_mut();
            if runs.last().is_none_or(|last| last.0 != progress.run) {
                runs.push((progress.run, progress.width));
            }
            assert!(progress.time <= progress.duration * (1.0 + 1e-9));
        };
        let settings = GapSettings {
            reversed: false,
            ..GapSettings::default()
        };
        let found = critical_gaps(&input.model, &motion, &settings, &|| false, &report);
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        let gap = &found[0];
        let runs = runs.into_inner();
        assert_eq!(runs.len(), gap.runs, "{runs:?}");
        let widths: Vec<f64> = runs.iter().filter_map(|run| run.1).collect();
        assert_eq!(widths.len() + 1, runs.len(), "one run without contact");
        for (index, width) in widths.iter().enumerate() {
            assert!(
                *width < gap.closing_without_contact_m * 1.000_002,
                "{width} cannot close"
            );
            assert!(!widths[..index].contains(width), "{width} is run twice");
        }
        let wide = gap.rules.iter().filter(|rule| rule.gap_m > gap.gap_m);
        assert!(wide.clone().count() > 0);
        for rule in wide {
            assert_eq!(
                (rule.impact_count, rule.peak_force_n),
                (Some(0), Some(0.0)),
                "{rule:?}"
            );
        }
        // Checks the assumptions: runs just above the greatest closing and at the result have no impact.
        let search = Search {
            model: &input.model,
            motion: &motion,
            runs: GapRuns::new(&input.model, &motion, &|| false)
                .unwrap_or_else(|error| panic!("{error}")),
            report: &|_| {},
        };
        for width in [
            gap.closing_without_contact_m * (1.0 + 2.0 * BEYOND),
            gap.gap_m,
        ] {
            let progress = GapProgress {
                between: None,
                run: 1,
                width: Some(width),
                time: 0.0,
                duration: 0.0,
            };
            let tried = search.run(&[width], Pounding::Included, progress);
            let tried = tried.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(tried.summary.gaps[0].impact_count, 0, "at {width}");
        }
    }

    /// Every point of the curve is the run of a model with that width, assembled by itself.
    #[test]
    fn points_of_the_curve_are_runs() {
        let mut input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
        if let Some(motion) = &mut input.motion {
            motion.duration = Some(6.0);
        }
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let settings = GapSettings {
            outcomes: false,
            curve: 9,
            ..GapSettings::default()
        };
        let found = critical_gaps(&input.model, &motion, &settings, &|| false, &|_| {});
        let gap = &found.unwrap_or_else(|error| panic!("{error}"))[0];
        assert_eq!(gap.curve.len(), 9);
        assert_eq!(
            (gap.curve[0].width_m, gap.curve[8].width_m),
            (0.0, gap.gap_m)
        );
        assert!(gap.curve[0].impact_count > 0 && gap.curve[8].impact_count == 0);
        for point in &gap.curve {
            let mut model = input.model.clone();
            model.gaps[0].set_width(point.width_m);
            let system = jostle::System::assemble(&model).expect("sound");
            let plan = jostle::Plan::choose(&system, &motion, &model.analysis).expect("sound");
            let settings = jostle::Settings {
                record_interval: None,
                ..jostle::Settings::default()
            };
            let outcome = jostle::simulate(&system, &motion, &plan, settings, |_| {
                std::ops::ControlFlow::Continue(())
            });
            let force = outcome
                .impacts
                .iter()
                .map(|i| i.peak_force)
                .fold(0.0, f64::max);
            assert!(point.peak_force_n >= force, "{point:?}");
            let first = outcome.impacts.iter().map(|impact| impact.start);
            assert_eq!(
                point.first_impact_s,
                first.min_by(f64::total_cmp),
                "{point:?}"
            );
            assert_eq!(point.impact_count, outcome.impacts.len(), "{point:?}");
        }
    }
}
