//! Where an automaton raises a fault.

use super::{Automaton, FaultId, Transition, UpdateKind};

impl Automaton {
    /// State and transition in which it raises a fault. Without a transition: by staying in the state; without either: in
    /// any state.
    pub fn situation(&self, fault: FaultId) -> [String; 2] {
        for state in &self.states {
            if state.within.as_ref().is_some_and(|(_, own)| *own == fault) {
                return [state.name.clone(), String::new()];
            }
            if let Some(transition) = state.transitions.iter().find(|t| raises(t, fault)) {
                let target = transition.target.map(|target| format!(" -> {}", self.states[target.0].name));
                return [state.name.clone(), transition.text.clone() + &target.unwrap_or_default()];
            }
        }
        Default::default()
    }
}

fn raises(transition: &Transition, fault: FaultId) -> bool {
    transition.updates.iter().any(|update| match &update.kind {
        UpdateKind::Assign { check, .. }
        | UpdateKind::Fill { check, .. }
        | UpdateKind::Copy { check, .. } => *check == Some(fault),
        UpdateKind::Command { arguments, .. } => arguments.iter().any(|a| a.check == Some(fault)),
    })
}
