use super::*;
use crate::diagnostic::render;
use crate::source::Sources;
use annotate_snippets::Renderer;
use runtime_sim::point::{Axis, Point};
use std::collections::BTreeSet;

#[path = "../../../tests/src/machines.rs"]
mod machines;

/// A layout with the spans of all its numbers, a line of text for each machine.
struct Builder {
    text: String,
    sources: Sources,
    nodes: Vec<Node>,
    proposals: Vec<Proposal>,
    kinds: Vec<(String, f64)>,
}

/// Heights of the parts of the ARIAC 2021 line.
const KINDS: [(&str, f64); 4] = [("battery", 0.053), ("sensor", 0.064), ("regulator", 0.065), ("pump", 0.11)];
const AGV_X: f64 = -2.265685;
const AGV_Y: [f64; 4] = [4.675404, 1.367643, -1.333917, -4.696062];

impl Builder {
    fn new() -> Self {
        Self {
            text: String::from("accepts at\n"),
            sources: Sources::default(),
            nodes: Vec::new(),
            proposals: Vec::new(),
            kinds: KINDS.map(|(name, height)| (name.to_string(), height)).to_vec(),
        }
    }

    fn add(&mut self, name: &str, placed: Placed) -> usize {
        let file = crate::source::FileId(0);
        let start = self.text.len();
        self.text.push_str(name);
        let mut numbers = Vec::new();
        for (path, value) in placed.numbers() {
            self.text.push_str(&format!(" {path}: "));
            let at = self.text.len();
            self.text.push_str(&value.to_string());
            numbers.push(Number { path, value, span: Span::new(file, at, self.text.len()) });
        }
        let span = Span::new(file, start, self.text.len());
        self.text.push('\n');
        let is_source = placed.device.has("source");
        let is_destination = placed.device.has("orders");
        self.nodes.push(Node { name: name.into(), span, placed, numbers, is_source, is_destination });
        self.nodes.len() - 1
    }

    fn belt(&mut self, name: &str, x: f64) -> usize {
        let pose = Point::new(x, 0.0, 0.0);
        self.add(name, machines::belt(pose, Axis::Y, [-5.0, 5.0]))
    }

    fn kitting(&mut self, name: &str, half: f64) -> usize {
        let pose = Point::new(-1.3, 0.0, 1.127);
        self.add(name, machines::rail_arm(pose, Axis::Y, [-half, half]))
    }

    fn agv(&mut self, name: &str, x: f64, y: f64) -> usize {
        let destinations = [Point::new(-5.6, y, 0.0), Point::new(-10.590274, y, 0.0)];
        self.add(name, machines::vehicle(Point::new(x, y, 0.0), destinations))
    }

    fn gantry(&mut self, name: &str) -> usize {
        let pose = Point::new(-4.0, 0.0, 2.0);
        self.add(name, machines::gantry(pose, [-14.4, 0.4], [-4.5, 4.5]))
    }

    fn station(&mut self, name: &str, x: f64, y: f64) -> usize {
        self.add(name, machines::station(Point::new(x, y, 0.0)))
    }

    fn propose(&mut self, from: usize, to: usize, arm: usize, site: (&str, Option<usize>, f64)) {
        let (name, index, approach) = site;
        let site = Site { name: name.into(), index, capacity: 12, approach };
        let rule = Span::new(crate::source::FileId(0), 0, 10);
        self.proposals.push(Proposal { from, to, arm, site, rule, is_named: false });
    }

    /// Every pair of types that hand over to each other.
    fn propose_all(&mut self) {
        let kinds: Vec<String> = self.nodes.iter().map(|node| node.placed.device.name.clone()).collect();
        for (from, a) in kinds.iter().enumerate() {
            for (to, b) in kinds.iter().enumerate() {
                match (a.as_str(), b.as_str()) {
                    ("belt", "rail_arm") => self.propose(from, to, to, ("pick_zone", None, 0.1)),
                    ("rail_arm", "vehicle") => self.propose(from, to, from, ("stops", Some(0), 0.5)),
                    ("vehicle", "gantry") => self.propose(from, to, to, ("stops", Some(1), 0.1)),
                    ("gantry", "station") => self.propose(from, to, from, ("places", None, 0.1)),
                    _ => {}
                }
            }
        }
    }

