//! Prints a generated specification, `generate SEED COUNT`; on stderr what the executor does with it.

use autogen::executor::Executor;
use autogen_tests::constructs::Table;
use autogen_tests::generate::generate;
use autogen_tests::lots::Lots;
use autogen_tests::replay::record;
use std::collections::{BTreeMap, BTreeSet};

fn main() {
    let mut arguments = std::env::args().skip(1).map(|a| a.parse().expect("a number"));
    let (seed, count) = (arguments.next().unwrap_or(1), arguments.next().unwrap_or(5));
    let made = generate(seed, count as usize);
    println!("{}", made.text);
    eprintln!("{} accepted, refused {:?}", made.automata, made.refused);
    made.examples.values().for_each(|e| eprintln!("{e}"));
    let mut table = Table::default();
    let mut running = 0;
    for (number, system) in made.layouts.iter().enumerate() {
        let mut executor = Executor::new(system);
        let recording =
            record(&mut executor, system, 1500, Lots::lively(system, seed * 1000 + number as u64));
        let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
        let mut before = String::new();
        for answer in &recording.answers {
            let words: Vec<&str> = answer.split(' ').take(4).collect();
            let code = f64::from_bits(u64::from_str_radix(words[2], 16).expect("a number"));
            if code > 0.0 && words[2] != before {
                let site = &system.model.faults[code as usize - 1];
                let automaton = &system.model.automata[site.automaton.0].name;
                *kinds.entry(format!("{:?} {automaton} {}", site.kind, site.text)).or_default() += 1;
            }
            before = words[2].into();
        }
        eprintln!("layout {number}: {} of 1500 scans running; faults {kinds:#?}", recording.running);
        running += recording.running;
        let faults: BTreeSet<i32> = recording.faults.clone();
        table.take(&system.model, &made.tree, &made.layouts, &executor.fired().to_vec(), &faults);
    }
    eprintln!("{running} scans running of {}", made.layouts.len() * 1500);
    eprintln!("{}", table.text());
}
