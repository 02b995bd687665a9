//! The table of classes against two other publications of the same numbers, and names that lead to it.

use std::f64::consts::PI;

use jostle_classes::{Level, Types};

/// Period per storey of Lu and Guan's table, which the classes do not use: they take that of the capacity curve.
fn period_per_storey(name: &str, level: Level) -> f64 {
    let text = include_str!("data/period_per_storey.csv");
    let row = text
        .lines()
        .find(|line| line.starts_with(&format!("{name},{},", level.name())));
    let cell = row
        .and_then(|row| row.split(',').nth(2))
        .and_then(|split| split.parse().ok());
    cell.expect("a period")
}

#[test]
fn capacity_curves_agree_with_the_periods_of_another_table() {
    let mut compared = 0;
    for class in Types::hazus().classes() {
        let curve = class.capacity;
        let period =
            2.0 * PI * (curve.yield_displacement / (curve.yield_acceleration * 9.81)).sqrt();
        let other = period_per_storey(&class.name, class.level) * class.typical_storeys;
        assert!(
            (period / other - 1.0).abs() < 0.011,
            "{} {:?}: {period} {other}",
            class.name,
            class.level
        );
        compared += 1;
    }
    assert_eq!(compared, 144);
}

#[test]
fn damage_drifts_agree_with_those_of_shakecast() {
    // Low-rise values of `aebm/damage.py` of USGS ShakeCast (public domain), by level and family; medium rise takes 2/3
    // of them, high rise half.
    let low_rise = [
        (Level::High, "C1", [0.005, 0.01, 0.03, 0.08]),
        (Level::High, "C2", [0.004, 0.01, 0.03, 0.08]),
        (Level::High, "S1", [0.006, 0.012, 0.03, 0.08]),
        (Level::High, "S4", [0.004, 0.008, 0.024, 0.07]),
        (Level::High, "W1", [0.004, 0.012, 0.04, 0.1]),
        (Level::Moderate, "C1", [0.005, 0.009, 0.023, 0.06]),
        (Level::Moderate, "RM1", [0.004, 0.007, 0.019, 0.053]),
        (Level::Moderate, "W1", [0.004, 0.01, 0.031, 0.075]),
        (Level::Low, "C1", [0.005, 0.008, 0.02, 0.05]),
        (Level::Low, "URM", [0.003, 0.006, 0.015, 0.035]),
        (Level::Low, "RM1", [0.004, 0.006, 0.016, 0.044]),
        (Level::Pre, "C1", [0.004, 0.006, 0.016, 0.04]),
        (Level::Pre, "URM", [0.002, 0.005, 0.012, 0.028]),
        (Level::Pre, "RM1", [0.003, 0.005, 0.013, 0.035]),
    ];
    let mut compared = 0;
    for (level, family, low) in low_rise {
        for class in Types::hazus()
            .classes()
            .filter(|class| class.level == level)
        {
            let share = match class.name.strip_prefix(family) {
                Some("" | "L") => 1.0,
                Some("M") => 2.0 / 3.0,
                Some("H") => 0.5,
                _ => continue,
            };
            for (a, b) in class.drifts.iter().zip(low) {
                assert!(
                    (a - share * b).abs() < 5.1e-4,
                    "{} {level:?}: {a} {}",
                    class.name,
                    share * b
                );
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 132);
}

#[test]
fn names_of_hazus_and_gem_lead_to_a_class() {
    for (name, storeys, wanted) in [
        ("C1M", 2, "C1M"),
        ("c1", 2, "C1L"),
        ("C1", 5, "C1M"),
        ("C1", 12, "C1H"),
        ("W1", 2, "W1"),
        ("URM", 1, "URML"),
        ("URM", 6, "URMM"),
        ("RM1", 9, "RM1M"),
        ("CR/LFM+CDM/HEX:5", 5, "C1M"),
        ("CR+CIP/LWAL+CDN/H:9", 9, "C2H"),
        ("CR/LFINF+CDN", 3, "C3L"),
        ("CR+PC/LWAL", 1, "PC1"),
        ("DX/MUR+CLBRS/LWAL", 2, "URML"),
        ("MUR", 3, "URMM"),
        ("S/LFBR", 4, "S2M"),
        ("W/LWAL", 2, "W1"),
        ("MCF/LWAL", 2, "URML"),
    ] {
        let class = Types::hazus()
            .of(name, storeys, Level::Low)
            .unwrap_or_else(|problem| panic!("{name}: {problem}"));
        assert_eq!(&*class.name, wanted, "{name} of {storeys} storeys");
    }
    for name in ["brick", "C4", "X9/LFM", ""] {
        let problem = Types::hazus().of(name, 2, Level::Low).expect_err(name);
        assert!(
            problem.contains("HAZUS") || problem.contains("understood"),
            "{problem}"
        );
    }
    assert_eq!("High-Code".parse(), Ok(Level::High));
    assert_eq!("PC".parse(), Ok(Level::Pre));
    assert!("best".parse::<Level>().is_err());
    assert_eq!(
        [1940, 1941, 1975, 1976].map(|year| Level::in_year(year, &Level::CALIFORNIA)),
        [Level::Pre, Level::Moderate, Level::Moderate, Level::High]
    );
}
