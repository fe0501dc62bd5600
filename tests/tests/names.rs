//! Names of a specification that are also names in generated Rust: every one of them, for everything that has a name.

use autogen::backend::{Files, dot, rust};
use autogen::ir::System;
use autogen::layout::Panel;
use autogen::naming::camel;
use autogen::source::{FileId, Sources};
use autogen::spec::parser;
use autogen_tests::instances::panelled;
use autogen_tests::{Texts, ariac, fixtures, many, own_line, with_panels};
use std::collections::BTreeSet;

const DEVICE: &str = "device unit {
    part pedal = button {};
    part motor = lamp { at: pose; colour: green; };
    in unit_wanted: bool = pedal.on;
    out unit_turns: bool = motor.on stop false;
}
";

/// The words of the code of a line that a specification can have as names.
fn names_in(files: &Files) -> BTreeSet<String> {
    let is_own = |path: &str| path.starts_with("controllers/") || path.starts_with("adapters/");
    let own = files.iter().filter(|(path, _)| is_own(path) && path.ends_with(".rs"));
    let code = own.flat_map(|(_, text)| text.lines()).filter(|line| !line.trim_start().starts_with("//"));
    // Without texts.
    let code = code.flat_map(|line| line.split('"').step_by(2));
    let words = code.flat_map(|part| part.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'));
    let words: BTreeSet<&str> = words.filter(|word| word.starts_with(char::is_alphabetic)).collect();
    words.into_iter().filter(|word| is_name(word)).map(String::from).collect()
}

/// The names of generated code that are not those of one line: those of the fixtures and of an example, or of two
/// types that differ in their name only.
fn names_of_all_lines() -> BTreeSet<String> {
    let of = |system: &System, sources: &Sources| names_in(&rust::files(system, sources));
    let of_fixtures = |panel: Panel| {
        let (system, sources) = panelled(&fixtures("rust", "aut"), panel);
        of(&system, &sources)
    };
    let of_line = |texts: Texts| {
        let outcome = texts.compile();
        of(&outcome.project.expect("a line that is right").system, &outcome.sources)
    };
    let of_type = |name: &str| {
        let name = BTreeSet::from([name.to_string()]);
        let (system, sources) = line(types(&name), &name);
        of(&system, &sources)
    };
    let examples = || [ariac("default"), own_line("rack")].into_iter();
    let plain = &of_fixtures(Panel::Line) & &examples().flat_map(of_line).collect();
    let panelled = &of_fixtures(Panel::Machines) & &examples().map(with_panels).flat_map(of_line).collect();
    let types = &of_type("Alpha") & &of_type("Omega");
    [plain, panelled, types].into_iter().flatten().collect()
}

/// Whether the language has no other meaning for it.
fn is_name(word: &str) -> bool {
    let text = format!(
        "automaton A on bin {{ local {word}: bool; initial -> {word} {{}} state {word} {{ when {word} -> {word} {{}} }} }}"
    );
    let (_, found) = parser::parse(FileId(0), &text);
    found.is_empty()
}

/// A type of machine of each name, with an interface of its own.
fn types(names: &BTreeSet<String>) -> String {
    // The scenario declares the kinds.
    let names: BTreeSet<String> =
        names.iter().map(|name| camel(name)).filter(|name| name != "Kind").collect();
    let next = names.iter().cycle().skip(1);
    let ty = |(name, next): (&String, &String)| {
        format!(
            "automaton {name} on unit {{
                retain all;
                local n: int 0..9;
                local r: {name};
                shared c: int 0..9 by counter;
                parameter p: real := 1.5;
                knows others: {next}[];
                initial -> A {{}}
                state A {{
                    when first o in others with o.c > 2 and unit_wanted and o.p > p and (exists q in 0..3: q = o.c) -> B {{
                        n := min(n + 1, 9); o.c += 1; unit_turns := true; r := self;
                    }}
                }}
                state B within 10 s {{ when r.c = 0 -> A {{ unit_turns := false; }} }}
                invariant n < 9 else warn \"all nine\";
                invariant n < 8 or not unit_turns else stop machine \"it turns\";
            }}
            "
        )
    };
    names.iter().zip(next).map(ty).collect()
}

