//! Batches of random rows of buildings against the standard solvers, their speed, and what a city costs: `docs/batches.md`.

use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use jostle_batch::{Building, Gap, Law, Motion, Options, Precision, Row, Rule, run};
use jostle_city::{City, EXAMPLE_FILE, RunOptions, example_city};
use jostle_classes::{BothWays, Class, Level, Types, both_ways, lognormal, uniform};
use jostle_io::{CityFile, Format, MotionSpec};
use rayon::prelude::*;

/// Steps of a batch: its tolerance and the phase that the fastest oscillation takes in a step.
const WAYS: [(f64, f64); 2] = [(1e-2, 0.1), (1e-3, 0.025)];
/// Most storeys of a random building.
const MOST_STOREYS: usize = 8;
/// Median of the peak ground acceleration \[m/s²\] and the standard deviation of its logarithm.
const PGA: (f64, f64) = (3.5, 0.4);
/// Median of the gaps \[m\] and the standard deviation of their logarithm.
const GAP: (f64, f64) = (0.008, 0.8);
/// Rows that are timed together.
const TIMED: usize = 1024;
/// Buildings of the synthetic city that is timed, and draws of it.
const CITY: (usize, usize) = (3000, 5);
/// Pairs a building in San Francisco: outlines no farther apart than 0.5 m, 28,610 among 76,710 buildings.
const PAIRS_A_BUILDING: f64 = 0.373;
/// Motions of a regional study.
const MOTIONS: f64 = 25.0;

/// What random rows are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kind {
    name: &'static str,
    /// As their HAZUS class has it, or bilinear.
    bilinear: bool,
    /// Fewest and most buildings.
    buildings: [usize; 2],
}

const KINDS: [Kind; 4] = [
    Kind {
        name: "pairs, pinched or peak-oriented",
        bilinear: false,
        buildings: [2, 2],
    },
    Kind {
        name: "pairs, bilinear",
        bilinear: true,
        buildings: [2, 2],
    },
    Kind {
        name: "rows of 3 to 6, pinched or peak-oriented",
        bilinear: false,
        buildings: [3, 6],
    },
    Kind {
        name: "rows of 3 to 6, bilinear",
        bilinear: true,
        buildings: [3, 6],
    },
];

/// Peaks of one kind of rows at one tolerance.
#[derive(Clone, Debug)]
pub struct Compared {
    kind: &'static str,
    rows: usize,
    touching: usize,
    tolerance: f64,
    precision: Precision,
    /// Deviations of drifts, accelerations and forces, each over the greatest of its kind in the building or gap \[–\].
    deviations: [Vec<f64>; 3],
}

impl Compared {
    /// What the batch promised \[–\].
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Share of all peaks within the tolerance \[–\].
    #[must_use]
    pub fn within(&self) -> f64 {
        share(&self.deviations.concat(), self.tolerance)
    }

    /// Greatest deviation \[–\].
    #[must_use]
    pub fn worst(&self) -> f64 {
        self.deviations
            .iter()
            .flatten()
            .copied()
            .fold(0.0, f64::max)
    }
}

fn share(all: &[f64], tolerance: f64) -> f64 {
    let within = all
        .iter()
        .filter(|candidate| **candidate <= tolerance)
        .count();
    within as f64 / all.len().max(1) as f64
}

fn el_centro() -> Result<Motion, String> {
    let motion = MotionSpec::record("el-centro-1940-ns")
        .resolve()
        .map_err(|error| error.to_string())?;
    let jostle::Wave::Sampled { step, acceleration } = motion.wave else {
        return Err("El Centro is no record".to_owned());
    };
    Ok(Motion { step, acceleration })
}

