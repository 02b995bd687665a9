//! Sections and tables that are not read, by what it means that they are not.

use std::collections::{BTreeMap, BTreeSet};

use crate::facts::Facts;
use crate::member::TextModel;

/// Words of names, and what it means to leave out what they stand for; the first that fits holds.
const MEANINGS: [(&[&str], &str); 10] = [
    (
        &["INSERTION POINT"],
        "members aside of the lines between their joints: jostle's run from joint to joint, so that beams below or above their joints are too soft",
    ),
    (
        &["LOCAL AXES ASSIGNMENTS 2", "LOCAL AXES ASSIGNMENTS 3"],
        "local axes by directions or points: sections stand as without them, and may be turned",
    ),
    (
        &["JOINT LOCAL AXES"],
        "local axes of joints: supports and masses are taken along X, Y and Z",
    ),
    (
        &["TENSION AND COMPRESSION"],
        "limits of tension and compression: members carry both, so that braces for tension alone are too stiff",
    ),
    (
        &["CONSTRAINT DEFINITIONS"],
        "constraints that are no diaphragms are not applied: joints that they tie move apart, so that periods are longer",
    ),
    (
        &["AREA OVERWRITES", "AREA OFFSET", "AREA LOCAL AXES"],
        "areas aside of their joints or with axes of their own: jostle's walls stand in the plane of their corners, with axes along it and up",
    ),
    (
        &[
            "LINK",
            "PANEL ZONE",
            "TENDON",
            "SPRING",
            "SOLID",
            "CABLE",
            "HINGE",
            "DAMPER",
        ],
        "links, springs, panel zones, tendons and hinges: if members have any, their stiffness and damping is missing",
    ),
    (
        &[
            "DESIGN",
            "PREFERENCES",
            "REBAR",
            "OVERWRITES",
            "CONCRETE SECTIONS",
            "DIMENSION",
            "TIME DEPENDENT",
            "DAMPING",
            "ACCEPTANCE",
        ],
        "design and display: the model is elastic, with 5 % damping; give hinges or damping in the model file",
    ),
    (
        &[
            "LOAD",
            "FUNCTION",
            "MASS SOURCE",
            "CASE",
            "COMBINATION",
            "ANALYSIS",
            "WAVE",
            "GENERALIZED",
            "PATTERN",
        ],
        "loads and analyses: masses come from tables or the .OUT file, and [motion] shakes the model",
    ),
    (
        &["SLAB", "DECK", "WALL", "AREA", "SHELL"],
        "slabs, decks and walls: floors are rigid in their plane and do not bend; walls have what their areas say",
    ),
];

/// One line for each meaning. `what` is how the file calls them, such as `sections`.
pub(crate) fn lines(file: &str, what: &str, names: &BTreeSet<&str>) -> Vec<String> {
    let mut found: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for name in names {
        let fits = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let meaning = MEANINGS.iter().find(|meaning| fits(meaning.0));
        found
            .entry(meaning.map_or(
                "not known to jostle: what they say is not in the building",
                |meaning| meaning.1,
            ))
            .or_default()
            .push(name);
    }
    let line = |(meaning, names): (&str, Vec<&str>)| {
        format!("{file}: {meaning} ({what} {})", names.join(", "))
    };
    found.into_iter().map(line).collect()
}

/// What stiffens the source and is in no building of its members.
pub(crate) fn softer(facts: &mut Facts, model: &TextModel) {
    let moved = model.members.iter().filter(|member| member.moved).count();
    if moved > 0 {
        facts.left_out.push(format!("{}: {moved} members aside of their joints, or with end offsets that the source finds from the sizes of other members: jostle's run from joint to joint, so that periods are longer, by 5 % and more; state the lengths of end offsets in the source, and export again", model.file));
    }
    if let Some(slab) = model.bending_slabs.first() {
        facts.left_out.push(format!("{}: {} floor areas bend, such as those of slab \"{slab}\": their stiffness is missing, so that periods are longer, by 10 % and more where beams are shallow", model.file, model.bending_slabs.len()));
    }
}
