//! The assembled buildings and contacts: immutable, shared by every run of the same model.

use crate::check::LEVEL_TOLERANCE;
use crate::contact::{ForceLaw, effective_mass};
use crate::equations::Equations;
use crate::hysteresis::HysteresisMemory;
use crate::modal::{self, Mode};
use crate::model::{Building, Damping, FloorPairs, Gap, Model, ModelFault};
use crate::skeleton::Idealisation;
use crate::state::State;

/// Buildings in a row and the contacts between them, ready to be stepped.
#[derive(Clone, Debug)]
pub struct System {
    /// Buildings from left to right.
    pub buildings: Vec<BuildingSystem>,
    /// Contacts, gap by gap, from the lowest up.
    pub contacts: Vec<Contact>,
}

/// One assembled building.
#[derive(Clone, Debug)]
pub struct BuildingSystem {
    /// Name.
    pub name: String,
    /// Lumped masses and massless elements.
    pub idealisation: Idealisation,
    /// Mass, damping and stiffness.
    pub equations: Equations,
    /// First degree of freedom of this building in the vectors of a [`crate::State`].
    pub offset: usize,
    /// Floors from the ground up.
    pub floors: Vec<Floor>,
    /// Displacements under self weight, from which a run starts; empty where weight is left out \[m, rad\].
    pub rest: Vec<f64>,
    /// What springs that yield remember then.
    pub rest_springs: Vec<HysteresisMemory>,
    /// First spring that yields of this building in the list of a [`crate::State`].
    pub spring_offset: usize,
    /// Degree of freedom of the foot of the first column line in the vectors of a [`crate::State`], where the base
    /// gives way sideways.
    pub foot: Option<usize>,
    /// Lateral modes, longest period first; empty when the building can move without deforming.
    /// [`modal::modes`] finds those of all kinds.
    pub modes: Vec<Mode>,
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

/// A place where two neighbouring buildings can touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of the gap in the model.
    pub gap: usize,
    /// Left and right building.
    pub buildings: [usize; 2],
    /// Degrees of freedom of the left and the right face in the vectors of a [`crate::State`].
    pub dofs: [usize; 2],
    /// Left and right floor, from 1; `None` for a lumped mass between floors.
    pub floors: [Option<usize>; 2],
    /// Height above the base \[m\].
    pub height: f64,
    /// Gap at rest \[m\].
    pub width: f64,
    /// Masses that the contact moves on the left and on the right \[kg\].
    pub masses: [f64; 2],
    /// Force law.
    pub law: ForceLaw,
}

impl Contact {
    /// m₁m₂/(m₁ + m₂) of the two faces \[kg\].
    #[must_use]
    pub fn effective_mass(&self) -> f64 {
        effective_mass(self.masses[0], self.masses[1])
    }
}

