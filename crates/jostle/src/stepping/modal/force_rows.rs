//! Forces of storeys, columns and beams under every vector or shape of a building, row by row: shears of all storeys, then
//! overturning moments, then what displacements add to the forces of columns and beams that are followed \[N, N·m\].

use pulp::{Arch, NullaryFnOnce};

use super::span::RitzModes;
use crate::simd;
use crate::system::BuildingSystem;

/// Vectors that are treated together.
const LANES: usize = 8;

/// Number of rows.
pub(super) fn count(building: &BuildingSystem) -> usize {
    2 * building.storeys.len() + building.members.forms.len()
}

/// Rows over displacements of an elastic building.
pub(super) fn of_vectors(building: &BuildingSystem, vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let storeys = building.storeys.len();
    let mut rows = vec![vec![0.0; vectors.len()]; count(building)];
    let elastic = |_| 0.0;
    for (index, vector) in vectors.iter().enumerate() {
        let link = |index: usize| {
            let link = &building.inner_links[index];
            link.stiffness * link.shortening.value(vector)
        };
        building
            .storeys
            .for_each(vector, elastic, link, |storey, force| {
                rows[storey][index] = force.shear;
                rows[storeys + storey][index] = force.moment;
            });
    }
    let forms = &building.members.forms;
    if forms.is_empty() {
        return rows;
    }
    let mut lanes = vec![[0.0; LANES]; building.equations.len()];
    for (chunk, several) in vectors.chunks(LANES).enumerate() {
        for (lane, vector) in several.iter().enumerate() {
            for (to, value) in lanes.iter_mut().zip(vector) {
                to[lane] = *value;
            }
        }
        let first = chunk * LANES;
        for (row, form) in rows[2 * storeys..].iter_mut().zip(forms) {
            let sums = form.displacement.values(&lanes);
            row[first..first + several.len()].copy_from_slice(&sums[..several.len()]);
        }
    }
    rows
}

/// What dashpots of links between floors add to the forces of storeys, over shapes as velocities \[N·s/m, N·s\]; empty without
/// any.
pub(super) fn of_dashpots(building: &BuildingSystem, modes: &RitzModes) -> Vec<Vec<f64>> {
    if building.inner_links.iter().all(|link| link.damping == 0.0) {
        return Vec::new();
    }
    let storeys = building.storeys.len();
    let mut rows = vec![vec![0.0; modes.vectors.len()]; 2 * storeys];
    let resting = vec![0.0; building.equations.len()];
    for (index, vector) in modes.vectors.iter().enumerate() {
        let link = |index: usize| {
            let link = &building.inner_links[index];
            link.damping * link.shortening.value(vector)
        };
        building.storeys.for_each(
            &resting,
            |_| 0.0,
            link,
            |storey, force| {
                rows[storey][index] = force.shear;
                rows[storeys + storey][index] = force.moment;
            },
        );
    }
    Arch::new().dispatch(Combine {
        rows,
        parts: &modes.parts,
    })
}

/// Rows over the shapes of Ritz modes.
pub(super) fn of_shapes(building: &BuildingSystem, modes: &RitzModes) -> Vec<Vec<f64>> {
    Arch::new().dispatch(Combine {
        rows: of_vectors(building, &modes.vectors),
        parts: &modes.parts,
    })
}

/// Combines values of vectors to those of shapes.
struct Combine<'a> {
    rows: Vec<Vec<f64>>,
    parts: &'a [Vec<f64>],
}

impl NullaryFnOnce for Combine<'_> {
    type Output = Vec<Vec<f64>>;

    #[inline(always)]
    fn call(self) -> Self::Output {
        let Self { rows, parts } = self;
        let mut of_shapes = Vec::with_capacity(rows.len());
        for row in rows {
            let mut shapes = Vec::with_capacity(parts.len());
            for parts in parts {
                shapes.push(simd::dot(parts, &row));
            }
            of_shapes.push(shapes);
        }
        of_shapes
    }
}
