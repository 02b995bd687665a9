//! Walls and coupling beams of frames: closed forms, equilibrium, and the same frame by another way.

use std::collections::BTreeMap;

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule, Pinching};
use jostle::linear::StepMatrix;
use jostle::statics::{STANDARD_GRAVITY, compressions};
use jostle::structure::solve_once;
use jostle::{
    Axial, Base, Building, CouplingBeam, Damping, Foundation, Frame, FrameHinges, FrameWall,
    Gravity, HalfSpace, MemberRequest, Model, Outcome, PlanFrame, RiccatiSweep, Section, Shear,
    Soil, SoilCoupling, Solver, Structure, Summary, System, Tier, Tiers, WallHinge,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{bending, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

use crate::verification::support::{assembled, run, steps};

fn law(rule: HysteresisRule, initial: f64, yielding: f64, post_yield: f64) -> Hysteresis {
    let corners = match rule {
        HysteresisRule::Bilinear => Corners::bilinear(yielding, post_yield),
        _ => Corners {
            cracking: 0.6 * yielding,
            yielding,
            post_cracking: 0.5,
            post_yield,
        },
    };
    let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
    Hysteresis::new(rule, backbone).expect("sound")
}

fn at_foot(hysteresis: Hysteresis) -> Vec<WallHinge> {
    vec![WallHinge {
        storey: 1,
        at_head: false,
        hysteresis,
    }]
}

/// Two walls of 3 m and 2 m, 5 m apart, coupled at every floor, and a column line beside them.
fn coupled(storeys: usize, yields: bool) -> Frame {
    let wall = |line: usize, length: f64, moment: f64| FrameWall {
        line,
        storeys: [1, storeys],
        length,
        hinges: match yields {
            true => at_foot(law(HysteresisRule::Bilinear, 5e10, moment, 0.02)),
            false => Vec::new(),
        },
        fibres: BTreeMap::new(),
        shear: yields.then(|| law(HysteresisRule::Bilinear, 8e8, 6e5, 0.05)),
        stiffness_factors: [1.0; 2],
    };
    let section = |length: f64| Section {
        flexural_rigidity: 3e10 * 0.2 * length.powi(3) / 12.0,
        axial_rigidity: Some(3e10 * 0.2 * length),
        shear_rigidity: Some(1e10 * 0.2 * length),
        line_mass: 2500.0 * 0.2 * length,
    };
    let beam = Section {
        axial_rigidity: Some(4e9),
        shear_rigidity: Some(8e8),
        ..bending(4e7)
    };
    let mut frame = Frame {
        storey_heights: vec![3.0; storeys],
        spans: vec![5.0, 4.0],
        columns: vec![
            Section {
                axial_rigidity: Some(6e9),
                ..bending(8e7)
            };
            storeys
        ],
        beams: vec![beam; storeys],
        beam_mass: vec![4000.0; storeys],
        floor_mass: vec![3e4; storeys],
        column_segments: 2,
        beam_segments: vec![2; 2],
        walls: vec![wall(1, 3.0, 2.5e6), wall(2, 2.0, 1e6)],
        ..Frame::default()
    };
    let pinched = HysteresisRule::Pinched(Pinching {
        deformation: 0.8,
        force: 0.2,
        unloading_exponent: 0.2,
        ductility_damage: 0.0,
        energy_damage: 0.0,
    });
    for storey in 0..storeys {
        frame.own_columns.insert([storey, 0], Some(section(3.0)));
        frame.own_columns.insert([storey, 1], Some(section(2.0)));
        let rule = [HysteresisRule::Bilinear, pinched][storey % 2];
        frame.coupling_beams.push(CouplingBeam {
            floor: storey + 1,
            bay: 1,
            shear: yields.then(|| law(rule, 3e8, 8e4, 0.03)),
            stiffness_factors: [1.0; 2],
        });
    }
    frame
}

fn alone(frame: Frame) -> Model {
    let mut model = Model {
        title: "walls".to_owned(),
        buildings: vec![Building {
            name: "A".to_owned(),
            structure: Structure::Frame(frame),
            damping: Damping::Rayleigh {
                alpha: 0.4,
                beta: 1e-4,
            },
            ..Building::default()
        }],
        ..Model::default()
    };
    model.analysis.members = MemberRequest::all();
    model
}

fn shaken(model: &Model) -> (System, Outcome) {
    let system = assembled(model);
    let outcome = run(
        &system,
        &fading("along", 9.0, [2.5, 3.0], 500),
        &steps(1e-3, 1),
    );
    let imbalance = outcome.energy.worst_imbalance;
    assert!(
        imbalance < 1e-6,
        "{imbalance:e} {:?}",
        model.buildings[0].base
    );
    (system, outcome)
}

/// How far the first floor sways under a unit force there.
fn sway(frame: &Frame) -> f64 {
    let system = assembled(&alone(frame.clone()));
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    load[building.floors[0].dof] = 1.0;
    let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load)
        .expect("it stands");
    moved[building.floors[0].dof]
}

/// Two equal walls of one storey with a coupling beam on rigid arms: by symmetry each is a cantilever with half of the force F, held at
/// its top by the moment k θ of the beam, k = 6 EI/(l(1 + φ)) (1 + 2a/l) (1 + 2a/l) with its clear span l between arms a.
#[test]
fn a_pair_of_walls_sways_as_in_closed_form() {
    let (height, span, length) = (4.0_f64, 6.0, 2.5);
    let (wall_ei, wall_ga, beam_ei, beam_ga) = (4e9, 9e8, 5e7, 3e8);
    let mut frame = Frame {
        storey_heights: vec![height],
        spans: vec![span],
        columns: vec![Section {
            shear_rigidity: Some(wall_ga),
            ..bending(wall_ei)
        }],
        beams: vec![Section {
            shear_rigidity: Some(beam_ga),
            ..bending(beam_ei)
        }],
        beam_mass: vec![0.0],
        floor_mass: vec![1e4],
        column_segments: 1,
        beam_segments: vec![1],
        ..Frame::default()
    };
    let section = frame.columns[0];
    for line in 1..=2 {
        frame.own_columns.insert([0, line - 1], Some(section));
        frame.walls.push(FrameWall {
            line,
            storeys: [1, 1],
            length,
            hinges: Vec::new(),
            fibres: BTreeMap::new(),
            shear: None,
            stiffness_factors: [1.0; 2],
        });
    }
    let clear = span - length;
    let phi = 12.0 * beam_ei / (beam_ga * clear * clear);
    let beam = 6.0 * beam_ei / (clear * (1.0 + phi)) * (span / clear) * (span / clear);
    // Top of a cantilever under a force and a moment: u = F h³/3EI + F h/GA − M h²/2EI, θ = F h²/2EI − M h/EI, M = k θ.
    let (force, turned) = (0.5, height / wall_ei);
    let theta = force * height * turned / 2.0 / (1.0 + beam * turned);
    let moved = force * height.powi(3) / (3.0 * wall_ei) + force * height / wall_ga
        - beam * theta * height * turned / 2.0;
    close(sway(&frame), moved, moved, 1e-12, "sway");
    // Shear deformation as a spring is the same as long as it does not yield.
    for wall in &mut frame.walls {
        wall.shear = Some(law(HysteresisRule::Bilinear, wall_ga / height, 1e9, 0.1));
    }
    frame.coupling_beams.push(CouplingBeam {
        floor: 1,
        bay: 1,
        shear: Some(law(HysteresisRule::Bilinear, beam_ga / clear, 1e9, 0.1)),
        stiffness_factors: [1.0; 2],
    });
    close(sway(&frame), moved, moved, 1e-12, "sway over springs");
}

/// Rigid walls on hinges with a coupling beam that yields: the storey is a spring of (k₁ + k₂ + V(L θ) L/θ)/h² with the distance L between
/// the axes, whatever the lengths of the walls. It moves, pushes and dissipates as that shear building.
#[test]
fn a_coupling_beam_yields_over_the_distance_of_its_walls() {
    let (height, span) = (3.5, 6.0);
    let (k, k_shear, strength, hardening) = ([4e7, 2e7], 2e8, 1.2e5, 0.04);
    let far = |line: usize| FrameWall {
        line,
        storeys: [1, 1],
        length: [2.5, 1.5][line - 1],
        // Elastic: it never yields.
        hinges: at_foot(law(HysteresisRule::Bilinear, k[line - 1], 1e12, 1.0)),
        fibres: BTreeMap::new(),
        shear: None,
        stiffness_factors: [1.0; 2],
    };
    let mut walls = Frame {
        storey_heights: vec![height],
        spans: vec![span],
        columns: vec![bending(1e16)],
        beams: vec![bending(1e16)],
        beam_mass: vec![0.0],
        floor_mass: vec![4e4],
        column_segments: 1,
        beam_segments: vec![1],
        walls: vec![far(1), far(2)],
        ..Frame::default()
    };
    walls.coupling_beams.push(CouplingBeam {
        floor: 1,
        bay: 1,
        shear: Some(law(HysteresisRule::Bilinear, k_shear, strength, hardening)),
        stiffness_factors: [1.0; 2],
    });
    let section = walls.columns[0];
    for line in 0..2 {
        walls.own_columns.insert([0, line], Some(section));
    }
    let squared = (span / height) * (span / height);
    let elastic = (k[0] + k[1]) / (height * height);
    let initial = elastic + k_shear * squared;
    let at_yield = strength / k_shear * height / span;
    let storey = law(
        HysteresisRule::Bilinear,
        initial,
        initial * at_yield,
        (elastic + hardening * k_shear * squared) / initial,
    );
    let mut as_storey = alone(walls.clone());
    as_storey.buildings[0].structure = Structure::Shear(Shear {
        mass: vec![4e4],
        stiffness: vec![initial],
        storey_heights: vec![height],
    });
    as_storey.buildings[0].hinges = Some(jostle::Hinges::Storeys(vec![storey]));
    as_storey.analysis.members = MemberRequest::default();
    as_storey.buildings[0].damping = Damping::Rayleigh {
        alpha: 0.4,
        beta: 0.0,
    };
    let mut as_walls = alone(walls);
    as_walls.buildings[0].damping = as_storey.buildings[0].damping.clone();
    let motion = fading("along", 9.0, [2.5, 3.0], 500);
    let summary = |model: &Model| -> (System, Outcome, Summary) {
        let mut model = model.clone();
        model.analysis.solver = Some(Solver::Riccati);
        // Peaks of parts are those at the ends of steps.
        model.analysis.step = Some(2.5e-4);
        runs::run_and_summary(&model, &motion)
    };
    let (_, _, of_walls) = summary(&as_walls);
    let (_, _, of_storey) = summary(&as_storey);
    let [building, storey] = [&of_walls, &of_storey].map(|summary| &summary.buildings[0]);
    let [own_floor, floor] = [building, storey].map(|building| building.floors.above[0].response);
    close(
        own_floor.displacement_max_m,
        floor.displacement_max_m,
        floor.displacement_max_m,
        1e-6,
        "displacement",
    );
    close(
        building.response.base_shear_peak_n,
        storey.response.base_shear_peak_n,
        storey.response.base_shear_peak_n,
        1e-6,
        "base shear",
    );
    let beam = building.parts.last().expect("the coupling beam");
    assert_eq!(beam.name, "A.coupling-beam.1.1");
    assert!(beam.dissipated_j > 1e3, "{} J", beam.dissipated_j);
    // The stiffness that stays after yield, be it of walls or of the beam, stores all its energy.
    let spent = storey.hinges.dissipated_j;
    close(beam.dissipated_j, spent, spent, 1e-6, "dissipated");
    // The beam takes L/h of the storey's deformation.
    let most = floor.displacement_max_m.max(-floor.displacement_min_m);
    let slid = most * span / height;
    close(
        beam.deformation_max.max(beam.deformation_min),
        slid,
        slid,
        1e-6,
        "transverse displacement of the beam",
    );
    let shear = strength + hardening * k_shear * (slid - strength / k_shear);
    let force = beam.force_max_n.max(-beam.force_min_n);
    close(force, shear, shear, 1e-6, "shear of the beam");
    // Axial forces of the walls are that shear, and their couple is V L beside the moments k θ.
    let wall = &building.parts[0];
    assert_eq!((&wall.name[..], wall.kind), ("A.wall.1", "wall"));
    close(
        wall.force_max_n.max(-wall.force_min_n),
        shear,
        shear,
        1e-6,
        "axial force of a wall",
    );
    let moments = (k[0] + k[1]) * most / height;
    let share = shear * span / (shear * span + moments);
    close(
        building.degree_of_coupling.expect("coupled walls"),
        share,
        1.0,
        1e-6,
        "degree of coupling",
    );
}

/// Shear of rigid walls is that of a storey.
#[test]
fn walls_yield_in_shear_as_a_storey() {
    let height = 3.5;
    let own_law = law(HysteresisRule::Bilinear, 4e7, 1e5, 0.03);
    let mut walls = Frame {
        storey_heights: vec![height],
        spans: vec![6.0],
        columns: vec![bending(1e16)],
        beams: vec![bending(1.0)],
        beam_mass: vec![0.0],
        floor_mass: vec![4e4],
        column_segments: 1,
        beam_segments: vec![1],
        ..Frame::default()
    };
    let section = walls.columns[0];
    for line in 1..=2 {
        walls.own_columns.insert([0, line - 1], Some(section));
        walls.walls.push(FrameWall {
            line,
            storeys: [1, 1],
            length: 2.0,
            hinges: Vec::new(),
            fibres: BTreeMap::new(),
            shear: Some(own_law),
            stiffness_factors: [1.0; 2],
        });
    }
    let damping = Damping::Rayleigh {
        alpha: 0.4,
        beta: 0.0,
    };
    let mut of_walls = alone(walls);
    of_walls.buildings[0].damping = damping.clone();
    let mut of_storey = of_walls.clone();
    of_storey.buildings[0].structure = Structure::Shear(Shear {
        mass: vec![4e4],
        stiffness: vec![8e7],
        storey_heights: vec![height],
    });
    let both = law(HysteresisRule::Bilinear, 8e7, 2e5, 0.03);
    of_storey.buildings[0].hinges = Some(jostle::Hinges::Storeys(vec![both]));
    of_storey.analysis.members = MemberRequest::default();
    let [a, b] = [of_walls, of_storey].map(|model| shaken(&model).1);
    let [a, b] = [a, b].map(|outcome| {
        let floor = outcome.peaks.floor(0, 1);
        let dissipated = outcome.energy.hysteretic;
        [
            floor.displacement_max().value,
            floor.storey_shear(),
            dissipated,
        ]
    });
    assert!(b[2] > 1e3, "they yield: {} J", b[2]);
    for (a, b) in a.into_iter().zip(b) {
        close(a, b, b, 1e-6, "displacement, shear, energy");
    }
}

/// Walls that keep their length have axial forces by equilibrium, those of beams at their faces included; those of very stiff walls
/// follow from their shortening.
#[test]
fn walls_bear_what_beams_bring_to_their_faces() {
    for yields in [false, true] {
        let rigid = coupled(3, yields);
        let mut stiff = rigid.clone();
        stiff.axial.columns_flexible = true;
        for column in stiff.column_sections_mut() {
            column.axial_rigidity = Some(1e14);
        }
        let [a, b] = [rigid, stiff].map(|frame| {
            let mut model = alone(frame);
            model.buildings[0].damping = Damping::Rayleigh {
                alpha: 0.4,
                beta: 0.0,
            };
            shaken(&model)
        });
        let axial = |(system, outcome): &(System, Outcome)| -> Vec<[f64; 2]> {
            let members = &system.buildings[0].members;
            let columns = members
                .members
                .iter()
                .filter(|member| member.place.is_column());
            let axial = columns.map(|column| outcome.members[0][column.sections[0].forms[0]]);
            axial
                .chain(
                    members
                        .walls
                        .iter()
                        .map(|wall| outcome.members[0][wall.axial]),
                )
                .collect()
        };
        let (a, b) = (axial(&a), axial(&b));
        let most = (a.iter().flatten()).fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(a.len() == 11 && most > 1e5, "{most}");
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            close(*a, *b, most, 2e-3, "axial force");
        }
    }
}

