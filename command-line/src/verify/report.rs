//! What a search has shown, and exactly what not.

use super::super::options::{StepOrders, VerifyOptions, Warnings};
use autogen::verify::replay::Replay;
use autogen::verify::story::Teller;
use autogen::verify::{Never, Skipped};
use autogen_search::explore::{Covered, Decided, End, Outcome};
use autogen_search::property::Check;
use autogen_search::story::Execution;
use autogen_search::violation::Violation;
use runtime_sim::line::Goal;
use serde_json::{Map, Value, json};
use std::fmt::Write;

pub struct Report<'a> {
    pub options: &'a VerifyOptions,
    pub teller: &'a Teller<'a>,
    pub outcome: &'a Outcome,
    /// Answers in one scan of the last search.
    pub answers: Option<usize>,
    pub first: Option<First>,
    pub shown: &'a [Shown<'a>],
    /// Properties that were left out.
    pub skipped: &'a [Skipped],
    /// What [`autogen::verify::under_way::places`] says.
    pub under_way: Vec<String>,
    pub never: Unreached<'a>,
}

/// A search with one answer in a scan that came before, and found no violation.
pub struct First {
    pub is_proved: bool,
    pub covered: Covered,
}

impl First {
    fn text(&self) -> String {
        let Covered { states, failing, time, .. } = self.covered;
        let what = match failing {
            _ if self.is_proved => "proved".into(),
            Some(failing) => checked(failing),
            None => "nothing found".into(),
        };
        format!("{what}: {states} states, {:.2} s", time.as_secs_f64())
    }

    fn json(&self) -> Value {
        let Covered { states, failing, time, .. } = self.covered;
        json!({
            "proved": self.is_proved, "failing_scans": failing, "states": states, "time_s": time.as_secs_f64()
        })
    }
}

/// What happens in no execution of a complete search: nothing is proved of it.
#[derive(Default)]
pub struct Unreached<'a> {
    /// Machines with the states that they have in no state that was reached.
    states: Vec<(&'a str, Vec<&'a str>)>,
    devices: Never,
    properties: Never,
}

impl<'a> Unreached<'a> {
    /// Nothing, if the search is not complete.
    pub fn new(teller: &Teller<'a>, outcome: &Outcome) -> Self {
        if outcome.end != End::Complete {
            return Self::default();
        }
        Self {
            states: never_entered(teller, outcome),
            devices: teller.never_done(&outcome.occurred),
            properties: teller.never_tested(&outcome.occurred),
        }
    }

    /// `30 of 60 states of the machines, 1 of 9 actions of devices`
    fn counted(&self, states: usize) -> String {
        let entered: usize = self.states.iter().map(|(_, states)| states.len()).sum();
        let Self { devices, properties, .. } = self;
        let all = [
            (entered, states, "states of the machines"),
            (devices.number(), devices.all, "actions of devices"),
            (properties.number(), properties.all, "conditions of properties"),
        ];
        let all = all.into_iter().filter(|(never, ..)| *never > 0);
        all.map(|(never, of, what)| format!("{never} of {of} {what}")).collect::<Vec<_>>().join(", ")
    }
}

pub struct Shown<'a> {
    pub violation: &'a Violation,
    pub execution: &'a Execution,
    pub replay: Result<Replay, String>,
}

