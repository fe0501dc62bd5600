//! Robots: a fixed rail, and a link behind each joint of [`runtime_sim::kinematics`], all in the world's frame.

use super::carriage;
use super::inertia::{Inertial, inertial};
use super::model::{self, Joint, Link, Model};
use super::number;
use super::shape::{Shape, Surface, shapes};
use crate::naming::Scope;
use runtime_sim::kinematics::arm::{Arm, Joints};
use runtime_sim::kinematics::links;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::machine::Machine;
use runtime_sim::part::axis;
use runtime_sim::point::Point;
use runtime_sim::solid::{self, Solid};
use std::f64::consts::TAU;

const RAIL: &str = "0.3 0.3 0.35 1";
const CARRIER: &str = "0.45 0.5 0.55 1";
const ARM: &str = "0.7 0.7 0.75 1";
const GRIPPER_COLOUR: &str = "0.8 0.1 0.1 1";

/// The gripper's mass (`vacuum_gripper.urdf.xacro`), kg.
const GRIPPER_MASS: f64 = 0.01;
/// Rails and beams, kg/m: a profile of aluminium. The prototype's description has 1 kg for each, whatever its length.
const BEAM: f64 = 20.0;
/// What one joint moves, and how it is driven.
struct Drive {
    /// Name of the joint, and of its link, without what SDF's names end in.
    joint: String,
    link: String,
    /// kg
    mass: f64,
    motion: Motion,
    /// N or N m.
    effort: f64,
    /// N s/m or N m s/rad, and N or N m.
    damping: f64,
    friction: f64,
}

enum Motion {
    /// Along a direction of the world, within a range of its values.
    Slide { along: Point, range: [f64; 2] },
    /// About the vertical through the link's own origin.
    Turn,
    /// About the z axis of a frame that is fixed to the link before, within a range of angles.
    Swing { mount: Pose, range: [f64; 2] },
}

/// The axes that carry the chain, then its joints.
fn drives(machine: &Machine, kinematics: &Arm) -> Vec<Drive> {
    let base = machine.axes().first().and_then(|axis| axis.base()).unwrap_or_default();
    let of_axis = |(part, axis): (&str, &axis::Axis)| Drive {
        joint: axis.joint.clone().unwrap_or_else(|| format!("{part}_drive")),
        link: axis.link.clone().unwrap_or_else(|| format!("{part}_slide")),
        mass: axis.mass,
        motion: match axis.motion {
            axis::Motion::Slides { along, range } => {
                let along = base.direction(Point::default().with_coordinate(along, 1.0));
                Motion::Slide { along, range }
            }
            axis::Motion::Turns => Motion::Turn,
        },
        effort: axis.effort,
        damping: axis.damping,
        friction: axis.friction,
    };
    let mut drives: Vec<Drive> = machine.named_axes().into_iter().map(of_axis).collect();
    let Some(chain) = machine.chain() else { return drives };
    let links = kinematics.links().into_iter().skip(drives.len());
    let turns = [[-TAU, TAU]; 6];
    let ranges = kinematics.ranges().unwrap_or(&turns).to_vec();
    let motion = |link: &links::Link, range: [f64; 2]| match link.joint {
        links::Joint::Turns => Motion::Swing { mount: link.before, range },
        // Arms with a joint of their own that slides stand upright.
        links::Joint::Slides(along) => {
            Motion::Slide { along: Point::default().with_coordinate(along, 1.0), range }
        }
    };
    drives.extend(chain.joints.iter().zip(links).zip(ranges).map(|((joint, link), range)| Drive {
        joint: joint.name.clone(),
        link: joint.link.clone(),
        mass: joint.mass,
        motion: motion(&link, range),
        effort: joint.effort,
        damping: joint.damping,
        friction: joint.friction,
    }));
    drives
}

/// The model of a robot, its rails at the middle of their ranges and its arm stretched, all angles 0; with what else the
/// machine has: the surfaces of its conveyors, and what is on its cylinders and positioners.
pub fn model(name: String, machine: &Machine, kinematics: &Arm, lanes: &[Solid], surface: Surface) -> Model {
    let drives = drives(machine, kinematics);
    let carriers = machine.axes().len();
    let zero: Vec<f64> = drives.iter().map(|drive| drive.middle()).collect();
    let frames = kinematics.frames(&Joints::new(&zero));
    let velocities = kinematics.limits().velocity;
    let solids = machine.solids();
    let of = |link: solid::Link| -> Vec<Solid> {
        solids.iter().filter(|s| s.link == link && !s.grips).cloned().collect()
    };

    let mut model = Model::jointed(name);
    let mut names = Scope::default();
    let rails = of(solid::Link::World);
    let standing_lanes = lanes.iter().filter(|lane| lane.link == solid::Link::World);
    let stands = of_colour(&rails, RAIL).chain(standing_lanes.map(|lane| (lane, surface)));
    let of_rails = inertial(rail_mass(&rails, machine), &rails);
    let rail = link(names.take("rail_link".into()), &Pose::IDENTITY, of_rails, shapes(stands));
    model.joints.push(fixed(names.take("rail_mount_joint".into()), "world", &rail.name));
    model.links.push(rail);
    let mut before = Pose::IDENTITY;
    for (i, (drive, frame)) in drives.iter().zip(frames.iter()).enumerate() {
        let parent = model.links[i].name.clone();
        let colour = if i < carriers { CARRIER } else { ARM };
        let solids = of(solid::Link::Joint(i));
        let link = Link {
            relative_to: Some(parent.clone()),
            is_weightless: i >= carriers,
            ..link(
                names.take(format!("{}_link", drive.link)),
                &frame.seen_from(&before),
                inertial(drive.mass, &solids),
                shapes(of_colour(&solids, colour)),
            )
        };
        let joint_frame = drive.frame(&before, frame);
        model.joints.push(Joint {
            name: names.take(format!("{}_joint", drive.joint)),
            kind: drive.kind(),
            child: link.name.clone(),
            relative_to: parent.clone(),
            parent,
            pose: number::pose(&joint_frame.seen_from(&before)),
            axis: Some(drive.axis(&joint_frame, velocities[i])),
        });
        model.links.push(link);
        before = *frame;
    }
    gripper(&mut model, &mut names, &solids);
    let carried: Vec<Solid> = solids.iter().chain(lanes).cloned().collect();
    let base = model.links[0].name.clone();
    carriage::add(&mut model, &mut names, &base, machine, &carried, surface);
    model
}

