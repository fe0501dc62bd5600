//! Lengths, offsets and signs of an arm from the axes of its six joints, where it is of a kind whose inverse kinematics is
//! known.

use runtime_sim::kinematics::fixed::Geometry;
use runtime_sim::kinematics::opw::Opw;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::kinematics::ur::Lengths;
use runtime_sim::point::Point;

pub const JOINTS: usize = runtime_sim::kinematics::fixed::JOINTS;

/// Six joints that turn, in the frame of their base, at 0.
pub struct Zero {
    /// A point of each axis, and its direction.
    pub axes: [(Point, Point); JOINTS],
    pub tip: Pose,
}

/// A kind of arm with its lengths; the tool is the flange.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Where the first axis crosses the ground of the base's frame.
    pub base: Point,
    /// Degrees by which the frame of the kinematics is turned to the left from that of the base.
    pub yaw: f64,
    pub geometry: Geometry,
}

/// What axes may lack to be parallel, square or to meet, rad and m: files round pi to five digits.
const SQUARE: f64 = 1e-4;
const MEETS: f64 = 1e-4;
/// Greatest distance of the flange from the file's in any position, m.
const FARTHEST: f64 = 2e-4;
/// A length below this has no sign, m.
const NOTHING: f64 = 1e-6;
const UP: Point = Point::new(0.0, 0.0, 1.0);

/// An arm of one of the two kinds; what is against it is told, a fact each.
pub fn fit(zero: &Zero, names: &[&str; JOINTS]) -> Result<Fit, Vec<String>> {
    let [_, second, third, fourth, ..] = zero.axes.map(|(_, along)| along);
    let are_three_parallel = is_along(second, third) && is_along(third, fourth);
    if are_three_parallel { universal_robots(zero, names) } else { ortho_parallel(zero, names) }
}

struct Facts<'a> {
    names: &'a [&'a str; JOINTS],
    axes: &'a [(Point, Point); JOINTS],
    found: Vec<String>,
}

impl Facts<'_> {
    fn angle(&mut self, first: usize, second: usize, wanted: f64) {
        let [a, b] = [first, second].map(|joint| self.axes[joint].1);
        let angle = cross(a, b).length().atan2(a.dot(b).abs());
        if (angle - wanted).abs() > SQUARE {
            let wanted = if wanted == 0.0 { "parallel" } else { "square to one another" };
            self.found.push(format!(
                "the axes of {} and {} are at {:.3} degrees, not {wanted}",
                self.names[first],
                self.names[second],
                angle.to_degrees()
            ));
        }
    }

    /// The first axis is vertical.
    fn upright(&mut self) {
        let angle = cross(self.axes[0].1, UP).length().atan2(self.axes[0].1.z.abs());
        if angle > SQUARE {
            self.found.push(format!(
                "the axis of {} is inclined by {:.3} degrees against the z axis of the base",
                self.names[0],
                angle.to_degrees()
            ));
        }
    }

    fn apart(&mut self, what: &str, distance: f64) {
        if distance > MEETS {
            self.found.push(format!("{what} by {:.2} mm", distance * 1000.0));
        }
    }
}

