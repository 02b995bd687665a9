//! A page on this machine that runs a model at every change.
//!
//! [`Server::start`] serves one page and one WebSocket on the loopback address, behind a random token. The page sends
//! the text of a model file and what to change in it; the answer is one binary message with everything that the report
//! shows. The page is the viewer of the report (`jostle_report::Viewer`) with knobs around it. No request makes the
//! server write a file; it reads only those in the folder of the model and those that the opened model names.
//!
//! [`Local`] answers the same requests without a server, one after the other: in a page that carries the engine as
//! WebAssembly ([`export`]), and in a notebook.

mod answer;
mod curve;
mod engine;
#[cfg(not(target_family = "wasm"))]
mod export;
#[cfg(not(target_family = "wasm"))]
mod http;
mod local;
mod message;
#[cfg(not(target_family = "wasm"))]
mod page;
#[cfg(not(target_family = "wasm"))]
mod server;
#[cfg(not(target_family = "wasm"))]
mod session;
#[cfg(not(target_family = "wasm"))]
mod slot;

pub use answer::Answer;
pub use engine::Engine;
#[cfg(not(target_family = "wasm"))]
pub use export::{ExportError, address, export, export_all};
pub use local::Local;
#[cfg(not(target_family = "wasm"))]
pub use page::widget_page;
#[cfg(not(target_family = "wasm"))]
pub use server::{LiveError, Server};
