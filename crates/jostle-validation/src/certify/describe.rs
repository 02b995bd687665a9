//! A study in words.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::Certified;

#[derive(Default)]
struct Count {
    all: usize,
    within: usize,
    thrice: usize,
    uncertain: usize,
    worst: f64,
    place: String,
}

impl Count {
    fn add(&mut self, ratio: Option<f64>, place: impl Fn() -> String) {
        let Some(ratio) = ratio else {
            self.uncertain += 1;
            return;
        };
        self.all += 1;
        self.within += usize::from(ratio <= 1.0);
        self.thrice += usize::from(ratio <= 3.0);
        if ratio > self.worst || self.place.is_empty() {
            self.worst = ratio;
            self.place = place();
        }
    }

    fn line(&self, name: &str) -> String {
        let share = |part: usize| 100.0 * part as f64 / self.all.max(1) as f64;
        format!(
            "{name:<44} {:>7} {:>8.2} % {:>8.2} % {:>7} {:>10.3}  {}",
            self.all,
            share(self.within),
            share(self.thrice),
            self.uncertain,
            self.worst,
            self.place
        )
    }
}

/// The study in words.
#[must_use]
pub fn describe(all: &[Certified]) -> String {
    let mut text = String::new();
    let mut tables: [BTreeMap<String, Count>; 5] = Default::default();
    let (mut runs, mut off, mut warned, mut warned_for_nothing) = (0, 0, 0, 0);
    let (mut cut, mut nothing) = (0, 0);
    let mut failures = Vec::new();
    let mut alarms = String::new();
    for model in all {
        if let Some(why) = &model.failed {
            failures.push(format!("model {}: no reference: {why}", model.number));
            continue;
        }
        for run in &model.runs {
            let way = format!("{} at {:.0e}", run.solver, run.tolerance);
            if let Some(why) = &run.failed {
                failures.push(format!("model {} {way}: {why}", model.number));
                continue;
            }
            runs += 1;
            cut += usize::from(run.cut.is_some());
            if let Some(why) = &run.false_alarm {
                let _ = writeln!(alarms, "model {} {way}: false alarm: {why}", model.number);
            }
            nothing += usize::from(run.truth.quantities.is_empty());
            let mut worst: (f64, usize) = (0.0, 0);
            for (k, (quantity, error)) in run.truth.quantities.iter().zip(&run.errors).enumerate() {
                let ratio = error.map(|error| error / run.tolerance);
                if let Some(ratio) = ratio.filter(|ratio| *ratio > worst.0) {
                    worst = (ratio, k);
                }
                let place = || {
                    format!(
                        "model {} {} {}, {way}",
                        model.number, quantity.kind, quantity.name
                    )
                };
                let keys = [
                    way.clone(),
                    format!("{} {}", quantity.kind, run.solver),
                    format!(
                        "law {}",
                        if model.touches > 0 {
                            &model.laws
                        } else {
                            "none touches"
                        }
                    ),
                    format!("{} {}", model.kind, run.solver),
                    "all".into(),
                ];
                for (table, key) in tables.iter_mut().zip(keys) {
                    table.entry(key).or_default().add(ratio, place);
                }
            }
            if worst.0 > 1.0 {
                off += 1;
                warned += usize::from(run.warned);
                let quantity = &run.truth.quantities[worst.1];
                let bad = run
                    .errors
                    .iter()
                    .flatten()
                    .filter(|e| **e > run.tolerance)
                    .count();
                let _ = writeln!(
                    text,
                    "model {:>4} | {:<5} | {} | {} | {way:<16} | {} {} | got {:.6e} | reference {:.6e} | {:.2} times | {bad} of {} | {} touches{}",
                    model.number,
                    model.kind,
                    model.buildings,
                    model.laws,
                    quantity.kind,
                    quantity.name,
                    run.got[worst.1],
                    quantity.value,
                    worst.0,
                    run.errors.len(),
                    model.touches,
                    if model.lasting > 0 {
                        format!(", {} lasting", model.lasting)
                    } else {
                        String::new()
                    },
                );
            } else {
                warned_for_nothing += usize::from(run.warned);
            }
        }
    }
    let _ = writeln!(
        text,
        "\n{:<44} {:>7} {:>10} {:>10} {:>7} {:>10}  where",
        "", "numbers", "within 1", "within 3", "unsure", "worst"
    );
    for table in &tables {
        for (name, count) in table {
            let _ = writeln!(text, "{}", count.line(name));
        }
        text.push('\n');
    }
    let _ = writeln!(
        text,
        "{} models, {runs} runs; {off} runs have a number beyond the tolerance, {warned} of them warned; {warned_for_nothing} others warned.",
        all.len()
    );
    let _ = writeln!(
        text,
        "{cut} runs were sensitive: their peaks before the sensitive instant are counted; {nothing} of them promise nothing.",
    );
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    for (solver, why) in all.iter().flat_map(|model| &model.refusals) {
        // Without the names of buildings.
        let why: Vec<&str> = why.split('"').step_by(2).collect();
        *refused
            .entry(format!("{solver}: {}", why.join("…")))
            .or_default() += 1;
    }
    text.push_str(&alarms);
    for (why, models) in refused {
        let _ = writeln!(text, "{models} models are refused by {why}");
    }
    let spent: f64 = all.iter().map(|model| model.seconds).sum();
    let seconds: f64 = all
        .iter()
        .flat_map(|model| &model.runs)
        .map(|run| run.seconds)
        .sum();
    let slowest = all.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let _ = writeln!(
        text,
        "References took {spent:.0} s (slowest: model {}, {:.1} s), runs {seconds:.0} s.",
        slowest.map_or(0, |model| model.number),
        slowest.map_or(0.0, |model| model.seconds)
    );
    for failure in failures {
        let _ = writeln!(text, "{failure}");
    }
    text
}
