//! Every key of a model file, once: the reader, the misspelling hints and the JSON Schema all use this table.

use crate::quantity::Dimension;

/// The table of the file in which a key stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Section {
    Root,
    Motion,
    /// Keys of every building.
    Building,
    /// Further keys of `kind = "frame"`.
    Frame,
    /// Further keys of `kind = "shear"`.
    Shear,
    /// Cross-section of a column.
    Column,
    /// Cross-section of a beam.
    Beam,
    StiffnessFactor,
    Axial,
    Joint,
    Damping,
    Gap,
    Analysis,
}

/// What may stand behind a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Text,
    /// A whole number, not negative.
    Count,
    Flag,
    Quantity(Dimension),
    /// One value, or a list from the ground up.
    PerStorey(Dimension),
    /// A list of values.
    Quantities(Dimension),
    /// Stiffness of a contact: its unit depends on the law.
    ContactStiffness,
    /// One count, or one per span.
    CountPerSpan,
    /// One or two mode numbers.
    Modes,
    Choice(&'static [&'static str]),
    /// A word in place of a value.
    WordOr(&'static str, Dimension),
    /// A word for all, or a table.
    ChoiceOrTable(&'static [&'static str], Section),
    NumberOrTable(Section),
    Table(Section),
    /// One table, or a list of tables from the ground up.
    TablePerStorey(Section),
    /// A list of tables, `[[…]]`.
    Tables(&'static [Section]),
    /// Names of the two neighbours of a gap.
    Neighbours,
    /// `"common"`, pairs of floors, or heights.
    FloorPairs,
    /// Part of the format, but not of this version.
    Reserved,
}

/// One key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    pub(crate) section: Section,
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    /// What holds when the key is absent; `None` for keys without a default.
    pub(crate) default: Option<&'static str>,
    pub(crate) required: bool,
    /// One line for people.
    pub(crate) doc: &'static str,
}

pub(crate) const BUILDING_KINDS: &[&str] = &["frame", "shear"];
pub(crate) const LAWS: &[&str] = &[
    "linear",
    "kelvin",
    "kelvin-no-tension",
    "hertz",
    "hertz-damp",
];
pub(crate) const LATER_LAWS: &[&str] = &[
    "modified-kelvin",
    "ye",
    "jankowski",
    "bilinear",
    "restitution",
];
pub(crate) const SOLVERS: &[&str] = &["riccati", "stiffness", "product"];
pub(crate) const LATER_SOLVERS: &[&str] = &["modal"];
pub(crate) const AXIAL: &[&str] = &["rigid", "flexible"];
pub(crate) const RESTITUTION_IS: &[&str] = &["input", "realised"];
pub(crate) const WAVES: &[&str] = &["sine", "ricker"];
pub(crate) const CONCRETES: &[&str] = &[
    "C20", "C25", "C30", "C35", "C40", "C45", "C50", "C55", "C60", "C65", "C70", "C75", "C80",
];

const fn required(section: Section, name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        section,
        name,
        kind,
        default: None,
        required: true,
        doc,
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
    }
}

use Dimension as D;
use Kind::{
    Choice, ChoiceOrTable, ContactStiffness, Count, CountPerSpan, Flag, FloorPairs, Modes,
    Neighbours, NumberOrTable, PerStorey, Quantities, Quantity, Reserved, TablePerStorey, Tables,
    Text, WordOr,
};
use Section as S;

