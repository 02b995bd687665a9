//! `[[building.rotation_limit]]`: from keys to limits, and what is refused.

use jostle::model::{LimitedMembers, RotationLevel, RotationMeasure};
use jostle_testkit::files::{refusal, sound};

const MODEL: &str = r#"
motion = { record = "el-centro-1940-ns" }
[[building]]
name = "A"
storeys = 2
storey_height = 3
spans = [5]
column = { EI = "60 MN.m2", mass = 0 }
beam = { EI = "80 MN.m2" }
beam_mass = 3000
hinges = { rule = "bilinear", column = { yield = "100 kN.m", post_yield = 0.02 }, beam = { yield = "80 kN.m", post_yield = 0.02 } }
"#;

#[test]
fn limits_name_members_and_levels() {
    let model = sound(&format!(
        "{MODEL}[[building.rotation_limit]]\nof = \"columns\"\nline = [1, 2]\nstoreys = 1\nmeasure = \"chord\"\nlimits = {{ io = \"5 mrad\", cp = 0.02 }}\n[[building.rotation_limit]]\nof = \"beams\"\nfloors = [1, 2]\nlimits = {{ ls = \"1 deg\" }}\n"
    ));
    let [columns, beams] = &model.model.buildings[0].rotation_limits[..] else {
        panic!("two tables")
    };
    assert_eq!(columns.of, LimitedMembers::Columns);
    assert_eq!(
        (columns.lines, columns.storeys),
        (Some([1, 2]), Some([1, 1]))
    );
    assert_eq!(columns.measure, RotationMeasure::Chord);
    let limits: Vec<_> = columns.limits.clone().into_iter().collect();
    assert_eq!(
        limits,
        [
            (RotationLevel::ImmediateOccupancy, 0.005),
            (RotationLevel::CollapsePrevention, 0.02)
        ]
    );
    assert_eq!((beams.of, beams.lines), (LimitedMembers::Beams, None));
    assert_eq!(beams.measure, RotationMeasure::Plastic);
    let degree = beams.limits[&RotationLevel::LifeSafety];
    assert!((degree / 1f64.to_radians() - 1.0).abs() < 1e-12);
}

#[test]
fn limits_that_do_not_fit_are_refused() {
    for (table, said) in [
        ("limits = { io = 0.005 }", "add of = \"columns\""),
        ("of = \"columns\"", "add limits ="),
        ("of = \"columns\"\nlimits = { }", "names no level"),
        (
            "of = \"columns\"\nlimits = { io = 0.01, ls = 0.005 }",
            "must exceed the limit of the level before it",
        ),
        (
            "of = \"columns\"\nbay = 1\nlimits = { io = 0.01 }",
            "bay: is a key of beams",
        ),
        (
            "of = \"beams\"\nstoreys = 1\nlimits = { io = 0.01 }",
            "storeys: is a key of columns",
        ),
        ("of = \"beams\"\nlimits = { io = \"5 mm\" }", "limits.io"),
    ] {
        let shown = refusal(&format!("{MODEL}[[building.rotation_limit]]\n{table}\n"));
        assert!(shown.contains(said), "{table}\n{shown}");
    }
}
