//! The contact data of a run beside what slabs and masses suggest.

use maud::{Markup, html};

use crate::message;
use crate::{Page, format};

/// Contact data of a gap and the values that masses and impact speeds suggest.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactBox {
    /// Names of the neighbours.
    pub between: [String; 2],
    /// Contact law.
    pub law: String,
    /// Whether its stiffness is that of Hertz.
    pub is_hertzian: bool,
    /// Stiffness in use \[N/m^1.5 or N/m\].
    pub stiffness: f64,
    /// Restitution in use; `None` where constants stand in its place \[–\].
    pub restitution: Option<f64>,
    /// Stiffness by Hertz's formula with the effective radius, and its plausible range \[N/m^1.5\].
    pub hertz: [f64; 3],
    /// Plausible range of the restitution \[–\].
    pub restitution_range: [f64; 2],
    /// Colliding masses; `None` is a wall \[kg\].
    pub masses: [Option<f64>; 2],
    /// Greatest impact speed of the run; `None` without an impact \[m/s\].
    pub impact_speed: Option<f64>,
}

/// One line for each gap.
pub(crate) fn contact_boxes(page: &Page) -> Markup {
    let boxes = page.contacts;
    // Linear stiffnesses have nothing to compare in Hertz's columns.
    let has_hertz = boxes.iter().any(|row| row.is_hertzian);
    html! {
        @if !boxes.is_empty() {
            details.contact-advice {
                summary { (message::contact_stiffness_and_restitution_values()) }
                div.scroll {
                    table {
                        thead { tr {
                            th scope="col" { (message::gap()) }
                            th scope="col" { (message::law()) }
                            th.number scope="col" { (message::stiffness_used()) }
                            @if has_hertz {
                                th.number scope="col" { (message::hertz_effective_radius()) br; span.unit { (format::HERTZ_STIFFNESS.bracketed()) } }
                                th.number scope="col" { (message::plausible_range()) br; span.unit { (format::HERTZ_STIFFNESS.bracketed()) } }
                            }
                            th.number scope="col" { (message::restitution_used()) }
                            th.number scope="col" { (message::plausible_range()) }
                            th.number scope="col" { (message::masses()) br; span.unit { (format::MASS.bracketed()) } }
                            th.number scope="col" { (message::greatest_impact_speed()) br; span.unit { (format::SPEED.bracketed()) } }
                        } }
                        tbody {
                            @for row in boxes {
                                tr {
                                    th scope="row" { (row.between[0]) " ↔ " (row.between[1]) }
                                    td { (row.law) }
                                    td.number { (stiffness_used(row)) }
                                    @if row.is_hertzian {
                                        td.number { (power(row.hertz[0])) }
                                        td.number { (power(row.hertz[1])) " – " (power(row.hertz[2])) }
                                    } @else if has_hertz {
                                        td.number { (format::NOTHING) }
                                        td.number { (format::NOTHING) }
                                    }
                                    td.number { (row.restitution.map_or(format::NOTHING.into(), |e| format::plain(e, 3))) }
                                    td.number { (format::plain(row.restitution_range[0], 2)) " – " (format::plain(row.restitution_range[1], 2)) }
                                    td.number {
                                        @for (side, mass) in row.masses.iter().enumerate() {
                                            @if side > 0 { " / " }
                                            (mass.map_or(message::wall().into(), |mass| format::significant(format::MASS.of(mass), 3)))
                                        }
                                    }
                                    td.number { (row.impact_speed.map_or(format::NOTHING.into(), |speed| format::significant(format::SPEED.of(speed), 3))) }
                                }
                            }
                        }
                    }
                }
                p.quiet {
                    @if has_hertz { (message::hertz_k_4_3_h(format::MODULUS.text(30e9, 0))) " " }
                    code { "jostle run --sensitivity" } " " (message::repeats_the_run_with_half()) " "
                    code { "jostle contact-advice" } " " (message::adds_the_axial_stiffness())
                }
            }
        }
    }
}

fn stiffness_used(row: &ContactBox) -> String {
    match row.is_hertzian {
        true => format!(
            "{} {}",
            power(row.stiffness),
            format::HERTZ_STIFFNESS.name()
        ),
        false => format::stiffness(row.stiffness),
    }
}

fn power(value: f64) -> String {
    format::significant(format::HERTZ_STIFFNESS.of(value), 3)
}
