//! PLCopen XML, read back: it declares what the text declares, and its bodies are the text.

use autogen::backend::{Files, st};
use autogen::io_map::IoMap;
use autogen::ir::System;
use autogen::source::Sources;
use autogen_tests::wired;
use autogen_tests::{LAYOUTS, Texts, ariac, own_line};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

const XHTML: &str = "http://www.w3.org/1999/xhtml";

/// A declaration: section, name, address, type, initial value.
type Declared = (String, String, String, String, String);

/// The folder, its namespace, and the element around a body.
const FLAVOURS: [(&str, &str, &str); 2] = [
    ("portable", "http://www.plcopen.org/xml/tc6_0201", "p"),
    ("codesys", "http://www.plcopen.org/xml/tc6_0200", "xhtml"),
];

/// Files of the examples, and of one with a table of addresses.
fn examples() -> Vec<(String, Files)> {
    let lines = LAYOUTS.iter().map(|name| (name.to_string(), ariac(name)));
    let own = ["buffer", "shared_agv"].map(|name| (name.to_string(), own_line(name)));
    let files = |texts: &Texts| {
        let outcome = texts.compile();
        let project = outcome.project.expect("a layout that can be built");
        mapped(&project.system, &outcome.sources, &IoMap::default())
    };
    let mut all: Vec<_> = lines.chain(own).map(|(name, texts)| (name, files(&texts))).collect();
    let outcome = ariac("default").compile();
    let project = outcome.project.expect("a layout that can be built");
    let points = st::points(&project.system);
    let map = wired::map(&points, &wired::drawn(&points, 1));
    all.push(("default with addresses".into(), mapped(&project.system, &outcome.sources, &map)));
    all
}

/// Text and XML.
fn mapped(system: &System, sources: &Sources, map: &IoMap) -> Files {
    let (mut files, _) = st::mapped(system, sources, map);
    files.extend(st::plcopen(system, sources, map));
    files
}

/// The text without comments that follow declarations.
fn without_comment(line: &str) -> &str {
    line.split(" (*").next().unwrap_or_default().trim()
}

/// The declarations of one text and what stands behind the last of them.
fn declared(text: &str) -> (Vec<Declared>, String) {
    let mut variables = Vec::new();
    let mut section = None;
    let mut body = String::new();
    // A value may go over several lines.
    let mut open = String::new();
    for line in text.lines() {
        let keyword = line.strip_suffix(" RETAIN").unwrap_or(line);
        match (keyword, section) {
            (
                "VAR" | "VAR_INPUT" | "VAR_OUTPUT" | "VAR_IN_OUT" | "VAR_EXTERNAL" | "VAR_GLOBAL" | "STRUCT",
                None,
            ) => section = Some(line),
            ("END_VAR" | "END_STRUCT", Some(_)) => {
                section = None;
                body.clear();
            }
            (line, Some(section)) => {
                let line = without_comment(line);
                if open.is_empty() && !line.contains(" : ") {
                    continue;
                }
                let space = if open.is_empty() || open.ends_with('[') { "" } else { " " };
                open = format!("{open}{space}{line}");
                if !open.ends_with(';') {
                    continue;
                }
                let line = std::mem::take(&mut open);
                let Some((front, rest)) = line.trim_end_matches(';').split_once(" : ") else { continue };
                let (name, address) = front.split_once(" AT ").unwrap_or((front, ""));
                let (ty, initial) = rest.split_once(" := ").unwrap_or((rest, ""));
                variables.push([section, name, address, ty, initial].map(String::from).into());
            }
            (line, None) => body += &format!("{line}\n"),
        }
    }
    (variables, body)
}

/// The units of a text by name, without the line that ends each.
fn units(text: &str) -> BTreeMap<String, String> {
    let mut units = BTreeMap::new();
    let mut open: Option<(String, &str, String)> = None;
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match (&mut open, words.as_slice()) {
            (None, [keyword @ ("FUNCTION" | "FUNCTION_BLOCK" | "PROGRAM" | "CONFIGURATION"), name, ..]) => {
                open = Some((name.to_string(), keyword, String::new()));
            }
            (Some((name, keyword, body)), [end]) if end.strip_prefix("END_") == Some(keyword) => {
                units.insert(name.clone(), body.clone());
                open = None;
            }
            (Some((_, _, body)), _) => *body += &format!("{line}\n"),
            (None, _) => {}
        }
    }
    units
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Node<'a, 'i> {
    node.children()
        .find(|n| n.has_tag_name(name))
        .or_else(|| node.children().find(|n| n.tag_name().name() == name))
        .unwrap_or_else(|| panic!("{} has no {name}", node.tag_name().name()))
}

fn ty(node: Node) -> String {
    let inner = child(node, "type").first_element_child().expect("a type");
    match inner.tag_name().name() {
        "derived" => inner.attribute("name").expect("a name").into(),
        "array" => {
            let base = child(inner, "baseType").first_element_child().expect("a type");
            let dimensions = inner.children().filter(|n| n.tag_name().name() == "dimension");
            let bounds = dimensions.map(|dimension| {
                let bound = |name: &str| dimension.attribute(name).expect("a bound").to_string();
                format!("{}..{}", bound("lower"), bound("upper"))
            });
            let base = base.attribute("name").unwrap_or(base.tag_name().name());
            format!("ARRAY[{}] OF {base}", bounds.collect::<Vec<_>>().join(", "))
        }
        basic => basic.into(),
    }
}

