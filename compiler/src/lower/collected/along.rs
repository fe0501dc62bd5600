//! Which items get to what works on them along a conveyor, or takes them off it. All places are from the beginning of the
//! conveyor, m.

use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::part::lane::Lane;

/// Rounding of a place, m.
const SAME: f64 = 1e-6;

/// A process on a lane, a diverter or a pusher.
pub struct Beside {
    pub lane: usize,
    pub at: f64,
    /// Where the middle of an item is on which it acts.
    middles: [f64; 2],
}

/// Why no item of a kind gets to it.
pub enum Missed {
    /// Items come onto the lane here at the earliest, behind it.
    Behind(f64),
    /// They leave the lane here, before it: by this part, or at its end.
    Before(f64, Option<usize>),
}

impl Beside {
    /// Of a machine and part, as it acts on items of a kind; none for any other part.
    pub fn of(line: &Line, (machine, part): (usize, usize), kind: usize) -> Option<Self> {
        let parts = &line.machines[machine].parts;
        let half = |lane: usize| match &parts[lane].primitive {
            Primitive::Lane(lane) => lane.lengths_of(line.kinds[kind].size)[0] / 2.0,
            _ => 0.0,
        };
        match &parts[part].primitive {
            Primitive::Process(process) => {
                let (lane, at) = (process.on, process.at?);
                Some(Self { lane, at, middles: [at - half(lane), at + half(lane)] })
            }
            Primitive::Diverter(diverter) => {
                let (lane, at) = (diverter.lane, diverter.at);
                Some(Self { lane, at, middles: [at - half(lane); 2] })
            }
            Primitive::Pusher(pusher) => {
                let (lane, at, half) = (pusher.lane, pusher.at, pusher.width / 2.0);
                Some(Self { lane, at, middles: [at - half, at + half] })
            }
            _ => None,
        }
    }

    /// Where an item is at the earliest when this acts on it whose middle comes onto the lane of this machine at `first`.
    pub fn reached(&self, line: &Line, machine: usize, first: f64) -> Result<f64, Missed> {
        let [low, high] = self.middles;
        let (last, sink) = leaves(line, machine, self.lane);
        if first > high + SAME {
            Err(Missed::Behind(first))
        } else if low > last + SAME {
            Err(Missed::Before(last, sink))
        } else {
            Ok(first.max(low))
        }
    }
}

/// Where the middle of an item leaves a lane, and the part of the machine that is the sink there.
fn leaves(line: &Line, machine: usize, lane: usize) -> (f64, Option<usize>) {
    let parts = &line.machines[machine].parts;
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
