//! What came of a run.

use crate::account::Account;
use crate::carrier::Carrier;
use crate::collision::Contact;
use crate::item;
use crate::json::Json;
use crate::line::{Goal, Line};
use crate::machine::Machine;
use crate::notes;
use crate::plant::Plant;
use crate::run;
use crate::shortage::point_text;
use std::collections::BTreeMap;

#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The run has reached its goal.
    pub finished: bool,
    /// Why the run ended, and what is missing if it did not finish.
    pub reason: String,
    /// What the scenario asks that did not happen, and that the line stands without a fault.
    pub notes: Vec<String>,
    /// Commands that ended in an error of reach, by machine.
    pub missed: Vec<MissedReport>,
    /// Code and machine of the fault that ended the run.
    pub fault: Option<(i32, String)>,
    /// When it came.
    pub fault_s: Option<f64>,
    /// The faults that did not end it, in the order of their times.
    pub faults: Vec<FaultReport>,
    pub scan_ms: u32,
    pub scans: u64,
    pub simulated_s: f64,
    pub orders_done: usize,
    /// Orders asked for; of orders without end those that were made.
    pub orders: usize,
    /// `None` if none was made.
    pub seconds_per_order: Option<f64>,
    /// How many items of a goal the sinks have, and how many they should have; `None` without such a goal.
    pub collected: Option<[u64; 2]>,
    /// What the sinks have collected: sink, kind and number of items, such as `good.box`, `cover`, 10.
    pub sinks: Vec<(String, String, u64)>,
    /// Of orders without end those that have opened.
    pub order_times: Vec<OrderTimes>,
    /// Those that were raised since the start of the run, in layout order.
    pub alarms: Vec<AlarmReport>,
    /// In layout order.
    pub machines: Vec<MachineReport>,
    /// Of orders without end those that are on the line.
    pub items: Vec<ItemReport>,
    /// Over what all scans left in the controllers and in their published outputs.
    pub trace_hash: u64,
    /// The first contact of each pair, in the order of their times.
    pub collisions: Vec<Contact>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct OrderTimes {
    /// From 1.
    pub number: usize,
    /// Where it was made; before that, all at which it may be.
    pub station: String,
    pub opened_s: Option<f64>,
    pub made_s: Option<f64>,
}

/// A fault after which the run went on.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultReport {
    pub code: i32,
    pub machine: String,
    /// In which its automaton was; empty if it had none.
    pub state: String,
    pub at_s: f64,
    /// `None` if it is there at the end.
    pub cleared_s: Option<f64>,
}

/// A command that ended in an error of reach, or gripped nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct MissedReport {
    /// Its number in the layout.
    pub machine: usize,
    pub at_ms: u64,
    pub error: i32,
    /// Why.
    pub text: String,
}

