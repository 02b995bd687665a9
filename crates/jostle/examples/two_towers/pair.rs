// The model of the example and of examples in the documentation of the crate.

use jostle::{Building, ContactLaw, Damping, Gap, LawKind, Model, RestitutionIs, Shear, Structure};

/// A soft tower beside a stiff one, `gap` metres apart.
pub(crate) fn pair(gap: f64) -> Model {
    let law = ContactLaw {
        kind: LawKind::HertzDamp,
        stiffness: 2e9,
        restitution: 0.65,
        restitution_is: RestitutionIs::Realised,
    };
    Model {
        title: "Soft and stiff".to_owned(),
        buildings: vec![tower("soft", 40e3, 20e6), tower("stiff", 60e3, 90e6)],
        gaps: vec![Gap::after(0, gap, law)],
        ..Model::default()
    }
}

/// Three storeys with masses \[kg\] and stiffnesses \[N/m\].
fn tower(name: &str, mass: f64, stiffness: f64) -> Building {
    Building {
        name: name.to_owned(),
        structure: Structure::Shear(Shear {
            mass: vec![mass; 3],
            stiffness: vec![stiffness; 3],
            storey_heights: vec![3.2; 3],
        }),
        damping: Damping::ratio(0.05, []),
        ..Building::default()
    }
}
