//! An editor's side of the protocol, written from the specification of the protocol.

use serde_json::{Value, json};
use std::collections::HashMap;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::thread;
use std::time::Duration;

/// Nothing takes so long, not on a machine that does much else.
const LONGEST: Duration = Duration::from_secs(60);

pub struct Client {
    server: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    next: i64,
    /// The last diagnostics of each file.
    pub told: HashMap<String, Value>,
    versions: HashMap<String, i64>,
}

impl Client {
    /// A server to which nothing was said yet.
    pub fn spawned() -> Self {
        let mut server = Command::new(env!("CARGO_BIN_EXE_autogen"))
            .args(["lsp", "--stdio"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .expect("autogen");
        let output = server.stdout.take().expect("its output");
        let (sender, messages) = mpsc::channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = message(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        let input = server.stdin.take();
        Self { server, input, messages, next: 0, told: HashMap::new(), versions: HashMap::new() }
    }

    /// In a folder, ready for questions.
    pub fn in_folder(folder: &Path) -> Self {
        let mut client = Self::spawned();
        let answer = client.request(
            "initialize",
            json!({
                "processId": std::process::id(), "rootUri": uri(folder), "capabilities": {},
                "workspaceFolders": [{"uri": uri(folder), "name": "line"}],
            }),
        );
        assert_eq!(answer["result"]["capabilities"]["positionEncoding"], "utf-16", "{answer}");
        client.notify("initialized", json!({}));
        client
    }

    pub fn send_bytes(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().expect("its input");
        input.write_all(bytes).and_then(|()| input.flush()).expect("a server that reads");
    }

    pub fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.send_bytes(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    pub fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    /// The whole answer; diagnostics that come before it are kept.
    pub fn request(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        loop {
            let message = self.message();
            if message["id"] == id {
                return message;
            }
        }
    }

    pub fn result(&mut self, method: &str, params: Value) -> Value {
        let answer = self.request(method, params);
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    /// The next message that is no diagnostics, or that is.
    pub fn message(&mut self) -> Value {
        let message = self.messages.recv_timeout(LONGEST).expect("a message of the server");
        if message["method"] == "textDocument/publishDiagnostics" {
            let uri = message["params"]["uri"].as_str().expect("an address").to_string();
            self.told.insert(uri, message["params"].clone());
        }
        message
    }

    pub fn open(&mut self, path: &Path, text: &str) {
        let language = if path.extension().is_some_and(|e| e == "json") { "json" } else { "autogen" };
        self.versions.insert(uri(path), 1);
        self.notify(
            "textDocument/didOpen",
            json!({"textDocument": {"uri": uri(path), "languageId": language, "version": 1, "text": text}}),
        );
    }

    pub fn change(&mut self, path: &Path, text: &str) {
        let version = self.versions.get_mut(&uri(path)).expect("an open file");
        *version += 1;
        let version = *version;
        self.notify(
            "textDocument/didChange",
            json!({"textDocument": {"uri": uri(path), "version": version}, "contentChanges": [{"text": text}]}),
        );
    }

    /// The diagnostics of this version of a file that is open.
    pub fn diagnostics(&mut self, path: &Path) -> Vec<Value> {
        let uri = uri(path);
        loop {
            if let Some(told) = self.told.get(&uri)
                && told["version"].as_i64() == self.versions.get(&uri).copied()
            {
                return told["diagnostics"].as_array().expect("a list").clone();
            }
            self.message();
        }
    }

    /// Closes the input, if it is open still, and waits: the exit status.
    pub fn end(&mut self) -> i32 {
        self.input = None;
        self.server.wait().expect("a server that ends").code().expect("an exit status")
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.input = None;
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

pub fn uri(path: &Path) -> String {
    format!("file://{}", path.display())
}

/// The n-th place, from 0, at which a word stands in a text, in the protocol's terms.
pub fn place(text: &str, word: &str, n: usize) -> Value {
    let (at, _) = text.match_indices(word).nth(n).unwrap_or_else(|| panic!("`{word}` stands in the text"));
    let before = &text[..at];
    let line = before.matches('\n').count();
    let column = before[before.rfind('\n').map_or(0, |end| end + 1)..].encode_utf16().count();
    json!({"line": line, "character": column})
}

fn message(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim_end().split_once(": ") {
            Some(("Content-Length", value)) => length = value.parse().expect("a length"),
            Some(other) => panic!("a header {other:?}"),
            None => break,
        }
    }
    let mut body = vec![0; length];
    output.read_exact(&mut body).ok()?;
    Some(serde_json::from_slice(&body).expect("JSON"))
}
