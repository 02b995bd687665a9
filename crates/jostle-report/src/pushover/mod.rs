//! The page of `jostle pushover`: capacity curves, deformed shapes with the states of hinges, events.

mod chart;
mod demand;
mod shapes;
mod space_shapes;

use jostle::Building;
use jostle::hysteresis::Stage;
use jostle::pushover::{Bilinear, LoadPattern, PushEnd, PushPoint, PushedBuilding, Pushover};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::document::{POLICY, STYLE, on_paper, theme_button};
use crate::format;
use crate::message;
use chart::Chart;
pub use demand::Demand;

const OWN_STYLE: &str = include_str!("../../assets/pushover.css");
const SCRIPTS: [&str; 3] = [
    include_str!("../../assets/messages.js"),
    include_str!("../../assets/plot.js"),
    include_str!("../../assets/pushover.js"),
];

/// Hinges named at most in a row of the table.
const NAMED: usize = 6;

/// The whole page of capacity curves, beside the demand of a ground motion if there is one; it loads nothing from outside.
/// `models` has the geometry of the space frames among them, found by name; others need none.
#[must_use]
pub fn render_pushover(
    title: &str,
    pushed: &[PushedBuilding],
    demand: Option<&Demand<'_>>,
    models: &[Building],
) -> String {
    let charts: Vec<Chart> = pushed.iter().map(Chart::new).collect();
    let headline: Vec<String> = pushed.iter().map(verdict).collect();
    let script = SCRIPTS.concat();
    let page = html! {
        (DOCTYPE)
        html lang=(message::language_code()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="description" content=(headline.join(" "));
                title { (message::title_pushover(title)) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) (PreEscaped(OWN_STYLE)) }
                (on_paper(title))
            }
            body {
                header.head {
                    div {
                        p.kicker { (message::pushover()) }
                        h1 { (title) }
                    }
                    (theme_button())
                }
                main {
                    @for sentence in &headline { p.verdict { (sentence) } }
                    @for (index, (one, chart)) in pushed.iter().zip(&charts).enumerate() {
                        (building(index, one, chart, demand))
                    }
                    (guide(!models.is_empty()))
                }
                footer {
                    (message::made_by_jostle_version(crate::version()))
                }
                noscript { p.note { (message::the_deformed_shapes_need_javascript()) } }
                script #page-data type="application/json" { (PreEscaped(shapes::payload(pushed, &charts, models))) }
                (message::for_scripts(&script))
                script type="module" { (PreEscaped(script)) }
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
        message::direction_to_the(curve.settings.direction.name())
    } else {
        String::new()
    }
}

