//! An evaluator: runs a checked text scan by scan.
//!
//! It is as strict as the strictest compiler: whole numbers do not wrap, both sides
//! of AND and OR are evaluated, nothing may be divided by zero, an index is tested.
//! Of initial values it knows those of scalars in PROGRAM and VAR_GLOBAL only, as
//! one compiler ignores all others; so does a text that relies on them run wrong here.

mod code;
mod compile;
mod construct;
mod layout;
mod place;
mod run;

pub use place::Place;

use crate::finding::{Finding, Place as TextPlace, Span};
use crate::types::Scalar;
use code::{Code, Trap};
use layout::Layouts;
use std::collections::BTreeMap;
use std::fmt;

/// A text in execution.
#[derive(Clone, Debug)]
pub struct Machine {
    source: String,
    code: Code,
    layouts: Layouts,
    /// By number.
    units: Vec<(String, Span)>,
    /// Every value takes one word.
    memory: Vec<u64>,
    /// The memory at power-up.
    initial: Vec<u64>,
    counters: Counters,
}

#[derive(Clone, Debug, Default)]
struct Counters {
    /// For each branch of a CASE, how often it was entered.
    branches: Vec<u64>,
    /// For each statement, how often it was executed.
    statements: Vec<u64>,
    /// For each condition of IF and ELSIF, how often it was tested.
    conditions: Vec<u64>,
    /// For each unit, the most statements that one call has executed.
    most: Vec<u64>,
    executed: u64,
    invalid: u64,
    scans: u64,
}

/// Why a scan could not be ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunError {
    pub kind: TrapKind,
    pub line: usize,
    pub column: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrapKind {
    Overflow,
    DivisionByZero,
    Index,
    /// An argument outside of what a standard function is defined for.
    Domain,
    EndlessLoop,
}

/// A branch of a CASE.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseBranch {
    pub unit: String,
    /// The labels as written, `ELSE` for the last.
    pub label: String,
    pub line: usize,
    pub entered: u64,
}

impl Machine {
    /// The text at power-up, before its first scan.
    pub fn new(source: &str) -> Result<Self, Vec<Finding>> {
        let checked = crate::judge(source)?;
        let layouts = Layouts::new(&checked);
        let code = compile::compile(&checked, &layouts);
        let mut memory = vec![0; layouts.size()];
        layouts.initialise(&checked, &mut memory);
        let counters = Counters {
            branches: vec![0; code.branches.len()],
            statements: vec![0; code.statements.len()],
            conditions: vec![0; code.conditions.len()],
            most: vec![0; code.units.len()],
            executed: 0,
            invalid: 0,
            scans: 0,
        };
        let units = checked.text.units.iter().map(|unit| (unit.name.text.clone(), unit.span)).collect();
        Ok(Self { source: source.into(), code, layouts, units, initial: memory.clone(), memory, counters })
    }

    /// Power was lost after the last scan: variables that are not `RETAIN` have their initial values again.
    pub fn power_up(&mut self) {
        let before = std::mem::replace(&mut self.memory, self.initial.clone());
        for word in self.layouts.retained() {
            self.memory[*word] = before[*word];
        }
    }

    /// Runs every program once.
    pub fn scan(&mut self) -> Result<(), RunError> {
        self.counters.scans += 1;
        run::scan(&self.code, &mut self.memory, &mut self.counters).map_err(|trap| self.located(trap))
    }

    fn located(&self, trap: Trap) -> RunError {
        let place = TextPlace::of(&self.source, trap.at);
        RunError { kind: trap.kind, line: place.line, column: place.column }
    }

    /// The place of a scalar: `global`, `global[2]`, `instance.variable`, `instance.array[2]`, where an
    /// instance is a variable of the PROGRAM. Case does not count.
    pub fn place(&self, path: &str) -> Option<Place> {
        self.layouts.place(path)
    }