impl System {
    /// Assembles a model.
    ///
    /// # Errors
    /// All faults of the model, as [`Model::check`] finds them, or what only assembly shows: damping at modes
    /// that do not exist, contacts at points without mass.
    pub fn assemble(model: &Model) -> Result<Self, Vec<ModelFault>> {
        model.check()?;
        let mut buildings = Vec::new();
        let mut faults = Vec::new();
        for (index, building) in model.buildings.iter().enumerate() {
            let mut assembled = BuildingSystem::new(&building.name, Idealisation::of(building));
            if let Err(problem) = assembled.put_under_gravity(building.gravity) {
                faults.push(ModelFault {
                    path: format!("building[{index}].{}", problem.field()),
                    problem: problem.to_string(),
                });
                continue;
            }
            if let Err(problem) = assembled.damp(&building.damping) {
                faults.push(ModelFault {
                    path: format!("building[{index}].damping.modes"),
                    problem,
                });
            }
            buildings.push(assembled);
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let mut system = Self::of_buildings(buildings);
        for (index, gap) in model.gaps.iter().enumerate() {
            system.add_contacts(index, gap, &model.buildings, &mut faults);
        }
        if faults.is_empty() {
            Ok(system)
        } else {
            Err(faults)
        }
    }

    /// A row of assembled buildings that do not touch; contacts may be added to the list.
    #[must_use]
    pub fn of_buildings(mut buildings: Vec<BuildingSystem>) -> Self {
        let (mut offset, mut spring_offset) = (0, 0);
        for building in &mut buildings {
            building.spring_offset = spring_offset;
            spring_offset += building.equations.springs.len();
            for floor in &mut building.floors {
                floor.dof = floor.dof - building.offset + offset;
            }
            building.foot = building.foot.map(|dof| dof - building.offset + offset);
            building.offset = offset;
            offset += building.equations.len();
        }
        Self {
            buildings,
            contacts: Vec::new(),
        }
    }

    /// Number of degrees of freedom of all buildings.
    #[must_use]
    pub fn len(&self) -> usize {
        self.buildings
            .last()
            .map_or(0, |building| building.offset + building.equations.len())
    }

    /// Whether there is nothing to move.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A contact between nodes of two buildings, `left` and `right` being (building, node).
    ///
    /// # Errors
    /// A message when a node cannot be pushed or carries no mass.
    pub fn contact_between(
        &self,
        left: (usize, usize),
        right: (usize, usize),
    ) -> Result<Contact, String> {
        let face = |(building, node): (usize, usize)| {
            let equations = &self.buildings[building].equations;
            let dof = equations
                .horizontal(node)
                .ok_or_else(|| "a contact cannot push the ground".to_owned())?;
            let mass = equations.mass[dof];
            if mass > 0.0 {
                Ok((self.buildings[building].offset + dof, mass))
            } else {
                Err(format!(
                    "\"{}\" has no mass where it would be hit",
                    self.buildings[building].name
                ))
            }
        };
        let ((left_dof, left_mass), (right_dof, right_mass)) = (face(left)?, face(right)?);
        let floor = |(building, node): (usize, usize)| {
            let height = self.buildings[building].idealisation.skeleton.nodes[node].y;
            let floors = &self.buildings[building].floors;
            floors
                .iter()
                .position(|floor| (floor.height - height).abs() <= LEVEL_TOLERANCE)
                .map(|index| index + 1)
        };
        Ok(Contact {
            gap: 0,
            buildings: [left.0, right.0],
            dofs: [left_dof, right_dof],
            floors: [floor(left), floor(right)],
            height: self.buildings[left.0].idealisation.skeleton.nodes[left.1].y,
            width: 0.0,
            masses: [left_mass, right_mass],
            law: ForceLaw::Hertz {
                stiffness: 0.0,
                damping: 0.0,
            },
        })
    }

    fn add_contacts(
        &mut self,
        index: usize,
        gap: &Gap,
        buildings: &[Building],
        faults: &mut Vec<ModelFault>,
    ) {
        let (left, right) = (gap.left, gap.left + 1);
        let (left_heights, right_heights) = (
            buildings[left].floor_heights(),
            buildings[right].floor_heights(),
        );
        let level = |a: f64, b: f64| (a - b).abs() <= LEVEL_TOLERANCE;
        let mut heights: Vec<f64> = match &gap.floors {
            FloorPairs::Common => left_heights
                .iter()
                .copied()
                .filter(|a| right_heights.iter().any(|b| level(*a, *b)))
                .collect(),
            FloorPairs::Listed(pairs) => pairs
                .iter()
                .map(|(floor, _)| left_heights[floor - 1])
                .collect(),
            FloorPairs::Heights(heights) => heights.clone(),
        };
        heights.sort_by(f64::total_cmp);
        for height in heights {
            let node = |building: usize, face: fn(&Idealisation) -> &Vec<usize>| {
                let idealisation = &self.buildings[building].idealisation;
                face(idealisation)
                    .iter()
                    .copied()
                    .find(|&node| level(idealisation.skeleton.nodes[node].y, height))
            };
            let contact = match (node(left, |i| &i.right_face), node(right, |i| &i.left_face)) {
                (Some(a), Some(b)) => self.contact_between((left, a), (right, b)),
                _ => Err(format!("no point to hit at {height:.3} m")),
            };
            match contact {
                Ok(contact) => {
                    let law = gap.law.between(contact.masses[0], contact.masses[1]);
                    self.contacts.push(Contact {
                        gap: index,
                        width: gap.width,
                        law,
                        ..contact
                    });
                }
                Err(problem) => faults.push(ModelFault {
                    path: format!("gap[{index}].floors"),
                    problem,
                }),
            }
        }
    }
}

impl BuildingSystem {
    /// Assembles the equations of an idealised building, without damping.
    #[must_use]
    pub fn new(name: &str, idealisation: Idealisation) -> Self {
        let equations = Equations::assemble(&idealisation.skeleton);
        let mut below = 0.0;
        let mut floors = Vec::new();
        for &node in &idealisation.floors {
            let height = idealisation.skeleton.nodes[node].y;
            if let Some(dof) = equations.horizontal(node) {
                floors.push(Floor {
                    dof,
                    height,
                    storey_height: height - below,
                });
            }
            below = height;
        }
        let foot = idealisation
            .foot
            .and_then(|node| equations.horizontal(node));
        let mut building = Self {
            name: name.to_owned(),
            idealisation,
            equations,
            offset: 0,
            foot,
            floors,
            rest: Vec::new(),
            rest_springs: Vec::new(),
            spring_offset: 0,
            modes: Vec::new(),
        };
        building.modes = modal::lateral_modes(&building).unwrap_or_default();
        building
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
        (self.equations.alpha, self.equations.beta) = match damping {
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
                let usual: &[usize] = match lateral.len() {
                    0 | 1 => &[1],
                    2 => &[1, 2],
                    _ => &[1, 3],
                };
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
        Ok(())
    }

    /// Elastic and hysteretic base shear, positive when the building leans to the right \[N\].
    #[must_use]
    pub fn base_shear(&self, state: &State) -> f64 {
        let elastic = self.equations.base_shear(&state.displacement[self.range()]);
        let springs = self.equations.springs.iter();
        let yielding = springs
            .zip(&state.springs[self.spring_range()])
            .filter(|(spring, _)| spring.carries_base_shear)
            .map(|(_, memory)| memory.force());
        elastic + yielding.sum::<f64>()
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
