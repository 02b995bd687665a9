//! Two rigid rectangles on an elastic half-space.

use std::f64::consts::PI;

use crate::linear::full_matrix::{FullMatrix, PivotedLu};
use crate::model::HalfSpace;

/// Patches along a side of a rectangle whose neighbour is near, and of others.
const PATCHES: [usize; 2] = [14, 10];

/// A rigid rectangle on the surface, its middle on the line of the row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rectangle {
    /// Along the row \[m\].
    pub(super) length: f64,
    /// Across the row \[m\].
    pub(super) width: f64,
}

/// What a unit force and a unit moment on one rectangle do to another \[m/N, rad/(N·m)\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Influence {
    /// Sway along the row, under a force along the row.
    pub(super) sway: f64,
    /// Rotation, counter-clockwise, under such a moment: negative, the neighbour tilts the other way.
    pub(super) rocking: f64,
}

/// Influence of two rectangles on each other, a clear distance apart along the row, > 0 \[m\] (theory, Eq. B24).
///
/// The rectangles are divided into patches that are narrower towards their edges, with constant traction each; their middles
/// move as rigid bodies. Displacements of the surface under a patch are those of J. Boussinesq (1885) and V. Cerruti (1882),
/// integrated in closed form (K. L. Johnson, 1985, Contact Mechanics, sections 3.2 and 3.6). Contact is smooth: sway causes
/// tractions along the row only, and rocking causes pressure only, without a vertical force. Tractions are symmetric about the
/// line of the row, so that patches on one side of it are enough.
pub(super) fn influence(soil: &HalfSpace, rectangles: [Rectangle; 2], distance: f64) -> Influence {
    let [left, right] = rectangles;
    let near = distance < 0.5 * left.length.max(right.length);
    let count = PATCHES[usize::from(!near)];
    let middles = [0.0, 0.5 * (left.length + right.length) + distance];
    let grids = [0, 1].map(|side| Grid::new(&rectangles[side], middles[side], count));
    let [rise, sway] = surface(&grids, soil.poisson_ratio);
    // Unit displacement or rotation of either rectangle.
    let motion = |side: usize, arm: &dyn Fn(f64) -> f64| {
        let displacements = |(index, grid): (usize, &Grid)| match index == side {
            true => grid.over_half(arm),
            false => grid.over_half(|_| 0.0),
        };
        grids
            .iter()
            .enumerate()
            .flat_map(displacements)
            .collect::<Vec<f64>>()
    };
    let unit = |side: usize| motion(side, &|_| 1.0);
    let turn = |side: usize| motion(side, &|x| x - middles[side]);
    let sway = rigid_flexibility(sway, &[unit(0), unit(1)], 2.0);
    let rocking = rigid_flexibility(rise, &[unit(0), turn(0), unit(1), turn(1)], 2.0);
    let scale = 2.0 * PI * soil.shear_modulus();
    Influence {
        sway: 0.5 * (sway[(0, 1)] + sway[(1, 0)]) / scale,
        rocking: 0.5 * (rocking[(1, 3)] + rocking[(3, 1)]) / scale,
    }
}

/// Edges of the patches of a rectangle along and across the row \[m\]: spaced like the projections of equal arcs.
struct Grid {
    edges: [Vec<f64>; 2],
}

impl Grid {
    /// `count` is even.
    fn new(rectangle: &Rectangle, middle: f64, count: usize) -> Self {
        let edges = |middle: f64, size: f64| {
            let arc = |index| PI * index as f64 / count as f64;
            let edge = |index| middle - 0.5 * size * libm::cos(arc(index));
            (0..=count).map(edge).collect()
        };
        let Rectangle { length, width } = *rectangle;
        Self {
            edges: [edges(middle, length), edges(0.0, width)],
        }
    }

    /// Middles of the patches along or across the row.
    fn centres(&self, axis: usize) -> impl Iterator<Item = f64> {
        self.edges[axis].windows(2).map(|w| 0.5 * (w[0] + w[1]))
    }

    /// Patches along a side.
    fn count(&self) -> usize {
        self.edges[0].len() - 1
    }

    /// A number that varies along the row only, at the patches on one side of its line.
    fn over_half(&self, of: impl Fn(f64) -> f64) -> Vec<f64> {
        let half = self.count() / 2;
        let along = self.centres(0);
        along.flat_map(|x| vec![of(x); half]).collect()
    }
}

