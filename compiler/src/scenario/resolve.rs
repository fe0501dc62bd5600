//! A scenario meets a line: names of machines become indices, and the supply is laid out.

mod faults;

pub use faults::{Input, MachinePart};

use super::supply::Drawn;
use super::{
    Answer, Collected, Faults, Items, MOST_PARTS, Number, Operation, Order, Part, Refusal, ResolvedScenario,
    Scenario, Slip, supply,
};
use crate::device::{Verb, type_text};
use crate::diagnostic::{Diagnostic, MOST, collect, sort};
use crate::layout::decode::{instead, listing, readable};
use crate::source::{Span, Spanned};
use runtime_sim::device::{Extent, LAST_COMMAND, PortType};
use runtime_sim::part::Operated;
use std::borrow::Cow;
use std::collections::HashMap;

/// Machines by name and index, in layout order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Line<'a> {
    pub stations: &'a [(&'a str, usize)],
    pub belts: &'a [(&'a str, usize)],
    /// Those with a gripper.
    pub arms: &'a [(&'a str, usize)],
    /// Those that obey commands.
    pub commanded: &'a [(&'a str, usize)],
    /// Those with something that a person operates.
    pub panels: &'a [Panel<'a>],
    /// Of all machines.
    pub inputs: &'a [Input<'a>],
    pub parts: &'a [MachinePart<'a>],
    /// By `robot.part`.
    pub sinks: &'a [(String, [usize; 2])],
    /// Kinds that processes make of others.
    pub made: &'a [&'a str],
}

/// A button or a set-point.
#[derive(Clone, Copy, Debug)]
pub struct Panel<'a> {
    pub robot: &'a str,
    pub part: &'a str,
    /// Of the machine and of the part.
    pub numbers: [usize; 2],
    pub operated: Operated,
    /// Of the input that reads it.
    pub ty: PortType,
    /// Of a part that chooses one of them by its number.
    pub commands: Option<&'a [Verb]>,
}

/// What the belts bring.
struct Brought {
    /// Belt, and the kinds in order.
    supply: Vec<(usize, Vec<usize>)>,
    /// How it was drawn, if it was.
    drawn: Option<Drawn>,
}

pub fn resolve(scenario: &Scenario, line: &Line) -> Result<ResolvedScenario, Vec<Diagnostic>> {
    let mut resolver = Resolver { scenario, line, by_name: HashMap::new(), diagnostics: Vec::new() };
    let orders = resolver.orders();
    let supply = resolver.supply();
    let Faults { slips, refusals, answers, pauses, power_offs, sensors, jams, slow } = &scenario.faults;
    let slips = slips.iter().filter_map(|s| {
        let robot = resolver.named(&s.robot, line.arms, "robot with a gripper")?;
        Some(Slip { robot, pick: s.pick, after_s: s.after_s })
    });
    let slips = slips.collect();
    let refusals = refusals.iter().filter_map(|r| {
        let robot = resolver.named(&r.robot, line.commanded, "robot that takes commands")?;
        Some(Refusal { robot, command: r.command })
    });
    let refusals = refusals.collect();
    let answers = answers.iter().filter_map(|a| {
        let robot = resolver.named(&a.robot, line.commanded, "robot that takes commands")?;
        Some(Answer { robot, command: a.command, late_s: a.late_s, error: a.error })
    });
    let answers = answers.collect();
    let sensors = sensors.iter().filter_map(|stuck| resolver.stuck(stuck)).collect();
    let jams = jams.iter().filter_map(|jam| resolver.jam(jam)).collect();
    let slow = slow.iter().filter_map(|slow| resolver.slow_cycle(slow)).collect();
    let mut operations = Vec::new();
    let mut presses = Vec::new();
    for Operation { part, at_s, for_s, value } in &scenario.operations {
        match part {
            super::Operated::OfLine(button) => {
                presses.push(Operation { part: *button, at_s: *at_s, for_s: *for_s, value: *value });
            }
            super::Operated::OfRobot(part) => {
                let found = resolver.operated(part, *value);
                operations.extend(found.map(|part| Operation {
                    part,
                    at_s: *at_s,
                    for_s: *for_s,
                    value: *value,
                }));
            }
        }
    }
    if let Some(Brought { supply, .. }) = &supply {
        resolver.check_removals(supply);
    }
    let goal = scenario.goal.iter().filter_map(|collected| resolver.collected(collected)).collect();
    sort(&mut resolver.diagnostics);
    match (orders, supply) {
        (Some(orders), Some(Brought { supply, drawn })) if resolver.diagnostics.is_empty() => {
            Ok(ResolvedScenario {
                kinds: scenario.kinds.clone(),
                number: scenario.orders.number,
                orders,
                supply,
                drawn,
                spawn_first_s: scenario.supply.first_s,
                spawn_every_s: scenario.supply.every_s,
                time_limit_s: scenario.time_limit_s,
                seed: scenario.supply.seed,
                slips,
                refusals,
                answers,
                pauses: pauses.clone(),
                power_offs: power_offs.clone(),
                sensors,
                jams,
                slow,
                operations,
                presses,
                removals: scenario.removals.clone(),
                goal,
            })
        }
        _ => Err(resolver.diagnostics),
    }
}

