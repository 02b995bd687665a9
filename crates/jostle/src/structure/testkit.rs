//! Buildings for tests.

use super::{AssembledBuilding, Discretization};
use crate::model::{Axial, Building, Damping, Frame, Hinges, Joint, Section, Structure};

/// Three storeys over two spans.
pub(crate) fn frame(columns_flexible: bool) -> AssembledBuilding {
    frame_with(|frame| {
        frame.axial.columns_flexible = columns_flexible;
        None
    })
}

/// Three storeys, two bays, members of several masses, changed at will, with the hinges that are returned.
pub(crate) fn frame_with(change: impl FnOnce(&mut Frame) -> Option<Hinges>) -> AssembledBuilding {
    let section = |line_mass| Section {
        flexural_rigidity: 1e8,
        axial_rigidity: Some(8e9),
        line_mass,
        shear_rigidity: None,
    };
    let mut frame = Frame {
        storey_heights: vec![3.0; 3],
        spans: vec![4.0, 6.0],
        columns: vec![section(600.0); 3],
        beams: vec![section(0.0); 3],
        beam_mass: vec![4000.0; 3],
        floor_mass: vec![0.0; 3],
        column_segments: 3,
        beam_segments: vec![4, 5],
        axial: Axial {
            columns_flexible: false,
            beams_flexible: false,
        },
        joint: Joint {
            rotational_stiffness: Some(5e8),
            ..Joint::default()
        },
        ..Frame::default()
    };
    let hinges = change(&mut frame);
    let building = Building {
        name: "frame".into(),
        structure: Structure::Frame(frame),
        damping: Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.0,
        },
        hinges,
        ..Building::default()
    };
    AssembledBuilding::new("frame", Discretization::new(&building))
}