/// 2πG times the displacements of the surface at patches on one side of the line of the row, under unit force on each of a patch and
/// its mirror image: the rise under pressure, (1 − ν) ∬ dA/R, and the displacement along the row under
/// traction along it, ∬ ((1 − ν)/R + ν x²/R³) dA, over the area.
fn surface(grids: &[Grid; 2], nu: f64) -> [FullMatrix; 2] {
    let count = grids[0].count();
    let half = count / 2;
    let n = 2 * count * half;
    let mut found = [0, 1].map(|_| FullMatrix::zeros(n, n));
    // Integrals from the corner of a quadrant, at every edge across the row, for two edges along it.
    let mut corners = vec![[[0.0; 2]; 2]; count + 1];
    for (at, seen) in grids.iter().enumerate() {
        for (i, x) in seen.centres(0).enumerate() {
            for (j, y) in seen.centres(1).take(half).enumerate() {
                let row = (at * count + i) * half + j;
                for (side, loaded) in grids.iter().enumerate() {
                    let [along, across] = &loaded.edges;
                    for k in 0..=count {
                        for (l, corner) in corners.iter_mut().enumerate() {
                            let (x, y) = (x - along[k], y - across[l]);
                            let (p, q) = (part(x, y), part(y, x));
                            *corner = [[(1.0 - nu) * (p + q), (1.0 - nu) * p + q], corner[0]];
                        }
                        if k == 0 {
                            continue;
                        }
                        for l in 0..half {
                            let patch = |l: usize, part: usize| {
                                let step = |l: usize| corners[l][1][part] - corners[l][0][part];
                                step(l) - step(l + 1)
                            };
                            let column = (side * count + k - 1) * half + l;
                            let area = (along[k] - along[k - 1]) * (across[l + 1] - across[l]);
                            for (part, matrix) in found.iter_mut().enumerate() {
                                let both = patch(l, part) + patch(count - 1 - l, part);
                                matrix[(row, column)] = both / area;
                            }
                        }
                    }
                }
            }
        }
    }
    found
}

/// x ln(y + R), up to what cancels between the corners of a rectangle.
fn part(x: f64, y: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x * libm::asinh(y / x.abs())
    }
}

