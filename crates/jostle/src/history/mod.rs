//! Results of a run: time histories, impacts, peaks, energies and work.

use crate::hysteresis::{HysteresisMemory, Stage};
use crate::interface::MOST_POINTS;
use crate::system::System;

pub use column::{Column, EnergyTerm, Kind, Owner, Recorded};
pub use peaks::{Peak, Peaks, PeaksOf};
use rows::Rows;
pub use rows::{BlockStore, Storage};

mod column;
mod peaks;
mod rows;

/// Time histories at the recorded instants: one row per instant, one column per quantity.
///
/// ```
/// use jostle::{Column, EnergyTerm, History};
///
/// let columns = vec![Column::TIME, Column::energy(EnergyTerm::Input)];
/// let history = History::from_rows(columns, vec![0.0, 0.0, 0.01, 2.5]); // two rows
/// assert_eq!(history.len(), 2);
/// assert_eq!(history.column(Column::energy(EnergyTerm::Input)), Some(vec![0.0, 2.5]));
/// assert_eq!(history.column(Column::GROUND_ACCELERATION), None);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    columns: Vec<Column>,
    rows: Rows,
}

impl History {
    /// An empty history of the given columns in memory.
    #[must_use]
    pub fn new(columns: Vec<Column>) -> Self {
        Self::kept_in(Storage::MEMORY, columns)
    }

    /// An empty history.
    pub(crate) fn kept_in(storage: Storage, columns: Vec<Column>) -> Self {
        let rows = Rows::new(columns.len(), storage);
        Self { columns, rows }
    }

    /// A history in memory from given values, row after row.
    ///
    /// # Panics
    /// If the number of values is not a multiple of the number of columns.
    #[must_use]
    pub fn from_rows(columns: Vec<Column>, values: Vec<f64>) -> Self {
        let width = columns.len().max(1);
        assert!(
            values.len().is_multiple_of(width),
            "every row has one value per column"
        );
        let mut history = Self::new(columns);
        for row in values.chunks(width) {
            history.push_row().copy_from_slice(row);
        }
        history
    }

    /// The recorded quantities, in the order of the values of a row.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of recorded instants.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether nothing was recorded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The values of one column over time; `None` if it was not recorded. What cannot be read back is zero, and
    /// [`Self::fault`] says so.
    #[must_use]
    pub fn column(&self, column: Column) -> Option<Vec<f64>> {
        let index = self.columns.iter().position(|c| *c == column)?;
        Some(self.rows.column(index))
    }

    /// The values of one instant, in the order of the columns. Of a long history, [`Self::column`] is quicker.
    #[must_use]
    pub fn row(&self, index: usize) -> Vec<f64> {
        self.rows.row(index)
    }

    /// Why values could not be read back, and the remedy, as the end of a sentence. Usually there is no such fault.
    #[must_use]
    pub fn fault(&self) -> Option<&str> {
        self.rows.unread()
    }

    /// Why instants could not be stored, such as a full disk, and the remedy, as the end of a sentence.
    pub(crate) fn unstored(&self) -> Option<&str> {
        self.rows.unstored()
    }

    /// Appends a row for one more instant and returns it.
    pub(crate) fn push_row(&mut self) -> &mut [f64] {
        self.rows.push()
    }

    /// Reserves memory for `rows` further instants.
    pub(crate) fn reserve(&mut self, rows: usize) {
        self.rows.reserve(rows);
    }
}

/// One closed episode of a contact with a force.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{Impact, Settings, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
/// let strongest: Option<&Impact> = outcome.impacts.iter().max_by(|a, b| a.peak_force.total_cmp(&b.peak_force));
/// let strongest = strongest.expect("they collide");
/// assert!(strongest.start <= strongest.peak_force_at && strongest.peak_force_at <= strongest.end);
/// assert!(strongest.impulse > 0.0);
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Index of the contact in the system.
    pub contact: usize,
    /// Instant of first contact \[s\].
    pub start: f64,
    /// Last instant of force before the gap opens again, or the end of the run \[s\].
    pub end: f64,
    /// Greatest force \[N\].
    pub peak_force: f64,
    /// Instant of the greatest force \[s\].
    pub peak_force_at: f64,
    /// Greatest indentation \[m\].
    pub peak_indentation: f64,
    /// Closing rate at first contact \[m/s\].
    pub impact_speed: f64,
    /// Opening rate at the end, zero for an impact in progress at the end of the run \[m/s\].
    pub separation_speed: f64,
    /// Whether it ended within the run.
    pub finished: bool,
    /// Time integral of the force \[N·s\].
    pub impulse: f64,
    /// Energy dissipated by the contact, without friction \[J\].
    pub dissipated: f64,
    /// What slides along the face.
    pub sliding: Sliding,
}

