//! Space frames with hinges: plane frames and storeys as their limits, turned sites, the elastic limit, equilibrium, energy.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::verification::support::spring_forces;
use jostle::history::PeaksOf;
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::structure::MemberPlace;
use jostle::{
    Analysis, Axial, Base, Bearing, Building, ContactLaw, Damping, Frame, FrameHinges, Gap,
    GroundMotion, Hinges, LawKind, MemberRequest, Model, Outcome, Plan, PlanAxis, PlanFrame,
    PlanPoint, PlanSpring, RestitutionIs, Section, Shear, Solver, SpaceFrame, SpaceMember,
    SpacePlace, SpaceSection, Structure, System, Tier, TierStorey, Tiers,
};
use jostle_testkit::compare::close;
use jostle_testkit::motions::fading;
use jostle_testkit::runs::{self, run};

const E: f64 = 30e9;

/// Initial stiffness of hinges in units of EI/L.
const INITIAL: f64 = 100.0;

fn hinge(rule: HysteresisRule, initial: f64, yielding: f64) -> Hysteresis {
    let corners = match rule {
        HysteresisRule::Bilinear => Corners::bilinear(yielding, 0.02),
        _ => Corners {
            cracking: 0.3 * yielding,
            yielding,
            post_cracking: 0.3,
            post_yield: 0.02,
        },
    };
    // Sides differ where the rule allows it.
    let other = match rule {
        HysteresisRule::Bilinear => corners,
        _ => Corners {
            cracking: 0.24 * yielding,
            yielding: 0.8 * yielding,
            ..corners
        },
    };
    let backbone = Backbone::from_forces(initial, corners, other).expect("sound");
    Hysteresis::new(rule, backbone).expect("sound")
}

/// Yield moments of columns along x and across, and of beams [N·m]; `None` stays elastic.
#[derive(Clone, Copy)]
struct Moments {
    rule: HysteresisRule,
    initial: f64,
    columns: [Option<f64>; 2],
    beams: Option<f64>,
}

const MOMENTS: Moments = Moments {
    rule: HysteresisRule::PeakOriented,
    initial: INITIAL,
    columns: [Some(160e3), Some(130e3)],
    beams: Some(90e3),
};

/// A regular grid with hinges; sizes of columns along x and across, and widths and depths of beams in both directions.
struct Grid<'a> {
    lines: [&'a [f64]; 2],
    heights: &'a [f64],
    column: [f64; 2],
    beams: [[f64; 2]; 2],
    axial: bool,
    moments: Moments,
}

impl Grid<'_> {
    fn frame(&self) -> SpaceFrame {
        let [nx, ny] = self.lines.map(<[f64]>::len);
        let mut members = Vec::new();
        for storey in 0..self.heights.len() {
            for y in 0..ny {
                for x in 0..nx {
                    let line = [x, y];
                    members.push(SpacePlace::Column { line, storey });
                    if x + 1 < nx {
                        members.push(SpacePlace::BeamX {
                            span: x,
                            line: y,
                            floor: storey,
                        });
                    }
                    if y + 1 < ny {
                        members.push(SpacePlace::BeamY {
                            line: x,
                            span: y,
                            floor: storey,
                        });
                    }
                }
            }
        }
        let mut frame = SpaceFrame {
            at: [0.0, 0.0],
            direction: [1.0, 0.0],
            lines_x: self.lines[0].to_vec(),
            lines_y: self.lines[1].to_vec(),
            members: Vec::new(),
            ..SpaceFrame::default()
        };
        let members = members.into_iter().map(|place| self.member(&frame, place));
        frame.members = members.collect();
        frame
    }

    fn member(&self, frame: &SpaceFrame, place: SpacePlace) -> SpaceMember {
        let Moments {
            rule,
            initial,
            columns,
            beams,
        } = self.moments;
        let mut section = match place {
            SpacePlace::Column { .. } => SpaceSection::rectangle(self.column, E, 0.2, false),
            SpacePlace::BeamX { .. } => SpaceSection::beam(self.beams[0], E, 0.2, false),
            SpacePlace::BeamY { .. } => SpaceSection::beam(self.beams[1], E, 0.2, false),
        }
        .expect("a section");
        if !self.axial {
            section.axial_rigidity = None;
        }
        let moments = match place {
            SpacePlace::Column { .. } => columns,
            SpacePlace::BeamX { .. } | SpacePlace::BeamY { .. } => [beams, None],
        };
        let length = frame.length(place, self.heights);
        let mut hinges = [None; 2];
        for plane in 0..2 {
            let stiffness = initial * section.flexural_rigidity[plane] / length;
            hinges[plane] = moments[plane].map(|moment| hinge(rule, stiffness, moment));
        }
        SpaceMember {
            place,
            section,
            hinges,
        }
    }

    fn tiers(&self, mass: f64) -> Tiers {
        let [a, b] = self.lines.map(|lines| lines[lines.len() - 1]);
        let plan = vec![[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]];
        let tier = Tier::uniform(mass, plan).expect("an area");
        held_by(self.frame(), vec![tier; self.heights.len()], self.heights)
    }
}

