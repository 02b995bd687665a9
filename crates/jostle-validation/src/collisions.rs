//! Collisions of two free masses: contact laws against closed forms, in formulae and by stepping.

use jostle::contact::{
    BilinearShape, FreeCollision, HERTZ_DURATION, ModifiedKelvin, effective_mass, hertz_damping,
    hertz_indentation,
};
use jostle::{ContactLaw, Impact, LawKind, RestitutionIs, State};
use serde_json::Value;

use crate::data::{at, document, entries, list, number};
use crate::row::Row;
use crate::structures::{free_body, pair, run, still, uniform};

/// All rows of this family.
#[must_use]
pub fn rows() -> Vec<Row> {
    let mut rows = hertz_closed_forms();
    rows.extend(restitutions());
    rows.extend(single_collisions());
    rows.extend(order_of_convergence());
    rows.extend(precise_collisions());
    rows.extend(momentum_law());
    rows.extend(calibrated());
    rows
}

fn law(
    kind: LawKind,
    stiffness: f64,
    restitution: f64,
    restitution_is: RestitutionIs,
) -> ContactLaw {
    ContactLaw {
        kind,
        stiffness,
        restitution,
        restitution_is,
    }
}

/// Masses \[kg\] and velocities \[m/s\] of the left and the right body before they meet.
#[derive(Clone, Copy, Debug)]
struct Bodies {
    masses: [f64; 2],
    velocities: [f64; 2],
}

impl Bodies {
    fn closing_speed(&self) -> f64 {
        self.velocities[0] - self.velocities[1]
    }
}

/// Results of a collision.
struct Collision {
    /// Time counts from first contact.
    impact: Impact,
    velocities: [f64; 2],
    /// Times of the peak force and of the end of force, from first contact \[s\].
    peak_after: f64,
    lasted: f64,
}

/// Collides two bodies with a given number of steps per elastic collision. They start a fraction of a step apart,
/// so that first contact lies between two steps.
fn collide(law: &ContactLaw, bodies: Bodies, steps_per_impact: f64) -> Collision {
    let [m1, m2] = bodies.masses;
    let speed = bodies.closing_speed();
    let duration = law
        .between(m1, m2)
        .elastic_duration(effective_mass(m1, m2), speed);
    let step = duration / steps_per_impact;
    let gap = 0.37 * step * speed;
    let system = pair(
        free_body("left", m1),
        free_body("right", m2),
        gap,
        |a, b| law.between(a, b),
    );
    let state = State {
        velocity: bodies.velocities.to_vec(),
        ..State::at_rest(&system, 0.0)
    };
    let outcome = run(
        &system,
        &still(2.5 * duration + step),
        &uniform(step),
        Some(state),
    );
    assert_eq!(outcome.impacts.len(), 1, "two free bodies meet once");
    let impact = outcome.impacts[0];
    Collision {
        impact,
        velocities: [outcome.state.velocity[0], outcome.state.velocity[1]],
        peak_after: impact.peak_force_at - impact.start,
        lasted: impact.end - impact.start,
    }
}

fn hertz_closed_forms() -> Vec<Row> {
    const SOURCE: &str = "theory/oracle_basic";
    let basic = document(include_str!("../data/theory/oracle_basic.json"));
    let value = |key: &str| number(&basic, &format!("/hertz_collision/{key}"));
    let reduced = effective_mass(value("m1"), value("m2"));
    let indentation = hertz_indentation(value("k"), reduced, value("v_rel"));
    let hertz = law(LawKind::Hertz, value("k"), 1.0, RestitutionIs::Input)
        .between(value("m1"), value("m2"));
    let duration = hertz.elastic_duration(reduced, value("v_rel"));
    let force = hertz.respond(indentation, 0.0, value("v_rel")).force;
    let mut rows = vec![
        Row::relative(
            SOURCE,
            "Hertz, peak indentation [m]",
            value("delta_max"),
            indentation,
            1e-12,
        ),
        Row::relative(
            SOURCE,
            "Hertz, peak force [N]",
            value("F_max"),
            force,
            1e-12,
        ),
        Row::relative(SOURCE, "Hertz, duration [s]", value("T"), duration, 1e-9),
        Row::relative(
            "literature/A02_free_hertz",
            "Hertz, duration × speed ÷ indentation [–]",
            2.943_275_184_324_704_7,
            HERTZ_DURATION,
            1e-15,
        ),
    ];
    for (e, expected) in entries(&basic, "/d_exact") {
        let d = hertz_damping(e.parse().expect("a number"));
        rows.push(Row::relative(
            SOURCE,
            format!("hertz-damp, d that realises e = {e} [–]"),
            number(expected, ""),
            d,
            1e-9,
        ));
    }
    rows
}

