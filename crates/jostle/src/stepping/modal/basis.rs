//! The few shapes in which an elastic building answers the ground and its contacts (theory, Eqs. Q3 and Q4).

use faer::{Mat, Side};
use pulp::NullaryFnOnce;

use crate::lanes::{self, in_wide_registers};
use crate::stepping::{NotPositive, StepEquations, StepMatrix};
use crate::system::BuildingSystem;
use crate::transfer::riccati::{RiccatiFactor, RiccatiSweep};

/// Ritz modes of one building: natural modes as far as they matter in time, and beyond them what makes its
/// flexibility at the contacts and under the ground motion exact.
pub(super) struct Basis {
    /// ω², rising \[1/s²\].
    pub(super) stiffness: Vec<f64>,
    /// Vectors over all degrees of freedom, massless ones included, and what part every shape φ, φᵀMφ = 1, has of each
    /// \[kg^−½\].
    vectors: Vec<Vec<f64>>,
    parts: Vec<Vec<f64>>,
    /// φᵀM r \[kg^½\].
    pub(super) participation: Vec<f64>,
    /// Factorisations and solutions it took.
    pub(super) factorizations: u64,
    pub(super) solves: u64,
}

/// What remains of a vector beside the others when it brings nothing new; less would be rounding, in which massless degrees
/// of freedom no longer follow the others and are far too stiff.
const NOTHING_NEW: f64 = 1e-4;

/// Where and how closely the basis has to agree with the building.
pub(super) struct Demand<'a> {
    /// Degrees of freedom of the building that contacts push.
    pub(super) faces: &'a [usize],
    /// Degrees of freedom of its floors.
    pub(super) floors: &'a [usize],
    /// Rates s ≥ 0 at which the flexibilities gᵀ(K + s²M)⁻¹g are met exactly; the last is that of further vectors
    /// \[1/s\].
    pub(super) met: &'a [f64],
    /// Rates at which they are compared.
    pub(super) compared: &'a [f64],
    /// By how much they may differ there, relative; ten times as much at floors that are not pushed \[–\].
    pub(super) tolerance: f64,
}

impl Basis {
    /// The lateral modes of the building, and its answers to the ground and to every contact at the rates asked for; as
    /// long as the building and its reduction can be told apart, further Krylov vectors of the last of these
    /// answers (E. L. Wilson, M.-W. Yuan, J. M. Dickens, 1982, Earthq. Eng. Struct. Dyn. 10, 813–821; several rates
    /// as in rational interpolation, E. J. Grimme, 1997).
    ///
    /// # Errors
    /// [`NotPositive`] when the building can move without deforming.
    pub(super) fn of(building: &BuildingSystem, demand: &Demand<'_>) -> Result<Self, NotPositive> {
        let mut growing = Growing::of(building, demand)?;
        loop {
            let basis = growing.ritz()?;
            if growing.is_close(&basis) || !growing.extend() {
                return Ok(growing.finished(basis));
            }
        }
    }

    /// Number of shapes.
    pub(super) fn len(&self) -> usize {
        self.stiffness.len()
    }

    /// A linear form of every shape.
    pub(super) fn of_shapes(&self, form: impl Fn(&[f64]) -> f64) -> Vec<f64> {
        let of_vectors: Vec<f64> = self.vectors.iter().map(|vector| form(vector)).collect();
        let shapes = self.parts.iter();
        shapes.map(|parts| lanes::dot(parts, &of_vectors)).collect()
    }

    /// Adds Σ φ q to a displacement of all degrees of freedom.
    pub(super) fn expand(&self, modal: &[f64], full: &mut [f64]) {
        for (index, vector) in self.vectors.iter().enumerate() {
            let terms = self.parts.iter().zip(modal);
            let share: f64 = terms.map(|(parts, q)| parts[index] * q).sum();
            for (value, vector) in full.iter_mut().zip(vector) {
                *value += share * vector;
            }
        }
    }
}

/// Answers of the building itself, to compare with.
struct Wanted {
    rate: f64,
    /// Displacements of the floors, and of the face itself, under the ground and under a push on every face.
    answers: Vec<Vec<f64>>,
}

/// How much further off floors may be that are not pushed.
const FLOOR_SHARE: f64 = 10.0;
/// Floors that answer with less than this share of the others do not count.
const QUIET: f64 = 1e-2;

