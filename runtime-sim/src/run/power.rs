//! What reaches the devices while the controllers have no power.

use crate::line::Line;
use crate::machine::Machine;
use crate::part::Primitive;
use crate::wiring::Drives;

/// The outputs of controllers without power: all levels are off, but grippers keep what they hold. Commands stay as they
/// are, held.
#[derive(Clone)]
pub struct Unpowered {
    /// Words of levels that are off, by machine.
    off: Vec<Vec<usize>>,
    outputs: Vec<Vec<f64>>,
}

impl Unpowered {
    pub fn new(line: &Line) -> Self {
        let kinds = line.kinds.len();
        Self {
            off: line.machines.iter().map(|machine| levels_off(machine, kinds)).collect(),
            outputs: Vec::new(),
        }
    }

    /// `outputs` are those of the last scan with power.
    pub fn outputs(&mut self, outputs: &[Vec<f64>]) -> &[Vec<f64>] {
        self.outputs.clear();
        self.outputs.extend_from_slice(outputs);
        for (image, off) in self.outputs.iter_mut().zip(&self.off) {
            off.iter().for_each(|word| image[*word] = 0.0);
        }
        &self.outputs
    }
}

fn levels_off(machine: &Machine, kinds: usize) -> Vec<usize> {
    let mut words = Vec::new();
    let mut begin = 0;
    for output in &machine.wiring.outputs {
        let end = begin + output.size.words(kinds);
        if let Drives::Level { part, .. } = output.drives
            && !matches!(machine.parts[part].primitive, Primitive::Grip(_))
        {
            words.extend(begin..end);
        }
        begin = end;
    }
    words
}
