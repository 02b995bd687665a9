//! Ends of columns made of fibres, against fibres integrated by other programs.

use jostle::hysteresis::HysteresisMemory;
use jostle::pushover::{PushDirection, PushSettings, pushover};
use jostle::{Fibre, Hinges, System};
use serde_json::Value;

use super::files::GRAVITY;
use super::summary_of;
use crate::data::{document, list, number, numbers};
use crate::files::model;
use crate::row::Row;

const CANTILEVER: (&str, &str) = (
    "members/e1_fibre_cantilever",
    include_str!("../../data/members/e1_fibre_cantilever.json"),
);
const PORTAL: (&str, &str) = (
    "members/e2_fibre_portal_overturning",
    include_str!("../../data/members/e2_fibre_portal_overturning.json"),
);

const WALL: (&str, &str) = (
    "members/e4_fibre_wall",
    include_str!("../../data/members/e4_fibre_wall.json"),
);

/// Layers over the length of the wall; the curve is straight between its corners.
const LAYERS: usize = 200;

/// Distance of that many layers from the integral.
const OF_LAYERS: f64 = 1e-4;

/// The parabola of concrete is a polygon here.
pub(super) const POLYGON: f64 = 2e-4;

/// The references change by this when their steps of 0.5 ms are halved.
const STEPS: f64 = 1.5e-3;

/// All rows of these cases.
pub(super) fn rows() -> Vec<Row> {
    // Both cases have the same section.
    let section = fibres_of(&file(&document(PORTAL.1)["input"], 1e-3));
    let mut rows = pushed_to_and_fro(CANTILEVER.0, &document(CANTILEVER.1), &section);
    for (name, text) in [CANTILEVER, PORTAL] {
        let case = document(text);
        for tolerance in [1e-3, 1e-4] {
            rows.extend(shaken(name, &case, tolerance));
        }
    }
    rows.push(pushed_over(WALL.0, &document(WALL.1)));
    rows
}

/// A wall whose foot is a section of fibres, pushed over under its weight.
fn pushed_over(name: &str, case: &Value) -> Row {
    let input = model(&wall(&case["input"]));
    let system = System::assemble(&input.model).expect("a sound model");
    let settings = PushSettings {
        direction: PushDirection::Right,
        drift: 0.012,
        ..PushSettings::default()
    };
    let pushed = pushover(&system.buildings[0], settings).expect("it bears");
    let bears = |roof: f64| {
        let pair = pushed.points.windows(2).find(|pair| pair[1].roof >= roof);
        pair.map_or(f64::NAN, |pair| {
            let share = (roof - pair[0].roof) / (pair[1].roof - pair[0].roof);
            pair[0].base_shear + share * (pair[1].base_shear - pair[0].base_shear)
        })
    };
    let points = list(case, "/static/points");
    let points = points
        .iter()
        .map(|point| ["roof_m", "V_n"].map(|key| point[key].as_f64().expect("a number")));
    let points: Vec<[f64; 2]> = points.collect();
    let expected: Vec<f64> = points.iter().map(|point| point[1]).collect();
    let got: Vec<f64> = points.iter().map(|point| bears(point[0])).collect();
    let what = "base shear of a wall that is pushed over [N]";
    Row::worst_of(name, what, &expected, &got, OF_LAYERS)
}

