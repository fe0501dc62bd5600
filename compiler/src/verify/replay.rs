//! An execution in the simulator: the scenario that brings it about, by what slips, how commands end, and how late
//! devices answer.

mod late;

use super::followed::{Followed, Mark};
use crate::ir::UpdateKind;
use crate::lower::Project;
use autogen_search::Fired;
use autogen_search::event::{Ending, From, What};
use autogen_search::model::Model;
use autogen_search::plant::motion;
use autogen_search::story::Execution;
use late::Late;
use runtime_sim::line::{Answer, Goal, Line, Slip, Supply};
use runtime_sim::plant::{self, Plant};
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run};
use runtime_sim::scan::{Controllers, SystemInputs};
use runtime_sim::wiring::{Drives, Source};
use std::collections::VecDeque;

/// Seconds of a belt at full speed between two items: no two of them lie in a field at once.
const APART_S: f64 = 8.0;
/// The answer to a command that is replaced comes so long after that, s: never.
const REPLACED_S: f64 = 1.0;
/// What nobody has answered when all has happened is answered so much later, s: what is wrong shows before.
const AFTER_ALL_S: f64 = 30.0;
/// What devices are to do behind the last transition is waited for so long, s.
const LAST_EVENTS_S: f64 = 120.0;
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
    let mut followed = Followed::new(&project.system, &director.marks);
    let report = run(&line, &mut followed, Stepping::Events, &mut |_| {})?;
    let result = result.and_then(|seconds| match followed.astray().or(followed.unfinished().next()) {
        Some(_) if report.simulated_s < seconds => Err("the run is over before all these events".into()),
        Some(machine) => {
            let name = &project.system.instances[machine].name;
            Err(format!("with these delays {name} does something else"))
        }
        None => Ok(seconds),
    });
    Ok(Replay { line, report, result })
}