fn held_by(frame: SpaceFrame, floors: Vec<Tier>, heights: &[f64]) -> Tiers {
    Tiers {
        floors,
        storey_heights: heights.to_vec(),
        space_frame: Some(frame),
        ..Tiers::default()
    }
}

const DAMPING: Damping = Damping::Rayleigh {
    alpha: 0.5,
    beta: 0.0,
};

fn building(name: &str, structure: Structure, hinges: Option<Hinges>) -> Building {
    Building {
        name: name.to_owned(),
        structure,
        damping: DAMPING,
        hinges,
        ..Building::default()
    }
}

fn model(buildings: Vec<Building>, gaps: Vec<Gap>) -> Model {
    let contact_step = (!gaps.is_empty()).then_some(1e-4);
    Model {
        title: "yielding space frames".to_owned(),
        buildings,
        gaps,
        analysis: Analysis {
            solver: Some(Solver::Riccati),
            step: Some(2e-3),
            contact_step,
            ..Analysis::default()
        },
        ..Model::default()
    }
}

fn single(structure: Structure, motion: &GroundMotion) -> (System, Outcome) {
    run(
        &model(vec![building("A", structure, None)], Vec::new()),
        motion,
        Some(0.02),
    )
}

/// A shaking without symmetry, 3 s long.
fn shaking(name: &str, rate: f64, scale: f64) -> GroundMotion {
    fading(name, rate, [scale, 3.0], 150)
}

/// The same from another bearing, with a component across it.
fn bearing(mut motion: GroundMotion, angle: f64, across: Option<GroundMotion>) -> GroundMotion {
    motion.bearing = Some(Box::new(Bearing { angle, across }));
    motion
}

fn most(floor: &PeaksOf<'_>) -> f64 {
    floor.displacement().size()
}

/// Two storeys, two bays along x, one across.
fn pair_of_frames(moments: Moments, axial: bool) -> Grid<'static> {
    Grid {
        lines: [&[0.0, 6.0, 11.0], &[0.0, 5.0]],
        heights: &[3.6, 3.2],
        column: [0.45, 0.40],
        beams: [[0.3, 0.5], [0.25, 0.45]],
        axial,
        moments,
    }
}

