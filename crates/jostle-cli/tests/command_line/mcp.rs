//! `jostle mcp` spoken to by a scripted client, line by line.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops at the first surprise, helpers included"
)]

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Stdio};

use serde_json::{Value, json};

use crate::common::{command, folder, jostle, printed};

/// The server and both ends of its pipes.
struct Client {
    program: Child,
    to: Option<ChildStdin>,
    from: BufReader<ChildStdout>,
    id: u64,
}

impl Client {
    /// A server that has been greeted.
    fn start(folder: &Path) -> Self {
        let mut program = command(folder, &["mcp"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let to = program.stdin.take();
        let from = BufReader::new(program.stdout.take().unwrap());
        let mut client = Self {
            program,
            to,
            from,
            id: 0,
        };
        let hello = client.ask(
            "initialize",
            json!({ "protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": { "name": "test", "version": "1" } }),
        );
        assert_eq!(hello["result"]["serverInfo"]["name"], "jostle");
        client
            .send(&json!({ "jsonrpc": "2.0", "method": "notifications/initialized" }).to_string());
        client
    }

    fn send(&mut self, line: &str) {
        let to = self.to.as_mut().unwrap();
        writeln!(to, "{line}").unwrap();
        to.flush().unwrap();
    }

    /// The next message.
    fn next(&mut self) -> Value {
        let mut line = String::new();
        self.from.read_line(&mut line).unwrap();
        serde_json::from_str(&line).unwrap_or_else(|error| panic!("{error}: {line:?}"))
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.id += 1;
        let request =
            json!({ "jsonrpc": "2.0", "id": self.id, "method": method, "params": params });
        self.send(&request.to_string());
        loop {
            let answer = self.next();
            if answer["id"] == json!(self.id) {
                return answer;
            }
        }
    }

    /// Text of a tool, and whether it is an error.
    fn call(&mut self, tool: &str, arguments: Value) -> (String, bool) {
        let answer = self.ask(
            "tools/call",
            json!({ "name": tool, "arguments": arguments }),
        );
        let result = &answer["result"];
        let text = result["content"][0]["text"].as_str();
        let text = text.unwrap_or_else(|| panic!("{answer}"));
        (text.to_owned(), result["isError"] == json!(true))
    }

    fn fine(&mut self, tool: &str, arguments: Value) -> String {
        let (text, wrong) = self.call(tool, arguments);
        assert!(!wrong, "{text}");
        text
    }

    fn refused(&mut self, tool: &str, arguments: Value) -> String {
        let (text, wrong) = self.call(tool, arguments);
        assert!(wrong, "{text}");
        text
    }

    /// Closes standard input; the server ends by itself.
    fn close(mut self) {
        drop(self.to.take());
        let ended = self.program.wait().unwrap();
        assert!(ended.success(), "{ended}");
    }
}

const TOWERS: &str = r#"
[motion]
kind = "sine"
amplitude = "2 m/s2"
period = "0.7 s"
duration = "3 s"
[[building]]
name = "A"
kind = "shear"
mass = "40 t"
stiffness = "30 MN/m"
storeys = 2
storey_height = "3 m"
[[building]]
name = "B"
kind = "shear"
mass = "60 t"
stiffness = "90 MN/m"
storeys = 2
storey_height = "3 m"
[[gap]]
between = ["A", "B"]
width = "5 mm"
law = "linear"
stiffness = "500 MN/m"
"#;

#[test]
fn tools_answer_as_the_commands_do() {
    let folder = folder();
    std::fs::write(folder.path().join("towers.toml"), TOWERS).unwrap();
    let mut client = Client::start(folder.path());
    let tools = client.ask("tools/list", json!({}));
    let names: Vec<&str> = tools["result"]["tools"]
        .as_array()
        .unwrap()
        .iter()
        .map(|tool| {
            assert_eq!(tool["inputSchema"]["type"], "object", "{tool}");
            tool["name"].as_str().unwrap()
        })
        .collect();
    assert_eq!(names, ["check", "run", "gap", "study", "explain", "schema"]);
    let model = json!({ "model": "towers.toml" });
    let checked = printed(&jostle(folder.path(), &["check", "towers.toml"]));
    assert_eq!(client.fine("check", model.clone()), checked.trim_end());
    let text = client.fine("run", model.clone());
    assert!(text.contains("impact") && !text.contains('\x1b'), "{text}");
    // The same numbers as the command line, but for the time that it took.
    let run = |text: &str| -> Value {
        let mut summary: Value = serde_json::from_str(text).unwrap();
        summary["work"] = json!(null);
        summary
    };
    let ours = client.fine("run", json!({ "model": "towers.toml", "json": true }));
    let theirs = printed(&jostle(folder.path(), &["run", "towers.toml", "--json"]));
    assert!(run(&ours) == run(&theirs), "{ours}\n{theirs}");
    // A changed value, the same by text.
    let wider = json!({ "model": "towers.toml", "json": true, "set": { "gap[*].width": "9 mm" } });
    let text = TOWERS.replace("5 mm", "9 mm");
    let by_text = client.fine("run", json!({ "text": text, "json": true }));
    assert_eq!(
        run(&client.fine("run", wider))["gaps"],
        run(&by_text)["gaps"]
    );
    assert_ne!(run(&ours)["gaps"], run(&by_text)["gaps"]);
    let gap = client.fine("gap", model);
    let theirs = printed(&jostle(folder.path(), &["gap", "towers.toml"]));
    // The command writes files as well.
    let theirs = theirs.split("→").next().expect("the results");
    assert_eq!(gap, theirs.trim_end());
    let table = client.fine(
        "study",
        json!({ "model": "towers.toml", "vary": { "gap[*].width": ["5 mm", "9 mm"] } }),
    );
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 3, "{table}");
    let place = lines[0].split(',').position(|name| name == "peak_force_n");
    let force = |row: usize| -> f64 {
        let cells: Vec<&str> = lines[row].split(',').collect();
        cells[place.unwrap()].parse().unwrap()
    };
    let peak = |summary: &Value| summary["gaps"][0]["peak_force_n"].as_f64().unwrap();
    assert!((force(1) / peak(&run(&ours)) - 1.0).abs() < 1e-3, "{table}");
    assert!(
        (force(2) / peak(&run(&by_text)) - 1.0).abs() < 1e-3,
        "{table}"
    );
    client.close();
}

#[test]
fn names_are_explained() {
    let folder = folder();
    let mut client = Client::start(folder.path());
    let key = client.fine("explain", json!({ "name": "building[0].storey_height" }));
    assert!(
        key.contains("Key of model files") && key.contains("Storey height"),
        "{key}"
    );
    let quantity = client.fine("explain", json!({ "name": "base_shear_peak_n" }));
    assert!(quantity.contains("unit: N"), "{quantity}");
    let check = client.fine("explain", json!({ "name": "B2" }));
    assert!(check.contains("drift ratio of a storey"), "{check}");
    let unknown = client.refused("explain", json!({ "name": "storey_heigth" }));
    assert!(unknown.contains("did you mean storey_height?"), "{unknown}");
    let headings = client.fine("schema", json!({}));
    assert!(headings.contains("[[gap]]"), "{headings}");
    let gap = client.fine("schema", json!({ "section": "[[gap]]" }));
    assert!(gap.contains("| `width` |") && gap.len() < 20_000, "{gap}");
    assert!(
        client
            .refused("schema", json!({ "section": "nothing" }))
            .contains("[[gap]]")
    );
    let results = client.fine("schema", json!({ "of": "results", "section": "Impacts" }));
    assert!(results.contains("impact_speed_m_s"), "{results}");
    client.close();
}

#[test]
fn faults_are_those_of_the_command_line() {
    let folder = folder();
    let mut client = Client::start(folder.path());
    let text = TOWERS.replace("mass = \"40 t\"", "mas = \"40 m\"");
    let said = client.refused("check", json!({ "text": text }));
    assert!(
        said.contains("mas") && said.contains("did you mean"),
        "{said}"
    );
    let both = json!({ "text": TOWERS, "model": "paper" });
    assert!(client.refused("run", both).contains("not both"));
    let unknown = client.refused("run", json!({ "modell": "paper" }));
    assert!(
        unknown.contains("\"modell\"") && unknown.contains("model, "),
        "{unknown}"
    );
    let path = json!({ "text": TOWERS, "set": { "gap[7].width": "1 mm" } });
    assert!(client.refused("run", path).starts_with("set: "));
    let kind = client.refused("run", json!({ "text": 5 }));
    assert!(kind.contains("expected a string"), "{kind}");
    let many = json!({ "text": TOWERS, "vary": { "gap[*].width": vec!["1 mm"; 3000] } });
    let many = client.refused("study", many);
    assert!(
        many.contains("3000") || many.contains("twice") || many.contains("equal"),
        "{many}"
    );
    assert!(
        client
            .refused("study", json!({ "study": "nonsense" }))
            .contains("gap-sweep")
    );
    let answer = client.ask("tools/call", json!({ "name": "destroy", "arguments": {} }));
    let message = answer["error"]["message"].as_str().unwrap();
    assert!(
        message.contains("no tool \"destroy\"") && message.contains("explain"),
        "{message}"
    );
    // It still answers.
    client.fine("check", json!({ "text": TOWERS }));
    client.close();
}

#[test]
fn nothing_outside_the_folder_is_read() {
    let outer = folder();
    let inside = outer.path().join("inside");
    std::fs::create_dir_all(inside.join("deeper")).unwrap();
    std::fs::write(outer.path().join("secret.toml"), TOWERS).unwrap();
    std::fs::write(outer.path().join("secret.csv"), "0,1\n0.01,2\n").unwrap();
    std::fs::write(
        inside.join("own.csv"),
        "# unit = m/s2\ntime,acceleration\n0,0\n0.01,1\n0.02,0\n",
    )
    .unwrap();
    let from_parent = TOWERS.replace(
        "kind = \"sine\"\namplitude = \"2 m/s2\"\nperiod = \"0.7 s\"\n",
        "record = \"../own.csv\"\n",
    );
    assert_ne!(from_parent, TOWERS);
    std::fs::write(inside.join("deeper/model.toml"), from_parent).unwrap();
    let mut client = Client::start(&inside);
    let secret = outer.path().join("secret.toml");
    for name in [
        "../secret.toml",
        "deeper/../../secret.toml",
        secret.to_str().unwrap(),
    ] {
        let said = client.refused("check", json!({ "model": name }));
        assert!(said.contains("outside the folder"), "{name}: {said}");
    }
    for name in ["../secret.csv", "/etc/passwd"] {
        for model in [json!({ "text": TOWERS }), json!({ "model": "paper" })] {
            let mut asked = model.clone();
            asked["set"] = json!({ "motion.record": name });
            for tool in ["check", "run", "gap"] {
                let said = client.refused(tool, asked.clone());
                assert!(said.contains("outside the folder"), "{tool} {name}: {said}");
            }
            let mut asked = model.clone();
            asked["vary"] = json!({ "motion.record": [name] });
            let (said, wrong) = client.call("study", asked);
            assert!(wrong || said.contains("outside"), "study {name}: {said}");
            assert!(!said.contains("root:"), "{said}");
        }
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&secret, inside.join("link.toml")).unwrap();
        let said = client.refused("check", json!({ "model": "link.toml" }));
        assert!(said.contains("outside the folder"), "{said}");
    }
    // A model of a folder inside may name a file beside that folder, which is inside too.
    client.fine("check", json!({ "model": "deeper/model.toml" }));
    let before: Vec<_> = std::fs::read_dir(&inside)
        .unwrap()
        .flatten()
        .map(|e| e.file_name())
        .collect();
    client.fine("run", json!({ "text": TOWERS }));
    let after: Vec<_> = std::fs::read_dir(&inside)
        .unwrap()
        .flatten()
        .map(|e| e.file_name())
        .collect();
    assert_eq!(before, after);
    client.close();
}