/// Key figures.
fn verdict(one: &PushedBuilding) -> String {
    let name = &one.building.name;
    if one.is_elastic() {
        return message::has_no_hinges_it(name);
    }
    let weakest = one
        .curves
        .iter()
        .min_by(|a, b| a.peak().base_shear.total_cmp(&b.peak().base_shear));
    let Some(curve) = weakest else {
        return message::was_not_pushed(name);
    };
    let peak = curve.peak();
    let mut text = message::resists_up(
        name,
        percent(curve.coefficient(peak), 3),
        direction(one, curve),
        percent(curve.drift(peak), 3),
    );
    if different(one).count() > 1 {
        text += message::the_weaker_side();
    }
    if curve.end == PushEnd::Target && curve.points.last() == Some(peak) {
        text += message::the_curve_still_rises();
    }
    let firsts = one.curves.iter().filter_map(|curve| {
        let first = curve.first(Stage::Yielded)?;
        Some((curve, first, curve.coefficient(first)))
    });
    text += &match firsts.min_by(|a, b| a.2.total_cmp(&b.2)) {
        Some((curve, first, at)) if first.roof > 0.0 => {
            message::it_first_yields(percent(at, 3), direction(one, curve))
        }
        Some(_) => message::it_yields_under_gravity().to_owned(),
        None => message::nothing_yields().to_owned(),
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
            @for curve in different(one) {
                @if one.curves.len() > 1 {
                    h3 {
                        (message::pushed_to(curve.settings.direction.name()))
                        @if different(one).count() < one.curves.len() { " " span.quiet { (message::same_to_the_other_side()) } }
                    }
                }
                @if curve.end != PushEnd::Target {
                    p.note { b { (message::ended_early()) " " } (curve.end.to_string()) "." }
                }
                (tiles(one, curve))
            }
            figure.chart {
                figcaption {
                    span.chart-title { (message::capacity_curve()) }
                    span.legend {
                        @for (k, curve) in one.curves.iter().enumerate() {
                            span.key { span.swatch.dashed[k > 0] style=(chart::colour(k)) {} (message::to_the(curve.settings.direction.name())) }
                        }
                        span.key { span.swatch.dashed {} (message::bilinear_equal_energy()) }
                        span.key { span.swatch.round.cracked {} (message::cracks()) }
                        span.key { span.swatch.round.yielded {} (message::yields()) }
                        span.key { span.swatch.round.here {} (message::shape_below()) }
                    }
                }
                (chart.draw(one))
            }
            @if let Some(demand) = demand { (demand::section(index, one, demand)) }
            figure.chart {
                figcaption {
                    span.chart-title { (message::deformed_shape()) }
                    span.legend {
                        span.key { span.swatch.round {} (message::uncracked()) }
                        span.key { span.swatch.round.cracked {} (message::cracked()) }
                        span.key { span.swatch.round.yielded {} (message::yielded()) }
                    }
                }
                div.controls {
                    @if one.curves.len() > 1 {
                        label { (message::pushed_to_title()) " "
                            select data-role="which" {
                                @for (k, curve) in one.curves.iter().enumerate() {
                                    option value=(k) { (curve.settings.direction.name()) }
                                }
                            }
                        }
                    }
                    span.buttons {
                        button data-role="before" type="button" { (message::event_before()) }
                        button data-role="after" type="button" { (message::next_event()) }
                    }
                    label.slide { (message::roof()) " "
                        input data-role="slider" type="range" min="0" max="1" step="any" value="1" aria-label=(message::roof_displacement());
                        output data-role="now" {}
                    }
                    label { (message::exaggeration()) " "
                        input data-role="exaggeration" type="range" min="1" max="30" step="1" value="5";
                        output data-role="factor" {}
                    }
                }
                div.stage.deformed data-role="scene" {}
            }
            div.cards.beside {
                @for curve in different(one) { (pushed_card(one, curve)) (bilinear_card(one, curve)) }
            }
            @for (k, curve) in different(one).enumerate() { (events(one, k, curve)) }
        }
    }
}

/// Difference of base shears over their peak up to which two curves are the same \[–\].
const ALIKE: f64 = 1e-3;

/// Curves without those that repeat an earlier one to the other side.
fn different<'a>(one: &'a PushedBuilding<'_>) -> impl Iterator<Item = &'a Pushover> {
    // Symmetric frames pass the same events in another order: what counts is the curve.
    let shear = |curve: &Pushover, roof: f64| {
        let points = &curve.points;
        let after = points.partition_point(|point| point.roof < roof).max(1);
        let [low, high] = [points.get(after - 1)?, points.get(after).or(points.last())?];
        let span = high.roof - low.roof;
        let share = if span > 0.0 {
            (roof - low.roof) / span
        } else {
            0.0
        };
        Some(low.base_shear + share * (high.base_shear - low.base_shear))
    };
    let alike = move |a: &Pushover, b: &Pushover| {
        let most = ALIKE * a.peak().base_shear.abs();
        let [end, other] = [a, b].map(|curve| curve.points.last().map_or(0.0, |end| end.roof));
        (end - other).abs() <= ALIKE * end
            && a.points.iter().all(|point| {
                shear(b, point.roof).is_some_and(|other| (other - point.base_shear).abs() <= most)
            })
    };
    let curves = one.curves.iter().enumerate();
    curves.filter_map(move |(index, curve)| {
        let repeats = one.curves[..index].iter().any(|known| alike(known, curve));
        (!repeats).then_some(curve)
    })
}

