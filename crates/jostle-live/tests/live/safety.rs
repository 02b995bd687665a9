//! What the server refuses, and that it outlives it.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::time::Duration;

use jostle_live::{Engine, Server};

pub(crate) struct Live {
    server: Server,
    port: u16,
    token: String,
}

pub(crate) fn live() -> Live {
    let server = Server::start(Engine::open(Path::new("paper")).unwrap(), 0).unwrap();
    let address = server.address();
    let rest = address.strip_prefix("http://127.0.0.1:").unwrap();
    let (port, token) = rest.split_once("/?token=").unwrap();
    Live {
        port: port.parse().unwrap(),
        token: token.to_owned(),
        server,
    }
}

impl Live {
    fn send(&self, bytes: &[u8]) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(10)))
            .unwrap();
        // The server may answer, and close, before all is sent.
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    fn get(&self, target: &str, host: &str, more: &str) -> String {
        self.send(format!("GET {target} HTTP/1.1\r\nHost: {host}\r\n{more}\r\n").as_bytes())
    }

    fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub(crate) fn page(&self) -> String {
        self.get(&format!("/?token={}", self.token), &self.host(), "")
    }

    fn socket(&self, origin: &str) -> String {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(5)))
            .unwrap();
        let (token, host) = (&self.token, self.host());
        let request = format!(
            "GET /socket?token={token} HTTP/1.1\r\nHost: {host}\r\n{origin}Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        );
        stream.write_all(request.as_bytes()).unwrap();
        let mut start = [0; 512];
        let count = stream.read(&mut start).unwrap();
        String::from_utf8_lossy(&start[..count]).into_owned()
    }
}

pub(crate) fn status(answer: &str) -> u16 {
    let line = answer.lines().next().unwrap_or("");
    line.split(' ')
        .nth(1)
        .and_then(|code| code.parse().ok())
        .unwrap_or(0)
}

#[test]
fn the_page_is_served_with_its_token_only() {
    let live = live();
    let page = live.page();
    assert_eq!(status(&page), 200, "{page:.300}");
    for header in [
        "Cache-Control: no-store",
        "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer",
        "default-src 'none'",
    ] {
        assert!(page.contains(header), "no {header}");
    }
    assert_eq!(live.token.len(), 48);
    let wrong = "0".repeat(48);
    for target in [
        "/".to_owned(),
        "/?token=".to_owned(),
        format!("/?token={wrong}"),
        format!("/?token={}0", live.token),
        format!("/?token={}", &live.token[1..]),
        "/socket".to_owned(),
    ] {
        let answer = live.get(&target, &live.host(), "");
        assert_eq!(status(&answer), 403, "{target}: {answer}");
        assert!(!answer.contains(&live.token), "the token leaks");
    }
}

#[test]
fn two_servers_have_two_tokens() {
    assert_ne!(live().token, live().token);
}

#[test]
fn other_names_of_this_machine_are_refused() {
    let live = live();
    let target = format!("/?token={}", live.token);
    for host in [
        "attacker.example".to_owned(),
        format!("attacker.example:{}", live.port),
        "127.0.0.1".to_owned(),
        format!("127.0.0.1.attacker.example:{}", live.port),
        format!("0.0.0.0:{}", live.port),
    ] {
        assert_eq!(status(&live.get(&target, &host, "")), 421, "{host}");
    }
    let twice = "Host: attacker.example\r\n";
    assert_eq!(status(&live.get(&target, &live.host(), twice)), 421);
    assert_eq!(
        status(&live.send(format!("GET {target} HTTP/1.1\r\n\r\n").as_bytes())),
        421
    );
    let named = format!("localhost:{}", live.port);
    assert_eq!(status(&live.get(&target, &named, "")), 200);
}

