//! Columns of space frames whose ends are fibres: what a file says, and what is refused.

use jostle::hysteresis::{HysteresisRule, Side};
use jostle::{ColumnFibres, Fibre, SpaceFrame, SpacePlace, Structure};
use jostle_testkit::files::{read, refusal};

/// Two storeys of four columns; the keys of `column`, and of the building.
fn model(column: &str, keys: &str) -> String {
    format!(
        r#"
[[building]]
name = "A"
kind = "space-frame"
storeys = 2
storey_height = "3 m"
lines_x = ["0 m", "6 m"]
lines_y = ["0 m", "5 m"]
mass = "90 t"
concrete = "C30"
beam_x = {{ width = "0.3 m", depth = "0.6 m" }}
beam_y = {{ width = "0.3 m", depth = "0.5 m" }}
column = {{ size = ["500 mm", "400 mm"]{column} }}
{keys}
"#
    )
}

const BARS: &str = ", steel = \"HRB400\", bars = \"12 d20\", cover = \"35 mm\"";

/// Fibres of a building under its weight.
fn of_fibres(more: &str) -> String {
    let keys = format!("gravity = true\nhinges = {{ rule = \"fibre\", length = \"0.4 m\"{more} }}");
    model(BARS, &keys)
}

fn frame(text: &str) -> SpaceFrame {
    let input = read(text).unwrap_or_else(|error| panic!("{error}"));
    match &input.model.buildings[0].structure {
        Structure::Tiers(tiers) => tiers.space_frame.clone().expect("a space frame"),
        other => panic!("no plan: {other:?}"),
    }
}

fn first(frame: &SpaceFrame) -> &ColumnFibres {
    let place = SpacePlace::Column {
        line: [0, 0],
        storey: 0,
    };
    &frame.fibres[&place]
}

fn is_concrete(fibre: &Fibre) -> bool {
    matches!(fibre.spring.rule(), HysteresisRule::Concrete(_))
}

fn strength(fibre: &Fibre) -> f64 {
    fibre.spring.backbone().side(Side::Negative).yielding.force
}

/// Area, first moments and second moments of concrete cells, whose strength is that of C30; each cell has its own inertia besides.
#[test]
fn parts_of_concrete_are_the_rectangle() {
    for (asked, counts) in [
        (", fibres = [20, 10]", [20, 10]),
        (", fibres = 20", [20, 16]),
        ("", [12, 10]),
    ] {
        let frame = frame(&of_fibres(asked));
        assert_eq!(frame.fibres.len(), 8);
        let column = first(&frame);
        let concrete: Vec<&Fibre> = column
            .fibres
            .iter()
            .filter(|fibre| is_concrete(fibre))
            .collect();
        assert_eq!(concrete.len(), counts[0] * counts[1], "{asked}");
        let sum = |of: &dyn Fn(&Fibre) -> f64| -> f64 {
            let all = concrete
                .iter()
                .map(|concrete| strength(concrete) / 20.1e6 * of(concrete));
            all.sum()
        };
        let area = 0.5 * 0.4;
        assert!((sum(&|_| 1.0) / area - 1.0).abs() < 1e-12);
        for (axis, side) in [(0, 0.5_f64), (1, 0.4_f64)] {
            assert!(sum(&|column| column.at[axis]).abs() < 1e-12);
            let cells = 1.0 - (counts[axis] as f64).powi(-2);
            let inertia = area * side * side / 12.0 * cells;
            let second = sum(&|fibre| fibre.at[axis] * fibre.at[axis]);
            assert!((second / inertia - 1.0).abs() < 1e-12, "{asked} {axis}");
        }
    }
}

/// Twelve bars along all four faces, one in every corner: four along the faces across, two between them at the sides.
#[test]
fn every_bar_is_a_fibre() {
    let frame = frame(&of_fibres(""));
    let column = first(&frame);
    assert_eq!((column.length, column.at_ends), (0.4, [true, true]));
    let bars: Vec<&Fibre> = column
        .fibres
        .iter()
        .filter(|fibre| !is_concrete(fibre))
        .collect();
    assert_eq!(bars.len(), 12);
    let (x, y) = (0.25 - 0.045, 0.2 - 0.045);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    for sign in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let corner =
            |fibre: &&&Fibre| near(fibre.at[0], sign[0] * x) && near(fibre.at[1], sign[1] * y);
        assert_eq!(bars.iter().filter(corner).count(), 1);
    }
    let at_face = |axis: usize, to: f64| {
        let bars = bars.iter().filter(|bar| near(bar.at[axis].abs(), to));
        bars.count()
    };
    assert_eq!([at_face(0, x), at_face(1, y)], [8, 8]);
    let area = 0.25 * std::f64::consts::PI * 0.02 * 0.02;
    for bar in bars {
        assert!((strength(bar) / (400e6 * area) - 1.0).abs() < 1e-12);
    }
}

