//! Answers the inputs in files and judges all that is made of them, `answer TARGET FILE...`.

use autogen_fuzz::{Effort, Target, files, memory};
use std::path::Path;
use std::time::Instant;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().expect("the name of a target");
    let target = Target::find(&name).unwrap_or_else(|| panic!("there is no target {name}"));
    let mut wrong = 0;
    for path in arguments {
        let input = files::bytes(Path::new(&path));
        let begin = Instant::now();
        let mut taken = 0;
        let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            taken = memory::peak(|| (target.answer)(&input, Effort::Whole));
        }));
        let seconds = begin.elapsed().as_secs_f64();
        let is_wrong = outcome.is_err() || taken > memory::MOST;
        wrong += usize::from(is_wrong);
        println!("{path}: {seconds:.3} s, {} MB{}", taken >> 20, if is_wrong { ", a finding" } else { "" });
    }
    assert!(wrong == 0, "{wrong} findings");
}
