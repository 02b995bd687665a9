//! The smallest gap without pounding, by bracketing on the response, compared with rules and codes.

use std::sync::{Mutex, PoisonError};

use jostle::separation::{Code, CodeInputs, MotionLevel, Requirement};
use jostle::{Gap, GroundMotion, Model, Pounding};
use rayon::prelude::*;
use serde::Serialize;

use crate::gap_runs::{GapError, GapPoint, GapRuns, Tried};
use crate::isolation_bounds::{at_bound, has_bounds};

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
    /// Points of the curve of force over gap, from zero (with static coupling of foundations, from the first point beyond) to the
    /// smallest gap without pounding; 0 for none, else at least 2.
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
    /// Name of the motion across, if there is one.
    #[serde(skip)]
    pub across: Option<String>,
    /// Its peak \[m/s²\].
    pub pga_m_s2: f64,
    /// Width of the gap in the model, the least of several \[m\].
    #[serde(skip)]
    pub model_gap_m: f64,
    /// Whether it is the design motion reduced by q or R: widths of codes, which are for the full one, then have no ratio and no
    /// outcome.
    pub motion_is_reduced: bool,
    /// Smallest gap found without an impact \[m\].
    pub gap_m: f64,
    /// Smallest gap without an impact under the motion with the other sign; `null` if not asked for \[m\].
    pub reversed_gap_m: Option<f64>,
    /// The same at the lower and at the upper bounds of the bearings, of both signs the greater, where the model states bounds \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap_at_bounds_m: Option<[f64; 2]>,
    /// Widest gap tried with an impact; `null` when not even a gap of zero is hit \[m\].
    pub pounding_at_m: Option<f64>,
    /// Greatest closing of the buildings passing through each other \[m\].
    pub closing_without_contact_m: f64,
    /// Height of the contact that closes most \[m\].
    pub height_m: f64,
    /// Runs made: one without contact for each sign of the motion, and those with gaps whose outcome does not follow from it.
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
    /// Force and impacts over the gap, from zero to the smallest gap without pounding of both signs; only if asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<GapPoint>,
    /// The same under the motion reversed; only if that is asked for too.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reversed_curve: Vec<GapPoint>,
}

impl CriticalGap {
    /// Smallest gap without an impact over the signs of the motion that were asked for and the bounds of the bearings \[m\].
    #[must_use]
    pub fn needed_m(&self) -> f64 {
        let others = self.gap_at_bounds_m.into_iter().flatten();
        others.chain(self.reversed_gap_m).fold(self.gap_m, f64::max)
    }
}

/// The gaps needed between the same neighbours under several motions, of both signs of each the greater.
#[derive(Clone, Debug, PartialEq)]
pub struct GapSet<'a> {
    /// Those of the motions.
    pub gaps: Vec<&'a CriticalGap>,
    /// The motion that needs most.
    pub governing: &'a CriticalGap,
    /// Mean \[m\].
    pub mean_m: f64,
    /// Standard deviation \[m\].
    pub deviation_m: f64,
}

