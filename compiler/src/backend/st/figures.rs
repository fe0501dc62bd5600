//! How large the program is, and how much a scan can execute at most.

use super::Line;
use super::body::Size;
use super::bounds::written;
use super::code::Stmt;
use super::context::Shared;
use super::declaration::Unit;
use crate::ir::AutomatonId;
use std::fmt::Write;

/// Name and most statements of a unit, and how many instances there are of it.
struct Bound<'a> {
    name: &'a str,
    once: u64,
    instances: u64,
}

impl Bound<'_> {
    fn total(&self) -> u64 {
        self.once.saturating_mul(self.instances)
    }
}

/// `bounds.txt`
pub fn report<'l>(shared: Shared, line: &'l Line) -> String {
    let count =
        |unit: &Unit| line.program.instances.iter().filter(|i| i.block == unit.name).count().max(1) as u64;
    let sizes: Vec<(&Unit, Size)> = line.units().map(|unit| (unit, unit.body.size())).collect();
    let bound = |(unit, size): &(&'l Unit, Size)| Bound {
        name: &unit.name,
        once: size.greatest,
        instances: count(unit),
    };
    let bounds: Vec<Bound> = sizes.iter().map(bound).collect();
    let mut text = String::from(
        "The most statements that one scan executes. An assignment, a call, a test and an iteration of a loop count one each.\nThe program is not a safety function.\n\n",
    );
    let _ = writeln!(text, "{:<32} {:>8} {:>9} {:>9}", "unit", "once", "instances", "together");
    for bound in &bounds {
        let _ = writeln!(
            text,
            "{:<32} {:>8} {:>9} {:>9}",
            bound.name,
            bound.once,
            bound.instances,
            bound.total()
        );
    }
    let total = bounds.iter().fold(0u64, |sum, bound| sum.saturating_add(bound.total()));
    let _ = writeln!(text, "{:<32} {:>8} {:>9} {total:>9}", "all", "", "");
    let (statements, transitions) = transitions(shared, line);
    let _ = writeln!(
        text,
        "\n{} statements are written; {statements} of them for {transitions} transitions: {:.1} each.",
        sizes.iter().map(|(_, size)| size.written).sum::<u64>(),
        statements as f64 / transitions.max(1) as f64
    );
    text
}

/// Statements in the branches of the states, and the transitions that they are for.
fn transitions(shared: Shared, line: &Line) -> (u64, usize) {
    let mut statements = 0;
    let mut transitions = 0;
    for (number, blocks) in line.blocks.iter().enumerate() {
        let Some(blocks) = blocks else { continue };
        let automaton = shared.system.model.automaton(AutomatonId(number));
        transitions += automaton.states.iter().map(|s| s.transitions.len()).sum::<usize>();
        for piece in blocks.steps.unit.body.pieces() {
            for statement in piece.iter() {
                if let Stmt::Case { branches, .. } = statement {
                    statements += branches.iter().map(|(_, body)| written(body)).sum::<u64>();
                }
            }
        }
    }
    (statements, transitions)
}
