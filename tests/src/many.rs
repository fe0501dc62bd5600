//! Many systems in one workspace, so that they are compiled together: each has crates of its own, and one
//! program replays them all, `replays NUMBER PARAMETERS`.

use crate::workspace::Workspace;
use autogen::backend::rust;
use autogen::ir::System;
use autogen::source::Sources;

pub fn workspace(name: &str, systems: &[(&System, &Sources)]) -> Workspace {
    let workspace = Workspace::of_simulator(name);
    let mut members = vec!["\"runtime-sim\"".to_string(), "\"replays\"".into()];
    let (mut dependencies, mut arms) = (String::new(), String::new());
    for (number, (system, sources)) in systems.iter().enumerate() {
        for (path, text) in rust::files(system, sources) {
            if let Some(text) = renamed(&path, text, number) {
                workspace.put(&format!("s{number}/{path}"), &text);
            }
        }
        workspace.put(&parameters(number), &rust::parameters_text(system));
        members.extend(["controllers", "commissioning"].map(|c| format!("\"s{number}/{c}\"")));
        dependencies += &format!("s{number} = {{ path = \"../s{number}/commissioning\" }}\n");
        arms += &format!(
            "        \"{number}\" => s{number}::replay::replay(&mut s{number}::deployed::Deployed::read(&text).unwrap()),\n"
        );
    }
    let members = members.join(", ");
    workspace.put("Cargo.toml", &format!("[workspace]\nresolver = \"3\"\nmembers = [{members}]\n"));
    workspace.put("replays/Cargo.toml", &format!("{MANIFEST}{dependencies}"));
    workspace.put("replays/src/main.rs", &MAIN.replace("ARMS", &arms));
    workspace
}

/// The file with the parameters of a system.
pub fn parameters(number: usize) -> String {
    format!("parameters{number}.txt")
}

/// A file of a system's crates; what belongs to a program of its own is left out.
fn renamed(path: &str, text: String, number: usize) -> Option<String> {
    let replaced = |from: &str, to: String| text.replacen(from, &to, 1);
    Some(match path {
        "controllers/Cargo.toml" => {
            replaced("name = \"controllers\"", format!("name = \"controllers-{number}\""))
                .replace("[lib]\n", "[lib]\nname = \"controllers\"\n")
        }
        // Their C interfaces would have the same names in one program.
        "adapters/src/lib.rs" => replaced("pub mod c_interface;\n", String::new()),
        "adapters/Cargo.toml" => replaced("name = \"adapters\"", format!("name = \"adapters-{number}\""))
            .replace("crate-type = [\"lib\", \"cdylib\"]", "name = \"adapters\"")
            .replace(
                "\"../controllers\"",
                &format!("\"../controllers\", package = \"controllers-{number}\""),
            ),
        "commissioning/Cargo.toml" => replaced("name = \"commissioning\"", format!("name = \"s{number}\""))
            .replace("\"../controllers\"", &format!("\"../controllers\", package = \"controllers-{number}\""))
            .replace("\"../adapters\"", &format!("\"../adapters\", package = \"adapters-{number}\""))
            .replace("../runtime-sim", "../../runtime-sim"),
        "Cargo.toml" | "Cargo.lock" | "commissioning/src/main.rs" | "commissioning/examples/host.rs" => {
            return None;
        }
        _ => text,
    })
}

const MANIFEST: &str = "[package]
name = \"replays\"
version = \"0.1.0\"
edition = \"2024\"

[dependencies]
";

const MAIN: &str = "fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&arguments[2]).unwrap();
    let result = match arguments[1].as_str() {
ARMS        other => panic!(\"there is no system {other}\"),
    };
    result.unwrap();
}
";
