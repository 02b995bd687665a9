//! A plane frame and two of it at lines of a plan are one structure: whatever their members do, floors move alike, the building bears
//! twice as much, and every member bears the same.

use std::path::Path;

use jostle::results::summary::{BuildingSummary, IsolationSummary};
use jostle::{
    Base, Building, Hinges, Isolation, Isolator, MemberRequest, Model, PlanFrame, Solver,
    Structure, Tier, TierStorey, Tiers,
};
use jostle_io::{Format, Input, TEMPLATE_NAMES, read_model_text, template};
use jostle_testkit::compare::close;
use jostle_testkit::models::rectangle;
use jostle_testkit::motions::fading;
use jostle_testkit::{files, runs};

/// Mass of a floor beside that of its frames \[kg\]: next to nothing.
const SLAB: f64 = 1e-3;
/// Distance of the frames \[m\].
const APART: f64 = 10.0;

/// Two of a plane frame at lines of a plan; `None` for other buildings, and on what frames at lines cannot stand.
fn twice(building: &Building) -> Option<Building> {
    let Structure::Frame(frame) = &building.structure else {
        return None;
    };
    let hinges = match &building.hinges {
        Some(Hinges::Frame(hinges)) => hinges.clone(),
        Some(Hinges::Storeys(_)) => return None,
        None => Default::default(),
    };
    let base = building.base;
    if base.foundation.is_some() || base.uplift {
        return None;
    }
    // The same damping ratio under twice the mass.
    let isolation = match base.isolation {
        Some(isolation) => Some(Isolation {
            isolator: match isolation.isolator {
                Isolator::Linear { stiffness } => Isolator::Linear {
                    stiffness: 2.0 * stiffness,
                },
                Isolator::LeadRubber {
                    stiffness,
                    yield_force,
                    post_yield,
                } => Isolator::LeadRubber {
                    stiffness: 2.0 * stiffness,
                    yield_force: 2.0 * yield_force,
                    post_yield,
                },
                pendulum @ Isolator::Pendulum { .. } => pendulum,
                _ => return None,
            },
            mat_mass: 2.0 * isolation.mat_mass,
            ..isolation
        }),
        None => None,
    };
    let plan = rectangle(0.0, 0.0, frame.spans.iter().sum(), APART);
    let floor = Tier::uniform(SLAB, plan)?;
    let storeys = frame.storey_heights.len();
    let frames = [("1", 0.0), ("2", APART)].map(|(name, y)| PlanFrame {
        name: name.to_owned(),
        at: [0.0, y],
        direction: [1.0, 0.0],
        lines: Vec::new(),
        base: Base {
            isolation: None,
            ..base
        },
        hinges: hinges.clone(),
        frame: frame.clone(),
    });
    Some(Building {
        structure: Structure::Tiers(Tiers {
            floors: vec![floor.clone(); storeys],
            storeys: vec![
                TierStorey {
                    stiffness: [0.0, 1e9, 1e9],
                    centre: floor.centre,
                };
                storeys
            ],
            storey_heights: frame.storey_heights.clone(),
            frames: frames.to_vec(),
            ..Tiers::default()
        }),
        base: Base {
            isolation,
            elevation: base.elevation,
            ..Base::default()
        },
        hinges: None,
        rotation_limits: Vec::new(),
        ..building.clone()
    })
}

/// A building by itself, as direct steps of a millisecond find it.
fn alone(model: &Model, building: Building) -> BuildingSummary {
    let mut alone = Model {
        title: model.title.clone(),
        buildings: vec![building],
        analysis: model.analysis.clone(),
        ..Model::default()
    };
    // In plan the weight above a storey acts on all of it at once.
    alone.buildings[0].gravity.p_delta = false;
    alone.analysis.solver = Some(Solver::Riccati);
    alone.analysis.step = Some(1e-3);
    alone.analysis.members = MemberRequest::all();
    let motion = fading("two", 8.0, [4.0, 1.6], 200);
    let (_, _, summary) = runs::run_and_summary(&alone, &motion);
    summary.buildings.into_iter().next().expect("a building")
}

