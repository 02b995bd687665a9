//! Displacements without mass: joints that turn, feet of walls and of columns, middles of hinges. At every instant they stand where
//! elastic parts and springs that feel them are in equilibrium, and follow the masses along the present lines of the springs.

use nalgebra::{DMatrix, DVector};

use super::bodies::{Bodies, SpringLaw, along};
use super::forces::{Motion, Phases, SpringPhase};

/// Those of a system.
#[derive(Default)]
pub(super) struct Massless {
    /// The displacements.
    pub(super) dofs: Vec<usize>,
    /// Place in that list of every displacement of the system.
    places: Vec<Option<usize>>,
    /// Elastic stiffness: place in the list, displacement of the system, entry.
    elastic: Vec<(usize, usize, f64)>,
    /// Springs that feel them.
    springs: Vec<usize>,
}

/// Newton's iterations, of which the last ones go half the way.
const MOST_ITERATIONS: usize = 80;
const WHOLE_ITERATIONS: usize = 25;
/// Change of a displacement that counts as none, as a share of the greatest of all, which is this at least \[m\].
const STILL: f64 = 1e-15;
const LEAST: f64 = 1e-4;

impl Massless {
    /// Those of a system.
    ///
    /// # Errors
    /// Dashpots that act on them beside springs: their rates would be unknowns of their own.
    pub(super) fn of(bodies: &Bodies) -> Result<Self, String> {
        let n = bodies.len();
        let dofs: Vec<usize> = (0..n).filter(|dof| bodies.mass[*dof] == 0.0).collect();
        let mut places = vec![None; n];
        for (place, dof) in dofs.iter().enumerate() {
            places[*dof] = Some(place);
        }
        let elastic = bodies
            .stiffness
            .entries()
            .filter_map(|(row, column, value)| Some((places[row]?, column, value)));
        let elastic = elastic.collect();
        let feels = |row: &[(usize, f64)]| row.iter().any(|(dof, _)| places[*dof].is_some());
        let springs = bodies.springs.iter().enumerate();
        let springs: Vec<usize> = springs
            .filter(|(_, spring)| feels(&spring.row))
            .map(|(index, _)| index)
            .collect();
        let damped = bodies
            .damping
            .entries()
            .any(|(row, _, value)| value != 0.0 && places[row].is_some());
        let slides = |index: &usize| matches!(bodies.springs[*index].law, SpringLaw::Slider(_));
        let delayed = |index: &usize| bodies.springs[*index].delay > 0.0;
        if springs.iter().any(slides)
            || springs.iter().any(delayed)
            || damped && !springs.is_empty()
        {
            return Err("dashpots act on displacements without mass beside springs".into());
        }
        let joined = bodies.links.iter().map(|link| &link.row);
        let joined = joined.chain(bodies.contacts.iter().map(|contact| &contact.row));
        if joined.into_iter().any(|row| feels(row)) {
            return Err("contacts and links act on displacements without mass".into());
        }
        Ok(Self {
            dofs,
            places,
            elastic,
            springs,
        })
    }

    /// Slope of the line of a spring at a deformation, on the side to which it moves.
    fn tangent(&self, bodies: &Bodies, phases: &Phases, index: usize, x: f64, rate: f64) -> f64 {
        let (SpringLaw::Rule(rule), SpringPhase::Rule(memory)) =
            (&bodies.springs[index].law, &phases.springs[index])
        else {
            return 0.0;
        };
        let size = rule.backbone().yield_force() / rule.backbone().initial();
        let near = (x - memory.deformation()).abs() <= 1e-9 * size;
        let x = match near {
            true => memory.deformation() + 1e-8 * size * 1.0_f64.copysign(rate),
            false => x,
        };
        rule.respond(memory, x).tangent
    }

