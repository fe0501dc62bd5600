//! Messages as they are written: a header with their length, then JSON.

use autogen::lsp::protocol::ErrorCodes;
use autogen::lsp::protocol::json_rpc::RequestObject;
use serde_json::Value;
use std::io::{self, BufRead, Read, Write};

/// Bytes of a message: a text of the largest file that is read, with each of its bytes escaped, is shorter.
const MOST_BYTES: u64 = 64_000_000;
/// Bytes of a header.
const MOST_HEADER: u64 = 8192;

/// What came from the client.
#[derive(Debug)]
pub enum Incoming {
    /// A request, or a notification, which has no number.
    Request(RequestObject),
    /// No message of the protocol; the next one can be read.
    Wrong(ErrorCodes, String),
    /// Where the next message begins cannot be known.
    Lost(String),
    /// An answer to a question of the server, which asks none.
    Answer,
    End,
}

/// The next message.
pub fn read(input: &mut impl BufRead) -> Incoming {
    match body(input) {
        Ok(Some(body)) => parsed(&body),
        Ok(None) => Incoming::End,
        Err(stop) => stop,
    }
}

fn parsed(body: &[u8]) -> Incoming {
    let json: Value = match serde_json::from_slice(body) {
        Ok(json) => json,
        Err(why) => return Incoming::Wrong(ErrorCodes::ParseError, format!("this is not JSON: {why}")),
    };
    if json.get("method").is_none() && json.get("id").is_some() {
        return Incoming::Answer;
    }
    match serde_json::from_value(json) {
        Ok(request) => Incoming::Request(request),
        Err(why) => Incoming::Wrong(ErrorCodes::InvalidRequest, format!("this is not a request: {why}")),
    }
}

/// None at the end of the input.
fn body(input: &mut impl BufRead) -> Result<Option<Vec<u8>>, Incoming> {
    let Some(length) = length(input)? else { return Ok(None) };
    if length > MOST_BYTES {
        let passed = io::copy(&mut input.take(length), &mut io::sink());
        return match passed.map_err(lost)? == length {
            true => {
                let text = format!("a message has {length} bytes, at most {MOST_BYTES} are read");
                Err(Incoming::Wrong(ErrorCodes::InvalidRequest, text))
            }
            false => Ok(None),
        };
    }
    let mut body = Vec::new();
    input.take(length).read_to_end(&mut body).map_err(lost)?;
    Ok(Some(body).filter(|body| body.len() as u64 == length))
}

/// What the header says of the body; none at the end of the input.
fn length(input: &mut impl BufRead) -> Result<Option<u64>, Incoming> {
    let mut header = input.take(MOST_HEADER);
    let mut length = None;
    loop {
        let mut line = Vec::new();
        header.read_until(b'\n', &mut line).map_err(lost)?;
        if line.is_empty() && header.limit() > 0 {
            return Ok(None);
        }
        if !line.ends_with(b"\n") {
            return match header.limit() {
                0 => Err(Incoming::Lost(format!("a header has more than {MOST_HEADER} bytes"))),
                _ => Ok(None),
            };
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end();
        if line.is_empty() {
            let lacking = || Incoming::Lost("a header has no `Content-Length`".into());
            return length.map(Some).ok_or_else(lacking);
        }
        if let Some((name, value)) = line.split_once(':')
            && name.trim().eq_ignore_ascii_case("Content-Length")
        {
            let wrong = |_| Incoming::Lost("the `Content-Length` of a header is not a number".into());
            length = Some(value.trim().parse().map_err(wrong)?);
        }
    }
}

fn lost(error: io::Error) -> Incoming {
    Incoming::Lost(error.to_string())
}

/// Writes a message with its header.
pub fn write(output: &mut impl Write, message: &Value) -> io::Result<()> {
    let body = message.to_string();
    write!(output, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::{Incoming, read};
    use autogen::lsp::protocol::ErrorCodes;

    fn all(text: &str) -> Vec<Incoming> {
        let mut input = text.as_bytes();
        let mut found = Vec::new();
        loop {
            found.push(read(&mut input));
            if let Some(Incoming::End | Incoming::Lost(_)) = found.last() {
                return found;
            }
        }
    }

    #[test]
    fn wrong_messages_are_told_and_the_next_one_is_read() {
        let good = "{\"jsonrpc\":\"2.0\",\"method\":\"exit\"}";
        let text = format!(
            "Content-Length: 3\r\n\r\n{{{{{{content-length:2\r\nContent-Type: any\r\n\r\n[]Content-Length: {}\r\n\r\n{good}",
            good.len()
        );
        let found = all(&text);
        assert!(matches!(found[0], Incoming::Wrong(ErrorCodes::ParseError, _)), "{found:?}");
        assert!(matches!(found[1], Incoming::Wrong(ErrorCodes::InvalidRequest, _)), "{found:?}");
        assert!(matches!(&found[2], Incoming::Request(request) if request.method() == "exit"), "{found:?}");
        assert!(matches!(found[3], Incoming::End), "{found:?}");
    }

    #[test]
    fn headers_are_bounded() {
        assert!(matches!(all(&"x".repeat(10_000))[0], Incoming::Lost(_)));
        assert!(matches!(all("Content-Length: -1\r\n\r\n{}")[0], Incoming::Lost(_)));
        assert!(matches!(all("Content-Type: x\r\n\r\n{}")[0], Incoming::Lost(_)));
        assert!(matches!(all("Content-Length: 99999999999\r\n\r\n{}")[0], Incoming::End));
        assert!(matches!(all("Content-Length: 5\r\n\r\n{}")[0], Incoming::End));
    }

    #[test]
    fn what_is_too_long_is_passed_over() {
        let long = 64_000_001;
        let text = format!("Content-Length: {long}\r\n\r\n{}Content-Length: 2\r\n\r\n[]", " ".repeat(long));
        let found = all(&text);
        assert!(matches!(found[0], Incoming::Wrong(ErrorCodes::InvalidRequest, _)), "{:?}", found[0]);
        assert_eq!(found.len(), 3);
    }
}
