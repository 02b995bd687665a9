//! Heads of requests: read within limits, and refused unless they come from the page itself.

use std::io::{Read, Write};
use std::time::{Duration, Instant};

/// Most bytes of the head of a request.
pub(crate) const MOST_HEAD: usize = 16 << 10;
/// Most header lines.
const MOST_HEADERS: usize = 64;
/// Most time for a head.
const PATIENCE: Duration = Duration::from_secs(10);

/// A request that may be answered.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// The page.
    Page,
    /// The WebSocket, with the key of its handshake.
    Socket { key: String },
}

/// Why a request is refused: status, reason phrase, and a sentence for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Refusal(
    pub(crate) u16,
    pub(crate) &'static str,
    pub(crate) &'static str,
);

const TOO_LARGE: Refusal = Refusal(
    431,
    "Request Header Fields Too Large",
    "The request is too large.",
);
const SLOW: Refusal = Refusal(
    408,
    "Request Timeout",
    "The request did not arrive in time.",
);
const MALFORMED: Refusal = Refusal(400, "Bad Request", "This is no HTTP request.");
const HOST: Refusal = Refusal(
    421,
    "Misdirected Request",
    "This server answers at 127.0.0.1 and localhost only.",
);
const ORIGIN: Refusal = Refusal(403, "Forbidden", "Another site may not use this server.");
const TOKEN: Refusal = Refusal(
    403,
    "Forbidden",
    "This page needs the whole address that jostle live printed, with its token.",
);
const METHOD: Refusal = Refusal(405, "Method Not Allowed", "This server answers GET only.");
const BODY: Refusal = Refusal(
    413,
    "Content Too Large",
    "This server takes no request with a body.",
);
const NOT_FOUND: Refusal = Refusal(404, "Not Found", "There is nothing here.");
const NO_UPGRADE: Refusal = Refusal(
    426,
    "Upgrade Required",
    "This address speaks WebSocket only.",
);

/// Reads the head of a request, and the bytes received after it.
///
/// # Errors
/// [`Refusal`] when it is too large, too slow, or cut off.
pub(crate) fn read_head(stream: &mut impl Read) -> Result<Vec<u8>, Refusal> {
    let mut bytes = Vec::new();
    let mut part = [0; 2048];
    let begun = Instant::now();
    while !bytes.windows(4).any(|end| end == b"\r\n\r\n") {
        if bytes.len() >= MOST_HEAD {
            return Err(TOO_LARGE);
        }
        if begun.elapsed() > PATIENCE {
            return Err(SLOW);
        }
        match stream.read(&mut part) {
            Ok(0) => return Err(MALFORMED),
            Ok(count) => bytes.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(_) => return Err(SLOW),
        }
    }
    Ok(bytes)
}

/// What a request wants, if it may have it.
///
/// # Errors
/// [`Refusal`].
pub(crate) fn judge(head: &[u8], port: u16, token: &str) -> Result<Wanted, Refusal> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    match request.parse(head) {
        Ok(httparse::Status::Complete(_)) => {}
        Ok(httparse::Status::Partial) => return Err(MALFORMED),
        Err(httparse::Error::TooManyHeaders) => return Err(TOO_LARGE),
        Err(_) => return Err(MALFORMED),
    }
    let all = |name: &str| -> Vec<&str> {
        let named = request
            .headers
            .iter()
            .filter(|header| header.name.eq_ignore_ascii_case(name));
        named
            .map(|header| std::str::from_utf8(header.value).unwrap_or(""))
            .collect()
    };
    // A page of another name that resolves to this machine (DNS rebinding) says its own name here.
    let hosts = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    match all("host")[..] {
        [host] if hosts.iter().any(|ours| ours.eq_ignore_ascii_case(host)) => {}
        _ => return Err(HOST),
    }
    let origins = all("origin");
    let ours = |origin: &str| {
        hosts
            .iter()
            .any(|host| origin.eq_ignore_ascii_case(&format!("http://{host}")))
    };
    if !origins.iter().all(|origin| ours(origin)) {
        return Err(ORIGIN);
    }
    if request.method != Some("GET") {
        return Err(METHOD);
    }
    let body = |length: &&str| length.trim() != "0";
    if all("content-length").iter().any(body) || !all("transfer-encoding").is_empty() {
        return Err(BODY);
    }
    let target = request.path.unwrap_or("");
    let (path, query) = target.split_once('?').unwrap_or((target, ""));
    if !matches!(path, "/" | "/socket") {
        return Err(NOT_FOUND);
    }
    let given = query
        .split('&')
        .find_map(|pair| pair.strip_prefix("token="));
    if !given.is_some_and(|given| same(given.as_bytes(), token.as_bytes())) {
        return Err(TOKEN);
    }
    if path == "/" {
        return Ok(Wanted::Page);
    }
    if origins.is_empty() {
        // A browser always says where a socket comes from.
        return Err(ORIGIN);
    }
    let says = |name: &str, word: &str| {
        let values = all(name);
        let mut words = values.iter().flat_map(|value| value.split(','));
        words.any(|value| value.trim().eq_ignore_ascii_case(word))
    };
    let upgrades = says("upgrade", "websocket")
        && says("connection", "upgrade")
        && says("sec-websocket-version", "13");
    match all("sec-websocket-key")[..] {
        [key] if upgrades => Ok(Wanted::Socket {
            key: key.to_owned(),
        }),
        _ => Err(NO_UPGRADE),
    }
}

/// Whether two texts are the same, in a time that does not tell where they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .fold(0, |difference, (a, b)| difference | (a ^ b))
            == 0
}

/// Headers of every answer: nothing is kept, framed, guessed or passed on.
const HEADERS: &str = "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nX-Frame-Options: DENY\r\nCross-Origin-Opener-Policy: same-origin\r\nCross-Origin-Resource-Policy: same-origin\r\nConnection: close\r\n";

/// Sends a page.
pub(crate) fn send_page(stream: &mut impl Write, page: &str, policy: &str) -> std::io::Result<()> {
    let head = format!(
        "HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\nContent-Security-Policy: {policy}\r\n{HEADERS}\r\n",
        page.len()
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(page.as_bytes())?;
    stream.flush()
}

/// Sends a refusal.
pub(crate) fn refuse(
    stream: &mut impl Write,
    Refusal(status, phrase, why): Refusal,
) -> std::io::Result<()> {
    let text = format!(
        "HTTP/1.1 {status} {phrase}\r\nContent-Type: text/plain; charset=utf-8\r\nContent-Length: {}\r\n{HEADERS}\r\n{why}\n",
        why.len() + 1
    );
    stream.write_all(text.as_bytes())?;
    stream.flush()
}

/// Answers the handshake of a WebSocket.
pub(crate) fn upgrade(stream: &mut impl Write, key: &str) -> std::io::Result<()> {
    let accept = tungstenite::handshake::derive_accept_key(key.as_bytes());
    let text = format!(
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: {accept}\r\n\r\n"
    );
    stream.write_all(text.as_bytes())?;
    stream.flush()
}
