//! Design spectra against evaluations made apart from this program and values worked out by hand.

use jostle_motion::{
    Asce7, En1998, EnGround, EnType, Gb50011, GbGroup, GbIntensity, GbLevel, GbSite,
    STANDARD_GRAVITY, SpectrumTable, TargetKind, TargetSpectrum,
};

use crate::support::assert_near;

#[test]
fn gb_50011_agrees_with_the_published_formulas() {
    use GbIntensity::{Eight, Seven};
    use GbLevel::{Frequent, Rare};
    let spectrum = |amax: &str, tg: &str| {
        let (intensity, level) = match amax {
            "0.08" => (Seven, Frequent),
            "0.16" => (Eight, Frequent),
            "0.5" => (Seven, Rare),
            "0.9" => (Eight, Rare),
            other => panic!("no case for {other}"),
        };
        // T_g = 0.40 s at the rare level is group 1 with its 0.05 s.
        let group = match (tg, level) {
            ("0.35", _) | ("0.4", Rare) => GbGroup::First,
            ("0.4", _) => GbGroup::Second,
            ("0.45", _) => GbGroup::Third,
            other => panic!("no case for {other:?}"),
        };
        Gb50011 {
            intensity,
            site: GbSite::II,
            group,
            level,
        }
    };
    let mut compared = 0;
    for line in include_str!("data/gb50011.csv")
        .lines()
        .filter(|line| !line.starts_with('#'))
    {
        let fields: Vec<&str> = line.split(',').collect();
        let [z, t, alpha] = [2, 3, 4].map(|i| fields[i].parse::<f64>().expect("a number"));
        assert_near(
            spectrum(fields[0], fields[1]).coefficient(t, z),
            alpha,
            1e-12,
            line,
        );
        compared += 1;
    }
    assert_eq!(compared, 120);
}

#[test]
fn gb_50011_has_its_tables() {
    let of = |intensity, site, group, level| Gb50011 {
        intensity,
        site,
        group,
        level,
    };
    let rare = of(
        GbIntensity::EightHalf,
        GbSite::IV,
        GbGroup::Third,
        GbLevel::Rare,
    );
    assert_near(rare.largest_coefficient(), 1.2, 1e-15, "alpha_max");
    assert_near(rare.characteristic_period(), 0.95, 1e-15, "T_g");
    assert_near(rare.time_history_peak(), 5.1, 1e-15, "time history");
    let middle = of(
        GbIntensity::SevenHalf,
        GbSite::I0,
        GbGroup::First,
        GbLevel::Fortification,
    );
    assert_near(middle.largest_coefficient(), 0.34, 1e-15, "alpha_max");
    assert_near(middle.characteristic_period(), 0.20, 1e-15, "T_g");
    assert_near(
        middle.time_history_peak(),
        0.15 * STANDARD_GRAVITY,
        1e-15,
        "time history",
    );
}

#[test]
fn en_1998_has_its_corners() {
    let of = |kind, ground| {
        TargetSpectrum::new(TargetKind::En1998(En1998 {
            kind,
            ground,
            ground_acceleration: 2.0,
        }))
    };
    // Type 1, ground C: S = 1.15, T_B = 0.2, T_C = 0.6, T_D = 2; plateau 2.5 · 2 · 1.15 = 5.75 m/s².
    let c = of(EnType::One, EnGround::C);
    let eta = (10.0_f64 / 7.0).sqrt();
    for (t, z, wanted) in [
        (0.0, 0.05, 2.3),
        (0.1, 0.05, 2.3 * 1.75),
        (0.2, 0.05, 5.75),
        (0.6, 0.05, 5.75),
        (1.2, 0.05, 2.875),
        (2.0, 0.05, 1.725),
        (4.0, 0.05, 5.75 * 0.6 * 2.0 / 16.0),
        (0.4, 0.02, 5.75 * eta),
        (0.4, 0.5, 5.75 * 0.55),
    ] {
        assert_near(
            c.acceleration(t, z).expect("in range"),
            wanted,
            1e-14,
            &format!("{t} {z}"),
        );
    }
    let e = of(EnType::Two, EnGround::E);
    assert_near(
        e.acceleration(0.25, 0.05).expect("in range"),
        8.0,
        1e-14,
        "type 2, ground E",
    );
    assert_near(
        e.acceleration(2.4, 0.05).expect("in range"),
        8.0 * 0.25 * 1.2 / 5.76,
        1e-14,
        "T_D",
    );
    assert!(c.acceleration(4.5, 0.05).is_err() && c.acceleration(f64::NAN, 0.05).is_err());
}

#[test]
fn asce_7_has_its_branches() {
    let spectrum = TargetSpectrum::new(TargetKind::Asce7(Asce7 {
        short: 10.0,
        one_second: 6.0,
        long_period: 8.0,
    }));
    // T_0 = 0.12 s, T_S = 0.6 s.
    for (t, wanted) in [
        (0.0, 4.0),
        (0.06, 7.0),
        (0.12, 10.0),
        (0.6, 10.0),
        (1.2, 5.0),
        (8.0, 0.75),
        (16.0, 0.1875),
    ] {
        assert_near(
            spectrum.acceleration(t, 0.05).expect("in range"),
            wanted,
            1e-14,
            &format!("{t}"),
        );
    }
    assert!(
        spectrum.acceleration(1.0, 0.02).is_err(),
        "ASCE 7 speaks of 5 % only"
    );
}

#[test]
fn a_factor_scales_and_a_table_keeps_its_range() {
    let table = SpectrumTable::new("own", 0.05, vec![[0.1, 2.0], [1.0, 2.0]]).expect("a table");
    let mut spectrum = TargetSpectrum::new(TargetKind::Table(table));
    spectrum.factor = 1.5;
    assert_near(
        spectrum.acceleration(0.5, 0.05).expect("in range"),
        3.0,
        1e-14,
        "factor",
    );
    assert!(spectrum.acceleration(0.05, 0.05).is_err());
    assert_eq!(spectrum.peak_ground_acceleration(), None);
}