    fn line(&mut self) -> Line {
        let file = self.sources.add("layout.json", self.text.clone());
        Line {
            span: Span::new(file, 0, 0),
            nodes: self.nodes.clone(),
            proposals: self.proposals.clone(),
            withheld: Vec::new(),
            kinds: self.kinds.clone(),
        }
    }

    fn check(&mut self) -> (Line, Report) {
        let line = self.line();
        let report = check(&line);
        (line, report)
    }

    fn rendered(&self, report: &Report) -> String {
        render(&self.sources, &report.diagnostics, &Renderer::plain())
    }
}

fn with(half_rail: f64, agvs: &[(f64, f64)], stations: &[(f64, f64)]) -> Builder {
    let mut builder = Builder::new();
    builder.belt("conveyor", -0.573076);
    builder.kitting("kitting_robot", half_rail);
    for (i, (x, y)) in agvs.iter().enumerate() {
        builder.agv(&format!("agv{}", i + 1), *x, *y);
    }
    builder.gantry("gantry_robot");
    for (i, (x, y)) in stations.iter().enumerate() {
        builder.station(&format!("as{}", i + 1), *x, *y);
    }
    builder.propose_all();
    builder
}

const STATIONS: [(f64, f64); 4] = [(-7.3, 3.0), (-12.3, 3.0), (-7.3, -3.0), (-12.3, -3.0)];

fn default_agvs() -> [(f64, f64); 4] {
    AGV_Y.map(|y| (AGV_X, y))
}

fn names(line: &Line, nodes: &[usize]) -> Vec<String> {
    nodes.iter().map(|n| line.nodes[*n].name.clone()).collect()
}

/// Name of both ends of each edge, with its margin.
fn margins(line: &Line, report: &Report) -> Vec<(String, String, f64)> {
    let name = |n: usize| line.nodes[n].name.clone();
    report.edges.iter().map(|edge| (name(edge.from), name(edge.to), edge.margin)).collect()
}

fn failure<'a>(line: &Line, report: &'a Report, from: &str, to: &str) -> &'a Failure {
    report
        .failures
        .iter()
        .find(|f| {
            let pair = &line.proposals[f.proposal];
            line.nodes[pair.from].name == from && line.nodes[pair.to].name == to
        })
        .unwrap()
}

/// The same layout after the suggestion, or short of it by some millimetres.
fn changed_line(line: &Line, suggestion: &Suggestion, short_mm: i32) -> Line {
    let mut line = line.clone();
    let value = suggestion.present
        + f64::from(suggestion.change_mm - suggestion.change_mm.signum() * short_mm) / 1000.0;
    let node = &mut line.nodes[suggestion.node];
    let number = node.placed.numbers().iter().position(|(path, _)| *path == suggestion.path).unwrap();
    node.placed = node.placed.with_number(number, (value * 1e9).round() / 1e9).unwrap();
    line
}

fn has_edge(report: &Report, proposal: &Proposal) -> bool {
    report.edges.iter().any(|edge| edge.from == proposal.from && edge.to == proposal.to)
}

fn assert_change_is_least(line: &Line, failure: &Failure, suggestion: &Suggestion) {
    let proposal = &line.proposals[failure.proposal];
    assert!(has_edge(&check(&changed_line(line, suggestion, 0)), proposal), "{suggestion:?}");
    assert!(!has_edge(&check(&changed_line(line, suggestion, 1)), proposal), "{suggestion:?}");
}