/// The model file of the wall.
fn wall(input: &Value) -> String {
    let of = |key: &str| number(input, key);
    format!(
        r#"motion = {{ record = "el-centro-1940-ns" }}
[[building]]
name = "P"
kind = "frame"
storeys = 1
storey_height = {height:?}
spans = []
density = 0
elastic_modulus = {modulus:?}
floor_mass = {mass:?}
floor_load = {load:?}
gravity = true
p_delta = false
column_segments = 1
axial = {{ columns = "flexible", beams = "rigid" }}
damping = {{ alpha = 0.5, beta = 0 }}
column = {{ width = 0.4, depth = 0.4 }}
[[building.wall]]
line = 1
length = {length:?}
thickness = {thickness:?}
shear = "rigid"
concrete = {strength:?}
steel = {yields:?}
cover = {cover:?}
bars = {{ edges = "{of_edge} d{edge}", edge_length = {edge_length:?}, web = "{of_web} d{web}" }}
hinge = {{ rule = "fibre", length = {over:?}, fibres = {LAYERS}, peak_strain = {peak:?}, residual = {residual:?}, ultimate_strain = {ultimate:?}, hardening = {hardening:?} }}
"#,
        height = of("/height_m"),
        modulus = of("/E"),
        mass = of("/floor_mass_kg"),
        load = of("/floor_load_n"),
        length = of("/length_m"),
        thickness = of("/thickness_m"),
        strength = of("/concrete/fc"),
        yields = of("/steel/fy"),
        cover = of("/cover_m"),
        of_edge = of("/edges/bars"),
        edge = 1e3 * of("/edges/diameter_m"),
        edge_length = of("/edges/length_m"),
        of_web = of("/web/bars"),
        web = 1e3 * of("/web/diameter_m"),
        over = of("/hinge_length_m"),
        peak = of("/concrete/ec0"),
        residual = of("/concrete/residual"),
        ultimate = of("/concrete/ecu"),
        hardening = of("/steel/b"),
    )
}

/// The fibres of the first column of a file.
fn fibres_of(file: &str) -> Vec<Fibre> {
    let input = model(file);
    let Some(Hinges::Frame(hinges)) = &input.model.buildings[0].hinges else {
        unreachable!("it asks for fibres");
    };
    hinges.fibres[&[0, 0]].fibres.to_vec()
}

/// A cantilever on its section of fibres under a constant axial force, whose top is led.
pub(super) struct Led {
    pub(super) height: f64,
    /// Positive in tension \[N\].
    pub(super) axial: f64,
    /// EI along and across.
    pub(super) rigidity: [f64; 2],
}

/// What its section does when the top is there: positive in tension and where the side further along, or across, is stretched.
pub(super) struct Borne {
    /// Axial force and moments along and across.
    pub(super) forces: [f64; 3],
    /// Elongation and rotations.
    pub(super) moved: [f64; 3],
}

impl Led {
    /// Three equations for the elongation and the rotations of the section at every place of the top, by Newton's method.
    pub(super) fn along(
        &self,
        fibres: &[Fibre],
        path: impl IntoIterator<Item = [f64; 2]>,
    ) -> Vec<Borne> {
        let bends = self
            .rigidity
            .map(|rigidity| self.height * self.height / (3.0 * rigidity));
        let mut memories = vec![HysteresisMemory::default(); fibres.len()];
        let mut moved = [0.0; 3];
        let mut all = Vec::new();
        let arms = |fibre: &Fibre| [1.0, fibre.at[0], fibre.at[1]];
        let stretch = |fibre: &Fibre, moved: &[f64; 3]| {
            moved[0] + fibre.at[0] * moved[1] + fibre.at[1] * moved[2]
        };
        // It comes to rest under its axial force first.
        for top in std::iter::once([0.0; 2]).chain(path) {
            let mut forces = [0.0; 3];
            for _ in 0..60 {
                let mut tangent = [[0.0; 3]; 3];
                forces = [0.0; 3];
                for (fibre, memory) in fibres.iter().zip(&memories) {
                    let response = fibre.spring.respond(memory, stretch(fibre, &moved));
                    // Where it does not move, its slope is that of the crack that is still closed.
                    let slope = if response.force == 0.0 && memory.deformation() == 0.0 {
                        fibre.spring.initial_tangent()
                    } else {
                        response.tangent
                    };
                    let arms = arms(fibre);
                    for (row, arm) in arms.into_iter().enumerate() {
                        forces[row] += response.force * arm;
                        for (column, other) in arms.into_iter().enumerate() {
                            tangent[row][column] += slope * arm * other;
                        }
                    }
                }
                // u = −ρ h − M h²/3EI in both directions.
                let mut left = [forces[0] - self.axial, 0.0, 0.0];
                for axis in [0, 1] {
                    let turned = -moved[1 + axis] * self.height - forces[1 + axis] * bends[axis];
                    left[1 + axis] = turned - top[axis];
                    tangent[1 + axis] = tangent[1 + axis].map(|tangent| -tangent * bends[axis]);
                    tangent[1 + axis][1 + axis] -= self.height;
                }
                let small = left[1].abs().max(left[2].abs()) < 1e-12;
                if left[0].abs() < 1e-6 * self.axial.abs() && small {
                    break;
                }
                for (unknown, step) in moved.iter_mut().zip(solved(tangent, left)) {
                    *unknown -= step;
                }
            }
            for (fibre, memory) in fibres.iter().zip(&mut memories) {
                *memory = fibre.spring.respond(memory, stretch(fibre, &moved)).memory;
            }
            all.push(Borne { forces, moved });
        }
        all.remove(0);
        all
    }
}

