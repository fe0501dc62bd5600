//! Who works with whom: proposals from types, edges from geometry, members of roles from edges.

use super::bind::Robot;
use super::{Apart, Verdict, work};
use crate::connect::{self, Connected, Ground, Node, Proposal, Site, Withheld};
use crate::device::Heights;
use crate::diagnostic::{Diagnostic, collect};
use crate::executor::Executor;
use crate::ir::{
    self, Automaton, AutomatonId, Direction, Handover, Index, Instance, InterfaceId, Model, Role, RoleKind,
    System, TextPart, Value,
};
use crate::layout::{self, Layout, Names};
use crate::parallel::{LEAST, in_parts};
use crate::scenario::{Number, Scenario};
use crate::source::Span;
use runtime_sim::machine::Machine;
use std::cell::Cell;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Pairs of an arm and a place whose poses are tried.
const MOST_PAIRS: usize = 100_000;
/// Pairs that are tried since a machine is cut off, however far the two are apart.
const MOST_FAR: usize = 2000;

/// What `takes_from` or `hands_to` of an arm says of a machine.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Listed {
    Named,
    LeftOut,
    NoList,
}

/// The machines of a layout, bound to a model of just their types.
pub struct Line<'a> {
    pub layout: &'a Layout,
    pub robots: Vec<Robot<'a>>,
    pub model: Model,
    /// The automaton of each robot.
    automata: Vec<AutomatonId>,
    /// Name, and height of the grip point over the underside, m, of each kind.
    pub kinds: Vec<(String, f64)>,
    pub heights: Vec<Heights>,
    /// Parts of each kind that all orders of the scenario ask for, and where these stand. `None`: without end.
    pub ordered: Option<Vec<u64>>,
    pub orders_place: Span,
    /// For each interface its members, in layout order.
    pub members: Vec<Vec<usize>>,
    /// For each robot and parameter the elements.
    pub values: Vec<Vec<Vec<Value>>>,
    /// For each robot and constant of its device the words.
    pub constants: Vec<Vec<Vec<f64>>>,
    pub diagnostics: Vec<Diagnostic>,
    /// The robot and the role that each proposal is for.
    asked_by: Vec<(usize, usize)>,
    line: Option<connect::Line>,
    /// The robot of each node of the connectivity check.
    nodes: Vec<usize>,
}

impl<'a> Line<'a> {
    pub fn new(layout: &'a Layout, robots: Vec<Robot<'a>>, model: Model, scenario: &Scenario) -> Self {
        let kinds: Vec<(String, f64)> =
            scenario.kinds.iter().map(|k| (k.name.value.clone(), k.grasp)).collect();
        let heights = scenario.kinds.iter().map(|k| Heights { top: k.height, grasp: k.grasp }).collect();
        let asked = |kind: usize| scenario.orders.list.iter().map(|o| u64::from(o.parts[kind])).sum();
        let has_end = scenario.orders.number == Number::Listed;
        let ordered = has_end.then(|| (0..kinds.len()).map(asked).collect());
        let automaton =
            |robot: &Robot| model.automata.iter().position(|a| a.name == robot.automaton).unwrap_or(0);
        let automata = robots.iter().map(|robot| AutomatonId(automaton(robot))).collect();
        let mut line = Self {
            layout,
            robots,
            model,
            automata,
            kinds,
            heights,
            ordered,
            orders_place: scenario.orders.span,
            members: Vec::new(),
            values: Vec::new(),
            constants: Vec::new(),
            diagnostics: Vec::new(),
            asked_by: Vec::new(),
            line: None,
            nodes: Vec::new(),
        };
        line.members = (0..line.model.interfaces.len())
            .map(|i| {
                (0..line.robots.len())
                    .filter(|r| line.automaton(*r).implementing(InterfaceId(i)).is_some())
                    .collect()
            })
            .collect();
        line
    }

