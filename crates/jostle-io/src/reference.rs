//! Every key of the model file as a page of Markdown, made from the table of keys.

use std::fmt::Write;

use crate::keys::{KEYS, Key, Kind, Section};
use crate::quantity::Dimension;
use crate::unusual::{FIRST_PERIOD, Usual, span};

/// Tables of the file in the order of the page, with where they stand and what they are.
const TABLES: &[(Section, &str, &str)] = &[
    (Section::Root, "top of the file", ""),
    (
        Section::Motion,
        "`[motion]`",
        "The ground motion: a record, or an analytic wave.",
    ),
    (
        Section::Read,
        "`motion.read`",
        "For files whose layout is not detected. See [Ground-motion records](motions.md).",
    ),
    (
        Section::Coherency,
        "`motion.coherency`",
        "Ground motions whose coherency decreases with distance.",
    ),
    (Section::Match, "`motion.match`", ""),
    (
        Section::Spectrum,
        "`motion.match.spectrum`",
        "A code design spectrum.",
    ),
    (
        Section::Building,
        "`[[building]]`",
        "The buildings from left to right. Every building has these keys.",
    ),
    (
        Section::OwnMotion,
        "`[building.motion]`",
        "The keys of `[motion]` about the record and its scaling, and this key.",
    ),
    (Section::Frame, "`[[building]]` with `kind = \"frame\"`", ""),
    (
        Section::Shear,
        "`[[building]]` with `kind = \"shear\"`",
        "Also with `kind = \"frame\"` and a `plan`.",
    ),
    (Section::FloorPlan, "`plan` of a floor, in a list", ""),
    (
        Section::PlanStiffness,
        "`stiffness` of a storey with a plan, or of an element",
        "",
    ),
    (Section::Element, "`[[building.element]]`", ""),
    (
        Section::PlanFrame,
        "`[[building.frame]]`",
        "With `kind = \"frame\"` and a `plan`; the building then has the keys of `kind = \"shear\"`. See [Frames at lines of a plan](how-to/space-frames.md#frames-at-lines-of-a-plan).",
    ),
    (
        Section::FrameBay,
        "`[[building.brace]]` and `[[building.infill]]` of a plane frame",
        "Also of a frame at a line of a plan.",
    ),
    (Section::BraceEnds, "`[[building.brace]]` by its joints", ""),
    (
        Section::GridBay,
        "`[[building.brace]]` and `[[building.infill]]` of a space frame",
        "Without both x and y, they are only in bays within the plan of their floor, where there are joints.",
    ),
    (
        Section::Brace,
        "`[[building.brace]]`",
        "Between the joints of a frame, also of a frame at a line of a plan and of a space frame. A brace carries axial force only and transfers it to its joints; with `axial = \"flexible\"` this force also changes the length of columns.",
    ),
    (
        Section::Infill,
        "`[[building.infill]]`",
        "A panel is two compression-only struts between opposite joints. Without hinge they are elastic: compare their peak force with the strength of the panel. Modes and damping ratios use half the stiffness of each strut, since only one of the two acts at a time.",
    ),
    (
        Section::InfillStrength,
        "`strength` of `[[building.infill]]`",
        "",
    ),
    (
        Section::InfillOutOfPlane,
        "`out_of_plane` of `[[building.infill]]`",
        "`parts` in the results contains its `out_of_plane_ratio`.",
    ),
    (
        Section::InfillBackbone,
        "`backbone` of `[[building.infill]]`",
        "",
    ),
    (
        Section::InfillOpening,
        "`opening` of `[[building.infill]]`",
        "",
    ),
    (
        Section::FrameWall,
        "`[[building.wall]]`",
        "For a plane frame, also one at a line of a plan. A wall is a wide column with a rigid cross-section: beams span between faces and rotate with them. See [Walls and coupling beams](how-to/walls.md).",
    ),
    (Section::WallHinge, "`hinge` of a wall", ""),
    (
        Section::WallEnds,
        "`hinge` of a wall, places and fibres",
        "",
    ),
    (
        Section::WallBars,
        "`bars` of a wall",
        "Both edges are alike. See [Fibres](how-to/walls.md#fibres).",
    ),
    (
        Section::CouplingBeam,
        "`[[building.coupling_beam]]`",
        "Beams between walls whose forces are reported. Beams between walls that are defined by `[[building.beam]]` are ordinary beams between faces. A coupling beam yields in shear: its shear deformation is a spring with the rule and the corners of `hinge`.",
    ),
    (
        Section::Sliding,
        "`hinge` of a coupling beam, `shear_hinge` of a wall, further keys",
        "",
    ),
    (
        Section::SpaceFrame,
        "`[[building]]` with `kind = \"space-frame\"`",
        "And the keys of `kind = \"shear\"` except `frame`. See [Space frames](how-to/space-frames.md).",
    ),
    (
        Section::SpaceWall,
        "`[[building.wall]]` of a space frame",
        "A wide column with a rigid cross-section: beams along it span between faces and rotate with it. Its forces are reported like those of a column. See [Walls and coupling beams](how-to/walls.md).",
    ),
    (
        Section::SpaceWallHinge,
        "`hinge` of a wall of a space frame, with fibres",
        "",
    ),
    (Section::SpaceColumn, "`column` of a space frame", ""),
    (
        Section::SpaceBeam,
        "`beam_x` and `beam_y` of a space frame",
        "",
    ),
    (
        Section::Given,
        "`[[building]]` with `kind = \"given\"`",
        "Given by matrices and ports, or by mass, periods and shapes; with a plan, by matrices over x, y and rotation of every floor. See [From ETABS to jostle](how-to/from-etabs.md).",
    ),
    (Section::Matrices, "`matrices` of a given building", ""),
    (Section::Port, "`ports` of a given building, each", ""),
    (
        Section::Column,
        "`column` of a frame",
        "A rectangle, or its rigidities; with bars for `hinges.from = \"section\"`. A list in which no table has line, storeys or `omit` gives one table per storey from the ground up; otherwise every table applies to its lines and storeys. A floor has a joint where a column is below it, or where the beams of two bays meet: braces and columns above may stand there. See [Columns that differ, set-backs and podiums](how-to/podiums.md).",
    ),
    (
        Section::Beam,
        "`beam` of a frame",
        "Likewise by bay and floors. Beams span between joints: where a column is omitted, tables without `bay` omit the adjacent beams.",
    ),
    (
        Section::Profile,
        "`profile` of a column or a beam",
        "Two equal flanges and a web.",
    ),
    (Section::Slab, "`slab` of a beam", ""),
    (Section::Bars, "`bars` in rows", ""),
    (
        Section::StiffnessFactor,
        "`stiffness_factor` of a frame",
        "",
    ),
    (Section::Axial, "`axial` of a frame", ""),
    (Section::ShearDeformation, "`shear` of a frame", ""),
    (Section::Joint, "`joint` of a frame", ""),
    (
        Section::BeamJoint,
        "`joint` of a space frame, also `joint.x` and `joint.y`",
        "",
    ),
    (
        Section::SpaceJoint,
        "`joint` of a space frame by direction",
        "",
    ),
    (
        Section::FibreSteel,
        "`hinges.steel` with fibres",
        "Menegotto and Pinto (1973) with the exponents of Filippou, Popov and Bertero (1983): see [the rules](hysteresis.md#menegotto-pinto).",
    ),
    (
        Section::FibreLimits,
        "`hinges.limits` with fibres",
        "The time at which a limit is first exceeded is reported; limits do not affect the motion.",
    ),
    (
        Section::HingeSurface,
        "`hinges.surface` of columns",
        "See [Surfaces of axial force and moment](how-to/non-linear.md#surfaces).",
    ),
    (
        Section::SpaceSurface,
        "`hinges.surface` of columns of a space frame",
        "See [Surfaces in space frames](how-to/space-frames.md#surfaces).",
    ),
    (
        Section::RigidEnds,
        "`rigid_ends` of a frame",
        "The same lengths at all joints. A number is a fraction of half depths: beams are rigid over half the depth of the deeper column at the joint, columns over half the depth of the deeper beam. Member forces and hinges are at the ends of the flexible lengths.",
    ),
    (
        Section::Foundation,
        "`foundation` of a building",
        "See [Buildings on soil](how-to/soil.md).",
    ),
    (
        Section::Isolation,
        "`isolation` of a building",
        "See [Isolated buildings and moat walls](how-to/isolation.md).",
    ),
    (Section::IsolationFriction, "`isolation.friction`", ""),
    (Section::IsolationBounds, "`isolation.bounds`", ""),
    (
        Section::BearingFactors,
        "`isolation.bounds.lower`, `isolation.bounds.upper`",
        "",
    ),
    (Section::IsolationStop, "`isolation.stop`", ""),
    (
        Section::StopSide,
        "`isolation.stop.left`, `isolation.stop.right`",
        "",
    ),
    (Section::ShearBase, "`base`", ""),
    (Section::FrameBase, "`base` of a frame, further keys", ""),
    (
        Section::PlanBase,
        "`base` of a building with a plan, further keys",
        "",
    ),
    (Section::AcrossBase, "`base.across`", ""),
    (
        Section::BaseRocking,
        "`base.rotational_hinge`, `joint.hinge`",
        "",
    ),
    (Section::BaseSliding, "`base.horizontal_hinge`", ""),
    (Section::Damping, "`damping`", ""),
    (Section::ShearFailure, "`shear_failure` of a frame", ""),
    (Section::RotationLimit, "`[[building.rotation_limit]]`", ""),
    (
        Section::RotationLevels,
        "`limits` of `[[building.rotation_limit]]`",
        "",
    ),
    (Section::Hinges, "`hinges` of a frame", ""),
    (Section::Hinge, "`hinges.column`, `hinges.beam`", ""),
    (
        Section::HingeSide,
        "`positive`, `negative` of a hinge",
        "Values given here apply to that side only.",
    ),
    (
        Section::SpaceHinges,
        "`hinges` of a space frame",
        "See [Space frames](how-to/space-frames.md#hinges-that-yield).",
    ),
    (
        Section::ColumnHinge,
        "`hinges.column` of a space frame, and `hinge` of a column",
        "",
    ),
    (
        Section::StoreyHinges,
        "`hinges` of a shear building",
        "Also of an element in plan.",
    ),
    (
        Section::StoreyHingesOfAxis,
        "`hinges.x`, `hinges.y` of a shear building with a plan, or of an element",
        "Values not given here are those of `hinges`.",
    ),
    (
        Section::Pinching,
        "`pinching` of hinges",
        "With the rule `pinched`; see [Hysteresis](hysteresis.md#pinched).",
    ),
    (
        Section::Damage,
        "`damage` of hinges",
        "With the rule `pinched`.",
    ),
    (
        Section::Gap,
        "`[[gap]]`",
        "One or more for each pair of neighbours, and for walls; see [Contacts and links](contacts-and-links.md).",
    ),
    (
        Section::Crush,
        "`crush` of a gap",
        "With the laws `linear` and `hertz`; see [Contact laws](contact.md).",
    ),
    (
        Section::Link,
        "`[[link]]`",
        "Springs, dampers and sliders between neighbours, or between floors of one building; see [Dampers between two towers](how-to/dampers-between-towers.md).",
    ),
    (
        Section::Damper,
        "`[[building.damper]]`",
        "A short form of `[[link]]` inside one building.",
    ),
    (
        Section::SoilSpring,
        "`[[building.soil_spring]]`",
        "See [Basements](how-to/basements.md).",
    ),
    (
        Section::LinkLaw,
        "`[[link]]`, `[[building.damper]]`, further keys",
        "",
    ),
    (
        Section::Wall,
        "`[[wall]]`",
        "See [Isolated buildings and moat walls](how-to/isolation.md).",
    ),
    (
        Section::LinkHinge,
        "`hinge` of a link, a damper, a brace, a panel or a coupling beam, `shear_hinge` of a wall",
        "",
    ),
    (
        Section::Buckling,
        "Further keys of `hinge` of a brace with the rule `buckling`",
        "See [Braces](how-to/braces.md#buckling).",
    ),
    (
        Section::Soil,
        "`[soil]`",
        "See [Buildings on soil](how-to/soil.md).",
    ),
    (Section::SoilCoupling, "`soil.coupling`", ""),
    (
        Section::Report,
        "`[report]`",
        "See [Checks that always run](checks.md).",
    ),
    (
        Section::Site,
        "`[site]`",
        "For buildings with a plan; it does not affect results.",
    ),
    (Section::Analysis, "`[analysis]`", ""),
    (
        Section::Output,
        "`[output]`",
        "See [Which column is hit](how-to/struck-columns.md).",
    ),
    (
        Section::Codes,
        "`[codes]`",
        "Inputs of the separation rules of `jostle gap` and the report; see [how-to/required-gap.md](how-to/required-gap.md).",
    ),
    (
        Section::BuildingCodes,
        "`codes` of a building",
        "Values given here apply to that building only.",
    ),
    (
        Section::FloorSpectra,
        "`output.floor_spectra`",
        "See [how-to/floor-spectra.md](how-to/floor-spectra.md).",
    ),
    (Section::Integrator, "`analysis.integrator`", ""),
    (
        Section::Study,
        "Study file: top",
        "A separate file, for `jostle study`; see [Studies](studies.md).",
    ),
    (Section::Vary, "Study file: `[[vary]]`", ""),
    (Section::Range, "Study file: `vary.range`", ""),
    (Section::Distribution, "Study file: `vary.distribution`", ""),
    (Section::Design, "Study file: `[design]`", ""),
    (Section::Correlation, "Study file: `design.correlation`", ""),
    (Section::Fragility, "Study file: `[[fragility]]`", ""),
    (Section::Ida, "Study file: `[[ida]]`", ""),
    (Section::Sensitivity, "Study file: `[sensitivity]`", ""),
    (
        Section::Selection,
        "Study file: `[selection]`",
        "Checks whether the records are suitable for time-history analysis, by the code of the spectrum.",
    ),
    (
        Section::City,
        "City file: top",
        "A separate file, for `jostle city`; see [Which neighbours of a city collide](how-to/city.md).",
    ),
    (Section::CityInventory, "City file: `[inventory]`", ""),
    (Section::CityColumns, "City file: `inventory.columns`", ""),
    (Section::CityBuildings, "City file: `[buildings]`", ""),
    (Section::CityLevels, "City file: `buildings.level`", ""),
    (
        Section::TypesTable,
        "City file and classes file: `[buildings]`",
        "",
    ),
    (
        Section::TypesDamage,
        "City file and classes file: `[damage]`",
        "",
    ),
    (Section::CityGap, "City file: `[gap]`", ""),
    (Section::CityContact, "City file: `[contact]`", ""),
    (
        Section::CityMotion,
        "City file: `[motion]`, in addition to the keys of `[motion]` of a model",
        "",
    ),
    (Section::CityRun, "City file: `[run]`", ""),
    (
        Section::Classes,
        "Classes file: top",
        "A separate file, for `jostle classes`; see [Fragility of classes with pounding](how-to/classes.md).",
    ),
    (
        Section::ClassesSide,
        "Classes file: `[class]` and `[neighbour]`",
        "",
    ),
    (Section::ClassesPair, "Classes file: `[pair]`", ""),
    (Section::ClassesIntensity, "Classes file: `[intensity]`", ""),
    (Section::ClassesRun, "Classes file: `[run]`", ""),
    (
        Section::Comparison,
        "Map of a comparison: top",
        "A separate file, for `jostle compare`; see [Compare with a shake-table test](how-to/shake-table.md).",
    ),
    (
        Section::ComparedColumn,
        "Map of a comparison: `[[column]]`",
        "",
    ),
    (
        Section::ComparedImpacts,
        "Map of a comparison: `[[impacts]]`",
        "",
    ),
];

