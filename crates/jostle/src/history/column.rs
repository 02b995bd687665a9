//! What a number of a run belongs to, and what it is: columns of histories and keys of peaks.

use crate::model::{FibreLimit, RotationLevel};
use crate::quantity::Unit;
use crate::system::Direction;

/// A quantity that runs follow: recorded over time, with a peak, or both.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use jostle::{Column, EnergyTerm, Settings, simulate};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # let model = towers::pair(0.02);
/// # let wave = (0..=300).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect();
/// # let motion = jostle::GroundMotion::sampled("sine", 0.01, wave);
/// # let system = jostle::System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// # let plan = jostle::Plan::choose(&system, &motion, &model.analysis).map_err(|faults| faults[0].clone())?;
///
/// let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| ControlFlow::Continue(()));
/// let history = outcome.history.expect("histories are recorded by default");
/// let roof = history.column(Column::displacement(0, 3)).expect("it has three floors");
/// let input = history.column(Column::energy(EnergyTerm::Input)).expect("energies are recorded");
/// assert_eq!(roof.len(), input.len());
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Column {
    /// Whose it is.
    pub owner: Owner,
    /// What it is.
    pub kind: Kind,
    /// In which direction. What has none is along the row.
    pub direction: Direction,
}

/// What a number belongs to. All count from 0, except floors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    /// The whole run.
    Run,
    /// A building, or a wall that moves, which follow the buildings.
    Building(usize),
    /// A floor and the storey below it; floors count from 1, and 0 is a mat or a wall.
    Floor {
        /// Building index.
        building: usize,
        /// Floor, from 1.
        floor: usize,
    },
    /// All bearings of a building together, or the spring and dashpot of a wall.
    Support(usize),
    /// One bearing of a building in space.
    Bearing {
        /// Building index.
        building: usize,
        /// Bearing, from 0.
        bearing: usize,
    },
    /// An end of a column that is made of fibres: it stretches (up) and turns, in space in the plane across as well (across).
    Section {
        /// Building index.
        building: usize,
        /// Its number in the building, from 0.
        section: usize,
    },
    /// The rigid foundation of a building on soil.
    Foundation(usize),
    /// The ground under a building or a wall; walls are counted on from the buildings.
    Ground(usize),
    /// A contact of the system; its force in histories is that of a face where buildings are in space.
    Contact(usize),
    /// A gap of the model: all its contacts together.
    Gap(usize),
    /// A link of the system.
    Link(usize),
    /// A spring that yields, from the left building to the right.
    Spring(usize),
}

/// What a number is. Of turning directions, lengths are angles and forces are moments about a vertical axis, or that of a foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Time \[s\].
    Time,
    /// Displacement relative to the ground; that of the ground itself from rest \[m, rad\].
    Displacement,
    /// Its rate \[m/s, rad/s\].
    Velocity,
    /// Acceleration, that of the ground included \[m/s², rad/s²\].
    Acceleration,
    /// The same after a low-pass filter, which the mechanics leaves to its callers \[m/s²\].
    FilteredAcceleration,
    /// Horizontal displacement of any corner of a plan \[m\].
    CornerDisplacement,
    /// Drift ratio of the storey below \[–, rad/m\].
    Drift,
    /// Drift ratio of the storey below at any corner of the smaller plan, along x and across together \[–\].
    CornerDrift,
    /// Shear of the storey below; of a building, elastic base shear \[N, N·m\].
    Shear,
    /// Overturning moment about the base of the storey below \[N·m\].
    Moment,
    /// Force: of a contact or a gap, of a link positive in compression; of bearings without stops \[N\].
    Force,
    /// Force of the ring that stops a mat, in any direction \[N\].
    RingForce,
    /// Rocking of a foundation in plan along and across, as displacement of floors per height \[rad\].
    Rocking,
    /// Closing of a contact, u_left − u_right \[m\].
    Closing,
    /// Shortening of a link since rest, or length of the displacement of a bearing \[m\].
    Stroke,
    /// Rate of the stroke \[m/s\].
    Speed,
    /// Energy that dashpots have taken, or work done on a link or a spring, recoverable energy included \[J\].
    Work,
    /// Time for which a spring has no force \[s\].
    Lifted,
    /// Whether fibres have passed a strain that is judged, 1, and when \[–\].
    Passed(FibreLimit),
    /// Whether a hinge has turned further than a level of performance allows, 1, and when \[–\].
    Beyond(RotationLevel),
    /// Plastic rotation of a hinge that yields on a surface \[rad\].
    Turned,
    /// A term of the energy balance \[J\].
    Energy(EnergyTerm),
}

