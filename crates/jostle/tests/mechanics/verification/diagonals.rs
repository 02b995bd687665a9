//! Braces and struts of frames: closed forms, equilibrium, and the same frame by another way.

use jostle::history::{Column, Kind, Owner};
use jostle::hysteresis::{
    Backbone, BucklingBrace, Corners, Hysteresis, HysteresisMemory, HysteresisRule, Pinching, Side,
    Stage,
};
use jostle::linear::StepMatrix;
use jostle::statics::{STANDARD_GRAVITY, compressions, settle};
use jostle::structure::{SpringPlace, solve_once};
use jostle::{
    Base, Building, Damping, Diagonal, DiagonalKind, DiagonalPlace, Foundation, Frame, FrameHinges,
    HalfSpace, Isolation, Isolator, MemberRequest, Model, Outcome, PanelAcross, PlanFrame, Reach,
    RiccatiSweep, Rise, Section, Soil, SoilCoupling, Solver, Structure, StrutLine, System, Tier,
    Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::models::{concrete, rectangle};
use jostle_testkit::motions::fading;
use jostle_testkit::runs;

use crate::verification::support::{assembled, column, frame, framed, run, steps};

fn diagonal(kind: DiagonalKind, storey: usize, bay: usize, rise: Rise) -> Diagonal {
    let place = DiagonalPlace {
        kind,
        line: None,
        storey,
        bay,
        rise,
        reach: Reach::BAY,
        strut: StrutLine::Central,
    };
    let stiffness = 4e7;
    let hysteresis = match kind {
        DiagonalKind::Brace => {
            let corners = Corners::bilinear(60e3, 0.03);
            let backbone = Backbone::from_forces(stiffness, corners, corners).expect("sound");
            Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
        }
        DiagonalKind::Infill => Hysteresis::without_tension(stiffness).expect("sound"),
    };
    Diagonal {
        place,
        stiffness,
        hysteresis: Some(hysteresis),
        offsets: [0.0; 2],
        across: None,
        damage: None,
    }
}

/// Three storeys and two bays: braces in one, a panel in the other of the upper storeys.
fn braced(elastic: bool) -> Frame {
    let mut frame = frame(3, &[6.0, 4.5]);
    for storey in 1..=3 {
        let rise = [Rise::Right, Rise::Left][storey % 2];
        frame
            .diagonals
            .push(diagonal(DiagonalKind::Brace, storey, 1, rise));
        if storey > 1 && !elastic {
            let panel = Rise::BOTH.map(|rise| diagonal(DiagonalKind::Infill, storey, 2, rise));
            frame.diagonals.extend(panel);
        }
    }
    if elastic {
        for diagonal in &mut frame.diagonals {
            diagonal.hysteresis = None;
        }
    }
    frame
}

fn alone(building: Building) -> Model {
    let mut model = Model {
        title: "diagonals".to_owned(),
        buildings: vec![building],
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

/// Where floors and columns keep their length, a brace adds k cos²α to its storey.
#[test]
fn a_brace_adds_k_cos_squared_to_a_storey() {
    let stiffness = |frame: Frame| {
        let system = assembled(&alone(framed("A", frame)));
        let building = &system.buildings[0];
        let mut load = vec![0.0; building.equations.len()];
        load[building.floors[0].dof] = 1.0;
        let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load)
            .expect("it stands");
        1.0 / moved[building.floors[0].dof]
    };
    let bare = frame(1, &[6.0]);
    let (height, span) = (bare.storey_heights[0], 6.0);
    for rise in Rise::BOTH {
        let mut braced = bare.clone();
        braced.diagonals = vec![Diagonal {
            hysteresis: None,
            ..diagonal(DiagonalKind::Brace, 1, 1, rise)
        }];
        let added = stiffness(braced) - stiffness(bare.clone());
        let cosine = span / f64::hypot(span, height);
        close(added, 4e7 * cosine * cosine, added, 1e-10, "k cos²α");
    }
}

/// One floor, whose storey is a frame and a brace that buckles: central differences in steps of 5 µs, with the same law and nothing else in
/// common. The brace buckles, is straightened and yields.
#[test]
fn a_braced_storey_that_buckles_moves_like_one_mass() {
    let bare = Frame {
        column_segments: 1,
        beam_segments: vec![1],
        beam_mass: vec![0.0],
        floor_mass: vec![60e3],
        columns: vec![Section {
            line_mass: 0.0,
            ..concrete(0.4, 0.4)
        }],
        ..frame(1, &[6.0])
    };
    let law = Hysteresis::buckling(BucklingBrace {
        stiffness: 1.2e8,
        yield_force: 5e5,
        post_yield: 0.01,
        buckling_force: 2.4e5,
        later: 0.65,
        slenderness: 1.2,
        shortening: 2e-3,
    })
    .expect("sound");
    let cosine = 6.0 / f64::hypot(bare.storey_heights[0], 6.0);
    let mut braced = bare.clone();
    braced.diagonals = vec![Diagonal {
        stiffness: 1.2e8,
        hysteresis: Some(law),
        ..diagonal(DiagonalKind::Brace, 1, 1, Rise::Right)
    }];
    let undamped = |frame: Frame| {
        let mut model = alone(framed("A", frame));
        model.buildings[0].damping = Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.0,
        };
        model
    };
    let system = assembled(&undamped(bare));
    let building = &system.buildings[0];
    let mut load = vec![0.0; building.equations.len()];
    load[building.floors[0].dof] = 1.0;
    let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load);
    let stiffness = 1.0 / moved.expect("it stands")[building.floors[0].dof];
    let mass = building.equations.total_mass();
    let motion = fading("along", 9.0, [2.6, 3.0], 500);
    let (step, mut memory) = (5e-6, HysteresisMemory::default());
    let (mut before, mut now, mut peaks, mut first) = (0.0, 0.0, [0.0_f64; 2], None);
    let (mut forces, mut work) = ([0.0_f64; 2], 0.0);
    for index in 0..2_000_000_u32 {
        let time = step * f64::from(index);
        let response = law.respond(&memory, cosine * now);
        memory = response.memory;
        work += response.work;
        if law.has_buckled(&memory) {
            first = first.or(Some(time));
        }
        forces = [forces[0].max(response.force), forces[1].min(response.force)];
        peaks = [peaks[0].max(now), peaks[1].min(now)];
        let pushes = stiffness * now + cosine * response.force;
        let next = 2.0 * now - before - step * step * (pushes / mass + motion.acceleration(time));
        (before, now) = (now, next);
    }
    let mut model = undamped(braced);
    model.analysis.step = Some(5e-5);
    let (_, outcome, summary) = runs::run_and_summary(&model, &motion);
    assert!(outcome.energy.worst_imbalance < 1e-6);
    let (floor, part) = (
        &summary.buildings[0].floors[0],
        &summary.buildings[0].parts[0],
    );
    assert!(
        forces[0] > 5e5 && peaks[1] * cosine < -0.01,
        "it does little"
    );
    close(
        floor.response.displacement_max_m,
        peaks[0],
        peaks[0],
        1e-6,
        "right",
    );
    close(
        floor.response.displacement_min_m,
        peaks[1],
        -peaks[1],
        1e-6,
        "left",
    );
    // At the corner of buckling the greatest compression is that of the nearest step.
    close(part.force_max_n, forces[0], forces[0], 1e-4, "tension");
    close(part.force_min_n, forces[1], -forces[1], 1e-4, "compression");
    close(
        part.deformation_min,
        -cosine * peaks[1],
        0.01,
        1e-6,
        "shortening",
    );
    let dissipated = work - law.recoverable_energy(&memory);
    close(part.dissipated_j, dissipated, work, 1e-4, "energy");
    let first = first.expect("it buckles");
    assert!((part.buckled_s.expect("it buckles") - first).abs() < 1e-4);
}