/// The page of all keys, with a final line break.
#[must_use]
pub fn model_reference() -> String {
    let mut page = String::from(
        "# The model file\n\n\
         Written by `jostle schema --markdown`. A file is TOML, or JSON of the same structure. A quantity is a text with a unit or a bare \
         number in SI; `jostle new` writes an example file.\n",
    );
    for (section, place, words) in TABLES {
        // Writing to a string cannot fail.
        let _ = write!(page, "\n## {place}\n\n");
        if !words.is_empty() {
            let _ = writeln!(page, "{words}\n");
        }
        page.push_str("| key | value | default | meaning |\n|---|---|---|---|\n");
        for key in KEYS.iter().filter(|key| key.section == *section) {
            let default = match (key.default, key.required) {
                (Some(default), _) => default,
                (None, true) => "**needed**",
                (None, false) => "",
            };
            let _ = writeln!(
                page,
                "| `{}` | {} | {default} | {} |",
                key.name,
                value(key),
                key.doc.replace('|', "\\|")
            );
        }
    }
    page.push_str(&ranges_heading());
    // Keys of one name and one range stand together.
    let mut ranges: Vec<(&Key, Vec<&str>)> = Vec::new();
    for (section, place, _) in TABLES {
        for key in KEYS.iter().filter(|key| key.section == *section) {
            if key.usual == Usual::NoQuantity {
                continue;
            }
            let same = |(known, _): &&mut (&Key, Vec<&str>)| {
                known.name == key.name
                    && known.usual == key.usual
                    && known.kind.dimension() == key.kind.dimension()
            };
            match ranges.iter_mut().find(same) {
                Some((_, places)) => places.push(place),
                None => ranges.push((key, vec![place])),
            }
        }
    }
    for (key, places) in ranges {
        let dimension = key.kind.dimension().unwrap_or(Dimension::Dimensionless);
        let (usual, possible) = match key.usual {
            Usual::Within(range) => (
                span(range.usual, dimension),
                span(range.possible, dimension),
            ),
            Usual::Any(why) => (format!("any: {why}"), "any".to_owned()),
            Usual::NoQuantity => continue,
        };
        let _ = writeln!(
            page,
            "| `{}` | {} | {usual} | {possible} |",
            key.name,
            places.join("; ")
        );
    }
    page
}

