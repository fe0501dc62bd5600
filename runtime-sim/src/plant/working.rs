//! A machine at work: its parts, and the head that commands them.

mod bearing;
mod parts;

use super::command::{Answer, Asked, Head};
use super::faults::Faults;
use super::idle::Idle;
use super::missed::{MissedCommands, Reason};
use super::phase::Phase;
use crate::device::error;
use crate::item::Items;
use crate::kinematics::arm::Joints;
use crate::kinematics::pose::Pose;
use crate::line::Line;
use crate::memory::Memory;
use crate::part::lane::Moving;
use crate::part::orders::Desk;
use crate::part::stroke::Carriage;
use crate::part::{Begun, Looks, Part, Primitive, Progress, Running, See, Start, World, milliseconds};
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use crate::wiring::{Await, Drives, Source, Wiring};
use std::ops::Range;
use std::sync::Arc;

/// A command, by its number among those of the wiring, and what it has awaited.
#[derive(Clone, Copy, Debug)]
pub struct WaitedInVain {
    pub command: usize,
    pub awaited: Await,
}

#[derive(Clone, Debug)]
pub struct Working {
    index: usize,
    pose: Point,
    wiring: Arc<Wiring>,
    /// None for those that do nothing; the one that works is taken out.
    parts: Vec<Option<Box<dyn Running>>>,
    head: Option<Head>,
    /// Where each input stands in the image.
    inputs: Vec<Range<usize>>,
    outputs: Vec<Range<usize>>,
    /// The parts of which commands ask something.
    commanded: Vec<usize>,
    /// Those, and the parts that jam.
    halting: Vec<usize>,
    /// The parts that serve.
    serving: Vec<usize>,
    /// In which the parts move on: processes first, as what they need has to be there when they start.
    order: Vec<usize>,
    /// Items that its grippers have taken.
    picks: u32,
    missed: MissedCommands,
    /// The last command that has waited for a signal too long, until somebody takes it.
    waited_in_vain: Option<WaitedInVain>,
    faults: Faults,
    pub(super) idle: Idle,
    pub(super) phase: Phase,
}

/// What all machines share.
pub struct Shared<'a> {
    /// At whose start it is.
    pub scan: u64,
    pub items: &'a mut Items,
    pub desk: &'a mut Desk,
    /// Start of the scan.
    pub now_ms: u64,
    /// Length of the scan.
    pub dt_ms: u64,
}

impl Shared<'_> {
    pub fn next_ms(&self) -> u64 {
        self.now_ms + self.dt_ms
    }
}

impl Working {
    /// At rest; the first order of a terminal open.
    pub fn new(
        line: &Line,
        index: usize,
        desk: &Desk,
        items: &mut Items,
        memory: &mut Memory,
    ) -> Result<Self, String> {
        let machine = &line.machines[index];
        let kinds = line.kinds.len();
        let mut commanded: Vec<usize> = machine.wiring.commands.iter().map(|command| command.part).collect();
        commanded.sort_unstable();
        commanded.dedup();
        let faults = Faults::new(line, index);
        let mut halting: Vec<usize> = commanded.iter().copied().chain(faults.jamming()).collect();
        halting.sort_unstable();
        halting.dedup();
        let refusals = line.scenario.refusals.iter().filter(|refusal| refusal.machine == index);
        let refusals = refusals.map(|refusal| refusal.command).collect();
        let answers = line.scenario.answers.iter().filter(|answer| answer.machine == index);
        let answers = answers.map(|answer| Answer {
            command: answer.command,
            late_ms: milliseconds(answer.late_s),
            error: answer.error,
        });
        let start = |(part, made): (usize, &Arc<Part>)| {
            made.primitive.start(&mut Start { line, machine: index, part, desk, items, memory })
        };
        let parts: Vec<Option<Box<dyn Running>>> =
            machine.parts.iter().enumerate().map(start).collect::<Result<_, _>>()?;
        let mut order: Vec<usize> = (0..parts.len()).collect();
        order.sort_by_key(|part| !matches!(machine.parts[*part].primitive, Primitive::Process(_)));
        let serves = |part: &usize| parts[*part].as_ref().is_some_and(|part| part.serves());
        Ok(Self {
            index,
            idle: Idle::new(&parts, faults.exist()),
            phase: Phase::default(),
            pose: machine.pose,
            serving: (0..parts.len()).filter(serves).collect(),
            order,
            picks: 0,
            missed: MissedCommands::default(),
            waited_in_vain: None,
            parts,
            head: Head::new(&machine.wiring, kinds, refusals, answers.collect()),
            inputs: ranges(machine.wiring.inputs.iter().map(|input| input.size.words(kinds))),
            outputs: ranges(machine.wiring.outputs.iter().map(|output| output.size.words(kinds))),
            wiring: machine.wiring.clone(),
            commanded,
            halting,
            faults,
        })
    }

