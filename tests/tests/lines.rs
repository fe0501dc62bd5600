//! Whole lines on the reference executor and the simulator.

use autogen::executor::Executor;
use autogen_tests::{Texts, text};
use runtime_sim::run::run;

#[test]
fn the_default_line_makes_all_orders() {
    let project = Texts::of_layout(text("examples/ariac2021/default.json")).project();
    let mut executor = Executor::new(&project.system);
    let mut last = std::time::Instant::now();
    let report = run(&project.plant, &mut executor, &mut |seen| {
        if last.elapsed().as_secs() > 2 {
            last = std::time::Instant::now();
            eprintln!("{}", seen.scan);
        }
    })
    .expect("a line that can be run");
    println!("{}", report.to_json());
    assert!(report.finished, "{}", report.reason);
}
