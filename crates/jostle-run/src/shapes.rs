//! Shapes of modal stepping, which runs of the same buildings share.

use std::sync::{Arc, OnceLock};

use jostle::stepping::{ContactSteps, modal};
use jostle::{Plan, Solver, System};

/// Shapes for modal stepping, found on first use. Clones share them. They belong to one system, for any widths of
/// its gaps.
#[derive(Clone, Default)]
pub struct SharedShapes(Arc<OnceLock<Option<Found>>>);

/// Shapes, and the steps that they were found for.
struct Found {
    contact_steps: ContactSteps,
    vertical: bool,
    reduction: Arc<modal::Reduction>,
}

impl SharedShapes {
    /// The shapes of a system that modal stepping uses, if the plan uses it and they exist.
    #[must_use]
    pub fn find(&self, system: &System, plan: &Plan) -> Option<Arc<modal::Reduction>> {
        if plan.solver != Solver::Modal {
            return None;
        }
        let found = self.0.get_or_init(|| {
            let reduction = modal::Reduction::new(system, plan).ok()?;
            Some(Found {
                contact_steps: plan.contact_steps,
                vertical: plan.vertical,
                reduction: Arc::new(reduction),
            })
        });
        let found = found.as_ref()?;
        let same = found.contact_steps == plan.contact_steps && found.vertical == plan.vertical;
        same.then(|| Arc::clone(&found.reduction))
    }
}