/// The gripper is a link of its own, which simulators attach parts to.
fn gripper(model: &mut Model, names: &mut Scope, solids: &[Solid]) {
    let Some(wrist) = model.links.last().map(|link| link.name.clone()) else { return };
    let solids: Vec<Solid> = solids.iter().filter(|s| s.grips).cloned().collect();
    let gripper = Link {
        relative_to: Some(wrist.clone()),
        is_weightless: true,
        ..link(
            names.take("vacuum_gripper_link".into()),
            &Pose::IDENTITY,
            inertial(GRIPPER_MASS, &solids),
            shapes(of_colour(&solids, GRIPPER_COLOUR)),
        )
    };
    model.joints.push(fixed(names.take("vacuum_gripper_joint".into()), &wrist, &gripper.name));
    model.tool = Some(gripper.name.clone());
    model.links.push(gripper);
}

fn link(name: String, pose: &Pose, inertial: Inertial, shapes: Vec<Shape>) -> Link {
    Link {
        name,
        relative_to: None,
        pose: number::pose(pose),
        is_weightless: false,
        inertial: Some(inertial),
        shapes,
        sensor: None,
    }
}

fn of_colour<'a>(solids: &'a [Solid], colour: &'a str) -> impl Iterator<Item = (&'a Solid, Surface<'a>)> {
    solids.iter().map(move |solid| (solid, Surface { colour, friction: None }))
}

/// At the origin of its child.
fn fixed(name: String, parent: &str, child: &str) -> Joint {
    Joint {
        name,
        kind: "fixed",
        parent: parent.into(),
        child: child.into(),
        relative_to: child.into(),
        pose: number::pose(&Pose::IDENTITY),
        axis: None,
    }
}

/// Of all fixed beams, by their greatest lengths. If none is described, of one as long as the first axis; of one metre for
/// an arm that no axis carries.
fn rail_mass(rails: &[Solid], machine: &Machine) -> f64 {
    let length = |solid: &Solid| match solid.shape {
        solid::Shape::Box { size } => size.x.max(size.y).max(size.z),
        solid::Shape::Capsule { length, .. } => length,
    };
    let all: f64 = rails.iter().map(length).sum();
    let range = machine.axes().first().and_then(|axis| axis.range());
    let undrawn = range.map_or(1.0, |[low, high]| high - low);
    BEAM * if all > 0.0 { all } else { undrawn }
}

impl Drive {
    fn kind(&self) -> &'static str {
        match self.motion {
            Motion::Slide { .. } => "prismatic",
            _ => "revolute",
        }
    }

    /// The kinematics' value of this joint where SDF's is 0.
    fn middle(&self) -> f64 {
        match self.motion {
            Motion::Slide { range: [low, high], .. } => (low + high) / 2.0,
            _ => 0.0,
        }
    }

    /// Of the joint in the world, from the frames of the links before and behind it.
    fn frame(&self, before: &Pose, behind: &Pose) -> Pose {
        match &self.motion {
            Motion::Slide { .. } | Motion::Turn => *behind,
            Motion::Swing { mount, .. } => before.then(mount),
        }
    }

    fn axis(&self, frame: &Pose, velocity: f64) -> model::Axis {
        let (xyz, [lower, upper]) = match self.motion {
            Motion::Slide { along, range } => {
                let turned = Pose { position: Point::default(), ..*frame };
                let Point { x, y, z } = turned.inverse().direction(along);
                ([x, y, z], range.map(|end| end - self.middle()))
            }
            Motion::Swing { range, .. } => ([0.0, 0.0, 1.0], range),
            // Limits of all turning joints in the robots' descriptions.
            Motion::Turn => ([0.0, 0.0, 1.0], [-TAU, TAU]),
        };
        model::Axis {
            xyz: number::list(&xyz),
            lower: number::length(lower),
            upper: number::length(upper),
            effort: number::length(self.effort),
            velocity: number::length(velocity),
            damping: number::length(self.damping),
            friction: number::length(self.friction),
        }
    }
}
