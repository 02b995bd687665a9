//! Memory and speed over many changes.

use std::time::Duration;

use jostle_live::Server;
use jostle_testkit::browser::{Browser, skipped};

use super::{LivePage, serve};

/// Opens the page in a browser of its own, which nothing else keeps busy.
fn open_alone(server: &Server) -> Option<(Browser, LivePage)> {
    if skipped() {
        return None;
    }
    let browser = Browser::start();
    let page = browser.open(&server.address(), 1280, 900);
    page.wait("Number(document.body.dataset.frames) >= 1");
    Some((browser, LivePage(page)))
}

/// Memory of this process, the server included \[bytes\]; zero where it cannot be read.
fn resident() -> f64 {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = text.split(' ').nth(1);
    pages
        .and_then(|pages| pages.parse::<f64>().ok())
        .map_or(0.0, |pages| 4096.0 * pages)
}

/// Longest wait for a part of the changes.
const HOURS: Duration = Duration::from_secs(4 * 3600);

/// Most that server and page may grow over all changes after the first fifth \[bytes\].
const MOST_GROWTH: [f64; 2] = [30e6, 6e6];

/// `JOSTLE_CHANGES` is the number of changes, 10 000 unless given; `bench/live` runs it.
#[test]
#[ignore = "takes many minutes"]
fn memory_stays_steady_over_ten_thousand_changes() {
    let server = serve("paper");
    let Some((_browser, page)) = open_alone(&server) else {
        return;
    };
    page.wait("document.querySelectorAll('.curve-line').length === 1");
    let changes = std::env::var("JOSTLE_CHANGES").ok();
    let changes: usize = changes.and_then(|n| n.parse().ok()).unwrap_or(10_000);
    let parts = 10;
    let mut seen = Vec::new();
    for part in 0..parts {
        // Mostly the gap; now and then the ground motion, which begins the curve anew.
        let count = changes / parts;
        page.value(&format!(
            "window.done = false; (async () => {{ const pga = [...document.querySelectorAll('.knob-name')].find((l) => l.title.startsWith('motion.pga:')).parentElement.querySelector('.knob-slider'); const gap = document.querySelector('.knob-slider'); for (let i = 0; i < {count}; i++) {{ const f = document.body.dataset.frames; const s = i % 50 === 49 ? pga : gap; s.value = 0.1 + 0.4 * (((i + {part}) * 0.618) % 1); s.dispatchEvent(new Event('input')); const end = performance.now() + 20000; while (document.body.dataset.frames === f && performance.now() < end) await new Promise((r) => setTimeout(r, 0)); }} window.done = true; }})(); 0"
        ));
        page.wait_for("window.done", HOURS);
        page.settled();
        let now = [resident(), page.heap()];
        let elements = page.number("document.querySelectorAll('*').length");
        println!(
            "{} changes: server {:.1} MB, page {:.2} MB, {elements} elements",
            (part + 1) * count,
            now[0] / 1e6,
            now[1] / 1e6
        );
        seen.push(now);
    }
    assert!(
        page.frames() >= 0.98 * changes as f64,
        "{} frames",
        page.frames()
    );
    for (side, most) in MOST_GROWTH.into_iter().enumerate() {
        let grown = seen[parts - 1][side] - seen[1][side];
        assert!(grown < most, "{:.1} MB more on side {side}", grown / 1e6);
    }
    page.assert_content();
}

/// Prints how long a change takes to the new frame, and how memory behaves; run with `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn speed_of_changes() {
    let server = serve("paper");
    let Some((_browser, page)) = open_alone(&server) else {
        return;
    };
    page.wait("document.querySelectorAll('.curve-line').length === 1");
    std::thread::sleep(Duration::from_secs(3));
    let rounds: usize = std::env::var("JOSTLE_CHANGES")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(300);
    let memory = || resident() / 1e6;
    let measure = |count: usize| {
        page.value(&format!(
            "window.times = []; (async () => {{ const s = document.querySelector('.knob-slider'); for (let i = 0; i < {count}; i++) {{ const f = document.body.dataset.frames; const t = performance.now(); s.value = 0.1 + 0.4 * ((i * 0.618) % 1); s.dispatchEvent(new Event('input')); while (document.body.dataset.frames === f) await new Promise((r) => setTimeout(r, 0)); await new Promise((r) => requestAnimationFrame(r)); window.times.push(performance.now() - t); }} window.done = true; }})(); window.done = false"
        ));
        page.wait_for("window.done", HOURS);
        let at = |p: f64| {
            page.number(&format!(
                "window.times.sort((a, b) => a - b)[Math.floor({p} * (window.times.length - 1))]"
            ))
        };
        println!(
            "{count} changes: median {:.1} ms, 95 % {:.1} ms, most {:.1} ms; server {:.0} MB, page {:.0} MB",
            at(0.5),
            at(0.95),
            at(1.0),
            memory(),
            page.number("performance.memory.usedJSHeapSize / 1e6")
        );
    };
    measure(100);
    for _ in 0..(rounds / 200).max(1) {
        measure(rounds.min(200));
    }
}
