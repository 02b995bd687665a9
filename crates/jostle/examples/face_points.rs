//! How many points a face needs: draws the figures of `docs/face-points.md` and writes its table.
//!
//! `cargo run -p jostle --example face_points`. A floor on springs so soft that it is free hits a wall-like neighbour with a
//! face that is turned by a small angle. The reference is the same floor against 2000 springs along the face, integrated by
//! the velocity Verlet method with fixed steps: another law of sharing, another integrator, no events.

#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;

use jostle::{
    Analysis, Bearing, Building, Column, ContactLaw, Damping, Gap, GroundMotion, LawKind, Model,
    Plan, PlanContact, PlanPoint, RestitutionIs, Settings, Solver, Structure, System, Tier,
    TierStorey, Tiers, simulate,
};

/// Length of the face \[m\], mass of the floor \[kg\], stiffness of the whole face \[N/m\] and speed \[m/s\].
const FACE: f64 = 8.0;
const MASS: f64 = 200e3;
const STIFFNESS: f64 = 1e8;
const SPEED: f64 = 0.5;
/// Half-sine pulse of the ground that sets the floor in motion \[s\], and the gap \[m\].
const PULSE: f64 = 0.5;
const GAP: f64 = 0.2;
/// From the first contact to the end of a run \[s\].
const AFTERWARDS: f64 = 0.95;
/// Numbers of points that are compared.
const POINTS: [usize; 4] = [2, 3, 5, 9];
/// Depth of a plan whose radius of gyration is half its face: √(12·(L/2)² − L²) \[m\].
pub(crate) const PERCUSSION: f64 = 11.313_708_498_984_76;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let turns = [0.0005, 0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01];
    let mut by_turn: Vec<(f64, [f64; 4])> = Vec::new();
    for turn in turns {
        let line = spin_of_line(PERCUSSION, turn);
        let ratios = POINTS.map(|points| spin_of_points(PERCUSSION, turn, points) / line);
        println!(
            "turned by {:4.1} mrad: {ratios:.3?} of {:.3} mrad/s",
            1e3 * turn,
            1e3 * line
        );
        by_turn.push((turn, ratios));
    }
    let depths = [6.0, 8.0, 10.0, PERCUSSION, 12.0, 14.0, 16.0, 20.0];
    let mut by_depth: Vec<(f64, [f64; 2])> = Vec::new();
    for depth in depths {
        let line = spin_of_line(depth, 0.001);
        let ratios = [2, 5].map(|points| spin_of_points(depth, 0.001, points) / line);
        println!("{depth:5.2} m deep: {ratios:.3?}");
        by_depth.push((depth, ratios));
    }
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    std::fs::write(
        docs.join("figures/face-points.svg"),
        figure_by_turn(&by_turn),
    )?;
    std::fs::write(
        docs.join("figures/face-points-plan.svg"),
        figure_by_depth(&by_depth),
    )?;
    let page = docs.join("face-points.md");
    let text = std::fs::read_to_string(&page)?;
    let text = between(&text, "turns", &table_by_turn(&by_turn));
    let text = between(&text, "depths", &table_by_depth(&by_depth));
    std::fs::write(page, text)?;
    Ok(())
}

/// Replaces what stands between two comments of a page.
fn between(text: &str, name: &str, table: &str) -> String {
    let [begin, end] = [
        format!("<!-- begin {name} -->\n"),
        format!("<!-- end {name} -->"),
    ];
    match (text.split_once(&begin), text.split_once(&end)) {
        (Some((before, _)), Some((_, after))) => format!("{before}{begin}{table}{end}{after}"),
        _ => text.to_owned(),
    }
}

