//! Knobs: sliders, typed values, faults beside their fields.

use super::{open, serve, short};

#[test]
fn a_slider_changes_the_run_and_nothing_flashes() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    assert!(
        page.headline().contains("J1 and J2: "),
        "{}",
        page.headline()
    );
    page.wait("document.querySelectorAll('.curve-line').length === 1");
    page.glance("live");
    let before = page.text("document.querySelector('.tiles').textContent");
    // What is on the page stays on it: the same elements take the new run over.
    page.value("window.kept = [document.querySelector('#scene svg'), document.querySelector('#time-charts .chart svg'), document.querySelector('.knob-slider')]; window.empty = 0; new MutationObserver(() => { if (!document.querySelector('#scene .columns') || !document.querySelector('.tiles')) window.empty += 1; }).observe(document.body, { childList: true, subtree: true })");
    let frames = page.frames();
    page.value("{ const s = document.querySelector('.knob-slider'); s.focus(); s.value = 0.1; s.dispatchEvent(new Event('input')); }");
    page.settled();
    assert!(page.frames() > frames);
    assert_ne!(
        page.text("document.querySelector('.tiles').textContent"),
        before
    );
    assert!(
        page.model().contains("width = \"40 mm\""),
        "{}",
        page.model()
    );
    assert_eq!(
        page.value("window.kept.every((e) => e.isConnected) && window.empty === 0"),
        true
    );
    page.value("{ const s = document.querySelector('.knob-slider'); s.value = 1; s.dispatchEvent(new Event('input')); }");
    page.settled();
    assert!(
        page.headline().contains("No contact"),
        "{}",
        page.headline()
    );
    page.glance("live-apart");
    page.picture("live-whole");
    page.assert_content();
}

#[test]
fn every_kind_of_value_can_be_typed() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    let typed = [
        ("gap width", "gap[0].width", "35 mm", "width = \"35 mm\""),
        ("law", "gap[0].law", "hertz", "law = \"hertz\""),
        (
            "stiffness",
            "gap[0].stiffness",
            "1e9 N/m^1.5",
            "stiffness = \"1e9 N/m^1.5\"",
        ),
        ("reverse", "motion.reverse", "false", "reverse = false"),
        ("storeys", "building[0].storeys", "4", "storeys = 4"),
        (
            "spans",
            "building[0].spans",
            "[\"3 m\", \"5 m\"]",
            "spans = [\"3 m\", \"5 m\"]",
        ),
        ("ratio", "building[1].damping.ratio", "0.02", "ratio = 0.02"),
        (
            "column depth",
            "building[1].column.depth",
            "700 mm",
            "depth = \"700 mm\"",
        ),
        (
            "record",
            "motion.record",
            "nanjing-artificial",
            "record = \"nanjing-artificial\"",
        ),
    ];
    for (words, path, value, written) in typed {
        page.search(words);
        page.type_into(path, value);
        assert_eq!(page.fault_of(path), "", "{path}");
        assert!(page.model().contains(written), "{path}: {}", page.model());
        assert_eq!(
            page.value("document.body.classList.contains('faulty')"),
            false,
            "{path}: {}",
            page.text("document.getElementById('faults').textContent")
        );
    }
    // An empty field is the default.
    page.search("restitution");
    page.type_into("gap[0].restitution", "");
    assert!(
        !page.model().contains("\nrestitution ="),
        "{}",
        page.model()
    );
    page.search("no such key at all");
    assert!(
        page.text("document.getElementById('knob-list').textContent")
            .contains("No key")
    );
    page.assert_content();
}

#[test]
fn faults_stand_beside_their_field_in_the_words_of_the_reader() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    page.type_into("gap[0].width", "3 kg");
    let fault = page.fault_of("gap[0].width");
    assert!(
        fault.contains("expected a length") && fault.contains("3 kg"),
        "{fault}"
    );
    assert!(page.headline().contains("fault"), "{}", page.headline());
    page.glance("live-fault");
    page.type_into("gap[0].width", "30 mm");
    assert_eq!(page.fault_of("gap[0].width"), "");
    // A fault of the text as a whole stands above the knobs, with its line.
    page.value("document.getElementById('editor').open = true");
    page.value("{ const t = document.getElementById('text'); t.focus(); t.value = t.value.replace('storeys = 5', 'storys = 5'); t.dispatchEvent(new Event('input')); }");
    page.wait("!document.getElementById('faults').hidden");
    let faults = page.text("document.getElementById('faults').textContent");
    assert!(
        faults.contains("line") && faults.contains("storys"),
        "{faults}"
    );
    page.value("{ const t = document.getElementById('text'); t.value = t.value.replace('storys = 5', 'storeys = '); t.dispatchEvent(new Event('input')); }");
    page.wait("!document.getElementById('faults').textContent.includes('storys')");
    page.glance("live-syntax");
    page.click("undo");
    page.click("undo");
    assert_eq!(
        page.value("document.body.classList.contains('faulty')"),
        false
    );
    assert!(page.headline().contains("impact"));
    // A record outside the folder.
    page.type_into("motion.record", "/etc/passwd");
    let fault = page.fault_of("motion.record");
    assert!(fault.contains("outside the folder"), "{fault}");
    page.assert_content();
}

#[test]
fn a_long_run_shows_how_far_it_is_and_can_be_stopped() {
    let server = serve("paper-inelastic");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.stops_a_long_run();
    page.assert_content();
}
