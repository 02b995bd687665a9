//! Two towers under harmonic motion, beside what was observed on a shake table: `docs/harmonic-pounding.md` and its figures.
//!
//! K. T. Chau, X. X. Wei, X. Guo and C. Y. Shen (2003), *Experimental and theoretical simulations of seismic poundings between
//! two adjacent structures*, Earthquake Engineering and Structural Dynamics 32.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::Path;

use jostle::stepping::ContactSteps;
use jostle::{Column, GroundMotion, Plan, Settings, Solver, System, Wave, simulate};
use jostle_io::{Format, read_model_text};
use rayon::prelude::*;

/// Natural frequency of the soft tower \[Hz\].
const SOFT: f64 = 1.0;
/// That of the stiff one \[Hz\].
const STIFF: f64 = 2.0;
/// Other stiff towers \[Hz\].
const STIFFER: [f64; 5] = [1.1, 1.3, 1.6, 2.0, 3.0];
/// Amplitude of the ground \[m/s²\].
const AMPLITUDE: f64 = 1.0;
/// Gap \[m\].
const GAP: f64 = 0.01;
/// Damping ratio of the towers \[–\].
const DAMPING: f64 = 0.05;
/// Cycles until starting has died away, and cycles that are looked at.
const CYCLES: [usize; 2] = [160, 64];
/// The same for motions that do not repeat in these, so that slow decay is not taken for one.
const LONG: [usize; 2] = [1000, 512];
/// Steps of a cycle.
const STEPS: usize = 500;
/// Longest period that is looked for \[cycles\].
const LONGEST: usize = 16;
/// Two states closer than this part of their range are one \[–\].
const SAME: f64 = 1e-3;
/// Frequencies of the sweep \[Hz\].
const SWEEP: (f64, f64, usize) = (0.5, 3.5, 241);

/// The steady state under one frequency.
#[derive(Clone, Debug)]
pub struct Steady {
    /// Frequency of the ground \[Hz\].
    pub frequency: f64,
    /// Greatest impact speed; zero without impacts \[m/s\].
    pub impact_speed: f64,
    /// Mean number of impacts in a cycle.
    pub impacts: f64,
    /// Greatest displacements of the soft and the stiff tower \[m\].
    pub displacement: [f64; 2],
    /// The same without contact \[m\].
    pub apart: [f64; 2],
    /// Greatest closing without contact \[m\].
    pub closing: f64,
    /// Cycles after which the motion repeats itself; `None` for none up to the longest.
    pub period: Option<usize>,
    /// Displacement and velocity of the soft tower once a cycle \[m, m/s\].
    pub section: Vec<[f64; 2]>,
}

fn towers(stiff: f64, gap: f64) -> System {
    let mass = 1e5;
    let spring = |frequency: f64| mass * (TAU * frequency).powi(2);
    let building = |name: &str, frequency: f64| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nmass = [{mass}]\nstiffness = [{}]\nstorey_height = 3.2\ndamping = {{ ratio = {DAMPING}, modes = [1] }}\n",
            spring(frequency)
        )
    };
    let text = format!(
        "{}{}[[gap]]\nbetween = [\"soft\", \"stiff\"]\nwidth = {gap}\nlaw = \"hertz-damp\"\nstiffness = 2e9\nrestitution = 0.6\n[analysis]\naccept_unusual = true\n",
        building("soft", SOFT),
        building("stiff", stiff)
    );
    let input =
        read_model_text("towers", &text, Format::Toml, Path::new("")).expect("a sound model");
    System::assemble(&input.model).expect("a sound model")
}