/// Heading and words of the table of ranges.
fn ranges_heading() -> String {
    let [shortest, longest] = FIRST_PERIOD;
    format!(
        "
## Usual ranges

A bare number is in SI, so `width = 500` is 500 m. A value outside its usual range gives a warning, which names
the unit that was probably meant. A value outside the possible range is rejected as a unit error. Zero is always accepted.
Warnings are printed by `check`, on standard error by `run` and `gap`, and are listed under `notes` in `summary.json`.

These also give a warning: a first lateral period outside {shortest} s to {longest} s, a contact softer than a storey,
and a scaled record whose peak is outside the range of `pga`. A run that would take more than
some hours of computing is rejected, with the building, step or motion that causes it.

To accept such values: `accept_unusual = true` under `[analysis]`, a list of fields such as
`accept_unusual = [\"building[0].spans\", \"analysis.step\"]` (`analysis.step` accepts a long run), in Python
`analysis={{\"accept_unusual\": True}}`, or `--accept-unusual` on the command line. Command-line options need a
unit: `--gap 100mm`, `--pga 0.35g`.

| key | where | usual | possible |
|---|---|---|---|
"
    )
}

/// Short description of the type of a value.
fn value(key: &Key) -> String {
    let quantity = |dimension: Dimension| match dimension {
        Dimension::Dimensionless => "number".to_owned(),
        _ => format!("{dimension}, `\"{}\"`", dimension.example()),
    };
    let words = |words: &[&str]| {
        let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        quoted.join(" ")
    };
    match key.kind {
        Kind::Text => "text".into(),
        Kind::TextOrTexts => "text, or a list of texts".into(),
        Kind::Texts => "list of texts".into(),
        Kind::Component => "text or number".into(),
        Kind::Count => "whole number".into(),
        Kind::Counts => "list of whole numbers".into(),
        Kind::Any => "value or list".into(),
        Kind::Named(_) => "table of tables".into(),
        Kind::TextOrMotion => "text, a list of texts, or a table like `[motion]`".into(),
        Kind::Plan => "two lengths, a list of corners, or a list of tables".into(),
        Kind::PlanPoints => "two lengths; or a list of such pairs".into(),
        Kind::PlanStiffness => "stiffness, or a table; or a list from the ground up".into(),
        Kind::NumberLists => "list of lists of numbers".into(),
        Kind::TextOrNumbers => "Matrix Market file, or lists of numbers".into(),
        Kind::FlagOrTexts => "`true` or `false`, or a list of texts".into(),
        Kind::FlagTextsOrTable(_) => "`true` or `false`, a list of texts, or a table".into(),
        Kind::OneOrMore(dimension) => format!("{}; or a list", quantity(dimension)),
        Kind::FlagOrChoices(choices) => {
            format!("`true` or `false`, or one or a list of {}", words(choices))
        }
        Kind::Flag => "`true` or `false`".into(),
        Kind::Quantity(dimension) => quantity(dimension),
        Kind::PerStorey(dimension) => {
            format!("{}; or a list from the ground up", quantity(dimension))
        }
        Kind::Quantities(dimension) => format!("list: {}", quantity(dimension)),
        Kind::ContactStiffness => "`\"2e9 N/m^1.5\"` or `\"500 MN/m\"`, by the law".into(),
        Kind::LinkDamping => "`\"2 MN.s/m\"`; for viscous `\"150 kN.(s/m)^0.35\"`".into(),
        Kind::CountPerSpan => "whole number, or one per span".into(),
        Kind::Modes => "one or two mode numbers".into(),
        Kind::Choice(choices) | Kind::Word(choices) => words(choices),
        Kind::WordOr(word, dimension) => format!("`{word}`; {}", quantity(dimension)),
        Kind::ChoiceOr(choices, dimension) => {
            format!("{}; {}", words(choices), quantity(dimension))
        }
        Kind::WordOrTable(word, _) => format!("`{word}`, or a table"),
        Kind::ChoiceOrTable(choices, _) => format!("{}, or a table", words(choices)),
        Kind::NumberOrTable(_) => "number, or a table".into(),
        Kind::NumbersOrTable(_) => "number, or a list, or a table".into(),
        Kind::Table(_) | Kind::TableOf(_) => "table".into(),
        Kind::TablePerStorey(_) => "table; or a list from the ground up".into(),
        Kind::TablePerPlace(_) => "table; or a list of tables, each for some positions".into(),
        Kind::FromTo => "number; or the first and the last".into(),
        Kind::OneOrTwo => "whole number, or two".into(),
        Kind::TextOrTable(_) => "text, or a table".into(),
        Kind::Tables(_) => "tables".into(),
        Kind::Neighbours => "`[\"J1\", \"J2\"]`".into(),
        Kind::FloorPairs => {
            "`common` `all`; pairs `[[5, 5], [4, \"12.8 m\"]]`; heights `[\"3 m\"]`".into()
        }
        Kind::PerContact(dimension) => {
            format!("{}; or a list, one per contact", quantity(dimension))
        }
        Kind::Concrete(grades) => format!("{}; or `f'c = 4 ksi`", words(grades)),
        Kind::ConcreteOr(grades) => {
            format!("{}; `f'c = 4 ksi`; or a strength", words(grades))
        }
        Kind::GradeOr(grades) => format!("{}; or a strength", words(grades)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_told_once() {
        for key in KEYS {
            let places = TABLES
                .iter()
                .filter(|(section, ..)| *section == key.section);
            assert_eq!(places.count(), 1, "{key:?}");
        }
    }

    #[test]
    fn the_page_in_the_documentation_is_this_one() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/model-file.md");
        let kept = std::fs::read_to_string(path).unwrap_or_default();
        assert!(
            kept == model_reference(),
            "docs/model-file.md is out of date: cargo run -- schema --markdown > docs/model-file.md"
        );
    }
}
