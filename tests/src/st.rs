//! Emitted Structured Text beside the reference executor.

pub use autogen::testing::{Emitted, StructuredText};

use autogen::ir::System;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// The reference executor with the text beside it; the first difference stays.
pub struct Beside<'a> {
    pub executor: autogen::executor::Executor<'a>,
    pub text: StructuredText,
    /// What the globals of the text get instead of the inputs of the next scan.
    pub instead: Option<(SystemInputs, Vec<Vec<f64>>)>,
    outputs: Vec<Vec<f64>>,
    pub scans: u64,
    /// Words compared.
    pub words: u64,
    pub difference: Option<String>,
}

impl<'a> Beside<'a> {
    pub fn new(system: &'a System, emitted: &Emitted) -> Result<Self, String> {
        Ok(Self {
            executor: autogen::executor::Executor::new(system),
            text: StructuredText::new(system, emitted)?,
            instead: None,
            outputs: vec![Vec::new(); system.instances.len()],
            scans: 0,
            words: 0,
            difference: None,
        })
    }

    fn compare(
        &mut self,
        outputs: &[Vec<f64>],
        answers: (SystemOutputs, SystemOutputs),
    ) -> Result<(), String> {
        let scan = self.scans;
        if answers.0 != answers.1 {
            return Err(format!("scan {scan}: {:?}, the text {:?}", answers.0, answers.1));
        }
        for (robot, (image, other)) in outputs.iter().zip(&self.outputs).enumerate() {
            self.words += image.len() as u64;
            if image.len() != other.len() || image.iter().zip(other).any(|(a, b)| a.to_bits() != b.to_bits())
            {
                return Err(format!("scan {scan}: robot {robot} publishes {image:?}, the text {other:?}"));
            }
        }
        let (mut trace, mut other) = (Vec::new(), Vec::new());
        self.executor.trace(&mut trace);
        Controllers::trace(&self.text, &mut other);
        if trace.len() != other.len() {
            return Err(format!("the traces have {} and {} words", trace.len(), other.len()));
        }
        self.words += trace.len() as u64;
        match trace.iter().zip(&other).position(|(a, b)| a.to_bits() != b.to_bits()) {
            Some(i) => {
                Err(format!("scan {scan}: {} is {}, in the text {}", self.text.names[i], trace[i], other[i]))
            }
            None => Ok(()),
        }
    }
}

impl Controllers for Beside<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let answer = self.executor.scan(system, inputs, outputs);
        if self.difference.is_none() {
            let mut own = std::mem::take(&mut self.outputs);
            let instead = self.instead.take();
            let (system, inputs) = instead.as_ref().map_or((system, inputs), |(s, i)| (*s, i.as_slice()));
            let other = self.text.scan(system, inputs, &mut own);
            self.outputs = own;
            self.difference =
                self.text.ended.clone().or_else(|| self.compare(outputs, (answer, other)).err());
            self.scans += 1;
        }
        answer
    }

    fn power_up(&mut self) {
        self.executor.power_up();
        self.text.power_up();
    }

    fn state(&self, machine: usize) -> usize {
        self.executor.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.executor.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.executor.stays()
    }

    fn skip(&mut self, scans: u64) {
        assert_eq!(scans, 0, "the text runs in every scan");
    }
}
