//! The curve of force over the gap, and estimates that come after the frame.

use std::ops::ControlFlow;

use jostle_testkit::browser::Mouse;

use super::{open, paper};

#[test]
fn the_curve_shows_the_smallest_gap_and_its_line_can_be_moved() {
    let Some(page) = open(paper(), 1400, 1000) else {
        return;
    };
    page.type_into("motion.pga", "70 cm/s2");
    page.wait("document.getElementById('curve-note').textContent.includes('Gap needed under this motion')");
    let note = page.text("document.getElementById('curve-note').textContent");
    let needed: f64 = note
        .split(": ")
        .nth(1)
        .unwrap()
        .split(" mm")
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(needed > 5.0 && needed < 200.0, "{note}");
    page.wait("document.querySelectorAll('.code-marks > g').length >= 2");
    let length = page
        .text("document.querySelector('.curve-line').getAttribute('d')")
        .matches('L')
        .count();
    assert!(length >= 100, "{length} points");
    page.glance("live-curve");
    page.type_into("gap[0].width", &format!("{} mm", needed + 0.2));
    assert!(
        page.headline().contains("No contact"),
        "{}",
        page.headline()
    );
    page.type_into("gap[0].width", &format!("{} mm", needed - 0.5));
    assert!(page.headline().contains("impact"), "{}", page.headline());
    // By keyboard, and by dragging.
    page.value("document.querySelector('.handle').focus()");
    page.press("ArrowRight");
    page.settled();
    let moved =
        page.number("Number(document.querySelector('.handle').getAttribute('aria-valuenow'))");
    assert!(moved > needed - 0.5, "{moved}");
    page.wait("document.querySelector('.handle') !== null");
    page.value("document.getElementById('curve-picture').scrollIntoView({ block: 'center' })");
    let [left, top, width] = ["left", "top", "width"].map(|side| {
        page.number(&format!(
            "document.getElementById('curve-picture').getBoundingClientRect().{side}"
        ))
    });
    page.mouse(Mouse::Press, left + 0.2 * width, top + 100.0);
    page.mouse(Mouse::Move, left + 0.25 * width, top + 100.0);
    page.mouse(Mouse::Move, left + 0.3 * width, top + 100.0);
    page.mouse(Mouse::Release, left + 0.3 * width, top + 100.0);
    page.settled();
    assert!(page.headline().contains("impact"), "{}", page.headline());
    let dragged =
        page.number("Number(document.querySelector('.handle').getAttribute('aria-valuenow'))");
    assert!(dragged < needed, "{dragged}");
    // Over another key, and for several records.
    page.value("{ const o = document.getElementById('over'); o.value = 'gap[0].restitution'; o.dispatchEvent(new Event('change')); }");
    page.wait("document.querySelector('.curve-line')?.getAttribute('d').split('L').length > 100");
    page.value("{ const o = document.getElementById('over'); o.value = 'gap[0].width'; o.dispatchEvent(new Event('change')); for (const b of [...document.querySelectorAll('#curve-records input')].slice(0, 2)) b.click(); }");
    page.wait("document.querySelectorAll('.line.thin').length === 2 && document.querySelector('.line.mean') !== null");
    page.glance("live-suite");
    page.assert_content();
}

/// What somebody does who has never seen the page: types the acceleration where the page says so, and reads the gap.
#[test]
fn the_gap_without_pounding_is_in_sight_after_one_change() {
    let Some(page) = open(paper(), 1280, 800) else {
        return;
    };
    page.value("{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.textContent.includes('acceleration')); const f = document.getElementById(l.htmlFor); f.scrollIntoView({ block: 'nearest' }); f.value = '70 cm/s2'; f.dispatchEvent(new Event('change')); }");
    page.settled();
    assert!(
        page.headline().contains("No contact"),
        "{}",
        page.headline()
    );
    page.wait("document.getElementById('curve-note').textContent.includes('Gap needed under this motion')");
    page.wait("document.querySelector('.code-marks .needed') !== null");
    let said = page
        .text("/motion: ([\\d.]+) mm/.exec(document.getElementById('curve-note').textContent)[1]");
    let tile = page.text("[...document.querySelectorAll('.tile')].find((t) => t.textContent.includes('Gap needed')).querySelector('.tile-value').textContent");
    assert_eq!(tile.replace('\u{a0}', " "), format!("{said} mm"));
    let seen = "['#curve-note', '.code-marks .needed', '#headline'].every((s) => { const r = document.querySelector(s).getBoundingClientRect(); return r.top >= 0 && r.bottom <= innerHeight; })";
    assert_eq!(page.value(seen), true, "the answer is out of sight");
    page.glance("live-first-minute");
    page.assert_content();
}