fn tiles(one: &PushedBuilding, curve: &Pushover) -> Markup {
    let mut tiles: Vec<(&str, String, String)> = Vec::new();
    let mut tile = |name: &'static str, point: &PushPoint| {
        if point.roof == 0.0 {
            tiles.push((
                name,
                message::at_rest().to_owned(),
                message::under_gravity_alone().to_owned(),
            ));
            return;
        }
        let note = message::of_the_weight_at_drift(
            format::force(point.base_shear),
            format::millimetres(point.roof),
            percent(curve.drift(point), 3),
        );
        tiles.push((name, percent(curve.coefficient(point), 3), note));
    };
    let yields = curve.first(Stage::Yielded);
    // Hinges without cracking pass both corners at once.
    if let Some(first) = curve
        .first(Stage::Cracked)
        .filter(|first| Some(*first) != yields)
    {
        tile(message::first_crack_title(), first);
    }
    if let Some(first) = yields {
        tile(message::first_yield_title(), first);
    }
    tile(message::greatest_base_shear(), curve.peak());
    if let Some(last) = curve.points.last().filter(|last| **last != *curve.peak()) {
        tile(message::at_the_end(), last);
    }
    let springs = one.building.equations.springs.len();
    let [cracked, yielded] = curve.counts(springs);
    let places = one.yielding_places();
    if places > 0 {
        tiles.push((
            message::cracking_and_yielding_title(),
            message::yielded_yielded(yielded),
            message::of_cracked(cracked, places),
        ));
    }
    if one.links() > 0 {
        tiles.push((
            message::links_title(),
            message::yielded_yielded(curve.links_yielded(springs)),
            message::of_links_between_floors(one.links()),
        ));
    }
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
        LoadPattern::FirstMode => message::mass_times_the_first_lateral(),
        LoadPattern::Uniform => message::mass(),
        LoadPattern::Triangular => message::mass_times_height(),
    };
    html! {
        div.card {
            h3 { (message::how_it_was_pushed(direction(one, curve))) }
            dl {
                div { dt { (message::load()) } dd { (curve.settings.pattern.name()) ": " (pattern) } }
                div { dt { (message::driven()) } dd { (message::the_roof(percent(curve.settings.drift, 3), format::unit(format::plain(format::HEIGHT.of(curve.height), 4), format::HEIGHT.name()))) } }
                div { dt { (message::weight()) } dd { (format::force(curve.weight)) } }
                div { dt { (message::gravity_title()) } dd {
                    @if one.building.rest.displacement.is_empty() { (message::does_not_load_the_hinges()) } @else { (message::loads_the_hinges_first()) }
                    @if one.building.equations.undamped.is_zero() { (message::and_no_p_delta()) } @else { (message::and_p_delta()) }
                } }
                div { dt { (message::floor_shares()) } dd {
                    @let shares: Vec<String> = curve.floor_loads.iter().map(|share| format::significant(100.0 * share, 3)).collect();
                    (message::from_the_ground_up(shares.join(", ")))
                } }
            }
        }
    }
}

fn bilinear_card(one: &PushedBuilding, curve: &Pushover) -> Markup {
    html! {
        div.card {
            h3 { (message::bilinear_discretization(direction(one, curve))) }
            @match Bilinear::fit(&curve.points) {
                Some(two) => {
                    dl {
                        div { dt { (message::yields_at()) } dd { (format::force(two.yield_force)) ", " (format::millimetres(two.yield_displacement)) } }
                        div { dt { (message::ends_at()) } dd { (format::force(two.ultimate_force)) ", " (format::millimetres(two.ultimate_displacement)) } }
                        div { dt { (message::stiffness_title()) } dd { (format::stiffness(two.stiffness())) } }
                        div { dt { (message::after_yield()) } dd { (message::of_it(percent(two.hardening(), 3))) } }
                        div { dt { (message::ductility_title()) } dd { (format::significant(two.ductility(), 3)) } }
                    }
                    p.quiet { (message::secant_through_60()) }
                }
                None => p.quiet { (message::the_curve_is_too_close()) }
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
            text.push(message::and_more(point.events.len() - NAMED));
        }
        text.join("; ")
    };
    html! {
        @if curve.points.iter().any(|point| !point.events.is_empty()) {
            div.beside {
                @let count = curve.points.iter().filter(|point| !point.events.is_empty()).count();
                h3 { (message::what_happened_in_order(direction(one, curve))) " " span.quiet { (message::count_of_events(count)) } }
                div.scroll.tall {
                    table.events {
                        thead { tr {
                            th.number { (message::roof_mm()) } th.number { (message::drift()) } th.number { (message::base_shear_kn()) } th.number { (message::of_weight()) } th { (message::hinges_and_columns()) }
                        } }
                        tbody {
                            @for point in curve.points.iter().filter(|point| !point.events.is_empty()) {
                                tr data-roof=(point.roof) data-curve=(index) {
                                    td.number { (format::in_unit(format::LENGTH, point.roof, 2)) }
                                    td.number { (format::fixed(100.0 * curve.drift(point), 3)) }
                                    td.number { (format::in_unit(format::FORCE, point.base_shear, 1)) }
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

fn guide(in_space: bool) -> Markup {
    html! {
        section #guide {
            h2 { (message::how_to_read()) }
            ul {
                li { (message::the_load_pattern_is_constant()) }
                li { (message::hinges_are_linear_between()) }
                li { (message::the_curve_falls_where_p()) }
                li { (message::a_hinge_cracks_or_yields()) }
                @if in_space { li { (message::spaces_are_pushed_along_x()) } }
                li { (message::a_pushover_shows_strength()) }
            }
        }
    }
}
