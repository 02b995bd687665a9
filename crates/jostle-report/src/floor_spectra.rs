//! Response spectra of floors: plots with and without contact, and a table of peak accelerations.

use jostle::results::floor_spectra::{FloorSpectra, FloorSpectrum};
use maud::{Markup, html};

use crate::message;
use crate::static_plot::{Line, Plot};
use crate::{Page, format};

/// Plots shown at most; the others are in the table and in the files.
const PLOTS: usize = 24;

/// The section; nothing unless spectra were asked for.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let found = page.summary.floor_spectra.as_ref()?;
    let names: Vec<&str> = page.model.buildings.iter().map(|b| &b.name[..]).collect();
    let compared = found
        .floors
        .iter()
        .any(|floor| floor.without_contact.is_some());
    let filter = &found.filter;
    Some(html! {
        section #floor-spectra {
            h2 { (message::floor_response_spectra()) }
            p.quiet {
                (message::peak_pseudo_acceleration_of_elastic())
                @if compared { " " (message::dashed_the_run_without_contact()) }
            }
            div.static-plots {
                @for floor in found.floors.iter().rev().take(PLOTS) { (plot(found, floor, &names)) }
            }
            @if found.floors.len() > PLOTS {
                p.quiet { (message::the_plots_show_of_floors(PLOTS, found.floors.len())) }
            }
            (table(found, compared))
            p.quiet {
                (message::peak_accelerations_beside_impacts_depend(filter.name, filter.order, format::plain(filter.corner_hz, 3), format::milliseconds(found.row_interval_s), format::significant(100.0 * found.resolution, 2)))
            }
        }
    })
}

fn plot(found: &FloorSpectra, floor: &FloorSpectrum, names: &[&str]) -> Markup {
    let building = names.iter().position(|name| *name == floor.building);
    let several = floor.response.spectra.len() > 1;
    let mut lines = Vec::new();
    let runs = [
        (Some(&floor.response), false),
        (floor.without_contact.as_ref(), true),
    ];
    for (response, dashed) in runs {
        let Some(response) = response else { continue };
        for (index, curve) in response.spectra.iter().enumerate() {
            let name = match (several, dashed) {
                (true, false) => format!("{} %", format::plain(100.0 * curve.damping, 3)),
                _ => String::new(),
            };
            let values = found.periods_s.iter().zip(&curve.pseudo_acceleration_m_s2);
            lines.push(Line {
                name,
                points: values
                    .map(|(period, value)| [*period, format::ACCELERATION.of(*value)])
                    .collect(),
                colour: building.unwrap_or(0) + if several { index } else { 0 },
                dashed,
            });
        }
    }
    let damping = match &floor.response.spectra[..] {
        [only] => message::damping_damping(format::plain(100.0 * only.damping, 3)),
        _ => String::new(),
    };
    let plot = Plot {
        title: message::building_floor_floor_damping(&floor.building, floor.floor, &damping),
        x_label: message::period_s().into(),
        y_label: message::pseudo_acceleration_m_s().into(),
        logarithmic: true,
        aspect: 0.56,
        lines,
    };
    plot.figure()
}

fn table(found: &FloorSpectra, compared: bool) -> Markup {
    let number = |value: f64| format::in_unit(format::ACCELERATION, value, 2);
    html! {
        div.scroll {
            table {
                thead { tr {
                    th scope="col" { (message::floor()) }
                    th.number scope="col" { (message::peak_acceleration()) br; span.unit { (format::ACCELERATION.bracketed()) } }
                    th.number scope="col" { (message::filtered()) br; span.unit { (format::ACCELERATION.bracketed()) } }
                    @if compared {
                        th.number scope="col" { (message::without_contact()) br; span.unit { (format::ACCELERATION.bracketed()) } }
                        th.number scope="col" { (message::filtered()) br; span.unit { (format::ACCELERATION.bracketed()) } }
                    }
                    th.number scope="col" { (message::damping()) br; span.unit { "[%]" } }
                    th.number scope="col" { (message::peak_of_the_spectrum()) br; span.unit { (format::ACCELERATION.bracketed()) } }
                    th.number scope="col" { (message::at_period()) br; span.unit { "[s]" } }
                    @if compared {
                        th.number scope="col" { (message::without_contact()) br; span.unit { (format::ACCELERATION.bracketed()) } }
                        th.number scope="col" { (message::greatest_ratio()) }
                        th.number scope="col" { (message::at_period()) br; span.unit { "[s]" } }
                    }
                } }
                tbody {
                    @for floor in found.floors.iter().rev() {
                        @for (index, curve) in floor.response.spectra.iter().enumerate() {
                            @let before = floor.without_contact.as_ref();
                            @let strongest = curve.strongest();
                            tr {
                                th scope="row" { (floor.building) " " (floor.floor) }
                                td.number { (number(floor.response.peak_acceleration_m_s2)) }
                                td.number { (number(floor.response.filtered_peak_acceleration_m_s2)) }
                                @if compared {
                                    td.number { (before.map_or(format::NOTHING.into(), |b| number(b.peak_acceleration_m_s2))) }
                                    td.number { (before.map_or(format::NOTHING.into(), |b| number(b.filtered_peak_acceleration_m_s2))) }
                                }
                                td.number { (format::plain(100.0 * curve.damping, 3)) }
                                td.number { (strongest.map_or(format::NOTHING.into(), |i| number(curve.pseudo_acceleration_m_s2[i]))) }
                                td.number { (strongest.map_or(format::NOTHING.into(), |i| format::fixed(found.periods_s[i], 3))) }
                                @if compared {
                                    @let other = before.and_then(|b| b.spectra.get(index));
                                    @let greatest = other.and_then(|b| b.strongest().map(|i| b.pseudo_acceleration_m_s2[i]));
                                    @let ratio = floor.greatest_ratio(index);
                                    td.number { (greatest.map_or(format::NOTHING.into(), number)) }
                                    td.number { (ratio.map_or(format::NOTHING.into(), |(_, ratio)| format::fixed(ratio, 2))) }
                                    td.number { (ratio.map_or(format::NOTHING.into(), |(i, _)| format::fixed(found.periods_s[i], 3))) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
