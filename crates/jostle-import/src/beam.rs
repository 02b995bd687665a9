//! Stiffness of a straight member in space, with shear, released ends and stiff lengths.

use crate::section::Rigidity;

/// Stiffness between the displacements and turns of two joints, X, Y, Z and about them.
pub(crate) type Stiffness = [[f64; 12]; 12];

/// A straight piece between two joints.
pub(crate) struct Beam {
    /// Joints \[m\].
    pub(crate) ends: [[f64; 3]; 2],
    /// Turn of axes 2 and 3 about axis 1 \[degrees\].
    pub(crate) angle: f64,
    pub(crate) rigidity: Rigidity,
    /// What each end does not pass on, in local axes.
    pub(crate) releases: [[bool; 6]; 2],
    /// Lengths that do not bend \[m\].
    pub(crate) stiff_ends: [f64; 2],
}

impl Beam {
    /// In global axes; `None` if no length is left to bend.
    pub(crate) fn stiffness(&self) -> Option<Stiffness> {
        let [a, b] = self.ends;
        let along = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let distance = norm(along);
        let length = distance - self.stiff_ends[0] - self.stiff_ends[1];
        if length.is_nan() || length <= 1e-3 * distance {
            return None;
        }
        let axes = axes(along.map(|component| component / distance), self.angle);
        let mut local = flexible(&self.rigidity, length);
        let sizes: [f64; 12] = std::array::from_fn(|index| local[index][index].sqrt());
        for (end, releases) in self.releases.iter().enumerate() {
            for place in (0..6).filter(|index| releases[*index]) {
                release(&mut local, 6 * end + place);
            }
        }
        // What releases leave by rounding would hold a mechanism.
        for (row, size) in local.iter_mut().zip(sizes) {
            for (row, other) in row.iter_mut().zip(sizes) {
                if row.abs() < 1e-12 * size * other {
                    *row = 0.0;
                }
            }
        }
        // Joints to the flexible ends, in local axes: a stiff length a turns the end across by a θ.
        let mut to_ends = [[0.0; 12]; 12];
        for (end, arm) in [self.stiff_ends[0], -self.stiff_ends[1]]
            .into_iter()
            .enumerate()
        {
            let base = 6 * end;
            for row in 0..3 {
                for axis in 0..3 {
                    to_ends[base + row][base + axis] = axes[row][axis];
                    to_ends[base + 3 + row][base + 3 + axis] = axes[row][axis];
                }
            }
            for axis in 0..3 {
                to_ends[base + 1][base + 3 + axis] = arm * axes[2][axis];
                to_ends[base + 2][base + 3 + axis] = -arm * axes[1][axis];
            }
        }
        let mut half = [[0.0; 12]; 12];
        for (row, half) in half.iter_mut().enumerate() {
            for (column, value) in half.iter_mut().enumerate() {
                *value = (0..12).map(|k| local[row][k] * to_ends[k][column]).sum();
            }
        }
        let mut global = [[0.0; 12]; 12];
        for (row, global) in global.iter_mut().enumerate() {
            for (column, value) in global.iter_mut().enumerate() {
                *value = (0..12).map(|k| to_ends[k][row] * half[k][column]).sum();
            }
        }
        Some(global)
    }
}

fn norm(vector: [f64; 3]) -> f64 {
    vector
        .iter()
        .map(|vector| vector * vector)
        .sum::<f64>()
        .sqrt()
}