#[test]
fn other_sites_are_refused() {
    let live = live();
    let target = format!("/?token={}", live.token);
    for origin in [
        "https://attacker.example",
        "null",
        "http://127.0.0.1",
        "file://",
        "http://127.0.0.1:1",
    ] {
        let more = format!("Origin: {origin}\r\n");
        assert_eq!(
            status(&live.get(&target, &live.host(), &more)),
            403,
            "{origin}"
        );
        assert_eq!(status(&live.socket(&more)), 403, "socket from {origin}");
    }
    assert_eq!(status(&live.socket("")), 403, "a socket from nowhere");
    let text = format!("Origin: http://127.0.0.1:{}\r\n", live.port);
    let answer = live.socket(&text);
    assert_eq!(status(&answer), 101, "{answer}");
    // The example of RFC 6455, section 1.3.
    assert!(answer.contains("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), "{answer}");
}

#[test]
fn no_path_leads_to_a_file() {
    let live = live();
    let query = format!("?token={}", live.token);
    for path in [
        "/../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "//etc/passwd",
        "/index.html",
        "/./",
        "/socket/..",
        "/?token=/../x",
        "\\..\\x",
        "*",
    ] {
        let answer = live.get(&format!("{path}{query}"), &live.host(), "");
        assert!(
            matches!(status(&answer), 400 | 403 | 404),
            "{path}: {answer}"
        );
        assert!(!answer.contains("root:"), "{path}");
    }
}

#[test]
fn large_slow_and_strange_requests_are_refused() {
    let live = live();
    let (target, host) = (format!("/?token={}", live.token), live.host());
    let long = format!("X-Long: {}\r\n", "x".repeat(40_000));
    assert_eq!(status(&live.get(&target, &host, &long)), 431);
    assert_eq!(
        status(&live.get(&format!("/{}", "x".repeat(40_000)), &host, "")),
        431
    );
    let many: String = (0..200).map(|i| format!("X-{i}: 1\r\n")).collect();
    assert_eq!(status(&live.get(&target, &host, &many)), 431);
    assert_eq!(
        status(&live.get(&target, &host, "Content-Length: 5\r\n")),
        413
    );
    assert_eq!(
        status(&live.get(&target, &host, "Transfer-Encoding: chunked\r\n")),
        413
    );
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "TRACE"] {
        let request = format!("{method} {target} HTTP/1.1\r\nHost: {host}\r\n\r\n");
        assert_eq!(status(&live.send(request.as_bytes())), 405, "{method}");
    }
    for bytes in [
        &b"\0\0\0\0\r\n\r\n"[..],
        b"hello\r\n\r\n",
        b"GET\r\n\r\n",
        b"\x16\x03\x01\x02\x00\r\n\r\n",
    ] {
        assert_eq!(status(&live.send(bytes)), 400, "{bytes:?}");
    }
    assert_eq!(
        status(&live.get(
            &format!("/socket?token={}", live.token),
            &host,
            &format!("Origin: http://{host}\r\n")
        )),
        426
    );
    assert_eq!(status(&live.page()), 200, "the server is gone");
}

/// Connects as the page does, and reads the first message.
pub(crate) fn connect(live: &Live) -> tungstenite::WebSocket<TcpStream> {
    let address = live
        .server
        .address()
        .replace("http://", "ws://")
        .replace("/?", "/socket?");
    let mut request = tungstenite::client::IntoClientRequest::into_client_request(address).unwrap();
    let origin = format!("http://{}", live.host());
    request
        .headers_mut()
        .insert("Origin", origin.parse().unwrap());
    let stream = TcpStream::connect(("127.0.0.1", live.port)).unwrap();
    stream
        .set_read_timeout(Some(Duration::from_secs(30)))
        .unwrap();
    let (mut socket, _) = tungstenite::client(request, stream).unwrap();
    assert!(
        socket
            .read()
            .unwrap()
            .to_text()
            .unwrap()
            .contains("\"op\":\"hello\"")
    );
    socket
}

/// The message that asks for a run with a gap of this width.
fn with_gap(id: usize, millimetres: f64) -> tungstenite::Message {
    let text = serde_json::to_string(jostle_io::model_text("paper").unwrap()).unwrap();
    tungstenite::Message::text(format!(
        "{{\"op\":\"run\",\"id\":{id},\"text\":{text},\"edits\":[[\"gap[0].width\",\"{millimetres} mm\"]]}}"
    ))
}

/// The two JSON texts of a frame.
fn frame(message: &tungstenite::Message) -> serde_json::Value {
    let tungstenite::Message::Binary(bytes) = message else {
        panic!("no frame: {message:?}");
    };
    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
    assert_eq!((bytes.len() - 4 - length) % 4, 0);
    serde_json::from_slice(&bytes[4..4 + length]).unwrap()
}

#[test]
fn a_frame_has_the_numbers_of_a_run() {
    let live = live();
    let mut socket = connect(&live);
    socket.send(with_gap(7, 100.0)).unwrap();
    let mut message = socket.read().unwrap();
    // On a busy machine the run says first how far it is.
    while message.is_text() {
        message = socket.read().unwrap();
    }
    let frame = frame(&message);
    assert_eq!(frame[0]["id"], 7);
    let numbers = frame[0]["numbers"].as_array().unwrap();
    let force = numbers
        .iter()
        .find(|number| number["name"] == "Peak force")
        .unwrap();
    // The built-in example, as in the documentation of the program: 1282.98 kN.
    assert!(
        (force["value"].as_f64().unwrap() - 1282.98).abs() < 0.01,
        "{force}"
    );
    assert!(
        frame[0]["headline"]
            .as_str()
            .unwrap()
            .contains("one impact")
    );
}

#[test]
fn a_newer_request_takes_the_place_of_the_one_that_waits() {
    let live = live();
    let mut socket = connect(&live);
    for id in 1..=20 {
        socket.send(with_gap(id, 40.0 + id as f64)).unwrap();
    }
    let mut answers = 0;
    loop {
        let message = socket.read().unwrap();
        answers += 1;
        if message.is_binary() && frame(&message)[0]["id"] == 20 {
            break;
        }
    }
    assert!(answers < 20, "every stale request was run to its end");
}

#[test]
fn it_ends_once_the_page_has_been_gone_for_a_while() {
    let live = live();
    let patience = Duration::from_millis(300);
    let asked = std::cell::Cell::new(0);
    let few = || {
        asked.set(asked.get() + 1);
        asked.get() > 5
    };
    // Nobody has come yet: only the stop ends it.
    live.server.wait(&few, patience);
    assert!(asked.get() > 5);
    let socket = connect(&live);
    drop(socket);
    let begun = std::time::Instant::now();
    live.server
        .wait(&|| begun.elapsed() > Duration::from_secs(20), patience);
    assert!(
        begun.elapsed() < Duration::from_secs(10),
        "it did not notice"
    );
}

#[test]
fn a_curve_comes_whole_and_a_newer_one_replaces_it() {
    let live = live();
    let mut socket = connect(&live);
    let text = serde_json::to_string(jostle_io::model_text("paper").unwrap()).unwrap();
    let curve = |id: usize, points: usize| {
        tungstenite::Message::text(format!(
            "{{\"op\":\"curve\",\"id\":{id},\"text\":{text},\"path\":\"gap[0].width\",\"unit\":\"mm\",\"from\":0,\"to\":150,\"points\":{points}}}"
        ))
    };
    socket.send(curve(1, 2000)).unwrap();
    // Its first points.
    let begun = socket.read().unwrap();
    assert!(begun.to_text().unwrap().contains("\"op\":\"points\""));
    socket.send(curve(2, 12)).unwrap();
    let mut widths = Vec::new();
    let marks = loop {
        let message = socket.read().unwrap();
        let message: serde_json::Value = serde_json::from_str(message.to_text().unwrap()).unwrap();
        if message["id"] == 2 && message["op"] == "points" {
            for point in message["points"].as_array().unwrap() {
                widths.push((
                    point["x"].as_f64().unwrap(),
                    point["y"][0].as_f64().unwrap(),
                ));
            }
        } else if message["op"] == "marks" {
            break message;
        }
    };
    assert_eq!(marks["id"], 2, "the first curve went on");
    widths.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(widths.len(), 12);
    assert_eq!((widths[0].0, widths[11].0), (0.0, 150.0));
    assert!(widths[0].1 > 1000.0 && widths[11].1 == 0.0, "{widths:?}");
    let needed = &marks["marks"][0];
    assert_eq!(needed["needed"], true);
    assert!(
        (needed["width"].as_f64().unwrap() - 0.1365).abs() < 1e-4,
        "{needed}"
    );
    assert!(marks["marks"].as_array().unwrap().len() > 5, "no rules");
}

/// Prints how long 200 gaps take; run with `--ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn time_of_a_curve() {
    let live = live();
    let mut socket = connect(&live);
    let text = serde_json::to_string(jostle_io::model_text("paper").unwrap()).unwrap();
    for id in 1..=3 {
        let begun = std::time::Instant::now();
        socket.send(tungstenite::Message::text(format!("{{\"op\":\"curve\",\"id\":{id},\"text\":{text},\"path\":\"gap[0].width\",\"unit\":\"mm\",\"from\":0,\"to\":150,\"points\":200}}"))).unwrap();
        let mut count = 0;
        while count < 200 {
            let message = socket.read().unwrap();
            let message: serde_json::Value =
                serde_json::from_str(message.to_text().unwrap()).unwrap();
            count += message["points"].as_array().map_or(0, Vec::len);
        }
        println!("200 gaps: {:.2} s", begun.elapsed().as_secs_f64());
    }
}

