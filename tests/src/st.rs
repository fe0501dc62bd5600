//! Emitted Structured Text beside the reference executor.

pub use autogen::testing::{Emitted, StructuredText};

use autogen::ir::System;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// The reference executor with the text beside it; the first difference stays.
pub struct Beside<'a> {
    system: &'a System,
    pub executor: autogen::executor::Executor<'a>,
    pub text: StructuredText,
    /// The same program in another dialect.
    other: Option<StructuredText>,
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
            system,
            executor: autogen::executor::Executor::new(system),
            text: StructuredText::new(system, emitted)?,
            other: None,
            instead: None,
            outputs: vec![Vec::new(); system.instances.len()],
            scans: 0,
            words: 0,
            difference: None,
        })
    }

    /// With the same program in another dialect.
    pub fn and(mut self, other: &Emitted) -> Result<Self, String> {
        self.other = Some(StructuredText::new(self.system, other)?);
        Ok(self)
    }

    /// A scan of the other dialect has to give the same words.
    fn scan_other(
        &mut self,
        system: SystemInputs,
        inputs: &[Vec<f64>],
        answer: SystemOutputs,
    ) -> Result<(), String> {
        let Some(other) = &mut self.other else { return Ok(()) };
        let scan = self.scans;
        let mut outputs = vec![Vec::new(); self.outputs.len()];
        let answered = other.scan(system, inputs, &mut outputs);
        let (mut first, mut second) = (Vec::new(), Vec::new());
        Controllers::trace(&self.text, &mut first);
        Controllers::trace(other, &mut second);
        let bits = |words: &[Vec<f64>]| words.concat().iter().map(|w| w.to_bits()).collect::<Vec<_>>();
        // A coordinate that nobody reads is left out, or a part of its point that nobody sets.
        let differs =
            |i: &usize| self.text.has(*i) && other.has(*i) && first[*i].to_bits() != second[*i].to_bits();
        let at = (0..first.len()).find(differs);
        let is_same = answered == answer
            && bits(&outputs) == bits(&self.outputs)
            && at.is_none()
            && other.ended.is_none();
        self.words += (first.len() + outputs.concat().len()) as u64;
        if is_same {
            return Ok(());
        }
        let at =
            at.map(|i| format!("{} is {}, in the other dialect {}", other.names[i], first[i], second[i]));
        Err(format!("scan {scan}: {}", at.or(other.ended.clone()).unwrap_or("outputs differ".into())))
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
            let compared = self.compare(outputs, (answer, other));
            let compared = compared.and_then(|()| self.scan_other(system, inputs, other));
            self.difference = self.text.ended.clone().or_else(|| compared.err());
            self.scans += 1;
        }
        answer
    }

    fn power_up(&mut self) {
        self.executor.power_up();
        self.text.power_up();
        self.other.iter_mut().for_each(Controllers::power_up);
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