    /// Stiffness of what holds them, along these lines of the springs.
    fn matrix(&self, bodies: &Bodies, slopes: &[f64]) -> DMatrix<f64> {
        let count = self.dofs.len();
        let mut matrix = DMatrix::zeros(count, count);
        for (row, dof, value) in &self.elastic {
            if let Some(column) = self.places[*dof] {
                matrix[(*row, column)] += value;
            }
        }
        for (index, slope) in self.springs.iter().zip(slopes) {
            let row = &bodies.springs[*index].row;
            for (a, share) in row {
                let Some(a) = self.places[*a] else { continue };
                for (b, other) in row {
                    if let Some(b) = self.places[*b] {
                        matrix[(a, b)] += slope * share * other;
                    }
                }
            }
        }
        matrix
    }

    /// Moves them to where they are in equilibrium; false where none is found.
    pub(super) fn settle(&self, bodies: &Bodies, phases: &Phases, state: &mut Motion) -> bool {
        let count = self.dofs.len();
        if count == 0 {
            return true;
        }
        let mut residual = DVector::zeros(count);
        for iteration in 0..MOST_ITERATIONS {
            residual.fill(0.0);
            for (row, dof, value) in &self.elastic {
                residual[*row] += value * state.u[*dof];
            }
            for (place, dof) in self.dofs.iter().enumerate() {
                residual[place] += bodies.weight[*dof];
            }
            let mut slopes = Vec::with_capacity(self.springs.len());
            for index in &self.springs {
                let spring = &bodies.springs[*index];
                let x = along(&spring.row, &state.u);
                if let (SpringLaw::Rule(rule), SpringPhase::Rule(memory)) =
                    (&spring.law, &phases.springs[*index])
                {
                    let response = rule.respond(memory, x);
                    for (dof, share) in &spring.row {
                        if let Some(place) = self.places[*dof] {
                            residual[place] += share * response.force;
                        }
                    }
                }
                let rate = along(&spring.row, &state.v);
                slopes.push(self.tangent(bodies, phases, *index, x, rate));
            }
            let Some(change) = self.matrix(bodies, &slopes).lu().solve(&residual) else {
                return false;
            };
            let way = if iteration < WHOLE_ITERATIONS {
                1.0
            } else {
                0.5
            };
            let mut moved = 0.0_f64;
            for (place, dof) in self.dofs.iter().enumerate() {
                state.u[*dof] -= way * change[place];
                moved = moved.max(change[place].abs());
            }
            let most = state.u.iter().fold(LEAST, |most, u| most.max(u.abs()));
            if moved <= STILL * most {
                return true;
            }
            // Rounding keeps it from coming nearer.
            if iteration >= 3 && moved <= 1e3 * STILL * most {
                return true;
            }
        }
        false
    }

    /// Lets them follow a motion of the masses, rates or accelerations, along the present lines of the springs.
    pub(super) fn follow(
        &self,
        bodies: &Bodies,
        phases: &Phases,
        state: &Motion,
        motion: &mut [f64],
    ) {
        let count = self.dofs.len();
        if count == 0 {
            return;
        }
        for dof in &self.dofs {
            motion[*dof] = 0.0;
        }
        let slopes: Vec<f64> = self
            .springs
            .iter()
            .map(|index| {
                let row = &bodies.springs[*index].row;
                let (x, rate) = (along(row, &state.u), along(row, &state.v));
                self.tangent(bodies, phases, *index, x, rate)
            })
            .collect();
        let mut load = DVector::zeros(count);
        for (row, dof, value) in &self.elastic {
            load[*row] -= value * motion[*dof];
        }
        for (index, slope) in self.springs.iter().zip(&slopes) {
            let row = &bodies.springs[*index].row;
            let pushed = slope * along(row, motion);
            for (dof, share) in row {
                if let Some(place) = self.places[*dof] {
                    load[place] -= share * pushed;
                }
            }
        }
        if let Some(followed) = self.matrix(bodies, &slopes).lu().solve(&load) {
            for (place, dof) in self.dofs.iter().enumerate() {
                motion[*dof] = followed[place];
            }
        }
    }
}
