//! Columns of tall frames shorten by default: against files that say so, and the cantilever that a tall frame bends like.

use jostle::model::Structure;
use jostle::{Axial, Frame};
use jostle_run::Opened;
use jostle_testkit::files::sound;

const SECTIONS: &str =
    "column = { width = 0.5, depth = 0.5 }\nbeam = { width = 0.3, depth = 0.6 }\n";

fn model(storeys: usize, width: f64, keys: &str) -> String {
    format!(
        "[[building]]\nname = \"A\"\nstoreys = {storeys}\nstorey_height = 3\nspans = [{width}]\nconcrete = \"C30\"\nbeam_mass = \"5 t/m\"\n{keys}"
    )
}

fn frame(text: &str) -> Frame {
    match sound(text).model.buildings.remove(0).structure {
        Structure::Frame(frame) => frame,
        other => panic!("{other:?}"),
    }
}

const COLUMNS: Axial = Axial {
    columns_flexible: true,
    beams_flexible: false,
};
const RIGID: Axial = Axial {
    columns_flexible: false,
    beams_flexible: false,
};

#[test]
fn columns_shorten_above_three_widths_or_ten_storeys_unless_the_file_says_otherwise() {
    let with_sections = |keys: &str| format!("{SECTIONS}{keys}");
    let by_rigidity =
        "column = { EI = \"150 MN.m2\", mass = 600 }\nbeam = { EI = \"160 MN.m2\" }\n";
    let with_area = "column = { EI = \"150 MN.m2\", EA = \"7 GN\", mass = 600 }\nbeam = { EI = \"160 MN.m2\" }\n";
    for (storeys, width, keys, due) in [
        (10, 11.0, with_sections(""), RIGID),
        (11, 12.0, with_sections(""), COLUMNS),
        (4, 4.0, with_sections(""), RIGID),
        (4, 3.9, with_sections(""), COLUMNS),
        (30, 12.0, with_sections("axial = \"rigid\"\n"), RIGID),
        (2, 6.0, with_sections("axial = \"flexible\"\n"), COLUMNS),
        (
            30,
            12.0,
            with_sections("axial = { columns = \"rigid\" }\n"),
            RIGID,
        ),
        // What a table does not say has its default.
        (
            30,
            12.0,
            with_sections("axial = { beams = \"rigid\" }\n"),
            COLUMNS,
        ),
        (30, 12.0, by_rigidity.to_owned(), RIGID),
        (30, 12.0, with_area.to_owned(), COLUMNS),
    ] {
        let found = frame(&model(storeys, width, &keys)).axial;
        assert_eq!(found, due, "{storeys} storeys, {width} m, {keys}");
    }
    // The same model as with the word written out.
    let tall = |axial: &str| sound(&model(30, 12.0, &with_sections(axial))).model;
    assert_eq!(tall(""), tall("axial = \"flexible\"\n"));
}

/// Foundations on soil need columns that keep their length: the default leaves them so.
#[test]
fn frames_on_foundations_keep_their_columns() {
    let text = format!(
        "{SECTIONS}foundation = {{ length = 12, width = 12, mass = \"120 t\" }}\n[soil]\nshear_wave_velocity = 200\ndensity = 1800\npoisson_ratio = 0.35\ndamping = 0.05\n"
    );
    assert_eq!(frame(&model(12, 12.0, &text)).axial, RIGID);
}

/// Joints between rigid beams neither turn nor bend: stories are clamped columns, and what columns stretch adds is the cantilever of
/// their areas. Deflections of both add, so that 1/ω² of the frame is near the sum of both (Southwell and Dunkerley).
#[test]
fn the_period_with_columns_that_shorten_has_the_part_of_a_cantilever() {
    let (storeys, width, height) = (30_usize, 6.0, 3.0);
    let (mass, area, modulus) = (5e3 * width, 0.25, 30e9);
    let keys = |axial: &str| {
        format!(
            "column = {{ width = 0.5, depth = 0.5 }}\nbeam = {{ EI = 1e12 }}\ndensity = 0\ncolumn_segments = 1\nbeam_segments = 1\n{axial}"
        )
    };
    let period = |axial: &str| {
        let text = model(storeys, width, &keys(axial));
        let opened = Opened::new(sound(&text), "A").unwrap_or_else(|error| panic!("{error}"));
        let mode = opened.system.buildings[0].lateral_modes().next();
        mode.expect("a mode").period()
    };
    let (rigid, default) = (period("axial = \"rigid\"\n"), period(""));
    // A cantilever of EI = E A B²/2 with equal masses at equal heights: the discrete sum of Dunkerley's flexibilities is 3 % above the
    // first mode; the continuous one is ω = 3.516 √(EI/(m' H⁴)).
    let bending = modulus * area * width * width / 2.0;
    let (total, line) = (height * storeys as f64, mass / height);
    let omega = 3.516 * (bending / (line * total.powi(4))).sqrt();
    let cantilever = std::f64::consts::TAU / omega;
    let sum = rigid.hypot(cantilever);
    assert!(default > 1.1 * rigid, "{default} {rigid}");
    assert!(
        (default / sum - 1.0).abs() < 0.03,
        "{default} {sum} {rigid} {cantilever}"
    );
}
