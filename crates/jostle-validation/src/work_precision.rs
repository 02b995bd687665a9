//! Work against precision: automatic and fixed steps on random pairs of shear buildings.

use std::fmt::Write;

use jostle::stepping::ContactSteps;
use jostle::{Outcome, Plan, Solver, System};

use crate::pairs::{self, quantile};

/// One way of choosing steps, at one setting.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Tolerance or step, for display.
    pub name: String,
    /// Mean work of a run: solutions, a factorisation counted as three of them.
    pub work: f64,
    /// Median and 90 % quantile of the relative error of the peak force of the gap.
    pub force: [f64; 2],
    /// The same of the sum of impulses.
    pub impulse: [f64; 2],
}

/// One way of choosing steps.
#[derive(Clone, Debug)]
pub struct Way {
    /// Its name.
    pub name: &'static str,
    /// Coarse to fine.
    pub settings: Vec<Setting>,
}

/// Seeds of the pairs.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=60;
/// Uniform step of the reference \[s\].
const REFERENCE: f64 = 1e-5;

struct Case {
    system: System,
    seed: u64,
    reference: [f64; 2],
}

fn answer(outcome: &Outcome) -> [f64; 2] {
    let impacts = &outcome.impacts;
    [
        impacts.iter().fold(0.0, |p: f64, i| p.max(i.peak_force)),
        impacts.iter().fold(0.0, |s, i| s + i.impulse),
    ]
}

fn fixed(step: f64, division: u32) -> Plan {
    Plan {
        step,
        contact_steps: ContactSteps::Fixed(division),
        integrator: jostle::Integrator::default(),
        solver: Solver::Riccati,
        vertical: false,
        is_given: true,
        collapse_drift: jostle::model::COLLAPSE_DRIFT,
    }
}

/// Runs the study; takes some minutes.
#[must_use]
pub fn study() -> Vec<Way> {
    let cases: Vec<Case> = SEEDS
        .filter_map(|seed| {
            let (model, motion) = pairs::pair(seed, 1e-3);
            let system = System::assemble(&model).expect("a sound model");
            let fine = pairs::run(&system, &motion, &fixed(REFERENCE, 1));
            let reference = answer(&fine);
            (reference[0] > 0.0).then_some(Case {
                system,
                seed,
                reference,
            })
        })
        .collect();
    let measure = |name: String, plan: &dyn Fn(&Case) -> Plan| {
        let (mut force, mut impulse, mut work) = (Vec::new(), Vec::new(), 0.0);
        for case in &cases {
            let (_, motion) = pairs::pair(case.seed, 1e-3);
            let outcome = pairs::run(&case.system, &motion, &plan(case));
            let got = answer(&outcome);
            force.push((got[0] / case.reference[0] - 1.0).abs());
            impulse.push((got[1] / case.reference[1] - 1.0).abs());
            work += (outcome.work.solves + 3 * outcome.work.factorizations) as f64;
        }
        let both = |values: &[f64]| [quantile(values, 0.5), quantile(values, 0.9)];
        Setting {
            name,
            work: work / cases.len() as f64,
            force: both(&force),
            impulse: both(&impulse),
        }
    };
    let automatic = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4]
        .into_iter()
        .map(|tolerance| {
            measure(format!("tolerance {tolerance:e}"), &|case| {
                let (model, motion) = pairs::pair(case.seed, tolerance);
                Plan::choose(&case.system, &motion, &model.analysis).expect("usable steps")
            })
        });
    let automatic = automatic.collect();
    let uniform = [2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5]
        .into_iter()
        .map(|step| measure(format!("{} ms", step * 1e3), &|_| fixed(step, 1)))
        .collect();
    let two_steps = [5e-3, 2e-3, 1e-3, 5e-4, 2e-4]
        .into_iter()
        .map(|step| {
            measure(
                format!("{} ms, in contact {} ms", step * 1e3, step * 1e2),
                &|_| fixed(step, 10),
            )
        })
        .collect();
    vec![
        Way {
            name: "automatic steps",
            settings: automatic,
        },
        Way {
            name: "one fixed step",
            settings: uniform,
        },
        Way {
            name: "two fixed steps",
            settings: two_steps,
        },
    ]
}

/// The study as a page.
#[must_use]
pub fn page(ways: &[Way]) -> String {
    let mut text = format!(
        "# Work and precision\n\n\
         <!-- Written by `cargo run --release -p jostle-validation -- --work-precision`; do not edit. -->\n\n\
         This page compares the cost of accuracy of automatic and fixed time steps. The models are random pairs of shear buildings \
         (seeds {} to {}) of one to three storeys under 4 s of strong shaking, with all contact laws except `restitution`. Pairs \
         without contact are left out. The tables list the median and the 90 % quantile of two errors: that of the peak force of the \
         gap, and that of the sum of all impulses. Both are relative to a run with uniform steps of {} µs. *Work* is the mean number of \
         solutions of one building per run; a factorisation counts as three solutions. \
         *Two fixed steps*: one step size in free vibration, and a tenth of it during contact.\n\n\
         ![Error of the peak contact force against work, for automatic and fixed steps: median, and 90 % of the pairs (dashed)](figures/work-precision.svg)\n\n",
        SEEDS.start(),
        SEEDS.end(),
        REFERENCE * 1e6
    );
    for way in ways {
        let _ = writeln!(
            text,
            "## {}\n\n| setting | work | force, median | force, 90 % | impulse, median | impulse, 90 % |\n|---|---|---|---|---|---|",
            capitalised(way.name)
        );
        for s in &way.settings {
            let _ = writeln!(
                text,
                "| {} | {:.0} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |",
                s.name, s.work, s.force[0], s.force[1], s.impulse[0], s.impulse[1]
            );
        }
        text.push('\n');
    }
    for way in ways.iter().skip(1) {
        for target in [1e-2, 1e-3] {
            if let (Some(one), Some(other)) = (work_for(&ways[0], target), work_for(way, target)) {
                let _ = writeln!(
                    text,
                    "- For a force error of {target:e} in 90 % of the pairs, the work with {} is {:.1} times that with automatic steps.",
                    way.name,
                    other / one
                );
            }
        }
    }
    text
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + letters.as_str()
    })
}

