//! What the simulator needs of a system.

use super::awaited::{self, Partners};
use super::role::Line;
use crate::device::panel;
use crate::diagnostic::Diagnostic;
use crate::executor::Executor;
use crate::ir::{Automaton, Expr, PropertyKind, State, System, Type, Value};
use crate::reads::{self, Reads};
use crate::scenario::{self, Input, MachinePart, Number, Panel, ResolvedScenario, Scenario};
use runtime_sim::line;
use runtime_sim::machine::Machine;
use runtime_sim::monitor::{ALARM_WORDS, Alarm, Counter, Monitor};
use std::collections::BTreeSet;
use std::ops::Range;

pub fn resolve(
    scenario: &Scenario,
    line: &Line,
    machines: &[Machine],
) -> Result<ResolvedScenario, Vec<Diagnostic>> {
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
            let device = &line.automaton(r).device;
            device.operated().map(move |(number, part, operated)| Panel {
                robot,
                part,
                numbers: [r, number],
                operated,
                ty: device.type_of_operated(number),
                commands: (part == panel::VERB).then_some(&device.verbs[..]),
            })
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
    let processes = machines.iter().flat_map(Machine::processes);
    let made: Vec<&str> = processes.flat_map(|(_, process)| process.made()).map(|[_, to]| to).collect();
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
            made: &made,
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
    let pause = |p: &scenario::Pause| line::Pause { at_scan: scans(p.at_s), scans: scans(p.for_s).max(1) };
    let during = |at_s: f64, for_s: Option<f64>| line::During {
        at_scan: scans(at_s),
        scans: for_s.map(|for_s| scans(for_s).max(1)),
    };
    let partners = awaited::partners(system);
    // What it is asked is fixed by the layout.
    let mut executor = Executor::without_values(system);
    let traces = system.traces();
    let types: Vec<OfType> =
        system.model.automata.iter().map(|automaton| of_type(system, automaton)).collect();
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
                deck: kind.deck,
                is: kind.is.iter().map(|word| word.value.clone()).collect(),
            })
            .collect(),
        machines: machines
            .into_iter()
            .enumerate()
            .map(|(i, machine)| {
                let of_type = &types[system.instances[i].automaton.0];
                Machine {
                    states: states(system, &partners, of_type, &mut executor, i),
                    monitor: monitor(of_type, &traces, &mut executor, i),
                    ..machine
                }
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
            removals: (scenario.removals.iter())
                .map(|removal| line::Removal {
                    kind: removal.kind,
                    number: removal.number,
                    at_scan: during(removal.at_s, None).at_scan,
                })
                .collect(),
            ..line::Scenario::default()
        },
        io_delay: line::IoDelay::Fixed(0),
    }
}

fn collected(scenario::Collected { sink, items }: scenario::Collected<[usize; 2]>) -> line::Collected {
    line::Collected { machine: sink[0], part: sink[1], items }
}

/// What the simulator needs of all instances of a type.
struct OfType<'a> {
    automaton: &'a Automaton,
    states: Vec<OfState<'a>>,
    /// Words of its cells, counted from the beginning of the trace.
    cells: Range<usize>,
    /// For each property of a time the word of its local, counted from the beginning of the trace, and the time if the
    /// layout fixes it.
    counters: Vec<(usize, Option<&'a Expr>)>,
    panel: Vec<usize>,
}

/// What it needs of a state.
struct OfState<'a> {
    guards: Reads<'a>,
    /// All times, if the layout fixes them.
    timers: Option<Vec<&'a Expr>>,
    reads: Vec<usize>,
    reads_while: Vec<line::ReadWhile>,
    awaits_answer: bool,
}