    /// The machines as the simulator takes them, their automata still to come; `None` has been reported.
    pub fn machines(&mut self) -> Option<Vec<Machine>> {
        let mut all = Vec::new();
        let machine =
            |robot: &Robot| robot.placed.machine(&robot.object.name.value, &self.heights, robot.object.span);
        for made in in_parts(&self.robots, LEAST, |robots| robots.iter().map(machine).collect()) {
            match made {
                Ok((machine, constants)) => {
                    all.push(machine);
                    self.constants.push(constants);
                }
                Err(found) => found.into_iter().for_each(|d| collect(&mut self.diagnostics, d)),
            }
        }
        self.diagnostics.is_empty().then_some(all)
    }

    pub fn automaton_id(&self, robot: usize) -> AutomatonId {
        self.automata[robot]
    }

    pub fn automaton(&self, robot: usize) -> &Automaton {
        self.model.automaton(self.automaton_id(robot))
    }

    fn handover(&self, robot: usize, direction: Direction) -> impl Iterator<Item = &Handover> {
        self.automaton(robot)
            .implements
            .iter()
            .filter_map(|i| i.handover.as_ref())
            .filter(move |h| h.direction == direction)
    }

    fn takes_part(&self, robot: usize) -> bool {
        let automaton = self.automaton(robot);
        automaton.implements.iter().any(|i| i.handover.is_some())
            || automaton.roles.iter().any(|r| matches!(r.kind, RoleKind::Takes | RoleKind::Hands))
    }

    /// The robot that is this node of the connectivity check.
    pub fn robot_of(&self, node: usize) -> usize {
        self.nodes[node]
    }

    /// What the geometry says of the pairs that the types propose; `None` has been reported.
    pub fn connect(&mut self) -> Option<connect::Report> {
        let nodes_of: Vec<usize> = (0..self.robots.len()).filter(|r| self.takes_part(*r)).collect();
        let nodes = nodes_of.iter().map(|&r| {
            let (offers, accepts) = (
                self.handover(r, Direction::Offers).count() > 0,
                self.handover(r, Direction::Accepts).count() > 0,
            );
            let robot = &self.robots[r];
            let device = &robot.placed.device;
            // Nothing is given to an arm or taken from it: items come and go by its own lanes.
            let is_arm = !offers && !accepts;
            Node {
                name: robot.object.name.value.clone(),
                span: robot.object.name.span,
                placed: robot.placed.clone(),
                numbers: Vec::new(),
                is_source: (offers && !accepts) || (is_arm && device.has("source")),
                is_destination: (accepts && !offers) || (is_arm && device.has("sink")),
            }
        });
        let nodes: Vec<Node> = nodes.collect();
        let ground: Vec<Ground> = in_parts(&self.robots, LEAST, |robots| {
            robots.iter().map(|robot| Ground::of(&robot.placed)).collect()
        });
        let near = |arm: usize, passive: usize| ground[arm].is_near(ground[passive]);
        let span = Span::new(self.layout.file, 0, 0);
        let mut line = connect::Line {
            span,
            nodes,
            proposals: Vec::new(),
            withheld: Vec::new(),
            kinds: self.kinds.clone(),
        };
        (line.proposals, self.asked_by) =
            self.proposals(&nodes_of, false, |arm, passive, _| near(arm, passive));
        if line.proposals.len() > MOST_PAIRS {
            self.too_many_pairs(&line);
            return None;
        }
        let mut report = connect::check(&line);
        if !report.is_feasible() {
            for (node, robot) in line.nodes.iter_mut().zip(&nodes_of) {
                node.numbers = layout::numbers(self.robots[*robot].object, &node.placed.device);
            }
            // What machines that are cut off could have worked with, however far it is.
            let cut_off = |nodes: &[usize]| nodes.iter().map(|n| nodes_of[*n]).collect::<BTreeSet<usize>>();
            let far = Cell::new(0);
            let (starved, stuck) = (cut_off(&report.unreachable), cut_off(&report.dead_ends));
            let is_cut_off = |arm: usize, passive: usize, kind: RoleKind| {
                let (from, to) = if kind == RoleKind::Takes { (passive, arm) } else { (arm, passive) };
                starved.contains(&to) || stuck.contains(&from)
            };
            (line.proposals, self.asked_by) = self.proposals(&nodes_of, false, |arm, passive, kind| {
                let is_far = || {
                    let is_wanted = far.get() < MOST_FAR && is_cut_off(arm, passive, kind);
                    far.set(far.get() + usize::from(is_wanted));
                    is_wanted
                };
                near(arm, passive) || is_far()
            });
            let (left_out, _) = self.proposals(&nodes_of, true, |arm, passive, kind| {
                near(arm, passive) && is_cut_off(arm, passive, kind)
            });
            line.withheld = left_out.into_iter().filter_map(|pair| self.withheld(&nodes_of, pair)).collect();
            report = connect::check(&line);
        }
        self.nodes = nodes_of;
        self.line = Some(line);
        Some(report)
    }