/// Work at which the 90 % quantile of the force error reaches a target, straight between settings on log scales.
fn work_for(way: &Way, target: f64) -> Option<f64> {
    way.settings.windows(2).find_map(|pair| {
        let (a, b) = (pair[0].force[1], pair[1].force[1]);
        (a >= target && b <= target && a > b).then(|| {
            let share = (a / target).ln() / (a / b).ln();
            (pair[0].work.ln() + share * (pair[1].work / pair[0].work).ln()).exp()
        })
    })
}

/// Left, top, width and height of the plot.
const AREA: [f64; 4] = [70.0, 20.0, 600.0, 340.0];

/// The figure of the page: light or dark as the reader's system.
#[must_use]
pub fn figure(ways: &[Way]) -> String {
    let all = || ways.iter().flat_map(|way| &way.settings);
    let decade = |value: f64, up: bool| {
        let exponent = value.log10();
        if up {
            exponent.ceil()
        } else {
            exponent.floor()
        }
    };
    let least = |value: fn(&Setting) -> f64| all().map(value).fold(f64::INFINITY, f64::min);
    let most = |value: fn(&Setting) -> f64| all().map(value).fold(0.0, f64::max);
    let (x0, x1) = (
        decade(least(|s| s.work), false),
        decade(most(|s| s.work), true),
    );
    let (y0, y1) = (
        decade(least(|s| s.force[0]), false),
        decade(most(|s| s.force[1]), true),
    );
    let [left, top, width, height] = AREA;
    let place = |work: f64, error: f64| {
        (
            left + (work.log10() - x0) / (x1 - x0) * width,
            top + (y1 - error.log10()) / (y1 - y0) * height,
        )
    };
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 700 420\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n\
         <title>Error of the greatest contact force against work</title>\n\
         <style>svg{--paper:#fff;--rule:#d9dde3;--ink:#1a1d21;--ink-2:#59616b;--c0:#0072b2;--c1:#d55e00;--c2:#00865f}\n\
         @media(prefers-color-scheme:dark){svg{--paper:#15181c;--rule:#343a43;--ink:#e9ebee;--ink-2:#a3abb6;--c0:#56b4e9;--c1:#ff8c42;--c2:#2fc99c}}\n\
         .paper{fill:var(--paper)}text{fill:var(--ink-2)}.key{fill:var(--ink)}.grid{stroke:var(--rule)}path{fill:none;stroke-width:2}.most{stroke-dasharray:5 3;stroke-width:1.2}</style>\n\
         <rect class=\"paper\" width=\"700\" height=\"420\"/>\n",
    );
    for exponent in x0 as i32..=x1 as i32 {
        let (x, _) = place(10f64.powi(exponent), 1.0);
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M{x:.1} {top}v{height}\" style=\"stroke-width:1\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">10<tspan dy=\"-5\" font-size=\"9\">{exponent}</tspan></text>",
            top + height + 20.0
        );
    }
    for exponent in y0 as i32..=y1 as i32 {
        let (_, y) = place(1.0, 10f64.powi(exponent));
        let _ = writeln!(
            svg,
            "<path class=\"grid\" d=\"M{left} {y:.1}h{width}\" style=\"stroke-width:1\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">10<tspan dy=\"-5\" font-size=\"9\">{exponent}</tspan></text>",
            left - 8.0,
            y + 5.0
        );
    }
    for (index, way) in ways.iter().enumerate() {
        let colour = format!("style=\"stroke:var(--c{index})\"");
        for (quantile, class) in [(0, "median"), (1, "most")] {
            let points: Vec<String> = way
                .settings
                .iter()
                .map(|s| place(s.work, s.force[quantile]))
                .map(|(x, y)| format!("{x:.1} {y:.1}"))
                .collect();
            let _ = writeln!(
                svg,
                "<path class=\"{class}\" {colour} d=\"M{}\"/>",
                points.join("L")
            );
        }
        for s in &way.settings {
            let (x, y) = place(s.work, s.force[0]);
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.2\" style=\"fill:var(--c{index})\"/>"
            );
        }
        let y = top + 20.0 + 19.0 * index as f64;
        let x = left + width - 200.0;
        let _ = writeln!(
            svg,
            "<path {colour} d=\"M{x} {y}h26\"/><text class=\"key\" x=\"{}\" y=\"{}\">{}</text>",
            x + 34.0,
            y + 4.0,
            way.name
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">work: solutions of one building</text><text x=\"{}\" y=\"14\">error of the peak force: median; dashed, 90 % of the pairs</text>\n</svg>",
        left + width,
        top + height + 42.0,
        left
    );
    svg
}
