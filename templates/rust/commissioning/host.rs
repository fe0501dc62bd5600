//! A host of the controllers without the simulator. In each scan it does the same as a real host, over pipes
//! instead of a fieldbus. A line of input has `run_permit start reset`, each 0 or 1, and then the input images of
//! all robots, in layout order, each with its number of words before it. A line of output has `running`,
//! `fault_code` and the output images. It stores nothing, so each of its starts is a cold start.
//!
//! Where the inputs end, and where a line is not such a line, the last scan is one without `run_permit`: what it
//! publishes holds the devices.

use adapters::layout::{Layout, input_words, latch, publish};
use adapters::words::Words;
use controllers::system::{System, SystemInputs};
use std::io::{Write, stdin, stdout};

fn main() -> Result<(), String> {
    let mut layout = Layout::compiled();
    let mut system = System::new();
    let mut result = Ok(());
    for line in stdin().lines() {
        match line.map_err(|e| e.to_string()).and_then(|line| latched(&line, &mut layout)) {
            Ok(inputs) => scan(inputs, &mut layout, &mut system)?,
            Err(reason) => {
                result = Err(reason);
                break;
            }
        }
    }
    scan(SystemInputs::default(), &mut layout, &mut system)?;
    result
}

/// Latches all inputs, or none.
fn latched(line: &str, layout: &mut Layout) -> Result<SystemInputs, String> {
    let mut words = Words::new(line);
    let mut truth = || match words.name()? {
        "0" => Ok(false),
        "1" => Ok(true),
        other => Err(format!("`{other}` is neither 0 nor 1")),
    };
    let inputs = SystemInputs { run_permit: truth()?, start: truth()?, reset: truth()? };
    let mut images = Vec::new();
    for robot in &layout.robots {
        let size = input_words(robot);
        words.expect(&size.to_string())?;
        let word = |_| words.name()?.parse::<f64>().map_err(|e| e.to_string());
        images.push((0..size).map(word).collect::<Result<Vec<f64>, String>>()?);
    }
    if !words.is_empty() {
        return Err("there are more words than inputs".into());
    }
    layout.robots.iter_mut().zip(&images).for_each(|(robot, image)| latch(robot, image));
    Ok(inputs)
}

/// One scan, before which a real host waits for its time, and all outputs.
fn scan(inputs: SystemInputs, layout: &mut Layout, system: &mut System) -> Result<(), String> {
    let answer = layout.scan(system, inputs);
    let mut out = format!("{} {}", u8::from(answer.running), answer.fault_code);
    let mut image = Vec::new();
    for robot in &layout.robots {
        publish(robot, answer.running, &mut image);
        for word in &image {
            out += &format!(" {word:?}");
        }
    }
    writeln!(stdout(), "{out}").map_err(|e| e.to_string())
}
