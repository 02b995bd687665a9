//! The few shapes in which an elastic building answers the ground and its contacts (theory, Eqs. Q3 and Q4).

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use pulp::{Arch, Simd, WithSimd};

use crate::lanes;
use crate::modal::symmetric;
use crate::stepping::NotPositive;
use crate::system::BuildingSystem;
use crate::transfer::riccati::RiccatiSweep;
use crate::transfer::riccati::rates::{PerRate, RATES, RateFactors};

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
    /// Rates at which they are compared, the hardest to meet first; with those above no more than [`RATES`].
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
        while !growing.is_close()? && growing.extend() {}
        growing.finished()
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
        let mut shares = vec![0.0; self.vectors.len()];
        for (parts, q) in self.parts.iter().zip(modal) {
            lanes::add(&mut shares, *q, parts);
        }
        for (vector, share) in self.vectors.iter().zip(shares) {
            lanes::add(full, share, vector);
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
    sweep: &'a RiccatiSweep,
    /// Of the last of the rates that are met.
    last_rate: RateFactors,
    /// M-orthonormal vectors over all degrees of freedom.
    vectors: Vec<Vec<f64>>,
    /// vᵀK w between them, lower triangle row by row.
    products: Vec<Vec<f64>>,
    /// Horizontal mass that goes with every vector \[kg^½\].
    driven: Vec<f64>,
    /// First vector of the last block.
    last_block: usize,
    wanted: Vec<Wanted>,
    factorizations: u64,
    solves: u64,
}

impl<'a> Growing<'a> {
    fn of(building: &'a BuildingSystem, demand: &'a Demand<'a>) -> Result<Self, NotPositive> {
        let sweep = &*building.sweep;
        // Rates that are met come first; what is left of the lanes repeats them.
        let asked = || demand.met.iter().chain(demand.compared).copied();
        let mut rates = [0.0; RATES];
        for (lane, rate) in rates.iter_mut().zip(asked().chain(asked().cycle())) {
            *lane = rate;
        }
        let factors = sweep.factorize_at(&rates)?;
        let loads: Vec<Vec<f64>> = std::iter::once(building.equations.driven_mass.clone())
            .chain(demand.faces.iter().map(|face| push_on(building, *face)))
            .collect();
        let answers: Vec<Vec<PerRate>> = loads
            .iter()
            .map(|load| {
                let mut answers: Vec<PerRate> = load.iter().map(|value| [*value; RATES]).collect();
                sweep.solve_at(&factors, &mut answers);
                answers
            })
            .collect();
        let met = demand.met.len();
        let compared = demand.compared.iter().enumerate();
        let wanted = compared.map(|(index, rate)| Wanted {
            rate: *rate,
            answers: answers
                .iter()
                .zip(loaded(demand))
                .map(|(answer, own)| {
                    let places = demand.floors.iter().chain(own);
                    places.map(|place| answer[*place][met + index]).collect()
                })
                .collect(),
        });
        let rates = met + demand.compared.len();
        let mut growing = Self {
            last_rate: factors.only(met.saturating_sub(1)),
            wanted: wanted.collect(),
            factorizations: rates as u64,
            solves: (rates * loads.len()) as u64,
            building,
            demand,
            sweep,
            vectors: Vec::new(),
            products: Vec::new(),
            driven: Vec::new(),
            last_block: 0,
        };
        for mode in building.lateral_modes() {
            growing.add(mode.shape.clone());
        }
        for rate in 0..met {
            growing.last_block = growing.vectors.len();
            for answer in &answers {
                growing.add(answer.iter().map(|values| values[rate]).collect());
            }
        }
        Ok(growing)
    }

