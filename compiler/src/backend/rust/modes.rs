//! Operating modes: what a person does with one robot at its panel.

use super::context::Context;
use super::expression::{Condition, all as all_of};
use super::format::comment;
use super::property;
use super::walk::{Access, Uses};
use crate::ir::{Action, Automaton, ByHand, Expr, KeptBy, Modes};

/// What a robot that has modes is given as methods.
pub struct Methods {
    /// Statements before its step.
    pub operate: Vec<String>,
    /// Statements that make it begin anew.
    pub begin_anew: Vec<String>,
    /// Statements that change what is published while it does not run.
    pub published: Vec<String>,
    /// Parameters of the first two.
    pub parameters: String,
    pub moved_by_hand: String,
    pub steps: String,
    /// If something asks for it.
    pub is_single: Option<String>,
}

/// What the first two methods need beside the robot.
pub fn uses(context: &Context) -> Uses {
    let automaton = context.automaton();
    let mut uses = Uses::default();
    if automaton.modes.is_some() && has_cells(context) {
        uses.cells = Access::Write;
    }
    uses
}

/// Some of its cells are not retained.
fn has_cells(context: &Context) -> bool {
    let automaton = context.automaton();
    automaton.implements.iter().any(|implemented| {
        let cells = context.system.model.interface(implemented.interface).cells.len();
        (0..cells).any(|number| !automaton.retained.cells.contains(&(implemented.interface, number)))
    })
}

pub fn methods(context: &Context) -> Option<Methods> {
    let automaton = context.automaton();
    let modes = automaton.modes.as_ref()?;
    let field = |local: usize| context.own().locals[local].clone();
    Some(Methods {
        operate: modes.actions.iter().map(|action| context.action(action)).collect(),
        begin_anew: context.begin_anew(automaton),
        published: context.published(modes),
        parameters: context.parameters(&uses(context)),
        moved_by_hand: field(modes.moved_by_hand),
        steps: field(modes.steps),
        is_single: asks_for_single(automaton).then(|| context.expr(&modes.is_single)),
    })
}

fn asks_for_single(automaton: &Automaton) -> bool {
    automaton.states.iter().any(|state| state.within.is_some()) || property::waits(automaton)
}

/// The conditions of actions, and the actions: of a condition that holds nothing but another one, which has no text, both.
fn joined<'a>(
    condition: &'a Expr,
    then: &'a [Action],
    otherwise: &[Action],
) -> (Vec<&'a Expr>, &'a [Action]) {
    match then {
        [Action::If { about, condition: inner, then, otherwise: others }]
            if about.is_empty() && otherwise.is_empty() && others.is_empty() =>
        {
            let (conditions, then) = joined(inner, then, others);
            ([vec![condition], conditions].concat(), then)
        }
        _ => (vec![condition], then),
    }
}

impl Context<'_> {
    fn action(&self, action: &Action) -> String {
        let all = |actions: &[Action]| actions.iter().map(|action| self.action(action)).collect::<String>();
        match action {
            Action::Update(update) => self.update(update),
            Action::Stop => "self.stopped = true;".into(),
            Action::BeginAnew => format!("self.begin_anew({});", self.arguments(&uses(self))),
            Action::If { about, condition, then, otherwise } => {
                let title = if about.is_empty() { String::new() } else { comment(about) };
                let (conditions, then) = joined(condition, then, otherwise);
                let conditions: Vec<Condition> =
                    conditions.into_iter().filter_map(|condition| self.condition(condition)).collect();
                let condition = all_of(&conditions).unwrap_or_else(|| "true".into());
                let tail = if otherwise.is_empty() {
                    String::new()
                } else {
                    format!("else {{ {} }}", all(otherwise))
                };
                format!("{title}if {condition} {{ {} }} {tail}\n", all(then))
            }
        }
    }

    fn begin_anew(&self, automaton: &Automaton) -> Vec<String> {
        let mut texts = vec![
            "let new = Self::new(self.parameters);".to_string(),
            "self.state = new.state;".into(),
            "self.elapsed = 0;".into(),
        ];
        let retained = &automaton.retained;
        for (number, (local, name)) in automaton.locals.iter().zip(&self.own().locals).enumerate() {
            if local.kept_by != KeptBy::Modes && !retained.locals.contains(&number) {
                texts.push(format!("self.{name} = new.{name};"));
            }
        }
        for port in automaton.outputs_that_stop() {
            let name = &self.own().ports[port];
            texts.push(format!("self.outputs.{name} = new.outputs.{name};"));
        }
        for implemented in &automaton.implements {
            let names = &self.names.interfaces[implemented.interface.0];
            let cells = &self.system.model.interface(implemented.interface).cells;
            let row = self.own_row(implemented.interface);
            let is_retained = |number: usize| retained.cells.contains(&(implemented.interface, number));
            let anew = (0..cells.len()).filter(|number| !is_retained(*number));
            let anew: Vec<&String> = anew.map(|number| &names.cell[number]).collect();
            if anew.len() == cells.len() && !cells.is_empty() {
                texts.push(format!("cells.{}[{row}] = {}::NEW;", names.field, names.cells));
            } else {
                texts.extend(anew.iter().map(|cell| {
                    format!("cells.{}[{row}].{cell} = {}::NEW.{cell};", names.field, names.cells)
                }));
            }
        }
        texts
    }

    fn published(&self, modes: &Modes) -> Vec<String> {
        let automaton = self.automaton();
        let field = |local: usize| format!("self.{}", self.own().locals[local]);
        let (mut by_hand, mut with_command, mut texts) = (String::new(), String::new(), Vec::new());
        for (published, name) in modes.published.iter().zip(&self.own().ports) {
            match (published, modes.commanded) {
                (Some(ByHand::Panel(value)), _) => {
                    by_hand += &format!("outputs.{name} = {};", self.expr(value));
                }
                (Some(ByHand::Argument), _) => {
                    with_command += &format!("outputs.{name} = self.outputs.{name};")
                }
                (Some(ByHand::Hold), Some(commanded)) => {
                    let commanded = field(commanded);
                    let abandoned =
                        automaton.abandoned.map_or(String::new(), |local| format!(" || {}", field(local)));
                    texts.push(format!("outputs.{name} = !{commanded} && (!runs{abandoned});"));
                }
                (Some(ByHand::Hold), None) | (None, _) => {}
            }
        }
        if let Some(local) = modes.by_hand
            && !by_hand.is_empty()
        {
            texts.push(format!("if {} {{ {by_hand} }}", field(local)));
        }
        if let Some(commanded) = modes.commanded
            && !with_command.is_empty()
        {
            texts.push(format!("if {} {{ {with_command} }}", field(commanded)));
        }
        texts
    }
}
