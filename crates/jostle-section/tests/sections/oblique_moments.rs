//! Moment capacity about both axes at once, against squares of concrete in equilibrium, against four bars by hand, and against the
//! formula of EN 1992-1-1, 5.8.9(4).

use std::f64::consts::{FRAC_PI_2, PI};

use jostle::model::MomentSurface;
use jostle_section::capacity::{Interaction, ObliqueInteraction};
use jostle_section::{Concrete, ConcreteLaw, Reinforcement, Section, Steel, StrengthLevel};

fn section(bars: &str, width: f64, depth: f64) -> Section {
    let concrete = Concrete::grade("C30", StrengthLevel::Characteristic).expect("known");
    let steel = Steel::grade("HRB400", StrengthLevel::Characteristic).expect("known");
    let bars = Reinforcement::parse(bars).expect("understood");
    let mut section = Section::new(width, depth, concrete, steel, &bars, 0.03, None);
    let section = section.as_mut().expect("sound");
    section.steel.hardening = 0.0;
    section.clone()
}

fn planes(section: &Section) -> [[Interaction; 2]; 2] {
    [section, &section.turned()].map(Interaction::of_both_signs)
}

fn surface(section: &Section) -> MomentSurface {
    ObliqueInteraction::new(section, &planes(section)).surface(|_| 1.0)
}

/// Length of the moment in a direction, from the plane of the depth towards that across, that the surface bears.
fn capacity(surface: &MomentSurface, compression: f64, angle: f64) -> f64 {
    let small = [angle.cos(), angle.sin()];
    1.0 / surface.ratio(compression, small)
}

/// Compression and both moments of a section in squares: the strain at its middle and the curvatures that compress the top and the
/// left.
fn sums(section: &Section, middle: f64, curvatures: [f64; 2]) -> [f64; 3] {
    const SQUARES: usize = 36;
    let law = ConcreteLaw::unconfined(&section.concrete);
    let mut sum = [0.0; 3];
    let mut add = |force: f64, [u, v]: [f64; 2]| {
        sum[0] += force;
        sum[1] += force * u;
        sum[2] += force * v;
    };
    let strain = |[u, v]: [f64; 2]| middle + curvatures[0] * u + curvatures[1] * v;
    let compressed = |strain: f64| {
        if strain > 0.0 {
            law.stress(strain)
        } else {
            0.0
        }
    };
    let area = section.area() / (SQUARES * SQUARES) as f64;
    for row in 0..SQUARES {
        for column in 0..SQUARES {
            let share = |number: usize| 0.5 - (number as f64 + 0.5) / SQUARES as f64;
            let at = [share(row) * section.depth, share(column) * section.width];
            add(area * compressed(strain(at)), at);
        }
    }
    for bar in &section.bars {
        let at = [0.5 * section.depth - bar.depth, 0.5 * section.width - bar.x];
        let strain = strain(at);
        let fy = section.steel.yield_strength;
        let steel = (section.steel.modulus * strain).clamp(-fy, fy);
        add(bar.area() * (steel - compressed(strain)), at);
    }
    sum
}

/// Greatest moments in equilibrium with a compression for a direction of the curvature: for every strain of the outermost corner the
/// curvature by bisection, with bars no further than 0.01.
fn in_equilibrium(section: &Section, compression: f64, angle: f64) -> Vec<[f64; 2]> {
    let crushing = ConcreteLaw::unconfined(&section.concrete).crushing_strain;
    // Equal angles of shares of depth and width.
    let direction = [angle.cos() / section.depth, angle.sin() / section.width];
    let reach = 0.5 * (angle.cos().abs() + angle.sin().abs());
    let project = |u: f64, v: f64| direction[0] * u + direction[1] * v;
    let bars = section.bars.iter();
    let farthest = bars
        .map(|bar| reach - project(0.5 * section.depth - bar.depth, 0.5 * section.width - bar.x));
    let farthest = farthest.fold(0.0, f64::max);
    let mut found = Vec::new();
    for step in 1..=24 {
        let corner = crushing * f64::from(step) / 24.0;
        let state = |curvature: f64| {
            let middle = corner - curvature * reach;
            sums(section, middle, direction.map(|share| share * curvature))
        };
        // The greater the curvature, the smaller the compression.
        let (mut low, mut high) = (0.0, (corner + 0.01) / farthest);
        if state(low)[0] < compression || state(high)[0] > compression {
            continue;
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if state(middle)[0] > compression {
                low = middle;
            } else {
                high = middle;
            }
        }
        let [_, along, across] = state(low);
        found.push([along, across]);
    }
    found
}

