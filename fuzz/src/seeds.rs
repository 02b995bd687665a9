//! Writes small valid files into corpus/TARGET, for fuzzing to start from.

#[path = "../../crates/jostle-io/tests/reading/fixture/mod.rs"]
mod fixture;

use std::fs;
use std::path::Path;

use jostle_io::{RecordFormat, TEMPLATE_NAMES, template};

fn main() -> std::io::Result<()> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let write = |target: &str, name: &str, bytes: &[u8]| {
        let folder = corpus.join(target);
        fs::create_dir_all(&folder)?;
        fs::write(folder.join(name.replace([' ', ','], "-")), bytes)
    };
    for fixture in fixture::all(100) {
        write("detect", fixture.name, &fixture.bytes)?;
        if let Ok(format) = RecordFormat::detect(&fixture.bytes) {
            write(format.key(), fixture.name, &fixture.bytes)?;
        }
    }
    for name in TEMPLATE_NAMES {
        let text = template(name, "seed").unwrap_or_default();
        write("model", name, text.as_bytes())?;
    }
    // Models with the keys that no template has.
    let models = "../crates/jostle-io/tests/reading/models";
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(models))? {
        let path = entry?.path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        write("model", &name, &fs::read(&path)?)?;
    }
    Ok(())
}