/// The last cycles of a run.
fn run(system: &System, frequency: f64, cycles: [usize; 2]) -> (jostle::Outcome, Vec<[f64; 5]>) {
    let cycle = 1.0 / frequency;
    let motion = GroundMotion {
        name: "sine".into(),
        scale: 1.0,
        duration: (cycles[0] + cycles[1]) as f64 * cycle,
        wave: Wave::Sine {
            amplitude: AMPLITUDE,
            period: cycle,
        },
        bearing: None,
        grounds: None,
    };
    let plan = Plan {
        step: cycle / STEPS as f64,
        contact_steps: ContactSteps::Fixed(20),
        integrator: jostle::Integrator::default(),
        solver: Solver::Riccati,
        vertical: false,
        is_given: true,
        collapse_drift: jostle::model::COLLAPSE_DRIFT,
    };
    let settings = Settings {
        record_interval: Some(0.0),
        ..Settings::default()
    };
    let outcome = simulate(system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    let history = outcome.history.as_ref().expect("histories are recorded");
    let column = |column| history.column(column).expect("it is recorded");
    let place = |building| Column::displacement(building, 1);
    let rate = |building| Column::velocity(building, 1);
    let lists = [Column::TIME, place(0), rate(0), place(1), rate(1)].map(column);
    let settled = cycles[0] as f64 * cycle * (1.0 - 1e-9);
    let rows = (0..history.len())
        .map(|k| lists.each_ref().map(|list| list[k]))
        .filter(|row| row[0] >= settled)
        .collect();
    (outcome, rows)
}

fn steady(together: &System, apart: &System, frequency: f64) -> Steady {
    let found = settled(together, apart, frequency, CYCLES);
    match found.period {
        Some(_) => found,
        None => settled(together, apart, frequency, LONG),
    }
}

fn settled(together: &System, apart: &System, frequency: f64, cycles: [usize; 2]) -> Steady {
    let cycle = 1.0 / frequency;
    let settled = cycles[0] as f64 * cycle;
    let (outcome, rows) = run(together, frequency, cycles);
    let (_, without) = run(apart, frequency, CYCLES);
    let peak =
        |rows: &[[f64; 5]], of: fn(&[f64; 5]) -> f64| rows.iter().map(of).fold(0.0, f64::max);
    let impacts: Vec<_> = outcome
        .impacts
        .iter()
        .filter(|i| i.start >= settled)
        .collect();
    // The rows at whole cycles; steps divide the cycle.
    let states: Vec<[f64; 5]> = rows
        .iter()
        .filter(|row| {
            let cycles = row[0] / cycle;
            (cycles - cycles.round()).abs() < 1e-6
        })
        .copied()
        .collect();
    Steady {
        frequency,
        impact_speed: impacts.iter().map(|i| i.impact_speed).fold(0.0, f64::max),
        impacts: impacts.len() as f64 / cycles[1] as f64,
        displacement: [peak(&rows, |r| r[1].abs()), peak(&rows, |r| r[3].abs())],
        apart: [
            peak(&without, |r| r[1].abs()),
            peak(&without, |r| r[3].abs()),
        ],
        closing: peak(&without, |r| r[1] - r[3]),
        period: period(&states),
        section: states.iter().map(|row| [row[1], row[2]]).collect(),
    }
}

/// After how many cycles all four states repeat themselves.
fn period(states: &[[f64; 5]]) -> Option<usize> {
    let range = |index: usize| {
        let values = states.iter().map(|row| row[index].abs());
        values.fold(f64::MIN_POSITIVE, f64::max)
    };
    let ranges: Vec<f64> = (1..5).map(range).collect();
    (1..=LONGEST).find(|n| {
        states.iter().zip(&states[*n..]).all(|(a, b)| {
            (1..5).all(|index| (a[index] - b[index]).abs() <= SAME * ranges[index - 1])
        })
    })
}

/// The sweep of one pair of towers.
#[must_use]
pub fn sweep(stiff: f64) -> Vec<Steady> {
    let (together, apart) = (towers(stiff, GAP), towers(stiff, 10.0));
    let (from, to, count) = SWEEP;
    let frequency = |k: usize| from + (to - from) * k as f64 / (count - 1) as f64;
    (0..count)
        .into_par_iter()
        .map(|k| steady(&together, &apart, frequency(k)))
        .collect()
}

/// All sweeps.
pub struct Study {
    /// Of the pair in the figures.
    main: Vec<Steady>,
    /// Of other stiff towers.
    others: Vec<(f64, Vec<Steady>)>,
}

/// Runs all sweeps; takes minutes.
#[must_use]
pub fn study() -> Study {
    let others = STIFFER.map(|stiff| (stiff, sweep(stiff))).to_vec();
    let main = others.iter().find(|(stiff, _)| *stiff == STIFF);
    let main = main.map_or_else(|| sweep(STIFF), |(_, sweep)| sweep.clone());
    Study { main, others }
}

/// A share in whole per cent of the frequencies with impacts.
fn share(sweep: &[Steady], of: impl Fn(&Steady) -> bool) -> f64 {
    let hit: Vec<&Steady> = sweep.iter().filter(|s| s.impacts > 0.0).collect();
    let count = hit.iter().filter(|s| of(s)).count();
    100.0 * count as f64 / hit.len().max(1) as f64
}

fn greatest(sweep: &[Steady], of: impl Fn(&Steady) -> f64) -> &Steady {
    let most = sweep.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
    most.expect("a sweep is not empty")
}

/// One impact in every cycle or in every `n`-th.
fn once_in(s: &Steady, n: usize) -> bool {
    s.period == Some(n) && (s.impacts * n as f64 - 1.0).abs() < 1e-9
}

/// The page.
#[must_use]
pub fn page(study: &Study) -> String {
    let main = &study.main;
    let fastest = greatest(main, |s| s.impact_speed);
    let widest = greatest(main, |s| s.closing);
    let near = |frequency: f64| {
        let distance = |s: &&Steady| (s.frequency - frequency).abs();
        main.iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .expect("a sweep is not empty")
    };
    let ratio = |s: &Steady, tower: usize| s.displacement[tower] / s.apart[tower];
    let hit: Vec<&Steady> = main.iter().filter(|s| s.impacts > 0.0).collect();
    let range = (
        hit.first().map_or(0.0, |s| s.frequency),
        hit.last().map_or(0.0, |s| s.frequency),
    );
    let mut text = format!(
        "# Harmonic pounding, compared with a shake table\n\n\
         <!-- Written by `cargo run --release -p jostle-validation -- --harmonic`; do not edit. -->\n\n\
         K. T. Chau, X. X. Wei, X. Guo and C. Y. Shen (2003, *Experimental and theoretical simulations of seismic poundings between two \
         adjacent structures*, Earthquake Engineering and Structural Dynamics 32) tested the pounding of two steel towers on a shake \
         table, under sinusoidal motion and under El Centro. This page compares their observations with computed towers. The comparison is \
         qualitative, because the masses, frequencies, damping and contact law are not those of the tested towers. To compare a model \
         with the recorded data of a test, see [Compare with a shake-table test](how-to/shake-table.md).\n\n\
         The model consists of two towers of one storey with natural frequencies of {SOFT} Hz (the soft tower) and {STIFF} Hz (the stiff tower). Both have a mass of \
         100 t and {:.0} % damping, and the gap between them is {:.0} mm. The contact law is `hertz-damp` with a restitution of 0.6. The \
         ground acceleration is a sine of {AMPLITUDE} m/s². The motion settles during the first {} cycles, and the next {} cycles are evaluated, at each of {} frequencies from \
         {} to {} Hz.\n\n\
         ## Impact speed over frequency\n\n\
         ![Greatest impact speed and greatest displacements over the frequency of the ground](figures/harmonic-speed.svg)\n\n\
         Impacts occur at frequencies from {:.2} to {:.2} Hz. The greatest impact speed, {:.2} m/s, occurs at {:.2} Hz. The colour of each dot shows \
         whether the motion repeats every cycle, every few cycles, or not within {LONGEST} cycles.\n\n\
         ## Poincaré sections\n\n\
         ![Displacement and velocity of the soft tower once a cycle](figures/harmonic-poincare.svg)\n\n\
         The figure shows the displacement and velocity of the soft tower at the start of every cycle, for three frequencies of the pair \
         above and one frequency of a pair with a stiff tower of {} Hz. A single point means that the motion repeats every cycle, and a few \
         points that it repeats after a few cycles. A cloud of points means that it does not repeat.\n\n\
         ## What agrees, and what does not\n\n\
         | observed on the shake table | computed | verdict |\n|---|---|---|\n",
        100.0 * DAMPING,
        1e3 * GAP,
        CYCLES[0],
        CYCLES[1],
        SWEEP.2,
        SWEEP.0,
        SWEEP.1,
        range.0,
        range.1,
        fastest.impact_speed,
        fastest.frequency,
        STIFFER[STIFFER.len() - 1]
    );
    let between = SOFT < fastest.frequency && fastest.frequency < STIFF;
    let verdict = |agrees: bool| if agrees { "agrees" } else { "does not agree" };
    let _ = writeln!(
        text,
        "| The greatest impact speed occurs at a frequency between the natural frequencies of the two towers. | at {:.2} Hz, between {SOFT} and {STIFF} Hz | {} |",
        fastest.frequency,
        verdict(between)
    );
    let _ = writeln!(
        text,
        "| The distance needed to avoid pounding is greatest near the natural frequency of the more flexible tower. | greatest closing without contact {:.0} mm, at {:.2} Hz | {} |",
        1e3 * widest.closing,
        widest.frequency,
        verdict((widest.frequency / SOFT - 1.0).abs() < 0.1)
    );
    let _ = writeln!(
        text,
        "| Impacts occur once in every cycle, or in every second cycle. | of the frequencies with impacts, {:.0} % have one impact in every cycle, and {:.0} % one in every second cycle | {} |",
        share(main, |s| once_in(s, 1)),
        share(main, |s| once_in(s, 2)),
        verdict(main.iter().any(|s| once_in(s, 1)) && main.iter().any(|s| once_in(s, 2)))
    );
    let groups = share(main, |s| {
        s.period
            .is_some_and(|n| (s.impacts * n as f64).round() > 1.0)
    });
    let _ = writeln!(
        text,
        "| Groups of impacts repeat themselves. | of the frequencies with impacts, {groups:.0} % have a group of two or more impacts that repeats within {LONGEST} cycles | {} |",
        verdict(groups > 0.0)
    );
    let chaotic = |sweep: &[Steady]| share(sweep, |s| s.period.is_none());
    let shares: Vec<(f64, f64)> = study
        .others
        .iter()
        .map(|(stiff, sweep)| (*stiff, chaotic(sweep)))
        .collect();
    let last = shares.last().copied().unwrap_or_default();
    let _ = writeln!(
        text,
        "| Impacts can be chaotic. | at {:.0} % of the frequencies the motion does not repeat within {LONGEST} cycles; with a stiff tower of {} Hz, at {:.0} % | {} |",
        chaotic(main),
        last.0,
        last.1,
        verdict(last.1 > 0.0 || chaotic(main) > 0.0)
    );
    let listed: Vec<String> = shares
        .iter()
        .map(|(stiff, share)| format!("{stiff} Hz: {share:.0} %"))
        .collect();
    let grows = shares.windows(2).all(|pair| pair[1].1 >= pair[0].1);
    let _ = writeln!(
        text,
        "| Chaotic motion develops when the difference of the natural frequencies becomes larger. | share of frequencies at which the motion does not repeat, for a stiff tower of {} | {} |",
        listed.join(", "),
        if grows {
            "agrees"
        } else if shares.last().map(|s| s.1) > shares.first().map(|s| s.1) {
            "agrees in part: the share does not increase with every difference"
        } else {
            "does not agree"
        }
    );
    let (soft, stiff) = (near(SOFT), near(STIFF));
    let _ = writeln!(
        text,
        "| Pounding amplifies the stiffer tower and suppresses the more flexible one. | peak displacement with contact ÷ without contact, at {:.2} Hz: stiff {:.2}, soft {:.2}; at {:.2} Hz: stiff {:.2}, soft {:.2} | {} |",
        soft.frequency,
        ratio(soft, 1),
        ratio(soft, 0),
        stiff.frequency,
        ratio(stiff, 1),
        ratio(stiff, 0),
        match (
            ratio(soft, 1) > 1.0 && ratio(soft, 0) < 1.0,
            ratio(stiff, 1) > 1.0 && ratio(stiff, 0) < 1.0
        ) {
            (true, true) => "agrees",
            (true, false) =>
                "agrees near the natural frequency of the soft tower; near that of the stiff tower the effect is reversed",
            (false, _) => "does not agree",
        }
    );
    let _ = write!(
        text,
        "\nA motion that does not repeat within {LONGEST} cycles may be chaotic, or it may be a combination of two periods without a common \
         multiple. The Poincaré section distinguishes the two: if it is such a combination, the points form a closed curve. Two states count as equal if \
         they differ by less than 0.1 % of their range. Motions that do not repeat are computed for {} more cycles, of which the last {} are evaluated.\n\n\
         The tested towers were of steel and had less damping, which makes resonances narrower and impacts faster. The first and last rows \
         of the table are checked by the test `crates/jostle/tests/mechanics/verification/harmonic_pounding.rs`.\n",
        LONG[0] - CYCLES[0],
        LONG[1]
    );
    text
}

const STYLE: &str = "<style>svg{--paper:#fff;--rule:#d9dde3;--ink:#1a1d21;--ink-2:#59616b;--c0:#0072b2;--c1:#d55e00;--c2:#00865f}\n\
@media(prefers-color-scheme:dark){svg{--paper:#15181c;--rule:#343a43;--ink:#e9ebee;--ink-2:#a3abb6;--c0:#56b4e9;--c1:#ff8c42;--c2:#2fc99c}}\n\
.paper{fill:var(--paper)}text{fill:var(--ink-2)}.key{fill:var(--ink)}.grid{stroke:var(--rule);stroke-width:1}path{fill:none;stroke-width:2}</style>\n";

/// One panel of a figure.
struct Panel {
    /// Left, top, width, height.
    area: [f64; 4],
    x: [f64; 2],
    y: [f64; 2],
}

impl Panel {
    fn place(&self, x: f64, y: f64) -> [f64; 2] {
        let [left, top, width, height] = self.area;
        [
            left + (x - self.x[0]) / (self.x[1] - self.x[0]) * width,
            top + (self.y[1] - y) / (self.y[1] - self.y[0]) * height,
        ]
    }

    /// Grid with numbers, title and names of the axes.
    fn frame(
        &self,
        svg: &mut String,
        title: &str,
        x_label: &str,
        steps: [f64; 2],
        scale: [f64; 2],
    ) {
        let [left, top, width, height] = self.area;
        let ticks = |range: [f64; 2], step: f64| {
            let first = (range[0] / step - 1e-9).ceil() as i64;
            let last = (range[1] / step + 1e-9).floor() as i64;
            (first..=last).map(move |k| k as f64 * step)
        };
        let number = |value: f64| {
            let text = format!("{value:.3}");
            let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
            if text == "-0" {
                "0".to_owned()
            } else {
                text.replace('-', "−")
            }
        };
        for x in ticks(self.x, steps[0]) {
            let [at, _] = self.place(x, 0.0);
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{at:.1} {top}v{height}\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                top + height + 16.0,
                number(scale[0] * x)
            );
        }
        for y in ticks(self.y, steps[1]) {
            let [_, at] = self.place(0.0, y);
            let _ = writeln!(
                svg,
                "<path class=\"grid\" d=\"M{left} {at:.1}h{width}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 6.0,
                at + 4.0,
                number(scale[1] * y)
            );
        }
        let _ = writeln!(
            svg,
            "<text class=\"key\" x=\"{left}\" y=\"{:.1}\">{title}</text><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{x_label}</text>",
            top - 8.0,
            left + width,
            top + height + 32.0
        );
    }
}

