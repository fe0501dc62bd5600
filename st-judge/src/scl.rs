//! Reads the part of SCL that is generated, as objects of a dialect with structures, and these in the portable core.
//!
//! Written from the rules of SCL in TIA Portal, never from the emitter: names of a block are written `#name`, those of
//! data blocks and blocks in quotes; a constant is a name of its block; a real number without a type may have 32 bits.

mod literal;
mod token;

use crate::finding::{Finding, Span};
use crate::structured::{self, Object};
use literal::literal;
use std::collections::BTreeMap;
use token::{Kind, Token, tokens};

/// Types, and functions of the standard, that may stand in a text.
const TYPES: [&str; 3] = ["BOOL", "DINT", "LREAL"];
const STANDARD: [&str; 2] = ["DINT_TO_LREAL", "TRUNC"];
const STATEMENTS: [&str; 24] = [
    "IF",
    "THEN",
    "ELSIF",
    "ELSE",
    "END_IF",
    "CASE",
    "OF",
    "END_CASE",
    "WHILE",
    "DO",
    "END_WHILE",
    "EXIT",
    "RETURN",
    "AND",
    "OR",
    "NOT",
    "MOD",
    "DIV",
    "XOR",
    "TRUE",
    "FALSE",
    "FOR",
    "END_FOR",
    "CONTINUE",
];
/// Of the language: names only in quotes. TIA Portal colours them as keywords or types.
const WORDS: [&str; 51] = [
    "ANY",
    "ARRAY",
    "BEGIN",
    "BLOCK_DB",
    "BLOCK_FB",
    "BLOCK_FC",
    "BLOCK_SDB",
    "BOOL",
    "BY",
    "BYTE",
    "CASE",
    "CHAR",
    "CONST",
    "CONTINUE",
    "COUNTER",
    "DATA_BLOCK",
    "DATE",
    "DATE_AND_TIME",
    "DINT",
    "DO",
    "DWORD",
    "ELSE",
    "END_CONST",
    "END_DATA_BLOCK",
    "END_LABEL",
    "END_ORGANIZATION_BLOCK",
    "END_REGION",
    "END_VAR",
    "EXIT",
    "FOR",
    "FUNCTION",
    "GOTO",
    "IF",
    "INT",
    "LABEL",
    "OF",
    "OK",
    "ORGANIZATION_BLOCK",
    "REAL",
    "REGION",
    "REPEAT",
    "RETURN",
    "S5TIME",
    "STRUCT",
    "TIME",
    "TIMER",
    "TIME_OF_DAY",
    "TITLE",
    "TYPE",
    "VERSION",
    "VOID",
];
/// Each project has an organization block of this name.
const TAKEN: &str = "Main";
/// The local of the program that is set when the data block has its values.
const VALUES: &str = "values_are_set";
/// Longer names are refused by TIA Portal.
const LONGEST: usize = 128;

/// The same program in the portable core; or what is wrong with it.
pub fn portable(source: &str) -> Result<String, String> {
    let objects = objects(source).map_err(|finding| finding.located(source))?;
    let objects: Vec<Object> = objects.iter().map(|(name, text)| Object { name, text }).collect();
    structured::portable(&objects)
}

/// The objects of the source, each with its name, as another dialect with structures writes them.
fn objects(source: &str) -> Result<Vec<(String, String)>, Finding> {
    let mut reader = Reader { tokens: tokens(source)?, next: 0, end: source.len(), known: Known::default() };
    let mut blocks = Vec::new();
    while reader.next < reader.tokens.len() {
        blocks.extend(reader.unit()?);
    }
    let Known { shared: Some(shared), program: Some(program), structures, values, .. } = reader.known else {
        return Err(Finding::new("scl", Span { start: 0, end: 0 }, "no shared data block, or no instance"));
    };
    let mut objects = structures;
    for block in blocks {
        let Block { name, ty, sections, body, .. } = &block;
        let text = match *name == program {
            true => format!(
                "PROGRAM {name}\n{sections}VAR\n{VALUES} : BOOL;\nEND_VAR\n\
                 IF NOT {VALUES} THEN\n{VALUES} := TRUE;\n{values}END_IF;\n{body}\nEND_PROGRAM\n"
            ),
            false => format!("{word} {name}{ty}\n{sections}{body}\nEND_{word}\n", word = block.word),
        };
        objects.push((name.clone(), text));
    }
    let section = |keyword: &str, is_retained: bool| {
        let of = shared.iter().filter(|(_, v)| v.is_retained == is_retained);
        let lines: String = of.map(|(name, v)| format!("{name} : {}{};\n", v.ty, v.initial)).collect();
        if lines.is_empty() { lines } else { format!("{keyword}\n{lines}END_VAR\n") }
    };
    let lists = section("VAR_GLOBAL", false) + &section("VAR_GLOBAL RETAIN", true);
    objects.push((reader.known.shared_name, lists));
    Ok(objects)
}

