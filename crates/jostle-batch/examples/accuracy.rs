//! Random pairs and rows against the full engine, and pairs a second.
//!
//! `cargo run --release -p jostle-batch --example accuracy -- PROGRAM RECORD.csv [PAIRS ROWS SEED PHASE]`: `PROGRAM` is
//! `jostle`, `RECORD.csv` the built-in El Centro record.
#![allow(clippy::print_stdout, reason = "a command")]

use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::ControlFlow;
use std::process::{Command, Stdio};
use std::time::Instant;

use jostle_batch::{Building, Gap, Law, Motion, Options, Peaks, Precision, Row, Rule, Storey, run};
use serde_json::Value;

/// A stream of numbers of 0…1 by SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.next()
    }
}

/// Storeys whose strength falls towards the roof, as of a first mode.
fn building(random: &mut Random, pinched: bool) -> Building {
    let count = 1 + (random.next() * 8.0) as usize;
    let period = random.between(0.09, 0.25) * (count as f64).max(1.5);
    let strength = random.between(0.08, 0.35);
    let mass = random.between(1e5, 5e5);
    let n = count as f64;
    let stiffness = (2.0 * std::f64::consts::PI / period).powi(2)
        * mass
        * (0.4053 * n * n + 0.405 * n + 0.1869);
    let second_ratio = random.between(0.08, 0.25);
    let reserve = random.between(1.5, 3.0);
    let storey = |i: usize| {
        let share = 1.0 - (i * (i + 1)) as f64 / (n * (n + 1.0));
        let corner = strength * 9.8 * mass * n * share / stiffness;
        Storey {
            mass,
            stiffness,
            height: 3.2,
            first_corner: corner,
            second_corner: corner * (1.0 + (reserve - 1.0) / second_ratio),
            second_ratio,
            third_ratio: 0.001,
        }
    };
    let rule = if pinched {
        Rule::Pinched {
            deformation: 0.8,
            force: 0.8,
            unloading_exponent: 0.1,
        }
    } else {
        Rule::Bilinear
    };
    Building {
        storeys: (0..count).map(storey).collect(),
        rule,
        alpha: 0.04 * 2.0 * std::f64::consts::PI / period,
        beta: 0.008 * period,
    }
}

fn row(random: &mut Random, count: usize, pinched: bool) -> Row {
    let buildings: Vec<_> = (0..count).map(|_| building(random, pinched)).collect();
    let pairs = buildings.windows(2);
    let gaps = pairs
        .map(|own| {
            let law = Law::HertzDamp {
                stiffness: 2e9,
                restitution: 0.65,
            };
            Gap::between(&own[0], &own[1], random.between(0.0, 0.01), Some(law), 0.0)
        })
        .collect();
    Row {
        buildings,
        gaps,
        motion: 0,
        scale: random.between(0.8, 2.5),
    }
}

fn model(row: &Row, peak: f64) -> String {
    let list = |own: &Building, value: fn(&Storey) -> f64| {
        let all: Vec<_> = own
            .storeys
            .iter()
            .map(|own| format!("\"{:.12} m\"", value(own)))
            .collect();
        format!("[{}]", all.join(","))
    };
    let mut text = format!(
        "title=\"row\"\n[motion]\nrecord=\"el-centro-1940-ns\"\npga=\"{} m/s2\"\n[analysis]\ntolerance=1e-4\n",
        peak * row.scale
    );
    for (at, own) in row.buildings.iter().enumerate() {
        let s = &own.storeys[0];
        let _ = write!(
            text,
            "[[building]]\nname=\"B{at}\"\nkind=\"shear\"\np_delta=false\nmass=\"{} kg\"\nstoreys={}\nstiffness=\"{} N/m\"\n\
             storey_height=\"{} m\"\ndamping={{alpha=\"{} 1/s\",beta=\"{} s\"}}\n",
            s.mass,
            own.storeys.len(),
            s.stiffness,
            s.height,
            own.alpha,
            own.beta
        );
        let first = list(own, |own| own.first_corner);
        let _ = match own.rule {
            Rule::Pinched {
                deformation,
                force,
                unloading_exponent,
            } => writeln!(
                text,
                "hinges={{rule=\"pinched\",cracking={first},yield={},post_cracking={},post_yield={},\
                 pinching={{deformation={deformation},force={force}}},unloading_exponent={unloading_exponent}}}",
                list(own, |own| own.second_corner),
                s.second_ratio,
                s.third_ratio
            ),
            _ => writeln!(
                text,
                "hinges={{rule=\"bilinear\",yield={first},post_yield={}}}",
                s.second_ratio
            ),
        };
    }
    for (at, own) in row.gaps.iter().enumerate() {
        let _ = write!(
            text,
            "[[gap]]\nbetween=[\"B{at}\",\"B{}\"]\nwidth=\"{} m\"\nlaw=\"hertz-damp\"\nstiffness=\"2e9 N/m^1.5\"\n\
             restitution=0.65\n",
            at + 1,
            own.width
        );
    }
    text
}

fn full(program: &str, text: &str) -> Option<Value> {
    let path = std::env::temp_dir().join(format!("jostle-accuracy-{}.toml", std::process::id()));
    std::fs::File::create(&path)
        .ok()?
        .write_all(text.as_bytes())
        .ok()?;
    let output = Command::new(program)
        .arg("run")
        .arg(&path)
        .args(["--json", "--no-report"])
        .stderr(Stdio::piped())
        .output()
        .ok()?;
    let found = serde_json::from_slice(&output.stdout).ok();
    if found.is_none() {
        println!("{}", String::from_utf8_lossy(&output.stderr));
    }
    found
}

