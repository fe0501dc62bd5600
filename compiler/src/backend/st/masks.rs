//! Properties see outputs as they are put out: stop values while a robot is stopped, those of the panel by hand.

use super::block::{Candidate, Origin};
use super::code::{Arm, Ex, Stmt, and, assign, name, not, when};
use super::context::Lowering;
use super::declaration::{Variable, constants};
use super::property::own_stop;
use super::value::stop_value;
use crate::ir::ByHand;

/// For the block of the properties.
pub struct Masks {
    /// What comes before the tests.
    pub statements: Vec<Stmt>,
    /// Of each output that is masked, its name, and that of the input with the value that the steps have set.
    pub set: Vec<(String, String)>,
}

impl Masks {
    pub fn new(lowering: &mut Lowering) -> Self {
        let automaton = lowering.automaton();
        let modes = automaton.modes.as_ref();
        let mut set = Vec::new();
        let (mut running, mut by_hand, mut with_command, mut stopped) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for port in &automaton.masked {
            let declared = &automaton.device.ports[*port];
            let Some(stop) = stop_value(declared).map(constants) else { continue };
            let published = modes.and_then(|modes| modes.published[*port].as_ref());
            for (output, stop) in lowering.own().ports[*port].iter().zip(stop) {
                let input = lowering.free_name(&format!("{output}_set"));
                running.push(assign(output, name(&input)));
                stopped.push(assign(output, stop.clone()));
                by_hand.push(assign(output, stop));
                if let Some(ByHand::Argument) = published {
                    with_command.push(assign(output, name(&input)));
                }
                set.push((output.clone(), input));
            }
            if let Some(ByHand::Panel(value)) = published {
                let mut before = Vec::new();
                let value = lowering.value(value, &mut before);
                let output = &lowering.own().ports[*port][0];
                by_hand.pop();
                by_hand.push(assign(output, value));
            }
        }
        if set.is_empty() {
            return Self { statements: Vec::new(), set };
        }
        let local = |local: usize| name(&lowering.own().locals[local][0]);
        let moved = modes.map(|modes| not(local(modes.moved_by_hand)));
        let runs = and([not(own_stop())].into_iter().chain(moved).collect());
        let arm = |condition: Ex, body: Vec<Stmt>| Arm { comments: Vec::new(), condition, body };
        let mut arms = vec![arm(runs, running)];
        arms.extend(modes.and_then(|modes| modes.by_hand).map(|by| arm(local(by), by_hand)));
        let about = "Properties see what is put out.";
        let mut statements = vec![Stmt::Comment(about.into()), Stmt::If(arms, stopped)];
        if let Some(commanded) = modes.and_then(|modes| modes.commanded)
            && !with_command.is_empty()
        {
            statements.push(when(local(commanded), with_command));
        }
        Self { statements, set }
    }
}

/// Makes the candidates of these outputs inputs with what the steps have set; the variables that are put out.
pub fn put_out(candidates: &mut [Candidate], set: &[(String, String)]) -> Vec<Variable> {
    let mut variables = Vec::new();
    for (output, input) in set {
        let Some(candidate) = candidates.iter_mut().find(|c| c.variable.name == *output) else { continue };
        variables.push(Variable { is_retained: false, ..candidate.variable.clone() });
        let about = format!("{output}, as the steps have set it");
        let variable =
            Variable { name: input.clone(), comments: vec![about.into()], ..candidate.variable.clone() };
        *candidate = Candidate::given(variable, Origin::KeptAs(output.clone()));
    }
    variables
}
