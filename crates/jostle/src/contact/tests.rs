//! The laws against closed forms, differences and the precise collision.

use super::*;

const MASSES: [f64; 2] = [4e4, 6e4];

fn law(kind: LawKind, e: f64, restitution_is: RestitutionIs) -> ContactLaw {
    ContactLaw {
        kind,
        stiffness: if kind.is_hertzian() { 2e9 } else { 1e8 },
        restitution: e,
        restitution_is,
    }
}

fn collide(law: &ContactLaw, speed: f64) -> FreeCollision {
    let numbers = law.between(MASSES[0], MASSES[1]);
    FreeCollision::new(&numbers, MASSES[0], MASSES[1], speed)
}

/// The integrator does not use the closed forms that determine the damping.
#[test]
fn calibrated_laws_rebound_as_asked() {
    for kind in LawKind::ALL {
        for e in [0.3, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.99] {
            for speed in [0.05, 0.5, 2.0] {
                let law = law(kind, e, RestitutionIs::Realised);
                let expected = if kind.is_dissipative() { e } else { 1.0 };
                let (formula, got) = (
                    law.free_restitution().expect("a number"),
                    collide(&law, speed).realised_restitution(),
                );
                assert!(
                    (formula - expected).abs() < 1e-10,
                    "{kind:?}: e = {e}, formula {formula}"
                );
                assert!(
                    (got - expected).abs() < 1e-9,
                    "{kind:?}: e = {e} at {speed} m/s, integrated {got}"
                );
            }
        }
    }
}

#[test]
fn published_laws_rebound_as_their_closed_forms_say() {
    for kind in LawKind::ALL {
        for e in [0.2, 0.3, 0.5, 0.65, 0.95, 1.0] {
            let law = law(kind, e, RestitutionIs::Input);
            let (formula, got) = (
                law.free_restitution().expect("a number"),
                collide(&law, 0.7).realised_restitution(),
            );
            assert!(
                (got - formula).abs() < 1e-9,
                "{kind:?}: e = {e}, formula {formula}, integrated {got}"
            );
        }
    }
}

#[test]
fn the_published_hertz_damp_rebounds_livelier_than_its_e() {
    // Integrated by DOP853 at rtol 3e-14 and by mpmath, see the validation data.
    let realised = law(LawKind::HertzDamp, 0.65, RestitutionIs::Input).free_restitution();
    let realised = realised.expect("a number");
    assert!(
        (realised - 0.774_819_081_179_966_8).abs() < 1e-12,
        "{realised}"
    );
}

#[test]
fn a_bilinear_law_designed_for_one_speed_realises_e_there() {
    let shape = BilinearShape {
        design_speed: Some(0.8),
        ..BilinearShape::USUAL
    };
    let law = law(LawKind::Bilinear(shape), 0.5, RestitutionIs::Realised);
    assert!((collide(&law, 0.8).realised_restitution() - 0.5).abs() < 1e-9);
    // At other speeds it does not.
    assert!((collide(&law, 0.2).realised_restitution() - 0.5).abs() > 0.02);
    // Below the yield indentation no energy is dissipated.
    assert!((collide(&law, 0.04).realised_restitution() - 1.0).abs() < 1e-9);
}

#[test]
fn collisions_keep_their_books() {
    for kind in LawKind::ALL {
        let collision = collide(&law(kind, 0.65, RestitutionIs::Input), 0.5);
        let Some(peak) = collision.peak_force else {
            continue;
        };
        // Impulse and dissipation by quadrature over the curve, against momentum and kinetic energy.
        let (mut impulse, mut work) = (0.0, 0.0);
        for pair in collision.curve.windows(2) {
            let mean = 0.5 * (pair[0].force + pair[1].force);
            impulse += mean * (pair[1].time - pair[0].time);
            work += mean * (pair[1].indentation - pair[0].indentation);
        }
        assert!(
            (impulse / collision.impulse - 1.0).abs() < 2e-3,
            "{kind:?}: impulse {impulse}, {}",
            collision.impulse
        );
        let energy = 0.5 * effective_mass(MASSES[0], MASSES[1]) * 0.25;
        assert!(
            (work - collision.dissipated).abs() < 3e-3 * energy,
            "{kind:?}: work {work}, {}",
            collision.dissipated
        );
        let greatest = collision.curve.iter().map(|p| p.force).fold(0.0, f64::max);
        assert!(
            greatest <= peak * (1.0 + 1e-12) && greatest > 0.995 * peak,
            "{kind:?}: {greatest} of {peak}"
        );
        assert!(collision.dissipated > -1e-9 * energy, "{kind:?}");
        assert_eq!(
            collision.least_force < 0.0,
            kind == LawKind::Kelvin,
            "{kind:?}"
        );
    }
}

