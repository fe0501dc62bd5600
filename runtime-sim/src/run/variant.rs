//! Controllers in a run, and what they gave in the last scan that they executed.

use super::agenda::Waits;
use crate::image::are_same;
use crate::line::Line;
use crate::plant;
use crate::scan::{Controllers, SystemInputs, SystemOutputs};

pub struct Variant<'a> {
    /// Among those of the run.
    pub number: usize,
    line: &'a Line,
    pub controllers: &'a mut dyn Controllers,
    /// None if they wait for the same as the first ones of [`Alike`].
    pub waits: Option<Waits<'a>>,
    /// An image for each machine, as it was published last.
    pub outputs: Vec<Vec<f64>>,
    /// Words of each image of outputs.
    words: Vec<usize>,
    /// What [`Controllers::trace`] gave; empty before the first scan.
    pub trace: Vec<f64>,
    pub answer: SystemOutputs,
}

impl<'a> Variant<'a> {
    /// Before their first scan.
    pub fn new(number: usize, line: &'a Line, controllers: &'a mut dyn Controllers) -> Self {
        let outputs = plant::outputs(line);
        Self {
            number,
            line,
            controllers,
            waits: None,
            words: outputs.iter().map(Vec::len).collect(),
            outputs,
            trace: Vec::new(),
            answer: SystemOutputs::default(),
        }
    }

    /// They execute a scan that comes so many after their last one. An error says that they changed the size of an image.
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
        if let Some(waits) = &mut self.waits {
            waits.step();
        }
        Ok(())
    }

    /// Whether another one gave the same, to the bit.
    pub fn gave_same(&self, other: &Self) -> bool {
        let of_machines = self.outputs.iter().zip(&other.outputs);
        self.answer == other.answer
            && self.trace.len() == other.trace.len()
            && are_same(&self.trace, &other.trace)
            && of_machines.into_iter().all(|(image, other)| are_same(image, other))
    }
}

/// Variants that have done the same so far.
pub struct Alike<'a> {
    pub first: Variant<'a>,
    /// What the first one waits for.
    pub waits: Waits<'a>,
    others: Vec<Variant<'a>>,
}

impl<'a> Alike<'a> {
    pub fn new(first: Variant<'a>, mut others: Vec<Variant<'a>>) -> Self {
        for other in &mut others {
            let waits_for_same = other.line.waits_for_same(first.line);
            other.waits = (!waits_for_same).then(|| Waits::new(other.line));
        }
        Self { waits: Waits::new(first.line), first, others }
    }

    pub fn iter(&self) -> impl Iterator<Item = &Variant<'a>> {
        std::iter::once(&self.first).chain(&self.others)
    }

    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Variant<'a>> {
        std::iter::once(&mut self.first).chain(&mut self.others)
    }

    /// All that they wait for.
    pub fn all_waits(&self) -> impl Iterator<Item = &Waits<'a>> {
        std::iter::once(&self.waits).chain(self.others.iter().filter_map(|other| other.waits.as_ref()))
    }

    /// Takes out those of the others that are not like the first one; none if all are.
    pub fn split_off(&mut self, is_like: impl Fn(&Variant<'a>, &Variant<'a>) -> bool) -> Option<Self> {
        let first = &self.first;
        if self.others.iter().all(|other| is_like(first, other)) {
            return None;
        }
        let (alike, apart): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.others).into_iter().partition(|other| is_like(first, other));
        self.others = alike;
        let mut apart = apart.into_iter();
        Some(Self::new(apart.next()?, apart.collect()))
    }
}
