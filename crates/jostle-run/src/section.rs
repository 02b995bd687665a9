//! From reinforcement to the moments at which a member cracks and yields.

use std::fmt::Write;

use jostle::Structure;
use jostle::hysteresis::Side;
use jostle_io::shown::{FORCE, HEIGHT, LENGTH, MODULUS, MOMENT, ROTATIONAL_STIFFNESS, STRESS};
use jostle_io::{Dimension, Input, parse_concrete, parse_quantity, parse_steel};
use jostle_section::formula::Member;
use jostle_section::{
    EndCurve, EndSide, Reinforcement, Section, SectionSurvey, StrengthLevel, Ties,
};
use serde_json::{Value, json};

use crate::error::RunError;
use crate::numbers::counted;
use crate::style::{BOLD, DIM, styled};

/// A reinforced section and its member, as written: numbers in SI, or with a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectionOptions {
    /// Width, across the direction of bending, > 0.
    pub width: String,
    /// Depth, in the direction of bending, > 0.
    pub depth: String,
    /// Bars, such as `12 d20` around, or `4 d25 top, 3 d25 bottom`.
    pub bars: String,
    /// Grade of concrete, or its prismatic strength.
    pub concrete: String,
    /// Grade of steel, or its yield strength.
    pub steel: String,
    /// Strength that belongs to a grade.
    pub strength: String,
    /// Concrete cover of the bars, > 0.
    pub cover: String,
    /// Ties that confine the core, such as `d10 @ 100 mm`.
    pub ties: Option<String>,
    /// Axial compression; without it, a beam.
    pub axial_load: Option<String>,
    /// Length of the member, bent in double curvature, 0.1 m to 1000 m.
    pub length: String,
}

impl Default for SectionOptions {
    /// C30 and HRB400 with characteristic strength, 35 mm of cover, 3 m long; the section is not stated.
    fn default() -> Self {
        Self {
            width: String::new(),
            depth: String::new(),
            bars: String::new(),
            concrete: "C30".into(),
            steel: "HRB400".into(),
            strength: StrengthLevel::NAMES[0].into(),
            cover: "35 mm".into(),
            ties: None,
            axial_load: None,
            length: "3 m".into(),
        }
    }
}

/// The section that the options describe.
///
/// # Errors
/// [`RunError::Argument`] with the option first.
pub fn section(args: &SectionOptions) -> Result<SectionSurvey, RunError> {
    let wrong = |option: &str, problem: String| RunError::Argument(format!("{option}: {problem}"));
    let quantity = |option: &str, text: &str, dimension| {
        parse_quantity(text, dimension).map_err(|error| wrong(option, error.to_string()))
    };
    let level = StrengthLevel::named(&args.strength).ok_or_else(|| {
        let names = StrengthLevel::NAMES.join(", ");
        wrong(
            "--strength",
            format!("must be one of {names}, found \"{}\"", args.strength),
        )
    })?;
    let concrete =
        parse_concrete(&args.concrete, level).map_err(|problem| wrong("--concrete", problem))?;
    let steel = parse_steel(&args.steel, level).map_err(|problem| wrong("--steel", problem))?;
    let bars =
        Reinforcement::parse(&args.bars).map_err(|error| wrong("--bars", error.to_string()))?;
    let ties = args.ties.as_deref().map(Ties::parse).transpose();
    let ties = ties.map_err(|error| wrong("--ties", error.to_string()))?;
    let section = Section::new(
        quantity("--width", &args.width, Dimension::Length)?,
        quantity("--depth", &args.depth, Dimension::Length)?,
        concrete,
        steel,
        &bars,
        quantity("--cover", &args.cover, Dimension::Length)?,
        ties,
    );
    let section = section.map_err(|faults| {
        let lines: Vec<String> = faults.iter().map(|fault| format!("--{fault}")).collect();
        RunError::Argument(lines.join("\n"))
    })?;
    let length = quantity("--length", &args.length, Dimension::Length)?;
    if !(0.1..=1000.0).contains(&length) {
        return Err(wrong(
            "--length",
            format!("must lie between 0.1 m and 1000 m, found {length} m"),
        ));
    }
    let (member, load) = match &args.axial_load {
        Some(text) => (
            Member::Column,
            quantity("--axial-load", text, Dimension::Force)?,
        ),
        None => (Member::Beam, 0.0),
    };
    let name = match member {
        Member::Column => "Column",
        Member::Beam => "Beam",
    };
    Ok(SectionSurvey::new(
        name.to_owned(),
        section,
        member,
        load,
        length,
    ))
}