/// The sets of a search, pair by pair.
#[must_use]
pub fn gap_sets(found: &[CriticalGap]) -> Vec<GapSet<'_>> {
    let mut pairs: Vec<(&[String; 2], Vec<&CriticalGap>)> = Vec::new();
    for gap in found {
        match pairs.iter_mut().find(|(pair, _)| *pair == &gap.between) {
            Some((_, gaps)) => gaps.push(gap),
            None => pairs.push((&gap.between, vec![gap])),
        }
    }
    let sets = pairs.into_iter().filter_map(|(_, gaps)| {
        let widths: Vec<f64> = gaps.iter().map(|gap| gap.needed_m()).collect();
        let n = widths.len() as f64;
        let mean = widths.iter().sum::<f64>() / n;
        let square: f64 = widths.iter().map(|w| (w - mean) * (w - mean)).sum();
        let of = |gap: &CriticalGap| gap.needed_m();
        let governing = gaps
            .iter()
            .copied()
            .max_by(|a, b| of(a).total_cmp(&of(b)))?;
        Some(GapSet {
            governing,
            mean_m: mean,
            deviation_m: (square / (n - 1.0).max(1.0)).sqrt(),
            gaps,
        })
    });
    sets.collect()
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
        let outcome = GapOutcome {
            impact_count: self.impact_count?,
            peak_force_n: self.peak_force_n?,
            is_reversed: false,
        };
        let other = self.reversed_impact_count.zip(self.reversed_peak_force_n);
        let worse = other.filter(|(_, force)| *force > outcome.peak_force_n);
        Some(
            worse.map_or(outcome, |(impact_count, peak_force_n)| GapOutcome {
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
    /// Names of the neighbours whose gap is searched; `None` in the runs without contact, which serve all gaps.
    pub between: Option<[String; 2]>,
    /// Runs made, with the parts done of those under way.
    pub done: f64,
    /// Runs known to be needed so far.
    pub of: usize,
}

/// What a search has found.
#[derive(Clone, Debug, PartialEq)]
pub struct GapSearch {
    /// Gaps in the order of the model. Where the search was stopped, the last one lacks its curve, and outcomes that are not known.
    pub gaps: Vec<CriticalGap>,
    /// Whether it was stopped before its end.
    pub stopped: bool,
}

/// A gap wider than the greatest closing without contact by this share of it is not hit: all that differs is rounding.
const BEYOND: f64 = 1e-6;
/// The same for small closings \[m\].
const LEAST_BEYOND: f64 = 1e-9;

/// A gap that no displacement closes \[m\].
const NEVER: f64 = 1e6;
/// Rounds in which widths and closings settle: each changes the other by some percent of its change.
const MOST_ROUNDS: usize = 20;
/// Least width between foundations that act on each other \[m\].
const LEAST_WIDTH: f64 = 1e-4;
/// Runs before a search gives up.
const MOST_RUNS: usize = 200;

/// Searches every gap of a model under one motion, each by itself while the others are out of reach.
///
/// Buildings that do not touch do not feel the gap, so the greatest closing of a run without contact is the answer
/// except for rounding: no wider gap is run, because there is no contact. A run with contact at a narrower one
/// makes sure that there is an impact, and bisection narrows the bracket to `settings.tolerance`. No width is run
/// twice. Both signs of the motion and the outcomes of rules are run on all cores. Where bearings have bounds, the gap
/// needed is searched with all bearings at either of them too. `report` is called often while runs are under way. A search that is stopped
/// keeps what it has found.
///
/// # Errors
/// [`GapError`]; [`GapError::Stopped`] where it is stopped before anything is found.
pub fn search_gaps(
    model: &Model,
    motion: &GroundMotion,
    settings: &GapSettings,
    stop: &(dyn Fn() -> bool + Sync),
    report: &(dyn Fn(&GapProgress) + Sync),
) -> Result<GapSearch, GapError> {
    let work = Work::new(report);
    let mut search = search_with(model, motion, settings, stop, &work)?;
    if search.stopped || !has_bounds(model) {
        return Ok(search);
    }
    let settings = GapSettings {
        outcomes: false,
        curve: 0,
        ..settings.clone()
    };
    let at_bound = |upper| search_with(&at_bound(model, upper), motion, &settings, stop, &work);
    let (lower, upper) = match (at_bound(false), at_bound(true)) {
        (Ok(lower), Ok(upper)) if !lower.stopped && !upper.stopped => (lower, upper),
        (Err(error), _) | (_, Err(error)) if !matches!(error, GapError::Stopped) => {
            return Err(error);
        }
        _ => {
            search.stopped = true;
            return Ok(search);
        }
    };
    let bounds = lower.gaps.iter().zip(&upper.gaps);
    for (gap, (lower, upper)) in search.gaps.iter_mut().zip(bounds) {
        gap.gap_at_bounds_m = Some([lower.needed_m(), upper.needed_m()]);
        let needed = gap.needed_m();
        for rule in &mut gap.rules {
            rule.ratio_of_both_signs = rule.ratio_of_both_signs.map(|_| rule.gap_m / needed);
        }
    }
    Ok(search)
}

/// Searches every gap with the bearings as they are.
fn search_with(
    model: &Model,
    motion: &GroundMotion,
    settings: &GapSettings,
    stop: &(dyn Fn() -> bool + Sync),
    work: &Work<'_>,
) -> Result<GapSearch, GapError> {
    if model.gaps.is_empty() {
        return Err(GapError::NoGap);
    }
    let apart = |motion| -> Result<_, GapError> {
        let runs = GapRuns::new(model, motion, stop)?;
        let widths = if model.moves_by_gaps() {
            widths_in_use(model, &runs, settings.tolerance, work)?
        } else {
            vec![NEVER; model.gaps.len()]
        };
        let apart = work.run(&runs, &widths, Pounding::Excluded)?;
        Ok((runs, apart, widths))
    };
    let other = motion.reversed();
    work.expect(1 + usize::from(settings.reversed));
    let (forward, reversed) = rayon::join(
        || apart(motion),
        || settings.reversed.then(|| apart(&other)).transpose(),
    );
    let ((runs, apart, others), reversed) = (forward?, reversed?);
    let search = Search {
        model,
        motion,
        work,
        runs: &runs,
        apart: &apart,
        others: &others,
    };
    let reversed = reversed.as_ref().map(|(runs, apart, others)| Search {
        motion: &other,
        runs,
        apart,
        others,
        ..search
    });
    let mut gaps = Vec::new();
    for gap in 0..model.gaps.len() {
        let (found, stopped) = match search.gap(gap, reversed, settings) {
            Ok(found) => found,
            Err(GapError::Stopped) if !gaps.is_empty() => {
                return Ok(GapSearch {
                    gaps,
                    stopped: true,
                });
            }
            Err(error) => return Err(error),
        };
        gaps.push(found);
        if stopped {
            return Ok(GapSearch { gaps, stopped });
        }
    }
    Ok(GapSearch {
        gaps,
        stopped: false,
    })
}

/// Widths that buildings just do not close, where foundations act on each other across the gaps: the closing without contact depends on
/// the width, a little.
fn widths_in_use(
    model: &Model,
    runs: &GapRuns<'_>,
    tolerance: f64,
    work: &Work<'_>,
) -> Result<Vec<f64>, GapError> {
    let mut widths: Vec<f64> = model.gaps.iter().map(Gap::width).collect();
    for _ in 0..MOST_ROUNDS {
        work.expect(1);
        let tried = work.run(runs, &widths, Pounding::Excluded)?;
        let mut change = 0.0_f64;
        for (gap, width) in widths.iter_mut().enumerate() {
            if let Some((_, closing)) = nearest_of(&tried, gap) {
                let found = closing.max(LEAST_WIDTH);
                change = change.max((found - *width).abs());
                *width = found;
            }
        }
        if change < 0.1 * tolerance {
            break;
        }
    }
    Ok(widths)
}

/// As [`search_gaps`], where only all of it is of use.
///
/// # Errors
/// [`GapError`]; [`GapError::Stopped`] wherever it is stopped.
pub fn critical_gaps(
    model: &Model,
    motion: &GroundMotion,
    settings: &GapSettings,
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Vec<CriticalGap>, GapError> {
    let search = search_gaps(model, motion, settings, stop, &|_| {})?;
    match search.stopped {
        true => Err(GapError::Stopped),
        false => Ok(search.gaps),
    }
}

/// Counts what is done and known to be needed, for reports.
struct Work<'a> {
    report: &'a (dyn Fn(&GapProgress) + Sync),
    now: Mutex<GapProgress>,
}

impl<'a> Work<'a> {
    fn new(report: &'a (dyn Fn(&GapProgress) + Sync)) -> Self {
        let now = Mutex::new(GapProgress {
            between: None,
            done: 0.0,
            of: 0,
        });
        Self { report, now }
    }

    fn tell(&self, change: impl FnOnce(&mut GapProgress)) {
        let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut now);
        (self.report)(&now);
    }

    /// Runs that are about to be made.
    fn expect(&self, runs: usize) {
        self.tell(|now| now.of += runs);
    }

    fn turn_to(&self, between: &[String; 2]) {
        self.tell(|now| now.between = Some(between.clone()));
    }

    /// One run, counted as it goes on.
    fn run(
        &self,
        runs: &GapRuns<'_>,
        widths: &[f64],
        pounding: Pounding,
    ) -> Result<Tried, GapError> {
        let mut counted = 0.0;
        let tried = runs.run(widths, pounding, &mut |reached| {
            // A run that is repeated begins anew; it counts on only where it was.
            let part = reached.time / reached.duration;
            if part > counted + TOLD {
                self.tell(|now| now.done += part - counted);
                counted = part;
            }
        })?;
        self.tell(|now| now.done += 1.0 - counted);
        Ok(tried)
    }
}

/// Part of a run after which progress is told \[–\].
const TOLD: f64 = 1e-3;

/// Closing of a contact of a gap that the nearest of its contacts would have, as far as it is set back from that by some part of the
/// gap: it needs that much less \[m\].
fn needed(tried: &Tried, contact: usize) -> f64 {
    let contacts = &tried.system.contacts;
    let gap_contacts = contacts
        .iter()
        .filter(|candidate| candidate.gap == contacts[contact].gap);
    let least = gap_contacts
        .map(|contact| contact.width)
        .fold(f64::INFINITY, f64::min);
    tried.outcome.peaks.closing(contact).value - (contacts[contact].width - least)
}

/// The contact of a gap that comes nearest, and its closing, at least zero \[m\].
fn nearest_of(tried: &Tried, gap: usize) -> Option<(usize, f64)> {
    let contacts = 0..tried.system.contacts.len();
    let contacts = contacts.filter(|contact| tried.system.contacts[*contact].gap == gap);
    let closings = contacts.map(|contact| (contact, needed(tried, contact)));
    let nearest = closings.max_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map(|(contact, closing)| (contact, closing.max(0.0)))
}

/// A model under a motion, or its reverse.
#[derive(Clone, Copy)]
struct Search<'a> {
    model: &'a Model,
    motion: &'a GroundMotion,
    work: &'a Work<'a>,
    runs: &'a GapRuns<'a>,
    /// The run without contact.
    apart: &'a Tried,
    /// Widths of gaps other than that which is searched \[m\].
    others: &'a [f64],
}

