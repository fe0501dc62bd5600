//! The settings of a chain, read.

use super::drive::Drive;
use super::{Chain, Geometry, Joint, Swinging};
use crate::kinematics::fixed::{self, JOINTS, Mounting};
use crate::kinematics::opw::Opw;
use crate::kinematics::scara::{self, Arms};
use crate::kinematics::ur::Lengths;
use crate::part::{Described, Primitive, Running, Settings, Start};

/// As Universal Robots names them.
const NAMES: [&str; JOINTS] = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
const LINKS: [&str; JOINTS] = ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"];

const SCARA_JOINTS: [&str; scara::JOINTS] = ["inner_arm", "outer_arm", "quill", "flange"];
const SCARA_LINKS: [&str; scara::JOINTS] = SCARA_JOINTS;
/// Settings of other chains.
const FOR_SIX: [&str; 5] = ["lengths", "opw", "offsets", "signs", "envelope"];

impl Described for Chain {
    fn new(settings: &Settings) -> Result<Self, String> {
        let envelope = match settings.optional("envelope", Settings::numbers)?.unwrap_or_default()[..] {
            [] => None,
            [half, height] => Some([half, height]),
            _ => return Err("the setting envelope has neither two numbers nor none".into()),
        };
        let on = settings.optional("on", Settings::part)?;
        let base = settings.optional("from", Settings::upright)?;
        if on.is_some() == base.is_some() {
            return Err("a chain is on an axis, or it has from".into());
        }
        let has_joints = super::has_joints(|name| settings.has(name));
        let has_lengths = settings.has("lengths") || settings.has("opw");
        if let Some(name) = FOR_SIX.into_iter().find(|name| settings.has("scara") && settings.has(name)) {
            return Err(format!("the setting {name} is not for a chain with scara"));
        }
        let mounting = match settings.optional("hung", Settings::truth)?.unwrap_or_default() {
            true if !has_lengths => return Err("the setting hung is for a chain with lengths or opw".into()),
            true => Mounting::Hung,
            false => Mounting::Upright,
        };
        let mount = settings.optional("mount", Settings::upright)?;
        if mount.is_some() && (on.is_none() || !has_lengths) {
            return Err("the setting mount is for a chain on an axis with lengths or opw".into());
        }
        let geometry = match (on.is_some(), has_joints) {
            (true, _) if settings.has("scara") => return Err("a chain with scara has from, and no axis".into()),
            (false, true) if settings.has("scara") => Geometry::Scara(Box::new(scara(settings)?)),
            (true, true) if !has_lengths => of_ur10(settings)?,
            (true, false) if !has_lengths => Geometry::Tool(settings.number("tool_length")?),
            (_, true) => Geometry::Fixed(Box::new(fixed(settings)?), ranges(settings)?.map(Box::new)),
            (_, false) => return Err("the setting speeds is missing".into()),
        };
        let clearances = settings.optional("clearances", Settings::points)?.unwrap_or_default();
        Ok(Self {
            on,
            base,
            mount: mount.unwrap_or_default(),
            mounting,
            geometry,
            rest: settings.point("rest")?,
            joints: match settings.has("scara") {
                true => joints(settings, SCARA_JOINTS, SCARA_LINKS)?,
                false => joints(settings, NAMES, LINKS)?,
            },
            acceleration: if has_joints { settings.positive("acceleration")? } else { 0.0 },
            envelope,
            clearances: clearances.iter().map(|p| [p.x, p.y, p.z]).collect(),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let (machine, part) = (start.machine(), start.part);
        let name = &machine.name;
        let motions = start.memory.motions(start.line, start.machine);
        let motions = motions.ok_or_else(|| format!("{name} has no inverse kinematics"))?;
        let drive = Drive::new(motions, self.rest)
            .ok_or_else(|| format!("{name} cannot reach its own rest position"))?;
        let grip = start.find(|other| matches!(other, Primitive::Grip(grip) if grip.chain == part));
        Ok(Some(Box::new(Swinging::new(drive, grip))))
    }
}

/// A number for each joint; none without the setting.
fn numbers<const N: usize>(settings: &Settings, name: &str) -> Result<Option<[f64; N]>, String> {
    let Some(numbers) = settings.optional(name, Settings::numbers)? else { return Ok(None) };
    let wrong = || format!("the setting {name} has not a number for each of {N} joints");
    numbers.try_into().map(Some).map_err(|_| wrong())
}

fn words<const N: usize>(settings: &Settings, name: &str) -> Result<Option<[String; N]>, String> {
    let Some(words) = settings.optional(name, Settings::words)? else { return Ok(None) };
    let wrong = || format!("the setting {name} has not a name for each of {N} joints");
    words.try_into().map(Some).map_err(|_| wrong())
}

/// With these names unless the device gives others.
fn joints<const N: usize>(
    settings: &Settings,
    names: [&str; N],
    links: [&str; N],
) -> Result<Vec<Joint>, String> {
    let or = |name: &str, default: f64| Ok::<_, String>(numbers(settings, name)?.unwrap_or([default; N]));
    let names = words(settings, "joints")?.unwrap_or(names.map(Into::into));
    let links = words(settings, "links")?.unwrap_or(links.map(Into::into));
    let [masses, efforts] = [or("masses", 5.0)?, or("efforts", 300.0)?];
    let [damping, friction] = [or("damping", 0.0)?, or("friction", 0.0)?];
    let Some(speeds) = numbers::<N>(settings, "speeds")? else { return Ok(Vec::new()) };
    if speeds.iter().any(|speed| *speed <= 0.0) {
        return Err("a number of the setting speeds is not over 0".into());
    }
    let joints = names.into_iter().zip(links).enumerate().map(|(i, (name, link))| Joint {
        name,
        link,
        speed: speeds[i],
        mass: masses[i],
        effort: efforts[i],
        damping: damping[i],
        friction: friction[i],
    });
    Ok(joints.collect())
}

fn of_ur10(settings: &Settings) -> Result<Geometry, String> {
    let fixed = ["tool_length", "offsets", "signs", "lowest", "highest"];
    match fixed.into_iter().find(|name| settings.has(name)) {
        Some(name) => Err(format!("the setting {name} is for a chain with lengths or opw")),
        None => Ok(Geometry::Ur10),
    }
}

fn scara(settings: &Settings) -> Result<Arms, String> {
    let lengths = settings.numbers("scara")?;
    let lengths: [f64; 2] = match lengths[..] {
        [inner, outer] if inner > 0.0 && outer > 0.0 => [inner, outer],
        _ => return Err("the setting scara is the lengths of two arms, both over 0".into()),
    };
    let limits = |name: &str| {
        let missing = || format!("the setting {name} is missing: it has the limit of the quill");
        numbers::<{ scara::JOINTS }>(settings, name)?.ok_or_else(missing)
    };
    let (lowest, highest) = (limits("lowest")?, limits("highest")?);
    for joint in (0..scara::JOINTS).filter(|joint| *joint != scara::QUILL) {
        within_turns(joint, [lowest[joint], highest[joint]])?;
    }
    let [low, high] = [lowest, highest].map(|ends| ends[scara::QUILL]);
    if low >= high {
        return Err(format!("the range of the quill, {low} to {high} m, is none"));
    }
    let turn = highest[scara::JOINTS - 1] - lowest[scara::JOINTS - 1];
    if turn < 180.0 {
        return Err(format!("the tool of a chain with scara turns by 180 degrees at least, not by {turn}"));
    }
    let ranges = std::array::from_fn(|joint| {
        let range = [lowest[joint], highest[joint]];
        if joint == scara::QUILL { range } else { range.map(f64::to_radians) }
    });
    Ok(Arms { lengths, tool: settings.number("tool_length")?, ranges })
}

fn fixed(settings: &Settings) -> Result<fixed::Geometry, String> {
    let tool = settings.number("tool_length")?;
    let lengths = settings.optional("lengths", Settings::numbers)?;
    let opw = settings.optional("opw", Settings::numbers)?;
    let signs = numbers::<JOINTS>(settings, "signs")?;
    let offsets = numbers::<JOINTS>(settings, "offsets")?;
    match (lengths.as_deref(), opw.as_deref()) {
        (Some(_), None) if signs.is_some() || offsets.is_some() => {
            Err("the settings offsets and signs are for a chain with opw".into())
        }
        (Some(&[d1, a2, a3, d4, d5, d6]), None) if a2 != 0.0 && a3 != 0.0 => {
            Ok(fixed::Geometry::UniversalRobots(Lengths { d1, a2, a3, d4, d5, tool: d6 + tool }))
        }
        (Some(_), None) => {
            Err("the setting lengths is d1, a2, a3, d4, d5, d6, of which a2 and a3 are not 0".into())
        }
        (None, Some(&[a1, a2, b, c1, c2, c3, c4])) if c2 > 0.0 && (a2 != 0.0 || c3 != 0.0) => {
            let signs = signs.unwrap_or([1.0; JOINTS]);
            if signs.iter().any(|sign| sign.abs() != 1.0) {
                return Err("a number of the setting signs is neither 1 nor -1".into());
            }
            let offsets = offsets.unwrap_or_default().map(f64::to_radians);
            Ok(fixed::Geometry::OrthoParallel(Opw { a1, a2, b, c1, c2, c3, tool: c4 + tool, offsets, signs }))
        }
        (None, Some(_)) => Err(
            "the setting opw is a1, a2, b, c1, c2, c3, c4, of which c2 is over 0 and a2 and c3 are not both 0".into(),
        ),
        _ => Err("a chain that no axis carries has lengths or opw".into()),
    }
}

/// One turn to either side, deg.
const MOST: f64 = 360.0;

fn ranges(settings: &Settings) -> Result<Option<[[f64; 2]; JOINTS]>, String> {
    let (lowest, highest) = (numbers(settings, "lowest")?, numbers(settings, "highest")?);
    if lowest.is_none() && highest.is_none() {
        return Ok(None);
    }
    let (lowest, highest) = (lowest.unwrap_or([-MOST; JOINTS]), highest.unwrap_or([MOST; JOINTS]));
    let ranges: [[f64; 2]; JOINTS] = std::array::from_fn(|i| [lowest[i], highest[i]]);
    for (joint, range) in ranges.iter().enumerate() {
        within_turns(joint, *range)?;
    }
    Ok(Some(ranges.map(|range| range.map(f64::to_radians))))
}

/// Limits of a joint by its number from 0, deg.
fn within_turns(joint: usize, [low, high]: [f64; 2]) -> Result<(), String> {
    if low < high && low >= -2.0 * MOST && high <= 2.0 * MOST {
        return Ok(());
    }
    Err(format!("the range of joint {}, {low} to {high} degrees, is none within -720 to 720", joint + 1))
}
