//! Properties see outputs as they are put out: of a machine that is stopped, their stop values.

use super::automaton::Instance;
use crate::ir::Place;
use autogen_search::program::{Int, Operator, Real};
use runtime_sim::device::Stop;

impl Instance<'_> {
    pub fn whole_put_out(&self, place: &Place, set: Int) -> Int {
        let Some((is_stopped, stop)) = self.stop_value(place) else { return set };
        let binary = |operator, a, b| Int::Binary(operator, Box::new([a, b]));
        let runs = Int::Not(Box::new(is_stopped.clone()));
        let set = binary(Operator::Multiply, runs, set);
        binary(Operator::Add, set, binary(Operator::Multiply, is_stopped, Int::Constant(stop as i32)))
    }

    pub fn real_put_out(&self, place: &Place, set: Real) -> Real {
        let Some((is_stopped, stop)) = self.stop_value(place) else { return set };
        let binary = |operator, a, b| Real::Binary(operator, Box::new([a, b]));
        let runs = Real::OfInt(Box::new(Int::Not(Box::new(is_stopped.clone()))));
        let stopped = Real::OfInt(Box::new(is_stopped));
        let set = binary(Operator::Multiply, runs, set);
        binary(Operator::Add, set, binary(Operator::Multiply, stopped, Real::Constant(stop)))
    }

    /// Whether the machine is stopped, and what is put out then.
    fn stop_value(&self, place: &Place) -> Option<(Int, f64)> {
        let Place::Port { port, .. } = place else { return None };
        let is_masked = self.sees_what_is_put_out && self.automaton.masked.contains(port);
        match (self.line.stopped[self.number], self.automaton.device.ports[*port].stop) {
            (Some(stopped), Stop::Value(stop)) if is_masked => Some((Int::Load(stopped, 0), stop)),
            _ => None,
        }
    }
}
