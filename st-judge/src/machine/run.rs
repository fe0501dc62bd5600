//! Execution of the internal form.

mod number;

use super::code::{
    Any, Arm, BlockCall, Body, Case, Cell, Code, FunctionCall, Slot, Step, Trap, Truth, Whole,
};
use super::{Counters, TrapKind};

/// A loop that goes round more often will not end.
const MOST_ROUNDS: usize = 1_000_000;

pub(super) fn scan(code: &Code, memory: &mut [u64], counters: &mut Counters) -> Result<(), Trap> {
    let mut runner = Runner { code, memory, counters, values: Vec::new(), inside: 0 };
    for &(unit, base) in &code.programs {
        runner.unit(unit, base)?;
    }
    Ok(())
}

struct Runner<'r> {
    code: &'r Code,
    memory: &'r mut [u64],
    counters: &'r mut Counters,
    /// Values of arguments before they are stored.
    values: Vec<u64>,
    /// Statements executed in blocks that the present one has called.
    inside: u64,
}

enum Flow {
    On,
    Exit,
    Return,
}

impl Runner<'_> {
    /// A block or a program.
    fn unit(&mut self, unit: usize, base: usize) -> Result<(), Trap> {
        let before = self.counters.executed;
        let inside = std::mem::take(&mut self.inside);
        let code = self.code;
        self.body(&code.units[unit], base)?;
        let all = self.counters.executed - before;
        let most = &mut self.counters.most[unit];
        *most = (*most).max(all - self.inside);
        self.inside = inside + all;
        Ok(())
    }

    fn body(&mut self, body: &Body, base: usize) -> Result<Flow, Trap> {
        for numbered in body {
            self.counters.statements[numbered.number] += 1;
            self.counters.executed += 1;
            match self.step(&numbered.step, base)? {
                Flow::On => {}
                leave => return Ok(leave),
            }
        }
        Ok(Flow::On)
    }

    fn step(&mut self, step: &Step, base: usize) -> Result<Flow, Trap> {
        match step {
            Step::Store(cell, value) => {
                let word = self.word(value, base)?;
                let address = self.address(cell, base)?;
                self.memory[address] = word;
            }
            Step::Call(call) => self.call_block(call, base)?,
            Step::If(arms, otherwise) => {
                for Arm { number, condition, body } in arms {
                    self.counters.conditions[*number] += 1;
                    if self.truth(condition, base)? {
                        return self.body(body, base);
                    }
                }
                return self.body(otherwise, base);
            }
            Step::Case(case) => return self.case(case, base),
            Step::While(condition, body, at) => return self.repeat(condition, body, *at, base),
            Step::Exit => return Ok(Flow::Exit),
            Step::Return => return Ok(Flow::Return),
        }
        Ok(Flow::On)
    }

    fn case(&mut self, case: &Case, base: usize) -> Result<Flow, Trap> {
        let subject = self.whole(&case.subject, base)?;
        let arm = match case.labels.binary_search_by_key(&subject, |(label, _)| *label) {
            Ok(found) => case.labels[found].1,
            Err(_) => case.arms.len() - 1,
        };
        let (branch, body) = &case.arms[arm];
        self.counters.branches[*branch] += 1;
        self.body(body, base)
    }

    fn repeat(&mut self, condition: &Truth, body: &Body, at: usize, base: usize) -> Result<Flow, Trap> {
        for _ in 0..MOST_ROUNDS {
            if !self.truth(condition, base)? {
                return Ok(Flow::On);
            }
            self.counters.executed += 1;
            match self.body(body, base)? {
                Flow::On => {}
                Flow::Exit => return Ok(Flow::On),
                Flow::Return => return Ok(Flow::Return),
            }
        }
        Err(Trap { kind: TrapKind::EndlessLoop, at })
    }

    /// Evaluates all inputs before it stores the first.
    fn store_inputs(&mut self, inputs: &[(usize, Any)], base: usize, frame: usize) -> Result<(), Trap> {
        let first = self.values.len();
        for (_, value) in inputs {
            match value {
                Any::Array(slot, words) => {
                    let start = address(*slot, base);
                    let memory = &self.memory;
                    self.values.extend(&memory[start..start + words]);
                }
                value => {
                    let word = self.word(value, base)?;
                    self.values.push(word);
                }
            }
        }
        let mut next = first;
        for (offset, value) in inputs {
            let words = if let Any::Array(_, words) = value { *words } else { 1 };
            let start = frame + offset;
            self.memory[start..start + words].copy_from_slice(&self.values[next..next + words]);
            next += words;
        }
        self.values.truncate(first);
        Ok(())
    }

    fn call_block(&mut self, call: &BlockCall, base: usize) -> Result<(), Trap> {
        let frame = address(call.instance, base);
        self.store_inputs(&call.inputs, base, frame)?;
        self.unit(call.unit, frame)?;
        for (offset, slot, words) in &call.copied_back {
            let start = frame + offset;
            self.memory.copy_within(start..start + words, address(*slot, base));
        }
        Ok(())
    }

    /// A function has no memory: its frame begins with zeros at each call.
    fn call_function(&mut self, call: &FunctionCall, base: usize) -> Result<u64, Trap> {
        let first = self.values.len();
        for (_, value) in &call.inputs {
            let word = self.word(value, base)?;
            self.values.push(word);
        }
        self.memory[call.base..call.base + call.size].fill(0);
        for (i, (offset, _)) in call.inputs.iter().enumerate() {
            self.memory[call.base + offset] = self.values[first + i];
        }
        self.values.truncate(first);
        let code = self.code;
        self.body(&code.units[call.unit], call.base)?;
        Ok(self.memory[call.base])
    }

    fn word(&mut self, value: &Any, base: usize) -> Result<u64, Trap> {
        Ok(match value {
            Any::Truth(value) => u64::from(self.truth(value, base)?),
            Any::Whole(value) => u64::from(self.whole(value, base)? as u32),
            Any::Real(value) => self.real(value, base)?.to_bits(),
            Any::Array(..) => unreachable!("the check refuses whole arrays here"),
        })
    }

    fn address(&mut self, cell: &Cell, base: usize) -> Result<usize, Trap> {
        match cell {
            Cell::Slot(slot) => Ok(address(*slot, base)),
            Cell::Element { start, length, index, at } => {
                let index = self.whole(index, base)?;
                match usize::try_from(index) {
                    Ok(index) if index < *length => Ok(address(*start, base) + index),
                    _ => Err(Trap { kind: TrapKind::Index, at: *at }),
                }
            }
        }
    }

    fn load(&mut self, cell: &Cell, base: usize) -> Result<u64, Trap> {
        let address = self.address(cell, base)?;
        Ok(self.memory[address])
    }

    /// Both sides of an operator are always evaluated.
    fn truth(&mut self, truth: &Truth, base: usize) -> Result<bool, Trap> {
        Ok(match truth {
            Truth::Constant(value) => *value,
            Truth::Load(cell) => self.load(cell, base)? != 0,
            Truth::Not(operand) => !self.truth(operand, base)?,
            Truth::And(both) => self.truth(&both.0, base)? & self.truth(&both.1, base)?,
            Truth::Or(both) => self.truth(&both.0, base)? | self.truth(&both.1, base)?,
            Truth::Xor(both) => self.truth(&both.0, base)? ^ self.truth(&both.1, base)?,
            Truth::Wholes(operator, both) => {
                number::compare(*operator, self.whole(&both.0, base)?, self.whole(&both.1, base)?)
            }
            Truth::Reals(operator, both) => {
                let (left, right) = (self.real(&both.0, base)?, self.real(&both.1, base)?);
                self.counters.invalid += u64::from(number::is_invalid_comparison(*operator, left, right));
                number::compare(*operator, left, right)
            }
            Truth::Select(parts) => {
                let gate = self.truth(&parts.0, base)?;
                let (zero, one) = (self.truth(&parts.1, base)?, self.truth(&parts.2, base)?);
                if gate { one } else { zero }
            }
            Truth::Call(call) => self.call_function(call, base)? != 0,
        })
    }

    fn load_whole(&mut self, cell: &Cell, base: usize) -> Result<i32, Trap> {
        Ok(self.load(cell, base)? as u32 as i32)
    }

    fn two(&mut self, both: &(Whole, Whole), base: usize) -> Result<(i32, i32), Trap> {
        Ok((self.whole(&both.0, base)?, self.whole(&both.1, base)?))
    }
}

fn address(slot: Slot, base: usize) -> usize {
    match slot {
        Slot::Frame(offset) => base + offset,
        Slot::Memory(address) => address,
    }
}
