//! Slabs that strike columns of frames at lines of a plan between floors: the space frame that they make as the reference.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::structure::Discretization;
use jostle::{
    Axial, Building, Damping, FloorPairs, Frame, FrameHinges, LawKind, Level, Model, PlanFrame,
    PlanPoint, Section, Solver, SpaceFrame, SpacePlace, SpaceSection, Structure, Summary, System,
    Tier, Tiers,
};
use jostle_testkit::compare::near;
use jostle_testkit::models::rectangle;

use super::plan_frames::standing;
use super::struck_in_space::{
    BAY, GAP, STOREYS, bay_by_bay, beam_section, beside, column_section, faults, framed, law,
    model, shaken, shaking,
};

/// Height at which a slab strikes a column of the upper storey \[m\].
const ABOVE: f64 = 5.5;

/// One bay by one bay, whose columns and beams twist without resistance.
fn without_torsion() -> SpaceFrame {
    let mut frame = bay_by_bay(false);
    for member in &mut frame.members {
        member.section.torsional_rigidity = 1e-3;
    }
    frame
}

fn in_one_plane(section: SpaceSection, plane: usize) -> Section {
    Section {
        flexural_rigidity: section.flexural_rigidity[plane],
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass: section.line_mass,
    }
}

/// The same bay as four frames at lines that share their columns.
fn at_lines() -> Vec<PlanFrame> {
    let frame = |span: f64, plane: usize, depth: f64, beam: [f64; 2]| Frame {
        storey_heights: STOREYS.to_vec(),
        spans: vec![span],
        columns: vec![in_one_plane(column_section([0.5, 0.4], false), plane); 2],
        beams: vec![in_one_plane(beam_section(beam), 0); 2],
        beam_mass: vec![0.0; 2],
        floor_mass: vec![0.0; 2],
        column_segments: 1,
        beam_segments: vec![1],
        axial: Axial {
            columns_flexible: false,
            beams_flexible: false,
        },
        column_depths: [[0, 0], [0, 1], [1, 0], [1, 1]]
            .map(|place| (place, depth))
            .into(),
        ..Frame::default()
    };
    let along = frame(BAY[0], 0, 0.5, [0.3, 0.6]);
    let across = frame(BAY[1], 1, 0.4, [0.25, 0.5]);
    let quarter = 0.5 * std::f64::consts::PI;
    let named =
        |name: &str, at: PlanPoint, angle: f64, frame: &Frame, lines: [&str; 2]| PlanFrame {
            lines: lines.map(|line| Some(line.to_owned())).to_vec(),
            ..standing(name, at, angle, frame.clone())
        };
    vec![
        named("1", [0.0, 0.0], 0.0, &along, ["A1", "B1"]),
        named("2", [0.0, BAY[1]], 0.0, &along, ["A2", "B2"]),
        named("A", [0.0, 0.0], quarter, &across, ["A1", "A2"]),
        named("B", [BAY[0], 0.0], quarter, &across, ["B1", "B2"]),
    ]
}

fn standing_on(floors: Vec<Tier>, frames: Vec<PlanFrame>) -> Structure {
    Structure::Tiers(Tiers {
        floors,
        storey_heights: STOREYS.to_vec(),
        frames,
        ..Tiers::default()
    })
}

fn discretization_of(model: &Model) -> Discretization {
    let system = System::assemble(model).expect("a sound model");
    system.buildings[0].discretization.clone()
}

/// A model of frames at lines whose floors have, with all that moves with them, the masses of those of a model of a space frame.
fn with_masses_of(space: &Model, frames: &[PlanFrame]) -> Model {
    let of_model = |floors: Vec<Tier>| {
        let mut model = space.clone();
        model.buildings[0].structure = standing_on(floors, frames.to_vec());
        model
    };
    let wanted = discretization_of(space).lumped;
    let bare: Vec<Tier> = wanted.iter().map(|floor| floor.tier.clone()).collect();
    let with_frames = discretization_of(&of_model(bare.clone())).lumped;
    let moments = |tier: &Tier| {
        let [x, y] = tier.centre;
        let about_origin = tier.polar_mass + tier.mass * (x * x + y * y);
        [tier.mass, tier.mass * x, tier.mass * y, about_origin]
    };
    let floors = bare.iter().zip(&with_frames).map(|(bare, lumped)| {
        assert_eq!(lumped.one_way, [0.0; 2], "both frames move a shared column");
        let [own, all] = [bare, &lumped.tier].map(moments);
        let [mass, x, y, about_origin] = [0, 1, 2, 3].map(|part| 2.0 * own[part] - all[part]);
        let centre = [x / mass, y / mass];
        let [a, b] = centre;
        Tier {
            mass,
            centre,
            polar_mass: about_origin - mass * (a * a + b * b),
            plan: bare.plan.clone(),
        }
    });
    let model = of_model(floors.collect());
    for (own, wanted) in discretization_of(&model).lumped.iter().zip(&wanted) {
        near(own.tier.mass, wanted.tier.mass, 1e-12, "mass");
        near(
            own.tier.polar_mass,
            wanted.tier.polar_mass,
            1e-9,
            "polar mass",
        );
    }
    model
}

