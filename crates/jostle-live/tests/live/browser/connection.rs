//! A lost connection.

use super::{open, paper, serve};

#[test]
fn a_lost_connection_is_said_and_the_page_still_plays() {
    let server = serve("paper");
    let Some(page) = open(&server, 1400, 1000) else {
        return;
    };
    drop(server);
    page.wait("!document.getElementById('connection').hidden");
    let status = page.text("document.getElementById('connection').textContent");
    assert!(status.contains("No connection"), "{status}");
    page.value("document.getElementById('next').click()");
    page.glance("live-lost");
}

#[test]
fn a_page_connects_again_and_goes_on() {
    let Some(page) = open(paper(), 1400, 1000) else {
        return;
    };
    page.value("{ window.sockets = []; const send = WebSocket.prototype.send; WebSocket.prototype.send = function (text) { if (window.sockets.at(-1) !== this) window.sockets.push(this); send.call(this, text); }; }");
    page.type_into("gap[0].width", "60 mm");
    let frames = page.frames();
    page.value("window.sockets[0].close()");
    page.wait("!document.getElementById('connection').hidden");
    page.glance("live-connecting");
    page.wait("document.getElementById('connection').hidden && window.sockets.length === 2");
    page.wait(&format!("Number(document.body.dataset.frames) > {frames}"));
    // Without a connection a change is kept, and nothing seems to run.
    page.search("duration");
    page.value("window.sockets[1].close()");
    page.wait("!document.getElementById('connection').hidden");
    page.value("{ const l = [...document.querySelectorAll('.knob-name')].find((l) => l.title.startsWith('motion.duration:')); const f = document.getElementById(l.htmlFor); f.value = '12 s'; f.dispatchEvent(new Event('change')); }");
    assert_eq!(
        page.value("document.getElementById('working').hidden"),
        true
    );
    page.wait("document.getElementById('connection').hidden && document.getElementById('text').value.includes('duration = \"12 s\"')");
    page.settled();
    page.search("");
    // The model is the one of before, not that of the file.
    assert!(
        page.model().contains("width = \"60 mm\""),
        "{}",
        page.model()
    );
    page.type_into("gap[0].width", "300 mm");
    assert!(
        page.headline().contains("No contact"),
        "{}",
        page.headline()
    );
    page.assert_content();
}
