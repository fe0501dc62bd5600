//! What a path of the command line names: a layout, or results of a run.

use super::super::output::RESULTS;
use super::super::read;
use serde_json::Value;
use std::path::{Path, PathBuf};

pub enum Side {
    Layout,
    Results(Value),
    /// Neither of both, and why.
    Other(String),
}

pub fn of(path: &Path) -> Result<Side, String> {
    let is_folder = path.is_dir();
    let file: PathBuf = if is_folder { path.join(RESULTS) } else { path.into() };
    let text = read::text(&file).map_err(|why| match is_folder {
        true => format!("{}: {why}; `commission` writes the results of a run there", file.display()),
        false => format!("{}: {why}", file.display()),
    })?;
    let why = match serde_json::from_str::<Value>(&text) {
        Ok(results) if has_hash(&results) => return Ok(Side::Results(results)),
        Ok(value) if is_folder || is_of_a_run(&value) => {
            return Err(format!(
                "{}: results of a run have the key `trace_hash` with 16 hexadecimal digits, and these {}; \
                 `commission` writes them anew",
                file.display(),
                if value["trace_hash"].is_null() { "have none" } else { "have something else there" },
            ));
        }
        Ok(value) if value["robots"].is_array() => return Ok(Side::Layout),
        Ok(_) => "this is neither a layout nor results of a run: it has no list `robots` and no `trace_hash`"
            .into(),
        Err(_) if text.trim().is_empty() => {
            "this file is empty: it is neither a layout nor results of a run".into()
        }
        Err(error) => format!("this is neither a layout nor results of a run: it is not JSON, {error}"),
    };
    let why = format!("{}: {why}", file.display());
    if is_folder { Err(why) } else { Ok(Side::Other(why)) }
}

fn has_hash(value: &Value) -> bool {
    let is_hash = |text: &str| text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    value["trace_hash"].as_str().is_some_and(is_hash)
}

/// Whether it has what only results have.
fn is_of_a_run(value: &Value) -> bool {
    ["trace_hash", "simulated_s", "order_times"].iter().any(|key| value.get(key).is_some())
}
