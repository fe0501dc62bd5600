//! The text form of a line: words between white space, an entry on each line.

mod faults;

use std::fmt::Write;
use std::sync::Arc;

use super::{
    Collected, Deck, During, Goal, IoDelay, Kind, Line, LineButton, Obstacle, Operation, Order, Press,
    ReadWhile, Removal, Scenario, State, Supply,
};
use crate::machine::Machine;
use crate::monitor::{Alarm, Counter, Monitor};
use crate::part::Part;
use crate::point::Point;
use crate::wiring::Wiring;
use crate::words::Words;

impl Line {
    /// The text that [`Line::from_text`] reads back to the same bits.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        let mut put = |entry: String| {
            out.push_str(entry.trim_end());
            out.push('\n');
        };
        put("line 13".into());
        put(format!("scan_ms {}", self.scan_ms));
        put(match self.io_delay {
            IoDelay::Fixed(scans) => format!("io_delay fixed {scans}"),
            IoDelay::Random { max, seed } => format!("io_delay random {max} {seed}"),
        });
        put(format!("kinds {}", self.kinds.len()));
        for kind in &self.kinds {
            let [x, y] = kind.size;
            let is = list(&kind.is);
            let [height, grasp] = [kind.height, kind.grasp];
            let mass = kind.mass;
            let deck = kind.deck.map(|Deck { height, size: [x, y] }| format!("{height:?} {x:?} {y:?}"));
            let deck = list(deck.as_slice());
            put(format!("  {} {height:?} {grasp:?} {x:?} {y:?} {is} {mass:?} {deck}", kind.name));
        }
        let mut devices: Vec<&Wiring> = Vec::new();
        for machine in &self.machines {
            if !devices.contains(&machine.wiring.as_ref()) {
                devices.push(&machine.wiring);
            }
        }
        put(format!("devices {}", devices.len()));
        for wiring in &devices {
            let mut text = String::new();
            wiring.write(&mut text);
            put(text);
        }
        put(format!("machines {}", self.machines.len()));
        for machine in &self.machines {
            let device = devices.iter().position(|wiring| **wiring == *machine.wiring).unwrap_or(0);
            put(format!("  {} {device} {}", machine.name, point_text(machine.pose)));
            put(format!("    parts {}", machine.parts.len()));
            for part in &machine.parts {
                let mut text = String::new();
                part.write(&mut text);
                put(format!("      {text}"));
            }
            put(format!("    states {}", machine.states.len()));
            for state in &machine.states {
                let activity = if state.working { "working" } else { "waiting" };
                let timers = any_or_list(state.timers.as_deref());
                let guards = if state.awaits_answer { "answered" } else { "open" };
                put(format!(
                    "      {} {activity} {} reads {} while {} timers {timers} {guards}",
                    state.name,
                    list(&state.awaits),
                    list(&state.reads),
                    reads_while(&state.reads_while)
                ));
            }
            let Monitor { stopped, cells, counters, alarms, panel } = &machine.monitor;
            let stopped = stopped.map_or("never".into(), |word| format!("at {word}"));
            put(format!("    stopped {stopped}"));
            put(format!("    cells {} {}", cells.start, cells.end));
            put(format!("    counters {}", counters.len()));
            for Counter { word, limit } in counters {
                let limit = limit.map_or("any".into(), |limit| format!("at {limit}"));
                put(format!("      {word} {limit}"));
            }
            put(format!("    alarms {}", alarms.len()));
            for Alarm { code, word } in alarms {
                put(format!("      {code} {word}"));
            }
            put(format!("    panel {}", list(panel)));
            put(format!("    visits {}", any_or_list(machine.visits.as_deref())));
        }
        put(format!("obstacles {}", self.obstacles.len()));
        for obstacle in &self.obstacles {
            let size = obstacle.size.map_or("none".into(), |size| format!("box {}", point_text(size)));
            put(format!("  {} {} {size}", obstacle.name, point_text(obstacle.pose)));
        }
        put(format!("may_touch {}", self.may_touch.len()));
        for [a, b] in &self.may_touch {
            put(format!("  {a} {b}"));
        }
        let scenario = &self.scenario;
        put(format!("spawn_first_s {:?}", scenario.spawn_first_s));
        put(format!("spawn_every_s {:?}", scenario.spawn_every_s));
        put(format!("time_limit_s {:?}", scenario.time_limit_s));
        put(format!("stall_limit_s {:?}", scenario.stall_limit_s));
        put(format!("start_scan {}", scenario.start_scan));
        match &scenario.goal {
            Goal::AllOrders => put("goal all_orders".into()),
            Goal::TimeLimit => put("goal time_limit".into()),
            Goal::Collected(sinks) => {
                put(format!("goal collected {}", sinks.len()));
                for Collected { machine, part, items } in sinks {
                    put(format!("  {machine} {part} {}", list(items)));
                }
            }
        }
        put(format!("orders {}", scenario.orders.len()));
        for order in &scenario.orders {
            put(format!("  {} {}", list(&order.stations), list(&order.parts)));
        }
        put(format!("supply {}", scenario.supply.len()));
        for supply in &scenario.supply {
            put(format!("  {} {}", supply.belt, list(&supply.items)));
        }
        faults::write(scenario, &mut put);
        put(format!("operations {}", scenario.operations.len()));
        for Operation { machine, part, at_s, for_s, value } in &scenario.operations {
            let until = for_s.map_or("on".into(), |for_s| format!("for {for_s:?}"));
            put(format!("  {machine} {part} {at_s:?} {until} {value:?}"));
        }
        put(format!("presses {}", scenario.presses.len()));
        for Press { button, during } in &scenario.presses {
            let button = match button {
                LineButton::Start => "start",
                LineButton::Reset => "reset",
            };
            put(format!("  {button} {}", during_text(*during)));
        }
        put(format!("removals {}", scenario.removals.len()));
        for Removal { kind, number, at_scan } in &scenario.removals {
            put(format!("  {kind} {number} {at_scan}"));
        }
        put(format!("seed {}", scenario.seed));
        put("end".into());
        out
    }

    /// Reads the text form and checks what it says, see [`Line::check`].
    pub fn from_text(text: &str) -> Result<Line, String> {
        let mut words = Words::new(text);
        let line = Line::read(&mut words)?;
        if !words.is_empty() {
            let word = words.name()?;
            return Err(words.error(format_args!("`{word}` after the end of the line's text")));
        }
        line.check()?;
        Ok(line)
    }

    /// Reads the text form, and leaves what follows it.
    pub fn read(words: &mut Words) -> Result<Line, String> {
        words.expect("line")?;
        words.expect("13")?;
        words.expect("scan_ms")?;
        let scan_ms = words.int()?;
        words.expect("io_delay")?;
        let io_delay = match words.name()? {
            "fixed" => IoDelay::Fixed(words.int()?),
            "random" => IoDelay::Random { max: words.int()?, seed: words.int()? },
            other => return Err(words.error(format_args!("`{other}` is no delay"))),
        };
        words.expect("kinds")?;
        let kinds = words.list(|w| {
            let (name, height, grasp) = (w.name()?.into(), w.real()?, w.real()?);
            let size = [w.real()?, w.real()?];
            let is = w.list(|w| Ok(w.name()?.into()))?;
            let mass = w.real()?;
            let decks = w.list(|w| Ok(Deck { height: w.real()?, size: [w.real()?, w.real()?] }))?;
            Ok(Kind { name, height, grasp, size, is, mass, deck: decks.first().copied() })
        })?;
        words.expect("devices")?;
        let devices = words.list(|w| Ok(Arc::new(Wiring::read(w)?)))?;
        words.expect("machines")?;
        let machines = words.list(|w| read_machine(w, &devices))?;
        words.expect("obstacles")?;
        let obstacles = words.list(read_obstacle)?;
        words.expect("may_touch")?;
        let may_touch = words.list(|w| Ok([w.name()?.into(), w.name()?.into()]))?;
        let scenario = read_scenario(words)?;
        words.expect("end")?;
        Ok(Line { scan_ms, kinds, machines, obstacles, may_touch, scenario, io_delay })
    }
}

