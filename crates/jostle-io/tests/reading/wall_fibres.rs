//! Walls whose feet are fibres: the section that is laid, the same section as a column, a push against a second integration.

use jostle::hysteresis::Side;
use jostle::pushover::{PushDirection, PushSettings, pushover};
use jostle::{FibreMaterial, Outcome, Structure, Summary, System};
use jostle_testkit::compare::{close, near};
use jostle_testkit::files::{refusal, sound};
use jostle_testkit::runs::{assembled, run_and_summary};

/// A cantilever with a load on its top. `more`: its column or its wall.
fn cantilever(height: f64, more: &str) -> String {
    format!(
        r#"motion = {{ record = "el-centro-1940-ns", pga = "0.4 g", duration = "8 s" }}
analysis = {{ solver = "riccati", step = "1 ms", accept_unusual = true }}
[[building]]
name = "A"
kind = "frame"
storeys = 1
storey_height = {height}
spans = []
density = 0
elastic_modulus = "30 GPa"
floor_mass = "100 t"
floor_load = "2 MN"
gravity = true
p_delta = false
column_segments = 1
axial = {{ columns = "flexible", beams = "rigid" }}
damping = {{ alpha = 0.5, beta = 0 }}
{more}"#
    )
}

const BARS: &str = "concrete = \"30 MPa\"\nsteel = \"400 MPa\"\nbars = \"4 d25 top, 4 d25 bottom, 4 d16 sides\"\nties = \"d10 @ 100 mm\"\n";

/// A section of 0.4 × 1.5 m as a wall.
fn as_wall(hinge: &str) -> String {
    format!(
        "column = {{ width = 0.4, depth = 0.4 }}\n[[building.wall]]\nline = 1\nlength = 1.5\nthickness = 0.4\nshear = \"rigid\"\n{BARS}hinge = {{ rule = \"fibre\", length = \"0.5 m\", fibres = 30{hinge} }}\n"
    )
}

fn as_column() -> String {
    format!(
        "hinges = {{ rule = \"fibre\", length = \"0.5 m\", fibres = 30, ends = \"base\" }}\n[[building.column]]\nwidth = 0.4\ndepth = 1.5\n{BARS}"
    )
}

fn shaken(file: &str) -> (System, Outcome, Summary) {
    let input = sound(file);
    let motion = input.ground_motion().expect("the record is built in");
    run_and_summary(&input.model, &motion)
}

/// A wall with the section of a column is that column, and its energies balance.
#[test]
fn a_wall_of_fibres_is_the_column_with_its_section() {
    let (_, outcome, wall) = shaken(&cantilever(3.0, &as_wall("")));
    let (_, _, column) = shaken(&cantilever(3.0, &as_column()));
    let imbalance = outcome.energy.worst_imbalance;
    assert!(imbalance < 1e-6, "{imbalance:e}");
    let [a, b] = [&wall, &column].map(|summary| {
        let building = &summary.buildings[0];
        let (top, foot) = (&building.floors.above[0].response, &building.sections[0]);
        [
            top.displacement_max_m,
            top.displacement_min_m,
            foot.axial_max_n,
            foot.axial_min_n,
            foot.moment_max_n_m,
            foot.moment_min_n_m,
            foot.rotation_max_rad,
            foot.rotation_min_rad,
            foot.elongation_max_m,
            foot.concrete_strain.expect("concrete"),
            foot.steel_strain.expect("bars"),
            foot.dissipated_j,
        ]
    });
    for (a, b) in a.into_iter().zip(b) {
        near(a, b, 1e-6, "wall and column");
    }
    // Bars yield, and the cracked wall is longer.
    let foot = &wall.buildings[0].sections[0];
    assert_eq!(foot.name, "A.column.1.1.foot");
    assert!(foot.yielded_s.is_some() && foot.elongation_max_m > 0.0);
    // The wall among the parts says the same.
    let part = &wall.buildings[0].parts[0];
    assert_eq!(part.name, "A.wall.1");
    for (got, due) in [
        (part.rotation_max_rad, foot.rotation_max_rad),
        (part.rotation_min_rad, -foot.rotation_min_rad),
        (part.moment_max_n_m, foot.moment_max_n_m),
        (Some(part.dissipated_j), foot.dissipated_j),
    ] {
        near(got.expect("of a wall"), due, 1e-9, "part");
    }
}

