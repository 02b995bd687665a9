//! Storeys of classes against an independent program, and their model files.

use jostle_classes::{Capacity, Coefficients, model};

/// Numbers of a row after level and type.
fn table() -> Vec<(String, Vec<f64>)> {
    let text = include_str!("data/mdof_lu.csv");
    let row = |line: &str| {
        let mut parts = line.splitn(3, ',');
        let name = format!("{} {}", parts.next()?, parts.next()?);
        let numbers = parts.next()?.split(',').map(|split| split.parse().ok());
        Some((name, numbers.collect::<Option<Vec<f64>>>()?))
    };
    text.lines().filter_map(row).collect()
}

#[test]
fn storeys_equal_those_of_an_independent_program() {
    // Sy of HAZUS. Hardening and overstrength come from the first storey, so the others test them.
    let strengths = [
        ("High_code W1", 0.4),
        ("Pre_code URMM", 0.111),
        ("Low_code C1M", 0.052),
        ("Moderate_code C2H", 0.127),
        ("Low_code URML", 0.2),
    ];
    let table = table();
    let mut compared = 0;
    for (name, strength) in strengths {
        let rows: Vec<_> = table
            .iter()
            .filter(|table| table.0 == name)
            .map(|table| &table.1)
            .collect();
        let first = rows[0];
        let overstrength = first[7] / first[5];
        let coefficients = Coefficients {
            period_per_storey: first[12] / first[0],
            strength,
            hardening: (overstrength - 1.0) / (first[8] / first[6] - 1.0),
            overstrength,
            pinching: first[9],
            unloading_exponent: first[10],
            damping: first[11],
        };
        let building = coefficients.building(first[0] as usize, 1000.0 * first[1], 3.0);
        assert_eq!(building.storeys.len(), rows.len());
        for (storey, row) in building.storeys.iter().zip(rows) {
            let force = storey.stiffness * storey.first_corner;
            let found = [
                storey.mass,
                storey.stiffness,
                force,
                storey.first_corner,
                storey.second_corner,
            ];
            for (found, expected) in found
                .into_iter()
                .zip([row[3], row[4], row[5], row[6], row[8]])
            {
                assert!(
                    (found / expected - 1.0).abs() < 1e-6,
                    "{name}: {found} {expected}"
                );
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 5 * (2 + 4 + 6 + 12 + 1));
}

#[test]
fn a_capacity_curve_gives_the_published_coefficients() {
    // W1, high code: .48 in, .4 g, 11.51 in, 1.2 g; 0.35 s a storey and 0.0870 for one typical storey.
    let inch = 0.0254;
    let capacity = Capacity {
        yield_displacement: 0.48 * inch,
        yield_acceleration: 0.4,
        ultimate_displacement: 11.51 * inch,
        ultimate_acceleration: 1.2,
    };
    let coefficients = capacity.coefficients(1.0, 0.8, 0.1, 0.1);
    assert!((coefficients.period_per_storey / 0.35 - 1.0).abs() < 0.01);
    assert!((coefficients.hardening / 0.087_035_4 - 1.0).abs() < 1e-4);
    assert!((coefficients.overstrength - 3.0).abs() < 1e-12);
    let building = coefficients.building(2, 130.0, 3.2);
    let row = jostle_batch::Row {
        buildings: vec![building],
        gaps: vec![],
        motion: 0,
        scale: 1.0,
    };
    let text = model(&row, "record = \"el-centro-1940-ns\"", 1e-4);
    assert!(text.contains("rule = \"pinched\""));
}