/// Differences of peaks over the greatest of their kind in the building or gap.
fn differences(peaks: &Peaks, full: &Value, height: f64) -> Vec<f64> {
    let mut all = Vec::new();
    let mut add = |found: &[f64], expected: &[f64]| {
        let greatest = expected
            .iter()
            .chain(found)
            .fold(0.0_f64, |a, b| a.max(b.abs()));
        if greatest > 0.0 {
            all.extend(
                found
                    .iter()
                    .zip(expected)
                    .map(|(a, b)| (a - b).abs() / greatest),
            );
        }
    };
    let read = |list: &Value, name: &str, factor: f64| -> Vec<f64> {
        let list = list.as_array().into_iter().flatten();
        list.map(|own| own[name].as_f64().unwrap_or(0.0) * factor)
            .collect()
    };
    for (at, own) in peaks.buildings.iter().enumerate() {
        let floors = &full["buildings"][at]["floors"];
        add(&own.drift, &read(floors, "storey_drift_peak", height));
        add(
            &own.acceleration,
            &read(floors, "total_acceleration_peak_m_s2", 1.0),
        );
    }
    for (at, own) in peaks.gaps.iter().enumerate() {
        let force: Vec<_> = own.iter().map(|own| own.force).collect();
        add(
            &force,
            &read(&full["gaps"][at]["contacts"], "peak_force_n", 1.0),
        );
    }
    all
}

fn all_of(motion: &Motion, rows: &[Row], options: &Options) -> Vec<Peaks> {
    let mut all = Vec::new();
    let sink = |_, peaks| {
        all.push(peaks);
        ControlFlow::Continue(())
    };
    if let Err(fault) = run(
        std::slice::from_ref(motion),
        rows.iter().cloned(),
        options,
        sink,
    ) {
        println!("{fault}");
    }
    all
}

fn main() {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, usual: f64| {
        given
            .get(at)
            .and_then(|own| own.parse().ok())
            .unwrap_or(usual)
    };
    let text = std::fs::read_to_string(&given[1]).unwrap_or_default();
    let value = |line: &str| line.split(',').nth(1)?.trim().parse().ok();
    let acceleration: Vec<f64> = text.lines().filter_map(value).collect();
    let peak = acceleration.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let motion = Motion {
        step: 0.02,
        acceleration,
    };
    let mut random = Random(number(4, 1.0) as u64);
    for (name, count, most, pinched) in [
        ("pinched pairs", number(2, 400.0) / 2.0, 2, true),
        ("bilinear pairs", number(2, 400.0) / 2.0, 2, false),
        ("pinched rows", number(3, 100.0) / 2.0, 6, true),
        ("bilinear rows", number(3, 100.0) / 2.0, 6, false),
    ] {
        let rows: Vec<Row> = (0..count as usize)
            .map(|at| row(&mut random, if most == 2 { 2 } else { 3 + at % 4 }, pinched))
            .collect();
        let free = all_of(&motion, &rows, &Options::for_tolerance(1e-2));
        let hit = |own: &&Peaks| own.gaps.iter().flatten().any(|own| own.impacts > 0);
        let struck = free.iter().filter(hit).count();
        println!("{name}: {struck} of {} touch", rows.len());
        let references: Vec<_> = rows
            .iter()
            .map(|own| full(&given[0], &model(own, peak)))
            .collect();
        for (tolerance, phase) in [(1e-2, 0.1), (1e-3, 0.025), (1e-3, 0.0125)] {
            for precision in [Precision::Single, Precision::Double] {
                let peaks = all_of(&motion, &rows, &Options { phase, precision });
                let mut all: Vec<(f64, usize)> = Vec::new();
                for (at, (own, reference)) in peaks.iter().zip(&references).enumerate() {
                    if let Some(reference) = reference {
                        all.extend(
                            differences(own, reference, 3.2)
                                .into_iter()
                                .map(|own| (own, at)),
                        );
                    }
                }
                let within = all.iter().filter(|own| own.0 < tolerance).count();
                let worst = all
                    .iter()
                    .fold((0.0, 0), |a, b| if b.0 > a.0 { *b } else { a });
                println!(
                    "{name}, phase {phase}, {precision:?}: {} peaks, {:.2} % within {tolerance:e}, worst {:.1e} in row {}",
                    all.len(),
                    100.0 * within as f64 / all.len().max(1) as f64,
                    worst.0,
                    worst.1
                );
            }
        }
    }
    for (name, pinched) in [("pinched", true), ("bilinear", false)] {
        let with = |random: &mut Random, storeys: usize| loop {
            let own = building(random, pinched);
            if own.storeys.len() == storeys {
                return own;
            }
        };
        let (four, six) = (with(&mut random, 4), with(&mut random, 6));
        let law = Some(Law::HertzDamp {
            stiffness: 2e9,
            restitution: 0.65,
        });
        let gap = Gap::between(&four, &six, 0.02, law, 0.0);
        let row = Row {
            buildings: vec![four, six],
            gaps: vec![gap],
            motion: 0,
            scale: 1.0,
        };
        let rows = vec![row; 1024];
        for tolerance in [1e-2, 1e-3] {
            let options = Options::for_tolerance(tolerance);
            let start = Instant::now();
            all_of(&motion, &rows, &options);
            let seconds = start.elapsed().as_secs_f64() * rayon::current_num_threads() as f64;
            println!(
                "{name}, 4 and 6 storeys, tolerance {tolerance:e}: {:.0} pairs a second and thread",
                1024.0 / seconds
            );
        }
    }
}