/// One gap, while all others are out of reach.
struct OneGap<'a> {
    search: Search<'a>,
    gap: usize,
    /// The contact that comes nearest without contact forces.
    nearest: usize,
    /// Greatest closing without contact \[m\].
    closing: f64,
    /// Widths that were run, and what they led to.
    known: Vec<GapPoint>,
}

impl<'a> OneGap<'a> {
    fn new(search: Search<'a>, gap: usize) -> Result<Self, GapError> {
        let (nearest, closing) = nearest_of(search.apart, gap).ok_or_else(|| {
            let between = search.apart.summary.gaps[gap].between.join(" and ");
            GapError::NoContact(between)
        })?;
        Ok(Self {
            search,
            gap,
            nearest,
            closing,
            known: Vec::new(),
        })
    }

    /// Widths that are not hit, since the buildings never come so close.
    fn is_out_of_reach(&self, width: f64) -> bool {
        width >= self.closing * (1.0 + BEYOND) + LEAST_BEYOND
    }

    /// Outcome with a width, if no run is needed to know it.
    fn known_at(&self, width: f64) -> Option<GapPoint> {
        if self.is_out_of_reach(width) {
            return Some(GapPoint::without_impact(width));
        }
        let mut known = self.known.iter();
        known.find(|known| known.width_m == width).copied()
    }

