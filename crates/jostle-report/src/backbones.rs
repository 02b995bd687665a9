//! Curves of first loading of the hinges of a building, as small plots without scripts.

use jostle::hysteresis::{Hysteresis, HysteresisRule, Side};
use jostle::model::{Building, Hinges, PlanAxis, Structure};
use maud::{Markup, html};

use crate::format;
use crate::hinges::outline;
use crate::message;
use crate::scale::Scale;

const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 170.0;
const LEFT: f64 = 44.0;
const RIGHT: f64 = 8.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 30.0;

/// End of the drawn curves, in yield deformations \[–\].
const REACH: f64 = 2.5;

/// A picture for the columns, the beams or the storeys, with the moments in words.
pub(crate) fn curves(index: usize, building: &Building) -> Markup {
    let bend = |springs: &[Hysteresis]| -> Vec<Hysteresis> {
        let springs = springs.iter().copied();
        springs
            .filter(|spring| spring.rule() != HysteresisRule::Elastic)
            .collect()
    };
    let flat = |rows: &[Vec<Hysteresis>]| bend(&rows.concat());
    let mut sets = match &building.hinges {
        Some(Hinges::Frame(hinges)) => vec![
            (message::hinges_of_columns(), flat(&hinges.columns), false),
            (message::hinges_of_beams(), flat(&hinges.beams), false),
        ],
        Some(Hinges::Storeys(springs)) => vec![(message::storeys_title(), bend(springs), true)],
        None => Vec::new(),
    };
    if let Structure::Tiers(tiers) = &building.structure {
        let frames = || tiers.frames.iter().map(|frame| &frame.hinges);
        let columns: Vec<_> = frames().flat_map(|frame| frame.columns.concat()).collect();
        let beams: Vec<_> = frames().flat_map(|frame| frame.beams.concat()).collect();
        sets.push((message::hinges_of_columns(), bend(&columns), false));
        sets.push((message::hinges_of_beams(), bend(&beams), false));
        let names = [message::along_x(), message::across_title()];
        for (axis, name) in PlanAxis::BOTH.into_iter().zip(names) {
            let yielding = tiers.yielding.iter().filter(|spring| spring.axis == axis);
            let hysteresis: Vec<Hysteresis> = yielding.map(|spring| spring.hysteresis).collect();
            sets.push((name, bend(&hysteresis), true));
        }
    }
    for (name, hinge, slides) in [
        (
            message::base_rocking(),
            building.base.rotational_hinge,
            false,
        ),
        (
            message::base_sliding(),
            building.base.horizontal_hinge,
            true,
        ),
    ] {
        sets.push((name, bend(hinge.as_slice()), slides));
    }
    html! {
        @for (name, springs, storeys) in sets.iter().filter(|(_, springs, _)| !springs.is_empty()) {
            figure.curves {
                figcaption { (name) }
                p.quiet { (words(springs, *storeys)) }
                (picture(index, name, springs, *storeys))
            }
        }
    }
}

/// Rule, cracking and yield: "peak-oriented; cracks at 80 to 95 kN·m, yields at 250 to 300 kN·m".
fn words(springs: &[Hysteresis], storeys: bool) -> String {
    let shown = if storeys {
        format::FORCE
    } else {
        format::MOMENT
    };
    let mut rules: Vec<&str> = springs.iter().map(|spring| spring.rule().name()).collect();
    rules.dedup();
    let differ = springs
        .iter()
        .any(|spring| spring.backbone().mirrored() != *spring.backbone());
    let sides: Vec<String> = Side::BOTH
        .into_iter()
        .filter(|side| *side == Side::Positive || differ)
        .map(|side| {
            let of = |yielding: bool| {
                let forces = springs.iter().map(|spring| {
                    let curve = spring.backbone().side(side);
                    if yielding {
                        curve.yielding.force
                    } else {
                        curve.cracking.force
                    }
                });
                let (low, high) = forces.fold((f64::INFINITY, 0.0_f64), |(low, high), force| {
                    (low.min(force), high.max(force))
                });
                let [low, high] = [low, high].map(|force| format::significant(shown.of(force), 3));
                if low == high {
                    low
                } else {
                    message::low_to_high(&low, &high)
                }
            };
            let sign = match (differ, side) {
                (false, _) => "",
                (true, Side::Positive) => " (+)",
                (true, Side::Negative) => " (−)",
            };
            message::cracks_at_yields(of(false), of(true), shown.name(), sign)
        })
        .collect();
    format!("{}: {}", rules.join(", "), sides.join("; "))
}

