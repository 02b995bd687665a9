//! The assembled buildings and contacts: immutable, shared by every run of the same model.

use std::sync::Arc;

use crate::contact::ForceLaw;
use crate::equations::Equations;
use crate::faces::{Face, Faces};
use crate::finite;
use crate::hysteresis::HysteresisMemory;
use crate::modal::{self, Mode};
use crate::model::{Damping, LEVEL_TOLERANCE, Model, ModelFault, usual_damping_modes};
use crate::row::Row;
use crate::skeleton::Idealisation;
use crate::state::State;
use crate::storey_forces::{StoreyForce, StoreyForces};
use crate::transfer::riccati::RiccatiSweep;

/// Buildings in a row with contacts and links, ready for time stepping.
///
/// ```
/// use jostle::{State, System};
/// # mod towers { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/two_towers/pair.rs")); }
/// # use towers::pair;
///
/// let model = pair(0.02); // two towers of three storeys, 20 mm apart
/// let system = System::assemble(&model).map_err(|faults| faults[0].clone())?;
/// assert_eq!(system.contacts.len(), 3); // floors at equal height
/// let state = State::at_rest(&system, 0.0);
/// assert!(state.displacement.iter().all(|&u| u == 0.0));
/// # Ok::<(), jostle::ModelFault>(())
/// ```
#[derive(Clone, Debug)]
pub struct System {
    /// Buildings from left to right.
    pub buildings: Vec<BuildingSystem>,
    /// Contacts, gap by gap, from the lowest up.
    pub contacts: Vec<Contact>,
    /// Springs and dashpots between buildings, link by link, from the lowest up.
    pub links: Vec<LinkElement>,
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
    /// How storey shears and overturning moments follow from displacements.
    pub storeys: StoreyForces,
    /// Displacements under self weight, from which a run starts; empty without self weight \[m, rad\].
    pub rest: Vec<f64>,
    /// State of yielding springs at rest.
    pub rest_springs: Vec<HysteresisMemory>,
    /// First spring that yields of this building in the list of a [`crate::State`].
    pub spring_offset: usize,
    /// Degree of freedom of the foot of the first column line in the vectors of a [`crate::State`], if the base has
    /// a horizontal spring.
    pub foot: Option<usize>,
    /// The damping ratio of all modes, if damping is not of the Rayleigh type \[–\].
    pub modal_damping: Option<f64>,
    /// Lateral modes, longest period first; empty when the building can move without deforming.
    /// [`modal::modes`] finds those of all kinds.
    pub modes: Vec<Mode>,
    /// The recursion of the building as assembled, before P-Delta.
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

/// A contact between two neighbouring buildings, or a building and a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of the gap in the model.
    pub gap: usize,
    /// The two points.
    pub faces: Faces,
    /// Height above the base \[m\].
    pub height: f64,
    /// Gap at rest \[m\].
    pub width: f64,
    /// Force law.
    pub law: ForceLaw,
}

impl Contact {
    /// m₁m₂/(m₁ + m₂) of the two points \[kg\].
    #[must_use]
    pub fn effective_mass(&self) -> f64 {
        self.faces.effective_mass()
    }
}

/// A linear spring and dashpot between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkElement {
    /// Index of the link in the model.
    pub link: usize,
    /// Its two ends.
    pub faces: Faces,
    /// Height above the base \[m\].
    pub height: f64,
    /// Force per shortening, ≥ 0 \[N/m\].
    pub stiffness: f64,
    /// Force per rate of shortening, ≥ 0 \[N·s/m\].
    pub damping: f64,
    /// Closing of its ends at zero force \[m\].
    pub closing_at_rest: f64,
}

impl LinkElement {
    /// Shortening since the state at rest \[m\].
    #[must_use]
    #[inline]
    pub fn shortening(&self, displacement: &[f64]) -> f64 {
        self.faces.closing(displacement) - self.closing_at_rest
    }

    /// Compression \[N\].
    #[must_use]
    #[inline]
    pub fn force(&self, shortening: f64, rate: f64) -> f64 {
        self.stiffness * shortening + self.damping * rate
    }

    /// Energy of the spring \[J\].
    #[must_use]
    #[inline]
    pub fn strain(&self, shortening: f64) -> f64 {
        0.5 * self.stiffness * shortening * shortening
    }
}