#[test]
fn broken_and_huge_messages_do_no_harm() {
    let folder = folder();
    let mut client = Client::start(folder.path());
    client.send("this is no JSON");
    client.send("{\"jsonrpc\": \"2.0\", \"id\": 77}");
    client.send(&format!("{{\"huge\": \"{}\"}}", "x".repeat(17 << 20)));
    let deep = format!("{}{}", "[".repeat(5000), "]".repeat(5000));
    client.send(&deep);
    // A large model within the limit is an ordinary fault.
    let large = "x".repeat(6 << 20);
    assert!(!client.refused("check", json!({ "text": large })).is_empty());
    client.fine("check", json!({ "text": TOWERS }));
    client.close();
}

#[test]
fn it_ends_with_its_input() {
    let folder = folder();
    let mut program = command(folder.path(), &["mcp"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(program.stdin.take());
    assert!(program.wait().unwrap().success());
    // In the middle of a long run, too.
    let mut client = Client::start(folder.path());
    client.send(
        &json!({ "jsonrpc": "2.0", "id": 9, "method": "tools/call", "params": { "name": "gap", "arguments": { "model": "paper-inelastic", "tolerance": "0.001 mm" } } })
            .to_string(),
    );
    let started = std::time::Instant::now();
    client.close();
    assert!(started.elapsed().as_secs() < 20);
}
