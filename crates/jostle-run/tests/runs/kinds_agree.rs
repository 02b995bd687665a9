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

/// Keys of a frame that meet in one column, one beam or one joint. Damping by stiffness would stand between storeys and the springs at
/// their feet. No column fails in shear: which of equal ones fails first, rounding decides.
const TOGETHER: [&str; 8] = [
    "rigid_ends = 1.0\ncolumn_segments = 3\n",
    "infill = [{ bay = 1, modulus = \"3 GPa\", thickness = \"200 mm\", width = \"mainstone\", offset = \"0.4 m\", struts = 3, central_share = 0.5 }]\nrigid_ends = 0.5\ncolumn_segments = 2\n",
    "gravity = true\naxial = \"rigid\"\n",
    "gravity = true\naxial = \"flexible\"\nbrace = [{ bay = 2, direction = \"both\", EA = \"300 MN\" }]\n",
    "hinges = { rule = \"takeda\", column = { cracking = \"60 kN.m\", yield = \"150 kN.m\", post_cracking = 0.3, post_yield = 0.02 }, beam = { cracking = \"40 kN.m\", yield = \"100 kN.m\", post_cracking = 0.3, post_yield = 0.02 } }\nrigid_ends = { beams = \"0.2 m\" }\n",
    "shear_failure = { strength = \"900 kN\", slope = \"5 MN/m\", residual = 0.2 }\nbeam_segments = 2\n",
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
    let text = kept.collect::<Vec<_>>().join("\n") + "\n" + linear + "\n" + wall;
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

/// Numbers that look random and are always the same (splitmix64).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// From 0 to 1.
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn chance(&mut self, of: f64) -> bool {
        self.share() < of
    }

    /// To three digits.
    fn between(&mut self, least: f64, most: f64) -> f64 {
        (1e3 * (least + self.share() * (most - least))).round() / 1e3
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.next() as usize % all.len()]
    }

    /// Moments of a hinge by a rule.
    fn hinge(&mut self, rule: &str, [least, most]: [f64; 2]) -> String {
        let yielding = self.between(least, most);
        let after = self.between(0.002, 0.05);
        let cracks = match rule {
            "bilinear" => String::new(),
            _ => format!(
                "cracking = \"{} kN.m\", post_cracking = {}, ",
                0.4 * yielding,
                self.between(0.2, 0.5)
            ),
        };
        format!("{{ {cracks}yield = \"{yielding} kN.m\", post_yield = {after} }}")
    }
}

/// A plane frame, and what the same keys are for two of them as a space frame, if that has them all.
struct Drawn {
    plane: String,
    space: Option<String>,
}

