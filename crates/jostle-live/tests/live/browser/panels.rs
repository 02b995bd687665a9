//! Panels of contacts, impacts and ports.

use super::{open, paper, serve};

#[test]
fn ports_of_given_buildings_have_knobs() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("given.toml");
    let text = r#"
[motion]
record = "el-centro-1940-ns"
pga = "0.2 g"

[[building]]
name = "A"
kind = "given"
matrices = { stiffness = [[120e6, -60e6], [-60e6, 60e6]], mass = [40e3, 40e3] }
damping = { ratio = 0.05, modes = [1, 2] }

[building.ports]
"1" = { dof = 1, height = "3 m" }
roof = { dof = 2, height = "6 m" }

[[building]]
name = "B"
kind = "shear"
mass = ["60 t", "60 t"]
stiffness = "20 MN/m"
storey_height = "3 m"

[[gap]]
between = ["A", "B"]
width = "10 mm"
"#;
    std::fs::write(&file, text).unwrap();
    let server = serve(file.to_str().unwrap());
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.search("ports");
    page.type_into("building[0].ports.roof.height", "3 kg");
    let fault = page.fault_of("building[0].ports.roof.height");
    assert!(fault.contains("expected a length"), "{fault}");
    page.type_into("building[0].ports.roof.height", "6.5 m");
    assert_eq!(page.fault_of("building[0].ports.roof.height"), "");
    assert!(
        page.model()
            .contains("roof = { dof = 2, height = \"6.5 m\" }"),
        "{}",
        page.model()
    );
    // Drawn as high as it says.
    let said = page.text(
        "[...document.querySelectorAll('.dimension-name')].map((t) => t.textContent).join('|')",
    );
    assert!(said.contains("3.5") || said.contains("6.5 m"), "{said}");
    // The slider moves the lower port, and the present value of the curve can be a port.
    page.value("{ const s = [...document.querySelectorAll('.knob')].find((k) => k.querySelector('.knob-name').title.startsWith('building[0].ports.1.height:')).querySelector('.knob-slider'); s.focus(); s.value = Number(s.value) + 0.05; s.dispatchEvent(new Event('input')); }");
    page.settled();
    assert!(
        !page
            .model()
            .contains("\"1\" = { dof = 1, height = \"3 m\" }"),
        "{}",
        page.model()
    );
    page.glance("live-ports");
    page.assert_content();
}

#[test]
fn panels_of_impacts_follow_the_run() {
    let Some(page) = open(paper(), 1400, 1000) else {
        return;
    };
    page.value("document.getElementById('charts').scrollIntoView()");
    page.wait("document.querySelectorAll('.disc').length === 1");
    let name = "document.querySelector('.impact-name')?.textContent ?? ''";
    let first = page.text(name);
    assert!(first.contains("peak force 1283 kN"), "{first}");
    assert_eq!(
        page.number("document.querySelectorAll('.impact-pictures svg').length"),
        2.0
    );
    page.type_into("gap[0].width", "30 mm");
    let second = page.text(name);
    assert!(
        second.contains("the largest of") && second != first,
        "{second}"
    );
    assert!(page.number("document.querySelectorAll('.impact-panel').length") > 3.0);
    assert!(page.number("document.querySelectorAll('.disc').length") > 3.0);
    page.type_into("gap[0].width", "300 mm");
    assert_eq!(
        page.value("document.getElementById('impact-panels').hidden"),
        true
    );
    assert_eq!(
        page.number("document.querySelectorAll('.disc').length"),
        0.0
    );
    page.assert_content();
}

#[test]
fn contacts_between_floors_have_loops_and_their_own_closing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("levels.toml");
    let building = |name: &str, storeys: usize, height: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nkind = \"frame\"\nstoreys = {storeys}\nstorey_height = \"{height}\"\nspans = [\"6 m\"]\ncolumn = {{ width = \"450 mm\", depth = \"450 mm\" }}\nbeam = {{ width = \"300 mm\", depth = \"600 mm\" }}\nconcrete = \"C30\"\nbeam_mass = \"40 kN/m\"\n\n"
        )
    };
    let text = format!(
        "[motion]\nrecord = \"el-centro-1940-ns\"\npga = \"0.3 g\"\nduration = \"6 s\"\n\n{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"10 mm\"\nfloors = \"all\"\nlaw = \"hertz\"\nstiffness = \"2e9 N/m^1.5\"\n",
        building("A", 2, "4.2 m"),
        building("B", 4, "3.3 m")
    );
    std::fs::write(&file, text).unwrap();
    let server = serve(file.to_str().unwrap());
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    page.value("document.getElementById('charts').scrollIntoView()");
    page.wait("document.querySelectorAll('.impact-pictures svg').length === 2");
    let name = page.text("document.querySelector('.impact-name').textContent");
    assert!(name.contains("height"), "{name}");
    // The loop of Hertz's law is its curve: F/F₀ = (δ/δ₀)^1.5.
    let off = page.number("(() => { const d = document.querySelectorAll('.impact-pictures svg')[1].querySelector('.line').getAttribute('d'); const points = d.slice(1).split('L').map((p) => p.split(',').map(Number)); const [xs, ys] = [points.map((p) => p[0]), points.map((p) => p[1])]; const [x0, y0] = [Math.min(...xs), Math.max(...ys)]; const [w, h] = [Math.max(...xs) - x0, y0 - Math.min(...ys)]; return points.length < 5 ? points.length : points.reduce((worst, [x, y]) => Math.max(worst, Math.abs((y0 - y) / h - ((x - x0) / w) ** 1.5)), 0); })()");
    assert!(off < 5e-3, "{off} off the law");
    // At its peak the closing is that of the run, which straight lines between floors do not give.
    page.value("[...document.querySelectorAll('#impact-panels button')].find((b) => b.textContent === 'Largest').click()");
    // A chart out of sight is drawn when it comes into sight.
    let caption = "[...document.querySelectorAll('figcaption')].find((c) => c.textContent.startsWith('Closing, '))";
    page.value(&format!("{caption}.scrollIntoView()"));
    page.wait(&format!(
        "/\\d/.test({caption}.textContent.split('closing')[1])"
    ));
    page.drawn();
    let number = |script: &str| -> f64 {
        let text = page.text(script);
        text.replace(['\u{a0}', '\u{202f}'], " ")
            .split(' ')
            .find_map(|word| word.parse().ok())
            .unwrap_or_else(|| panic!("no number in {text}"))
    };
    let shown = number(&format!(
        "{caption}.textContent.split('closing')[1].replace(/without.*/, '')"
    ));
    let peak = number(
        "[...document.querySelectorAll('.tile')].find((t) => t.textContent.includes('Peak closing')).querySelector('.tile-value').textContent",
    );
    assert!(
        (shown - peak).abs() < 0.1,
        "{shown} mm drawn, {peak} mm in the summary"
    );
    page.glance("live-between-floors");
    page.assert_content();
}
