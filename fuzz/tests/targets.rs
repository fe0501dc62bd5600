//! The driver of `cargo test`: seeds, corpus and findings, and inputs made from them by fixed lots.

use arbitrary::Unstructured;
use autogen_fuzz::{Effort, Target, files, memory, mutation, target};
use autogen_tests::generate::Lot;
use autogen_tests::is_full_campaign;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Answers an input; where that is a finding, the input is kept in a temporary file.
fn answer(target: &Target, input: &[u8], effort: Effort) {
    let outcome = catch_unwind(AssertUnwindSafe(|| memory::peak(|| (target.answer)(input, effort))));
    match outcome {
        Ok(taken) => assert!(taken <= memory::MOST, "{taken} bytes for {} of input", input.len()),
        Err(panic) => {
            let name = format!("{}-{:016x}", target.name, files::hash(input));
            let path = std::env::temp_dir().join(&name);
            std::fs::write(&path, input).expect("a temporary file");
            eprintln!("{}: a finding of {}", path.display(), target.name);
            std::panic::resume_unwind(panic);
        }
    }
}

/// Seeds, then so many mutated ones and so many trees.
fn lots(name: &str, mutated: usize, trees: usize) {
    let target = Target::find(name).expect("a target");
    let more = if is_full_campaign() { 50 } else { 1 };
    let seeds = target.seeds();
    let words = (target.words)();
    seeds.iter().for_each(|seed| answer(target, seed, Effort::Sampled));
    let mut lot = Lot::new(1);
    for _ in 0..mutated * more {
        let mut input = lot.pick(&seeds).clone();
        for _ in 0..1 + lot.below(3) {
            let other = lot.pick(&seeds);
            input = mutation::mutated(&input, other, &words, &mut lot);
        }
        answer(target, &input, Effort::Sampled);
    }
    for _ in 0..trees * more {
        let choices: Vec<u8> = (0..2048).map(|_| lot.below(256) as u8).collect();
        let input = (target.tree)(&mut Unstructured::new(&choices)).unwrap_or_default();
        answer(target, input.as_bytes(), Effort::Sampled);
    }
}

#[test]
fn findings() {
    for target in &target::ALL {
        for path in files::findings(target.name) {
            answer(target, &files::bytes(&path), Effort::Whole);
        }
    }
}

#[test]
fn layouts() {
    lots("layout", 5000, 500);
}

#[test]
fn specifications() {
    lots("specification", 5000, 40);
}

#[test]
fn scenarios() {
    lots("scenario", 5000, 500);
}

#[test]
fn tables() {
    lots("table", 5000, 1000);
}

#[test]
fn imports() {
    lots("import", 5000, 2000);
}

#[test]
fn command_lines() {
    lots("command_line", 3000, 1000);
}