#[test]
fn tangents_match_differences() {
    for kind in LawKind::ALL {
        let law = law(kind, 0.6, RestitutionIs::Input).between(MASSES[0], MASSES[1]);
        let mut memory = law.touch(0.4);
        for (x, v) in [(1e-3, 0.3), (4e-3, 0.1), (3.7e-3, -0.1), (2e-4, -0.2)] {
            let r = law.follow(x, v, &memory);
            let at = |x, v| law.follow(x, v, &memory).force;
            let dx = (at(x + 1e-8, v) - at(x - 1e-8, v)) / 2e-8;
            let dv = (at(x, v + 1e-6) - at(x, v - 1e-6)) / 2e-6;
            assert!(
                (r.by_indentation - dx).abs() <= 1e-5 * dx.abs().max(1.0),
                "{law:?} at {x}, {v}: {} against {dx}",
                r.by_indentation
            );
            assert!(
                (r.by_rate - dv).abs() <= 1e-5 * dv.abs().max(1.0),
                "{law:?} at {x}, {v}: {} against {dv}",
                r.by_rate
            );
            law.remember(x, v, &mut memory);
        }
    }
}

/// Condition for unique forces of a step: they never decrease with δ at a fixed rate, nor with the rate.
#[test]
fn forces_rise_with_indentation_and_rate() {
    for kind in LawKind::ALL {
        let law = law(kind, 0.4, RestitutionIs::Input).between(MASSES[0], MASSES[1]);
        for speed in [0.0, 1e-4, 0.3] {
            let mut memory = law.touch(speed);
            law.remember(3e-3, 0.2, &mut memory);
            for gain in [0.0, 100.0, 1e4] {
                for rate in [-2.0, -0.3, 0.0, 0.3, 2.0] {
                    let force = |i: i32| {
                        let x = f64::from(i) * 1e-4;
                        law.follow(x, rate + gain * x, &memory).force
                    };
                    for i in -20..80 {
                        assert!(
                            force(i + 1) >= force(i) - 1e-9,
                            "{kind:?}: falls after {i}, rate {rate}, gain {gain}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn only_the_pulling_kelvin_law_pulls() {
    for kind in LawKind::ALL {
        let numbers = law(kind, 0.3, RestitutionIs::Input).between(MASSES[0], MASSES[1]);
        for (x, v) in [(1e-4, -0.5), (1e-4, -50.0), (-1e-4, 0.5)] {
            let force = numbers.respond(x, v, 0.5).force;
            assert!(
                force >= 0.0 || kind == LawKind::Kelvin,
                "{kind:?} pulls with {force} N at {x}, {v}"
            );
        }
    }
    let kelvin = law(LawKind::Kelvin, 0.3, RestitutionIs::Input).between(4e4, 6e4);
    assert!(
        kelvin.respond(1e-4, -0.5, 0.5).force < 0.0,
        "kelvin must pull near release"
    );
}

/// Bodies pressed together from rest have no impact speed; the damping must stay bounded.
#[test]
fn a_touch_from_rest_is_damped_as_an_ordinary_one() {
    for kind in [LawKind::HertzDamp, LawKind::Ye] {
        let law = law(kind, 0.65, RestitutionIs::Input).between(MASSES[0], MASSES[1]);
        let ForceLaw::Hertz { damping, .. } = law else {
            panic!("a Hertz law");
        };
        let elastic = law.respond(1e-3, 0.0, 1.0).force;
        let mut memory = law.touch(0.0);
        for rate in [1e-8, 1e-5, 0.01, 0.3, 0.02] {
            let force = law.follow(1e-3, rate, &memory).force;
            assert!(
                force <= elastic * (1.0 + damping) * (1.0 + 1e-12),
                "{kind:?} at {rate}: {force}"
            );
            law.remember(1e-3, rate, &mut memory);
        }
        assert_eq!(memory.speed, 0.3);
    }
}

/// Two free masses with a dashpot c: e = exp(−πζ/√(1 − ζ²)) with ζ = c/(2√(k m)), whatever the speed.
#[test]
fn a_given_dashpot_rebounds_by_its_damping_ratio() {
    let mass = effective_mass(MASSES[0], MASSES[1]);
    for ratio in [0.05, 0.2, 0.6, 1.3] {
        for dashpot_law in [
            DashpotLaw::Kelvin,
            DashpotLaw::KelvinNoTension,
            DashpotLaw::Approach,
        ] {
            if dashpot_law == DashpotLaw::Kelvin && ratio >= 1.0 {
                continue;
            }
            let damping = ratio * 2.0 * (1e8 * mass).sqrt();
            let kind = LawKind::Dashpot(Dashpot {
                law: dashpot_law,
                damping,
            });
            let law = law(kind, 1.0, RestitutionIs::Input);
            let numbers = law.between(MASSES[0], MASSES[1]);
            let found = numbers.damping_ratio(mass).expect("a dashpot");
            assert!((found / ratio - 1.0).abs() < 1e-14, "{found}");
            assert_eq!(law.free_restitution(), None);
            let due = dashpot_law.free_restitution(found);
            if dashpot_law == DashpotLaw::Kelvin {
                let closed = (-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
                assert!((due - closed).abs() < 1e-14);
            }
            for speed in [0.1, 1.0] {
                let got = collide(&law, speed).realised_restitution();
                assert!(
                    (got - due).abs() < 1e-9,
                    "{dashpot_law:?} with {ratio} at {speed}: {got}, {due}"
                );
            }
        }
    }
}

/// The coefficient that a dashpot stands for gives the same dashpot.
#[test]
fn the_equivalent_coefficient_gives_the_dashpot() {
    let mass = effective_mass(MASSES[0], MASSES[1]);
    let by_coefficient = [
        (DashpotLaw::Kelvin, LawKind::Kelvin),
        (DashpotLaw::KelvinNoTension, LawKind::KelvinNoTension),
        (
            DashpotLaw::Approach,
            LawKind::ModifiedKelvin(ModifiedKelvin::MahmoudJankowski),
        ),
    ];
    for (dashpot_law, kind) in by_coefficient {
        assert_eq!(
            LawKind::Dashpot(Dashpot {
                law: dashpot_law,
                damping: 1.0
            })
            .name(),
            kind.name()
        );
        for e in [0.2, 0.65, 0.9] {
            let known = law(kind, e, RestitutionIs::Input).between(MASSES[0], MASSES[1]);
            let ratio = known.damping_ratio(mass).expect("a dashpot");
            let found = dashpot_law.equivalent_restitution(ratio);
            assert!(
                (found - e).abs() < 1e-12,
                "{dashpot_law:?}: {found} for {e}"
            );
        }
    }
    assert_eq!(DashpotLaw::Kelvin.equivalent_restitution(1.2), 0.0);
}

/// Follows indentations d from the original face in small steps, opening and closing where the force ends; calls `take` with
/// every d, force and depth crushed so far.
fn walk(law: &ForceLaw, reversals: &[f64], mut take: impl FnMut(f64, f64, f64)) {
    let (mut at, mut depth) = (0.0, 0.0);
    let mut memory = law.touch(0.1);
    for &to in reversals {
        for step in 1..=2000 {
            let d = at + (to - at) * f64::from(step) / 2000.0;
            let indentation = d - depth;
            let force = law.follow(indentation, 0.0, &memory).force;
            law.remember(indentation, 0.0, &mut memory);
            if indentation <= memory.crushed {
                depth += memory.crushed;
                memory = law.touch(0.1);
                memory.crushed_before = depth;
            }
            take(d, force, depth + memory.crushed);
        }
        at = to;
    }
}

fn crushing(force: f64, hardening: f64) -> ContactLaw {
    law(
        LawKind::Crushing(Crush {
            force,
            hardening,
            hertzian: false,
        }),
        1.0,
        RestitutionIs::Input,
    )
}

/// The static curve: force, depth and loop against a walk with the depth p as the only memory, written down from the definition.
#[test]
fn a_crushed_face_stays_crushed() {
    let (k, yields, share) = (1e8, 3e5, 0.05);
    let law = crushing(yields, share).between(MASSES[0], MASSES[1]);
    let reversals = [
        0.002, -0.001, 0.006, 0.005, 0.009, -0.004, 0.008, 0.012, -0.01,
    ];
    let (mut p, mut work, mut before) = (0.0_f64, 0.0, (0.0, 0.0));
    walk(&law, &reversals, |d, force, depth| {
        let (elastic, crushes) = (k * (d - p), yields + share * k * (d - yields / k));
        let due = elastic.min(crushes).max(0.0);
        if elastic > crushes {
            p = d - due / k;
        }
        assert!(
            (force - due).abs() < 1e-6 * yields,
            "at {d}: {force}, {due}"
        );
        assert!((depth - p).abs() < 1e-12, "at {d}: {depth}, {p}");
        work += 0.5 * (force + before.1) * (d - before.0);
        before = (d, force);
    });
    // Depth at 12 mm, and the area of all loops: what crushes from F_y to the last force.
    let last = yields + share * k * (0.012 - yields / k);
    assert!((p - (0.012 - last / k)).abs() < 1e-12);
    let area = 0.5 * (yields + last) * p;
    assert!((work / area - 1.0).abs() < 1e-3, "{work}, {area}");
}

/// Free masses: what is lost is what crushes the face, and a second impact as strong crushes no more where it does not harden.
#[test]
fn a_collision_loses_what_it_crushes() {
    let mass = effective_mass(MASSES[0], MASSES[1]);
    let law = crushing(3e5, 0.05);
    let found = collide(&law, 0.5);
    let peak = found.peak_force.expect("a force");
    let numbers = law.between(MASSES[0], MASSES[1]);
    assert!((numbers.elastic_force(mass, 0.5) / peak - 1.0).abs() < 1e-12);
    let depth = found.peak_indentation - peak / 1e8;
    let lost = 0.5 * (3e5 + peak) * depth;
    assert!((found.dissipated / lost - 1.0).abs() < 1e-10, "{found:?}");
    // ½ k x² of the peak comes back.
    let back = (peak * peak / 1e8 / mass).sqrt();
    assert!((found.separation_speed / back - 1.0).abs() < 1e-10);
    assert_eq!(collide(&law, 0.05).dissipated, 0.0);
    assert_eq!(law.free_restitution(), None);
}

/// With given constants the law is that of the same constants by a design speed.
#[test]
fn given_bilinear_constants_are_those_of_a_design_speed() {
    let shape = BilinearShape {
        design_speed: Some(0.8),
        ..BilinearShape::USUAL
    };
    let designed = law(LawKind::Bilinear(shape), 0.6, RestitutionIs::Input);
    let ForceLaw::Bilinear(bilinear) = designed.between(MASSES[0], MASSES[1]) else {
        panic!("a bilinear law");
    };
    let constants = BilinearConstants {
        second_stiffness: bilinear.second_stiffness,
        yield_indentation: bilinear.yield_indentation,
    };
    let given = ContactLaw {
        kind: LawKind::BilinearGiven(constants),
        stiffness: bilinear.first_stiffness,
        ..designed
    };
    for speed in [0.05, 0.8, 1.5] {
        assert_eq!(collide(&given, speed), collide(&designed, speed));
    }
    assert_eq!(given.kind.name(), "bilinear");
    let LawKind::BilinearGiven(half) = given.with_stiffness(0.5 * given.stiffness).kind else {
        panic!("constants");
    };
    assert_eq!(half.second_stiffness, 0.5 * bilinear.second_stiffness);
}

/// Points of a contact that share it push together as the whole.
#[test]
fn shared_constants_add_up() {
    let kinds = [
        LawKind::Dashpot(Dashpot {
            law: DashpotLaw::Kelvin,
            damping: 2e5,
        }),
        LawKind::BilinearGiven(BilinearConstants {
            second_stiffness: 3e7,
            yield_indentation: 1e-3,
        }),
        LawKind::Crushing(Crush {
            force: 2e5,
            hardening: 0.1,
            hertzian: false,
        }),
        LawKind::Hertz,
    ];
    for kind in kinds {
        let whole = law(kind, 1.0, RestitutionIs::Input);
        let of = |law: &ContactLaw| law.between(MASSES[0], MASSES[1]).respond(4e-3, 0.2, 0.5);
        let parts: f64 = [0.1, 0.35, 0.55]
            .map(|share| of(&whole.shared(whole.stiffness, share)).force)
            .iter()
            .sum();
        assert!((parts / of(&whole).force - 1.0).abs() < 1e-14, "{kind:?}");
    }
}
