//! `jostle section`: from reinforcement to the moments at which a member cracks and yields.

use std::fmt::Write;

use jostle::hysteresis::Side;
use jostle_io::{Dimension, parse_concrete, parse_quantity, parse_steel};
use jostle_section::formula::Member;
use jostle_section::{
    EndCurve, EndSide, Reinforcement, Section, SectionSurvey, StrengthLevel, Ties,
};
use serde_json::{Value, json};

use crate::args::SectionArgs;
use crate::failure::Failure;
use crate::replace::Target;
use crate::terminal;
use jostle_run::FileKind;
use jostle_run::read;
use jostle_run::{BOLD, DIM, styled};

pub(crate) fn section(args: &SectionArgs) -> Result<(), Failure> {
    let page = Target::of_option(args.html.as_ref(), FileKind::SECTIONS, args.force)?;
    let (title, surveys) = match &args.model {
        Some(path) => of_model(path)?,
        None => ("Section".to_owned(), vec![of_options(args)?]),
    };
    if let Some(page) = &page {
        page.write(&jostle_report::render_sections(&title, &surveys))?;
    }
    if args.json {
        let list: Vec<Value> = surveys.iter().map(as_json).collect();
        let text = serde_json::to_string_pretty(&json!({ "sections": list }));
        return terminal::print(&text.unwrap_or_default());
    }
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = describe(&mut text, &surveys);
    if let Some(path) = &args.html {
        let _ = writeln!(text, "Page: {}", path.display());
    }
    terminal::print(&text)
}

/// The section that the options describe.
fn of_options(args: &SectionArgs) -> Result<SectionSurvey, Failure> {
    let wrong = |option: &str, problem: String| Failure::Input(format!("{option}: {problem}"));
    let quantity = |option: &str, text: &str, dimension| {
        parse_quantity(text, dimension).map_err(|error| wrong(option, error.to_string()))
    };
    let length_of = |option: &str, text: &Option<String>| {
        quantity(
            option,
            text.as_deref().unwrap_or_default(),
            Dimension::Length,
        )
    };
    let level = StrengthLevel::named(&args.strength).unwrap_or_default();
    let concrete =
        parse_concrete(&args.concrete, level).map_err(|problem| wrong("--concrete", problem))?;
    let steel = parse_steel(&args.steel, level).map_err(|problem| wrong("--steel", problem))?;
    let bars = args.bars.as_deref().unwrap_or_default();
    let bars = Reinforcement::parse(bars).map_err(|error| wrong("--bars", error.to_string()))?;
    let ties = args.ties.as_deref().map(Ties::parse).transpose();
    let ties = ties.map_err(|error| wrong("--ties", error.to_string()))?;
    let section = Section::new(
        length_of("--width", &args.width)?,
        length_of("--depth", &args.depth)?,
        concrete,
        steel,
        &bars,
        quantity("--cover", &args.cover, Dimension::Length)?,
        ties,
    );
    let section = section.map_err(|faults| {
        let lines: Vec<String> = faults.iter().map(|fault| format!("--{fault}")).collect();
        Failure::Input(lines.join("\n"))
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

/// The distinct reinforced members of a model.
fn of_model(path: &std::path::Path) -> Result<(String, Vec<SectionSurvey>), Failure> {
    let input = read(path)?;
    let mut kinds: Vec<(&jostle_io::ReinforcedMember, Vec<(usize, usize)>)> = Vec::new();
    for member in &input.reinforced {
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
        return Err(Failure::Input(format!(
            "{} has no reinforced members; add steel = \"HRB400\", bars = \"12 d20\" and cover = \"35 mm\" to column or beam",
            path.display()
        )));
    }
    let surveys = kinds.into_iter().map(|(member, places)| {
        let building = &input.model.buildings[member.building].name;
        let (kind, across) = match member.member {
            Member::Column => ("column", "line"),
            Member::Beam => ("beam", "bay"),
        };
        let name = format!("{building}: {kind}, {}", places_text(&places, across));
        SectionSurvey::new(
            name,
            member.section.clone(),
            member.member,
            member.compression,
            member.length,
        )
    });
    let surveys = surveys.collect();
    Ok((input.model.title, surveys))
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

fn describe(text: &mut String, surveys: &[SectionSurvey]) -> std::fmt::Result {
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
            "  N = {:.0} kN, {:.2} of the concrete; length {:.2} m; gross 6EI/L = {:.1} MN.m/rad",
            survey.compression * 1e-3,
            section.axial_ratio(survey.compression),
            survey.length,
            survey.gross_stiffness() * 1e-6
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
                "              kN.m      mrad      kN.m      mrad      ×K       ×K"
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
                            format!("{} {:.1}", event.kind.describe(), event.moment * 1e-3)
                        })
                        .collect();
                    writeln!(
                        text,
                        "  {}",
                        styled(DIM, &format!("          {} kN.m", events.join(" → ")))
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
                "{:.0} × {:.0} mm, {bars} bars ({:.2} %)",
                section.width * 1e3,
                section.depth * 1e3,
                share * 100.0
            )
        )
    )?;
    writeln!(
        text,
        "  concrete {:.1} MPa, tension {:.2} MPa, E {:.1} GPa; steel {:.0} MPa; {}",
        section.concrete.strength * 1e-6,
        section.concrete.tensile_strength * 1e-6,
        section.concrete.modulus * 1e-9,
        section.steel.yield_strength * 1e-6,
        match section.ties {
            Some(ties) => format!(
                "core confined by ties of {:.0} mm every {:.0} mm, {} legs",
                ties.diameter * 1e3,
                ties.spacing * 1e3,
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
    let gross = survey.gross_stiffness();
    writeln!(
        text,
        "  {name:10}{:8.1} {:9.3} {:9.1} {:9.3} {:8.3} {:8.4}",
        cracking.force * 1e-3,
        cracking.deformation * 1e3,
        yielding.force * 1e-3,
        yielding.deformation * 1e3,
        yielding.force / yielding.deformation / gross,
        post_yield / gross
    )
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
                "secant_ratio": yielding.force / yielding.deformation / survey.gross_stiffness(),
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