struct Growing<'a> {
    building: &'a BuildingSystem,
    demand: &'a Demand<'a>,
    sweep: RiccatiSweep,
    factor: RiccatiFactor,
    /// M-orthonormal vectors over all degrees of freedom.
    vectors: Vec<Vec<f64>>,
    /// M times them.
    heavy: Vec<Vec<f64>>,
    /// vᵀK w between them, lower triangle row by row.
    products: Vec<Vec<f64>>,
    /// First vector of the last block.
    last_block: usize,
    wanted: Vec<Wanted>,
    factorizations: u64,
    solves: u64,
}

/// Eigenvalues and eigenvectors within the vectors.
struct Ritz {
    values: Vec<f64>,
    parts: Vec<Vec<f64>>,
}

impl<'a> Growing<'a> {
    fn of(building: &'a BuildingSystem, demand: &'a Demand<'a>) -> Result<Self, NotPositive> {
        let mut growing = Self {
            building,
            demand,
            sweep: RiccatiSweep::of(building),
            factor: RiccatiFactor::default(),
            vectors: Vec::new(),
            heavy: Vec::new(),
            products: Vec::new(),
            last_block: 0,
            wanted: Vec::new(),
            factorizations: 0,
            solves: 0,
        };
        for &rate in demand.compared {
            growing.compare_at(rate)?;
        }
        for mode in building.lateral_modes() {
            growing.add(mode.shape.clone());
        }
        for &rate in demand.met {
            growing.last_block = growing.vectors.len();
            growing.factorize(rate)?;
            growing.answer(building.equations.driven_mass.clone());
            for &face in demand.faces {
                growing.answer(growing.push_on(face));
            }
        }
        Ok(growing)
    }

    fn factorize(&mut self, rate: f64) -> Result<(), NotPositive> {
        let tangents = self.building.equations.initial_tangents();
        let matrix = StepMatrix::new(1.0, rate * rate);
        self.factorizations += 1;
        self.sweep.factorize(&matrix, &tangents, &mut self.factor)
    }

    fn push_on(&self, face: usize) -> Vec<f64> {
        let mut load = vec![0.0; self.building.equations.len()];
        load[face] = 1.0;
        load
    }

    fn solved(&mut self, mut load: Vec<f64>) -> Vec<f64> {
        self.solves += 1;
        self.sweep.solve(&self.factor, &mut load);
        load
    }

    fn compare_at(&mut self, rate: f64) -> Result<(), NotPositive> {
        self.factorize(rate)?;
        let mut answers = Vec::with_capacity(self.demand.faces.len() + 1);
        let loads = std::iter::once(self.building.equations.driven_mass.clone());
        let pushes: Vec<Vec<f64>> = self
            .demand
            .faces
            .iter()
            .map(|face| self.push_on(*face))
            .collect();
        for (load, own) in loads.chain(pushes).zip(self.loaded()) {
            let answer = self.solved(load);
            let floors = self.demand.floors.iter().chain(own);
            answers.push(floors.map(|place| answer[*place]).collect());
        }
        self.wanted.push(Wanted { rate, answers });
        Ok(())
    }

    /// The face that every load pushes: none for the ground, then one after the other.
    fn loaded(&self) -> impl Iterator<Item = Option<&'a usize>> + use<'a> {
        std::iter::once(None).chain(self.demand.faces.iter().map(Some))
    }

    /// The answer to a load, as far as it is new.
    fn answer(&mut self, load: Vec<f64>) {
        let vector = self.solved(load);
        self.add(vector);
    }

    /// One block more; false when there is nothing left to find.
    fn extend(&mut self) -> bool {
        let loads = self.heavy[self.last_block..].to_vec();
        self.last_block = self.vectors.len();
        for load in loads {
            self.answer(load);
        }
        self.vectors.len() > self.last_block
    }

    /// Keeps what a vector has beside the others.
    fn add(&mut self, mut vector: Vec<f64>) {
        let equations = &self.building.equations;
        let most = equations.mass.iter().filter(|mass| **mass > 0.0).count();
        if self.vectors.len() == most {
            return;
        }
        let length = |vector: &[f64]| lanes::weighted_square(&equations.mass, vector).sqrt();
        let before = length(&vector);
        let strip = Strip {
            vector: &mut vector,
            known: &self.vectors,
            heavy: &self.heavy,
        };
        in_wide_registers(equations.len(), strip);
        let rest = length(&vector);
        if rest <= NOTHING_NEW * before || rest.is_nan() {
            return;
        }
        vector.iter_mut().for_each(|value| *value /= rest);
        let mut stiff = vec![0.0; vector.len()];
        equations.stiffness.multiply_add(&vector, &mut stiff);
        let heavy = vector.iter().zip(&equations.mass).map(|(v, m)| v * m);
        self.heavy.push(heavy.collect());
        self.vectors.push(vector);
        let mut row = vec![0.0; self.vectors.len()];
        let products = Products {
            with: &stiff,
            vectors: &self.vectors,
            row: &mut row,
        };
        in_wide_registers(stiff.len(), products);
        self.products.push(row);
    }

