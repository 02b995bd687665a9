//! The live page in a real browser.

#![allow(
    clippy::unwrap_used,
    dead_code,
    reason = "a test stops at the first surprise, helpers included; the open page has helpers for other tests"
)]

#[path = "../../../jostle-report/tests/browser/opened.rs"]
mod opened;

mod exported;
mod notebook;

use std::ops::ControlFlow;
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

#[test]
fn a_slider_changes_the_run_and_nothing_flashes() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    assert!(
        page.headline().contains("J1 and J2 hit"),
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
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
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
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
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
    assert!(page.headline().contains("hit"));
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

#[test]
fn runs_are_pinned_compared_undone_and_redone() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    let first = page.headline();
    page.click("pin");
    page.type_into("gap[0].width", "60 mm");
    let second = page.headline();
    assert_ne!(first, second);
    let table = page.text("document.getElementById('comparison').textContent");
    assert!(
        table.contains("Peak force") && table.contains('%'),
        "{table}"
    );
    let ghost = page.text("document.querySelector('#scene .pinned').getAttribute('d')");
    assert!(
        ghost.matches('M').count() > 5,
        "the pinned run is not drawn: {ghost}"
    );
    page.glance("live-pinned");
    page.click("undo");
    assert_eq!(page.headline(), first);
    page.click("redo");
    assert_eq!(page.headline(), second);
    page.click("pin");
    assert_eq!(
        page.value("document.getElementById('compare').hidden"),
        true
    );
    page.assert_content();
}

#[test]
fn the_address_restores_the_state_and_pages_do_not_disturb_each_other() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.type_into("gap[0].width", "47 mm");
    page.value("{ const m = document.getElementById('measure'); m.value = '2'; m.dispatchEvent(new Event('change')); }");
    page.wait("location.hash.length > 200");
    std::thread::sleep(Duration::from_millis(900));
    let address = page.text("location.href");
    let other = open_address(&address, 1400, 1000).unwrap();
    other.wait("Number(document.body.dataset.frames) >= 1");
    assert_eq!(other.headline(), page.headline());
    assert!(other.model().contains("width = \"47 mm\""));
    assert_eq!(other.text("document.getElementById('measure').value"), "2");
    let kept = page.headline();
    other.type_into("gap[0].width", "300 mm");
    assert_ne!(other.headline(), kept);
    assert_eq!(page.headline(), kept);
    page.type_into("motion.pga", "70 cm/s2");
    assert!(!other.model().contains("70 cm/s2"));
    // The address of another state in the same tab does not load the page, but shows the state; Undo leads back.
    let hash = address.split('#').nth(1).unwrap();
    other.value(&format!("location.hash = {hash:?}"));
    other.wait("document.getElementById('text').value.includes('width = \"47 mm\"')");
    other.settled();
    assert_eq!(other.headline(), kept);
    other.click("undo");
    assert!(
        other.model().contains("width = \"300 mm\""),
        "{}",
        other.model()
    );
    // An address that was cut off changes nothing.
    other.value(&format!("location.hash = {:?}", &hash[..hash.len() / 2]));
    std::thread::sleep(Duration::from_millis(300));
    assert!(other.model().contains("width = \"300 mm\""));
    page.assert_content();
    other.assert_content();
}

