//! The page of a run.

use jostle_testkit::browser::Mouse;

use super::{ALONE, ROW_OF_THREE, Shown, TWO_FRAMES, YIELDING};
use crate::fixture::walled;

const CLOCK: &str = "parseFloat(document.getElementById('clock').textContent)";

const FIRST_CHART: &str = "document.querySelector('.chart svg').getBoundingClientRect()";
const TIME_LABELS: &str =
    "[...document.querySelectorAll('.chart svg')][0].querySelector('.grid').textContent";

#[test]
fn playing_moves_time_and_buildings() {
    let Some(page) = TWO_FRAMES.open(1280, 900) else {
        return;
    };
    let shape = "document.querySelector('.building .columns').getAttribute('d')";
    let (clock, before) = (page.number(CLOCK), page.text(shape));
    page.value("document.body.dispatchEvent(new KeyboardEvent('keydown', {key: ' ', bubbles: true, cancelable: true}))");
    page.wait(&format!("{CLOCK} > {}", clock + 0.1));
    page.value("document.getElementById('play').click()");
    let (later, after) = (page.number(CLOCK), page.text(shape));
    assert!(
        later > clock + 0.1,
        "played from {clock} s to {later} s only"
    );
    assert_ne!(before, after, "the building stood still");
    page.frames_pass(10);
    assert_eq!(page.number(CLOCK), later, "paused, but time went on");
    page.assert_content();
}

#[test]
fn scrubbing_and_jumping_find_their_instants() {
    let Some(page) = TWO_FRAMES.open(1280, 900) else {
        return;
    };
    page.value("{ const s = document.getElementById('scrub'); s.value = 3; s.dispatchEvent(new Event('input')); }");
    assert!(
        (page.number(CLOCK) - 3.0).abs() < 0.01,
        "scrubbed to {}",
        page.number(CLOCK)
    );
    page.value("document.getElementById('next').click()");
    let first = page.number(CLOCK);
    assert!(
        first > 6.0 && first < 6.4,
        "the first impact is near 6.2 s, not at {first} s"
    );
    let force = page.text("document.getElementById('force-now').textContent");
    assert!(force.ends_with("kN"), "no force at the impact: {force:?}");
    page.value("document.getElementById('next').click()");
    assert!(page.number(CLOCK) > first, "the second impact comes later");
    page.picture("jumped");
    page.assert_content();
}

#[test]
fn charts_zoom_together_and_come_back() {
    let Some(page) = TWO_FRAMES.open(1280, 900) else {
        return;
    };
    page.value("document.querySelector('.chart').scrollIntoView({block: 'start'})");
    page.drawn();
    let whole = page.text(TIME_LABELS);
    let [left, top] = ["left", "top"].map(|side| page.number(&format!("{FIRST_CHART}.{side}")));
    let y = top + 60.0;
    page.mouse(Mouse::Press, left + 300.0, y);
    page.mouse(Mouse::Move, left + 350.0, y);
    page.mouse(Mouse::Move, left + 400.0, y);
    page.mouse(Mouse::Release, left + 400.0, y);
    // Dragging zooms, and so does the wheel.
    let zoomed = format!("{TIME_LABELS} !== {whole:?}");
    page.wait(&zoomed);
    page.value("document.getElementById('zoom-impact').click()");
    page.drawn();
    page.picture("impact");
    let bends = page
        .text("document.querySelectorAll('.chart')[1].querySelector('.line').getAttribute('d')");
    assert!(
        bends.matches('L').count() > 40,
        "an impact should show its shape: {bends}"
    );
    page.value("document.querySelector('.chart svg').dispatchEvent(new MouseEvent('dblclick'))");
    page.drawn();
    assert_eq!(page.text(TIME_LABELS), whole, "double-click did not reset");
    page.value("document.querySelector('.chart svg').dispatchEvent(new WheelEvent('wheel', {deltaY: -300, shiftKey: true, clientX: 500, cancelable: true}))");
    page.wait(&zoomed);
    page.assert_content();
}

#[test]
fn every_place_has_its_charts() {
    for shown in [&TWO_FRAMES, &ALONE, &ROW_OF_THREE, &YIELDING] {
        let Some(page) = shown.open(1280, 900) else {
            return;
        };
        let places = page.number("document.getElementById('place').options.length");
        assert!(places >= 3.0, "only {places} places");
        let empty = "(() => { const s = document.getElementById('place'); const empty = []; for (const o of s.options) { s.value = o.value; s.dispatchEvent(new Event('change')); if (!document.querySelectorAll('#time-charts > div .chart').length) empty.push(o.value); } return empty.join(); })()";
        assert_eq!(page.text(empty), "", "places without a chart");
        // Hidden where there are no impacts, and harmless.
        page.value("document.getElementById('zoom-impact').click()");
        page.drawn();
        page.assert_content();
    }
}

