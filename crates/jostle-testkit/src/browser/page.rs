//! An open page: what it shows, what it answers, what it complains about.

use std::cell::{RefCell, RefMut};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use base64::Engine as _;
use serde_json::{Value, json};

use super::connection::{Connection, PATIENCE};

/// What the mouse does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mouse {
    /// Moves to a point.
    Move,
    /// Presses the left button.
    Press,
    /// Releases it.
    Release,
}

/// Empty tabs of a browser. A page takes one and returns it: another context, window and process would cost more than most
/// pages do.
pub(super) type Tabs = Arc<Mutex<Vec<Connection>>>;

/// An open page; dropped, it closes.
///
/// Methods panic if the browser refuses a command, and if a script of the test throws.
#[derive(Debug)]
pub struct Page {
    /// `None` only while it is dropped.
    connection: RefCell<Option<Connection>>,
    tabs: Tabs,
    /// Folder of the file that the page was opened from.
    folder: Option<tempfile::TempDir>,
}

impl Page {
    pub(super) fn open(
        tabs: &Tabs,
        address: &str,
        size: [u32; 2],
        new_tab: impl FnOnce() -> Connection,
    ) -> Self {
        let empty = tabs.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let page = Self {
            connection: RefCell::new(Some(empty.unwrap_or_else(new_tab))),
            tabs: Arc::clone(tabs),
            folder: None,
        };
        page.resize(size[0], size[1]);
        let answer = page.call("Page.navigate", json!({ "url": address }));
        assert!(answer["errorText"].is_null(), "{address}: {answer}");
        page.wait("location.href !== 'about:blank' && document.readyState === 'complete'");
        page.drawn();
        page
    }

    /// Keeps the folder of the file that is open.
    pub(super) fn keep(mut self, folder: tempfile::TempDir) -> Self {
        self.folder = Some(folder);
        self
    }

