//! A column made of fibres that bends about both axes, against fibres integrated by other programs.

use std::ops::ControlFlow;

use jostle::{
    Bearing, Column, Fibre, GroundMotion, Plan, Run, Settings, SpacePlace, Structure, Summary,
    System, Wave, simulate,
};
use jostle_io::Input;
use serde_json::Value;

use super::fibres::{Borne, Led, POLYGON};
use super::files::GRAVITY;
use crate::data::{document, list, number, numbers};
use crate::files::model;
use crate::row::Row;

const NAME: &str = "members/e3_fibre_biaxial";
const CASE: &str = include_str!("../../data/members/e3_fibre_biaxial.json");

/// The reference changes by this when its steps of 1 ms are halved.
const STEPS: f64 = 1e-3;

/// All rows of this case.
pub(super) fn rows() -> Vec<Row> {
    let case = document(CASE);
    let input = input(&case["input"], 1e-3);
    let mut rows = led_along_a_clover(&case, &fibres_of(&input));
    rows.extend(shaken(&case, 1e-3));
    rows
}

/// Two cantilevers like that of the reference under one floor, which has twice its mass and load.
fn input(input: &Value, tolerance: f64) -> Input {
    let of = |key: &str| number(input, key);
    let section = |key: &str| number(input, &format!("/section/{key}"));
    let (width, depth) = (section("width_m"), section("depth_m"));
    let mass = of("/mass_kg");
    let mut model = model(&format!(
        r#"motion = {{ record = "el-centro-1940-ns", scale = {scale:?}, duration = {duration:?} }}
analysis = {{ tolerance = {tolerance:?} }}
[[building]]
name = "P"
kind = "space-frame"
storeys = 1
storey_height = {height:?}
lines_x = [0, 6]
lines_y = [0]
plan = [[-1, -1], [7, -1], [7, 1], [-1, 1]]
mass = {mass:?}
floor_load = {load:?}
gravity = true
p_delta = false
damping = {{ alpha = {alpha:?}, beta = 0 }}
column = {{ size = [{depth:?}, {width:?}], elastic_modulus = {modulus:?}, concrete = {strength:?}, steel = {yields:?}, bars = {{ top = "4 d25", bottom = "4 d25", sides = "2 d25" }}, cover = {cover:?} }}
beam_x = {{ omit = true }}
hinges = {{ rule = "fibre", length = {length:?}, fibres = [{layers}, {across}], ends = "base", peak_strain = {peak:?}, residual = {residual:?}, ultimate_strain = {ultimate:?}, hardening = {hardening:?} }}
"#,
        scale = GRAVITY * of("/scale_along"),
        duration = of("/duration_s"),
        height = of("/height_m"),
        mass = 2.0 * mass,
        load = 2.0 * (of("/N") - mass * 9.80665),
        alpha = of("/alpha"),
        modulus = of("/EA") / (width * depth),
        strength = section("fc"),
        yields = section("fy"),
        cover = section("cover_to_bar_m") - 0.0125,
        length = section("hinge_length_m"),
        layers = section("fibres_depth"),
        across = section("fibres_width"),
        peak = section("ec0"),
        residual = section("fcu") / section("fc"),
        ultimate = section("ecu"),
        hardening = section("b"),
    ));
    let Structure::Tiers(tiers) = &mut model.model.buildings[0].structure else {
        unreachable!("it has a plan");
    };
    let frame = tiers.space_frame.as_mut().expect("it is a space frame");
    for column in &mut frame.members {
        // Those of the reference are not those of one modulus.
        column.section.flexural_rigidity = [of("/EI_x"), of("/EI_y")];
    }
    model
}

/// The fibres of a column.
fn fibres_of(input: &Input) -> Vec<Fibre> {
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        unreachable!("it has a plan");
    };
    let frame = tiers.space_frame.as_ref().expect("it is a space frame");
    let place = SpacePlace::Column {
        line: [0, 0],
        storey: 0,
    };
    frame.fibres[&place].fibres.to_vec()
}

