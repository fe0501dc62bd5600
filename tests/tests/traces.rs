//! Every hand-written trace, on the reference executor and as compiled Rust.

use autogen::executor::Executor;
use autogen_tests::replay::{difference, record_trace, run};
use autogen_tests::trace::{self, Fixture};
use autogen_tests::{many, root};

/// All traces with their names; those that cannot be read are in the second list.
fn fixtures() -> (Vec<(String, Fixture)>, Vec<String>) {
    let mut paths: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/trace"))
        .expect("the folder of traces")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    let (mut read, mut wrong) = (Vec::new(), Vec::new());
    for path in &paths {
        let text = std::fs::read_to_string(path).expect("a text");
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        match trace::load(&text) {
            Ok(fixture) => read.push((name, fixture)),
            Err(error) => wrong.push(format!("{name}\n{error}")),
        }
    }
    (read, wrong)
}

#[test]
fn executor_follows_the_semantics() {
    let (fixtures, mut wrong) = fixtures();
    for (name, fixture) in &fixtures {
        if let Err(error) = trace::compare(fixture, &mut Executor::new(&fixture.system)) {
            wrong.push(format!("{name}\n{error}"));
        }
    }
    assert!(wrong.is_empty(), "{} traces differ\n\n{}", wrong.len(), wrong.join("\n\n"));
    assert!(fixtures.len() >= 30, "{} traces", fixtures.len());
}

#[test]
fn rust_follows_the_executor() {
    let (fixtures, wrong) = fixtures();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    let systems: Vec<_> = fixtures.iter().map(|(_, f)| (&f.system, &f.sources)).collect();
    let workspace = many::workspace("traces", &systems);
    workspace.cargo(&["build", "--quiet", "-p", "replays"]);
    let mut different = Vec::new();
    for (number, (name, fixture)) in fixtures.iter().enumerate() {
        let recording = record_trace(&mut Executor::new(&fixture.system), fixture);
        let arguments = [number.to_string(), many::parameters(number)];
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let found =
            run(&workspace.debug_program("replays"), &arguments, &workspace.folder, &recording.inputs);
        if let Some(difference) = difference(&fixture.system, &recording.answers, &found) {
            different.push(format!("{name}: {difference}"));
        }
    }
    assert!(different.is_empty(), "{}", different.join("\n"));
    println!("{} traces", fixtures.len());
}
