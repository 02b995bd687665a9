//! An open page: what it shows, what it answers, what it complains about.

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use headless_chrome::protocol::cdp::types::Event;
use headless_chrome::protocol::cdp::{Emulation, HeapProfiler, Input, Log, Page, Runtime};
use headless_chrome::{Browser, LaunchOptions, Tab};

fn chromium() -> PathBuf {
    let names = [
        "chromium",
        "chromium-browser",
        "google-chrome",
        "google-chrome-stable",
    ];
    let folders = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&folders)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|path| path.is_file())
        .expect("no chromium found: install the package `chromium` (apt install chromium), or set JOSTLE_SKIP_BROWSER=1 to leave the browser tests out")
}

/// An open page and everything it complained about.
pub(crate) struct Opened {
    tab: Arc<Tab>,
    complaints: Arc<Mutex<Vec<String>>>,
    // Dropped last: closing the browser ends the tab, and the folder holds the page.
    _browser: Browser,
    _folder: Option<tempfile::TempDir>,
}

/// Opens a page in a window of the given size; `None` when browser tests are switched off.
pub(crate) fn open_page(page: &str, width: u32, height: u32) -> Option<Opened> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.html");
    std::fs::write(&file, page).unwrap();
    let mut opened = open_address(&format!("file://{}", file.display()), width, height)?;
    opened._folder = Some(folder);
    Some(opened)
}

/// Opens an address in a window of the given size; `None` when browser tests are switched off.
pub(crate) fn open_address(address: &str, width: u32, height: u32) -> Option<Opened> {
    if std::env::var_os("JOSTLE_SKIP_BROWSER").is_some() {
        return None;
    }
    let options = LaunchOptions::default_builder()
        .path(Some(chromium()))
        .sandbox(false)
        .window_size(Some((width, height)))
        // A busy machine may keep the browser from answering for long.
        .idle_browser_timeout(Duration::from_secs(600))
        .args(
            ["--disable-gpu", "--disable-quic", "--disable-sync"]
                .map(std::ffi::OsStr::new)
                .to_vec(),
        )
        .build()
        .unwrap();
    let browser = Browser::new(options).unwrap();
    let tab = browser.new_tab().unwrap();
    let complaints = Arc::new(Mutex::new(Vec::new()));
    let notes = Arc::clone(&complaints);
    tab.add_event_listener(Arc::new(move |event: &Event| {
        let note = match event {
            Event::RuntimeExceptionThrown(e) => {
                Some(format!("exception: {:?}", e.params.exception_details))
            }
            Event::RuntimeConsoleAPICalled(e) => Some(format!("console: {:?}", e.params.args)),
            Event::LogEntryAdded(e) => Some(format!("log: {:?}", e.params.entry)),
            _ => None,
        };
        if let Some(note) = note {
            notes.lock().unwrap().push(note);
        }
    }))
    .unwrap();
    tab.call_method(Runtime::Enable(None)).unwrap();
    tab.call_method(Log::Enable(None)).unwrap();
    resize(&tab, width, height);
    tab.navigate_to(address).unwrap();
    tab.wait_until_navigated().unwrap();
    std::thread::sleep(Duration::from_millis(300));
    Some(Opened {
        tab,
        complaints,
        _browser: browser,
        _folder: None,
    })
}

fn resize(tab: &Tab, width: u32, height: u32) {
    tab.call_method(Emulation::SetDeviceMetricsOverride {
        width,
        height,
        device_scale_factor: 1.0,
        mobile: width < 500,
        scale: None,
        screen_width: None,
        screen_height: None,
        position_x: None,
        position_y: None,
        dont_set_visible_size: None,
        screen_orientation: None,
        viewport: None,
        display_feature: None,
        device_posture: None,
    })
    .unwrap();
}

impl Opened {
    pub(crate) fn value(&self, script: &str) -> serde_json::Value {
        let result = self.tab.evaluate(script, true).unwrap();
        result.value.unwrap_or_default()
    }

    pub(crate) fn number(&self, script: &str) -> f64 {
        self.value(script)
            .as_f64()
            .unwrap_or_else(|| panic!("no number from {script}"))
    }

    pub(crate) fn text(&self, script: &str) -> String {
        self.value(script).as_str().unwrap_or_default().to_owned()
    }

    pub(crate) fn mouse(&self, kind: Input::DispatchMouseEventTypeOption, x: f64, y: f64) {
        self.tab
            .call_method(Input::DispatchMouseEvent {
                Type: kind,
                x,
                y,
                button: Some(Input::MouseButton::Left),
                click_count: Some(1),
                modifiers: None,
                timestamp: None,
                buttons: None,
                force: None,
                tangential_pressure: None,
                tilt_x: None,
                tilt_y: None,
                twist: None,
                delta_x: None,
                delta_y: None,
                pointer_Type: None,
            })
            .unwrap();
    }

    /// Presses a key where the focus is.
    #[allow(dead_code, reason = "not every test file presses keys")]
    pub(crate) fn press(&self, key: &str) {
        self.tab.press_key(key).unwrap();
    }

    /// Memory that scripts of the page hold after everything unused was freed \[bytes\].
    #[allow(dead_code, reason = "not every test file asks for it")]
    pub(crate) fn heap(&self) -> f64 {
        for _ in 0..2 {
            self.tab
                .call_method(HeapProfiler::CollectGarbage(None))
                .unwrap();
        }
        let usage = self.tab.call_method(Runtime::GetHeapUsage(None)).unwrap();
        usage.used_size
    }

    /// The page is asked not to move.
    #[allow(dead_code, reason = "not every test file asks for it")]
    pub(crate) fn emulate_reduced_motion(&self) {
        self.tab
            .call_method(Emulation::SetEmulatedMedia {
                media: None,
                features: Some(vec![Emulation::MediaFeature {
                    name: "prefers-reduced-motion".into(),
                    value: "reduce".into(),
                }]),
            })
            .unwrap();
    }

    /// Keeps a picture of the whole page among the build outputs.
    pub(crate) fn picture(&self, name: &str) {
        let [width, height] = ["innerWidth", "document.documentElement.scrollHeight"]
            .map(|script| self.number(script) as u32);
        resize(&self.tab, width, height);
        std::thread::sleep(Duration::from_millis(300));
        self.glance(name);
    }

    /// Keeps a picture of what the window shows.
    pub(crate) fn glance(&self, name: &str) {
        let png = self
            .tab
            .capture_screenshot(Page::CaptureScreenshotFormatOption::Png, None, None, true)
            .unwrap();
        std::fs::write(format!("{}/{name}.png", env!("CARGO_TARGET_TMPDIR")), png).unwrap();
    }

    pub(crate) fn assert_content(&self) {
        let complaints = self.complaints.lock().unwrap();
        assert!(
            complaints.is_empty(),
            "the page complained: {complaints:#?}"
        );
    }

    /// Nothing was asked of the network or of other files.
    pub(crate) fn assert_alone(&self) {
        let asked = "performance.getEntriesByType('resource').map((e) => e.name).join()";
        assert_eq!(self.text(asked), "", "the page loads something");
    }

    pub(crate) fn assert_fits(&self, window: f64) {
        // A phone widens its window to the content, so the window cannot be asked.
        let content = self.number("document.documentElement.scrollWidth");
        assert!(
            content <= window,
            "{content} px wide in a window of {window} px"
        );
    }
}