struct Resolver<'a> {
    scenario: &'a Scenario,
    line: &'a Line<'a>,
    /// Machines of each kind, by what they are called.
    by_name: HashMap<&'static str, HashMap<&'a str, usize>>,
    diagnostics: Vec<Diagnostic>,
}

impl<'a> Resolver<'a> {
    fn named(
        &mut self,
        name: &Spanned<String>,
        known: &[(&'a str, usize)],
        what: &'static str,
    ) -> Option<usize> {
        let by_name = self.by_name.entry(what).or_insert_with(|| known.iter().copied().collect());
        let found = by_name.get(name.value.as_str()).copied();
        if found.is_none() && self.diagnostics.len() < MOST {
            let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0134", name.span, format!("the layout has no {what} \"{}\"", name.value))
                    .note(format!("it has: {}", listing(&names)))
                    .help(instead(&name.value, &names)),
            );
        }
        found
    }

    /// Machine and part.
    fn operated(&mut self, operated: &Part, number: f64) -> Option<[usize; 2]> {
        let Part { robot, part, value } = operated;
        let all = self.line.panels;
        if !all.iter().any(|panel| panel.robot == robot.value) {
            let mut robots: Vec<(&str, usize)> = all.iter().map(|o| (o.robot, o.numbers[0])).collect();
            robots.dedup();
            self.named(robot, &robots, "robot with a button or a set-point")?;
        }
        let of_robot = || all.iter().filter(|panel| panel.robot == robot.value);
        let Some(found) = of_robot().find(|panel| panel.part == part.value) else {
            let names: Vec<&str> = of_robot().map(|panel| panel.part).collect();
            let message =
                format!("\"{}\" of {} is not a button, a selector or a set-point", part.value, robot.value);
            self.wrong_operation(part.span, message, |d| {
                d.note(format!("its buttons, selectors and set-points are: {}", listing(&names)))
                    .help(instead(&part.value, &names))
            });
            return None;
        };
        match (found.operated, value) {
            (Operated::Press, Some(value)) => {
                let message = format!("\"{}\" is a button and takes no number", part.value);
                self.wrong_operation(*value, message, |d| d.help("remove \"value\""));
                return None;
            }
            (Operated::SetNumber, None) => {
                let message = format!("\"{}\" is a set-point and needs a number", part.value);
                let help = match found.ty {
                    PortType::Int { lo, hi } => {
                        format!("add a whole number from {lo} to {hi}: \"value\": {}", lo.max(0).min(hi))
                    }
                    _ => "add the number: \"value\": 1.5".into(),
                };
                self.wrong_operation(part.span, message, |d| d.help(help));
                return None;
            }
            (Operated::SetNumber, Some(value)) => self.number(found, *value, number)?,
            (Operated::Press, None) => {}
        }
        Some(found.numbers)
    }

    /// Whether a part can be set to this number.
    fn number(&mut self, panel: &Panel, place: Span, number: f64) -> Option<()> {
        let bounds = match panel.ty {
            PortType::Int { lo, hi } => Some((lo, hi)),
            _ => None,
        };
        let is_whole = bounds.is_none_or(|(lo, hi)| {
            number.fract() == 0.0 && (f64::from(lo)..=f64::from(hi)).contains(&number)
        });
        let is_command =
            |verbs: &[Verb]| number == 0.0 || verbs.iter().any(|v| f64::from(v.number) == number);
        let [note, help] = match (panel.commands, bounds) {
            (Some(verbs), _) if !is_command(verbs) => {
                let named: Vec<String> = verbs.iter().map(|v| format!("{} {}", v.number, v.name)).collect();
                [
                    format!("the commands of {} are: {}", panel.robot, named.join(", ")),
                    "write the number of one of them, or 0 for none".into(),
                ]
            }
            (_, Some((lo, hi))) if !is_whole => [
                format!("its type is {}", type_text(panel.ty, Extent::One)),
                format!("write a whole number from {lo} to {hi}"),
            ],
            _ => return Some(()),
        };
        let message = format!("\"{}\" of {} cannot be set to {}", panel.part, panel.robot, readable(number));
        self.wrong_operation(place, message, |d| d.note(note).help(help));
        None
    }

    fn collected(&mut self, collected: &Collected<Spanned<String>>) -> Option<Collected<[usize; 2]>> {
        let Collected { sink, items } = collected;
        let found = self.line.sinks.iter().find(|(name, _)| *name == sink.value);
        if found.is_none() {
            let names: Vec<&str> = self.line.sinks.iter().map(|(name, _)| name.as_str()).collect();
            let message = format!("the layout has no sink \"{}\"", sink.value);
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0145", sink.span, message)
                    .note(format!("robots and their parts that are sinks: {}", listing(&names)))
                    .help(instead(&sink.value, &names)),
            );
        }
        Some(Collected { sink: found?.1, items: items.clone() })
    }

    /// Whether the belts bring the items that a person removes.
    fn check_removals(&mut self, supply: &[(usize, Vec<usize>)]) {
        for removal in &self.scenario.removals {
            let items = supply.iter().flat_map(|(_, items)| items);
            let count = items.filter(|kind| **kind == removal.kind).count();
            if removal.number as usize > count {
                let name = &self.scenario.kinds[removal.kind].name.value;
                let message = format!("there is no item {name}_{}", removal.number);
                collect(
                    &mut self.diagnostics,
                    Diagnostic::new("E0131", removal.span, message)
                        .note(format!("the belts bring {count} items of kind {name}"))
                        .help("name one of these by its number among them, from 1"),
                );
            }
        }
    }

    fn wrong_operation(
        &mut self,
        place: Span,
        message: String,
        finish: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        collect(&mut self.diagnostics, finish(Diagnostic::new("E0139", place, message)));
    }

    fn missing(&mut self, place: Span, what: &str, why: &str) {
        collect(
            &mut self.diagnostics,
            Diagnostic::new("E0135", place, format!("the layout has no {what}")).note(why).help(format!(
                "add a machine with a {what} to the layout, or use a scenario that needs none"
            )),
        );
    }

    fn orders(&mut self) -> Option<Vec<(Vec<usize>, Vec<u32>)>> {
        let orders = &self.scenario.orders;
        let turn: Option<Vec<usize>> = match &orders.stations {
            Some(names) => self.stations(names),
            None => Some(self.line.stations.iter().map(|(_, index)| *index).collect()),
        };
        let turn = turn?;
        if turn.is_empty() && !orders.list.is_empty() {
            self.missing(
                orders.span,
                "station",
                "an order is made at a machine with a part `orders`, such as the library's station",
            );
            return None;
        }
        let mut next = turn.iter().cycle();
        let resolved: Vec<_> = self
            .list()
            .iter()
            .map(|order| {
                let stations = match &order.stations {
                    Some(names) => self.stations(names),
                    None => next.next().map(|station| vec![*station]),
                };
                Some((stations?, order.parts.clone()))
            })
            .collect();
        resolved.into_iter().collect()
    }

    /// All orders. Of those without end as many as the belts can bring parts for until the time limit, and one for each
    /// station that would then lie open; no more than have numbers.
    fn list(&self) -> Cow<'a, [Order]> {
        let (orders, supply) = (&self.scenario.orders, &self.scenario.supply);
        let [order] = orders.list.as_slice() else { return Cow::Borrowed(&orders.list) };
        if orders.number == Number::Listed {
            return Cow::Borrowed(&orders.list);
        }
        let left_s = (self.scenario.time_limit_s - supply.first_s).max(0.0);
        let parts = (left_s / supply.every_s).floor() + 1.0;
        let of_order: u32 = order.parts.iter().sum();
        let made = (parts * self.line.belts.len() as f64 / f64::from(of_order)).ceil();
        let most = LAST_COMMAND as usize;
        let count = (made as usize).saturating_add(self.line.stations.len()).min(most);
        Cow::Owned(vec![order.clone(); count])
    }

    fn stations(&mut self, names: &[Spanned<String>]) -> Option<Vec<usize>> {
        let found: Vec<_> = names.iter().map(|n| self.named(n, self.line.stations, "station")).collect();
        found.into_iter().collect()
    }

    fn supply(&mut self) -> Option<Brought> {
        let span = self.scenario.supply.span;
        let belts: Vec<usize> = self.line.belts.iter().map(|(_, index)| *index).collect();
        let supply = match &self.scenario.supply.items {
            Items::Shuffled { surplus } => {
                let drawn = self.drawn(*surplus, belts)?;
                return Some(Brought { supply: drawn.supply(self.scenario.supply.seed), drawn: Some(drawn) });
            }
            Items::OnlyBelt(items) => match belts[..] {
                [belt] => vec![(belt, items.clone())],
                [] if items.is_empty() => Vec::new(),
                [] => {
                    self.missing(
                        span,
                        "source",
                        "parts come from a machine with a part `source`, such as the library's conveyor",
                    );
                    return None;
                }
                _ => {
                    let names: Vec<&str> = self.line.belts.iter().map(|(name, _)| *name).collect();
                    collect(
                        &mut self.diagnostics,
                        Diagnostic::new("E0136", span, "one list of parts for several belts")
                            .note(format!("belts of the layout: {}", listing(&names)))
                            .help(format!("give each belt its list: \"items\": {{\"{}\": [...]}}", names[0])),
                    );
                    return None;
                }
            },
            Items::Belts(lists) => {
                let found: Vec<_> = lists
                    .iter()
                    .map(|(name, items)| Some((self.named(name, self.line.belts, "belt")?, items.clone())))
                    .collect();
                found.into_iter().collect::<Option<_>>()?
            }
        };
        self.suffices(&supply);
        Some(Brought { supply, drawn: None })
    }

    fn drawn(&mut self, surplus: [u32; 2], belts: Vec<usize>) -> Option<Drawn> {
        let span = self.scenario.supply.span;
        let orders: Vec<Vec<u32>> = self.list().iter().map(|order| order.parts.clone()).collect();
        let needed: u64 = orders.iter().flat_map(|parts| parts.iter()).map(|n| u64::from(*n)).sum();
        let brought = needed + supply::surplus(needed, surplus);
        if brought > MOST_PARTS {
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0137", span, format!("the belts would have to bring {brought} parts"))
                    .note(format!("the orders need {needed}; a scenario brings at most {MOST_PARTS}"))
                    .help("ask for fewer orders, or for less surplus"),
            );
            return None;
        }
        if belts.is_empty() && needed > 0 {
            self.missing(
                span,
                "source",
                "parts come from a machine with a part `source`, such as the library's conveyor",
            );
            return None;
        }
        Some(Drawn { orders, surplus, belts })
    }

    /// A list of parts is enough for all orders, but for kinds that processes make: how many is not known before the run.
    fn suffices(&mut self, supply: &[(usize, Vec<usize>)]) {
        if self.scenario.orders.number == Number::WithoutEnd {
            let message = "the belts bring a list of parts, and the orders have no end";
            collect(
                &mut self.diagnostics,
                Diagnostic::new("E0138", self.scenario.supply.span, message)
                    .other(self.scenario.orders.span, "the orders")
                    .note("the line could not make all orders")
                    .help("remove \"items\", so that the belts bring the parts of the orders, or give a \"count\""),
            );
            return;
        }
        for (k, needed, place, asked) in self.asked() {
            let brought = supply.iter().flat_map(|(_, items)| items).filter(|i| **i == k).count() as u64;
            if brought < needed {
                let name = &self.scenario.kinds[k].name.value;
                let (what, could) = match asked {
                    Asked::Orders => ("the orders", "the line could not make all orders"),
                    // That nothing gets to a sink is told of the sink.
                    Asked::Goal if brought == 0 => continue,
                    Asked::Goal => {
                        ("the goal", "the line could not reach its goal: no process makes this kind")
                    }
                };
                let times = self.scenario.supply.times;
                let added = (needed - brought).div_ceil(u64::from(times));
                let few = format!("the belts bring too few parts \"{name}\": {brought} of {needed}");
                let parts = if added == 1 { "part" } else { "parts" };
                let repeated = match times {
                    1 => String::new(),
                    _ => format!(", which is repeated {times} times"),
                };
                collect(
                    &mut self.diagnostics,
                    Diagnostic::new("E0138", self.scenario.supply.span, few)
                        .other(place, what)
                        .note(could)
                        .help(format!("add {added} {parts} \"{name}\" to \"items\"{repeated}")),
                );
            }
        }
    }

    /// How many parts of each kind orders and goal ask for, and where; not of kinds that processes make.
    fn asked(&self) -> Vec<(usize, u64, Span, Asked)> {
        let Scenario { kinds, orders, goal, .. } = self.scenario;
        let given = (0..kinds.len()).filter(|k| !self.line.made.contains(&kinds[*k].name.value.as_str()));
        let of_kind = |k: usize| {
            let ordered = orders.list.iter().map(|order| u64::from(order.parts[k])).sum();
            let collected = goal.iter().map(|collected| u64::from(collected.items[k])).sum();
            let sink = goal.iter().find(|collected| collected.items[k] > 0);
            let by_goal = sink.map(|sink| (k, collected, sink.sink.span, Asked::Goal));
            [Some((k, ordered, orders.span, Asked::Orders)), by_goal]
        };
        given.flat_map(of_kind).flatten().collect()
    }
}

/// Who asks for parts.
enum Asked {
    Orders,
    Goal,
}