    /// One block more; false when there is nothing left to find.
    fn extend(&mut self) -> bool {
        let mass = &self.building.equations.mass;
        let inertia = |vector: &Vec<f64>| vector.iter().zip(mass).map(|(v, m)| v * m).collect();
        let loads: Vec<Vec<f64>> = self.vectors[self.last_block..]
            .iter()
            .map(inertia)
            .collect();
        self.last_block = self.vectors.len();
        self.solves += loads.len() as u64;
        for loads in loads.chunks(RATES) {
            let mut answers = vec![[0.0; RATES]; self.building.equations.len()];
            for (lane, load) in loads.iter().enumerate() {
                for (answer, value) in answers.iter_mut().zip(load) {
                    answer[lane] = *value;
                }
            }
            self.sweep.solve_at(&self.last_rate, &mut answers);
            for lane in 0..loads.len() {
                self.add(answers.iter().map(|values| values[lane]).collect());
            }
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
        let length = |vector: &[f64]| lanes::wide_weighted_square(&equations.mass, vector).sqrt();
        let before = length(&vector);
        let strip = Strip {
            vector: &mut vector,
            known: &self.vectors,
            mass: &equations.mass,
        };
        Arch::new().dispatch(strip);
        let rest = length(&vector);
        if rest <= NOTHING_NEW * before || rest.is_nan() {
            return;
        }
        vector.iter_mut().for_each(|value| *value /= rest);
        let mut stiff = vec![0.0; vector.len()];
        equations.stiffness.multiply_add(&vector, &mut stiff);
        self.driven
            .push(lanes::dot(&equations.driven_mass, &vector));
        self.vectors.push(vector);
        let mut row = vec![0.0; self.vectors.len()];
        let products = Products {
            with: &stiff,
            vectors: &self.vectors,
            row: &mut row,
        };
        Arch::new().dispatch(products);
        self.products.push(row);
    }

    /// vᵀ(K + s²M)w between all vectors; only the lower triangle is filled.
    fn projected(&self, rate: f64) -> Mat<f64> {
        let n = self.vectors.len();
        let mut matrix = Mat::zeros(n, n);
        for (i, row) in self.products.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                matrix[(i, j)] = *value;
            }
            matrix[(i, i)] += rate * rate;
        }
        matrix
    }

    /// Whether answers within the vectors are those of the building.
    fn is_close(&self) -> Result<bool, NotPositive> {
        let shown =
            |place: &usize| -> Vec<f64> { self.vectors.iter().map(|v| v[*place]).collect() };
        let faces = self.demand.faces.iter().map(shown);
        let loads: Vec<Vec<f64>> = std::iter::once(self.driven.clone()).chain(faces).collect();
        let floors: Vec<Vec<f64>> = self.demand.floors.iter().map(shown).collect();
        for wanted in &self.wanted {
            let factor = self.projected(wanted.rate).llt(Side::Lower);
            let factor = factor.map_err(|_| NotPositive { dof: 0 })?;
            let mut answers =
                Mat::from_fn(self.vectors.len(), loads.len(), |i, load| loads[load][i]);
            factor.solve_in_place(&mut answers);
            let columns = answers.col_iter().zip(&loads).zip(loaded(self.demand));
            let mut of_loads = columns.zip(&wanted.answers);
            let close = of_loads.all(|(((got, load), own), wanted)| {
                let sizes = wanted.iter().map(|answer| answer.abs());
                let quiet = QUIET * sizes.fold(0.0, f64::max);
                // The face itself comes last, and is to be met more closely.
                let floors = floors.iter().map(|shown| (shown, FLOOR_SHARE));
                let mut places = floors.chain(own.map(|_| (load, 1.0))).zip(wanted);
                places.all(|((shown, share), wanted)| {
                    let got: f64 = got.iter().zip(shown).map(|(a, b)| a * b).sum();
                    (got - wanted).abs() <= share * self.demand.tolerance * wanted.abs().max(quiet)
                })
            });
            if !close {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Ritz modes: eigenvalues and eigenvectors within the vectors.
    fn finished(self) -> Result<Basis, NotPositive> {
        let (stiffness, parts) = symmetric::eigen(&self.products);
        if stiffness
            .iter()
            .any(|value| *value <= 0.0 || value.is_nan())
        {
            return Err(NotPositive { dof: 0 });
        }
        let participation = parts.iter().map(|parts| lanes::dot(&self.driven, parts));
        Ok(Basis {
            participation: participation.collect(),
            stiffness,
            parts,
            vectors: self.vectors,
            factorizations: self.factorizations,
            solves: self.solves,
        })
    }
}

/// The face that every load pushes: none for the ground, then one after the other.
fn loaded<'a>(demand: &Demand<'a>) -> impl Iterator<Item = Option<&'a usize>> + use<'a> {
    std::iter::once(None).chain(demand.faces.iter().map(Some))
}

/// A unit force on one degree of freedom.
fn push_on(building: &BuildingSystem, face: usize) -> Vec<f64> {
    let mut load = vec![0.0; building.equations.len()];
    load[face] = 1.0;
    load
}

/// Takes from a vector what it has of those already known, which are M-orthonormal (Gram and Schmidt, all at once).
struct Strip<'a> {
    vector: &'a mut [f64],
    known: &'a [Vec<f64>],
    mass: &'a [f64],
}

impl WithSimd for Strip<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            vector,
            known,
            mass,
        } = self;
        let (mut heavy, mut parts) = (vec![0.0; vector.len()], vec![0.0; known.len()]);
        // Twice is enough.
        for _ in 0..2 {
            for ((heavy, value), mass) in heavy.iter_mut().zip(&*vector).zip(mass) {
                *heavy = value * mass;
            }
            lanes::dots(simd, known, &heavy, &mut parts);
            lanes::subtract_all(known, &parts, vector);
        }
    }
}

/// Products of a vector with many.
struct Products<'a> {
    with: &'a [f64],
    vectors: &'a [Vec<f64>],
    row: &'a mut [f64],
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        lanes::dots(simd, self.vectors, self.with, self.row);
    }
}
