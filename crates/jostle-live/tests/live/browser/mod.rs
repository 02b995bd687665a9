//! The live page in a real browser.
//!
//! Needs a chromium on the machine; set `JOSTLE_SKIP_BROWSER` to do without.

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

use std::ops::Deref;
use std::path::Path;
use std::sync::OnceLock;

use jostle_live::{Engine, Server};
use jostle_testkit::browser::{Page, open_address};

fn serve(model: &str) -> Server {
    Server::start(Engine::open(Path::new(model)).unwrap(), 0).unwrap()
}

/// The server of the built-in example, for many tests: pages do not disturb each other.
fn paper() -> &'static Server {
    static PAPER: OnceLock<Server> = OnceLock::new();
    PAPER.get_or_init(|| serve("paper"))
}

/// The same for tests without numbers of the built-in example: 8 s of its motion, with its first impact, take a quarter of
/// the time.
fn short() -> &'static Server {
    static SHORT: OnceLock<Server> = OnceLock::new();
    SHORT.get_or_init(|| {
        let text = jostle_io::model_text("paper").unwrap();
        let text = text.replacen("[motion]\n", "[motion]\nduration = \"8 s\"\n", 1);
        let engine = Engine::from_text("paper", &text, Path::new("")).unwrap();
        Server::start(engine, 0).unwrap()
    })
}

fn open(server: &Server, width: u32, height: u32) -> Option<LivePage> {
    let page = open_address(&server.address(), width, height)?;
    page.wait("Number(document.body.dataset.frames) >= 1");
    Some(LivePage(page))
}

/// An open live page.
struct LivePage(Page);

impl Deref for LivePage {
    type Target = Page;

    fn deref(&self) -> &Page {
        &self.0
    }
}

impl LivePage {
    fn frames(&self) -> f64 {
        self.number("Number(document.body.dataset.frames)")
    }

    /// Waits until all changes are shown.
    fn settled(&self) {
        self.wait("document.body.dataset.waiting === 'false'");
        self.drawn();
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
}
