//! The vehicle of the library as one would write it by hand, without tables, references or generated names.

use controllers::agv::{Inputs, Parameters};
use controllers::cells::{DemandCells, SourceCells, TrayCells};
use controllers::kinds::Slot;
use controllers::types::{Point, next_command};

#[derive(Clone, Copy, Debug)]
enum State {
    Start,
    Loading,
    Moving,
    Dropping,
    Returning,
}

#[derive(Clone, Debug)]
pub struct Vehicle {
    state: State,
    next: usize,
    capacity: usize,
    unloads_at: usize,
    stops: [Point; 3],
    offsets: [Point; 12],
    pub cmd: i32,
    pub verb: i32,
    pub goal: Point,
}

impl Vehicle {
    pub fn new(parameters: &Parameters) -> Self {
        Self {
            state: State::Start,
            next: 0,
            capacity: parameters.capacity as usize,
            unloads_at: parameters.unloads_at as usize,
            stops: parameters.stops.0,
            offsets: parameters.offsets.0,
            cmd: 0,
            verb: 0,
            goal: Point::new(0.0, 0.0, 0.0),
        }
    }

    pub fn step(
        &mut self,
        inputs: &Inputs,
        tray: &mut TrayCells,
        source: &mut SourceCells,
        demand: &[DemandCells],
    ) {
        let ended = self.cmd != 0 && inputs.ack == self.cmd;
        let (done, failed) = (ended && inputs.error == 0, ended && inputs.error != 0);
        match self.state {
            State::Start => {
                tray.hands_over = self.stops[self.unloads_at];
                self.go(0, inputs);
                self.state = State::Returning;
            }
            State::Loading => {
                if self.is_loaded(tray, demand) {
                    tray.open = false;
                    self.go(self.unloads_at, inputs);
                    self.state = State::Moving;
                }
            }
            State::Moving if done => self.state = State::Dropping,
            State::Moving if failed => self.go(self.unloads_at, inputs),
            State::Dropping => self.drop(inputs, tray, source),
            State::Returning if done => {
                tray.open = true;
                self.state = State::Loading;
            }
            State::Returning if failed => self.go(0, inputs),
            State::Moving | State::Returning => {}
        }
    }

    fn go(&mut self, stop: usize, inputs: &Inputs) {
        self.goal = self.stops[stop];
        self.verb = 1;
        self.cmd = next_command(self.cmd, inputs.got, inputs.ack);
    }

    fn is_loaded(&self, tray: &TrayCells, demand: &[DemandCells]) -> bool {
        if tray.held {
            return false;
        }
        let slots = &tray.slot.0[..self.capacity];
        let is_last = |slot: usize| {
            let order = &demand[usize::from(tray.ticket.0[slot].0)];
            order.wants.0.iter().zip(&order.aboard.0).all(|(wants, aboard)| wants <= aboard)
        };
        slots.iter().all(|slot| *slot == Slot::Full)
            || (0..self.capacity).any(|slot| slots[slot] == Slot::Full && is_last(slot))
                && !slots.contains(&Slot::Promised)
    }

    fn drop(&mut self, inputs: &Inputs, tray: &mut TrayCells, source: &mut SourceCells) {
        let slots = &mut tray.slot.0[..self.capacity];
        if !source.offer && slots.iter().all(|slot| *slot == Slot::Free) {
            self.go(0, inputs);
            self.state = State::Returning;
        } else if source.taken {
            source.taken = false;
            source.claimed = false;
            source.offer = false;
            slots[self.next] = Slot::Free;
        } else if source.missed {
            source.missed = false;
            source.claimed = false;
            source.offer = false;
        } else if !source.offer
            && let Some(slot) = slots.iter().position(|slot| *slot == Slot::Full)
        {
            self.next = slot;
            source.kind = tray.holds.0[slot];
            source.goes_to = tray.ticket.0[slot];
            source.at = tray.hands_over + self.offsets[slot];
            source.offer = true;
        }
    }
}