fn reads_while(reads: &[ReadWhile]) -> String {
    let mut text = reads.len().to_string();
    for ReadWhile { word, gates } in reads {
        let _ = write!(text, " {word} {}", gates.len());
        for (gate, is) in gates {
            let _ = write!(text, " {gate} {}", u8::from(*is));
        }
    }
    text
}

fn list<T: std::fmt::Display>(values: &[T]) -> String {
    let mut text = values.len().to_string();
    for value in values {
        let _ = write!(text, " {value}");
    }
    text
}

fn any_or_list<T: std::fmt::Display>(values: Option<&[T]>) -> String {
    values.map_or("any".into(), |values| format!("at {}", list(values)))
}

fn point_text(point: Point) -> String {
    format!("{:?} {:?} {:?}", point.x, point.y, point.z)
}

/// What stands behind `at`, or the word for none.
fn optional<T>(
    words: &mut Words,
    none: &str,
    read: impl FnOnce(&mut Words) -> Result<T, String>,
) -> Result<Option<T>, String> {
    match words.name()? {
        "at" => Ok(Some(read(words)?)),
        word if word == none => Ok(None),
        other => Err(words.error(format_args!("`{other}` is neither `{none}` nor `at`"))),
    }
}

fn read_machine(words: &mut Words, devices: &[Arc<Wiring>]) -> Result<Machine, String> {
    let name = words.name()?.into();
    let device: usize = words.int()?;
    let Some(wiring) = devices.get(device).cloned() else {
        return Err(words.error(format_args!("device {device} is not there")));
    };
    let pose = read_point(words)?;
    words.expect("parts")?;
    let parts = words.list(|w| Ok(Arc::new(Part::read(w)?)))?;
    words.expect("states")?;
    let states = words.list(|w| {
        let name = w.name()?.into();
        let working = match w.name()? {
            "working" => true,
            "waiting" => false,
            other => return Err(w.error(format_args!("`{other}` is neither `working` nor `waiting`"))),
        };
        let awaits = w.list(|w| w.int())?;
        w.expect("reads")?;
        let reads = w.list(|w| w.int())?;
        w.expect("while")?;
        let reads_while = w.list(|w| {
            let word = w.int()?;
            Ok(ReadWhile { word, gates: w.list(|w| Ok((w.int()?, w.int::<u8>()? != 0)))? })
        })?;
        w.expect("timers")?;
        let timers = optional(w, "any", |w| w.list(|w| w.int()))?;
        let awaits_answer = match w.name()? {
            "answered" => true,
            "open" => false,
            other => return Err(w.error(format_args!("`{other}` is neither `answered` nor `open`"))),
        };
        Ok(State { name, working, awaits, reads, reads_while, timers, awaits_answer })
    })?;
    let monitor = Monitor {
        stopped: {
            words.expect("stopped")?;
            optional(words, "never", |w| w.int())?
        },
        cells: {
            words.expect("cells")?;
            words.int()?..words.int()?
        },
        counters: {
            words.expect("counters")?;
            words.list(|w| Ok(Counter { word: w.int()?, limit: optional(w, "any", |w| w.int())? }))?
        },
        alarms: {
            words.expect("alarms")?;
            words.list(|w| Ok(Alarm { code: w.int()?, word: w.int()? }))?
        },
        panel: {
            words.expect("panel")?;
            words.list(|w| w.int())?
        },
    };
    words.expect("visits")?;
    let visits = optional(words, "any", |w| w.list(|w| w.int()))?;
    Ok(Machine { name, pose, parts, wiring, states, monitor, visits })
}

