//! Arms described in URDF, the Unified Robot Description Format of ROS: links, joints, limits, collision shapes.

mod chain;
mod read;
mod shape;
mod stl;
mod tree;

use super::arm::{self, Arm, Joint, LISTS};
use super::{Imported, text};
use crate::diagnostic::{Diagnostic, sort};
use crate::source::{FileId, Sources};
use chain::Chain;
use read::{Motion, Robot};

/// Which part of the robot is the arm, and where the meshes of its package are.
pub struct Options<'a> {
    /// The link that stands still; without it the root of the tree.
    pub base: Option<&'a str>,
    /// The link whose frame is the flange.
    pub tip: Option<&'a str>,
    /// Name of the device.
    pub name: Option<&'a str>,
    /// The bytes of a mesh by its name in the file; none if meshes are not read. An error says why it cannot be read.
    pub mesh: Option<&'a Mesh<'a>>,
}

/// Reads a mesh.
pub type Mesh<'a> = dyn Fn(&str) -> Result<Vec<u8>, String> + 'a;

/// No joint turns more slowly, rad/s: less is hardly meant.
const SLOWEST: f64 = 1e-4;

/// A device text for the arm that the file describes.
pub fn import(sources: &Sources, file: FileId, options: &Options) -> Result<Imported, Vec<Diagnostic>> {
    let root = super::xml::parse(&sources.file(file).text, file).map_err(|error| vec![*error])?;
    let robot = read::robot(&root).map_err(sorted)?;
    let tree = tree::check(&robot).map_err(sorted)?;
    let chain = Chain::find(&robot, &tree, options).map_err(|error| vec![*error])?;
    let mut notes = Vec::new();
    let fit = chain.fit(&robot, &mut notes).map_err(|error| vec![*error])?;
    let mut arm = Arm {
        device: super::identifier(options.name.unwrap_or(&robot.name.value), "arm"),
        title: robot.name.value.clone(),
        file: sources.file(file).name.clone(),
        flange: robot.links[chain.tip].name.value.clone(),
        joints: joints(&robot, &chain, &mut notes).map_err(sorted)?,
        fit,
        bodies: Vec::new(),
        notes: Vec::new(),
    };
    arm.bodies = shape::bodies(&robot, &tree, &chain, &arm.fit, options, &mut notes);
    arm.notes = notes;
    let rest = arm::rest(&arm).ok_or_else(|| {
        vec![
            Diagnostic::new(
                "E1108",
                robot.name.span,
                "no place was found that the arm reaches with its tool pointing down",
            )
            .note("places all around the base were tried, within the limits of the joints")
            .help("look at the limits of the joints; `--base` and `--tip` say which links are the arm"),
        ]
    })?;
    Ok(Imported { text: text::of_arm(&arm, rest), notes: arm.notes })
}

fn sorted(mut found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    sort(&mut found);
    found
}

/// Limits and velocities of the joints; what the file lacks is told.
fn joints(robot: &Robot, chain: &Chain, notes: &mut Vec<String>) -> Result<Vec<Joint>, Vec<Diagnostic>> {
    /// rad; a joint of the language turns twice to either side at most.
    const MOST: f64 = 4.0 * std::f64::consts::PI;
    let mut found = Vec::new();
    let mut joints = Vec::new();
    for joint in chain.moving.iter().map(|joint| &robot.joints[*joint]) {
        let name = &joint.name.value;
        let range = match (joint.motion, joint.range) {
            (Motion::TurnsFreely, _) => {
                notes.push(format!(
                    "{name} turns without limits in the file; here it has two turns to either side"
                ));
                [-MOST, MOST]
            }
            (_, Some([low, high])) if low < high => {
                if low < -MOST || high > MOST {
                    notes.push(format!("{name}: its limits are cut to two turns to either side"));
                }
                [low.clamp(-MOST, MOST), high.clamp(-MOST, MOST)]
            }
            (_, range) => {
                let (message, help) = match range {
                    Some([low, high]) => (
                        format!("the limits of {name}, {low} to {high} rad, are no range"),
                        "lower has to be less than upper",
                    ),
                    None => (
                        format!("{name} has no limits"),
                        "add <limit lower=\"...\" upper=\"...\" velocity=\"...\"/>",
                    ),
                };
                found.push(Diagnostic::new("E1104", joint.span, message).help(help));
                continue;
            }
        };
        if joint.has_soft_limits {
            notes.push(format!("{name}: the narrower limits of <safety_controller> are not taken over"));
        }
        let speed = joint.velocity.filter(|speed| *speed > 0.0);
        if let Some(speed) = speed.filter(|speed| *speed < SLOWEST) {
            let message = format!("the velocity of {name}, {speed} rad/s, is less than {SLOWEST}");
            found.push(
                Diagnostic::new("E1104", joint.span, message)
                    .help("correct it, or leave it out: then it is a parameter"),
            );
        }
        if speed.is_none() {
            notes.push(format!("{name} has no velocity in the file; it is a parameter of the device"));
        }
        joints.push(Joint {
            name: name.clone(),
            link: robot.links[joint.child].name.value.clone(),
            range: Some(range),
            speed,
            mass: robot.links[joint.child].mass.filter(|mass| *mass > 0.0),
            effort: joint.effort.filter(|effort| *effort > 0.0),
            damping: joint.damping,
            friction: joint.friction,
        });
    }
    if found.is_empty() {
        notes.extend(left_out(&joints));
        Ok(joints)
    } else {
        Err(found)
    }
}

/// Lists that the device cannot have, because the file lacks a number; of those of which it has none, masses.
fn left_out(joints: &[Joint]) -> Vec<String> {
    let mut notes = Vec::new();
    for (list, of) in LISTS {
        let is_mass = list == "masses";
        let without: Vec<&str> = (joints.iter().filter(|joint| of(joint).is_none()))
            .map(|joint| if is_mass { &joint.link } else { &joint.name }.as_str())
            .collect();
        if !without.is_empty() && (is_mass || without.len() < joints.len()) {
            notes.push(format!("`{list}` is left out: the file lacks it for {}", without.join(", ")));
        }
    }
    notes
}
