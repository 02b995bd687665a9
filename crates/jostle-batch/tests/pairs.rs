//! Pairs against independent solutions, closed forms and themselves.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::path::Path;

use jostle_batch::{
    Building, Contact, Face, Gap, Law, Motion, Options, Peaks, Precision, Row, Rule, Storey, run,
};
use serde_json::Value;

const LAW: Law = Law::HertzDamp {
    stiffness: 2e9,
    restitution: 0.65,
};

fn record() -> Vec<f64> {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../jostle-io/data/el-centro-1940-ns.csv");
    let text = std::fs::read_to_string(path).expect("the record");
    let value = |line: &str| line.split(',').nth(1)?.trim().parse().ok();
    text.lines().filter_map(value).collect()
}

fn scaled(pga: f64, seconds: f64) -> Motion {
    let points = record();
    let peak = points.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let count = (seconds / 0.02).round() as usize + 1;
    let acceleration = points.iter().take(count).map(|a| a * pga / peak).collect();
    Motion {
        step: 0.02,
        acceleration,
    }
}

fn peaks_of(motion: Motion, rows: Vec<Row>, options: &Options) -> Vec<Peaks> {
    let mut all = Vec::new();
    run(&[motion], rows, options, |at, peaks| {
        assert_eq!(at, all.len());
        all.push(peaks);
        ControlFlow::Continue(())
    })
    .expect("rows in range");
    all
}

fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().expect("an array").iter();
    all.map(|entry| entry.as_f64().expect("a number")).collect()
}

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    let greatest = expected.iter().fold(0.0_f64, |a, b| a.max(*b));
    let differences = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / greatest
}

#[test]
fn five_pairs_agree_with_an_integrator_that_locates_every_event() {
    for precision in [Precision::Single, Precision::Double] {
        for case in 0..5 {
            let path =
                Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/o{case}.json"));
            let text = std::fs::read_to_string(path).expect("the case");
            let reference: Value = serde_json::from_str(&text).expect("JSON");
            let number = |value: &Value| value.as_f64().expect("a number");
            let building = |given: &Value| {
                let [first, second] =
                    ["first_corner_m", "second_corner_m"].map(|name| numbers(&given[name]));
                let storey = |(c, y): (&f64, &f64)| Storey {
                    mass: number(&given["mass_kg"]),
                    stiffness: number(&given["stiffness"]),
                    height: 3.2,
                    first_corner: *c,
                    second_corner: *y,
                    second_ratio: number(&given["k2_ratio"]),
                    third_ratio: number(&given["k3_ratio"]),
                };
                let rule = match reference["rule"].as_str() {
                    Some("bilinear") => Rule::Bilinear,
                    _ => Rule::PeakOriented,
                };
                Building {
                    storeys: first.iter().zip(&second).map(storey).collect(),
                    rule,
                    alpha: number(&given["alpha"]),
                    beta: 0.0,
                }
            };
            let buildings: Vec<_> = reference["buildings"]
                .as_array()
                .expect("two")
                .iter()
                .map(building)
                .collect();
            let gap = Gap::between(
                &buildings[0],
                &buildings[1],
                number(&reference["gap_m"]),
                Some(LAW),
                0.0,
            );
            let row = Row {
                buildings,
                gaps: vec![gap],
                motion: 0,
                scale: 1.0,
            };
            let motion = scaled(number(&reference["pga_m_s2"]), 6.0);
            let options = Options {
                phase: 0.0125,
                precision,
            };
            let found = &peaks_of(motion, vec![row], &options)[0];
            for side in 0..2 {
                let drift = worst(
                    &found.buildings[side].drift,
                    &numbers(&reference["drift"][side]),
                );
                let acceleration = worst(
                    &found.buildings[side].acceleration,
                    &numbers(&reference["acc"][side]),
                );
                assert!(drift < 1e-3, "case {case}: drift {drift:e}");
                assert!(
                    acceleration < 1e-3,
                    "case {case}: acceleration {acceleration:e}"
                );
            }
            let force: Vec<f64> = found.gaps[0].iter().map(|gap| gap.force).collect();
            let force = worst(&force, &numbers(&reference["force"]));
            assert!(force < 1e-3, "case {case}: force {force:e}");
            let impacts: Vec<f64> = found.gaps[0]
                .iter()
                .map(|gap| f64::from(gap.impacts))
                .collect();
            assert_eq!(impacts, numbers(&reference["impacts"]), "case {case}");
        }
    }
}

