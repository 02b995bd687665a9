//! The page: head, key figures, sections, controls.

use jostle_io::in_shown_units;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::damage::strut_stages;
use crate::document::{CALCULATION_STYLE, POLICY, STYLE, colour, on_paper, theme_button};
use crate::envelope::{self, envelopes};
use crate::message;
use crate::site_drawing::SITE_STYLE;
use crate::tiles::tiles;
use crate::verdict::{outside, verdict};
use crate::{
    Page, bounds, calculation, checks, contact_box, describe, devices, fibres, floor_spectra,
    friction, grounds, hinges, joints, members, method, panels, payload, pounding_effect,
    rotation_levels, shear_failures, site_plan, spread, tables,
};

/// The scripts, in the order of their dependence; together they are one module.
pub(crate) const SCRIPTS: [&str; 11] = [
    include_str!("../assets/messages.js"),
    include_str!("../assets/plot.js"),
    include_str!("../assets/data.js"),
    include_str!("../assets/chart.js"),
    include_str!("../assets/hinges.js"),
    include_str!("../assets/loop.js"),
    include_str!("../assets/scene.js"),
    include_str!("../assets/player.js"),
    include_str!("../assets/panels.js"),
    include_str!("../assets/impacts.js"),
    include_str!("../assets/main.js"),
];
/// Those of buildings in space, before the others.
pub(crate) const IN_SPACE: [&str; 2] = [
    include_str!("../assets/space.js"),
    include_str!("../assets/orbits.js"),
];

/// Scripts as one, without comments that have lines of their own and without the indentation, which no text of theirs runs across:
/// pages stay small.
fn flush(scripts: &[&str]) -> String {
    let is_comment = |line: &&str| {
        ["//", "/**", "* ", "*/"]
            .iter()
            .any(|start| line.starts_with(start))
    };
    let lines = scripts
        .iter()
        .flat_map(|script| script.lines())
        .map(str::trim_start);
    let lines = lines.filter(|line| !is_comment(line));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The whole page.
pub(crate) fn page(page: &Page) -> Markup {
    let headline = verdict(page.summary);
    let outside = outside(page.summary);
    let run = envelope::of_run(page);
    let without = envelope::without_contact(page);
    let without = without.as_deref();
    let recorded = page.history.len() > 1;
    let yields = !hinges::places(page).is_empty();
    // Marks of places that yield, and of struts.
    let marked = yields
        || page
            .model
            .buildings
            .iter()
            .zip(&page.summary.buildings)
            .any(|(model, summary)| {
                strut_stages(model, summary)
                    .iter()
                    .flatten()
                    .any(|stage| *stage > 0)
            });
    let script = match page.model.is_in_space() {
        true => flush(&IN_SPACE) + &flush(&SCRIPTS),
        false => flush(&SCRIPTS),
    };
    html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(headline);
                title { (page.summary.title) " – jostle" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(CALCULATION_STYLE)) @if page.model.is_in_space() { (PreEscaped(SITE_STYLE)) } }
                (on_paper(&page.summary.title))
            }
            body {
                (warnings(page))
                header.head {
                    div {
                        p.kicker { (message::seismic_pounding_report()) }
                        h1 { (page.summary.title) }
                        (calculation::title_block(page))
                    }
                    (theme_button())
                }
                main {
                    @if let Some(why) = &outside { p.outside role="alert" { b { (message::outside_the_model()) } " " (why) } }
                    p.verdict.muted[outside.is_some()] { @if page.summary.ended_early.is_some() { (message::until_the_run_ended()) " " } (headline) }
                    (tiles(page))
                    @if let Some(effect) = pounding_effect::section(page) { (effect) }
                    (checks::section(page))
                    (bounds::section(page))
                    @if let Some(spread) = spread::section(page) { (spread) }
                    @if recorded {
                        (motion_section(page.without_contact.is_some() && !page.model.gaps.is_empty(), marked))
                        @if let Some(space) = site_plan::space_section(page) { (space) }
                        (chart_section(page.without_contact.is_some() && !page.model.gaps.is_empty()))
                    } @else {
                        p.note { (message::no_time_histories_were_recorded()) }
                    }
                    @if let Some(hinges) = hinges::section(page) { (hinges) }
                    @if let Some(fibres) = fibres::section(page) { (fibres) }
                    @if let Some(panels) = panels::section(page) { (panels) }
                    @if let Some(failures) = shear_failures::section(page) { (failures) }
                    @if let Some(levels) = rotation_levels::section(page) { (levels) }
                    @if let Some(devices) = devices::section(page) { (devices) }
                    section #impacts.muted[outside.is_some()] {
                        h2 { (message::impacts_title()) }
                        @if recorded { (impact_panels()) }
                        @if page.model.gaps.is_empty() {
                            p.quiet { (message::the_model_has_no_gap()) }
                        } @else {
                            (tables::impacts(page))
                            (contact_box::contact_boxes(page))
                            (friction::section(page))
                        }
                    }
                    section #envelopes {
                        h2 { (message::peaks_over_the_height()) }
                        (legend(page, without.is_some()))
                        (envelopes(page, &run, without))
                        (tables::peaks(page))
                    }
                    @if let Some(site) = site_plan::section(page) { (site) }
                    @if let Some(grounds) = grounds::section(page) { (grounds) }
                    @if let Some(members) = members::section(page) { (members) }
                    @if let Some(spectra) = floor_spectra::section(page) { (spectra) }
                    (calculation::motion_section(page))
                    @if !page.model.gaps.is_empty() {
                        section #joints {
                            h2 { (message::comparison_with_code_requirements()) }
                            (joints::joints(page))
                        }
                    }
                    section #model {
                        h2 { (message::what_was_computed()) }
                        (calculation::model_figures(page))
                        (describe::model(page))
                    }
                    (method::section(page.methods))
                    (calculation::source_section(page))
                    (guide(yields))
                }
                footer {
                    (message::made_by_jostle_version(crate::version()))
                }
                @if recorded {
                    (player(page.summary.gaps.iter().any(|gap| gap.impact_count > 0)))
                    noscript { p.note { (message::the_animation_and_the_time()) } }
                    script #page-data type="application/json" { (PreEscaped(payload::payload(page))) }
                    (message::for_scripts(&script))
                    script type="module" { (PreEscaped(script)) }
                }
            }
        }
    }
}

