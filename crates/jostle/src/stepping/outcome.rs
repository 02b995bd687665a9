//! Settings and results of a run.

use super::acceleration_parts::AccelerationParts;
use std::ops::ControlFlow;

use super::member_ratios::MemberRatios;
use super::plan::Plan;
use super::refined::Refined;
use crate::history::{
    Energy, FaceImpact, History, Impact, MemberHistory, Peaks, SectionRatio, SpringEvent,
    SpringHistory, Storage, Work, WorstInstant,
};
use crate::linear::NotPositive;
use crate::model::ROW_INTERVAL;
use crate::state::State;
use crate::system::{BuildingSystem, System};

/// Settings of a run.
///
/// ```
/// use jostle::{Pounding, Settings};
///
/// // Peaks and impacts only, buildings that pass through each other.
/// let settings = Settings { pounding: Pounding::Excluded, record_interval: None, ..Settings::default() };
/// assert_ne!(settings, Settings::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Whether contact forces act.
    pub pounding: Pounding,
    /// Least time between recorded instants in free vibration, zero for every step; every step of a closed contact
    /// is recorded. `None` records no histories \[s\].
    pub record_interval: Option<f64>,
    /// Where histories are kept.
    pub storage: Storage,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            pounding: Pounding::Included,
            record_interval: Some(ROW_INTERVAL),
            storage: Storage::MEMORY,
        }
    }
}

/// Most rows of a history in a step of free vibration.
const MOST_ROWS: f64 = 64.0;

impl Settings {
    /// Into how many parts free steps are divided for rows of a history.
    pub(super) fn rows_per_step(&self, plan: &Plan) -> u32 {
        self.record_interval.map_or(1, |interval| {
            if interval == 0.0 {
                return 1;
            }
            let rows = (plan.step / interval * (1.0 - 1e-9)).clamp(1.0, MOST_ROWS);
            (rows.ceil() as u32).next_power_of_two()
        })
    }
}

/// Whether contact forces act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pounding {
    /// With contact forces.
    Included,
    /// Without contact forces; closings are still computed.
    Excluded,
}

/// Progress of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time reached \[s\].
    pub time: f64,
    /// Final time \[s\].
    pub duration: f64,
}

/// Is called now and then, and may stop a run. A trait object keeps stepping out of generic code, which every crate that
/// runs a simulation would compile again, without inlining the functions of this one.
pub(super) type OnProgress<'a> = dyn FnMut(Progress) -> ControlFlow<()> + 'a;

/// Results of a run.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{Outcome, RunEnd, Settings, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let outcome: Outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
/// assert_eq!(outcome.end, RunEnd::Completed);
/// let strongest = outcome.impacts.iter().map(|impact| impact.peak_force).fold(0.0, f64::max);
/// assert!(outcome.peaks.gap_force(0).value >= strongest); // of all contacts of the gap together
/// # Ok::<(), jostle::ModelFault>(())
/// ```
///
/// The default is that of a run of no buildings that was stopped before its first step.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Time histories, if requested.
    pub history: Option<History>,
    /// Impacts in the order in which they ended.
    pub impacts: Vec<Impact>,
    /// Peaks of all that the run follows, with energies that dashpots, links and springs have taken.
    pub peaks: Peaks,
    /// Impacts of the faces of buildings in space, in the order in which they began.
    pub face_impacts: Vec<FaceImpact>,
    /// Peak accelerations in parts of a direct run.
    pub(crate) acceleration_parts: AccelerationParts,
    /// Cracks and first yields, in order of time.
    pub spring_events: Vec<SpringEvent>,
    /// Loops of springs that yield, if histories were requested.
    pub spring_history: Option<SpringHistory>,
    /// Greatest and least value of every force of columns and beams, building by building, in the order of
    /// [`MemberForces::forms`](crate::structure::MemberForces::forms); empty unless asked for \[N, N·m\].
    pub members: Vec<Vec<[f64; 2]>>,
    /// Forces of members over time, if asked for.
    pub member_history: Option<MemberHistory>,
    /// Demand over capacity of the members of [`System::ratings`]: their sections one after the other, each by every
    /// rule.
    pub member_ratios: Vec<SectionRatio>,
    /// All forces of columns and beams of every building when its governing ratio of demand to capacity was greatest.
    pub worst_instants: Vec<WorstInstant>,
    /// Energies at the end.
    pub energy: Energy,
    /// Work done.
    pub work: Work,
    /// Regular free-vibration step; `None` if the run did not start \[s\].
    pub free_step: Option<f64>,
    /// Smallest regular step taken in contact \[s\].
    pub contact_step: Option<f64>,
    /// State at the end.
    pub state: State,
    /// Estimated errors of reported peaks, if any.
    pub accuracy: Option<Accuracy>,
    /// How a run by modes was refined.
    pub(crate) refined: Refined,
    /// Reason for the end.
    pub end: RunEnd,
    /// Whether a repetition with shorter steps, or the one that tells the error, was stopped: this is the run before it.
    pub interrupted: bool,
}