#[test]
fn default_layout_has_thirteen_edges() {
    let (line, report) = with(4.8, &default_agvs(), &STATIONS).check();
    assert!(report.diagnostics.is_empty() && report.failures.is_empty());
    assert!(report.unreachable.is_empty() && report.dead_ends.is_empty());
    let margins = margins(&line, &report);
    assert_eq!(margins.len(), 13);
    for (from, to, margin) in &margins {
        let (low, high) = match (from.as_str(), to.as_str()) {
            ("conveyor", "kitting_robot") => (0.26, 0.6),
            // The outer slots of agv1 and agv4 are 55 and 76 mm past the ends of the rail.
            ("kitting_robot", "agv1" | "agv4") => (0.260, 0.264),
            ("kitting_robot", _) => (0.264, 0.270),
            (_, "gantry_robot") => (0.08, 0.10),
            ("gantry_robot", _) => (0.3, 0.6),
            other => panic!("{other:?}"),
        };
        assert!((low..high).contains(margin), "{from} to {to}: {margin}");
    }
    let connected = report.connected().unwrap();
    let [conveyor, kitting, agv1, agv2, gantry, as4] = [0, 1, 2, 3, 6, 10];
    assert!(connected.reaches(conveyor, as4) && connected.reaches(agv1, as4));
    assert!(!connected.reaches(agv1, agv2) && !connected.reaches(as4, conveyor));
    assert_eq!(connected.targets(kitting).collect::<Vec<_>>(), [2, 3, 4, 5]);
    assert_eq!(connected.origins(gantry).collect::<Vec<_>>(), [2, 3, 4, 5]);
}

#[test]
fn spaced_layout_has_little_room_at_the_outer_row() {
    let agvs = [4.2, 0.9, -0.9, -4.2].map(|y| (-2.5, y));
    let (line, report) = with(4.8, &agvs, &STATIONS).check();
    assert_eq!(report.edges.len(), 13);
    for (_, to, margin) in margins(&line, &report).iter().filter(|m| m.0 == "kitting_robot") {
        assert!((0.04..0.09).contains(margin), "{to}: {margin}");
    }
}

#[test]
fn short_rail_misses_the_outer_vehicles() {
    let mut builder = with(2.75, &default_agvs(), &STATIONS);
    let (line, report) = builder.check();
    assert_eq!(names(&line, &report.unreachable), ["agv1", "agv4"]);
    assert!(report.dead_ends.is_empty());
    assert_eq!(report.edges.len(), 11);
    let misses = &failure(&line, &report, "kitting_robot", "agv1").misses;
    assert_eq!(misses.len(), 96);
    let best = misses.last().unwrap().missing_mm;
    assert!((535.0..550.0).contains(&best), "{best}");
    assert!(misses.windows(2).all(|m| m[0].missing_mm >= m[1].missing_mm));
    let codes: Vec<_> = report.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["E0401", "E0401"]);
    for failure in &report.failures {
        assert_change_is_least(&line, failure, failure.suggestion.as_ref().unwrap());
    }
}

/// Moved away from the kitting robot: first its outer rows are out of reach, then all of it.
#[test]
fn vehicle_moved_away() {
    for (by, partly) in [(0.5, true), (1.0, false)] {
        let mut agvs = default_agvs();
        agvs[0].0 -= by;
        let mut builder = with(4.8, &agvs, &STATIONS);
        let (line, report) = builder.check();
        assert_eq!(names(&line, &report.unreachable), ["agv1"]);
        assert_eq!(report.failures.len(), 1);
        let failure = &report.failures[0];
        assert_eq!(failure.tested, 96);
        assert_eq!(failure.misses.len() < failure.tested, partly, "{}", failure.misses.len());
        let suggestion = failure.suggestion.as_ref().unwrap();
        assert_eq!(suggestion.connected, line.nodes.len());
        assert_change_is_least(&line, failure, suggestion);
        let text = builder.rendered(&report);
        for part in [
            "E0401",
            "kitting_robot cannot hand over to agv1",
            "slot ",
            "no item gets to agv1",
            "set `pose[0]`",
        ] {
            assert!(text.contains(part), "{part} not in {text}");
        }
    }
}

