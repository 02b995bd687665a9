//! Reports as PDF, printed by a Chromium that is installed on the machine. Nothing is downloaded.

use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::error::RunError;

/// Environment variable with the path of the program.
const VARIABLE: &str = "JOSTLE_CHROMIUM";
/// Names under which Chromium and its relatives are installed.
const NAMES: [&str; 9] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "microsoft-edge",
    "microsoft-edge-stable",
    "msedge",
    "brave-browser",
];
/// Places that are not on the search path.
const PLACES: [&str; 7] = [
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
    "C:\\Program Files\\Google\\Chrome\\Application\\chrome.exe",
    "C:\\Program Files (x86)\\Google\\Chrome\\Application\\chrome.exe",
    "C:\\Program Files (x86)\\Microsoft\\Edge\\Application\\msedge.exe",
    "/snap/bin/chromium",
];
/// Largest report on paper \[bytes\].
const LARGEST_PDF: usize = 1 << 30;
/// Longest time that printing may take.
const PATIENCE: Duration = Duration::from_secs(180);
/// Time on its own clock that a page has to draw itself \[ms\].
const DRAWING: u32 = 20_000;

/// Size of the paper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paper {
    /// 210 × 297 mm.
    #[default]
    A4,
    /// 8.5 × 11 in.
    Letter,
}

impl Paper {
    /// Names, as typed.
    pub const NAMES: [&str; 2] = ["a4", "letter"];

    /// The size of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "a4" => Some(Self::A4),
            "letter" => Some(Self::Letter),
            _ => None,
        }
    }

    /// In style sheets.
    fn css(self) -> &'static str {
        match self {
            Self::A4 => "A4",
            Self::Letter => "letter",
        }
    }
}

/// The Chromium of this machine: that of the variable `JOSTLE_CHROMIUM`, else the first of the usual names.
///
/// # Errors
/// [`RunError::Argument`] with a remedy if there is none.
pub fn find_chromium() -> Result<PathBuf, RunError> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    choose(std::env::var_os(VARIABLE).as_deref(), &path, &PLACES)
}

fn choose(named: Option<&OsStr>, path: &OsStr, places: &[&str]) -> Result<PathBuf, RunError> {
    if let Some(named) = named.filter(|named| !named.is_empty()) {
        let program = PathBuf::from(named);
        return if program.is_file() {
            Ok(program)
        } else {
            Err(RunError::Argument(format!(
                "{VARIABLE} is \"{}\", which is no file; set it to the program of a Chromium, or unset it",
                program.display()
            )))
        };
    }
    let ending = std::env::consts::EXE_SUFFIX;
    for name in NAMES {
        let found =
            std::env::split_paths(path).map(|folder| folder.join(format!("{name}{ending}")));
        if let Some(program) = found.into_iter().find(|program| program.is_file()) {
            return Ok(program);
        }
    }
    let found = places.iter().map(PathBuf::from).find(|p| p.is_file());
    found.ok_or_else(|| {
        RunError::Argument(format!(
            "a PDF is printed by Chromium, and none was found ({}); install one, for example with \"apt install chromium\", set {VARIABLE} to its program, or open report.html in any browser and print it",
            NAMES.join(", ")
        ))
    })
}

/// Prints a page to a PDF file, completely or not at all.
///
/// # Errors
/// [`RunError::Analysis`] if Chromium fails, [`RunError::Argument`] if a file cannot be read or written.
pub fn print_pdf(chromium: &Path, page: &str, pdf: &Path, paper: Paper) -> Result<(), RunError> {
    let io = |what: &Path, error: std::io::Error| {
        RunError::Argument(format!("{}: {error}", what.display()))
    };
    let aside = tempfile::Builder::new().prefix("jostle-").tempdir();
    let aside = aside.map_err(|error| io(&std::env::temp_dir(), error))?;
    let (html, printed) = (
        aside.path().join("page.html"),
        aside.path().join("page.pdf"),
    );
    // The last rule for the paper counts; a browser that prints the page itself chooses its own.
    let size = format!("<style>@page {{ size: {} }}</style></head>", paper.css());
    let page = page.replacen("</head>", &size, 1);
    std::fs::write(&html, page).map_err(|error| io(&html, error))?;
    let mut command = Command::new(chromium);
    command
        .args([
            "--headless=new",
            "--disable-gpu",
            "--no-first-run",
            "--no-default-browser-check",
            "--disable-extensions",
            "--disable-background-networking",
            "--no-pdf-header-footer",
        ])
        .arg(format!("--virtual-time-budget={DRAWING}"))
        .arg(format!(
            "--user-data-dir={}",
            aside.path().join("profile").display()
        ))
        .arg(format!("--print-to-pdf={}", printed.display()))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    if is_root() {
        // Chromium refuses to start its sandbox for root; the page is jostle's own and loads nothing.
        command.arg("--no-sandbox");
    }
    command.arg(&html);
    let failed = |reason: String| {
        RunError::Analysis(format!(
            "{} could not print the report: {reason}",
            chromium.display()
        ))
    };
    let mut child = command.spawn().map_err(|error| failed(error.to_string()))?;
    let complaint = wait(&mut child).map_err(failed)?;
    let bytes = jostle_io::read_file(&printed, LARGEST_PDF).unwrap_or_default();
    if !bytes.starts_with(b"%PDF-") {
        return Err(failed(complaint));
    }
    Ok(jostle_io::write_atomically(pdf, &bytes)?)
}