/// Concrete within the ties is stronger; parts that the edge of the core crosses are two fibres, and no area is lost.
#[test]
fn ties_confine_the_core_on_all_sides() {
    let column = format!("{BARS}, ties = \"4 d10 @ 100 mm\"");
    let keys = "gravity = true\nhinges = { rule = \"fibre\", length = 0.4, fibres = [10, 8] }";
    let frame = frame(&model(&column, keys));
    let concrete: Vec<&Fibre> = first(&frame)
        .fibres
        .iter()
        .filter(|fibre| is_concrete(fibre))
        .collect();
    // 30 mm lie outside of the ties, parts are 50 mm: the outer ones are both.
    assert_eq!(concrete.len(), 80 + 2 * 10 + 2 * 6);
    let strain = |fibre: &Fibre| {
        fibre
            .spring
            .backbone()
            .side(Side::Negative)
            .yielding
            .deformation
    };
    let middle = |fibre: &&&Fibre| fibre.at.iter().all(|at| (at - 0.025).abs() < 1e-12);
    let inner = concrete.iter().find(middle);
    let inner = *inner.expect("in the middle");
    let confined = |fibre: &&&Fibre| (strain(fibre) / strain(inner) - 1.0).abs() < 1e-9;
    let core: f64 = concrete
        .iter()
        .filter(confined)
        .map(|concrete| strength(concrete))
        .sum();
    let plain: f64 = concrete
        .iter()
        .map(|concrete| strength(concrete))
        .sum::<f64>()
        - core;
    let stress = strength(inner) / (0.05 * 0.05);
    assert!(stress > 1.1 * 20.1e6, "{stress}");
    let areas = [core / stress, plain / 20.1e6];
    let expected = [0.44 * 0.34, 0.5 * 0.4 - 0.44 * 0.34];
    for (got, expected) in areas.into_iter().zip(expected) {
        assert!((got / expected - 1.0).abs() < 1e-9, "{areas:?}");
    }
}

/// Feet of the lowest columns alone; the length of Paulay and Priestley; hinges of beams beside them; loads of floors.
#[test]
fn other_keys_are_those_of_plane_frames() {
    let keys = "gravity = true\nfloor_load = [\"300 kN\", \"200 kN\"]\nhinges = { rule = \"fibre\", length = \"paulay-priestley\", ends = \"base\", beam_rule = \"bilinear\", beam = { yield = \"200 kN.m\", post_yield = 0.01 } }";
    let frame = frame(&model(BARS, keys));
    assert_eq!(frame.floor_load, [300e3, 200e3]);
    assert_eq!(frame.fibres.len(), 4);
    let column = first(&frame);
    assert_eq!(column.at_ends, [true, false]);
    // 0.08 · 1.5 m + 0.022 · 20 mm · 400.
    assert!((column.length - 0.296).abs() < 1e-12);
    for member in &frame.members {
        let rules = member.hinges.map(|hinge| hinge.map(|frame| frame.rule()));
        let expected = match member.place {
            SpacePlace::Column { .. } => None,
            _ => Some(HysteresisRule::Bilinear),
        };
        assert_eq!(rules, [expected, None]);
    }
}

/// Beside bars, a concrete is that of the section; a modulus may be another one.
#[test]
fn concrete_of_bars_and_modulus_are_two_things() {
    let rigidity = |column: &str| {
        let keys = "gravity = true\nhinges = { rule = \"fibre\", length = 0.4 }";
        let frame = frame(&model(&format!("{BARS}{column}"), keys));
        let strength: f64 = first(&frame)
            .fibres
            .iter()
            .filter(|fibre| is_concrete(fibre))
            .map(strength)
            .sum();
        let section = frame.members[0].section;
        [
            section.axial_rigidity.expect("it stretches") / 0.2,
            strength / 0.2,
        ]
    };
    let is = |column: &str, expected: [f64; 2]| {
        for (got, expected) in rigidity(column).into_iter().zip(expected) {
            assert!((got / expected - 1.0).abs() < 1e-9, "{column}: {got}");
        }
    };
    is("", [30e9, 20.1e6]);
    is(", concrete = \"C40\"", [32.5e9, 26.8e6]);
    is(
        ", concrete = \"25 MPa\", elastic_modulus = \"28 GPa\"",
        [28e9, 25e6],
    );
}

#[test]
fn what_cannot_be_says_why() {
    let says = |text: &str, expected: &[&str]| {
        let error = refusal(text);
        for part in expected {
            assert!(error.contains(part), "{part} is not in {error}");
        }
    };
    let keys = "hinges = { rule = \"fibre\", length = 0.4 }";
    says(
        &model(BARS, &format!("gravity = true\naxial = \"rigid\"\n{keys}")),
        &[
            "needs columns that change their length",
            "axial = \"flexible\"",
        ],
    );
    says(&model(BARS, keys), &["gravity = true"]);
    says(
        &model("", &format!("gravity = true\n{keys}")),
        &["no column has bars", "bars = \"12 d20\""],
    );
    says(
        &of_fibres(", fibres = [20, 1]"),
        &["between 2 and 100, found 1"],
    );
    says(
        &of_fibres(", fibres = [20, 10, 5]"),
        &["a number, or two", "fibres = [20, 10]"],
    );
    says(
        &of_fibres(", column = { yield = 1 }"),
        &["cannot be combined with rule = \"fibre\""],
    );
    says(
        &model(
            &format!("{BARS}, hinge = {{ yield = 1 }}"),
            &format!("gravity = true\n{keys}"),
        ),
        &["cannot be combined with rule = \"fibre\""],
    );
    says(
        &model(", bars = \"12 d20\"", &format!("gravity = true\n{keys}")),
        &["steel"],
    );
    let other = "hinges = { rule = \"bilinear\", fibres = 12, column = { yield = 1e5, post_yield = 0.01 } }";
    says(&model("", other), &["has no meaning without fibres"]);
    says(
        &of_fibres("").replace("gravity = true", "gravity = true\nfloor_load = \"-2 MN\""),
        &["takes away more than the weight of the floor"],
    );
}