/// A value as the text has it.
fn value(node: Node) -> String {
    let inner = |node: Node| node.first_element_child().map(value).unwrap_or_default();
    let values = node.children().filter(|n| n.is_element());
    match node.tag_name().name() {
        "arrayValue" => {
            let values: Vec<String> = values.map(inner).collect();
            let alike = values.chunk_by(|a, b| a == b).map(|alike| match alike.len() {
                n @ 3.. => format!("{n}({})", alike[0]),
                _ => alike.join(", "),
            });
            format!("[{}]", alike.collect::<Vec<_>>().join(", "))
        }
        "structValue" => {
            let one =
                |node: Node| format!("{} := {}", node.attribute("member").expect("a member"), inner(node));
            format!("({})", values.map(one).collect::<Vec<_>>().join(", "))
        }
        _ => node.attribute("value").expect("a value").into(),
    }
}

fn variable(section: &str, node: Node) -> Declared {
    let initial = node.children().find(|n| n.tag_name().name() == "initialValue");
    let initial = initial.and_then(|n| n.first_element_child()).map(value).unwrap_or_default();
    let attribute = |name: &str| node.attribute(name).unwrap_or_default().to_string();
    (section.into(), attribute("name"), attribute("address"), ty(node), initial)
}

fn variables(section: &str, list: Node) -> Vec<Declared> {
    let retain = if list.attribute("retain") == Some("true") { " RETAIN" } else { "" };
    let section = format!("{section}{retain}");
    list.children().filter(|n| n.tag_name().name() == "variable").map(|n| variable(&section, n)).collect()
}

fn of_pou(pou: Node) -> Vec<Declared> {
    let sections = [
        ("inputVars", "VAR_INPUT"),
        ("outputVars", "VAR_OUTPUT"),
        ("inOutVars", "VAR_IN_OUT"),
        ("externalVars", "VAR_EXTERNAL"),
        ("localVars", "VAR"),
    ];
    let lists = child(pou, "interface").children();
    lists
        .flat_map(|list| {
            let section = sections.iter().find(|(tag, _)| list.tag_name().name() == *tag);
            section.map(|(_, name)| variables(name, list)).unwrap_or_default()
        })
        .collect()
}

fn sorted(mut variables: Vec<Declared>) -> Vec<Declared> {
    variables.sort();
    variables
}

/// All texts of a flavour, as one.
fn text_of(flavour: &str, files: &Files) -> String {
    let of_flavour = files.iter().filter(|(path, _)| path.starts_with(flavour) && path.ends_with(".st"));
    of_flavour.map(|(_, text)| text.as_str()).collect()
}

#[test]
fn units_in_xml_are_those_of_the_text() {
    for (name, files) in examples() {
        for (flavour, namespace, wrapper) in FLAVOURS {
            let at = format!("{name}: {flavour}");
            let xml = Document::parse(&files[&format!("{flavour}/project.xml")]).expect(&at);
            assert_eq!(xml.root_element().tag_name().namespace(), Some(namespace), "{at}");
            let mut units = units(&text_of(flavour, &files));
            units.remove("Config0");
            for pou in xml.descendants().filter(|n| n.tag_name().name() == "pou") {
                let own = pou.attribute("name").expect("a name");
                let text = units.remove(own).unwrap_or_else(|| panic!("{at}: {own} is not in the text"));
                let (wanted, statements) = declared(&text);
                assert_eq!(sorted(of_pou(pou)), sorted(wanted), "{at}: {own}");
                let body = child(child(pou, "body"), "ST").first_element_child().expect("a body");
                assert_eq!(
                    (body.tag_name().namespace(), body.tag_name().name()),
                    (Some(XHTML), wrapper),
                    "{at}"
                );
                assert_eq!(body.text(), Some(statements.as_str()), "{at}: {own}");
            }
            assert!(units.is_empty(), "{at}: not in the XML: {:?}", units.keys());
        }
    }
}

#[test]
fn globals_in_xml_are_those_of_the_text() {
    for (name, files) in examples() {
        for (flavour, ..) in FLAVOURS {
            let at = format!("{name}: {flavour}");
            let xml = Document::parse(&files[&format!("{flavour}/project.xml")]).expect(&at);
            let lists = xml.descendants().filter(|n| n.tag_name().name() == "globalVars");
            let found: Vec<_> = lists.flat_map(|list| variables("VAR_GLOBAL", list)).collect();
            let wanted: Vec<_> = (files.iter())
                .filter(|(path, _)| path.starts_with(flavour) && path.ends_with(".st"))
                .flat_map(|(_, text)| declared(text).0)
                .filter(|declared| declared.0.starts_with("VAR_GLOBAL"))
                .collect();
            assert!(!wanted.is_empty(), "{at}");
            assert_eq!(sorted(found), sorted(wanted), "{at}");
        }
    }
}

