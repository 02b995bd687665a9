//! Random pairs of shear buildings: automatic steps against uniform fine steps of the same program.

use std::f64::consts::PI;
use std::fmt::Write;
use std::ops::ControlFlow;

use jostle::{
    Analysis, Building, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model, Outcome, Plan,
    Pounding, RestitutionIs, RunEnd, Settings, Shear, Structure, System, simulate,
};

use crate::Extent;
use crate::row::Row;
use crate::structures::uniform;

/// Errors of automatic steps for one pair, relative to uniform fine steps.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Seed of the pair.
    pub seed: u64,
    /// Contact law.
    pub law: LawKind,
    /// Impacts with uniform steps.
    pub impacts: usize,
    /// Impacts more or less with automatic ones.
    pub count: i64,
    /// Relative error of the peak force of the gap.
    pub force: f64,
    /// Relative error of the sum of all impulses.
    pub impulse: f64,
    /// Relative error of the peak force of the first impact.
    pub first_force: f64,
    /// Relative error of the impulse of the first impact.
    pub first_impulse: f64,
    /// Steps with a closed contact, automatic and uniform.
    pub contact_steps: [u64; 2],
    /// Why a run did not end, if so.
    pub failed: Option<String>,
}

/// Which error of a pair.
type ErrorOf = fn(&Compared) -> f64;

/// Random numbers that are the same everywhere (splitmix64).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        low + (high - low) * (z >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.between(0.0, n as f64) as usize).min(n - 1)
    }
}

/// Uniform step of the reference \[s\]: some hundred steps in the shortest impact.
const FINE: f64 = 2.5e-5;
/// Length of a run \[s\].
const DURATION: f64 = 4.0;

fn building(random: &mut Random, name: &str) -> Building {
    let storeys = 1 + random.below(3);
    let mass = 10_f64.powf(random.between(4.0, 5.5));
    let period = random.between(0.2, 1.5);
    let slowest = 2.0 * (PI / (4 * storeys + 2) as f64).sin();
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![mass; storeys],
            stiffness: vec![mass * (2.0 * PI / period / slowest).powi(2); storeys],
            storey_heights: vec![3.0; storeys],
        }),
        damping: Damping::ratio(
            random.between(0.02, 0.07),
            if storeys > 1 { vec![1, 2] } else { vec![1] },
        ),
        ..Building::default()
    }
}

/// The pair of a seed, and the motion that shakes it.
pub(crate) fn pair(seed: u64, tolerance: f64) -> (Model, GroundMotion) {
    let mut random = Random(seed);
    let buildings = vec![
        building(&mut random, "left"),
        building(&mut random, "right"),
    ];
    // All laws whose force acts over time.
    let laws: Vec<LawKind> = LawKind::ALL
        .into_iter()
        .filter(|kind| *kind != LawKind::Restitution)
        .collect();
    let kind = laws[random.below(laws.len())];
    let usual = if kind.is_hertzian() { 2e9 } else { 1e8 };
    let law = ContactLaw {
        kind,
        stiffness: usual * 10_f64.powf(random.between(-0.5, 0.7)),
        restitution: random.between(0.4, 0.9),
        restitution_is: RestitutionIs::Input,
    };
    let model = Model {
        title: format!("pair {seed}"),
        buildings,
        gaps: vec![Gap::after(0, random.between(0.002, 0.04), law)],
        analysis: Analysis {
            tolerance,
            ..Analysis::default()
        },
        ..Model::default()
    };
    let waves: Vec<[f64; 3]> = (0..4)
        .map(|_| {
            [
                random.between(0.5, 1.5),
                random.between(0.6, 5.0),
                random.between(0.0, 2.0 * PI),
            ]
        })
        .collect();
    let step = 0.01;
    let values = (0..=(DURATION / step).round() as usize).map(|k| {
        let t = k as f64 * step;
        let sum: f64 = waves
            .iter()
            .map(|[a, f, phase]| a * (2.0 * PI * f * t + phase).sin())
            .sum();
        1.5 * t.min(1.0) * sum
    });
    (
        model,
        GroundMotion::sampled("waves", step, values.collect()),
    )
}

pub(crate) fn run(system: &System, motion: &GroundMotion, plan: &Plan) -> Outcome {
    let settings = Settings {
        pounding: Pounding::Included,
        record_interval: None,
        ..Settings::default()
    };
    simulate(
        system,
        motion,
        plan,
        settings,
        |_| ControlFlow::Continue(()),
    )
}

/// Compares one pair.
#[must_use]
pub fn compare(seed: u64, tolerance: f64) -> Compared {
    let (model, motion) = pair(seed, tolerance);
    let system = System::assemble(&model).expect("a sound model");
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("usable steps");
    let (coarse, fine) = (
        run(&system, &motion, &plan),
        run(&system, &motion, &uniform(FINE)),
    );
    let failed = [&coarse, &fine]
        .into_iter()
        .find(|outcome| outcome.end != RunEnd::Completed)
        .map(|outcome| format!("{:?}", outcome.end));
    let peak = |o: &Outcome| o.impacts.iter().fold(0.0, |p: f64, i| p.max(i.peak_force));
    let impulse = |o: &Outcome| o.impacts.iter().fold(0.0, |s, i| s + i.impulse);
    let first = |o: &Outcome| {
        o.impacts
            .iter()
            .min_by(|a, b| a.start.total_cmp(&b.start))
            .map_or([0.0, 0.0], |i| [i.peak_force, i.impulse])
    };
    let relative = |a: f64, b: f64| if a == b { 0.0 } else { (a / b - 1.0).abs() };
    let (a, b) = (first(&coarse), first(&fine));
    Compared {
        seed,
        law: model.gaps[0].law.kind,
        impacts: fine.impacts.len(),
        count: coarse.impacts.len() as i64 - fine.impacts.len() as i64,
        force: relative(peak(&coarse), peak(&fine)),
        impulse: relative(impulse(&coarse), impulse(&fine)),
        first_force: relative(a[0], b[0]),
        first_impulse: relative(a[1], b[1]),
        contact_steps: [coarse.work.contact_steps, fine.work.contact_steps],
        failed,
    }
}

