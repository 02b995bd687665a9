//! The reduced basis of an elastic building for ground motion and contact forces (theory, Eqs. Q3 and Q4).

use super::defects;
use super::span::{RitzModes, Span};
use crate::linear::NotPositive;
use crate::linear::Row;
use crate::linear::cholesky::Cholesky;
use crate::simd;
use crate::structure::Equations;
use crate::system::BuildingSystem;
use crate::transfer::riccati::rates::{PerRate, RATES, RateFactors};

/// Ritz modes of one building: the lateral natural modes, and further vectors that make its flexibility at the
/// contacts and under the ground motion exact.
pub(super) struct Basis {
    pub(super) modes: RitzModes,
    /// Whether these are all natural modes.
    pub(super) is_complete: bool,
    /// Factorisations and solutions for its computation.
    pub(super) factorizations: u64,
    pub(super) solves: u64,
}

/// Points and tolerance of the comparison of basis and building.
pub(super) struct Demand<'a> {
    /// Points of the building that contacts push.
    pub(super) ports: &'a [Row],
    /// Displacements of its floors.
    pub(super) floors: &'a [Row],
    /// Rates s ≥ 0 at which the flexibilities gᵀ(K + s²M)⁻¹g are exact; the last is that of further vectors
    /// \[1/s\].
    pub(super) met: &'a [f64],
    /// Rates at which they are compared, the most critical first; together with those above at most [`RATES`].
    pub(super) compared: &'a [f64],
    /// Admissible relative difference there; ten times as much at floors without contact force \[–\].
    pub(super) tolerance: f64,
}

impl Basis {
    /// The lateral modes of the building, and its responses to the ground motion and to every contact at the given
    /// rates; as long as building and basis differ by more than the tolerance, further Krylov vectors of the last
    /// of these responses (E. L. Wilson, M.-W. Yuan, J. M. Dickens, 1982, Earthq. Eng. Struct. Dyn. 10, 813–821;
    /// several rates as in rational interpolation, E. J. Grimme, 1997).
    ///
    /// # Errors
    /// [`NotPositive`] when the building can move without deforming.
    pub(super) fn new(building: &BuildingSystem, demand: &Demand<'_>) -> Result<Self, NotPositive> {
        if massive(building).count() <= ALL_MODES {
            return Self::complete(building);
        }
        // Rounding may be all that tells many Krylov vectors of a very stiff building apart.
        Self::grown(building, demand).or_else(|_| Self::complete(building))
    }

    fn grown(building: &BuildingSystem, demand: &Demand<'_>) -> Result<Self, NotPositive> {
        let mut growing = Growing::new(building, demand)?;
        while !growing.is_close()? && growing.extend() {}
        growing.finished()
    }

    /// All natural modes: shapes that span every motion of the masses, massless degrees of freedom following statically.
    ///
    /// # Errors
    /// [`NotPositive`] when the building can move without deforming.
    pub(super) fn complete(building: &BuildingSystem) -> Result<Self, NotPositive> {
        let mut span = Span::empty(building);
        let sweep = &*building.sweep;
        let factors = sweep.factorize_at(&[at_once(&building.equations); RATES])?;
        let masses: Vec<usize> = massive(building).collect();
        for several in masses.chunks(RATES) {
            let mut answers = vec![[0.0; RATES]; building.equations.len()];
            for (lane, dof) in several.iter().enumerate() {
                answers[*dof][lane] = 1.0;
            }
            sweep.solve_at(&factors, &mut answers);
            for lane in 0..several.len() {
                span.add(answers.iter().map(|values| values[lane]).collect());
            }
        }
        Ok(Self {
            modes: span.ritz_modes()?,
            is_complete: true,
            factorizations: 1,
            solves: masses.len() as u64,
        })
    }

