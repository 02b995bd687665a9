//! Demands over capacities of columns and beams, against the forces of the same run and by two ways of stepping.

use std::ops::ControlFlow;

use jostle::model::{
    CapacityLine, MemberCapacity, RotationLimits, RotationMeasure, RuleCapacity, ShearCapacity,
};
use jostle::{
    Analysis, Axial, Base, Building, ContactLaw, Damping, FloorPairs, Frame, FrameHinges, Gap,
    Gravity, GroundMotion, Hinges, Joint, LawKind, Level, MemberRequest, Model, Outcome, Plan,
    RestitutionIs, RunEnd, Section, Settings, Solver, Structure, Summary, System, simulate,
};

fn section(rigidity: f64) -> Section {
    Section {
        flexural_rigidity: rigidity,
        axial_rigidity: Some(4e9),
        line_mass: 600.0,
        shear_rigidity: None,
    }
}

fn building(name: &str, storeys: usize, first: f64, rigidity: f64) -> Building {
    let mut heights = vec![3.2; storeys];
    heights[0] = first;
    Building {
        name: name.to_owned(),
        structure: Structure::Frame(Frame {
            storey_heights: heights,
            spans: vec![6.0, 5.0],
            columns: vec![section(rigidity); storeys],
            beams: vec![section(2.0e8); storeys],
            beam_mass: vec![5000.0; storeys],
            floor_mass: vec![9000.0; storeys],
            column_segments: 2,
            beam_segments: vec![3; 2],
            axial: Axial::default(),
            joint: Joint::default(),
        }),
        damping: Damping::Ratio {
            ratio: 0.05,
            modes: Vec::new(),
        },
        base: Base::default(),
        gravity: Gravity::default(),
        hinges: None,
    }
}

/// Capacities that depend on the axial force, with another rule beside the governing one.
fn capacity(member: String, at_rest: f64) -> MemberCapacity {
    let shear = |factor: f64| ShearCapacity {
        steady: CapacityLine::new(vec![
            [-4e5, 2e4 * factor],
            [0.0, 1e5 * factor],
            [6e5, 2e5 * factor],
        ]),
        degrading: CapacityLine::new(vec![[0.0, 5e4 * factor], [8e5, 9e4 * factor]]),
        by_ductility: CapacityLine::new(vec![[2.0, 1.0], [6.0, 0.7]]),
        limit: 2.5e5 * factor,
    };
    let bending = |factor: f64| {
        let points = [[-6e5, 2e4], [0.0, 1.2e5], [5e5, 2.2e5], [2e6, 3e4]];
        CapacityLine::new(points.map(|[n, m]| [n, factor * m]).to_vec())
    };
    let rule = |rule, factor| RuleCapacity {
        rule,
        shear: Some(shear(factor)),
        bending: [bending(factor), bending(0.8 * factor)],
    };
    MemberCapacity {
        follows_axial: member.contains("column"),
        member,
        compression_at_rest: at_rest,
        axial_failure_drift: CapacityLine::new(vec![[0.0, 0.05], [1e6, 0.03]]),
        rotations: [RotationMeasure::Plastic, RotationMeasure::Chord]
            .map(|measure| RotationLimits {
                rule: "limits",
                measure,
                limits: vec![("low", 1e-3), ("high", 0.5)],
            })
            .to_vec(),
        rules: vec![rule("first", 1.0), rule("second", 2.0)],
    }
}

fn model() -> Model {
    let left = building("A", 3, 3.2, 1.5e8);
    let right = building("B", 2, 4.5, 4e8);
    let mut members = MemberRequest::all();
    for (name, storeys) in [("A", 3), ("B", 2)] {
        for storey in 1..=storeys {
            for line in 1..=3 {
                let carried = 9e4 * (storeys + 1 - storey) as f64;
                members
                    .capacities
                    .push(capacity(format!("{name}.column.{line}.{storey}"), carried));
            }
            for span in 1..=2 {
                members
                    .capacities
                    .push(capacity(format!("{name}.beam.{storey}.{span}"), 0.0));
            }
        }
    }
    members.histories = members
        .capacities
        .iter()
        .map(|c| c.member.clone())
        .collect();
    Model {
        title: "Floors against columns".to_owned(),
        buildings: vec![left, right],
        gaps: vec![Gap {
            floors: FloorPairs::Listed(vec![
                [Level::Height(4.5), Level::Floor(1)],
                [Level::Height(7.7), Level::Floor(2)],
            ]),
            ..Gap::after(
                0,
                0.005,
                ContactLaw {
                    kind: LawKind::HertzDamp,
                    stiffness: 2e9,
                    restitution: 0.65,
                    restitution_is: RestitutionIs::Realised,
                },
            )
        }],
        links: Vec::new(),
        walls: Vec::new(),
        soil: None,
        analysis: Analysis {
            members,
            ..Analysis::default()
        },
    }
}

