//! The page of `jostle method`: size of the equations for every building, and accuracy of each solver formulation.

use jostle::method::{MethodSurvey, StepAccuracy};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{POLICY, STYLE, on_paper, theme_button, theme_script};
use crate::scale::name_upwards;
use crate::{format, message};

/// Which error of a row to show.
type ErrorOf = fn(&StepAccuracy) -> f64;

/// Errors below this are rounding and drawn at the lower edge \[–\].
const FINEST: f64 = 1e-16;
/// Error at which no digit is right \[–\].
const LOST: f64 = 1.0;
/// Plot area: left, top, width, height.
const AREA: [f64; 4] = [64.0, 14.0, 640.0, 300.0];

/// The whole page of a survey.
#[must_use]
pub fn render_method(title: &str, surveys: &[MethodSurvey]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (message::the_method(title)) }
                style { (PreEscaped(STYLE)) }
                (on_paper(title))
            }
            body {
                header class="head" {
                    div {
                        p class="kicker" { (message::the_method_on_this_model()) }
                        h1 { (title) }
                        p { (message::size_of_the_equations()) }
                    }
                    (theme_button())
                }
                main {
                    @if let Some(verdict) = verdict(surveys) { p.verdict { (verdict) } }
                    @for survey in surveys { section { h2 { (survey.name) } (building(survey)) } }
                    (explanation(surveys))
                }
                (theme_script())
            }
        }
    };
    page.into_string()
}

/// The result in a sentence.
fn verdict(surveys: &[MethodSurvey]) -> Option<String> {
    let steps = || surveys.iter().flat_map(|survey| &survey.accuracy);
    let worst = steps().map(|step| step.riccati).max_by(f64::total_cmp)?;
    let least = steps().map(|step| step.step).min_by(f64::total_cmp)?;
    let digits = (-worst.max(FINEST).log10()).floor().max(0.0);
    Some(message::riccati_keeps(
        format::fixed(digits, 0),
        format::plain(1e3 * least, 3),
    ))
}

/// The same inside the report of a run; empty without surveys.
pub(crate) fn section(surveys: &[MethodSurvey]) -> Markup {
    html! {
        @if !surveys.is_empty() {
            section #method {
                h2 { (message::the_method_on_these_buildings()) }
                p { (message::size_of_the_equations_of_one()) }
                @for (index, survey) in surveys.iter().enumerate() {
                    details open[index == 0] { summary { (survey.name) } (building(survey)) }
                }
                (explanation(surveys))
            }
        }
    }
}

fn explanation(surveys: &[MethodSurvey]) -> Markup {
    html! {
        p class="quiet" {
            (message::errors_are_the_largest_difference())
            @if surveys.iter().any(|survey| survey.yields) { " " (message::hinges_have_their_initial_stiffness()) }
        }
    }
}

