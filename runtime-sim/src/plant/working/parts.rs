//! What others ask of single parts of a machine.

use super::Working;
use crate::part::lane::Moving;
use crate::part::scanner::Scanning;
use crate::part::stroke::Carriage;
use crate::part::track::Driving;
use crate::part::{Gripper, See};

impl Working {
    pub fn lane(&self, part: usize) -> Option<&Moving> {
        self.parts.get(part)?.as_ref()?.lane()
    }

    pub fn lane_mut(&mut self, part: usize) -> Option<&mut Moving> {
        self.parts.get_mut(part)?.as_mut()?.lane_mut()
    }

    pub fn carriage(&self, part: usize) -> Option<&dyn Carriage> {
        self.parts.get(part)?.as_ref()?.carriage()
    }

    /// The vehicle that a part is.
    pub fn vehicle(&self, part: usize) -> Option<&Driving> {
        self.parts.get(part)?.as_ref()?.vehicle()
    }

    /// The vehicle on a track that carries a part.
    pub fn vehicle_under(&self, part: usize) -> Option<&Driving> {
        self.vehicle(self.parts.get(part)?.as_ref()?.on()?)
    }

    pub fn first_vehicle(&self) -> Option<&Driving> {
        self.running().find_map(|part| part.vehicle())
    }

    /// All of its scanners, with their parts.
    pub fn scanners(&self) -> impl Iterator<Item = (usize, &Scanning)> {
        let all = self.parts.iter().enumerate();
        all.filter_map(|(part, running)| Some((part, running.as_ref()?.scanner()?)))
    }

    /// What the scanner that a part is sees.
    pub fn tell(&mut self, part: usize, sees: bool) {
        if let Some(scanning) = self.parts[part].as_mut().and_then(|running| running.scanner_mut())
            && std::mem::replace(&mut scanning.sees, sees) != sees
        {
            self.begin_phase();
        }
    }

    /// Of a part that is a gripper.
    pub fn gripper(&self, part: usize, see: &See) -> Option<Gripper> {
        self.parts.get(part)?.as_ref()?.gripper(see)
    }

    /// How many items a source was asked for, if it is asked for each.
    pub fn asked(&self, part: usize) -> Option<u64> {
        self.parts.get(part)?.as_ref()?.asked()
    }
}