fn run(model: &Model, solver: Solver) -> (System, Outcome, Summary) {
    let system = System::assemble(model).expect("sound");
    let wave = (0..=200).map(|i| {
        let t = 0.01 * f64::from(i);
        4.0 * (7.0 * t).sin() + 2.0 * (23.0 * t).cos()
    });
    let motion = GroundMotion::sampled("two sines", 0.01, wave.collect());
    let analysis = Analysis {
        solver: Some(solver),
        ..model.analysis.clone()
    };
    let plan = Plan::choose(&system, &motion, &analysis).expect("planned");
    let settings = Settings {
        record_interval: Some(0.0),
        ..Settings::default()
    };
    let outcome = simulate(&system, &motion, &plan, settings, |_| {
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.end, RunEnd::Completed);
    let summary = Summary::new(&jostle::Run {
        model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: 0.0,
    });
    (system, outcome, summary)
}

/// Greatest ratios of shear and bending over the recorded instants, and the first excess of either, by member and rule:
/// written out from the forces, with another interpolation.
fn from_histories(model: &Model, system: &System, outcome: &Outcome) -> Vec<[[f64; 3]; 2]> {
    let interpolate = |line: &CapacityLine, x: f64| {
        let points = line.points();
        let mut value = points[0][1];
        for ends in points.windows(2) {
            let share = ((x - ends[0][0]) / (ends[1][0] - ends[0][0])).clamp(0.0, 1.0);
            value += share * (ends[1][1] - ends[0][1]);
        }
        value
    };
    let history = outcome.member_history.as_ref().expect("asked for");
    let mut all = vec![[[0.0, 0.0, f64::INFINITY]; 2]; model.analysis.members.capacities.len()];
    for (time, row) in history.times().iter().zip(history.rows()) {
        let mut sections = row.iter();
        for (at, [building, member]) in history.members().iter().enumerate() {
            let own = &model.analysis.members.capacities[at];
            let count = system.buildings[*building].members.members[*member]
                .sections
                .len();
            for [axial, shear, moment, ..] in sections.by_ref().take(count) {
                let compression =
                    own.compression_at_rest - if own.follows_axial { *axial } else { 0.0 };
                for (rule, found) in own.rules.iter().zip(&mut all[at]) {
                    let by_shear = rule.shear.as_ref().expect("given");
                    let strength = interpolate(&by_shear.steady, compression)
                        + interpolate(&by_shear.degrading, compression);
                    let side = &rule.bending[usize::from(*moment < 0.0)];
                    let ratios = [
                        shear.abs() / strength.min(by_shear.limit),
                        bending_ratio(|n| interpolate(side, n), compression, moment.abs()),
                    ];
                    found[0] = found[0].max(ratios[0]);
                    found[1] = found[1].max(ratios[1]);
                    if ratios[0].max(ratios[1]) > 1.0 {
                        found[2] = found[2].min(*time);
                    }
                }
            }
        }
    }
    all
}

/// The moment over its capacity; beyond that at most the factor by which the point is outside, by bisection on the ray.
fn bending_ratio(capacity: impl Fn(f64) -> f64, compression: f64, moment: f64) -> f64 {
    let ratio = moment / capacity(compression);
    if ratio <= 1.0 {
        return ratio;
    }
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..60 {
        let share = 0.5 * (inside + outside);
        if share * moment < capacity(share * compression) {
            inside = share;
        } else {
            outside = share;
        }
    }
    ratio.min(1.0 / inside)
}

fn compare(solver: Solver, above: f64) {
    let model = model();
    let (system, outcome, summary) = run(&model, solver);
    let due = from_histories(&model, &system, &outcome);
    let mut exceeded = 0;
    for (own, due) in model.analysis.members.capacities.iter().zip(due) {
        let mut members = summary
            .buildings
            .iter()
            .flat_map(|building| &building.members);
        let member = members
            .find(|member| member.name == own.member)
            .expect("reported");
        let ratios = member.ratio.iter().chain(&member.other_ratios);
        for (ratio, [shear, bending, first]) in ratios.zip(due) {
            let name = &member.name;
            for (found, due) in [
                (ratio.shear.expect("given"), shear),
                (ratio.bending, bending),
            ] {
                assert!(found >= due * (1.0 - 1e-9), "{name}: {found} below {due}");
                assert!(found <= due * (1.0 + above), "{name}: {found} above {due}");
            }
            let at = ratio.shear_at.as_ref().expect("given");
            let again = at.demand.abs() / at.capacity;
            assert!((again / ratio.shear.expect("given") - 1.0).abs() < 1e-9);
            let firsts = [at.exceeded_s, ratio.bending_at.exceeded_s]
                .into_iter()
                .flatten();
            let found = firsts.fold(f64::INFINITY, f64::min);
            assert!(found <= first, "{name}: {found} after {first}");
            assert!(
                first == f64::INFINITY || first - found < 0.011,
                "{name}: {found} long before {first}"
            );
            exceeded += usize::from(first < f64::INFINITY);
        }
        assert_eq!(ratio_rules(member), ["first", "second"]);
    }
    assert!(
        exceeded > 5,
        "only {exceeded} members exceed their capacity: the test is too weak"
    );
    // The first to exceed, and an impact named where one was in progress.
    for building in &summary.buildings {
        let capacity = building.capacity.as_ref().expect("rated");
        let first = capacity.first.as_ref().expect("some exceed");
        let earliest = building.members.iter().filter_map(|member| {
            let ratio = member.ratio.as_ref()?;
            let at = [
                ratio.shear_at.as_ref()?.exceeded_s,
                ratio.bending_at.exceeded_s,
            ];
            at.into_iter().flatten().min_by(f64::total_cmp)
        });
        assert_eq!(Some(first.at_s), earliest.min_by(f64::total_cmp));
        let worst = building.members.iter().filter_map(|member| {
            let ratio = member.ratio.as_ref()?;
            Some(ratio.bending.max(ratio.shear?))
        });
        assert_eq!(capacity.worst.ratio, worst.fold(0.0, f64::max));
        // Forces of the worst instant give the greatest ratio again: at the end of the step it may be a little less.
        let found = building.members.iter().flat_map(|member| {
            let own = model.analysis.members.capacities.iter();
            let own = own
                .clone()
                .find(|own| own.member == member.name)
                .expect("rated");
            member.at_worst.iter().map(move |forces| {
                let axial = if own.follows_axial {
                    forces.axial_n
                } else {
                    0.0
                };
                let compression = own.compression_at_rest - axial;
                let rule = &own.rules[0];
                let strength = rule.shear.as_ref().expect("given").at(compression, 1.0);
                let bending = rule.bending_ratio(compression, forces.moment_n_m);
                (forces.shear_n.abs() / strength).max(bending)
            })
        });
        let found = found.fold(0.0, f64::max);
        let due = capacity.worst.ratio;
        assert!(
            found <= due * (1.0 + 1e-9) && found > due * (1.0 - above.max(1e-9)),
            "{found} for {due}"
        );
        let struck = building
            .members
            .iter()
            .filter_map(|member| member.ratio.as_ref());
        for at in struck.filter_map(|ratio| ratio.shear_at.as_ref()) {
            let busy = outcome
                .impacts
                .iter()
                .any(|impact| (impact.start..=impact.end).contains(&at.at_s));
            assert_eq!(at.impact.is_some(), busy);
        }
    }
}

fn ratio_rules(member: &jostle::results::summary::MemberSummary) -> Vec<&'static str> {
    member
        .ratio
        .iter()
        .chain(&member.other_ratios)
        .map(|ratio| ratio.rule)
        .collect()
}

