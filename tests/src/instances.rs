//! Systems without a layout: some instances of each automaton of a specification.

use autogen::check::check;
use autogen::ir::{Automaton, Extent, Instance, Model, ParameterSource, Scalar, System, Value};
use autogen::layout::Panel;
use autogen::source::Sources;
use autogen::spec::parser;
use autogen::{device, lower};
use runtime_sim::random::Random;

/// Two instances of each automaton. Every role has all members that fit it, all constants of devices are
/// drawn by lot, and every other member is reached.
pub fn instantiate(files: &[(String, String)]) -> (System, Sources) {
    panelled(files, Panel::Line)
}

/// The same, of machines with such panels.
pub fn panelled(files: &[(String, String)], panel: Panel) -> (System, Sources) {
    let mut sources = Sources::default();
    let mut trees = crate::devices(&mut sources);
    let mut diagnostics = Vec::new();
    for (name, text) in files {
        let id = sources.add(name.as_str(), text.as_str());
        let (tree, found) = parser::parse(id, text);
        diagnostics.extend(found);
        trees.push((id, tree));
    }
    if panel == Panel::Machines {
        device::panel::add(&mut trees);
    }
    let kinds = ["bolt", "nut", "washer"].map(String::from);
    let mut model = match check(&sources, &trees, Some(&kinds)) {
        Ok(checked) if diagnostics.is_empty() => checked.into_model(),
        Ok(_) => panic!("{}", crate::plain(&sources, &diagnostics)),
        Err(found) => {
            diagnostics.extend(found);
            panic!("{}", crate::plain(&sources, &diagnostics))
        }
    };
    lower::complete(&mut model, panel);
    (system(model), sources)
}

fn system(model: Model) -> System {
    let mut random = Random::new(7);
    let mut instances = Vec::new();
    let mut members = vec![Vec::new(); model.interfaces.len()];
    for copy in ["one", "two"] {
        for (id, automaton) in model.automata.iter().enumerate() {
            let rows = automaton.implements.iter().map(|i| {
                members[i.interface.0].push(instances.len());
                members[i.interface.0].len() - 1
            });
            instances.push(Instance {
                name: format!("{}_{copy}", automaton.name.to_lowercase()),
                automaton: autogen::ir::AutomatonId(id),
                rows: rows.collect(),
                parameters: parameters(&model, automaton, &mut random),
                roles: Vec::new(),
            });
        }
    }
    for index in 0..instances.len() {
        let roles = model.automaton(instances[index].automaton).roles.iter().map(|role| {
            let fits = |instance: &usize| {
                let automaton = model.automaton(instances[*instance].automaton);
                role.also.iter().all(|also| automaton.implementing(*also).is_some())
            };
            let rows = members[role.interface.0].iter().enumerate();
            rows.filter(|(_, instance)| fits(instance)).map(|(row, _)| row).collect()
        });
        instances[index].roles = roles.collect();
    }
    let reaches = model.relations.iter().map(|relation| {
        let (from, to) = (members[relation.from.0].len(), members[relation.to.0].len());
        (0..from).map(|i| (0..to).map(|j| (i + j) % 2 == 0).collect()).collect()
    });
    let reaches = reaches.collect();
    System { model, scan_ms: 10, instances, members, reaches }
}

fn parameters(model: &Model, automaton: &Automaton, random: &mut Random) -> Vec<Vec<Value>> {
    let mut coordinate = || f64::from(random.up_to(4000)) / 1000.0 - 2.0;
    let mut value = |ty: Scalar| match ty {
        Scalar::Real => Value::Real(coordinate()),
        Scalar::Point => Value::Point([coordinate(), coordinate(), coordinate()]),
        _ => panic!("a constant of a device of another type"),
    };
    let mut of = |p: &autogen::ir::Parameter| match &p.source {
        ParameterSource::Layout(default) => vec![default.expect("a default"); elements(model, p.ty.extent)],
        ParameterSource::Scenario => vec![Value::Int(0); elements(model, p.ty.extent)],
        ParameterSource::Device => (0..elements(model, p.ty.extent)).map(|_| value(p.ty.scalar)).collect(),
    };
    automaton.parameters.iter().map(&mut of).collect()
}

fn elements(model: &Model, extent: Extent) -> usize {
    model.elements(extent)
}
