use super::*;
use crate::contact::RestitutionIs;
use crate::contact::{
    ContactLaw, ForceLaw, FreeCollision, LawKind, ModifiedKelvin, hertz_restitution,
};

const MASSES: [f64; 2] = [4e4, 9e4];

fn law(kind: LawKind, stiffness: f64) -> ContactLaw {
    ContactLaw {
        kind,
        stiffness,
        restitution: 0.6,
        restitution_is: RestitutionIs::Input,
    }
}

fn formula(text: &str) -> LawKind {
    LawKind::Formula(Formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}")))
}

fn between(kind: LawKind, stiffness: f64) -> ForceLaw {
    law(kind, stiffness).between(MASSES[0], MASSES[1])
}

/// Laws of jostle as a user would write them: damping by published formulas of e and the masses.
const WRITTEN: [(LawKind, &str, f64); 6] = [
    (LawKind::Hertz, "k * d^1.5", 2e9),
    (
        LawKind::HertzDamp,
        "k * d^1.5 * (1 + 0.75 * (1 - e^2) * v / v0)",
        2e9,
    ),
    (
        LawKind::Ye,
        "k*d*sqrt(d) * (1 + 8/5 * (1 - e)/e * v/v0)",
        2e9,
    ),
    (LawKind::Linear, "k * d", 1e8),
    (
        LawKind::KelvinNoTension,
        "k*d + 2*v*sqrt(k*m) * (-ln(e)) / sqrt(9.869604401089358 + ln(e)^2)",
        1e8,
    ),
    (
        LawKind::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski),
        "k*d + if(v > 0, 2*sqrt(k*m) * (1 - e^2) / (e * (e * (3.141592653589793 - 2) + 2)) * v, 0)",
        1e8,
    ),
];

#[test]
fn laws_written_as_formulas_respond_like_the_laws() {
    for (kind, text, stiffness) in WRITTEN {
        let (built_in, written) = (between(kind, stiffness), between(formula(text), stiffness));
        for indentation in [-1e-3, 1e-6, 2e-4, 5e-3] {
            for rate in [-0.4, -0.01, 0.0, 0.2, 0.4] {
                let [a, b] = [&built_in, &written].map(|law| law.respond(indentation, rate, 0.4));
                for (found, due, what) in [
                    (b.force, a.force, "force"),
                    (b.by_indentation, a.by_indentation, "slope over indentation"),
                    (b.by_rate, a.by_rate, "slope over rate"),
                ] {
                    // At rest the damper of the approach has either slope.
                    if rate == 0.0 && what == "slope over rate" && text.contains("if") {
                        continue;
                    }
                    let near = (found - due).abs() <= 1e-12 * due.abs();
                    assert!(
                        near,
                        "{text}: {what} {found} instead of {due} at {indentation} m, {rate} m/s"
                    );
                }
            }
        }
        assert!(
            (written.onset(0.3) - built_in.onset(0.3)).abs() <= 1e-12 * built_in.onset(0.3),
            "{text}"
        );
        assert_eq!(formula(text).is_hertzian(), kind.is_hertzian(), "{text}");
        assert_eq!(
            formula(text).uses_restitution(),
            kind.uses_restitution(),
            "{text}"
        );
        let exact = built_in.elastic_duration(3e4, 0.4);
        let scale = written.elastic_duration(3e4, 0.4);
        // A dashpot without the indentation does not change the scale.
        assert!(
            (scale / exact - 1.0).abs() < 0.06,
            "{text}: {scale} s instead of {exact} s"
        );
        let (scale, exact) = (
            written.elastic_force(3e4, 0.4),
            built_in.elastic_force(3e4, 0.4),
        );
        assert!(
            (scale / exact - 1.0).abs() < 0.2,
            "{text}: {scale} N instead of {exact} N"
        );
    }
}