fn read_obstacle(words: &mut Words) -> Result<Obstacle, String> {
    let name = words.name()?.into();
    let pose = read_point(words)?;
    let size = match words.name()? {
        "box" => Some(read_point(words)?),
        "none" => None,
        other => return Err(words.error(format_args!("`{other}` is neither `box` nor `none`"))),
    };
    Ok(Obstacle { name, pose, size })
}

fn read_point(words: &mut Words) -> Result<Point, String> {
    Ok(Point::new(words.real()?, words.real()?, words.real()?))
}

fn read_scenario(words: &mut Words) -> Result<Scenario, String> {
    words.expect("spawn_first_s")?;
    let spawn_first_s = words.real()?;
    words.expect("spawn_every_s")?;
    let spawn_every_s = words.real()?;
    words.expect("time_limit_s")?;
    let time_limit_s = words.real()?;
    words.expect("stall_limit_s")?;
    let stall_limit_s = words.real()?;
    words.expect("start_scan")?;
    let start_scan = words.int()?;
    words.expect("goal")?;
    let goal = match words.name()? {
        "all_orders" => Goal::AllOrders,
        "time_limit" => Goal::TimeLimit,
        "collected" => Goal::Collected(
            words
                .list(|w| Ok(Collected { machine: w.int()?, part: w.int()?, items: w.list(|w| w.int())? }))?,
        ),
        other => return Err(format!("`{other}` is no goal")),
    };
    words.expect("orders")?;
    let orders = words.list(|w| Ok(Order { stations: w.list(|w| w.int())?, parts: w.list(|w| w.int())? }))?;
    words.expect("supply")?;
    let supply = words.list(|w| Ok(Supply { belt: w.int()?, items: w.list(|w| w.int())? }))?;
    let faults = faults::read(words)?;
    words.expect("operations")?;
    let operations = words.list(read_operation)?;
    words.expect("presses")?;
    let presses = words.list(read_press)?;
    words.expect("removals")?;
    let removals = words.list(|w| Ok(Removal { kind: w.int()?, number: w.int()?, at_scan: w.int()? }))?;
    words.expect("seed")?;
    let seed = words.int()?;
    Ok(Scenario {
        goal,
        orders,
        supply,
        spawn_first_s,
        spawn_every_s,
        time_limit_s,
        stall_limit_s,
        start_scan,
        operations,
        presses,
        removals,
        seed,
        ..faults
    })
}

fn read_operation(words: &mut Words) -> Result<Operation, String> {
    let (machine, part, at_s) = (words.int()?, words.int()?, words.real()?);
    let for_s = match words.name()? {
        "on" => None,
        "for" => Some(words.real()?),
        other => return Err(words.error(format_args!("`{other}` is neither `on` nor `for`"))),
    };
    Ok(Operation { machine, part, at_s, for_s, value: words.real()? })
}

fn read_press(words: &mut Words) -> Result<Press, String> {
    let button = match words.name()? {
        "start" => LineButton::Start,
        "reset" => LineButton::Reset,
        other => return Err(words.error(format_args!("`{other}` is no button of the line"))),
    };
    Ok(Press { button, during: read_during(words)? })
}

fn during_text(During { at_scan, scans }: During) -> String {
    let until = scans.map_or("on".into(), |scans| format!("at {scans}"));
    format!("{at_scan} {until}")
}

fn read_during(words: &mut Words) -> Result<During, String> {
    Ok(During { at_scan: words.int()?, scans: optional(words, "on", |w| w.int())? })
}