/// Edges and a web: places and areas by hand.
#[test]
fn edges_and_web_are_laid_from_left_to_right() {
    let wall = "column = { width = 0.4, depth = 0.4 }\n[[building.wall]]\nline = 1\nlength = 4\nthickness = 0.3\nconcrete = \"30 MPa\"\nsteel = \"400 MPa\"\ncover = \"35 mm\"\nties = \"d10 @ 100 mm\"\nbars = { edges = \"6 d20\", edge_length = \"0.6 m\", web = \"16 d10\" }\nhinge = { rule = \"fibre\", length = \"paulay-priestley\", limits = { fracture = 0.06 } }\n";
    let model = sound(&cantilever(6.0, wall)).model;
    let Structure::Frame(frame) = &model.buildings[0].structure else {
        panic!("a frame");
    };
    let own = &frame.walls[0].fibres[&1];
    near(
        own.length,
        0.2 * 4.0 + 0.044 * 2.0 / 3.0 * 6.0,
        1e-12,
        "length",
    );
    assert_eq!(own.at_ends, [true, false]);
    let bars = own
        .fibres
        .iter()
        .filter(|fibre| fibre.material == FibreMaterial::Bar);
    let bars: Vec<[f64; 2]> = bars
        .map(|fibre| {
            [
                fibre.at[0],
                fibre.spring.backbone().initial() * own.length / 2e11,
            ]
        })
        .collect();
    let area = |diameter: f64| std::f64::consts::FRAC_PI_4 * diameter * diameter;
    let edge = [0.045, 0.3, 0.555].map(|at| [at - 2.0, 2.0 * area(0.02)]);
    let web = (0..8).map(|pair| [2.8 * (f64::from(pair) + 0.5) / 8.0 - 1.4, 2.0 * area(0.01)]);
    let right = edge.iter().rev().map(|[at, area]| [-at, *area]);
    let due: Vec<[f64; 2]> = edge.iter().copied().chain(web).chain(right).collect();
    assert_eq!(bars.len(), due.len());
    for (bar, due) in bars.concat().into_iter().zip(due.concat()) {
        close(bar, due, 2.0, 1e-12, "bar");
    }
    // Ties confine the edges alone.
    let within = own
        .fibres
        .iter()
        .filter(|fibre| fibre.material == FibreMaterial::Core);
    assert!(within.clone().count() > 2);
    for fibre in within {
        assert!(fibre.at[0].abs() > 1.4, "{}", fibre.at[0]);
    }
    // The concrete of all layers is that of the wall where nothing confines it.
    let plain = own
        .fibres
        .iter()
        .filter(|fibre| fibre.material == FibreMaterial::Cover && fibre.at[0].abs() < 1.4);
    let force: f64 = plain
        .map(|fibre| fibre.spring.backbone().side(Side::Negative).yielding.force)
        .sum();
    near(force, 30e6 * 0.3 * 2.8, 1e-9, "concrete of the web");
    assert_eq!(own.limits[&jostle::FibreLimit::Fracture], 0.06);
}

/// Stress of concrete by Kent and Park without tension, positive in compression, unloading after Karsan and Jirsa. `greatest`: the
/// greatest strain so far.
fn concrete(strain: f64, greatest: f64) -> f64 {
    let (strength, peak, ultimate, residual) = (30e6, 0.002, 0.02, 0.2);
    let envelope = |strain: f64| {
        let x = strain / peak;
        match x {
            x if x <= 0.0 => 0.0,
            x if x <= 1.0 => strength * (2.0 * x - x * x),
            _ => {
                let fallen = (strain - peak) / (ultimate - peak);
                strength * (1.0 - (1.0 - residual) * fallen.min(1.0))
            }
        }
    };
    if strain >= greatest {
        return envelope(strain);
    }
    let x = greatest / peak;
    let plastic = match x {
        x if x < 2.0 => peak * (0.145 * x * x + 0.13 * x),
        _ => peak * (0.707 * (x - 2.0) + 0.834),
    };
    // Not stiffer than at first.
    let initial = 2.0 * strength / peak;
    let slope = (envelope(greatest) / (greatest - plastic)).min(initial);
    (envelope(greatest) - slope * (greatest - strain)).max(0.0)
}

