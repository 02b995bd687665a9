//! The page of a run.

use std::time::Duration;

use headless_chrome::protocol::cdp::Input;
use jostle_report::render;

use crate::fixture::{Run, alone, row_of_three, two_frames, walled, yielding};
use crate::opened::{Opened, open_page};

fn open(run: &Run, width: u32, height: u32) -> Option<Opened> {
    open_page(&render(&run.page()), width, height)
}

impl Opened {
    fn clock(&self) -> f64 {
        self.number("parseFloat(document.getElementById('clock').textContent)")
    }
}

const FIRST_CHART: &str = "document.querySelector('.chart svg').getBoundingClientRect()";
const TIME_LABELS: &str =
    "[...document.querySelectorAll('.chart svg')][0].querySelector('.grid').textContent";

#[test]
fn playing_moves_time_and_buildings() {
    let Some(page) = open(&two_frames(0.1), 1280, 900) else {
        return;
    };
    let shape = "document.querySelector('.building .columns').getAttribute('d')";
    let (clock, before) = (page.clock(), page.text(shape));
    page.value("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: ' ', bubbles: true, cancelable: true}))");
    std::thread::sleep(Duration::from_millis(700));
    page.value("document.getElementById('play').click()");
    let (later, after) = (page.clock(), page.text(shape));
    assert!(
        later > clock + 0.1,
        "played from {clock} s to {later} s only"
    );
    assert_ne!(before, after, "the building stood still");
    std::thread::sleep(Duration::from_millis(150));
    assert_eq!(page.clock(), later, "paused, but time went on");
    page.assert_content();
}

#[test]
fn scrubbing_and_jumping_find_their_instants() {
    let Some(page) = open(&two_frames(0.1), 1280, 900) else {
        return;
    };
    page.value("{ const s = document.getElementById('scrub'); s.value = 3; s.dispatchEvent(new Event('input')); }");
    assert!(
        (page.clock() - 3.0).abs() < 0.01,
        "scrubbed to {}",
        page.clock()
    );
    page.value("document.getElementById('next').click()");
    let first = page.clock();
    assert!(
        first > 6.0 && first < 6.4,
        "the first impact is near 6.2 s, not at {first} s"
    );
    let force = page.text("document.getElementById('force-now').textContent");
    assert!(force.ends_with("kN"), "no force at the impact: {force:?}");
    page.value("document.getElementById('next').click()");
    assert!(page.clock() > first, "the second impact comes later");
    page.picture("jumped");
    page.assert_content();
}

#[test]
fn charts_zoom_together_and_come_back() {
    let Some(page) = open(&two_frames(0.1), 1280, 900) else {
        return;
    };
    page.value("document.querySelector('.chart').scrollIntoView({block: 'start'})");
    std::thread::sleep(Duration::from_millis(200));
    let whole = page.text(TIME_LABELS);
    let [left, top] = ["left", "top"].map(|side| page.number(&format!("{FIRST_CHART}.{side}")));
    let y = top + 60.0;
    use Input::DispatchMouseEventTypeOption::{MouseMoved, MousePressed, MouseReleased};
    page.mouse(MousePressed, left + 300.0, y);
    page.mouse(MouseMoved, left + 350.0, y);
    page.mouse(MouseMoved, left + 400.0, y);
    page.mouse(MouseReleased, left + 400.0, y);
    std::thread::sleep(Duration::from_millis(200));
    let zoomed = page.text(TIME_LABELS);
    assert_ne!(whole, zoomed, "dragging did not zoom");
    page.value("document.getElementById('zoom-impact').click()");
    std::thread::sleep(Duration::from_millis(200));
    page.picture("impact");
    let bends = page
        .text("document.querySelectorAll('.chart')[1].querySelector('.line').getAttribute('d')");
    assert!(
        bends.matches('L').count() > 40,
        "an impact should show its shape: {bends}"
    );
    page.value("document.querySelector('.chart svg').dispatchEvent(new MouseEvent('dblclick'))");
    std::thread::sleep(Duration::from_millis(200));
    assert_eq!(page.text(TIME_LABELS), whole, "double-click did not reset");
    page.value("document.querySelector('.chart svg').dispatchEvent(new WheelEvent('wheel', {deltaY: -300, shiftKey: true, clientX: 500, cancelable: true}))");
    std::thread::sleep(Duration::from_millis(200));
    assert_ne!(page.text(TIME_LABELS), whole, "the wheel did not zoom");
    page.assert_content();
}

