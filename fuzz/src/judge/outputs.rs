//! The files of a line, each judged by a reader that shares nothing with its writer.

use super::{dot, drawing};
use crate::files::hash;
use autogen::backend::{Files, dot as dot_files, plan, rust, sdf as sdf_files, st};
use autogen::io_map::IoMap;
use autogen::lower::Project;
use autogen::source::Sources;
use autogen_st_judge::scl;
use autogen_st_judge::structured::{self, Object};
use autogen_tests::sdf;
use roxmltree::Document;
use runtime_sim::line::Line;
use std::cell::RefCell;
use std::collections::HashSet;

/// Every file of the back ends.
pub fn all(project: &Project, sources: &Sources) -> Vec<Files> {
    let drawing = Files::from([("plan.svg".into(), plan::svg(&project.plant, &project.edges))]);
    vec![
        drawing,
        dot_files::files(project),
        sdf_files::files(&project.name, &project.plant),
        rust::files(&project.system, sources),
        st::files(&project.system, sources),
        st::plcopen(&project.system, sources, &IoMap::default()),
    ]
}

/// Graphs, drawing, world and the simulator's data.
pub fn cheap(project: &Project) {
    for (name, text) in dot_files::files(project) {
        let graph = dot::read(&text).unwrap_or_else(|e| panic!("{name}: {e}\n{text}"));
        if name == "connectivity.dot" {
            assert_eq!(graph.nodes, project.system.instances.len(), "{name}\n{text}");
            let conveyed: HashSet<[usize; 2]> =
                project.transfers.iter().map(|transfer| [transfer.from.0, transfer.to.0]).collect();
            let between = conveyed.iter().filter(|[from, to]| from != to);
            assert_eq!(graph.edges, project.edges.len() + between.count(), "{name}\n{text}");
        }
    }
    drawing::svg(&plan::svg(&project.plant, &project.edges));
    for (name, text) in sdf_files::files(&project.name, &project.plant) {
        let found = sdf::findings(&text);
        assert!(found.is_empty(), "{name}: {found:?}");
        Document::parse(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
    let text = project.plant.to_text();
    let line = Line::from_text(&text).unwrap_or_else(|e| panic!("line.txt: {e}\n{text}"));
    assert_eq!(line.to_text(), text, "line.txt is read as another line");
}

/// Controllers in both languages.
pub fn dear(project: &Project, sources: &Sources) {
    for (name, text) in rust::files(&project.system, sources) {
        if name.ends_with(".rs") {
            once(&text, || drop(syn::parse_file(&text).unwrap_or_else(|e| panic!("{name}: {e}\n{text}"))));
        }
    }
    assert!(!rust::parameters_text(&project.system).is_empty());
    structured_text(&st::files(&project.system, sources));
    structured_text(&st::plcopen(&project.system, sources, &IoMap::default()));
}

/// The files of the folder `plc/`.
pub fn structured_text(files: &Files) {
    for (name, text) in files {
        once(text, || match name.rsplit('.').next().unwrap_or_default() {
            "st" if name.starts_with("portable/") => {
                let found = autogen_st_judge::judge(text).err();
                let found = found.map(|found| autogen_st_judge::listed(&found, text));
                assert_eq!(found, None, "{name}\n{text}");
            }
            // Judged together below.
            "st" => assert!(name.starts_with("codesys/"), "{name}"),
            "scl" => dialect(name, scl::portable(text)),
            "xml" => {
                Document::parse(text).unwrap_or_else(|e| panic!("{name}: {e}"));
            }
            "csv" => table(name, text),
            _ => {}
        });
    }
    let objects = files.iter().filter(|(name, _)| name.starts_with("codesys/") && name.ends_with(".st"));
    let objects: Vec<Object> = objects.map(|(name, text)| Object { name, text }).collect();
    let all: String = objects.iter().map(|object| object.text).collect();
    if !all.is_empty() {
        once(&all, || dialect("codesys/", structured::portable(&objects)));
    }
}

/// A text of a dialect with structures, read as one of the portable core.
fn dialect(name: &str, text: Result<String, String>) {
    let text = text.unwrap_or_else(|found| panic!("{name}: {found}"));
    let found = autogen_st_judge::judge(&text).err();
    let found = found.map(|found| autogen_st_judge::listed(&found, &text));
    assert_eq!(found, None, "{name}\n{text}");
}

/// A head, and rows as long as it.
fn table(name: &str, text: &str) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    for record in reader.records() {
        record.unwrap_or_else(|e| panic!("{name}: {e}\n{text}"));
    }
}

/// The judgement of a text is the same each time, so it is made once.
fn once(text: &str, judge: impl FnOnce()) {
    thread_local!(static JUDGED: RefCell<HashSet<u64>> = RefCell::new(HashSet::new()));
    const MOST: usize = 100_000;
    let hash = hash(text.as_bytes());
    if JUDGED.with_borrow(|judged| judged.contains(&hash)) {
        return;
    }
    judge();
    JUDGED.with_borrow_mut(|judged| {
        if judged.len() == MOST {
            judged.clear();
        }
        judged.insert(hash);
    });
}
