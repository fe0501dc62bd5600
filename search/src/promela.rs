//! A model in the language of SPIN, so that another search can count its states: for lines without arms and orders, whose
//! inputs change by commands alone.

use crate::event;
use crate::model::Model;
use crate::plant::{Action, Faults, Machine, motion, sight, status};
use crate::program::{
    Argument, Clause, Command, Domain, Int, Operator, PointValue, State, Target, Transition, Unread, Update,
};
use crate::value::{Values, Var};
use std::collections::HashMap;
use std::fmt::Write;

struct Printer<'a> {
    model: &'a Model,
    /// Numbers of the variables by their places.
    numbers: HashMap<u32, usize>,
    values: Values,
    /// Variables of binders that stand for one value each.
    bound: HashMap<usize, i32>,
    out: String,
}

/// The text, or what of the model it cannot say.
pub fn promela(model: &Model) -> Result<String, String> {
    if model.machines.iter().any(|machine| machine.arm.is_some() || machine.desk.is_some()) {
        return Err("arms and orders".into());
    }
    if !model.inputs.is_empty() {
        return Err("inputs that change by themselves".into());
    }
    if !model.cylinders.is_empty() || !model.processes.is_empty() {
        return Err("cylinders and processes".into());
    }
    let numbers = model.variables.iter().enumerate().map(|(number, v)| (v.var.at, number)).collect();
    let mut printer =
        Printer { model, numbers, values: model.values.clone(), bound: HashMap::new(), out: String::new() };
    printer.model()?;
    Ok(printer.out)
}

