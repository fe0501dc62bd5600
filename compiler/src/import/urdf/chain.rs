//! The six joints of the arm among those of the robot, and where they bring the flange.

use super::Options;
use super::read::{Joint, Motion, Robot, about};
use super::tree::Tree;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::import::arm::fit::{self, Fit, JOINTS, Zero};
use crate::import::stop;
use runtime_sim::kinematics::pose::Pose;

pub struct Chain {
    pub base: usize,
    pub tip: usize,
    /// From the base to the tip, fixed ones included.
    path: Vec<usize>,
    /// Those of the path that move.
    pub moving: [usize; JOINTS],
}

/// Names of the flange, by the conventions of ROS-Industrial and Universal Robots.
const FLANGES: [&str; 3] = ["tool0", "flange", "ee_link"];

/// Links of one message.
const MOST_LISTED: usize = 8;

impl Chain {
    pub fn find(robot: &Robot, tree: &Tree, options: &Options) -> Result<Self, Box<Diagnostic>> {
        let base = options.base.map_or(Ok(tree.root), |name| named(robot, name))?;
        let tip = match options.tip {
            Some(name) => named(robot, name)?,
            None => tip(robot, tree, base)?,
        };
        let mut path = Vec::new();
        let mut link = tip;
        while link != base {
            let Some(joint) = tree.above[link] else {
                let [base, tip] = [base, tip].map(|link| &robot.links[link].name);
                let message = format!("{} does not carry {}", base.value, tip.value);
                return stop(
                    Diagnostic::new("E1106", tip.span, message)
                        .other(base.span, "the base")
                        .help("`--base` and `--tip` name two links of one arm"),
                );
            };
            path.push(joint);
            link = robot.joints[joint].parent;
        }
        path.reverse();
        let moving: Vec<usize> =
            path.iter().copied().filter(|joint| robot.joints[*joint].motion != Motion::Fixed).collect();
        let turns = |joint: &usize| {
            let Joint { motion, mimics, .. } = robot.joints[*joint];
            matches!(motion, Motion::Turns | Motion::TurnsFreely) && !mimics
        };
        match <[usize; JOINTS]>::try_from(moving.clone()) {
            Ok(moving) if moving.iter().all(turns) => Ok(Self { base, tip, path, moving }),
            _ => stop(no_arm(robot, base, tip, &moving)),
        }
    }

    /// Where a link of the path, or the tip behind it, is in the frame of the base.
    pub fn forward(&self, robot: &Robot, values: &[f64; JOINTS]) -> Pose {
        self.frames(robot, values).last().map_or(Pose::IDENTITY, |(_, pose)| *pose)
    }

    /// The links behind the joints of the path, in the frame of the base.
    pub fn frames(&self, robot: &Robot, values: &[f64; JOINTS]) -> Vec<(usize, Pose)> {
        let mut pose = Pose::IDENTITY;
        let mut frames = Vec::new();
        for joint in &self.path {
            let Joint { origin, axis, child, .. } = &robot.joints[*joint];
            pose = pose.then(origin);
            if let Some(number) = self.moving.iter().position(|moving| moving == joint) {
                pose = pose.then(&about(*axis, values[number]));
            }
            frames.push((*child, pose));
        }
        frames
    }

    /// Lengths, offsets and signs of a kind of arm whose inverse kinematics is known, compared with the file's.
    pub fn fit(&self, robot: &Robot, notes: &mut Vec<String>) -> Result<Fit, Box<Diagnostic>> {
        let zero = [0.0; JOINTS];
        let frames = self.frames(robot, &zero);
        let axes = self.moving.map(|joint| {
            let Joint { child, axis, .. } = &robot.joints[joint];
            let frame =
                frames.iter().find(|(link, _)| link == child).map_or(Pose::IDENTITY, |(_, pose)| *pose);
            (frame.position, frame.direction(*axis))
        });
        let at_zero = Zero { axes, tip: self.forward(robot, &zero) };
        let ranges = self.moving.map(|joint| match robot.joints[joint] {
            Joint { motion: Motion::Turns, range: Some([low, high]), .. } if low < high => [low, high],
            _ => [-std::f64::consts::PI, std::f64::consts::PI],
        });
        let names = self.moving.map(|joint| robot.joints[joint].name.value.as_str());
        fit::fit(&at_zero, &names)
            .and_then(|fit| {
                let compared = fit::compare(&fit, &ranges, |values| self.forward(robot, values))?;
                notes.push(compared);
                Ok(fit)
            })
            .map_err(|facts| {
                let mut error = Diagnostic::new(
                    "E1107",
                    robot.joints[self.moving[0]].name.span,
                    "there is no inverse kinematics for these six joints",
                )
                .note(format!("from {} to {}", robot.links[self.base].name.value, robot.links[self.tip].name.value));
                for fact in facts {
                    error = error.note(fact);
                }
                error.help("arms with a spherical wrist and an ortho-parallel base, and those of Universal Robots with their nominal lengths, can be imported; name another flange with `--tip` if the tool is inclined").into()
            })
    }
}