/// Stress of steel, positive in tension, as long as its strain grows.
fn steel(strain: f64) -> f64 {
    let yields = 400e6 / 2e11;
    let beyond = (strain.abs() - yields).max(0.0);
    strain.signum() * (2e11 * strain.abs().min(yields) + 0.01 * 2e11 * beyond)
}

/// Moments under rotations of a section that bears a compression, by bisection of its elongation.
fn moments(compression: f64, length: f64, rotations: &[f64]) -> Vec<f64> {
    let layers = 1600;
    let at = |layer: usize| 4.0 * (layer as f64 + 0.5) / layers as f64 - 2.0;
    let area = |diameter: f64| std::f64::consts::FRAC_PI_4 * diameter * diameter;
    let mut bars: Vec<[f64; 2]> = Vec::new();
    for side in [-1.0, 1.0] {
        bars.extend(
            [0.045, 0.3, 0.555].map(|from_end| [side * (2.0 - from_end), 2.0 * area(0.02)]),
        );
    }
    bars.extend((0..8).map(|pair| [2.8 * (f64::from(pair) + 0.5) / 8.0 - 1.4, 2.0 * area(0.01)]));
    let mut greatest = vec![0.0_f64; layers];
    let mut found = Vec::new();
    for rotation in rotations {
        let forces = |stretched: f64, greatest: &[f64]| {
            let strain = |x: f64| (stretched + x * rotation) / length;
            let mut sum = [0.0; 2];
            let mut add = |force: f64, x: f64| {
                sum[0] += force;
                sum[1] += force * x;
            };
            for (layer, greatest) in greatest.iter().enumerate() {
                let x = at(layer);
                add(
                    -concrete(-strain(x), *greatest) * 0.3 * 4.0 / layers as f64,
                    x,
                );
            }
            for [x, area] in &bars {
                add(steel(strain(*x)) * area, *x);
            }
            sum
        };
        let (mut low, mut high) = (-0.02, 0.1);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match forces(middle, &greatest)[0] < -compression {
                true => low = middle,
                false => high = middle,
            }
        }
        found.push(forces(low, &greatest)[1]);
        for (layer, greatest) in greatest.iter_mut().enumerate() {
            *greatest = greatest.max(-(low + at(layer) * rotation) / length);
        }
    }
    found
}