/// What happens along the face of an impact of two buildings in space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sliding {
    /// Speed along the face at first contact, the first building against the second, along the normal turned by +90°
    /// \[m/s\].
    pub slip_speed: f64,
    /// Greatest friction force, either sign, and its instant \[N, s\].
    pub peak_force: f64,
    /// See `peak_force`.
    pub peak_force_at: f64,
    /// Greatest slip since first contact, either sign \[m\].
    pub slip_peak: f64,
    /// Time integral of the friction force, with its sign \[N·s\].
    pub impulse: f64,
    /// Energy dissipated by friction \[J\].
    pub friction: f64,
    /// Whether it ended because a corner slid off the edge that it pressed.
    pub slid_off: bool,
}

impl Sliding {
    /// Together with what follows: greatest values and sums, and the slip speed of the first.
    #[must_use]
    pub(crate) fn and(self, next: &Self) -> Self {
        let (peak_force, peak_force_at) = if next.peak_force > self.peak_force {
            (next.peak_force, next.peak_force_at)
        } else {
            (self.peak_force, self.peak_force_at)
        };
        Self {
            slip_speed: self.slip_speed,
            peak_force,
            peak_force_at,
            slip_peak: self.slip_peak.max(next.slip_peak),
            impulse: self.impulse + next.impulse,
            friction: self.friction + next.friction,
            slid_off: next.slid_off,
        }
    }
}

impl Impact {
    /// Separation speed ÷ impact speed \[–\]. Other forces act during an impact of buildings, so this ratio may
    /// differ from the restitution of free masses and may exceed one.
    #[must_use]
    pub fn realised_restitution(&self) -> f64 {
        self.separation_speed / self.impact_speed
    }
}

/// An impact of a face of two buildings in space: all its points together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceImpact {
    /// Number of the face.
    pub face: usize,
    /// Instant at which the first point touched, and at which the last one parted, or the end of the run \[s\].
    pub start: f64,
    /// See `start`.
    pub end: f64,
    /// Greatest total force, and its instant \[N\].
    pub peak_force: Extreme,
    /// Centre of pressure then, on the site \[m\].
    pub centre: [f64; 2],
    /// Forces of its points then, in the order of the points of the face; zeros beyond the last \[N\].
    pub point_forces: [f64; MOST_POINTS],
    /// Greatest total friction force along the face, either sign, and its instant \[N\].
    pub peak_friction: Extreme,
}

impl FaceImpact {
    /// One that begins at an instant \[s\].
    pub(crate) fn beginning(face: usize, start: f64) -> Self {
        Self {
            face,
            start,
            end: start,
            peak_force: Extreme::default(),
            centre: [0.0; 2],
            point_forces: [0.0; MOST_POINTS],
            peak_friction: Extreme::default(),
        }
    }
}

/// An extreme value and its instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// The value.
    pub value: f64,
    /// Its instant \[s\].
    pub at: f64,
}

/// Energies \[J\] and the greatest error of their balance so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Work of the ground motion.
    pub input: f64,
    /// Work of grounds that move apart, through contacts and links (theory, Eq. B17).
    pub ground: f64,
    /// Kinetic energy relative to the ground.
    pub kinetic: f64,
    /// Strain energy of members.
    pub strain: f64,
    /// Dissipated by viscous damping, that of links included.
    pub damped: f64,
    /// The part of links.
    pub links: f64,
    /// Energy of hinges.
    pub hysteretic: f64,
    /// Energy of contacts, without friction.
    pub contact: f64,
    /// Dissipated by friction along faces, with what its springs hold.
    pub friction: f64,
    /// Greatest |imbalance| met at any recorded instant, relative to the greatest energy until then \[–\].
    pub worst_imbalance: f64,
}

