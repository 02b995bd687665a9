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
        "Statics, frequencies, damping coefficients and single Newmark steps against formulas and an independent \
         calculation in double precision.",
        |_| closed_forms::rows(),
    ),
    (
        "Frames",
        "Seven frames given node by node: hinges, axially rigid and flexible members, shear deformation, P-Δ. \
         Expected values come from an independent finite-element program. Steps start from x = v = a = 0 with a ground acceleration that is not zero.",
        |_| frames::rows(),
    ),
    (
        "Modes",
        "Frequencies and masses of two frames given as model files.",
        |_| modes::rows(),
    ),
    (
        "Collisions",
        "Two free masses under every contact law: formulas, and time steps, 200 and 2000 per impact. The masses start \
         a fraction of a step apart, so first contact lies between two steps.",
        |_| collisions::rows(),
    ),
    (
        "Oscillators",
        "Motions with exact solutions: an oscillator against a rigid stop (a free body of 10³⁰ kg), and two \
         oscillators with linear contact under a sine.",
        |_| oscillators::rows(),
    ),
    (
        "Buildings in space",
        "Floors that turn, shaken from two sides, with faces of several points: eccentric storeys, five beside three storeys \
         offset in plan at 30°, three buildings around a corner. Expected values: modes in free flight, an integrator of \
         eighth order in contact, every touch and opening located; checked by fixed steps of 2 µs.",
        |_| space::rows(),
    ),
    (
        "Frames, braces and infills",
        "Frames beside neighbours, through model files: columns by line and beams by bay; a tower of one bay on a podium of three, with \
         columns that stretch; two frames whose slabs meet columns, as one stands lower; elastic and yielding braces with columns that \
         stretch, and struts that bear compression alone above a soft storey; a stick on a footing that lifts off. Expected values: an integrator of eighth order, restarted at the \
         points of the record and at changes of contact; agrees with OpenSees to 5·10⁻⁹ m at equal steps.",
        |_| members::rows(),
    ),
    (
        "Contact constants",
        "Two oscillators and a contact with constants as papers print them, through model files: a dashpot, with and without \
         tension, two stiffnesses with a yield indentation, a face that crushes and stays crushed. Expected values: an integrator \
         of eighth order, restarted at the points of the record and at changes of contact; at equal steps OpenSees agrees to \
         5·10⁻⁹ m for the dashpot with tension and the face that crushes. Forces of the two last laws under given indentations.",
        |_| contact_constants::rows(),
    ),
    (
        "Space frames",
        "A frame of three storeys and two by two bays with unequal columns, read from a model file; without and with shear \
         deformation. Expected values: members of six degrees of freedom assembled by an independent program, whose periods and \
         displacements agree with OpenSees (elasticBeamColumn, ElasticTimoshenkoBeam, rigidDiaphragm) to 2·10⁻¹⁴.",
        |_| space_frames::rows(),
    ),
    (
        "Matrices of floors in space",
        "An eccentric frame of two storeys with rigid diaphragms given by the K and M of OpenSees: with its mass at the retained \
         nodes, apart from them, and with all displacements of its joints. Expected values: eigenvalues of OpenSees (fullGenLapack).",
        |_| given_in_plan::rows(),
    ),
    (
        "Free floors in space",
        "One impact of two free floors from given velocities, by faces and by a corner, without and with friction, under four \
         contact laws. Expected values: an integrator of eighth order, confirmed by momentum, energy, closed forms of rigid \
         bodies and fixed steps of 0.5 µs; with friction also by another program. The floors stand on springs of 10⁻⁴ rad/s.",
        |_| free_bodies::rows(),
    ),
    (
        "Isolation and walls",
        "Five storeys on lead-rubber and sliding bearings under El Centro, alone and before a moat wall with a mass; a block on \
         bearings whose friction rises with speed. Expected values: an event-driven integrator of eighth order at a relative \
         tolerance of 10⁻¹².",
        |_| ground::rows(),
    ),
    (
        "Soil",
        "Springs and dashpots of rigid rectangles; one mass and two towers on foundations that sway and rock, alone and coupled \
         through the soil, without and with impacts, under El Centro. Expected values: formulas typed in from a second source, \
         complex roots of the equations of motion, and an event-driven integrator of eighth order at a relative tolerance of \
         10⁻¹².",
        |_| soil::rows(),
    ),
    (
        "Ground that differs, and vertical shaking",
        "Two and three towers that El Centro reaches one after the other, and a portal with a mass at midspan that is shaken along \
         x and y. Expected values: an event-driven integrator of eighth order at a relative tolerance of 10⁻¹², the grounds being \
         exact integrals of the record; without contact checked in absolute coordinates to 3·10⁻¹⁴ m.",
        |_| differing_ground::rows(),
    ),
    (
        "Links that are not linear",
        "Two shear buildings joined by viscous dampers with exponents 1 and 0.35, Maxwell and friction links, without and with \
         impacts. Expected values: an integrator of eighth order, every slip and touch located; that of the pure dashpot comes \
         from fixed steps and is good to 1.6·10⁻⁴.",
        |_| links::rows(),
    ),
    (
        "Textbook",
        "A. K. Chopra, Dynamics of Structures: tables of Newmark's method, and the five-storey shear frame with its response to El Centro at 5 % damping in \
         all modes (modal stepping).",
        |_| chopra::rows(),
    ),
    (
        "Two frames in contact",
        "A five-storey and a ten-storey frame with 23 impacts in 3 s, against an independent program at a step of 20 µs.",
        pounding::rows,
    ),
    (
        "Two towers",
        "A light, soft tower beside a heavy, stiff block under El Centro, from a model file, with seven contact laws. \
         The reference is an event-driven integration at a relative tolerance of 10⁻¹². Its Kelvin results are those \
         of the law cut at F = 0.",
        towers::rows,
    ),
    (
        "Two shear buildings",
        "Five beside ten storeys under El Centro at 220 cm/s², from a model file. The reference is the same type of \
         integration.",
        |_| shear_buildings::rows(),
    ),
    (
        "The example after Zhang et al.",
        "The built-in model: masses, periods, contact or none, and OpenSees on the same model with the same method \
         and steps (Newmark ¼, ½; 2 ms, near contact 0.2 ms; its results have three or more digits).",
        |_| paper::rows(),
    ),
    (
        "Yielding frames, bearings, links, soil and grounds in OpenSees",
        "Hinges at every member end; bearings with stops, a moat wall and links of every law that is exported; foundations on soil, \
         also beside each other; ground that differs; vertical shaking; most other features of a model, from model files with a \
         tolerance of 10⁻⁴. \
         The reference is OpenSees on the exported scripts with steps of 0.5 ms, near contact 0.05 ms.",
        |_| yielding::rows(),
    ),
    (
        "Buildings in space in OpenSees",
        "Faces off the centres of symmetric buildings; centres of stiffness beside those of mass; columns and walls at points, P-Delta and \
         two components at an angle; five storeys beside three at 30°; three buildings around a corner; corners that pass each \
         other; space frames. From model files with a tolerance of 10⁻⁴. The reference is OpenSees on the exported scripts with \
         steps of 0.1 ms, near contact 0.01 ms; four times as long for space frames.",
        |_| plan_in_opensees::rows(),
    ),
    (
        "Walls in plan that yield, in OpenSees",
        "Two storeys on walls at points of the plan, none of which stands at the centre of mass; each yields along x and across, under two \
         sines. From a model file with steps of 0.5 ms. The reference is OpenSees with the same method and steps, Steel01 at points that \
         rigidLink ties to the floors, by a script of its own.",
        |_| yielding_in_plan::rows(),
    ),
    (
        "A space frame that yields, in OpenSees",
        "Two storeys on four columns, one of them stronger, the centre of mass beside the middle; hinges at all ends of columns about both axes, \
         and of beams, under two sines. From a model file with steps of 1 ms. The reference is OpenSees with the same method and steps, \
         Steel01 between joints and elasticBeamColumn, rigidDiaphragm, by a script of its own.",
        |_| yielding_in_plan::space_frame_rows(),
    ),
    (
        "Isolated buildings stepped directly",
        "Bearings that yield and slide, a slider and a cable between buildings, moat walls, storeys that yield, from model files at \
         several tolerances: the error is within the tolerance, and the run says so. The reference is an independent program that finds \
         every event.",
        |_| direct_steps::rows(),
    ),
    (
        "Automatic steps",
        "The built-in model with automatic steps at several tolerances, against runs of the same program with a \
         uniform step of 10 µs. The tolerance bounds the peak contact force and the peak displacement.",
        |_| paper::step_rows(),
    ),
    (
        "Random pairs",
        "Random pairs of shear buildings, with all laws whose force acts over time and automatic steps at a tolerance \
         of 10⁻³, against uniform steps of 25 µs.",
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