    /// The value as a number: 0 and 1 for BOOL.
    pub fn read(&self, place: Place) -> f64 {
        let word = self.memory[place.address];
        match place.ty {
            Scalar::Bool => word as f64,
            Scalar::Dint | Scalar::Narrow(_) => f64::from(word as u32 as i32),
            Scalar::Lreal => f64::from_bits(word),
        }
    }

    /// Sets a value from a number; for DINT without its fraction.
    pub fn write(&mut self, place: Place, value: f64) {
        self.memory[place.address] = match place.ty {
            Scalar::Bool => u64::from(value != 0.0),
            Scalar::Dint | Scalar::Narrow(_) => u64::from(value as i32 as u32),
            Scalar::Lreal => value.to_bits(),
        };
    }

    /// The value at a path; a panic if there is none.
    pub fn get(&self, path: &str) -> f64 {
        self.read(self.place(path).unwrap_or_else(|| panic!("there is no `{path}`")))
    }

    pub fn set(&mut self, path: &str, value: f64) {
        let place = self.place(path).unwrap_or_else(|| panic!("there is no `{path}`"));
        self.write(place, value);
    }

    /// The variable at an address such as `%IX0.3`.
    pub fn at_address(&self, address: &str) -> Option<Place> {
        self.layouts.located(address)
    }

    /// Names and types of the global variables, arrays by element.
    pub fn globals(&self) -> Vec<String> {
        self.layouts.globals()
    }

    pub fn branches(&self) -> Vec<CaseBranch> {
        let branches = self.code.branches.iter().zip(&self.counters.branches);
        branches
            .map(|(branch, &entered)| CaseBranch {
                unit: branch.unit.clone(),
                label: branch.label.clone(),
                line: TextPlace::of(&self.source, branch.at).line,
                entered,
            })
            .collect()
    }

    /// Line and first words of the statements that were never executed.
    pub fn never_executed(&self) -> Vec<(usize, String)> {
        let statements = self.code.statements.iter().zip(&self.counters.statements);
        statements
            .filter(|(_, count)| **count == 0)
            .map(|(span, _)| {
                let text: String = self.source[span.start..span.end].chars().take(60).collect();
                (TextPlace::of(&self.source, span.start).line, text.lines().next().unwrap_or("").into())
            })
            .collect()
    }

    /// The constructs of the grammar that the text has, with how often each was executed.
    pub fn constructs(&self) -> BTreeMap<String, u64> {
        let mut executed = construct::Executed::new();
        for (_, span) in &self.units {
            let inside = self.code.statements.iter().zip(&self.counters.statements);
            let inside = inside.filter(|(s, _)| s.start >= span.start && s.end <= span.end);
            executed.insert(*span, inside.map(|(_, count)| *count).max().unwrap_or(0));
        }
        let conditions = self.code.conditions.iter().zip(&self.counters.conditions);
        let statements = self.code.statements.iter().zip(&self.counters.statements);
        executed.extend(conditions.chain(statements).map(|(span, count)| (*span, *count)));
        construct::counts(&self.source, &executed, self.counters.scans)
    }

    pub fn statements(&self) -> usize {
        self.code.statements.len()
    }

    /// The most statements that one call of each block or program has executed, with those of functions and
    /// without those of other blocks, counted as by [`Machine::executed`]; 0 for functions.
    pub fn most_executed(&self) -> Vec<(&str, u64)> {
        let names = self.units.iter().map(|(name, _)| name.as_str());
        names.zip(self.counters.most.iter().copied()).collect()
    }

    /// How many statements have been executed since power-up; a round of a loop counts one more.
    pub fn executed(&self) -> u64 {
        self.counters.executed
    }

    /// How many operations on reals have been executed since power-up that IEEE 754 calls invalid: those that make
    /// a NaN of numbers, and comparisons by order with a NaN. A controller may be set to stop at them.
    pub fn invalid_operations(&self) -> u64 {
        self.counters.invalid
    }

    /// The period of the first task, ms.
    pub fn interval_ms(&self) -> Option<u32> {
        self.code.interval_ms
    }
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}: {:?}", self.line, self.column, self.kind)
    }
}

impl std::error::Error for RunError {}
