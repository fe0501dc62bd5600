//! The examples of `docs/language.md` are right, or wrong as they say; its table of devices is the simulator's.

use autogen::source::Sources;
use autogen::{check, spec};
use autogen_tests::{plain, root, text};
use runtime_sim::device::{DEVICES, Direction, Extent, PortType, Stop};
use std::fmt::Write;

struct Block {
    line: usize,
    kind: String,
    text: String,
}

fn blocks(text: &str) -> Vec<Block> {
    let mut found: Vec<Block> = Vec::new();
    let mut inside = false;
    for (number, line) in text.lines().enumerate() {
        match (inside, line.strip_prefix("```")) {
            (true, Some(_)) => inside = false,
            (false, Some(kind)) => {
                inside = true;
                found.push(Block { line: number + 1, kind: kind.into(), text: String::new() });
            }
            (true, None) => {
                if let Some(block) = found.last_mut() {
                    block.text += line;
                    block.text += "\n";
                }
            }
            (false, None) => {}
        }
    }
    found.retain(|b| b.kind.split(' ').next() == Some("aut"));
    found
}

#[test]
fn examples_are_as_they_say() {
    let document = text("docs/language.md");
    let blocks = blocks(&document);
    let frame = &blocks[0].text;
    let state = "initial state S { when false -> S {} }\n}\n";
    let framed = |member: &str, state: &str| {
        let end = frame.rfind("initial state S").expect("the frame ends with its state");
        format!("{}{member}{state}}}\n", &frame[..end])
    };
    let in_state = |transitions: &str| framed("", &format!("initial state S {{ {transitions} }}\n"));
    assert!(frame.ends_with(state));
    for block in &blocks {
        let kind: Vec<&str> = block.kind.split(' ').collect();
        let (file, expected) = match kind[1..] {
            [] => (block.text.clone(), None),
            ["wrong", code] => (block.text.clone(), Some(code)),
            ["library"] => (format!("{}\n{}", text("compiler/library/handover.aut"), block.text), None),
            ["item"] => (framed(&block.text, "initial state S { when false -> S {} }\n"), None),
            ["transition"] => (in_state(&block.text), None),
            ["update"] => (in_state(&format!("when true -> S {{ {} }}", block.text)), None),
            ["guard"] => (in_state(&format!("when {} -> S {{}}", block.text)), None),
            _ => panic!("line {}: what is a block `{}`?", block.line, block.kind),
        };
        let mut sources = Sources::default();
        let id = sources.add("language.md", file.as_str());
        let (tree, mut found) = spec::parser::parse(id, &file);
        if let Err(errors) = check::check(&sources, &[(id, tree)], &["bolt".to_string(), "nut".to_string()]) {
            found.extend(errors);
        }
        let codes: Vec<&str> = found.iter().map(|d| d.code).collect();
        let wanted: Vec<&str> = expected.into_iter().collect();
        assert_eq!(codes, wanted, "docs/language.md:{}\n{}", block.line, plain(&sources, &found));
    }
    assert!(blocks.len() >= 15);
}

fn type_of(ty: PortType, extent: Extent) -> String {
    let scalar = match ty {
        PortType::Bool => "bool".to_string(),
        PortType::Int { lo, hi } => format!("int {lo}..{hi}"),
        PortType::Real => "real".into(),
        PortType::Point => "point".into(),
    };
    match extent {
        Extent::One => scalar,
        Extent::PerKind => scalar + "[Kind]",
        Extent::Times(n) => format!("{scalar}[{n}]"),
    }
}

fn devices() -> String {
    let mut out = String::new();
    for device in DEVICES {
        write!(out, "\n### {}\n\n{}\n", device.name, device.purpose).expect("text");
        if !device.ports.is_empty() {
            out += "\n| port | | type | unit | stop value | meaning |\n|---|---|---|---|---|---|\n";
        }
        for port in device.ports {
            let (direction, stop) = match (port.direction, port.stop) {
                (Direction::Input, _) => ("in", "".to_string()),
                (Direction::Output, Stop::Hold) => ("out", "hold".into()),
                (Direction::Output, Stop::Value(v)) if port.ty == PortType::Bool => {
                    ("out", (v != 0.0).to_string())
                }
                (Direction::Output, Stop::Value(v)) => ("out", v.to_string()),
            };
            let ty = type_of(port.ty, port.extent);
            writeln!(
                out,
                "| `{}` | {direction} | `{ty}` | {} | {stop} | {} |",
                port.name, port.unit, port.meaning
            )
            .expect("text");
        }
        if !device.verbs.is_empty() {
            out += "\n| command | number | meaning |\n|---|---|---|\n";
        }
        for verb in device.verbs {
            let arguments = verb.arguments.join(", ");
            writeln!(out, "| `{}({arguments})` | {} | {} |", verb.name, verb.number, verb.meaning)
                .expect("text");
        }
        if !device.constants.is_empty() {
            out += "\n| constant | type | unit | meaning |\n|---|---|---|---|\n";
        }
        for constant in device.constants {
            let ty = type_of(constant.ty, constant.extent);
            writeln!(out, "| `{}` | `{ty}` | {} | {} |", constant.name, constant.unit, constant.meaning)
                .expect("text");
        }
        if !device.handovers.is_empty() {
            let places: Vec<String> = (device.handovers.iter())
                .map(|h| match h.indexed {
                    None => format!("`{}`", h.name),
                    Some(n) => format!("`{}[0]` to `{}[{}]`", h.name, h.name, n - 1),
                })
                .collect();
            write!(out, "\nParts change hands at {}.\n", places.join(", ")).expect("text");
        }
    }
    out
}

/// With `UPDATE=1` in the environment the table is written anew.
#[test]
fn devices_are_those_of_the_simulator() {
    const MARK: &str = "by a test -->\n";
    let document = text("docs/language.md");
    let (before, after) = document.split_once(MARK).expect("the mark before the table");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(root().join("docs/language.md"), format!("{before}{MARK}{}", devices()))
            .expect("written");
        return;
    }
    assert!(after == devices(), "run this test with UPDATE=1 and look at the change of docs/language.md");
}

#[test]
fn the_buffer_is_that_of_the_examples() {
    let blocks = blocks(&text("docs/language.md"));
    let shown = blocks.iter().find(|b| b.kind == "aut library").expect("the document shows the buffer");
    assert!(shown.text == text("examples/buffer/specs/buffer.aut"), "docs/language.md:{}", shown.line);
}

#[test]
fn reserved_words_are_listed() {
    let document = text("docs/language.md");
    let listed = format!("`{}`", spec::parser::RESERVED.join(" "));
    assert!(document.contains(&listed), "the words that cannot be names are {listed}");
}
