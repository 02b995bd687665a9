//! jostle against closed forms, other programs and the literature: one [`row::Row`] per number compared.
//!
//! Every module is one family of checks over the data stored in `data`, whose READMEs state the sources of the
//! numbers. The tolerances are those stated with the data; none is widened to make a check pass.

pub mod batches;
pub mod bits;
pub mod certify;
pub mod chopra;
pub mod closed_forms;
pub mod collisions;
pub mod contact_constants;
pub mod differing_ground;
pub mod direct_steps;
pub mod document;
pub mod frames;
pub mod free_bodies;
pub mod given_in_plan;
pub mod ground;
pub mod harmonic;
pub mod links;
pub mod loops;
pub mod members;
pub mod modes;
pub mod oscillators;
pub mod pairs;
pub mod paper;
pub mod plan_in_opensees;
pub mod pounding;
pub mod row;
pub mod shear_buildings;
pub mod soil;
pub mod space;
pub mod space_frames;
pub mod towers;
pub mod work_precision;
pub mod yielding;
pub mod yielding_in_plan;

mod data;
mod fibre_ends;
mod files;
mod structures;

use rayon::prelude::*;
use row::Row;

/// How much is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Checks fast enough for a test.
    Reduced,
    /// Small steps as well.
    Full,
}

/// Checks of one kind.
#[derive(Clone, Debug)]
pub struct Family {
    /// Heading.
    pub title: &'static str,
    /// Description of the comparison.
    pub about: &'static str,
    /// The comparisons.
    pub rows: Vec<Row>,
}

type Make = fn(Extent) -> Vec<Row>;