#[test]
fn the_curve_shows_the_smallest_gap_and_its_line_can_be_moved() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.type_into("motion.pga", "70 cm/s2");
    page.wait("document.getElementById('curve-note').textContent.includes('Smallest gap without pounding')");
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
    assert!(page.headline().contains("hit"), "{}", page.headline());
    // By keyboard, and by dragging.
    page.value("document.querySelector('.handle').focus()");
    page.key("ArrowRight");
    page.settled();
    let moved =
        page.number("Number(document.querySelector('.handle').getAttribute('aria-valuenow'))");
    assert!(moved > needed - 0.5, "{moved}");
    page.wait("document.querySelector('.handle') !== null");
    use headless_chrome::protocol::cdp::Input::DispatchMouseEventTypeOption::{
        MouseMoved, MousePressed, MouseReleased,
    };
    page.value("document.getElementById('curve-picture').scrollIntoView({ block: 'center' })");
    let [left, top, width] = ["left", "top", "width"].map(|side| {
        page.number(&format!(
            "document.getElementById('curve-picture').getBoundingClientRect().{side}"
        ))
    });
    page.mouse(MousePressed, left + 0.2 * width, top + 100.0);
    page.mouse(MouseMoved, left + 0.25 * width, top + 100.0);
    page.mouse(MouseMoved, left + 0.3 * width, top + 100.0);
    page.mouse(MouseReleased, left + 0.3 * width, top + 100.0);
    page.settled();
    assert!(page.headline().contains("hit"), "{}", page.headline());
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
    let server = serve("paper");
    let Some(page) = open(&server, 1280, 800) else {
        return;
    };
    page.value("{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.textContent.includes('acceleration')); const f = document.getElementById(l.htmlFor); f.scrollIntoView({ block: 'nearest' }); f.value = '70 cm/s2'; f.dispatchEvent(new Event('change')); }");
    page.settled();
    assert!(
        page.headline().contains("No contact"),
        "{}",
        page.headline()
    );
    page.wait("document.getElementById('curve-note').textContent.includes('Smallest gap without pounding')");
    page.wait("document.querySelector('.code-marks .needed') !== null");
    let said = page.text(
        "/pounding: ([\\d.]+) mm/.exec(document.getElementById('curve-note').textContent)[1]",
    );
    let tile = page.text("[...document.querySelectorAll('.tile')].find((t) => t.textContent.includes('Smallest gap')).querySelector('.tile-value').textContent");
    assert_eq!(tile.replace('\u{a0}', " "), format!("{said} mm"));
    let seen = "['#curve-note', '.code-marks .needed', '#headline'].every((s) => { const r = document.querySelector(s).getBoundingClientRect(); return r.top >= 0 && r.bottom <= innerHeight; })";
    assert_eq!(page.value(seen), true, "the answer is out of sight");
    page.glance("live-first-minute");
    page.assert_content();
}

/// Accuracy of a run with one width, in the words of the command line.
fn accuracy_of(width: &str) -> [String; 2] {
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
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    let shown = "document.getElementById('accuracy').textContent";
    let [_, sound] = accuracy_of("100 mm");
    page.wait(&format!("{shown} === {sound:?}"));
    // A gap that the buildings just graze, as `jostle gap` finds it.
    let note = "document.getElementById('curve-note').textContent";
    page.wait(&format!("{note}.includes('Smallest gap without pounding')"));
    let needed = page.text(&format!("/pounding: ([\\d.]+) mm/.exec({note})[1]"));
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

#[test]
fn ports_of_given_buildings_have_knobs() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("given.toml");
    let text = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.2 g"

[[building]]
name = "A"
kind = "given"
matrices = { stiffness = [[120e6, -60e6], [-60e6, 60e6]], mass = [40e3, 40e3] }
damping = { ratio = 0.05, modes = [1, 2] }

[building.ports]
"1" = { dof = 1, height = "3 m" }
roof = { dof = 2, height = "6 m" }

[[building]]
name = "B"
kind = "shear"
mass = ["60 t", "60 t"]
stiffness = "20 MN/m"
storey_height = "3 m"

[[gap]]
between = ["A", "B"]
width = "10 mm"
"#;
    std::fs::write(&file, text).unwrap();
    let server = serve(file.to_str().unwrap());
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.search("ports");
    page.type_into("building[0].ports.roof.height", "3 kg");
    let fault = page.fault_of("building[0].ports.roof.height");
    assert!(fault.contains("expected a length"), "{fault}");
    page.type_into("building[0].ports.roof.height", "6.5 m");
    assert_eq!(page.fault_of("building[0].ports.roof.height"), "");
    assert!(
        page.model()
            .contains("roof = { dof = 2, height = \"6.5 m\" }"),
        "{}",
        page.model()
    );
    // Drawn as high as it says.
    let said = page.text(
        "[...document.querySelectorAll('.dimension-name')].map((t) => t.textContent).join('|')",
    );
    assert!(said.contains("3.5") || said.contains("6.5 m"), "{said}");
    // The slider moves the lower port, and the present value of the curve can be a port.
    page.value("{ const s = [...document.querySelectorAll('.knob')].find((k) => k.querySelector('.knob-name').title.startsWith('building[0].ports.1.height:')).querySelector('.knob-slider'); s.focus(); s.value = Number(s.value) + 0.05; s.dispatchEvent(new Event('input')); }");
    page.settled();
    assert!(
        !page
            .model()
            .contains("\"1\" = { dof = 1, height = \"3 m\" }"),
        "{}",
        page.model()
    );
    page.glance("live-ports");
    page.assert_content();
}