/// Storeys and rules of all kinds, by number.
fn building(number: usize) -> Building {
    let rule = match number % 4 {
        0 => Rule::Elastic,
        1 => Rule::Bilinear,
        2 => Rule::PeakOriented,
        _ => Rule::Pinched {
            deformation: 0.7,
            force: 0.6,
            unloading_exponent: 0.2,
        },
    };
    let storey = Storey {
        mass: 1e5 + 7e3 * (number % 11) as f64,
        stiffness: 5e7 * (1.0 + (number % 7) as f64),
        height: 3.0,
        first_corner: 0.004,
        second_corner: 0.03,
        second_ratio: 0.15,
        third_ratio: 0.001,
    };
    Building {
        storeys: vec![storey; 1 + number % 5],
        rule,
        alpha: 0.3,
        beta: 0.001,
    }
}

fn row(number: usize, width: f64, law: Option<Law>) -> Row {
    let buildings: Vec<_> = (0..2 + number % 3)
        .map(|at| building(number * 5 + 3 * at + at * at))
        .collect();
    let gaps = buildings
        .windows(2)
        .map(|pair| Gap::between(&pair[0], &pair[1], width, law, 0.0))
        .collect();
    Row {
        buildings,
        gaps,
        motion: 0,
        scale: 1.0,
    }
}

#[test]
fn neighbours_in_lanes_threads_and_order_change_no_bit() {
    let rows: Vec<Row> = (0..60).map(|index| row(index, 0.005, Some(LAW))).collect();
    for precision in [Precision::Single, Precision::Double] {
        let options = Options {
            phase: 0.1,
            precision,
        };
        let together = peaks_of(scaled(4.0, 5.0), rows.clone(), &options);
        for (at, row) in rows.iter().enumerate() {
            let alone = peaks_of(scaled(4.0, 5.0), vec![row.clone()], &options);
            assert_eq!(alone[0], together[at], "row {at}");
        }
        let pool = rayon_of(3);
        let threads = pool.install(|| peaks_of(scaled(4.0, 5.0), rows.clone(), &options));
        assert_eq!(threads, together);
    }
}

fn rayon_of(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads")
}

#[test]
fn closing_exceeds_the_gap_exactly_where_buildings_touch() {
    let options = Options::default();
    let (mut touched, mut apart) = (0, 0);
    for (number, width) in (0..24).zip([0.002, 0.01, 0.03, 0.08].into_iter().cycle()) {
        let motion = || scaled(4.0, 5.0);
        let with = &peaks_of(motion(), vec![row(number, width, Some(LAW))], &options)[0];
        let free = &peaks_of(motion(), vec![row(number, width, None)], &options)[0];
        let any = free
            .gaps
            .iter()
            .flatten()
            .any(|gap| gap.closing as f32 > width as f32);
        let hit = with.gaps.iter().flatten().any(|gap| gap.impacts > 0);
        assert_eq!(any, hit, "row {number}");
        if hit {
            touched += 1;
        } else {
            apart += 1;
            // Never touched: not a bit differs from buildings alone.
            assert_eq!(with.buildings, free.buildings);
            for (at, building) in row(number, width, None).buildings.into_iter().enumerate() {
                let row = Row {
                    buildings: vec![building],
                    gaps: vec![],
                    motion: 0,
                    scale: 1.0,
                };
                let alone = &peaks_of(motion(), vec![row], &options)[0];
                let difference = worst(&alone.buildings[0].drift, &with.buildings[at].drift);
                assert!(difference < 1e-3, "row {number}: {difference:e}");
            }
        }
    }
    assert!(touched > 3 && apart > 3, "{touched} {apart}");
}

