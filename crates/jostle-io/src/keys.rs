//! Every key of a model file, once: the reader, the misspelling hints and the JSON Schema all use this table.

use jostle::Solver;
use jostle::contact::{LawKind, ModifiedKelvin, RestitutionIs};
use jostle::hysteresis::HysteresisRule;
use jostle::separation::{Code, HazardZone, JointSystem, MotionLevel};
use jostle_motion::GoverningRule;
use jostle_section::BucklingCurve;

use crate::baseline::Baseline;
use crate::choices::{DesignKind, FragilityMethod, IntegratorMethod, Sampling, names};
use crate::quantity::Dimension;
use crate::record::{GREATEST_ACCELERATION, RecordContent, RecordFormat};
use crate::unusual::{GAP, PEAK_ACCELERATION, Range, Usual};

/// The table of the file that contains a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Section {
    Root,
    Motion,
    /// Further keys of `[building.motion]`.
    OwnMotion,
    /// Lines of the file of a record.
    Read,
    Coherency,
    Match,
    Spectrum,
    /// Keys of every building.
    Building,
    /// Further keys of `kind = "frame"`.
    Frame,
    /// Further keys of `kind = "shear"`.
    Shear,
    /// Plan of a floor.
    FloorPlan,
    /// Stiffness of a storey with a plan, or of an element.
    PlanStiffness,
    /// Column or wall at a point of a plan.
    Element,
    /// Plane frame at a line of a plan.
    PlanFrame,
    /// Bays of a plane frame.
    FrameBay,
    /// Joints between which a brace of a frame stands.
    BraceEnds,
    /// Bays of a grid.
    GridBay,
    /// Diagonals of the bays of a frame.
    Brace,
    /// Panels of masonry in them.
    Infill,
    /// Strengths of its masonry.
    InfillStrength,
    InfillOutOfPlane,
    /// Curve of first loading of its struts.
    InfillBackbone,
    /// Openings in it.
    InfillOpening,
    /// Walls at column lines of a frame.
    FrameWall,
    /// Yielding at the foot of a wall.
    WallHinge,
    /// Where a wall yields, and its fibres.
    WallEnds,
    /// Bars of a wall with edges.
    WallBars,
    /// Beams between walls.
    CouplingBeam,
    /// Stiffness of shear that yields.
    Sliding,
    /// Further keys of `kind = "space-frame"`.
    SpaceFrame,
    /// Walls of it.
    SpaceWall,
    /// Fibres at the foot of such a wall.
    SpaceWallHinge,
    /// Columns of it at some places.
    SpaceColumn,
    /// Beams of it at some places.
    SpaceBeam,
    /// Further keys of `kind = "given"`.
    Given,
    /// Files of its matrices.
    Matrices,
    /// A floor of it.
    Port,
    /// Cross-section of a column.
    Column,
    /// A steel profile by its sizes.
    Profile,
    /// A slab as flange of a beam.
    Slab,
    /// Cross-section of a beam.
    Beam,
    StiffnessFactor,
    Axial,
    ShearDeformation,
    Joint,
    /// Connections of the beams of a space frame.
    BeamJoint,
    /// The same, by direction.
    SpaceJoint,
    RigidEnds,
    FibreSteel,
    /// Strains at which fibres fail.
    FibreLimits,
    /// Axial forces and moments that a section bears.
    HingeSurface,
    /// The same of columns of space frames.
    SpaceSurface,
    /// Springs and dashpots under any building.
    ShearBase,
    /// Further ones under the columns of a frame.
    FrameBase,
    /// Further ones under a building with a plan.
    PlanBase,
    /// Those across.
    AcrossBase,
    /// Rigid foundation under a building.
    Foundation,
    /// Bearings and mat under a building.
    Isolation,
    /// Friction of bearings that changes with speed.
    IsolationFriction,
    /// Range of the properties of bearings.
    IsolationBounds,
    /// Factors on their stiffness and strength.
    BearingFactors,
    /// Stops of a mat.
    IsolationStop,
    /// The stop of one side.
    StopSide,
    Integrator,
    Damping,
    /// Columns of a frame that fail in shear.
    ShearFailure,
    RotationLimit,
    RotationLevels,
    /// Hinges of a frame.
    Hinges,
    /// Hinges of columns or of beams.
    Hinge,
    /// One side of them.
    HingeSide,
    /// Hinges of a space frame.
    SpaceHinges,
    /// Hinges of its columns.
    ColumnHinge,
    /// Yielding of the rotational spring of a base.
    BaseRocking,
    /// Yielding of its horizontal spring.
    BaseSliding,
    /// Inelastic storeys of a shear building.
    StoreyHinges,
    /// Those of one direction in plan.
    StoreyHingesOfAxis,
    /// Where pinched springs stiffen.
    Pinching,
    /// Growth of their peaks.
    Damage,
    /// Reinforcement in rows.
    Bars,
    Gap,
    /// How the faces of a gap crush.
    Crush,
    Link,
    /// Soil beside floors of a building.
    SoilSpring,
    /// A link inside one building.
    Damper,
    /// What links and dampers share.
    LinkLaw,
    /// A wall that gaps and links can name.
    Wall,
    /// Yielding of a link.
    LinkHinge,
    /// Further keys of it for braces that buckle.
    Buckling,
    /// Soil under foundations.
    Soil,
    /// Springs and dashpots of all foundations.
    SoilCoupling,
    Analysis,
    /// What results should hold beyond the usual.
    Output,
    /// Which floor response spectra.
    FloorSpectra,
    /// What reports show.
    Report,
    /// The site in plan.
    Site,
    /// Inputs of the separation rules of codes.
    Codes,
    /// Those of one building.
    BuildingCodes,
    /// A study file.
    Study,
    /// One thing that varies in a study.
    Vary,
    Range,
    Distribution,
    Design,
    Correlation,
    Fragility,
    Ida,
    Sensitivity,
    /// The code by which the records of a study are checked.
    Selection,
    /// A map of a comparison with measurements.
    Comparison,
    /// A measured history in it.
    ComparedColumn,
    /// Measured impacts in it.
    ComparedImpacts,
    /// A city file.
    City,
    /// Its footprints.
    CityInventory,
    /// Names of their columns.
    CityColumns,
    /// What is assumed of its buildings.
    CityBuildings,
    /// First years of its design levels.
    CityLevels,
    /// A table of types in place of that of HAZUS.
    TypesTable,
    /// A table of the drifts at which damage begins.
    TypesDamage,
    /// How its gaps are drawn.
    CityGap,
    /// How its buildings hit each other.
    CityContact,
    /// How much is run.
    CityRun,
    /// Motions that differ from place to place.
    CityMotion,
    /// A classes file.
    Classes,
    /// Its classes, or their neighbours.
    ClassesSide,
    /// How they stand side by side.
    ClassesPair,
    /// How strong its motions are.
    ClassesIntensity,
    /// How much of it is run.
    ClassesRun,
}

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Text,
    /// A text, or a list of them.
    TextOrTexts,
    /// A list of texts.
    Texts,
    /// A name, or a number from 1.
    Component,
    /// A whole number, not negative.
    Count,
    /// A list of whole numbers.
    Counts,
    Flag,
    /// True or false, or a list of texts.
    FlagOrTexts,
    /// True or false, a list of texts, or a table.
    FlagTextsOrTable(Section),
    /// One value, or a list of them.
    OneOrMore(Dimension),
    /// True or false, one of these, or a list of them.
    FlagOrChoices(&'static [&'static str]),
    Quantity(Dimension),
    /// One value, or a list from the ground up.
    PerStorey(Dimension),
    /// A list of values.
    Quantities(Dimension),
    /// Stiffness of a contact: its unit depends on the law.
    ContactStiffness,
    /// Coefficient of a dashpot: its unit depends on the exponent.
    LinkDamping,
    /// One count, or one per span.
    CountPerSpan,
    /// One or two mode numbers.
    Modes,
    Choice(&'static [&'static str]),
    /// A word in place of a value.
    WordOr(&'static str, Dimension),
    /// One of these words, or a quantity.
    ChoiceOr(&'static [&'static str], Dimension),
    /// A word for the default, or a table.
    WordOrTable(&'static str, &'static [Section]),
    /// A word for all, or a table.
    ChoiceOrTable(&'static [&'static str], Section),
    NumberOrTable(Section),
    /// The same, or a list of numbers.
    NumbersOrTable(Section),
    Table(Section),
    /// A table with the keys of several.
    TableOf(&'static [Section]),
    /// One table, or a list of tables from the ground up.
    TablePerStorey(Section),
    /// One table for all places, or a list of tables for some.
    TablePerPlace(Section),
    /// A number, or the first and the last.
    FromTo,
    /// A whole number, or two.
    OneOrTwo,
    /// A text, or a table instead.
    TextOrTable(Section),
    /// A word, or the number it spells.
    Word(&'static [&'static str]),
    /// A list of tables, `[[…]]`.
    Tables(&'static [Section]),
    /// Names of the two neighbours of a gap.
    Neighbours,
    /// `"common"`, `"all"`, pairs of points, or heights.
    FloorPairs,
    /// One value, or one per contact.
    PerContact(Dimension),
    /// A grade, or a strength.
    GradeOr(&'static [&'static str]),
    /// A grade of concrete, or a cylinder strength f'c.
    Concrete(&'static [&'static str]),
    /// The same, or a prismatic strength.
    ConcreteOr(&'static [&'static str]),
    /// A table of tables with names of their own.
    Named(Section),
    /// A list of lists of numbers.
    NumberLists,
    /// A record, or a table like `[motion]`.
    TextOrMotion,
    /// Width and depth, corners, or a list of plans.
    Plan,
    /// Two lengths, or a list of pairs from the ground up.
    PlanPoints,
    /// A stiffness, or a table of those along x, across and in torsion; or a list from the ground up.
    PlanStiffness,
    /// The name of a file, or its numbers.
    TextOrNumbers,
    /// Any value that the varied key of the model file accepts.
    Any,
}

impl Kind {
    /// The dimension of a quantity, where it has one; of some quantities it depends on other keys.
    pub(crate) fn dimension(self) -> Option<Dimension> {
        match self {
            Self::Quantity(dimension)
            | Self::PerStorey(dimension)
            | Self::Quantities(dimension)
            | Self::OneOrMore(dimension)
            | Self::WordOr(_, dimension)
            | Self::ChoiceOr(_, dimension)
            | Self::PerContact(dimension) => Some(dimension),
            Self::ContactStiffness => Some(Dimension::HertzStiffness),
            Self::LinkDamping => Some(Dimension::Damping),
            Self::NumberOrTable(_) | Self::NumbersOrTable(_) => Some(Dimension::Dimensionless),
            Self::Plan | Self::PlanPoints => Some(Dimension::Length),
            Self::PlanStiffness => Some(Dimension::Stiffness),
            Self::GradeOr(_) | Self::Concrete(_) | Self::ConcreteOr(_) => Some(Dimension::Modulus),
            _ => None,
        }
    }

    /// Whether values are quantities, or hold some that no table inside has a key for.
    #[cfg(test)]
    pub(crate) fn is_quantity(self) -> bool {
        let of_many_units = matches!(
            self,
            Self::NumberLists | Self::TextOrNumbers | Self::FloorPairs
        );
        of_many_units || self.dimension().is_some()
    }
}

/// One key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    pub(crate) section: Section,
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// Value if the key is absent; `None` for keys without a default.
    pub(crate) default: Option<&'static str>,
    pub(crate) required: bool,
    /// Description, one line.
    pub(crate) doc: &'static str,
    /// What values are usual.
    pub(crate) usual: Usual,
}

impl Key {
    /// Says which values of a quantity are usual, in SI.
    const fn usual(self, noun: &'static str, low: f64, high: f64) -> Self {
        self.range(Range::new(noun, low, high))
    }

    const fn range(self, range: Range) -> Self {
        Self {
            usual: Usual::Within(range),
            ..self
        }
    }

    /// Says which values only a wrong unit can explain: those outside.
    const fn possible(self, low: f64, high: f64) -> Self {
        match self.usual {
            Usual::Within(range) => self.range(range.possible(low, high)),
            _ => self,
        }
    }

    /// Says that negative values mean something.
    const fn signed(self) -> Self {
        match self.usual {
            Usual::Within(range) => self.range(Range {
                signed: true,
                ..range
            }),
            _ => self,
        }
    }

    /// Says why no value of a quantity is unusual.
    const fn any(self, why: &'static str) -> Self {
        Self {
            usual: Usual::Any(why),
            ..self
        }
    }
}

pub(crate) const DESIGNS: &[&str] = names!(DesignKind);
pub(crate) const SAMPLINGS: &[&str] = names!(Sampling);
pub(crate) const DISTRIBUTIONS: &[&str] = &["uniform", "normal", "lognormal"];
pub(crate) const SPACINGS: &[&str] = &["linear", "log"];
pub(crate) const FRAGILITY_METHODS: &[&str] = names!(FragilityMethod);
pub(crate) const BUILDING_KINDS: &[&str] = &["frame", "shear", "space-frame", "given"];
/// Units of force and length of given matrices.
pub(crate) const MATRIX_UNITS: &[&str] =
    &["N, m", "kN, m", "N, mm", "kN, mm", "kip, ft", "kip, in"];
/// Spellings of the contact laws.
pub const LAW_NAMES: [&str; LawKind::NAMES.len()] = LawKind::NAMES;
/// The same, and a formula of the user.
pub(crate) const LAWS: &[&str] = &joined::<{ LAW_NAMES.len() + 1 }>(&[&LAW_NAMES, &["formula"]]);
/// Spellings of the laws of links.
pub(crate) const LINK_LAWS: &[&str] = &jostle::LinkLaw::NAMES;
pub(crate) const LAW_VARIANTS: &[&str] = names!(ModifiedKelvin);
pub(crate) const SOLVERS: &[&str] = &[
    "auto",
    Solver::ALL[0].name(),
    Solver::ALL[1].name(),
    Solver::ALL[2].name(),
    Solver::ALL[3].name(),
    Solver::ALL[4].name(),
];
pub(crate) const INTEGRATORS: &[&str] = names!(IntegratorMethod);
pub(crate) const AXIAL: &[&str] = &["rigid", "flexible"];
/// Rules for the stiffness of cracked walls.
pub(crate) const WALL_STIFFNESS: &[&str] = &["asce41-23", "en1998"];
pub(crate) const RESTITUTION_IS: &[&str] = names!(RestitutionIs);
pub(crate) const RULES: &[&str] = names!(HysteresisRule);
/// Rules of links and braces; of these, braces alone buckle.
pub(crate) const LINK_RULES: &[&str] = &joined::<8>(&[RULES, &["buckling"]]);
/// Curves of buckling forces.
pub(crate) const BUCKLING_CURVES: &[&str] = &BucklingCurve::NAMES;
/// Where shear springs of columns stand.
pub(crate) const SHEAR_ENDS: &[&str] = &["foot", "both"];
/// Members whose rotations have limits, and which rotations.
pub(crate) const LIMITED_MEMBERS: &[&str] = &["columns", "beams"];
pub(crate) const ROTATION_MEASURES: &[&str] = &["plastic", "chord"];
/// Where walls yield.
pub(crate) const WALL_HINGES: &[&str] = &["foot", "all"];
/// Rules of hinges of walls of space frames with a rule of their own.
pub(crate) const WALL_RULES_IN_SPACE: &[&str] = &["fibre"];
/// Columns whose axial failure comes before shear failure.
pub(crate) const AXIAL_FIRST: &[&str] = &["refuse", "axial-limit"];
/// Rules of hinges of frames: fibres are several springs.
pub(crate) const HINGE_RULES: &[&str] = &joined::<8>(&[RULES, &["fibre"]]);
/// Those of columns of plane frames, whose ends may yield on a surface as well.
pub(crate) const FRAME_HINGE_RULES: &[&str] = &joined::<9>(&[HINGE_RULES, &["surface"]]);
/// Where fibres stand: at both ends of all columns, or at their feet on the ground.
pub(crate) const FIBRE_ENDS: &[&str] = &["both", "base"];
/// How bars of fibres go through loops.
pub(crate) const FIBRE_STEELS: &[&str] = &["bilinear", "menegotto-pinto"];
pub(crate) const HINGE_SOURCES: &[&str] = &["section"];
pub(crate) const HINGE_METHODS: &[&str] = &["formula", "fibre"];
pub(crate) const WAVES: &[&str] = &["sine", "ricker"];
/// Design levels of classes.
pub(crate) const LEVELS: [&str; 4] = ["high", "moderate", "low", "pre"];
/// How the floors of neighbours lie.
pub(crate) const ALIGNMENTS: [&str; 2] = ["floors", "half-storey"];
/// Where a class stands in its row.
pub(crate) const POSITIONS: [&str; 2] = ["end", "middle"];
/// Measures of the intensity of motions.
pub(crate) const MEASURES: [&str; 3] = ["PGA", "Sa(T1)", "AvgSA"];
/// Systems of units for texts and pages.
pub(crate) const UNIT_SYSTEMS: &[&str] = &["si", "us"];
/// Rules for the capacity of columns and beams, in the order of
/// [`CapacityRule::ALL`](jostle_section::capacity::CapacityRule::ALL).
pub(crate) const CAPACITY_RULES: &[&str] = &[
    "gb50010",
    "en1998-3",
    "asce41",
    "aci318",
    "sezen-moehle",
    "aisc360",
];
/// Those of reinforced concrete, in the order of [`ShearRule::ALL`](jostle_section::capacity::ShearRule::ALL).
pub(crate) const SHEAR_RULES: &[&str] = CAPACITY_RULES.split_at(5).0;

/// Grades of reinforced sections.
pub(crate) const SECTION_CONCRETES: &[&str] = &joined::<23>(&[
    &jostle_section::CONCRETE_GRADES,
    &jostle_section::EN_CONCRETE_GRADES,
]);
pub(crate) const STEELS: &[&str] = &joined::<25>(&[
    &jostle_section::STEEL_GRADES,
    &jostle_section::EN_STEEL_GRADES,
    &jostle_section::ASTM_STEEL_GRADES,
]);
pub(crate) const STRENGTHS: &[&str] = &jostle_section::StrengthLevel::NAMES;
pub(crate) const RECORD_FORMATS: &[&str] = names!(RecordFormat, key);
pub(crate) const RECORD_CONTENTS: &[&str] = names!(RecordContent, key);
/// Grades whose modulus is known.
pub(crate) const CONCRETES: &[&str] = &joined::<27>(&[
    &[
        "C20", "C25", "C30", "C35", "C40", "C45", "C50", "C55", "C60", "C65", "C70", "C75", "C80",
    ],
    &jostle_section::EN_CONCRETE_GRADES,
]);
/// Codes whose separation rules are known.
pub(crate) const JOINT_CODES: &[&str] = names!(Code);
pub(crate) const JOINT_SYSTEMS: &[&str] = names!(JointSystem);
pub(crate) const MOTION_LEVELS: &[&str] = &MotionLevel::NAMES;
pub(crate) const HAZARD_ZONES: &[&str] = &HazardZone::NAMES;
pub(crate) const FLOOR_LEVELS: &[&str] = &["auto", "equal", "different"];

/// Lists of words one after the other; they must have `N` words together.
const fn joined<const N: usize>(lists: &[&[&'static str]]) -> [&'static str; N] {
    let mut words = [""; N];
    let (mut next, mut list) = (0, 0);
    while list < lists.len() {
        let mut word = 0;
        while word < lists[list].len() {
            words[next] = lists[list][word];
            next += 1;
            word += 1;
        }
        list += 1;
    }
    assert!(next == N, "the count of words is wrong");
    words
}

const fn required(section: Section, name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        section,
        name,
        kind,
        default: None,
        required: true,
        doc,
        usual: Usual::NoQuantity,
    }
}

const fn optional(section: Section, name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        section,
        name,
        kind,
        default: None,
        required: false,
        doc,
        usual: Usual::NoQuantity,
    }
}

const fn default(
    section: Section,
    name: &'static str,
    kind: Kind,
    default: &'static str,
    doc: &'static str,
) -> Key {
    Key {
        section,
        name,
        kind,
        default: Some(default),
        required: false,
        doc,
        usual: Usual::NoQuantity,
    }
}

/// How foundations act on each other.
pub(crate) const SOIL_COUPLINGS: &[&str] = &["none", "static"];
/// Ways in which a brace rises, from left to right.
pub(crate) const DIRECTIONS: &[&str] = &["up", "down", "both"];
/// Directions of the lines of a grid.
pub(crate) const AXES_OF_PLAN: &[&str] = &["x", "y"];
/// Axes of a profile.
pub(crate) const AXES: &[&str] = &["strong", "weak"];

/// Rules for the effective width of a slab.
pub(crate) const FLANGE_WIDTHS: &[&str] = &["en1992", "aci318"];

/// Rules for the width of a strut of a panel.
pub(crate) const STRUT_WIDTHS: &[&str] = &["mainstone", "bertoldi", "paulay-priestley", "holmes"];

/// Rules for the strength of a panel.
pub(crate) const PANEL_STRENGTHS: &[&str] = &["bertoldi", "sliding"];

/// Rules for what a panel bears across its plane.
pub(crate) const ARCHINGS: &[&str] = &["asce41", "en1996"];

/// Rules for its curve of first loading.
pub(crate) const PANEL_CURVES: &[&str] = &["bertoldi", "panagiotakos-fardis"];

/// Kinds of bearings.
pub(crate) const ISOLATORS: &[&str] = &[
    "linear",
    "lead-rubber",
    "high-damping-rubber",
    "friction-pendulum",
    "double-friction-pendulum",
    "triple-friction-pendulum",
];

use Dimension as D;
use Kind::{
    Choice, ChoiceOrTable, Component, ContactStiffness, Count, CountPerSpan, Counts, Flag,
    FlagOrChoices, FlagOrTexts, FloorPairs, GradeOr, LinkDamping, Modes, Neighbours, NumberOrTable,
    OneOrMore, PerContact, PerStorey, Quantities, Quantity, TablePerStorey, Tables, Text,
    TextOrTable, TextOrTexts, WordOr, WordOrTable,
};
use Section as S;

