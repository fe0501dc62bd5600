//! An execution in words.

use super::Skipped;
use crate::fault;
use crate::lower::Project;
use crate::source::{Sources, Span};
use autogen_search::Fired;
use autogen_search::event::{Ending, Event, From, What};
use autogen_search::model::Model;
use autogen_search::story::{Execution, Happened};
use autogen_search::stroke::position;
use autogen_search::violation::Violation;
use runtime_sim::report::Report;
use std::fmt::Write;

/// Who tells it.
pub struct Teller<'a> {
    pub project: &'a Project,
    pub model: &'a Model,
    pub sources: &'a Sources,
}

impl Teller<'_> {
    /// What is wrong, on one line.
    pub fn title(&self, violation: &Violation) -> String {
        let name = |machine: usize| self.name(machine);
        match *violation {
            Violation::Fault { instance, fault } => {
                let site = &self.project.system.model.faults[fault];
                format!("fault of {}: {} ({})", name(instance), site.text, self.place(site.place))
            }
            Violation::Warning { instance, fault } => {
                let site = &self.project.system.model.faults[fault];
                format!("warning of {}: {} ({})", name(instance), site.text, self.place(site.place))
            }
            Violation::MachineStops { instance, fault } => {
                let site = &self.project.system.model.faults[fault];
                format!("stop of {}: {} ({})", name(instance), site.text, self.place(site.place))
            }
            Violation::NeverFollowed { instance, fault } => {
                let properties = &self.project.system.automaton_of(instance).properties;
                let property = properties.iter().find(|property| property.site.0 == fault);
                let text = property.map_or("a property", |property| property.text.as_str());
                let place = self.place(self.project.system.model.faults[fault].place);
                format!("from here `{text}` of {} cannot be fulfilled any more ({place})", name(instance))
            }
            Violation::Stop { .. } => "the line stops until an operator comes".into(),
            Violation::StopsAgain => {
                "the line stops until an operator comes, and stops again each time it is started".into()
            }
            Violation::FaultBehindStop { instance, fault } => {
                let site = &self.project.system.model.faults[fault];
                format!(
                    "the line stops until an operator comes, and as it goes on: fault of {}: {} ({})",
                    name(instance),
                    site.text,
                    self.place(site.place)
                )
            }
            Violation::NeverRests => {
                "all orders are made, and the line cannot come to rest although nothing has failed".into()
            }
            Violation::ComesToAStand => {
                "the line comes to a stand for ever, although nothing has failed: nothing changes any more"
                    .into()
            }
            Violation::WaitsForTime { instance } => format!(
                "the whole line does nothing until a time of {} has passed, whose device has not failed",
                name(instance)
            ),
            Violation::Repeats { machine } => {
                format!("{} gives the command again that is under way", name(machine))
            }
            Violation::OnAndEmpty { arm } => {
                format!("{} sets out with its gripper still on and empty", name(arm))
            }
            Violation::NothingThere { arm, machine, slot } => {
                format!(
                    "{} is to take an item from place {slot} of {}, where none lies",
                    name(arm),
                    name(machine)
                )
            }
            Violation::LeavesSideways { arm, machine } => {
                format!(
                    "{} leaves a slot of {} sideways, lower than items in other slots",
                    name(arm),
                    name(machine)
                )
            }
            Violation::NeverMade => "from here the orders cannot be made any more".into(),
            Violation::TwoArms { arms: [a, b], machine } => {
                format!("two arms over one place: {} and {} over {}", name(a), name(b), name(machine))
            }
            Violation::MovesUnder { machine, arm } => {
                format!("{} moves while {} is at it", name(machine), name(arm))
            }
            Violation::ItemOnItem { arm, machine, slot } => {
                format!("{} puts an item onto another one, at place {slot} of {}", name(arm), name(machine))
            }
            Violation::Dropped { arm, machine } => {
                format!("{} lets an item fall onto {}", name(arm), name(machine))
            }
            Violation::ItemAmongItems { arm, machine } => {
                format!("{} puts an item on {}, where one lies among the slots", name(arm), name(machine))
            }
            Violation::WrongItems { machine, order } => {
                format!("{} completes order {} with other items than it asks for", name(machine), order + 1)
            }
        }
    }

    /// The execution scan by scan; scans in which nothing happens are left out. An input that changes by itself is told where
    /// it is read and has changed: in the beginning it is 0.
    pub fn tell(&self, execution: &Execution) -> String {
        let mut out = String::new();
        let mut inputs = vec![0; self.model.inputs.len()];
        for (number, happened) in execution.scans.iter().enumerate() {
            for event in &happened.events {
                let _ = writeln!(out, "{:>4}  {}", number + 1, self.event(happened, event));
            }
            let is_last = number + 1 == execution.scans.len();
            // Nothing but what was read can have brought the last scan about.
            let tells_all = is_last && happened.events.is_empty() && happened.told.fired.is_empty();
            for (input, value) in &happened.told.read {
                if std::mem::replace(&mut inputs[*input], *value) != *value || tells_all {
                    let _ = writeln!(out, "{:>4}  {} is {value}", number + 1, self.input(*input));
                }
            }
            for fired in &happened.told.fired {
                let _ = writeln!(out, "{:>4}    {}", number + 1, self.fired(fired));
            }
            // That of the last scan is the violation, or comes with it.
            for stop in happened.stops.iter().filter(|_| !is_last) {
                let _ = writeln!(out, "{:>4}    {}", number + 1, self.title(stop));
            }
        }
        out
    }

    /// `shelf.(key on)`
    pub(super) fn input(&self, input: usize) -> &str {
        let var = self.model.inputs[input].var;
        let found = self.model.variables.iter().find(|variable| variable.var == var);
        found.map_or("an input", |variable| variable.name.trim_end_matches("[0]"))
    }

    /// A property that is left out: `mill: keep level while is_closed (mill.aut:12:5)`
    pub fn skipped(&self, skipped: &Skipped) -> String {
        let automaton = self.project.system.automaton_of(skipped.instance);
        let property = &automaton.properties[skipped.property];
        format!("{}: {} ({})", self.name(skipped.instance), property.text, self.place(property.place))
    }

    /// Whether a run shows a violation; none: it cannot tell.
    pub fn occurs(&self, violation: &Violation, report: &Report) -> Option<bool> {
        let code = |fault: usize| fault as i32 + 1;
        match *violation {
            Violation::Fault { instance, fault } => {
                let fault_of =
                    |(of, machine): &(i32, String)| *of == code(fault) && machine == self.name(instance);
                Some(report.fault.as_ref().is_some_and(fault_of))
            }
            Violation::Warning { instance, fault } | Violation::MachineStops { instance, fault } => {
                let mut alarms = report.alarms.iter();
                Some(alarms.any(|alarm| alarm.code == code(fault) && alarm.machine == self.name(instance)))
            }
            Violation::NeverMade if report.finished => Some(false),
            _ => None,
        }
    }

    /// Why a run ended, as `commission` tells it.
    pub fn reason(&self, report: &Report) -> String {
        fault::reason_of_run(report, &self.project.system, self.sources)
    }

    pub(super) fn part(&self, machine: usize, part: usize) -> &str {
        &self.project.plant.machines[machine].parts[part].name
    }

    pub(super) fn name(&self, machine: usize) -> &str {
        &self.project.system.instances[machine].name
    }

    /// A state of a machine's automaton.
    pub(super) fn state(&self, machine: usize, number: usize) -> &str {
        match number {
            0 => "Initial",
            _ => &self.project.system.automaton_of(machine).states[number].name,
        }
    }

    /// Of a value that is one more than a kind; none: there is no item, or one of any kind.
    pub(super) fn kind(&self, value: i32) -> Option<&str> {
        let kind = usize::try_from(value).ok()?.checked_sub(1)?;
        self.project.plant.kinds.get(kind).map(|kind| kind.name.as_str())
    }

    /// `kitting.aut:43:5`
    pub(super) fn place(&self, span: Span) -> String {
        let (line, column) = self.sources.position(span);
        format!("{}:{line}:{column}", self.sources.file(span.file).name)
    }

    /// `kitting: Picking -> Lifting, when done (kitting.aut:43:5)`
    pub fn fired(&self, fired: &Fired) -> String {
        let automaton = self.project.system.automaton_of(fired.instance);
        let state = &automaton.states[fired.state];
        let transition = &state.transitions[fired.transition];
        let name = |number: usize| self.state(fired.instance, number);
        let target = transition.target.map_or(String::new(), |target| format!(" -> {}", name(target.0)));
        format!(
            "{}: {}{target}, {} ({})",
            self.name(fired.instance),
            name(fired.state),
            transition.title(),
            self.place(transition.place)
        )
    }

    /// `kitting answers: pick has ended successfully, a battery hangs on the gripper`
    pub fn event(&self, happened: &Happened, event: &Event) -> String {
        let name = self.name(event.machine);
        let plant = &self.model.machines[event.machine];
        let kind =
            |var: autogen_search::value::Var, state: &[u8]| self.kind(var.load(state)).unwrap_or("item");
        match event.what {
            What::Ends(ending) => {
                let command = plant.head.as_ref().map_or(0, |head| head.command.load(&happened.before));
                let device = &self.project.system.automaton_of(event.machine).device;
                let number =
                    self.project.plant.machines[event.machine].wiring.commands[command as usize].number;
                let verb = device.verbs.iter().find(|verb| verb.number == number);
                let verb = verb.map_or("command", |verb| verb.name.as_str());
                match ending {
                    Ending::Well => format!("{name} answers: `{verb}` has ended successfully"),
                    Ending::WithItem => {
                        format!(
                            "{name} answers: `{verb}` has ended successfully, and an item hangs on the gripper"
                        )
                    }
                    Ending::WithItemUnseen => format!(
                        "{name} answers: `{verb}` has ended successfully; the signal of its gripper comes later"
                    ),
                    Ending::InVain => format!("{name} answers: `{verb}` has ended without success"),
                    Ending::Refused(error) => {
                        format!("{name} answers: `{verb}` has ended in error {error}, nothing has moved")
                    }
                }
            }
            What::Loses(from) => {
                let item = plant.arm.as_ref().map_or("item", |arm| kind(arm.holds, &happened.before));
                let place = match from {
                    From::Tool => "where it is, or at its start",
                    From::Via => "where it passes",
                    From::Goal => "at its goal",
                    From::OnTheWay => "on the way",
                    From::BesideTool => "near its start",
                    From::BesideGoal => "near its goal",
                };
                format!("{name} loses the {item} {place}")
            }
            What::Takes => format!("{name} takes the item that is there"),
            What::TakesAtStart => format!("{name} takes the item at its start"),
            What::Shows => {
                let holds = plant.arm.as_ref().is_some_and(|arm| arm.holds.load(&happened.before) != 0);
                let what = if holds { "an item" } else { "nothing" };
                format!("{name} answers: {what} hangs on the gripper")
            }
            What::Opens => format!("{name}: the next order opens"),
            What::IsGone => {
                let order = plant.desk.as_ref().map_or(0, |desk| desk.order.load(&happened.before));
                format!("{name}: order {} has been taken away", order + 1)
            }
            What::Strokes { cylinder, to, .. } => {
                let part = self.part(event.machine, self.model.cylinders[cylinder].part);
                match to {
                    position::IN => format!("{name}: `{part}` has come to its inner end"),
                    position::OUT => format!("{name}: `{part}` has come to its outer end"),
                    _ => format!("{name}: `{part}` has left its end"),
                }
            }
            What::Settles(cylinder) => {
                let part = self.part(event.machine, self.model.cylinders[cylinder].part);
                format!("{name}: `{part}` rests")
            }
            What::Begins(process) => {
                let part = self.part(event.machine, self.model.processes[process].part);
                format!("{name}: `{part}` begins")
            }
            What::Leaps(process) | What::Completes(process) => {
                let part = self.part(event.machine, self.model.processes[process].part);
                format!("{name}: `{part}` has ended")
            }
            What::TimeComes => format!("{name}: a timer of its state expires"),
        }
    }
}