/// Columns that keep their length have axial forces by equilibrium, braces and struts included; those of very stiff columns follow
/// from their shortening.
#[test]
fn columns_bear_what_braces_pull_and_push() {
    for elastic in [true, false] {
        let rigid = braced(elastic);
        let mut stiff = rigid.clone();
        stiff.axial.columns_flexible = true;
        for column in &mut stiff.columns {
            column.axial_rigidity = Some(1e14);
        }
        let [a, b] = [rigid, stiff].map(|frame| {
            let mut building = framed("A", frame);
            building.damping = Damping::Rayleigh {
                alpha: 0.4,
                beta: 0.0,
            };
            shaken(&alone(building))
        });
        let members = |(system, outcome): &(System, Outcome)| -> Vec<[f64; 2]> {
            let members = &system.buildings[0].members;
            let columns = members
                .members
                .iter()
                .filter(|member| member.place.is_column());
            let axial = columns.map(|column| outcome.members[0][column.sections[0].forms[0]]);
            let diagonals = members.diagonals.iter();
            axial
                .chain(diagonals.map(|diagonal| outcome.members[0][diagonal.form]))
                .collect()
        };
        let (a, b) = (members(&a), members(&b));
        let most = a
            .iter()
            .flatten()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(a.len() >= 12 && most > 1e5, "{most}");
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            close(*a, *b, most, 2e-3, "axial force");
        }
    }
}

