//! Digests of many numbers.

use std::fmt::Write;

use sha2::{Digest, Sha256};

/// Numbers and texts on their way into a digest.
#[derive(Clone, Default)]
pub(super) struct Bits(Sha256);

impl Bits {
    /// Adds a number; −0 counts as 0.
    pub(super) fn number(&mut self, value: f64) {
        self.0.update((value + 0.0).to_bits().to_le_bytes());
    }

    /// Adds a text, with its end.
    pub(super) fn text(&mut self, text: &str) {
        self.0.update(text.as_bytes());
        self.0.update([0]);
    }

    /// The first bytes of the digest, in hexadecimal.
    pub(super) fn short(self, bytes: usize) -> String {
        let digest = self.0.finalize();
        digest[..bytes]
            .iter()
            .fold(String::new(), |mut text, byte| {
                let _ = write!(text, "{byte:02x}");
                text
            })
    }
}