/// The distinct reinforced members of a model; `name` is used in messages.
///
/// # Errors
/// [`RunError::Argument`] if no member is reinforced.
pub fn sections(input: &Input, name: &str) -> Result<Vec<SectionSurvey>, RunError> {
    let mut kinds: Vec<(&jostle_io::ReinforcedMember, Vec<(usize, usize)>)> = Vec::new();
    for member in &input.members.reinforced {
        let alike = kinds.iter_mut().find(|(other, _)| {
            other.building == member.building
                && other.member == member.member
                && (other.compression - member.compression).abs() < 50.0
                && other.length == member.length
                && other.section == member.section
        });
        match alike {
            Some((_, places)) => places.push((member.floor, member.place)),
            None => kinds.push((member, vec![(member.floor, member.place)])),
        }
    }
    if kinds.is_empty() {
        return Err(RunError::Argument(format!(
            "{name} has no reinforced members; add steel = \"HRB400\", bars = \"12 d20\" and cover = \"35 mm\" to column or beam"
        )));
    }
    let surveys = kinds.into_iter().map(|(member, places)| {
        let building = &input.model.buildings[member.building];
        let (kind, across) = match member.member {
            Member::Column => ("column", "line"),
            Member::Beam => ("beam", "bay"),
        };
        let places = match (&building.structure, places.len() - 1) {
            (Structure::Frame(_), _) => format!("{kind}, {}", places_text(&places, across)),
            (_, 0) => member.name.clone(),
            (_, others) => format!("{} and {}", member.name, counted(others, "other")),
        };
        let name = format!("{}: {places}", building.name);
        SectionSurvey::new(
            name,
            member.section.clone(),
            member.member,
            member.compression,
            member.length,
        )
    });
    Ok(surveys.collect())
}

/// Storeys and lines of equal members, in short.
fn places_text(places: &[(usize, usize)], across: &str) -> String {
    let mut floors: Vec<usize> = places.iter().map(|(floor, _)| *floor).collect();
    floors.dedup();
    let first = places.first().map_or(0, |(floor, _)| *floor);
    let listed: Vec<String> = places
        .iter()
        .filter(|(floor, _)| *floor == first)
        .map(|(_, place)| place.to_string())
        .collect();
    let floors = match floors[..] {
        [only] => format!("storey {only}"),
        [from, .., to] if to - from + 1 == floors.len() => format!("storeys {from} to {to}"),
        _ => format!(
            "storeys {}",
            floors
                .iter()
                .map(usize::to_string)
                .collect::<Vec<_>>()
                .join(", ")
        ),
    };
    let plural = if listed.len() == 1 { "" } else { "s" };
    format!("{floors}, {across}{plural} {}", listed.join(", "))
}

/// Sections in words.
#[must_use]
pub fn sections_text(surveys: &[SectionSurvey]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = describe(&mut text, surveys);
    text
}

fn describe(text: &mut String, surveys: &[SectionSurvey]) -> std::fmt::Result {
    let moment = MOMENT.name();
    let mut last: Option<&Section> = None;
    for survey in surveys {
        let section = &survey.section;
        if last != Some(section) {
            heading(text, section)?;
            last = Some(section);
        }
        writeln!(text, "\n  {}", styled(BOLD, &survey.name))?;
        writeln!(
            text,
            "  N = {}, {:.2} of the concrete; length {}; gross 6EI/L = {} {}",
            FORCE.text(survey.compression, 0),
            section.axial_ratio(survey.compression),
            HEIGHT.text(survey.length, 2),
            ROTATIONAL_STIFFNESS.number(survey.gross_stiffness(), 1),
            ROTATIONAL_STIFFNESS.name()
        )?;
        writeln!(
            text,
            "  {}",
            styled(
                DIM,
                "             cracking             yield               secant   after"
            )
        )?;
        writeln!(
            text,
            "  {}",
            styled(
                DIM,
                &format!("  {moment:>16}      mrad    {moment:>6}      mrad      ×K       ×K")
            )
        )?;
        for &side in survey.sides() {
            let tag = match (survey.is_symmetric(), side) {
                (true, _) => "",
                (_, Side::Positive) => " +",
                (_, Side::Negative) => " −",
            };
            row(
                text,
                &format!("formula{tag}"),
                survey,
                &survey.formula,
                side,
            )?;
            match &survey.analysis {
                Ok(analysis) => {
                    row(text, &format!("fibre{tag}"), survey, &analysis.ends, side)?;
                    let events: Vec<String> = analysis.curves[side.index()]
                        .events
                        .iter()
                        .map(|event| {
                            let moment = MOMENT.number(event.moment, 1);
                            format!("{} {moment}", event.kind.describe())
                        })
                        .collect();
                    writeln!(
                        text,
                        "  {}",
                        styled(DIM, &format!("          {} {moment}", events.join(" → ")))
                    )?;
                }
                Err(error) => {
                    writeln!(text, "  fibre{tag:5} {error}")?;
                    break;
                }
            }
        }
    }
    writeln!(
        text,
        "\nMoments and rotations of a member end in double curvature; ratios to K = 6EI/L of the gross section.\n\
         formula: AIJ moments, secant at yield after Sugano. fibre: moment–curvature analysis, trilinear of equal energy."
    )
}

