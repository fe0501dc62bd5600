//! A Cartesian robot: one to three axes at right angles that slide, and a tool that points down.

use super::arm::{Frames, Joints};
use super::is_finite;
use super::links::Link;
use super::pose::Pose;
use super::solver::Solver;
use crate::frame::Frame;
use crate::point::{Direction, Point};

/// What an axis lacks by less is rounding, and a tool nearer than this to the plane of two axes is in it, m.
const ROUNDED: f64 = 1e-6;

/// An axis, along one of the base's, and both ends of its range from the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slide {
    pub along: Direction,
    pub range: [f64; 2],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cartesian {
    base: Frame,
    slides: [Slide; 3],
    count: usize,
    /// From the last axis down to the tool centre point, m.
    tool_length: f64,
}

impl Cartesian {
    /// `base` is where the last axis is while all are at 0. None without axes, and if two go along the same one.
    pub fn new(base: Frame, slides: &[Slide], tool_length: f64) -> Option<Self> {
        let goes = |along: Direction| slides.iter().filter(|slide| slide.along == along).count();
        let mut all = [*slides.first()?; 3];
        if Direction::ALL.iter().any(|along| goes(*along) > 1) {
            return None;
        }
        all[..slides.len()].copy_from_slice(slides);
        Some(Self { base, slides: all, count: slides.len(), tool_length })
    }

    pub fn slides(&self) -> &[Slide] {
        &self.slides[..self.count]
    }

    /// The tool in the frame of the last axis.
    fn tool(&self) -> Pose {
        let rotation = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
        Pose { rotation, position: Point::new(0.0, 0.0, -self.tool_length) }
    }

    /// The last axis in the frame of the tool, which bears whatever is fixed to this axis.
    pub fn mount(&self) -> Pose {
        self.tool().inverse()
    }

    /// How far the tool stays within the range of the axis that is nearest to an end; out of reach the distance to
    /// the space that the axes reach, negative, m.
    pub fn margin(&self, tool: Point) -> f64 {
        if !is_finite(tool) {
            return f64::NEG_INFINITY;
        }
        let seen = self.base.seen(tool.up(self.tool_length));
        let rooms = Direction::ALL.map(|along| {
            let value = seen.coordinate(along);
            match self.slides().iter().find(|slide| slide.along == along) {
                Some(Slide { range: [low, high], .. }) => (value - low).min(high - value),
                None if value.abs() <= ROUNDED => f64::INFINITY,
                None => -value.abs(),
            }
        });
        let beyond: f64 = rooms.iter().filter(|room| **room < -ROUNDED).map(|room| room * room).sum();
        if beyond > 0.0 { -beyond.sqrt() } else { rooms.into_iter().fold(f64::INFINITY, f64::min).max(0.0) }
    }

    /// Values of the axes for a place of the tool; some exactly when [`Self::margin`] is not negative.
    pub fn solve(&self, tool: Point) -> Option<Vec<f64>> {
        if self.margin(tool) < 0.0 {
            return None;
        }
        let seen = self.base.seen(tool.up(self.tool_length));
        let value = |Slide { along, range: [low, high] }: &Slide| seen.coordinate(*along).clamp(*low, *high);
        Some(self.slides().iter().map(value).collect())
    }

    /// Of what each axis moves; the last is the tool's.
    pub fn frames(&self, values: &[f64]) -> Vec<Pose> {
        let mut place = Point::default();
        let base = self.base.pose();
        let frames = self.slides().iter().zip(values).map(|(slide, value)| {
            place = place.with_coordinate(slide.along, *value);
            base.then(&Pose { position: place, ..Pose::IDENTITY })
        });
        let mut frames: Vec<Pose> = frames.collect();
        if let Some(last) = frames.last_mut() {
            *last = last.then(&self.tool());
        }
        frames
    }

    pub fn tool_pose(&self, values: &[f64]) -> Pose {
        self.frames(values).last().copied().unwrap_or(Pose::IDENTITY)
    }

    /// The joints, from the world on.
    pub fn links(&self) -> Vec<Link> {
        let last = self.count - 1;
        let link = |(i, slide): (usize, &Slide)| {
            let before = if i == 0 { self.base.pose() } else { Pose::IDENTITY };
            Link::slides(before, slide.along, if i == last { self.tool() } else { Pose::IDENTITY })
        };
        self.slides().iter().enumerate().map(link).collect()
    }