impl Energy {
    /// Input + ground − (kinetic + strain + damped + hysteretic + contact + friction) \[J\].
    #[must_use]
    pub fn residual(&self) -> f64 {
        let held = self.kinetic + self.strain + self.damped + self.hysteretic + self.contact;
        self.input + self.ground - (held + self.friction)
    }

    /// |residual| / input at this instant \[–\]; zero without input energy.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        if self.input == 0.0 {
            0.0
        } else {
            (self.residual() / self.input).abs()
        }
    }
}

/// Work done by a run: the machine-independent measure of speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Accepted steps with a closed contact.
    pub contact_steps: u64,
    /// Steps repeated because a contact closed or opened inside them.
    pub repeated_steps: u64,
    /// Factorisations of one building's equations.
    pub factorizations: u64,
    /// Solutions of one building's equations.
    pub solves: u64,
    /// Newton iterations on the contact forces.
    pub iterations: u64,
    /// Iterations on springs that yield; one per trial step without branch change.
    pub outer_iterations: u64,
    /// Steps halved because those did not converge.
    pub halved_steps: u64,
    /// Multiply-adds spent on the forces of contacts and links.
    pub coupling_operations: u64,
    /// Shapes used by modal stepping.
    pub shapes: u64,
    /// Runs repeated by modal stepping with more shapes or finer steps.
    pub repeated_runs: u64,
}

/// Deformation and force of every spring that yields at the instants of a [`History`].
#[derive(Clone, Debug, PartialEq)]
pub struct SpringHistory {
    rows: Rows,
}

impl SpringHistory {
    pub(crate) fn new(springs: usize, storage: Storage) -> Self {
        Self {
            rows: Rows::new(2 * springs, storage),
        }
    }

    pub(crate) fn push(&mut self, memories: &[HysteresisMemory]) {
        let row = self.rows.push().chunks_mut(2);
        for (values, memory) in row.zip(memories) {
            values.copy_from_slice(&[memory.deformation(), memory.force()]);
        }
    }

    pub(crate) fn reserve(&mut self, rows: usize) {
        self.rows.reserve(rows);
    }

    /// See [`History::fault`].
    #[must_use]
    pub fn fault(&self) -> Option<&str> {
        self.rows.unread()
    }

    /// See [`History::unstored`].
    pub(crate) fn unstored(&self) -> Option<&str> {
        self.rows.unstored()
    }

    /// Deformation \[rad or m\] and force \[N·m or N\] of a spring, counted from the left building on, at every
    /// instant, in single precision.
    pub fn of_spring(&self, spring: usize) -> impl Iterator<Item = [f32; 2]> + use<> {
        let [deformations, forces] = [0, 1].map(|part| self.rows.column(2 * spring + part));
        let pairs = deformations.into_iter().zip(forces);
        pairs.map(|(deformation, force)| [deformation as f32, force as f32])
    }
}

/// Axial force, shear and moment of members over time, then shear and moment in the plane across and torque, which are zero beyond
/// space frames, at the instants of a [`History`] \[N, N, N·m, N, N·m, N·m\].
#[derive(Clone, Debug, PartialEq)]
pub struct MemberHistory {
    members: Vec<[usize; 2]>,
    /// Instants, then the forces of section after section.
    rows: Rows,
}

/// Forces at a section of a member.
pub const SECTION_FORCES: usize = 6;

impl MemberHistory {
    /// Of these members: building, and member of its forces; `None` if there are none.
    pub(crate) fn new(system: &System, storage: Storage) -> Option<Self> {
        let width = Self::width(system);
        (width > 0).then(|| Self {
            members: system.members_followed.clone(),
            rows: Rows::new(width, storage),
        })
    }

    /// Numbers of a row; zero if no members are followed.
    pub(crate) fn width(system: &System) -> usize {
        let members = &system.members_followed;
        let sections = |[building, member]: &[usize; 2]| {
            let forces = &system.buildings[*building].members;
            forces.members[*member].sections.len()
        };
        let sections: usize = members.iter().map(sections).sum();
        usize::from(!members.is_empty()) + SECTION_FORCES * sections
    }