    pub fn commands(&self) -> u32 {
        self.head.as_ref().map_or(0, Head::accepted)
    }

    pub fn picks(&self) -> u32 {
        self.picks
    }

    /// The command that has waited in vain for this signal of a part in this scan.
    pub fn take_waited_in_vain(&mut self, part: usize, signal: usize) -> Option<WaitedInVain> {
        self.waited_in_vain.take_if(|waited| (waited.awaited.part, waited.awaited.signal) == (part, signal))
    }

    /// Why the command ended that has waited in vain.
    pub fn note_missed(
        &mut self,
        WaitedInVain { command, awaited }: WaitedInVain,
        reason: Reason,
        at_ms: u64,
    ) {
        self.missed.add(self.wiring.commands[command].number, awaited.error, reason, at_ms);
    }

    pub fn missed(&self) -> &MissedCommands {
        &self.missed
    }

    /// Cycles of a process that have begun.
    pub fn cycles(&self, part: usize) -> u32 {
        self.parts.get(part).and_then(Option::as_ref).map_or(0, |part| part.cycles())
    }

    pub fn faults(&self) -> &Faults {
        &self.faults
    }

    /// Numbers of all inputs.
    pub fn input_words(&self) -> usize {
        self.inputs.last().map_or(0, |last| last.end)
    }