fn named(robot: &Robot, name: &str) -> Result<usize, Box<Diagnostic>> {
    let found = robot.links.iter().position(|link| link.name.value == name);
    found.ok_or_else(|| {
        let known = robot.links.iter().map(|link| link.name.value.as_str());
        let help = match suggestion(name, known.clone()) {
            Some(meant) => format!("did you mean {meant}?"),
            None => format!("the links are {}", listed(known)),
        };
        Diagnostic::new("E1106", robot.name.span, format!("there is no link {name}")).help(help).into()
    })
}

/// Some of them, and how many more there are.
pub fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    let shown = names.iter().take(MOST_LISTED).copied().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(MOST_LISTED) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// The flange, where the joints that move are one behind the other.
fn tip(robot: &Robot, tree: &Tree, base: usize) -> Result<usize, Box<Diagnostic>> {
    let is_moving = |joint: &usize| robot.joints[*joint].motion != Motion::Fixed;
    // From the base on, and what is fixed behind the last joint that moves.
    let mut last = base;
    loop {
        let behind = rigid(robot, tree, last);
        let next: Vec<usize> =
            behind.iter().flat_map(|link| &tree.below[*link]).copied().filter(is_moving).collect();
        match next[..] {
            [] => {
                let names =
                    |name: &&str| behind.iter().copied().find(|link| robot.links[*link].name.value == *name);
                return Ok(FLANGES.iter().find_map(names).unwrap_or(last));
            }
            [joint] => last = robot.joints[joint].child,
            _ => {
                let known = FLANGES.iter().find_map(|name| named(robot, name).ok());
                if let Some(flange) = known {
                    return Ok(flange);
                }
                let name = &robot.links[last].name;
                let joints = listed(next.iter().map(|joint| robot.joints[*joint].name.value.as_str()));
                return stop(
                    Diagnostic::new(
                        "E1106",
                        name.span,
                        format!("{} carries several joints: {joints}", name.value),
                    )
                    .help("name the flange with `--tip LINK`"),
                );
            }
        }
    }
}

/// A link and all that is fixed to it.
fn rigid(robot: &Robot, tree: &Tree, link: usize) -> Vec<usize> {
    let mut links = vec![link];
    let mut next = 0;
    while next < links.len() {
        let fixed = |joint: &&usize| robot.joints[**joint].motion == Motion::Fixed;
        links.extend(tree.below[links[next]].iter().filter(fixed).map(|joint| robot.joints[*joint].child));
        next += 1;
    }
    links
}

fn no_arm(robot: &Robot, base: usize, tip: usize, moving: &[usize]) -> Diagnostic {
    let [base, tip] = [base, tip].map(|link| &robot.links[link].name);
    let message = format!(
        "from {} to {} there are not exactly six joints, all of which turn: {} move",
        base.value,
        tip.value,
        moving.len()
    );
    let shown: Vec<String> = moving
        .iter()
        .take(MOST_LISTED)
        .map(|joint| {
            let Joint { name, motion, mimics, .. } = &robot.joints[*joint];
            format!(
                "{} ({}{})",
                name.value,
                motion.word(),
                if *mimics { ", follows another joint" } else { "" }
            )
        })
        .collect();
    let error = Diagnostic::new("E1106", tip.span, message).other(base.span, "the base");
    let error =
        if shown.is_empty() { error } else { error.note(format!("the joints: {}", shown.join(", "))) };
    error.help("name the base and the flange of an arm of six axes with `--base LINK` and `--tip LINK`; Cartesian robots are written by hand, with `axis`")
}