    /// Over which the tool can be: one point, the two ends of a line or the four corners of an area, in their order round
    /// it; seen from above, world frame.
    pub fn ground(&self) -> Vec<Point> {
        let range = |along: Direction| {
            self.slides().iter().find(|slide| slide.along == along).map(|slide| slide.range)
        };
        let at = |x: f64, y: f64| Point { z: 0.0, ..self.base.point(Point::new(x, y, 0.0)) };
        match (range(Direction::X), range(Direction::Y)) {
            (None, None) => vec![at(0.0, 0.0)],
            (Some([low, high]), None) => vec![at(low, 0.0), at(high, 0.0)],
            (None, Some([low, high])) => vec![at(0.0, low), at(0.0, high)],
            (Some(x), Some(y)) => vec![at(x[0], y[0]), at(x[1], y[0]), at(x[1], y[1]), at(x[0], y[1])],
        }
    }

    pub fn start(&self) -> Vec<f64> {
        self.slides().iter().map(|slide| (slide.range[0] + slide.range[1]) / 2.0).collect()
    }
}

impl Solver for Cartesian {
    fn margin_down(&self, tool: Point) -> f64 {
        Cartesian::margin(self, tool)
    }

    fn solve_down(&self, tool: Point, _from: &Joints) -> Option<Joints> {
        Cartesian::solve(self, tool).map(|values| Joints::new(&values))
    }

    fn tool_pose(&self, joints: &Joints) -> Pose {
        Cartesian::tool_pose(self, joints)
    }

    fn frames(&self, joints: &Joints) -> Frames {
        Frames::of(Cartesian::frames(self, joints).into_iter())
    }

    fn links(&self) -> Vec<Link> {
        Cartesian::links(self)
    }

    fn start(&self) -> Joints {
        Joints::new(&Cartesian::start(self))
    }

    fn mount(&self) -> Pose {
        Cartesian::mount(self)
    }

    fn standing(&self) -> Option<usize> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn slide(along: Direction, low: f64, high: f64) -> Slide {
        Slide { along, range: [low, high] }
    }

    fn portal(yaw: f64) -> Cartesian {
        let slides =
            [slide(Direction::Y, 0.0, 0.6), slide(Direction::X, 0.0, 1.0), slide(Direction::Z, -0.3, 0.0)];
        Cartesian::new(Frame::new(Point::new(2.0, 1.0, 1.2), yaw), &slides, 0.2).unwrap()
    }

    #[test]
    fn what_is_in_reach_is_reached_and_nothing_else() {
        let mut random = Random::new(31);
        let mut reached = 0;
        for _ in 0..20_000 {
            let robot = portal(random.between(-180.0, 180.0));
            let mut drawn = || random.between(-1.0, 1.0);
            let inside = Point::new(0.5 + 0.6 * drawn(), 0.3 + 0.4 * drawn(), -0.35 + 0.2 * drawn());
            let tool = robot.base.point(inside);
            // Seen from the base: within the three ranges, the tool 0.2 m under the last axis.
            let is_in = (0.0..=1.0).contains(&inside.x)
                && (0.0..=0.6).contains(&inside.y)
                && (-0.5..=-0.2).contains(&inside.z);
            assert_eq!(robot.margin(tool) >= 0.0, is_in, "{inside:?}");
            let Some(values) = robot.solve(tool) else { continue };
            let pose = robot.tool_pose(&values);
            assert!((pose.position - tool).length() < 1e-9, "{pose:?} {tool:?}");
            assert!((pose.axis(2).z + 1.0).abs() < 1e-12);
            reached += 1;
        }
        assert!(reached > 5_000, "{reached}");
    }

    #[test]
    fn margins_are_distances() {
        let robot = portal(0.0);
        let at = |x: f64, y: f64, z: f64| robot.margin(Point::new(2.0 + x, 1.0 + y, 1.0 + z));
        let near = |margin: f64, wanted: f64| assert!((margin - wanted).abs() < 1e-12, "{margin} {wanted}");
        near(at(0.5, 0.3, -0.15), 0.15);
        near(at(0.1, 0.3, -0.15), 0.1);
        near(at(1.0, 0.6, 0.0), 0.0);
        near(at(1.3, 0.3, -0.15), -0.3);
        // Beyond two ends at once: the diagonal.
        near(at(1.3, 1.0, -0.15), -0.5);
        let flat = Cartesian::new(Frame::default(), &[slide(Direction::X, 0.0, 1.0)], 0.0).unwrap();
        near(flat.margin(Point::new(0.25, 0.0, 0.0)), 0.25);
        near(flat.margin(Point::new(0.25, 0.02, 0.0)), -0.02);
    }

    #[test]
    fn two_axes_along_one_direction_are_no_robot() {
        let twice = [slide(Direction::X, 0.0, 1.0), slide(Direction::X, 0.0, 1.0)];
        assert_eq!(Cartesian::new(Frame::default(), &twice, 0.0), None);
        assert_eq!(Cartesian::new(Frame::default(), &[], 0.0), None);
    }
}