/// The base shear, from what reaches the ground, a mat or a foundation, is the shear of the lowest storey, from the forces on the nodes
/// above.
#[test]
fn base_shear_is_that_of_the_lowest_storey() {
    let isolation = Isolation::new(Isolator::Linear { stiffness: 2e7 }, 3e4);
    let foundation = Foundation {
        embedment: 1.5,
        ..Foundation::rectangle(14.0, 9.0, 90e3)
    };
    let bases = [
        Base::default(),
        Base {
            isolation: Some(isolation),
            ..Base::default()
        },
        Base {
            foundation: Some(foundation),
            ..Base::default()
        },
    ];
    for elastic in [true, false] {
        for base in bases {
            let mut building = framed("A", braced(elastic));
            building.base = base;
            let mut model = alone(building);
            model.soil = base.foundation.map(|_| Soil {
                half_space: Some(HalfSpace {
                    shear_wave_velocity: 180.0,
                    density: 1900.0,
                    poisson_ratio: 0.35,
                    damping: 0.03,
                }),
                coupling: SoilCoupling::None,
            });
            let (_, outcome) = shaken(&model);
            let (base, storey) = (
                outcome.peaks.base_shear(0),
                outcome.peaks.floor(0, 1).storey_shear(),
            );
            // Below a mat there is its inertia as well.
            if model.buildings[0].base.isolation.is_none() {
                close(base, storey, storey, 1e-9, "base shear");
            }
            assert!(storey > 1e4);
        }
    }
}

