//! Shear capacities and rotations of columns that yield, from the deformations of their hinges.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::model::CapacityLine;
use jostle::results::summary::SpringSummary;
use jostle::{FrameHinges, Hinges, Model, Solver, springs_of};

use crate::member_ratios::support::{model, run_until};

/// Moments at cracking and yield, slopes after them over the first, and flexural rigidity and length of the columns.
const CRACKING: f64 = 2e4;
const YIELDING: f64 = 5e4;
const SLOPES: [f64; 2] = [0.3, 0.02];
const RIGIDITY: f64 = 1.5e8;
const LENGTH: f64 = 3.2;
const INITIAL: f64 = 100.0 * RIGIDITY / LENGTH;
/// Stiffness of a column bent in double curvature.
const BEHIND: f64 = 6.0 * RIGIDITY / LENGTH;

fn yielding() -> Model {
    let mut model = model();
    let corners = Corners {
        cracking: CRACKING,
        yielding: YIELDING,
        post_cracking: SLOPES[0],
        post_yield: SLOPES[1],
    };
    let backbone = Backbone::from_forces(INITIAL, corners, corners).expect("sound");
    let hinge = Hysteresis::new(HysteresisRule::PeakOriented, backbone).expect("sound");
    model.buildings[0].hinges = Some(Hinges::Frame(FrameHinges {
        columns: vec![vec![hinge; 3]; 3],
        beams: Vec::new(),
        ..FrameHinges::default()
    }));
    for capacity in &mut model.analysis.members.capacities {
        for shear in capacity
            .rules
            .iter_mut()
            .filter_map(|rule| rule.shear.as_mut())
        {
            shear.by_ductility = CapacityLine::new(vec![[1.0, 1.0], [101.0, 0.0]]);
        }
    }
    model.analysis.step = Some(1e-3);
    model.analysis.contact_step = Some(2e-4);
    model
}

/// Moment and yield rotation on the curve of first loading.
fn moment(rotation: f64) -> f64 {
    let crack = CRACKING / INITIAL;
    let corner = yield_rotation();
    if rotation <= crack {
        INITIAL * rotation
    } else if rotation <= corner {
        CRACKING + SLOPES[0] * INITIAL * (rotation - crack)
    } else {
        YIELDING + SLOPES[1] * INITIAL * (rotation - corner)
    }
}

fn yield_rotation() -> f64 {
    CRACKING / INITIAL + (YIELDING - CRACKING) / (SLOPES[0] * INITIAL)
}

/// Greatest rotations of the hinges of a column at foot and head, either side.
fn rotations(springs: &[SpringSummary], line: usize, storey: usize) -> [[f64; 2]; 2] {
    ["foot", "head"].map(|end| {
        let place = format!("column {line}, storey {storey}, {end}");
        let found = springs.iter().find(|spring| spring.place == place);
        let spring = found.expect("a hinge");
        [spring.deformation_max, spring.deformation_min]
    })
}

/// Every column by the greater end and the greater side. Somewhere each of the four governs.
#[test]
fn rotations_are_those_of_the_worst_end_and_side() {
    let model = yielding();
    let (system, outcome, summary) = run_until(&model, Solver::Riccati, 2.0);
    let springs = springs_of(&system.buildings[0], &outcome);
    let mut governs = [0; 4];
    for member in &summary.buildings[0].members {
        let Some((line, storey)) = place(&member.name) else {
            continue;
        };
        let found = rotations(&springs, line, storey);
        let all = found.concat();
        let greatest = (0..4)
            .max_by(|a, b| all[*a].total_cmp(&all[*b]))
            .expect("four");
        governs[greatest] += 1;
        let [plastic, chord] = &member.acceptance[..] else {
            panic!("two rules")
        };
        let turned = all[greatest];
        for (acceptance, due) in [
            (plastic, turned - yield_rotation()),
            (chord, turned + moment(turned) / BEHIND),
        ] {
            assert!(
                (acceptance.rotation_rad - due.max(0.0)).abs() < 1e-9 * turned,
                "{}",
                member.name
            );
            if due > 0.0 {
                assert_eq!(
                    acceptance.at,
                    ["foot", "head"][greatest / 2],
                    "{}",
                    member.name
                );
            }
        }
    }
    let [sides, ends] = [
        [governs[0] + governs[2], governs[1] + governs[3]],
        [governs[0] + governs[1], governs[2] + governs[3]],
    ];
    assert!(
        sides.iter().chain(&ends).all(|count| *count > 0),
        "{governs:?}"
    );
}

fn place(name: &str) -> Option<(usize, usize)> {
    let (line, storey) = name.strip_prefix("A.column.")?.split_once('.')?;
    Some((line.parse().ok()?, storey.parse().ok()?))
}

/// A run that ends at the instant of the greatest ratio has the hinges as they were then: ductility of the worst end and side
/// reduces one part of the strength, from 1 at 1 to 0 at 101.
#[test]
fn shear_ratios_have_the_ductility_of_their_instant() {
    let model = yielding();
    let (_, _, full) = run_until(&model, Solver::Riccati, 2.0);
    let (mut reduced, mut negative) = (0, 0);
    for member in &full.buildings[0].members {
        let Some((line, storey)) = place(&member.name) else {
            continue;
        };
        let ratio = member.ratio.as_ref().expect("rated");
        let at = ratio.shear_at.as_ref().expect("given");
        let (system, outcome, _) = run_until(&model, Solver::Riccati, at.at_s);
        let found = rotations(&springs_of(&system.buildings[0], &outcome), line, storey);
        let ductility = |turned: f64| {
            let bent = |turned: f64| turned + moment(turned) / BEHIND;
            bent(turned) / bent(yield_rotation())
        };
        let side = |side: usize| {
            found
                .iter()
                .map(|rotation| ductility(rotation[side]))
                .fold(0.0, f64::max)
        };
        let most = side(0).max(side(1));
        let factor = 1.0 - 0.01 * (most - 1.0).clamp(0.0, 100.0);
        reduced += usize::from(factor < 0.99);
        negative += usize::from(side(1) > 1.05 * side(0).max(1.0));
        // The lines of the model, at this compression between 0 and 600 kN or in tension.
        let n = at.compression_n;
        let steady = if n < 0.0 {
            1e5 + 0.2 * n
        } else {
            1e5 + n / 6.0
        };
        let degrading = 5e4 + 0.05 * n.max(0.0);
        assert!((-4e5..6e5).contains(&n));
        let due = at.demand.abs() / (steady + factor * degrading);
        let off = (ratio.shear.expect("given") / due - 1.0).abs();
        assert!(
            off < 1e-6,
            "{}: {:?} instead of {due}",
            member.name,
            ratio.shear
        );
    }
    assert!(reduced > 3 && negative > 0, "{reduced} {negative}");
}