#[test]
fn every_place_has_its_charts() {
    for run in [two_frames(0.1), alone(), row_of_three(), yielding()] {
        let Some(page) = open(&run, 1280, 900) else {
            return;
        };
        let places = page.number("document.getElementById('place').options.length");
        assert!(places >= 3.0, "only {places} places");
        let empty = "(() => { const s = document.getElementById('place'); const empty = []; for (const o of s.options) { s.value = o.value; s.dispatchEvent(new Event('change')); if (!document.querySelectorAll('#time-charts > div .chart').length) empty.push(o.value); } return empty.join(); })()";
        assert_eq!(page.text(empty), "", "places without a chart");
        page.assert_content();
    }
}

#[test]
fn dark_is_dark_and_light_is_light() {
    let Some(page) = open(&two_frames(0.1), 1280, 900) else {
        return;
    };
    let paper = "getComputedStyle(document.body).backgroundColor";
    assert_eq!(page.text(paper), "rgb(255, 255, 255)");
    page.value("document.getElementById('theme').click()");
    assert_eq!(page.text(paper), "rgb(21, 24, 28)");
    page.picture("dark");
    page.assert_content();
}

#[test]
fn impacts_sort_and_unfold() {
    let Some(page) = open(&row_of_three(), 1280, 900) else {
        return;
    };
    let shown = "[...document.querySelectorAll('#impact-table tbody tr')].filter(r => r.offsetParent).length";
    assert_eq!(page.number(shown), 30.0);
    page.value("document.querySelectorAll('#impact-table th button')[3].click()");
    let forces = "[...document.querySelectorAll('#impact-table tbody tr')].map(r => parseFloat(r.cells[3].textContent)).every((f, i, all) => i === 0 || f <= all[i - 1])";
    assert_eq!(
        page.value(forces),
        true,
        "not sorted by force, greatest first"
    );
    page.value("document.getElementById('all-impacts').click()");
    assert!(page.number(shown) > 30.0, "the rest stayed folded");
    page.picture("row-of-three");
    page.assert_content();
}

#[test]
fn a_row_of_the_impact_table_shows_its_impact() {
    for run in [two_frames(0.1), row_of_three()] {
        let Some(page) = open(&run, 1280, 900) else {
            return;
        };
        // The greatest forces first: rows have to keep their impact when they are sorted.
        page.value("document.querySelectorAll('#impact-table th button')[3].click()");
        let contacts = run.summary.gaps.iter().flat_map(|gap| &gap.contacts);
        let mut impacts: Vec<_> = contacts.flat_map(|contact| &contact.impacts).collect();
        impacts.sort_by(|a, b| b.peak_force_n.total_cmp(&a.peak_force_n));
        // The instants of the player have three decimals.
        let rounding = 5.1e-4;
        page.value("document.getElementById('play').click()");
        for (row, impact) in impacts.iter().enumerate().take(30) {
            page.value(&format!(
                "document.querySelectorAll('#impact-table tbody tr')[{row}].cells[2].click()"
            ));
            let clock = page.clock();
            assert!(
                (clock - impact.peak_force_at_s).abs() <= rounding,
                "row {row} jumps to {clock} s; its peak force is at {} s",
                impact.peak_force_at_s
            );
            assert!(
                impact.start_s <= clock + rounding && clock - rounding <= impact.end_s,
                "row {row} at {clock} s"
            );
            let flashes = "[...document.querySelectorAll('#scene .flash')].filter(c => c.style.display !== 'none' && Number(c.style.opacity) > 0.85).length";
            assert!(page.number(flashes) >= 1.0, "row {row} shows no contact");
            let force = page.text("document.getElementById('force-now').textContent");
            assert!(force.ends_with("kN"), "row {row}: {force:?}");
        }
        page.picture("row-clicked");
        page.assert_content();
    }
}