/// Everything within a type, of each name that neither a port of the device nor the language has.
fn members(names: &BTreeSet<String>) -> String {
    let is_free = |name: &&String| {
        let is_port = name.starts_with("unit_") || name.starts_with("panel_");
        !is_port && !["self", "Initial", "Kind"].contains(&name.as_str())
    };
    let names: BTreeSet<&String> = names.iter().filter(is_free).collect();
    let each = |piece: &dyn Fn(&str) -> String| names.iter().map(|name| piece(name)).collect::<String>();
    let automaton = |head: &str, declared: &dyn Fn(&str) -> String, transition: &dyn Fn(&str) -> String| {
        format!(
            "automaton {head} {{
                local sum_of_all: int 0..11;
                {}
                initial -> First {{}}
                state First {{ {} }}
                invariant sum_of_all < 9 or not unit_turns else stop machine \"it turns\";
            }}\n",
            each(declared),
            each(transition)
        )
    };
    let mut text = String::new();
    text += &automaton("Locals on unit", &|n| format!("local {n}: int 0..9;\n"), &|n| {
        format!("when {n} > 5 and unit_wanted -> First {{ {n} += 1; unit_turns := true; }}\n")
    });
    text += &automaton("Parameters on unit", &|n| format!("parameter {n}: int 0..9 := 2;\n"), &|n| {
        format!("when {n} > sum_of_all -> First {{ sum_of_all := {n}; }}\n")
    });
    text +=
        &automaton("Defines on unit", &|n| format!("define {n} = sum_of_all > 3 and unit_wanted;\n"), &|n| {
            format!("when {n} -> First {{ sum_of_all := 1; }}\n")
        });
    // A device is not as long as they would make it.
    let all: Vec<&String> = names.iter().copied().collect();
    for (number, ports) in all.chunks(100).enumerate() {
        let declared: String = ports.iter().map(|n| format!("in {n}: bool = pedal.on;\n")).collect();
        let read: String = ports.iter().map(|n| format!("when {n} -> First {{}}\n")).collect();
        text += &format!(
            "device ports{number} {{ part pedal = button {{}}; {declared} }}
            automaton Ports{number} on ports{number} {{ initial -> First {{}} state First {{ {read} }} }}\n"
        );
    }
    let cells = each(&|n| format!("shared {n}: int 0..9 by counter;\n"));
    let shown = each(&|n| format!("parameter {n}: int 0..9;\n"));
    text += &format!("interface Shelf {{ {cells} }}\ninterface Sign {{ {shown} }}\n");
    text += &automaton("Shelves on unit is Shelf", &|_| String::new(), &|n| {
        format!("when {n} > 3 -> First {{ {n} := 0; }}\n")
    });
    text += &automaton("Signs on unit is Sign", &|n| format!("parameter {n}: int 0..9 := 1;\n"), &|_| {
        "when unit_wanted -> First {}\n".into()
    });
    text += &automaton("Readers on unit", &|n| format!("knows {n}: Shelf[];\nknows s{n}: Sign[];\n"), &|n| {
        format!(
            "when first shelf in {n} with shelf.{n} > 3, first sign in s{n} with sign.{n} > 2 -> First {{
                shelf.{n} += sign.{n}; sum_of_all := sign.{n};
            }}\n"
        )
    });
    text += &automaton("Binders on unit", &|_| String::new(), &|n| {
        format!(
            "when first {n} in 0..9 with {n} > sum_of_all and (exists x{n} in 0..3: x{n} = {n}),
                least y{n} in {n}..9 by y{n} * 2 with y{n} mod 2 = 1 -> First {{ sum_of_all := y{n}; }}\n"
        )
    });
    text += &format!("enum Colour {{ First_Colour {} }}\n", each(&|n| format!(", {n}")));
    text += "automaton Colours on unit { local c: Colour; local many: int 0..3[Colour]; initial -> First {} state First {\n";
    text += &each(&|n| format!("when c = Colour.{n} -> First {{ many[Colour.{n}] := 2; }}\n"));
    text += "} }\n";
    let states = each(&|n| format!("state {n} {{ when after 1 s -> First {{}} }}\n"));
    text +=
        &format!("automaton States on unit {{ initial -> First {{}} state First {{ {} }}\n{states} }}\n", {
            each(&|n| format!("when unit_wanted -> {n} {{}}\n"))
        });
    text
}

/// A line of such types, with panels, whose machines have these names too.
fn line(text: String, names: &BTreeSet<String>) -> (System, Sources) {
    let (mut system, sources) =
        panelled(&[("names.aut".into(), DEVICE.to_string() + &text)], Panel::Machines);
    for (instance, name) in system.instances.iter_mut().zip(names.iter().cycle()) {
        instance.name.clone_from(name);
    }
    (system, sources)
}

#[test]
fn all_names_of_generated_code_may_be_those_of_a_specification() {
    let names = names_of_all_lines();
    let is_known = |name: &&str| names.contains(*name);
    assert!(
        ["reader", "rows", "Reader", "wiring", "u64", "retain", "alarms", "begin_anew"].iter().all(is_known),
        "{}: {names:?}",
        names.len()
    );
    let lines = [line(types(&names), &names), line(members(&names), &names)];
    let lines: Vec<(&System, &Sources)> = lines.iter().map(|(system, sources)| (system, sources)).collect();
    let workspace = many::workspace("names", &lines);
    let crates = ["controllers-0", "adapters-0", "controllers-1", "adapters-1"];
    let crates: Vec<&str> = crates.iter().flat_map(|name| ["-p", name]).collect();
    workspace.cargo(&[&["clippy", "--quiet"], &crates[..], &["--", "-D", "warnings"]].concat());
}

/// Devices have these names on Windows, whatever ends a name.
#[test]
fn no_file_has_the_name_of_a_device() {
    let names = ["Aux", "Con", "Nul", "Prn", "Com1", "Lpt9"];
    let robot = |name: &&str| format!(r#"{{"name": "the_{name}", "type": "{name}", "pose": [0, 0, 0]}}"#);
    let automaton = |name: &&str| {
        format!(
            "device d{name} {{ part lamp = button {{}}; in on: bool = lamp.on; }}
            automaton {name} on d{name} {{ initial -> A {{}} state A {{ when on -> A {{}} }} }}"
        )
    };
    let texts = Texts {
        layout: format!(r#"{{"robots": [{}]}}"#, names.iter().map(robot).collect::<Vec<_>>().join(", ")),
        specs: names.iter().map(automaton).collect(),
        ..Texts::default()
    };
    let outcome = texts.compile();
    let project = outcome.project.expect("a line");
    let (rust, graphs) = (rust::files(&project.system, &outcome.sources), dot::files(&project));
    let stems =
        rust.keys().chain(graphs.keys()).filter_map(|path| path.rsplit('/').next()?.split('.').next());
    let stems: Vec<&str> = stems.collect();
    for name in names.map(str::to_ascii_lowercase) {
        assert!(!stems.contains(&&name[..]), "{name}: {:?}", rust.keys());
        // A module, a file of its machines and a graph.
        assert_eq!(stems.iter().filter(|stem| **stem == format!("{name}_")).count(), 3, "{name}: {stems:?}");
    }
}