/// The keys, in the order in which a file is best written.
#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    default(S::Root, "title", Text, "\"Untitled\"", "Title of summaries and reports."),
    optional(S::Root, "motion", Kind::Table(S::Motion), "The ground motion."),
    required(S::Root, "building", Tables(&[S::Building, S::Frame, S::Shear, S::SpaceFrame, S::Given]), "The buildings, from left to right."),
    optional(S::Root, "gap", Tables(&[S::Gap]), "The gaps between neighbours, and between the end buildings of the row and walls."),
    optional(S::Root, "link", Tables(&[S::Link, S::LinkLaw]), "Springs, dampers and sliders that join neighbours, or floors of one building."),
    optional(S::Root, "wall", Tables(&[S::Wall]), "Walls beside a building, to which gaps and links can refer."),
    optional(S::Root, "soil", Kind::Table(S::Soil), "Soil under buildings with a foundation."),
    optional(S::Root, "site", Kind::Table(S::Site), "The site in plan."),
    optional(S::Root, "analysis", Kind::Table(S::Analysis), "Steps, accuracy and solver."),
    optional(S::Root, "output", Kind::Table(S::Output), "Optional results."),
    optional(S::Root, "codes", Kind::Table(S::Codes), "Inputs of the separation rules of codes."),
    optional(S::Root, "report", Kind::Table(S::Report), "Contents of reports."),

    optional(S::Motion, "record", TextOrTexts, "A built-in record, or a file with a path relative to this file: PEER AT2, CSV or columns of text, COSMOS, CSMIP, K-NET, ESM, SMC, GeoNet, AFAD, CWA, NEES asc, miniSEED, SAC, SimCenter JSON. If it is a list, run, study and gap use all its records; the other keys apply to each."),
    optional(S::Motion, "kind", Choice(WAVES), "An analytic motion instead of a record."),
    optional(S::Motion, "amplitude", Quantity(D::Acceleration), "Amplitude of the analytic motion.").usual("an amplitude", 0.01, 50.0).possible(0.0, GREATEST_ACCELERATION).signed(),
    optional(S::Motion, "period", Quantity(D::Time), "Period of the analytic motion.").usual("a period", 0.02, 20.0),
    default(S::Motion, "centre", Quantity(D::Time), "1.5 periods", "Time at which the Ricker pulse peaks.").usual("a time", 0.01, 600.0),
    optional(S::Motion, "pga", Quantity(D::Acceleration), "Scale the motion to this peak acceleration.").range(PEAK_ACCELERATION),
    default(S::Motion, "scale", OneOrMore(D::Dimensionless), "1", "Multiply the motion by this factor, not 0. A list gives one factor per record; it also applies to the other components of that record.").usual("a motion factor", 1e-3, 1e3).signed(),
    optional(S::Motion, "match", Kind::Table(S::Match), "Scale the motion so that its response spectrum matches another."),
    default(S::Motion, "governing", Choice(&GoverningRule::NAMES), "the code of match, else \"maximum\"", "Rule for the governing value of several records: gb50011, en1998 and asce7 use the mean or the maximum, depending on the number of records."),
    default(S::Motion, "reverse", Flag, "false", "Change the sign of the motion."),
    default(S::Motion, "angle", Quantity(D::Dimensionless), "0", "For buildings with a plan: angle from x to the direction of the motion, counter-clockwise, such as \"30 deg\".").usual("an angle", 1e-4, 6.3).signed(),
    optional(S::Motion, "across", Kind::TextOrMotion, "For buildings with a plan: the motion at a right angle to this one, counter-clockwise from it: a record, a list with one for every entry of record, or a table like [motion]. If it has no amplitude or scaling, it is scaled by the factor of this motion."),
    default(S::Motion, "duration", Quantity(D::Time), "the whole record", "Length of the analysis: cuts the record, or continues with the ground at rest.").usual("a duration", 0.01, 3600.0),
    optional(S::Motion, "unit", Text, "Unit of the values of a record that does not state it, such as \"g\"; in AT2 files and columns of text it overrides the file."),
    optional(S::Motion, "step", Quantity(D::Time), "Time step of a record that does not state it; it overrides that of an AT2 file.").usual("a record time step", 1e-5, 1.0),
    optional(S::Motion, "column", Count, "Column of a text record that holds the acceleration, counted from 1."),
    optional(S::Motion, "component", Component, "Channel of a file that has several: its name in the file, \"H1\", \"H2\", \"up\", \"N-S\", an azimuth such as \"090\", or a number from 1."),
    default(S::Motion, "record_scale", Quantity(D::Dimensionless), "1", "Value of one count of the file in unit: 1/sensitivity.").any("depends on the instrument"),
    optional(S::Motion, "remove_mean", Flag, "Remove the mean of the record; required for counts with an instrument offset."),
    optional(S::Motion, "format", Choice(RECORD_FORMATS), "Format of the file, if auto-detection is wrong."),
    optional(S::Motion, "read", Kind::Table(S::Read), "Layout of the lines of a text record, such as `{ skip = 2, per_line = 8 }`."),
    optional(S::Read, "skip", Count, "Number of lines at the top to skip; the next line contains data or column names."),
    optional(S::Read, "last", Count, "Last line to read, counted from 1."),
    optional(S::Read, "per_line", Count, "Number of values on every line except the last, for values that continue from line to line."),
    optional(S::Read, "content", Choice(RECORD_CONTENTS), "values: accelerations that continue from line to line. pairs: pairs of time and acceleration that continue likewise. columns: one instant per line. Default with per_line: values."),
    optional(S::Read, "widths", Counts, "Widths of numbers without separators: one width for all, or one for every number of a line."),

    optional(S::Motion, "vertical", Kind::TextOrMotion, "Vertical shaking of plane frames, and with gravity = true also of space frames and frames at lines of a plan, positive upwards: a record, a list with one for every entry of record, or a table like [motion], such as `{ scale = 0.67 }` for that fraction of this motion. If it has no amplitude or scaling, it is scaled by the factor of this motion."),
    optional(S::Motion, "apparent_velocity", Quantity(D::Speed), "Apparent wave velocity along the row: the motion arrives at a building after the time position ÷ apparent_velocity.").usual("an apparent velocity", 50.0, 1e5),
    default(S::Motion, "wave_angle", Quantity(D::Dimensionless), "0", "For buildings with a plan: angle from x to the direction of wave travel, counter-clockwise, such as \"30 deg\". Positions follow from the plans.").usual("an angle", 1e-4, 6.3).signed(),
    optional(S::Motion, "baseline", Choice(&Baseline::NAMES), "Baseline correction: subtracts a straight line or a parabola from the velocity, starting from rest; or none. Required if buildings have different records whose final velocities differ."),
    optional(S::Motion, "coherency", Kind::Table(S::Coherency), "Loss of coherency with distance from position 0, where the record was taken."),
    required(S::Coherency, "alpha", Quantity(D::Dimensionless), "α of |γ| = exp(−(α ω d/V_s)²) (Luco and Wong 1986).").usual("a coherency parameter", 1e-3, 10.0),
    required(S::Coherency, "shear_wave_velocity", Quantity(D::Speed), "V_s of the ground.").usual("a shear wave velocity", 50.0, 3000.0).possible(1.0, 10e3),
    required(S::Coherency, "seed", Count, "Seed of the random part; the same seed gives the same motions."),
    optional(S::OwnMotion, "arrival", Quantity(D::Time), "Time at which the motion arrives at this building; until then its ground is at rest. Use it instead of position.").usual("an arrival time", 1e-4, 1e3),

    optional(S::Match, "spectrum", TextOrTable(S::Spectrum), "The design spectrum to match: a table, or a file of periods and accelerations."),
    optional(S::Match, "value", Quantity(D::Acceleration), "A pseudo-acceleration to match, instead of a spectrum.").usual("a spectral acceleration", 0.01, 100.0),
    optional(S::Match, "at", Quantity(D::Time), "The period at which to match.").usual("a period", 0.005, 20.0),
    optional(S::Match, "periods", Quantities(D::Time), "First and last period of the range over which to match on average, instead of one period.").usual("a period", 0.005, 20.0),
    default(S::Match, "damping", Quantity(D::Dimensionless), "0.05", "Damping ratio of both spectra.").usual("a damping ratio", 1e-4, 1.0),
    required(S::Spectrum, "code", Choice(crate::target::TARGET_CODES), "Code of the design spectrum."),
    optional(S::Spectrum, "intensity", Kind::Word(&["6", "7", "7.5", "8", "8.5", "9"]), "GB 50011: fortification intensity; 7.5 means 7 with 0.15 g, 8.5 means 8 with 0.30 g."),
    optional(S::Spectrum, "site", Kind::Word(&["I0", "I1", "II", "III", "IV"]), "GB 50011: site class."),
    optional(S::Spectrum, "group", Kind::Word(&["1", "2", "3"]), "GB 50011: design earthquake group."),
    default(S::Spectrum, "level", Kind::Word(&["frequent", "fortification", "rare"]), "\"frequent\"", "GB 50011: earthquake level."),
    default(S::Spectrum, "type", Kind::Word(&["1", "2"]), "1", "EN 1998-1: spectrum type."),
    optional(S::Spectrum, "ground", Kind::Word(&["A", "B", "C", "D", "E"]), "EN 1998-1: ground type."),
    optional(S::Spectrum, "ag", Quantity(D::Acceleration), "EN 1998-1: design ground acceleration on ground type A, including the importance factor.").usual("a design acceleration", 0.01, 50.0),
    optional(S::Spectrum, "sds", Quantity(D::Acceleration), "ASCE 7: design acceleration at short periods.").usual("a design acceleration", 0.01, 50.0),
    optional(S::Spectrum, "sd1", Quantity(D::Acceleration), "ASCE 7: design acceleration at 1 s.").usual("a design acceleration", 0.01, 50.0),
    default(S::Spectrum, "tl", Quantity(D::Time), "\"8 s\"", "ASCE 7: long-period transition period.").usual("a period", 0.5, 30.0),
    default(S::Spectrum, "factor", Quantity(D::Dimensionless), "1", "Factor on the spectrum.").usual("a spectrum factor", 1e-3, 1e3),

    default(S::Building, "name", Text, "\"B1\", \"B2\", …", "Name of the building, used by gaps and links."),
    default(S::Building, "kind", Choice(BUILDING_KINDS), "\"frame\"", "Plane frame of beams and columns, shear building with storey springs, space frame of columns and beams, or matrices from another program."),
    optional(S::Building, "storeys", Count, "Number of storeys; not needed if a key has a list with one value per storey."),
    optional(S::Building, "floors", Count, "Another name for storeys."),
    optional(S::Building, "storey_height", PerStorey(D::Length), "Storey height; required for frames, 3 m by default for shear buildings.").usual("a storey height", 1.5, 30.0).possible(0.01, 1000.0),
    default(S::Building, "elevation", Quantity(D::Length), "0", "Height of the base above a datum common to all buildings. Heights of contacts and links are measured from this datum, and decide which floors and columns of neighbours face each other. Heights within a building are measured from its base.").usual("an elevation", 1e-3, 200.0).possible(0.0, 2000.0).signed(),
    default(S::Building, "damping", Kind::Table(S::Damping), "5 % in lateral modes 1 and 3", "Viscous damping, such as `{ ratio = 0.05, modes = [1, 3] }` or `{ alpha = 0.5, beta = \"1 ms\" }`. With hinges, 3 % or less is usual because they dissipate energy as well."),
    optional(S::Building, "soil_spring", Tables(&[S::SoilSpring]), "Soil beside floors below ground, for plane buildings on a fixed base. Each spring is a link between such a floor and the base; results list it after the dampers."),
    optional(S::Building, "damper", Tables(&[S::Damper, S::LinkLaw]), "Dampers and other links between two floors of this building; a short form of link. Results list them after the links."),
    optional(S::Building, "position", Quantity(D::Length), "Position along the row, for apparent_velocity and coherency of [motion]. By default, buildings with a plan use the position of the centre of their plan.").usual("a position along the row", 1e-3, 1e5).signed(),
    optional(S::Building, "motion", Kind::TableOf(&[S::OwnMotion, S::Motion]), "The ground motion under this building, if it differs: an arrival time, a separate motion, or a scale of the common one. If it has no amplitude or scaling, it is scaled by the factor of the common motion."),
    default(S::Building, "gravity", Flag, "false", "Start the run from the displacements under self weight. With a plan, the columns carry the masses of the floors in equal shares, and these masses then also move vertically."),
    optional(S::Building, "codes", Kind::Table(S::BuildingCodes), "Factors of this building for the separation rules of codes, such as `{ behaviour_factor = 3.9 }`."),
    optional(S::Building, "rotation_limit", Tables(&[S::RotationLimit]), "Hinge rotations at which members reach performance levels. If several tables include a member, the last one applies."),
    default(S::Building, "p_delta", Flag, "true with hinges, joint.hinge or shear_failure, and with a plan in which a part yields; otherwise false", "Include P-Delta from the weight above."),

    default(S::Frame, "base", WordOrTable("fixed", &[S::ShearBase, S::FrameBase]), "\"fixed\"", "Springs and dashpots under every column."),
    optional(S::Frame, "isolation", Kind::Table(S::Isolation), "Bearings and a base mat under the building, instead of base."),
    optional(S::Frame, "foundation", Kind::Table(S::Foundation), "Rigid foundation on [soil], instead of base."),
    required(S::Frame, "spans", Quantities(D::Length), "Widths of the bays from left to right; [] means a single column line, such as a stick model.").usual("a span", 0.5, 60.0).possible(0.01, 1000.0),
    optional(S::Frame, "column", TablePerStorey(S::Column), "Column section, needed unless every line is a wall: one for all, a list from the ground up, or [[building.column]] tables with line, storeys or omit; later tables override earlier ones."),
    optional(S::Frame, "beam", TablePerStorey(S::Beam), "Beam section, needed unless coupling beams cross every bay: one for all, a list from the ground up, or [[building.beam]] tables with bay, floors or omit; later tables override earlier ones. A floor has beams from its first to its last column, which are continuous over lines without a column."),
    optional(S::Frame, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity of columns and beams.").usual("a modulus of elasticity", 1e9, 1e12).possible(1e6, 1e14),
    optional(S::Frame, "concrete", Kind::Concrete(CONCRETES), "Concrete instead of elastic_modulus: a grade of GB 50010 (C30) or EN 1992-1-1 (C30/37), or the cylinder strength of ACI 318 (f'c = 4 ksi).").usual("a concrete strength", 1e6, 2e8),
    default(S::Frame, "stiffness_factor", NumberOrTable(S::StiffnessFactor), "1", "Factor on every EI, for cracked sections.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    default(S::Frame, "density", Quantity(D::Density), "\"2500 kg/m3\"", "Density of columns. A weight per volume is converted.").usual("a density", 100.0, 2e4).possible(0.0, 1e6),
    optional(S::Frame, "beam_mass", PerStorey(D::LineMass), "Mass per length carried by the beams, including their self weight; needed unless floor_mass is given. A weight per length is converted.").usual("a beam mass", 100.0, 1e5).possible(0.0, 1e6),
    default(S::Frame, "floor_load", PerStorey(D::Force), "0", "Weight per floor that the columns carry in addition to the weight of its masses, shared equally by the columns below. It has no horizontal inertia. Negative where other columns carry part of the weight. It acts with gravity or p_delta.").usual("a floor load", 1e3, 1e9).signed(),
    default(S::Frame, "floor_mass", PerStorey(D::Mass), "0", "Additional mass per floor, shared equally by the columns below. A weight is converted.").usual("a floor mass", 100.0, 1e8),
    default(S::Frame, "column_segments", Count, "4", "Segments of a column in one storey; k segments have k − 1 lumped masses between them."),
    default(S::Frame, "beam_segments", CountPerSpan, "4", "Segments of the beams: one value, or one per span."),
    default(S::Frame, "axial", ChoiceOrTable(AXIAL, S::Axial), "\"flexible\" for columns with EA in frames that have walls, a height above 3 times the width, or more than ten storeys, except on a foundation; otherwise \"rigid\"", "Axial deformation. \"flexible\" applies to columns. `{ columns = \"flexible\", beams = \"flexible\" }` makes beams flexible too, as without a slab; the contacts of a neighbour are then at joints instead of floors."),
    default(S::Frame, "shear", ChoiceOrTable(AXIAL, S::ShearDeformation), "\"rigid\"", "Shear deformation of members (Timoshenko)."),
    default(S::Frame, "poisson_ratio", Quantity(D::Dimensionless), "0.2", "Poisson's ratio, for the shear modulus.").usual("a Poisson's ratio", 0.01, 0.5),
    optional(S::Frame, "joint", Kind::Table(S::Joint), "Semi-rigid connection between beam ends and columns."),
    default(S::Frame, "rigid_ends", NumberOrTable(S::RigidEnds), "0", "Fraction of the half depths of columns and beams that is rigid inside joints: 1 up to the faces, 0 for no rigid ends; or lengths.").usual("a share of a joint", 0.01, 1.0),
    optional(S::Frame, "hinges", Kind::Table(S::Hinges), "Plastic hinges at member ends; without them the frame is elastic."),
    optional(S::Frame, "brace", Tables(&[S::FrameBay, S::BraceEnds, S::Brace]), "Braces between joints."),
    optional(S::Frame, "infill", Tables(&[S::FrameBay, S::Infill]), "Masonry panels in the bays."),
    optional(S::Frame, "wall", Tables(&[S::FrameWall]), "Walls, each of which replaces a column line."),
    optional(S::Frame, "coupling_beam", Tables(&[S::CouplingBeam]), "Beams between walls, with separate properties."),
    optional(S::Frame, "shear_failure", Kind::Table(S::ShearFailure), "Shear failure of columns; without this table their shear strength is unlimited."),

    default(S::Shear, "base", WordOrTable("fixed", &[S::ShearBase, S::PlanBase]), "\"fixed\"", "Springs and dashpots under the building."),
    optional(S::Shear, "isolation", Kind::Table(S::Isolation), "Bearings and a base mat under the building, instead of base."),
    optional(S::Shear, "foundation", Kind::Table(S::Foundation), "Rigid foundation on [soil], instead of base."),
    required(S::Shear, "mass", PerStorey(D::Mass), "Floor masses from the ground up. A weight is converted.").usual("a floor mass", 100.0, 1e8),
    optional(S::Shear, "stiffness", Kind::PlanStiffness, "Storey stiffnesses from the ground up; required without elements. With a plan also { x, y, torsion }. A single value applies along x; y is then the same, and torsion that of stiffness spread evenly over the plan.").usual("a storey stiffness", 1e4, 9e10),
    optional(S::Shear, "plan", Kind::Plan, "Plan of the floors: width along x and depth across, corners counter-clockwise, or a list of { size } or { corners } from the ground up. The building then translates in both directions and rotates.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    optional(S::Shear, "at", Kind::PlanPoints, "Position of the plan's origin on the site; without it, buildings are placed in a row along x.").usual("a position on the site", 1e-3, 1e7).possible(0.0, 1e8).signed(),
    default(S::Shear, "mass_centre", Kind::PlanPoints, "centroid of the plan", "Centre of mass of the floors, relative to the origin of the plan.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    default(S::Shear, "polar_mass", PerStorey(D::PolarMass), "mass spread evenly over the plan", "Mass moment of inertia about a vertical axis through the centre of mass.").usual("a polar mass", 100.0, 1e11),
    default(S::Shear, "eccentricity", Kind::PlanPoints, "0", "Position of the centre of stiffness of a storey, relative to the centre of mass of the floor above it.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    optional(S::Shear, "element", Tables(&[S::Element]), "Columns and walls at points of the plan, instead of stiffness."),
    optional(S::Shear, "frame", Tables(&[S::PlanFrame]), "For kind = \"frame\" with a plan: plane frames at lines of the plan, alone or in addition to stiffness or elements."),
    optional(S::FloorPlan, "size", Quantities(D::Length), "Width along x and depth across.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5),
    optional(S::FloorPlan, "corners", Kind::PlanPoints, "Corners, counter-clockwise.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    required(S::PlanStiffness, "x", Quantity(D::Stiffness), "Along x.").usual("a stiffness", 1e4, 9e10),
    default(S::PlanStiffness, "y", Quantity(D::Stiffness), "x", "Across.").usual("a stiffness", 1e4, 9e10),
    default(S::PlanStiffness, "torsion", Quantity(D::RotationalStiffness), "spread evenly over the plan", "About the centre of stiffness; not for elements.").usual("a torsional stiffness", 1e5, 1e14),
    required(S::Element, "at", Kind::PlanPoints, "Position, relative to the origin of the plan.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    required(S::Element, "stiffness", Kind::PlanStiffness, "Along x and across.").usual("a stiffness", 1e4, 9e10),
    default(S::Element, "storeys", Kind::FromTo, "all", "Storey, counted from 1; or the first and the last."),
    optional(S::Element, "name", Text, "Name in results, if the element can yield; its number by default."),
    optional(S::Element, "hinges", Kind::Table(S::StoreyHinges), "Cracking and yield along x and across; without this table the element is elastic."),
    default(S::PlanFrame, "name", Text, "\"1\", \"2\", …", "Name of the frame. Frames at several positions are numbered: \"1.1\", \"1.2\", …"),
    required(S::PlanFrame, "at", Kind::PlanPoints, "Base of its first column line, relative to the origin of the plan; or a list of positions of equal frames.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    default(S::PlanFrame, "direction", Kind::ChoiceOr(&["x", "y"], D::Dimensionless), "\"x\"", "Direction from its first column line to its last: \"x\", \"y\" (across), or an angle from x, counter-clockwise, such as \"30 deg\".").usual("an angle", 1e-4, 6.3).signed(),
    default(S::PlanFrame, "storeys", Count, "all", "Number of its storeys, from the lowest of the building up."),
    optional(S::PlanFrame, "lines", Kind::Texts, "Names of its column lines, \"\" for no name. Lines of two frames with the same name are one column, and their axial forces add."),
    required(S::PlanFrame, "spans", Quantities(D::Length), "Widths of its bays, starting at the first column line.").usual("a span", 0.5, 60.0).possible(0.01, 1000.0),
    optional(S::PlanFrame, "column", TablePerStorey(S::Column), "Column section, needed unless every line is a wall: one for all, a list from the ground up, or [[building.frame.column]] tables with line, storeys or omit; later tables override earlier ones."),
    optional(S::PlanFrame, "beam", TablePerStorey(S::Beam), "Beam section, needed unless coupling beams cross every bay: one for all, a list from the ground up, or [[building.frame.beam]] tables with bay, floors or omit; later tables override earlier ones. A floor has beams from its first to its last column, which are continuous over lines without a column."),
    optional(S::PlanFrame, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity of columns and beams.").usual("a modulus of elasticity", 1e9, 1e12).possible(1e6, 1e14),
    optional(S::PlanFrame, "concrete", Kind::Concrete(CONCRETES), "Concrete instead of elastic_modulus, as for a plane frame.").usual("a concrete strength", 1e6, 2e8),
    default(S::PlanFrame, "stiffness_factor", NumberOrTable(S::StiffnessFactor), "1", "Factor on every EI, for cracked sections.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    default(S::PlanFrame, "density", Quantity(D::Density), "0", "Density of columns, if the mass of the building does not include them.").usual("a density", 100.0, 2e4).possible(0.0, 1e6),
    default(S::PlanFrame, "beam_mass", PerStorey(D::LineMass), "0", "Mass per length carried by the beams, if the mass of the building does not include it.").usual("a beam mass", 100.0, 1e5).possible(0.0, 1e6),
    default(S::PlanFrame, "column_segments", Count, "1", "Segments of a column in one storey; k segments have k − 1 lumped masses between them, if columns have mass."),
    default(S::PlanFrame, "beam_segments", CountPerSpan, "1", "Segments of the beams: one value, or one per span."),
    default(S::PlanFrame, "axial", ChoiceOrTable(AXIAL, S::Axial), "\"flexible\" for columns with EA in frames that have walls, a height above 3 times the width, or more than ten storeys, except on a foundation; otherwise \"rigid\"", "Axial deformation of columns; floors are rigid."),
    default(S::PlanFrame, "shear", ChoiceOrTable(AXIAL, S::ShearDeformation), "\"rigid\"", "Shear deformation of members (Timoshenko)."),
    default(S::PlanFrame, "poisson_ratio", Quantity(D::Dimensionless), "0.2", "Poisson's ratio, for the shear modulus.").usual("a Poisson's ratio", 0.01, 0.5),
    optional(S::PlanFrame, "joint", Kind::Table(S::Joint), "Semi-rigid connection between beam ends and columns."),
    default(S::PlanFrame, "rigid_ends", NumberOrTable(S::RigidEnds), "0", "Fraction of the half depths of columns and beams that is rigid inside joints: 1 up to the faces, 0 for no rigid ends; or lengths.").usual("a share of a joint", 0.01, 1.0),
    optional(S::PlanFrame, "hinges", Kind::Table(S::Hinges), "Plastic hinges at member ends, given by moments, or fibres or yield surfaces of columns; without them the frame is elastic."),
    optional(S::PlanFrame, "brace", Tables(&[S::FrameBay, S::BraceEnds, S::Brace]), "Braces between joints."),
    optional(S::PlanFrame, "infill", Tables(&[S::FrameBay, S::Infill]), "Masonry panels in the bays."),
    optional(S::PlanFrame, "wall", Tables(&[S::FrameWall]), "Walls, each of which replaces a column line."),
    optional(S::PlanFrame, "coupling_beam", Tables(&[S::CouplingBeam]), "Beams between walls, with separate properties."),
    optional(S::PlanFrame, "shear_failure", Kind::Table(S::ShearFailure), "Shear failure of columns; without this table their shear strength is unlimited."),
    default(S::PlanFrame, "base", WordOrTable("fixed", &[S::ShearBase, S::FrameBase]), "\"fixed\"", "Springs and dashpots under every column."),
    default(S::FrameBay, "bay", Kind::FromTo, "all", "Bay, counted from 1 at the left; or the first and the last."),
    optional(S::GridBay, "along", Choice(AXES_OF_PLAN), "Direction of the bays: along x or across (y); required except for a brace with from and to."),
    default(S::GridBay, "x", Kind::FromTo, "all", "Line of lines_x at which a bay along x begins, or on which a bay across lies, counted from 1; or the first and the last."),
    default(S::GridBay, "y", Kind::FromTo, "all", "Line of lines_y on which a bay along x lies, or at which a bay across begins, counted likewise."),
    optional(S::BraceEnds, "from", Text, "Joint at one end as FLOOR.LINE, such as \"0.1\", or in a space frame as FLOOR.X.Y, such as \"0.1.1\", instead of the keys of bays, storeys and direction; floor 0 is the ground. The two joints may be several storeys and bays apart."),
    optional(S::BraceEnds, "to", Text, "Joint at the other end."),
    default(S::Brace, "storeys", Kind::FromTo, "all", "Storey, counted from 1; or the first and the last."),
    default(S::Brace, "direction", Choice(DIRECTIONS), "\"up\"", "From the lower left to the upper right corner of the bay, from the upper left to the lower right, or both. In a grid, right is the direction of increasing x or y."),
    optional(S::Brace, "profile", TextOrTable(S::Profile), "Steel profile instead of EA, as for columns. With `yield_strength` in hinge it also gives yield, slenderness and lever arm for the rule buckling."),
    default(S::Brace, "axis", Choice(AXES), "\"weak\"", "Axis of the profile about which the brace buckles."),
    optional(S::Brace, "EA", Quantity(D::Force), "Axial rigidity.").usual("an axial rigidity", 1e6, 1e12),
    optional(S::Brace, "stiffness", Quantity(D::Stiffness), "Axial force per elongation, instead of EA.").usual("an axial stiffness", 1e5, 1e11),
    optional(S::Brace, "hinge", Kind::TableOf(&[S::LinkHinge, S::Buckling]), "Axial yielding, with the same force in tension and compression, or buckling with the rule buckling; without this table the brace is elastic."),
    default(S::Infill, "storeys", Kind::FromTo, "all", "Storey, counted from 1; or the first and the last."),
    optional(S::Infill, "modulus", Quantity(D::Modulus), "Modulus of elasticity of the masonry along the strut; needs thickness and width.").usual("a masonry modulus", 1e8, 5e10),
    optional(S::Infill, "thickness", Quantity(D::Length), "Thickness of the panel.").usual("a panel thickness", 0.03, 1.5).possible(0.001, 10.0),
    optional(S::Infill, "width", Kind::ChoiceOr(STRUT_WIDTHS, D::Length), "In-plane width of the strut, or a rule that computes it from the bay between axes, the panel and the adjacent columns.").usual("a strut width", 0.1, 6.0),
    optional(S::Infill, "stiffness", Quantity(D::Stiffness), "Axial force per shortening of one strut, instead of modulus, thickness and width.").usual("an axial stiffness", 1e5, 1e11),
    optional(S::Infill, "strength", Kind::Table(S::InfillStrength), "Strengths of the masonry. They determine cracking, strength loss and pinching of the strut, by backbone. Without strength and force the strut is elastic."),
    optional(S::Infill, "force", Quantity(D::Force), "Axial strength of one strut, instead of strength. Openings reduce it.").usual("an axial strength", 1e3, 1e8),
    optional(S::Infill, "backbone", TextOrTable(S::InfillBackbone), "Force–deformation curve of first loading, with strength or force: `\"bertoldi\"` (default), or `{ rule = \"panagiotakos-fardis\", softening = 0.05, residual = 0.1 }`."),
    optional(S::Infill, "opening", NumberOrTable(S::InfillOpening), "Ratio of opening length to panel length; it multiplies stiffness and strength by 1 − 1.5 × ratio (Dawe and Seah, 1989). Or ratios of length and area (Decanini and others, 2014).").usual("an opening ratio", 0.01, 1.0),
    optional(S::Infill, "hinge", Kind::Table(S::LinkHinge), "Cracking of each strut: the rule pinched with its corners; without this table struts are elastic."),
    optional(S::Infill, "offset", Quantity(D::Length), "Distance from the joints to the ends of the struts, along the columns. The column between resists the shear of the strut. At most a quarter of the storey height.").usual("an offset of a strut", 0.02, 2.0),
    optional(S::Infill, "density", Quantity(D::Density), "Density of the panels with their plaster. Their masses, density × thickness × bay × storey height between axes without the area of openings, are added to those of the floors: half above, half below. Without density and mass, panels have no mass.").usual("a masonry density", 300.0, 2600.0),
    optional(S::Infill, "mass", Quantity(D::Mass), "Mass of every panel, instead of density.").usual("the mass of a panel", 50.0, 1e5),
    default(S::Infill, "struts", Count, "1", "Struts of each diagonal: 1, or 3. With 3, one runs from joint to joint, and two end on a column at offset from a joint."),
    optional(S::Infill, "central_share", Quantity(D::Dimensionless), "struts = 3: fraction of stiffness and strength in the strut between the joints; the other two share the rest equally.").usual("a strut fraction", 0.05, 1.0),
    default(S::Infill, "damage_drifts", Quantities(D::Dimensionless), "[0.0018, 0.0046, 0.0105, 0.0188]", "Drifts at which damage states 1 to 4 begin (Sassun and others, 2015).").usual("a drift", 2e-4, 0.1),
    optional(S::Infill, "out_of_plane", Kind::Table(S::InfillOutOfPlane), "Out-of-plane capacity of the panel, for comparison with its inertia force from the floor accelerations. It does not affect the motion unless `remove` is set."),
    optional(S::InfillOutOfPlane, "rule", Choice(ARCHINGS), "Arching between the floors, for panels without openings whose height is at most 25 times their thickness: `asce41`, 0.7 compression λ₂ thickness/height with λ₂ of FEMA 356, table 7-11; `en1996`, compression (thickness/height)² (EN 1996-1-1, 6.3.2)."),
    optional(S::InfillOutOfPlane, "compression", Quantity(D::Stress), "Compressive strength of the masonry along its height; that of strength by default, if given there.").usual("a masonry strength", 1e5, 5e7),
    optional(S::InfillOutOfPlane, "strength", Quantity(D::Stress), "Out-of-plane capacity as a pressure, instead of rule.").usual("a pressure on a panel", 100.0, 1e5),
    required(S::InfillOutOfPlane, "density", Quantity(D::Density), "Density of the panel, including plaster.").usual("a masonry density", 300.0, 2600.0),
    default(S::InfillOutOfPlane, "remove", Flag, "false", "Remove the panel from the model when the out-of-plane inertia force first exceeds its capacity. Its struts then carry no force; the mass of the building does not change."),
    optional(S::InfillOutOfPlane, "height", Quantity(D::Length), "Clear height of the panel; the storey height between axes if not given.").usual("a panel height", 1.0, 8.0),
    required(S::InfillStrength, "rule", Choice(PANEL_STRENGTHS), "`bertoldi`, the smallest of four stresses (crushing of the diagonal and of corners, sliding, cracking); or `sliding`, (sliding + 0.4 vertical_stress) over the length and thickness of the panel (FEMA 306)."),
    optional(S::InfillStrength, "compression", Quantity(D::Stress), "bertoldi: compressive strength perpendicular to the bed joints.").usual("a masonry strength", 1e5, 5e7),
    optional(S::InfillStrength, "shear", Quantity(D::Stress), "bertoldi: shear strength from diagonal compression tests.").usual("a masonry strength", 1e4, 5e6),
    required(S::InfillStrength, "sliding", Quantity(D::Stress), "Sliding shear strength of the bed joints.").usual("a masonry strength", 1e4, 5e6),
    default(S::InfillStrength, "vertical_stress", Quantity(D::Stress), "0", "Vertical compressive stress in the panel under gravity.").usual("a masonry stress", 1e3, 1e7),
    required(S::InfillBackbone, "rule", Choice(PANEL_CURVES), "`bertoldi`: 0.8 of the strength at four times the secant stiffness, then the strength at the secant stiffness, then a descent with 0.02 of that stiffness to 0.35 of the strength. `panagiotakos-fardis`: cracking at the strength, 1.3 times the strength at the secant stiffness, then a descent."),
    optional(S::InfillBackbone, "shear_modulus", Quantity(D::Modulus), "panagiotakos-fardis: shear modulus of the masonry, 0.4 modulus if not given.").usual("a masonry modulus", 1e8, 5e10),
    optional(S::InfillBackbone, "softening", Quantity(D::Dimensionless), "panagiotakos-fardis: ratio of the descending slope to the initial one, such as 0.05.").usual("a stiffness ratio", 1e-4, 1.0),
    optional(S::InfillBackbone, "residual", Quantity(D::Dimensionless), "panagiotakos-fardis: ratio of residual to peak force, such as 0.1.").usual("a share of a strength", 1e-3, 1.0),
    required(S::InfillOpening, "length", Quantity(D::Dimensionless), "Ratio of opening length to panel length.").usual("an opening ratio", 0.01, 1.0),
    required(S::InfillOpening, "area", Quantity(D::Dimensionless), "Ratio of opening area to panel area.").usual("an opening ratio", 0.01, 1.0),
    optional(S::FrameWall, "at", Quantity(D::Length), "Position of its axis, measured from the first column line; it must coincide with a line.").usual("a position along the frame", 1e-3, 5e3).signed(),
    optional(S::FrameWall, "line", Count, "Column line instead of at, counted from 1."),
    default(S::FrameWall, "storeys", Kind::FromTo, "all", "Storey, counted from 1; or the first and the last."),
    required(S::FrameWall, "length", Quantity(D::Length), "Length along the frame. Beams frame into its edges, and move vertically as they do.").usual("a wall length", 0.5, 40.0),
    optional(S::FrameWall, "thickness", Quantity(D::Length), "Thickness; with length and the modulus of the building it gives EI, EA and GA = 5/6 G A.").usual("a wall thickness", 0.08, 2.0),
    optional(S::FrameWall, "EI", Quantity(D::FlexuralRigidity), "Flexural rigidity, instead of thickness.").usual("a flexural rigidity", 1e6, 1e14),
    optional(S::FrameWall, "EA", Quantity(D::Force), "Axial rigidity.").usual("an axial rigidity", 1e8, 1e13),
    optional(S::FrameWall, "GA", Quantity(D::Force), "Shear rigidity.").usual("a shear rigidity", 1e7, 1e13),
    optional(S::FrameWall, "mass", Quantity(D::LineMass), "Self mass per length; by default from the density. A weight per length is converted.").usual("a line mass", 10.0, 1e6).possible(0.0, 1e7),
    default(S::FrameWall, "shear", Choice(AXIAL), "\"flexible\"", "Shear deformation."),
    default(S::FrameWall, "stiffness_factor", Kind::ChoiceOr(WALL_STIFFNESS, D::Dimensionless), "that of columns", "Factor on EI of the whole section. `asce41-23`, by ACI 369.1-22: 0.25 on EI, and GA = 0.15 E A; `en1998`, by EN 1998-1 4.3.1(7): half of EI and GA.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    optional(S::FrameWall, "concrete", Kind::ConcreteOr(SECTION_CONCRETES), "Concrete of the section with bars: a grade of GB 50010 (C30) or EN 1992-1-1 (C30/37), the cylinder strength of ACI 318 (f'c = 4 ksi), or a prismatic strength; by default that of the building.").usual("a concrete strength", 1e6, 2e8),
    optional(S::FrameWall, "steel", GradeOr(STEELS), "Steel of the bars: a grade of GB 50010 (HRB400), EN 10080 (B500, ductility class B if no letter is given) or ASTM (Grade 60, in ksi, or Grade 420, in MPa), or its yield strength; needed with bars.").usual("a yield strength", 5e7, 2e9),
    default(S::FrameWall, "strength", Choice(STRENGTHS), "\"characteristic\"", "Strength level of a grade."),
    optional(S::FrameWall, "bars", TextOrTable(S::WallBars), "Vertical reinforcement of a wall of fibres (rule fibre of its hinge): `{ edges = \"8 d20\", edge_length = \"500 mm\", web = \"16 d10\" }`, or bars around the whole section such as \"24 d16\"; diameters in mm. Top is the left end of the wall."),
    default(S::FrameWall, "cover", Quantity(D::Length), "\"35 mm\"", "Concrete cover of the bars.").usual("a concrete cover", 0.005, 0.2).possible(0.0005, 1.0),
    optional(S::FrameWall, "ties", Text, "Ties that confine the edges, or the whole section if it has no edges, such as \"d10 @ 100 mm\"."),
    optional(S::FrameWall, "hinge", Kind::TableOf(&[S::WallHinge, S::WallEnds]), "Yielding at its base, or above the given floors; without this table the wall is elastic. Hinges of columns do not apply to walls."),
    optional(S::FrameWall, "shear_hinge", Kind::TableOf(&[S::LinkHinge, S::Sliding]), "Shear yielding of its lowest storey."),
    default(S::WallEnds, "floors", Counts, "its foot", "Floors above which it yields, such as [0, 3], where 0 is the ground. All these hinges have the same length or stiffness."),
    default(S::WallEnds, "ends", Choice(WALL_HINGES), "\"foot\"", "Instead of floors: \"all\" puts hinges at the foot and the head of every storey."),
    required(S::WallHinge, "rule", Choice(HINGE_RULES), "Unloading and reloading rule. fibre: the ends consist of concrete and steel fibres of the section with `bars`, so that the neutral axis shifts, edges lift and the strength follows the axial force."),
    default(S::WallHinge, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::WallHinge, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::WallHinge, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::WallHinge, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    optional(S::WallHinge, "cracking", PerStorey(D::Moment), "Moment at the first corner; not for bilinear. Or a list, one value for each of floors, or for each storey with ends = \"all\", from the lowest up.").usual("a cracking moment", 1e3, 1e10),
    optional(S::WallHinge, "yield", PerStorey(D::Moment), "Moment at yield; or a list, likewise.").usual("a yield moment", 1e3, 1e10),
    optional(S::WallHinge, "post_cracking", Quantity(D::Dimensionless), "Ratio of the stiffness after the first corner to the initial stiffness of the hinge; with length, ratio of the flexural rigidity there to EI.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::WallHinge, "post_yield", Quantity(D::Dimensionless), "The same ratio after yield.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::WallHinge, "stiffness", Quantity(D::RotationalStiffness), "Initial stiffness, in series with the wall.").usual("a rotational stiffness", 1e6, 1e15),
    optional(S::WallHinge, "initial", Quantity(D::Dimensionless), "Initial stiffness in units of EI over the storey height; 100 with length.").usual("a stiffness ratio", 1.0, 1e6),
    optional(S::WallHinge, "length", WordOr("paulay-priestley", D::Length), "Length of the hinge. The ratios are then those of flexural rigidity over that length, and include the elastic bending of the wall. `paulay-priestley`: 0.2 of the length of the wall plus 0.044 of two thirds of its height. Required with rule = \"fibre\": length over which strains are constant.").usual("a hinge length", 0.05, 10.0),
    default(S::WallEnds, "fibres", Kind::OneOrTwo, "40", "fibre: concrete layers over the length of the wall, 2 to 400. Edges and web have at least two each. In a space frame a second number, 4 by default, divides the thickness, and both are at most 100."),
    default(S::WallEnds, "peak_strain", Quantity(D::Dimensionless), "that of the concrete, confined if there are ties", "fibre: strain of concrete at its peak strength.").usual("a strain", 1e-3, 2e-2),
    default(S::WallEnds, "residual", Quantity(D::Dimensionless), "0.2", "fibre: ratio of residual to peak strength of crushed concrete.").usual("a ratio", 1e-3, 1.0),
    default(S::WallEnds, "ultimate_strain", Quantity(D::Dimensionless), "from the straight line through its stress at the crushing strain", "fibre: strain at which concrete reaches its residual strength.").usual("a strain", 2e-3, 0.3),
    default(S::WallEnds, "hardening", Quantity(D::Dimensionless), "that of the steel", "fibre: ratio of post-yield to elastic modulus of the bars.").usual("a stiffness ratio", 1e-4, 0.2),
    default(S::WallEnds, "steel", TextOrTable(S::FibreSteel), "\"bilinear\"", "fibre: hysteresis of the bars: bilinear, or `\"menegotto-pinto\"` with smooth curves; a table gives its parameters."),
    optional(S::WallEnds, "limits", Kind::Table(S::FibreLimits), "fibre: strain limits to check, instead of those that follow from the section."),
    required(S::WallBars, "edges", Text, "Bars of each edge, such as \"8 d20\", around it; diameters in mm."),
    required(S::WallBars, "edge_length", Quantity(D::Length), "Length of each edge along the wall.").usual("the length of an edge", 0.1, 5.0),
    optional(S::WallBars, "web", Text, "Bars of the web between the edges, such as \"16 d10\": half of them at either face, evenly spaced."),
    optional(S::CouplingBeam, "between", Kind::FromTo, "Numbers of its two walls, in the order of [[building.wall]]."),
    optional(S::CouplingBeam, "bay", Kind::FromTo, "Bay, instead of between, counted from 1; or the first and the last."),
    default(S::CouplingBeam, "floors", Kind::FromTo, "all floors that both walls reach", "Floor, counted from 1; or the first and the last."),
    optional(S::CouplingBeam, "width", Quantity(D::Length), "Width; with depth and the modulus of the building it gives EI, EA and GA = 5/6 G A.").usual("a width", 0.05, 5.0),
    optional(S::CouplingBeam, "depth", Quantity(D::Length), "Depth.").usual("a depth", 0.05, 5.0),
    optional(S::CouplingBeam, "EI", Quantity(D::FlexuralRigidity), "Flexural rigidity, instead of width and depth.").usual("a flexural rigidity", 1e4, 1e13),
    optional(S::CouplingBeam, "EA", Quantity(D::Force), "Axial rigidity.").usual("an axial rigidity", 1e6, 1e13),
    optional(S::CouplingBeam, "GA", Quantity(D::Force), "Shear rigidity.").usual("a shear rigidity", 1e6, 1e13),
    default(S::CouplingBeam, "shear", Choice(AXIAL), "\"flexible\"", "Shear deformation."),
    default(S::CouplingBeam, "stiffness_factor", Kind::ChoiceOr(WALL_STIFFNESS, D::Dimensionless), "that of beams", "Factor on EI of the whole section. `asce41-23`, by ACI 369.1-22: 0.05 × clear length ÷ depth on EI, at most 0.2, and GA = 0.2 E A; `en1998`: half of EI and GA.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    optional(S::CouplingBeam, "hinge", Kind::TableOf(&[S::LinkHinge, S::Sliding]), "Yielding in shear, such as bilinear for diagonal bars and pinched for stirrups; without this table the beam is elastic."),
    optional(S::Sliding, "stiffness", Quantity(D::Stiffness), "Initial stiffness of the shear spring, force over displacement, instead of GA over the length. post_cracking and post_yield are ratios to it.").usual("a shear stiffness", 1e6, 1e13),
    required(S::SpaceFrame, "lines_x", Quantities(D::Length), "x coordinates of the grid lines that run across, from the origin of the plan, in ascending order.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    required(S::SpaceFrame, "lines_y", Quantities(D::Length), "y coordinates of the grid lines that run along x, from the origin of the plan, in ascending order.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    required(S::SpaceFrame, "column", Kind::TablePerPlace(S::SpaceColumn), "Columns at the grid intersections: one table for all, or [[building.column]] tables for some; later tables override earlier ones. Without plan, the plan is the rectangle of the outer lines. Columns and beams outside the plan of their floor are left out."),
    optional(S::SpaceFrame, "beam_x", Kind::TablePerPlace(S::SpaceBeam), "Beams along x, likewise. Needed if lines_x has two lines or more."),
    optional(S::SpaceFrame, "beam_y", Kind::TablePerPlace(S::SpaceBeam), "Beams across, likewise. Needed if lines_y has two lines or more."),
    optional(S::SpaceFrame, "joint", Kind::TableOf(&[S::BeamJoint, S::SpaceJoint]), "Connections between beam ends and columns that yield in the vertical planes of the beams, instead of hinges of beams."),
    optional(S::SpaceFrame, "brace", Tables(&[S::GridBay, S::BraceEnds, S::Brace]), "Braces between joints."),
    optional(S::SpaceFrame, "infill", Tables(&[S::GridBay, S::Infill]), "Masonry panels in the bays."),
    optional(S::SpaceFrame, "shear_failure", Kind::Table(S::ShearFailure), "Shear failure of columns, in each direction by itself; without this table their shear strength is unlimited."),
    optional(S::SpaceFrame, "wall", Tables(&[S::SpaceWall]), "Walls, each of which replaces the columns at a grid intersection."),
    default(S::SpaceFrame, "rigid_ends", NumberOrTable(S::RigidEnds), "0", "Fraction of the half depths of columns and beams that is rigid inside joints: 1 up to the faces, 0 for no rigid ends; or lengths.").usual("a share of a joint", 0.01, 1.0),
    optional(S::SpaceFrame, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity of columns and beams.").usual("a modulus of elasticity", 1e9, 1e12).possible(1e6, 1e14),
    optional(S::SpaceFrame, "concrete", Kind::Concrete(CONCRETES), "Concrete instead of elastic_modulus, as for a plane frame.").usual("a concrete strength", 1e6, 2e8),
    default(S::SpaceFrame, "floor_load", PerStorey(D::Force), "0", "Weight per floor that the columns carry in addition to the weight of its mass, in equal shares. It has no horizontal inertia. Negative where other columns carry part of the weight. It acts with gravity or p_delta.").usual("a floor load", 1e3, 1e9).signed(),
    default(S::SpaceFrame, "stiffness_factor", NumberOrTable(S::StiffnessFactor), "1", "Factor on every EI, for cracked sections.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    default(S::SpaceFrame, "torsion_factor", Quantity(D::Dimensionless), "1", "Factor on every GJ, for cracked sections.").usual("a torsion factor", 1e-3, 10.0),
    default(S::SpaceFrame, "axial", Choice(AXIAL), "\"flexible\"", "Axial deformation of columns; floors are rigid."),
    default(S::SpaceFrame, "shear", ChoiceOrTable(AXIAL, S::ShearDeformation), "\"rigid\"", "Shear deformation of members (Timoshenko)."),
    default(S::SpaceFrame, "poisson_ratio", Quantity(D::Dimensionless), "0.2", "Poisson's ratio, for the shear modulus.").usual("a Poisson's ratio", 0.01, 0.5),
    default(S::SpaceFrame, "density", Quantity(D::Density), "\"2500 kg/m3\"", "Density of columns and walls, which the mass of the floors includes. Points between floors that neighbours can strike, or that struts meet, carry their share of it instead of the floors. A weight per volume is converted.").usual("a density", 100.0, 2e4).possible(0.0, 1e6),
    default(S::SpaceFrame, "angle", Quantity(D::Dimensionless), "0", "Angle from x of the site to the grid lines along x, counter-clockwise, such as \"30 deg\". It rotates the plan and mass_centre as well.").usual("an angle", 1e-4, 6.3).signed(),
    required(S::SpaceWall, "along", Choice(AXES_OF_PLAN), "Direction of its length: along x or across (y)."),
    required(S::SpaceWall, "length", Quantity(D::Length), "Length. Beams along it frame into its edges, and move vertically as they do.").usual("a wall length", 0.5, 40.0),
    required(S::SpaceWall, "thickness", Quantity(D::Length), "Thickness; with length and the modulus it gives EI in both planes, EA, GJ and GA = 5/6 G A. This GA applies even with shear = \"rigid\".").usual("a wall thickness", 0.08, 2.0),
    optional(S::SpaceWall, "EI", Quantity(D::FlexuralRigidity), "In-plane flexural rigidity, instead of that from length and thickness, such as the share of a core.").usual("a flexural rigidity", 1e6, 1e14),
    optional(S::SpaceWall, "EA", Quantity(D::Force), "Axial rigidity, likewise.").usual("an axial rigidity", 1e8, 1e13),
    optional(S::SpaceWall, "GA", Quantity(D::Force), "In-plane shear rigidity, likewise.").usual("a shear rigidity", 1e7, 1e13),
    default(S::SpaceWall, "stiffness_factor", Kind::ChoiceOr(WALL_STIFFNESS, D::Dimensionless), "that of columns", "Factor on EI; `asce41-23` and `en1998` also reduce GA, as for walls of plane frames.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    default(S::SpaceWall, "x", Kind::FromTo, "all", "Line of lines_x on which its axis lies, counted from 1; or the first and the last."),
    default(S::SpaceWall, "y", Kind::FromTo, "all", "Line of lines_y, likewise."),
    default(S::SpaceWall, "storeys", Kind::FromTo, "all", "Storey, likewise."),
    optional(S::SpaceWall, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity, if it differs from that of the building.").usual("a modulus of elasticity", 1e9, 1e12).possible(1e6, 1e14),
    optional(S::SpaceWall, "concrete", Kind::ConcreteOr(CONCRETES), "Concrete instead of elastic_modulus. With bars it is the concrete of the section, or its prismatic strength, and elastic_modulus may also be given.").usual("a concrete strength", 1e6, 2e8),
    optional(S::SpaceWall, "steel", GradeOr(STEELS), "Steel of the bars, as for a wall of a plane frame; needed with bars.").usual("a yield strength", 5e7, 2e9),
    default(S::SpaceWall, "strength", Choice(STRENGTHS), "\"characteristic\"", "Strength level of a grade."),
    optional(S::SpaceWall, "bars", TextOrTable(S::WallBars), "Vertical reinforcement of a wall of fibres, as for a wall of a plane frame: `{ edges = \"8 d20\", edge_length = \"500 mm\", web = \"16 d10\" }`, or bars around the whole section such as \"24 d16\". Top is the end at smaller x, or at smaller y of a wall along y."),
    default(S::SpaceWall, "cover", Quantity(D::Length), "\"35 mm\"", "Concrete cover of the bars.").usual("a concrete cover", 0.005, 0.2).possible(0.0005, 1.0),
    optional(S::SpaceWall, "ties", Text, "Ties that confine the edges, or the whole section if it has no edges, such as \"d10 @ 100 mm\"."),
    optional(S::SpaceWall, "hinge", Kind::TableOf(&[S::ColumnHinge, S::SpaceWallHinge, S::WallEnds]), "Moments of its hinges at the foot and the head of every storey, with the rule of hinges; or, with rule = \"fibre\", fibre sections. Without this table the wall is elastic, even if hinges.column is given."),
    optional(S::SpaceWallHinge, "rule", Choice(WALL_RULES_IN_SPACE), "fibre: the foot consists of concrete and steel fibres of the section with `bars`, which bends in and across its plane. Without this key the hinges have moments."),
    optional(S::SpaceWallHinge, "length", WordOr("paulay-priestley", D::Length), "fibre, required: length over which strains are constant. `paulay-priestley`: 0.2 of the length of the wall plus 0.044 of two thirds of its height.").usual("a hinge length", 0.05, 10.0),
    optional(S::SpaceColumn, "size", Quantities(D::Length), "Widths along x and across; needed unless profile or omit is given.").usual("a section size", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::SpaceColumn, "profile", TextOrTable(S::Profile), "Steel profile instead of size, as for columns of plane frames; stiffness_factor and torsion_factor do not apply to it."),
    optional(S::SpaceColumn, "axis", Choice(AXES), "Axis of the profile about which the column bends along x; `strong` if not given."),
    optional(S::SpaceColumn, "yield_strength", Quantity(D::Stress), "Yield strength of the steel of a profile, such as `\"355 MPa\"`. Demands are then compared with the capacity by AISC 360, and hinges without `yield` yield at the plastic moment.").usual("a yield strength", 1e8, 2e9),
    default(S::SpaceColumn, "x", Kind::FromTo, "all", "Line of lines_x, counted from 1; or the first and the last."),
    default(S::SpaceColumn, "y", Kind::FromTo, "all", "Line of lines_y, likewise."),
    default(S::SpaceColumn, "storeys", Kind::FromTo, "all", "Storey, likewise."),
    default(S::SpaceColumn, "omit", Flag, "false", "Omit the columns at these positions."),
    optional(S::SpaceColumn, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity, if it differs from that of the building.").usual("a modulus of elasticity", 1e9, 1e12).possible(1e6, 1e14),
    optional(S::SpaceColumn, "concrete", Kind::ConcreteOr(CONCRETES), "Concrete instead of elastic_modulus. With bars it is the concrete of the section, or its prismatic strength, and elastic_modulus may also be given.").usual("a concrete strength", 1e6, 2e8),
    optional(S::SpaceColumn, "steel", GradeOr(STEELS), "Steel of the bars, as for a column of a plane frame; needed with bars.").usual("a yield strength", 5e7, 2e9),
    default(S::SpaceColumn, "strength", Choice(STRENGTHS), "\"characteristic\"", "Strength level of a grade."),
    optional(S::SpaceColumn, "bars", TextOrTable(S::Bars), "Reinforcement, such as \"12 d20 (around)\"; diameters in mm. Top is the face at smaller x, bottom the face at greater x, and sides are the faces across. With ties, demands along both axes are compared with capacities."),
    default(S::SpaceColumn, "cover", Quantity(D::Length), "\"35 mm\"", "Concrete cover of the bars.").usual("a concrete cover", 0.005, 0.2).possible(0.0005, 1.0),
    optional(S::SpaceColumn, "ties", Text, "Ties that confine the core and resist shear in both directions, such as \"d10 @ 100 mm\", or \"4 d10 @ 100 mm\" with four legs."),
    optional(S::SpaceColumn, "hinge", Kind::Table(S::ColumnHinge), "Moments of its hinges instead of those of hinges.column; the rule is that of hinges."),
    optional(S::SpaceBeam, "width", Quantity(D::Length), "Width; needed unless profile or omit is given.").usual("a section width", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::SpaceBeam, "depth", Quantity(D::Length), "Depth in the direction of bending; needed unless profile or omit is given.").usual("a section depth", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::SpaceBeam, "profile", TextOrTable(S::Profile), "Steel profile instead of width and depth, as for columns."),
    optional(S::SpaceBeam, "axis", Choice(AXES), "Axis of the profile about which the beam bends in its vertical plane; `strong` if not given."),
    optional(S::SpaceBeam, "yield_strength", Quantity(D::Stress), "Yield strength of the steel of a profile, as for columns.").usual("a yield strength", 1e8, 2e9),
    optional(S::SpaceBeam, "slab", Kind::Table(S::Slab), "Slab that acts as the upper flange of a beam with width and depth: `{ depth = \"150 mm\", width = \"en1992\", spacing = \"4.7 m\" }`. A span that no beam continues is an end span. GJ and hinges ignore the slab."),
    default(S::SpaceBeam, "x", Kind::FromTo, "all", "Line of lines_x at which a beam along x begins, or on which a beam across lies, counted from 1; or the first and the last."),
    default(S::SpaceBeam, "y", Kind::FromTo, "all", "Line of lines_y on which a beam along x lies, or at which a beam across begins, counted likewise."),
    default(S::SpaceBeam, "storeys", Kind::FromTo, "all", "Storey below the beam, likewise."),
    default(S::SpaceBeam, "omit", Flag, "false", "Omit the beams at these positions."),
    optional(S::SpaceBeam, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity, if it differs from that of the building.").usual("a modulus of elasticity", 1e9, 1e12).possible(1e6, 1e14),
    optional(S::SpaceBeam, "concrete", Kind::ConcreteOr(CONCRETES), "Concrete instead of elastic_modulus. With bars it is the concrete of the section, or its prismatic strength, and elastic_modulus may also be given.").usual("a concrete strength", 1e6, 2e8),
    optional(S::SpaceBeam, "steel", GradeOr(STEELS), "Steel of the bars, as for a beam of a plane frame; needed with bars.").usual("a yield strength", 5e7, 2e9),
    default(S::SpaceBeam, "strength", Choice(STRENGTHS), "\"characteristic\"", "Strength level of a grade."),
    optional(S::SpaceBeam, "bars", TextOrTable(S::Bars), "Reinforcement, such as \"4 d25 top, 4 d25 bottom\"; diameters in mm. With ties, demands in the vertical plane are compared with capacities."),
    default(S::SpaceBeam, "cover", Quantity(D::Length), "\"35 mm\"", "Concrete cover of the bars.").usual("a concrete cover", 0.005, 0.2).possible(0.0005, 1.0),
    optional(S::SpaceBeam, "ties", Text, "Ties that confine the core and resist shear, such as \"d10 @ 100 mm\", or \"4 d10 @ 100 mm\" with four legs."),
    optional(S::SpaceBeam, "hinge", Kind::Table(S::Hinge), "Moments of its hinges instead of those of hinges.beam; the rule is that of hinges."),

    optional(S::Shear, "hinges", Kind::Table(S::StoreyHinges), "Cracking and yield of the storeys; without this table they are elastic."),
    optional(S::SpaceFrame, "hinges", Kind::Table(S::SpaceHinges), "Plastic hinges at the ends of columns, about both axes, and of beams; without them the frame is elastic."),

    optional(S::Given, "matrices", TextOrTable(S::Matrices), "NumPy archive (.npz) with the arrays K (or F, its inverse) and M, or a table of Matrix Market files, with paths relative to this file. C is the damping matrix, r the displacements when the ground moves by 1, h their heights."),
    default(S::Given, "units", Choice(MATRIX_UNITS), "\"N, m\"", "Force and length units of the matrices; masses are force × s² / length. With mm, ft or in, every displacement must be a length, or a rotation of a port with a plan. Rows of rotations are moments per radian, force × length, and polar masses are force × length × s²."),
    optional(S::Given, "ports", Kind::Named(S::Port), "Floors by name, such as `{ \"1\" = { dof = 1, height = \"3 m\" } }`, or with a plan `{ \"1\" = { dofs = [1, 2, 3], height = \"3 m\" } }`. Contacts, links and results use these floors."),
    optional(S::Given, "plan", Kind::Plan, "Plan of the floors, as for a shear building; the building then translates in both directions and rotates. M may couple the displacements of a floor, which defines its centre of mass. Displacements that belong to no port are condensed; they must have no mass and no damping.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    optional(S::Given, "at", Kind::PlanPoints, "Position of the plan's origin on the site; without it, buildings are placed in a row along x.").usual("a position on the site", 1e-3, 1e7).possible(0.0, 1e8).signed(),
    default(S::Given, "angle", Quantity(D::Dimensionless), "0", "With a plan: angle from x of the site to x of the plan and of the matrices, counter-clockwise, such as \"30 deg\". It rotates the plan about its origin.").usual("an angle", 1e-4, 6.3).signed(),
    optional(S::Given, "isolation", Kind::Table(S::Isolation), "With a plan: bearings and a base mat under the building; the matrices are then those of the building on a fixed base."),
    optional(S::Given, "mass", PerStorey(D::Mass), "Floor masses from the ground up; needs periods and shapes. A weight is converted.").usual("a floor mass", 100.0, 1e8),
    optional(S::Given, "periods", Quantities(D::Time), "Periods of the modes.").usual("a period", 0.005, 50.0),
    optional(S::Given, "shapes", Kind::NumberLists, "Mode shapes, one list per period: floor displacements from the ground up, at any scale.").any("the scale is arbitrary"),
    default(S::Given, "remainder_period", Quantity(D::Time), "from the omitted modes of a uniform building; shorter than the last given period, and closer to it the more modes are given", "Period of the residual response that the given modes leave out.").usual("a period", 1e-5, 10.0),
    optional(S::Given, "contact_flexibility", Quantity(D::Flexibility), "Displacement of the floor in contact per unit force on it, from one static load case, instead of remainder_period. It defines the response that the modes leave out.").usual("a flexibility", 1e-13, 1e-3),
    default(S::Given, "contact_floor", Count, "the highest floor that a neighbour reaches", "Floor at which contact_flexibility applies, counted from 1."),

    optional(S::Matrices, "stiffness", Kind::TextOrNumbers, "Stiffness matrix K: symmetric, positive definite.").any("the unit is that of the matrices"),
    optional(S::Matrices, "flexibility", Kind::TextOrNumbers, "F instead of K, its inverse: displacements of all floors under a unit force at each, one static load case per floor. Rounded values are made symmetric.").any("the unit is that of the matrices"),
    optional(S::Matrices, "mass", Kind::TextOrNumbers, "Mass matrix M: diagonal, as a matrix or as a list; with a plan it may couple the displacements of one floor.").any("the unit is that of the matrices"),
    optional(S::Matrices, "damping", Kind::TextOrNumbers, "Damping matrix C: symmetric; replaces damping.").any("the unit is that of the matrices"),
    optional(S::Matrices, "influence", Kind::TextOrNumbers, "r: 1 for displacements that move with the ground, 0 for rotations and vertical displacements; not needed if all displacements are those of floors.").any("the unit is that of the matrices"),
    optional(S::Matrices, "heights", Kind::TextOrNumbers, "h: height of every displacement above the base; needed only if degrees of freedom other than those of floors have mass that moves horizontally.").any("the unit is that of the matrices"),
    optional(S::Port, "dof", Count, "Row of its horizontal displacement in the matrices, counted from 1; required without a plan."),
    optional(S::Port, "dofs", Counts, "With a plan, instead of dof: rows of its displacements along x and across and of its rotation, counter-clockwise in radians, such as [1, 2, 3]."),
    default(S::Port, "at", Kind::PlanPoints, "middle of the plan", "With a plan: the point to which these displacements refer, relative to the origin of the plan.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    required(S::Port, "height", Quantity(D::Length), "Height above the base.").usual("a height", 0.1, 1000.0).possible(0.0, 1e4),

    optional(S::Column, "width", Quantity(D::Length), "Width, perpendicular to the direction of bending.").usual("a section width", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::Column, "depth", Quantity(D::Length), "Depth, in the direction of bending.").usual("a section depth", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::Column, "profile", TextOrTable(S::Profile), "Steel profile instead of width and depth: a name, such as `\"HEB300\"` (IPE, HEA, HEB), `\"W14X90\"` (W shapes) or `\"HSS8X6X3/8\"` (American tubes), or dimensions of an I shape. E is 210 GPa, or 29 000 ksi with an American name, unless the building states elastic_modulus. The density is 7850 kg/m3, and no cracking factor applies."),
    optional(S::Column, "axis", Choice(AXES), "Axis of the profile for bending; `strong` if not given."),
    optional(S::Column, "yield_strength", Quantity(D::Stress), "Yield strength of the steel of a profile, such as `\"355 MPa\"`. Demands are then compared with the capacity by AISC 360, and hinges without `yield` yield at the plastic moment.").usual("a yield strength", 1e8, 2e9),
    optional(S::Column, "EI", Quantity(D::FlexuralRigidity), "Flexural rigidity, instead of width and depth.").usual("a flexural rigidity", 1e5, 1e12),
    optional(S::Column, "EA", Quantity(D::Force), "Axial rigidity, with EI; needed for axially flexible columns.").usual("an axial rigidity", 1e5, 1e13),
    optional(S::Column, "GA", Quantity(D::Force), "Shear rigidity G·A_s, with EI; needed for columns with shear deformation.").usual("a shear rigidity", 1e4, 1e13),
    default(S::Column, "mass", Quantity(D::LineMass), "density × area", "Self mass per length of the column.").usual("a column mass per length", 1.0, 1e5).possible(0.0, 1e7),
    default(S::Column, "line", Kind::FromTo, "all", "Column line, counted from 1 at the left; or the first and the last."),
    default(S::Column, "storeys", Kind::FromTo, "all", "Storey, counted from 1 at the ground; or the first and the last."),
    default(S::Column, "omit", Flag, "false", "Omit the columns at these positions."),
    required(S::Profile, "depth", Quantity(D::Length), "Depth.").usual("a profile depth", 0.05, 2.0),
    required(S::Profile, "width", Quantity(D::Length), "Width of the flanges.").usual("a profile width", 0.03, 1.0),
    required(S::Profile, "web", Quantity(D::Length), "Thickness of the web.").usual("a plate thickness", 2e-3, 0.15),
    required(S::Profile, "flange", Quantity(D::Length), "Thickness of a flange.").usual("a plate thickness", 2e-3, 0.15),
    default(S::Profile, "radius", Quantity(D::Length), "none", "Radius of the fillets.").usual("a fillet radius", 2e-3, 0.1),
    required(S::Slab, "depth", Quantity(D::Length), "Thickness, included in the depth of the beam.").usual("a slab thickness", 0.04, 1.0),
    required(S::Slab, "width", Kind::ChoiceOr(FLANGE_WIDTHS, D::Length), "Effective width, including the web, or a rule for it: `en1992`, EN 1992-1-1, 5.3.2.1, with 0.85 of the length of end spans and 0.7 of inner ones; `aci318`, ACI 318-19, 6.3.2.1. Spans are measured between axes.").usual("an effective width", 0.1, 10.0),
    optional(S::Slab, "spacing", Quantity(D::Length), "Clear distance to the next beam; the rules need it.").usual("a beam spacing", 0.3, 20.0),
    default(S::Slab, "sides", Count, "2", "1 for a slab on one side only."),
    optional(S::Beam, "width", Quantity(D::Length), "Width, perpendicular to the direction of bending.").usual("a section width", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::Beam, "depth", Quantity(D::Length), "Depth, in the direction of bending.").usual("a section depth", 0.05, 5.0).possible(0.005, 10.0),
    optional(S::Beam, "profile", TextOrTable(S::Profile), "Steel profile instead of width and depth, as for columns."),
    optional(S::Beam, "axis", Choice(AXES), "Axis of the profile for bending; `strong` if not given."),
    optional(S::Beam, "yield_strength", Quantity(D::Stress), "Yield strength of the steel of a profile, as for columns.").usual("a yield strength", 1e8, 2e9),
    optional(S::Beam, "slab", Kind::Table(S::Slab), "Slab that acts as the upper flange of a beam with width and depth: `{ depth = \"150 mm\", width = \"en1992\", spacing = \"4.7 m\" }`. Hinges ignore the slab."),
    optional(S::Beam, "EI", Quantity(D::FlexuralRigidity), "Flexural rigidity, instead of width and depth.").usual("a flexural rigidity", 1e5, 1e12),
    optional(S::Beam, "EA", Quantity(D::Force), "Axial rigidity, with EI; needed for axially flexible beams.").usual("an axial rigidity", 1e5, 1e13),
    optional(S::Beam, "GA", Quantity(D::Force), "Shear rigidity G·A_s, with EI; needed for beams with shear deformation.").usual("a shear rigidity", 1e4, 1e13),
    default(S::Beam, "bay", Kind::FromTo, "all", "Bay, counted from 1 at the left; or the first and the last."),
    default(S::Beam, "floors", Kind::FromTo, "all", "Floor, counted from 1; or the first and the last."),
    default(S::Beam, "omit", Flag, "false", "Omit the beams at these positions."),

    optional(S::Column, "concrete", Kind::ConcreteOr(SECTION_CONCRETES), "Concrete of the section: a grade of GB 50010 (C30) or EN 1992-1-1 (C30/37), the cylinder strength of ACI 318 (f'c = 4 ksi), or a prismatic strength; by default that of the building.").usual("a concrete strength", 1e6, 2e8),
    optional(S::Column, "steel", GradeOr(STEELS), "Steel of the bars: a grade of GB 50010 (HRB400), EN 10080 (B500, ductility class B if no letter is given) or ASTM (Grade 60, in ksi, or Grade 420, in MPa), or its yield strength; needed with bars.").usual("a yield strength", 5e7, 2e9),
    default(S::Column, "strength", Choice(STRENGTHS), "\"characteristic\"", "Strength level of a grade."),
    optional(S::Column, "bars", TextOrTable(S::Bars), "Reinforcement, such as \"12 d20 (around)\"; diameters in mm."),
    default(S::Column, "cover", Quantity(D::Length), "\"35 mm\"", "Concrete cover of the bars.").usual("a concrete cover", 0.005, 0.2).possible(0.0005, 1.0),
    optional(S::Column, "ties", Text, "Ties that confine the core and resist shear, such as \"d10 @ 100 mm\", or \"4 d10 @ 100 mm\" with four legs."),
    default(S::Column, "axial_load", WordOr("from gravity", D::Force), "\"from gravity\"", "Axial compression used to compute the yield moment.").usual("an axial force", 100.0, 1e9).signed(),
    optional(S::Beam, "concrete", Kind::ConcreteOr(SECTION_CONCRETES), "Concrete of the section: a grade of GB 50010 (C30) or EN 1992-1-1 (C30/37), the cylinder strength of ACI 318 (f'c = 4 ksi), or a prismatic strength; by default that of the building.").usual("a concrete strength", 1e6, 2e8),
    optional(S::Beam, "steel", GradeOr(STEELS), "Steel of the bars: a grade of GB 50010 (HRB400), EN 10080 (B500, ductility class B if no letter is given) or ASTM (Grade 60, in ksi, or Grade 420, in MPa), or its yield strength; needed with bars.").usual("a yield strength", 5e7, 2e9),
    default(S::Beam, "strength", Choice(STRENGTHS), "\"characteristic\"", "Strength level of a grade."),
    optional(S::Beam, "bars", TextOrTable(S::Bars), "Reinforcement, such as \"4 d25 top, 4 d25 bottom\"; diameters in mm."),
    default(S::Beam, "cover", Quantity(D::Length), "\"35 mm\"", "Concrete cover of the bars.").usual("a concrete cover", 0.005, 0.2).possible(0.0005, 1.0),
    optional(S::Beam, "ties", Text, "Ties that confine the core and resist shear, such as \"d10 @ 100 mm\", or \"4 d10 @ 100 mm\" with four legs."),

    optional(S::Bars, "top", Text, "Bars in the upper row, such as \"4 d25\"."),
    optional(S::Bars, "bottom", Text, "Bars in the lower row."),
    optional(S::Bars, "sides", Text, "Bars between these rows, half on each side."),

    default(S::StiffnessFactor, "column", Quantity(D::Dimensionless), "1", "Factor on EI of the columns.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),
    default(S::StiffnessFactor, "beam", Quantity(D::Dimensionless), "1", "Factor on EI of the beams.").usual("a stiffness factor", 0.01, 10.0).possible(1e-6, 1e6),

    default(S::Axial, "columns", Choice(AXIAL), "as without axial", "Axial deformation of columns."),
    default(S::Axial, "beams", Choice(AXIAL), "\"rigid\"", "Axial deformation of beams."),

    default(S::ShearDeformation, "columns", Choice(AXIAL), "\"rigid\"", "Shear deformation of columns."),
    default(S::ShearDeformation, "beams", Choice(AXIAL), "\"rigid\"", "Shear deformation of beams."),

    required(S::Foundation, "length", Quantity(D::Length), "Side along the row, or along x with a plan. The foundation is centred below the building, or below the plan of its lowest floor.").usual("a foundation side", 1.0, 200.0).possible(0.0, 2e3),
    required(S::Foundation, "width", Quantity(D::Length), "Side across the row.").usual("a foundation side", 1.0, 200.0).possible(0.0, 2e3),
    default(S::Foundation, "embedment", Quantity(D::Length), "0", "Depth over which its sides are in contact with soil.").usual("a foundation depth", 0.01, 30.0).possible(0.0, 200.0),
    required(S::Foundation, "mass", Quantity(D::Mass), "Mass of the foundation.").usual("a foundation mass", 100.0, 1e9),
    default(S::Foundation, "rotary_inertia", Quantity(D::PolarMass), "mass · length² / 12", "Rotary inertia about the axis across the row.").usual("a rotary inertia", 100.0, 1e12),
    default(S::Foundation, "torsional_stiffness", Quantity(D::RotationalStiffness), "that of [soil]; rigid with vertical_stiffness", "With a plan: spring against rotation about the vertical axis.").usual("a torsional stiffness", 1e5, 1e14),
    default(S::Foundation, "torsional_damping", Quantity(D::RotationalDamping), "from damping of [soil], without radiation", "With a plan: dashpot parallel to the torsional spring.").usual("a rotational dashpot coefficient", 100.0, 1e13),
    default(S::Foundation, "uplift", Flag, "false", "Whether the foundation can lift off the ground: contact springs along its length are compression-only, and the building moves vertically and rocks with the foundation. Requires gravity = true of the building."),
    optional(S::Foundation, "springs", Count, "uplift: number of contact springs, equally spaced from one end of the length to the other; at least 2."),
    default(S::Foundation, "springs_across", Count, "springs", "uplift with a plan: number of contact springs along the width. They form a grid and are compression-only."),
    optional(S::Foundation, "ends", Quantity(D::Dimensionless), "uplift: ratio of the stiffness of the two outermost springs of a side to that of the half strip each represents. By default it is chosen to match the rocking stiffness of [soil]; with only two springs, their positions match it. With vertical_stiffness it is 1.").usual("a stiffness ratio", 0.1, 100.0).possible(1e-6, 1e6),
    optional(S::Foundation, "vertical_stiffness", Quantity(D::Stiffness), "uplift: total stiffness of all contact springs, instead of [soil].").usual("a base stiffness", 1e4, 9e12),
    default(S::Foundation, "vertical_damping", Quantity(D::Damping), "0", "uplift with vertical_stiffness: total of the dashpots parallel to the contact springs, distributed in proportion to stiffness. They also act during uplift.").usual("a dashpot coefficient", 100.0, 1e11),
    default(S::Foundation, "sway_stiffness", WordOr("rigid", D::Stiffness), "\"rigid\"", "uplift with vertical_stiffness: horizontal spring to the ground; with a plan, in both directions.").usual("a base stiffness", 1e4, 9e11),
    default(S::Foundation, "sway_damping", Quantity(D::Damping), "0", "uplift with sway_stiffness: dashpot parallel to this spring.").usual("a dashpot coefficient", 100.0, 1e11),
    optional(S::Foundation, "bearing_strength", Quantity(D::Stress), "uplift: pressure at which the ground yields. The plastic part is permanent settlement. Without this key the ground is elastic.").usual("a bearing strength", 1e4, 1e7),
    default(S::Foundation, "bearing_hardening", Quantity(D::Dimensionless), "0", "uplift with bearing_strength: ratio of post-yield to initial stiffness, below 1.").usual("a stiffness ratio", 1e-6, 1.0).signed(),

    required(S::Isolation, "kind", Choice(ISOLATORS), "Type of the bearings; all values are totals of all bearings."),
    required(S::Isolation, "mat_mass", Quantity(D::Mass), "Mass of the base mat between the bearings and the building. The mat is floor 0.").usual("a mat mass", 100.0, 1e9),
    optional(S::Isolation, "stiffness", Quantity(D::Stiffness), "linear: stiffness. lead-rubber: initial stiffness. high-damping-rubber: effective stiffness, force over displacement in a test to `displacement`.").usual("a bearing stiffness", 1e4, 9e10),
    optional(S::Isolation, "yield", Quantity(D::Force), "lead-rubber: force at which the lead yields.").usual("a yield force", 100.0, 1e9),
    optional(S::Isolation, "post_yield", Quantity(D::Dimensionless), "lead-rubber: ratio of post-yield to initial stiffness, at least 0 and below 1.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::Isolation, "displacement", Quantity(D::Length), "high-damping-rubber: amplitude of the test that gave stiffness and damping_ratio.").usual("a bearing displacement", 0.01, 3.0),
    optional(S::Isolation, "yield_displacement", Quantity(D::Length), "high-damping-rubber: yield displacement, about 0.05 to 0.1 times the total thickness of rubber.").usual("a yield displacement of bearings", 1e-3, 0.3),
    optional(S::Isolation, "radius", OneOrMore(D::Length), "friction-pendulum: radius of the sliding surface. double-, triple-friction-pendulum: effective radii (radius minus height of the slider) of the two or four surfaces, from one outer surface to the other.").usual("a pendulum radius", 0.1, 20.0),
    optional(S::Isolation, "friction", Kind::NumbersOrTable(S::IsolationFriction), "friction-pendulum: coefficient of friction, or its dependence on speed. double-, triple-friction-pendulum: one for each surface.").usual("a coefficient of friction", 1e-3, 1.0),
    optional(S::Isolation, "capacity", Quantities(D::Length), "double-, triple-friction-pendulum: displacement capacity of the slider on each surface, up to its rim.").usual("a displacement capacity", 0.01, 3.0),
    optional(S::Isolation, "bounds", Kind::Table(S::IsolationBounds), "Lower and upper bounds of the bearing properties. `jostle run` then also runs both bounds and reports the envelope."),
    default(S::Isolation, "slip_displacement", Quantity(D::Length), "\"1 mm\"", "Pendulums: displacement at which friction is fully mobilised; with several surfaces, that of the smallest friction. If friction depends on speed, it refers to the fast coefficient, so that the stiffness before slip is fast × weight / slip_displacement at any speed.").usual("a slip displacement", 1e-5, 0.1),
    default(S::Isolation, "damping", Quantity(D::Damping), "0", "Dashpot parallel to the bearings.").usual("a dashpot coefficient", 100.0, 1e10),
    optional(S::Isolation, "damping_ratio", Quantity(D::Dimensionless), "linear: fraction of critical damping of the whole mass on the bearings, instead of damping. high-damping-rubber: damping ratio of the test cycle, its energy ÷ (2π stiffness displacement²).").usual("a damping ratio", 1e-4, 1.0),
    optional(S::Isolation, "stop", Kind::Table(S::IsolationStop), "Elastic stops of the mat, or hardening of the bearings. With a plan the stop is a ring, the same in all directions."),
    optional(S::Isolation, "bearings", Kind::PlanPoints, "With a plan: positions of the bearings, relative to the origin of the plan; all bearings are equal. By default, four bearings represent an even distribution over the plan of the lowest floor.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    optional(S::Isolation, "limit", Quantity(D::Length), "Displacement capacity of the bearings. A run that exceeds it warns.").usual("a bearing displacement", 0.01, 3.0),
    default(S::Isolation, "weight", Quantity(D::Force), "(building + mat) · 9.80665 m/s2", "Weight on the bearings.").usual("a weight", 1e3, 1e10),

    required(S::IsolationFriction, "slow", Quantity(D::Dimensionless), "Coefficient of friction at zero speed.").usual("a coefficient of friction", 1e-3, 1.0),
    required(S::IsolationFriction, "fast", Quantity(D::Dimensionless), "Coefficient of friction at high speed.").usual("a coefficient of friction", 1e-3, 1.0),
    required(S::IsolationFriction, "rate", Quantity(D::Slowness), "Rate constant of the increase with speed: friction = fast − (fast − slow)·exp(−rate·speed).").usual("a friction rate", 0.1, 1e3),

    required(S::IsolationBounds, "lower", NumberOrTable(S::BearingFactors), "Lower-bound factor on stiffness and yield force of rubber, and on friction of pendulums, above 0 and at most 1. Choose it from tests, the supplier or a code.").usual("a bearing factor", 0.3, 1.0).possible(1e-6, 1e6),
    required(S::IsolationBounds, "upper", NumberOrTable(S::BearingFactors), "Upper-bound factor on the same properties, at least 1.").usual("a bearing factor", 1.0, 4.0).possible(1e-6, 1e6),
    default(S::BearingFactors, "stiffness", Quantity(D::Dimensionless), "1", "Factor on the stiffness of rubber bearings. It does not apply to pendulums, whose stiffness follows from the surface radius.").usual("a bearing factor", 0.3, 4.0).possible(1e-6, 1e6),
    default(S::BearingFactors, "strength", Quantity(D::Dimensionless), "1", "Factor on the yield force of lead, or on friction. It does not apply to linear bearings.").usual("a bearing factor", 0.3, 4.0).possible(1e-6, 1e6),
    optional(S::IsolationStop, "at", Quantity(D::Length), "Displacement of the mat at which it reaches the stop on either side.").usual("a stop distance", 1e-3, 5.0),
    optional(S::IsolationStop, "stiffness", Quantity(D::Stiffness), "Stiffness of each stop.").usual("a stop stiffness", 1e4, 9e11),
    optional(S::IsolationStop, "left", Kind::Table(S::StopSide), "A stop on the left only, instead of on both sides."),
    optional(S::IsolationStop, "right", Kind::Table(S::StopSide), "A stop on the right only, instead of on both sides."),

    required(S::StopSide, "at", Quantity(D::Length), "Displacement of the mat at which it reaches the stop.").usual("a stop distance", 1e-3, 5.0),
    required(S::StopSide, "stiffness", Quantity(D::Stiffness), "Stiffness of the stop.").usual("a stop stiffness", 1e4, 9e11),

    default(S::ShearBase, "horizontal_stiffness", WordOr("rigid", D::Stiffness), "\"rigid\"", "Horizontal spring to the ground.").usual("a base stiffness", 1e4, 9e11),
    default(S::ShearBase, "horizontal_damping", Quantity(D::Damping), "0", "Dashpot parallel to the horizontal spring.").usual("a dashpot coefficient", 100.0, 1e11),
    optional(S::ShearBase, "horizontal_hinge", Kind::Table(S::BaseSliding), "Yielding of the horizontal spring; without this table the spring is elastic."),
    default(S::ShearBase, "mass", Quantity(D::Mass), "0", "Mass of the footing.").usual("a footing mass", 10.0, 1e9),
    default(S::PlanBase, "rotational_stiffness", WordOr("rigid", D::RotationalStiffness), "\"rigid\"", "With a plan: spring against rocking, which moves floors along x by their height times the rotation. It also applies across, unless across gives another value.").usual("a rotational stiffness", 1e4, 1e14),
    default(S::PlanBase, "rotational_damping", Quantity(D::RotationalDamping), "0", "Dashpot parallel to the rocking spring.").usual("a rotational dashpot coefficient", 100.0, 1e13),
    default(S::PlanBase, "torsional_stiffness", WordOr("rigid", D::RotationalStiffness), "\"rigid\"", "With a plan: spring against rotation about the vertical axis. The springs act at the centroid of the plan of the lowest floor; the mass of the footing is spread over this plan.").usual("a torsional stiffness", 1e5, 1e14),
    default(S::PlanBase, "torsional_damping", Quantity(D::RotationalDamping), "0", "Dashpot parallel to the torsional spring.").usual("a rotational dashpot coefficient", 100.0, 1e13),
    optional(S::PlanBase, "across", Kind::Table(S::AcrossBase), "With a plan: springs and dashpots across, if they differ from those along x."),
    default(S::AcrossBase, "horizontal_stiffness", WordOr("rigid", D::Stiffness), "that along x", "Horizontal spring across.").usual("a base stiffness", 1e4, 9e11),
    default(S::AcrossBase, "horizontal_damping", Quantity(D::Damping), "that along x", "Dashpot parallel to the horizontal spring across.").usual("a dashpot coefficient", 100.0, 1e11),
    default(S::AcrossBase, "rotational_stiffness", WordOr("rigid", D::RotationalStiffness), "that along x", "Spring against rocking that moves floors across.").usual("a rotational stiffness", 1e4, 1e14),
    default(S::AcrossBase, "rotational_damping", Quantity(D::RotationalDamping), "that along x", "Dashpot parallel to the rocking spring across.").usual("a rotational dashpot coefficient", 100.0, 1e13),
    default(S::FrameBase, "vertical_stiffness", WordOr("rigid", D::Stiffness), "\"rigid\"", "Vertical spring to the ground.").usual("a base stiffness", 1e4, 9e12),
    default(S::FrameBase, "vertical_damping", Quantity(D::Damping), "0", "Dashpot parallel to the vertical spring.").usual("a dashpot coefficient", 100.0, 1e11),
    default(S::FrameBase, "uplift", Flag, "false", "Whether column bases can lift off: the vertical spring is compression-only. Requires vertical_stiffness, and gravity = true of the building."),
    default(S::FrameBase, "rotational_stiffness", WordOr("rigid", D::RotationalStiffness), "\"rigid\"", "Rotational spring to the ground.").usual("a rotational stiffness", 1e4, 1e12),
    optional(S::FrameBase, "rotational_hinge", Kind::Table(S::BaseRocking), "Yielding of the rotational spring; without this table the spring is elastic."),
    default(S::FrameBase, "rotational_damping", Quantity(D::RotationalDamping), "0", "Dashpot parallel to the rotational spring.").usual("a rotational dashpot coefficient", 100.0, 1e11),

    default(S::FibreLimits, "spalling", Quantity(D::Dimensionless), "crushing strain of the unconfined concrete", "Compressive strain at which unconfined concrete spalls.").usual("a strain", 1e-3, 2e-2),
    default(S::FibreLimits, "crushing", Quantity(D::Dimensionless), "0.004 + 1.4 ρ_s f_y ε_su/f_cc", "Compressive strain at which the confined concrete crushes.").usual("a strain", 2e-3, 0.2),
    optional(S::FibreLimits, "buckling", Quantity(D::Dimensionless), "Tensile strain of bars beyond which they buckle on load reversal. No rule computes it; without this key bar buckling is not checked.").usual("a strain", 2e-3, 0.2),
    default(S::FibreLimits, "fracture", Quantity(D::Dimensionless), "rupture strain of the steel", "Tensile strain at which bars fracture.").usual("a strain", 5e-3, 0.5),
    required(S::HingeSurface, "axial", Quantities(D::Force), "Axial forces at the corners of the surface in ascending order, tension positive: 3 to 12, the first in compression and the last in tension.").usual("an axial force", 1e3, 1e9).signed(),
    required(S::HingeSurface, "moment", Quantities(D::Moment), "Moment capacity at each of them, at least 0; the surface is the same for negative moments, and must be convex.").usual("a moment", 1e3, 1e9),
    required(S::SpaceSurface, "axial", Quantities(D::Force), "Axial forces at the corners of the surface in ascending order, tension positive: 3 to 12, the first in compression and the last in tension.").usual("an axial force", 1e3, 1e9).signed(),
    required(S::SpaceSurface, "moment", Quantities(D::Moment), "Moment capacity at each of them in the vertical plane along x, at least 0; the surface is the same for negative moments, and must be convex.").usual("a moment", 1e3, 1e9),
    default(S::SpaceSurface, "across", Quantities(D::Moment), "moment", "The same in the vertical plane along y.").usual("a moment", 1e3, 1e9),
    required(S::FibreSteel, "rule", Choice(FIBRE_STEELS), "Hysteresis rule of the bars."),
    default(S::FibreSteel, "R0", Quantity(D::Dimensionless), "20", "menegotto-pinto: exponent of the first curve, 1 or more; smaller values give a more gradual transition.").usual("an exponent", 5.0, 30.0),
    default(S::FibreSteel, "cR1", Quantity(D::Dimensionless), "0.925", "menegotto-pinto: fraction by which plastic deformation can reduce the exponent.").usual("a fraction of an exponent", 0.5, 0.97),
    default(S::FibreSteel, "cR2", Quantity(D::Dimensionless), "0.15", "menegotto-pinto: ratio of plastic to yield deformation at which half of that reduction is reached.").usual("a deformation ratio", 0.01, 1.0),
    default(S::RigidEnds, "beams", Quantity(D::Length), "0", "Distance from the axis of a column to the point where its beams begin to bend.").usual("a rigid end", 0.02, 2.0),
    default(S::RigidEnds, "columns", Quantity(D::Length), "0", "Distance from the axis of a beam to the points where the columns below and above begin to bend; columns have no rigid end at the ground.").usual("a rigid end", 0.02, 2.0),
    required(S::BeamJoint, "rotational_stiffness", Quantity(D::RotationalStiffness), "Rotational stiffness of the connection before it yields.").usual("a rotational stiffness", 1e4, 1e12),
    required(S::BeamJoint, "hinge", Kind::Table(S::BaseRocking), "Yielding of the connection."),
    optional(S::SpaceJoint, "x", Kind::Table(S::BeamJoint), "Connections of beams along x alone, instead of the keys above."),
    optional(S::SpaceJoint, "y", Kind::Table(S::BeamJoint), "Connections of beams across alone."),
    default(S::Joint, "horizontal_stiffness", WordOr("rigid", D::Stiffness), "\"rigid\"", "Horizontal stiffness between beam end and column.").usual("a joint stiffness", 1e4, 9e12),
    default(S::Joint, "vertical_stiffness", WordOr("rigid", D::Stiffness), "\"rigid\"", "Vertical stiffness between beam end and column.").usual("a joint stiffness", 1e4, 9e12),
    optional(S::Joint, "hinge", Kind::Table(S::BaseRocking), "Yielding of the connection, instead of hinges of beams; without this table the connection is elastic. Requires rotational_stiffness."),
    default(S::Joint, "rotational_stiffness", WordOr("rigid", D::RotationalStiffness), "\"rigid\"", "Rotational stiffness of the connection between beam end and column.").usual("a rotational stiffness", 1e4, 1e12),

    default(S::Damping, "ratio", Quantity(D::Dimensionless), "0.05", "Fraction of critical damping in the given modes.").usual("a damping ratio", 1e-4, 1.0),
    default(S::Damping, "along", Choice(&["x", "y", "both"]), "\"x\"", "With a plan: direction whose modes are counted, as if the building could move in that direction only. \"both\": the lower of the two frequencies of the first of modes, and the higher of the two frequencies of the second, so that no mode between them exceeds the ratio in either direction."),
    default(S::Damping, "modes", Modes, "[1, 3]; [1, 2] with two lateral modes, [1] with one", "Lateral modes that have this ratio. If fewer than two modes carry 1 % of the mass, as above a soft storey, further sway modes are used. \"all\": same ratio in every mode (elastic buildings, modal solver only)."),
    optional(S::Damping, "alpha", Quantity(D::Frequency), "Coefficient of mass-proportional (Rayleigh) damping, instead of ratio.").usual("a Rayleigh coefficient", 1e-4, 100.0),
    optional(S::Damping, "beta", Quantity(D::Time), "Coefficient of stiffness-proportional (Rayleigh) damping, instead of ratio.").usual("a Rayleigh coefficient", 1e-7, 1.0),
    default(S::Damping, "relative_to", Choice(&["foundation", "ground"]), "\"foundation\"", "On a foundation: reference of mass-proportional damping. \"foundation\" does not damp rigid-body sway and rocking; \"ground\" damps every mass and rotary inertia."),
    default(S::Damping, "yielding", Choice(&["initial", "tangent", "none"]), "\"initial\" for storeys, columns and walls in plan; \"none\" for hinges of members, braces and infill panels", "Stiffness-proportional damping of parts that yield: from their initial stiffness, from their tangent stiffness, or none. It never acts on isolators, bases, soil or columns that fail in shear."),

    required(S::RotationLimit, "of", Choice(LIMITED_MEMBERS), "Members: columns (including walls) or beams."),
    default(S::RotationLimit, "line", Kind::FromTo, "all", "columns of plane frames: column line, counted from 1; or the first and the last."),
    default(S::RotationLimit, "storeys", Kind::FromTo, "all", "columns: storey, counted from 1; or the first and the last."),
    default(S::RotationLimit, "bay", Kind::FromTo, "all", "beams of plane frames: bay, counted from 1; or the first and the last."),
    default(S::RotationLimit, "floors", Kind::FromTo, "all", "beams: floor, counted from 1; or the first and the last."),
    default(S::RotationLimit, "measure", Choice(ROTATION_MEASURES), "\"plastic\"", "Rotation that is limited: plastic rotation of the hinge beyond yield, or chord rotation of hinge and member together, in double curvature."),
    required(S::RotationLimit, "limits", Kind::Table(S::RotationLevels), "Rotation limit of each level; at least one level is needed."),
    optional(S::RotationLevels, "io", Quantity(D::Dimensionless), "Immediate occupancy.").usual("a rotation", 1e-4, 0.2),
    optional(S::RotationLevels, "ls", Quantity(D::Dimensionless), "Life safety.").usual("a rotation", 1e-4, 0.2),
    optional(S::RotationLevels, "cp", Quantity(D::Dimensionless), "Collapse prevention.").usual("a rotation", 1e-4, 0.2),

    optional(S::ShearFailure, "rule", Choice(SHEAR_RULES), "Rule for the shear strength of columns with bars and ties, under their axial load."),
    optional(S::ShearFailure, "strength", PerStorey(D::Force), "Shear strength of the columns, instead of rule.").usual("a shear strength", 100.0, 1e9),
    default(S::ShearFailure, "slope", PerStorey(D::Stiffness), "by Elwood and Moehle, from axial load and ties", "Loss of shear force per drift after failure; required with strength.").usual("a slope", 1e3, 9e10).signed(),
    default(S::ShearFailure, "axial_first", Choice(AXIAL_FIRST), "\"refuse\"", "rule: treatment of columns whose axial failure would precede shear failure, by Elwood and Moehle. \"refuse\" rejects the model. \"axial-limit\": shear decreases from the shear strength until the drift at axial failure; the axial load is kept."),
    default(S::ShearFailure, "residual", Quantity(D::Dimensionless), "0", "Ratio of residual shear strength to that at failure.").usual("a ratio", 1e-4, 1.0),
    default(S::ShearFailure, "ends", Choice(SHEAR_ENDS), "both where neighbours can hit a column between floors", "Ends of columns that have shear springs; for frames without a plan."),
    required(S::Hinges, "rule", Choice(FRAME_HINGE_RULES), "Unloading and reloading rule of hinges. fibre: column ends consist of concrete and steel fibres, so that their strength depends on the axial force. surface: column ends yield on a surface of axial force and moment, with associated flow."),
    default(S::Hinges, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::Hinges, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::Hinges, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::Hinges, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    default(S::Hinges, "initial", WordOr("rigid", D::Dimensionless), "100; \"rigid\" from sections", "Stiffness of a hinge before cracking, in units of EI/L of its member.").usual("a hinge stiffness in units of EI/L", 0.1, 1e6),
    optional(S::Hinges, "from", Choice(HINGE_SOURCES), "Compute the moments from the reinforcement of columns and beams, or from profiles with `yield_strength`."),
    default(S::Hinges, "method", Choice(HINGE_METHODS), "\"formula\"", "Published formulas, or fibre analysis."),
    optional(S::Hinges, "column", TablePerStorey(S::Hinge), "Hinges of the columns; without this table they are elastic."),
    optional(S::Hinges, "beam", TablePerStorey(S::Hinge), "Hinges of the beams; without this table they are elastic."),
    optional(S::Hinges, "length", WordOr("paulay-priestley", D::Length), "Plastic hinge length of the fibres, or of ends on a surface; \"paulay-priestley\" is 0.08 L + 0.022 d f, with half the storey height L, the diameter d of the thickest bars and their yield strength f in MPa. Required with rule = \"fibre\" and rule = \"surface\".").usual("a hinge length", 0.02, 5.0),
    default(S::Hinges, "surface", Kind::Table(S::HingeSurface), "the interaction diagram of the section", "surface: yield surface of axial force and moment of columns."),
    default(S::Hinges, "post_yield", Quantity(D::Dimensionless), "0.01", "surface: ratio of post-yield stiffness to EA and EI over the length, at least 0 and below 1 (kinematic hardening).").usual("a stiffness ratio", 1e-6, 0.5),
    default(S::Hinges, "fibres", Count, "20", "Concrete layers over the depth of a column, 2 to 400."),
    default(S::Hinges, "ends", Choice(FIBRE_ENDS), "\"both\"", "Positions of the fibres or surfaces: at both ends of all columns, or only at the base of the lowest ones."),
    default(S::Hinges, "peak_strain", Quantity(D::Dimensionless), "that of the concrete, confined if there are ties", "Strain of concrete at its peak strength.").usual("a strain", 1e-3, 2e-2),
    default(S::Hinges, "residual", Quantity(D::Dimensionless), "0.2", "Ratio of residual to peak strength of crushed concrete.").usual("a ratio", 1e-3, 1.0),
    default(S::Hinges, "ultimate_strain", Quantity(D::Dimensionless), "from the straight line through its stress at the crushing strain", "Strain at which concrete reaches its residual strength.").usual("a strain", 2e-3, 0.3),
    default(S::Hinges, "hardening", Quantity(D::Dimensionless), "that of the steel", "Ratio of post-yield to elastic modulus of the bars.").usual("a stiffness ratio", 1e-4, 0.2),
    default(S::Hinges, "steel", TextOrTable(S::FibreSteel), "\"bilinear\"", "Hysteresis of the bars: bilinear, or `\"menegotto-pinto\"` with smooth curves; a table gives its parameters."),
    optional(S::Hinges, "limits", Kind::Table(S::FibreLimits), "Strain limits to check, instead of those that follow from the sections."),
    default(S::Hinges, "beam_rule", Choice(RULES), "\"peak-oriented\"", "Rule of the beam hinges if columns have fibres or surfaces; from = \"section\" computes their moments."),

    optional(S::Hinge, "cracking", Quantity(D::Moment), "Cracking moment.").usual("a cracking moment", 1e3, 1e9),
    optional(S::Hinge, "yield", Quantity(D::Moment), "Yield moment. If not given: plastic moment of a profile with `yield_strength`, in columns under their gravity load.").usual("a yield moment", 1e3, 1e9),
    optional(S::Hinge, "post_cracking", Quantity(D::Dimensionless), "Ratio of post-cracking to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::Hinge, "post_yield", Quantity(D::Dimensionless), "Ratio of post-yield to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::Hinge, "positive", Kind::Table(S::HingeSide), "Values with the bottom of a beam in tension."),
    optional(S::Hinge, "negative", Kind::Table(S::HingeSide), "Values with the top of a beam in tension."),
    optional(S::HingeSide, "cracking", Quantity(D::Moment), "Cracking moment of this side.").usual("a cracking moment", 1e3, 1e9),
    optional(S::HingeSide, "yield", Quantity(D::Moment), "Yield moment of this side; if not given, as without sides.").usual("a yield moment", 1e3, 1e9),
    optional(S::HingeSide, "post_cracking", Quantity(D::Dimensionless), "Ratio of post-cracking to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::HingeSide, "post_yield", Quantity(D::Dimensionless), "Ratio of post-yield to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    required(S::SpaceHinges, "rule", Choice(FRAME_HINGE_RULES), "Unloading and reloading rule of hinges. fibre: column ends consist of concrete and steel fibres, so that their strength depends on the axial force and the moment about the other axis. surface: column ends yield on a surface of axial force and both moments, with associated flow."),
    default(S::SpaceHinges, "surface", Kind::Table(S::SpaceSurface), "the interaction diagrams of the section", "surface: yield surface of axial force and moment of columns."),
    default(S::SpaceHinges, "exponent", Quantity(D::Dimensionless), "1.5", "surface: exponent a of (M_x/M_x,N)^a + (M_y/M_y,N)^a = 1 between both planes of bending, 1.05 to 10; usually up to 4.").usual("an exponent", 1.05, 4.0),
    default(S::SpaceHinges, "post_yield", Quantity(D::Dimensionless), "0.01", "surface: ratio of post-yield stiffness to EA and EI over the length, at least 0 and below 1 (kinematic hardening).").usual("a stiffness ratio", 1e-6, 0.5),
    default(S::SpaceHinges, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::SpaceHinges, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::SpaceHinges, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::SpaceHinges, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    default(S::SpaceHinges, "initial", WordOr("rigid", D::Dimensionless), "100", "Stiffness of a hinge before cracking, in units of EI/L of its member in the same plane.").usual("a hinge stiffness in units of EI/L", 0.1, 1e6),
    optional(S::SpaceHinges, "column", TablePerStorey(S::ColumnHinge), "Hinges of the columns; without this table they are elastic, except columns that have hinge."),
    optional(S::SpaceHinges, "beam", TablePerStorey(S::Hinge), "Hinges of the beams in both directions, in their vertical planes; without this table they are elastic, except beams that have hinge."),
    optional(S::SpaceHinges, "length", WordOr("paulay-priestley", D::Length), "Plastic hinge length of the fibres, or of ends on a surface; \"paulay-priestley\" is 0.08 L + 0.022 d f, with half the storey height L, the diameter d of the thickest bars and their yield strength f in MPa. Required with rule = \"fibre\" and rule = \"surface\".").usual("a hinge length", 0.02, 5.0),
    default(S::SpaceHinges, "fibres", Kind::OneOrTwo, "12", "Concrete fibres of a column along x and across, 2 to 100 each. A single number applies to the greater width, and the fibres are then as square as possible."),
    default(S::SpaceHinges, "ends", Choice(FIBRE_ENDS), "\"both\"", "Positions of the fibres or surfaces: at both ends of all columns, or only at the base of the lowest ones."),
    default(S::SpaceHinges, "peak_strain", Quantity(D::Dimensionless), "that of the concrete, confined if there are ties", "Strain of concrete at its peak strength.").usual("a strain", 1e-3, 2e-2),
    default(S::SpaceHinges, "residual", Quantity(D::Dimensionless), "0.2", "Ratio of residual to peak strength of crushed concrete.").usual("a ratio", 1e-3, 1.0),
    default(S::SpaceHinges, "ultimate_strain", Quantity(D::Dimensionless), "from the straight line through its stress at the crushing strain", "Strain at which concrete reaches its residual strength.").usual("a strain", 2e-3, 0.3),
    default(S::SpaceHinges, "hardening", Quantity(D::Dimensionless), "that of the steel", "Ratio of post-yield to elastic modulus of the bars.").usual("a stiffness ratio", 1e-4, 0.2),
    default(S::SpaceHinges, "steel", TextOrTable(S::FibreSteel), "\"bilinear\"", "Hysteresis of the bars: bilinear, or `\"menegotto-pinto\"` with smooth curves; a table gives its parameters."),
    optional(S::SpaceHinges, "limits", Kind::Table(S::FibreLimits), "Strain limits to check, instead of those that follow from the sections."),
    default(S::SpaceHinges, "beam_rule", Choice(RULES), "\"peak-oriented\"", "Rule of the beam hinges if columns have fibres or surfaces."),
    optional(S::ColumnHinge, "cracking", Quantity(D::Moment), "Cracking moment.").usual("a cracking moment", 1e3, 1e9),
    optional(S::ColumnHinge, "yield", Quantity(D::Moment), "Yield moment. If not given: plastic moment of a profile with `yield_strength`, in columns under their gravity load.").usual("a yield moment", 1e3, 1e9),
    optional(S::ColumnHinge, "post_cracking", Quantity(D::Dimensionless), "Ratio of post-cracking to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::ColumnHinge, "post_yield", Quantity(D::Dimensionless), "Ratio of post-yield to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::ColumnHinge, "positive", Kind::Table(S::HingeSide), "Values with the face at greater x, or further across, in tension; inside x or y if these are given."),
    optional(S::ColumnHinge, "negative", Kind::Table(S::HingeSide), "Values with the opposite face in tension."),
    optional(S::ColumnHinge, "x", Kind::Table(S::Hinge), "Bending in the vertical plane along x. Without x and y both planes have the same hinges; with one of them, the other plane is elastic. Values not given here are those of the hinge."),
    optional(S::ColumnHinge, "y", Kind::Table(S::Hinge), "Bending in the vertical plane across."),

    required(S::BaseRocking, "rule", Choice(RULES), "Unloading and reloading rule."),
    default(S::BaseRocking, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::BaseRocking, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::BaseRocking, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::BaseRocking, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    optional(S::BaseRocking, "cracking", Quantity(D::Moment), "Moment at the first corner; not for bilinear.").usual("a cracking moment", 1e3, 1e9),
    optional(S::BaseRocking, "yield", Quantity(D::Moment), "Moment at yield.").usual("a yield moment", 1e3, 1e9),
    optional(S::BaseRocking, "post_cracking", Quantity(D::Dimensionless), "Ratio of the stiffness after the first corner to rotational_stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::BaseRocking, "post_yield", Quantity(D::Dimensionless), "Ratio of the stiffness after yield to rotational_stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),

    required(S::BaseSliding, "rule", Choice(RULES), "Unloading and reloading rule of the base."),
    default(S::BaseSliding, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::BaseSliding, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::BaseSliding, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::BaseSliding, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    optional(S::BaseSliding, "cracking", Quantity(D::Force), "Force at the first corner; not for bilinear.").usual("a force at cracking", 100.0, 1e9),
    optional(S::BaseSliding, "yield", Quantity(D::Force), "Force at yield.").usual("a yield force", 100.0, 1e9),
    optional(S::BaseSliding, "post_cracking", Quantity(D::Dimensionless), "Ratio of the stiffness after the first corner to horizontal_stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::BaseSliding, "post_yield", Quantity(D::Dimensionless), "Ratio of the stiffness after yield to horizontal_stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),

    required(S::StoreyHinges, "rule", Choice(RULES), "Unloading and reloading rule of storeys."),
    default(S::StoreyHinges, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::StoreyHinges, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::StoreyHinges, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::StoreyHinges, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    optional(S::StoreyHinges, "cracking", PerStorey(D::Length), "Storey displacement at cracking; not for bilinear.").usual("a storey displacement at cracking", 1e-5, 1.0),
    optional(S::StoreyHinges, "yield", PerStorey(D::Length), "Storey displacement at yield.").usual("a storey displacement at yield", 1e-5, 1.0),
    optional(S::StoreyHinges, "post_cracking", PerStorey(D::Dimensionless), "Ratio of post-cracking to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::StoreyHinges, "post_yield", PerStorey(D::Dimensionless), "Ratio of post-yield to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::StoreyHinges, "x", Kind::Table(S::StoreyHingesOfAxis), "With a plan: yielding along x. Without x and y both directions yield alike; with one of them, the other direction is elastic."),
    optional(S::StoreyHinges, "y", Kind::Table(S::StoreyHingesOfAxis), "With a plan: yielding across."),
    optional(S::StoreyHingesOfAxis, "cracking", PerStorey(D::Length), "Displacement at cracking in this direction; not for bilinear.").usual("a storey displacement at cracking", 1e-5, 1.0),
    optional(S::StoreyHingesOfAxis, "yield", PerStorey(D::Length), "Displacement at yield in this direction.").usual("a storey displacement at yield", 1e-5, 1.0),
    optional(S::StoreyHingesOfAxis, "post_cracking", PerStorey(D::Dimensionless), "Ratio of post-cracking to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::StoreyHingesOfAxis, "post_yield", PerStorey(D::Dimensionless), "Ratio of post-yield to initial stiffness.").usual("a stiffness ratio", 1e-6, 1.0).signed(),

    required(S::Pinching, "deformation", Quantity(D::Dimensionless), "Deformation at which reloading stiffens: 0 at the end of unloading, 1 on the unloading line of the peak; 0.8 is usual.").usual("a ratio", 1e-3, 2.0),
    required(S::Pinching, "force", Quantity(D::Dimensionless), "Ratio of the force at that point to the force at the peak, 0 to 1; 0.2 is usual.").usual("a ratio", 1e-3, 1.0),
    default(S::Damage, "ductility", Quantity(D::Dimensionless), "0", "Growth of the next peak per ductility reached on the opposite side, beyond its first corner.").usual("a damage coefficient", 1e-5, 10.0),
    default(S::Damage, "energy", Quantity(D::Dimensionless), "0", "Growth of the next peak per dissipated energy, divided by the energy of loading both sides to yield.").usual("a damage coefficient", 1e-5, 10.0),

    required(S::Gap, "between", Neighbours, "Names of the left and the right neighbour: buildings, or a [[wall]]; \"wall\" is a rigid wall at an end of the row. Between buildings with plans and at, the last [[gap]] may say \"all\" or omit this key: it then applies to all neighbours within reach that have no other [[gap]]."),
    optional(S::Gap, "width", PerContact(D::Length), "Width at rest, required except between buildings that have a plan and at: one value, or one for each contact, in the order of floors, or from the lowest contact up if floors are not listed.").range(GAP),
    default(S::Gap, "floors", FloorPairs, "\"common\"", "Contact locations: every pair of floors at equal height, \"all\" floors against floors or columns, listed pairs of floors or heights, or heights.").any("heights are compared with those of the floors"),
    default(S::Gap, "level_tolerance", Quantity(D::Length), "\"1 mm\"", "Floors whose heights differ by at most this much can be in contact.").usual("a level tolerance", 1e-5, 1.0).possible(0.0, 20.0),
    default(S::Gap, "law", Choice(LAWS), "\"hertz-damp\"", "Contact law."),
    optional(S::Gap, "formula", Text, "formula: the contact force in N, such as `\"k * d^1.5 * (1 + 0.6 * v / v0)\"`, in terms of indentation `d`, its rate `v`, impact speed `v0`, `stiffness` k, `restitution` e and effective mass `m`, all in SI. Operations `+ - * / ^ < >`; functions `sqrt`, `abs`, `exp`, `ln`, `tanh`, `min`, `max`, `if(condition, force, other force)`. A negative force is set to zero. The force must not decrease as `d` or `v` increases."),
    default(S::Gap, "stiffness", ContactStiffness, "\"2e9 N/m^1.5\" for Hertz laws", "Contact stiffness: N/m^1.5 for hertz, hertz-damp, ye, jankowski, bilinear and a formula that is proportional to d^1.5, N/m for the others and for bilinear with second_stiffness. For rubber, the secant stiffness at 0.8 of the thickness; for restitution, the stiffness during sustained contact.").usual("a contact stiffness", 1e5, 1e13),
    default(S::Gap, "restitution", Quantity(D::Dimensionless), "0.65", "Coefficient of restitution.").usual("a coefficient of restitution", 1e-3, 1.0),
    default(S::Gap, "restitution_is", Choice(RESTITUTION_IS), "\"input\"", "\"input\": e is used in the published formula. \"realised\": damping is calibrated so that free masses rebound with e."),

    optional(S::Gap, "damping", Quantity(D::Damping), "kelvin, kelvin-no-tension, and modified-kelvin with variant = \"mahmoud-jankowski\": dashpot of every contact instead of restitution, independent of the masses; between buildings with a plan that of a whole face.").usual("a dashpot coefficient", 100.0, 1e10),
    default(S::Gap, "variant", Choice(LAW_VARIANTS), "\"ye\"", "modified-kelvin: ye, damping proportional to the indentation; mahmoud-jankowski, damping during approach only."),
    default(S::Gap, "yield_share", Quantity(D::Dimensionless), "0.1", "bilinear: yield indentation ÷ greatest design indentation.").usual("a share", 1e-4, 1.0),
    optional(S::Gap, "design_speed", Quantity(D::Speed), "bilinear: impact speed used to compute its stiffnesses; by default the speed of each impact.").usual("an impact speed", 0.01, 20.0),
    optional(S::Gap, "second_stiffness", Quantity(D::Stiffness), "bilinear: stiffness after yield, instead of restitution; stiffness is then the first one, in N/m.").usual("a contact stiffness", 1e5, 1e13),
    optional(S::Gap, "yield", Quantity(D::Length), "bilinear, with second_stiffness: indentation at which it yields.").usual("a yield indentation", 1e-6, 0.1),
    optional(S::Gap, "crush", Kind::Table(S::Crush), "linear and hertz: crushing of the face, such as `{ force = \"600 kN\", hardening = 0.05 }`. Crushing is permanent and widens the gap."),
    optional(S::Gap, "thickness", Quantity(D::Length), "rubber: thickness of the bumper.").usual("a bumper thickness", 0.001, 1.0).possible(0.0, 10.0),
    default(S::Gap, "exponent", Quantity(D::Dimensionless), "2.65", "rubber: exponent of the compression.").usual("an exponent", 0.5, 10.0),
    optional(S::Gap, "stiffness_per_length", ContactStiffness, "Between buildings with a plan, instead of stiffness: stiffness of a face per metre of its length.").usual("a contact stiffness per length", 1e4, 1e13),
    default(S::Gap, "points", Count, "5", "Between buildings with a plan: contact points of a face, 2 to 9, by the Lobatto rule. Two points overestimate the rotational stiffness."),
    default(S::Gap, "reach", Quantity(D::Length), "\"0.5 m\"", "Between buildings with a plan: greatest distance of edges that can come into contact.").usual("a reach", 0.001, 50.0),
    default(S::Gap, "friction", Quantity(D::Dimensionless), "0", "Between buildings with a plan: coefficient of friction along faces, at least 0 and below 1; about 0.4 for concrete on concrete.").usual("a coefficient of friction", 1e-3, 1.0),
    optional(S::Gap, "tangential_stiffness", Quantity(D::Stiffness), "Between buildings with a plan, with friction: tangential stiffness of a whole face during sticking; by default 0.89 times the normal stiffness.").usual("a tangential stiffness", 1e4, 1e13),
    default(S::Gap, "minimum_separation", Quantity(D::Time), "0", "Impacts of one contact with less time between them count as one.").usual("a time", 1e-5, 10.0),

    required(S::Crush, "force", Quantity(D::Force), "Force at which crushing begins; between buildings with a plan that of a whole face.").usual("a crushing force", 1e3, 1e9),
    default(S::Crush, "hardening", Quantity(D::Dimensionless), "0", "Ratio of the stiffness during crushing to that at its onset, from 0 to below 1; with hertz below 2/3.").usual("a hardening ratio", 1e-4, 1.0),

    required(S::Link, "between", Neighbours, "Names of the left and the right neighbour; \"wall\" is a rigid wall at an end of the row. The same building twice: links between its floors."),
    default(S::Link, "floors", FloorPairs, "\"common\"", "Points that are joined, as for gaps. Inside one building: pairs of its floors, such as [[0, 1], [1, 2]]; 0 is its base.").any("heights are compared with those of the floors"),
    default(S::Link, "level_tolerance", Quantity(D::Length), "\"1 mm\"", "Floors whose heights differ by at most this much can be joined.").usual("a level tolerance", 1e-5, 1.0).possible(0.0, 20.0),
    optional(S::LinkLaw, "at", Kind::PlanPoints, "For buildings with a plan: both ends of the line of force. For a link, on the site; for a damper, relative to the origin of the plan, with the lower floor of a pair first.").usual("a length in plan", 1e-3, 5e3).possible(0.0, 1e5).signed(),
    required(S::SoilSpring, "floors", Kind::FromTo, "Floor in contact with the soil, counted from 1 above the base; or the first and the last."),
    required(S::SoilSpring, "stiffness", Quantity(D::Stiffness), "Force per displacement at one floor; with gapping that of the soil on one side.").usual("a soil stiffness", 1e5, 1e11),
    optional(S::SoilSpring, "strength", Quantity(D::Force), "Greatest force of the soil on one side of one floor, such as its passive resistance. Without strength and hinge the soil is elastic.").usual("a soil strength", 1e3, 1e9),
    default(S::SoilSpring, "post_yield", Quantity(D::Dimensionless), "0", "Ratio of the stiffness after strength is reached to the initial one.").usual("a stiffness ratio", 1e-4, 1.0),
    optional(S::SoilSpring, "hinge", Kind::Table(S::LinkHinge), "Corners of the curve, instead of strength, such as those of a p–y curve times the area of the floor; with gapping by the rule pinched."),
    default(S::SoilSpring, "gapping", Flag, "false", "Whether the soil on each side is compression-only and leaves a gap after it yields."),
    optional(S::SoilSpring, "dashpot", Quantity(D::Damping), "Dashpot parallel to the springs of one floor. It also acts while a gap is open.").usual("a soil dashpot", 1e3, 1e10),
    required(S::Damper, "floors", FloorPairs, "The two floors that it joins, such as [0, 1], or a list of such pairs. 0 is the mat of an isolated building, otherwise the base.").any("heights are compared with those of the floors"),

    default(S::LinkLaw, "law", Choice(LINK_LAWS), "\"linear\"", "linear, spring and dashpot in parallel; viscous, F = c v^α against the motion, with a spring in series if stiffness is given; maxwell, spring and dashpot in series; friction, a slider; yielding, a hysteresis rule; cable, tension only; stopper, compression only. All except linear require a direct solver: riccati, stiffness or product."),
    optional(S::LinkLaw, "stiffness", Quantity(D::Stiffness), "Force per change of length of each link. For viscous and maxwell, that of the spring in series; for yielding, that before the first corner. Not for friction.").usual("a link stiffness", 1e3, 9e12),
    optional(S::LinkLaw, "damping", LinkDamping, "Force per rate of change of length of each link; for viscous per power of the rate, in N.(s/m)^exponent. Not for friction, yielding and cable.").usual("a dashpot coefficient", 100.0, 1e10),
    default(S::LinkLaw, "exponent", Quantity(D::Dimensionless), "1", "viscous: exponent α of the rate, 0.1 to 2.").usual("an exponent", 0.1, 2.0),
    optional(S::LinkLaw, "slip_force", Quantity(D::Force), "friction: force at which it slips.").usual("a slip force", 100.0, 1e9),
    optional(S::LinkLaw, "stick_stiffness", Quantity(D::Stiffness), "friction: stiffness during sticking.").usual("a link stiffness", 1e3, 9e12),
    optional(S::LinkLaw, "hinge", Kind::Table(S::LinkHinge), "yielding: rule and corners."),
    default(S::LinkLaw, "slack", Quantity(D::Length), "0", "cable: elongation at which it becomes taut.").usual("a slack", 1e-5, 2.0),
    default(S::LinkLaw, "gap", Quantity(D::Length), "0", "stopper: shortening at which it closes.").usual("a gap", 1e-5, 2.0),

    required(S::LinkHinge, "rule", Choice(LINK_RULES), "Unloading and reloading rule of the link; `buckling` for braces only."),
    default(S::LinkHinge, "gamma", Quantity(D::Dimensionless), "0.4", "takeda: exponent of the unloading stiffness.").usual("an exponent", 1e-3, 1.0),
    optional(S::LinkHinge, "pinching", Kind::Table(S::Pinching), "pinched, required: point at which reloading stiffens."),
    default(S::LinkHinge, "unloading_exponent", Quantity(D::Dimensionless), "0", "pinched: exponent with which the unloading stiffness decreases as the peak grows, 0 to 1.").usual("an exponent", 1e-3, 1.0),
    optional(S::LinkHinge, "damage", Kind::Table(S::Damage), "pinched: growth of the peak deformations; without this table they do not grow."),
    optional(S::LinkHinge, "cracking", Quantity(D::Force), "Force at the first corner; not for bilinear.").usual("a force at cracking", 100.0, 1e9),
    optional(S::LinkHinge, "yield", Quantity(D::Force), "Force at yield.").usual("a yield force", 100.0, 1e9),
    optional(S::LinkHinge, "post_cracking", Quantity(D::Dimensionless), "Ratio of the stiffness after the first corner to the stiffness of the link.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::LinkHinge, "post_yield", Quantity(D::Dimensionless), "Ratio of the stiffness after yield to the stiffness of the link; below 0 only with residual, for a decreasing force.").usual("a stiffness ratio", 1e-6, 1.0).signed(),
    optional(S::Buckling, "yield_strength", Quantity(D::Stress), "Yield strength of the steel of a profile, instead of yield, slenderness and lever_arm.").usual("a yield strength", 1e8, 2e9),
    optional(S::Buckling, "curve", Choice(BUCKLING_CURVES), "Buckling curve: `a0` to `d` of EN 1993-1-1, 6.3.1.2, or `aisc360` of AISC 360, E3; without partial factors. Required without buckling."),
    optional(S::Buckling, "buckling", Quantity(D::Force), "Initial buckling force of the brace, instead of curve.").usual("a buckling force", 100.0, 1e9),
    default(S::Buckling, "effective_length", Quantity(D::Dimensionless), "1", "Ratio of buckling length to the length between the joints; also needed with slenderness.").usual("a length ratio", 0.3, 2.1),
    optional(S::Buckling, "slenderness", Quantity(D::Dimensionless), "Square root of yield force ÷ Euler force; from profile and yield_strength if not given.").usual("a slenderness", 0.05, 5.0),
    optional(S::Buckling, "lever_arm", Quantity(D::Length), "Plastic moment ÷ yield force of the section, 3/8 of the side of a thin square tube; from the profile if not given.").usual("a lever arm of a section", 2e-3, 0.5),
    default(S::Buckling, "later", Quantity(D::Dimensionless), "0.65", "Ratio of later buckling forces, after the brace has been straightened, to the first one, above 0 to 1; fibre analyses of square tubes give 0.55 to 0.72.").usual("a buckling force ratio", 0.2, 1.0),
    optional(S::LinkHinge, "residual", Quantity(D::Dimensionless), "pinched: ratio of the residual force, which remains after the decrease, to the yield force.").usual("a residual force ratio", 1e-3, 1.0),

    required(S::Wall, "name", Text, "Name used by gaps and links."),
    optional(S::Wall, "from", Kind::PlanPoints, "Among buildings with a plan: one end of its face, on the site. Seen from this end towards the other, the solid side is on the right.").usual("a position on the site", 1e-3, 1e7).possible(0.0, 1e8).signed(),
    optional(S::Wall, "to", Kind::PlanPoints, "The other end.").usual("a position on the site", 1e-3, 1e7).possible(0.0, 1e8).signed(),
    optional(S::Wall, "stiffness", Quantity(D::Stiffness), "Force per displacement at the contact, including the soil; without it the wall is rigid.").usual("a wall stiffness", 1e4, 9e11),
    optional(S::Wall, "position", Quantity(D::Length), "Position along the row, for apparent_velocity and coherency of [motion]; by default the wall moves with the ground of the building that it faces.").usual("a position along the row", 1e-3, 1e5).signed(),
    default(S::Wall, "damping", Quantity(D::Damping), "0", "Dashpot of the wall, for instance of the soil behind it.").usual("a dashpot coefficient", 100.0, 1e10),
    optional(S::Wall, "mass", Quantity(D::Mass), "Effective mass at the contact; required with a stiffness. It is 33/140 of the mass of a cantilever hit at its top.").usual("a wall mass", 10.0, 1e8),

    optional(S::Soil, "shear_wave_velocity", Quantity(D::Speed), "Shear wave velocity at the strains of the motion; required unless coupling gives matrices.").usual("a shear wave velocity", 50.0, 3000.0).possible(1.0, 10e3),
    optional(S::Soil, "density", Quantity(D::Density), "Density; required unless coupling gives matrices.").usual("a soil density", 1000.0, 3000.0).possible(100.0, 10e3),
    optional(S::Soil, "poisson_ratio", Quantity(D::Dimensionless), "Poisson's ratio, at least 0 and below 0.5; required unless coupling gives matrices.").usual("a Poisson's ratio", 0.01, 0.5),
    default(S::Soil, "damping", Quantity(D::Dimensionless), "0", "Hysteretic damping ratio of the soil at the strains of the motion.").usual("a damping ratio", 1e-4, 1.0),
    default(S::Soil, "coupling", ChoiceOrTable(SOIL_COUPLINGS, S::SoilCoupling), "\"none\"", "Interaction between foundations: none, static (surface foundations, by the flexibility of the half-space between them), or matrices over u and θ of every foundation from left to right."),

    required(S::SoilCoupling, "stiffness", Kind::NumberLists, "Stiffness over u_A, θ_A, u_B, θ_B, … in N/m, N and N·m, θ counter-clockwise: symmetric and positive definite.").any("the unit changes from entry to entry"),
    required(S::SoilCoupling, "damping", Kind::NumberLists, "Dashpots in the same order, in N·s/m, N·s and N·m·s: symmetric and positive semidefinite.").any("the unit changes from entry to entry"),

    default(S::Analysis, "step", WordOr("auto", D::Time), "\"auto\"", "Time step of free vibration.").usual("a time step", 1e-8, 0.1),
    default(S::Analysis, "contact_step", WordOr("auto", D::Time), "\"auto\"", "Time step while a contact is closed.").usual("a time step", 1e-9, 0.1),
    default(S::Analysis, "tolerance", Quantity(D::Dimensionless), "1e-3", "Largest error of a reported peak, relative to the greatest of its kind in the building or gap, with automatic steps; 1e-6 to 0.1. `promise` in `summary.json` reports whether it is met; docs/theory.md, section 14, lists the exceptions.").usual("a tolerance", 1e-6, 0.1),
    default(S::Analysis, "collapse_drift", Quantity(D::Dimensionless), "0.1", "Storey drift that defines collapse of a building that yields; the run ends there. Above 0 and at most 1.").usual("a storey drift", 0.01, 1.0),
    default(S::Analysis, "energy_tolerance", Quantity(D::Dimensionless), "1e-6", "Relative energy imbalance above which a run warns.").usual("a tolerance", 1e-9, 0.1),
    default(S::Analysis, "solver", Choice(SOLVERS), "\"auto\"", "Solution method for a step: Riccati transfer; direct stiffness, as a check; the published product of transfer matrices; modes, for elastic buildings; or power series in time, for shear buildings that yield. With automatic steps, \"auto\" uses modal for elastic buildings and series for shear buildings that yield; otherwise it uses riccati."),
    default(S::Analysis, "integrator", ChoiceOrTable(INTEGRATORS, S::Integrator), "\"average-acceleration\"", "Time integration rule."),
    default(S::Analysis, "accept_unusual", FlagOrTexts, "false", "Accept values outside their usual ranges: true for all, or a list of fields such as [\"building[0].spans\"]; \"analysis.step\" accepts a long run."),

    default(S::Output, "members", FlagOrTexts, "false", "Axial force, shear and moment of columns and beams of frames: true for the peaks of every member, or a list of members such as [\"J1.column.2.3\"] (line, storey) and [\"J1.beam.5.1\"] (floor, bay), whose histories are written as well."),
    default(S::Output, "links", Flag, "false", "Whether `history.parquet` contains the stroke and the speed of every link and damper, in addition to its force."),
    default(S::Output, "interval", Quantity(D::Time), "\"5 ms\"", "Minimum time between rows of histories in free vibration; every step with a closed contact has a row. A longer interval makes files smaller.").usual("a time between rows", 1e-4, 1.0),
    default(S::Output, "capacity", FlagOrChoices(CAPACITY_RULES), "all rules, if member forces are requested and ties, or yield strengths of profiles, are known", "Compare shear and moment of columns and beams with their capacity at every instant: a rule; a list of rules, of which the first governs; true for all, of which the rule of the country of the steel grade governs, or of the concrete where steel is a strength; or false for none. `aisc360` is for profiles with yield_strength, the others for reinforced concrete. Implies the forces of all members."),

    default(S::Output, "units", Choice(UNIT_SYSTEMS), "\"si\"", "Units of texts and pages: \"si\" for mm, m, kN, MPa and t; \"us\" for in, ft, kip, ksi, with masses as weights in kip. Files whose keys or columns name SI units, such as `summary.json`, Parquet and CSV, always use SI."),
    default(S::Output, "floor_spectra", Kind::FlagTextsOrTable(S::FloorSpectra), "false", "Response spectra of floors, with and without contact: true for every floor, a list of floors such as [\"J1.floor.5\"] or buildings such as [\"J1\"], or a table."),

    default(S::FloorSpectra, "floors", TextOrTexts, "every floor", "Floors such as \"J1.floor.5\", counted from 1, or all floors of a building, \"J1\"."),
    default(S::FloorSpectra, "damping", OneOrMore(D::Dimensionless), "0.05", "Damping ratio of the oscillators, from 0 to below 1: one value or a list.").usual("a damping ratio", 1e-4, 1.0),
    default(S::FloorSpectra, "periods", Quantities(D::Time), "100 from 0.02 s to 4 s", "Periods of the oscillators; 0 is a rigid oscillator.").usual("a period", 1e-3, 20.0),
    default(S::FloorSpectra, "low_pass", Quantity(D::Frequency), "\"25 Hz\"", "Corner frequency of the filter used for the filtered peak acceleration.").usual("a frequency", 0.1, 1e3),
    default(S::FloorSpectra, "order", Count, "4", "Order of this Butterworth filter, applied forwards and backwards: 2, 4, 6 or 8."),
    optional(S::Report, "project", Text, "Project name, for the title block of the report."),
    optional(S::Report, "client", Text, "Client, for the title block of the report."),
    optional(S::Report, "author", Text, "Author, for the title block of the report."),
    optional(S::Report, "date", Text, "Date for the title block of the report, printed as written."),
    optional(S::Report, "silence", TextOrTexts, "Checks to hide, by identifier or name, such as [\"A12\"] or [\"records\"]; the report lists the hidden ones. docs/checks.md describes all checks."),
    required(S::Site, "north", Quantity(D::Dimensionless), "Angle from x to north, counter-clockwise, such as \"90 deg\" if y points north. Plans show it as an arrow, and texts then also give directions of shaking as compass bearings.").usual("an angle", 1e-4, 6.3).signed(),
    default(S::Codes, "show", TextOrTexts, "all codes in `jostle gap` and reports, none in the terminal output of `jostle run`", "Codes to list: ubc97, gb50011, en1998, asce7, tbdy2018, is1893, ntc2018, e030, nsr10, iran2800."),
    default(S::Codes, "motion", Choice(MOTION_LEVELS), "\"full\"", "Whether the motion is the full design motion, or is reduced by q or R."),
    default(S::Codes, "floor_levels", Choice(FLOOR_LEVELS), "\"auto\"", "Whether all facing floors are at equal heights; auto uses the heights of the model."),
    default(S::Codes, "system", Choice(JOINT_SYSTEMS), "\"frame\"", "GB 50011: structural system that requires the wider joint."),
    default(S::Codes, "intensity", Count, "all four", "GB 50011: fortification intensity to list, 6, 7, 8 or 9."),
    default(S::Codes, "ground_acceleration", Quantity(D::Acceleration), "peak of the motion", "NTC 2018: a_g S.").usual("a design acceleration", 0.01, 50.0),
    default(S::Codes, "hazard", Choice(HAZARD_ZONES), "\"high\"", "NSR-10: seismic hazard of the site."),
    optional(S::Codes, "zone_factor", Quantity(D::Dimensionless), "E.030-2026: zone factor Z; without it the rule is omitted.").usual("a zone factor", 0.01, 5.0),
    optional(S::Codes, "soil_factor", Quantity(D::Dimensionless), "E.030-2026: soil factor S; without it the rule is omitted.").usual("a soil factor", 0.1, 10.0),
    default(S::Codes, "importance", Quantity(D::Dimensionless), "1", "Importance factor I or I_e of all buildings.").usual("an importance factor", 0.1, 10.0),
    optional(S::Codes, "behaviour_factor", Quantity(D::Dimensionless), "EN 1998-1, NTC 2018: behaviour factor q of all buildings; needed with motion = \"reduced\".").usual("a behaviour factor", 0.5, 20.0),
    optional(S::Codes, "response_modification", Quantity(D::Dimensionless), "Response modification R of all buildings: ASCE 7, TBDY 2018, IS 1893, E.030, Standard 2800. A rule that needs it has no result without it; TBDY 2018, IS 1893 and E.030 need it with motion = \"reduced\".").usual("a response modification", 0.5, 20.0),
    optional(S::Codes, "deflection_amplification", Quantity(D::Dimensionless), "C_d of all buildings: ASCE 7, Standard 2800, which have no result without it where they need it.").usual("a deflection amplification", 0.5, 20.0),
    default(S::Codes, "regular", Flag, "true", "E.030: whether all buildings are regular."),
    optional(S::BuildingCodes, "importance", Quantity(D::Dimensionless), "Importance factor I or I_e.").usual("an importance factor", 0.1, 10.0),
    optional(S::BuildingCodes, "behaviour_factor", Quantity(D::Dimensionless), "Behaviour factor q.").usual("a behaviour factor", 0.5, 20.0),
    optional(S::BuildingCodes, "response_modification", Quantity(D::Dimensionless), "Response modification R.").usual("a response modification", 0.5, 20.0),
    optional(S::BuildingCodes, "deflection_amplification", Quantity(D::Dimensionless), "Deflection amplification C_d.").usual("a deflection amplification", 0.5, 20.0),
    optional(S::BuildingCodes, "regular", Flag, "Whether the building is regular."),

    required(S::Integrator, "method", Choice(INTEGRATORS), "Integration method; all except average acceleration can add numerical damping."),
    default(S::Integrator, "beta", Quantity(D::Dimensionless), "0.25", "Newmark's beta.").usual("an integrator parameter", 1e-3, 10.0),
    default(S::Integrator, "gamma", Quantity(D::Dimensionless), "0.5", "Newmark's gamma.").usual("an integrator parameter", 1e-3, 10.0),
    default(S::Integrator, "alpha", Quantity(D::Dimensionless), "0.05", "Shift of HHT, 0 to 1/3.").usual("an integrator parameter", 1e-3, 1.0).signed(),
    default(S::Integrator, "spectral_radius", Quantity(D::Dimensionless), "0.8", "Spectral radius of generalized-alpha at high frequency, 0 to 1.").usual("an integrator parameter", 1e-3, 1.0).signed(),

    optional(S::Study, "title", Text, "Title of the study."),
    optional(S::Study, "base", Text, "The base model: a path relative to this file, or a built-in name."),
    optional(S::Study, "model", Kind::Any, "The base model as a table, instead of base."),
    optional(S::Study, "vary", Tables(&[S::Vary]), "Keys that vary; needed unless the base model lists several records."),
    optional(S::Study, "design", Kind::Table(S::Design), "Design of the cases; by default all combinations."),
    optional(S::Study, "histories", Kind::Any, "Numbers of the cases whose histories are written, from 0."),
    default(S::Study, "without_contact", Flag, "false", "Also run every case without contact; the table then has these results, and amplifications by contact."),
    optional(S::Study, "fragility", Tables(&[S::Fragility]), "Fragility curves to fit."),
    optional(S::Study, "ida", Tables(&[S::Ida]), "Curves of demand against intensity."),
    optional(S::Study, "sensitivity", Kind::Table(S::Sensitivity), "Results to rank."),
    optional(S::Study, "rose", Kind::Any, "Columns to plot against the angle of the motion, if motion.angle varies; by default forces, impacts and peaks of buildings."),
    optional(S::Study, "selection", Kind::Table(S::Selection), "Code check of the records."),

    optional(S::Vary, "path", Kind::Any, "Key of the model file to set, or a list of keys; needed without table."),
    optional(S::Vary, "name", Text, "Name of the column; by default the path."),
    default(S::Vary, "multiply", Flag, "false", "Multiply the value of the model by this value, instead of replacing it."),
    optional(S::Vary, "values", Kind::Any, "A list of values."),
    optional(S::Vary, "range", Kind::Table(S::Range), "Equally spaced values."),
    optional(S::Vary, "distribution", Kind::Table(S::Distribution), "A distribution to draw from."),
    optional(S::Vary, "table", Text, "CSV or Parquet file with a row for each case and a column for each key, named like the key, such as gap[0].width. An empty cell keeps the value of the model."),
    optional(S::Vary, "columns", TextOrTexts, "Columns of the table to use; by default all."),
    optional(S::Vary, "files", Text, "Record files that match a pattern, such as records/*.at2."),

    required(S::Range, "from", Kind::Any, "First value."),
    required(S::Range, "to", Kind::Any, "Last value."),
    required(S::Range, "count", Count, "Number of values."),
    default(S::Range, "spacing", Choice(SPACINGS), "\"linear\"", "Equal differences or equal ratios."),

    required(S::Distribution, "kind", Choice(DISTRIBUTIONS), "Type of distribution."),
    optional(S::Distribution, "from", Kind::Any, "Lower bound of a uniform distribution."),
    optional(S::Distribution, "to", Kind::Any, "Upper bound of a uniform distribution."),
    optional(S::Distribution, "mean", Kind::Any, "Mean."),
    optional(S::Distribution, "deviation", Kind::Any, "Standard deviation of a normal distribution."),
    optional(S::Distribution, "cov", Quantity(D::Dimensionless), "Coefficient of variation: standard deviation over mean.").usual("a coefficient of variation", 1e-4, 10.0),
    optional(S::Distribution, "median", Kind::Any, "Median of a lognormal distribution."),
    optional(S::Distribution, "dispersion", Quantity(D::Dimensionless), "Standard deviation of its natural logarithm.").usual("a dispersion", 1e-4, 10.0),
    optional(S::Distribution, "low", Kind::Any, "Lower truncation."),
    optional(S::Distribution, "high", Kind::Any, "Upper truncation."),

    default(S::Design, "kind", Choice(DESIGNS), "\"factorial\"", "Type of design."),
    default(S::Design, "sampling", Choice(SAMPLINGS), "\"latin-hypercube\"", "Sampling of distributions that are combined with crossed or zipped lists."),
    optional(S::Design, "samples", Count, "Number of samples."),
    default(S::Design, "seed", Count, "0", "Random seed."),
    default(S::Design, "quantiles", Kind::Any, "[0.1, 0.9]", "Low and high quantiles of one-at-a-time designs."),
    optional(S::Design, "correlation", Tables(&[S::Correlation]), "Correlations of normal scores (Gaussian copula)."),
    required(S::Correlation, "between", Neighbours, "Names of two factors."),
    required(S::Correlation, "value", Quantity(D::Dimensionless), "Their correlation.").usual("a correlation", 1e-4, 1.0).signed(),

    required(S::Fragility, "intensity", Text, "Column with the intensity."),
    default(S::Fragility, "demand", Text, "\"impact_count\"", "Column with the demand."),
    default(S::Fragility, "threshold", Kind::Any, "0", "The event is demand above this value."),
    optional(S::Fragility, "by", Kind::Any, "Factors; a separate curve is fitted for each of their values."),
    default(S::Fragility, "method", Choice(FRAGILITY_METHODS), "\"stripes\"", "Maximum likelihood of outcomes; regression of logarithms; or this regression combined with logistic regressions for zero demands and for collapse."),
    default(S::Fragility, "bootstrap", Count, "500", "Number of bootstrap fits for the confidence band."),
    default(S::Fragility, "confidence", Quantity(D::Dimensionless), "0.9", "Fraction of the bootstrap fits inside the band. With fewer than seven records the band does not represent other records.").usual("a confidence", 0.1, 1.0),

    required(S::Ida, "intensity", Text, "Column with the intensity."),
    required(S::Ida, "demand", Text, "Column with the demand."),

    required(S::Sensitivity, "responses", Kind::Any, "Columns of the results."),

    required(S::Selection, "spectrum", TextOrTable(S::Spectrum), "Design spectrum of the code: a table as in motion.match, or a file of periods and accelerations."),
    optional(S::Selection, "artificial", Kind::Any, "Names of artificial records in the study or its model; artificial built-in records need not be listed."),
    default(S::Selection, "periods", Quantities(D::Time), "those of every building", "Main periods of the structure.").usual("a period", 0.005, 20.0),
    default(S::Selection, "mass_ratios", Quantities(D::Dimensionless), "1 each", "Effective mass ratios of these periods.").usual("a mass ratio", 1e-4, 1.0),
    default(S::Selection, "damping", Quantity(D::Dimensionless), "0.05", "Damping ratio of all spectra.").usual("a damping ratio", 1e-4, 1.0),
    default(S::Selection, "pga", Quantity(D::Acceleration), "that of the code", "Peak acceleration to which every motion is scaled first; a match in the model takes precedence.").range(PEAK_ACCELERATION),
    default(S::Selection, "unscaled", Flag, "false", "Use the motions as recorded."),

    optional(S::Comparison, "table_acceleration", Text, "Column of the table acceleration: its name, or its number, from 1 for the first column after the times."),
    optional(S::Comparison, "table_displacement", Text, "Column of the table displacement, instead; it is differentiated twice."),
    default(S::Comparison, "reverse", Flag, "false", "Change the sign of the table's motion."),
    optional(S::Comparison, "low_pass", Quantity(D::Frequency), "Corner of a Butterworth filter of order 4, applied forwards and backwards to the table acceleration.").usual("a frequency", 0.1, 1e3),
    default(S::Comparison, "start", Quantity(D::Time), "the first instant", "Time in the data at which the run begins, from rest.").any("a time in the data"),
    default(S::Comparison, "end", Quantity(D::Time), "the last instant", "Time in the data at which the run ends.").any("a time in the data"),
    optional(S::Comparison, "column", Tables(&[S::ComparedColumn]), "Histories to compare."),
    optional(S::Comparison, "impacts", Tables(&[S::ComparedImpacts]), "Impacts to compare."),

    required(S::ComparedColumn, "measured", Text, "Column of the data."),
    required(S::ComparedColumn, "computed", Text, "Column of history.parquet, such as J1.floor1.displacement_m."),
    optional(S::ComparedColumn, "relative_to", Text, "Column of the data to subtract, such as the table displacement if displacements were measured relative to the laboratory."),
    default(S::ComparedColumn, "reverse", Flag, "false", "Change the sign of the measured values."),
    optional(S::ComparedColumn, "zero", Quantity(D::Time), "Length of an initial part of the data, while everything is at rest; the mean of the measured values over it is subtracted.").usual("a time", 1e-3, 1e4),

    optional(S::ComparedImpacts, "acceleration", Text, "Column of an acceleration that has a spike at every impact."),
    optional(S::ComparedImpacts, "above", Quantity(D::Acceleration), "An impact begins when its magnitude rises above this.").usual("an acceleration", 0.01, 1e5),
    optional(S::ComparedImpacts, "sensor", Text, "Column of a contact sensor, instead."),
    optional(S::ComparedImpacts, "level", Quantity(D::Dimensionless), "Contact begins when its magnitude rises above this, in the unit of the file.").any("the unit is that of the file"),
    optional(S::ComparedImpacts, "closing", TextOrTexts, "Columns of the displacements left and right of the gap, instead."),
    default(S::ComparedImpacts, "width", Quantity(D::Length), "that of the model", "Contact begins when left minus right rises above this.").range(GAP),
    default(S::ComparedImpacts, "contact", Text, "all contacts", "Gap or contact to compare with, such as J1-J2 or J1-J2.floor5-5."),
    default(S::ComparedImpacts, "window", Quantity(D::Time), "\"20 ms\"", "Greatest time difference of a matched pair.").usual("a time", 1e-5, 10.0),
    default(S::ComparedImpacts, "separation", Quantity(D::Time), "\"50 ms\"", "Measured signals with less time between them count as one impact.").usual("a time", 1e-5, 10.0),
    optional(S::ComparedImpacts, "zero", Quantity(D::Time), "Length of an initial part of the data, while everything is at rest; the mean of the measured values over it is subtracted.").usual("a time", 1e-3, 1e4),

    optional(S::City, "title", Text, "Title of the pages."),
    required(S::City, "inventory", Kind::Table(S::CityInventory), "Footprints of the buildings."),
    optional(S::City, "buildings", Kind::TableOf(&[S::CityBuildings, S::TypesTable]), "Structural types, and assumptions where the inventory has no data."),
    optional(S::City, "damage", Kind::Table(S::TypesDamage), "Onset of damage."),
    optional(S::City, "gap", Kind::Table(S::CityGap), "Distribution of gap widths, which maps do not show."),
    optional(S::City, "contact", Kind::Table(S::CityContact), "Contact between slabs."),
    required(S::City, "motion", Kind::TableOf(&[S::Motion, S::CityMotion]), "One or more ground motions: record may be a list."),
    optional(S::City, "run", Kind::Table(S::CityRun), "Number of draws and accuracy."),

    required(S::CityInventory, "file", Text, "GeoJSON, GeoParquet, or CSV with outlines as WKT or GeoJSON."),
    default(S::CityInventory, "metres", Flag, "false", "Whether coordinates are in metres instead of degrees of longitude and latitude."),
    optional(S::CityInventory, "columns", Kind::Table(S::CityColumns), "Column names that differ from the standard ones."),
    default(S::CityInventory, "reach", Quantity(D::Length), "\"0.5 m\"", "Buildings at most this far apart on the map are neighbours.").usual("a reach", 0.01, 10.0),

    optional(S::CityColumns, "id", Text, "Name of a building."),
    optional(S::CityColumns, "footprint", Text, "Outline of a building."),
    optional(S::CityColumns, "storeys", Text, "Storeys above the ground."),
    optional(S::CityColumns, "height", Text, "Height above the ground in m."),
    optional(S::CityColumns, "year", Text, "Year of construction."),
    optional(S::CityColumns, "type", Text, "Structural type: a name in the table of types, or the GEM taxonomy."),

    default(S::CityBuildings, "type", Text, "\"C1\"", "Structural type of buildings for which none is given."),
    default(S::CityBuildings, "level", TextOrTable(S::CityLevels), "\"year\"", "Design level: high, moderate, low or pre. \"year\" derives it from the year of construction as in California (moderate from 1941, high from 1976); a table gives other years. Buildings of unknown year are moderate."),
    default(S::CityBuildings, "stiffness_scatter", Quantity(D::Dimensionless), "0.1", "Standard deviation of the logarithm of storey stiffness between buildings.").usual("a scatter", 1e-4, 2.0),
    default(S::CityBuildings, "strength_scatter", Quantity(D::Dimensionless), "0.25", "Standard deviation of the logarithm of strength between buildings.").usual("a scatter", 1e-4, 2.0),
    default(S::CityBuildings, "damping_scatter", Quantity(D::Dimensionless), "0.1", "Standard deviation of the logarithm of damping between buildings.").usual("a scatter", 1e-4, 2.0),

    optional(S::CityLevels, "low", Count, "First year of the low level; buildings from before the first given year are pre."),
    optional(S::CityLevels, "moderate", Count, "First year of the moderate level."),
    optional(S::CityLevels, "high", Count, "First year of the high level."),

    optional(S::TypesTable, "table", Text, "Table of structural types, instead of that of HAZUS: a CSV with the columns that `jostle city types` prints."),
    default(S::TypesTable, "area_mass", Quantity(D::AreaMass), "\"1000 kg/m2\"", "Floor mass per area, if the table has no column `mass_kg_m2`. A weight per area is converted.").usual("a mass per area", 100.0, 3000.0),

    optional(S::TypesDamage, "table", Text, "Table of drift ratios at which damage begins, instead of those of the types: a CSV with `type`, `slight`, `moderate`, `extensive`, `complete` and optionally `level`, `storeys_least`, `storeys_most`."),

    default(S::CityGap, "median", Quantity(D::Length), "\"25 mm\"", "Median gap width. No survey is available: also try half and twice this value.").range(GAP),
    default(S::CityGap, "scatter", Quantity(D::Dimensionless), "0.8", "Standard deviation of the logarithm of the gap width.").usual("a scatter", 1e-4, 3.0),
    default(S::CityGap, "party_wall", Quantity(D::Dimensionless), "0", "Fraction of pairs that share a wall and cannot collide.").usual("a share", 1e-4, 1.0),

    default(S::CityContact, "stiffness", Quantity(D::HertzStiffness), "\"2.75 GN/m^1.5\"", "Stiffness of the law hertz-damp.").usual("a contact stiffness", 1e6, 1e13),
    default(S::CityContact, "restitution", Quantity(D::Dimensionless), "0.65", "Coefficient of restitution, 0 to 1.").usual("a restitution", 0.01, 1.0),
    default(S::CityContact, "scatter", Quantity(D::Dimensionless), "0.3", "Standard deviation of the logarithm of the stiffness between pairs.").usual("a scatter", 1e-4, 3.0),

    optional(S::CityMotion, "grid", Text, "Motions at points: an `EventGrid.csv` of SimCenter. Every block uses the motions of the nearest point; unit gives their unit."),
    optional(S::CityMotion, "shakemap", Text, "Intensities on a map: a `grid.xml` of ShakeMap. The records are scaled to them for every block."),
    optional(S::CityMotion, "gmf", Text, "Intensities of events at sites: a table of OpenQuake ground motion fields, `event_id,site_id,gmv_PGA,gmv_SA(1.0)`. The records are scaled to them; every event is a motion."),
    optional(S::CityMotion, "sites", Text, "With gmf: the table of sites, `site_id,lon,lat`."),
    default(S::CityMotion, "choose", Count, "1", "With shakemap or gmf: number of records per block and event, chosen from the list by the best fit of their spectra to the intensities."),
    default(S::CityMotion, "site_reach", Quantity(D::Length), "\"10 km\"", "With grid or gmf: a building farther than this from every point is an error.").usual("a reach", 10.0, 1e5),

    default(S::CityRun, "draws", Count, "25", "Number of random draws of gaps, stiffness, strength and damping for every motion."),
    default(S::CityRun, "tolerance", Quantity(D::Dimensionless), "0.01", "Relative error of peaks, 0.01 or 0.001, which 99.5 % of them meet.").usual("a tolerance", 1e-4, 0.1),
    default(S::CityRun, "sample", Count, "20", "Minimum number of rows that are repeated with the standard solvers, to measure the accuracy of the batches."),

    optional(S::Classes, "title", Text, "Title of the page."),
    optional(S::Classes, "buildings", Kind::Table(S::TypesTable), "Structural types."),
    optional(S::Classes, "damage", Kind::Table(S::TypesDamage), "Onset of damage."),
    required(S::Classes, "class", Kind::Table(S::ClassesSide), "Classes whose fragility is computed."),
    default(S::Classes, "neighbour", Kind::Table(S::ClassesSide), "as class", "Classes of the neighbours."),
    optional(S::Classes, "pair", Kind::Table(S::ClassesPair), "Arrangement of the buildings."),
    optional(S::Classes, "contact", Kind::Table(S::CityContact), "Contact between slabs."),
    required(S::Classes, "motion", Kind::Table(S::Motion), "One or more ground motions: record may be a list."),
    optional(S::Classes, "intensity", Kind::Table(S::ClassesIntensity), "Intensity measure, and the levels to which motions are scaled."),
    optional(S::Classes, "run", Kind::Table(S::ClassesRun), "Number of draws and accuracy."),

    required(S::ClassesSide, "types", Kind::Texts, "Structural types: names in the table of types such as \"C1\" (the height follows from the storeys) or \"C1M\", or the GEM taxonomy such as \"CR/LFM\"."),
    required(S::ClassesSide, "storeys", Counts, "Numbers of storeys, 1 to 16; every type is combined with each."),
    default(S::ClassesSide, "level", Choice(&LEVELS), "\"moderate\"", "Seismic design level."),

    default(S::ClassesPair, "gaps", Quantities(D::Length), "[\"10 mm\", \"50 mm\"]", "Gap widths, in ascending order. No survey is available: give several.").range(GAP),
    default(S::ClassesPair, "alignment", Kind::Texts, "[\"floors\"]", "\"floors\": floors at equal heights collide. \"half-storey\": the neighbour is raised by half of its storey height, so that slabs hit columns."),
    default(S::ClassesPair, "position", Kind::Texts, "[\"end\"]", "\"end\": one neighbour. \"middle\": the same neighbour on both sides."),
    default(S::ClassesPair, "area", Quantity(D::Area), "\"200 m2\"", "Floor area of every building.").usual("a floor area", 20.0, 1e4),

    default(S::ClassesIntensity, "measure", Choice(&MEASURES), "\"PGA\"", "PGA: peak ground acceleration. Sa(T1): pseudo-acceleration at the first period of the class, damping 5 %. AvgSA: geometric mean of pseudo-accelerations at 0.2 to 3 times that period."),
    default(S::ClassesIntensity, "levels", Quantities(D::Acceleration), "unscaled motions", "Intensities, in ascending order, to which every motion is scaled.").usual("an intensity", 0.01, 50.0),

    default(S::ClassesRun, "draws", Count, "10", "Number of random draws of stiffness, strength, damping and contact stiffness for every motion."),
    default(S::ClassesRun, "stiffness_scatter", Quantity(D::Dimensionless), "0.1", "Standard deviation of the logarithm of storey stiffness between buildings.").usual("a scatter", 1e-4, 2.0),
    default(S::ClassesRun, "strength_scatter", Quantity(D::Dimensionless), "0.25", "Standard deviation of the logarithm of strength between buildings.").usual("a scatter", 1e-4, 2.0),
    default(S::ClassesRun, "damping_scatter", Quantity(D::Dimensionless), "0.1", "Standard deviation of the logarithm of damping between buildings.").usual("a scatter", 1e-4, 2.0),
    default(S::ClassesRun, "tolerance", Quantity(D::Dimensionless), "0.01", "Relative error of peaks, 0.01 or 0.001, which 99.5 % of them meet.").usual("a tolerance", 1e-4, 0.1),
    default(S::ClassesRun, "sample", Count, "20", "Minimum number of rows that are repeated with the standard solvers, to measure the accuracy of the batches."),
    default(S::ClassesRun, "resamples", Count, "200", "Bootstrap resamples of the records, for 90 % intervals of medians; 0 disables them."),
];

/// The keys of some sections, in order.
pub(crate) fn keys_of(sections: &[Section]) -> impl Iterator<Item = &'static Key> {
    KEYS.iter().filter(|key| sections.contains(&key.section))
}

/// The range of a key of one of some sections.
pub(crate) fn range_of(sections: &[Section], key: &str) -> Option<&'static Range> {
    let key = keys_of(sections).find(|known| known.name == key)?;
    match &key.usual {
        Usual::Within(range) => Some(range),
        Usual::NoQuantity | Usual::Any(_) => None,
    }
}
