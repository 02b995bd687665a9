//! Curves of moment and curvature, and what is fitted to them.

use jostle_section::{AnalysisError, EventKind, MomentCurvature, Options};

use crate::support::{beam, close, column, section};

#[test]
fn the_fit_has_the_area_of_the_curve() {
    for (section, axial) in [
        (column(), 0.0),
        (column(), 1e6),
        (column(), 2.5e6),
        (beam(), 0.0),
    ] {
        let curve = MomentCurvature::new(&section, axial, Options::default()).expect("a curve");
        let fit = curve.trilinear().expect("a fit");
        let area: f64 = curve
            .points
            .windows(2)
            .map(|p| 0.5 * (p[0].force + p[1].force) * (p[1].deformation - p[0].deformation))
            .sum();
        let corners = [Default::default(), fit.cracking, fit.yielding, fit.ultimate];
        let below: f64 = corners
            .windows(2)
            .map(|p| 0.5 * (p[0].force + p[1].force) * (p[1].deformation - p[0].deformation))
            .sum();
        close(below, area, 1e-9, "area");
        assert!(fit.initial() > fit.post_cracking() && fit.post_cracking() > fit.post_yield());
        assert!(fit.post_yield() >= 0.0);
        let peak = curve.peak_moment();
        assert!(
            fit.yielding.force <= 1.001 * peak,
            "{} of {peak}",
            fit.yielding.force
        );
        assert!(
            fit.yielding.force > 0.8 * peak,
            "{} of {peak}",
            fit.yielding.force
        );
    }
}

#[test]
fn events_come_in_order_and_on_the_curve() {
    let curve = MomentCurvature::new(&beam(), 0.0, Options::default()).expect("a curve");
    let kinds: Vec<_> = curve.events.iter().map(|event| event.kind).collect();
    assert_eq!(kinds[..2], [EventKind::Cracking, EventKind::TensionYield]);
    assert_eq!(kinds.last(), Some(&EventKind::Crushing));
    for event in &curve.events {
        assert!(
            curve
                .points
                .iter()
                .any(|point| point.deformation == event.curvature)
        );
    }
    let yielded = curve.event(EventKind::TensionYield).expect("it yields");
    // The strain of the deepest bar is that of yield.
    let strain = yielded.curvature * (0.56 - yielded.neutral_axis);
    close(strain, 400e6 / 200e9, 1e-9, "strain");
}

#[test]
fn too_little_reinforcement_is_said() {
    let section = section(0.5, 1.0, "2 d8 top, 2 d8 bottom");
    let curve = MomentCurvature::new(&section, 0.0, Options::default()).expect("a curve");
    let error = curve.trilinear().expect_err("brittle");
    assert!(matches!(error, AnalysisError::Brittle { .. }), "{error}");
}