/// What a column of a history records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recorded {
    /// Whose it is: `run`, `floor`, `contact`, `link`, `isolation`, `ground` or `energy`.
    pub owner: &'static str,
    /// Name without unit.
    pub name: &'static str,
    /// Unit.
    pub unit: Unit,
    /// Meaning, in one line.
    pub meaning: &'static str,
}

impl Column {
    /// Time \[s\].
    pub const TIME: Self = Self::along(Owner::Run, Kind::Time);
    /// Ground acceleration \[m/s²\].
    pub const GROUND_ACCELERATION: Self = Self::along(Owner::Run, Kind::Acceleration);

    /// A quantity in a direction.
    #[must_use]
    pub const fn new(owner: Owner, kind: Kind, direction: Direction) -> Self {
        Self {
            owner,
            kind,
            direction,
        }
    }

    /// A quantity along the row, or without direction.
    #[must_use]
    pub const fn along(owner: Owner, kind: Kind) -> Self {
        Self::new(owner, kind, Direction::Along)
    }

    /// The same across the row, of buildings in space.
    #[must_use]
    pub const fn across(self) -> Self {
        Self::new(self.owner, self.kind, Direction::Across)
    }

    /// The same in rotation, of buildings in space and of foundations.
    #[must_use]
    pub const fn turning(self) -> Self {
        Self::new(self.owner, self.kind, Direction::Turning)
    }

    /// The same upwards.
    #[must_use]
    pub const fn up(self) -> Self {
        Self::new(self.owner, self.kind, Direction::Up)
    }

    /// Displacement of a floor relative to the ground \[m\].
    #[must_use]
    pub const fn displacement(building: usize, floor: usize) -> Self {
        Self::along(Owner::Floor { building, floor }, Kind::Displacement)
    }

    /// Velocity of a floor relative to the ground \[m/s\].
    #[must_use]
    pub const fn velocity(building: usize, floor: usize) -> Self {
        Self::along(Owner::Floor { building, floor }, Kind::Velocity)
    }

    /// Acceleration of a floor, ground included \[m/s²\].
    #[must_use]
    pub const fn total_acceleration(building: usize, floor: usize) -> Self {
        Self::along(Owner::Floor { building, floor }, Kind::Acceleration)
    }

    /// Displacement of a floor in a direction, its rate, and its total acceleration.
    #[must_use]
    pub fn motion(building: usize, floor: usize, direction: Direction) -> [Self; 3] {
        [Kind::Displacement, Kind::Velocity, Kind::Acceleration]
            .map(|kind| Self::new(Owner::Floor { building, floor }, kind, direction))
    }

    /// Force of a contact, or of a face of buildings in space \[N\].
    #[must_use]
    pub const fn contact_force(contact: usize) -> Self {
        Self::along(Owner::Contact(contact), Kind::Force)
    }

    /// Closing of a contact. Histories have it on a column between floors and where grounds move apart; that of other contacts
    /// follows from the displacements of their floors \[m\].
    #[must_use]
    pub const fn closing(contact: usize) -> Self {
        Self::along(Owner::Contact(contact), Kind::Closing)
    }

    /// Compression of a link, negative in tension \[N\].
    #[must_use]
    pub const fn link_force(link: usize) -> Self {
        Self::along(Owner::Link(link), Kind::Force)
    }

    /// Shortening of a link since rest. Histories have it on request, and of links that are not linear between floors, where it
    /// does not follow from displacements of floors \[m\].
    #[must_use]
    pub const fn link_stroke(link: usize) -> Self {
        Self::along(Owner::Link(link), Kind::Stroke)
    }

    /// Its rate, on the same terms \[m/s\].
    #[must_use]
    pub const fn link_speed(link: usize) -> Self {
        Self::along(Owner::Link(link), Kind::Speed)
    }

    /// Force of the bearings of a building, or of the spring and dashpot of a wall, on the ground \[N\].
    #[must_use]
    pub const fn support_force(building: usize) -> Self {
        Self::along(Owner::Support(building), Kind::Force)
    }

    /// Displacement from rest of the ground under a building or a wall, where grounds move apart \[m\].
    #[must_use]
    pub const fn ground_displacement(building: usize) -> Self {
        Self::along(Owner::Ground(building), Kind::Displacement)
    }

