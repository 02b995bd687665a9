//! The live page in a real browser; what its server refuses.

#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test stops at the first surprise, helpers included; the open page has helpers for other tests"
)]

#[path = "../../../jostle-report/tests/pages/browser/opened.rs"]
mod opened;

mod connection;
mod endurance;
mod exported;
mod files;
mod gap_curve;
mod knobs;
mod maps;
mod notebook;
mod pages;
mod panels;
mod runs;
mod safety;

use std::path::Path;
use std::time::{Duration, Instant};

use jostle_live::{Engine, Server};
use opened::{Opened, open_address};

/// Longest wait for the page: a map is 576 runs, and the machine may be busy.
const PATIENCE: Duration = Duration::from_secs(120);

fn serve(model: &str) -> Server {
    Server::start(Engine::open(Path::new(model)).unwrap(), 0).unwrap()
}

fn open(server: &Server, width: u32, height: u32) -> Option<Opened> {
    let page = open_address(&server.address(), width, height)?;
    page.wait("Number(document.body.dataset.frames) >= 1");
    Some(page)
}

impl Opened {
    fn wait(&self, script: &str) {
        let begun = Instant::now();
        while self.value(script) != true {
            if begun.elapsed() > PATIENCE {
                self.glance("waited-in-vain");
                panic!("never true: {script}");
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn frames(&self) -> f64 {
        self.number("Number(document.body.dataset.frames)")
    }

    /// Waits until all changes are shown.
    fn settled(&self) {
        std::thread::sleep(Duration::from_millis(40));
        self.wait("document.body.dataset.waiting === 'false'");
    }

    fn headline(&self) -> String {
        self.text("document.getElementById('headline').textContent")
    }

    fn model(&self) -> String {
        self.text("document.getElementById('text').value")
    }

    /// Types into the field of a knob and leaves it.
    fn type_into(&self, name: &str, value: &str) {
        self.value(&format!(
            "{{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.title.startsWith({name:?} + ':')); const f = document.getElementById(l.htmlFor); f.value = {value:?}; f.dispatchEvent(new Event('change')); }}"
        ));
        self.settled();
    }

    fn search(&self, words: &str) {
        self.value(&format!("{{ const s = document.getElementById('search'); s.value = {words:?}; s.dispatchEvent(new Event('input')); }}"));
    }

    fn fault_of(&self, name: &str) -> String {
        self.text(&format!(
            "(() => {{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.title.startsWith({name:?} + ':')); const f = l.parentElement.querySelector('.fault'); return f.hidden ? '' : f.textContent; }})()"
        ))
    }

    fn click(&self, id: &str) {
        self.value(&format!("document.getElementById({id:?}).click()"));
        self.settled();
    }

    /// Makes the run long, stops it, and lets a newer change take the place of the long run.
    fn stops_a_long_run(&self) {
        self.search("duration");
        self.value("{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.title.startsWith('motion.duration:')); const f = document.getElementById(l.htmlFor); f.value = '2000 s'; f.dispatchEvent(new Event('change')); }");
        self.wait("!document.getElementById('working').hidden && document.getElementById('progress').value > 0");
        self.glance("live-working");
        self.click("stop");
        let stopped = || self.headline().starts_with("Stopped");
        assert!(stopped(), "{}", self.headline());
        self.type_into("motion.duration", "10 s");
        assert!(!stopped(), "{}", self.headline());
    }

    fn key(&self, key: &str) {
        self.press(key);
        std::thread::sleep(Duration::from_millis(30));
    }
}