#[test]
fn direct_runs_rate_every_step() {
    // Every step is recorded, so that both see the same instants.
    compare(Solver::Riccati, 1e-9);
}

#[test]
fn modal_runs_miss_no_ratio() {
    // Modal stepping also looks between the recorded ends of its steps.
    compare(Solver::Modal, 0.15);
}

#[test]
fn both_ways_agree() {
    let model = model();
    let [direct, modal] = [Solver::Riccati, Solver::Modal].map(|solver| run(&model, solver).2);
    for (a, b) in direct.buildings.iter().zip(&modal.buildings) {
        let greatest = |own: &jostle::results::summary::BuildingSummary| {
            own.capacity.as_ref().map(|capacity| capacity.worst.ratio)
        };
        let (Some(x), Some(y)) = (greatest(a), greatest(b)) else {
            panic!("not rated")
        };
        for (a, b) in a.members.iter().zip(&b.members) {
            let (Some(a), Some(b)) = (&a.ratio, &b.ratio) else {
                panic!("not rated")
            };
            // Ratios are as exact as forces: to a few tolerances of the greatest.
            let off = (a.bending - b.bending).abs() / x;
            assert!(off < 0.02, "{} and {}", a.bending, b.bending);
            let off = (a.shear.expect("given") - b.shear.expect("given")).abs() / y;
            assert!(off < 0.02, "{:?} and {:?}", a.shear, b.shear);
        }
    }
}