/// For F = k δⁿ (1 + d δ̇/v₀) the rebound follows from d alone, whatever n: here a power that no law of jostle has.
#[test]
fn free_masses_rebound_as_the_closed_form_says() {
    let kind = formula("k * d^1.2 * (1 + 0.7 * v / v0)");
    let collision = FreeCollision::new(&between(kind, 3e8), MASSES[0], MASSES[1], 0.35);
    let due = hertz_restitution(0.7);
    let found = collision.realised_restitution();
    assert!((found - due).abs() < 1e-6, "{found} instead of {due}");
    assert!(collision.dissipated > 0.0);
}

/// Energy of an elastic law: the greatest indentation of F = k (δ + δ³/b²) follows from ½ m v² = k (½ δ² + ¼ δ⁴/b²).
#[test]
fn an_elastic_formula_stores_the_energy_of_the_impact() {
    let kind = formula("k * (d + d^3 / 0.004^2)");
    let collision = FreeCollision::new(&between(kind, 1e8), MASSES[0], MASSES[1], 0.3);
    let mass = MASSES[0] * MASSES[1] / (MASSES[0] + MASSES[1]);
    let energy = 0.5 * mass * 0.3 * 0.3 / 1e8;
    let b2 = 0.004_f64.powi(2);
    let due = (b2 * ((1.0 + 4.0 * energy / b2).sqrt() - 1.0)).sqrt();
    let found = collision.peak_indentation;
    assert!(
        (found / due - 1.0).abs() < 1e-9,
        "{found} m instead of {due} m"
    );
    assert!((collision.realised_restitution() - 1.0).abs() < 1e-6);
}

#[test]
fn derivatives_are_those_of_differences() {
    let text = "k*d^(1 + 0.3*tanh(d/0.002)) * (1 + 0.2*min(v/v0, 0.5)) + 1e5*exp(-d/0.01)*max(v, 0) + abs(v)*ln(1 + d)";
    let ForceLaw::Formula(law) = between(formula(text), 1e9) else {
        panic!("no formula");
    };
    for d in [3e-4, 4e-3] {
        for v in [-0.21, 0.07, 0.33] {
            let found = law.value(d, v, 0.4);
            let by = |h: f64, k: f64| {
                (law.value(d + h, v + k, 0.4).value - law.value(d - h, v - k, 0.4).value)
                    / (2.0 * (h + k))
            };
            for (slope, due) in [
                (found.by_indentation, by(1e-8, 0.0)),
                (found.by_rate, by(0.0, 1e-6)),
            ] {
                assert!(
                    (slope - due).abs() <= 1e-6 * due.abs().max(1.0),
                    "{slope} instead of {due} at {d}, {v}"
                );
            }
        }
    }
}

#[test]
fn a_share_bears_its_part() {
    for (kind, text, stiffness) in WRITTEN {
        let whole = law(formula(text), stiffness);
        let part = whole
            .shared(stiffness, 0.3)
            .between(0.3 * MASSES[0], 0.3 * MASSES[1]);
        let whole = whole.between(MASSES[0], MASSES[1]);
        let [a, b] = [whole, part].map(|law| law.respond(2e-3, 0.1, 0.2).force);
        assert!((b - 0.3 * a).abs() < 1e-12 * a, "{kind:?}");
    }
}

#[test]
fn formulas_are_written_as_they_are_read() {
    for (text, due) in [
        ("k*(d)", "k*d"),
        ("-(-k)*d^-1^2", "--k*d^(-1^2)"),
        (
            "k*d/(2*v0)*3 - (1 - (v - 1))",
            "k*d/(2*v0)*3 - (1 - (v - 1))",
        ),
        ("if(v>0,k*d,min(k*d,1e3))", "if(v > 0, k*d, min(k*d, 1000))"),
        ("k * (d^2)^3", "k*(d^2)^3"),
        ("k * d^2^3 / (1/2)", "k*d^2^3/(1/2)"),
    ] {
        let read = Formula::parse(text).unwrap();
        assert_eq!(read.to_string(), due);
        let again = Formula::parse(due).unwrap();
        let value = |formula: Formula| formula.between(7.0, 0.5, 3.0).value(0.3, 0.2, 0.9).value;
        assert_eq!(value(read).to_bits(), value(again).to_bits(), "{text}");
    }
    let value = |text: &str| {
        Formula::parse(text)
            .unwrap()
            .between(1.0, 0.5, 3.0)
            .value(2.0, 0.2, 0.9)
            .value
    };
    assert_eq!(value("k*d^3^2"), 512.0);
    assert_eq!(value("-k*d^2"), -4.0);
    assert_eq!(value("8/2/2*k*d - 1 - 1"), 2.0);
    assert_eq!(value("2e0*k*d + .5 + 1.e1"), 14.5);
}

