//! An execution in the simulator: the scenario that brings it about, by what slips, how commands end, and how late
//! devices answer.

use crate::executor::Executor;
use crate::ir::UpdateKind;
use crate::lower::Project;
use autogen_search::event::{Ending, From, What};
use autogen_search::model::Model;
use autogen_search::plant::motion;
use autogen_search::story::Execution;
use runtime_sim::line::{Answer, Line, Slip, Supply};
use runtime_sim::plant::{self, Plant};
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run};
use runtime_sim::scan::{Controllers, SystemInputs};
use runtime_sim::wiring::{Drives, Source};
use std::collections::VecDeque;

/// Seconds of a belt at full speed between two items: no two of them lie in a field at once.
const APART_S: f64 = 8.0;
/// The answer to a command that is replaced comes so long after that, s: never.
const REPLACED_S: f64 = 1.0;
/// Longest simulated time, s.
const LONGEST_S: f64 = 1800.0;
/// Slips are found one after another, each in a run of its own.
const MOST_RUNS: usize = 20;

/// What the simulator made of an execution.
#[derive(Debug)]
pub struct Replay {
    /// With the scenario.
    pub line: Line,
    /// How the run ended.
    pub report: Report,
    /// When all transitions of the execution had fired, s; or what kept them from it.
    pub result: Result<f64, String>,
}

/// What a transition changes that can be seen from outside: the state, and how many commands were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Mark {
    scan: usize,
    state: usize,
    commands: u32,
}

/// What devices are to do, in the order of the execution.
#[derive(Clone, Copy, Debug)]
struct Due {
    scan: usize,
    what: What,
}

struct Director<'a> {
    project: &'a Project,
    line: Line,
    marks: Vec<Vec<Mark>>,
    /// Of each machine those that the simulator does not do by itself: answers and slips.
    due: Vec<VecDeque<Due>>,
}

/// Brings an execution about as far as it can be.
pub fn replay(project: &Project, model: &Model, execution: &Execution) -> Result<Replay, String> {
    let mut director = Director::new(project, model, execution);
    let result = director.direct();
    let line = director.line.clone();
    let mut executor = Executor::new(&project.system);
    let mut follower = Follower::new(&line, executor.stays(), &director.marks);
    let report = run(&line, &mut executor, Stepping::Events, &mut |seen| follower.look(seen))?;
    let result = result.and_then(|seconds| {
        let left = follower.marks.iter().position(|marks| !marks.is_empty());
        match left.filter(|_| report.fault.is_none()) {
            Some(_) if report.simulated_s < seconds => Err("before all these events".into()),
            Some(machine) => {
                let name = &project.system.instances[machine].name;
                Err(format!("with these delays {name} does something else"))
            }
            None => Ok(seconds),
        }
    });
    Ok(Replay { line, report, result })
}

/// Whether a run does what the execution says, machine by machine.
struct Follower {
    marks: Vec<VecDeque<Mark>>,
    /// Where the state of each machine stands in the trace, and its number of the last command among its outputs.
    words: Vec<(usize, Option<usize>)>,
    last: Vec<(usize, u32, f64)>,
}

impl Follower {
    fn new(line: &Line, stays: Vec<usize>, marks: &[Vec<Mark>]) -> Self {
        let kinds = line.kinds.len();
        let words = line.machines.iter().zip(stays);
        Self {
            marks: marks.iter().map(|marks| marks.iter().copied().collect()).collect(),
            words: words
                .map(|(machine, stay)| (stay - 1, machine.wiring.output_at(Drives::Command, kinds)))
                .collect(),
            last: vec![(0, 0, 0.0); marks.len()],
        }
    }

    fn look(&mut self, seen: &Seen) {
        for (machine, (state, cmd)) in self.words.iter().enumerate() {
            let (_, commands, before) = self.last[machine];
            let number = cmd.map_or(0.0, |cmd| seen.outputs[machine][cmd]);
            let now = (seen.trace[*state] as usize, commands + u32::from(number != before), number);
            let is_next = |mark: &&Mark| (mark.state, mark.commands) == (now.0, now.1);
            if self.last[machine] != now && self.marks[machine].front().filter(is_next).is_some() {
                self.marks[machine].pop_front();
            }
            self.last[machine] = now;
        }
    }
}

