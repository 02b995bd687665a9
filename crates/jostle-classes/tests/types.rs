//! Tables of types of a user's own.

use std::fmt::Write;
use std::path::PathBuf;

use jostle_batch::Building;
use jostle_classes::{Level, Types};
use jostle_io::TypesTables;

const COLUMNS: &str =
    "type,dy_mm,ay_g,du_mm,au_g,storeys_typical,storey_height_m,slight,moderate,extensive,complete";

/// Types of the texts of two tables, in a folder of their own.
fn types(table: &str, damage: &str) -> Result<Types, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| -> Option<PathBuf> {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file");
        Some(path).filter(|_| !text.is_empty())
    };
    Types::read(&TypesTables {
        types: file("types.csv", table),
        damage: file("damage.csv", damage),
        ..TypesTables::default()
    })
}

/// First period of a chain of storeys \[s\], by bisection: below its frequency all pivots of K − ω²M are positive.
fn first_period(building: &Building) -> f64 {
    let n = building.storeys.len();
    let stable = |square: f64| {
        let mut pivot = f64::INFINITY;
        (0..n).rev().all(|at| {
            let (storey, above) = (&building.storeys[at], building.storeys.get(at + 1));
            let above_stiffness = above.map_or(0.0, |above| above.stiffness);
            let coupling = if at + 1 < n {
                above_stiffness.powi(2) / pivot
            } else {
                0.0
            };
            pivot = storey.stiffness + above_stiffness - square * storey.mass - coupling;
            pivot > 0.0
        })
    };
    let (mut low, mut high) = (0.0, 1e6);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if stable(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    2.0 * std::f64::consts::PI / low.sqrt()
}

#[test]
fn the_table_that_is_printed_reads_back_as_the_one_that_is_used() {
    let table = types(Types::text(), "").expect("types");
    assert_eq!(table.content(), Types::hazus().content());
    // The same in other units.
    let mut metric =
        format!("{COLUMNS},level,storeys_least,storeys_most,pinching,unloading_exponent,damping\n");
    for class in Types::hazus().classes() {
        let (c, d) = (class.capacity, class.drifts);
        let _ = writeln!(
            metric,
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}",
            class.name,
            1e3 * c.yield_displacement,
            c.yield_acceleration,
            1e3 * c.ultimate_displacement,
            c.ultimate_acceleration,
            class.typical_storeys,
            class.storey_height,
            d[0],
            d[1],
            d[2],
            d[3],
            class.level.name(),
            class.storeys.start(),
            class.storeys.end(),
            class.pinching,
            class.unloading_exponent,
            class.damping
        );
    }
    let metric = types(&metric, "").expect("types");
    for (a, b) in metric.classes().zip(Types::hazus().classes()) {
        let (one, two) = (a.building(3, 250.0), b.building(3, 250.0));
        assert!((one.storeys[0].stiffness / two.storeys[0].stiffness - 1.0).abs() < 1e-12);
        assert_eq!(
            (&a.name, a.level, &a.storeys),
            (&b.name, b.level, &b.storeys)
        );
    }
}

#[test]
fn a_type_of_ones_own_has_its_period_strength_and_mass() {
    // Yield at 40 mm and 0.16 g of a building of four storeys; no hardening; floors of 640 kg/m².
    let text = format!(
        "# ours\n{COLUMNS},mass_kg_m2\nRC infilled,40,0.16,200,0.16,4,2.8,0.001,0.004,0.012,0.03,640\n"
    );
    let types = types(&text, "").expect("types");
    for level in Level::ALL {
        let class = types.of("rc INFILLED", 4, level).expect("a class");
        assert_eq!((&*class.name, class.level), ("RC infilled", level));
        let building = class.building(4, 300.0);
        let weight = 4.0 * 640.0 * 300.0 * 9.81;
        assert!(
            (building
                .storeys
                .iter()
                .map(|building| building.mass)
                .sum::<f64>()
                * 9.81
                - weight)
                .abs()
                < 1e-6
        );
        // T = 2π √(Dy / Ay), to the accuracy of the formula for the first mode of a chain.
        let expected = 2.0 * std::f64::consts::PI * (0.04_f64 / (0.16 * 9.81)).sqrt();
        let period = first_period(&building);
        assert!(
            (period / expected - 1.0).abs() < 0.01,
            "{period} {expected}"
        );
        // Strength of the base over the weight: Ay times the share of the first mode.
        let base = &building.storeys[0];
        let strength = base.stiffness * base.first_corner / weight;
        assert!((0.8 * 0.16..=0.16).contains(&strength), "{strength}");
        // Without hardening the storey goes on at its strength to Du / Dy.
        assert!((base.second_corner / base.first_corner - 5.0).abs() < 1e-6);
        assert!(base.second_ratio < 1e-5);
    }
}