/// A storey of 10 rad/s with dashpot, pushed suddenly by 1 m/s² for 4 s; its greatest displacement, and that at the end \[m\].
fn pushed(rule: Rule) -> (Motion, Row, f64, f64) {
    let (mass, stiffness, beta) = (1e5, 1e7, 0.01);
    let storey = Storey {
        mass,
        stiffness,
        height: 3.0,
        first_corner: 9.0,
        second_corner: 9.0,
        second_ratio: 1.0,
        third_ratio: 1.0,
    };
    let motion = Motion {
        step: 0.02,
        acceleration: vec![-1.0; 201],
    };
    let omega: f64 = 10.0;
    let ratio = 0.5 * beta * omega;
    let damped = omega * (1.0 - ratio * ratio).sqrt();
    let greatest = (1.0 + (-PI * ratio * omega / damped).exp()) / (omega * omega);
    let end = 4.0 * damped;
    let decay = (-ratio * omega * 4.0_f64).exp();
    let at_end = (1.0 - decay * (end.cos() + ratio * omega / damped * end.sin())) / (omega * omega);
    let row = Row {
        buildings: vec![Building {
            storeys: vec![storey],
            rule,
            alpha: 0.0,
            beta,
        }],
        gaps: vec![],
        motion: 0,
        scale: 1.0,
    };
    (motion, row, greatest, at_end)
}

#[test]
fn a_suddenly_pushed_storey_swings_as_its_closed_form() {
    for rule in [Rule::Elastic, Rule::Bilinear, Rule::PeakOriented] {
        let (motion, row, greatest, at_end) = pushed(rule);
        let options = Options {
            phase: 0.005,
            precision: Precision::Double,
        };
        let found = &peaks_of(motion, vec![row], &options)[0].buildings[0];
        assert!((found.drift[0] / greatest - 1.0).abs() < 1e-5, "{rule:?}");
        assert!(
            (found.residual[0] / at_end - 1.0).abs() < 1e-3,
            "{rule:?}: {}",
            found.residual[0] / at_end
        );
    }
}

/// Steps are of second order, with dashpots too: half as long, a quarter of the error.
#[test]
fn errors_fall_with_the_square_of_the_step() {
    let errors = [0.08, 0.04, 0.02, 0.01].map(|phase| {
        let (motion, row, _, at_end) = pushed(Rule::Elastic);
        let options = Options {
            phase,
            precision: Precision::Double,
        };
        let found = &peaks_of(motion, vec![row], &options)[0].buildings[0];
        (found.residual[0] / at_end - 1.0).abs()
    });
    for pair in errors.windows(2) {
        assert!(
            pair[0] > 3.3 * pair[1] && pair[0] < 4.7 * pair[1],
            "{errors:?}"
        );
    }
}

#[test]
fn a_slab_on_a_column_pushes_both_floors_by_the_lever_rule() {
    let tall = building(1 + 4 * 4);
    let storeys = tall.storeys.len();
    let low = Building {
        storeys: vec![Storey {
            height: 4.5,
            ..tall.storeys[0]
        }],
        ..tall.clone()
    };
    let gap = Gap::between(&low, &tall, 0.0, Some(LAW), 0.0);
    let face = Face {
        floor: 0,
        share: 1.0,
    };
    assert!(storeys > 1);
    assert_eq!(
        gap.contacts[0],
        Contact {
            left: face,
            right: Face {
                floor: 1,
                share: 0.5
            }
        }
    );
    assert!(gap.contacts[0].strikes_column());
}

#[test]
fn a_number_out_of_range_is_named() {
    let mut row = row(3, 0.01, Some(LAW));
    row.buildings[1].storeys[0].mass = f64::NAN;
    let fault = run(&[scaled(1.0, 1.0)], [row], &Options::default(), |_, _| {
        ControlFlow::Continue(())
    });
    let fault = fault.expect_err("a fault").to_string();
    assert!(
        fault.starts_with("row 0: building 1: mass must lie"),
        "{fault}"
    );
}