/// Distinct curves laid over each other.
fn picture(building: usize, name: &str, springs: &[Hysteresis], storeys: bool) -> Markup {
    let mut distinct: Vec<&Hysteresis> = Vec::new();
    for spring in springs {
        if !distinct
            .iter()
            .any(|known| known.backbone() == spring.backbone())
        {
            distinct.push(spring);
        }
    }
    let yields = distinct.iter().flat_map(|spring| {
        Side::BOTH.map(|side| spring.backbone().side(side).yielding.deformation)
    });
    let reach = REACH * yields.fold(1e-12, f64::max);
    let outlines: Vec<Vec<[f64; 2]>> = distinct
        .iter()
        .map(|spring| outline(spring.backbone(), [reach; 2]))
        .collect();
    let high = 1.1
        * outlines
            .iter()
            .flatten()
            .map(|point| point[1].abs())
            .fold(1e-12, f64::max);
    let forces = if storeys {
        format::FORCE
    } else {
        format::MOMENT
    };
    let force = forces.name();
    // Radians as milliradians.
    let (deformation, milli) = match storeys {
        true => (format::LENGTH.name(), format::LENGTH.size()),
        false => ("mrad", 1e-3),
    };
    let x = Scale::new([-reach, reach], [LEFT, WIDTH - RIGHT], milli, 5.0);
    let y = Scale::new([-high, high], [HEIGHT - BOTTOM, TOP], forces.size(), 4.0);
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {HEIGHT}")) role="img" aria-label=(message::name_force_over_deformation(name, force, deformation)) {
            g.grid {
                (x.across([TOP, HEIGHT - BOTTOM]))
                (y.up([LEFT, WIDTH - RIGHT]))
                text x=(LEFT + 4.0) y=(TOP + 10.0) { (force) }
                text x=(WIDTH - RIGHT - 4.0) y=(HEIGHT - BOTTOM - 5.0) text-anchor="end" { (deformation) }
            }
            @for outline in &outlines {
                @let points: Vec<String> = outline.iter().map(|[d, f]| format!("{:.1},{:.1}", x.at(*d), y.at(*f))).collect();
                polyline.line style=(crate::document::colour(building)) points=(points.join(" ")) {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use jostle::hysteresis::{Backbone, Corners};

    use super::*;

    #[test]
    fn ranges_and_sides_are_told_only_where_they_differ() {
        let spring = |up: f64, down: f64| {
            let corners = |yielding| Corners {
                cracking: 80e3,
                yielding,
                post_cracking: 0.3,
                post_yield: 0.02,
            };
            let backbone = Backbone::from_forces(1e8, corners(up), corners(down)).expect("sound");
            Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("sound")
        };
        assert_eq!(
            words(&[spring(250e3, 250e3), spring(300e3, 300e3)], false),
            "peak-oriented: cracks at 80.0, yields at 250 to 300 kN·m"
        );
        assert_eq!(
            words(&[spring(250e3, 300e3)], true),
            "peak-oriented: cracks at 80.0, yields at 250 kN (+); cracks at 80.0, yields at 300 kN (−)"
        );
        let picture = picture(0, "x", &[spring(1e5, 1e5); 3], false).into_string();
        assert_eq!(
            picture.matches("<polyline").count(),
            1,
            "equal curves are drawn once"
        );
    }
}