#[test]
fn panels_of_impacts_follow_the_run() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.value("document.getElementById('charts').scrollIntoView()");
    page.wait("document.querySelectorAll('.disc').length === 1");
    let name = "document.querySelector('.impact-name')?.textContent ?? ''";
    let first = page.text(name);
    assert!(first.contains("peak force 1283 kN"), "{first}");
    assert_eq!(
        page.number("document.querySelectorAll('.impact-pictures svg').length"),
        2.0
    );
    page.type_into("gap[0].width", "30 mm");
    let second = page.text(name);
    assert!(
        second.contains("the hardest of") && second != first,
        "{second}"
    );
    assert!(page.number("document.querySelectorAll('.impact-panel').length") > 3.0);
    assert!(page.number("document.querySelectorAll('.disc').length") > 3.0);
    page.type_into("gap[0].width", "300 mm");
    assert_eq!(
        page.value("document.getElementById('impact-panels').hidden"),
        true
    );
    assert_eq!(
        page.number("document.querySelectorAll('.disc').length"),
        0.0
    );
    page.assert_content();
}

#[test]
fn contacts_between_floors_have_loops_and_their_own_closing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("levels.toml");
    let building = |name: &str, storeys: usize, height: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"frame\"\nstoreys = {storeys}\nstorey_height = \"{height}\"\nspans = [\"6 m\"]\ncolumn = {{ width = \"450 mm\", depth = \"450 mm\" }}\nbeam = {{ width = \"300 mm\", depth = \"600 mm\" }}\nconcrete = \"C30\"\nbeam_mass = \"40 kN/m\"\n\n"
        )
    };
    let text = format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"6 s\"\n\n{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"10 mm\"\nfloors = \"all\"\nlaw = \"hertz\"\nstiffness = \"2e9 N/m^1.5\"\n",
        building("A", 2, "4.2 m"),
        building("B", 4, "3.3 m")
    );
    std::fs::write(&file, text).unwrap();
    let server = serve(file.to_str().unwrap());
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.value("document.getElementById('charts').scrollIntoView()");
    page.wait("document.querySelectorAll('.impact-pictures svg').length === 2");
    let name = page.text("document.querySelector('.impact-name').textContent");
    assert!(name.contains("height"), "{name}");
    // The loop of Hertz's law is its curve: F/F₀ = (δ/δ₀)^1.5.
    let off = page.number("(() => { const d = document.querySelectorAll('.impact-pictures svg')[1].querySelector('.line').getAttribute('d'); const points = d.slice(1).split('L').map((p) => p.split(',').map(Number)); const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])]; const [x0, y0] = [Math.min(...xs), Math.max(...ys)]; const [w, h] = [Math.max(...xs) - x0, y0 - Math.min(...ys)]; return points.length < 5 ? points.length : points.reduce((worst, [x, y]) => Math.max(worst, Math.abs((y0 - y) / h - ((x - x0) / w) ** 1.5)), 0); })()");
    assert!(off < 5e-3, "{off} off the law");
    // At its peak the closing is that of the run, which straight lines between floors do not give.
    page.value("[...document.querySelectorAll('#impact-panels button')].find((b) => b.textContent === 'Hardest').click()");
    let number = |script: &str| -> f64 {
        let text = page.text(script);
        text.replace(['\u{a0}', '\u{202f}'], " ")
            .split(' ')
            .find_map(|word| word.parse().ok())
            .unwrap_or_else(|| panic!("no number in {text}"))
    };
    let shown = number(
        "[...document.querySelectorAll('figcaption')].find((c) => c.textContent.startsWith('Closing, ')).textContent.split('closing')[1].replace(/without.*/, '')",
    );
    let peak = number(
        "[...document.querySelectorAll('.tile')].find((t) => t.textContent.includes('Peak closing')).querySelector('.tile-value').textContent",
    );
    assert!(
        (shown - peak).abs() < 0.1,
        "{shown} mm drawn, {peak} mm in the summary"
    );
    page.glance("live-between-floors");
    page.assert_content();
}

