//! Small layouts of some of the automata, in the text of the hand-written traces.

use super::lot::Lot;
use autogen::ir::{Automaton, InterfaceId, Model, Parameter, RoleKind, Scalar};
use std::fmt::Write;

/// A layout with two instances of each of these automata, and one of the anchor.
pub fn layout(lot: &mut Lot, model: &Model, automata: &[usize]) -> String {
    let kinds = &model.enums[autogen::ir::KIND.0].members;
    let mut out = format!("scan_ms {}\nkinds {}\n", lot.pick(&[10, 10, 4, 25]), kinds.join(" "));
    let mut machines: Vec<(String, &Automaton)> = Vec::new();
    for &id in automata {
        let automaton = &model.automata[id];
        for copy in ["a", "b"] {
            if automaton.name != "Anchor" || copy == "a" {
                machines.push((format!("{}_{copy}", automaton.name.to_lowercase()), automaton));
            }
        }
    }
    // Not always the anchor first.
    let by = lot.below(machines.len());
    machines.rotate_left(by);
    let members = |interface: InterfaceId| {
        let is_member = |m: &&(String, &Automaton)| m.1.implementing(interface).is_some();
        machines.iter().filter(is_member).map(|m| m.0.clone()).collect::<Vec<String>>()
    };
    for (name, automaton) in &machines {
        let settings = automaton.parameters.iter().map(|p| setting(lot, model, p, &members));
        let settings: Vec<String> = settings.collect();
        let _ = writeln!(out, "{name}: {} {}", automaton.name, settings.join(" "));
        for role in &automaton.roles {
            if role.kind == RoleKind::Knows && !lot.one_in(6) {
                continue;
            }
            let others = members(role.interface).into_iter().filter(|m| m != name && !lot.one_in(3));
            let _ = writeln!(out, "{name}.{} = {}", role.name, others.collect::<Vec<_>>().join(" "));
        }
    }
    for (a, _) in &machines {
        for (b, _) in &machines {
            if lot.one_in(3) {
                let _ = writeln!(out, "reaches {a} {b}");
            }
        }
    }
    out
}

fn setting(
    lot: &mut Lot,
    model: &Model,
    parameter: &Parameter,
    members: &dyn Fn(InterfaceId) -> Vec<String>,
) -> String {
    let mut value = || match parameter.ty.scalar {
        Scalar::Bool => lot.below(2).to_string(),
        Scalar::Int { lo, hi } => lot.between(lo, hi).to_string(),
        Scalar::Real => format!("{:?}", lot.real()),
        Scalar::Time => lot.between(0, 90).to_string(),
        Scalar::Point => format!("({:?},{:?},{:?})", lot.real(), lot.real(), lot.real()),
        Scalar::Enum(id) => lot.pick(&model.enums[id.0].members).clone(),
        Scalar::Ref(interface) => lot.pick(&members(interface)).clone(),
    };
    let text = match parameter.ty.extent {
        autogen::ir::Extent::One => value(),
        extent => {
            let values: Vec<String> = (0..model.elements(extent)).map(|_| value()).collect();
            format!("[{}]", values.join(","))
        }
    };
    format!("{}={text}", parameter.name)
}
