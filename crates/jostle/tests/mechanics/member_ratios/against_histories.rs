//! Greatest ratios against the forces of the same run, and by two ways of stepping.

use jostle::model::CapacityLine;
use jostle::{FrameHinges, Hinges, Model, Outcome, Solver, System};

use crate::member_ratios::support::{model, run};

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
            let capacity = &model.analysis.members.capacities[at];
            let count = system.buildings[*building].members.members[*member]
                .sections
                .len();
            for [axial, shear, moment, ..] in sections.by_ref().take(count) {
                let compression = capacity.compression_at_rest
                    - if capacity.follows_axial { *axial } else { 0.0 };
                for (rule, found) in capacity.rules.iter().zip(&mut all[at]) {
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
    for (capacity, due) in model.analysis.members.capacities.iter().zip(due) {
        let mut members = summary
            .buildings
            .iter()
            .flat_map(|building| &building.members);
        let member = members
            .find(|member| member.name == capacity.member)
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
            let capacities = model.analysis.members.capacities.iter();
            let member_capacity = capacities
                .clone()
                .find(|candidate| candidate.member == member.name)
                .expect("rated");
            member.at_worst.iter().map(move |forces| {
                let axial = if member_capacity.follows_axial {
                    forces.axial_n
                } else {
                    0.0
                };
                let compression = member_capacity.compression_at_rest - axial;
                let rule = &member_capacity.rules[0];
                let strength = rule.shear.as_ref().expect("given").at(compression, 1.0);
                let bending = rule.bending_ratio(compression, [forces.moment_n_m, 0.0]);
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
        let greatest = |building: &jostle::results::summary::BuildingSummary| {
            building
                .capacity
                .as_ref()
                .map(|capacity| capacity.worst.ratio)
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
    for (capacity, due) in model.analysis.members.capacities.iter().zip(plain).take(9) {
        let mut members = summary.buildings[0].members.iter();
        let Some(member) = members.find(|m| m.name == capacity.member && m.name.contains("column"))
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
