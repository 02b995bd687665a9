//! Who stands beside whom, against what rectangles say in closed form.

use std::collections::BTreeSet;

use geo::{Area, Rect, coord};
use jostle_city::{
    Building, Inventory, Neighbours, Position, ReadOptions, blocks, example_city, rows,
};

/// A rectangle from a corner, with its width and depth.
fn rectangle(number: usize, [x, y, width, depth]: [f64; 4], storeys: usize) -> Building {
    let outline =
        Rect::new(coord! { x: x, y: y }, coord! { x: x + width, y: y + depth }).to_polygon();
    let outline = geo::Orient::orient(&outline, geo::orient::Direction::Default);
    Building {
        id: number.to_string(),
        row: number,
        area: outline.unsigned_area(),
        outline,
        storeys: Some(storeys),
        height: None,
        level: None,
        year: None,
        kind: None,
    }
}

#[test]
fn pairs_are_those_of_all_against_all() {
    // Rectangles strewn by a fixed rule: some touch, some overlap, most stand apart.
    let at = |n: usize, of: f64| (n as f64 * of).fract();
    let sizes: Vec<[f64; 4]> = (0..900)
        .map(|n| {
            [
                350.0 * at(n, 0.618_034),
                350.0 * at(n, 0.754_878),
                6.0 + 9.0 * at(n, 0.3247),
                6.0 + 6.0 * at(n, 0.5698),
            ]
        })
        .collect();
    let buildings: Vec<Building> = sizes
        .iter()
        .enumerate()
        .map(|(n, size)| rectangle(n, *size, 2))
        .collect();
    let found = Neighbours::within(&buildings, 0.5);
    let mut near = BTreeSet::new();
    let mut overlaps = BTreeSet::new();
    for a in 0..sizes.len() {
        for b in a + 1..sizes.len() {
            let [size, other] = [sizes[a], sizes[b]];
            let apart = |axis: usize| {
                (other[axis] - size[axis] - size[axis + 2])
                    .max(size[axis] - other[axis] - other[axis + 2])
            };
            let [x, y] = [apart(0), apart(1)];
            if x < 0.0 && y < 0.0 {
                let shared = |axis: usize| {
                    (size[axis] + size[axis + 2]).min(other[axis] + other[axis + 2])
                        - size[axis].max(other[axis])
                };
                if shared(0) * shared(1) > 0.2 * (size[2] * size[3]).min(other[2] * other[3]) {
                    overlaps.insert([a, b]);
                    continue;
                }
            }
            if x.max(0.0).hypot(y.max(0.0)) <= 0.5 {
                near.insert([a, b]);
            }
        }
    }
    assert!(
        near.len() > 100 && overlaps.len() > 20,
        "{} {}",
        near.len(),
        overlaps.len()
    );
    assert_eq!(
        found
            .pairs
            .iter()
            .map(|own| own.buildings)
            .collect::<BTreeSet<_>>(),
        near
    );
    assert_eq!(
        found.overlaps.iter().copied().collect::<BTreeSet<_>>(),
        overlaps
    );
}

#[test]
fn faces_normals_and_places_are_those_of_the_drawing() {
    // Three in a line with 0.2 m between them, the third set back by 4 m; a fourth touches only a corner.
    let buildings = [
        rectangle(0, [0.0, 0.0, 10.0, 12.0], 2),
        rectangle(1, [10.2, 0.0, 8.0, 12.0], 5),
        rectangle(2, [18.4, 4.0, 8.0, 12.0], 3),
        rectangle(3, [26.5, 16.1, 8.0, 8.0], 3),
    ];
    let found = Neighbours::within(&buildings, 0.5);
    let pairs = found.pairs;
    assert_eq!(pairs.len(), 3);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    close(pairs[0].distance, 0.2);
    close(pairs[0].face, 12.0);
    close(pairs[0].normal, 0.0);
    close(pairs[0].height_ratio, 0.4);
    close(pairs[0].floor_offset, 0.0);
    close(pairs[1].face, 8.0);
    assert_eq!(pairs[0].position, Position::End);
    assert_eq!(pairs[2].position, Position::Corner);
    close(pairs[2].distance, 0.1 * 2.0_f64.sqrt());
    let found = blocks(&pairs, buildings.len());
    assert_eq!(found.len(), 1);
    assert!(found[0].is_tree());
    let lines = rows(&found[0], &pairs, |pair| pairs[pair].distance);
    let buildings: Vec<_> = lines.iter().map(|line| line.buildings.clone()).collect();
    assert_eq!(buildings, [vec![0, 1, 2], vec![2, 3]]);
}

#[test]
fn the_example_has_the_statistics_of_a_dense_city_and_every_pair_is_in_one_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("city.geojson");
    std::fs::write(&path, example_city(20_000, 1)).unwrap();
    let inventory = Inventory::read(&path, &ReadOptions::default()).unwrap();
    assert_eq!(
        inventory.buildings.len(),
        20_000,
        "{:?}",
        inventory.mends.first()
    );
    let count = inventory.buildings.len();
    let found = Neighbours::within(&inventory.buildings, 0.5);
    assert!(found.overlaps.is_empty());
    let all = blocks(&found.pairs, count);
    let held: usize = all.iter().map(|block| block.buildings.len()).sum();
    let share = held as f64 / count as f64;
    assert!((share - 0.51).abs() < 0.03, "{share} have a neighbour");
    let mut sizes: Vec<usize> = all.iter().map(|block| block.buildings.len()).collect();
    sizes.sort_unstable();
    let quantile = |of: f64| sizes[(of * (sizes.len() - 1) as f64) as usize];
    assert!((5..=7).contains(&quantile(0.9)), "{}", quantile(0.9));
    assert!((10..=14).contains(&quantile(0.99)), "{}", quantile(0.99));
    let mut pairs: Vec<usize> = all
        .iter()
        .flat_map(|block| rows(block, &found.pairs, |pair| found.pairs[pair].distance))
        .inspect(|row| assert_eq!(row.pairs.len() + 1, row.buildings.len()))
        .flat_map(|row| row.pairs)
        .collect();
    pairs.sort_unstable();
    assert_eq!(pairs, (0..found.pairs.len()).collect::<Vec<_>>());
}

#[test]
fn neighbours_around_a_corner_stand_in_rows_of_their_own() {
    let buildings = [
        rectangle(0, [0.0, 0.0, 10.0, 10.0], 2),
        rectangle(1, [10.1, 0.0, 10.0, 10.0], 2),
        rectangle(2, [0.0, 10.1, 10.0, 10.0], 2),
    ];
    let pairs = Neighbours::within(&buildings, 0.12).pairs;
    let found = blocks(&pairs, buildings.len());
    let lines = rows(&found[0], &pairs, |pair| pair as f64);
    assert!(
        lines.iter().all(|own| own.buildings.len() == 2),
        "{lines:?}"
    );
}