/// One bay deep and shaken along x, a frame is two plane ones, hinge by hinge; its members have the same forces.
#[test]
fn a_pair_of_frames_yields_as_its_plane_limit() {
    for axial in [true, false] {
        let grid = pair_of_frames(MOMENTS, axial);
        let space = grid.tiers(90e3);
        let frame = space.space_frame.as_ref().expect("a space frame");
        let properties = |place: SpacePlace| {
            let mut members = frame.members.iter();
            let member = members
                .find(|member| member.place == place)
                .expect("a member");
            let section = Section {
                flexural_rigidity: member.section.flexural_rigidity[0],
                axial_rigidity: member.section.axial_rigidity.or(Some(1e9)),
                shear_rigidity: None,
                line_mass: 0.0,
            };
            (section, member.hinges[0].expect("a hinge"))
        };
        let column = |line: usize, storey: usize| {
            properties(SpacePlace::Column {
                line: [line, 0],
                storey,
            })
        };
        let beam = |span: usize, floor: usize| {
            properties(SpacePlace::BeamX {
                span,
                line: 0,
                floor,
            })
        };
        let plane = Frame {
            storey_heights: grid.heights.to_vec(),
            spans: vec![6.0, 5.0],
            columns: vec![column(0, 0).0; 2],
            beams: vec![beam(0, 0).0; 2],
            beam_mass: vec![0.0; 2],
            floor_mass: vec![0.0; 2],
            column_segments: 1,
            beam_segments: vec![1; 2],
            axial: Axial {
                columns_flexible: axial,
                beams_flexible: false,
            },
            ..Frame::default()
        };
        let hinges = FrameHinges {
            columns: vec![vec![column(0, 0).1; 3], vec![column(0, 1).1; 3]],
            beams: vec![vec![beam(0, 0).1, beam(1, 0).1]; 2],
            ..FrameHinges::default()
        };
        let standing = |name: &str, y: f64| PlanFrame {
            name: name.to_owned(),
            at: [0.0, y],
            direction: [1.0, 0.0],
            lines: Vec::new(),
            base: Base::default(),
            frame: plane.clone(),
            hinges: hinges.clone(),
        };
        let across = TierStorey {
            stiffness: [0.0, 80e6, 5e9],
            centre: [5.5, 2.5],
        };
        let plane = Tiers {
            storeys: vec![across; 2],
            frames: vec![standing("1", 0.0), standing("2", 5.0)],
            space_frame: None,
            ..space.clone()
        };
        let motion = shaking("along", 4.0, 1.0);
        let with_members = |tiers: Tiers| {
            let mut model = model(
                vec![building("A", Structure::Tiers(tiers), None)],
                Vec::new(),
            );
            model.analysis.members = MemberRequest::all();
            run(&model, &motion, Some(0.02))
        };
        let (of_space, a) = with_members(space);
        let (of_plane, b) = with_members(plane);
        assert!(b.energy.hysteretic > 1e4, "{}", b.energy.hysteretic);
        assert!(a.energy.worst_imbalance < 1e-9);
        let (ea, eb) = (a.energy.hysteretic, b.energy.hysteretic);
        close(ea, eb, eb, 1e-8, "hysteretic energy");
        close(
            a.peaks.base_shear(0),
            b.peaks.base_shear(0),
            b.peaks.base_shear(0),
            1e-8,
            "V",
        );
        for (floor, other) in a.peaks.floors(0).iter().zip(&b.peaks.floors(0)) {
            close(most(floor), most(other), most(other), 1e-8, "displacement");
            let shears = [floor.storey_shear(), other.storey_shear()];
            close(shears[0], shears[1], shears[1], 1e-8, "storey shear");
            let moments = [floor.overturning_moment(), other.overturning_moment()];
            close(moments[0], moments[1], moments[1], 1e-8, "moment");
        }
        for floor in a.peaks.buildings().flatten() {
            for other in [floor.across(), floor.turning()] {
                assert!(most(&other) < 1e-10, "{}", most(&other));
            }
        }
        // Peaks of members on the first line are those of the first plane frame.
        let (one, other) = (&of_space.buildings[0], &of_plane.buildings[0]);
        let mut compared = 0;
        for member in other.members.members.iter().filter(|m| m.frame == Some(0)) {
            let wanted = match member.place {
                MemberPlace::Column { line, storey } => SpacePlace::Column {
                    line: [line - 1, 0],
                    storey: storey - 1,
                },
                MemberPlace::Beam { floor, span } => SpacePlace::BeamX {
                    span: span - 1,
                    line: 0,
                    floor: floor - 1,
                },
                MemberPlace::InSpace(_) => panic!("a plane frame"),
            };
            let mut members = one.members.members.iter();
            let same = members.find(|member| member.place == MemberPlace::InSpace(wanted));
            let same = same.expect("the same member");
            for (section, of_plane) in same.sections.iter().zip(&member.sections) {
                for (form, other) in section.forms.iter().zip(of_plane.forms) {
                    for (value, expected) in a.members[0][*form].iter().zip(b.members[0][other]) {
                        close(*value, expected, 1e5, 1e-7, &format!("{wanted:?}"));
                    }
                }
            }
            compared += 1;
        }
        assert_eq!(compared, 2 * (3 + 2));
    }
}

