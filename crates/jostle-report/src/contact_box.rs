//! The contact data of a run beside what slabs and masses suggest.

use maud::{Markup, html};

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
    /// Restitution in use \[–\].
    pub restitution: f64,
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
    html! {
        @if !boxes.is_empty() {
            details.contact-advice {
                summary { "Contact stiffness and restitution: values used, and how far they are known" }
                div.scroll {
                    table {
                        thead { tr {
                            th scope="col" { "gap" }
                            th scope="col" { "law" }
                            th.number scope="col" { "stiffness used" br; span.unit { "[N/m^1.5 or N/m]" } }
                            th.number scope="col" { "Hertz, effective radius" br; span.unit { "[N/m^1.5]" } }
                            th.number scope="col" { "plausible range" br; span.unit { "[N/m^1.5]" } }
                            th.number scope="col" { "restitution used" }
                            th.number scope="col" { "plausible range" }
                            th.number scope="col" { "masses" br; span.unit { "[t]" } }
                            th.number scope="col" { "greatest impact speed" br; span.unit { "[m/s]" } }
                        } }
                        tbody {
                            @for row in boxes {
                                tr {
                                    th scope="row" { (row.between[0]) " – " (row.between[1]) }
                                    td { (row.law) }
                                    td.number { (power(row.stiffness)) }
                                    td.number { (power(row.hertz[0])) }
                                    td.number { (power(row.hertz[1])) " – " (power(row.hertz[2])) }
                                    td.number { (format::plain(row.restitution, 3)) }
                                    td.number { (format::plain(row.restitution_range[0], 2)) " – " (format::plain(row.restitution_range[1], 2)) }
                                    td.number {
                                        @for (side, mass) in row.masses.iter().enumerate() {
                                            @if side > 0 { " / " }
                                            (mass.map_or("wall".into(), |mass| format::significant(1e-3 * mass, 3)))
                                        }
                                    }
                                    td.number { (row.impact_speed.map_or(format::NOTHING.into(), |speed| format::significant(speed, 3))) }
                                }
                            }
                        }
                    }
                }
                p.quiet {
                    "Hertz: k = 4/[3π (h₁ + h₂)] √[R₁R₂/(R₁ + R₂)] with spheres of the masses of the floors (Goldsmith 1960; Muthukumar and DesRoches 2006), concrete of 30 GPa. "
                    "Peak forces grow with k^0.4; displacements hardly depend on it: "
                    code { "jostle run --sensitivity" } " repeats the run with half and twice the stiffness and restitution ± 0.15. "
                    code { "jostle contact-advice" } " adds the axial stiffness and the waves of slabs whose size is given."
                    @if boxes.iter().any(|row| !row.is_hertzian) {
                        " Stiffnesses in N/m and N/m^1.5 cannot be compared directly."
                    }
                }
            }
        }
    }
}

fn power(value: f64) -> String {
    format!("{value:.2e}")
}