    /// A term of the energy balance \[J\].
    #[must_use]
    pub const fn energy(term: EnergyTerm) -> Self {
        Self::along(Owner::Run, Kind::Energy(term))
    }

    /// What it records.
    #[must_use]
    #[rustfmt::skip]
    pub fn recorded(self) -> Recorded {
        use Direction::{Across, Along, Turning, Up};
        let (name, unit, meaning) = match (self.kind, self.direction) {
            (Kind::Time, _) => ("time", Unit::S, "instant"),
            (Kind::Displacement, Along) if matches!(self.owner, Owner::Ground(_)) => ("ground_displacement", Unit::M, "displacement of the ground from rest, with different motion under each building"),
            (Kind::Displacement, Across) if matches!(self.owner, Owner::Ground(_)) => ("ground_displacement_across", Unit::M, "the same across, of buildings with a plan"),
            (Kind::Displacement, Along) => ("displacement", Unit::M, "displacement relative to the ground, positive to the right"),
            (Kind::Displacement, Across) => ("displacement_across", Unit::M, "displacement across the row, relative to the ground, of buildings with a plan"),
            (Kind::Displacement, Turning) => ("rotation", Unit::RAD, "rotation, counter-clockwise seen from above, of buildings with a plan"),
            (Kind::Displacement, Up) => ("vertical_displacement", Unit::M, "vertical displacement of any mass of the floor, relative to the ground"),
            (Kind::Velocity, Across) => ("velocity_across", Unit::M_S, "velocity across the row, relative to the ground"),
            (Kind::Velocity, Turning) => ("rotation_rate", Unit::RAD_S, "rotation rate"),
            (Kind::Velocity, _) => ("velocity", Unit::M_S, "velocity relative to the ground"),
            (Kind::Acceleration, Along) if self.owner == Owner::Run => ("ground_acceleration", Unit::M_S2, "ground acceleration"),
            (Kind::Acceleration, Across) if self.owner == Owner::Run => ("ground_acceleration_across", Unit::M_S2, "ground acceleration across the row, of buildings with a plan"),
            (Kind::Acceleration, Across) => ("total_acceleration_across", Unit::M_S2, "total acceleration across (relative + ground)"),
            (Kind::Acceleration, Turning) => ("rotation_acceleration", Unit::RAD_S2, "rotational acceleration"),
            (Kind::Acceleration, _) => ("total_acceleration", Unit::M_S2, "total acceleration (relative + ground)"),
            (Kind::FilteredAcceleration, _) => ("filtered_acceleration", Unit::M_S2, "acceleration after a low-pass filter"),
            (Kind::CornerDisplacement, _) => ("corner_displacement", Unit::M, "horizontal displacement of a corner"),
            (Kind::Drift, _) => ("storey_drift", Unit::NONE, "drift ratio of the storey below"),
            (Kind::CornerDrift, _) => ("corner_drift", Unit::NONE, "drift ratio of the storey below at a corner of the smaller plan"),
            (Kind::Shear, Turning) => ("torque", Unit::NM, "torque about the centre of mass of the lowest floor"),
            (Kind::Shear, _) => ("shear", Unit::N, "shear of the storey below, or at the base"),
            (Kind::Moment, _) => ("overturning_moment", Unit::NM, "moment about the base of the storey below"),
            (Kind::Force, Across) => ("force_across", Unit::N, "the same across, of buildings with a plan"),
            (Kind::Force, _) => ("force", Unit::N, match self.owner {
                Owner::Contact(_) => "contact force, positive in compression",
                Owner::Link(_) => "force of the link, positive in compression",
                Owner::Support(_) => "force of bearings, stops not included; of a wall, that of its spring and dashpot",
                _ => "force",
            }),
            (Kind::RingForce, _) => ("ring_force", Unit::N, "force of the ring that stops the mat, in any direction"),
            (Kind::Rocking, _) => ("rocking", Unit::RAD, "rocking of a foundation in plan: displacement of floors per height"),
            (Kind::Closing, _) => ("closing", Unit::M, "closing; only of contacts on a column between floors, or with different motion under each building"),
            (Kind::Stroke, _) => ("stroke", Unit::M, "shortening of the link since rest; with `links = true` under `[output]`"),
            (Kind::Speed, _) => ("speed", Unit::M_S, "rate of shortening; with `links = true` under `[output]`"),
            (Kind::Work, _) => ("work", Unit::J, "energy absorbed up to this instant"),
            (Kind::Lifted, _) => ("lifted", Unit::S, "time without force up to this instant"),
            (Kind::Beyond(_), _) => ("beyond", Unit::NONE, "whether a hinge has turned beyond a limit"),
            (Kind::Turned, _) => ("plastic_rotation", Unit::RAD, "plastic rotation of a hinge that yields on a surface"),
            (Kind::Passed(_), _) => ("passed", Unit::NONE, "whether fibres have passed a strain"),
            (Kind::Energy(EnergyTerm::Input), _) => ("input", Unit::J, "work of the ground motion up to this instant"),
            (Kind::Energy(EnergyTerm::Ground), _) => ("ground", Unit::J, "work of the different ground motions through contacts and links, up to this instant"),
            (Kind::Energy(EnergyTerm::Kinetic), _) => ("kinetic", Unit::J, "kinetic energy relative to the ground"),
            (Kind::Energy(EnergyTerm::Strain), _) => ("strain", Unit::J, "strain energy of members, and recoverable energy of hinges"),
            (Kind::Energy(EnergyTerm::Damped), _) => ("damped", Unit::J, "dissipated by viscous damping up to this instant"),
            (Kind::Energy(EnergyTerm::Hysteretic), _) => ("hysteretic", Unit::J, "dissipated by hinges up to this instant"),
            (Kind::Energy(EnergyTerm::Contact), _) => ("contact", Unit::J, "energy of contacts: dissipated up to this instant, and stored"),
            (Kind::Energy(EnergyTerm::Friction), _) => ("friction", Unit::J, "dissipated by friction along faces up to this instant, including energy stored in its springs; only with friction"),
        };
        let owner = match (self.owner, self.kind) {
            (Owner::Run, Kind::Energy(_)) => "energy",
            (owner, _) => owner.name(),
        };
        Recorded { owner, name, unit, meaning }
    }