#[derive(Clone, Debug, PartialEq)]
pub struct AlarmReport {
    pub machine: String,
    pub code: i32,
    pub count: u32,
    pub first_s: f64,
    pub last_s: f64,
    /// What raised it lasts at the end. A loss of power ends it.
    pub active: bool,
    pub acknowledged: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub struct MachineReport {
    pub name: String,
    /// The state in which its automaton is at the end; empty if it has none.
    pub state: String,
    /// In scans.
    pub account: Account,
}

#[derive(Clone, Debug, PartialEq)]
pub struct ItemReport {
    pub id: usize,
    /// As [`item::Names`] gives it.
    pub name: String,
    pub kind: String,
    /// Such as `tray of agv1`.
    pub carrier: String,
    /// Where its underside is, or `-`.
    pub place: String,
}

/// How a run ended, before it is written up.
pub(crate) struct Outcome {
    pub finished: bool,
    pub reason: String,
    /// The scan since which the line waits for an edge of `start`.
    pub stands_since: Option<u64>,
    /// Code and machine of the fault that ended the run.
    pub fault: Option<(i32, Option<usize>)>,
    /// The scan in which it came.
    pub fault_at: Option<u64>,
    pub scans: u64,
    pub accounts: Vec<Account>,
    /// Of all orders.
    pub order_times: Vec<run::OrderTimes>,
    /// Number of the last state of each machine.
    pub states: Vec<usize>,
    pub trace_hash: u64,
    pub collisions: Vec<Contact>,
    pub alarms: Vec<AlarmReport>,
    pub faults: Vec<FaultReport>,
}

fn names(line: &Line, machines: &[usize]) -> String {
    machines.iter().map(|&machine| line.machines[machine].name.as_str()).collect::<Vec<_>>().join(", ")
}

impl Report {
    pub(crate) fn new(line: &Line, plant: &Plant, outcome: Outcome) -> Self {
        let seconds = |scans: u64| seconds(scans, line.scan_ms);
        let of_orders = line.scenario.orders.iter().zip(&outcome.order_times).enumerate();
        let of_orders = of_orders.map(|(i, (order, times))| OrderTimes {
            number: i + 1,
            station: match times.made {
                Some((_, machine)) => line.machines[machine].name.clone(),
                None => names(line, &order.stations),
            },
            opened_s: times.opened.map(seconds),
            made_s: times.made.map(|(scan, _)| seconds(scan)),
        });
        let is_endless = line.scenario.goal == Goal::TimeLimit;
        let order_times: Vec<_> = of_orders.filter(|times| !is_endless || times.opened_s.is_some()).collect();
        let orders_done = order_times.iter().filter(|times| times.made_s.is_some()).count();
        let simulated_s = seconds(outcome.scans);
        let names = item::Names::new(line);
        let items = plant.items().all().enumerate();
        let is_on_line = |carrier: Carrier| carrier != Carrier::Supply && !carrier.is_final();
        let items = items.filter(|(_, item)| !is_endless || is_on_line(item.carrier));
        let items = items.map(|(id, item)| ItemReport {
            id,
            name: names.name(id),
            kind: line.kinds[item.kind].name.clone(),
            carrier: match item.carrier.item() {
                Some(under) => names.name(under),
                None => carrier_text(line, item.carrier),
            },
            place: plant.place(id).map_or_else(|| "-".into(), point_text),
        });
        let stands = outcome.stands_since.map(|scan| stands_text(seconds(scan)));
        let late = outcome.fault_at.filter(|at| at + 1 < outcome.scans).map(|at| late_text(seconds(at)));
        let notes = stands.into_iter().chain(late).chain(notes::not_reached(line, plant, &outcome));
        let notes = notes.chain(notes::missed(line, plant));
        Self {
            finished: outcome.finished,
            reason: outcome.reason,
            notes: notes.collect(),
            missed: notes::missed_times(line, plant),
            fault: outcome.fault.map(|(code, machine)| {
                (code, machine.map_or_else(String::new, |machine| line.machines[machine].name.clone()))
            }),
            fault_s: outcome.fault_at.map(seconds),
            faults: outcome.faults,
            alarms: outcome.alarms,
            scan_ms: line.scan_ms,
            scans: outcome.scans,
            simulated_s,
            orders_done,
            orders: if is_endless { orders_done } else { line.scenario.orders.len() },
            seconds_per_order: (orders_done > 0).then(|| simulated_s / orders_done as f64),
            collected: collected(line, plant),
            sinks: sinks(line, plant),
            order_times,
            machines: line
                .machines
                .iter()
                .zip(outcome.accounts)
                .zip(outcome.states)
                .map(|((machine, account), state)| MachineReport {
                    name: machine.name.clone(),
                    state: machine.states.get(state).map_or_else(String::new, |s| s.name.clone()),
                    account,
                })
                .collect(),
            items: items.collect(),
            trace_hash: outcome.trace_hash,
            collisions: outcome.collisions,
        }
    }

    /// The state in which the automaton of this machine is at the end; empty if there is none.
    pub fn state(&self, machine: &str) -> &str {
        self.machines.iter().find(|report| report.name == machine).map_or("", |report| &report.state)
    }

    /// Sixteen hexadecimal digits.
    pub fn trace_hash_text(&self) -> String {
        format!("{:016x}", self.trace_hash)
    }

    /// One JSON object.
    pub fn to_json(&self) -> String {
        Json::object(|json| {
            json.put_truth("finished", self.finished);
            json.put_text("reason", &self.reason);
            if !self.notes.is_empty() {
                json.put_texts("notes", &self.notes);
            }
            if let Some((code, robot)) = &self.fault {
                json.put_object("fault", |json| {
                    json.put_int("code", u64::from(code.unsigned_abs()));
                    json.put_text("robot", robot);
                    json.put_real("at_s", self.fault_s);
                });
            }
            if !self.faults.is_empty() {
                json.put_list("faults", &self.faults, |json, fault| {
                    json.put_int("code", u64::from(fault.code.unsigned_abs()));
                    json.put_text("robot", &fault.machine);
                    json.put_text("state", &fault.state);
                    json.put_real("at_s", Some(fault.at_s));
                    json.put_real("cleared_s", fault.cleared_s);
                });
            }
            json.put_real("simulated_s", Some(self.simulated_s));
            json.put_int("scans", self.scans);
            json.put_int("orders_done", self.orders_done as u64);
            json.put_int("orders", self.orders as u64);
            json.put_real("seconds_per_order", self.seconds_per_order);
            if let Some([collected, asked]) = self.collected {
                json.put_int("items_collected", collected);
                json.put_int("items_asked", asked);
            }
            if !self.sinks.is_empty() {
                json.put_object("sinks", |json| {
                    for of_sink in self.sinks.chunk_by(|(a, ..), (b, ..)| a == b) {
                        json.put_object(&of_sink[0].0, |json| {
                            of_sink.iter().for_each(|(_, kind, count)| json.put_int(kind, *count));
                        });
                    }
                });
            }
            json.put_list("order_times", &self.order_times, |json, times| {
                json.put_int("order", times.number as u64);
                json.put_text("station", &times.station);
                json.put_real("opened_s", times.opened_s);
                json.put_real("made_s", times.made_s);
            });
            if !self.alarms.is_empty() {
                json.put_list("alarms", &self.alarms, |json, alarm| {
                    json.put_int("code", u64::from(alarm.code.unsigned_abs()));
                    json.put_text("robot", &alarm.machine);
                    json.put_int("count", u64::from(alarm.count));
                    json.put_real("first_s", Some(alarm.first_s));
                    json.put_real("last_s", Some(alarm.last_s));
                    json.put_truth("active", alarm.active);
                    json.put_truth("acknowledged", alarm.acknowledged);
                });
            }
            json.put_object("robots", |json| {
                for machine in &self.machines {
                    json.put_object(&machine.name, |json| {
                        self.put_machine(json, &machine.account);
                        json.put_text("state", &machine.state);
                    });
                }
            });
            json.put_list("items", &self.items, |json, item| {
                json.put_int("id", item.id as u64);
                json.put_text("name", &item.name);
                json.put_text("kind", &item.kind);
                json.put_text("place", &item.place);
                json.put_text("carrier", &item.carrier);
            });
            json.put_text("trace_hash", &self.trace_hash_text());
            json.put_list("collisions", &self.collisions, |json, contact| {
                json.put_real("time_s", Some(contact.time_s));
                json.put_reals("place", &[contact.place.x, contact.place.y, contact.place.z]);
                json.put_texts("pair", &contact.pair);
                json.put_texts("parts", &contact.parts);
                json.put_truth("allowed", contact.allowed);
                json.put_int("count", u64::from(contact.count));
            });
        })
    }

