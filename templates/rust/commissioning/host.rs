//! A host of the controllers without the simulator. In each scan it does the same as a real host, over pipes
//! instead of a fieldbus. A line of input has `run_permit start reset` and then the input images of
//! all robots, in layout order, each with its number of words before it. A line of output has `running`,
//! `fault_code` and the output images.

use adapters::layout::{Layout, latch, publish};
use controllers::system::{System, SystemInputs};
use std::io::{BufRead, stdin};

fn main() {
    let mut layout = Layout::compiled();
    let mut system = System::new();
    let mut image = Vec::new();
    for line in stdin().lock().lines() {
        let Ok(line) = line else { break };
        let mut words = line.split_whitespace().map(|word| word.parse::<f64>().unwrap_or(0.0));
        let mut next = || words.next().unwrap_or(0.0);

        // Latch all inputs.
        let inputs = SystemInputs { run_permit: next() != 0.0, start: next() != 0.0, reset: next() != 0.0 };
        for robot in &mut layout.robots {
            let size = next() as usize;
            image.clear();
            image.extend((0..size).map(|_| next()));
            latch(robot, &image);
        }

        // One scan; a real host waits for the next period before it.
        let answer = layout.scan(&mut system, inputs);

        // Publish all outputs.
        let mut out = format!("{} {}", u8::from(answer.running), answer.fault_code);
        for robot in &layout.robots {
            publish(robot, answer.running, &mut image);
            for word in &image {
                out += &format!(" {word:?}");
            }
        }
        println!("{out}");
    }
}