/// Peaks of contacts and floors, and forces beside the struck point, of two runs.
fn are_alike(at_lines: &Summary, space: &Summary, names: [&str; 2], tolerance: f64) {
    let contacts = at_lines.gaps[0]
        .contacts
        .iter()
        .zip(&space.gaps[0].contacts);
    assert!(contacts.clone().count() > 0);
    for (one, other) in contacts {
        assert!(other.impact_count > 1);
        assert_eq!(one.impact_count, other.impact_count);
        near(one.width_m, other.width_m, 1e-9, "width");
        near(one.peak_force_n, other.peak_force_n, tolerance, "force");
        near(one.impulse_n_s, other.impulse_n_s, tolerance, "impulse");
    }
    let [a, b] = [at_lines, space].map(|summary| &summary.buildings[0]);
    for (one, other) in a.floors.iter().zip(&b.floors) {
        let sides = [one, other].map(|floor| {
            let plan = floor.in_plan.as_ref().expect("a plan");
            [
                floor.response.displacement_max_m,
                floor.response.displacement_min_m,
                plan.displacement_across_max_m,
                plan.rotation_max_rad,
            ]
        });
        for (one, other) in sides[0].iter().zip(sides[1]) {
            near(*one, other, tolerance, "floors");
        }
    }
    let [own, other] = [(a, names[0]), (b, names[1])].map(|(building, name)| {
        let mut members = building.members.iter();
        let member = members.find(|member| member.name == name);
        member.expect("a column").struck[0]
    });
    assert_eq!(own.impact_count, other.impact_count);
    for (one, other) in [(&own.below, &other.below), (&own.above, &other.above)] {
        near(one.shear_peak_n, other.shear_peak_n, tolerance, "shear");
        near(
            one.moment_peak_n_m,
            other.moment_peak_n_m,
            tolerance,
            "moment",
        );
    }
}

/// A slab that meets one column of the space frame, beside which it stands turned by an angle.
fn struck_once(own: Building, solver: Solver, [x, y]: PlanPoint) -> Model {
    let size = [8.0, 7.0];
    let plan = rectangle(BAY[0] + GAP, 2.0, size[0], size[1]);
    let pivot = [BAY[0] + GAP, 2.0];
    let turned = |[a, b]: PlanPoint| {
        let (a, b) = (a - pivot[0], b - pivot[1]);
        [pivot[0] + x * a - y * b, pivot[1] + y * a + x * b]
    };
    let plan: Vec<PlanPoint> = plan.into_iter().map(turned).collect();
    let centre = [0, 1].map(|axis| 0.5 * (plan[0][axis] + plan[2][axis]));
    model(
        vec![own, beside(&[ABOVE], plan, centre)],
        FloorPairs::Listed(vec![[Level::Height(ABOVE), Level::Floor(1)]]),
        law(LawKind::HertzDamp, 5e8),
        solver,
    )
}

/// One column of a corner is struck, out of the middle: the building twists. Also where the slab stands askew, with friction.
#[test]
fn frames_at_lines_are_struck_as_the_space_frame_that_they_make() {
    let motion = shaking();
    let askew = -0.05_f64;
    for (solver, angle, friction, tolerance) in [
        (Solver::Riccati, 0.0, 0.0, 1e-6),
        (Solver::Modal, 0.0, 0.0, 1e-4),
        (Solver::Riccati, askew, 0.3, 1e-5),
    ] {
        let turned = [f64::cos(angle), f64::sin(angle)];
        let mut space = struck_once(framed(without_torsion()), solver, turned);
        space.gaps[0].in_plan.friction = friction;
        let plane = with_masses_of(&space, &at_lines());
        let (_, outcome, a) = shaken(&plane, &motion);
        let (_, _, b) = shaken(&space, &motion);
        assert!(outcome.energy.worst_imbalance < 1e-6);
        assert_eq!(a.gaps[0].contacts[0].struck_column.as_deref(), Some("2.2"));
        are_alike(&a, &b, ["A.2.column.2.2", "A.column.2.2.2"], tolerance);
    }
}