fn turned(tiers: &Tiers, angle: f64) -> Tiers {
    let (s, c) = angle.sin_cos();
    let turn = |[x, y]: PlanPoint| [c * x - s * y, s * x + c * y];
    let mut tiers = tiers.clone();
    for floor in &mut tiers.floors {
        floor.centre = turn(floor.centre);
        floor
            .plan
            .iter_mut()
            .for_each(|corner| *corner = turn(*corner));
    }
    tiers.space_frame.as_mut().expect("a frame").direction = [c, s];
    tiers
}

/// Turned by 30° with its shaking, a frame yields alike; histories of the floors turn with it.
#[test]
fn a_turned_site_yields_the_same() {
    let mut tiers = pair_of_frames(MOMENTS, true).tiers(90e3);
    for floor in &mut tiers.floors {
        floor.centre = [6.5, 2.0];
    }
    let angle = PI / 6.0;
    let motion = |from: f64| {
        let across = shaking("across", 5.0, 0.7);
        bearing(shaking("along", 4.0, 1.0), from, Some(across))
    };
    let (system, a) = single(Structure::Tiers(tiers.clone()), &motion(0.2));
    let (_, b) = single(
        Structure::Tiers(turned(&tiers, angle)),
        &motion(0.2 + angle),
    );
    assert!(a.energy.hysteretic > 1e4);
    close(
        b.energy.hysteretic,
        a.energy.hysteretic,
        a.energy.hysteretic,
        1e-8,
        "energy",
    );
    let (forces, others) = (spring_forces(&a), spring_forces(&b));
    for (force, other) in forces.iter().zip(&others) {
        close(*other, *force, *force, 1e-8, "moment");
    }
    for (floor, other) in a.peaks.floors(0).iter().zip(&b.peaks.floors(0)) {
        let (one, other) = (most(&floor.turning()), most(&other.turning()));
        assert!(one > 1e-4, "it turns");
        close(other, one, one, 1e-8, "rotation");
    }
    assert_eq!(forces.len(), system.buildings[0].equations.springs.len());
    // Columns in two planes at two ends; beams in one.
    assert_eq!(forces.len(), 2 * (12 * 2 + 14));
}

/// With x and y exchanged everywhere, so are the displacements.
#[test]
fn a_portal_yields_across_as_along() {
    let tiers = |swap: bool| {
        let moments = Moments {
            columns: if swap {
                [Some(130e3), Some(160e3)]
            } else {
                [Some(160e3), Some(130e3)]
            },
            ..MOMENTS
        };
        let (xs, ys): (&[f64], &[f64]) = (&[0.0, 6.0], &[0.0, 4.5]);
        let (along, across) = ([0.3, 0.5], [0.25, 0.45]);
        let grid = Grid {
            lines: if swap { [ys, xs] } else { [xs, ys] },
            heights: &[3.6],
            column: if swap { [0.40, 0.45] } else { [0.45, 0.40] },
            beams: if swap {
                [across, along]
            } else {
                [along, across]
            },
            axial: true,
            moments,
        };
        Structure::Tiers(grid.tiers(120e3))
    };
    let motion = |angle: f64| bearing(shaking("along", 5.0, 1.3), angle, None);
    let (_, a) = single(tiers(false), &motion(0.0));
    let (_, b) = single(tiers(true), &motion(0.5 * PI));
    assert!(a.energy.hysteretic > 1e4);
    let (along, across) = (
        most(&a.peaks.floor(0, 1)),
        most(&b.peaks.floor(0, 1).across()),
    );
    close(across, along, along, 1e-9, "displacement");
    let energies = [b.energy.hysteretic, a.energy.hysteretic];
    close(energies[0], energies[1], energies[1], 1e-9, "energy");
}