/// Compares all that both kinds report. `local`: names of members of the first of two frames of the second building as the first one has
/// them, if they are of that frame.
fn compare(
    what: &str,
    plane: &BuildingSummary,
    plan: &BuildingSummary,
    base_moves: bool,
    local: &dyn Fn(&str) -> Option<String>,
) {
    let most = |of: &dyn Fn(usize) -> f64| (0..plane.floors.len()).map(of).fold(0.0, f64::max);
    let shear = most(&|floor| plane.floors[floor].response.storey_shear_peak_n);
    let sway = most(&|floor| plane.floors[floor].response.displacement_peak_m());
    let shaken = most(&|floor| plane.floors[floor].response.total_acceleration_peak_m_s2);
    let near = |got: f64, expected: f64, scale: f64, quantity: &str| {
        close(got, expected, scale, 1e-3, &format!("{what}: {quantity}"));
    };
    near(plan.mass_kg, 2.0 * plane.mass_kg, plane.mass_kg, "mass");
    let [own, other] = [plan, plane].map(|building| &building.response);
    near(
        own.base_shear_peak_n,
        2.0 * other.base_shear_peak_n,
        shear,
        "base shear",
    );
    for (own, other) in plan.floors.iter().zip(&plane.floors) {
        let (own, other) = (&own.response, &other.response);
        near(
            own.displacement_max_m,
            other.displacement_max_m,
            sway,
            "displacement",
        );
        near(
            own.displacement_min_m,
            other.displacement_min_m,
            sway,
            "displacement",
        );
        near(
            own.storey_shear_peak_n,
            2.0 * other.storey_shear_peak_n,
            shear,
            "storey shear",
        );
        let [own, other] = [own, other].map(|floor| floor.total_acceleration_peak_m_s2);
        near(own, other, shaken, "acceleration");
    }
    if !base_moves {
        near(own.drift_peak, other.drift_peak, other.drift_peak, "drift");
        let lowest = plane.floors[0].response.storey_shear_peak_n;
        near(
            other.base_shear_peak_n,
            lowest,
            shear,
            "shear of the lowest storey",
        );
    }
    if let (Some(plane), Some(plan)) = (&plane.isolation, &plan.isolation) {
        let of = |isolation: &IsolationSummary| [isolation.force_peak_n, isolation.hysteretic_j];
        for (own, other) in of(plan).into_iter().zip(of(plane)) {
            near(own, 2.0 * other, other, "force and energy of bearings");
        }
    }
    let ends = |building: &BuildingSummary, local: &dyn Fn(&str) -> Option<String>| {
        let name = format!("{}.", building.name);
        let members = building.members.iter();
        let members = members.filter_map(|member| {
            let place = local(member.name.strip_prefix(&name)?)?;
            let is_column = place.starts_with("column");
            let ends = member.ends.iter().map(|end| {
                // Rigid floors hold the beams of frames at lines.
                let axial = if is_column {
                    [end.axial_max_n, end.axial_min_n]
                } else {
                    [0.0; 2]
                };
                [axial[0], axial[1], end.shear_peak_n, end.moment_peak_n_m]
            });
            Some((place, ends.collect::<Vec<_>>()))
        });
        let mut members: Vec<_> = members.collect();
        members.sort_by(|a, b| a.0.cmp(&b.0));
        members
    };
    let same = |name: &str| Some(name.to_owned());
    let (all, expected) = (ends(plan, local), ends(plane, &same));
    assert_eq!(all.len(), expected.len(), "{what}: members");
    let scale = |part: usize| {
        let ends = expected.iter().flat_map(|(_, ends)| ends);
        ends.map(|end| end[part].abs()).fold(1.0, f64::max)
    };
    let scales = [0, 1, 2, 3].map(scale);
    for ((place, own), (other_place, other)) in all.iter().zip(&expected) {
        assert_eq!(place, other_place, "{what}");
        for (own, other) in own.iter().zip(other) {
            for part in 0..4 {
                let quantity = [
                    "greatest axial force",
                    "least axial force",
                    "shear",
                    "moment",
                ][part];
                near(
                    own[part],
                    other[part],
                    scales[part],
                    &format!("{quantity} of {place}"),
                );
            }
        }
    }
}

