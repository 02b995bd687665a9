//! `jostle live` from the outside.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::Stdio;

use crate::common::{command, complained, folder, jostle};

fn answer(address: &str) -> String {
    let rest = address.strip_prefix("http://").unwrap();
    let (host, target) = rest.split_at(rest.find('/').unwrap());
    let mut stream = TcpStream::connect(host).unwrap();
    write!(stream, "GET {target} HTTP/1.1\r\nHost: {host}\r\n\r\n").unwrap();
    let mut text = String::new();
    stream.read_to_string(&mut text).unwrap();
    text
}

#[cfg(unix)]
#[test]
fn it_prints_its_address_and_answers_there_until_ctrl_c() {
    let folder = folder();
    let mut program = command(folder.path(), &["live", "--no-open"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(program.stdout.take().unwrap())
        .read_line(&mut line)
        .unwrap();
    let address = line.trim_end();
    assert!(address.starts_with("http://127.0.0.1:"), "{line:?}");
    let page = answer(address);
    assert!(
        page.starts_with("HTTP/1.1 200") && page.contains("jostle live"),
        "{page:.200}"
    );
    let bare = &address[..address.find('?').unwrap()];
    assert!(answer(bare).starts_with("HTTP/1.1 403"));
    let port = bare.trim_end_matches('/').rsplit(':').next().unwrap();
    let taken = jostle(folder.path(), &["live", "--no-open", "--port", port]);
    assert_eq!(taken.status.code(), Some(2));
    assert!(
        complained(&taken).contains("--port 0 takes any free port"),
        "{}",
        complained(&taken)
    );
    let kill = std::process::Command::new("kill")
        .args(["-INT", &program.id().to_string()])
        .status()
        .unwrap();
    assert!(kill.success());
    assert!(
        program.wait().unwrap().success(),
        "Ctrl-C is the way to end it"
    );
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        0,
        "it wrote a file"
    );
}

#[test]
fn a_page_without_a_server_needs_its_engine() {
    let folder = folder();
    let page = folder.path().join("page.html");
    let output = jostle(folder.path(), &["live", "--export", "page.html"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("packaging/wasm"),
        "{}",
        complained(&output)
    );
    std::fs::write(folder.path().join("engine"), b"not a module").unwrap();
    let arguments = ["live", "--export", "page.html", "--module", "engine"];
    let output = jostle(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("packed with gzip"),
        "{}",
        complained(&output)
    );
    assert!(!page.exists(), "it wrote a page");
    // Whether the engine works is seen in the page.
    std::fs::write(folder.path().join("engine"), [0x1f, 0x8b]).unwrap();
    for _ in 0..2 {
        let output = jostle(folder.path(), &arguments);
        assert!(output.status.success(), "{}", complained(&output));
    }
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(text.contains("jostle live</title>") && text.contains("id=\"engine\""));
    // A file of someone else stays.
    std::fs::write(&page, "mine").unwrap();
    let output = jostle(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&page).unwrap(), "mine");
}

#[test]
fn a_file_that_cannot_be_read_is_said() {
    let folder = folder();
    let output = jostle(folder.path(), &["live", "--no-open", "missing.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("missing.toml"),
        "{}",
        complained(&output)
    );
    std::fs::write(folder.path().join("broken.toml"), "title = ").unwrap();
    let output = jostle(folder.path(), &["live", "--no-open", "broken.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        complained(&output).contains("broken.toml:1"),
        "{}",
        complained(&output)
    );
}
