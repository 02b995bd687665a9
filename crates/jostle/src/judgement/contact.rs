//! A7 and A8: stiffness and restitution of contacts.

use super::{Known, Tally, sides};
use crate::contact::{LawKind, RestitutionIs, SlabMaterial, StiffnessRange, advised_range};
use crate::model::Gap;
use crate::system::System;

/// Range of the contact stiffness of a gap between bare floors, for its pair of floors with the greatest effective mass; `None` for
/// laws of bumpers and of velocities, and for stiffnesses per length of a face \[N/m^1.5 or N/m\].
#[must_use]
pub fn advised_stiffness(system: &System, index: usize, gap: &Gap) -> Option<StiffnessRange> {
    let contacts = system
        .contacts
        .iter()
        .filter(|contact| contact.gap == index);
    let heaviest = contacts.max_by(|a, b| a.effective_mass().total_cmp(&b.effective_mass()));
    let contact = heaviest.filter(|_| !gap.in_plan.per_length)?;
    let materials = [SlabMaterial::default(); 2];
    advised_range(gap.law.kind, materials, contact.struck_masses())
}

/// Contact stiffness over the end of the advised range that it is beyond; 1 within.
pub(super) fn contact_stiffness(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, gap) in known.model.gaps.iter().enumerate() {
        let Some(range) = advised_stiffness(known.system, index, gap) else {
            continue;
        };
        let stiffness = gap.law.stiffness;
        let ratio = if stiffness < range.low {
            stiffness / range.low
        } else {
            (stiffness / range.high).max(1.0)
        };
        tally.add(ratio, || {
            let place = sides(known, index);
            let unit = match gap.law.kind.is_hertzian() {
                true => "N/m^1.5",
                false => "N/m",
            };
            let text = format!(
                "{place}: the contact stiffness of {stiffness:.2e} {unit} is outside {:.1e} to {:.1e} {unit}, the range for these masses",
                range.low, range.high
            );
            (place, text)
        });
    }
}

/// Difference between the restitution of free masses and the one that the model states.
pub(super) fn restitution(known: &Known<'_>, tally: &mut Tally<'_>) {
    for (index, law) in known.model.gaps.iter().map(|gap| &gap.law).enumerate() {
        if law.restitution_is != RestitutionIs::Input || !law.kind.has_published_damping() {
            continue;
        }
        let Some(free) = law.free_restitution() else {
            continue;
        };
        let asked = law.restitution;
        tally.add((free - asked).abs(), || {
            let place = sides(known, index);
            let text = format!(
                "{place}: the published {} formula with e = {asked}: free masses rebound with {free:.3}",
                law.kind.name()
            );
            (place, text)
        });
    }
}

/// Whether a law stands for bare concrete that hardly indents.
pub(super) fn is_bare(kind: LawKind) -> bool {
    !matches!(
        kind,
        LawKind::Rubber(_) | LawKind::Crushing(_) | LawKind::Formula(_)
    )
}
