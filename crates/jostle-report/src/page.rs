//! The page: head, key figures, sections, controls.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{CALCULATION_STYLE, POLICY, STYLE, colour, theme_button};
use crate::envelope::{self, envelopes};
use crate::site_drawing::SITE_STYLE;
use crate::verdict::{closest_approach, nearest, peak_closing, verdict};
use crate::{
    Page, calculation, contact_box, describe, devices, floor_spectra, format, grounds, hinges,
    joints, members, method, payload, site_plan, spread, tables,
};

/// The scripts, in the order of their dependence; together they are one module.
pub(crate) const SCRIPTS: [&str; 9] = [
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
const IN_SPACE: [&str; 2] = [
    include_str!("../assets/space.js"),
    include_str!("../assets/orbits.js"),
];
/// The whole page.
pub(crate) fn page(page: &Page) -> Markup {
    let headline = verdict(page.summary);
    let run = envelope::of_run(page);
    let without = envelope::without_contact(page);
    let without = without.as_deref();
    let recorded = page.history.len() > 1;
    let yields = page
        .model
        .buildings
        .iter()
        .any(|building| building.may_yield());
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(headline);
                title { (page.summary.title) " – jostle" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(CALCULATION_STYLE)) @if page.model.is_in_space() { (PreEscaped(SITE_STYLE)) } }
            }
            body {
                (warnings(page))
                header.head {
                    div {
                        p.kicker { "Seismic pounding report" }
                        h1 { (page.summary.title) }
                    }
                    (theme_button())
                }
                main {
                    p.verdict { (headline) }
                    (tiles(page))
                    (accuracy(page))
                    @if let Some(spread) = spread::section(page) { (spread) }
                    @if recorded {
                        (motion_section(page.without_contact.is_some() && !page.model.gaps.is_empty(), yields))
                        @if let Some(space) = site_plan::space_section(page) { (space) }
                        (chart_section(page.without_contact.is_some() && !page.model.gaps.is_empty()))
                    } @else {
                        p.note { "No time histories were recorded, so there is no animation." }
                    }
                    @if let Some(hinges) = hinges::section(page) { (hinges) }
                    @if let Some(devices) = devices::section(page) { (devices) }
                    section #impacts {
                        h2 { "Impacts" }
                        @if recorded { (impact_panels()) }
                        @if page.model.gaps.is_empty() {
                            p.quiet { "The model has no gap." }
                        } @else {
                            (tables::impacts(page))
                            (contact_box::contact_boxes(page))
                        }
                    }
                    section #envelopes {
                        h2 { "Peaks over the height" }
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
                            h2 { "Comparison with code requirements" }
                            (joints::joints(page, &run, without))
                        }
                    }
                    section #model {
                        h2 { "What was computed" }
                        (calculation::model_figures(page))
                        (describe::model(page))
                    }
                    (method::section(page.methods))
                    (calculation::source_section(page))
                    (guide(page))
                }
                footer {
                    "Made by jostle " (page.summary.jostle) ". One file; nothing is loaded from a network."
                }
                @if recorded {
                    (player(page.summary.gaps.iter().any(|gap| gap.impact_count > 0)))
                    noscript { p.note { "The animation and the time charts need JavaScript." } }
                    script #page-data type="application/json" { (PreEscaped(payload::payload(page))) }
                    script type="module" {
                        @if page.model.is_in_space() { (PreEscaped(IN_SPACE.concat())) }
                        (PreEscaped(SCRIPTS.concat()))
                    }
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
                    p { b { "The run ended early: " } (why) }
                }
                @for warning in &summary.warnings {
                    p { b { "Warning: " } (warning) }
                }
            }
        }
    }
}

