//! What a state of the search and a scan of the executor have in common: states, locals and cells, but for points and reals,
//! which the search knows by some places only.

use autogen::ir::KeptBy;
use autogen::lower::Project;
use autogen_search::model::{Form, Model, Variable};
use autogen_search::reached::Reached;
use std::collections::{HashMap, HashSet};

/// The common values of states.
pub struct Common<'a> {
    model: &'a Model,
    /// Word of the executor's trace, and the value of the state.
    words: Vec<(usize, &'a Variable, i32, usize)>,
}

impl<'a> Common<'a> {
    pub fn new(project: &Project, model: &'a Model) -> Self {
        let by_name: HashMap<&str, &Variable> =
            model.variables.iter().map(|variable| (variable.name.as_str(), variable)).collect();
        let system = &project.system;
        let mut words = Vec::new();
        let mut at = 0;
        for (number, instance) in system.instances.iter().enumerate() {
            let automaton = system.automaton_of(number);
            words.push((at, by_name[format!("{}.(state)", instance.name).as_str()], 0, number));
            // Behind it stands the time in the state.
            at += 2;
            let mut take = |at: &mut usize, name: &str, ty: autogen::ir::Type| {
                let count = system.model.elements(ty.extent);
                for element in 0..count {
                    let full = if count == 1 { name.into() } else { format!("{name}[{element}]") };
                    let variable = by_name[format!("{}.{full}", instance.name).as_str()];
                    if let Form::Int(low) = variable.form {
                        words.push((*at, variable, low, number));
                    }
                    *at += if ty.scalar == autogen::ir::Scalar::Point { 3 } else { 1 };
                }
            };
            let (declared, kept): (Vec<_>, Vec<_>) =
                automaton.locals.iter().partition(|local| local.kept_by == KeptBy::Steps);
            declared.into_iter().for_each(|local| take(&mut at, &local.name, local.ty));
            // What properties keep is not searched, and stands behind all others.
            let words = |ty: autogen::ir::Type| ty.scalar.words() * system.model.elements(ty.extent);
            let kept: usize = kept.into_iter().map(|local| words(local.ty)).sum();
            at += kept;
            for implements in &automaton.implements {
                let cells = &system.model.interface(implements.interface).cells;
                cells.iter().for_each(|cell| take(&mut at, &cell.name, cell.ty));
            }
            let outputs = automaton.device.ports.iter();
            let outputs = outputs.filter(|port| port.direction == runtime_sim::device::Direction::Output);
            at += outputs.map(|port| port.words(system.kinds())).sum::<usize>() + automaton.alarm_words();
        }
        Self { model, words }
    }

    pub fn of_state(&self, state: &[u8]) -> Vec<i32> {
        self.words.iter().map(|(_, variable, low, _)| variable.var.load(state) + low).collect()
    }

    /// What is of no use in a state of its automaton is what it was at first.
    pub fn of_trace(&self, trace: &[f64]) -> Vec<i32> {
        let mut values: Vec<i32> = self.words.iter().map(|(word, ..)| trace[*word] as i32).collect();
        let mut state = 0;
        for (value, (_, variable, low, instance)) in values.iter_mut().zip(&self.words) {
            let program = &self.model.instances[*instance];
            if variable.var == program.state {
                state = *value as usize;
            } else if let Some((_, dead)) =
                program.states[state].dead.iter().find(|(var, _)| *var == variable.var)
            {
                *value = dead + low;
            }
        }
        values
    }

    pub fn of_all(&self, store: &Reached) -> HashSet<Vec<i32>> {
        (0..store.len()).map(|state| self.of_state(&store.state(state))).collect()
    }

    /// In what a scan differs from the state that it is most like.
    pub fn difference(&self, found: &[i32], all: &HashSet<Vec<i32>>) -> String {
        let apart = |other: &Vec<i32>| found.iter().zip(other).filter(|(a, b)| a != b).count();
        let Some(nearest) = all.iter().min_by_key(|other| apart(other)) else { return "no state".into() };
        let differing = self.words.iter().zip(found.iter().zip(nearest)).filter(|(_, (a, b))| a != b);
        let texts: Vec<String> = differing
            .map(|((_, variable, ..), (a, b))| format!("{} is {a}, not {b}", variable.name))
            .collect();
        texts.join(", ")
    }
}
