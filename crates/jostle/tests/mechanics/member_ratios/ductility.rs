//! Shear capacities and rotations of columns that yield, from the deformations of their hinges.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::model::CapacityLine;
use jostle::results::summary::{MemberSummary, SpringSummary};
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

/// A hinge of a column: where it is, its greatest rotations to either side, and the stiffness of the column behind it.
type Turned = (&'static str, [f64; 2], f64);

/// The hinges of a column: foot, head, and where it is struck, behind which the part above bends.
fn rotations(springs: &[SpringSummary], member: &MemberSummary) -> Vec<Turned> {
    let (line, storey) = place(&member.name).expect("a column");
    let at = |at: &str| {
        let place = format!("column {line}, storey {storey}, {at}");
        let spring = springs.iter().find(|spring| spring.place == place)?;
        Some([spring.deformation_max, spring.deformation_min])
    };
    let ends = ["foot", "head"].map(|end| (end, at(end).expect("a hinge"), BEHIND));
    let struck = member.struck.iter().enumerate().map(|(index, point)| {
        let turned = at(&format!("struck point {}", index + 1)).expect("a hinge");
        let above = storey as f64 * LENGTH - point.height_m;
        ("below", turned, 6.0 * RIGIDITY / above)
    });
    ends.into_iter().chain(struck).collect()
}

/// Every column by the greatest of its ends, its struck points and both sides. Somewhere each governs.
#[test]
fn rotations_are_those_of_the_worst_end_and_side() {
    let model = yielding();
    let (system, outcome, summary) = run_until(&model, Solver::Riccati, 2.0);
    let springs = springs_of(&system.buildings[0], &outcome);
    let (mut governs, mut struck) = ([0; 4], 0);
    for member in &summary.buildings[0].members {
        if place(&member.name).is_none() {
            continue;
        }
        let all: Vec<(&str, usize, f64, f64)> = rotations(&springs, member)
            .into_iter()
            .flat_map(|(at, turned, behind)| [0, 1].map(|side| (at, side, turned[side], behind)))
            .collect();
        let [plastic, chord] = &member.acceptance[..] else {
            panic!("two rules")
        };
        let greatest = |of: &dyn Fn(f64, f64) -> f64| {
            let rotations = all
                .iter()
                .map(|(at, side, turned, behind)| (*at, *side, of(*turned, *behind)));
            rotations.max_by(|a, b| a.2.total_cmp(&b.2)).expect("some")
        };
        let (at, side, turned) = greatest(&|turned, _| turned);
        match at {
            "below" => struck += 1,
            end => governs[2 * usize::from(end == "head") + side] += 1,
        }
        for (acceptance, (at, _, due)) in [
            (plastic, greatest(&|turned, _| turned - yield_rotation())),
            (
                chord,
                greatest(&|turned, behind| turned + moment(turned) / behind),
            ),
        ] {
            assert!(
                (acceptance.rotation_rad - due.max(0.0)).abs() < 1e-9 * turned,
                "{}",
                member.name
            );
            if due > 0.0 {
                assert_eq!(acceptance.at, at, "{}", member.name);
            }
        }
    }
    let [sides, ends] = [
        [governs[0] + governs[2], governs[1] + governs[3]],
        [governs[0] + governs[1], governs[2] + governs[3]],
    ];
    assert!(
        struck > 0 && sides.iter().chain(&ends).all(|count| *count > 0),
        "{governs:?}, {struck} where they are struck"
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
        if place(&member.name).is_none() {
            continue;
        }
        let ratio = member.ratio.as_ref().expect("rated");
        let at = ratio.shear_at.as_ref().expect("given");
        let (system, outcome, _) = run_until(&model, Solver::Riccati, at.at_s);
        let found = rotations(&springs_of(&system.buildings[0], &outcome), member);
        let ductility = |turned: f64, behind: f64| {
            let bent = |turned: f64| turned + moment(turned) / behind;
            bent(turned) / bent(yield_rotation())
        };
        let side = |side: usize| {
            let hinges = found.iter();
            let hinges = hinges.map(|(_, turned, behind)| ductility(turned[side], *behind));
            hinges.fold(0.0, f64::max)
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
