//! Diagrams of axial force, shear and moment of the members of a frame: envelopes, and the worst instant.

use jostle::model::{Building, Frame, Structure};
use jostle::results::summary::{BuildingSummary, MemberSummary};
use maud::{Markup, html};

use crate::format::Shown;
use crate::message;
use crate::{Page, format};

/// Most members that are drawn.
const MOST_MEMBERS: usize = 400;
/// Size of a picture, and the space around the frame \[px\].
const WIDTH: f64 = 320.0;
const HEIGHT: f64 = 300.0;
const MARGIN: f64 = 34.0;
/// Longest ordinate \[px\].
const LONGEST: f64 = 26.0;

/// Which force a picture shows.
#[derive(Clone, Copy, PartialEq)]
enum Force {
    Axial,
    Shear,
    Moment,
}

impl Force {
    fn all() -> [(Self, &'static str, Shown); 3] {
        [
            (Self::Axial, message::axial_force(), format::FORCE),
            (Self::Shear, message::shear_title(), format::FORCE),
            (Self::Moment, message::moment_title(), format::MOMENT),
        ]
    }
}

/// Values along a member, from its foot or left end on: share of its length, and least and greatest value.
type Course = Vec<(f64, [f64; 2])>;

/// The diagrams of a building, if it is a frame whose members are reported.
pub(crate) fn of_building(page: &Page, index: usize) -> Option<Markup> {
    let (building, summary) = (
        page.model.buildings.get(index)?,
        page.summary.buildings.get(index)?,
    );
    let Structure::Frame(frame) = &building.structure else {
        return None;
    };
    if summary.members.is_empty() || summary.members.len() > MOST_MEMBERS {
        return None;
    }
    let envelopes = Force::all().map(|(force, title, unit)| {
        let courses = courses(building, frame, summary, |member| envelope(member, force));
        picture(
            frame,
            index,
            &message::title_envelope(title),
            unit,
            &courses,
        )
    });
    let at = summary
        .capacity
        .as_ref()
        .map(|capacity| capacity.worst.at_s);
    let worst = at.filter(|_| summary.members.iter().any(|m| !m.at_worst.is_empty()));
    let worst = worst.map(|at| {
        Force::all().map(|(force, title, unit)| {
            let courses = courses(building, frame, summary, |member| at_worst(member, force));
            picture(
                frame,
                index,
                &message::title_at(title, format::instant(at)),
                unit,
                &courses,
            )
        })
    });
    Some(html! {
        details.peaks open {
            summary { (message::force_diagrams(&summary.name)) }
            div.multiples {
                @for picture in &envelopes { (picture) }
                @for picture in worst.iter().flatten() { (picture) }
            }
            p.quiet {
                (message::moments_are_drawn()) " "
                @if worst.is_some() { (message::the_instant()) }
            }
        }
    })
}

fn envelope(member: &MemberSummary, force: Force) -> Vec<(Option<f64>, [f64; 2])> {
    let struck = member
        .struck
        .iter()
        .flat_map(|s| [(Some(s.height_m), &s.below), (Some(s.height_m), &s.above)]);
    let ends = member.ends.iter().map(|end| (None, end));
    ends.chain(struck)
        .map(|(height, section)| {
            let values = match force {
                Force::Axial => [section.axial_min_n, section.axial_max_n],
                Force::Shear => [-section.shear_peak_n, section.shear_peak_n],
                Force::Moment => [-section.moment_peak_n_m, section.moment_peak_n_m],
            };
            (height, values)
        })
        .collect()
}

fn at_worst(member: &MemberSummary, force: Force) -> Vec<(Option<f64>, [f64; 2])> {
    let sections = member.at_worst.iter().enumerate();
    sections
        .map(|(index, forces)| {
            let value = match force {
                Force::Axial => forces.axial_n,
                Force::Shear => forces.shear_n,
                Force::Moment => forces.moment_n_m,
            };
            let height = (index >= 2).then_some(forces.height_m);
            (height, [value.min(0.0), value.max(0.0)])
        })
        .collect()
}

/// A member with its ends in metres and the values along it.
struct Drawn {
    ends: [[f64; 2]; 2],
    name: String,
    course: Course,
}

fn courses(
    building: &Building,
    frame: &Frame,
    summary: &BuildingSummary,
    of: impl Fn(&MemberSummary) -> Vec<(Option<f64>, [f64; 2])>,
) -> Vec<Drawn> {
    let across = sums(&frame.spans);
    let up = sums(&frame.storey_heights);
    let place = |name: &str| {
        let rest = name
            .strip_prefix(building.name.as_str())?
            .strip_prefix('.')?;
        let mut parts = rest.split('.');
        let kind = parts.next()?;
        let a: usize = parts.next()?.parse().ok()?;
        let b: usize = parts.next()?.parse().ok()?;
        match kind {
            "column" => {
                let x = *across.get(a - 1)?;
                Some([[x, *up.get(b - 1)?], [x, *up.get(b)?]])
            }
            _ => {
                let y = *up.get(a)?;
                Some([[*across.get(b - 1)?, y], [*across.get(b)?, y]])
            }
        }
    };
    let drawn = summary.members.iter().filter_map(|member| {
        let ends = place(&member.name)?;
        let values = of(member);
        let (first, last) = (values.first()?, values.get(1)?);
        let [low, high] = [ends[0][1], ends[1][1]];
        let mut course: Course = vec![(0.0, first.1)];
        course.extend(
            values[2..]
                .iter()
                .filter_map(|(height, values)| Some((((*height)? - low) / (high - low), *values))),
        );
        course.push((1.0, last.1));
        Some(Drawn {
            ends,
            name: member.name.clone(),
            course,
        })
    });
    drawn.collect()
}

/// Zero, then running sums.
fn sums(parts: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let rest = parts.iter().map(|part| {
        sum += part;
        sum
    });
    std::iter::once(0.0)
        .chain(rest.collect::<Vec<_>>())
        .collect()
}

fn picture(frame: &Frame, index: usize, title: &str, unit: Shown, members: &[Drawn]) -> Markup {
    let (width, height) = (
        frame.spans.iter().sum::<f64>(),
        frame.storey_heights.iter().sum::<f64>(),
    );
    let scale = ((WIDTH - 2.0 * MARGIN) / width).min((HEIGHT - 2.0 * MARGIN) / height);
    let left = 0.5 * (WIDTH - scale * width);
    let foot = HEIGHT - 0.5 * (HEIGHT - scale * height);
    let at = |[x, y]: [f64; 2]| [left + scale * x, foot - scale * y];
    let values = members.iter().flat_map(|member| &member.course);
    let greatest = values
        .flat_map(|(_, values)| *values)
        .fold(0.0_f64, |most, v| most.max(v.abs()));
    let ordinate = if greatest > 0.0 {
        LONGEST / greatest
    } else {
        0.0
    };
    let shape = |member: &Drawn, side: usize| {
        let [a, b] = member.ends.map(at);
        let vertical = (a[0] - b[0]).abs() < (a[1] - b[1]).abs();
        let mut points = vec![a];
        points.extend(member.course.iter().map(|(share, values)| {
            let offset = ordinate * values[side];
            let on = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
            // To the right of a column, below a beam.
            if vertical {
                [on[0] + offset, on[1]]
            } else {
                [on[0], on[1] + offset]
            }
        }));
        points.push(b);
        let points: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        points.join(" ")
    };
    html! {
        figure.multiple.diagram {
            figcaption { (title) " " span.unit { (message::greatest_in_unit(format::significant(unit.of(greatest), 3), unit.name())) } }
            svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(title) style=(crate::document::colour(index)) {
                @for member in members {
                    @for side in 0..2 {
                        @if member.course.iter().any(|(_, values)| values[side] != 0.0) {
                            polygon.area points=(shape(member, side)) { title { (member.name) } }
                        }
                    }
                }
                @for member in members {
                    @let [a, b] = member.ends.map(at);
                    line.member x1=(format!("{:.1}", a[0])) y1=(format!("{:.1}", a[1])) x2=(format!("{:.1}", b[0])) y2=(format!("{:.1}", b[1])) {}
                }
            }
        }
    }
}
