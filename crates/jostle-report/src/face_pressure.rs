//! How the force of a face is spread along it at its largest impact.

use jostle::interface::PlanContactKind;
use jostle::linear::sort_by;
use jostle::results::summary::ContactSummary;
use maud::{Markup, html};

use crate::message;
use crate::scale::Scale;
use crate::site_places::part_of;
use crate::{Page, format};

/// Faces that are drawn at most, those with the greatest forces.
const MOST: usize = 6;
/// Size of a picture, and its margins.
const WIDTH: f64 = 420.0;
const HEIGHT: f64 = 236.0;
const LEFT: f64 = 56.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 40.0;

/// A picture for each of the faces with the greatest forces; nothing without an impact of a face.
pub(crate) fn figures(page: &Page) -> Markup {
    let contacts = page.gaps().flat_map(|(summary, gap)| {
        summary
            .contacts
            .iter()
            .map(move |contact| (summary, gap, contact))
    });
    let mut faces: Vec<_> = contacts
        .filter(|(.., contact)| {
            let is_face = contact
                .in_plan
                .is_some_and(|plan| plan.kind == PlanContactKind::Face);
            is_face && contact.peak_force_n > 0.0
        })
        .collect();
    sort_by(&mut faces, |a, b| {
        b.2.peak_force_n.total_cmp(&a.2.peak_force_n)
    });
    html! {
        @if !faces.is_empty() { div.pressures {
            h3 { (message::force_along_the_faces()) }
            p.quiet { (message::force_per_length()) }
            div.static-plots {
                @for (summary, gap, contact) in faces.iter().take(MOST) {
                    @let names = &summary.between;
                    @let sides = [0, 1].map(|side| side_in_words(page, gap.between[side], contact, side));
                    (figure(contact, names, &sides))
                }
            }
            @if faces.len() > MOST { p.quiet { (message::the_faces_with_the_greatest(MOST, faces.len())) } }
        } }
    }
}

/// Floor and edge of a side: `floor 3, edge 2–3`, or `face` of a wall.
fn side_in_words(
    page: &Page,
    building: Option<usize>,
    contact: &ContactSummary,
    side: usize,
) -> String {
    let (Some(building), Some(plan)) = (building, contact.in_plan) else {
        return String::new();
    };
    let part = part_of(page.model, building, contact.floors[side], plan.parts[side]);
    match contact.floors[side] {
        Some(floor) => message::floor_floor_part(floor, &part),
        None => part,
    }
}

fn figure(contact: &ContactSummary, names: &[String; 2], sides: &[String; 2]) -> Markup {
    let Some(plan) = contact.in_plan else {
        return html! {};
    };
    let length = plan.overlap_m;
    let along = [-plan.normal[1], plan.normal[0]];
    let place = |[x, y]: [f64; 2]| {
        (x - plan.plan_m[0]) * along[0] + (y - plan.plan_m[1]) * along[1] + 0.5 * length
    };
    // F_i = w_i L p_i, in kN/m or kip/ft.
    let pressures: Vec<[f64; 2]> = plan
        .points
        .iter()
        .filter(|point| point.share > 0.0)
        .map(|point| {
            let pressure = format::LINE_LOAD.of(point.force / (point.share * length));
            [place(point.place), pressure]
        })
        .collect();
    let total = plan.points.iter().fold(0.0, |sum, point| sum + point.force);
    let mean = format::LINE_LOAD.of(total / length);
    let most = pressures.iter().map(|p| p[1]).fold(mean, f64::max);
    let x = Scale::new(
        [0.0, length],
        [LEFT, WIDTH - RIGHT],
        format::HEIGHT.size(),
        6.0,
    );
    let y = Scale::new([0.0, most.max(1e-9)], [HEIGHT - BOTTOM, TOP], 1.0, 4.0);
    let (px, py) = (|value: f64| x.at(value), |value: f64| y.at(value));
    let line: Vec<String> = pressures
        .iter()
        .map(|[s, p]| format!("{:.1},{:.1}", px(*s), py(*p)))
        .collect();
    let area = format!(
        "{:.1},{:.1} {} {:.1},{:.1}",
        px(0.0),
        py(0.0),
        line.join(" "),
        px(length),
        py(0.0)
    );
    let centre = plan.points.centre.map(place);
    html! {
        figure.static-plot.pressure {
            figcaption {
                span.chart-title { (names[0]) ", " (sides[0]) " ↔ " (names[1]) ", " (sides[1]) }
                br;
                span.quiet {
                    (format::force(total))
                    @if let Some(at) = plan.points.at { " " (message::at_at(format::instant(at))) }
                    @if let Some(centre) = centre { (message::centre_of_pressure_m(format::in_unit(format::HEIGHT, centre - 0.5 * length, 2))) }
                }
            }
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(message::force_per_length_along()) {
                g.grid {
                    (y.up([LEFT, WIDTH - RIGHT]))
                    (x.numbers_at(HEIGHT - BOTTOM + 15.0))
                }
                polygon.pressed points=(area) {}
                polyline.pressed-line points=(line.join(" ")) {}
                line.even x1=(LEFT) x2=(WIDTH - RIGHT) y1=(format!("{:.1}", py(mean))) y2=(format!("{:.1}", py(mean))) {}
                @for ([s, p], point) in pressures.iter().zip(plan.points.iter()) {
                    @let share = 100.0 * point.force / total.max(1e-9);
                    circle.pressed-point cx=(format!("{:.1}", px(*s))) cy=(format!("{:.1}", py(*p))) r="3.2" {
                        title { (message::of_the_force_share(format::force(point.force), format::fixed(share, 1), format::fixed(100.0 * point.share, 1))) }
                    }
                    @let anchor = if *s < 0.08 * length { "start" } else if *s > 0.92 * length { "end" } else { "middle" };
                    text.share x=(format!("{:.1}", px(*s))) y=(format!("{:.1}", py(*p) - 7.0)) text-anchor=(anchor) { (format::fixed(share, 0)) " %" }
                }
                @if let Some(centre) = centre {
                    @let x = px(centre);
                    polygon.centre points=(format!("{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}", x, py(0.0) - 1.0, x - 6.0, py(0.0) - 12.0, x + 6.0, py(0.0) - 12.0)) {}
                }
                line.base-line x1=(LEFT) x2=(WIDTH - RIGHT) y1=(py(0.0)) y2=(py(0.0)) {}
                text x=(0.5 * (LEFT + WIDTH - RIGHT)) y=(HEIGHT - 6.0) text-anchor="middle" { (message::along_the_face_m()) }
                text x="4" y="12" { (message::force_per_length_kn_m()) }
            }
        }
    }
}
