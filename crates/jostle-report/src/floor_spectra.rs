//! Response spectra of floors: plots with and without contact, and a table of peak accelerations.

use jostle::results::floor_spectra::{FloorSpectra, FloorSpectrum};
use maud::{Markup, html};

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
            h2 { "Floor response spectra" }
            p.quiet {
                "Peak pseudo-acceleration of elastic oscillators, such as equipment, that stand on a floor and do not act back on it."
                @if compared { " Dashed: the run without contact." }
            }
            div.static-plots {
                @for floor in found.floors.iter().rev().take(PLOTS) { (plot(found, floor, &names)) }
            }
            @if found.floors.len() > PLOTS {
                p.quiet { "The plots show " (PLOTS) " of " (found.floors.len()) " floors; floor_spectra.parquet contains all of them." }
            }
            (table(found, compared))
            p.quiet {
                "Peak accelerations beside impacts depend on the contact stiffness. Filtered: " (filter.name) " of order " (filter.order)
                ", run forwards and backwards, with a gain of one half at " (format::plain(filter.corner_hz, 3)) "\u{a0}Hz."
                " Instants of the floor motion are at most " (format::milliseconds(found.row_interval_s))
                " apart in free vibration, and every step in contact is one; the estimated error of the spectra from their distance is "
                (format::significant(100.0 * found.resolution, 2)) "\u{a0}%."
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
                points: values.map(|(period, value)| [*period, *value]).collect(),
                colour: building.unwrap_or(0) + if several { index } else { 0 },
                dashed,
            });
        }
    }
    let damping = match &floor.response.spectra[..] {
        [only] => format!(", damping {} %", format::plain(100.0 * only.damping, 3)),
        _ => String::new(),
    };
    let plot = Plot {
        title: format!("{}, floor {}{damping}", floor.building, floor.floor),
        x_label: "period [s]".into(),
        y_label: "pseudo-acceleration [m/s²]".into(),
        logarithmic: true,
        aspect: 0.56,
        lines,
    };
    plot.figure()
}

fn table(found: &FloorSpectra, compared: bool) -> Markup {
    let number = |value: f64| format::fixed(value, 2);
    html! {
        div.scroll {
            table {
                thead { tr {
                    th scope="col" { "floor" }
                    th.number scope="col" { "peak acceleration" br; span.unit { "[m/s²]" } }
                    th.number scope="col" { "filtered" br; span.unit { "[m/s²]" } }
                    @if compared {
                        th.number scope="col" { "without contact" br; span.unit { "[m/s²]" } }
                        th.number scope="col" { "filtered" br; span.unit { "[m/s²]" } }
                    }
                    th.number scope="col" { "damping" br; span.unit { "[%]" } }
                    th.number scope="col" { "peak of the spectrum" br; span.unit { "[m/s²]" } }
                    th.number scope="col" { "at period" br; span.unit { "[s]" } }
                    @if compared {
                        th.number scope="col" { "without contact" br; span.unit { "[m/s²]" } }
                        th.number scope="col" { "greatest ratio" }
                        th.number scope="col" { "at period" br; span.unit { "[s]" } }
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