pub(crate) fn warnings(page: &Page) -> Markup {
    let summary = page.summary;
    html! {
        @if summary.ended_early.is_some() || !summary.warnings.is_empty() {
            aside.warnings.failed[summary.ended_early.is_some()] role="alert" {
                @if let Some(why) = &summary.ended_early {
                    p { b { (message::the_run_ended_early()) " " } (why) }
                }
                @for warning in &summary.warnings {
                    p { b { (message::warning()) " " } (in_shown_units(warning)) }
                }
            }
        }
    }
}

/// The animation, with the controls of a run without contact and of yielding places.
pub(crate) fn motion_section(compares: bool, yields: bool) -> Markup {
    html! {
        section #motion {
            h2 { (message::how_they_move()) }
            figure.stage { div #scene {} }
            div.controls {
                label { (message::exaggeration()) " "
                    input #exaggeration type="range" min="0" max="2" step="0.01" value="1";
                    output #exaggeration-value for="exaggeration" { "10×" }
                }
                @if compares {
                    label { input #ghost type="checkbox"; " " (message::also_without_contact_dashed()) }
                }
                @if yields {
                    label { input #show-hinges type="checkbox" checked; " " (message::cracking_and_yielding()) }
                }
            }
            @if yields {
                div #hinge-legend.hinge-legend {}
            }
            p.quiet {
                (message::to_scale_horizontal_motion())
            }
        }
    }
}

/// Charts over time.
pub(crate) fn chart_section(compares: bool) -> Markup {
    html! {
        section #charts {
            h2 { (message::over_time()) }
            div.controls {
                label { (message::show()) " " select #place {} }
                span.buttons role="group" aria-label=(message::zoom_all_charts()) {
                    button #zoom-in type="button" aria-label=(message::zoom_in()) { "+" }
                    button #zoom-out type="button" aria-label=(message::zoom_out()) { "−" }
                    button #zoom-impact type="button" { (message::this_impact()) }
                    button #zoom-all type="button" { (message::whole_motion()) }
                }
            }
            p.quiet.screen {
                (message::drag_across_a_chart_to_zoom())
            }
            div #time-charts {}
            @if compares {
                p.quiet { (message::dashed_the_same_buildings_without()) }
            }
        }
    }
}

/// Where the scripts draw every impact by itself.
pub(crate) fn impact_panels() -> Markup {
    html! { div #impact-panels hidden {} }
}

pub(crate) fn legend(page: &Page, without: bool) -> Markup {
    html! {
        p.legend {
            @for (i, building) in page.model.buildings.iter().enumerate() {
                span.key { span.swatch style=(colour(i)) {} (building.name) }
            }
            @if without { span.key { span.swatch.dashed {} (message::without_contact()) } }
        }
    }
}

/// The bar of playback, with buttons that jump from impact to impact.
pub(crate) fn player(impacts: bool) -> Markup {
    html! {
        div #player.player role="group" aria-label=(message::playback()) {
            div.player-row {
                button #play.play type="button" aria-label=(message::play()) title=(message::play_or_pause_space()) {
                    (icon("play-icon", "M4 2v16l14-8z")) (icon("pause-icon", "M4 2h4v16h-4zM12 2h4v16h-4z"))
                }
                @if impacts {
                    button #previous type="button" aria-label=(message::previous_impact()) title=(message::previous_impact_button()) { (icon("", "M3 3h3v14h-3zM17 3v14l-10-7z")) }
                    button #next type="button" aria-label=(message::next_impact()) title=(message::next_impact_button()) { (icon("", "M3 3v14l10-7zM14 3h3v14h-3z")) }
                }
                output #clock.clock { "0.000 s" }
                span #force-now.force-now { span.wordy hidden { (message::total()) " " } span {} }
                label.speed { span.wordy { (message::speed()) " " }
                    select #speed aria-label=(message::speed()) {
                        @for speed in ["0.01", "0.1", "0.25", "0.5", "1", "2", "4"] {
                            option value=(speed) selected[speed == "1"] { (speed) "×" }
                        }
                    }
                }
            }
            div.scrub {
                div #marks.marks aria-hidden="true" {}
                input #scrub type="range" min="0" max="1" step="any" value="0" aria-label=(message::time_title());
            }
        }
    }
}

fn icon(class: &str, outline: &str) -> Markup {
    html! { svg class=(class) viewBox="0 0 20 20" aria-hidden="true" { path d=(outline) {} } }
}

fn guide(yields: bool) -> Markup {
    html! {
        section #guide {
            h2 { (message::how_to_read()) }
            ul {
                li { (message::displacements_are_relative()) }
                li { (message::closing_is_the_displacement()) }
                li { (message::contact_forces_are_positive()) }
                li { (message::total_acceleration_includes_the_ground()) }
                li { (message::the_input_is_the_work()) }
                @if yields {
                    li { (message::a_place_has_cracked()) }
                }
                li { (message::histories_are_thinned()) }
            }
        }
    }
}