/// Restitution that laws realise, from their formulae.
fn restitutions() -> Vec<Row> {
    const SOURCE: &str = "theory/oracle_contact";
    let stored = document(include_str!("../data/theory/oracle_contact.json"));
    let (k, linear) = (number(&stored, "/k"), number(&stored, "/k_linear"));
    let mut rows = Vec::new();
    for row in list(&stored, "/rows") {
        let e = number(row, "/e");
        let mut compare = |what: &str, key: &str, got: f64, tolerance: f64| {
            rows.push(Row::relative(
                SOURCE,
                format!("e = {e}: {what} [–]"),
                number(row, key),
                got,
                tolerance,
            ));
        };
        let free = |kind, stiffness, is| {
            law(kind, stiffness, e, is)
                .free_restitution()
                .unwrap_or(f64::NAN)
        };
        compare(
            "kelvin, restitution",
            "/kelvin_tensile",
            free(LawKind::Kelvin, linear, RestitutionIs::Input),
            1e-12,
        );
        compare(
            "kelvin-no-tension, restitution",
            "/kelvin_clipped_formula",
            free(LawKind::KelvinNoTension, linear, RestitutionIs::Input),
            1e-12,
        );
        compare(
            "hertz-damp, restitution",
            "/hertzdamp_MD06_formula",
            free(LawKind::HertzDamp, k, RestitutionIs::Input),
            1e-9,
        );
        compare(
            "hertz-damp calibrated, d",
            "/d_exact",
            hertz_damping(e),
            1e-9,
        );
    }
    rows
}

/// Laws of the table for which both precise integrations should agree.
fn precise_collisions() -> Vec<Row> {
    const SOURCE: &str = "theory/oracle_contact";
    let stored = document(include_str!("../data/theory/oracle_contact.json"));
    let value = |key: &str| number(&stored, &format!("/{key}"));
    let mut rows = Vec::new();
    for row in list(&stored, "/rows") {
        let e = number(row, "/e");
        let cases = [
            ("/kelvin_clipped", LawKind::KelvinNoTension, 1e-8),
            (
                "/modkelvin_formula",
                LawKind::ModifiedKelvin(ModifiedKelvin::Ye),
                1e-9,
            ),
            ("/hertzdamp_MD06", LawKind::HertzDamp, 1e-9),
            ("/hertzdamp_Ye09_formula", LawKind::Ye, 1e-9),
            ("/jank06", LawKind::Jankowski, 1e-6),
            ("/bilin", LawKind::Bilinear(BilinearShape::USUAL), 1e-4),
        ];
        for (key, kind, tolerance) in cases {
            let stiffness = if kind.is_hertzian() {
                value("k")
            } else {
                value("k_linear")
            };
            let law = law(kind, stiffness, e, RestitutionIs::Input);
            let numbers = law.between(value("m1"), value("m2"));
            let got = FreeCollision::new(&numbers, value("m1"), value("m2"), value("v0"));
            rows.push(Row::relative(
                SOURCE,
                format!("e = {e}: {}, integrated, restitution [–]", kind.full_name()),
                number(row, key),
                got.realised_restitution(),
                tolerance,
            ));
        }
    }
    rows
}

