//! Controllers in a run, and what they gave in the last scan that they executed.

use super::agenda::Waits;
use crate::line::Line;
use crate::plant;
use crate::scan::{Controllers, SystemInputs, SystemOutputs};

pub struct Variant<'a> {
    pub controllers: &'a mut dyn Controllers,
    pub waits: Waits<'a>,
    pub outputs: Vec<Vec<f64>>,
    /// Words of each image of outputs.
    words: Vec<usize>,
    pub trace: Vec<f64>,
    pub answer: SystemOutputs,
}

impl<'a> Variant<'a> {
    /// Before their first scan.
    pub fn new(line: &'a Line, controllers: &'a mut dyn Controllers) -> Self {
        let outputs = plant::outputs(line);
        Self {
            controllers,
            waits: Waits::new(line),
            words: outputs.iter().map(Vec::len).collect(),
            outputs,
            trace: Vec::new(),
            answer: SystemOutputs::default(),
        }
    }

    /// They execute a scan that comes so many after their last one.
    pub fn execute(
        &mut self,
        scan: u64,
        scans: u64,
        system: SystemInputs,
        inputs: &[Vec<f64>],
    ) -> Result<(), String> {
        self.controllers.skip(scans - 1);
        self.answer = self.controllers.scan(system, inputs, &mut self.outputs);
        if self.outputs.iter().zip(&self.words).any(|(image, words)| image.len() != *words) {
            return Err(format!("the controllers changed the size of an output image in scan {scan}"));
        }
        self.trace.clear();
        self.controllers.trace(&mut self.trace);
        self.waits.step();
        Ok(())
    }
}