impl<'a> Director<'a> {
    fn new(project: &'a Project, model: &Model, execution: &Execution) -> Self {
        let instances = project.system.instances.len();
        let mut marks = vec![Vec::new(); instances];
        let mut due = vec![VecDeque::new(); instances];
        let mut commands = vec![0; instances];
        let mut line = project.plant.clone();
        line.scenario.slips.clear();
        line.scenario.refusals.clear();
        line.scenario.answers.clear();
        line.scenario.pauses.clear();
        line.scenario.power_offs.clear();
        line.scenario.sensors.clear();
        line.scenario.jams.clear();
        line.scenario.slow.clear();
        line.scenario.spawn_first_s = APART_S;
        line.scenario.spawn_every_s = APART_S;
        let mut supply: Vec<Vec<usize>> = vec![Vec::new(); instances];
        for (scan, happened) in execution.scans.iter().enumerate() {
            for event in &happened.events {
                let machine = event.machine;
                if let What::Ends(ending) = event.what {
                    let then = command_at(model, machine, &happened.before);
                    let error = match ending {
                        Ending::Well | Ending::WithItem | Ending::WithItemUnseen => None,
                        Ending::InVain => then,
                        Ending::Refused(error) => Some(error),
                    };
                    if error.is_some() {
                        let command = commands[machine];
                        line.scenario.answers.push(Answer { machine, command, late_s: 0.0, error });
                    }
                }
                if matches!(event.what, What::Ends(_) | What::Loses(_)) {
                    due[machine].push_back(Due { scan, what: event.what });
                }
            }
            for (input, value) in &happened.told.read {
                let machine = model.inputs[*input].machine;
                let Some(lane) = &model.machines[machine].lane else { continue };
                let moves = lane.motion.load(&happened.before) != motion::STANDS;
                let kind =
                    lane.zones.iter().find_map(|zone| zone.sees.iter().position(|s| *s == Some(*input)));
                if let Some(kind) = kind.filter(|_| moves && *value == 1) {
                    supply[machine].push(kind);
                }
            }
            for fired in &happened.told.fired {
                let automaton = project.system.automaton_of(fired.instance);
                let transition = &automaton.states[fired.state].transitions[fired.transition];
                let gives = |kind: &UpdateKind| matches!(kind, UpdateKind::Command { .. });
                let given = transition.updates.iter().filter(|update| gives(&update.kind)).count();
                commands[fired.instance] += given as u32;
                let state = transition.target.map_or(fired.state, |target| target.0);
                let mark = Mark { scan, state, commands: commands[fired.instance] };
                let before = marks[fired.instance].last().map_or((0, 0), |m: &Mark| (m.state, m.commands));
                if before != (state, mark.commands) {
                    marks[fired.instance].push(mark);
                }
            }
        }
        let wanted: Vec<usize> = line
            .scenario
            .orders
            .iter()
            .flat_map(|order| order.parts.iter().enumerate())
            .flat_map(|(kind, count)| vec![kind; *count as usize])
            .collect();
        for Supply { belt, items } in &mut line.scenario.supply {
            *items = [supply[*belt].clone(), wanted.repeat(2)].concat();
        }
        Self { project, line, marks, due }
    }

    /// Runs again and again until all slips have their times.
    fn direct(&mut self) -> Result<f64, String> {
        let known = self.line.scenario.answers.clone();
        for _ in 0..MOST_RUNS {
            self.line.scenario.answers.clone_from(&known);
            match self.once(&known)? {
                Some(seconds) => return Ok(seconds),
                None => continue,
            }
        }
        Err(format!("more than {MOST_RUNS} items are lost"))
    }