    pub fn see<'a>(&'a self, items: &'a Items, desk: &'a Desk) -> See<'a> {
        See { machine: self.index, parts: &self.parts, items, desk }
    }

    /// Lets a part work; none if it does nothing.
    fn with<T>(
        &mut self,
        part: usize,
        shared: &mut Shared,
        work: impl FnOnce(&mut dyn Running, &mut World) -> T,
    ) -> Option<T> {
        let mut taken = self.parts.get_mut(part)?.take()?;
        let mut world = World {
            machine: self.index,
            parts: &self.parts,
            items: shared.items,
            desk: shared.desk,
            now_ms: shared.now_ms,
            dt_ms: shared.dt_ms,
        };
        let result = work(taken.as_mut(), &mut world);
        self.parts[part] = Some(taken);
        Some(result)
    }

    fn abandon(&mut self, now_ms: u64) {
        self.each_commanded(|part| part.abandon(now_ms));
    }

    fn each_commanded(&mut self, work: impl Fn(&mut dyn Running)) {
        for part in &self.commanded {
            if let Some(part) = &mut self.parts[*part] {
                work(part.as_mut());
            }
        }
    }

    fn end(&mut self, error: i32, ends_ms: u64) {
        self.begin_phase();
        if let Some(head) = &mut self.head {
            head.end(error, ends_ms);
        }
    }

    /// The command with this number among those of the wiring has ended in error.
    fn fail(&mut self, command: usize, error: i32, ends_ms: u64) {
        let asked = &self.wiring.commands[command];
        let part = self.parts.get(asked.part).and_then(Option::as_ref);
        if error == error::UNREACHABLE
            && let Some(missed) = part.and_then(|part| part.missed())
        {
            let reason = Reason { what: missed.to_string(), details: String::new() };
            self.missed.add(asked.number, error, reason, ends_ms);
        }
        self.end(error, ends_ms);
    }

    /// Takes a command and all levels.
    pub fn obey(&mut self, outputs: &[f64], shared: &mut Shared) {
        self.command(outputs, shared);
        self.halt(shared);
        for (index, range) in self.outputs.iter().enumerate() {
            if let Drives::Level { part, level } = self.wiring.outputs[index].drives
                && let Some(part) = &mut self.parts[part]
            {
                part.level(level, &outputs[range.clone()]);
            }
        }
    }

    fn command(&mut self, outputs: &[f64], shared: &mut Shared) {
        let Some(head) = &mut self.head else { return };
        let before = head.part_at_work();
        match head.accept(outputs, shared.next_ms()) {
            Asked::Nothing => {}
            Asked::Refused => self.abandon(shared.now_ms),
            Asked::Withdrawn => self.each_commanded(|part| part.lose_command(shared.now_ms)),
            Asked::Start(command) => self.begin(command, before, outputs, shared),
        }
        if let Some(head) = &mut self.head {
            head.held = head.is_held_by(outputs);
        }
    }

    /// What the command holds, and what jams.
    fn halt(&mut self, shared: &Shared) {
        let is_held = self.head.as_ref().is_some_and(|head| head.held);
        for number in &self.halting {
            let is_jammed = self.faults.is_jammed(*number, shared.scan);
            if let Some(part) = &mut self.parts[*number] {
                part.hold(is_jammed || is_held && self.commanded.contains(number), shared.now_ms);
            }
        }
    }

    fn begin(&mut self, command: usize, before: Option<usize>, outputs: &[f64], shared: &mut Shared) {
        let wiring = self.wiring.clone();
        let asked = &wiring.commands[command];
        if let Some(other) = before.filter(|before| *before != asked.part)
            && let Some(other) = &mut self.parts[other]
        {
            other.abandon(shared.now_ms);
        }
        let words = asked.arguments.iter().flat_map(|output| &outputs[self.outputs[*output].clone()]);
        let arguments: Vec<f64> = words.copied().collect();
        let begun = self.with(asked.part, shared, |part, world| part.begin(asked.action, &arguments, world));
        match begun.unwrap_or(Err(error::REFUSED)) {
            Ok(Begun::UnderWay) => {
                if let Some(head) = &mut self.head {
                    head.start(command);
                }
            }
            Ok(Begun::Ended) => self.end(error::NONE, shared.next_ms()),
            Err(error) => {
                self.abandon(shared.now_ms);
                self.fail(command, error, shared.next_ms());
            }
        }
    }

    /// As [`Running::next_change`], of all parts and of the head.
    pub fn next_change(&self, items: &Items, desk: &Desk, now_ms: u64) -> f64 {
        let see = self.see(items, desk);
        let head = self.head.as_ref().map_or(f64::INFINITY, |head| head.next_change(now_ms));
        let head = if self.awaited(&see) == Some(true) { now_ms as f64 } else { head };
        self.running().map(|part| part.next_change(&see, now_ms)).fold(head, f64::min)
    }

    /// An item that a level has let go.
    pub fn let_go(&mut self) -> Option<usize> {
        self.parts.iter_mut().flatten().find_map(|part| part.let_go())
    }

    pub fn advance(&mut self, shared: &mut Shared) {
        if let Some(head) = self.head.as_mut().filter(|head| !head.held) {
            head.wait(shared.dt_ms);
        }
        for number in 0..self.parts.len() {
            let part = self.order[number];
            let Some(progress) = self.with(part, shared, |part, world| part.advance(world)) else { continue };
            let Some(head) = self.head.as_mut().filter(|head| !head.held) else { continue };
            let Some((command, _)) = head.acting().filter(|(_, command)| command.part == part) else {
                continue;
            };
            match progress {
                Progress::Going => {}
                Progress::Reached => {
                    head.reach(shared.next_ms());
                    self.begin_phase();
                }
                Progress::Failed(error) => {
                    self.abandon(shared.next_ms());
                    self.fail(command, error, shared.next_ms());
                }
            }
        }
    }

    /// Whether one of its surfaces moves, or a number that it shows changes all the while.
    pub fn flows(&self, now_ms: u64) -> bool {
        let flows = |part: &dyn Running| part.flows() || part.lane().is_some_and(Moving::is_moving);
        !self.is_idle() && (self.running().any(flows) || self.strokes(now_ms))
    }

    /// Whether something moves what is on it along a stroke.
    fn strokes(&self, now_ms: u64) -> bool {
        let moves =
            |carriage: &dyn Carriage| carriage.stroking(now_ms).is_some_and(|stroking| stroking.moves());
        self.running().filter_map(|part| part.carriage()).any(moves)
    }

    /// All grippers that look for an item.
    pub fn looks(&self) -> impl Iterator<Item = Looks> {
        let running = self.running().filter(|_| !self.is_idle());
        running.filter_map(|part| part.looks())
    }

    /// The highest speed of what its parts carry along, m/s; infinity for what moves along a stroke.
    pub fn speed(&self, now_ms: u64) -> f64 {
        if self.is_idle() {
            return 0.0;
        }
        if self.strokes(now_ms) {
            return f64::INFINITY;
        }
        let speed = |part: &dyn Running| {
            part.trajectory(now_ms).speed().max(part.lane().map_or(0.0, Moving::top_speed))
        };
        self.running().map(speed).fold(0.0, f64::max)
    }

    pub fn tool_goes(&self, chain: usize, from: f64, to: f64) -> f64 {
        self.parts.get(chain).and_then(Option::as_ref).map_or(0.0, |chain| chain.tool_goes(from, to))
    }

    /// Where the tool of a chain is at a time, s, as it moves now; none if that is not known.
    pub fn tool_at(&self, chain: usize, time: f64) -> Option<Point> {
        self.parts.get(chain)?.as_ref()?.tool_at(time)
    }

    /// An item that slips by the end of the scan.
    pub fn slip(&mut self, next_ms: u64) -> Option<usize> {
        if self.is_idle() {
            return None;
        }
        self.parts.iter_mut().flatten().find_map(|part| part.slip(next_ms))
    }

    /// Where a part looks for an item in this scan, and how near it has to be, m.
    pub fn seeks(&self, part: usize, see: &See, now_ms: u64, next_ms: u64) -> Option<(Pose, f64)> {
        if self.head.as_ref().is_some_and(Head::is_in_vain) {
            return None;
        }
        self.parts.get(part)?.as_ref()?.seeks(see, now_ms, next_ms)
    }

    pub fn meets(&mut self, part: usize, item: Option<usize>, now_ms: u64, next_ms: u64) -> Option<usize> {
        let pick = self.picks.saturating_add(1);
        let taken = self.parts.get_mut(part)?.as_mut()?.meets(item, pick, now_ms, next_ms)?;
        self.picks = pick;
        Some(taken)
    }

    /// Ends a command that has waited for a signal, once it is known; then answers that were late are given.
    pub fn settle(&mut self, shared: &mut Shared) {
        let next_ms = shared.next_ms();
        if let Some(is_there) = self.awaited(&self.see(shared.items, shared.desk))
            && let Some((awaited, waited_ms)) = self.head.as_ref().and_then(Head::awaits)
        {
            if is_there {
                self.end(error::NONE, next_ms);
            } else if waited_ms >= awaited.within_ms {
                let command = self.head.as_ref().filter(|head| !head.is_in_vain()).and_then(Head::command);
                self.waited_in_vain = command.map(|command| WaitedInVain { command, awaited });
                self.end(awaited.error, next_ms);
            }
        }
        if let Some(head) = &mut self.head {
            head.publish(next_ms);
        }
    }

    /// Whether the signal is there that the command waits for; none if it waits for none, or is held.
    fn awaited(&self, see: &See) -> Option<bool> {
        let (awaited, _) = self.head.as_ref().filter(|head| !head.held)?.awaits()?;
        let mut word = [0.0];
        if let Some(part) = &self.parts[awaited.part] {
            part.signal(awaited.signal, see, &mut word);
        }
        Some(word[0] != 0.0 && !self.head.as_ref()?.is_in_vain())
    }

    pub fn serve(&mut self, shared: &mut Shared) {
        for number in 0..self.serving.len() {
            self.with(self.serving[number], shared, |part, world| part.serve(world));
        }
    }

    pub fn withdraw(&mut self, shared: &mut Shared) {
        for number in 0..self.serving.len() {
            self.with(self.serving[number], shared, |part, world| part.withdraw(world));
        }
    }

    pub fn write(&self, image: &mut [f64], items: &Items, desk: &Desk) {
        let see = self.see(items, desk);
        for (input, range) in self.wiring.inputs.iter().zip(&self.inputs) {
            let words = &mut image[range.clone()];
            match (input.source, &self.head) {
                (Source::Signal { part, signal }, _) => {
                    if let Some(part) = &self.parts[part] {
                        part.signal(signal, &see, words);
                    }
                }
                (source, Some(head)) => words[0] = head.word(source).unwrap_or(0.0),
                (_, None) => {}
            }
        }
    }

    fn running(&self) -> impl Iterator<Item = &dyn Running> {
        self.parts.iter().flatten().map(|part| part.as_ref())
    }

    /// Where it is: the tool of an arm, the position of a vehicle, the pose of what does not move.
    pub fn position(&self) -> Point {
        self.running().find_map(|part| part.position()).unwrap_or(self.pose)
    }

    pub fn joints(&self) -> Option<Joints> {
        self.running().find_map(|part| part.joints())
    }

    pub fn trajectory(&self, now_ms: u64) -> Trajectory {
        if self.is_idle() {
            return Trajectory::Rests;
        }
        let mut trajectories = self.running().map(|part| part.trajectory(now_ms));
        trajectories.find(|trajectory| *trajectory != Trajectory::Rests).unwrap_or(Trajectory::Rests)
    }

    pub fn open_order(&self) -> Option<usize> {
        self.running().find_map(|part| part.open_order())
    }

    pub fn orders_to_open(&self, desk: &Desk) -> usize {
        self.running().map(|part| part.orders_to_open(desk)).sum()
    }

    /// Something will change even if no output does.
    pub fn is_busy(&self, items: &Items, desk: &Desk, scan: u64, now_ms: u64) -> bool {
        if self.is_idle() {
            return false;
        }
        let see = self.see(items, desk);
        let is_jammed =
            |head: &Head| head.acting().is_some_and(|(_, command)| self.faults.is_jammed(command.part, scan));
        self.head.as_ref().is_some_and(|head| head.is_under_way() && !head.held && !is_jammed(head))
            || self
                .running()
                .any(|part| part.is_busy(&see) || part.trajectory(now_ms).comes_to_rest(now_ms as f64))
    }
}

fn ranges(sizes: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    let mut begin = 0;
    let range = |size| {
        let range = begin..begin + size;
        begin = range.end;
        range
    };
    sizes.map(range).collect()
}