const HEIGHT: f64 = 3.6;

/// Columns without beams: their feet yield, about both axes.
fn cantilevers(lines: [&[f64]; 2], moments: Moments) -> SpaceFrame {
    let grid = Grid {
        lines,
        heights: &[HEIGHT],
        column: [0.5, 0.4],
        beams: [[0.3, 0.5]; 2],
        axial: true,
        moments,
    };
    let mut frame = grid.frame();
    frame
        .members
        .retain(|member| matches!(member.place, SpacePlace::Column { .. }));
    frame
}

/// The spring that a cantilever with a hinge at its foot is: in series, h³/3EI and h²/k of the hinge.
fn in_series(rigidity: f64, hinge: &Hysteresis) -> Hysteresis {
    let bent = HEIGHT.powi(3) / (3.0 * rigidity);
    let curve = hinge.backbone().side(jostle::hysteresis::Side::Positive);
    let slope = |stiffness: f64| 1.0 / (bent + HEIGHT * HEIGHT / stiffness);
    let initial = slope(hinge.backbone().initial());
    let corners = Corners::bilinear(
        curve.yielding.force / HEIGHT,
        slope(curve.post_yield) / initial,
    );
    let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
    Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
}

const BILINEAR: Moments = Moments {
    rule: HysteresisRule::Bilinear,
    columns: [Some(120e3), Some(90e3)],
    ..MOMENTS
};

/// Under two components each direction is a plane problem of its own: two cantilevers are a shear building.
#[test]
fn cantilevers_yield_in_each_direction_as_in_the_plane() {
    let frame = cantilevers([&[0.0, 6.0], &[0.0]], BILINEAR);
    let section = frame.members[0].section;
    let hinges = frame.members[0].hinges.map(|hinge| hinge.expect("a hinge"));
    let plan = vec![[-1.0, -2.0], [7.0, -2.0], [7.0, 2.0], [-1.0, 2.0]];
    let tier = Tier::uniform(60e3, plan).expect("an area");
    let tiers = held_by(frame, vec![tier], &[HEIGHT]);
    let components = [shaking("along", 4.0, 0.6), shaking("across", 5.0, 0.5)];
    let motion = bearing(components[0].clone(), 0.0, Some(components[1].clone()));
    let (_, space) = single(Structure::Tiers(tiers), &motion);
    assert!(most(&space.peaks.floor(0, 1).turning()) < 1e-12);
    let found = [&space.peaks.floor(0, 1), &space.peaks.floor(0, 1).across()];
    for axis in 0..2 {
        let series = in_series(section.flexural_rigidity[axis], &hinges[axis]);
        let doubled = series.backbone().initial() * 2.0;
        let yielding = series.backbone().side(jostle::hysteresis::Side::Positive);
        let ratio = yielding.post_yield / series.backbone().initial();
        let corners = Corners::bilinear(2.0 * yielding.yielding.force, ratio);
        let backbone = Backbone::from_forces(doubled, corners, corners).expect("sound");
        let storey = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
        let shear = Shear {
            mass: vec![60e3],
            stiffness: vec![doubled],
            storey_heights: vec![HEIGHT],
        };
        let hinges = Some(Hinges::Storeys(vec![storey]));
        let plane = building("A", Structure::Shear(shear), hinges);
        let (_, plane) = run(
            &model(vec![plane], Vec::new()),
            &components[axis],
            Some(0.02),
        );
        let floor = &plane.peaks.floor(0, 1);
        assert!(plane.energy.hysteretic > 1e3);
        close(most(found[axis]), most(floor), most(floor), 1e-9, "u");
        let times = [found[axis], floor].map(|peaks| peaks.displacement_max().at);
        close(times[0], times[1], 1.0, 1e-9, "time");
    }
}

