//! Where bars lie and what is symmetric, by hand.

use jostle_section::{Reinforcement, formula};

use crate::support::{close, column, section};

/// Distances from the left face and below the top of all bars of a description, sorted \[mm\].
fn places(bars: &str, width: f64, depth: f64) -> Vec<[i64; 2]> {
    let bars = Reinforcement::parse(bars).expect("understood");
    let bars = bars.lay(width, depth, 0.03);
    let millimetres = |length: f64| (1e4 * length).round() as i64;
    let mut places: Vec<_> = bars
        .iter()
        .map(|bar| [millimetres(bar.depth), millimetres(bar.x)])
        .collect();
    places.sort_unstable();
    places
}

/// 400 × 600 mm, axes 40 mm from the faces: of ten bars between the corners four go to top and bottom, by the share of the sides.
#[test]
fn bars_around_a_rectangle_are_shared_by_its_sides() {
    let mut due = Vec::new();
    for depth in [400, 5600] {
        due.extend([400, 1467, 2533, 3600].map(|x| [depth, x]));
    }
    for depth in [1700, 3000, 4300] {
        due.extend([400, 3600].map(|x| [depth, x]));
    }
    due.sort_unstable();
    assert_eq!(places("14 d20", 0.4, 0.6), due);
}

/// Bars of 12 mm at thirds of 528 mm, bars of 10 mm in the middle.
#[test]
fn every_group_at_the_sides_lies_evenly() {
    let found = places("2 d20 top, 2 d20 bottom, 4 d12 + 2 d10 sides", 0.4, 0.6);
    let due = [
        [400, 400],
        [400, 3600],
        [2120, 360],
        [2120, 3640],
        [3000, 350],
        [3000, 3650],
        [3880, 360],
        [3880, 3640],
        [5600, 400],
        [5600, 3600],
    ];
    assert_eq!(found, due);
}

#[test]
fn a_section_with_one_thicker_bar_is_not_symmetric() {
    let mut section = column();
    assert!(section.is_symmetric());
    section.bars[0].diameter = 0.025;
    assert!(!section.is_symmetric());
    section = column();
    section.bars[0].depth += 1e-3;
    assert!(!section.is_symmetric());
}

/// C60 (fck 38.5 MPa, cube strength 57.46): α₁ = 1 − 0.002 · 7.46 = 0.98507. 500 × 500 mm, 4 d25 (1963.5 mm²) at either face,
/// axes 42.5 mm from it, 2500 kN: x = 2 500 000/(0.98507 · 38.5 · 500) = 131.83 mm, and
/// M = 2 500 000 (250 − 65.92) + 400 · 1963.5 · 2 · 207.5 = 460.21 + 325.94 = 786.15 kN m.
#[test]
fn the_stress_block_of_strong_concrete_is_lower() {
    let mut section = section(0.5, 0.5, "4 d25 top, 4 d25 bottom");
    section.concrete.strength = 38.5e6;
    close(
        formula::ultimate_gb(&section, 2.5e6),
        786.15e3,
        1e-4,
        "moment",
    );
}
