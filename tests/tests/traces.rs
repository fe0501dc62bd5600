//! Every hand-written trace on the reference executor.

use autogen::executor::Executor;
use autogen_tests::{root, trace};

#[test]
fn executor_follows_the_semantics() {
    let mut paths: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/trace"))
        .expect("the folder of traces")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    let mut wrong = Vec::new();
    for path in &paths {
        let text = std::fs::read_to_string(path).expect("a text");
        let outcome = trace::load(&text).and_then(|fixture| {
            let mut executor = Executor::new(&fixture.system);
            trace::compare(&fixture, &mut executor)
        });
        if let Err(error) = outcome {
            wrong.push(format!("{}\n{error}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{} of {} traces differ\n\n{}", wrong.len(), paths.len(), wrong.join("\n\n"));
    assert!(paths.len() >= 30, "{} traces", paths.len());
}
