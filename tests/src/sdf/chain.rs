//! Where the joints of a model put its links, from the text of the world alone.

use super::numbers;
use crate::xml::Element;

/// A frame: rotation, then position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub rotation: [[f64; 3]; 3],
    pub position: [f64; 3],
}

impl Frame {
    pub const NONE: Self =
        Self { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], position: [0.0; 3] };

    /// From the six numbers of a pose: R = Rz(yaw) Ry(pitch) Rx(roll).
    fn of(values: &[f64]) -> Self {
        let turn = |axis: [f64; 3], angle: f64| Self { rotation: about(axis, angle), position: [0.0; 3] };
        let at = Self { position: [values[0], values[1], values[2]], ..Self::NONE };
        at.times(&turn([0.0, 0.0, 1.0], values[5]))
            .times(&turn([0.0, 1.0, 0.0], values[4]))
            .times(&turn([1.0, 0.0, 0.0], values[3]))
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut product = *self;
        for i in 0..3 {
            for j in 0..3 {
                product.rotation[i][j] = (0..3).map(|k| self.rotation[i][k] * other.rotation[k][j]).sum();
            }
            product.position[i] += (0..3).map(|k| self.rotation[i][k] * other.position[k]).sum::<f64>();
        }
        product
    }

    fn inverse(&self) -> Self {
        let mut back = Self::NONE;
        for i in 0..3 {
            for j in 0..3 {
                back.rotation[i][j] = self.rotation[j][i];
            }
            back.position[i] = -(0..3).map(|k| self.rotation[k][i] * self.position[k]).sum::<f64>();
        }
        back
    }
}

/// Rodrigues' formula.
fn about(axis: [f64; 3], angle: f64) -> [[f64; 3]; 3] {
    let (s, c) = angle.sin_cos();
    let [x, y, z] = axis;
    let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let mut rotation = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let unit = if i == j { c } else { 0.0 };
            rotation[i][j] = unit + s * cross[i][j] + (1.0 - c) * axis[i] * axis[j];
        }
    }
    rotation
}

/// Pose of an element's child `pose`; nothing at all is the frame it is given in.
pub fn pose(element: &Element) -> Frame {
    element.child("pose").and_then(numbers).map_or(Frame::NONE, |values| Frame::of(&values))
}

/// A link or a joint where the model is drawn: all joints at 0. In the world's frame.
fn at_zero(model: &Element, element: &Element) -> Frame {
    let relative = element.child("pose").and_then(|p| p.attribute("relative_to"));
    let child = (element.name == "joint").then(|| text(element, "child"));
    let outer = match relative.or(child) {
        Some(name) => at_zero(model, find(model, name)),
        None => pose(model),
    };
    outer.times(&pose(element))
}

fn text<'a>(element: &'a Element, child: &str) -> &'a str {
    element.child(child).map_or("", |c| c.text.as_str())
}

fn find<'a>(model: &'a Element, name: &str) -> &'a Element {
    let is_it = |c: &&Element| c.attribute("name") == Some(name);
    model.children.iter().find(is_it).unwrap_or_else(|| panic!("{name} is not in the model"))
}

/// The joints that can move, in the order of the text.
pub fn movable(model: &Element) -> Vec<&Element> {
    model.all("joint").filter(|j| j.child("axis").is_some()).collect()
}

/// Where a link is, in the world's frame, when the movable joints have these values.
pub fn link_at(model: &Element, link: &str, values: &[f64]) -> Frame {
    let element = find(model, link);
    let Some(joint) = model.all("joint").find(|j| text(j, "child") == link) else {
        return at_zero(model, element);
    };
    let number = movable(model).iter().position(|j| *j == joint);
    let motion = number.map_or(Frame::NONE, |i| moved(joint, values[i]));
    let parent = text(joint, "parent");
    let (parent_now, parent_then) = match parent {
        "world" => (Frame::NONE, Frame::NONE),
        _ => (link_at(model, parent, values), at_zero(model, find(model, parent))),
    };
    let joint_then = at_zero(model, joint);
    let to_joint = parent_then.inverse().times(&joint_then);
    let to_link = joint_then.inverse().times(&at_zero(model, element));
    parent_now.times(&to_joint).times(&motion).times(&to_link)
}

fn moved(joint: &Element, value: f64) -> Frame {
    let xyz = joint.child("axis").and_then(|a| a.child("xyz")).and_then(numbers).expect("an axis");
    let axis = [xyz[0], xyz[1], xyz[2]];
    match joint.attribute("type") {
        Some("prismatic") => Frame { position: axis.map(|c| c * value), ..Frame::NONE },
        _ => Frame { rotation: about(axis, value), ..Frame::NONE },
    }
}
