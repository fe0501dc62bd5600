//! What `docs/tutorial.md` says of its machine is so.

use autogen::executor::Executor;
use autogen_tests::{Texts, text};
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run_again};

/// The code blocks of a language, in their order.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    let begins = page.match_indices(&fence).map(|(at, _)| &page[at + fence.len()..]);
    begins.map(|rest| rest.split("```").next().expect("a block that ends")).collect()
}

fn run(spec: &str, layout: &str, scenario: &str) -> Report {
    let layout = layout.lines().filter(|line| !line.contains("\"specs\"") && !line.contains("\"scenario\""));
    let texts = Texts {
        layout: layout.collect(),
        specs: vec![spec.into()],
        scenario: Some(scenario.into()),
        ..Texts::default()
    };
    let outcome = texts.compile();
    let project = outcome.project.unwrap_or_else(|| panic!("{:?}", outcome.diagnostics));
    let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
    run_again(&project.plant, &mut executor, Stepping::Events, &mut memory, &mut |_| {})
        .expect("a line that runs")
}

#[test]
fn the_tutorial_works_as_it_says() {
    let page = text("docs/tutorial.md");
    let [first, parts, automaton] = blocks(&page, "aut")[..] else { panic!("three texts of types") };
    let [layout, scenario] = blocks(&page, "json")[..] else { panic!("a layout and a scenario") };
    let says = |report: &Report, spec: &str| {
        assert_eq!(report.reason, "all items collected", "{spec}");
        assert!(page.contains(&format!("{:.2} s", report.simulated_s)), "{} s: {spec}", report.simulated_s);
    };
    says(&run(first, layout, scenario), first);

    let end = "    part end = sink { of: belt; inset: 0; };\n";
    let device = first.split("automaton").next().expect("a device");
    let second = device.replace(end, &format!("{end}{parts}")) + automaton;
    says(&run(&second, layout, scenario), &second);

    let slow = second.replace("part jaws = cylinder { extend: 300 ms", "part jaws = cylinder { extend: 3 s");
    assert_ne!(slow, second);
    let report = run(&slow, layout, scenario);
    assert_eq!(report.fault, Some((1, "drill".into())), "{}", report.reason);
    assert!(page.contains("fault 1 of drill, in state Clamping: `Clamping` has lasted too long"));
}
