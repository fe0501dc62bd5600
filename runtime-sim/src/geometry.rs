//! Where a machine stands and which places it has, as the layout gives them.

use crate::point::{Axis, Point};

/// What the layout fixes for one machine: the keys of its JSON object.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// A belt along `orient`; parts travel towards the lower end of `orient_range`.
    Belt { pose: Point, orient: Axis, orient_range: [f64; 2] },
    /// A vehicle that starts at `pose`; `destinations` are its near and its far stop.
    Vehicle { pose: Point, destinations: [Point; 2] },
    /// A UR10 on a rail; `pose` is its shoulder-lift axis with the rail at the middle of the world's origin.
    RailArm { pose: Point, rail_dim: Axis, rail_range: [f64; 2] },
    /// A UR10 under a torso on two rails; `pose.z` is the height of its shoulder.
    Gantry { pose: Point, x_rail_range: [f64; 2], y_rail_range: [f64; 2] },
    /// An assembly station with its briefcase.
    Station { pose: Point },
    /// A bin that holds parts.
    Bin { pose: Point },
}

/// A place at which an item changes hands, with its name for reports, such as `slot 3 at stops[0]`.
/// The point is where the item's underside rests.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub name: String,
    pub point: Point,
}

/// Height of the belt's surface over its pose (collision box of the belt model: centre 0.75, height 0.25).
pub const BELT_SURFACE: f64 = 0.875;
/// Half of the pick zone's length: the field of the camera over the belt, 0.6 * tan(0.75 rad).
pub const PICK_ZONE_HALF: f64 = 0.56;
/// Where parts appear, before the upper end of `orient_range` (spawn at y = 4.3 of a belt that ends at 5).
pub const SPAWN_INSET: f64 = 0.7;
/// Where parts leave the belt, after the lower end of `orient_range` (deletion wall at -4.53 of -5).
pub const END_INSET: f64 = 0.47;
/// Height of a vehicle's tray over its pose (kit tray: top at 0.755).
pub const TRAY_SURFACE: f64 = 0.755;
/// Number of slots of a tray: three rows of four.
pub const SLOTS: usize = 12;
/// Where the middle of the briefcase's floor lies, from the station's pose
/// (briefcase at (0.08, 0.095839, 1.20), lowest part pose 0.15 over it).
pub const BRIEFCASE: Point = Point::new(0.08, 0.095839, 1.35);
/// The case of the briefcase around the middle of its floor: bounds of `briefcase.stl` (ARIAC 2021) below the
/// places of the parts, 1.1 times as large as drawn. The lid stands beyond it.
pub const BRIEFCASE_X: [f64; 2] = [-0.250, 0.355];
pub const BRIEFCASE_Y: [f64; 2] = [-0.312, 0.312];
/// Height of a bin's inner floor over its pose.
pub const BIN_FLOOR: f64 = 0.725;
/// Side of a bin's square floor.
pub const BIN_SIDE: f64 = 0.6;
/// Lengths of a vehicle's tray along the world's x and y (kit tray 0.5 x 0.7, turned), and where its middle is
/// from the vehicle's position.
pub const TRAY: [f64; 2] = [0.70, 0.50];
pub const TRAY_MIDDLE: Point = Point::new(0.15, 0.0, 0.0);
/// Width of a belt's moving surface (collision box of the belt model).
pub const BELT_WIDTH: f64 = 0.42;

/// Slot `i` of a tray, from the vehicle's pose: rows 0.20 m apart in x, columns 0.12 m in y
/// (the prototype's twelve-slot tray).
pub fn slot_offset(i: usize) -> Point {
    Point::new(-0.014 + 0.20 * (i / 4) as f64, -0.18 + 0.12 * (i % 4) as f64, TRAY_SURFACE)
}

/// Place `i` of a bin, from the bin's pose: the same grid, centred on the bin.
pub fn bin_offset(i: usize) -> Point {
    Point::new(-0.2 + 0.20 * (i / 4) as f64, -0.18 + 0.12 * (i % 4) as f64, BIN_FLOOR)
}