fn of_type<'a>(system: &System, automaton: &'a Automaton) -> OfType<'a> {
    let is_fixed = |time: &Expr| reads::is_fixed(automaton, time);
    let states = automaton.states.iter().map(|state| {
        let all = Reads::of_state(automaton, state);
        OfState {
            guards: Reads::of_guards(automaton, state),
            reads: all.words(system.kinds()),
            reads_while: all.words_while(system.kinds()),
            timers: all.timers.iter().all(|time| is_fixed(time)).then(|| all.timers.to_vec()),
            awaits_answer: awaited::awaits_answer(automaton, state),
        }
    });
    let word = |local: usize| 2 + words_of(system, automaton.locals[..local].iter().map(|local| local.ty));
    let counters = automaton.properties.iter().filter_map(|property| {
        let PropertyKind::Whenever { within, waited, .. } = &property.kind else { return None };
        Some((word(*waited), Some(within).filter(|within| is_fixed(within))))
    });
    let cells = automaton.implements.iter().flat_map(|it| &system.model.interface(it.interface).cells);
    let begin = word(automaton.locals.len());
    let end = begin + words_of(system, cells.map(|cell| cell.ty));
    OfType {
        automaton,
        states: states.collect(),
        cells: begin..end,
        counters: counters.collect(),
        panel: words(&Reads::of_modes(automaton), system.kinds()),
    }
}

fn words_of(system: &System, types: impl Iterator<Item = Type>) -> usize {
    types.map(|ty| ty.scalar.words() * system.model.elements(ty.extent)).sum()
}

/// What the simulator needs of the states of an instance.
fn states(
    system: &System,
    partners: &[Partners],
    of_type: &OfType,
    executor: &mut Executor,
    instance: usize,
) -> Vec<line::State> {
    let states = of_type.automaton.states.iter().zip(&of_type.states);
    let mut time = |time: &&Expr| {
        executor.can_evaluate(instance, time).then(|| match executor.value(instance, time) {
            Value::Int(ms) => ms.max(0) as u32,
            other => unreachable!("a checked time is {other:?}"),
        })
    };
    let state = |(state, of_state): (&State, &OfState)| {
        let awaits = awaited::others(system, partners, instance, &of_state.guards);
        line::State {
            name: state.name.clone(),
            working: awaited::awaits_itself(of_type.automaton, &of_state.guards, &awaits),
            awaits: awaits.into_iter().collect(),
            reads: of_state.reads.clone(),
            reads_while: of_state.reads_while.clone(),
            timers: of_state.timers.as_ref().map(|times| times.iter().filter_map(&mut time).collect()),
            awaits_answer: of_state.awaits_answer,
        }
    };
    states.map(state).collect()
}

/// Where the trace has what the properties of an instance keep; `traces` is where that of each instance begins.
fn monitor(of_type: &OfType, traces: &[usize], executor: &mut Executor, instance: usize) -> Monitor {
    let automaton = of_type.automaton;
    let counters = of_type.counters.iter().map(|(word, within)| {
        let limit = within.and_then(|within| match executor.value(instance, within) {
            Value::Int(ms) => Some(ms.max(0) as u32),
            _ => None,
        });
        Counter { word: traces[instance] + word, limit }
    });
    let counters = counters.collect();
    let begin = traces[instance + 1] - automaton.alarm_words();
    let first = begin + usize::from(automaton.can_stop());
    let alarms = automaton.alarms().enumerate();
    let cells = [of_type.cells.start, of_type.cells.end].map(|word| traces[instance] + word);
    Monitor {
        stopped: automaton.can_stop().then_some(begin),
        cells: cells[0]..cells[1],
        counters,
        alarms: alarms
            .map(|(number, property)| Alarm {
                code: property.site.0 as i32 + 1,
                word: first + number * ALARM_WORDS,
            })
            .collect(),
        panel: of_type.panel.clone(),
    }
}

/// Words of the inputs that are read under any condition.
fn words(reads: &Reads, kinds: usize) -> Vec<usize> {
    let behind = reads.words_while(kinds).into_iter().map(|read| read.word);
    let all: BTreeSet<usize> = reads.words(kinds).into_iter().chain(behind).collect();
    all.into_iter().collect()
}
