//! Friction beyond what makes the forces of a step unique.

use crate::interface::Contact;
use crate::model::Model;
use crate::system::System;

/// Gaps whose friction may have several solutions at a contact, one line each (theory, Eq. Z17).
#[must_use]
pub fn friction_warnings(model: &Model, system: &System) -> Vec<String> {
    let mut warnings = Vec::new();
    for (index, gap) in model.gaps.iter().enumerate() {
        let contacts = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index);
        let limits = contacts.filter_map(|contact| Some((contact.friction.as_ref()?, contact)));
        let least = limits.min_by(|(a, _), (b, _)| a.unique_below.total_cmp(&b.unique_below));
        let Some((friction, contact)) = least else {
            continue;
        };
        let (given, limit) = (friction.law.coefficient, friction.unique_below);
        if given < limit {
            continue;
        }
        let [left, right] = gap.between.map(|side| system.side_name(side));
        warnings.push(format!(
            "friction {given} between \"{left}\" and \"{right}\" does not determine the forces: {} they are unique only below {limit:.2}, since friction there turns the floors into each other; use friction = {:.2} or less, or correct polar_mass, mass_centre or the plans",
            place(contact),
            rounded_down(limit)
        ));
    }
    warnings
}

fn place(contact: &Contact) -> String {
    let floors = match contact.ports.floors() {
        [Some(left), Some(right)] if left != right => format!("at floors {left} and {right}"),
        [one, other] => one
            .or(other)
            .map_or(String::new(), |floor| format!("at floor {floor}")),
    };
    match contact.plan {
        Some(plan) => format!(
            "{floors}, x = {:.2} m, y = {:.2} m,",
            plan.at[0], plan.at[1]
        ),
        None => floors,
    }
}

/// The greatest coefficient with two decimals that is below a limit \[–\].
fn rounded_down(limit: f64) -> f64 {
    ((100.0 * limit).ceil() - 1.0).max(0.0) / 100.0
}

#[cfg(test)]
mod tests {
    use super::rounded_down;

    #[test]
    fn the_remedy_is_below_the_limit() {
        assert_eq!(rounded_down(0.25), 0.24);
        assert_eq!(rounded_down(0.257), 0.25);
        assert_eq!(rounded_down(0.004), 0.0);
    }
}
