//! The generated Structured Text: how it reads, that an independent grammar takes it, and that the XML has
//! the same text.

use autogen::backend::Files;
use autogen::backend::{rust, st};
use autogen::io_map::IoMap;
use autogen::ir::System;
use autogen::source::Sources;
use autogen_st_judge::dead::dead;
use autogen_st_judge::view::Section;
use autogen_st_judge::{judge, listed};
use autogen_tests::instances::instantiate;
use autogen_tests::{LAYOUTS, Texts, ariac, root, text};
use tree_sitter::{Node, Parser};

/// Names and texts of the fixtures, which show one construct each.
fn fixtures() -> Vec<(String, String)> {
    let mut names: Vec<String> = std::fs::read_dir(root().join("tests/fixtures/rust"))
        .expect("a folder of fixtures")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names.into_iter().map(|name| (name.clone(), text(&format!("tests/fixtures/rust/{name}")))).collect()
}

fn of_fixture(name: &str, text: &str) -> Files {
    let (system, sources) = instantiate(&[(name.into(), text.into())]);
    files(&system, &sources)
}

fn of_layout(layout: &str) -> Files {
    let outcome = ariac(layout).compile();
    let project = outcome.project.expect("a layout that can be built");
    files(&project.system, &outcome.sources)
}

/// With those that are written on demand.
fn files(system: &System, sources: &Sources) -> Files {
    let mut files = st::files(system, sources);
    files.extend(st::plcopen(system, sources, &IoMap::default()));
    files
}

/// The function blocks of types, without what differs between layouts.
fn blocks(main: &str) -> String {
    let units = main.split("\n(* FB_").skip(1).filter(|unit| !unit.starts_with("Layout"));
    let ends = units.filter_map(|unit| unit.split_once("END_FUNCTION_BLOCK").map(|(text, _)| text));
    ends.map(|text| format!("(* FB_{text}END_FUNCTION_BLOCK\n")).collect::<Vec<_>>().join("\n")
}

#[test]
fn fixtures_read_well() {
    for (name, text) in fixtures() {
        let files = of_fixture(&name, &text);
        let shown = format!("{text}\n---- portable/main.st\n{}", blocks(&files["portable/main.st"]));
        insta::assert_snapshot!(name.trim_end_matches(".aut"), shown);
    }
}

#[test]
fn the_agv_reads_well_in_all_dialects() {
    let files = of_layout("default");
    let main = &files["portable/main.st"];
    let agv = main.split("\n(* FB_Agv").nth(1).and_then(|text| text.split("END_FUNCTION_BLOCK").next());
    insta::assert_snapshot!("agv_portable", agv.expect("the block of the AGV"));
    insta::assert_snapshot!("agv_codesys", files["codesys/FB_Agv.st"]);
    let scl =
        files["siemens/main.scl"].split("\n(* FB_Agv").nth(1).and_then(|text| text.split("\n\n").next());
    insta::assert_snapshot!("agv_siemens", scl.expect("the block of the AGV"));
}

#[test]
fn names_that_could_not_stay_are_listed() {
    let names = fixtures().into_iter().filter_map(|(name, text)| {
        let table = of_fixture(&name, &text).remove("names.csv")?;
        Some(format!("---- {name}\n{table}"))
    });
    insta::assert_snapshot!("names_csv", names.collect::<Vec<_>>().join("\n"));
}

#[test]
fn alarms_say_who_raises_them_and_where() {
    let alarms: Vec<String> = (fixtures().iter())
        .map(|(name, text)| format!("---- {name}\n{}", of_fixture(name, text)["alarms.csv"]))
        .collect();
    insta::assert_snapshot!("alarms_csv", alarms.join("\n"));
}

/// The numbers are those of the text, which has them in comments.
#[test]
fn states_have_their_numbers_in_a_table() {
    let files = of_layout("default");
    for row in files["states.csv"].lines().skip(1) {
        let fields: Vec<&str> = row.split(',').collect();
        let [ty, _, number, state, ..] = fields[..] else { panic!("{row}") };
        let block = &files[&format!("codesys/FB_{ty}.st")];
        assert!(block.contains(&format!("(* {number} {state}")), "{row}\n{block}");
        let members = &files[&format!("codesys/E_{ty}State.st")];
        assert!(members.contains(&format!(" {} := {number}", state.replace('.', "_"))), "{row}\n{members}");
    }
    insta::assert_snapshot!("states_csv", files["states.csv"]);
}