/// A building of a random class; every number belongs to its name.
fn building(seed: u64, at: u64, bilinear: bool) -> Building {
    let dice = |what: &str| uniform(seed, at, what);
    let types = Types::hazus();
    let classes: Vec<&Class> = types
        .classes()
        .filter(|class| *class.storeys.start() <= MOST_STOREYS)
        .collect();
    let class = classes[(dice("class") * classes.len() as f64) as usize];
    let most = (*class.storeys.end()).min(MOST_STOREYS);
    let least = *class.storeys.start();
    let storeys = least + (dice("storeys") * (most - least + 1) as f64) as usize;
    let mut building = class.building(storeys, 80.0 + 700.0 * dice("area"));
    let stiffness = lognormal(seed, at, "stiffness", 0.1);
    let strength = lognormal(seed, at, "strength", 0.25);
    for storey in &mut building.storeys {
        storey.stiffness *= stiffness;
        storey.first_corner *= strength / stiffness;
        storey.second_corner *= strength / stiffness;
    }
    if bilinear {
        building.rule = Rule::Bilinear;
    }
    building
}

fn random_row(seed: u64, at: u64, kind: Kind, peak: f64) -> Row {
    let place = |building: usize| at * 64 + building as u64;
    let [least, most] = kind.buildings;
    let count = least + (uniform(seed, at, "count") * (most - least + 1) as f64) as usize;
    let buildings: Vec<Building> = (0..count)
        .map(|index| building(seed, place(index), kind.bilinear))
        .collect();
    let gap = |pair: usize| {
        let place = place(pair);
        let width = GAP.0 * lognormal(seed, place, "gap", GAP.1);
        let law = Law::HertzDamp {
            stiffness: 2.75e9 * lognormal(seed, place, "contact", 0.3),
            restitution: 0.65,
        };
        Gap::between(
            &buildings[pair],
            &buildings[pair + 1],
            width,
            Some(law),
            0.0,
        )
    };
    Row {
        gaps: (0..count - 1).map(gap).collect(),
        motion: 0,
        scale: PGA.0 * lognormal(seed, at, "pga", PGA.1) / peak,
        buildings,
    }
}

/// Runs `pairs` random pairs and `rows` random longer rows both ways, half of each bilinear.
///
/// # Errors
/// When a row cannot run.
pub fn compare(pairs: usize, rows: usize, seed: u64) -> Result<Vec<Compared>, String> {
    let motion = el_centro()?;
    let peak = motion
        .acceleration
        .iter()
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    let mut all = Vec::new();
    for (place, kind) in KINDS.into_iter().enumerate() {
        let count = if kind.buildings[1] == 2 { pairs } else { rows } / 2;
        let wrapping_mul = seed.wrapping_mul(1000).wrapping_add(place as u64);
        let random = |at: usize| random_row(wrapping_mul, at as u64, kind, peak);
        for (tolerance, phase) in WAYS {
            for precision in [Precision::Single, Precision::Double] {
                let options = Options { phase, precision };
                let found: Result<Vec<BothWays>, String> = (0..count)
                    .into_par_iter()
                    .map(|at| {
                        let both = both_ways(&random(at), &motion, &options, &|| false);
                        both.and_then(|both_way| both_way.ok_or_else(|| "stopped".to_owned()))
                            .map_err(|problem| format!("{}, row {at}: {problem}", kind.name))
                    })
                    .collect();
                let found = found?;
                let mut deviations = [Vec::new(), Vec::new(), Vec::new()];
                for both in &found {
                    for (all, deviation) in deviations.iter_mut().zip(both.deviations()) {
                        all.extend(deviation);
                    }
                }
                let touches =
                    |ways: &&BothWays| ways.force.iter().flatten().any(|force| *force > 0.0);
                all.push(Compared {
                    kind: kind.name,
                    rows: count,
                    touching: found.iter().filter(touches).count(),
                    tolerance,
                    precision,
                    deviations,
                });
            }
        }
    }
    Ok(all)
}

