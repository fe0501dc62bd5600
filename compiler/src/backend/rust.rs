//! Rust: a crate of controllers without dependencies or heap, and a crate that links them with the simulator.
//!
//! Skeletons of files are templates; expressions and statements are printed by code, then the whole is
//! laid out by `prettyplease`. The values of a layout stand in `robots/` and `line.rs` only: they grow with it and
//! are printed as they are to look ([`tables`]).

mod adapters;
mod automaton;
mod choice;
mod context;
mod doc;
mod expression;
mod format;
mod line;
mod modes;
mod names;
mod parameters;
mod property;
mod retained;
mod robots;
mod shared;
mod state;
mod tables;
mod update;
mod walk;

pub use parameters::{parameters, parameters_text};

use super::{Files, Sink};
use crate::ir::{AutomatonId, ExprKind, System, Update, UpdateKind};
use crate::parallel::in_parts;
use crate::source::Sources;
use askama::Template;
use context::{Context, Shared};
use format::Unformatted;

const MANIFEST: &str = include_str!("../../../templates/rust/Cargo.toml");
const LIBRARY_MANIFEST: &str = include_str!("../../../templates/rust/library.toml");
/// Versions of what the simulator depends on, so that every build is the same.
const LOCK: &str = include_str!("../../../templates/rust/Cargo.lock");
const CONTROLLERS_MANIFEST: &str = include_str!("../../../templates/rust/controllers/Cargo.toml");
const TYPES: &str = include_str!("../../../templates/rust/controllers/types.rs");
const ALARM: &str = include_str!("../../../templates/rust/controllers/alarm.rs");
const COMMISSIONING_MANIFEST: &str = include_str!("../../../templates/rust/commissioning/Cargo.toml");
const ADAPTERS_MANIFEST: &str = include_str!("../../../templates/rust/adapters/Cargo.toml");
const ADAPTERS: [(&str, &str); 6] = [
    ("src/lib.rs", include_str!("../../../templates/rust/adapters/lib.rs")),
    ("src/c_interface.rs", include_str!("../../../templates/rust/adapters/c_interface.rs")),
    ("src/image.rs", include_str!("../../../templates/rust/adapters/image.rs")),
    ("src/kept.rs", include_str!("../../../templates/rust/adapters/kept.rs")),
    ("src/read.rs", include_str!("../../../templates/rust/adapters/read.rs")),
    ("src/words.rs", include_str!("../../../runtime-sim/src/words.rs")),
];
const COMMISSIONING: [(&str, &str); 5] = [
    ("examples/host.rs", include_str!("../../../templates/rust/commissioning/host.rs")),
    ("src/lib.rs", include_str!("../../../templates/rust/commissioning/lib.rs")),
    ("src/main.rs", include_str!("../../../templates/rust/commissioning/main.rs")),
    ("src/replay.rs", include_str!("../../../templates/rust/commissioning/replay.rs")),
    ("src/deployed.rs", include_str!("../../../templates/rust/commissioning/deployed.rs")),
];

/// The files of the workspace `rust/`, but for the simulator's.
pub fn files(system: &System, sources: &Sources) -> Files {
    let mut files = Files::new();
    write(system, sources, &mut files);
    files
}

/// Writes the files of the workspace `rust/`, but for the simulator's.
pub fn write(system: &System, sources: &Sources, files: &mut dyn Sink) {
    crates(system, sources, files);
    files.file("Cargo.toml", &MANIFEST);
    files.file("Cargo.lock", &LOCK);
    files.file("commissioning/Cargo.toml", &COMMISSIONING_MANIFEST);
    for (path, text) in COMMISSIONING {
        files.file(&format!("commissioning/{path}"), &text);
    }
}

/// The files of a workspace of the controllers and their adapters alone. Its shared library is all that a
/// simulator needs which was compiled apart.
pub fn library_files(system: &System, sources: &Sources) -> Files {
    let mut files = Files::new();
    crates(system, sources, &mut files);
    files.insert("Cargo.toml".into(), LIBRARY_MANIFEST.into());
    files
}

