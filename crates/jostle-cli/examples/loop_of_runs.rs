//! Runs a model many times and prints the CPU time [s]: what `benches/python/overhead.py` compares Python with.
//!
//! `cargo run --release -p jostle-cli --example loop_of_runs -- MODEL RUNS`
#![allow(clippy::print_stdout, reason = "a benchmark prints its time")]

use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use jostle::{Plan, Run, Settings, Summary, System, simulate};

/// As in the program and in the Python module.
#[global_allocator]
static MEMORY: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, model, runs] = &arguments[..] else {
        return Err("usage: loop_of_runs MODEL RUNS".into());
    };
    let input = jostle_io::read_model_file(Path::new(model))?;
    let system = System::assemble(&input.model).map_err(|faults| input.faults(faults))?;
    let before = cpu_time()?;
    for _ in 0..runs.parse()? {
        let motion = input.ground_motion()?;
        let plan = Plan::choose(&system, &motion, &input.model.analysis)
            .map_err(|faults| input.faults(faults))?;
        let settings = Settings::default();
        let outcome = simulate(&system, &motion, &plan, settings, |_| {
            ControlFlow::Continue(())
        });
        black_box(Summary::new(&Run {
            model: &input.model,
            system: &system,
            motion: &motion,
            plan: &plan,
            outcome: &outcome,
            without_contact: None,
            wall: 0.0,
        }));
    }
    println!("{}", (cpu_time()? - before).as_secs_f64());
    Ok(())
}

/// CPU time of this process so far, as Linux keeps it.
fn cpu_time() -> Result<Duration, Box<dyn std::error::Error>> {
    let text = std::fs::read_to_string("/proc/self/schedstat")?;
    let nanoseconds = text.split_whitespace().next().ok_or("no time")?;
    Ok(Duration::from_nanos(nanoseconds.parse()?))
}
