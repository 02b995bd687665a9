//! What impacts dissipate.

use crate::numbers::{kn, mm};
use jostle::LawKind;
use jostle::contact::FreeCollision;
use jostle::interface::Contact;
use jostle::model::Gap;

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
        LawKind::Dashpot(own) => format!(
            "dashpot {:.3e} N.s/m, the same as restitution {}; free masses rebound with {free}",
            own.damping,
            range(&|contact: &Contact| contact.equivalent_restitution(&gap.law)),
        ),
        LawKind::BilinearGiven(own) => format!(
            "{:.3e} N/m beyond {} mm; the rebound of free masses depends on their speed",
            own.second_stiffness,
            mm(own.yield_indentation)
        ),
        LawKind::Crushing(own) => format!(
            "crushes from {} kN on, with {} of the stiffness, and stays crushed",
            kn(own.force),
            own.hardening
        ),
        LawKind::Formula(own) => {
            let rebound = range(&|contact: &Contact| {
                let [left, right] = contact.ports.masses();
                let collision = FreeCollision::new(&contact.law, left, right, SPEED);
                Some(collision.realised_restitution())
            });
            format!("F = {own}; at {SPEED} m/s free masses rebound with {rebound}")
        }
        _ => format!("free masses rebound with {free}"),
    }
}
