//! Steel profiles, and beams whose slab takes part.

use jostle::{Frame, Section, Structure};
use jostle_testkit::files::{refusal, sound};

fn text(more: &str) -> String {
    format!(
        r#"
motion = {{ record = "el-centro-1940-ns" }}
[[building]]
name = "A"
storeys = 2
storey_height = 3
spans = [6, 5, 6]
beam_mass = 3000
{more}
"#
    )
}

fn frame(more: &str) -> Frame {
    match sound(&text(more)).model.buildings.remove(0).structure {
        Structure::Frame(frame) => frame,
        other => panic!("{other:?}"),
    }
}

fn close(found: f64, due: f64) {
    assert!((found / due - 1.0).abs() < 1e-3, "{found} instead of {due}");
}

/// E of steel, second moment, area and mass of the catalogue; cracking and the concrete of the building do not act on steel.
#[test]
fn a_profile_is_steel() {
    for building in ["", "concrete = \"C30\"\nstiffness_factor = 0.5\n"] {
        let frame = frame(&format!(
            "{building}column = {{ profile = \"HEB 300\" }}\nbeam = {{ profile = \"IPE400\" }}\nshear = \"flexible\"\n"
        ));
        let column = frame.column(0, 0).expect("it stands");
        close(column.flexural_rigidity, 210e9 * 25_170e-8);
        close(column.axial_rigidity.expect("known"), 210e9 * 149.1e-4);
        close(column.line_mass, 117.0);
        // G of steel on the web between the middles of the flanges.
        close(
            column.shear_rigidity.expect("known"),
            210e9 / 2.6 * 0.281 * 0.011,
        );
        close(
            frame.beam(0, 0).expect("it stands").flexural_rigidity,
            210e9 * 23_130e-8,
        );
    }
    let weak = frame(
        "elastic_modulus = \"200 GPa\"\ncolumn = { profile = \"HEB200\", axis = \"weak\" }\nbeam = { profile = { depth = \"400 mm\", width = \"180 mm\", web = \"8.6 mm\", flange = \"13.5 mm\", radius = \"21 mm\" } }\n",
    );
    close(
        weak.column(0, 0).expect("it stands").flexural_rigidity,
        200e9 * 2003e-8,
    );
    close(
        weak.beam(0, 0).expect("it stands").flexural_rigidity,
        200e9 * 23_130e-8,
    );
}

/// End spans and inner spans have their effective widths; cracking acts on bending alone.
#[test]
fn a_slab_acts_by_its_span() {
    let beams = |slab: &str| {
        let frame = frame(&format!(
            "elastic_modulus = 30e9\nstiffness_factor = 0.5\ncolumn = {{ width = 0.4, depth = 0.4 }}\nbeam = {{ width = 0.3, depth = 0.6, slab = {{ depth = 0.15, {slab} }} }}\n"
        ));
        [0, 1, 2].map(|bay| *frame.beam(1, bay).expect("it stands"))
    };
    // Steiner about the centroid, b wide above and 0.3 below.
    let due = |b: f64| {
        let (web, top) = (0.3 * 0.6, (b - 0.3) * 0.15);
        let centroid = (web * 0.3 + top * 0.075) / (web + top);
        let inertia = 0.3 * 0.6_f64.powi(3) / 12.0
            + web * (0.3 - centroid).powi(2)
            + (b - 0.3) * 0.15_f64.powi(3) / 12.0
            + top * (centroid - 0.075).powi(2);
        (inertia, web + top)
    };
    let check = |section: Section, width: f64| {
        let (inertia, area) = due(width);
        assert!((section.flexural_rigidity / (0.5 * 30e9 * inertia) - 1.0).abs() < 1e-12);
        assert!((section.axial_rigidity.expect("known") / (30e9 * area) - 1.0).abs() < 1e-12);
    };
    // 0.2 · 2 + 0.1 · 0.85 · 6 on each side of an end span, 0.2 · 2 + 0.1 · 0.7 · 5 and at most 0.2 · 3.5 of the inner one.
    let by_rule = beams("width = \"en1992\", spacing = 4");
    check(by_rule[0], 0.3 + 2.0 * 0.91);
    check(by_rule[1], 0.3 + 2.0 * 0.7);
    check(by_rule[2], 0.3 + 2.0 * 0.91);
    let of_aci = beams("width = \"aci318\", spacing = 4, sides = 1");
    check(of_aci[0], 0.3 + 0.5);
    check(of_aci[1], 0.3 + 5.0 / 12.0);
    check(beams("width = \"1.1 m\"")[0], 1.1);
}