/// Two frames side by side in a plan, shaken along their lines, move as one of them with half the mass of the floors.
#[test]
fn frames_in_a_plan_have_the_same_diagonals() {
    for elastic in [true, false] {
        let mut frame = braced(elastic);
        frame
            .columns
            .iter_mut()
            .for_each(|column| column.line_mass = 0.0);
        frame
            .beam_mass
            .iter_mut()
            .for_each(|beam_mass| *beam_mass = 0.0);
        frame.column_segments = 1;
        frame
            .beam_segments
            .iter_mut()
            .for_each(|beam_segment| *beam_segment = 1);
        let standing = |name: &str, y: f64| PlanFrame {
            name: name.to_owned(),
            at: [0.0, y],
            direction: [1.0, 0.0],
            lines: Vec::new(),
            base: Base::default(),
            hinges: FrameHinges::default(),
            frame: frame.clone(),
        };
        let tier = Tier::uniform(60e3, rectangle(0.0, 0.0, 10.5, 8.0)).expect("an area");
        let across = PlanFrame {
            at: [5.25, 0.0],
            direction: [0.0, 1.0],
            ..standing("across", 0.0)
        };
        let across = PlanFrame {
            frame: Frame {
                diagonals: Vec::new(),
                spans: vec![8.0],
                beam_segments: vec![1],
                ..frame.clone()
            },
            ..across
        };
        let tiers = Tiers {
            floors: vec![tier; 3],
            storey_heights: frame.storey_heights.clone(),
            frames: vec![standing("front", 0.0), standing("back", 8.0), across],
            ..Tiers::default()
        };
        let mut plane = frame.clone();
        plane.floor_mass = vec![30e3; 3];
        let [space, plane] = [Structure::Tiers(tiers), Structure::Frame(plane)].map(|structure| {
            let mut model = alone(Building {
                name: "A".to_owned(),
                structure,
                damping: Damping::Rayleigh {
                    alpha: 0.4,
                    beta: 1e-4,
                },
                ..Building::default()
            });
            model.analysis.solver = Some(Solver::Riccati);
            shaken(&model).1
        });
        for (a, b) in space.peaks.floors(0).iter().zip(plane.peaks.floors(0)) {
            let most = b.displacement_max().value;
            close(a.displacement_max().value, most, most, 1e-6, "displacement");
            close(
                a.storey_shear(),
                2.0 * b.storey_shear(),
                a.storey_shear(),
                1e-6,
                "shear",
            );
        }
        close(
            space.peaks.base_shear(0),
            2.0 * plane.peaks.base_shear(0),
            space.peaks.base_shear(0),
            1e-6,
            "base",
        );
    }
}

/// Cut through any storey, columns, braces and struts carry the weight above.
#[test]
fn columns_and_diagonals_carry_all_that_lies_above_them() {
    for elastic in [true, false] {
        let mut frame = braced(elastic);
        frame.axial.columns_flexible = true;
        frame.columns = vec![
            Section {
                axial_rigidity: Some(8e9),
                ..concrete(0.5, 0.5)
            };
            3
        ];
        let system = assembled(&alone(framed("A", frame.clone())));
        let building = &system.buildings[0].structure;
        let carried = compressions(building, STANDARD_GRAVITY).expect("it stands");
        let rest = settle(building, STANDARD_GRAVITY).expect("it stands");
        let sticks = &building.discretization.stick_model;
        let mut in_braces = 0.0_f64;
        for (storey, cut) in [1.0, 4.2, 7.4].into_iter().enumerate() {
            let columns = sticks.members.iter().zip(&carried);
            let columns = columns.filter(|(member, _)| {
                let [a, b] = member.ends.map(|end| sticks.nodes[end].y);
                a.min(b) < cut && a.max(b) > cut
            });
            let mut sum: f64 = columns.map(|(_, force)| force).sum();
            for diagonal in &system.buildings[0].members.diagonals {
                let part = &building.discretization.diagonals[diagonal.diagonal];
                if part.place.storey != storey + 1 {
                    continue;
                }
                let mut force = 0.0;
                system.buildings[0].member_forces(
                    &jostle::State {
                        displacement: rest.displacement.clone(),
                        springs: rest.springs.clone(),
                        ..jostle::State::at_rest(&system, 0.0)
                    },
                    &[],
                    0.0,
                    |form, value| {
                        if form == diagonal.form {
                            force = value;
                        }
                    },
                );
                let width = if part.place.bay == 1 { 6.0 } else { 4.5 };
                let height = 3.2;
                sum -= force * height / f64::hypot(width, height);
                in_braces = in_braces.max(force.abs());
            }
            let above = sticks.nodes.iter().filter(|node| node.y > cut);
            let above: f64 = above.map(|node| STANDARD_GRAVITY * node.mass()).sum();
            close(sum, above, above, 1e-9, "weight above");
        }
        assert!(in_braces > 1e3, "braces carry something: {in_braces}");
    }
}

