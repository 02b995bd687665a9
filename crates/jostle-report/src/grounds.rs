//! Ground that differs: displacements of the grounds, and what they add to the closing of neighbours.

use maud::{Markup, html};

use crate::message;
use crate::static_plot::{Line, Plot};
use crate::{Page, format};

/// Buildings and pairs shown at most.
const SHOWN: usize = 12;
/// Instants of a plot whose motion is no record.
const INSTANTS: f64 = 1000.0;

/// The section; nothing where one ground is under all.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    page.motion.grounds.as_ref()?;
    let names: Vec<&str> = page.model.buildings.iter().map(|b| &b.name[..]).collect();
    let duration = page.motion.duration;
    let step = page.motion.corner_step().unwrap_or(duration / INSTANTS);
    let times: Vec<f64> = (0..=(duration / step).ceil().min(1e6) as u32)
        .map(|i| (f64::from(i) * step).min(duration))
        .collect();
    let shown = names.len().min(SHOWN);
    let moved = |axis: usize| -> Vec<Vec<f64>> {
        let moved = (0..shown).map(|building| {
            let path = page.motion.under(building);
            let values = times
                .iter()
                .map(|t| format::LENGTH.of(path.at(*t).displacement[axis]));
            values.collect()
        });
        moved.collect()
    };
    let in_space = page.model.is_in_space();
    let (moved, across) = (moved(0), if in_space { moved(1) } else { Vec::new() });
    let points = |values: &mut dyn Iterator<Item = f64>| -> Vec<[f64; 2]> {
        times
            .iter()
            .zip(values)
            .map(|(t, value)| [*t, value])
            .collect()
    };
    let lines = |moved: &[Vec<f64>]| -> Vec<Line> {
        let grounds = names.iter().zip(moved).enumerate();
        let lines = grounds.map(|(colour, (name, moved))| Line {
            name: (*name).to_owned(),
            points: points(&mut moved.iter().copied()),
            colour,
            dashed: false,
        });
        lines.collect()
    };
    let pairs = (1..shown).map(|right| Line {
        name: format!("{} − {}", names[right - 1], names[right]),
        points: points(
            &mut moved[right - 1]
                .iter()
                .zip(&moved[right])
                .map(|(l, r)| l - r),
        ),
        colour: right - 1,
        dashed: false,
    });
    let plot = |title: &str, y_label: &str, lines: Vec<Line>| Plot {
        title: title.to_owned(),
        x_label: message::time_s().to_owned(),
        y_label: y_label.to_owned(),
        logarithmic: false,
        aspect: 0.45,
        lines,
    };
    let first = plot(
        message::displacement_of_the_grounds(),
        message::displacement_mm(),
        lines(&moved),
    );
    // In space neighbours close in any direction.
    let second = if in_space {
        plot(
            message::displacement_of_the_grounds_across(),
            message::displacement_mm(),
            lines(&across),
        )
    } else {
        plot(
            message::part_of_the_closing(),
            message::d_left_d_right_mm(),
            pairs.collect(),
        )
    };
    let of_buildings = page.summary.buildings.iter();
    let of_buildings = of_buildings.filter_map(|building| Some((building, building.ground?)));
    Some(html! {
        section #grounds {
            h2 { (message::ground_under_the_buildings()) }
            p.quiet {
                (message::displacements_of_the_ground())
            }
            div.static-plots {
                (first.figure())
                @if shown > 1 || in_space { (second.figure()) }
            }
            table {
                thead { tr { th { (message::building()) } th { (message::arrival_s()) } th { (message::greatest_displacement_mm()) } th { (message::at_the_end_mm()) } } }
                tbody {
                    @for (building, ground) in of_buildings {
                        tr {
                            td { (building.name) }
                            td { (format::fixed(ground.arrival_s, 3)) }
                            td { (format::in_unit(format::LENGTH, ground.displacement_peak_m, 1)) }
                            td { (format::in_unit(format::LENGTH, ground.displacement_end_m, 1)) }
                        }
                    }
                }
            }
        }
    })
}
