//! What impacts dissipate.

use crate::numbers::prefixed;
use jostle::LawKind;
use jostle::contact::FreeCollision;
use jostle::interface::Contact;
use jostle::model::Gap;
use jostle_io::shown::{self, FORCE, LENGTH};

/// Impact speed at which the rebound of a formula is computed \[m/s\].
const SPEED: f64 = 0.5;

/// What impacts of a gap dissipate, in words.
pub(super) fn losses(gap: &Gap, contacts: &[&Contact]) -> String {
    let range = |values: &dyn Fn(&Contact) -> Option<f64>| {
        let values = contacts.iter().filter_map(|contact| values(contact));
        let [least, most] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], e| {
            [a.min(e), b.max(e)]
        });
        match most - least {
            spread if spread > 5e-4 => format!("{least:.3} to {most:.3}"),
            _ => format!("{least:.3}"),
        }
    };
    let free = range(&|contact: &Contact| contact.free_restitution(&gap.law));
    match gap.law.kind {
        LawKind::Dashpot(dashpot) => format!(
            "dashpot {}, the same as restitution {}; free masses rebound with {free}",
            prefixed(dashpot.damping, "N·s/m", 4),
            range(&|contact: &Contact| contact.equivalent_restitution(&gap.law)),
        ),
        LawKind::BilinearGiven(kind) => format!(
            "{} beyond {}; the rebound of free masses depends on their speed",
            prefixed(kind.second_stiffness, "N/m", 4),
            LENGTH.text(kind.yield_indentation, 1)
        ),
        LawKind::Crushing(crushing) => format!(
            "crushes from {} on, with {} of its stiffness there, and stays crushed",
            FORCE.text(crushing.force, 1),
            crushing.hardening
        ),
        LawKind::Formula(formula) => {
            let rebound = range(&|contact: &Contact| {
                let [left, right] = contact.ports.masses();
                let collision = FreeCollision::new(&contact.law, left, right, SPEED);
                Some(collision.realised_restitution())
            });
            format!(
                "F = {formula}; at {} free masses rebound with {rebound}",
                shown::SPEED.text(SPEED, 1)
            )
        }
        _ => format!("free masses rebound with {free}"),
    }
}