/// Panels that crack, crush and lose their force: both ways to solve for a step agree, energies balance, and struts only push.
#[test]
fn cracking_panels_push_alone() {
    let mut frame = braced(false);
    for strut in &mut frame.diagonals {
        if strut.place.kind == DiagonalKind::Infill {
            let corners = Corners {
                cracking: 40e3,
                yielding: 70e3,
                post_cracking: 0.15,
                post_yield: 0.0,
            };
            let backbone = Backbone::falling(strut.stiffness, corners, corners, -0.04, 0.3);
            let rule = HysteresisRule::Pinched(Pinching::USUAL);
            let both = Hysteresis::new(rule, backbone.expect("sound")).expect("it fits");
            strut.hysteresis = Some(both.in_compression().expect("pinched"));
        }
    }
    let mut model = alone(framed("F", frame));
    model.analysis.tolerance = 1e-4;
    let motion = fading("along", 9.0, [2.5, 3.0], 300);
    let [riccati, stiffness] = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        model.analysis.solver = Some(solver);
        let (system, outcome) = runs::run(&model, &motion, None);
        assert!(outcome.energy.worst_imbalance < 1e-8);
        (system, outcome)
    });
    for (a, b) in riccati
        .1
        .peaks
        .floors(0)
        .iter()
        .zip(&stiffness.1.peaks.floors(0))
    {
        let [a, b] = [a, b].map(|floor| floor.displacement_max().value);
        close(a, b, b, 1e-6, "displacement");
    }
    let places = &riccati.0.buildings[0].discretization.spring_places;
    let springs = &riccati.1.state.springs;
    let mut cracked = 0;
    for (place, memory) in places.iter().zip(springs) {
        if let SpringPlace::Diagonal { place, .. } = place
            && place.kind == DiagonalKind::Infill
        {
            assert!(memory.force() <= 0.0);
            let corner = 40e3 / 4e7;
            cracked += usize::from(memory.greatest(Side::Negative) > corner);
        }
    }
    assert!(cracked >= 2, "{cracked} struts cracked");
}

/// The ratio of a panel is its mass times the greatest acceleration of the histories of its floors, over its strength; it changes no motion,
/// and a panel that bears too little is a warning.
#[test]
fn panels_are_compared_with_the_accelerations_of_their_floors() {
    let motion = fading("along", 9.0, [2.5, 3.0], 500);
    let model = |strength: Option<f64>| {
        let mut frame = braced(false);
        for part in &mut frame.diagonals {
            part.across = strength.map(|strength| PanelAcross {
                strength,
                surface_mass: 280.0,
                falls: false,
            });
        }
        alone(framed("A", frame))
    };
    let (_, bare, _) = runs::run_and_summary(&model(None), &motion);
    let (_, outcome, summary) = runs::run_and_summary(&model(Some(1e4)), &motion);
    assert_eq!(bare.state, outcome.state);
    let most = |floor: usize| {
        let of = Column::along(Owner::Floor { building: 0, floor }, Kind::Acceleration);
        let history = column(&outcome, of);
        history
            .iter()
            .fold(0.0_f64, |most, history| most.max(history.abs()))
    };
    let floors = [motion.peak(), most(1), most(2), most(3)];
    let panels = summary.buildings[0]
        .parts
        .iter()
        .filter(|part| part.kind == "infill");
    let mut count = 0;
    for panel in panels {
        let storey: usize = panel
            .name
            .split('.')
            .nth(2)
            .expect("a storey")
            .parse()
            .expect("a number");
        let due = 280.0 * floors[storey - 1].max(floors[storey]) / 1e4;
        close(
            panel.out_of_plane_ratio.expect("it is compared"),
            due,
            due,
            5e-3,
            &panel.name,
        );
        count += 1;
    }
    assert_eq!(count, 4);
    let said = |summary: &jostle::Summary| {
        summary
            .warnings
            .iter()
            .any(|warning| warning.contains("fail out of plane"))
    };
    assert!(!said(&summary), "{:?}", summary.warnings);
    let (_, _, weak) = runs::run_and_summary(&model(Some(100.0)), &motion);
    assert!(said(&weak));
}