#[test]
fn two_keys_make_a_map_and_a_click_sets_both() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    let cells = "document.querySelectorAll('.cells rect').length";
    // The knob is in view before the map begins, which takes a second or two.
    page.search("ratio");
    page.value("{ const a = document.getElementById('across'); a.value = 'motion.pga'; a.dispatchEvent(new Event('change')); }");
    page.wait("document.getElementById('curve-note').textContent.includes('cells.')");
    // A knob that is neither of the two cancels it, unless it is complete: no cell comes until the new one begins.
    page.value("{ window.few = 0; window.sent = []; const send = WebSocket.prototype.send; WebSocket.prototype.send = function (text) { const op = JSON.parse(text).op; if (op === 'run') { window.complete ??= document.querySelectorAll('.cells rect').length === 24 * 24; } window.sent.push(op); send.call(this, text); }; }");
    page.type_into("building[1].damping.ratio", "0.03");
    page.wait("window.sent.includes('curve')");
    let sent = page.text("window.sent.join()");
    let complete = page.value("window.complete") == true;
    assert!(sent.starts_with("stop-curve,run") || complete, "{sent}");
    page.wait(&format!("{cells} === 24 * 24"));
    assert_eq!(
        page.value("document.querySelector('.cells .failed') === null"),
        true
    );
    page.glance("live-map");
    // A cell says the result of a run with its values.
    let click = "(event) => { const box = document.querySelector('.cells').getBoundingClientRect(); const host = document.getElementById('curve-picture'); host.setPointerCapture = () => {}; host.dispatchEvent(new PointerEvent('pointerdown', { clientX: box.left + 2, clientY: box.top + 2, bubbles: true })); }";
    page.value(&format!("({click})()"));
    page.settled();
    let title = page.text("[...document.querySelectorAll('.cells rect')].reduce((a, b) => (b.getBBox().x + b.getBBox().y < a.getBBox().x + a.getBBox().y ? b : a)).querySelector('title').textContent");
    assert!(title.starts_with("0 mm, "), "{title}");
    assert!(
        page.model().contains("width = \"0 mm\""),
        "{}",
        page.model()
    );
    let pga = title.split(", ").nth(1).unwrap().split(':').next().unwrap();
    assert!(
        page.model().contains(&format!("pga = \"{}\"", pga.trim())),
        "{pga}: {}",
        page.model()
    );
    let force = title.rsplit(": ").next().unwrap().trim_end_matches(" kN");
    let shown: f64 = force.replace(['\u{202f}', ','], "").parse().unwrap();
    page.click("pin");
    let row = page.text("[...document.querySelectorAll('#comparison tr')].find((r) => r.textContent.startsWith('Peak force')).children[1].textContent");
    let exact: f64 = row
        .trim_end_matches(" kN")
        .replace(['\u{202f}', ','], "")
        .parse()
        .unwrap();
    assert!((shown / exact - 1.0).abs() < 2e-3, "{title}, {row}");
    // One step of Undo takes both back; arrow keys move both.
    page.click("undo");
    assert!(
        page.model().contains("width = \"100 mm\""),
        "{}",
        page.model()
    );
    page.value("document.querySelector('.cross').focus()");
    page.key("ArrowUp");
    page.key("ArrowLeft");
    page.settled();
    assert!(!page.model().contains("width = \"100 mm\""));
    assert_eq!(
        page.value("document.activeElement.classList.contains('cross')"),
        true
    );
    // The curve again.
    page.value("{ const a = document.getElementById('across'); a.value = ''; a.dispatchEvent(new Event('change')); }");
    page.wait("document.querySelectorAll('.curve-line').length === 1");
    page.assert_content();
}

#[test]
fn a_lost_connection_is_said_and_the_page_still_plays() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    drop(server);
    page.wait("!document.getElementById('connection').hidden");
    let status = page.text("document.getElementById('connection').textContent");
    assert!(status.contains("No connection"), "{status}");
    page.value("document.getElementById('next').click()");
    page.glance("live-lost");
}

#[test]
fn a_page_connects_again_and_goes_on() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.value("{ window.sockets = []; const send = WebSocket.prototype.send; WebSocket.prototype.send = function (text) { if (window.sockets.at(-1) !== this) window.sockets.push(this); send.call(this, text); }; }");
    page.type_into("gap[0].width", "60 mm");
    let frames = page.frames();
    page.value("window.sockets[0].close()");
    page.wait("!document.getElementById('connection').hidden");
    page.glance("live-connecting");
    page.wait("document.getElementById('connection').hidden && window.sockets.length === 2");
    page.wait(&format!("Number(document.body.dataset.frames) > {frames}"));
    // Without a connection a change is kept, and nothing seems to run.
    page.search("duration");
    page.value("window.sockets[1].close()");
    page.wait("!document.getElementById('connection').hidden");
    page.value("{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.title.startsWith('motion.duration:')); const f = document.getElementById(l.htmlFor); f.value = '12 s'; f.dispatchEvent(new Event('change')); }");
    assert_eq!(
        page.value("document.getElementById('working').hidden"),
        true
    );
    page.wait("document.getElementById('connection').hidden && document.getElementById('text').value.includes('duration = \"12 s\"')");
    page.settled();
    page.search("");
    // The model is the one of before, not that of the file.
    assert!(
        page.model().contains("width = \"60 mm\""),
        "{}",
        page.model()
    );
    page.type_into("gap[0].width", "300 mm");
    assert!(
        page.headline().contains("No contact"),
        "{}",
        page.headline()
    );
    page.assert_content();
}