/// Accuracy of a run with one width, in the words of the command line.
pub(crate) fn accuracy_of(width: &str) -> [String; 2] {
    let mut tree = jostle_io::ModelTree::builtin("paper").unwrap();
    let typed = jostle_io::TreeValue::typed(width);
    tree.set("gap[0].width", &typed).unwrap();
    let prepared = jostle_run::CaseCache::default()
        .assemble(tree.input().unwrap())
        .unwrap_or_else(|error| panic!("{error}"));
    let mut outcome = prepared.step(jostle::Settings::default(), |_| ControlFlow::Continue(()));
    let words = |outcome: &jostle::Outcome| -> String {
        prepared.summary(outcome, None, 0.0).promise.in_words()
    };
    let before = words(&outcome);
    prepared.find_sensitivity(&mut outcome, |_| ControlFlow::Continue(()));
    [before, words(&outcome)].map(|words| words.replacen("accuracy: ", "Accuracy: ", 1) + ".")
}

#[test]
fn sensitive_results_are_found_after_the_frame() {
    let Some(page) = open(paper(), 1400, 1000) else {
        return;
    };
    let shown = "document.getElementById('accuracy').textContent";
    let [_, sound] = accuracy_of("100 mm");
    page.wait(&format!("{shown} === {sound:?}"));
    // A gap that the buildings just graze, as `jostle gap` finds it.
    let note = "document.getElementById('curve-note').textContent";
    page.wait(&format!("{note}.includes('Gap needed under this motion')"));
    let needed = page.text(&format!("/motion: ([\\d.]+) mm/.exec({note})[1]"));
    let width = format!("{needed} mm");
    let [before, found] = accuracy_of(&width);
    assert_ne!(before, found, "the graze makes no difference");
    page.type_into("gap[0].width", &width);
    page.wait(&format!("{shown} === {found:?}"));
    // A newer change stops the search of the older one.
    page.type_into("gap[0].width", "100 mm");
    page.wait(&format!("{shown} === {sound:?}"));
    page.assert_content();
}

/// Values take the unit of the page once, however often the curve is drawn.
#[test]
fn in_us_units_the_curve_stays_when_it_is_drawn_again() {
    let text = jostle_io::model_text("paper").unwrap();
    let text = text.replacen("[motion]\n", "[motion]\nduration = \"8 s\"\n", 1);
    let text = format!("{text}\n[output]\nunits = \"us\"\n");
    let engine = jostle_live::Engine::from_text("paper", &text, std::path::Path::new("")).unwrap();
    let server = jostle_live::Server::start(engine, 0).unwrap();
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    let whole = "(document.querySelector('.curve-line')?.getAttribute('d').match(/L/g) ?? []).length >= 119";
    page.wait(whole);
    // The line fills its picture with any factor: the numbers of the axis say which.
    let numbers = "[...document.querySelectorAll('#curve-picture .grid text')].map((one) => one.textContent).join()";
    let drawn = || page.text(numbers);
    let first = drawn();
    for measure in ["3", "0"] {
        page.value(&format!(
            "(() => {{ const list = document.getElementById('measure'); list.value = '{measure}'; list.dispatchEvent(new Event('change')); return 0; }})()"
        ));
        page.drawn();
    }
    assert_eq!(drawn(), first);
    assert!(
        page.text("document.getElementById('curve-caption').textContent")
            .contains("kip")
    );
}