/// An elastic brace from the foot of the first line to floor 2 of the third, across two bays.
fn across_two_storeys(stiffness: f64) -> Diagonal {
    let mut brace = diagonal(DiagonalKind::Brace, 1, 1, Rise::Right);
    brace.place.reach = Reach {
        storeys: 2,
        bays: 2,
        across: 0,
    };
    brace.stiffness = stiffness;
    brace.hysteresis = None;
    brace
}

/// How floors sway under unit forces at floors: by jostle.
fn flexibility(frame: &Frame) -> [[f64; 2]; 2] {
    let system = assembled(&alone(framed("A", frame.clone())));
    let building = &system.buildings[0];
    [0, 1].map(|loaded| {
        let mut load = vec![0.0; building.equations.len()];
        load[building.floors[loaded].dof] = 1.0;
        let moved = solve_once::<RiccatiSweep>(&building.structure, &StepMatrix::STATIC, &load);
        let moved = moved.expect("it stands");
        [0, 1].map(|floor: usize| moved[building.floors[floor].dof])
    })
}

/// The same by the stiffness of members in the plane, assembled and eliminated here: floors 1 and 2 of three lines, whose joints move
/// sideways together, rise and turn.
fn by_hand(frame: &Frame, brace: f64) -> [[f64; 2]; 2] {
    const SIZE: usize = 14;
    let xs = [0.0, frame.spans[0], frame.spans[0] + frame.spans[1]];
    let ys = [
        0.0,
        frame.storey_heights[0],
        frame.storey_heights[0] + frame.storey_heights[1],
    ];
    let place = |[floor, line]: [usize; 2]| -> [Option<usize>; 3] {
        let Some(above) = floor.checked_sub(1) else {
            return [None; 3];
        };
        let own = 2 + 2 * (3 * above + line);
        [Some(above), Some(own), Some(own + 1)]
    };
    let mut matrix = vec![vec![0.0; SIZE]; SIZE];
    let mut add = |stiffness: f64, row: &[(Option<usize>, f64)]| {
        for (a, share) in row {
            for (b, other) in row {
                if let (Some(a), Some(b)) = (a, b) {
                    matrix[*a][*b] += stiffness * share * other;
                }
            }
        }
    };
    let mut member = |from: [usize; 2], to: [usize; 2], ea: f64, ei: f64| {
        let (dx, dy) = (xs[to[1]] - xs[from[1]], ys[to[0]] - ys[from[0]]);
        let length = dx.hypot(dy);
        let (c, s) = (dx / length, dy / length);
        let ([u, v, turn], [u2, v2, turn2]) = (place(from), place(to));
        add(ea / length, &[(u2, c), (v2, s), (u, -c), (v, -s)]);
        // Rotations of both ends from the chord: 4EI/L each and 2EI/L together, as their sum and their difference.
        let chord = |sign: f64, share: f64| -> Vec<(Option<usize>, f64)> {
            let both = share * (1.0 + sign) / length;
            vec![
                (turn, share),
                (turn2, share * sign),
                (u2, s * both),
                (u, -s * both),
                (v2, -c * both),
                (v, c * both),
            ]
        };
        let half = 0.5_f64.sqrt();
        add(6.0 * ei / length, &chord(1.0, half));
        add(2.0 * ei / length, &chord(-1.0, half));
    };
    for storey in 0..2 {
        for line in 0..3 {
            let column = frame.column(storey, line).expect("a column");
            let ea = column.axial_rigidity.expect("it shortens");
            member(
                [storey, line],
                [storey + 1, line],
                ea,
                column.flexural_rigidity,
            );
        }
        for bay in 0..2 {
            let beam = frame.beam(storey, bay).expect("a beam");
            member(
                [storey + 1, bay],
                [storey + 1, bay + 1],
                0.0,
                beam.flexural_rigidity,
            );
        }
    }
    member([0, 0], [2, 2], brace * (xs[2]).hypot(ys[2]), 0.0);
    let solve = |loaded: usize| {
        let mut rows = matrix.clone();
        let mut right = [0.0; SIZE];
        right[loaded] = 1.0;
        for pivot in 0..SIZE {
            for below in pivot + 1..SIZE {
                let share = rows[below][pivot] / rows[pivot][pivot];
                for column in pivot..SIZE {
                    rows[below][column] -= share * rows[pivot][column];
                }
                right[below] -= share * right[pivot];
            }
        }
        for pivot in (0..SIZE).rev() {
            let known: f64 = (pivot + 1..SIZE)
                .map(|column| rows[pivot][column] * right[column])
                .sum();
            right[pivot] = (right[pivot] - known) / rows[pivot][pivot];
        }
        [right[0], right[1]]
    };
    [solve(0), solve(1)]
}

