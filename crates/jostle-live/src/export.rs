//! A live page as one file, with its engine inside.

use std::collections::BTreeMap;
use std::io::Write;

use base64::Engine as _;
use base64::engine::general_purpose::{STANDARD, URL_SAFE_NO_PAD};
use flate2::Compression;
use flate2::write::DeflateEncoder;
use jostle_io::FileError;
use jostle_io::shown::in_units;
use maud::{PreEscaped, html};

use crate::engine::Engine;
use crate::page;

const WORKER: &str = include_str!("../assets/worker.js");
/// Largest file that goes into a page \[bytes\].
const LARGEST: usize = 256 << 20;
/// First bytes of a gzip file.
const GZIP: [u8; 2] = [0x1f, 0x8b];
/// First bytes of a WebAssembly module.
const WASM: [u8; 4] = *b"\0asm";

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The engine is something else.
    #[error(
        "the engine is not a WebAssembly module packed with gzip{0}; packaging/wasm writes one"
    )]
    NoModule(&'static str),
    /// A file that the model names cannot be read.
    #[error("{name}, which the model names, {error}")]
    File {
        /// Name in the model.
        name: String,
        /// The reason.
        error: FileError,
    },
}

/// The page of a model as one HTML file that works without a server and without a network. `module` is the file that
/// `packaging/wasm` writes. Files that the model names go into the page.
///
/// # Errors
/// [`ExportError`].
pub fn export(engine: &Engine, module: &[u8]) -> Result<String, ExportError> {
    export_all(std::slice::from_ref(engine), module)
}

/// The page of the first of several models, with the files of all of them: [`address`] opens it with another one.
///
/// # Errors
/// [`ExportError`].
pub fn export_all(engines: &[Engine], module: &[u8]) -> Result<String, ExportError> {
    if module.starts_with(&WASM) {
        return Err(ExportError::NoModule(", but an unpacked one"));
    }
    if !module.starts_with(&GZIP) {
        return Err(ExportError::NoModule(""));
    }
    let mut files = BTreeMap::new();
    for engine in engines {
        for name in engine.named_files() {
            if files.contains_key(name) {
                continue;
            }
            let bytes = engine.files().read(name, LARGEST);
            let bytes = bytes.map_err(|error| ExportError::File {
                name: name.clone(),
                error,
            })?;
            files.insert(name, STANDARD.encode(bytes));
        }
    }
    let files: Vec<_> = files.into_iter().collect();
    let first = engines.first();
    let name = first.map_or("", Engine::name);
    let inside = serde_json::json!({
        "name": name,
        "text": first.map_or("", Engine::text),
        "files": files,
    });
    // No text of the model ends the element that holds it.
    let inside = inside.to_string().replace('<', "\\u003c");
    let markup = html! {
        script #inside type="application/json" { (PreEscaped(inside)) }
        script #worker type="text/plain" { (PreEscaped(WORKER)) }
        script #engine type="text/plain" { (PreEscaped(STANDARD.encode(module))) }
    };
    // The engine inside knows only what the model asks for.
    let units = first.and_then(|engine| engine.units).unwrap_or_default();
    Ok(in_units(Some(units), || {
        page::page_with_engine(name, markup)
    }))
}

/// What follows `#` in the address of a page that opens with this text instead of its own.
#[must_use]
pub fn address(text: &str) -> String {
    let kept = serde_json::json!({ "text": text }).to_string();
    let mut packed = DeflateEncoder::new(Vec::new(), Compression::best());
    // Writing into memory cannot fail.
    let _ = packed.write_all(kept.as_bytes());
    URL_SAFE_NO_PAD.encode(packed.finish().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn what_is_no_packed_module_is_refused_with_the_remedy() {
        let engine = Engine::open(Path::new("paper")).unwrap_or_else(|error| panic!("{error}"));
        for (bytes, word) in [
            (&b"\0asm\x01"[..], "unpacked"),
            (b"<html>", "gzip"),
            (b"", "gzip"),
        ] {
            match export(&engine, bytes) {
                Err(error) => {
                    let error = error.to_string();
                    assert!(
                        error.contains(word) && error.contains("packaging/wasm"),
                        "{error}"
                    );
                }
                Ok(_) => panic!("accepted"),
            }
        }
    }

    #[test]
    fn a_model_cannot_end_the_element_that_holds_it() {
        let text = format!(
            "# </script><script>alert(1)</script>\n{}",
            jostle_io::model_text("paper").unwrap_or_default()
        );
        let engine = Engine::from_text("m.toml", &text, Path::new(""))
            .unwrap_or_else(|error| panic!("{error}"));
        let page = export(&engine, &GZIP).unwrap_or_else(|error| panic!("{error}"));
        assert!(!page.contains("alert(1)</script>"));
        assert!(page.contains("alert(1)\\u003c/script>"));
    }
}
