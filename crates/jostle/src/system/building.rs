//! One building of a system.

use std::ops::Deref;
use std::sync::Arc;

use crate::eigen::{Mode, lateral_modes_along};
use crate::model::{Damping, Gravity, usual_damping_modes};
use crate::statics::{Collapse, Settled, under_gravity};
use crate::structure::{AssembledBuilding, Discretization, MemberForces};
use crate::transfer::riccati::RiccatiSweep;

/// One building of a system: its equations, and where they stand among those of the others.
///
/// Dereferences to the [`AssembledBuilding`], so that its fields read as those of the building.
#[derive(Clone, Debug)]
pub struct BuildingSystem {
    /// Masses, elements and matrices.
    pub structure: AssembledBuilding,
    /// First degree of freedom of this building in the vectors of a [`crate::State`].
    pub offset: usize,
    /// Floors from the ground up.
    pub floors: Vec<Floor>,
    /// Displacements and springs under self weight, from which a run starts; empty where weight is left out.
    pub rest: Settled,
    /// First spring that yields of this building in the list of a [`crate::State`].
    pub spring_offset: usize,
    /// Degree of freedom of the foot of the first column line in the vectors of a [`crate::State`], where the base
    /// gives way sideways.
    pub foot: Option<usize>,
    /// The ratio of critical damping that all modes have, where damping is not Rayleigh's \[–\].
    pub modal_damping: Option<f64>,
    /// Lateral modes, longest period first; empty when the building can move without deforming.
    /// [`crate::eigen::modes`] finds those of all kinds.
    pub modes: Vec<Mode>,
    /// How forces of columns and beams follow from the motion; empty unless they are asked for.
    pub members: MemberForces,
    /// The recursion through its equations, shared by all runs.
    pub(crate) sweep: Arc<RiccatiSweep>,
}

/// A floor of a building.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// Its degree of freedom in the vectors of a [`crate::State`].
    pub dof: usize,
    /// Height above the base \[m\].
    pub height: f64,
    /// Height of the storey below \[m\].
    pub storey_height: f64,
}

impl Deref for BuildingSystem {
    type Target = AssembledBuilding;

    #[inline]
    fn deref(&self) -> &AssembledBuilding {
        &self.structure
    }
}

impl BuildingSystem {
    /// Assembles a discretized building, without damping.
    #[must_use]
    pub fn new(name: &str, discretization: Discretization) -> Self {
        Self::from_assembled(AssembledBuilding::new(name, discretization))
    }

    fn from_assembled(structure: AssembledBuilding) -> Self {
        let sweep = RiccatiSweep::through(&structure.equations);
        let Discretization {
            stick_model,
            floors,
            ..
        } = &structure.discretization;
        let mut below = 0.0;
        let floors = floors.iter().filter_map(|&node| {
            let height = stick_model.nodes[node].y;
            let storey_height = height - std::mem::replace(&mut below, height);
            Some(Floor {
                dof: structure.equations.horizontal(node)?,
                height,
                storey_height,
            })
        });
        let floors = floors.collect();
        let foot = structure.discretization.foot;
        let foot = foot.and_then(|node| structure.equations.horizontal(node));
        let modes = lateral_modes_along(&structure, &sweep).unwrap_or_default();
        Self {
            structure,
            offset: 0,
            foot,
            floors,
            rest: Settled::default(),
            spring_offset: 0,
            modal_damping: None,
            modes,
            members: MemberForces::default(),
            sweep: Arc::new(sweep),
        }
    }

    /// Adds P-Delta and sets the displacements under self weight, as far as each is asked for.
    ///
    /// # Errors
    /// [`Collapse`]; the building is then as it was.
    pub fn put_under_gravity(&mut self, gravity: Gravity) -> Result<(), Collapse> {
        if !gravity.p_delta && !gravity.preload {
            return Ok(());
        }
        let (leaning, rest) = under_gravity(&self.structure, gravity)?;
        if let Some(leaning) = leaning {
            *self = Self::from_assembled(leaning);
        }
        self.rest = rest;
        Ok(())
    }

    /// Lateral modes, longest period first.
    pub fn lateral_modes(&self) -> impl Iterator<Item = &Mode> {
        self.modes.iter().filter(|mode| mode.is_lateral())
    }

    /// Sets the Rayleigh damping (theory, Eq. D1).
    ///
    /// # Errors
    /// A message when a lateral mode of that number does not exist.
    pub fn damp(&mut self, damping: &Damping) -> Result<(), String> {
        self.modal_damping = match damping {
            Damping::AllModes { ratio } => Some(*ratio),
            _ => None,
        };
        let (alpha, beta) = match damping {
            Damping::AllModes { .. } => (0.0, 0.0),
            Damping::Rayleigh { alpha, beta } => (*alpha, *beta),
            Damping::Ratio { ratio, modes } => {
                let lateral: Vec<f64> = self
                    .lateral_modes()
                    .map(|mode| mode.circular_frequency)
                    .collect();
                let frequency = |number: &usize| {
                    lateral.get(number - 1).copied().ok_or_else(|| {
                        format!(
                            "lateral mode {number} does not exist: \"{}\" has {} lateral modes",
                            self.name,
                            lateral.len()
                        )
                    })
                };
                let usual = usual_damping_modes(lateral.len());
                let modes = if modes.is_empty() { usual } else { modes };
                match modes.iter().map(frequency).collect::<Result<Vec<_>, _>>()?[..] {
                    [single] => (2.0 * ratio * single, 0.0),
                    [low, high] => (
                        2.0 * ratio * low * high / (low + high),
                        2.0 * ratio / (low + high),
                    ),
                    _ => return Err("damping takes one or two modes".to_owned()),
                }
            }
        };
        let equations = &mut self.structure.equations;
        (equations.alpha, equations.beta) = (alpha, beta);
        Ok(())
    }

    /// Springs that yield of this building in the list of a [`crate::State`].
    #[must_use]
    pub fn spring_range(&self) -> std::ops::Range<usize> {
        self.spring_offset..self.spring_offset + self.equations.springs.len()
    }

    /// Degrees of freedom of this building in the vectors of a [`crate::State`].
    #[must_use]
    pub fn range(&self) -> std::ops::Range<usize> {
        self.offset..self.offset + self.equations.len()
    }
}