/// Figure 2 of the paper: the same small line, the vehicle near the arm and too far from it.
#[test]
fn pair_of_figure_2() {
    let (_, near) = with(4.8, &[(AGV_X, 1.4)], &[STATIONS[0]]).check();
    assert!(near.is_feasible());
    let mut builder = with(4.8, &[(-3.6, 1.4)], &[STATIONS[0]]);
    let (line, far) = builder.check();
    assert!(!far.is_feasible());
    assert_eq!(names(&line, &far.unreachable), ["agv1", "gantry_robot", "as1"]);
    assert_eq!(names(&line, &far.dead_ends), ["conveyor", "kitting_robot"]);
    // One cause, said once.
    assert_eq!(far.diagnostics.len(), 1);
    let text = builder.rendered(&far);
    assert!(text.contains("no item gets to agv1, gantry_robot, as1"), "{text}");
    assert!(text.contains("no item from conveyor, kitting_robot ever leaves"), "{text}");
    let suggestion = far.failures[0].suggestion.as_ref().unwrap();
    assert_change_is_least(&line, &far.failures[0], suggestion);
    assert!(check(&changed_line(&line, suggestion, 0)).is_feasible());
}

#[test]
fn station_out_of_the_gantrys_reach() {
    let mut stations = STATIONS;
    stations[1].0 = -17.0;
    let mut builder = with(4.8, &default_agvs(), &stations);
    let (line, report) = builder.check();
    assert_eq!(names(&line, &report.unreachable), ["as2"]);
    assert_eq!(report.diagnostics.len(), 1);
    let suggestion = report.failures[0].suggestion.as_ref().unwrap();
    assert_change_is_least(&line, &report.failures[0], suggestion);
    assert!(builder.rendered(&report).contains("gantry_robot cannot hand over to as2"));
}

#[test]
fn source_without_a_way() {
    let mut builder = with(4.8, &default_agvs(), &STATIONS);
    let belt = builder.belt("conveyor2", 3.0);
    builder.propose(belt, 1, 1, ("pick_zone", None, 0.1));
    let (line, report) = builder.check();
    assert_eq!(names(&line, &report.dead_ends), ["conveyor2"]);
    assert_eq!(report.diagnostics.len(), 1);
    assert_eq!(report.diagnostics[0].code, "E0401");
    assert!(report.diagnostics[0].message.starts_with("kitting_robot cannot take from conveyor2"));
    assert_change_is_least(&line, &report.failures[0], report.failures[0].suggestion.as_ref().unwrap());
}

#[test]
fn machines_that_nobody_hands_over_to() {
    let mut builder = with(4.8, &default_agvs(), &STATIONS);
    builder.station("as5", -7.3, 0.0);
    builder.belt("conveyor2", 3.0);
    let (line, report) = builder.check();
    assert_eq!(names(&line, &report.unreachable), ["as5"]);
    assert_eq!(names(&line, &report.dead_ends), ["conveyor2"]);
    let messages: Vec<_> = report.diagnostics.iter().map(|d| (d.code, d.message.as_str())).collect();
    let expected = [("E0402", "nothing hands over to as5"), ("E0403", "conveyor2 hands over to nothing")];
    assert_eq!(messages, expected);
}

#[test]
fn layouts_without_source_or_destination() {
    let mut builder = Builder::new();
    builder.kitting("kitting_robot", 4.8);
    builder.agv("agv1", AGV_X, 1.4);
    builder.propose_all();
    let (_, report) = builder.check();
    let codes: Vec<_> = report.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["E0404", "E0405"]);
}

