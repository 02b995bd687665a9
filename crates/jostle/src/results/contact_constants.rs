//! What constants of contact laws do to a run: faces that stay crushed, dashpots beyond critical damping.

use crate::contact::{ForceLaw, LawKind};
use crate::model::Model;
use crate::state::State;
use crate::system::System;

/// Gaps whose given dashpot is beyond critical damping at a contact: the index of the gap, and what that means.
#[must_use]
pub fn overdamped_contacts(model: &Model, system: &System) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (index, gap) in model.gaps.iter().enumerate() {
        if !matches!(gap.law.kind, LawKind::Dashpot(_)) {
            continue;
        }
        let contacts = system
            .contacts
            .iter()
            .filter(|contact| contact.gap == index);
        let ratios =
            contacts.filter_map(|contact| contact.law.damping_ratio(contact.effective_mass()));
        let ratio = ratios.fold(0.0, f64::max);
        if ratio >= 1.0 {
            found.push((
                index,
                format!(
                    "overdamps the lightest contact, ζ = {ratio:.2}: no coefficient of restitution corresponds to it, and the initial force of an impact is that of the dashpot alone; check its unit"
                ),
            ));
        }
    }
    found
}

/// How much wider gaps are because their faces are crushed, one line each.
pub(super) fn crushed_notes(model: &Model, system: &System, state: &State) -> Vec<String> {
    let mut notes = Vec::new();
    for (index, gap) in model.gaps.iter().enumerate() {
        let contacts = system.contacts.iter().enumerate();
        let contacts = contacts.filter(|(_, candidate)| candidate.gap == index);
        let crushes = contacts.filter(|(_, contact)| matches!(contact.law, ForceLaw::Crushing(_)));
        let depths = crushes.map(|(contact, _)| state.crushed_depth(contact));
        let deepest = depths.fold(0.0, f64::max);
        if deepest > 0.0 {
            let [left, right] = gap.between.map(|side| system.side_name(side));
            notes.push(format!(
                "faces between \"{left}\" and \"{right}\" are crushed by up to {:.2} mm at the end, which widens the gap; indentation is measured from the crushed face",
                1e3 * deepest
            ));
        }
    }
    notes
}
