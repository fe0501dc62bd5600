//! What OpenPLC's runtime v3 asks of the portable text beside the language: its script moves files by name.

use autogen::backend::st;
use autogen::io_map::IoMap;
use autogen_tests::ariac;
use roxmltree::Document;

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
