//! What a gap closes beyond its width is the greatest indentation, of faces that are not parallel as well.

use crate::support::ran;

/// Two shear buildings, the right one with these keys of its plan.
fn pair(plans: [&str; 2]) -> String {
    let building = |name: &str, stiffness: f64, plan: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nstoreys = 3\nstorey_height = \"3 m\"\nmass = \"150 t\"\nstiffness = {stiffness}\n{plan}\n"
        )
    };
    format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.4 g\"\nduration = \"6 s\"\n{}{}[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = \"20 mm\"\nlaw = \"hertz-damp\"\nstiffness = \"2e9 N/m^1.5\"\nrestitution = 0.65\n",
        building("a", 6e7, plans[0]),
        building("b", 25e7, plans[1]),
    )
}

#[test]
fn closing_beyond_the_width_is_indentation() {
    let plane = pair(["", ""]);
    let left = "plan = [\"12 m\", \"9 m\"]\neccentricity = [\"0 m\", \"1 m\"]";
    let parallel = pair([left, "plan = [\"10 m\", \"9 m\"]"]);
    let oblique = pair([
        left,
        "plan = [[\"0 m\", \"0 m\"], [\"10 m\", \"0 m\"], [\"10 m\", \"9 m\"], [\"160 mm\", \"9 m\"]]",
    ]);
    for (text, widens) in [(plane, false), (parallel, false), (oblique, true)] {
        let ran = ran(&text);
        let summary = ran.summary();
        let gap = &summary.gaps[0];
        assert!(gap.impact_count > 0);
        let widths = ran
            .prepared
            .system
            .contacts
            .iter()
            .map(|contact| contact.width);
        let widest = widths.fold(0.0, f64::max);
        assert_eq!(widest > 2.0 * gap.width_m, widens, "{widest} m");
        let mut deepest = 0.0_f64;
        for contact in &gap.contacts {
            let depths = contact
                .impacts
                .iter()
                .map(|impact| impact.peak_indentation_m);
            let depth = depths.fold(0.0, f64::max);
            let beyond = contact.closing_peak_m - contact.width_m;
            assert!(
                (beyond.max(0.0) - depth).abs() < 1e-3 * depth + 1e-9,
                "{beyond} and {depth} m"
            );
            deepest = deepest.max(depth);
        }
        assert!((gap.clearance_m + deepest).abs() < 1e-3 * deepest);
    }
}