impl Printer<'_> {
    fn name(&self, var: Var) -> String {
        format!("v{}", self.numbers[&var.at])
    }

    fn line(&mut self, text: impl AsRef<str>) {
        self.out.push_str(text.as_ref());
        self.out.push('\n');
    }

    fn model(&mut self) -> Result<(), String> {
        for variable in &self.model.variables {
            let ty = match variable.var.width {
                1 => "byte",
                2 => "short",
                _ => "int",
            };
            let (name, initial) = (self.name(variable.var), variable.var.load(&self.model.initial));
            let _ = writeln!(self.out, "{ty} {name} = {initial}; /* {} */", variable.name);
        }
        self.line("active proctype line() {\ndo\n:: atomic {");
        for machine in 0..self.model.machines.len() {
            self.events(machine);
        }
        for instance in 0..self.model.instances.len() {
            self.step(instance)?;
        }
        for machine in 0..self.model.machines.len() {
            self.forget(machine);
        }
        self.line("}\nod\n}");
        Ok(())
    }

    /// What a machine may do between two scans, then whether a time comes.
    fn events(&mut self, number: usize) {
        let plant = &self.model.machines[number];
        self.line("if\n:: true");
        if let Some(head) = &plant.head {
            let (answer, command) = (self.name(head.status), self.name(head.command));
            for (index, asked) in head.commands.iter().enumerate() {
                let under_way = format!("{answer} == {} && {command} == {index}", status::UNDER_WAY);
                let well = match (asked.action, &plant.route) {
                    (Action::Trip, Some(route)) => {
                        let goal = self.name(route.goal);
                        let stops = route.stops.iter().map(|stop| self.values.number_of_point(*stop));
                        let stops: Vec<String> = stops.map(|stop| format!("{goal} == {stop}")).collect();
                        format!("{under_way} && ({})", stops.join(" || "))
                    }
                    _ => under_way.clone(),
                };
                self.ending(plant, &well, 0, true);
                if let Some(awaits) = asked.awaits {
                    self.ending(plant, &under_way, awaits.error, true);
                }
                if self.model.faults == Faults::All {
                    asked.refusals.iter().for_each(|error| self.ending(plant, &under_way, *error, false));
                }
            }
        }
        self.line("fi;");
        let program = &self.model.instances[number];
        let Some(times) = program.times_come else { return };
        let (times, state) = (self.name(times), self.name(program.state));
        self.line("if\n:: true");
        for (index, of) in program.states.iter().enumerate().filter(|(_, of)| !of.times.is_empty()) {
            self.line(format!(
                ":: ({state} == {index} && {times} < {}) -> {times} = {times} + 1",
                of.times.len()
            ));
        }
        self.line("fi;");
    }

    fn ending(&mut self, plant: &Machine, when: &str, error: i32, has_moved: bool) {
        let Some(head) = &plant.head else { return };
        let mut text = format!(":: ({when}) ->");
        if let Some(route) = &plant.route {
            let (at, goal) = (self.name(route.at), self.name(route.goal));
            let _ = if has_moved { write!(text, " {at} = {goal};") } else { write!(text, " {goal} = {at};") };
        }
        if let Some(lane) = &plant.lane {
            let lane = self.name(lane.motion);
            let [starts, stops] =
                if has_moved { [motion::RUNS, motion::STANDS] } else { [motion::STANDS, motion::RUNS] };
            let (starting, stopping) = (motion::STARTS, motion::STOPS);
            let _ = write!(
                text,
                " if :: ({lane} == {starting}) -> {lane} = {starts} :: ({lane} == {stopping}) -> {lane} = {stops} :: else fi;"
            );
        }
        let answer = if error == 0 { status::DONE } else { status::FAILED };
        let _ = write!(text, " {} = {answer}; {} = 0", self.name(head.status), self.name(head.command));
        if let Some(port) = head.error {
            let _ = write!(text, "; {} = {error}", self.name(port));
        }
        self.line(text);
    }

    fn forget(&mut self, machine: usize) {
        let Some(head) = &self.model.machines[machine].head else { return };
        let program = &self.model.instances[machine];
        let (answer, state) = (self.name(head.status), self.name(program.state));
        let dead = |is_dead: fn(&State) -> bool| {
            let states = program.states.iter().enumerate().filter(|(_, state)| is_dead(state));
            states.map(|(number, _)| format!("{state} == {number}")).collect::<Vec<_>>().join(" || ")
        };
        let mut forgotten =
            vec![(dead(|state| state.is_answer_dead), format!("{answer} = {}", status::NONE))];
        if let Some(port) = head.error {
            forgotten.push((dead(|state| state.is_error_dead), format!("{} = 0", self.name(port))));
        }
        // An answer that was forgotten is not under way either.
        for (states, forget) in forgotten.into_iter().filter(|(states, _)| !states.is_empty()) {
            let under_way = status::UNDER_WAY;
            self.line(format!("if :: ({answer} != {under_way} && ({states})) -> {forget} :: else fi;"));
        }
    }

    fn step(&mut self, instance: usize) -> Result<(), String> {
        let program = &self.model.instances[instance];
        if !program.properties.is_empty() {
            return Err("properties".into());
        }
        let state = self.name(program.state);
        self.line("if");
        for (number, of) in program.states.iter().enumerate() {
            self.line(format!(":: ({state} == {number}) ->"));
            let mut open = 0;
            for transition in &of.transitions {
                open += self.alternatives(instance, number, transition, &transition.clauses, Vec::new())?;
            }
            self.line(format!("skip{}", "\nfi".repeat(open)));
        }
        self.line("fi;");
        Ok(())
    }

    /// Every way in which the binders of a transition may be chosen, in order; how many `if` are left open.
    fn alternatives(
        &mut self,
        instance: usize,
        state: usize,
        transition: &Transition,
        clauses: &[Clause],
        mut guard: Vec<String>,
    ) -> Result<usize, String> {
        match clauses.split_first() {
            None => {
                let guard = if guard.is_empty() { "true".into() } else { guard.join(" && ") };
                self.line(format!("if\n:: ({guard}) ->"));
                self.fire(instance, state, transition)?;
                self.line(":: else ->");
                Ok(1)
            }
            Some((Clause::Condition(condition), rest)) => {
                guard.push(self.int(condition)?);
                self.alternatives(instance, state, transition, rest, guard)
            }
            Some((Clause::Bind { variable, domain: Domain::List(values), condition, key: None }, rest)) => {
                let mut open = 0;
                for value in values.iter() {
                    self.bound.insert(*variable, *value);
                    let mut guard = guard.clone();
                    if let Some(condition) = condition {
                        guard.push(self.int(condition)?);
                    }
                    open += self.alternatives(instance, state, transition, rest, guard)?;
                }
                self.bound.remove(variable);
                Ok(open)
            }
            Some(_) => Err("binders by a key or over a range".into()),
        }
    }

    fn fire(&mut self, instance: usize, _state: usize, transition: &Transition) -> Result<(), String> {
        for update in &transition.updates {
            self.update(instance, update)?;
        }
        let program = &self.model.instances[instance];
        if let Some(target) = transition.target {
            let mut text = format!("{} = {target};", self.name(program.state));
            if let Some(times) = program.times_come {
                let _ = write!(text, " {} = 0;", self.name(times));
            }
            for (var, value) in &program.states[target].dead {
                let _ = write!(text, " {} = {value};", self.name(*var));
            }
            for Unread { input, seen, not_seen } in &program.states[target].unread {
                let name = self.name(*input);
                let (is_seen, is_not) = (sight::SEEN, sight::NOT_SEEN);
                let _ = write!(
                    text,
                    " {name} = ({name} == {is_seen} -> {seen} : ({name} == {is_not} -> {not_seen} : {name}));"
                );
            }
            self.line(text);
        }
        self.line("skip");
        Ok(())
    }

    fn update(&mut self, instance: usize, update: &Update) -> Result<(), String> {
        match update {
            Update::Int(target, value, bounds) if bounds.fault.is_none() => {
                let value = format!("{} - ({})", self.int(value)?, bounds.base);
                self.store(target, &value)
            }
            Update::Copy(updates) => {
                let is_constant = |update: &Update| matches!(update, Update::Int(_, Int::Constant(_), _));
                if !updates.iter().all(is_constant) {
                    return Err("copies of arrays".into());
                }
                updates.iter().try_for_each(|update| self.update(instance, update))
            }
            Update::Command(command) => self.command(instance, command),
            _ => Err("updates that may fault, points and reals".into()),
        }
    }

    fn store(&mut self, target: &Target, value: &str) -> Result<(), String> {
        match (&target.index, &target.vars[..]) {
            (_, []) => Ok(()),
            (Int::Constant(index), vars) => {
                let name = self.name(vars[*index as usize]);
                self.line(format!("{name} = {value};"));
                Ok(())
            }
            (index, vars) => {
                let index = self.int(index)?;
                let names: Vec<String> = vars.iter().map(|var| self.name(*var)).collect();
                self.line("if");
                for (number, name) in names.iter().enumerate() {
                    self.line(format!(":: ({index} == {number}) -> {name} = {value}"));
                }
                self.line("fi;");
                Ok(())
            }
        }
    }

    fn command(&mut self, machine: usize, command: &Command) -> Result<(), String> {
        let plant = &self.model.machines[machine];
        let Some(head) = &plant.head else { return Ok(()) };
        let is_stored = |argument: &Argument| match argument {
            Argument::Output(_) => true,
            Argument::Place(target, _, fault) => !target.vars.is_empty() || fault.is_some(),
        };
        if command.arguments.iter().any(is_stored) {
            return Err("outputs that are read".into());
        }
        let (answer, number) = (self.name(head.status), self.name(head.command));
        let under_way = status::UNDER_WAY;
        if let Some(route) = &plant.route {
            let (at, goal) = (self.name(route.at), self.name(route.goal));
            self.line(format!(
                "if :: ({answer} == {under_way} && {at} != {goal}) -> if :: true :: {at} = {goal} fi :: else fi;"
            ));
            let [Argument::Place(_, PointValue::Constant(point), _)] = command.arguments[..] else {
                return Err("goals that the layout does not fix".into());
            };
            let stop = self.values.number_of_point(event::stop(&route.stops, route.tolerance, point));
            self.line(format!("{goal} = {stop};"));
        }
        if let Some(lane) = &plant.lane {
            let lane = self.name(lane.motion);
            let (starts, stops, stands, runs) = (motion::STARTS, motion::STOPS, motion::STANDS, motion::RUNS);
            self.line(format!(
                "if :: ({answer} == {under_way} && ({lane} == {starts} || {lane} == {stops})) -> if :: {lane} = {stands} :: {lane} = {runs} fi :: else fi;"
            ));
            match head.commands[command.command].action {
                Action::Run => {
                    self.line(format!("if :: ({lane} != {runs}) -> {lane} = {starts} :: else fi;"))
                }
                Action::Rest => {
                    self.line(format!("if :: ({lane} != {stands}) -> {lane} = {stops} :: else fi;"))
                }
                _ => {}
            }
        }
        self.line(format!("{answer} = {under_way}; {number} = {};", command.command));
        Ok(())
    }

    fn int(&mut self, expr: &Int) -> Result<String, String> {
        Ok(match expr {
            Int::Constant(value) => format!("({value})"),
            Int::Load(var, 0) => self.name(*var),
            Int::Load(var, low) => format!("({} + ({low}))", self.name(*var)),
            Int::Variable(variable) => match self.bound.get(variable) {
                Some(value) => format!("({value})"),
                None => return Err("variables without a value".into()),
            },
            Int::Element(elements, index) => {
                let parts =
                    elements.vars.iter().map(|var| format!("({} + ({}))", self.name(*var), elements.low));
                let parts: Vec<String> = parts.collect();
                self.one_of(&parts, index)?
            }
            Int::Table(table, index) => {
                let parts: Vec<String> = table.iter().map(|value| format!("({value})")).collect();
                self.one_of(&parts, index)?
            }
            Int::Shared(expr) => self.int(expr)?,
            Int::Not(a) => format!("(!{})", self.int(a)?),
            Int::Negate(a) => format!("(-{})", self.int(a)?),
            Int::And(all) => self.joined(all, " && ")?,
            Int::Or(all) => self.joined(all, " || ")?,
            Int::Total(all) => self.joined(all, " + ")?,
            Int::Binary(operator, pair) => {
                let (a, b) = (self.int(&pair[0])?, self.int(&pair[1])?);
                format!("({a} {} {b})", sign(*operator))
            }
            Int::OneOf(members, value) => {
                let value = self.int(value)?;
                let all: Vec<String> = members.iter().map(|member| format!("{value} == {member}")).collect();
                if all.is_empty() { "(false)".into() } else { format!("({})", all.join(" || ")) }
            }
            _ => return Err("points, reals and what is chosen anew in each scan".into()),
        })
    }

    fn joined(&mut self, all: &[Int], between: &str) -> Result<String, String> {
        let parts: Result<Vec<String>, String> = all.iter().map(|part| self.int(part)).collect();
        Ok(format!("({})", parts?.join(between)))
    }

    fn one_of(&mut self, parts: &[String], index: &Int) -> Result<String, String> {
        let index = self.int(index)?;
        let (last, others) = parts.split_last().ok_or("tables without values")?;
        let choice = |rest: String, (number, part): (usize, &String)| {
            format!("(({index} == {number}) -> {part} : {rest})")
        };
        Ok(others.iter().enumerate().rev().fold(last.clone(), choice))
    }
}

fn sign(operator: Operator) -> &'static str {
    match operator {
        Operator::Equal => "==",
        Operator::NotEqual => "!=",
        Operator::Less => "<",
        Operator::LessEqual => "<=",
        Operator::Greater => ">",
        Operator::GreaterEqual => ">=",
        Operator::Add => "+",
        Operator::Subtract => "-",
        Operator::Multiply => "*",
        Operator::Divide => "/",
        Operator::Modulo => "%",
    }
}
