//! Damping of a building: the modes at which it is given, and the coefficients that follow.

use super::building::{BuildingSystem, Direction};
use crate::eigen::{LATERAL_SHARE, Mode, lateral_modes_along, modes_dense, sway_modes, symmetric};
use crate::linear::Row;
use crate::model::{Damping, ProportionalDamping, Sway, usual_damping_modes};
use crate::structure::element::{Place, THETA, X, Y, index_of};
use crate::structure::{AssembledBuilding, Influence, InnerLink, PlanBase, SpringPlace};
use crate::transfer::riccati::RiccatiSweep;

impl BuildingSystem {
    /// Sets the Rayleigh damping (theory, Eq. D1).
    ///
    /// # Errors
    /// A message when a lateral mode of that number does not exist.
    pub fn damp(&mut self, damping: &Damping) -> Result<(), String> {
        self.damp_as(damping, false)
    }

    /// The same for a building that stands fixed here and will stand on a mat: a single mode is damped in proportion to
    /// stiffness, and the first mode alone unless others are named.
    ///
    /// # Errors
    /// As [`BuildingSystem::damp`].
    pub(super) fn damp_as(&mut self, damping: &Damping, on_mat: bool) -> Result<(), String> {
        self.modal_damping = match damping {
            Damping::AllModes { ratio } => Some(*ratio),
            _ => None,
        };
        let (alpha, beta) = match damping {
            Damping::AllModes { .. } => (0.0, 0.0),
            Damping::Rayleigh { alpha, beta } => (*alpha, *beta),
            Damping::Ratio { ratio, modes, sway } => {
                let modes = match (on_mat, &modes[..]) {
                    (true, []) => &[1],
                    (_, asked) => asked,
                };
                let found = self.damped_modes(modes, *sway)?;
                let frequencies: Vec<f64> = found
                    .iter()
                    .map(|damped_mode| damped_mode.frequency)
                    .collect();
                // Squares of frequencies, as far as damping in proportion to stiffness acts: not on springs of links.
                let damped: Vec<f64> = found
                    .iter()
                    .map(|damped_mode| damped_mode.own_stiffness)
                    .collect();
                self.damped_at = found;
                match (&frequencies[..], &damped[..]) {
                    (&[single], &[own_stiffnesses]) if on_mat && !self.inner_links.is_empty() => {
                        (0.0, 2.0 * ratio * single / own_stiffnesses)
                    }
                    (&[low, high], &[own_low, own_high]) if !self.inner_links.is_empty() => {
                        let beta = 2.0 * ratio * (high - low) / (own_high - own_low);
                        let alpha = 2.0 * ratio * low - beta * own_low;
                        if alpha >= 0.0 && beta >= 0.0 {
                            (alpha, beta)
                        } else {
                            // No such coefficients damp: those of a building whose stiffness is all its own.
                            rayleigh(*ratio, [low, high])
                        }
                    }
                    (&[single], _) if on_mat => (0.0, 2.0 * ratio / single),
                    (&[single], _) => (2.0 * ratio * single, 0.0),
                    (&[low, high], _) => rayleigh(*ratio, [low, high]),
                    _ => return Err("damping takes one or two modes".to_owned()),
                }
            }
        };
        let equations = &mut self.structure.equations;
        (equations.alpha, equations.beta) = (alpha, beta);
        Ok(())
    }

    /// Share of critical damping of a mode by α and β alone, without dashpots of bases and links; β as far as it acts: not on braces and
    /// panels that yield unless the model says so \[–\].
    pub(crate) fn damping_by_coefficients(&self, mode: &Mode) -> f64 {
        if let Some(ratio) = self.modal_damping {
            return ratio;
        }
        let frequency = mode.circular_frequency;
        let damped = frequency.powi(2) - undamped_diagonals(&self.structure, &mode.shape);
        0.5 * (self.equations.alpha + self.equations.beta * damped) / frequency
    }

    /// The modes that Rayleigh damping is given at: those asked for, or the usual ones where none is.
    ///
    /// # Errors
    /// A message when a lateral mode of that number does not exist.
    fn damped_modes(&self, asked: &[usize], sway: Sway) -> Result<Vec<DampedMode>, String> {
        let directions: &[Direction] = match sway {
            Sway::Along => &[Direction::Along],
            Sway::Across => &[Direction::Across],
            Sway::Both => &[Direction::Along, Direction::Across],
        };
        let highest = asked.iter().max().copied().unwrap_or(2);
        let lateral = directions.iter().map(|direction| {
            let modes = match direction {
                Direction::Across => self.modes_across(highest),
                _ => self.modes_along(highest),
            };
            (*direction, modes)
        });
        let lateral: Vec<_> = lateral.collect();
        let fewest = lateral.iter().map(|(_, modes)| modes.len()).min();
        let numbers = match asked {
            [] => usual_damping_modes(fewest.unwrap_or(0)),
            asked => asked,
        };
        let mut found: Vec<DampedMode> = Vec::with_capacity(numbers.len());
        for (place, &number) in numbers.iter().enumerate() {
            let mut best: Option<DampedMode> = None;
            for (direction, modes) in &lateral {
                let mode = modes.get(number - 1).ok_or_else(|| {
                    let across = match direction {
                        Direction::Across => " across",
                        _ => "",
                    };
                    format!(
                        "lateral mode {number} does not exist: \"{}\" has {} lateral modes{across}",
                        self.name,
                        modes.len()
                    )
                })?;
                // The lowest first and the highest last mode bound all in between.
                best = match best {
                    Some(best) if (mode.frequency < best.frequency) == (place > 0) => Some(best),
                    _ => Some(*mode),
                };
            }
            found.extend(best.map(|mode| DampedMode { number, ..mode }));
        }
        Ok(found)
    }

