//! Envelopes of members in summaries, against the recorded forces of the same run, with contact and without; forces of columns
//! that yield, against their own equilibrium.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::results::summary::SectionSummary;
use jostle::{Damping, FrameHinges, Hinges, Solver, Structure, Summary};

use crate::member_ratios::places::Recorded;
use crate::member_ratios::support::{model, run};

/// Greatest and least axial force, and greatest shear and moment of either sign, section by section; the sections of struck points
/// with the impacts on them; peaks of members with contact beside those without.
#[test]
fn envelopes_are_those_of_the_histories() {
    let with = model();
    let mut apart = with.clone();
    apart.gaps[0].widths = vec![9.0];
    let (system, outcome, _) = run(&with, Solver::Riccati);
    let (_, without, lone) = run(&apart, Solver::Riccati);
    let plan = jostle::Plan::choose(
        &system,
        &jostle::GroundMotion::sampled("none", 0.01, vec![0.0; 9]),
        &with.analysis,
    );
    let summary = Summary::new(&jostle::Run {
        model: &with,
        system: &system,
        motion: &jostle::GroundMotion::sampled("none", 0.01, vec![0.0; 9]),
        plan: &plan.expect("planned"),
        outcome: &outcome,
        without_contact: Some(&without),
        wall: 0.0,
    });
    let histories = Recorded::all(&system, &outcome);
    let (mut struck, mut one_sided) = (0, 0);
    for (index, building) in summary.buildings.iter().enumerate() {
        for (place, member) in building.members.iter().enumerate() {
            let rows = &histories[&member.name].0;
            let mut check = |section: &SectionSummary| {
                let here = || rows.iter().filter(|(_, at, _)| *at == section.at);
                let extreme = |kind: usize, sign: f64| {
                    let values = here().map(|(.., forces)| sign * forces[kind]);
                    sign * values.fold(f64::NEG_INFINITY, f64::max)
                };
                let size = |kind: usize| extreme(kind, 1.0).max(-extreme(kind, -1.0));
                let due = [extreme(0, 1.0), extreme(0, -1.0), size(1), size(2)];
                let found = [
                    section.axial_max_n,
                    section.axial_min_n,
                    section.shear_peak_n,
                    section.moment_peak_n_m,
                ];
                assert_eq!(found, due, "{} {}", member.name, section.at);
                one_sided += usize::from(size(2) > 1.01 * extreme(2, 1.0));
            };
            member.ends.iter().for_each(&mut check);
            for level in &member.struck {
                check(&level.below);
                check(&level.above);
                let here = outcome.impacts.iter().filter(|impact| {
                    let contact = &system.contacts[impact.contact];
                    (contact.height - level.height_m).abs() < 1e-6
                });
                let force = here.clone().map(|impact| impact.peak_force);
                assert_eq!(
                    level.peak_force_n,
                    force.fold(0.0, f64::max),
                    "{}",
                    member.name
                );
                assert!(level.impact_count > 0 && level.impact_count <= here.count());
                struck += 1;
            }
            // Columns of line 3 of A alone are struck; greatest compression, shear and moment of all sections.
            let greatest = |name: &str, summary: &Summary| {
                let member = &summary.buildings[index].members[place];
                assert_eq!(member.name, name);
                let sections = member
                    .struck
                    .iter()
                    .flat_map(|struck| [&struck.below, &struck.above]);
                let mut all = [0.0_f64; 3];
                for end in member.ends.iter().chain(sections) {
                    all[0] = all[0].max(-end.axial_min_n);
                    all[1] = all[1].max(end.shear_peak_n);
                    all[2] = all[2].max(end.moment_peak_n_m);
                }
                all
            };
            let compared = member.compared.as_ref().expect("both runs");
            let found = [
                compared.compression_peak_n,
                compared.shear_peak_n,
                compared.moment_peak_n_m,
            ];
            assert_eq!(found, greatest(&member.name, &summary), "{}", member.name);
            let found = [
                compared.compression_peak_without_contact_n,
                compared.shear_peak_without_contact_n,
                compared.moment_peak_without_contact_n_m,
            ];
            assert_eq!(found, greatest(&member.name, &lone), "{}", member.name);
        }
    }
    assert_eq!(struck, 2);
    assert!(
        one_sided > 5,
        "negative moments govern somewhere: {one_sided}"
    );
}

/// Without mass along a column, its shear times its length is the moment at its head less that at its foot, hinges that yield or
/// not.
#[test]
fn yielding_columns_are_in_equilibrium() {
    let mut model = model();
    model.gaps.clear();
    let corners = Corners::bilinear(5e4, 0.02);
    let backbone = Backbone::from_forces(5e9, corners, corners).expect("sound");
    let hinge = Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound");
    model.buildings[0].hinges = Some(Hinges::Frame(FrameHinges {
        columns: vec![vec![hinge; 3]; 3],
        beams: Vec::new(),
        ..FrameHinges::default()
    }));
    for building in &mut model.buildings {
        let Structure::Frame(frame) = &mut building.structure else {
            panic!("a frame")
        };
        for column in &mut frame.columns {
            column.line_mass = 0.0;
        }
        frame.column_segments = 1;
        // Members have no damping of their own.
        building.damping = Damping::Rayleigh {
            alpha: 0.5,
            beta: 0.0,
        };
    }
    let (system, outcome, summary) = run(&model, Solver::Riccati);
    assert!(summary.buildings[0].hinges.yielded > 3);
    let histories = Recorded::all(&system, &outcome);
    for (name, rows) in &histories {
        if !name.contains("column") {
            continue;
        }
        let first = name.starts_with('B') && name.ends_with(".1");
        let length = if first { 4.5 } else { 3.2 };
        let most = rows
            .0
            .iter()
            .fold(0.0_f64, |most, row| most.max(row.2[2].abs()));
        assert!(most > 1e4, "{name}: {most}");
        for ends in rows.0.chunks(2) {
            let [(_, "foot", foot), (_, "head", head)] = ends else {
                panic!("two ends: {ends:?}")
            };
            let off = foot[1] * length - (head[2] - foot[2]);
            assert!(off.abs() < 1e-6 * most, "{name}: {off} of {most}");
            assert!((foot[1] - head[1]).abs() < 1e-6 * most);
        }
    }
}