/// Both eliminations have the same answer, with walls that yield and beams that slide.
#[test]
fn both_eliminations_agree() {
    let [a, b] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        let model = alone(coupled(4, true));
        let system = assembled(&model);
        let plan = jostle::Plan {
            solver,
            ..steps(2e-3, 1)
        };
        run(&system, &fading("along", 9.0, [2.5, 3.0], 250), &plan)
    });
    assert!(b.energy.hysteretic > 1e3);
    for (a, b) in a.peaks.floors(0).iter().zip(b.peaks.floors(0)) {
        let most = b.displacement_max().value;
        close(a.displacement_max().value, most, most, 1e-9, "displacement");
    }
}

/// Moments at the feet of walls and columns and the moment of their axial forces are the overturning moment of the storey forces, if
/// nothing rises that has mass.
#[test]
fn moments_at_the_base_add_up_to_the_overturning_moment() {
    for (yields, beams_flexible) in [(false, false), (true, false), (true, true)] {
        let mut frame = coupled(4, yields);
        frame.axial = Axial {
            columns_flexible: false,
            beams_flexible,
        };
        frame.beam_mass = vec![0.0; 4];
        let mut model = alone(frame);
        model.buildings[0].damping = Damping::Rayleigh {
            alpha: 0.3,
            beta: 0.0,
        };
        let (system, outcome) = shaken(&model);
        let coupling = system.buildings[0].members.coupling.expect("coupled walls");
        let [most, least] = outcome.members[0][coupling.total];
        let overturning = outcome.peaks.floor(0, 1).overturning_moment();
        close(
            most.max(-least),
            overturning,
            overturning,
            1e-8,
            "moment at the base",
        );
    }
}

