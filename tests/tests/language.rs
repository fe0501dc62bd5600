//! The examples of `docs/language.md` are right, or wrong as they say; its table of devices is the simulator's.

use autogen::device::type_text;
use autogen::source::Sources;
use autogen::{check, library, spec};
use autogen_tests::{plain, root, text};
use runtime_sim::device::{Direction, Extent, PortType, Stop};
use runtime_sim::part::{ALL, Action, Form, Setting};
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
        let mut trees = autogen_tests::devices(&mut sources);
        trees.push((id, tree));
        if let Err(errors) = check::check(&sources, &trees, Some(&["bolt".to_string(), "nut".to_string()])) {
            found.extend(errors);
        }
        let codes: Vec<&str> = found.iter().map(|d| d.code).collect();
        let wanted: Vec<&str> = expected.into_iter().collect();
        assert_eq!(codes, wanted, "docs/language.md:{}\n{}", block.line, plain(&sources, &found));
    }
    assert!(blocks.len() >= 15);
}

fn devices() -> String {
    let mut out = String::new();
    for device in library::devices() {
        write!(out, "\n### {}\n\n{}\n", device.name, device.purpose).expect("text");
        if !device.ports.is_empty() {
            out += "\n| port | | type | unit | stop value | meaning |\n|---|---|---|---|---|---|\n";
        }
        for port in &device.ports {
            let (direction, stop) = match (port.direction, port.stop) {
                (Direction::Input, _) => ("in", "".to_string()),
                (Direction::Output, Stop::Hold) => ("out", "hold".into()),
                (Direction::Output, Stop::Value(v)) if port.ty == PortType::Bool => {
                    ("out", (v != 0.0).to_string())
                }
                (Direction::Output, Stop::Value(v)) => ("out", v.to_string()),
            };
            let ty = type_text(port.ty, port.extent);
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
        for verb in &device.verbs {
            let arguments = verb.arguments.join(", ");
            writeln!(out, "| `{}({arguments})` | {} | {} |", verb.name, verb.number, verb.meaning)
                .expect("text");
        }
        if !device.constants.is_empty() {
            out += "\n| constant | type | unit | meaning |\n|---|---|---|---|\n";
        }
        for constant in &device.constants {
            let ty = type_text(constant.ty, constant.extent);
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

fn primitives() -> String {
    let mut out = String::new();
    for schema in ALL {
        write!(out, "\n### {}\n\n{}\n", schema.name, schema.purpose).expect("text");
        out += "\n| setting | value | unit | meaning |\n|---|---|---|---|\n";
        for setting in schema.settings {
            let form = form_of(setting.form);
            let optional = if setting.is_optional { ", optional" } else { "" };
            let Setting { name, unit, meaning, .. } = setting;
            writeln!(out, "| `{name}` | {form}{optional} | {unit} | {meaning} |").expect("text");
        }
        let mut facts = Vec::new();
        let mut fact = |what: &str, names: Vec<String>| {
            if !names.is_empty() {
                facts.push(format!("{what}: {}.", names.join(", ")));
            }
        };
        let code = |name: &str, ty: String| format!("`{name}: {ty}`");
        fact("Frames", schema.frames.iter().map(|frame| format!("`{frame}`")).collect());
        fact("Signals", schema.signals.iter().map(|s| code(s.name, type_text(s.ty, s.extent))).collect());
        fact("Levels", schema.levels.iter().map(|l| code(l.name, type_text(l.ty, Extent::One))).collect());
        let action = |action: &Action| {
            let types = action.arguments.iter().map(|ty| type_text(*ty, Extent::One));
            format!("`{}({})`", action.name, types.collect::<Vec<_>>().join(", "))
        };
        fact("Actions", schema.actions.iter().map(action).collect());
        if !facts.is_empty() {
            write!(out, "\n{}\n", facts.join("\n\n")).expect("text");
        }
    }
    out
}

fn form_of(form: Form) -> String {
    match form {
        Form::Truth => "true or false".into(),
        Form::Number => "number".into(),
        Form::Positive => "number over 0".into(),
        Form::Point => "point".into(),
        Form::Origin => "point or frame".into(),
        Form::Frame => "frame".into(),
        Form::Axis => "axis".into(),
        Form::Direction => "axis, or z".into(),
        Form::Word => "word".into(),
        Form::Part(primitives) => primitives.join(" or "),
        Form::Range => "two numbers, the lower one first".into(),
        Form::Points => "points".into(),
        Form::Numbers => "numbers".into(),
        Form::Words => "words".into(),
        Form::Times => "time over 0, or a list of such".into(),
    }
}

/// With `UPDATE=1` in the environment the list is written anew.
#[test]
fn primitives_are_those_of_the_simulator() {
    const MARK: &str = "by a test -->\n";
    let document = text("docs/devices.md");
    let (before, after) = document.split_once(MARK).expect("the mark before the list");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(root().join("docs/devices.md"), format!("{before}{MARK}{}", primitives()))
            .expect("written");
        return;
    }
    assert!(after == primitives(), "run this test with UPDATE=1 and look at the change of docs/devices.md");
}

/// The device that the page shows has no errors, and can be given to an automaton.
#[test]
fn the_device_of_the_page_is_right() {
    let document = text("docs/devices.md");
    let shown = document.split("```").nth(1).expect("a block");
    let automaton = "automaton Stand on table { initial state S { when false -> S {} } }";
    let file = format!("{shown}\n{automaton}");
    let mut sources = Sources::default();
    let id = sources.add("devices.md", file.as_str());
    let (tree, found) = spec::parser::parse(id, &file);
    assert!(found.is_empty(), "{}", plain(&sources, &found));
    if let Err(found) = check::check(&sources, &[(id, tree)], Some(&["bolt".to_string()])) {
        panic!("{}", plain(&sources, &found));
    }
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
