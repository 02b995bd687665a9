//! Before they yield, hinges are elastic springs, and modes have to see them.

use jostle::eigen::modes;
use jostle::hysteresis::{Backbone, Corners, Hysteresis, HysteresisRule};
use jostle::structure::Discretization;
use jostle::system::BuildingSystem;
use jostle::{Base, Building, Frame, FrameHinges, Hinges, Joint, Structure};
use jostle_testkit::models::UNDAMPED;

use crate::modal::support::{frame, framed, library_modes};

fn hinge(initial: f64) -> Hysteresis {
    let corners = Corners::bilinear(1e5, 0.02);
    let backbone = Backbone::from_forces(initial, corners, corners).expect("sound");
    Hysteresis::new(HysteresisRule::Bilinear, backbone).expect("sound")
}

fn hinged(frame: Frame, columns: Option<f64>, beams: f64, base: Base) -> BuildingSystem {
    let (storeys, bays) = (frame.storey_heights.len(), frame.spans.len());
    let building = Building {
        name: "hinged".to_owned(),
        structure: Structure::Frame(frame),
        damping: UNDAMPED,
        base,
        hinges: Some(Hinges::Frame(FrameHinges {
            columns: columns.map_or_else(Vec::new, |k| vec![vec![hinge(k); bays + 1]; storeys]),
            beams: vec![vec![hinge(beams); bays]; storeys],
            ..FrameHinges::default()
        })),
        ..Building::default()
    };
    BuildingSystem::new("hinged", Discretization::new(&building))
}

#[test]
fn hinges_of_beams_are_their_elastic_joints() {
    let joined = frame(4, &[5.0, 3.0]);
    let plain = Frame {
        joint: Joint::default(),
        ..joined.clone()
    };
    let stiffness = joined.joint.rotational_stiffness.expect("given");
    let expected = modes(&framed(joined), 20).expect("it stands");
    let found = modes(&hinged(plain, None, stiffness, Base::default()), 20).expect("it stands");
    for (found, expected) in found.iter().zip(&expected) {
        let ratio = found.circular_frequency / expected.circular_frequency;
        assert!((ratio - 1.0).abs() < 1e-11, "{ratio}");
    }
}

#[test]
fn hinges_at_every_end_agree_with_a_library() {
    let bare = Frame {
        joint: Joint::default(),
        ..frame(5, &[2.4, 6.0])
    };
    let rigidity = bare.columns[0].flexural_rigidity / 3.2;
    let rocking = Base {
        rotational_stiffness: Some(2e8),
        rotational_hinge: Some(hinge(2e8)),
        ..Base::default()
    };
    // Soft to practically rigid; the joints themselves have no other stiffness against turning.
    for times in [1.0, 100.0, 1e5] {
        for base in [Base::default(), rocking] {
            let building = hinged(bare.clone(), Some(times * rigidity), times * rigidity, base);
            let dense = library_modes(&building).expect("it stands");
            let found = modes(&building, 12).expect("it stands");
            assert_eq!(found.len(), 12);
            for (found, expected) in found.iter().zip(&dense) {
                let ratio = found.circular_frequency / expected.circular_frequency;
                assert!(
                    (ratio - 1.0).abs() < 1e-10 * times.sqrt(),
                    "{times}: {ratio}"
                );
            }
        }
    }
}