/// The texts from which the library is made that reads its layout at run time, before they are laid out: the types and
/// the kinds of part are all that they depend on.
pub fn library_sources(system: &System, sources: &Sources) -> Files {
    let system = &without_idle_updates(system);
    let names = names::names(system);
    let mut files = Files::new();
    of_types(Shared { system, sources, names: &names }, |path, text| {
        files.insert(path.into(), text.source().into());
    });
    files.insert("Cargo.toml".into(), LIBRARY_MANIFEST.into());
    files
}

/// The crates of the controllers and of their adapters.
fn crates(system: &System, sources: &Sources, files: &mut dyn Sink) {
    let retained_of = system.model.retains().then(|| system.shape_of_retained());
    let system = &without_idle_updates(system);
    let names = names::names(system);
    let shared = Shared { system, sources, names: &names };
    let mut modules: Vec<(String, Unformatted)> = Vec::new();
    of_types(shared, |path, text| modules.push((path.into(), text)));
    let formatted = in_parts(&modules, 1, |part| part.iter().map(|(_, text)| text.formatted()).collect());
    for ((path, _), text) in modules.iter().zip(formatted) {
        files.file(path, &text);
    }
    let mut put = |path: &str, text: Unformatted| files.file(path, &text.formatted());
    put("controllers/src/line.rs", line::line(shared, retained_of));
    put("controllers/src/robots.rs", robots::modules(shared));
    for id in used_types(system) {
        let module = &names.automata[id.0].module;
        put(&format!("controllers/src/robots/{module}.rs"), robots::of_type(shared, id));
    }
}

/// All of them but what has the values of the layout.
fn of_types(shared: Shared, mut put: impl FnMut(&str, Unformatted)) {
    let fixed = |text: &str| Unformatted::AsItIs(text.into());
    put("controllers/Cargo.toml", fixed(CONTROLLERS_MANIFEST));
    put("controllers/src/types.rs", fixed(TYPES));
    if shared::has_alarm_module(shared) {
        put("controllers/src/alarm.rs", fixed(ALARM));
    }
    put("controllers/src/lib.rs", shared::library(shared));
    put("controllers/src/kinds.rs", shared::kinds(shared));
    put("controllers/src/cells.rs", shared::cells(shared));
    put("controllers/src/system.rs", shared::system(shared));
    put("controllers/src/robot.rs", shared::robot(shared));
    if shared.system.model.retains() {
        put("controllers/src/retained.rs", retained::module(shared));
    }
    for id in 0..shared.system.model.automata.len() {
        let context = Context::new(shared, AutomatonId(id));
        put(&format!("controllers/src/{}.rs", context.own().module), automaton::module(&context));
    }
    put("adapters/Cargo.toml", fixed(ADAPTERS_MANIFEST));
    for (path, text) in ADAPTERS {
        put(&format!("adapters/{path}"), fixed(text));
    }
    put("adapters/src/layout.rs", adapters::adapters(shared));
}

/// Without assignments of a place to itself, which have no effect.
fn without_idle_updates(system: &System) -> System {
    let acts = |update: &Update| match &update.kind {
        UpdateKind::Assign { target, value, .. } => {
            !matches!(&value.kind, ExprKind::Read(place) if *place == target.place)
        }
        UpdateKind::Copy { target, source, .. } => *source != target.place,
        UpdateKind::Fill { .. } | UpdateKind::Command { .. } => true,
    };
    let mut system = system.clone();
    for state in system.model.automata.iter_mut().flat_map(|a| &mut a.states) {
        state.transitions.iter_mut().for_each(|t| t.updates.retain(acts));
    }
    system
}

/// The types of which the line has robots.
fn used_types(system: &System) -> Vec<AutomatonId> {
    let mut used = vec![false; system.model.automata.len()];
    system.instances.iter().for_each(|instance| used[instance.automaton.0] = true);
    (0..used.len()).filter(|id| used[*id]).map(AutomatonId).collect()
}

/// The text of a template. Writing to memory does not fail.
fn render(template: &impl Template) -> String {
    template.render().unwrap_or_default()
}
