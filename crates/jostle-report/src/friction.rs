//! Friction along faces: peaks of every face, and how far the faces that slide most slip over time.

use jostle::linear::sort_by;
use jostle::results::in_plan::{PlanContactSummary, SlidingSummary};
use jostle::results::summary::{ContactSummary, GapSummary};
use jostle::{Column, Model};
use maud::{Markup, html};

use crate::plan_motion::point_motion;
use crate::site_places::part_of;
use crate::static_plot::{Line, Plot, thinned_to};
use crate::{Page, format, message};

/// Faces whose slip is drawn at most, those that dissipate most.
const MOST: usize = 6;
/// Points of a history.
const POINTS: usize = 500;

/// A face with friction that was pressed.
struct Face<'a> {
    gap: &'a GapSummary,
    between: [Option<usize>; 2],
    contact: &'a ContactSummary,
    plan: PlanContactSummary,
    sliding: SlidingSummary,
}

/// The table and the histories; nothing without friction.
pub(crate) fn section(page: &Page) -> Markup {
    let has_friction = page.model.gaps.iter().any(|gap| gap.in_plan.friction > 0.0);
    if !has_friction {
        return html! {};
    }
    let all: Vec<Face> = page
        .gaps()
        .flat_map(|(gap, model_gap)| {
            gap.contacts.iter().filter_map(move |contact| {
                let plan = contact.in_plan?;
                let sliding = plan.sliding.filter(|_| contact.impact_count > 0)?;
                Some(Face {
                    gap,
                    between: model_gap.between,
                    contact,
                    plan,
                    sliding,
                })
            })
        })
        .collect();
    let mut most: Vec<&Face> = all
        .iter()
        .filter(|face| face.sliding.slip_peak_m > 0.0)
        .collect();
    sort_by(&mut most, |a, b| {
        b.sliding.friction_j.total_cmp(&a.sliding.friction_j)
    });
    most.truncate(MOST);
    html! {
        div #friction.site-plan {
            h3 { (message::friction_along_faces()) }
            @if all.is_empty() {
                p.quiet { (message::no_face_with_friction_was_pressed()) }
            } @else {
                (table(page.model, &all))
                p.quiet { (message::friction_force_is_the_sum()) }
                @if page.history.len() > 1 && !most.is_empty() {
                    div.static-plots {
                        @for face in &most { @if let Some(plot) = slip_over_time(page, face) { (plot.figure()) } }
                    }
                    p.quiet { (message::slip_is_that_of_the_middle()) }
                }
            }
        }
    }
}

fn table(model: &Model, all: &[Face]) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th scope="col" { (message::between()) } th scope="col" { (message::faces_word()) }
                th.number scope="col" { (message::friction_coefficient()) }
                th.number scope="col" { (message::peak_friction_force()) br; span.unit { (format::FORCE.bracketed()) } }
                th.number scope="col" { (message::greatest_slip()) br; span.unit { (format::LENGTH.bracketed()) } }
                th.number scope="col" { (message::friction_impulse()) br; span.unit { (format::IMPULSE.bracketed()) } }
                th.number scope="col" { (message::dissipated()) br; span.unit { (format::ENERGY.bracketed()) } }
            } }
            tbody {
                @for face in all {
                    @let sides = [0, 1].map(|side| side_in_words(model, face, side));
                    tr {
                        th scope="row" { (face.gap.between[0]) " ↔ " (face.gap.between[1]) }
                        td { (sides[0]) " | " (sides[1]) }
                        td.number { (format::plain(coefficient(model, face), 3)) }
                        td.number { (format::significant(format::FORCE.of(face.sliding.tangential_peak_n), 4)) }
                        td.number { (format::in_unit(format::LENGTH, face.sliding.slip_peak_m, 2)) }
                        td.number { (format::in_unit(format::IMPULSE, face.sliding.tangential_impulse_n_s, 2)) }
                        td.number { (format::in_unit(format::ENERGY, face.sliding.friction_j, 2)) }
                    }
                }
            }
        } }
    }
}

fn coefficient(model: &Model, face: &Face) -> f64 {
    let model_gap = model.gaps.iter().find(|gap| gap.between == face.between);
    model_gap.map_or(f64::NAN, |gap| gap.in_plan.friction)
}

/// Floor and edge of a side.
fn side_in_words(model: &Model, face: &Face, side: usize) -> String {
    let Some(building) = face.between[side] else {
        return message::wall().to_owned();
    };
    let floor = face.contact.floors[side];
    let part = part_of(model, building, floor, face.plan.parts[side]);
    match floor {
        Some(floor) => message::floor_floor_part(floor, part),
        None => part,
    }
}

/// Slip at the middle of a face since rest; strong while it is pressed.
fn slip_over_time(page: &Page, face: &Face) -> Option<Plot> {
    let times = page.history.column(Column::TIME)?;
    let [tx, ty] = [-face.plan.normal[1], face.plan.normal[0]];
    let ([ax, ay], [bx, by]) = (moved(page, face, 0)?, moved(page, face, 1)?);
    let slip =
        |row: usize| format::LENGTH.of(1.0) * (tx * (ax[row] - bx[row]) + ty * (ay[row] - by[row]));
    let slip: Vec<[f64; 2]> = times
        .iter()
        .enumerate()
        .map(|(row, time)| [*time, slip(row)])
        .collect();
    let mut lines = vec![Line {
        name: message::slip_since_rest().to_owned(),
        points: thinned_to(&slip, POINTS),
        colour: 6,
        dashed: true,
    }];
    for (number, impact) in face.contact.impacts.iter().enumerate() {
        let from = slip.partition_point(|[time, _]| *time < impact.start_s);
        let to = slip.partition_point(|[time, _]| *time <= impact.end_s);
        let pressed = &slip[from.saturating_sub(1)..(to + 1).min(slip.len())];
        lines.push(Line {
            name: match number {
                0 => message::while_the_face_is_pressed().to_owned(),
                _ => String::new(),
            },
            points: thinned_to(pressed, POINTS / 10),
            colour: 1,
            dashed: false,
        });
    }
    let [left, right] = &face.gap.between;
    let sides = [0, 1].map(|side| side_in_words(page.model, face, side));
    Some(Plot {
        title: message::slip_of_face(left, right, &sides[0], &sides[1]),
        x_label: message::time_s().to_owned(),
        y_label: message::slip_mm().to_owned(),
        logarithmic: false,
        aspect: 0.5,
        lines,
    })
}

/// Displacement of the middle of a face with the floor of a side, over time: along x and across; zero of a wall \[m\].
fn moved(page: &Page, face: &Face, side: usize) -> Option<[Vec<f64>; 2]> {
    match (face.between[side], face.contact.floors[side]) {
        (Some(building), Some(floor)) => point_motion(
            page.model,
            page.history,
            (building, floor),
            face.plan.plan_m,
        ),
        // Columns bend between floors, by more than histories know.
        (Some(building), None) if building < page.model.buildings.len() => None,
        _ => Some([(); 2].map(|()| vec![0.0; page.history.len()])),
    }
}