    /// Runs the model with a width, and with all other gaps out of reach, or as wide as needed where foundations act across them.
    fn run(&self, width: f64) -> Result<GapPoint, GapError> {
        let mut widths = self.search.others.to_vec();
        widths[self.gap] = width;
        let work = self.search.work;
        let tried = work.run(self.search.runs, &widths, Pounding::Included)?;
        Ok(GapPoint::new(width, self.gap, &tried))
    }

    /// Outcome with a width; runs the model only if it is not known yet.
    fn at(&mut self, width: f64) -> Result<GapPoint, GapError> {
        if let Some(point) = self.known_at(width) {
            return Ok(point);
        }
        self.search.work.expect(1);
        let point = self.run(width)?;
        self.known.push(point);
        Ok(point)
    }

    /// Those of the widths that have to be run, each once.
    fn unknown(&self, widths: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut unknown: Vec<f64> = widths.filter(|w| self.known_at(*w).is_none()).collect();
        unknown.sort_by(f64::total_cmp);
        unknown.dedup();
        unknown
    }

    /// Narrows down the smallest gap without an impact, beginning with the closing of a run without contact.
    fn bracket(&mut self, tolerance: f64) -> Result<Bracket, GapError> {
        let closing = self.closing;
        let mut is_hit = |width: f64| {
            if self.known.len() > MOST_RUNS {
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

/// Runs gaps with all of these widths, on all cores, and keeps what they lead to: all that was known before a stop.
fn run_all(gaps: &mut [OneGap<'_>], widths: &[f64]) -> Result<(), GapError> {
    let mut tasks = Vec::new();
    for (index, gap) in gaps.iter().enumerate() {
        let unknown = gap.unknown(widths.iter().copied());
        tasks.extend(unknown.into_iter().map(|width| (index, width)));
    }
    let Some(first) = gaps.first() else {
        return Ok(());
    };
    first.search.work.expect(tasks.len());
    let led: Vec<_> = tasks
        .par_iter()
        .map(|(index, width)| gaps[*index].run(*width))
        .collect();
    let mut whole = Ok(());
    for ((index, _), led) in tasks.into_iter().zip(led) {
        match led {
            Ok(point) => gaps[index].known.push(point),
            Err(error) if whole.is_ok() => whole = Err(error),
            Err(_) => {}
        }
    }
    whole
}

impl Search<'_> {
    /// What is found of a gap, and whether the search was stopped before its outcomes and its curve were known.
    fn gap(
        self,
        gap: usize,
        reversed: Option<Search<'_>>,
        settings: &GapSettings,
    ) -> Result<(CriticalGap, bool), GapError> {
        let (apart, model) = (self.apart, self.model);
        let between = apart.summary.gaps[gap].between.clone();
        self.work.turn_to(&between);
        let mut signs = vec![OneGap::new(self, gap)?];
        if let Some(reversed) = reversed {
            signs.push(OneGap::new(reversed, gap)?);
        }
        let (closing, nearest) = (signs[0].closing, signs[0].nearest);
        let reversed_closing = signs.get(1).map(|other| other.closing);
        let bracket = signs[0].bracket(settings.tolerance)?;
        // A wall has no period, and so no double difference.
        let modes = apart.summary.first_modes(model, gap);
        let required = apart.summary.required_gaps(model, gap, &settings.codes);
        let mut rules: Vec<RuleGap> = required.rules.into_iter().map(rule_gap).collect();
        let motion_is_reduced = settings.codes.motion == MotionLevel::Reduced;
        let compares = |rule: &RuleGap| !motion_is_reduced || rule.code.is_none();
        let mut known = Ok(());
        if settings.outcomes {
            let widths = rules.iter().filter(|rule| compares(rule));
            let widths: Vec<f64> = widths.map(|rule| rule.gap_m).collect();
            known = run_all(&mut signs, &widths);
        }
        let free_of_both = reversed_closing.unwrap_or(0.0).max(bracket.free);
        let curve: Vec<f64> = match settings.curve {
            0 => Vec::new(),
            count => {
                // Foundations that act on each other across a gap need one.
                let first = usize::from(self.model.moves_by_gaps());
                let share = 1.0 / (count.max(2) - 1 + first) as f64;
                let other =
                    reversed_closing.map_or(0.0, |closing| closing + 0.5 * settings.tolerance);
                let end = bracket.free.max(other);
                let widths = (first..first + count).map(|i| share * i as f64 * end);
                widths.collect()
            }
        };
        known = known.and_then(|()| run_all(&mut signs, &curve));
        let stopped = match known {
            Err(GapError::Stopped) => true,
            known => known.map(|()| false)?,
        };
        for rule in rules.iter_mut().filter(|rule| compares(rule)) {
            rule.ratio = (bracket.free > 0.0).then(|| rule.gap_m / bracket.free);
            rule.ratio_of_both_signs = (free_of_both > 0.0).then(|| rule.gap_m / free_of_both);
            if !settings.outcomes {
                continue;
            }
            if let Some(led) = signs[0].known_at(rule.gap_m) {
                rule.impact_count = Some(led.impact_count);
                rule.peak_force_n = Some(led.peak_force_n);
                rule.first_impact_s = led.first_impact_s;
            }
            if let Some(led) = signs.get(1).and_then(|other| other.known_at(rule.gap_m)) {
                rule.reversed_impact_count = Some(led.impact_count);
                rule.reversed_peak_force_n = Some(led.peak_force_n);
            }
        }
        // A part of a curve would be taken for all of it.
        let points = |sign: usize| {
            let sign = signs.get(sign).filter(|_| !stopped);
            let points = sign.map(|sign| curve.iter().filter_map(|width| sign.known_at(*width)));
            points.into_iter().flatten().collect()
        };
        let found = CriticalGap {
            between,
            motion: self.motion.name.clone(),
            across: (self.motion.bearing.as_ref())
                .and_then(|bearing| Some(bearing.across.as_ref()?.name.clone())),
            pga_m_s2: self.motion.peak(),
            model_gap_m: self.model.gaps[gap].width(),
            motion_is_reduced,
            gap_m: bracket.free,
            reversed_gap_m: reversed_closing,
            gap_at_bounds_m: None,
            pounding_at_m: bracket.pounding,
            closing_without_contact_m: closing,
            height_m: apart.system.contacts[nearest].height,
            runs: signs.iter().map(|sign| 1 + sign.known.len()).sum(),
            periods_s: modes.map(|mode| mode.map_or(0.0, |(period, _)| period)),
            damping: modes.map(|mode| mode.map_or(0.0, |(_, damping)| damping)),
            ddc_correlation: apart.summary.correlation(model, gap),
            rules,
            left_out: required
                .left_out
                .into_iter()
                .map(|rule| LeftOutRule {
                    rule: rule.name,
                    needs: rule.needs,
                })
                .collect(),
            curve: points(0),
            reversed_curve: points(1),
        };
        Ok((found, stopped))
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
    use jostle::Structure;
    use jostle_io::builtin_model;

    use super::*;

    /// The built-in example, and the first six seconds of its motion.
    fn of_six_seconds() -> (jostle_io::Input, GroundMotion) {
        let mut input = builtin_model("paper").unwrap_or_else(|error| panic!("{error}"));
        if let Some(motion) = &mut input.motion {
            motion.duration = Some(6.0);
        }
        let motion = input.ground_motion();
        (input, motion.unwrap_or_else(|error| panic!("{error}")))
    }

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
            let found = critical_gaps(model, &motion, &settings, &|| false);
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

    /// Widths of codes are for the motion in full: none is compared with the gap of a reduced one.
    #[test]
    fn a_reduced_motion_has_no_ratios_of_codes() {
        let (input, motion) = of_six_seconds();
        let mut settings = GapSettings::default();
        settings.codes.motion = MotionLevel::Reduced;
        let factor = jostle::separation::BuildingCodes {
            behaviour_factor: Some(3.0),
            ..Default::default()
        };
        settings.codes.buildings = vec![factor; 2];
        let found = critical_gaps(&input.model, &motion, &settings, &|| false);
        let found = found.unwrap_or_else(|error| panic!("{error}")).remove(0);
        assert!(found.motion_is_reduced);
        assert!(found.rules.iter().any(|rule| rule.code == Some("en1998")));
        for rule in &found.rules {
            let compared = [
                rule.ratio.is_some(),
                rule.ratio_of_both_signs.is_some(),
                rule.worse_outcome().is_some(),
            ];
            assert_eq!(compared, [rule.code.is_none(); 3], "{}", rule.rule);
        }
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
            let found = critical_gaps(model, &motion, &settings, &|| false);
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

        // The bounds are models with these bearings: 0.85 and 1.3 times stiffness and yield force.
        let at = |factor: f64| {
            let mut model = input.model.clone();
            for building in &mut model.buildings {
                if let Some(isolation) = building.base.isolation.as_mut() {
                    isolation.bounds = None;
                    isolation.isolator = isolation.isolator.scaled(jostle::BearingFactors {
                        stiffness: factor,
                        strength: factor,
                    });
                }
            }
            run(&model).needed_m()
        };
        let bounds = [0.85, 1.3].map(at);
        assert_eq!(found.gap_at_bounds_m, Some(bounds));
        assert!(bounds[0] > bounds[1] && found.needed_m() == bounds[0]);
        let ratio = sum.and_then(|sum| Some(sum.gap_m / sum.ratio_of_both_signs?));
        assert!(ratio.is_some_and(|needed| (needed / bounds[0] - 1.0).abs() < 1e-12));
    }

    /// Gaps that cannot close are not run, none is run twice, and every run is reported.
    #[test]
    fn what_is_known_is_not_run() {
        let (input, motion) = of_six_seconds();
        let last = Mutex::new(None);
        let report = |progress: &GapProgress| {
            assert!(progress.done <= progress.of as f64 + 1e-9, "{progress:?}");
            let before = last.lock().expect("no panic").replace(progress.clone());
            assert!(before.is_none_or(|before: GapProgress| before.done <= progress.done));
        };
        let settings = GapSettings {
            reversed: false,
            ..GapSettings::default()
        };
        let found = search_gaps(&input.model, &motion, &settings, &|| false, &report);
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        assert!(!found.stopped);
        let gap = &found.gaps[0];
        let last = last.into_inner().expect("no panic").expect("reports");
        assert!(last.between.is_some_and(|between| between == gap.between));
        assert_eq!(last.of, gap.runs);
        assert!((last.done - gap.runs as f64).abs() < 1e-9, "{}", last.done);
        // Without contact, below the closing, and every rule that closes.
        let closing = gap.closing_without_contact_m;
        let mut narrow: Vec<f64> = gap.rules.iter().map(|rule| rule.gap_m).collect();
        narrow.retain(|width| *width < closing);
        narrow.sort_by(f64::total_cmp);
        narrow.dedup();
        assert_eq!(gap.runs, 2 + narrow.len(), "{narrow:?}");
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
        let runs = GapRuns::new(&input.model, &motion, &|| false);
        let runs = runs.unwrap_or_else(|error| panic!("{error}"));
        for width in [closing * (1.0 + 2.0 * BEYOND), gap.gap_m] {
            let tried = runs.run(&[width], Pounding::Included, &mut |_| {});
            let tried = tried.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(tried.summary.gaps[0].impact_count, 0, "at {width}");
        }
    }

    /// Curves reach to where neither sign of the motion leads to an impact.
    #[test]
    fn curves_have_both_signs() {
        let (input, motion) = of_six_seconds();
        let settings = GapSettings {
            outcomes: false,
            curve: 4,
            ..GapSettings::default()
        };
        let found = critical_gaps(&input.model, &motion, &settings, &|| false);
        let gap = found.unwrap_or_else(|error| panic!("{error}")).remove(0);
        let other = critical_gaps(&input.model, &motion.reversed(), &settings, &|| false);
        let other = other.unwrap_or_else(|error| panic!("{error}")).remove(0);
        let apart = gap.needed_m() - other.needed_m();
        assert!(apart.abs() <= settings.tolerance);
        for curve in [&gap.curve, &gap.reversed_curve] {
            assert_eq!(curve.len(), 4);
            assert!(curve[0].impact_count > 0 && curve[3].impact_count == 0);
            assert_eq!(curve[3].width_m, other.curve[3].width_m);
        }
        let forces = |curve: &[GapPoint]| curve.iter().map(|p| p.peak_force_n).collect::<Vec<_>>();
        assert_eq!(forces(&gap.reversed_curve), forces(&other.curve));
    }

    /// A search that is stopped keeps the smallest gap, and the outcomes that are known; before that there is nothing.
    #[test]
    fn a_stopped_search_keeps_what_it_found() {
        let (input, motion) = of_six_seconds();
        let done = Mutex::new(0.0);
        let until = |most: f64| {
            let stop = || *done.lock().expect("no panic") >= most;
            let report = |progress: &GapProgress| *done.lock().expect("no panic") = progress.done;
            *done.lock().expect("no panic") = 0.0;
            search_gaps(
                &input.model,
                &motion,
                &GapSettings::default(),
                &stop,
                &report,
            )
        };
        assert_eq!(until(0.5), Err(GapError::Stopped));
        let whole = until(f64::INFINITY).unwrap_or_else(|error| panic!("{error}"));
        // Two runs without contact, one below the closing.
        let part = until(3.2).unwrap_or_else(|error| panic!("{error}"));
        assert!(part.stopped && !whole.stopped);
        let (part, whole) = (&part.gaps[0], &whole.gaps[0]);
        assert_eq!(part.gap_m, whole.gap_m);
        assert_eq!(part.reversed_gap_m, whole.reversed_gap_m);
        let counted = |gap: &CriticalGap| {
            let rules = gap.rules.iter();
            rules.filter(|rule| rule.worse_outcome().is_some()).count()
        };
        assert!(counted(part) < counted(whole));
        assert_eq!(counted(whole), whole.rules.len());
    }

    /// Foundations that act on each other cannot touch.
    #[test]
    fn curves_over_coupled_foundations_begin_beyond_zero() {
        let example = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/two_towers_on_soil.toml"
        );
        let example = std::path::Path::new(example);
        let input = jostle_io::read_model_file(example).unwrap_or_else(|error| panic!("{error}"));
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let settings = GapSettings {
            outcomes: false,
            curve: 3,
            ..GapSettings::default()
        };
        let found = critical_gaps(&input.model, &motion, &settings, &|| false);
        let found = &found.unwrap_or_else(|error| panic!("{error}"))[0];
        // With this gap, and foundations so far apart, the buildings close it within the tolerance.
        let mut model = input.model.clone();
        model.gaps[0].set_width(found.gap_m);
        let runs =
            GapRuns::new(&model, &motion, &|| false).unwrap_or_else(|error| panic!("{error}"));
        let apart = runs.run(&[found.gap_m], Pounding::Excluded, &mut |_| {});
        let apart = apart.unwrap_or_else(|error| panic!("{error}"));
        let (_, closing) = nearest_of(&apart, 0).expect("contacts");
        assert!(
            (found.gap_m - closing).abs() <= settings.tolerance,
            "{found:?}"
        );
        let curve = &found.curve;
        let [first, second, third] = [0, 1, 2].map(|at| curve[at].width_m);
        assert!(first > 0.0 && second == 2.0 * first && (third / first - 3.0).abs() < 1e-12);
    }

    /// Every point of the curve is the run of a model with that width, assembled by itself.
    #[test]
    fn points_of_the_curve_are_runs() {
        let (input, motion) = of_six_seconds();
        let settings = GapSettings {
            outcomes: false,
            curve: 9,
            ..GapSettings::default()
        };
        let found = critical_gaps(&input.model, &motion, &settings, &|| false);
        let gap = &found.unwrap_or_else(|error| panic!("{error}"))[0];
        assert_eq!(gap.curve.len(), 9);
        let end = gap.reversed_gap_m.expect("both signs") + 0.5 * settings.tolerance;
        assert_eq!(
            (gap.curve[0].width_m, gap.curve[8].width_m),
            (0.0, end.max(gap.gap_m))
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
