//! `--set TYPE.NAME=VALUE` and `--set MACHINE.NAME=VALUE`, and of the scenario `--set supply.seed=VALUE`.

use super::bind::automaton_name;
use super::device_key;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{Automaton, Model};
use crate::layout::json::{self, Json};
use crate::layout::object::is_common;
use crate::layout::{Layout, Object};
use crate::scenario::Scenario;
use crate::source::{FileId, Sources, Span};
use std::collections::{HashMap, HashSet};

/// A parameter of automata, or a key of devices, set on the command line.
#[derive(Clone, Debug)]
pub struct Setting {
    /// A type as the layout writes it, or the name of a robot.
    pub target: String,
    pub parameter: String,
    pub value: Json,
    pub span: Span,
}

impl Setting {
    /// Reads `target.parameter=value`, the text of a file. The value is JSON, or a bare word.
    pub fn parse(sources: &Sources, file: FileId) -> Result<Setting, Vec<Diagnostic>> {
        let text = &sources.file(file).text;
        let span = Span::new(file, 0, text.len());
        let form = || {
            vec![
                Diagnostic::new("E0510", span, format!("`{text}` is not a setting"))
                    .help("write TYPE.NAME=VALUE or MACHINE.NAME=VALUE, such as agv.capacity=4: NAME is a parameter of the automaton or a key of the device"),
            ]
        };
        let (name, written) = text.split_once('=').ok_or_else(form)?;
        let (target, parameter) = name.split_once('.').ok_or_else(form)?;
        let is_word = |w: &str| !w.is_empty() && w.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !is_word(target) || !is_word(parameter) || written.is_empty() {
            return Err(form());
        }
        let value = if is_word(written)
            && written.starts_with(|c: char| c.is_ascii_alphabetic())
            && written != "true"
            && written != "false"
        {
            Json { value: json::Value::Text(written.into()), span }
        } else {
            // The value keeps its place in the text: what stands before it is blanked.
            let blanked = format!("{}{written}", " ".repeat(name.len() + 1));
            match json::parse(&blanked, file) {
                (Some(value), found) if found.is_empty() => value,
                (_, found) => return Err(if found.is_empty() { form() } else { found }),
            }
        };
        Ok(Setting { target: target.into(), parameter: parameter.into(), value, span })
    }

    pub fn applies_to(&self, object: &Object) -> bool {
        object.name.value == self.target || object.kind.value == self.target
    }
}

/// A machine of the layout with its automaton.
pub type Machine<'a> = (&'a Object, &'a Automaton);

/// All machines of the layout, whether or not their keys are right.
pub fn machines<'a>(layout: &'a Layout, model: &'a Model) -> Vec<Machine<'a>> {
    let automata: HashMap<&str, &Automaton> = model.automata.iter().map(|a| (a.name.as_str(), a)).collect();
    let machine =
        |object: &'a Object| Some((object, *automata.get(automaton_name(&object.kind.value).as_str())?));
    layout.objects.iter().filter_map(machine).collect()
}

/// The target and the parameter by which the seed of the supply is set.
const SUPPLY: &str = "supply";
const SEED: &str = "seed";

/// Whether a setting concerns the supply: a type or a robot of this name comes first.
pub fn is_of_supply(setting: &Setting, machines: &[Machine]) -> bool {
    setting.target == SUPPLY && !machines.iter().any(|(object, _)| setting.applies_to(object))
}

/// Sets what the settings say of the scenario; the last of several holds.
pub fn apply(
    settings: &[Setting],
    machines: &[Machine],
    scenario: &mut Scenario,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for setting in settings.iter().filter(|setting| is_of_supply(setting, machines)) {
        match &setting.value.value {
            json::Value::Number(n) if n.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(n) => {
                scenario.supply.seed = *n as u32;
            }
            _ => diagnostics.push(
                Diagnostic::new("E0503", setting.value.span, format!("this is not a value for `{SEED}`"))
                    .help(format!("write a whole number from 0 to {}", u32::MAX)),
            ),
        }
    }
}

/// What is wrong with a setting of the supply, if anything is.
fn check_of_supply(setting: &Setting) -> Option<Diagnostic> {
    if setting.parameter != SEED {
        let message = format!("`{SUPPLY}` has no parameter `{}`", setting.parameter);
        return Some(
            Diagnostic::new("E0511", setting.span, message).help(format!("its parameter is `{SEED}`")),
        );
    }
    None
}

/// What to write instead of a parameter of the automaton that is a key of the device.
pub fn key_of_device(name: &str, device: &str) -> String {
    format!(
        "`{name}` is a key of the device `{device}`: write it beside \"type\" in the layout, `\"{name}\": ...`"
    )
}

/// Each setting has to concern somebody and something.
pub fn check(settings: &[Setting], machines: &[Machine], diagnostics: &mut Vec<Diagnostic>) {
    for setting in settings {
        if is_of_supply(setting, machines) {
            diagnostics.extend(check_of_supply(setting));
            continue;
        }
        let meant: Vec<&Machine> = machines.iter().filter(|(object, _)| setting.applies_to(object)).collect();
        if meant.is_empty() {
            let known = machines.iter().flat_map(|(o, _)| [o.name.value.as_str(), o.kind.value.as_str()]);
            let help = suggestion(&setting.target, known)
                .map_or("name a type or a robot of the layout".into(), |n| format!("is `{n}` meant?"));
            diagnostics.push(
                Diagnostic::new(
                    "E0511",
                    setting.span,
                    format!("the layout has no type and no robot `{}`", setting.target),
                )
                .help(help),
            );
            continue;
        }
        let mut parameters = Vec::new();
        let mut keys = Vec::new();
        for (_, automaton) in meant {
            parameters
                .extend(automaton.parameters.iter().filter(|p| p.is_settable()).map(|p| p.name.as_str()));
            let of_device = automaton.device.parameters.iter().map(|p| p.name.as_str());
            keys.extend(of_device.filter(|name| device_key::is_key(name, automaton)));
        }
        for names in [&mut parameters, &mut keys] {
            let mut known = HashSet::new();
            names.retain(|name| known.insert(*name));
        }
        let all = || parameters.iter().chain(&keys).copied();
        if !all().any(|name| name == setting.parameter) {
            let known = match (parameters.is_empty(), keys.is_empty()) {
                (true, true) => "its automaton has no parameters, and its device no keys".into(),
                (false, true) => format!("its parameters are {}", parameters.join(", ")),
                (true, false) => format!("the keys of its device are {}", keys.join(", ")),
                (false, false) => format!(
                    "its parameters are {}; the keys of its device are {}",
                    parameters.join(", "),
                    keys.join(", ")
                ),
            };
            let help = match suggestion(&setting.parameter, all()) {
                Some(near) => {
                    format!("is `{near}` meant? One can set: {}", all().collect::<Vec<_>>().join(", "))
                }
                None => known,
            };
            let message = format!(
                "`{}` has no parameter and no key of its device `{}`",
                setting.target, setting.parameter
            );
            let diagnostic = Diagnostic::new("E0511", setting.span, message).help(help);
            diagnostics.push(match is_common(&setting.parameter) {
                true => diagnostic.note("keys of every object, such as `pose`, stand in the layout alone"),
                false => diagnostic,
            });
        }
    }
}
