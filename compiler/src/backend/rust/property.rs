//! Properties, which are checked after the steps, and the alarms that they raise.

use super::context::Context;
use super::format::comment;
use super::walk::Uses;
use crate::ir::{Automaton, Property, PropertyKind, Severity};

/// What the method that looks at the properties needs beside the robot.
pub fn uses(context: &Context) -> Uses {
    let automaton = context.automaton();
    let mut uses = uses_of(context, |_| true);
    uses.start = automaton.can_stop();
    uses
}

fn uses_of(context: &Context, is_meant: impl Fn(&Property) -> bool) -> Uses {
    let mut uses = Uses::default();
    let automaton = context.automaton();
    for property in automaton.properties.iter().filter(|property| is_meant(property)) {
        property.exprs().into_iter().for_each(|expr| uses.expr(automaton, expr));
        uses.wiring |= matches!(property.kind, PropertyKind::Whenever { .. });
        uses.scan |= property.is_alarm();
    }
    uses
}

/// Whether properties keep anything from scan to scan.
pub fn remembers(automaton: &Automaton) -> bool {
    automaton.modes.is_some()
        || automaton.properties.iter().any(|p| p.is_alarm() || !matches!(p.kind, PropertyKind::Always(_)))
}

/// Whether one of them waits for something.
pub fn waits(automaton: &Automaton) -> bool {
    automaton.properties.iter().any(|p| matches!(p.kind, PropertyKind::Whenever { .. }))
}

/// How a robot checks its properties.
#[derive(Default)]
pub struct Checks {
    /// First the properties that stop the robot, then whether it continues, then the others. Empty if nothing is checked.
    pub body: Vec<String>,
    /// Of robots whose properties see other outputs than the automaton has set: the others, which the body calls.
    pub others: Option<Others>,
}

pub struct Others {
    pub parameters: String,
    pub statements: Vec<String>,
}

pub fn checks(context: &Context) -> Checks {
    let automaton = context.automaton();
    if automaton.properties.is_empty() && !automaton.can_stop() {
        return Checks::default();
    }
    let [stops, others] = statements(context);
    let is_masked = !automaton.masked.is_empty();
    let line = |text: &str, is_needed: bool| is_needed.then(|| text.to_string());
    let has_stops = !stops.is_empty();
    let mut body: Vec<String> = Vec::new();
    body.extend(line("let at_rest = self.stopped;", automaton.can_stop()));
    body.extend(line("let set = self.outputs;", is_masked));
    body.extend(line("self.put_out();", is_masked && has_stops));
    body.extend(stops);
    body.extend(continues(context));
    body.extend(line("let at_rest = at_rest || self.stopped;", automaton.has_pauses()));
    body.extend(line("self.outputs = set;", is_masked && has_stops));
    if !is_masked || others.is_empty() {
        body.extend(others);
        body.push("Ok(())".into());
        return Checks { body, others: None };
    }
    let uses = uses_of(context, |property| property.severity != Severity::Machine);
    let with_rest = |at_rest: &str, more: String| {
        let all = line(at_rest, automaton.has_pauses()).into_iter().chain([more]);
        all.filter(|text| !text.is_empty()).collect::<Vec<_>>().join(", ")
    };
    let arguments = with_rest("at_rest", context.arguments(&uses));
    body.push("self.put_out();".into());
    body.push(format!("let checked = self.check_others({arguments});"));
    body.extend(["self.outputs = set;".into(), "checked".into()]);
    let parameters = with_rest("at_rest: bool", context.parameters(&uses));
    Checks { body, others: Some(Others { parameters, statements: others }) }
}