    fn too_many_pairs(&mut self, line: &connect::Line) {
        let mut counts = vec![0; line.nodes.len()];
        line.proposals.iter().for_each(|pair| counts[pair.arm] += 1);
        let Some((node, count)) = (0..counts.len()).map(|n| (n, counts[n])).max_by_key(|(_, count)| *count)
        else {
            return;
        };
        let arm = &line.nodes[node];
        let message = format!("more than {MOST_PAIRS} pairs of an arm and a place are near one another");
        self.diagnostics.push(
            Diagnostic::new("E0408", arm.span, message)
                .note(format!("{} alone is near {count} places", arm.name))
                .help("restrict arms with \"takes_from\" and \"hands_to\", or divide the line into several lines"),
        );
    }

    /// The pairs that the types propose and that are wanted, by arm, passive machine and kind of role; and
    /// the robot and the role that each is for. `nodes` are the robots that are nodes. With `left_out` the
    /// pairs that `takes_from` and `hands_to` keep apart, otherwise the others.
    fn proposals(
        &self,
        nodes: &[usize],
        left_out: bool,
        is_wanted: impl Fn(usize, usize, RoleKind) -> bool,
    ) -> (Vec<Proposal>, Vec<(usize, usize)>) {
        let mut node_of = vec![None; self.robots.len()];
        for (node, &robot) in nodes.iter().enumerate() {
            node_of[robot] = Some(node);
        }
        let (mut proposals, mut asked_by) = (Vec::new(), Vec::new());
        for arm in 0..self.robots.len() {
            for (index, role) in self.automaton(arm).roles.iter().enumerate() {
                for (passive, listed) in self.candidates(arm, role) {
                    if (listed == Listed::LeftOut) != left_out || !is_wanted(arm, passive, role.kind) {
                        continue;
                    }
                    let (Some(arm_node), Some(passive_node)) = (node_of[arm], node_of[passive]) else {
                        continue;
                    };
                    let Some(site) = self.site(passive, role) else { continue };
                    let (from, to) = match role.kind {
                        RoleKind::Takes => (passive_node, arm_node),
                        _ => (arm_node, passive_node),
                    };
                    if proposals.len() > MOST_PAIRS {
                        return (proposals, asked_by);
                    }
                    let (rule, is_named) = (role.place, listed == Listed::Named);
                    proposals.push(Proposal { from, to, arm: arm_node, site, rule, is_named });
                    asked_by.push((arm, index));
                }
            }
        }
        (proposals, asked_by)
    }