#[test]
fn dark_is_dark_and_light_is_light() {
    let Some(page) = TWO_FRAMES.open(1280, 900) else {
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
    let Some(page) = ROW_OF_THREE.open(1280, 900) else {
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
    for shown in [&TWO_FRAMES, &ROW_OF_THREE] {
        let Some(page) = shown.open(1280, 900) else {
            return;
        };
        let run = &shown.run;
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
            let clock = page.number(CLOCK);
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
fn every_impact_has_a_panel_and_the_hardest_opens() {
    let run = &ROW_OF_THREE.run;
    let Some(page) = ROW_OF_THREE.open(1280, 900) else {
        return;
    };
    let contacts = run.summary.gaps.iter().flat_map(|gap| &gap.contacts);
    let mut impacts: Vec<_> = contacts.flat_map(|contact| &contact.impacts).collect();
    impacts.sort_by(|a, b| b.peak_force_n.total_cmp(&a.peak_force_n));
    let name = "document.querySelector('.impact-name').textContent";
    let said = page.text(name);
    assert!(
        said.contains("the largest of") && said.contains(&format!("{:.3} s", impacts[0].start_s)),
        "{said}"
    );
    let panels = "document.querySelectorAll('.impact-panel').length";
    assert_eq!(page.number(panels), 24.0);
    page.value("document.querySelector('.impact-strip > button:last-child').click()");
    // One of a single recorded instant has no shape.
    let all = page.number(panels);
    assert!(
        all >= impacts.len() as f64 - 1.0,
        "{all} of {}",
        impacts.len()
    );
    let bad = "[...document.querySelectorAll('#impact-panels path.line')].filter((l) => /NaN|Infinity|undefined/.test(l.getAttribute('d')) || l.getAttribute('d').split('L').length < 3).length";
    assert_eq!(page.number(bad), 0.0, "panels without a shape");
    // Force over time and over indentation.
    assert_eq!(
        page.number("document.querySelectorAll('.impact-pictures svg').length"),
        2.0
    );
    page.picture("impact-panels");
    // A panel goes to its impact in scene and charts; so does a row of the table, and the row says which one it is.
    page.value("document.querySelectorAll('.impact-panel')[3].click()");
    let clock = page.number(CLOCK);
    assert!(
        impacts
            .iter()
            .any(|impact| (impact.peak_force_at_s - clock).abs() < 6e-4),
        "no impact has its peak at {clock} s"
    );
    assert_ne!(page.text(name), said);
    for row in [0, 7, 11] {
        page.value(&format!(
            "document.querySelectorAll('#impact-table tbody tr')[{row}].cells[2].click()"
        ));
        let start = page.number(&format!(
            "Number(document.querySelectorAll('#impact-table tbody tr')[{row}].dataset.start)"
        ));
        let place = page.text(&format!(
            "document.querySelectorAll('#impact-table tbody tr')[{row}].cells[0].textContent"
        ));
        let said = page.text(name);
        assert!(
            said.contains(&format!("{start:.3} s")) && said.contains(&place),
            "row {row}, {place} at {start} s: {said}"
        );
    }
    page.value("[...document.querySelectorAll('#impact-panels button')].find((b) => b.textContent === 'Largest').click()");
    assert_eq!(page.text(name), said);
    page.assert_content();
}

#[test]
fn impacts_stand_at_their_instant_and_height() {
    let run = &ROW_OF_THREE.run;
    let Some(page) = ROW_OF_THREE.open(1280, 900) else {
        return;
    };
    let contacts = run.summary.gaps.iter().flat_map(|gap| &gap.contacts);
    let heights: Vec<(f64, f64)> = contacts
        .flat_map(|c| {
            c.impacts
                .iter()
                .map(move |i| (c.height_m, i.peak_force_at_s))
        })
        .collect();
    let discs = page.text("[...document.querySelectorAll('.disc')].map((d) => [d.getAttribute('cx'), d.getAttribute('cy')].join(' ')).join()");
    let discs: Vec<(f64, f64)> = discs
        .split(',')
        .map(|disc| {
            let (x, y) = disc.split_once(' ').unwrap();
            (x.parse().unwrap(), y.parse().unwrap())
        })
        .collect();
    assert_eq!(discs.len(), heights.len());
    // Straight axes: two discs give the scale of all.
    let ends = |values: &dyn Fn(usize) -> f64, count: usize| {
        let all = (0..count).map(values);
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        })
    };
    let count = discs.len();
    let (left, right) = ends(&|i| discs[i].0, count);
    let (top, bottom) = ends(&|i| discs[i].1, count);
    let (first, last) = ends(&|i| heights[i].1, count);
    let (low, high) = ends(&|i| heights[i].0, count);
    for (height, at) in &heights {
        let x = left + (at - first) / (last - first) * (right - left);
        let y = bottom - (height - low) / (high - low) * (bottom - top);
        assert!(
            discs
                .iter()
                .any(|d| (d.0 - x).abs() < 0.3 && (d.1 - y).abs() < 0.3),
            "no disc at {at} s, {height} m"
        );
    }
    // A click on one goes to its impact.
    page.value("document.querySelector('.disc').scrollIntoView({block: 'center'})");
    page.drawn();
    let [x, y] = ["left + r.width / 2", "top + r.height / 2"].map(|side| {
        page.number(&format!("(() => {{ const r = document.querySelector('.disc:last-child').getBoundingClientRect(); return r.{side}; }})()"))
    });
    page.mouse(Mouse::Press, x, y);
    page.mouse(Mouse::Release, x, y);
    let clock = page.number(CLOCK);
    assert!(
        heights.iter().any(|(_, at)| (at - clock).abs() < 6e-4),
        "the click led to {clock} s"
    );
    page.assert_content();
}

#[test]
fn drawings_have_their_dimensions() {
    let Some(page) = TWO_FRAMES.open(1280, 900) else {
        return;
    };
    let said = page.text(
        "[...document.querySelectorAll('.dimension-name')].map((t) => t.textContent).join('|')",
    );
    for text in ["2.4 m", "6 m", "5 × 3.2 m = 16 m", "10 × 3.2 m = 32 m"] {
        assert!(
            said.split('|').any(|one| one == text),
            "{text} is missing: {said}"
        );
    }
    // As long as they say: 16 m to 32 m.
    let lengths = page.text("[...document.querySelectorAll('.dimension')].map((p) => p.getAttribute('d')).filter((d) => d.includes('V')).map((d) => { const [, y0, y1] = /,([\\d.]+)V([\\d.]+)/.exec(d); return y0 - y1; }).join()");
    let lengths: Vec<f64> = lengths.split(',').map(|l| l.parse().unwrap()).collect();
    assert!((lengths[1] / lengths[0] - 2.0).abs() < 0.01, "{lengths:?}");
    page.assert_content();
}

#[test]
fn yielded_places_are_coloured_by_their_ductility() {
    let run = &YIELDING.run;
    let Some(page) = YIELDING.open(1280, 900) else {
        return;
    };
    page.value("{ const s = document.getElementById('scrub'); s.value = s.max; s.dispatchEvent(new Event('input')); }");
    let floors = [1.0, 2.0, 4.0, 6.0, 8.0, f64::INFINITY];
    let buildings = run.summary.buildings.iter().enumerate();
    let yielded: Vec<(usize, f64)> = buildings
        .flat_map(|(i, b)| b.hinges.list.iter().map(move |hinge| (i, hinge)))
        .filter(|(_, hinge)| hinge.yielded_s.is_some())
        .map(|(i, hinge)| (i, hinge.ductility))
        .collect();
    assert!(yielded.len() > 3);
    for grade in 0..5 {
        let within = |d: f64| floors[grade] <= d && d < floors[grade + 1];
        // A storey has a mark at either side.
        let expected: usize = yielded
            .iter()
            .filter(|(_, ductility)| within(*ductility))
            .map(|(building, _)| 1 + building)
            .sum();
        let marks = page.number(&format!("[...document.querySelectorAll('#scene .grade-{grade}')].reduce((sum, p) => sum + (p.getAttribute('d').match(/M/g) ?? []).length, 0)"));
        assert_eq!(marks, expected as f64, "ductility from {}", floors[grade]);
    }
    let colours = page.number("new Set([0, 1, 2, 3, 4].map((g) => getComputedStyle(document.querySelector(`#scene .grade-${g}`)).fill)).size");
    assert_eq!(colours, 5.0, "every grade has a colour of its own");
    page.picture("ductility");
    page.assert_content();
}

#[test]
fn marks_and_loops_follow_the_clock() {
    let Some(page) = YIELDING.open(1180, 900) else {
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
        ("two-frames", &TWO_FRAMES),
        ("alone", &ALONE),
        ("row-of-three", &ROW_OF_THREE),
        ("yielding", &YIELDING),
    ];
    for (name, shown) in runs {
        let Some(page) = shown.open(375, 740) else {
            return;
        };
        page.assert_fits(375.0);
        page.picture(&format!("phone-{name}"));
        page.assert_content();
    }
}

#[test]
fn walls_and_links_are_drawn_where_they_are() {
    let Some(page) = Shown::new(walled()).open(1280, 900) else {
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
    page.drawn();
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
    page.drawn();
    assert_ne!(page.text(shapes), before, "links move with their floors");
    page.picture("walled");
    page.assert_fits(1280.0);
    page.assert_content();
}