/// Impact speed and displacements over frequency.
#[must_use]
pub fn speed_figure(study: &Study) -> String {
    let main = &study.main;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 560\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n<title>Impact speed and displacements of two towers over the frequency of the ground</title>\n{STYLE}<rect class=\"paper\" width=\"720\" height=\"560\"/>\n"
    );
    let top_speed = greatest(main, |s| s.impact_speed).impact_speed;
    let step = |greatest: f64| {
        let rough = greatest / 5.0;
        let power = 10f64.powf(rough.log10().floor());
        [1.0, 2.0, 5.0, 10.0]
            .map(|s| s * power)
            .into_iter()
            .find(|s| *s >= rough)
            .unwrap_or(rough)
    };
    let speeds = Panel {
        area: [60.0, 30.0, 640.0, 210.0],
        x: [SWEEP.0, SWEEP.1],
        y: [0.0, 1.08 * top_speed],
    };
    speeds.frame(
        &mut svg,
        "Greatest impact speed [m/s]",
        "frequency of the ground [Hz]",
        [0.5, step(top_speed)],
        [1.0, 1.0],
    );
    marks(&mut svg, &speeds);
    for s in main.iter().filter(|s| s.impacts > 0.0) {
        let [x, y] = speeds.place(s.frequency, s.impact_speed);
        let colour = match s.period {
            Some(1) => 0,
            Some(_) => 2,
            None => 1,
        };
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\" style=\"fill:var(--c{colour})\"/>"
        );
    }
    for (row, (colour, name)) in [
        (0, "repeats every cycle"),
        (2, "repeats every 2 to 16 cycles"),
        (1, "does not repeat within 16 cycles"),
    ]
    .into_iter()
    .enumerate()
    {
        let y = 46.0 + 16.0 * row as f64;
        let _ = writeln!(
            svg,
            "<circle cx=\"492\" cy=\"{:.1}\" r=\"3\" style=\"fill:var(--c{colour})\"/><text x=\"502\" y=\"{y:.1}\">{name}</text>",
            y - 4.0
        );
    }
    let displacement = main
        .iter()
        .flat_map(|s| s.displacement.iter().chain(&s.apart))
        .fold(0.0, |m: f64, u| m.max(*u));
    let panel = Panel {
        area: [60.0, 310.0, 640.0, 200.0],
        x: [SWEEP.0, SWEEP.1],
        y: [0.0, 1.05 * displacement],
    };
    panel.frame(
        &mut svg,
        "Greatest displacement [mm]: with contact, and dashed without",
        "frequency of the ground [Hz]",
        [0.5, step(displacement)],
        [1.0, 1e3],
    );
    marks(&mut svg, &panel);
    for tower in [0, 1] {
        for (dashed, of) in [
            (
                false,
                (|s, t| s.displacement[t]) as fn(&Steady, usize) -> f64,
            ),
            (true, |s, t| s.apart[t]),
        ] {
            let points: Vec<String> = main
                .iter()
                .map(|s| {
                    let [x, y] = panel.place(s.frequency, of(s, tower));
                    format!("{x:.1} {y:.1}")
                })
                .collect();
            let style = if dashed {
                ";stroke-dasharray:5 3;stroke-width:1.3"
            } else {
                ""
            };
            let _ = writeln!(
                svg,
                "<path style=\"stroke:var(--c{tower}){style}\" d=\"M{}\"/>",
                points.join("L")
            );
        }
    }
    for (row, name) in ["soft tower", "stiff tower"].into_iter().enumerate() {
        let y = 328.0 + 16.0 * row as f64;
        let _ = writeln!(
            svg,
            "<path style=\"stroke:var(--c{row})\" d=\"M590 {:.1}h22\"/><text x=\"618\" y=\"{y:.1}\">{name}</text>",
            y - 4.0
        );
    }
    svg.push_str("</svg>\n");
    svg
}

