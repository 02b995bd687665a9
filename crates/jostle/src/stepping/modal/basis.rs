//! The few shapes in which an elastic building answers the ground and its contacts (theory, Eqs. X3 to X5).

use faer::{Mat, Side};

use crate::modal::Mode;
use crate::stepping::{NotPositive, StepEquations, StepMatrix, lanes};
use crate::system::BuildingSystem;
use crate::transfer::riccati::{RiccatiFactor, RiccatiSweep};

/// Ritz modes of one building: natural modes as far as they matter in time, and beyond them what makes its
/// flexibility at the contacts and under the ground motion exact.
pub(super) struct Basis {
    /// ω², rising \[1/s²\].
    pub(super) stiffness: Vec<f64>,
    /// Shapes φ with φᵀMφ = 1 over all degrees of freedom, massless ones included \[kg^−½\].
    pub(super) shapes: Vec<Vec<f64>>,
    /// φᵀM r \[kg^½\].
    pub(super) participation: Vec<f64>,
    /// Factorisations and solutions it took.
    pub(super) factorizations: u64,
    pub(super) solves: u64,
}

/// What remains of a vector beside the others when it brings nothing new.
const NOTHING_NEW: f64 = 1e-7;

/// Where and how closely the basis has to agree with the building.
pub(super) struct Demand<'a> {
    /// Degrees of freedom of the building that contacts push.
    pub(super) faces: &'a [usize],
    /// Rates s at which flexibilities gᵀ(K + s²M)⁻¹g are compared \[1/s\].
    pub(super) rates: &'a [f64],
    /// By how much they may differ, relative; and ω of lateral modes \[–\].
    pub(super) tolerance: f64,
}

impl Basis {
    /// Block Krylov vectors of K⁻¹M from the static answers to the ground and to every contact, until the building
    /// and its reduction cannot be told apart (E. L. Wilson, M.-W. Yuan, J. M. Dickens, 1982, Earthq. Eng. Struct.
    /// Dyn. 10, 813–821).
    ///
    /// # Errors
    /// [`NotPositive`] when the building can move without deforming.
    pub(super) fn of(building: &BuildingSystem, demand: &Demand<'_>) -> Result<Self, NotPositive> {
        let mut growing = Growing::of(building, demand)?;
        loop {
            let exhausted = !growing.extend();
            let basis = growing.ritz()?;
            if exhausted || growing.is_close(&basis) {
                return Ok(basis);
            }
        }
    }
}

/// Answers of the building itself, to compare with.
struct Wanted {
    rate: f64,
    /// gᵀ(K + s²M)⁻¹g and gᵀ(K + s²M)⁻¹M r for every face.
    faces: Vec<[f64; 2]>,
}

struct Growing<'a> {
    building: &'a BuildingSystem,
    demand: &'a Demand<'a>,
    sweep: RiccatiSweep,
    factor: RiccatiFactor,
    /// M-orthonormal vectors over all degrees of freedom.
    vectors: Vec<Vec<f64>>,
    /// M and K times them.
    heavy: Vec<Vec<f64>>,
    stiff: Vec<Vec<f64>>,
    /// First vector of the last block.
    last_block: usize,
    wanted: Vec<Wanted>,
    factorizations: u64,
    solves: u64,
}

impl<'a> Growing<'a> {
    fn of(building: &'a BuildingSystem, demand: &'a Demand<'a>) -> Result<Self, NotPositive> {
        let sweep = RiccatiSweep::of(building);
        let mut growing = Self {
            building,
            demand,
            sweep,
            factor: RiccatiFactor::default(),
            vectors: Vec::new(),
            heavy: Vec::new(),
            stiff: Vec::new(),
            last_block: 0,
            wanted: Vec::new(),
            factorizations: 0,
            solves: 0,
        };
        for &rate in demand.rates {
            growing.factorize(&StepMatrix::new(1.0, rate * rate))?;
            let by_ground = growing.solved(building.equations.driven_mass.clone());
            let faces = demand.faces.iter().map(|&face| {
                let mut load = vec![0.0; building.equations.len()];
                load[face] = 1.0;
                [growing.solved(load)[face], by_ground[face]]
            });
            let faces = faces.collect();
            growing.wanted.push(Wanted { rate, faces });
        }
        growing.factorize(&StepMatrix::STATIC)?;
        Ok(growing)
    }

    fn factorize(&mut self, matrix: &StepMatrix) -> Result<(), NotPositive> {
        let tangents = self.building.equations.initial_tangents();
        self.factorizations += 1;
        self.sweep.factorize(matrix, &tangents, &mut self.factor)
    }

    fn solved(&mut self, mut load: Vec<f64>) -> Vec<f64> {
        self.solves += 1;
        self.sweep.solve(&self.factor, &mut load);
        load
    }