/// Cramer's rule for three equations.
fn solved(matrix: [[f64; 3]; 3], right: [f64; 3]) -> [f64; 3] {
    let determinant = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    [0, 1, 2].map(|column| {
        let mut replaced = matrix;
        for row in 0..3 {
            replaced[row][column] = right[row];
        }
        determinant(replaced) / determinant(matrix)
    })
}

/// The first case, led to and fro.
fn pushed_to_and_fro(name: &str, case: &Value, fibres: &[Fibre]) -> Vec<Row> {
    let input = &case["input"];
    let of = |key: &str| number(input, &format!("/{key}"));
    let led = Led {
        height: of("height_m"),
        axial: -of("N"),
        rigidity: [of("EI"); 2],
    };
    let path = path(&numbers(input, "/cycles_m"));
    let mut got: [Vec<f64>; 5] = Default::default();
    let all = led.along(fibres, path.into_iter().map(|top| [top, 0.0]));
    for Borne { forces, moved } in all.iter().skip(9).step_by(10) {
        let shear = -forces[1] / led.height;
        let values = [shear, forces[0], forces[1], moved[0], moved[1]];
        for (list, value) in got.iter_mut().zip(values) {
            list.push(value);
        }
    }
    let keys = [
        "V_n",
        "hinge.N",
        "hinge.M",
        "hinge.elongation_m",
        "hinge.rotation",
    ];
    let what = [
        "force at the top, led to and fro [N]",
        "axial force of the section [N]",
        "moment of the section [N·m]",
        "elongation of the section [m]",
        "rotation of the section [rad]",
    ];
    let points = list(case, "/static/points");
    keys.iter()
        .zip(what)
        .zip(got)
        .map(|((key, what), got)| {
            let expected: Vec<f64> = points
                .iter()
                .map(|point| point[key].as_f64().expect("a number"))
                .collect();
            Row::worst_of(name, what, &expected, &got[..expected.len()], POLYGON)
        })
        .collect()
}

/// Displacements of the top: to each amplitude and to the other side, in steps of a hundredth of the last amplitude.
fn path(amplitudes: &[f64]) -> Vec<f64> {
    let largest = amplitudes[amplitudes.len() - 1];
    let mut all = Vec::new();
    let mut last = 0.0;
    let turns = amplitudes.iter().flat_map(|a| [*a, -a]);
    for target in turns {
        let count = (100.0 * (target - last).abs() / largest).round().max(2.0);
        all.extend((1..=count as usize).map(|k| last + (target - last) * k as f64 / count));
        last = target;
    }
    all.extend((1..=100).map(|k| last * (1.0 - f64::from(k) / 100.0)));
    all
}

