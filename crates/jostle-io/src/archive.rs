//! A member of a zip archive as text, to see what wrote it.

use std::io::Read;

use flate2::bufread::DeflateDecoder;
use rawzip::{CompressionMethod, ZipArchive};

/// The text of a member of a zip archive, its first `most` bytes; `None` if there is none, or it cannot be read.
#[must_use]
pub fn archive_text(bytes: &[u8], member: &str, most: u64) -> Option<String> {
    let archive = ZipArchive::from_slice(bytes).ok()?;
    let mut entries = archive.entries();
    while let Some(entry) = entries.next_entry().ok()? {
        if entry.file_path().as_ref() != member.as_bytes() {
            continue;
        }
        let local = archive.get_entry(entry.wayfinder()).ok()?;
        let mut text = Vec::new();
        match entry.compression_method() {
            CompressionMethod::STORE => local.data().take(most).read_to_end(&mut text),
            CompressionMethod::DEFLATE => {
                let mut content = DeflateDecoder::new(local.data());
                content.by_ref().take(most).read_to_end(&mut text)
            }
            _ => return None,
        }
        .ok()?;
        return String::from_utf8(text).ok();
    }
    None
}
