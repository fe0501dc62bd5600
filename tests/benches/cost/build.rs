//! How `check` and `build` grow with the number of robots.

use crate::lines;
use autogen::backend::{dot, plan, rust, st};
use autogen::interlock;
use autogen::lower::compile;
use autogen_tests::Texts;
use std::collections::BTreeMap;
use std::hint::black_box;
use std::time::Instant;

/// Texts become a system, all warnings included, and the system becomes files; figures are milliseconds in all, and
/// microseconds for each robot, which stay the same if the cost grows as the layout does.
pub fn measure() {
    println!("long lines: up to 1000 robots each, one of 8 and ten of 1000");
    heading();
    for robots in [8, 32, 100, 316, 1000, 3162, 10_000] {
        one(robots, lines::long(robots));
    }
    println!("\ncopies of the default line: 7 robots each");
    heading();
    for copies in [1, 4, 14, 45, 143] {
        one(copies * 7, lines::copies(copies));
    }
}

fn heading() {
    let names = ["robots", "check", "rust", "st", "graph, plan, data", "all", "us/robot", "MB of text"];
    println!("{}", names.map(|name| format!("{name:>18}")).concat());
}

fn one(robots: usize, layout: String) {
    // The small ones are over before the processor is awake.
    let rounds = if robots <= 100 { 5 } else { 1 };
    let mut least = [f64::INFINITY; 4];
    let mut size = 0;
    for _ in 0..rounds {
        let mut begin = Instant::now();
        let mut lap = |part: usize| {
            least[part] = least[part].min(begin.elapsed().as_secs_f64() * 1e3);
            begin = Instant::now();
        };
        let input = Texts::of_layout(layout.as_str()).input();
        let names = input.layout.0.as_ref().expect("a layout that can be read").names();
        let outcome = compile(input);
        let project = outcome.project.expect("a line that is right");
        black_box(interlock::warnings(&names, &project));
        lap(0);
        let of_rust = rust::files(&project.system, &outcome.sources);
        lap(1);
        let of_st = st::files(&project.system, &outcome.sources);
        lap(2);
        let graphs = dot::files(&project);
        let plan = plan::svg(&project.plant, &project.edges);
        let data = [project.plant.to_text(), rust::parameters_text(&project.system), plan];
        lap(3);
        let bytes = |files: &BTreeMap<String, String>| files.values().map(String::len).sum::<usize>();
        size = bytes(&of_rust) + bytes(&of_st) + bytes(&graphs) + data.iter().map(String::len).sum::<usize>();
        black_box((of_rust, of_st, graphs, data));
    }
    let all: f64 = least.iter().sum();
    let mut cells = vec![format!("{robots}")];
    cells.extend(least.iter().chain([&all]).map(|ms| format!("{ms:.1}")));
    cells.push(format!("{:.0}", all * 1e3 / robots as f64));
    cells.push(format!("{:.1}", size as f64 / 1e6));
    println!("{}", cells.iter().map(|cell| format!("{cell:>18}")).collect::<String>());
}
