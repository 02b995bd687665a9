//! Buildings, parts of buildings and contact laws.

use jostle::{
    Building, ContactLaw, Damping, Frame, LawKind, PlanPoint, RestitutionIs, Section, Shear,
    Structure, Sway,
};

/// Damping of 5 % in the usual modes.
pub const FIVE_PERCENT: Damping = Damping::Ratio {
    ratio: 0.05,
    modes: Vec::new(),
    sway: Sway::Along,
};

/// No damping.
pub const UNDAMPED: Damping = Damping::Rayleigh {
    alpha: 0.0,
    beta: 0.0,
};

/// The default law of concrete floors, with the published formula for its restitution.
pub const CONCRETE: ContactLaw = ContactLaw {
    kind: LawKind::HertzDamp,
    stiffness: 2e9,
    restitution: 0.65,
    restitution_is: RestitutionIs::Input,
};

/// The same law, calibrated so that free masses rebound with its restitution.
pub const CONCRETE_REALISED: ContactLaw = ContactLaw {
    restitution_is: RestitutionIs::Realised,
    ..CONCRETE
};

/// A section that only bends, without mass; rigidity EI \[N·m²\].
#[must_use]
pub fn bending(flexural_rigidity: f64) -> Section {
    Section {
        flexural_rigidity,
        axial_rigidity: None,
        shear_rigidity: None,
        line_mass: 0.0,
    }
}

/// A rectangle of concrete of 30 GPa and 2500 kg/m³ \[m\].
#[must_use]
pub fn concrete(width: f64, depth: f64) -> Section {
    let (modulus, density) = (3e10, 2500.0);
    Section {
        flexural_rigidity: modulus * width * depth.powi(3) / 12.0,
        axial_rigidity: Some(modulus * width * depth),
        line_mass: density * width * depth,
        shear_rigidity: None,
    }
}

/// A frame of equal storeys of 3.2 m whose beams carry 5 t/m.
#[must_use]
pub fn frame(storeys: usize, spans: &[f64], column: Section, beam: Section) -> Frame {
    Frame {
        storey_heights: vec![3.2; storeys],
        spans: spans.to_vec(),
        columns: vec![column; storeys],
        beams: vec![beam; storeys],
        beam_mass: vec![5000.0; storeys],
        floor_mass: vec![0.0; storeys],
        column_segments: 2,
        beam_segments: vec![3; spans.len()],
        ..Frame::default()
    }
}

/// A shear building of equal floors \[kg\] and storeys \[N/m\] of 3 m.
#[must_use]
pub fn equal_storeys(storeys: usize, [mass, stiffness]: [f64; 2]) -> Shear {
    Shear {
        mass: vec![mass; storeys],
        stiffness: vec![stiffness; storeys],
        storey_heights: vec![3.0; storeys],
    }
}

/// A building on fixed ground with damping of 5 %.
#[must_use]
pub fn building(name: &str, structure: Structure) -> Building {
    Building {
        name: name.to_owned(),
        structure,
        damping: FIVE_PERCENT,
        ..Building::default()
    }
}

/// A rectangular plan by its lower left corner and its sides \[m\].
#[must_use]
pub fn rectangle(x: f64, y: f64, a: f64, b: f64) -> Vec<PlanPoint> {
    vec![[x, y], [x + a, y], [x + a, y + b], [x, y + b]]
}
