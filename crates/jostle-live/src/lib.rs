//! A page on this machine that runs a model at every change.
//!
//! [`Server::start`] serves one page and one WebSocket on the loopback address, behind a random token. The page sends
//! the text of a model file and what to change in it; the answer is one binary message with everything that the report
//! shows. The page is the viewer of the report (`jostle_report::Viewer`) with knobs around it. No request makes the
//! server write a file; it reads only those in the folder of the model and those that the opened model names.

mod curve;
mod engine;
mod http;
mod message;
mod page;
mod server;
mod session;
mod slot;

pub use engine::Engine;
pub use server::{LiveError, Server};