/// Most kinds of part that a line has; a briefcase has a place for each.
pub const MOST_KINDS: usize = 16;

/// Where the parts lie in a briefcase, from the middle of its floor. The first four are two columns 0.2 m apart;
/// the others leave 0.14 m and 0.12 m between them (no part is longer than 0.135 m in x or 0.113 m in y).
const BRIEFCASE_PLACES: [[f64; 2]; MOST_KINDS] = [
    [-0.1, -0.12],
    [0.1, -0.12],
    [-0.1, 0.12],
    [0.1, 0.12],
    [0.24, -0.12],
    [0.24, 0.12],
    [-0.18, 0.0],
    [-0.04, 0.0],
    [0.1, 0.0],
    [0.24, 0.0],
    [-0.18, -0.24],
    [-0.04, -0.24],
    [0.1, -0.24],
    [-0.18, 0.24],
    [-0.04, 0.24],
    [0.1, 0.24],
];

/// Where kind number `kind` lies in a briefcase, from the station's pose.
pub fn briefcase_offset(kind: usize) -> Point {
    let [x, y] = BRIEFCASE_PLACES[kind % MOST_KINDS];
    BRIEFCASE + Point::new(x, y, 0.0)
}

impl Geometry {
    /// Name of the device of this machine in [`crate::device::DEVICES`].
    pub fn device(&self) -> &'static str {
        match self {
            Geometry::Belt { .. } => "belt",
            Geometry::Vehicle { .. } => "vehicle",
            Geometry::RailArm { .. } => "rail_arm",
            Geometry::Gantry { .. } => "gantry",
            Geometry::Station { .. } => "station",
            Geometry::Bin { .. } => "bin",
        }
    }

    /// Every number by its path among the keys of the JSON object, such as `pose[0]` or `destinations[0][1]`.
    pub fn numbers(&self) -> Vec<(String, f64)> {
        let mut copy = self.clone();
        copy.places_of_numbers().into_iter().map(|(path, value)| (path, *value)).collect()
    }

    /// The same machine with one number changed; none if it has no such number, or a range would lose its order.
    pub fn with_number(&self, path: &str, value: f64) -> Option<Geometry> {
        let mut changed = self.clone();
        let (_, place) = changed.places_of_numbers().into_iter().find(|(known, _)| known == path)?;
        *place = value;
        (value.is_finite() && changed.ranges().iter().all(|[low, high]| low < high)).then_some(changed)
    }

    fn ranges(&self) -> Vec<[f64; 2]> {
        match *self {
            Geometry::Belt { orient_range: range, .. } | Geometry::RailArm { rail_range: range, .. } => {
                vec![range]
            }
            Geometry::Gantry { x_rail_range, y_rail_range, .. } => vec![x_rail_range, y_rail_range],
            Geometry::Vehicle { .. } | Geometry::Station { .. } | Geometry::Bin { .. } => Vec::new(),
        }
    }

    fn places_of_numbers(&mut self) -> Vec<(String, &mut f64)> {
        fn elements<'a>(
            key: &str,
            values: impl IntoIterator<Item = &'a mut f64>,
        ) -> Vec<(String, &'a mut f64)> {
            values.into_iter().enumerate().map(|(i, value)| (format!("{key}[{i}]"), value)).collect()
        }
        fn point<'a>(key: &str, point: &'a mut Point) -> Vec<(String, &'a mut f64)> {
            elements(key, [&mut point.x, &mut point.y, &mut point.z])
        }
        match self {
            Geometry::Belt { pose, orient_range, .. } => {
                [point("pose", pose), elements("orient_range", orient_range)].into_iter().flatten().collect()
            }
            Geometry::Vehicle { pose, destinations: [near, far] } => {
                [point("pose", pose), point("destinations[0]", near), point("destinations[1]", far)]
                    .into_iter()
                    .flatten()
                    .collect()
            }
            Geometry::RailArm { pose, rail_range, .. } => {
                [point("pose", pose), elements("rail_range", rail_range)].into_iter().flatten().collect()
            }
            Geometry::Gantry { pose, x_rail_range, y_rail_range } => [
                point("pose", pose),
                elements("x_rail_range", x_rail_range),
                elements("y_rail_range", y_rail_range),
            ]
            .into_iter()
            .flatten()
            .collect(),
            Geometry::Station { pose } | Geometry::Bin { pose } => point("pose", pose),
        }
    }

    pub fn pose(&self) -> Point {
        match *self {
            Geometry::Belt { pose, .. }
            | Geometry::Vehicle { pose, .. }
            | Geometry::RailArm { pose, .. }
            | Geometry::Gantry { pose, .. }
            | Geometry::Station { pose }
            | Geometry::Bin { pose } => pose,
        }
    }

    /// Stops of a vehicle: its start, then its destinations. Empty for every other machine.
    pub fn stops(&self) -> Vec<Point> {
        match self {
            Geometry::Vehicle { pose, destinations } => {
                vec![*pose, destinations[0], destinations[1]]
            }
            _ => Vec::new(),
        }
    }

    /// Both ends of a belt's pick zone, on its surface, lower coordinate first.
    pub fn pick_zone(&self) -> Option<[Point; 2]> {
        let Geometry::Belt { pose, orient, .. } = *self else { return None };
        let along = match orient {
            Axis::X => Point::new(PICK_ZONE_HALF, 0.0, 0.0),
            Axis::Y => Point::new(0.0, PICK_ZONE_HALF, 0.0),
        };
        let middle = pose.up(BELT_SURFACE);
        Some([middle - along, middle + along])
    }

    /// The values of a device constant (see [`crate::device::Constant`]), flattened; `None` if this device has no such constant.
    /// `heights` are the heights of the kinds, in order.
    pub fn constant(&self, name: &str, heights: &[f64]) -> Option<Vec<f64>> {
        let points = |list: Vec<Point>| list.iter().flat_map(|p| [p.x, p.y, p.z]).collect();
        match (self, name) {
            (Geometry::Belt { .. }, "pick_zone") => self.pick_zone().map(|z| points(z.to_vec())),
            (Geometry::Vehicle { .. }, "stops") => Some(points(self.stops())),
            (Geometry::Vehicle { .. }, "offsets") => Some(points((0..SLOTS).map(slot_offset).collect())),
            (Geometry::Vehicle { pose, .. }, "places") => {
                Some(points((0..SLOTS).map(|i| *pose + slot_offset(i)).collect()))
            }
            (Geometry::Vehicle { pose, .. }, "place") => Some(points(vec![*pose])),
            (Geometry::RailArm { .. } | Geometry::Gantry { .. }, "heights") => Some(heights.to_vec()),
            (Geometry::RailArm { .. } | Geometry::Gantry { .. }, "rest") => Some(points(vec![self.rest()])),
            (Geometry::Station { pose }, "places") => {
                Some(points((0..heights.len()).map(|k| *pose + briefcase_offset(k)).collect()))
            }
            (Geometry::Station { pose } | Geometry::Bin { pose }, "place") => Some(points(vec![*pose])),
            (Geometry::Bin { pose }, "places") => {
                Some(points((0..SLOTS).map(|i| *pose + bin_offset(i)).collect()))
            }
            _ => None,
        }
    }

    /// Where an arm's tool rests when nothing is to be done: its spawn pose from the rail's middle.
    /// (Kitting robot: (0.574, 0.163, 0.402) from its shoulder; gantry: near the middle of its range, below its shoulder.)
    pub fn rest(&self) -> Point {
        match *self {
            Geometry::RailArm { pose, rail_dim, rail_range } => {
                let middle = (rail_range[0] + rail_range[1]) / 2.0;
                match rail_dim {
                    Axis::Y => Point::new(pose.x + 0.574, middle + 0.163, pose.z + 0.402),
                    Axis::X => Point::new(middle + 0.163, pose.y + 0.574, pose.z + 0.402),
                }
            }
            Geometry::Gantry { pose, x_rail_range, y_rail_range } => Point::new(
                (x_rail_range[0] + x_rail_range[1]) / 2.0,
                (y_rail_range[0] + y_rail_range[1]) / 2.0,
                pose.z - 0.776,
            ),
            _ => self.pose(),
        }
    }

    /// The places of a handover that a type names, such as `stops[0]`, `pick_zone` or `places`:
    /// a vehicle hands over at the first `capacity` slots of its tray at that stop.
    /// `None` if this device has no such handover.
    pub fn handover(
        &self,
        name: &str,
        index: Option<usize>,
        capacity: usize,
        kinds: &[String],
    ) -> Option<Vec<Place>> {
        let place = |name: String, point: Point| Place { name, point };
        match (self, name, index) {
            (Geometry::Vehicle { .. }, "stops", Some(stop)) => {
                let at = *self.stops().get(stop)?;
                Some(
                    (0..capacity.min(SLOTS))
                        .map(|i| place(format!("slot {i} at stops[{stop}]"), at + slot_offset(i)))
                        .collect(),
                )
            }
            (Geometry::Belt { .. }, "pick_zone", None) => {
                let [low, high] = self.pick_zone()?;
                Some(vec![
                    place("lower end of the pick zone".into(), low),
                    place("upper end of the pick zone".into(), high),
                ])
            }
            (Geometry::Station { pose }, "places", None) => Some(
                kinds
                    .iter()
                    .enumerate()
                    .map(|(k, kind)| place(format!("place of the {kind}"), *pose + briefcase_offset(k)))
                    .collect(),
            ),
            (Geometry::Bin { pose }, "places", None) => Some(
                (0..capacity.min(SLOTS))
                    .map(|i| place(format!("place {i}"), *pose + bin_offset(i)))
                    .collect(),
            ),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_can_be_changed_alone() {
        let gantry = Geometry::Gantry {
            pose: Point::new(-4.0, 0.0, 2.0),
            x_rail_range: [-14.4, 0.4],
            y_rail_range: [-4.5, 4.5],
        };
        let vehicle = Geometry::Vehicle {
            pose: Point::new(1.0, 2.0, 3.0),
            destinations: [Point::new(4.0, 5.0, 6.0), Point::new(7.0, 8.0, 9.0)],
        };
        assert_eq!(vehicle.numbers()[7], ("destinations[1][1]".to_string(), 8.0));
        for geometry in [gantry, vehicle] {
            let numbers = geometry.numbers();
            for (i, (path, value)) in numbers.iter().enumerate() {
                let changed = geometry.with_number(path, value + 0.001).unwrap();
                for (j, (now, before)) in changed.numbers().iter().zip(&numbers).enumerate() {
                    assert_eq!(now.1 - before.1 != 0.0, i == j, "{path}");
                }
            }
        }
    }

    #[test]
    fn ranges_keep_their_order() {
        let belt = Geometry::Belt { pose: Point::default(), orient: Axis::Y, orient_range: [-5.0, 5.0] };
        assert_eq!(belt.with_number("orient_range[0]", 5.0), None);
        assert_eq!(belt.with_number("orient_range[1]", f64::NAN), None);
        assert_eq!(belt.with_number("rail_range[0]", 0.0), None);
        assert!(belt.with_number("orient_range[0]", 4.999).is_some());
    }

    #[test]
    fn parts_of_all_kinds_lie_side_by_side_in_a_briefcase() {
        const LONGEST: [f64; 2] = [0.135, 0.113];
        for kind in 0..MOST_KINDS {
            let here = briefcase_offset(kind) - BRIEFCASE;
            let is_within = |middle: f64, length: f64, [low, high]: [f64; 2]| {
                middle - length / 2.0 >= low && middle + length / 2.0 <= high
            };
            assert!(is_within(here.x, LONGEST[0], BRIEFCASE_X), "{kind}");
            assert!(is_within(here.y, LONGEST[1], BRIEFCASE_Y), "{kind}");
            for other in 0..kind {
                let gap = briefcase_offset(kind) - briefcase_offset(other);
                assert!(gap.x.abs() >= LONGEST[0] || gap.y.abs() >= LONGEST[1], "{kind} on {other}");
            }
        }
    }
}