impl Report<'_> {
    fn verdict(&self) -> &'static str {
        match (self.outcome.violations.is_empty(), self.outcome.is_proved()) {
            (false, _) => "violated",
            (true, true) => "proved within these bounds",
            (true, false) => "undecided",
        }
    }

    /// Why the search ended before all states were checked.
    fn cut(&self) -> Option<&'static str> {
        match self.outcome.end {
            End::Complete => None,
            End::Violated => Some("it ended with the violation"),
            End::TimeIsUp => Some("the time limit was reached"),
            End::MemoryIsFull => Some("the memory limit was reached"),
            End::TooManyStates => Some("there are too many states"),
            End::Stopped => Some("it was interrupted"),
            End::TooManyValues => Some("there are more than 65,536 places or numbers"),
        }
    }

    fn bounds(&self) -> Vec<String> {
        let plant = &self.teller.project.plant;
        let machines: Vec<&str> = plant.machines.iter().map(|machine| machine.name.as_str()).collect();
        let parts: u32 = plant.scenario.orders.iter().flat_map(|order| &order.parts).sum();
        let mut bounds = vec![
            format!("machines: {}", machines.join(", ")),
            format!("orders: {} of {parts} parts together", plant.scenario.orders.len()),
            match self.answers {
                Some(answers) => format!("answers: at most {answers} in a scan"),
                None => "answers: any number in a scan, after any number of scans".into(),
            },
            match self.options.orders {
                StepOrders::One => "steps: in the order of the line".into(),
                StepOrders::All => "steps: in any order, which may change with each scan".into(),
            },
            if self.options.no_faults {
                "faults: none".into()
            } else {
                "faults: commands end in each of their errors, grippers lose what they hold".into()
            },
            "belts bring parts of every kind, without end; timers expire in any scan, `within` never expires"
                .into(),
            "the system runs, without pauses and without an operator".into(),
        ];
        if !self.under_way.is_empty() {
            bounds.push(format!(
                "while an arm moves, its tool is where the motion began; a vehicle is at its start, midway or at its goal: conditions read {}",
                self.under_way.join(", ")
            ));
        }
        if self.outcome.covered.stops > 0 {
            bounds.push(format!(
                "{} transitions end in a stop whose text calls the operator; the search does not continue after it",
                self.outcome.covered.stops
            ));
        }
        if self.outcome.covered.stopped > 0 {
            bounds.push(format!(
                "in {} states a machine is stopped by itself, which calls the operator: what can follow there is not decided",
                self.outcome.covered.stopped
            ));
        }
        let has_obligations = self.teller.model.instances.iter().flat_map(|instance| &instance.properties);
        if has_obligations.into_iter().any(|property| matches!(property.check, Check::Whenever(_))) {
            let is_refuted =
                |(violation, _): &(Violation, _)| matches!(violation, Violation::NeverFollowed { .. });
            match self.undecided(self.outcome.obligations) {
                Some(why) => {
                    bounds.push(format!("whether what a `whenever` waits for can come is not decided: {why}"));
                }
                None if self.outcome.violations.iter().any(is_refuted) => {}
                None if self.outcome.violations.iter().any(ends_the_search) => bounds.push(
                    "after any number of scans either what a `whenever` waits for can still come, or one of these violations; whether it comes in time is not decided"
                        .into(),
                ),
                None => bounds.push(
                    "what a `whenever` waits for can always still come, after any number of scans; whether it comes in time is not decided"
                        .into(),
                ),
            }
        }
        match self.options.warnings {
            Warnings::None => bounds.push("properties that only warn are not searched".into()),
            Warnings::Own => {
                bounds.push(
                    "properties of the library that only warn are not searched: `--warnings all`".into(),
                );
            }
            Warnings::All => {}
        }
        for skipped in self.skipped {
            bounds.push(format!(
                "not searched, because it reads what no contract describes: {}",
                self.teller.skipped(skipped)
            ));
        }
        if !self.never.states.is_empty() {
            bounds.push(format!("no state was reached with: {}", named(&self.never.states)));
        }
        if let Goal::Collected(_) = plant.scenario.goal {
            bounds.push("whether the goal of items can be reached is not checked".into());
        }
        if plant.scenario.orders.is_empty() {
            bounds.push("nothing is ordered: whether orders can be made is not checked".into());
        } else if let Some(why) = self.undecided(self.outcome.orders) {
            bounds.push(format!("whether orders can be made is not decided: {why}"));
        }
        bounds
    }

    /// Why a question is not decided, if it is not.
    fn undecided(&self, question: Decided) -> Option<&'static str> {
        match question {
            Decided::Yes => None,
            Decided::ItemsAreHidden => Some(HIDDEN),
            Decided::NotReached if !self.outcome.violations.is_empty() => {
                Some("the search ended with the violation")
            }
            Decided::NotReached => Some(self.cut().unwrap_or("the limit was reached before")),
        }
    }

    /// Nothing, if nothing is ordered.
    fn are_orders_decided(&self) -> Option<bool> {
        let has_orders = !self.teller.project.plant.scenario.orders.is_empty();
        has_orders.then_some(self.outcome.orders == Decided::Yes)
    }

    /// What a proof says nothing of.
    fn exempt(&self) -> String {
        let system = &self.teller.project.system;
        let all: usize = (0..system.instances.len()).map(|it| system.automaton_of(it).states.len()).sum();
        let counted = self.never.counted(all);
        let joined = if self.outcome.is_proved() { ", but" } else { ";" };
        if counted.is_empty() { counted } else { format!("{joined} never reached: {counted}") }
    }

    /// What the simulator made of it.
    fn replayed(&self, Shown { violation, replay, .. }: &Shown) -> String {
        let Replay { result, report, .. } = match replay {
            Ok(replay) => replay,
            Err(why) => return format!("there is no run: {why}"),
        };
        let fired = match result {
            Ok(seconds) => format!("the same transitions have fired by {seconds:.2} s"),
            Err(why) => why.clone(),
        };
        let occurs = match self.teller.occurs(violation, report) {
            Some(true) => "; the violation occurs",
            Some(false) => "; the violation does not occur",
            None => "",
        };
        format!("{fired}{occurs}; the run ends: {}", self.teller.reason(report))
    }

    pub fn text(&self) -> String {
        let covered = &self.outcome.covered;
        let mut out = String::new();
        for shown in self.shown {
            let _ = writeln!(out, "{}\n", self.teller.title(shown.violation));
            let _ = writeln!(out, "{}", self.teller.tell(shown.execution));
            let situation = self.teller.situation(shown.execution);
            if !situation.is_empty() {
                let _ = writeln!(out, "at that moment\n  {}\n", situation.join("\n  "));
            }
            if let Some(told) = self.teller.told_without_contract(shown.execution) {
                let _ = writeln!(out, "without contract   {told}\n");
            }
            let _ = writeln!(out, "in the simulator   {}\n", self.replayed(shown));
        }
        for (remark, execution) in &self.outcome.remarks {
            let _ = writeln!(out, "noticed: {}\n", self.teller.title(remark));
            let _ = writeln!(out, "{}", self.teller.tell(execution));
        }
        let _ = writeln!(out, "{}{}\n", self.verdict(), self.exempt());
        let Unreached { devices, properties, .. } = &self.never;
        let never = [devices.told(), properties.told()].concat();
        if !never.is_empty() {
            let _ = writeln!(out, "never reached, so nothing is proved of it");
            never.iter().for_each(|never| {
                let _ = writeln!(out, "  {never}");
            });
            out += "\n";
        }
        for bound in self.bounds() {
            let _ = writeln!(out, "  {bound}");
        }
        let _ = writeln!(
            out,
            "\nstates             {}\ntransitions        {}\ndepth              {} scans\ntime               {:.2} s\nmemory             {} MB",
            covered.states,
            covered.transitions,
            covered.depth,
            covered.time.as_secs_f64(),
            covered.memory / 1_000_000
        );
        match self.cut() {
            None => out += "complete           yes\n",
            Some(why) => {
                let _ = writeln!(out, "complete           no: {why}");
                if let Some(failing) = covered.failing {
                    let _ = writeln!(out, "checked            {}", checked(failing));
                }
                if let Some(first) = &self.first {
                    let _ = writeln!(out, "with one answer    {}", first.text());
                }
            }
        }
        out
    }

    pub fn json(&self) -> Value {
        let covered = &self.outcome.covered;
        let violations: Vec<Value> = (self.shown.iter())
            .map(|shown| {
                json!({
                    "violation": self.teller.title(shown.violation),
                    "story": self.teller.tell(shown.execution).lines().collect::<Vec<_>>(),
                    "at_that_moment": self.teller.situation(shown.execution),
                    "without_contract": self.teller.without_contract(shown.execution),
                    "simulator": self.replayed(shown),
                })
            })
            .collect();
        let remarks: Vec<Value> = (self.outcome.remarks.iter())
            .map(|(remark, execution)| {
                json!({
                    "remark": self.teller.title(remark),
                    "story": self.teller.tell(execution).lines().collect::<Vec<_>>(),
                })
            })
            .collect();
        let never: Map<String, Value> =
            self.never.states.iter().map(|(machine, states)| (machine.to_string(), json!(states))).collect();
        json!({
            "verdict": self.verdict(),
            "complete": self.cut().is_none(),
            "bounds": self.bounds(),
            "never_reached": never,
            "never_happens": {
                "actions": self.never.devices.told(),
                "conditions": self.never.properties.told(),
            },
            "violations": violations,
            "remarks": remarks,
            "states": covered.states,
            "transitions": covered.transitions,
            "stops": covered.stops,
            "stopped_states": covered.stopped,
            "depth": covered.depth,
            "failing_scans": covered.failing,
            "orders_decided": self.are_orders_decided(),
            "time_s": covered.time.as_secs_f64(),
            "memory_bytes": covered.memory,
            "with_one_answer": self.first.as_ref().map(First::json),
        })
    }
}