#[test]
fn ductility_lowers_the_shear_capacity() {
    use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
    let mut model = model();
    let corners = Corners {
        cracking: 2e4,
        yielding: 5e4,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    let hinge = |rigidity: f64, length: f64| {
        let backbone = Backbone::from_forces(100.0 * rigidity / length, corners, corners);
        Hysteresis::new(HysteresisRule::PeakOriented, backbone.expect("sound")).expect("sound")
    };
    model.buildings[0].hinges = Some(Hinges::Frame(FrameHinges {
        columns: vec![vec![hinge(1.5e8, 3.2); 3]; 3],
        beams: Vec::new(),
        ..FrameHinges::default()
    }));
    let (system, outcome, summary) = run(&model, Solver::Riccati);
    let hinges = &summary.buildings[0].hinges;
    assert!(hinges.ductility > 3.0, "{}", hinges.ductility);
    // Without degradation every ratio is that of the histories; with it none is smaller, and some are greater.
    let plain = from_histories(&model, &system, &outcome);
    let mut greater = 0;
    for (own, due) in model.analysis.members.capacities.iter().zip(plain).take(9) {
        let mut members = summary.buildings[0].members.iter();
        let Some(member) = members.find(|m| m.name == own.member && m.name.contains("column"))
        else {
            continue;
        };
        let shear = member
            .ratio
            .as_ref()
            .and_then(|ratio| ratio.shear)
            .expect("given");
        assert!(shear >= due[0][0] * (1.0 - 1e-9));
        // At most the degrading part falls by 30 %.
        assert!(shear <= due[0][0] / 0.7);
        greater += usize::from(shear > due[0][0] * 1.01);
    }
    assert!(greater > 0, "ductility changes nothing");
    // Rotations are those of the hinges: the plastic part is what is beyond yield, 3e4 N·m at 0.3 of the initial slope
    // after the crack.
    let (initial, member) = (100.0 * 1.5e8 / 3.2, 6.0 * 1.5e8 / 3.2);
    let yielding = 2e4 / initial + 3e4 / (0.3 * initial);
    let foot = summary.buildings[0]
        .members
        .iter()
        .find(|m| m.name == "A.column.1.1");
    let [plastic, chord] = &foot.expect("rated").acceptance[..] else {
        panic!("two rules")
    };
    let greatest = |spring: &jostle::results::summary::SpringSummary| {
        spring.deformation_max.max(spring.deformation_min)
    };
    let springs = jostle::springs_of(&system.buildings[0], &outcome);
    let due = springs
        .iter()
        .filter(|spring| spring.place.contains("column 1") && spring.place.contains("storey 1"))
        .map(greatest)
        .fold(0.0, f64::max);
    assert!(due > yielding, "it yields: {due}");
    assert!((plastic.rotation_rad / (due - yielding) - 1.0).abs() < 1e-9);
    let moment = 5e4 + 0.02 * initial * (due - yielding);
    assert!((chord.rotation_rad / (due + moment / member) - 1.0).abs() < 1e-9);
    assert_eq!(
        chord.level,
        Some(if chord.rotation_rad > 1e-3 {
            "high"
        } else {
            "low"
        })
    );
    // Beams of an elastic building have no hinges.
    assert!(
        summary.buildings[1]
            .members
            .iter()
            .all(|m| m.acceptance.is_empty())
    );
}