/// Four unequal columns about a centre of mass beside them: the springs in series with their bending, each at its point of the plan,
/// are a building whose answer is compared with an integration of its own elsewhere.
#[test]
fn an_eccentric_storey_yields_as_springs_at_points_of_the_plan() {
    let mut frame = cantilevers([&[0.0, 6.0], &[0.0, 5.0]], BILINEAR);
    for (index, member) in frame.members.iter_mut().enumerate() {
        let factor = 1.0 + 0.35 * index as f64;
        for plane in 0..2 {
            member.section.flexural_rigidity[plane] *= factor;
            let stiffness = INITIAL * member.section.flexural_rigidity[plane] / HEIGHT;
            let yielding = BILINEAR.columns[plane].expect("yields") * factor.sqrt();
            member.hinges[plane] = Some(hinge(HysteresisRule::Bilinear, stiffness, yielding));
        }
    }
    let plan = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 5.0], [0.0, 5.0]];
    let mut tier = Tier::uniform(110e3, plan).expect("an area");
    tier.centre = [2.6, 2.9];
    let mut springs = Vec::new();
    let mut torsion = 0.0;
    for (index, member) in frame.members.iter().enumerate() {
        let [line, _] = member.place.crossings();
        torsion += member.section.torsional_rigidity / HEIGHT;
        springs.extend(PlanAxis::BOTH.map(|axis| {
            let hinge = member.hinges[axis.index()].expect("a hinge");
            PlanSpring {
                element: Some(index),
                storey: 0,
                at: frame.point(line),
                axis,
                hysteresis: in_series(member.section.flexural_rigidity[axis.index()], &hinge),
            }
        }));
    }
    let of_springs = Tiers {
        floors: vec![tier.clone()],
        storeys: vec![TierStorey {
            stiffness: [0.0, 0.0, torsion],
            centre: [0.0, 0.0],
        }],
        storey_heights: vec![HEIGHT],
        yielding: springs,
        element_names: vec![None; 4],
        ..Tiers::default()
    };
    let of_columns = held_by(frame, vec![tier], &[HEIGHT]);
    let across = shaking("across", 5.0, 0.9);
    let motion = bearing(shaking("along", 4.0, 1.1), 0.3, Some(across));
    let (_, a) = single(Structure::Tiers(of_columns), &motion);
    let (_, b) = single(Structure::Tiers(of_springs), &motion);
    let peaks = |outcome: &Outcome| {
        let floor = outcome.peaks.floor(0, 1);
        [floor, floor.across(), floor.turning()].map(|direction| most(&direction))
    };
    for (peak, expected) in peaks(&a).into_iter().zip(peaks(&b)) {
        assert!(expected > 1e-3, "{expected}");
        close(peak, expected, expected, 1e-9, "peak");
    }
    assert!(b.energy.hysteretic > 1e4 && a.energy.worst_imbalance < 1e-9);
    close(
        a.peaks.base_shear(0),
        b.peaks.base_shear(0),
        b.peaks.base_shear(0),
        1e-9,
        "V",
    );
}

