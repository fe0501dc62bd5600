//! Nanoseconds that a scan of the compiled controllers takes, with the same inputs all the time.

use commissioning::deployed::Deployed;
use runtime_sim::scan::{Controllers, SystemInputs};
use std::hint::black_box;
use std::time::Instant;

const ROUNDS: usize = 7;
const SCANS: u32 = 20_000;

fn main() {
    let mut controllers = Deployed::compiled();
    let inputs = vec![vec![0.0]; controllers.robots()];
    let mut outputs = vec![Vec::new(); controllers.robots()];
    let mut scan = |start: bool| {
        let system = SystemInputs { run_permit: true, start, reset: false };
        black_box(controllers.scan(system, black_box(&inputs), &mut outputs))
    };
    scan(false);
    assert!(scan(true).running, "the line runs");
    let round = |_| {
        let begin = Instant::now();
        for _ in 0..SCANS {
            assert!(!scan(false).fault, "no property is violated");
        }
        begin.elapsed().as_secs_f64() * 1e9 / f64::from(SCANS)
    };
    println!("{}", (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min));
}