    /// Lateral modes along the row, longest period first: of a building in space with all displacements but those along x held.
    /// Where fewer than `count` carry 1 % of the mass, those of sway, as many as there are floors.
    fn modes_along(&self, count: usize) -> Vec<DampedMode> {
        let mut tracks = self.tracks.iter();
        if tracks.any(|track| track.direction != Direction::Along) {
            return self.modes_with_all_else_held(count);
        }
        let of_mode = |mode: &Mode| DampedMode::new(mode, self);
        let lateral: Vec<DampedMode> = self.lateral_modes().map(of_mode).collect();
        let count = count.min(self.floors.len());
        if lateral.len() >= count {
            return lateral;
        }
        let sways = sway_modes(&self.structure, count).unwrap_or_default();
        sways.iter().map(of_mode).collect()
    }

    /// The same across, with motion along and rotation of floors and of the base held.
    fn modes_across(&self, count: usize) -> Vec<DampedMode> {
        let on_base = self.with_base_held_but_across();
        let building = on_base.as_ref().unwrap_or(&self.structure);
        let equations = &building.equations;
        let floors = building.discretization.floors.iter();
        let places = floors.flat_map(|floor| [X, THETA].map(|component| (*floor, component)));
        let held_dofs: Vec<usize> = places.filter_map(|place| equations.dof(place)).collect();
        let massed = (0..equations.len()).filter(|dof| equations.mass[*dof] > 0.0);
        let held: Vec<bool> = massed.map(|dof| held_dofs.contains(&dof)).collect();
        let modes = modes_dense(building, |lower| Some(symmetric::held(lower, &held)));
        let modes = modes.unwrap_or_default();
        let has_share = |mode: &&Mode| mode.effective_mass_ratio_across >= LATERAL_SHARE;
        let mut across: Vec<&Mode> = modes.iter().filter(has_share).collect();
        if self.stands_on_floors_alone() || across.len() < count.min(self.floors.len()) {
            let is_sway = |mode: &&Mode| mode.moves_mostly(equations, &equations.driven_across);
            across = modes.iter().filter(is_sway).collect();
        }
        let across = across.into_iter();
        across.map(|mode| DampedMode::new(mode, building)).collect()
    }

    /// The building on a base that neither moves along, nor turns about the vertical axis, nor rises; `None` without springs under it.
    fn with_base_held_but_across(&self) -> Option<AssembledBuilding> {
        let mut held = self.discretization.clone();
        let base = held.stick_model.plan_base?;
        for node in base.nodes() {
            let places = [X, THETA].map(|component| index_of((node, component)));
            let still = places.map(|place| (place, Row::default()));
            held.stick_model.ties.extend(still);
        }
        let mut held = AssembledBuilding::new(&self.name, held);
        // Links act on floors.
        let floors = self.discretization.floors.iter();
        let places = floors.flat_map(|floor| [X, Y, THETA].map(|component| (*floor, component)));
        let places: Vec<Place> = places.collect();
        let moved = |(dof, share): &(usize, f64)| {
            let mut places = places.iter();
            let place = places.find(|place| self.equations.dof(**place) == Some(*dof))?;
            Some((held.equations.dof(*place)?, *share))
        };
        let links = self.inner_links.iter().map(|link| InnerLink {
            shortening: link.shortening.entries().iter().filter_map(moved).collect(),
            ..link.clone()
        });
        held.inner_links = links.collect();
        Some(held)
    }

    /// Whether its floors are all that moves: neither joints of frames nor a base.
    fn stands_on_floors_alone(&self) -> bool {
        let mut nodes = self.discretization.stick_model.nodes.iter();
        nodes.all(|node| node.influence == Influence::OF_FLOOR) && self.plan_base.is_empty()
    }