/// Self weight is no part of the degree of coupling, and walls bear it beside what shaking adds.
#[test]
fn weight_does_not_couple_walls() {
    let [light, heavy] = [false, true].map(|preload| {
        let mut frame = coupled(4, false);
        frame.axial.columns_flexible = true;
        let mut model = alone(frame);
        model.analysis.solver = Some(Solver::Riccati);
        model.analysis.step = Some(1e-3);
        model.buildings[0].gravity = Gravity {
            preload,
            p_delta: false,
        };
        let motion = fading("along", 9.0, [2.5, 3.0], 500);
        runs::run_and_summary(&model, &motion).2
    });
    let degree = |summary: &Summary| {
        summary.buildings[0]
            .degree_of_coupling
            .expect("coupled walls")
    };
    close(degree(&heavy), degree(&light), 1.0, 1e-8, "coupling");
    let wall = |summary: &Summary| summary.buildings[0].parts[0].clone();
    let (light, heavy) = (wall(&light), wall(&heavy));
    let weight = light.force_max_n - heavy.force_max_n;
    assert!(
        weight > 1e5 && heavy.force_max_n > 0.0,
        "{weight} {heavy:?}"
    );
    close(
        light.force_min_n - heavy.force_min_n,
        weight,
        weight,
        1e-8,
        "weight of a wall",
    );
}

