//! Every diagnostic of the language, where it is expected and nowhere else.
//!
//! In a fixture `//~ E0311 part of the message` expects a diagnostic on its own
//! line, `//~^` on the line above, with one `^` more for each line further up.
//! Behind ` => ` may stand a part of its help, or of a note.

use autogen::diagnostic::Diagnostic;
use autogen::layout::Panel;
use autogen::library;
use autogen::source::Sources;
use autogen::{check, lint, overlap, spec};
use autogen_tests::instances::instantiate;
use autogen_tests::{devices, examples, is_full_campaign, own_line, plain, prototype, root};
use std::collections::BTreeSet;

/// What is wrong with a file, of the check only if the syntax is right, as the compiler does it; or its warnings.
fn read(sources: &mut Sources, name: &str, text: &str) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    let file = sources.add(name, text);
    let (tree, found) = spec::parser::parse(file, text);
    let mut trees = devices(sources);
    trees.push((file, tree));
    let checked = check::check(sources, &trees, Some(&["part".to_string()]));
    if !found.is_empty() {
        return Err(found);
    }
    Ok(lint::warnings(&checked?, &trees, Panel::Line))
}

fn diagnostics(sources: &mut Sources, name: &str, text: &str) -> Vec<Diagnostic> {
    read(sources, name, text).err().unwrap_or_default()
}

/// Line, code, a part of the message and a part of the help.
fn expectations(text: &str) -> Vec<(usize, String, String, String)> {
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let Some((_, rest)) = line.split_once("//~") else { continue };
        let up = rest.len() - rest.trim_start_matches('^').len();
        let rest = rest.trim_start_matches('^').trim();
        let (code, part) = rest.split_once(' ').unwrap_or((rest, ""));
        let (part, help) = part.split_once(" => ").unwrap_or((part, ""));
        found.push((number + 1 - up, code.to_string(), part.trim().to_string(), help.trim().to_string()));
    }
    found
}

/// Told of long texts, of what replaces the library, and of a machine: `replaced.rs`, `devices.rs`.
const ELSEWHERE: [&str; 3] = ["E0211", "E0307", "E0711"];

#[test]
fn diagnostics_stand_where_they_are_expected() {
    let (cases, codes) = compare("spec", diagnostics);
    assert!(cases >= 60, "{cases} cases");
    expected_of(&["E02", "E03", "E07"], &codes);
}

#[test]
fn warnings_stand_where_they_are_expected() {
    let (_, codes) =
        compare("warnings", |sources, name, text| read(sources, name, text).unwrap_or_else(|errors| errors));
    expected_of(&["W01"], &codes);
}

/// Each of two transitions that can fire at the same time, with values for which both can.
#[test]
fn notes_stand_where_they_are_expected() {
    let (_, codes) = compare("notes", |sources, name, text| {
        let (system, read) = instantiate(&[(name.into(), text.into())]);
        *sources = read;
        overlap::notes(&system)
    });
    expected_of(&["N01"], &codes);
}

/// The library's types, and all that is shown how to write: nothing in them is hardly meant.
#[test]
fn the_library_and_the_examples_have_no_warnings() {
    let mut all = examples();
    all.extend(["buffer", "rack", "shared_agv"].map(|folder| (folder.into(), own_line(folder))));
    for (name, texts) in all.into_iter().filter(|(name, _)| name != "prototype") {
        let outcome = texts.compile();
        assert_eq!(outcome.warnings, [], "{name}: {}", plain(&outcome.sources, &outcome.warnings));
    }
    let prototype = prototype("default").compile();
    let unhandled = prototype.warnings.iter().filter(|warning| warning.code == "W0106").count();
    assert_eq!(unhandled, 4, "{}", plain(&prototype.sources, &prototype.warnings));
}

/// There is a fixture for each code that begins so.
fn expected_of(begins: &[&str], codes: &BTreeSet<String>) {
    let text = autogen_tests::text("docs/errors.md");
    let headings = text.lines().filter_map(|l| l.strip_prefix("## ")).map(str::trim);
    let meant = headings.filter(|code| begins.iter().any(|begin| code.starts_with(begin)));
    let missing: Vec<&str> = meant.filter(|c| !codes.contains(*c) && !ELSEWHERE.contains(c)).collect();
    assert!(missing.is_empty(), "no fixture for {missing:?}");
}