    fn put_machine(&self, json: &mut Json, account: &Account) {
        let seconds = |scans: u64| Some(seconds(scans, self.scan_ms));
        json.put_real("moving_s", seconds(account.moving));
        json.put_real("working_s", seconds(account.working));
        json.put_real("waiting_s", seconds(account.waiting));
        json.put_real("stopped_s", seconds(account.stopped));
        json.put_object("waiting_for", |json| {
            for (owner, &scans) in self.machines.iter().zip(&account.waiting_for) {
                if scans > 0 {
                    json.put_real(&owner.name, seconds(scans));
                }
            }
        });
    }
}

fn stands_text(since_s: f64) -> String {
    format!(
        "the line stands: `start` has had no edge since {since_s:.2} s; release it before, and press it then"
    )
}

/// The run went on, because the scenario had something that might have cleared the fault.
fn late_text(at_s: f64) -> String {
    format!(
        "the fault is there since {at_s:.2} s: after it there was no edge of `reset` and no loss of power that cleared it"
    )
}

/// Items that the sinks of a goal have of what they should have, and all that they should have.
fn collected(line: &Line, plant: &Plant) -> Option<[u64; 2]> {
    let Goal::Collected(sinks) = &line.scenario.goal else { return None };
    let mut sums = [0, 0];
    for sink in sinks {
        let is_here = Carrier::Sink { machine: sink.machine, part: sink.part };
        for (kind, &asked) in sink.items.iter().enumerate() {
            let items = plant.items().all();
            let here = items.filter(|item| item.carrier == is_here && item.kind == kind).count() as u64;
            sums[0] += here.min(u64::from(asked));
            sums[1] += u64::from(asked);
        }
    }
    Some(sums)
}

/// Numbers of items by sink and kind, none of which is 0, in layout order.
fn sinks(line: &Line, plant: &Plant) -> Vec<(String, String, u64)> {
    let mut counts: BTreeMap<[usize; 3], u64> = BTreeMap::new();
    for item in plant.items().all() {
        if let Carrier::Sink { machine, part } = item.carrier {
            *counts.entry([machine, part, item.kind]).or_default() += 1;
        }
    }
    let named = counts.into_iter().map(|([machine, part, kind], count)| {
        let Machine { name, parts, .. } = &line.machines[machine];
        (format!("{name}.{}", parts[part].name), line.kinds[kind].name.clone(), count)
    });
    named.collect()
}

pub(crate) fn seconds(scans: u64, scan_ms: u32) -> f64 {
    (scans * u64::from(scan_ms)) as f64 / 1000.0
}

/// Such as `tray of agv1`.
pub fn carrier_text(line: &Line, carrier: Carrier) -> String {
    let name = |machine: usize| &line.machines[machine].name;
    match carrier {
        Carrier::Supply => "supply".into(),
        Carrier::Lane { machine, .. } => name(machine).clone(),
        Carrier::Grip { machine, .. } => format!("gripper of {}", name(machine)),
        Carrier::Place { machine, part, .. } => match line.machines[machine].title(part) {
            Some(title) => format!("{title} of {}", name(machine)),
            None => name(machine).clone(),
        },
        Carrier::On { .. } => "another item".into(),
        Carrier::Floor { .. } => "floor".into(),
        Carrier::Sink { .. } | Carrier::Collector => "collector".into(),
        Carrier::Part { .. } => "another item".into(),
        Carrier::Shipped { order } => format!("order {}", order + 1),
    }
}
