//! Pages without scripts of their own turn dark and fit a phone.

use jostle::contact::{ContactLaw, FreeCollision, LawKind};
use jostle_report::{
    CollidedLaw, Collisions, StudyPage, render_collisions, render_method, render_sections,
    render_study,
};
use jostle_testkit::browser::open_page;
use jostle_testkit::models::CONCRETE;

fn collisions() -> Collisions {
    let laws = [LawKind::Hertz, LawKind::HertzDamp].map(|kind| {
        let law = ContactLaw { kind, ..CONCRETE };
        let collision = FreeCollision::new(&law.between(2e5, 3e5), 2e5, 3e5, 0.5);
        CollidedLaw { law, collision }
    });
    Collisions {
        masses: [2e5, 3e5],
        speed: 0.5,
        restitution: Some(0.65),
        stiffnesses: "Stiffness 2e9 N/m^1.5".into(),
        laws: laws.to_vec(),
    }
}

#[test]
fn pages_without_scripts_turn_dark_and_fit_a_phone() {
    let pages = [
        ("collide", render_collisions(&collisions())),
        ("section", render_sections("Sections", &[])),
        ("method", render_method("Method", &[])),
        ("study", render_study(&StudyPage::default())),
    ];
    for (name, text) in pages {
        let Some(page) = open_page(&text, 375, 740) else {
            return;
        };
        page.assert_fits(375.0);
        let colours = "(() => { const s = getComputedStyle(document.body); return s.backgroundColor + ' ' + s.color; })()";
        assert!(
            page.text(colours).starts_with("rgb(255, 255, 255)"),
            "{name}"
        );
        page.value("document.getElementById('theme').click()");
        assert_eq!(
            page.text(colours),
            "rgb(21, 24, 28) rgb(233, 235, 238)",
            "{name}"
        );
        page.value("document.getElementById('theme').click()");
        assert!(
            page.text(colours).starts_with("rgb(255, 255, 255)"),
            "{name}"
        );
        page.assert_alone();
        page.assert_content();
    }
}
