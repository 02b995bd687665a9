//! Pages with their engine inside. They need the engine that `packaging/wasm` builds, so these tests run only when asked
//! for: `cargo test --workspace --test live browser::exported -- --ignored`.

use std::path::{Path, PathBuf};

use jostle_live::{Engine, address, export, export_all};
use jostle_testkit::browser::{open_address, open_page};

use super::LivePage;

/// Greatest size of the page of the built-in example \[bytes\].
const MOST_BYTES: usize = 3_000_000;

fn exported(model: &Path) -> String {
    let module = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/wasm/jostle.wasm.gz");
    let module = std::fs::read(module).expect("packaging/wasm builds the engine");
    export(&Engine::open(model).unwrap(), &module).unwrap()
}

fn open_exported(model: &Path) -> Option<LivePage> {
    let page = open_page(&exported(model), 1400, 1000)?;
    page.wait("Number(document.body.dataset.frames) >= 1");
    Some(LivePage(page))
}

/// Peak force of the first gap \[kN\], computed here.
fn native_peak(text: &str) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("model.toml");
    std::fs::write(&file, text).unwrap();
    let input = jostle_io::read_model_file(&file).unwrap();
    let prepared = jostle_run::CaseCache::default().assemble(input).unwrap();
    let outcome = prepared.step(jostle::Settings::default(), |_| {
        std::ops::ControlFlow::Continue(())
    });
    1e-3 * prepared.summary(&outcome, None, 0.0).gaps[0].peak_force_n
}

/// Keeps the heads of frames that come from now on.
const LISTEN: &str = "{ const parse = JSON.parse; JSON.parse = (text) => { const value = parse(text); if (Array.isArray(value) && value[0]?.numbers) window.head = value[0]; return value; }; }";

#[test]
#[ignore = "needs the engine that packaging/wasm builds"]
fn exported_page_has_the_numbers_of_the_program_and_its_knobs_work() {
    let page = exported(Path::new("paper"));
    assert!(page.len() <= MOST_BYTES, "{} bytes", page.len());
    let Some(page) = open_exported(Path::new("paper")) else {
        return;
    };
    page.value(LISTEN);
    for width in ["30 mm", "100 mm"] {
        page.type_into("gap[0].width", width);
        page.settled();
        let found = page.number("window.head.numbers.find((n) => n.name === 'Peak force').value");
        let expected = native_peak(&page.model());
        assert!(page.model().contains(&format!("width = \"{width}\"")));
        assert!(
            (found / expected - 1.0).abs() <= 1e-12,
            "{width}: {found} in the page, {expected} here"
        );
    }
    page.wait("document.querySelector('.curve-line')?.getAttribute('d').split('L').length > 100");
    page.wait("document.getElementById('curve-note').textContent.includes('Gap needed')");
    page.glance("exported");
    // A fault, and back.
    page.type_into("gap[0].width", "3 kg");
    assert!(page.fault_of("gap[0].width").contains("expected a length"));
    page.click("undo");
    assert!(page.headline().contains("impact"), "{}", page.headline());
    // The report is made inside too.
    page.value("window.kept = []; URL.createObjectURL = (blob) => { blob.text().then((text) => window.kept.push(text)); return 'blob:none'; }; HTMLAnchorElement.prototype.click = () => {}");
    page.value("document.getElementById('save-report').click()");
    page.wait("window.kept.length === 1 && window.kept[0].includes('– jostle</title>')");
    page.assert_content();
}

#[test]
#[ignore = "needs the engine that packaging/wasm builds"]
fn exported_page_holds_the_records_of_its_model() {
    let folder = tempfile::tempdir().unwrap();
    let mut record = "# unit = m/s2\n".to_owned();
    record.extend((0..400).map(|i| {
        format!(
            "{:.2} {:.6}\n",
            0.02 * f64::from(i),
            (0.5 * f64::from(i)).sin()
        )
    }));
    std::fs::write(folder.path().join("own.csv"), record).unwrap();
    let text = jostle_io::model_text("paper").unwrap();
    let line = text
        .lines()
        .find(|line| line.starts_with("record"))
        .unwrap();
    let text = text.replacen(line, "record = \"own.csv\"", 1);
    let model: PathBuf = folder.path().join("model.toml");
    std::fs::write(&model, text).unwrap();
    let page = exported(&model);
    // Not where the record is.
    drop(folder);
    let Some(page) = open_page(&page, 1400, 1000) else {
        return;
    };
    let page = LivePage(page);
    page.wait(
        "Number(document.body.dataset.frames) >= 1 || document.body.classList.contains('faulty')",
    );
    assert_eq!(
        page.value("document.body.classList.contains('faulty')"),
        false,
        "{}",
        page.text("document.querySelector('.knobs').textContent")
    );
    assert!(page.model().contains("own.csv"));
    page.search("record");
    page.type_into("motion.record", "other.csv");
    let fault = page.fault_of("motion.record");
    assert!(fault.contains("there is no record"), "{fault}");
    page.assert_content();
}

#[test]
#[ignore = "needs the engine that packaging/wasm builds"]
fn a_page_opens_with_the_model_of_its_address_and_has_the_files_of_all() {
    let folder = tempfile::tempdir().unwrap();
    let record: String = (0..200)
        .map(|at| format!("{}\n", 3.0 * (0.4 * f64::from(at)).sin()))
        .collect();
    std::fs::write(folder.path().join("own.csv"), record).unwrap();
    let model = |width: u32, motion: &str| {
        format!(
            "[motion]\n{motion}\n[[building]]\nname = \"A\"\nkind = \"shear\"\nmass = [\"40 t\"]\nstiffness = [\"20 MN/m\"]\nstorey_height = \"3 m\"\n\
             [[building]]\nname = \"B\"\nkind = \"shear\"\nmass = [\"40 t\"]\nstiffness = [\"5 MN/m\"]\nstorey_height = \"3 m\"\n\
             [[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"{width} mm\"\n"
        )
    };
    let texts = [
        model(11, "record = \"el-centro-1940-ns\""),
        model(7, "record = \"own.csv\"\nunit = \"m/s2\"\nstep = \"20 ms\""),
    ];
    let engines: Vec<Engine> = texts
        .iter()
        .map(|text| Engine::from_text("pair.toml", text, folder.path()).unwrap())
        .collect();
    let module = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/wasm/jostle.wasm.gz");
    let module = std::fs::read(module).expect("packaging/wasm builds the engine");
    let file = folder.path().join("pairs.html");
    std::fs::write(&file, export_all(&engines, &module).unwrap()).unwrap();
    let open = |end: &str| {
        let page = open_address(&format!("file://{}{end}", file.display()), 1400, 1000)?;
        page.wait("Number(document.body.dataset.frames) >= 1");
        Some(LivePage(page))
    };
    for (end, width) in [(String::new(), 11), (format!("#{}", address(&texts[1])), 7)] {
        let Some(page) = open(&end) else { return };
        let model = page.model();
        assert!(
            model.contains(&format!("width = \"{width} mm\"")),
            "{model}"
        );
        assert!(page.headline().contains("impact"), "{}", page.headline());
        page.assert_content();
    }
}

#[test]
#[ignore = "needs the engine that packaging/wasm builds"]
fn exported_page_stops_long_runs() {
    let Some(page) = open_exported(Path::new("paper-inelastic")) else {
        return;
    };
    page.stops_a_long_run();
    page.assert_content();
}