/// Two buffers that only hand over to each other.
#[test]
fn ring_that_no_item_enters_or_leaves() {
    let mut builder = with(4.8, &default_agvs(), &STATIONS);
    let arm = builder.kitting("kitting_robot2", 4.8);
    let agv = builder.agv("agv5", AGV_X, 0.0);
    builder.propose(arm, agv, arm, ("stops", Some(0), 0.5));
    builder.propose(agv, arm, arm, ("stops", Some(0), 0.5));
    let (_, report) = builder.check();
    let codes: BTreeSet<_> = report.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes.into_iter().collect::<Vec<_>>(), ["E0406", "E0407"]);
}

/// A pair that misses while both are connected otherwise is no error.
#[test]
fn failed_pair_that_nobody_needs() {
    let mut builder = with(4.8, &default_agvs(), &STATIONS);
    let arm = builder.kitting("kitting_robot2", 2.75);
    builder.propose(0, arm, arm, ("pick_zone", None, 0.1));
    for agv in 2..6 {
        builder.propose(arm, agv, arm, ("stops", Some(0), 0.5));
    }
    let (_, report) = builder.check();
    assert!(report.is_feasible(), "{}", builder.rendered(&report));
    assert_eq!(report.failures.len(), 2);
    assert!(report.failures.iter().all(|failure| failure.misses.is_empty()), "nobody asks for them");
}

/// The arm could be moved to the vehicle, but then it would leave the belt.
#[test]
fn no_change_that_parts_others() {
    let mut builder = Builder::new();
    builder.belt("conveyor", -0.1);
    builder.kitting("kitting_robot", 4.8);
    let agv = builder.agv("agv1", -2.9, 1.4);
    builder.gantry("gantry_robot");
    builder.station("as1", -7.3, 3.0);
    builder.propose_all();
    builder.nodes[agv].numbers.clear();
    let (_, report) = builder.check();
    assert_eq!(report.failures.len(), 1);
    assert_eq!(report.failures[0].suggestion, None);
    assert!(report.diagnostics[0].help.starts_with("no change of one number"), "{:?}", report.diagnostics);
}

/// A gantry so high that all eight pairs with it fail: one cause, one report, one number.
#[test]
fn gantry_that_reaches_nothing() {
    let mut builder = with(4.8, &default_agvs(), &STATIONS);
    let gantry = &mut builder.nodes[6];
    gantry.placed = gantry.placed.with_number(2, 5.0).unwrap();
    for number in gantry.numbers.iter_mut().filter(|number| number.path == "pose[2]") {
        number.value = 5.0;
    }
    let (line, report) = builder.check();
    assert_eq!(report.failures.len(), 8);
    assert_eq!(report.unreachable.len(), 5);
    assert_eq!(report.diagnostics.len(), 1, "{}", builder.rendered(&report));
    let notes = &report.diagnostics[0].notes;
    for node in ["gantry_robot", "as1", "as2", "as3", "as4"] {
        assert!(notes.iter().any(|n| n.starts_with("no item gets to ") && n.contains(node)), "{notes:?}");
    }
    assert!(notes.iter().any(|n| n.starts_with("out of reach as well: ") && n.contains("as4")), "{notes:?}");
    let suggestion = failure(&line, &report, "agv1", "gantry_robot").suggestion.as_ref().unwrap();
    assert_eq!((suggestion.path.as_str(), suggestion.joined.len()), ("pose[2]", 8));
    assert!(check(&changed_line(&line, suggestion, 0)).is_feasible());
}

/// Numbers drawn around the default layout, many of them near the limit of reach.
fn drawn(random: &mut Random) -> Builder {
    let mut agv = || {
        let x = match random.below(10) {
            0..5 => random.between(-2.575, -2.525),
            5..8 => random.between(-2.5, -2.1),
            _ => random.between(-3.4, -2.0),
        };
        (x, random.between(-4.7, 4.7))
    };
    let agvs: Vec<(f64, f64)> = if agv().1 > 0.0 { vec![agv()] } else { vec![agv(), agv()] };
    let rail = if random.below(5) == 0 { random.between(0.5, 4.8) } else { 4.8 };
    let far = random.below(6) == 0;
    let station = (if far { random.between(-17.5, -15.0) } else { -7.3 }, random.between(-5.0, 5.0));
    let mut builder = with(rail, &agvs, &[station]);
    if random.below(4) == 0 {
        builder.kinds.truncate(1);
    }
    builder
}