#[derive(Default)]
struct Known {
    /// The variables of the data block that all share.
    shared: Option<BTreeMap<String, Declared>>,
    shared_name: String,
    /// Assignments that give its elements their values.
    values: String,
    /// Each with its text.
    structures: Vec<(String, String)>,
    /// Structures, functions and function blocks so far.
    blocks: Vec<String>,
    /// The block of the instance that is called.
    program: Option<String>,
}

struct Declared {
    ty: String,
    /// With its `:=`.
    initial: String,
    is_retained: bool,
}

struct Block {
    word: &'static str,
    name: String,
    /// Of a function, with its colon.
    ty: String,
    sections: String,
    body: String,
}

struct Reader<'a> {
    tokens: Vec<Token<'a>>,
    next: usize,
    end: usize,
    known: Known,
}

impl<'a> Reader<'a> {
    fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.next).copied()
    }

    fn take(&mut self) -> Result<Token<'a>, Finding> {
        let end = Span { start: self.end, end: self.end };
        let token = self.peek().ok_or_else(|| Finding::new("scl", end, "the text ends too early"))?;
        self.next += 1;
        Ok(token)
    }

    fn expect(&mut self, kind: Kind, text: &str) -> Result<(), Finding> {
        let token = self.take()?;
        if token.is(kind, text) { Ok(()) } else { Err(wrong(token, &format!("`{text}` is wanted"))) }
    }

    fn kind(&mut self, kind: Kind) -> Result<Token<'a>, Finding> {
        let token = self.take()?;
        if token.kind == kind { Ok(token) } else { Err(wrong(token, &format!("{kind:?} is wanted"))) }
    }

    fn head(&mut self) -> Result<(), Finding> {
        let attribute = self.kind(Kind::Attribute)?;
        if attribute.text.trim() != "S7_Optimized_Access := 'TRUE'" {
            return Err(wrong(attribute, "another attribute"));
        }
        self.version()
    }

    fn version(&mut self) -> Result<(), Finding> {
        self.expect(Kind::Word, "VERSION")?;
        self.expect(Kind::Symbol, ":")?;
        self.expect(Kind::Word, "0.1")
    }

    fn unit(&mut self) -> Result<Option<Block>, Finding> {
        let word = self.kind(Kind::Word)?;
        let name = self.kind(Kind::Global)?;
        if name.text.eq_ignore_ascii_case(TAKEN)
            || !is_name(name.text)
            || self.known.blocks.iter().any(|known| known.eq_ignore_ascii_case(name.text))
        {
            return Err(wrong(name, "no name, or a second block of this name"));
        }
        self.known.blocks.push(name.text.into());
        match word.text {
            "TYPE" => self.structure(name).map(|()| None),
            "DATA_BLOCK" => self.data_block(name).map(|()| None),
            "FUNCTION" => {
                self.expect(Kind::Symbol, ":")?;
                let ty = self.kind(Kind::Word)?;
                let mut block = self.block("FUNCTION", name)?;
                block.ty = format!(" : {}", ty.text);
                Ok(Some(block))
            }
            "FUNCTION_BLOCK" => self.block("FUNCTION_BLOCK", name).map(Some),
            _ => Err(wrong(word, "no block begins so")),
        }
    }

    fn structure(&mut self, name: Token) -> Result<(), Finding> {
        self.version()?;
        self.expect(Kind::Word, "STRUCT")?;
        let fields = self.declarations("END_STRUCT")?;
        self.expect(Kind::Symbol, ";")?;
        self.expect(Kind::Word, "END_TYPE")?;
        let lines: String =
            fields.iter().map(|(field, v)| format!("{field} : {}{};\n", v.ty, v.initial)).collect();
        let text = format!("TYPE {} :\nSTRUCT\n{lines}END_STRUCT;\nEND_TYPE\n", name.text);
        self.known.structures.push((name.text.into(), text));
        Ok(())
    }

    /// The one that is shared, or the instance of a block.
    fn data_block(&mut self, name: Token) -> Result<(), Finding> {
        self.head()?;
        let is_non_retain = self.peek().is_some_and(|token| token.is(Kind::Word, "NON_RETAIN"));
        self.next += usize::from(is_non_retain);
        let token = self.take()?;
        if token.kind == Kind::Global {
            if !self.known.blocks.iter().any(|known| known == token.text) || self.known.program.is_some() {
                return Err(wrong(token, "no block of this name, or a second instance"));
            }
            self.known.program = Some(token.text.into());
        } else if token.is(Kind::Word, "VAR") && self.known.shared.is_none() {
            let mut declared = BTreeMap::new();
            loop {
                let is_retained = self.is_retain();
                if is_retained && is_non_retain {
                    return Err(wrong(token, "a section that is retained, in a block that is not"));
                }
                for (name, variable) in self.declarations("END_VAR")? {
                    declared.insert(name, Declared { is_retained, ..variable });
                }
                if !self.peek().is_some_and(|token| token.is(Kind::Word, "VAR")) {
                    break;
                }
                self.next += 1;
            }
            self.known.values = self.values(&declared)?;
            (self.known.shared, self.known.shared_name) = (Some(declared), name.text.into());
            return Ok(());
        } else {
            return Err(wrong(token, "`VAR` or the name of a block is wanted"));
        }
        self.expect(Kind::Word, "BEGIN")?;
        self.expect(Kind::Word, "END_DATA_BLOCK")
    }

    /// From `BEGIN` to the end of the data block.
    fn values(&mut self, declared: &BTreeMap<String, Declared>) -> Result<String, Finding> {
        self.expect(Kind::Word, "BEGIN")?;
        let mut text = String::new();
        let mut is_first = true;
        loop {
            if self.peek().is_some_and(|token| token.is(Kind::Word, "END_DATA_BLOCK")) {
                self.next += 1;
                return Ok(text);
            }
            if is_first || text.ends_with('.') {
                let name = self.name()?;
                if is_first && !declared.contains_key(name.text) {
                    return Err(wrong(name, "not in the data block"));
                }
                text += name.text;
                is_first = false;
                continue;
            }
            let token = self.take()?;
            match token.kind {
                Kind::Symbol if ["*", "/", "+"].contains(&token.text) => {
                    return Err(wrong(token, "a start value is no expression"));
                }
                Kind::Symbol => text += token.text,
                _ => text += &literal(token)?,
            }
            is_first = token.text == ";";
            if is_first {
                text.push('\n');
            }
        }
    }

    /// A name that is declared, or one behind a point. A word of the language is in quotes.
    fn name(&mut self) -> Result<Token<'a>, Finding> {
        let token = self.take()?;
        let is_bare =
            token.kind == Kind::Word && !WORDS.iter().any(|word| word.eq_ignore_ascii_case(token.text));
        match is_name(token.text) && (is_bare || token.kind == Kind::Global) {
            true => Ok(token),
            false => Err(wrong(token, "a name is wanted; words of SCL stand in quotes")),
        }
    }

    /// `RETAIN` behind the begin of a section.
    fn is_retain(&mut self) -> bool {
        let is_retain = self.peek().is_some_and(|token| token.is(Kind::Word, "RETAIN"));
        self.next += usize::from(is_retain);
        is_retain
    }

    fn declarations(&mut self, end: &str) -> Result<Vec<(String, Declared)>, Finding> {
        let mut found: Vec<(String, Declared)> = Vec::new();
        loop {
            if self.peek().is_some_and(|token| token.is(Kind::Word, end)) {
                self.next += 1;
                return Ok(found);
            }
            let name = self.name()?;
            if found.iter().any(|(known, _)| known.eq_ignore_ascii_case(name.text)) {
                return Err(wrong(name, "declared before"));
            }
            self.expect(Kind::Symbol, ":")?;
            let mut ty = String::new();
            let mut initial = String::new();
            loop {
                let token = self.take()?;
                match (token.kind, token.text) {
                    (Kind::Symbol, ";") => break,
                    (Kind::Symbol, ":=") => initial = " := ".into(),
                    (Kind::Global, block) if self.known.blocks.iter().any(|known| known == block) => {
                        ty += block
                    }
                    (Kind::Global, _) => return Err(wrong(token, "no block of this name")),
                    _ if !initial.is_empty() => initial += &literal(token)?,
                    (Kind::Word, word) if TYPES.contains(&word) => ty += word,
                    (Kind::Word, "ARRAY") => ty += "ARRAY",
                    (Kind::Word, "OF") => ty += " OF ",
                    _ => ty += token.text,
                }
            }
            found.push((name.text.into(), Declared { ty, initial, is_retained: false }));
        }
    }

    fn block(&mut self, word: &'static str, name: Token) -> Result<Block, Finding> {
        self.head()?;
        let mut sections = String::new();
        let mut names: BTreeMap<String, Option<String>> = BTreeMap::new();
        if word == "FUNCTION" {
            names.insert(name.text.into(), None);
        }
        loop {
            let section = self.kind(Kind::Word)?;
            let keyword = match section.text {
                "BEGIN" => break,
                "VAR_INPUT" | "VAR_OUTPUT" | "VAR_IN_OUT" | "VAR" => section.text,
                "VAR_TEMP" => "VAR",
                _ => return Err(wrong(section, "no section is called so")),
            };
            let is_constant =
                section.text == "VAR" && self.peek().is_some_and(|t| t.is(Kind::Word, "CONSTANT"));
            self.next += usize::from(is_constant);
            let retain = if self.is_retain() { " RETAIN" } else { "" };
            let declared = self.declarations("END_VAR")?;
            for (name, variable) in &declared {
                let value = is_constant.then(|| variable.initial.replace(" := ", ""));
                let is_known = names.keys().any(|known| known.eq_ignore_ascii_case(name));
                if is_known || (is_constant && variable.initial.is_empty()) {
                    return Err(wrong(
                        section,
                        &format!("`{name}` is declared twice, or a constant without value"),
                    ));
                }
                names.insert(name.clone(), value);
            }
            if !is_constant {
                let lines: String =
                    declared.iter().map(|(name, v)| format!("{name} : {}{};\n", v.ty, v.initial)).collect();
                sections += &format!("{keyword}{retain}\n{lines}END_VAR\n");
            }
        }
        let body = self.body(&format!("END_{word}"), &names)?;
        Ok(Block { word, name: name.text.into(), ty: String::new(), sections, body })
    }

    fn body(&mut self, end: &str, names: &BTreeMap<String, Option<String>>) -> Result<String, Finding> {
        let mut body = String::new();
        loop {
            let token = self.take()?;
            let before = self.next.checked_sub(2).map(|i| self.tokens[i]);
            let behind = |text: &str| before.is_some_and(|before| before.is(Kind::Symbol, text));
            let mut number;
            let text = match token.kind {
                Kind::Word if token.text == end => return Ok(body),
                Kind::Local => match names.get(token.text) {
                    None => return Err(wrong(token, "not declared in this block")),
                    Some(None) => token.text,
                    Some(Some(value)) => value,
                },
                Kind::Global if token.text == self.known.shared_name => {
                    self.expect(Kind::Symbol, ".")?;
                    let name = self.name()?;
                    if !self.known.shared.as_ref().is_some_and(|shared| shared.contains_key(name.text)) {
                        return Err(wrong(name, "not in the data block"));
                    }
                    name.text
                }
                Kind::Global if behind(".") => token.text,
                // The name of an argument.
                Kind::Global
                    if (behind("(") || behind(","))
                        && self.peek().is_some_and(|t| t.is(Kind::Symbol, ":=")) =>
                {
                    token.text
                }
                Kind::Global if self.known.blocks.iter().any(|known| known == token.text) => token.text,
                Kind::Global => return Err(wrong(token, "no block of this name so far")),
                Kind::Word if behind(".") => token.text,
                Kind::Word if STATEMENTS.contains(&token.text) || STANDARD.contains(&token.text) => {
                    token.text
                }
                // The name of an argument.
                Kind::Word
                    if (behind("(") || behind(","))
                        && self.peek().is_some_and(|t| t.is(Kind::Symbol, ":=")) =>
                {
                    token.text
                }
                Kind::Word => {
                    number = literal(token)?;
                    // A product is one operand.
                    if number.contains('*') {
                        number = format!("({number})").into();
                    }
                    &number
                }
                Kind::Symbol => token.text,
                Kind::Attribute => return Err(wrong(token, "no attribute stands here")),
            };
            let is_close = ["(", "[", "."].into_iter().any(behind)
                || [".", "[", "(", ")", "]", ",", ";"].contains(&text);
            if !is_close {
                body.push(' ');
            }
            body += text;
            if text == ";" {
                body.push('\n');
            }
        }
    }
}

