//! One automaton as text.

use super::lot::Lot;
use super::world::{Extent, Finite, Named, Rule, Ty, World, declaration};
use super::writer::{Caution, Stage, Writer};
use autogen::device::Device;
use autogen::library;
use runtime_sim::device::{Direction, PortType};
use std::fmt::Write;
use std::sync::Arc;

/// An automaton of this name.
pub fn automaton(lot: &mut Lot, world: &World, name: &str) -> String {
    let devices = library::devices();
    let device = lot.pick(devices);
    let own = match lot.below(5) {
        0 => vec!["Post", "Shelf"],
        1 => vec!["Post"],
        2 | 3 => vec!["Shelf"],
        _ => vec![],
    };
    text(lot, world, name, device, &own)
}

/// One that has every interface, so that each has a member.
pub fn anchor(lot: &mut Lot, world: &World) -> String {
    let device = library::device("vehicle").expect("a device of the library");
    text(lot, world, "Anchor", device, &["Shelf", "Post"])
}

fn text(lot: &mut Lot, world: &World, name: &str, device: &Arc<Device>, own: &[&str]) -> String {
    let mut declarations = Vec::new();
    let mut names = of_device(device);
    for interface in own.iter().filter_map(|i| world.interface(i)) {
        for parameter in &interface.parameters {
            let line =
                world.text.lines().find(|l| l.trim().starts_with(&format!("parameter {}:", parameter.name)));
            declarations.push(line.unwrap_or_default().trim().to_string());
            names.push(parameter.clone());
        }
        names.extend(interface.cells.iter().cloned());
    }
    for line in own_declarations(lot, name) {
        let word = line.split(' ').next().unwrap_or_default();
        let declared = declaration(&line, word, &world.enums);
        names.extend(declared);
        declarations.push(line);
    }
    let roles = roles(lot, name, device);
    let mut writer = Writer {
        lot,
        world,
        device: device.clone(),
        names,
        own: own.iter().map(|o| o.to_string()).chain([name.to_string()]).collect(),
        roles: roles.iter().map(|(_, name, of)| (name.clone(), of.clone())).collect(),
        variables: Vec::new(),
        facts: Vec::new(),
        divisors: Vec::new(),
        frozen: Vec::new(),
        caution: Caution::Risky,
        stage: Stage::Elsewhere,
        faults: 0,
    };
    let is = match own {
        [] => String::new(),
        own => format!(" is {}", own.join(", ")),
    };
    let mut out = format!("automaton {name} on {}{is} {{\n", device.name);
    for (kind, role, of) in &roles {
        let of = if of.len() > 1 { format!("({})", of.join(" and ")) } else { of[0].clone() };
        let _ = writeln!(out, "    {kind} {role}: {of}[];");
    }
    for line in declarations {
        let _ = writeln!(out, "    {line}");
    }
    out += &requirement(writer.lot, own);
    let (definitions, states) = (writer.definitions(), writer.states());
    out += &retained(writer.lot, &out);
    // What waits for the answer to a command could wait for ever.
    let asks = ["done", "ack", "got", "error"].iter().any(|w| definitions.contains(w) || states.contains(w));
    let resumed = match writer.lot.below(3) {
        0 => String::new(),
        1 => "    state Q".into(),
        _ if asks => "    state Q0".into(),
        _ => "    state ".into(),
    };
    out += &definitions;
    if resumed.is_empty() {
        out += &states;
    } else {
        out += &states.replace(&resumed, &format!("    resume {}", resumed.trim_start()));
    }
    out += &writer.invariants();
    out += &writer.properties();
    out + "}\n"
}

/// Sometimes all, sometimes the state and some locals of these declarations.
fn retained(lot: &mut Lot, declarations: &str) -> String {
    match lot.below(4) {
        0 => return "    retain all;\n".into(),
        1 => return String::new(),
        _ => {}
    }
    let mut names = vec!["state"];
    if lot.one_in(3) {
        names.clear();
    }
    for line in declarations.lines() {
        let local = line.trim().strip_prefix("local ").and_then(|rest| rest.split(':').next());
        names.extend(local.filter(|_| lot.one_in(2)));
    }
    if names.is_empty() { String::new() } else { format!("    retain {};\n", names.join(", ")) }
}

