//! Machines of the library's devices, for tests.
#![allow(dead_code)] // each test uses some of them

use autogen::device::{Heights, Placed};
use autogen::library;
use runtime_sim::frame::Frame;
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::machine::Machine;
use runtime_sim::point::{Axis, Point};
use runtime_sim::value::Value;

fn placed(device: &str, pose: Point, arguments: Vec<(&str, Value)>) -> Placed {
    let device = library::device(device).expect("a device of the library");
    let given = |name: &String| arguments.iter().find(|(known, _)| known == name);
    let arguments = device.parameters.iter().filter_map(|parameter| Some(given(&parameter.name)?.1.clone()));
    let arguments = arguments.collect();
    Placed { device: device.clone(), pose: Frame::new(pose, 0.0), arguments }
}

fn range(ends: [f64; 2]) -> Value {
    Value::List(ends.map(Value::Number).to_vec())
}

pub fn belt(pose: Point, orient: Axis, orient_range: [f64; 2]) -> Placed {
    let arguments = vec![("orient", Value::Axis(orient)), ("orient_range", range(orient_range))];
    placed("belt", pose, arguments)
}

pub fn vehicle(pose: Point, destinations: [Point; 2]) -> Placed {
    placed("vehicle", pose, vec![("destinations", Value::List(destinations.map(Value::Point).to_vec()))])
}

pub fn rail_arm(pose: Point, rail_dim: Axis, rail_range: [f64; 2]) -> Placed {
    placed("rail_arm", pose, vec![("rail_dim", Value::Axis(rail_dim)), ("rail_range", range(rail_range))])
}

pub fn gantry(pose: Point, x: [f64; 2], y: [f64; 2]) -> Placed {
    placed("gantry", pose, vec![("x_rail_range", range(x)), ("y_rail_range", range(y))])
}

pub fn station(pose: Point) -> Placed {
    placed("station", pose, Vec::new())
}

pub fn bin(pose: Point) -> Placed {
    placed("bin", pose, Vec::new())
}

/// With four kinds of part, each 0.1 m high.
pub fn machine(name: &str, placed: &Placed) -> Machine {
    let heights = [Heights { top: 0.1, grasp: 0.1 }; 4];
    let (machine, _) = placed.machine(name, &heights, placed.device.place).expect("a machine");
    machine
}

pub fn arm(placed: &Placed) -> Arm {
    placed.arm().expect("an arm")
}
