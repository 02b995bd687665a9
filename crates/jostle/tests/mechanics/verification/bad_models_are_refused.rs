use jostle::{
    Axial, Damping, FloorPairs, Frame, LawKind, Level, Link, Model, Plan, RestitutionIs, Shear,
    Structure, System,
};

use crate::verification::support::{frame, framed, law, row, still, tower};

/// A frame beside a tower, sound.
fn sound() -> Model {
    row(
        vec![
            framed("frame", frame(3, &[4.0, 6.0])),
            tower("tower", 4, 3e4, 0.6),
        ],
        0.05,
        law(LawKind::HertzDamp, 0.65),
    )
}

fn frame_of(model: &mut Model) -> &mut Frame {
    match &mut model.buildings[0].structure {
        Structure::Frame(frame) => frame,
        _ => panic!("the first building is a frame"),
    }
}

fn shear_of(model: &mut Model) -> &mut Shear {
    match &mut model.buildings[1].structure {
        Structure::Shear(shear) => shear,
        _ => panic!("the second building is a tower"),
    }
}

fn link(stiffness: f64, damping: f64) -> Link {
    Link {
        between: [Some(0), Some(1)],
        floors: FloorPairs::Common,
        level_tolerance: 1e-3,
        stiffness,
        damping,
        law: jostle::LinkLaw::Linear,
        ..Link::default()
    }
}

fn ratio(ratio: f64, modes: &[usize]) -> Damping {
    Damping::ratio(ratio, modes)
}

/// What is broken, where it is reported, and part of what is said.
type Case = (fn(&mut Model), &'static str, &'static str);

