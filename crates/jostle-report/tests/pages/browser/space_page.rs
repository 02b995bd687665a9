//! The scene in space and the paths of corners.

use std::path::Path;

use jostle_io::{Format, read_model_text};

use super::{IN_SPACE, Shown};
use crate::fixture::{computed, isolated_in_space};

/// The picture of the scene.
const PICTURE: &str = "document.querySelector('#space canvas').toDataURL()";
/// Number of pixels that are drawn on.
const DRAWN: &str = "(() => { const s = document.querySelector('#space canvas'); const c = document.createElement('canvas'); c.width = s.width; c.height = s.height; const g = c.getContext('2d', { willReadFrequently: true }); g.drawImage(s, 0, 0); const d = g.getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = 3; i < d.length; i += 4) if (d[i]) n++; return n; })()";

/// Number of pixels in the colour of contacts.
const MARKED: &str = "(() => { const s = document.querySelector('#space canvas'); const g = s.getContext('2d'); const d = g.getImageData(0, 0, s.width, s.height).data; let n = 0; for (let i = 0; i < d.length; i += 4) if (d[i + 3] > 200 && d[i] > 140 && d[i + 1] < 90 && d[i + 2] < 90) n++; return n; })()";

/// A space frame with braces between its last lines, three across the row.
const BRACED: &str = r#"
[motion]
record = "el-centro-1940-ns"

[[building]]
name = "Braced"
kind = "space-frame"
storeys = 2
storey_height = "3.4 m"
lines_x = ["0 m", "5 m", "10 m"]
lines_y = ["0 m", "4.5 m", "9 m"]
mass = "80 t"
concrete = "C30"
column = { size = ["500 mm", "500 mm"] }
beam_x = { width = "250 mm", depth = "550 mm" }
beam_y = { width = "250 mm", depth = "550 mm" }

[[building.brace]]
along = "x"
y = [1, 3]
x = 2
direction = "both"
EA = "600 MN"
"#;

#[test]
fn braces_of_a_space_frame_stand_between_its_columns() {
    let input = read_model_text("braced", BRACED, Format::Toml, Path::new("."));
    let input = input.unwrap_or_else(|problem| panic!("{problem}"));
    let Some(page) = Shown::new(computed(input.model.clone())).open(1280, 900) else {
        return;
    };
    // Three lines, two storeys, two directions.
    let path = page.text("document.querySelector('#scene .braces').getAttribute('d')");
    assert_eq!(path.matches('M').count(), 12, "{path}");
    // Between the second and the third column: in the right half of the building.
    let left = "(() => { const of = (name) => document.querySelector(`#scene .${name}`).getBBox(); \
        const [braces, all] = [of('braces'), of('columns')]; \
        return (braces.x - all.x) / all.width; })()";
    assert!(
        (page.number(left) - 0.5).abs() < 0.03,
        "{}",
        page.number(left)
    );
    page.assert_content();
}

#[test]
fn the_scene_turns_zooms_and_follows_the_time() {
    let Some(page) = IN_SPACE.open(1280, 900) else {
        return;
    };
    page.value("document.getElementById('space').scrollIntoView()");
    page.drawn();
    assert!(page.number(DRAWN) > 5000.0, "hardly anything is drawn");
    let first = page.text(PICTURE);
    page.value("{ const s = document.getElementById('scrub'); s.value = 3; s.dispatchEvent(new Event('input')); }");
    let later = page.text(PICTURE);
    assert_ne!(first, later, "the scene stands still");
    // A drag, as by mouse or touch.
    page.value("{ const c = document.querySelector('#space canvas'); const at = (type, x, y) => c.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: x, clientY: y, bubbles: true })); c.setPointerCapture = () => {}; at('pointerdown', 300, 300); at('pointermove', 380, 320); at('pointerup', 380, 320); }");
    let turned = page.text(PICTURE);
    assert_ne!(later, turned, "a drag does not turn the view");
    page.value("document.getElementById('space-above').click()");
    let above = page.text(PICTURE);
    assert_ne!(turned, above, "the view from above is no other");
    page.value("{ const s = document.getElementById('space-exaggeration'); s.value = 2.2; s.dispatchEvent(new Event('input')); }");
    assert_ne!(
        above,
        page.text(PICTURE),
        "the exaggeration changes nothing"
    );
    assert_eq!(
        page.text("document.getElementById('space-exaggeration-value').textContent"),
        "158×"
    );
    page.value("document.getElementById('space-play').click()");
    page.drawn();
    assert_eq!(
        page.text("document.getElementById('space-play').textContent"),
        "Pause"
    );
    page.value("document.getElementById('space-play').click()");
    page.assert_content();
}

/// The path of a corner is that of its floor: u = (u_x − θ r_y, u_y + θ r_x).
#[test]
fn paths_are_those_of_the_chosen_corners() {
    let Some(page) = IN_SPACE.open(1280, 900) else {
        return;
    };
    assert_eq!(
        page.number("document.querySelectorAll('.orbit').length"),
        2.0
    );
    let before = page.text("document.querySelector('.orbit .path-run').getAttribute('d')");
    page.value("{ const s = document.querySelector('.orbit select'); s.value = '1 1'; s.dispatchEvent(new Event('change')); }");
    let after = page.text("document.querySelector('.orbit .path-run').getAttribute('d')");
    assert_ne!(before, after);
    assert_eq!(
        page.number("document.querySelectorAll('.orbit .path-without').length"),
        2.0
    );
    // Floors have charts across and of rotation.
    page.value("{ const s = document.getElementById('place'); s.value = 'floor 0 4'; s.dispatchEvent(new Event('change')); }");
    let titles = page.text("[...document.querySelectorAll('#time-charts .chart-title')].map((t) => t.textContent).join('; ')");
    assert!(
        titles.contains("Rotation, West, floor 4") && titles.contains("Displacement across"),
        "{titles}"
    );
    page.assert_content();
}

/// The mat, and a wall below the ground before it: contacts are marked at both.
#[test]
fn the_scene_shows_a_moat_wall_before_a_mat() {
    let Some(page) = Shown::new(isolated_in_space()).open(1280, 900) else {
        return;
    };
    page.value("document.getElementById('space').scrollIntoView()");
    page.drawn();
    let marked = page.number(MARKED);
    assert!(marked > 100.0, "{marked} pixels of contacts");
}

#[test]
fn the_scene_fits_a_phone() {
    let Some(page) = IN_SPACE.open(390, 800) else {
        return;
    };
    assert!(page.number("document.documentElement.scrollWidth") <= 390.0);
    assert!(
        page.number("document.querySelector('#space canvas').getBoundingClientRect().width")
            <= 390.0
    );
    page.assert_content();
}
