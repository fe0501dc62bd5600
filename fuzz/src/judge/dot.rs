//! A reader of DOT, from its grammar: what Graphviz would refuse is an error.

/// Statements of a graph: how many of nodes and of edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Graph {
    pub nodes: usize,
    pub edges: usize,
}

/// Reads `digraph NAME { statements }`.
pub fn read(text: &str) -> Result<Graph, String> {
    let mut reader = Reader { tokens: tokens(text)?, at: 0 };
    reader.expect("digraph")?;
    reader.id()?;
    reader.expect("{")?;
    let mut graph = Graph::default();
    while !reader.take("}") {
        let first = reader.id()?;
        if reader.take("=") {
            reader.id()?;
        } else if reader.take("->") {
            reader.id()?;
            reader.attributes()?;
            graph.edges += 1;
        } else {
            reader.attributes()?;
            graph.nodes += usize::from(!["node", "edge", "graph"].contains(&first.as_str()));
        }
        reader.take(";");
    }
    match reader.tokens.get(reader.at) {
        None => Ok(graph),
        Some(token) => Err(format!("{token:?} behind the graph")),
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Id(String),
    Sign(&'static str),
}

fn tokens(text: &str) -> Result<Vec<Token>, String> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let length = if c.is_whitespace() {
            c.len_utf8()
        } else if let Some(sign) =
            ["->", "{", "}", "[", "]", "=", ";", ","].iter().find(|s| rest.starts_with(**s))
        {
            tokens.push(Token::Sign(sign));
            sign.len()
        } else if c == '"' {
            let length = quoted(rest).ok_or("a text without an end")?;
            tokens.push(Token::Id(rest[..length].into()));
            length
        } else {
            let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.' || c == '-';
            let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
            let word = &rest[..length];
            let is_name = !word.starts_with(|c: char| c.is_ascii_digit()) && !word.contains(['.', '-']);
            if length == 0 || !(is_name || word.parse::<f64>().is_ok()) {
                return Err(format!("`{c}` begins no token"));
            }
            tokens.push(Token::Id(word.into()));
            length
        };
        rest = &rest[length..];
    }
    Ok(tokens)
}

/// Length of a text with its quotes; a backslash belongs to what follows it.
fn quoted(rest: &str) -> Option<usize> {
    let mut is_escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            '"' => return Some(at + 1),
            '\0' => return None,
            _ => {}
        }
    }
    None
}

struct Reader {
    tokens: Vec<Token>,
    at: usize,
}

impl Reader {
    fn take(&mut self, sign: &str) -> bool {
        let found = match self.tokens.get(self.at) {
            Some(Token::Sign(own)) => *own == sign,
            Some(Token::Id(own)) => own == sign,
            None => false,
        };
        self.at += usize::from(found);
        found
    }

    fn expect(&mut self, sign: &str) -> Result<(), String> {
        match self.take(sign) {
            true => Ok(()),
            false => Err(format!("`{sign}` expected, {:?} found", self.tokens.get(self.at))),
        }
    }

    fn id(&mut self) -> Result<String, String> {
        match self.tokens.get(self.at) {
            Some(Token::Id(id)) => {
                self.at += 1;
                Ok(id.clone())
            }
            other => Err(format!("a name expected, {other:?} found")),
        }
    }

    fn attributes(&mut self) -> Result<(), String> {
        while self.take("[") {
            while !self.take("]") {
                self.id()?;
                self.expect("=")?;
                self.id()?;
                let _ = self.take(",") || self.take(";");
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Graph, read};

    #[test]
    fn graphs_are_read() {
        let text = "digraph g { rankdir = LR; node [shape = box]; \"a\\\"\" [label = \"x\\n\", w = -1.5]; a -> b [l = \"\"]; }";
        assert_eq!(read(text), Ok(Graph { nodes: 1, edges: 1 }));
    }

    #[test]
    fn what_is_no_graph_is_refused() {
        for text in [
            "",
            "digraph",
            "digraph g {",
            "digraph g { a -> }",
            "digraph g { a [b] }",
            "digraph g { \"a }",
            "digraph g { a -> b } c",
            "graph g { }",
            "digraph g { 1a }",
            "digraph g { a [l = \"\"\"] }",
            "digraph g { & }",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
