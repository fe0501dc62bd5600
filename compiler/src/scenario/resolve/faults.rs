//! Faults of the plant meet the devices of a line.

use super::Resolver;
use crate::device::type_text;
use crate::diagnostic::{Diagnostic, collect};
use crate::layout::decode::{instead, listing, readable};
use crate::scenario::{Element, Jam, PartName, Reading, Signal, SlowCycle, Stuck, Words};
use crate::source::Spanned;
use runtime_sim::device::{Extent, PortType};
use runtime_sim::part::Schema;

/// An input of a machine.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    pub robot: &'a str,
    pub signal: &'a str,
    pub ty: PortType,
    pub extent: Extent,
    pub machine: usize,
    /// The first one in the image of its inputs.
    pub word: usize,
}

/// A part of a machine.
#[derive(Clone, Copy, Debug)]
pub struct MachinePart<'a> {
    pub robot: &'a str,
    pub part: &'a str,
    pub primitive: &'static Schema,
    /// Of the machine and of the part.
    pub numbers: [usize; 2],
}

/// What a fault needs of a part.
struct Wanted {
    robot: &'static str,
    parts: &'static str,
    cannot: &'static str,
    holds: fn(&Schema) -> bool,
}

const JAMS: Wanted = Wanted {
    robot: "robot with a part that can jam",
    parts: "that can jam",
    cannot: "cannot jam",
    holds: |primitive| primitive.can_jam,
};
const PROCESS: Wanted = Wanted {
    robot: "robot with a process",
    parts: "that are processes",
    cannot: "has no cycles",
    holds: |primitive| primitive.name == "process",
};

impl<'a> Resolver<'a> {
    pub(super) fn jam(&mut self, jam: &Jam<PartName>) -> Option<Jam<[usize; 2]>> {
        let part = self.part(&jam.part, &JAMS)?;
        Some(Jam { part, at_s: jam.at_s, for_s: jam.for_s })
    }

    pub(super) fn slow_cycle(&mut self, slow: &SlowCycle<PartName>) -> Option<SlowCycle<[usize; 2]>> {
        let part = self.part(&slow.part, &PROCESS)?;
        Some(SlowCycle { part, cycle: slow.cycle, longer_s: slow.longer_s })
    }

    /// Machine and part.
    fn part(&mut self, PartName { robot, part }: &PartName, wanted: &Wanted) -> Option<[usize; 2]> {
        let is_wanted = |other: &&MachinePart| (wanted.holds)(other.primitive);
        let robots = self.line.parts.iter().filter(is_wanted);
        let mut robots: Vec<(&str, usize)> = robots.map(|other| (other.robot, other.numbers[0])).collect();
        robots.dedup();
        self.named(robot, &robots, wanted.robot)?;
        let of_robot = || self.line.parts.iter().filter(|other| other.robot == robot.value);
        let found = of_robot().find(|other| other.part == part.value);
        if let Some(found) = found.filter(is_wanted) {
            return Some(found.numbers);
        }
        let message = match found {
            None => format!("{} has no part \"{}\"", robot.value, part.value),
            Some(found) => {
                let primitive = found.primitive.name;
                let article = if primitive.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
                format!("{} of {} is {article} {primitive}, which {}", part.value, robot.value, wanted.cannot)
            }
        };
        let names: Vec<&str> = of_robot().filter(is_wanted).map(|other| other.part).collect();
        let diagnostic = Diagnostic::new("E0147", part.span, message)
            .note(format!("its parts {} are: {}", wanted.parts, listing(&names)))
            .help(instead(&part.value, &names));
        collect(&mut self.diagnostics, diagnostic);
        None
    }

    pub(super) fn stuck(&mut self, stuck: &Stuck<Signal, Spanned<Reading>>) -> Option<Stuck<Words, f64>> {
        let Stuck { input: Signal { robot, signal, element }, reads, at_s, for_s } = stuck;
        let input = self.input(robot, signal)?;
        let element = match element {
            Some(element) => Some(self.element(input, element)?),
            None => None,
        };
        let value = self.reading(input, reads)?;
        let count = if element.is_some() { 1 } else { input.extent.elements(self.scenario.kinds.len()) };
        let words = Words { robot: input.machine, first: input.word + element.unwrap_or(0), count };
        Some(Stuck { input: words, reads: value, at_s: *at_s, for_s: *for_s })
    }