/// On very stiff soil walls stand as on fixed ground.
#[test]
fn walls_stand_on_a_foundation() {
    for yields in [false, true] {
        let fixed = alone(coupled(3, yields));
        let mut on_soil = fixed.clone();
        on_soil.buildings[0].base = Base {
            foundation: Some(Foundation::rectangle(14.0, 9.0, 90e3)),
            ..Base::default()
        };
        on_soil.soil = Some(Soil {
            half_space: Some(HalfSpace {
                shear_wave_velocity: 2e4,
                density: 1900.0,
                poisson_ratio: 0.35,
                damping: 0.0,
            }),
            coupling: SoilCoupling::None,
        });
        let [a, b] = [on_soil, fixed].map(|model| shaken(&model).1);
        for (a, b) in a.peaks.floors(0).iter().zip(b.peaks.floors(0)) {
            let most = b.displacement_max().value;
            close(a.displacement_max().value, most, most, 2e-3, "displacement");
            close(
                a.storey_shear(),
                b.storey_shear(),
                b.storey_shear(),
                5e-3,
                "shear",
            );
        }
    }
}

/// Two frames with walls side by side in a plan, shaken along their lines, move as one of them with half the mass of the floors.
#[test]
fn frames_in_a_plan_have_the_same_walls() {
    for yields in [false, true] {
        let mut frame = coupled(3, yields);
        for column in frame.column_sections_mut() {
            column.line_mass = 0.0;
        }
        frame.beam_mass = vec![0.0; 3];
        frame.floor_mass = vec![0.0; 3];
        frame.column_segments = 1;
        frame.beam_segments = vec![1; 2];
        let standing = |name: &str, y: f64| PlanFrame {
            name: name.to_owned(),
            at: [0.0, y],
            direction: [1.0, 0.0],
            lines: Vec::new(),
            base: Base::default(),
            hinges: FrameHinges::default(),
            frame: frame.clone(),
        };
        let across = PlanFrame {
            at: [4.5, 0.0],
            direction: [0.0, 1.0],
            frame: Frame {
                walls: Vec::new(),
                coupling_beams: Vec::new(),
                own_columns: Default::default(),
                spans: vec![8.0],
                beam_segments: vec![1],
                ..frame.clone()
            },
            ..standing("across", 0.0)
        };
        let tier = Tier::uniform(60e3, rectangle(0.0, 0.0, 9.0, 8.0)).expect("an area");
        let tiers = Tiers {
            floors: vec![tier; 3],
            storey_heights: frame.storey_heights.clone(),
            frames: vec![standing("front", 0.0), standing("back", 8.0), across],
            ..Tiers::default()
        };
        let mut plane = frame.clone();
        plane.floor_mass = vec![30e3; 3];
        let motion = fading("along", 9.0, [2.5, 3.0], 500);
        let [space, plane] = [Structure::Tiers(tiers), Structure::Frame(plane)].map(|structure| {
            let mut model = alone(Frame::default());
            model.buildings[0].structure = structure;
            model.analysis.solver = Some(Solver::Riccati);
            model.analysis.step = Some(1e-3);
            runs::run_and_summary(&model, &motion).2
        });
        let [a, b] = [&space, &plane].map(|summary| &summary.buildings[0]);
        for (a, b) in a.floors.above.iter().zip(&b.floors.above) {
            let most = b.response.displacement_max_m;
            close(
                a.response.displacement_max_m,
                most,
                most,
                1e-6,
                "displacement",
            );
        }
        // Parts of each frame are those of the plane one.
        assert_eq!(a.parts.len(), 2 * b.parts.len());
        assert_eq!(a.parts[0].name, "A.front.wall.1");
        for (a, b) in a.parts.iter().zip(b.parts.iter().take(2)) {
            let scale = b.moment_max_n_m;
            close(
                a.moment_max_n_m.expect("a wall"),
                scale.expect("a wall"),
                scale.expect("a wall"),
                1e-5,
                "moment",
            );
        }
    }
}

