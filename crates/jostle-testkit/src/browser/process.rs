//! A Chromium that ends with its owner.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;

use super::connection::{Connection, PATIENCE};
use super::page::{Page, Tabs};

const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
];

const ARGUMENTS: [&str; 21] = [
    "--headless",
    "--no-sandbox",
    "--remote-debugging-port=0",
    "--no-startup-window",
    "--no-first-run",
    // The same pictures on every machine.
    "--disable-gpu",
    "--force-color-profile=srgb",
    // Nothing but the pages.
    "--disable-background-networking",
    "--disable-breakpad",
    "--disable-component-extensions-with-background-pages",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-extensions",
    "--disable-quic",
    "--disable-sync",
    // No process in advance for a page that may come, and no page that was left.
    "--disable-features=SpareRendererForSitePerProcess,BackForwardCache",
    // Containers have little shared memory.
    "--disable-dev-shm-usage",
    // Every page runs as if it were the one in front.
    "--disable-background-timer-throttling",
    "--disable-backgrounding-occluded-windows",
    "--disable-renderer-backgrounding",
    "--mute-audio",
];

/// Runs the browser until standard input ends, which it does whenever the owner drops it or dies, and removes the profile.
const GUARD: &str = r#"
trap '' HUP INT TERM
profile=$1; shift
"$@" "--user-data-dir=$profile" </dev/null &
exec 2>/dev/null
cat
kill -9 $!
wait
rm -rf "$profile" || { sleep 1; rm -rf "$profile"; }
"#;

/// A running Chromium. It ends when it is dropped, and when the test process ends, however that ends.
#[derive(Debug)]
pub struct Browser {
    guard: Child,
    address: String,
    tabs: Tabs,
}

impl Browser {
    /// Starts the Chromium of this machine. Most tests share one, by [`open_page`](super::open_page); a test that measures
    /// the browser itself needs its own.
    ///
    /// # Panics
    /// If there is no Chromium, or it does not start.
    #[must_use]
    pub fn start() -> Self {
        let folders = std::env::var_os("PATH").unwrap_or_default();
        let program: PathBuf = std::env::split_paths(&folders)
            .flat_map(|folder| NAMES.map(|name| folder.join(name)))
            .find(|path| path.is_file())
            .expect("no chromium found: install the package `chromium` (apt install chromium), or set JOSTLE_SKIP_BROWSER=1 to leave the browser tests out");
        let profile = tempfile::tempdir()
            .expect("a folder for the profile")
            .keep();
        let guard = Command::new("sh")
            .args(["-c", GUARD, "sh"])
            .arg(profile)
            .arg(&program)
            .args(ARGUMENTS)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("a shell");
        let mut new = Self {
            guard,
            address: String::new(),
            tabs: Tabs::default(),
        };
        let errors = new.guard.stderr.take().expect("it is piped");
        let (send, lines) = mpsc::channel();
        // Reads to the end: a full pipe would stop the browser.
        std::thread::spawn(move || {
            for line in BufReader::new(errors).lines().map_while(Result::ok) {
                let _ = send.send(line);
            }
        });
        let mut said = Vec::new();
        loop {
            let Ok(line) = lines.recv_timeout(PATIENCE) else {
                panic!("{} does not start: {said:#?}", program.display());
            };
            if let Some(address) = line.strip_prefix("DevTools listening on ") {
                address.clone_into(&mut new.address);
                return new;
            }
            said.push(line);
        }
    }

    /// Opens an address in a window of this size \[px\].
    #[must_use]
    pub fn open(&self, address: &str, width: u32, height: u32) -> Page {
        Page::open(&self.tabs, address, [width, height], || {
            Connection::new(&self.address)
        })
    }

    /// Opens the text of a page, from a file, in a window of this size \[px\].
    ///
    /// # Panics
    /// If the file cannot be written.
    #[must_use]
    pub fn open_page(&self, text: &str, width: u32, height: u32) -> Page {
        let folder = tempfile::tempdir().expect("a folder for the page");
        let file = folder.path().join("report.html");
        std::fs::write(&file, text).expect("the page is written");
        let page = self.open(&format!("file://{}", file.display()), width, height);
        page.keep(folder)
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        drop(self.guard.stdin.take());
        let _ = self.guard.wait();
    }
}