pub(crate) fn tiles(page: &Page) -> Markup {
    let summary = page.summary;
    let mut tiles: Vec<(String, String, String)> = Vec::new();
    let mut tile = |name: &str, value: String, note: String| {
        tiles.push((name.to_owned(), value, note));
    };
    let impacts: usize = summary.gaps.iter().map(|gap| gap.impact_count).sum();
    let hardest = summary
        .gaps
        .iter()
        .max_by(|a, b| a.peak_force_n.total_cmp(&b.peak_force_n));
    if let Some(hardest) = hardest.filter(|_| impacts > 0) {
        let contact = hardest
            .contacts
            .iter()
            .max_by(|a, b| a.peak_force_n.total_cmp(&b.peak_force_n));
        let place = contact.map_or_else(String::new, crate::verdict::place);
        tile("Peak force", format::force(hardest.peak_force_n), place);
        let first = summary
            .gaps
            .iter()
            .filter_map(|gap| gap.first_impact_s)
            .min_by(f64::total_cmp);
        tile(
            "Impacts",
            format::fixed(impacts as f64, 0),
            first.map_or_else(String::new, |t| format!("first at {}", format::instant(t))),
        );
    } else if !summary.gaps.is_empty() {
        tile("Impacts", "none".into(), String::new());
    }
    for gap in &summary.gaps {
        let pair = if summary.gaps.len() > 1 {
            format!(", {}–{}", gap.between[0], gap.between[1])
        } else {
            String::new()
        };
        let width = nearest(gap).map_or(gap.width_m, |contact| contact.width_m);
        let left =
            closest_approach(gap).filter(|distance| *distance > 0.0 && gap.impact_count == 0);
        tile(
            &format!("Peak closing{pair}"),
            peak_closing(gap).map_or(format::NOTHING.into(), format::millimetres),
            match left {
                Some(left) => format!(
                    "gap {}, {} left",
                    format::millimetres(width),
                    format::millimetres(left)
                ),
                None => format!("gap {}", format::millimetres(width)),
            },
        );
        if let Some(closing) = gap.closing_without_contact_m {
            tile(
                &format!("Smallest gap without pounding{pair}"),
                format::millimetres(closing),
                "from a run without contact".into(),
            );
        }
    }
    for building in &summary.buildings {
        if let Some(roof) = building.floors.last() {
            tile(
                &format!("Roof of {}", building.name),
                format::millimetres(roof.response.displacement_peak_m()),
                format!(
                    "{} / +{}",
                    format::fixed(roof.response.displacement_min_m * 1e3, 1),
                    format::millimetres(roof.response.displacement_max_m)
                ),
            );
        }
    }
    for building in summary.buildings.iter().filter(|b| b.hinges.total > 0) {
        let hinges = &building.hinges;
        tile(
            &format!("{} yields at", building.name),
            match hinges.yielded {
                0 => "no place".into(),
                n => format!("{n} of {}", hinges.total),
            },
            format!(
                "{} cracked; ductility {}",
                hinges.cracked,
                format::significant(hinges.ductility, 2)
            ),
        );
    }
    let pga = summary.motion.pga_m_s2;
    tile(
        "Peak ground acceleration",
        format::unit(format::significant(pga, 3), "m/s²"),
        format!(
            "{} % g, {}",
            format::significant(pga / format::STANDARD_GRAVITY * 100.0, 3),
            summary.motion.name
        ),
    );
    tile(
        "Energy imbalance",
        format::significant(summary.energy.worst_imbalance, 2),
        "greatest over time".into(),
    );
    html! {
        div.tiles {
            @for (name, value, note) in &tiles {
                div.tile { p.tile-name { (name) } p.tile-value { (value) } p.tile-note { (note) } }
            }
        }
    }
}

