//! Straight lines of the tool: joints in small steps, the arm bent as it is at the beginning.

use super::arm::{Arm, Joints};
use super::facing::Facing;
use crate::point::Point;

/// A tool that is not farther from a straight line is on it, and an axis that moves less stands, m or rad.
const ALIGNED: f64 = 1e-6;
/// On a straight line of the tool the joints change evenly for so many metres, or less.
pub const LINE_STEP: f64 = 0.025;
/// A longer line is not straight.
const MOST_STEPS: f64 = 200.0;
/// The joints of two places so near to one another differ by less, rad: else a step is halved.
const NEAR_JOINTS: f64 = 0.5;
/// In the middle of a step the tool is not farther off the line, m: else a step is halved.
const OFF_LINE: f64 = 0.000_5;
/// A step that is halved so often is not halved again: if the joints still differ, the arm has turned over.
const MOST_HALVES: u32 = 6;

/// Why the tool does not get to a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missed {
    /// No joints bring it there.
    OutOfReach,
    /// It would have to go in a straight line, and on the way the arm would have to bend in another way.
    NotStraight,
}

/// Why there are no joints along a line.
enum NoLine {
    /// The tool does not have to go straight.
    NotAsked,
    /// It has to, and cannot.
    Breaks,
}

/// A number of steps, and the joints of the place after so many of them, near others.
struct Line<'a, S> {
    arm: &'a Arm,
    /// Where it begins and ends.
    ends: [Point; 2],
    steps: f64,
    /// The first joints, which have to stand.
    standing: usize,
    solve: S,
}

impl<S: Fn(f64, &Joints) -> Option<Joints>> Line<'_, S> {
    fn joints(&self, from: &Joints) -> Result<Vec<Joints>, NoLine> {
        let mut all = vec![*from];
        for i in 1..=self.steps as u32 {
            self.step(f64::from(i), 1.0, MOST_HALVES, &mut all)?;
        }
        all.remove(0);
        Ok(all)
    }

    /// Goes on to the place `end`, which is so far from the last one.
    fn step(&self, end: f64, length: f64, halves: u32, all: &mut Vec<Joints>) -> Result<(), NoLine> {
        let last = all[all.len() - 1];
        let next = (self.solve)(end, &last).ok_or(NoLine::Breaks)?;
        if (0..self.standing).any(|j| (next[j] - last[j]).abs() >= ALIGNED) {
            return Err(NoLine::NotAsked);
        }
        let is_near = next.iter().zip(last.iter()).all(|(a, b)| (a - b).abs() < NEAR_JOINTS);
        if is_near && (halves == 0 || self.is_on_line(&last, &next, end - length / 2.0)) {
            all.push(next);
            return Ok(());
        }
        let (half, halves) = (length / 2.0, halves.checked_sub(1).ok_or(NoLine::Breaks)?);
        self.step(end - half, half, halves, all)?;
        self.step(end, half, halves, all)
    }

    /// Whether the tool is on the line half of the way between two sets of joints, after so many steps.
    fn is_on_line(&self, last: &Joints, next: &Joints, middle: f64) -> bool {
        let [begin, end] = self.ends;
        let there = begin + (end - begin).scaled(middle / self.steps);
        let half = last.map(|i, value| (value + next[i]) / 2.0);
        (self.arm.tool(&half) - there).length() < OFF_LINE
    }
}

impl Arm {
    /// Joints to pass on the way of the tool to a place, the last ones there: straight up or down in small steps where
    /// the place is over or under the tool and nothing but the arm has to move, else at once.
    pub fn line_to(&self, tool: Point, from: &Joints) -> Result<Vec<Joints>, Missed> {
        self.else_at_once(self.vertical(tool, from), tool, Facing::Down, from)
    }

    /// Joints to pass on the way of the tool to a place where it points there, the last ones there: in a straight line in
    /// small steps if it points there already and goes along this direction, to or fro, else at once.
    pub fn line_facing(&self, tool: Point, facing: Facing, from: &Joints) -> Result<Vec<Joints>, Missed> {
        self.else_at_once(self.along(tool, facing, from), tool, facing, from)
    }

    fn else_at_once(
        &self,
        line: Result<Vec<Joints>, NoLine>,
        tool: Point,
        facing: Facing,
        from: &Joints,
    ) -> Result<Vec<Joints>, Missed> {
        let at_once = || self.solve_facing(tool, facing, from).ok_or(Missed::OutOfReach);
        match line {
            Ok(joints) => Ok(joints),
            Err(NoLine::NotAsked) => Ok(vec![at_once()?]),
            Err(NoLine::Breaks) => at_once().and(Err(Missed::NotStraight)),
        }
    }

    fn along(&self, tool: Point, facing: Facing, from: &Joints) -> Result<Vec<Joints>, NoLine> {
        let (start, ahead) = (self.tool_pose(from), facing.direction());
        let way = tool - start.position;
        let aside = way - ahead.scaled(way.dot(ahead));
        let is_along = aside.length() < ALIGNED && facing.is_of(&start, ALIGNED);
        let standing = match facing {
            Facing::Oriented { .. } => self.solver().standing().ok_or(NoLine::NotAsked)?,
            Facing::Down | Facing::Level { .. } => 0,
        };
        let steps = steps(way.length()).filter(|_| is_along).ok_or(NoLine::NotAsked)?;
        let solve = |i: f64, last: &Joints| self.solve_near(tool - way.scaled(1.0 - i / steps), facing, last);
        Line { arm: self, ends: [start.position, tool], steps, standing, solve }.joints(from)
    }

    fn vertical(&self, tool: Point, from: &Joints) -> Result<Vec<Joints>, NoLine> {
        let standing = self.solver().standing().ok_or(NoLine::NotAsked)?;
        let pose = self.tool_pose(from);
        let start = pose.position;
        let points_down = (pose.axis(2) - Facing::Down.direction()).length() < ALIGNED;
        // A tool that has a turn of its own gives it up on the way, so it goes in no straight line.
        let is_turned = || {
            let plain = self.solve_near(start, Facing::Down, from);
            plain
                .is_some_and(|plain| plain.iter().zip(from.iter()).any(|(a, b)| (a - b).abs() >= NEAR_JOINTS))
        };
        let is_over = points_down && (tool.x - start.x).abs() < ALIGNED && (tool.y - start.y).abs() < ALIGNED;
        let steps =
            steps((tool.z - start.z).abs()).filter(|_| is_over && !is_turned()).ok_or(NoLine::NotAsked)?;
        let solve = |i: f64, last: &Joints| {
            let z = if steps > 1.0 { start.z + (tool.z - start.z) * i / steps } else { tool.z };
            self.solve_near(Point { z, ..tool }, Facing::Down, last)
        };
        Line { arm: self, ends: [start, tool], steps, standing, solve }.joints(from)
    }
}

/// None for a line that is too long.
fn steps(length: f64) -> Option<f64> {
    let steps = (length / LINE_STEP).ceil().max(1.0);
    (steps <= MOST_STEPS).then_some(steps)
}

#[cfg(test)]
mod tests;
