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

/// Uniformly loaded part of a rectangle.
#[derive(Clone, Copy, Debug)]
struct Patch {
    at: [f64; 2],
    half: [f64; 2],
}

/// Influence of two rectangles on each other, a clear distance apart along the row, > 0 \[m\] (theory, Eq. B24).
///
/// The rectangles are divided into patches that are narrower towards their edges, with constant traction each; their middles
/// move as rigid bodies. Displacements of the surface under a patch are those of J. Boussinesq (1885) and V. Cerruti (1882),
/// integrated in closed form (K. L. Johnson, 1985, Contact Mechanics, sections 3.2 and 3.6). Contact is smooth: sway causes
/// tractions along the row only, and rocking causes pressure only, without a vertical force.
pub(super) fn influence(soil: &HalfSpace, rectangles: [Rectangle; 2], distance: f64) -> Influence {
    let [left, right] = rectangles;
    let near = distance < 0.5 * left.length.max(right.length);
    let count = PATCHES[usize::from(!near)];
    let middles = [0.0, 0.5 * (left.length + right.length) + distance];
    let patches: Vec<Patch> = rectangles
        .iter()
        .zip(middles)
        .flat_map(|(rectangle, middle)| patches(rectangle, middle, count))
        .collect();
    let own = |side: usize, index: usize| index / (count * count) == side;
    let nu = soil.poisson_ratio;
    // Sway: unit displacement of either rectangle.
    let unit = |side: usize| {
        let values = (0..patches.len()).map(|index| f64::from(u8::from(own(side, index))));
        values.collect::<Vec<f64>>()
    };
    let sway = rigid_flexibility(&patches, cerruti(nu), &[unit(0), unit(1)]);
    // Rise and rotation of either.
    let turn = |side: usize| {
        let values = patches.iter().enumerate();
        let arm = |(index, patch): (usize, &Patch)| match own(side, index) {
            true => patch.at[0] - middles[side],
            false => 0.0,
        };
        values.map(arm).collect::<Vec<f64>>()
    };
    let motions = [unit(0), turn(0), unit(1), turn(1)];
    let rocking = rigid_flexibility(&patches, boussinesq(nu), &motions);
    let scale = 2.0 * PI * soil.shear_modulus();
    Influence {
        sway: 0.5 * (sway[(0, 1)] + sway[(1, 0)]) / scale,
        rocking: 0.5 * (rocking[(1, 3)] + rocking[(3, 1)]) / scale,
    }
}

/// Patches of a rectangle: their edges are spaced like the projections of equal arcs.
fn patches(rectangle: &Rectangle, middle: f64, count: usize) -> Vec<Patch> {
    let edge = |index: usize| -0.5 * libm::cos(PI * index as f64 / count as f64);
    let centre = |index: usize| 0.5 * (edge(index) + edge(index + 1));
    let half = |index: usize| 0.5 * (edge(index + 1) - edge(index));
    let Rectangle { length, width } = *rectangle;
    (0..count * count)
        .map(|index| {
            let (i, j) = (index / count, index % count);
            Patch {
                at: [middle + length * centre(i), width * centre(j)],
                half: [length * half(i), width * half(j)],
            }
        })
        .collect()
}

/// 2πG times the rise of the surface at (x, y) from the corner of a quadrant under unit pressure, as an integral to be taken at
/// the corners of a patch: (1 − ν) ∬ dA/R.
fn boussinesq(nu: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| (1.0 - nu) * (part(x, y) + part(y, x))
}

/// The same of the displacement along x under unit traction along x: ∬ ((1 − ν)/R + ν x²/R³) dA.
fn cerruti(nu: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| (1.0 - nu) * part(x, y) + part(y, x)
}

/// x ln(y + R), up to what cancels between the corners of a rectangle.
fn part(x: f64, y: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x * libm::asinh(y / x.abs())
    }
}

/// Flexibility of rigid motions, times 2πG.
fn rigid_flexibility(
    patches: &[Patch],
    corner: impl Fn(f64, f64) -> f64,
    motions: &[Vec<f64>],
) -> FullMatrix {
    let n = patches.len();
    let mut surface = FullMatrix::zeros(n, n);
    for (row, at) in patches.iter().enumerate() {
        for (column, loaded) in patches.iter().enumerate() {
            let [x, y] = [0, 1].map(|k| at.at[k] - loaded.at[k]);
            let [a, b] = loaded.half;
            let sum = corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b)
                + corner(x - a, y - b);
            surface[(row, column)] = sum / (4.0 * a * b);
        }
    }
    let surface = PivotedLu::new(surface);
    let count = motions.len();
    let mut stiffness = FullMatrix::zeros(count, count);
    for (column, motion) in motions.iter().enumerate() {
        let forces = surface.solve(motion);
        for (row, shape) in motions.iter().enumerate() {
            let sum: f64 = shape.iter().zip(&forces).map(|(s, f)| s * f).sum();
            stiffness[(row, column)] = sum;
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

    /// Flexibilities of one of two equal rectangles, beside the other: sway and rocking.
    fn own(rectangle: Rectangle, distance: f64) -> [f64; 2] {
        let middles = [0.0, rectangle.length + distance];
        let count = 14;
        let all: Vec<Patch> = middles
            .iter()
            .flat_map(|middle| patches(&rectangle, *middle, count))
            .collect();
        let m = count * count;
        let unit = |side: usize| {
            (0..2 * m)
                .map(|i| f64::from(u8::from(i / m == side)))
                .collect::<Vec<f64>>()
        };
        let turn = |side: usize| {
            (0..2 * m)
                .map(|i| unit(side)[i] * (all[i].at[0] - middles[side]))
                .collect::<Vec<f64>>()
        };
        let sway = rigid_flexibility(&all, cerruti(0.33), &[unit(0), unit(1)]);
        let motions = [unit(0), turn(0), unit(1), turn(1)];
        let rocking = rigid_flexibility(&all, boussinesq(0.33), &motions);
        let scale = 2.0 * PI * SOIL.shear_modulus();
        [sway[(0, 0)] / scale, rocking[(1, 1)] / scale]
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