#[test]
fn random_layouts() {
    let mut random = Random(0x5EED);
    let (mut feasible, mut close, mut apart, mut suggestions, mut single) = (0, 0, 0, 0, 0);
    // The long form has 300: `AUTOGEN_CAMPAIGN=full`.
    let layouts = if std::env::var("AUTOGEN_CAMPAIGN").is_ok_and(|form| form == "full") { 300 } else { 100 };
    for _ in 0..layouts {
        let (line, report) = drawn(&mut random).check();
        feasible += usize::from(report.is_feasible());
        assert_eq!(report.is_feasible(), report.diagnostics.is_empty());
        assert_eq!(report.edges.len() + report.failures.len(), line.proposals.len());
        let mut is_close = false;
        for proposal in &line.proposals {
            let arm = line.nodes[proposal.arm].placed.arm().unwrap();
            let tools = tools(&line, proposal);
            is_close |= tools.iter().any(|tool| arm.margin(*tool).abs() < 0.02);
            let solved = tools.iter().filter(|tool| arm.solve(**tool, &arm.start()).is_some()).count();
            assert_eq!(solved == tools.len(), has_edge(&report, proposal));
        }
        close += usize::from(is_close);
        let is_between = |n: &usize| !line.nodes[*n].is_source && !line.nodes[*n].is_destination;
        let needed =
            (0..line.nodes.len()).filter(is_between).filter(|n| !gets_through(&report, &line, Some(*n)));
        let needed: BTreeSet<usize> = needed.filter(|_| gets_through(&report, &line, None)).collect();
        assert_eq!(report.single_points.iter().copied().collect::<BTreeSet<_>>(), needed);
        single += needed.len();
        for failure in &report.failures {
            apart += 1;
            let arm = line.nodes[line.proposals[failure.proposal].arm].placed.arm().unwrap();
            assert_eq!(failure.misses.is_empty(), report.is_feasible());
            for miss in &failure.misses {
                assert!(arm.solve(miss.tool, &arm.start()).is_none());
            }
            if let Some(suggestion) = &failure.suggestion {
                suggestions += 1;
                let after = check_edges(&changed_line(&line, suggestion, 0));
                let before = check_edges(&line);
                assert!(after[failure.proposal] && !before[failure.proposal]);
                assert!(before.iter().zip(&after).all(|(before, after)| !before || *after), "lost an edge");
                assert!(
                    !check_edges(&changed_line(&line, suggestion, 1))[failure.proposal],
                    "{suggestion:?}"
                );
                assert_eq!(flow::Flow::new(&line).served(&after).connected(), suggestion.connected);
            }
        }
    }
    #[expect(clippy::print_stdout, reason = "the figures of a test")]
    {
        println!("{feasible} feasible, {close} close, {apart} pairs apart, {suggestions} suggestions");
    }
    assert!(feasible * 10 >= layouts * 3, "{feasible} feasible");
    assert!(close * 10 >= layouts * 3, "{close} close");
    assert!(single * 10 >= layouts * 3, "{single} single points");
    assert!(suggestions * 10 >= apart * 9, "{suggestions} of {apart}");
}

/// Whether an item gets from some source to some destination, while one machine is at rest.
fn gets_through(report: &Report, line: &Line, stopped: Option<usize>) -> bool {
    let mut has: Vec<bool> = line.nodes.iter().map(|node| node.is_source).collect();
    for _ in &line.nodes {
        for edge in report.edges.iter().filter(|e| ![e.from, e.to].map(Some).contains(&stopped)) {
            has[edge.to] |= has[edge.from];
        }
    }
    line.nodes.iter().zip(has).any(|(node, has)| node.is_destination && has)
}

