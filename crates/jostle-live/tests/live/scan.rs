//! Damaged messages to the live page: the server answers or ends the connection, and stays. `JOSTLE_SCAN` sets how many.

use jostle_testkit::scan::{Dice, scanned};

use crate::safety::{connect, live, status};

#[test]
fn damaged_messages_end_nothing_but_themselves() {
    let live = live();
    let model = jostle_io::model_text("paper").unwrap();
    let model = model.replacen(
        "record = \"el-centro-1940-ns\"",
        "record = \"el-centro-1940-ns\"\nduration = \"1 s\"",
        1,
    );
    let text = serde_json::to_string(&model).unwrap();
    let messages = [
        format!(
            r#"{{"op":"run","id":1,"text":{text},"edits":[["gap[0].width","90 mm"],["motion.pga","3 m/s2"]]}}"#
        ),
        format!(
            r#"{{"op":"curve","id":2,"text":{text},"edits":[],"path":"gap[0].width","unit":"m","from":0.01,"to":0.1,"points":3,"records":[]}}"#
        ),
        format!(
            r#"{{"op":"study","id":3,"text":{text},"edits":[],"path":"gap[0].width","unit":"m","from":0.01,"to":0.1,"points":3}}"#
        ),
        r#"{"op":"stop"}"#.to_owned(),
        r#"{"op":"stop-curve"}"#.to_owned(),
    ];
    let mut dice = Dice::new(3);
    let mut socket = connect(&live);
    for count in 0..scanned(60) {
        let message = dice.one(&messages).clone();
        // What is around the model, or anything.
        let whole = dice.below(2) == 0;
        let (head, tail) = message.split_once(&text).unwrap_or((&message, ""));
        let damaged = if whole {
            dice.damage(message.as_bytes())
        } else {
            [
                &dice.damage(head.as_bytes())[..],
                text.as_bytes(),
                &dice.damage(tail.as_bytes()),
            ]
            .concat()
        };
        let damaged = String::from_utf8_lossy(&damaged).into_owned();
        if socket.send(tungstenite::Message::text(damaged)).is_err() || count % 20 == 19 {
            socket = connect(&live);
        }
    }
    drop(socket);
    assert_eq!(status(&live.page()), 200, "the server is gone");
    // And it still computes.
    let mut socket = connect(&live);
    socket
        .send(tungstenite::Message::text(&messages[0]))
        .unwrap();
    while !socket.read().unwrap().is_binary() {}
}