    fn connection(&self) -> RefMut<'_, Connection> {
        RefMut::map(self.connection.borrow_mut(), |connection| {
            connection.as_mut().expect("it is not dropped yet")
        })
    }

    /// Runs any command of the protocol.
    pub fn call(&self, method: &str, parameters: Value) -> Value {
        self.connection().call(method, parameters)
    }

    /// Gives the window another size \[px\]; below 500 px it is that of a phone.
    pub fn resize(&self, width: u32, height: u32) {
        self.call(
            "Emulation.setDeviceMetricsOverride",
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500 }),
        );
    }

    /// Shows the page as on a medium (`"screen"`, `"print"`; empty for the usual one) with features such as
    /// `("prefers-color-scheme", "dark")`.
    pub fn emulate(&self, medium: &str, features: &[(&str, &str)]) {
        let features: Vec<Value> = features
            .iter()
            .map(|(name, value)| json!({ "name": name, "value": value }))
            .collect();
        self.call(
            "Emulation.setEmulatedMedia",
            json!({ "media": medium, "features": features }),
        );
    }

    /// Value of a script, once the promise it may return is kept.
    pub fn value(&self, script: &str) -> Value {
        self.attempt(script)
            .unwrap_or_else(|error| panic!("{error}, in {script}"))
    }

    fn attempt(&self, script: &str) -> Result<Value, String> {
        let mut answer = self.connection().attempt(
            "Runtime.evaluate",
            json!({ "expression": script, "awaitPromise": true }),
        )?;
        match answer.get("exceptionDetails") {
            Some(details) => {
                let said = details["exception"]["description"].as_str();
                Err(said.map_or_else(|| details.to_string(), str::to_owned))
            }
            None => Ok(answer["result"]["value"].take()),
        }
    }

    /// Number that a script returns.
    pub fn number(&self, script: &str) -> f64 {
        let value = self.value(script);
        let number = value.as_f64();
        number.unwrap_or_else(|| panic!("no number from {script}: {value}"))
    }

    /// Text that a script returns; empty if it returns something else.
    pub fn text(&self, script: &str) -> String {
        self.value(script).as_str().unwrap_or_default().to_owned()
    }

    /// Waits until a script returns `true`.
    pub fn wait(&self, script: &str) {
        self.wait_for(script, PATIENCE);
    }

    /// Waits until a script returns `true`, not longer than this. Until then it may throw.
    pub fn wait_for(&self, script: &str, patience: Duration) {
        let begun = Instant::now();
        let mut pause = Duration::from_millis(4);
        loop {
            let answer = self.attempt(script);
            if answer == Ok(Value::Bool(true)) {
                return;
            }
            if begun.elapsed() > patience {
                self.glance("waited-in-vain");
                panic!("never true: {script}: {answer:?}");
            }
            std::thread::sleep(pause);
            pause = (2 * pause).min(Duration::from_millis(50));
        }
    }

    /// Waits until what was changed is drawn: an observer of sizes sees it in the next frame, what it asks for comes in the
    /// one after, and is done before the third.
    pub fn drawn(&self) {
        self.frames_pass(3);
    }

    /// Waits for so many animation frames.
    pub fn frames_pass(&self, frames: usize) {
        self.value(&format!(
            "(async () => {{ for (let i = 0; i < {frames}; i++) await new Promise(requestAnimationFrame); }})()"
        ));
    }

    /// Uses the mouse at a point of the window \[px\].
    pub fn mouse(&self, what: Mouse, x: f64, y: f64) {
        let kind = match what {
            Mouse::Move => "mouseMoved",
            Mouse::Press => "mousePressed",
            Mouse::Release => "mouseReleased",
        };
        self.call(
            "Input.dispatchMouseEvent",
            json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 }),
        );
    }

    /// Presses and releases a key where the focus is: an ASCII letter or digit, Tab, Enter, Escape, or an arrow key.
    ///
    /// # Panics
    /// For another key.
    pub fn press(&self, key: &str) {
        let (code, number, text) = match key {
            "Tab" => (key.to_owned(), 9, None),
            "Enter" => (key.to_owned(), 13, Some("\r")),
            "Escape" => (key.to_owned(), 27, None),
            "ArrowLeft" => (key.to_owned(), 37, None),
            "ArrowUp" => (key.to_owned(), 38, None),
            "ArrowRight" => (key.to_owned(), 39, None),
            "ArrowDown" => (key.to_owned(), 40, None),
            _ => {
                let letter = key.to_ascii_uppercase();
                let number = letter.bytes().next().filter(u8::is_ascii_alphanumeric);
                let number = number.unwrap_or_else(|| panic!("no key {key:?}"));
                let group = match number {
                    b'0'..=b'9' => "Digit",
                    _ => "Key",
                };
                (format!("{group}{letter}"), number, Some(key))
            }
        };
        let mut event = json!({ "key": key, "code": code, "windowsVirtualKeyCode": number });
        for kind in [text.map_or("rawKeyDown", |_| "keyDown"), "keyUp"] {
            event["type"] = kind.into();
            event["text"] = text
                .filter(|_| kind == "keyDown")
                .unwrap_or_default()
                .into();
            self.call("Input.dispatchKeyEvent", event.clone());
        }
    }

    /// Memory that scripts of the page hold after everything unused was freed \[bytes\].
    pub fn heap(&self) -> f64 {
        for _ in 0..2 {
            self.call("HeapProfiler.collectGarbage", json!({}));
        }
        let usage = self.call("Runtime.getHeapUsage", json!({}));
        usage["usedSize"].as_f64().expect("a size")
    }

    /// Keeps a picture of the whole page among the build outputs. The window stays as high as the page.
    pub fn picture(&self, name: &str) {
        let [width, height] = ["innerWidth", "document.documentElement.scrollHeight"]
            .map(|script| self.number(script) as u32);
        self.resize(width, height);
        self.drawn();
        self.glance(name);
    }

    /// Keeps a picture of what the window shows among the build outputs.
    ///
    /// # Panics
    /// If it cannot be written.
    pub fn glance(&self, name: &str) {
        let picture = self.call(
            "Page.captureScreenshot",
            json!({ "format": "png", "optimizeForSpeed": true }),
        );
        let text = picture["data"].as_str().unwrap_or_default();
        let decoded = base64::engine::general_purpose::STANDARD.decode(text);
        // The folder CARGO_TARGET_TMPDIR, which only the test program knows: the program is in target/debug/deps.
        let program = std::env::current_exe().expect("the test program");
        let folder = program.ancestors().nth(3).expect("a folder").join("tmp");
        std::fs::create_dir_all(&folder).expect("a folder for pictures");
        let file = folder.join(format!("{name}.png"));
        std::fs::write(file, decoded.expect("base64")).expect("the picture is written");
    }

    /// Exceptions, and everything that was written to the console.
    pub fn complaints(&self) -> Vec<String> {
        // Answers come after earlier events.
        self.value("0");
        self.connection().complaints.clone()
    }

    /// Nothing was complained about, every attribute of a drawing has numbers, and no two elements have one name, which would
    /// give one the other's clip or label.
    pub fn assert_content(&self) {
        let without_number = "[...document.querySelectorAll('svg, svg *')].flatMap((e) => [...e.attributes].filter((a) => \
            /NaN|undefined|Infinity/.test(a.value)).map((a) => `${e.tagName} ${a.name}=${a.value.slice(0, 80)}`)).join('; ')";
        assert_eq!(self.text(without_number), "", "a drawing has no number");
        let twice = "(() => { const ids = [...document.querySelectorAll('[id]')].map((e) => e.id); \
            return ids.filter((id, at) => ids.indexOf(id) < at).join(); })()";
        assert_eq!(self.text(twice), "", "names stand twice on the page");
        let complaints = self.complaints();
        assert!(
            complaints.is_empty(),
            "the page complained: {complaints:#?}"
        );
    }

    /// Nothing was requested from the network or from other files.
    pub fn assert_alone(&self) {
        let asked = "performance.getEntriesByType('resource').map((e) => e.name).join()";
        assert_eq!(self.text(asked), "", "the page loads something");
    }

    /// The page is not wider than this \[px\]. A phone widens its window to the content, so the window cannot be asked.
    pub fn assert_fits(&self, window: f64) {
        let content = self.number("document.documentElement.scrollWidth");
        assert!(
            content <= window,
            "{content} px wide in a window of {window} px"
        );
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        // The tab of a test that failed closes.
        if std::thread::panicking() {
            return;
        }
        // Others leave theirs as if it were new.
        self.call("Page.navigate", json!({ "url": "about:blank" }));
        self.wait("location.href === 'about:blank'");
        self.emulate("", &[]);
        self.mouse(Mouse::Move, 0.0, 0.0);
        if let Some(mut connection) = self.connection.take() {
            connection.complaints.clear();
            let tabs = self.tabs.lock();
            tabs.unwrap_or_else(PoisonError::into_inner)
                .push(connection);
        }
    }
}