/// The estimated error of the peaks, as the command line says it.
fn accuracy(page: &Page) -> Markup {
    let words = page.summary.promise.in_words();
    let words = words.strip_prefix("accuracy: ").unwrap_or(&words);
    html! { p.quiet #accuracy { b { "Accuracy: " } (words) "." } }
}

/// The animation, with the controls of a run without contact and of yielding places.
pub(crate) fn motion_section(compares: bool, yields: bool) -> Markup {
    html! {
        section #motion {
            h2 { "How they move" }
            figure.stage { div #scene {} }
            div.controls {
                label { "Exaggeration "
                    input #exaggeration type="range" min="0" max="2" step="0.01" value="1";
                    output #exaggeration-value for="exaggeration" { "10×" }
                }
                @if compares {
                    label { input #ghost type="checkbox"; " also without contact (dashed)" }
                }
                @if yields {
                    label { input #show-hinges type="checkbox" checked; " cracking and yielding" }
                }
            }
            @if yields {
                div #hinge-legend.hinge-legend {}
            }
            p.quiet {
                "To scale; horizontal motion and gaps are exaggerated by the same factor, so contact looks like contact. "
                "Columns between floors are drawn as smooth curves, not computed."
            }
        }
    }
}

/// Charts over time.
pub(crate) fn chart_section(compares: bool) -> Markup {
    html! {
        section #charts {
            h2 { "Over time" }
            div.controls {
                label { "Show " select #place {} }
                span.buttons role="group" aria-label="Zoom all charts" {
                    button #zoom-in type="button" aria-label="Zoom in" { "+" }
                    button #zoom-out type="button" aria-label="Zoom out" { "−" }
                    button #zoom-impact type="button" { "This impact" }
                    button #zoom-all type="button" { "Whole motion" }
                }
            }
            p.quiet.screen {
                "Drag across a chart to zoom, double-click for the whole motion, click to move the cursor. "
                "On a chart with the keyboard focus, the wheel zooms (elsewhere with Shift or Ctrl); arrow keys move the cursor, + and − zoom."
            }
            div #time-charts {}
            @if compares {
                p.quiet { "Dashed: the same buildings without contact." }
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
            @if without { span.key { span.swatch.dashed {} "without contact" } }
        }
    }
}

/// The bar of playback, with buttons that jump from impact to impact.
pub(crate) fn player(impacts: bool) -> Markup {
    html! {
        div #player.player role="group" aria-label="Playback" {
            div.player-row {
                button #play.play type="button" aria-label="Play" title="Play or pause (space)" {
                    (icon("play-icon", "M4 2v16l14-8z")) (icon("pause-icon", "M4 2h4v16h-4zM12 2h4v16h-4z"))
                }
                @if impacts {
                    button #previous type="button" aria-label="Previous impact" title="Previous impact ([)" { (icon("", "M3 3h3v14h-3zM17 3v14l-10-7z")) }
                    button #next type="button" aria-label="Next impact" title="Next impact (])" { (icon("", "M3 3v14l10-7zM14 3h3v14h-3z")) }
                }
                output #clock.clock { "0.000 s" }
                span #force-now.force-now { span.wordy hidden { "total " } span {} }
                label.speed { span.wordy { "Speed " }
                    select #speed aria-label="Speed" {
                        @for speed in ["0.01", "0.1", "0.25", "0.5", "1", "2", "4"] {
                            option value=(speed) selected[speed == "1"] { (speed) "×" }
                        }
                    }
                }
            }
            div.scrub {
                div #marks.marks aria-hidden="true" {}
                input #scrub type="range" min="0" max="1" step="any" value="0" aria-label="Time";
            }
        }
    }
}

fn icon(class: &str, outline: &str) -> Markup {
    html! { svg class=(class) viewBox="0 0 20 20" aria-hidden="true" { path d=(outline) {} } }
}

fn guide(page: &Page) -> Markup {
    html! {
        section #guide {
            h2 { "How to read this" }
            ul {
                li { "Displacements are relative to the ground and positive to the right; ground acceleration is positive to the right as well." }
                li { "Closing is the displacement of the left floor minus that of the right one. The floors touch when it exceeds the gap; the excess is the indentation." }
                li { "Contact forces are positive in compression: they push the left building left and the right one right. An impact begins when the surfaces touch and ends with the last instant of force before they separate." }
                li { "Total acceleration includes the ground. Storey drift is the relative displacement of two floors divided by the height between them." }
                li { "The input is the work of the ground motion in coordinates that move with the ground; kinetic, strain, damped, hysteretic and contact energy add up to it. The imbalance is the difference, relative to the greatest energy until then." }
                @if page.model.buildings.iter().any(|building| building.may_yield()) {
                    li { "A place has cracked, or yielded, once its deformation has passed the first, or second, corner of its curve, on either side. Ductility is the greatest rotation of a member end, hinge and bent member together, over that at yield, or the greatest deformation of a storey over that of yield; a positive value means tension at the bottom of a beam and on the right side of a column. Dissipated energy is the work minus the energy recoverable by unloading." }
                }
                li { "Histories are thinned for this page, less during impacts; key figures and tables come from the full run." }
            }
        }
    }
}