fn led_along_a_clover(case: &Value, fibres: &[Fibre]) -> Vec<Row> {
    let input = &case["input"];
    let of = |key: &str| number(input, &format!("/{key}"));
    let led = Led {
        height: of("height_m"),
        axial: -of("N"),
        rigidity: [of("EI_x"), of("EI_y")],
    };
    let radius = of("clover_radius_m");
    let corners = [[1, 0], [1, 1], [-1, 1], [-1, -1], [1, -1], [1, 0], [0, 0]];
    let corners = corners.map(|corner| corner.map(|corner| f64::from(corner) * radius));
    let starts = std::iter::once([0.0; 2]).chain(corners);
    let path = starts.zip(corners).flat_map(|(from, to)| {
        let between = move |share: f64, axis: usize| from[axis] + share * (to[axis] - from[axis]);
        (1..=50).map(move |k| [0, 1].map(|axis| between(f64::from(k) / 50.0, axis)))
    });
    let all = led.along(fibres, path);
    // Moments and rotations of the reference are about y and x.
    let of_reference = |Borne { forces, moved }: &Borne| {
        [
            -forces[1] / led.height,
            -forces[2] / led.height,
            -forces[1],
            forces[2],
            moved[0],
            -moved[1],
            moved[2],
        ]
    };
    let got: Vec<[f64; 7]> = all.iter().skip(9).step_by(10).map(of_reference).collect();
    let points = list(case, "/static/points");
    let of_column = |column: usize, points: &[Value]| -> Vec<f64> {
        let numbers = points
            .iter()
            .map(|point| number(point, &format!("/{column}")));
        numbers.collect()
    };
    [
        (
            vec![0, 1],
            vec![2, 3],
            "forces at the top, led along a clover [N]",
        ),
        (vec![2, 3], vec![5, 6], "moments of the section [N·m]"),
        (vec![4], vec![7], "elongation of the section [m]"),
        (vec![5, 6], vec![8, 9], "rotations of the section [rad]"),
    ]
    .into_iter()
    .map(|(ours, theirs, what)| {
        let expected = theirs.iter().flat_map(|column| of_column(*column, points));
        let got = ours.iter().flat_map(|k| got.iter().map(|point| point[*k]));
        let (expected, got): (Vec<f64>, Vec<f64>) = (expected.collect(), got.collect());
        Row::worst_of(NAME, what, &expected, &got, POLYGON)
    })
    .collect()
}

/// The motion of the input, and the same later across.
fn from_two_sides(model_input: &Input, input: &Value) -> GroundMotion {
    let along = model_input.ground_motion().expect("the record is built in");
    let Wave::Sampled { step, acceleration } = &along.wave else {
        unreachable!("a record");
    };
    let later = (number(input, "/across_delay_s") / step).round() as usize;
    let still = std::iter::repeat_n(0.0, later);
    let samples = still.chain(acceleration.iter().copied()).collect();
    let across = GroundMotion {
        scale: along.scale * number(input, "/scale_across") / number(input, "/scale_along"),
        ..GroundMotion::sampled("across", *step, samples)
    };
    GroundMotion {
        bearing: Some(Box::new(Bearing {
            angle: 0.0,
            across: Some(across),
        })),
        ..along
    }
}

fn shaken(case: &Value, tolerance: f64) -> Vec<Row> {
    let input = input(&case["input"], tolerance);
    let motion = from_two_sides(&input, &case["input"]);
    let system = System::assemble(&input.model).expect("a sound model");
    let plan = Plan::choose(&system, &motion, &input.model.analysis).expect("a sound plan");
    let interval = 0.01;
    let settings = Settings {
        record_interval: Some(interval),
        ..Settings::default()
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    let summary = Summary::new(&Run {
        model: &input.model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: Default::default(),
    });
    let history = outcome.history.as_ref().expect("it is recorded");
    let top = Column::displacement(0, 1);
    let columns = [top, top.across()].map(|column| history.column(column).expect("it is recorded"));
    let times = history.column(Column::TIME).expect("it is recorded");
    let at = |time: f64| -> [f64; 2] {
        let index = times
            .iter()
            .position(|candidate| (candidate - time).abs() < 0.5 * interval);
        let index = index.expect("it is recorded");
        [columns[0][index], columns[1][index]]
    };
    let (mut expected, mut got) = (Vec::new(), Vec::new());
    for (time, both) in crate::data::entries(case, "/dynamic/histories") {
        expected.extend(
            both.as_array()
                .into_iter()
                .flatten()
                .filter_map(Value::as_f64),
        );
        got.extend(at(time.parse().expect("an instant")));
    }
    let peaks = outcome.peaks.floor(0, 1);
    let peak = |key: &str| number(case, &format!("/dynamic/peak_abs/{key}"));
    let section = &summary.buildings[0].sections[0];
    let across = section.across.as_ref().expect("it is in space");
    let moments = [
        section.moment_max_n_m.max(-section.moment_min_n_m),
        across
            .moment_across_max_n_m
            .max(-across.moment_across_min_n_m),
    ];
    let with = |what: &str| format!("{what}, tolerance {tolerance:e}");
    let end = numbers(case, "/dynamic/end_displacement_m");
    vec![
        Row::worst_of(
            NAME,
            with("peak displacements of the top [m]"),
            &[peak("top_x_m"), peak("top_y_m")],
            &[
                peaks.displacement().size(),
                peaks.across().displacement().size(),
            ],
            STEPS,
        ),
        Row::worst_of(
            NAME,
            with("displacements of the top over time [m]"),
            &expected,
            &got,
            STEPS,
        ),
        Row::worst_of(
            NAME,
            with("displacements of the top at the end [m]"),
            &end,
            &at(number(case, "/input/duration_s")),
            STEPS,
        ),
        Row::worst_of(
            NAME,
            with("peak moments of the section [N·m]"),
            &[peak("M_y_nm"), peak("M_x_nm")],
            &moments,
            STEPS,
        ),
    ]
}
