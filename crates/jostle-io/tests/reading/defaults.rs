//! What a file leaves open.

use jostle::Structure;
use jostle_testkit::files::{refusal, sound};

fn tower(more: &str) -> String {
    format!(
        "[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [\"40 t\", \"40 t\"]\nstiffness = \"60 MN/m\"\nstorey_height = \"3 m\"\n{more}\n"
    )
}

const HINGES: &str = "hinges = { rule = \"bilinear\", yield = \"20 mm\", post_yield = 0.05 }";

#[test]
fn what_yields_has_p_delta_unless_the_file_says_otherwise() {
    let p_delta = |more: &str| sound(&tower(more)).model.buildings[0].gravity.p_delta;
    assert!(!p_delta(""));
    assert!(p_delta("p_delta = true"));
    assert!(p_delta(HINGES));
    assert!(!p_delta(&format!("{HINGES}\np_delta = false")));
    let in_plan = "plan = [\"20 m\", \"10 m\"]";
    assert!(!p_delta(in_plan));
    assert!(p_delta(&format!("{in_plan}\n{HINGES}")));
    // A sliding base does not lean.
    let base = "base = { horizontal_stiffness = \"500 MN/m\", horizontal_hinge = { rule = \"bilinear\", yield = \"800 kN\", post_yield = 0.02 } }";
    assert!(!p_delta(base));
}

#[test]
fn axial_in_a_word_is_that_of_columns() {
    let flexible = |axial: &str| {
        let text = format!(
            "[[building]]\nname = \"A\"\nconcrete = \"C30\"\nstoreys = 2\nstorey_height = \"3 m\"\nspans = [\"6 m\"]\nbeam_mass = \"3 t/m\"\ncolumn = {{ width = \"400 mm\", depth = \"400 mm\" }}\nbeam = {{ width = \"300 mm\", depth = \"600 mm\" }}\n{axial}\n"
        );
        match &sound(&text).model.buildings[0].structure {
            Structure::Frame(frame) => [frame.axial.columns_flexible, frame.axial.beams_flexible],
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(flexible(""), [false, false]);
    assert_eq!(flexible("axial = \"rigid\""), [false, false]);
    assert_eq!(flexible("axial = \"flexible\""), [true, false]);
    assert_eq!(
        flexible("axial = { columns = \"flexible\" }"),
        [true, false]
    );
    assert_eq!(flexible("axial = { beams = \"flexible\" }"), [false, true]);
}

#[test]
fn the_drift_of_collapse_is_a_key() {
    let of = |more: &str| sound(&tower(more)).model.analysis.collapse_drift;
    assert_eq!(of(""), 0.1);
    assert_eq!(of("[analysis]\ncollapse_drift = 0.06"), 0.06);
    for wrong in ["0", "-0.1", "1.5"] {
        let told = refusal(&tower(&format!("[analysis]\ncollapse_drift = {wrong}")));
        assert!(
            told.contains("collapse_drift") && told.contains("at most 1"),
            "{told}"
        );
    }
}
