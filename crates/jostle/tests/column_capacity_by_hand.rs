//! Demand over capacity of the columns of a portal frame whose forces at every instant follow from statics: the axial force of
//! overturning changes moment and shear capacity at the instant of the moment itself.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use jostle::model::{CapacityLine, MemberCapacity, RuleCapacity, ShearCapacity};
use jostle::results::summary::RatioSummary;
use jostle::{
    Analysis, Axial, Base, Building, ContactLaw, Damping, Frame, Gap, Gravity, GroundMotion, Joint,
    LawKind, MemberRequest, Model, Plan, RestitutionIs, Section, Settings, Solver, Structure,
    Summary, System, simulate,
};

const HEIGHT: f64 = 4.0;
const SPAN: f64 = 2.5;
const COLUMN: f64 = 1.2e8;
const BEAM: f64 = 2.0e8;
const MASS: f64 = 30e3;
/// Compression of both columns at rest \[N\].
const CARRIED: f64 = 2.5e5;
/// Greatest ground acceleration to the left and then to the right \[m/s²\], and how long each takes \[s\].
const LOBES: [f64; 2] = [4.0, -2.7];
const LASTS: f64 = 10.0;

fn portal(name: &str) -> Building {
    let section = |rigidity: f64| Section {
        flexural_rigidity: rigidity,
        axial_rigidity: None,
        line_mass: 0.0,
        shear_rigidity: None,
    };
    Building {
        name: name.to_owned(),
        structure: Structure::Frame(Frame {
            storey_heights: vec![HEIGHT],
            spans: vec![SPAN],
            columns: vec![section(COLUMN)],
            beams: vec![section(BEAM)],
            beam_mass: vec![0.0],
            floor_mass: vec![MASS],
            column_segments: 1,
            beam_segments: vec![1],
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

/// Moment and shear capacity of straight lines over the compression \[N·m, N\].
fn moment_capacity(compression: f64) -> f64 {
    1.4e5 + 0.25 * compression
}

fn shear_capacity(compression: f64) -> f64 {
    8e4 + 0.1 * compression + (6e4 + 0.05 * compression)
}

fn capacity(line: usize) -> MemberCapacity {
    let straight = |start: f64, slope: f64| {
        let at = |compression: f64| [compression, start + slope * compression];
        CapacityLine::new(vec![at(-4e5), at(1e6)])
    };
    let bending = straight(1.4e5, 0.25);
    MemberCapacity {
        member: format!("A.column.{line}.1"),
        compression_at_rest: CARRIED,
        follows_axial: true,
        axial_failure_drift: CapacityLine::default(),
        rotations: Vec::new(),
        rules: vec![RuleCapacity {
            rule: "by hand",
            shear: Some(ShearCapacity {
                steady: straight(8e4, 0.1),
                degrading: straight(6e4, 0.05),
                by_ductility: CapacityLine::default(),
                limit: f64::INFINITY,
            }),
            bending: [bending.clone(), bending],
        }],
    }
}

fn ratios(solver: Solver) -> Vec<RatioSummary> {
    let law = ContactLaw {
        kind: LawKind::Hertz,
        stiffness: 1e9,
        restitution: 1.0,
        restitution_is: RestitutionIs::Realised,
    };
    let mut members = MemberRequest::all();
    members.capacities = vec![capacity(1), capacity(2)];
    let model = Model {
        title: "Portal".to_owned(),
        buildings: vec![portal("A"), portal("B")],
        gaps: vec![Gap::after(0, 5.0, law)],
        links: Vec::new(),
        walls: Vec::new(),
        soil: None,
        analysis: Analysis {
            members,
            solver: Some(solver),
            ..Analysis::default()
        },
    };
    let system = System::assemble(&model).expect("sound");
    let wave = (0..=200).map(|i| {
        let t = 0.1 * f64::from(i);
        let greatest = LOBES[usize::from(t > LASTS)];
        0.5 * greatest * (1.0 - (2.0 * PI * t / LASTS).cos())
    });
    let motion = GroundMotion::sampled("slow", 0.1, wave.collect());
    let plan = Plan::choose(&system, &motion, &model.analysis).expect("planned");
    let outcome = simulate(&system, &motion, &plan, Settings::default(), |_| {
        ControlFlow::Continue(())
    });
    let summary = Summary::new(&jostle::Run {
        model: &model,
        system: &system,
        motion: &motion,
        plan: &plan,
        outcome: &outcome,
        without_contact: None,
        wall: 0.0,
    });
    let members = summary.buildings[0].members.iter();
    members
        .filter(|member| member.name.contains("column"))
        .filter_map(|member| member.ratio.clone())
        .collect()
}

/// Kleinlogel's frame under a force *P* at its beam: with k = (EI_b/L)/(EI_c/h), moment *P h*/2 · (3k + 1)/(6k + 1) at the feet,
/// axial forces ± 3 *P h k*/(*L* (6k + 1)), shear *P*/2. The motion is a hundred times slower than the frame.
fn compare(solver: Solver) {
    let k = BEAM / SPAN / (COLUMN / HEIGHT);
    let at = |acceleration: f64, side: f64| {
        let force = -MASS * acceleration;
        let moment = (0.5 * force * HEIGHT * (3.0 * k + 1.0) / (6.0 * k + 1.0)).abs();
        // A force to the right presses the right column.
        let pressed = side * 3.0 * force * HEIGHT * k / (SPAN * (6.0 * k + 1.0));
        let compression = CARRIED + pressed;
        [
            moment / moment_capacity(compression),
            (0.5 * force).abs() / shear_capacity(compression),
        ]
    };
    let found = ratios(solver);
    assert_eq!(found.len(), 2);
    for (ratio, side) in found.iter().zip([-1.0, 1.0]) {
        let greatest = |kind: usize| {
            // The ratio grows with the acceleration of a lobe: its peak counts.
            let peaks = LOBES.map(|acceleration| at(acceleration, side)[kind]);
            peaks[0].max(peaks[1])
        };
        let shear = ratio.shear.expect("given");
        for (found, due) in [(ratio.bending, greatest(0)), (shear, greatest(1))] {
            assert!((found / due - 1.0).abs() < 2e-3, "{found} instead of {due}");
        }
    }
    // The column in tension is weaker at the same moment: with the axial force at rest both would be equal.
    let [left, right] = [&found[0], &found[1]].map(|ratio| ratio.bending);
    assert!((left / right - 1.0).abs() > 0.2, "{left} and {right}");
}

#[test]
fn direct_runs_take_the_axial_force_of_the_instant() {
    compare(Solver::Riccati);
}

#[test]
fn modal_runs_take_the_axial_force_of_the_instant() {
    compare(Solver::Modal);
}
