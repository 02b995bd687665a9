//! Suites of buildings with a plan: their numbers do not depend on the direction in which the building stands, and no direction is
//! left out.

use jostle_run::Opened;
use jostle_study::suite::{Suite, SuiteOptions, SuiteResults};
use jostle_testkit::files::sound;

/// A tower shaken by two components of two records, along x and across or the other way round.
fn results(turned: bool) -> SuiteResults {
    let [x, y] = match turned {
        false => ["40 MN/m", "60 MN/m"],
        true => ["60 MN/m", "40 MN/m"],
    };
    let [first, second] = ["\"el-centro-1940-ns\"", "\"nanjing-artificial\""];
    let [along, across] = match turned {
        false => [format!("{first}, {second}"), format!("{second}, {first}")],
        true => [format!("{second}, {first}"), format!("{first}, {second}")],
    };
    let text = format!(
        "[motion]\nrecord = [{along}]\nacross = {{ record = [{across}], scale = 1 }}\nduration = \"6 s\"\n\
         [[building]]\nname = \"A\"\nkind = \"shear\"\nstorey_height = \"3 m\"\nplan = [\"10 m\", \"10 m\"]\n\
         mass = [\"100 t\", \"90 t\"]\ndamping = {{ alpha = 0.4, beta = 0.002 }}\n\
         stiffness = {{ x = \"{x}\", y = \"{y}\", torsion = \"5 GN.m/rad\" }}\n"
    );
    let opened = Opened::new(sound(&text), "tower".to_owned());
    let suite = Suite::new(&opened.unwrap_or_else(|error| panic!("{error}")), None);
    let options = SuiteOptions {
        report: false,
        sensitivity: false,
        jobs: Some(2),
    };
    let done =
        suite
            .unwrap_or_else(|error| panic!("{error}"))
            .run(None, &options, &|| false, &|_| {});
    let done = done.unwrap_or_else(|error| panic!("{error}"));
    done.results.expect("all records")
}

#[test]
fn directions_change_their_names_with_the_building_and_corners_keep_theirs() {
    let [original, turned] = [false, true].map(results);
    let of = |results: &SuiteResults, name: &str| {
        let found = results.quantity(&format!("A.{name}"));
        found.unwrap_or_else(|| panic!("{name}")).mean
    };
    for (name, other) in [
        ("drift_peak", "drift_across_peak"),
        ("drift_corner_peak", "drift_corner_peak"),
        ("base_shear_peak_n", "base_shear_across_peak_n"),
        (
            "total_acceleration_peak_m_s2",
            "total_acceleration_across_peak_m_s2",
        ),
        (
            "floor2.storey_shear_peak_n",
            "floor2.storey_shear_across_peak_n",
        ),
        ("corner_displacement_peak_m", "corner_displacement_peak_m"),
    ] {
        for (name, other) in [(name, other), (other, name)] {
            let (here, there) = (of(&original, name), of(&turned, other));
            assert!(here > 0.0, "{name}");
            assert!((here / there - 1.0).abs() < 1e-6, "{name}: {here} {there}");
        }
    }
    let text = original.plain_text();
    for part in [
        "A, storey drift across",
        "A, base shear across",
        "accuracy: ",
    ] {
        assert!(text.contains(part), "{part} is missing:\n{text}");
    }
}