/// Waits for the end of the program; returns its last words.
fn wait(child: &mut Child) -> Result<String, String> {
    let errors = child.stderr.take();
    // A full pipe would stop the program.
    let reader = std::thread::spawn(move || {
        let mut text = Vec::new();
        if let Some(mut errors) = errors {
            let _ = errors.read_to_end(&mut text);
        }
        String::from_utf8_lossy(&text).into_owned()
    });
    let begun = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(_)) => break,
            Ok(None) if begun.elapsed() > PATIENCE => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("it did not finish within {} s", PATIENCE.as_secs()));
            }
            Ok(None) => std::thread::sleep(Duration::from_millis(20)),
            Err(error) => return Err(error.to_string()),
        }
    }
    let text = reader.join().unwrap_or_default();
    let last = text.lines().rev().find(|line| !line.trim().is_empty());
    Ok(last.unwrap_or("it wrote no file").to_owned())
}

#[cfg(unix)]
fn is_root() -> bool {
    // Without unsafe code: the owner of this process's own folder.
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata("/proc/self").is_ok_and(|metadata| metadata.uid() == 0)
}

#[cfg(not(unix))]
fn is_root() -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_variable_comes_first_and_a_missing_program_has_a_remedy() {
        let folder = tempfile::tempdir().expect("a folder");
        let ending = std::env::consts::EXE_SUFFIX;
        let program = folder.path().join(format!("google-chrome{ending}"));
        let other = folder.path().join("mine");
        for file in [&program, &other] {
            std::fs::write(file, "").expect("written");
        }
        let path = folder.path().as_os_str();
        let found = |named, path| choose(named, path, &[]);
        assert_eq!(found(None, path).expect("on the path"), program);
        assert_eq!(found(Some(other.as_os_str()), path).expect("named"), other);
        let missing = found(Some(OsStr::new("/none")), path)
            .expect_err("no file")
            .to_string();
        assert!(
            missing.contains("JOSTLE_CHROMIUM is \"/none\""),
            "{missing}"
        );
        let none = found(None, OsStr::new(""))
            .expect_err("no Chromium")
            .to_string();
        for part in ["apt install chromium", "JOSTLE_CHROMIUM", "print it"] {
            assert!(none.contains(part), "{part} is missing: {none}");
        }
    }

    /// Printing needs a Chromium; where there is none the test ends early.
    #[test]
    fn a_page_becomes_a_pdf_of_the_paper() {
        let Ok(chromium) = find_chromium() else {
            return;
        };
        let folder = tempfile::tempdir().expect("a folder");
        let page = "<!doctype html><html><head><title>t</title></head><body>text</body></html>";
        for (paper, size) in [(Paper::A4, [595.0, 842.0]), (Paper::Letter, [612.0, 792.0])] {
            let pdf = folder.path().join("page.pdf");
            print_pdf(&chromium, page, &pdf, paper).expect("prints");
            let text = String::from_utf8_lossy(&std::fs::read(&pdf).expect("written")).into_owned();
            let at = text.find("/MediaBox").expect("a page has its size");
            let numbers: Vec<f64> = text[at..at + 60]
                .split(|c: char| !(c.is_ascii_digit() || c == '.'))
                .filter_map(|number| number.parse().ok())
                .collect();
            // Points, rounded up by the program.
            assert!((numbers[2] - size[0]).abs() < 1.5, "{numbers:?}");
            assert!((numbers[3] - size[1]).abs() < 1.5, "{numbers:?}");
        }
    }
}