    /// One block more; false when there is nothing left to find.
    fn extend(&mut self) -> bool {
        let equations = &self.building.equations;
        let loads: Vec<Vec<f64>> = if self.vectors.is_empty() {
            let faces = self.demand.faces.iter().map(|&face| {
                let mut load = vec![0.0; equations.len()];
                load[face] = 1.0;
                load
            });
            std::iter::once(equations.driven_mass.clone())
                .chain(faces)
                .collect()
        } else {
            self.heavy[self.last_block..].to_vec()
        };
        let most = equations.mass.iter().filter(|mass| **mass > 0.0).count();
        self.last_block = self.vectors.len();
        for load in loads {
            if self.vectors.len() == most {
                break;
            }
            let vector = self.solved(load);
            self.add(vector);
        }
        self.vectors.len() > self.last_block && self.vectors.len() < most
    }

    /// Keeps what a vector has beside the others.
    fn add(&mut self, mut vector: Vec<f64>) {
        let equations = &self.building.equations;
        let length = |vector: &[f64]| lanes::weighted_square(&equations.mass, vector).sqrt();
        let before = length(&vector);
        // Twice is enough.
        for _ in 0..2 {
            for (known, heavy) in self.vectors.iter().zip(&self.heavy) {
                let part = lanes::dot(heavy, &vector);
                for (value, known) in vector.iter_mut().zip(known) {
                    *value -= part * known;
                }
            }
        }
        let rest = length(&vector);
        if rest <= NOTHING_NEW * before || rest.is_nan() {
            return;
        }
        vector.iter_mut().for_each(|value| *value /= rest);
        let heavy = vector.iter().zip(&equations.mass).map(|(v, m)| v * m);
        self.heavy.push(heavy.collect());
        let mut stiff = vec![0.0; vector.len()];
        equations.stiffness.multiply_add(&vector, &mut stiff);
        self.stiff.push(stiff);
        self.vectors.push(vector);
    }

    /// Modes of the building within the vectors.
    fn ritz(&self) -> Result<Basis, NotPositive> {
        let n = self.vectors.len();
        let mut matrix = Mat::zeros(n, n);
        for (i, vector) in self.vectors.iter().enumerate() {
            for (j, stiff) in self.stiff.iter().enumerate().take(i + 1) {
                matrix[(i, j)] = lanes::dot(vector, stiff);
            }
        }
        let eigen = matrix
            .self_adjoint_eigen(Side::Lower)
            .map_err(|_| NotPositive { dof: 0 })?;
        let driven = &self.building.equations.driven_mass;
        let mut basis = Basis {
            stiffness: Vec::with_capacity(n),
            shapes: Vec::with_capacity(n),
            participation: Vec::with_capacity(n),
            factorizations: self.factorizations,
            solves: self.solves,
        };
        for k in 0..n {
            let mut shape = vec![0.0; self.building.equations.len()];
            for (i, vector) in self.vectors.iter().enumerate() {
                let part = eigen.U()[(i, k)];
                for (value, known) in shape.iter_mut().zip(vector) {
                    *value += part * known;
                }
            }
            if eigen.S()[k] <= 0.0 {
                return Err(NotPositive { dof: 0 });
            }
            basis.stiffness.push(eigen.S()[k]);
            basis.participation.push(lanes::dot(driven, &shape));
            basis.shapes.push(shape);
        }
        Ok(basis)
    }

    /// Whether flexibilities and lateral frequencies of the basis are those of the building.
    fn is_close(&self, basis: &Basis) -> bool {
        let close = |got: f64, wanted: f64, scale: f64| (got - wanted).abs() <= self.demand.tolerance * scale.abs();
        let flexible = self.wanted.iter().all(|wanted| {
            let answers = self.demand.faces.iter().zip(&wanted.faces);
            answers.into_iter().all(|(&face, [own, by_ground])| {
                let (mut pushed, mut shaken) = (0.0, 0.0);
                for ((shape, stiffness), participation) in basis
                    .shapes
                    .iter()
                    .zip(&basis.stiffness)
                    .zip(&basis.participation)
                {
                    let answer = shape[face] / (stiffness + wanted.rate * wanted.rate);
                    pushed += answer * shape[face];
                    shaken += answer * participation;
                }
                close(pushed, *own, *own) && close(shaken, *by_ground, *by_ground)
            })
        });
        flexible
            && self.building.lateral_modes().take(LATERAL_MODES).all(|mode: &Mode| {
                let squared = mode.circular_frequency.powi(2);
                basis
                    .stiffness
                    .iter()
                    .any(|value| (value / squared - 1.0).abs() <= self.demand.tolerance * FREQUENCY_SHARE)
            })
    }
}

/// Lateral modes whose frequencies must be found.
const LATERAL_MODES: usize = 3;
/// How much more closely than flexibilities: a phase of a hundred cycles rests on them.
const FREQUENCY_SHARE: f64 = 1e-2;