    fn input(&mut self, robot: &Spanned<String>, signal: &Spanned<String>) -> Option<&'a Input<'a>> {
        let all = self.line.inputs;
        if !all.iter().any(|input| input.robot == robot.value) {
            let mut robots: Vec<(&str, usize)> = all.iter().map(|i| (i.robot, i.machine)).collect();
            robots.dedup();
            self.named(robot, &robots, "robot with inputs")?;
        }
        let of_robot = || all.iter().filter(|input| input.robot == robot.value);
        let found = of_robot().find(|input| input.signal == signal.value);
        if found.is_none() {
            let names: Vec<&str> = of_robot().map(|input| input.signal).collect();
            let message = format!("{} has no input \"{}\"", robot.value, signal.value);
            self.wrong_sensor(
                Diagnostic::new("E0146", signal.span, message)
                    .note(format!("its inputs are: {}", listing(&names)))
                    .help(instead(&signal.value, &names)),
            );
        }
        found
    }

    /// The number of an element.
    fn element(&mut self, input: &Input, element: &Spanned<Element>) -> Option<usize> {
        let kinds: Vec<&str> = self.scenario.kinds.iter().map(|kind| kind.name.value.as_str()).collect();
        let elements = input.extent.elements(kinds.len());
        let found = match (&element.value, input.extent) {
            (_, Extent::One) => None,
            (Element::Number(number), _) => Some(*number as usize).filter(|number| *number < elements),
            (Element::Kind(name), Extent::PerKind) => kinds.iter().position(|kind| kind == name),
            (Element::Kind(_), Extent::Times(_)) => None,
        };
        if found.is_none() {
            let shown = match &element.value {
                Element::Number(number) => number.to_string(),
                Element::Kind(name) => format!("\"{name}\""),
            };
            let message = format!("{} of {} has no element {shown}", input.signal, input.robot);
            let diagnostic = Diagnostic::new("E0146", element.span, message)
                .note(format!("its type is {}", type_text(input.ty, input.extent)));
            self.wrong_sensor(match (input.extent, &element.value) {
                (Extent::One, _) => diagnostic.help("remove \"element\": it is one value"),
                (Extent::PerKind, Element::Kind(name)) => diagnostic.help(instead(name, &kinds)),
                _ => diagnostic.help(format!("write a number from 0 to {}", elements.saturating_sub(1))),
            });
        }
        found
    }

    fn reading(&mut self, input: &Input, reads: &Spanned<Reading>) -> Option<f64> {
        let value = match (input.ty, reads.value) {
            (PortType::Bool, Reading::Truth(truth)) => Some(f64::from(u8::from(truth))),
            (PortType::Int { lo, hi }, Reading::Number(number)) => {
                let is_within = (f64::from(lo)..=f64::from(hi)).contains(&number);
                (number.fract() == 0.0 && is_within).then_some(number)
            }
            (PortType::Real, Reading::Number(number)) => Some(number),
            _ => None,
        };
        if value.is_none() {
            let shown = match reads.value {
                Reading::Truth(truth) => truth.to_string(),
                Reading::Number(number) => readable(number),
            };
            let message = format!("{} of {} cannot read {shown}", input.signal, input.robot);
            let help = match input.ty {
                PortType::Bool => "write true or false".to_string(),
                PortType::Int { lo, hi } => format!("write a whole number from {lo} to {hi}"),
                PortType::Real => "write a number".into(),
                PortType::Point => "name an input of another type: a place cannot stick".into(),
            };
            self.wrong_sensor(
                Diagnostic::new("E0146", reads.span, message)
                    .note(format!("its type is {}", type_text(input.ty, input.extent)))
                    .help(help),
            );
        }
        value
    }

    fn wrong_sensor(&mut self, diagnostic: Diagnostic) {
        collect(&mut self.diagnostics, diagnostic);
    }
}