/// Title, explanation and rows of every family.
const FAMILIES: [(&str, &str, Make); 27] = [
    (
        "Closed forms",
        "Statics, natural frequencies, damping coefficients and single Newmark steps are compared with formulas and \
         with an independent calculation in double precision.",
        |_| closed_forms::rows(),
    ),
    (
        "Frames",
        "Seven frames, given node by node, with hinges, axially rigid and flexible members, shear deformation and P-Δ \
         are compared with an independent finite-element program. Steps start from x = v = a = 0 with a nonzero ground \
         acceleration.",
        |_| frames::rows(),
    ),
    (
        "Modes",
        "Frequencies and effective masses of two frames, given as model files, are compared with an independent \
         calculation.",
        |_| modes::rows(),
    ),
    (
        "Collisions",
        "Collisions of two free masses under every contact law are compared with formulas, and with time steps of 1/200 \
         and 1/2000 of the impact duration. The masses start a fraction of a step apart, so first contact occurs within \
         a step.",
        |_| collisions::rows(),
    ),
    (
        "Oscillators",
        "Motions with exact solutions: an oscillator with a rigid stop (a free body of 10³⁰ kg), and two oscillators \
         with linear contact under a sine.",
        |_| oscillators::rows(),
    ),
    (
        "Buildings in space",
        "Buildings with rotating floors under two components of motion, with faces of several points: eccentric \
         storeys, five storeys beside three storeys that are offset in plan at 30°, and three buildings around a \
         corner. The expected values are modal solutions in free vibration, and during contact results of an \
         integrator of eighth order that locates every opening and closing. They were checked with fixed steps of 2 µs.",
        |_| space::rows(),
    ),
    (
        "Frames, braces and infills",
        "Frames with a neighbour, from model files: columns given by line and beams by bay; a tower of one bay on a \
         podium of three bays with axially flexible columns; two frames of which one is founded lower, so that slabs \
         collide with columns; elastic and yielding braces with axially flexible columns; compression-only struts above \
         a soft storey; a stick on a foundation that lifts off. The expected values are those of an integrator of \
         eighth order that restarts at the points of the record and at changes of contact. It agrees with OpenSees to \
         5·10⁻⁹ m at equal steps.",
        |_| members::rows(),
    ),
    (
        "Contact constants",
        "Two oscillators and a contact with published constants, from model files: a dashpot, with and \
         without tension; two stiffnesses with a yield indentation; a face that crushes permanently. The expected \
         values are those of an integrator of eighth order that restarts at the points of the record and at changes of \
         contact. For the dashpot with tension and the crushing face, OpenSees agrees to 5·10⁻⁹ m at equal steps. The \
         forces of the last two laws are also compared for given indentations.",
        |_| contact_constants::rows(),
    ),
    (
        "Space frames",
        "A frame of three storeys and two by two bays with unequal columns, from a model file, without and with shear \
         deformation. The expected values are those of an independent program that assembles members with six degrees \
         of freedom per node. Its periods and displacements agree with OpenSees (elasticBeamColumn, \
         ElasticTimoshenkoBeam, rigidDiaphragm) to 2·10⁻¹⁴.",
        |_| space_frames::rows(),
    ),
    (
        "Matrices of floors in space",
        "An eccentric frame of two storeys with rigid diaphragms, given by the matrices K and M of OpenSees: with the \
         mass at the retained nodes, with the mass away from them, and with all degrees of freedom of the joints. The \
         expected values are eigenvalues of OpenSees (fullGenLapack).",
        |_| given_in_plan::rows(),
    ),
    (
        "Free floors in space",
        "A single impact of two free floors with given velocities, at faces and at a corner, without and with friction, \
         under four contact laws. The expected values are those of an integrator of eighth order, confirmed by \
         momentum, energy, closed forms of rigid bodies and fixed steps of 0.5 µs, and with friction also by another \
         program. The floors are on springs so soft that their circular frequency is 10⁻⁴ rad/s.",
        |_| free_bodies::rows(),
    ),
    (
        "Isolation and walls",
        "Five storeys on lead-rubber and sliding bearings under El Centro, alone and beside a moat wall with mass, and \
         a block on bearings whose friction rises with speed. The expected values are those of an event-driven \
         integrator of eighth order at a relative tolerance of 10⁻¹².",
        |_| ground::rows(),
    ),
    (
        "Soil",
        "Springs and dashpots of rigid rectangular foundations, and one mass and two towers on foundations that sway \
         and rock, alone and coupled through the soil, without and with impacts, under El Centro. The expected values \
         are formulas from a second source, complex roots of the equations of motion, and results of an event-driven \
         integrator of eighth order at a relative tolerance of 10⁻¹².",
        |_| soil::rows(),
    ),
    (
        "Spatially varying and vertical ground motion",
        "Rows of two and of three towers that El Centro reaches one after the other, and a portal with a mass at midspan under \
         motion along x and y. The expected values are those of an event-driven integrator of eighth order at a \
         relative tolerance of 10⁻¹², with exact integrals of the record as ground motions. Without contact they were \
         checked in absolute coordinates to 3·10⁻¹⁴ m.",
        |_| differing_ground::rows(),
    ),
    (
        "Nonlinear links",
        "Two shear buildings with viscous dampers with exponents of 1 and 0.35, Maxwell links and friction links \
         between them, without and with impacts. The expected values are those of an integrator of eighth order that \
         locates every slip and first contact. The value for the pure dashpot is from fixed steps and is accurate to \
         1.6·10⁻⁴.",
        |_| links::rows(),
    ),
    (
        "Textbook examples",
        "A. K. Chopra, Dynamics of Structures: tables of Newmark's method, and the five-storey shear frame with its \
         response to El Centro at 5 % damping in all modes (modal stepping).",
        |_| chopra::rows(),
    ),
    (
        "Two frames in contact",
        "A five-storey and a ten-storey frame with 23 impacts in 3 s are compared with an independent program at a step \
         of 20 µs.",
        pounding::rows,
    ),
    (
        "Two towers",
        "A light, soft tower beside a heavy, stiff block under El Centro, from a model file, with seven contact laws. \
         The reference is an event-driven integration at a relative tolerance of 10⁻¹². Its Kelvin results are those of \
         the law without tension.",
        towers::rows,
    ),
    (
        "Two shear buildings",
        "Five beside ten storeys under El Centro at 220 cm/s², from a model file. The reference is an event-driven \
         integration as for the two towers.",
        |_| shear_buildings::rows(),
    ),
    (
        "The example after Zhang et al.",
        "Masses and periods of the built-in model, the gaps at which contact occurs, and results of OpenSees for the \
         same model with the same method and steps (Newmark ¼, ½; 2 ms, near contact 0.2 ms). The results of OpenSees \
         are accurate to three or more digits. Inputs that the publication does not give were chosen so that contact \
         occurs at its gaps; these rows are not an independent check.",
        |_| paper::rows(),
    ),
    (
        "Yielding frames, bearings, links, soil and ground motions in OpenSees",
        "Models with hinges at every member end; bearings with stops, a moat wall and links of every law that can be \
         exported; ends of columns and walls made of fibres; walls, coupling beams and rigid ends on rigid arms; beams that are continuous \
         over missing columns; foundations on soil, some of them coupled; foundations and columns that lift off; panels that fall out; \
         pendulums with several surfaces; spatially varying ground motion; vertical ground motion; and most other features, \
         from model files with a tolerance of 10⁻⁴. The reference is OpenSees with the exported scripts and steps of \
         0.5 ms, near contact 0.05 ms. Peak forces of fibres are compared to 10⁻³, because axial \
         forces converge slowly with the step.",
        |_| yielding::rows(),
    ),
    (
        "Buildings in space in OpenSees",
        "Symmetric buildings with an eccentric face; eccentric stiffness; columns and walls at points, with P-Delta and \
         two components at an angle; five storeys beside three at 30°; three buildings around a corner; corners that \
         pass each other; space frames, one with columns whose ends are made of fibres, two with a wall; frames at lines of a plan \
         that yield; bases that rock or lift off; columns that fail in shear; panels that fall out; links, and a wall that gives way. \
         All are given as model files, with a tolerance of 10⁻⁴. The reference is OpenSees with the exported scripts and \
         steps of 0.1 ms, near contact 0.01 ms; the steps of ten models are two to five times as long.",
        |_| plan_in_opensees::rows(),
    ),
    (
        "Yielding walls in plan in OpenSees",
        "Two storeys on eccentric walls at points of the plan, each of which yields along x and y. One sine acts along x, another along \
         y, and the step is 0.5 ms. The reference is a separate OpenSees script with the same method and \
         steps; its walls are Steel01 springs at points that rigidLink ties to the floors.",
        |_| yielding_in_plan::rows(),
    ),
    (
        "A yielding space frame in OpenSees",
        "Two storeys on four columns, one of which is stronger, with an eccentric mass, and hinges about both axes at \
         all ends of columns and at the ends of beams. One sine acts along x, another along y, and the step is 1 ms. The \
         reference is a separate OpenSees script with the same method and steps; it has Steel01 hinges between joints \
         and elasticBeamColumn members, and rigidDiaphragm floors.",
        |_| yielding_in_plan::space_frame_rows(),
    ),
    (
        "Isolated buildings with direct steps",
        "Bearings that yield and slide, a slider and a cable between buildings, moat walls and yielding storeys, from \
         model files at several tolerances. The rows show that the error is within the tolerance and that the run \
         reports this. The reference is an independent program that locates every event.",
        |_| direct_steps::rows(),
    ),
    (
        "Automatic steps",
        "The built-in model with automatic steps at several tolerances is compared with runs of the same program with a \
         uniform step of 10 µs. The errors of the peak contact force and the peak displacement must be within the \
         tolerance.",
        |_| paper::step_rows(),
    ),
    (
        "Random pairs",
        "Random pairs of shear buildings with all contact laws except `restitution`, and automatic steps at a tolerance \
         of 10⁻³, are compared with uniform steps of 25 µs.",
        pairs::rows,
    ),
];

/// All families, computed one after the other.
#[must_use]
pub fn families(extent: Extent) -> Vec<Family> {
    let compute = |(title, about, make): (&'static str, &'static str, Make)| Family {
        title,
        about,
        rows: make(extent),
    };
    FAMILIES.into_par_iter().map(compute).collect()
}

/// The family of a title; `None` if there is none.
#[must_use]
pub fn family(wanted: &str, extent: Extent) -> Option<Family> {
    let found = FAMILIES.into_iter().find(|(title, ..)| *title == wanted)?;
    let (title, about, make) = found;
    Some(Family {
        title,
        about,
        rows: make(extent),
    })
}

/// The rows that miss, with their families.
pub fn misses(families: &[Family]) -> impl Iterator<Item = (&Family, &Row)> {
    families.iter().flat_map(|family| {
        family
            .rows
            .iter()
            .filter(|row| row.misses())
            .map(move |row| (family, row))
    })
}
