//! What runs of emitted texts have compared and executed, summed over all of them.

use crate::st::{Beside, Emitted};
use autogen::backend::{Files, st};
use autogen::ir::{Automaton, StateId, System, Update, UpdateKind};
use autogen::naming::camel;
use autogen::source::Sources;
use autogen_st_judge::check::Checked;
use autogen_st_judge::dead::{dead, unread_globals};
use autogen_st_judge::{judge, listed};
use std::collections::{BTreeMap, BTreeSet};

/// The label of the branch for all other numbers.
const ELSE: &str = "ELSE";

/// A CASE branch: the family of texts, the unit, the label.
type Branch = (String, String, String);

#[derive(Debug, Default)]
pub struct Coverage {
    pub texts: usize,
    pub scans: u64,
    /// Words of states, timers, locals, cells and outputs.
    pub words: u64,
    /// What the judge found, what differs, what is dead, what exceeds a bound; with the name of the text.
    pub wrong: Vec<String>,
    /// Branches that only texts begun elsewhere have entered.
    pub only_begun_elsewhere: usize,
    /// Variables that a specification declares and nobody reads, as the text and their name.
    pub unread: BTreeSet<String>,
    branches: BTreeMap<Branch, u64>,
    constructs: BTreeMap<String, u64>,
    /// Greatest part of a bound that a scan has come to, in percent.
    pub nearest: u64,
}

/// An emitted text that is going to be run.
pub struct Text<'a> {
    pub name: &'a str,
    /// Texts of one family have the same units.
    pub family: &'a str,
    pub system: &'a System,
    files: Files,
    /// Found to be right once; it is run several times.
    is_judged: std::cell::Cell<bool>,
}

impl<'a> Text<'a> {
    pub fn new(name: &'a str, family: &'a str, system: &'a System, sources: &Sources) -> Self {
        Self { name, family, system, files: st::files(system, sources), is_judged: false.into() }
    }

    pub fn main(&self) -> &str {
        &self.files["portable/main.st"]
    }

    /// `bounds.txt`: the most statements of each unit in one call, and `all` of a scan.
    fn bounds(&self) -> BTreeMap<&str, u64> {
        let rows = self.files["bounds.txt"].lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        let rows = rows.filter_map(|row| match row[..] {
            [name, once, _, together] => {
                together.parse::<u64>().ok().and_then(|_| Some((name, once.parse().ok()?)))
            }
            ["all", all] => Some(("all", all.parse().ok()?)),
            _ => None,
        });
        rows.collect()
    }
}

/// The texts of what is wrong go to the folder that AUTOGEN_ST names.
fn keep(text: &Text) {
    let Some(folder) = std::env::var_os("AUTOGEN_ST") else { return };
    let folder = std::path::Path::new(&folder).join(text.name);
    for (name, text) in &text.files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap_or(&folder)).expect("a folder");
        std::fs::write(path, text).expect("a file");
    }
}

impl Coverage {
    /// Judges a text and runs it beside the executor.
    pub fn take(&mut self, text: &Text, run: impl FnOnce(&mut Beside)) {
        self.texts += 1;
        if !text.is_judged.replace(true) {
            match judge(text.main()) {
                Ok(checked) => self.find_dead(text, &checked),
                Err(found) => {
                    text.is_judged.set(false);
                    return self.wrong.push(format!("{}: {}", text.name, listed(&found, text.main())));
                }
            }
        }
        // Beside every second text one of the two dialects that have structures.
        let other = match (self.texts + text.name.len()) % 4 {
            0 => Some(Emitted::of_codesys(&text.files).map_err(|why| format!("in CODESYS: {why}"))),
            1 => Some(Emitted::of_scl(&text.files).map_err(|why| format!("in SCL: {why}"))),
            _ => None,
        };
        let beside = Beside::new(text.system, &Emitted::of(&text.files));
        let beside = match other {
            Some(other) => other.and_then(|other| beside?.and(&other)),
            None => beside,
        };
        match beside {
            Ok(mut beside) => {
                run(&mut beside);
                self.add(text, &beside);
            }
            Err(error) => {
                keep(text);
                self.wrong.push(format!("{}: {error}", text.name));
            }
        }
    }

    /// What nobody reads has to be what a specification declares: its locals and cells, and the ports.
    fn find_dead(&mut self, text: &Text, checked: &Checked) {
        for found in dead(checked) {
            let unit = checked
                .text
                .units
                .iter()
                .find(|u| u.span.start <= found.span.start && found.span.end <= u.span.end);
            let unit = unit.map_or("", |unit| unit.name.text.trim_start_matches("FB_"));
            let automaton = text.system.model.automata.iter().find(|a| camel(&a.name) == unit);
            let variable = found.text.split('`').nth(1).unwrap_or_default();
            if automaton.is_some_and(|automaton| is_local(automaton, variable)) {
                self.unread.insert(format!("{}: {unit}.{variable}", text.family));
            } else {
                self.wrong.push(format!("{}: {}", text.name, listed(&[found], text.main())));
            }
        }
        let ports: BTreeSet<&str> = (text.files["io.csv"].lines())
            .filter_map(|line| line.split(',').nth(1)?.split('[').next())
            .collect();
        for global in unread_globals(checked).into_iter().filter(|global| !ports.contains(global.as_str())) {
            self.unread.insert(format!("{}: {global}", text.family));
        }
    }

