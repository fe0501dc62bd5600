//! What is no message, comes at the wrong time, or is too large.

use super::client::{Client, uri};
use super::{new_line, read};
use serde_json::{Value, json};

#[test]
fn a_session_begins_and_ends_in_order() {
    let mut client = Client::spawned();
    let early = client.request("textDocument/hover", json!({}));
    assert_eq!(early["error"]["code"], -32002, "{early}");
    client.request("initialize", json!({"processId": null, "rootUri": null, "capabilities": {}}));
    let twice = client.request("initialize", json!({}));
    assert_eq!(twice["error"]["code"], -32600, "{twice}");
    assert_eq!(client.request("shutdown", Value::Null)["result"], Value::Null);
    let late = client.request("textDocument/hover", json!({}));
    assert_eq!(late["error"]["code"], -32600, "{late}");
    client.notify("exit", Value::Null);
    assert_eq!(client.end(), 0);
}

#[test]
fn an_end_without_a_shutdown_is_a_failure() {
    let mut client = Client::spawned();
    client.notify("exit", Value::Null);
    assert_eq!(client.end(), 1);
    let mut client = Client::in_folder(&new_line("ended"));
    assert_eq!(client.end(), 1);
    // A shutdown without an exit: it waits for one, and ends well with its input.
    let mut client = Client::in_folder(&new_line("waits"));
    client.result("shutdown", Value::Null);
    assert_eq!(client.end(), 0);
}

#[test]
fn wrong_messages_are_answered_and_change_nothing() {
    let mut client = Client::in_folder(&new_line("wrong"));
    client.send_bytes(b"Content-Length: 9\r\n\r\n{\"id\": 1,");
    assert_eq!(client.message()["error"]["code"], -32700);
    client.send_bytes(b"Content-Length: 2\r\n\r\n\xff\xfe");
    assert_eq!(client.message()["error"]["code"], -32700);
    client.send(&json!([1, 2]));
    assert_eq!(client.message()["error"]["code"], -32600);
    client.send(&json!({"jsonrpc": "1.0", "id": 7, "method": "shutdown"}));
    assert_eq!(client.message()["error"]["code"], -32600);
    let deep = "[".repeat(100_000);
    client.send_bytes(format!("Content-Length: {}\r\n\r\n{deep}", deep.len()).as_bytes());
    assert_eq!(client.message()["error"]["code"], -32700);
    assert_eq!(client.request("no/such/method", json!({}))["error"]["code"], -32601);
    assert_eq!(client.request("$/optional", json!({}))["error"]["code"], -32601);
    assert_eq!(client.request("textDocument/formatting", json!({"a": 1}))["error"]["code"], -32602);
    client.notify("no/such/notification", json!({}));
    client.notify("textDocument/didOpen", json!({"textDocument": 1}));
    client.notify(
        "textDocument/didChange",
        json!({"textDocument": {"uri": "file:///none", "version": 1}, "contentChanges": []}),
    );
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": "untitled:1"}}));
    client.send(&json!({"jsonrpc": "2.0", "id": 3, "result": null}));
    assert_eq!(client.result("shutdown", Value::Null), Value::Null);
}

#[test]
fn where_no_message_begins_the_server_ends() {
    for bytes in ["Content-Length: many\r\n\r\n{}", "Content-Type: x\r\n\r\n{}", &"x".repeat(9000)] {
        let mut client = Client::in_folder(&new_line("lost"));
        client.send_bytes(bytes.as_bytes());
        assert_eq!(client.message()["error"]["code"], -32700);
        assert_eq!(client.end(), 1);
    }
    // More bytes than anybody has: they are awaited, not kept.
    let mut client = Client::in_folder(&new_line("huge"));
    client.send_bytes(b"Content-Length: 18446744073709551615\r\n\r\n{}");
    assert_eq!(client.end(), 1);
}

#[test]
fn cancelling_leaves_the_server_at_work() {
    let folder = new_line("cancelled");
    let file = folder.join("specs/stamp.aut");
    let mut client = Client::in_folder(&folder);
    client.open(&file, &read(&file));
    let params =
        json!({"textDocument": {"uri": uri(&file)}, "options": {"tabSize": 4, "insertSpaces": true}});
    client.send(&json!({"jsonrpc": "2.0", "id": "a", "method": "textDocument/formatting", "params": params}));
    client.notify("$/cancelRequest", json!({"id": "a"}));
    let answer = loop {
        let message = client.message();
        if message["id"] == "a" {
            break message;
        }
    };
    // It is answered already, or not begun any more.
    assert!(answer["error"]["code"] == -32800 || answer["result"].is_array(), "{answer}");
    client.notify("$/cancelRequest", json!({"id": "nobody"}));
    client.result("shutdown", Value::Null);
}

#[test]
fn a_text_that_is_too_large_is_refused() {
    let folder = new_line("large");
    let file = folder.join("specs/stamp.aut");
    let mut client = Client::in_folder(&folder);
    client.open(&file, &"// x\n".repeat(2_000_001));
    let found = client.diagnostics(&file);
    let text = found[0]["message"].as_str().expect("a text");
    assert!(text.contains("larger than 10 MB"), "{text}");
    client.change(&file, &"// x\n".repeat(100));
    let found = client.diagnostics(&file);
    assert!(found.is_empty(), "{found:?}");
}