impl System {
    /// Assembles a model.
    ///
    /// # Errors
    /// All faults of the model, as found by [`Model::check`], or faults found in assembly: damping at modes that do
    /// not exist, contacts at points without mass, periods and durations that are not finite.
    pub fn assemble(model: &Model) -> Result<Self, Vec<ModelFault>> {
        model.check()?;
        let row = Row::of(model);
        let mut buildings = Vec::new();
        let mut faults = Vec::new();
        for (index, building) in model.buildings.iter().enumerate() {
            let points = row.points_between_floors(index);
            let idealisation =
                Idealisation::with_points(building, points.each_ref().map(|points| &points[..]));
            let mut assembled = BuildingSystem::new(&building.name, idealisation);
            if let Err(problem) = assembled.put_under_gravity(building.gravity) {
                faults.push(ModelFault {
                    path: format!("building[{index}].{}", problem.field()),
                    problem: problem.to_string(),
                });
                continue;
            }
            if let Some(fault) = finite::of_building(index, building, &assembled) {
                faults.push(fault);
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
        row.put_into(&mut system, model)?;
        let faults = finite::of_contacts(&system);
        if faults.is_empty() {
            Ok(system)
        } else {
            Err(faults)
        }
    }

    /// The same buildings with the gaps of another model, which may differ from that of this system in the widths
    /// of its gaps only: nothing is assembled again.
    ///
    /// # Errors
    /// As [`System::assemble`].
    pub fn with_widths_of(&self, model: &Model) -> Result<Self, Vec<ModelFault>> {
        model.check()?;
        let mut system = Self {
            buildings: self.buildings.clone(),
            contacts: Vec::new(),
            links: Vec::new(),
        };
        Row::of(model).put_into(&mut system, model).map(|()| system)
    }

    /// A row of assembled buildings without contacts; contacts may be added to the list.
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
            links: Vec::new(),
        }
    }

    /// Number of degrees of freedom of all buildings.
    #[must_use]
    pub fn len(&self) -> usize {
        self.buildings
            .last()
            .map_or(0, |building| building.offset + building.equations.len())
    }

    /// Whether there are no degrees of freedom.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A contact without width between nodes of two buildings, `left` and `right` being (building, node). Its law
    /// must be set.
    ///
    /// # Errors
    /// A message if a node has no horizontal degree of freedom or no mass.
    pub fn contact_between(
        &self,
        left: (usize, usize),
        right: (usize, usize),
    ) -> Result<Contact, String> {
        let faces = Faces([
            Some(self.face(left.0, left.1)?),
            Some(self.face(right.0, right.1)?),
        ]);
        Ok(Contact::without_law(faces))
    }

    /// The point of a building at a node.
    ///
    /// # Errors
    /// A message if the node has no horizontal degree of freedom or no mass.
    pub fn face(&self, building: usize, node: usize) -> Result<Face, String> {
        let own = &self.buildings[building];
        let dof = own
            .equations
            .horizontal(node)
            .ok_or_else(|| "a contact cannot push the ground".to_owned())?;
        let mass = own.equations.mass[dof];
        if mass <= 0.0 {
            return Err(format!(
                "\"{}\" has no mass where it would be hit",
                own.name
            ));
        }
        let height = own.idealisation.skeleton.nodes[node].y;
        let floor = own
            .floors
            .iter()
            .position(|floor| (floor.height - height).abs() <= LEVEL_TOLERANCE);
        Ok(Face {
            building,
            dof: own.offset + dof,
            mass,
            floor: floor.map(|index| index + 1),
            height,
        })
    }
}

impl Contact {
    /// A contact without width; its law must be set.
    #[must_use]
    pub fn without_law(faces: Faces) -> Self {
        Self {
            gap: 0,
            faces,
            height: faces.height(),
            width: 0.0,
            law: ForceLaw::Hertz {
                stiffness: 0.0,
                damping: 0.0,
            },
        }
    }
}

impl BuildingSystem {
    /// Assembles the equations of an idealised building, without damping.
    #[must_use]
    pub fn new(name: &str, idealisation: Idealisation) -> Self {
        let equations = Equations::assemble(&idealisation.skeleton);
        let sweep = RiccatiSweep::through(&equations);
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
        let tops: Vec<f64> = floors.iter().map(|floor| floor.height).collect();
        let storeys = StoreyForces::new(&idealisation.skeleton, &equations, &tops);
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
            storeys,
            rest: Vec::new(),
            rest_springs: Vec::new(),
            spring_offset: 0,
            modal_damping: None,
            modes: Vec::new(),
            sweep: Arc::new(sweep),
        };
        let modes = modal::lateral_modes_along(&building, &building.sweep);
        building.modes = modes.unwrap_or_default();
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
        self.modal_damping = match damping {
            Damping::AllModes { ratio } => Some(*ratio),
            _ => None,
        };
        (self.equations.alpha, self.equations.beta) = match damping {
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

    /// Calls `take` with every storey, from the top down, its shear \[N\] and overturning moment \[N·m\].
    pub fn storey_forces(&self, state: &State, take: impl FnMut(usize, StoreyForce)) {
        let springs = &state.springs[self.spring_range()];
        let force = |spring: usize| springs[spring].force();
        self.storeys
            .for_each(&state.displacement[self.range()], force, take);
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
