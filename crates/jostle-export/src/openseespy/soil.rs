//! The matrices of the soil over displacements and rotations of all foundations, as springs.

use jostle::System;
use jostle::system::FoundationPlace;

/// Entries smaller than this beside the diagonal are rounding \[–\].
const ROUNDING: f64 = 1e-12;

/// A symmetric matrix over u and θ of every foundation, from left to right.
pub(super) struct Matrix(Vec<Vec<f64>>);

/// A spring and a dashpot, by the foundations that they join.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SoilSpring {
    /// From the ground to the displacement of a foundation.
    Sway(usize),
    /// From the ground to its rotation.
    Rocking(usize),
    /// Between two foundations, in a direction of OpenSees.
    Between([usize; 2], usize),
    /// Deformed by the displacement of a foundation, by its rotation times the length of a lever, and by the displacement of another
    /// foundation or of the ground: u_other − u + lθ.
    Lever(usize, Option<usize>),
}

impl SoilSpring {
    /// Degrees of freedom and their shares in the deformation.
    fn shares(self, lever: f64) -> Vec<(usize, f64)> {
        match self {
            Self::Sway(at) => vec![(2 * at, 1.0)],
            Self::Rocking(at) => vec![(2 * at + 1, 1.0)],
            Self::Between([left, right], direction) => {
                let component = usize::from(direction == ROTATION);
                vec![(2 * left + component, 1.0), (2 * right + component, -1.0)]
            }
            Self::Lever(at, other) => {
                let mut shares = vec![(2 * at, -1.0), (2 * at + 1, lever)];
                shares.extend(other.map(|other| (2 * other, 1.0)));
                shares
            }
        }
    }
}

/// Displacement and rotation, as directions of OpenSees.
const DISPLACEMENT: usize = 1;
const ROTATION: usize = 6;

impl Matrix {
    /// Stiffness and damping of the soil: what every foundation has for itself, and what is between two of them.
    pub(super) fn of_soil(system: &System) -> [Self; 2] {
        let places: Vec<FoundationPlace> = system
            .buildings
            .iter()
            .filter_map(|building| building.foundation)
            .collect();
        let n = 2 * places.len();
        let mut sums = [vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]];
        for (at, place) in places.iter().enumerate() {
            let [uu, ut, tt] = place.own_stiffness;
            // Contact springs hold one that lifts off against rotation.
            let own_stiffness = match place.foundation.uplift {
                Some(_) => [uu, 0.0, 0.0],
                None => [uu, ut, tt],
            };
            let coefficients = [own_stiffness, place.own_damping];
            for (sum, [uu, ut, tt]) in sums.iter_mut().zip(coefficients) {
                sum[2 * at][2 * at] += uu;
                sum[2 * at][2 * at + 1] += ut;
                sum[2 * at + 1][2 * at] += ut;
                sum[2 * at + 1][2 * at + 1] += tt;
            }
        }
        let number = |dof: usize| {
            places.iter().enumerate().find_map(|(at, place)| {
                let dofs = [place.sway, Some(place.turning)];
                let component = dofs.iter().position(|candidate| *candidate == Some(dof))?;
                Some(2 * at + component)
            })
        };
        for link in &system.links[system.model_links().len()..] {
            let sides = link.ports.sides();
            let row: Vec<(usize, f64)> = sides
                .flat_map(|(port, sign)| {
                    let entries = port.row.entries().to_vec();
                    entries
                        .into_iter()
                        .map(move |(dof, share)| (dof, sign * share))
                })
                .filter_map(|(dof, share)| Some((number(dof)?, share)))
                .collect();
            for (sum, size) in sums.iter_mut().zip([link.stiffness, link.damping]) {
                for &(i, of_i) in &row {
                    for &(j, of_j) in &row {
                        sum[i][j] += size * of_i * of_j;
                    }
                }
            }
        }
        sums.map(Self)
    }

    fn take(&mut self, size: f64, shares: &[(usize, f64)]) {
        for &(i, of_i) in shares {
            for &(j, of_j) in shares {
                self.0[i][j] -= size * of_i * of_j;
            }
        }
    }

    /// An entry, zero where it is rounding.
    fn entry(&self, i: usize, j: usize) -> f64 {
        let scale = (self.0[i][i] * self.0[j][j]).abs().sqrt();
        let value = self.0[i][j];
        if value.abs() <= ROUNDING * scale {
            0.0
        } else {
            value
        }
    }
}