/// Axes 1, 2 and 3: 2 lies in the vertical plane through 1, along X where 1 is vertical; then both turn about 1.
fn axes(one: [f64; 3], angle: f64) -> [[f64; 3]; 3] {
    // As the sources have it: vertical is what is off by less than a thousandth.
    let vertical = one[0].hypot(one[1]) < 1e-3;
    let aim = if vertical {
        [1.0, 0.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let share: f64 = (0..3).map(|axis| aim[axis] * one[axis]).sum();
    let two = [0, 1, 2].map(|axis| aim[axis] - share * one[axis]);
    let size = norm(two);
    let two = two.map(|component| component / size);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let three = cross(one, two);
    let (sin, cos) = angle.to_radians().sin_cos();
    let turned = [0, 1, 2].map(|axis| cos * two[axis] + sin * three[axis]);
    [one, turned, cross(one, turned)]
}

/// Local stiffness of a flexible length.
fn flexible(
    [axial, shear_2, shear_3, torsion, bend_2, bend_3]: &Rigidity,
    length: f64,
) -> Stiffness {
    let mut matrix = [[0.0; 12]; 12];
    let mut add = |a: usize, b: usize, value: f64| {
        matrix[a][b] += value;
        if a != b {
            matrix[b][a] += value;
        }
    };
    for (place, value) in [(0, axial / length), (3, torsion / length)] {
        add(place, place, value);
        add(place + 6, place + 6, value);
        add(place, place + 6, -value);
    }
    // Across along 2 with turns about 3, and along 3 with turns about 2, which have the other sign.
    for (across, turn, bend, shear, sign) in [
        (1, 5, *bend_3, *shear_2, 1.0),
        (2, 4, *bend_2, *shear_3, -1.0),
    ] {
        let softer = match shear > 0.0 {
            true => 12.0 * bend / (shear * length * length),
            false => 0.0,
        };
        let unit = bend / (length * (1.0 + softer));
        let (force, mixed) = (12.0 * unit / (length * length), sign * 6.0 * unit / length);
        let (near, far) = ((4.0 + softer) * unit, (2.0 - softer) * unit);
        add(across, across, force);
        add(across + 6, across + 6, force);
        add(across, across + 6, -force);
        for end in [turn, turn + 6] {
            add(across, end, mixed);
            add(across + 6, end, -mixed);
            add(end, end, near);
        }
        add(turn, turn + 6, far);
    }
    matrix
}

/// Frees a displacement of an end: it carries no force.
fn release(matrix: &mut Stiffness, place: usize) {
    let row = matrix[place];
    let pivot = row[place];
    // Rounding of what the other end freed already.
    if pivot > 1e-9 * row.iter().map(|row| row.abs()).fold(0.0, f64::max) {
        for (index, factor) in row.iter().enumerate() {
            for other in 0..12 {
                matrix[index][other] -= factor * row[other] / pivot;
            }
        }
    }
    for index in 0..12 {
        matrix[place][index] = 0.0;
        matrix[index][place] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGIDITY: Rigidity = [3e9, 1e9, 8e8, 5e7, 1e8, 2e8];

    fn beam(ends: [[f64; 3]; 2]) -> Beam {
        Beam {
            ends,
            angle: 0.0,
            rigidity: RIGIDITY,
            releases: [[false; 6]; 2],
            stiff_ends: [0.0; 2],
        }
    }

    /// Displacement of the free end of a cantilever under a force at it.
    fn tip(beam: &Beam, place: usize) -> [f64; 6] {
        let k = beam.stiffness().unwrap();
        let mut rows: Vec<Vec<f64>> = (6..12)
            .map(|row| {
                let mut stiffness = k[row][6..].to_vec();
                stiffness.push(if row == 6 + place { 1e3 } else { 0.0 });
                stiffness
            })
            .collect();
        for i in 0..6 {
            let pivot = rows[i].clone();
            for (j, row) in rows
                .iter_mut()
                .enumerate()
                .filter(|candidate| candidate.0 != i)
            {
                let factor = row[i] / pivot[i];
                let _ = j;
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(row, pivot)| *row -= factor * pivot);
            }
        }
        [0, 1, 2, 3, 4, 5].map(|row| rows[row][6] / rows[row][row])
    }

    /// F L³/3EI + F L/GA, along the axis F L/EA, in every position.
    #[test]
    fn cantilevers() {
        let (length, force) = (4.0_f64, 1e3);
        let bent = |bend: f64, shear: f64| force * (length.powi(3) / (3.0 * bend) + length / shear);
        let near = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-11, "{found} {expected}");
        };
        let column = beam([[1.0, 2.0, 0.0], [1.0, 2.0, length]]);
        // Axis 2 of a column is X.
        near(tip(&column, 0)[0], bent(2e8, 1e9));
        near(tip(&column, 1)[1], bent(1e8, 8e8));
        near(tip(&column, 2)[2], force * length / 3e9);
        near(tip(&column, 5)[5], force * length / 5e7);
        let turned = Beam {
            angle: 90.0,
            ..beam(column.ends)
        };
        near(tip(&turned, 1)[1], bent(2e8, 1e9));
        // Axis 2 of a beam is Z, whatever its direction in plan.
        let beam = beam([[0.0; 3], [0.6 * length, 0.8 * length, 0.0]]);
        near(tip(&beam, 2)[2], bent(2e8, 1e9));
        let along = tip(&beam, 0);
        near(0.6 * along[0] + 0.8 * along[1], 0.6 * force * length / 3e9);
        near(-0.8 * along[0] + 0.6 * along[1], -0.8 * bent(1e8, 8e8));
    }

    /// A stiff length at the tip of a cantilever moves it by w + a φ and turns under the moment F a; one at the foot shortens it.
    #[test]
    fn stiff_lengths_and_releases() {
        let (length, arm, force) = (4.0_f64, 1.0, 1e3);
        let mut cantilever = beam([[0.0; 3], [length + arm, 0.0, 0.0]]);
        let (bend, shear) = (2e8, 1e9);
        cantilever.stiff_ends = [arm, 0.0];
        let foot = force * (length.powi(3) / (3.0 * bend) + length / shear);
        assert!((tip(&cantilever, 2)[2] / foot - 1.0).abs() < 1e-11);
        cantilever.stiff_ends = [0.0, arm];
        let (l, a) = (length, arm);
        let end =
            force * (l.powi(3) / (3.0 * bend) + l / shear + a * l * l / bend + a * a * l / bend);
        assert!((tip(&cantilever, 2)[2] / end - 1.0).abs() < 1e-11);
        // Hinged at its foot, it has no stiffness against a force at its tip.
        cantilever = beam(cantilever.ends);
        cantilever.releases[0][5] = true;
        let k = cantilever.stiffness().unwrap();
        let l = length + arm;
        let moved: f64 = k[8][8] - k[8][10] * k[10][8] / k[10][10];
        assert!(moved.abs() < 1e-9 * k[8][8]);
        // Hinged at both ends, only its length counts.
        cantilever.releases = [
            [false, false, false, true, true, true],
            [false, false, false, false, true, true],
        ];
        let k = cantilever.stiffness().unwrap();
        assert!((k[0][0] * l / 3e9 - 1.0).abs() < 1e-12);
        assert!((1..6).all(|place| k[place].iter().all(|value| value.abs() < 1e-6)));
        cantilever.stiff_ends = [3.0, 3.0];
        assert!(cantilever.stiffness().is_none());
    }
}