/// The floor, turned about its centre, and the neighbour that stands still.
fn model(depth: f64, turn: f64, points: usize) -> Model {
    let (sin, cos) = turn.sin_cos();
    let half = [0.5 * depth, 0.5 * FACE];
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]: PlanPoint| {
        let [x, y] = [a * half[0], b * half[1]];
        [cos * x - sin * y, sin * x + cos * y]
    });
    let most = corners.iter().map(|corner| corner[0]).fold(0.0, f64::max);
    let face = most + GAP;
    let wall = [
        [face, -10.0],
        [face + 5.0, -10.0],
        [face + 5.0, 10.0],
        [face, 10.0],
    ];
    let building = |name: &str, plan: &[PlanPoint], mass: f64, period: f64| {
        let tier = Tier::uniform(mass, plan.to_vec()).expect("an area");
        let stiffness = mass * (2.0 * PI / period).powi(2);
        let storey = TierStorey {
            stiffness: [stiffness, stiffness, stiffness * tier.polar_mass / mass],
            centre: tier.centre,
        };
        Building {
            name: name.to_owned(),
            structure: Structure::Tiers(Tiers {
                floors: vec![tier],
                storeys: vec![storey],
                storey_heights: vec![3.0],
                ..Tiers::default()
            }),
            damping: Damping::Rayleigh {
                alpha: 0.0,
                beta: 0.0,
            },
            ..Building::default()
        }
    };
    let law = ContactLaw {
        kind: LawKind::Linear,
        stiffness: STIFFNESS,
        restitution: 1.0,
        restitution_is: RestitutionIs::Input,
    };
    let mut gap = Gap::between([Some(0), Some(1)], GAP, law);
    gap.in_plan = PlanContact {
        points,
        ..PlanContact::default()
    };
    Model {
        title: "A turned face".to_owned(),
        buildings: vec![
            building("floor", &corners, MASS, 1000.0),
            building("neighbour", &wall, 1e10, 0.02),
        ],
        gaps: vec![gap],
        analysis: Analysis {
            solver: Some(Solver::Modal),
            tolerance: 1e-5,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

/// A half-sine that leaves the floor with its speed.
fn pulse() -> GroundMotion {
    let step = 0.0025;
    let amplitude = SPEED * PI / (2.0 * PULSE);
    let at = |i: u32| {
        let t = step * f64::from(i);
        if t < PULSE {
            -amplitude * (PI * t / PULSE).sin()
        } else {
            0.0
        }
    };
    let mut motion = GroundMotion::sampled("pulse", step, (0..=640).map(at).collect());
    motion.bearing = Some(Box::new(Bearing {
        angle: 0.0,
        across: None,
    }));
    motion
}

/// Rotation rate after the impact, of a run \[rad/s\].
pub(crate) fn spin_of_points(depth: f64, turn: f64, points: usize) -> f64 {
    let model = model(depth, turn, points);
    let motion = pulse();
    let system = System::assemble(&model).unwrap_or_else(|faults| panic!("{faults:?}"));
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("modal stepping");
    let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
        ControlFlow::Continue(())
    });
    let history = outcome.history.expect("histories are recorded");
    let rate = history.column(Column::velocity(0, 1).turning());
    let rate = rate.expect("the rotation is recorded");
    rate.last().copied().unwrap_or(f64::NAN)
}

/// The same of a free floor against 2000 springs along the face.
pub(crate) fn spin_of_line(depth: f64, turn: f64) -> f64 {
    const SPRINGS: usize = 2000;
    const STEP: f64 = 2e-5;
    let polar = MASS * (depth * depth + FACE * FACE) / 12.0;
    // The normal is the mean of both; the lever of a point is its place along the face, less what the turn moves it.
    let normal = [(0.5 * turn).cos(), (0.5 * turn).sin()];
    let points: Vec<[f64; 2]> = (0..SPRINGS)
        .map(|i| {
            let s = FACE * ((i as f64 + 0.5) / SPRINGS as f64 - 0.5);
            // On the edge of the floor; the gap grows where the edge is behind its foremost corner.
            let (sin, cos) = turn.sin_cos();
            let edge = [0.5 * depth * cos - s * sin, 0.5 * depth * sin + s * cos];
            let lever = edge[0] * normal[1] - edge[1] * normal[0];
            let behind = (0.5 * FACE + s) * turn.sin() / (0.5 * turn).cos();
            [lever, behind]
        })
        .collect();
    let each = STIFFNESS / SPRINGS as f64;
    let forces = |x: f64, turned: f64| {
        let (mut force, mut moment) = (0.0, 0.0);
        for [lever, behind] in &points {
            let depth = normal[0] * x + turned * lever - behind;
            if depth > 0.0 {
                force += each * depth;
                moment += each * depth * lever;
            }
        }
        [-force * normal[0] / MASS, -moment / polar]
    };
    let (mut x, mut turned, mut speed, mut rate) = (-1e-9, 0.0, SPEED, 0.0);
    let mut now = forces(x, turned);
    // As long as the runs go on after the first contact, so that later contacts of the other end are included.
    for _ in 0..(AFTERWARDS / STEP) as usize {
        speed += 0.5 * STEP * now[0];
        rate += 0.5 * STEP * now[1];
        x += STEP * speed;
        turned += STEP * rate;
        now = forces(x, turned);
        speed += 0.5 * STEP * now[0];
        rate += 0.5 * STEP * now[1];
    }
    rate
}

fn table_by_turn(rows: &[(f64, [f64; 4])]) -> String {
    let mut text =
        "| turned by | 2 points | 3 points | 5 points | 9 points |\n|---|---|---|---|---|\n"
            .to_owned();
    for (turn, ratios) in rows {
        let cells = ratios.map(|ratio| format!("{ratio:.3}"));
        let _ = writeln!(text, "| {:.1} mrad | {} |", 1e3 * turn, cells.join(" | "));
    }
    text
}

fn table_by_depth(rows: &[(f64, [f64; 2])]) -> String {
    let mut text = "| depth of the floor | radius of gyration ÷ half the face | 2 points | 5 points |\n|---|---|---|---|\n".to_owned();
    for (depth, [two, five]) in rows {
        let _ = writeln!(
            text,
            "| {depth:.1} m | {:.2} | {two:.2} | {five:.3} |",
            gyration(*depth)
        );
    }
    text
}