    fn add(&mut self, text: &Text, beside: &Beside) {
        self.scans += beside.scans;
        self.words += beside.words;
        self.wrong.extend(beside.difference.iter().map(|difference| format!("{}: {difference}", text.name)));
        for branch in beside.text.machine.branches() {
            let key = (text.family.to_string(), branch.unit, branch.label);
            *self.branches.entry(key).or_default() += branch.entered;
        }
        for (name, count) in beside.text.machine.constructs() {
            *self.constructs.entry(name).or_default() += count;
        }
        self.compare_bounds(text, beside);
    }

    fn compare_bounds(&mut self, text: &Text, beside: &Beside) {
        let bounds = text.bounds();
        let units = beside.text.machine.most_executed().into_iter().filter(|(_, most)| *most > 0);
        for (unit, most) in units.chain([("all", beside.text.most)]) {
            match bounds.get(unit) {
                Some(bound) if most <= *bound => self.nearest = self.nearest.max(most * 100 / bound),
                bound => self.wrong.push(format!("{}: {unit} executes {most}, bound {bound:?}", text.name)),
            }
        }
    }

    pub fn merge(&mut self, other: Coverage) {
        self.texts += other.texts;
        self.scans += other.scans;
        self.words += other.words;
        self.wrong.extend(other.wrong);
        self.unread.extend(other.unread);
        self.only_begun_elsewhere += other.only_begun_elsewhere;
        self.nearest = self.nearest.max(other.nearest);
        other.branches.into_iter().for_each(|(key, count)| *self.branches.entry(key).or_default() += count);
        other
            .constructs
            .into_iter()
            .for_each(|(key, count)| *self.constructs.entry(key).or_default() += count);
    }

    /// How many branches of states there are, and those that no run has entered; the same of the ELSE branches,
    /// which are for numbers that no state has.
    pub fn branches(&self) -> [(usize, Vec<String>); 2] {
        [false, true].map(|is_else| {
            let all: Vec<_> = self.branches.iter().filter(|((_, _, l), _)| (l == ELSE) == is_else).collect();
            let never = all.iter().filter(|(_, count)| **count == 0);
            (all.len(), never.map(|((family, unit, label), _)| format!("{family}: {unit} {label}")).collect())
        })
    }

    /// For each automaton of a text the states whose branches no run has entered.
    fn not_entered(&self, text: &Text) -> Vec<Vec<usize>> {
        let automata = text.system.model.automata.iter();
        let states = automata.map(|automaton| {
            let unit = format!("FB_{}", camel(&automaton.name));
            let count =
                |state: usize| self.branches.get(&(text.family.into(), unit.clone(), state.to_string()));
            (1..automaton.states.len()).filter(|state| count(*state) == Some(&0)).collect()
        });
        states.collect()
    }

    /// Runs variations of a text whose automata begin in the states that no run has entered so far: the transition
    /// of the beginning leads there, and does nothing else. Where a fault of another automaton comes first each
    /// time, the others do not begin at all.
    pub fn enter_the_rest(&mut self, text: &Text, sources: &Sources, run: impl Fn(&mut Beside, &Text)) {
        let mut rest = self.not_entered(text);
        self.only_begun_elsewhere += rest.iter().map(Vec::len).sum::<usize>();
        let vary = |coverage: &mut Self, system: &System| {
            let name = format!("{}, begun elsewhere", text.name);
            let variation = Text::new(&name, text.family, system, sources);
            coverage.take(&variation, |beside| run(beside, &variation));
        };
        while rest.iter().any(|states| !states.is_empty()) {
            let mut system = text.system.clone();
            for (automaton, states) in system.model.automata.iter_mut().zip(&mut rest) {
                if let Some(state) = states.pop() {
                    begin_in(automaton, state);
                }
            }
            vary(self, &system);
        }
        for (alone, states) in self.not_entered(text).into_iter().enumerate() {
            for state in states {
                let mut system = text.system.clone();
                for (number, automaton) in system.model.automata.iter_mut().enumerate() {
                    match number == alone {
                        true => begin_in(automaton, state),
                        false => automaton.states[0].transitions.clear(),
                    }
                }
                vary(self, &system);
            }
        }
    }

    /// All constructs of the grammar that the texts have, and those that no run has executed.
    pub fn constructs(&self) -> (Vec<&str>, Vec<&str>) {
        let never = self.constructs.iter().filter(|(_, count)| **count == 0);
        (self.constructs.keys().map(String::as_str).collect(), never.map(|(name, _)| name.as_str()).collect())
    }
}

/// What gives a command in its beginning alone goes on giving it: the texts of a type that waits for a command rely on one.
fn begin_in(automaton: &mut Automaton, state: usize) {
    let is_command = |update: &Update| matches!(update.kind, UpdateKind::Command { .. });
    let later = automaton.states[1..].iter().flat_map(|state| &state.transitions);
    let commands_later = later.flat_map(|transition| &transition.updates).any(is_command);
    for begin in &mut automaton.states[0].transitions {
        begin.target = Some(StateId(state));
        begin.updates.retain(|update| !commands_later && is_command(update));
    }
}

/// Whether a variable of a block is a local of the specification, perhaps one of the three of a point, or one
/// that could not keep its name.
fn is_local(automaton: &Automaton, variable: &str) -> bool {
    let endings = ["", "_x", "_y", "_z", "_v", "_2"];
    let locals = automaton.locals.iter().map(|local| &local.name);
    locals.flat_map(|name| endings.map(|ending| format!("{name}{ending}"))).any(|name| name == variable)
}