/// What is told of the fixtures of a folder is what they expect: how many, and their codes.
fn compare(
    folder: &str,
    told: impl Fn(&mut Sources, &str, &str) -> Vec<Diagnostic>,
) -> (usize, BTreeSet<String>) {
    let mut wrong = Vec::new();
    let mut codes = BTreeSet::new();
    let mut cases = 0;
    for entry in
        std::fs::read_dir(root().join("tests/fixtures").join(folder)).expect("the folder of fixtures")
    {
        let path = entry.expect("an entry").path();
        let text = std::fs::read_to_string(&path).expect("a text");
        let mut sources = Sources::default();
        let mut found = told(&mut sources, &path.file_name().expect("a name").to_string_lossy(), &text);
        for (line, code, part, help) in expectations(&text) {
            cases += 1;
            codes.insert(code.clone());
            let is_meant = |d: &Diagnostic| {
                d.code == code && sources.position(d.place).0 == line && d.message.contains(&part)
            };
            match found.iter().position(is_meant) {
                Some(i) => {
                    let diagnostic = found.remove(i);
                    let told = [&diagnostic.notes[..], std::slice::from_ref(&diagnostic.help)].concat();
                    if diagnostic.help.is_empty() || !told.iter().any(|told| told.contains(&help)) {
                        wrong.push(format!("{}:{line}: {code} says {told:?}", path.display()));
                    }
                }
                None => wrong.push(format!("{}:{line}: {code} {part}: not found", path.display())),
            }
        }
        if !found.is_empty() {
            wrong.push(format!("{}: not expected\n{}", path.display(), plain(&sources, &found)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    (cases, codes)
}

/// A cell of an interface and a port or a constant of the device: both places are shown.
#[test]
fn a_cell_with_a_name_of_the_device_is_shown_with_it() {
    let text = "device thing { part b = button {}; in type: bool = b.on; constant size: real = 1.0; }
interface Shown { shared type: bool; shared size: real; }
automaton Thing on thing is Shown { initial state S { when false -> S {} } }";
    let mut sources = Sources::default();
    let found = diagnostics(&mut sources, "thing.aut", text);
    let others = |found: &Diagnostic| -> Vec<String> {
        let other = |(place, label): &(_, String)| {
            let (line, column) = sources.position(*place);
            format!("{line}:{column} {label}")
        };
        found.others.iter().map(other).collect()
    };
    let told: Vec<_> =
        found.iter().map(|found| (found.code, found.message.as_str(), others(found))).collect();
    let places = |cell: &str, device: &str| {
        vec![format!("2:{cell} the cell of the interface"), format!("1:{device} the name of the device")]
    };
    assert_eq!(
        told,
        [
            ("E0301", "`size` is already the name of a constant of the device", places("45", "67")),
            ("E0301", "`type` is already the name of a port of the device", places("26", "39")),
        ]
    );
}

/// Parses and checks; that it ends is what is tested.
fn survives(text: &str) -> usize {
    let mut sources = Sources::default();
    let found = diagnostics(&mut sources, "x.aut", text);
    plain(&sources, &found[..found.len().min(3)]);
    found.len()
}

#[test]
fn no_prefix_of_the_library_is_too_much() {
    let all: String = library::FILES.iter().map(|(_, text)| *text).collect();
    for (_, text) in library::FILES {
        // Within a word nothing else happens than at its end.
        let ends = text.char_indices().filter(|(_, c)| !c.is_alphanumeric()).map(|(end, _)| end);
        // Every eighth in the short form: the fuzzer cuts texts as well.
        for end in ends.step_by(if is_full_campaign() { 1 } else { 8 }) {
            survives(&text[..end]);
        }
    }
    assert_eq!(survives(&all), 0);
}

#[test]
fn no_change_of_the_library_is_too_much() {
    let all: String = library::FILES.iter().map(|(_, text)| *text).collect();
    let mut seed = 1_u64;
    let mut random = move |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below.max(1)
    };
    const WORDS: &[&str] = &[
        "{",
        "}",
        "(",
        ")",
        "[",
        "]",
        ";",
        ":",
        ":=",
        "->",
        "..",
        ",",
        "when",
        "state",
        "first",
        "in",
        "not",
        "-",
        "sequence",
        "else",
        "any",
        "shared",
        "automaton",
        "interface",
        "by",
        "with",
        "0",
        "2147483647",
        "1e308",
        "\"",
        "//",
        "é",
        "self",
        "Kind",
        "slot",
        "exists",
        "mod",
        "/",
        "int",
        "point",
        "token",
        "enum",
    ];
    for _ in 0..if is_full_campaign() { 8000 } else { 400 } {
        let mut words: Vec<String> = all.split_inclusive([' ', '\n']).map(String::from).collect();
        for _ in 0..=random(4) {
            let at = random(words.len());
            match random(4) {
                0 => drop(words.remove(at)),
                1 => words.insert(at, format!(" {} ", WORDS[random(WORDS.len())])),
                2 => words[at] = format!(" {} ", WORDS[random(WORDS.len())]),
                _ => {
                    let other = random(words.len());
                    words.swap(at, other);
                }
            }
        }
        survives(&words.concat());
    }
}

/// What compares the values of a `keep` is one expression, as deep as they are many.
#[test]
fn a_keep_of_many_values_is_refused() {
    let text = |many: usize| {
        format!("interface I {{ shared b: bool by owner; keep b{} while b; }}", ", b".repeat(many))
    };
    let codes = |many: usize| -> Vec<&str> {
        let mut sources = Sources::default();
        diagnostics(&mut sources, "x.aut", &text(many)).iter().map(|found| found.code).collect()
    };
    assert_eq!(codes(31), [""; 0]);
    for many in [32, 60_000] {
        assert_eq!(codes(many).first(), Some(&"E0211"));
    }
}

#[test]
fn endless_expressions_do_not_overflow_the_stack() {
    const MANY: usize = 20_000;
    let forms = [
        format!("x = {}1", "1 + ".repeat(MANY)),
        format!("x = {}1", "1 * ".repeat(MANY)),
        format!("{}true", "true and ".repeat(MANY)),
        format!("{}true", "true or ".repeat(MANY)),
        format!("{}true", "not ".repeat(MANY)),
        format!("x = {}1", "-".repeat(MANY)),
        format!("{}true{}", "(".repeat(MANY), ")".repeat(MANY)),
        "(".repeat(MANY),
        format!("x{}", ".y".repeat(MANY)),
        format!("x{}", "[0]".repeat(MANY)),
        format!("x{}", "[x".repeat(MANY)),
        format!("exists {}i in 0..1: true", "i in 0..1, ".repeat(MANY)),
        format!("{}true", "exists i in 0..1: ".repeat(MANY)),
        format!("x = {}1{}", "min(1, ".repeat(MANY), ")".repeat(MANY)),
        format!("{}true", "after ".repeat(MANY)),
    ];
    for form in forms {
        let text = format!(
            "automaton A on bin {{ local x: int 0..9; initial state S {{ when {form} -> S {{}} when oops -> S {{}} }} }}"
        );
        let mut sources = Sources::default();
        let found = diagnostics(&mut sources, "x.aut", &text);
        let codes: Vec<&str> = found.iter().map(|d| d.code).collect();
        assert_eq!(codes, ["E0211"], "{}", &form[..20]);
        let text = format!(
            "automaton A on bin {{ local x: bool; initial state S {{ when x -> S {{ x := {form}; }} }} }}"
        );
        survives(&text);
    }
    let targets = format!(
        "automaton A on bin {{ initial state S {{ when x -> S {{ x{} := 1; }} }} }}",
        "[0]".repeat(MANY)
    );
    survives(&targets);
    let types = format!("automaton A on bin {{ local x: int {}1..2; }}", "-".repeat(MANY));
    survives(&types);
}

/// The longest expression that is allowed needs no more stack than a thread has.
#[test]
fn the_longest_expression_is_checked() {
    let sum = format!("x = {}1", "1 + ".repeat(255));
    let nested = format!("{}true{}", "(not ".repeat(30), ")".repeat(30));
    let many = format!("{}true", "true and ".repeat(250));
    for form in [sum, nested, many] {
        let text = format!(
            "automaton A on bin {{ local x: int 0..9; initial state S {{ when {form} -> S {{}} }} }}"
        );
        assert_eq!(survives(&text), 0);
    }
    let mut chain = String::from("define d0 = true;\n");
    for i in 1..200 {
        chain += &format!("define d{i} = d{} and true;\n", i - 1);
    }
    let text = format!("automaton A on bin {{ {chain} initial state S {{ when true -> S {{}} }} }}");
    assert_eq!(survives(&text), 1);
}
