//! Checks that always run: what an experienced engineer would remark on a model and on its results.
//!
//! [`CHECKS`] lists all of them with their limits, sources and remedies. [`judge`] runs those of the model, and those of the
//! results if there are any. A check that is passed says nothing.

mod contact;
mod damping;
mod drift;
mod gap;
mod impact;
mod mass;
mod period;
mod record;
mod second_order;
mod silence;
mod soft_storey;
mod support;
mod table;
mod yielding;

use crate::model::Model;
use crate::motion::GroundMotion;
use crate::results::summary::{Finding, Grade, Summary};
use crate::separation::CodeInputs;
use crate::system::System;

pub use contact::advised_stiffness;
pub use mass::floor_masses;
pub use silence::{named, names};
pub use table::{CHECKS, FROM_MODEL, JUDGEMENT, OUTSIDE_DRIFT};
pub use yielding::structure_yields;

/// What checks know.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// The model.
    pub model: &'a Model,
    /// The assembled system.
    pub system: &'a System,
    /// The ground motion, if there is one.
    pub motion: Option<&'a GroundMotion>,
    /// What the file of the model says beyond it.
    pub stated: &'a Stated,
    /// Results, if there are any, and the inputs of the separation rules of codes.
    pub results: Option<(&'a Summary, &'a CodeInputs)>,
}

/// What the file of a model says that [`Model`] does not hold.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stated {
    /// Records over which results are compared; 0 if that is not known.
    pub records: usize,
    /// By building of the model; buildings beyond the end have said nothing.
    pub buildings: Vec<StatedBuilding>,
    /// Checks that the file silences, as [`named`] gives them.
    pub silenced: Vec<&'static str>,
}

/// What the file says of one building.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedBuilding {
    /// Characteristic compressive strength of its concrete; `None` if it is not stated \[Pa\].
    pub strength: Option<f64>,
    /// Modulus of elasticity of its concrete; `None` for other materials, and if it is not stated \[Pa\].
    pub modulus: Option<f64>,
    /// Factors on EI of columns and beams \[–\].
    pub stiffness_factor: [f64; 2],
    /// Whether hinges follow from sections: they then turn by what the members leave of the rotation at yield.
    pub hinges_from_sections: bool,
    /// Compression for which the hinges of columns were made, by storey and column line; empty if hinges do not follow from sections
    /// \[N\].
    pub hinge_compression: Vec<Vec<f64>>,
    /// Whether the file says if columns shorten.
    pub axial: bool,
}

impl Default for StatedBuilding {
    fn default() -> Self {
        Self {
            strength: None,
            modulus: None,
            stiffness_factor: [1.0; 2],
            hinges_from_sections: false,
            hinge_compression: Vec::new(),
            axial: false,
        }
    }
}

impl Known<'_> {
    fn stated(&self, building: usize) -> StatedBuilding {
        let building = self.stated.buildings.get(building);
        building.cloned().unwrap_or_default()
    }
}

/// A check, or one part of it.
pub struct Check {
    /// Identifier: `A1` to `A17` of models, `B1` to `B12` of results.
    pub id: &'static str,
    /// Name of the part, unique.
    pub name: &'static str,
    /// What is compared with the limits.
    pub quantity: &'static str,
    /// Unit of that, and of the limits.
    pub unit: &'static str,
    /// Limits; the most severe one that is crossed counts.
    pub limits: &'static [Limit],
    /// Where the limits come from: at least two publications that agree, [`JUDGEMENT`] or [`FROM_MODEL`]. What only some of the limits
    /// have begins with their name.
    pub sources: &'static [&'static str],
    /// What to do about it.
    pub remedy: &'static str,
    measure: fn(&Known<'_>, &mut Tally<'_>),
}

/// A limit of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Which side of it is out.
    pub bound: Bound,
    /// The limit, in the unit of the check.
    pub value: f64,
    /// How much it matters.
    pub grade: Grade,
}

