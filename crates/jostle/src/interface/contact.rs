//! A place where two buildings, or a building and a wall, can touch.

use super::PortPair;
use super::friction::Friction;
use super::plan_contacts::{PlanContactKind, PlanPart};
use crate::contact::{ContactLaw, ForceLaw, LawKind};
use crate::model::PlanPoint;

/// A place where two neighbouring buildings, or a building and a wall, can touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Index of the gap in the model.
    pub gap: usize,
    /// The two faces.
    pub ports: PortPair,
    /// Height above the base \[m\].
    pub height: f64,
    /// Gap at rest, under self weight where it acts \[m\].
    pub width: f64,
    /// What self weight alone closes; displacements count from the unloaded structure \[m\].
    pub closing_at_rest: f64,
    /// Force law.
    pub law: ForceLaw,
    /// Where it is in plan; `None` in one plane.
    pub plan: Option<PlanPlace>,
    /// Friction along the face; `None` without.
    pub friction: Option<Friction>,
}

/// A point of a face, or a corner, in plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanPlace {
    /// Face or corner.
    pub kind: PlanContactKind,
    /// What touches, of the first building and of the second.
    pub parts: [PlanPart; 2],
    /// Number of the face among all of the system, from 0.
    pub face: usize,
    /// Place on the site, midway across the gap \[m\].
    pub at: PlanPoint,
    /// Unit normal from the first building to the second.
    pub normal: PlanPoint,
    /// Length of the face; zero for a corner \[m\].
    pub overlap: f64,
    /// Share of the stiffness of the face \[–\].
    pub share: f64,
}

impl Contact {
    /// Masses that meet, those of whole faces in plan; infinite for a rigid wall \[kg\].
    #[must_use]
    pub fn struck_masses(&self) -> [f64; 2] {
        // Points of a face share its mass.
        let share = self.plan.map_or(1.0, |place| place.share);
        self.ports.masses().map(|mass| mass / share)
    }

    /// m₁m₂/(m₁ + m₂) of the two faces \[kg\].
    #[must_use]
    pub fn effective_mass(&self) -> f64 {
        self.ports.effective_mass()
    }

    /// Separation ÷ impact speed of two free masses of its size, under the law of its gap; `None` where it depends on the
    /// impact speed \[–\].
    #[must_use]
    pub fn free_restitution(&self, law: &ContactLaw) -> Option<f64> {
        match law.kind {
            LawKind::Dashpot(dashpot) => {
                let ratio = self.law.damping_ratio(self.effective_mass())?;
                Some(dashpot.law.free_restitution(ratio))
            }
            _ => law.free_restitution(),
        }
    }

    /// The coefficient of restitution whose published formula gives its dashpot; `None` if the law of its gap has no
    /// given one \[–\].
    #[must_use]
    pub fn equivalent_restitution(&self, law: &ContactLaw) -> Option<f64> {
        let LawKind::Dashpot(dashpot) = law.kind else {
            return None;
        };
        let ratio = self.law.damping_ratio(self.effective_mass())?;
        Some(dashpot.law.equivalent_restitution(ratio))
    }

    /// Closing of displacements from the unloaded structure at which it touches \[m\].
    #[must_use]
    pub fn touches_at(&self) -> f64 {
        self.width + self.closing_at_rest
    }

    /// Whether a side lies on a column between floors.
    #[must_use]
    pub fn is_between_floors(&self) -> bool {
        self.ports.are_between_floors()
    }

    /// A contact without width whose law is still to be given.
    #[must_use]
    pub fn without_law(ports: PortPair) -> Self {
        Self {
            gap: 0,
            height: ports.height(),
            ports,
            width: 0.0,
            closing_at_rest: 0.0,
            law: ForceLaw::Hertz {
                stiffness: 0.0,
                damping: 0.0,
            },
            plan: None,
            friction: None,
        }
    }
}