#[test]
fn the_surface_is_that_of_squares_in_equilibrium() {
    let mut worst = 0.0_f64;
    for (bars, width, depth) in [
        ("12 d20", 0.5, 0.5),
        ("10 d25", 0.3, 0.6),
        ("3 d16 top, 4 d25 bottom, 4 d12 sides", 0.4, 0.6),
    ] {
        let section = section(bars, width, depth);
        let surface = surface(&section);
        let [_, most] = Interaction::new(&section).range();
        let halves = if section.is_symmetric() { 1 } else { 2 };
        for share in [0.0, 0.2, 0.45] {
            let compression = share * most;
            let angles: Vec<f64> = (0..=24 * halves)
                .map(|step| FRAC_PI_2 * f64::from(step) / 24.0)
                .collect();
            let points: Vec<[f64; 2]> = angles
                .iter()
                .flat_map(|angle| in_equilibrium(&section, compression, *angle))
                // The left is as the right, and the bottom as the top where bars are even.
                .flat_map(|[x, y]| [[x, y], [x, -y]])
                .flat_map(|[x, y]| match section.is_symmetric() {
                    true => vec![[x, y], [-x, y]],
                    false => vec![[x, y]],
                })
                .collect();
            // What lies inside of every straight line that touches the points.
            let reach = |towards: f64| {
                let ahead = points
                    .iter()
                    .map(|[x, y]| x * towards.cos() + y * towards.sin());
                ahead.fold(0.0_f64, f64::max)
            };
            let touching: Vec<(f64, f64)> = (0..720)
                .map(|step| f64::from(step) * PI / 360.0)
                .map(|towards| (towards, reach(towards)))
                .collect();
            for step in 0..=12 * halves {
                let angle = FRAC_PI_2 * f64::from(step) / 12.0;
                let ahead = touching.iter().filter_map(|(towards, reach)| {
                    let share = (angle - towards).cos();
                    (share > 1e-3).then(|| reach / share)
                });
                let due = ahead.fold(f64::INFINITY, f64::min);
                let found = capacity(&surface, compression, angle);
                let off = found / due - 1.0;
                worst = worst.max(off.abs());
                assert!(
                    (-0.012..0.006).contains(&off),
                    "{bars}, {share}, {angle}: {found} for {due}, {off}"
                );
            }
        }
    }
    println!("{worst}");
}

/// Without concrete two bars on either side of the neutral axis yield: M/(2 F a) + M′/(2 F a′) = 1 with the distances of bars a and
/// a′, whatever the direction.
#[test]
fn four_bars_alone_bear_moments_on_straight_lines() {
    for (width, depth) in [(0.5, 0.5), (0.3, 0.6)] {
        let mut section = section("4 d25", width, depth);
        section.concrete.strength = 1.0;
        let surface = surface(&section);
        let force = section.bars[0].area() * section.steel.yield_strength;
        let apart = [depth, width].map(|side| side - 2.0 * (0.03 + 0.0125));
        for step in 0..64 {
            let angle = f64::from(step) * PI / 32.0;
            let shares = [angle.cos() / apart[0], angle.sin() / apart[1]];
            let due = 2.0 * force / (shares[0].abs() + shares[1].abs());
            let found = capacity(&surface, 0.0, angle);
            assert!(
                (found / due - 1.0).abs() < 1e-6,
                "{angle}: {found} for {due}"
            );
        }
    }
}

/// In the plane of its depth, and of its width where the bars are even, it bears what bending in one plane gives.
#[test]
fn bending_in_one_plane_is_a_part_of_it() {
    let section = section("10 d25", 0.3, 0.6);
    let (surface, planes) = (surface(&section), planes(&section));
    let [least, most] = planes[0][0].range();
    for step in 1..200 {
        let compression = least + (most - least) * f64::from(step) / 200.0;
        for (axis, plane) in planes.iter().enumerate() {
            for (sign, curve) in [1.0, -1.0].into_iter().zip(plane) {
                let mut moments = [0.0; 2];
                moments[axis] = 0.9 * sign * curve.moment(compression);
                let found = surface.ratio(compression, moments);
                assert!(
                    (found / 0.9 - 1.0).abs() < 1e-9,
                    "{axis} {sign}: {found} at {compression}"
                );
            }
        }
    }
}

/// The section turned by a quarter bears the same with both moments exchanged.
#[test]
fn a_turned_section_bears_turned_moments() {
    let uneven = section("3 d16 top, 4 d25 bottom, 4 d12 sides", 0.4, 0.6);
    let even = section("10 d25", 0.3, 0.6);
    for (section, tolerance) in [(&even, 2e-3), (&uneven, 2e-2)] {
        let [one, other] = [surface(section), surface(&section.turned())];
        for step in 0..48 {
            let angle = f64::from(step) * PI / 24.0;
            for compression in [-2e5, 0.0, 8e5, 2e6] {
                let found = capacity(&other, compression, angle);
                let due = capacity(&one, compression, FRAC_PI_2 - angle);
                assert!(
                    (found / due - 1.0).abs() < tolerance,
                    "{angle}, {compression}: {found} for {due}"
                );
            }
        }
    }
}

/// EN 1992-1-1, 5.8.9(4): (M/MR)^a + (M′/MR′)^a ≤ 1 with a = 1, 1.5, 2 for N over its greatest value of 0.1, 0.7, 1. It is a simple
/// rule on the safe side.
#[test]
fn the_formula_of_en_1992_lies_inside() {
    for (bars, width, depth) in [("12 d20", 0.5, 0.5), ("10 d25", 0.3, 0.6)] {
        let section = section(bars, width, depth);
        let (surface, planes) = (surface(&section), planes(&section));
        let most = section.area() * section.concrete.strength
            + section.steel_area() * section.steel.yield_strength;
        for share in [0.0, 0.1, 0.3, 0.5, 0.7] {
            let compression = share * most;
            let exponent = 1.0 + 0.5 * ((share - 0.1) / 0.6).clamp(0.0, 1.0);
            let moment = [&planes[0][0], &planes[1][0]].map(|plane| plane.moment(compression));
            for step in 0..=10 {
                let part = f64::from(step) / 10.0;
                let moments = [
                    moment[0] * part.powf(1.0 / exponent),
                    moment[1] * (1.0 - part).powf(1.0 / exponent),
                ];
                let ratio = surface.ratio(compression, moments);
                assert!(
                    (0.6..1.0 + 1e-9).contains(&ratio),
                    "{bars}, {share}, {part}: {ratio}"
                );
            }
        }
    }
}
