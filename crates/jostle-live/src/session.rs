//! One open page: its requests, a thread that runs, and a thread that computes curves.

use std::cell::Cell;
use std::io::ErrorKind;
use std::net::TcpStream;
use std::ops::ControlFlow;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use jostle::stepping::Progress;
use jostle_io::ModelTree;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Error, Message, WebSocket};

use crate::curve;
use crate::engine::{Engine, Trouble};
use crate::message::{Curve, Reply, Request, Run};
use crate::server::Shared;
use crate::slot::Slot;

/// Most bytes of a message from the page: a model of that size and what to change.
const MOST_MESSAGE: usize = 2 << 20;
/// A run shows how far it has come after this time, and then as often.
const PROGRESS_EVERY: Duration = Duration::from_millis(150);
/// Points of a curve are sent together so often.
const POINTS_EVERY: Duration = Duration::from_millis(40);

/// What a page wants to have run.
enum Job {
    Frame(Run),
    Report(Run),
}

/// The writing side of a page.
struct Writer(Mutex<WebSocket<TcpStream>>);

impl Writer {
    /// Sends a message. A page that is gone is noticed by the reading side.
    fn send(&self, message: Message) {
        let mut socket = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = socket.send(message);
    }

    fn say(&self, reply: &Reply<'_>) {
        self.send(Message::text(
            serde_json::to_string(reply).unwrap_or_default(),
        ));
    }
}

/// Serves one page until it is gone.
pub(crate) fn serve(stream: &TcpStream, shared: &Shared) -> std::io::Result<()> {
    let config = || {
        WebSocketConfig::default()
            .max_message_size(Some(MOST_MESSAGE))
            .max_frame_size(Some(MOST_MESSAGE))
    };
    // Often enough to notice that the server ends.
    stream.set_read_timeout(Some(Duration::from_millis(300)))?;
    let writing = stream.try_clone()?;
    let mut reader = WebSocket::from_raw_socket(stream.try_clone()?, Role::Server, Some(config()));
    let writer = Writer(Mutex::new(WebSocket::from_raw_socket(
        writing,
        Role::Server,
        Some(config()),
    )));
    let engine = &shared.engine;
    let (runs, curves) = (Slot::new(), Slot::new());
    std::thread::scope(|scope| {
        scope.spawn(|| run_jobs(engine, &runs, &writer));
        scope.spawn(|| run_curves(engine, &curves, &writer));
        writer.say(&Reply::Hello {
            name: engine.name(),
            text: engine.text(),
            records: engine.records(),
        });
        while !shared.is_ending() {
            match reader.read() {
                Ok(Message::Text(text)) => match serde_json::from_str::<Request>(&text) {
                    Ok(Request::Run(run)) => runs.put(Job::Frame(run)),
                    Ok(Request::Report(run)) => runs.put(Job::Report(run)),
                    Ok(Request::Stop) => runs.cancel(),
                    Ok(Request::Curve(curve)) => curves.put(curve),
                    Ok(Request::StopCurve) => curves.cancel(),
                    Ok(Request::Study(curve)) => send_study(engine, &curve, &writer),
                    // Only a page of another version says something else.
                    Err(_) => break,
                },
                Ok(Message::Close(_)) => break,
                Ok(_) => {}
                Err(Error::Io(error))
                    if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
                Err(_) => break,
            }
        }
        runs.close();
        curves.close();
    });
    stream.shutdown(std::net::Shutdown::Both)
}

fn run_jobs(engine: &Engine, slot: &Slot<Job>, writer: &Writer) {
    while let Some((job, number)) = slot.take() {
        let (Job::Frame(run) | Job::Report(run)) = &job;
        let begun = Instant::now();
        let shown = Mutex::new(Cell::new(begun));
        let watch = |Progress { time, duration }: Progress| {
            if slot.is_stale(number) {
                return ControlFlow::Break(());
            }
            let shown = shown.lock().unwrap_or_else(PoisonError::into_inner);
            if shown.get().elapsed() > PROGRESS_EVERY {
                shown.set(Instant::now());
                let share = if duration > 0.0 { time / duration } else { 0.0 };
                writer.say(&Reply::Progress { id: run.id, share });
            }
            ControlFlow::Continue(())
        };
        let tree = match engine.tree(run) {
            Ok(tree) => tree,
            Err(trouble) => {
                say_trouble(run.id, trouble, None, writer);
                continue;
            }
        };
        let done = match &job {
            Job::Frame(run) => engine
                .frame(run.id, &tree, run.record, &watch)
                .map(|bytes| writer.send(Message::binary(bytes))),
            Job::Report(run) => engine.report(&tree, run.record, &watch).map(|text| {
                let (id, kind) = (run.id, "text/html");
                writer.say(&Reply::File {
                    id,
                    name: "report.html".into(),
                    kind,
                    text,
                });
            }),
        };
        if let Err(trouble) = done {
            say_trouble(run.id, trouble, Some(&tree), writer);
        }
    }
}

