//! Commands to one page, and what comes back.

use std::net::TcpStream;
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Message, WebSocket};

/// Longest wait for an answer: the machine may be busy.
pub(super) const PATIENCE: Duration = Duration::from_secs(120);

/// A connection to the browser, with a tab in a context of its own, which closes with it.
#[derive(Debug)]
pub(super) struct Connection {
    socket: WebSocket<TcpStream>,
    session: Option<String>,
    commands: u64,
    /// Exceptions, and what the page or the browser wrote to its console.
    pub(super) complaints: Vec<String>,
}

impl Connection {
    /// Connects to a browser, and opens an empty tab.
    pub(super) fn new(browser: &str) -> Self {
        let host = browser.trim_start_matches("ws://");
        let host = host.split('/').next().unwrap_or_default();
        let stream = TcpStream::connect(host).expect("the browser is gone");
        let ready = stream
            .set_nodelay(true)
            .and_then(|()| stream.set_read_timeout(Some(PATIENCE)));
        ready.expect("options of a socket");
        let unlimited = WebSocketConfig::default()
            .max_message_size(None)
            .max_frame_size(None);
        let (socket, _) = tungstenite::client::client_with_config(browser, stream, Some(unlimited))
            .expect("the browser refuses the connection");
        let mut new = Self {
            socket,
            session: None,
            commands: 0,
            complaints: Vec::new(),
        };
        let context = new.call(
            "Target.createBrowserContext",
            json!({ "disposeOnDetach": true }),
        );
        let target = new.call(
            "Target.createTarget",
            json!({ "url": "about:blank", "browserContextId": context["browserContextId"] }),
        );
        let session = new.call(
            "Target.attachToTarget",
            json!({ "targetId": target["targetId"], "flatten": true }),
        );
        new.session = session["sessionId"].as_str().map(str::to_owned);
        for domain in ["Runtime", "Log"] {
            new.call(&format!("{domain}.enable"), json!({}));
        }
        // Every page has the focus, however many are open.
        new.call(
            "Emulation.setFocusEmulationEnabled",
            json!({ "enabled": true }),
        );
        new
    }

    /// Runs a command.
    ///
    /// # Panics
    /// If the browser refuses it.
    pub(super) fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.attempt(method, parameters)
            .unwrap_or_else(|error| panic!("{method}: {error}"))
    }

    /// Runs a command, which the browser may refuse.
    pub(super) fn attempt(&mut self, method: &str, parameters: Value) -> Result<Value, String> {
        self.commands += 1;
        let mut command = json!({ "id": self.commands, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            command["sessionId"] = session.as_str().into();
        }
        self.socket
            .send(Message::text(command.to_string()))
            .unwrap_or_else(|error| panic!("{method}: the browser is gone: {error}"));
        loop {
            let message = self.socket.read();
            let message = message.unwrap_or_else(|error| panic!("{method}: no answer: {error}"));
            let Message::Text(text) = message else {
                continue;
            };
            let mut message: Value = serde_json::from_str(&text).expect("JSON");
            if message["id"] == self.commands {
                return match message.get("error") {
                    Some(error) => Err(error.to_string()),
                    None => Ok(message["result"].take()),
                };
            }
            self.note(&message);
        }
    }

    fn note(&mut self, event: &Value) {
        let kind = match event["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown" => "exception",
            "Runtime.consoleAPICalled" => "console",
            "Log.entryAdded" => "log",
            "Inspector.targetCrashed" => panic!("the page crashed"),
            _ => return,
        };
        self.complaints.push(format!("{kind}: {}", event["params"]));
    }
}