/// Pairs of four beside six storeys in a second of one thread, El Centro whole: rule, tolerance, rate \[1/s\].
///
/// # Errors
/// When a row cannot run.
pub fn speed() -> Result<Vec<(&'static str, f64, f64)>, String> {
    let motion = [el_centro()?];
    let class = Types::hazus().of("C1M", 5, Level::Moderate)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| error.to_string())?;
    let mut all = Vec::new();
    for (name, bilinear) in [("pinched", false), ("bilinear", true)] {
        let of = |storeys: usize| {
            let mut building = class.building(storeys, 400.0);
            if bilinear {
                building.rule = Rule::Bilinear;
            }
            building
        };
        let buildings = vec![of(4), of(6)];
        let law = Law::HertzDamp {
            stiffness: 2.75e9,
            restitution: 0.65,
        };
        let gap = Gap::between(&buildings[0], &buildings[1], 0.01, Some(law), 0.0);
        let row = Row {
            buildings,
            gaps: vec![gap],
            motion: 0,
            scale: 1.0,
        };
        for (tolerance, phase) in WAYS {
            let options = Options {
                phase,
                precision: Precision::Single,
            };
            let time = || {
                let rows = std::iter::repeat_n(row.clone(), TIMED);
                let start = Instant::now();
                run(&motion, rows, &options, |_, _| ControlFlow::Continue(()))
                    .map_err(|error| error.to_string())?;
                Ok::<f64, String>(start.elapsed().as_secs_f64())
            };
            // The better of three: other programs only slow it.
            let times = pool.install(|| (0..3).map(|_| time()).collect::<Result<Vec<_>, _>>())?;
            let best = times.into_iter().fold(f64::INFINITY, f64::min);
            all.push((name, tolerance, TIMED as f64 / best));
        }
    }
    Ok(all)
}

/// Draws of pairs of a synthetic city that one thread computes in a second \[1/s\], and the bytes of the tables for each. The time includes
/// runs without and with contact, the sample, and the tables.
///
/// # Errors
/// When the city cannot run.
pub fn city(folder: &Path) -> Result<(f64, f64), String> {
    let shown = |error: &dyn std::fmt::Display| error.to_string();
    std::fs::create_dir_all(folder).map_err(|error| shown(&error))?;
    let write = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).map_err(|error| shown(&error))
    };
    write("city.geojson", &example_city(CITY.0, 1))?;
    let mut file = CityFile::parse("city.toml", EXAMPLE_FILE, Format::Toml, folder)
        .map_err(|error| shown(&error))?;
    file.draws = CITY.1;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| shown(&error))?;
    let start = Instant::now();
    let out = folder.join("out");
    let cases = pool.install(|| {
        let city = City::new(file).map_err(|error| shown(&error))?;
        city.run(&out, RunOptions::default(), &|| false, &mut |_| {})
            .map_err(|error| shown(&error))?;
        Ok::<usize, String>(city.cases())
    })?;
    let seconds = start.elapsed().as_secs_f64();
    let runs = std::fs::read_dir(out.join("runs")).map_err(|error| shown(&error))?;
    let sizes = runs.flatten().filter_map(|run| run.metadata().ok());
    let bytes: u64 = sizes.map(|size| size.len()).sum();
    Ok((cases as f64 / seconds, bytes as f64 / cases as f64))
}

