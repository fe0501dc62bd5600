//! What the simulator needs of a system.

use super::role::Line;
use crate::diagnostic::Diagnostic;
use crate::executor::Executor;
use crate::ir::{Automaton, Element, InterfaceId, PropertyKind, RoleKind, System, Value};
use crate::reads::{self, ReadCell, Reads, Whose};
use crate::scenario::{self, Input, MachinePart, Number, Panel, ResolvedScenario, Scenario};
use runtime_sim::line;
use runtime_sim::machine::Machine;
use runtime_sim::monitor::{ALARM_WORDS, Alarm, Counter, Monitor};
use std::collections::BTreeSet;

pub fn resolve(scenario: &Scenario, line: &Line) -> Result<ResolvedScenario, Vec<Diagnostic>> {
    let named = |wanted: &dyn Fn(usize) -> bool| -> Vec<(&str, usize)> {
        (0..line.robots.len())
            .filter(|r| wanted(*r))
            .map(|r| (line.robots[r].object.name.value.as_str(), r))
            .collect()
    };
    let has = |r: usize, primitive: &str| line.automaton(r).device.has(primitive);
    let panels: Vec<Panel> = (0..line.robots.len())
        .flat_map(|r| {
            let robot = line.robots[r].object.name.value.as_str();
            let parts = line.automaton(r).device.operated();
            parts.map(move |(number, part, operated)| Panel { robot, part, numbers: [r, number], operated })
        })
        .collect();
    let kinds = scenario.kinds.len();
    let inputs: Vec<Input> = (0..line.robots.len())
        .flat_map(|r| {
            let robot = line.robots[r].object.name.value.as_str();
            line.automaton(r).device.inputs(kinds).map(move |(word, port)| Input {
                robot,
                signal: &port.name,
                ty: port.ty,
                extent: port.extent,
                machine: r,
                word,
            })
        })
        .collect();
    let parts: Vec<MachinePart> = (0..line.robots.len())
        .flat_map(|r| {
            let robot = line.robots[r].object.name.value.as_str();
            let parts = line.automaton(r).device.parts();
            parts.map(move |(number, part, primitive)| MachinePart {
                robot,
                part,
                primitive,
                numbers: [r, number],
            })
        })
        .collect();
    let sinks: Vec<(String, [usize; 2])> = (0..line.robots.len())
        .flat_map(|r| {
            let robot = line.robots[r].object.name.value.as_str();
            let parts = line.automaton(r).device.parts_called("sink");
            parts.map(move |(number, part)| (format!("{robot}.{part}"), [r, number]))
        })
        .collect();
    scenario::resolve(
        scenario,
        &scenario::Line {
            stations: &named(&|r| has(r, "orders")),
            belts: &named(&|r| has(r, "source")),
            arms: &named(&|r| has(r, "grip")),
            commanded: &named(&|r| line.automaton(r).device.is_commanded()),
            panels: &panels,
            inputs: &inputs,
            parts: &parts,
            sinks: &sinks,
        },
    )
}