#[test]
fn a_robot_has_one_number_in_all_texts() {
    let outcome = ariac("default").compile();
    let system = outcome.project.expect("a layout that can be built").system;
    let alarms = &st::files(&system, &outcome.sources)["alarms.csv"];
    let rust = rust::files(&system, &outcome.sources);
    for (number, instance) in system.instances.iter().enumerate() {
        let name = &instance.name;
        assert!(alarms.contains(&format!("{number} {name}")), "{alarms}");
        let ty = system.automaton_of(number).name.to_lowercase();
        let text = &rust[&format!("controllers/src/robots/{ty}.rs")];
        assert!(text.contains(&format!("/// `{name}`: number {number} in the order of the steps")), "{text}");
    }
}

/// Tables name all rows. What refers to a row names all of them as long as there are few.
#[test]
fn what_refers_to_a_row_of_many_names_some() {
    let spec = "device unit { part button = button {}; in pressed: bool = button.on; }
        automaton Unit on unit {
            knows others: Unit[];
            shared free: bool := false;
            local other: Unit;
            initial -> Waiting {}
            state Waiting { when pressed, first o in others with o.free -> Waiting { other := o; } when other.free { free := true; } }
        }";
    let main = |count: usize| {
        let robot = |i| format!(r#"{{"name": "u{i}", "type": "unit", "pose": [{i}, 0, 0]}}"#);
        let robots = (0..count).map(robot).collect::<Vec<_>>().join(", ");
        let texts = Texts {
            layout: format!(r#"{{"robots": [{robots}]}}"#),
            specs: vec![spec.into()],
            scenario: Some(r#"{"time_limit_s": 9}"#.into()),
            ..Texts::default()
        };
        let outcome = texts.compile();
        let found = autogen_tests::plain(&outcome.sources, &outcome.diagnostics);
        let project = outcome.project.unwrap_or_else(|| panic!("{found}"));
        files(&project.system, &outcome.sources).remove("portable/main.st").expect("a text")
    };
    let all = |count: usize| (0..count).map(|i| format!("{i} u{i}")).collect::<Vec<_>>().join(", ");
    assert!(main(50).contains(&format!("other : DINT; (* {} *)", all(50))));
    let many = main(51);
    assert!(many.contains(&format!("unit_free : ARRAY[0..50] OF BOOL; (* {} *)", all(51))), "{many}");
    assert!(many.contains("other : DINT; (* 0 u0, 1 u1, 2 u2, ... 50 u50 *)"), "{many}");
}

#[test]
fn every_file_but_a_table_says_that_it_is_no_safety_function() {
    for (name, files) in all_files() {
        for (path, text) in files.iter().filter(|(path, _)| !path.ends_with(".csv")) {
            assert!(text.to_lowercase().contains("not a safety function"), "{name}: {path}");
        }
    }
}

#[test]
fn a_line_without_ports_has_a_header() {
    let (mut system, sources) = instantiate(&[fixtures().swap_remove(0)]);
    system.instances.clear();
    let main = &st::files(&system, &sources)["portable/main.st"];
    assert!(main.contains("in layout order; each makes at most one transition.\n   Shared cells"), "{main}");
}

fn errors(node: Node, found: &mut Vec<String>) {
    if node.is_error() || node.is_missing() {
        let at = node.start_position();
        return found.push(format!("{}:{}: {}", at.row + 1, at.column + 1, node.kind()));
    }
    let mut cursor = node.walk();
    node.children(&mut cursor).for_each(|child| errors(child, found));
}

fn parse(path: &str, text: &str) {
    let mut parser = Parser::new();
    parser.set_language(&tree_sitter_iec61131_3_st::LANGUAGE.into()).expect("a grammar of this version");
    let tree = parser.parse(text, None).expect("a tree");
    let mut found = Vec::new();
    errors(tree.root_node(), &mut found);
    assert!(found.is_empty(), "{path}\n{}", found.join("\n"));
}

/// Without what the grammar does not know: values of structures; and with the semicolon that it wants behind one.
fn known_to_the_grammar(text: &str) -> String {
    let mut text = text.replace("END_STRUCT\n", "END_STRUCT;\n");
    for (open, close) in [(" := [", "];"), (" := (x := ", ");")] {
        while let Some(at) = text.find(open).filter(|_| text.contains("\nVAR_GLOBAL")) {
            let end = text[at..].find(close).expect("the end of a value");
            text.replace_range(at..at + end + close.len(), ";");
        }
    }
    text
}

fn all_files() -> Vec<(String, Files)> {
    let layouts = LAYOUTS.iter().map(|name| (name.to_string(), of_layout(name)));
    let fixtures = fixtures().into_iter().map(|(name, text)| (name.clone(), of_fixture(&name, &text)));
    layouts.chain(fixtures).collect()
}

/// Such as the condition of a property that is at its place already.
#[test]
fn nothing_is_assigned_to_itself() {
    let spec = "device unit { part button = button {}; in pressed: bool = button.on; }
        automaton Unit on unit {
            local n: int 0..9;
            keep n while pressed else warn \"counted\";
            initial state Counting { when pressed and n < 9 -> Counting { n += 1; } }
        }";
    let with_a_keep = ("a keep".to_string(), of_fixture("keep.aut", spec));
    // One of the fixtures says so itself.
    let all = all_files().into_iter().filter(|(name, _)| name != "lints.aut");
    for (name, files) in all.chain([with_a_keep]) {
        for (path, text) in files.iter().filter(|(path, _)| path.ends_with(".st") || path.ends_with(".scl")) {
            let of_itself = |line: &&str| {
                let statement = line.trim().strip_suffix(';').and_then(|text| text.split_once(" := "));
                statement.is_some_and(|(target, value)| target == value)
            };
            assert_eq!(text.lines().find(of_itself), None, "{name}: {path}");
        }
    }
}

#[test]
fn an_independent_grammar_takes_every_file() {
    let mut parsed = 0;
    for (name, files) in all_files() {
        for (path, text) in files.iter().filter(|(path, _)| path.ends_with(".st")) {
            parse(&format!("{name}: {path}"), &known_to_the_grammar(text));
            parsed += 1;
        }
    }
    println!("{parsed} files parsed");
}

#[test]
fn bodies_in_xml_are_the_same_text() {
    for (name, files) in all_files() {
        let main = &files["portable/main.st"];
        let codesys: String =
            files.iter().filter(|(path, _)| path.starts_with("codesys/F")).map(|(_, t)| t.as_str()).collect();
        let codesys = codesys + &files["codesys/MAIN.st"];
        for (flavour, text) in [("portable", main), ("codesys", &codesys)] {
            let xml = &files[&format!("{flavour}/project.xml")];
            let bodies = xml.split("<![CDATA[").skip(1).filter_map(|rest| rest.split("]]>").next());
            let mut count = 0;
            for body in bodies {
                assert!(text.contains(body), "{name}: {flavour}: a body differs\n{body}");
                count += 1;
            }
            assert_eq!(count, xml.matches("<pou ").count(), "{name}: {flavour}");
        }
    }
}

#[test]
fn transitions_are_short_and_nothing_is_dead() {
    let files = of_layout("default");
    let main = &files["portable/main.st"];
    let checked = judge(main).unwrap_or_else(|found| panic!("{}", listed(&found, main)));
    let own = checked.text.units.iter().flat_map(|unit| &unit.variables);
    let own = own.filter(|variable| variable.section != Section::External).count();
    let globals = checked.text.configurations.iter().map(|c| c.globals.len()).sum::<usize>();
    let dead = dead(&checked);
    let bounds = &files["bounds.txt"];
    let all = bounds.lines().find_map(|line| line.strip_prefix("all ")).expect("the sum");
    let figures = bounds.lines().last().expect("a line");
    println!("lines       {}", main.lines().count());
    println!("statements  {figures}");
    println!("variables   {}: {globals} global, {own} of functions, blocks and the program", globals + own);
    println!("dead        {}", dead.len());
    println!("bound       {} statements in a scan", all.trim());
    let each = figures.rsplit(": ").next().and_then(|text| text.split(' ').next()).expect("a number");
    assert!(each.parse::<f64>().expect("a number") <= 15.0, "{figures}");
    assert!(dead.is_empty(), "{}", listed(&dead, main));
}

/// A point that a robot is given is a global with the names of both.
#[test]
fn a_local_may_be_called_like_a_point_of_a_robot() {
    let read =
        |path: &str| std::fs::read_to_string(root().join("examples/lathe").join(path)).expect("a text");
    let specs = vec![read("lathe.aut").replace("failures", "arm_door")];
    let texts = Texts {
        layout: read("lathe.json"),
        specs,
        scenario: Some(read("lathe.scenario.json")),
        ..Texts::default()
    };
    let outcome = texts.compile();
    let files = st::files(&outcome.project.expect("a line that is right").system, &outcome.sources);
    let scl = &files["siemens/main.scl"];
    assert!(scl.contains("arm_door : \"ST_Point\""), "the point is a global");
    assert!(scl.contains("#arm_door := #arm_door + 1"), "the local counts");
    assert!(!scl.contains("\"Line\".arm_door = "), "the point is no number");
}
