//! The page of `jostle section`: sections with their bars, moment and curvature, and what is fitted.

use jostle::hysteresis::{Corner, Side};
use jostle_section::{Analysis, EndCurve, Section, SectionSurvey};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{POLICY, STYLE, on_paper, theme_button, theme_script};
use crate::format::{
    FORCE, HEIGHT, LENGTH, MOMENT, STRESS, Units, fixed, in_unit, significant, units,
};
use crate::message;
use crate::scale::Scale;

/// Plot area: left, top, width, height.
const AREA: [f64; 4] = [64.0, 14.0, 420.0, 260.0];
/// Side of the square that a section is drawn into.
const DRAWING: f64 = 220.0;
/// Room beside it for its depth.
const BESIDE: f64 = 90.0;

/// The whole page.
#[must_use]
pub fn render_sections(title: &str, surveys: &[SectionSurvey]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (message::title_sections(title)) }
                style { (PreEscaped(STYLE)) }
                (on_paper(title))
            }
            body {
                header class="head" {
                    div {
                        p class="kicker" { (message::from_reinforcement_to_hinge()) }
                        h1 { (title) }
                        p { (message::cracking_and_yield_of_members()) }
                    }
                    (theme_button())
                }
                main {
                    @if let Some(verdict) = verdict(surveys) { p.verdict { (verdict) } }
                    @for survey in surveys { (sheet(survey)) }
                    p class="quiet" {
                        (message::rotations_of_a_member_end())
                    }
                }
                (theme_script())
            }
        }
    };
    page.into_string()
}

/// The result in a sentence: where the sections yield, by fibre analysis if there is one.
fn verdict(surveys: &[SectionSurvey]) -> Option<String> {
    let weaker = |survey: &SectionSurvey| {
        let ends = match &survey.analysis {
            Ok(analysis) => &analysis.ends,
            Err(_) => &survey.formula,
        };
        let sides = survey
            .sides()
            .iter()
            .map(|side| ends.sides[side.index()].yielding);
        let least = sides.min_by(|a, b| a.force.total_cmp(&b.force));
        least.filter(|least| least.force > 0.0)
    };
    let moment = |corner: &Corner| in_unit(MOMENT, corner.force, 0);
    if let [survey] = surveys {
        let end = weaker(survey)?;
        let rotation = fixed(end.deformation * 1e3, 2);
        return Some(message::section_yields(
            &survey.name,
            moment(&end),
            rotation,
        ));
    }
    let all = || surveys.iter().filter_map(weaker);
    let least = all().min_by(|a, b| a.force.total_cmp(&b.force))?;
    let most = all().max_by(|a, b| a.force.total_cmp(&b.force))?;
    Some(message::sections_yield(
        surveys.len(),
        moment(&least),
        moment(&most),
    ))
}

fn sheet(survey: &SectionSurvey) -> Markup {
    let section = &survey.section;
    html! {
        section {
            h2 { (survey.name) }
            p {
                (message::section_in_words(in_unit(LENGTH, section.width, 0), in_unit(LENGTH, section.depth, 0), section.bars.len(), fixed(section.steel_area() / section.area() * 100.0, 2), significant(STRESS.of(section.concrete.strength), 3), in_unit(STRESS, section.steel.yield_strength, 0), in_unit(FORCE, survey.compression, 0), fixed(section.axial_ratio(survey.compression), 2), in_unit(HEIGHT, survey.length, 2)))
            }
            div style="display:flex;flex-wrap:wrap;gap:1rem;align-items:flex-start" {
                figure style="flex:0 1 15rem" { (drawing(section)) figcaption class="quiet" { (message::positive_moment_the_bottom()) } }
                @match &survey.analysis {
                    Ok(analysis) => {
                        @for &side in survey.sides() {
                            figure style="flex:1 1 24rem;max-width:34rem" { (plot(survey, analysis, side)) figcaption class="quiet" { (caption(survey, side)) } }
                        }
                    }
                    Err(error) => { p class="note" { (message::no_moment_curvature_analysis(error.to_string())) } }
                }
            }
            div class="scroll" {
                table {
                    thead { tr { th { (message::method()) } th { (message::cracking_kn_m()) } th { (message::at_mrad()) } th { (message::yield_kn_m()) } th { (message::at_mrad()) } th { (message::secant_at_yield_k()) } th { (message::after_yield_k()) } } }
                    tbody {
                        @for &side in survey.sides() {
                            (row(survey, message::formula(), &survey.formula, side))
                            @if let Ok(analysis) = &survey.analysis { (row(survey, message::fibre(), &analysis.ends, side)) }
                        }
                    }
                }
            }
        }
    }
}

fn side_name(survey: &SectionSurvey, side: Side) -> &'static str {
    match (survey.is_symmetric(), side) {
        (true, _) => "",
        (_, Side::Positive) => message::positive(),
        (_, Side::Negative) => message::negative(),
    }
}

fn caption(survey: &SectionSurvey, side: Side) -> String {
    message::moment_against_curvature_analysis(side_name(survey, side))
}