/// Hinges at the ends of struck columns, and where they are struck.
#[test]
fn struck_columns_of_frames_at_lines_yield_as_in_space() {
    let hinge = {
        let corners = Corners::bilinear(90e3, 0.05);
        let backbone = Backbone::from_forces(4e8, corners, corners).expect("sound");
        Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
    };
    let mut frame = without_torsion();
    for member in &mut frame.members {
        if matches!(member.place, SpacePlace::Column { .. }) {
            member.hinges[0] = Some(hinge);
        }
    }
    let space = struck_once(framed(frame), Solver::Riccati, [1.0, 0.0]);
    let mut frames = at_lines();
    for frame in &mut frames[..2] {
        frame.hinges = FrameHinges {
            columns: vec![vec![hinge; 2]; 2],
            ..FrameHinges::default()
        };
    }
    let plane = with_masses_of(&space, &frames);
    let [a, b] = [plane, space].map(|model| shaken(&model, &shaking()).2);
    are_alike(&a, &b, ["A.2.column.2.2", "A.column.2.2.2"], 1e-4);
    let dissipated = |summary: &Summary| summary.energy.hysteretic_j;
    near(dissipated(&a), dissipated(&b), 1e-4, "dissipated");
    let hinges = |summary: &Summary| {
        let list = summary.buildings[0].hinges.list.clone().into_iter();
        let struck = list.filter(|hinge| hinge.place.contains("struck point"));
        struck.map(|hinge| hinge.place).collect::<Vec<_>>()
    };
    assert_eq!(hinges(&a), ["frame 2, column 2, storey 2, struck point 1"]);
    assert_eq!(hinges(&b).len(), 1);
}

/// Points take their mass from the floors beside them, whatever shares the column.
#[test]
fn points_on_frames_keep_the_mass() {
    for shares in [true, false] {
        let mut frames = at_lines();
        if !shares {
            frames.iter_mut().for_each(|frame| frame.lines.clear());
        }
        let space = struck_once(framed(without_torsion()), Solver::Riccati, [1.0, 0.0]);
        let mut struck = space.clone();
        let plan = rectangle(0.0, 0.0, BAY[0], BAY[1]);
        let floor = Tier::uniform(50e3, plan).expect("an area");
        struck.buildings[0].structure = standing_on(vec![floor; 2], frames);
        let mut whole = struck.clone();
        whole.gaps.clear();
        let masses = [&struck, &whole].map(|model| {
            let system = System::assemble(model).expect("a sound model");
            let building = &system.buildings[0];
            building.equations.moved_mass
        });
        for (struck, whole) in masses[0].iter().zip(masses[1]) {
            near(*struck, whole, 1e-12, "mass");
        }
    }
}

#[test]
fn what_frames_at_lines_cannot_bear_is_told() {
    let at = || FloorPairs::Listed(vec![[Level::Height(ABOVE), Level::Floor(1)]]);
    let own = |frames: Vec<PlanFrame>| {
        let plan = rectangle(0.0, 0.0, BAY[0], BAY[1]);
        let floor = Tier::uniform(50e3, plan).expect("an area");
        Building {
            structure: standing_on(vec![floor; 2], frames),
            damping: Damping::Rayleigh {
                alpha: 0.4,
                beta: 4e-4,
            },
            ..framed(without_torsion())
        }
    };
    let other = || {
        let plan = rectangle(BAY[0] + GAP, 2.0, 8.0, 7.0);
        beside(&[ABOVE], plan, [BAY[0] + 4.0, 5.5])
    };
    let mut weightless = at_lines();
    for frame in &mut weightless {
        frame
            .frame
            .columns
            .iter_mut()
            .for_each(|column| column.line_mass = 0.0);
    }
    let told = faults(vec![own(weightless), other()], at());
    assert!(
        told.contains("A.2.column.2.2 has no mass where it would be hit"),
        "{told}"
    );
    // Frames across alone do not bend the way they are pushed.
    let mut across = at_lines();
    across.iter_mut().for_each(|frame| frame.lines.clear());
    for frame in &mut across[..2] {
        frame.frame.own_columns = [[1, 0], [1, 1]].map(|place| (place, None)).into();
    }
    let told = faults(vec![own(across), other()], at());
    assert!(told.contains("no column stands within reach"), "{told}");
}