/// Natural frequencies as vertical lines.
fn marks(svg: &mut String, panel: &Panel) {
    let [_, top, _, height] = panel.area;
    for frequency in [SOFT, STIFF] {
        let [x, _] = panel.place(frequency, 0.0);
        let _ = writeln!(
            svg,
            "<path style=\"stroke:var(--ink-2);stroke-width:1;stroke-dasharray:2 3\" d=\"M{x:.1} {top}v{height}\"/>"
        );
    }
}

/// Sections at four frequencies: every cycle, every few, a long group, none.
#[must_use]
pub fn section_figure(study: &Study) -> String {
    let main = &study.main;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 640\" font-family=\"system-ui, sans-serif\" font-size=\"12\">\n<title>Poincaré sections of the soft tower</title>\n{STYLE}<rect class=\"paper\" width=\"720\" height=\"640\"/>\n"
    );
    let last = study.others.last().map_or(main, |(_, sweep)| sweep);
    let fastest = |main: &[Steady], of: &dyn Fn(&Steady) -> bool| {
        let fitting: Vec<Steady> = main
            .iter()
            .filter(|s| s.impacts > 0.0 && of(s))
            .cloned()
            .collect();
        (!fitting.is_empty()).then(|| greatest(&fitting, |s| s.impact_speed).clone())
    };
    let chosen = [
        fastest(main, &|s| s.period == Some(1)),
        fastest(main, &|s| s.period == Some(2)),
        fastest(main, &|s| s.period.is_some_and(|n| n > 2)),
        fastest(last, &|s| s.period.is_none()),
    ];
    for (index, s) in chosen.iter().flatten().enumerate() {
        let reach = |axis: usize| {
            let values = s.section.iter().map(|point| point[axis]);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            let high = values.fold(f64::NEG_INFINITY, f64::max);
            // Around a single point a part of the greatest motion.
            let half = (0.6 * (high - low))
                .max(0.05 * [s.displacement[0], TAU * s.frequency * s.displacement[0]][axis]);
            let middle = 0.5 * (low + high);
            [middle - half, middle + half]
        };
        let panel = Panel {
            area: [
                60.0 + 350.0 * (index % 2) as f64,
                36.0 + 310.0 * (index / 2) as f64,
                280.0,
                220.0,
            ],
            x: reach(0),
            y: reach(1),
        };
        let step = |range: [f64; 2]| {
            let rough = (range[1] - range[0]) / 4.0;
            let power = 10f64.powf(rough.log10().floor());
            [1.0, 2.0, 5.0, 10.0]
                .map(|s| s * power)
                .into_iter()
                .find(|s| *s >= rough)
                .unwrap_or(rough)
        };
        let repeats = match s.period {
            Some(1) => "every cycle".to_owned(),
            Some(n) => format!("every {n} cycles"),
            None => "no repetition".to_owned(),
        };
        let stiff = if index == 3 {
            STIFFER[STIFFER.len() - 1]
        } else {
            STIFF
        };
        let title = format!(
            "stiff tower {stiff} Hz, at {:.4} Hz: {repeats}",
            s.frequency
        );
        panel.frame(
            &mut svg,
            &title,
            "displacement [mm], up: velocity [m/s]",
            [step(panel.x), step(panel.y)],
            [1e3, 1.0],
        );
        for [u, v] in &s.section {
            let [x, y] = panel.place(*u, *v);
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\" style=\"fill:var(--c0)\"/>"
            );
        }
    }
    svg.push_str("</svg>\n");
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_are_told_from_states() {
        let state = |k: usize, n: usize| {
            let x = (k % n) as f64;
            [k as f64, x, 1.0 - x, 2.0 * x, 0.5]
        };
        let states = |n: usize| (0..40).map(|k| state(k, n)).collect::<Vec<_>>();
        assert_eq!(period(&states(1)), Some(1));
        assert_eq!(period(&states(3)), Some(3));
        assert_eq!(period(&states(37)), None);
    }
}
