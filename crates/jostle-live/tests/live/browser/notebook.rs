//! The page in the frame of a notebook.

use std::path::Path;

use jostle_live::Engine;
use jostle_testkit::browser::open_page;

/// The page of a notebook, in a frame like that of the widget; the engine answers by messages.
#[test]
fn a_page_in_a_frame_sends_its_requests_to_the_notebook() {
    let inner = jostle_live::widget_page("paper");
    let quoted = serde_json::to_string(&inner)
        .unwrap()
        .replace('<', "\\u003c");
    let outer = format!(
        "<!DOCTYPE html><title>notebook</title><body><script>window.asked = []; addEventListener('message', (event) => window.asked.push(JSON.parse(event.data.jostle))); const frame = document.createElement('iframe'); frame.setAttribute('sandbox', 'allow-scripts allow-downloads'); frame.style = 'width: 1200px; height: 820px'; frame.srcdoc = {quoted}; document.body.append(frame); window.tell = (text, binary) => frame.contentWindow.postMessage({{ answer: binary ? Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer : text }}, '*');</script></body>"
    );
    let Some(page) = open_page(&outer, 1300, 900) else {
        return;
    };
    let mut local = jostle_live::Local::new(Engine::open(Path::new("paper")).unwrap());
    let tell = |answer: jostle_live::Answer| match answer {
        jostle_live::Answer::Text(text) => page.value(&format!(
            "window.tell({}, false)",
            serde_json::to_string(&text).unwrap()
        )),
        jostle_live::Answer::Binary(bytes) => {
            use base64::Engine as _;
            let text = base64::engine::general_purpose::STANDARD.encode(bytes);
            page.value(&format!("window.tell('{text}', true)"))
        }
    };
    page.wait("window.asked[0]?.op === 'hello'");
    tell(local.hello());
    page.wait("window.asked[1]?.op === 'run'");
    let request = page.text("JSON.stringify(window.asked[1])");
    let watch = |_| std::ops::ControlFlow::Continue(());
    tell(local.answer(&request, &watch).unwrap().unwrap());
    // After the frame the page asks for its curve, so it has drawn the run.
    page.wait("window.asked[2]?.op === 'curve'");
    let request = page.text("JSON.stringify(window.asked[2])");
    assert!(local.answer(&request, &watch).unwrap().is_none());
    while let Some(answer) = local.more() {
        tell(answer);
    }
    page.drawn();
    page.glance("live-notebook");
    // Whether results are sensitive comes later, once: here at a gap that the buildings just graze.
    let run = |width: &str| {
        let text = jostle_io::model_text("paper").unwrap();
        let edits = [["gap[0].width", width]];
        serde_json::json!({ "op": "run", "id": 900, "text": text, "edits": edits }).to_string()
    };
    let Some(jostle_live::Answer::Binary(_)) = local.answer(&run("136.5 mm"), &watch).unwrap()
    else {
        panic!("no frame");
    };
    let stop = || std::ops::ControlFlow::Break(());
    assert_eq!(local.accuracy(&stop), None, "it was stopped");
    local.answer(&run("136.5 mm"), &watch).unwrap();
    let go_on = || std::ops::ControlFlow::Continue(());
    let Some(jostle_live::Answer::Text(text)) = local.accuracy(&go_on) else {
        panic!("nothing was found");
    };
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let [before, after] = super::gap_curve::accuracy_of("136.5 mm");
    let [before, after] =
        [before, after].map(|words| words.replacen("Accuracy: ", "accuracy: ", 1));
    assert_ne!(before, after, "the graze makes no difference");
    assert_eq!(
        (
            found["id"].as_u64(),
            format!("{}.", found["text"].as_str().unwrap())
        ),
        (Some(900), after)
    );
    assert_eq!(local.accuracy(&go_on), None, "it is looked for once");
    // A value that Python sets.
    local.set("gap[0].width", "30 mm").unwrap();
    assert!(local.text().contains("width = \"30 mm\""));
    let text = serde_json::json!({ "op": "model", "text": local.text() }).to_string();
    tell(jostle_live::Answer::Text(text));
    page.wait(
        "window.asked.some((one) => one.op === 'run' && one.text.includes('width = \"30 mm\"'))",
    );
    page.assert_content();
}