/// Which side of a limit is out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Values above it.
    Above,
    /// Values below it.
    Below,
}

impl Limit {
    fn is_crossed(&self, value: f64) -> bool {
        match self.bound {
            Bound::Above => value > self.value,
            Bound::Below => value < self.value,
        }
    }

    /// How far beyond it a value is: 1 at the limit, greater beyond.
    fn excess(&self, value: f64) -> f64 {
        match self.bound {
            Bound::Above if self.value > 0.0 => value / self.value,
            Bound::Above => 1.0 + value - self.value,
            Bound::Below => self.value / value.max(f64::MIN_POSITIVE),
        }
    }
}

/// Keeps the worst of what a check finds.
struct Tally<'a> {
    check: &'a Check,
    worst: Option<(Grade, f64, Finding)>,
}

impl Tally<'_> {
    /// Compares a value with the limits. `words`, called only if it is the worst so far, says where it is and what was found.
    fn add(&mut self, value: f64, words: impl FnOnce() -> (String, String)) {
        if !value.is_finite() {
            return;
        }
        let crossed = self.check.limits.iter().filter(|l| l.is_crossed(value));
        let Some(limit) = crossed.max_by_key(|limit| limit.grade) else {
            return;
        };
        let rank = (limit.grade, limit.excess(value));
        if let Some((grade, excess, _)) = &self.worst
            && (*grade, *excess) >= rank
        {
            return;
        }
        let (place, text) = words();
        let finding = Finding {
            id: self.check.id,
            name: self.check.name,
            grade: limit.grade,
            value,
            limit: limit.value,
            unit: self.check.unit,
            place,
            text,
            remedy: self.check.remedy,
        };
        self.worst = Some((rank.0, rank.1, finding));
    }
}

impl Check {
    /// Whether it concerns the model, rather than results.
    #[must_use]
    pub fn is_of_model(&self) -> bool {
        self.id.starts_with('A')
    }

    /// Where its limits come from, in one line.
    #[must_use]
    pub fn source(&self) -> String {
        self.sources.join("; ")
    }

    /// The worst that it finds; `None` if it is passed or does not apply.
    #[must_use]
    pub fn judge(&self, known: &Known<'_>) -> Option<Finding> {
        let mut tally = Tally {
            check: self,
            worst: None,
        };
        (self.measure)(known, &mut tally);
        tally.worst.map(|(_, _, finding)| finding)
    }
}

/// All checks that are not passed, worst first: by grade, results before the model, then in the order of the list. Checks
/// that the file silences are left out.
///
/// ```
/// use jostle::judgement::{Known, Stated, judge};
/// use jostle::System;
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
///
/// let mut model = towers::pair(0.02);
/// model.gaps[0].law.stiffness = 1e6; // N/m^1.5: a thousand times too soft
/// let system = System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// let known = Known { model: &model, system: &system, motion: None, stated: &Stated::default(), results: None };
/// assert_eq!(judge(&known)[0].id, "A7");
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[must_use]
pub fn judge(known: &Known<'_>) -> Vec<Finding> {
    let silenced = &known.stated.silenced;
    let heard = CHECKS
        .iter()
        .filter(|check| !silenced.contains(&check.name));
    let mut found: Vec<Finding> = heard.filter_map(|check| check.judge(known)).collect();
    // A stable sort keeps the order of the list.
    found.sort_by_key(|finding| {
        (
            std::cmp::Reverse(finding.grade),
            finding.id.starts_with('A'),
        )
    });
    found
}

/// A number as the model states it, for texts: with two decimals at most, so that other units can be computed from the text.
fn stated(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A name in quotes, for texts.
fn quoted(name: &str) -> String {
    format!("\"{name}\"")
}

/// Names of both sides of a gap.
fn sides(known: &Known<'_>, gap: usize) -> String {
    let [left, right] = known.model.gaps[gap]
        .between
        .map(|side| known.system.side_name(side));
    format!("{left} ↔ {right}")
}