#[test]
fn pages_fit_phones_and_dark_is_dark() {
    let server = serve("paper");
    let Some(page) = open(&server, 375, 760) else {
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
    let wide = open(&server, 1400, 1000).unwrap();
    wide.value("document.getElementById('theme').click()");
    wide.wait("document.querySelectorAll('.curve-line').length === 1");
    wide.glance("live-dark");
}

#[test]
fn the_keyboard_is_enough() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.value("document.getElementById('search').focus()");
    for key in ["Tab", "Tab"] {
        page.key(key);
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
        page.key("ArrowLeft");
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
        page.key(key);
    }
    page.settled();
    assert!(
        page.model().contains("width = \"55mm\""),
        "{}",
        page.model()
    );
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
        page.key("Tab");
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
    page.key("Enter");
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
    page.wait("document.body.classList.contains('faulty')");
    assert!(page.fault_of("gap[0].width").contains("expected a length"));
    page.glance("live-broken");
    page.type_into("gap[0].width", "90 mm");
    page.wait("Number(document.body.dataset.frames) === 1");
    assert!(page.headline().contains("hit"), "{}", page.headline());
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
    page.wait("document.getElementById('curve-note').textContent.includes('Smallest gap')");
    let first = page.headline();
    page.value("{ const s = document.getElementById('several'); s.value = '1'; s.dispatchEvent(new Event('change')); }");
    page.settled();
    assert_ne!(page.headline(), first, "the other record shakes otherwise");
    page.value("document.querySelector('.handle').focus()");
    page.key("ArrowRight");
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
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.emulate_reduced_motion();
    let shape = "document.querySelector('.building .columns').getAttribute('d')";
    let before = page.text(shape);
    std::thread::sleep(Duration::from_millis(400));
    assert_eq!(
        page.text(shape),
        before,
        "the animation plays before it is asked to"
    );
    assert_eq!(page.number("document.getAnimations().length"), 0.0);
}

#[test]
fn files_are_kept() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.value("window.files = []; URL.createObjectURL = (blob) => { blob.text().then((text) => window.files.push(text)); return 'about:blank#'; }; HTMLAnchorElement.prototype.click = function () { window.files.name = this.download; }");
    page.type_into("gap[0].width", "55 mm");
    page.click("save-model");
    page.wait("window.files.length === 1");
    let model = page.text("window.files[0]");
    assert!(
        model.contains("width = \"55 mm\"") && model.contains('#'),
        "comments stay"
    );
    assert!(
        jostle_io::read_model_text("saved", &model, jostle_io::Format::Toml, Path::new("")).is_ok()
    );
    page.value("document.getElementById('save-study').click()");
    page.wait("window.files.length === 2");
    let study = page.text("window.files[1]");
    let base = jostle_io::ModelTree::parse("paper", &model, jostle_io::Format::Toml, Path::new(""))
        .unwrap();
    let own = study
        .lines()
        .filter(|line| !line.starts_with("base ="))
        .collect::<Vec<_>>()
        .join("\n");
    let read = jostle_io::StudyFile::parse(
        "study",
        &own,
        jostle_io::Format::Toml,
        Path::new(""),
        Some(base),
    );
    assert!(
        read.is_ok(),
        "{study}\n{:?}",
        read.err().map(|e| e.to_string())
    );
    page.value("document.getElementById('save-report').click()");
    page.wait("window.files.length === 3");
    let report = page.text("window.files[2]");
    assert!(report.starts_with("<!DOCTYPE html>") && report.contains("Seismic pounding report"));
    page.assert_content();
}

/// Memory of this process, the server included \[bytes\]; zero where it cannot be read.
fn resident() -> f64 {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = text.split(' ').nth(1);
    pages
        .and_then(|pages| pages.parse::<f64>().ok())
        .map_or(0.0, |pages| 4096.0 * pages)
}

/// Most that server and page may grow over all changes after the first fifth \[bytes\].
const MOST_GROWTH: [f64; 2] = [30e6, 6e6];

/// `JOSTLE_CHANGES` is the number of changes, 10 000 unless given; `bench/live` runs it.
#[test]
#[ignore = "takes many minutes"]
fn memory_stays_steady_over_ten_thousand_changes() {
    let server = serve("paper");
    let Some(page) = open(&server, 1280, 900) else {
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
        while page.value("window.done") != true {
            std::thread::sleep(Duration::from_millis(500));
        }
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
    let Some(page) = open(&server, 1280, 900) else {
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
        while page.value("window.done") != true {
            std::thread::sleep(Duration::from_millis(200));
        }
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
