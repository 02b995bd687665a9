//! The server: one page and one WebSocket on the loopback address.

use std::collections::VecDeque;
use std::io::{Read, Write};
use std::net::{Ipv4Addr, Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::engine::Engine;
use crate::http::{self, Refusal, Wanted};
use crate::{page, session};

/// Most connections at a time.
const MOST_CONNECTIONS: usize = 32;
/// Most time that a read or a write of a request may wait.
const PATIENCE: Duration = Duration::from_secs(5);
/// Most time for the rest of a request that was refused.
const LINGER: Duration = Duration::from_secs(1);
/// Bytes of randomness in the token.
const TOKEN_BYTES: usize = 24;

const BUSY: Refusal = Refusal(503, "Service Unavailable", "Too many connections.");

/// Why there is no server.
#[derive(Debug, thiserror::Error)]
pub enum LiveError {
    /// The port is taken, or not allowed.
    #[error("cannot listen at 127.0.0.1:{port}: {error}; --port 0 takes any free port")]
    Listen {
        /// Port as asked for.
        port: u16,
        /// What the system says.
        error: std::io::Error,
    },
    /// The system has no random numbers.
    #[error("the system gives no random numbers for a token: {0}")]
    Token(String),
}

/// A running server; dropped, it ends.
pub struct Server {
    shared: Arc<Shared>,
    acceptor: Option<JoinHandle<()>>,
}

/// What all connections share.
pub(crate) struct Shared {
    pub(crate) engine: Engine,
    port: u16,
    token: String,
    connections: AtomicUsize,
    /// Connections that are no open page yet, the oldest first, with their numbers.
    arriving: Mutex<VecDeque<(u64, TcpStream)>>,
    ending: AtomicBool,
    pages: Mutex<Pages>,
    changed: Condvar,
}

/// Pages that are open.
struct Pages {
    open: usize,
    /// When the last one went.
    gone: Option<Instant>,
}

impl Server {
    /// Starts to serve a model; port 0 takes a free one.
    ///
    /// # Errors
    /// [`LiveError`].
    pub fn start(engine: Engine, port: u16) -> Result<Self, LiveError> {
        let refused = |error| LiveError::Listen { port, error };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        let port = listener.local_addr().map_err(refused)?.port();
        let mut random = [0; TOKEN_BYTES];
        getrandom::fill(&mut random).map_err(|error| LiveError::Token(error.to_string()))?;
        let shared = Arc::new(Shared {
            engine,
            port,
            token: random.iter().map(|byte| format!("{byte:02x}")).collect(),
            connections: AtomicUsize::new(0),
            arriving: Mutex::default(),
            ending: AtomicBool::new(false),
            pages: Mutex::new(Pages {
                open: 0,
                gone: None,
            }),
            changed: Condvar::new(),
        });
        let accepting = Arc::clone(&shared);
        let acceptor = std::thread::spawn(move || accept(&listener, &accepting));
        Ok(Self {
            shared,
            acceptor: Some(acceptor),
        })
    }

    /// Where the page is, its token included.
    #[must_use]
    pub fn address(&self) -> String {
        format!(
            "http://127.0.0.1:{}/?token={}",
            self.shared.port, self.shared.token
        )
    }

    /// Waits until `stop` says so, asked several times a second, or until a page was open and none has been for
    /// `patience`.
    pub fn wait(&self, stop: &dyn Fn() -> bool, patience: Duration) {
        const EVERY: Duration = Duration::from_millis(200);
        let mut pages = self
            .shared
            .pages
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        while !stop() && pages.gone.is_none_or(|gone| gone.elapsed() <= patience) {
            let waited = self.shared.changed.wait_timeout(pages, EVERY);
            pages = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.shared.ending.store(true, Ordering::Relaxed);
        // A last connection wakes the acceptor.
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, self.shared.port));
        let woken = TcpStream::connect_timeout(&address, PATIENCE).is_ok();
        if let Some(acceptor) = self.acceptor.take().filter(|_| woken) {
            let _ = acceptor.join();
        }
    }
}