/// The model file of a case; weights that do not sway are loads of the floor.
fn file(input: &Value, tolerance: f64) -> String {
    let of = |key: &str| number(input, key);
    let section = |key: &str| number(input, &format!("/section/{key}"));
    let spans: Vec<f64> = input
        .get("span_m")
        .and_then(Value::as_f64)
        .into_iter()
        .collect();
    let columns = (spans.len() + 1) as f64;
    let beam = input.get("beam_EI").and_then(Value::as_f64);
    let beam = beam.map_or_else(String::new, |beam| format!("beam = {{ EI = {beam:?} }}\n"));
    let mass = of("/mass_kg");
    let area = section("width_m") * section("depth_m");
    let modulus = of("/EA") / area;
    let inertia = area * section("depth_m").powi(2) / 12.0;
    format!(
        r#"motion = {{ record = "el-centro-1940-ns", scale = {scale:?}, duration = {duration:?} }}
analysis = {{ tolerance = {tolerance:?} }}
[[building]]
name = "P"
kind = "frame"
storeys = 1
storey_height = {height:?}
spans = {spans:?}
density = 0
column_segments = 1
beam_segments = {segments:?}
floor_mass = {mass:?}
floor_load = {load:?}
gravity = true
p_delta = false
axial = {{ columns = "flexible", beams = "rigid" }}
elastic_modulus = {modulus:?}
stiffness_factor = {{ column = {factor:?} }}
damping = {{ alpha = {alpha:?}, beta = 0 }}
column = {{ width = {width:?}, depth = {depth:?}, concrete = {strength:?}, steel = {yields:?}, bars = {{ top = "4 d25", bottom = "4 d25", sides = "2 d25" }}, cover = {cover:?} }}
{beam}hinges = {{ rule = "fibre", length = {length:?}, fibres = {layers}, ends = "base", peak_strain = {peak:?}, residual = {residual:?}, ultimate_strain = {ultimate:?}, hardening = {hardening:?} }}
"#,
        scale = GRAVITY * of("/scale"),
        duration = of("/duration_s"),
        height = of("/height_m"),
        segments = vec![1; spans.len()],
        load = columns * of("/N") - mass * 9.80665,
        factor = of("/EI") / (modulus * inertia),
        alpha = of("/alpha"),
        width = section("width_m"),
        depth = section("depth_m"),
        strength = section("fc"),
        yields = section("fy"),
        cover = section("cover_to_bar_m") - 0.0125,
        length = section("hinge_length_m"),
        layers = section("fibres_depth"),
        peak = section("ec0"),
        residual = section("fcu") / section("fc"),
        ultimate = section("ecu"),
        hardening = section("b"),
    )
}

fn shaken(name: &str, case: &Value, tolerance: f64) -> Vec<Row> {
    let summary = summary_of(&file(&case["input"], tolerance));
    let building = &summary.buildings[0];
    let top = &building.floors.above[0].response;
    let (mut forces, mut moments, mut turns) = (Vec::new(), Vec::new(), Vec::new());
    let mut expected: [Vec<f64>; 3] = Default::default();
    let single = building.sections.len() == 1;
    for (number_of, section) in building.sections.iter().enumerate() {
        forces.extend([section.axial_max_n, section.axial_min_n]);
        moments.extend([section.moment_max_n_m, section.moment_min_n_m]);
        turns.extend([section.rotation_max_rad, section.rotation_min_rad]);
        let (hinge, node) = if single {
            ("hinge".to_owned(), "hinge".to_owned())
        } else {
            (
                format!("hinge{}", number_of + 1),
                format!("h{}", number_of + 1),
            )
        };
        let names = [
            format!("{hinge}.N"),
            format!("{hinge}.M"),
            format!("{node}.rotation"),
        ];
        for (list, name) in expected.iter_mut().zip(names) {
            let of = |key: &str| number(&case["dynamic"]["peaks"][&name], key);
            list.extend([of("/max"), of("/min")]);
        }
    }
    let with = |what: &str| format!("{what}, tolerance {tolerance:e}");
    let close = STEPS.max(tolerance);
    let of_top = ["max", "min"].map(|key| number(case, &format!("/dynamic/peaks/top/{key}")));
    let got = [top.displacement_max_m, top.displacement_min_m];
    let [axial, moment, turned] = expected;
    vec![
        Row::worst_of(
            name,
            with("displacement of the top [m]"),
            &of_top,
            &got,
            close,
        ),
        Row::worst_of(
            name,
            with("axial forces of sections [N]"),
            &axial,
            &forces,
            close,
        ),
        Row::worst_of(
            name,
            with("moments of sections [N·m]"),
            &moment,
            &moments,
            close,
        ),
        Row::worst_of(
            name,
            with("rotations of sections [rad]"),
            &turned,
            &turns,
            close,
        ),
    ]
}