#[test]
fn marks_and_loops_follow_the_clock() {
    let Some(page) = open(&yielding(), 1180, 900) else {
        return;
    };
    let at = |t: f64| {
        page.value(&format!("{{ const s = document.getElementById('scrub'); s.value = {t}; s.dispatchEvent(new Event('input')); }}"));
    };
    let count = |stage: usize| {
        page.number(&format!("[...document.querySelectorAll('#hinge-legend .key')[{stage}].querySelectorAll('output')].reduce((sum, o) => sum + Number(o.textContent), 0)"))
    };
    let marks = |stage: usize| {
        page.number(&format!("[...document.querySelectorAll('#scene .hinge-{stage}')].reduce((sum, p) => sum + (p.getAttribute('d').match(/M/g) ?? []).length, 0)"))
    };
    let dot = "document.querySelector('#loops .now').getAttribute('cx')";
    at(0.0);
    let all = count(0);
    // Every storey of the second building has a mark at either side.
    assert_eq!((all, count(1), count(2)), (34.0, 0.0, 0.0));
    assert_eq!((marks(0), marks(1), marks(2)), (38.0, 0.0, 0.0));
    let start = page.text(dot);
    at(12.0);
    assert_eq!(count(0) + count(1) + count(2), all, "places are lost");
    assert!(count(2) > 0.0 && marks(2) >= count(2), "nothing yielded");
    assert_ne!(page.text(dot), start, "the loop stood still");
    assert_eq!(
        page.number("document.querySelectorAll('#loops svg').length"),
        6.0
    );
    let drawn = page.text("document.querySelector('#loops .line:not(.whole)').getAttribute('d')");
    assert!(
        drawn.matches('L').count() > 50 && !drawn.contains("NaN"),
        "{drawn}"
    );
    page.value("document.getElementById('show-hinges').click()");
    assert_eq!(marks(0) + marks(1) + marks(2), 0.0, "marks can be hidden");
    page.value("document.getElementById('show-hinges').click()");
    let shown = "[...document.querySelectorAll('#hinge-table tbody tr')].filter(r => r.offsetParent).length";
    assert_eq!(page.number(shown), 20.0);
    page.value("document.querySelector('.unfold').click()");
    assert!(page.number(shown) > 20.0, "the rest stayed folded");
    page.picture("yielding");
    page.value("document.getElementById('theme').click()");
    page.picture("yielding-dark");
    page.assert_content();
}

#[test]
fn nothing_overflows_a_phone() {
    let runs = [
        ("two-frames", two_frames(0.1)),
        ("alone", alone()),
        ("row-of-three", row_of_three()),
        ("yielding", yielding()),
    ];
    for (name, run) in runs {
        let Some(page) = open(&run, 375, 740) else {
            return;
        };
        page.assert_fits(375.0);
        page.picture(&format!("phone-{name}"));
        page.assert_content();
    }
}

#[test]
fn walls_and_links_are_drawn_where_they_are() {
    let Some(page) = open(&walled(), 1280, 900) else {
        return;
    };
    assert_eq!(
        page.number("document.querySelectorAll('.wall').length"),
        2.0
    );
    assert_eq!(
        page.number("document.querySelectorAll('path.link').length"),
        4.0
    );
    let right = |what: &str| {
        page.number(&format!(
            "Math.max(...[...document.querySelectorAll('{what}')].map((e) => e.getBoundingClientRect().right))"
        ))
    };
    // At rest the last link ends at the face of the wall on the right.
    page.value("{ const s = document.getElementById('scrub'); s.value = 0; s.dispatchEvent(new Event('input')); }");
    std::thread::sleep(Duration::from_millis(200));
    let face =
        page.number("[...document.querySelectorAll('.wall')].at(-1).getBoundingClientRect().left");
    assert!((right("path.link") - face).abs() < 2.0);
    let shapes =
        "[...document.querySelectorAll('path.link')].map((p) => p.getAttribute('d')).join(' ')";
    let before = page.text(shapes);
    assert!(
        !before.contains("NaN") && before.matches('M').count() > 8,
        "{before}"
    );
    page.value("{ const s = document.getElementById('scrub'); s.value = 5; s.dispatchEvent(new Event('input')); }");
    std::thread::sleep(Duration::from_millis(200));
    assert_ne!(page.text(shapes), before, "links move with their floors");
    page.picture("walled");
    page.assert_fits(1280.0);
    page.assert_content();
}
