//! Maps over two keys.

use super::{open, short};

#[test]
fn two_keys_make_a_map_and_a_click_sets_both() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    let cells = "document.querySelectorAll('.cells rect').length";
    // The knob is in view before the map begins, which takes a second or two.
    page.search("ratio");
    page.value("{ const a = document.getElementById('across'); a.value = 'motion.pga'; a.dispatchEvent(new Event('change')); }");
    page.wait("document.getElementById('curve-note').textContent.includes('cells.')");
    // A knob that is neither of the two cancels it, unless it is complete: no cell comes until the new one begins.
    page.value("{ window.few = 0; window.sent = []; const send = WebSocket.prototype.send; WebSocket.prototype.send = function (text) { const op = JSON.parse(text).op; if (op === 'run') { window.complete ??= document.querySelectorAll('.cells rect').length === 24 * 24; } window.sent.push(op); send.call(this, text); }; }");
    page.type_into("building[1].damping.ratio", "0.03");
    page.wait("window.sent.includes('curve')");
    let sent = page.text("window.sent.join()");
    let complete = page.value("window.complete") == true;
    assert!(sent.starts_with("stop-curve,run") || complete, "{sent}");
    page.wait(&format!("{cells} === 24 * 24"));
    assert_eq!(
        page.value("document.querySelector('.cells .failed') === null"),
        true
    );
    page.glance("live-map");
    // A cell says the result of a run with its values.
    let click = "(event) => { const box = document.querySelector('.cells').getBoundingClientRect(); const host = document.getElementById('curve-picture'); host.setPointerCapture = () => {}; host.dispatchEvent(new PointerEvent('pointerdown', { clientX: box.left + 2, clientY: box.top + 2, bubbles: true })); }";
    page.value(&format!("({click})()"));
    page.settled();
    let title = page.text("[...document.querySelectorAll('.cells rect')].reduce((a, b) => (b.getBBox().x + b.getBBox().y < a.getBBox().x + a.getBBox().y ? b : a)).querySelector('title').textContent");
    assert!(title.starts_with("0 mm, "), "{title}");
    assert!(
        page.model().contains("width = \"0 mm\""),
        "{}",
        page.model()
    );
    let pga = title.split(", ").nth(1).unwrap().split(':').next().unwrap();
    assert!(
        page.model().contains(&format!("pga = \"{}\"", pga.trim())),
        "{pga}: {}",
        page.model()
    );
    let force = title.rsplit(": ").next().unwrap().trim_end_matches(" kN");
    let shown: f64 = force.replace(['\u{202f}', ','], "").parse().unwrap();
    page.click("pin");
    let row = page.text("[...document.querySelectorAll('#comparison tr')].find((r) => r.textContent.startsWith('Peak force')).children[1].textContent");
    let exact: f64 = row
        .trim_end_matches(" kN")
        .replace(['\u{202f}', ','], "")
        .parse()
        .unwrap();
    assert!((shown / exact - 1.0).abs() < 2e-3, "{title}, {row}");
    // One step of Undo takes both back; arrow keys move both.
    page.click("undo");
    assert!(
        page.model().contains("width = \"100 mm\""),
        "{}",
        page.model()
    );
    page.value("document.querySelector('.cross').focus()");
    page.press("ArrowUp");
    page.press("ArrowLeft");
    page.settled();
    assert!(!page.model().contains("width = \"100 mm\""));
    assert_eq!(
        page.value("document.activeElement.classList.contains('cross')"),
        true
    );
    // The curve again.
    page.value("{ const a = document.getElementById('across'); a.value = ''; a.dispatchEvent(new Event('change')); }");
    page.wait("document.querySelectorAll('.curve-line').length === 1");
    page.assert_content();
}