/// Compares the pairs of many seeds, on as many threads as there are processors; the order is that of the seeds.
#[must_use]
pub fn study(seeds: std::ops::RangeInclusive<u64>, tolerance: f64) -> Vec<Compared> {
    let all: Vec<u64> = seeds.collect();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let share = all.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        let parts: Vec<_> = all
            .chunks(share)
            .map(|part| {
                scope.spawn(move || {
                    part.iter()
                        .map(|seed| compare(*seed, tolerance))
                        .collect::<Vec<_>>()
                })
            })
            .collect();
        parts
            .into_iter()
            .flat_map(|part| part.join().expect("a comparison ends"))
            .collect()
    })
}

/// The value below which this share of them lies.
#[must_use]
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    if sorted.is_empty() {
        0.0
    } else {
        jostle::linear::quantile(&sorted, share)
    }
}

/// The study in words and a table.
#[must_use]
pub fn describe(compared: &[Compared], tolerance: f64) -> String {
    let hit: Vec<&Compared> = compared.iter().filter(|c| c.impacts > 0).collect();
    let mut text = String::new();
    let failed: Vec<String> = compared
        .iter()
        .filter_map(|c| c.failed.as_ref().map(|why| format!("{} ({why})", c.seed)))
        .collect();
    let seeds = (
        compared.first().map_or(0, |c| c.seed),
        compared.last().map_or(0, |c| c.seed),
    );
    let _ = writeln!(
        text,
        "{} pairs (seeds {} to {}), tolerance {tolerance:e}: {} with contact, {} impacts; {} runs failed{}.",
        compared.len(),
        seeds.0,
        seeds.1,
        hit.len(),
        hit.iter().map(|c| c.impacts).sum::<usize>(),
        failed.len(),
        if failed.is_empty() {
            String::new()
        } else {
            format!(": {}", failed.join(", "))
        }
    );
    let steps = |k: usize| hit.iter().map(|c| c.contact_steps[k]).sum::<u64>();
    let impacts = hit.iter().map(|c| c.impacts).sum::<usize>().max(1) as f64;
    let _ = writeln!(
        text,
        "Steps per impact: {:.0} automatic, {:.0} uniform.\n",
        steps(0) as f64 / impacts,
        steps(1) as f64 / impacts
    );
    let _ = writeln!(
        text,
        "| relative error | median | 75 % | 90 % | 95 % | 99 % | largest (seed) | within the tolerance |\n|---|---|---|---|---|---|---|---|"
    );
    let quantities: [(&str, ErrorOf); 4] = [
        ("peak force of the gap", |c| c.force),
        ("sum of impulses", |c| c.impulse),
        ("peak force of the first impact", |c| c.first_force),
        ("impulse of the first impact", |c| c.first_impulse),
    ];
    for (name, value) in quantities {
        let values: Vec<f64> = hit.iter().map(|c| value(c)).collect();
        let worst = hit.iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        let within = values.iter().filter(|v| **v <= tolerance).count();
        let _ = writeln!(
            text,
            "| {name} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} ({}) | {:.1} % |",
            quantile(&values, 0.5),
            quantile(&values, 0.75),
            quantile(&values, 0.9),
            quantile(&values, 0.95),
            quantile(&values, 0.99),
            quantile(&values, 1.0),
            worst.map_or(0, |c| c.seed),
            100.0 * within as f64 / values.len().max(1) as f64
        );
    }
    let same = hit.iter().filter(|c| c.count == 0).count();
    let close = hit.iter().filter(|c| c.count.abs() <= 1).count();
    let _ = writeln!(
        text,
        "\nThe number of impacts is the same in {:.1} % of the pairs with contact, and differs by at most one in {:.1} %.",
        100.0 * same as f64 / hit.len().max(1) as f64,
        100.0 * close as f64 / hit.len().max(1) as f64
    );
    text
}

/// Seeds of the reduced study.
const FEW: u64 = 20;
/// Seeds of the full one.
const MANY: u64 = 1000;

/// Rows of the validation: no run fails, and most pairs meet the tolerance.
#[must_use]
pub fn rows(extent: Extent) -> Vec<Row> {
    const TOLERANCE: f64 = 1e-3;
    let seeds = if extent == Extent::Full { MANY } else { FEW };
    let compared = study(1..=seeds, TOLERANCE);
    let hit: Vec<&Compared> = compared.iter().filter(|c| c.impacts > 0).collect();
    let source = "uniform steps of 25 µs";
    let failed = compared.iter().filter(|c| c.failed.is_some()).count();
    let mut rows = vec![Row::absolute(
        source,
        format!("seeds 1 to {seeds}: runs that fail"),
        0.0,
        failed as f64,
        0.0,
    )];
    let quantities: [(&str, ErrorOf); 3] = [
        ("peak force of the first impact", |c| c.first_force),
        ("impulse of the first impact", |c| c.first_impulse),
        ("peak force of the gap", |c| c.force),
    ];
    for (name, value) in quantities {
        let values: Vec<f64> = hit.iter().map(|c| value(c)).collect();
        rows.push(Row::absolute(
            source,
            format!("seeds 1 to {seeds}: {name}, relative error not exceeded in 90 % of the pairs"),
            0.0,
            quantile(&values, 0.9),
            TOLERANCE,
        ));
    }
    rows
}
