//! What OpenPLC's runtime v3 asks of the portable text beside the language: its script moves files by name, its
//! matiec finds keywords inside of words, and the C that it makes of the text meets the macros of C headers.

use autogen::backend::{Files, st};
use autogen::io_map::IoMap;
use autogen_st_judge::{judge, listed};
use autogen_tests::ariac;
use autogen_tests::instances::instantiate;
use roxmltree::Document;
use std::collections::BTreeSet;

/// An automaton with these locals.
fn with_locals(names: &[&str]) -> Files {
    let locals: String = names.iter().map(|name| format!("    local {name}: bool := false;\n")).collect();
    let updates: String = names.iter().map(|name| format!(" {name} := not {name};")).collect();
    let text = format!(
        "automaton Lamp on vehicle {{\n{locals}    initial -> Blinking {{}}\n    \
         state Blinking {{ when after 1 s -> Blinking {{{updates} }} }}\n}}\n"
    );
    let (system, sources) = instantiate(&[("lamp.aut".into(), text)]);
    st::files(&system, &sources)
}

/// All names that a text declares, in small letters.
fn declared(text: &str) -> BTreeSet<String> {
    let checked = judge(text).unwrap_or_else(|findings| panic!("{}", listed(&findings, text)));
    let own = checked.text.units.iter().flat_map(|unit| &unit.variables);
    let globals = checked.text.configurations.iter().flat_map(|configuration| &configuration.globals);
    own.chain(globals).map(|variable| variable.name.text.to_lowercase()).collect()
}

/// The script moves Config0.c, Config0.h and Res0.c, which matiec names after the configuration and the resource.
#[test]
fn the_script_finds_the_files_that_it_moves() {
    let outcome = ariac("default").compile();
    let system = outcome.project.expect("a layout that can be built").system;
    let main = &st::files(&system, &outcome.sources)["portable/main.st"];
    assert!(
        main.contains("\nCONFIGURATION Config0\n") && main.contains("\nRESOURCE Res0 ON PLC\n"),
        "{main}"
    );
    let xml = &st::plcopen(&system, &outcome.sources, &IoMap::default())["portable/project.xml"];
    let xml = Document::parse(xml).expect("XML");
    let name = |tag: &str| xml.descendants().find(|n| n.has_tag_name((NAMESPACE, tag)))?.attribute("name");
    assert_eq!((name("configuration"), name("resource")), (Some("Config0"), Some("Res0")));
}

const NAMESPACE: &str = "http://www.plcopen.org/xml/tc6_0201";

#[test]
fn no_name_has_a_keyword_inside() {
    let names =
        ["blend_program", "bend_function_block", "Send_Configuration", "lend_action", "mend_transition"];
    let files = with_locals(&[&names[..], &["initial_steps", "blend_program_v", "blend_v_program"]].concat());
    let declared = declared(&files["portable/main.st"]);
    let found: Vec<_> = ["end_program", "end_function", "end_configuration", "end_action", "end_transition"]
        .into_iter()
        .flat_map(|keyword| declared.iter().filter(move |name| name.contains(keyword)))
        .chain(declared.iter().filter(|name| name.starts_with("initial_step")))
        .collect();
    assert!(found.is_empty(), "{found:?}");
    for name in ["blend_v_program", "bend_v_function_block", "initial_v_steps", "blend_v_program_v"] {
        assert!(declared.contains(name), "{name}: {declared:?}");
    }
    assert!(files["names.csv"].contains("blend_program,blend_v_program,a keyword within the name"));
}

#[test]
fn no_name_is_a_macro_of_the_c_below() {
    let macros = [
        "x_ok",
        "r_ok",
        "w_ok",
        "l_set",
        "lock_ex",
        "f_lock",
        "o_sync",
        "map_type",
        "ms_sync",
        "nzero",
        "time_utc",
        "rotary_switch",
    ];
    let declared = declared(&with_locals(&macros)["portable/main.st"]);
    for name in macros {
        assert!(!declared.contains(name), "{name}: {declared:?}");
        assert!(declared.contains(&format!("{name}_v")), "{name}: {declared:?}");
    }
}