/// A wall with edges that is pushed over, against moments of its section by another integration: u = θ h + M h²/3EI.
#[test]
fn a_pushed_wall_follows_its_moments_and_curvatures() {
    let (height, length) = (6.0_f64, 1.0);
    let wall = "column = { width = 0.4, depth = 0.4 }\n[[building.wall]]\nline = 1\nlength = 4\nthickness = 0.3\nshear = \"rigid\"\nconcrete = \"30 MPa\"\nsteel = \"400 MPa\"\ncover = \"35 mm\"\nbars = { edges = \"6 d20\", edge_length = \"0.6 m\", web = \"16 d10\" }\nhinge = { rule = \"fibre\", length = \"1 m\", fibres = 200, peak_strain = 0.002, residual = 0.2, ultimate_strain = 0.02, hardening = 0.01 }\n";
    let model = sound(&cantilever(height, wall)).model;
    let system = assembled(&model);
    let settings = PushSettings {
        direction: PushDirection::Right,
        drift: 0.01,
        ..PushSettings::default()
    };
    let pushed = pushover(&system.buildings[0], settings).expect("it bears");
    let compression = 2e6 + 100e3 * 9.80665;
    let rigidity = 30e9 * 0.3 * 64.0 / 12.0;
    // Closer where the wall cracks.
    let rotations: Vec<f64> = (0..=600)
        .map(|step| 1.02e-2 * (f64::from(step) / 600.0).powi(2))
        .collect();
    let curve: Vec<[f64; 2]> = moments(compression, length, &rotations)
        .into_iter()
        .zip(&rotations)
        .map(|(moment, rotation)| {
            let moved = rotation * height + moment * height * height / (3.0 * rigidity);
            [moved, moment / height]
        })
        .collect();
    let scale = curve
        .iter()
        .fold(0.0_f64, |most, [_, force]| most.max(*force));
    let last = pushed.points.last().expect("a curve").roof;
    assert!(last > 0.0599, "{last}");
    let mut compared = 0;
    for point in &pushed.points {
        let beyond = curve.iter().position(|[moved, _]| *moved >= point.roof);
        let next = beyond.expect("within the curve").max(1);
        let ([u0, f0], [u1, f1]) = (curve[next - 1], curve[next]);
        let due = f0 + (f1 - f0) * (point.roof - u0) / (u1 - u0);
        close(point.base_shear, due, scale, 1e-3, "base shear");
        compared += 1;
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn faults_of_walls_of_fibres_are_named() {
    let wall = as_wall("");
    let good = cantilever(3.0, &wall);
    for (from, to, problem) in [
        (
            "rule = \"fibre\"",
            "rule = \"fibre\", yield = \"2 MN.m\"",
            "yield: cannot be combined with rule = \"fibre\"",
        ),
        (
            "bars = \"4 d25 top, 4 d25 bottom, 4 d16 sides\"\nties = \"d10 @ 100 mm\"\n",
            "",
            "but the wall has no bars",
        ),
        (
            "bars = \"4 d25 top, 4 d25 bottom, 4 d16 sides\"",
            "bars = { edges = \"4 d20\", edge_length = 0.8 }",
            "leave nothing of the 1.5 m between them",
        ),
        (
            "bars = \"4 d25 top, 4 d25 bottom, 4 d16 sides\"",
            "bars = { edges = \"4 d20\", edge_length = 0.4, web = \"3 d10\" }",
            "the bars of a web are an even number",
        ),
        (
            "bars = \"4 d25 top, 4 d25 bottom, 4 d16 sides\"",
            "bars = { edges = \"4 d20\", web = \"4 d10\" }",
            "add edge_length",
        ),
        (
            "thickness = 0.4",
            "EI = \"3 GN.m2\"\nEA = \"15 GN\"",
            "bars: needs the size of the section",
        ),
        (
            "length = \"0.5 m\", ",
            "",
            "add length = \"paulay-priestley\" (0.2 l + 0.044 h)",
        ),
        (
            "length = \"0.5 m\"",
            "length = \"3.5 m\"",
            "is more than the height of its storey",
        ),
        (
            "gravity = true",
            "gravity = false",
            "needs the weight of the building",
        ),
        (
            "columns = \"flexible\"",
            "columns = \"rigid\"",
            "needs a wall that changes its length",
        ),
        (
            "hinge = { rule = \"fibre\", length = \"0.5 m\", fibres = 30 }",
            "",
            "has no meaning without fibres",
        ),
        (
            "rule = \"fibre\"",
            "rule = \"bilinear\", yield = \"2 MN.m\", post_yield = 0.02",
            "fibres: has no meaning without fibres",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        let said = refusal(&good.replace(from, to));
        assert!(said.contains(problem), "{problem}: {said}");
    }
    let in_plan = format!(
        "motion = {{ record = \"el-centro-1940-ns\" }}\n[[building]]\nname = \"A\"\nkind = \"frame\"\nplan = [6, 6]\nstoreys = 1\nstorey_height = 3\nmass = \"50 t\"\ngravity = true\n[[building.element]]\nat = [3, 3]\nstiffness = {{ x = 1e3, y = 60e6 }}\n[[building.frame]]\nname = \"F\"\nat = [[0, 0], [0, 6]]\nspans = [6]\nconcrete = \"C30\"\naxial = {{ columns = \"flexible\" }}\nbeam = {{ width = 0.3, depth = 0.5 }}\n{}",
        wall.replace("building.wall", "building.frame.wall")
    );
    let input = sound(&in_plan);
    let Structure::Tiers(tiers) = &input.model.buildings[0].structure else {
        panic!("a building with a plan");
    };
    let mut frames = tiers.frames.iter();
    assert!(frames.all(|own| !own.frame.walls[0].fibres.is_empty()));
    let said = refusal(&in_plan.replace("gravity = true", ""));
    assert!(said.contains("needs the weight of the building"), "{said}");
}