/// Flexibility of rigid motions of patches with these displacements of the surface, each of which stands for `alike` patches.
fn rigid_flexibility(surface: FullMatrix, motions: &[Vec<f64>], alike: f64) -> FullMatrix {
    let surface = PivotedLu::new(surface);
    let count = motions.len();
    let mut stiffness = FullMatrix::zeros(count, count);
    for (column, motion) in motions.iter().enumerate() {
        let forces = surface.solve(motion);
        for (row, shape) in motions.iter().enumerate() {
            let sum: f64 = shape.iter().zip(&forces).map(|(s, f)| s * f).sum();
            stiffness[(row, column)] = alike * sum;
        }
    }
    let stiffness = PivotedLu::new(stiffness);
    let mut flexibility = FullMatrix::zeros(count, count);
    for column in 0..count {
        let mut unit = vec![0.0; count];
        unit[column] = 1.0;
        for (row, value) in stiffness.solve(&unit).into_iter().enumerate() {
            flexibility[(row, column)] = value;
        }
    }
    flexibility
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOIL: HalfSpace = HalfSpace {
        shear_wave_velocity: 200.0,
        density: 1800.0,
        poisson_ratio: 0.33,
        damping: 0.0,
    };

    fn square(length: f64, width: f64) -> Rectangle {
        Rectangle { length, width }
    }

    /// Flexibilities of two rectangles beside each other over every patch of both, one corner at a time: of sway, and of rise and
    /// rotation.
    fn whole(rectangles: [Rectangle; 2], distance: f64, count: usize) -> [FullMatrix; 2] {
        struct Patch {
            at: [f64; 2],
            half: [f64; 2],
        }
        let [left, right] = rectangles;
        let middles = [0.0, 0.5 * (left.length + right.length) + distance];
        let edge = |index: usize| -0.5 * libm::cos(PI * index as f64 / count as f64);
        let m = count * count;
        let patch = |index: usize| {
            let Rectangle { length, width } = rectangles[index / m];
            let of = |size: f64, index: usize| {
                let [from, to] = [edge(index), edge(index + 1)].map(|edge| size * edge);
                [0.5 * (from + to), 0.5 * (to - from)]
            };
            let [x, a] = of(length, index % m / count);
            let [y, b] = of(width, index % count);
            Patch {
                at: [middles[index / m] + x, y],
                half: [a, b],
            }
        };
        let all: Vec<Patch> = (0..2 * m).map(patch).collect();
        let surface = |corner: &dyn Fn(f64, f64) -> f64| {
            let mut surface = FullMatrix::zeros(2 * m, 2 * m);
            for (row, at) in all.iter().enumerate() {
                for (column, loaded) in all.iter().enumerate() {
                    let [x, y] = [0, 1].map(|k| at.at[k] - loaded.at[k]);
                    let [a, b] = loaded.half;
                    let sum = corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b)
                        + corner(x - a, y - b);
                    surface[(row, column)] = sum / (4.0 * a * b);
                }
            }
            surface
        };
        let nu = SOIL.poisson_ratio;
        let rise = surface(&|x, y| (1.0 - nu) * (part(x, y) + part(y, x)));
        let sway = surface(&|x, y| (1.0 - nu) * part(x, y) + part(y, x));
        let motion = |side: usize, arm: &dyn Fn(f64) -> f64| {
            let displacement = |(i, patch): (usize, &Patch)| match i / m == side {
                true => arm(patch.at[0] - middles[side]),
                false => 0.0,
            };
            all.iter()
                .enumerate()
                .map(displacement)
                .collect::<Vec<f64>>()
        };
        let unit = |side: usize| motion(side, &|_| 1.0);
        let turn = |side: usize| motion(side, &|x| x);
        [
            rigid_flexibility(sway, &[unit(0), unit(1)], 1.0),
            rigid_flexibility(rise, &[unit(0), turn(0), unit(1), turn(1)], 1.0),
        ]
    }

    /// Flexibilities of one of two equal rectangles, beside the other: sway and rocking.
    fn own(rectangle: Rectangle, distance: f64) -> [f64; 2] {
        let [sway, rocking] = whole([rectangle; 2], distance, 14);
        let scale = 2.0 * PI * SOIL.shear_modulus();
        [sway[(0, 0)] / scale, rocking[(1, 1)] / scale]
    }

    /// Patches on one side of the line of the row have the flexibilities of all patches; fewer patches between rectangles far
    /// apart cost less than 0.1 % of them.
    #[test]
    fn half_of_the_patches_are_enough() {
        let scale = 2.0 * PI * SOIL.shear_modulus();
        for (rectangles, distance) in [
            ([square(12.0, 12.0), square(12.0, 12.0)], 0.1),
            ([square(16.0, 8.0), square(10.0, 14.0)], 3.0),
            ([square(16.0, 8.0), square(10.0, 14.0)], 9.0),
            ([square(5.0, 5.0), square(5.0, 5.0)], 300.0),
        ] {
            let found = influence(&SOIL, rectangles, distance);
            let near = distance < 8.0;
            for (count, limit) in [(if near { 14 } else { 10 }, 1e-9), (14, 1e-3)] {
                let [sway, rocking] = whole(rectangles, distance, count);
                // Displacements at the middles of patches are not quite reciprocal.
                let mean = |matrix: &FullMatrix, i, j| 0.5 * (matrix[(i, j)] + matrix[(j, i)]);
                for (found, due) in [
                    (found.sway, mean(&sway, 0, 1)),
                    (found.rocking, mean(&rocking, 1, 3)),
                ] {
                    let error = found * scale / due - 1.0;
                    assert!(error.abs() < limit, "{distance} m, {count}: {error:e}");
                }
            }
        }
    }

    /// Ratios F₁₂/F₁₁ for ν = 0.33, computed independently with patches on the half-space and given with two digits.
    #[test]
    fn neighbours_influence_each_other_as_known() {
        for (length, width, distance, sway, rocking) in [
            (12.0, 12.0, 0.1, 0.57, Some(-0.27)),
            (12.0, 12.0, 3.0, 0.38, Some(-0.10)),
            (12.0, 12.0, 12.0, 0.22, Some(-0.02)),
            (16.0, 8.0, 0.1, 0.49, None),
            (16.0, 8.0, 3.0, 0.31, None),
            (16.0, 8.0, 12.0, 0.19, None),
            (8.0, 16.0, 0.1, 0.64, None),
            (8.0, 16.0, 3.0, 0.42, None),
            (8.0, 16.0, 12.0, 0.25, None),
        ] {
            let rectangle = square(length, width);
            let found = influence(&SOIL, [rectangle; 2], distance);
            let [of_sway, of_rocking] = own(rectangle, distance);
            let ratio = found.sway / of_sway;
            assert!(
                (ratio - sway).abs() < 0.011,
                "{length} x {width}, {distance} m: {ratio}"
            );
            if let Some(rocking) = rocking {
                let ratio = found.rocking / of_rocking;
                assert!((ratio - rocking).abs() < 0.006, "{distance} m: {ratio}");
            }
        }
    }

    /// Far away F₁₂ = 1/(2πGs) in sway and −(1 − ν)/(πGs³) in rocking.
    #[test]
    fn far_neighbours_feel_a_point_load() {
        let (a, b) = (square(12.0, 10.0), square(8.0, 16.0));
        let distance = 500.0;
        let s: f64 = distance + 10.0;
        let found = influence(&SOIL, [a, b], distance);
        let g = SOIL.shear_modulus();
        assert!((found.sway * 2.0 * PI * g * s - 1.0).abs() < 1e-3);
        assert!((found.rocking * PI * g * s.powi(3) / -0.67 - 1.0).abs() < 1e-3);
    }

    /// Stiffness of a rigid rectangle against torsion on patches with tractions in both directions \[N·m/rad\]: u_x =
    /// ∬ [((1 − ν)/R + ν x²/R³) t_x + ν x y/R³ t_y] dA/(2πG).
    fn torsional_stiffness([length, width]: [f64; 2], count: usize) -> f64 {
        let nu = SOIL.poisson_ratio;
        let grid = Grid::new(&square(length, width), 0.0, count);
        let [along, across] = &grid.edges;
        let centres = |axis: usize| grid.centres(axis).collect::<Vec<f64>>();
        let (xs, ys) = (centres(0), centres(1));
        let m = xs.len() * ys.len();
        let at = |index: usize| [xs[index / ys.len()], ys[index % ys.len()]];
        let mut surface = FullMatrix::zeros(2 * m, 2 * m);
        for seen in 0..m {
            let [x, y] = at(seen);
            for loaded in 0..m {
                let (i, j) = (loaded / ys.len(), loaded % ys.len());
                let area = (along[i + 1] - along[i]) * (across[j + 1] - across[j]);
                let over = |corner: &dyn Fn(f64, f64) -> f64| {
                    let at = |k: usize, l: usize| corner(x - along[k], y - across[l]);
                    (at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1)) / area
                };
                let both = over(&|x, y| -nu * libm::hypot(x, y));
                let entries = [
                    [over(&|x, y| (1.0 - nu) * part(x, y) + part(y, x)), both],
                    [both, over(&|x, y| (1.0 - nu) * part(y, x) + part(x, y))],
                ];
                for (row, entries) in entries.into_iter().enumerate() {
                    for (column, value) in entries.into_iter().enumerate() {
                        surface[(row * m + seen, column * m + loaded)] = value;
                    }
                }
            }
        }
        let turn: Vec<f64> = (0..2 * m)
            .map(|row| match row / m {
                0 => -at(row)[1],
                _ => at(row - m)[0],
            })
            .collect();
        let forces = PivotedLu::new(surface).solve(&turn);
        let moment: f64 = turn
            .iter()
            .zip(&forces)
            .map(|(arm, force)| arm * force)
            .sum();
        2.0 * PI * SOIL.shear_modulus() * moment
    }

    /// K = G B³ (4.25 q^2.45 + 4.06), which does not know of Poisson's ratio, is 3 to 8 % less than that of patches, whose error falls with
    /// the square of their number along a side.
    #[test]
    fn a_rectangle_turns_against_the_spring_of_the_formula() {
        for [length, width] in [[12.0, 12.0], [18.0, 12.0], [8.0, 16.0], [30.0, 10.0]] {
            let [few, many] = [8, 12].map(|count| torsional_stiffness([length, width], count));
            let found = many + (many - few) * 64.0 / (144.0 - 64.0);
            let foundation = crate::model::Foundation::rectangle(length, width, 1e5);
            let ratio = SOIL.torsional_stiffness(&foundation) / found;
            println!("{length} x {width}: {ratio}");
            assert!((0.92..0.98).contains(&ratio), "{length} x {width}: {ratio}");
        }
    }

    /// Springs of one rectangle alone are within 4 % of Pais and Kausel's.
    #[test]
    fn a_rectangle_alone_has_the_springs_of_the_formulas() {
        for [length, width] in [[12.0, 12.0], [16.0, 8.0], [8.0, 16.0]] {
            let [sway, rocking] = own(square(length, width), 1e4);
            let foundation = crate::model::Foundation::rectangle(length, width, 1e5);
            let formulas = SOIL.springs(&foundation, 1e6);
            let (sway, rocking) = (
                sway * formulas.sway_stiffness,
                rocking * formulas.rocking_stiffness,
            );
            assert!((sway - 1.0).abs() < 0.04, "{sway}");
            assert!((rocking - 1.0).abs() < 0.06, "{rocking}");
        }
    }
}
