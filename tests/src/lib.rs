//! What the tests of the whole share.

pub mod bounds;
pub mod browser;
pub mod compiled_simulator;
pub mod constructs;
pub mod coverage;
pub mod equal;
pub mod generate;
pub mod instances;
pub mod json_schema;
pub mod lots;
pub mod machines;
pub mod many;
pub mod mutants;
pub mod outcome;
pub mod postponing;
pub mod replay;
pub mod replayed;
pub mod sdf;
pub mod searched;
pub mod small_lines;
pub mod st;
pub mod stepped;
pub mod trace;
pub mod wired;
pub mod words;
pub mod workspace;
pub mod xml;

use autogen::diagnostic::{self, Diagnostic};
use autogen::lower::{Input, Outcome, Project, Setting, compile};
use autogen::source::{FileId, Sources};
use autogen::spec::{ast, parser};
use autogen::{layout, library, scenario};
use std::path::{Path, PathBuf};

/// The project's folder.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Whether the long forms of the tests are wanted.
pub fn is_full_campaign() -> bool {
    std::env::var("AUTOGEN_CAMPAIGN").is_ok_and(|campaign| campaign == "full")
}

/// A file of the project by its path from the project's folder.
pub fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// Files of one kind in a folder of fixtures, in the order of their names: name without its ending, and text.
pub fn fixtures(folder: &str, ending: &str) -> Vec<(String, String)> {
    let path = root().join("tests/fixtures").join(folder);
    let entries = std::fs::read_dir(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|found| found == ending));
    paths.sort();
    let read = |path: &PathBuf| {
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name");
        (name.to_string(), std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{name}: {e}")))
    };
    paths.iter().map(read).collect()
}

/// The trees of the library's devices, for a check without the rest of the library.
pub fn devices(sources: &mut Sources) -> Vec<(FileId, ast::File)> {
    let files = library::FILES.iter().filter(|(name, _)| name.starts_with(library::DEVICES));
    let trees = files.map(|(name, text)| {
        let file = sources.add(*name, *text);
        (file, parser::parse(file, text).0)
    });
    trees.collect()
}

/// What a line is compiled from, beside the library.
#[derive(Clone, Debug, Default)]
pub struct Texts {
    pub layout: String,
    pub specs: Vec<String>,
    pub scenario: Option<String>,
    pub settings: Vec<String>,
    pub order: Option<u64>,
}

impl Texts {
    pub fn of_layout(layout: impl Into<String>) -> Self {
        Self { layout: layout.into(), ..Self::default() }
    }

    pub fn set(mut self, setting: &str) -> Self {
        self.settings.push(setting.into());
        self
    }

    /// With texts of the first specification or of the scenario replaced.
    pub fn replaced(mut self, changes: &[(&str, &str)]) -> Self {
        for (from, to) in changes {
            let mut texts = self.specs.iter_mut().take(1).chain(&mut self.scenario);
            let text = texts.find(|text| text.contains(from)).expect(from);
            *text = text.replace(from, to);
        }
        self
    }

    pub fn compile(&self) -> Outcome {
        compile(self.input())
    }

    pub fn input(&self) -> Input {
        let mut sources = Sources::default();
        let layout = sources.add("layout.json", self.layout.as_str());
        let mut specs: Vec<_> = library::FILES.iter().map(|(name, text)| sources.add(*name, *text)).collect();
        for (i, text) in self.specs.iter().enumerate() {
            specs.push(sources.add(format!("specs/{i}.aut"), text.as_str()));
        }
        let scenario = sources.add("scenario.json", self.scenario.as_deref().unwrap_or(scenario::DEFAULT));
        let files: Vec<_> = self.settings.iter().map(|s| sources.add("--set", s.as_str())).collect();
        let settings = files.into_iter().map(|f| Setting::parse(&sources, f).expect("a setting")).collect();
        let layout = layout::parse(&sources, layout);
        Input { sources, layout, specs, scenario, settings, order: self.order }
    }

    /// The project, or a panic with the diagnostics.
    pub fn project(&self) -> Project {
        let outcome = self.compile();
        match outcome.project {
            Some(project) => project,
            None => panic!("{}", plain(&outcome.sources, &outcome.diagnostics)),
        }
    }
}

/// Diagnostics as text without colours.
pub fn plain(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    diagnostic::render_plain(sources, diagnostics)
}

/// The layouts of the paper.
pub const LAYOUTS: [&str; 3] = ["default", "spaced", "less_agv"];

/// A layout of the paper by name.
pub fn ariac(layout: &str) -> Texts {
    Texts::of_layout(text(&format!("examples/ariac2021/{layout}.json")))
}

/// A layout of the user's own, with its types and its scenario if it has any.
pub fn own_line(folder: &str) -> Texts {
    let specs = match folder {
        "buffer" | "rack" => vec![text(&format!("examples/{folder}/specs/{folder}.aut"))],
        _ => Vec::new(),
    };
    let scenario = std::fs::read_to_string(root().join(format!("examples/{folder}/scenario.json"))).ok();
    Texts { layout: text(&format!("examples/{folder}/{folder}.json")), specs, scenario, ..Texts::default() }
}

/// A layout of the paper with the library's automata: all vehicles go to the near stop.
pub fn paper(layout: &str) -> Texts {
    Texts { layout: text(&format!("examples/ariac2021/prototype/{layout}.json")), ..ariac(layout) }
}