/// The momentum law, as a run applies it.
fn momentum_law() -> Vec<Row> {
    const SOURCE: &str = "literature/A08_stereomechanical";
    let case = document(include_str!("../data/literature/A08_stereomechanical.json"));
    let input = |key: &str| number(&case, &format!("/inputs/{key}"));
    let expected = |key: &str| number(&case, &format!("/expected/{key}"));
    let bodies = Bodies {
        masses: [input("m1"), input("m2")],
        velocities: [input("v1"), input("v2")],
    };
    let law = law(
        LawKind::Restitution,
        1e9,
        input("e_in"),
        RestitutionIs::Input,
    );
    let got = collide(&law, bodies, 50.0);
    [
        ("left velocity after [m/s]", "v1_after", got.velocities[0]),
        ("right velocity after [m/s]", "v2_after", got.velocities[1]),
        ("impulse [N·s]", "impulse", got.impact.impulse),
        ("energy lost [J]", "dissipated", got.impact.dissipated),
        (
            "restitution [–]",
            "e_out",
            got.impact.realised_restitution(),
        ),
    ]
    .map(|(what, key, got)| {
        Row::relative(
            SOURCE,
            format!("restitution, {what}"),
            expected(key),
            got,
            1e-9,
        )
    })
    .to_vec()
}

/// Every dissipative law, calibrated: the rebound by precise integration.
fn calibrated() -> Vec<Row> {
    let mut rows = Vec::new();
    for kind in LawKind::ALL
        .into_iter()
        .filter(|kind| kind.is_dissipative())
    {
        let realised: Vec<f64> = CALIBRATED
            .iter()
            .map(|e| {
                let stiffness = if kind.is_hertzian() { 2e9 } else { 1e8 };
                let law = law(kind, stiffness, *e, RestitutionIs::Realised);
                FreeCollision::new(&law.between(4e4, 7e4), 4e4, 7e4, 0.6).realised_restitution()
            })
            .collect();
        rows.push(Row::worst_of(
            "restitution asked for",
            format!("{}, realised e for e = 0.3 … 0.95 [–]", kind.full_name()),
            &CALIBRATED,
            &realised,
            1e-9,
        ));
    }
    rows
}

/// Restitutions that every law can realise.
const CALIBRATED: [f64; 8] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95];

/// One collision of each law, stepped.
fn single_collisions() -> Vec<Row> {
    let a01 = document(include_str!("../data/literature/A01_free_linear.json"));
    let a02 = document(include_str!("../data/literature/A02_free_hertz.json"));
    let a03 = document(include_str!("../data/literature/A03_free_kelvin.json"));
    let a05 = document(include_str!(
        "../data/literature/A05_free_hertzdamp_muthukumar.json"
    ));
    let cases = [
        ("literature/A01_free_linear", &a01, LawKind::Linear, ""),
        ("literature/A02_free_hertz", &a02, LawKind::Hertz, ""),
        (
            "literature/A03_free_kelvin",
            &a03,
            LawKind::Kelvin,
            "variant_tension_allowed/",
        ),
        (
            "literature/A03_free_kelvin",
            &a03,
            LawKind::KelvinNoTension,
            "variant_no_tension/",
        ),
        (
            "literature/A05_free_hertzdamp_muthukumar",
            &a05,
            LawKind::HertzDamp,
            "",
        ),
    ];
    let mut rows = Vec::new();
    for (source, case, kind, variant) in cases {
        for (steps, tolerance) in [(200.0, 1e-4), (2000.0, 1e-6)] {
            rows.extend(single_collision(
                source, case, kind, variant, steps, tolerance,
            ));
        }
    }
    rows
}

