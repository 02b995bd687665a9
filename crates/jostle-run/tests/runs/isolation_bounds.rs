//! The envelope over the bounds of bearings against runs of files whose properties are multiplied by hand.

use std::ops::ControlFlow;

use jostle::Summary;
use jostle::results::isolation_bounds::Bounded;
use jostle_run::Opened;
use jostle_testkit::files::{refusal, sound};

/// A building on bearings beside a moat wall; `isolation` has the properties of the bearings.
fn model(isolation: &str, limit: &str) -> String {
    format!(
        r#"
motion = {{ kind = "ricker", amplitude = "5 m/s2", period = "1 s" }}
[[building]]
name = "A"
kind = "shear"
mass = "100 t"
stiffness = ["200 MN/m", "150 MN/m"]
storey_height = "3 m"
damping = {{ ratio = 0.02 }}
isolation = {{ mat_mass = "150 t", {limit}{isolation} }}
[[wall]]
name = "moat"
stiffness = "120 MN/m"
mass = "25 t"
[[gap]]
between = ["A", "moat"]
floors = [[0, "wall"]]
width = "30 mm"
stiffness = "2e9 N/m^1.5"
"#
    )
}

fn lead(stiffness: f64, strength: f64) -> String {
    format!(
        "kind = \"lead-rubber\", stiffness = {}, yield = {}, post_yield = 0.1",
        30e6 * stiffness,
        150e3 * strength
    )
}

fn pendulum(friction: f64) -> String {
    format!(
        "kind = \"friction-pendulum\", radius = \"2 m\", friction = {}",
        0.05 * friction
    )
}

fn run(text: &str) -> Summary {
    let opened = Opened::new(sound(text), "model").unwrap_or_else(|error| panic!("{error}"));
    let prepared = opened.prepare().unwrap_or_else(|error| panic!("{error}"));
    let settings = prepared.settings(false);
    let mut observer = |_, _| ControlFlow::Continue(());
    let mut ran = prepared.run(settings, &mut observer);
    ran.run_without_contact(settings, &mut observer);
    ran.run_isolation_bounds(true, &mut observer);
    ran.summary()
}

/// Stroke, force, drift, contact force, gap needed and greatest storey shear of a run.
fn peaks(summary: &Summary) -> [f64; 6] {
    let building = &summary.buildings[0];
    let isolation = building.isolation.as_ref().expect("bearings");
    let shears = building.floors.above.iter();
    let shears = shears.map(|floor| floor.response.storey_shear_peak_n);
    [
        isolation.displacement_peak_m(),
        isolation.force_peak_n,
        building.response.drift_peak,
        summary.gaps[0].peak_force_n,
        summary.gaps[0].closing_without_contact_m.expect("a gap"),
        shears.fold(0.0, f64::max),
    ]
}

#[test]
fn bounds_are_runs_with_properties_multiplied_by_hand() {
    let linear = |factor: f64| format!("kind = \"linear\", stiffness = {}", 4e6 * factor);
    let cases = [
        (
            lead(1.0, 1.0),
            "lower = 0.85, upper = 1.3",
            [lead(0.85, 0.85), lead(1.3, 1.3)],
        ),
        (
            lead(1.0, 1.0),
            "lower = { strength = 0.8 }, upper = { stiffness = 1.2, strength = 1.6 }",
            [lead(1.0, 0.8), lead(1.2, 1.6)],
        ),
        (
            pendulum(1.0),
            "lower = 0.8, upper = { strength = 1.5 }",
            [pendulum(0.8), pendulum(1.5)],
        ),
        (
            linear(1.0),
            "lower = 0.9, upper = 1.25",
            [linear(0.9), linear(1.25)],
        ),
    ];
    for (bearings, bounds, ends) in cases {
        let summary = run(&model(&format!("{bearings}, bounds = {{ {bounds} }}"), ""));
        let found = summary.isolation_bounds.as_ref().expect("bounds were run");
        let building = &found.buildings[0];
        let found: [Bounded; 6] = [
            building.stroke_m.expect("bearings"),
            building.force_n.expect("bearings"),
            building.drift,
            found.gaps[0].peak_force_n,
            found.gaps[0].closing_without_contact_m.expect("a gap"),
            building.storey_shear_n,
        ];
        let by_hand = ends.map(|text| peaks(&run(&model(&text, ""))));
        let nominal = peaks(&run(&model(&bearings, "")));
        assert!(nominal[3] > 0.0, "the mat touches the wall");
        for (index, range) in found.iter().enumerate() {
            let near = |value: f64, due: f64| (value - due).abs() <= 1e-12 * due;
            let [lower, upper] = by_hand.map(|run| run[index]);
            assert!(near(range.nominal, nominal[index]), "{bounds}: {range:?}");
            assert!(near(range.lower, lower), "{bounds}: {range:?} {lower}");
            assert!(near(range.upper, upper), "{bounds}: {range:?} {upper}");
            let greatest = range.nominal.max(range.lower).max(range.upper);
            assert!(range.envelope == greatest && range.lower != range.upper);
        }
    }
}

