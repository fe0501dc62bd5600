//! The first line of a part's file: which part it is, and of what sweep.

use super::design::Design;
use super::facts::About;
use super::part::Part;
use super::plan::{Line, Plan};
use crate::output;
use serde_json::{Map, Value, json};
use std::env;
use std::fs;
use std::path::PathBuf;

/// The key by which such a file is known.
pub const KEY: &str = "autogen_sweep_part";

/// What a page says beside the design. Names of files may differ from machine to machine, the hashes of their texts may not.
const ABOUT: &str = "about";

/// What parts of the same sweep have in common, key by key, and what it is called in a message.
pub const COMMON: [(&str, &str); 9] = [
    ("tool", "it was made by another autogen"),
    ("inputs", "it has another layout, other types or another scenario"),
    ("layouts", "it has other layouts"),
    ("set", "it has other `--set`"),
    ("order", "it has another `--order`"),
    ("io_delay", "it has another `--io-delay`"),
    ("replications", "it has another number of replications"),
    ("warm_up", "it has another `--warm-up`"),
    ("parts", "it has another number of parts"),
];

pub struct Head {
    pub part: Part,
    pub design: Design,
    /// For a page.
    pub about: About,
    /// As it was read.
    pub json: Map<String, Value>,
}

impl Head {
    /// The line of a part. An error says that the program of autogen cannot be read, whose hash stands in it.
    pub fn line(plan: &Plan, part: Part, specs: &[PathBuf]) -> Result<String, String> {
        let mut line = Map::new();
        line.insert(KEY.into(), json!(part.number()));
        line.insert("parts".into(), json!(part.of()));
        line.insert("tool".into(), json!(tool()?));
        line.insert("inputs".into(), plan.lines.iter().map(inputs).collect());
        line.extend(plan.design.to_json());
        line.insert(ABOUT.into(), About::of(plan, specs).to_json());
        Ok(Value::Object(line).to_string())
    }

    /// Reads such a line; `None` for any other text.
    pub fn parse(line: &str) -> Option<Self> {
        let Ok(Value::Object(json)) = serde_json::from_str(line) else { return None };
        let number = |key: &str| usize::try_from(json.get(key)?.as_u64()?).ok();
        let part = Part::new(number(KEY)?, number("parts")?)?;
        let design = Design::from_json(&Value::Object(json.clone()))?;
        let about = About::from_json(json.get(ABOUT)?)?;
        Some(Self { part, design, about, json })
    }
}

/// Hash of the running program: another version may come to other figures.
fn tool() -> Result<String, String> {
    let failed = |path: PathBuf, e| format!("{}: {e}", path.display());
    let path = env::current_exe().map_err(|e| failed("autogen".into(), e))?;
    let bytes = fs::read(&path).map_err(|e| failed(path, e))?;
    Ok(output::hash(&bytes))
}

/// Hashes of the texts of a line, wherever their files lie.
fn inputs(line: &Line) -> Value {
    let text = |file| line.sources.file(file).text.as_bytes();
    // Each text with its length before it, so that none goes over into the next.
    let mut specs = Vec::new();
    for &file in &line.specs {
        specs.extend((text(file).len() as u64).to_le_bytes());
        specs.extend(text(file));
    }
    json!({
        "layout": output::hash(text(line.layout)),
        "specs": output::hash(&specs),
        "scenario": output::hash(text(line.scenario)),
    })
}