fn of_device(device: &Device) -> Vec<Named> {
    let named = |name: &str, ty: PortType, extent: runtime_sim::device::Extent, rule, finite| Named {
        name: name.into(),
        ty: match ty {
            PortType::Bool => Ty::Bool,
            PortType::Int { lo, hi } => Ty::Int(lo.into(), hi.into()),
            PortType::Real => Ty::Real,
            PortType::Point => Ty::Point,
        },
        extent: match extent {
            runtime_sim::device::Extent::One => Extent::One,
            runtime_sim::device::Extent::PerKind => Extent::By("Kind".into()),
            runtime_sim::device::Extent::Times(n) => Extent::Count(n),
        },
        rule,
        finite,
    };
    let ports = device.ports.iter().map(|port| {
        let is_of_commands = ["cmd", "verb", "hold"].contains(&port.name.as_str())
            || device.verbs.iter().any(|verb| verb.arguments.contains(&port.name));
        let is_written = port.direction == Direction::Output && !is_of_commands;
        let rule = if is_written { Rule::Owner } else { Rule::Fixed };
        named(&port.name, port.ty, port.extent, rule, Finite::Perhaps)
    });
    let constants =
        device.constants.iter().map(|c| named(&c.name, c.ty, c.extent, Rule::Fixed, Finite::Always));
    ports.chain(constants).collect()
}

/// Parameters, cells and locals of every type.
fn own_declarations(lot: &mut Lot, name: &str) -> Vec<String> {
    let low = lot.between(-9, 0);
    let mut lines = vec![
        format!("local n: int {low}..{};", lot.between(1, 40)),
        "local shelf: Shelf;".into(),
        "local post: Post;".into(),
        "local x: real;".into(),
        "local b: bool := true;".into(),
        "local counts: int 0..6[Kind];".into(),
        "local seen: bool[Kind];".into(),
        "local zs: point[Kind];".into(),
    ];
    let more = [
        "parameter limit: int 1..9 := 4;",
        "parameter pace: time := 30 ms;",
        "parameter ratios: real[3] := 0.5;",
        "parameter order: Kind[2];",
        "parameter home: point := point(1, 2, 3);",
        "local i: int 0..11;",
        "local large: int -2000000000..2000000000 := 1999999999;",
        "local v: int 0..9[5] := 2;",
        "local w: int -30..30[Colour];",
        "local y: real := -0.5;",
        "local rs: real[3];",
        "local heap: real[Kind] := 1e300;",
        "local t: time := 30 ms;",
        "local ts: time[2];",
        "local p: point;",
        "local q: point := point(-1, 2.5, 1e200);",
        "local ps: point[3];",
        "local k: Kind;",
        "local c: Colour := Blue;",
        "local cs: Colour[4] := Red;",
        "local u: Turn;",
        "local bs: bool[Turn];",
        "local flag: bool;",
        "local flags_seen: bool[Colour] := true;",
        "local shelves_seen: Shelf[3];",
        "local by_kind: Shelf[Kind];",
        "local e: int 7..9;",
        "local minus: int -9..-2;",
        "local slots: Slot[5];",
    ];
    lines.extend(more.iter().filter(|_| !lot.one_in(3)).map(|l| l.to_string()));
    let cells = [
        "shared own_count: int 0..9 by counter;",
        "shared own_flag: bool by handshake;",
        "shared own_place: point;",
        "shared own_kinds: Kind[3];",
    ];
    if name == "Anchor" || lot.one_in(3) {
        lines.extend(cells.iter().filter(|_| lot.one_in(2)).map(|l| l.to_string()));
        lines.push("shared own_state: int 0..9 by owner;".into());
        lines.push(format!("local twin: {name};"));
    }
    lines
}

/// What holds in every layout.
fn requirement(lot: &mut Lot, own: &[&str]) -> String {
    let condition = match own.contains(&"Shelf") {
        true => "size >= 1 and count(shelves) < 100",
        false => "forall s in shelves: s.size > 0 or s.wide",
    };
    match lot.one_in(3) {
        true => format!("    require {condition} else \"too much\";\n"),
        false => String::new(),
    }
}