fn heading(text: &mut String, section: &Section) -> std::fmt::Result {
    let bars = section.bars.len();
    let share = section.steel_area() / section.area();
    writeln!(
        text,
        "{}",
        styled(
            BOLD,
            &format!(
                "{} × {}, {bars} bars ({:.2} %)",
                LENGTH.number(section.width, 0),
                LENGTH.text(section.depth, 0),
                share * 100.0
            )
        )
    )?;
    writeln!(
        text,
        "  concrete {}, tension {}, E {}; steel {}; {}",
        STRESS.text(section.concrete.strength, 1),
        STRESS.text(section.concrete.tensile_strength, 2),
        MODULUS.text(section.concrete.modulus, 1),
        STRESS.text(section.steel.yield_strength, 0),
        match section.ties {
            Some(ties) => format!(
                "core confined by ties of {} every {}, {} legs",
                LENGTH.text(ties.diameter, 0),
                LENGTH.text(ties.spacing, 0),
                ties.legs
            ),
            None => "no confinement".to_owned(),
        }
    )
}

fn row(
    text: &mut String,
    name: &str,
    survey: &SectionSurvey,
    ends: &EndCurve,
    side: Side,
) -> std::fmt::Result {
    let EndSide {
        cracking,
        yielding,
        post_yield,
    } = ends.sides[side.index()];
    if yielding.force <= 0.0 {
        return writeln!(
            text,
            "  {name:10} does not yield in bending: the axial load alone exceeds its strength"
        );
    }
    let gross = survey.gross_stiffness();
    writeln!(
        text,
        "  {name:10}{:>8} {:9.3} {:>9} {:9.3} {:8.3} {:8.4}",
        MOMENT.number(cracking.force, 1),
        cracking.deformation * 1e3,
        MOMENT.number(yielding.force, 1),
        yielding.deformation * 1e3,
        yielding.force / yielding.deformation / gross,
        post_yield / gross
    )
}

/// The JSON of `jostle section`: numbers by formulas and by fibre analysis.
#[must_use]
pub fn sections_json(surveys: &[SectionSurvey]) -> Value {
    let list: Vec<Value> = surveys.iter().map(as_json).collect();
    json!({ "sections": list })
}

fn as_json(survey: &SectionSurvey) -> Value {
    let ends = |curve: &EndCurve| {
        let side = |side: Side| {
            let EndSide {
                cracking,
                yielding,
                post_yield,
            } = curve.sides[side.index()];
            json!({
                "cracking_moment_nm": cracking.force,
                "cracking_rotation_rad": cracking.deformation,
                "yield_moment_nm": yielding.force,
                "yield_rotation_rad": yielding.deformation,
                "secant_ratio": (yielding.force > 0.0)
                    .then(|| yielding.force / yielding.deformation / survey.gross_stiffness()),
                "post_yield_stiffness_nm_rad": post_yield,
            })
        };
        json!({ "positive": side(Side::Positive), "negative": side(Side::Negative) })
    };
    let fibre = match &survey.analysis {
        Ok(analysis) => {
            let mut value = ends(&analysis.ends);
            for (name, curve) in ["positive", "negative"].into_iter().zip(&analysis.curves) {
                let points = |of: fn(&jostle::hysteresis::Corner) -> f64| {
                    curve.points.iter().map(of).collect::<Vec<_>>()
                };
                value[name]["curvature_1_m"] = json!(points(|point| point.deformation));
                value[name]["moment_nm"] = json!(points(|point| point.force));
                value[name]["events"] = curve
                    .events
                    .iter()
                    .map(|event| {
                        json!({
                            "what": event.kind.describe(),
                            "curvature_1_m": event.curvature,
                            "moment_nm": event.moment,
                            "neutral_axis_m": event.neutral_axis,
                        })
                    })
                    .collect();
            }
            value
        }
        Err(error) => json!({ "error": error.to_string() }),
    };
    json!({
        "name": survey.name,
        "width_m": survey.section.width,
        "depth_m": survey.section.depth,
        "steel_area_m2": survey.section.steel_area(),
        "axial_load_n": survey.compression,
        "axial_ratio": survey.section.axial_ratio(survey.compression),
        "length_m": survey.length,
        "gross_stiffness_nm_rad": survey.gross_stiffness(),
        "formula": ends(&survey.formula),
        "fibre": fibre,
    })
}