/// Cut through any storey, walls and columns carry the weight above; no mass is lost between faces and axes.
#[test]
fn walls_carry_all_that_lies_above_them() {
    for columns_flexible in [false, true] {
        let mut frame = coupled(3, false);
        frame.axial.columns_flexible = columns_flexible;
        let system = assembled(&alone(frame.clone()));
        let building = &system.buildings[0].structure;
        let carried = compressions(building, STANDARD_GRAVITY).expect("it stands");
        let sticks = &building.discretization.stick_model;
        for cut in [1.0, 4.0, 7.0] {
            let through = sticks.members.iter().zip(&carried);
            let through = through.filter(|(member, _)| {
                let [a, b] = member.ends.map(|end| sticks.nodes[end].y);
                a.min(b) < cut && a.max(b) > cut
            });
            let sum: f64 = through.map(|(_, force)| force).sum();
            let above = sticks.nodes.iter().filter(|node| node.y > cut);
            let above: f64 = above.map(|node| STANDARD_GRAVITY * node.mass()).sum();
            close(sum, above, above, 1e-9, "weight above");
        }
        let beams = 4000.0 * 9.0 + 3e4;
        // Half of the lowest storey stands on the ground.
        let walls = 2500.0 * 0.2 * 5.0 * (9.0 - 0.25 * 3.0);
        let expected = 3.0 * beams + walls;
        close(
            building.equations.total_mass(),
            expected,
            expected,
            1e-12,
            "mass",
        );
    }
}