    /// None if a slip has got its time.
    fn once(&mut self, known: &[Answer]) -> Result<Option<f64>, String> {
        let scan_ms = u64::from(self.line.scan_ms);
        // Answers are held back here; the scenario that is written says how long.
        let mut plant = Plant::new(&self.line)?;
        let mut executor = Executor::new(&self.project.system);
        let mut outputs = plant::outputs(&self.line);
        let mut inputs = plant.images().to_vec();
        let count = inputs.len();
        let kinds = self.line.kinds.len();
        let words: Vec<_> = self.line.machines.iter().map(|machine| Words::new(machine, kinds)).collect();
        let mut marks: Vec<VecDeque<Mark>> = self.marks.iter().map(|m| m.iter().copied().collect()).collect();
        let mut due = self.due.clone();
        let mut seen = vec![(0, 0); count];
        let mut given = vec![0.0; count];
        let mut ended: Vec<Option<u64>> = vec![None; count];
        let mut begun = vec![0_u64; count];
        let mut picks: Vec<(u32, u64)> = vec![(0, 0); count];
        let mut late: Vec<Answer> = known.to_vec();
        for scan in 0..(LONGEST_S * 1000.0) as u64 / scan_ms {
            let frontier = marks.iter().filter_map(|m| m.front()).map(|mark| mark.scan).min();
            let Some(frontier) = frontier else {
                late.retain(|answer| answer.late_s > 0.0 || answer.error.is_some());
                self.line.scenario.answers = late;
                return Ok(Some((scan * scan_ms) as f64 / 1000.0));
            };
            // Nobody is told that a command has ended before all that are under way have: what is to happen in one scan
            // can happen then.
            let has_ended = |machine: usize| {
                let ack = words[machine].head.map_or(0.0, |[_, ack, _]| plant.images()[machine][ack]);
                words[machine].head.is_none() || given[machine] == ack
            };
            let is_awaited = |machine: usize| match due[machine].front().map(|due| due.what) {
                Some(What::Loses(From::Tool | From::BesideTool | From::OnTheWay)) | None => false,
                Some(_) => given[machine] != 0.0,
            };
            let all_ended = (0..count).all(|machine| !is_awaited(machine) || has_ended(machine));
            for machine in 0..count {
                let image = &plant.images()[machine];
                let before = inputs[machine].clone();
                inputs[machine].copy_from_slice(image);
                let at = &words[machine];
                if let Some(holds) = at.holds
                    && image[holds] != 0.0
                    && before[holds] == 0.0
                {
                    picks[machine] = (picks[machine].0 + 1, scan);
                }
                let Some([_, ack, error]) = at.head else { continue };
                let is_new = image[ack] != before[ack];
                if is_new && ended[machine].is_none() {
                    ended[machine] = Some(scan);
                }
                let first = due[machine].front().copied();
                match first.filter(|due| due.scan <= frontier) {
                    Some(Due { what: What::Loses(from), .. }) => {
                        let slips = &self.line.scenario.slips;
                        let (pick, since) = picks[machine];
                        if slips.iter().any(|slip| (slip.machine, slip.pick) == (machine, pick)) {
                            if at.holds.is_some_and(|holds| image[holds] == 0.0) {
                                due[machine].pop_front();
                            }
                        } else if self.is_there(from, ended[machine].is_some(), scan, begun[machine]) {
                            let after_s = ((scan + 1 - since) * scan_ms) as f64 / 1000.0;
                            self.line.scenario.slips.push(Slip { machine, pick, after_s });
                            return Ok(None);
                        }
                    }
                    Some(Due { what: What::Ends(_), .. }) if is_new && all_ended => {
                        due[machine].pop_front();
                        let late_s = ((scan - ended[machine].unwrap_or(scan)) * scan_ms) as f64 / 1000.0;
                        let command = seen[machine].1;
                        match late.iter_mut().find(|a| (a.machine, a.command) == (machine, command)) {
                            Some(answer) => answer.late_s = late_s,
                            None => late.push(Answer { machine, command, late_s, error: None }),
                        }
                        ended[machine] = None;
                        continue;
                    }
                    _ => {}
                }
                inputs[machine][ack] = before[ack];
                inputs[machine][error] = before[error];
            }
            let system =
                SystemInputs { run_permit: true, start: scan >= self.line.scenario.start_scan, reset: false };
            let answer = executor.scan(system, &inputs, &mut outputs);
            for machine in 0..count {
                if let Some([cmd, ..]) = words[machine].head
                    && outputs[machine][cmd] != given[machine]
                {
                    given[machine] = outputs[machine][cmd];
                    // A command that is replaced before its answer comes.
                    if let Some(end) = ended[machine] {
                        let late_s = ((scan - end) * scan_ms) as f64 / 1000.0 + REPLACED_S;
                        let command = seen[machine].1;
                        late.push(Answer { machine, command, late_s, error: None });
                    }
                    seen[machine].1 += 1;
                    begun[machine] = scan;
                    ended[machine] = None;
                }
                let now = (executor.state(machine), seen[machine].1);
                if now == seen[machine] && marks[machine].front().is_none_or(|m| (m.state, m.commands) != now)
                {
                    continue;
                }
                seen[machine].0 = now.0;
                match marks[machine].front() {
                    Some(mark) if (mark.state, mark.commands) == now => {
                        marks[machine].pop_front();
                    }
                    Some(_) => {
                        let name = &self.project.system.instances[machine].name;
                        let at = (scan * scan_ms) as f64 / 1000.0;
                        return Err(format!("{name} does something else at {at:.2} s"));
                    }
                    // It has done all that it does in the execution.
                    None => {}
                }
            }
            if answer.fault {
                late.retain(|answer| answer.late_s > 0.0 || answer.error.is_some());
                self.line.scenario.answers = late;
                return Ok(Some((scan * scan_ms) as f64 / 1000.0));
            }
            plant.advance(&outputs);
        }
        let waits = (0..count).filter(|machine| !marks[*machine].is_empty());
        let waits: Vec<&str> = waits.map(|m| self.project.system.instances[m].name.as_str()).collect();
        let verb = if waits.len() == 1 { "waits" } else { "wait" };
        Err(format!("{} {verb} for something that does not come", waits.join(", ")))
    }

