//! Runs that are pinned, compared, undone, and restored from the address.

use jostle_testkit::browser::open_address;

use super::{LivePage, open, short};

#[test]
fn runs_are_pinned_compared_undone_and_redone() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    let first = page.headline();
    page.click("pin");
    page.type_into("gap[0].width", "60 mm");
    let second = page.headline();
    assert_ne!(first, second);
    let table = page.text("document.getElementById('comparison').textContent");
    assert!(
        table.contains("Peak force") && table.contains('%'),
        "{table}"
    );
    let ghost = page.text("document.querySelector('#scene .pinned').getAttribute('d')");
    assert!(
        ghost.matches('M').count() > 5,
        "the pinned run is not drawn: {ghost}"
    );
    page.glance("live-pinned");
    page.click("undo");
    assert_eq!(page.headline(), first);
    page.click("redo");
    assert_eq!(page.headline(), second);
    page.click("pin");
    assert_eq!(
        page.value("document.getElementById('compare').hidden"),
        true
    );
    page.assert_content();
}

/// The state in the hash of an address: JSON, deflated, as base64 for addresses.
const STATE: &str = "async (hash) => { const text = atob(hash.slice(1).replaceAll('-', '+').replaceAll('_', '/')); const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0)); return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).json(); }";

#[test]
fn the_address_restores_the_state_and_pages_do_not_disturb_each_other() {
    let Some(page) = open(short(), 1400, 1000) else {
        return;
    };
    page.type_into("gap[0].width", "47 mm");
    page.value("{ const m = document.getElementById('measure'); m.value = '2'; m.dispatchEvent(new Event('change')); }");
    // The address follows a moment after the last change.
    page.wait(&format!(
        "({STATE})(location.hash).then((state) => state.text.includes('width = \"47 mm\"') && state.curve.measure === '2')"
    ));
    assert!(page.number("location.hash.length") > 200.0);
    let address = page.text("location.href");
    let other = LivePage(open_address(&address, 1400, 1000).unwrap());
    other.wait("Number(document.body.dataset.frames) >= 1");
    assert_eq!(other.headline(), page.headline());
    assert!(other.model().contains("width = \"47 mm\""));
    assert_eq!(other.text("document.getElementById('measure').value"), "2");
    let kept = page.headline();
    other.type_into("gap[0].width", "310 mm");
    assert_ne!(other.headline(), kept);
    assert_eq!(page.headline(), kept);
    page.type_into("motion.pga", "70 cm/s2");
    assert!(!other.model().contains("70 cm/s2"));
    // The address of another state in the same tab does not load the page, but shows the state; Undo leads back.
    let hash = address.split('#').nth(1).unwrap();
    // Its own address follows its last change first.
    other.wait(&format!(
        "({STATE})(location.hash).then((state) => state.text.includes('width = \"310 mm\"'))"
    ));
    other.value(&format!("location.hash = {hash:?}"));
    other.wait("document.getElementById('text').value.includes('width = \"47 mm\"')");
    other.settled();
    assert_eq!(other.headline(), kept);
    other.click("undo");
    assert!(
        other.model().contains("width = \"310 mm\""),
        "{}",
        other.model()
    );
    // An address that was cut off changes nothing.
    let cut = &hash[..hash.len() / 2];
    let read = other.value(&format!(
        "new Promise((done) => {{ addEventListener('hashchange', () => ({STATE})(location.hash).then(() => done(true), () => done(false)), {{ once: true }}); location.hash = {cut:?}; }})"
    ));
    assert_eq!(read, false, "half an address holds a state");
    other.settled();
    assert!(other.model().contains("width = \"310 mm\""));
    page.assert_content();
    other.assert_content();
}