/// A building that turns with its foundation as a rigid body is not strained: faces of walls follow their axes, which follow the
/// foundation.
#[test]
fn turning_with_a_foundation_strains_no_beam() {
    let mut model = alone(coupled(3, false));
    model.buildings[0].base.foundation = Some(Foundation::rectangle(14.0, 9.0, 90e3));
    model.soil = Some(Soil {
        half_space: Some(HalfSpace {
            shear_wave_velocity: 200.0,
            density: 1900.0,
            poisson_ratio: 0.35,
            damping: 0.0,
        }),
        coupling: SoilCoupling::None,
    });
    let system = assembled(&model);
    let building = &system.buildings[0].structure;
    let (equations, sticks) = (&building.equations, &building.discretization.stick_model);
    let middle = 4.5;
    let mut turned = vec![0.0; equations.len()];
    for (index, node) in sticks.nodes.iter().enumerate() {
        for (dof, moved) in [
            (equations.horizontal(index), -node.y),
            (equations.vertical(index), node.x - middle),
            (equations.rotation(index), 1.0),
        ] {
            if let Some(dof) = dof {
                turned[dof] = moved;
            }
        }
    }
    let strained = equations.stiffness.quadratic_form(&turned);
    // If the floors alone stay level.
    let roof = system.buildings[0].floors[2].dof;
    turned[roof] += 1.0;
    let most = equations.stiffness.quadratic_form(&turned);
    assert!(most > 1e6);
    close(strained, 0.0, most, 1e-9, "strain energy");
}

