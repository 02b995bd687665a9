//! What Zhang et al. (2019) report of five- beside ten-storey frames, as trends of the built-in example.

use std::path::Path;

use jostle_io::{Format, StudyFile};
use jostle_study::dataset::{Table, read_columns};
use jostle_study::{RunSettings, Study, run};

const GAPS: [f64; 4] = [0.005, 0.015, 0.04, 0.3];

fn table(duration: &str, extra: &str, pga: &[f64]) -> Table {
    let text = format!(
        r#"
base = "paper"
[[vary]]
path = "motion.duration"
values = ["{duration}"]
{extra}
[[vary]]
name = "peak"
path = "motion.pga"
values = {pga:?}
[[vary]]
name = "gap"
path = "gap[0].width"
values = {GAPS:?}
"#
    );
    let file = StudyFile::parse("trends", &text, Format::Toml, Path::new(""), None);
    let study = Study::new(file.unwrap_or_else(|error| panic!("{error}")));
    let study = study.unwrap_or_else(|error| panic!("{error}"));
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let done = run(
        &study,
        folder.path(),
        &RunSettings::default(),
        &|| false,
        &|_| {},
        &|_| {},
    );
    let done = done.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((done.failed, done.complete), (0, true));
    let names = study.layout.names();
    read_columns(&study, folder.path(), &names).unwrap_or_else(|error| panic!("{error}"))
}

/// The number of a column for the j-th peak and the i-th gap.
fn at(table: &Table, name: &str, j: usize, i: usize) -> f64 {
    let values = table.column(name);
    values[j * GAPS.len() + i].unwrap_or_else(|| panic!("{name} is absent"))
}

fn expect_trends(table: &Table, peaks: usize) {
    for j in 0..peaks {
        for i in 1..GAPS.len() {
            for name in ["impact_count", "impulse_n_s"] {
                let (narrow, wide) = (at(table, name, j, i - 1), at(table, name, j, i));
                assert!(
                    wide < narrow || (wide == 0.0 && narrow == 0.0),
                    "{name} does not fall from gap {} to {} at peak {j}: {narrow} {wide}",
                    GAPS[i - 1],
                    GAPS[i]
                );
            }
        }
        let force = |i| at(table, "peak_force_n", j, i);
        assert!(force(0) > 0.0 && force(GAPS.len() - 1) == 0.0);
        assert!(
            force(2) < force(0).max(force(1)),
            "force falls with the gap"
        );
        // Impacts concentrate at the top of the short building.
        let impulse = |floor: usize| {
            at(
                table,
                &format!("J1-J2.floor{floor}-{floor}.impulse_n_s"),
                j,
                0,
            )
        };
        for floor in 1..5 {
            assert!(
                impulse(floor) < impulse(floor + 1),
                "floor {floor} at peak {j}"
            );
        }
        // Several floors hit at once where the gap is small.
        assert!(at(table, "J1-J2.most_at_once", j, 0) >= 3.0);
        // Displacement is limited on the side of the impact: J1 to the right, J2 to the left.
        let free = GAPS.len() - 1;
        let right = |i| at(table, "J1.floor5.displacement_max_m", j, i);
        let left = |i| -at(table, "J2.floor5.displacement_min_m", j, i);
        assert!(
            right(0) < 0.95 * right(free),
            "J1: {} {}",
            right(0),
            right(free)
        );
        assert!(
            left(0) < 0.95 * left(free),
            "J2: {} {}",
            left(0),
            left(free)
        );
    }
}

#[test]
fn elastic_frames_pound_less_across_wider_gaps_and_more_in_stronger_shaking() {
    let table = table("10 s", "", &[0.7, 1.4, 2.2]);
    expect_trends(&table, 3);
    for i in 0..GAPS.len() - 1 {
        for j in 1..3 {
            for name in ["peak_force_n", "impact_count", "impulse_n_s"] {
                let (weak, strong) = (at(&table, name, j - 1, i), at(&table, name, j, i));
                assert!(strong > weak, "{name} across {}: {weak} {strong}", GAPS[i]);
            }
        }
    }
}

#[test]
fn yielding_frames_pound_less_across_wider_gaps_and_more_in_stronger_shaking() {
    // As published, without P-Delta. A hundredth is enough for trends.
    let hinges = r#"
[[vary]]
path = "analysis.tolerance"
values = [1e-2]
[[vary]]
name = "p_delta"
path = "building[*].p_delta"
values = [false]
[[vary]]
name = "hinges"
path = "building[*].hinges"
values = [{ rule = "peak-oriented", initial = "rigid", column = { cracking = "120 kN.m", yield = "400 kN.m", post_cracking = 0.3, post_yield = 0.02 }, beam = { cracking = "80 kN.m", yield = "260 kN.m", post_cracking = 0.3, post_yield = 0.02 } }]
"#;
    let table = table("6 s", hinges, &[0.7, 2.2]);
    expect_trends(&table, 2);
    assert!(
        at(&table, "J1.hinges_cracked", 1, 3) > 0.0,
        "the frames crack"
    );
    // Cracked frames swing slower: impacts grow in strength, not in number.
    for i in 0..2 {
        for name in ["peak_force_n", "impulse_n_s"] {
            let (weak, strong) = (at(&table, name, 0, i), at(&table, name, 1, i));
            assert!(strong > weak, "{name} across {}: {weak} {strong}", GAPS[i]);
        }
    }
    assert_eq!(at(&table, "impact_count", 0, 2), 0.0);
    assert!(at(&table, "impact_count", 1, 2) > 0.0);
}