fn row(survey: &SectionSurvey, name: &str, ends: &EndCurve, side: Side) -> Markup {
    let end = ends.sides[side.index()];
    let gross = survey.gross_stiffness();
    html! {
        tr {
            td { (name) (side_name(survey, side)) }
            @if end.yielding.force > 0.0 {
                td { (in_unit(MOMENT, end.cracking.force, 1)) }
                td { (fixed(end.cracking.deformation * 1e3, 3)) }
                td { (in_unit(MOMENT, end.yielding.force, 1)) }
                td { (fixed(end.yielding.deformation * 1e3, 3)) }
                td { (fixed(end.yielding.force / end.yielding.deformation / gross, 3)) }
                td { (fixed(end.post_yield / gross, 4)) }
            } @else {
                td colspan="6" { (message::axial_load_exceeds_the_strength()) }
            }
        }
    }
}

/// The section with its bars, to scale.
fn drawing(section: &Section) -> Markup {
    let scale = (DRAWING - BESIDE) / section.width.max(section.depth);
    let (width, depth) = (section.width * scale, section.depth * scale);
    let (left, top) = (0.5 * (DRAWING - 20.0 - width), 14.0);
    let inset = section.cover * scale;
    html! {
        svg viewBox={ "0 0 " (DRAWING) " " (depth + 50.0) } role="img" aria-label=(message::cross_section_with_its_bars()) {
            rect x=(left) y=(top) width=(width) height=(depth) fill="var(--c0)" fill-opacity="0.10" stroke="var(--ink)" stroke-width="1.5" {}
            @if section.ties.is_some() {
                rect x=(left + inset - 2.0) y=(top + inset - 2.0) width=(width - 2.0 * inset + 4.0) height=(depth - 2.0 * inset + 4.0)
                    rx="4" fill="none" stroke="var(--ink)" stroke-width="1.2" {}
            }
            @for bar in &section.bars {
                circle cx=(left + bar.x * scale) cy=(top + bar.depth * scale) r=(0.5 * bar.diameter * scale) fill="var(--c1)" {}
            }
            g class="grid" {
                text x=(left + 0.5 * width) y=(top + depth + 20.0) text-anchor="middle" { (in_unit(LENGTH, section.width, 0)) " " (LENGTH.name()) }
                text x=(left + width + 8.0) y=(top + 0.5 * depth + 4.0) { (in_unit(LENGTH, section.depth, 0)) " " (LENGTH.name()) }
            }
        }
    }
}

fn plot(survey: &SectionSurvey, analysis: &Analysis, side: Side) -> Markup {
    let (curve, fit) = (&analysis.curves[side.index()], &analysis.fits[side.index()]);
    let largest = |of: fn(&Corner) -> f64| curve.points.iter().map(of).fold(1e-12, f64::max);
    let (far, high) = (
        1.03 * largest(|point| point.deformation),
        1.12 * largest(|point| point.force).max(fit.yielding.force),
    );
    let [left, top, width, height] = AREA;
    // An inch is 0.0254 m.
    let (unit, unit_name) = match units() {
        Units::Si => (1e-3, "1/km"),
        Units::Us => (1e-3 / 0.0254, "10⁻³/in"),
    };
    let x = Scale::new([0.0, far], [left, left + width], unit, 5.0);
    let y = Scale::new([0.0, high], [top + height, top], MOMENT.size(), 5.0);
    let place = |corner: &Corner| [x.at(corner.deformation), y.at(corner.force)];
    let path = |points: &[Corner]| {
        let text: Vec<String> = points
            .iter()
            .map(|point| {
                let [x, y] = place(point);
                format!("{x:.1},{y:.1}")
            })
            .collect();
        format!("M{}", text.join(" L"))
    };
    let fitted = [Corner::default(), fit.cracking, fit.yielding, fit.ultimate];
    html! {
        svg viewBox="0 0 500 320" role="img" aria-label={ (message::moment_against_curvature(side_name(survey, side))) } {
            g class="grid" {
                (x.across([top, top + height]))
                (y.up([left, left + width]))
                text x=(left + width / 2.0) y=(top + height + 38.0) text-anchor="middle" { (message::curvature_in_unit(unit_name)) }
                text x="14" y=(top + height / 2.0) text-anchor="middle" transform={ "rotate(-90 14 " (top + height / 2.0) ")" } { (message::moment_kn_m()) }
            }
            path class="line" style="--c:var(--c0)" d=(path(&curve.points)) {}
            path class="line dashed" style="--c:var(--c1)" d=(path(&fitted)) {}
            @for (number, event) in curve.events.iter().enumerate() {
                @let [x, y] = place(&Corner { deformation: event.curvature, force: event.moment });
                circle cx=(x) cy=(y) r="3.5" fill="var(--c0)" {}
                text x=(x + if number % 2 == 0 { -6.0 } else { 6.0 }) y=(y - 8.0) text-anchor="middle" font-size="11" fill="var(--ink)" { (number + 1) }
            }
            @for (number, event) in curve.events.iter().enumerate() {
                text x=(left + width - 8.0) y=(top + height - 8.0 - 15.0 * (curve.events.len() - 1 - number) as f64) text-anchor="end" font-size="11" fill="var(--ink)" {
                    (number + 1) " " (event.kind.describe()) ", " (in_unit(MOMENT, event.moment, 1)) " " (MOMENT.name())
                }
            }
        }
    }
}