#[test]
fn rows_are_found_by_level_and_storeys_and_damage_comes_from_its_table() {
    let text = format!(
        "{COLUMNS},level,storeys_least,storeys_most\n\
         C1,10,0.2,90,0.4,2,3,0.004,0.008,0.02,0.05,low,1,4\n\
         C1,30,0.1,200,0.2,6,3,0.003,0.006,0.015,0.04,low,5,9\n\
         CR/LFINF,8,0.3,60,0.5,3,3,0.002,0.004,0.01,0.02,,1,16\n"
    );
    let damage = "type,level,slight,moderate,extensive,complete\nC1,low,0.01,0.02,0.03,0.04\ncr/lfinf,,0.011,0.021,0.031,0.041\n";
    let table = types(&text, damage).expect("types");
    let of = |kind: &str, storeys, level| table.of(kind, storeys, level);
    assert_eq!(of("C1", 3, Level::Low).unwrap().typical_storeys, 2.0);
    assert_eq!(of("c1", 7, Level::Low).unwrap().typical_storeys, 6.0);
    assert_eq!(of("C1", 14, Level::Low).unwrap().typical_storeys, 6.0);
    // A frame of GEM is a C1; a string that the table has is itself.
    assert_eq!(&*of("CR/LFM+CDM", 2, Level::Low).unwrap().name, "C1");
    assert_eq!(&*of("CR/LFINF", 2, Level::High).unwrap().name, "CR/LFINF");
    assert_eq!(
        of("C1", 3, Level::Low).unwrap().drifts,
        [0.01, 0.02, 0.03, 0.04]
    );
    assert_eq!(of("CR/LFINF", 3, Level::Pre).unwrap().drifts[3], 0.041);
    let told = of("C1", 3, Level::High).expect_err("no such level");
    assert!(
        told.contains("design level high") && told.contains("only for low"),
        "{told}"
    );
    let told = of("URM", 3, Level::Low).expect_err("no such type");
    assert!(
        told.contains("types.csv") && told.contains("C1, CR/LFINF"),
        "{told}"
    );
    // A type that the table of damage lacks is not given the drifts of the other table.
    let types = types(
        &text,
        "type,slight,moderate,extensive,complete\nW1,0.01,0.02,0.03,0.04\n",
    )
    .unwrap();
    let told = types.of("C1", 3, Level::Low).expect_err("no damage");
    assert!(told.contains("damage.csv") && told.contains("C1"), "{told}");
}

#[test]
fn every_fault_of_both_tables_is_told_with_its_line_and_column() {
    let good = "A,10,0.2,90,0.4,2,3,0.004,0.008,0.02,0.05";
    for (row, wanted) in [
        (
            "A,10,0.2,90,0.4,2,3,0.004,0.008,0.02,much",
            "types.csv, line 2, complete: expected a number, found \"much\"",
        ),
        (
            "A,10,0.2,9,0.4,2,3,0.004,0.008,0.02,0.05",
            "line 2, du_mm: must be greater than dy",
        ),
        (
            "A,10,0.2,90,0.1,2,3,0.004,0.008,0.02,0.05",
            "line 2, au_g: must lie between",
        ),
        (
            "A,10,0.2,11,0.4,2,3,0.004,0.008,0.02,0.05",
            "line 2, au_g: must lie between",
        ),
        (
            "A,10,0.2,90,0.4,2,3,0.004,0.003,0.02,0.05",
            "line 2, moderate: must be greater than that of slight",
        ),
        (
            "A,10,nan,90,0.4,2,3,0.004,0.008,0.02,0.05",
            "line 2, ay_g: must lie between 0.001 and 10, found NaN",
        ),
        (
            ",10,0.2,90,0.4,2,3,0.004,0.008,0.02,0.05",
            "line 2, type: the cell is empty",
        ),
        (
            "A,,0.2,90,0.4,2,3,0.004,0.008,0.02,0.05",
            "line 2, dy_mm: the cell is empty",
        ),
        (
            "A,10,0.2,90,0.4,2,3,0.004,0.008,0.02",
            "line 2: 10 cells below 11 columns",
        ),
        (
            "A,10,0.2,90,0.4,2,3,0.004,0.008,0.02,0.05\na,9,0.2,90,0.4,2,3,0.004,0.008,0.02,0.05",
            "line 3, type: a row above is for the same type",
        ),
    ] {
        let told = types(&format!("{COLUMNS}\n{row}\n"), "").expect_err(row);
        assert!(told.contains(wanted), "{row}: {told}");
    }
    for (columns, wanted) in [
        (
            COLUMNS.replace("dy_mm", "dy"),
            "\"dy\" is a length and names no unit",
        ),
        (
            COLUMNS.replace("dy_mm", "ty_mm"),
            "no column \"ty_mm\" is known",
        ),
        (
            COLUMNS.replace("au_g", "ag_g"),
            "the column au_g is missing",
        ),
        (
            COLUMNS.replace("dy_mm", "du_cm"),
            "\"du_mm\" is there twice",
        ),
    ] {
        let told = types(&format!("{columns}\n{good}\n"), "").expect_err(&columns);
        assert!(told.contains(wanted), "{columns}: {told}");
    }
    assert!(
        types(&format!("{COLUMNS}\n"), "")
            .expect_err("no rows")
            .contains("no row")
    );
    // Both tables at once.
    let told = types(
        &format!("{COLUMNS},level\n{good},best\n"),
        "type,slight,moderate,extensive,complete,storeys_least,storeys_most\nA,0.1,0.2,0.3,0.4,4,2\nB,0.2,0.1,0.3,0.4,,\n",
    )
    .expect_err("faults");
    for wanted in [
        "types.csv, line 2, level: \"best\" is no design level",
        "damage.csv, line 2, storeys_most: must not be less than storeys_least",
        "damage.csv, line 3, moderate: must be greater",
    ] {
        assert!(told.contains(wanted), "{wanted}: {told}");
    }
    let told = Types::read(&TypesTables {
        types: Some("nowhere.csv".into()),
        ..TypesTables::default()
    });
    assert!(told.expect_err("no file").contains("nowhere.csv"));
}