/// Springs and dashpots that add up to the matrices, with their stiffness and damping; levers have a length \[m\].
pub(super) fn springs_of(
    stiffness: Matrix,
    damping: Matrix,
    lever: f64,
) -> Vec<(SoilSpring, [f64; 2])> {
    let count = stiffness.0.len() / 2;
    let mut matrices = [stiffness, damping];
    let mut found = Vec::new();
    // Every one takes an entry beside the diagonal, and changes only entries that are taken later.
    let mut take = |spring: SoilSpring, [i, j]: [usize; 2]| {
        let shares = spring.shares(lever);
        let of = |dof: usize| {
            shares
                .iter()
                .find(|(candidate, _)| *candidate == dof)
                .map_or(0.0, |share| share.1)
        };
        let scale = of(i) * of(j);
        let sizes = matrices.each_mut().map(|matrix| {
            let size = matrix.entry(i, j) / scale;
            matrix.take(size, &shares);
            size
        });
        if sizes != [0.0; 2] {
            found.push((spring, sizes));
        }
    };
    let pairs = || (0..count).flat_map(move |right| (0..right).map(move |left| [left, right]));
    for [left, right] in pairs() {
        take(
            SoilSpring::Lever(left, Some(right)),
            [2 * left + 1, 2 * right],
        );
        take(
            SoilSpring::Lever(right, Some(left)),
            [2 * left, 2 * right + 1],
        );
    }
    for at in 0..count {
        take(SoilSpring::Lever(at, None), [2 * at, 2 * at + 1]);
    }
    for [left, right] in pairs() {
        take(
            SoilSpring::Between([left, right], DISPLACEMENT),
            [2 * left, 2 * right],
        );
        take(
            SoilSpring::Between([left, right], ROTATION),
            [2 * left + 1, 2 * right + 1],
        );
    }
    for at in 0..count {
        take(SoilSpring::Sway(at), [2 * at; 2]);
        take(SoilSpring::Rocking(at), [2 * at + 1; 2]);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Springs give back every entry of matrices with all entries, those of dashpots apart.
    #[test]
    fn springs_add_up_to_the_matrices() {
        let stiffness = [
            [4.0, 0.6, -2.2, 0.3, 0.1, -0.2],
            [0.6, 9.0, 0.4, 1.9, 0.0, 0.7],
            [-2.2, 0.4, 3.5, -0.2, -0.8, 0.2],
            [0.3, 1.9, -0.2, 8.0, 0.15, 1.1],
            [0.1, 0.0, -0.8, 0.15, 5.0, 0.45],
            [-0.2, 0.7, 0.2, 1.1, 0.45, 7.0],
        ];
        let mut damping = [[0.0; 6]; 6];
        (damping[0][0], damping[3][3]) = (0.4, 0.9);
        let matrix = |rows: [[f64; 6]; 6]| Matrix(rows.iter().map(|row| row.to_vec()).collect());
        for lever in [1.0, 2.5] {
            let springs = springs_of(matrix(stiffness), matrix(damping), lever);
            let mut left = [matrix(stiffness), matrix(damping)];
            for (spring, sizes) in &springs {
                for (matrix, size) in left.iter_mut().zip(sizes) {
                    matrix.take(*size, &spring.shares(lever));
                }
            }
            let rest = left.iter().flat_map(|matrix| matrix.0.iter().flatten());
            let worst = rest.fold(0.0, |worst: f64, value| worst.max(value.abs()));
            assert!(worst < 1e-14, "{worst}: {springs:?}");
            assert_eq!(
                springs
                    .iter()
                    .filter(|(_, [_, dashpot])| *dashpot != 0.0)
                    .count(),
                2
            );
        }
    }
}