    /// The same with the defects of these modes added to the span; all natural modes if their number is similar.
    ///
    /// # Errors
    /// [`NotPositive`] as for [`Basis::new`].
    pub(super) fn enriched(
        &self,
        building: &BuildingSystem,
        modes: &[usize],
    ) -> Result<Self, NotPositive> {
        let most = massive(building).count();
        if self.is_complete || 3 * (self.len() + modes.len()) > 2 * most {
            return Self::complete(building);
        }
        let missed = defects::vectors(building, &self.modes, modes)?;
        let mut span = Span::empty(building);
        let solves = missed.len() as u64;
        for vector in self.modes.vectors.iter().cloned().chain(missed) {
            span.add(vector);
        }
        Ok(Self {
            modes: span.ritz_modes()?,
            is_complete: false,
            factorizations: 1,
            solves,
        })
    }

    /// Number of shapes.
    pub(super) fn len(&self) -> usize {
        self.modes.stiffness.len()
    }

    /// A linear form of every shape.
    pub(super) fn of_shapes(&self, form: impl Fn(&[f64]) -> f64) -> Vec<f64> {
        let vectors = self.modes.vectors.iter();
        let of_vectors: Vec<f64> = vectors.map(|vector| form(vector)).collect();
        let shapes = self.modes.parts.iter();
        shapes.map(|parts| simd::dot(parts, &of_vectors)).collect()
    }

    /// Adds Σ φ q to a displacement of all degrees of freedom.
    pub(super) fn expand(&self, modal: &[f64], full: &mut [f64]) {
        let RitzModes { vectors, parts, .. } = &self.modes;
        let mut shares = vec![0.0; vectors.len()];
        for (parts, q) in parts.iter().zip(modal) {
            simd::add(&mut shares, *q, parts);
        }
        for (vector, share) in vectors.iter().zip(shares) {
            simd::add(full, share, vector);
        }
    }
}

/// Number of masses up to which all modes are used: this costs less than a reduced basis.
const ALL_MODES: usize = 40;

/// Degrees of freedom with mass.
fn massive(building: &BuildingSystem) -> impl Iterator<Item = usize> + '_ {
    let masses = building.equations.mass.iter().enumerate();
    masses.filter(|(_, mass)| **mass > 0.0).map(|(dof, _)| dof)
}

/// Responses of the full building, for comparison.
struct Wanted {
    rate: f64,
    /// Displacements of the floors, and of the contact point itself, under ground motion and under a force at every
    /// contact.
    answers: Vec<Vec<f64>>,
}

/// Factor of the tolerance at floors without contact force.
const FLOOR_SHARE: f64 = 10.0;
/// Floors with less than this fraction of the response of the others do not count.
const QUIET: f64 = 1e-2;

struct Growing<'a> {
    building: &'a BuildingSystem,
    demand: &'a Demand<'a>,
    factors: RateFactors,
    span: Span<'a>,
    /// First vector of the last block.
    last_block: usize,
    wanted: Vec<Wanted>,
    factorizations: u64,
    solves: u64,
}

