//! A run of several controllers that have done the same so far. Where some do otherwise, the simulation is copied for
//! them: Hybinette and Fujimoto, Cloning parallel simulations, ACM Transactions on Modeling and Computer Simulation 11
//! (2001).

use super::agenda::Waits;
use super::recorders::Recorders;
use super::simulation::{Begun, End, Simulation};
use super::variant::{Alike, Variant};
use super::{Seen, Stepping};
use crate::line::Line;
use crate::memory::Memory;
use crate::plant::Plant;
use crate::report::Report;
use crate::scan::Controllers;

pub struct Branch<'a> {
    simulation: Simulation<'a>,
    variants: Alike<'a>,
    at: At,
}

/// Where in a scan it goes on.
#[derive(Clone, Copy)]
enum At {
    Begin,
    /// The controllers have executed the scan.
    Executed(Begun),
    /// What they gave is taken.
    Taken(Begun),
}

impl<'a> Branch<'a> {
    /// Before scan 0, with the plant of the first line; the others have it too. An error says why the line cannot be run.
    pub fn new(
        line: &'a Line,
        controllers: &'a mut dyn Controllers,
        others: Vec<(&'a Line, &'a mut dyn Controllers)>,
        stepping: Stepping,
        memory: &mut Memory,
    ) -> Result<Self, String> {
        debug_assert!(others.iter().all(|(other, _)| line.has_plant_of(other)), "lines with other plants");
        let simulation = Simulation::new(line, controllers, stepping, memory)?;
        let others = (1..).zip(others);
        let others = others.map(|(number, (line, controllers))| Variant::new(number, line, controllers));
        let variants = Alike::new(Variant::new(0, line, controllers), others.collect());
        Ok(Self { simulation, variants, at: At::Begin })
    }

    /// Runs until the end. Those that do otherwise than the first one are left to other branches.
    pub fn run(
        &mut self,
        memory: &mut Memory,
        observer: &mut dyn FnMut(&Seen),
        mut recorders: Option<&mut Recorders>,
        branches: &mut Vec<Self>,
    ) -> Result<End, String> {
        loop {
            if let At::Begin = self.at {
                self.at = At::Executed(self.simulation.begin(&mut self.variants)?);
            }
            if let At::Executed(mut begun) = self.at {
                let apart = self.variants.split_off(Variant::gave_same);
                branches.extend(apart.map(|variants| self.clone_for(variants)));
                self.simulation.take(&mut begun, &self.variants.first)?;
                self.at = At::Taken(begun);
            }
            if let At::Taken(begun) = self.at {
                let is_timed = |waits: &Waits| self.simulation.is_timed(waits);
                let timed = is_timed(&self.variants.waits);
                let is_like =
                    |other: &Variant| other.waits.as_ref().is_none_or(|waits| is_timed(waits) == timed);
                let apart = self.variants.split_off(|_, other| is_like(other));
                branches.extend(apart.map(|variants| self.clone_for(variants)));
                let recorders = recorders.as_deref_mut();
                let end = self.simulation.proceed(begun, &self.variants, memory, observer, recorders)?;
                if let Some(end) = end {
                    return Ok(end);
                }
                self.at = At::Begin;
            }
        }
    }

    /// The same for other variants, from here on.
    fn clone_for(&self, variants: Alike<'a>) -> Self {
        Self { simulation: self.simulation.clone(), variants, at: self.at }
    }

    /// The numbers of its variants: 0 is the first one.
    pub fn numbers(&self) -> Vec<usize> {
        self.variants.iter().map(|variant| variant.number).collect()
    }

    /// What came of the run, and the plant at its end.
    pub fn report(mut self, end: End) -> (Report, Plant) {
        self.simulation.report(end, &mut self.variants)
    }
}