/// The keys, in the order in which a file is best written.
#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    default(S::Root, "title", Text, "\"Untitled\"", "Printed on summaries and reports."),
    optional(S::Root, "motion", Kind::Table(S::Motion), "The ground motion."),
    required(S::Root, "building", Tables(&[S::Building, S::Frame, S::Shear]), "The buildings, from left to right."),
    optional(S::Root, "gap", Tables(&[S::Gap]), "The gaps, one for each pair of neighbours."),
    optional(S::Root, "analysis", Kind::Table(S::Analysis), "Steps, accuracy and solver."),

    optional(S::Motion, "record", Text, "A built-in record, or a file (PEER AT2, CSV, columns of text) relative to this file."),
    optional(S::Motion, "kind", Choice(WAVES), "An analytic wave instead of a record."),
    optional(S::Motion, "amplitude", Quantity(D::Acceleration), "Amplitude of the analytic wave."),
    optional(S::Motion, "period", Quantity(D::Time), "Period of the analytic wave."),
    default(S::Motion, "centre", Quantity(D::Time), "1.5 periods", "Time at which the Ricker pulse peaks."),
    optional(S::Motion, "pga", Quantity(D::Acceleration), "Scale the motion so that its greatest acceleration is this."),
    default(S::Motion, "scale", Quantity(D::Dimensionless), "1", "Multiply the motion by this factor."),
    default(S::Motion, "reverse", Flag, "false", "Change the sign of the motion."),
    default(S::Motion, "duration", Quantity(D::Time), "the whole record", "Length of the analysis: cuts the record, or goes on with a ground at rest."),
    optional(S::Motion, "unit", Text, "Unit of the numbers of a text record that does not state it, such as \"g\"."),
    optional(S::Motion, "step", Quantity(D::Time), "Time step of a text record that does not state it."),
    optional(S::Motion, "column", Count, "Column of a text record that holds the acceleration, counted from 1."),

    default(S::Building, "name", Text, "\"B1\", \"B2\", …", "Name, by which gaps refer to the building."),
    default(S::Building, "kind", Choice(BUILDING_KINDS), "\"frame\"", "Frame of beams and columns, or floors on storey springs."),
    optional(S::Building, "storeys", Count, "Number of storeys; not needed beside a list per storey."),
    optional(S::Building, "floors", Count, "The same as storeys."),
    optional(S::Building, "storey_height", PerStorey(D::Length), "Storey height; needed for frames, 3 m for shear buildings."),
    default(S::Building, "damping", Kind::Table(S::Damping), "5 % in modes 1 and 3", "Viscous damping."),
    optional(S::Building, "hinges", Reserved, "Inelastic hinges."),

    required(S::Frame, "spans", Quantities(D::Length), "Widths of the bays from left to right."),
    required(S::Frame, "column", TablePerStorey(S::Column), "Column section: one, or a list from the ground up."),
    required(S::Frame, "beam", TablePerStorey(S::Beam), "Beam section: one, or a list from the ground up."),
    optional(S::Frame, "elastic_modulus", Quantity(D::Modulus), "Modulus of elasticity of columns and beams."),
    optional(S::Frame, "concrete", Choice(CONCRETES), "Concrete grade of GB 50010 instead of elastic_modulus."),
    default(S::Frame, "stiffness_factor", NumberOrTable(S::StiffnessFactor), "1", "Factor on every EI, for cracked sections."),
    default(S::Frame, "density", Quantity(D::Density), "\"2500 kg/m3\"", "Density of columns; a weight per volume is converted."),
    optional(S::Frame, "beam_mass", PerStorey(D::LineMass), "Mass carried by the beams, self weight included; needed unless floor_mass is given. A weight per length is converted."),
    default(S::Frame, "floor_mass", PerStorey(D::Mass), "0", "Further mass of a whole floor, shared by its joints. A weight is converted."),
    default(S::Frame, "column_segments", Count, "4", "Segments of a column in one storey; k segments have k − 1 lumped masses between them."),
    default(S::Frame, "beam_segments", CountPerSpan, "4", "Segments of the beams: one value, or one per span."),
    default(S::Frame, "axial", ChoiceOrTable(AXIAL, S::Axial), "\"rigid\"", "Whether members shorten under axial force."),
    optional(S::Frame, "joint", Kind::Table(S::Joint), "Elastic hinge at the beam ends."),

    required(S::Shear, "mass", PerStorey(D::Mass), "Floor masses from the ground up. A weight is converted."),
    required(S::Shear, "stiffness", PerStorey(D::Stiffness), "Storey stiffnesses from the ground up."),

    optional(S::Column, "width", Quantity(D::Length), "Width, across the direction of bending."),
    optional(S::Column, "depth", Quantity(D::Length), "Depth, in the direction of bending."),
    optional(S::Column, "EI", Quantity(D::FlexuralRigidity), "Flexural rigidity, instead of width and depth."),
    optional(S::Column, "EA", Quantity(D::Force), "Axial rigidity beside EI; needed when columns shorten."),
    default(S::Column, "mass", Quantity(D::LineMass), "density × area", "Self mass per length of the column."),
    optional(S::Beam, "width", Quantity(D::Length), "Width, across the direction of bending."),
    optional(S::Beam, "depth", Quantity(D::Length), "Depth, in the direction of bending."),
    optional(S::Beam, "EI", Quantity(D::FlexuralRigidity), "Flexural rigidity, instead of width and depth."),
    optional(S::Beam, "EA", Quantity(D::Force), "Axial rigidity beside EI; needed when beams shorten."),

    default(S::StiffnessFactor, "column", Quantity(D::Dimensionless), "1", "Factor on EI of the columns."),
    default(S::StiffnessFactor, "beam", Quantity(D::Dimensionless), "1", "Factor on EI of the beams."),

    default(S::Axial, "columns", Choice(AXIAL), "\"rigid\"", "Whether columns shorten."),
    default(S::Axial, "beams", Choice(AXIAL), "\"rigid\"", "Whether beams shorten."),

    default(S::Joint, "rotational_stiffness", WordOr("rigid", D::RotationalStiffness), "\"rigid\"", "Rotational stiffness of the hinge between beam end and column."),

    default(S::Damping, "ratio", Quantity(D::Dimensionless), "0.05", "Fraction of critical damping in the modes below."),
    default(S::Damping, "modes", Modes, "[1, 3]; [1, 2] or [1] with fewer floors", "Lateral modes that have this ratio."),
    optional(S::Damping, "alpha", Quantity(D::Frequency), "Rayleigh coefficient on the masses, instead of ratio."),
    optional(S::Damping, "beta", Quantity(D::Time), "Rayleigh coefficient on the stiffness, instead of ratio."),

    required(S::Gap, "between", Neighbours, "Names of the left and the right neighbour."),
    required(S::Gap, "width", Quantity(D::Length), "Width at rest."),
    default(S::Gap, "floors", FloorPairs, "\"common\"", "Where the neighbours can touch: every pair of floors at equal height, listed pairs, or heights."),
    default(S::Gap, "law", Choice(LAWS), "\"hertz-damp\"", "Contact law."),
    default(S::Gap, "stiffness", ContactStiffness, "\"2e9 N/m^1.5\" for Hertz laws", "Contact stiffness: N/m^1.5 for the Hertz family, N/m for the linear family."),
    default(S::Gap, "restitution", Quantity(D::Dimensionless), "0.65", "Coefficient of restitution."),
    default(S::Gap, "restitution_is", Choice(RESTITUTION_IS), "\"input\"", "Whether the published formula takes it, or free masses really rebound with it."),

    default(S::Analysis, "step", WordOr("auto", D::Time), "\"auto\"", "Time step in free flight."),
    default(S::Analysis, "contact_step", WordOr("auto", D::Time), "\"auto\"", "Time step while a contact is closed."),
    default(S::Analysis, "tolerance", Quantity(D::Dimensionless), "1e-3", "Relative tolerance on the greatest contact force of a gap and on peak displacements, with automatic steps."),
    default(S::Analysis, "energy_tolerance", Quantity(D::Dimensionless), "1e-6", "Relative energy imbalance above which a run warns."),
    default(S::Analysis, "solver", Choice(SOLVERS), "\"riccati\"", "Equations that advance a step: Riccati transfer, direct stiffness as a check, or the published product of transfer matrices."),
];

/// The keys of some sections, in order.
pub(crate) fn keys_of(sections: &[Section]) -> impl Iterator<Item = &'static Key> {
    KEYS.iter().filter(|key| sections.contains(&key.section))
}

/// The known key spelt most like a wrong one, if any is close.
pub(crate) fn nearest<'a>(wrong: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wrong: String = wrong.chars().take(64).collect::<String>().to_lowercase();
    let allowed = 1 + wrong.chars().count() / 4;
    known
        .map(|name| {
            (
                strsim::damerau_levenshtein(&wrong, &name.to_lowercase()),
                name,
            )
        })
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}