/// Left out are what is defined differently, and what rounding decides:
/// - storey drifts where feet slide: those of a plane frame begin at its first foot, those of a plan at the ground;
/// - base shear where masses of walls or feet stand below the spring that slides: `density` is 0 there;
/// - axial forces of beams, which rigid floors hold;
/// - P-Delta, which acts on the whole of a storey in plan;
/// - columns that fail in shear and panels that fall: which of equal ones is the first;
/// - foundations, whose springs are those of one plane or of a plan.
fn drawn(draw: &mut Draw) -> Drawn {
    let in_space = draw.chance(0.4);
    let (storeys, bays) = (1 + usize::from(draw.chance(0.6)), draw.one_of(&[1, 2]));
    let heights: Vec<f64> = (0..storeys).map(|_| draw.between(2.8, 4.0)).collect();
    let spans: Vec<f64> = (0..bays).map(|_| draw.between(3.5, 6.5)).collect();
    let quoted = |lengths: &[f64]| {
        let lengths = lengths.iter().map(|length| format!("\"{length} m\""));
        lengths.collect::<Vec<_>>().join(", ")
    };
    let [width, depth] = [draw.between(0.35, 0.5), draw.between(0.4, 0.6)];
    let beam = format!(
        "{{ width = \"0.3 m\", depth = \"{} m\" }}",
        draw.between(0.4, 0.6)
    );
    let mass = draw.between(15.0, 60.0);
    let flexible = in_space || draw.chance(0.5);
    let has_wall = !in_space && draw.chance(0.25);
    let mut shared = vec!["elastic_modulus = \"30 GPa\"".to_owned()];
    let (mut plane, mut space) = (Vec::new(), Vec::new());
    if in_space || draw.chance(0.5) {
        shared.push("gravity = true".to_owned());
    }
    if draw.chance(0.4) {
        let ends = ["0.5", "1.0", "{ beams = \"0.2 m\", columns = \"0.25 m\" }"];
        shared.push(format!("rigid_ends = {}", draw.one_of(&ends)));
    }
    if draw.chance(0.3) {
        shared.push("shear = \"flexible\"".to_owned());
    }
    let rules = ["bilinear", "normal", "peak-oriented", "takeda"];
    let rule = draw.one_of(&rules);
    let mut beams_yield = false;
    if draw.chance(0.5) {
        let column = draw.hinge(rule, [90.0, 300.0]);
        let mut rest = match draw.chance(0.3) {
            true => format!(", initial = {}", draw.one_of(&["30", "\"rigid\""])),
            false => String::new(),
        };
        if draw.chance(0.6) {
            beams_yield = true;
            rest = format!("{rest}, beam = {}", draw.hinge(rule, [60.0, 200.0]));
        }
        plane.push(format!(
            "hinges = {{ rule = \"{rule}\", column = {column}{rest} }}"
        ));
        space.push(format!(
            "hinges = {{ rule = \"{rule}\", column = {{ x = {column} }}{rest} }}"
        ));
    }
    if !beams_yield && draw.chance(0.35) {
        let stiffness = format!(
            "rotational_stiffness = \"{} MN.m/rad\"",
            draw.between(20.0, 150.0)
        );
        let rule = draw.one_of(&rules);
        let law = draw.hinge(rule, [50.0, 150.0]);
        let law = law.trim_start_matches("{ ");
        let joint = match in_space || draw.chance(0.5) {
            true => format!("{{ {stiffness}, hinge = {{ rule = \"{rule}\", {law} }}"),
            false => format!("{{ {stiffness} }}"),
        };
        plane.push(format!("joint = {joint}"));
        space.push(format!("joint = {{ x = {joint} }}"));
    }
    if !has_wall && draw.chance(0.35) {
        let direction = draw.one_of(&["up", "down", "both"]);
        let hinge = match draw.chance(0.5) {
            true => ", hinge = { rule = \"bilinear\", yield = \"150 kN\", post_yield = 0.02 }",
            false => "",
        };
        let brace = format!(
            "direction = \"{direction}\", EA = \"{} MN\"{hinge}",
            draw.between(100.0, 500.0)
        );
        plane.push(format!("brace = [{{ {brace} }}]"));
        space.push(format!("brace = [{{ along = \"x\", {brace} }}]"));
    }
    if !has_wall && draw.chance(0.35) {
        let strength = draw.one_of(&["", ", force = \"150 kN\""]);
        let offset = match draw.chance(0.4) && !in_space {
            true => ", offset = \"0.4 m\"",
            false => "",
        };
        let panel = format!(
            "modulus = \"3 GPa\", thickness = \"200 mm\", width = \"0.8 m\"{strength}{offset}"
        );
        plane.push(format!("infill = [{{ {panel} }}]"));
        space.push(format!("infill = [{{ along = \"x\", {panel} }}]"));
    }
    let mut density = if in_space { 0 } else { draw.one_of(&[0, 2500]) };
    if has_wall {
        let hinge = match draw.chance(0.5) {
            true => {
                ", hinge = { rule = \"takeda\", cracking = \"400 kN.m\", yield = \"900 kN.m\", post_cracking = 0.3, post_yield = 0.02, length = \"1 m\" }"
            }
            false => "",
        };
        let sliding = match draw.chance(0.5) {
            true => {
                ", shear_hinge = { rule = \"bilinear\", yield = \"400 kN\", post_yield = 0.02 }"
            }
            false => "",
        };
        if !sliding.is_empty() {
            density = 0;
        }
        let wall = |line: usize| {
            format!(
                "{{ line = {line}, length = \"1.5 m\", thickness = \"250 mm\"{hinge}{sliding} }}"
            )
        };
        // One bay between walls leaves no beam to yield.
        let coupled = draw.chance(0.5) && bays == 2;
        let walls = match coupled {
            true => format!("{}, {}", wall(1), wall(2)),
            false => wall(1),
        };
        plane.push(format!("wall = [{walls}]"));
        if coupled {
            plane.push("coupling_beam = [{ bay = 1, width = \"250 mm\", depth = \"600 mm\", hinge = { rule = \"bilinear\", yield = \"150 kN\", post_yield = 0.02 } }]".to_owned());
        }
    }
    let mut segments = [1, 1];
    let mut beam_mass = 0.0;
    if !in_space {
        segments = [draw.one_of(&[1, 1, 2, 3]), draw.one_of(&[1, 2, 3])];
        beam_mass = draw.between(500.0, 4000.0);
        match draw.one_of(&["", "", "", "base", "rubber", "lead"]) {
            "base" => {
                let turning = "rotational_stiffness = \"200 MN.m/rad\"";
                let sliding = "horizontal_stiffness = \"150 MN/m\"";
                let both = format!("{turning}, {sliding}");
                let base = draw.one_of(&[turning, sliding, both.as_str()]);
                plane.push(format!("base = {{ {base} }}"));
            }
            "rubber" => plane.push("isolation = { kind = \"linear\", stiffness = \"20 MN/m\", mat_mass = \"60 t\", damping_ratio = 0.1 }".to_owned()),
            "lead" => plane.push("isolation = { kind = \"lead-rubber\", stiffness = \"40 MN/m\", post_yield = 0.1, mat_mass = \"60 t\", yield = \"50 kN\" }".to_owned()),
            _ => {}
        }
    } else if !space.iter().any(|key| key.starts_with("infill")) && mass > 35.0 {
        // A base that hardly moves. One that does ties the feet together, which stand by themselves under a plane frame. Struts that close
        // and open within steps would show how little it moves.
        space.push("base = { horizontal_stiffness = \"2e6 MN/m\" }".to_owned());
    }
    let shared = shared.join("\n");
    let head = format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\nduration = \"2 s\"\n[[building]]\nname = \"A\"\nstoreys = {storeys}\nstorey_height = [{}]\ndamping = {{ alpha = 0.5 }}\n{shared}\nbeam",
        quoted(&heights)
    );
    let mut lines = vec![0.0];
    for span in &spans {
        lines.push(lines[lines.len() - 1] + span);
    }
    let axial = if flexible { "flexible" } else { "rigid" };
    let space = in_space.then(|| {
        format!(
            "{head}_x = {beam}\nkind = \"space-frame\"\nlines_x = [{}]\nlines_y = [\"1 m\", \"7 m\"]\nplan = [\"{} m\", \"8 m\"]\nmass = \"{} t\"\ncolumn = {{ size = [\"{depth} m\", \"{width} m\"] }}\nbeam_y = {{ width = \"0.1 m\", depth = \"0.1 m\" }}\ndensity = 0\naxial = \"{axial}\"\n{}\n",
            quoted(&lines),
            lines[lines.len() - 1],
            2.0 * mass,
            space.join("\n")
        )
    });
    let [column_segments, beam_segments] = segments;
    let plane = format!(
        "{head} = {beam}\nkind = \"frame\"\nspans = [{}]\nfloor_mass = \"{mass} t\"\ncolumn = {{ width = \"{width} m\", depth = \"{depth} m\" }}\nbeam_mass = \"{beam_mass} kg/m\"\ncolumn_segments = {column_segments}\nbeam_segments = {beam_segments}\ndensity = \"{density} kg/m3\"\naxial = {{ columns = \"{axial}\" }}\n{}\n",
        quoted(&spans),
        plane.join("\n")
    );
    Drawn { plane, space }
}

