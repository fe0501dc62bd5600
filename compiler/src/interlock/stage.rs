//! Places that a machine passes on its paths: corners of regions, each with a number and solved once.

use super::region::Region;
use runtime_sim::collision::Moving;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::point::Point;
use rustc_hash::FxHashMap;

#[derive(Clone, Copy)]
pub struct Corner {
    pub point: Point,
    /// Of all corners that are the same to a millimetre, with the tool in the same direction.
    pub number: usize,
    pub is_reached: bool,
}

/// Of one region: bit 0 of a corner's number is for x, bit 1 for y, bit 2 for z.
pub struct Corners {
    pub corners: [Corner; 8],
    /// The bits of the axes along which the region has an extent.
    pub wide: usize,
}

/// Where a machine goes past: in one of the regions, and the direction of its tool there.
pub struct Stage {
    pub regions: Vec<Corners>,
    pub facing: Facing,
}

/// The corners of one machine.
pub struct Places<'a> {
    moving: &'a Moving,
    numbers: FxHashMap<[[i64; 3]; 3], usize>,
}

impl<'a> Places<'a> {
    pub fn new(moving: &'a Moving) -> Self {
        Self { moving, numbers: FxHashMap::default() }
    }

    pub fn stage(&mut self, regions: &[Region], facing: Facing) -> Stage {
        let corners = |region: &Region| {
            let axes = |is_one: &dyn Fn([f64; 2]) -> bool| -> usize {
                (0..3).map(|axis| usize::from(is_one(region[axis])) << axis).sum()
            };
            // Axes along which corners differ, if only by the sign of a zero.
            let differs = axes(&|[low, high]| low.to_bits() != high.to_bits());
            let mut corners = [self.corner(region, 0, facing); 8];
            for number in 1..8 {
                corners[number] = match number & differs {
                    same if same < number => corners[same],
                    _ => self.corner(region, number, facing),
                };
            }
            Corners { corners, wide: axes(&|[low, high]| low != high) }
        };
        Stage { regions: regions.iter().map(corners).collect(), facing }
    }

    fn corner(&mut self, region: &Region, number: usize, facing: Facing) -> Corner {
        let [x, y, z] = [0, 1, 2].map(|axis| region[axis][number >> axis & 1]);
        let next = self.numbers.len();
        let point = Point::new(x, y, z);
        let tool = facing.pose(point, 1.0);
        let rounded = [point, tool.axis(0), tool.axis(2)]
            .map(|place| [place.x, place.y, place.z].map(|value| (value * 1e3).round() as i64));
        Corner {
            point,
            number: *self.numbers.entry(rounded).or_insert(next),
            is_reached: self.moving.reaches(point, facing),
        }
    }
}
