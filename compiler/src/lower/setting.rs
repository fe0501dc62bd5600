//! `--set TYPE.PARAM=VALUE` and `--set ROBOT.PARAM=VALUE`, and of the scenario `--set supply.seed=VALUE`.

use super::bind::{Bound, Robot};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::Model;
use crate::layout::json::{self, Json};
use crate::scenario::Scenario;
use crate::source::{FileId, Sources, Span};

/// A parameter set on the command line.
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
                    .help("write TYPE.PARAMETER=VALUE or ROBOT.PARAMETER=VALUE, such as agv.capacity=4"),
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

    pub fn applies_to(&self, robot: &Robot) -> bool {
        robot.object.name.value == self.target || robot.object.kind.value == self.target
    }
}

/// The target and the parameter by which the seed of the supply is set.
const SUPPLY: &str = "supply";
const SEED: &str = "seed";

/// Whether a setting concerns the supply: a type or a robot of this name comes first.
fn is_of_supply(setting: &Setting, bound: &Bound) -> bool {
    setting.target == SUPPLY && !bound.robots.iter().any(|robot| setting.applies_to(robot))
}

/// Sets what the settings say of the scenario; the last of several holds.
pub fn apply(
    settings: &[Setting],
    bound: &Bound,
    scenario: &mut Scenario,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for setting in settings.iter().filter(|setting| is_of_supply(setting, bound)) {
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
pub fn check(settings: &[Setting], bound: &Bound, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    for setting in settings {
        if is_of_supply(setting, bound) {
            diagnostics.extend(check_of_supply(setting));
            continue;
        }
        let meant: Vec<&Robot> = bound.robots.iter().filter(|r| setting.applies_to(r)).collect();
        if meant.is_empty() {
            let known = bound
                .robots
                .iter()
                .flat_map(|r| [r.object.name.value.as_str(), r.object.kind.value.as_str()]);
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
        let parameters: Vec<&str> = (model.automata.iter())
            .filter(|a| meant.iter().any(|r| r.automaton == a.name))
            .flat_map(|a| &a.parameters)
            .filter(|p| p.is_settable())
            .map(|p| p.name.as_str())
            .collect();
        if !parameters.contains(&setting.parameter.as_str()) {
            let mut devices = (model.automata.iter())
                .filter(|a| meant.iter().any(|r| r.automaton == a.name))
                .map(|a| &a.device);
            let key_of = devices.find(|d| d.parameters.iter().any(|p| p.name == setting.parameter));
            let near = suggestion(&setting.parameter, parameters.iter().copied());
            let help = match (key_of, near) {
                (Some(device), _) => key_of_device(&setting.parameter, &device.name),
                (None, Some(near)) => format!("is `{near}` meant?"),
                (None, None) if parameters.is_empty() => "its automaton has no parameters".into(),
                (None, None) => format!("its parameters are {}", parameters.join(", ")),
            };
            diagnostics.push(
                Diagnostic::new(
                    "E0511",
                    setting.span,
                    format!("`{}` has no parameter `{}`", setting.target, setting.parameter),
                )
                .help(help),
            );
        }
    }
}