/// A brace over two storeys and two bays, against the stiffness method written anew.
#[test]
fn a_brace_over_two_storeys_is_one_more_member() {
    let mut frame = frame(2, &[6.0, 4.5]);
    frame.axial.columns_flexible = true;
    let plain = by_hand(&frame, 0.0);
    for (got, due) in flexibility(&frame).concat().into_iter().zip(plain.concat()) {
        close(got, due, due, 1e-9, "without brace");
    }
    frame.diagonals.push(across_two_storeys(5e7));
    let braced = by_hand(&frame, 5e7);
    for (got, due) in flexibility(&frame)
        .concat()
        .into_iter()
        .zip(braced.concat())
    {
        close(got, due, due, 1e-9, "with brace");
    }
    assert!(braced[1][1] < 0.7 * plain[1][1], "{braced:?}");
    // Neither floor 1 nor the middle line is held: the brace passes them.
    assert!(braced[0][0] > 0.1 * plain[0][0]);
}

/// Columns that resist nothing: the roof stands on the brace as on a truss, F = k cos² α u.
#[test]
fn a_brace_past_a_floor_holds_the_roof_alone() {
    let mut frame = frame(2, &[6.0, 4.5]);
    for section in frame.columns.iter_mut().chain(&mut frame.beams) {
        section.flexural_rigidity = 1.0;
    }
    let stiffness = 5e7;
    frame.diagonals.push(across_two_storeys(stiffness));
    let rise: f64 = frame.storey_heights.iter().sum();
    let cosine = 10.5 / 10.5_f64.hypot(rise);
    let due = 1.0 / (stiffness * cosine * cosine);
    close(flexibility(&frame)[1][1], due, due, 1e-6, "roof");
}

/// It yields as any other, by both solvers, and is named by its joints.
#[test]
fn a_brace_over_two_storeys_yields() {
    let answers = [Solver::Riccati, Solver::Stiffness].map(|solver| {
        let mut frame = frame(2, &[6.0, 4.5]);
        frame.axial.columns_flexible = true;
        let mut brace = diagonal(DiagonalKind::Brace, 1, 1, Rise::Right);
        brace.place.reach = Reach {
            storeys: 2,
            bays: 2,
            across: 0,
        };
        frame.diagonals.push(brace);
        let mut model = alone(framed("A", frame));
        model.analysis.solver = Some(solver);
        let (system, outcome) = shaken(&model);
        let place = system.buildings[0].discretization.spring_places[0];
        assert_eq!(
            place.to_string(),
            "brace, floor 0, line 1 to floor 2, line 3"
        );
        let law = system.buildings[0].equations.springs[0].hysteresis;
        assert_eq!(law.stage(&outcome.state.springs[0]), Stage::Yielded);
        let floors = outcome.peaks.floors(0);
        let moved = floors.iter().map(|floor| floor.displacement_max().value);
        moved.collect::<Vec<f64>>()
    });
    for (a, b) in answers[0].iter().zip(&answers[1]) {
        close(*a, *b, *b, 1e-6, "floors");
    }
}
