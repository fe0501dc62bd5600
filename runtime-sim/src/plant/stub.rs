//! TEMPORARY: an arm that flies straight at 1 m/s within 20 m, until the kinematics are there.

use crate::geometry::Geometry;
use crate::point::Point;

#[derive(Clone, Debug)]
pub struct Drive {
    tool: Point,
    trip: Option<(Point, Point, u64)>,
}
pub enum Moved {
    Arrived,
    OnTheWay,
}
impl Moved {
    pub fn is_arrived(&self) -> bool {
        matches!(self, Moved::Arrived)
    }
}

impl Drive {
    pub fn new(geometry: &Geometry) -> Option<Drive> {
        Some(Self { tool: geometry.rest(), trip: None })
    }
    pub fn tool(&self) -> Point {
        self.tool
    }
    pub fn start(&mut self, goal: Point) -> Option<()> {
        let d = goal - self.tool;
        if !(d.x.abs() + d.y.abs() + d.z.abs() <= 20.0) {
            return None;
        }
        self.trip = Some((self.tool, goal, 0));
        Some(())
    }
    pub fn stop(&mut self) {
        self.trip = None
    }
    pub fn advance(&mut self, dt_ms: u64) -> Moved {
        let Some((from, to, t)) = &mut self.trip else { return Moved::Arrived };
        *t += dt_ms;
        let d = *to - *from;
        let length = libm::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        let s = *t as f64 / 1000.0;
        if s >= length {
            self.tool = *to;
            self.trip = None;
            return Moved::Arrived;
        }
        let k = s / length;
        self.tool = *from + Point::new(d.x * k, d.y * k, d.z * k);
        Moved::OnTheWay
    }
}