    /// Whether an arm is where it is to lose its item.
    fn is_there(&self, from: From, has_ended: bool, scan: u64, begun: u64) -> bool {
        match from {
            From::Tool => true,
            From::Goal | From::Via => has_ended,
            From::BesideTool => (scan - begun) * u64::from(self.line.scan_ms) >= 200,
            From::BesideGoal => has_ended,
            From::OnTheWay => (scan - begun) * u64::from(self.line.scan_ms) >= 400,
        }
    }
}

/// The error in which the command under way ends if what it awaits does not come.
fn command_at(model: &Model, machine: usize, state: &[u8]) -> Option<i32> {
    let head = model.machines[machine].head.as_ref()?;
    let asked = head.commands.get(head.command.load(state) as usize)?;
    asked.awaits.map(|awaits| awaits.error)
}

/// Where words of a machine stand in its images.
struct Words {
    /// `cmd` among the outputs, `ack` and `error` among the inputs.
    head: Option<[usize; 3]>,
    /// Whether an item hangs on the gripper.
    holds: Option<usize>,
}

impl Words {
    fn new(machine: &runtime_sim::machine::Machine, kinds: usize) -> Self {
        let wiring = &machine.wiring;
        let head = || {
            Some([
                wiring.output_at(Drives::Command, kinds)?,
                wiring.input_at(Source::Ack, kinds)?,
                wiring.input_at(Source::Error, kinds)?,
            ])
        };
        let holds = wiring.inputs.iter().find_map(|input| match input.source {
            Source::Signal { part, signal }
                if machine.parts[part].schema().name == "grip"
                    && machine.parts[part].schema().signals[signal].name == "holds" =>
            {
                wiring.input_at(input.source, kinds)
            }
            _ => None,
        });
        Self { head: head(), holds }
    }
}