/// Prints how memory behaves, and fails if it grows after the first tenth of the changes; run with
/// `--ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn memory_stays_while_a_value_changes() {
    let live = live();
    let mut socket = connect(&live);
    let changes: usize = std::env::var("JOSTLE_CHANGES")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(10_000);
    let begun = std::time::Instant::now();
    let mut times = Vec::new();
    let mut memory = Vec::new();
    for id in 1..=changes {
        let sent = std::time::Instant::now();
        socket
            .send(with_gap(id, 20.0 + (id as f64 * 0.618).fract() * 130.0))
            .unwrap();
        while !socket.read().unwrap().is_binary() {}
        times.push(sent.elapsed().as_secs_f64() * 1e3);
        if id % (changes / 10).max(1) == 0 {
            let text = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
            let pages = text
                .split(' ')
                .nth(1)
                .and_then(|pages| pages.parse::<f64>().ok());
            memory.push(pages.unwrap_or(0.0) * 4096e-6);
            times.sort_by(f64::total_cmp);
            let at = |p: f64| times[(p * (times.len() - 1) as f64) as usize];
            println!(
                "{id} changes, {:.0} s: {:.0} MB; answer median {:.1} ms, 95 % {:.1} ms",
                begun.elapsed().as_secs_f64(),
                memory.last().unwrap(),
                at(0.5),
                at(0.95)
            );
            times.clear();
        }
    }
    // A frame has half a megabyte: keeping a hundredth of 9,000 would be seen.
    let grown = memory.last().unwrap() - memory[0];
    assert!(
        grown < 30.0,
        "memory grew by {grown:.0} MB: {memory:.0?} MB"
    );
}

