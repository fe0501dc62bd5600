//! The words of a run by their names.

use crate::Texts;
use autogen::backend::st;
use autogen::io_map::IoMap;
use autogen::lower::Project;
use runtime_sim::io_trace::Source;
use std::collections::HashMap;

/// A line without errors, and where its words are found by the names that the I/O trace has for them.
pub fn with_words(texts: &Texts) -> (Project, HashMap<String, Source>) {
    let outcome = texts.compile();
    let Some(project) = outcome.project else {
        panic!("{}", crate::plain(&outcome.sources, &outcome.diagnostics))
    };
    let (_, columns) = st::mapped(&project.system, &outcome.sources, &IoMap::default());
    let words = columns.0.into_iter().map(|column| (column.name, column.source)).collect();
    (project, words)
}
