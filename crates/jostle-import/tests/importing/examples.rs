//! The workbooks and the text model of `examples`, which the pages import: written by
//! `JOSTLE_WRITE_EXAMPLES=1 cargo test -p jostle-import`, and read again here.

use std::path::Path;

use jostle_import::{ImportOptions, Program};
use jostle_testkit::files::sound;

use crate::book::{Layout, book, difference, imported, model, periods};
use crate::frames::s2k;
use crate::tables::MOTION;
use crate::workbooks::tables_of;

/// A hotel of five storeys whose stiff corner makes it turn.
const HOTEL: &str = r#"
[[building]]
name = "hotel"
kind = "space-frame"
lines_x = ["0 m", "6 m", "12 m", "18 m"]
lines_y = ["0 m", "5 m", "11 m"]
storey_height = ["4.2 m", "3.4 m", "3.4 m", "3.4 m", "3.4 m"]
mass = ["205 t", "198 t", "198 t", "198 t", "170 t"]
concrete = "C30"
stiffness_factor = { column = 0.7, beam = 0.35 }
beam_x = { width = "300 mm", depth = "600 mm" }
beam_y = { width = "300 mm", depth = "550 mm" }
[[building.column]]
size = ["500 mm", "500 mm"]
[[building.column]]
x = 1
y = 1
size = ["900 mm", "900 mm"]
"#;

/// An annexe of three storeys at the same levels.
const ANNEXE: &str = r#"
[[building]]
name = "annexe"
kind = "space-frame"
lines_x = ["0 m", "5 m", "10 m"]
lines_y = ["0 m", "5 m", "11 m"]
storey_height = ["4.2 m", "3.4 m", "3.4 m"]
mass = ["115 t", "110 t", "90 t"]
concrete = "C30"
column = { size = ["450 mm", "450 mm"] }
beam_x = { width = "300 mm", depth = "500 mm" }
beam_y = { width = "300 mm", depth = "500 mm" }
"#;

fn example(name: &str, bytes: impl Fn() -> Vec<u8>) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(name);
    if std::env::var_os("JOSTLE_WRITE_EXAMPLES").is_some() {
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, bytes()).expect("an example");
    }
    std::fs::read(&path).expect("an example")
}

/// Six digits of displacements give the periods to 0.01 %.
#[test]
fn workbooks_of_the_pages_are_the_buildings_that_they_were_written_from() {
    for (name, text) in [("hotel", HOTEL), ("annexe", ANNEXE)] {
        let input = sound(&format!("{MOTION}{text}"));
        let file = format!("etabs/{name}.xlsx");
        let bytes = example(&file, || book(&tables_of(&input, 6), Layout::Titled, false));
        let found = imported(
            Program::Etabs,
            &[(&file, &bytes)],
            &ImportOptions {
                stem: "m".into(),
                ..ImportOptions::default()
            },
        );
        let off = difference(&periods(&model(&found), 6), &periods(&input, 6));
        assert!(off < 1e-4, "{name}: {off:.1e}");
    }
    let bytes = example("sap2000/frame.s2k", || s2k().into_bytes());
    assert_eq!(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"), s2k());
}