#[test]
fn mistakes_are_explained() {
    let column =
        |profile: &str| format!("column = {{ {profile} }}\nbeam = {{ profile = \"IPE300\" }}\n");
    let slab = |slab: &str| {
        format!(
            "concrete = \"C30\"\ncolumn = {{ width = 0.4, depth = 0.4 }}\nbeam = {{ width = 0.3, depth = 0.6, slab = {{ {slab} }} }}\n"
        )
    };
    for (more, expected) in [
        (column("profile = \"HEB310\""), "did you mean \"HEB300\"?"),
        (
            column("profile = \"UB305x165x40\""),
            "available: IPE80 to IPE600, HEA100 to HEA1000, HEB100 to HEB1000",
        ),
        (
            column("profile = \"HEB300\", width = 0.3"),
            "is given together with a size or rigidities",
        ),
        (
            column("profile = { depth = 0.3, width = 0.3, web = 0.01 }"),
            "add flange = \"16.3 mm\"",
        ),
        (
            column("profile = { depth = 0.3, width = 0.3, web = 0.01, flange = 0.16 }"),
            "leave no web",
        ),
        (
            column("EI = 1e8, EA = 1e9, mass = 100, axis = \"weak\""),
            "axis: is for a profile",
        ),
        (
            slab("depth = 0.7, width = 1"),
            "must be less than the depth of the beam",
        ),
        (
            slab("depth = 0.15, width = \"en1992\""),
            "add spacing = \"4.7 m\"",
        ),
        (slab("depth = 0.15, width = 0.2"), "must not be less than the width of the beam"),
        (slab("depth = 0.15, width = 1, sides = 3"), "must be 1 or 2"),
        (
            slab("depth = 0.15, width = \"ec2\", spacing = 4"),
            "available: en1992, aci318",
        ),
        (
            "column = { profile = \"HEB300\" }\nbeam = { EI = 1e8, slab = { depth = 0.1, width = 1 } }\n".into(),
            "needs a beam with width and depth",
        ),
    ] {
        let shown = refusal(&text(&more));
        assert!(shown.contains(expected), "{more}\n{shown}");
    }
}

/// W14X90: A = 26.5 in², Ix = 999 in⁴, of 29 000 ksi; a tube of a name has 0.93 of its wall.
#[test]
fn american_names_have_american_steel() {
    let frame = frame("column = { profile = \"W14X90\" }\nbeam = { profile = \"HSS8X6X3/8\" }\n");
    let (inch, ksi) = (0.0254_f64, 6.894_757e6);
    let column = frame.column(0, 0).expect("it stands");
    let near = |found: f64, due: f64| assert!((found / due - 1.0).abs() < 5e-3, "{found} {due}");
    near(column.flexural_rigidity, 29e3 * ksi * 999.0 * inch.powi(4));
    near(
        column.axial_rigidity.expect("known"),
        29e3 * ksi * 26.5 * inch * inch,
    );
    // 90 lb/ft.
    near(column.line_mass, 90.0 * 0.453_592_37 / 0.3048);
    let beam = frame.beam(0, 0).expect("it stands");
    near(
        beam.axial_rigidity.expect("known"),
        29e3 * ksi * 8.97 * inch * inch,
    );
    assert!(
        refusal(&text(
            "column = { profile = \"W14X91\" }\nbeam = { profile = \"IPE400\" }\n"
        ))
        .contains("W14X9")
    );
}