/// The name of a member of the first of two frames along x of a space frame, as a plane frame has it.
fn of_first_line(name: &str) -> Option<String> {
    let parts: Vec<&str> = name.split('.').collect();
    match parts[..] {
        ["column", line, "1", storey] => Some(format!("column.{line}.{storey}")),
        ["beam_x", floor, bay, "1"] => Some(format!("beam.{floor}.{bay}")),
        _ => None,
    }
}

#[test]
fn kinds_agree_on_features_drawn_together() {
    let mut draw = Draw(1);
    let (mut planes, mut spaces) = (0, 0);
    for number in 0..80 {
        let drawn = drawn(&mut draw);
        let input = files::sound(&drawn.plane);
        let what = format!("draw {number}\n{}", drawn.plane);
        planes += compare_all(&what, &input);
        if let Some(text) = drawn.space {
            let space = files::sound(&text).model;
            let building = &input.model.buildings[0];
            let [plane, space] =
                [building, &space.buildings[0]].map(|b| alone(&input.model, b.clone()));
            compare(
                &format!("{what}\n{text}"),
                &plane,
                &space,
                base_moves(building),
                &of_first_line,
            );
            spaces += 1;
        }
    }
    assert!(planes == 80 && spaces > 20, "{planes} and {spaces}");
}