/// `docs/batches.md`.
#[must_use]
pub fn page(
    [pairs, rows, seed]: [u64; 3],
    compared: &[Compared],
    speed: &[(&'static str, f64, f64)],
    (rate, bytes): (f64, f64),
) -> String {
    let mut text = format!(
        "# Accuracy and speed of batches\n\n\
         `jostle city` and `jostle classes` compute many rows of yielding shear buildings at once, in single precision. This page shows\n\
         how much the computed peaks differ from those of the standard solvers at a tolerance of 1e-4, and how many pairs are computed per second. It is written by\n\
         `cargo run --release -p jostle-validation -- --batches {pairs} {rows} --seed {seed} --page`. Every run of a city or of classes\n\
         also repeats a sample of its rows with the standard solvers and reports the differences.\n\n\
         ## Accuracy\n\n\
         The compared buildings are random: 1 to {MOST_STOREYS} storeys, all HAZUS types and design levels, random stiffness and strength. The gaps \
         have a\nmedian of {:.0} mm, and the El Centro record is scaled to a median peak of {:.2} g. The error of a peak is its \
         difference from the\npeak of the standard solvers, divided by the greatest peak of its kind in the building or gap. The columns \
         *drifts* to *all* give the\nshare of peaks whose error is within the tolerance.\n\n\
         | rows | rows with contact | tolerance | precision | peaks | drifts | accelerations | forces | all | largest error |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        1e3 * GAP.0,
        PGA.0 / jostle::statics::STANDARD_GRAVITY
    );
    let percent = |value: f64| format!("{:.2} %", 100.0 * value);
    for comparison in compared {
        let kinds =
            [0, 1, 2].map(|at| percent(share(&comparison.deviations[at], comparison.tolerance)));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} {} | {} | {:e} | {} | {} | {} | {} | {:.1e} |",
            comparison.rows,
            comparison.kind,
            comparison.touching,
            comparison.tolerance,
            match comparison.precision {
                Precision::Single => "single",
                Precision::Double => "double",
            },
            comparison.deviations.iter().map(Vec::len).sum::<usize>(),
            kinds.join(" | "),
            percent(comparison.within()),
            comparison.worst()
        );
    }
    text += "\n## Speed\n\n\
             Number of pairs that one thread computes per second: a four-storey building next to a six-storey building (C1M, moderate design level) under the whole\n\
             El Centro record (31 s). Other programs may have been running on the same machine.\n\n\
             | rule | tolerance | pairs per second |\n|---|---|---|\n";
    for (name, tolerance, rate) in speed {
        let _ = writeln!(text, "| {name} | {tolerance:e} | {rate:.0} |");
    }
    let _ = write!(
        text,
        "\n## What a city costs\n\n\
         In a synthetic city of {} buildings with {} draws, one thread computes {rate:.0} draws of a pair per second. This includes all work of\n\
         `jostle city run`: runs without contact, runs with contact where the gap closes, the sample with the standard solvers, and the tables\n\
         ({bytes:.0} bytes per draw). The following table is extrapolated from these two numbers, for {PAIRS_A_BUILDING} pairs per building (outlines of San\n\
         Francisco within 0.5 m) and {MOTIONS:.0} motions with one draw each. No run of this size was made. The parts can be computed with `--shard` or by Dask workers, because they are\n\
         independent.\n\n\
         | buildings | draws of a pair | core hours | tables |\n|---|---|---|---|\n",
        CITY.0, CITY.1
    );
    for (name, buildings) in [
        ("100,000", 1e5),
        ("1.84 million, as in the San Francisco Bay Area", 1.84e6),
        ("20 million", 2e7),
        ("100 million", 1e8),
    ] {
        let draws = buildings * PAIRS_A_BUILDING * MOTIONS;
        let _ = writeln!(
            text,
            "| {name} | {draws:.1e} | {} | {:.1} GB |",
            Rounded(draws / rate / 3600.0),
            1e-9 * draws * bytes
        );
    }
    text
}

/// Two digits of a number of hours.
struct Rounded(f64);

impl std::fmt::Display for Rounded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = 10_f64.powf(self.0.abs().log10().floor() - 1.0);
        let rounded = (self.0 / size).round() * size;
        if rounded >= 10.0 {
            write!(f, "{rounded:.0}")
        } else {
            write!(f, "{rounded:.1}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_keep_their_tolerance() {
        let found = compare(12, 6, 7).unwrap_or_else(|error| panic!("{error}"));
        assert!(found.iter().map(|own| own.touching).sum::<usize>() > 40);
        for compare in found {
            assert!(
                compare.within() >= 0.99,
                "{}: {}",
                compare.kind,
                compare.within()
            );
            assert!(
                compare.worst() < 5.0 * compare.tolerance,
                "{}: {:e}",
                compare.kind,
                compare.worst()
            );
        }
    }
}