    /// Adds an instant \[s\]; `values`: those of all forms, building by building.
    pub(crate) fn push(&mut self, system: &System, time: f64, values: &[Vec<f64>]) {
        let (instant, row) = self.rows.push().split_at_mut(1);
        instant[0] = time;
        let members = self.members.iter();
        let sections = members.flat_map(|[building, member]| {
            let forces = &system.buildings[*building].members;
            let sections = forces.members[*member].sections.iter();
            sections.map(|section| (section, &values[*building]))
        });
        for (forces, (section, values)) in row.chunks_mut(SECTION_FORCES).zip(sections) {
            let [axial, shear, moment] = section.forms.map(|form| values[form]);
            let across = section.across.map(|forms| forms.map(|form| values[form]));
            let [shear_across, moment_across, torque] = across.unwrap_or_default();
            forces.copy_from_slice(&[axial, shear, moment, shear_across, moment_across, torque]);
        }
    }

    pub(crate) fn reserve(&mut self, rows: usize) {
        self.rows.reserve(rows);
    }

    /// See [`History::fault`].
    #[must_use]
    pub fn fault(&self) -> Option<&str> {
        self.rows.unread()
    }

    /// See [`History::unstored`].
    pub(crate) fn unstored(&self) -> Option<&str> {
        self.rows.unstored()
    }

    /// Members that it follows: building, and member of its forces.
    #[must_use]
    pub fn members(&self) -> &[[usize; 2]] {
        &self.members
    }

    /// Number of recorded instants.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether nothing was recorded.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of sections of all members.
    #[must_use]
    pub fn sections(&self) -> usize {
        self.rows.width() / SECTION_FORCES
    }

    /// Recorded instants \[s\].
    #[must_use]
    pub fn times(&self) -> Vec<f64> {
        self.rows.column(0)
    }

    /// One force of a section at every instant; sections count through all members in their order, forces up to
    /// [`SECTION_FORCES`].
    #[must_use]
    pub fn force(&self, section: usize, force: usize) -> Vec<f64> {
        self.rows.column(1 + SECTION_FORCES * section + force)
    }

    /// Forces of the sections of all members at every instant, in the order of the members. Of a long history,
    /// [`Self::force`] is quicker.
    pub fn rows(&self) -> impl Iterator<Item = Vec<[f64; SECTION_FORCES]>> + '_ {
        (0..self.len()).map(|index| {
            let row = self.rows.row(index);
            row[1..].as_chunks().0.to_vec()
        })
    }
}

/// A spring that cracks or yields for the first time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringEvent {
    /// Index among the springs of all buildings, from left to right.
    pub spring: usize,
    /// Its new stage.
    pub stage: Stage,
    /// Time \[s\].
    pub time: f64,
}

/// Greatest ratio of demand to capacity at one section of a member, by one rule.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionRatio {
    /// In shear; zero where the rule has none.
    pub shear: RatioPeak,
    /// In bending.
    pub bending: RatioPeak,
}

/// All forces of columns and beams of a building when the governing ratio of demand to capacity was greatest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorstInstant {
    /// The greatest ratio by the governing rule \[–\].
    pub ratio: f64,
    /// End of the step with it \[s\].
    pub time: f64,
    /// Forces in the order of [`MemberForces::forms`](crate::structure::MemberForces::forms); empty where nothing is rated
    /// \[N, N·m\].
    pub forces: Vec<f64>,
}

/// A greatest ratio of demand to capacity and the forces there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RatioPeak {
    /// The ratio \[–\].
    pub ratio: f64,
    /// Its instant \[s\].
    pub at: f64,
    /// Shear or moment then, and that in the plane across, with their signs \[N, N·m\].
    pub demand: [f64; 2],
    /// Compression then \[N\].
    pub compression: f64,
    /// First instant at which the demand exceeded the capacity \[s\].
    pub exceeded_at: Option<f64>,
}

impl SectionRatio {
    /// The greater of both.
    pub(crate) fn greatest(&self) -> f64 {
        self.shear.ratio.max(self.bending.ratio)
    }
}

impl RatioPeak {
    /// Takes in an instant. Ratios above a hundred million count as that, so that they are finite; no demand on no
    /// capacity counts for nothing.
    #[inline]
    pub(crate) fn take(&mut self, time: f64, demand: [f64; 2], ratio: f64, compression: f64) {
        if ratio > self.ratio {
            let ratio = ratio.min(1e8);
            (self.ratio, self.at) = (ratio, time);
            (self.demand, self.compression) = (demand, compression);
            if ratio > 1.0 && self.exceeded_at.is_none() {
                self.exceeded_at = Some(time);
            }
        }
    }
}