/// Hinges that are nearly rigid and never yield leave the frame without hinges.
#[test]
fn hinges_that_do_not_yield_leave_the_elastic_frame() {
    let never = Moments {
        rule: HysteresisRule::Bilinear,
        initial: 1e8,
        columns: [Some(1e12); 2],
        beams: Some(1e12),
    };
    let elastic = Moments {
        columns: [None; 2],
        beams: None,
        ..never
    };
    let across = shaking("across", 5.0, 0.7);
    let motion = bearing(shaking("along", 4.0, 1.0), 0.2, Some(across));
    for axial in [true, false] {
        let tiers = |moments: Moments| {
            let mut tiers = pair_of_frames(moments, axial).tiers(90e3);
            tiers.floors[0].centre = [6.2, 2.1];
            Structure::Tiers(tiers)
        };
        let (of_hinges, a) = single(tiers(never), &motion);
        let (of_none, b) = single(tiers(elastic), &motion);
        for (floor, other) in a.peaks.floors(0).iter().zip(&b.peaks.floors(0)) {
            close(most(floor), most(other), most(other), 1e-6, "u");
        }
        for (floor, other) in a.peaks.floors(0).iter().zip(&b.peaks.floors(0)) {
            let (one, other) = (most(&floor.turning()), most(&other.turning()));
            close(one, other, other, 1e-6, "rotation");
        }
        let modes = of_hinges.buildings[0].modes.iter();
        for (mode, other) in modes.zip(&of_none.buildings[0].modes) {
            let expected = other.circular_frequency;
            close(mode.circular_frequency, expected, expected, 1e-7, "mode");
        }
        assert_eq!(of_hinges.buildings[0].modes.len(), 6);
        // By modes the elastic frame answers alike, within its tolerance.
        let mut by_modes = model(vec![building("A", tiers(elastic), None)], Vec::new());
        by_modes.analysis = Analysis {
            solver: Some(Solver::Modal),
            tolerance: 1e-4,
            ..Analysis::default()
        };
        let (_, modal) = run(&by_modes, &motion, Some(0.02));
        for (floor, other) in a.peaks.floors(0).iter().zip(&modal.peaks.floors(0)) {
            close(most(floor), most(other), most(other), 3e-3, "by modes");
        }
    }
}

/// An eccentric frame beside a smaller and stronger one, whose columns keep their length; both yield.
fn pounding_pair() -> Model {
    let mut first = pair_of_frames(MOMENTS, true).tiers(90e3);
    first.move_by([-11.0, 0.0]);
    for floor in &mut first.floors {
        floor.centre[1] += 0.4;
    }
    let strong = Moments {
        columns: [Some(260e3), Some(220e3)],
        beams: Some(150e3),
        ..MOMENTS
    };
    let second = Grid {
        lines: [&[0.0, 5.0], &[0.0, 4.0]],
        column: [0.6, 0.6],
        ..pair_of_frames(strong, false)
    };
    let mut second = second.tiers(60e3);
    second.move_by([0.01, 0.5]);
    let law = ContactLaw {
        kind: LawKind::HertzDamp,
        stiffness: 2e9,
        restitution: 0.65,
        restitution_is: RestitutionIs::Input,
    };
    let buildings = vec![
        building("A", Structure::Tiers(first), None),
        building("B", Structure::Tiers(second), None),
    ];
    model(buildings, vec![Gap::between([Some(0), Some(1)], 0.01, law)])
}

/// While two frames yield and pound, energy balances and every joint is in equilibrium.
#[test]
fn joints_are_in_equilibrium_while_yielding_frames_pound() {
    let mut model = pounding_pair();
    model.analysis.members = MemberRequest::all();
    let assembled = runs::assembled(&model);
    for (index, name) in ["A", "B"].into_iter().enumerate() {
        // Every hinge is listed once, by its member, end and axis.
        let places = &assembled.buildings[index].discretization.spring_places;
        let again = |place| places.iter().filter(|other| *other == place).count();
        assert!(places.iter().all(|place| again(place) == 1), "{places:?}");
        let members = assembled.buildings[index].members.members.iter();
        let names = members.map(|member| format!("{name}.{}", member.place));
        model.analysis.members.histories.extend(names);
    }
    let across = shaking("across", 5.0, 0.7);
    let motion = bearing(shaking("along", 4.0, 1.0), 0.2, Some(across));
    let (system, outcome) = run(&model, &motion, Some(0.02));
    assert!(outcome.face_impacts.len() > 2, "they pound");
    assert!(outcome.energy.hysteretic > 1e4);
    assert!(
        outcome.energy.worst_imbalance < 1e-9,
        "{}",
        outcome.energy.worst_imbalance
    );
    let history = outcome.member_history.as_ref().expect("asked for");
    let mut first = 0;
    for building in &system.buildings {
        let places: Vec<SpacePlace> = building
            .members
            .members
            .iter()
            .map(|member| match member.place {
                MemberPlace::InSpace(place) => place,
                _ => panic!("in space"),
            })
            .collect();
        for (instant, row) in history.rows().enumerate().skip(1).step_by(7) {
            let rows = row.chunks_exact(2).skip(first);
            let members: Vec<(SpacePlace, [[f64; 6]; 2])> = places
                .iter()
                .zip(rows)
                .map(|(place, ends)| (*place, [ends[0], ends[1]]))
                .collect();
            check_joints(&members, &format!("{}, instant {instant}", building.name));
        }
        first += places.len();
    }
}

