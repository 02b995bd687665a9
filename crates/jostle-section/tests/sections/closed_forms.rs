//! Fibres against closed forms.

use jostle_section::formula::{self, Member};
use jostle_section::{
    AnalysisError, ConcreteLaw, EndCurve, EventKind, Fibres, MomentCurvature, Options, SteelLaw,
};

use crate::support::{beam, close, column, section};

#[test]
fn an_uncracked_section_bends_like_the_transformed_one() {
    // Nearly at rest, all of it in compression, the concrete is at its initial modulus.
    let section = beam();
    let fibres = Fibres::new(&section, 40);
    let (strain, curvature) = (1e-7, 2e-7);
    let transformed = section.transformed();
    let found = fibres.resultants(strain, curvature);
    let modulus = section.concrete.modulus;
    let lever = 0.5 * section.depth - transformed.centroid;
    let axial = modulus * transformed.area * (strain + curvature * lever);
    let about_middle = modulus * transformed.inertia * curvature + axial * lever;
    close(found.axial, axial, 1e-4, "axial force");
    close(found.moment, about_middle, 1e-4, "moment");
}

#[test]
fn first_crack_is_where_the_tension_face_says() {
    // N/A + M/W = −ft; concrete in compression is a little softer than at rest.
    let section = column();
    for axial in [0.0, 300e3] {
        let curve = MomentCurvature::new(&section, axial, Options::default()).expect("a curve");
        let crack = curve.event(EventKind::Cracking).expect("it cracks");
        let stress = section.concrete.tensile_strength + axial / section.transformed().area;
        let due = stress * formula::section_modulus(&section);
        close(crack.moment, due, 0.02, "cracking moment");
    }
}

#[test]
fn an_under_reinforced_beam_carries_what_the_stress_block_says() {
    let mut section = section(0.3, 0.6, "2 d12 top, 3 d25 bottom");
    section.steel.hardening = 0.0;
    let curve = MomentCurvature::new(&section, 0.0, Options::default()).expect("a curve");
    let crushed = curve.event(EventKind::Crushing).expect("it is crushed");
    let (area, strength) = (
        formula::tension_steel(&section),
        section.steel.yield_strength,
    );
    let x = area * strength / (section.concrete.strength * section.width);
    let due = area * strength * (formula::effective_depth(&section) - 0.5 * x);
    close(crushed.moment, due, 0.03, "ultimate moment");
    close(curve.peak_moment(), due, 0.03, "peak moment");
}

#[test]
fn axial_force_and_moment_interact_as_the_stress_block_says() {
    for (axial, tolerance) in [(500e3, 0.05), (1000e3, 0.05), (1500e3, 0.06)] {
        let mut section = section(0.5, 0.5, "4 d25 top, 4 d25 bottom");
        section.steel.hardening = 0.0;
        let curve = MomentCurvature::new(&section, axial, Options::default()).expect("a curve");
        close(
            curve.peak_moment(),
            formula::ultimate_gb(&section, axial),
            tolerance,
            "moment",
        );
    }
    // Pure compression: concrete at its strength, bars at the same strain.
    let section = column();
    let law = ConcreteLaw::unconfined(&section.concrete);
    let bars = section.steel_area();
    let steel = SteelLaw(section.steel).stress(law.peak_strain);
    let due = law.peak_stress * (section.area() - bars) + steel * bars;
    let error =
        MomentCurvature::new(&section, 1.001 * due, Options::default()).expect_err("too much");
    let AnalysisError::Overloaded { capacity, .. } = error else {
        panic!("{error}");
    };
    close(1e3 * capacity, due, 1e-9, "axial strength");
    assert!(MomentCurvature::new(&section, 0.9 * due, Options::default()).is_ok());
    assert!(matches!(
        MomentCurvature::new(&section, -1e6, Options::default()),
        Err(AnalysisError::Torn { .. })
    ));
}

