//! Which items get to what works on them along a conveyor, or takes them off it. All places are from the beginning of the
//! conveyor, m.

use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::part::lane::{CentreLine, Lane};
use std::f64::consts::PI;

/// Rounding of a place, m.
const SAME: f64 = 1e-6;

pub struct Along<'a> {
    line: &'a Line,
    /// Of kinds that never lie on other items or are parts of them: where these are says where they are.
    alone: Vec<bool>,
}

/// A process on a lane, a diverter or a pusher.
pub struct Beside {
    pub lane: usize,
    pub at: f64,
    /// Where the middle of an item is on which it acts.
    pub middles: [f64; 2],
}

/// Why no item of a kind gets to it.
pub enum Missed {
    /// Items come onto the lane here at the earliest, behind it.
    Behind(f64),
    /// They leave the lane here, before it: by this part, or at its end.
    Before(f64, Option<usize>),
}

impl<'a> Along<'a> {
    pub fn new(line: &'a Line) -> Self {
        let bears = line.kinds.iter().any(|kind| kind.deck.is_some());
        let mut alone = vec![!bears; line.kinds.len()];
        let processes = line.machines.iter().flat_map(|machine| machine.processes());
        for joined in processes.flat_map(|(_, process)| &process.joins) {
            if let Some(kind) = line.kinds.iter().position(|kind| kind.name == *joined) {
                alone[kind] = false;
            }
        }
        Self { line, alone }
    }

    /// Of a machine and part, as it acts on items of a kind; none for any other part.
    pub fn beside(&self, (machine, part): (usize, usize), kind: usize) -> Option<Beside> {
        let parts = &self.line.machines[machine].parts;
        let half = |lane: usize| match &parts[lane].primitive {
            Primitive::Lane(lane) => lane.lengths_of(self.line.kinds[kind].size)[0] / 2.0,
            _ => 0.0,
        };
        let (lane, at, middles) = match &parts[part].primitive {
            Primitive::Process(process) => {
                let (lane, at) = (process.on, process.at?);
                (lane, at, [at - half(lane), at + half(lane)])
            }
            Primitive::Diverter(diverter) => {
                let (lane, at) = (diverter.lane, diverter.at);
                (lane, at, [at - half(lane); 2])
            }
            Primitive::Pusher(pusher) => {
                let (lane, at, half) = (pusher.lane, pusher.at, pusher.width / 2.0);
                (lane, at, [at - half, at + half])
            }
            _ => return None,
        };
        let anywhere = [f64::NEG_INFINITY, f64::INFINITY];
        Some(Beside { lane, at, middles: if self.alone[kind] { middles } else { anywhere } })
    }

    /// Where an item is at the earliest when this acts on it whose middle comes onto the lane of this machine at `first`.
    pub fn reached(&self, beside: &Beside, machine: usize, first: f64) -> Result<f64, Missed> {
        let [low, high] = beside.middles;
        let (last, sink) = self.leaves(machine, beside.lane);
        if first > high + SAME {
            Err(Missed::Behind(first))
        } else if low > last - SAME {
            Err(Missed::Before(last, sink))
        } else {
            Ok(first.max(low))
        }
    }

    /// Whether what comes to the end of a lane may fall onto its beginning: on an arc of more than half a circle.
    pub fn may_close(&self, machine: usize, lane: usize) -> bool {
        let Primitive::Lane(Lane { centre_line: CentreLine::Arc { length, radius, .. }, .. }) =
            self.line.machines[machine].parts[lane].primitive
        else {
            return false;
        };
        length > PI * radius.abs() && self.leaves(machine, lane).1.is_none()
    }

    /// Where the middle of an item leaves a lane, and the part of the machine that is the sink there.
    fn leaves(&self, machine: usize, lane: usize) -> (f64, Option<usize>) {
        let parts = &self.line.machines[machine].parts;
        let length = match &parts[lane].primitive {
            Primitive::Lane(Lane { centre_line, .. }) => centre_line.length(),
            _ => f64::INFINITY,
        };
        let sink = parts.iter().enumerate().find_map(|(number, part)| match &part.primitive {
            Primitive::Sink(sink) if sink.lane == lane => Some((length - sink.inset, Some(number))),
            _ => None,
        });
        sink.unwrap_or((length, None))
    }
}