/// Radius of gyration over half the face \[–\].
fn gyration(depth: f64) -> f64 {
    ((depth * depth + FACE * FACE) / 12.0).sqrt() / (0.5 * FACE)
}

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 320.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 96.0;
const TOP: f64 = 18.0;
const BOTTOM: f64 = 46.0;

/// A chart of lines with dots: ends of both axes with their marks, titles, and lines with names and colours.
fn chart(
    [x, y]: [(f64, f64, &[f64]); 2],
    titles: [&str; 2],
    lines: &[(String, &str, Vec<[f64; 2]>)],
) -> String {
    let px = |value: f64| LEFT + (WIDTH - LEFT - RIGHT) * (value - x.0) / (x.1 - x.0);
    let py = |value: f64| HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (value - y.0) / (y.1 - y.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"system-ui, DejaVu Sans, sans-serif\" font-size=\"13\" fill=\"#59616b\">\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#fff\"/>\n"
    );
    for mark in x.2 {
        let at = px(*mark);
        let _ = writeln!(
            text,
            "<line x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{TOP}\" y2=\"{:.1}\" stroke=\"#d9dde3\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{mark}</text>",
            HEIGHT - BOTTOM,
            HEIGHT - BOTTOM + 17.0
        );
    }
    for mark in y.2 {
        let at = py(*mark);
        let stroke = if *mark == 0.0 { "#59616b" } else { "#d9dde3" };
        let name = mark.to_string().replace('-', "−");
        let _ = writeln!(
            text,
            "<line x1=\"{LEFT}\" x2=\"{:.1}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"{stroke}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>",
            WIDTH - RIGHT,
            LEFT - 7.0,
            at + 4.5
        );
    }
    let mut taken: Vec<f64> = Vec::new();
    for (name, colour, points) in lines {
        let path: Vec<String> = points
            .iter()
            .map(|[a, b]| format!("{:.1},{:.1}", px(*a), py(*b)))
            .collect();
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"/>",
            path.join(" ")
        );
        for point in &path {
            let (cx, cy) = point.split_once(',').unwrap_or_default();
            let _ = writeln!(
                text,
                "<circle cx=\"{cx}\" cy=\"{cy}\" r=\"3\" fill=\"{colour}\"/>"
            );
        }
        if let Some([a, b]) = points.last() {
            let mut at = py(*b) + 4.5;
            while taken.iter().any(|other| (other - at).abs() < 15.0) {
                at += 1.0;
            }
            taken.push(at);
            let _ = writeln!(
                text,
                "<text x=\"{:.1}\" y=\"{at:.1}\" fill=\"{colour}\" font-weight=\"650\">{name}</text>",
                px(*a) + 9.0
            );
        }
    }
    let _ = writeln!(
        text,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        0.5 * (LEFT + WIDTH - RIGHT),
        HEIGHT - 10.0,
        titles[0]
    );
    let _ = writeln!(
        text,
        "<text transform=\"translate(15 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</svg>",
        0.5 * (TOP + HEIGHT - BOTTOM),
        titles[1]
    );
    text
}

const COLOURS: [&str; 4] = ["#d55e00", "#b0568a", "#0072b2", "#00865f"];
const SPIN: &str = "rotation rate after the impact ÷ exact";

fn figure_by_turn(rows: &[(f64, [f64; 4])]) -> String {
    let lines: Vec<(String, &str, Vec<[f64; 2]>)> = (0..4)
        .rev()
        .map(|k| {
            let points = rows.iter().map(|(turn, ratios)| [1e3 * turn, ratios[k]]);
            (
                format!("{} points", POINTS[k]),
                COLOURS[k],
                points.collect(),
            )
        })
        .collect();
    let (x, y) = (
        [0.0, 2.0, 4.0, 6.0, 8.0, 10.0],
        [0.0, 0.2, 0.4, 0.6, 0.8, 1.0],
    );
    chart(
        [(0.0, 10.0, &x), (-0.05, 1.08, &y)],
        ["initial angle of the face [mrad]", SPIN],
        &lines,
    )
}

fn figure_by_depth(rows: &[(f64, [f64; 2])]) -> String {
    let lines: Vec<(String, &str, Vec<[f64; 2]>)> = [(0, "2 points", 0), (1, "5 points", 2)]
        .into_iter()
        .map(|(k, name, colour)| {
            let points = rows
                .iter()
                .map(|(depth, ratios)| [gyration(*depth), ratios[k]]);
            (name.to_owned(), COLOURS[colour], points.collect())
        })
        .collect();
    let (x, y) = (
        [0.8, 1.0, 1.2, 1.4],
        [-4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0],
    );
    let least = rows
        .iter()
        .map(|(_, ratios)| ratios[0])
        .fold(-1.0, f64::min);
    let marks: Vec<f64> = y.into_iter().filter(|mark| *mark >= least - 0.6).collect();
    let low = marks.first().copied().unwrap_or(-1.0).min(least - 0.1);
    chart(
        [(0.7, 1.6, &x), (low, 2.2, &marks)],
        ["radius of gyration of the floor ÷ half the face", SPIN],
        &lines,
    )
}