    fn modes_with_all_else_held(&self, count: usize) -> Vec<DampedMode> {
        if !self.stands_on_floors_alone() {
            return self.modes_of_frames_along(count);
        }
        let equations = &self.equations;
        let along: Vec<usize> = (0..equations.len())
            .filter(|dof| equations.driven_mass[*dof] > 0.0)
            .collect();
        let mut column = vec![0.0; equations.len()];
        let mut lower: Vec<Vec<f64>> = (0..along.len()).map(|row| vec![0.0; row + 1]).collect();
        for (j, &dof) in along.iter().enumerate() {
            let mut unit = vec![0.0; equations.len()];
            unit[dof] = 1.0;
            column.fill(0.0);
            equations.stiffness.multiply_add(&unit, &mut column);
            equations.undamped.multiply_add(&unit, &mut column);
            for spring in &equations.springs {
                let force = spring.hysteresis.initial_tangent() * spring.deformation(&unit);
                spring.row.push(force, &mut column);
            }
            for link in &self.inner_links {
                let force = link.stiffness * link.shortening.value(&unit);
                link.shortening.push(force, &mut column);
            }
            for (i, &row) in along.iter().enumerate().skip(j) {
                lower[i][j] = column[row] / (equations.mass[row] * equations.mass[dof]).sqrt();
            }
        }
        let (values, vectors) = symmetric::eigen(&lower);
        let modes = values.into_iter().zip(vectors).map(|(value, vector)| {
            let mut shape = vec![0.0; equations.len()];
            for (&dof, vector) in along.iter().zip(vector) {
                shape[dof] = vector / equations.mass[dof].sqrt();
            }
            DampedMode::of_shape(value.sqrt(), &shape, self)
        });
        modes.collect()
    }

    /// The same for a building with frames: lateral modes of the building whose floors neither move across nor turn.
    fn modes_of_frames_along(&self, count: usize) -> Vec<DampedMode> {
        let mut held = self.discretization.clone();
        let base = held
            .stick_model
            .plan_base
            .into_iter()
            .flat_map(PlanBase::nodes);
        for node in held.floors.iter().copied().chain(base) {
            held.stick_model.nodes[node].hold_but_along();
        }
        let mut held = AssembledBuilding::new(&self.name, held);
        // Links act on floors, which only move along x now.
        let n = self.floors.len();
        let moved = |(dof, share): &(usize, f64)| {
            let mut along = self.tracks[..n].iter();
            let floor = along.position(|track| track.dof - self.offset == *dof)?;
            Some((held.floor_dofs[floor], *share))
        };
        let links = self.inner_links.iter().map(|link| InnerLink {
            shortening: link.shortening.entries().iter().filter_map(moved).collect(),
            ..link.clone()
        });
        held.inner_links = links.collect();
        let sweep = RiccatiSweep::through(&held.equations);
        let mut modes = lateral_modes_along(&held, &sweep).unwrap_or_default();
        modes.retain(Mode::is_along);
        let count = count.min(n);
        if modes.len() < count {
            modes = sway_modes(&held, count).unwrap_or_default();
        }
        modes
            .iter()
            .map(|mode| DampedMode::new(mode, &held))
            .collect()
    }
}

/// A lateral mode, as far as damping needs it.
#[derive(Clone, Copy, Debug)]
pub struct DampedMode {
    /// Number among the lateral modes of its direction, from 1; 0 before it is chosen.
    pub number: usize,
    /// Circular frequency \[rad/s\].
    pub frequency: f64,
    /// φᵀKφ without the springs of links between floors, ω² if there are none \[rad²/s²\].
    own_stiffness: f64,
}

impl DampedMode {
    fn new(mode: &Mode, building: &AssembledBuilding) -> Self {
        Self::of_shape(mode.circular_frequency, &mode.shape, building)
    }

    /// `shape`: with a mass of 1 kg.
    fn of_shape(frequency: f64, shape: &[f64], building: &AssembledBuilding) -> Self {
        let links = building.inner_links.iter();
        let links = links.map(|link| link.stiffness * link.shortening.value(shape).powi(2));
        Self {
            number: 0,
            frequency,
            own_stiffness: frequency.powi(2) - links.sum::<f64>(),
        }
    }
}

/// What the springs of braces and panels that yield, and have no damping in proportion to stiffness, add to ω² of a mode; `shape` with
/// a mass of 1 kg \[rad²/s²\].
fn undamped_diagonals(building: &AssembledBuilding, shape: &[f64]) -> f64 {
    let discretization = &building.discretization;
    let damping = discretization.stick_model.single_springs();
    let damping = damping.map(|damping| damping.proportional_damping);
    let springs = building.equations.springs.iter().zip(damping);
    let diagonals = springs
        .zip(&discretization.spring_places)
        .filter(|((_, damping), place)| {
            matches!(place, SpringPlace::Diagonal { .. }) && *damping == ProportionalDamping::None
        });
    let stiffness = diagonals.map(|((spring, _), _)| {
        spring.hysteresis.initial_tangent() * spring.deformation(shape).powi(2)
    });
    stiffness.sum()
}

/// Coefficients that give two modes a damping ratio (theory, Eq. D1) \[1/s, s\].
fn rayleigh(ratio: f64, [low, high]: [f64; 2]) -> (f64, f64) {
    (
        2.0 * ratio * low * high / (low + high),
        2.0 * ratio / (low + high),
    )
}
