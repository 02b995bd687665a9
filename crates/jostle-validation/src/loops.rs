//! The figure of all contact laws for `docs/contact.md`.

use jostle::contact::{FreeCollision, effective_mass, hertz_indentation};
use jostle::{ContactLaw, LawKind, RestitutionIs};
use jostle_report::{CollidedLaw, Collisions, loops_svg};

/// Force over indentation of every law: two masses of 60 t at 0.5 m/s, e = 0.65 in the published formulas.
#[must_use]
pub fn figure() -> String {
    const MASS: f64 = 6e4;
    const SPEED: f64 = 0.5;
    const HERTZ: f64 = 2e9;
    let linear = HERTZ * hertz_indentation(HERTZ, effective_mass(MASS, MASS), SPEED).sqrt();
    let laws = LawKind::ALL.map(|kind| {
        let law = ContactLaw {
            kind,
            stiffness: if kind.is_hertzian() { HERTZ } else { linear },
            restitution: 0.65,
            restitution_is: RestitutionIs::Input,
        };
        let collision = FreeCollision::new(&law.between(MASS, MASS), MASS, MASS, SPEED);
        CollidedLaw { law, collision }
    });
    loops_svg(&Collisions {
        masses: [MASS, MASS],
        speed: SPEED,
        restitution: Some(0.65),
        stiffnesses: String::new(),
        laws: laws.to_vec(),
    })
}