#[test]
fn types_in_xml_are_those_of_the_text() {
    for (name, files) in examples() {
        let xml = Document::parse(&files["codesys/project.xml"]).expect(&name);
        let (mut count, mut structures) = (0, 0);
        for ty in xml.descendants().filter(|n| n.tag_name().name() == "dataType") {
            let own = ty.attribute("name").expect("a name");
            let text = &files[&format!("codesys/{own}.st")];
            if let Some(fields) = ty.descendants().find(|n| n.tag_name().name() == "struct") {
                assert_eq!(variables("STRUCT", fields), declared(text).0, "{name}: {own}");
                structures += 1;
                continue;
            }
            let values = ty.descendants().filter(|n| n.tag_name().name() == "value");
            let members: Vec<String> = values
                .map(|v| {
                    format!(
                        "    {} := {}",
                        v.attribute("name").expect("a name"),
                        v.attribute("value").expect("a value")
                    )
                })
                .collect();
            assert!(text.contains(&format!("(\n{}\n);", members.join(",\n"))), "{name}: {own}\n{text}");
            count += 1;
        }
        let of = |prefix: &str| files.keys().filter(|path| path.starts_with(prefix)).count();
        assert_eq!((count, structures), (of("codesys/E_"), of("codesys/ST_")), "{name}");
    }
}

#[test]
fn projects_have_the_task() {
    for (name, files) in examples() {
        let main = &files["portable/main.st"];
        let xml = Document::parse(&files["portable/project.xml"]).expect(&name);
        let task = xml.descendants().find(|n| n.tag_name().name() == "task").expect("a task");
        let interval = task.attribute("interval").expect("an interval");
        assert!(
            main.contains(&format!("TASK Scan(INTERVAL := {interval}, PRIORITY := 0);")),
            "{name}: {interval}"
        );
        let instance = child(task, "pouInstance");
        let [program, ty] = ["name", "typeName"].map(|a| instance.attribute(a).expect("a name"));
        assert!(main.contains(&format!("PROGRAM {program} WITH Scan : {ty};")), "{name}");
    }
}

/// A clock would give other bytes for the same input.
#[test]
fn the_header_has_the_number_and_the_day_of_the_tool() {
    for (name, files) in examples() {
        for (flavour, ..) in FLAVOURS {
            let xml = Document::parse(&files[&format!("{flavour}/project.xml")]).expect(&name);
            let header = xml.descendants().find(|n| n.tag_name().name() == "fileHeader").expect("a header");
            assert_eq!(header.attribute("productVersion"), Some(env!("CARGO_PKG_VERSION")), "{name}");
            let date = format!("{}T00:00:00", autogen::version::DAY);
            assert_eq!(header.attribute("creationDateTime"), Some(date.as_str()), "{name}");
        }
    }
}

/// What a screen shows is exported, and nothing can be written from there: not the permit, not an output.
#[test]
fn symbols_can_be_read_and_not_written() {
    for (name, files) in examples() {
        for list in ["GVL_System", "GVL_Ports", "GVL_Cells", "MAIN"] {
            let Some(text) = files.get(&format!("codesys/{list}.st")) else { continue };
            assert_eq!(pragmas(text), [("symbol".to_string(), "read".to_string())], "{name}: {list}");
        }
    }
}

/// Name and value of the attributes in pragmas of a text.
fn pragmas(text: &str) -> Vec<(String, String)> {
    let pragmas = text.lines().filter_map(|line| line.strip_prefix("{attribute '")?.strip_suffix("'}"));
    pragmas
        .map(|pragma| pragma.split_once("' := '").unwrap_or((pragma, "")))
        .map(|(name, value)| (name.into(), value.into()))
        .collect()
}

#[test]
fn objects_in_xml_have_the_attributes_of_the_text() {
    for (name, files) in examples() {
        let xml = Document::parse(&files["codesys/project.xml"]).expect(&name);
        let objects =
            xml.descendants().filter(|n| ["dataType", "pou", "globalVars"].contains(&n.tag_name().name()));
        let mut qualified = 0;
        for object in objects {
            let own = object.attribute("name").expect("a name");
            // A program has them at its interface.
            let holder = object.children().find(|n| n.tag_name().name() == "interface").unwrap_or(object);
            let added = holder.children().filter(|n| n.tag_name().name() == "addData");
            let data = added.flat_map(|added| added.children()).filter(|data| {
                data.attribute("name") == Some("http://www.3s-software.com/plcopenxml/attributes")
            });
            let found: Vec<_> = data
                .flat_map(|data| child(data, "Attributes").children())
                .filter(|n| n.is_element())
                .map(|n| ["Name", "Value"].map(|a| n.attribute(a).expect("an attribute").to_string()).into())
                .collect();
            assert_eq!(found, pragmas(&files[&format!("codesys/{own}.st")]), "{name}: {own}");
            qualified += found.iter().filter(|(name, _)| name == "qualified_only").count();
        }
        assert_eq!(qualified, files.keys().filter(|path| path.starts_with("codesys/E_")).count(), "{name}");
    }
}
