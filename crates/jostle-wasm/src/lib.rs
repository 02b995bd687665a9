//! The engine of the live page as WebAssembly: plain functions over linear memory.
//!
//! The page writes bytes where `reserve` says, and calls a function that reads them. Answers wait in
//! a queue: `next` takes one and says its kind, and `output_address` and `output_length` say where it lies. The crate is
//! empty on other targets; `packaging/wasm` builds it.
#![cfg(target_family = "wasm")]
#![allow(
    unsafe_code,
    reason = "names of exported functions, and the one imported function, count as unsafe code; no block is unsafe"
)]

mod exports;