fn building(survey: &MethodSurvey) -> Markup {
    html! {
        div {
            p { (elements(survey)) }
            div class="scroll" {
                table {
                    thead { tr { th { (message::form()) } th { (message::unknowns()) } th { (message::kept_per_step_size()) } th { (message::multiply_adds_per_solution()) } } }
                    tbody {
                        tr {
                            td { (message::total_transfer_equation_product()) }
                            @if survey.product_unknowns > 0 {
                                td { (survey.product_unknowns) }
                                td { (message::product_unknowns_entries(survey.product_unknowns.pow(2))) }
                                td { (message::and_two_passes_through(survey.product_unknowns.pow(2))) }
                            } @else {
                                td colspan="3" { @if survey.yields { (message::transfer_matrices_do_not_support()) } @else { (message::no_transfer_path_through()) } }
                            }
                        }
                        tr {
                            td { (message::riccati_recursion()) }
                            td { (survey.degrees_of_freedom) }
                            td { (message::couplings_couplings(survey.couplings)) }
                            td { (2 * survey.couplings + survey.degrees_of_freedom) }
                        }
                        tr {
                            td { (message::direct_stiffness()) }
                            td { (survey.degrees_of_freedom) }
                            td { (message::entries_of_k_before_factorising(survey.stiffness_entries)) }
                            td { (message::as_its_ordering_falls_out()) }
                        }
                    }
                }
            }
            figure { (plot(survey)) figcaption class="quiet" { (message::relative_error_of_one_step()) } }
            div class="scroll" {
                table {
                    thead { tr {
                        th { (message::step()) }
                        @if !survey.yields { th { (message::product()) } th { (message::digits_expected_of_it()) } th { (message::element_by_element()) } }
                        th { (message::riccati()) }
                    } }
                    tbody {
                        @for row in &survey.accuracy {
                            tr {
                                td { (step_name(row.step)) }
                                @if !survey.yields {
                                    td { (error_text(row.product)) }
                                    td { (format!("{:.0}", row.product_digits_expected.max(0.0))) }
                                    td { (error_text(row.elementwise)) }
                                }
                                td { (error_text(row.riccati)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn elements(survey: &MethodSurvey) -> String {
    let mut parts = vec![message::lumped_masses(survey.lumped_masses)];
    for (count, name) in [
        (survey.members, message::massless_beams()),
        (survey.hinges, message::hinges_word()),
        (survey.springs, message::storey_springs()),
    ] {
        if count > 0 {
            parts.push(format!("{count} {name}"));
        }
    }
    message::displacements_after_rigid_connections(parts.join(", "), survey.degrees_of_freedom)
}

fn step_name(step: f64) -> String {
    format!("{} ms", step * 1e3)
}

fn error_text(error: f64) -> String {
    if !error.is_finite() {
        message::overflow().to_owned()
    } else if error > LOST {
        message::error_lost(format::significant(error, 1))
    } else {
        format::significant(error, 1)
    }
}

/// Places a step and an error in the plot; `None` where there is no number to show.
fn place(step: f64, error: f64) -> [f64; 2] {
    let share_x = (step.log10() + 5.0) / (0.02_f64.log10() + 5.0);
    let shown = if error.is_finite() {
        error.clamp(FINEST, 1e3)
    } else {
        1e3
    };
    let share_y = (3.0 - shown.log10()) / 19.0;
    let [left, top, width, height] = AREA;
    [left + share_x * width, top + share_y * height]
}

fn plot(survey: &MethodSurvey) -> Markup {
    let [left, top, width, height] = AREA;
    let mut series: Vec<(&str, &str, ErrorOf)> = vec![
        (message::product(), "--c:var(--c1)", |row| row.product),
        (message::element_by_element(), "--c:var(--c2)", |row| {
            row.elementwise
        }),
        (message::riccati(), "--c:var(--c0)", |row| row.riccati),
    ];
    if survey.yields {
        series.drain(..2);
    }
    let path = |value: ErrorOf| {
        let points = survey
            .accuracy
            .iter()
            .map(|row| place(row.step, value(row)));
        let text: Vec<String> = points.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        format!("M{}", text.join(" L"))
    };
    html! {
        svg viewBox="0 0 720 360" role="img" aria-label={ (message::relative_error_of_one_step_of_against(&survey.name)) } {
            g class="grid" {
                @for exponent in [-16, -12, -8, -4, 0] {
                    @let y = place(0.02, 10f64.powi(exponent))[1];
                    line x1=(left) x2=(left + width) y1=(y) y2=(y) {}
                    text x=(left - 8.0) y=(y + 4.0) text-anchor="end" { "10" tspan dy="-4" font-size="9" { (exponent) } }
                }
                @for step in [2e-2, 1e-2, 1e-3, 1e-4, 1e-5] {
                    @let x = place(step, 1.0)[0];
                    line x1=(x) x2=(x) y1=(top) y2=(top + height) {}
                    text x=(x) y=(top + height + 18.0) text-anchor="middle" { (step * 1e3) }
                }
                text x=(left + width / 2.0) y=(top + height + 38.0) text-anchor="middle" { (message::step_ms()) }
                (name_upwards(message::relative_error_axis(), 12.0, top + height / 2.0))
            }
            line class="line dashed" style="--c:var(--ink)" x1=(left) x2=(left + width) y1=(place(0.02, LOST)[1]) y2=(place(0.02, LOST)[1]) {}
            @for (index, (name, colour, value)) in series.into_iter().enumerate() {
                path class="line" style=(colour) d=(path(value)) {}
                line class="line" style=(colour) x1=(left + 18.0) x2=(left + 42.0)
                    y1=(top + 144.0 + 18.0 * index as f64) y2=(top + 144.0 + 18.0 * index as f64) {}
                text x=(left + 50.0) y=(top + 148.0 + 18.0 * index as f64) { (name) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lost_and_overflown_errors_are_named() {
        assert_eq!(error_text(2e-13), "2\u{202f}×\u{202f}10⁻¹³");
        assert_eq!(error_text(30.0), "30 (lost)");
        assert_eq!(error_text(f64::INFINITY), "overflow");
    }

    #[test]
    fn every_point_lies_in_the_plot() {
        for step in [1e-5, 2e-2] {
            for error in [0.0, 1e-20, 1.0, 1e300, f64::INFINITY, f64::NAN] {
                let [x, y] = place(step, error);
                assert!((AREA[0]..=AREA[0] + AREA[2] + 1e-9).contains(&x), "{x}");
                assert!(
                    (AREA[1] - 1e-9..=AREA[1] + AREA[3] + 1e-9).contains(&y),
                    "{y} for {error}"
                );
            }
        }
    }
}