fn single_collision(
    source: &str,
    case: &Value,
    kind: LawKind,
    variant: &str,
    steps: f64,
    tolerance: f64,
) -> Vec<Row> {
    let input = |key: &str| number(case, &format!("/inputs/{key}"));
    let expected = |key: &str| number(case, &format!("/expected/{key}"));
    let of_variant = |key: &str| number(case, &format!("/expected/{variant}{key}"));
    let e = case
        .pointer("/inputs/e_in")
        .and_then(Value::as_f64)
        .unwrap_or(1.0);
    let bodies = Bodies {
        masses: [input("m1"), input("m2")],
        velocities: [input("v1"), input("v2")],
    };
    let law = law(kind, input("k"), e, RestitutionIs::Input);
    let got = collide(&law, bodies, steps);
    let impact = got.impact;
    let name = |what: &str| format!("{}, {steps} steps per impact, {what}", kind.name());
    let mut rows = vec![
        Row::relative(
            source,
            name("peak force [N]"),
            expected("F_max"),
            impact.peak_force,
            tolerance,
        ),
        Row::relative(
            source,
            name("peak indentation [m]"),
            expected("delta_max"),
            impact.peak_indentation,
            tolerance,
        ),
        Row::relative(
            source,
            name("restitution [–]"),
            of_variant("e_out"),
            impact.realised_restitution(),
            tolerance,
        ),
        Row::relative(
            source,
            name("duration [s]"),
            of_variant("duration"),
            got.lasted,
            tolerance,
        ),
        Row::relative(
            source,
            name("left velocity after [m/s]"),
            of_variant("v1_after"),
            got.velocities[0],
            10.0 * tolerance,
        ),
        Row::relative(
            source,
            name("right velocity after [m/s]"),
            of_variant("v2_after"),
            got.velocities[1],
            10.0 * tolerance,
        ),
    ];
    // Relative to the kinetic energy of the approach.
    let met =
        0.5 * effective_mass(bodies.masses[0], bodies.masses[1]) * bodies.closing_speed().powi(2);
    rows.push(Row::absolute(
        source,
        name("dissipated energy ÷ kinetic energy of approach [–]"),
        of_variant("dissipated") / met,
        impact.dissipated / met,
        tolerance,
    ));
    if steps <= 200.0 {
        // Rounding of the velocities grows with the number of steps.
        let momentum = bodies.masses[0] * (bodies.velocities[0] - got.velocities[0]);
        rows.push(Row::relative(
            source,
            name("impulse against change of momentum [N·s]"),
            momentum,
            impact.impulse,
            1e-10,
        ));
    }
    if let Some(at) = case.pointer("/expected/t_F_max").and_then(Value::as_f64) {
        rows.push(Row::relative(
            source,
            name("time from first contact to peak force [s]"),
            at,
            got.peak_after,
            10.0 * tolerance,
        ));
    }
    rows
}

/// Errors with N steps per impact, against those of an independent program that also ends steps at first contact.
fn order_of_convergence() -> Vec<Row> {
    const SOURCE: &str = "theory/contact_dt_twomass";
    let stored = document(include_str!("../data/theory/contact_dt_twomass.json"));
    let contact = document(include_str!("../data/theory/oracle_contact.json"));
    let value = |key: &str| number(&contact, &format!("/{key}"));
    let bodies = Bodies {
        masses: [value("m1"), value("m2")],
        velocities: [0.5 * value("v0"), -0.5 * value("v0")],
    };
    let mut rows = Vec::new();
    for e in [1.0, 0.65] {
        let law = law(LawKind::HertzDamp, value("k"), e, RestitutionIs::Realised);
        let error =
            |steps: f64| (collide(&law, bodies, steps).impact.realised_restitution() - e).abs();
        let landing = list(&stored, "").iter().filter(|row| {
            at(row, "/event").as_bool() == Some(true)
                && number(row, "/e") == e
                && number(row, "/N") >= 10.0
        });
        for row in landing {
            let steps = number(row, "/N");
            let quantity = format!(
                "hertz-damp calibrated to {e}, {steps} steps per impact, error of the restitution [–]"
            );
            // The reference is the worst of 13 phases; here first contact and separation lie elsewhere in the
            // steps.
            rows.push(Row::absolute(
                SOURCE,
                quantity,
                0.0,
                error(steps),
                2.0 * number(row, "/err_e"),
            ));
        }
        if e < 1.0 {
            let order = (error(50.0) / error(400.0)).log2() / 3.0;
            rows.push(Row::absolute(
                SOURCE,
                format!("hertz-damp calibrated to {e}, order of convergence [–]"),
                2.0,
                order,
                0.1,
            ));
        }
    }
    rows
}