const CASES: &[Case] = &[
    (
        |m| {
            m.gaps.clear();
            m.buildings.clear();
        },
        "building",
        "at least one building",
    ),
    (
        |m| m.buildings[0].name = " ".into(),
        "building[0].name",
        "must not be empty",
    ),
    (
        |m| m.buildings[0].name = "tower".into(),
        "building[0].name",
        "another building is called \"tower\"",
    ),
    (
        |m| m.buildings[0].name = "tower".into(),
        "building[1].name",
        "another building is called \"tower\"",
    ),
    (
        |m| frame_of(m).storey_heights[1] = 0.0,
        "building[0].storey_height[1]",
        "must be greater than zero, found 0 m",
    ),
    (
        |m| frame_of(m).storey_heights[2] = f64::NAN,
        "building[0].storey_height[2]",
        "must be greater than zero",
    ),
    (
        |m| shear_of(m).storey_heights[3] = -3.0,
        "building[1].storey_height[3]",
        "found -3 m",
    ),
    (
        |m| m.buildings[0].damping = ratio(1.0, &[1]),
        "building[0].damping.ratio",
        "between 0 and 1",
    ),
    (
        |m| m.buildings[0].damping = ratio(-0.05, &[1]),
        "building[0].damping.ratio",
        "found -0.05",
    ),
    (
        |m| m.buildings[0].damping = ratio(f64::NAN, &[1]),
        "building[0].damping.ratio",
        "between 0 and 1",
    ),
    (
        |m| m.buildings[1].damping = ratio(0.05, &[2, 1]),
        "building[1].damping.modes",
        "one lateral mode, or two",
    ),
    (
        |m| m.buildings[1].damping = ratio(0.05, &[0]),
        "building[1].damping.modes",
        "counted from 1; found [0]",
    ),
    (
        |m| m.buildings[1].damping = ratio(0.05, &[2, 2]),
        "building[1].damping.modes",
        "two different ones in rising order",
    ),
    (
        |m| m.buildings[1].damping = ratio(0.05, &[1, 2, 3]),
        "building[1].damping.modes",
        "found [1, 2, 3]",
    ),
    (
        |m| {
            m.buildings[0].damping = Damping::Rayleigh {
                alpha: -1.0,
                beta: 0.0,
            }
        },
        "building[0].damping.alpha",
        "must not be negative, found -1 1/s",
    ),
    (
        |m| {
            m.buildings[0].damping = Damping::Rayleigh {
                alpha: 0.0,
                beta: f64::INFINITY,
            }
        },
        "building[0].damping.beta",
        "must not be negative, found inf s",
    ),
    (
        |m| {
            let f = frame_of(m);
            f.storey_heights.clear();
            f.columns.clear();
            f.beams.clear();
            f.beam_mass.clear();
            f.floor_mass.clear();
        },
        "building[0].storeys",
        "at least one storey",
    ),
    (
        |m| frame_of(m).spans[1] = -6.0,
        "building[0].spans[1]",
        "must be greater than zero, found -6 m",
    ),
    (
        |m| {
            frame_of(m).columns.pop();
        },
        "building[0].column",
        "has 2 entries for 3 storeys",
    ),
    (
        |m| {
            frame_of(m).beams.pop();
        },
        "building[0].beam",
        "has 2 entries for 3 storeys",
    ),
    (
        |m| {
            frame_of(m).own_columns.insert([3, 0], None);
        },
        "building[0].column",
        "names line 1 of storey 4",
    ),
    (
        |m| {
            frame_of(m).own_columns.insert([1, 0], None);
        },
        "building[0].column[2][0]",
        "line 1 has a column in storey 3 but none in storey 2",
    ),
    (
        |m| {
            frame_of(m).own_columns.insert([2, 0], None);
        },
        "building[0].beam[2][0]",
        "line 1 no joint there",
    ),
    (
        |m| {
            frame_of(m).own_beams.insert([0, 0], None);
        },
        "building[0].beam[0][0]",
        "floor 1 is in two parts",
    ),
    (
        |m| frame_of(m).beam_mass.push(1.0),
        "building[0].beam_mass",
        "has 4 entries for 3 storeys",
    ),
    (
        |m| frame_of(m).floor_mass.clear(),
        "building[0].floor_mass",
        "has 0 entries for 3 storeys",
    ),
    (
        |m| frame_of(m).columns[2].flexural_rigidity = 0.0,
        "building[0].column[2].EI",
        "found 0 N.m2",
    ),
    (
        |m| frame_of(m).beams[0].flexural_rigidity = f64::INFINITY,
        "building[0].beam[0].EI",
        "must be greater than zero",
    ),
    (
        |m| frame_of(m).columns[0].line_mass = -1.0,
        "building[0].column[0].mass",
        "found -1 kg/m",
    ),
    (
        |m| frame_of(m).beams[1].line_mass = -1.0,
        "building[0].beam[1].mass",
        "found -1 kg/m",
    ),
    (
        |m| frame_of(m).columns[1].axial_rigidity = Some(0.0),
        "building[0].column[1].EA",
        "found 0 N",
    ),
    (
        |m| {
            let f = frame_of(m);
            f.axial = Axial {
                columns_flexible: true,
                beams_flexible: false,
            };
            f.columns[1].axial_rigidity = None;
        },
        "building[0].column[1].EA",
        "is needed because the member is axially flexible",
    ),
    (
        |m| {
            let f = frame_of(m);
            f.axial = Axial {
                columns_flexible: false,
                beams_flexible: true,
            };
            f.beams[2].axial_rigidity = None;
        },
        "building[0].beam[2].EA",
        "is needed because the member is axially flexible",
    ),
    (
        |m| frame_of(m).beam_mass[1] = -1.0,
        "building[0].beam_mass[1]",
        "must not be negative, found -1 kg/m",
    ),
    (
        |m| frame_of(m).floor_mass[1] = -1.0,
        "building[0].floor_mass[1]",
        "must not be negative, found -1 kg",
    ),
    (
        |m| {
            let f = frame_of(m);
            f.beam_mass.fill(0.0);
            f.columns.iter_mut().for_each(|c| c.line_mass = 0.0);
        },
        "building[0].floor_mass",
        "every floor needs some mass",
    ),
    (
        |m| frame_of(m).column_segments = 0,
        "building[0].column_segments",
        "between 1 and 64, found 0",
    ),
    (
        |m| frame_of(m).column_segments = 65,
        "building[0].column_segments",
        "between 1 and 64, found 65",
    ),
    (
        |m| {
            frame_of(m).beam_segments.pop();
        },
        "building[0].beam_segments",
        "has 1 entries for 2 spans",
    ),
    (
        |m| frame_of(m).beam_segments[1] = 0,
        "building[0].beam_segments[1]",
        "between 1 and 64, found 0",
    ),
    (
        |m| frame_of(m).joint.rotational_stiffness = Some(0.0),
        "building[0].joint.rotational_stiffness",
        "found 0 N.m/rad",
    ),
    (
        |m| {
            let s = shear_of(m);
            s.mass.clear();
            s.stiffness.clear();
            s.storey_heights.clear();
        },
        "building[1].mass",
        "at least one floor",
    ),
    (
        |m| {
            shear_of(m).stiffness.pop();
        },
        "building[1].stiffness",
        "has 3 entries for 4 floors",
    ),
    (
        |m| {
            shear_of(m).storey_heights.pop();
        },
        "building[1].storey_height",
        "has 3 entries for 4 floors",
    ),
    (
        |m| shear_of(m).mass[0] = 0.0,
        "building[1].mass[0]",
        "found 0 kg",
    ),
    (
        |m| shear_of(m).stiffness[2] = -1.0,
        "building[1].stiffness[2]",
        "found -1 N/m",
    ),
    (
        |m| m.gaps[0].set_width(-1e-3),
        "gap[0].width",
        "found -0.001 m; touching buildings have a gap of zero",
    ),
    (
        |m| m.gaps[0].set_width(f64::NAN),
        "gap[0].width",
        "must not be negative",
    ),
    (
        |m| m.gaps[0].between = [Some(1), Some(2)],
        "gap[0].between",
        "two neighbouring buildings",
    ),
    (
        |m| {
            let twin = m.gaps[0].clone();
            m.gaps.push(twin);
        },
        "gap[1].between",
        "repeats gap[0] in every respect; keep one",
    ),
    (
        |m| m.gaps[0].between = [None, Some(1)],
        "gap[0].between",
        "a wall on the left stands before the first building",
    ),
    (
        |m| m.gaps[0].between = [Some(0), None],
        "gap[0].between",
        "a wall on the right stands behind the last building",
    ),
    (
        |m| m.gaps[0].between = [None, None],
        "gap[0].between",
        "must name a building on at least one side",
    ),
    (
        |m| m.gaps[0].widths = vec![0.1, 0.2],
        "gap[0].width",
        "has 2 entries for 3 contacts; give one width, or one per contact",
    ),
    (
        |m| m.gaps[0].widths = vec![0.1, -0.2, 0.1],
        "gap[0].width[1]",
        "found -0.2 m",
    ),
    (
        |m| m.gaps[0].level_tolerance = 0.0,
        "gap[0].level_tolerance",
        "must be greater than zero, found 0 m",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Listed(vec![[Level::Wall, Level::Floor(1)]]),
        "gap[0].floors[0]",
        "names the wall where \"frame\" stands",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Listed(vec![[Level::Height(3.21), Level::Floor(1)]]),
        "gap[0].floors[0]",
        "a column cannot be hit nearer than 20 mm to its ends",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Listed(vec![[Level::Height(99.0), Level::Floor(1)]]),
        "gap[0].floors[0]",
        "that is above its roof",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Heights(vec![f64::NAN]),
        "gap[0].floors[0]",
        "\"frame\" has no floor at NaN m",
    ),
    (
        |m| {
            m.links.push(Link {
                between: [None, Some(0)],
                floors: FloorPairs::Heights(vec![1.1]),
                ..link(1e6, 0.0)
            });
            m.gaps.push(jostle::Gap {
                floors: FloorPairs::Heights(vec![1.11]),
                ..jostle::Gap::between([None, Some(0)], 0.1, m.gaps[0].law)
            });
        },
        "link[0].floors",
        "is only 10.0 mm from another point of the same face",
    ),
    (
        |m| m.links.push(link(-1.0, 0.0)),
        "link[0].stiffness",
        "must not be negative, found -1 N/m",
    ),
    (
        |m| m.links.push(link(0.0, f64::INFINITY)),
        "link[0].damping",
        "found inf N.s/m",
    ),
    (
        |m| m.links.push(link(0.0, 0.0)),
        "link[0].stiffness",
        "and damping are both zero",
    ),
    (
        |m| {
            m.links.push(Link {
                between: [Some(1), Some(0)],
                ..link(1e6, 0.0)
            });
        },
        "link[0].between",
        "must name two neighbouring buildings",
    ),
    (
        |m| {
            m.links.push(Link {
                floors: FloorPairs::listed(&[(9, 9)]),
                ..link(1e6, 0.0)
            });
        },
        "link[0].floors[0]",
        "floor 9 does not exist",
    ),
    (
        |m| m.buildings[0].name = "wall".into(),
        "building[0].name",
        "stands for a rigid wall",
    ),
    (
        |m| m.gaps[0].law.stiffness = 0.0,
        "gap[0].stiffness",
        "found 0 N/m^1.5",
    ),
    (
        |m| {
            m.gaps[0].law = law(LawKind::Linear, 1.0);
            m.gaps[0].law.stiffness = -1.0;
        },
        "gap[0].stiffness",
        "found -1 N/m",
    ),
    (
        |m| m.gaps[0].law.restitution = 0.0,
        "gap[0].restitution",
        "greater than 0 and at most 1, found 0",
    ),
    (
        |m| m.gaps[0].law.restitution = 1.1,
        "gap[0].restitution",
        "found 1.1",
    ),
    (
        |m| m.gaps[0].law.restitution = f64::NAN,
        "gap[0].restitution",
        "found NaN",
    ),
    (
        |m| {
            m.gaps[0].law = law(LawKind::KelvinNoTension, 0.1);
            m.gaps[0].law.restitution_is = RestitutionIs::Realised;
        },
        "gap[0].restitution",
        "cannot be realised by kelvin-no-tension below 0.1353",
    ),
    (
        |m| {
            shear_of(m).storey_heights.fill(3.0);
        },
        "gap[0].floors",
        "no floors of \"frame\" and \"tower\" lie at equal height; floors of \"tower\" can hit columns of \"frame\": list the pairs, as floors = [[\"3.000 m\", 1], …]; or describe \"tower\" as a frame, or raise level_tolerance if slabs overlap",
    ),
    (
        |m| {
            m.gaps[0].floors = FloorPairs::All;
            shear_of(m).storey_heights.fill(3.0);
        },
        "gap[0].floors",
        "\"all\" needs columns that can be hit, and \"tower\" has none at 3.200 m, where \"frame\" has a floor; floors of \"tower\" can hit columns of \"frame\": list the pairs, as floors = [[\"3.000 m\", 1], …]; or describe \"tower\" as a frame",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::listed(&[]),
        "gap[0].floors",
        "is empty; list the pairs",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::listed(&[(1, 1), (4, 4)]),
        "gap[0].floors[1]",
        "floor 4 does not exist: \"frame\" has floors 1 to 3",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::listed(&[(0, 1)]),
        "gap[0].floors[0]",
        "floor 0 is the mat of an isolated building, and \"frame\" has no isolation",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::listed(&[(1, 2)]),
        "gap[0].floors[0]",
        "floor 1 of \"frame\" is at 3.200 m and floor 2 of \"tower\" is at 6.400 m; both must be at equal height",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::listed(&[(1, 1), (1, 1)]),
        "gap[0].floors[1]",
        "the pair [1, 1] is listed twice",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Heights(vec![]),
        "gap[0].floors",
        "is empty; list the heights",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Heights(vec![3.2, 4.0]),
        "gap[0].floors[1]",
        "\"tower\" has no floor at 4.000 m (nearest: 3.200 m), and no columns that can be hit between floors",
    ),
    (
        |m| m.gaps[0].floors = FloorPairs::Heights(vec![1.6]),
        "gap[0].floors[0]",
        "\"tower\" has no floor at 1.600 m (nearest: 3.200 m)",
    ),
    (
        |m| m.analysis.step = Some(0.0),
        "analysis.step",
        "between 1e-7 s and 0.1 s, found 0 s",
    ),
    (
        |m| m.analysis.step = Some(f64::NAN),
        "analysis.step",
        "between 1e-7 s and 0.1 s",
    ),
    (
        |m| m.analysis.contact_step = Some(0.2),
        "analysis.contact_step",
        "found 0.2 s",
    ),
    (
        |m| {
            m.analysis.step = Some(1e-3);
            m.analysis.contact_step = Some(2e-3);
        },
        "analysis.contact_step",
        "must not exceed step",
    ),
    (
        |m| m.analysis.tolerance = 0.0,
        "analysis.tolerance",
        "must lie between 1e-6 and 0.1",
    ),
    (
        |m| m.analysis.energy_tolerance = 2.0,
        "analysis.energy_tolerance",
        "must lie between 1e-15 and 1",
    ),
];

