//! One way to write a specification. Lines are broken where they were; what stands between the words of a line, how
//! far it is indented and how many blank lines there are is decided here. Comments stay where they are.

use super::lexer::{self, Token};
use super::parser;
use crate::diagnostic::Diagnostic;
use crate::source::FileId;

const INDENT: usize = 4;

/// The text as it should be, with the same tokens; a text with errors is refused.
pub fn format(file: FileId, text: &str) -> Result<String, Vec<Diagnostic>> {
    let (_, found) = parser::parse(file, text);
    if !found.is_empty() {
        return Err(found);
    }
    let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let mut writer = Writer { end, ..Writer::default() };
    for piece in pieces(file, text) {
        writer.piece(piece);
    }
    Ok(writer.finish())
}

/// A token or a comment, as it is written.
#[derive(Clone, Copy)]
struct Piece<'t> {
    kind: Kind,
    text: &'t str,
    /// Ends of lines before it.
    lines: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Word,
    /// A number or a text.
    Literal,
    Sign(&'static str),
    /// A comment or a description, to the end of its line.
    Comment,
}

fn pieces(file: FileId, text: &str) -> Vec<Piece<'_>> {
    let (tokens, _) = lexer::tokens(file, text, parser::MOST_TOKENS + 1);
    let mut found = Vec::new();
    let mut at = 0;
    let mut lines = 0;
    for (token, span) in tokens {
        let (start, end) = (span.start as usize, span.end as usize);
        let gap_end = if token == Token::End { text.len() } else { start };
        comments(&text[at..gap_end], &mut lines, &mut found);
        let kind = match token {
            Token::End => break,
            Token::Word(_) => Kind::Word,
            Token::Int(_) | Token::Real(_) | Token::Text(_) => Kind::Literal,
            Token::Doc(_) => Kind::Comment,
            Token::Sign(sign) => Kind::Sign(sign),
        };
        found.push(Piece { kind, text: text[start..end].trim_end(), lines });
        lines = 0;
        at = end;
    }
    found
}

/// The comments between two tokens; `lines` counts the ends of lines since the last piece.
fn comments<'t>(gap: &'t str, lines: &mut usize, found: &mut Vec<Piece<'t>>) {
    for line in gap.split_inclusive('\n') {
        if let Some(start) = line.find("//") {
            found.push(Piece { kind: Kind::Comment, text: line[start..].trim_end(), lines: *lines });
            *lines = 0;
        }
        *lines += usize::from(line.ends_with('\n'));
    }
}

/// A bracket that is open.
struct Open {
    /// Of the line on which it was opened.
    indent: usize,
    /// Its lines are elements of a list and not statements.
    is_list: bool,
    /// A statement was begun in it, and is not at its end.
    in_statement: bool,
}

#[derive(Default)]
struct Writer<'t> {
    out: String,
    end: &'static str,
    open: Vec<Open>,
    /// A statement of the file was begun outside of all brackets.
    in_statement: bool,
    /// Of the present line.
    indent: usize,
    before: Option<Piece<'t>>,
    before_that: Option<Piece<'t>>,
    /// The last sign was a minus with one operand.
    is_signed: bool,
}

impl<'t> Writer<'t> {
    fn piece(&mut self, piece: Piece<'t>) {
        match self.before {
            None => self.begin_line(piece),
            Some(_) if piece.lines > 0 => {
                self.out.push_str(self.end);
                if piece.lines > 1 && self.may_be_blank(piece) {
                    self.out.push_str(self.end);
                }
                self.begin_line(piece);
            }
            Some(before) => {
                let gap = self.gap(before, piece);
                self.out.push_str(&" ".repeat(gap));
            }
        }
        self.is_signed = piece.kind == Kind::Sign("-") && self.is_operand_next();
        self.out.push_str(piece.text);
        self.follow(piece);
        self.before_that = self.before;
        self.before = Some(piece);
    }

    fn finish(mut self) -> String {
        if !self.out.is_empty() {
            self.out.push_str(self.end);
        }
        self.out
    }