/// Why something is left open.
const HIDDEN: &str = "items on conveyors without commands, cylinders, positioners and tracks are not known";

/// Whether the search does not continue after a violation.
fn ends_the_search<T>((violation, _): &(Violation, T)) -> bool {
    !matches!(violation, Violation::Warning { .. } | Violation::MachineStops { .. } | Violation::NeverMade)
}

fn never_entered<'a>(teller: &Teller<'a>, outcome: &Outcome) -> Vec<(&'a str, Vec<&'a str>)> {
    let (system, instances) = (&teller.project.system, &teller.model.instances);
    let states = |number: usize| &system.automaton_of(number).states;
    let mut entered: Vec<Vec<bool>> =
        (0..instances.len()).map(|number| vec![false; states(number).len()]).collect();
    for state in (0..outcome.reached.len()).map(|state| outcome.reached.state(state)) {
        for (instance, entered) in instances.iter().zip(&mut entered) {
            entered[instance.state.load(&state) as usize] = true;
        }
    }
    outcome.entered.iter().for_each(|(instance, state)| entered[*instance][*state] = true);
    let of_instance = |(number, entered): (usize, Vec<bool>)| {
        let never = states(number).iter().zip(entered).filter(|(_, entered)| !entered);
        let names: Vec<&str> = never.map(|(state, _)| state.name.as_str()).collect();
        (!names.is_empty()).then(|| (system.instances[number].name.as_str(), names))
    };
    entered.into_iter().enumerate().filter_map(of_instance).collect()
}

fn named(never: &[(&str, Vec<&str>)]) -> String {
    let machines = never.iter().map(|(machine, states)| format!("{machine} in {}", states.join(", ")));
    machines.collect::<Vec<_>>().join("; ")
}

/// What a search that was cut has checked.
fn checked(failing: usize) -> String {
    match failing {
        0 => "all sequences without faults".into(),
        1 => "all sequences with faults in at most one scan".into(),
        _ => format!("all sequences with faults in at most {failing} scans"),
    }
}
