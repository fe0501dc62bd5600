//! What two searches of a line have in common.

use autogen_search::explore::{End, Outcome};
use autogen_search::model::{Form, Model, Variable};
use std::collections::BTreeSet;

/// Why it ended, and what it found.
pub fn verdict(outcome: &Outcome) -> (End, Vec<String>) {
    let mut violations: Vec<String> = outcome.violations.iter().map(|(v, _)| format!("{v:?}")).collect();
    violations.sort();
    (outcome.end, violations)
}

/// What is left of its states, of these values alone.
pub fn states_of(
    model: &Model,
    outcome: &Outcome,
    is_kept: impl Fn(&Variable) -> bool,
) -> BTreeSet<Vec<[u64; 3]>> {
    let kept: Vec<_> = model.variables.iter().filter(|variable| is_kept(variable)).collect();
    let value = |state: &[u8], variable: &Variable| match variable.form {
        Form::Point => outcome.values.point(variable.var.load(state)).map(f64::to_bits),
        Form::Real => [outcome.values.real(variable.var.load(state)).to_bits(), 0, 0],
        Form::Int(_) => [variable.var.load(state) as u64, 0, 0],
    };
    let states = (0..outcome.reached.len()).map(|state| outcome.reached.state(state));
    states.map(|state| kept.iter().map(|variable| value(&state, variable)).collect()).collect()
}