impl<'a> Growing<'a> {
    fn new(building: &'a BuildingSystem, demand: &'a Demand<'a>) -> Result<Self, NotPositive> {
        let sweep = &*building.sweep;
        // Matched rates come first; the remaining lanes repeat them.
        let asked = || demand.met.iter().chain(demand.compared).copied();
        let mut rates = [0.0; RATES];
        for (lane, rate) in rates.iter_mut().zip(asked().chain(asked().cycle())) {
            *lane = rate;
        }
        let factors = sweep.factorize_at(&rates)?;
        let loads: Vec<Vec<f64>> = std::iter::once(building.equations.driven_mass.clone())
            .chain(demand.ports.iter().map(|port| push_on(building, port)))
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
                .map(|(answer, loaded_row)| {
                    let places = demand.floors.iter().chain(loaded_row);
                    let shown = |place: &Row| {
                        let entries = place.entries().iter();
                        entries.map(|&(dof, c)| c * answer[dof][met + index]).sum()
                    };
                    places.map(shown).collect()
                })
                .collect(),
        });
        let rates = met + demand.compared.len();
        let wanted = wanted.collect();
        let mut span = Span::empty(building);
        for mode in building.lateral_modes() {
            span.add(mode.shape.clone());
        }
        let mut last_block = 0;
        for rate in 0..met {
            last_block = span.vectors.len();
            for answer in &answers {
                span.add(answer.iter().map(|values| values[rate]).collect());
            }
        }
        Ok(Self {
            wanted,
            factorizations: rates as u64,
            solves: (rates * loads.len()) as u64,
            factors,
            building,
            demand,
            span,
            last_block,
        })
    }

    /// Adds a block of vectors; false if there is no new vector.
    fn extend(&mut self) -> bool {
        let last_rate = self.factors.only(self.demand.met.len().saturating_sub(1));
        let answers = answers_to_inertia(
            self.building,
            &last_rate,
            &self.span.vectors[self.last_block..],
        );
        self.last_block = self.span.vectors.len();
        self.solves += answers.len() as u64;
        for answer in answers {
            self.span.add(answer);
        }
        self.span.vectors.len() > self.last_block
    }

    /// Whether the responses in the basis agree with those of the building.
    fn is_close(&self) -> Result<bool, NotPositive> {
        let shown = |place: &Row| -> Vec<f64> {
            self.span.vectors.iter().map(|v| place.value(v)).collect()
        };
        let ports = self.demand.ports.iter().map(shown);
        let loads: Vec<Vec<f64>> = std::iter::once(self.span.driven.clone())
            .chain(ports)
            .collect();
        let floors: Vec<Vec<f64>> = self.demand.floors.iter().map(shown).collect();
        for wanted in &self.wanted {
            let factor = Cholesky::new(self.span.projected(wanted.rate));
            let mut answers = loads.clone();
            factor.ok_or(NotPositive { dof: 0 })?.solve(&mut answers);
            let columns = answers.iter().zip(&loads).zip(loaded(self.demand));
            let mut of_loads = columns.zip(&wanted.answers);
            let close = of_loads.all(|(((got, load), candidate), wanted)| {
                let sizes = wanted.iter().map(|answer| answer.abs());
                let quiet = QUIET * sizes.fold(0.0, f64::max);
                // The contact point itself comes last, with a smaller tolerance.
                let floors = floors.iter().map(|shown| (shown, FLOOR_SHARE));
                let mut places = floors.chain(candidate.map(|_| (load, 1.0))).zip(wanted);
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

    /// The Ritz modes.
    fn finished(self) -> Result<Basis, NotPositive> {
        Ok(Basis {
            modes: self.span.ritz_modes()?,
            is_complete: false,
            factorizations: self.factorizations,
            solves: self.solves,
        })
    }
}

/// (K + s²M)⁻¹ M v of vectors v.
fn answers_to_inertia(
    building: &BuildingSystem,
    factors: &RateFactors,
    vectors: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let mass = &building.equations.mass;
    let mut found = Vec::with_capacity(vectors.len());
    for several in vectors.chunks(RATES) {
        let mut answers = vec![[0.0; RATES]; mass.len()];
        for (lane, vector) in several.iter().enumerate() {
            for ((answer, v), m) in answers.iter_mut().zip(vector).zip(mass) {
                answer[lane] = v * m;
            }
        }
        building.sweep.solve_at(factors, &mut answers);
        let lanes = 0..several.len();
        found.extend(
            lanes.map(|lane| -> Vec<f64> { answers.iter().map(|values| values[lane]).collect() }),
        );
    }
    found
}

/// A rate at which stiffness is negligible compared with inertia \[1/s\].
pub(super) fn at_once(equations: &Equations) -> f64 {
    let stiffest = equations
        .mass
        .iter()
        .zip(&equations.stiffness.diagonal)
        .filter(|(mass, _)| **mass > 0.0)
        .map(|(mass, stiffness)| stiffness / mass)
        .fold(1.0, f64::max);
    (1e13 * stiffest).sqrt()
}

/// The contact point of every load: none for the ground motion, then one after the other.
fn loaded<'a>(demand: &Demand<'a>) -> impl Iterator<Item = Option<&'a Row>> + use<'a> {
    std::iter::once(None).chain(demand.ports.iter().map(Some))
}

/// A unit force on a point.
fn push_on(building: &BuildingSystem, port: &Row) -> Vec<f64> {
    let mut load = vec![0.0; building.equations.len()];
    port.push(1.0, &mut load);
    load
}