/// A wall that yields at the ends of its storeys is a wide column of the frame with hinges there: what beams and floors bring to it stays.
#[test]
fn walls_yield_above_their_feet_as_wide_columns() {
    let storeys = 4;
    let [weak, strong] = [0.4, 0.9].map(|share| {
        let moment = share * 1.0e6;
        law(HysteresisRule::Bilinear, 4e10, moment, 0.03)
    });
    let with_factors = coupled(storeys, false);
    // Without arms: a wall of no length is a column.
    let mut thin = with_factors.clone();
    thin.coupling_beams.clear();
    for wall in &mut thin.walls {
        wall.length = 1e-9;
    }
    let mut columns = thin.clone();
    let walls = std::mem::take(&mut columns.walls);
    let hinges = |line: usize| if line == 1 { strong } else { weak };
    for wall in &mut thin.walls {
        let ends = (1..=storeys).flat_map(|storey| [(storey, false), (storey, true)]);
        wall.hinges = ends
            .map(|(storey, at_head)| WallHinge {
                storey,
                at_head,
                hysteresis: hinges(wall.line),
            })
            .collect();
    }
    let elastic = law(HysteresisRule::Bilinear, 1e16, 1e20, 1.0);
    let of_columns = (0..storeys).map(|_| {
        let lines = (1..=3).map(|line| match walls.iter().any(|wall| wall.line == line) {
            true => hinges(line),
            false => elastic,
        });
        lines.collect()
    });
    let hinged = FrameHinges {
        columns: of_columns.collect(),
        ..FrameHinges::default()
    };
    let mut of_walls = alone(thin);
    let mut of_columns = alone(columns);
    of_columns.buildings[0].hinges = Some(jostle::Hinges::Frame(hinged));
    for model in [&mut of_walls, &mut of_columns] {
        model.analysis.members = MemberRequest::default();
        model.buildings[0].damping = Damping::Rayleigh {
            alpha: 0.4,
            beta: 0.0,
        };
    }
    let [a, b] = [of_walls, of_columns].map(|model| shaken(&model).1);
    assert!(b.energy.hysteretic > 1e3, "{}", b.energy.hysteretic);
    close(
        a.energy.hysteretic,
        b.energy.hysteretic,
        b.energy.hysteretic,
        1e-6,
        "energy",
    );
    for (a, b) in a.peaks.floors(0).iter().zip(b.peaks.floors(0)) {
        let most = b.displacement_max().value;
        close(a.displacement_max().value, most, most, 1e-6, "displacement");
    }
}