/// A layout of the paper with the prototype's automata, and what they made for Table I.
pub fn prototype(layout: &str) -> Texts {
    let folder = root().join("examples/ariac2021/prototype");
    let entries = std::fs::read_dir(folder).expect("the folder of the prototype");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ext| ext == "aut")).collect();
    paths.sort();
    let specs = paths.iter().map(|path| std::fs::read_to_string(path).expect("a text")).collect();
    let scenario = Some(text("examples/ariac2021/table1.scenario.json"));
    Texts { specs, scenario, ..paper(layout) }
}

/// The lines of `examples/scenes` by name.
pub fn scenes() -> Vec<(String, Texts)> {
    let folder = root().join("examples/scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of the scenes");
    let names = entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"));
    let mut scenes: Vec<String> =
        names.filter_map(|name| name.strip_suffix(".aut").map(String::from)).collect();
    scenes.sort();
    scenes.into_iter().map(|scene| (scene.clone(), side_by_side(&format!("scenes/{scene}")))).collect()
}

/// The same line with a panel for each machine.
pub fn with_panels(mut texts: Texts) -> Texts {
    texts.layout = texts.layout.replacen('{', "{ \"panel\": \"machines\",", 1);
    texts
}

/// A layout of the examples with its types and its scenario beside it, all of one name.
pub fn side_by_side(path: &str) -> Texts {
    let part = |end: &str| text(&format!("examples/{path}{end}"));
    let (specs, scenario) = (vec![part(".aut")], Some(part(".scenario.json")));
    Texts { layout: part(".json"), specs, scenario, ..Texts::default() }
}

/// The turning cell with its arm on a rail along the wall, and the conveyors a metre farther away on both sides. `arm` is the
/// text of the arm's lengths; none for those of the example.
pub fn lathe_on_a_rail(arm: Option<&str>) -> Texts {
    let mut texts = side_by_side("lathe/lathe");
    let mut change = |from: &str, to: &str| {
        assert!(texts.specs[0].contains(from), "{from}");
        texts.specs[0] = texts.specs[0].replace(from, to);
    };
    let rail = "part rail = axis { from: origin * frame(0, 0, -0.3, 0); along: y; range: [-1.5, 1.2]; speed: 1.0; acceleration: 2.0; };
        part arm = chain {
        on: rail; mount: frame(0, 0, 0.3, 0);";
    change("part arm = chain {\n        from: origin;", rail);
    change(
        "part foot = body { at: origin; low: point(-0.1, -0.1, -0.75)",
        "part foot = body { on: rail; at: frame(0, 0, 0.3, 0); low: point(-0.1, -0.1, -0.3)",
    );
    if let Some(arm) = arm {
        change("lengths: [0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655];", arm);
    }
    for (from, to) in [
        ("[0.55, -2.55, 0.05, 90]", "[0.55, -3.55, 0.05, 90]"),
        ("[0.55, 0.55, 0.05, 90]", "[0.55, 1.55, 0.05, 90]"),
    ] {
        assert!(texts.layout.contains(from), "{from}");
        texts.layout = texts.layout.replace(from, to);
    }
    texts
}

/// Every line of the examples by name; the prototype at full speed, the tending cell for three parts, the lathe for one.
pub fn examples() -> Vec<(String, Texts)> {
    let layouts = LAYOUTS.map(|layout| (layout.to_string(), ariac(layout)));
    let own = ["buffer", "shared_agv"].map(|line| (line.to_string(), own_line(line)));
    let sorting = side_by_side("sorting/sorting");
    let mut tending = side_by_side("tending/tending");
    tending.scenario = tending.scenario.map(|text| text.replace("41", "3"));
    let mut crossing = side_by_side("crossing/crossing");
    crossing.scenario = Some(r#"{"time_limit_s": 120}"#.into());
    let mut lathe = side_by_side("lathe/lathe");
    lathe.scenario = lathe.scenario.map(|text| text.replace("{\"disc\": 5}", "{\"disc\": 1}"));
    let lines = [("sorting", sorting), ("tending", tending), ("crossing", crossing), ("lathe", lathe)];
    let lines = lines.map(|(name, texts)| (name.to_string(), texts));
    let fast = ["agv.capacity=4", "kitting.speed=1", "gantry.speed=1"];
    let prototype = fast.iter().fold(prototype("default"), |texts, setting| texts.set(setting));
    layouts
        .into_iter()
        .chain(own)
        .chain([("prototype".into(), prototype)])
        .chain(lines)
        .chain(scenes())
        .collect()
}

/// Runs `job` for each of the inputs on all processors; results in the order of the inputs.
pub fn on_all_processors<T: Sync, R: Send>(inputs: &[T], job: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = std::sync::atomic::AtomicUsize::new(0);
    let results: Vec<std::sync::Mutex<Option<R>>> =
        inputs.iter().map(|_| std::sync::Mutex::new(None)).collect();
    let workers = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(input) = inputs.get(i) else { break };
                    let result = job(input);
                    *results[i].lock().expect("no worker panics while it holds this") = Some(result);
                }
            });
        }
    });
    results
        .into_iter()
        .map(|r| r.into_inner().expect("as above").expect("every input has been worked on"))
        .collect()
}