#[test]
fn a_sound_model_is_accepted() {
    assert_eq!(sound().check(), Ok(()));
    assert!(System::assemble(&sound()).is_ok(), "it can be assembled");
}

#[test]
fn bad_models_are_refused_at_the_field_and_in_words() {
    for (number, (spoil, path, text)) in CASES.iter().enumerate() {
        let mut model = sound();
        spoil(&mut model);
        let faults = model
            .check()
            .expect_err(&format!("case {number}, {path}: {text}"));
        let found = faults
            .iter()
            .any(|fault| fault.path == *path && fault.problem.contains(text));
        assert!(
            found,
            "case {number}: expected {path}: {text}\nfound {faults:#?}"
        );
        assert_eq!(
            System::assemble(&model).err(),
            Some(faults),
            "case {number}: assembly refuses it alike"
        );
    }
}

#[test]
fn all_faults_are_reported_at_once() {
    let mut model = sound();
    frame_of(&mut model).spans[0] = 0.0;
    shear_of(&mut model).mass[3] = -1.0;
    model.gaps[0].set_width(-1.0);
    model.analysis.tolerance = 1.0;
    let faults = model.check().expect_err("four faults");
    let paths: Vec<&str> = faults.iter().map(|fault| fault.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "building[0].spans[0]",
            "building[1].mass[3]",
            "gap[0].width",
            "analysis.tolerance"
        ]
    );
}

