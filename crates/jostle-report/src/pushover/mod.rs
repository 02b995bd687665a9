//! The page of `jostle pushover`: capacity curves, deformed shapes with the states of hinges, events.

mod chart;
mod demand;
mod shapes;

use jostle::hysteresis::Stage;
use jostle::pushover::{Bilinear, LoadPattern, PushEnd, PushPoint, PushedBuilding, Pushover};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{POLICY, STYLE, theme_button};
use crate::format;
use chart::Chart;
pub use demand::Demand;

const OWN_STYLE: &str = include_str!("../../assets/pushover.css");
const SCRIPT: &str = include_str!("../../assets/pushover.js");

/// Hinges named at most in a row of the table.
const NAMED: usize = 6;

/// The whole page of capacity curves, beside the demand of a ground motion if there is one; it loads nothing from outside.
#[must_use]
pub fn render_pushover(
    title: &str,
    pushed: &[PushedBuilding],
    demand: Option<&Demand<'_>>,
) -> String {
    let charts: Vec<Chart> = pushed.iter().map(Chart::new).collect();
    let headline: Vec<String> = pushed.iter().map(verdict).collect();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(headline.join(" "));
                title { (title) " – pushover" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(OWN_STYLE)) }
            }
            body {
                header.head {
                    div {
                        p.kicker { "Pushover" }
                        h1 { (title) }
                    }
                    (theme_button())
                }
                main {
                    @for sentence in &headline { p.verdict { (sentence) } }
                    @for (index, (one, chart)) in pushed.iter().zip(&charts).enumerate() {
                        (building(index, one, chart, demand))
                    }
                    (guide())
                }
                footer {
                    "Made by jostle " (env!("CARGO_PKG_VERSION")) ". One file; nothing is loaded from a network."
                }
                noscript { p.note { "The deformed shapes need JavaScript." } }
                script #page-data type="application/json" { (PreEscaped(shapes::payload(pushed, &charts))) }
                script type="module" { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

fn percent(share: f64, digits: i32) -> String {
    format::unit(format::significant(100.0 * share, digits), "%")
}

fn direction(one: &PushedBuilding, curve: &Pushover) -> String {
    if one.curves.len() > 1 {
        format!(" to the {}", curve.settings.direction.name())
    } else {
        String::new()
    }
}

/// Key figures.
fn verdict(one: &PushedBuilding) -> String {
    let name = &one.building.name;
    if one.building.equations.springs.is_empty() {
        return format!("{name} has no hinges: it is elastic at any drift.");
    }
    let weakest = one
        .curves
        .iter()
        .min_by(|a, b| a.peak().base_shear.total_cmp(&b.peak().base_shear));
    let Some(curve) = weakest else {
        return format!("{name} was not pushed.");
    };
    let peak = curve.peak();
    let mut text = format!(
        "{name} resists up to {} of its weight{}, at {} drift of the roof",
        percent(curve.coefficient(peak), 3),
        direction(one, curve),
        percent(curve.drift(peak), 3)
    );
    text += &match curve.first(Stage::Yielded) {
        Some(first) if first.roof > 0.0 => format!(
            "; its first hinge yields at {} of the weight.",
            percent(curve.coefficient(first), 3)
        ),
        Some(_) => "; gravity alone makes a hinge yield.".to_owned(),
        None => "; no hinge yields.".to_owned(),
    };
    text
}

fn building(
    index: usize,
    one: &PushedBuilding,
    chart: &Chart,
    demand: Option<&Demand<'_>>,
) -> Markup {
    html! {
        section data-building=(index) {
            h2 { (one.building.name) }
            @for curve in &one.curves {
                @if one.curves.len() > 1 { h3 { "Pushed to the " (curve.settings.direction.name()) } }
                @if curve.end != PushEnd::Target {
                    p.note { b { "Ended early: " } (curve.end.to_string()) "." }
                }
                (tiles(one, curve))
            }
            figure.chart {
                figcaption {
                    span.chart-title { "Capacity curve" }
                    span.legend {
                        @for (k, curve) in one.curves.iter().enumerate() {
                            span.key { span.swatch.dashed[k > 0] style=(chart::colour(k)) {} "to the " (curve.settings.direction.name()) }
                        }
                        span.key { span.swatch.dashed {} "bilinear, equal energy" }
                        span.key { span.swatch.round.cracked {} "cracks" }
                        span.key { span.swatch.round.yielded {} "yields" }
                    }
                }
                (chart.draw(one))
            }
            @if let Some(demand) = demand { (demand::section(index, one, demand)) }
            figure.chart {
                figcaption {
                    span.chart-title { "Deformed shape" }
                    span.legend {
                        span.key { span.swatch.round {} "uncracked" }
                        span.key { span.swatch.round.cracked {} "cracked" }
                        span.key { span.swatch.round.yielded {} "yielded" }
                    }
                }
                div.controls {
                    @if one.curves.len() > 1 {
                        label { "Pushed to the "
                            select data-role="which" {
                                @for (k, curve) in one.curves.iter().enumerate() {
                                    option value=(k) { (curve.settings.direction.name()) }
                                }
                            }
                        }
                    }
                    span.buttons {
                        button data-role="before" type="button" { "Event before" }
                        button data-role="after" type="button" { "Next event" }
                    }
                    label.slide { "Roof "
                        input data-role="slider" type="range" min="0" max="1" step="any" value="1" aria-label="Roof displacement";
                        output data-role="now" {}
                    }
                    label { "Exaggeration "
                        input data-role="exaggeration" type="range" min="1" max="30" step="1" value="5";
                        output data-role="factor" {}
                    }
                }
                div.stage.deformed data-role="scene" {}
            }
            div.cards.beside {
                @for curve in &one.curves { (pushed_card(one, curve)) (bilinear_card(one, curve)) }
            }
            @for (k, curve) in one.curves.iter().enumerate() { (events(one, k, curve)) }
        }
    }
}

fn tiles(one: &PushedBuilding, curve: &Pushover) -> Markup {
    let mut tiles: Vec<(&str, String, String)> = Vec::new();
    let mut tile = |name: &'static str, point: &PushPoint| {
        if point.roof == 0.0 {
            tiles.push((name, "at rest".to_owned(), "under gravity alone".to_owned()));
            return;
        }
        let note = format!(
            "of the weight: {} at {}, {} drift",
            format::force(point.base_shear),
            format::millimetres(point.roof),
            percent(curve.drift(point), 3)
        );
        tiles.push((name, percent(curve.coefficient(point), 3), note));
    };
    if let Some(first) = curve.first(Stage::Cracked) {
        tile("First crack", first);
    }
    if let Some(first) = curve.first(Stage::Yielded) {
        tile("First yield", first);
    }
    tile("Greatest base shear", curve.peak());
    if let Some(last) = curve.points.last().filter(|last| **last != *curve.peak()) {
        tile("At the end", last);
    }
    let springs = one.building.equations.springs.len();
    let [cracked, yielded] = curve.counts(springs);
    tiles.push((
        "Hinges",
        format!("{yielded} yielded"),
        format!("{cracked} of {springs} cracked"),
    ));
    html! {
        div.tiles {
            @for (name, value, note) in &tiles {
                div.tile { p.tile-name { (name) } p.tile-value { (value) } p.tile-note { (note) } }
            }
        }
    }
}

fn pushed_card(one: &PushedBuilding, curve: &Pushover) -> Markup {
    let pattern = match curve.settings.pattern {
        LoadPattern::FirstMode => "mass times the first lateral mode shape, uncracked",
        LoadPattern::Uniform => "mass",
        LoadPattern::Triangular => "mass times height",
    };
    html! {
        div.card {
            h3 { "How it was pushed" (direction(one, curve)) }
            dl {
                div { dt { "Load" } dd { (curve.settings.pattern.name()) ": " (pattern) } }
                div { dt { "Driven" } dd { "the roof, to " (percent(curve.settings.drift, 3)) " of " (format::unit(format::plain(curve.height, 4), "m")) } }
                div { dt { "Weight" } dd { (format::force(curve.weight)) } }
                div { dt { "Gravity" } dd {
                    @if one.building.rest.displacement.is_empty() { "does not load the hinges" } @else { "loads the hinges first" }
                    @if one.building.equations.undamped.is_zero() { "; no P-Delta" } @else { "; P-Delta" }
                } }
                div { dt { "Floor shares" } dd {
                    @let shares: Vec<String> = curve.floor_loads.iter().map(|share| format::significant(100.0 * share, 3)).collect();
                    (shares.join(", ")) " % from the ground up"
                } }
            }
        }
    }
}

fn bilinear_card(one: &PushedBuilding, curve: &Pushover) -> Markup {
    html! {
        div.card {
            h3 { "Bilinear discretization" (direction(one, curve)) }
            @match Bilinear::fit(&curve.points) {
                Some(two) => {
                    dl {
                        div { dt { "Yields at" } dd { (format::force(two.yield_force)) ", " (format::millimetres(two.yield_displacement)) } }
                        div { dt { "Ends at" } dd { (format::force(two.ultimate_force)) ", " (format::millimetres(two.ultimate_displacement)) } }
                        div { dt { "Stiffness" } dd { (format::stiffness(two.stiffness())) } }
                        div { dt { "After yield" } dd { (percent(two.hardening(), 3)) " of it" } }
                        div { dt { "Ductility" } dd { (format::significant(two.ductility(), 3)) } }
                    }
                    p.quiet { "Secant through 60 % of the yield strength; equal energy up to the greatest base shear (FEMA 356, 3.3.3.2.4)." }
                }
                None => p.quiet { "The curve is too close to linear for a bilinear discretization." }
            }
        }
    }
}

fn events(one: &PushedBuilding, index: usize, curve: &Pushover) -> Markup {
    let named = |point: &PushPoint| {
        let events = point.events.iter().take(NAMED);
        let mut text: Vec<String> = events
            .map(|event| format!("{} {}", one.place(event.spring), event.kind.name()))
            .collect();
        if point.events.len() > NAMED {
            text.push(format!("and {} more", point.events.len() - NAMED));
        }
        text.join("; ")
    };
    html! {
        @if curve.points.iter().any(|point| !point.events.is_empty()) {
            div.beside {
                h3 { "What happened, in order" (direction(one, curve)) }
                div.scroll.tall {
                    table.events {
                        thead { tr {
                            th.number { "roof [mm]" } th.number { "drift [%]" } th.number { "base shear [kN]" } th.number { "of weight [%]" } th { "hinges" }
                        } }
                        tbody {
                            @for point in curve.points.iter().filter(|point| !point.events.is_empty()) {
                                tr data-roof=(point.roof) data-curve=(index) {
                                    td.number { (format::fixed(point.roof * 1e3, 2)) }
                                    td.number { (format::fixed(100.0 * curve.drift(point), 3)) }
                                    td.number { (format::fixed(point.base_shear * 1e-3, 1)) }
                                    td.number { (format::fixed(100.0 * curve.coefficient(point), 2)) }
                                    td { (named(point)) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn guide() -> Markup {
    html! {
        section #guide {
            h2 { "How to read this" }
            ul {
                li { "The load pattern is constant and the roof displacement is prescribed; base shear is the sum of the load. Displacements are relative to the state at rest and positive in the direction of the load." }
                li { "Hinges are linear between their corners, so the curve is linear between events and independent of any step size." }
                li { "The curve falls where P-Delta exceeds the hardening of hinges. It ends at the target drift, where no resistance is left, or where a part fails although the roof is restrained." }
                li { "A hinge cracks or yields when it first passes that point of its backbone on either side. A hinge that reloads passes a corner." }
                li { "A pushover shows strength and the order of yielding under one load. It does not include higher modes, cycles or impacts." }
            }
        }
    }
}
