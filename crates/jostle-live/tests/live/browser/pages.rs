//! Sizes, colours, the keyboard, models with faults.

use jostle_testkit::browser::open_address;

use super::{LivePage, open, serve, short};

#[test]
fn pages_fit_phones_and_dark_is_dark() {
    let Some(page) = open(short(), 375, 760) else {
        return;
    };
    page.wait("document.querySelectorAll('.curve-line').length === 1");
    page.assert_fits(375.0);
    // The bar below is fixed, so the width of the page does not show whether it fits.
    let cut = "[...document.querySelectorAll('.player *')].filter((e) => e.getBoundingClientRect().right > 375).map((e) => e.outerHTML.slice(0, 60)).join()";
    assert_eq!(page.text(cut), "", "cut off on a phone");
    page.glance("live-phone");
    page.picture("live-phone-whole");
    page.value("document.getElementById('theme').click()");
    assert_eq!(
        page.text("getComputedStyle(document.body).backgroundColor"),
        "rgb(21, 24, 28)"
    );
    page.glance("live-phone-dark");
    page.assert_content();
    let wide = open(short(), 1400, 1000).unwrap();
    wide.value("document.getElementById('theme').click()");
    wide.wait("document.querySelectorAll('.curve-line').length === 1");
    wide.glance("live-dark");
}

#[test]
fn the_keyboard_is_enough() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    page.value("document.getElementById('search').focus()");
    for key in ["Tab", "Tab"] {
        page.press(key);
    }
    // The first knob after the search is the width of the gap: its field, then its slider.
    assert_eq!(
        page.value("document.activeElement.classList.contains('knob-slider')"),
        true,
        "{}",
        page.text("document.activeElement.outerHTML")
    );
    let before = page.headline();
    for _ in 0..8 {
        page.press("ArrowLeft");
    }
    page.settled();
    assert_ne!(page.headline(), before);
    assert_eq!(
        page.value("document.activeElement.classList.contains('knob-slider')"),
        true,
        "the focus was lost"
    );
    // A field takes its value with Enter; buttons, the choice of records and the line of the curve are reached by Tab.
    page.value(
        "document.querySelector('.knob input[type=text]').focus(); document.activeElement.select()",
    );
    for key in ["5", "5", "m", "m", "Enter"] {
        page.press(key);
    }
    page.settled();
    assert!(
        page.model().contains("width = \"55mm\""),
        "{}",
        page.model()
    );
    // The curve of the new width, with its line, comes after the frame.
    page.wait("document.querySelector('.handle')?.style.display === ''");
    page.value("document.querySelector('.skip').focus()");
    let mut wanted = vec![
        "undo",
        "pin",
        "save-model",
        "save-report",
        "theme",
        "search",
        "measure",
        "over",
        "across",
        "from",
        "to",
        "save-study",
        "handle",
        "play",
        "scrub",
        "exaggeration",
        "place",
    ];
    // One question for every key: what has the focus, and whether it shows a ring.
    let focused = "(() => { const e = document.activeElement; const s = getComputedStyle(e); \
        const ring = e === document.body || s.outlineStyle !== 'none' || e.matches('.handle, #headline'); \
        return `${ring} ${e.id || e.className?.baseVal || e.className || e.tagName}`; })()";
    let mut reached = Vec::new();
    for _ in 0..120 {
        page.press("Tab");
        let answer = page.text(focused);
        let (ring, name) = answer.split_once(' ').unwrap_or_default();
        assert_eq!(ring, "true", "no focus ring: {name}");
        wanted.retain(|one| *one != name);
        reached.push(name.to_owned());
        if wanted.is_empty() {
            break;
        }
    }
    assert!(
        wanted.is_empty(),
        "{wanted:?} are not reached by Tab: {reached:?}"
    );
    page.value("document.getElementById('undo').focus()");
    page.press("Enter");
    page.settled();
    assert!(!page.model().contains("width = \"55mm\""));
    let names = "[...document.querySelectorAll('button, input, select, textarea, [role=slider]')].filter((e) => !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim() || e.title)).map((e) => e.outerHTML).join()";
    assert_eq!(page.text(names), "", "controls without a name");
    page.assert_content();
}

#[test]
fn a_model_with_a_fault_opens_and_can_be_mended() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("model.toml");
    let text = jostle_io::model_text("paper").unwrap();
    let broken = text.replacen("width = \"100 mm\"", "width = \"3 kg\"", 1);
    assert_ne!(broken, text);
    std::fs::write(&file, &broken).unwrap();
    let server = serve(file.to_str().unwrap());
    let Some(page) = open_address(&server.address(), 1400, 1000) else {
        return;
    };
    let page = LivePage(page);
    page.wait("document.body.classList.contains('faulty')");
    assert!(page.fault_of("gap[0].width").contains("expected a length"));
    page.glance("live-broken");
    page.type_into("gap[0].width", "90 mm");
    page.wait("Number(document.body.dataset.frames) === 1");
    assert!(page.headline().contains("impact"), "{}", page.headline());
    assert_eq!(
        std::fs::read_to_string(&file).unwrap(),
        broken,
        "the file was written"
    );
    page.assert_content();
}

#[test]
fn a_row_of_shear_buildings_and_a_list_of_records() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("row.toml");
    let building = |name: &str, mass: &str, stiffness: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"shear\"\nstoreys = 3\nmass = \"{mass}\"\nstiffness = \"{stiffness}\"\nstorey_height = \"3 m\"\n\n"
        )
    };
    let gap = |left: &str, right: &str| {
        format!("[[gap]]\nbetween = [\"{left}\", \"{right}\"]\nwidth = \"10 mm\"\n\n")
    };
    let text = format!(
        "title = \"Row\"\n\n[motion]\nrecord = [\"el-centro-1940-ns\", \"nanjing-artificial\"]\npga = \"2 m/s2\"\n\n{}{}{}{}{}",
        building("A", "40 t", "60 MN/m"),
        building("B", "60 t", "20 MN/m"),
        building("C", "40 t", "80 MN/m"),
        gap("A", "B"),
        gap("B", "C")
    );
    std::fs::write(&file, text).unwrap();
    let server = serve(file.to_str().unwrap());
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    assert_eq!(
        page.text("document.getElementById('over').value"),
        "gap[*].width"
    );
    page.wait("document.getElementById('curve-note').textContent.includes('Gap needed')");
    let first = page.headline();
    page.value("{ const s = document.getElementById('several'); s.value = '1'; s.dispatchEvent(new Event('change')); }");
    page.settled();
    assert_ne!(page.headline(), first, "the other record shakes otherwise");
    page.value("document.querySelector('.handle').focus()");
    page.press("ArrowRight");
    page.settled();
    let model = page.model();
    assert!(
        !model.contains("width = \"10 mm\"") && model.matches("width = ").count() == 2,
        "both gaps follow: {model}"
    );
    page.glance("live-row");
    page.assert_content();
}

#[test]
fn nothing_moves_by_itself() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    page.emulate("", &[("prefers-reduced-motion", "reduce")]);
    let shape = "document.querySelector('.building .columns').getAttribute('d')";
    let before = page.text(shape);
    page.frames_pass(25);
    assert_eq!(
        page.text(shape),
        before,
        "the animation plays before it is asked to"
    );
    assert_eq!(page.number("document.getAnimations().length"), 0.0);
}
