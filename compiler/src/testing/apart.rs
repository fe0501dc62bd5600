//! Whether a machine does the same if the others step too.

use super::{Given, Row, value};
use crate::ir::{Group, Scalar, System, Type, Value};

/// Whether neither the test nor another machine writes or reads what this machine shares, and it reads nothing of theirs.
pub fn is_for_any_engine(system: &System, machine: usize, rows: &[Row]) -> bool {
    let given = rows.iter().flat_map(|row| &row.given);
    let plays_device = given.into_iter().all(|given| match given {
        Given::Value(path, _) => {
            value::named(system, machine, path).is_ok_and(|named| named.group == Group::Input)
        }
        Given::Answer(..) | Given::PowerOff => true,
    });
    let knows_others = known(system, machine).iter().any(|other| *other != machine);
    let mut others = (0..system.instances.len()).filter(|other| *other != machine);
    plays_device && !knows_others && !others.any(|other| known(system, other).contains(&machine))
}

/// The machines to which an instance has references at the beginning: members of its roles, values of its parameters, and
/// what its variables begin with. Only through these it comes to others.
fn known(system: &System, machine: usize) -> Vec<usize> {
    let (automaton, instance) = (system.automaton_of(machine), &system.instances[machine]);
    let members = automaton.roles.iter().zip(&instance.roles).flat_map(|(role, rows)| {
        let members = &system.members[role.interface.0];
        rows.iter().map(|row| members[*row])
    });
    let parameters = automaton.parameters.iter().zip(&instance.parameters);
    let parameters =
        parameters.flat_map(|(declared, values)| values.iter().map(|value| (declared.ty, *value)));
    let locals = automaton.locals.iter().map(|local| (local.ty, local.initial));
    let interfaces =
        automaton.implements.iter().map(|implements| system.model.interface(implements.interface));
    let cells = interfaces.flat_map(|interface| &interface.cells).map(|cell| (cell.ty, cell.initial));
    let values = parameters.chain(locals).chain(cells);
    members.chain(values.filter_map(|(ty, value)| referred(system, ty, value))).collect()
}

/// The instance that a reference means, if it is one and there is any.
fn referred(system: &System, ty: Type, value: Value) -> Option<usize> {
    match (ty.scalar, value) {
        (Scalar::Ref(interface), Value::Int(row)) => {
            system.members[interface.0].get(usize::try_from(row).ok()?).copied()
        }
        _ => None,
    }
}