fn ortho_parallel(zero: &Zero, names: &[&str; JOINTS]) -> Result<Fit, Vec<String>> {
    const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
    let [(first, d1), (second, d2), (third, d3), (fourth, d4), (fifth, d5), (sixth, d6)] = zero.axes;
    let mut facts = Facts { names, axes: &zero.axes, found: Vec::new() };
    facts.upright();
    facts.angle(0, 1, QUARTER);
    facts.angle(1, 2, 0.0);
    facts.angle(2, 3, QUARTER);
    facts.angle(3, 4, QUARTER);
    facts.angle(4, 5, QUARTER);
    if !facts.found.is_empty() {
        return Err(facts.found);
    }
    let wrist = nearest(fourth, d4, fifth, d5);
    let [n4, n5, n6] = [names[3], names[4], names[5]];
    facts.apart(&format!("the axes of {n4} and {n5} miss one another"), from_line(wrist, fifth, d5));
    facts.apart(
        &format!("the axis of {n6} misses the crossing of those of {n4} and {n5}"),
        from_line(wrist, sixth, d6),
    );
    facts.apart(&format!("the flange is beside the axis of {n6}"), from_line(zero.tip.position, sixth, d6));
    if !facts.found.is_empty() {
        return Err(facts.found);
    }
    // The frame of the base as the convention turns it: x ahead, y along the second axis.
    let base = Point { z: 0.0, ..on_line_at_height_0(first, d1) };
    let ahead_of = |y: Point| cross(y, UP);
    let lies_ahead = {
        let ahead = ahead_of(d2);
        let [by_shoulder, by_tip] = [second, zero.tip.position].map(|point| (point - base).dot(ahead));
        let by_x = ahead.x + 1e-3 * ahead.y;
        [by_shoulder, by_tip, by_x].into_iter().find(|ahead| ahead.abs() > NOTHING).unwrap_or(1.0)
    };
    let y = d2.scaled(lies_ahead.signum());
    let ahead = ahead_of(y);
    let flat = |point: Point| point - y.scaled(point.dot(y));
    let upper_arm = flat(third - second);
    let lean_2 = upper_arm.dot(ahead).atan2(upper_arm.z);
    let elbow = flat(wrist - third);
    let forearm = d4.scaled(if elbow.dot(d4) < 0.0 { -1.0 } else { 1.0 });
    let lean_3 = forearm.dot(ahead).atan2(forearm.z);
    let forearm_x = cross(y, forearm);
    let y5 = d5.scaled(if d5.dot(y) < -SQUARE { -1.0 } else { 1.0 });
    let x4 = cross(y5, forearm);
    let hand = zero.tip.position - wrist;
    let is_ahead =
        if hand.length() > NOTHING { hand.dot(d6) >= 0.0 } else { zero.tip.axis(2).dot(d6) >= 0.0 };
    let flange = d6.scaled(if is_ahead { 1.0 } else { -1.0 });
    let x5 = cross(y5, flange);
    // The x axis of the file's flange, or the first axis of it that is square to its last joint.
    let side = (0..3).map(|i| zero.tip.axis(i)).find(|axis| axis.dot(flange).abs() < 0.5).unwrap_or(x5);
    let angles = [
        ahead.y.atan2(ahead.x),
        lean_2,
        lean_3 - lean_2,
        (-y5.dot(forearm_x)).atan2(y5.dot(y)),
        flange.dot(x4).atan2(flange.dot(forearm)),
        side.dot(y5).atan2(side.dot(x5)),
    ];
    let sign = |is_same: f64| if is_same < 0.0 { -1.0 } else { 1.0 };
    let opw = Opw {
        a1: length((second - base).dot(ahead)),
        a2: length(elbow.dot(forearm_x)),
        b: length((wrist - base).dot(y)),
        c1: length(second.z),
        c2: length(upper_arm.length()),
        c3: length(elbow.dot(forearm)),
        tool: length(hand.dot(flange)),
        offsets: angles.map(|angle| turn(-angle).to_radians()),
        signs: [d1.z, d2.dot(y), d3.dot(y), d4.dot(forearm), d5.dot(y5), d6.dot(flange)].map(sign),
    };
    if opw.c2 <= NOTHING || (opw.a2 == 0.0 && opw.c3 == 0.0) {
        let names = format!("{} and {}", names[1], names[2]);
        return Err(vec![format!("the upper arm between {names}, or the forearm, has no length")]);
    }
    let base = Point::new(length(base.x), length(base.y), 0.0);
    Ok(Fit { base, yaw: 0.0, geometry: Geometry::OrthoParallel(opw) })
}

fn universal_robots(zero: &Zero, names: &[&str; JOINTS]) -> Result<Fit, Vec<String>> {
    const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
    let [(first, d1), (second, d2), (third, _), (fourth, _), (fifth, _), (sixth, _)] = zero.axes;
    let mut facts = Facts { names, axes: &zero.axes, found: Vec::new() };
    facts.upright();
    facts.angle(0, 1, QUARTER);
    facts.angle(3, 4, QUARTER);
    facts.angle(4, 5, QUARTER);
    if !facts.found.is_empty() {
        return Err(facts.found);
    }
    // The second axis lies against the y axis of the manufacturer's base.
    let base = Point { z: 0.0, ..on_line_at_height_0(first, d1) };
    let aside = d2;
    let x = cross(aside.scaled(-1.0), UP);
    let along = |point: Point| (point - base).dot(x);
    let beside = |point: Point| (point - base).dot(aside);
    let geometry = Geometry::UniversalRobots(Lengths {
        d1: length(second.z),
        a2: length(along(third) - along(second)),
        a3: length(along(fourth) - along(third)),
        d4: length(beside(fifth)),
        d5: length(second.z - sixth.z),
        tool: length(beside(zero.tip.position) - beside(fifth)),
    });
    if let Geometry::UniversalRobots(Lengths { a2, a3, .. }) = geometry
        && (a2.abs() <= NOTHING || a3.abs() <= NOTHING)
    {
        return Err(vec![
            "at 0 the axes of the second, third and fourth joint do not lie one behind the other".into(),
        ]);
    }
    Ok(Fit { base: Point::new(length(base.x), length(base.y), 0.0), yaw: turn(x.y.atan2(x.x)), geometry })
}