/// One or more for each property: of those that stop the robot, and of the others.
fn statements(context: &Context) -> [Vec<String>; 2] {
    let (mut stops, mut others) = (Vec::new(), Vec::new());
    let mut alarm = 0;
    for property in &context.automaton().properties {
        let title = comment(&format!("{}: {}", context.line(property.place), property.text));
        let holds = holds(context, property);
        let text = |reaction: String| format!("{title}{holds}{reaction}");
        match property.severity {
            Severity::Line => {
                others.push(text(format!("if !holds {{ return Err({}); }}", context.fault(property.site))))
            }
            Severity::Warning => others.push(text(format!("self.alarms[{alarm}].note(!holds, scan);"))),
            Severity::Machine => stops
                .push(text(format!("if self.alarms[{alarm}].note(!holds, scan) {{ self.stopped = true; }}"))),
        }
        alarm += usize::from(property.is_alarm());
    }
    [stops, others]
}

fn continues(context: &Context) -> Option<String> {
    let automaton = context.automaton();
    let stops = automaton.alarms().enumerate().filter(|(_, p)| p.severity == Severity::Machine);
    let closed = stops.map(|(number, _)| format!(" && !self.alarms[{number}].is_open()"));
    let enabled = automaton.modes.iter().map(|modes| format!(" && {}", context.expr(&modes.may_go_on)));
    automaton.can_stop().then(|| {
        format!(
            "{}if start && at_rest{} {{ self.stopped = false; }}",
            comment("It continues: it makes its next step in the next scan."),
            closed.chain(enabled).collect::<String>()
        )
    })
}

/// Statements that end with the variable `holds`.
fn holds(context: &Context, property: &Property) -> String {
    let field = |local: usize| format!("self.{}", context.own().locals[local]);
    let can_stop = context.automaton().can_stop();
    match &property.kind {
        PropertyKind::Always(condition) => format!("let holds = {};", context.expr(condition)),
        PropertyKind::Keep { condition, values, same, held } => {
            let (held, condition) = (field(*held), context.expr(condition));
            let kept = if can_stop { format!("!at_rest && ({condition})") } else { condition };
            let stores: String = values
                .iter()
                .map(|kept| format!("{} = {};", field(kept.before), context.expr(&kept.value)))
                .collect();
            format!(
                "let kept = {kept}; let holds = !({held} && kept) || ({}); {held} = kept; if kept {{ {stores} }}",
                context.expr(same)
            )
        }
        PropertyKind::Whenever { trigger, goal, within, waited, anew } => {
            let waited = field(*waited);
            let (trigger, goal) = (context.expr(trigger), context.expr(goal));
            let goal = match (can_stop, &context.automaton().modes) {
                (_, Some(_)) => format!("at_rest || self.is_single() || ({goal})"),
                (true, None) => format!("at_rest || ({goal})"),
                (false, None) => goal,
            };
            let anew = anew.as_ref().map(|kept| {
                let (before, value) = (field(kept.before), context.expr(&kept.value));
                format!("if {before} != {value} {{ {before} = {value}; {waited} = -1; }}")
            });
            format!(
                "{}{waited} = waited({waited}, {trigger}, {goal}, wiring.scan_ms); let holds = {waited} < {};",
                anew.unwrap_or_default(),
                context.expr(within)
            )
        }
    }
}

/// Statements after which properties begin anew.
pub fn anew(context: &Context) -> Vec<String> {
    let field = |local: usize| format!("self.{}", context.own().locals[local]);
    let properties = context.automaton().properties.iter();
    let statement = |property: &Property| match property.kind {
        PropertyKind::Always(_) => None,
        PropertyKind::Keep { held, .. } => Some(format!("{} = false;", field(held))),
        PropertyKind::Whenever { waited, .. } => Some(format!("{} = -1;", field(waited))),
    };
    properties.filter_map(statement).collect()
}

/// The fields that count milliseconds.
pub fn counters(context: &Context) -> Vec<String> {
    let properties = context.automaton().properties.iter();
    let counter = |property: &Property| match property.kind {
        PropertyKind::Whenever { waited, .. } => Some(context.own().locals[waited].clone()),
        _ => None,
    };
    properties.filter_map(counter).collect()
}

/// The alarms of a robot at power-up.
pub fn alarms(context: &Context) -> Vec<String> {
    let alarms = context.automaton().alarms();
    alarms.map(|property| format!("Alarm::new({})", context.fault(property.site))).collect()
}