    /// Robots that a role of an arm could have by their types, and what `takes_from` or `hands_to` of the
    /// layout says of them.
    fn candidates<'l>(&'l self, arm: usize, role: &Role) -> Vec<(usize, Listed)> {
        let direction = match role.kind {
            RoleKind::Takes => Direction::Offers,
            RoleKind::Hands => Direction::Accepts,
            RoleKind::Serves | RoleKind::Knows => return Vec::new(),
        };
        let names = |names: &'l Names| names.value.iter().map(|n| n.value.as_str()).collect();
        let narrowed: Option<HashSet<&str>> = self.narrowed(arm, role.kind).map(names);
        let listed = |r: usize| match &narrowed {
            Some(names) if names.contains(self.robots[r].object.name.value.as_str()) => Listed::Named,
            Some(_) => Listed::LeftOut,
            None => Listed::NoList,
        };
        let fits = |automaton: &Automaton| {
            let place = automaton
                .implementing(role.interface)
                .and_then(|i| automaton.implements[i].handover.as_ref());
            place.is_some_and(|h| h.direction == direction)
                && role.also.iter().all(|i| automaton.implementing(*i).is_some())
        };
        let fits: Vec<bool> = self.model.automata.iter().map(fits).collect();
        let fitting = (0..self.robots.len()).filter(|r| *r != arm && fits[self.automata[*r].0]);
        fitting.map(|r| (r, listed(r))).collect()
    }

    /// The list of the layout that restricts a kind of role of an arm.
    fn narrowed(&self, arm: usize, kind: RoleKind) -> Option<&Names> {
        let object = self.robots[arm].object;
        match kind {
            RoleKind::Takes => object.takes_from.as_ref(),
            RoleKind::Hands => object.hands_to.as_ref(),
            RoleKind::Serves | RoleKind::Knows => None,
        }
    }

    fn withheld(&self, nodes: &[usize], pair: Proposal) -> Option<Withheld> {
        let kind = if pair.arm == pair.to { RoleKind::Takes } else { RoleKind::Hands };
        let list = self.narrowed(nodes[pair.arm], kind)?.span;
        Some(Withheld { pair, list })
    }

    fn site(&self, passive: usize, role: &Role) -> Option<Site> {
        let automaton = self.automaton(passive);
        let handover = automaton.implements[automaton.implementing(role.interface)?].handover.as_ref()?;
        let number = |parameter: usize| match self.values[passive][parameter][0] {
            Value::Int(n) => Some(n.max(0) as usize),
            _ => None,
        };
        let capacity = automaton.parameters.iter().position(|p| p.name == "capacity");
        let index = match handover.index {
            Some(Index::Parameter(parameter)) => Some(number(parameter)?),
            Some(Index::Number(index)) => Some(index),
            None => None,
        };
        Some(Site {
            name: handover.name.clone(),
            index,
            capacity: capacity.and_then(number).map_or(usize::MAX, |capacity| capacity.max(1)),
            approach: handover.approach,
        })
    }

    pub fn verdict(&self, report: &connect::Report) -> Verdict {
        let Some(line) = &self.line else { return Verdict::default() };
        let name = |node: usize| line.nodes[node].name.clone();
        let those = |wanted: fn(&Node) -> bool| {
            line.nodes.iter().filter(|n| wanted(n)).map(|n| n.name.clone()).collect()
        };
        Verdict {
            feasible: report.is_feasible(),
            robots: self.robots.iter().map(|r| r.object.name.value.clone()).collect(),
            edges: (report.edges.iter())
                .map(|edge| super::Handover {
                    from: name(edge.from),
                    to: name(edge.to),
                    margin: edge.margin,
                    wrist_room: edge.wrist_room,
                })
                .collect(),
            sources: those(|n| n.is_source),
            destinations: those(|n| n.is_destination),
            passages: Vec::new(),
            losses: Vec::new(),
            sinks: Vec::new(),
            single_points: report.single_points.iter().map(|n| name(*n)).collect(),
            unreachable: report.unreachable.iter().map(|n| name(*n)).collect(),
            dead_ends: report.dead_ends.iter().map(|n| name(*n)).collect(),
            apart: (report.failures.iter())
                .map(|failure| {
                    let proposal = &line.proposals[failure.proposal];
                    Apart {
                        from: name(proposal.from),
                        to: name(proposal.to),
                        tested: failure.tested,
                        misses: failure.misses.clone(),
                        suggestion: failure
                            .suggestion
                            .as_ref()
                            .map(|m| (name(m.node), m.path.clone(), m.present, m.value)),
                        turn: failure.turn.as_ref().map(|t| (name(t.node), t.present, t.value)),
                    }
                })
                .collect(),
        }
    }

    /// The whole system; `None` has been reported.
    pub fn system(&mut self, report: connect::Report, scan_ms: u32) -> Option<System> {
        let line = self.line.take()?;
        let mut stands = vec![true; line.proposals.len()];
        report.failures.iter().for_each(|failure| stands[failure.proposal] = false);
        let connected = match report.connected() {
            Ok(connected) => connected,
            Err(found) => {
                self.diagnostics.extend(found);
                return None;
            }
        };
        self.round_trips(&line, &connected);
        self.nobody_to_refer_to();
        let robot_of = self.nodes.clone();
        let mut node_of = vec![None; self.robots.len()];
        robot_of.iter().enumerate().for_each(|(node, &robot)| node_of[robot] = Some(node));
        let reaches = |a: usize, b: usize| match (node_of[a], node_of[b]) {
            (Some(a), Some(b)) => connected.reaches(a, b),
            _ => false,
        };
        let mut meets: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
        for (number, asked_by) in self.asked_by.iter().enumerate().filter(|(number, _)| stands[*number]) {
            meets.entry(*asked_by).or_default().push(robot_of[line.proposals[number].passive()]);
        }
        let mut instances = Vec::new();
        let of_types: Vec<Vec<Role>> = self.model.automata.iter().map(|a| a.roles.clone()).collect();
        for robot in 0..self.robots.len() {
            let mut roles = Vec::new();
            for (index, role) in of_types[self.automaton_id(robot).0].iter().enumerate() {
                let found: Vec<usize> = match role.kind {
                    RoleKind::Takes | RoleKind::Hands => {
                        meets.get(&(robot, index)).cloned().unwrap_or_default()
                    }
                    RoleKind::Serves => {
                        let members = self.members[role.interface.0].iter().copied();
                        members.filter(|r| *r != robot && reaches(robot, *r)).collect()
                    }
                    RoleKind::Knows => {
                        self.members[role.interface.0].iter().copied().filter(|r| *r != robot).collect()
                    }
                };
                let members = &self.members[role.interface.0];
                let has_all =
                    |r: &usize| role.also.iter().all(|i| self.members[i.0].binary_search(r).is_ok());
                let rows: Vec<usize> = found
                    .iter()
                    .filter(|r| has_all(r))
                    .filter_map(|r| members.binary_search(r).ok())
                    .collect();
                self.cardinality(robot, role, &rows);
                roles.push(rows);
            }
            let rows = (self.automaton(robot).implements.iter())
                .filter_map(|i| self.members[i.interface.0].binary_search(&robot).ok());
            let rows = rows.collect();
            instances.push(Instance {
                name: self.robots[robot].object.name.value.clone(),
                automaton: self.automaton_id(robot),
                parameters: std::mem::take(&mut self.values[robot]),
                roles,
                rows,
            });
        }
        let table = |relation: &ir::Relation| {
            let to = &self.members[relation.to.0];
            self.members[relation.from.0]
                .iter()
                .map(|a| to.iter().map(|b| reaches(*a, *b)).collect())
                .collect()
        };
        let system = System {
            model: self.model.clone(),
            scan_ms: scan_ms as i32,
            instances,
            members: self.members.clone(),
            reaches: self.model.relations.iter().map(table).collect(),
        };
        if self.diagnostics.is_empty() && !work::is_too_much(&system, &mut self.diagnostics) {
            self.requirements(&system);
        }
        self.diagnostics.is_empty().then_some(system)
    }

    /// Whether a machine names another one in its `takes_from` and in its `hands_to`.
    fn names_both(&self, arm: &str, place: &str) -> bool {
        let arm = self.robots.iter().find(|robot| robot.object.name.value == arm);
        let names =
            |list: &Option<Names>| list.iter().flat_map(|list| &list.value).any(|name| name.value == place);
        arm.is_some_and(|arm| names(&arm.object.takes_from) && names(&arm.object.hands_to))
    }

    /// An arm that gives to and takes from the same place would move its parts in a circle, unless the layout says that it
    /// does both, as at a mill.
    fn round_trips(&mut self, line: &connect::Line, connected: &Connected) {
        let given: HashSet<(usize, usize)> =
            line.proposals.iter().filter(|p| p.arm == p.from).map(|p| (p.from, p.to)).collect();
        let edges: HashSet<(usize, usize)> = connected.edges().iter().map(|e| (e.from, e.to)).collect();
        for edge in connected.edges() {
            let is_both = given.contains(&(edge.from, edge.to)) && edges.contains(&(edge.to, edge.from));
            if is_both
                && !self.names_both(line.nodes[edge.from].name.as_str(), line.nodes[edge.to].name.as_str())
            {
                let (arm, place) = (&line.nodes[edge.from], &line.nodes[edge.to]);
                collect(
                    &mut self.diagnostics,
                    Diagnostic::new(
                        "E0504",
                        arm.span,
                        format!("`{}` would give parts to `{}` and take them back", arm.name, place.name),
                    )
                    .other(place.span, "accepts and offers within reach of the same arm")
                    .help(format!(
                        "if `{arm}` should do both, as at a mill, name \"{place}\" in both: \"takes_from\": [\"{place}\", ...] \
                         and \"hands_to\": [\"{place}\", ...] in `{arm}`; if not, leave it out of one of them, and \
                         name there all others that it is for",
                        arm = arm.name,
                        place = place.name
                    )),
                );
            }
        }
    }

    fn nobody_to_refer_to(&mut self) {
        for (index, interface) in self.model.interfaces.iter().enumerate() {
            if !self.members[index].is_empty() {
                continue;
            }
            let id = InterfaceId(index);
            let is_ref = |ty: &ir::Type| ty.scalar == ir::Scalar::Ref(id);
            let user = self.model.automata.iter().find(|a| a.locals.iter().any(|l| is_ref(&l.ty)));
            let in_cell = (self.model.interfaces.iter().zip(&self.members))
                .any(|(i, members)| !members.is_empty() && i.cells.iter().any(|c| is_ref(&c.ty)));
            if user.is_some() || in_cell {
                let place = Span::new(self.layout.file, 0, 0);
                collect(
                    &mut self.diagnostics,
                    Diagnostic::new(
                        "E0505",
                        place,
                        format!("the layout has no `{}`, to which others refer", interface.name),
                    )
                    .help(format!("add a robot whose automaton `is {}`", interface.name)),
                );
            }
        }
    }

    fn cardinality(&mut self, robot: usize, role: &Role, rows: &[usize]) {
        if rows.len() >= role.min && role.max.is_none_or(|max| rows.len() <= max) {
            return;
        }
        let wanted = match role.max {
            Some(max) if max == role.min => format!("{max}"),
            Some(max) => format!("{} to {max}", role.min),
            None => format!("{} or more", role.min),
        };
        let object = &self.robots[robot].object;
        let members = &self.members[role.interface.0];
        let names: Vec<&str> =
            rows.iter().map(|row| self.robots[members[*row]].object.name.value.as_str()).collect();
        let found = if names.is_empty() { "none".to_string() } else { names.join(", ") };
        collect(
            &mut self.diagnostics,
            Diagnostic::new(
                "E0506",
                object.name.span,
                format!("`{}` needs {wanted} `{}`, and has {found}", object.name.value, role.name),
            )
            .other(role.place, "the role is declared here")
            .help("add or move machines, or restrict the role with \"takes_from\" or \"hands_to\""),
        );
    }

    fn requirements(&mut self, system: &System) {
        let mut executor = Executor::without_values(system);
        for robot in 0..self.robots.len() {
            for require in &system.automaton_of(robot).requires {
                if !executor.holds(robot, &require.condition) {
                    let text = require.text.iter().map(|part| match part {
                        TextPart::Words(words) => words.clone(),
                        TextPart::Value(expr) => system.shown_value(expr.ty, executor.value(robot, expr)),
                    });
                    let text: String = text.collect();
                    let object = &self.robots[robot].object;
                    collect(
                        &mut self.diagnostics,
                        Diagnostic::new(
                            "E0507",
                            object.name.span,
                            format!("`{}`: {text}", object.name.value),
                        )
                        .other(require.place, "required here")
                        .help("change the parameters or the layout so that the requirement holds"),
                    );
                }
            }
        }
    }
}
