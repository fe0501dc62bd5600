//! Runs a text beside the executor on the simulator: `compare_st LAYOUT.json MAIN.st [NAMES.csv]`.

use autogen_tests::Texts;
use autogen_tests::st::{Beside, Emitted};

fn main() {
    let paths: Vec<_> = std::env::args().skip(1).collect();
    let [layout, text, names @ ..] = &paths[..] else { panic!("a layout and a text are wanted") };
    let read = |path: &String| std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let project = Texts::of_layout(read(layout)).project();
    let emitted = Emitted::flat(read(text), names.first().map(read).unwrap_or_default());
    let mut beside = match Beside::new(&project.system, &emitted) {
        Ok(beside) => beside,
        Err(error) => panic!("{error}"),
    };
    let begin = std::time::Instant::now();
    let report = runtime_sim::run::run(
        &project.plant,
        &mut beside,
        runtime_sim::run::Stepping::EveryScan,
        &mut |_| {},
    )
    .expect("a line that can be run");
    println!("{} of {} orders, {:.1} s", report.orders_done, report.orders, begin.elapsed().as_secs_f64());
    println!("{} scans, {} words compared; {:?}", beside.scans, beside.words, beside.difference);
    let branches = beside.text.machine.branches();
    let entered = branches.iter().filter(|b| b.entered > 0).count();
    println!("{entered} of {} CASE branches entered", branches.len());
    for branch in branches.iter().filter(|b| b.entered == 0) {
        println!("    {} {} line {}", branch.unit, branch.label, branch.line);
    }
    let never = beside.text.machine.never_executed();
    println!("{} of {} statements never executed", never.len(), beside.text.machine.statements());
}