#[test]
fn an_oversized_message_ends_its_connection_only() {
    let live = live();
    let mut socket = connect(&live);
    let _ = socket.send(tungstenite::Message::text("x".repeat(3 << 20)));
    let ended =
        (0..3).any(|_| matches!(socket.read(), Err(_) | Ok(tungstenite::Message::Close(_))));
    assert!(ended, "the message was taken");
    assert_eq!(status(&live.page()), 200, "the server is gone");
}

#[test]
fn a_crowd_of_connections_is_turned_away_and_the_server_stays() {
    let live = live();
    // Open pages do not give way, as connections that say nothing do.
    let pages: Vec<_> = (0..32).map(|_| connect(&live)).collect();
    let becomes = |wanted: u16| {
        (0..500).any(|_| {
            std::thread::sleep(Duration::from_millis(10));
            status(&live.page()) == wanted
        })
    };
    assert!(becomes(503), "nobody is turned away");
    drop(pages);
    assert!(becomes(200), "the server stayed busy");
}

/// Clients that say nothing, or a byte now and then, give way to one that asks, and open pages that do not read what they asked for:
/// none costs another 100 ms.
#[test]
fn silent_and_slow_clients_cost_others_no_time() {
    let live = live();
    let connect_only = || TcpStream::connect(("127.0.0.1", live.port)).unwrap();
    let mut silent: Vec<TcpStream> = (0..100).map(|_| connect_only()).collect();
    // Pages that ask for runs and never read.
    let mut deaf: Vec<_> = (0..3).map(|_| connect(&live)).collect();
    for (id, page) in deaf.iter_mut().enumerate() {
        page.send(with_gap(id, 40.0)).unwrap();
    }
    std::thread::sleep(Duration::from_millis(100));
    // The least of several, because a busy machine delays everybody.
    let mut least = Duration::MAX;
    for _ in 0..20 {
        for slow in &mut silent {
            let _ = slow.write_all(b"G");
        }
        let asked = std::time::Instant::now();
        let page = live.page();
        let waited = asked.elapsed();
        assert_eq!(status(&page), 200, "{page:.300}");
        assert!(waited < Duration::from_millis(2000), "{waited:?}");
        least = least.min(waited);
    }
    assert!(least < Duration::from_millis(100), "{least:?}");
    drop((silent, deaf));
}

/// More records than a curve takes are refused in words, and a request on which a handler fails costs no connection.
#[test]
fn a_curve_over_thousands_of_records_is_refused_and_no_connection_is_lost() {
    let live = live();
    let records = vec!["\"el-centro-1940-ns\""; 1001].join(",");
    let curve = format!(
        "{{\"op\":\"curve\",\"id\":7,\"text\":TEXT,\"edits\":[],\"path\":\"gap[0].width\",\"unit\":\"m\",\"from\":0.01,\"to\":0.1,\"points\":3,\"records\":[{records}]}}"
    );
    let text = serde_json::to_string(jostle_io::model_text("paper").unwrap()).unwrap();
    let curve = curve.replace("TEXT", &text);
    for _ in 0..40 {
        let mut socket = connect(&live);
        socket.send(tungstenite::Message::text(&curve)).unwrap();
        let answer = socket.read().unwrap();
        let answer = answer.to_text().unwrap();
        assert!(answer.contains("\"op\":\"no-curve\""), "{answer:.300}");
        assert!(answer.contains("at most 1000 records"), "{answer:.300}");
    }
    assert_eq!(status(&live.page()), 200);
}