/// Checks that forces of members on every joint balance.
fn check_joints(members: &[(SpacePlace, [[f64; 6]; 2])], what: &str) {
    let mut sums: BTreeMap<(usize, [usize; 2]), [f64; 3]> = BTreeMap::new();
    for (place, ends) in members {
        let level = place.storey();
        for (end, [n, v, m, _, ma, t]) in ends.iter().enumerate() {
            let side = if end == 0 { 1.0 } else { -1.0 };
            let (floor, force) = match place {
                SpacePlace::Column { .. } => {
                    let floor = if end == 0 {
                        level.checked_sub(1)
                    } else {
                        Some(level)
                    };
                    (floor, [side * n, side * ma, -side * m])
                }
                SpacePlace::BeamX { .. } => (Some(level), [-side * v, side * t, -side * m]),
                SpacePlace::BeamY { .. } => (Some(level), [-side * v, side * m, side * t]),
            };
            let Some(floor) = floor else { continue };
            let sum = sums.entry((floor, place.crossings()[end])).or_default();
            for (sum, force) in sum.iter_mut().zip(force) {
                *sum += force;
            }
        }
    }
    for ((floor, crossing), sum) in sums {
        for value in sum {
            close(
                value,
                0.0,
                1e5,
                1e-8,
                &format!("joint {crossing:?} at floor {floor}, {what}"),
            );
        }
    }
}

/// Both solvers of direct steps give the same; modal stepping is refused with the remedy.
#[test]
fn both_direct_solvers_agree_and_modes_are_refused() {
    let motion = shaking("along", 4.0, 1.0);
    let tiers = pair_of_frames(MOMENTS, true).tiers(90e3);
    let with = |solver: Solver| {
        let mut model = model(
            vec![building("A", Structure::Tiers(tiers.clone()), None)],
            Vec::new(),
        );
        model.analysis.solver = Some(solver);
        model
    };
    let (_, a) = run(&with(Solver::Riccati), &motion, Some(0.02));
    let (_, b) = run(&with(Solver::Stiffness), &motion, Some(0.02));
    for (floor, other) in a.peaks.floors(0).iter().zip(&b.peaks.floors(0)) {
        close(most(floor), most(other), most(other), 1e-9, "u");
    }
    let refused = with(Solver::Modal);
    let system = runs::assembled(&refused);
    let faults = Plan::choose(&system, &motion, &refused.analysis).expect_err("it yields");
    assert!(
        faults[0].problem.contains("riccati"),
        "{}",
        faults[0].problem
    );
}

/// A beam bends in its vertical plane only.
#[test]
fn hinges_about_the_weak_axis_of_a_beam_are_refused() {
    let mut tiers = pair_of_frames(MOMENTS, true).tiers(90e3);
    let frame = tiers.space_frame.as_mut().expect("a frame");
    let beam = frame
        .members
        .iter_mut()
        .find(|member| matches!(member.place, SpacePlace::BeamX { .. }))
        .expect("a beam");
    beam.hinges[1] = beam.hinges[0];
    let model = model(
        vec![building("A", Structure::Tiers(tiers), None)],
        Vec::new(),
    );
    let faults = System::assemble(&model).expect_err("rigid floors");
    assert!(faults[0].path.ends_with("beam_x"), "{faults:?}");
    assert!(faults[0].problem.contains("vertical plane"), "{faults:?}");
}