fn say_trouble(id: u64, trouble: Trouble, tree: Option<&ModelTree>, writer: &Writer) {
    writer.say(&match trouble {
        Trouble::Stopped => Reply::Stopped { id },
        Trouble::Faults(faults) => Reply::Faults {
            id,
            text: tree.map(|tree| tree.text().to_owned()),
            knobs: tree.map(ModelTree::knobs),
            faults,
        },
    });
}

fn run_curves(engine: &Engine, slot: &Slot<Curve>, writer: &Writer) {
    while let Some((curve, number)) = slot.take() {
        let id = curve.run.id;
        let stop = || slot.is_stale(number);
        let tree = match engine.tree(&curve.run) {
            Ok(tree) => tree,
            Err(Trouble::Faults(faults)) => {
                let problem = faults
                    .first()
                    .map_or_else(String::new, |fault| fault.problem.clone());
                writer.say(&Reply::NoCurve { id, problem });
                continue;
            }
            Err(Trouble::Stopped) => continue,
        };
        let of = curve::count(&curve);
        let (send, points) = mpsc::channel();
        std::thread::scope(|scope| {
            let computing = scope.spawn(|| {
                curve::points(engine, &tree, &curve, &send, &stop);
                drop(send);
            });
            let mut waiting = Vec::new();
            let mut sent = Instant::now();
            loop {
                let point = points.recv_timeout(POINTS_EVERY);
                let last = matches!(point, Err(RecvTimeoutError::Disconnected));
                waiting.extend(point);
                let due = last || sent.elapsed() >= POINTS_EVERY;
                if due && !waiting.is_empty() && !stop() {
                    let points = std::mem::take(&mut waiting);
                    writer.say(&Reply::Points { id, points, of });
                    sent = Instant::now();
                }
                if last {
                    break;
                }
            }
            // Its panic, if any, was printed; the page sees a curve with holes.
            let _ = computing.join();
        });
        if !stop() && curve.path.starts_with("gap") && curve.path.ends_with(".width") {
            match curve::marks(engine, &tree, &curve, &stop) {
                Ok(marks) if !stop() => writer.say(&Reply::Marks { id, marks }),
                Ok(_) => {}
                Err(problem) => writer.say(&Reply::NoCurve { id, problem }),
            }
        }
    }
}

/// The study that computes a curve in full, for the model file that is saved beside it.
fn send_study(engine: &Engine, curve: &Curve, writer: &Writer) {
    let name = std::path::Path::new(engine.name());
    let stem = name
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let quoted = |text: &str| serde_json::to_string(text).unwrap_or_default();
    let value = |x: f64| match curve::put(curve, x) {
        jostle_io::TreeValue::Text(text) => quoted(&text),
        jostle_io::TreeValue::Number(number) => format!("{number:?}"),
        other => other.to_string(),
    };
    let mut text = format!(
        "# Results over {path}, as jostle live shows them.\n# jostle study study.toml, with the model file beside it\ntitle = {title}\nbase = {base}\n\n[[vary]]\npath = {quoted_path}\nrange = {{ from = {from}, to = {to}, count = {points} }}\n",
        path = curve.path,
        title = quoted(&format!("{stem}: {}", curve.path)),
        base = quoted(&format!("{stem}.toml")),
        quoted_path = quoted(&curve.path),
        from = value(curve.from),
        to = value(curve.to),
        points = curve.points,
    );
    if !curve.records.is_empty() {
        let records: Vec<String> = curve.records.iter().map(|name| quoted(name)).collect();
        text += &format!(
            "\n[[vary]]\npath = \"motion.record\"\nvalues = [{}]\n",
            records.join(", ")
        );
    }
    writer.say(&Reply::File {
        id: curve.run.id,
        name: "study.toml".into(),
        kind: "text/plain",
        text,
    });
}
