//! What rules require of neighbours does not depend on the direction in which they stand on the site.

use jostle_run::{GapSettings, critical_gaps};
use jostle_testkit::files::sound;

/// Two buildings side by side along x, or the same along y, shaken in the direction in which they meet.
fn pair(along_x: bool) -> String {
    let swapped = |x: &str, y: &str| match along_x {
        true => format!("[\"{x}\", \"{y}\"]"),
        false => format!("[\"{y}\", \"{x}\"]"),
    };
    let building = |name: &str, at: &str, meeting: u32, other: u32| {
        let [x, y] = if along_x {
            [meeting, other]
        } else {
            [other, meeting]
        };
        let storey = format!("{{ x = \"{x} MN/m\", y = \"{y} MN/m\", torsion = \"5 GN.m/rad\" }}");
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nstorey_height = \"3 m\"\nplan = {}\nat = {}\nmass = [\"100 t\", \"90 t\"]\nstiffness = [{storey}, {storey}]\ndamping = {{ alpha = 0.4, beta = 0.002 }}\n",
            swapped("10 m", "8 m"),
            swapped(at, "0 m"),
        )
    };
    let angle = if along_x { 0 } else { 90 };
    format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.2 g\"\nduration = \"6 s\"\nangle = \"{angle} deg\"\n{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"100 mm\"\n",
        building("A", "0 m", 60, 20),
        building("B", "10.1 m", 40, 150),
    )
}

/// Displacements along the normal, and the periods of the modes that move along it, not the longest of all.
#[test]
fn rules_follow_the_direction_in_which_buildings_meet() {
    let settings = GapSettings {
        outcomes: false,
        ..GapSettings::default()
    };
    let [along, across] = [true, false].map(|along_x| {
        let input = sound(&pair(along_x));
        let motion = input
            .ground_motion()
            .unwrap_or_else(|error| panic!("{error}"));
        let found = critical_gaps(&input.model, &motion, &settings, &|| false);
        found.unwrap_or_else(|error| panic!("{error}")).remove(0)
    });
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
    for side in 0..2 {
        assert!(near(along.periods_s[side], across.periods_s[side]));
    }
    // √(k/m) of two equal storeys is 0.618 of that of one.
    assert!(
        (0.3..0.5).contains(&along.periods_s[0]),
        "{:?}",
        along.periods_s
    );
    let of = |rules: &[jostle_run::RuleGap], name: &str| {
        let rule = rules.iter().find(|rule| rule.rule == name);
        rule.expect("the rule").gap_m
    };
    for rule in ["ABS", "SRSS", "DDC"] {
        let [a, b] = [of(&along.rules, rule), of(&across.rules, rule)];
        assert!(a > 0.01 && near(a, b), "{rule}: {a} {b}");
    }
}

/// What a rule leads to with the motion reversed is what it leads to under the reversed motion.
#[test]
fn outcomes_of_rules_are_those_of_both_signs() {
    let input = sound(&pair(true));
    let motion = input
        .ground_motion()
        .unwrap_or_else(|error| panic!("{error}"));
    let [critical_gap, other] = [motion.clone(), motion.reversed()].map(|motion| {
        let settings = GapSettings {
            tolerance: 1e-5,
            ..GapSettings::default()
        };
        let found = critical_gaps(&input.model, &motion, &settings, &|| false);
        found.unwrap_or_else(|error| panic!("{error}")).remove(0)
    });
    let needed = critical_gap.gap_m.max(other.gap_m);
    let mut differ = false;
    for (rule, reversed) in critical_gap.rules.iter().zip(&other.rules) {
        assert_eq!(rule.reversed_impact_count, reversed.impact_count);
        assert_eq!(rule.reversed_peak_force_n, reversed.peak_force_n);
        let ratio = rule.ratio_of_both_signs.expect("a gap is needed");
        // One smallest gap is bracketed, the other is the closing without contact.
        let off = ratio * needed - rule.gap_m;
        assert!(off.abs() < 1e-3 * needed, "{needed} {rule:?}");
        let worse = rule.worse_outcome().expect("an outcome");
        let forces = [rule.peak_force_n, rule.reversed_peak_force_n].map(Option::unwrap_or_default);
        assert_eq!(worse.peak_force_n, forces[0].max(forces[1]));
        differ |= worse.is_reversed;
    }
    assert!(differ, "one rule is worse with the motion reversed");
}