impl<'a> Director<'a> {
    fn new(project: &'a Project, model: &Model, execution: &Execution) -> Self {
        let instances = project.system.instances.len();
        let mut marks = vec![Vec::new(); instances];
        let mut due = vec![VecDeque::new(); instances];
        let mut commands = vec![0; instances];
        let mut line = project.plant.clone();
        list_orders(&mut line);
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
                let Fired { state, transition, .. } = *fired;
                marks[fired.instance].push(Mark { scan, state, transition });
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
            let more = match line.scenario.goal {
                Goal::Collected(_) => std::mem::take(items),
                Goal::AllOrders | Goal::TimeLimit => wanted.repeat(2),
            };
            *items = [supply[*belt].clone(), more].concat();
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
        let mut followed = Followed::new(&self.project.system, &self.marks);
        let mut outputs = plant::outputs(&self.line);
        let mut inputs = plant.images().to_vec();
        let count = inputs.len();
        let kinds = self.line.kinds.len();
        let words: Vec<_> = self.line.machines.iter().map(|machine| Words::new(machine, kinds)).collect();
        let mut due = self.due.clone();
        let mut commands = vec![0; count];
        let mut given = vec![0.0; count];
        let mut ended: Vec<Option<u64>> = vec![None; count];
        let mut begun = vec![0_u64; count];
        let mut picks: Vec<(u32, u64)> = vec![(0, 0); count];
        let mut late = Late::new(known, scan_ms);
        let mut fired_at: Option<u64> = None;
        for scan in 0..(LONGEST_S * 1000.0) as u64 / scan_ms {
            let now_s = (scan * scan_ms) as f64 / 1000.0;
            let frontier = followed.frontier().unwrap_or_else(|| {
                fired_at.get_or_insert(scan);
                usize::MAX
            });
            if let Some(at) = fired_at {
                let waited_s = ((scan - at) * scan_ms) as f64 / 1000.0;
                if due.iter().all(VecDeque::is_empty) || waited_s >= LAST_EVENTS_S {
                    self.keep(late, &commands, &ended, scan);
                    return Ok(Some((at * scan_ms) as f64 / 1000.0));
                }
            }
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
                        } else if let Some(at) = self.slips_at(from, ended[machine], scan, begun[machine]) {
                            let after_s = ((at + 1).saturating_sub(since).max(1) * scan_ms) as f64 / 1000.0;
                            self.line.scenario.slips.push(Slip { machine, pick, after_s });
                            return Ok(None);
                        }
                    }
                    Some(Due { what: What::Ends(_), .. }) if is_new && all_ended => {
                        due[machine].pop_front();
                        let scans = scan - ended[machine].take().unwrap_or(scan);
                        late.put_off(machine, commands[machine], scans, 0.0);
                        continue;
                    }
                    _ => {}
                }
                inputs[machine][ack] = before[ack];
                inputs[machine][error] = before[error];
            }
            let system =
                SystemInputs { run_permit: true, start: scan >= self.line.scenario.start_scan, reset: false };
            let answer = followed.scan(system, &inputs, &mut outputs);
            for machine in 0..count {
                if let Some([cmd, ..]) = words[machine].head
                    && outputs[machine][cmd] != given[machine]
                {
                    given[machine] = outputs[machine][cmd];
                    // A command that is replaced before its answer comes.
                    if let Some(end) = ended[machine].take() {
                        late.put_off(machine, commands[machine], scan - end, REPLACED_S);
                    }
                    commands[machine] += 1;
                    begun[machine] = scan;
                }
            }
            if let Some(machine) = followed.astray() {
                let name = &self.project.system.instances[machine].name;
                return Err(format!("{name} does something else at {now_s:.2} s"));
            }
            if answer.fault {
                self.keep(late, &commands, &ended, scan);
                return match followed.frontier() {
                    None => Ok(Some(fired_at.map_or(now_s, |at| (at * scan_ms) as f64 / 1000.0))),
                    Some(_) => Err(format!(
                        "the line stops at {now_s:.2} s, before all these transitions have fired"
                    )),
                };
            }
            plant.advance(&outputs);
        }
        let waits: Vec<&str> =
            followed.unfinished().map(|m| self.project.system.instances[m].name.as_str()).collect();
        let verb = if waits.len() == 1 { "waits" } else { "wait" };
        Err(format!("{} {verb} for something that does not come", waits.join(", ")))
    }

    /// Of each machine how many commands it was given, and since when the answer to the last one is held back.
    fn keep(&mut self, mut late: Late, commands: &[u32], ended: &[Option<u64>], scan: u64) {
        for (machine, end) in ended.iter().enumerate() {
            if let Some(end) = end {
                late.put_off(machine, commands[machine], scan - end, AFTER_ALL_S);
            }
        }
        self.line.scenario.answers = late.answers();
    }

    /// In which scan an arm is where it is to lose its item, if that is known; its motion has begun and ended in these.
    fn slips_at(&self, from: From, ended: Option<u64>, scan: u64, begun: u64) -> Option<u64> {
        match from {
            From::Tool => Some(scan),
            From::Goal | From::Via | From::BesideGoal => ended.map(|_| scan),
            From::BesideTool => ((scan - begun) * u64::from(self.line.scan_ms) >= 200).then_some(scan),
            // Far from both ends of its motion.
            From::OnTheWay => ended.map(|end| begun + (end - begun) / 2),
        }
    }
}

/// Orders without end become a list: a scenario has no such orders beside a list of what belts bring. There are as many as
/// could be made while an execution is followed.
fn list_orders(line: &mut Line) {
    let Some(order) = line.scenario.orders.first().filter(|_| line.scenario.goal == Goal::TimeLimit) else {
        return;
    };
    let of_order: u32 = order.parts.iter().sum();
    let parts = LONGEST_S / APART_S * line.scenario.supply.len() as f64;
    let stations = line.machines.iter().filter(|machine| machine.has("orders")).count();
    line.scenario.orders.truncate((parts / f64::from(of_order)).ceil() as usize + stations);
    line.scenario.goal = Goal::AllOrders;
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
