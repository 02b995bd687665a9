//! One open page: its requests, a thread that runs, and a thread that computes curves.

use std::any::Any;
use std::cell::Cell;
use std::io::ErrorKind;
use std::net::{Shutdown, TcpStream};
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use jostle::stepping::Progress;
use tungstenite::protocol::{Role, WebSocketConfig};
use tungstenite::{Error, Message, WebSocket};

use crate::answer::{self, Answer};
use crate::curve::{self, Cases};
use crate::engine::{Engine, Trouble};
use crate::message::{Curve, Reply, Request, Run};
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
    /// Sends a message. A page that is gone, or does not read, is noticed by the reading side.
    fn send(&self, answer: Answer) {
        let message = match answer {
            Answer::Text(text) => Message::text(text),
            Answer::Binary(bytes) => Message::binary(bytes),
        };
        let mut socket = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if socket.send(message).is_err() {
            // What could not be sent would be kept and tried again with every message.
            let _ = socket.get_ref().shutdown(Shutdown::Both);
        }
    }

    fn say(&self, reply: &Reply<'_>) {
        self.send(answer::say(reply));
    }
}

/// Serves one page until it is gone, or until `ending` says that the server ends.
pub(crate) fn serve(
    stream: &TcpStream,
    engine: &Engine,
    ending: &dyn Fn() -> bool,
) -> std::io::Result<()> {
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
    let (runs, curves) = (Slot::new(), Slot::new());
    std::thread::scope(|scope| {
        scope.spawn(|| run_jobs(engine, &runs, &writer));
        scope.spawn(|| run_curves(engine, &curves, &writer));
        writer.send(answer::hello(engine));
        while !ending() {
            match reader.read() {
                Ok(Message::Text(text)) => match serde_json::from_str::<Request>(&text) {
                    Ok(Request::Run(run)) => runs.put(Job::Frame(run)),
                    Ok(Request::Report(run)) => runs.put(Job::Report(run)),
                    Ok(Request::Stop) => runs.cancel(),
                    Ok(Request::Curve(curve)) => curves.put(curve),
                    Ok(Request::StopCurve) => curves.cancel(),
                    Ok(Request::Study(curve)) => {
                        let study =
                            catch_unwind(AssertUnwindSafe(|| answer::study(engine, &curve)));
                        let failed = |panic: Box<_>| failed(curve.run.id, &*panic);
                        writer.send(study.unwrap_or_else(failed));
                    }
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
    stream.shutdown(Shutdown::Both)
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
        let answered = catch_unwind(AssertUnwindSafe(|| match &job {
            Job::Frame(run) => answer::frame(engine, run, &watch),
            Job::Report(run) => (answer::report(engine, run, &watch), None),
        }));
        let failed = |panic: Box<_>| (failed(run.id, &*panic), None);
        let (reply, solved) = answered.unwrap_or_else(failed);
        writer.send(reply);
        // The page is drawn while this is computed; a newer change stops it.
        let going_on = |_| match slot.is_stale(number) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let later = solved
            .filter(|_| !slot.is_stale(number))
            .and_then(|solved| {
                let accuracy = || answer::accuracy(run.id, solved, &going_on);
                catch_unwind(AssertUnwindSafe(accuracy)).ok().flatten()
            });
        if let Some(later) = later.filter(|_| !slot.is_stale(number)) {
            writer.send(later);
        }
    }
}

fn run_curves(engine: &Engine, slot: &Slot<Curve>, writer: &Writer) {
    while let Some((curve, number)) = slot.take() {
        let id = curve.run.id;
        let stop = || slot.is_stale(number);
        let run = || run_curve(engine, curve, &stop, writer);
        if let Err(panic) = catch_unwind(AssertUnwindSafe(run)) {
            let problem = failure(&*panic);
            writer.say(&Reply::NoCurve { id, problem });
        }
    }
}

fn run_curve(engine: &Engine, curve: Curve, stop: &(dyn Fn() -> bool + Sync), writer: &Writer) {
    let id = curve.run.id;
    let tree = match engine.tree(&curve.run) {
        Ok(tree) => tree,
        Err(trouble) => {
            if let Some(answer) = answer::no_curve(id, trouble) {
                writer.send(answer);
            }
            return;
        }
    };
    let cases = match Cases::new(tree, curve) {
        Ok(cases) => cases,
        Err(problem) => return writer.say(&Reply::NoCurve { id, problem }),
    };
    let of = cases.count();
    let (send, points) = mpsc::channel();
    std::thread::scope(|scope| {
        let computing = scope.spawn(|| {
            curve::points(engine, &cases, &send, stop);
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
        let _ = computing.join();
    });
    if !stop()
        && let Some(answer) = answer::marks(engine, &cases, stop)
        && !stop()
    {
        writer.send(answer);
    }
}

/// The text of a panic in a request.
fn failure(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!(
        "jostle failed on this, which is an error of the program: {}",
        text.unwrap_or("no reason given")
    )
}

/// What is said of a run on which the program failed.
fn failed(id: u64, panic: &(dyn Any + Send)) -> Answer {
    answer::no_frame(
        id,
        Trouble::Faults(crate::message::fault("", failure(panic))),
        None,
    )
}

#[cfg(test)]
mod tests {
    use std::net::TcpListener;
    use std::path::Path;
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;
    use crate::engine::FAILS;

    /// Every request that runs a model, with a handler that panics: the answer says so, and the connection goes on.
    #[test]
    fn every_handler_may_panic() {
        let engine = Engine::open(Path::new("paper")).expect("the built-in model");
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = listener.local_addr().expect("an address");
        let ending = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                let (stream, _) = listener.accept().expect("a connection");
                // The client may have gone first.
                let _ = serve(&stream, &engine, &|| ending.load(Ordering::Relaxed));
            });
            let stream = TcpStream::connect(address).expect("a connection");
            let patience = Some(Duration::from_secs(30));
            stream.set_read_timeout(patience).expect("a timeout");
            let mut page = WebSocket::from_raw_socket(stream, Role::Client, None);
            let hello = page.read().expect("an answer");
            assert!(hello.to_text().expect("a text").contains("hello"));
            let axis = r#","path":"gap[0].width","unit":"m","from":0.01,"to":0.1,"points":3"#;
            for (id, (op, more)) in [("run", ""), ("report", ""), ("curve", axis)]
                .into_iter()
                .enumerate()
                .chain([(9, ("run", ""))])
            {
                let asked = format!(r#"{{"op":"{op}","id":{id},"text":"{FAILS}"{more}}}"#);
                page.send(Message::text(asked)).expect("it is there");
                let message = page.read().expect("an answer");
                let answer = String::from_utf8_lossy(&message.into_data()).into_owned();
                assert!(answer.contains(&format!("\"id\":{id}")), "{op}: {answer}");
                assert!(
                    answer.contains("panic") || answer.contains("fail"),
                    "{op}: {answer}"
                );
            }
            ending.store(true, Ordering::Relaxed);
        });
    }
}
