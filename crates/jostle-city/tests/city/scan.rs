//! Damaged footprints of every format: refused or read, never a panic, never a number that is none. `JOSTLE_SCAN` sets how
//! many are tried, `JOSTLE_SEED` which.

use std::panic::{AssertUnwindSafe, catch_unwind};

use jostle_city::{Inventory, Neighbours, Plane, ReadOptions, blocks, example_city, write_tables};
use jostle_testkit::scan::{Dice, scanned};

#[test]
fn damaged_footprints_are_refused_or_read() {
    let folder = tempfile::tempdir().unwrap();
    let directory = folder.path();
    let map = directory.join("city.geojson");
    std::fs::write(&map, example_city(12, 3)).unwrap();
    let inventory = Inventory::read(&map, &ReadOptions::default()).unwrap();
    let found = Neighbours::within(&inventory.buildings, 0.5);
    write_tables(directory, &inventory, &found, &blocks(&found.pairs, 12)).unwrap();
    let mut csv = String::from("id,storeys,height,year,type,wkt\n");
    for building in &inventory.buildings {
        let ring = building
            .outline
            .exterior()
            .0
            .iter()
            .map(|at| format!("{:.3} {:.3}", at.x, at.y));
        let ring: Vec<String> = ring.collect();
        csv += &format!(
            "{},3,9.5,1950,C1,\"POLYGON(({}))\"\n",
            building.id,
            ring.join(", ")
        );
    }
    assert!(matches!(inventory.plane, Plane::Degrees { .. }));
    let originals = [
        ("geojson", std::fs::read(&map).unwrap()),
        (
            "parquet",
            std::fs::read(directory.join("buildings.parquet")).unwrap(),
        ),
        ("csv", csv.into_bytes()),
    ];
    let mut dice = Dice::new(54);
    let (mut read, mut refused) = (0, 0);
    for at in 0..scanned(300) {
        let (extension, bytes) = &originals[at % 3];
        let path = directory.join(format!("damaged.{extension}"));
        let damaged = dice.damage(bytes);
        std::fs::write(&path, &damaged).unwrap();
        let options = ReadOptions {
            metres: *extension == "csv",
            ..ReadOptions::default()
        };
        let done = catch_unwind(AssertUnwindSafe(|| {
            Inventory::read(&path, &options).map(|inventory| {
                let found = Neighbours::within(&inventory.buildings, 0.5);
                (inventory, found)
            })
        }));
        match done {
            Ok(Ok((inventory, found))) => {
                assert!(
                    inventory
                        .buildings
                        .iter()
                        .all(|building| building.area.is_finite() && building.area >= 20.0)
                );
                assert!(
                    found
                        .pairs
                        .iter()
                        .all(|pair| pair.distance.is_finite() && pair.normal.is_finite())
                );
                read += 1;
            }
            Ok(Err(error)) => {
                assert!(error.to_string().contains("damaged."), "{error}");
                refused += 1;
            }
            Err(_) => panic!("number {at}: a damaged .{extension} panics"),
        }
    }
    assert!(read > 0 && refused > 0, "{read} {refused}");
}