fn is_name(text: &str) -> bool {
    text.len() <= LONGEST && text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

fn wrong(token: Token, text: &str) -> Finding {
    Finding::new("scl", token.span, format!("`{}`: {text}", token.text))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = r#"
(* shared *)
TYPE "ST_One" VERSION : 0.1 STRUCT "timer" : DINT; far : LREAL; END_STRUCT; END_TYPE
DATA_BLOCK "Line" { S7_Optimized_Access := 'TRUE' } VERSION : 0.1 NON_RETAIN
VAR a : ARRAY[0..3] OF DINT; b : LREAL := LREAL#-1.5E-7; c : ARRAY[0..1] OF "ST_One"; END_VAR
BEGIN a[2] := 5; c[1].far := LREAL#2.5; END_DATA_BLOCK
FUNCTION "F_one" : DINT { S7_Optimized_Access := 'TRUE' } VERSION : 0.1
VAR_INPUT value : DINT; END_VAR VAR_TEMP t : DINT; END_VAR
BEGIN #t := #value; #F_one := #t + 1; END_FUNCTION
FUNCTION_BLOCK "All" { S7_Optimized_Access := 'TRUE' } VERSION : 0.1
VAR state : DINT; END_VAR VAR CONSTANT Off : DINT := 7; END_VAR
BEGIN CASE #state OF #Off: #state := "F_one"(value := #state); ELSE "Line".a[#state] := #Off; END_CASE;
IF "Line".b < LREAL#2.0 THEN "Line".c[1]."timer" := 0; END_IF; END_FUNCTION_BLOCK
DATA_BLOCK "All_DB" { S7_Optimized_Access := 'TRUE' } VERSION : 0.1 NON_RETAIN "All" BEGIN END_DATA_BLOCK
"#;

    #[test]
    fn it_says_the_same_in_the_portable_core() {
        let text = portable(SOURCE).expect("a source");
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in [
            "FUNCTION F_one : DINT VAR_INPUT value : DINT; END_VAR VAR t : DINT; END_VAR",
            "F_one := t + 1 ;",
            "PROGRAM All VAR state : DINT;",
            "VAR_EXTERNAL a : ARRAY[0..3] OF DINT; b : LREAL; c_far : ARRAY[0..1] OF LREAL;",
            "a[2] := 5; c_far[1] := 2.5;",
            "c_timer[1] := 0;",
            "7 : state := F_one(value := state);",
            "a[state] := 7;",
            "IF b < 2.0 THEN",
            "b : LREAL := -1.5E-7;",
        ] {
            assert!(words.contains(part), "{part}\n{text}");
        }
        crate::judge(&text).unwrap_or_else(|found| panic!("{}", crate::listed(&found, &text)));
    }

    #[test]
    fn what_tia_portal_would_refuse_or_take_otherwise_is_found() {
        for (from, to) in [
            ("#t := #value", "t := #value"),
            ("#t + 1", "#T + 1"),
            ("\"F_one\"(", "F_one("),
            ("\"Line\".b", "\"Line\".d"),
            ("LREAL#2.0", "2.0"),
            ("t : DINT; END_VAR", "VALUE : DINT; END_VAR"),
            ("NON_RETAIN \"All\"", "NON_RETAIN \"Other\""),
            ("FUNCTION_BLOCK \"All\"", "FUNCTION_BLOCK \"MAIN\""),
            ("VAR state : DINT;", "VAR timer : TIMER; state : DINT;"),
            ("Off : DINT := 7", "Off : DINT"),
            ("\"F_one\"(value", "\"F_two\"(value"),
            ("VERSION : 0.1 NON_RETAIN", "NON_RETAIN"),
            ("(* shared *)", "(* shared"),
            ("a[2] := 5", "d[2] := 5"),
            ("a[2] := 5", "a[2] := 5 * 2"),
            ("LREAL#2.5", "2.5"),
            ("STRUCT \"timer\"", "STRUCT timer"),
        ] {
            assert!(SOURCE.contains(from), "{from}");
            assert!(portable(&SOURCE.replacen(from, to, 1)).is_err(), "{to}");
        }
    }
}
