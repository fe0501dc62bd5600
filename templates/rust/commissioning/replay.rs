//! Scans without a simulator, from texts.

use crate::deployed::Deployed;
use runtime_sim::scan::{Controllers, SystemInputs};
use runtime_sim::words::Words;
use std::io::{self, BufRead, BufWriter, Write};

/// Each line of the standard input is a scan: `run_permit start reset`, then the inputs of all robots, the
/// number of each robot's words before them; or `power`: it was lost and is back. The answer to a scan is a line
/// of the bits, in hexadecimal, of the system's outputs, the published outputs and the trace.
pub fn replay(deployed: &mut Deployed) -> Result<(), String> {
    let mut out = BufWriter::new(io::stdout().lock());
    let mut outputs = vec![Vec::new(); deployed.robots()];
    for line in io::stdin().lock().lines() {
        let line = line.map_err(|e| e.to_string())?;
        if line == "power" {
            deployed.power_up();
            continue;
        }
        let mut words = Words::new(&line);
        let mut flag = || Ok::<bool, String>(words.int::<u8>()? != 0);
        let system = SystemInputs { run_permit: flag()?, start: flag()?, reset: flag()? };
        let number = |w: &mut Words| w.name()?.parse::<f64>().map_err(|e| e.to_string());
        let inputs = (0..outputs.len()).map(|_| words.list(number)).collect::<Result<Vec<_>, String>>()?;
        let answer = deployed.scan(system, &inputs, &mut outputs);
        let mut all = vec![
            f64::from(u8::from(answer.running)),
            f64::from(u8::from(answer.fault)),
            f64::from(answer.fault_code),
            f64::from(answer.fault_robot),
            f64::from(u8::from(answer.alarm)),
            f64::from(answer.alarm_code),
            f64::from(answer.alarm_robot),
        ];
        all.extend(outputs.iter().flatten());
        deployed.trace(&mut all);
        let bits = |word: &f64| if word.is_nan() { "nan".into() } else { format!("{:x}", word.to_bits()) };
        let bits: Vec<String> = all.iter().map(bits).collect();
        writeln!(out, "{}", bits.join(" ")).map_err(|e| e.to_string())?;
    }
    Ok(())
}