#[test]
fn damping_at_a_mode_that_does_not_exist_is_refused() {
    let mut model = sound();
    model.buildings[1].damping = ratio(0.05, &[1, 40]);
    let faults = System::assemble(&model).expect_err("the tower has four modes");
    assert_eq!(faults[0].path, "building[1].damping.modes");
    assert!(
        faults[0].problem.contains("lateral mode 40 does not exist"),
        "{}",
        faults[0].problem
    );
}

#[test]
fn unnamed_modes_are_the_first_and_the_third_as_far_as_they_exist() {
    for (floors, named) in [(1, vec![1]), (2, vec![1, 2]), (4, vec![1, 3])] {
        let coefficients = |modes: &[usize]| {
            let mut tower = tower("tower", floors, 3e4, 0.6);
            tower.damping = ratio(0.05, modes);
            let system = System::assemble(&row(vec![tower], 0.05, law(LawKind::Hertz, 1.0)));
            let equations = &system.expect("a sound model").buildings[0].equations;
            (equations.alpha, equations.beta)
        };
        assert_eq!(coefficients(&[]), coefficients(&named), "{floors} floors");
    }
}

#[test]
fn masses_without_a_finite_sum_are_a_fault_with_their_cause() {
    let mut model = sound();
    shear_of(&mut model).mass = vec![1e308; 4];
    let faults = System::assemble(&model).map(|_| ());
    let faults = faults.expect_err("no sum");
    assert_eq!(faults[0].path, "building[1]");
    for part in ["its mass is inf kg", "masses of 1.00e308 kg"] {
        assert!(faults[0].problem.contains(part), "{}", faults[0].problem);
    }
}

#[test]
fn a_run_of_more_work_than_allowed_is_refused_with_what_makes_it_long() {
    let plan = |model: &Model| {
        let system = System::assemble(model).expect("sound");
        Plan::choose(&system, &still(30.0), &model.analysis).map_err(|faults| faults[0].clone())
    };
    let mut model = sound();
    assert!(plan(&model).is_ok());
    shear_of(&mut model).stiffness = vec![1e28; 4];
    let fault = plan(&model).expect_err("some 1e14 steps");
    assert_eq!(fault.path, "building[1]");
    for part in ["a lateral period of \"tower\" is", "up to 1.00e28 N/m"] {
        assert!(fault.problem.contains(part), "{}", fault.problem);
    }
    model.analysis.most_work = f64::INFINITY;
    assert!(plan(&model).is_ok());

    let mut model = sound();
    model.analysis.step = Some(1e-5);
    model.analysis.contact_step = Some(1e-6);
    assert!(plan(&model).is_ok());
    model.analysis.most_work = 1e6;
    let fault = plan(&model).expect_err("3e6 steps");
    assert_eq!(fault.path, "analysis.step");
}