    /// No blank line behind an opening brace and before a closing one.
    fn may_be_blank(&self, piece: Piece) -> bool {
        let is_opening = |piece: Piece| matches!(piece.kind, Kind::Sign("{" | "(" | "["));
        let is_closing = matches!(piece.kind, Kind::Sign("}" | ")" | "]"));
        !self.before.is_some_and(is_opening) && !is_closing
    }

    fn begin_line(&mut self, piece: Piece) {
        let (inner, is_list, in_statement) = match self.open.last() {
            Some(open) => (open.indent + INDENT, open.is_list, open.in_statement),
            None => (0, false, self.in_statement),
        };
        let goes_on = in_statement && !is_list && !matches!(piece.kind, Kind::Sign("{"))
            || piece.kind == Kind::Word && piece.text == "else"
            || piece.kind == Kind::Sign("->");
        self.indent = match piece.kind {
            Kind::Sign("}" | ")" | "]") => self.open.last().map_or(0, |open| open.indent),
            _ if goes_on => inner + INDENT,
            _ => inner,
        };
        self.out.push_str(&" ".repeat(self.indent));
    }

    fn follow(&mut self, piece: Piece<'t>) {
        match piece.kind {
            Kind::Comment => return,
            Kind::Sign(sign @ ("{" | "(" | "[")) => {
                let is_list = sign != "{" || self.lists();
                self.open.push(Open { indent: self.indent, is_list, in_statement: false });
                return;
            }
            Kind::Sign(sign @ ("}" | ")" | "]")) => {
                self.open.pop();
                if sign == "}" {
                    // What follows on its line goes on with it.
                    self.set_statement(false);
                    return;
                }
            }
            Kind::Sign(";") => {
                self.set_statement(false);
                return;
            }
            _ => {}
        }
        self.set_statement(true);
    }

    fn set_statement(&mut self, in_statement: bool) {
        match self.open.last_mut() {
            Some(open) => open.in_statement = in_statement,
            None => self.in_statement = in_statement,
        }
    }

    /// Whether the brace that comes next holds elements with commas between them: of an enumeration or a token.
    fn lists(&self) -> bool {
        let word = |piece: Option<Piece>| match piece {
            Some(Piece { kind: Kind::Word, text, .. }) => text.to_string(),
            _ => String::new(),
        };
        word(self.before) == "token" || word(self.before_that) == "enum"
    }

    /// Whether an operand comes next, and no operator.
    fn is_operand_next(&self) -> bool {
        match self.before.map(|before| (before.kind, before.text)) {
            None => true,
            Some((Kind::Word, text)) => is_operator(text) || matches!(text, "int" | "stop"),
            Some((Kind::Sign(sign), _)) => !matches!(sign, ")" | "]" | "}"),
            Some((Kind::Literal | Kind::Comment, _)) => false,
        }
    }

    /// Blanks between two pieces of a line.
    fn gap(&self, before: Piece, piece: Piece) -> usize {
        use Kind::{Comment, Literal, Sign, Word};
        if piece.kind == Comment {
            return 2;
        }
        if self.is_signed && before.kind == Sign("-") {
            return 0;
        }
        let is_member = self.before_that.is_some_and(|that| that.kind == Sign("."));
        usize::from(match (before.kind, piece.kind) {
            (_, Sign("," | ";" | ":" | ")" | "]" | "." | "..")) => false,
            (Sign("(" | "[" | "." | ".."), _) => false,
            (Sign("{"), Sign("}")) => false,
            (Word, Sign("(")) => is_operator(before.text) && !is_member,
            (Word | Literal | Sign(")" | "]"), Sign("[")) => false,
            _ => true,
        })
    }
}

/// A word behind which an operand stands, so that a parenthesis behind it is none of a call.
fn is_operator(word: &str) -> bool {
    let words = [
        "after",
        "and",
        "approach",
        "by",
        "else",
        "in",
        "invariant",
        "keep",
        "mod",
        "most",
        "not",
        "or",
        "reaches",
        "require",
        "then",
        "to",
        "until",
        "wait",
        "when",
        "whenever",
        "while",
        "with",
        "within",
    ];
    words.contains(&word)
}