/// A stroke that only a bound exceeds is beyond the limit.
#[test]
fn the_limit_of_bearings_holds_at_the_bounds_too() {
    let text = format!(
        "{}, bounds = {{ lower = 0.7, upper = 1.3 }}",
        lead(1.0, 1.0)
    );
    let summary = run(&model(&text, ""));
    let stroke = summary.isolation_bounds.expect("run").buildings[0].stroke_m;
    let stroke = stroke.expect("bearings");
    assert!(stroke.envelope > stroke.nominal);
    let at = |limit: f64| run(&model(&text, &format!("limit = {limit}, ")));
    let between = 0.5 * (stroke.nominal + stroke.envelope);
    let is_found = |summary: &Summary| {
        summary
            .checks
            .iter()
            .any(|check| check.name == "bearing-stroke")
    };
    assert!(is_found(&at(between)));
    assert!(!is_found(&at(1.01 * stroke.envelope)));
    let nominal_only = run(&model(&lead(1.0, 1.0), &format!("limit = {between}, ")));
    assert!(!is_found(&nominal_only) && nominal_only.isolation_bounds.is_none());
}

#[test]
fn bounds_that_mean_nothing_are_refused() {
    let with =
        |kind: String, bounds: &str| refusal(&model(&format!("{kind}, bounds = {bounds}"), ""));
    for (kind, bounds, place, remedy) in [
        (
            lead(1.0, 1.0),
            "{ lower = 1.1, upper = 1.3 }",
            "bounds.lower",
            "at most 1",
        ),
        (
            lead(1.0, 1.0),
            "{ lower = 0.9, upper = 0.95 }",
            "bounds.upper",
            "at least 1",
        ),
        (
            lead(1.0, 1.0),
            "{ lower = 0.9 }",
            "bounds.upper",
            "add upper = 1.3",
        ),
        (
            lead(1.0, 1.0),
            "{ lower = 0, upper = 1.3 }",
            "bounds.lower",
            "greater than zero",
        ),
        (
            pendulum(1.0),
            "{ lower = 0.9, upper = { stiffness = 1.2 } }",
            "upper.stiffness",
            "leave it out",
        ),
        (
            "kind = \"linear\", stiffness = 4e6".to_owned(),
            "{ lower = { strength = 0.9 }, upper = 1.2 }",
            "lower.strength",
            "leave it out",
        ),
    ] {
        let text = with(kind, bounds);
        assert!(
            text.contains(place) && text.contains(remedy),
            "{bounds}: {text}"
        );
        // The file, the line.
        assert!(text.contains(":10"), "{bounds}: {text}");
    }
}

/// A moat between the gap needed by nominal bearings and that at their bounds: the verdict says that they collide there alone.
#[test]
fn the_verdict_names_collisions_at_the_bounds_alone() {
    let bounded = format!(
        "{}, bounds = {{ lower = 0.7, upper = 1.3 }}",
        lead(1.0, 1.0)
    );
    let wide = model(&bounded, "").replace("30 mm", "1 m");
    let needed = run(&wide).isolation_bounds.expect("bounds").gaps[0].closing_without_contact_m;
    let needed = needed.expect("runs without contact");
    assert!(needed.envelope > 1.02 * needed.nominal, "{needed:?}");
    let between = 500.0 * (needed.nominal + needed.envelope);
    let summary = run(&model(&bounded, "").replace("30 mm", &format!("{between} mm")));
    assert_eq!(summary.gaps[0].impact_count, 0);
    let force = summary.isolation_bounds.as_ref().expect("bounds").gaps[0]
        .peak_force_n
        .envelope;
    let verdict = jostle_report::verdict(&summary);
    let said = format!(
        "At the bounds of the bearings, A and moat collide with up to {:.0}",
        1e-3 * force
    );
    assert!(verdict.contains(&said), "{verdict}");
    assert!(!jostle_report::verdict(&run(&wide)).contains("At the bounds"));
}
