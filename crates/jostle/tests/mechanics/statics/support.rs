//! Buildings with hinges.

use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::pushover::{LoadPattern, PushDirection, PushSettings, Pushover, pushover};
use jostle::structure::Discretization;
use jostle::system::BuildingSystem;
use jostle::{Building, Frame, FrameHinges, Gravity, Hinges, Section, Shear, Structure};
use jostle_testkit::compare::near;
use jostle_testkit::models::{self, UNDAMPED, bending};

/// A hinge with the same corners on both sides.
pub(crate) fn hinge(rule: HysteresisRule, initial: f64, corners: Corners) -> Hysteresis {
    let backbone = Backbone::from_forces(initial, corners, corners).expect("a sound backbone");
    Hysteresis::new(rule, backbone).expect("the rule fits")
}

/// Elastic, then perfectly plastic.
pub(crate) fn plastic(initial: f64, strength: f64) -> Hysteresis {
    hinge(
        HysteresisRule::Bilinear,
        initial,
        Corners::bilinear(strength, 0.0),
    )
}

pub(crate) fn trilinear(rule: HysteresisRule, initial: f64, strength: f64) -> Hysteresis {
    let corners = Corners {
        cracking: 0.35 * strength,
        yielding: strength,
        post_cracking: 0.3,
        post_yield: 0.02,
    };
    hinge(rule, initial, corners)
}

pub(crate) fn section(flexural_rigidity: f64) -> Section {
    Section {
        axial_rigidity: Some(8e9),
        ..bending(flexural_rigidity)
    }
}

/// A regular frame of storeys 3.2 m high; columns have no mass.
pub(crate) fn frame(storeys: usize, spans: &[f64], beam_mass: f64) -> Frame {
    Frame {
        beam_mass: vec![beam_mass; storeys],
        column_segments: 1,
        beam_segments: vec![4; spans.len()],
        ..models::frame(storeys, spans, section(1.2e8), section(1.5e8))
    }
}

/// The same hinges at all columns, and at all beams.
pub(crate) fn hinged(
    frame: Frame,
    columns: Option<Hysteresis>,
    beams: Option<Hysteresis>,
) -> Building {
    let (storeys, bays) = (frame.storey_heights.len(), frame.spans.len());
    let hinges = FrameHinges {
        columns: columns.map_or_else(Vec::new, |hinge| vec![vec![hinge; bays + 1]; storeys]),
        beams: beams.map_or_else(Vec::new, |hinge| vec![vec![hinge; bays]; storeys]),
        ..FrameHinges::default()
    };
    Building {
        name: "frame".into(),
        structure: Structure::Frame(frame),
        damping: UNDAMPED,
        hinges: Some(Hinges::Frame(hinges)),
        ..Building::default()
    }
}

pub(crate) fn storeys(shear: Shear, springs: Vec<Hysteresis>) -> Building {
    Building {
        name: "shear".into(),
        structure: Structure::Shear(shear),
        damping: UNDAMPED,
        hinges: Some(Hinges::Storeys(springs)),
        ..Building::default()
    }
}

pub(crate) fn under(mut building: Building, preload: bool, p_delta: bool) -> Building {
    building.gravity = Gravity { preload, p_delta };
    building
}

pub(crate) fn assembled(building: &Building) -> BuildingSystem {
    let mut assembled = BuildingSystem::new(&building.name, Discretization::new(building));
    assembled
        .put_under_gravity(building.gravity)
        .expect("it stands");
    assembled
}

pub(crate) fn pushed(
    building: &BuildingSystem,
    pattern: LoadPattern,
    direction: PushDirection,
    drift: f64,
) -> Pushover {
    let settings = PushSettings {
        pattern,
        direction,
        drift,
    };
    pushover(building, settings).expect("it can be pushed")
}

/// Base shear of a curve at a roof displacement.
pub(crate) fn shear_at(curve: &Pushover, roof: f64) -> f64 {
    for pair in curve.points.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        if roof <= b.roof {
            let share = (roof - a.roof) / (b.roof - a.roof);
            return a.base_shear + share * (b.base_shear - a.base_shear);
        }
    }
    panic!("the curve ends before {roof} m");
}

#[track_caller]
pub(crate) fn close(got: f64, expected: f64, tolerance: f64) {
    near(got, expected, tolerance, "value");
}
