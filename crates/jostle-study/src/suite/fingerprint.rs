//! What a finished record belongs to: the model, the motion, the version and what was asked for.

use std::path::Path;

use jostle_io::read_text_file;
use jostle_run::Prepared;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::runner::SuiteOptions;
use crate::study::hex;

/// Name of the file with the fingerprint of a finished record.
pub(super) const FINISHED: &str = "finished.json";
/// Largest file about a finished record \[bytes\].
const LARGEST: usize = 256 << 20;

/// A text of 64 digits that changes with everything that the files of a record depend on.
pub(super) fn fingerprint(prepared: &Prepared, options: &SuiteOptions) -> String {
    let (input, motion) = (&prepared.input, &prepared.motion);
    let mut hash = Sha256::new();
    let mut add = |text: &str| {
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(text.as_bytes());
    };
    add(env!("CARGO_PKG_VERSION"));
    // Every number of a model is in its debug form, with all digits.
    add(&format!("{:?}", input.model));
    add(&format!("{:?}", input.floor_spectra));
    add(&format!("{:?}", input.warnings));
    // So is every acceleration of the motion, of that across and of those under single buildings.
    add(&format!("{motion:?}"));
    add(&format!("{} {}", options.report, options.sensitivity));
    hex(&hash.finalize())
}

/// The text of `summary.json` of a record that was finished with this fingerprint.
pub(super) fn finished(folder: &Path, fingerprint: &str) -> Option<String> {
    let read = |name: &str| read_text_file(&folder.join(name), LARGEST).ok();
    let known: Value = serde_json::from_str(&read(FINISHED)?).ok()?;
    let summary = read("summary.json")?;
    // A summary that was changed since is computed again.
    let hash = hex(&Sha256::digest(summary.as_bytes()));
    let same = known["fingerprint"] == fingerprint && known["summary_sha256"] == hash;
    same.then_some(summary)
}

/// The text of the file that says so.
pub(super) fn finished_text(fingerprint: &str, summary: &str) -> String {
    let value = json!({
        "jostle": env!("CARGO_PKG_VERSION"),
        "fingerprint": fingerprint,
        "summary_sha256": hex(&Sha256::digest(summary.as_bytes())),
    });
    format!("{value:#}\n")
}