pub fn line(
    system: &System,
    line: &Line,
    obstacles: Vec<line::Obstacle>,
    scenario: ResolvedScenario,
    scan_ms: u32,
    machines: Vec<Machine>,
) -> line::Line {
    let asks_nothing = scenario.number == Number::None && scenario.goal.is_empty();
    let scans = |seconds: f64| (seconds * 1000.0 / f64::from(scan_ms)).round() as u64;
    let pause = |p: &scenario::Pause| line::Pause { at_scan: scans(p.at_s), scans: scans(p.for_s) };
    let during = |at_s: f64, for_s: Option<f64>| line::During {
        at_scan: scans(at_s),
        scans: for_s.map(|for_s| scans(for_s).max(1)),
    };
    let arms = arms(system);
    let mut executor = Executor::new(system);
    let traces = system.traces();
    let reads: Vec<Vec<StateReads>> = system.model.automata.iter().map(state_reads).collect();
    line::Line {
        scan_ms,
        kinds: scenario
            .kinds
            .iter()
            .map(|kind| line::Kind {
                name: kind.name.value.clone(),
                height: kind.height,
                grasp: kind.grasp,
                size: kind.size,
                mass: kind.mass,
                is: kind.is.iter().map(|word| word.value.clone()).collect(),
            })
            .collect(),
        machines: machines
            .into_iter()
            .enumerate()
            .map(|(i, machine)| Machine {
                states: states(system, &arms, &reads, &mut executor, i),
                monitor: monitor(system, &traces, &mut executor, i),
                ..machine
            })
            .collect(),
        obstacles,
        may_touch: line.layout.may_touch.iter().map(|m| m.pair.each_ref().map(|n| n.value.clone())).collect(),
        scenario: line::Scenario {
            goal: match scenario.number {
                _ if !scenario.goal.is_empty() => {
                    line::Goal::Collected(scenario.goal.into_iter().map(collected).collect())
                }
                Number::Listed => line::Goal::AllOrders,
                Number::WithoutEnd | Number::None => line::Goal::TimeLimit,
            },
            orders: scenario
                .orders
                .into_iter()
                .map(|(stations, parts)| line::Order { stations, parts })
                .collect(),
            supply: scenario.supply.into_iter().map(|(belt, items)| line::Supply { belt, items }).collect(),
            spawn_first_s: scenario.spawn_first_s,
            spawn_every_s: scenario.spawn_every_s,
            time_limit_s: scenario.time_limit_s,
            seed: u64::from(scenario.seed),
            // A line of which nothing is asked may wait as long as it likes.
            stall_limit_s: if asks_nothing {
                scenario.time_limit_s
            } else {
                line::Scenario::default().stall_limit_s
            },
            slips: (scenario.slips.iter())
                .map(|s| line::Slip { machine: s.robot, pick: s.pick, after_s: s.after_s })
                .collect(),
            refusals: (scenario.refusals.iter())
                .map(|r| line::Refusal { machine: r.robot, command: r.command })
                .collect(),
            answers: (scenario.answers.iter())
                .map(|a| line::Answer {
                    machine: a.robot,
                    command: a.command,
                    late_s: a.late_s,
                    error: a.error,
                })
                .collect(),
            pauses: scenario.pauses.iter().map(pause).collect(),
            power_offs: scenario.power_offs.iter().map(pause).collect(),
            sensors: (scenario.sensors.iter())
                .map(|stuck| line::Stuck {
                    machine: stuck.input.robot,
                    word: stuck.input.first,
                    words: stuck.input.count,
                    value: stuck.reads,
                    during: during(stuck.at_s, stuck.for_s),
                })
                .collect(),
            jams: (scenario.jams.iter())
                .map(|jam| line::Jam {
                    machine: jam.part[0],
                    part: jam.part[1],
                    during: during(jam.at_s, jam.for_s),
                })
                .collect(),
            slow: (scenario.slow.iter())
                .map(|slow| line::SlowCycle {
                    machine: slow.part[0],
                    part: slow.part[1],
                    cycle: slow.cycle,
                    longer_s: slow.longer_s,
                })
                .collect(),
            operations: (scenario.operations.iter())
                .map(|o| line::Operation {
                    machine: o.part[0],
                    part: o.part[1],
                    at_s: o.at_s,
                    for_s: o.for_s,
                    value: o.value,
                })
                .collect(),
            presses: (scenario.presses.iter())
                .map(|press| line::Press { button: press.part, during: during(press.at_s, press.for_s) })
                .collect(),
            ..line::Scenario::default()
        },
        io_delay: line::IoDelay::Fixed(0),
    }
}

fn collected(scenario::Collected { sink, items }: scenario::Collected<[usize; 2]>) -> line::Collected {
    line::Collected { machine: sink[0], part: sink[1], items }
}

/// The arms that take from or hand to an instance, with the interface for which they come.
type Arms = Vec<(InterfaceId, usize)>;

fn arms(system: &System) -> Vec<Arms> {
    let mut arms = vec![Arms::new(); system.instances.len()];
    for (arm, instance) in system.instances.iter().enumerate() {
        for (role, rows) in system.automaton_of(arm).roles.iter().zip(&instance.roles) {
            if matches!(role.kind, RoleKind::Takes | RoleKind::Hands) {
                let members = &system.members[role.interface.0];
                rows.iter().for_each(|row| arms[members[*row]].push((role.interface, arm)));
            }
        }
    }
    arms
}

