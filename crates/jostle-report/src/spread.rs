//! How far the main results spread with the contact stiffness and the restitution.

use jostle::results::contact_sensitivity::{BuildingChange, GapSpread, RangeEnd, VariantResult};
use maud::{Markup, html};

use crate::message;
use crate::{Page, format};

/// A change of the results of a building: name and value \[–\].
type Change = (&'static str, fn(&BuildingChange) -> f64);

fn changes() -> [Change; 5] {
    [
        (message::displacement(), |change| change.displacement),
        (message::storey_drift(), |change| change.storey_drift),
        (message::total_acceleration(), |change| {
            change.total_acceleration
        }),
        (message::storey_shear(), |change| change.storey_shear),
        (message::overturning_moment(), |change| {
            change.overturning_moment
        }),
    ]
}

/// The section; `None` if no runs with other contacts were made.
pub(crate) fn section(page: &Page) -> Option<Markup> {
    let found = page.summary.contact_sensitivity.as_ref()?;
    let several = found.gaps.len() > 1;
    let greatest = page.summary.gaps.iter().map(|gap| gap.peak_force_n);
    let greatest = greatest.fold(0.0, f64::max);
    let impacts: usize = page.summary.gaps.iter().map(|gap| gap.impact_count).sum();
    Some(html! {
        section #spread.spread {
            h2 { (message::spread_over_contacts()) }
            p.quiet {
                (message::nobody_knows_contact_stiffness(found.variants.len()))
            }
            div.scroll { table {
                thead { tr {
                    th scope="col" { (message::result()) } th.number scope="col" { (message::this_run()) } th.number scope="col" { (message::least()) } th.number scope="col" { (message::greatest()) }
                    th scope="col" { (message::from_zero_to_the_greatest()) }
                } }
                tbody {
                    @for (gap, own) in found.gaps.iter().zip(&page.summary.gaps) {
                        (row(&named(message::peak_force_kn(), gap, several), [own.peak_force_n, gap.peak_force_min_n, gap.peak_force_max_n], |force| format::significant(format::FORCE.of(force), 4)))
                        @let counts = [own.impact_count, gap.impact_count_min, gap.impact_count_max].map(|count| count as f64);
                        (row(&named(message::impacts(), gap, several), counts, |count| format::fixed(count, 0)))
                    }
                    @for (building, own) in found.buildings.iter().zip(&page.summary.buildings) {
                        (row(&message::total_acceleration_of(&building.name), [own.response.total_acceleration_peak_m_s2, building.total_acceleration_min_m_s2, building.total_acceleration_max_m_s2], |value| format::significant(format::ACCELERATION.of(value), 3)))
                    }
                }
            } }
            div.scroll { table {
                thead { tr {
                    th scope="col" { (message::contact()) } th.number scope="col" { (message::peak_force()) br; span.unit { (format::FORCE.bracketed()) } } th.number scope="col" { (message::impacts()) }
                } }
                tbody {
                    tr { th scope="row" { (message::of_this_run()) } td.number { (format::significant(format::FORCE.of(greatest), 4)) } td.number { (impacts) } }
                    @for variant in &found.variants {
                        tr { th scope="row" { (in_words(variant)) } td.number { (format::significant(format::FORCE.of(variant.peak_force_n), 4)) } td.number { (variant.impact_count) } }
                    }
                }
            } }
            div.scroll { table {
                thead { tr {
                    th scope="col" { (message::changes_of_peaks_by_up()) }
                    @for (name, _) in changes() { th.number scope="col" { (name) br; span.unit { "[%]" } } }
                } }
                tbody {
                    @for building in &found.buildings {
                        tr {
                            th scope="row" { (building.name) }
                            @for (_, of) in changes() { td.number { (format::fixed(100.0 * of(building), 1)) } }
                        }
                    }
                }
            } }
            p.quiet { (message::changes_are_those_of_any()) }
        }
    })
}

/// A result with its range; values of this run, the least and the greatest.
fn row(name: &str, [result, least, greatest]: [f64; 3], text: impl Fn(f64) -> String) -> Markup {
    let share = |value: f64| {
        let share = if greatest > 0.0 {
            value / greatest
        } else {
            0.0
        };
        format!("{:.1}%", 100.0 * share.clamp(0.0, 1.0))
    };
    let width = if greatest > 0.0 {
        format!("{:.1}%", 100.0 * (greatest - least) / greatest)
    } else {
        "0%".into()
    };
    html! {
        tr {
            th scope="row" { (name) }
            td.number { (text(result)) } td.number { (text(least)) } td.number { (text(greatest)) }
            td { span.range aria-hidden="true" { i style=(format!("left:{};width:{width}", share(least))) {} b style=(format!("left:{}", share(result))) {} } }
        }
    }
}

fn named(name: &str, gap: &GapSpread, several: bool) -> String {
    if several {
        format!("{} ↔ {}, {name}", gap.between[0], gap.between[1])
    } else {
        name.to_owned()
    }
}

fn in_words(variant: &VariantResult) -> String {
    let one = variant.stiffnesses.len() == 1;
    match (
        variant.contact.stiffness,
        variant.contact.restitution_change,
    ) {
        (Some(_), _) if one => {
            message::stiffness_factor(format::plain(variant.stiffness_factor, 3))
        }
        (Some(RangeEnd::Low), _) => message::softest_advised_contacts().into(),
        (Some(RangeEnd::High), _) => message::stiffest_advised_contacts().into(),
        (None, change) if change < 0.0 => message::restitution_minus(format::plain(-change, 3)),
        (None, change) => message::restitution_plus(format::plain(change, 3)),
    }
}