/// Compares the forward kinematics in many positions; what was found, or why it is another arm.
pub fn compare(
    fit: &Fit,
    ranges: &[[f64; 2]; JOINTS],
    file: impl Fn(&[f64; JOINTS]) -> Pose,
) -> Result<String, Vec<String>> {
    const POSITIONS: u32 = 1000;
    /// Roots of primes: their multiples are spread evenly and independently.
    const PRIMES: [f64; JOINTS] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0];
    let base = Pose { position: fit.base, ..Pose::turned(Point::default(), fit.yaw.to_radians()) };
    let ours = |values: &[f64; JOINTS]| {
        base.then(&match &fit.geometry {
            Geometry::OrthoParallel(opw) => opw.forward(values),
            Geometry::UniversalRobots(lengths) => lengths.forward(values),
        })
    };
    let zero = [0.0; JOINTS];
    // The file may give its flange other axes, but those are fixed.
    let other = file(&zero).seen_from(&Pose { position: file(&zero).position, ..ours(&zero) });
    let mut worst = (0.0_f64, 0.0_f64);
    for i in 1..=POSITIONS {
        let values = std::array::from_fn(|joint| {
            let [low, high] = ranges[joint];
            low + (high - low) * (f64::from(i) * PRIMES[joint].sqrt()).fract()
        });
        let (ours, file) = (ours(&values), file(&values));
        let wanted = ours.then(&Pose { position: Point::default(), ..other });
        let turned = (0..3).map(|axis| (wanted.axis(axis) - file.axis(axis)).length()).fold(0.0, f64::max);
        worst = (worst.0.max((ours.position - file.position).length()), worst.1.max(turned));
    }
    let kind = match fit.geometry {
        Geometry::OrthoParallel(_) => "six axes with a spherical wrist",
        Geometry::UniversalRobots(_) => "six axes as those of Universal Robots",
    };
    let facts = format!(
        "{kind}: in {POSITIONS} positions the flange is at most {:.4} mm and {:.5} degrees from that of the file",
        worst.0 * 1000.0,
        worst.1.to_degrees()
    );
    let is_same = worst.0 <= FARTHEST && worst.1 <= FARTHEST;
    if is_same { Ok(facts) } else { Err(vec![facts, limit()]) }
}

fn limit() -> String {
    format!(
        "up to {} mm and {:.3} degrees are taken for rounding; a file with the calibration of one arm differs by more",
        FARTHEST * 1000.0,
        FARTHEST.to_degrees()
    )
}

/// m, to 0.1 um: what files round.
fn length(value: f64) -> f64 {
    let rounded = (value * 1e7).round() / 1e7;
    // No negative zero.
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// Degrees from -180, excluded, to 180, to 1e-6.
pub fn turn(angle: f64) -> f64 {
    let degrees = (angle.to_degrees() * 1e6).round() / 1e6;
    let turned = degrees - 360.0 * ((degrees - 180.0) / 360.0).ceil();
    if turned == 0.0 { 0.0 } else { turned }
}

pub fn cross(a: Point, b: Point) -> Point {
    Point::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

fn is_along(a: Point, b: Point) -> bool {
    cross(a, b).length() <= SQUARE
}

fn from_line(point: Point, on: Point, along: Point) -> f64 {
    cross(point - on, along).length()
}

/// The point of the first line, square to the second one, that is nearest to it.
fn nearest(on: Point, along: Point, other: Point, other_along: Point) -> Point {
    let between = other - on;
    let cosine = along.dot(other_along);
    let reach = (between.dot(along) - cosine * between.dot(other_along)) / (1.0 - cosine * cosine);
    on + along.scaled(reach)
}

/// The first axis is all but vertical.
fn on_line_at_height_0(on: Point, along: Point) -> Point {
    on - along.scaled(on.z / along.z)
}