#[test]
fn fibres_agree_with_a_fine_sum() {
    // A second algorithm: a hundred thousand slices by the midpoint rule.
    for section in [column(), beam()] {
        let law = ConcreteLaw::unconfined(&section.concrete);
        let steel = SteelLaw(section.steel);
        for (strain, curvature) in [(2e-4, 1e-3), (1e-4, 8e-3), (-1e-3, 2e-2), (1.5e-3, 4e-3)] {
            let (mut axial, mut moment) = (0.0, 0.0);
            let mut add = |force: f64, depth: f64| {
                axial += force;
                moment += force * (0.5 * section.depth - depth);
            };
            let at = |depth: f64| strain + curvature * (0.5 * section.depth - depth);
            let slices = 100_000;
            let part = section.depth / f64::from(slices);
            for slice in 0..slices {
                let depth = (f64::from(slice) + 0.5) * part;
                add(law.stress(at(depth)) * section.width * part, depth);
            }
            for bar in &section.bars {
                let concrete = law.stress(at(bar.depth)).max(0.0);
                add(
                    bar.area() * (steel.stress(at(bar.depth)) - concrete),
                    bar.depth,
                );
            }
            let errors = [4, 8, 16, 40].map(|count| {
                let found = Fibres::new(&section, count).resultants(strain, curvature);
                (found.moment - moment).abs() / moment.abs()
            });
            assert!(errors[3] < 2e-6, "{errors:?}");
            assert!(errors[0] < 1e-2, "{errors:?}");
            let exact = Fibres::new(&section, 1000)
                .resultants(strain, curvature)
                .moment;
            let [coarse, fine] = [10, 80].map(|count| {
                (Fibres::new(&section, count)
                    .resultants(strain, curvature)
                    .moment
                    - exact)
                    .abs()
            });
            assert!(
                fine <= coarse / 100.0 + 1e-9 * exact.abs(),
                "{coarse} then {fine}"
            );
        }
    }
}

#[test]
fn ties_confine_the_core() {
    // Without pressure the confined law is the plain rising branch.
    let mut tied = column();
    tied.ties = jostle_section::Ties::parse("d10 @ 100 mm").ok();
    let plain = MomentCurvature::new(&column(), 1e6, Options::default()).expect("a curve");
    let curve = MomentCurvature::new(&tied, 1e6, Options::default()).expect("a curve");
    let last = |curve: &MomentCurvature| curve.points.last().map_or(0.0, |point| point.deformation);
    assert!(
        last(&curve) > 2.0 * last(&plain),
        "{} and {}",
        last(&curve),
        last(&plain)
    );
    let core = jostle_section::confined(&tied).expect("confined");
    assert!(core.peak_stress > tied.concrete.strength);
    assert!(core.peak_stress < 1.5 * tied.concrete.strength);
}

#[test]
fn the_rotation_is_the_integral_of_the_curvature() {
    let section = column();
    let length = 3.0;
    let curve = MomentCurvature::new(&section, 1e6, Options::default()).expect("a curve");
    let fit = curve.trilinear().expect("a fit");
    let side = EndCurve::side_of(&section, &fit, length);
    let span = 0.5 * length;
    let curvature = |moment: f64| {
        if moment < fit.cracking.force {
            moment / fit.initial()
        } else {
            fit.cracking.deformation + (moment - fit.cracking.force) / fit.post_cracking()
        }
    };
    let parts = 100_000;
    let sum: f64 = (0..parts)
        .map(|part| (f64::from(part) + 0.5) / f64::from(parts))
        .map(|share| curvature(share * fit.yielding.force) * share)
        .sum();
    let bent = span * sum / f64::from(parts);
    let slip = fit.yielding.deformation * 0.022 * 400.0 * 0.02;
    close(
        side.yielding.deformation,
        bent + slip,
        1e-8,
        "rotation at yield",
    );
    close(
        side.cracking.force / side.cracking.deformation,
        6.0 * fit.initial() / length,
        1e-12,
        "initial stiffness",
    );
}

#[test]
fn hinge_and_member_in_series_are_the_curve() {
    let (section, length) = (column(), 3.2);
    let curve = EndCurve::by_formula(&section, 8e5, length, Member::Column);
    let member = 6.0 * section.gross_rigidity() / length;
    let backbone = curve.hinge(member, 1e5 * member / 6.0).expect("a hinge");
    let side = backbone.side(jostle::hysteresis::Side::Positive);
    let y = curve.sides[0].yielding;
    close(
        side.yielding.deformation + y.force / member,
        y.deformation,
        1e-9,
        "yield",
    );
    let after = 1.0 / (1.0 / side.post_yield + 1.0 / member);
    close(after, curve.sides[0].post_yield, 1e-9, "slope after yield");
    // The hinge itself hardly opens before it cracks.
    assert!(side.cracking.deformation < 1e-4 * y.deformation);
}