/// What the guards of a state read, and what the state as a whole does.
struct StateReads<'a> {
    guards: Reads<'a>,
    all: Reads<'a>,
}

fn state_reads(automaton: &Automaton) -> Vec<StateReads<'_>> {
    let states = automaton.states.iter();
    let reads = states.map(|state| StateReads {
        guards: Reads::of_guards(automaton, state),
        all: Reads::of_state(automaton, state),
    });
    reads.collect()
}

/// What the simulator needs of the states of an instance.
fn states(
    system: &System,
    arms: &[Arms],
    reads: &[Vec<StateReads>],
    executor: &mut Executor,
    instance: usize,
) -> Vec<line::State> {
    let automaton = system.automaton_of(instance);
    let mut states = Vec::new();
    let reads = &reads[system.instances[instance].automaton.0];
    for (state, StateReads { guards, all }) in automaton.states.iter().zip(reads) {
        let is_fixed = all.timers.iter().all(|time| reads::is_fixed(automaton, time));
        let times = all.timers.iter().map(|time| match executor.value(instance, time) {
            Value::Int(ms) => ms.max(0) as u32,
            other => unreachable!("a checked time is {other:?}"),
        });
        states.push(line::State {
            name: state.name.clone(),
            working: !guards.timers.is_empty() || !guards.inputs.is_empty(),
            awaits: owners(system, arms, instance, guards).into_iter().collect(),
            reads: all.words(system.kinds()),
            reads_while: all.words_while(system.kinds()),
            timers: is_fixed.then(|| times.collect()),
        });
    }
    states
}

/// Where the trace has what the properties of an instance keep; `traces` is where that of each instance begins.
fn monitor(system: &System, traces: &[usize], executor: &mut Executor, instance: usize) -> Monitor {
    let automaton = system.automaton_of(instance);
    let values = system.values_of(instance, traces[instance]);
    let word = |local: usize| {
        let is_it = |element| element == Element::Local { robot: instance, local, index: 0 };
        values.iter().find(|value| is_it(value.element)).and_then(|value| value.trace)
    };
    let counters = automaton.properties.iter().filter_map(|property| {
        let PropertyKind::Whenever { within, waited, .. } = &property.kind else { return None };
        let limit = match executor.value(instance, within) {
            Value::Int(ms) if reads::is_fixed(automaton, within) => Some(ms.max(0) as u32),
            _ => None,
        };
        Some(Counter { word: word(*waited)?, limit })
    });
    let counters = counters.collect();
    let begin = traces[instance + 1] - automaton.alarm_words();
    let first = begin + usize::from(automaton.can_stop());
    let alarms = automaton.alarms().enumerate();
    Monitor {
        stopped: automaton.can_stop().then_some(begin),
        counters,
        alarms: alarms
            .map(|(number, property)| Alarm {
                code: property.site.0 as i32 + 1,
                word: first + number * ALARM_WORDS,
            })
            .collect(),
        panel: words(&Reads::of_modes(automaton), system.kinds()),
    }
}

/// Words of the inputs that are read under any condition.
fn words(reads: &Reads, kinds: usize) -> Vec<usize> {
    let behind = reads.words_while(kinds).into_iter().map(|read| read.word);
    let all: BTreeSet<usize> = reads.words(kinds).into_iter().chain(behind).collect();
    all.into_iter().collect()
}

/// Who writes the cells that guards read, but for the instance itself.
fn owners(system: &System, arms: &[Arms], instance: usize, guards: &Reads) -> BTreeSet<usize> {
    let mut owners = BTreeSet::new();
    for ReadCell { interface, of, .. } in &guards.cells {
        match of {
            // A cell of its own is awaited from the arms that come here: they write it too.
            Whose::Own => {
                let come_here = arms[instance].iter().filter(|(i, _)| i == interface);
                owners.extend(come_here.map(|(_, arm)| *arm));
            }
            Whose::Others => {
                let roles = &system.automaton_of(instance).roles;
                let rows = roles
                    .iter()
                    .zip(&system.instances[instance].roles)
                    .filter(|(role, _)| role.interface == *interface && role.kind != RoleKind::Knows)
                    .flat_map(|(_, rows)| rows);
                owners.extend(rows.map(|row| system.members[interface.0][*row]));
            }
        }
    }
    owners.remove(&instance);
    owners
}