    fn ritz(&self) -> Result<Ritz, NotPositive> {
        let n = self.vectors.len();
        let mut matrix = Mat::zeros(n, n);
        for (i, row) in self.products.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                matrix[(i, j)] = *value;
            }
        }
        let eigen = matrix
            .self_adjoint_eigen(Side::Lower)
            .map_err(|_| NotPositive { dof: 0 })?;
        let values: Vec<f64> = (0..n).map(|k| eigen.S()[k]).collect();
        if values.iter().any(|value| *value <= 0.0 || value.is_nan()) {
            return Err(NotPositive { dof: 0 });
        }
        let parts = (0..n).map(|k| (0..n).map(|i| eigen.U()[(i, k)]).collect());
        Ok(Ritz {
            values,
            parts: parts.collect(),
        })
    }

    /// Σ parts·vectors at one place.
    fn at(&self, parts: &[f64], place: usize) -> f64 {
        let vectors = self.vectors.iter().zip(parts);
        vectors.map(|(vector, part)| vector[place] * part).sum()
    }

    /// Whether answers within the vectors are those of the building.
    fn is_close(&self, ritz: &Ritz) -> bool {
        let shown = |place: usize| -> Vec<f64> {
            ritz.parts
                .iter()
                .map(|parts| self.at(parts, place))
                .collect()
        };
        let driven = &self.building.equations.driven_mass;
        let by_ground: Vec<f64> = self.vectors.iter().map(|v| lanes::dot(driven, v)).collect();
        let participation = ritz.parts.iter().map(|parts| lanes::dot(&by_ground, parts));
        let loads = std::iter::once(participation.collect())
            .chain(self.demand.faces.iter().map(|face| shown(*face)));
        let loads: Vec<Vec<f64>> = loads.collect();
        let floors: Vec<Vec<f64>> = self
            .demand
            .floors
            .iter()
            .map(|floor| shown(*floor))
            .collect();
        self.wanted.iter().all(|wanted| {
            let weights: Vec<f64> = ritz
                .values
                .iter()
                .map(|k| 1.0 / (k + wanted.rate * wanted.rate))
                .collect();
            let loaded = loads.iter().zip(self.loaded());
            loaded.zip(&wanted.answers).all(|((load, own), answers)| {
                let quiet = QUIET
                    * answers
                        .iter()
                        .fold(0.0, |most: f64, answer| most.max(answer.abs()));
                // The face itself comes last, and is to be met more closely.
                let places = floors
                    .iter()
                    .map(|shown| (shown, FLOOR_SHARE))
                    .chain(own.map(|_| (load, 1.0)));
                places.zip(answers).all(|((shown, share), wanted)| {
                    let terms = load.iter().zip(shown).zip(&weights);
                    let got: f64 = terms.map(|((a, b), weight)| a * b * weight).sum();
                    (got - wanted).abs() <= share * self.demand.tolerance * wanted.abs().max(quiet)
                })
            })
        })
    }

    fn finished(self, ritz: Ritz) -> Basis {
        let driven = &self.building.equations.driven_mass;
        let by_ground: Vec<f64> = self.vectors.iter().map(|v| lanes::dot(driven, v)).collect();
        let participation = ritz.parts.iter().map(|parts| lanes::dot(&by_ground, parts));
        Basis {
            participation: participation.collect(),
            stiffness: ritz.values,
            parts: ritz.parts,
            vectors: self.vectors,
            factorizations: self.factorizations,
            solves: self.solves,
        }
    }
}

/// Takes from a vector what it has of those already known; heavy ones are M times these.
struct Strip<'a> {
    vector: &'a mut [f64],
    known: &'a [Vec<f64>],
    heavy: &'a [Vec<f64>],
}

impl NullaryFnOnce for Strip<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        // Twice is enough.
        for _ in 0..2 {
            for (known, heavy) in self.known.iter().zip(self.heavy) {
                let part = lanes::dot(heavy, self.vector);
                for (value, known) in self.vector.iter_mut().zip(known) {
                    *value -= part * known;
                }
            }
        }
    }
}

/// Products of a vector with many.
struct Products<'a> {
    with: &'a [f64],
    vectors: &'a [Vec<f64>],
    row: &'a mut [f64],
}

impl NullaryFnOnce for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (product, vector) in self.row.iter_mut().zip(self.vectors) {
            *product = lanes::dot(vector, self.with);
        }
    }
}