impl Shared {
    pub(crate) fn is_ending(&self) -> bool {
        self.ending.load(Ordering::Relaxed)
    }

    fn arriving(&self) -> MutexGuard<'_, VecDeque<(u64, TcpStream)>> {
        self.arriving.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the oldest connection that is no open page, if there is one, in favour of a new one.
    fn make_room(&self) -> bool {
        let oldest = self.arriving().pop_front();
        oldest.is_some_and(|(_, stream)| stream.shutdown(Shutdown::Both).is_ok())
    }
}

/// A connection, counted while it is there, however it ends.
struct Connection {
    shared: Arc<Shared>,
    number: u64,
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.no_longer_arriving();
        self.shared.connections.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Connection {
    fn no_longer_arriving(&self) {
        self.shared
            .arriving()
            .retain(|(number, _)| *number != self.number);
    }
}

/// An open page, counted while it is there, however it ends.
struct OpenPage<'a>(&'a Shared);

impl<'a> OpenPage<'a> {
    fn new(shared: &'a Shared) -> Self {
        let page = Self(shared);
        page.count(|open| open + 1);
        page
    }

    fn count(&self, change: impl Fn(usize) -> usize) {
        let mut pages = self.0.pages.lock().unwrap_or_else(PoisonError::into_inner);
        pages.open = change(pages.open);
        pages.gone = (pages.open == 0).then(Instant::now);
        self.0.changed.notify_all();
    }
}

impl Drop for OpenPage<'_> {
    fn drop(&mut self) {
        self.count(|open| open.saturating_sub(1));
    }
}

fn accept(listener: &TcpListener, shared: &Arc<Shared>) {
    for (number, stream) in (0..).zip(listener.incoming()) {
        if shared.is_ending() {
            return;
        }
        let Ok(mut stream) = stream else {
            // Out of handles, say: give others time to end.
            std::thread::sleep(Duration::from_millis(50));
            continue;
        };
        let timeouts = [
            stream.set_read_timeout(Some(PATIENCE)),
            stream.set_write_timeout(Some(PATIENCE)),
            stream.set_nodelay(true),
        ];
        if timeouts.iter().any(Result::is_err) {
            continue;
        }
        if shared.connections.load(Ordering::Relaxed) >= MOST_CONNECTIONS && !shared.make_room() {
            // A few bytes, which always find room in the buffers of a new connection.
            let _ = http::refuse(&mut stream, BUSY);
            continue;
        }
        shared.connections.fetch_add(1, Ordering::Relaxed);
        let connection = Connection {
            shared: Arc::clone(shared),
            number,
        };
        if let Ok(copy) = stream.try_clone() {
            shared.arriving().push_back((number, copy));
        }
        // Without a thread, say because there are too many, the connection ends here.
        let _ = std::thread::Builder::new().spawn(move || {
            // A connection that fails is gone; the page connects again.
            let _ = answer(&mut stream, &connection);
        });
    }
}

fn answer(stream: &mut TcpStream, connection: &Connection) -> std::io::Result<()> {
    let shared = &*connection.shared;
    let judged =
        http::read_head(stream).and_then(|head| http::judge(&head, shared.port, &shared.token));
    match judged {
        Ok(Wanted::Page) => {
            let page = || page::page(shared.engine.name(), shared.port, &shared.token);
            let (page, policy) = shared.engine.in_its_units(page);
            http::send_page(stream, &page, &policy)?;
        }
        Ok(Wanted::Socket { key }) => {
            http::upgrade(stream, &key)?;
            connection.no_longer_arriving();
            let _page = OpenPage::new(shared);
            return session::serve(stream, &shared.engine, &|| shared.is_ending());
        }
        Err(refusal) => {
            http::refuse(stream, refusal)?;
            // What still comes is read and dropped, so that the answer arrives before the connection is reset.
            stream.shutdown(Shutdown::Write)?;
            stream.set_read_timeout(Some(Duration::from_millis(200)))?;
            let (begun, mut rest) = (Instant::now(), [0; 4096]);
            while begun.elapsed() < LINGER && stream.read(&mut rest).is_ok_and(|count| count > 0) {}
        }
    }
    stream.flush()
}