    /// Index of its building, contact or link, and its floor; zeros where it has none.
    #[must_use]
    pub fn place(self) -> [usize; 2] {
        match self.owner {
            Owner::Run => [0, 0],
            Owner::Floor { building, floor } => [building, floor],
            Owner::Bearing { building, bearing } => [building, bearing],
            Owner::Section { building, section } => [building, section],
            Owner::Building(index)
            | Owner::Support(index)
            | Owner::Foundation(index)
            | Owner::Ground(index)
            | Owner::Contact(index)
            | Owner::Gap(index)
            | Owner::Link(index)
            | Owner::Spring(index) => [index, 0],
        }
    }
}

impl Owner {
    /// Its kind, in one word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Building(_) => "building",
            Self::Floor { .. } => "floor",
            Self::Support(_) => "isolation",
            Self::Bearing { .. } => "bearing",
            Self::Section { .. } => "section",
            Self::Foundation(_) => "foundation",
            Self::Ground(_) => "ground",
            Self::Contact(_) => "contact",
            Self::Gap(_) => "gap",
            Self::Link(_) => "link",
            Self::Spring(_) => "spring",
        }
    }

    /// The building or wall to which it belongs; `None` if it stands between several.
    #[must_use]
    pub const fn building(self) -> Option<usize> {
        match self {
            Self::Building(building)
            | Self::Floor { building, .. }
            | Self::Support(building)
            | Self::Bearing { building, .. }
            | Self::Section { building, .. }
            | Self::Foundation(building)
            | Self::Ground(building) => Some(building),
            Self::Run | Self::Contact(_) | Self::Gap(_) | Self::Link(_) | Self::Spring(_) => None,
        }
    }
}

/// Terms of the energy balance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EnergyTerm {
    /// Work of the inertia forces of the ground motion.
    Input,
    /// Work of grounds that move apart, through contacts and links; recorded only with them.
    Ground,
    /// Kinetic energy relative to the ground.
    Kinetic,
    /// Strain energy of members, and recoverable energy of yielding springs.
    Strain,
    /// Dissipated by viscous damping.
    Damped,
    /// Dissipated by springs that yield.
    Hysteretic,
    /// Energy of contacts: dissipated plus, during an impact, stored.
    Contact,
    /// Dissipated by friction along faces; recorded only with friction.
    Friction,
}

impl EnergyTerm {
    /// The terms of every run, in the order of the balance.
    pub const ALL: [Self; 6] = [
        Self::Input,
        Self::Kinetic,
        Self::Strain,
        Self::Damped,
        Self::Hysteretic,
        Self::Contact,
    ];
}