/// Poses of the tool, worked out anew.
fn tools(line: &Line, proposal: &Proposal) -> Vec<Point> {
    let passive = &line.nodes[if proposal.arm == proposal.from { proposal.to } else { proposal.from }];
    let places =
        passive.placed.handover(&proposal.site.name, proposal.site.index, 12, line.kinds.len()).unwrap();
    let heights = line.kinds.iter().flat_map(|kind| [kind.1, kind.1 + proposal.site.approach]);
    let heights: Vec<f64> = heights.collect();
    places.iter().flat_map(|place| heights.iter().map(|height| place.point.up(*height))).collect()
}

fn check_edges(line: &Line) -> Vec<bool> {
    line.proposals
        .iter()
        .map(|proposal| {
            let arm = line.nodes[proposal.arm].placed.arm().unwrap();
            tools(line, proposal).iter().all(|tool| arm.solve(*tool, &arm.start()).is_some())
        })
        .collect()
}

/// Xorshift64* by Marsaglia and Vigna.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() as f64 / (1u64 << 53) as f64)
    }

    fn below(&mut self, end: u64) -> u64 {
        self.next() % end
    }
}

/// Code and help of all that is told of a vehicle that is out of reach of the first arm, and that the list of
/// the second one, which reaches it, leaves out.
fn told_of_left_out(is_named: bool) -> Vec<(&'static str, String)> {
    let mut builder = with(1.0, &default_agvs()[..1], &STATIONS);
    let arm = builder.kitting("second_robot", 4.8);
    let (belt, vehicle) = (0, 2);
    builder.propose(belt, arm, arm, ("pick_zone", None, 0.1));
    builder.propose(arm, vehicle, arm, ("stops", Some(0), 0.5));
    let mut line = builder.line();
    let pair = line.proposals.pop().unwrap();
    line.withheld.push(Withheld { pair, list: line.nodes[arm].span });
    let failing = line.proposals.iter_mut().find(|pair| pair.to == vehicle).unwrap();
    failing.is_named = is_named;
    check(&line).diagnostics.into_iter().map(|told| (told.code, told.help)).collect()
}

#[test]
fn a_list_is_the_cause_unless_another_one_names_a_pair_that_does_not_meet() {
    let help = "add \"agv1\" to \"hands_to\" of second_robot";
    let told = told_of_left_out(false);
    // The first arm still hands over to nothing.
    assert!(told.iter().any(|(code, _)| *code == "E0401"), "{told:?}");
    assert!(told.contains(&("E0402", help.into())) && told.len() == 2, "{told:?}");
    let told = told_of_left_out(true);
    assert!(told.iter().any(|(code, _)| *code == "E0401"), "{told:?}");
    // The second arm still hands over to nothing.
    assert!(told.contains(&("E0403", help.into())) && told.len() == 2, "{told:?}");
}

#[test]
fn a_list_is_not_the_cause_where_items_would_go_in_a_circle() {
    let told = |is_named: bool| {
        let mut line = with(4.8, &default_agvs(), &STATIONS).line();
        let (arm, vehicle) = (1, 2);
        line.proposals.retain(|pair| pair.from != vehicle);
        let given = line.proposals.iter_mut().find(|pair| pair.to == vehicle).unwrap();
        given.is_named = is_named;
        let pair = Proposal { from: vehicle, to: arm, ..given.clone() };
        line.withheld.push(Withheld { pair, list: line.nodes[arm].span });
        let told = check(&line).diagnostics;
        told.into_iter().map(|told| format!("{} {}", told.code, told.help)).collect::<Vec<_>>()
    };
    assert_eq!(told(false), ["E0403 add a machine that takes from it, or remove it"]);
    assert_eq!(told(true), ["E0403 add \"agv1\" to \"takes_from\" of kitting_robot"]);
}
