//! Files of other programs: what is wrong with them is told, what is right becomes a device text.

mod fixture;

use autogen::diagnostic::Diagnostic;
use autogen::import::{Imported, lif, opw, urdf};
use autogen::source::{FileId, Sources};
use fixture::walk;

const URDF: urdf::Options = urdf::Options { base: None, tip: None, name: None, mesh: None };
const LIF: lif::Options = lif::Options { vehicle: None, name: None };

/// What is told of a text; one that is taken becomes a text that is laid out as `fmt` does it.
fn told(result: Result<Imported, Vec<Diagnostic>>) -> Vec<Diagnostic> {
    match result {
        Ok(Imported { text, .. }) => {
            let mut sources = Sources::default();
            let file = sources.add("imported.aut", text.as_str());
            let formatted = autogen::spec::format::format(file, &text);
            assert_eq!(formatted, Ok(text));
            Vec::new()
        }
        Err(found) => {
            assert!(!found.is_empty(), "refused without a word");
            found
        }
    }
}

#[test]
fn urdf() {
    walk("import/urdf", |sources: &Sources, file: FileId| told(urdf::import(sources, file, &URDF)));
}

#[test]
fn opw() {
    walk("import/opw", |sources: &Sources, file: FileId| told(opw::import(sources, file, "arm")));
}

#[test]
fn lif() {
    walk("import/lif", |sources: &Sources, file: FileId| told(lif::import(sources, file, &LIF)));
}