#[test]
fn wrong_formulas_say_what_is_wrong() {
    for (text, due) in [
        ("", "a value is missing at the end"),
        ("k*d*", "a value is missing at the end"),
        (
            "2e9*d",
            "must contain k, the stiffness of the gap, as in \"k * d^1.5\"",
        ),
        (
            "k*v",
            "must contain d, the indentation, as in \"k * d^1.5\"",
        ),
        (
            "k*delta",
            "\"delta\" is no name of a formula; use d, v, v0, k, e or m",
        ),
        ("k d", "an operation such as * is missing before \"d\""),
        ("k*(d", "a bracket is not closed"),
        ("k*d)", "a bracket is closed that was not opened"),
        (
            "k*d^1,5",
            "a comma stands outside the brackets of a function; write 1.5 for a decimal",
        ),
        ("max(k*d)", "max takes 2 values, found 1"),
        ("sqrt(k*d, 2)", "sqrt takes 1 value, found 2"),
        ("sqrt k*d", "sqrt needs its values in brackets: sqrt(…)"),
        ("k*d**2", "a value is missing before \"*2\""),
        ("k*d + 1e400", "\"1e400\" is not a usable number"),
        (
            "k*d + 1.2.3",
            "an operation such as * is missing before \".3\"",
        ),
        ("k*d & 1", "\"&\" has no meaning in a formula"),
        ("min(,k*d)", "a value is missing before \",k*d)\""),
    ] {
        let found = Formula::parse(text)
            .map(|formula| formula.to_string())
            .map_err(|error| error.to_string());
        assert_eq!(found, Err(due.to_owned()), "{text}");
    }
    let deep = format!("k*d + {}1{}", "(".repeat(400), ")".repeat(400));
    assert!(Formula::parse(&deep).is_ok(), "brackets alone cost nothing");
    let deep = format!("k*d{}", " + (1".repeat(20) + &")".repeat(20));
    assert!(
        Formula::parse(&deep)
            .unwrap_err()
            .to_string()
            .contains("nested")
    );
    let long = format!("k*d{}", " + 1".repeat(30));
    assert!(
        Formula::parse(&long)
            .unwrap_err()
            .to_string()
            .contains("at most 48")
    );
    let many: String = (0..20).map(|n| format!(" + {n}")).collect();
    assert!(
        Formula::parse(&format!("k*d{many}"))
            .unwrap_err()
            .to_string()
            .contains("different numbers")
    );
}

#[test]
fn unfit_formulas_are_found() {
    let fault = |text: &str| match between(formula(text), 1e8) {
        ForceLaw::Formula(law) => law.fault(),
        _ => None,
    };
    for (text, due) in [
        ("k*d*ln(d - 0.01)", "is no number"),
        ("k*d - 1000*k*d^2", "must not fall as d grows"),
        ("k*d*(1 - 0.5*v/v0)", "must not fall as v grows"),
        ("k*d*v", "must push where d > 0"),
        ("-k*d", "must push where d > 0"),
    ] {
        let found = fault(text).unwrap_or_default();
        assert!(found.starts_with(due), "{text}: {found}");
    }
    for (_, text, _) in WRITTEN {
        assert_eq!(fault(text), None, "{text}");
    }
}