fn base_moves(building: &Building) -> bool {
    building.base.horizontal_stiffness.is_some() || building.base.isolation.is_some()
}

fn compare_all(name: &str, input: &Input) -> usize {
    let model = &input.model;
    let mut compared = 0;
    for building in &model.buildings {
        let Some(plan) = twice(building) else {
            continue;
        };
        let [plane, plan] = [building.clone(), plan].map(|building| alone(model, building));
        let what = format!("{name}, {}", building.name);
        compare(&what, &plane, &plan, base_moves(building), &|name| {
            name.strip_prefix("1.").map(str::to_owned)
        });
        compared += 1;
    }
    compared
}

const BARE: &str = r#"
[motion]
record = "el-centro-1940-ns"
duration = "2 s"
[[building]]
name = "A"
storeys = 2
storey_height = "3 m"
spans = ["5 m", "4 m"]
column = { width = "400 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "500 mm" }
floor_mass = "30 t"
beam_mass = "2 t/m"
beam_segments = 1
column_segments = 1
concrete = "C30"
damping = { alpha = 0.5 }
"#;

/// Keys of a frame that meet in one column, one beam or one joint. Damping and mass of columns would stand between storeys and the
/// springs at their feet. No column fails in shear: which of equal ones fails first, rounding decides.
const TOGETHER: [&str; 8] = [
    "rigid_ends = 1.0\ncolumn_segments = 3\n",
    "infill = [{ bay = 1, modulus = \"3 GPa\", thickness = \"200 mm\", width = \"mainstone\", offset = \"0.4 m\", struts = 3, central_share = 0.5 }]\nrigid_ends = 0.5\ncolumn_segments = 2\n",
    "gravity = true\naxial = \"rigid\"\n",
    "gravity = true\naxial = \"flexible\"\nbrace = [{ bay = 2, direction = \"both\", EA = \"300 MN\" }]\n",
    "hinges = { rule = \"takeda\", column = { cracking = \"60 kN.m\", yield = \"150 kN.m\", post_cracking = 0.3, post_yield = 0.02 }, beam = { cracking = \"40 kN.m\", yield = \"100 kN.m\", post_cracking = 0.3, post_yield = 0.02 } }\nrigid_ends = { beams = \"0.2 m\" }\n",
    "shear_failure = { strength = \"900 kN\", slope = \"5 MN/m\", residual = 0.2 }\nbeam_segments = 2\ndensity = 0\n",
    "wall = [{ line = 1, length = \"1.5 m\", thickness = \"250 mm\" }]\njoint = { rotational_stiffness = \"60 MN.m/rad\" }\n",
    "base = { rotational_stiffness = \"200 MN.m/rad\", horizontal_stiffness = \"150 MN/m\" }\n",
];

#[test]
fn frames_at_lines_are_plane_frames_whatever_meets_in_them() {
    for keys in TOGETHER {
        let stated = keys.lines().filter_map(|line| line.split(" = ").next());
        let stated: Vec<&str> = stated.collect();
        let kept = BARE.lines().filter(|line| {
            let key = line.split(" = ").next().unwrap_or_default();
            !stated.contains(&key)
        });
        let text = kept.collect::<Vec<_>>().join("\n") + "\n" + keys;
        assert_eq!(compare_all(keys, &files::sound(&text)), 1, "{keys}");
    }
}

/// Feet that turn and slide follow a mat that moves.
#[test]
fn walls_that_turn_and_slide_stand_on_mats_as_in_one_plane() {
    let wall = "wall = [{ line = 1, length = \"1.5 m\", thickness = \"250 mm\", hinge = { rule = \"bilinear\", yield = \"2 MN.m\", post_yield = 0.02, length = \"1 m\" }, shear_hinge = { rule = \"bilinear\", yield = \"900 kN\", post_yield = 0.02 } }]\n";
    let linear = "isolation = { kind = \"linear\", stiffness = \"20 MN/m\", mat_mass = \"60 t\", damping_ratio = 0.1 }";
    let kept = ON_BEARINGS
        .lines()
        .filter(|line| !line.starts_with("isolation"));
    let text = kept.collect::<Vec<_>>().join("\n") + "\ndensity = 0\n" + linear + "\n" + wall;
    assert_eq!(compare_all("on a mat", &files::sound(&text)), 1);
}

/// Whatever the templates say of plane frames.
#[test]
fn frames_of_templates_are_alike_in_one_plane_and_at_lines() {
    let mut compared = 0;
    for name in TEMPLATE_NAMES {
        let text = template(name, "A").expect("the name is listed");
        let input = read_model_text(name, &text, Format::Toml, Path::new(""));
        let input = input.unwrap_or_else(|error| panic!("{error}"));
        compared += compare_all(name, &input);
    }
    assert!(compared > 6, "{compared} frames");
}

const ON_BEARINGS: &str = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.4 g"
duration = "4 s"
[[building]]
name = "A"
storeys = 1
storey_height = "3 m"
floor_mass = "60 t"
spans = ["5 m"]
elastic_modulus = "30 GPa"
column = { width = "400 mm", depth = "500 mm" }
beam = { width = "300 mm", depth = "500 mm" }
beam_mass = "1000 kg/m"
isolation = { kind = "lead-rubber", stiffness = "40 MN/m", post_yield = 0.1, mat_mass = "60 t", yield = "50 kN" }
"#;

/// What yields in the building does not take the place of the bearings, which bear the base shear.
#[test]
fn bearings_bear_the_base_shear_whatever_yields_above() {
    let panel = "modulus = \"3 GPa\", thickness = \"200 mm\", width = \"0.9 m\"";
    let parts = [
        format!("infill = [{{ {panel} }}]\n"),
        format!("infill = [{{ {panel}, out_of_plane = {{ strength = \"0.05 kPa\", density = \"1400 kg/m3\", remove = true }} }}]\n"),
        "brace = [{ direction = \"up\", EA = \"200 MN\", hinge = { rule = \"bilinear\", yield = \"50 kN\", post_yield = 0.02 } }]\n".to_owned(),
        "wall = [{ line = 1, length = \"1.5 m\", thickness = \"250 mm\", shear_hinge = { rule = \"bilinear\", yield = \"100 kN\", post_yield = 0.02 } }]\n".to_owned(),
    ];
    for part in parts {
        let mut model = files::sound(&format!("{ON_BEARINGS}{part}")).model;
        model.analysis.step = Some(2e-3);
        model.analysis.solver = Some(Solver::Riccati);
        let motion = fading("two", 8.0, [4.0, 1.6], 200);
        let (_, _, summary) = runs::run_and_summary(&model, &motion);
        let building = &summary.buildings[0];
        let isolation = building.isolation.as_ref().expect("bearings");
        let base_shear = building.response.base_shear_peak_n;
        close(isolation.force_peak_n, base_shear, base_shear, 1e-6, &part);
        assert!(
            isolation.hysteretic_j > 100.0,
            "{part}: {} J",
            isolation.hysteretic_j
        );
    }
}

/// Bearings that yield or slide have the same energies: what their stiffness after yield stores is not dissipated.
#[test]
fn bearings_dissipate_in_a_plan_as_in_one_plane() {
    let pendulum = "isolation = { kind = \"friction-pendulum\", radius = \"2 m\", friction = 0.05, mat_mass = \"60 t\" }";
    let kept = ON_BEARINGS.lines();
    let kept = kept.filter(|line| !line.starts_with("isolation"));
    let pendulum = kept.collect::<Vec<_>>().join("\n") + "\n" + pendulum;
    for text in [ON_BEARINGS, &pendulum] {
        let text = format!("{text}\ndensity = 0\n");
        assert_eq!(compare_all(&text, &files::sound(&text)), 1);
    }
}