/// Kind, name and interfaces of each role.
fn roles(lot: &mut Lot, _name: &str, device: &Device) -> Vec<(&'static str, String, Vec<String>)> {
    let shelf = || vec!["Shelf".to_string()];
    let mut roles = vec![
        ("knows", "shelves".to_string(), shelf()),
        ("knows", "posts".into(), vec!["Post".into()]),
        ("serves", "goals".into(), shelf()),
    ];
    if lot.one_in(2) {
        roles.push(("knows", "both".into(), vec!["Shelf".into(), "Post".into()]));
    }
    if device.is_arm() {
        roles.push(("takes from", "sources".into(), shelf()));
        roles.push(("hands to", "sinks".into(), shelf()));
    }
    roles
}

impl Writer<'_> {
    fn definitions(&mut self) -> String {
        let mut out = String::new();
        for number in 0..self.lot.below(7) {
            let name = format!("d{number}");
            let (ty, value) = match self.lot.below(8) {
                0 | 1 => (Ty::Bool, self.boolean(2)),
                2 => {
                    let (text, lo, hi) = self.whole(2);
                    (Ty::Int(lo, hi), text)
                }
                3 => (Ty::Real, self.real(2)),
                4 => (Ty::Point, self.point(2)),
                5 => (Ty::Enum("Kind".into()), self.member("Kind")),
                6 => (Ty::Ref("Shelf".into()), self.plain_reference("Shelf", 2).unwrap_or("shelf".into())),
                _ => (Ty::Time(i64::from(i32::MAX)), self.time(1).0),
            };
            let _ = writeln!(out, "    define {name} = {value};");
            self.names.push(Named {
                name,
                ty,
                extent: Extent::One,
                rule: Rule::Fixed,
                finite: Finite::Perhaps,
            });
        }
        out
    }

    fn invariants(&mut self) -> String {
        self.stage = Stage::Elsewhere;
        let mut out = String::new();
        if self.lot.one_in(3) {
            let _ = writeln!(out, "    invariant n <= 40 or {};", self.boolean(2));
        }
        if self.device.name != "bin" && self.lot.one_in(8) {
            let _ = writeln!(
                out,
                "    invariant {} or {} or {};",
                self.passing_twice(),
                self.boolean(1),
                self.boolean(0)
            );
        }
        out
    }

    fn passing_twice(&mut self) -> String {
        format!("(({}) or ({}))", self.passing(), self.passing())
    }

    fn states(&mut self) -> String {
        let mut out = String::new();
        let count = self.lot.between(2, 4) as usize;
        let mut states: Vec<String> = (0..count).map(|i| format!("S{i}")).collect();
        let sequences = self.lot.below(3);
        states.extend((0..sequences).map(|i| format!("Q{i}")));
        if self.lot.one_in(2) {
            self.caution = Caution::Safe;
            let updates = self.updates(3);
            let _ = writeln!(out, "    initial -> S0 {{{updates} }}");
        } else {
            out += "    initial -> S0 {}\n";
        }
        self.caution = Caution::Risky;
        for (number, name) in states.iter().enumerate() {
            let next = states[(number + 1) % states.len()].clone();
            let within = match self.lot.one_in(4) {
                true => format!(" within {} ms + {}", self.lot.between(80, 200), self.short_time()),
                false => String::new(),
            };
            if name.starts_with('Q') {
                out += &self.sequence(name, &within, &next, &states);
                continue;
            }
            let _ = writeln!(out, "    state {name}{within} {{");
            for _ in 0..1 + self.lot.below(3) {
                let target = self.lot.pick(&states).clone();
                let stays = if within.is_empty() { 3 } else { 8 };
                let target = if self.lot.one_in(stays) { String::new() } else { format!(" -> {target}") };
                out += &self.transition(&target);
            }
            let wait = self.lot.between(10, 60);
            let updates = self.fresh(|w| w.guarded_updates(1));
            let _ = writeln!(out, "        when after {wait} ms, {} -> {next} {{{} }}", updates.0, updates.1);
            if number + 1 == count && self.lot.one_in(5) {
                out += "        when after 10 ms, first s in shelves with s.bell -> Ended;\n";
            }
            let _ = writeln!(out, "        when after {} ms -> {next} {{}}\n    }}", wait + 50);
            if out.contains(" -> Ended;") && !out.contains("final") {
                out += "    final state Ended;\n";
            }
        }
        for _ in 0..self.lot.below(3) {
            let except = match self.lot.one_in(2) {
                true => format!(" except {}", self.lot.pick(&states)),
                false => String::new(),
            };
            let _ = writeln!(out, "    any state{except} {{");
            let target = match self.lot.below(3) {
                0 => format!(" -> {}", self.lot.pick(&states)),
                _ => String::new(),
            };
            let passing = self.passing();
            out += &self.transition(&target).replacen("when ", &format!("when ({passing}), "), 1);
            out += "    }\n";
        }
        out
    }

    fn short_time(&mut self) -> String {
        format!("{} ms * {}", self.lot.between(1, 30), self.lot.between(0, 4))
    }

    fn transition(&mut self, target: &str) -> String {
        let (guard, updates) = self.fresh(|w| {
            let guard = match w.lot.one_in(5) {
                true => w.claim(),
                false => None,
            };
            match guard {
                Some((guard, claim)) => (guard, claim),
                None => w.guarded_updates(4),
            }
        });
        format!("        when {guard}{target} {{{updates} }}\n")
    }

    /// A guard and updates; what may fault waits for something that passes.
    fn guarded_updates(&mut self, most: usize) -> (String, String) {
        let guard = self.guard();
        let updates = self.updates(most);
        let passing = self.passing();
        let guard = match (self.faults, self.lot.below(3)) {
            (0, 1..) => guard,
            _ => format!("({passing}), {guard}"),
        };
        (guard, updates)
    }

    /// A lock that is taken.
    fn claim(&mut self) -> Option<(String, String)> {
        self.stage = Stage::Guard;
        let name = self.new_variable();
        self.variables.push((name.clone(), Ty::Ref("Shelf".into())));
        let lock = match self.lot.below(3) {
            0 => format!("{name}.locks[{}]", self.lot.pick(self.world.members("Kind"))),
            _ => format!("{name}.held"),
        };
        let guard = format!("first {name} in shelves with not {lock}, {}", self.passing());
        Some((guard, format!(" shelf := {name}; {lock} := true;")))
    }

    /// Something written without what was known before.
    fn fresh<T>(&mut self, write: impl FnOnce(&mut Self) -> T) -> T {
        self.faults = 0;
        let result = write(self);
        self.variables.clear();
        self.facts.clear();
        self.divisors.clear();
        self.frozen.clear();
        result
    }

    fn sequence(&mut self, name: &str, within: &str, next: &str, states: &[String]) -> String {
        let mut out = format!("    state {name}{within} = sequence {{\n");
        self.caution = Caution::Safe;
        for _ in 0..self.lot.between(1, 4) {
            self.stage = Stage::Update;
            let step = match self.lot.below(6) {
                0 | 1 if self.device.is_commanded() => self.command(),
                2 => format!(" wait {} ms;", self.lot.between(0, 30)),
                3 => {
                    let depth = self.lot.below(2);
                    self.stage = Stage::Guard;
                    let condition = self.boolean(depth);
                    format!(" until {condition} at most {} ms;", self.lot.between(0, 40))
                }
                4 => format!(" until {} or after 40 ms;", self.passing()),
                _ => self.assignment().unwrap_or_default(),
            };
            let _ = writeln!(out, "       {step}");
        }
        self.stage = Stage::Update;
        let then = self.assignment().unwrap_or_default();
        let other = self.assignment().unwrap_or_default();
        self.caution = Caution::Risky;
        self.fresh(|_| ());
        let _ = writeln!(out, "    }} -> {next} {{{then} }}");
        let _ = writeln!(out, "      else {} {{{other} }}", self.lot.pick(states));
        out
    }
}
