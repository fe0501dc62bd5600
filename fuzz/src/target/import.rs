//! Files of other programs: each text is read as all of the formats. What is taken is a device text that compiles, for a
//! machine with nothing but the parameters that the text asks for.

use super::Effort;
use super::line::text;
use crate::judge;
use autogen::diagnostic::Diagnostic;
use autogen::import::{Imported, lif, opw, urdf};
use autogen::source::{FileId, Sources};
use autogen::spec::format::format;
use autogen::spec::parser;
use autogen_tests::{Texts, plain};

const NAME: &str = "imported";

pub fn answer(input: &[u8], effort: Effort) {
    let text = text(input);
    let mut sources = Sources::default();
    let file = sources.add("file", text.as_str());
    let name = Some(NAME);
    // A mesh is what the file itself is.
    let mesh = |_: &str| Ok(input.to_vec());
    let of_urdf = urdf::Options { base: None, tip: None, name, mesh: Some(&mesh) };
    let of_lif = lif::Options { vehicle: None, name };
    for read in [
        urdf::import(&sources, file, &of_urdf),
        opw::import(&sources, file, NAME),
        lif::import(&sources, file, &of_lif),
    ] {
        judged(&sources, read, input, effort);
    }
}

fn judged(sources: &Sources, read: Result<Imported, Vec<Diagnostic>>, input: &[u8], effort: Effort) {
    match read {
        Err(found) => {
            assert!(!found.is_empty(), "refused without a word");
            judge::diagnostics(sources, &found, input, effort);
        }
        Ok(Imported { text, .. }) => {
            let file = FileId(0);
            assert_eq!(format(file, &text).as_ref(), Ok(&text), "not laid out as `fmt` does it");
            if effort.takes(input, 4) {
                compiles(&text);
            }
        }
    }
}

fn compiles(text: &str) {
    let (tree, _) = parser::parse(FileId(0), text);
    let mut robots = Vec::new();
    let mut automata = String::new();
    for (number, device) in tree.devices.iter().enumerate() {
        let required = device.parameters.iter().filter(|parameter| parameter.default.is_none());
        let keys: String = required.map(|parameter| format!(", \"{}\": 0.5", parameter.name.value)).collect();
        robots
            .push(format!("{{\"name\": \"m{number}\", \"type\": \"t{number}\", \"pose\": [0, 0, 0]{keys}}}"));
        automata += &format!(
            "automaton T{number} on {} {{ initial state S {{ when false -> S {{}} }} }}\n",
            device.name.value
        );
    }
    let layout = format!("{{\"robots\": [{}]}}", robots.join(", "));
    let texts = Texts { specs: vec![text.into(), automata], ..Texts::of_layout(layout) };
    let outcome = texts.compile();
    // A body of the file may lie anywhere, also in the way of another one: that is found in a run.
    assert!(outcome.project.is_some(), "{text}\n{}", plain(&outcome.sources, &outcome.diagnostics));
}