impl Outcome {
    /// Reason for the end of the run with its repetitions: stopped as well if one of them was. Results that must not depend on when
    /// a run was stopped ask for this one.
    #[must_use]
    pub fn end_of_all(&self) -> &RunEnd {
        if self.interrupted {
            &RunEnd::Stopped
        } else {
            &self.end
        }
    }
}

/// An a-posteriori estimate of the errors of reported peaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Tolerance, relative to the greatest of their kind in the building \[–\].
    pub tolerance: f64,
    /// Estimated error \[–\].
    pub residual: f64,
    /// First instant at which a contact was made or missed by less than the tolerance; only modal stepping computes
    /// it \[s\].
    pub doubtful_from: Option<f64>,
    /// Instant from which results depend on contacts made or missed within the tolerance, if
    /// [`find_sensitivity`](super::find_sensitivity) has found one \[s\].
    pub sensitive_from: Option<f64>,
}

/// Reason for the end of a run.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{RunEnd, Settings, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let stopped = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Break(()));
/// assert_eq!(stopped.end, RunEnd::Stopped);
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub enum RunEnd {
    /// The end of the motion was reached.
    Completed,
    /// The observer asked to stop.
    #[default]
    Stopped,
    /// A step failed; earlier results are valid.
    Failed(StepError),
}

/// A failed step.
///
/// ```
/// use jostle::StepError;
///
/// let error = StepError::NotFinite { time: 1.5 };
/// assert!(error.to_string().starts_with("displacements are no longer finite at t = 1.500000 s"));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The solver does not support the system or the initial state; [`crate::Plan::choose`] reports this
    /// beforehand.
    #[error("this run cannot begin: {reason}")]
    Unsuited {
        /// The unsupported feature.
        reason: String,
    },
    /// A building is a mechanism.
    #[error(
        "\"{building}\" cannot be stepped at t = {time:.6} s: {source}; check its supports and stiffnesses"
    )]
    NotPositive {
        /// Name of the building.
        building: String,
        /// Time \[s\].
        time: f64,
        /// Where.
        source: NotPositive,
    },
    /// Springs that lose their strength fall faster than the rest of the building holds them.
    #[error(
        "\"{building}\" cannot be stepped at t = {time:.6} s: what fails in shear loses more force than masses and other members hold, even over the shortest steps ({source}); use a smaller slope of shear_failure"
    )]
    FallsTooFast {
        /// Name of the building.
        building: String,
        /// Time \[s\].
        time: f64,
        /// Where.
        source: NotPositive,
    },
    /// The contact forces did not converge.
    #[error(
        "the contact forces did not converge at t = {time:.6} s ({closed} contacts closed); a smaller contact_step may help"
    )]
    ContactDiverged {
        /// Time \[s\].
        time: f64,
        /// Number of closed contacts.
        closed: usize,
    },
    /// The forces of yielding springs did not converge.
    #[error(
        "the yielding springs of \"{building}\" did not converge at t = {time:.6} s even with the shortest steps; a smaller step or tolerance may help"
    )]
    SpringsDiverged {
        /// Name of the building.
        building: String,
        /// Time \[s\].
        time: f64,
    },
    /// A storey drift is beyond collapse.
    #[error(
        "\"{building}\" collapses at t = {time:.3} s: storey {storey} has a drift of {:.0} %", 100.0 * drift
    )]
    Collapse {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Storey drift over storey height \[–\].
        drift: f64,
        /// Time \[s\].
        time: f64,
    },
    /// A displacement overflowed.
    #[error(
        "displacements are no longer finite at t = {time:.6} s; check masses, stiffnesses and the ground motion"
    )]
    NotFinite {
        /// Time \[s\].
        time: f64,
    },
    /// A row of the histories could not be kept.
    #[error("histories cannot be kept from t = {time:.3} s on: {reason}")]
    HistoryNotKept {
        /// Time \[s\].
        time: f64,
        /// What the store says, with the remedy.
        reason: String,
    },
    /// Contacts close and open repeatedly without progress in time.
    #[error(
        "contacts close and open endlessly at t = {time:.6} s; a smaller contact_step or a softer contact may help"
    )]
    Chattering {
        /// Time \[s\].
        time: f64,
    },
}

impl Outcome {
    /// Why histories could not be read back, and the remedy, as the end of a sentence. Usually there is no such fault.
    #[must_use]
    pub fn history_fault(&self) -> Option<&str> {
        let history = self.history.as_ref().and_then(History::fault);
        let springs = self.spring_history.as_ref().and_then(SpringHistory::fault);
        let members = self.member_history.as_ref().and_then(MemberHistory::fault);
        history.or(springs).or(members)
    }

    /// Results of a run that could not start.
    pub(crate) fn not_begun(system: &System, error: StepError) -> Self {
        let ratios = MemberRatios::new(system);
        let unknown = |building: &BuildingSystem| vec![[0.0; 2]; building.members.forms.len()];
        Self {
            members: system.buildings.iter().map(unknown).collect(),
            member_ratios: ratios.greatest,
            worst_instants: ratios.worst,
            state: State::at_rest(system, 0.0),
            end: RunEnd::Failed(error),
            ..Self::default()
        }
    }
}
