//! Properties see outputs as they are put out: stop values while a robot is stopped, those of the panel by hand.

use super::block::{Candidate, Origin};
use super::code::{Stmt, and, name, not};
use super::context::Lowering;
use super::declaration::{Variable, constants};
use super::modes::PutOut;
use super::name::Name;
use super::property::own_stop;
use super::value::stop_value;
use crate::ir::ByHand;

/// For the block of the properties.
pub struct Masks {
    /// What comes before the tests.
    pub statements: Vec<Stmt>,
    /// Of each output that is masked, its name, and that of the input with the value that the steps have set.
    pub set: Vec<(Name, Name)>,
}

impl Masks {
    pub fn new(lowering: &mut Lowering) -> Self {
        let automaton = lowering.automaton();
        let modes = automaton.modes.as_ref();
        let (mut put, mut set) = (PutOut::default(), Vec::new());
        for port in &automaton.masked {
            let Some(stop) = stop_value(&automaton.device.ports[*port]).map(constants) else { continue };
            let published = modes.and_then(|modes| modes.published[*port].as_ref());
            let panel = match published {
                Some(ByHand::Panel(value)) => Some(lowering.value(value, &mut Vec::new())),
                _ => None,
            };
            for (output, stop) in lowering.own().ports[*port].iter().zip(stop) {
                let input = Name::from(lowering.free_name(&format!("{output}_set")));
                put.add(output, [name(&input), stop], published, panel.clone());
                set.push((output.clone(), input));
            }
        }
        let local = |local: usize| name(&lowering.own().locals[local][0]);
        let moved = modes.map(|modes| not(local(modes.moved_by_hand)));
        let runs = and([not(own_stop())].into_iter().chain(moved).collect());
        let mut statements = put.statements(runs, modes, local);
        if !statements.is_empty() {
            statements.insert(0, Stmt::Comment("Properties see what is put out.".into()));
        }
        Self { statements, set }
    }
}

/// Makes the candidates of these outputs inputs with what the steps have set; the variables that are put out.
pub fn put_out(candidates: &mut [Candidate], set: &[(Name, Name)]) -> Vec<Variable> {
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
